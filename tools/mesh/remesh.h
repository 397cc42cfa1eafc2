/* remesh.h: a mesh whose topology changes in places: flips, splits and collapses of edges */
#ifndef TOOLS_REMESH_H
#define TOOLS_REMESH_H

#include <stdint.h>

#include "edge_flips.h"

/** A mesh that is edited. Vertices and faces that were removed keep their numbers until
 *  remesh_compact. Edges at the border, and those of vertices at it, stay as they are. */
typedef struct remesh {
    edge_flips faces;                 /* xyz is a copy; the corners of removed faces are -1 */
    sl_int most_vertices, most_faces; /* room */
    sl_int *valence;                  /* edges of each vertex; 0: removed */
    sl_int *side;                     /* a side that begins at each vertex, or -1 */
} remesh;

/** Copies a mesh, which should be a manifold: other edges stay as they are.
 *
 *  out  [out]  release with remesh_free; all zero on error.
 *  Returns  true; false: a face index is out of range, out of memory.
 *  Example  tests/tools/test_remesh.c
 */
bool remesh_create(remesh *out, const mesh *m);

/** Releases the arrays and sets r to all zero. */
void remesh_free(remesh *r);

/** Flips an edge if that joins its opposite corners well (edge_flips_corners), and if they are not
 *  joined yet. Returns whether it did. */
bool remesh_flip(remesh *r, sl_int side);

/** Splits an edge by a new vertex in its middle, the last one. Returns whether it did: not at the
 *  border, nor without memory. */
bool remesh_split(remesh *r, sl_int side);

/** Collapses an edge: its end is removed, its begin takes over the faces. Returns whether it did:
 *  not if the surface would no longer be a manifold, or a face would turn over. */
bool remesh_collapse(remesh *r, sl_int side);

/** Lists up to `count` vertices around a center, in breadth-first order.
 *
 *  vertices  [out]  room for count.
 *  seen      [in,out]  n_vertices zeros; zeros again on return.
 *  Returns  how many.
 */
sl_int remesh_patch(const remesh *r, sl_int center, sl_int count, sl_int *vertices,
                    unsigned char *seen);

/** Remeshes around some vertices: a third of them get a split edge, a third are collapsed into a
 *  neighbor, and then edges are flipped that bring valences closer to 6. Returns the number of
 *  changes. random: state. */
sl_int remesh_vertices(remesh *r, const sl_int *vertices, sl_int count, uint64_t *random);

/** Removes the vertices and faces that are marked as removed and numbers the others in their order.
 *
 *  new_of  [out]  n_vertices, as before the call: the new number of each vertex, or -1.
 */
void remesh_compact(remesh *r, sl_int *new_of);

#endif
