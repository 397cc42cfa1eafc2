/* legend.h: the legend of a picture of numbers: color bar with ticks, a title, in its own font */
#ifndef TOOLS_LEGEND_H
#define TOOLS_LEGEND_H

#include "picture.h"

/** The pixels that a legend takes at the right of a picture; 0: the picture is too small for one
 *  (below 320 x 200). */
int legend_width(int width, int height);

/** Draws the legend into the last `width` columns of a picture: the lines of the title, and a color
 *  bar with five ticks.
 *
 *  title      [in]  lines separated by '\n'; letters, digits and . - + = , ( ) are drawn.
 *  low, high  [in]  the values at the ends of the color map.
 *  isolines   [in]  number of levels of isolines, marked in the bar; 0: none.
 */
void legend_draw(picture *p, int width, const char *title, double low, double high, int isolines);

/** Draws a line of text with its upper left corner at (x, y); a character is 6 x 8 times `scale`
 *  pixels. Letters are lower case. */
void legend_text(picture *p, int x, int y, int scale, const char *text);

#endif
