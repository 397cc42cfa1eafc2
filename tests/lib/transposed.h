/* transposed.h: the transpose of a matrix, by triplets */
#ifndef TESTS_LIB_TRANSPOSED_H
#define TESTS_LIB_TRANSPOSED_H

#include "test.h"

/* Rows are ascending; duplicates are summed. */
static inline sl_matrix *transposed(const sl_csc *A) {
    const sl_int count = A->p[A->n_cols];
    sl_int *columns = test_ints((size_t)count);
    sl_matrix *T = NULL;
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int q = A->p[j]; q < A->p[j + 1]; q++) {
            columns[q] = j;
        }
    }
    SL_CHECK(sl_matrix_from_triplets(&T, A->n_cols, A->n_rows, count, columns, A->i, A->x, NULL,
                                     NULL));
    free(columns);
    return T;
}

#endif
