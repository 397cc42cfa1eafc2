/* lanes_scalar.inl.h: the vocabulary SLW_ in plain C, for SLW_NRHS right-hand sides */

/* One pass for all numbers of right-hand sides, in groups of two: arrays gain nothing from
 * copies. */
#if SLW_PASS == 1
#define SLW_NRHS 2
#define SLW_GROUPS 64
#define SLW_LAST
#endif

#if SLW_NRHS == 2
#define SLW_NAME(f) sli_##f##2_scalar
#else
#define SLW_NAME(f) sli_##f##8_scalar
#endif
#define SLW_ROWS 4
#define SLW_DECLARE(a) double a[SLW_NRHS];
#define SLW_ZERO(a) memset(a, 0, sizeof a);
#define SLW_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLW_STORE(p, a) memcpy((p), a, sizeof a);
#define SLW_FNMA(a, s, b) \
    { \
        const double s_ = (s); \
        SLI_LOOP(SLW_NRHS, a[i_] -= s_ * b[i_]) \
    }
#define SLW_ADD(a, b) SLI_LOOP(SLW_NRHS, a[i_] += b[i_])
#define SLW_DIVIDE(a, s) SLI_LOOP(SLW_NRHS, a[i_] /= (s))
#define SLW_EACH SLI_EACH4
#define SLW_EACH_AGAIN SLI_EACH4_AGAIN
#define SLW_HIGH SLI_HIGH4
#define SLW_LOW SLI_LOW4
