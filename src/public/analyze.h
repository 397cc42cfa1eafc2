/* analyze.h: the analysis of a pattern: ordering, elimination tree, supernodes, storage of L */
#ifndef SL_PUBLIC_ANALYZE_H
#define SL_PUBLIC_ANALYZE_H

#include "options.h"
#include "stats.h"

/** Analyzes the pattern of a symmetric matrix, for any number of factorizations with that pattern.
 *
 *  Orders the rows; computes the elimination tree, supernodes and their row structure; and maps
 *  each entry of A to its position in L. A given or natural order that is not a postorder of the
 *  supernodes is replaced by an equivalent one, of the same fill: sl_symbolic_view's perm is the
 *  order used.
 *
 *  out    [out]  the analysis.
 *  A      [in]   n x n, symmetric; values are not read (x may be NULL); not kept.
 *  opt    [in]   allocator, threads, ordering, relaxation, triangle, perm, block_size, purpose. An
 *                invalid block_size is refused by every ordering.
 *  stats  [out]  symbolic.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, perm is not a permutation (error.row is the first
 *           offending position), or another option that is not allowed; SL_ERR_MALFORMED;
 *           SL_ERR_UNSUPPORTED: METIS is not compiled in; SL_ERR_ORDERING: METIS failed;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the ordering, then nearly O(nnz(A) + rows of the supernodes). Each further thread has
 *           scratch of about the size of the pattern, of which it writes little.
 *  Threads  options.threads, up to 16, distribute the ordering and the entries of A by one call of
 *           the pool, whose threads call the allocator one at a time. Any number of calls at once.
 *           The same result for any number of threads, processor and compiler, except with METIS.
 *  Source   [George73] nested dissection; [KK98] multilevel graphs; [FM82] refinement of
 *           separators; [FF56] minimum vertex cuts; [ADD96] minimum degree; [MR85] trees;
 *           [Liu90] elimination tree, structures of columns; [AG89] relaxed supernodes.
 *  Manual   tools/docs/ordering.md
 *  Example  tests/core/test_symbolic.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A,
                                                   const sl_options *opt, sl_stats *stats);

/** Releases an analysis. Objects made from it keep it as long as they need it. */
SL_API void sl_symbolic_free(sl_symbolic *S);

/** Arrays of an analysis.
 *
 *  Supernode s has columns super_first[s] .. super_first[s+1]-1 of L, stored as one dense panel:
 *  the rows of these columns, then rows rows[rows_begin[s]] .. rows[rows_begin[s+1]-1] below them,
 *  ascending. Supernodes are in postorder. The panel is stored in row tiles, [tile][column][8],
 *  from position panel_begin[s] of sl_factor_view's L: tile t has local rows 8t .. 8t+7 of columns
 *  0 .. min(width, 8(t+1))-1. The unit diagonal and the entries above it are stored as 0. A panel
 *  of one column has only its 1 + rows entries.
 *
 *  Nodes are those of the separator tree, in elimination order: separators, and subgraphs that were
 *  not divided further. An entry of A joins two nodes only if one is an ancestor of the other.
 *  Without such a tree n_nodes = 0 and the arrays are NULL (tools/docs/ordering.md).
 */
typedef struct sl_symbolic_arrays {
    sl_symbolic_info info;
    sl_int n;
    sl_int n_supers;
    const sl_int *perm;         /* n: perm[k] = row of A that is pivot k */
    const sl_int *iperm;        /* n: the inverse of perm */
    const sl_int *parent;       /* n: elimination tree of P A P', -1 at a root */
    const sl_int *counts;       /* n: entries of column k of L with diagonal, without relaxation */
    const sl_int *super_first;  /* n_supers + 1 */
    const sl_int *super_of;     /* n: supernode of column k */
    const sl_int *super_parent; /* n_supers: -1 at a root */
    const sl_off *rows_begin;   /* n_supers + 1 */
    const sl_int *rows;         /* rows_begin[n_supers] */
    const sl_off *panel_begin;  /* n_supers + 1, in doubles */
    const unsigned char *pairs; /* n: 1, 2 at the two columns of a 2x2 pivot, else 0; or NULL */
    sl_int n_nodes;             /* nodes of the separator tree */
    const sl_int *node_of;      /* n: node of column k */
    const sl_int *node_parent;  /* n_nodes: -1 at a root */
    const sl_int *node_level;   /* n_nodes: distance from the root */
    const void *reserved[2];    /* NULL; new fields take their place */
} sl_symbolic_arrays;

/** The statistics of S, and its arrays, valid as long as S; all 0 if S is NULL. */
SL_API sl_symbolic_arrays sl_symbolic_view(const sl_symbolic *S);

#endif
