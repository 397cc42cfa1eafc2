/* constraints.h: rows held at given values, on top of a factor that stays as it is */
#ifndef SL_PUBLIC_CONSTRAINTS_H
#define SL_PUBLIC_CONSTRAINTS_H

#include "options.h"
#include "stats.h"

/** Creates an empty set of pins: rows, or linear combinations of rows, that solves hold at given
 *  values. For definite A this minimizes x' A x / 2 - b' x under these equalities. The factor does
 *  not change: a pin is one forward sweep, and solves take one forward and one backward sweep. For
 *  hundreds of rows that are held together, sl_factor_submatrix or sl_fixed_create is faster.
 *
 *  Singular matrices: with SL_PIVOTS_SKIP_NULL and known null vectors (sl_factor_create), one pin
 *  makes a component with one of them regular, if it is not 0 there; an elastic body in 3D needs
 *  pins that leave none of its 6 motions. If the pins of a component leave motions, b must be in
 *  balance with them, and x = 0 in null rows fixes them. Components without pins are solved as by
 *  sl_factor_solve.
 *
 *  Accuracy: the capacitance matrix corrects the solution without pins. Where that is 10^d times as
 *  large as the one with pins, as with a weak mass term, d digits are lost. Solves check C' x = g,
 *  local ones where all rows of an equality are in their reach (SL_ERR_INACCURATE).
 *
 *  out  [out]  the set.
 *  F    [in]   the factor; kept by the object. When F changes, solves are refused until
 *              sl_constraints_refactor.
 *  opt  [in]   allocator.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_UNSUPPORTED: pivots of both signs, 2x2
 *           pivots, or regularized ones; SL_ERR_MEMORY; SL_ERR_TOO_LARGE.
 *  Cost     O(1); with SL_PIVOTS_SKIP_NULL 8 bytes per row.
 *  Source   capacitance matrix of a change of low rank, as in [Hager89].
 *  Example  tests/core/test_constraints.c
 */
SL_API SL_WARN_UNUSED sl_status sl_constraints_create(sl_constraints **out, const sl_factor *F,
                                                      const sl_options *opt);

/** Releases a set of pins. */
SL_API void sl_constraints_free(sl_constraints *P);

/** Adds pins, all or none: x is held in each of these rows of A. They become the last ones of P, in
 *  the order of rows. With values, adds one equality: the sum of values[k] x(rows[k]) is held.
 *
 *  rows    [in]   count >= 0 rows in 0..n-1.
 *  values  [in]   NULL: pins. Else count >= 1 weights of an equality, copied as its rows are; a row
 *                 given twice counts with the sum.
 *  stats   [out]  constraints; error.row.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_PIVOT: a row is held already, by its pin or by a
 *           combination of the others, up to rounding; SL_ERR_STALE: F has changed;
 *           SL_ERR_UNSUPPORTED: null vectors in the row's tree of the factor are not known
 *           (error.row); SL_ERR_NOT_FINITE: a value (error.row), or numbers of F overflow in the
 *           solution of a row; SL_ERR_MEMORY; SL_ERR_TOO_LARGE. On error P is as before.
 *  Cost     for each pin, a forward sweep, which up to 8 nearby rows share, k products over shared
 *           columns and O(k^2), with k pins before it; keeps 16 bytes per column of the path, and 4
 *           per row below its supernodes. 100 pins together take half as long as one by one.
 *  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_constraints_add(sl_constraints *P, const sl_int *rows,
                                                   const double *values, sl_int count,
                                                   sl_stats *stats);

/** Releases pins, all or none. The others move together and keep their order.
 *
 *  indices  [in]   count >= 0 different numbers of pins, 0-based, in any order.
 *  stats    [out]  constraints, of which count is the number that is left.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MEMORY; SL_ERR_TOO_LARGE. On error P is as before.
 *  Cost     O(k^2) for each.
 *  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_constraints_release(sl_constraints *P, const sl_int *indices,
                                                       sl_int count, sl_stats *stats);

/** Takes the present numbers of the factor, after it has changed.
 *
 *  stats  [out]  constraints; error.row.
 *  Returns  as sl_constraints_add; SL_ERR_STALE: failed factor. On error solves are refused until a
 *           later call succeeds.
 *  Cost     that of sl_constraints_add for all pins.
 *  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_constraints_refactor(sl_constraints *P, sl_stats *stats);

/** Solves A x = b + C f with C' x = g, where the columns of C are the equalities: for pins, x is
 *  exactly g in their rows, and A x = b in all others.
 *
 *  plan   [in]   a local solve of the rows that the plan names; NULL: a full one. b is 0 outside of
 *                the b-set, the pins are not: they need not be in either set. A plan in a region is
 *                not supported.
 *  X      [out]  nx x nrhs (full: n x nrhs), leading dimension ldx. May be B itself (then ldx =
 *                ldb). Errors but SL_ERR_INCONSISTENT, _NOT_FINITE, _INACCURATE leave it untouched.
 *  B      [in]   nb x nrhs (full: n x nrhs), leading dimension ldb; not used in rows that are pins.
 *  G      [in]   k x nrhs, leading dimension ldg: the values, in the order of the pins.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE: F has changed; SL_ERR_MISMATCH: the plan is of
 *           another analysis; SL_ERR_UNSUPPORTED: a plan in a region; SL_ERR_INACCURATE: C' x = g
 *           does not hold to 1e-8 of x or, where g is 0, of b / max |a|, or rounding hides whether
 *           pins rule out the motions of a body; SL_ERR_INCONSISTENT: b is out of balance with a
 *           motion that the pins leave; SL_ERR_NOT_FINITE: a number of B or G is not, or X
 *           overflows; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     for each right-hand side a solve, k products over shared columns, twice, and O(k^2);
 *           as much for each null vector of components with pins.
 *  Threads  any number at once on one P, each with its own W.
 */
SL_API SL_WARN_UNUSED sl_status sl_constraints_solve(const sl_constraints *P, const sl_plan *plan,
                                                     double *X, size_t ldx, const double *B,
                                                     size_t ldb, const double *G, size_t ldg,
                                                     sl_int nrhs, sl_work *W);

#endif
