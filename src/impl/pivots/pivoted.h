/* pivoted.h: sl_symbolic_create_pivoted: an analysis whose order follows the values of a matrix */
#ifndef SLI_PIVOTS_PIVOTED_H
#define SLI_PIVOTS_PIVOTED_H

#include "../../public/pivots.h"
#include "../analysis/symbolic.h"
#include "pivot_search.h"

/* Analyzes A again, in the order of the pivots that were found. */
static sl_status sli_pivoted_analyze(sl_symbolic **out, const sli_pivot_search *p, const sl_csc *A,
                                     const sl_options *opt, sl_stats *stats) {
    sl_options given = sli_options_with(&p->allocator);
    const sl_symbolic_info *first = &p->S->stats.symbolic;
    sl_int k, pairs = 0;
    sl_stats found;
    sl_status status;
    for (k = 0; k < p->S->n; k++) {
        p->local[k] = p->S->perm[p->order[k]];
        pairs += p->is_first[k];
    }
    given.ordering = SL_ORDERING_GIVEN;
    given.perm = p->local;
    given.relaxation = opt == NULL ? SL_RELAXATION_DEFAULT : opt->relaxation;
    given.triangle = opt == NULL ? SL_TRIANGLE_NONE : opt->triangle;
    given.threads = opt == NULL ? given.threads : opt->threads;
    status = sli_symbolic_create(out, A, pairs > 0 ? p->is_first : NULL, &given, &found);
    if (status == SL_OK) {
        sl_symbolic_info *info = &(*out)->stats.symbolic;
        (*out)->is_pivoted = 1;
        info->delayed = p->delayed;
        info->seconds_order = first->seconds_order;
        info->seconds_analyze += first->seconds_analyze;
        if (stats != NULL) {
            stats->symbolic = *info;
        }
    }
    return status;
}

SL_API sl_status sl_symbolic_create_pivoted(sl_symbolic **out, const sl_csc *A,
                                            const sl_options *opt, sl_stats *stats) {
    double started;
    sli_pivot_search p;
    sl_symbolic *S = NULL;
    sli_block b = {NULL, 0};
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK ? sl_symbolic_create(&S, A, opt, stats) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(p);
    p.S = S;
    p.allocator = S->allocator;
    started = sli_seconds();
    status = sli_argument(A->x == NULL && sli_nnz(A) > 0 ? "A.x is NULL" : NULL);
    SLI_LAYOUT(&b, &p.allocator, status) {
        p.contributions = SLI_TAKE(&b, sli_contribution, S->n_supers);
        p.local = SLI_TAKE(&b, sl_int, S->n);
        p.order = SLI_TAKE(&b, sl_int, S->n);
        p.is_first = SLI_TAKE(&b, unsigned char, S->n);
    }
    status = status == SL_OK ? sli_search_run(&p, A, stats) : status;
    S->stats.symbolic.seconds_analyze += sli_seconds() - started;
    status = status == SL_OK ? sli_pivoted_analyze(out, &p, A, opt, stats) : status;
    sli_free(&p.allocator, b.base);
    sl_symbolic_free(S);
    return sli_report(stats, status);
}

#endif
