/* view_page.h: a mesh and fields on it as one HTML file that a browser turns, colors and queries */
#ifndef TOOLS_VIEW_PAGE_H
#define TOOLS_VIEW_PAGE_H

#include <stdio.h>

#include "tools/mesh/mesh.h"

/** Numbers at the vertices. */
typedef struct view_field {
    const char *name;
    const double *value; /* one for each vertex; NAN: none */
} view_field;

/** The page: view_page.html, which make turns into this array, ended by NULL. The line of
 *  VIEW_PAGE_DATA stands for the data. */
extern const char *const view_page_text[];
#define VIEW_PAGE_DATA "/*DATA*/"

/** The script of live pages and the WebAssembly that it runs, in base64; both ended by NULL. A
 *  program that was built without the latter has an empty array: `make live` makes both. */
extern const char *const view_live_script[];
extern const char *const view_live_kernel[];
#define VIEW_PAGE_LIVE "<!--LIVE-->"

/** A triangulation of the surface on which a live page solves; see intrinsic.h. */
typedef struct view_live {
    const mesh *surface;   /* with the vertices of the page; that of the page itself, or another */
    const double *lengths; /* 3 n_faces of the surface: of the edge opposite to each corner */
    double share;          /* of each face in areas and weights */
    double t;              /* heat diffuses for this time */
} view_live;

typedef struct view_page {
    const mesh *m;
    const char *title; /* any text; of a path the page shows the name and, as a hint, the rest */
    double axes[3][3]; /* of the camera at first: right, up, toward it (render_axes) */
    const sl_int *marked;
    sl_int n_marked; /* vertices with a dot */
    const view_field *fields;
    size_t n_fields;
    const view_live *live; /* NULL: the page shows its fields and solves nothing */
} view_page;

/** Writes the page. It loads nothing from anywhere: scripts and data are in the file, coordinates
 *  in single precision relative to a center (single_frame.h), values in double. Errors of writing
 *  are those of the stream. */
void view_page_write(FILE *out, const view_page *page);

#endif
