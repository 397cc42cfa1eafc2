/* plan.h: local solves: queries compiled from a b-set and an x-set, kept as a plan or made in the workspace */
#ifndef SLI_PLAN_H
#define SLI_PLAN_H

#include "../public/plan.h"
#include "solve.h"

struct sl_plan {
    sl_allocator allocator;
    size_t bytes;
    sli_query query;
};

/* A set of rows while it is compiled. rows NULL: all of them. */
typedef struct sli_set {
    const sl_int *rows;
    sl_int count;
    sl_int
        inside; /* seeds that the reach starts from; those after them are in the fence's boundary */
    const sli_fence *fence; /* NULL: none */
    uint64_t
        *seeds; /* count: its columns of L ascending, each with its place in the caller's order */
    uint64_t *scratch; /* count */
    sl_int *place;     /* count */
    sli_step *steps;
    sl_int *compact;      /* the steps' rows */
    unsigned char *shore; /* chunks of the fence's boundary */
} sli_set;

static sli_set sli_set_of(const sl_symbolic *S, const sl_int *rows, sl_int count) {
    sli_set set;
    memset(&set, 0, sizeof set);
    set.rows = rows;
    set.count = rows == NULL ? S->n : count;
    return set;
}

/* What sorting a set needs, and what its compiled reach needs. */
static void sli_set_layout_seeds(sli_set *set, sli_block *b) {
    const size_t count = set->rows == NULL ? 0 : (size_t)set->count;
    set->seeds = SLI_TAKE(b, uint64_t, count);
    set->scratch = SLI_TAKE(b, uint64_t, count);
}

static void sli_set_layout_reach(sli_set *set, sli_block *b, const sli_reach *R) {
    if (set->rows != NULL) {
        set->place = SLI_TAKE(b, sl_int, set->count);
        set->steps = SLI_TAKE(b, sli_step, R->count);
        set->compact = SLI_TAKE(b, sl_int, R->n_rows);
        set->shore = SLI_TAKE(b, unsigned char,
                              set->fence == NULL ? 0 : sli_region_chunks(set->fence->n_rows));
    }
}

/* Sorts a set by column of L; refuses rows out of range or given twice. */
static sl_status sli_set_sort(const sl_symbolic *S, sli_set *set, sl_stats *stats) {
    sl_int k;
    set->inside = set->count;
    set->fence = NULL;
    if (set->rows == NULL) {
        return SL_OK;
    }
    for (k = 0; k < set->count; k++) {
        const sl_int i = set->rows[k];
        if (i < 0 || i >= S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, i, -1, 0.0);
        }
        set->seeds[k] = sli_keyed(S->iperm[i], k);
    }
    sli_sort(set->seeds, set->count, set->scratch);
    for (k = 1; k < set->count; k++) {
        if (sli_key(set->seeds[k - 1]) == sli_key(set->seeds[k])) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, S->perm[sli_key(set->seeds[k])], -1, 0.0);
        }
    }
    return SL_OK;
}

/* Is every row of a sorted set in a fence? Of all rows nobody asks. */
static int sli_set_is_within(const sl_symbolic *S, const sli_set *set, const sli_fence *fence) {
    sl_int k;
    for (k = 0; set->rows != NULL && k < set->count; k++) {
        const sl_int column = sli_key(set->seeds[k]);
        if (sli_fence_find(S, fence, S->super_of[column]) == -1 &&
            sli_fence_boundary(fence, column) == -1) {
            return 0;
        }
    }
    return set->rows != NULL;
}

/* Puts a set behind a fence that it is in: the seeds in its boundary behind the others, both ascending. */
static void sli_set_enclose(const sl_symbolic *S, sli_set *set, const sli_fence *fence) {
    sl_int k, inside = 0, rest = 0;
    for (k = 0; k < set->count; k++) {
        if (sli_fence_find(S, fence, S->super_of[sli_key(set->seeds[k])]) != -1) {
            set->seeds[inside++] = set->seeds[k];
        } else {
            set->scratch[rest++] = set->seeds[k];
        }
    }
    for (k = 0; k < rest; k++) {
        set->seeds[inside + k] = set->scratch[k];
    }
    set->inside = inside;
    set->fence = fence;
}

/* Counts the reach of a sorted set. */
static void sli_set_measure(const sl_symbolic *S, const sli_set *set, sli_reach *R) {
    if (set->rows == NULL) {
        *R = sli_reach_all(S);
    } else {
        sli_reach_measure_within(S, set->fence, set->seeds, set->inside, R);
    }
}

/* Marks the chunks of the boundary that a compiled set has to do with: those of its own rows, and of rows below its
 * subtrees, which are those below their roots. */
static void sli_set_mark(sli_set *set, const sli_reach *R) {
    const sl_int n = set->fence->n_rows, base = R->columns - n;
    const sl_int *rows = R->rows;
    sl_int k, i;
    memset(set->shore, 0, (size_t)sli_region_chunks(n));
    for (k = set->inside; k < set->count; k++) {
        set->shore[(set->place[sli_value(set->seeds[k])] - base) / SLI_REGION_COLUMNS] = 1;
    }
    for (k = 0; k < R->count; k++) {
        for (i = 0; R->steps[k].up == -1 && i < R->steps[k].below; i++) {
            set->shore[(rows[i] - base) / SLI_REGION_COLUMNS] = 1;
        }
        rows += R->steps[k].below;
    }
}

/* Doubles of the region's inverse in the chunks that either set marks. */
static sl_off sli_shore_entries(const sl_region *R, const sli_set *b, const sli_set *x) {
    sl_off sum = 0;
    sl_int k;
    for (k = 0; k < sli_region_chunks(R->fence.n_rows); k++) {
        sum += b->shore[k] || x->shore[k] ? R->begin[k + 1] - R->begin[k] : 0;
    }
    return sum;
}

/* Fills the reach and the place of each of the caller's rows in its vector. */
static void sli_set_fill(const sl_symbolic *S, sli_set *set, sli_reach *R, const sl_int **place) {
    sl_int k, at = 0;
    if (set->rows == NULL) {
        *place = S->iperm;
        return;
    }
    sli_reach_fill_within(S, set->fence, set->seeds, set->inside, set->steps, set->compact, R);
    for (k = 0; k < set->inside; k++) {
        set->place[sli_value(set->seeds[k])] = sli_reach_place(R, &at, sli_key(set->seeds[k]));
    }
    for (; k < set->count; k++) {
        set->place[sli_value(set->seeds[k])] =
            R->columns - set->fence->n_rows +
            sli_fence_boundary(set->fence, sli_key(set->seeds[k]));
    }
    if (set->fence != NULL) {
        sli_set_mark(set, R);
    }
    *place = set->place;
}

/* Whether two compiled reaches are the same columns. */
static int sli_reach_equal(const sli_reach *a, const sli_reach *b) {
    sl_int k;
    if (a->count != b->count || a->columns != b->columns) {
        return 0;
    }
    for (k = 0; k < a->count && a->steps != b->steps; k++) {
        if (a->steps[k].column != b->steps[k].column) {
            return 0;
        }
    }
    return 1;
}

/* Compiles both sets, laid out and measured. Equal reaches share one vector, which spares the
 * crossing. */
static void sli_query_fill(sli_query *q, const sl_symbolic *S, const sl_region *region, sli_set *b,
                           sli_set *x) {
    q->S = S;
    q->region = region;
    q->nb = b->count;
    q->nx = x->count;
    sli_set_fill(S, b, &q->forward, &q->b_place);
    sli_set_fill(S, x, &q->backward, &q->x_place);
    q->is_shared = sli_reach_equal(&q->forward, &q->backward);
    q->shore.b = b->shore;
    q->shore.x = x->shore;
    q->shore.entries = region == NULL ? 0 : sli_shore_entries(region, b, x);
}

static void sli_query_stats(const sli_query *q, sl_stats *stats) {
    const sl_int boundary = q->region == NULL ? 0 : q->region->fence.n_rows;
    stats->b_supernodes = q->forward.count;
    stats->b_columns = q->forward.columns - boundary;
    stats->b_entries = q->forward.entries;
    stats->x_supernodes = q->backward.count;
    stats->x_columns = q->backward.columns - boundary;
    stats->x_entries = q->backward.entries;
    stats->plan_in_region = q->region != NULL;
    stats->plan_region_entries = q->shore.entries;
}

static sl_status sli_check_sets(const sl_symbolic *S, const sl_int *bset, sl_int nb,
                                const sl_int *xset, sl_int nx) {
    return S == NULL || (bset != NULL && nb < 0) || (xset != NULL && nx < 0) ? SL_ERR_ARGUMENT
                                                                             : SL_OK;
}

SL_API sl_status sl_plan_create(sl_plan **out, const sl_symbolic *S, const sl_int *bset, sl_int nb,
                                const sl_int *xset, sl_int nx, const sl_options *opt,
                                sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sli_block seeds = {NULL, 0, 0}, kept = {NULL, 0, 0};
    sl_plan *P = NULL;
    sli_query query;
    const sl_region *region = opt == NULL ? NULL : opt->region;
    sli_set b, x;
    sl_status status;
    int pass;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    status = sli_allocator_is_whole(opt) ? sli_check_sets(S, bset, nb, xset, nx) : SL_ERR_ARGUMENT;
    if (status == SL_OK && region != NULL && region->S != S) {
        status = SL_ERR_STATE;
    }
    if (status != SL_OK) {
        return status;
    }
    memset(&query, 0, sizeof query);
    b = sli_set_of(S, bset, nb);
    x = sli_set_of(S, xset, nx);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_set_layout_seeds(&b, &seeds);
        sli_set_layout_seeds(&x, &seeds);
        status = pass == 0 ? sli_block_alloc(&seeds, &a) : SL_OK;
    }
    status = status == SL_OK ? sli_set_sort(S, &b, stats) : status;
    status = status == SL_OK ? sli_set_sort(S, &x, stats) : status;
    if (status == SL_OK && region != NULL && sli_set_is_within(S, &b, &region->fence) &&
        sli_set_is_within(S, &x, &region->fence)) {
        sli_set_enclose(S, &b, &region->fence);
        sli_set_enclose(S, &x, &region->fence);
    } else {
        region = NULL;
    }
    if (status == SL_OK) {
        sli_set_measure(S, &b, &query.forward);
        sli_set_measure(S, &x, &query.backward);
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        P = (sl_plan *)sli_take(&kept, 1, sizeof(sl_plan));
        sli_set_layout_reach(&b, &kept, &query.forward);
        sli_set_layout_reach(&x, &kept, &query.backward);
        status = pass == 0 ? sli_block_alloc(&kept, &a) : SL_OK;
    }
    if (status == SL_OK) {
        sli_query_fill(&query, S, region, &b, &x);
        P->allocator = a;
        P->bytes = kept.used;
        P->query = query;
        *out = P;
        sl_plan_stats(P, stats);
    }
    sli_free(&a, seeds.base);
    return status;
}

SL_API void sl_plan_free(sl_plan *P) {
    if (P != NULL) {
        const sl_allocator a = P->allocator;
        sli_free(&a, P);
    }
}

SL_API void sl_plan_stats(const sl_plan *P, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (P != NULL && stats != NULL) {
        sli_query_stats(&P->query, stats);
        stats->bytes_plan = P->bytes;
    }
}

SL_API sl_status sl_plan_solve(const sl_plan *P, const sl_factor *F, double *X, size_t ldx,
                               const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
    return P == NULL || F == NULL
               ? SL_ERR_ARGUMENT
               : sli_solve(F, &P->query, X, ldx, B, ldb, SLI_COLUMN_MAJOR, nrhs, W);
}

SL_API sl_status sl_plan_solve_interleaved(const sl_plan *P, const sl_factor *F, double *X,
                                           size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                                           sl_work *W) {
    return P == NULL || F == NULL
               ? SL_ERR_ARGUMENT
               : sli_solve(F, &P->query, X, ldx, B, ldb, SLI_INTERLEAVED, nrhs, W);
}

SL_API sl_status sl_work_reserve_plan(sl_work *W, const sl_plan *P, sl_int nrhs) {
    return W == NULL || P == NULL || nrhs < 0 ? SL_ERR_ARGUMENT
                                              : sli_work_reserve(W, &P->query, nrhs);
}

/* Seeds, reaches and vectors of one local solve, all in the workspace. How much the reaches take is
 * known only once the seeds are sorted: where W is too small for them it grows and the sorting is
 * done again. */
static sl_status sli_local(const sl_factor *F, double *X, size_t ldx, sli_set *bset, sli_set *xset,
                           const double *B, size_t ldb, sl_int nrhs, sl_work *W, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sli_query q;
    size_t bytes = 0, vectors;
    sl_status status;
    for (;;) {
        sli_block b = {NULL, 0, 0};
        sli_set_layout_seeds(bset, &b);
        sli_set_layout_seeds(xset, &b);
        status =
            b.overflow ? SL_ERR_TOO_LARGE : sli_work_grow(W, bytes > b.used ? bytes : b.used + 1);
        if (status != SL_OK) {
            return status;
        }
        b.base = (unsigned char *)W->block;
        b.used = 0;
        sli_set_layout_seeds(bset, &b);
        sli_set_layout_seeds(xset, &b);
        status = sli_set_sort(S, bset, stats);
        status = status == SL_OK ? sli_set_sort(S, xset, stats) : status;
        if (status != SL_OK) {
            return status;
        }
        sli_set_measure(S, bset, &q.forward);
        sli_set_measure(S, xset, &q.backward);
        sli_set_layout_reach(bset, &b, &q.forward);
        sli_set_layout_reach(xset, &b, &q.backward);
        bytes = b.used;
        if (b.overflow || bytes > W->size) {
            if (b.overflow) {
                return SL_ERR_TOO_LARGE;
            }
            continue; /* the reaches would run over the end: nothing is written yet */
        }
        sli_query_fill(&q, S, NULL, bset, xset);
        vectors = nrhs > 0 ? sli_vectors_bytes(&q, nrhs) : 0;
        if (vectors > SIZE_MAX - bytes) {
            return SL_ERR_TOO_LARGE;
        }
        if (bytes + vectors <= W->size) {
            break;
        }
        bytes += vectors;
    }
    if (stats != NULL) {
        sli_query_stats(&q, stats);
        stats->bytes_plan = 0;
    }
    if (nrhs > 0 && q.nx > 0) {
        return sli_sweep(F, &q, X, sli_dense_of(SLI_COLUMN_MAJOR, ldx), B,
                         sli_dense_of(SLI_COLUMN_MAJOR, ldb), nrhs,
                         (unsigned char *)W->block + bytes);
    }
    return SL_OK;
}

SL_API sl_status sl_local_solve(const sl_factor *F, double *X, size_t ldx, const sl_int *xset,
                                sl_int nx, const double *B, size_t ldb, const sl_int *bset,
                                sl_int nb, sl_int nrhs, sl_work *W, sl_stats *stats) {
    sl_work own;
    sli_set b, x;
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_check_sets(F->S, bset, nb, xset, nx);
    if (status != SL_OK) {
        return status;
    }
    b = sli_set_of(F->S, bset, nb);
    x = sli_set_of(F->S, xset, nx);
    status = sli_check_dense(X, ldx, x.count, B, ldb, b.count, SLI_COLUMN_MAJOR, nrhs);
    if (status != SL_OK) {
        return status;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    own = sli_work_own(&F->allocator);
    status = sli_local(F, X, ldx, &b, &x, B, ldb, nrhs, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
