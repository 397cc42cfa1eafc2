/* lanes_array.inl.h: a row of right-hand sides as an array, for plain C */

#define SLW_ROWS 4
#define SLW_DECLARE(a) double a[SLW_LANES];
#define SLW_ZERO(a) memset(a, 0, sizeof a);
#define SLW_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLW_STORE(p, a) memcpy((p), a, sizeof a);
#define SLW_FNMA(a, s, b)                                                                          \
    {                                                                                              \
        const double s_ = (s);                                                                     \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] -= s_ * b[i_];                                                                   \
        }                                                                                          \
    }
#define SLW_ADD(a, b)                                                                              \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] += b[i_];                                                                        \
        }                                                                                          \
    }
#define SLW_DIVIDE(a, s)                                                                           \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] /= (s);                                                                          \
        }                                                                                          \
    }
#include "lanes.inl.h"
