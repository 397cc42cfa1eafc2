/* words_scalar.inl.h: the vocabulary SLV_ in plain C: a vector is an array */

#define SLV_NAME(f) sli_##f##_scalar
#define SLV_ISA SL_ISA_SCALAR
#define SLV_WIDTH 1
#define SLV_FUNCTION
#define SLV_FNMA1(a, b, c) ((c) - (a) * (b)) /* c - a b */
#define SLV_DECLARE(a) double a[SLI_TILE];
#define SLV_ZERO(a) SLI_LOOP(SLI_TILE, a[i_] = 0.0)
#define SLV_LOAD(a, p) memcpy(a, (p), SLI_TILE * sizeof(double));
#define SLV_STORE(p, a) memcpy((p), a, SLI_TILE * sizeof(double));
#define SLV_STORE_ANY(p, a) SLV_STORE(p, a)
#define SLV_TURN_ALL(a, b, re, im) \
    { \
        sl_int i_; \
        for (i_ = 0; i_ < SLI_TILE; i_ += 2) { \
            const double re_ = b[i_]; \
            a[i_] = re b[i_ + 1]; \
            a[i_ + 1] = im re_; \
        } \
    }
#define SLV_TURN(a, b) SLV_TURN_ALL(a, b, -, +)
#define SLV_TURN_BACK(a, b) SLV_TURN_ALL(a, b, +, -)
#define SLV_WIDEN_ROWS(v, l, rows) SLI_LOOP(rows, (v)[i_] = (l)[i_])
#define SLV_ADD(a, b) SLI_LOOP(SLI_TILE, a[i_] += b[i_])
#define SLV_AXPY(a, l, p) \
    { \
        const double s_ = *(p); \
        SLI_LOOP(SLI_TILE, a[i_] -= (l)[i_] * s_) \
    }
#define SLV_DOT(a, l, v) SLI_LOOP(SLI_TILE, a[i_] -= (l)[i_] * v[i_])
#define SLV_LOAD_PART(a, p, count, rest) \
    { \
        double part_[SLI_TILE]; \
        SLI_LOOP(SLI_TILE, part_[i_] = (rest)) \
        SLI_LOOP(count, part_[i_] = (p)[i_]) \
        memcpy(a, part_, sizeof part_); \
    }
#define SLV_FIRST(a, count) \
    { \
        double part_[SLI_TILE]; \
        SLI_LOOP(SLI_TILE, part_[i_] = 0.0) \
        SLI_LOOP(count, part_[i_] = a[i_]) \
        memcpy(a, part_, sizeof part_); \
    }
#define SLV_LANE(b, a, k) SLI_LOOP(SLI_TILE, b[i_] = a[k])
#define SLV_GATHER(a, x, at) SLI_LOOP(SLI_TILE, a[i_] = (x)[at(i_)])
#define SLV_SUM_DECLARE(a) double a;
#define SLV_SUM_ZERO(a) a = 0.0;
#define SLV_SUM_LOAD(a, p) a = *(p);
#define SLV_SUM_STORE(p, a) *(p) = a;
#define SLV_SUM_DOT(a, l, v) \
    a -= ((l)[0] * v[0] + (l)[1] * v[1]) + ((l)[2] * v[2] + (l)[3] * v[3]) + \
         (((l)[4] * v[4] + (l)[5] * v[5]) + ((l)[6] * v[6] + (l)[7] * v[7]));
#define SLV_SUMS(r, a) \
    r[0] = a##0, r[1] = a##1, r[2] = a##2, r[3] = a##3; \
    r[4] = a##4, r[5] = a##5, r[6] = a##6, r[7] = a##7;
#define SLV_TRANSPOSE(to, from) \
    { \
        int i_, k_; \
        for (i_ = 0; i_ < SLI_TILE; i_++) { \
            for (k_ = 0; k_ < SLI_TILE; k_++) { \
                (to)[SLI_TILE * i_ + k_] = (from)[SLI_TILE * k_ + i_]; \
            } \
        } \
    }
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_FNMA(a, b, c) SLI_LOOP(SLI_TILE, a[i_] -= b[i_] * c[i_])
#define SLV_BROADCAST(b, p) SLI_LOOP(SLI_TILE, b[i_] = *(p))
#define SLV_MULTIPLY(a, b, c) SLI_LOOP(SLI_TILE, a[i_] = b[i_] * c[i_])
#define SLV_DIVIDE(a, b, c) SLI_LOOP(SLI_TILE, a[i_] = b[i_] / c[i_])
#define SLV_BELOW(a, k) SLI_LOOP((k) + 1, a[i_] = 0.0)
#define SLV_EXPAND SLI_EXPAND_PLAIN
#define SLV_EXPAND_ADD SLI_EXPAND_ADD_PLAIN
#define SLV_STREAM(p, a) SLV_STORE(p, a)
#define SLV_STREAM_END
#define SLV_VECTOR_TILES 1
#define SLV_LOAD_TILES(a, p, q) SLV_LOAD(a, p)
#define SLV_STORE_TILES(p, q, a) SLV_STORE(p, a)
#define SLV_NAME_SHORT SLV_NAME
#define SLV_OWN_SHORT
#define SLV_PLAIN
#if defined(SLI_SIMD) /* few processors there run plain C */
#define SLV_ARRAYS
#endif
