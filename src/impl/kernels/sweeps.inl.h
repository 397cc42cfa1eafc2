/* sweeps.inl.h: the sweeps for one and two right-hand sides, for one type of L */

#include "unit_triangle.inl.h"
#if defined(SLV_PAIR) /* else multi_rhs.inl.h has the kernels for two right-hand sides */
#include "two_rhs.inl.h"
#endif
#if defined(SLV_OWN_SMALL)
#include "small_supernode.inl.h"
#endif
#include "single_rhs.inl.h"
