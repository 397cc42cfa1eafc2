/* inverse.h: entries, blocks and bilinear forms of the inverse, without a backward sweep */
#ifndef SL_PUBLIC_INVERSE_H
#define SL_PUBLIC_INVERSE_H

#include "types.h"

/* With P A P' = L D L', y = L^-1 P b and z = L^-1 P c,
 *
 *     c' A^-1 b = sum over columns k of y(k) z(k) / d(k),
 *
 * where only the common ancestors of b and c in the elimination tree count: a forward sweep for each and no backward
 * sweep. Requests are sorted inside, and near-by ones share one sweep of up to 8 lanes; results come in the caller's
 * order, and equal those of full solves to rounding. What they share depends on what else is asked for in the same call,
 * and so do the last bits.
 *
 * All calls below
 *  F      [in]      a factor of A, n x n.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  stats  [out]     b_entries: doubles of L that all sweeps of the call read together; b_supernodes, b_columns: of the
 *                   largest of their reaches; the rest of the plan group is 0. error_row, error_column: an index out
 *                   of range. May be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, a negative count, an index out of range; SL_ERR_STATE: failed factor;
 *           SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and could not. On error nothing is written.
 *  Cost     of sweeps 2 b_entries flops a lane; 8 lanes take the time of two to three, which is why many requests in one call
 *           are worth it: a lone pair of far vertices costs what a local solve from one to the other does. Nothing
 *           O(n), but for NULL sets; no allocation once W has grown to the largest reach and 16 bytes a request.
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [HDA17] 5; [Davis06] 3.2, 4.1.
 *  Example  tests/test_inverse.c
 *
 * Many entries are cheaper by selected inversion of the supernodes they reach (selected.h), of which only the fronts
 * under way are kept, and not Z. sl_inverse_diagonal and sl_inverse_pairs count the operations of both and take the shorter
 * way: selected inversion from some hundreds of near-by vertices of a mesh on, or some thousands far apart; for the
 * whole diagonal always. stats say which (inverse_method), with z_supernodes and z_columns in place of the sweeps' numbers
 * where it was that. It uses the threads that F was made with, a pool of the caller's then once for each call that runs
 * at the same time; the bits do not depend on their number. W grows to the fronts under way, 8 (height)^2 bytes each, where
 * height counts a supernode's columns and the rows below: those from the one at hand to its root that have children to
 * come; with several threads, for each of them, and the roots of the subtrees that are shared out, a few dozen.
 *
 * A factor with null pivots that were skipped (SL_SEMIDEFINITE) has the inverse of the matrix without their rows and
 * columns, and 0 in those: A Z A = A where A has no more null vectors than that.
 */

/** Diagonal entries of the inverse: out[k] = (A^-1)(rows[k], rows[k]).
 *
 *  out    [out]  count values.
 *  rows   [in]   count rows of A in 0..n-1, any order, repeated or not; NULL (with count ignored): all n.
 *  Source   [HDA17] 5; [ET75], [SelInv].
 *  Example  tests/test_diagonal.c
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_diagonal(const sl_factor *F, double *out,
                                                    const sl_int *rows, sl_int count, sl_work *W,
                                                    sl_stats *stats);

/** Entries of the inverse: out[k] = (A^-1)(rows[k], columns[k]).
 *
 *  out    [out]  count values.
 *  rows, columns  [in]  count rows of A each, in 0..n-1, any order, repeated or not. Selected inversion comes in
 *                 question only where all entries have a place in the pattern of L, as those of A have.
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_pairs(const sl_factor *F, double *out,
                                                 const sl_int *rows, const sl_int *columns,
                                                 sl_int count, sl_work *W, sl_stats *stats);

/** A dense block of the inverse: Z(i, j) = (A^-1)(rows[i], columns[j]).
 *
 *  Z        [out]  n_rows x n_columns, column-major, leading dimension ldz >= n_rows elements.
 *  rows     [in]   n_rows rows of A in 0..n-1, any order, repeated or not.
 *  columns  [in]   n_columns, the same. Where it is the same array as rows, of the same length, each sweep and each
 *                  entry is computed once and the block is exactly symmetric.
 *  Cost     beyond the sweeps n_rows n_columns times the common columns; W holds 128 vectors of the shorter side at
 *           a time, and the longer side is swept again for each further 128 (not where both are one array).
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                                                 const sl_int *rows, sl_int n_rows,
                                                 const sl_int *columns, sl_int n_columns,
                                                 sl_work *W, sl_stats *stats);

/** A bilinear form of the inverse: out = c' A^-1 b for sparse b and c.
 *
 *  out   [out]  one value.
 *  cset  [in]   nc rows of A in 0..n-1, any order, those given twice summed; NULL (with nc ignored): all n. c is 0
 *               elsewhere.
 *  c     [in]   nc values.
 *  bset  [in]   nb rows of A, the same.
 *  b     [in]   nb values. Where both sets and both values are the same arrays, b' A^-1 b takes half the operations.
 *               An index out of range is error_row in cset, error_column in bset.
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_bilinear(const sl_factor *F, double *out,
                                                    const sl_int *cset, const double *c, sl_int nc,
                                                    const sl_int *bset, const double *b, sl_int nb,
                                                    sl_work *W, sl_stats *stats);

#endif
