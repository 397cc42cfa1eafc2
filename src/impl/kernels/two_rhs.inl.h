/* two_rhs.inl.h: sweeps for two right-hand sides, vectorized over the 8 rows of a tile */

/* Supernodes of at most 8 columns take the kernels of multi_rhs_small.inl.h, which keep their rows
 * in registers: full solves of 1e3 to 1e6 rows take 0.6 to 0.97 of the time. */

/* y(rows) -= L(rows, j) y(j) for 8 rows of two values each. Vector e0 has the first 4 rows, e1 the
 * last 4. Each entry of L is loaded once and duplicated. */
#define SLI_PAIR_AXPY(e, l, p) \
    SLV_DUP_LOW(t0, l) \
    SLV_DUP_HIGH(t1, l) \
    SLV_PAIR(b, p) \
    SLV_FNMA(e##0, t0, b) \
    SLV_FNMA(e##1, t1, b)

/* Solves with the full diagonal tile at l, for each right-hand side separately, by the function for
 * one right-hand side. */
#define SLI_PAIR_TILE(solve, l, p) \
    { \
        double r[2][SLI_TILE]; \
        for (k = 0; k < SLI_TILE; k++) { \
            r[0][k] = (p)[2 * k]; \
            r[1][k] = (p)[2 * k + 1]; \
        } \
        solve((l), r[0]); \
        solve((l), r[1]); \
        for (k = 0; k < SLI_TILE; k++) { \
            (p)[2 * k] = r[0][k]; \
            (p)[2 * k + 1] = r[1][k]; \
        } \
    }

SLV_FUNCTION static void SLV_SWEEP(forward2)(const sli_reach *R, const void *values, double *x,
                                             double *buf) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    const sli_step *s = R->steps, *end = s + R->count;
    const sl_int *rows = R->rows;
    for (; s < end; s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const size_t columns = 2 * (size_t)(w - first);
        const SLV_VALUE *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + 2 * (ptrdiff_t)s->base;
        sl_int row, i, j, k;
        if (w == 1) {
            for (i = 0; i < s->below; i++) {
                double *to = x + 2 * (ptrdiff_t)rows[i];
                to[0] = SLV_FNMA1((double)tile[1 + i], xs[0], to[0]);
                to[1] = SLV_FNMA1((double)tile[1 + i], xs[1], to[1]);
            }
            rows += s->below;
            continue;
        }
        if (w <= SLI_TILE) {
            SLV_SWEEP_2(forward_small)(w, sli_rows_of(rows, s->below, 2), tile, xs, x);
            rows += s->below;
            continue;
        }
        memcpy(buf + 2 * (ptrdiff_t)first, xs, columns * sizeof(double));
        memset(buf + 2 * (ptrdiff_t)w, 0,
               2 * (size_t)(SLI_TILE * sli_tiles(height) - w) * sizeof(double));
        for (row = first; row < height; row += SLI_TILE) {
            const sl_int final = sli_min(row, w), inner = sli_clamp(w - row, SLI_TILE);
            const SLV_VALUE *l = tile + SLI_TILE * (ptrdiff_t)first;
            double *p = buf + 2 * (ptrdiff_t)row;
            SLV_DECLARE(e0)
            SLV_DECLARE(e1)
            SLV_DECLARE(f0)
            SLV_DECLARE(f1)
            SLV_DECLARE(t0)
            SLV_DECLARE(t1)
            SLV_DECLARE(b)
            SLV_LOAD(e0, p)
            SLV_LOAD(e1, p + SLI_TILE)
            SLV_ZERO(f0)
            SLV_ZERO(f1)
            for (j = first; j + 2 <= final;
                 j += 2, l += 2 * SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
                SLI_PAIR_AXPY(e, l, buf + 2 * (ptrdiff_t)j)
                SLI_PAIR_AXPY(f, l + SLI_TILE, buf + 2 * (ptrdiff_t)j + 2)
            }
            if (j < final) {
                SLI_PAIR_AXPY(e, l, buf + 2 * (ptrdiff_t)j)
            }
            SLV_ADD(e0, f0)
            SLV_ADD(e1, f1)
            SLV_STORE(p, e0)
            SLV_STORE(p + SLI_TILE, e1)
            l = tile + SLI_TILE * (ptrdiff_t)row;
            if (inner == SLI_TILE) {
                SLI_PAIR_TILE(SLV_SWEEP(tile_forward), l, p)
            } else {
                for (k = 0; k < inner; k++, l += SLI_TILE) { /* columns inside the tile */
                    SLI_PAIR_AXPY(e, l, p + 2 * k)
                    SLV_STORE(p, e0)
                    SLV_STORE(p + SLI_TILE, e1)
                }
            }
            tile += SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
        }
        memcpy(xs, buf + 2 * (ptrdiff_t)first, columns * sizeof(double));
        for (i = 0; i < s->below; i++) {
            double *to = x + 2 * (ptrdiff_t)rows[i];
            to[0] += buf[2 * (ptrdiff_t)(w + i)];
            to[1] += buf[2 * (ptrdiff_t)(w + i) + 1];
        }
        rows += s->below;
    }
}

/* a -= L(rows, j)' x(rows) over the 8 rows of a tile. Vector a has 4 partial sums for each of the
 * two right-hand sides. */
#define SLI_PAIR_DOT(a, l) \
    SLV_DUP_LOW(t0, l) \
    SLV_DUP_HIGH(t1, l) \
    SLV_FNMA(a, t0, v0) \
    SLV_FNMA(a, t1, v1)

SLV_FUNCTION static void SLV_SWEEP(backward2)(const sli_reach *R, const void *values,
                                              const double *D, double *x, double *buf) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    const sli_step *s = R->steps + R->count;
    const sl_int *rows_end = R->rows + R->n_rows;
    while (s > R->steps) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const SLV_VALUE *tile = L + s->panel + sli_panel_size(w, s->below);
        const double *d = D + s->column - first;
        double *xs = x + 2 * ((ptrdiff_t)s->base - first), *sums = buf + 2 * (ptrdiff_t)padded;
        sl_int row, i, j, k;
        SLV_DECLARE(a)
        SLV_DECLARE(v0)
        SLV_DECLARE(v1)
        SLV_DECLARE(t0)
        SLV_DECLARE(t1)
        SLV_ZERO(a)
        rows_end -= s->below;
        if (w == 1) {
            xs[0] /= d[0];
            xs[1] /= d[0];
            for (i = s->below - 1, tile -= s->below; i >= 0; i--) {
                const double *from = x + 2 * (ptrdiff_t)rows_end[i];
                xs[0] = SLV_FNMA1((double)tile[i], from[0], xs[0]);
                xs[1] = SLV_FNMA1((double)tile[i], from[1], xs[1]);
            }
            continue;
        }
        if (w <= SLI_TILE) {
            SLV_SWEEP_2(backward_small)
            (w, sli_rows_of(rows_end, s->below, 2), tile - SLI_TILE * w, d, xs, x);
            continue;
        }
        for (i = first; i < w; i++) {
            SLV_STORE(sums + SLI_TILE * (ptrdiff_t)i, a)
            buf[2 * i] = buf[2 * i + 1] = 0.0;
        }
        for (i = 0; i < s->below; i++) {
            buf[2 * (w + i)] = x[2 * (ptrdiff_t)rows_end[i]];
            buf[2 * (w + i) + 1] = x[2 * (ptrdiff_t)rows_end[i] + 1];
        }
        memset(buf + 2 * (ptrdiff_t)height, 0, 2 * (size_t)(padded - height) * sizeof(double));
        for (row = padded - SLI_TILE; row >= first; row -= SLI_TILE) {
            const sl_int inner = sli_clamp(w - row, SLI_TILE);
            double *p = buf + 2 * (ptrdiff_t)row;
            const SLV_VALUE *l;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            l = tile + SLI_TILE * (ptrdiff_t)row;
            SLV_LOAD(v0, p) /* 0 on the columns: only the rows below count here */
            SLV_LOAD(v1, p + SLI_TILE)
            for (k = 0; k < inner; k++) {
                double part[SLI_TILE];
                SLV_LOAD(a, sums + SLI_TILE * (ptrdiff_t)(row + k))
                if (inner < SLI_TILE) {
                    SLI_PAIR_DOT(a, l + SLI_TILE * k)
                }
                SLV_STORE_ANY(part, a)
                for (j = 0; j < 2; j++) {
                    p[2 * k + j] = xs[2 * (ptrdiff_t)(row + k) + j] / d[row + k] +
                                   ((part[j] + part[2 + j]) + (part[4 + j] + part[6 + j]));
                }
            }
            if (inner == SLI_TILE) {
                SLI_PAIR_TILE(SLV_SWEEP(tile_backward), l, p)
            } else {
                for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
                    for (j = 0; j < k; j++) {
                        const double lkj = l[SLI_TILE * j + k];
                        p[2 * j] = SLV_FNMA1(lkj, p[2 * k], p[2 * j]);
                        p[2 * j + 1] = SLV_FNMA1(lkj, p[2 * k + 1], p[2 * j + 1]);
                    }
                }
            }
            SLV_LOAD(v0, p)
            SLV_LOAD(v1, p + SLI_TILE)
            l = tile + SLI_TILE * (ptrdiff_t)sli_min(row, w);
            for (j = sli_min(row, w) - 1; j >= first; j--) { /* x(j) -= L(rows, j)' x(rows) */
                l -= SLI_TILE;
                SLV_LOAD(a, sums + SLI_TILE * (ptrdiff_t)j)
                SLI_PAIR_DOT(a, l)
                SLV_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
            }
        }
        memcpy(xs + 2 * (ptrdiff_t)first, buf + 2 * (ptrdiff_t)first,
               2 * (size_t)(w - first) * sizeof(double));
    }
}

#undef SLI_PAIR_AXPY
#undef SLI_PAIR_TILE
#undef SLI_PAIR_DOT
