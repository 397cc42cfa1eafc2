/* edge_flips.h: the faces of a mesh whose edges are flipped one by one */
#ifndef TOOLS_EDGE_FLIPS_H
#define TOOLS_EDGE_FLIPS_H

#include <stdbool.h>

#include "mesh.h"

/** Faces and their neighbors. Side 3 f + k of face f is opposite to its corner k and runs from
 *  corner k + 1 to k + 2. */
typedef struct edge_flips {
    mesh m;       /* xyz is borrowed, faces are a copy */
    sl_int *twin; /* 3 n_faces: the other side of the edge; -1: there is none, or not exactly one of
                     the other direction */
} edge_flips;

/** Copies the faces and finds their neighbors.
 *
 *  out  [out]  release with edge_flips_free; all zero on error.
 *  m    [in]   xyz is borrowed, must outlive out.
 *  Returns  true; false: a face index is out of range, out of memory.
 *  Cost     O(faces log faces).
 *  Example  tests/tools/test_edge_flips.c
 */
bool edge_flips_create(edge_flips *out, const mesh *m);

/** Releases the arrays and sets a to all zero. */
void edge_flips_free(edge_flips *a);

/** The vertices around a side: the ends of its edge, the corner opposite to it, and that of the
 *  face behind it.
 *
 *  Returns  whether flipping joins corners[2] and corners[3] well: there is one face behind the
 *           side, all four vertices differ, and both new faces have an area and lie on the same
 *           side of the surface. That they are not joined yet is for the caller to know.
 */
bool edge_flips_corners(sl_int corners[4], const edge_flips *a, sl_int side);

/** Flips the edge, for which edge_flips_corners has returned true. faces 0 and 1 of the pair change
 *  in place.
 *
 *  pair  [out]  the two faces.
 */
void edge_flips_flip(sl_int pair[2], edge_flips *a, sl_int side);

#endif
