/* heat_place.h: the surroundings of some vertices, made ready for distances by the heat method again and again */
#ifndef TOOLS_HEAT_PLACE_H
#define TOOLS_HEAT_PLACE_H

#include "ball.h"
#include "heat_distance.h"
#include "patch_solver.h"

/* heat_distance finds a ball, plans it, asks once and forgets it. A place keeps ball and plans, and, where it is asked
 * for, a region of both factors around the ball: distances from whatever sources in it then read what the ball has and
 * nothing of the paths to the root, which grow with the mesh. The regions take forward sweeps to the root, one for every
 * 8 rows of their boundaries; the distances differ from those without by rounding.
 */
typedef struct heat_place {
    heat_solver *s; /* borrowed */
    sl_int n_sources;
    sl_int *sources; /* those it was made for */
    ball b;
    part p;
    patch_solver poisson;
    sl_region *heat_region; /* of the factor of heat; NULL: its plans go to the roots */
} heat_place;

/** Makes ready what is within a distance of some vertices.
 *
 *  out        [out]     release with heat_place_free; all zero on error.
 *  s          [in,out]  borrowed. After heat_solver_set_time only a new place in a region will do.
 *  sources    [in]      count vertices in 0..n-1, none twice.
 *  radius     [in]      along edges: heat_reach_width of what will be asked for; infinity: all that is joined to them.
 *  in_region  [in]      whether to make the regions.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no source, out of range, twice; radius; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     what the ball has, and paths to the root; with regions sl_region_create twice.
 *  Example  tests/test_tools_regions.c
 */
sl_status heat_place_create(heat_place *out, heat_solver *s, const sl_int *sources, sl_int count,
                            double radius, bool in_region);

void heat_place_free(heat_place *h);

/** Finds distances from some vertices of the place.
 *
 *  out      [out]  release with heat_field_free; all zero on error. `path` is infinite where the sources are not those
 *                  that the place was made for.
 *  sources  [in]   count vertices of the place, none twice.
 *  radius   [in]   distances up to here are given; 0: all of the place.
 *  solves   [in]   1 or more, as in heat_reach.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: in a region, and the time is another by now; SL_ERR_MEMORY.
 *  Cost     in a region, that of the ball alone.
 */
sl_status heat_place_distance(heat_field *out, heat_place *h, const sl_int *sources, sl_int count,
                              double radius, int solves);

#endif
