/* disk_holes.h: what a patch encloses: the pieces of the rest of the mesh that are smaller than the patch itself */
#ifndef TOOLS_DISK_HOLES_H
#define TOOLS_DISK_HOLES_H

#include "incidence.h"

/** Appends to a list of vertices those of every piece of the rest of the mesh that has a face at one of them and is
 *  itself of at most `most` vertices; if all pieces are that small, the largest is left out.
 *
 *  vertices  [in,out]  *count vertices, none twice; moved by realloc when it grows.
 *  around    [in,out]  its scratch is used and given back as it was.
 *  Returns  true; false: out of memory, the list is as it was.
 *  Cost     O(faces around the vertices, and around `most` others for the large piece, and what is appended).
 */
bool disk_enclosed(sl_int **vertices, sl_int *count, incidence *around, sl_int most);

#endif
