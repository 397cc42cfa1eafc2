/* complex_groups.inl.h: what row tiles of L do to 2 or more right-hand sides of a complex matrix */

/* For multi_rhs_tiles.inl.h, which is included next, with the storage of complex_rows.inl.h.
 * SLW_GROUPS is defined, and copy_rows.inl.h is included before. Each entry of L is applied to
 * the real and to the imaginary parts of a group: two multiplications for each number that is
 * read. */
#define SLI_DECLARE(r, k) SLW_DECLARE(a##r)
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*distance)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*distance, a##r)
#define SLI_PARTS 2
#define SLI_KERNEL(f) SLW_NAME(complex_group_##f)
#define SLI_TABLE(f) SLV_NAME(complex_##f)

#if SLW_ROWS == 8
#define SLI_PAIRS(op, l) op(0, 1, l) op(2, 3, l) op(4, 5, l) op(6, 7, l)
#define SLI_PAIRS_AGAIN(op, k, m) op(0, 1, k, m) op(2, 3, k, m) op(4, 5, k, m) op(6, 7, k, m)
#define SLI_PAIRS_DOWN(op, l) op(6, 7, l) op(4, 5, l) op(2, 3, l) op(0, 1, l)
#else
#define SLI_PAIRS(op, l) op(0, 1, l) op(2, 3, l)
#define SLI_PAIRS_AGAIN(op, k, m) op(0, 1, k, m) op(2, 3, k, m)
#define SLI_PAIRS_DOWN(op, l) op(2, 3, l) op(0, 1, l)
#endif

#define SLW_ENTRY double
#define SLI_BLOCK(columns) (columns)
#define SLI_READ_BLOCK(lj, l, columns) lj = (l);
#define SLI_PREPARE const double one = 1.0;
#define SLI_NEGATE(n, c) \
    SLW_ZERO(n) \
    SLW_FNMA(n, one, c)
/* a(r) + i a(s) -= (l(r) + i l(s)) (b + i c), n = -c */
#define SLI_SUBTRACT(r, s, l, b, c, n) \
    SLW_FNMA(a##r, (l)[r], b) \
    SLW_FNMA(a##s, (l)[r], c) \
    SLW_FNMA(a##r, (l)[s], n) \
    SLW_FNMA(a##s, (l)[s], b)
#define SLI_APPLY(r, s, l) SLI_SUBTRACT(r, s, l, b, c, n)
#define SLI_APPLY_COLUMN \
    SLW_DECLARE(b) \
    SLW_DECLARE(c) \
    SLW_DECLARE(n) \
    SLW_LOAD(b, xj) \
    SLW_LOAD(c, xj + stride) \
    SLI_NEGATE(n, c) \
    SLI_PAIRS(SLI_APPLY, lj)
/* b + e + i (c - n) -= (l(r) - i l(s)) (a(r) + i a(s)) */
#define SLI_GATHER(r, s, l) \
    SLW_FNMA(b, (l)[r], a##r) \
    SLW_FNMA(c, (l)[r], a##s) \
    SLW_FNMA(e, (l)[s], a##s) \
    SLW_FNMA(n, (l)[s], a##r)
#define SLI_GATHER_COLUMN \
    SLW_DECLARE(b) \
    SLW_DECLARE(c) \
    SLW_DECLARE(e) \
    SLW_DECLARE(n) \
    SLW_LOAD(b, xj) \
    SLW_LOAD(c, xj + stride) \
    SLW_ZERO(e) \
    SLW_ZERO(n) \
    SLI_PAIRS(SLI_GATHER, lj) \
    SLW_ADD(b, e) \
    SLW_FNMA(c, one, n) \
    SLW_STORE(xj, b) \
    SLW_STORE(xj + stride, c)
/* Inside the diagonal block: the pair of columns k, m updates the rows below it, the pair of rows
 * k, m the columns before it. */
#define SLI_BELOW(r, s, k, m) \
    if ((r) > (k)) { \
        SLI_SUBTRACT(r, s, l + SLI_TILE / 2 * (k), a##k, a##m, n) \
    }
#define SLI_COLUMN(k, m, unused) \
    if (SLI_IS_IN(k, inner)) { \
        SLI_NEGATE(n, a##m) \
        SLI_PAIRS_AGAIN(SLI_BELOW, k, m) \
    }
#define SLI_TRIANGLE \
    SLW_DECLARE(n) \
    SLI_PAIRS(SLI_COLUMN, 0)
#define SLI_BEFORE(i, j, k, m) \
    if ((i) < (k) && SLI_IS_IN(i, inner)) { \
        const double *at = l + SLI_TILE / 2 * (i); \
        SLW_FNMA(a##i, at[k], a##k) \
        SLW_FNMA(a##i, at[m], a##m) \
        SLW_FNMA(a##j, at[k], a##m) \
        SLW_FNMA(a##j, at[m], n) \
    }
#define SLI_ROW(k, m, unused) \
    SLI_NEGATE(n, a##k) \
    SLI_PAIRS_AGAIN(SLI_BEFORE, k, m)
#define SLI_TRIANGLE_UP \
    SLW_DECLARE(n) \
    SLI_PAIRS_DOWN(SLI_ROW, 0)
