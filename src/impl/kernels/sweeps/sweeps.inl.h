/* sweeps.inl.h: the sweeps for one right-hand side, for one type of L */

#if SLW_PASS == 1 /* once for each instruction set */

#include "unit_triangle.inl.h"
#if defined(SLV_OWN_SHORT)
#include "small_supernode.inl.h"
#endif
#include "single_rhs.inl.h"

#endif
