/* accuracy.h: refinement of solutions, condition estimate, consistency of singular systems */
#ifndef SL_PUBLIC_ACCURACY_H
#define SL_PUBLIC_ACCURACY_H

#include "options.h"
#include "stats.h"

/** Iterative refinement of A X = B, until the backward error no longer halves.
 *
 *  The backward error is componentwise, max_i |b - A x|_i / (|A| |x| + |b|)_i. If it remains above
 *  options.error_limit of the factor, 1e-8 by default, in some column, the call returns
 *  SL_ERR_INACCURATE, and X holds the best solutions that were found. With a regularized factor, of
 *  A + E, the solution of (A + E) x = b becomes that of A x = b. If null pivots were skipped, B has
 *  to be consistent.
 *
 *  F      [in]      a factor of A, or of a matrix close to A.
 *  A      [in]      the matrix, with the analyzed pattern.
 *  X      [in,out]  n x nrhs, leading dimension ldx: solutions from sl_factor_solve, or any other
 *                   start; must not overlap B. On errors other than SL_ERR_INACCURATE untouched.
 *  B      [in]      n x nrhs, leading dimension ldb.
 *  steps  [in]      maximum number of corrections per column, 0 or more; 0 only measures, and does
 *                   not return SL_ERR_INACCURATE.
 *  stats  [out]     refine.
 *  Returns  SL_OK; SL_ERR_INACCURATE: see above; SL_ERR_ARGUMENT; SL_ERR_STALE;
 *           SL_ERR_OTHER_PATTERN: not the analyzed pattern; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     a product with A, then a product and a solve per step; W grows to O(n min(nrhs, 8)).
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [Sk80]: one step makes a solver stable row by row.
 *  Manual   tools/docs/indefinite.md
 *  Example  tests/core/test_refine.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refine(const sl_factor *F, const sl_csc *A, double *X,
                                                 size_t ldx, const double *B, size_t ldb,
                                                 sl_int nrhs, sl_int steps, sl_work *W,
                                                 sl_stats *stats);

/** sl_plan_solve with a regularized factor, L D L' = P (A + E) P', refined to solve A x = b.
 *
 *  Removes the error of regularization; rounding errors remain as in sl_plan_solve. Their backward
 *  error is taken to be at least epsilon times the growth (stats.factor), with the epsilon of float
 *  where L is in float. If nothing was regularized, x is that of sl_plan_solve.
 *
 *  P      [in]   a plan whose two reaches contain every regularized row of the components of b.
 *                This holds if these rows are in both sets.
 *  F, X, ldx, B, ldb, nrhs, W  as in sl_plan_solve.
 *  steps  [in]   maximum number of corrections per column, 0 or more; 0 only measures.
 *  stats  [out]  refine, with backward_error = max |E (x - previous x)| / max |b|, or that of
 *                rounding where it is larger; error.row with SL_ERR_ARGUMENT: a regularized row
 *                outside the reaches. sl_factor_pivot_rows lists all.
 *  Returns  as sl_plan_solve; SL_ERR_INACCURATE: this backward error is above options.error_limit
 *           of the factor after one or more steps, and X is written; SL_ERR_UNSUPPORTED: a plan in
 *           a region and a factor with regularized rows.
 *  Cost     1 + steps local solves; nothing O(n); no allocation once W has grown, by 16 numbers per
 *           row of the x-set.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Manual   tools/docs/indefinite.md
 *  Example  tests/core/test_refine_local.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_regularized(const sl_plan *P, const sl_factor *F,
                                                          double *X, size_t ldx, const double *B,
                                                          size_t ldb, sl_int nrhs, sl_int steps,
                                                          sl_work *W, sl_stats *stats);

/** Estimates the reciprocal condition number 1 / (||A|| ||A^-1||) in the one-norm.
 *
 *  epsilon / rcond estimates the relative error of a solve without refinement; if it is near 1 or
 *  above, solutions are worthless. Up to rounding, the true value is never larger than the
 *  estimate, and rarely smaller than a third of it. L D L' is judged, too: the solves of the
 *  estimator are checked against A, and where their largest backward error w exceeds 64 epsilon,
 *  because L has grown, the estimate is multiplied by epsilon / w; with L in float epsilon is
 *  that of float here, and rcond is that of A down to about 1e-13. 0 if null pivots were skipped; 1
 *  if n = 0. If regularization changed pivots, all this is about A + E.
 *
 *  A      [in]      the matrix that F is a factor of.
 *  rcond  [out]     the estimate.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_OTHER_PATTERN: not the analyzed pattern;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     4 to 10 solves, each with a product with A.
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [Hi88]
 *  Example  tests/core/test_condition.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond,
                                                sl_work *W);

/** How inconsistent right-hand sides of a singular A are: Y = Z' B for the null vectors Z of A.
 *
 *  Column k of Z belongs to row k of sl_factor_pivot_rows; it is 1 there and 0 in the other null
 *  rows. Known null vectors are used as they are, combinations of them where a component has
 *  several, and others are computed from L (tools/docs/singular.md).
 *  After Y(k, r) is subtracted from B in that row, the system has a solution. For a
 *  Laplacian, Y contains the sums of B over the components.
 *
 *  F      [in]   a factor made with SL_PIVOTS_SKIP_NULL; without null pivots Y has no rows.
 *  Y      [out]  null rows x nrhs, leading dimension ldy; must not overlap B.
 *  B      [in]   n x nrhs, leading dimension ldb.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the forward sweep of sl_factor_solve.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/core/test_consistency.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy,
                                                  const double *B, size_t ldb, sl_int nrhs,
                                                  sl_work *W);

#endif
