/* insert_point.h: a vertex in a face or on an edge of a mesh, whose surface stays */
#ifndef TOOLS_INSERT_POINT_H
#define TOOLS_INSERT_POINT_H

#include "mesh.h"

/** A point of a face with corners a, b, c: (1 - u - v) a + u b + v c. */
typedef struct face_point {
    sl_int face;
    double u, v;
} face_point;

/** The point of the surface that is nearest to x; in the face with the lowest number, if it is in
 *  several. Faces without area count as the lines that they are. face is -1 without faces.
 *
 *  Cost  O(faces).
 *  Source  Ericson: Real-Time Collision Detection, 2005, section 5.1.5.
 */
face_point nearest_face_point(const mesh *m, const double x[3]);

/** Makes a point of a face a vertex: the corner or, if two coordinates of the point are 0 up to
 *  1e-9, an existing one; else the last one. The face is divided into three; with a point on an
 *  edge, each face at that edge into two. The first part keeps the number of the face.
 *
 *  m       [in,out]  unchanged on error.
 *  vertex  [out]
 *  Returns  true; false: the point is not in a face of m, too many faces, out of memory.
 *  Example  tests/tools/test_insert_point.c
 */
bool insert_face_point(mesh *m, const face_point *p, sl_int *vertex);

#endif
