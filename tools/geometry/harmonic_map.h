/* harmonic_map.h: a disk laid out in the plane by harmonic coordinates: its boundary first, then one Poisson problem */
#ifndef TOOLS_HARMONIC_MAP_H
#define TOOLS_HARMONIC_MAP_H

#include "disk.h"

/* Two ways from a boundary in the plane to the layout of all, N being the cotangent Laplacian of the disk's faces:
 *
 *  Dirichlet  the boundary stays where it was laid, inside N x = 0: the classic harmonic map [EDDHLS95]. A convex
 *             boundary and positive weights leave no face turned over.
 *  Neumann    the boundary is only asked for the flux that the layout would have there: N x = b with b of (3) in
 *             [HDA17]. The rim comes to lie where the inside wants it. No row of the matrix changes, so a factor of
 *             the whole mesh serves (patch_solver.h).
 *
 *  [EDDHLS95]  Eck, DeRose, Duchamp, Hoppe, Lounsbery, Stuetzle: Multiresolution analysis of arbitrary meshes, 1995.
 */

/** Lays the boundary on a circle, spaced as its edges are long, with the circumference that the boundary has.
 *
 *  uv  [out]  2 n_boundary: u v of each vertex of d->boundary. A boundary of no length is spaced evenly.
 */
void boundary_on_circle(double *uv, const disk *d);

/** Unrolls the boundary into the plane with its own lengths and, but for what the disk is curved, its own angles.
 *
 *  At each boundary vertex the path turns by pi less the angles of the disk's faces there. In the plane all turns sum
 *  to 2 pi; what is missing to that, the curvature inside, is shared out by length. The gap between the end and the
 *  start is shared out by length too. The boundary of a flat disk comes out as it is, to rounding. Strongly curved
 *  disks may give a boundary that crosses itself.
 */
void boundary_unrolled(double *uv, const disk *d);

/** Right-hand side of the Neumann problem from a boundary in the plane: equation (3) of [HDA17], of whose sums over
 *  faces only the two neighbours on the boundary are left. Halved, so that N x = b holds for the layout of a flat disk
 *  by its own coordinates.
 *
 *  b  [out]  2 n_boundary, b of the first coordinate and then of the second: n_boundary x 2, column-major.
 */
void boundary_neumann(double *b, const double *uv, sl_int n_boundary);

/** Spreads values at the boundary to the disk: X (n x 2, column-major) is 0 off the boundary. */
void boundary_spread(double *X, const double *b, const disk *d);

/** The Dirichlet layout, by factoring the inside of the disk.
 *
 *  X   [out]  n x 2, column-major.
 *  uv  [in]   2 n_boundary.
 *  Returns  SL_OK; SL_ERR_MEMORY. Vertices of the inside that no weight holds come to lie at the origin.
 */
sl_status harmonic_dirichlet(double *X, const disk *d, const double *uv);

/** Solves N X = B (n x nrhs, column-major; columns that sum to 0) by analysing and factoring N anew: what a program
 *  without the whole mesh's factor does. */
sl_status refactor_solve(double *X, const sl_csc *N, const double *B, sl_int nrhs);

/** u v of each vertex from two columns, and back. */
void layout_from_columns(double *uv, const double *X, sl_int n);
void layout_to_columns(double *X, const double *uv, sl_int n);

#endif
