/* lanes_avx2.inl.h: the vocabulary SLW_ in AVX2 and FMA, for SLW_NRHS right-hand sides */

/* Four, then two, then eight and groups of eight. Of complex matrices all take groups. */
#if SLW_PASS == 1
#define SLW_NRHS 4
#if SLV_COMPLEX
#define SLW_GROUPS 64
#endif
#elif SLW_PASS == 2
#define SLW_NRHS 2
#if SLV_COMPLEX
#define SLW_GROUPS 2
#define SLW_LAST
#else
#define SLW_TWO
#endif
#elif SLW_PASS == 3
#define SLW_NRHS 8
#define SLW_GROUPS 64
#define SLW_LAST
#endif

#if SLW_NRHS == 2 /* half a register */
#define SLW_NAME(f) sli_##f##2_avx2
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m128d a;
#define SLW_ZERO(a) a = _mm_setzero_pd();
#define SLW_LOAD(a, p) a = _mm_loadu_pd(p);
#define SLW_STORE(p, a) _mm_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm_fnmadd_pd(_mm_set1_pd(s), b, a);
#define SLW_ADD(a, b) a = _mm_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm_div_pd(a, _mm_set1_pd(s));
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#elif SLW_NRHS == 4 /* one register */
#define SLW_NAME(f) sli_##f##4_avx2
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m256d a;
#define SLW_ZERO(a) a = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a = _mm256_loadu_pd(p);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm256_fnmadd_pd(_mm256_broadcast_sd(&(s)), b, a);
#define SLW_ADD(a, b) a = _mm256_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm256_div_pd(a, _mm256_set1_pd(s));
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#elif SLW_NRHS == 8 /* two registers */
#define SLW_NAME(f) sli_##f##8_avx2
#define SLW_HALF(f) sli_##f##4_avx2
#define SLW_ROWS 4
#define SLW_DECLARE(a) __m256d a##_0, a##_1;
#define SLW_ZERO(a) a##_0 = a##_1 = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a##_0 = _mm256_loadu_pd(p), a##_1 = _mm256_loadu_pd((p) + 4);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a##_0), _mm256_storeu_pd((p) + 4, a##_1);
#define SLW_FNMA(a, s, b) \
    { \
        const __m256d s_ = _mm256_broadcast_sd(&(s)); \
        a##_0 = _mm256_fnmadd_pd(s_, b##_0, a##_0); \
        a##_1 = _mm256_fnmadd_pd(s_, b##_1, a##_1); \
    }
#define SLW_ADD(a, b) a##_0 = _mm256_add_pd(a##_0, b##_0), a##_1 = _mm256_add_pd(a##_1, b##_1);
#define SLW_DIVIDE(a, s) \
    a##_0 = _mm256_div_pd(a##_0, _mm256_set1_pd(s)), \
    a##_1 = _mm256_div_pd(a##_1, _mm256_set1_pd(s));
#define SLW_EACH SLI_EACH4
#define SLW_EACH_AGAIN SLI_EACH4_AGAIN
#define SLW_HIGH SLI_HIGH4
#define SLW_LOW SLI_LOW4
#endif
