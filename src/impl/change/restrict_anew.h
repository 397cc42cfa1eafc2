/* restrict_anew.h: the factor of A[R, R] where too little of L can be kept: extracts it first */
#ifndef SLI_CHANGE_RESTRICT_ANEW_H
#define SLI_CHANGE_RESTRICT_ANEW_H

#include "../factor/factor.h"
#include "../matrix/csc_build.h"
#include "restrict_analysis.h"

/* Creates the lower triangle of A[R, R], numbered in the caller's order: the graph of R if every
 * column is new. */
static sl_status sli_restrict_matrix(sl_matrix **M, sli_restriction *r, const sl_allocator *a,
                                     sl_stats *stats) {
    sl_int k, e, *begin;
    sl_status status;
    r->n_kept = 0;
    r->n_fresh = r->R.count;
    for (k = 0; k < r->R.count; k++) {
        r->fresh_of[k] = r->R.row_of[k];
    }
    status = sli_restriction_room(r, a, stats);
    if (status != SL_OK) {
        return status;
    }
    sli_restriction_graph(r);
    status = sli_matrix_new(M, r->R.count, r->R.count, r->n_entries, 1, a);
    if (status != SL_OK) {
        return status;
    }
    begin = (*M)->p;
    memset(begin, 0, ((size_t)r->R.count + 1) * sizeof(sl_int));
    for (e = 0; e < r->n_entries; e++) {
        begin[r->entry_column[e] + 1]++;
    }
    for (k = 0; k < r->R.count; k++) {
        begin[k + 1] += begin[k];
        r->next[k] = begin[k];
    }
    for (e = 0; e < r->n_entries; e++) {
        const sl_int at = r->next[r->entry_column[e]]++;
        (*M)->i[at] = r->entry_row[e];
        (*M)->x[at] = r->A->x[r->entry_from[e]];
    }
    return SL_OK;
}

/* Analyzes and factors A[R, R] in the order of A. Rows in stats are those of A[R, R]. */
static sl_status sli_restrict_anew(sl_symbolic **S, sl_factor **G, sli_restriction *r,
                                   const sl_options *rules, sl_stats *stats) {
    sl_options given = sli_options_with(&rules->allocator);
    sl_matrix *M = NULL;
    sl_csc B;
    sl_status status = sli_restrict_matrix(&M, r, &rules->allocator, stats);
    if (status == SL_OK) {
        B = sl_matrix_view(M);
        given.ordering = SL_ORDERING_GIVEN;
        given.perm = r->R.row_of;
        status = sl_symbolic_create(S, &B, &given, NULL);
        status = status == SL_OK ? sl_factor_create(G, *S, &B, rules, stats) : status;
        sl_matrix_free(M);
    }
    return status;
}

#endif
