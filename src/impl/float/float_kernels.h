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

#define SLI_ROUND_PLAIN(name) \
    static int name(float *to, const double *from, ptrdiff_t count) { \
        ptrdiff_t k; \
        int is_odd = 0; \
        for (k = 0; k < count; k++) { \
            const double size = fabs(from[k]); \
            is_odd |= (size > (double)FLT_MAX) | ((size < (double)FLT_MIN) & (size > 0.0)); \
            to[k] = (float)from[k]; \
        } \
        return is_odd; \
    }

#if !defined(SLI_SIMD)
SLI_ROUND_PLAIN(sli_single_round_scalar)
#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLW_NRHS 2
#define SLW_GROUPS 64
#include "../kernels/words/words_scalar.inl.h"
#include "../kernels/words/lanes_scalar.inl.h"
#include "../kernels/sweeps/sweeps.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

#if defined(SLI_X86)
SLI_TARGET("avx2,fma")
static int sli_single_round_avx2(float *to, const double *from, ptrdiff_t count) {
    const __m256d sign = _mm256_set1_pd(-0.0), zero = _mm256_setzero_pd();
    const __m256d most = _mm256_set1_pd((double)FLT_MAX), least = _mm256_set1_pd((double)FLT_MIN);
    __m256d odd = zero;
    ptrdiff_t k;
    for (k = 0; k < count; k += 4) {
        const __m256d a = _mm256_load_pd(from + k), size = _mm256_andnot_pd(sign, a);
        const __m256d is_small = _mm256_and_pd(_mm256_cmp_pd(size, least, _CMP_LT_OQ),
                                               _mm256_cmp_pd(size, zero, _CMP_GT_OQ));
        odd = _mm256_or_pd(odd, _mm256_or_pd(is_small, _mm256_cmp_pd(size, most, _CMP_GT_OQ)));
        _mm_store_ps(to + k, _mm256_cvtpd_ps(a));
    }
    return _mm256_movemask_pd(odd) != 0;
}

#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLW_NRHS 4
#include "../kernels/words/words_avx2.inl.h"
#include "../kernels/words/lanes_avx2.inl.h"
#include "../kernels/sweeps/sweeps.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#define SLW_NRHS 2
#include "../kernels/words/lanes_avx2.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/two_rhs.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#define SLW_NRHS 8
#define SLW_GROUPS 64
#include "../kernels/words/lanes_avx2.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

#if defined(SLI_AVX512)
#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLW_NRHS 8
#define SLW_GROUPS 8 /* no copies by width, to keep the object small */
#include "../kernels/words/words_avx512.inl.h"
#include "../kernels/words/lanes_avx512.inl.h"
#include "../kernels/sweeps/sweeps.inl.h"
#include "../kernels/sweeps/two_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#define SLW_NRHS 16
#define SLW_GROUPS 64
#include "../kernels/words/lanes_avx512.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

#if defined(SLI_ARM)
SLI_ROUND_PLAIN(sli_single_round_neon)
#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLW_NRHS 4
#include "../kernels/words/words_neon.inl.h"
#include "../kernels/words/lanes_neon.inl.h"
#include "../kernels/sweeps/sweeps.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#define SLW_NRHS 2
#include "../kernels/words/lanes_neon.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/two_rhs.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#define SLW_NRHS 8
#define SLW_GROUPS 64
#include "../kernels/words/lanes_neon.inl.h"
#include "../kernels/sweeps/multi_rhs.inl.h"
#include "../kernels/sweeps/multi_rhs_tiles.inl.h"
#include "float_set.inl.h"
#include "../kernels/words/lanes_undef.inl.h"
#include "../kernels/words/words_undef.inl.h"
#endif

/* The table of an instruction set; NULL: it has none, so that L is kept in double. */
SLI_INLINE const sli_float_kernels *sli_float_kernels_of(sl_isa isa) {
    static const sli_float_kernels *const tables[SLI_ISAS] =
        SLI_STORAGE_TABLES(sli_float_kernels);
    return tables[sli_isa_row(isa)];
}

#endif
