/* batch_factor.h: factors weighted sums of value arrays; a worker takes whole factors */
#ifndef SLI_BATCH_BATCH_FACTOR_H
#define SLI_BATCH_BATCH_FACTOR_H

#include "../../public/several.h"
#include "../factor/factor.h"

/* Describes a sum as the source of a factorization; checks its arguments. */
static sl_status sli_source_of_sum(const sl_symbolic *S, const double *coefficients,
                                   const double *const *values, sl_int terms, sli_source *from) {
    sl_int t;
    if (terms < 0 || (terms > 0 && (coefficients == NULL || values == NULL))) {
        return sli_argument(terms < 0              ? "terms is below 0"
                            : coefficients == NULL ? "coefficients is NULL"
                                                   : "values is NULL");
    }
    for (t = 0; t < terms; t++) {
        if (values[t] == NULL && S->scatter_begin[S->n_supers] > 0) {
            return sli_argument("an array of values is NULL");
        }
    }
    from->A = NULL;
    from->values = values;
    from->coefficients = coefficients;
    from->terms = terms;
    return SL_OK;
}

/* One call. Factor k has the coefficients from k * source.terms on. */
typedef struct sli_factor_batch {
    sl_factor *const *factors; /* count; NULL: could not be created */
    sl_int count, workers;
    sli_source source; /* of the first factor */
} sli_factor_batch;

/* Is factor k one that uses no threads inside? */
SLI_INLINE int sli_factor_batch_is_serial(const sli_factor_batch *f, sl_int k) {
    return f->factors[k] != NULL && f->factors[k]->schedule.workers == 1;
}

/* Computes the numbers of factor k. */
static void sli_factor_batch_compute(const sli_factor_batch *f, sl_int k) {
    sli_source source = f->source;
    if (source.terms > 0) {
        source.coefficients += (size_t)k * (size_t)source.terms;
    }
    sli_factor_begin(f->factors[k]);
    (void)sli_factor_numbers(f->factors[k], &source, sli_seconds(), NULL);
}

/* Worker w computes every workers-th of the serial factors. All factors cost the same. */
static void sli_factor_batch_worker(void *data, sl_int w) {
    const sli_factor_batch *f = (const sli_factor_batch *)data;
    sl_int k, turn = 0;
    for (k = 0; k < f->count; k++) {
        if (sli_factor_batch_is_serial(f, k) && turn++ % f->workers == w) {
            f->factors[k]->work.is_worker = 1;
            sli_factor_batch_compute(f, k);
        }
    }
}

/* Computes all numbers: first the serial factors, many at a time, then one by one those with
 * threads and those that need memory to judge pivots. Returns the index of the first that failed,
 * or count. */
static sl_int sli_factor_batch_run(sli_factor_batch *f, const sl_threads *threads) {
    sl_int k, n_serial = 0;
    for (k = 0; k < f->count; k++) {
        n_serial += sli_factor_batch_is_serial(f, k);
    }
    f->workers = sli_max(sli_min(sli_workers(threads), n_serial), 1);
    sli_parallel(threads, f->workers, sli_factor_batch_worker, f);
    for (k = 0; k < f->count; k++) {
        sl_factor *F = f->factors[k];
        const int again =
            F != NULL && (F->work.is_worker == 2 || !sli_factor_batch_is_serial(f, k));
        if (F != NULL) {
            F->work.is_worker = 0;
        }
        if (again) {
            sli_factor_batch_compute(f, k);
        }
    }
    for (k = 0; k < f->count && (f->factors[k] == NULL || f->factors[k]->is_valid); k++) {
    }
    return k;
}

/* Fills the factor group from the first factor that failed, or from the last one. Times and bytes
 * are sums over all factors. */
static void sli_factor_batch_stats(const sli_factor_batch *f, sl_int at, double started,
                                   sl_stats *stats) {
    const sl_factor *F = f->factors[sli_min(at, f->count - 1)];
    sl_int k;
    if (stats == NULL || F == NULL) {
        return;
    }
    sli_factor_stats_report(F, stats);
    stats->factor.seconds_setup = 0.0;
    stats->factor.seconds = sli_seconds() - started;
    stats->factor.bytes = 0;
    for (k = 0; k < f->count; k++) {
        if (f->factors[k] != NULL) {
            stats->factor.seconds_setup += f->factors[k]->stats.factor.seconds_setup;
            stats->factor.bytes += f->factors[k]->stats.factor.bytes;
        }
    }
}

/* Creates the factors, on the calling thread. The factors of whole rounds of `workers` are serial;
 * the remaining ones have the threads of the options. Returns the index of the first that failed,
 * or count. first: the error of that one. */
static sl_int sli_factor_batch_create(sl_factor **out, sl_int count, const sl_symbolic *S,
                                      const sl_options *opt, sl_status *status, sl_stats *first) {
    const sl_int workers = sli_workers(sli_threads_of(opt));
    sl_options serial;
    sl_int k, at = count;
    SLI_CLEAR(serial);
    if (opt != NULL) {
        serial = *opt;
        serial.threads = *sli_threads_of(NULL);
    }
    for (k = 0; k < count; k++) {
        const sl_status here =
            sli_factor_new(&out[k], S, k < count / workers * workers ? &serial : opt, NULL, NULL);
        if (here != SL_OK && at == count) {
            at = k;
            *status = here;
            first->error = sli_found(NULL, here);
        }
    }
    return at;
}

SL_API sl_status sl_factor_create_sums(sl_factor **out, sl_int count, const sl_symbolic *S,
                                       const double *coefficients, const double *const *values,
                                       sl_int terms, const sl_options *opt, sl_int *failed,
                                       sl_stats *stats) {
    double started;
    sli_factor_batch f;
    sl_stats first;
    sl_status status;
    sl_int k, n_created, at;
    sli_stats_clear_error(stats);
    if (failed != NULL) {
        *failed = -1;
    }
    for (k = 0; k < count && out != NULL; k++) {
        out[k] = NULL;
    }
    status = sli_argument(count < 0                  ? "count is below 0"
                          : count > 0 && out == NULL ? "out is NULL"
                          : S == NULL                ? "S is NULL"
                                                     : sli_factor_options_wrong(opt));
    f.factors = out;
    f.count = count;
    if (status == SL_OK) {
        status = sli_source_of_sum(S, coefficients, values, terms, &f.source);
    }
    if (status != SL_OK || count == 0) {
        return sli_report(stats, status);
    }
    n_created = sli_factor_batch_create(out, count, S, opt, &status, &first);
    started = sli_seconds();
    at = sli_factor_batch_run(&f, sli_threads_of(opt));
    if (at < n_created) {
        status = out[at]->status;
        first.error = out[at]->stats.error;
    }
    sli_factor_batch_stats(&f, sli_min(at, n_created), started, stats);
    if (status != SL_OK) {
        (void)sli_fail_as(stats, status, &first.error);
    }
    for (k = at; k < count; k++) {
        if (out[k] != NULL && !out[k]->is_valid) {
            sl_factor_free(out[k]);
            out[k] = NULL;
        }
    }
    at = sli_min(at, n_created);
    if (failed != NULL && at < count) {
        *failed = at;
    }
    return sli_report(stats, status);
}

/* Can the factors be refactored together? *at: the one at fault; -1 for none or all. */
static sl_status sli_factor_batch_check(sl_factor *const *factors, sl_int count, sl_int *at) {
    sl_int k, other;
    for (k = 0; k < count; k++) {
        sl_status status;
        *at = k;
        if (factors[k] == NULL) {
            return sli_argument("a factor is NULL");
        }
        for (other = 0; other < k; other++) {
            if (factors[other] == factors[k]) {
                return sli_argument("a factor is given twice");
            }
        }
        if (factors[k]->S != factors[0]->S) {
            return sli_refuse(SL_ERR_MISMATCH, "factors are of different analyses");
        }
        status = sli_factor_may_change(factors[k]);
        if (status != SL_OK) {
            return status;
        }
    }
    *at = -1;
    return SL_OK;
}

SL_API sl_status sl_factor_refactor_sums(sl_factor *const *factors, sl_int count,
                                         const double *coefficients, const double *const *values,
                                         sl_int terms, const sl_options *opt, sl_int *failed,
                                         sl_stats *stats) {
    const sl_threads *threads = sli_threads_of(opt);
    const double started = sli_seconds();
    sli_factor_batch f;
    sl_status status;
    sl_int k, at = -1;
    sli_stats_clear_error(stats);
    if (failed != NULL) {
        *failed = -1;
    }
    status =
        sli_argument(count < 0                      ? "count is below 0"
                     : count > 0 && factors == NULL ? "factors is NULL"
                                                    : sli_options_wrong(opt, SLI_READS_NOTHING));
    status = status == SL_OK ? sli_factor_batch_check(factors, count, &at) : status;
    if (status == SL_OK && count > 0) {
        status = sli_source_of_sum(factors[0]->S, coefficients, values, terms, &f.source);
    }
    for (k = 0; k < count && status == SL_OK; k++) { /* loaded factors need scratch */
        status = sli_factor_prepare(factors[k], 0);
        at = status == SL_OK ? -1 : k;
    }
    if (status == SL_OK && count > 0) {
        f.factors = factors;
        f.count = count;
        k = sli_factor_batch_run(&f, threads);
        sli_factor_batch_stats(&f, k, started, stats);
        at = k < count ? k : -1;
        if (k < count) {
            status = sli_fail_as(stats, factors[k]->status, &factors[k]->stats.error);
        }
    }
    if (failed != NULL) {
        *failed = at;
    }
    return sli_report(stats, status);
}

#endif
