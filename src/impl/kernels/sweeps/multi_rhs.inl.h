/* multi_rhs.inl.h: what row tiles of L do to several right-hand sides of a real matrix */

/* For multi_rhs_tiles.inl.h, which is included next. A row of x has `stride` right-hand sides.
 * With SLW_GROUPS this is any multiple of SLW_NRHS: each row tile of L is applied to all groups
 * of SLW_NRHS right-hand sides while it is in the first cache. Otherwise there is one group.
 * copy_rows.inl.h is included before. */

/* a0, a1, .. are the accumulators of the rows in registers, b and c are one more row each, v holds
 * entries of L. */
#define SLI_DECLARE(r, k) SLW_DECLARE(a##r)
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*distance)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*distance, a##r)

#define SLI_PARTS 1
#if defined(SLW_GROUPS)
#define SLI_KERNEL(f) SLW_SWEEP(grouped_##f)
#else
#define SLI_KERNEL(f) SLW_SWEEP(f)
#endif
#define SLI_TABLE(f) SLV_SWEEP(f)

/* v: columns 0 .. columns-1 from l on, [column][8]; a copy in double if SLW_FNMA takes no floats */
#if defined(SLW_TAKES_FLOATS)
#define SLW_ENTRIES(v, columns) const SLV_VALUE *v;
#define SLW_ENTRY SLV_VALUE
#define SLW_SET_ENTRIES(v, l, columns, rows) v = (l);
#else
#define SLW_ENTRIES(v, columns) SLV_WIDE(v, columns)
#define SLW_ENTRY double
#define SLW_SET_ENTRIES(v, l, columns, rows) SLV_WIDEN(v, l, columns, rows)
#endif

/* So many columns are copied before the first is used: processors are slow to read what they have
 * just stored. Copied one by one, 3 right-hand sides take 1.15 to 1.4 of the time. */
#if SLV_SINGLE && !defined(SLW_TAKES_FLOATS)
#define SLI_COPIED 32
#define SLI_BLOCK(columns) sli_min(columns, SLI_COPIED)
#else
#define SLI_COPIED SLI_TILE
#define SLI_BLOCK(columns) (columns)
#endif
#define SLI_PREPARE SLW_ENTRIES(v, SLI_COPIED)
#define SLI_READ_BLOCK(lj, l, columns) \
    SLW_SET_ENTRIES(v, l, columns, SLW_ROWS) \
    lj = v;
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b) /* a(r) -= L(r, j) x(j) */
#define SLI_APPLY_COLUMN \
    SLW_DECLARE(b) \
    SLW_LOAD(b, xj) \
    SLW_EACH(SLI_APPLY, lj)
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
#define SLI_GATHER_COLUMN \
    SLW_DECLARE(b) \
    SLW_DECLARE(c) \
    SLW_LOAD(b, xj) \
    SLW_ZERO(c) \
    SLW_HIGH(SLI_GATHER, lj) \
    SLW_LOW(SLI_GATHER2, lj) \
    SLW_ADD(b, c) \
    SLW_STORE(xj, b)
/* Inside the diagonal block: column k updates the rows below it, row k the columns before it. */
#define SLI_DOWN(r, k) \
    if ((r) > (k)) { \
        SLW_FNMA(a##r, v[SLI_TILE * (k) + (r)], a##k) \
    }
#define SLI_COLUMN(k, unused) \
    if (SLI_IS_IN(k, inner)) { \
        SLW_EACH_AGAIN(SLI_DOWN, k) \
    }
#define SLI_TRIANGLE \
    SLW_SET_ENTRIES(v, l, inner, SLW_ROWS) \
    SLW_EACH(SLI_COLUMN, 0)
#define SLI_UP(j, k) \
    if ((j) < (k) && SLI_IS_IN(j, inner)) { \
        SLW_FNMA(a##j, v[SLI_TILE * (j) + (k)], a##k) \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)
#define SLI_TRIANGLE_UP \
    SLW_SET_ENTRIES(v, l, inner, SLW_ROWS) \
    SLW_HIGH(SLI_ROW, 0) \
    SLW_LOW(SLI_ROW, 0)

#if SLW_ROWS == 8 || defined(SLW_HALF)
#include "multi_rhs_small.inl.h"
#define SLI_SMALL
#endif
