/* several.h: several matrices of one pattern: weighted sums of value arrays over one analysis, factored and asked by one call */
#ifndef SL_PUBLIC_SEVERAL_H
#define SL_PUBLIC_SEVERAL_H

#include "types.h"

/* M + t K for many t is one pattern, the union of both. Each term is spread once into an array in the order of the
 * analysis, and a factorization adds weighted arrays up while it reads them: nothing is permuted, sorted or searched for
 * a second time. For m values of t:
 *
 *     sl_csc terms[2] = {M, K};                                  any triangles, any two patterns
 *     sl_matrix_sum(&U, NULL, terms, 2, NULL, NULL);             their union
 *     A = sl_matrix_view(U);  sl_symbolic_create(&S, &A, NULL, NULL);
 *     v[0] = malloc(sl_symbolic_entries(S) * sizeof(double));    v[1] alike
 *     sl_symbolic_spread(S, v[0], &M, NULL);  sl_symbolic_spread(S, v[1], &K, NULL);
 *     for k < m: c[2 k] = 1, c[2 k + 1] = t[k];
 *     sl_batch_factor(F, m, S, c, v, 2, &opt, NULL, NULL);       F: m factors, of M + t[k] K
 *     sl_batch_diagonal(F, m, h, n_rows, rows, n_rows, &opt.threads, NULL, NULL, NULL);
 *
 * A plan belongs to the analysis: it serves all of them, one by one or in a batch whose requests name their factors.
 *
 * Heat-kernel signatures: with M the masses and K = L, the positive semi-definite cotangent Laplacian, one implicit step
 * of length t is (M + t L) u(t) = M u(0). Unit heat put into vertex i is u(0) = e_i / M(i,i), so that the heat kernel is
 * h_t(i,j) = (A_t^-1)(i,j), as near as one step comes, and h_t(i,i) the signature of i at time t: a density, which the
 * masses integrate to 1 over j. A unit temperature is u(0) = e_i, and what is left of it at i, the auto-diffusion of
 * [HDA17] 5, is (A_t^-1)(i,i) M(i,i). To compare times, divide each column by the trace, the sum over all i of
 * (A_t^-1)(i,i) M(i,i).
 */

/** C = c_1 A_1 + .. + c_k A_k of symmetric matrices, stored as its lower triangle, rows ascending.
 *
 *  out           [out]  the matrix, n x n, or NULL on error; release with sl_matrix_free.
 *  coefficients  [in]   count numbers; NULL: the union of the patterns, without values.
 *  terms         [in]   count >= 1 square matrices of one size, each storing any triangle, read as a factorization
 *                       reads it. An entry of the pattern stays, whatever it sums up to.
 *  opt           [in]   allocator; may be NULL.
 *  stats         [out]  error_row, error_column of what is malformed; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: sizes that differ, no term, values missing; SL_ERR_PATTERN; SL_ERR_TOO_LARGE:
 *           2^31 or more entries in all; SL_ERR_MEMORY.
 *  Cost     O(n + entries of all terms).
 *  Threads  any number on distinct outputs.
 *  Example  tests/test_spread.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_sum(sl_matrix **out, const double *coefficients,
                                              const sl_csc *terms, sl_int count,
                                              const sl_options *opt, sl_stats *stats);

/** Length of an array of values in the order of the analysis: nnz_a of its statistics. A NULL S has 0. */
SL_API sl_int sl_symbolic_entries(const sl_symbolic *S);

/** Spreads a matrix over an array in the order of the analysis, zeros where it has no entry.
 *
 *  values  [out]  sl_symbolic_entries(S) doubles; on error untouched. Their order is the map's: a supernode's stand side
 *                 by side. Valid for S alone.
 *  K       [in]   n x n with values, any triangle, read as a factorization reads it: rows in any order, duplicates
 *                 summed. Its pattern is a part of the analysed one; values are not looked at.
 *  stats   [out]  error_row, error_column: an entry that the analysed pattern has not, the first as K stores them, or one
 *                 that is malformed; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, no values; SL_ERR_PATTERN: another size, malformed, both triangles and
 *           unsymmetric, or an entry off the pattern; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + entries of S and of K); memory of the analysis's allocator while it runs.
 *  Threads  reads S; any number on distinct arrays.
 *  Example  tests/test_spread.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_spread(const sl_symbolic *S, double *values,
                                                   const sl_csc *K, sl_stats *stats);

/** Factors A = coefficients[0] values[0] + .. + coefficients[terms-1] values[terms-1].
 *
 *  The same bits as sl_factor_create over an analysed matrix without duplicates whose entries are these sums, each product
 *  rounded, then added up in this order to a first 0.
 *
 *  out           [out]  the factor, or NULL on error; release with sl_factor_free. As any other.
 *  S             [in]   the analysis; borrowed, must outlive the factor.
 *  coefficients  [in]   terms finite numbers.
 *  values        [in]   terms arrays in the order of S (sl_symbolic_spread); not kept.
 *  terms         [in]   0 or more; a sum of none is the zero matrix.
 *  opt, stats           as in sl_factor_create.
 *  Returns  as sl_factor_create, SL_ERR_PATTERN aside. SL_ERR_NOT_FINITE: a coefficient (error_value, no row), or a sum:
 *           an infinity that meets another or a 0 is a NaN. Such an entry is told as one of the lower triangle:
 *           error_row >= error_column.
 *  Cost     as sl_factor_create; the terms are read once, in order.
 *  Threads  as sl_factor_create.
 *  Example  tests/test_combination.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create_combination(sl_factor **out, const sl_symbolic *S,
                                                             const double *coefficients,
                                                             const double *const *values,
                                                             sl_int terms, const sl_options *opt,
                                                             sl_stats *stats);

/** Factors again with other coefficients or values over the factor's analysis. Allocates nothing.
 *
 *  F        [in,out]  any factor, also one of sl_factor_create. On error it holds no factor, as in sl_factor_refactor.
 *  Returns, Cost      as sl_factor_create_combination, SL_ERR_MEMORY, SL_ERR_TOO_LARGE and SL_ERR_UNSUPPORTED aside.
 *  Threads            nobody else may use F meanwhile.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor_combination(sl_factor *F,
                                                               const double *coefficients,
                                                               const double *const *values,
                                                               sl_int terms, sl_stats *stats);

/** Factors several combinations of the same terms, spread over threads: the bits of sl_factor_create_combination.
 *
 *  Each thread takes whole factors; those that are left over when every thread has had as many are made by all threads
 *  together, one after the other.
 *
 *  out           [out]  count factors. Where one fails, its out is NULL and the others are made all the same: release
 *                       those. On SL_ERR_ARGUMENT of the whole call (failed = -1) all are NULL.
 *  coefficients  [in]   terms x count, column-major, leading dimension terms: a column a factor.
 *  values, terms [in]   as in sl_factor_create_combination.
 *  opt           [in]   as in sl_factor_create; may be NULL.
 *  failed        [out]  the first that failed, or -1; may be NULL.
 *  stats         [out]  the factor group and the error of that one, or the group of the last; seconds and bytes of all
 *                       together (the seconds that a factor tells of itself count what other threads did meanwhile). May
 *                       be NULL.
 *  Returns  SL_OK; what the first that failed came to, as sl_factor_create_combination.
 *  Cost     that of the factors, shared out; each keeps what a factor keeps.
 *  Threads  as sl_factor_create; memory is asked for by the calling thread alone.
 *  Example  tests/test_batch_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_factor(sl_factor **out, sl_int count, const sl_symbolic *S,
                                                const double *coefficients,
                                                const double *const *values, sl_int terms,
                                                const sl_options *opt, sl_int *failed,
                                                sl_stats *stats);

/** Factors several factors of one analysis again. Allocates nothing.
 *
 *  factors   [in,out]  count factors, none twice. One that fails holds no factor; the others are made all the same.
 *  threads   [in]      how many and whose; NULL: the calling thread alone. Factors that have threads of their own are made
 *                      by these, one after the other.
 *  coefficients, values, terms, failed, stats  as in sl_batch_factor.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a factor that is NULL or given twice; SL_ERR_STATE: factors of several
 *           analyses; then no factor has been touched. Else what the first that failed came to.
 *  Threads  nobody else may use the factors meanwhile.
 *  Example  tests/test_batch_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_refactor(sl_factor *const *factors, sl_int count,
                                                  const double *coefficients,
                                                  const double *const *values, sl_int terms,
                                                  const sl_threads *threads, sl_int *failed,
                                                  sl_stats *stats);

/** Diagonal entries of several inverses: out(i, k) = (A_k^-1)(rows[i], rows[i]), the bits of sl_inverse_diagonal.
 *
 *  factors  [in]      count factors of one analysis; one may be given twice.
 *  out      [out]     n_rows x count, column-major, leading dimension ldo >= n_rows elements. On error untouched.
 *  rows     [in]      n_rows rows of A, any order, repeated or not; NULL (with n_rows ignored): all n.
 *  threads  [in]      how many and whose; NULL: the calling thread alone. Each takes whole factors.
 *  works    [in,out]  a workspace for each thread, as in sl_batch_solve, or NULL: allocated for this call.
 *  failed   [out]     the factor at fault, or -1; may be NULL.
 *  stats    [out]     error_row: an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range; SL_ERR_STATE: a failed factor, or several analyses;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     that of sl_inverse_diagonal for each, shared out.
 *  Threads  as sl_inverse_diagonal.
 *  Source   [HDA17] 5.
 *  Example  tests/test_batch_inverse.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_diagonal(const sl_factor *const *factors, sl_int count,
                                                  double *out, size_t ldo, const sl_int *rows,
                                                  sl_int n_rows, const sl_threads *threads,
                                                  sl_work *const *works, sl_int *failed,
                                                  sl_stats *stats);

#endif
