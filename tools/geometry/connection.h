/* connection.h: tangent planes of a triangle mesh, and the connection Laplacian between them */
#ifndef TOOLS_CONNECTION_H
#define TOOLS_CONNECTION_H

#include <stdbool.h>

#include "tools/mesh/mesh.h"

/* A tangent vector at a vertex is a complex number z. Its angle is measured on the surface: the
 * angles of the corners around the vertex follow one another, and around an interior vertex they
 * are scaled to a sum of 2 pi [KCPS13]. All vectors of a plane thus have the plane's angles.
 *
 * The edge from vertex i to vertex j has an angle at i and, in the direction to i, one at j. A
 * vector that moves along the edge keeps its angle to it. It therefore turns by
 *
 *  r = exp(i (angle at j + pi - angle at i)),
 *
 * and the connection Laplacian has the row  sum over edges  weight (z_j - r z_i)  at j, with the
 * cotangent weights of laplacian.h. It is Hermitian, and semi-definite because each face adds a
 * semi-definite matrix.
 *
 * Edges with three or more faces, and edges whose two faces are oriented differently, are borders:
 * the corners at their two sides do not follow one another. Vectors turn arbitrarily there.
 *
 *  [KCPS13]  Knoeppel, Crane, Pinkall, Schroeder: Globally optimal direction fields, 2013.
 */
typedef struct connection {
    const mesh *m; /* borrowed */
    double *angle; /* 6 n_faces: at corner k of face f, 6 f + 2 k: of the edge to corner k + 1, and
                      6 f + 2 k + 1: of the edge to corner k + 2 */
    double *axes;  /* 6 n_vertices: where the vectors 1 and i of a vertex point in space */
    sl_int irregular; /* edges of the last paragraph */
} connection;

/** Measures the angles around all vertices.
 *
 *  out  [out]  release with connection_free; all zero on error.
 *  m    [in]   borrowed, must outlive out.
 *  Returns  true; false: a face index is out of range, out of memory.
 *  Cost     sorts the edges.
 *  Example  tests/tools/test_vector_heat.c
 */
bool connection_create(connection *out, const mesh *m);

/** Releases the arrays and sets c to all zero. */
void connection_free(connection *c);

/** The vector in space of z = z[0] + z[1] i at a vertex. The axes of a vertex are orthonormal, are
 *  orthogonal to the mean normal of its faces, and fit the directions of its edges best. */
void connection_to_space(double vector[3], const connection *c, sl_int vertex, const double z[2]);

/** The inverse: of the part of the vector in the tangent plane. */
void connection_from_space(double z[2], const connection *c, sl_int vertex, const double vector[3]);

/** M + t L with the lumped mass M (laplacian.h) and the connection Laplacian L, as the real matrix
 *  of twice the size of sl_matrix_from_hermitian. It stores the lower triangle.
 *
 *  out  [out]  2 n_vertices x 2 n_vertices, release with sl_matrix_free; NULL on error.
 *  t    [in]   0..1e200, in squared units of length.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: t is out of range or NaN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
sl_status connection_system(sl_matrix **out, const connection *c, double t);

#endif
