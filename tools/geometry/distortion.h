/* distortion.h: measures how a planar layout of a patch distorts angles, areas and lengths */
#ifndef TOOLS_DISTORTION_H
#define TOOLS_DISTORTION_H

#include "tools/mesh/mesh.h"

/** Distortion of a layout.
 *
 *  a >= |b| are the singular values of the linear map of a face to the plane; b is negative if the
 *  face is flipped. All sums and means over faces are weighted by their areas in space. Degenerate
 *  faces are left out: those whose weights in the Laplacian are 0 (laplacian.h), and those without
 *  area in the plane. conformal has the sign of area_flat; angle is infinite if all faces are
 *  flipped.
 */
typedef struct distortion {
    double area;            /* in space */
    double area_flat;       /* in the plane, flipped faces negative: sum of a b */
    double conformal;       /* sum of (a - b)^2 / 2, divided by area_flat; 0: conformal */
    double angle;           /* mean of a/b over faces not flipped; 1: conformal */
    double angle_ratio_max; /* largest a/b */
    double isometric;       /* mean of (a - 1)^2 + (b - 1)^2; 0: isometric */
    double area_spread; /* standard deviation of log(a b) over faces not flipped; 0: equal scale */
    sl_int flipped;     /* flipped faces */
    sl_int degenerate;  /* faces without area, in space or in the plane */
} distortion;

/** Computes all of them.
 *
 *  patch  [in]  the mesh that is laid out.
 *  uv     [in]  2 n_vertices: u v of each vertex.
 */
distortion distortion_of(const mesh *patch, const double *uv);

/** Translates uv so that the mean of the vertices is the origin, and scales it so that its area
 *  equals the area in space. A layout whose area is not positive is only translated.
 *
 *  uv  [in,out]  2 n_vertices.
 */
void distortion_normalize(const mesh *patch, double *uv);

#endif
