/* same_pattern.h: checks that a matrix has the analyzed pattern; says where it differs */
#ifndef SLI_ANALYSIS_SAME_PATTERN_H
#define SLI_ANALYSIS_SAME_PATTERN_H

#include "../ordering/graph.h"
#include "structure.h"

/* Checks that A has the size of the matrix that S was made from. */
static sl_status sli_pattern_check_size(const sl_symbolic *S, const sl_csc *A, int needs_values) {
    const sl_status status = sli_argument(A == NULL                       ? "A is NULL"
                                          : A->n_cols > 0 && A->p == NULL ? "A.p is NULL"
                                                                          : NULL);
    if (status != SL_OK) {
        return status;
    }
    if (A->n_rows != S->n || A->n_cols != S->n) {
        return sli_refuse(SL_ERR_OTHER_PATTERN, "A has another size than the analyzed matrix");
    }
    if (sli_nnz(A) != S->nnz_input) {
        return sli_nnz(A) < 0 ? sli_refuse(SL_ERR_MALFORMED, "A.p descends")
                              : sli_refuse(SL_ERR_OTHER_PATTERN, "A has more or fewer entries than "
                                                                 "the analyzed matrix");
    }
    return sli_argument(S->nnz_input == 0              ? NULL
                        : A->i == NULL                 ? "A.i is NULL"
                        : needs_values && A->x == NULL ? "A.x is NULL"
                                                       : NULL);
}

/* The first entry of A that is not where that of the analyzed matrix was; the number of entries if
 * there is none among those that are read. */
SLI_COLD static sl_int sli_pattern_difference(const sl_symbolic *S, const sl_csc *A) {
    sl_int first = sli_nnz(A), s, k, j;
    for (s = 0; s < S->n_supers; s++) {
        sl_int tile = sli_last_tile(S, s);
        sl_off m;
        for (m = S->scatter_begin[s + 1] - 1; m >= S->scatter_begin[s]; m--) {
            const sl_int p = S->scatter_from[m], row = S->iperm[A->i[p]];
            const sl_int column = S->iperm[sli_column_of(A, p)];
            sli_scatter_map_pivots(S, s, m, &tile, &k, &j);
            if (sli_max(row, column) != k || sli_min(row, column) != j) {
                first = sli_min(first, p);
            }
        }
    }
    return first;
}

/* Refuses A, which is as large as the analyzed matrix, but has another pattern or a malformed one.
 */
SLI_COLD static sl_status sli_pattern_refuse(const sl_symbolic *S, const sl_csc *A) {
    const sl_status status = sl_csc_check(A, NULL);
    sl_triangle found;
    sl_int p;
    if (status != SL_OK) {
        return status;
    }
    found = sli_triangle_scan(A);
    if ((found == SL_TRIANGLE_LOWER || found == SL_TRIANGLE_UPPER) &&
        found + S->stats.symbolic.triangle == SL_TRIANGLE_LOWER + SL_TRIANGLE_UPPER) {
        return sli_refuse(SL_ERR_OTHER_PATTERN, "A stores the other triangle");
    }
    p = sli_pattern_difference(S, A);
    return p == sli_nnz(A)
               ? sli_refuse(SL_ERR_OTHER_PATTERN, "entries differ in the triangle that is not read")
               : sli_fail_at(NULL, SL_ERR_OTHER_PATTERN, A->i[p], sli_column_of(A, p), 0.0,
                             "the first entry that differs, or stands in another place");
}

/* Checks that A has the pattern that S was made from. Reads p and i of A, and no value. */
SLI_NOINLINE static sl_status sli_pattern_check(const sl_symbolic *S, const sl_csc *A,
                                                int needs_values) {
    const sl_status status = sli_pattern_check_size(S, A, needs_values);
    sli_hash pattern;
    if (status != SL_OK ||
        (S->input != NULL && memcmp(S->input, A->p, ((size_t)S->n + 1) * sizeof(sl_int)) == 0 &&
         memcmp(S->input + S->n + 1, A->i, (size_t)S->nnz_input * sizeof(sl_int)) == 0)) {
        return status;
    }
    return sli_pattern_hash(A, &pattern) && sli_hash_equals(pattern, S->pattern)
               ? SL_OK
               : sli_pattern_refuse(S, A);
}

#endif
