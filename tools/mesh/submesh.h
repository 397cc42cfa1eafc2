/* submesh.h: some vertices and faces of a mesh as a mesh with local numbers, and its interface */
#ifndef TOOLS_SUBMESH_H
#define TOOLS_SUBMESH_H

#include <stdbool.h>
#include <stddef.h>

#include "incidence.h"

/** Some vertices of a mesh and some faces between them, numbered 0, 1, ... locally.
 *
 *  The interface consists of the local vertices with a face outside the submesh. At all other
 *  vertices the rows of the whole mesh's Laplacian equal those of the submesh's own Laplacian.
 */
typedef struct submesh {
    mesh m;             /* the vertices and faces in local numbers */
    sl_int *vertices;   /* m.n_vertices: their numbers in the whole mesh */
    sl_int *mesh_faces; /* m.n_faces: their numbers in the whole mesh */
    double *lengths;    /* 3 m.n_faces if the faces are given by lengths (intrinsic.h); else NULL */
    sl_int n_interface;
    sl_int *interface; /* local vertices, ascending */
} submesh;

/** The submesh spanned by a list of vertices: all faces whose corners are all listed.
 *
 *  out       [out]     release with submesh_free; all zero on error.
 *  inc       [in,out]  the mesh; its scratch is used and restored.
 *  vertices  [in]      count vertices in any order; local numbers follow this order.
 *  message   [out]     the reason on error, message_size bytes; may be NULL with message_size 0.
 *  Returns  true; false: a vertex is out of range or listed twice, out of memory.
 *  Cost     O(vertices + faces around them).
 */
bool submesh_from_vertices(submesh *out, incidence *inc, const sl_int *vertices, sl_int count,
                           char *message, size_t message_size);

/** The submesh of given vertices and faces. All corners of the faces must be listed, and neither
 *  list may contain duplicates (not checked).
 *
 *  out  [out]     release with submesh_free; all zero on error.
 *  inc  [in,out]  the mesh; its scratch is used and restored.
 *  Returns  true; false: out of memory.
 */
bool submesh_from_faces(submesh *out, incidence *inc, const sl_int *vertices, sl_int n_vertices,
                        const sl_int *faces, sl_int n_faces);

/** Releases the arrays and sets p to all zero. */
void submesh_free(submesh *p);

#endif
