/* patch_holes.h: fills the holes of a patch: small pieces of the mesh that it encloses */
#ifndef TOOLS_PATCH_HOLES_H
#define TOOLS_PATCH_HOLES_H

#include "incidence.h"

/** Appends the vertices of every hole to a list of vertices. A hole is a connected piece of the
 *  rest of the mesh that shares a face with the patch and has at most max_vertices vertices. If
 *  every piece is that small, the largest one counts as the outside and is not appended.
 *
 *  vertices      [in,out]  *count distinct vertices, allocated by malloc; reallocated when it
 *                          grows.
 *  count         [in,out]  length of the list.
 *  inc           [in,out]  the mesh; its scratch is used and restored.
 *  max_vertices  [in]      the largest hole, in vertices.
 *  Returns  true; false: out of memory, the list is unchanged.
 *  Cost     O(faces around the list, around the appended vertices and around max_vertices vertices
 *           of each large piece).
 */
bool patch_fill_holes(sl_int **vertices, sl_int *count, incidence *inc, sl_int max_vertices);

#endif
