/* pseudo.h: what makes the pseudo-inverse of the entries, samples and determinant of a factor */
#ifndef SL_PUBLIC_PSEUDO_H
#define SL_PUBLIC_PSEUDO_H

#include "solve.h"

/** The null space of A, as sl_factor_pseudo_inverse computes it. The caller provides the arrays. */
typedef struct sl_pseudo_inverse {
    sl_int columns;    /* of Q and K: before, how many there is room for; after, how many there are,
                        * the most null vectors of a component */
    sl_int *component; /* n: the same number for rows of one component; -1: it is regular */
    double *Q;         /* n x columns, column-major, leading dimension n */
    double *K;         /* likewise */
    double log_det;    /* of the pseudo-determinant, less that of sl_factor_logdet */
} sl_pseudo_inverse;

/** EXPERIMENTAL. Null vectors of A, and what makes the pseudo-inverse of entries of the inverse.
 *
 *  If null pivots were skipped, those entries are of G, the inverse of A without the null rows, and
 *  depend on which rows these are. With an orthonormal basis Q of the null space of each component
 *  and K = G Q - Q Q' G Q / 2
 *
 *      (A^+)_ij = G_ij - sum over c of Q_ic K_jc + K_ic Q_jc    for i, j of the same component,
 *      samples:   x - Q Q' x, for x of sl_factor_solve_part with SL_PART_SQRT_D,
 *      log pdet:  sl_factor_logdet + log_det.
 *
 *  A statistician's marginal variances under a sum-to-zero constraint are the diagonal of A^+.
 *  Components joined by entries that are 0 count as one, with all of their null vectors. Rows of Q
 *  and K are 0 in regular components; so are columns where a component has fewer null vectors.
 *
 *  F      [in]      a factor of A, n x n.
 *  P      [in,out]  component, Q and K NULL: only columns is written. On error columns may be.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, or too few columns; SL_ERR_STALE; SL_ERR_UNSUPPORTED:
 *           2x2 pivots; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     a full solve for each column, half a solve more where null vectors are not known, and
 *           O(n columns^2).
 *  Threads  any number at once on one F, each with its own W.
 *  Manual   tools/docs/singular.md
 *  Example  tests/core/test_pseudo.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_pseudo_inverse(const sl_factor *F, sl_pseudo_inverse *P,
                                                         sl_work *W);

#endif
