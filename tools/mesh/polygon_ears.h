/* polygon_ears.h: divides polygons that are not convex into triangles, by ears */
#ifndef TOOLS_POLYGON_EARS_H
#define TOOLS_POLYGON_EARS_H

#include <stdbool.h>
#include <stddef.h>

#include "sparse_local.h"

/** A polygon with more corners is not divided: the time grows with their square. */
enum { EARS_CORNERS_MAX = 1 << 13 };

typedef enum ears_result {
    EARS_FAN, /* the fan turns no triangle over, or the polygon has no area: nothing changed */
    EARS_CUT, /* the fan was replaced by ears */
    EARS_IMPOSSIBLE, /* the polygon crosses itself: nothing changed */
    EARS_TOO_LARGE,  /* it has too many corners, and the fan turns triangles over */
    EARS_NO_MEMORY   /* nothing changed */
} ears_result;

/** Replaces the fan of a polygon by ears if the fan turns triangles over.
 *
 *  A triangle is turned over if its normal is opposed to that of the polygon, the sum over all
 *  corners of x_k x x_{k+1} (Newell), and areas are those of the projection along it.
 *
 *  faces    [in/out]  3 (corners - 2): a fan around its first corner, (c0, c1, c2), (c0, c2, c3)
 *  corners  [in]      at least 4.
 *  xyz      [in]      coordinates of the vertices.
 *  Cost     O(corners) for a fan that stays, otherwise O(corners^2) at most.
 *  Source   Meisters: Polygons have ears, 1975.
 *  Example  tests/tools/test_mesh_polygons.c
 */
ears_result ears_instead_of_fan(sl_int *faces, size_t corners, const double *xyz);

#endif
