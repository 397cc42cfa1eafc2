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

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + (ptrdiff_t)s->base * SLW_LANES;
        const size_t columns = (size_t)(w - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        memcpy(buf + (ptrdiff_t)first * SLW_LANES, xs, columns * sizeof(double));
        memset(buf + (ptrdiff_t)w * SLW_LANES, 0,
               (size_t)(SLI_TILE * sli_tiles(height) - w) * SLW_LANES * sizeof(double));
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *p = buf + row * SLW_LANES;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLW_LOAD(b, buf + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            SLW_EACH(SLI_COLUMN, 0)
            SLW_EACH(SLI_STORE, p)
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
        memcpy(xs, buf + (ptrdiff_t)first * SLW_LANES, columns * sizeof(double));
        for (i = 0; i < s->below; i++) {
            double *to = x + (ptrdiff_t)rows[i] * SLW_LANES;
            SLW_DECLARE(sum)
            SLW_DECLARE(update)
            SLW_LOAD(sum, to)
            SLW_LOAD(update, buf + (ptrdiff_t)(w + i) * SLW_LANES)
            SLW_ADD(sum, update)
            SLW_STORE(to, sum)
        }
        rows += s->below;
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
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(buf + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (i = 0; i < s->below; i++) {
            SLW_LOAD(b, x + (ptrdiff_t)rows_end[i] * SLW_LANES)
            SLW_STORE(buf + (ptrdiff_t)(w + i) * SLW_LANES, b)
        }
        memset(buf + (ptrdiff_t)height * SLW_LANES, 0,
               (size_t)(padded - height) * SLW_LANES * sizeof(double));
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *p = buf + row * SLW_LANES;
            const double *l;
            SLW_EACH(SLI_DECLARE, 0)
            if (lane + SLW_ROWS == SLI_TILE) {
                tile -= SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
            SLW_EACH(SLI_LOAD, p)
            if (inner > 0) {
                l = tile + SLI_TILE * row + lane;
                SLW_HIGH(SLI_ROW, 0)
                SLW_LOW(SLI_ROW, 0)
                SLW_EACH(SLI_STORE, p)
            }
            l = tile + SLI_TILE * (ptrdiff_t) final + lane;
            for (j = final - 1; j >= first; j--) {
                l -= SLI_TILE;
                SLW_LOAD(b, buf + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(buf + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
        memcpy(xs + (ptrdiff_t)first * SLW_LANES, buf + (ptrdiff_t)first * SLW_LANES,
               (size_t)(w - first) * SLW_LANES * sizeof(double));
    }
}

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
