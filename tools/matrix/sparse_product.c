/* sparse_product.c: product of two sparse matrices, symmetric storage conversions */
#include "sparse_product.h"

#include "tools/adapters/sparse_local_mesh.h"
#include "triplets.h"

bool csc_product(sl_matrix **out, const sl_csc *A, const sl_csc *B) {
    return sl_matrix_product(out, A, NULL, B, NULL, NULL) == SL_OK;
}

bool csc_expand_symmetric(sl_matrix **out, const sl_csc *A) {
    sl_triangle stored;
    triplets list = {0, 0, NULL, NULL, NULL};
    *out = NULL;
    if (!sl_mesh_has_values(A) || sl_csc_triangle(A, &stored, NULL, NULL) != SL_OK) {
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
    if (C->n_rows != C->n_cols || !sl_mesh_has_values(C)) {
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
