/* simd_avx2_single.h: the kernels of fronts in float in AVX2: a vector of 8 is one register */
#ifndef SLI_FLOAT_SIMD_AVX2_SINGLE_H
#define SLI_FLOAT_SIMD_AVX2_SINGLE_H

#include "../kernels/dispatch.h"

#if defined(SLI_X86)

#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLV_NAME(f) sli_single_##f##_avx2
#define SLV_FUNCTION SLI_TARGET("avx2,fma")

/* The permutation that moves the first lanes of a register to the lanes of a mask; -1 in the lanes
 * that are not in the mask. */
SLV_FUNCTION SLI_INLINE __m256i sli_single_expand_index(unsigned mask) {
    int at[SLI_TILE], k, from = 0;
    for (k = 0; k < SLI_TILE; k++) {
        const int is_set = (int)(mask >> k & 1u);
        at[k] = is_set ? from : -1;
        from += is_set;
    }
    return _mm256_loadu_si256((const __m256i *)(const void *)at);
}

#define SLV_DECLARE(a) __m256 a;
#define SLV_ZERO(a) a = _mm256_setzero_ps();
#define SLV_LOAD(a, p) a = _mm256_load_ps(p);
#define SLV_STORE(p, a) _mm256_store_ps((p), a);
#define SLV_LOAD_PINNED(a, p) \
    a = _mm256_load_ps(p); \
    SLI_PIN(a); /* used 4 times */
#define SLV_BROADCAST(b, p) b = _mm256_broadcast_ss(p);
#define SLV_LANE(b, a, k) b = _mm256_permutevar8x32_ps(a, _mm256_set1_epi32(k));
#define SLV_ADD(a, b) a = _mm256_add_ps(a, b);
#define SLV_FNMA(a, b, c) a = _mm256_fnmadd_ps(b, c, a);
#define SLV_MULTIPLY(a, b, c) a = _mm256_mul_ps(b, c);
#define SLV_DIVIDE(a, b, c) a = _mm256_div_ps(b, c);
#define SLV_BELOW(a, k) \
    a = _mm256_and_ps(a, _mm256_castsi256_ps(_mm256_cmpgt_epi32( \
                             _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32(k))));
#define SLV_AHEAD 1
#define SLV_TILES 2
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_EXPAND(mask, lanes, count) \
    const __m256i order_ = sli_single_expand_index(mask); \
    const __m256 keep_ = _mm256_castsi256_ps(_mm256_cmpgt_epi32(order_, _mm256_set1_epi32(-1))); \
    (void)(lanes);
#define SLV_EXPAND_ADD(to, from) \
    _mm256_store_ps( \
        (to), _mm256_add_ps( \
                  _mm256_load_ps(to), \
                  _mm256_and_ps(_mm256_permutevar8x32_ps(_mm256_loadu_ps(from), order_), keep_)));
#define SLV_VECTOR_TILES 1
#define SLV_LOAD_TILES(a, p, q) SLV_LOAD(a, p)
#define SLV_STORE_TILES(p, q, a) SLV_STORE(p, a)
#define SLV_NAME_PIVOTS SLV_NAME
#define SLV_OWN_PIVOTS
#include "../kernels/front.inl.h"
#include "../kernels/words_undef.inl.h"

#endif

#endif
