/* front.inl.h: a front of the multifrontal factorization: its panel factored, its update matrix made and handed on */

/* l(rows, k) = x(rows, k) / d(k), by the reciprocal where that loses nothing */
#define SLI_SCALE(l, x, k)                                                                         \
    if (by_reciprocal) {                                                                           \
        SLV_BROADCAST(b, reciprocal + (k))                                                         \
        SLV_MULTIPLY(l, x, b)                                                                      \
    } else {                                                                                       \
        SLV_BROADCAST(b, D + (k))                                                                  \
        SLV_DIVIDE(l, x, b)                                                                        \
    }

/* magnitude(rows) += |l d l|, with x = l d */
#define SLI_GAIN(l, x, k)                                                                          \
    SLV_BROADCAST(b, against + (k))                                                                \
    SLV_MULTIPLY(b, l, b)                                                                          \
    SLV_FNMA(m, b, x)

#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#define SLI_LOAD(k, p)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(a##k, (p) + SLI_TILE * (k))                                                       \
    } else {                                                                                       \
        SLV_ZERO(a##k)                                                                             \
    }

/* The diagonal tile, column k: the pivot, then the columns after it lose l(rows) x(column). Here by
 * division, one step shorter than by the reciprocal: all wait for this chain. */
#define SLI_AFTER(i, k)                                                                            \
    if ((i) > (k)) {                                                                               \
        SLV_BROADCAST(b, x + SLI_TILE * (k) + (i))                                                 \
        SLV_FNMA(a##i, l, b)                                                                       \
    }
#define SLI_PIVOT(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        double d;                                                                                  \
        SLV_STORE(x + SLI_TILE * (k), a##k)                                                        \
        SLV_STORE(sums, m)                                                                         \
        SLV_LANE(b, a##k, k)                                                                       \
        d = x[SLI_TILE * (k) + (k)];                                                               \
        if (rule != NULL) {                                                                        \
            d = sli_pivot_ruled(rule, column + (k), d, sums[k]);                                   \
            SLV_BROADCAST(b, &d)                                                                   \
        }                                                                                          \
        SLV_DIVIDE(l, a##k, b)                                                                     \
        D[k] = d;                                                                                  \
        magnitude[k] = sums[k];                                                                    \
        against[k] = d < 0.0 ? 1.0 : -1.0;                                                         \
        reciprocal[k] = 1.0 / d;                                                                   \
        safe &= fabs(d) > 1e-290 && fabs(d) < 1e290;                                               \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_BELOW(l, k)                                                                            \
        SLV_STORE((p) + SLI_TILE * (k), l)                                                         \
        SLI_EACH8_AGAIN(SLI_AFTER, k)                                                              \
    }

/* The tiles below: x(rows, k) -= x(rows, j) L(k, j) for j < k, then l. */
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, p + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, q)                                                                            \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
        SLI_SCALE(l, a##k, k)                                                                      \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_STORE((q) + SLI_TILE * (k), l)                                                         \
    }

/* The pivots of column tile c, whose columns before it are done: 8, or fewer in the last one. */
SLV_FUNCTION static void SLV_NAME(pivots_of_tile)(const sli_front *f, sl_int c, double *inverse) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first);
    const sl_int column = f->column + first;
    const sli_pivot_rule *rule = f->rule->replaces ? f->rule : NULL;
    double *p = f->panel + sli_tile_offset(f->width, c) + SLI_TILE * (ptrdiff_t)first;
    double *D = f->D + first, *magnitude = f->magnitude + first;
    double *reciprocal = inverse, *against = inverse + SLI_TILE;
    SLI_ALIGNED(double x[SLI_TILE * SLI_TILE + SLI_TILE]);
    double *sums = x + SLI_TILE * SLI_TILE;
    int safe = 1;
    sl_int t;
    SLV_DECLARE(b)
    SLV_DECLARE(l)
    SLV_DECLARE(m)
    SLI_EACH8(SLI_DECLARE, 0)
    SLV_LOAD(m, magnitude)
    SLI_EACH8(SLI_LOAD, p)
    SLI_EACH8(SLI_PIVOT, p)
    SLV_STORE(sums, m)
    for (t = columns; t < SLI_TILE; t++) { /* rows below that share the last tile of pivots */
        magnitude[t] = sums[t];
    }
    if (!safe) {
        reciprocal[0] = 0.0;
    }
}

/* Column tile c of row tiles t0 .. t1-1, all below its pivots. */
SLV_FUNCTION static void SLV_NAME(rows_of_tile)(const sli_front *f, sl_int c, sl_int t0, sl_int t1,
                                                const double *inverse) {
    const sl_int w = f->width, first = SLI_TILE * c, columns = sli_min(SLI_TILE, w - first);
    const double *p = f->panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)first;
    const double *D = f->D + first, *reciprocal = inverse, *against = inverse + SLI_TILE;
    const int by_reciprocal = reciprocal[0] != 0.0;
    sl_int t;
    for (t = t0; t < t1; t++) {
        double *q = f->panel + sli_tile_offset(w, t) + SLI_TILE * (ptrdiff_t)first;
        double *magnitude = f->magnitude + SLI_TILE * (ptrdiff_t)t;
        SLV_DECLARE(b)
        SLV_DECLARE(l)
        SLV_DECLARE(m)
        SLI_EACH8(SLI_DECLARE, 0)
        SLV_LOAD(m, magnitude)
        SLI_EACH8(SLI_LOAD, q)
        SLI_EACH8(SLI_SOLVE, q)
        SLV_STORE(magnitude, m)
    }
}

#undef SLI_SCALE
#undef SLI_GAIN
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_AFTER
#undef SLI_PIVOT
#undef SLI_BEFORE
#undef SLI_SOLVE

/* Column tile c of row tiles t0 .. t1-1 before its pivots are applied: the group's columns before it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(catch_up)(const sli_front *f, sl_int c0, sl_int c, sl_int t0,
                                                sl_int t1, double *B) {
    if (c > c0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c, c + 1, SLI_TILE * c0, SLI_TILE * c, f->panel,
         f->width, 0, B);
    }
}

SLV_FUNCTION static void SLV_NAME(pivots)(const sli_front *f, sl_int c0, double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, c0, c1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        double *inverse = f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0);
        SLV_NAME(catch_up)(f, c0, c, c, c1, B);
        SLV_NAME(pivots_of_tile)(f, c, inverse);
        SLV_NAME(rows_of_tile)(f, c, c + 1, c1, inverse);
    }
}

SLV_FUNCTION static void SLV_NAME(rows)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                                        double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        SLV_NAME(catch_up)(f, c0, c, t0, t1, B);
        SLV_NAME(rows_of_tile)
        (f, c, t0, t1, f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0));
    }
}

SLV_FUNCTION static void SLV_NAME(update)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0,
                                          sl_int t1, double *B) {
    const sl_int w = f->width, last = sli_min(c1, t1);
    sl_int c;
    for (c = c0; c < last; c += SLI_GROUP) {
        SLV_NAME(product)
        (f->panel, w, f->D, sli_max(t0, c), t1, c, sli_min(c + SLI_GROUP, last), 0, w, f->update,
         SLI_TILE * (t1 - c0), c0, B);
    }
}

/* What a child hands over, row by row of the parent's tiles: the run of the child's rows that fall
 * from one of its tiles into one of the parent's moves as a whole, spread by a mask of lanes, through
 * all columns. What stands above the diagonal moves along and is never read. */
SLV_FUNCTION static void SLV_NAME(assemble)(const sli_front *f, const double *from, sl_int skipped,
                                            const sl_int *places, sl_int columns, sl_int first,
                                            sl_int last) {
    const sl_int w = f->width, whole = w / SLI_TILE;
    sl_int row, end, i;
    for (row = first; row < last; row = end) {
        const sl_int lane = (skipped + row) % SLI_TILE, tile = places[row] / SLI_TILE;
        const double *source = from + sli_triangle_offset((skipped + row) / SLI_TILE) +
                               SLI_TILE * (ptrdiff_t)skipped + lane;
        double *const to[2] = {f->panel, f->update};
        const ptrdiff_t at[2] = {(ptrdiff_t)sli_tile_offset(w, tile),
                                 (ptrdiff_t)sli_triangle_offset(tile - whole) -
                                     SLI_TILE * SLI_TILE * (ptrdiff_t)whole};
        sl_int lanes[SLI_TILE];
        unsigned mask = 0;
        for (end = row; end < last && end - row < SLI_TILE - lane && places[end] / SLI_TILE == tile;
             end++) {
            lanes[end - row] = places[end] % SLI_TILE;
            mask |= 1u << lanes[end - row];
        }
        {
            SLV_SPREAD(mask, lanes, end - row)
            for (i = 0; i < end && i < columns; i++) {
                const int is_below =
                    places[i] >= w; /* the panel or the update matrix, not a branch */
                double *target = to[is_below] + (at[is_below] + SLI_TILE * (ptrdiff_t)places[i]);
                SLV_SPREAD_ADD(target, source + SLI_TILE * (ptrdiff_t)i)
            }
        }
    }
}
