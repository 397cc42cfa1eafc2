/* isa_avx2.h: the kernels in AVX2 and FMA: an octet is two registers */
#ifndef SLI_ISA_AVX2_H
#define SLI_ISA_AVX2_H

#include "kernels.h"

#if defined(SLI_X86)

#define SLV_NAME(f) sli_##f##_avx2
#define SLV_ISA SL_ISA_AVX2
#define SLV_FUNCTION SLI_TARGET("avx2,fma")
#define SLV_FNMA1(a, b, c) __builtin_fma(-(a), b, c) /* c - a b */

SLV_FUNCTION SLI_INLINE double sli_sum4(__m128d low, __m128d high) {
    low = _mm_add_pd(low, high);
    return _mm_cvtsd_f64(_mm_add_sd(low, _mm_unpackhi_pd(low, low)));
}

#define SLV_DECLARE(a) __m256d a##_0, a##_1;
#define SLV_ZERO(a) a##_0 = a##_1 = _mm256_setzero_pd();
#define SLV_LOAD(a, p) a##_0 = _mm256_load_pd(p), a##_1 = _mm256_load_pd((p) + 4);
#define SLV_STORE(p, a) _mm256_store_pd((p), a##_0), _mm256_store_pd((p) + 4, a##_1);
#define SLV_ADD(a, b) a##_0 = _mm256_add_pd(a##_0, b##_0), a##_1 = _mm256_add_pd(a##_1, b##_1);
#define SLV_AXPY(a, l, p)                                                                          \
    {                                                                                              \
        const __m256d s_ = _mm256_broadcast_sd(p);                                                 \
        a##_0 = _mm256_fnmadd_pd(_mm256_load_pd(l), s_, a##_0);                                    \
        a##_1 = _mm256_fnmadd_pd(_mm256_load_pd((l) + 4), s_, a##_1);                              \
    }
#define SLV_DOT(a, l, v)                                                                           \
    a##_0 = _mm256_fnmadd_pd(_mm256_load_pd(l), v##_0, a##_0),                                     \
    a##_1 = _mm256_fnmadd_pd(_mm256_load_pd((l) + 4), v##_1, a##_1);
#define SLV_SUM(a)                                                                                 \
    sli_sum4(_mm256_castpd256_pd128(_mm256_add_pd(a##_0, a##_1)),                                  \
             _mm256_extractf128_pd(_mm256_add_pd(a##_0, a##_1), 1))
#define SLV_STORE_ANY(p, a) _mm256_storeu_pd((p), a##_0), _mm256_storeu_pd((p) + 4, a##_1);
#define SLV_FNMA(a, b, c)                                                                          \
    a##_0 = _mm256_fnmadd_pd(b##_0, c##_0, a##_0), a##_1 = _mm256_fnmadd_pd(b##_1, c##_1, a##_1);
#define SLV_TWICE_AT(e, l)                                                                         \
    {                                                                                              \
        const __m256d l_ = _mm256_load_pd(l);                                                      \
        e##_0 = _mm256_permute4x64_pd(l_, 0x50);                                                   \
        e##_1 = _mm256_permute4x64_pd(l_, 0xfa);                                                   \
    }
#define SLV_TWICE_LOW(e, l) SLV_TWICE_AT(e, l)
#define SLV_TWICE_HIGH(e, l) SLV_TWICE_AT(e, (l) + 4)
#define SLV_PAIR(b, p) b##_0 = b##_1 = _mm256_broadcast_pd((const __m128d *)(const void *)(p));

#define SLW_NAME(f) sli_##f##4_avx2
#include "lanes_ymm.inl.h"

#define SLW_NAME(f) sli_##f##8_avx2
#define SLW_LANES 8
#define SLW_ROWS 4
#define SLW_DECLARE(a) __m256d a##_0, a##_1;
#define SLW_ZERO(a) a##_0 = a##_1 = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a##_0 = _mm256_loadu_pd(p), a##_1 = _mm256_loadu_pd((p) + 4);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a##_0), _mm256_storeu_pd((p) + 4, a##_1);
#define SLW_FNMA(a, s, b)                                                                          \
    {                                                                                              \
        const __m256d s_ = _mm256_broadcast_sd(&(s));                                              \
        a##_0 = _mm256_fnmadd_pd(s_, b##_0, a##_0);                                                \
        a##_1 = _mm256_fnmadd_pd(s_, b##_1, a##_1);                                                \
    }
#define SLW_ADD(a, b) a##_0 = _mm256_add_pd(a##_0, b##_0), a##_1 = _mm256_add_pd(a##_1, b##_1);
#define SLW_DIVIDE(a, s)                                                                           \
    a##_0 = _mm256_div_pd(a##_0, _mm256_set1_pd(s)),                                               \
    a##_1 = _mm256_div_pd(a##_1, _mm256_set1_pd(s));
#include "lanes.inl.h"

#include "tile.inl.h"

#include "pairs.inl.h"

#include "body.inl.h"

#include "words_end.inl.h"

#endif

#endif
