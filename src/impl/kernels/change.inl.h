/* change.inl.h: rank-k change of the rows of a panel, for 1, 2, 4 and 8 vectors */

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
        each(SLI_DECLARE, 0) each(SLI_LOAD, 0) \
        for (j = 0; j < columns; j++, l += SLI_TILE, c += 2 * (ranks)) { \
            SLV_LOAD_PINNED(a, l) \
            each(SLI_CARRY, 0) each(SLI_CHANGE, ranks) \
            SLV_STORE(l, a) \
        } \
        each(SLI_STORE, 0) \
    }
#define SLI_EACH1(op, k) op(0, k)
#define SLI_EACH2(op, k) op(0, k) op(1, k)

SLI_CHANGE_KERNEL(change1, 1, SLI_EACH1)
SLI_CHANGE_KERNEL(change2, 2, SLI_EACH2)
SLI_CHANGE_KERNEL(change4, 4, SLI_EACH4)
SLI_CHANGE_KERNEL(change8, 8, SLI_EACH8)
#undef SLI_CARRY
#undef SLI_CHANGE

/* One vector and four row tiles, whose chains of w overlap. */
#define SLI_CHANGE(t, unused) \
    SLV_LOAD_PINNED(a, l##t + at) \
    SLV_FNMA(w##t, a, y) \
    SLV_FNMA(a, w##t, b) \
    SLV_STORE(l##t + at, a)
SLV_FUNCTION static void SLV_NAME(change_tiles)(double *const *tiles, sl_int columns,
                                                const double *c, double *w) {
    double *const l0 = tiles[0], *const l1 = tiles[1], *const l2 = tiles[2], *const l3 = tiles[3];
    ptrdiff_t at;
    SLV_DECLARE(a)
    SLV_DECLARE(y)
    SLV_DECLARE(b)
    SLI_EACH4(SLI_DECLARE, 0)
    SLI_EACH4(SLI_LOAD, 0)
    for (at = 0; at < SLI_TILE * (ptrdiff_t)columns; at += SLI_TILE, c += 2) {
        SLV_BROADCAST(y, c)
        SLV_BROADCAST(b, c + 1)
        SLI_EACH4(SLI_CHANGE, 0)
    }
    SLI_EACH4(SLI_STORE, 0)
}
#undef SLI_CHANGE
#undef SLI_CHANGE_KERNEL
#undef SLI_EACH1
#undef SLI_EACH2
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
