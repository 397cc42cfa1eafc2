/* batch_diagonal.h: diagonals of the inverses of several factors; a worker takes whole factors */
#ifndef SLI_BATCH_BATCH_DIAGONAL_H
#define SLI_BATCH_BATCH_DIAGONAL_H

#include "../../public/batch_diagonal.h"
#include "../../public/several.h"
#include "batch_solve.h"
#include "../inverse/entries.h"

/* One call. */
typedef struct sli_diagonal_batch {
    sl_factor *const *factors;
    sl_int count, workers;
    double *out; /* n_rows x count */
    size_t ldo;
    const sl_int *rows; /* NULL: all n_rows */
    sl_int n_rows;
    sl_work *const *works; /* one per worker, with room for every factor */
} sli_diagonal_batch;

/* The request for factor k. With several workers, none of them uses threads inside. */
static sli_entries sli_diagonal_batch_entries(const sli_diagonal_batch *d, sl_int k) {
    sli_entries q =
        sli_entries_of(d->factors[k], d->out + (size_t)k * d->ldo, d->rows, d->rows, d->n_rows);
    q.threads = d->workers > 1 ? sli_threads_of(NULL) : q.threads;
    return q;
}

/* Worker w computes every workers-th diagonal. */
SLI_HOT static void sli_diagonal_batch_worker(void *data, sl_int w) {
    const sli_diagonal_batch *d = (const sli_diagonal_batch *)data;
    sl_int k;
    for (k = w; k < d->count; k += d->workers) {
        sli_entries q = sli_diagonal_batch_entries(d, k);
        const sl_status status = sli_entries_run(&q, d->works[w], NULL);
        /* everything that can fail has been tried by sli_diagonal_batch_reserve */
        SLI_ASSERT(status == SL_OK);
        (void)status;
    }
}

/* Checks every factor and the rows; *at: the factor at fault, or -1. */
static sl_status sli_diagonal_batch_check(const sli_diagonal_batch *d, sl_int *at,
                                          sl_stats *stats) {
    for (*at = 0; *at < d->count; ++*at) {
        const sl_factor *F = d->factors[*at];
        const sl_status status =
            F == NULL ? sli_argument("a factor is NULL") : sli_inverse_check(F);
        if (status != SL_OK) {
            return status;
        }
        if (F->S != d->factors[0]->S) {
            return sli_refuse(SL_ERR_MISMATCH, "factors are of different analyses");
        }
    }
    *at = -1;
    return d->count == 0 ? SL_OK : sli_check_rows(d->factors[0]->S, d->rows, d->n_rows, 0, stats);
}

/* Grows every workspace to what any of the factors needs: that depends on the rows, on the
 * instruction set, and with pivots of both signs on the numbers. */
static sl_status sli_diagonal_batch_reserve(const sli_diagonal_batch *d) {
    sl_status status = SL_OK;
    sl_int k;
    for (k = 0; k < d->count && status == SL_OK; k++) {
        if (k == 0 || d->factors[k]->kernels != d->factors[k - 1]->kernels || d->workers == 1 ||
            sli_has_both_signs(d->factors[k])) { /* one worker: a factor's own threads count */
            sli_entries q = sli_diagonal_batch_entries(d, k);
            status = sli_entries_prepare(&q, d->works[0]);
        }
    }
    for (k = 1; k < d->workers && status == SL_OK; k++) {
        status = sli_work_grow(d->works[k], d->works[0]->size);
    }
    return status;
}

/* Reserves and runs, with workspaces for this call if the caller has passed none. */
static sl_status sli_diagonal_batch_run(sli_diagonal_batch *d, const sl_threads *threads) {
    const sl_allocator *a = &d->factors[0]->allocator;
    sl_work *own = NULL, **works = NULL;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_int w;
    if (d->works == NULL) {
        SLI_LAYOUT(&b, a, status) {
            own = SLI_TAKE(&b, sl_work, d->workers);
            works = SLI_TAKE(&b, sl_work *, d->workers);
        }
        if (status != SL_OK) {
            return status;
        }
        for (w = 0; w < d->workers; w++) {
            own[w] = sli_work_own(&d->factors[0]->allocator);
            works[w] = &own[w];
        }
        d->works = works;
    }
    status = sli_diagonal_batch_reserve(d);
    if (status == SL_OK) {
        sli_parallel(threads, d->workers, sli_diagonal_batch_worker, d);
    }
    for (w = 0; w < d->workers && own != NULL; w++) {
        sli_free(a, own[w].block);
    }
    sli_free(a, b.base);
    return status;
}

SL_API sl_status sl_batch_diagonal(sl_factor *const *factors, sl_int count, double *out, size_t ldo,
                                   const sl_int *rows, sl_int n_rows, const sl_options *opt,
                                   sl_work *const *works, sl_int *failed, sl_stats *stats) {
    const sl_threads *threads = sli_threads_of(opt);
    sli_diagonal_batch d;
    sl_status status;
    sl_int at = -1;
    sli_stats_clear_error(stats);
    if (failed != NULL) {
        *failed = -1;
    }
    status =
        sli_argument(count < 0                      ? "count is below 0"
                     : count > 0 && factors == NULL ? "factors is NULL"
                                                    : sli_options_wrong(opt, SLI_READS_NOTHING));
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    d.factors = factors;
    d.count = count;
    d.workers = sli_min(sli_workers(threads), count);
    d.out = out;
    d.ldo = ldo;
    d.rows = rows;
    d.n_rows = n_rows;
    d.works = works;
    status = sli_diagonal_batch_check(&d, &at, stats);
    if (failed != NULL) {
        *failed = at;
    }
    if (status != SL_OK || count == 0) {
        return sli_report(stats, status);
    }
    n_rows = d.n_rows = rows == NULL ? factors[0]->S->n : n_rows;
    status = sli_argument(n_rows < 0                              ? "n_rows is below 0"
                          : n_rows > 0 && out == NULL             ? "out is NULL"
                          : n_rows > 0 && !sli_is_ld(ldo, n_rows) ? "ldo is below n_rows"
                                                                  : NULL);
    status = status == SL_OK && works != NULL ? sli_check_works(works, d.workers) : status;
    status = status == SL_OK && n_rows > 0 ? sli_diagonal_batch_run(&d, threads) : status;
    return sli_report(stats, status);
}

#endif
