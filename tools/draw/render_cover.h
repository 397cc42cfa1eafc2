/* render_cover.h: the parts of a triangle in the cells of a raster: areas, centers, sample masks */
#ifndef TOOLS_RENDER_COVER_H
#define TOOLS_RENDER_COVER_H

#include <stdint.h>

/** The part of a triangle in one cell, a square with sides of 1. */
typedef struct cover_part {
    int x, y;      /* the cell: x..x+1, y..y+1 */
    double area;   /* 0..1 */
    double w[3];   /* barycentric coordinates of the center of mass */
    double depth;  /* of the triangle's plane in the middle of the cell, near the part's depths */
    uint16_t mask; /* which of the 4 x 4 samples of the cell are in the triangle */
} cover_part;

/** Receives the parts. */
typedef void cover_visitor(void *context, const cover_part *part);

/** Calls `visit` for every cell of left..right-1, top..bottom-1 in which the triangle has a part,
 *  row by row. The areas of a triangle's parts sum up to its own area, however thin it is.
 *
 *  corner  [in]  x, y, depth of the corners; one cell wide is also the unit of the depth, which is
 *                only used to limit how far planes are extended.
 */
void cover_triangle(const double *const corner[3], int left, int right, int top, int bottom,
                    cover_visitor *visit, void *context);

#endif
