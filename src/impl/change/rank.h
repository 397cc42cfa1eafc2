/* rank.h: sl_factor_rank_update: passes of a rank-k change, their growth, the log that undoes them
 * */
#ifndef SLI_CHANGE_RANK_H
#define SLI_CHANGE_RANK_H

#include "../../public/change.h"
#include "../solve/work.h"
#include "path.h"
#include "rank_vectors.h"

static const char sli_growth_exceeded[] = "pivot growth exceeds options.growth_limit";

/* Doubles of the panels of all supernodes in the reach. */
static uint64_t sli_rank_panels(const sl_symbolic *S, const uint64_t *seeds, sl_int count) {
    uint64_t size = 0;
    sl_int k = 0, s, next;
    while (k < count) {
        s = S->super_of[sli_key(seeds[k])];
        next = sli_next_seed(S, seeds, count, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            size += (uint64_t)(S->panel_begin[s + 1] - S->panel_begin[s]);
        }
    }
    return size;
}

SLI_COLD static void sli_rank_layout(void *data, sli_block *b) {
    sli_rank *q = (sli_rank *)data;
    const sl_symbolic *S = q->S;
    sli_reach R = q->whole;
    sl_int k, most = 1;
    int has_path = 0;
    for (k = 0; k < q->count; k = q->ends[k]) {
        most = sli_max(most, q->ends[k] - k);
        has_path |= sli_rank_is_path(q, q->ends[k] - k);
    }
    if (sli_rank_is_path(q, most) && !q->has_log) {
        R.count = R.columns = 0;
        R.n_rows = 0;
    }
    sli_update_layout(&q->u, b, &R, (sl_int)1 << sli_update_kind(most), q->has_trial);
    sli_path_layout(&q->u, b, &q->whole, has_path);
    if (q->has_log) {
        q->log = SLI_TAKE(b, double, sli_rank_panels(S, q->whole_seeds, q->count));
        q->log_D = SLI_TAKE(b, double, q->whole.columns);
        q->log_loss = SLI_TAKE(b, double, q->u.sign != 0.0 ? q->whole.columns : 0);
        q->log_marks = SLI_TAKE(b, uint64_t, q->whole.count);
        q->log_extents = SLI_TAKE(b, sli_extent, q->whole.count);
        q->log_steps = SLI_TAKE(b, sli_step, q->whole.count);
    }
}

/* Saves or restores the panels, pivots, extents, marks and losses of the first `count` steps of the
 * log. */
SLI_COLD static void sli_rank_log(sli_rank *q, sl_int count, int restores) {
    sl_factor *F = q->u.F;
    double *log = q->log, *log_D = q->log_D, *log_loss = q->log_loss;
    sl_int k;
    for (k = 0; k < count; k++) {
        const sli_step *step = &q->log_steps[k];
        const sl_int columns = sli_step_columns(step);
        const sl_off from = sli_tile_offset(step->width, step->first_tile);
        const size_t size = (size_t)(sli_panel_size(step->width, step->below) - from);
        double *L = (double *)F->values + step->panel + from;
        const sl_int s = F->S->super_of[step->column];
        sli_extent *extent = &F->extents[s];
        if (F->history.marks != NULL) {
            uint64_t *mark = &F->history.marks[s];
            *(restores ? mark : &q->log_marks[k]) = *(restores ? &q->log_marks[k] : mark);
        }
        if (q->u.sign != 0.0) {
            double *loss = F->history.loss + step->column;
            sli_loss_open(F, s);
            SLI_COPY(restores ? loss : log_loss, restores ? log_loss : loss, columns);
            log_loss += columns;
        }
        memcpy(restores ? L : log, restores ? log : L, size * sizeof(double));
        SLI_COPY(restores ? F->D + step->column : log_D, restores ? log_D : F->D + step->column,
                 columns);
        memcpy(restores ? extent : &q->log_extents[k], restores ? &q->log_extents[k] : extent,
               sizeof *extent);
        log += size;
        log_D += columns;
    }
}

/* Mixes the change into the identity of F. */
SLI_COLD static void sli_rank_identify(sli_rank *q) {
    sl_factor *F = q->u.F;
    const sl_csc *V = q->u.V;
    F->identity = sli_hash_ints(F->identity, V->p, (sl_off)V->n_cols + 1);
    F->identity = sli_hash_ints(F->identity, V->i, sli_nnz(V));
    F->identity = sli_hash_words(F->identity, V->x, sli_nnz(V));
    if (q->u.sigma != NULL) {
        F->identity = sli_hash_words(F->identity, q->u.sigma, V->n_cols);
    }
    F->generation++;
}

/* The supernodes of a reach are no longer those of the entries that were read. */
static void sli_rank_unmark(sl_factor *F, const sli_step *steps, sl_int count) {
    sl_int k;
    for (k = 0; F->history.marks != NULL && k < count; k++) {
        F->history.marks[F->S->super_of[steps[k].column]] = 0;
    }
}

/* The largest |a| that L D L' shows in the trees of a pass: of columns that no other one updates,
 * and a_kk of the row that the pass changes most. Not 0, as no pivot is. */
SLI_COLD static double sli_rank_shown(const sli_update *u) {
    const sl_factor *F = u->F;
    const sl_symbolic *S = F->S;
    double unused, most = fabs(sli_update_entry(F, u->row, &unused));
    sl_int s, d, r;
    for (s = 0; s < u->R.count; s++) {
        const sl_int root = S->super_of[u->R.steps[s].column];
        for (d = S->first_descendant[root]; d <= root && u->R.steps[s].up == -1; d++) {
            const sli_step *leaf = &S->steps[d];
            double l = S->first_descendant[d] == d ? 1.0 : 0.0;
            for (r = 1; r < leaf->width + leaf->below && l > 0.0; r++) {
                l = fmax(l, fabs(sli_entry(F, leaf->panel + sli_panel_at(leaf->width, r, 0))));
            }
            most = fmax(most, l * fabs(F->D[leaf->column]));
        }
    }
    return most;
}

/* What the pivots of a pass have lost to the size of L^-1 W, relative to rounding. Vectors and
 * pivots add up to that: 8 for each vector at most has been seen. */
static double sli_rank_swept(const sli_update *u) {
    const double most = 8.0 * (double)sli_max(u->state->ranks, 1);
    return u->sign != 0.0 ? sqrt(u->swept) * fmin(u->swept, most) : u->swept;
}

/* Updates growth and drift after a pass. They are relative to the largest |a|: where that becomes
 * less than it ever was they rise. Where it rises and falls again, the errors that were made above
 * remain, by rows if all pivots have one sign. Only a bound from below is known of it: a pivot, if
 * all have one sign, and the difference of a bound before and what the pass changes. That falls
 * also where |a| doubles: once it is a small part of what it was, L D L' shows more. The pass is
 * compared with its own columns: other components may be larger by any factor. */
static void sli_rank_note(const sli_update *u) {
    sl_factor *F = u->F;
    sl_factor_info *info = &F->stats.factor;
    const double left = fmax(F->history.scale - u->fall, u->fall - F->history.high);
    const double own = fmin(u->entry, fabs(u->entry - u->fall));
    const int has_fallen = 16.0 * left < F->history.checked || 16.0 * own < u->entry;
    const double shown = u->sign == 0.0 && has_fallen ? sli_rank_shown(u) : 0.0;
    const double known = u->sign != 0.0 ? u->top : shown, rest = u->sign != 0.0 ? 0.0 : DBL_EPSILON;
    const double scale = fmax(left, fmax(rest * F->history.scale, known));
    const double local = fmax(fmin(own, scale), fmax(rest * u->entry, known));
    const double rise = scale > 0.0 ? fmax(1.0, F->history.lowest / scale) : 1.0;
    const double growth = local > 0.0 ? u->growth / local : 0.0;
    const double swept = sli_rank_swept(u);
    const double most = local > 0.0 ? u->most / local * u->loss * swept : 0.0;
    info->growth =
        u->sign != 0.0 ? fmax(info->growth, fmin(growth, 2.0)) : fmax(info->growth * rise, growth);
    F->history.drift = fmax(F->history.drift * rise + DBL_EPSILON * fmax(1.0, most),
                            DBL_EPSILON * u->lost); /* a row has the sum of all passes */
    if (u->sign == 0.0) {
        F->history.error += DBL_EPSILON * fmax(F->history.scale, scale);
        F->history.drift = fmax(F->history.drift, scale > 0.0 ? F->history.error / scale : 0.0);
    }
    F->history.lowest = fmin(F->history.lowest, scale);
    F->history.scale = scale;
    F->history.high = u->sign != 0.0 ? DBL_MAX : F->history.high + u->fall;
    F->history.checked = shown > 0.0 ? scale : F->history.checked;
}

/* Runs all passes. */
static sl_status sli_rank_passes(sli_rank *q) {
    sl_factor *F = q->u.F;
    sl_factor_info *info = &F->stats.factor;
    sl_status status = SL_OK;
    sl_int k, v, last, group[SLI_TILE];
    uint64_t seeds[SLI_TILE];
    for (k = 0; k < q->count && status == SL_OK; k = last) {
        last = q->ends[k];
        sli_rank_group(q, k, last, group, seeds);
        if (sli_rank_is_path(q, last - k)) {
            status = sli_path_run(&q->u, seeds[0], q->has_trial);
        } else {
            sli_reach_fill(F->S, seeds, last - k, q->u.steps, q->u.rows, &q->u.R);
            sli_update_load(&q->u, group, last - k);
            status = q->has_trial ? sli_update_try(&q->u) : SL_OK;
            sli_rank_unmark(F, q->u.steps, status == SL_OK ? q->u.R.count : 0);
            status = status == SL_OK ? sli_update_run(&q->u) : status;
        }
        if (status == SL_OK) {
            for (v = 0; v < last - k && q->u.sign != 0.0; v++) {
                sli_update_lose(&q->u, group[v]);
            }
            sli_rank_note(&q->u);
            if (info->growth > F->limits.growth) {
                q->u.pivot = F->extents[F->S->super_of[sli_key(seeds[0])]].pivot;
                q->u.pivot = q->u.pivot < 0 ? sli_key(seeds[0]) : q->u.pivot;
                q->u.value = F->D[q->u.pivot];
                status = sli_refuse(SL_ERR_INACCURATE, sli_growth_exceeded);
            }
        }
    }
    return status;
}

/* Changes F by the vectors. On failure F is as before. */
SLI_NOINLINE static sl_status sli_rank_run(sli_rank *q) {
    sl_factor *F = q->u.F;
    const sli_factor_stats before = F->stats;
    sli_history history;
    sl_status status;
    if (q->count == 0) {
        return SL_OK;
    }
    if (before.factor.growth > F->limits.growth) { /* a saved factor has its drift as growth */
        const sl_int k = sli_key(q->seeds[0]);
        return sli_fail_at(q->stats, SL_ERR_INACCURATE, F->S->perm[k], -1, F->D[k],
                           sli_growth_exceeded);
    }
    if (F->history.updates == 0) {
        F->history.scale = F->history.lowest = F->history.checked = before.factor.entry_max;
        F->history.high = F->history.drift > 0.0 ? DBL_MAX : before.factor.entry_max;
        F->history.error = 0.0;
    }
    history = F->history;
    if (q->has_log) {
        sli_reach R;
        sli_reach_fill(F->S, q->whole_seeds, q->count, q->log_steps, q->u.rows, &R);
        q->logged = R.count;
        sli_rank_log(q, q->logged, 0);
    }
    status = sli_rank_passes(q);
    if (status == SL_OK) {
        F->history.updates += q->count;
        F->stats.factor.bytes += F->history.bytes;
        F->history.bytes = 0;
        sli_rank_identify(q);
        return SL_OK;
    }
    if (q->has_log) {
        sli_rank_log(q, q->logged, 1);
        F->stats = before;
        F->history = history;
    } /* else a trial has refused it, and nothing has changed */
    return sli_fail_at(q->stats, status, F->S->perm[q->u.pivot], -1, q->u.value,
                       status == SL_ERR_INACCURATE ? sli_growth_exceeded
                       : status == SL_ERR_NOT_FINITE
                           ? "the change would make this pivot infinite"
                           : "the change would make this pivot null or of "
                             "the other sign; F is as before");
}

/* The largest pivot that the rounding of heavier rows may have made of a null one. */
static double sli_rank_least(const sl_factor *F) {
    return F->rule.null_tolerance < 0.0
               ? 0.0
               : sli_null_rounding(F->S->n) * F->stats.factor.pivot_max;
}

/* Starts a change of F. */
static void sli_rank_begin(sli_rank *q, sl_factor *F, sl_stats *stats) {
    const sl_factor_info *info = &F->stats.factor;
    memset(q, 0, sizeof *q);
    q->u.F = F;
    sli_tolerance_begin(F); /* a loaded factor does not have it */
    q->S = F->S;
    q->stats = stats;
    q->u.sign = info->positive == F->S->n ? 1.0 : info->negative == F->S->n ? -1.0 : 0.0;
    q->u.keeps_signs = q->u.sign != 0.0 || F->rule.regularization != 0.0;
    q->u.least = sli_skips_nulls(F) ? sli_rank_least(F) : 0.0;
}

/* Reports a change. */
static void sli_rank_report(const sli_rank *q, double started, sl_stats *stats) {
    if (stats != NULL) {
        const sl_factor *F = q->u.F;
        stats->factor = F->stats.factor;
        SLI_CLEAR(stats->change);
        stats->change.method = q->count > 0 ? SL_CHANGE_UPDATE : SL_CHANGE_NONE;
        stats->change.ranks = q->count;
        stats->change.entries = q->entries;
        stats->change.flops_update = q->flops;
        stats->change.updates = F->history.updates;
        stats->change.drift = F->history.drift;
        stats->change.seconds = sli_seconds() - started;
    }
}

static const sli_stage sli_rank_stages[2] = {{sli_rank_layout_seeds, sli_rank_sort},
                                             {sli_rank_layout, NULL}};

/* Runs a change whose stages are prepared. */
static sl_status sli_rank_run_prepared(sli_rank *q) {
    const int is_counted = q->count > 0 && q->u.sign != 0.0;
    const sl_status status = is_counted ? sli_loss_begin(q->u.F) : SL_OK;
    return status == SL_OK ? sli_rank_run(q) : status;
}

/* Prepares the stages of a change, in the caller's workspace or in `own`, and runs it. */
static sl_status sli_rank_apply(sli_rank *q, const sli_stage *stages, int count, sl_work *W) {
    sl_work own = sli_work_own(&q->u.F->allocator);
    sl_status status;
    W = W == NULL ? &own : W;
    status = sli_work_grow(W, 1); /* so that no array is NULL, not even an empty one */
    status = status == SL_OK ? sli_work_stages(W, stages, count, q) : status;
    status = status == SL_OK ? q->status : status;
    status = status == SL_OK ? sli_rank_run_prepared(q) : status;
    sli_free(&own.allocator, own.block);
    return status;
}

SL_API sl_status sl_factor_rank_update(sl_factor *F, const sl_csc *V, const double *sigma,
                                       sl_work *W, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sli_rank q;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(F == NULL ? "F is NULL" : V == NULL ? "V is NULL" : NULL);
    status = status == SL_OK ? sli_rank_check(F) : status;
    status = status == SL_OK ? sl_csc_check(V, stats) : status;
    if (status == SL_OK) {
        status = sli_argument(V->n_rows != F->S->n ? "V has another number of rows than F"
                              : sli_nnz(V) > 0 && V->x == NULL ? "V.x is NULL"
                                                               : NULL);
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    sli_rank_begin(&q, F, stats);
    q.u.V = V;
    q.u.sigma = sigma;
    status = sli_rank_apply(&q, sli_rank_stages, 2, W);
    if (status == SL_OK) {
        sli_rank_report(&q, started, stats);
    }
    return sli_report(stats, status);
}

#endif
