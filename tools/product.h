/* product.h: the product of two sparse matrices, and the symmetric matrix next to a nearly symmetric one */
#ifndef TOOLS_PRODUCT_H
#define TOOLS_PRODUCT_H

#include <stdbool.h>

#include "../sparse_local.h"

/** C = A B, every stored entry for itself (SL_AS_STORED).
 *
 *  out   [out]  A's rows x B's columns, rows ascending, an entry wherever a product of two stored entries falls, also
 *               where the sum is 0; release with sl_matrix_free; NULL on error.
 *  A, B  [in]   with values; patterns are trusted (sl_csc_check). Duplicates count as their sum.
 *  Returns  true; false: A's columns are not B's rows, no values, 2^31 or more entries, out of memory.
 *  Cost     O(products of entries + rows + columns); 16 bytes an entry of C beside it.
 *  Source   Gustavson, Two fast algorithms for sparse matrices, ACM TOMS 4(3), 1978; [Davis06] 2.8.
 *  Example  tests/test_harmonic.c
 */
bool csc_product(sl_matrix **out, const sl_csc *A, const sl_csc *B);

/** A stored as one triangle (or both), as a matrix that stores both triangles.
 *
 *  Returns  true; false: not square, no values, malformed, out of memory.
 */
bool csc_both_triangles(sl_matrix **out, const sl_csc *A);

/** Lower triangle of (C + C') / 2; C stores both triangles.
 *
 *  Returns  true; false: not square, no values, out of memory.
 */
bool csc_symmetrized(sl_matrix **out, const sl_csc *C);

#endif
