/* row.inl.h: one row of L in the up-looking factorization */

/* See sli_row_kernel. */
SLV_FUNCTION static void SLV_NAME(row)(sli_row *k, const sli_step *s, sl_int q,
                                       const sl_int *rows) {
    const sl_int w = s->width, columns = sli_min(q, w);
    const double *D = k->D + s->column;
    double *panel = k->L + s->panel, *lq = panel + sli_panel_at(w, q, 0);
    double *x = k->x, *xs = x + s->column, *buf = k->scratch;
    double d = k->pivot, size = k->magnitude;
    sl_int i;
    for (i = 0; i < columns; i++) { /* y = row of A minus the updates of descendants */
        buf[i] = lq[SLI_TILE * i] + xs[i];
        xs[i] = 0.0;
    }
    if (w == 1) {
        for (i = 1; i < q; i++) {
            x[rows[i - 1]] = SLV_FNMA1(panel[i], buf[0], x[rows[i - 1]]);
        }
    } else if (q > 1) { /* before row 1 is the row of a pivot only */
        for (; i < SLI_TILE * sli_tiles(q); i++) {
            buf[i] = 0.0;
        }
        SLV_NAME(panel_forward)(panel, 0, w, columns, q, buf);
    }
    for (i = w; i < q && w > 1; i++) {
        x[rows[i - w]] += buf[i];
    }
    for (i = 0; i < columns; i++) { /* l(k, j) = y(j) / d(j), d(k) -= l(k, j) y(j) */
        const double l = buf[i] / D[i];
        lq[SLI_TILE * i] = l;
        d = SLV_FNMA1(l, buf[i], d);
        size += fabs(l * buf[i]);
    }
    k->pivot = d;
    k->magnitude = size;
}
