/* conformal.h: conformal layouts of a disk: spectral by inverse iteration, or by local descent */
#ifndef TOOLS_CONFORMAL_H
#define TOOLS_CONFORMAL_H

#include "tools/mesh/disk_patch.h"
#include "patch_solver.h"

/* The conformal energy of a layout is its Dirichlet energy minus its area: 1/2 u' C u, where C is N
 * (the Laplacian of the patch's own faces, once for each coordinate) minus the boundary terms of
 * eq. (3) in [HDA17]. It is 0 if all angles are preserved and positive otherwise. C is 2n x 2n,
 * because the area couples the first coordinate of a boundary vertex to the second one of its
 * neighbors. A face without weights (laplacian.h) is left out of both: with its area alone the
 * energy would be indefinite. The sum over the other faces is semi-definite face by face.
 *
 * The spectral layout [MTAD08] has the least energy among all layouts with sum of |u|^2 = 1 and sum
 * of u = 0 over the boundary: it is the eigenvector of C u = lambda B u with the smallest
 * eigenvalue after those of the constants; B is 1 on the boundary, 0 elsewhere. Inverse iteration
 * with a small shift needs a factor of C itself. The factor of the mesh's L cannot replace it: C
 * almost vanishes on everything that preserves angles (all analytic functions), where L does not,
 * so that the corrections of patch_solver.h would need as many steps as the boundary has vertices.
 * The patch is therefore factored once.
 *
 * What the mesh's factor can do is a descent of the energy: u := u - L^-1 C u. On functions that
 * reverse orientation C is 2 N, so each step multiplies that part of u by about (R - N)/(R + N),
 * where N and R are the stiffnesses of the patch and of the rest of the mesh at the interface,
 * which are similar. Analytic functions are almost preserved. A few local solves thus turn the
 * harmonic map into a nearby conformal layout.
 *
 *  [HDA17]  Herholz, Davis, Alexa: Localized solutions of sparse linear systems for geometry
 *           processing, 2017.
 *  [MTAD08]  Mullen, Tong, Alliez, Desbrun: Spectral conformal parameterization, 2008.
 */

/** Y = C X.
 *
 *  s     [in]   solver of the patch d->p.
 *  Y, X  n x 2, column-major, not the same array; n = d->p.m.n_vertices.
 *  Returns  as patch_solver_apply.
 */
sl_status conformal_apply(const patch_solver *s, const disk_patch *d, double *Y, const double *X);

/** One step of the descent, by one local solve on the factor of the mesh: X -= t L^-1 C X with the
 *  t that minimizes the energy along this direction.
 *
 *  X     [in,out]  n x 2, column-major.
 *  work  [out]     scratch, 8 n doubles.
 *  Returns  as patch_solver_solve_mesh.
 */
sl_status conformal_descent_step(patch_solver *s, const disk_patch *d, double *X, double *work);

/** Inverse iteration: the factor of C + shift B. */
typedef struct conformal {
    const disk_patch *d; /* borrowed */
    sl_symbolic *S;
    sl_factor *F;
    sl_work *work;
    double *y; /* 2 n, interleaved: rows 2v and 2v+1 are the coordinates of vertex v */
    double shift;
    double
        change; /* sine of the angle between the last two iterates, up to rotations in the plane */
    sl_int negative; /* negative pivots: rounding errors make the energy indefinite */
} conformal;

/** Assembles and factors C + shift B. The shift grows until no pivot is negative, up to 1e-7 of the
 *  largest entry of N.
 *
 *  out  [out]  release with conformal_free; all zero on error.
 *  d    [in]   borrowed, must outlive out.
 *  N    [in]   lower triangle of the Laplacian of d's faces.
 *  Returns  SL_OK; SL_ERR_MEMORY; SL_ERR_TOO_LARGE; SL_ERR_PIVOT: a vertex has no weights.
 */
sl_status conformal_create(conformal *out, const disk_patch *d, const sl_matrix *N);

/** Releases everything and sets c to all zero. */
void conformal_free(conformal *c);

/** ||C x - lambda B x|| / ||B x||: an eigenvalue of the pencil (C, B) is about this near to lambda.
 *
 *  s       [in]   solver of the patch d->p.
 *  X       [in]   n x 2, column-major.
 *  work    [out]  scratch, 2 n doubles.
 *  Returns  the residual; INFINITY if it is not finite.
 */
double conformal_residual(const patch_solver *s, const disk_patch *d, const double *X,
                          double lambda, double *work);

/** One inverse iteration: X := (C + shift B)^-1 B X, then subtracts the mean over the boundary and
 *  scales to a sum of |u|^2 of 1 over the boundary.
 *
 *  X       [in,out]  n x 2, column-major; not constant on the boundary.
 *  lambda  [out]     the estimate of the eigenvalue.
 *  Returns  SL_OK; SL_ERR_NOT_FINITE: X was constant on the boundary, or the result is not finite;
 *           as sl_factor_solve.
 */
sl_status conformal_iterate(conformal *c, double *X, double *lambda);

#endif
