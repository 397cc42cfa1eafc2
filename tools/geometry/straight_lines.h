/* straight_lines.h: the line to the nearest of some points and edges, below any path */
#ifndef TOOLS_STRAIGHT_LINES_H
#define TOOLS_STRAIGHT_LINES_H

#include <stdbool.h>

#include "tools/mesh/mesh.h"

/** Raises distances to the length of the straight line from the nearest source. A distance on a
 *  surface cannot be shorter. Those that are so by rounding stay.
 *
 *  distance  [in,out]  n values of the vertices `vertices` of m; NaNs stay.
 *  sources   [in]      count >= 1 vertices of m.
 *  edges     [in]      n_edges pairs of vertices: all points between these are sources, too.
 *  largest   [in,out]  the largest change becomes at least that of this call.
 *  Returns  the number of values that changed; -1: out of memory.
 *  Cost     O((n + count) log count), and for each vertex as many sources as differ from it in one
 *           coordinate by less than the nearest one is away.
 *  Example  tests/tools/test_geodesic_exact.c
 */
sl_int straight_lines_raise(double *distance, const mesh *m, const sl_int *vertices, sl_int n,
                            const sl_int *sources, sl_int count, const sl_int *edges,
                            sl_int n_edges, double *largest);

#endif
