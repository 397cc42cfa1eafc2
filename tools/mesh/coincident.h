/* coincident.h: vertices at the same place: counting them, and merging them */
#ifndef TOOLS_COINCIDENT_H
#define TOOLS_COINCIDENT_H

#include "mesh.h"

/** Counts the vertices of faces that have exactly the coordinates of a vertex of a face with a
 *  lower number. Faces around such vertices are not joined.
 *
 *  Returns  the count; -1: out of memory.
 *  Cost     O(n) on average.
 */
sl_int coincident_count(const mesh *m);

/** What coincident_merge did. */
typedef struct coincident_merged {
    sl_int vertices; /* merged with others, and gone */
    sl_int faces;    /* left out: two of their corners became one vertex */
} coincident_merged;

/** Merges each vertex with the first vertex that is kept and no farther away than a tolerance. The
 *  others keep their order.
 *
 *  m          [in/out]
 *  merged     [out]     may be NULL.
 *  map        [out]     what each vertex has become; release with free; NULL on error; may be NULL.
 *  tolerance  [in]      in units of the coordinates; 0: equal coordinates only, as does a tolerance
 *                       below 2^-52 of the largest coordinate.
 *  Returns  true; false: out of memory, m is as it was.
 *  Cost     O(n) on average.
 *  Example  tests/tools/test_coincident.c
 */
bool coincident_merge(mesh *m, coincident_merged *merged, sl_int **map, double tolerance);

#endif
