/* solve.h: full solves, and the workspace of all solves */
#ifndef SL_PUBLIC_SOLVE_H
#define SL_PUBLIC_SOLVE_H

#include "options.h"
#include "stats.h"

/** A leading dimension of rows: the block is row-major, ld elements from row to row.
 *
 *  Dense blocks are column-major, with leading dimensions in elements. In solves, products and
 *  residuals, each of ldx, ldb and the like may be one of SL_ROWS instead; only sl_inverse_block
 *  refuses it. So x, y, z side by side are solved for as they are stored:
 *
 *      sl_factor_solve(F, X, SL_ROWS(3), B, SL_ROWS(3), 3, W);
 *
 *  ld must be at least the number of right-hand sides. Its two top bits, one of which says the
 *  layout, must be clear. Blocks of a call may have different layouts, unless they are one array.
 *  The results have the same bits in any layout. Several right-hand sides are fastest by rows.
 */
#define SL_ROWS(ld) ((size_t)(ld) | SL_ROW_MAJOR)

/** The bit of a size_t that SL_ROWS sets. */
#define SL_ROW_MAJOR (~((size_t)-1 >> 1))

/** Creates an empty workspace for one thread. It grows when a call needs more and never shrinks.
 *
 *  out  [out]  the workspace.
 *  opt  [in]   allocator, threads: full solves with this workspace use them.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_create(sl_work **out, const sl_options *opt);

/** Releases a workspace. */
SL_API void sl_work_free(sl_work *W);

/** Bytes that a workspace holds now; NULL has 0. */
SL_API size_t sl_work_bytes(const sl_work *W);

/** Grows W to at least so many bytes. A call that needs no more then allocates nothing.
 *
 *  Workspaces only grow, so that sl_work_bytes after a call is what the call needs:
 *
 *      sl_work_create(&trial, &opt);                       threads as those of W
 *      sl_factor_solve(F, X, n, B, n, nrhs, trial);        the largest call that W is for
 *      bytes = sl_work_bytes(trial);  sl_work_free(trial);
 *      sl_work_reserve(W, bytes);                          where memory may be allocated
 *      sl_factor_solve(F, X, n, B, n, nrhs, W);            from now on without an allocation
 *
 *  | calls                             | what they need depends on                              |
 *  |-----------------------------------|--------------------------------------------------------|
 *  | sl_factor_solve, _solve_part,     | the analysis, nrhs, the threads of W, and whether F    |
 *  |  _multiply_part, _defects,        | has null pivots. With several threads, reserve for     |
 *  |  _refine, _rcond                  | each nrhs: a smaller one may need more                 |
 *  | sl_factor_pseudo_inverse          | the analysis and the number of columns                 |
 *  | sl_fixed_solve                    | the object, nrhs, and the threads of W                 |
 *  | sl_plan_solve, parts of a plan,   | the plan, nrhs, null pivots of F, regularized rows;    |
 *  |  sl_plan_solve_regularized        | fewer right-hand sides need no more                    |
 *  | sl_selected_refactor              | the selected inverse and options.storage of F          |
 *  | sl_region_refactor                | the region, the instruction set of F, and Z            |
 *  | sl_local_solve, sl_inverse_*      | the rows of the call, too; fewer can need more         |
 *
 *  Each workspace of a batch needs what its largest request does. The values of A, B and X, and
 *  leading dimensions, make no difference, but for entries of the inverse of A with pivots of both
 *  signs, where values decide between the methods.
 *
 *  W      [in,out]  a larger one is left as it is.
 *  bytes  [in]      any number.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: W is NULL; SL_ERR_TOO_LARGE; SL_ERR_MEMORY. On error W is as
 *           before.
 *  Example  tests/core/test_reserve.c
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve(sl_work *W, size_t bytes);

/** Solves A X = B. For a singular A, sl_factor_create describes which solution is computed.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, leading dimension ldx, rows in the order of A. May be B itself (then ldx
 *                = ldb). On error untouched.
 *  B      [in]   n x nrhs, leading dimension ldb.
 *  nrhs   [in]   number of right-hand sides, 0 or more. 8 take as long as two to three single
 *                solves, 32 as long as six to eight. Each solution has the bits that it has in
 *                a call for its group of 8.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_INCONSISTENT: a column of B has no
 *           solution (SL_PIVOTS_SKIP_NULL without mass); SL_ERR_NOT_FINITE: a number of B is not,
 *           or X overflows: X is written; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     4 nnz_panels flops per right-hand side; each block reads L twice. W grows to O(n
 *           min(nrhs, 64)). If consistency is checked, right-hand sides beyond the eighth are
 *           read twice, and take an additional forward sweep where null vectors are not known.
 *  Threads  any number at once on one F, each with its own W. Solves of a regular A that take a
 *           few tenths of a ms are distributed over the threads that W was created with, with the
 *           same bits; W then grows to twice the size, or to that for each thread.
 *  Example  tests/core/test_solve.c, test_interleaved.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs,
                                                sl_work *W);

#endif
