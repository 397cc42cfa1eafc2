/* picture.h: raster pictures in memory: lines, disks, boxes, scaling, PNG output */
#ifndef TOOLS_PICTURE_H
#define TOOLS_PICTURE_H

#include <stdbool.h>
#include <stddef.h>

#include "colors.h"

/** Pixels in rows from top to bottom, each row from left to right. The center of the first pixel is
 *  (0.5, 0.5). */
typedef struct picture {
    int width;
    int height;
    rgb *at; /* width x height */
} picture;

/** Creates a picture of one color; release with picture_free. False: a side outside 1..16384 or out
 *  of memory, and *p is all zero. */
bool picture_create(picture *p, int width, int height, rgb background);

void picture_free(picture *p);

/** Draws a filled disk, clipped to the picture. No antialiasing: draw at twice the size and use
 *  picture_shrink. */
void picture_disk(picture *p, double x, double y, double radius, rgb color);

/** Draws a line with round ends. */
void picture_line(picture *p, double x0, double y0, double x1, double y1, double width, rgb color);

/** Draws a line with round ends whose rim is smooth: a pixel on it is mixed with what is there. */
void picture_stroke(picture *p, double x0, double y0, double x1, double y1, double width,
                    rgb color);

/** Fills the rectangle from (x0, y0) to (x1, y1). */
void picture_box(picture *p, double x0, double y0, double x1, double y1, rgb color);

/** Divides width and height by `factor`; a pixel becomes the mean of a block of factor x factor
 *  pixels. Incomplete blocks at the right and the bottom are dropped. */
void picture_shrink(picture *p, int factor);

/** Copies `from` into p with its upper left corner at (x, y), clipped to p. */
void picture_paste(picture *p, const picture *from, int x, int y);

/** Writes a PNG file (png_write.c, the only file that needs libpng).
 *
 *  message  [out]  the reason on error; may be NULL.
 *  Returns  true; false: the file cannot be written.
 */
bool picture_write_png(const picture *p, const char *path, char *message, size_t message_size);

#endif
