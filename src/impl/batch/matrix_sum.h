/* matrix_sum.h: weighted sums of symmetric matrices with any stored triangles */
#ifndef SLI_BATCH_MATRIX_SUM_H
#define SLI_BATCH_MATRIX_SUM_H

#include "../../public/several.h"
#include "../matrix/csc_triangle.h"

/* Entries of all terms as triplets of the lower triangle. */
typedef struct sli_summands {
    sl_int count;
    sl_int *row, *column;
    double *x; /* NULL: patterns only */
} sli_summands;

/* Checks that the terms can be added; *entries: the number of their stored entries. */
static sl_status sli_sum_check(const double *coefficients, const sl_csc *terms, sl_int count,
                               sl_off *entries, sl_stats *stats) {
    sl_int t;
    *entries = 0;
    for (t = 0; t < count; t++) {
        const sl_csc *A = &terms[t];
        const sl_status status = sl_csc_check(A, stats);
        if (status != SL_OK) {
            return status;
        }
        if (A->n_rows != A->n_cols || A->n_cols != terms[0].n_cols ||
            (coefficients != NULL && sli_nnz(A) > 0 && A->x == NULL)) {
            return sli_argument(A->n_rows != A->n_cols         ? "a term is not square"
                                : A->n_cols != terms[0].n_cols ? "terms have different sizes"
                                                               : "a term has no values, x");
        }
        *entries += sli_nnz(A);
    }
    return *entries > INT32_MAX /* untested: 2^31 entries */
               ? sli_refuse(SL_ERR_TOO_LARGE, /* untested: the same */
                            "terms have more than 2^31 - 1 entries")
               : SL_OK; /* untested: the same */
}

/* Appends c A. c is ignored if only patterns are summed. */
static void sli_sum_append(sli_summands *all, const sl_csc *A, sl_triangle triangle, double c) {
    sl_int j, p;
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            if (sli_is_read(triangle, A->i[p], j)) {
                all->row[all->count] = sli_max(A->i[p], j);
                all->column[all->count] = sli_min(A->i[p], j);
                if (all->x != NULL) {
                    all->x[all->count] = c * A->x[p];
                }
                all->count++;
            }
        }
    }
}

SL_API sl_status sl_matrix_sum(sl_matrix **out, const double *coefficients, const sl_csc *terms,
                               sl_int count, const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sli_block b = {NULL, 0};
    sli_summands all = {0, NULL, NULL, NULL};
    sl_off entries = 0;
    sl_status status;
    sl_int t;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    if (status == SL_OK) {
        status = sli_argument(terms == NULL ? "terms is NULL"
                              : count < 1   ? "count is below 1"
                                            : sli_options_wrong(opt, SLI_READS_TRIANGLE));
    }
    status = status == SL_OK ? sli_sum_check(coefficients, terms, count, &entries, stats) : status;
    SLI_LAYOUT(&b, &a, status) {
        all.row = SLI_TAKE(&b, sl_int, entries);
        all.column = SLI_TAKE(&b, sl_int, entries);
        all.x = coefficients != NULL ? SLI_TAKE(&b, double, entries) : NULL;
    }
    for (t = 0; t < count && status == SL_OK; t++) {
        sl_triangle triangle = SL_TRIANGLE_NONE;
        status = sli_csc_triangle(&terms[t], sli_triangle_scan(&terms[t]), &triangle, opt, stats);
        if (status == SL_OK) {
            sli_sum_append(&all, &terms[t], triangle, coefficients != NULL ? coefficients[t] : 0.0);
        }
    }
    if (status == SL_OK) {
        sli_triplet_list list;
        list.n_rows = list.n_cols = terms[0].n_cols;
        list.count = all.count;
        list.i = all.row;
        list.j = all.column;
        list.x = all.x;
        status = sli_from_triplets(out, &list, &a);
    }
    sli_free(&a, b.base);
    return sli_report(stats, status);
}

#endif
