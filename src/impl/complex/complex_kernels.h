/* complex_kernels.h: the kernels of complex matrices, for every instruction set */
#ifndef SLI_COMPLEX_COMPLEX_KERNELS_H
#define SLI_COMPLEX_COMPLEX_KERNELS_H

#include "../kernels/dispatch.h"

typedef struct sli_complex_kernels {
    sli_sweeps sweeps;
    sli_front_kernels front;
} sli_complex_kernels;

#if !defined(SLI_SIMD)
#define SLV_SINGLE 0
#define SLV_COMPLEX 1
#define SLW_NRHS 2
#define SLW_GROUPS 64
#include "../kernels/words/words_scalar.inl.h"
#include "../kernels/words/lanes_scalar.inl.h"
#include "../kernels/fronts/front.inl.h"
#include "complex_small.inl.h"
#include "complex_rows.inl.h"
#include "complex_groups.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "complex_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

#if defined(SLI_X86)
#define SLV_SINGLE 0
#define SLV_COMPLEX 1
#define SLW_NRHS 4
#define SLW_GROUPS 64
#include "../kernels/words/words_avx2.inl.h"
#include "../kernels/words/lanes_avx2.inl.h"
#include "../kernels/fronts/front.inl.h"
#include "complex_groups.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#define SLW_NRHS 2
#define SLW_GROUPS 2
#include "../kernels/words/lanes_avx2.inl.h"
#include "../kernels/sweeps/copy_rows.inl.h"
#include "complex_small.inl.h"
#include "complex_rows.inl.h"
#include "complex_groups.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "complex_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

#if defined(SLI_AVX512)
#define SLV_SINGLE 0
#define SLV_COMPLEX 1
#define SLW_NRHS 8
#define SLW_GROUPS 8
#include "../kernels/words/words_avx512.inl.h"
#include "../kernels/words/lanes_avx512.inl.h"
#include "../kernels/fronts/front.inl.h"
#include "complex_groups.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#define SLW_NRHS 16
#define SLW_GROUPS 64
#include "../kernels/words/lanes_avx512.inl.h"
#include "complex_small.inl.h"
#include "complex_rows.inl.h"
#include "complex_groups.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "complex_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

#if defined(SLI_ARM)
#define SLV_SINGLE 0
#define SLV_COMPLEX 1
#define SLW_NRHS 4
#define SLW_GROUPS 64
#include "../kernels/words/words_neon.inl.h"
#include "../kernels/words/lanes_neon.inl.h"
#include "../kernels/fronts/front.inl.h"
#include "complex_groups.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#define SLW_NRHS 2
#define SLW_GROUPS 2
#include "../kernels/words/lanes_neon.inl.h"
#include "../kernels/sweeps/copy_rows.inl.h"
#include "complex_small.inl.h"
#include "complex_rows.inl.h"
#include "complex_groups.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "complex_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

/* The table of an instruction set; NULL: it has none, so that L is kept in double. */
SLI_INLINE const sli_complex_kernels *sli_complex_kernels_of(sl_isa isa) {
    static const sli_complex_kernels *const tables[SLI_ISAS] =
        SLI_STORAGE_TABLES(sli_complex_kernels);
    return tables[sli_isa_row(isa)];
}

#endif
