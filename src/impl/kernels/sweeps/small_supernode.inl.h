/* small_supernode.inl.h: one right-hand side through a supernode of at most 8 columns */

/* Most supernodes of a 2D mesh are this small. They do not spend their time reading L but on loops
 * of few iterations, on calls, and on vector loads of values that were just stored one by one. Here
 * there are no loops over columns: y or the sums of all columns stay in registers, and x is
 * gathered directly into registers. */

#if !defined(SLV_PLAIN)
/* Is k a column? The supernode has at least two. */
#define SLI_HAS(k) ((k) < 2 || (k) < w)
#define SLI_DECLARE(k, y) \
    SLV_DECLARE(y##k) \
    SLV_ZERO(y##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_SUM_ZERO(k, a) SLV_SUM_ZERO(a##k)

/* The diagonal tile, one column after another; L is stored as 0 on and above its diagonal. */
#define SLI_COLUMN(k, unused) \
    if (SLI_HAS(k)) { \
        SLV_PREFETCH(l, k, SLI_PREFETCH_DISTANCE) \
        SLV_LANE(y##k, a, k) \
        SLV_DOT(a, l + SLI_TILE * (k), y##k) \
    }
#define SLI_PUT(k, unused) \
    if (SLI_HAS(k)) { \
        xs[k] = buf[k]; \
    }
/* A tile below: even and odd columns have a sum each, two independent chains of FMAs. */
#define SLI_EVEN_ODD(k, unused) \
    if (SLI_HAS(k)) { \
        SLV_PREFETCH(l, k, SLI_PREFETCH_DISTANCE) \
        if ((k) % 2 == 0) { \
            SLV_DOT(a, l + SLI_TILE * (k), y##k) \
        } else { \
            SLV_DOT(b, l + SLI_TILE * (k), y##k) \
        } \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_SWEEP(small_forward)(const sl_int w, const sli_step *s,
                                                             const sl_int *rows, const SLV_VALUE *L,
                                                             double *x, double *buf) {
    const sl_int below = s->below;
    const SLV_VALUE *l = L + s->panel;
    double *xs = x + s->base;
    sl_int row, i;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    SLI_EACH8(SLI_DECLARE, y)
    SLV_LOAD_PART(a, xs, w, 0.0)
    SLI_EACH8(SLI_COLUMN, 0)
    SLV_STORE(buf, a)
    SLI_EACH8(SLI_PUT, 0)
    for (row = SLI_TILE; row < w + below; row += SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
        l += SLI_TILE * w;
        SLV_ZERO(a)
        SLV_ZERO(b)
        SLI_EACH8(SLI_EVEN_ODD, 0)
        SLV_ADD(a, b)
        SLV_STORE(buf + row, a)
    }
    buf += w;
    for (i = 0; i + 4 <= below; i += 4) {
        x[rows[i]] += buf[i];
        x[rows[i + 1]] += buf[i + 1];
        x[rows[i + 2]] += buf[i + 2];
        x[rows[i + 3]] += buf[i + 3];
    }
    for (; i < below; i++) {
        x[rows[i]] += buf[i];
    }
}

/* x(j) -= L(rows, j)' x(rows), from the last column to the first: L is read backward in memory. */
#define SLI_DOT(k) \
    if (SLI_HAS(k)) { \
        SLV_PREFETCH(l, k, -SLI_PREFETCH_DISTANCE) \
        SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v) \
    }
#define SLI_DOTS SLI_DOT(7) SLI_DOTS_OWN
#define SLI_DOTS_OWN SLI_DOT(6) SLI_DOT(5) SLI_DOT(4) SLI_DOT(3) SLI_DOT(2) SLI_DOT(1) SLI_DOT(0)
/* Positions in x of the 8 rows of a tile. PART: the last tile, which has fewer rows; its last
 * position is repeated. OWN: the tile that holds the columns too, at most 7; their lanes get any
 * valid position. */
#define SLI_ROW_AT(k) rows[at + (k)]
#define SLI_ROW_AT_PART(k) rows[at + sli_min(k, count - 1)]
#define SLI_ROW_AT_OWN(k) rows[sli_clamp((k)-w, at - 1)]
#define SLI_SET(k, unused) double r##k = r[k];
#define SLI_GET(k, unused) \
    if (SLI_HAS(k)) { \
        xs[k] = r##k; \
    }
#define SLI_XT(j, k) \
    if ((j) < (k) && SLI_HAS(k)) { /* r(j) -= L(k, j) r(k) */ \
        r##j = SLV_FNMA1(t[SLI_TILE * (j) + (k)], r##k, r##j); \
    }
#define SLI_ROW(k) \
    SLI_XT(6, k) SLI_XT(5, k) SLI_XT(4, k) SLI_XT(3, k) SLI_XT(2, k) SLI_XT(1, k) SLI_XT(0, k)

SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_SWEEP(small_backward)(const sl_int w, const sli_step *s,
                                                              const sl_int *rows,
                                                              const SLV_VALUE *L, const double *D,
                                                              double *x) {
    const sl_int below = s->below, count = (w + below) % SLI_TILE;
    const SLV_VALUE *l = L + s->panel + sli_panel_size(w, below); /* its end */
    const double *d = D + s->column;
    double *xs = x + s->base;
    sl_int row = w + below - count, at = below;
    double r[SLI_TILE];
    SLV_WIDE(t, SLI_TILE)
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLI_EACH8(SLI_SUM_ZERO, a)
    for (row += count > 0 ? SLI_TILE : 0; row > SLI_TILE; row -= SLI_TILE) {
        l -= SLI_TILE * w;
        if (at == below && count > 0) {
            at -= count;
            SLV_GATHER(v, x, SLI_ROW_AT_PART)
            SLV_FIRST(v, count)
        } else {
            at -= SLI_TILE;
            SLV_GATHER(v, x, SLI_ROW_AT)
        }
        SLI_DOTS
    }
    l -= SLI_TILE * w;
    if (w < SLI_TILE && at > 0) {
        SLV_GATHER(v, x, SLI_ROW_AT_OWN)
        SLV_FIRST(v, w + at)
        SLV_BELOW(v, w - 1)
        SLI_DOTS_OWN
    }
    SLV_WIDEN(t, l, w, SLI_TILE)
    SLV_LOAD_PART(z, xs, w, 0.0)
    SLV_LOAD_PART(v, d, w, 1.0)
    SLV_DIVIDE(z, z, v)
    SLV_SUMS(v, a)
    SLV_ADD(v, z)
    SLV_STORE_ANY(r, v)
    SLI_EACH8(SLI_SET, 0)
    SLI_ROW(7)
    SLI_ROW(6)
    SLI_ROW(5)
    SLI_ROW(4)
    SLI_ROW(3)
    SLI_ROW(2)
    SLI_ROW(1)
    SLI_EACH8(SLI_GET, 0)
}

#else
SLV_FUNCTION SLI_INLINE void SLV_SWEEP(small_forward)(sl_int w, const sli_step *s,
                                                      const sl_int *rows, const SLV_VALUE *L,
                                                      double *x, double *buf) {
    const sl_int below = s->below;
    const SLV_VALUE *l = L + s->panel;
    double *xs = x + s->base;
    sl_int row, i, k;
    double a[SLI_TILE] = {0.0}, b[SLI_TILE], y[SLI_TILE];
    SLI_COPY(a, xs, w);
    for (k = 0; k < w; k++) {
        y[k] = a[k];
        SLI_LOOP(SLI_TILE, a[i_] -= l[SLI_TILE * k + i_] * y[k])
    }
    memcpy(buf, a, sizeof a);
    SLI_COPY(xs, a, w);
    for (row = SLI_TILE; row < w + below; row += SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
        l += SLI_TILE * w;
        SLV_ZERO(a)
        SLV_ZERO(b)
        for (k = 0; k + 2 <= w; k += 2) {
            SLI_PREFETCH(l + SLI_TILE * k, SLI_PREFETCH_DISTANCE);
            SLI_LOOP(SLI_TILE, a[i_] -= l[SLI_TILE * k + i_] * y[k])
            SLI_LOOP(SLI_TILE, b[i_] -= l[SLI_TILE * k + SLI_TILE + i_] * y[k + 1])
        }
        if (k < w) {
            SLI_LOOP(SLI_TILE, a[i_] -= l[SLI_TILE * k + i_] * y[k])
        }
        SLI_LOOP(SLI_TILE, buf[row + i_] = a[i_] + b[i_])
    }
    for (i = 0; i < below; i++) {
        x[rows[i]] += buf[w + i];
    }
}

/* A tile takes the rows from..end of x, others count as 0. */
SLV_FUNCTION SLI_INLINE void SLV_SWEEP(small_backward)(sl_int w, const sli_step *s,
                                                       const sl_int *rows, const SLV_VALUE *L,
                                                       const double *D, double *x) {
    const sl_int below = s->below;
    const SLV_VALUE *l = L + s->panel + sli_panel_size(w, below); /* its end */
    const double *d = D + s->column;
    double *xs = x + s->base;
    double a[SLI_TILE] = {0.0}, v[SLI_TILE] = {0.0};
    sl_int row = (w + below - 1) / SLI_TILE * SLI_TILE, j, k;
    for (; row >= 0; row -= SLI_TILE) { /* x(j) -= L(rows, j)' x(rows) */
        const sl_int from = sli_max(row, w), end = sli_min(row + SLI_TILE, w + below);
        l -= SLI_TILE * w;
        SLV_ZERO(v)
        for (j = from; j < end; j++) {
            v[j - row] = x[rows[j - w]];
        }
        for (k = from < end ? w - 1 : -1; k >= 0; k--) {
            SLI_PREFETCH(l + SLI_TILE * k, -SLI_PREFETCH_DISTANCE);
            SLV_SUM_DOT(a[k], l + SLI_TILE * k, v)
        }
    }
    for (k = 0; k < w; k++) {
        a[k] += xs[k] / d[k];
    }
    for (k = w - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
        for (j = 0; j < k; j++) {
            a[j] = SLV_FNMA1((double)l[SLI_TILE * j + k], a[k], a[j]);
        }
    }
    SLI_COPY(xs, a, w);
}
#endif

/* A run of supernodes of one column from step s on, in scalars: most have few rows below. Where
 * R->plain has the rows below each, only the first step of the run is read. Returns the step after
 * the run. */
SLV_FUNCTION SLI_INLINE const sli_step *SLV_SWEEP(forward_plain)(const sli_step *s,
                                                                 const sli_reach *R,
                                                                 const sl_int **next_rows,
                                                                 const SLV_VALUE *L, double *x) {
    const sli_step *end = R->steps + R->count, *first = s;
    const sl_int *plain = R->plain == NULL ? NULL : R->plain + (s - R->steps);
    const sl_int *last = R->plain == NULL ? NULL : R->plain + R->count;
    const sl_int *rows = *next_rows;
    const SLV_VALUE *l = L + s->panel;
    const double *from = x + s->base, *xs = from;
    sl_int below = s->below, i;
    do {
        const double y = *xs++;
        if (below == 1) { /* x(i) += 0 - L(i) y, for slots (sweep_tasks.h) */
            x[*rows++] += SLV_FNMA1((double)l[1], y, 0.0);
            l += 2;
        } else {
            l++;
            for (i = 0; i < below; i++) {
                x[rows[i]] += SLV_FNMA1((double)l[i], y, 0.0);
            }
            rows += below;
            l += below;
        }
        if (plain != NULL) {
            below = ++plain < last ? *plain : -1;
        } else if (++s < end && s->width == 1) {
            below = s->below;
            l = L + s->panel;
        } else {
            below = -1;
        }
    } while (below >= 0);
    *next_rows = rows;
    return first + (xs - from);
}

/* The same before step s, in descending order. Returns the first step of the run. */
SLV_FUNCTION SLI_INLINE const sli_step *
SLV_SWEEP(backward_plain)(const sli_step *s, const sli_reach *R, const sl_int **rows_end,
                          const SLV_VALUE *L, const double *D, double *x) {
    const sl_int *begin = R->plain, *rows = *rows_end;
    const sl_int *plain = begin == NULL ? NULL : begin + (s - 1 - R->steps);
    const sli_step *last = s--;
    const SLV_VALUE *l = L + s->panel + 1 + s->below;
    const double *d = D + s->column;
    double *from = x + s->base + 1, *xs = from;
    sl_int below = s->below, i;
    do {
        double y = *--xs / *d;
        if (below == 1) {
            y = SLV_FNMA1((double)l[-1], x[*--rows], y);
            l -= 2;
        } else {
            rows -= below;
            l -= below;
            i = 0;
            if (below >= 4) { /* y -= L' x, in four sums */
                double a = 0.0, b = 0.0, c = 0.0;
                for (; i + 4 <= below; i += 4) {
                    y = SLV_FNMA1((double)l[i], x[rows[i]], y);
                    a = SLV_FNMA1((double)l[i + 1], x[rows[i + 1]], a);
                    b = SLV_FNMA1((double)l[i + 2], x[rows[i + 2]], b);
                    c = SLV_FNMA1((double)l[i + 3], x[rows[i + 3]], c);
                }
                y += a + (b + c);
            }
            for (; i < below; i++) {
                y = SLV_FNMA1((double)l[i], x[rows[i]], y);
            }
            l--;
        }
        *xs = y;
        if (plain != NULL) {
            below = plain > begin ? *--plain : -1;
            d -= below >= 0;
        } else if (s > R->steps && s[-1].width == 1) {
            s--;
            below = s->below;
            l = L + s->panel + 1 + below;
            d = D + s->column;
        } else {
            below = -1;
        }
    } while (below >= 0);
    *rows_end = rows;
    return last - (from - xs);
}

/* A run of such supernodes from step s on, up to one that is wider. Returns the step
 * after the run and moves next_rows on. A function for runs, because a call for each supernode took
 * 3 % of the time of a solve. */
SLI_AT_LINE SLV_FUNCTION static const sli_step *
SLV_SWEEP(forward_small)(const sli_step *s, const sli_reach *R, const sl_int **next_rows,
                         const SLV_VALUE *L, double *x, double *buf) {
    const sl_int *rows = *next_rows;
    const sli_step *end = R->steps + R->count;
    while (s < end && s->width <= SLI_TILE) {
        const sl_int w = s->width;
        if (w == 1) {
            s = SLV_SWEEP(forward_plain)(s, R, &rows, L, x);
            continue;
        }
        SLV_SWEEP(small_forward)(w, s, rows, L, x, buf);
        rows += (s++)->below;
    }
    *next_rows = rows;
    return s;
}

/* The same before step s, in descending order. Returns the first step of the run.
 */
SLI_AT_LINE SLV_FUNCTION static const sli_step *
SLV_SWEEP(backward_small)(const sli_step *s, const sli_reach *R, const sl_int **rows_end,
                          const SLV_VALUE *L, const double *D, double *x) {
    const sl_int *rows = *rows_end;
    const sli_step *begin = R->steps;
    while (s > begin && s[-1].width <= SLI_TILE) {
        const sl_int w = s[-1].width;
        if (w == 1) {
            s = SLV_SWEEP(backward_plain)(s, R, &rows, L, D, x);
            continue;
        }
        rows -= (--s)->below;
        SLV_SWEEP(small_backward)(w, s, rows, L, D, x);
    }
    *rows_end = rows;
    return s;
}

#undef SLI_HAS
#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_SUM_ZERO
#undef SLI_COLUMN
#undef SLI_PUT
#undef SLI_EVEN_ODD
#undef SLI_DOT
#undef SLI_DOTS
#undef SLI_DOTS_OWN
#undef SLI_ROW_AT
#undef SLI_ROW_AT_PART
#undef SLI_ROW_AT_OWN
#undef SLI_SET
#undef SLI_GET
#undef SLI_XT
#undef SLI_ROW
