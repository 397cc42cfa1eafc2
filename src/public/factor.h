/* factor.h: the numbers: P A P' = L D L' */
#ifndef SL_PUBLIC_FACTOR_H
#define SL_PUBLIC_FACTOR_H

#include "types.h"

/** Factors P A P' = L D L' with unit lower triangular L and diagonal D of any sign, without pivoting.
 *
 *  Definite and quasi-definite matrices work in any order unless rounding loses a pivot: one that comes out below
 *  null_tolerance of what it was made of is refused. A symmetric indefinite matrix works if no pivot comes out null.
 *
 *  SL_SEMIDEFINITE skips null pivots instead: on a raw Laplacian one in each connected component, the last of it. With
 *  options.mass, weights m, every solve on the factor, full or local, then gives in each component with a null pivot the
 *  x with sum m x = 0 of A x = b - c m, where c = z' b / z' m makes the right-hand side consistent and z is the null
 *  vector: on a Laplacian, of constant z, the Poisson problem's zero-mean solution. A component whose weights are all
 *  0, as that of a vertex without faces may be, counts as weighted by 1; a row of zeros is a component by itself,
 *  whatever the pattern says, and its x is 0. Without mass solves give the solution that is 0 in the rows of
 *  sl_factor_null_rows, and refuse a right-hand side that is not consistent by SL_ERR_INCONSISTENT
 *  (options.consistency_tolerance; sl_factor_defects tells by how much). Where that is switched off, the residual of
 *  such a system is in those rows alone. Entries of the inverse are those of the inverse that makes x 0 there.
 *
 *  options.regularization is for KKT systems whose signs are known: L D L' is then P (A + E) P' with a diagonal E
 *  that is 0 but in the rows of sl_factor_regularized_rows. sl_factor_refine and sl_plan_solve_refined give the
 *  solution of A x = b out of it. Where many diagonal entries are 0, a small multiple of the signs added to the whole
 *  diagonal beforehand makes A quasi-definite, and refinement takes it away just so. Signs that are not those of
 *  the blocks, as where H is indefinite, are no substitute for pivoting: backward_error tells.
 *
 *  out    [out]  the factor, or NULL on error; release with sl_factor_free.
 *  S      [in]   analysis of A's pattern; borrowed, must outlive the factor.
 *  A      [in]   n x n with values; the pattern that S was made from, entry by entry in the same order.
 *  opt    [in]   isa, method, threads, definiteness, null_tolerance, mass, consistency_tolerance, regularization,
 *                signs, allocator; may be NULL.
 *  stats  [out]  the factor group; error_row, error_value; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no values, an option that is no number or out of range, a weight that is not finite
 *           or a sign that is none (error_row), z' m = 0 at null row error_row; SL_ERR_PATTERN: n or the number of entries differs from the analysed
 *           one; SL_ERR_PIVOT: null pivot at error_row, with mass a second one in its component; SL_ERR_NOT_FINITE: at error_row (and error_column where
 *           it stands in A); SL_ERR_UNSUPPORTED: the isa; SL_ERR_TOO_LARGE: L is beyond size_t; SL_ERR_MEMORY.
 *  Cost     O(sum over columns of entries^2); kept are nnz_panels doubles and, by the supernodal method, the update
 *           matrices that wait at once: some 5 % more on 2D meshes, some 30 % on 3D ones, twice that with threads. Mass
 *           adds a forward sweep, 24 bytes a row, and to a solve a few operations for each column that it visits.
 *  Threads  any number of calls at once on one S. options.threads shares one call out, here and in every
 *           sl_factor_refactor: subtrees first, then the rows of each large front. The bits of L do not depend on
 *           their number. The supernodal method alone uses them.
 *  Source   supernodal: multifrontal, [DR83] [Liu92], over tiles; up-looking: [LDL05], [Davis06] 4.7, row by row.
 *  Example  tests/test_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_options *opt,
                                                 sl_stats *stats);

/** Factors again with new values of the same pattern. Allocates nothing; the same bits as sl_factor_create gives.
 *
 *  F      [in,out]  on error F holds no factor and every solve refuses it, until a refactor succeeds.
 *  Returns, Cost    as sl_factor_create, SL_ERR_MEMORY, SL_ERR_TOO_LARGE and SL_ERR_UNSUPPORTED aside.
 *  Threads          nobody else may use F meanwhile.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats);

/** Factors again after local changes: only the columns of L that they reach, each from all its descendants.
 *
 *  For many changes in one place: the reach of a single vertex has the large separators at its end and costs some
 *  30 % of a whole factorization on a 2D mesh. Results agree with sl_factor_refactor to rounding; columns of L that
 *  no change reaches keep their bits. An up-looking factor is factored whole.
 *
 *  F        [in,out]  holds the factor of a matrix that differs from A in the given columns alone. On error F holds no
 *                     factor, unless the error is ARGUMENT, PATTERN, STATE or MEMORY: then it is as before.
 *  A        [in]      the pattern that was analysed, the new values.
 *  columns  [in]      count columns of A, as A stores its entries; any order, repetitions allowed.
 *  Returns  as sl_factor_create; SL_ERR_ARGUMENT: a column out of range (error_row); SL_ERR_STATE: F holds no factor.
 *  Cost     the update matrices of all descendants of the supernodes reached; while it runs 16 bytes an entry of the
 *           columns, 4 a row of A, of which it touches those reached, and 4 a row of the tallest supernode. With mass the
 *           forward sweep for the weights is a whole one.
 *  Threads  nobody else may use F meanwhile.
 *  Source   left-looking supernodes [NP93] over the reach of the changes.
 *  Example  tests/test_changed.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor_changed(sl_factor *F, const sl_csc *A,
                                                           const sl_int *columns, sl_int count,
                                                           sl_stats *stats);

/** Releases a factor; NULL is fine. */
SL_API void sl_factor_free(sl_factor *F);

/** Fills the factor group of stats again. */
SL_API void sl_factor_stats(const sl_factor *F, sl_stats *stats);

/** The rows whose null pivots were skipped, in the order of elimination.
 *
 *  rows   [out]  the first `most` of them; NULL where most = 0.
 *  count  [out]  how many there are, also above most.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_null_rows(const sl_factor *F, sl_int *rows, sl_int most,
                                                    sl_int *count);

/** The rows whose pivots regularization changed, in the order of elimination, and by how much: E of A + E = P' L D L' P.
 *
 *  rows    [out]  the first `most` of them; NULL where most = 0.
 *  shifts  [out]  the same number of diagonal entries of E; may be NULL.
 *  count   [out]  how many there are, also above most.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_regularized_rows(const sl_factor *F, sl_int *rows,
                                                           double *shifts, sl_int most,
                                                           sl_int *count);

/** log |det A| and the sign of det A (-1 or 1) from D; det of a 0 x 0 matrix is 1.
 *
 *  Where null pivots were skipped it is the determinant of A without their rows and columns: of a Laplacian, in each
 *  component the product of the eigenvalues that are not 0 over the number of rows.
 *
 *  Where regularization changed pivots it is that of A + E. A sum of logarithms: nothing overflows.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(n).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_logdet(const sl_factor *F, double *log_abs_det,
                                                 double *sign);

/** L as a matrix in compressed columns, with its unit diagonal, rows ascending.
 *
 *  Its entries are the places of the panels that are not exactly zero: those that relaxation or padding fills with
 *  zeros are left out, and so is an entry of L that came out as zero by cancellation.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE; SL_ERR_TOO_LARGE: 2^31 or more entries; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_lower(sl_matrix **out, const sl_factor *F,
                                                const sl_options *opt);

/** A look inside; the pointers live as long as F. */
typedef struct sl_factor_view_t {
    const sl_symbolic *symbolic;
    const double *L; /* panels, laid out as sl_symbolic_view_t tells */
    const double *D; /* n pivots, in pivot order; DBL_MAX where a null pivot was skipped */
} sl_factor_view_t;

SL_API sl_factor_view_t sl_factor_view(const sl_factor *F);

#endif
