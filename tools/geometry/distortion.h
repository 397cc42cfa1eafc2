/* distortion.h: what a layout of a patch in the plane does to angles and areas */
#ifndef TOOLS_DISTORTION_H
#define TOOLS_DISTORTION_H

#include "mesh.h"

/** Figures of a layout; with a, b (a >= |b|) the singular values of a face's map, b negative where it is turned over,
 *  and all sums over faces weighted by the areas of the faces in space. Faces without an area are left out. */
typedef struct distortion {
    double area;      /* in space */
    double area_flat; /* in the plane, faces turned over count negative: sum of a b */
    double conformal; /* sum of (a - b)^2 / 2, over area_flat: 0 where all angles are kept */
    double angle;     /* mean of a/b over the faces not turned over: 1 where all angles are kept */
    double angle_most;
    double rigid; /* mean of (a - 1)^2 + (b - 1)^2: 0 where all lengths are kept */
    double
        stretch; /* root of the mean of log(a b / mean a b)^2 over the faces not turned over: 0 where all areas are
                        scaled alike */
    sl_int flipped;  /* faces turned over */
    sl_int no_shape; /* faces without an area, in space or in the plane */
} distortion;

/** Measures.
 *
 *  uv  [in]  2 n_vertices: the layout, u v of each vertex of the part.
 */
distortion distortion_of(const mesh *part, const double *uv);

/** Moves and scales uv so that its area is the one in space and its vertices' mean is the origin; a layout without a
 *  positive area is only moved. */
void distortion_normalize(const mesh *part, double *uv);

#endif
