/* repeated_faces.h: a mesh without faces whose three vertices are those of an earlier face */
#ifndef TOOLS_REPEATED_FACES_H
#define TOOLS_REPEATED_FACES_H

#include "mesh.h"

/** Copies a mesh without the faces whose three vertices are those of an earlier face: such faces
 *  would be drawn in the same place. The vertices and the order of the other faces stay.
 *
 *  out      [out]  release with mesh_free; all zero on error.
 *  removed  [out]  the number of faces left out; may be NULL.
 *  Returns  true; false: out of memory.
 *  Cost     O(n_faces log n_faces).
 *  Example  tests/tools/test_repeated_faces.c
 */
bool mesh_without_repeated_faces(mesh *out, const mesh *m, sl_int *removed);

#endif
