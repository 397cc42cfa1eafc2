/* edge_sides.h: the sides of the faces of a mesh, and which of them lie on the same edge */
#ifndef TOOLS_EDGE_SIDES_H
#define TOOLS_EDGE_SIDES_H

#include "mesh.h"

/* Side 3 f + k of face f is opposite to its corner k and runs from corner k + 1 to k + 2. */

/** A side of a face by the numbers of its ends. */
typedef struct edge_side {
    sl_int low, high, side;
} edge_side;

/** The side after this one in its face. */
sl_int side_after(sl_int side);

/** The sides of all faces, those of one edge next to each other and ascending; released by free.
 *  NULL: out of memory. */
edge_side *sorted_sides(const mesh *m);

/** The end of the sides of the edge that begins at position k of count. */
size_t end_of_edge(const edge_side *sides, size_t k, size_t count);

#endif
