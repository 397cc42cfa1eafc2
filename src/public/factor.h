/* factor.h: the numerical factorization P A P' = L D L' */
#ifndef SL_PUBLIC_FACTOR_H
#define SL_PUBLIC_FACTOR_H

#include "options.h"
#include "stats.h"

/** Factors P A P' = L D L' in the order of S: L unit lower triangular, D diagonal and of any sign,
 *  or with the 2x2 blocks of sl_symbolic_create_pivoted.
 *
 *  Definite and quasi-definite matrices can be factored in any order. Other symmetric indefinite
 *  matrices can be factored if no pivot is null. A pivot d is null if
 *  |d| <= null_tolerance * (sum of the magnitudes it was computed from); it is refused, skipped or
 *  regularized, depending on the options. Rounding from heavier rows may hide a null pivot from
 *  this test. Where null pivots are refused and null_tolerance is not negative, the last pivot of a
 *  component is therefore also null if it is below 16 (64 + n/8) epsilon times the heaviest pivot
 *  and constants are a null vector of the component, as defined below.
 *
 *  Accuracy: without pivoting, a small pivot of an indefinite matrix makes L grow, and digits of A
 *  are lost without any pivot being null, as in [1e-20 1; 1 1]. stats.factor.growth measures this.
 *  - Definite matrices have a growth of at most 2, however badly they are scaled, and need no test.
 *    Where all entries of a component are below 2.3e-308, growth counts the digits that they lack.
 *  - The backward error of sl_factor_solve and of local solves, as sl_csc_residual computes it, is
 *    at most about epsilon * growth: use a solution as it is if this is small enough and
 *    stats.factor.regularized is 0. It is a bound on normwise errors; rows that are tiny against
 *    others of their component can be worse, which sl_factor_refine sees.
 *  - Otherwise call sl_factor_refine, and trust X if it returns SL_OK. It repairs most systems
 *    whose growth is below options.growth_limit.
 *  - A growth beyond options.growth_limit is refused with SL_ERR_INACCURATE.
 *
 *  Storage: with SL_STORAGE_FLOAT each front is factored in double, and its panel of L is rounded
 *  to float when it is done. D, null pivots, growth and log-determinant are those of double, and
 *  every solve computes in double. L D L' is P (A + E) P' with |E| <= 1.2e-7 |L| |D| |L'|:
 *  solutions and entries of the inverse have a backward error of about 6e-8 * growth. The pivots
 *  are not rounded, so a definite matrix stays definite.
 *  - Full solves: each step of sl_factor_refine multiplies the error of x, in the energy norm of a
 *    definite matrix, by about 1e-7 sqrt(condition): 2 to 5 steps up to a condition of 1e9, more up
 *    to about 1e11. Beyond that, as sl_factor_rcond shows, use double: refinement then returns
 *    SL_ERR_INACCURATE, and a solution without it has no digit. Measured on grids for M + t (L
 *    M^-1)^(k-1) L, smoothing over a tenth of the grid, backward error and largest error of x:
 *
 *    | k, rows          | condition | no step    | 1 step     | 2 steps    | L in double |
 *    |------------------|-----------|------------|------------|------------|-------------|
 *    | 1 harmonic, 1e4  | 3e3       | 5e-8, 4e-7 | 2e-14, 2e-14 | 2e-16, 6e-15 | 5e-16, 7e-15 |
 *    | 1 harmonic, 1e6  | 3e5       | 1e-7, 5e-6 | 6e-13, 4e-13 | 3e-16, 5e-14 | 2e-15, 1e-13 |
 *    | 2 biharmonic, 1e4  | 9e6     | 4e-8, 8e-4 | 3e-11, 3e-10 | 3e-16, 6e-12 | 7e-16, 8e-12 |
 *    | 2 biharmonic, 1e5  | 2e9     | 6e-8, 2e-2 | 1e-9, 5e-8 | 1e-15, 5e-10 | 2e-15, 4e-10 |
 *    | 3 triharmonic, 1e4 | 3e10    | 3e-8, 0.9  | 3e-8, 7e-6 | 2e-13, 3e-7 | 1e-15, 2e-8 |
 *    | 3 triharmonic, 1e5 | 6e13    | 4e-8, 300  | 4e-8, 300  | 4e-8, 300  | 2e-15, 6e-6 |
 *
 *  - Local solves cannot be refined, as the residual needs all of x.
 *  - The method is supernodal. sl_factor_update and _update_entries return SL_ERR_UNSUPPORTED: each
 *    change would round L again. sl_factor_change and sl_factor_refactor_changed refactor
 *    completely.
 *  - An entry of L beyond the range of float is refused with SL_ERR_INACCURATE, as growth is; so is
 *    one that underflows where that loses more than rounding does. Scaling A to a unit diagonal
 *    avoids both.
 *
 *  With SL_STORAGE_FLOAT_FRONTS fronts and pivots are computed in float, too: about half the time
 *  and the memory of double, and all of the above with the following differences.
 *  - Solutions have a backward error of about 1e-7 to 1e-6 * growth before refinement: the rounding
 *    errors of the eliminations add up. D is rounded as well, and growth and log-determinant are
 *    known to float's accuracy.
 *    Refinement multiplies the error by about 1e-7 condition at most: 2 steps for harmonic systems
 *    and heat with 1e6 rows. Measured as above, with the 5-point Laplacian for heat, M + t L:
 *
 *    | k, rows            | condition | no step    | 1 step       | 2 steps      | 3 steps      |
 *    |--------------------|-----------|------------|--------------|--------------|--------------|
 *    | heat, t 1, 1e6     | 9         | 1e-7, 2e-7 | 6e-14, 6e-14 | 3e-16, 4e-16 |              |
 *    | the same, L alone in float | 9 | 6e-8, 2e-8 | 2e-15, 6e-16 | 2e-16, 4e-16 |              |
 *    | heat, t 10, 1e6    | 80        | 2e-7, 2e-7 | 1e-13, 2e-13 | 3e-16, 9e-16 |              |
 *    | 1 harmonic, 1e4    | 3e3       | 1e-7, 2e-6 | 6e-13, 4e-12 | 2e-16, 6e-15 |              |
 *    | 1 harmonic, 1e5    | 3e4       | 1e-7, 8e-6 | 4e-12, 5e-11 | 3e-16, 1e-14 |              |
 *    | 1 harmonic, 1e6    | 3e5       | 2e-7, 2e-5 | 1e-11, 7e-10 | 6e-16, 8e-14 | 3e-16, 4e-14 |
 *    | 2 biharmonic, 1e4  | 9e6       | 1e-7, 3e-3 | 5e-10, 6e-6  | 1e-12, 2e-8  | 5e-15, 9e-11 |
 *    | 2 biharmonic, 1e5; 3 triharmonic, 1e4 | 2e9; 3e10 | refused: SL_ERR_PIVOT |     |    |  |
 *
 *  - Pivots are judged by the rounding of float, epsilon = 1.2e-7: null_tolerance is (64 + n/8)
 *    epsilon, at most 1/32, unless it is given, and SL_ERR_PIVOT says that a pivot is null in
 *    float. A may be regular in double. A pivot of a semidefinite matrix within rounding of 0,
 *    which double would keep and count as weak, is refused, too.
 *  - Entries of A above 8.5e37, and pivots computed from magnitudes below 7.9e-31, are refused with
 *    SL_ERR_INACCURATE.
 *  - 2x2 pivots (sl_symbolic_create_pivoted) are refused with SL_ERR_UNSUPPORTED.
 *
 *  Singular matrices: SL_NULL_PIVOT_SKIP factors positive or negative semidefinite matrices and
 *  skips null pivots; a Laplacian has one in each connected component, the last pivot of the
 *  component. Rounding cannot tell whether a pivot is null where weights differ by orders of
 *  magnitude, so the null vector decides. Let z be options.null_vector, or constant. Components are
 *  those of the graph of nonzero entries; duplicates that cancel are zeros.
 *  - Where |A z|_i <= 16 n_i epsilon (|A| |z|)_i in all rows i of a component, n_i the entries of
 *    row i, and z is not 0 in its last row, the last pivot is null, and no other one is. A pivot
 *    within rounding of 0, for example where a weak spring joins two grids, is kept and counted
 *    in stats.factor.weak. If such a component has a second null vector that is not given, its
 *    solutions are arbitrary in that direction; set z = 0 there.
 *  - Components with several null vectors, such as elastic bodies without supports, need all of
 *    them: options.null_vector is then a matrix of options.null_vector_count columns, such as the 3
 *    rigid motions in 2D or the 6 in 3D. Each component keeps the combinations Z of the columns
 *    with A Z = 0, by the bound above: a body that hangs on one hinge keeps the rotation
 *    about it. As many of its pivots are skipped, in rows that are far from each other, and no
 *    other one is null. The directions of translations and the center of rotations may be any; a
 *    center far from a body costs digits. In each tree of the elimination forest, the null vectors
 *    of all components with more than one row must not outnumber the columns.
 *  - In other components, and where z is 0, null_tolerance decides. It misses null pivots whose
 *    rounding errors come from rows much heavier than their own, and takes regular pivots for null
 *    that are smaller than it.
 *  - Components without a null pivot are counted in stats.factor.regular. Their solutions are
 *    unique; weights do not apply to them. If all components should be singular, check that it is
 *    0.
 *  - An indefinite matrix is refused: a diagonal entry or a pivot of the wrong sign beyond
 *    rounding, or a null pivot by the tolerance without a null vector.
 *  - With options.mass, weights m, and one null vector a component, every solve, full or local,
 *    computes in each component with a null pivot the x with sum m x = 0 that solves A x = b - c m.
 *    Here z is the null vector of the component, as above or computed from L, and c = z' b / z' m
 *    makes the right-hand side consistent. For a Laplacian z is constant, and x is the zero-mean
 *    solution of the Poisson problem. If all weights of a component are 0, as for a vertex without
 *    faces, all count as 1. A row of zeros is a component by itself, whatever the pattern; its x is
 *    0.
 *  - With options.mass, M = diag(m), and null_vector_count > 1, x has Z' M x = 0 for the null
 *    vectors Z that a component keeps, and solves A x = b - M Z c with c = (Z' M Z)^-1 Z' b. For
 *    rigid motions, x has neither a mean translation nor a mean rotation. Where Z' M Z is not
 *    definite beyond rounding, for example if only one vertex has weights, the factorization is
 *    refused; so are null pivots by the tolerance in components of more than one row.
 *  - Without options.mass, x is 0 in the rows of sl_factor_null_rows, and a solve refuses an
 *    inconsistent right-hand side with SL_ERR_INCONSISTENT (options.consistency_tolerance;
 *    sl_factor_defects computes how inconsistent it is). If that check is switched off, the
 *    residual of such a system is nonzero in these rows only.
 *  - Entries of the inverse are those of the generalized inverse that makes x 0 in the null rows.
 *
 *  KKT systems: with options.regularization and the known signs of the pivots, L D L' = P (A + E)
 *  P' where the diagonal matrix E is nonzero in the rows of sl_factor_regularized_rows only.
 *  sl_factor_refine and sl_plan_solve_refined then solve A x = b. If many diagonal entries are 0,
 *  add a small multiple of the signs to the whole diagonal beforehand: A becomes quasi-definite,
 *  and refinement removes the perturbation. If the signs are not those of the blocks, as when H is
 *  indefinite, regularization does not replace pivoting; stats.refine.backward_error shows this.
 *  sl_symbolic_create_pivoted needs neither signs nor shifts.
 *
 *  out    [out]  the factor, or NULL on error; release with sl_factor_free.
 *  S      [in]   analysis of A's pattern; borrowed, must outlive the factor.
 *  A      [in]   n x n with values; the analyzed pattern with its entries in the same order.
 *  opt    [in]   allocator, threads, isa, method, null_pivots, null_tolerance, mass,
 *                consistency_tolerance, regularization, signs, null_vector, null_vector_count,
 *                growth_limit, error_limit, storage; may be NULL.
 *  stats  [out]  factor; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no values, an option out of range or NaN, a weight or an entry
 *           of null_vector that is not finite or a sign other than -1, 0, 1 (error.row);
 *           SL_ERR_PATTERN: not the analyzed pattern; SL_ERR_PIVOT: a null pivot at error.row; with
 *           SL_NULL_PIVOT_SKIP, the row that shows that A is indefinite; with mass, a second null
 *           pivot in its component or in one that explicit zeros join to it, or one whose null
 *           vectors the weights do not fix (z' m = 0, Z' M Z not definite); SL_ERR_NOT_FINITE: at
 *           error.row, and error.column if it is an entry of A; with mass, also a mean that
 *           overflows; SL_ERR_INACCURATE: growth above its limit, caused by the pivot error.value
 *           of error.row, or an entry of L in the column of that pivot that float cannot hold, or
 *           with SL_STORAGE_FLOAT_FRONTS that pivot or the entry of A at error.row, error.column;
 *           SL_ERR_UNSUPPORTED: the isa, or SL_NULL_PIVOT_SKIP with a pivoted analysis,
 *           SL_STORAGE_FLOAT_FRONTS with 2x2 pivots, or more null vectors in the tree of error.row
 *           than columns;
 *           SL_STORAGE_COMPLEX of a matrix that sl_matrix_from_hermitian did not make, of an
 *           analysis without block_size 2, of sums, or with null pivots that are replaced;
 *           SL_ERR_TOO_LARGE: L exceeds size_t; SL_ERR_MEMORY.
 *  Cost     O(sum over columns of entries^2) flops. Keeps nnz_panels doubles, or half the bytes
 *           and the largest panel in double for each thread, and, with the supernodal method, the
 *           update stack: about 5 % more for 2D meshes and 30 % for 3D meshes, more with threads.
 *           SL_NULL_PIVOT_SKIP adds a product
 *           with A, 66 bytes per row, and a few operations per visited column in solves; mass adds
 *           a forward sweep, 24 bytes per row, and as many operations again. k > 1 null vectors
 *           take k + 1 products with A, O(n k^2) operations, 24 (k + 1)
 *           bytes per row, and 2 k operations per visited column in solves; with mass another k
 *           sweeps, k products with L, 16 (k + 1) bytes per row, and twice as many operations.
 *  Threads  any number of calls at once on one S. options.threads distributes one call, and every
 *           sl_factor_refactor of the factor, by one loop of the pool, whose bodies draw subtrees
 *           and pieces of large fronts until none is left. A thread that begins late, or never,
 *           leaves its share to the others. Small systems use fewer threads. L has the same bits
 *           for any number of threads. Only the supernodal method uses threads, where the compiler
 *           has atomic operations (gcc, clang, MSVC).
 *  Source   supernodal: multifrontal [DR83] [Liu92] on row tiles; up-looking: [LDL05], [Davis06]
 *           4.7; growth: [Hi02] 11.1.
 *  Example  tests/core/test_factor.c, test_growth.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_options *opt,
                                                 sl_stats *stats);

/** Factors a matrix of the same pattern with new values. Allocates nothing; same bits as
 *  sl_factor_create.
 *
 *  F      [in,out]  unchanged after SL_ERR_ARGUMENT and SL_ERR_PATTERN. After SL_ERR_PIVOT,
 *                   SL_ERR_NOT_FINITE, SL_ERR_INACCURATE and SL_ERR_UNSUPPORTED it has no
 *                   numbers, and every solve refuses it until a refactor succeeds.
 *  A      [in]      the analyzed pattern, new values.
 *  stats  [out]     factor; may be NULL.
 *  Returns, Cost    as sl_factor_create, but SL_ERR_UNSUPPORTED only for the values, with
 *                   SL_STORAGE_COMPLEX; SL_ERR_STATE: a mapped
 *                   factor (sl_map_file). SL_ERR_MEMORY and SL_ERR_TOO_LARGE only with the first
 *                   refactorization of a loaded factor (sl_load_file), which allocates its fronts.
 *  Threads          exclusive use of F.
 *  Example          tests/core/test_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats);

/** Refactors after local changes: recomputes only the columns of L that the changes reach.
 *
 *  Meant for many changes in one place. Each recomputed supernode gathers from all its descendants,
 *  and the reach of a single vertex ends in the large top separators: on a 2D mesh that already
 *  costs about 30 % of a factorization. Results agree with sl_factor_refactor up to rounding;
 *  the other columns of L keep their bits. An up-looking factor is recomputed completely.
 *
 *  F        [in,out]  the factor of a matrix that differs from A in the given columns only.
 *                     Unchanged after SL_ERR_ARGUMENT, _PATTERN, _STATE and _MEMORY; without
 *                     numbers after other errors.
 *  A        [in]      the analyzed pattern, new values.
 *  columns  [in]      count columns of A, in which A stores changed entries; any order, repetitions
 *                     allowed.
 *  stats    [out]     factor, of all of L and A: the growth is that of sl_factor_refactor, to
 *                     rounding; may be NULL.
 *  Returns  as sl_factor_create; SL_ERR_ARGUMENT: a column out of range (error.row); SL_ERR_STATE:
 *           F has no numbers, or is mapped.
 *  Cost     the update matrices of all descendants of the supernodes reached. Temporary memory: 16
 *           bytes per entry of the columns, 4 per row of A, of which only those reached are
 *           touched, and 4 per row of the largest front. With null pivots and
 *           mass, one complete sweep over L.
 *  Threads  exclusive use of F.
 *  Source   left-looking supernodal factorization [NP93] over the reach of the changes.
 *  Example  tests/core/test_refactor_changed.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor_changed(sl_factor *F, const sl_csc *A,
                                                           const sl_int *columns, sl_int count,
                                                           sl_stats *stats);

/** Releases a factor; NULL is allowed. */
SL_API void sl_factor_free(sl_factor *F);

/** Fills the factor group of stats. */
SL_API void sl_factor_stats(const sl_factor *F, sl_stats *stats);

/** The rows whose null pivots were skipped, in elimination order.
 *
 *  rows      [out]  the first min(capacity, *count) of them; may be NULL if capacity = 0.
 *  capacity  [in]   length of rows.
 *  count     [out]  how many there are; may exceed capacity.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_null_rows(const sl_factor *F, sl_int *rows,
                                                    sl_int capacity, sl_int *count);

/** The rows whose pivots regularization changed, in elimination order, and the diagonal matrix E.
 *
 *  rows      [out]  the first min(capacity, *count) of them; may be NULL if capacity = 0.
 *  shifts    [out]  the diagonal entries of E in these rows; may be NULL.
 *  capacity  [in]   length of rows and shifts.
 *  count     [out]  how many there are; may exceed capacity.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_regularized_rows(const sl_factor *F, sl_int *rows,
                                                           double *shifts, sl_int capacity,
                                                           sl_int *count);

/** log |det A| and the sign of det A (-1 or 1); the determinant of a 0 x 0 matrix is 1.
 *
 *  If null pivots were skipped: the determinant of A without their rows and columns. For a
 *  Laplacian this is, in each component, the product of its nonzero eigenvalues divided by its
 *  number of rows. If regularization changed pivots: the determinant of A + E. Computed as a sum of
 *  logarithms, which cannot overflow.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(n).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_logdet(const sl_factor *F, double *log_abs_det,
                                                 double *sign);

/** L as a matrix in compressed columns, with its unit diagonal, rows ascending.
 *
 *  Contains the entries that are not exactly 0: zeros from relaxation and padding are left out, and
 *  so is an entry that became 0 by cancellation.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  opt    [in]   allocator; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE: 2^31 or more
 *           entries; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_lower(sl_matrix **out, const sl_factor *F,
                                                const sl_options *opt);

/** Arrays of a factor; valid as long as the factor. */
typedef struct sl_factor_arrays {
    const sl_symbolic *symbolic;
    /* panels, in the layout described at sl_symbolic_arrays; NULL if L is in float */
    const double *L;
    const double *D; /* n pivots, in pivot order; DBL_MAX for a null pivot that was skipped */
    const double *E; /* n: D(k+1, k) at the first column k of a 2x2 pivot; NULL: there is none */
    const float *L_float; /* the same panels in float; else NULL */
} sl_factor_arrays;

SL_API sl_factor_arrays sl_factor_view(const sl_factor *F);

#endif
