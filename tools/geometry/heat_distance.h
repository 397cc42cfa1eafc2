/* heat_distance.h: geodesic distances by the heat method, whole or within a radius, and cells of the nearest site */
#ifndef TOOLS_HEAT_DISTANCE_H
#define TOOLS_HEAT_DISTANCE_H

#include "incidence.h"

/* The heat method [CWW13]: heat u flows from the sources for a short time, (M + t L) u = 1 at the sources; its
 * gradient points away from them, X = -grad u / |grad u|; the function whose gradient is next to X is the distance:
 * L d = div X. Both matrices have one pattern: one analysis, two factors, once a mesh.
 *
 * Within a radius only vertices of a ball around the sources are touched (ball.h, somewhat wider than the radius):
 *   u on the ball     exact: the rows of the full solve, b at the sources, x on the ball.
 *   X on its faces    exact.
 *   d                 not that of the whole mesh, for X beyond the ball is not known. Either X is cut there (one local
 *                     solve of L d = div X for the X inside, a field that ends at the rim), or nothing flows through
 *                     the rim (a few local solves more, patch_solver.h). Both would be exact if X were a gradient and
 *                     the second needs no more than that; the heat method's X is nearly one.
 * What the method itself approximates, also in full: the distance, by an error of the order of the edges' length if
 * sqrt(t) is some of these. With t the square of one edge the heat follows the directions of the edges too much: on a
 * regular grid an error of about 1 % stays however fine it is; 4 or 8 times that t make it fall. Too large a t rounds
 * off the corners of the distance; with too small a one no heat arrives far away (in double precision beyond some
 * 700 sqrt(t)). Obtuse faces make all of it worse: with a small t heat falls below 0 behind them, and the distances are
 * wrong. So none below 0 is a sign of a t that will do.
 *
 *  [CWW13]  Crane, Weischedel, Wardetzky: Geodesics in heat, ACM TOG 32(5), 2013.
 *  [HHA17]  Herholz, Haase, Alexa: Diffusion diagrams: Voronoi cells and centroids from diffusion, 2017.
 */
typedef struct heat_solver {
    const mesh *m; /* borrowed */
    incidence around;
    double t;
    sl_symbolic *S;
    sl_factor *heat;    /* of M + t L */
    sl_factor *poisson; /* of L, SL_SEMIDEFINITE */
    sl_work *work;
} heat_solver;

/** Factors both systems.
 *
 *  out  [out]  release with heat_solver_free; all zero on error.
 *  t    [in]   above 0; the square of mesh_mean_edge_length is usual.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: t, or a face index out of range; SL_ERR_MEMORY; as sl_factor_create.
 */
sl_status heat_solver_create(heat_solver *out, const mesh *m, double t);

/** Another time: M + t L factored again over the same analysis. On error s can only be freed.
 *
 *  Returns  as heat_solver_create.
 */
sl_status heat_solver_set_time(heat_solver *s, double t);

void heat_solver_free(heat_solver *s);

/** How far to look, and how. All zero: the whole mesh. */
typedef struct heat_reach {
    double radius; /* distances up to here are wanted; 0: all */
    double margin; /* the ball's radius along edges is so many times the radius; 0: HEAT_MARGIN */
    int solves; /* local solves for d: 1 cuts X at the rim, more let nothing flow through it; 0: HEAT_SOLVES */
} heat_reach;

/* Paths of edges are longer than distances by up to 1.4 on a regular grid, less elsewhere. */
#define HEAT_MARGIN 1.5
enum { HEAT_SOLVES = 3 };

/** How wide a ball, along edges, a reach looks at; infinite where all is wanted. */
double heat_reach_width(const heat_reach *r);

#define HEAT_COLD 1e-290 /* below this, differences of heat are rounding */

/** Distances at some vertices. */
typedef struct heat_field {
    sl_int n;
    sl_int *vertices;
    double *distance; /* 0 or more; the smallest at the sources of each connected piece is 0 */
    double *heat;     /* u */
    double *path;     /* the shortest path of edges from a source: no distance is longer */
    sl_int n_ball;    /* vertices that were touched */
    sl_int negative;  /* vertices with less heat than none: t is too small for these obtuse faces */
    sl_int cold;      /* faces where no heat arrived, or that have no shape: no X there */
    int solves;       /* local solves for d that were made */
    sl_stats heat_stats, poisson_stats; /* what they read of the factors */
} heat_field;

/** Finds distances from some vertices.
 *
 *  out      [out]  release with heat_field_free; all zero on error. Vertices beyond the radius, and those that no
 *                  face joins to a source, are not in it.
 *  sources  [in]   count vertices in 0..n-1, none twice.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no source, out of range, twice; SL_ERR_MEMORY.
 *  Cost     with a radius, what the ball has, and the paths of the elimination tree above it; those go where the ball
 *           is asked often (heat_place.h).
 *  Example  tests/test_tools_geodesic.c
 */
sl_status heat_distance(heat_field *out, heat_solver *s, const sl_int *sources, sl_int count,
                        const heat_reach *reach);

void heat_field_free(heat_field *f);

/** Diffusion Voronoi cells [HHA17]: to each vertex the site from which most heat arrives, which for small t is the
 *  nearest one. Exact solves of one system, 8 sites at once; with a radius each site on its own ball only.
 *
 *  site    [out]     n_vertices: the position in `sites` of the nearest, -1 where no heat arrives.
 *  most    [out]     n_vertices: that heat.
 *  sites   [in]      count vertices in 0..n-1, none twice.
 *  radius  [in]      0: the whole mesh. Along edges.
 *  touched [out]     how many rows of x were asked for in all; may be NULL.
 *  tell    [in]      is told, now and then, which share of the sites is done; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: out of range, twice; SL_ERR_MEMORY.
 */
sl_status heat_cells(sl_int *site, double *most, heat_solver *s, const sl_int *sites, sl_int count,
                     double radius, sl_off *touched, void (*tell)(double share));

#endif
