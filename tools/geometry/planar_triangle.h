/* planar_triangle.h: a face in coordinates of its own plane, and its linear map to a layout */
#ifndef TOOLS_PLANAR_TRIANGLE_H
#define TOOLS_PLANAR_TRIANGLE_H

#include <stdbool.h>

#include "tools/mesh/mesh.h"

/** The corners of a face in its plane: the first at the origin, the second on the positive x axis,
 *  the third in the upper half plane. */
typedef struct planar_triangle {
    double x[3][2];
} planar_triangle;

/** Computes it for the face with corners face[0..2]. */
planar_triangle planar_triangle_of(const mesh *m, const sl_int *face);

/** The area of a triangle with edges of these lengths, also of a needle; 0 if it has none. */
double planar_area_of_lengths(const double lengths[3]);

/** The triangle whose edge opposite to corner k has the length lengths[k], placed like a face. */
planar_triangle planar_triangle_of_lengths(const double lengths[3]);

/** The linear map of a planar triangle to three points of the plane, and its singular values. */
typedef struct planar_map {
    double a[2][2];   /* the map is a x + constant */
    double sigma_max; /* the larger singular value */
    double sigma_min; /* the smaller one, negative if the triangle is flipped */
} planar_map;

/** Computes the map that takes corner k of f to the point (to[k][0], to[k][1]).
 *
 *  Returns  true; false: the triangle has no area, or the map is not finite.
 */
bool planar_map_of(planar_map *out, const planar_triangle *f, const double *const to[3]);

#endif
