/* change.inl.h: rank-k change of the rows of a panel, for 2, 4 and 8 vectors; of a panel for 1 */

/* Row tile by row tile: w(r) -= l y(r), then l += sum over r of b(r) w(r). All w(r) need the old l,
 * so that they do not wait for each other. c: y(0) .. y(k-1), -b(0) .. -b(k-1) of each column. */
#define SLI_DECLARE(r, unused) SLV_DECLARE(w##r)
#define SLI_LOAD(r, unused) SLV_LOAD(w##r, w + SLI_TILE * (r))
#define SLI_STORE(r, unused) SLV_STORE(w + SLI_TILE * (r), w##r)
#define SLI_CARRY(r, unused) /* w(i, r) -= l(i, j) y(j, r) */ \
    SLV_BROADCAST(s, c + (r)) \
    SLV_FNMA(w##r, a, s)
#define SLI_CHANGE(r, ranks) /* l(i, j) += w(i, r) b(j, r) */ \
    SLV_BROADCAST(s, c + (ranks) + (r)) \
    SLV_FNMA(a, w##r, s)
#define SLI_CHANGE_KERNEL(name, ranks, each) \
    SLV_FUNCTION static void SLV_NAME(name)(double *l, sl_int columns, const double *c, double *w, \
                                            int is_trial) { \
        sl_int j; \
        SLV_DECLARE(a) \
        SLV_DECLARE(s) \
        each(SLI_DECLARE, 0) \
            each(SLI_LOAD, 0) for (j = 0; j < columns; j++, l += SLI_TILE, c += 2 * (ranks)) { \
            SLV_LOAD_PINNED(a, l) \
            SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE); \
            each(SLI_CARRY, 0) if (!is_trial) { \
                each(SLI_CHANGE, ranks) SLV_STORE(l, a) \
            } \
        } \
        each(SLI_STORE, 0) \
    }
#define SLI_EACH2(op, k) op(0, k) op(1, k)

#if defined(SLV_ARRAYS) /* the same operations, in a loop over the vectors */
SLV_FUNCTION SLI_NOINLINE static void SLV_NAME(change)(double *l, sl_int columns, sl_int ranks,
                                                       const double *c, double *w, int is_trial) {
    sl_int j, r;
    for (j = 0; j < columns; j++, l += SLI_TILE, c += 2 * ranks) {
        for (r = 0; r < ranks; r++) {
            SLI_LOOP(SLI_TILE, w[SLI_TILE * r + i_] -= l[i_] * c[r])
        }
        for (r = 0; r < ranks && !is_trial; r++) {
            SLI_LOOP(SLI_TILE, l[i_] -= w[SLI_TILE * r + i_] * c[ranks + r])
        }
    }
}
#undef SLI_CHANGE_KERNEL
#define SLI_CHANGE_KERNEL(name, ranks, unused) \
    SLV_FUNCTION static void SLV_NAME(name)(double *l, sl_int columns, const double *c, double *w, \
                                            int is_trial) { \
        SLV_NAME(change)(l, columns, ranks, c, w, is_trial); \
    }
SLV_FUNCTION static void SLV_NAME(change_pair)(double *l, double *l1, sl_int columns,
                                               const double *c, double *w, int is_trial) {
    SLV_NAME(change)(l, columns, 2, c, w, is_trial);
    SLV_NAME(change)(l1, columns, 2, c, w + 2 * SLI_TILE, is_trial);
}
#else
/* 2 vectors and two row tiles: the chains of w of one tile are too few. */
SLV_FUNCTION static void SLV_NAME(change_pair)(double *l, double *l1, sl_int columns,
                                               const double *c, double *w, int is_trial) {
    sl_int j;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    SLV_DECLARE(s)
    SLI_EACH4(SLI_DECLARE, 0)
    SLI_EACH4(SLI_LOAD, 0)
    for (j = 0; j < columns; j++, l += SLI_TILE, l1 += SLI_TILE, c += 4) {
        SLV_LOAD_PINNED(a, l)
        SLV_LOAD_PINNED(b, l1)
        SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE);
        SLI_PREFETCH(l1, SLI_PREFETCH_DISTANCE);
        SLV_BROADCAST(s, c)
        SLV_FNMA(w0, a, s)
        SLV_FNMA(w2, b, s)
        SLV_BROADCAST(s, c + 1)
        SLV_FNMA(w1, a, s)
        SLV_FNMA(w3, b, s)
        if (!is_trial) {
            SLV_BROADCAST(s, c + 2)
            SLV_FNMA(a, w0, s)
            SLV_FNMA(b, w2, s)
            SLV_BROADCAST(s, c + 3)
            SLV_FNMA(a, w1, s)
            SLV_FNMA(b, w3, s)
            SLV_STORE(l, a)
            SLV_STORE(l1, b)
        }
    }
    SLI_EACH4(SLI_STORE, 0)
}
#endif

SLI_CHANGE_KERNEL(change2, 2, SLI_EACH2)
SLI_CHANGE_KERNEL(change4, 4, SLI_EACH4)
SLI_CHANGE_KERNEL(change8, 8, SLI_EACH8)
#undef SLI_CARRY
#undef SLI_CHANGE

/* sums(i) += |l(i, j)| |d(j)| |l(i, j)| for the rows of one tile, or of 4 so that their sums do not
 * wait for each other. */
#define SLI_ADD(r, unused) \
    SLV_LOAD(a, l + (r)*stride) \
    SLV_MULTIPLY(b, a, s) \
    SLV_MULTIPLY(b, a, b) \
    SLV_ADD(w##r, b)
#define SLI_MAGNITUDES(each) \
    each(SLI_DECLARE, 0) each(SLI_LOAD, 0) for (j = 0; j < columns; j++, l += SLI_TILE) { \
        const double size = fabs(d[j]); \
        SLV_BROADCAST(s, &size) \
        each(SLI_ADD, 0) \
    } \
    each(SLI_STORE, 0)
#define SLI_EACH1(op, k) op(0, k)
SLV_FUNCTION static void SLV_NAME(change_magnitudes)(const double *l, ptrdiff_t stride,
                                                     sl_int tiles, sl_int columns, const double *d,
                                                     double *w) {
    sl_int j;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    SLV_DECLARE(s)
    if (tiles == 4) {
        SLI_MAGNITUDES(SLI_EACH4)
    } else {
        SLI_MAGNITUDES(SLI_EACH1)
    }
}
#undef SLI_ADD
#undef SLI_MAGNITUDES
#undef SLI_EACH1

/* y := what a forward sweep makes of the rows of a diagonal tile, which has `columns` columns. */
#define SLI_FORWARD(k) \
    SLV_LANE(s, x, k) \
    SLV_DOT(x, l + SLI_TILE * (k), s)
#define SLI_FORWARD_IN(k, unused) \
    if (SLI_IS_IN(k, columns)) { \
        SLI_FORWARD(k) \
    }
SLV_FUNCTION SLI_NOINLINE static void SLV_NAME(change_forward)(const double *l, sl_int columns,
                                                               const double *w, double *y) {
    SLV_DECLARE(x)
    SLV_DECLARE(s)
#if defined(SLV_ARRAYS)
    sl_int k;
    SLV_LOAD(x, w)
    for (k = 0; k < columns; k++) {
        SLI_FORWARD(k)
    }
#else
    SLV_LOAD(x, w)
    SLI_EACH8(SLI_FORWARD_IN, 0)
#endif
    SLV_STORE(y, x)
}
#undef SLI_FORWARD
#undef SLI_FORWARD_IN

/* The rows of a tile before its pivots change: y := what a forward sweep makes of W', transposed;
 * f(r) := row r of U' Y'. l: the diagonal part of the tile. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(change_rows)(const sli_ranks *u, const double *l,
                                                   sl_int columns, const double *w, double *f,
                                                   double *y) {
    const sl_int ranks = u->ranks;
    sl_int i, r;
    SLV_DECLARE(a)
    SLV_DECLARE(x)
    SLV_DECLARE(s)
    for (r = 0; r < u->lanes; r++) {
        SLV_NAME(change_forward)(l, columns, w + SLI_TILE * r, f + SLI_TILE * r);
    }
    SLV_TRANSPOSE(y, f)
    for (r = ranks - 1; r > 0; r--) { /* f(r) = y(r) + sum over i < r of U(i, r) y(i) */
        SLV_LOAD(x, f + SLI_TILE * r)
        for (i = 0; i < r; i++) {
            const double entry = -u->U[r][i];
            SLV_BROADCAST(s, &entry)
            SLV_LOAD(a, f + SLI_TILE * i)
            SLV_FNMA(x, a, s)
        }
        SLV_STORE(f + SLI_TILE * r, x)
    }
}

/* What a pivot is swept by, at most. y: of its column, by the old L. */
SLV_FUNCTION SLI_INLINE double SLV_NAME(change_swept)(const sli_ranks *u, const double *y) {
    double swept = 0.0, most = 0.0;
    sl_int r;
    for (r = 0; r < u->ranks; r++) {
        double square = y[r] * y[r];
        if (u->is_mixed) {
            square *= u->unit[r];
            most = most > square ? most : square;
            square = most * u->square[r];
        }
        swept += fabs(u->alpha[r]) * square;
    }
    return swept;
}

/* See sli_ranks_kernel. Lanes are columns of the tile. f(r) is row r of U' Y'. Each vector changes
 * a pivot, and with it f and U, as in a rank-one change: f(r) -= q s, s += beta f(r). */
SLV_FUNCTION static sl_int SLV_NAME(change_ranks)(sli_ranks *u, const double *l, sl_int columns,
                                                  const double *d, const double *w, double *c) {
    SLI_ALIGNED(double f[SLI_TILE * SLI_TILE]);
    SLI_ALIGNED(double y[SLI_TILE * SLI_TILE]);
    const sl_int ranks = u->ranks, lanes = u->lanes;
    sl_int j, r;
    SLV_DECLARE(a)
    SLV_DECLARE(x)
    SLV_DECLARE(s)
    SLV_DECLARE(t)
    SLV_DECLARE(p)
    SLV_NAME(change_rows)(u, l, columns, w, f, y);
    for (j = 0; j < columns; j++) {
        double e = d[j], inverse = 1.0 / e, magnitude = fabs(e);
        u->swept[j] = SLV_NAME(change_swept)(u, y + SLI_TILE * j);
        SLV_ZERO(s)
        SLV_ZERO(t)
        for (r = 0; r < ranks; r++) {
            const double before = e, g = f[SLI_TILE * r + j];
            const double beta = -u->alpha[r] * g, q = g * inverse;
            if (g == 0.0) { /* not on the path of this vector */
                continue;
            }
            e -= beta * g;
            magnitude += fabs(beta * g);
            if (!(fabs(e) > 0.0)) { /* 0 or NaN */
                break;
            }
            inverse = 1.0 / e;
            u->alpha[r] *= before * inverse;
            SLV_BROADCAST(p, &q)
            SLV_LOAD_PINNED(a, f + SLI_TILE * r)
            SLV_LOAD(x, f + SLI_TILE * r)
            SLV_FNMA(x, s, p)
            SLV_STORE(f + SLI_TILE * r, x)
            SLV_BELOW(a, j)
            SLV_LOAD(x, u->U[r])
            SLV_FNMA(x, t, p)
            SLV_BROADCAST(p, &beta)
            SLV_FNMA(s, a, p)
            SLV_LOAD_PINNED(a, u->U[r])
            SLV_FNMA(t, a, p)
            SLV_STORE(u->U[r], x)
        }
        u->e[j] = e;
        u->magnitude[j] = magnitude;
        if (!(fabs(e) > 0.0)) {
            return j + 1;
        }
        inverse = -inverse;
        SLV_BROADCAST(p, &inverse)
        SLV_MULTIPLY(x, t, p)
        SLV_LOAD(a, y + SLI_TILE * j)
        SLV_STORE_ANY(c, a) /* what is too much the next column overwrites */
        SLV_STORE_ANY(c + lanes, x)
        c += 2 * lanes;
    }
    return columns;
}

/* One vector and columns first .. last-1 of 1 .. SLI_CHAINS row tiles, whose chains of w overlap:
 * w -= l y, then, in a change, l += b w. */
#define SLI_EACH1(op, k) op(0, k)
#define SLI_EACH3(op, k) op(0, k) op(1, k) op(2, k)
#if defined(SLV_ARRAYS)
#define SLI_CHAINS 1
#define SLI_BY_COUNT(loop) loop(SLI_EACH1)
#else
#define SLI_CHAINS 4
#define SLI_BY_COUNT(loop) \
    switch (count) { \
    case 1: \
        loop(SLI_EACH1) break; \
    case 2: \
        loop(SLI_EACH2) break; \
    case 3: \
        loop(SLI_EACH3) break; \
    default: \
        loop(SLI_EACH4) \
    }
#endif
#define SLI_POINT(t, unused) double *const l##t = tiles[t];
#define SLI_SWEEP(t, unused) SLV_DOT(w##t, l##t + SLI_TILE * j, s)
#define SLI_SWEEP_LOOP(each) \
    { \
        each(SLI_POINT, 0) each(SLI_DECLARE, 0) each(SLI_LOAD, 0) for (j = first; j < last; j++){ \
            SLV_BROADCAST(s, y + j) each(SLI_SWEEP, 0)} each(SLI_STORE, 0) \
    }
#define SLI_CHANGE(t, unused) \
    SLV_LOAD_PINNED(a, l##t + SLI_TILE * j) \
    SLI_PREFETCH(l##t + SLI_TILE * j, ahead); \
    SLV_FNMA(w##t, a, s) \
    SLV_FNMA(a, w##t, r) \
    SLV_STORE(l##t + SLI_TILE * j, a)
#define SLI_CHANGE_LOOP(each) \
    { \
        each(SLI_POINT, 0) each(SLI_DECLARE, 0) each(SLI_LOAD, 0) for (j = first; j < last; j++){ \
            SLV_BROADCAST(s, y + j) SLV_BROADCAST(r, b + j) \
                each(SLI_CHANGE, 0)} each(SLI_STORE, 0) \
    }
SLV_FUNCTION SLI_NOINLINE static void SLV_NAME(change_tiles)(sl_int count, double *const *tiles,
                                                             ptrdiff_t first, ptrdiff_t last,
                                                             const double *y, const double *b,
                                                             double *w, int has_change,
                                                             ptrdiff_t ahead) {
    ptrdiff_t j;
    SLV_DECLARE(a)
    SLV_DECLARE(s)
    SLV_DECLARE(r)
    (void)count;
    (void)ahead;
    if (has_change) {
        SLI_BY_COUNT(SLI_CHANGE_LOOP)
    } else {
        SLI_BY_COUNT(SLI_SWEEP_LOOP)
    }
}
#undef SLI_EACH1
#undef SLI_EACH3
#undef SLI_BY_COUNT
#undef SLI_POINT
#undef SLI_SWEEP
#undef SLI_SWEEP_LOOP
#undef SLI_CHANGE
#undef SLI_CHANGE_LOOP

#if defined(SLV_ARRAYS) /* the same as below */
static void SLV_NAME(change_pivots)(sli_rank_one *u, sl_int j, sl_int columns) {
    sl_int k;
    for (k = j; k < j + columns; k++) {
        const double q = u->y[k] / u->D[k], before = u->sum;
        const double z = u->y[k] * q;
        u->sum -= z;
        u->b[k] = q / u->sum;
        u->e[k] = u->D[k] * (u->sum / before);
    }
}
#else
#define SLI_BEFORE(k) (k)
#define SLI_AFTER(k) ((k) + 1)

/* The pivots of a column tile. With q = y / d and the sums g of y q, the new pivots are d g(after)
 * / g(before), and b = q / g(after). So there is no chain of divisions. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(change_pivots)(sli_rank_one *u, sl_int j, sl_int columns) {
    SLI_ALIGNED(double z[SLI_TILE]);
    double g[SLI_TILE + 1];
    sl_int k;
    SLV_DECLARE(y)
    SLV_DECLARE(q)
    SLV_DECLARE(s)
    SLV_LOAD_PART(y, u->y + j, columns, 0.0)
    SLV_LOAD_PART(s, u->D + j, columns, 1.0)
    SLV_DIVIDE(q, y, s)
    SLV_MULTIPLY(y, y, q)
    SLV_STORE(z, y)
    g[0] = u->sum;
    SLI_UNROLL
    for (k = 0; k < SLI_TILE; k++) {
        g[k + 1] = g[k] - z[k];
    }
    SLV_GATHER(y, g, SLI_AFTER) /* in registers: 8 stores are not forwarded to one load */
    SLV_DIVIDE(q, q, y)
    SLV_STORE(u->b + j, q)
    SLV_GATHER(q, g, SLI_BEFORE)
    SLV_DIVIDE(y, y, q)
    SLV_MULTIPLY(s, s, y)
    SLV_STORE(u->e + j, s)
    u->sum = g[SLI_TILE]; /* not before y: clang 14 for WebAssembly would give y(0) this value */
}

#undef SLI_BEFORE
#undef SLI_AFTER
#endif

/* y is what a forward sweep makes of w, whatever the pivots become. In a sweep, w is y. */
SLV_FUNCTION static void SLV_NAME(change_panel)(sli_rank_one *u, int has_sweep, int has_change) {
    const sl_int width = u->width, first = SLI_TILE * u->first_tile;
    const sl_int rows = SLI_TILE * sli_tiles(width + u->below);
    double *l = u->panel + sli_tile_offset(width, u->first_tile), *at[SLI_CHAINS] = {NULL};
    double *const y = u->y, *const b = u->b, *const w = has_change ? u->w : y;
    sl_int row, count, t, j, k;
    if (!has_change) {
        SLI_COPY(y + first, u->w + first, rows - first);
    }
    for (row = first; row < rows; row += SLI_TILE * count) {
        count = sli_min((rows - row) / SLI_TILE, SLI_CHAINS);
        for (t = 0; t < count; t++) {
            at[t] = l;
            l += SLI_TILE * sli_min(width, row + SLI_TILE * (t + 1));
        }
        SLV_NAME(change_tiles)
        (count, at, first, sli_min(row, width), y, b, w + row, has_change, u->ahead);
        for (t = 1; t <= count && row + SLI_TILE * (t - 1) < width; t++) {
            double *inner;
            SLV_DECLARE(x)
            SLV_DECLARE(a)
            SLV_DECLARE(s)
            j = row + SLI_TILE * (t - 1);
            k = sli_min(SLI_TILE, width - j);
            inner = at[t - 1] + SLI_TILE * j;
            if (has_sweep && k < SLI_TILE) {
                SLV_NAME(change_forward)(inner, k, w + j, y + j);
            } else if (has_sweep) { /* in scalars: that is a shorter chain */
                if (has_change) {
                    SLV_LOAD(x, w + j)
                    SLV_STORE(y + j, x)
                }
                SLV_SWEEP(tile_forward)(inner, y + j);
            }
            if (has_sweep) {
                SLV_NAME(change_pivots)(u, j, k);
            }
            if (has_change) {
                SLV_LOAD(x, w + j)
                for (k = j; k < sli_min(j + SLI_TILE, width); k++, inner += SLI_TILE) {
                    SLV_LOAD_PINNED(a, inner)
                    SLV_BROADCAST(s, y + k)
                    SLV_FNMA(x, a, s)
                    SLV_BROADCAST(s, b + k)
                    SLV_FNMA(a, x, s)
                    SLV_BELOW(a, (k - j))
                    SLV_STORE(inner, a)
                }
                SLV_STORE(w + j, x)
            }
            if (t < count) {
                SLV_NAME(change_tiles)
                (count - t, at + t, j, sli_min(j + SLI_TILE, width), y, b, w + j + SLI_TILE,
                 has_change, 0);
            }
        }
    }
}
#undef SLI_CHANGE_KERNEL
#undef SLI_CHAINS
#undef SLI_EACH2
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE

static const sli_change_kernels SLV_NAME(change_kernels) = {
    {SLV_NAME(change2), SLV_NAME(change4), SLV_NAME(change8)},
    SLV_NAME(change_pair),
    SLV_NAME(change_magnitudes),
    SLV_NAME(change_ranks),
    SLV_NAME(change_panel)};
