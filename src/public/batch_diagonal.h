/* batch_diagonal.h: diagonals of the inverses of many factors by one call */
#ifndef SL_PUBLIC_BATCH_DIAGONAL_H
#define SL_PUBLIC_BATCH_DIAGONAL_H

#include "several.h"

/** Diagonals of several inverses: out(i, k) = (A_k^-1)(rows[i], rows[i]); the bits of
 *  sl_inverse_diagonal.
 *
 *  factors  [in]      count factors of one analysis, repetitions allowed.
 *  out      [out]     n_rows x count, leading dimension ldo >= n_rows. On error untouched.
 *  rows     [in]      n_rows rows of A, any order, repetitions allowed; NULL (n_rows is ignored):
 *                     all n.
 *  opt      [in]      threads; NULL: the calling thread only. Each thread takes whole factors.
 *  works    [in,out]  one workspace per thread, as in sl_batch_solve, or NULL: allocated for this
 *                     call.
 *  failed   [out]     the factor that caused the error, or -1; may be NULL.
 *  stats    [out]     error.row: an index out of range.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range; SL_ERR_STALE: a failed factor;
 *           SL_ERR_MISMATCH: factors of several analyses; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     that of sl_inverse_diagonal for each factor, distributed.
 *  Threads  as sl_inverse_diagonal.
 *  Source   [HDA17] 5.
 *  Example  tests/core/test_batch_inverse.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_diagonal(sl_factor *const *factors, sl_int count,
                                                  double *out, size_t ldo, const sl_int *rows,
                                                  sl_int n_rows, const sl_options *opt,
                                                  sl_work *const *works, sl_int *failed,
                                                  sl_stats *stats);

#endif
