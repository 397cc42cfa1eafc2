/* complex_small.inl.h: one right-hand side through a supernode of 1 to 4 complex columns */

#if defined(SLW_LAST) /* once for each instruction set */

/* As small_supernode.inl.h, with the storage of complex_rows.inl.h: the width is a constant in each
 * of 4 copies, and y or the sums of all columns stay in registers. */

/* r(j) -= conj(L(k, j)) r(k) */
#define SLI_XT(j, k) \
    { \
        const double re = l[SLI_TILE / 2 * (j) + (k)], im = l[SLI_TILE / 2 * (j) + (k) + 1]; \
        r[j] = SLV_FNMA1(re, r[k], SLV_FNMA1(im, r[(k) + 1], r[j])); \
        r[(j) + 1] = SLV_FNMA1(re, r[(k) + 1], SLV_FNMA1(-im, r[k], r[(j) + 1])); \
    }

/* The same for all pairs k of the w columns of a diagonal tile at l. */
#define SLI_UNIT_TRIANGLE(w) \
    if ((w) > 6) { \
        SLI_XT(0, 6) SLI_XT(2, 6) SLI_XT(4, 6) \
    } \
    if ((w) > 4) { \
        SLI_XT(0, 4) SLI_XT(2, 4) \
    } \
    if ((w) > 2) { \
        SLI_XT(0, 2) \
    }

#if defined(SLV_OWN_SHORT)
#define SLI_DECLARE(k, y) SLV_DECLARE(y##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_SUM_ZERO(k, a) SLV_SUM_ZERO(a##k)
#define SLI_EACH_PAIR(op) op(0, 1) op(2, 3) op(4, 5) op(6, 7)

/* The pair of columns k, m = k + 1 of the diagonal tile, and of a tile below. */
#define SLI_PAIR(k, m) \
    if ((k) < w) { \
        SLI_PREFETCH(l + SLI_TILE / 2 * (k), SLI_PREFETCH_DISTANCE); \
        SLV_LANE(y##k, a, k) \
        SLV_LANE(y##m, a, m) \
        SLV_ZERO(b) \
        SLV_DOT(a, l + SLI_TILE / 2 * (k), y##k) \
        SLV_DOT(b, l + SLI_TILE / 2 * (k), y##m) \
        SLV_TURN(b, b) \
        SLV_ADD(a, b) \
    }
#define SLI_PAIR_BELOW(k, m) \
    if ((k) < w) { \
        SLI_PREFETCH(l + SLI_TILE / 2 * (k), SLI_PREFETCH_DISTANCE); \
        SLV_DOT(a, l + SLI_TILE / 2 * (k), y##k) \
        SLV_DOT(b, l + SLI_TILE / 2 * (k), y##m) \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void
SLV_NAME(complex_small_forward)(const sl_int w, const sli_step *s, const sl_int *rows,
                                const double *L, double *x, double *buf) {
    const sl_int below = s->below;
    const double *l = L + s->panel / 2;
    double *xs = x + s->base;
    sl_int row, i;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    SLI_EACH8(SLI_DECLARE, y)
    SLV_LOAD_PART(a, xs, w, 0.0)
    SLI_EACH_PAIR(SLI_PAIR)
    SLV_STORE(buf, a)
    for (i = 0; i < w; i++) {
        xs[i] = buf[i];
    }
    for (row = SLI_TILE; row < w + below; row += SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
        l += SLI_TILE / 2 * w;
        SLV_ZERO(a)
        SLV_ZERO(b)
        SLI_EACH_PAIR(SLI_PAIR_BELOW)
        SLV_TURN(b, b)
        SLV_ADD(a, b)
        SLV_STORE(buf + row, a)
    }
    buf += w;
    for (i = 0; i < below; i += 2) {
        x[rows[i]] += buf[i];
        x[rows[i + 1]] += buf[i + 1];
    }
}

/* x(j) -= conj(L(rows, j)) x(rows), from the last column to the first. */
#define SLI_DOT(k, m) \
    if ((k) < w) { \
        SLI_PREFETCH(l + SLI_TILE / 2 * (k), -SLI_PREFETCH_DISTANCE); \
        SLV_SUM_DOT(a##k, l + SLI_TILE / 2 * (k), v) \
        SLV_SUM_DOT(a##m, l + SLI_TILE / 2 * (k), u) \
    }
#define SLI_DOTS \
    SLV_TURN_BACK(u, v) \
    SLI_DOT(6, 7) SLI_DOT(4, 5) SLI_DOT(2, 3) SLI_DOT(0, 1)
/* Positions in x of the 8 rows of a tile, as in small_supernode.inl.h. */
#define SLI_ROW_AT(k) rows[at + (k)]
#define SLI_ROW_AT_PART(k) rows[at + sli_min(k, count - 1)]
#define SLI_ROW_AT_OWN(k) rows[sli_clamp((k)-w, at - 1)]

SLV_FUNCTION SLI_ALWAYS_INLINE void
SLV_NAME(complex_small_backward)(const sl_int w, const sli_step *s, const sl_int *rows,
                                 const double *L, const double *D, double *x) {
    const sl_int below = s->below, count = (w + below) % SLI_TILE;
    const double *l = L + (s->panel + sli_panel_size(w, below)) / 2; /* its end */
    const double *d = D + s->column;
    double *xs = x + s->base;
    sl_int row = w + below - count, at = below, k;
    double r[SLI_TILE];
    SLV_DECLARE(u)
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLI_EACH8(SLI_SUM_ZERO, a)
    if ((w == SLI_TILE || row > 0) && count > 0) {
        at -= count;
        l -= SLI_TILE / 2 * w;
        SLV_GATHER(v, x, SLI_ROW_AT_PART)
        SLV_FIRST(v, count)
        SLI_DOTS
    }
    for (; row > SLI_TILE; row -= SLI_TILE) {
        at -= SLI_TILE;
        l -= SLI_TILE / 2 * w;
        SLV_GATHER(v, x, SLI_ROW_AT)
        SLI_DOTS
    }
    l -= SLI_TILE / 2 * w;
    if (w < SLI_TILE && at > 0) {
        SLV_GATHER(v, x, SLI_ROW_AT_OWN)
        SLV_FIRST(v, w + at)
        SLV_BELOW(v, w - 1)
        SLI_DOTS
    }
    SLV_LOAD_PART(z, xs, w, 0.0)
    SLV_LOAD_PART(v, d, w, 1.0)
    SLV_DIVIDE(z, z, v)
    SLV_SUMS(v, a)
    SLV_ADD(v, z)
    SLV_STORE_ANY(r, v)
    SLI_UNIT_TRIANGLE(w)
    for (k = 0; k < w; k++) {
        xs[k] = r[k];
    }
}

#define SLI_EACH_WIDTH(call) \
    switch (w) { \
        SLI_CASE(2, call) \
        SLI_CASE(4, call) \
        SLI_CASE(6, call) \
    default: \
        call(8); \
    }
#define SLI_FORWARD(k) SLV_NAME(complex_small_forward)(k, s, rows, L, x, buf)
#define SLI_BACKWARD(k) SLV_NAME(complex_small_backward)(k, s, rows, L, D, x)

/* Runs of such supernodes, as in small_supernode.inl.h. */
SLV_FUNCTION SLI_INLINE const sli_step *
SLV_NAME(complex_forward_small)(const sli_step *s, const sli_step *end, const sl_int **next_rows,
                                const double *L, double *x, double *buf) {
    const sl_int *rows = *next_rows;
    for (; s < end && s->width <= SLI_TILE; s++) {
        const sl_int w = s->width;
        SLI_EACH_WIDTH(SLI_FORWARD);
        rows += s->below;
    }
    *next_rows = rows;
    return s;
}

SLV_FUNCTION SLI_INLINE const sli_step *
SLV_NAME(complex_backward_small)(const sli_step *s, const sli_step *begin, const sl_int **rows_end,
                                 const double *L, const double *D, double *x) {
    const sl_int *rows = *rows_end;
    while (s > begin && s[-1].width <= SLI_TILE) {
        const sl_int w = (--s)->width;
        rows -= s->below;
        SLI_EACH_WIDTH(SLI_BACKWARD);
    }
    *rows_end = rows;
    return s;
}
#endif

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_SUM_ZERO
#undef SLI_EACH_PAIR
#undef SLI_PAIR
#undef SLI_PAIR_BELOW
#undef SLI_DOT
#undef SLI_DOTS
#undef SLI_ROW_AT
#undef SLI_ROW_AT_PART
#undef SLI_ROW_AT_OWN
#undef SLI_EACH_WIDTH
#undef SLI_FORWARD
#undef SLI_BACKWARD

#endif
