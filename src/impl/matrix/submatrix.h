/* submatrix.h: lists of rows, and the principal submatrix of a stored matrix that they choose */
#ifndef SLI_MATRIX_SUBMATRIX_H
#define SLI_MATRIX_SUBMATRIX_H

#include "csc.h"

/* where := the position of each row 0..n-1 in a list, -1 if it is not in it. Returns the first
 * position of a row that is out of range or given twice, or -1. */
static sl_int sli_rows_invert(const sl_int *rows, sl_int count, sl_int n, sl_int *where) {
    sl_int k;
    for (k = 0; k < n; k++) {
        where[k] = -1;
    }
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
    const sl_int *where;  /* n: the position of each row in R, or negative */
} sli_submatrix;

/* Counts the entries of each column: position[k + 1] += 1. If M is given, they are placed instead:
 * position[k]++ is the next one of column k. from: their positions in A; NULL: not wanted. */
static void sli_submatrix_visit(const sli_submatrix *s, sl_int *position, sl_matrix *M,
                                sl_int *from) {
    const sl_csc *A = s->A;
    sl_int j, p;
    for (j = 0; j < A->n_cols; j++) {
        const sl_int c = s->where[j];
        for (p = A->p[j]; p < A->p[j + 1] && c >= 0; p++) {
            const sl_int r = s->where[A->i[p]];
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

SL_API sl_status sl_matrix_submatrix(sl_matrix **out, const sl_csc *A, const sl_int *rows,
                                     sl_int count, const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sli_block b = {NULL, 0};
    sli_submatrix s;
    sl_int *where = NULL, *position = NULL, bad;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK ? sl_csc_check(A, stats) : status;
    if (status == SL_OK) {
        status =
            sli_argument(A->n_rows != A->n_cols      ? "A is not square"
                         : count < 0                 ? "count is below 0"
                         : count > 0 && rows == NULL ? "rows is NULL"
                                                     : sli_options_wrong(opt, SLI_READS_NOTHING));
    }
    SLI_LAYOUT(&b, &a, status) {
        where = SLI_TAKE(&b, sl_int, A->n_cols);
        position = SLI_TAKE(&b, sl_int, (uint64_t)count + 1);
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    bad = sli_rows_invert(rows, count, A->n_cols, where);
    if (bad >= 0) {
        status = sli_fail_at(stats, SL_ERR_ARGUMENT, rows[bad], -1, 0.0,
                             "a row is out of range or given twice");
    } else {
        s.A = A;
        s.triangle = SL_TRIANGLE_NONE;
        s.is_folded = sli_triangle_scan(A) != SL_TRIANGLE_BOTH;
        s.count = count;
        s.where = where;
        status = sli_submatrix_make(out, NULL, &s, position, &a);
    }
    sli_free(&a, b.base);
    return sli_report(stats, status);
}

#endif
