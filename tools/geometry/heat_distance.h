/* heat_distance.h: geodesic distances and Voronoi cells by the heat method, global or local */
#ifndef TOOLS_HEAT_DISTANCE_H
#define TOOLS_HEAT_DISTANCE_H

#include "heat_patch.h"

/** Options of heat_distance. All zero: the whole mesh. */
typedef struct heat_options {
    double radius; /* largest distance of interest; 0: no limit */
    double margin; /* patch radius along edges / radius; 0: HEAT_MARGIN */
    int solves; /* local solves for d: 1 cuts X at the interface, more let nothing flow through it;
                      0: HEAT_SOLVES */
} heat_options;

/* Shortest edge paths exceed geodesic distances by a factor of up to 1.4 on regular grids, less
 * elsewhere. */
#define HEAT_MARGIN 1.5
enum { HEAT_SOLVES = 3 };

/** The radius, along edges, of the patch that these options use; infinity without a limit. */
double heat_options_patch_radius(const heat_options *r);

/** Computes distances from some vertices.
 *
 *  out      [out]  release with heat_field_free; all zero on error. Vertices beyond the radius, and
 *                  vertices that no face connects to a source, are left out.
 *  sources  [in]   count distinct vertices of the mesh.
 *  options  [in]   NULL: all zero.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no source, a source out of range or given twice, radius or
 *           margin negative or NaN; SL_ERR_MEMORY.
 *  Cost     with a radius O(patch + its paths in the elimination tree to the root). For repeated
 *           queries, heat_patch.h avoids the paths.
 *  Example  tests/tools/test_geodesic.c
 */
sl_status heat_distance(heat_field *out, heat_solver *s, const sl_int *sources, sl_int count,
                        const heat_options *options);

/** Diffusion Voronoi cells [HHA17]: assigns each vertex to the site from which most heat arrives.
 *  For small t this is the nearest site.
 *
 *  The solves are exact, 8 sites at a time; with a radius, each site is solved on its own graph
 *  ball.
 *
 *  site      [out]     n_vertices: position in `sites` of the site, -1 if no heat arrives.
 *  heat      [out]     n_vertices: the heat from that site.
 *  sites     [in]      count distinct vertices of the mesh.
 *  radius    [in]      along edges; 0: the whole mesh.
 *  touched   [out]     total number of rows of x that were computed; may be NULL.
 *  progress  [in]      called with the fraction of the sites that are done; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a site out of range or given twice, radius negative or NaN;
 *           SL_ERR_MEMORY.
 *
 *  [HHA17]  Herholz, Haase, Alexa: Diffusion diagrams: Voronoi cells and centroids from diffusion,
 *           2017.
 */
sl_status heat_cells(sl_int *site, double *heat, heat_solver *s, const sl_int *sites, sl_int count,
                     double radius, sl_off *touched, void (*progress)(double fraction));

#endif
