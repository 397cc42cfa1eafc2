/* render_shade.h: the colour of a point of a surface: map or palette, checks, isolines, edges, light */
#ifndef TOOLS_RENDER_SHADE_H
#define TOOLS_RENDER_SHADE_H

#include "render.h"

/** Prepared for all points of a mesh. */
typedef struct render_shade {
    const mesh *m;
    const render_style *style;
    const double *eye; /* 3 n_vertices: to the right, upwards, towards the camera */
    double *normal;    /* 3 n_vertices, unit or 0, in the same directions; NULL: unlit or flat */
    double low, high;  /* of the scalar */
    double checks;
    double pixel; /* lines are that many times as wide */
} render_shade;

/** What is the same for all points of one face. */
typedef struct render_corner {
    sl_int face;
    double height[3]; /* pixels from each corner to the opposite edge */
    double normal[3]; /* of the face */
    double slope;     /* of the scalar, a pixel */
    double uv[3][2];
    bool has_uv;
} render_corner;

/** False: out of memory. render_shade_end in any case. */
bool render_shade_begin(render_shade *s, const mesh *m, const render_style *style,
                        const double *eye, double pixel);
void render_shade_end(render_shade *s);

/** a, b, c: x and y of the face's corners on the screen. */
void render_shade_face(render_corner *corner, const render_shade *s, sl_int face, const double *a,
                       const double *b, const double *c);

/** The colour where the corners weigh w[0], w[1], w[2]. */
rgb render_shade_point(const render_shade *s, const render_corner *corner, const double w[3]);

#endif
