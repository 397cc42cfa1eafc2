/* sparse_product.h: product of two sparse matrices, symmetric storage conversions */
#ifndef TOOLS_SPARSE_PRODUCT_H
#define TOOLS_SPARSE_PRODUCT_H

#include <stdbool.h>

#include "sparse_local.h"

/** C = A B. Matrices are taken as stored (SL_AS_STORED): no triangle is mirrored.
 *
 *  out   [out]  A->n_rows x B->n_cols, rows ascending. It has an entry wherever the product of two
 *               stored entries falls, even if the sum is 0. Release with sl_matrix_free; NULL on
 *               error.
 *  A, B  [in]   with values; the patterns must be valid (sl_csc_check). Duplicates are summed.
 *  Returns  true; false: A->n_cols differs from B->n_rows, no values, 2^31 or more entries, out of
 *           memory.
 *  Cost     O(multiplications + rows + columns) time; 16 bytes of scratch per entry of C.
 *  Source   Gustavson: Two fast algorithms for sparse matrices, ACM TOMS 4(3), 1978; [Davis06] 2.8.
 *  Example  tests/tools/test_polyharmonic.c
 */
bool csc_product(sl_matrix **out, const sl_csc *A, const sl_csc *B);

/** Copies a symmetric matrix that stores one triangle (or both) to one that stores both.
 *
 *  out  [out]  release with sl_matrix_free; NULL on error.
 *  Returns  true; false: not square, no values, malformed, out of memory.
 */
bool csc_expand_symmetric(sl_matrix **out, const sl_csc *A);

/** The lower triangle of the symmetric part (C + C') / 2. C stores both triangles.
 *
 *  out  [out]  release with sl_matrix_free; NULL on error.
 *  Returns  true; false: not square, no values, out of memory.
 */
bool csc_symmetric_part(sl_matrix **out, const sl_csc *C);

/** The position of an entry in the arrays of A, whose rows ascend in each column; the entry must
 *  exist. */
sl_int csc_position(const sl_csc *A, sl_int row, sl_int col);

#endif
