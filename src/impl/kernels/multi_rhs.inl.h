/* multi_rhs.inl.h: sweeps for 2 or more right-hand sides, vectorized over right-hand sides */

/* A row of x has `stride` right-hand sides. With SLW_GROUPS this is any multiple of SLW_NRHS: each
 * row tile of L is applied to all groups of SLW_NRHS right-hand sides while it is in the first
 * cache. Otherwise there is one group. */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. over the SLW_ROWS rows that are kept in registers,
 * SLW_HIGH and SLW_LOW are its halves in descending order. a0, a1, .. are the accumulators of these
 * rows, b and c are one more row each, v holds entries of L. A macro does not expand inside itself;
 * SLW_EACH_AGAIN is a copy of SLW_EACH for that. */
#if SLW_ROWS == 8
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#else
#define SLW_EACH SLI_EACH4
#define SLW_EACH_AGAIN SLI_EACH4_AGAIN
#define SLW_HIGH SLI_HIGH4
#define SLW_LOW SLI_LOW4
#endif

#define SLI_DECLARE(r, k) SLW_DECLARE(a##r)
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*distance)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*distance, a##r)
/* Rows below the diagonal block, at their positions in x. */
#define SLI_LOAD_BELOW(r, p) SLW_LOAD(a##r, (p) + (ptrdiff_t)below_rows[r] * stride)
#define SLI_STORE_BELOW(r, p) SLW_STORE((p) + (ptrdiff_t)below_rows[r] * stride, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* Inside the diagonal block: column k updates the rows below it, row k the columns before it. */
#define SLI_DOWN(r, k) \
    if ((r) > (k)) { \
        SLW_FNMA(a##r, v[SLI_TILE * (k) + (r)], a##k) \
    }
#define SLI_UP(j, k) \
    if ((j) < (k) && (j) < inner) { \
        SLW_FNMA(a##j, v[SLI_TILE * (j) + (k)], a##k) \
    }
#define SLI_COLUMN(k, unused) \
    if ((k) < inner) { \
        SLW_EACH_AGAIN(SLI_DOWN, k) \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns. The width is a compile-time constant, as in small_supernode.inl.h,
 * but not with SLW_GROUPS.
 * The rows of its columns stay in registers; the rows below are read one after another. The
 * distance between rows of x is `stride`. */
#define SLI_LOAD_OWN(k, p) \
    if ((k) < w) { \
        SLW_LOAD(a##k, (p) + (k)*stride) \
    }
#define SLI_STORE_OWN(k, p) \
    if ((k) < w) { \
        SLW_STORE((p) + (k)*stride, a##k) \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_PREFETCH_OWN(k, bytes) \
    if ((k) < w) { \
        SLV_PREFETCH(l, k, bytes) \
    }
#define SLI_DOWN_OWN(r, k) \
    if ((r) > (k) && (r) < w) { \
        SLW_FNMA(a##r, v[SLI_TILE * (k) + (r)], a##k) \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused) \
    if ((k) < w) { \
        SLW_FNMA(b, v[SLI_TILE * (k) + lane], a##k) \
    }

/* Where the width is not a constant, compilers warn of columns that they think are used. */
#if defined(SLW_GROUPS) && SLV_SINGLE
#define SLI_CLEAR_WIDE memset(v, 0, sizeof v);
#else
#define SLI_CLEAR_WIDE
#endif

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_SWEEP(small_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const SLV_VALUE *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLV_WIDE(v, SLI_TILE)
    SLI_CLEAR_WIDE
    SLV_WIDEN(v, l, w, SLI_TILE)
    SLW_EACH(SLI_PREFETCH_OWN, SLI_PREFETCH_DISTANCE)
#if defined(SLW_GROUPS)
    SLW_EACH(SLI_ZERO_OWN, 0)
#endif
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLV_WIDEN(v, l, w, SLI_TILE)
            SLW_EACH(SLI_PREFETCH_OWN, SLI_PREFETCH_DISTANCE)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k) \
    if ((j) < (k) && (k) < w) { \
        SLW_FNMA(a##j, v[SLI_TILE * (j) + (k)], a##k) \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused) \
    if ((k) < w) { \
        SLW_FNMA(a##k, v[SLI_TILE * (k) + lane], b) \
    }
#define SLI_DIVIDE_OWN(k, unused) \
    if ((k) < w) { \
        SLW_LOAD(b, xs + (k)*stride) \
        SLW_DIVIDE(b, d[k]) \
        SLW_ADD(a##k, b) \
    }

/* l: the last tile of the panel */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_SWEEP(small_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const SLV_VALUE *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLV_WIDE(v, SLI_TILE)
    SLI_CLEAR_WIDE
    SLV_WIDEN(v, l, w, SLI_TILE)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
    SLW_LOW(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLV_WIDEN(v, l, w, SLI_TILE)
            SLW_HIGH(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
            SLW_LOW(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
        SLV_WIDEN(v, l, w, SLI_TILE)
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_SWEEP(small_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_SWEEP(small_backward)(k, stride, below, rows, l, d, xs, x)
#if defined(SLW_GROUPS)
#define SLI_BY_WIDTH(call) call(w) /* as fast by branches, with rows of many right-hand sides */
#else
#define SLI_BY_WIDTH(call) SLI_CASES(call)
#endif

SLV_FUNCTION static void SLW_SWEEP(forward_small)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const SLV_VALUE *l,
                                                  double *xs, double *x) {
    SLI_BY_WIDTH(SLI_FORWARD);
}

SLV_FUNCTION static void SLW_SWEEP(backward_small)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const SLV_VALUE *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_BY_WIDTH(SLI_BACKWARD);
}

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
#undef SLI_FORWARD
#undef SLI_BACKWARD
#undef SLI_BY_WIDTH
#undef SLI_CLEAR_WIDE
#elif defined(SLW_HALF)
/* 8 rows do not fit in the registers: first one half of the right-hand sides, then the other. */
SLV_FUNCTION SLI_INLINE void SLW_SWEEP(forward_small)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const SLV_VALUE *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_NRHS / 2;
    SLW_SWEEP_HALF(forward_small)(w, stride, below, rows, l, xs, x);
    SLW_SWEEP_HALF(forward_small)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_SWEEP(backward_small)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const SLV_VALUE *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_NRHS / 2;
    SLW_SWEEP_HALF(backward_small)(w, stride, below, rows, l, d, xs, x);
    SLW_SWEEP_HALF(backward_small)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

#if defined(SLW_GROUPS)
#define SLI_STRIDE_PARAMETER , sl_int stride
#define SLI_SET_STRIDE
#define SLI_KERNEL(f) SLW_SWEEP(grouped_##f)
#define SLI_IS_DIRECT 1 /* rows below are loaded from x and not from a copy */
#else
#define SLI_IS_DIRECT 0
#define SLI_STRIDE_PARAMETER
#define SLI_SET_STRIDE const sl_int stride = SLW_NRHS;
#define SLI_KERNEL(f) SLW_SWEEP(f)
#endif

#if !SLV_SINGLE
/* Copies SLW_ROWS rows to buf where some of them are columns of the supernode and some are not, or
 * where there are fewer: `inner` rows of its columns, then `below` rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x, sl_int stride) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * stride
                                  : x + (ptrdiff_t)rows[r - inner] * stride)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_NRHS, b)
    }
}

/* Copies the rows back from buf. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x,
                                                sl_int stride) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_NRHS)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * stride
                            : x + (ptrdiff_t)rows[r - inner] * stride,
                  b)
    }
}

#endif

/* Computes SLW_ROWS rows at a time: x(rows) -= L(rows, j) x(j) for the columns j before them, then
 * the triangle of the diagonal tile. Rows below are updated in x in place. */
SLV_FUNCTION static void SLI_KERNEL(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                             const void *values, double *x,
                                             double *buf SLI_STRIDE_PARAMETER) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    SLI_SET_STRIDE
    SLV_WIDE(v, SLI_TILE)
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const SLV_VALUE *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * stride;
        ptrdiff_t row;
        sl_int group, j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            for (group = 0; group < stride; group += SLW_NRHS) {
                SLW_SWEEP(forward_small)(w, stride, s->below, rows, tile, xs + group, x + group);
            }
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int below = height - (sl_int)row - inner;
            const int is_below = SLI_IS_DIRECT && inner == 0 && below >= SLW_ROWS;
            const ptrdiff_t distance = inner == SLW_ROWS ? stride : SLW_NRHS;
            const sl_int *below_rows = rows + (row + inner - w);
            for (group = 0; group < stride; group += SLW_NRHS) {
                double *own = xs + row * stride + group, *p = inner == SLW_ROWS ? own : buf;
                const SLV_VALUE *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
                const double *xj = xs + (ptrdiff_t)first * stride + group;
                SLW_EACH(SLI_DECLARE, 0)
                SLW_DECLARE(b)
                if (is_below) {
                    SLW_EACH(SLI_LOAD_BELOW, x + group)
                } else {
                    if (inner < SLW_ROWS) {
                        SLW_NAME(rows_in)(buf, inner, below, below_rows, own, x + group, stride);
                    }
                    SLW_EACH(SLI_LOAD, p)
                }
                for (j = first; j < final; j++, l += SLI_TILE, xj += stride) {
                    SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE);
                    SLV_WIDEN(v, l, 1, SLW_ROWS)
                    SLW_LOAD(b, xj)
                    SLW_EACH(SLI_APPLY, v)
                }
                if (inner > 0) {
                    SLV_WIDEN(v, l, inner, SLW_ROWS)
                    SLW_EACH(SLI_COLUMN, 0)
                }
                if (is_below) {
                    SLW_EACH(SLI_STORE_BELOW, x + group)
                    continue;
                }
                SLW_EACH(SLI_STORE, p)
                if (inner < SLW_ROWS) {
                    SLW_NAME(rows_out)(buf, inner, below, below_rows, own, x + group, stride);
                }
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

/* Row tiles from the last to the first, SLW_ROWS rows at a time. Once the rows are final,
 * x(j) -= L(rows, j)' x(rows) for the columns j before them. */
SLV_FUNCTION static void SLI_KERNEL(backward)(sl_int count, const sli_step *s,
                                              const sl_int *rows_end, const void *values,
                                              const double *D, double *x,
                                              double *buf SLI_STRIDE_PARAMETER) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    SLI_SET_STRIDE
    SLV_WIDE(v, SLI_TILE)
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const SLV_VALUE *tile = L + s->panel + sli_panel_size(w, s->below);
        const double *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * stride;
        ptrdiff_t row;
        sl_int group, i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            for (group = 0; group < stride; group += SLW_NRHS) {
                SLW_SWEEP(backward_small)
                (w, stride, s->below, rows_end, tile - SLI_TILE * w, d, xs + group, x + group);
            }
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            for (group = 0; group < stride; group += SLW_NRHS) {
                SLW_LOAD(b, xs + (ptrdiff_t)i * stride + group)
                SLW_DIVIDE(b, d[i])
                SLW_STORE(xs + (ptrdiff_t)i * stride + group, b)
            }
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int below = height - (sl_int)row - inner;
            const ptrdiff_t distance = inner == SLW_ROWS ? stride : SLW_NRHS;
            const sl_int *below_rows = rows_end + (row + inner - w);
            if (lane + SLW_ROWS == SLI_TILE) {
                tile -= SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
            for (group = 0; group < stride; group += SLW_NRHS) {
                double *own = xs + row * stride + group, *p = inner == SLW_ROWS ? own : buf;
                double *xj = xs + (ptrdiff_t) final * stride + group;
                const SLV_VALUE *l = tile + SLI_TILE * row + lane;
                SLW_EACH(SLI_DECLARE, 0)
                if (SLI_IS_DIRECT && inner == 0 && below >= SLW_ROWS) {
                    SLW_EACH(SLI_LOAD_BELOW, x + group)
                } else {
                    if (inner < SLW_ROWS) {
                        SLW_NAME(rows_in)(buf, inner, below, below_rows, own, x + group, stride);
                    }
                    SLW_EACH(SLI_LOAD, p)
                }
                if (inner > 0) {
                    SLV_WIDEN(v, l, inner, SLW_ROWS)
                    SLW_HIGH(SLI_ROW, 0)
                    SLW_LOW(SLI_ROW, 0)
                    SLW_EACH(SLI_STORE, p)
                    if (inner < SLW_ROWS) {
                        SLW_NAME(rows_out)(buf, inner, 0, NULL, own, x, stride);
                    }
                }
                l = tile + SLI_TILE * (ptrdiff_t) final + lane;
                for (j = final - 1; j >= first; j--) {
                    l -= SLI_TILE;
                    xj -= stride;
                    SLI_PREFETCH(l, -SLI_PREFETCH_DISTANCE);
                    SLV_WIDEN(v, l, 1, SLW_ROWS)
                    SLW_LOAD(b, xj)
                    SLW_ZERO(c)
                    SLW_HIGH(SLI_GATHER, v)
                    SLW_LOW(SLI_GATHER2, v)
                    SLW_ADD(b, c)
                    SLW_STORE(xj, b)
                }
            }
        }
    }
}

#if defined(SLW_GROUPS)
/* The kernels of wide blocks; see sli_forward_kernel. */
#define SLI_GROUPED_KERNELS(lanes) \
    SLV_FUNCTION static void SLV_SWEEP(forward##lanes)(sl_int count, const sli_step *s, \
                                                       const sl_int *rows, const void *values, \
                                                       double *x, double *buf) { \
        SLI_KERNEL(forward)(count, s, rows, values, x, buf, lanes); \
    } \
    SLV_FUNCTION static void SLV_SWEEP(backward##lanes)( \
        sl_int count, const sli_step *s, const sl_int *rows_end, const void *values, \
        const double *D, double *x, double *buf) { \
        SLI_KERNEL(backward)(count, s, rows_end, values, D, x, buf, lanes); \
    }
#if SLW_NRHS == 8
SLI_GROUPED_KERNELS(8)
#endif
SLI_GROUPED_KERNELS(16)
SLI_GROUPED_KERNELS(32)
#undef SLI_GROUPED_KERNELS
#endif

#if SLW_NRHS == 8 && !SLV_SINGLE
/* Computes SLW_ROWS rows of sums at a time; see sli_products_kernel. */
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    enum { distance = SLW_NRHS };
    sl_int row, k;
    for (row = 0; row < SLW_NRHS; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_NRHS;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_NRHS, p += SLW_NRHS) {
            SLW_LOAD(b, p)
            SLW_EACH(SLI_APPLY, l)
        }
        SLW_EACH(SLI_STORE, s)
    }
}
#endif

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_LOAD_BELOW
#undef SLI_STORE_BELOW
#undef SLI_STRIDE_PARAMETER
#undef SLI_SET_STRIDE
#undef SLI_KERNEL
#undef SLI_IS_DIRECT
#undef SLI_APPLY
#undef SLI_GATHER
#undef SLI_GATHER2
#undef SLI_DOWN
#undef SLI_UP
#undef SLI_COLUMN
#undef SLI_ROW
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW

#if SLV_SINGLE
#undef SLV_SINGLE
#define SLV_SINGLE 0
#undef SLW_NAME
#undef SLW_NRHS
#undef SLW_HALF
#undef SLW_GROUPS
#else
#undef SLV_SINGLE
#define SLV_SINGLE 1
#endif
