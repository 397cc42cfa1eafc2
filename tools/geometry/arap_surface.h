/* arap_surface.h: as-rigid-as-possible deformations of a surface in space: rotations and forces */
#ifndef TOOLS_ARAP_SURFACE_H
#define TOOLS_ARAP_SURFACE_H

#include <stdbool.h>

#include "tools/mesh/mesh.h"

/* The energy of positions y of a surface at rest in x, where w are the cotangent weights of the
 * edges of a face and R_v a rotation of each vertex v:
 *
 *  E(y, R) = 1/3 sum over faces, sum over its corners v, sum over its edges (i, j)
 *                w |(y_i - y_j) - R_v (x_i - x_j)|^2
 *
 * The rotation of a vertex acts on all edges of its faces, also those opposite to it. The weights
 * of a whole face form a semi-definite matrix although one of them may be negative, so E is never
 * negative, whatever the mesh.
 *
 * The local step finds the best R for fixed y, each by itself. The global step finds the best y for
 * fixed R: L y = b(R) with the cotangent Laplacian L, the same matrix in each iteration. Neither
 * step increases E.
 *
 *  Source  Sorkine, Alexa: As-rigid-as-possible surface modeling, 2007; the edges of a rotation as
 *          in Chao, Pinkall, Sanan, Schroeder: A simple geometric model for elastic deformations,
 *          2010.
 */
typedef struct arap_surface {
    const mesh *m;     /* at rest; borrowed */
    double *weights;   /* 3 n_faces: of the edge opposite to each corner */
    double *rotations; /* 9 n_vertices: R of each vertex, column-major */
} arap_surface;

/** Measures the faces; all rotations are the identity.
 *
 *  out  [out]  release with arap_surface_free; all zero on error.
 *  m    [in]   the surface at rest; borrowed, must outlive out.
 *  Returns  true; false: out of memory.
 *  Example  tests/tools/test_arap_surface.c
 */
bool arap_surface_create(arap_surface *out, const mesh *m);

/** Releases the arrays and sets a to all zero. */
void arap_surface_free(arap_surface *a);

/** The local step: computes the best rotations for positions Y (n_vertices x 3, column-major).
 *  Returns E. */
double arap_surface_rotations(arap_surface *a, const double *Y);

/** The forces b(R) of the present rotations: B is n_vertices x 3, column-major. */
void arap_surface_forces(const arap_surface *a, double *B);

#endif
