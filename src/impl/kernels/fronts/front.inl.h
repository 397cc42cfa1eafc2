/* front.inl.h: factors the panel of a front, computes its update matrix, assembles a front */

#if SLW_PASS == 1 /* once for each instruction set */

#include "product.inl.h"

/* A column tile has 8 columns or, of a complex matrix, 4. Column k then has the pivot in lane 2k,
 * and entries of L are conjugated where they are those of the pivots' rows. */
#if defined(SLV_ARRAYS)
#define SLI_EACH SLI_EACH_ARRAY
#define SLI_EACH_AGAIN SLI_EACH_ARRAY_AGAIN
#elif SLV_COMPLEX
#define SLI_EACH SLI_EACH4
#define SLI_EACH_AGAIN SLI_EACH4_AGAIN
#else
#define SLI_EACH SLI_EACH8
#define SLI_EACH_AGAIN SLI_EACH8_AGAIN
#endif

/* l(rows, k) = x(rows, k) / d(k); multiplies by 1/d where every |d| of the tile is in
 * 1e-290 .. 1e290, so that 1/d neither overflows nor underflows */
#define SLI_SCALE(l, x, k) \
    if (by_reciprocal) { \
        SLV_BROADCAST(b, reciprocal + (k)) \
        SLV_MULTIPLY(l, x, b) \
    } else { \
        SLV_BROADCAST(b, D + SLV_PARTS * (k)) \
        SLV_DIVIDE(l, x, b) \
    }

/* magnitude(rows) += |l d l|, with x = l d and minus_sign = -sign(d) */
#define SLI_GAIN(l, x, k) \
    SLV_BROADCAST(b, minus_sign + (k)) \
    SLV_MULTIPLY(b, l, b) \
    SLV_FNMA(m, b, x)

#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#if defined(SLV_ARRAYS)
#define SLI_DECLARE_ALL SLV_DECLARE(a[SLI_TILE])
#else
#define SLI_DECLARE_ALL SLI_EACH(SLI_DECLARE, 0)
#endif
#if SLV_COMPLEX
#define SLI_DECLARE_TURNED(k, unused) SLV_DECLARE(e##k)
#define SLI_CLEAR_TURNED(k, unused) SLV_ZERO(e##k) /* gcc does not see that it is set */
#else
#define SLI_DECLARE_TURNED(k, unused)
#define SLI_CLEAR_TURNED(k, unused)
#endif
#define SLI_LOAD(k, p) \
    if (SLI_IS_IN(k, columns)) { \
        SLV_LOAD_TILES(a##k, (p) + SLI_TILE * (k), q + SLI_TILE * (k)) \
    } else { \
        SLV_ZERO(a##k) \
    }

/* Column k of the diagonal tile: determines the pivot, then subtracts l(rows) x(column) from the
 * columns after it. Divides by d: the reciprocal would make the chain of dependent operations,
 * which limits the speed here, one operation longer. */
#if SLV_COMPLEX
#define SLI_TURN(e, l) SLV_TURN_BACK(e, l)
#define SLI_AFTER(i, k) \
    if ((i) > (k)) { \
        SLV_BROADCAST(b, x + SLI_TILE * (k) + 2 * (i)) \
        SLV_FNMA(a##i, l, b) \
        SLV_BROADCAST(b, x + SLI_TILE * (k) + 2 * (i) + 1) \
        SLV_FNMA(a##i, e0, b) \
    }
#define SLI_BY_RULE(k) \
    if (rule != NULL) { \
        d = sli_complex_by_rule(rule, column + 2 * (k), d, sums[2 * (k)] + sums[2 * (k) + 1]); \
        SLV_BROADCAST(b, &d) \
    }
/* The magnitudes of both rows of a pair: the sum of those of the real and of the imaginary part. */
#define SLI_TAKE_PIVOT(k, d) \
    D[2 * (k)] = D[2 * (k) + 1] = d; \
    magnitude[2 * (k)] = magnitude[2 * (k) + 1] = sums[2 * (k)] + sums[2 * (k) + 1];
#else
#define SLI_TURN(e, l)
#define SLI_AFTER(i, k) \
    if ((i) > (k)) { \
        SLV_BROADCAST(b, x + SLI_TILE * (k) + (i)) \
        SLV_FNMA(a##i, l, b) \
    }
#define SLI_BY_RULE(k) \
    if (rule != NULL) { \
        d = sli_pivot_by_rule(rule, column + (k), d, sums[k]); \
        SLV_BROADCAST(b, &d) \
    }
#define SLI_TAKE_PIVOT(k, d) \
    D[k] = d; \
    magnitude[k] = sums[k];
#endif
#define SLI_PIVOT(k, p) \
    if (SLI_IS_IN(k, columns)) { \
        double d; \
        SLV_STORE(x + SLI_TILE * (k), a##k) \
        SLV_STORE(sums, m) \
        SLV_LANE(b, a##k, (k)*SLV_PARTS) \
        d = x[(SLI_TILE + SLV_PARTS) * (k)]; \
        SLI_BY_RULE(k) \
        SLV_DIVIDE(l, a##k, b) \
        SLI_TAKE_PIVOT(k, d) \
        minus_sign[k] = (double)(d < 0 ? 1 : -1); \
        reciprocal[k] = (double)1 / d; \
        safe &= fabs(d) > 1e-290 && fabs(d) < 1e290; \
        SLI_GAIN(l, a##k, k) \
        SLV_BELOW(l, (k)*SLV_PARTS + SLV_PARTS - 1) \
        SLV_STORE((p) + SLI_TILE * (k), l) \
        SLI_TURN(e0, l) \
        SLI_EACH_AGAIN(SLI_AFTER, k) \
    }

/* Column k of a tile below: x(rows, k) -= x(rows, j) L(k, j) for j < k, then l = x / d. */
#if SLV_COMPLEX
#define SLI_BEFORE(j, k) \
    if ((j) < (k)) { \
        SLV_BROADCAST(b, pivots + SLI_TILE * (j) + 2 * (k)) \
        SLV_FNMA(a##k, a##j, b) \
        SLV_BROADCAST(b, pivots + SLI_TILE * (j) + 2 * (k) + 1) \
        SLV_FNMA(a##k, e##j, b) \
    }
#else
#define SLI_BEFORE(j, k) \
    if ((j) < (k)) { \
        SLV_BROADCAST(b, pivots + SLI_TILE * (j) + (k)) \
        SLV_FNMA(a##k, a##j, b) \
    }
#endif
#define SLI_SOLVE(k, unused) \
    if (SLI_IS_IN(k, columns)) { \
        SLI_EACH_AGAIN(SLI_BEFORE, k) \
        SLI_TURN(e##k, a##k) \
        SLI_SCALE(l, a##k, k) \
        SLI_GAIN(l, a##k, k) \
        SLV_STORE_TILES(p + SLI_TILE * (k), q + SLI_TILE * (k), l) \
    }

/* Columns of the front of one row tile that is computed as a whole: those after the pivots are of
 * the update matrix. */
#define SLI_LOAD_FRONT(k, unused) \
    if (SLI_IS_IN(k, all)) { \
        SLV_LOAD(a##k, (SLI_IS_IN(k, columns) ? p : update) + SLI_TILE * (k)) \
    } else { \
        SLV_ZERO(a##k) \
    }
#define SLI_STORE_UPDATE(k, unused) \
    if (!SLI_IS_IN(k, columns) && (k) < all) { \
        SLV_STORE(update + SLI_TILE * (k), a##k) \
    }

#if defined(SLV_OWN_SHORT)
/* The pivots of column tile c, 8 or fewer, and the update matrix of a small front. The columns
 * before it are already applied. */
SLV_FUNCTION static void SLV_FRONT(tile_pivots)(const sli_front *f, sl_int c, double *reciprocals) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first) / SLV_PARTS;
    const sl_int all = columns + (f->is_small ? f->below : 0);
    const sl_int column = f->column + first;
    const sli_pivot_rule *rule = f->rule->replaces ? f->rule : NULL;
    double *p = f->panel + sli_tile_offset(f->width, c) / SLV_PARTS +
                SLI_TILE / SLV_PARTS * (ptrdiff_t)first;
    double *update = f->update;
    double *D = f->D + first, *magnitude = f->magnitude + first;
    double *reciprocal = reciprocals, *minus_sign = reciprocals + SLI_TILE;
    SLI_ALIGNED(double x[SLI_TILE * SLI_TILE + SLI_TILE]);
    double *sums = x + SLI_TILE * SLI_TILE;
    int safe = 1;
    sl_int t;
    SLV_DECLARE(b)
    SLV_DECLARE(l)
    SLV_DECLARE(m)
    SLI_DECLARE_ALL
    SLI_DECLARE_TURNED(0, 0)
    SLV_LOAD(m, magnitude)
    SLI_EACH(SLI_LOAD_FRONT, 0)
    SLI_EACH(SLI_PIVOT, p)
    SLI_EACH(SLI_STORE_UPDATE, 0)
    SLV_STORE(sums, m)
    /* rows below that are in the last tile of pivots */
    for (t = SLV_PARTS * columns; t < SLI_TILE; t++) {
        magnitude[t] = sums[t];
    }
    if (!safe) {
        reciprocal[0] = 0;
    }
}
#endif

/* L in column tile c of row tiles t0 .. t1-1, all below its pivots. */
SLV_FUNCTION static void SLV_FRONT(tile_rows)(const sli_front *f, sl_int c, sl_int t0, sl_int t1,
                                              const double *reciprocals) {
    const sl_int w = f->width, first = SLI_TILE * c;
    const sl_int columns = sli_min(SLI_TILE, w - first) / SLV_PARTS;
    double *panel = f->panel + SLI_TILE / SLV_PARTS * (ptrdiff_t)first;
    const double *pivots = panel + sli_tile_offset(w, c) / SLV_PARTS;
    const int has_pairs = !SLV_COMPLEX && sli_tile_has_pairs(f, c);
    const double *D = has_pairs ? reciprocals + 2 * SLI_TILE : f->D + first;
    const double *reciprocal = reciprocals, *minus_sign = reciprocals + SLI_TILE;
    const int by_reciprocal = reciprocal[0] != 0;
    sl_int t;
    for (t = t0; t < t1; t += SLV_VECTOR_TILES) {
        const sl_int second = sli_min(t + SLV_VECTOR_TILES, t1) - 1;
        double *p = panel + sli_tile_offset(w, t) / SLV_PARTS;
        double *q = panel + sli_tile_offset(w, second) / SLV_PARTS;
        double *sums = f->magnitude + SLI_TILE * (ptrdiff_t)t;
        double *second_sums = f->magnitude + SLI_TILE * (ptrdiff_t)second;
        SLV_DECLARE(b)
        SLV_DECLARE(l)
        SLV_DECLARE(m)
        SLI_DECLARE_ALL
        SLI_EACH(SLI_DECLARE_TURNED, 0)
        SLI_EACH(SLI_CLEAR_TURNED, 0)
        SLV_LOAD_TILES(m, sums, second_sums)
        SLI_EACH(SLI_LOAD, p)
        SLI_EACH(SLI_SOLVE, 0)
        SLV_STORE_TILES(sums, second_sums, m)
        (void)q;
        (void)second_sums;
    }
    if (has_pairs) {
        sli_pair_rows(f, c, t0, t1);
    }
}

#undef SLI_SCALE
#undef SLI_GAIN
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_LOAD_FRONT
#undef SLI_STORE_UPDATE
#undef SLI_AFTER
#undef SLI_PIVOT
#undef SLI_BEFORE
#undef SLI_SOLVE
#undef SLI_TURN
#undef SLI_TAKE_PIVOT
#undef SLI_BY_RULE
#undef SLI_DECLARE_TURNED
#undef SLI_CLEAR_TURNED
#undef SLI_EACH
#undef SLI_EACH_AGAIN
#undef SLI_DECLARE_ALL

/* Applies column tiles first .. c0-1 to column tiles c0 .. c1-1 of row tiles t0 .. t1-1. */
SLV_FUNCTION SLI_INLINE void SLV_FRONT(catch_up)(const sli_front *f, sl_int first, sl_int c0,
                                                 sl_int c1, sl_int t0, sl_int t1, double *B) {
    if (c0 > first) {
        SLV_FRONT(product)
        (f->panel, f->width, f->D, f->E, t0, t1, c0, c1, SLI_TILE * first, SLI_TILE * c0, f->panel,
         f->width, 0, B);
    }
}

SLV_FUNCTION static void SLV_FRONT(pivots)(const sli_front *f, sl_int c0, void *scratch) {
    double *B = (double *)scratch;
    const sl_int c1 = sli_min(c0 + SLI_GROUP_TILES, sli_tiles(f->width));
    sl_int c;
    SLV_FRONT(catch_up)(f, 0, c0, c1, c0, c1, B);
    for (c = c0; c < c1; c++) {
        double *reciprocals = f->reciprocals + 3 * SLI_TILE * (ptrdiff_t)(c - c0);
        SLV_FRONT(catch_up)(f, c0, c, c + 1, c, c1, B);
        if (!SLV_COMPLEX && sli_tile_has_pairs(f, c)) {
            sli_pair_tile(f, c, f->reciprocals + 3 * SLI_TILE * (ptrdiff_t)(c - c0));
        } else {
            SLV_FRONT_SHORT(tile_pivots)(f, c, reciprocals);
        }
        if (c + 1 < c1) {
            SLV_FRONT(tile_rows)(f, c, c + 1, c1, reciprocals);
        }
    }
}

SLV_FUNCTION static void SLV_FRONT(rows)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                                         void *scratch) {
    double *B = (double *)scratch;
    const sl_int c1 = sli_min(c0 + SLI_GROUP_TILES, sli_tiles(f->width));
    sl_int c;
    SLV_FRONT(catch_up)(f, 0, c0, c1, t0, t1, B);
    for (c = c0; c < c1; c++) {
        SLV_FRONT(catch_up)(f, c0, c, c + 1, t0, t1, B);
        SLV_FRONT(tile_rows)
        (f, c, t0, t1, f->reciprocals + 3 * SLI_TILE * (ptrdiff_t)(c - c0));
    }
}

SLV_FUNCTION static void SLV_FRONT(update)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0,
                                           sl_int t1, void *scratch) {
    double *B = (double *)scratch;
    const sl_int w = f->width, last = sli_min(c1, t1);
    sl_int c;
    for (c = c0; c < last; c += SLI_GROUP_TILES) {
        SLV_FRONT(product)
        (f->panel, w, f->D, f->E, sli_max(t0, c), t1, c, sli_min(c + SLI_GROUP_TILES, last), 0, w,
         f->update, SLI_TILE * (t1 - c0), c0, B);
    }
}

/* Extend-add. Consecutive rows that are in one tile of the child and in one tile of the parent form
 * a run. A run is moved as a whole through all columns, its lanes expanded by a mask. Entries above
 * the diagonal are moved too and never read. */
SLV_FUNCTION static void SLV_FRONT(assemble)(const sli_front *f, const void *from, sl_int skipped,
                                             const sl_int *relative, sl_int columns, sl_int first,
                                             sl_int last) {
    const sl_int w = f->width, whole = w / SLI_TILE;
    sl_int row, end, i;
    for (row = first; row < last; row = end) {
        const sl_int lane = (skipped + row) % SLI_TILE, tile = relative[row] / SLI_TILE;
        const double *source =
            (const double *)from +
            (sli_triangle_offset((skipped + row) / SLI_TILE) + SLI_TILE * (ptrdiff_t)skipped) /
                SLV_PARTS +
            lane;
        double *const to[2] = {f->panel, f->update};
        const ptrdiff_t at[2] = {(ptrdiff_t)sli_tile_offset(w, tile) / SLV_PARTS,
                                 ((ptrdiff_t)sli_triangle_offset(tile - whole) -
                                  SLI_TILE * SLI_TILE * (ptrdiff_t)whole) /
                                     SLV_PARTS};
        sl_int lanes[SLI_TILE];
        unsigned mask = 0;
        for (end = row;
             end < last && end - row < SLI_TILE - lane && relative[end] / SLI_TILE == tile; end++) {
            lanes[end - row] = relative[end] % SLI_TILE;
            mask |= 1u << lanes[end - row];
        }
        {
            SLV_EXPAND(mask, lanes, end - row)
            for (i = 0; i < end && /* branches untested: it ends before `columns` */
                        i < columns;
                 i += SLV_PARTS) {
                const int is_below = relative[i] >= w; /* selects the target without a branch */
                double *target =
                    to[is_below] + (at[is_below] + SLI_TILE / SLV_PARTS * (ptrdiff_t)relative[i]);
                SLI_PREFETCH(target, SLI_ASSEMBLE_DISTANCE);
                SLI_PREFETCH(source + SLI_TILE / SLV_PARTS * (ptrdiff_t)i, SLI_ASSEMBLE_DISTANCE);
                SLV_EXPAND_ADD(target, source + SLI_TILE / SLV_PARTS * (ptrdiff_t)i)
            }
        }
    }
}

#endif
