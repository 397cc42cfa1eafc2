/* analyze.h: the analysis of a pattern: ordering, elimination tree, supernodes, storage of L */
#ifndef SL_PUBLIC_ANALYZE_H
#define SL_PUBLIC_ANALYZE_H

#include "options.h"
#include "stats.h"

/** Analyzes the pattern of a symmetric matrix, for any number of factorizations with that pattern.
 *
 *  Orders the rows; computes the elimination tree, its postorder, column counts, supernodes and
 *  their row structure; and maps each entry of A to its position in L.
 *
 *  SL_ORDERING_GIVEN and SL_ORDERING_NATURAL keep the caller's order if it is a postorder of the
 *  supernodes: the columns of each supernode are consecutive, and so are those of each subtree of
 *  supernodes. L is stored in this form. Any other order is replaced by an equivalent one, with the
 *  same fill and the same elimination tree up to numbering: the columns of a supernode keep the
 *  caller's order, and sibling subtrees follow each other by their last columns. With
 *  SL_RELAXATION_NONE every postorder of the elimination tree is kept; the default relaxation may
 *  move a small supernode next to the parent it merges into. sl_symbolic_view's perm is the order
 *  used.
 *
 *  SL_ORDERING_ND is nested dissection. On graphs whose degrees vary, such as networks and KKT
 *  systems, it also tries minimum degree, and takes that if both L and the paths to the roots have
 *  fewer entries. Dissection is not tried where it cannot win: if nearly all operations of minimum
 *  degree are in one dense block, and on KKT systems with a diagonal Hessian and paths as short as
 *  those of plane meshes.
 *
 *  Where one row in 8 or more has at most two neighbors, SL_ORDERING_ND and SL_ORDERING_MINDEG
 *  eliminate such rows first. This repeats while rows with at most two neighbors are left. Paths in
 *  a tree or a chain of n rows then have O(log n) columns, and with minimum degree a tree has no
 *  fill.
 *
 *  The other orderings treat a row that stores no diagonal entry and has 8 neighbors or more, and
 *  sqrt(n) or more, as a constraint, such as m in [L m; m' 0]: they never order it after all of its
 *  neighbors, so that no pivot of a singular Laplacian L is null. A corner that stores a zero hides
 *  this.
 *
 *  out    [out]  the analysis, or NULL on error; release with sl_symbolic_free.
 *  A      [in]   n x n, symmetric; values are not read (x may be NULL); not kept.
 *  opt    [in]   allocator, threads, ordering, relaxation, triangle, perm, metis_options,
 *                block_size, purpose; may be NULL. block_size is used by all but
 *                SL_ORDERING_GIVEN and SL_ORDERING_NATURAL; every ordering refuses an invalid one.
 *  stats  [out]  symbolic; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, perm is not a permutation (error.row is the first
 *           offending position), an unknown ordering, purpose, relaxation or triangle,
 *           metis_options that METIS would refuse, a block_size that does not divide n;
 *           SL_ERR_PATTERN; SL_ERR_UNSUPPORTED: METIS is not compiled in; SL_ERR_ORDERING;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the ordering, then nearly O(nnz(A) + rows of the supernodes). Each further thread has
 *           scratch of about the size of the pattern, of which it writes little.
 *  Threads  options.threads, up to 16, distribute the subgraphs of SL_ORDERING_ND and, except with
 *           SL_ORDERING_METIS, the entries of A, with the same result for any number of them. The
 *           call is one call of the pool; any of its threads may call the allocator, one at a time.
 *           Small systems use fewer threads. Any number of calls at once, with the same result for
 *           the same pattern however it is stored, on every processor and with every compiler,
 *           except with METIS: METIS seeds and draws from rand() of the C library and prints a line
 *           if it runs out of memory. During SL_ORDERING_METIS it traps SIGABRT and SIGTERM of the
 *           whole process. Concurrent calls with METIS are safe only if rand() is, and may then
 *           order differently from run to run.
 *  Source   [George73] nested dissection; [KK98] multilevel graphs; [FM82] refinement of
 *           separators; [FF56] minimum vertex cuts; [ADD96] minimum degree; [MR85] trees;
 *           [Liu90] elimination tree, structures of columns; [AG89] relaxed supernodes.
 *  Example  tests/core/test_symbolic.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A,
                                                   const sl_options *opt, sl_stats *stats);

/** Analyzes a symmetric indefinite matrix, with pivots that are chosen by its values.
 *
 *  For matrices that have no stable factorization with a diagonal D in the order of the pattern,
 *  such as KKT systems with zeros on the diagonal or an indefinite H. A factorization selects 1x1
 *  and 2x2 pivots by threshold partial pivoting: with these values no entry of L exceeds 100. A
 *  column without an acceptable pivot in its front is delayed: it moves up to the parent's front.
 *  The result is analyzed in the order of the pivots, and D of its factors has 2x2 blocks.
 *
 *  The pivots are those of the values of A. Factors of other values keep them, and are then no more
 *  accurate than in any fixed order: check stats.factor.growth, as with any indefinite matrix
 *  (sl_factor_create), and analyze again if it is large. All calls work on these factors except the
 *  following.
 *  - If there are 2x2 pivots, factors use the supernodal method, whatever options.method, and
 *    entries of the inverse, selected inverses and regions give SL_ERR_UNSUPPORTED.
 *  - SL_NULL_PIVOT_SKIP gives SL_ERR_UNSUPPORTED.
 *  - With options.regularization and no signs, pivots of both signs are right, and only null ones
 *    are replaced. Signs do not apply to 2x2 pivots. A null one is shifted in both rows.
 *
 *  out    [out]  the analysis, or NULL on error; release with sl_symbolic_free. It has no separator
 *                tree.
 *  A      [in]   n x n, symmetric, with values; not kept.
 *  opt    [in]   as sl_symbolic_create; the ordering is the one to start from.
 *  stats  [out]  symbolic, pairs and delayed included; may be NULL.
 *  Returns  as sl_symbolic_create; SL_ERR_ARGUMENT: A has no values; SL_ERR_NOT_FINITE: an entry at
 *           error.row, error.column. A singular matrix is analyzed; its factorization is refused.
 *  Cost     two analyses, of which one orders, and a factorization in plain C on one thread, which
 *           keeps its update matrices in memory of their own.
 *  Threads  as sl_symbolic_create.
 *  Source   [DR83] multifrontal with 1x1 and 2x2 pivots.
 *  Example  tests/core/test_pivots.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_create_pivoted(sl_symbolic **out, const sl_csc *A,
                                                           const sl_options *opt, sl_stats *stats);

/** Releases an analysis; NULL is allowed. Objects made from it must not be used afterwards. */
SL_API void sl_symbolic_free(sl_symbolic *S);

/** Fills the symbolic group of stats. */
SL_API void sl_symbolic_stats(const sl_symbolic *S, sl_stats *stats);

/** Arrays of an analysis; valid as long as the analysis.
 *
 *  Supernode s has columns super_first[s] .. super_first[s+1]-1 of L, stored as one dense panel:
 *  the rows of these columns, then rows rows[rows_begin[s]] .. rows[rows_begin[s+1]-1] below them,
 *  ascending. Supernodes are in postorder. The panel is stored in row tiles, [tile][column][8],
 *  from position panel_begin[s] of sl_factor_view's L: tile t has local rows 8t .. 8t+7 of columns
 *  0 .. min(width, 8(t+1))-1. The unit diagonal and the entries above it are stored as 0.
 *
 *  SL_ORDERING_ND keeps its separator tree. With other orderings, with minimum degree, if rows with
 *  few neighbors were eliminated first, and if a constraint was moved, n_nodes = 0 and the arrays
 *  are NULL. A node is a separator, or a subgraph that was not divided further. An entry of A joins
 *  two nodes only if one is an ancestor of the other. Nodes are numbered in elimination order, so
 *  that a separator follows the subgraphs that it separates.
 */
typedef struct sl_symbolic_arrays {
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
} sl_symbolic_arrays;

SL_API sl_symbolic_arrays sl_symbolic_view(const sl_symbolic *S);

#endif
