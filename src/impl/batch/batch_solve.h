/* batch.h: independent solves spread over workers by the entries of L that they read */
#ifndef SLI_BATCH_H
#define SLI_BATCH_H

#include "../public/batch.h"
#include "parallel.h"
#include "plan.h"

typedef struct sli_batch {
    const sl_factor *F; /* of requests that name none */
    const sl_request *requests;
    sl_int count, workers;
    sl_off blocks;         /* of up to 8 right-hand sides */
    double total;          /* entries of L that all blocks read */
    sl_work *const *works; /* one a worker, or NULL */
    unsigned char *memory; /* then `bytes` a worker */
    size_t bytes;
    int checks;      /* some factor wants to know whether its right-hand sides are consistent: */
    int only_checks; /* looks for a right-hand side that is not consistent, and writes no X */
} sli_batch;

SLI_INLINE const sl_factor *sli_request_factor(const sli_batch *b, const sl_request *r) {
    return r->factor != NULL ? r->factor : b->F;
}

static sli_query sli_request_query(const sl_factor *F, const sl_request *r) {
    return r->plan == NULL ? sli_query_all(F->S) : r->plan->query;
}

SLI_INLINE sli_layout sli_request_layout(const sl_request *r) {
    return r->is_interleaved ? SLI_INTERLEAVED : SLI_COLUMN_MAJOR;
}

/* What one block of 8 right-hand sides reads, and one for the call itself. */
SLI_INLINE double sli_query_weight(const sli_query *q) {
    return 1.0 + (double)q->forward.entries + (double)q->backward.entries +
           (double)q->shore.entries;
}

/* Right-hand sides of a request that start before some share of the batch: whole blocks of 8, from
 * `before`, what the requests before it weigh. */
static sl_int sli_blocks_before(double share, double before, double weight, sl_int nrhs) {
    const double blocks = ceil((share - before) / weight);
    return blocks <= 0.0 ? 0 : blocks * 8.0 >= nrhs ? nrhs : (sl_int)blocks * 8;
}

/* Worker k's scratch. */
static void *sli_batch_memory(const sli_batch *b, sl_int k) {
    return b->works != NULL ? b->works[k]->block : b->memory + (size_t)k * b->bytes;
}

/* Right-hand sides first .. last-1 of a request. */
static sl_status sli_batch_part(const sli_batch *b, const sl_request *r, const sli_query *q,
                                sl_int first, sl_int last, void *memory) {
    const sl_factor *F = sli_request_factor(b, r);
    const sli_layout layout = sli_request_layout(r);
    const sli_dense x_at = sli_dense_of(layout, r->ldx), b_at = sli_dense_of(layout, r->ldb);
    const double *B = q->nb > 0 ? r->B + (size_t)first * b_at.column : r->B;
    if (b->only_checks) {
        return F->checks ? sli_sweep_check(F, q, B, b_at, last - first, memory) : SL_OK;
    }
    return sli_sweep_blocks(F, q, r->X + (size_t)first * x_at.column, x_at, B, b_at, last - first,
                            memory);
}

/* Worker k's share of the batch. Where it checks, it leaves the first request that failed, or -1, in its
 * memory. */
static void sli_batch_share(void *data, sl_int k) {
    const sli_batch *b = (const sli_batch *)data;
    const double from = b->total * k / b->workers, to = b->total * (k + 1) / b->workers;
    void *memory = sli_batch_memory(b, k);
    double before = 0.0;
    sl_int m, failed = -1;
    for (m = 0; m < b->count && before < to && failed == -1; m++) {
        const sl_request *r = &b->requests[m];
        const sl_factor *F = sli_request_factor(b, r);
        const sli_query q = sli_request_query(F, r);
        const double weight = sli_query_weight(&q);
        const sl_int first = sli_blocks_before(from, before, weight, r->nrhs);
        const sl_int last =
            k + 1 == b->workers ? r->nrhs : sli_blocks_before(to, before, weight, r->nrhs);
        if (first < last && q.nx > 0 && sli_batch_part(b, r, &q, first, last, memory) != SL_OK) {
            failed = m;
        }
        before += weight * (sli_tiles(r->nrhs));
    }
    if (b->only_checks) {
        memcpy(memory, &failed, sizeof failed);
    }
}

/* Whether every right-hand side is consistent; *at: the first request with one that is not. */
static sl_status sli_batch_consistent(sli_batch *b, const sl_threads *threads, sl_int *at) {
    sl_int k, failed;
    b->only_checks = 1;
    sli_parallel(threads, b->workers, sli_batch_share, b);
    b->only_checks = 0;
    for (k = 0; k < b->workers && *at == -1; k++) { /* later workers have later requests */
        memcpy(&failed, sli_batch_memory(b, k), sizeof failed);
        *at = failed;
    }
    return *at == -1 ? SL_OK : SL_ERR_INCONSISTENT;
}

/* Checks every request; weighs them and finds the scratch that they need. */
static sl_status sli_batch_check(sli_batch *b, sl_int *at) {
    for (*at = 0; *at < b->count; ++*at) {
        const sl_request *r = &b->requests[*at];
        const sl_factor *F = sli_request_factor(b, r);
        sli_query q;
        size_t bytes;
        sl_status status;
        if (F == NULL) {
            return SL_ERR_ARGUMENT;
        }
        q = sli_request_query(F, r);
        status =
            sli_check_dense(r->X, r->ldx, q.nx, r->B, r->ldb, q.nb, sli_request_layout(r), r->nrhs);
        if (status != SL_OK) {
            return status;
        }
        if (!sli_query_fits(&q, F)) {
            return SL_ERR_STATE;
        }
        bytes = r->nrhs > 0 ? sli_vectors_bytes(&q, r->nrhs) : 0;
        if (bytes == SIZE_MAX) {
            return SL_ERR_TOO_LARGE;
        }
        b->bytes = bytes > b->bytes ? bytes : b->bytes;
        b->checks |= F->checks;
        b->blocks += sli_tiles(r->nrhs);
        b->total += sli_query_weight(&q) * (sli_tiles(r->nrhs));
    }
    *at = -1;
    b->bytes = b->bytes < SLI_ALIGN ? SLI_ALIGN : b->bytes;
    return SL_OK;
}

/* Refuses workspaces that are not there, or given twice. */
static sl_status sli_works_check(sl_work *const *works, sl_int workers) {
    sl_int k, other;
    for (k = 0; k < workers; k++) {
        if (works[k] == NULL) {
            return SL_ERR_ARGUMENT;
        }
        for (other = 0; other < k; other++) {
            if (works[k] == works[other]) {
                return SL_ERR_ARGUMENT;
            }
        }
    }
    return SL_OK;
}

/* Scratch for every worker: in the caller's workspaces, or in one block of a's to be freed. */
static sl_status sli_batch_reserve(sli_batch *b, sl_work *const *works, const sl_allocator *a) {
    sli_block block = {NULL, 0, 0};
    sl_status status = works == NULL ? SL_OK : sli_works_check(works, b->workers);
    sl_int k;
    int pass;
    for (k = 0; works != NULL && k < b->workers && status == SL_OK; k++) {
        status = sli_work_grow(works[k], b->bytes);
    }
    b->works = works;
    b->bytes = (b->bytes + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
    for (pass = 0; works == NULL && pass < 2 && status == SL_OK; pass++) {
        for (k = 0; k < b->workers; k++) {
            unsigned char *memory = (unsigned char *)sli_take(&block, b->bytes, 1);
            b->memory = k == 0 ? memory : b->memory;
        }
        status = pass == 0 ? sli_block_alloc(&block, a) : SL_OK;
    }
    return status;
}

SL_API sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests, sl_int count,
                                const sl_threads *threads, sl_work *const *works, sl_int *failed) {
    sl_threads none;
    sli_batch b;
    sl_status status;
    sl_int at = -1;
    memset(&none, 0, sizeof none);
    memset(&b, 0, sizeof b);
    threads = threads == NULL ? &none : threads;
    if (failed != NULL) {
        *failed = -1;
    }
    if (count < 0 || (count > 0 && requests == NULL) || threads->count < 0) {
        return SL_ERR_ARGUMENT;
    }
    if (F != NULL && !F->is_good) {
        return SL_ERR_STATE;
    }
    b.F = F;
    b.requests = requests;
    b.count = count;
    status = sli_batch_check(&b, &at);
    b.workers = sli_workers(threads);
    b.workers = b.blocks < b.workers ? (sl_int)b.blocks : b.workers;
    if (status == SL_OK && b.blocks > 0) {
        const sl_allocator *a = &sli_request_factor(&b, requests)->allocator;
        status = sli_batch_reserve(&b, works, a);
        if (status == SL_OK && b.checks) {
            status = sli_batch_consistent(&b, threads, &at);
        }
        if (status == SL_OK) {
            sli_parallel(threads, b.workers, sli_batch_share, &b);
        }
        if (works == NULL) {
            sli_free(a, b.memory);
        }
    }
    if (failed != NULL) {
        *failed = at;
    }
    return status;
}

#endif
