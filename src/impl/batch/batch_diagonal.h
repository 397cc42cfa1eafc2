/* batch_inverse.h: diagonals of several inverses over one analysis, whole factors shared out among workers */
#ifndef SLI_BATCH_INVERSE_H
#define SLI_BATCH_INVERSE_H

#include "../public/several.h"
#include "batch.h"
#include "inverse_entries.h"

typedef struct sli_diagonals {
    const sl_factor *const *factors;
    sl_int count, workers;
    double *out; /* n_rows x count */
    size_t ldo;
    const sl_int *rows; /* NULL: all n_rows */
    sl_int n_rows;
    sl_threads none;
    sl_work *const *works; /* one a worker, with room for any of the factors */
} sli_diagonals;

/* One factor's. Inside a loop over several workers none of them begins another. */
static sli_entries sli_diagonals_entries(const sli_diagonals *d, sl_int k) {
    sli_entries q =
        sli_entries_of(d->factors[k], d->out + (size_t)k * d->ldo, d->rows, d->rows, d->n_rows);
    q.threads = d->workers > 1 ? &d->none : q.threads;
    return q;
}

/* Worker w's turns among the factors. */
static void sli_diagonals_share(void *data, sl_int w) {
    const sli_diagonals *d = (const sli_diagonals *)data;
    sl_int k;
    for (k = w; k < d->count; k += d->workers) {
        sli_entries q = sli_diagonals_entries(d, k);
        const sl_status status = sli_entries_run(&q, d->works[w], NULL);
        SLI_ASSERT(status == SL_OK); /* all that could go wrong was tried before */
        (void)status;
    }
}

/* Checks every factor; *at: the one at fault. */
static sl_status sli_diagonals_check(const sli_diagonals *d, sl_int *at, sl_stats *stats) {
    for (*at = 0; *at < d->count; ++*at) {
        const sl_factor *F = d->factors[*at];
        if (F == NULL) {
            return SL_ERR_ARGUMENT;
        }
        if (!F->is_good || F->S != d->factors[0]->S) {
            return SL_ERR_STATE;
        }
    }
    *at = -1;
    return d->count == 0 ? SL_OK : sli_check_rows(d->factors[0]->S, d->rows, d->n_rows, 0, stats);
}

/* Room in every workspace for any of the factors: it depends on the rows, and on the instruction set. */
static sl_status sli_diagonals_reserve(const sli_diagonals *d) {
    sl_status status = SL_OK;
    sl_int k;
    for (k = 0; k < d->count && status == SL_OK; k++) {
        if (k == 0 || d->factors[k]->kernels != d->factors[k - 1]->kernels ||
            d->workers == 1) { /* then threads of their own count */
            sli_entries q = sli_diagonals_entries(d, k);
            status = sli_entries_prepare(&q, d->works[0]);
        }
    }
    for (k = 1; k < d->workers && status == SL_OK; k++) {
        status = sli_work_grow(d->works[k], d->works[0]->size);
    }
    return status;
}

/* The same with workspaces of the call's own. */
static sl_status sli_diagonals_run(sli_diagonals *d, const sl_threads *threads) {
    const sl_allocator *a = &d->factors[0]->allocator;
    sl_work *own = NULL, **works = NULL;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int w;
    int pass;
    for (pass = 0; pass < 2 && d->works == NULL && status == SL_OK; pass++) {
        own = SLI_TAKE(&b, sl_work, d->workers);
        works = SLI_TAKE(&b, sl_work *, d->workers);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    if (d->works == NULL) {
        for (w = 0; w < d->workers; w++) {
            own[w] = sli_work_own(&d->factors[0]->allocator);
            works[w] = &own[w];
        }
        d->works = works;
    }
    status = sli_diagonals_reserve(d);
    if (status == SL_OK) {
        sli_parallel(threads, d->workers, sli_diagonals_share, d);
    }
    for (w = 0; w < d->workers && own != NULL; w++) {
        sli_free(a, own[w].block);
    }
    sli_free(a, b.base);
    return status;
}

SL_API sl_status sl_batch_diagonal(const sl_factor *const *factors, sl_int count, double *out,
                                   size_t ldo, const sl_int *rows, sl_int n_rows,
                                   const sl_threads *threads, sl_work *const *works, sl_int *failed,
                                   sl_stats *stats) {
    const sl_threads none = {0, NULL, NULL};
    sli_diagonals d;
    sl_status status;
    sl_int at = -1;
    sli_stats_clear_error(stats);
    threads = threads == NULL ? &none : threads;
    if (failed != NULL) {
        *failed = -1;
    }
    if (count < 0 || (count > 0 && factors == NULL) || threads->count < 0) {
        return SL_ERR_ARGUMENT;
    }
    d.none = none;
    d.factors = factors;
    d.count = count;
    d.workers = sli_min(sli_workers(threads), count);
    d.out = out;
    d.ldo = ldo;
    d.rows = rows;
    d.n_rows = n_rows;
    d.works = works;
    status = sli_diagonals_check(&d, &at, stats);
    if (failed != NULL) {
        *failed = at;
    }
    if (status != SL_OK || count == 0) {
        return status;
    }
    n_rows = d.n_rows = rows == NULL ? factors[0]->S->n : n_rows;
    if (n_rows < 0 || (n_rows > 0 && (out == NULL || ldo < (size_t)n_rows))) {
        return SL_ERR_ARGUMENT;
    }
    status = works == NULL ? SL_OK : sli_works_check(works, d.workers);
    return status == SL_OK && n_rows > 0 ? sli_diagonals_run(&d, threads) : status;
}

#endif
