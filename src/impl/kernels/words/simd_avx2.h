/* simd_avx2.h: the functions that the words of AVX2 call */
#ifndef SLI_KERNELS_SIMD_AVX2_H
#define SLI_KERNELS_SIMD_AVX2_H

#include "simd.h"

#if defined(SLI_X86)

/* All bits set in lanes k .. 3, k = -3 .. 8. */
SLI_TARGET("avx2,fma") SLI_INLINE __m256d sli_lanes_from(int k) {
    return _mm256_castsi256_pd(
        _mm256_cmpgt_epi64(_mm256_set_epi64x(3, 2, 1, 0), _mm256_set1_epi64x(k - 1)));
}

/* Lanes 0 .. count-1 from p, the others are rest; count = -3 .. 8. */
SLI_TARGET("avx2,fma") SLI_INLINE __m256d sli_load_part(const double *p, int count, double rest) {
    const __m256d others = sli_lanes_from(count);
    return _mm256_blendv_pd(
        _mm256_maskload_pd(p, _mm256_castpd_si256(_mm256_xor_pd(
                                  others, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))))),
        _mm256_set1_pd(rest), others);
}

/* Number of lanes in a mask of 4. */
SLI_INLINE int sli_count4(unsigned mask) {
    return (int)((mask & 1u) + (mask >> 1 & 1u) + (mask >> 2 & 1u) + (mask >> 3));
}

/* The permutation that moves the first lanes of a register to the lanes of a mask, as indices of
 * 32-bit lanes; -1 in the lanes that are not in the mask. */
SLI_TARGET("avx2,fma") SLI_INLINE __m256i sli_expand_index(unsigned mask) {
    int at[8], k, from = 0;
    for (k = 0; k < 4; k++) {
        const int is_set = (mask >> k & 1u) != 0;
        at[2 * k] = is_set ? 2 * from : -1;
        at[2 * k + 1] = is_set ? 2 * from + 1 : -1;
        from += is_set;
    }
    return _mm256_loadu_si256((const __m256i *)(const void *)at);
}

/* All bits set in the lanes of the mask. */
SLI_TARGET("avx2,fma") SLI_INLINE __m256d sli_expand_keep(__m256i index) {
    return _mm256_castsi256_pd(_mm256_cmpgt_epi32(index, _mm256_set1_epi32(-1)));
}

/* The first lanes of a in the lanes of the mask, 0 in the others. */
SLI_TARGET("avx2,fma") SLI_INLINE __m256d sli_expand_4(__m256d a, __m256i index, __m256d keep) {
    return _mm256_and_pd(_mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(a), index)),
                         keep);
}

/* to := from, `count` numbers, a multiple of 8. Returns whether one of them is beyond
 * the normal floats, and not 0. */
SLI_TARGET("avx2,fma")
SLI_INLINE int sli_single_round_avx2(float *to, const double *from, ptrdiff_t count) {
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

#endif

#endif
