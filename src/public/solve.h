/* solve.h: full solves, and the workspace of all solves */
#ifndef SL_PUBLIC_SOLVE_H
#define SL_PUBLIC_SOLVE_H

#include "options.h"
#include "stats.h"

/** Creates an empty workspace for one thread. It grows when a call needs more and never shrinks.
 *
 *  out  [out]  the workspace, or NULL on error; release with sl_work_free.
 *  opt  [in]   allocator, threads: full solves with this workspace use them; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_create(sl_work **out, const sl_options *opt);

/** Releases a workspace; NULL is allowed. */
SL_API void sl_work_free(sl_work *W);

/** Bytes that a workspace holds now. */
SL_API size_t sl_work_bytes(const sl_work *W);

/** Grows W so that full solves with F and up to nrhs right-hand sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_factor(sl_work *W, const sl_factor *F, sl_int nrhs);

/** Grows W so that solves of plan P with up to nrhs right-hand sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_plan(sl_work *W, const sl_plan *P, sl_int nrhs);

/** Grows W so that sl_local_solve allocates nothing for b-sets of up to nb rows, x-sets of up to nx
 *  rows and up to nrhs right-hand sides. A set that is NULL has n rows.
 *
 *  The sets are not known yet, so the bound is nb and nx times the longest path of the elimination
 *  tree, and never more than the whole of it. It is generous: W keeps that many bytes, and a W that
 *  grows by itself in the first solves stays smaller.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(supernodes) for the length of the longest path.
 *  Example  tests/core/test_reserve.c
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_local(sl_work *W, const sl_symbolic *S, sl_int nb,
                                                      sl_int nx, sl_int nrhs);

/** Grows W so that sl_factor_refine with up to nrhs right-hand sides allocates nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_refine(sl_work *W, const sl_factor *F, sl_int nrhs);

/** Grows W so that sl_plan_solve_refined on plan P with up to nrhs right-hand sides allocates
 *  nothing, whatever factor it is called with.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_refined(sl_work *W, const sl_plan *P, sl_int nrhs);

/** Grows W so that sl_factor_rcond allocates nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_rcond(sl_work *W, const sl_factor *F);

/** Grows W so that sl_factor_defects with up to nrhs right-hand sides allocates nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_defects(sl_work *W, const sl_factor *F,
                                                        sl_int nrhs);

/** Solves A X = B. For a singular A, sl_factor_create describes which solution is computed.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, column-major, leading dimension ldx elements, rows in the order of A.
 *                May be B itself (then ldx = ldb). On error untouched.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements.
 *  nrhs   [in]   number of right-hand sides, 0 or more. They are solved in blocks of 32, then 16,
 *                then up to 8, for which a solution has the same bits. 8 take as long as two to
 *                three single solves, 32 as long as six to eight.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_INCONSISTENT: a column of B
 *           has no solution (SL_NULL_PIVOT_SKIP without mass); SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W
 *           could not grow.
 *  Cost     4 nnz_panels flops per right-hand side; each block reads L twice. W grows to O(n
 *           min(nrhs, 32)). If consistency is checked, right-hand sides beyond the eighth take an
 *           additional forward sweep.
 *  Threads  any number at once on one F, each with its own W. A single right-hand side, and more
 *           than 8, of a regular A are distributed over the threads that W was created with, with
 *           the same bits; W then grows to twice the size, or to that for each thread.
 *  Example  tests/core/test_solve.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs,
                                                sl_work *W);

/** Solves A X = B with interleaved right-hand sides: the numbers of one row are contiguous.
 *
 *  The same bits as sl_factor_solve, and the fastest layout for several right-hand sides:
 *  gathering and scattering 8 separate columns takes about a fifth of a solve.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, row-major, ldx >= nrhs elements from row to row. May be B itself (then
 *                ldx = ldb). On error untouched.
 *  B      [in]   n x nrhs, row-major, ldb >= nrhs elements from row to row.
 *  nrhs   [in]   as in sl_factor_solve.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  as sl_factor_solve.
 *  Cost     as sl_factor_solve.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/core/test_interleaved.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve_interleaved(const sl_factor *F, double *X,
                                                            size_t ldx, const double *B, size_t ldb,
                                                            sl_int nrhs, sl_work *W);

#endif
