/* distance_accuracy.h: compares computed distances with closed forms and with general bounds */
#ifndef TOOLS_DISTANCE_ACCURACY_H
#define TOOLS_DISTANCE_ACCURACY_H

#include <stdbool.h>

#include "heat_patch.h"

/** Prints one line to stdout: mean and largest error of distances to the nearest source.
 *
 *  sources  [in]  count vertices of m.
 *  f        [in]  the computed distances.
 *  sphere   [in]  true: the mesh is a sphere, distances are arcs; false: it is flat, distances are
 *                 straight lines.
 */
void distance_print_accuracy(const mesh *m, const sl_int *sources, sl_int count,
                             const heat_field *f, bool sphere);

/** Prints one line to stdout: the largest violation of two bounds that hold on any surface. A
 *  distance is at least the straight line and at most the shortest edge path. */
void distance_print_bounds(const mesh *m, const sl_int *sources, sl_int count, const heat_field *f);

#endif
