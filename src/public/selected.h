/* selected.h: the selected inverse: entries of A^-1 on the pattern of L, all of them or those that some rows reach */
#ifndef SL_PUBLIC_SELECTED_H
#define SL_PUBLIC_SELECTED_H

#include "types.h"

/** Computes entries of A^-1 on the pattern of L: the whole diagonal among them, and every entry of A's pattern.
 *
 *  From the roots of the elimination tree to its leaves, supernode by supernode, with dense kernels. Z_kl of
 *  Z = P A^-1 P' is there wherever a supernode's panel has a place for L_kl, relaxation included; for a set of rows
 *  those supernodes alone are computed that lie on the way from the set to the roots. All numbers have the bits that
 *  the whole gives.
 *
 *  out    [out]  the entries, or NULL on error; release with sl_selected_free. They stay what they are when F is
 *                factored again or released, until sl_selected_refill.
 *  F      [in]   the factor; its analysis is borrowed and must outlive the object.
 *  set    [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (with count ignored): all n.
 *                An empty set is a pointer that is not NULL with count = 0; nothing is read there.
 *  opt    [in]   allocator, and threads, which the object keeps; no threads there, or NULL: those that F was made with. The
 *                instruction set is the factor's.
 *  stats  [out]  the selected group; error_row: a row out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     about twice the flops of the factorization of the same supernodes; z_entries doubles and 28 bytes
 *           a supernode kept, 44 with several threads. While it runs, 8 (height)^2 bytes for each supernode from the one at
 *           hand to its root that has children to come, where height counts its columns and the rows below; with several
 *           threads, for each of them, and for the roots of the subtrees that are shared out, a few dozen.
 *  Threads  reads F; the object is immutable and may be shared. What is computed does not depend on their number.
 *  Source   [ET75]; by supernodes [SelInv].
 *  Example  tests/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_create(sl_selected **out, const sl_factor *F,
                                                   const sl_int *set, sl_int count,
                                                   const sl_options *opt, sl_stats *stats);

/** Computes the same entries again, of what F holds now, in the same memory.
 *
 *  Z      [in,out]  on error as before.
 *  F      [in]      a factor over the analysis that Z was made for.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, or one of another analysis; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     as sl_selected_create; no allocation once W has grown. Where fresh memory is slow, twice as fast.
 *  Threads  nobody else may use Z meanwhile; runs on those that Z was made with.
 *  Example  tests/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_refill(sl_selected *Z, const sl_factor *F, sl_work *W);

/** Releases a selected inverse; NULL is fine. */
SL_API void sl_selected_free(sl_selected *Z);

/** Diagonal entries of A^-1.
 *
 *  Z      [in]
 *  out    [out]  count entries in the order of rows. On error untouched.
 *  rows   [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (with count ignored): all n.
 *  stats  [out]  error_row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: NULL, or a row out of range (error_row); SL_ERR_PATTERN: a row that the object's set
 *           does not reach (error_row).
 *  Cost     O(count), with a logarithm for the object of a set.
 *  Threads  any number at once.
 *  Example  tests/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_diagonal(const sl_selected *Z, double *out,
                                                     const sl_int *rows, sl_int count,
                                                     sl_stats *stats);

/** Entries (A^-1)_ij on the pattern.
 *
 *  Z        [in]
 *  out      [out]  count entries: out[k] is row rows[k], column columns[k], or the other way round. On error untouched.
 *  rows     [in]   count rows of A in 0..n-1.
 *  columns  [in]   count columns of A in 0..n-1.
 *  stats    [out]  error_row and error_column; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: NULL, or out of range; SL_ERR_PATTERN: an entry that is not there, for the pattern
 *           of L has no place for it or the object's set does not reach it. error_row and error_column name it.
 *  Cost     O(count) binary searches.
 *  Threads  any number at once.
 *  Example  tests/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_entries(const sl_selected *Z, double *out,
                                                    const sl_int *rows, const sl_int *columns,
                                                    sl_int count, sl_stats *stats);

/** A look inside: arrays that live as long as the object.
 *
 *  The panel of supernode supers[k] begins at Z[begin[k]] and is laid out as those of L, which sl_symbolic_view_t tells;
 *  the diagonal stands in its place, what is above it in a tile means nothing, and padding is 0.
 */
typedef struct sl_selected_view_t {
    const sl_symbolic *symbolic;
    sl_int count;         /* supernodes */
    const sl_int *supers; /* count, ascending */
    const sl_off *begin;  /* count + 1, in doubles */
    const double *Z;      /* begin[count] */
} sl_selected_view_t;

SL_API sl_selected_view_t sl_selected_view(const sl_selected *Z);

#endif
