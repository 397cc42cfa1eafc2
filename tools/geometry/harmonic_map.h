/* harmonic_map.h: harmonic layouts of a disk in the plane: its boundary, then a Poisson problem */
#ifndef TOOLS_HARMONIC_MAP_H
#define TOOLS_HARMONIC_MAP_H

#include "tools/mesh/disk_patch.h"

/* Two ways to extend a planar boundary to a layout of the disk. N is the cotangent Laplacian of the
 * disk's own faces.
 *
 *  Dirichlet  The boundary is fixed and N x = 0 in the interior: the classic harmonic map
 *             [EDDHLS95]. With a convex boundary and positive weights no face is flipped.
 *  Neumann    The boundary only prescribes the flux that the layout would have there: N x = b, with
 *             b from eq. (3) of [HDA17]. The boundary is free to move. No row of the matrix
 *             changes, so that a factor of the whole mesh can be used (patch_solver.h).
 *
 *  [HDA17]     Herholz, Davis, Alexa: Localized solutions of sparse linear systems for geometry
 *              processing, 2017.
 *  [EDDHLS95]  Eck, DeRose, Duchamp, Hoppe, Lounsbery, Stuetzle: Multiresolution analysis of
 *              arbitrary meshes, 1995.
 *
 * Below, n = d->p.m.n_vertices; uv arrays of the boundary have 2 n_boundary elements: u v of each
 * vertex of d->boundary.
 */

/** Maps the boundary to a circle with the same circumference, spaced by edge length. A boundary of
 *  length 0 is spaced evenly.
 *
 *  uv  [out]  2 n_boundary.
 */
void boundary_to_circle(double *uv, const disk_patch *d);

/** Unrolls the boundary into the plane with its own edge lengths and, up to curvature, its own
 *  angles.
 *
 *  At each boundary vertex the path turns by pi minus the angles of the disk's faces there. In the
 *  plane all turns must sum to 2 pi; the difference, the curvature of the interior, is distributed
 *  by length. So is the gap between the end and the start of the path. The boundary of a flat disk
 *  is reproduced up to rounding. The boundary of a strongly curved disk may intersect itself. If
 *  memory runs out, the result is that of boundary_to_circle.
 *
 *  uv  [out]  2 n_boundary.
 */
void boundary_unroll(double *uv, const disk_patch *d);

/** The right-hand side of the Neumann problem for a boundary in the plane: eq. (3) of [HDA17]. In
 *  its sums over faces only the two neighbors on the boundary remain. Halved, so that the layout of
 *  a flat disk by its own coordinates satisfies N x = b.
 *
 *  b   [out]  n_boundary x 2, column-major.
 *  uv  [in]   2 n_boundary.
 */
void boundary_neumann_rhs(double *b, const double *uv, sl_int n_boundary);

/** Scatters boundary values to the disk: X (n x 2, column-major) is b on the boundary, 0 elsewhere.
 *
 *  b  [in]  n_boundary x 2, column-major.
 */
void boundary_scatter(double *X, const double *b, const disk_patch *d);

/** The Dirichlet layout, by a factorization of the interior.
 *
 *  X   [out]  n x 2, column-major. Interior vertices without weights are placed at the origin.
 *  uv  [in]   2 n_boundary: the fixed boundary.
 *  Returns  SL_OK; SL_ERR_MEMORY; as sl_symbolic_create and sl_factor_create.
 */
sl_status harmonic_dirichlet(double *X, const disk_patch *d, const double *uv);

/** Solves N X = B by a new analysis and factorization of N, as a program without the factor of the
 *  whole mesh has to.
 *
 *  X, B  n x nrhs, column-major without gaps; may be the same. Columns of B must sum to 0 over each
 *        connected component of a singular N.
 *  N     [in]  n x n, one triangle.
 *  Returns  as sl_symbolic_create, sl_factor_create and sl_factor_solve.
 */
sl_status factor_and_solve(double *X, const sl_csc *N, const double *B, sl_int nrhs);

/** Converts X (n x 2, column-major) to uv (u v of each vertex). */
void layout_from_columns(double *uv, const double *X, sl_int n);

/** Converts uv (u v of each vertex) to X (n x 2, column-major). */
void layout_to_columns(double *X, const double *uv, sl_int n);

#endif
