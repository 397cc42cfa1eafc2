/* arap.h: as-rigid-as-possible layouts of a disk: turns of the faces, then one Poisson problem, in turn */
#ifndef TOOLS_ARAP_H
#define TOOLS_ARAP_H

#include "disk.h"
#include "patch_solver.h"

/* The energy of a layout u, x the corners of a face laid flat, w the weights of its edges, R a turn for each face:
 *
 *  E(u, R) = 1/2 sum over faces, sum over edges (i, j)  w |(u_i - u_j) - R (x_i - x_j)|^2
 *
 * The local step finds the best R of each face for u, in closed form; the global step the best u for all R: N u = b(R)
 * with N the Laplacian of the disk's faces, the same matrix each time [LZXGG08]. Neither raises E.
 *
 * N is not the mesh's L: with L alone a layout at rest would not stay so, for beyond the rim L asks for no stretch at
 * all. On L's factor the global step is therefore a correction: u := u + e, N e = b(R) - N u, by a few local solves
 * (patch_solver_part). One is enough for E never to rise: L^-1, restricted to the disk, is the inverse of N plus
 * something semi-definite, so that u + L^-1 (b - N u) is the minimum of a bound on E that touches E at u. Rest is then
 * where N u = b(R), as it must be.
 *
 *  [LZXGG08]  Liu, Zhang, Xu, Gotsman, Gortler: A local/global approach to mesh parameterization, 2008.
 */
typedef struct arap {
    const part *p;   /* borrowed */
    double *corners; /* 6 n_faces: x y of the corners laid flat */
    double *weights; /* 3 n_faces */
    double *turns;   /* 2 n_faces: cosine and sine of each face's R */
    double *rhs;     /* 2 n: b(R), and then the residual */
    double *change;  /* 2 n */
} arap;

/** Prepares the faces.
 *
 *  out  [out]  release with arap_free; all zero on error.
 *  Returns  true; false: out of memory.
 */
bool arap_create(arap *out, const part *p);

void arap_free(arap *a);

/** The local step: the best turns for the layout X (n x 2, column-major). Returns E, divided by half the area. */
double arap_turn(arap *a, const double *X);

/** The global step on the factor of the whole mesh, by so many local solves (1 or more).
 *
 *  X  [in,out]  n x 2, column-major.
 */
sl_status arap_move(arap *a, double *X, patch_solver *s, int solves);

/** The global step on a factor of N itself (SL_SEMIDEFINITE): exact. W may be NULL. */
sl_status arap_move_own(arap *a, double *X, const sl_factor *F, sl_work *W);

#endif
