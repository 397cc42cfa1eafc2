/* ball.h: the vertices within a distance along edges (Dijkstra), found in time proportional to their number */
#ifndef TOOLS_BALL_H
#define TOOLS_BALL_H

#include "incidence.h"

/** Vertices around some sources, nearest first. */
typedef struct ball {
    sl_int n;
    sl_int *vertices;
    double *along_edges; /* length of the shortest path of edges from a source */
} ball;

/** Finds all vertices with a path of edges of at most `radius` from a source.
 *
 *  out      [out]  release with ball_free; all zero on error.
 *  around   [in,out]  its scratch is used and given back as it was.
 *  sources  [in]   count vertices in 0..n-1; repetitions are fine.
 *  radius   [in]   0 or more; infinity finds the components of the sources.
 *  Returns  true; false: out of memory.
 *  Cost     O(k log k) for the k edges of faces around what is found; nothing O(n).
 */
bool ball_find(ball *out, incidence *around, const sl_int *sources, sl_int count, double radius);

void ball_free(ball *b);

#endif
