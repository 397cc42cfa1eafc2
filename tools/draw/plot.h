/* plot.h: curves, points and bars with axes, as SVG */
#ifndef TOOLS_PLOT_H
#define TOOLS_PLOT_H

#include <stdbool.h>
#include <stddef.h>

typedef enum plot_style { PLOT_LINES, PLOT_DASHES, PLOT_POINTS, PLOT_BARS } plot_style;

/** Points by series, in the order in which the series first came. */
typedef struct plot plot;

/** An empty plot; NULL: out of memory.
 *
 *  title, x_name, y_name  [in]  copied.
 *  log_x, log_y           [in]  a logarithmic axis: points that are not positive there are left out.
 */
plot *plot_create(const char *title, const char *x_name, const char *y_name, bool log_x,
                  bool log_y);

/** Adds a point to the series of that name (found or begun); bars are as wide as the smallest gap. Not finite: left out.
 *  False: out of memory. */
bool plot_add(plot *p, const char *series, plot_style style, double x, double y);

/** Gives a series that has points a colour, color_of_kind(kind); others get the next of their own. */
void plot_color(plot *p, const char *series, int kind);

/** Writes 640 x 420, wider where there is a legend; false: the file cannot be written. An empty plot has only its title. */
bool plot_write(const plot *p, const char *path, char *message, size_t message_size);

void plot_free(plot *p);

#endif
