/* batch_solve.h: many independent solves, shared among workers by the entries of L they read */
#ifndef SLI_BATCH_BATCH_SOLVE_H
#define SLI_BATCH_BATCH_SOLVE_H

#include "../../public/batch.h"
#include "../base/parallel.h"
#include "../solve/plan.h"

/* One call. */
typedef struct sli_solve_batch {
    const sl_factor *F; /* of requests without a factor */
    const sl_request *requests;
    sl_int count, workers;
    sl_off blocks;         /* of up to 8 right-hand sides */
    double total;          /* entries of L that all blocks read */
    sl_work *const *works; /* one per worker; NULL: memory is used */
    unsigned char *memory; /* `bytes` per worker */
    size_t bytes;
    int checks;      /* 1: some factor requires consistent right-hand sides */
    int only_checks; /* 1: this pass checks the right-hand sides and writes no X */
} sli_solve_batch;

SLI_INLINE const sl_factor *sli_request_factor(const sli_solve_batch *b, const sl_request *r) {
    return r->factor != NULL ? r->factor : b->F;
}

SLI_NOINLINE static sli_query sli_request_query(const sl_factor *F, const sl_request *r) {
    return r->plan == NULL ? sli_query_all(F->S) : r->plan->query;
}

/* The weight of a block of 8 right-hand sides: the entries that it reads, and 1 for the call. */
SLI_INLINE double sli_query_weight(const sli_query *q) {
    return 1.0 + (double)q->forward.entries + (double)q->backward.entries + (double)q->used.entries;
}

/* Right-hand sides of a request that begin before a point of the batch, given by weight; `before`
 * is the weight of the requests before this one. Only whole blocks of 8 are counted. */
static sl_int sli_blocks_before(double point, double before, double weight, sl_int nrhs) {
    const double blocks = ceil((point - before) / weight);
    return blocks <= 0.0 ? 0 : blocks * 8.0 >= nrhs ? nrhs : (sl_int)blocks * 8;
}

/* The scratch of worker k. */
static void *sli_solve_batch_memory(const sli_solve_batch *b, sl_int k) {
    return b->works != NULL ? b->works[k]->block : b->memory + (size_t)k * b->bytes;
}

/* Solves for the right-hand sides first .. last-1 of a request, or only checks them. */
static sl_status sli_solve_batch_columns(const sli_solve_batch *b, const sl_request *r,
                                         const sli_query *q, sl_int first, sl_int last,
                                         void *memory) {
    const sl_factor *F = sli_request_factor(b, r);
    const sli_rhs all = sli_rhs_of(r->X, r->ldx, r->B, r->ldb, r->nrhs);
    const sli_rhs part = sli_rhs_part(&all, first, last - first);
    if (b->only_checks) {
        return sli_sweep_check(F, q, &part, memory);
    }
    return sli_sweep_blocks(F, q, &part, memory);
}

/* Worker k solves an equal share of the weight. It leaves the first request that failed, or -1, in
 * its scratch; when checking, it ends there. */
static void sli_solve_batch_worker(void *data, sl_int k) {
    const sli_solve_batch *b = (const sli_solve_batch *)data;
    const double from = b->total * k / b->workers, to = b->total * (k + 1) / b->workers;
    void *memory = sli_solve_batch_memory(b, k);
    double before = 0.0;
    sl_int m, failed = -1;
    for (m = 0; m < b->count && before < to && (failed == -1 || !b->only_checks); m++) {
        const sl_request *r = &b->requests[m];
        const sl_factor *F = sli_request_factor(b, r);
        const sli_query q = sli_request_query(F, r);
        const double weight = sli_query_weight(&q);
        const sl_int first = sli_blocks_before(from, before, weight, r->nrhs);
        const sl_int last =
            k + 1 == b->workers ? r->nrhs : sli_blocks_before(to, before, weight, r->nrhs);
        if (first < last && q.nx > 0 &&
            sli_solve_batch_columns(b, r, &q, first, last, memory) != SL_OK) {
            failed = failed == -1 ? m : failed;
        }
        before += weight * (sli_tiles(r->nrhs));
    }
    memcpy(memory, &failed, sizeof failed);
}

/* Solves, or only checks that every right-hand side is consistent. *at: the first request with one
 * that is not, or with a solution that is not finite, or -1. */
static sl_status sli_solve_batch_run(sli_solve_batch *b, const sl_threads *threads, sl_int *at) {
    sl_int k, failed;
    sli_parallel(threads, b->workers, sli_solve_batch_worker, b);
    for (k = 0; k < b->workers && *at == -1; k++) { /* later workers have later requests */
        memcpy(&failed, sli_solve_batch_memory(b, k), sizeof failed);
        *at = failed;
    }
    if (*at != -1 && !b->only_checks) {
        const sl_request *r = &b->requests[*at];
        const sli_rhs rhs = sli_rhs_of(r->X, r->ldx, r->B, r->ldb, r->nrhs);
        return sli_not_finite(&rhs, sli_request_query(sli_request_factor(b, r), r).nb);
    }
    return *at == -1 ? SL_OK : sli_inconsistent();
}

/* Checks every request, sums the weights, and finds the size of the scratch; *at: the request at
 * fault, or -1. */
static sl_status sli_solve_batch_check(sli_solve_batch *b, sl_int *at) {
    for (*at = 0; *at < b->count; ++*at) {
        const sl_request *r = &b->requests[*at];
        const sl_factor *F = sli_request_factor(b, r);
        const sli_rhs rhs = sli_rhs_of(r->X, r->ldx, r->B, r->ldb, r->nrhs);
        sli_query q;
        size_t bytes;
        sl_status status;
        if (F == NULL) {
            return sli_argument("F is NULL, also in a request");
        }
        q = sli_request_query(F, r);
        status = sli_rhs_check(&rhs, q.nx, q.nb);
        status = status == SL_OK ? sli_query_check(&q, F) : status;
        if (status != SL_OK) {
            return status;
        }
        bytes = r->nrhs > 0 ? sli_vectors_bytes(&q, r->nrhs, sli_block_most(F)) : 0;
        b->bytes = bytes > b->bytes ? bytes : b->bytes;
        b->checks |= F->null.checks;
        b->blocks += sli_tiles(r->nrhs);
        b->total += sli_query_weight(&q) * (sli_tiles(r->nrhs));
    }
    *at = -1;
    b->bytes = b->bytes < SLI_ALIGN ? SLI_ALIGN : b->bytes;
    return SL_OK;
}

/* Refuses missing workspaces and one that is given twice. */
static sl_status sli_check_works(sl_work *const *works, sl_int workers) {
    sl_int k, other;
    for (k = 0; k < workers; k++) {
        if (works[k] == NULL) {
            return sli_argument("a workspace is NULL");
        }
        for (other = 0; other < k; other++) {
            if (works[k] == works[other]) {
                return sli_argument("a workspace is given twice");
            }
        }
    }
    return SL_OK;
}

/* Reserves scratch for every worker: in the caller's workspaces, or in one block from `a` that the
 * caller of this function frees. */
static sl_status sli_solve_batch_reserve(sli_solve_batch *b, sl_work *const *works,
                                         const sl_allocator *a) {
    sli_block block = {NULL, 0};
    sl_status status = SL_OK;
    sl_int k;
    for (k = 0; works != NULL && k < b->workers && status == SL_OK; k++) {
        status = sli_work_grow(works[k], b->bytes);
    }
    b->works = works;
    if (works != NULL) {
        return status;
    }
    SLI_LAYOUT(&block, a, status) {
        for (k = 0; k < b->workers; k++) {
            unsigned char *memory = (unsigned char *)sli_take(&block, b->bytes, 1);
            b->memory = k == 0 ? memory : b->memory;
        }
    }
    return status;
}

SL_API sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests, sl_int count,
                                const sl_options *opt, sl_work *const *works, sl_int *failed) {
    const sl_threads *threads = sli_threads_of(opt);
    sli_solve_batch b;
    sl_status status;
    sl_int at = -1;
    SLI_CLEAR(b);
    if (failed != NULL) {
        *failed = -1;
    }
    status =
        sli_argument(count < 0                       ? "count is below 0"
                     : count > 0 && requests == NULL ? "requests is NULL"
                                                     : sli_options_wrong(opt, SLI_READS_NOTHING));
    status = status == SL_OK && F != NULL ? sli_factor_has_numbers(F) : status;
    if (status != SL_OK) {
        return status;
    }
    b.F = F;
    b.requests = requests;
    b.count = count;
    status = sli_solve_batch_check(&b, &at);
    b.workers = sli_workers(threads);
    b.workers = b.blocks < b.workers ? (sl_int)b.blocks : b.workers;
    status = status == SL_OK && works != NULL ? sli_check_works(works, b.workers) : status;
    if (status == SL_OK && b.blocks > 0) {
        const sl_allocator *a = &sli_request_factor(&b, requests)->allocator;
        const double shares = b.total / SLI_SOLVE_ENTRIES; /* few small ones are left to one */
        b.workers = shares < b.workers ? sli_max((sl_int)shares, 1) : b.workers;
        status = sli_solve_batch_reserve(&b, works, a);
        if (status == SL_OK && b.checks) {
            b.only_checks = 1;
            status = sli_solve_batch_run(&b, threads, &at);
            b.only_checks = 0;
        }
        if (status == SL_OK) {
            status = sli_solve_batch_run(&b, threads, &at);
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
