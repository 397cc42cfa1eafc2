/* layout.h: planar layouts of a surface: faces at rest, their maps, systems */
#ifndef TOOLS_LAYOUT_H
#define TOOLS_LAYOUT_H

#include <stdbool.h>

#include "tools/mesh/mesh.h"

/* A layout uv has 2 n_vertices numbers, u v of each vertex; row 2 v + c of a system belongs to
 * coordinate c of vertex v. On a face a layout is linear, with the Jacobian J = sum of uv_k grad_k'
 * over its corners.
 *
 * The systems of all methods have one pattern. The 2 x 2 block of corners i and j of a face is
 *
 *  area (grad_i . grad_j) P + s turn K,   K = [0 -1; 1 0],  s = 1 if j follows i, -1 if it precedes
 *
 * with a symmetric P for each face: the Hessian of area tr(J' P J) / 2 - 2 turn area det J.
 */
typedef struct layout {
    const mesh *m; /* borrowed */
    double *grad;  /* 6 n_faces: gradient of the hat function of each corner, in the plane of the
                      face at rest */
    double *area;  /* n_faces: at rest */
    double whole;  /* their sum */
    sl_int raised; /* faces thinner than LAYOUT_THINNEST, which are taken to be that thick */
    unsigned char *fixed; /* n_vertices: 1 for those that systems do not move */
    /* the system, lower triangle */
    sl_int *Ap, *Ai;
    double *Ax;
    sl_int *at; /* 21 n_faces: where the entries of a face are in Ax */
    sl_symbolic *S;
    sl_factor *F;
    sl_work *work;
    sl_stats stats; /* of the last factorization that failed */
} layout;

/* The least height of a face at rest, divided by its longest edge. */
#define LAYOUT_THINNEST 1e-4

/** Measures the faces and prepares the systems; no vertex is fixed.
 *
 *  out  [out]  release with layout_free; all zero on error.
 *  m    [in]   borrowed, must outlive out.
 *  Returns  SL_OK; SL_ERR_MEMORY; SL_ERR_TOO_LARGE.
 */
sl_status layout_create(layout *out, const mesh *m);

/** Releases everything and sets l to all zero. */
void layout_free(layout *l);

/** The Jacobian of a face, row-major; returns its determinant, negative if the face is flipped. */
double layout_jacobian(double J[4], const layout *l, const double *uv, sl_int f);

/** Adds a force at each corner of a face: g(corner k) += G grad_k with a 2 x 2 matrix G, row-major.
 */
void layout_scatter(double *g, const layout *l, const double G[4], sl_int f);

/** Assembles the system.
 *
 *  P     [in]  3 n_faces: P(0,0), P(1,0), P(1,1) of each face; NULL: the identity.
 *  turn  [in]  0.5 for conformal energies, else 0.
 */
void layout_assemble(layout *l, const double *P, double turn);

/** The same for a quadratic form of the maps of faces.
 *
 *  H  [in]  16 n_faces: for each face a symmetric 4 x 4 matrix, which the entries of J, by rows,
 *           have on both sides.
 */
void layout_assemble_hessian(layout *l, const double *H);

/** Adds a number to the two diagonal entries of a vertex. */
void layout_add_diagonal(layout *l, sl_int vertex, double x);

/** y = A x of the assembled system. */
sl_status layout_multiply(const layout *l, double *y, const double *x);

/** Replaces the rows of fixed vertices by those of the identity and factors: with an analysis the
 *  first time, by sl_factor_refactor afterwards. Returns as sl_factor_create. */
sl_status layout_factor(layout *l);

/** x := A^-1 x with the factor; 0 for fixed vertices. */
sl_status layout_solve(const layout *l, double *x);

/** One step of Newton's method for the quadratic energy of the assembled system, which reaches the
 *  minimum: uv -= A^-1 A uv. Factors the system. */
sl_status layout_minimize(layout *l, double *uv);

/** The sum of the areas of the faces in the plane, flipped ones negative. */
double layout_flat_area(const layout *l, const double *uv);

/** The number of faces that are flipped or have no area in the plane. */
sl_int layout_flipped(const layout *l, const double *uv);

/** Moves the mean of the vertices to the origin, and scales to the area at rest if the area in the
 *  plane is above 0. */
void layout_normalize(const layout *l, double *uv);

#endif
