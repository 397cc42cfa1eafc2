/* arap.h: as-rigid-as-possible layouts of a disk: alternating face rotations and Poisson solves */
#ifndef TOOLS_ARAP_H
#define TOOLS_ARAP_H

#include "tools/mesh/disk_patch.h"
#include "patch_solver.h"

/* The energy of a layout u, where x are the corners of a face in its own plane, w the cotangent
 * weights of its edges and R a rotation of the face:
 *
 *  E(u, R) = 1/2 sum over faces, sum over edges (i, j)  w |(u_i - u_j) - R (x_i - x_j)|^2
 *
 * The local step finds the best R of each face for fixed u, in closed form. The global step finds
 * the best u for fixed R: N u = b(R), with N the Laplacian of the patch's own faces, the same
 * matrix in each iteration [LZXGG08]. Neither step increases E.
 *
 * N is not a part of the whole mesh's Laplacian L. Solving with L instead would move even a layout
 * that is already optimal, because L also penalizes any stretch of the mesh beyond it. With
 * the factor of L, the global step is therefore a correction: u := u + e, N e = b(R) - N u, by a
 * few local solves (patch_solver_solve_patch). A single solve already guarantees that E does not
 * increase: L^-1, restricted to the patch, is (N + G)^-1 with a semi-definite G. Hence
 * u + L^-1 (b - N u) minimizes an upper bound of E that equals E at u. The fixed points satisfy
 * N u = b(R), as required.
 *
 *  [LZXGG08]  Liu, Zhang, Xu, Gotsman, Gortler: A local/global approach to mesh parameterization,
 *             2008.
 */
typedef struct arap {
    const submesh *p;   /* borrowed */
    double *corners;    /* 6 n_faces: x y of each corner in the plane of its face */
    double *weights;    /* 3 n_faces: weight of the edge opposite to each corner */
    double *rotations;  /* 2 n_faces: cosine and sine of each R */
    double *rhs;        /* 2 n: b(R), then the residual */
    double *correction; /* 2 n: e */
} arap;

/** Measures the faces of a patch.
 *
 *  out  [out]  release with arap_free; all zero on error.
 *  p    [in]   borrowed, must outlive out; n = p->m.n_vertices below.
 *  Returns  true; false: out of memory.
 */
bool arap_create(arap *out, const submesh *p);

/** Releases the arrays and sets a to all zero. */
void arap_free(arap *a);

/** The local step: computes the best rotations for the layout X (n x 2, column-major). Returns the
 *  energy E divided by half the area of the patch. */
double arap_local_step(arap *a, const double *X);

/** ||b(R) - N u|| / ||b(R)|| for the rotations of the last local step: the gradient of E at the
 *  layout X (n x 2, column-major), relative to the forces that balance there. INFINITY if it is not
 *  finite. Uses a->rhs and a->correction. */
double arap_residual(arap *a, const double *X, const patch_solver *s);

/** The global step, on the factor of the whole mesh.
 *
 *  X       [in,out]  n x 2, column-major.
 *  s       [in,out]  solver of the same patch.
 *  solves  [in]      the largest number of local solves, 1 or more.
 *  Returns  as patch_solver_solve_patch.
 */
sl_status arap_global_step(arap *a, double *X, patch_solver *s, int solves);

/** Shortens a step so that it turns no face over: to 0.9 of the way on which the first face loses
 *  its area, if that is less than the whole step. For fixed rotations E is a convex quadratic
 *  function, so that a shorter step lowers it, too.
 *
 *  X     [in,out]  n x 2, column-major: the end of the step.
 *  from  [in]      n x 2: its begin. Faces that are turned over there are not looked at.
 *  Returns  the part of the step that is left, 1 if all of it.
 *  Source   Smith, Schaefer: Bijective parameterization with free boundaries, 2015.
 */
double arap_shorten_step(const arap *a, double *X, const double *from);

/** The global step, exactly, on a factor of N itself (made with SL_PIVOTS_SKIP_NULL).
 *
 *  X  [out]  n x 2, column-major.
 *  W  [in]   workspace; may be NULL.
 *  Returns  as sl_factor_solve.
 */
sl_status arap_global_step_exact(arap *a, double *X, const sl_factor *F, sl_work *W);

#endif
