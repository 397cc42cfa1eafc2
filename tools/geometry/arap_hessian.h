/* arap_hessian.h: the Hessian of as-rigid-as-possible deformations, with rotations that follow */
#ifndef TOOLS_ARAP_HESSIAN_H
#define TOOLS_ARAP_HESSIAN_H

#include "arap_surface.h"

/* The Hessian of half the energy E(y, R) of arap_surface.h in the positions y and in small
 * rotations w of each vertex, R := exp(w) R, at the best R. Its rows are those of one vertex
 * after the other: three of the position, three of the rotation. The matrix of the global step
 * is its part for the positions: with fixed rotations a surface is far stiffer than against
 * bending, so that steps with that matrix alone are short.
 *
 * Where the surface is compressed the Hessian may be indefinite. With softness 1 the edges count
 * as long as at rest, which is the matrix of Gauss and Newton: it is semi-definite. */
typedef struct arap_hessian {
    const arap_surface *a; /* borrowed */
    sl_matrix *pattern;
    double *values;
    sl_int *at;    /* where the entries of a face are in values */
    sl_int *fixed; /* n_fixed rows that do not move */
    sl_int n_fixed;
    sl_fixed *factor;
    sl_work *work;
    double *x;   /* 6 n */
    double soft; /* 0: the Hessian; 1: that of Gauss and Newton; between them a mean */
} arap_hessian;

/** Prepares the matrix; it has no numbers yet.
 *
 *  out       [out]  release with arap_hessian_free; all zero on error.
 *  a         [in]   borrowed, must outlive out.
 *  is_fixed  [in]   n_vertices: 1 if the position does not move, 2 if the rotation does not either
 *  Returns  SL_OK; SL_ERR_MEMORY; SL_ERR_TOO_LARGE.
 */
sl_status arap_hessian_create(arap_hessian *out, const arap_surface *a,
                              const unsigned char *is_fixed);

/** Releases everything and sets h to all zero. */
void arap_hessian_free(arap_hessian *h);

/** Computes and factors the matrix for positions Y (n_vertices x 3, column-major) and the rotations
 *  of arap_surface_rotations there. If it is indefinite, h->soft becomes 1. Returns as
 *  sl_fixed_create. */
sl_status arap_hessian_factor(arap_hessian *h, const double *Y);

/** The positions of the solution X of H x = b, with b = 0 for rotations.
 *
 *  X  [in,out]  n_vertices x 3, column-major: in, the values of positions that are fixed.
 *  B  [in]      n_vertices x 3; NULL: 0.
 *  Returns  as sl_fixed_solve.
 */
sl_status arap_hessian_solve(arap_hessian *h, double *X, const double *B);

#endif
