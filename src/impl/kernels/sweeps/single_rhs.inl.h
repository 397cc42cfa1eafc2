/* single_rhs.inl.h: sweeps for one right-hand side, vectorized over the 8 rows of a tile */

/* buf := L^-1 buf on the first `rows` local rows of a panel, by its columns 8 t0 .. columns-1 in
 * ascending order. tile: tile t0 of the panel. Four partial sums hide the latency of the FMA. The
 * sum to which a column is added depends only on its number, so a sweep that starts at a later tile
 * gives the same bits as a full one that has zeros before it. */
SLV_FUNCTION SLI_INLINE void SLV_SWEEP(panel_forward)(const SLV_VALUE *tile, sl_int t0,
                                                      sl_int width, sl_int columns, sl_int rows,
                                                      double *buf) {
    const sl_int first = SLI_TILE * t0;
    sl_int t, j, k;
    for (t = t0; SLI_TILE * t < rows; t++) {
        const sl_int row = SLI_TILE * t, final = sli_min(row, columns);
        const sl_int inner = sli_clamp(columns - row, SLI_TILE);
        SLV_DECLARE(a0)
        SLV_DECLARE(a1)
        SLV_DECLARE(a2)
        SLV_DECLARE(a3)
        SLV_LOAD(a0, buf + row)
        SLV_ZERO(a1)
        SLV_ZERO(a2)
        SLV_ZERO(a3)
        for (j = first; j + 4 <= final; j += 4) { /* y(rows) -= L(rows, j) y(j) */
            const SLV_VALUE *l = tile + SLI_TILE * j;
            SLV_AXPY(a0, l, buf + j)
            SLV_AXPY(a1, l + 8, buf + j + 1)
            SLV_AXPY(a2, l + 16, buf + j + 2)
            SLV_AXPY(a3, l + 24, buf + j + 3)
        }
        for (; j < final; j++) {
            SLV_AXPY(a0, tile + SLI_TILE * j, buf + j)
        }
        SLV_ADD(a0, a1)
        SLV_ADD(a2, a3)
        SLV_ADD(a0, a2)
        SLV_STORE(buf + row, a0)
        if (inner == SLI_TILE) {
            SLV_SWEEP(tile_forward)(tile + SLI_TILE * row, buf + row);
        } else {
            for (k = 0; k < inner; k++) { /* columns inside the tile */
                SLV_AXPY(a0, tile + SLI_TILE * (row + k), buf + row + k)
                SLV_STORE(buf + row, a0)
            }
        }
        tile += SLI_TILE * sli_min(width, row + SLI_TILE);
    }
}

SLV_FUNCTION static void SLV_SWEEP(forward)(const sli_reach *R, const void *values, double *x,
                                            double *buf) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    const sli_step *s = R->steps, *end = s + R->count;
    const sl_int *rows = R->rows;
    while (s < end) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const SLV_VALUE *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + s->base;
        sl_int i;
        if (w <= SLI_TILE) {
            s = SLV_SWEEP_SHORT(forward_small)(s, R, &rows, L, x, buf);
            continue;
        }
        SLI_COPY(buf + first, xs, w - first);
        for (i = w; i < SLI_TILE * sli_tiles(height); i++) {
            buf[i] = 0.0;
        }
        SLV_SWEEP(panel_forward)(tile, s->first_tile, w, w, height, buf);
        SLI_COPY(xs, buf + first, w - first);
        for (i = 0; i < s->below; i++) {
            x[rows[i]] += buf[w + i];
        }
        rows += s->below;
        s++;
    }
}

/* The backward sweep keeps an accumulator of partial sums for each column:
 * sums(j) -= L(rows, j)' x(rows) for columns j = first .. final-1, over one row tile or over two at
 * once, which saves half of the loads and stores of the sums. */
#define SLI_DECLARE(k, a) SLV_DECLARE(a##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_ROW_AT(k) rows[at + (k)]
#define SLI_ROW(k) rows[k]
#define SLI_ROW_PART(k) rows[sli_clamp((k)-inner, part - 1)]

SLV_FUNCTION SLI_INLINE void SLV_SWEEP(dots1)(const SLV_VALUE *l, const double *x, sl_int first,
                                              sl_int final, double *sums) {
    ptrdiff_t j;
    SLV_DECLARE(v)
    SLV_SUM_DECLARE(a)
    SLV_LOAD(v, x)
    for (j = SLI_TILE * ((ptrdiff_t) final - 1); j >= SLI_TILE * (ptrdiff_t)first; j -= SLI_TILE) {
        SLI_PREFETCH(l + j, -SLI_PREFETCH_DISTANCE);
        SLV_SUM_LOAD(a, sums + j)
        SLV_SUM_DOT(a, l + j, v)
        SLV_SUM_STORE(sums + j, a)
    }
}

/* Two row tiles: l0 with the 8 rows at x, l1 with the 8 rows after them. */
SLV_FUNCTION SLI_INLINE void SLV_SWEEP(dots2)(const SLV_VALUE *l0, const SLV_VALUE *l1,
                                              const double *x, sl_int first, sl_int final,
                                              double *sums) {
    ptrdiff_t j;
    SLV_DECLARE(v0)
    SLV_DECLARE(v1)
    SLV_SUM_DECLARE(a)
    SLV_LOAD(v0, x)
    SLV_LOAD(v1, x + SLI_TILE)
    for (j = SLI_TILE * ((ptrdiff_t) final - 1); j >= SLI_TILE * (ptrdiff_t)first; j -= SLI_TILE) {
        SLV_SUM_LOAD(a, sums + j)
        SLV_SUM_DOT(a, l1 + j, v1)
        SLV_SUM_DOT(a, l0 + j, v0)
        SLV_SUM_STORE(sums + j, a)
    }
}

/* The diagonal tile, which has `inner` columns: adds up the partial sums of the rows below, adds
 * the right-hand side divided by D, and solves with the triangle. l: diagonal part of the tile. */
#define SLI_TAKE_SUM(k, unused) \
    if (SLI_IS_IN(k, inner)) { \
        SLV_SUM_LOAD(a##k, sums + SLI_TILE * (k)) \
        if ((k) < SLI_TILE - 1 && inner < SLI_TILE) { \
            SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v) \
        } \
    } else { \
        SLV_SUM_ZERO(a##k) \
    }
#if defined(SLV_PLAIN) /* two copies would take 1.3 kB more, and 0.97 to 1.01 of the time */
SLI_NOINLINE static void
#else
SLV_FUNCTION SLI_INLINE void
#endif
SLV_SWEEP(diagonal)(const SLV_VALUE *l, sl_int inner,
                                                 const double *sums, const double *d, double *xs,
                                                 double *buf) {
    double r[SLI_TILE];
    sl_int j, k;
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLV_ZERO(v)
    if (inner < SLI_TILE) { /* buf is 0 on the columns: only the rows below count here */
        SLV_LOAD(v, buf)
    }
    SLI_EACH8(SLI_TAKE_SUM, 0)
    SLV_LOAD_PART(z, xs, inner, 0.0)
    SLV_LOAD_PART(v, d, inner, 1.0)
    SLV_DIVIDE(z, z, v)
    SLV_SUMS(v, a)
    SLV_ADD(v, z)
    SLV_STORE_ANY(r, v)
    if (inner == SLI_TILE) {
        SLV_SWEEP(tile_backward)(l, r);
    } else {
        for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
            for (j = 0; j < k; j++) {
                r[j] = SLV_FNMA1(l[SLI_TILE * j + k], r[k], r[j]);
            }
        }
    }
    for (k = 0; k < inner; k++) {
        xs[k] = buf[k] = r[k];
    }
}

/* buf := x at `part` rows below, which follow `inner` columns in a tile; zeros elsewhere. A tile
 * of 8 columns needs no rows. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_SWEEP(rows_below)(const double *x, const sl_int *rows,
                                                          sl_int inner, sl_int part, double *buf) {
    sl_int j;
    SLV_DECLARE(v)
    if (part == SLI_TILE) {
        SLV_GATHER(v, x, SLI_ROW)
        SLV_STORE(buf, v)
    } else if (inner < SLI_TILE) {
        SLV_ZERO(v)
        if (part > 0) {
            SLV_GATHER(v, x, SLI_ROW_PART)
            SLV_FIRST(v, inner + part)
        }
        SLV_STORE(buf, v)
        for (j = 0; j < inner; j++) {
            buf[j] = 0.0;
        }
    }
}

/* A sweep of at most so many steps is assumed to find L in a cache, where it is faster to read two
 * row tiles at a time. From farther away the hardware prefetcher keeps up only if the panels are
 * read in strict order: with 1000 to 4000 steps of 30 MB that takes 0.83 to 1.0 of the time. The
 * bits are the same. */
#define SLI_FEW_STEPS 512

/* buf: the rows of two tiles, then the sums. */
SLV_FUNCTION static void SLV_SWEEP(backward)(const sli_reach *R, const void *values,
                                             const double *D, double *x, double *buf) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    const int by_two = R->count <= SLI_FEW_STEPS;
    const sli_step *begin = R->steps, *s = begin + R->count;
    const sl_int *rows_end = R->rows + R->n_rows;
    while (s > begin) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const SLV_VALUE *tile = L + s->panel + sli_panel_size(w, s->below);
        const double *d = D + s->column - first;
        double *xs = x + s->base - first, *sums = buf + 2 * SLI_TILE;
        const sl_int *rows;
        sl_int row = SLI_TILE * (sli_tiles(height) - 1), j;
        SLV_DECLARE(v)
        SLV_SUM_DECLARE(a)
        if (w <= SLI_TILE) {
            s = SLV_SWEEP_SHORT(backward_small)(s + 1, R, &rows_end, L, D, x);
            continue;
        }
        rows = rows_end -= s->below;
        SLV_SUM_ZERO(a)
        for (j = first; j < w; j++) {
            SLV_SUM_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
        }
        for (; row >= first; row -= SLI_TILE) {
            const sl_int inner = sli_clamp(w - row, SLI_TILE), final = sli_min(row, w);
            const sl_int at = row + inner - w, part = sli_min(height - row, SLI_TILE) - inner;
            const SLV_VALUE *above;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            above = tile - SLI_TILE * (ptrdiff_t) final;
            SLV_SWEEP(rows_below)(x, rows + at, inner, part, buf + SLI_TILE);
            if (inner > 0) {
                SLV_SWEEP(diagonal)
                (tile + SLI_TILE * (ptrdiff_t)row, inner, sums + SLI_TILE * (ptrdiff_t)row, d + row,
                 xs + row, buf + SLI_TILE);
            }
            if (!by_two || row == first || (inner == 0 && row - SLI_TILE < w)) {
                SLV_SWEEP(dots1)(tile, buf + SLI_TILE, first, final, sums);
                continue;
            }
            row -= SLI_TILE;
            if (inner == 0) {
                rows -= SLI_TILE;
                SLV_GATHER(v, x, SLI_ROW_AT)
                rows += SLI_TILE;
                SLV_STORE(buf, v)
                SLV_SWEEP(dots2)(above, tile, buf, first, w, sums);
            } else {
                SLV_SWEEP(dots1)(tile, buf + SLI_TILE, row, final, sums);
                SLV_SWEEP(diagonal)
                (above + SLI_TILE * (ptrdiff_t)row, SLI_TILE, sums + SLI_TILE * (ptrdiff_t)row,
                 d + row, xs + row, buf);
                SLV_SWEEP(dots2)(above, tile, buf, first, row, sums);
            }
            tile = above;
        }
    }
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_ROW_AT
#undef SLI_ROW
#undef SLI_ROW_PART
#undef SLI_TAKE_SUM
#undef SLI_FEW_STEPS
