/* float_kernels.h: the kernels of L and of fronts in float, for every instruction set */
#ifndef SLI_FLOAT_FLOAT_KERNELS_H
#define SLI_FLOAT_FLOAT_KERNELS_H

#include "simd_scalar_single.h"
#include "simd_avx512_single.h"
#include "simd_neon_single.h"
#include "../kernels/dispatch.h"

typedef struct sli_float_kernels {
    sli_sweeps sweeps;
    sli_front_kernels front;
} sli_float_kernels;

#if !defined(SLI_SIMD)
#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLW_NRHS 2
#define SLW_GROUPS 64
#include "../kernels/words_scalar.inl.h"
#include "../kernels/lanes_scalar.inl.h"
#include "../kernels/sweeps.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/lanes_undef.inl.h"
#include "../kernels/words_undef.inl.h"
#endif

#if defined(SLI_X86)
#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLW_NRHS 4
#include "../kernels/words_avx2.inl.h"
#include "../kernels/lanes_avx2.inl.h"
#include "../kernels/sweeps.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/multi_rhs_tiles.inl.h"
#include "../kernels/lanes_undef.inl.h"
#define SLW_NRHS 2
#include "../kernels/lanes_avx2.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/two_rhs.inl.h"
#include "../kernels/lanes_undef.inl.h"
#define SLW_NRHS 8
#define SLW_GROUPS 64
#include "../kernels/lanes_avx2.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/lanes_undef.inl.h"
#include "../kernels/words_undef.inl.h"
#endif

#if defined(SLI_AVX512)
#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLW_NRHS 8
#define SLW_GROUPS 8 /* no copies by width, to keep the object small */
#include "../kernels/words_avx512.inl.h"
#include "../kernels/lanes_avx512.inl.h"
#include "../kernels/sweeps.inl.h"
#include "../kernels/two_rhs.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/multi_rhs_tiles.inl.h"
#include "../kernels/lanes_undef.inl.h"
#define SLW_NRHS 16
#define SLW_GROUPS 64
#include "../kernels/lanes_avx512.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/lanes_undef.inl.h"
#include "../kernels/words_undef.inl.h"
#endif

#if defined(SLI_ARM)
#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLW_NRHS 4
#include "../kernels/words_neon.inl.h"
#include "../kernels/lanes_neon.inl.h"
#include "../kernels/sweeps.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/multi_rhs_tiles.inl.h"
#include "../kernels/lanes_undef.inl.h"
#define SLW_NRHS 2
#include "../kernels/lanes_neon.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/two_rhs.inl.h"
#include "../kernels/lanes_undef.inl.h"
#define SLW_NRHS 8
#define SLW_GROUPS 64
#include "../kernels/lanes_neon.inl.h"
#include "../kernels/multi_rhs.inl.h"
#include "../kernels/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/lanes_undef.inl.h"
#include "../kernels/words_undef.inl.h"
#endif

/* The table of an instruction set; NULL: it has none, so that L is kept in double. */
SLI_INLINE const sli_float_kernels *sli_float_kernels_of(sl_isa isa) {
    static const sli_float_kernels *const tables[SLI_ISAS] =
        SLI_STORAGE_TABLES(sli_float_kernels);
    return tables[sli_isa_row(isa)];
}

#endif
