/* multi_rhs.inl.h: sweeps for 2 or more right-hand sides, vectorized over right-hand sides */

/* A row of x has `stride` right-hand sides. With SLW_GROUPS this is any multiple of SLW_NRHS: each
 * row tile of L is applied to all groups of SLW_NRHS right-hand sides while it is in the first
 * cache. Otherwise there is one group. copy_rows.inl.h is included before. With SLW_COMPLEX, L is
 * that of a complex matrix, and SLW_GROUPS is defined. */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. over the SLW_ROWS rows that are kept in registers,
 * SLW_HIGH and SLW_LOW are its halves in descending order. a0, a1, .. are the accumulators of these
 * rows, b and c are one more row each, v holds entries of L. A macro does not expand inside itself;
 * SLW_EACH_AGAIN is a copy of SLW_EACH for that. */
#if SLW_ROWS == 8
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#else
#define SLW_EACH SLI_EACH4
#define SLW_EACH_AGAIN SLI_EACH4_AGAIN
#define SLW_HIGH SLI_HIGH4
#define SLW_LOW SLI_LOW4
#endif

#define SLI_DECLARE(r, k) SLW_DECLARE(a##r)
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*distance)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*distance, a##r)

#if defined(SLW_COMPLEX)
#include "complex_groups.inl.h"
#else

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
#define SLW_SET_ENTRIES(v, l, columns, rows) v = (l);
#else
#define SLW_ENTRIES(v, columns) SLV_WIDE(v, columns)
#define SLW_SET_ENTRIES(v, l, columns, rows) SLV_WIDEN(v, l, columns, rows)
#endif

#define SLI_PREPARE SLW_ENTRIES(v, SLI_TILE)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b) /* a(r) -= L(r, j) x(j) */
#define SLI_APPLY_COLUMN \
    SLW_DECLARE(b) \
    SLW_SET_ENTRIES(v, l, 1, SLW_ROWS) \
    SLW_LOAD(b, xj) \
    SLW_EACH(SLI_APPLY, v)
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
#define SLI_GATHER_COLUMN \
    SLW_DECLARE(b) \
    SLW_DECLARE(c) \
    SLW_SET_ENTRIES(v, l, 1, SLW_ROWS) \
    SLW_LOAD(b, xj) \
    SLW_ZERO(c) \
    SLW_HIGH(SLI_GATHER, v) \
    SLW_LOW(SLI_GATHER2, v) \
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
#endif

#include "multi_rhs_tiles.inl.h"

#if SLW_NRHS == 8 && !SLV_SINGLE && !defined(SLW_COMPLEX)
/* Computes SLW_ROWS rows of sums at a time; see sli_products_kernel. */
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    enum { distance = SLW_NRHS };
    sl_int row, k;
    for (row = 0; row < SLW_NRHS; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_NRHS;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_NRHS, p += SLW_NRHS) {
            SLW_LOAD(b, p)
            SLW_EACH(SLI_APPLY, l)
        }
        SLW_EACH(SLI_STORE, s)
    }
}
#endif

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_PARTS
#undef SLI_KERNEL
#undef SLI_TABLE
#undef SLI_SMALL
#undef SLI_PREPARE
#undef SLI_APPLY
#undef SLI_APPLY_COLUMN
#undef SLI_GATHER
#undef SLI_GATHER2
#undef SLI_GATHER_COLUMN
#undef SLI_DOWN
#undef SLI_UP
#undef SLI_COLUMN
#undef SLI_ROW
#undef SLI_TRIANGLE
#undef SLI_TRIANGLE_UP
#undef SLI_PAIRS
#undef SLI_PAIRS_AGAIN
#undef SLI_PAIRS_DOWN
#undef SLI_NEGATE
#undef SLI_SUBTRACT
#undef SLI_BELOW
#undef SLI_BEFORE
#undef SLW_ENTRIES
#undef SLW_SET_ENTRIES
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW

#if SLV_SINGLE || defined(SLW_COMPLEX)
#undef SLV_SINGLE
#define SLV_SINGLE 0
#undef SLW_COMPLEX
#undef SLW_NAME
#undef SLW_NRHS
#undef SLW_HALF
#undef SLW_GROUPS
#else
#undef SLV_SINGLE
#define SLV_SINGLE 1
#endif
