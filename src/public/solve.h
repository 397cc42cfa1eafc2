/* solve.h: full solves, and the workspace that every solve writes to */
#ifndef SL_PUBLIC_SOLVE_H
#define SL_PUBLIC_SOLVE_H

#include "types.h"

/** Makes an empty workspace. It grows when a solve needs more, and keeps what it has: one a thread.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_create(sl_work **out, const sl_options *opt);

/** Releases a workspace; NULL is fine. */
SL_API void sl_work_free(sl_work *W);

/** Bytes that a workspace holds now. */
SL_API size_t sl_work_bytes(const sl_work *W);

/** Grows W so that full solves on F with up to nrhs right-hand sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_factor(sl_work *W, const sl_factor *F, sl_int nrhs);

/** Grows W so that solves of plan P with up to nrhs right-hand sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_plan(sl_work *W, const sl_plan *P, sl_int nrhs);

/** Solves A X = B. Of a singular A: the solution that sl_factor_create tells of.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, column-major, leading dimension ldx elements, in the order of A's rows; may be B itself
 *                (then ldx = ldb). On error untouched.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements.
 *  nrhs   [in]   number of right-hand sides, 0 or more; solved in blocks of 8, for the time of two to three alone.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_INCONSISTENT: a column of B has no solution
 *           (SL_SEMIDEFINITE without mass); SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and could not.
 *  Cost     4 nnz_panels flops a right-hand side; reads L twice for each block; W grows to O(n min(nrhs, 8)). Where B
 *           has to be consistent, right-hand sides beyond the eighth are swept forward once more beforehand.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/test_solve.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs,
                                                sl_work *W);

/** Solves A X = B with the right-hand sides interleaved: the numbers of one row stand side by side.
 *
 *  The same bits as sl_factor_solve, and what several right-hand sides are fastest in: 8 columns that lie apart take
 *  about a fifth of a solve to bring together and to part again.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, row-major, ldx >= nrhs elements from row to row; may be B itself (then ldx = ldb). On error
 *                untouched.
 *  B      [in]   n x nrhs, row-major, ldb >= nrhs elements from row to row.
 *  nrhs   [in]   as in sl_factor_solve.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  as sl_factor_solve.
 *  Cost     as sl_factor_solve.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/test_interleaved.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve_interleaved(const sl_factor *F, double *X,
                                                            size_t ldx, const double *B, size_t ldb,
                                                            sl_int nrhs, sl_work *W);

#endif
