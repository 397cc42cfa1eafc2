/* csc64.h: matrices with 64-bit indices, converted to 32 bits */
#ifndef SLI_FILES_CSC64_H
#define SLI_FILES_CSC64_H

#include "../../public/files.h"
#include "../matrix/csc.h"

/* Checks sizes and positions; the indices are checked while they are copied. */
static sl_status sli_csc64_check(const sl_csc64 *A, sl_stats *stats) {
    sl_status status;
    int64_t j;
    status =
        A == NULL ? sli_argument("A is NULL") : sli_csc_check_sizes(A->n_rows, A->n_cols, A->p);
    if (status != SL_OK || A->n_cols == 0) {
        return status;
    }
    if (A->p[0] != 0) {
        return sli_fail_at(stats, SL_ERR_MALFORMED, -1, 0, 0.0, "A.p[0] is not 0");
    }
    for (j = 0; j < A->n_cols; j++) {
        if (A->p[j + 1] < A->p[j]) {
            return sli_fail_at(stats, SL_ERR_MALFORMED, -1, (sl_int)j, 0.0, "A.p descends");
        }
    }
    if (A->p[A->n_cols] > INT32_MAX) {
        return sli_refuse(SL_ERR_TOO_LARGE, "A has more than 2^31 - 1 entries");
    }
    return sli_argument(A->p[A->n_cols] > 0 && A->i == NULL ? "A.i is NULL" : NULL);
}

/* Copies the indices of checked positions. */
static sl_status sli_csc64_copy(const sl_csc64 *A, sl_matrix *M, sl_stats *stats) {
    sl_int j, p;
    M->p[0] = 0;
    for (j = 0; j < M->n_cols; j++) {
        M->p[j + 1] = (sl_int)A->p[j + 1];
        for (p = M->p[j]; p < M->p[j + 1]; p++) {
            const int64_t i = A->i[p];
            if (i < 0 || i >= A->n_rows) {
                const sl_int row = i < INT32_MIN || i > INT32_MAX ? -1 : (sl_int)i;
                return sli_fail_at(stats, SL_ERR_MALFORMED, row, j, row < 0 ? (double)i : 0.0,
                                   "a row of A is out of range; rows count from 0");
            }
            M->i[p] = (sl_int)i;
        }
    }
    if (A->x != NULL && M->p[M->n_cols] > 0) {
        SLI_COPY(M->x, A->x, M->p[M->n_cols]);
    }
    return SL_OK;
}

SL_API sl_status sl_matrix_from_csc64(sl_matrix **out, const sl_csc64 *A, const sl_options *opt,
                                      sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sl_matrix *M = NULL;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK ? sli_argument(sli_options_wrong(opt, SLI_READS_NOTHING)) : status;
    status = status == SL_OK ? sli_csc64_check(A, stats) : status;
    if (status == SL_OK) {
        const int64_t nnz = A->n_cols > 0 ? A->p[A->n_cols] : 0;
        status =
            sli_matrix_new(&M, (sl_int)A->n_rows, (sl_int)A->n_cols, (sl_int)nnz, A->x != NULL, &a);
    }
    if (status == SL_OK) {
        status = sli_csc64_copy(A, M, stats);
    }
    if (status != SL_OK) {
        sl_matrix_free(M);
        return sli_report(stats, status);
    }
    *out = M;
    return SL_OK;
}

#endif
