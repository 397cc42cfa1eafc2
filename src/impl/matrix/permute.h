/* permute.h: permutations: check, inverse, P A P' of a stored matrix */
#ifndef SLI_MATRIX_PERMUTE_H
#define SLI_MATRIX_PERMUTE_H

#include "csc_build.h"

/* iperm := the inverse of perm. Returns the first position where perm is not a permutation, or -1.
 */
static sl_int sli_perm_invert(const sl_int *perm, sl_int n, sl_int *iperm) {
    sl_int k;
    for (k = 0; k < n; k++) {
        iperm[k] = -1;
    }
    for (k = 0; k < n; k++) {
        if (perm[k] < 0 || perm[k] >= n || iperm[perm[k]] >= 0) {
            return k;
        }
        iperm[perm[k]] = k;
    }
    return -1;
}

/* The permuted entries of A as triplets. If A stores one triangle, they are in the lower one. */
static void sli_permute_entries(const sl_csc *A, const sl_int *iperm, sl_int *row, sl_int *column) {
    const int both = sli_triangle_scan(A) == SL_TRIANGLE_BOTH;
    sl_int j, p;
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int k = iperm[A->i[p]], l = iperm[j];
            row[p] = both ? k : sli_max(k, l);
            column[p] = both ? l : sli_min(k, l);
        }
    }
}

SL_API sl_status sl_matrix_permute(sl_matrix **out, const sl_csc *A, const sl_int *perm,
                                   const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sli_block b = {NULL, 0, 0};
    sl_int *iperm = NULL, *row = NULL, *column = NULL;
    sl_status status;
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    status = sl_csc_check(A, NULL);
    if (status != SL_OK) {
        return status;
    }
    if (A->n_rows != A->n_cols || (A->n_cols > 0 && perm == NULL) ||
        !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
        return SL_ERR_ARGUMENT;
    }
    SLI_LAYOUT(&b, &a, status) {
        iperm = SLI_TAKE(&b, sl_int, A->n_cols);
        row = SLI_TAKE(&b, sl_int, sli_nnz(A));
        column = SLI_TAKE(&b, sl_int, sli_nnz(A));
    }
    if (status == SL_OK) {
        if (sli_perm_invert(perm, A->n_cols, iperm) >= 0) {
            status = SL_ERR_ARGUMENT;
        } else {
            sli_permute_entries(A, iperm, row, column);
            sli_triplet_list t;
            t.n_rows = A->n_rows;
            t.n_cols = A->n_cols;
            t.count = sli_nnz(A);
            t.i = row;
            t.j = column;
            t.x = A->x;
            status = sli_from_triplets(out, &t, &a);
        }
        sli_free(&a, b.base);
    }
    return status;
}

#endif
