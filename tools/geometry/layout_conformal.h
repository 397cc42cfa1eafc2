/* layout_conformal.h: conformal layouts: with given places of some vertices, or spectral ones */
#ifndef TOOLS_LAYOUT_CONFORMAL_H
#define TOOLS_LAYOUT_CONFORMAL_H

#include "layout.h"
#include "layout_start.h"

/* The conformal energy of a layout is its Dirichlet energy minus its area in the plane: 0 if all
 * angles are preserved, else positive. Its Hessian C has the null space of similarities on flat
 * surfaces, and of translations on others. */

/** The layout with the least conformal energy in which the fixed vertices of l stay where uv has
 *  them: at least two, at different places.
 *
 *  uv  [in,out]  2 n_vertices.
 *  Returns  as layout_minimize.
 *  Source   Levy, Petitjean, Ray, Maillot: Least squares conformal maps, 2002.
 */
sl_status layout_lscm(layout *l, double *uv);

/** How layout_spectral has ended. */
typedef struct layout_spectrum {
    double lambda;   /* conformal energy over the sum of squares at the boundary */
    double residual; /* ||C x - lambda B x|| / ||B x|| */
    double change;   /* sine of the angle between the last two iterates, up to rotations */
    int iterations;
} layout_spectrum;

/** The layout with the least conformal energy among all with sum of |u|^2 = 1 and mean 0 over the
 *  boundary vertices: the eigenvector of C x = lambda B x for the smallest eigenvalue above those
 *  of the constants, by inverse iteration from uv.
 *
 *  l       [in,out]  without fixed vertices.
 *  uv      [in,out]  2 n_vertices; not constant on the boundary.
 *  limit   [in]      the largest number of iterations; they end when one changes 1e-7 or less.
 *  Returns  SL_OK; SL_ERR_MEMORY; SL_ERR_NOT_FINITE: constant on the boundary; as layout_factor.
 *  Source   Mullen, Tong, Alliez, Desbrun: Spectral conformal parameterization, 2008.
 *  Example  tests/tools/test_layout.c
 */
sl_status layout_spectral(layout *l, double *uv, const layout_boundary *b, int limit,
                          layout_spectrum *how);

#endif
