/* triplets.h: a growing list of matrix entries (i, j, value), and its conversion to a matrix */
#ifndef TOOLS_TRIPLETS_H
#define TOOLS_TRIPLETS_H

#include <stdbool.h>
#include <stddef.h>

#include "sparse_local.h"

/** Entry k is x[k] at row i[k], column j[k]. All zero is an empty list. */
typedef struct triplets {
    size_t count;
    size_t capacity; /* elements at each of i, j, x */
    sl_int *i;
    sl_int *j;
    double *x;
} triplets;

/** Ensures room for `capacity` entries in total.
 *
 *  Returns  true; false: out of memory, the list is unchanged.
 */
bool triplets_reserve(triplets *t, size_t capacity);

/** Appends an entry. The capacity doubles when the list is full.
 *
 *  Returns  true; false: out of memory, the list is unchanged.
 */
bool triplets_add(triplets *t, sl_int i, sl_int j, double x);

/** Converts the list to a matrix, summing duplicates. Releases the list, also on error.
 *
 *  out          [out]  n_rows x n_cols, release with sl_matrix_free; NULL on error.
 *  with_values  [in]   false: a pattern without values.
 *  Returns  as sl_matrix_from_triplets.
 */
sl_status triplets_finish(sl_matrix **out, sl_int n_rows, sl_int n_cols, triplets *t,
                          bool with_values);

/** Releases the arrays and sets t to all zero. */
void triplets_free(triplets *t);

#endif
