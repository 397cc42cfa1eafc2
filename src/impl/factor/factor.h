/* factor.h: the factor object: the method and the memory, factoring, factoring again, release */
#ifndef SLI_FACTOR_H
#define SLI_FACTOR_H

#include "../public/factor.h"
#include "csc.h"
#include "graph.h"
#include "leftlooking.h"
#include "mapping.h"
#include "multifrontal.h"
#include "nullspace.h"
#include "select.h"
#include "uplooking.h"

static void sli_factor_layout(sl_factor *F, sli_block *b) {
    const sl_symbolic *S = F->S;
    const size_t n = (size_t)S->n, supers = (size_t)S->n_supers;
    const uint64_t workers = (uint64_t)F->schedule.workers;
    (void)sli_take(b, 1, sizeof(sl_factor));
    F->D = SLI_TAKE(b, double, n);
    if (F->rule.regularization != 0.0) {
        F->rule.signs = SLI_TAKE(b, signed char, n);
        F->rule.shifts = SLI_TAKE(b, double, n);
        F->regularized = SLI_TAKE(b, sl_int, n);
    }
    if (F->definiteness == SL_SEMIDEFINITE) {
        F->nulls = SLI_TAKE(b, sl_int, n);
    }
    if (F->is_centred) {
        F->anchors = SLI_TAKE(b, sl_int, S->stats.components);
        F->squares = SLI_TAKE(b, double, S->stats.components);
        F->mass = SLI_TAKE(b, double, n);
        F->centre = SLI_TAKE(b, double, n);
        F->divide = SLI_TAKE(b, double, n);
        F->centre_scratch = SLI_TAKE(b, double, sli_scratch_size(S->tallest, S->widest, 1));
    }
    if (F->method == SL_METHOD_SUPERNODAL) {
        const uint64_t rows = SLI_TILE * (uint64_t)sli_tiles(S->tallest);
        F->buffer = SLI_TAKE(b, double, workers *(uint64_t)sli_front_scratch(S->widest));
        F->magnitude = SLI_TAKE(b, double, workers *rows);
        F->inverse = SLI_TAKE(b, double, workers *SLI_FRONT_INVERSE);
        F->failures = SLI_TAKE(b, sli_failure, workers);
        sli_schedule_layout(&F->schedule, b, S->n_supers);
    } else {
        F->buffer = SLI_TAKE(b, double, sli_scratch_size(S->tallest, 0, 1));
        F->x = SLI_TAKE(b, double, n);
        F->head = SLI_TAKE(b, sl_int, n);
        F->next = SLI_TAKE(b, sl_int, supers);
        F->position = SLI_TAKE(b, sl_int, supers);
        F->list = SLI_TAKE(b, uint64_t, supers);
        F->list_scratch = SLI_TAKE(b, uint64_t, supers);
    }
    F->L = SLI_TAKE(b, double, S->panel_begin[S->n_supers]);
}

/* Who does what, in a supernodal factorization, and the memory for what is under way. */
static sl_status sli_factor_schedule(sl_factor *F) {
    const sl_symbolic *S = F->S;
    sli_block b = {NULL, 0, 0};
    sli_planning w;
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_planning_layout(&w, &b, S->n_supers, F->schedule.workers);
        status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
    }
    if (status == SL_OK) {
        sli_schedule_fill(&F->schedule, S, &w);
        sli_free(&F->allocator, b.base);
        b.base = NULL;
        b.used = 0;
        for (pass = 0; pass < 2 && status == SL_OK; pass++) {
            F->waiting = SLI_TAKE(&b, double, F->schedule.waiting);
            F->stats.bytes_factor += pass == 0 ? b.used : 0;
            status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
        }
    }
    return status;
}

/* Whether A can be the matrix that S was made from. */
static sl_status sli_factor_check(const sl_symbolic *S, const sl_csc *A) {
    if (A == NULL || (A->n_cols > 0 && A->p == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (A->n_rows != S->n || A->n_cols != S->n || sli_nnz(A) != S->nnz_input) {
        return SL_ERR_PATTERN;
    }
    if (S->nnz_input > 0 && (A->i == NULL || A->x == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    return sli_fingerprint(A) == S->fingerprint ? SL_OK : SL_ERR_PATTERN;
}

/* Does F hold a factor, and is A a matrix of the pattern that it was analysed for? */
static sl_status sli_factor_fits(const sl_factor *F, const sl_csc *A) {
    return F->is_good ? sli_factor_check(F->S, A) : SL_ERR_STATE;
}

static void sli_factor_stats_copy(const sl_stats *from, sl_stats *to) {
    to->isa = from->isa;
    to->method = from->method;
    to->positive = from->positive;
    to->negative = from->negative;
    to->null = from->null;
    to->pivot_min = from->pivot_min;
    to->pivot_max = from->pivot_max;
    to->seconds_setup = from->seconds_setup;
    to->seconds_factor = from->seconds_factor;
    to->bytes_factor = from->bytes_factor;
    to->regularized = from->regularized;
}

/* What is not finite: an entry, where it stands in A or in the lower triangle of a sum, or a coefficient. */
static void sli_factor_tell_entry(sl_factor *F, const sl_csc *A, const sli_failure *f) {
    const sl_symbolic *S = F->S;
    sl_int row = -1, column = -1;
    if (f->position < 0) { /* a coefficient: it has no place */
    } else if (A != NULL) {
        const sl_int p = S->map_from[f->position];
        row = A->i[p];
        column = sli_column_of(A, p);
    } else {
        sl_int k, j, tile = sli_last_tile(S, f->super);
        sli_map_pivots(S, f->super, f->position, &tile, &k, &j);
        row = sli_max(S->perm[k], S->perm[j]);
        column = sli_min(S->perm[k], S->perm[j]);
    }
    sli_fail_at(&F->stats, f->status, row, column, f->value);
}

/* Pivots in numbers, and a failure in the caller's rows. */
static void sli_factor_tell(sl_factor *F, const sl_csc *A, const sli_failure *f) {
    sl_int good = F->S->n; /* pivots before the failure */
    if (f->status != SL_OK && f->pivot >= 0) {
        good = f->pivot;
        sli_fail_at(&F->stats, f->status, F->S->perm[f->pivot], -1, f->value);
    } else if (f->status != SL_OK) {
        good = F->S->super_first[f->super];
        sli_factor_tell_entry(F, A, f);
    }
    sli_count_pivots(F, good);
    F->stats.null += f->status == SL_ERR_PIVOT;
}

static void sli_factor_stats_tell(const sl_factor *F, sl_stats *stats) {
    sli_factor_stats_copy(&F->stats, stats);
    stats->error_row = F->stats.error_row;
    stats->error_column = F->stats.error_column;
    stats->error_value = F->stats.error_value;
}

/* What a factorization came to, for the caller and for F itself. */
static sl_status sli_factor_done(sl_factor *F, const sl_csc *A, sli_failure *failure,
                                 double started, sl_stats *stats) {
    sli_stats_clear_error(&F->stats);
    if (failure->status == SL_OK && F->definiteness == SL_SEMIDEFINITE) {
        (void)sli_nulls_make(F, failure);
    }
    sli_factor_tell(F, A, failure);
    F->stats.seconds_factor = sli_seconds() - started;
    F->is_good = failure->status == SL_OK;
    F->status = failure->status;
    if (stats != NULL) {
        sli_factor_stats_tell(F, stats);
    }
    return failure->status;
}

/* The numbers of a matrix that fits the analysis. */
static sl_status sli_factor_numbers(sl_factor *F, const sli_source *from, double started,
                                    sl_stats *stats) {
    sli_failure failure;
    sl_int t;
    memset(&failure, 0, sizeof failure);
    for (t = 0; t < from->terms && failure.status == SL_OK; t++) {
        if (!sli_is_finite(from->coefficients[t])) {
            (void)sli_fail(&failure, SL_ERR_NOT_FINITE, 0, -1, -1, from->coefficients[t]);
        }
    }
    if (failure.status == SL_OK) {
        (void)(F->method == SL_METHOD_SUPERNODAL ? sli_multifrontal(F, from, &failure)
                                                 : sli_uplooking(F, from, &failure));
    }
    return sli_factor_done(F, from->A, &failure, started, stats);
}

static sli_source sli_source_matrix(const sl_csc *A) {
    sli_source from = {NULL, NULL, NULL, 0};
    from.A = A;
    return from;
}

/* Before the numbers change: whatever was made of them is out of date, even if this fails. */
static void sli_factor_begin(sl_factor *F) {
    F->is_good = 0;
    F->generation++;
}

SL_API sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source from = sli_source_matrix(A);
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    sli_factor_begin(F);
    status = sli_factor_check(F->S, A);
    return status == SL_OK ? sli_factor_numbers(F, &from, started, stats) : status;
}

/* The columns of L in which the entries of some columns of A stand, sorted. Returns how many. */
static sl_int sli_changed_seeds(const sl_symbolic *S, const sl_csc *A, const sl_int *columns,
                                sl_int count, uint64_t *seeds, uint64_t *scratch) {
    sl_int k, p, total = 0;
    for (k = 0; k < count; k++) {
        const sl_int j = S->iperm[columns[k]];
        sl_int least = INT32_MAX;
        for (p = A->p[columns[k]]; p < A->p[columns[k] + 1]; p++) {
            const sl_int seed = sli_min(j, S->iperm[A->i[p]]);
            if (seed != least) { /* most entries of a column go where the one before went */
                seeds[total++] = sli_keyed(seed, 0);
                least = seed;
            }
        }
    }
    sli_sort(seeds, total, scratch);
    return total;
}

SL_API sl_status sl_factor_refactor_changed(sl_factor *F, const sl_csc *A, const sl_int *columns,
                                            sl_int count, sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source from = sli_source_matrix(A);
    sli_pulling pulling;
    sli_block b = {NULL, 0, 0};
    uint64_t *seeds = NULL, *scratch = NULL, entries = 0;
    sli_failure failure;
    sl_status status;
    sl_int k;
    int pass;
    sli_stats_clear_error(stats);
    if (F == NULL || count < 0 || (count > 0 && columns == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_factor_fits(F, A);
    if (status != SL_OK) {
        return status;
    }
    for (k = 0; k < count; k++) {
        if (columns[k] < 0 || columns[k] >= F->S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, columns[k], -1, 0.0);
        }
        entries += (uint64_t)(A->p[columns[k] + 1] - A->p[columns[k]]);
    }
    if (F->method != SL_METHOD_SUPERNODAL || entries >= (uint64_t)sli_nnz(A)) {
        return sl_factor_refactor(F, A, stats);
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        seeds = SLI_TAKE(&b, uint64_t, entries);
        scratch = SLI_TAKE(&b, uint64_t, entries);
        sli_pulling_layout(&pulling, &b, F->S);
        status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    memset(&failure, 0, sizeof failure);
    sli_factor_begin(F);
    count = sli_changed_seeds(F->S, A, columns, count, seeds, scratch);
    (void)sli_left_looking_all(F, &pulling, &from, seeds, count, &failure);
    sli_free(&F->allocator, b.base);
    return sli_factor_done(F, A, &failure, started, stats);
}

/* The last pivot of a singular Laplacian is what rounding left of it: over meshes, grids and paths
 * of 1e2 to 1e6 rows it came to less than 60 + n/16 units of rounding, while no pivot of a regular
 * one fell below 1e9. */
static double sli_null_tolerance(sl_int n) {
    return (64.0 + n / 8) * DBL_EPSILON;
}

/* Are the method, the definiteness and the number of threads such as exist, the tolerances numbers? What is
 * null is either skipped or regularized. */
static int sli_way_is_known(const sl_options *opt) {
    return opt == NULL || ((unsigned)opt->method <= (unsigned)SL_METHOD_SUPERNODAL &&
                           (unsigned)opt->definiteness <= (unsigned)SL_SEMIDEFINITE &&
                           opt->threads.count >= 0 && opt->null_tolerance == opt->null_tolerance &&
                           opt->consistency_tolerance == opt->consistency_tolerance &&
                           opt->regularization >= 0.0 && sli_is_finite(opt->regularization) &&
                           (opt->regularization == 0.0 || opt->definiteness == SL_DEFINITE));
}

/* What the options say about null pivots, but for the arrays, which come later. */
static void sli_factor_rules(sl_factor *F, const sl_options *opt) {
    const double null = opt == NULL ? 0.0 : opt->null_tolerance;
    const double consistency = opt == NULL ? 0.0 : opt->consistency_tolerance;
    F->definiteness = opt == NULL ? SL_DEFINITE : opt->definiteness;
    F->rule.null_tolerance = null == 0.0 ? sli_null_tolerance(F->S->n) : null;
    F->rule.regularization = opt == NULL ? 0.0 : opt->regularization;
    F->rule.replaces = F->definiteness == SL_SEMIDEFINITE || F->rule.regularization != 0.0;
    F->consistency = consistency == 0.0 ? 1e-6 : consistency;
    F->is_centred = F->definiteness == SL_SEMIDEFINITE && opt->mass != NULL;
}

/* Copies the arrays that the rules refer to. */
static sl_status sli_factor_rules_fill(sl_factor *F, const sl_options *opt, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sl_int i;
    if (F->rule.regularization != 0.0 && opt->signs == NULL) {
        F->rule.signs = NULL;
    } else if (F->rule.regularization != 0.0) {
        for (i = 0; i < S->n; i++) {
            if (opt->signs[i] < -1 || opt->signs[i] > 1) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, i, -1, (double)opt->signs[i]);
            }
            F->rule.signs[S->iperm[i]] = (signed char)opt->signs[i];
        }
    }
    return F->mass != NULL ? sli_mass_fill(F, opt->mass, stats) : SL_OK;
}

/* A front costs some 50 ns whatever is in it: below this many flops each, as in diagonal matrices and
 * stars, rows are faster by up to 3.5 times; above it fronts are, by 1.1 to 6 times. */
static sl_method sli_method(const sl_symbolic *S, const sl_options *opt) {
    if (opt != NULL && opt->method != SL_METHOD_AUTO) {
        return opt->method;
    }
    return S->stats.flops < 8.0 * S->n_supers ? SL_METHOD_UP_LOOKING : SL_METHOD_SUPERNODAL;
}

/* Are the wishes for a factor such as can be followed? */
static int sli_factor_wishes_are_sound(const sl_options *opt) {
    return sli_allocator_is_whole(opt) && sli_way_is_known(opt);
}

/* A factor with its memory and its schedule, without numbers. */
static sl_status sli_factor_new(sl_factor **out, const sl_symbolic *S, const sl_options *opt,
                                sl_stats *stats) {
    const double started = sli_seconds();
    const sl_allocator a = sli_allocator(opt);
    sl_factor draft;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    memset(&draft, 0, sizeof draft);
    draft.allocator = a;
    draft.S = S;
    sli_factor_rules(&draft, opt);
    draft.method = sli_method(S, opt);
    draft.schedule.workers = 1;
    if (opt != NULL && draft.method == SL_METHOD_SUPERNODAL) {
        draft.threads = opt->threads;
        draft.schedule.workers = sli_min(sli_workers(&opt->threads), sli_max(S->n_supers, 1));
    }
    draft.kernels = sli_kernels_select(opt == NULL ? SL_ISA_AUTO : opt->isa);
    if (draft.kernels == NULL) {
        return SL_ERR_UNSUPPORTED;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_factor_layout(&draft, &b);
        draft.stats.bytes_factor = b.used;
        status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
    }
    if (status == SL_OK) {
        sl_factor *F = (sl_factor *)(void *)b.base;
        draft.stats.isa = draft.kernels->isa;
        draft.stats.method = draft.method;
        *F = draft;
        if (F->method == SL_METHOD_SUPERNODAL) {
            status = sli_factor_schedule(F);
        }
        status = status == SL_OK ? sli_factor_rules_fill(F, opt, stats) : status;
        F->stats.seconds_setup = sli_seconds() - started;
        if (status == SL_OK) {
            *out = F;
        } else {
            sl_factor_free(F);
        }
    }
    return status;
}

/* A factor of a matrix that fits the analysis. *out is NULL on entry. */
static sl_status sli_factor_make(sl_factor **out, const sl_symbolic *S, const sli_source *from,
                                 const sl_options *opt, sl_stats *stats) {
    sl_factor *F = NULL;
    sl_status status = sli_factor_new(&F, S, opt, stats);
    if (status == SL_OK) {
        sli_factor_begin(F);
        status = sli_factor_numbers(F, from, sli_seconds(), stats);
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
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (S == NULL || !sli_factor_wishes_are_sound(opt)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_factor_check(S, A);
    return status == SL_OK ? sli_factor_make(out, S, &from, opt, stats) : status;
}

SL_API void sl_factor_free(sl_factor *F) {
    if (F != NULL) {
        const sl_allocator a = F->allocator;
        sli_free(&a, F->waiting);
        sli_free(&a, F);
    }
}

#endif
