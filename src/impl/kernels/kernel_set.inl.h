/* kernel_set.inl.h: the other kernels of one instruction set, and its table */

#if defined(SLW_LAST) /* once for each instruction set */

#include "fronts/row.inl.h"
#include "sweeps/interleave.inl.h"

static const sli_kernels SLV_NAME(kernels) = {
    SLV_ISA,
    SLV_WIDTH,
    {{SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME_SHORT(forward4), SLV_NAME(forward8),
      SLV_NAME(forward16), SLV_NAME(forward32), SLV_NAME(forward64)},
     {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME_SHORT(backward4), SLV_NAME(backward8),
      SLV_NAME(backward16), SLV_NAME(backward32), SLV_NAME(backward64)}},
    {SLV_NAME(pivots), SLV_NAME(rows), SLV_NAME(update), SLV_NAME(assemble)},
    SLV_NAME(row),
    SLV_NAME(interleave),
    SLV_NAME(separate)};

#endif
