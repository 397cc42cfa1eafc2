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
 * The path of the elimination tree from a part to the root grows with the mesh, and each solve reads it. A region of the
 * factor (patch_solver_confine) cuts it off: what a solve then costs depends on the part alone. Making it takes forward
 * sweeps to the root, one for every 8 rows of the region's boundary, so that it pays for parts that are asked often.
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
    sl_region *region;  /* where the plans' sweeps end; NULL: at the roots */
    sl_work *work;
    sl_stats
        stats; /* the plan group: what a solve by `whole` reads; once confined, the region group */
    double *scratch;
} patch_solver;

enum { PATCH_SOLVER_MOST = 4 }; /* right-hand sides at once */

/* options.consistency_tolerance of the mesh's factor: nothing is refused. Near their end the corrections of a part's own
 * problem have right-hand sides that are rounding, as large in their sum as in themselves. */
#define PATCH_SOLVER_CONSISTENCY (-1.0)

/** Makes it.
 *
 *  out  [out]  release with patch_solver_free; all zero on error.
 *  S    [in]   analysis of the mesh's Laplacian; borrowed.
 *  F    [in]   its factor, made with SL_SEMIDEFINITE and PATCH_SOLVER_CONSISTENCY; borrowed.
 *  p    [in]   borrowed.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: the part has vertices that S has not, or one twice; SL_ERR_MEMORY.
 *  Cost     nothing that depends on the size of the mesh, but for the depth of its elimination tree.
 */
sl_status patch_solver_create(patch_solver *out, const sl_symbolic *S, const sl_factor *F,
                              const part *p);

void patch_solver_free(patch_solver *s);

/** Has all further solves end at the boundary of a region around the part: the same answers to rounding, not to the bit,
 *  at a cost that does not grow with the mesh around it.
 *
 *  s  [in,out]  on error as before; a second time, nothing is made.
 *  S  [in]      the analysis that s was made for.
 *  Returns  SL_OK; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     sl_region_create for the part's vertices, and both plans again.
 *  Example  tests/test_tools_regions.c
 */
sl_status patch_solver_confine(patch_solver *s, const sl_symbolic *S);

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
