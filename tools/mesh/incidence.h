/* incidence.h: the faces around each vertex of a mesh, and scratch to number some vertices */
#ifndef TOOLS_INCIDENCE_H
#define TOOLS_INCIDENCE_H

#include <stdbool.h>

#include "mesh.h"

/** Vertex-face incidence, created once per mesh. Later queries about a subset of the mesh cost time
 *  proportional to the subset.
 *
 *  The faces around vertex v are face[begin[v]] .. face[begin[v+1]-1], ascending. Faces with a
 *  repeated vertex are left out, unless the faces are given by lengths: then they are surfaces like
 *  others, and are listed once for each of their corners.
 */
typedef struct incidence {
    const mesh *m; /* borrowed */
    const double
        *lengths;  /* borrowed: 3 n_faces, as in intrinsic.h; NULL: the coordinates decide */
    sl_off *begin; /* n_vertices + 1 */
    sl_int *face;
    sl_int *local_index;      /* n_vertices: scratch to number a subset, -1 between calls */
    unsigned char *face_mark; /* n_faces: scratch, 0 between calls */
} incidence;

/** Collects the faces around each vertex of m.
 *
 *  out  [out]  release with incidence_free; all zero on error.
 *  m    [in]   borrowed, must outlive out.
 *  Returns  true; false: a face index is out of range, out of memory.
 *  Cost     O(vertices + faces).
 */
bool incidence_create(incidence *out, const mesh *m);

/** The same for faces with these lengths, borrowed; NULL: as incidence_create. */
bool incidence_create_of(incidence *out, const mesh *m, const double *lengths);

/** The length of the edge of face f opposite to its corner k. */
double incidence_edge_length(const incidence *a, sl_int f, int k);

/** Releases the arrays and sets a to all zero. */
void incidence_free(incidence *a);

/** The faces at the edge (u, v), u different from v.
 *
 *  faces  [out]  the first max_faces of them.
 *  Returns  the number of faces at the edge; may exceed max_faces.
 *  Cost     O(faces around the end that has fewer).
 */
sl_int incidence_edge_faces(const incidence *a, sl_int u, sl_int v, sl_int *faces,
                            sl_int max_faces);

/** Returns whether all count vertices of a list are in range and distinct; false if count < 0. The
 *  scratch is used and restored. */
bool incidence_vertices_are_distinct(incidence *inc, const sl_int *vertices, sl_int count);

#endif
