/* multi_rhs.inl.h: sweeps for 2 or more right-hand sides, vectorized over right-hand sides */

/* A row of x has `stride` right-hand sides. With SLW_GROUPS this is any multiple of SLW_NRHS: each
 * row tile of L is applied to all groups of SLW_NRHS right-hand sides while it is in the first
 * cache. Otherwise there is one group. copy_rows.inl.h is included before. */

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

/* v: columns 0 .. columns-1 from l on, [column][8]; a copy in double if SLW_FNMA takes no floats */
#if defined(SLW_TAKES_FLOATS)
#define SLW_ENTRIES(v, columns) const SLV_VALUE *v;
#define SLW_SET_ENTRIES(v, l, columns, rows) v = (l);
#else
#define SLW_ENTRIES(v, columns) SLV_WIDE(v, columns)
#define SLW_SET_ENTRIES(v, l, columns, rows) SLV_WIDEN(v, l, columns, rows)
#endif

#define SLI_DECLARE(r, k) SLW_DECLARE(a##r)
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*distance)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*distance, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b) /* a(r) -= L(r, j) x(j) */

#include "multi_rhs_small.inl.h"
#include "multi_rhs_tiles.inl.h"

#if SLW_NRHS == 8 && !SLV_SINGLE
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

#undef SLW_ENTRIES
#undef SLW_SET_ENTRIES
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_APPLY
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW

#if SLV_SINGLE
#undef SLV_SINGLE
#define SLV_SINGLE 0
#undef SLW_NAME
#undef SLW_NRHS
#undef SLW_HALF
#undef SLW_GROUPS
#else
#undef SLV_SINGLE
#define SLV_SINGLE 1
#endif
