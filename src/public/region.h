/* region.h: regions: parts of the matrix inside which local solves cost the same whatever surrounds them */
#ifndef SL_PUBLIC_REGION_H
#define SL_PUBLIC_REGION_H

#include "types.h"

/* The path from a vertex to the root of the elimination tree grows with the mesh. A region cuts it off: T, whole
 * subtrees of the tree, and S, the boundary, in which all rows of L below them are. For b and x on T and S
 *
 *     y = L_TT^-1 b_T,  u = b_S - L_ST y,  x_S = (A^-1)_SS u,
 *
 * and the backward sweep goes on inside T. With (A^-1)_SS kept, only L inside T is read, and the answer is that of the
 * full solve to rounding. Of an SL_SEMIDEFINITE factor A^-1 is the generalized inverse that its solves apply: 0 in the
 * rows and columns of null pivots; whether b is consistent is not looked at where null rows are outside of the region.
 */

/** Makes the region for a set of rows: what solves with b and x there need of the inverse.
 *
 *  The subtrees are chosen so that a solve with b and x on the whole set reads as little as it can: few large subtrees
 *  have a short boundary and a long way through L, no subtree at all makes the set itself the boundary. Other rows
 *  that happen to be in the subtrees are in the region too.
 *
 *  out    [out]  the region, or NULL on error; release with sl_region_free. For options.region of sl_plan_create.
 *  F      [in]   the factor; it and its analysis are borrowed and must outlive the object. Once it is factored again,
 *                or begun to be, plans in the region are refused until sl_region_refill.
 *  set    [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (with count ignored): all n.
 *                An empty set is a pointer that is not NULL with count = 0; nothing is read there.
 *  Z      [in]   a selected inverse of what F holds now, or NULL. It is read where it has all that is needed, as for
 *                a single row or the subtree of one supernode, which then is taken if it costs a solve no more than
 *                twice as much. Otherwise the entries come from forward sweeps, as those of sl_inverse_block.
 *  opt    [in]   allocator, region_bytes; may be NULL. Subtrees are chosen so that bytes_region keeps within
 *                region_bytes; with no boundary at all, which always is possible, solves go to the roots of the tree.
 *  stats  [out]  the region group; error_row: a row out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, or Z is not of F as it is; SL_ERR_UNSUPPORTED: a factor
 *           whose solves are centred (options.mass); SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     a plan for the set; and a forward sweep of 8 lanes to the roots for every 8 rows of the boundary, with
 *           (boundary)^2 / 2 times the columns of such a path for the sums, or a binary search an entry of Z.
 *           4 (boundary)^2 bytes kept, and some 100 a row of the boundary.
 *  Threads  reads F and Z.
 *  Source   [HDA17] 3 for the sweeps; what is above T enters as a Schur complement, whose inverse is (A^-1)_SS.
 *  Example  tests/test_region.c
 */
SL_API SL_WARN_UNUSED sl_status sl_region_create(sl_region **out, const sl_factor *F,
                                                 const sl_int *set, sl_int count,
                                                 const sl_selected *Z, const sl_options *opt,
                                                 sl_stats *stats);

/** Computes the numbers of a region again, of what F holds now, in the same memory; its plans hold on.
 *
 *  R      [in,out]  on error as before.
 *  F      [in]      a factor over the analysis that R was made for: from now on the only one that fits.
 *  Z      [in]      as in sl_region_create; may be NULL.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, one of another analysis, or Z is not of F as it is;
 *           SL_ERR_UNSUPPORTED: as there; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     as sl_region_create, less the plan; no allocation once W has grown.
 *  Threads  nobody else may use R, or a plan in it, meanwhile.
 *  Example  tests/test_region.c
 */
SL_API SL_WARN_UNUSED sl_status sl_region_refill(sl_region *R, const sl_factor *F,
                                                 const sl_selected *Z, sl_work *W);

/** Releases a region; NULL is fine. */
SL_API void sl_region_free(sl_region *R);

/** Fills the region group of stats again. */
SL_API void sl_region_stats(const sl_region *R, sl_stats *stats);

/** A look inside: arrays that live as long as the object. */
typedef struct sl_region_view_t {
    const sl_symbolic *symbolic;
    sl_int n_roots;
    const sl_int *roots; /* n_roots supernodes, ascending: the subtrees inside hang from them */
    sl_int n_boundary;
    const sl_int *boundary; /* n_boundary rows of A, in the order of elimination */
} sl_region_view_t;

SL_API sl_region_view_t sl_region_view(const sl_region *R);

#endif
