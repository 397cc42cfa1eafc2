/* adjacency.h: neighbors of mesh vertices or matrix rows, breadth-first search, components */
#ifndef TOOLS_ADJACENCY_H
#define TOOLS_ADJACENCY_H

#include <stdbool.h>

#include "mesh.h"

/** An undirected graph. The neighbors of vertex v are neighbor[begin[v]] .. neighbor[begin[v+1]-1],
 *  ascending, without duplicates and without v itself. */
typedef struct adjacency {
    sl_int n;
    sl_off *begin;    /* n + 1 */
    sl_int *neighbor; /* begin[n]; each edge is stored at both of its ends */
} adjacency;

/** The graph of the edges of all faces. A vertex without faces has no neighbors.
 *
 *  out  [out]  release with adjacency_free; all zero on error.
 *  Returns  true; false: a face index is out of range, out of memory.
 */
bool adjacency_from_mesh(adjacency *out, const mesh *m);

/** The graph of the stored off-diagonal entries of a square matrix, explicit zeros included. A may
 *  store either triangle or both.
 *
 *  out  [out]  release with adjacency_free; all zero on error.
 *  Returns  true; false: A is malformed or not square, out of memory.
 */
bool adjacency_from_matrix(adjacency *out, const sl_csc *A);

/** Releases the arrays and sets a to all zero; NULL is allowed. */
void adjacency_free(adjacency *a);

/** The first count vertices of a breadth-first search from start, in the order of discovery.
 *
 *  patch  [out]     room for count vertices; patch[0] is start.
 *  count  [in]      0 or more.
 *  seen   [in,out]  n bytes, all 0 on entry and on return, so that many searches share one array.
 *  Returns  the number of vertices found: less than count if the component is smaller; 0 if start
 *           is out of range.
 *  Cost     O(edges at the vertices found), independent of n.
 */
sl_int adjacency_bfs(sl_int *patch, sl_int count, const adjacency *a, sl_int start,
                     unsigned char *seen);

/** Numbers the connected components 0, 1, ... in the order of their smallest vertices. A vertex
 *  without neighbors is a component.
 *
 *  component  [out]  n: the component of each vertex.
 *  sizes      [out]  room for n: the number of vertices of each component; may be NULL.
 *  Returns  the number of components; -1: out of memory.
 */
sl_int adjacency_components(sl_int *component, sl_int *sizes, const adjacency *a);

#endif
