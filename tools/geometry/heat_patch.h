/* heat_patch.h: a patch around some vertices, prepared for repeated heat-method distance queries */
#ifndef TOOLS_HEAT_PATCH_H
#define TOOLS_HEAT_PATCH_H

#include "tools/mesh/graph_ball.h"
#include "heat_solver.h"
#include "patch_solver.h"

/* The patch is a graph ball around some vertices. Within it the heat method (heat_solver.h)
 * computes:
 *
 *  u  exactly: the rows of the full solve, with b on the sources and x on the patch. With several
 *     sources b is such that u = 1 at all of them (heat_sources.h).
 *  X  exactly, on the faces of the patch.
 *  d  not exactly, because X is unknown outside the patch. With one local solve X is set to 0
 *     outside: L d = div X for a field that ends at the interface. With more local solves no flow
 *     crosses the interface (patch_solver_solve_patch). If X were a gradient, the second would be
 *     exact; the heat method's X is close to a gradient.
 *
 * A heat_patch keeps the ball and the plans, and optionally a region of both factors around the
 * ball. With regions, a query reads entries of the patch only and nothing on the paths to the root,
 * which grow with the mesh. A region costs forward sweeps to the root when it is created, one per 8
 * rows of its boundary. Distances with and without regions differ by rounding.
 */

/** Distances at some vertices. */
typedef struct heat_field {
    sl_int n;
    sl_int *vertices; /* n vertices of the mesh */
    double *distance; /* n: 0 or more; the smallest at the sources of each connected piece is 0 */
    double *heat;     /* n: u */
    double *path;     /* n: shortest edge path from a source, an upper bound of the distance */
    sl_int n_patch;   /* vertices of the patch */
    sl_int negative;  /* vertices of the patch with heat below 0: t is too small for obtuse faces */
    sl_int faces_without_gradient; /* faces that no heat reached, or without area: X = 0 there */
    int solves;                    /* local solves for d */
    bool pinned; /* d is held at 0 at all sources, by a factor of the patch: no local solves */
    sl_stats heat_stats, poisson_stats; /* plan and region groups: entries of the factors read */
} heat_field;

/** Releases the arrays and sets f to all zero. */
void heat_field_free(heat_field *f);

typedef struct heat_patch {
    heat_solver *s; /* borrowed */
    sl_int n_sources;
    sl_int *sources; /* the vertices that the patch was created around */
    graph_ball b;    /* the vertices of the patch */
    submesh p;       /* the patch, with the local numbers of b */
    patch_solver poisson;
    sl_region *heat_region; /* of the factor of M + t L; NULL: no regions */
} heat_patch;

/** Prepares the patch within a given distance of some vertices.
 *
 *  out        [out]     release with heat_patch_free; all zero on error.
 *  s          [in,out]  borrowed. After heat_solver_set_time a patch with regions is invalid:
 *                       create a new one.
 *  sources    [in]      count distinct vertices of the mesh.
 *  radius     [in]      edge-path length, usually heat_options_patch_radius of later queries;
 *                       infinity: the whole connected components of the sources.
 *  in_region  [in]      whether to create the regions.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no source, a source out of range or given twice, radius
 *           negative or NaN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(patch + its paths to the root); with regions plus two sl_region_create.
 *  Example  tests/tools/test_patch_regions.c
 */
sl_status heat_patch_create(heat_patch *out, heat_solver *s, const sl_int *sources, sl_int count,
                            double radius, bool in_region);

/** Releases everything but the solver and sets h to all zero. */
void heat_patch_free(heat_patch *h);

/** Computes distances from some vertices of the patch.
 *
 *  out      [out]  release with heat_field_free; all zero on error. `path` is infinite unless the
 *                  sources are those that the patch was created around.
 *  sources  [in]   count distinct vertices of the patch.
 *  radius   [in]   only vertices with a distance up to radius are returned; 0: all of the patch.
 *  solves   [in]   the largest number of local solves for d, 1 or more. With several sources and
 *                  more than 1, d is 0 at all of them, by a factor of the patch's own Laplacian,
 *                  with four solves: X is corrected by the gradient of d three times.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MISMATCH: the patch has regions and the time has
 *           changed; SL_ERR_MEMORY.
 *  Cost     as heat_patch_create; with regions O(patch).
 */
sl_status heat_patch_distance(heat_field *out, heat_patch *h, const sl_int *sources, sl_int count,
                              double radius, int solves);

#endif
