/* arrows.h: arrows over a surface: vectors at some of its vertices, as segments of a picture */
#ifndef TOOLS_ARROWS_H
#define TOOLS_ARROWS_H

#include "render.h"

/** The surface with the ends of the arrows as additional vertices, which no face uses, and the
 *  segments between them for a render_style. */
typedef struct arrows {
    mesh m; /* faces are those of the surface */
    render_segment *segments;
    int n_segments;
} arrows;

/** Draws arrows from vertices that are not too near to one another.
 *
 *  out       [out]  release with arrows_free; all zero on error.
 *  m         [in]   borrowed, must outlive out.
 *  vertices  [in]   count vertices; the first one of those that are too near is kept.
 *  vectors   [in]   3 count: in space; arrows have their directions, and the longest one about the
 *                   distance between arrows. One that is 0 or not finite has none.
 *  wanted    [in]   about the number of arrows if all vertices are listed, above 0.
 *  width     [in]   of the lines, in pixels.
 *  Returns  true; false: out of memory.
 *  Cost     O(count wanted).
 */
bool arrows_create(arrows *out, const mesh *m, const sl_int *vertices, sl_int count,
                   const double *vectors, int wanted, double width, rgb color);

/** Releases the arrays and sets a to all zero. */
void arrows_free(arrows *a);

#endif
