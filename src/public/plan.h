/* plan.h: local solves: b known on a few rows, x wanted on a few others */
#ifndef SL_PUBLIC_PLAN_H
#define SL_PUBLIC_PLAN_H

#include "types.h"

/** Prepares solves of A x = b that know b only on bset and want x only on xset.
 *
 *  With P A P' = L D L' the forward sweep needs the elimination tree's paths from bset to the roots, the backward
 *  sweep those from xset: each is found by itself, in time proportional to its own size.
 *
 *  out    [out]  the plan, or NULL on error; release with sl_plan_free.
 *  S      [in]   analysis of A, n columns; borrowed, must outlive the plan.
 *  bset   [in]   nb rows of A in 0..n-1, any order, none twice; NULL (with nb ignored): all n. b is 0 elsewhere.
 *  xset   [in]   nx rows of A in 0..n-1, any order, none twice; NULL (with nx ignored): all n.
 *                An empty set is a pointer that is not NULL with nb or nx = 0; nothing is read there.
 *  opt    [in]   allocator, region; may be NULL. Where both sets are inside the region the sweeps end at its boundary,
 *                and nothing above it is looked at; where they are not, or one is NULL, the plan is the same as without.
 *  stats  [out]  the plan group, plan_in_region; error_row: an index out of range or given twice; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: a region of another analysis; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(nb + nx + rows of the supernodes reached), with a logarithm for rows that skip many ancestors; nothing
 *           O(n); 4 bytes a row of a set, and 4 a row and 32 a supernode reached kept.
 *  Threads  reads S; the plan is immutable and may be shared.
 *  Source   [Davis06] 3.2, 4.1; [HDA17] 3.
 *  Example  tests/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_create(sl_plan **out, const sl_symbolic *S,
                                               const sl_int *bset, sl_int nb, const sl_int *xset,
                                               sl_int nx, const sl_options *opt, sl_stats *stats);

/** Releases a plan; NULL is fine. */
SL_API void sl_plan_free(sl_plan *P);

/** Fills the plan group of stats again. */
SL_API void sl_plan_stats(const sl_plan *P, sl_stats *stats);

/** Solves A x = b on the plan's sets: exactly what the full solve gives there.
 *
 *  For the same instruction set and nrhs the result equals sl_factor_solve's bit for bit (the sign of a zero aside);
 *  in a region, to rounding.
 *
 *  F      [in]   a factor over the plan's analysis.
 *  X      [out]  nx x nrhs, column-major, leading dimension ldx elements, rows in the order of xset; may be B itself
 *                (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs, column-major, leading dimension ldb elements, rows in the order of bset.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, one of another analysis, or, in a region, other
 *           numbers than those it was made or refilled of; SL_ERR_INCONSISTENT: as in sl_factor_solve; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     2 (b_entries + x_entries) + 4 plan_region_entries flops a right-hand side; nothing O(n); no allocation once
 *           W has grown.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve(const sl_plan *P, const sl_factor *F, double *X,
                                              size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                                              sl_work *W);

/** sl_plan_solve with the right-hand sides interleaved, as in sl_factor_solve_interleaved: the same bits.
 *
 *  F      [in]   a factor over the plan's analysis.
 *  X      [out]  nx x nrhs, row-major, ldx >= nrhs elements from row to row, rows in the order of xset; may be B itself
 *                (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs, row-major, ldb >= nrhs elements from row to row, rows in the order of bset.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  as sl_plan_solve.
 *  Cost     as sl_plan_solve.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/test_interleaved.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_interleaved(const sl_plan *P, const sl_factor *F,
                                                          double *X, size_t ldx, const double *B,
                                                          size_t ldb, sl_int nrhs, sl_work *W);

/** One local solve without a plan object: sl_plan_create and sl_plan_solve in the caller's workspace.
 *
 *  X and B as in sl_plan_solve; bset and xset as in sl_plan_create; stats may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_INCONSISTENT: as in sl_factor_solve;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the sum of both; no allocation once W has grown.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_local_solve(const sl_factor *F, double *X, size_t ldx,
                                               const sl_int *xset, sl_int nx, const double *B,
                                               size_t ldb, const sl_int *bset, sl_int nb,
                                               sl_int nrhs, sl_work *W, sl_stats *stats);

#endif
