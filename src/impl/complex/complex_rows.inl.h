/* complex_rows.inl.h: sweeps over L of a complex Hermitian matrix, of which every other column is
 * stored */

#if defined(SLW_LAST) /* once for each instruction set */

/* Rows and columns come in pairs, the real and the imaginary part of a complex one. The second
 * column of a pair is i times the first: what it contributes is summed as if it were the first one,
 * and turned once for each row tile. L(rows, j) is at 8 (j / 2) of a tile, j even. */
#define SLI_HALF (SLI_TILE / 2)
#if !defined(SLV_PLAIN)
#define SLI_SMALL 1
#else /* arrays gain nothing from copies for small supernodes */
#define SLI_SMALL 0
#endif
#define SLI_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_ROW_AT(k) rows[at + (k)]

/* A pair of columns inside a tile, whose rows are a. L is stored as 0 on and above its diagonal. */
#define SLI_INSIDE(k) \
    if (SLI_IS_IN(k, inner)) { \
        SLV_LANE(v, a0, k) \
        SLV_LANE(u, a0, (k) + 1) \
        SLV_ZERO(b0) \
        SLV_DOT(a0, l + SLI_HALF * (k), v) \
        SLV_DOT(b0, l + SLI_HALF * (k), u) \
        SLV_TURN(b0, b0) \
        SLV_ADD(a0, b0) \
    }

SLV_FUNCTION SLI_NOINLINE static void SLV_NAME(complex_forward_step)(const sli_step *s,
                                                                     const sl_int *rows,
                                                                     const double *L, double *x,
                                                                     double *buf) {
    const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const double *tile = L + (s->panel + sli_tile_offset(w, s->first_tile)) / 2;
    double *xs = x + s->base;
    sl_int row, i, j;
    SLI_COPY(buf + first, xs, w - first);
    for (i = w; i < SLI_TILE * sli_tiles(height); i++) {
        buf[i] = 0.0;
    }
    for (row = first; row < height; row += SLI_TILE) {
        const sl_int final = sli_min(row, w), inner = sli_clamp(w - row, SLI_TILE);
        const double *l = tile + SLI_HALF * (ptrdiff_t)first;
        SLV_DECLARE(a0)
        SLV_DECLARE(a1)
        SLV_DECLARE(b0)
        SLV_DECLARE(b1)
        SLV_LOAD(a0, buf + row)
        SLV_ZERO(a1)
        SLV_ZERO(b0)
        SLV_ZERO(b1)
        for (j = first; j + 4 <= final;
             j += 4, l += 2 * SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
            SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE);
            SLI_PREFETCH(l + SLI_TILE, SLI_PREFETCH_DISTANCE);
            SLV_AXPY(a0, l, buf + j)
            SLV_AXPY(b0, l, buf + j + 1)
            SLV_AXPY(a1, l + SLI_TILE, buf + j + 2)
            SLV_AXPY(b1, l + SLI_TILE, buf + j + 3)
        }
        if (j < final) {
            SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE);
            SLV_AXPY(a0, l, buf + j)
            SLV_AXPY(b0, l, buf + j + 1)
            l += SLI_TILE;
        }
        SLV_ADD(a0, a1)
        SLV_ADD(b0, b1)
        SLV_TURN(b0, b0)
        SLV_ADD(a0, b0)
        if (inner > 0) {
            SLV_DECLARE(u)
            SLV_DECLARE(v)
            SLI_INSIDE(0)
            SLI_INSIDE(2)
            SLI_INSIDE(4)
            SLI_INSIDE(6)
        }
        SLV_STORE(buf + row, a0)
        tile += SLI_HALF * (ptrdiff_t)sli_min(w, row + SLI_TILE);
    }
    for (i = first; i < w; i++) {
        xs[i - first] = buf[i];
    }
    for (i = 0; i < s->below; i++) {
        x[rows[i]] += buf[w + i];
    }
}

/* sums(j) -= conj(L(rows, j)) x(rows) for the pairs of columns first .. final-1, as 8 partial sums
 * for each real column. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(complex_dots)(const double *tile, const double *x,
                                                    sl_int first, sl_int final, double *sums) {
    ptrdiff_t j;
    SLV_DECLARE(v)
    SLV_DECLARE(u)
    SLV_SUM_DECLARE(a)
    SLV_SUM_DECLARE(b)
    SLV_LOAD(v, x)
    SLV_TURN_BACK(u, v)
    for (j = (ptrdiff_t) final - 2; j >= first; j -= 2) {
        const double *l = tile + SLI_HALF * j;
        SLI_PREFETCH(l, -SLI_PREFETCH_DISTANCE);
        SLV_SUM_LOAD(a, sums + SLI_TILE * j)
        SLV_SUM_LOAD(b, sums + SLI_TILE * (j + 1))
        SLV_SUM_DOT(a, l, v)
        SLV_SUM_DOT(b, l, u)
        SLV_SUM_STORE(sums + SLI_TILE * j, a)
        SLV_SUM_STORE(sums + SLI_TILE * (j + 1), b)
    }
}

/* The diagonal tile: adds up the partial sums, adds the right-hand side divided by D, and solves
 * with the triangle. l: its diagonal part. buf: its rows. */
#define SLI_TAKE_SUM(k, unused) \
    if (SLI_IS_IN((k) / 2 * 2, inner)) { \
        SLV_SUM_LOAD(a##k, sums + SLI_TILE * (k)) \
    } else { \
        SLV_SUM_ZERO(a##k) \
    }
SLV_FUNCTION SLI_INLINE void SLV_NAME(complex_diagonal)(const double *l, sl_int inner,
                                                        const double *sums, const double *d,
                                                        double *xs, double *buf) {
    double r[SLI_TILE], b[SLI_TILE];
    sl_int k;
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_DECLARE, a)
    SLI_EACH8(SLI_TAKE_SUM, 0)
    for (k = 0; k < inner; k++) {
        b[k] = xs[k];
    }
    SLV_LOAD_PART(z, b, inner, 0.0)
    SLV_LOAD_PART(v, d, inner, 1.0)
    SLV_DIVIDE(z, z, v)
    SLV_SUMS(v, a)
    SLV_ADD(v, z)
    SLV_STORE_ANY(r, v)
    SLI_UNIT_TRIANGLE(inner)
    for (k = 0; k < inner; k++) {
        xs[k] = buf[k] = r[k];
    }
}

/* buf: the rows of a tile, then the sums. */
SLV_FUNCTION SLI_NOINLINE static void
SLV_NAME(complex_backward_step)(const sli_step *s, const sl_int *rows, const double *L,
                                const double *D, double *x, double *buf) {
    const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const double *tile = L + (s->panel + sli_panel_size(w, s->below)) / 2;
    const double *d = D + s->column - first;
    double *xs = x + (s->base - first), *sums = buf + SLI_TILE;
    sl_int row, j;
    SLV_DECLARE(v)
    SLV_SUM_DECLARE(a)
    SLV_SUM_ZERO(a)
    for (j = first; j < w; j++) {
        SLV_SUM_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
    }
    for (row = SLI_TILE * (sli_tiles(height) - 1); row >= first; row -= SLI_TILE) {
        const sl_int inner = sli_clamp(w - row, SLI_TILE), final = sli_min(row, w);
        const sl_int at = row + inner - w, part = sli_min(height - row, SLI_TILE) - inner;
        tile -= SLI_HALF * (ptrdiff_t)sli_min(w, row + SLI_TILE);
        if (part == SLI_TILE) {
            SLV_GATHER(v, x, SLI_ROW_AT)
            SLV_STORE(buf, v)
        } else {
            for (j = 0; j < SLI_TILE; j++) {
                const int is_below = j >= inner && j < inner + part;
                buf[j] = is_below ? x[rows[at + j - inner]] : 0.0;
            }
        }
        if (inner > 0) {
            if (part > 0) { /* buf is 0 on the columns: only the rows below count here */
                SLV_NAME(complex_dots)(tile, buf, row, row + inner, sums);
            }
            SLV_NAME(complex_diagonal)
            (tile + SLI_HALF * (ptrdiff_t)row, inner, sums + SLI_TILE * (ptrdiff_t)row, d + row,
             xs + row, buf);
        }
        SLV_NAME(complex_dots)(tile, buf, first, final, sums);
    }
}

SLV_FUNCTION static void SLV_NAME(complex_forward)(const sli_reach *R, const void *values,
                                                   double *x, double *buf) {
    const double *L = (const double *)values;
    const sli_step *s = R->steps, *end = s + R->count;
    const sl_int *rows = R->rows;
    while (s < end) {
        if (SLI_SMALL && s->width <= SLI_TILE) {
            s = SLV_NAME_SHORT(complex_forward_small)(s, end, &rows, L, x, buf);
        } else {
            SLV_NAME(complex_forward_step)(s, rows, L, x, buf);
            rows += (s++)->below;
        }
    }
}

SLV_FUNCTION static void SLV_NAME(complex_backward)(const sli_reach *R, const void *values,
                                                    const double *D, double *x, double *buf) {
    const double *L = (const double *)values;
    const sli_step *begin = R->steps, *s = begin + R->count;
    const sl_int *rows = R->rows + R->n_rows;
    while (s > begin) {
        if (SLI_SMALL && s[-1].width <= SLI_TILE) {
            s = SLV_NAME_SHORT(complex_backward_small)(s, begin, &rows, L, D, x);
        } else {
            rows -= (--s)->below;
            SLV_NAME(complex_backward_step)(s, rows, L, D, x, buf);
        }
    }
}

#undef SLI_TAKE_SUM
#undef SLI_INSIDE
#undef SLI_ROW_AT
#undef SLI_DECLARE
#undef SLI_HALF
#undef SLI_UNIT_TRIANGLE
#undef SLI_XT
#undef SLI_SMALL

#endif
