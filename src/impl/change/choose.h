/* choose.h: sl_factor_change_entries: rank-one changes, the reach of the change, or all of L */
#ifndef SLI_CHANGE_CHOOSE_H
#define SLI_CHANGE_CHOOSE_H

#include "../factor/costs.h"
#include "reached.h"
#include "edges.h"

/* A pivot that one vector changes, in the unit of costs.h: a division and some checks. */
#define SLI_COST_PIVOT 50.0

/* A choice between the three methods: rank-one changes, the reach of the change, all of L. */
typedef struct sli_change_choice {
    uint64_t *seeds; /* n_seeds: the columns of L that hold changed entries, ascending */
    sl_int n_seeds;
    uint64_t *scratch; /* 2 count: for sorting */
    sl_int *columns;   /* room for the columns of A that store changed entries */
    double flops_update, flops_changed, flops_refactor;
    double update, changed, refactor; /* in the unit of costs.h */
    sl_change_reason reason;
} sli_change_choice;

/* The cost of fronts with so many flops, of which all entries of A are looked at. */
static double sli_choose_cost(const sl_factor *F, double fronts, double flops) {
    return sli_cost_flop(F->kernels) * flops + SLI_COST_FRONT * fronts +
           SLI_COST_INPUT * (double)F->S->scatter_begin[F->S->n_supers];
}

/* Does a change reach supernode s? */
static int sli_choose_is_reached(const sli_change_choice *c, const sl_symbolic *S, sl_int s) {
    const uint64_t first = sli_keyed(S->super_first[S->first_descendant[s]], 0);
    sl_int low = 0, high = c->n_seeds; /* finds the first seed from there on */
    while (low < high) {
        const sl_int middle = low + (high - low) / 2;
        if (c->seeds[middle] < first) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < c->n_seeds && sli_key(c->seeds[low]) < S->super_first[s + 1];
}

/* Flops of supernode s, which is reached: of its front and of the kept ones below it. */
static double sli_choose_step(const sli_change_choice *c, const sl_symbolic *S, sl_int s,
                              sl_int *visits) {
    double flops = sli_front_flops(&S->steps[s]);
    sl_int k;
    for (k = s - 1; k >= S->first_descendant[s]; k = S->first_descendant[k] - 1) {
        if (!sli_choose_is_reached(c, S, k)) {
            flops += sli_kept_flops(S, k, visits);
            ++*visits;
        }
    }
    return flops;
}

/* Counts the reach of the change, up to a cost of `limit`: to count the descendants takes time. */
static void sli_choose_measure(sli_change_choice *c, const sl_factor *F, double limit) {
    const sl_symbolic *S = F->S;
    sl_int k = 0, s, next, steps = 0; /* fronts, and descendants that update them */
    c->flops_changed = 0.0;
    c->changed = sli_choose_cost(F, 0.0, 0.0);
    while (k < c->n_seeds && c->changed <= limit) {
        s = S->super_of[sli_key(c->seeds[k])];
        next = sli_next_seed(S, c->seeds, c->n_seeds, &k);
        for (; s != -1 && s < next && c->changed <= limit; s = S->super_parent[s]) {
            steps++;
            c->flops_changed += sli_choose_step(c, S, s, &steps);
            c->changed = sli_choose_cost(F, steps, c->flops_changed);
        }
    }
}

/* Chooses. can_update: rank-one changes are possible. */
static sl_change_method sli_choose_make(sli_change_choice *c, const sl_factor *F, int can_update) {
    const sl_symbolic *S = F->S;
    const int can_reach = F->is_valid && sli_reached_is_suited(F);
    c->flops_refactor = S->stats.symbolic.flops;
    c->refactor = sli_choose_cost(F, S->n_supers, c->flops_refactor);
    c->reason = can_update ? SL_CHANGE_CHEAPEST : SL_CHANGE_UNSUITED;
    if (!F->is_valid) {
        return SL_CHANGE_REFACTOR;
    }
    if (F->history.drift > SLI_CHANGE_DRIFT) {
        c->reason = SL_CHANGE_DRIFT;
        return SL_CHANGE_REFACTOR;
    }
    if (can_reach && (!can_update || c->changed < c->update)) { /* else counted before */
        sli_choose_measure(c, F, can_update ? fmin(c->update, c->refactor) : c->refactor);
    }
    if (can_update && c->update <= c->refactor && (!can_reach || c->update <= c->changed)) {
        return SL_CHANGE_UPDATE;
    }
    return can_reach && c->changed <= c->refactor ? SL_CHANGE_REACH : SL_CHANGE_REFACTOR;
}

/* Appends a key that is not one of the last two. Returns how many there are. */
SLI_INLINE sl_int sli_choose_append(uint64_t *keys, sl_int total, uint64_t key) {
    if (total < 2 || (key != keys[total - 1] && key != keys[total - 2])) {
        keys[total++] = key;
    }
    return total;
}

/* Sorts keys and drops repeated ones: many entries share a column. Returns how many are left. */
static sl_int sli_choose_sort(uint64_t *keys, sl_int total, uint64_t *scratch) {
    sl_int k, count = 0;
    sli_sort(keys, total, scratch);
    for (k = 0; k < total; k++) {
        if (count == 0 || keys[count - 1] != keys[k]) {
            keys[count++] = keys[k];
        }
    }
    return count;
}

/* The columns of L that hold the changed entries. */
static void sli_choose_seeds(sli_change_choice *c, const sli_rank *q) {
    const sl_int *iperm = q->S->iperm;
    sl_int k, total = 0;
    for (k = 0; k < q->n_entries; k++) {
        const sl_int a = iperm[q->entry_rows[k]], b = iperm[q->entry_columns[k]];
        total = sli_choose_append(c->seeds, total, sli_keyed(sli_min(a, b), 0));
    }
    c->n_seeds = sli_choose_sort(c->seeds, total, c->scratch);
}

/* Recomputes the columns of L that the change reaches. */
static sl_status sli_choose_reach(sli_change_choice *c, const sli_rank *q, const sl_csc *A) {
    sl_factor *F = q->u.F;
    const int is_upper = F->S->stats.symbolic.triangle == SL_TRIANGLE_UPPER;
    sli_changes changes;
    sl_int k, total = 0;
    for (k = 0; k < q->n_entries; k++) {
        const sl_int i = q->entry_rows[k], j = q->entry_columns[k];
        const sl_int column = is_upper ? sli_max(i, j) : sli_min(i, j);
        total = sli_choose_append(c->scratch, total, sli_keyed(column, 0));
    }
    total = sli_choose_sort(c->scratch, total, c->scratch + q->n_entries);
    for (k = 0; k < total; k++) {
        c->columns[k] = sli_key(c->scratch[k]);
    }
    changes.columns = c->columns;
    changes.count = total;
    changes.seeds = c->seeds;
    changes.n_seeds = c->n_seeds;
    return sli_reached_refactor(F, A, &changes, q->stats);
}

/* The cost of rank-one changes: passes read and write their entries, a trial or a copy once more,
 * and each vector changes them in a register and its pivots one by one. */
static double sli_choose_update(const sli_rank *q, double entries, double pivots, double flops) {
    const double passes = q->has_trial || q->has_log ? 3.0 : 2.0;
    return passes * entries + sli_cost_flop(q->u.F->kernels) * flops + SLI_COST_PIVOT * pivots;
}

/* Estimates the rank-one changes with the path of the column in the middle: a vector for each seed
 * or edge. Where they take too long, the vectors need not be sorted. */
static void sli_choose_estimate(sli_change_choice *c, const sli_rank *q) {
    sl_int k, edges = 0, passes;
    sli_reach R;
    SLI_CLEAR(R);
    for (k = 0; k < q->n_entries; k++) {
        edges += q->entry_rows[k] != q->entry_columns[k];
    }
    passes = sli_max(c->n_seeds, edges) / SLI_TILE;
    if (passes > 0) {
        sli_reach_measure(q->S, c->seeds + c->n_seeds / 2, 1, &R);
    }
    c->flops_update = 4.0 * SLI_TILE * passes * (double)R.entries;
    c->update = sli_choose_update(q, passes * (double)R.entries,
                                  (double)SLI_TILE * passes * R.columns, c->flops_update);
}

/* Sorts the vectors of q, for their number and their cost, and prepares their passes. */
static sl_status sli_choose_count(sli_change_choice *c, sli_rank *q, sl_work *W) {
    const sl_status status = sli_work_stages(W, sli_edges_stages, 3, q);
    c->flops_update = q->flops;
    c->update = sli_choose_update(q, (double)q->entries, q->pivots, q->flops);
    return status == SL_OK ? q->status : status;
}

static sl_status sli_choose_run(sli_change_choice *c, sli_rank *q, const sl_csc *A, sl_work *W,
                                sl_change_method *method) {
    sl_factor *F = q->u.F;
    const int can_update = sli_rank_is_suited(F) && F->is_valid;
    const uint64_t generation = F->generation;
    sl_status status = SL_OK;
    sli_choose_seeds(c, q);
    if (can_update) {
        sli_choose_estimate(c, q);
    }
    *method = q->n_entries == 0 && F->is_valid ? SL_CHANGE_NONE : sli_choose_make(c, F, can_update);
    if (*method == SL_CHANGE_UPDATE) {
        status = sli_choose_count(c, q, W);
        if (status != SL_OK) {
            return status;
        }
        *method = sli_choose_make(c, F, 1);
    }
    if (*method == SL_CHANGE_UPDATE) {
        status = sli_rank_run_prepared(q);
        if (status != SL_OK) {
            c->reason = SL_CHANGE_REFUSED; /* A may be indefinite: its factorization decides */
            *method = SL_CHANGE_REFACTOR;
        } else if (F->history.drift > SLI_CHANGE_DRIFT) {
            c->reason = SL_CHANGE_DRIFT;
            *method = SL_CHANGE_REFACTOR;
        }
    }
    if (*method == SL_CHANGE_REACH) {
        status = sli_choose_reach(c, q, A);
    } else if (*method == SL_CHANGE_REFACTOR) {
        status = sl_factor_refactor(F, A, q->stats);
        if (status != SL_OK && F->generation != generation && F->is_valid) {
            F->is_valid = 0; /* it has changed, and A cannot replace what it has lost */
            F->status = status;
        }
    }
    return status;
}

/* Changes F in the cheapest way; A decides where rank-one changes are refused. */
static sl_status sli_choose_cheapest(sli_rank *q, const sl_csc *A, sl_work *W, double started) {
    const sl_allocator *a = &q->u.F->allocator;
    const uint64_t count = (uint64_t)q->n_entries;
    sl_change_method method = SL_CHANGE_NONE;
    sl_stats *stats = q->stats;
    sli_block b = {NULL, 0};
    sli_change_choice c;
    sl_work own = sli_work_own(a);
    sl_status status = SL_OK;
    SLI_CLEAR(c);
    q->u.least = sli_rank_least(q->u.F);
    SLI_LAYOUT(&b, a, status) {
        c.seeds = SLI_TAKE(&b, uint64_t, count);
        c.scratch = SLI_TAKE(&b, uint64_t, 2 * count);
        c.columns = SLI_TAKE(&b, sl_int, count);
    }
    W = W == NULL ? &own : W;
    status = status == SL_OK ? sli_work_grow(W, 1) : status;
    status = status == SL_OK ? sli_choose_run(&c, q, A, W, &method) : status;
    sli_free(a, b.base);
    sli_free(a, own.block);
    if (status == SL_OK) {
        sli_rank_report(q, started, stats);
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

/* Computes the columns of L again that columns of A reach, in which entries have changed. */
static sl_status sli_choose_columns(sl_factor *F, const sl_csc *A, const sl_int *columns,
                                    sl_int count, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sli_changes changes;
    sl_status status;
    SLI_CLEAR(changes);
    changes.columns = columns;
    changes.count = count;
    status = sli_reached_refactor(F, A, &changes, stats);
    if (status == SL_OK && stats != NULL) {
        SLI_CLEAR(stats->change);
        stats->change.method = sli_reached_is_suited(F) ? SL_CHANGE_REACH : SL_CHANGE_REFACTOR;
        stats->change.reason = SL_CHANGE_COLUMNS;
        stats->change.updates = F->history.updates;
        stats->change.drift = F->history.drift;
        stats->change.seconds = sli_seconds() - started;
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_factor_change_entries(sl_factor *F, const sl_csc *A, const sl_int *rows,
                                          const sl_int *columns, const double *deltas, sl_int count,
                                          sl_work *W, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sli_rank q;
    sl_status status;
    sli_stats_clear_error(stats);
    if (rows == NULL && deltas == NULL && (A != NULL || count > 0)) {
        return sli_choose_columns(F, A, columns, count, stats);
    }
    status = sli_edges_check(F, rows, columns, deltas, count, stats);
    if (status == SL_OK) {
        status = A == NULL ? sli_rank_check(F) : sli_factor_may_change(F);
    }
    if (status == SL_OK && A != NULL) {
        status = sli_pattern_check_size(F->S, A, 1);
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    sli_rank_begin(&q, F, stats);
    q.entry_rows = rows;
    q.entry_columns = columns;
    q.deltas = deltas;
    q.n_entries = count;
    if (A != NULL) {
        return sli_report(stats, sli_choose_cheapest(&q, A, W, started));
    }
    status = sli_rank_apply(&q, sli_edges_stages, 3, W);
    if (status == SL_OK) {
        sli_rank_report(&q, started, stats);
    }
    return sli_report(stats, status);
}

#endif
