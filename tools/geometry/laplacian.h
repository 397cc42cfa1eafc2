/* laplacian.h: Laplacians and lumped masses of a triangle mesh, and the systems M + t L */
#ifndef TOOLS_LAPLACIAN_H
#define TOOLS_LAPLACIAN_H

#include <stdbool.h>

#include "tools/mesh/mesh.h"

/* Sign: L is positive semi-definite. L(i,i) is the sum of the weights of the edges at i; L(i,j) is
 * minus the weight of the edge. All matrices here store their lower triangle, with an entry for
 * each edge of each face (also if its value is 0) and for each diagonal element. The pattern thus
 * depends only on the faces: matrices of one mesh with different t, weights or vertex positions
 * share one analysis.
 *
 * Degenerate faces. A face has no usable cotangents if it has a repeated vertex, zero area, or
 * twice its area is below 1.5e-8 times the square of its longest edge (an angle of about a
 * millionth of a degree): below that, rounding of the coordinates decides the sign of the
 * cotangents, and the 3 x 3 matrix of the face may not be semi-definite. The weights of such a face
 * are 0. A face whose area is not finite or above 1e290 has weights 0 and area 0. All other
 * cotangents are at most 1e8 in magnitude, so that no input can produce a NaN or an infinity.
 */

/** The area of a face, and the weight of the edge opposite to each corner: half the cotangent
 *  there.
 *
 *  For a function f that is linear on the face, with corner values f0 f1 f2:
 *  area |grad f|^2 = sum over k of weight[k] (f(k+1) - f(k+2))^2.
 */
typedef struct laplacian_face {
    double area;
    double weight[3];
} laplacian_face;

/** Computes it for the face with corners face[0..2], each in 0..n_vertices-1. */
laplacian_face laplacian_of_face(const mesh *m, const sl_int *face);

/** The same for a face whose edge opposite to corner k has the length lengths[k]. Without area the
 *  weights are 0. */
laplacian_face laplacian_of_lengths(const double lengths[3]);

/** Lower triangle of the cotangent Laplacian: the weight of an edge is half the sum of the
 *  cotangents opposite to it.
 *
 *  The sum is over all faces of the edge: one at the boundary, three or more if the mesh is not
 *  manifold. Each face adds a semi-definite matrix, so the sum is semi-definite. Single weights may
 *  be negative (obtuse angles).
 *
 *  out  [out]  n_vertices x n_vertices, release with sl_matrix_free; NULL on error.
 *  Returns  true; false: a face index is out of range, out of memory.
 */
bool laplacian_cotangent(sl_matrix **out, const mesh *m);

/** Lower triangle of the graph Laplacian plus shift I: weight 1 for each edge, however many faces
 *  share it. Arguments and errors as laplacian_cotangent. */
bool laplacian_uniform(sl_matrix **out, const mesh *m, double shift);

/** Lumped (barycentric) mass: mass[i] is a third of the area of the faces around vertex i.
 *
 *  A vertex without area (no face, or only faces without area) gets 1 instead of 0, so that M and M
 *  + t L remain definite. Such a vertex is decoupled from the mesh: its solution is b / 1.
 *
 *  mass  [out]  n_vertices, in squared units of length.
 */
void laplacian_mass(double *mass, const mesh *m);

/** Lower triangle of M + t L, with the cotangent Laplacian L and the diagonal matrix M of
 *  laplacian_mass.
 *
 *  out  [out]  n_vertices x n_vertices, release with sl_matrix_free; NULL on error.
 *  t    [in]   0..1e200, in squared units of length; usually the square of mesh_mean_edge_length.
 *  Returns  true; false: as laplacian_cotangent, or t is out of range or NaN.
 */
bool laplacian_system(sl_matrix **out, const mesh *m, double t);

/** The same three for faces that are given by their lengths (intrinsic.h).
 *
 *  lengths  [in]  3 n_faces: of the edge opposite to each corner; NULL: as above.
 *  share    [in]  factor of areas and weights.
 */
bool laplacian_cotangent_of(sl_matrix **out, const mesh *m, const double *lengths, double share);
bool laplacian_system_of(sl_matrix **out, const mesh *m, const double *lengths, double share,
                         double t);
void laplacian_mass_of(double *mass, const mesh *m, const double *lengths, double share);

/** The mean edge length, each edge counted once; 0 for a mesh without edges, NAN if a face
 *  names no vertex and if memory runs out. */
double mesh_mean_edge_length(const mesh *m);

#endif
