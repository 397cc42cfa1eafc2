/* lanes_neon.inl.h: the vocabulary SLW_ in NEON, for SLW_NRHS right-hand sides */

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

#if SLW_NRHS == 2 /* one register */
#define SLW_NAME(f) sli_##f##2_neon
#define SLW_ROWS 8
#define SLW_DECLARE(a) float64x2_t a;
#define SLW_ZERO(a) a = vdupq_n_f64(0.0);
#define SLW_LOAD(a, p) a = vld1q_f64(p);
#define SLW_STORE(p, a) vst1q_f64((p), a);
#define SLW_FNMA(a, s, b) a = vfmsq_f64(a, vdupq_n_f64(s), b);
#define SLW_ADD(a, b) a = vaddq_f64(a, b);
#define SLW_DIVIDE(a, s) a = vdivq_f64(a, vdupq_n_f64(s));
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#elif SLW_NRHS == 4 /* two registers */
#define SLW_NAME(f) sli_##f##4_neon
#define SLW_ROWS 8
#define SLW_DECLARE(a) float64x2_t a##_0, a##_1;
#define SLW_ZERO(a) a##_0 = a##_1 = vdupq_n_f64(0.0);
#define SLW_LOAD(a, p) a##_0 = vld1q_f64((p) + 0), a##_1 = vld1q_f64((p) + 2);
#define SLW_STORE(p, a) vst1q_f64((p) + 0, a##_0), vst1q_f64((p) + 2, a##_1);
#define SLW_FNMA(a, s, b) \
    { \
        const float64x2_t s_ = vdupq_n_f64(s); \
        a##_0 = vfmsq_f64(a##_0, s_, b##_0); \
        a##_1 = vfmsq_f64(a##_1, s_, b##_1); \
    }
#define SLW_ADD(a, b) a##_0 = vaddq_f64(a##_0, b##_0), a##_1 = vaddq_f64(a##_1, b##_1);
#define SLW_DIVIDE(a, s) \
    { \
        const float64x2_t s_ = vdupq_n_f64(s); \
        a##_0 = vdivq_f64(a##_0, s_); \
        a##_1 = vdivq_f64(a##_1, s_); \
    }
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#elif SLW_NRHS == 8 /* four registers */
#define SLW_NAME(f) sli_##f##8_neon
#define SLW_HALF(f) sli_##f##4_neon
#define SLW_ROWS 4
#define SLW_DECLARE(a) SLV_DECLARE(a)
#define SLW_ZERO(a) SLV_ZERO(a)
#define SLW_LOAD(a, p) SLV_LOAD(a, p)
#define SLW_STORE(p, a) SLV_STORE(p, a)
#define SLW_FNMA(a, s, b) \
    { \
        const float64x2_t s_ = vdupq_n_f64(s); \
        a##_0 = vfmsq_f64(a##_0, s_, b##_0); \
        a##_1 = vfmsq_f64(a##_1, s_, b##_1); \
        a##_2 = vfmsq_f64(a##_2, s_, b##_2); \
        a##_3 = vfmsq_f64(a##_3, s_, b##_3); \
    }
#define SLW_ADD(a, b) SLV_ADD(a, b)
#define SLW_DIVIDE(a, s) \
    { \
        const float64x2_t s_ = vdupq_n_f64(s); \
        a##_0 = vdivq_f64(a##_0, s_); \
        a##_1 = vdivq_f64(a##_1, s_); \
        a##_2 = vdivq_f64(a##_2, s_); \
        a##_3 = vdivq_f64(a##_3, s_); \
    }
#define SLW_EACH SLI_EACH4
#define SLW_EACH_AGAIN SLI_EACH4_AGAIN
#define SLW_HIGH SLI_HIGH4
#define SLW_LOW SLI_LOW4
#endif
