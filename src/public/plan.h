/* plan.h: local solves: b is known in a few rows, x is wanted in a few others */
#ifndef SL_PUBLIC_PLAN_H
#define SL_PUBLIC_PLAN_H

#include "solve.h"

/** Prepares solves of A x = b where b is nonzero only in bset and x is wanted only in xset.
 *
 *  With P A P' = L D L', the forward sweep needs the paths of the elimination tree from bset to the
 *  roots and the backward sweep those from xset.
 *
 *  out    [out]  the plan.
 *  S      [in]   analysis of A, n columns; kept by the plan.
 *  bset   [in]   nb rows of A in 0..n-1, any order; b is 0 in the others, and values of a row given
 *                twice add up. NULL: nb is SL_ALL or n, all rows, or 0.
 *  xset   [in]   nx rows of A, any order; a row given twice is answered twice. NULL: likewise.
 *  opt    [in]   allocator, region. If both sets are inside the region, the sweeps end at its
 *                boundary. If they are not, or if one is NULL, the region is not used.
 *  stats  [out]  plan; error.row: an index out of range.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MISMATCH: a region of another analysis;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(nb + nx + rows of the supernodes reached), with a logarithmic factor for rows that
 *           skip many ancestors; nothing O(n). Keeps 4 bytes per row of a set, and 4 per row and 32
 *           per supernode reached.
 *  Threads  reads S; the plan is immutable and may be shared.
 *  Source   [Davis06] 3.2, 4.1; [HDA17] 3.
 *  Example  tests/core/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_create(sl_plan **out, const sl_symbolic *S,
                                               const sl_int *bset, sl_int nb, const sl_int *xset,
                                               sl_int nx, const sl_options *opt, sl_stats *stats);

/** Releases a plan. */
SL_API void sl_plan_free(sl_plan *P);

/** Fills the plan group of stats. */
SL_API void sl_plan_stats(const sl_plan *P, sl_stats *stats);

/** Solves A x = b on the sets of a plan: exactly what the full solve gives there.
 *
 *  For the same instruction set and nrhs the result equals that of sl_factor_solve bit for bit,
 *  except for the sign of zeros. In a region it agrees up to rounding.
 *
 *  F      [in]   a factor over the plan's analysis.
 *  X      [out]  nx x nrhs, leading dimension ldx, rows in the order of xset. May be B itself (then
 *                ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs, leading dimension ldb, rows in the order of bset.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE: a failed factor, or, in a region, one whose
 *           numbers are not those that the region was computed from; SL_ERR_MISMATCH: a factor of
 *           another analysis; SL_ERR_INCONSISTENT, _NOT_FINITE: as in sl_factor_solve, of what x
 *           depends on; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     2 (b_entries + x_entries) + 4 region_entries flops per right-hand side; nothing O(n);
 *           no allocation once W has grown.
 *  Threads  any number at once on one P and one F, each with its own W.
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve(const sl_plan *P, const sl_factor *F, double *X,
                                              size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                                              sl_work *W);

/** One local solve without a plan: sl_plan_create and sl_plan_solve in the caller's workspace.
 *
 *  The other arguments as in these two calls; no region.
 *  stats  [out]  plan (bytes is 0); error.row: an index out of range.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_INCONSISTENT, _NOT_FINITE: as in
 *           sl_plan_solve; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the sum of both calls; no allocation once W has grown.
 *  Threads  any number at once on one F, each with its own W.
 */
SL_API SL_WARN_UNUSED sl_status sl_local_solve(const sl_factor *F, const sl_int *bset, sl_int nb,
                                               const sl_int *xset, sl_int nx, double *X, size_t ldx,
                                               const double *B, size_t ldb, sl_int nrhs, sl_work *W,
                                               sl_stats *stats);

#endif
