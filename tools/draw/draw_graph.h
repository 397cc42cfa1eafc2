/* draw_graph.h: a small mesh as a graph in the plane, its vertices numbered, as SVG */
#ifndef TOOLS_DRAW_GRAPH_H
#define TOOLS_DRAW_GRAPH_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh.h"

/** Draws the edges of all faces and a numbered circle for each vertex that a face uses, seen along the axis in which the
 *  mesh is thinnest.
 *
 *  kind  [in]  n_vertices: -1 grey, else color_of_kind(kind); NULL: all grey.
 *  Returns  true; false with a message: the file cannot be written.
 */
bool draw_graph(const char *path, const mesh *m, const int *kind, char *message,
                size_t message_size);

#endif
