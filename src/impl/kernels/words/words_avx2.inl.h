/* words_avx2.inl.h: the vocabulary SLV_ in AVX2 and FMA: a vector of 8 doubles is two registers */

#define SLV_NAME(f) sli_##f##_avx2
#define SLV_ISA SL_ISA_AVX2
#define SLV_WIDTH 4
#define SLV_FUNCTION SLI_TARGET("avx2,fma")
#define SLV_FNMA1(a, b, c) SLI_FNMA1(a, b, c)
#define SLV_DECLARE(a) __m256d a##_0, a##_1;
#define SLV_ZERO(a) a##_0 = a##_1 = _mm256_setzero_pd();
#define SLV_LOAD(a, p) a##_0 = _mm256_load_pd(p), a##_1 = _mm256_load_pd((p) + 4);
#define SLV_STORE(p, a) _mm256_store_pd((p), a##_0), _mm256_store_pd((p) + 4, a##_1);
#define SLV_STREAM(p, a) _mm256_stream_pd((p), a##_0), _mm256_stream_pd((p) + 4, a##_1);
#define SLV_STREAM_END _mm_sfence();
#define SLV_ADD(a, b) a##_0 = _mm256_add_pd(a##_0, b##_0), a##_1 = _mm256_add_pd(a##_1, b##_1);
/* The first 4 of 8 values. */
#define SLV_READ_0(l) _mm256_load_pd(l)
#define SLV_READ_1(l) _mm256_cvtps_pd(_mm_load_ps(l))
#define SLV_WIDEN_ROWS(v, l, rows) \
    { \
        _mm256_store_pd((v), _mm256_cvtps_pd(_mm_load_ps(l))); \
        if ((rows) > 4) { \
            _mm256_store_pd((v) + 4, _mm256_cvtps_pd(_mm_load_ps((l) + 4))); \
        } \
    }
#define SLV_AXPY(a, l, p) \
    { \
        const __m256d s_ = _mm256_broadcast_sd(p); \
        a##_0 = _mm256_fnmadd_pd(SLV_READ(l), s_, a##_0); \
        a##_1 = _mm256_fnmadd_pd(SLV_READ((l) + 4), s_, a##_1); \
    }
#define SLV_DOT(a, l, v) \
    a##_0 = _mm256_fnmadd_pd(SLV_READ(l), v##_0, a##_0), \
    a##_1 = _mm256_fnmadd_pd(SLV_READ((l) + 4), v##_1, a##_1);
#define SLV_STORE_ANY(p, a) _mm256_storeu_pd((p), a##_0), _mm256_storeu_pd((p) + 4, a##_1);
#define SLV_TURN(a, b) \
    a##_0 = _mm256_addsub_pd(_mm256_setzero_pd(), _mm256_permute_pd(b##_0, 5)), \
    a##_1 = _mm256_addsub_pd(_mm256_setzero_pd(), _mm256_permute_pd(b##_1, 5));
#define SLV_TURN_BACK(a, b) \
    a##_0 = _mm256_permute_pd(_mm256_addsub_pd(_mm256_setzero_pd(), b##_0), 5), \
    a##_1 = _mm256_permute_pd(_mm256_addsub_pd(_mm256_setzero_pd(), b##_1), 5);
#define SLV_FNMA(a, b, c) \
    a##_0 = _mm256_fnmadd_pd(b##_0, c##_0, a##_0), a##_1 = _mm256_fnmadd_pd(b##_1, c##_1, a##_1);
#define SLV_LOAD_PART(a, p, count, rest) \
    a##_0 = sli_load_part((p), (count), (rest)), a##_1 = sli_load_part((p) + 4, (count)-4, (rest));
#define SLV_FIRST(a, count) \
    a##_0 = _mm256_andnot_pd(sli_lanes_from(count), a##_0), \
    a##_1 = _mm256_andnot_pd(sli_lanes_from((count)-4), a##_1);
#define SLV_LANE(b, a, k) \
    b##_0 = b##_1 = _mm256_permute4x64_pd((k) < 4 ? a##_0 : a##_1, (k) % 4 * 0x55);
#define SLV_GATHER(a, x, at) \
    a##_0 = _mm256_set_pd((x)[at(3)], (x)[at(2)], (x)[at(1)], (x)[at(0)]), \
    a##_1 = _mm256_set_pd((x)[at(7)], (x)[at(6)], (x)[at(5)], (x)[at(4)]);
/* One register with 4 partial sums for each column: two would leave none for L. */
#define SLV_SUM_DECLARE(a) __m256d a;
#define SLV_SUM_ZERO(a) a = _mm256_setzero_pd();
#define SLV_SUM_LOAD(a, p) a = _mm256_load_pd(p);
#define SLV_SUM_STORE(p, a) _mm256_store_pd((p), a);
#define SLV_SUM_DOT(a, l, v) \
    a = _mm256_fnmadd_pd(SLV_READ(l), v##_0, a); \
    a = _mm256_fnmadd_pd(SLV_READ((l) + 4), v##_1, a);
#define SLV_SUM_4(a, b, c, d) \
    _mm256_add_pd(_mm256_permute2f128_pd(_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d), 0x20), \
                  _mm256_permute2f128_pd(_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d), 0x31))
#define SLV_SUMS(r, a) \
    r##_0 = SLV_SUM_4(a##0, a##1, a##2, a##3), r##_1 = SLV_SUM_4(a##4, a##5, a##6, a##7);
#define SLV_TRANSPOSE_4(to, from) \
    { \
        const __m256d a_ = _mm256_load_pd(from), b_ = _mm256_load_pd((from) + 8); \
        const __m256d c_ = _mm256_load_pd((from) + 16), d_ = _mm256_load_pd((from) + 24); \
        const __m256d e_ = _mm256_unpacklo_pd(a_, b_), f_ = _mm256_unpackhi_pd(a_, b_); \
        const __m256d g_ = _mm256_unpacklo_pd(c_, d_), h_ = _mm256_unpackhi_pd(c_, d_); \
        _mm256_store_pd((to), _mm256_permute2f128_pd(e_, g_, 0x20)); \
        _mm256_store_pd((to) + 8, _mm256_permute2f128_pd(f_, h_, 0x20)); \
        _mm256_store_pd((to) + 16, _mm256_permute2f128_pd(e_, g_, 0x31)); \
        _mm256_store_pd((to) + 24, _mm256_permute2f128_pd(f_, h_, 0x31)); \
    }
#define SLV_TRANSPOSE(to, from) \
    SLV_TRANSPOSE_4(to, from) \
    SLV_TRANSPOSE_4((to) + 4, (from) + 32) \
    SLV_TRANSPOSE_4((to) + 32, (from) + 4) \
    SLV_TRANSPOSE_4((to) + 36, (from) + 36)
/* A block is one vector and half of another, three registers: three row tiles are two blocks. With
 * one vector the FMAs of a register wait for each other. */
#define SLV_HAS_HALF
#define SLV_HALF_DECLARE(a) __m256d a;
#define SLV_HALF_ZERO(a) a = _mm256_setzero_pd();
#define SLV_HALF_LOAD(a, p) a = _mm256_load_pd(p);
#define SLV_HALF_LOAD_PINNED(a, p) \
    a = _mm256_load_pd(p); \
    SLI_PIN(a);
#define SLV_HALF_STORE(p, a) _mm256_store_pd((p), a);
#define SLV_HALF_LOAD_TILES(a, p, q) SLV_HALF_LOAD(a, p)
#define SLV_HALF_STORE_TILES(p, q, a) SLV_HALF_STORE(p, a)
#define SLV_HALF_FNMA(a, b, c) a = _mm256_fnmadd_pd(b, c##_0, a);
#define SLV_HALF_ADD(a, b) a = _mm256_add_pd(a, b);
#define SLV_HALF_TURN_BACK(a, b) \
    a = _mm256_permute_pd(_mm256_addsub_pd(_mm256_setzero_pd(), b), 5);
#define SLV_AHEAD 1
#define SLV_TILES 3
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) \
    a##_0 = _mm256_load_pd(p); \
    a##_1 = _mm256_load_pd((p) + 4); \
    SLI_PIN(a##_0); /* used 4 times */ \
    SLI_PIN(a##_1);
#define SLV_BROADCAST(b, p) b##_0 = b##_1 = _mm256_broadcast_sd(p);
#define SLV_MULTIPLY(a, b, c) \
    a##_0 = _mm256_mul_pd(b##_0, c##_0), a##_1 = _mm256_mul_pd(b##_1, c##_1);
#define SLV_DIVIDE(a, b, c) \
    a##_0 = _mm256_div_pd(b##_0, c##_0), a##_1 = _mm256_div_pd(b##_1, c##_1);
#define SLV_BELOW(a, k) \
    a##_0 = _mm256_and_pd(a##_0, sli_lanes_from((k) + 1)), \
    a##_1 = _mm256_and_pd(a##_1, sli_lanes_from((k)-3));
#define SLV_EXPAND(mask, lanes, count) \
    const __m256i low_ = sli_expand_index((mask)&15u), high_ = sli_expand_index((mask) >> 4); \
    const __m256d keep_low_ = sli_expand_keep(low_), keep_high_ = sli_expand_keep(high_); \
    const ptrdiff_t second_ = sli_count4((mask)&15u); \
    (void)(lanes);
#define SLV_EXPAND_ADD(to, from) \
    _mm256_store_pd((to), _mm256_add_pd(_mm256_load_pd(to), \
                                        sli_expand_4(_mm256_loadu_pd(from), low_, keep_low_))); \
    _mm256_store_pd((to) + 4, _mm256_add_pd(_mm256_load_pd((to) + 4), \
                                            sli_expand_4(_mm256_loadu_pd((from) + second_), high_, \
                                                         keep_high_)));
#define SLV_REPEAT_ROWS(t, l, k) \
    { \
        const __m256d l_ = SLV_READ((l) + 4 * (k)); \
        t##_0 = _mm256_permute4x64_pd(l_, 0x50); \
        t##_1 = _mm256_permute4x64_pd(l_, 0xfa); \
    }
#define SLV_REPEAT(b, p) \
    b##_0 = b##_1 = _mm256_broadcast_pd((const __m128d *)(const void *)(p));
#define SLV_VECTOR_TILES 1
#define SLV_LOAD_TILES(a, p, q) SLV_LOAD(a, p)
#define SLV_STORE_TILES(p, q, a) SLV_STORE(p, a)
#define SLV_NAME_SHORT SLV_NAME
#define SLV_OWN_SHORT
#define SLV_OWN_ROUND
