/* sparse_product.c: product of two sparse matrices, symmetric storage conversions */
#include "sparse_product.h"

#include <stdlib.h>

#include "triplets.h"

static bool has_values(const sl_csc *A) {
    return A->n_cols == 0 || (A->p != NULL && (A->p[A->n_cols] == 0 || A->x != NULL));
}

/* Computes C column by column. sum, mark, rows: scratch of A->n_rows; on entry mark is -1, sum is
 * 0. */
static bool multiply(triplets *list, const sl_csc *A, const sl_csc *B, double *sum, sl_int *mark,
                     sl_int *rows) {
    for (sl_int j = 0; j < B->n_cols; j++) {
        sl_int count = 0;
        for (sl_int p = B->p[j]; p < B->p[j + 1]; p++) {
            const sl_int k = B->i[p];
            for (sl_int q = A->p[k]; q < A->p[k + 1]; q++) {
                const sl_int i = A->i[q];
                if (mark[i] != j) {
                    mark[i] = j;
                    rows[count++] = i;
                }
                sum[i] += A->x[q] * B->x[p]; /* C(i, j) += A(i, k) B(k, j) */
            }
        }
        for (sl_int c = 0; c < count; c++) {
            if (!triplets_add(list, rows[c], j, sum[rows[c]])) {
                return false;
            }
            sum[rows[c]] = 0;
        }
    }
    return true;
}

bool csc_product(sl_matrix **out, const sl_csc *A, const sl_csc *B) {
    *out = NULL;
    if (A->n_cols != B->n_rows || !has_values(A) || !has_values(B)) {
        return false;
    }
    const size_t capacity = (size_t)A->n_rows + 1;
    triplets list = {0, 0, NULL, NULL, NULL};
    double *sum = (double *)calloc(capacity, sizeof *sum);
    sl_int *mark = (sl_int *)malloc(capacity * sizeof *mark);
    sl_int *rows = (sl_int *)malloc(capacity * sizeof *rows);
    bool ok = sum != NULL && mark != NULL && rows != NULL;
    for (size_t i = 0; i < capacity && ok; i++) {
        mark[i] = -1;
    }
    ok = ok && multiply(&list, A, B, sum, mark, rows);
    free(rows);
    free(mark);
    free(sum);
    if (!ok) {
        triplets_free(&list);
        return false;
    }
    return triplets_finish(out, A->n_rows, B->n_cols, &list, true) == SL_OK;
}

bool csc_expand_symmetric(sl_matrix **out, const sl_csc *A) {
    sl_triangle stored;
    triplets list = {0, 0, NULL, NULL, NULL};
    *out = NULL;
    if (!has_values(A) || sl_csc_triangle(A, &stored, NULL, NULL) != SL_OK) {
        return false;
    }
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            if (!triplets_add(&list, i, j, A->x[p]) ||
                (i != j && stored != SL_TRIANGLE_BOTH && !triplets_add(&list, j, i, A->x[p]))) {
                triplets_free(&list);
                return false;
            }
        }
    }
    return triplets_finish(out, A->n_rows, A->n_cols, &list, true) == SL_OK;
}

bool csc_symmetric_part(sl_matrix **out, const sl_csc *C) {
    triplets list = {0, 0, NULL, NULL, NULL};
    *out = NULL;
    if (C->n_rows != C->n_cols || !has_values(C)) {
        return false;
    }
    for (sl_int j = 0; j < C->n_cols; j++) {
        for (sl_int p = C->p[j]; p < C->p[j + 1]; p++) {
            const sl_int i = C->i[p];
            if (!triplets_add(&list, i > j ? i : j, i > j ? j : i,
                              i == j ? C->x[p] : 0.5 * C->x[p])) {
                triplets_free(&list);
                return false;
            }
        }
    }
    return triplets_finish(out, C->n_rows, C->n_cols, &list, true) == SL_OK;
}

sl_int csc_position(const sl_csc *A, sl_int row, sl_int col) {
    sl_int low = A->p[col], high = A->p[col + 1] - 1;
    while (low < high) {
        const sl_int middle = low + (high - low) / 2;
        if (A->i[middle] < row) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}
