/* csc_triangle.h: the triangle that a factorization reads; checks that a pattern is symmetric */
#ifndef SLI_MATRIX_CSC_TRIANGLE_H
#define SLI_MATRIX_CSC_TRIANGLE_H

#include "csc_build.h"

/* Checks that A has the pattern of its transpose T: marks the rows of each column of A, then every
 * row in the same column of T must be marked. mark: n_cols elements. */
static sl_status sli_csc_check_symmetry(const sl_csc *A, const sl_csc *T, sl_int *mark,
                                        sl_stats *stats) {
    sl_int j, p;
    SLI_ZERO(mark, A->n_cols);
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            mark[A->i[p]] = j + 1;
        }
        for (p = T->p[j]; p < T->p[j + 1]; p++) {
            if (mark[T->i[p]] != j + 1) {
                return sli_fail_at(stats, SL_ERR_MALFORMED, j, T->i[p], 0.0,
                                   "both triangles are stored, and this entry in one of them only");
            }
        }
    }
    return SL_OK;
}

/* The triangle of a checked square matrix that a factorization reads: the one in the options, or
 * else the stored one, `found`. If both are stored, the pattern must be symmetric. *out is
 * unchanged on error. */
static sl_status sli_csc_triangle(const sl_csc *A, sl_triangle found, sl_triangle *out,
                                  const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const sl_triangle wanted = opt == NULL ? SL_TRIANGLE_NONE : opt->triangle;
    sl_csc T;
    sl_matrix *transpose;
    sl_int *mark;
    sl_status status = SL_OK;
    if ((unsigned)wanted > (unsigned)SL_TRIANGLE_BOTH) {
        return sli_refuse(SL_ERR_ARGUMENT, "options.triangle is not a value of sl_triangle");
    }
    if (wanted == SL_TRIANGLE_LOWER || wanted == SL_TRIANGLE_UPPER) {
        *out = wanted;
        return SL_OK;
    }
    if (found == SL_TRIANGLE_BOTH) {
        status = sli_matrix_transpose(&transpose, A, &a);
        if (status != SL_OK) {
            return status;
        }
        T = sl_matrix_view(transpose);
        mark = (sl_int *)sli_alloc(&a, (size_t)A->n_cols * sizeof(sl_int)); /* A->p is longer */
        status = mark == NULL ? sli_no_memory() : sli_csc_check_symmetry(A, &T, mark, stats);
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
    if (status == SL_OK) {
        status =
            sli_argument(out == NULL              ? "out is NULL"
                         : A->n_rows != A->n_cols ? "A is not square"
                                                  : sli_options_wrong(opt, SLI_READS_TRIANGLE));
    }
    if (status == SL_OK) {
        status = sli_csc_triangle(A, sli_triangle_scan(A), out, opt, stats);
    }
    return sli_report(stats, status);
}

#endif
