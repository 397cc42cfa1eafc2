/* front.inl.h: one front of the multifrontal factorization: its panel is factored, its update matrix updated */

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

/* The diagonal tile, column k: the pivot, then the columns after it lose l(rows) x(column). */
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
        d = x[SLI_TILE * (k) + (k)];                                                               \
        D[k] = d;                                                                                  \
        magnitude[k] = sums[k];                                                                    \
        against[k] = d < 0.0 ? 1.0 : -1.0;                                                         \
        reciprocal[k] = 1.0 / d;                                                                   \
        by_reciprocal = fabs(d) > 1e-290 && fabs(d) < 1e290;                                       \
        safe &= by_reciprocal;                                                                     \
        SLI_SCALE(l, a##k, k)                                                                      \
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

/* Column tile c of a panel whose columns before it are done: 8 pivots, or fewer in the last one. */
SLV_FUNCTION static void SLV_NAME(eliminate)(double *panel, sl_int w, sl_int tiles, sl_int c,
                                             double *D, double *magnitude, double *scratch) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, w - first);
    double *p = panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)first;
    double *x = scratch, *sums = scratch + 64, *reciprocal = scratch + 72, *against = scratch + 80;
    int by_reciprocal = 1, safe = 1;
    sl_int t;
    SLV_DECLARE(b)
    SLV_DECLARE(l)
    SLV_DECLARE(m)
    SLI_EACH8(SLI_DECLARE, 0)
    D += first;
    magnitude += first;
    SLV_LOAD(m, magnitude)
    SLI_EACH8(SLI_LOAD, p)
    SLI_EACH8(SLI_PIVOT, p)
    SLV_STORE(sums, m)
    for (t = columns; t < SLI_TILE; t++) { /* rows below that share the last tile of pivots */
        magnitude[t] = sums[t];
    }
    by_reciprocal = safe;
    for (t = c + 1; t < tiles; t++) {
        double *q = panel + sli_tile_offset(w, t) + SLI_TILE * (ptrdiff_t)first;
        magnitude += SLI_TILE;
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

SLV_FUNCTION static void SLV_NAME(front)(double *panel, sl_int w, sl_int u, double *update,
                                         double *D, double *magnitude, double *scratch) {
    const sl_int tiles = sli_tiles(w + u), ends = sli_tiles(w), whole = w / SLI_TILE;
    double *B = scratch + SLI_FRONT_OWN;
    sl_int c0, c;
    for (c0 = 0; c0 < ends; c0 += SLI_GROUP) {
        const sl_int c1 = sli_min(c0 + SLI_GROUP, ends);
        SLV_NAME(product)(panel, w, D, tiles, c0, c1, 0, SLI_TILE * c0, panel, w, 0, B);
        for (c = c0; c < c1; c++) {
            SLV_NAME(product)(panel, w, D, tiles, c, c + 1, SLI_TILE * c0, SLI_TILE * c, panel, w,
                              0, B);
            SLV_NAME(eliminate)(panel, w, tiles, c, D, magnitude, scratch);
        }
    }
    if (u > 0) {
        for (c0 = whole; c0 < tiles; c0 += SLI_GROUP) {
            SLV_NAME(product)(panel, w, D, tiles, c0, sli_min(c0 + SLI_GROUP, tiles), 0, w, update,
                              SLI_TILE * (tiles - whole), whole, B);
        }
    }
}

/* What a child hands over, row by row of the parent's tiles: the run of the child's rows that fall
 * from one of its tiles into one of the parent's moves as a whole, spread by a mask of lanes, through
 * all columns. What stands above the diagonal moves along and is never read. */
SLV_FUNCTION static void SLV_NAME(assemble)(const double *from, sl_int from_w, sl_int u,
                                            const sl_int *place, double *panel, sl_int w,
                                            double *update) {
    const sl_int skipped = from_w % SLI_TILE, whole = w / SLI_TILE;
    const sl_int from_width = SLI_TILE * sli_tiles(skipped + u), update_width = INT32_MAX;
    sl_int row, end, split = 0, i;
    while (split < u && place[split] < w) {
        split++;
    }
    for (row = 0; row < u; row = end) {
        const sl_int lane = (skipped + row) % SLI_TILE, tile = place[row] / SLI_TILE;
        const double *source = from + sli_tile_offset(from_width, (skipped + row) / SLI_TILE) +
                               SLI_TILE * (ptrdiff_t)skipped + lane;
        sl_int lanes[SLI_TILE];
        unsigned mask = 0;
        for (end = row; end < u && end - row < SLI_TILE - lane && place[end] / SLI_TILE == tile;
             end++) {
            lanes[end - row] = place[end] % SLI_TILE;
            mask |= 1u << lanes[end - row];
        }
        {
            const sl_int in_panel = sli_min(end, split);
            double *to = panel + sli_tile_offset(w, tile);
            SLV_SPREAD(mask, lanes, end - row)
            for (i = 0; i < in_panel; i++) {
                SLV_SPREAD_ADD(to + SLI_TILE * (ptrdiff_t)place[i],
                               source + SLI_TILE * (ptrdiff_t)i)
            }
            if (end > split) {
                to = update + sli_tile_offset(update_width, tile - whole) -
                     SLI_TILE * SLI_TILE * (ptrdiff_t)whole;
                for (i = split; i < end; i++) {
                    SLV_SPREAD_ADD(to + SLI_TILE * (ptrdiff_t)place[i],
                                   source + SLI_TILE * (ptrdiff_t)i)
                }
            }
        }
    }
}
