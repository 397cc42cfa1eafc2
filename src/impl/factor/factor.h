/* factor.h: creates a factor, and refactors it with new values of the same pattern */
#ifndef SLI_FACTOR_FACTOR_H
#define SLI_FACTOR_FACTOR_H

#include "../analysis/same_pattern.h"
#include "advice.h"
#include "factor_setup.h"
#include "front_tasks.h"
#include "pivot_check.h"
#include "pivot_judge.h"
#include "symmetry.h"
#include "uplooking.h"

/* Checks that F holds a factor and that A has the pattern that was analyzed. */
SLI_NOINLINE static sl_status sli_factor_fits(const sl_factor *F, const sl_csc *A) {
    const sl_status status = sli_factor_has_numbers(F);
    return status == SL_OK ? sli_pattern_check(F->S, A, 1) : status;
}

/* Reports what is not finite, or not complex. An entry of A has its row and column in A, an
 * entry of a sum its row and column in the lower triangle, and a coefficient neither. */
SLI_COLD static void sli_factor_report_entry(const sl_factor *F, const sl_csc *A,
                                             const sli_failure *f, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sl_int row = -1, column = -1;
    if (f->position < 0) { /* a coefficient: no row, no column */
    } else if (A != NULL) {
        const sl_int p = S->scatter_from[f->position];
        row = A->i[p];
        column = sli_column_of(A, p);
    } else {
        sl_int k, j, tile = sli_last_tile(S, f->super);
        sli_scatter_map_pivots(S, f->super, f->position, &tile, &k, &j);
        row = sli_max(S->perm[k], S->perm[j]);
        column = sli_min(S->perm[k], S->perm[j]);
    }
    (void)sli_fail_at(stats, f->status, row, column, f->value,
                      f->status != SL_ERR_NOT_FINITE ? "A is not one matrix of blocks [a -b; b a]"
                      : f->position < 0              ? "a coefficient is not finite"
                                                     : "an entry of A is not finite");
}

/* Fills F's stats: the pivot counts and, after a failure, the caller's row and column. has_pivots:
 * the failure came after all of them. */
SLI_NOINLINE static void sli_factor_report(sl_factor *F, const sli_source *from,
                                           const sli_failure *f, int has_pivots) {
    sl_int n_done = F->S->n; /* pivots before the failure */
    sl_stats found;
    sli_stats_clear_error(&found);
    F->stats.factor.null_bound = f->bound > 0.0 ? f->bound : 0.0;
    if (f->status != SL_OK && f->pivot >= 0) {
        n_done = has_pivots ? n_done : f->pivot;
        (void)sli_fail_at(&found, f->status, F->S->perm[f->pivot], -1, f->value,
                          sli_advice(F, from, f));
    } else if (f->status != SL_OK) {
        n_done = F->S->super_first[f->super];
        sli_factor_report_entry(F, from->A, f, &found);
    }
    F->stats.error = found.error;
    if (n_done == 0 || F->stats.factor.positive + F->stats.factor.negative != n_done) {
        sli_count_pivots(F, n_done); /* they are not counted yet */
    }
    F->stats.factor.null += f->status == SL_ERR_PIVOT && !has_pivots;
}

static void sli_factor_stats_report(const sl_factor *F, sl_stats *stats) {
    stats->factor = F->stats.factor;
    stats->error = F->stats.error;
}

/* Completes a factor with 2x2 pivots. The backward sweep does not divide by them. */
static void sli_pairs_done(sl_factor *F) {
    sl_int k;
    F->identity = sli_hash_words(F->identity, F->E, F->S->n);
    for (k = 0; k < F->S->n; k++) {
        F->divisors[k] = F->S->pairs[k] == SLI_PAIR_NONE ? F->D[k] : 1.0;
    }
}

/* Adds the numbers to the identity of F. The pivots show every option, besides the storage, that
 * changes more than rounding. */
static void sli_factor_identify_numbers(sl_factor *F) {
    const sl_int storage = (sl_int)F->type->storage;
    if (F->type->storage != SL_STORAGE_DOUBLE) {
        F->identity = sli_hash_ints(F->identity, &storage, 1);
    }
    F->identity = sli_hash_words(F->identity, F->D, F->S->n);
}

/* What is judged of a factorization. */
typedef struct sli_verdict {
    sl_factor *F;
    const sli_source *from;
    sli_failure *failure;
    int has_pivots; /* the failure, if there is one, came after all pivots */
} sli_verdict;

/* Reports the pivots or a failure. Without all pivots there is no growth. */
SLI_NOINLINE static void sli_verdict_report(const sli_verdict *v) {
    if (!v->has_pivots) {
        v->F->stats.factor.growth = v->F->stats.factor.entry_max = 0.0;
    }
    sli_factor_report(v->F, v->from, v->failure, v->has_pivots);
}

/* Null pivots that are skipped: finds them, and computes what solves need. */
static void sli_judge_nulls(sli_verdict *v) {
    if (sli_skips_nulls(v->F)) {
        (void)v->F->null.calls->finish(v->F, v->from, v->failure);
    }
    v->has_pivots = v->failure->status == SL_OK;
}

/* Growth, and pivots that the tolerance left to a judgement. */
static void sli_judge_growth(sli_verdict *v) {
    sl_factor *F = v->F;
    sli_failure *failure = v->failure;
    F->stats.factor.growth = F->stats.factor.entry_max = 0.0;
    if ((!v->has_pivots || sli_growth_check(F, failure)) &&
        sli_nulls_judge(F, v->has_pivots ? -1 : failure->super, failure) != SL_OK) {
        v->has_pivots = v->has_pivots && failure->status == SL_ERR_INACCURATE;
    }
    sli_verdict_report(v); /* it counts the pivots */
}

/* Pivots whose sign is rounding error. */
static void sli_judge_signs(sli_verdict *v) {
    if (v->failure->status == SL_OK && sli_signs_are_suspected(v->F) &&
        sli_signs_judge(v->F, v->failure) != SL_OK) {
        v->has_pivots = 0;
        sli_verdict_report(v);
    }
}

/* Negative pivots, where A must be definite. */
static void sli_judge_definite(sli_verdict *v) {
    if (v->F->limits.is_definite && v->has_pivots && v->F->stats.factor.negative > 0 &&
        v->failure->status != SL_ERR_PIVOT) { /* branches untested: without pivots */
        sli_refuse_negative(v->F, v->failure);
        sli_verdict_report(v);
    }
}

/* The judgements of a factorization, in order: each sees the failures of those before it. */
static void (*const sli_judgements[])(sli_verdict *v) = {sli_judge_nulls, sli_judge_growth,
                                                         sli_judge_signs, sli_judge_definite};

/* Ends a factorization: judges it, and records the outcome in F and for the caller. */
static sl_status sli_factor_done(sl_factor *F, const sli_source *from, sli_failure *failure,
                                 double started, sl_stats *stats) {
    sli_verdict v;
    double ended;
    size_t m;
    v.F = F;
    v.from = from;
    v.failure = failure;
    v.has_pivots = 0;
    for (m = 0; m < sizeof sli_judgements / sizeof *sli_judgements; m++) {
        sli_judgements[m](&v);
    }
    ended = sli_factor_clock(F->S);
    F->stats.factor.seconds = ended > 0.0 ? ended - started : 0.0;
    F->is_valid = failure->status == SL_OK;
    if (F->is_valid) {
        sli_factor_identify_numbers(F);
        if (F->E != NULL) {
            sli_pairs_done(F);
        }
    }
    F->status = failure->status;
    if (stats != NULL) {
        sli_factor_stats_report(F, stats);
    }
    return failure->status;
}

static sli_source sli_source_matrix(const sl_csc *A) {
    sli_source from = {NULL, NULL, NULL, 0};
    from.A = A;
    return from;
}

/* Replaces the identity of F by that of the values it is going to be computed from. */
static void sli_factor_identify(sl_factor *F, const sli_source *from) {
    const sl_symbolic *S = F->S;
    sl_int t;
    F->identity = S->identity;
    if (from->A != NULL) {
        F->identity = sli_hash_words(F->identity, from->A->x, sli_nnz(from->A));
        return;
    }
    F->identity = sli_hash_words(F->identity, from->coefficients, from->terms);
    for (t = 0; t < from->terms; t++) {
        F->identity = sli_hash_words(F->identity, from->values[t], S->scatter_begin[S->n_supers]);
    }
}

/* Invalidates F, and every region and selected inverse of its old numbers, before the numbers
 * change. */
static void sli_factor_begin(sl_factor *F) {
    F->is_valid = 0;
    F->generation++;
    F->stats.factor.positive = F->stats.factor.negative = 0; /* not counted */
    sli_tolerance_begin(F);
}

SLI_NOINLINE static sl_status sli_factor_eliminate(sl_factor *F, const sli_source *from,
                                                   sli_failure *failure) {
    return F->method == SL_METHOD_SUPERNODAL ? sli_multifrontal(F, from, failure)
                                             : sli_uplooking(F, from, failure);
}

/* Judges the suspected last pivots of components that have constants as a null vector. The search
 * for them overwrites L. */
SLI_COLD static void sli_factor_suspect(sl_factor *F, const sli_source *from,
                                        sli_failure *failure) {
    sl_int *last = NULL;
    const sl_int count = sli_null_suspects_find(F, from, &last, failure);
    sli_factor_clear_gaps(F);
    if (failure->status == SL_OK && /* branches untested: as before */
        sli_factor_eliminate(F, from, failure) == SL_OK) {
        sli_suspects_clear(F); /* they have been judged */
        if (count > 0) {
            (void)sli_lasts_judge(F, last, count, failure);
        }
    }
    sli_free(&F->allocator, last);
}

/* Computes L and D of a matrix that has the analyzed pattern. */
static sl_status sli_factor_numbers(sl_factor *F, const sli_source *from, double started,
                                    sl_stats *stats) {
    sli_failure failure;
    sl_int t;
    SLI_CLEAR(failure);
    F->history.updates = 0;
    F->history.drift = 0.0;
    sli_factor_identify(F, from);
    for (t = 0; t < from->terms && failure.status == SL_OK; t++) {
        if (!sli_is_finite(from->coefficients[t])) {
            (void)sli_fail(&failure, SL_ERR_NOT_FINITE, 0, -1, -1, from->coefficients[t]);
        }
    }
    if (F->type->accepts != NULL && failure.status == SL_OK) {
        F->type->accepts(F->S, from, &failure);
    }
    if (failure.status == SL_OK && sli_skips_nulls(F)) {
        (void)F->null.calls->prepare(F, from, &failure);
    }
    if (failure.status == SL_OK && sli_factor_eliminate(F, from, &failure) == SL_OK &&
        sli_null_is_suspected(F) && sli_nulls_judge(F, -1, &failure) == SL_OK) {
        sli_factor_suspect(F, from, &failure);
    }
    return sli_factor_done(F, from, &failure, started, stats);
}

SL_API sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats) {
    const sli_source from = sli_source_matrix(A);
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(F == NULL ? "F is NULL" : NULL);
    status = status == SL_OK ? sli_factor_may_change(F) : status;
    status = status == SL_OK ? sli_pattern_check(F->S, A, 1) : status;
    status = status == SL_OK ? sli_factor_prepare(F, 0) : status;
    if (status == SL_OK) {
        sli_factor_begin(F);
        status = sli_factor_numbers(F, &from, sli_factor_clock(F->S), stats);
    }
    return sli_report(stats, status);
}

/* Creates a factor of a matrix that has the analyzed pattern. *out is NULL on entry. */
static sl_status sli_factor_create_from(sl_factor **out, const sl_symbolic *S,
                                        const sli_source *from, const sl_options *opt,
                                        sl_stats *stats) {
    sl_factor *F = NULL;
    sl_status status = sli_factor_new(&F, S, opt, NULL, stats);
    if (status == SL_OK) {
        sli_factor_begin(F);
        status = sli_factor_numbers(F, from, sli_factor_clock(F->S), stats);
    }
    if (status == SL_OK) {
        *out = F;
    } else {
        sl_factor_free(F);
    }
    return status;
}

SL_API sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S, const sl_csc *A,
                                  const sl_options *opt, sl_stats *stats) {
    const sli_source from = sli_source_matrix(A);
    const sl_allocator a = sli_allocator(opt);
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK ? sli_argument(S == NULL ? "S is NULL" : sli_factor_options_wrong(opt))
                             : status;
    status = status == SL_OK ? sli_pattern_check(S, A, 1) : status;
    status = status == SL_OK ? sli_symmetry_check(S, A, &a, stats) : status;
    status = status == SL_OK ? sli_factor_create_from(out, S, &from, opt, stats) : status;
    return sli_report(stats, status);
}

#endif
