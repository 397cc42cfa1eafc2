/* selected.h: the selected inverse: entries of A^-1 on the pattern of L */
#ifndef SL_PUBLIC_SELECTED_H
#define SL_PUBLIC_SELECTED_H

#include "options.h"
#include "stats.h"

/** Computes entries of A^-1 on the pattern of L, which includes the diagonal and the pattern of A.
 *
 *  Works from the roots of the elimination tree to its leaves, supernode by supernode, with dense
 *  kernels. Z_kl of Z = P A^-1 P' is computed if the panel of a supernode has an entry L_kl,
 *  including the entries that relaxation adds. For a set of rows only the supernodes on the paths
 *  from the set to the roots are computed. All numbers have the same bits as in the complete
 *  selected inverse. Where that would lose digits, as pivots have both signs (inverse.h), the
 *  columns are solved for, up to 8 at a time. Entries of null pivots that were skipped are 0. If
 *  regularization changed pivots, the inverse is that of A + E.
 *
 *  out    [out]  the selected inverse. It does not change if F is refactored or released, until
 *                sl_selected_refactor.
 *  F      [in]   the factor; its analysis is kept by the object.
 *  set    [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL: all, or none.
 *  opt    [in]   allocator, threads. The object keeps the threads; without, those of F. The
 *                instruction set is that of F.
 *  stats  [out]  selected; error.row: a row out of range.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_UNSUPPORTED: 2x2 pivots; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     about twice the flops of the factorization of the same supernodes; of columns that are
 *           solved for, some 10 to 100 times as long. Keeps entries doubles (stats.selected) and 28
 *           bytes per supernode, 44 with several threads. Temporary memory: 8 bytes for each pair
 *           of rows of an active front: one on the path from the current supernode of a thread to
 *           its root that has unvisited children, and the few dozen roots of subtrees that threads
 *           share.
 *  Threads  reads F; the object may be shared. The same bits for any number of threads.
 *  Source   [ET75]; supernodal: [SelInv].
 *  Example  tests/core/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_create(sl_selected **out, const sl_factor *F,
                                                   const sl_int *set, sl_int count,
                                                   const sl_options *opt, sl_stats *stats);

/** Computes the same entries from the present numbers of F, in the same memory.
 *
 *  Z      [in,out]  unchanged on error.
 *  F      [in]      a factor over the analysis that Z was made for.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_MISMATCH: a factor of another analysis;
 *           SL_ERR_READ_ONLY: Z is mapped; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     as sl_selected_create; no allocation once W has grown. Up to twice as fast, since the
 *           memory is mapped already.
 *  Threads  exclusive use of Z; runs on the threads that Z was made with.
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_refactor(sl_selected *Z, const sl_factor *F,
                                                     sl_work *W);

/** Releases a selected inverse. */
SL_API void sl_selected_free(sl_selected *Z);

/** Entries (A^-1)_ij on the pattern of L, or diagonal entries.
 *
 *  out      [out]  count entries: out[k] is the entry of rows[k] and columns[k]. On error
 *                  untouched.
 *  rows     [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL: count is
 *                  SL_ALL or n, all rows, or 0; columns is NULL then.
 *  columns  [in]   count columns of A in 0..n-1; NULL: columns = rows, the diagonal.
 *  stats    [out]  error.row, and error.column if columns are given.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: NULL, or an index out of range; SL_ERR_OTHER_PATTERN: an entry
 *           (error) that is not in the pattern of L or that the set of Z does not reach.
 *  Cost     O(count) binary searches; of the diagonal O(count), with a logarithmic factor if Z was
 *           made for a set.
 *  Threads  any number at once.
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_entries(const sl_selected *Z, double *out,
                                                    const sl_int *rows, const sl_int *columns,
                                                    sl_int count, sl_stats *stats);

/** Arrays of a selected inverse.
 *
 *  The panel of supernode supers[k] begins at Z[begin[k]] and has the layout of the panels of L,
 *  described at sl_symbolic_arrays. Unlike there, the diagonal is stored; entries above it within a
 *  tile are unspecified, and padding is 0. Cost: O(supernodes kept).
 */
typedef struct sl_selected_arrays {
    sl_selected_info info; /* seconds: of the last sl_selected_create or sl_selected_refactor */
    const sl_symbolic *symbolic;
    sl_int count;            /* supernodes */
    const sl_int *supers;    /* count, ascending */
    const sl_off *begin;     /* count + 1, in doubles */
    const double *Z;         /* begin[count] */
    const void *reserved[2]; /* NULL; new fields take their place */
} sl_selected_arrays;

/** The statistics of Z, and its arrays, valid as long as Z; all 0 if Z is NULL. */
SL_API sl_selected_arrays sl_selected_view(const sl_selected *Z);

#endif
