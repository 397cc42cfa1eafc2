/* part.h: a part of a mesh as a small mesh of its own, and where it is joined to the rest */
#ifndef TOOLS_PART_H
#define TOOLS_PART_H

#include <stdbool.h>
#include <stddef.h>

#include "incidence.h"

/** Some vertices of a mesh and faces between them, numbered 0, 1, ... in the part. */
typedef struct part {
    mesh m;             /* the part's own vertices and faces */
    sl_int *vertices;   /* m.n_vertices: their numbers in the mesh */
    sl_int *mesh_faces; /* m.n_faces: likewise */
    sl_int n_rim;
    sl_int *
        rim; /* vertices of the part, ascending, with a face outside of it: elsewhere the rows of the mesh's
                    Laplacian are those of the part's own */
} part;

/** The part that a list of vertices spans: the faces all of whose corners are listed.
 *
 *  out       [out]  release with part_free; all zero on error.
 *  around    [in,out]  its scratch is used and given back as it was.
 *  vertices  [in]   count numbers of vertices, in any order; the part numbers them in this order.
 *  message   [out]  on error what is wrong; may be NULL with message_size 0.
 *  Returns  true; false: a vertex out of range or given twice, out of memory.
 *  Cost     O(vertices and the faces around them).
 */
bool part_span(part *out, incidence *around, const sl_int *vertices, sl_int count, char *message,
               size_t message_size);

/** The part of given vertices and faces; every corner of the faces must be among the vertices, none of either twice.
 *
 *  Returns  true; false: out of memory.
 */
bool part_of_faces(part *out, incidence *around, const sl_int *vertices, sl_int n_vertices,
                   const sl_int *faces, sl_int n_faces);

void part_free(part *p);

#endif
