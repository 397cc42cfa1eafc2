/* patch.h: neighbours in a mesh or a matrix, patches grown by breadth-first search, connected components */
#ifndef TOOLS_PATCH_H
#define TOOLS_PATCH_H

#include <stdbool.h>

#include "mesh.h"

/** Neighbours of vertex v: neighbour[begin[v]] .. neighbour[begin[v+1]-1], ascending, none twice, never v itself. */
typedef struct adjacency {
    sl_int n;
    sl_off *begin;     /* n + 1 */
    sl_int *neighbour; /* begin[n]; every edge stands at both of its ends */
} adjacency;

/** The edges of all faces; a vertex that no face uses has no neighbours.
 *
 *  out  [out]  release with adjacency_free; all zero on error.
 *  Returns  true; false: a face index out of range, out of memory.
 */
bool adjacency_from_mesh(adjacency *out, const mesh *m);

/** The entries off the diagonal of a square matrix, whichever triangle it stores (also where the value is 0). */
bool adjacency_from_matrix(adjacency *out, const sl_csc *A);

/** Releases the arrays and makes it empty. */
void adjacency_free(adjacency *a);

/** The first count vertices that a breadth-first search from start finds, in the order found, start first.
 *
 *  patch  [out]     room for count.
 *  count  [in]      0 or more.
 *  seen   [in,out]  n bytes, all 0; all 0 again on return (so that many patches cost one clearing).
 *  Returns  how many were found: fewer than count if the component is smaller.
 *  Cost     O(edges at the vertices found), nothing O(n).
 */
sl_int patch_bfs(sl_int *patch, sl_int count, const adjacency *a, sl_int start,
                 unsigned char *seen);

/** Numbers the connected components 0, 1, ... by their smallest vertex; a vertex without neighbours is one alone.
 *
 *  component  [out]  n: the number of each vertex's component.
 *  sizes      [out]  n (more than needed): how many vertices each component has; may be NULL.
 *  Returns  how many components; -1: out of memory.
 */
sl_int patch_components(sl_int *component, sl_int *sizes, const adjacency *a);

#endif
