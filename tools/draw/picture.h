/* picture.h: pictures in memory, lines and disks in them, and PNG files of them */
#ifndef TOOLS_PICTURE_H
#define TOOLS_PICTURE_H

#include <stdbool.h>
#include <stddef.h>

#include "colors.h"

/** Pixels in rows from the top, each from the left; the middle of the first is (0.5, 0.5). */
typedef struct picture {
    int width;
    int height;
    rgb *at; /* width x height */
} picture;

/** A picture of one colour; false: a side below 1 or above 16384, out of memory (then all zero). */
bool picture_create(picture *p, int width, int height, rgb background);

void picture_free(picture *p);

/** A filled disk, cut off at the edges. Not smoothed: draw twice as large and use picture_shrink. */
void picture_disk(picture *p, double x, double y, double radius, rgb color);

/** A line with round ends. */
void picture_line(picture *p, double x0, double y0, double x1, double y1, double width, rgb color);

/** A filled rectangle from (x0, y0) to (x1, y1). */
void picture_box(picture *p, double x0, double y0, double x1, double y1, rgb color);

/** Makes it `factor` times smaller, each pixel the mean of factor x factor; what does not fill one is cut off. */
void picture_shrink(picture *p, int factor);

/** Copies `from` into p with its upper left corner at (x, y), cut off at the edges. */
void picture_paste(picture *p, const picture *from, int x, int y);

/** Writes a PNG file (png_write.c, which alone needs libpng).
 *
 *  message  [out]  on error what is wrong; may be NULL.
 *  Returns  true; false: the file cannot be written.
 */
bool picture_write_png(const picture *p, const char *path, char *message, size_t message_size);

#endif
