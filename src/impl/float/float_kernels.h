/* float_kernels.h: the kernels of L in float, for every instruction set */
#ifndef SLI_FLOAT_FLOAT_KERNELS_H
#define SLI_FLOAT_FLOAT_KERNELS_H

#include "../kernels/dispatch.h"

/* to := from, `count` numbers, a multiple of 8. Returns whether one of them is beyond the normal
 * floats, and not 0. */
typedef int (*sli_round_kernel)(float *to, const double *from, ptrdiff_t count);

typedef struct sli_float_kernels {
    sli_sweeps sweeps;
    sli_round_kernel round;
} sli_float_kernels;

#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLI_FOR_STORAGE
#define SLI_FOR_ISA "../kernels/each_lanes.list.h"
#define SLI_FOR_LANES "../float/float.list.h"
#include "../kernels/each_isa.list.h"
#undef SLI_FOR_ISA
#undef SLI_FOR_LANES
#undef SLI_FOR_STORAGE
#undef SLV_SINGLE
#undef SLV_COMPLEX

/* The table of an instruction set; NULL: it has none, so that L is kept in double. */
SLI_INLINE const sli_float_kernels *sli_float_kernels_of(sl_isa isa) {
    static const sli_float_kernels *const tables[] =
        SLI_STORAGE_TABLES(sli_float_kernels);
    return tables[isa];
}

#endif
