/* csc.h: matrices in compressed columns: check, hash of the pattern, matrices of the library */
#ifndef SLI_MATRIX_CSC_H
#define SLI_MATRIX_CSC_H

#include "../../public/csc.h"
#include "../base/alloc.h"
#include "../base/hash.h"
#include "../base/status.h"

struct sl_matrix {
    sl_allocator allocator;
    sl_int n_rows, n_cols;
    sl_int *p; /* n_cols + 1 */
    sl_int *i; /* p[n_cols]; allocated longer if duplicates were summed */
    double *x; /* p[n_cols]; NULL: a pattern */
};

SLI_INLINE sl_int sli_nnz(const sl_csc *A) {
    return A->n_cols > 0 ? A->p[A->n_cols] : 0;
}

/* Checks the sizes of a matrix with 32-bit or 64-bit indices. p: its positions. */
static sl_status sli_csc_check_sizes(int64_t n_rows, int64_t n_cols, const void *p) {
    const sl_status status = sli_argument(n_rows < 0 || n_cols < 0  ? "A has a size below 0"
                                          : n_cols > 0 && p == NULL ? "A.p is NULL"
                                                                    : NULL);
    return status == SL_OK && (n_rows > SLI_ROWS_MAX || n_cols > SLI_ROWS_MAX)
               ? sli_refuse(SL_ERR_TOO_LARGE, "A has more than 2^31 - 8 rows or columns")
               : status;
}

/* Has A sizes and arrays, so that its positions and rows can be checked? */
static int sli_csc_has_pattern(const sl_csc *A) {
    return A != NULL && sli_csc_check_sizes(A->n_rows, A->n_cols, A->p) == SL_OK &&
           (sli_nnz(A) == 0 || A->i != NULL);
}

SL_API sl_status sl_csc_check(const sl_csc *A, sl_stats *stats) {
    sl_status status;
    sl_int j, p;
    uint32_t beyond = 0;
    sli_stats_clear_error(stats);
    status = sli_argument(A == NULL ? "A is NULL" : NULL);
    status = status == SL_OK ? sli_csc_check_sizes(A->n_rows, A->n_cols, A->p) : status;
    if (status != SL_OK || A->n_cols == 0) {
        return sli_report(stats, status);
    }
    if (A->p[0] != 0) {
        return sli_fail_at(stats, SL_ERR_MALFORMED, -1, 0, 0.0, "A.p[0] is not 0");
    }
    for (j = 0; j < A->n_cols; j++) {
        if (A->p[j + 1] < A->p[j]) {
            return sli_fail_at(stats, SL_ERR_MALFORMED, -1, j, 0.0, "A.p descends");
        }
    }
    status = sli_argument(sli_nnz(A) > 0 && A->i == NULL ? "A.i is NULL" : NULL);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    for (p = 0; p < sli_nnz(A); p++) { /* without branches: usually all are in range */
        beyond |= (uint32_t)A->i[p] >= (uint32_t)A->n_rows;
    }
    for (j = 0; beyond; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            if (A->i[p] < 0 || A->i[p] >= A->n_rows) {
                return sli_fail_at(stats, SL_ERR_MALFORMED, A->i[p], j, sli_min(A->i[p], 0),
                                   "a row of A is out of range; rows count from 0");
            }
        }
    }
    return SL_OK;
}

/* Which triangles have entries: below and above are negative if some are below or above the
 * diagonal. */
SLI_INLINE sl_triangle sli_triangle_of(sl_int below, sl_int above) {
    return below >= 0   ? above >= 0 ? SL_TRIANGLE_NONE : SL_TRIANGLE_UPPER
           : above >= 0 ? SL_TRIANGLE_LOWER
                        : SL_TRIANGLE_BOTH;
}

/* The triangles that have entries. The two patterns are not compared. */
static sl_triangle sli_triangle_scan(const sl_csc *A) {
    sl_int j, p, below = 0, above = 0;
    for (j = 0; j < A->n_cols && (below & above) >= 0; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            below |= j - A->i[p];
            above |= A->i[p] - j;
        }
    }
    return sli_triangle_of(below, above);
}

/* column[p] := the column of entry p of a checked matrix. Passes over all entries that know it need
 * no loop over columns: where these are short, each of them costs a mispredicted branch. Returns
 * the triangles that have entries. */
static sl_triangle sli_csc_columns(const sl_csc *A, sl_int *column) {
    const sl_int nnz = sli_nnz(A), *row = A->i;
    sl_int j, p, here = 0, below = 0, above = 0;
    SLI_ZERO(column, nnz);
    for (j = 1; j < A->n_cols && A->p[j] < nnz; j++) {
        column[A->p[j]]++;
    }
    for (p = 0; p < nnz; p++) {
        here += column[p];
        column[p] = here;
        below |= here - row[p];
        above |= row[p] - here;
    }
    return sli_triangle_of(below, above);
}

/* Returns the column of A that holds position p. */
static sl_int sli_column_of(const sl_csc *A, sl_int p) {
    sl_int low = 0, high = A->n_cols - 1;
    while (low < high) { /* finds the last column that begins at or before p */
        const sl_int middle = low + (high - low + 1) / 2;
        if (A->p[middle] <= p) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

/* Is this entry read? Of a matrix that stores both triangles only the lower one is. */
SLI_INLINE int sli_is_read(sl_triangle triangle, sl_int row, sl_int column) {
    return triangle == SL_TRIANGLE_NONE ||
           (triangle == SL_TRIANGLE_UPPER ? row <= column : row >= column);
}

static sl_status sli_matrix_new(sl_matrix **out, sl_int n_rows, sl_int n_cols, sl_int nnz,
                                int has_values, const sl_allocator *a) {
    sl_matrix draft;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    draft.allocator = *a;
    draft.n_rows = n_rows;
    draft.n_cols = n_cols;
    SLI_LAYOUT(&b, a, status) {
        (void)sli_take(&b, 1, sizeof(sl_matrix));
        draft.p = SLI_TAKE(&b, sl_int, (size_t)n_cols + 1);
        draft.i = SLI_TAKE(&b, sl_int, nnz);
        draft.x = has_values ? SLI_TAKE(&b, double, nnz) : NULL;
    }
    if (status == SL_OK) {
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

/* Hashes the pattern of A. Returns whether it is a pattern at all: positions ascending from 0 and
 * rows in range. Every refactorization calls this, and reads no index of A otherwise. */
static int sli_pattern_hash(const sl_csc *A, sli_hash *out) {
    const sl_int n = A->n_cols, nnz = sli_nnz(A);
    uint32_t descends = n > 0 ? (uint32_t)A->p[0] : 0;
    sl_int j;
    for (j = 0; j < n; j++) { /* positions that are not negative descend by a negative difference */
        const uint32_t next = (uint32_t)A->p[j + 1];
        descends |= next | (next - (uint32_t)A->p[j]);
    }
    out->a = (uint64_t)A->n_rows;
    out->b = (uint64_t)n;
    if (n > 0 && (A->p[0] != 0 || descends >> 31 != 0)) {
        return 0;
    }
    *out = sli_hash_ints(*out, A->p, n > 0 ? (sl_off)n + 1 : 0);
    return sli_hash_indices(out, A->i, nnz, A->n_rows);
}

#endif
