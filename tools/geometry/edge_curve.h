/* edge_curve.h: curves along the edges of a mesh, through given vertices */
#ifndef TOOLS_EDGE_CURVE_H
#define TOOLS_EDGE_CURVE_H

#include "tools/mesh/int_list.h"
#include "tools/mesh/mesh.h"

/** Curves, all together. All zero: none. */
typedef struct edge_curve {
    int_list vertices; /* those of all curves, each once */
    int_list ends;     /* of each edge on them its two vertices */
} edge_curve;

/** Adds a curve through some vertices in their order. Between two that no edge joins it is a
 *  shortest path along edges. A curve of one vertex has no edges.
 *
 *  m        [in]   with all faces in range.
 *  through  [in]   count vertices of m; a closed curve ends with its first one.
 *  gap      [out]  the position in `through` of a vertex that no path joins to the next one; -1.
 *  Returns  true; false: out of memory, or gap is not -1. The curves so far are to be freed.
 *  Cost     O(faces log faces) for each such path.
 *  Example  tests/tools/test_straight_paths.c
 */
bool edge_curve_add(edge_curve *c, const mesh *m, const sl_int *through, sl_int count, sl_int *gap);

/** Releases the lists and sets c to all zero. */
void edge_curve_free(edge_curve *c);

/** The length of the curves at each of their vertices: half of the edges there.
 *
 *  length  [out]  c->vertices.count values.
 *  place   [in]   n_vertices of m: scratch.
 */
void edge_curve_lengths(double *length, sl_int *place, const edge_curve *c, const mesh *m);

#endif
