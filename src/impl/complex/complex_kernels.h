/* complex_kernels.h: the kernels of complex matrices, for every instruction set */
#ifndef SLI_COMPLEX_COMPLEX_KERNELS_H
#define SLI_COMPLEX_COMPLEX_KERNELS_H

#include "../kernels/dispatch.h"

typedef struct sli_complex_kernels {
    sli_sweeps sweeps;
    sli_front_kernels front;
} sli_complex_kernels;

/* The pivot of both columns k, k+1 of a pair; 0, which is refused, if only one of them is null. */
SLI_NOINLINE static double sli_complex_by_rule(const sli_pivot_rule *rule, sl_int k, double d,
                                               double magnitude) {
    const double first = sli_pivot_by_rule(rule, k, d, magnitude),
                 second = sli_pivot_by_rule(rule, k + 1, d, magnitude);
    return first < second || first > second ? 0.0 : first;
}

#define SLV_SINGLE 0
#define SLV_COMPLEX 1
#define SLI_FOR_STORAGE
#define SLI_FOR_ISA "../kernels/each_lanes.list.h"
#define SLI_FOR_LANES "../complex/complex.list.h"
#include "../kernels/each_isa.list.h"
#undef SLI_FOR_ISA
#undef SLI_FOR_LANES
#undef SLI_FOR_STORAGE
#undef SLV_SINGLE
#undef SLV_COMPLEX

/* The table of an instruction set; NULL: it has none, so that L is kept in double. */
SLI_INLINE const sli_complex_kernels *sli_complex_kernels_of(sl_isa isa) {
    static const sli_complex_kernels *const tables[] = SLI_STORAGE_TABLES(sli_complex_kernels);
    return tables[isa];
}

#endif
