/* complex_inverse.h: entries of the inverse of complex matrices */
#ifndef SL_PUBLIC_COMPLEX_INVERSE_H
#define SL_PUBLIC_COMPLEX_INVERSE_H

#include "complex.h"

/** A dense block of the complex inverse: Z(i, j) = (H^-1)(rows[i], columns[j]).
 *
 *  Z        [out]  n_rows x n_columns complex numbers, real and imaginary parts in turn,
 *                  column-major, leading dimension ldz >= n_rows complex numbers.
 *  rows, columns  [in]  n_rows and n_columns complex rows, any order, repetitions allowed.
 *  W, stats  as in sl_inverse_block; error.row and error.column are complex rows.
 *  Returns  as sl_inverse_block; SL_ERR_ARGUMENT also if F has an odd number of rows.
 *  Cost     sl_inverse_block of 2 n_rows x n_columns entries; allocates the sets.
 *  Threads  as sl_inverse_block.
 *  Example  tests/core/test_complex.c
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                                                         const sl_int *rows, sl_int n_rows,
                                                         const sl_int *columns, sl_int n_columns,
                                                         sl_work *W, sl_stats *stats);

/** Entries of the complex inverse: out[2k] and out[2k + 1] are the real and the imaginary part of
 *  (H^-1)(rows[k], columns[k]).
 *
 *  rows, columns  [in]  count complex rows each, any order, repetitions allowed.
 *  Cost     sl_inverse_pairs of 2 count entries; allocates the sets.
 *  W, stats, Returns, Threads  as sl_complex_inverse_block.
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_inverse_pairs(const sl_factor *F, double *out,
                                                         const sl_int *rows, const sl_int *columns,
                                                         sl_int count, sl_work *W, sl_stats *stats);

#endif
