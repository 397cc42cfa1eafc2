/* schedule.h: which worker factors which fronts, and where update matrices wait for the parent's front */
#ifndef SLI_SCHEDULE_H
#define SLI_SCHEDULE_H

#include "parallel.h"
#include "sort.h"
#include "symbolic_types.h"

/* Tasks are subtrees, runs of supernodes of their own, each done by one worker; the fronts above them
 * come afterwards, one by one, with all workers in each. One worker has one task, everything. */
typedef struct sli_schedule {
    sl_int workers;
    sl_int n_tasks, n_tops;
    sl_int *first, *last;  /* n_tasks: supernodes of a task */
    sl_int *worker;        /* n_tasks: who does it */
    sl_int *top;           /* n_tops: the other supernodes, ascending */
    sl_off *waiting_begin; /* n_supers: where each one's update matrix waits, in doubles */
    sl_off waiting;        /* doubles for all of them */
} sli_schedule;

/* A forest of fronts, numbered in postorder: all supernodes of an analysis, or those of a reach. */
typedef struct sli_forest {
    sl_int count;
    const sl_int *parent; /* count: -1 at a root */
    const sl_int *low;    /* count: the first of the subtree */
} sli_forest;

/* What the planning needs only while it runs. */
typedef struct sli_planning {
    double *flops;   /* count: of the front, then of the subtree */
    double *load;    /* workers */
    sl_int *side;    /* count: the stack of a supernode, 2 more in a task */
    uint64_t *order; /* count: tasks, the largest last */
    uint64_t *scratch;
} sli_planning;

/* Tasks this much smaller than a worker's share even out what no estimate knows. */
#define SLI_TASKS_A_WORKER 8

/* A front of this many flops takes some 50 us, and is shared out at 1 or 2 us a step by OpenMP, at more by others. */
#define SLI_SHARED_FLOPS 4e6

/* Doubles that a supernode leaves to its parent: the update matrix and the magnitudes of its rows. */
SLI_INLINE sl_off sli_waiting_size(const sli_step *s) {
    const sl_int tiles = sli_update_tiles(s->width, s->below);
    return sli_triangle_offset(tiles) + SLI_TILE * (sl_off)tiles;
}

/* Flops of a front: sum over its columns of (entries)^2. */
SLI_INLINE double sli_front_flops(const sli_step *s) {
    const double w = s->width, h = w + s->below;
    return w * (h * h - (w - 1.0) * h + (w - 1.0) * (2.0 * w - 1.0) / 6.0);
}

/* Where the update matrices of some supernodes, handed over in ascending order, wait: supernodes of
 * even and of odd depth have a stack each, which grow towards each other. When a supernode is done,
 * its children are the top of the other stack, so that nothing ever moves. */
typedef struct sli_stacks {
    sl_off top[2];
    sl_off most;
} sli_stacks;

static void sli_stacks_push(sli_stacks *k, const sl_symbolic *S, sl_int s, const sl_int *side,
                            sl_off *begin) {
    const int own = side[s] & 1, in_task = side[s] & 2;
    const sl_off size = sli_waiting_size(&S->steps[s]);
    sl_int c;
    begin[s] = own == 0 ? k->top[0] : -(k->top[1] + size);
    k->top[own] += size;
    k->most = k->top[0] + k->top[1] > k->most ? k->top[0] + k->top[1] : k->most;
    for (c = s - 1; c >= S->descendant[s]; c = S->descendant[c] - 1) {
        if ((side[c] & 2) == in_task) {
            k->top[1 - own] -= sli_waiting_size(&S->steps[c]);
        }
    }
}

/* The second stack counts from the end, which is known now. */
SLI_INLINE void sli_stacks_settle(const sli_stacks *k, sl_int s, const sl_int *side, sl_off base,
                                  sl_off *begin) {
    begin[s] += base + ((side[s] & 1) == 0 ? 0 : k->most);
}

/* Inside their tasks the supernodes of a worker use the same two stacks, task after task; the roots
 * of tasks have to wait for the fronts above and have places of their own, as the fronts above have
 * their own stacks. */
static void sli_plan_waiting(sli_schedule *p, const sl_symbolic *S, const sl_int *side) {
    sli_stacks k;
    sl_int m, s, worker;
    p->waiting = 0;
    for (worker = 0; worker < p->workers; worker++) {
        memset(&k, 0, sizeof k);
        for (m = 0; m < p->n_tasks; m++) {
            k.top[0] = k.top[1] = 0;
            for (s = p->first[m]; s < p->last[m] && p->worker[m] == worker; s++) {
                sli_stacks_push(&k, S, s, side, p->waiting_begin);
            }
        }
        for (m = 0; m < p->n_tasks; m++) {
            for (s = p->first[m]; s < p->last[m] && p->worker[m] == worker; s++) {
                sli_stacks_settle(&k, s, side, p->waiting, p->waiting_begin);
            }
        }
        p->waiting += k.most;
    }
    for (m = 0; m < p->n_tasks; m++) {
        p->waiting_begin[p->last[m]] = p->waiting;
        p->waiting += sli_waiting_size(&S->steps[p->last[m]]);
    }
    memset(&k, 0, sizeof k);
    for (m = 0; m < p->n_tops; m++) {
        sli_stacks_push(&k, S, p->top[m], side, p->waiting_begin);
    }
    for (m = 0; m < p->n_tops; m++) {
        sli_stacks_settle(&k, p->top[m], side, p->waiting, p->waiting_begin);
    }
    p->waiting += k.most;
}

/* Subtrees of at most limit flops whose parent has more, in ascending order of flops. */
static void sli_find_tasks(sli_schedule *p, const sli_forest *f, sli_planning *w, double limit) {
    const double scale = limit > 0.0 ? 1e9 / limit : 0.0;
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

/* The largest tasks first, each to the worker who has least. */
static void sli_share_tasks(sli_schedule *p, const sli_forest *f, sli_planning *w) {
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

/* Tasks and tops for p->workers. w->flops: of the fronts, where there is more than one worker. */
static void sli_plan_tasks(sli_schedule *p, const sli_forest *f, sli_planning *w) {
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
    sli_find_tasks(p, f, w, total / ((double)p->workers * SLI_TASKS_A_WORKER));
    sli_share_tasks(p, f, w);
}

/* Plans for p->workers. The arrays of p and w have room. */
static void sli_schedule_fill(sli_schedule *p, const sl_symbolic *S, sli_planning *w) {
    const sli_forest f = {S->n_supers, S->super_parent, S->descendant};
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
    sli_plan_waiting(p, S, w->side);
}

static void sli_schedule_layout(sli_schedule *p, sli_block *b, sl_int count) {
    const uint64_t fronts = (uint64_t)count, tasks = p->workers == 1 ? 1 : fronts;
    p->first = SLI_TAKE(b, sl_int, tasks);
    p->last = SLI_TAKE(b, sl_int, tasks);
    p->worker = SLI_TAKE(b, sl_int, tasks);
    p->top = SLI_TAKE(b, sl_int, p->workers == 1 ? 0 : fronts);
    p->waiting_begin = SLI_TAKE(b, sl_off, fronts);
}

static void sli_planning_layout(sli_planning *w, sli_block *b, sl_int count, sl_int workers) {
    w->flops = SLI_TAKE(b, double, count);
    w->load = SLI_TAKE(b, double, workers);
    w->side = SLI_TAKE(b, sl_int, count);
    w->order = SLI_TAKE(b, uint64_t, count);
    w->scratch = SLI_TAKE(b, uint64_t, count);
}

#endif
