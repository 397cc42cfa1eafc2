/* pins.h: rows held at given values, on top of a factor that stays as it is */
#ifndef SL_PUBLIC_PINS_H
#define SL_PUBLIC_PINS_H

#include "options.h"
#include "stats.h"

/** Creates an empty set of pins: rows, or linear combinations of rows, that solves hold at given
 *  values. For definite A this minimizes x' A x / 2 - b' x under these equalities. The factor does
 *  not change: a pin is one forward sweep, and solves take one forward and one backward sweep. If
 *  the matrix is known (sl_pins_set_matrix), many pins are eliminated instead: a second factor, in
 *  which their rows are those of the identity, over the same analysis.
 *
 *  Singular matrices: with SL_NULL_PIVOT_SKIP and known null vectors (sl_factor_create), one pin
 *  makes a component with one of them regular, if it is not 0 there; an elastic body in 3D needs
 *  pins that leave none of its 6 motions. Components without pins are solved as by sl_factor_solve:
 *  with the weights of options.mass, or with x = 0 in null rows and a b in balance. Motions that
 *  the pins of a component leave need balance in any case, and x = 0 in null rows fixes them.
 *
 *  Accuracy: the capacitance matrix corrects the solution without pins. Where that solution is
 *  10^d times as large as the one with pins, as with a weak mass term, d digits are lost. Solves
 *  check C' x = g in each tree of the factor and report the loss (SL_ERR_INACCURATE). Local solves
 *  check the equalities whose rows are all in their reach.
 *
 *  out  [out]  the set, or NULL on error; release with sl_pins_free.
 *  F    [in]   the factor; it and its analysis are borrowed and must outlive the object. When F
 *              changes, solves are refused until sl_pins_refactor.
 *  opt  [in]   allocator; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_UNSUPPORTED: pivots of both
 *           signs, or 2x2 pivots; SL_ERR_MEMORY; SL_ERR_TOO_LARGE.
 *  Cost     O(1); with SL_NULL_PIVOT_SKIP 8 bytes per row.
 *  Source   capacitance matrix of a change of low rank, as in [Hager89].
 *  Example  tests/core/test_pins.c
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_create(sl_pins **out, const sl_factor *F,
                                               const sl_options *opt);

/** Releases a set of pins; NULL is allowed. */
SL_API void sl_pins_free(sl_pins *P);

/** Adds a pin: x is held at a value in one row of A. It becomes the last one of P.
 *
 *  row    [in]   in 0..n-1.
 *  stats  [out]  error.row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_PIVOT: the row is held already, by this pin or a
 *           combination of the others, up to rounding; SL_ERR_STATE: F has changed;
 *           SL_ERR_UNSUPPORTED: null vectors in the row's tree of the factor are not known
 *           (error.row); SL_ERR_MEMORY; SL_ERR_TOO_LARGE. On error P is as before.
 *  Cost     a forward sweep, k products over shared columns and O(k^2); keeps 16 bytes per column
 *           of the path, and 4 per row below its supernodes. If the matrix is known, k counts the
 *           pins since the last elimination, and once their cost exceeds that of the next one, all
 *           are eliminated. sl_pins_add_rows takes about half as long for 100 pins together.
 *  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_add(sl_pins *P, sl_int row, sl_stats *stats);

/** Adds pins, all or none, by the cheaper way. They become the last ones of P, in this order.
 *
 *  rows   [in]   count >= 0 rows.
 *  stats  [out]  pins; error.row; may be NULL.
 *  Returns, Threads  as in sl_pins_add.
 *  Cost     by the capacitance matrix as in sl_pins_add, but up to 8 nearby rows share a sweep; by
 *           elimination a copy of the factor if P has none yet, and a refactorization of the reach
 *           of the changed rows, or of all.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_add_rows(sl_pins *P, const sl_int *rows, sl_int count,
                                                 sl_stats *stats);

/** Adds an equality: the sum of values[k] x(rows[k]) is held. A pin is the case of one row and the
 *  value 1.
 *
 *  rows, values  [in]  count >= 1 entries, copied; a row given twice counts with the sum.
 *  Returns, Cost, Threads  as in sl_pins_add; SL_ERR_NOT_FINITE: a value (error.row).
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_add_equality(sl_pins *P, const sl_int *rows,
                                                     const double *values, sl_int count,
                                                     sl_stats *stats);

/** Releases pin number `index`, 0-based. Those after it move down by one.
 *
 *  Returns  as sl_pins_release_rows.
 *  Cost     O(k^2); of a pin that is eliminated as sl_pins_release_rows.
 *  Threads  exclusive use of P.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_release(sl_pins *P, sl_int index);

/** Releases pins, all or none. The others move together and keep their order.
 *
 *  indices  [in]   count >= 0 different numbers of pins, in any order.
 *  stats    [out]  pins; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MEMORY; SL_ERR_TOO_LARGE; of pins that are eliminated
 *           also SL_ERR_STATE: F has changed, and the errors of sl_pins_add. On error P is as
 *           before.
 *  Cost     O(k^2) for each. If some are eliminated, the others are eliminated anew, by the reach
 *           of the released rows, or added anew by the capacitance matrix: release them together.
 *  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_release_rows(sl_pins *P, const sl_int *indices,
                                                     sl_int count, sl_stats *stats);

/** Gives P the matrix of F, so that pins may be eliminated. After F has changed this also takes
 *  its present numbers, as sl_pins_refactor does, by the cheaper way. Both ways give the same
 *  solutions, up to rounding. With several null vectors, regularization or SL_STORAGE_COMPLEX, pins
 *  stay with the capacitance matrix (stats.pins.reason).
 *
 *  A      [in]   the matrix that F is a factor of; its values are copied. This is tested by a solve
 *                with a random right-hand side.
 *  stats  [out]  pins; error.row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also if the test fails (error.row); SL_ERR_PATTERN: not the
 *           analyzed pattern; SL_ERR_STATE: failed factor; SL_ERR_MEMORY; SL_ERR_TOO_LARGE; after F
 *           has changed also the errors of sl_pins_refactor.
 *  Cost     a solve and two products with A; 8 bytes per entry of A. Elimination keeps a second
 *           factor.
 *  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_set_matrix(sl_pins *P, const sl_csc *A, sl_stats *stats);

/** The number k of pins and equalities. */
SL_API sl_int sl_pins_count(const sl_pins *P);

/** Takes the present numbers of the factor, after it has changed. The matrix that P may have been
 *  given is forgotten, and all pins use the capacitance matrix: sl_pins_set_matrix does the same
 *  with the new matrix.
 *
 *  Returns  as sl_pins_add. On error solves are refused until a later call succeeds.
 *  Cost     k forward sweeps and O(k^3).  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_refactor(sl_pins *P);

/** Solves A x = b + C f with C' x = g, where the columns of C are the equalities: for pins, x is g
 *  in their rows, and A x = b in all others.
 *
 *  plan   [in]   a local solve of the rows that the plan names; NULL: a full one. b is 0 outside of
 *                the b-set, the pins are not: they need not be in either set. A plan in a region is
 *                not supported.
 *  X      [out]  nx x nrhs (full: n x nrhs), column-major, leading dimension ldx elements. May be B
 *                itself (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs (full: n x nrhs), column-major, leading dimension ldb elements. Its
 *                values in rows that are pins are not used.
 *  G      [in]   k x nrhs, column-major, leading dimension ldg elements: the values, in the order
 *                of the pins.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: F has changed, or the plan is of another
 *           analysis; SL_ERR_UNSUPPORTED: a plan in a region; SL_ERR_INACCURATE: C' x = g does not
 *           hold to 1e-8 of x, or rounding hides whether pins rule out the motions of a body;
 *           SL_ERR_INCONSISTENT: b is out of balance with a motion that the pins leave; with
 *           more than 8 right-hand sides X may then have those before it; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     for each right-hand side a solve and, of the pins that are not eliminated, k products
 *           over shared columns, twice, and O(k^2); as much for each null vector of components with
 *           pins. Eliminated pins: with a plan the forward sweep of their neighbors.
 *  Threads  any number at once on one P, each with its own W.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_solve(const sl_pins *P, const sl_plan *plan, double *X,
                                              size_t ldx, const double *B, size_t ldb,
                                              const double *G, size_t ldg, sl_int nrhs, sl_work *W);

#endif
