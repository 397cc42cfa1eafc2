/* fixed.h: rows fixed at given values, of a matrix that need not be factored as a whole */
#ifndef SL_PUBLIC_FIXED_H
#define SL_PUBLIC_FIXED_H

#include "solve.h"

/** Prepares solves of A x = b in the free rows, where x is given in the others: Dirichlet problems,
 *  harmonic maps, interpolation. For definite A, x minimizes x' A x / 2 - b' x under x(rows) = g.
 *
 *  The free rows have a factor of A[free, free] of their own; A may be singular. Who has a factor
 *  of all rows takes sl_factor_submatrix, or holds rows that come and go by sl_constraints_add.
 *
 *  out    [out]  the object.
 *  A      [in]   n x n with values, symmetric, not kept. Entries between fixed rows are not read,
 *                and two triangles not compared.
 *  rows   [in]   count rows of A in 0..n-1 that are fixed, any order, none twice; from none to all.
 *  opt    [in]   allocator, threads, and what sl_symbolic_create and sl_factor_create read, in rows
 *                of A: perm, mass, signs and null_vector have n entries.
 *  stats  [out]  fixed, symbolic, factor; errors are in rows of A.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range or given twice (error.row);
 *           SL_ERR_PIVOT: A[free, free] is singular, as where no row of a component of a Laplacian
 *           is fixed (error.row); others as sl_symbolic_create and sl_factor_create.
 *  Cost     O(n + nnz), and the analysis and factorization of A[free, free]. Keeps 4 bytes per row,
 *           16 per entry of A[free, free], and 20 per entry between free and fixed rows.
 *  Manual   tools/docs/fixed.md
 *  Example  tests/core/test_fixed.c
 */
SL_API SL_WARN_UNUSED sl_status sl_fixed_create(sl_fixed **out, const sl_csc *A, const sl_int *rows,
                                                sl_int count, const sl_options *opt,
                                                sl_stats *stats);

/** Releases the object. */
SL_API void sl_fixed_free(sl_fixed *D);

/** Takes new values of A.
 *
 *  A      [in]   the pattern that sl_fixed_create was given, its entries in the same order.
 *  stats  [out]  fixed, factor; errors are in rows of A.
 *  Returns  as sl_fixed_create; SL_ERR_OTHER_PATTERN. After SL_ERR_PIVOT, _NOT_FINITE, _INACCURATE
 *           and _UNSUPPORTED solves are refused until a call succeeds; else D is as before.
 *  Cost     a refactorization of A[free, free]; nothing is allocated.
 *  Threads  exclusive use of D.
 */
SL_API SL_WARN_UNUSED sl_status sl_fixed_refactor(sl_fixed *D, const sl_csc *A, sl_stats *stats);

/** Solves for x in the free rows, for any values of the fixed ones.
 *
 *  X     [out]  n x nrhs, leading dimension ldx; fixed rows are g. May be B itself (then ldx =
 *               ldb). Errors but SL_ERR_INCONSISTENT and _NOT_FINITE leave it untouched.
 *  B     [in]   n x nrhs, leading dimension ldb; fixed rows are not used. NULL: b = 0.
 *  G     [in]   count x nrhs, leading dimension ldg: the values, in the order of rows. Must not
 *               overlap X. May be NULL if count = 0.
 *  nrhs  [in]   number of right-hand sides, 0 or more.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE: a failed refactorization; SL_ERR_NOT_FINITE,
 *           SL_ERR_INCONSISTENT: as sl_factor_solve; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     for each right-hand side a full solve of the free rows, 2 flops per entry of A between
 *           free and fixed rows, and a pass over X and B. No allocation once W has grown.
 *  Threads  any number at once on one D, each with its own W, whose threads are used.
 */
SL_API SL_WARN_UNUSED sl_status sl_fixed_solve(const sl_fixed *D, double *X, size_t ldx,
                                               const double *B, size_t ldb, const double *G,
                                               size_t ldg, sl_int nrhs, sl_work *W);

/** Parts of the object: row k of its system is row free_rows[k] of A. */
typedef struct sl_fixed_arrays {
    sl_int n_free, n_fixed;
    const sl_int *free_rows;     /* n_free: ascending */
    const sl_int *fixed_rows;    /* n_fixed: rows, in the order of the caller */
    const sl_symbolic *symbolic; /* of A[free, free] */
    const sl_factor *factor;
    sl_csc matrix;           /* A[free, free], one triangle */
    const void *reserved[2]; /* NULL; new fields take their place */
} sl_fixed_arrays;

/** The parts of D, for calls on a factor. Valid until sl_fixed_refactor or _free. */
SL_API sl_fixed_arrays sl_fixed_view(const sl_fixed *D);

#endif
