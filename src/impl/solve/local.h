/* local.h: sl_local_solve: one local solve without a plan, compiled in the workspace */
#ifndef SLI_SOLVE_LOCAL_H
#define SLI_SOLVE_LOCAL_H

#include "compile.h"
#include "sweep.h"

/* A local solve in progress. */
typedef struct sli_local {
    const sl_symbolic *S;
    sli_set b, x;
    sli_query query;
    sl_int nrhs;
    sl_stats *stats;
    sl_status status;      /* of sorting the sets */
    unsigned char *memory; /* vectors of the sweeps */
} sli_local;

static void sli_local_layout_seeds(void *data, sli_block *b) {
    sli_local *l = (sli_local *)data;
    sli_set_layout_seeds(&l->b, b);
    sli_set_layout_seeds(&l->x, b);
}

static void sli_local_sort(void *data) {
    sli_local *l = (sli_local *)data;
    SLI_CLEAR(l->query);
    l->status = sli_set_sort(l->S, &l->b, l->stats);
    if (l->status == SL_OK) {
        l->status = sli_set_sort(l->S, &l->x, l->stats);
    }
    if (l->status == SL_OK) {
        sli_set_measure(l->S, &l->b, &l->query.forward);
        sli_set_measure(l->S, &l->x, &l->query.backward);
    }
}

static void sli_local_layout_reaches(void *data, sli_block *b) {
    sli_local *l = (sli_local *)data;
    sli_set_layout_reach(&l->b, b, &l->query.forward);
    sli_set_layout_reach(&l->x, b, &l->query.backward);
}

static void sli_local_compile(void *data) {
    sli_local *l = (sli_local *)data;
    if (l->status == SL_OK) {
        sli_query_fill(&l->query, l->S, NULL, &l->b, &l->x);
    }
}

static void sli_local_layout_vectors(void *data, sli_block *b) {
    sli_local *l = (sli_local *)data;
    const size_t bytes = l->status == SL_OK && l->nrhs > 0
                             ? sli_vectors_bytes(&l->query, l->nrhs, SLI_BLOCK_MOST)
                             : 0;
    l->memory = (unsigned char *)sli_take(b, bytes, 1);
}

/* The sizes of the reaches are known only once the sets are sorted. If the workspace has to grow
 * for them, the sets are sorted again. */
static const sli_stage sli_local_stages[3] = {{sli_local_layout_seeds, sli_local_sort},
                                              {sli_local_layout_reaches, sli_local_compile},
                                              {sli_local_layout_vectors, NULL}};

SL_API sl_status sl_local_solve(const sl_factor *F, const sl_int *bset, sl_int nb,
                                const sl_int *xset, sl_int nx, double *X, size_t ldx,
                                const double *B, size_t ldb, sl_int nrhs, sl_work *W,
                                sl_stats *stats) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    sl_work own;
    sli_local l;
    sl_status status;
    sli_stats_clear_error(stats);
    status = F == NULL ? sli_argument("F is NULL") : sli_list(&bset, &nb, F->S->n);
    status = status == SL_OK ? sli_list(&xset, &nx, F->S->n) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(l);
    l.S = F->S;
    l.b = sli_set_of(F->S, bset, nb);
    l.x = sli_set_of(F->S, xset, nx);
    l.nrhs = nrhs;
    l.stats = stats;
    status = sli_rhs_check(&rhs, l.x.count, l.b.count);
    status = status == SL_OK ? sli_factor_has_numbers(F) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    status = sli_work_grow(W, 1); /* so that no array is NULL, not even an empty one */
    status = status == SL_OK ? sli_work_stages(W, sli_local_stages, 3, &l) : status;
    status = status == SL_OK ? l.status : status;
    if (status == SL_OK && stats != NULL) {
        sli_query_stats(&l.query, stats);
        stats->plan.bytes = 0;
    }
    if (status == SL_OK && nrhs > 0 && l.query.nx > 0) {
        status = sli_sweep(F, &l.query, &rhs, l.memory);
    }
    sli_free(&own.allocator, own.block);
    return sli_report(stats, status);
}

#endif
