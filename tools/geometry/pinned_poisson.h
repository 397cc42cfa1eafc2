/* pinned_poisson.h: Poisson problems on a patch with the solution 0 at some vertices */
#ifndef TOOLS_PINNED_POISSON_H
#define TOOLS_PINNED_POISSON_H

#include "sparse_local.h"

/** N x = b in the rows of all other vertices, with x = 0 at the pins.
 *
 *  Without pins, N x = b determines x up to a constant, which one source fixes: distances at the
 *  others are then what they happen to be. With pins all are 0. */
typedef struct pinned_poisson {
    sl_symbolic *S;
    sl_factor *F;
    sl_int n, n_rows;
    sl_int *number; /* n: the row of F */
    double *y;      /* n_rows */
} pinned_poisson;

/** Analyzes and factors.
 *
 *  out   [out]  release with pinned_poisson_free; all zero on error.
 *  N     [in]   lower triangle of the Laplacian, n x n.
 *  pins  [in]   count rows.
 *  Returns  SL_OK; SL_ERR_MEMORY; SL_ERR_PIVOT: N is not semidefinite up to rounding; as
 *           sl_symbolic_create and sl_factor_create.
 *  Example  tests/tools/test_geodesic.c
 */
sl_status pinned_poisson_create(pinned_poisson *out, const sl_csc *N, const sl_int *pins,
                                sl_int count);

/** Solves.
 *
 *  x  [out]  n; NaN in rows that no entry of N connects to a pin. May be b.
 *  b  [in]   n.
 *  Returns  SL_OK; as sl_factor_solve.
 */
sl_status pinned_poisson_solve(pinned_poisson *p, double *x, const double *b);

/** Releases everything. */
void pinned_poisson_free(pinned_poisson *p);

#endif
