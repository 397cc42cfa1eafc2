/* simd_avx512_single.h: the kernels of fronts in float in AVX-512F: a register has 16 lanes */
#ifndef SLI_FLOAT_SIMD_AVX512_SINGLE_H
#define SLI_FLOAT_SIMD_AVX512_SINGLE_H

#include "simd_avx2_single.h"
#include "../kernels/dispatch.h"

#if defined(SLI_X86) && !defined(SL_NO_AVX512)

/* A register holds a column of two row tiles. Pivots are those of one tile: both halves are the
 * same, and the first one is stored. Intrinsics have a mask of ones because g++ 12 warns of the
 * undefined source of those without. */
#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLV_NAME(f) sli_single_##f##_avx512
#define SLV_NAME_PIVOTS(f) sli_single_##f##_avx2
#define SLV_FUNCTION SLI_TARGET("avx512f,avx2,fma")

/* Half a register, as the instructions for it take doubles. */
#define SLV_HALF(p) _mm256_castps_pd(_mm256_load_ps(p))
#define SLV_HALF_OF(a, k) \
    _mm256_castpd_ps(_mm512_maskz_extractf64x4_pd(0xf, _mm512_castps_pd(a), k))

#define SLV_DECLARE(a) __m512 a;
#define SLV_ZERO(a) a = _mm512_setzero_ps();
#define SLV_LOAD(a, p) a = _mm512_castpd_ps(_mm512_maskz_broadcast_f64x4(0xff, SLV_HALF(p)));
#define SLV_STORE(p, a) _mm256_store_ps((p), SLV_HALF_OF(a, 0));
#define SLV_VECTOR_TILES 2
#define SLV_LOAD_TILES(a, p, q) \
    a = _mm512_castpd_ps( \
        _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(SLV_HALF(p)), SLV_HALF(q), 1));
#define SLV_STORE_TILES(p, q, a) \
    SLV_STORE(p, a) \
    _mm256_store_ps((q), SLV_HALF_OF(a, 1));
#define SLV_BROADCAST(b, p) b = _mm512_set1_ps(*(p));
#define SLV_LANE(b, a, k) b = _mm512_maskz_permutexvar_ps(0xffff, _mm512_set1_epi32(k), a);
#define SLV_ADD(a, b) a = _mm512_add_ps(a, b);
#define SLV_FNMA(a, b, c) a = _mm512_fnmadd_ps(b, c, a);
#define SLV_MULTIPLY(a, b, c) a = _mm512_mul_ps(b, c);
#define SLV_DIVIDE(a, b, c) a = _mm512_div_ps(b, c);
#define SLV_BELOW(a, k) a = _mm512_maskz_mov_ps((__mmask16)((0xfe << (k)&0xff) * 0x101), a);
#define SLV_AHEAD 4
#define SLV_TILES 4
#define SLV_COLUMNS 8
#define SLV_EACH_COLUMN SLI_EACH8
#define SLV_EXPAND(mask, lanes, count) \
    const __mmask16 expand_ = (__mmask16)(mask); \
    const __m512i order_ = _mm512_maskz_expand_epi32( \
        expand_, _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0)); \
    (void)(lanes);
#define SLV_EXPAND_ADD(to, from) \
    _mm256_store_ps( \
        (to), _mm256_add_ps( \
                  _mm256_load_ps(to), \
                  SLV_HALF_OF(_mm512_maskz_permutexvar_ps( \
                                  expand_, order_, _mm512_castps256_ps512(_mm256_loadu_ps(from))), \
                              0)));
#include "../kernels/front.inl.h"
#include "../kernels/words_undef.inl.h"
#undef SLV_HALF
#undef SLV_HALF_OF

#endif

#endif
