/* csc.h: matrices the library owns, checks, products, residuals, Matrix Market files */
#ifndef SL_PUBLIC_CSC_H
#define SL_PUBLIC_CSC_H

#include "types.h"

/** Builds a matrix from triplets; entries with the same row and column are summed, rows come out ascending.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  count  [in]   number of triplets.
 *  i, j   [in]   count row indices in 0..n_rows-1 and column indices in 0..n_cols-1, any order.
 *  x      [in]   count values; NULL: a pattern without values.
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  error_row, error_column of an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE: more than 2^31-1 triplets, or than 2^31-8 rows or
 *           columns; SL_ERR_MEMORY.
 *  Cost     O(count + n_rows + n_cols).
 *  Threads  any number on distinct outputs.
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_from_triplets(sl_matrix **out, sl_int n_rows,
                                                        sl_int n_cols, sl_off count,
                                                        const sl_int *i, const sl_int *j,
                                                        const double *x, const sl_options *opt,
                                                        sl_stats *stats);

/** Reads a Matrix Market file: coordinate; real, integer or pattern; general or symmetric.
 *
 *  A symmetric file gives the lower triangle (entries above the diagonal are mirrored into it), a general file the
 *  entries as they stand, duplicates summed; a pattern file gives a matrix with x = NULL.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  stats  [out]  error_line; may be NULL.
 *  Returns  SL_OK; SL_ERR_IO: no such file, or malformed at error_line; SL_ERR_UNSUPPORTED: complex, array,
 *           skew-symmetric or hermitian; SL_ERR_NOT_FINITE is not raised here; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(file size + n_rows + n_cols).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_read(sl_matrix **out, const char *path,
                                               const sl_options *opt, sl_stats *stats);

/** The same from memory: length bytes of text, no terminating zero needed. */
SL_API SL_WARN_UNUSED sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                                                const sl_options *opt, sl_stats *stats);

/** The transpose of a stored matrix (SL_AS_STORED); rows come out ascending, duplicates stay.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_PATTERN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n_rows + n_cols + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_transpose(sl_matrix **out, const sl_csc *A,
                                                    const sl_options *opt);

/** The symmetric permutation C = P A P' of a square matrix: C(k, l) = A(perm[k], perm[l]).
 *
 *  A matrix that stores one triangle gives the lower triangle of C; one that stores both gives both.
 *
 *  perm   [in]   n entries, a permutation of 0..n-1.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, not a permutation; SL_ERR_PATTERN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_permute(sl_matrix **out, const sl_csc *A,
                                                  const sl_int *perm, const sl_options *opt);

/** The arrays of an owned matrix; valid as long as M lives. A NULL M gives a 0 x 0 view. */
SL_API sl_csc sl_matrix_view(const sl_matrix *M);

/** Releases a matrix; NULL is fine. */
SL_API void sl_matrix_free(sl_matrix *M);

/** Checks a view: sizes, positions ascending from 0, indices in range.
 *
 *  stats  [out]  error_column and, for an index out of range, error_row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: A or one of its arrays is NULL; SL_ERR_PATTERN; SL_ERR_TOO_LARGE: more rows or
 *           columns than sl_csc allows.
 *  Cost     O(n_cols + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_check(const sl_csc *A, sl_stats *stats);

/** Finds which triangle a square matrix stores, and that a matrix storing both has a symmetric pattern.
 *
 *  out    [out]  the triangle; on error untouched.
 *  stats  [out]  error_row, error_column of an entry without its mirror image; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square; SL_ERR_PATTERN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.  Cost  O(n + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_triangle(const sl_csc *A, sl_triangle *out,
                                                const sl_options *opt, sl_stats *stats);

/** Y = A X.
 *
 *  reading  [in]   SL_AS_SYMMETRIC: A square, read as the factorization does; SL_AS_STORED: any shape.
 *  Y        [out]  n_rows x nrhs, column-major, leading dimension ldy elements; must not overlap X.
 *  X        [in]   n_cols x nrhs, column-major, leading dimension ldx elements.
 *  Returns  SL_OK; SL_ERR_ARGUMENT, an unknown reading too. The pattern is trusted (sl_csc_check).
 *  Cost     O(nnz nrhs).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_multiply(const sl_csc *A, sl_reading reading, double *Y,
                                                size_t ldy, const double *X, size_t ldx,
                                                sl_int nrhs);

/** R = B - A X for a symmetric A, and the backward error of each column.
 *
 *  R               [out]  n x nrhs, column-major, leading dimension ldr elements; it may be B itself (then
 *                         ldr = ldb) where backward_error is NULL; must not overlap X.
 *  X, B            [in]   n x nrhs, column-major, leading dimensions ldx and ldb elements.
 *  backward_error  [out]  nrhs numbers ||r|| / (||A|| ||x|| + ||b||) in the largest-entry and largest-row-sum norms,
 *                         0 where r = 0, NaN where r has one or the denominator overflows; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT. The pattern is trusted.  Cost  O(nnz nrhs).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_residual(const sl_csc *A, double *R, size_t ldr,
                                                double *backward_error, const double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs);

/** Writes a Matrix Market file that reads back to the same bits (%.17g).
 *
 *  reading  [in]  SL_AS_STORED: a general file of all entries; SL_AS_SYMMETRIC: a symmetric file of one triangle.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, an unknown reading; SL_ERR_PATTERN: malformed, or unsymmetric where
 *           symmetry is claimed; SL_ERR_IO; SL_ERR_MEMORY; SL_ERR_TOO_LARGE.
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_write(const sl_csc *A, sl_reading reading, const char *path);

#endif
