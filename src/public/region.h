/* region.h: regions, inside which the cost of local solves does not depend on the whole matrix */
#ifndef SL_PUBLIC_REGION_H
#define SL_PUBLIC_REGION_H

#include "options.h"
#include "stats.h"

/* The path from a vertex to the root of the elimination tree grows with the mesh. A region cuts it
 * off. It consists of T, the columns of whole subtrees, and S, the boundary: every row outside T in
 * which a column of T has an entry of L. For b and x on T and S
 *
 *     y = L_TT^-1 b_T,  u = b_S - L_ST y,  x_S = (A^-1)_SS u,
 *
 * and the backward sweep continues in T. The region keeps (A^-1)_SS, so that a solve reads L in T
 * only and gives the answer of the full solve up to rounding. If null pivots were skipped, A^-1 is
 * the generalized inverse that solves apply: 0 in the rows and columns of null pivots. Consistency
 * of b is then checked only for null rows inside the region, and where components have several null
 * vectors (options.null_vector_count), only if the region has no boundary.
 *
 * If pivots have both signs and L has grown in T, u is so large that the rounding of (A^-1)_SS
 * shows: solves would lose the square of stats.factor.growth. Where a bound on that exceeds 1e-8,
 * relative to an entry of the inverse, a region is refused with SL_ERR_INACCURATE; local solves
 * without it are right.
 */

/** Creates the region of a set of rows: what solves with b and x in the set need of the inverse.
 *
 *  The subtrees are chosen so that a solve with b and x on the whole set reads as few numbers as
 *  possible; all of their rows belong to the region. With none, the set itself is the boundary.
 *
 *  out    [out]  the region. For options.region of sl_plan_create.
 *  F      [in]   the factor, whose analysis the object keeps. When F is refactored, or a
 *                refactorization fails, plans in the region are refused until sl_region_refactor.
 *  set    [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL: all, or none.
 *  Z      [in]   a selected inverse of the present numbers of F, or NULL. It is used if it contains
 *                all entries needed, for example those of a single row or of the subtree of one
 *                supernode; such a region is then preferred if it costs a solve at most twice as
 *                much. Otherwise forward sweeps compute the entries, as in sl_inverse_block.
 *  opt    [in]   allocator, region_bytes. Subtrees are chosen so that stats.region.bytes is at most
 *                region_bytes. If only a region without boundary fits, solves go to the roots of
 *                the tree.
 *  stats  [out]  region; error.row: a row out of range.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE: failed factor, or Z is not of the present F;
 *           SL_ERR_UNSUPPORTED: a factor made with options.mass or with 2x2 pivots;
 *           SL_ERR_INACCURATE: solves would lose digits; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     a plan for the set; for every 8 rows of the boundary one forward sweep of 8 lanes to
 *           the roots, and (boundary)^2 / 2 times the columns of such a path for the sums, or one
 *           binary search per entry of Z. Keeps 4 (boundary)^2 bytes and about 100 per row of the
 *           boundary.
 *  Threads  reads F and Z.
 *  Source   [HDA17] 3
 *  Example  tests/core/test_region.c
 */
SL_API SL_WARN_UNUSED sl_status sl_region_create(sl_region **out, const sl_factor *F,
                                                 const sl_int *set, sl_int count,
                                                 const sl_selected *Z, const sl_options *opt,
                                                 sl_stats *stats);

/** Recomputes a region from the present numbers of F, in the same memory; its plans stay valid.
 *
 *  R      [in,out]  unchanged on error; but after SL_ERR_INACCURATE its plans are refused with
 *                   SL_ERR_STALE until the next sl_region_refactor that succeeds.
 *  F      [in]      a factor over the analysis that R was made for; from now on the only one that R
 *                   accepts.
 *  Z      [in]      as in sl_region_create; may be NULL.
 *  Returns  as sl_region_create; SL_ERR_MISMATCH: a factor of another analysis; SL_ERR_READ_ONLY: R
 *           is mapped.
 *  Cost     as sl_region_create without the plan; no allocation once W has grown.
 *  Threads  exclusive use of R and of its plans.
 */
SL_API SL_WARN_UNUSED sl_status sl_region_refactor(sl_region *R, const sl_factor *F,
                                                   const sl_selected *Z, sl_work *W);

/** Releases a region. */
SL_API void sl_region_free(sl_region *R);

/** Arrays of a region. */
typedef struct sl_region_arrays {
    sl_region_info info;
    const sl_symbolic *symbolic;
    sl_int n_roots;
    const sl_int *roots; /* n_roots supernodes, ascending: roots of the interior subtrees */
    sl_int n_boundary;
    const sl_int *boundary;  /* n_boundary rows of A, in elimination order */
    const void *reserved[2]; /* NULL; new fields take their place */
} sl_region_arrays;

/** The statistics of R, and its arrays, valid as long as R; all 0 if R is NULL. O(subtrees). */
SL_API sl_region_arrays sl_region_view(const sl_region *R);

#endif
