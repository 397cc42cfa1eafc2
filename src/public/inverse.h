/* inverse.h: entries and blocks of the inverse, without a backward sweep */
#ifndef SL_PUBLIC_INVERSE_H
#define SL_PUBLIC_INVERSE_H

#include "options.h"
#include "stats.h"

/* Entries come from forward sweeps, or from selected inversion where that is cheaper, as it is for
 * the whole diagonal (stats.inverse.method). Results equal those of full solves up to rounding; the
 * last bits depend on the other requests of the same call, which may share sweeps. If null pivots
 * were skipped, the inverse is that of the matrix without their rows and columns, and 0 in these;
 * sl_factor_pseudo_inverse makes it the pseudo-inverse. With regularized pivots it is that of
 * A + E.
 *
 * If pivots have both signs, selected inversion may lose the square of stats.factor.growth, where
 * solves lose growth itself. A bound on the loss is computed first, from L. Beyond 1e-10, relative
 * to an entry of the inverse, sweeps take the place of selected inversion. They are accurate, but
 * take some 10 to 100 times as long for the whole diagonal.
 *
 * All calls below
 *  F      [in]      a factor of A, n x n.
 *  stats  [out]     inverse; error.row, error.column: an index out of range.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, a negative count, an index out of range; SL_ERR_STALE;
 *           SL_ERR_UNSUPPORTED: a factor with 2x2 pivots; SL_ERR_TOO_LARGE; SL_ERR_MEMORY. On error
 *           nothing is written.
 *  Cost     sweeps take 2 entries flops per lane, and 8 lanes take as long as two to three, so that
 *           many requests should share a call. Entries of one row or column, in any number, are a
 *           local solve; a single entry off the diagonal if that is cheaper.
 *           Nothing O(n), except for NULL sets; no allocation once W has grown to the largest reach
 *           and 16 bytes per request.
 *  Threads  any number at once on one F, each with its own W. Uses the threads that F was
 *           created with, and has the same bits for any number of them.
 *  Source   [HDA17] 5; [Davis06] 3.2, 4.1.
 *  Manual   tools/docs/inverse.md
 *  Example  tests/core/test_inverse.c
 */

/** Diagonal entries of the inverse: out[k] = (A^-1)(rows[k], rows[k]).
 *
 *  out    [out]  count values.
 *  rows   [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL: all, or none.
 *  Source   [HDA17] 5; [ET75], [SelInv].
 *  Example  tests/core/test_inverse_diagonal.c
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_diagonal(const sl_factor *F, double *out,
                                                    const sl_int *rows, sl_int count, sl_work *W,
                                                    sl_stats *stats);

/** Entries of the inverse: out[k] = (A^-1)(rows[k], columns[k]).
 *
 *  out    [out]  count values.
 *  rows, columns  [in]  count rows of A each, in 0..n-1, any order, repetitions allowed. Selected
 *                 inversion is possible only if all entries are in the pattern of L, which contains
 *                 that of A.
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_pairs(const sl_factor *F, double *out,
                                                 const sl_int *rows, const sl_int *columns,
                                                 sl_int count, sl_work *W, sl_stats *stats);

/** A dense block of the inverse: Z(i, j) = (A^-1)(rows[i], columns[j]).
 *
 *  Z        [out]  n_rows x n_columns, leading dimension ldz >= n_rows.
 *  rows     [in]   n_rows rows of A in 0..n-1, any order, repetitions allowed.
 *  columns  [in]   n_columns rows of A, likewise. If it is the same array as rows, of the same
 *                  length, each sweep and each entry is computed once and the block is exactly
 *                  symmetric.
 *  Cost     the sweeps, and n_rows n_columns times the common columns. W holds 128 vectors of the
 *           shorter side at a time; the longer side is swept once for each 128 (not if both are one
 *           array).
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                                                 const sl_int *rows, sl_int n_rows,
                                                 const sl_int *columns, sl_int n_columns,
                                                 sl_work *W, sl_stats *stats);

#endif
