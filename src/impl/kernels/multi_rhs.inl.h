/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
#undef SLI_DOWN_OWN
#undef SLI_COLUMN_OWN
#undef SLI_BELOW_OWN
#undef SLI_UP_OWN
#undef SLI_ROW_OWN
#undef SLI_ABOVE_OWN
#undef SLI_DIVIDE_OWN
#undef SLI_FORWARD
#undef SLI_BACKWARD
#elif defined(SLW_HALF)
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
            SLW_EACH(SLI_DECLARE, 0)
            if (lane + SLW_ROWS == SLI_TILE) {
                tile -= SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)
                (buf, inner, height - (sl_int)row - inner, rows_end + (row + inner - w), own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            if (inner > 0) {
                l = tile + SLI_TILE * row + lane;
                SLW_HIGH(SLI_ROW, 0)
                SLW_LOW(SLI_ROW, 0)
                SLW_EACH(SLI_STORE, p)
                if (inner < SLW_ROWS) {
                    SLW_NAME(rows_out)(buf, inner, 0, NULL, own, x);
                }
            }
            l = tile + SLI_TILE * (ptrdiff_t) final + lane;
            for (j = final - 1; j >= first; j--) {
                l -= SLI_TILE;
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLI_APPLY
#undef SLI_GATHER
#undef SLI_GATHER2
#undef SLI_DOWN
#undef SLI_UP
#undef SLI_COLUMN
#undef SLI_ROW
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
