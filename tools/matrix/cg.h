/* cg.h: conjugate gradients with Jacobi preconditioning, the iterative rival of a local solve */
#ifndef TOOLS_CG_H
#define TOOLS_CG_H

#include "../sparse_local.h"

/** Solves A x = b from x = 0 until ||b - A x|| <= tolerance ||b||, A positive (semi-)definite, b in its range.
 *
 *  A      [in]   n x n; stores both triangles, rows are gathered by columns.
 *  x      [out]  n.
 *  work   [out]  4 n doubles.
 *  Returns  the iterations, at most limit.
 */
int cg_jacobi(const sl_csc *A, double *x, const double *b, double tolerance, int limit,
              double *work);

#endif
