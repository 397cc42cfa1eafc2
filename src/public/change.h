/* change.h: a factor that follows small changes of its matrix */
#ifndef SL_PUBLIC_CHANGE_H
#define SL_PUBLIC_CHANGE_H

#include "options.h"
#include "stats.h"

/** Changes a factor of A into one of A + V diag(sigma) V'. Plans stay valid; regions and selected
 *  inverses of the old numbers are refused.
 *
 *  Only the columns of L on the paths from the rows of V to the roots change. A vector must not
 *  create entries outside of L: all its rows have to be in the column of L that belongs to the
 *  first of them. This holds for e_i and, for an entry (i, j) of A, for e_i - e_j.
 *
 *  If all pivots of F have one sign, they must keep it: the change fails only if the changed matrix
 *  is not definite, up to rounding. With pivots of both signs it may also fail because it meets a
 *  null pivot on its way. Errors add up: refactor if growth or stats.change.drift is too large.
 *  Drift counts what a row loses relative to its own entries, if all pivots have one sign.
 *
 *  F      [in,out]  the factor. On error it is as before, bit for bit.
 *  V      [in]      n x k, any k, in the rows of A; duplicates are summed, zeros ignored.
 *  sigma  [in]      k weights of any sign; NULL: all 1.
 *  stats  [out]     change, factor. For pivots of both signs growth, pivot_min and pivot_max become
 *                   bounds until the next refactorization.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also if V does not have n rows; SL_ERR_MALFORMED: V is
 *           malformed; SL_ERR_OTHER_PATTERN: row error.row of V is not in the column of L of
 *           error.column; SL_ERR_PIVOT: a pivot would change its sign or vanish, at error.row;
 *           SL_ERR_NOT_FINITE: an entry of V at error.row, a weight (error.row = -1) or a pivot;
 *           SL_ERR_INACCURATE: growth beyond its limit, that of a loaded factor with its drift;
 *           SL_ERR_STALE: F has no numbers; SL_ERR_READ_ONLY: F is mapped; SL_ERR_UNSUPPORTED: null
 *           pivots were skipped, there are 2x2 pivots, or L is not in double; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     4 flops per vector and entry of L in the columns on its path, which are read and
 *           written once for up to 8 vectors. Changes that may fail read them again, or copy them.
 *           The first change of a definite factor allocates 9 bytes a row, for drift.
 *  Threads  exclusive use of F.
 *  Source   [DH01], with the factorization of [Bie76] for several vectors.
 *  Manual   tools/docs/changes.md
 *  Example  tests/core/test_change.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_rank_update(sl_factor *F, const sl_csc *V,
                                                      const double *sigma, sl_work *W,
                                                      sl_stats *stats);

/** Changes a factor by entries of A, or by columns of A in which entries have changed.
 *
 *  By entries (rows, columns, deltas): a_ij and a_ji change by delta, in the way that counted flops
 *  and entries call cheapest: by rank-one changes, by computing the columns of L again that the
 *  change reaches, or by a refactorization. If A is NULL, by rank-one changes alone: one for the
 *  weight of an edge of a graph, which changes a_ij by -w and a_ii and a_jj by w, one for an entry
 *  of the diagonal, and up to three for any other entry. Where these are not possible or have added
 *  up too much error, the other ways remain (stats.change.reason).
 *
 *  By columns (rows and deltas are NULL): the columns of L that the changes reach are computed
 *  again. They agree with sl_factor_refactor up to rounding; the others keep their bits. An
 *  up-looking factor is computed completely.
 *
 *  F        [in,out]  the factor. By entries with A also a failed one, which is refactored. After
 *                     an error by entries: as with sl_factor_rank_update, or with A as with
 *                     sl_factor_refactor. By columns: unchanged after SL_ERR_ARGUMENT, _MALFORMED,
 *                     _OTHER_PATTERN, _READ_ONLY and _MEMORY, else without numbers.
 *  A        [in]      the changed matrix, in the analyzed pattern; by entries it may be NULL.
 *                     Rank-one changes compare its size only.
 *  rows     [in]      count rows of entries (i, j) of either triangle, each pair i != j once for
 *                     both sides; repeated ones add up. L has an entry there. NULL: by columns.
 *  columns  [in]      count columns of the entries; or of A, in which A stores changed entries.
 *  deltas   [in]      count changes; NULL with rows.
 *  stats    [out]     change, factor.
 *  Returns  as sl_factor_refactor and sl_factor_rank_update; SL_ERR_ARGUMENT: also an index out of
 *           range, at error.row and error.column, by columns at error.row; SL_ERR_STALE: by columns
 *           also a failed factor.
 *  Cost     that of the way, and at most a few percent of a refactorization to count flops; nothing
 *           of O(n) or O(nnz) for rank-one changes, but for one look at L where pivots have both
 *           signs and the largest |a| may have fallen to a sixteenth. By columns the fronts
 *           reached, and the update matrices of the subtrees below them, from L: about 25 % of a
 *           factorization for one vertex of a 2D mesh, and temporary memory for such a matrix.
 *  Threads  exclusive use of F; uses the workers of F where columns are computed.
 *  Source   the subtrees: left-looking supernodal factorization [NP93].
 *  Manual   tools/docs/changes.md
 *  Example  tests/core/test_change_choice.c, tests/core/test_change_columns.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_change_entries(sl_factor *F, const sl_csc *A,
                                                         const sl_int *rows, const sl_int *columns,
                                                         const double *deltas, sl_int count,
                                                         sl_work *W, sl_stats *stats);

#endif
