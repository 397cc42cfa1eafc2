/* plan.h: plan objects: queries compiled once and kept, and solves on them */
#ifndef SLI_SOLVE_PLAN_H
#define SLI_SOLVE_PLAN_H

#include "../../public/plan.h"
#include "../analysis/symbolic.h"
#include "compile.h"
#include "sweep.h"

struct sl_plan {
    sl_allocator allocator;
    size_t bytes;
    sli_query query;
};

/* Makes the plan of two sorted sets. */
static sl_status sli_plan_make(sl_plan **out, const sl_symbolic *S, const sli_ending *ending,
                               sli_set *b, sli_set *x, const sl_allocator *a) {
    sli_block kept = {NULL, 0};
    sl_plan *P = NULL;
    sli_query query;
    sl_status status = SL_OK;
    SLI_CLEAR(query);
    sli_set_measure(S, b, &query.forward);
    sli_set_measure(S, x, &query.backward);
    SLI_LAYOUT(&kept, a, status) {
        P = (sl_plan *)sli_take_inline(&kept, 1, sizeof(sl_plan));
        sli_set_layout_reach(b, &kept, &query.forward);
        sli_set_layout_reach(x, &kept, &query.backward);
    }
    if (status == SL_OK) {
        sli_query_fill(&query, S, ending, b, x);
        P->allocator = *a;
        P->bytes = kept.used;
        P->query = query;
        sli_borrow(&S->borrowers);
        if (ending != NULL) {
            sli_borrow(&ending->borrowers);
        }
        *out = P;
    }
    return status;
}

SL_API sl_status sl_plan_create(sl_plan **out, const sl_symbolic *S, const sl_int *bset, sl_int nb,
                                const sl_int *xset, sl_int nx, const sl_options *opt,
                                sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sli_block seeds = {NULL, 0};
    /* a region begins with its ending */
    const sli_ending *ending = opt == NULL ? NULL : (const sli_ending *)(const void *)opt->region;
    sli_set b, x;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK
                 ? sli_argument(S == NULL ? "S is NULL" : sli_options_wrong(opt, SLI_READS_REGION))
                 : status;
    status = status == SL_OK ? sli_list(&bset, &nb, S->n) : status;
    status = status == SL_OK ? sli_list(&xset, &nx, S->n) : status;
    if (status == SL_OK && ending != NULL && !ending->calls->belongs(ending, S)) {
        status = sli_refuse(SL_ERR_MISMATCH, "options.region is a region of another analysis");
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    b = sli_set_of(S, bset, nb);
    x = sli_set_of(S, xset, nx);
    SLI_LAYOUT(&seeds, &a, status) {
        sli_set_layout_seeds(&b, &seeds);
        sli_set_layout_seeds(&x, &seeds);
    }
    status = status == SL_OK ? sli_set_sort(S, &b, stats) : status;
    status = status == SL_OK ? sli_set_sort(S, &x, stats) : status;
    if (status == SL_OK && ending != NULL && !ending->calls->place(ending, &b, &x)) {
        ending = NULL;
    }
    status = status == SL_OK ? sli_plan_make(out, S, ending, &b, &x, &a) : status;
    if (status == SL_OK) {
        sl_plan_stats(*out, stats);
    }
    sli_free(&a, seeds.base);
    return sli_report(stats, status);
}

SL_API void sl_plan_free(sl_plan *P) {
    if (P != NULL) {
        const sl_allocator a = P->allocator;
        if (P->query.ending != NULL) {
            P->query.ending->calls->give_back(P->query.ending);
        }
        sli_symbolic_return(P->query.S);
        sli_free(&a, P);
    }
}

SL_API void sl_plan_stats(const sl_plan *P, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (P != NULL && stats != NULL) {
        sli_query_stats(&P->query, stats);
        stats->plan.bytes = P->bytes;
    }
}

SL_API sl_status sl_plan_solve(const sl_plan *P, const sl_factor *F, double *X, size_t ldx,
                               const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    return P == NULL   ? sli_argument("P is NULL")
           : F == NULL ? sli_argument("F is NULL")
                       : sli_solve(F, &P->query, &rhs, W);
}

#endif
