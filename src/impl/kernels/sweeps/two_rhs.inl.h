/* two_rhs.inl.h: sweeps for two right-hand sides, vectorized over the 8 rows of a tile */

#if defined(SLW_TWO)

/* Row i of x has two values, so that a row tile is two vectors of 4 rows. Each entry of L is loaded
 * once and repeated. Supernodes of at most 8 columns, and the columns inside a tile, take the
 * kernels of multi_rhs_small.inl.h, which keep rows in registers: full solves of 1e3 to 1e6 rows
 * take 0.55 to 0.9 of the time. */

/* v(rows) -= L(rows, j) y(j), with y(j) at p */
#define SLI_TWO_AXPY(v, l, p) \
    SLV_REPEAT(b, p) \
    SLV_REPEAT_ROWS(t, l, 0) \
    SLV_FNMA(v##0, t, b) \
    SLV_REPEAT_ROWS(t, l, 1) \
    SLV_FNMA(v##1, t, b)
/* a -= L(rows, j)' x(rows), in 4 partial sums for each right-hand side */
#define SLI_TWO_DOT(a, l) \
    SLV_REPEAT_ROWS(t, l, 0) \
    SLV_FNMA(a, t, v0) \
    SLV_REPEAT_ROWS(t, l, 1) \
    SLV_FNMA(a, t, v1)

/* buf := L^-1 buf on the local rows of a panel, by its columns from 8 t0 on. tile: tile t0. */
SLV_FUNCTION SLI_ALWAYS_INLINE void
SLV_SWEEP(panel_forward2)(const SLV_VALUE *tile, sl_int t0, sl_int w, sl_int height, double *buf) {
    const sl_int first = SLI_TILE * t0;
    sl_int row, j;
    for (row = first; row < height; row += SLI_TILE) {
        const sl_int final = sli_min(row, w), inner = sli_clamp(w - row, SLI_TILE);
        const SLV_VALUE *l = tile + SLI_TILE * (ptrdiff_t)first;
        double *p = buf + 2 * (ptrdiff_t)row;
        SLV_DECLARE(v0)
        SLV_DECLARE(v1)
        SLV_DECLARE(u0)
        SLV_DECLARE(u1)
        SLV_DECLARE(t)
        SLV_DECLARE(b)
        SLV_LOAD(v0, p)
        SLV_LOAD(v1, p + SLI_TILE)
        SLV_ZERO(u0)
        SLV_ZERO(u1)
        for (j = first; j + 2 <= final; j += 2, l += 2 * SLI_TILE) {
            SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE);
            SLI_PREFETCH(l + SLI_TILE, SLI_PREFETCH_DISTANCE);
            SLI_TWO_AXPY(v, l, buf + 2 * (ptrdiff_t)j)
            SLI_TWO_AXPY(u, l + SLI_TILE, buf + 2 * (ptrdiff_t)(j + 1))
        }
        if (j < final) {
            SLI_TWO_AXPY(v, l, buf + 2 * (ptrdiff_t)j)
        }
        SLV_ADD(v0, u0)
        SLV_ADD(v1, u1)
        SLV_STORE(p, v0)
        SLV_STORE(p + SLI_TILE, v1)
        if (inner > 0) {
            const sl_int below = sli_min(height - row, SLI_TILE) - inner;
            SLV_SWEEP_SHORT(forward_small2)
            (inner, sli_rows_of(sli_tile_rows + inner, below, 2), tile + SLI_TILE * (ptrdiff_t)row,
             p, p);
        }
        tile += SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
    }
}

SLI_AT_LINE SLV_FUNCTION static void SLV_SWEEP(forward2)(const sli_reach *R, const void *values,
                                                         double *x, double *buf) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    const sli_step *s = R->steps, *end = s + R->count;
    const sl_int *rows = R->rows;
    for (; s < end; rows += s->below, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const size_t columns = 2 * (size_t)(w - first);
        const SLV_VALUE *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + 2 * (ptrdiff_t)s->base;
        sl_int i, j;
        if (w == 1) {
            for (i = 0; i < s->below; i++) {
                double *to = x + 2 * (ptrdiff_t)rows[i];
                for (j = 0; j < 2; j++) {
                    to[j] += SLV_FNMA1((double)tile[1 + i], xs[j], 0.0);
                }
            }
            continue;
        }
        if (w <= SLI_TILE) {
            SLV_SWEEP_SHORT(forward_small2)(w, sli_rows_of(rows, s->below, 2), tile, xs, x);
            continue;
        }
        memcpy(buf + 2 * (ptrdiff_t)first, xs, columns * sizeof(double));
        memset(buf + 2 * (ptrdiff_t)w, 0,
               2 * (size_t)(SLI_TILE * sli_tiles(height) - w) * sizeof(double));
        SLV_SWEEP(panel_forward2)(tile, s->first_tile, w, height, buf);
        memcpy(xs, buf + 2 * (ptrdiff_t)first, columns * sizeof(double));
        for (i = 0; i < s->below; i++) {
            double *to = x + 2 * (ptrdiff_t)rows[i];
            for (j = 0; j < 2; j++) {
                to[j] += buf[2 * (ptrdiff_t)(w + i) + j];
            }
        }
    }
}

/* x(j) -= L(rows, j)' x(rows) on a panel whose local rows are in buf, with partial sums for each
 * column after them; its columns are divided by d when their tile is reached. tile: its end. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_SWEEP(panel_backward2)(const sli_step *s,
                                                               const SLV_VALUE *tile,
                                                               const double *d, const double *xs,
                                                               double *buf) {
    const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const sl_int padded = SLI_TILE * sli_tiles(height);
    double *sums = buf + 2 * (ptrdiff_t)padded;
    sl_int row, i, j;
    SLV_DECLARE(v0)
    SLV_DECLARE(v1)
    SLV_DECLARE(a)
    SLV_DECLARE(t)
    SLV_ZERO(a)
    for (i = first; i < w; i++) {
        SLV_STORE(sums + SLI_TILE * (ptrdiff_t)i, a)
    }
    for (row = padded - SLI_TILE; row >= first; row -= SLI_TILE) {
        const sl_int inner = sli_clamp(w - row, SLI_TILE);
        double *p = buf + 2 * (ptrdiff_t)row;
        const SLV_VALUE *l;
        tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
        for (i = 0; i < inner; i++) {
            const double *part = sums + SLI_TILE * (ptrdiff_t)(row + i);
            for (j = 0; j < 2; j++) {
                p[2 * i + j] = xs[2 * (ptrdiff_t)(row + i) + j] / d[row + i] +
                               ((part[j] + part[2 + j]) + (part[4 + j] + part[6 + j]));
            }
        }
        if (inner > 0) {
            const sl_int below = sli_min(height - row, SLI_TILE) - inner;
            SLV_SWEEP_SHORT(backward_small2)
            (inner, sli_rows_of(sli_tile_rows + inner, below, 2), tile + SLI_TILE * (ptrdiff_t)row,
             NULL, p, p);
        }
        SLV_LOAD(v0, p)
        SLV_LOAD(v1, p + SLI_TILE)
        l = tile + SLI_TILE * (ptrdiff_t)sli_min(row, w);
        for (j = sli_min(row, w) - 1; j >= first; j--) { /* x(j) -= L(rows, j)' x(rows) */
            l -= SLI_TILE;
            SLI_PREFETCH(l, -SLI_PREFETCH_DISTANCE);
            SLV_LOAD(a, sums + SLI_TILE * (ptrdiff_t)j)
            SLI_TWO_DOT(a, l)
            SLV_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
        }
    }
}

SLI_AT_LINE SLV_FUNCTION static void SLV_SWEEP(backward2)(const sli_reach *R, const void *values,
                                                          const double *D, double *x, double *buf) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    const sli_step *s = R->steps + R->count;
    const sl_int *rows_end = R->rows + R->n_rows;
    while (s > R->steps) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const SLV_VALUE *tile = L + s->panel + sli_panel_size(w, s->below);
        const double *d = D + s->column - first;
        double *xs = x + 2 * ((ptrdiff_t)s->base - first);
        sl_int i, j;
        rows_end -= s->below;
        if (w == 1) {
            for (j = 0; j < 2; j++) {
                xs[j] /= d[0];
            }
            for (i = s->below - 1, tile -= s->below; i >= 0; i--) {
                const double *from = x + 2 * (ptrdiff_t)rows_end[i];
                for (j = 0; j < 2; j++) {
                    xs[j] = SLV_FNMA1((double)tile[i], from[j], xs[j]);
                }
            }
            continue;
        }
        if (w <= SLI_TILE) {
            SLV_SWEEP_SHORT(backward_small2)
            (w, sli_rows_of(rows_end, s->below, 2), tile - SLI_TILE * w, d, xs, x);
            continue;
        }
        for (i = 0; i < s->below; i++) {
            for (j = 0; j < 2; j++) {
                buf[2 * (ptrdiff_t)(w + i) + j] = x[2 * (ptrdiff_t)rows_end[i] + j];
            }
        }
        memset(buf + 2 * (ptrdiff_t)height, 0, 2 * (size_t)(padded - height) * sizeof(double));
        SLV_SWEEP(panel_backward2)(s, tile, d, xs, buf);
        memcpy(xs + 2 * (ptrdiff_t)first, buf + 2 * (ptrdiff_t)first,
               2 * (size_t)(w - first) * sizeof(double));
    }
}

#undef SLI_TWO_AXPY
#undef SLI_TWO_DOT

#endif
