/* symbolic.h: sl_symbolic_create: checks, ordering, the object; its release and its arrays */
#ifndef SLI_ANALYSIS_SYMBOLIC_H
#define SLI_ANALYSIS_SYMBOLIC_H

#include "symbolic_build.h"
#include "../matrix/csc_triangle.h"

/* An analysis under way. */
typedef struct sli_symbolic_job {
    sl_symbolic **out;
    const sl_options *opt;
    sl_allocator a, for_order; /* of the object; of what the ordering needs for a time */
    sli_analysis w;
    sl_stats found;
    sl_status status;
} sli_symbolic_job;

/* The steps of an analysis, by the leader of a team: order, in memory that the others need later
 * only; tree; object. */
static void sli_symbolic_run(sli_team *team, void *data) {
    sli_symbolic_job *j = (sli_symbolic_job *)data;
    sl_symbolic_info *info = &j->found.symbolic;
    sli_analysis *w = &j->w;
    sli_order_job order;
    sl_symbolic draft;
    w->team = team;
    SLI_CLEAR(order);
    order.A = w->A;
    order.column = w->column;
    order.triangle = info->triangle;
    order.opt = j->opt;
    order.perm = w->perm;
    order.scratch = w->scratch;
    order.septree = &w->septree;
    order.choice = &w->choice;
    order.team = team;
    order.a = &j->for_order;
    order.stats = &j->found;
    j->status = sli_order(&order);
    info->seconds_order = sli_analysis_lap(w);
    if (j->status != SL_OK) {
        return;
    }
    sli_pattern_fill(w);
    sli_analyze_tree(w, j->opt, &j->found);
    info->seconds_tree = sli_analysis_lap(w);
    info->seconds_analyze += info->seconds_tree;
    sli_clear(&draft, sizeof draft);
    draft.allocator = j->a;
    draft.nnz_input = sli_nnz(w->A);
    draft.pattern = w->pattern;
    j->status = sli_symbolic_build(j->out, &draft, w, &j->found);
}

/* What several workers share of the analysis takes as long as so many operations of a factorization
 * for each entry of A. */
#define SLI_ANALYSIS_FLOPS 400.0

/* The workers that share the analysis without the ordering. METIS traps signals of the caller's
 * thread. */
static sl_int sli_analysis_workers(const sl_csc *A, const sl_options *opt) {
    return opt == NULL || opt->ordering == SL_ORDERING_METIS
               ? 1
               : sli_min(sli_workers_for(&opt->threads, SLI_ANALYSIS_FLOPS * sli_nnz(A)),
                         SLI_TEAM_MAX);
}

/* What is wrong with the options of an analysis, or NULL. */
static const char *sli_symbolic_options_wrong(const sl_options *opt) {
    const char *wrong = sli_options_wrong(opt, SLI_READS_ANALYSIS | SLI_READS_TRIANGLE);
    return wrong == NULL && opt != NULL && (unsigned)opt->relaxation > (unsigned)SL_RELAXATION_NONE
               ? "options.relaxation is not a value of sl_relaxation"
               : wrong;
}

/* Checks the arguments of an analysis, and hashes the pattern of A. */
static sl_status sli_symbolic_check(const sl_csc *A, const sl_options *opt, sli_hash *pattern,
                                    sl_stats *stats) {
    sl_status status = SL_OK;
    if (!sli_csc_has_pattern(A) || !sli_pattern_hash(A, pattern)) { /* the hash checks, too */
        status = sl_csc_check(A, stats);
    }
    if (status == SL_OK) {
        status = sli_argument(A->n_rows != A->n_cols ? "A is not square"
                                                     : sli_symbolic_options_wrong(opt));
    }
    return status;
}

/* sl_symbolic_create of a matrix for which 2x2 pivots are given, or pairs NULL. opt then gives the
 * order, and pairs[k] = 1 if its rows k and k + 1 are a 2x2 pivot. */
static sl_status sli_symbolic_create(sl_symbolic **out, const sl_csc *A, const unsigned char *pairs,
                                     const sl_options *opt, sl_stats *stats) {
    sli_symbolic_job j;
    uint64_t small[2048];
    sli_block b = {NULL, 0};
    sli_arena arena;
    sl_status status;
    sli_clear(&j.w, sizeof j.w);
    SLI_CLEAR(j.found.symbolic); /* no other group is read */
    sli_stats_clear_error(stats);
    j.found.error.what = NULL;
    status = sli_begin(out);
    status = status == SL_OK ? sli_symbolic_check(A, opt, &j.w.pattern, stats) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    j.w.clock_entries = 4 * (int64_t)sli_nnz(A);
    j.w.clock = sli_seconds_for(j.w.clock_entries);
    j.out = out;
    j.opt = opt;
    j.a = sli_allocator(opt);
    j.w.A = A;
    j.w.pairs = pairs;
    j.w.workers = sli_analysis_workers(A, opt);
    SLI_LAYOUT_IN(&b, &j.a, small, sizeof small, status) {
        sli_analysis_layout(&j.w, &b, A->n_cols, sli_nnz(A));
    }
    if (status == SL_OK) {
        const sl_triangle stored = sli_csc_columns(A, j.w.column);
        sl_triangle *read = &j.found.symbolic.triangle;
        status = sli_csc_triangle(A, stored, read, opt, stats);
        j.w.side = stored != SL_TRIANGLE_BOTH && *read == stored ? 0
                   : *read == SL_TRIANGLE_UPPER                  ? -1
                                                                 : 1;
    }
    if (status == SL_OK) {
        j.for_order = sli_arena_start(&arena, &b, j.w.ordered, &j.a);
        j.found.symbolic.seconds_analyze = sli_analysis_lap(&j.w);
        sli_team_run(sli_threads_of(opt), sli_max(sli_order_workers(A, opt), j.w.workers),
                     sli_symbolic_run, &j);
        status = j.status;
        if (status != SL_OK) {
            (void)sli_fail_as(stats, status, &j.found.error);
        } else if (stats != NULL) {
            stats->symbolic = j.found.symbolic;
        }
    }
    sli_block_free(&b, &j.a, small);
    return sli_report(stats, status);
}

SL_API sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A, const sl_options *opt,
                                    sl_stats *stats) {
    return sli_symbolic_create(out, A, NULL, opt, stats);
}

SL_API void sl_symbolic_free(sl_symbolic *S) {
    if (S != NULL && sli_is_last(&S->borrowers)) {
        const sl_allocator a = S->allocator;
        if (S->backing.release != NULL) {
            S->backing.release(S->backing.bytes, S->backing.size);
        }
        sli_free(&a, S);
    }
}

/* Ends a borrowing. */
SLI_INLINE void sli_symbolic_return(const sl_symbolic *S) {
    sl_symbolic_free((sl_symbolic *)S);
}

SL_API sl_symbolic_arrays sl_symbolic_view(const sl_symbolic *S) {
    sl_symbolic_arrays v;
    SLI_CLEAR(v);
    if (S != NULL) {
        v.info = S->stats.symbolic;
        v.n = S->n;
        v.n_supers = S->n_supers;
        v.perm = S->perm;
        v.iperm = S->iperm;
        v.parent = S->parent;
        v.counts = S->counts;
        v.super_first = S->super_first;
        v.super_of = S->super_of;
        v.super_parent = S->super_parent;
        v.rows_begin = S->rows_begin;
        v.rows = S->rows;
        v.panel_begin = S->panel_begin;
        v.pairs = S->n_pairs > 0 ? S->pairs : NULL;
        v.n_nodes = S->n_nodes;
        v.node_of = S->n_nodes > 0 ? S->node_of : NULL;
        v.node_parent = S->n_nodes > 0 ? S->node_parent : NULL;
        v.node_level = S->n_nodes > 0 ? S->node_level : NULL;
    }
    return v;
}

#endif
