/* csc_build.h: matrices from triplets, and transposes of patterns, both by counting sorts */
#ifndef SLI_MATRIX_CSC_BUILD_H
#define SLI_MATRIX_CSC_BUILD_H

#include "csc.h"

/* start[k] := number of keys less than k, start[n] := count. Then start[key]++ gives the positions
 * of entries sorted by key. */
static void sli_count_starts(sl_int *start, sl_int n, const sl_int *keys, sl_int count) {
    sl_int k, total = 0;
    SLI_ZERO(start, (size_t)n + 1);
    for (k = 0; k < count; k++) {
        start[keys[k]]++;
    }
    for (k = 0; k <= n; k++) {
        const sl_int here = start[k];
        start[k] = total;
        total += here;
    }
}

/* Sums adjacent entries of equal rows in every column of M; rows ascend. */
static void sli_matrix_sum_duplicates(sl_matrix *M) {
    sl_int j, p, kept = 0, start = 0;
    for (j = 0; j < M->n_cols; j++) {
        const sl_int first = kept, end = M->p[j + 1];
        for (p = start; p < end; p++) {
            if (kept > first && M->i[kept - 1] == M->i[p]) {
                if (M->x != NULL) {
                    M->x[kept - 1] += M->x[p];
                }
            } else {
                M->i[kept] = M->i[p];
                if (M->x != NULL) {
                    M->x[kept] = M->x[p];
                }
                kept++;
            }
        }
        start = end;
        M->p[j + 1] = kept;
    }
}

/* Triplets: the entries of a matrix in any order. */
typedef struct sli_triplet_list {
    sl_int n_rows, n_cols, count;
    const sl_int *i, *j; /* count */
    const double *x;     /* count, or NULL */
} sli_triplet_list;

/* Makes columns of triplets in range: two stable counting sorts, by row and then by column, so that
 * rows ascend and duplicates keep their order. */
static sl_status sli_from_triplets(sl_matrix **out, const sli_triplet_list *t,
                                   const sl_allocator *a) {
    const sl_int n_rows = t->n_rows, n_cols = t->n_cols, count = t->count;
    const sl_int *i = t->i, *j = t->j;
    const double *x = t->x;
    sl_matrix *M = NULL;
    sli_block b = {NULL, 0};
    sl_int *start = NULL, *order = NULL, k;
    sl_status status = sli_matrix_new(&M, n_rows, n_cols, count, x != NULL, a);
    SLI_LAYOUT(&b, a, status) {
        start = SLI_TAKE(&b, sl_int, (size_t)sli_max(n_rows, n_cols) + 1);
        order = SLI_TAKE(&b, sl_int, count);
    }
    if (status != SL_OK) {
        sl_matrix_free(M);
        return status;
    }
    sli_count_starts(start, n_rows, i, count);
    for (k = 0; k < count; k++) {
        order[start[i[k]]++] = k;
    }
    sli_count_starts(start, n_cols, j, count);
    SLI_COPY(M->p, start, (size_t)n_cols + 1);
    for (k = 0; k < count; k++) {
        const sl_int from = order[k], to = start[j[from]]++;
        M->i[to] = i[from];
        if (x != NULL) {
            M->x[to] = x[from];
        }
    }
    sli_free(a, b.base);
    sli_matrix_sum_duplicates(M);
    *out = M;
    return SL_OK;
}

SL_API sl_status sl_matrix_from_triplets(sl_matrix **out, sl_int n_rows, sl_int n_cols,
                                         sl_off count, const sl_int *i, const sl_int *j,
                                         const double *x, const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sli_triplet_list t;
    sl_off k;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    if (status == SL_OK) {
        status = sli_argument(n_rows < 0               ? "n_rows is below 0"
                              : n_cols < 0             ? "n_cols is below 0"
                              : count < 0              ? "count is below 0"
                              : count > 0 && i == NULL ? "i is NULL"
                              : count > 0 && j == NULL ? "j is NULL"
                                                       : sli_options_wrong(opt, SLI_READS_NOTHING));
    }
    if (status == SL_OK && (count > INT32_MAX || n_rows > SLI_ROWS_MAX || n_cols > SLI_ROWS_MAX)) {
        status = sli_refuse(SL_ERR_TOO_LARGE, "more than 2^31 - 1 triplets, or 2^31 - 8 rows");
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    for (k = 0; k < count; k++) {
        if (i[k] < 0 || i[k] >= n_rows || j[k] < 0 || j[k] >= n_cols) {
            return sli_fail_at(
                stats, SL_ERR_ARGUMENT, i[k], j[k], (double)k,
                "a triplet is out of range; value is its number, and rows count from 0");
        }
    }
    t.n_rows = n_rows;
    t.n_cols = n_cols;
    t.count = (sl_int)count;
    t.i = i;
    t.j = j;
    t.x = x;
    return sli_report(stats, sli_from_triplets(out, &t, &a));
}

/* The transpose of the pattern of A, which has been checked. Rows ascend; duplicates stay. */
static sl_status sli_matrix_transpose(sl_matrix **out, const sl_csc *A, const sl_allocator *a) {
    sl_int j, p;
    sl_matrix *T;
    const sl_status status = sli_matrix_new(&T, A->n_cols, A->n_rows, sli_nnz(A), 0, a);
    if (status != SL_OK) {
        return status;
    }
    sli_count_starts(T->p, A->n_rows, A->i, sli_nnz(A));
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            T->i[T->p[A->i[p]]++] = j;
        }
    }
    /* each start has moved to the end of its column */
    memmove(T->p + 1, T->p, (size_t)A->n_rows * sizeof(sl_int));
    T->p[0] = 0;
    *out = T;
    return SL_OK;
}

#endif
