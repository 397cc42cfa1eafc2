/* conformal.h: spectral-conformal layouts of a disk: an eigenvector of its conformal energy, by inverse iteration */
#ifndef TOOLS_CONFORMAL_H
#define TOOLS_CONFORMAL_H

#include "disk.h"
#include "patch_solver.h"

/* The conformal energy of a layout is its Dirichlet energy less its area: 1/2 u' C u, C = N - (what eq. (3) of [HDA17]
 * says of u's own boundary), 0 where all angles are kept, else positive. C is 2n x 2n: the area ties the first
 * coordinate of a boundary vertex to the second of its neighbours.
 *
 * Spectral [MTAD08]: of all layouts with sum over the boundary of |u|^2 = 1 and sum of u = 0 the one of least energy:
 * the eigenvector of C u = lambda B u, B = 1 at the boundary's entries, behind the constants. Inverse iteration with
 * a small shift needs C's own factor. The factor of the mesh's L cannot take its place: C is nearly 0 on everything
 * that keeps angles (all analytic functions), where L is not, and the corrections that serve for N in patch_solver.h
 * would take as many steps as the boundary has vertices. So the disk is factored itself, once.
 *
 * On the mesh's factor goes another thing: u := u - L^-1 C u, a descent of the energy, takes away what u has of the
 * other kind (what reverses orientation) by the factor of about (part - rest)/2 each time, and leaves analytic
 * functions nearly as they are: from the harmonic map to a conformal layout near it in a few local solves.
 *
 *  [MTAD08]  Mullen, Tong, Alliez, Desbrun: Spectral conformal parameterization, 2008.
 */

/** Y = C X; X and Y n x 2, column-major. */
sl_status conformal_apply(const patch_solver *s, const disk *d, double *Y, const double *X);

/** One step of the descent, on the factor of the mesh: X -= t L^-1 C X, with the t along it that is best.
 *
 *  X      [in,out]  n x 2, column-major.
 *  work   [out]     8 n doubles.
 */
sl_status conformal_descend(patch_solver *s, const disk *d, double *X, double *work);

/** The inverse iteration: C + shift B, factored. */
typedef struct conformal {
    const disk *d; /* borrowed */
    sl_symbolic *S;
    sl_factor *F;
    sl_work *work;
    double *y; /* 2 n */
    double shift;
} conformal;

/** Factors.
 *
 *  out  [out]  release with conformal_free; all zero on error.
 *  N    [in]   lower triangle of the Laplacian of d's faces.
 *  Returns  SL_OK; SL_ERR_MEMORY, SL_ERR_TOO_LARGE; SL_ERR_PIVOT: a vertex that no weight holds.
 */
sl_status conformal_create(conformal *out, const disk *d, const sl_matrix *N);

void conformal_free(conformal *c);

/** One inverse iteration: X := (C + shift B)^-1 B X, without its mean over the boundary, scaled to a sum of |u|^2 of 1
 *  over the boundary.
 *
 *  X       [in,out]  n x 2, column-major; not constant on the boundary.
 *  lambda  [out]     the estimate of the eigenvalue that the step gives.
 *  Returns  SL_OK; SL_ERR_NOT_FINITE: X was constant on the boundary; as sl_factor_solve.
 */
sl_status conformal_iterate(conformal *c, double *X, double *lambda);

#endif
