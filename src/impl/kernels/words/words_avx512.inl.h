/* words_avx512.inl.h: the vocabulary SLV_ in AVX-512F: a vector of 8 doubles is one register */

#define SLV_NAME(f) sli_##f##_avx512
/* Kernels of AVX2 do the same operations. 4 right-hand sides are one 256-bit register. One in
 * supernodes of at most 8 columns gains nothing from longer ones. The columns of a tile of pivots
 * wait for each other's divisions, and a longer register divides half as fast. */
#define SLV_NAME_SHORT(f) sli_##f##_avx2
#define SLV_ISA SL_ISA_AVX512
#define SLV_WIDTH 8
#define SLV_FUNCTION SLI_TARGET("avx512f,avx2,fma")
#define SLV_FNMA1(a, b, c) SLI_FNMA1(a, b, c)
#define SLV_DECLARE(a) __m512d a;
#define SLV_ZERO(a) a = _mm512_setzero_pd();
#define SLV_LOAD(a, p) a = _mm512_load_pd(p);
#define SLV_STORE(p, a) _mm512_store_pd((p), a);
#define SLV_STREAM(p, a) _mm512_stream_pd((p), a);
#define SLV_STREAM_END _mm_sfence();
#define SLV_ADD(a, b) a = _mm512_add_pd(a, b);
#define SLV_READ_0(l) _mm512_load_pd(l)
/* With a mask of ones: g++ 12 warns of the undefined source of the plain intrinsic. The instruction
 * is the same. */
#define SLV_READ_1(l) _mm512_maskz_cvtps_pd(0xff, _mm256_load_ps(l))
#define SLV_WIDEN_ROWS(v, l, rows) _mm512_store_pd((v), SLV_READ_1(l));
#define SLV_AXPY(a, l, p) a = _mm512_fnmadd_pd(SLV_READ(l), _mm512_set1_pd(*(p)), a);
#define SLV_DOT(a, l, v) a = _mm512_fnmadd_pd(SLV_READ(l), v, a);
#define SLV_STORE_ANY(p, a) _mm512_storeu_pd((p), a);
#define SLV_SWAP(a) _mm512_maskz_permute_pd(0xff, a, 0x55)
#define SLV_TURN(a, b) \
    a = SLV_SWAP(b), a = _mm512_mask_sub_pd(a, (__mmask8)0x55, _mm512_setzero_pd(), a);
#define SLV_TURN_BACK(a, b) \
    a = SLV_SWAP(b), a = _mm512_mask_sub_pd(a, (__mmask8)0xaa, _mm512_setzero_pd(), a);
#define SLV_FNMA(a, b, c) a = _mm512_fnmadd_pd(b, c, a);
#define SLV_LOAD_PART(a, p, count, rest) \
    a = _mm512_mask_loadu_pd(_mm512_set1_pd(rest), (__mmask8)(0xff >> (8 - (count))), (p));
#define SLV_FIRST(a, count) a = _mm512_maskz_mov_pd((__mmask8)(0xff >> (8 - (count))), a);
#define SLV_LANE(b, a, k) b = _mm512_maskz_permutexvar_pd(0xff, _mm512_set1_epi64(k), a);
#define SLV_GATHER(a, x, at) \
    a = _mm512_set_pd((x)[at(7)], (x)[at(6)], (x)[at(5)], (x)[at(4)], (x)[at(3)], (x)[at(2)], \
                      (x)[at(1)], (x)[at(0)]);
#define SLV_SUM_DECLARE(a) SLV_DECLARE(a)
#define SLV_SUM_ZERO(a) SLV_ZERO(a)
#define SLV_SUM_LOAD(a, p) SLV_LOAD(a, p)
#define SLV_SUM_STORE(p, a) SLV_STORE(p, a)
#define SLV_SUM_DOT(a, l, v) SLV_DOT(a, l, v)
#define SLV_SUM_2(a, b) \
    _mm512_add_pd(_mm512_maskz_unpacklo_pd(0xff, a, b), _mm512_maskz_unpackhi_pd(0xff, a, b))
#define SLV_SUM_4(a, b) \
    _mm512_add_pd(_mm512_maskz_shuffle_f64x2(0xff, a, b, 0x88), \
                  _mm512_maskz_shuffle_f64x2(0xff, a, b, 0xdd))
#define SLV_SUMS(r, a) \
    r = SLV_SUM_4(SLV_SUM_4(SLV_SUM_2(a##0, a##1), SLV_SUM_2(a##2, a##3)), \
                  SLV_SUM_4(SLV_SUM_2(a##4, a##5), SLV_SUM_2(a##6, a##7)));
#define SLV_BLOCKS_EVEN(a, b) _mm512_maskz_shuffle_f64x2(0xff, a, b, 0x88)
#define SLV_BLOCKS_ODD(a, b) _mm512_maskz_shuffle_f64x2(0xff, a, b, 0xdd)
/* Rows i, i + 2, i + 4, i + 6 from pairs of columns; unpack: lo for the even rows, hi for the odd.
 * */
#define SLV_TRANSPOSE_4(to, from, unpack) \
    { \
        const __m512d a_ = unpack(0xff, _mm512_load_pd(from), _mm512_load_pd((from) + 8)); \
        const __m512d b_ = unpack(0xff, _mm512_load_pd((from) + 16), _mm512_load_pd((from) + 24)); \
        const __m512d c_ = unpack(0xff, _mm512_load_pd((from) + 32), _mm512_load_pd((from) + 40)); \
        const __m512d d_ = unpack(0xff, _mm512_load_pd((from) + 48), _mm512_load_pd((from) + 56)); \
        const __m512d e_ = SLV_BLOCKS_EVEN(a_, b_), f_ = SLV_BLOCKS_EVEN(c_, d_); \
        const __m512d g_ = SLV_BLOCKS_ODD(a_, b_), h_ = SLV_BLOCKS_ODD(c_, d_); \
        _mm512_store_pd((to), SLV_BLOCKS_EVEN(e_, f_)); \
        _mm512_store_pd((to) + 16, SLV_BLOCKS_EVEN(g_, h_)); \
        _mm512_store_pd((to) + 32, SLV_BLOCKS_ODD(e_, f_)); \
        _mm512_store_pd((to) + 48, SLV_BLOCKS_ODD(g_, h_)); \
    }
#define SLV_TRANSPOSE(to, from) \
    SLV_TRANSPOSE_4(to, from, _mm512_maskz_unpacklo_pd) \
    SLV_TRANSPOSE_4((to) + 8, from, _mm512_maskz_unpackhi_pd)
#define SLV_AHEAD 2
#define SLV_TILES 2
#define SLV_COLUMNS 8
#define SLV_EACH_COLUMN SLI_EACH8
#define SLV_LOAD_PINNED(a, p) \
    a = _mm512_load_pd(p); \
    SLI_PIN_ANY(a); /* used 8 times */
#define SLV_BROADCAST(b, p) b = _mm512_set1_pd(*(p));
#define SLV_MULTIPLY(a, b, c) a = _mm512_mul_pd(b, c);
#define SLV_DIVIDE(a, b, c) a = _mm512_div_pd(b, c);
#define SLV_BELOW(a, k) a = _mm512_maskz_mov_pd((__mmask8)(0xfe << (k)), a);
/* A permutation that is computed once: the expand instruction takes twice as long. */
#define SLV_EXPAND(mask, lanes, count) \
    const __mmask8 expand_ = (__mmask8)(mask); \
    const __m512i order_ = \
        _mm512_maskz_expand_epi64(expand_, _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0)); \
    (void)(lanes);
#define SLV_EXPAND_ADD(to, from) \
    _mm512_store_pd( \
        (to), _mm512_add_pd(_mm512_load_pd(to), \
                            _mm512_maskz_permutexvar_pd(expand_, order_, _mm512_loadu_pd(from))));
#define SLV_REPEAT_ROWS(t, l, k) \
    t = _mm512_maskz_permutexvar_pd( \
        0xff, \
        _mm512_add_epi64(_mm512_set1_epi64(4 * (k)), _mm512_set_epi64(3, 3, 2, 2, 1, 1, 0, 0)), \
        SLV_READ(l));
#define SLV_REPEAT(b, p) \
    b = _mm512_castps_pd(_mm512_maskz_broadcast_f32x4(0xffff, _mm_castpd_ps(_mm_loadu_pd(p))));

/* Floats are spread and widened in registers: 1.5 times as fast as by way of a copy in memory. */
#define SLW_TAKES_FLOATS
#define SLV_SPREAD_0(s) _mm512_set1_pd(s)
#define SLV_SPREAD_1(s) _mm512_maskz_cvtps_pd(0xff, _mm256_set1_ps(s))
#define SLV_SPREAD(s) SLI_BY_TYPE(SLV_SPREAD_, SLV_SINGLE)(s)
#define SLV_VECTOR_TILES 1
#define SLV_LOAD_TILES(a, p, q) SLV_LOAD(a, p)
#define SLV_STORE_TILES(p, q, a) SLV_STORE(p, a)
