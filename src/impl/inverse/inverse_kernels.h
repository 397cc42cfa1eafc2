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
#define SLW_NRHS 8
#include "../kernels/words/words_scalar.inl.h"
#include "../kernels/words/lanes_scalar.inl.h"
#include "products.inl.h"
#include "inverse_front.inl.h"
#include "inverse_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"

#if defined(SLI_X86)
#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLW_NRHS 8
#include "../kernels/words/words_avx2.inl.h"
#include "../kernels/words/lanes_avx2.inl.h"
#include "products.inl.h"
#include "inverse_front.inl.h"
#include "inverse_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

#if defined(SLI_AVX512)
#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLW_NRHS 8
#include "../kernels/words/words_avx512.inl.h"
#include "../kernels/words/lanes_avx512.inl.h"
#include "products.inl.h"
#include "inverse_front.inl.h"
#include "inverse_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

#if defined(SLI_ARM)
#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLW_NRHS 8
#include "../kernels/words/words_neon.inl.h"
#include "../kernels/words/lanes_neon.inl.h"
#include "products.inl.h"
#include "inverse_front.inl.h"
#include "inverse_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

/* The table of an instruction set. */
SLI_INLINE const sli_inverse_kernels *sli_inverse_kernels_of(sl_isa isa) {
    static const sli_inverse_kernels *const tables[SLI_ISAS] = SLI_ISA_TABLES(sli_inverse_kernels);
    return tables[sli_isa_row(isa)];
}

#endif
