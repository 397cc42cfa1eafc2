/* cg.h: conjugate gradients with Jacobi preconditioning, for comparison with local solves */
#ifndef TOOLS_CG_H
#define TOOLS_CG_H

#include "sparse_local.h"

/** Solves A x = b from x = 0 until ||b - A x|| <= tolerance ||b||.
 *
 *  A          [in]   n x n, positive (semi-)definite, both triangles stored.
 *  x          [out]  n.
 *  b          [in]   n, in the range of A.
 *  tolerance  [in]   relative residual in the 2-norm.
 *  limit      [in]   the maximum number of iterations.
 *  work       [out]  scratch, 4 n doubles.
 *  Returns  the number of iterations; equals limit if the tolerance may not have been reached, also
 *           if rounding errors ended the iteration earlier.
 */
int cg_jacobi(const sl_csc *A, double *x, const double *b, double tolerance, int limit,
              double *work);

#endif
