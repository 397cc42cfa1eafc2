/* traversal_run.h: runs a top-down traversal: computes front after front, calls a visitor */
#ifndef SLI_INVERSE_TRAVERSAL_RUN_H
#define SLI_INVERSE_TRAVERSAL_RUN_H

#include "inverse_kernels.h"
#include "traversal.h"
#include "../factor/storage_type.h"

/* Where the range of worker k begins among the row tiles first .. last-1: the ranges have equal
 * length, or for a triangle, whose rows grow longer, equal area. */
static sl_int sli_tile_range_begin(sl_int first, sl_int last, sl_int k, sl_int workers,
                                   int is_triangle) {
    const double share = (double)k / workers;
    return first + (sl_int)((last - first) * (is_triangle ? sqrt(share) : share));
}

/* Copies the panel of supernode s to doubles in whole tiles. */
static void sli_panel_widen(const sl_factor *F, sl_int s, double *to) {
    const sli_step *step = &F->S->steps[s];
    const sl_off size = sli_panel_size(step->width, step->below);
    sl_off k;
    for (k = 0; k < size; k++) {
        to[k] = sli_entry(F, step->panel + k);
    }
    for (; k % SLI_TILE != 0; k++) {
        to[k] = 0.0;
    }
}

/* Called with each completed front, that of the k-th supernode of the list, to read its row tiles
 * t0 .. t1-1. Calls for other tiles or other fronts may run at the same time. */
typedef void (*sli_visitor)(void *context, sl_int k, const sli_inverse_front *f, sl_int t0,
                            sl_int t1);

/* A traversal that is running. sli_traversal_layout_run allocates its memory. */
typedef struct sli_traversal_run {
    const sl_factor *F;
    const sli_traversal *traversal;
    const sl_threads *threads;
    sli_visitor visit;
    void *context;
    double *fronts, *scratch;
    /* the front that all workers share now */
    sl_int at;
    sli_inverse_front front;
    sl_int group; /* first column of the column group */
    sli_inverse_phase phase;
} sli_traversal_run;

/* Doubles of scratch per worker: that of the kernels, and a panel that is copied. */
SLI_INLINE sl_off sli_traverse_scratch(const sli_traversal *t, sl_storage storage) {
    return t->scratch + (storage != SL_STORAGE_DOUBLE ? t->panel : t->column);
}

/* Do the kernels read a copy of the panel of this width? */
SLI_INLINE int sli_traverse_copies(const sl_factor *F, sl_int width) {
    return width == 1 || F->type->storage != SL_STORAGE_DOUBLE;
}

/* storage: that of the factor. */
static void sli_traversal_layout_run(sli_traversal_run *run, const sli_traversal *traversal,
                                     sl_storage storage, sli_block *b) {
    run->fronts = SLI_TAKE(b, double, traversal->schedule.stack);
    run->scratch = SLI_TAKE(
        b, double,
        (uint64_t)traversal->schedule.workers *(uint64_t)sli_traverse_scratch(traversal, storage));
}

/* The k-th front of the list, as the kernels take it; without its panel if they read a copy. */
static sli_inverse_front sli_traverse_front(const sli_traversal_run *run, sl_int k) {
    const sli_step *step = &run->traversal->S->steps[run->traversal->supers[k]];
    sli_inverse_front f;
    f.panel = sli_traverse_copies(run->F, step->width)
                  ? NULL
                  : (const double *)run->F->values + step->panel;
    f.D = run->F->D + step->column;
    f.front = run->fronts + run->traversal->schedule.stack_begin[k];
    f.width = step->width;
    f.below = step->below;
    f.first = run->traversal->first == NULL ? 0 : run->traversal->first[k];
    return f;
}

/* Row tiles t0 .. t1-1 of the rows below, copied from the parent's front. */
static void sli_traverse_gather(const sli_traversal_run *run, sl_int k, const sli_inverse_front *f,
                                sl_int t0, sl_int t1) {
    const sli_traversal *traversal = run->traversal;
    const sl_int up = traversal->forest.parent[k];
    if (up != -1) {
        const sli_inverse_front parent = sli_traverse_front(run, up);
        sli_inverse_kernels_of(run->F->kernels->isa)
            ->gather(f, parent.front, parent.width + parent.below,
                     traversal->S->relative + traversal->S->rows_begin[traversal->supers[k]], t0,
                     t1);
    }
}

/* Most doubles of a panel that are prefetched. Panels are read from the last to the first, which no
 * hardware prefetcher follows: without this, waiting for L took a fifth of the time on 2D meshes.
 * The relative indices are prefetched for the same reason. */
#define SLI_PANEL_AHEAD ((sl_off)1024)

static void sli_traverse_prefetch(const sl_factor *F, sl_int s) {
    const sl_symbolic *S = F->S;
    const sl_off first = S->panel_begin[s], size = S->panel_begin[s + 1] - first;
    const sl_off row = S->rows_begin[s];
    const sl_int rows = sli_min(S->steps[s].below, SLI_PANEL_AHEAD);
    /* bytes of an entry, stored or not */
    const size_t entry = sizeof(double) / (F->type->storage == SL_STORAGE_DOUBLE ? 1 : 2);
    sl_off k;
    for (k = 0; k < rows; k += (sl_off)(SLI_ALIGN / sizeof(sl_int))) {
        SLI_PREFETCH(S->relative + row + k, 0);
    }
    for (k = 0; k < size && k < SLI_PANEL_AHEAD; k += SLI_TILE) {
        SLI_PREFETCH((const char *)F->values + (size_t)(first + k) * entry, 0);
    }
}

/* The scratch of a worker; first copies the panel of front k there if the kernels need that. */
static double *sli_traverse_begin(const sli_traversal_run *run, sl_int k, sli_inverse_front *f,
                                  sl_int worker) {
    const sl_off room = sli_traverse_scratch(run->traversal, run->F->type->storage);
    double *scratch = run->scratch + (ptrdiff_t)(room * worker);
    if (sli_traverse_copies(run->F, f->width)) {
        sli_panel_widen(run->F, run->traversal->supers[k], scratch + run->traversal->scratch);
        f->panel = scratch + run->traversal->scratch;
    }
    return scratch;
}

/* Completes a front whose rows below have been gathered, and visits it. */
static void sli_traverse_complete(const sli_traversal_run *run, sl_int k, sli_inverse_front *f,
                                  sl_int worker) {
    double *scratch = sli_traverse_begin(run, k, f, worker);
    if (k > 0) {
        sli_traverse_prefetch(run->F, run->traversal->supers[k - 1]);
    }
    sli_inverse_kernels_of(run->F->kernels->isa)->takahashi(f, scratch);
    run->visit(run->context, k, f, 0, sli_tiles(f->width + f->below));
}

/* The k-th worker's tasks. The rows below of their roots have been gathered before. */
static void sli_traverse_tasks(void *data, sl_int k, sl_int worker) {
    const sli_traversal_run *run = (const sli_traversal_run *)data;
    const sli_schedule *schedule = &run->traversal->schedule;
    sl_int m, s;
    (void)worker;
    for (m = 0; m < schedule->n_tasks; m++) {
        for (s = schedule->last[m]; s >= schedule->first[m] && schedule->worker[m] == k; s--) {
            sli_inverse_front f = sli_traverse_front(run, s);
            if (s < schedule->last[m]) {
                sli_traverse_gather(run, s, &f, 0, sli_tiles(f.width + f.below));
            }
            sli_traverse_complete(run, s, &f, k);
        }
    }
}

/* Gathers the rows below for children of the current front that are roots of tasks: every
 * `workers`-th of them, from the k-th on. */
static void sli_traverse_gather_task_roots(const sli_traversal_run *run, sl_int k, sl_int workers) {
    const sli_schedule *schedule = &run->traversal->schedule;
    const sl_int *low = run->traversal->forest.low;
    sl_int c, top, count = 0;
    for (c = run->at - 1; c >= low[run->at]; c = low[c] - 1) {
        top = sli_lower_bound(schedule->top, schedule->n_tops, c);
        /* top < n_tops, because run->at is a top above c */
        if (schedule->top[top] != c && count++ % workers == k) {
            const sli_inverse_front f = sli_traverse_front(run, c);
            sli_traverse_gather(run, c, &f, 0, sli_tiles(f.width + f.below));
        }
    }
}

/* The k-th range of row tiles of the shared front: gathers, computes a phase, visits. */
static void sli_traverse_gather_range(void *data, sl_int k, sl_int worker) {
    const sli_traversal_run *run = (const sli_traversal_run *)data;
    const sl_int workers = run->traversal->schedule.workers, first = run->front.width / SLI_TILE;
    const sl_int tiles = sli_tiles(run->front.width + run->front.below);
    (void)worker;
    sli_traverse_gather(run, run->at, &run->front,
                        sli_tile_range_begin(first, tiles, k, workers, 0),
                        sli_tile_range_begin(first, tiles, k + 1, workers, 0));
}

static void sli_traverse_phase_range(void *data, sl_int k, sl_int worker) {
    const sli_traversal_run *run = (const sli_traversal_run *)data;
    const sl_int workers = run->traversal->schedule.workers,
                 is_square = run->phase == SLI_INVERSE_SQUARE;
    const sli_tile_range all = sli_inverse_tiles(&run->front, run->group, run->phase);
    (void)worker;
    sli_inverse_kernels_of(run->F->kernels->isa)
        ->phase(&run->front, run->group, run->phase,
                sli_tile_range_begin(all.first, all.last, k, workers, is_square),
                sli_tile_range_begin(all.first, all.last, k + 1, workers, is_square), run->scratch);
}

static void sli_traverse_visit_range(void *data, sl_int k, sl_int worker) {
    const sli_traversal_run *run = (const sli_traversal_run *)data;
    const sl_int workers = run->traversal->schedule.workers;
    const sl_int tiles = sli_tiles(run->front.width + run->front.below);
    (void)worker;
    run->visit(run->context, run->at, &run->front, sli_tile_range_begin(0, tiles, k, workers, 0),
               sli_tile_range_begin(0, tiles, k + 1, workers, 0));
    sli_traverse_gather_task_roots(run, k, workers);
}

/* One front by all workers. Each row tile is computed by the same operations as with one worker, so
 * that the bits are the same. */
static void sli_traverse_shared(sli_traversal_run *run, sli_team *team) {
    const sl_int workers = run->traversal->schedule.workers;
    sl_int phase;
    run->front = sli_traverse_front(run, run->at);
    (void)sli_traverse_begin(run, run->at, &run->front, 0);
    sli_team_loop(team, workers, NULL, sli_traverse_gather_range, run);
    for (run->group = sli_inverse_last_group(&run->front);
         run->group + SLI_INVERSE_COLUMNS > run->front.first; run->group -= SLI_INVERSE_COLUMNS) {
        for (phase = 0; phase < SLI_INVERSE_PHASES; phase++) {
            run->phase = (sli_inverse_phase)phase;
            sli_team_loop(team, workers, NULL, sli_traverse_phase_range, run);
        }
    }
    sli_team_loop(team, workers, NULL, sli_traverse_visit_range, run);
}

/* Computes all fronts, parents before children. One worker leads; the others help with large fronts
 * and with tasks. */
SLI_HOT static void sli_traverse_lead(sli_team *team, void *data) {
    sli_traversal_run *run = (sli_traversal_run *)data;
    const sli_schedule *schedule = &run->traversal->schedule;
    sl_int m;
    for (m = schedule->n_tops - 1; m >= 0; m--) {
        run->at = schedule->top[m];
        if (2.0 * sli_front_flops(&run->traversal->S->steps[run->traversal->supers[run->at]]) >=
            SLI_SHARED_FLOPS) {
            sli_traverse_shared(run, team);
        } else {
            sli_inverse_front f = sli_traverse_front(run, run->at);
            sli_traverse_gather(run, run->at, &f, 0, sli_tiles(f.width + f.below));
            sli_traverse_complete(run, run->at, &f, 0);
            sli_traverse_gather_task_roots(run, 0, 1);
        }
    }
    sli_team_loop(team, schedule->workers, NULL, sli_traverse_tasks, run);
}

static void sli_traverse(sli_traversal_run *run) {
    sli_team_run(run->threads, run->traversal->schedule.workers, sli_traverse_lead, run);
}

#endif
