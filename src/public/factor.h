/* factor.h: the numerical factorization P A P' = L D L' */
#ifndef SL_PUBLIC_FACTOR_H
#define SL_PUBLIC_FACTOR_H

#include "options.h"
#include "stats.h"

/** Factors P A P' = L D L' in the order of S: L unit lower triangular, D diagonal and of any sign,
 *  or with the 2x2 blocks of sl_symbolic_create_pivoted.
 *
 *  Definite and quasi-definite matrices can be factored in any order, other indefinite ones if no
 *  pivot is null, semidefinite ones with SL_PIVOTS_SKIP_NULL. Solves have a backward error of at
 *  most about epsilon * stats.factor.growth. If that is not small enough, or if pivots were
 *  regularized, call sl_factor_refine, and trust X if it returns SL_OK.
 *
 *  out    [out]  the factor.
 *  S      [in]   analysis of A's pattern; kept by the factor.
 *  A      [in]   n x n with values; the analyzed pattern with its entries in the same order.
 *  opt    [in]   allocator, threads, isa, method, storage, pivots, null_tolerance,
 *                null_vector, null_vector_count, mass, consistency_tolerance, regularization,
 *                signs, growth_limit, error_limit.
 *  stats  [out]  factor.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no values, an option out of range or NaN, or at error.row a
 *           weight, sign or null vector that is not allowed; SL_ERR_OTHER_PATTERN: not the analyzed
 *           one, from error.row, error.column on; SL_ERR_MALFORMED: malformed, or two triangles
 *           whose values differ by more than 1e-6 of the row; SL_ERR_PIVOT: a null pivot at
 *           error.row, or a negative one that options do not allow; error.what says what helps,
 *           such as sl_symbolic_create_pivoted, and null_bound up to which size the pivot
 *           error.value is null; SL_ERR_NOT_FINITE: at error.row, and error.column if it is an
 *           entry of A; SL_ERR_INACCURATE: growth above its limit by the pivot error.value of
 *           error.row, or a number that float cannot hold; SL_ERR_UNSUPPORTED: the isa, or a
 *           combination of options and matrix that the manual excludes; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     O(sum over columns of entries^2) flops. Keeps nnz_panels doubles and, with the
 *           supernodal method, the update stack: about 5 % more for 2D meshes and 30 % for 3D
 *           meshes, more with threads.
 *  Threads  any number of calls at once on one S. If F is supernodal and not small, options.threads
 *           distribute this call, and every sl_factor_refactor of the factor, by one loop of the
 *           pool, with gcc, clang and MSVC. L has the same bits for any number of threads.
 *  Source   supernodal: multifrontal [DR83] [Liu92] on row tiles; up-looking: [LDL05], [Davis06]
 *           4.7; growth: [Hi02] 11.1.
 *  Manual   tools/docs/singular.md; tools/docs/indefinite.md; tools/docs/float.md
 *  Example  tests/core/test_factor.c, test_growth.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_options *opt,
                                                 sl_stats *stats);

/** Factors a matrix of the same pattern with new values. Same bits as sl_factor_create. Allocates
 *  nothing, but 24 bytes a row where small pivots have to be judged (singular.md); without this
 *  memory they are null.
 *
 *  F      [in,out]  unchanged after SL_ERR_ARGUMENT, SL_ERR_MALFORMED and SL_ERR_OTHER_PATTERN.
 *                   After SL_ERR_PIVOT, _NOT_FINITE, _INACCURATE and _UNSUPPORTED it has no
 *                   numbers, and every solve refuses it until a refactor succeeds.
 *  A      [in]      the analyzed pattern, new values. Two triangles are not compared.
 *  stats  [out]     factor.
 *  Returns  as sl_factor_create; SL_ERR_READ_ONLY: a mapped factor, or one that is loaded in part
 *           (save.h). SL_ERR_MEMORY and SL_ERR_TOO_LARGE only with the first refactorization of a
 *           loaded factor; SL_ERR_UNSUPPORTED only with SL_STORAGE_COMPLEX, or with
 *           null_vector_count where A has more null vectors than columns are given.
 *  Cost     as sl_factor_create, without its memory.
 *  Threads  exclusive use of F.
 *  Example  tests/core/test_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats);

/** Releases a factor. */
SL_API void sl_factor_free(sl_factor *F);

/** Pivots that a factorization did not take as they came. */
typedef enum sl_pivot_kind {
    SL_PIVOT_NULL = 0,   /* null ones that were skipped: SL_PIVOTS_SKIP_NULL */
    SL_PIVOT_REGULARIZED /* those that options.regularization changed */
} sl_pivot_kind;

/** The rows whose pivots were skipped or changed, in elimination order, and the diagonal matrix E
 *  of the changes.
 *
 *  kind      [in]   which pivots.
 *  rows      [out]  the first min(capacity, *count) of them; may be NULL if capacity = 0.
 *  shifts    [out]  the diagonal entries of E in these rows, 0 for null pivots; may be NULL.
 *  capacity  [in]   length of rows and shifts.
 *  count     [out]  how many there are; may exceed capacity.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_pivot_rows(const sl_factor *F, sl_pivot_kind kind,
                                                     sl_int *rows, double *shifts, sl_int capacity,
                                                     sl_int *count);

/** log |det A| and the sign of det A (-1 or 1); the determinant of a 0 x 0 matrix is 1.
 *
 *  If null pivots were skipped: the determinant of A without their rows and columns. For a
 *  Laplacian this is, in each component, the product of its nonzero eigenvalues divided by its
 *  number of rows. If regularization changed pivots: the determinant of A + E. Computed as a sum of
 *  logarithms, which cannot overflow.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE.  Cost  O(n).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_logdet(const sl_factor *F, double *log_abs_det,
                                                 double *sign);

/** L as a matrix in compressed columns, with its unit diagonal, rows ascending.
 *
 *  Contains the entries that are not exactly 0: zeros from relaxation and padding are left out, and
 *  so is an entry that became 0 by cancellation.
 *
 *  out    [out]  the matrix.
 *  opt    [in]   allocator.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_TOO_LARGE: 2^31 or more entries;
 *           SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_lower(sl_matrix **out, const sl_factor *F,
                                                const sl_options *opt);

/** Arrays of a factor. */
typedef struct sl_factor_arrays {
    sl_factor_info info; /* of the present numbers, or of the factorization that failed */
    const sl_symbolic *symbolic;
    /* panels, in the layout described at sl_symbolic_arrays; NULL if L is in float or complex */
    const double *L;
    const double *D; /* n pivots, in pivot order; DBL_MAX for a null pivot that was skipped */
    const double *E; /* n: D(k+1, k) at the first column k of a 2x2 pivot; NULL: there is none */
    const float *L_float;    /* the same panels in float; else NULL */
    const void *reserved[2]; /* NULL; new fields take their place */
} sl_factor_arrays;

/** The statistics of F, and its arrays, valid as long as F, with its present numbers; all 0 if F is
 *  NULL. */
SL_API sl_factor_arrays sl_factor_view(const sl_factor *F);

#endif
