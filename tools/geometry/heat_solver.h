/* heat_solver.h: the two factors of the heat method on a mesh: of M + t L and of L */
#ifndef TOOLS_HEAT_SOLVER_H
#define TOOLS_HEAT_SOLVER_H

#include "intrinsic.h"
#include "tools/mesh/incidence.h"

/* The heat method [CWW13] computes geodesic distances by two linear systems:
 *
 *  1. Heat u flows from the sources for a short time t: (M + t L) u = b, with b = 1 at the sources
 *     and 0 elsewhere.
 *  2. Its normalized negative gradient X = -grad u / |grad u| points away from the sources.
 *  3. The distance d is the function whose gradient is closest to X: L d = div X.
 *
 * L is the cotangent Laplacian, M the lumped mass (laplacian.h). Both matrices have the same
 * pattern: one analysis and two factors per mesh.
 *
 * Choice of t. If sqrt(t) is a few edge lengths, the error of the distance is of the order of the
 * edge length. With the usual value, the square of the mean edge length, heat follows the edge
 * directions too closely: on a regular grid an error of about 1 % remains under refinement. With 4
 * or 8 times this t the error decreases. A larger t rounds off the distance where fronts meet. With
 * a smaller t no heat arrives far away: in double precision none beyond about 700 sqrt(t). Obtuse
 * faces amplify all of these errors: with a small t, heat falls below 0 beyond them and the
 * distances there are wrong. A t for which no heat is negative is therefore large enough.
 *
 *  [CWW13]  Crane, Weischedel, Wardetzky: Geodesics in heat, ACM TOG 32(5), 2013.
 */
typedef struct heat_solver {
    const mesh *m; /* borrowed */
    incidence inc; /* with the lengths of the faces, if these define them */
    double t;
    sl_symbolic *S;         /* of heat */
    sl_symbolic *poisson_S; /* of poisson: S, unless the factors are of two files */
    sl_factor *heat;        /* of M + t L */
    sl_factor *poisson;     /* of L, with SL_PIVOTS_SKIP_NULL */
    sl_work *work;
} heat_solver;

/* Heat below this value is treated as 0: its differences are rounding errors. */
#define HEAT_MIN 1e-290

/** Analyzes and factors both systems.
 *
 *  out  [out]  release with heat_solver_free; all zero on error.
 *  m    [in]   borrowed, must outlive out.
 *  t    [in]   above 0, at most 1e200, in squared units of length.
 *  opt  [in]   allocator of analysis and factors; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: t or a face index is out of range; SL_ERR_MEMORY; as
 *           sl_factor_create.
 */
sl_status heat_solver_create(heat_solver *out, const mesh *m, double t, const sl_options *opt);

/** The same for an intrinsic triangulation: distances along the surface as it has them.
 *
 *  a  [in]  borrowed, must outlive out.
 */
sl_status heat_solver_create_intrinsic(heat_solver *out, const intrinsic *a, double t,
                                       const sl_options *opt);

/** A solver with factors that a solver of the same mesh has made, such as those of two files.
 *
 *  Finds t, and checks that the factors are of this mesh: each solves for random numbers, and the
 *  matrices of the mesh have to return these to 6 digits in every row.
 *
 *  lengths        [in]      of an intrinsic triangulation, whose mesh is then m; else NULL.
 *  heat, poisson  [in,out]  analysis and factor are taken out of the sets, also on error.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a set without a factor; SL_ERR_MALFORMED: the factors are not
 *           of this mesh; SL_ERR_MEMORY; as sl_factor_solve.
 *  Cost     O(entries of both factors).
 *  Example  tests/tools/test_heat_solver.c
 */
sl_status heat_solver_adopt(heat_solver *out, const mesh *m, const double *lengths,
                            sl_saved_set *heat, sl_saved_set *poisson);

/** Refactors M + t L for another t, with the same analysis. On error s can only be freed, unless t
 *  was out of range.
 *
 *  Returns  as heat_solver_create.
 */
sl_status heat_solver_set_time(heat_solver *s, double t);

/** Releases everything and sets s to all zero. */
void heat_solver_free(heat_solver *s);

#endif
