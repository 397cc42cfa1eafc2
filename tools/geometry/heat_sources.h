/* heat_sources.h: what several sources give off so that all of them are equally warm */
#ifndef TOOLS_HEAT_SOURCES_H
#define TOOLS_HEAT_SOURCES_H

#include "heat_solver.h"

/** Finds b on the sources with u = 1 there, where (M + t L) u = b and b is 0 elsewhere.
 *
 *  With b = 1 at each of many sources, u is larger where they are close together, and its gradient
 *  runs along them as well as away from them. With u = 1 at all of them it runs away from them.
 *
 *  b        [out]  count.
 *  region   [in]   of s->heat, for the solves, or NULL.
 *  sources  [in]   count >= 1 distinct vertices.
 *  Returns  SL_OK; SL_ERR_MEMORY; as sl_plan_create and sl_plan_solve.
 *  Cost     conjugate gradients: 10 to 20 local solves from the sources to the sources.
 *  Example  tests/tools/test_geodesic_exact.c
 */
sl_status heat_sources_balance(double *b, const heat_solver *s, const sl_region *region,
                               const sl_int *sources, sl_int count);

#endif
