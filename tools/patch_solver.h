/* patch_solver.h: Poisson problems on a part of a mesh, solved by local solves on the factor of the whole mesh */
#ifndef TOOLS_PATCH_SOLVER_H
#define TOOLS_PATCH_SOLVER_H

#include "part.h"

/* Two problems that a part can mean, L the cotangent Laplacian of the whole mesh, N that of the part's faces alone:
 *
 *  mesh    L x = b, b given on the part and 0 beyond it, x wanted on the part: one local solve, exact. Beyond the
 *          part x goes on, harmonic; so the flux that b puts on the rim leaves to both sides of it [HDA17] 4.
 *  part    N x = b: the rim is a free boundary, through which nothing flows but what b says. N is not a submatrix of
 *          L, and L's factor is not its factor. But the rows of N and L differ on the rim alone, and L is N plus
 *          what the rest of the mesh adds there, which acts on the rim much as N does: x := x + L^-1 (b - N x) leaves
 *          a residual on the rim alone, about half of it each time. Conjugate gradients do the rest: some ten local
 *          solves, b on the rim and x on the part, give N's solution to 10 digits.
 *
 * Both are singular, by a constant for each connected component (for N: of the part); x is right up to such constants.
 * Columns of b must sum to 0 over each component.
 */

/** Plans of the part, its own Laplacian, and scratch. */
typedef struct patch_solver {
    const sl_factor *F; /* of L, SL_SEMIDEFINITE; borrowed */
    const part *p;      /* borrowed */
    sl_matrix *N;       /* lower triangle */
    sl_plan *whole;     /* b and x on the part */
    sl_plan *from_rim;  /* b on the rim, x on the part; NULL where there is no rim */
    sl_work *work;
    sl_stats stats; /* the plan group: what a solve by `whole` reads */
    double *scratch;
} patch_solver;

enum { PATCH_SOLVER_MOST = 4 }; /* right-hand sides at once */

/** Makes it.
 *
 *  out  [out]  release with patch_solver_free; all zero on error.
 *  S    [in]   analysis of the mesh's Laplacian; borrowed.
 *  F    [in]   its factor, made with SL_SEMIDEFINITE and consistency_tolerance < 0, as residuals of the part's problem are
 *               solved for that are all rounding; borrowed.
 *  p    [in]   borrowed.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: the part has vertices that S has not, or one twice; SL_ERR_MEMORY.
 *  Cost     nothing that depends on the size of the mesh, but for the depth of its elimination tree.
 */
sl_status patch_solver_create(patch_solver *out, const sl_symbolic *S, const sl_factor *F,
                              const part *p);

void patch_solver_free(patch_solver *s);

/** Solves the mesh's problem, by one local solve.
 *
 *  X, B  n x nrhs, column-major without gaps, n = p->m.n_vertices; may be the same.
 *  nrhs  [in]   0..PATCH_SOLVER_MOST.
 */
sl_status patch_solver_mesh(patch_solver *s, double *X, const double *B, sl_int nrhs);

/** Solves the part's own problem, until ||b - N x|| <= tolerance ||b|| in each column.
 *
 *  X, B    as above, but not the same.
 *  solves  [in,out]  in: how many local solves at most, 1 or more; out: how many were made.
 *  Returns  SL_OK, also where the tolerance was not met within `solves`; errors as sl_plan_solve.
 */
sl_status patch_solver_part(patch_solver *s, double *X, const double *B, sl_int nrhs,
                            double tolerance, int *solves);

/** Y = N X. */
sl_status patch_solver_apply(const patch_solver *s, double *Y, const double *X, sl_int nrhs);

#endif
