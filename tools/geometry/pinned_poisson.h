/* pinned_poisson.h: Poisson problems on a patch with the solution 0 at some vertices */
#ifndef TOOLS_PINNED_POISSON_H
#define TOOLS_PINNED_POISSON_H

#include "sparse_local.h"

/** Solves N x = b in the rows of all other vertices, with x = 0 at the pins.
 *
 *  Without pins, N x = b determines x up to a constant, which one source fixes: distances at the
 *  others are then what they happen to be. With pins all are 0.
 *
 *  N     [in]   lower triangle of the Laplacian, n x n.
 *  x     [out]  n; NaN in rows that no entry of N connects to a pin. May be b.
 *  b     [in]   n.
 *  pins  [in]   count rows.
 *  Returns  SL_OK; SL_ERR_MEMORY; SL_ERR_PIVOT: N is not semidefinite up to rounding; as
 *           sl_symbolic_create and sl_factor_create.
 *  Cost     an analysis and a factorization of N.
 *  Example  tests/tools/test_geodesic.c
 */
sl_status pinned_poisson_solve(const sl_csc *N, double *x, const double *b, const sl_int *pins,
                               sl_int count);

#endif
