/* plot.h: line, point and bar charts as SVG */
#ifndef TOOLS_PLOT_H
#define TOOLS_PLOT_H

#include <stdbool.h>
#include <stddef.h>

typedef enum plot_style { PLOT_LINES, PLOT_DASHES, PLOT_POINTS, PLOT_BARS } plot_style;

/** Data points by series, in the order in which the series were started. */
typedef struct plot plot;

/** Creates an empty plot; NULL: out of memory. Release with plot_free.
 *
 *  title, x_name, y_name  [in]  copied.
 *  log_x, log_y           [in]  true for a logarithmic axis; points that are not positive there are
 *                               omitted.
 */
plot *plot_create(const char *title, const char *x_name, const char *y_name, bool log_x,
                  bool log_y);

/** Adds a point to a series, which the first point of a new name starts. Points that are not finite
 *  are omitted. Bars are as wide as the smallest distance between two of them. False: out of memory
 *  or more than 32 series. */
bool plot_add(plot *p, const char *series, plot_style style, double x, double y);

/** Sets the color of an existing series to color_of_kind(kind). By default each series has the next
 *  color of its own. */
void plot_color(plot *p, const char *series, int kind);

/** Writes the plot, 640 x 420 and wider if there is a legend; false: the file cannot be written. An
 *  empty plot has a title only. */
bool plot_write(const plot *p, const char *path, char *message, size_t message_size);

void plot_free(plot *p);

#endif
