/* draw_graph.h: draws the graph of a small mesh with numbered vertices, as SVG */
#ifndef TOOLS_DRAW_GRAPH_H
#define TOOLS_DRAW_GRAPH_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/mesh/mesh.h"

/** Draws the edges of all faces and a numbered circle at each vertex that a face uses, projected
 *  along the coordinate axis in which the mesh has the smallest extent.
 *
 *  kind  [in]  n_vertices: -1 is gray, otherwise color_of_kind(kind); NULL: all gray.
 *  Returns  true; false with a message: the file cannot be written.
 */
bool draw_graph(const char *path, const mesh *m, const int *kind, char *message,
                size_t message_size);

#endif
