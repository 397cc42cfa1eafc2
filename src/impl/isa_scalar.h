/* isa_scalar.h: the kernels in plain C: an octet is an array */
#ifndef SLI_ISA_SCALAR_H
#define SLI_ISA_SCALAR_H

#include "kernels.h"

#define SLV_NAME(f) sli_##f##_scalar
#define SLV_ISA SL_ISA_SCALAR
#define SLV_FUNCTION
#define SLV_FNMA1(a, b, c) ((c) - (a) * (b)) /* c - a b */
#define SLV_DECLARE(a) double a[SLI_TILE];
#define SLV_ZERO(a)                                                                                \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = 0.0;                                                                           \
        }                                                                                          \
    }
#define SLV_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLV_STORE(p, a) memcpy((p), a, sizeof a);
#define SLV_ADD(a, b)                                                                              \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] += b[i_];                                                                        \
        }                                                                                          \
    }
#define SLV_AXPY(a, l, p)                                                                          \
    {                                                                                              \
        const double s_ = *(p);                                                                    \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] -= (l)[i_] * s_;                                                                 \
        }                                                                                          \
    }
#define SLV_DOT(a, l, v)                                                                           \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] -= (l)[i_] * v[i_];                                                              \
        }                                                                                          \
    }
#define SLV_SUM(a) (((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7])))
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_FNMA(a, b, c) \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] -= b[i_] * c[i_]; \
        }                                                                                          \
    }
#define SLV_BROADCAST(b, p) \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            b[i_] = *(p); \
        }                                                                                          \
    }
#define SLV_MULTIPLY(a, b, c) \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = b[i_] * c[i_]; \
        }                                                                                          \
    }
#define SLV_DIVIDE(a, b, c) \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = b[i_] / c[i_]; \
        }                                                                                          \
    }
#define SLV_BELOW(a, k) \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = i_ > (k) ? a[i_] : 0.0; \
        }                                                                                          \
    }
#define SLV_SPREAD(mask, lanes, count)                                                             \
    const sl_int *lanes_ = (lanes), count_ = (count);                                              \
    (void)(mask);
#define SLV_SPREAD_ADD(to, from)                                                                   \
    {                                                                                              \
        double *to_ = (to);                                                                        \
        const double *from_ = (from);                                                              \
        sl_int i_;                                                                                 \
        for (i_ = 0; i_ < count_; i_++) {                                                          \
            to_[lanes_[i_]] += from_[i_];                                                          \
        }                                                                                          \
    }
/* arrays gain nothing from spreading L: two right-hand sides go the way of four */
#define SLW_NAME(f) sli_##f##2_scalar
#define SLW_LANES 2
#include "lanes_array.inl.h"

#define SLW_NAME(f) sli_##f##4_scalar
#define SLW_LANES 4
#include "lanes_array.inl.h"

#define SLW_NAME(f) sli_##f##8_scalar
#define SLW_LANES 8
#include "lanes_array.inl.h"

#include "tile.inl.h"

#include "product.inl.h"

#include "front.inl.h"

#include "body.inl.h"

#include "words_end.inl.h"

#endif
