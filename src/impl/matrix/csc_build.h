/* csc.h: compressed columns: checks, owned matrices, triplets, transpose, which triangle is stored */
#ifndef SLI_CSC_H
#define SLI_CSC_H

#include "../public/csc.h"
#include "alloc.h"
#include "status.h"

struct sl_matrix {
    sl_allocator allocator;
    sl_int n_rows, n_cols;
    sl_int *p; /* n_cols + 1 */
    sl_int *i; /* p[n_cols], perhaps a little longer where duplicates were summed */
    double *x; /* as i, or NULL: a pattern */
};

SLI_INLINE sl_int sli_nnz(const sl_csc *A) {
    return A->n_cols > 0 ? A->p[A->n_cols] : 0;
}

SL_API sl_status sl_csc_check(const sl_csc *A, sl_stats *stats) {
    sl_int j, p;
    sli_stats_clear_error(stats);
    if (A == NULL || A->n_rows < 0 || A->n_cols < 0 || (A->n_cols > 0 && A->p == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (A->n_rows > SLI_ROWS_MAX || A->n_cols > SLI_ROWS_MAX) {
        return SL_ERR_TOO_LARGE;
    }
    if (A->n_cols == 0) {
        return SL_OK;
    }
    if (A->p[0] != 0) {
        return sli_fail_at(stats, SL_ERR_PATTERN, -1, 0, 0.0);
    }
    for (j = 0; j < A->n_cols; j++) {
        if (A->p[j + 1] < A->p[j]) {
            return sli_fail_at(stats, SL_ERR_PATTERN, -1, j, 0.0);
        }
    }
    if (sli_nnz(A) > 0 && A->i == NULL) {
        return SL_ERR_ARGUMENT;
    }
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            if (A->i[p] < 0 || A->i[p] >= A->n_rows) {
                return sli_fail_at(stats, SL_ERR_PATTERN, A->i[p], j, 0.0);
            }
        }
    }
    return SL_OK;
}

/* Which triangles have entries; the pattern is not compared. */
static sl_triangle sli_triangle_scan(const sl_csc *A) {
    sl_int j, p;
    int lower = 0, upper = 0;
    for (j = 0; j < A->n_cols && !(lower && upper); j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            lower |= A->i[p] > j;
            upper |= A->i[p] < j;
        }
    }
    return lower && upper ? SL_TRIANGLE_BOTH
           : lower        ? SL_TRIANGLE_LOWER
           : upper        ? SL_TRIANGLE_UPPER
                          : SL_TRIANGLE_NONE;
}

/* Whether an entry is one of those that stand for the symmetric matrix: of both triangles only the
 * lower is read. */
SLI_INLINE int sli_is_read(sl_triangle triangle, sl_int row, sl_int column) {
    return triangle != SL_TRIANGLE_BOTH || row >= column;
}

/* Arrays of a matrix with room for nnz entries. */
static void sli_matrix_layout(sl_matrix *M, sli_block *b, size_t nnz, int has_values) {
    (void)sli_take(b, 1, sizeof(sl_matrix));
    M->p = SLI_TAKE(b, sl_int, (size_t)M->n_cols + 1);
    M->i = SLI_TAKE(b, sl_int, nnz);
    M->x = has_values ? SLI_TAKE(b, double, nnz) : NULL;
}

static sl_status sli_matrix_new(sl_matrix **out, sl_int n_rows, sl_int n_cols, sl_int nnz,
                                int has_values, const sl_allocator *a) {
    sl_matrix draft;
    sli_block b = {NULL, 0, 0};
    sl_status status;
    draft.allocator = *a;
    draft.n_rows = n_rows;
    draft.n_cols = n_cols;
    sli_matrix_layout(&draft, &b, (size_t)nnz, has_values);
    status = sli_block_alloc(&b, a);
    if (status == SL_OK) {
        sli_matrix_layout(&draft, &b, (size_t)nnz, has_values);
        *out = (sl_matrix *)(void *)b.base;
        **out = draft;
    }
    return status;
}

SL_API void sl_matrix_free(sl_matrix *M) {
    if (M != NULL) {
        const sl_allocator a = M->allocator;
        sli_free(&a, M);
    }
}

SL_API sl_csc sl_matrix_view(const sl_matrix *M) {
    sl_csc A = {0, 0, NULL, NULL, NULL};
    if (M != NULL) {
        A.n_rows = M->n_rows;
        A.n_cols = M->n_cols;
        A.p = M->p;
        A.i = M->i;
        A.x = M->x;
    }
    return A;
}

/* start[k] := number of keys before k, start[n] := all; then start[key]++ places entries one after
 * the other. */
static void sli_starts(sl_int *start, sl_int n, const sl_int *keys, sl_int count) {
    sl_int k, total = 0;
    memset(start, 0, ((size_t)n + 1) * sizeof(sl_int));
    for (k = 0; k < count; k++) {
        start[keys[k]]++;
    }
    for (k = 0; k <= n; k++) {
        const sl_int here = start[k];
        start[k] = total;
        total += here;
    }
}

/* Sums neighbours with equal rows in every column of M; rows ascend. */
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

/* Triplets in range into columns: sorted by row, then stably by column, so that rows ascend and
 * duplicates keep their order; both sorts are by counting. */
static sl_status sli_from_triplets(sl_matrix **out, sl_int n_rows, sl_int n_cols, sl_int count,
                                   const sl_int *i, const sl_int *j, const double *x,
                                   const sl_allocator *a) {
    sl_matrix *M = NULL;
    sli_block b = {NULL, 0, 0};
    sl_int *start = NULL, *order = NULL, k;
    int pass;
    sl_status status = sli_matrix_new(&M, n_rows, n_cols, count, x != NULL, a);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        start = SLI_TAKE(&b, sl_int, (size_t)sli_max(n_rows, n_cols) + 1);
        order = SLI_TAKE(&b, sl_int, count);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        sl_matrix_free(M);
        return status;
    }
    sli_starts(start, n_rows, i, count);
    for (k = 0; k < count; k++) {
        order[start[i[k]]++] = k;
    }
    sli_starts(start, n_cols, j, count);
    memcpy(M->p, start, ((size_t)n_cols + 1) * sizeof(sl_int));
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
    sl_off k;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (n_rows < 0 || n_cols < 0 || count < 0 || (count > 0 && (i == NULL || j == NULL)) ||
        !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    if (count > INT32_MAX || n_rows > SLI_ROWS_MAX || n_cols > SLI_ROWS_MAX) {
        return SL_ERR_TOO_LARGE;
    }
    for (k = 0; k < count; k++) {
        if (i[k] < 0 || i[k] >= n_rows || j[k] < 0 || j[k] >= n_cols) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, i[k], j[k], 0.0);
        }
    }
    return sli_from_triplets(out, n_rows, n_cols, (sl_int)count, i, j, x, &a);
}

SL_API sl_status sl_matrix_transpose(sl_matrix **out, const sl_csc *A, const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sl_status status;
    sl_int j, p, k;
    sl_matrix *T;
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    status = sli_allocator_is_whole(opt) ? sl_csc_check(A, NULL) : SL_ERR_ARGUMENT;
    if (status != SL_OK) {
        return status;
    }
    status = sli_matrix_new(&T, A->n_cols, A->n_rows, sli_nnz(A), A->x != NULL, &a);
    if (status != SL_OK) {
        return status;
    }
    sli_starts(T->p, A->n_rows, A->i, sli_nnz(A));
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int to = T->p[A->i[p]]++;
            T->i[to] = j;
            if (A->x != NULL) {
                T->x[to] = A->x[p];
            }
        }
    }
    for (k = A->n_rows; k > 0; k--) { /* placing moved every start to its end */
        T->p[k] = T->p[k - 1];
    }
    T->p[0] = 0;
    *out = T;
    return SL_OK;
}

/* With every column of A marked in turn, each entry of the same column of A' must be marked. */
static sl_status sli_csc_mirrored(const sl_csc *A, const sl_csc *T, sl_int *mark, sl_stats *stats) {
    sl_int j, p;
    memset(mark, 0, (size_t)A->n_cols * sizeof(sl_int));
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            mark[A->i[p]] = j + 1;
        }
        for (p = T->p[j]; p < T->p[j + 1]; p++) {
            if (mark[T->i[p]] != j + 1) {
                return sli_fail_at(stats, SL_ERR_PATTERN, j, T->i[p], 0.0);
            }
        }
    }
    return SL_OK;
}

/* The triangle of a checked square matrix; *out is left alone on error. */
static sl_status sli_csc_triangle(const sl_csc *A, sl_triangle *out, const sl_options *opt,
                                  sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const sl_triangle found = sli_triangle_scan(A);
    sl_csc pattern = *A, T;
    sl_matrix *transpose;
    sl_int *mark;
    sl_status status = SL_OK;
    if (found == SL_TRIANGLE_BOTH) {
        pattern.x = NULL;
        status = sl_matrix_transpose(&transpose, &pattern, opt);
        if (status != SL_OK) {
            return status;
        }
        T = sl_matrix_view(transpose);
        mark = (sl_int *)sli_alloc(&a, (size_t)A->n_cols * sizeof(sl_int)); /* A->p is longer */
        status = mark == NULL ? SL_ERR_MEMORY : sli_csc_mirrored(A, &T, mark, stats);
        sli_free(&a, mark);
        sl_matrix_free(transpose);
    }
    if (status == SL_OK) {
        *out = found;
    }
    return status;
}

SL_API sl_status sl_csc_triangle(const sl_csc *A, sl_triangle *out, const sl_options *opt,
                                 sl_stats *stats) {
    sl_status status = sl_csc_check(A, stats);
    if (status != SL_OK) {
        return status;
    }
    if (out == NULL || A->n_rows != A->n_cols || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    return sli_csc_triangle(A, out, opt, stats);
}

#endif
