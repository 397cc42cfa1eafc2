/* complex.h: complex Hermitian systems, solved as real ones of twice the size */
#ifndef SL_PUBLIC_COMPLEX_H
#define SL_PUBLIC_COMPLEX_H

#include "options.h"
#include "stats.h"

/* Connection Laplacians and the like: H x = b with a Hermitian H of n complex rows. Complex row k
 * becomes the real rows 2k (real part) and 2k + 1 (imaginary part), and an entry a + bi becomes the
 * block [a -b; b a]. The real matrix is symmetric, and definite if and only if H is.
 *
 * A complex vector in memory, real and imaginary parts in turn, IS the vector of the real system:
 * every call on factors and plans takes complex arrays as they are, with leading dimensions counted
 * in doubles, twice the complex ones. What differs is here: matrices, plans, the determinant. Other
 * calls take the real rows: for row k of H, the rows 2k and 2k + 1. The inverse has the blocks
 * [a -b; b a], too: its entries (2i, 2j) and (2i + 1, 2j) are the real and the imaginary part of
 * (H^-1)(i, j). Of statistics, n and the counts of pivots are twice those of H; condition and
 * backward errors are those of the real system.
 *
 *     sl_matrix_from_hermitian(&M, &H, NULL, NULL);
 *     A = sl_matrix_view(M);
 *     blocks.block_size = 2;                           orders a block as one row, which is quicker
 *     sl_symbolic_create(&S, &A, &blocks, NULL);
 *     half.storage = SL_STORAGE_COMPLEX;               half the bytes of L
 *     sl_factor_create(&F, S, &A, &half, NULL);
 *     sl_factor_solve(F, x, 2 * n, b, 2 * n, 1, W);    double x[2 n]
 *
 * For other values in the same pattern, make another real matrix and call sl_factor_refactor.
 *
 * L has four times the entries of that of a real matrix with the pattern of H. It has the blocks
 * [a -b; b a] as well, and SL_STORAGE_COMPLEX computes and keeps the first column of each: half the
 * operations and half the memory. Solves read half as much, and share each read of L as those of
 * real matrices do: up to 32 right-hand sides. Every call on factors takes both storages, except
 * that L as complex is not changed in place or saved.
 *
 * A null vector z of H is two of the real matrix, z and i z: options.null_vector_count 2. */

/** View of a complex Hermitian matrix in compressed columns: one triangle or both, entries and
 *  duplicates as in sl_csc. The imaginary parts of diagonal entries are 0. */
typedef struct sl_hermitian {
    sl_int n;
    const sl_int *p; /* n + 1 */
    const sl_int *i; /* p[n] */
    /* 2 p[n] with real and imaginary parts in turn; the real parts alone, p[n], if im is not NULL;
     * NULL: pattern only */
    const double *x;
    const double *im; /* p[n] imaginary parts, or NULL */
} sl_hermitian;

/** The real matrix of a Hermitian one. It stores the triangle or triangles that H stores, and zeros
 *  beside the diagonal: with options.block_size 2 the columns of a block then follow each other in
 *  one supernode.
 *
 *  out    [out]  2n x 2n.
 *  opt    [in]   allocator.
 *  stats  [out]  error.row, error.column, in complex rows.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also im without x, or a diagonal entry with an imaginary part
 *           that is not 0; SL_ERR_MALFORMED; SL_ERR_TOO_LARGE: more than 2^30 - 4 rows, or more
 *           than 2^31 - 1 entries, of which a complex one is 4; SL_ERR_MEMORY.
 *  Cost     O(n + nnz).
 *  Threads  any number with different outputs.
 *  Example  tests/core/test_complex.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_from_hermitian(sl_matrix **out, const sl_hermitian *H,
                                                         const sl_options *opt, sl_stats *stats);

/** sl_plan_create with sets of complex rows.
 *
 *  S      [in]   analysis of the real matrix, 2n columns; kept by the plan.
 *  bset, nb, xset, nx  [in]  as in sl_plan_create, in complex rows 0..n-1. B and X of
 *                sl_plan_solve then have 2 nb and 2 nx doubles for each right-hand side.
 *  opt    [in]   allocator, region.
 *  stats  [out]  as in sl_plan_create; error.row is a complex row.
 *  Returns  as sl_plan_create; SL_ERR_ARGUMENT also if S has an odd number of columns.
 *  Cost, Threads  as sl_plan_create.
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_plan_create(sl_plan **out, const sl_symbolic *S,
                                                       const sl_int *bset, sl_int nb,
                                                       const sl_int *xset, sl_int nx,
                                                       const sl_options *opt, sl_stats *stats);

/** log |det H| and the sign of det H, which is real: half the logarithm of the real determinant,
 *  and the parity of half the negative pivots.
 *
 *  Returns  as sl_factor_logdet.  Cost  O(n).
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_logdet(const sl_factor *F, double *log_abs_det,
                                                  double *sign);

#endif
