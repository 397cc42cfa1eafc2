/* lanes_avx512.inl.h: the vocabulary SLW_ in AVX-512F, for SLW_NRHS right-hand sides */

/* Eight, then 16 and groups of 16; four and two are those of AVX2. */
#if SLW_PASS == 1
#define SLW_NRHS 8
#define SLW_TWO
#if SLV_SINGLE || SLV_COMPLEX /* no copies by width, to keep the object small */
#define SLW_GROUPS 8
#endif
#elif SLW_PASS == 2
#define SLW_NRHS 16
#define SLW_GROUPS 64
#define SLW_LAST
#endif

#if SLW_NRHS == 8 /* one register */
#define SLW_NAME(f) sli_##f##8_avx512
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m512d a;
#define SLW_ZERO(a) a = _mm512_setzero_pd();
#define SLW_LOAD(a, p) a = _mm512_loadu_pd(p);
#define SLW_STORE(p, a) _mm512_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm512_fnmadd_pd(SLV_SPREAD(s), b, a);
#define SLW_ADD(a, b) a = _mm512_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm512_div_pd(a, _mm512_set1_pd(s));
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#elif SLW_NRHS == 16 /* two registers */
/* An entry of L that is broadcast serves two FMAs, so that loads no longer limit the rate. */
#define SLW_NAME(f) sli_##f##16_avx512
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m512d a##_0, a##_1;
#define SLW_ZERO(a) a##_0 = a##_1 = _mm512_setzero_pd();
#define SLW_LOAD(a, p) a##_0 = _mm512_loadu_pd(p), a##_1 = _mm512_loadu_pd((p) + 8);
#define SLW_STORE(p, a) _mm512_storeu_pd((p), a##_0), _mm512_storeu_pd((p) + 8, a##_1);
#define SLW_FNMA(a, s, b) \
    { \
        const __m512d s_ = SLV_SPREAD(s); \
        a##_0 = _mm512_fnmadd_pd(s_, b##_0, a##_0); \
        a##_1 = _mm512_fnmadd_pd(s_, b##_1, a##_1); \
    }
#define SLW_ADD(a, b) a##_0 = _mm512_add_pd(a##_0, b##_0), a##_1 = _mm512_add_pd(a##_1, b##_1);
#define SLW_DIVIDE(a, s) \
    a##_0 = _mm512_div_pd(a##_0, _mm512_set1_pd(s)), \
    a##_1 = _mm512_div_pd(a##_1, _mm512_set1_pd(s));
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#endif
