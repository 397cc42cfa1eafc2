/* laplacian.h: Laplacians and masses of a triangle mesh, and the systems M + t L made of them */
#ifndef TOOLS_LAPLACIAN_H
#define TOOLS_LAPLACIAN_H

#include <stdbool.h>

#include "mesh.h"

/* Sign: positive semi-definite, so the diagonal is positive: L(i,i) = sum of the weights of the edges at i, and
 * L(i,j) = -weight. Every matrix here holds its lower triangle only: an entry for each edge of each face, also where
 * its value is 0, and for each diagonal. The pattern thus depends on the faces alone: matrices of one mesh with other
 * t, other weights or moved vertices share one analysis.
 *
 * Faces that cannot be measured: a face with a repeated vertex, of zero area, or flatter than 1.5e-8 (twice its area
 * against its longest edge squared: an angle of about a millionth of a degree) has no usable cotangents: below that
 * the rounding of the coordinates decides their sign and the face's own 3 x 3 matrix may stop being semi-definite.
 * Its weights are 0. A face whose area is not finite (or above 1e290) has weights 0 and area 0. All other cotangents
 * are at most 1e8 in size, so no NaN or infinity can arise from any input.
 */

/** What one face gives: its area, and the weight of the edge opposite to each corner (half a cotangent).
 *
 *  With f linear on the face, f0 f1 f2 at its corners: area |grad f|^2 = sum over k of weight[k] (f(k+1) - f(k+2))^2.
 */
typedef struct laplacian_face {
    double area;
    double weight[3];
} laplacian_face;

/** Measures the face of these three corners, each in 0..n_vertices-1. */
laplacian_face laplacian_of_face(const mesh *m, const sl_int *face);

/** Lower triangle of the cotangent Laplacian: the weight of an edge is half the sum of the cotangents opposite to it.
 *
 *  Summed over all faces of the edge: one at the boundary, three or more where the mesh is not manifold. Each face
 *  adds a semi-definite matrix, hence the whole is semi-definite; single weights may be negative (obtuse angles).
 *
 *  out  [out]  n_vertices x n_vertices, release with sl_matrix_free; NULL on error.
 *  Returns  true; false: out of memory, or a face index out of range.
 */
bool laplacian_cotangent(sl_matrix **out, const mesh *m);

/** Lower triangle of the graph Laplacian plus shift I: weight 1 for each edge, however many faces share it. */
bool laplacian_uniform(sl_matrix **out, const mesh *m, double shift);

/** Lumped (barycentric) mass: mass[i] = a third of the area of the faces around vertex i.
 *
 *  A vertex with no area around it (no face uses it, or only faces without area do) gets 1 instead of 0, so that the
 *  mass, and with it M + t L, stays definite; such a vertex takes no part in the mesh, its solution is b / 1.
 *
 *  mass  [out]  n_vertices.
 */
void laplacian_mass(double *mass, const mesh *m);

/** Lower triangle of M + t L, L the cotangent Laplacian and M the diagonal matrix of laplacian_mass.
 *
 *  t  [in]  0..1e200; the usual heat step is the square of mesh_mean_edge_length.
 *  Returns  true; false: as laplacian_cotangent, or t out of range or NaN.
 */
bool laplacian_system(sl_matrix **out, const mesh *m, double t);

/** Mean length of the edges, each counted once; 0 for a mesh without edges and when out of memory. */
double mesh_mean_edge_length(const mesh *m);

#endif
