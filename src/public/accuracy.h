/* accuracy.h: how good a solution is and how to better it: refinement, condition, what a right-hand side lacks */
#ifndef SL_PUBLIC_ACCURACY_H
#define SL_PUBLIC_ACCURACY_H

#include "types.h"

/** Betters solutions of A X = B: residual, solve, add, for as long as that helps.
 *
 *  Each column goes on until its backward error max |b - A x| / (|A| |x| + |b|), row by row, is epsilon, a correction
 *  fails to halve it, or the steps are used up; a correction that makes it worse is not taken. With a regularized factor,
 *  of A + E, that turns the solution of the one system into that of the other. With null pivots B has to be consistent.
 *
 *  F      [in]      a factor of A, or of a matrix near A.
 *  A      [in]      the matrix; the pattern that was analysed.
 *  X      [in,out]  n x nrhs, column-major, leading dimension ldx elements: solutions as sl_factor_solve gives, or any other
 *                   start; must not overlap B. On error untouched.
 *  B      [in]      n x nrhs, column-major, leading dimension ldb elements.
 *  steps  [in]      the most corrections of a column, 0 or more; 0 only measures.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  stats  [out]     refine_steps, backward_error; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_PATTERN: not the pattern that was analysed;
 *           SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and could not.
 *  Cost     a product with A, and for each step another and a solve; W grows to O(n min(nrhs, 8)).
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [Sk80]: one step of it makes a solver stable row by row.
 *  Example  tests/test_refine.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refine(const sl_factor *F, const sl_csc *A, double *X,
                                                 size_t ldx, const double *B, size_t ldb,
                                                 sl_int nrhs, sl_int steps, sl_work *W,
                                                 sl_stats *stats);

/** Solves A x = b on a plan's sets with a regularized factor, L D L' = P (A + E) P': sl_plan_solve and refinement.
 *
 *  A residual is known where x is known around it. That of a solution x of (A + E) x = b is E x, rounding aside, and
 *  E is 0 but in the regularized rows: the sweeps x <- (A + E)^-1 (b + E x) need x in these and the wanted rows
 *  alone, and cost what a local solve costs. What they take away is the error of regularization; that of rounding
 *  is as in sl_plan_solve, and takes the whole of x and sl_factor_refine. Where nothing was regularized it is sl_plan_solve.
 *
 *  P      [in]   a plan whose two reaches hold every regularized row of the components that b is in: as they do where
 *                these rows are in both of its sets.
 *  X, B, ldx, ldb, nrhs, W  as in sl_plan_solve.
 *  steps  [in]   the most corrections of a column, 0 or more.
 *  stats  [out]  refine_steps; backward_error: max |E (x - the x before)| / max |b|; with SL_ERR_ARGUMENT error_row: a
 *                regularized row outside of the reaches; may be NULL.
 *  Returns  as sl_plan_solve; SL_ERR_UNSUPPORTED: a plan in a region, and a factor with regularized rows.
 *  Cost     1 + steps local solves; nothing O(n); no allocation once W has grown, by 16 numbers a row of the x-set.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/test_refine_local.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_refined(const sl_plan *P, const sl_factor *F,
                                                      double *X, size_t ldx, const double *B,
                                                      size_t ldb, sl_int nrhs, sl_int steps,
                                                      sl_work *W, sl_stats *stats);

/** An estimate of 1 / (||A|| ||A^-1||), by largest column sums; 0 where null pivots were skipped, 1 where n = 0.
 *
 *  The true one is never above it but for rounding, and rarely below a third of it. Where regularization changed
 *  pivots, A^-1 is (A + E)^-1.
 *
 *  A      [in]      the matrix that F is a factor of.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_PATTERN: not the pattern that was analysed;
 *           SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and could not.
 *  Cost     4 to 10 solves.
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [Hi88]
 *  Example  tests/test_condition.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond,
                                                sl_work *W);

/** What right-hand sides lack to be consistent with a singular A: Z' B, for the null vectors z of A.
 *
 *  Vector k of Z belongs to row k of sl_factor_null_rows, and is 1 there and 0 in the other null rows: B with Y(k, r)
 *  taken off that row has a solution. On a Laplacian Y holds the sum of B over each component.
 *
 *  F      [in]   a factor made with SL_SEMIDEFINITE; one without null pivots has nothing to tell.
 *  Y      [out]  null rows x nrhs, column-major, leading dimension ldy elements; must not overlap B.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and
 *           could not.
 *  Cost     the forward half of sl_factor_solve.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/test_consistent.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy,
                                                  const double *B, size_t ldb, sl_int nrhs,
                                                  sl_work *W);

#endif
