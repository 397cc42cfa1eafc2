/* render.h: renders a mesh to a picture: shading, color maps, isolines, checkerboards, marks */
#ifndef TOOLS_RENDER_H
#define TOOLS_RENDER_H

#include <stdbool.h>

#include "camera.h"
#include "legend.h"
#include "picture.h"
#include "tools/mesh/mesh.h"

/** The camera and the size of the picture. All zero is not useful: start from
 *  render_view_default. */
typedef struct render_view {
    int width; /* of the picture, divided by scale */
    int height;
    int scale;          /* pixels per unit of width and height, and of all other lengths below */
    double azimuth;     /* degrees, as in camera_axes */
    double elevation;   /* degrees, as in camera_axes */
    double perspective; /* 0: parallel; else the camera's distance in radii of the mesh, > 1 */
    double zoom;        /* 1: the mesh fills the picture except for a margin */
    camera_up up;
    /* view a mesh that is flat along a coordinate axis from that axis, and one that is long and
     * thin by its principal axes (thin_view.h) */
    bool automatic;
} render_view;

/** 800 x 600, scale 1, azimuth 30, elevation 20, parallel projection, y up, automatic. */
render_view render_view_default(void);

/** Sets azimuth and elevation so that `direction` points from the mesh to the camera. A direction
 *  that is zero or not finite changes nothing. view->automatic still takes precedence for a flat
 *  mesh. */
void render_look_from(render_view *view, const double direction[3]);

/** The axes of the camera that render_mesh uses.
 *
 *  axes  [out]  rows: right, up, toward the camera, in coordinates of the mesh.
 */
void render_axes(double axes[3][3], const render_view *view, const mesh *m);

/** A disk drawn over the surface at a vertex. */
typedef struct render_mark {
    sl_int vertex;
    double radius; /* pixels, times the view's scale; so are all widths */
    rgb color;
} render_mark;

/** A line drawn over the surface between two vertices. */
typedef struct render_segment {
    sl_int from, to;
    double width; /* pixels */
    rgb color;
} render_segment;

/** How the surface is drawn; all zero gives a plain light surface. A point takes its color from the
 *  first of these that is given: a checkerboard (uv or corner_uv), scalar, vertex_color,
 *  face_color. */
typedef struct render_style {
    /* 2 n_vertices: texture coordinates of the checkerboard. */
    const double *uv;
    /* n_vertices: only faces with 1 at all three corners have a checkerboard; NULL: all have. */
    const unsigned char *has_uv;
    /* 6 n_faces: texture coordinates per face corner, in place of uv; NaN: no checkerboard. */
    const double *corner_uv;
    double checks;           /* squares per unit of u and v; 0: 20 along the longer side */
    const double *scalar;    /* n_vertices, drawn through color_map; NaN is gray */
    double low, high;        /* ends of the color map; both 0: smallest and largest finite value */
    const char *legend;      /* title of the legend, lines separated by newlines; NULL: no legend.
                                Drawn by app_write, not by render_mesh */
    const legend_key *keys;  /* what the legend has if there is no scalar */
    int n_keys;
    int isolines;            /* number of levels strictly between low and high; 0: none. Omitted
                                where they would be closer than twice their width */
    const rgb *vertex_color; /* n_vertices */
    bool nearest;            /* color of the nearest corner; false: interpolated */
    const rgb *face_color;   /* n_faces */
    /* 6: the low and the high corner of a box that has room in the picture as well, so that the
     * pictures of a sequence have one scale; NULL: none. */
    const double *box;
    const unsigned char *hidden; /* n_faces: faces with 1 are not drawn; NULL: all are drawn */
    bool flat;                   /* one normal per face */
    bool unlit;                  /* no shading, as for layouts in the plane */
    double edges;                /* width of the edges in pixels; 0: none. Faces thinner than three
                                    widths have none */
    rgb edge_color;
    const render_mark *marks;
    int n_marks;
    const render_segment *segments;
    int n_segments;
} render_style;

/** Renders a mesh. Each quarter of a pixel shows the visible parts of all faces in it by their
 *  areas, so that faces far thinner than a pixel show their mean color. Faces that lie on one
 *  another show the mean of their colors.
 *
 *  The scale is chosen from the vertices that faces use. A mesh without faces gives an empty
 *  picture. Faces with a coordinate of magnitude 1e150 or more are not drawn.
 *
 *  out  [out]  release with picture_free; all zero on error.
 *  Returns  true; false: width or height times scale outside 1..8192, out of memory.
 */
bool render_mesh(picture *out, const mesh *m, const render_view *view, const render_style *style);

/** Draws a planar layout of a mesh: u to the right, v upward, unlit.
 *
 *  uv  [in]  2 n_vertices; faces with a NaN are omitted.
 */
bool render_layout(picture *out, const mesh *m, const double *uv, const render_view *view,
                   const render_style *style);

#endif
