/* pivots.h: analyses with 2x2 pivots, chosen by the values of an indefinite matrix */
#ifndef SL_PUBLIC_PIVOTS_H
#define SL_PUBLIC_PIVOTS_H

#include "analyze.h"

/** Analyzes a symmetric indefinite matrix, with 1x1 and 2x2 pivots that are chosen by its values.
 *
 *  For matrices without a stable factorization in the order of the pattern, such as KKT systems
 *  with zeros on the diagonal. With these values no entry of L exceeds 100. Factors of other values
 *  keep the pivots: analyze again where sl_factor_refine measures large errors.
 *  SL_PIVOTS_SKIP_NULL gives SL_ERR_UNSUPPORTED. Factors with 2x2 pivots are supernodal; entries of
 *  the inverse, selected inverses and regions refuse them with SL_ERR_UNSUPPORTED.
 *
 *  out    [out]  the analysis. It has no separator tree.
 *  A      [in]   n x n, symmetric, with values; not kept.
 *  opt    [in]   as sl_symbolic_create; the ordering is the one to start from.
 *  stats  [out]  symbolic, pairs and delayed included.
 *  Returns  as sl_symbolic_create; SL_ERR_ARGUMENT: A has no values; SL_ERR_NOT_FINITE: an entry at
 *           error.row, error.column. A singular matrix is analyzed; its factorization is refused.
 *  Cost     two analyses, of which one orders, and a factorization in plain C on one thread, which
 *           keeps its update matrices in memory of their own.
 *  Threads  as sl_symbolic_create.
 *  Source   [DR83] multifrontal with 1x1 and 2x2 pivots.
 *  Manual   tools/docs/indefinite.md
 *  Example  tests/core/test_pivots.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_create_pivoted(sl_symbolic **out, const sl_csc *A,
                                                           const sl_options *opt, sl_stats *stats);

#endif
