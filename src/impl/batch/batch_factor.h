/* batch_factor.h: several factorizations over one analysis, whole factors shared out among workers */
#ifndef SLI_BATCH_FACTOR_H
#define SLI_BATCH_FACTOR_H

#include "combination.h"

typedef struct sli_family {
    sl_factor *const *factors; /* count; NULL: not there */
    sl_int count, workers;
    sli_source from; /* of the first: each has a column of coefficients */
} sli_family;

/* Has factor k no threads of its own? */
SLI_INLINE int sli_family_is_single(const sli_family *f, sl_int k) {
    return f->factors[k] != NULL && f->factors[k]->schedule.workers == 1;
}

static void sli_family_numbers(const sli_family *f, sl_int k) {
    sli_source from = f->from;
    if (from.terms > 0) {
        from.coefficients += (size_t)k * (size_t)from.terms;
    }
    sli_factor_begin(f->factors[k]);
    (void)sli_factor_numbers(f->factors[k], &from, sli_seconds(), NULL);
}

/* Worker w's turns among the factors without threads: they cost all alike. */
static void sli_family_share(void *data, sl_int w) {
    const sli_family *f = (const sli_family *)data;
    sl_int k, turn = 0;
    for (k = 0; k < f->count; k++) {
        if (sli_family_is_single(f, k) && turn++ % f->workers == w) {
            sli_family_numbers(f, k);
        }
    }
}

/* The numbers of all of them. Returns the first that failed, or count. */
static sl_int sli_family_run(sli_family *f, const sl_threads *threads) {
    sl_int k, singles = 0;
    for (k = 0; k < f->count; k++) {
        singles += sli_family_is_single(f, k);
    }
    f->workers = sli_max(sli_min(sli_workers(threads), singles), 1);
    sli_parallel(threads, f->workers, sli_family_share, f);
    for (k = 0; k < f->count; k++) {
        if (f->factors[k] != NULL && !sli_family_is_single(f, k)) {
            sli_family_numbers(f, k);
        }
    }
    for (k = 0; k < f->count && (f->factors[k] == NULL || f->factors[k]->is_good); k++) {
    }
    return k;
}

/* What the caller hears of them: of the first that failed, or of the last. */
static void sli_family_tell(const sli_family *f, sl_int at, double started, sl_stats *stats) {
    const sl_factor *F = f->count == 0 ? NULL : f->factors[sli_min(at, f->count - 1)];
    sl_int k;
    if (stats == NULL || F == NULL) {
        return;
    }
    sli_factor_stats_tell(F, stats);
    stats->seconds_setup = 0.0;
    stats->seconds_factor = sli_seconds() - started;
    stats->bytes_factor = 0;
    for (k = 0; k < f->count; k++) {
        if (f->factors[k] != NULL) {
            stats->seconds_setup += f->factors[k]->stats.seconds_setup;
            stats->bytes_factor += f->factors[k]->stats.bytes_factor;
        }
    }
}

/* Their memory, by this thread alone: whole rounds without threads, the rest with. Returns the first that
 * has none, or count. */
static sl_int sli_family_make(sl_factor **out, sl_int count, const sl_symbolic *S,
                              const sl_options *opt, sl_status *status, sl_stats *stats) {
    const sl_threads none = {0, NULL, NULL};
    const sl_int workers = opt == NULL ? 1 : sli_workers(&opt->threads);
    sl_options alone;
    sl_int k, at = count;
    memset(&alone, 0, sizeof alone);
    if (opt != NULL) {
        alone = *opt;
        alone.threads = none;
    }
    for (k = 0; k < count; k++) {
        const sl_status here = sli_factor_new(
            &out[k], S, k < count / workers * workers ? &alone : opt, at == count ? stats : NULL);
        if (here != SL_OK && at == count) {
            at = k;
            *status = here;
        }
    }
    return at;
}

SL_API sl_status sl_batch_factor(sl_factor **out, sl_int count, const sl_symbolic *S,
                                 const double *coefficients, const double *const *values,
                                 sl_int terms, const sl_options *opt, sl_int *failed,
                                 sl_stats *stats) {
    const sl_threads none = {0, NULL, NULL};
    double started;
    sli_family f;
    sl_status status;
    sl_int k, bare, at;
    sli_stats_clear_error(stats);
    if (failed != NULL) {
        *failed = -1;
    }
    for (k = 0; k < count && out != NULL; k++) {
        out[k] = NULL;
    }
    if (count < 0 || (count > 0 && out == NULL) || S == NULL || !sli_factor_wishes_are_sound(opt)) {
        return SL_ERR_ARGUMENT;
    }
    f.factors = out;
    f.count = count;
    status = sli_source_of_sum(S, coefficients, values, terms, &f.from);
    if (status != SL_OK || count == 0) {
        return status;
    }
    bare = sli_family_make(out, count, S, opt, &status, stats);
    started = sli_seconds();
    at = sli_family_run(&f, opt == NULL ? &none : &opt->threads);
    status = at < bare ? out[at]->status : status;
    sli_family_tell(&f, sli_min(at, bare), started, stats);
    for (k = at; k < count; k++) {
        if (out[k] != NULL && !out[k]->is_good) {
            sl_factor_free(out[k]);
            out[k] = NULL;
        }
    }
    at = sli_min(at, bare);
    if (failed != NULL && at < count) {
        *failed = at;
    }
    return status;
}

/* Whether the factors can be made again together; *at: the one at fault, -1 for all or none. */
static sl_status sli_family_check(sl_factor *const *factors, sl_int count, sl_int *at) {
    sl_int k, other;
    for (k = 0; k < count; k++) {
        *at = k;
        if (factors[k] == NULL) {
            return SL_ERR_ARGUMENT;
        }
        for (other = 0; other < k; other++) {
            if (factors[other] == factors[k]) {
                return SL_ERR_ARGUMENT;
            }
        }
        if (factors[k]->S != factors[0]->S) {
            return SL_ERR_STATE;
        }
    }
    *at = -1;
    return SL_OK;
}

SL_API sl_status sl_batch_refactor(sl_factor *const *factors, sl_int count,
                                   const double *coefficients, const double *const *values,
                                   sl_int terms, const sl_threads *threads, sl_int *failed,
                                   sl_stats *stats) {
    const sl_threads none = {0, NULL, NULL};
    const double started = sli_seconds();
    sli_family f;
    sl_status status;
    sl_int k, at = -1;
    sli_stats_clear_error(stats);
    threads = threads == NULL ? &none : threads;
    if (failed != NULL) {
        *failed = -1;
    }
    if (count < 0 || (count > 0 && factors == NULL) || threads->count < 0) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_family_check(factors, count, &at);
    if (status == SL_OK && count > 0) {
        status = sli_source_of_sum(factors[0]->S, coefficients, values, terms, &f.from);
    }
    if (status == SL_OK && count > 0) {
        f.factors = factors;
        f.count = count;
        k = sli_family_run(&f, threads);
        sli_family_tell(&f, k, started, stats);
        at = k < count ? k : -1;
        status = k < count ? factors[k]->status : SL_OK;
    }
    if (failed != NULL) {
        *failed = at;
    }
    return status;
}

#endif
