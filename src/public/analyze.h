/* analyse.h: the analysis of a pattern: ordering, elimination tree, supernodes, storage of L */
#ifndef SL_PUBLIC_ANALYSE_H
#define SL_PUBLIC_ANALYSE_H

#include "types.h"

/** Analyses the pattern of a symmetric matrix once, for any number of factorizations with that pattern.
 *
 *  Orders the rows, builds the elimination tree, its postorder, column counts and supernodes, the rows of every
 *  supernode, and the map that carries each entry of A to its place in L.
 *
 *  out    [out]  the analysis, or NULL on error; release with sl_symbolic_free.
 *  A      [in]   n x n, symmetric; values are not read (x may be NULL); not kept.
 *  opt    [in]   ordering, perm, metis_options, coordinates, dimensions, block_size, relaxation, allocator; may be
 *                NULL. block_size and coordinates are not read with SL_ORDERING_GIVEN and _NATURAL, coordinates not
 *                with _METIS and _QUALITY either; but what is wrong in them is refused with any ordering.
 *  stats  [out]  the symbolic group; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, perm not a permutation (error_row is the first offending position),
 *           an unknown ordering or relaxation, metis_options that METIS would refuse, a block_size that does not
 *           divide n, coordinates of other than 2 or 3 dimensions; SL_ERR_NOT_FINITE: a coordinate, error_row is the
 *           first row of its block; SL_ERR_PATTERN; SL_ERR_UNSUPPORTED: METIS asked for and not compiled in;
 *           SL_ERR_ORDERING; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the ordering, then nearly O(nnz(A) + rows of the supernodes).
 *  Threads  METIS is not as quiet as this library. While it runs (SL_ORDERING_METIS and SL_ORDERING_QUALITY only) it
 *           resets rand() of the C library by srand() and draws from it, and prints a line if it runs out of memory.
 *           With SL_ORDERING_METIS it traps SIGABRT and SIGTERM of the whole process meanwhile; with
 *           SL_ORDERING_QUALITY it does not, and raises SIGABRT if it runs out of memory, which ends a process that
 *           has no handler. Calls in several threads at once are safe only if rand() is, and may then order
 *           differently from run to run. All other orderings do nothing of this, run in any number of
 *           threads, and give the same order for the same pattern however it is stored, with METIS compiled in or not.
 *  Source   [George73] nested dissection, [KK98] on levels of coarser graphs, [FM82] moving vertices across a cut, [FF56]
 *           smallest vertex cuts; [Liu90] elimination tree; [GNP94] counts; [AG89] relaxed supernodes.
 *  Example  tests/test_symbolic.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A,
                                                   const sl_options *opt, sl_stats *stats);

/** Releases an analysis; NULL is fine. Factors and plans over it must be gone or never used again. */
SL_API void sl_symbolic_free(sl_symbolic *S);

/** Fills the symbolic group of stats again. */
SL_API void sl_symbolic_stats(const sl_symbolic *S, sl_stats *stats);

/** A look inside: arrays that live as long as the analysis.
 *
 *  Supernode s owns columns super_first[s] .. super_first[s+1]-1 of L, a dense block: its own rows, then the rows
 *  rows[rows_begin[s]] .. rows[rows_begin[s+1]-1] below them, ascending. Supernodes are in postorder.
 *  The numbers of supernode s stand in a panel of row tiles, [tile][column][8], from position panel_begin[s] of
 *  sl_factor_view's L: tile t holds local rows 8t..8t+7 of the columns 0..min(width, 8(t+1))-1; the unit diagonal and
 *  what is above it are stored as 0.
 *
 *  SL_ORDERING_FAST, _BUILTIN and _QUALITY leave their tree of separators (others: n_parts = 0 and NULL): a node is a
 *  separator, or a part that was not cut further. No entry of A joins two nodes unless one of them is above the
 *  other; nodes are numbered in the order of elimination, so that a parent comes after all that it parts.
 */
typedef struct sl_symbolic_view_t {
    sl_int n;
    sl_int n_supers;
    const sl_int *perm;   /* n: perm[k] = row of A that is pivot k */
    const sl_int *iperm;  /* n: its inverse */
    const sl_int *parent; /* n: elimination tree of P A P', -1 at a root */
    const sl_int *counts; /* n: entries of column k of L, diagonal included, without relaxation */
    const sl_int *super_first;  /* n_supers + 1 */
    const sl_int *super_of;     /* n: supernode of column k */
    const sl_int *super_parent; /* n_supers: -1 at a root */
    const sl_off *rows_begin;   /* n_supers + 1 */
    const sl_int *rows;         /* rows_begin[n_supers] */
    const sl_off *panel_begin;  /* n_supers + 1 */
    sl_int n_parts;             /* nodes of the tree of separators */
    const sl_int *part_of;      /* n: the node of column k */
    const sl_int *part_parent;  /* n_parts: the separator round a node, -1 at a root */
    const sl_int *part_level;   /* n_parts: separators round it: 0 at a root */
} sl_symbolic_view_t;

SL_API sl_symbolic_view_t sl_symbolic_view(const sl_symbolic *S);

#endif
