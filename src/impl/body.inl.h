/* body.inl.h: one right-hand side, SIMD along the 8 rows of a tile; the words SLV_* are one octet of doubles */

/* buf := L^-1 buf on the first `rows` local rows of a panel, its columns 8 t0 .. columns-1 applied
 * in ascending order. tile points at tile t0. Four partial sums hide the latency of the FMA; their
 * grouping depends on the column number alone, so that a sweep that starts later, over zeros, gives
 * the same bits. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(panel_forward)(const double *tile, sl_int t0, sl_int width,
                                                     sl_int columns, sl_int rows, double *buf) {
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
            const double *l = tile + SLI_TILE * j;
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
            SLV_NAME(tile_forward)(tile + SLI_TILE * row, buf + row);
        } else {
            for (k = 0; k < inner; k++) { /* columns inside the tile, one after the other */
                SLV_AXPY(a0, tile + SLI_TILE * (row + k), buf + row + k)
                SLV_STORE(buf + row, a0)
            }
        }
        tile += SLI_TILE * sli_min(width, row + SLI_TILE);
    }
}

SLV_FUNCTION static void SLV_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + s->base;
        sl_int i;
        if (w <= SLI_TILE) {
            SLV_NAME(forward_narrow)(w, s->below, rows, tile, xs, x, buf);
            rows += s->below;
            continue;
        }
        memcpy(buf + first, xs, (size_t)(w - first) * sizeof(double));
        for (i = w; i < SLI_TILE * sli_tiles(height); i++) {
            buf[i] = 0.0;
        }
        SLV_NAME(panel_forward)(tile, s->first_tile, w, w, height, buf);
        memcpy(xs, buf + first, (size_t)(w - first) * sizeof(double));
        for (i = 0; i < s->below; i++) {
            x[rows[i]] += buf[w + i];
        }
        rows += s->below;
    }
}

/* The backward pass over one panel: buf holds the final x of the rows below and 0 on the columns, z
 * the columns' right side; the columns come out in buf. sums keeps 8 partial sums a column, one for
 * each lane. end: one past the panel. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(panel_backward)(const double *end, sl_int t0, sl_int width,
                                                      sl_int height, const double *z, double *buf,
                                                      double *sums) {
    const sl_int first = SLI_TILE * t0;
    const double *tile = end;
    sl_int t, j, k;
    SLV_DECLARE(v)
    SLV_DECLARE(a)
    SLV_ZERO(a)
    for (j = first; j < width; j++) {
        SLV_STORE(sums + SLI_TILE * j, a)
    }
    for (t = sli_tiles(height) - 1; t >= t0; t--) {
        const sl_int row = SLI_TILE * t, inner = sli_clamp(width - row, SLI_TILE);
        tile -= SLI_TILE * sli_min(width, row + SLI_TILE);
        if (inner > 0) {
            double r[SLI_TILE];
            const double *l = tile + SLI_TILE * row;
            SLV_LOAD(v, buf + row) /* 0 on the columns: only rows below count here */
            for (k = 0; k < inner; k++) {
                SLV_LOAD(a, sums + SLI_TILE * (row + k))
                if (inner < SLI_TILE) {
                    SLV_DOT(a, l + SLI_TILE * k, v)
                }
                r[k] = z[row + k] + SLV_SUM(a);
            }
            if (inner == SLI_TILE) {
                SLV_NAME(tile_backward)(l, r);
            } else {
                for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
                    for (j = 0; j < k; j++) {
                        r[j] = SLV_FNMA1(l[SLI_TILE * j + k], r[k], r[j]);
                    }
                }
            }
            for (k = 0; k < inner; k++) {
                buf[row + k] = r[k];
            }
        }
        SLV_LOAD(v, buf + row)
        for (j = sli_min(row, width) - 1; j >= first; j--) { /* x(j) -= L(rows, j)' x(rows) */
            SLV_LOAD(a, sums + SLI_TILE * j)
            SLV_DOT(a, tile + SLI_TILE * j, v)
            SLV_STORE(sums + SLI_TILE * j, a)
        }
    }
}

SLV_FUNCTION static void SLV_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        double *xs = x + s->base - first;
        const double *d = D + s->column - first, *end = L + s->panel + sli_panel_size(w, s->below);
        sl_int i;
        rows_end -= s->below;
        if (w <= SLI_TILE) {
            SLV_NAME(backward_narrow)(w, s->below, rows_end, end, d, xs, x);
            continue;
        }
        for (i = first; i < w; i++) {
            xs[i] /= d[i];
            buf[i] = 0.0;
        }
        for (i = 0; i < s->below; i++) {
            buf[w + i] = x[rows_end[i]];
        }
        for (i = height; i < padded; i++) {
            buf[i] = 0.0;
        }
        SLV_NAME(panel_backward)(end, s->first_tile, w, height, xs, buf, buf + padded);
        memcpy(xs + first, buf + first, (size_t)(w - first) * sizeof(double));
    }
}

SLV_FUNCTION static void SLV_NAME(row)(double *panel, sl_int w, sl_int q, const sl_int *rows,
                                       const double *D, double *xs, double *x, double *buf,
                                       double *pivot, double *magnitude) {
    const sl_int columns = sli_min(q, w);
    double *lq = panel + sli_panel_at(w, q, 0);
    double d = *pivot, size = *magnitude;
    sl_int i;
    for (i = 0; i < columns; i++) { /* y = row of A minus what the descendants sent */
        buf[i] = lq[SLI_TILE * i] + xs[i];
        xs[i] = 0.0;
    }
    for (; i < SLI_TILE * sli_tiles(q); i++) {
        buf[i] = 0.0;
    }
    SLV_NAME(panel_forward)(panel, 0, w, columns, q, buf);
    for (i = w; i < q; i++) {
        x[rows[i - w]] += buf[i];
    }
    for (i = 0; i < columns; i++) { /* l(k, j) = y(j) / d(j), d(k) -= l(k, j) y(j) */
        const double l = buf[i] / D[i];
        lq[SLI_TILE * i] = l;
        d = SLV_FNMA1(l, buf[i], d);
        size += fabs(l * buf[i]);
    }
    *pivot = d;
    *magnitude = size;
}

static const sli_kernels SLV_NAME(kernels) = {
    SLV_ISA,
    {SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME(forward4), SLV_NAME(forward8)},
    {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME(backward4), SLV_NAME(backward8)},
    SLV_NAME(row),
    SLV_NAME(front),
    SLV_NAME(assemble)};
