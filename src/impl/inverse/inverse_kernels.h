/* inverse_kernels.h: the kernels of the inverse, for every instruction set */
#ifndef SLI_INVERSE_INVERSE_KERNELS_H
#define SLI_INVERSE_INVERSE_KERNELS_H

#include "../kernels/dispatch.h"
#include "inverse_front.h"

/* sums(i, j) -= y(k, i) z(k, j) over `count` rows k of 8 values each. sums: 8 x 8, row-major. All
 * arrays are 64-byte aligned. */
typedef void (*sli_products_kernel)(sl_int count, const double *y, const double *z, double *sums);

typedef struct sli_inverse_kernels {
    sli_products_kernel products;
    sli_gather_kernel gather;
    sli_inverse_phase_kernel phase;
    sli_takahashi_kernel takahashi;
} sli_inverse_kernels;

#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLI_FOR_ISA "../inverse/inverse.list.h"
#include "../kernels/each_isa.list.h"
#undef SLI_FOR_ISA
#undef SLV_SINGLE
#undef SLV_COMPLEX

/* The table of an instruction set. */
SLI_INLINE const sli_inverse_kernels *sli_inverse_kernels_of(sl_isa isa) {
    static const sli_inverse_kernels *const tables[] = SLI_ISA_TABLES(sli_inverse_kernels);
    return tables[isa];
}

#endif
