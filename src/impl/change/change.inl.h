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
    SLV_FUNCTION static void SLV_NAME(name)(double *l, sl_int columns, const double *c, \
                                            double *w) { \
        sl_int j; \
        SLV_DECLARE(a) \
        SLV_DECLARE(s) \
        each(SLI_DECLARE, 0) \
            each(SLI_LOAD, 0) for (j = 0; j < columns; j++, l += SLI_TILE, c += 2 * (ranks)) { \
            SLV_LOAD_PINNED(a, l) \
            SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE); \
            each(SLI_CARRY, 0) each(SLI_CHANGE, ranks) SLV_STORE(l, a) \
        } \
        each(SLI_STORE, 0) \
    }
#define SLI_EACH2(op, k) op(0, k) op(1, k)

#if defined(SLV_ARRAYS) /* the same operations, in a loop over the vectors */
SLV_FUNCTION SLI_NOINLINE static void SLV_NAME(change)(double *l, sl_int columns, sl_int ranks,
                                                       const double *c, double *w) {
    sl_int j, r;
    for (j = 0; j < columns; j++, l += SLI_TILE, c += 2 * ranks) {
        for (r = 0; r < ranks; r++) {
            SLI_LOOP(SLI_TILE, w[SLI_TILE * r + i_] -= l[i_] * c[r])
        }
        for (r = 0; r < ranks; r++) {
            SLI_LOOP(SLI_TILE, l[i_] -= w[SLI_TILE * r + i_] * c[ranks + r])
        }
    }
}
#undef SLI_CHANGE_KERNEL
#define SLI_CHANGE_KERNEL(name, ranks, unused) \
    SLV_FUNCTION static void SLV_NAME(name)(double *l, sl_int columns, const double *c, \
                                            double *w) { \
        SLV_NAME(change)(l, columns, ranks, c, w); \
    }
#endif

SLI_CHANGE_KERNEL(change2, 2, SLI_EACH2)
SLI_CHANGE_KERNEL(change4, 4, SLI_EACH4)
SLI_CHANGE_KERNEL(change8, 8, SLI_EACH8)
#undef SLI_CARRY
#undef SLI_CHANGE

/* The rows of a tile before its pivots change: y := what a forward sweep makes of W', transposed;
 * f(r) := row r of U' Y'. l: the diagonal part of the tile; NULL: the unit matrix. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(change_rows)(const sli_ranks *u, const double *l,
                                                   sl_int columns, const double *w, double *f,
                                                   double *y) {
    const sl_int ranks = u->ranks;
    sl_int i, j, r;
    SLV_DECLARE(a)
    SLV_DECLARE(x)
    SLV_DECLARE(s)
    if (u->lanes < SLI_TILE) {
        memset(f, 0, SLI_TILE * SLI_TILE * sizeof *f);
    }
    memcpy(f, w, SLI_TILE * (size_t)u->lanes * sizeof *f);
    for (j = 0; j < columns && l != NULL; j++) { /* Y' := what a forward sweep makes of W' */
        SLV_LOAD_PINNED(a, l + SLI_TILE * j)
        for (r = 0; r < ranks; r++) {
            SLV_LOAD(x, f + SLI_TILE * r)
            SLV_BROADCAST(s, f + SLI_TILE * r + j)
            SLV_FNMA(x, a, s)
            SLV_STORE(f + SLI_TILE * r, x)
        }
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

/* See sli_ranks_kernel. Lanes are columns of the tile. f(r) is row r of U' Y'. Each vector changes
 * a pivot, and with it f and U, as in a rank-one change: f(r) -= q s, s += beta f(r). */
SLV_FUNCTION static sl_int SLV_NAME(change_ranks)(sli_ranks *u, const double *l, sl_int columns,
                                                  const double *d, const double *w, double *c) {
    SLI_ALIGNED(double f[SLI_TILE * SLI_TILE]);
    SLI_ALIGNED(double y[SLI_TILE * SLI_TILE]);
    SLI_ALIGNED(double b[SLI_TILE]);
    const sl_int ranks = u->ranks, lanes = u->lanes;
    sl_int j, r;
    SLV_DECLARE(a)
    SLV_DECLARE(x)
    SLV_DECLARE(s)
    SLV_DECLARE(t)
    SLV_DECLARE(p)
    SLV_NAME(change_rows)(u, l, columns, w, f, y);
    for (j = 0; j < columns; j++) {
        double e = d[j], inverse = 1.0 / e, magnitude = fabs(e), swept = 0.0, most = 0.0;
        SLV_ZERO(s)
        SLV_ZERO(t)
        for (r = 0; r < ranks; r++) {
            const double before = e, g = f[SLI_TILE * r + j];
            const double beta = -u->alpha[r] * g, q = g * inverse;
            double square = y[SLI_TILE * j + r] * y[SLI_TILE * j + r];
            if (u->is_mixed) {
                square *= u->unit[r];
                most = most > square ? most : square;
                square = most * u->square[r];
            }
            swept += fabs(u->alpha[r]) * square;
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
        u->swept[j] = swept;
        if (!(fabs(e) > 0.0)) {
            return j + 1;
        }
        inverse = -inverse;
        SLV_BROADCAST(p, &inverse)
        SLV_MULTIPLY(x, t, p)
        if (lanes == SLI_TILE) {
            SLV_LOAD(a, y + SLI_TILE * j)
            SLV_STORE(c, a)
            SLV_STORE(c + SLI_TILE, x)
        } else {
            SLV_STORE(b, x)
            SLI_COPY(c, y + SLI_TILE * j, lanes);
            SLI_COPY(c + lanes, b, lanes);
        }
        c += 2 * lanes;
    }
    return columns;
}

/* One vector and columns first .. last-1 of one row tile, or of SLI_CHAINS, whose chains of w
 * overlap: w -= l y, then l += b w. A trial leaves L alone. */
#define SLI_EACH1(op, k) op(0, k)
#define SLI_POINT(t, unused) double *const l##t = tiles[t];
#define SLI_CHANGE(t, unused) \
    SLV_LOAD_PINNED(a, l##t + SLI_TILE * j) \
    SLV_FNMA(w##t, a, s) \
    if (!is_trial) { \
        SLV_FNMA(a, w##t, r) \
        SLV_STORE(l##t + SLI_TILE * j, a) \
    }
#define SLI_TILES_KERNEL(name, each) \
    SLV_FUNCTION SLI_INLINE void SLV_NAME(name)(double *const *tiles, ptrdiff_t first, \
                                                ptrdiff_t last, const double *y, const double *b, \
                                                double *w, int is_trial) { \
        ptrdiff_t j; \
        SLV_DECLARE(a) \
        SLV_DECLARE(s) \
        SLV_DECLARE(r) \
        each(SLI_POINT, 0) each(SLI_DECLARE, 0) each(SLI_LOAD, 0) for (j = first; j < last; j++){ \
            SLV_BROADCAST(s, y + j) SLV_BROADCAST(r, b + j) \
                each(SLI_CHANGE, 0)} each(SLI_STORE, 0) \
    }
#if defined(SLV_ARRAYS)
#define SLI_CHAINS 1
#define SLI_ONE_TILE SLV_NAME(change_tiles)
SLI_TILES_KERNEL(change_tiles, SLI_EACH1)
#else
#define SLI_CHAINS 4
#define SLI_ONE_TILE SLV_NAME(change_tile)
SLI_TILES_KERNEL(change_tile, SLI_EACH1)
SLI_TILES_KERNEL(change_tiles, SLI_EACH4)
#endif
#undef SLI_EACH1
#undef SLI_POINT
#undef SLI_CHANGE
#undef SLI_TILES_KERNEL

#define SLI_BEFORE(k) (k)
#define SLI_AFTER(k) ((k) + 1)

/* The pivots of the column tile from column j on. y is what a forward sweep makes of w, whatever
 * the pivots become; with q = y / d and the sums g of y q, the new pivots are d g(after) /
 * g(before), and b = q / g(after). So there is no chain of divisions. l: diagonal part of the
 * tile. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(change_pivots)(sli_rank_one *u, double *l, sl_int j,
                                                     sl_int columns) {
    double *const b = u->b + j, *const w = u->w + j;
    SLI_ALIGNED(double z[SLI_TILE]);
    double g[SLI_TILE + 1];
    sl_int k;
    SLV_DECLARE(x)
    SLV_DECLARE(y)
    SLV_DECLARE(q)
    SLV_DECLARE(s)
    SLV_LOAD(x, w)
    if (columns == SLI_TILE) {
        SLV_SWEEP(tile_forward)(l, w);
    } else {
        SLV_LOAD(y, w)
        for (k = 0; k < columns; k++) {
            SLV_AXPY(y, l + SLI_TILE * k, w + k)
            SLV_STORE(w, y)
        }
    }
    SLV_LOAD_PART(y, w, columns, 0.0)
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
    SLV_STORE(b, q)
    SLV_GATHER(q, g, SLI_BEFORE)
    SLV_DIVIDE(y, y, q)
    SLV_MULTIPLY(s, s, y)
    SLV_STORE(u->e + j, s)
    u->sum = g[SLI_TILE]; /* not before y: clang 14 for WebAssembly would give y(0) this value */
    for (k = 0; k < columns && !u->is_trial; k++, l += SLI_TILE) {
        SLV_LOAD_PINNED(y, l)
        SLV_BROADCAST(s, w + k)
        SLV_FNMA(x, y, s)
        SLV_BROADCAST(s, b + k)
        SLV_FNMA(y, x, s)
        SLV_BELOW(y, k)
        SLV_STORE(l, y)
    }
}

#undef SLI_BEFORE
#undef SLI_AFTER

SLV_FUNCTION static void SLV_NAME(change_panel)(sli_rank_one *u) {
    const sl_int width = u->width, first = SLI_TILE * u->first_tile;
    const sl_int tiles = sli_tiles(width + u->below);
    double *l = u->panel + sli_tile_offset(width, u->first_tile), *at[SLI_CHAINS];
    double *const w = u->w, *const b = u->b;
    sl_int t0 = u->first_tile, count, t, k;
    for (; t0 < tiles; t0 += count) {
        const sl_int row = SLI_TILE * t0, last = sli_min(row, width);
        count = sli_min(tiles - t0, SLI_CHAINS);
        for (t = 0; t < count; t++) {
            at[t] = l;
            l += SLI_TILE * sli_min(width, row + SLI_TILE * (t + 1));
        }
        if (count == SLI_CHAINS) {
            SLV_NAME(change_tiles)(at, first, last, w, b, w + row, u->is_trial);
        } else {
            for (t = 0; t < count; t++) {
                SLI_ONE_TILE(at + t, first, last, w, b, w + row + SLI_TILE * t, u->is_trial);
            }
        }
        for (t = 0; t < count && row + SLI_TILE * t < width; t++) {
            const sl_int j = row + SLI_TILE * t, columns = sli_min(SLI_TILE, width - j);
            SLV_NAME(change_pivots)(u, at[t] + SLI_TILE * j, j, columns);
            for (k = t + 1; k < count; k++) {
                SLI_ONE_TILE(at + k, j, j + columns, w, b, w + row + SLI_TILE * k, u->is_trial);
            }
        }
    }
}
#undef SLI_CHANGE_KERNEL
#undef SLI_CHAINS
#undef SLI_ONE_TILE
#undef SLI_EACH2
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE

static const sli_change_kernels SLV_NAME(change_kernels) = {
    {SLV_NAME(change2), SLV_NAME(change4), SLV_NAME(change8)},
    SLV_NAME(change_ranks),
    SLV_NAME(change_panel)};
