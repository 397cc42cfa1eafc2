/* multi_rhs_small.inl.h: several right-hand sides through a supernode of at most 8 columns */

#if !defined(SLW_HALF)
/* A supernode of 1 to 8 columns. The rows of its columns stay in registers; the rows below are read
 * one after another. */
#define SLI_LOAD_OWN(k, p) \
    if (SLI_IS_IN(k, w)) { \
        SLW_LOAD(a##k, (p) + (k)*stride) \
    }
#define SLI_STORE_OWN(k, p) \
    if (SLI_IS_IN(k, w)) { \
        SLW_STORE((p) + (k)*stride, a##k) \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_PREFETCH_OWN(k, bytes) \
    if (SLI_IS_IN(k, w)) { \
        SLV_PREFETCH(l, k, bytes) \
    }
#define SLI_DOWN_OWN(r, k) \
    if ((r) > (k) && (r) < w) { \
        SLW_FNMA(a##r, v[SLI_TILE * (k) + (r)], a##k) \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused) \
    if (SLI_IS_IN(k, w)) { \
        SLW_FNMA(b, v[SLI_TILE * (k) + lane], a##k) \
    }

/* Where the width is not a constant, compilers warn of columns that they think are used. */
#if defined(SLW_GROUPS) && SLV_SINGLE && !defined(SLW_TAKES_FLOATS)
#define SLI_CLEAR_WIDE memset(v, 0, sizeof v);
#else
#define SLI_CLEAR_WIDE
#endif

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_SWEEP(small_forward)(const sl_int w, sli_rows below,
                                                             const SLV_VALUE *l, double *xs,
                                                             double *x) {
    const sl_int stride = below.lanes;
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_DECLARE(c)
    SLW_ENTRIES(v, SLI_TILE)
    SLI_CLEAR_WIDE
    SLW_SET_ENTRIES(v, l, w, SLI_TILE)
    SLW_EACH(SLI_PREFETCH_OWN, SLI_PREFETCH_DISTANCE)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below.count; lane++, i++) { /* x(i) -= the sum of L(i, j) x(j) */
        double *to = x + (ptrdiff_t)below.index[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_SET_ENTRIES(v, l, w, SLI_TILE)
            SLW_EACH(SLI_PREFETCH_OWN, SLI_PREFETCH_DISTANCE)
        }
        SLW_ZERO(b)
        SLW_LOAD(c, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_ADD(c, b)
        SLW_STORE(to, c)
    }
}

#define SLI_UP_OWN(j, k) \
    if ((j) < (k) && (k) < w) { \
        SLW_FNMA(a##j, v[SLI_TILE * (j) + (k)], a##k) \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused) \
    if (SLI_IS_IN(k, w)) { \
        SLW_FNMA(a##k, v[SLI_TILE * (k) + lane], b) \
    }
#define SLI_DIVIDE_OWN(k, unused) \
    if (SLI_IS_IN(k, w)) { \
        SLW_LOAD(b, xs + (k)*stride) \
        if (SLW_NRHS > 2 || d != NULL) { \
            SLW_DIVIDE(b, d[k]) \
        } \
        SLW_ADD(a##k, b) \
    }

/* l: the last tile of the panel. d may be NULL for 2 right-hand sides: D has divided x already. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_SWEEP(small_backward)(const sl_int w, sli_rows below,
                                                              const SLV_VALUE *l, const double *d,
                                                              double *xs, const double *x) {
    const sl_int stride = below.lanes;
    sl_int i = below.count - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_ENTRIES(v, SLI_TILE)
    SLI_CLEAR_WIDE
    SLW_SET_ENTRIES(v, l, w, SLI_TILE)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
    SLW_LOW(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_SET_ENTRIES(v, l, w, SLI_TILE)
            SLW_HIGH(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
            SLW_LOW(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
        }
        SLW_LOAD(b, x + (ptrdiff_t)below.index[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below.count > 0) {
        l -= SLI_TILE * w;
        SLW_SET_ENTRIES(v, l, w, SLI_TILE)
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_SWEEP(small_forward)(k, below, l, xs, x)
#define SLI_BACKWARD(k) SLW_SWEEP(small_backward)(k, below, l, d, xs, x)
/* Without copies for the commonest widths, 8 right-hand sides, two groups of 4 with AVX2, take 1.07
 * of the time on a grid of 2,500 rows; with copies for all widths, 3 kB more, 0.98. */
#if SLW_NRHS == 4 && !SLV_SINGLE
#define SLI_BY_WIDTH(call) \
    switch (w) { \
        SLI_CASE(2, call) \
        SLI_CASE(3, call) \
        SLI_CASE(4, call) \
    default: \
        call(w); \
    }
#else
#define SLI_BY_WIDTH(call) call(w)
#endif

SLI_AT_LINE SLV_FUNCTION static void
SLW_SWEEP(forward_small)(sl_int w, sli_rows below, const SLV_VALUE *l, double *xs, double *x) {
    SLI_BY_WIDTH(SLI_FORWARD);
}

SLI_AT_LINE SLV_FUNCTION static void SLW_SWEEP(backward_small)(sl_int w, sli_rows below,
                                                               const SLV_VALUE *l, const double *d,
                                                               double *xs, const double *x) {
    SLI_BY_WIDTH(SLI_BACKWARD);
}

#undef SLI_FORWARD
#undef SLI_BACKWARD
#undef SLI_BY_WIDTH
#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_PREFETCH_OWN
#undef SLI_DOWN_OWN
#undef SLI_COLUMN_OWN
#undef SLI_BELOW_OWN
#undef SLI_UP_OWN
#undef SLI_ROW_OWN
#undef SLI_ABOVE_OWN
#undef SLI_DIVIDE_OWN
#undef SLI_CLEAR_WIDE
#else
/* First one half of the right-hand sides, then the other. */
SLV_FUNCTION SLI_INLINE void SLW_SWEEP(forward_small)(sl_int w, sli_rows below, const SLV_VALUE *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_NRHS / 2;
    SLW_SWEEP_HALF(forward_small)(w, below, l, xs, x);
    SLW_SWEEP_HALF(forward_small)(w, below, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_SWEEP(backward_small)(sl_int w, sli_rows below, const SLV_VALUE *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_NRHS / 2;
    SLW_SWEEP_HALF(backward_small)(w, below, l, d, xs, x);
    SLW_SWEEP_HALF(backward_small)(w, below, l, d, xs + half, x + half);
}
#endif
