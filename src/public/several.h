/* several.h: several matrices of one pattern: weighted sums of value arrays over one analysis */
#ifndef SL_PUBLIC_SEVERAL_H
#define SL_PUBLIC_SEVERAL_H

#include "options.h"
#include "stats.h"

/* The matrices M + t K for many t have one pattern, the union of both. Each term is scattered once
 * into an array in the order of the analysis, and a factorization adds the weighted arrays while it
 * reads them: nothing is permuted, sorted or searched again. For `count` values of t:
 *
 *     sl_csc terms[2] = {M, K};                                  any triangles, any two patterns
 *     sl_matrix_sum(&U, NULL, terms, 2, NULL, NULL);             their union
 *     A = sl_matrix_view(U);  sl_symbolic_create(&S, &A, NULL, &stats);
 *     m = malloc(stats.symbolic.nnz_a * sizeof(double));         k likewise
 *     sl_symbolic_scatter(S, m, &M, NULL);  sl_symbolic_scatter(S, k, &K, NULL);
 *     const double *v[2] = {m, k};
 *     for i < count: c[2 i] = 1, c[2 i + 1] = t[i];
 *     sl_factor_create_sums(F, count, S, c, v, 2, &opt, NULL, NULL);   F[i]: the factor of M + t[i]
 *     for i < count: sl_inverse_diagonal(F[i], h + i * n_rows, rows, n_rows, W, NULL);
 *
 * A plan belongs to the analysis. It serves all of these factors, one by one or in a batch whose
 * requests name their factors.
 *
 * Manual   tools/docs/do/variances.md
 */

/** C = c_1 A_1 + .. + c_k A_k of symmetric matrices, as its lower triangle with ascending rows.
 *
 *  out           [out]  the matrix, n x n.
 *  coefficients  [in]   count numbers; NULL: the union of the patterns, without values.
 *  terms         [in]   count >= 1 square matrices of one size, each with any triangle, read as a
 *                       factorization reads them. Entries whose sum is 0 stay in the pattern.
 *  opt           [in]   allocator, triangle.
 *  stats         [out]  error.row, error.column: a malformed entry.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MALFORMED;
 *           SL_ERR_TOO_LARGE: 2^31 or more entries in total; SL_ERR_MEMORY.
 *  Cost     O(n + entries of all terms).
 *  Threads  any number with different outputs.
 *  Example  tests/core/test_matrix_sum.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_sum(sl_matrix **out, const double *coefficients,
                                              const sl_csc *terms, sl_int count,
                                              const sl_options *opt, sl_stats *stats);

/** Scatters the values of a matrix into an array in the order of the analysis.
 *
 *  values  [out]  stats.symbolic.nnz_a doubles of S (sl_symbolic_view), valid for S only, 0 where
 *                 K has no entry; those of a supernode are contiguous. On error untouched.
 *  K       [in]   n x n with values, read as a factorization reads it: any triangle, rows in any
 *                 order, duplicates summed. Its pattern is a subset of the analyzed one.
 *  stats   [out]  error.row, error.column: the first stored entry outside the analyzed pattern, or
 *                 a malformed one.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, no values; SL_ERR_MALFORMED: malformed, or both
 *           triangles with an unsymmetric pattern; SL_ERR_OTHER_PATTERN: another size, or an entry
 *           outside the analyzed pattern; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + entries of S and of K); temporary memory from the allocator of S.
 *  Threads  reads S; any number with different arrays.
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_scatter(const sl_symbolic *S, double *values,
                                                    const sl_csc *K, sl_stats *stats);

/** Factors weighted sums of the same terms, one or many, distributed over threads:
 *  A_k = coefficients(0, k) values[0] + .. + coefficients(terms-1, k) values[terms-1].
 *
 *  The same bits as sl_factor_create for a matrix without duplicates whose entries are these sums;
 *  each product is rounded, then added in this order, starting from 0. A compiler that contracts
 *  a * b + c (gcc without -std=c99, for processors with FMA) does not round the products.
 *
 *  Each thread computes whole factors. If their number is not a multiple of the number of threads,
 *  all threads together compute the remaining ones, one after the other; so also a single one.
 *
 *  out           [out]  count factors; release with sl_factor_free. If one fails, it is NULL and
 *                       the others are computed nevertheless: release them. After SL_ERR_ARGUMENT
 *                       with failed = -1 all are NULL.
 *  S             [in]   the analysis; kept by the factors.
 *  coefficients  [in]   terms x count finite numbers, column-major, leading dimension terms: one
 *                       column per factor.
 *  values        [in]   terms arrays in the order of S (sl_symbolic_scatter); not kept.
 *  terms         [in]   0 or more; the sum of no terms is the zero matrix.
 *  opt           [in]   as in sl_factor_create.
 *  failed        [out]  the first factor that failed, or -1; may be NULL.
 *  stats         [out]  error and factor: those of the failed factor, else of the last one; seconds
 *                       and bytes are sums over all factors.
 *  Returns  SL_OK, or the status of the first factor that failed: as sl_factor_create, but never
 *           SL_ERR_MALFORMED or SL_ERR_OTHER_PATTERN. SL_ERR_NOT_FINITE: a coefficient
 *           (error.value, no row) or a sum, at error.row >= error.column.
 *  Cost     that of the factors, distributed; the terms are read once for each, in order.
 *  Threads  as sl_factor_create; only the calling thread allocates.
 *  Example  tests/core/test_combination.c, test_batch_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create_sums(sl_factor **out, sl_int count,
                                                      const sl_symbolic *S,
                                                      const double *coefficients,
                                                      const double *const *values, sl_int terms,
                                                      const sl_options *opt, sl_int *failed,
                                                      sl_stats *stats);

/** Refactors one or several factors of one analysis with other coefficients or values. Allocates
 *  nothing, but to judge small pivots as sl_factor_refactor does, on the calling thread.
 *
 *  factors   [in,out]  count different factors, also of sl_factor_create. One that fails has no
 *                      numbers afterwards; the others are computed nevertheless.
 *  opt       [in]      threads; NULL: the calling thread only. Factors that have threads of their
 *                      own use these, one after the other.
 *  coefficients, values, terms, failed, stats  as in sl_factor_create_sums.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also if a factor is NULL or given twice; SL_ERR_MISMATCH:
 *           factors of several analyses; SL_ERR_READ_ONLY: a mapped one; SL_ERR_MEMORY and
 *           SL_ERR_TOO_LARGE: only with the first refactorization of a loaded factor. After these
 *           no factor has changed. Else the status of the first factor that failed.
 *  Threads  exclusive use of the factors.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor_sums(sl_factor *const *factors, sl_int count,
                                                        const double *coefficients,
                                                        const double *const *values, sl_int terms,
                                                        const sl_options *opt, sl_int *failed,
                                                        sl_stats *stats);

#endif
