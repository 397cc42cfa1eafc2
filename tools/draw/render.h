/* render.h: draws a mesh: camera, depth buffer, shading, colours from numbers, isolines, edges, checks, marks */
#ifndef TOOLS_RENDER_H
#define TOOLS_RENDER_H

#include <stdbool.h>

#include "mesh.h"
#include "picture.h"

typedef enum render_up { RENDER_UP_Y = 0, RENDER_UP_X, RENDER_UP_Z } render_up;

/** From where, and how large. All zero is not useful: begin with render_view_default. */
typedef struct render_view {
    int width; /* of the picture */
    int height;
    double azimuth;     /* degrees around the upward axis; 0 looks along the axis behind it */
    double elevation;   /* degrees above the horizon */
    double perspective; /* 0: parallel; else the camera's distance in radii of the mesh, above 1 */
    double zoom;        /* 1: the mesh fills the picture but for a margin */
    render_up up;
    bool automatic; /* a mesh that is flat along an axis is looked at from there */
} render_view;

/** 800 x 600, azimuth 30, elevation 20, parallel, y up, automatic. */
render_view render_view_default(void);

/** Turns the camera so that it looks from there to the middle of the mesh; a direction of no length changes nothing. A mesh
 *  that is flat is still looked at from above where view->automatic says so. */
void render_look_from(render_view *view, const double direction[3]);

/** A vertex drawn as a disk over the surface. */
typedef struct render_mark {
    sl_int vertex;
    double radius; /* pixels */
    rgb color;
} render_mark;

/** A line over the surface from vertex to vertex. */
typedef struct render_segment {
    sl_int from, to;
    double width; /* pixels */
    rgb color;
} render_segment;

/** What is drawn; all zero gives a plain light surface. The first of these that is given colours a point: uv, scalar,
 *  vertex_color, face_color. */
typedef struct render_style {
    const double *uv; /* 2 n_vertices texture coordinates: a checkerboard ... */
    const unsigned char
        *has_uv; /* n_vertices: ... on the faces all of whose corners are 1 here (NULL: all) */
    const double *
        corner_uv; /* 6 n_faces: instead of uv, one pair for each corner of each face; NaN: none there */
    double checks;        /* squares a unit of u and v; 0: 20 over the larger side */
    const double *scalar; /* n_vertices, through color_map; NaN is grey */
    double low, high;     /* values of the map's ends; both 0: smallest and largest finite value */
    int isolines;         /* how many levels strictly between low and high; 0: none */
    const rgb *vertex_color; /* n_vertices */
    bool nearest; /* a point has its nearest corner's colour, not the mixture of the three */
    const rgb *face_color;       /* n_faces */
    const unsigned char *hidden; /* n_faces: 1 is not drawn; NULL: all are */
    bool flat;                   /* one normal a face */
    bool unlit;                  /* no shading: layouts in the plane */
    double edges;                /* width of the edges in pixels; 0: none */
    rgb edge_color;
    const render_mark *marks;
    int n_marks;
    const render_segment *segments;
    int n_segments;
} render_style;

/** Draws; each pixel is the mean of 2 x 2.
 *
 *  Vertices that no face uses do not count for the size; a mesh without faces gives an empty picture. Faces with a
 *  coordinate beyond 1e150 are not drawn.
 *
 *  out  [out]  release with picture_free; all zero on error.
 *  Returns  true; false: a size out of range, out of memory.
 */
bool render_mesh(picture *out, const mesh *m, const render_view *view, const render_style *style);

/** Draws a planar layout of a mesh: (u, v) of each vertex as a point in the plane, looked at from above, unlit.
 *
 *  uv  [in]  2 n_vertices; faces with a NaN are left out.
 */
bool render_layout(picture *out, const mesh *m, const double *uv, const render_view *view,
                   const render_style *style);

#endif
