/* incidence.h: the faces around each vertex of a mesh, and scratch with which parts of it are numbered locally */
#ifndef TOOLS_INCIDENCE_H
#define TOOLS_INCIDENCE_H

#include <stdbool.h>

#include "mesh.h"

/** Made once a mesh; what is then asked about a part of the mesh costs what the part does.
 *
 *  Faces around vertex v: face[begin[v]] .. face[begin[v+1]-1], ascending. Faces with a repeated vertex have no shape
 *  and are left out.
 */
typedef struct incidence {
    const mesh *m; /* borrowed */
    sl_off *begin; /* n_vertices + 1 */
    sl_int *face;
    sl_int *place; /* n_vertices times -1: lent to whoever numbers a subset, -1 again afterwards */
    unsigned char *taken; /* n_faces zeros: lent, 0 again afterwards */
} incidence;

/** Collects them.
 *
 *  out  [out]  release with incidence_free; all zero on error.
 *  Returns  true; false: a face index out of range, out of memory.
 *  Cost     O(vertices + faces).
 */
bool incidence_create(incidence *out, const mesh *m);

void incidence_free(incidence *a);

/** The faces at the edge (u, v), u not v: up to `most` of them into faces; returns how many there are.
 *
 *  Cost  O(faces around the end that has fewer).
 */
sl_int incidence_edge(const incidence *a, sl_int u, sl_int v, sl_int *faces, sl_int most);

/** Is every vertex of a list in range, and there once? The scratch is given back as it was.
 *
 *  vertices  [in]  count numbers; a count below 0 is no list.
 */
bool incidence_are_distinct(incidence *around, const sl_int *vertices, sl_int count);

#endif
