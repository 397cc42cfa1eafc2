/* csc.h: sparse matrices: creation, checks, products, residuals */
#ifndef SL_PUBLIC_CSC_H
#define SL_PUBLIC_CSC_H

#include "options.h"
#include "stats.h"

/** Creates a matrix from triplets: equal positions are summed, rows are ascending.
 *
 *  out    [out]  the matrix.
 *  count  [in]   number of triplets.
 *  i, j   [in]   count row indices in 0..n_rows-1 and column indices in 0..n_cols-1, any order.
 *  x      [in]   count values; NULL: a pattern without values.
 *  opt    [in]   allocator.
 *  stats  [out]  error.row, error.column: an index out of range.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE: more than 2^31 - 1 triplets, or more than
 *           2^31 - 8 rows or columns; SL_ERR_MEMORY.
 *  Cost     O(count + n_rows + n_cols).
 *  Threads  any number with different outputs.
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_from_triplets(sl_matrix **out, sl_int n_rows,
                                                        sl_int n_cols, sl_off count,
                                                        const sl_int *i, const sl_int *j,
                                                        const double *x, const sl_options *opt,
                                                        sl_stats *stats);

/** The principal submatrix C = A[rows, rows] of a square matrix: C(k, l) = A(rows[k], rows[l]).
 *  With all rows it is a symmetric permutation P A P'.
 *
 *  If the entries of C are in one triangle of A, C has its lower triangle; if in both, so has C.
 *  Rows of a column are in any order; duplicates stay. Only the columns `rows` of A are read and
 *  checked.
 *
 *  rows   [in]   count rows of A in 0..n-1, any order, none twice.
 *  stats  [out]  error.row: a row out of range or given twice.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also not square; SL_ERR_MALFORMED; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     O((count + entries of these columns) log count), in memory O(count + entries of C).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_submatrix(sl_matrix **out, const sl_csc *A,
                                                    const sl_int *rows, sl_int count,
                                                    const sl_options *opt, sl_stats *stats);

/** The arrays of a matrix; valid as long as M. A NULL M gives a 0 x 0 view. */
SL_API sl_csc sl_matrix_view(const sl_matrix *M);

/** Releases a matrix. */
SL_API void sl_matrix_free(sl_matrix *M);

/** Checks a view: sizes, positions ascending from 0, indices in range.
 *
 *  stats  [out]  error.column and, for an index out of range, error.row.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: A or one of its arrays is NULL; SL_ERR_MALFORMED;
 *           SL_ERR_TOO_LARGE: more rows or columns than sl_csc allows.
 *  Cost     O(n_cols + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_check(const sl_csc *A, sl_stats *stats);

/** Determines the triangle of a square matrix that the factorization reads.
 *
 *  If A stores both triangles, checks that its pattern is symmetric.
 *
 *  out    [out]  the triangle; on error untouched.
 *  opt    [in]   allocator, triangle.
 *  stats  [out]  error.row, error.column: an entry without its mirror image.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square; SL_ERR_MALFORMED; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_triangle(const sl_csc *A, sl_triangle *out,
                                                const sl_options *opt, sl_stats *stats);

/** Y = A X.
 *
 *  reading  [in]   SL_AS_SYMMETRIC: A is square, and one triangle defines it, the lower one if both
 *                  are stored; SL_AS_STORED: any shape.
 *  Y        [out]  n_rows x nrhs, leading dimension ldy; must not overlap X (Y = X is refused).
 *  X        [in]   n_cols x nrhs, leading dimension ldx.
 *  Returns  SL_OK; SL_ERR_ARGUMENT. The pattern is not checked (sl_csc_check).
 *  Cost     O(nnz nrhs).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_multiply(const sl_csc *A, sl_reading reading, double *Y,
                                                size_t ldy, const double *X, size_t ldx,
                                                sl_int nrhs);

/** R = B - A X for a symmetric A, and the backward error of each column.
 *
 *  A               [in]   as SL_AS_SYMMETRIC in sl_csc_multiply.
 *  R               [out]  n x nrhs, leading dimension ldr. May be B itself (then ldr = ldb) if
 *                         backward_error is NULL; must not overlap X.
 *  X, B            [in]   n x nrhs, leading dimensions ldx and ldb.
 *  backward_error  [out]  nrhs numbers ||r|| / (||A|| ||x|| + ||b||) in the infinity norm; 0 if r =
 *                         0, NaN if r has a NaN or the denominator overflows; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT. The pattern is not checked.
 *  Cost     O(nnz nrhs).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_residual(const sl_csc *A, double *R, size_t ldr,
                                                double *backward_error, const double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs);

#endif
