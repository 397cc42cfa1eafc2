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

/** Writes the page. It loads nothing from anywhere: scripts and data are in the file, coordinates
 *  in single precision, values in double.
 *
 *  title  [in]  any text.
 *  up     [in]  'y' or 'z': the axis that points upward at first.
 *  Errors of writing are those of the stream.
 */
void view_page_write(FILE *out, const mesh *m, const char *title, char up, const view_field *fields,
                     size_t n_fields);

#endif
