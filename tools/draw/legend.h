/* legend.h: legends of pictures: a color bar with ticks, or keys; a title; in its own font */
#ifndef TOOLS_LEGEND_H
#define TOOLS_LEGEND_H

#include "picture.h"

/** The width of a legend at the right of a picture; 0: the picture is too small for one (below
 *  320 x 200). */
int legend_width(int width, int height);

/** Draws the legend into the last of_size * legend_width columns of a picture: the lines of the
 *  title, and a color bar with five ticks.
 *
 *  of_size    [in]  1 or more: pixels per unit of legend_width; text and lines grow with it.
 *  title      [in]  lines separated by '\n'; letters, digits and . - + = , ( ) are drawn.
 *  low, high  [in]  the values at the ends of the color map.
 *  isolines   [in]  number of levels of isolines, marked in the bar; 0: none.
 */
void legend_draw(picture *p, int of_size, const char *title, double low, double high, int isolines);

/** A color and what it means. */
typedef struct legend_key {
    rgb color;
    char text[32]; /* lines separated by '\n' */
} legend_key;

/** The same with keys in place of the bar: as many as there is room for. */
void legend_draw_keys(picture *p, int of_size, const char *title, const legend_key *keys,
                      int n_keys);

/** Draws a line of text with its upper left corner at (x, y); a character is 6 x 8 times `scale`
 *  pixels, with round strokes. Letters are lower case. */
void legend_text(picture *p, int x, int y, int scale, const char *text);

#endif
