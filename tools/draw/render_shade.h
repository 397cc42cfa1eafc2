/* render_shade.h: the color of a part of a face: color map, checkerboard, isolines, light */
#ifndef TOOLS_RENDER_SHADE_H
#define TOOLS_RENDER_SHADE_H

#include "render.h"

/** What all points of a mesh share. */
typedef struct render_shade {
    const mesh *m;
    const render_style *style;
    const double *eye; /* 3 n_vertices: camera coordinates (right, up, toward the camera) */
    double *normal;    /* 3 n_vertices: camera coordinates, unit length or 0; NULL: unlit or flat */
    double low, high;  /* range of the scalar */
    double checks;     /* squares per unit of u and v */
    double pixel;      /* factor on all line widths: samples per pixel of the result */
} render_shade;

/** What all points of one face share. */
typedef struct render_triangle {
    sl_int face;
    double height[3]; /* distance in pixels from each corner to the opposite edge */
    double normal[3]; /* of the face, unit length or 0 */
    double side[3];   /* -1: the normal of the corner is on the other side of the face; else 1 */
    double slope;     /* change of the scalar per pixel */
    double uv[3][2];
    bool has_uv;
} render_triangle;

/** False: out of memory. Call render_shade_end in either case. */
bool render_shade_begin(render_shade *s, const mesh *m, const render_style *style,
                        const double *eye, double pixel);
void render_shade_end(render_shade *s);

/** Fills in `tri` for a face with corners a, b, c on the screen (x and y in pixels). */
void render_shade_face(render_triangle *tri, const render_shade *s, sl_int face, const double *a,
                       const double *b, const double *c);

/** The color of a part of a face.
 *
 *  w     [in]  barycentric coordinates of its center.
 *  area  [in]  above 0, in squares of the cells of the raster: how sharp lines are.
 */
rgb render_shade_part(const render_shade *s, const render_triangle *tri, const double w[3],
                      double area);

#endif
