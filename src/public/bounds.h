/* bounds.h: how far the answers of a factor are from the exact ones: a bound for each number */
#ifndef SL_PUBLIC_BOUNDS_H
#define SL_PUBLIC_BOUNDS_H

#include "options.h"
#include "plan.h"
#include "stats.h"

/** Finds eta, the largest relative error of any solve with F in the energy norm of A. EXPERIMENTAL
 *
 *  For every b, the computed z and the exact x = A^-1 b satisfy ||x - z|| <= eta ||x|| with
 *  ||v||^2 = v' A v. F keeps eta for sl_plan_solve_bounded until its numbers change; a saved factor
 *  keeps it, too.
 *
 *  F          [in,out]  a factor of A, definite, or semidefinite with skipped null pivots; L in
 *                       double or float. With options.mass: one known null vector a component.
 *  A          [in]      the matrix, or A[R, R] of a restriction. Guaranteed: with the values that
 *                       F was computed from as a whole, not by sl_factor_change_entries and the
 *                       like.
 *  certainty  [in]      SL_ESTIMATED: 4 times the largest error that 12 solves show, whose
 *                       right-hand sides approach the worst ones.
 *                       SL_GUARANTEED: a proved bound, by rounding errors a priori and the smallest
 *                       eigenvalue of A, which a second factor of A with a smaller diagonal proves;
 *                       as a rule 1e3 to 1e6 times larger. Barring underflow.
 *  stats      [out]     certificate.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_MISMATCH: guaranteed, and other values
 *           than those of F; SL_ERR_OTHER_PATTERN; SL_ERR_UNSUPPORTED: negative or regularized
 *           pivots, complex storage, options.mass with several or unknown null vectors; guaranteed
 *           also null pivots, L in float, restrictions, duplicate entries, entries of the diagonal
 *           beyond 1e-200 .. 1e200; SL_ERR_INACCURATE: eta exceeds 1/16, as with another A;
 *           SL_ERR_TOO_LARGE, SL_ERR_MEMORY. On errors F has no eta.
 *  Cost     estimated: 28 solves, 4 or 8 at a time, with products: as long as 15 (n = 1e5) to 45
 *           (n = 900) single solves; W grows by 20 to 28 n numbers. Guaranteed: 7 to 10
 *           factorizations; memory of a second factor while it runs.
 *  Threads  the caller serializes calls that change F.
 *  Source   [Ru06] for the eigenvalue; the bounds are derived in the manual.
 *  Manual   tools/docs/bounds.md
 *  Example  tests/core/test_bounds.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_certify(sl_factor *F, const sl_csc *A,
                                                  sl_certainty certainty, sl_work *W,
                                                  sl_stats *stats);

/** sl_plan_solve, and for every number a bound of its distance from the exact answer. EXPERIMENTAL
 *
 *  The bound of x(i) is about eta sqrt((A^-1)(i,i) b' A^-1 b), and less where the path of i meets
 *  those of b only far up. It is sharp near b and loose where x has decayed by many digits. With
 *  skipped null pivots the exact answer is the one that is 0 in their rows or, with options.mass,
 *  has a weighted mean of 0 in each component.
 *
 *  P       [in]      the plan; not in a region.
 *  F       [in]      a factor that sl_factor_certify has certified.
 *  X, B, ldx, ldb, nrhs, W  as in sl_plan_solve; the solutions have the same bits.
 *  bounds  [out]     as X, with its leading dimension; must not overlap X or B. Infinite where
 *                    squares of b leave the range of double, below about 1e-100.
 *  scales  [in,out]  4 nx + 2 numbers that depend on P and the numbers of F alone, all 0 before the
 *                    first call: computed in a call that finds those of another plan or of other
 *                    numbers. NULL: computed in every call.
 *  stats   [out]     certificate.
 *  Returns  as sl_plan_solve; also SL_ERR_STALE: F is not certified; SL_ERR_UNSUPPORTED: a plan in
 *           a region.
 *  Cost     that of sl_plan_solve with the scales of an earlier call; they take nx forward sweeps.
 *  Threads  as sl_plan_solve; scales are written by a call that computes them.
 *  Manual   tools/docs/bounds.md
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_bounded(const sl_plan *P, const sl_factor *F,
                                                      double *X, size_t ldx, double *bounds,
                                                      const double *B, size_t ldb, sl_int nrhs,
                                                      double *scales, sl_work *W, sl_stats *stats);

#endif
