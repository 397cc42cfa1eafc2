/* schedule.h: tasks of the tree of fronts for parallel workers, and the layout of update stacks */
#ifndef SLI_ANALYSIS_SCHEDULE_H
#define SLI_ANALYSIS_SCHEDULE_H

#include "../base/parallel.h"
#include "../base/sort.h"
#include "../kernels/front.h"
#include "symbolic_types.h"

/* A task is a subtree, a run of consecutive supernodes, that is factored by one worker. The fronts
 * above all tasks follow one by one, with all workers in each. A single worker has one task: the
 * whole forest. */
typedef struct sli_schedule {
    sl_int workers;
    sl_int n_tasks, n_tops;
    sl_int *first, *last; /* n_tasks: supernodes first..last */
    sl_int *worker;       /* n_tasks: its worker */
    sl_int *top;          /* n_tops: supernodes above the tasks, ascending */
    sl_off *stack_begin;  /* n_supers: start of each update matrix, in doubles */
    sl_off stack;         /* doubles of all stacks together */
} sli_schedule;

/* A forest of fronts numbered in postorder: all supernodes of an analysis, or those of a reach. */
typedef struct sli_forest {
    sl_int count;
    const sl_int *parent; /* count: -1 at a root */
    const sl_int *low;    /* count: first of the subtree */
} sli_forest;

/* Scratch of the scheduling. */
typedef struct sli_schedule_work {
    double *flops;   /* count: of the front, later of the subtree */
    double *load;    /* workers: flops assigned */
    sl_int *side;    /* count: 0 or 1, the stack; plus 2 within a task */
    uint64_t *order; /* count: tasks, the largest last */
    uint64_t *scratch;
} sli_schedule_work;

/* Tasks per worker, on average. Small tasks even out the error of the flop estimate. */
#define SLI_TASKS_PER_WORKER 8

/* A front of this many flops takes about 50 us. Sharing it among workers costs 1 to 2 us a step
 * with OpenMP, more with other thread pools. */
#define SLI_SHARED_FLOPS 4e6

/* Doubles that a supernode passes to its parent: the update matrix and the magnitudes of its
 * rows. */
SLI_INLINE sl_off sli_update_size(const sli_step *s) {
    const sl_int tiles = sli_update_tiles(s->width, s->below);
    return sli_triangle_offset(tiles) + SLI_TILE * (sl_off)tiles;
}

/* Flops of a front: the sum of (entries)^2 over its columns. */
SLI_INLINE double sli_front_flops(const sli_step *s) {
    const double w = s->width, h = w + s->below;
    return w * (h * h - (w - 1.0) * h + (w - 1.0) * (2.0 * w - 1.0) / 6.0);
}

/* Two update stacks that grow towards each other, one for supernodes of even depth and one for odd
 * depth. Supernodes are pushed in ascending order. When a supernode is done, its children are on
 * top of the other stack, so that no update matrix is ever moved. */
typedef struct sli_stacks {
    sl_off top[2];
    sl_off most;
} sli_stacks;

/* Pushes the update matrix of supernode s, then pops those of its children: they are free once s is
 * factored. Within a task only children of the same task are on these stacks. */
static void sli_stacks_push(sli_stacks *k, const sl_symbolic *S, sl_int s, const sl_int *side,
                            sl_off *begin) {
    const int own = side[s] & 1, in_task = side[s] & 2;
    const sl_off size = sli_update_size(&S->steps[s]);
    sl_int c;
    begin[s] = own == 0 ? k->top[0] : -(k->top[1] + size);
    k->top[own] += size;
    k->most = k->top[0] + k->top[1] > k->most ? k->top[0] + k->top[1] : k->most;
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        if ((side[c] & 2) == in_task) {
            k->top[1 - own] -= sli_update_size(&S->steps[c]);
        }
    }
}

/* Turns a position into a final one: the second stack counts from the end, which is known only
 * now. */
SLI_INLINE void sli_stacks_settle(const sli_stacks *k, sl_int s, const sl_int *side, sl_off base,
                                  sl_off *begin) {
    begin[s] += base + ((side[s] & 1) == 0 ? 0 : k->most);
}

/* Lays out the update stacks. All tasks of a worker use its two stacks, one task after the other.
 * The update matrices of task roots wait for the fronts above and have memory of their own; so have
 * the stacks of the fronts above. */
static void sli_plan_stacks(sli_schedule *p, const sl_symbolic *S, const sl_int *side) {
    sli_stacks k;
    sl_int m, s, worker;
    p->stack = 0;
    for (worker = 0; worker < p->workers; worker++) {
        memset(&k, 0, sizeof k);
        for (m = 0; m < p->n_tasks; m++) {
            k.top[0] = k.top[1] = 0;
            for (s = p->first[m]; s < p->last[m] && p->worker[m] == worker; s++) {
                sli_stacks_push(&k, S, s, side, p->stack_begin);
            }
        }
        for (m = 0; m < p->n_tasks; m++) {
            for (s = p->first[m]; s < p->last[m] && p->worker[m] == worker; s++) {
                sli_stacks_settle(&k, s, side, p->stack, p->stack_begin);
            }
        }
        p->stack += k.most;
    }
    for (m = 0; m < p->n_tasks; m++) {
        p->stack_begin[p->last[m]] = p->stack;
        p->stack += sli_update_size(&S->steps[p->last[m]]);
    }
    memset(&k, 0, sizeof k);
    for (m = 0; m < p->n_tops; m++) {
        sli_stacks_push(&k, S, p->top[m], side, p->stack_begin);
    }
    for (m = 0; m < p->n_tops; m++) {
        sli_stacks_settle(&k, p->top[m], side, p->stack, p->stack_begin);
    }
    p->stack += k.most;
}

/* Finds the tasks: largest subtrees of at most `limit` flops, in ascending order of flops. */
static void sli_find_tasks(sli_schedule *p, const sli_forest *f, sli_schedule_work *w,
                           double limit) {
    const double scale = 1e9 / limit; /* a front has at least one flop */
    sl_int s;
    p->n_tasks = p->n_tops = 0;
    for (s = 0; s < f->count; s++) {
        const sl_int up = f->parent[s];
        if (w->flops[s] > limit) {
            p->top[p->n_tops++] = s;
        } else if (up == -1 || w->flops[up] > limit) {
            w->order[p->n_tasks++] = sli_keyed((sl_int)(w->flops[s] * scale), s);
        }
    }
    sli_sort(w->order, p->n_tasks, w->scratch);
}

/* Assigns the tasks, the largest first, each to the worker with the least load. */
static void sli_share_tasks(sli_schedule *p, const sli_forest *f, sli_schedule_work *w) {
    sl_int m, k;
    for (k = 0; k < p->workers; k++) {
        w->load[k] = 0.0;
    }
    for (m = 0; m < p->n_tasks; m++) {
        const sl_int root = sli_value(w->order[p->n_tasks - 1 - m]);
        sl_int least = 0;
        for (k = 1; k < p->workers; k++) {
            least = w->load[k] < w->load[least] ? k : least;
        }
        w->load[least] += w->flops[root];
        p->first[m] = f->low[root];
        p->last[m] = root;
        p->worker[m] = least;
    }
}

/* Finds tasks and tops for p->workers. w->flops: those of the fronts, read if there are several
 * workers. */
static void sli_plan_tasks(sli_schedule *p, const sli_forest *f, sli_schedule_work *w) {
    double total = 0.0;
    sl_int s;
    if (p->workers == 1) {
        p->n_tops = 0;
        p->n_tasks = f->count > 0;
        if (f->count > 0) {
            p->first[0] = p->worker[0] = 0;
            p->last[0] = f->count - 1;
        }
        return;
    }
    for (s = 0; s < f->count; s++) {
        if (f->parent[s] != -1) {
            w->flops[f->parent[s]] += w->flops[s];
        } else {
            total += w->flops[s];
        }
    }
    sli_find_tasks(p, f, w, total / ((double)p->workers * SLI_TASKS_PER_WORKER));
    sli_share_tasks(p, f, w);
}

/* Fills a schedule for p->workers. The arrays of p and w have room. */
static void sli_schedule_fill(sli_schedule *p, const sl_symbolic *S, sli_schedule_work *w) {
    const sli_forest f = {S->n_supers, S->super_parent, S->first_descendant};
    sl_int s, m;
    for (s = 0; s < S->n_supers; s++) {
        w->flops[s] = sli_front_flops(&S->steps[s]);
    }
    sli_plan_tasks(p, &f, w);
    for (s = S->n_supers - 1; s >= 0; s--) {
        w->side[s] = S->super_parent[s] == -1 ? 2 : 3 - (w->side[S->super_parent[s]] & 1);
    }
    for (m = 0; m < p->n_tops; m++) {
        w->side[p->top[m]] &= 1;
    }
    sli_plan_stacks(p, S, w->side);
}

static void sli_schedule_layout(sli_schedule *p, sli_block *b, sl_int count) {
    const uint64_t fronts = (uint64_t)count, tasks = p->workers == 1 ? 1 : fronts;
    p->first = SLI_TAKE(b, sl_int, tasks);
    p->last = SLI_TAKE(b, sl_int, tasks);
    p->worker = SLI_TAKE(b, sl_int, tasks);
    p->top = SLI_TAKE(b, sl_int, p->workers == 1 ? 0 : fronts);
    p->stack_begin = SLI_TAKE(b, sl_off, fronts);
}

static void sli_schedule_work_layout(sli_schedule_work *w, sli_block *b, sl_int count,
                                     sl_int workers) {
    w->flops = SLI_TAKE(b, double, count);
    w->load = SLI_TAKE(b, double, workers);
    w->side = SLI_TAKE(b, sl_int, count);
    w->order = SLI_TAKE(b, uint64_t, count);
    w->scratch = SLI_TAKE(b, uint64_t, count);
}

#endif
