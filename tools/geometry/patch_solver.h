/* patch_solver.h: Poisson problems on a patch by local solves with the factor of the whole mesh */
#ifndef TOOLS_PATCH_SOLVER_H
#define TOOLS_PATCH_SOLVER_H

#include "tools/mesh/submesh.h"

/* Two Poisson problems can be posed on a patch. L is the cotangent Laplacian of the whole mesh, N
 * that of the patch's own faces.
 *
 *  mesh   L x = b, with b given on the patch and 0 elsewhere, x wanted on the patch: one local
 *         solve, exact. Outside the patch x is harmonic, so that the flux that b prescribes on the
 *         interface leaves to both sides of it ([HDA17] section 4).
 *  patch  N x = b: the interface is a free boundary, and only the flux in b crosses it. N is not a
 *         submatrix of L, and a factor of L is not a factor of N. But the rows of N and L differ on
 *         the interface only: L is N plus the contribution of the rest of the mesh, which acts on
 *         the interface much as N does. The iteration x := x + L^-1 (b - N x) leaves a residual on
 *         the interface only and halves it, approximately. Conjugate gradients with this
 *         preconditioner solve the problem to 10 digits in about ten local solves, with b on the
 *         interface and x on the patch.
 *
 * A local solve reads the paths of the elimination tree from the patch to the root, which grow with
 * the mesh. A region of the factor (patch_solver_use_region) cuts them off: the cost of a solve
 * then depends only on the patch. Creating the region takes forward sweeps to the root, one per 8
 * rows of its boundary, so it pays off for patches with many solves.
 *
 * Both problems are singular, by a constant for each connected component (of the patch, for N). x
 * is determined up to these constants. Columns of b must sum to 0 over each component.
 *
 *  [HDA17]  Herholz, Davis, Alexa: Localized solutions of sparse linear systems for geometry
 *           processing, 2017.
 */

/** Plans for a patch, its own Laplacian, and scratch. */
typedef struct patch_solver {
    const sl_factor *F;      /* of L, made with SL_PIVOTS_SKIP_NULL; borrowed */
    const submesh *p;        /* the patch; borrowed */
    sl_matrix *N;            /* lower triangle */
    sl_plan *patch_plan;     /* b and x on the patch */
    sl_plan *interface_plan; /* b on the interface, x on the patch; NULL without an interface */
    sl_region *region;       /* where the sweeps of the plans end; NULL: at the roots */
    sl_work *work;
    sl_stats stats;  /* plan group: what a solve by patch_plan reads; region group: the region */
    double *scratch; /* 4 n PATCH_SOLVER_MAX_RHS */
} patch_solver;

enum { PATCH_SOLVER_MAX_RHS = 4 }; /* right-hand sides per call */

/* Value of options.consistency_tolerance for the factor of the mesh: accept every right-hand side.
 * Close to convergence the residuals are rounding errors, whose sum is as large as their
 * entries. */
#define PATCH_SOLVER_CONSISTENCY (-1.0)

/** Prepares the solver.
 *
 *  out  [out]  release with patch_solver_free; all zero on error.
 *  S    [in]   analysis of the whole mesh's Laplacian; borrowed.
 *  F    [in]   its factor, made with SL_PIVOTS_SKIP_NULL and PATCH_SOLVER_CONSISTENCY; borrowed.
 *  p    [in]   the patch; borrowed.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a vertex of the patch is not in S, or is given twice;
 *           SL_ERR_MEMORY.
 *  Cost     independent of the size of the mesh, except for the height of its elimination tree.
 */
sl_status patch_solver_create(patch_solver *out, const sl_symbolic *S, const sl_factor *F,
                              const submesh *p);

/** Releases what the solver owns and sets s to all zero. */
void patch_solver_free(patch_solver *s);

/** Creates a region of the factor around the patch and confines all further solves to it. Solutions
 *  agree up to rounding, not bit for bit; the cost no longer grows with the mesh around the patch.
 *
 *  s  [in,out]  unchanged on error; if it already has a region, nothing is done.
 *  S  [in]      the analysis that s was created with.
 *  Returns  SL_OK; SL_ERR_MISMATCH: the factor has failed; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     sl_region_create for the vertices of the patch, and both plans again.
 *  Example  tests/tools/test_patch_regions.c
 */
sl_status patch_solver_use_region(patch_solver *s, const sl_symbolic *S);

/** Solves the mesh problem L x = b, by one local solve.
 *
 *  X, B  n x nrhs, column-major without gaps, n = p->m.n_vertices; may be the same array.
 *  nrhs  [in]  0..PATCH_SOLVER_MAX_RHS.
 *  Returns  as sl_plan_solve.
 */
sl_status patch_solver_solve_mesh(patch_solver *s, double *X, const double *B, sl_int nrhs);

/** Solves the patch problem N x = b until ||b - N x|| <= tolerance ||b|| in each column.
 *
 *  X, B    as above, but different arrays.
 *  solves  [in,out]  in: the largest number of local solves, 1 or more; out: the number made.
 *  Returns  SL_OK, also if the tolerance was not reached; SL_ERR_ARGUMENT: nrhs is out of range; as
 *           sl_plan_solve.
 */
sl_status patch_solver_solve_patch(patch_solver *s, double *X, const double *B, sl_int nrhs,
                                   double tolerance, int *solves);

/** Y = N X, both n x nrhs, column-major without gaps.
 *
 *  Returns  as sl_csc_multiply.
 */
sl_status patch_solver_apply(const patch_solver *s, double *Y, const double *X, sl_int nrhs);

#endif
