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
 *  opt    [in]   ordering, perm, metis_options, relaxation, allocator; may be NULL.
 *  stats  [out]  the symbolic group; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, perm not a permutation (error_row is the first offending position),
 *           an unknown ordering or relaxation, metis_options that METIS would refuse; SL_ERR_PATTERN;
 *           SL_ERR_UNSUPPORTED: METIS asked for and not compiled in; SL_ERR_ORDERING; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the ordering, then nearly O(nnz(A) + rows of the supernodes).
 *  Threads  METIS is not as quiet as this library. While it runs (SL_ORDERING_METIS, or the default with it) it resets
 *           rand() of the C library by srand() and draws from it, traps SIGABRT and SIGTERM of the whole process, and
 *           prints a line if it runs out of memory. Calls in several threads at once are safe only if rand() is, and
 *           may then order differently from run to run. Other orderings do nothing of this and run in any number of
 *           threads.
 *  Source   [Liu90] elimination tree; [GNP94] counts; [AG89] relaxed supernodes; [KK98] METIS.
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
} sl_symbolic_view_t;

SL_API sl_symbolic_view_t sl_symbolic_view(const sl_symbolic *S);

#endif
