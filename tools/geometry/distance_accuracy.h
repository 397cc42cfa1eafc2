/* distance_checks.h: what is known of distances: closed forms on planes and spheres, bounds on any surface */
#ifndef TOOLS_DISTANCE_CHECKS_H
#define TOOLS_DISTANCE_CHECKS_H

#include <stdbool.h>

#include "heat_distance.h"

/** Prints a line on the errors against the closed form, from the nearest of count sources: straight lines, or arcs on
 *  the sphere that the mesh is. */
void distance_print_errors(const mesh *m, const sl_int *sources, sl_int count, const heat_field *f,
                           bool sphere);

/** Prints a line on what holds on any surface: no distance is shorter than the straight line nor longer than a path of
 *  edges. */
void distance_print_bounds(const mesh *m, const sl_int *sources, sl_int count, const heat_field *f);

#endif
