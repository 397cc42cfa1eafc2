/* flat_face.h: a triangle laid flat in its own plane, and the linear map from there to a layout */
#ifndef TOOLS_FLAT_FACE_H
#define TOOLS_FLAT_FACE_H

#include <stdbool.h>

#include "mesh.h"

/** The corners of a face in its plane: the first at the origin, the second on the positive x axis, the third above. */
typedef struct flat_face {
    double x[3][2];
} flat_face;

flat_face flat_face_of(const mesh *m, const sl_int *face);

/** The linear map of a flat triangle onto three points of the plane, by what it does to lengths. */
typedef struct flat_map {
    double a[2][2]; /* a x + constant */
    double large;   /* singular values: the larger one, and .. */
    double small;   /* .. the smaller one, negative where the triangle is turned over */
} flat_map;

/** The map that takes the corners to uv, 2 numbers at each of to[0..2]; false: the triangle has no area. */
bool flat_face_map(flat_map *out, const flat_face *f, const double *const to[3]);

#endif
