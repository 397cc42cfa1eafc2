/* descent.h: the way of the inverse from the roots to the leaves, planned: which fronts, whose, and where they wait */
#ifndef SLI_DESCENT_H
#define SLI_DESCENT_H

#include "reach.h"
#include "schedule.h"

/* A front is made of its parent's, which therefore stays until the lowest of its children, the last, has taken its part.
 * Subtrees are tasks of one worker each, the fronts above them come first; one worker has one task, everything. In a task,
 * and above the tasks, the fronts of even and of odd depth have a stack each, which grow towards each other: when
 * a front is made, its parent's is the top of the other stack. The roots of tasks, which take their part as soon as the
 * front above is done, have places of their own. */
typedef struct sli_descent {
    const sl_symbolic *S;
    sli_forest forest;     /* of the supernodes of the list */
    sl_int *supers;        /* count: ascending */
    sl_int *up, *low;      /* count: the forest's own, unless it is that of the analysis */
    int is_partial;        /* groups of columns before the first that is needed are left out */
    sl_int *first;         /* count: that column, in the supernode; NULL: 0 */
    sli_schedule plan;     /* waiting: of the fronts */
    sl_off scratch;        /* doubles for the kernels, for each worker */
    sli_planning planning; /* of more than one worker */
} sli_descent;

/* Doubles of the front of the k-th supernode: whole row tiles of all its columns, and a tile, as columns that the last
 * one has not are read along with those it has. */
SLI_INLINE sl_off sli_descent_front(const sli_descent *d, sl_int k) {
    const sli_step *step = &d->S->steps[d->supers[k]];
    const sl_int h = step->width + step->below;
    return (sl_off)sli_square_offset(h, sli_tiles(h)) + SLI_TILE * SLI_TILE;
}

/* A list of count supernodes, n_supers being all, by so many workers at most. */
static sli_descent sli_descent_of(const sl_symbolic *S, sl_int count, sl_int workers) {
    sli_descent d;
    memset(&d, 0, sizeof d);
    d.S = S;
    d.forest.count = count;
    d.plan.workers = sli_min(workers, sli_max(count, 1));
    return d;
}

static void sli_descent_layout(sli_descent *d, sli_block *b) {
    const sl_int count = d->forest.count, some = count < d->S->n_supers ? count : 0;
    d->supers = SLI_TAKE(b, sl_int, count);
    d->up = SLI_TAKE(b, sl_int, some);
    d->low = SLI_TAKE(b, sl_int, some);
    d->first = d->is_partial ? SLI_TAKE(b, sl_int, count) : NULL;
    sli_schedule_layout(&d->plan, b, count);
}

/* What only the planning of several workers needs. */
static void sli_descent_layout_planning(sli_descent *d, sli_block *b) {
    const sl_int workers = d->plan.workers;
    if (workers > 1) {
        sli_planning_layout(&d->planning, b, d->forest.count, workers);
    }
}

/* The supernodes of the reach of seeds, columns of L in ascending order. */
static void sli_descent_reach(sli_descent *d, const uint64_t *seeds, sl_int n_seeds) {
    const sl_symbolic *S = d->S;
    sl_int k = 0, at = 0, s, next;
    while (k < n_seeds) {
        sl_int column = sli_key(seeds[k]);
        s = S->super_of[column];
        next = sli_next_seed(S, seeds, n_seeds, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            if (d->first != NULL) {
                d->first[at] = sli_min(column - S->super_first[s], S->steps[s].width);
            }
            d->supers[at++] = s;
            column = INT32_MAX;
        }
    }
    SLI_ASSERT(at == d->forest.count);
}

/* Of a supernode those columns are needed that the set names, and the rows of children. */
static void sli_descent_columns(sli_descent *d) {
    const sl_symbolic *S = d->S;
    sl_int k;
    for (k = 0; k < d->forest.count; k++) {
        const sl_int up = d->forest.parent[k];
        if (up != -1) {
            d->first[up] = sli_min(d->first[up], S->places[S->rows_begin[d->supers[k]]]);
        }
    }
}

/* Parents and first descendants within a list. A supernode's parent is the next one of the chain of ancestors at hand
 * that is not below it, as the list is in postorder and closed under the parent relation. */
static void sli_descent_tree(sli_descent *d) {
    const sl_symbolic *S = d->S;
    const sl_int count = d->forest.count;
    sl_int k, up = -1;
    d->forest.parent = S->super_parent;
    d->forest.low = S->descendant;
    if (count == S->n_supers) {
        return;
    }
    for (k = count - 1; k >= 0; k--) {
        const sl_int parent = S->super_parent[d->supers[k]];
        while (up != -1 && d->supers[up] != parent) {
            up = d->up[up];
        }
        d->up[k] = up;
        d->low[k] = k;
        up = k;
    }
    for (k = 0; k < count; k++) {
        if (d->up[k] != -1) {
            d->low[d->up[k]] = sli_min(d->low[d->up[k]], d->low[k]);
        }
    }
    d->forest.parent = d->up;
    d->forest.low = d->low;
}

/* A front goes to the stack that its parent is not on, or to the first one. The second stack counts from its end, in
 * numbers below 0, until the size of both is known. is_last: nobody else needs the parent; is_leaf: nobody needs this. */
static void sli_descent_push(sli_descent *d, sli_stacks *stacks, sl_int k, int is_root, int is_last,
                             int is_leaf) {
    const sl_int up = d->forest.parent[k];
    sl_off *begin = d->plan.waiting_begin, *top = stacks->top;
    const int side = is_root ? 0 : begin[up] >= 0;
    const sl_off size = sli_descent_front(d, k);
    begin[k] = side == 0 ? top[0] : -(top[1] + size);
    top[side] += size;
    stacks->most = top[0] + top[1] > stacks->most ? top[0] + top[1] : stacks->most;
    if (is_last) {
        top[1 - side] -= sli_descent_front(d, up);
    }
    if (is_leaf) {
        top[side] -= size;
    }
}

SLI_INLINE void sli_descent_settle(sli_descent *d, const sli_stacks *stacks, sl_int k,
                                   sl_off from) {
    sl_off *begin = &d->plan.waiting_begin[k];
    *begin += from + (*begin < 0 ? stacks->most : 0);
}

/* Where the fronts first .. last of a task begin, from a place on; returns how many doubles they take. Their parents are
 * among them, or the task's root, or none. */
static sl_off sli_descent_stack_task(sli_descent *d, sl_int first, sl_int last, sl_off from) {
    const sl_int *up = d->forest.parent, *low = d->forest.low;
    sli_stacks stacks;
    sl_int k;
    memset(&stacks, 0, sizeof stacks);
    for (k = last; k >= first; k--) {
        const int is_root = up[k] == -1 || up[k] > last;
        sli_descent_push(d, &stacks, k, is_root, !is_root && low[up[k]] == low[k], low[k] == k);
    }
    for (k = first; k <= last; k++) {
        sli_descent_settle(d, &stacks, k, from);
    }
    return stacks.most;
}

/* The same of the fronts above all tasks. */
static sl_off sli_descent_stack_tops(sli_descent *d, sl_off from) {
    const sli_schedule *p = &d->plan;
    const sl_int *up = d->forest.parent;
    sl_int *child = d->planning.side; /* the lowest that is above all tasks, or -1 */
    sli_stacks stacks;
    sl_int m;
    memset(&stacks, 0, sizeof stacks);
    for (m = p->n_tops - 1; m >= 0; m--) {
        const sl_int k = p->top[m];
        child[k] = -1;
        if (up[k] != -1) {
            child[up[k]] = k;
        }
    }
    for (m = p->n_tops - 1; m >= 0; m--) {
        const sl_int k = p->top[m];
        sli_descent_push(d, &stacks, k, up[k] == -1, up[k] != -1 && child[up[k]] == k,
                         child[k] == -1);
    }
    for (m = 0; m < p->n_tops; m++) {
        sli_descent_settle(d, &stacks, p->top[m], from);
    }
    return stacks.most;
}

/* The same of everything. */
static void sli_descent_place(sli_descent *d) {
    sli_schedule *p = &d->plan;
    const sl_int own = p->workers > 1; /* a task's root has a place of its own */
    sl_int k, m;
    p->waiting = p->n_tops > 0 ? sli_descent_stack_tops(d, 0) : 0;
    for (m = 0; m < p->n_tasks && own; m++) {
        p->waiting_begin[p->last[m]] = p->waiting;
        p->waiting += sli_descent_front(d, p->last[m]);
    }
    for (k = 0; k < p->workers; k++) {
        sl_off most = 0;
        for (m = 0; m < p->n_tasks; m++) {
            if (p->worker[m] == k) {
                const sl_off size =
                    sli_descent_stack_task(d, p->first[m], p->last[m] - own, p->waiting);
                most = size > most ? size : most;
            }
        }
        p->waiting += most;
    }
}

/* Scratch for any front of the list. */
static sl_off sli_descent_scratch(const sli_descent *d) {
    sl_int k, tallest = 0, widest = 0;
    for (k = 0; k < d->forest.count; k++) {
        const sli_step *step = &d->S->steps[d->supers[k]];
        tallest = sli_max(tallest, step->width + step->below);
        widest = sli_max(widest, step->width);
    }
    return sli_dual_scratch(tallest, widest);
}

/* Plans for a list, or, seeds being NULL, for all. The arrays have room. */
static void sli_descent_plan(sli_descent *d, const uint64_t *seeds, sl_int n_seeds) {
    sli_schedule *p = &d->plan;
    sl_int k;
    if (seeds != NULL) {
        sli_descent_reach(d, seeds, n_seeds);
    }
    for (k = 0; k < d->forest.count && seeds == NULL; k++) {
        d->supers[k] = k;
    }
    sli_descent_tree(d);
    if (d->first != NULL) {
        sli_descent_columns(d);
    }
    for (k = 0; k < d->forest.count && p->workers > 1; k++) {
        d->planning.flops[k] = sli_front_flops(&d->S->steps[d->supers[k]]);
    }
    sli_plan_tasks(p, &d->forest, &d->planning);
    d->scratch = sli_descent_scratch(d);
    sli_descent_place(d);
}

/* Where row stands in supernode s, which begins at or before it, or -1. */
static sl_int sli_descent_row(const sl_symbolic *S, sl_int s, sl_int row) {
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int width = S->steps[s].width, below = S->steps[s].below, r = row - S->super_first[s];
    sl_int i;
    if (r < width) {
        return r;
    }
    i = sli_lower_bound(rows, below, row);
    return i < below && rows[i] == row ? width + i : -1;
}

static void sli_descent_stats(const sli_descent *d, sl_stats *stats) {
    sl_int k;
    stats->z_supernodes = d->forest.count;
    stats->z_columns = 0;
    for (k = 0; k < d->forest.count; k++) {
        stats->z_columns += d->S->steps[d->supers[k]].width;
    }
}

#endif
