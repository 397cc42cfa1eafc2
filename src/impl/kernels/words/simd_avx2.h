/* simd_avx2.h: the kernels in AVX2 and FMA */
#ifndef SLI_KERNELS_SIMD_AVX2_H
#define SLI_KERNELS_SIMD_AVX2_H

#include "simd.h"
#include "../table.h"

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

#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLW_NRHS 4
#include "words_avx2.inl.h"
#include "lanes_avx2.inl.h"
#include "../sweeps/copy_rows.inl.h"
#include "../fronts/front.inl.h"
#include "../sweeps/sweeps.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/multi_rhs_tiles.inl.h"
#include "lanes_undef.inl.h"

#define SLW_NRHS 2
#include "lanes_avx2.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/two_rhs.inl.h"
#include "lanes_undef.inl.h"

#define SLW_NRHS 8
#define SLW_GROUPS 64
#include "lanes_avx2.inl.h"
#include "../sweeps/copy_rows.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/multi_rhs_tiles.inl.h"
#include "../kernel_set.inl.h"
#include "lanes_undef.inl.h"
#include "words_undef.inl.h"

#endif

#endif
