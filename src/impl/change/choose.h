/* choose.h: sl_factor_change: rank-one changes, the reach of the change, or all of L */
#ifndef SLI_CHANGE_CHOOSE_H
#define SLI_CHANGE_CHOOSE_H

#include "../factor/leftlooking.h"
#include "edges.h"

/* Seconds of the parts of the three ways, measured on grids of 1e4 to 1e6 rows. */
#define SLI_CHANGE_ENTRY 0.3e-9 /* an entry of L in a pass of rank-one changes */
#define SLI_CHANGE_PIVOT 4e-9   /* a pivot that one vector changes */
#define SLI_CHANGE_FRONT 0.8e-6 /* a front, beside its flops */
#define SLI_CHANGE_VISIT 0.6e-6 /* a descendant that updates a front again */
#define SLI_CHANGE_INPUT 4e-9   /* an entry of A */
/* Beyond this drift F is refactored: after some 40,000 changes of moderate size. */
#define SLI_CHANGE_DRIFT 1e-11

/* A choice between the three ways. */
typedef struct sli_way {
    sl_int *columns; /* n_columns: the columns of A that store changed entries, ascending */
    sl_int n_columns;
    uint64_t *seeds, *scratch; /* for the entries of these columns */
    uint64_t *keys;            /* 2 count: for sorting them */
    sl_int n_seeds;
    double flops_update, flops_changed, flops_refactor;
    double update, changed, refactor; /* seconds */
    sl_change_reason reason;
} sli_way;

/* Seconds of a flop in a front, by sl_isa. In a pass of rank-one changes it takes half of this. */
static const double sli_change_flop[] = {0.0, 0.3e-9, 0.03e-9, 0.0125e-9, 0.08e-9};

/* Seconds of a refactorization. */
static double sli_way_refactor(const sl_factor *F) {
    const sl_symbolic *S = F->S;
    return sli_change_flop[F->kernels->isa] * S->stats.symbolic.flops +
           SLI_CHANGE_FRONT * S->n_supers +
           SLI_CHANGE_INPUT * (double)S->scatter_begin[S->n_supers];
}

/* Flops of the elimination of supernode s alone. */
static double sli_way_front(const sl_symbolic *S, sl_int s) {
    const double w = S->steps[s].width, h = w + S->steps[s].below;
    return w * (h * h - h * w + w * w / 3.0); /* about the sum of (h - j)^2 over its columns */
}

/* Flops of the updates of the descendants of supernode s to columns start .. end-1, as
 * sli_left_factor and sli_kept_update compute them. *visits += descendants. */
static double sli_way_gather(const sl_symbolic *S, sl_int s, sl_int start, sl_int end,
                             sl_int *visits) {
    double flops = 0.0;
    sl_int d;
    for (d = s - 1; d >= S->first_descendant[s];) {
        const sl_int *of = S->rows + S->rows_begin[d], below = S->steps[d].below;
        const sl_int first = sli_lower_bound(of, below, start);
        const sl_int m = sli_lower_bound(of + first, below - first, end);
        if (m > 0) {
            flops += (double)S->steps[d].width * m * (2.0 * (below - first) - m);
            ++*visits;
            d--;
        } else {
            d = S->first_descendant[d] - 1;
        }
    }
    return flops;
}

/* Counts the reach of the change, up to a cost of `limit`: to count the descendants takes time. */
static void sli_way_measure(sli_way *c, const sl_factor *F, double limit) {
    const sl_symbolic *S = F->S;
    const double input = SLI_CHANGE_INPUT * (double)S->scatter_begin[S->n_supers];
    sl_int k = 0, s, next, visits = 0;
    c->flops_changed = 0.0;
    c->changed = input;
    while (k < c->n_seeds && c->changed <= limit) {
        s = S->super_of[sli_key(c->seeds[k])];
        next = sli_next_seed(S, c->seeds, c->n_seeds, &k);
        for (; s != -1 && s < next && c->changed <= limit; s = S->super_parent[s]) {
            visits++;
            c->flops_changed +=
                sli_way_front(S, s) +
                sli_way_gather(S, s, S->super_first[s], S->super_first[s + 1], &visits);
            c->changed = input + SLI_CHANGE_VISIT * visits +
                         sli_change_flop[F->kernels->isa] * c->flops_changed;
        }
    }
}

/* Chooses. can_update: rank-one changes are possible. */
static sl_change_method sli_way_make(sli_way *c, const sl_factor *F, int can_update) {
    const sl_symbolic *S = F->S;
    const int can_reach =
        F->is_valid && F->method == SL_METHOD_SUPERNODAL && F->storage == SL_STORAGE_DOUBLE;
    c->flops_refactor = S->stats.symbolic.flops;
    c->refactor = sli_way_refactor(F);
    c->reason = can_update ? SL_CHANGE_CHEAPEST : SL_CHANGE_UNSUITED;
    if (!F->is_valid) {
        return SL_CHANGE_REFACTOR;
    }
    if (F->drift > SLI_CHANGE_DRIFT) {
        c->reason = SL_CHANGE_DRIFT;
        return SL_CHANGE_REFACTOR;
    }
    if (can_reach && (!can_update || c->changed < c->update)) { /* else counted before */
        sli_way_measure(c, F, can_update ? fmin(c->update, c->refactor) : c->refactor);
    }
    if (can_update && c->update <= c->refactor && (!can_reach || c->update <= c->changed)) {
        return SL_CHANGE_UPDATE;
    }
    return can_reach && c->changed <= c->refactor ? SL_CHANGE_REACH : SL_CHANGE_REFACTOR;
}

/* The columns of A that store the changed entries, each once: many entries share a column. */
static void sli_way_columns(sli_way *c, const sli_rank *q) {
    const int is_upper = q->u.F->S->stats.symbolic.triangle == SL_TRIANGLE_UPPER;
    sl_int k, total = 0;
    for (k = 0; k < q->n_entries; k++) {
        const sl_int i = q->entry_rows[k], j = q->entry_columns[k];
        const uint64_t key = sli_keyed(is_upper ? sli_max(i, j) : sli_min(i, j), 0);
        if (total < 2 || (key != c->keys[total - 1] && key != c->keys[total - 2])) {
            c->keys[total++] = key;
        }
    }
    sli_sort(c->keys, total, c->keys + q->n_entries);
    c->n_columns = 0;
    for (k = 0; k < total; k++) {
        const sl_int column = sli_key(c->keys[k]);
        if (c->n_columns == 0 || c->columns[c->n_columns - 1] != column) {
            c->columns[c->n_columns++] = column;
        }
    }
}

/* Seconds of rank-one changes. */
static double sli_way_update(const sli_rank *q, double entries, double pivots, double flops) {
    return (SLI_CHANGE_ENTRY * entries + SLI_CHANGE_PIVOT * pivots +
            0.5 * sli_change_flop[q->u.F->kernels->isa] * flops) *
           (q->has_trial || q->has_log ? 1.5 : 1.0);
}

/* Estimates the rank-one changes from below, with the path of the column in the middle: half a
 * vector for each column or edge, as an edge may be named twice. Where even they take too long, the
 * vectors need not be sorted. */
static void sli_way_estimate(sli_way *c, const sli_rank *q) {
    sl_int k, edges = 0, passes;
    sli_reach R;
    for (k = 0; k < q->n_entries; k++) {
        edges += q->entry_rows[k] != q->entry_columns[k];
    }
    passes = sli_max(c->n_columns, edges) / (2 * SLI_TILE);
    sli_reach_measure(q->u.F->S, c->seeds + c->n_seeds / 2, c->n_seeds > 0, &R);
    c->flops_update = 4.0 * SLI_TILE * passes * (double)R.entries;
    c->update = sli_way_update(q, passes * (double)R.entries, (double)SLI_TILE * passes * R.columns,
                               c->flops_update);
}

/* Sorts the vectors of q, for their number and their cost, and prepares their passes. */
static sl_status sli_way_count(sli_way *c, sli_rank *q, sl_work *W) {
    const sl_status status = sli_work_stages(W, sli_edges_stages, 3, q);
    c->flops_update = q->flops;
    c->update = sli_way_update(q, (double)q->entries, q->pivots, q->flops);
    return status == SL_OK ? q->status : status;
}

static sl_status sli_way_run(sli_way *c, sli_rank *q, const sl_csc *A, sl_work *W,
                             sl_change_method *method) {
    sl_factor *F = q->u.F;
    const int can_update = sli_rank_is_suited(F) && F->is_valid;
    sl_status status = SL_OK;
    c->n_seeds = sli_changed_seeds(F->S, A, c->columns, c->n_columns, c->seeds, c->scratch);
    if (can_update) {
        sli_way_estimate(c, q);
    }
    *method = q->n_entries == 0 && F->is_valid ? SL_CHANGE_NONE : sli_way_make(c, F, can_update);
    if (*method == SL_CHANGE_UPDATE) {
        status = sli_way_count(c, q, W);
        if (status != SL_OK) {
            return status;
        }
        *method = sli_way_make(c, F, 1);
    }
    if (*method == SL_CHANGE_UPDATE) {
        status = sli_rank_run(q);
        if (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE || status == SL_ERR_NOT_FINITE) {
            c->reason = SL_CHANGE_REFUSED; /* A may be indefinite: its factorization decides */
            *method = SL_CHANGE_REFACTOR;
        }
    }
    if (*method == SL_CHANGE_REACH) {
        status = sl_factor_refactor_changed(F, A, c->columns, c->n_columns, q->stats);
    } else if (*method == SL_CHANGE_REFACTOR) {
        status = sl_factor_refactor(F, A, q->stats);
    }
    return status;
}

SL_API sl_status sl_factor_change(sl_factor *F, const sl_csc *A, const sl_int *rows,
                                  const sl_int *columns, const double *deltas, sl_int count,
                                  sl_work *W, sl_stats *stats) {
    const double started = sli_seconds();
    sl_change_method method = SL_CHANGE_NONE;
    sli_block b = {NULL, 0, 0}, seeds = {NULL, 0, 0};
    sli_way c;
    sli_rank q;
    sl_work own;
    uint64_t entries = 0;
    sl_status status;
    sl_int k;
    int pass;
    sli_stats_clear_error(stats);
    status = sli_edges_check(F, rows, columns, deltas, count, stats);
    status = status == SL_OK && !sli_factor_may_change(F) ? SL_ERR_STATE : status;
    status = status == SL_OK ? sli_factor_check(F->S, A) : status;
    if (status != SL_OK) {
        return status;
    }
    memset(&c, 0, sizeof c);
    sli_edges_begin(&q, F, rows, columns, deltas, count, stats);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        c.columns = SLI_TAKE(&b, sl_int, count);
        c.keys = SLI_TAKE(&b, uint64_t, 2 * (uint64_t)count);
        status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    sli_way_columns(&c, &q);
    for (k = 0; k < c.n_columns; k++) {
        entries += (uint64_t)(A->p[c.columns[k] + 1] - A->p[c.columns[k]]);
    }
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        c.seeds = SLI_TAKE(&seeds, uint64_t, entries);
        c.scratch = SLI_TAKE(&seeds, uint64_t, entries);
        status = pass == 0 ? sli_block_alloc(&seeds, &F->allocator) : SL_OK;
    }
    status = status == SL_OK ? sli_work_grow(W, 1) : status;
    status = status == SL_OK ? sli_way_run(&c, &q, A, W, &method) : status;
    sli_free(&F->allocator, seeds.base);
    sli_free(&F->allocator, b.base);
    sli_free(&own.allocator, own.block);
    if (status == SL_OK) {
        sli_rank_report(&q, started, stats);
    }
    if (status == SL_OK && stats != NULL) {
        stats->change.method = method;
        stats->change.reason = c.reason;
        stats->change.flops_update = c.flops_update;
        stats->change.flops_changed = c.flops_changed;
        stats->change.flops_refactor = c.flops_refactor;
    }
    return status;
}

#endif
