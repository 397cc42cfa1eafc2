/* graph_ball.h: all vertices within a given edge-path distance of some sources (Dijkstra) */
#ifndef TOOLS_GRAPH_BALL_H
#define TOOLS_GRAPH_BALL_H

#include "incidence.h"

/** The vertices found, nearest first. */
typedef struct graph_ball {
    sl_int n;
    sl_int *vertices;    /* n vertices of the mesh */
    double *path_length; /* n: length of the shortest edge path from a source */
} graph_ball;

/** Finds every vertex that an edge path of length at most `radius` joins to a source.
 *
 *  out      [out]     release with graph_ball_free; all zero on error.
 *  inc      [in,out]  the mesh; its scratch is used and restored.
 *  sources  [in]      count vertices in 0..n_vertices-1; repetitions are allowed.
 *  radius   [in]      0 or more, in the units of the coordinates; infinity gives the whole
 *                     connected components of the sources.
 *  Returns  true; false: out of memory.
 *  Cost     O(k log k), where k is the number of edges of the faces around the vertices found;
 *           independent of the size of the mesh.
 */
bool graph_ball_create(graph_ball *out, incidence *inc, const sl_int *sources, sl_int count,
                       double radius);

/** Releases the arrays and sets b to all zero. */
void graph_ball_free(graph_ball *b);

#endif
