/* descent_run.h: the way of the inverse from the roots to the leaves, gone: front after front, each handed to a taker */
#ifndef SLI_DESCENT_RUN_H
#define SLI_DESCENT_RUN_H

#include "descent.h"
#include "factor_parts.h"

/* Takes what it wants of row tiles t0 .. t1-1 of the completed front of the k-th supernode of a list. Calls for other
 * tiles, or for other fronts, may run at once. */
typedef void (*sli_taker)(void *to, sl_int k, const sli_dual *f, sl_int t0, sl_int t1);

/* A run under way; the memory is that of sli_descent_layout_run. */
typedef struct sli_descending {
    const sl_factor *F;
    const sli_descent *d;
    const sl_threads *threads;
    sli_taker take;
    void *to;
    double *fronts, *scratch;
    /* the front that all workers share */
    sl_int at;
    sli_dual front;
    sl_int group;
    sli_dual_part part;
} sli_descending;

static void sli_descent_layout_run(sli_descending *run, const sli_descent *d, sli_block *b) {
    run->fronts = SLI_TAKE(b, double, d->plan.waiting);
    run->scratch = SLI_TAKE(b, double, (uint64_t)d->plan.workers *(uint64_t)d->scratch);
}

static sli_dual sli_dual_of(const sli_descending *run, sl_int k) {
    const sli_step *step = &run->d->S->steps[run->d->supers[k]];
    sli_dual f;
    f.panel = run->F->L + step->panel;
    f.D = run->F->D + step->column;
    f.front = run->fronts + run->d->plan.waiting_begin[k];
    f.width = step->width;
    f.below = step->below;
    f.first = run->d->first == NULL ? 0 : run->d->first[k];
    return f;
}

/* Row tiles t0 .. t1-1 of the rows below, out of the parent's front. */
static void sli_dual_gather(const sli_descending *run, sl_int k, const sli_dual *f, sl_int t0,
                            sl_int t1) {
    const sli_descent *d = run->d;
    const sl_int up = d->forest.parent[k];
    if (up != -1) {
        const sli_dual parent = sli_dual_of(run, up);
        run->F->kernels->gather(f, parent.front, parent.width + parent.below,
                                d->S->places + d->S->rows_begin[d->supers[k]], t0, t1);
    }
}

/* Most of a panel that is asked for before its turn: read from the last to the first they meet no hardware that runs
 * ahead of them, and waiting for L was a fifth of all time on 2D meshes; and so it is with the places of rows. */
#define SLI_PANEL_AHEAD ((sl_off)1024)

static void sli_dual_prefetch(const sl_factor *F, sl_int s) {
    const sl_symbolic *S = F->S;
    const sl_off first = S->panel_begin[s], size = S->panel_begin[s + 1] - first;
    const sl_off row = S->rows_begin[s], rows = S->rows_begin[s + 1] - row;
    sl_off k;
    for (k = 0; k < rows && k < SLI_PANEL_AHEAD; k += (sl_off)(SLI_ALIGN / sizeof(sl_int))) {
        SLI_PREFETCH(S->places + row + k, 0);
    }
    for (k = 0; k < size && k < SLI_PANEL_AHEAD; k += SLI_TILE) {
        SLI_PREFETCH(F->L + first + k, 0);
    }
}

/* A front whose rows below are there: the rest of it, and the taker. */
static void sli_dual_complete(const sli_descending *run, sl_int k, const sli_dual *f,
                              sl_int worker) {
    if (k > 0) {
        sli_dual_prefetch(run->F, run->d->supers[k - 1]);
    }
    run->F->kernels->takahashi(f, run->scratch + (ptrdiff_t)(run->d->scratch * worker));
    run->take(run->to, k, f, 0, sli_tiles(f->width + f->below));
}

/* Worker k's tasks, whose roots have taken their parts before. */
static void sli_descend_tasks(void *data, sl_int k) {
    const sli_descending *run = (const sli_descending *)data;
    const sli_schedule *plan = &run->d->plan;
    sl_int m, s;
    for (m = 0; m < plan->n_tasks; m++) {
        for (s = plan->last[m]; s >= plan->first[m] && plan->worker[m] == k; s--) {
            const sli_dual f = sli_dual_of(run, s);
            if (s < plan->last[m]) {
                sli_dual_gather(run, s, &f, 0, sli_tiles(f.width + f.below));
            }
            sli_dual_complete(run, s, &f, k);
        }
    }
}

/* The children of the front at hand that are roots of tasks take their parts: every `workers`-th one from k on. */
static void sli_descend_to_roots(const sli_descending *run, sl_int k, sl_int workers) {
    const sli_schedule *plan = &run->d->plan;
    const sl_int *low = run->d->forest.low;
    sl_int c, place, count = 0;
    for (c = run->at - 1; c >= low[run->at]; c = low[c] - 1) {
        place = sli_lower_bound(plan->top, plan->n_tops, c);
        if (plan->top[place] != c && count++ % workers == k) { /* run->at itself is a top */
            const sli_dual f = sli_dual_of(run, c);
            sli_dual_gather(run, c, &f, 0, sli_tiles(f.width + f.below));
        }
    }
}

static void sli_shared_gather(void *data, sl_int k) {
    const sli_descending *run = (const sli_descending *)data;
    const sl_int workers = run->d->plan.workers, first = run->front.width / SLI_TILE;
    const sl_int tiles = sli_tiles(run->front.width + run->front.below);
    sli_dual_gather(run, run->at, &run->front, sli_part(first, tiles, k, workers, 0),
                    sli_part(first, tiles, k + 1, workers, 0));
}

static void sli_shared_part(void *data, sl_int k) {
    const sli_descending *run = (const sli_descending *)data;
    const sl_int workers = run->d->plan.workers, is_square = run->part == SLI_DUAL_SQUARE;
    const sli_span all = sli_dual_span(&run->front, run->group, run->part);
    run->F->kernels->dual(&run->front, run->group, run->part,
                          sli_part(all.first, all.last, k, workers, is_square),
                          sli_part(all.first, all.last, k + 1, workers, is_square), run->scratch);
}

static void sli_shared_take(void *data, sl_int k) {
    const sli_descending *run = (const sli_descending *)data;
    const sl_int workers = run->d->plan.workers;
    const sl_int tiles = sli_tiles(run->front.width + run->front.below);
    run->take(run->to, run->at, &run->front, sli_part(0, tiles, k, workers, 0),
              sli_part(0, tiles, k + 1, workers, 0));
    sli_descend_to_roots(run, k, workers);
}

/* The whole of a front by all workers: each row tile goes its own way, so that the bits are the same. */
static void sli_dual_shared(sli_descending *run) {
    const sl_int workers = run->d->plan.workers;
    sl_int part;
    run->front = sli_dual_of(run, run->at);
    sli_parallel(run->threads, workers, sli_shared_gather, run);
    for (run->group = sli_dual_last(&run->front); run->group + SLI_DUAL_COLUMNS > run->front.first;
         run->group -= SLI_DUAL_COLUMNS) {
        for (part = 0; part < SLI_DUAL_PARTS; part++) {
            run->part = (sli_dual_part)part;
            sli_parallel(run->threads, workers, sli_shared_part, run);
        }
    }
    sli_parallel(run->threads, workers, sli_shared_take, run);
}

/* All fronts, parents before children. */
static void sli_descend(sli_descending *run) {
    const sli_schedule *plan = &run->d->plan;
    sl_int m;
    for (m = plan->n_tops - 1; m >= 0; m--) {
        run->at = plan->top[m];
        if (2.0 * sli_front_flops(&run->d->S->steps[run->d->supers[run->at]]) >= SLI_SHARED_FLOPS) {
            sli_dual_shared(run);
        } else {
            const sli_dual f = sli_dual_of(run, run->at);
            sli_dual_gather(run, run->at, &f, 0, sli_tiles(f.width + f.below));
            sli_dual_complete(run, run->at, &f, 0);
            sli_descend_to_roots(run, 0, 1);
        }
    }
    sli_parallel(run->threads, plan->workers, sli_descend_tasks, run);
}

#endif
