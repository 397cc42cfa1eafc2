/* submatrix.h: lists of rows, and the principal submatrix of a stored matrix that they choose */
#ifndef SLI_MATRIX_SUBMATRIX_H
#define SLI_MATRIX_SUBMATRIX_H

#include "csc.h"
#include "../base/sort.h"

/* where := the position of each row 0..n-1 in a list, -1 if it is not in it. Returns the first
 * position of a row that is out of range or given twice, or -1. */
static sl_int sli_rows_invert(const sl_int *rows, sl_int count, sl_int n, sl_int *where) {
    sl_int k;
    SLI_NONE(where, n);
    for (k = 0; k < count; k++) {
        if (rows[k] < 0 || rows[k] >= n || where[rows[k]] >= 0) {
            return k;
        }
        where[rows[k]] = k;
    }
    return -1;
}

/* The entries of A[R, R] among those of A. */
typedef struct sli_submatrix {
    const sl_csc *A;
    sl_triangle triangle; /* the entries that are read; NONE: all */
    int is_folded;        /* they become those of a lower triangle */
    sl_int count;         /* rows of R */
    const sl_int *where;  /* n: the position of each row in R, or negative; NULL: see sorted */
    uint64_t *sorted;     /* count: the rows, ascending, each with its position in R */
} sli_submatrix;

/* The position of row i in R, or -1. */
static sl_int sli_submatrix_position(const sli_submatrix *s, sl_int i) {
    sl_int low = 0, high = s->count;
    if (s->where != NULL) {
        return s->where[i];
    }
    while (low < high) {
        const sl_int middle = low + (high - low) / 2;
        if (sli_key(s->sorted[middle]) < i) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < s->count && sli_key(s->sorted[low]) == i ? sli_value(s->sorted[low]) : -1;
}

/* Counts the entries of each column: position[k + 1] += 1. If M is given, they are placed instead:
 * position[k]++ is the next one of column k. from: their positions in A; NULL: not wanted. */
static void sli_submatrix_visit(const sli_submatrix *s, sl_int *position, sl_matrix *M,
                                sl_int *from) {
    const sl_csc *A = s->A;
    const sl_int columns = s->where != NULL ? A->n_cols : s->count;
    sl_int k, p;
    for (k = 0; k < columns; k++) {
        const sl_int j = s->where != NULL ? k : sli_key(s->sorted[k]);
        const sl_int c = s->where != NULL ? s->where[k] : sli_value(s->sorted[k]);
        for (p = A->p[j]; p < A->p[j + 1] && c >= 0; p++) {
            const sl_int r = sli_submatrix_position(s, A->i[p]);
            const sl_int column = s->is_folded && r < c ? r : c;
            if (r < 0 || !sli_is_read(s->triangle, A->i[p], j)) {
                continue;
            }
            if (M == NULL) {
                position[column + 1]++;
            } else {
                const sl_int to = position[column]++;
                M->i[to] = column == c ? r : c;
                if (M->x != NULL) {
                    M->x[to] = A->x[p];
                }
                if (from != NULL) {
                    from[to] = p;
                }
            }
        }
    }
}

/* Makes A[R, R]. position: count + 1 of scratch. from: NULL, or set to an array of its own. */
SLI_HOT static sl_status sli_submatrix_make(sl_matrix **out, sl_int **from, const sli_submatrix *s,
                                            sl_int *position, const sl_allocator *a) {
    sl_matrix *M = NULL;
    sl_status status;
    sl_int k;
    SLI_ZERO(position, (size_t)s->count + 1);
    sli_submatrix_visit(s, position, NULL, NULL);
    for (k = 0; k < s->count; k++) {
        position[k + 1] += position[k];
    }
    status = sli_matrix_new(&M, s->count, s->count, position[s->count], s->A->x != NULL, a);
    if (status == SL_OK && from != NULL) {
        *from = (sl_int *)sli_alloc(a, ((size_t)position[s->count] + 1) * sizeof(sl_int));
        status = *from == NULL ? sli_no_memory() : SL_OK;
    }
    if (status == SL_OK) {
        SLI_COPY(M->p, position, (size_t)s->count + 1);
        sli_submatrix_visit(s, position, M, from == NULL ? NULL : *from);
        *out = M;
    } else {
        sl_matrix_free(M);
    }
    return status;
}

/* Sorts the rows of R, and checks them and the columns of A that they choose. Finds whether the
 * entries of C are in both triangles of A. No other column is read. */
static sl_status sli_columns_check(sli_submatrix *s, const sl_int *rows, uint64_t *scratch,
                                   sl_stats *stats) {
    const sl_csc *A = s->A;
    sl_int k, p, below = 0, above = 0;
    sl_off total = 0;
    for (k = 0; k < s->count; k++) {
        if (rows[k] < 0 || rows[k] >= A->n_cols) {
            return sli_refuse_row(stats, rows[k]);
        }
        s->sorted[k] = sli_keyed(rows[k], k);
    }
    sli_sort(s->sorted, s->count, scratch);
    for (k = 0; k < s->count; k++) {
        const sl_int j = sli_key(s->sorted[k]);
        if (k > 0 && sli_key(s->sorted[k - 1]) == j) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, j, -1, 0.0, "a row is given twice");
        }
        total += (sl_off)A->p[j + 1] - A->p[j];
        if (A->p[j] < 0 || A->p[j + 1] < A->p[j] || A->p[j + 1] > sli_nnz(A) ||
            total > sli_nnz(A)) {
            return sli_fail_at(stats, SL_ERR_MALFORMED, -1, j, 0.0, "A.p descends");
        }
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            if (i < 0 || i >= A->n_rows) {
                return sli_fail_at(stats, SL_ERR_MALFORMED, i, j, sli_min(i, 0),
                                   "a row of A is out of range; rows count from 0");
            }
            if (i != j && sli_submatrix_position(s, i) >= 0) {
                below |= i > j;
                above |= i < j;
            }
        }
    }
    s->is_folded = !(below && above);
    return SL_OK;
}

SL_API sl_status sl_matrix_submatrix(sl_matrix **out, const sl_csc *A, const sl_int *rows,
                                     sl_int count, const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sli_block b = {NULL, 0};
    sli_submatrix s;
    sl_int *position = NULL;
    uint64_t *scratch = NULL;
    sl_status status;
    sli_stats_clear_error(stats);
    SLI_CLEAR(s);
    status = sli_begin(out);
    status = status == SL_OK ? sli_argument(A == NULL ? "A is NULL" : NULL) : status;
    status = status == SL_OK ? sli_csc_check_sizes(A->n_rows, A->n_cols, A->p) : status;
    if (status == SL_OK) {
        status = sli_argument(A->n_rows != A->n_cols      ? "A is not square"
                              : count < 0                 ? "count is below 0"
                              : count > 0 && rows == NULL ? "rows is NULL"
                              : A->n_cols > 0 && sli_nnz(A) > 0 && A->i == NULL
                                  ? "A.i is NULL"
                                  : sli_options_wrong(opt, SLI_READS_NOTHING));
    }
    SLI_LAYOUT(&b, &a, status) {
        s.sorted = SLI_TAKE(&b, uint64_t, count);
        scratch = SLI_TAKE(&b, uint64_t, count);
        position = SLI_TAKE(&b, sl_int, (uint64_t)count + 1);
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    s.A = A;
    s.triangle = SL_TRIANGLE_NONE;
    s.count = count;
    status = sli_columns_check(&s, rows, scratch, stats);
    status = status == SL_OK ? sli_submatrix_make(out, NULL, &s, position, &a) : status;
    sli_free(&a, b.base);
    return sli_report(stats, status);
}

#endif
