/* edit.h: analyses and factors that follow edits of the pattern: rows and entries come and go */
#ifndef SL_PUBLIC_EDIT_H
#define SL_PUBLIC_EDIT_H

#include "options.h"
#include "stats.h"

/** Analyzes an edited matrix B, starting from the analysis of A, the one before it.
 *
 *  This is for meshes that are remeshed or cut in places. The elimination tree of A is kept where
 *  no neighbors change. If edits are local, the order is about as good as the one before, and
 *  slowly becomes worse than a new one: if stats.edit.is_due is set, create a new analysis when
 *  there is time. If a quarter of the rows have other neighbors, or the edits are not local, this
 *  call does so itself (stats.edit.is_anew).
 *
 *  out     [out]  the analysis of B. It does not depend on S. It has no separator tree, unless it
 *                 is a new one.
 *  S       [in]   an analysis of A.
 *  A       [in]   the matrix that S was created from; values are not read.
 *  B       [in]   n x n, symmetric, any n; values are not read; not kept.
 *  new_of  [in]   rows of A: new_of[i] is the row of B that row i of A has become, or -1 if it is
 *                 gone. Rows of B that do not occur are new.
 *  opt     [in]   allocator, triangle, relaxation; with a new order all that sl_symbolic_create
 *                 reads.
 *  stats   [out]  symbolic, edit.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row of B out of range or twice in new_of (error.row is
 *           the row of A), and as sl_symbolic_create; SL_ERR_OTHER_PATTERN: A does not have the
 *           analyzed pattern; SL_ERR_MALFORMED: B is malformed or not symmetric;
 *           SL_ERR_UNSUPPORTED: S was created with pivots or by sl_factor_submatrix;
 *           SL_ERR_ORDERING; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + nnz + rows of supernodes) with small constants, and the order and analysis of the
 *           columns above the edit. Where 0.1 % of a mesh of 1e6 vertices is remeshed, about 1/14
 *           of a new order and analysis.
 *  Threads  reads S; otherwise as sl_symbolic_create.
 *  Source   [Liu90] elimination trees; [George73] separators; [FF56] minimum vertex cuts.
 *  Manual   tools/docs/changes.md
 *  Example  tests/core/test_symbolic_edit.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_edit(sl_symbolic **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_csc *B,
                                                 const sl_int *new_of, const sl_options *opt,
                                                 sl_stats *stats);

/** Factors an edited matrix B, starting from a factor of A, the one before it.
 *
 *  Columns of L are copied where the supernode and all its descendants have the structure of F and
 *  were computed from the same entries; F knows these by hashes, so new_of and F decide about the
 *  time alone, not about the result. The others are computed. If a whole factorization takes less
 *  time, or F or the options are not suited, this call is one (stats.reuse.is_anew). Solutions are
 *  as accurate as those of a new factor, but their last bits may differ. Copied pivots are not
 *  judged again by the null tolerance, whose default depends on n.
 *
 *  out     [out]  the factor of B. It does not depend on F.
 *  F       [in]   a factor of A. It stays as it is, and so must its analysis during the call.
 *  S       [in]   an analysis of B, such as that of sl_symbolic_edit; kept by out.
 *  B       [in]   n x n, the matrix that S was created from. Two triangles are not compared.
 *  new_of  [in]   as in sl_symbolic_edit; after several edits, the composition of their maps.
 *  opt     [in]   as for sl_factor_create.
 *  stats   [out]  factor, reuse.
 *  Returns  as sl_factor_create; SL_ERR_ARGUMENT: also for new_of, as sl_symbolic_edit;
 *           SL_ERR_STALE: F has no numbers.
 *  Cost     O(n + nnz + rows of supernodes), a copy of L, and stats.reuse.flops. Where 0.1 % of a
 *           mesh of 1e6 vertices is remeshed in one place, about a third of a new factorization; at
 *           most a tenth more than that where little is worth keeping.
 *  Threads  reads F; otherwise as sl_factor_create.
 *  Source   [HA18]
 *  Manual   tools/docs/changes.md
 *  Example  tests/core/test_factor_edit.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_edit(sl_factor **out, const sl_factor *F,
                                               const sl_symbolic *S, const sl_csc *B,
                                               const sl_int *new_of, const sl_options *opt,
                                               sl_stats *stats);

#endif
