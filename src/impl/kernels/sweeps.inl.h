/* sweeps.inl.h: the sweeps for one and two right-hand sides, for one type of L */

#include "unit_triangle.inl.h"
#if defined(SLV_PAIR) /* else multi_rhs.inl.h has the kernels for two right-hand sides */
#include "two_rhs.inl.h"
#endif
/* In plain C the copies for small supernodes are large. For L in float they gain 1 to 6 percent. */
#if defined(SLV_PAIR) || !SLV_SINGLE
#define SLI_SMALL_SUPERNODES
#include "small_supernode.inl.h"
#endif
#include "single_rhs.inl.h"
#undef SLI_SMALL_SUPERNODES

#if SLV_SINGLE
#undef SLV_SINGLE
#define SLV_SINGLE 0
#else
#undef SLV_SINGLE
#define SLV_SINGLE 1
#endif
