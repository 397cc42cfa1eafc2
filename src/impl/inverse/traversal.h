/* traversal.h: plan of a top-down traversal: its fronts, the tasks of workers, memory */
#ifndef SLI_INVERSE_TRAVERSAL_H
#define SLI_INVERSE_TRAVERSAL_H

#include "../analysis/reach.h"
#include "../analysis/schedule.h"
#include "inverse_front.h"

/* A top-down traversal computes fronts of the inverse from the roots of the elimination tree to its
 * leaves. The front of a supernode starts with entries of its parent's front, so the parent's front
 * is kept until its last child, the one with the lowest number, has copied its entries.
 * Tasks are subtrees, each traversed by one worker. The fronts above the tasks come first and are
 * shared by all workers. With one worker, everything is one task.
 * Inside a task, and again above the tasks, there are two stacks, one for the fronts of even depth
 * and one for those of odd depth. They grow towards each other: when a front is allocated, its
 * parent's front is on top of the other stack. The fronts of task roots copy from their parent as
 * soon as it is complete, so each of them has memory of its own. */
typedef struct sli_traversal {
    const sl_symbolic *S;
    sli_forest forest; /* the supernodes of the list */
    sl_int *supers;    /* count: ascending */
    /* count: the forest's arrays; a list of all supernodes uses those of the analysis instead */
    sl_int *parent, *low;
    int is_partial; /* 1: column groups before the first column that is needed are left out */
    sl_int *first;  /* count: the first column that is needed, within its supernode; NULL: 0 */
    sli_schedule schedule;           /* tasks and the offsets of the fronts */
    sl_off scratch;                  /* doubles of kernel scratch per worker */
    sl_off panel;                    /* doubles of the largest panel */
    sl_off column;                   /* doubles of the largest panel of one column, with padding */
    sli_schedule_work schedule_work; /* with more than one worker */
} sli_traversal;

/* Doubles of the front of the k-th supernode: its row tiles with all columns, and one tile more,
 * because kernels read whole tiles of columns, also beyond the last column. */
SLI_INLINE sl_off sli_traversal_front_size(const sli_traversal *t, sl_int k) {
    const sli_step *step = &t->S->steps[t->supers[k]];
    const sl_int h = step->width + step->below;
    return (sl_off)sli_square_offset(h, sli_tiles(h)) + SLI_TILE * SLI_TILE;
}

/* The workers that share a traversal of supernodes of S, which may be all of them. */
SLI_INLINE sl_int sli_traversal_workers(const sl_symbolic *S, const sl_threads *threads) {
    return sli_workers_for(threads, 2.0 * sli_schedule_flops(S));
}

/* A traversal of count supernodes of S by at most the given number of workers. */
static sli_traversal sli_traversal_of(const sl_symbolic *S, sl_int count, sl_int workers) {
    sli_traversal t;
    SLI_CLEAR(t);
    t.S = S;
    t.forest.count = count;
    t.schedule.workers = sli_min(workers, sli_max(count, 1));
    return t;
}

static void sli_traversal_layout(sli_traversal *t, sli_block *b) {
    const sl_int count = t->forest.count, some = count < t->S->n_supers ? count : 0;
    t->supers = SLI_TAKE(b, sl_int, count);
    t->parent = SLI_TAKE(b, sl_int, some);
    t->low = SLI_TAKE(b, sl_int, some);
    t->first = t->is_partial ? SLI_TAKE(b, sl_int, count) : NULL;
    sli_schedule_layout(&t->schedule, b, count);
}

/* Arrays that are needed only while several workers are scheduled. */
static void sli_traversal_layout_work(sli_traversal *t, sli_block *b) {
    const sl_int workers = t->schedule.workers;
    if (workers > 1) {
        sli_schedule_work_layout(&t->schedule_work, b, t->forest.count, workers);
    }
}

/* Lists the supernodes of the reach of seeds (columns of L, ascending). */
static void sli_traversal_list_reach(sli_traversal *t, const uint64_t *seeds, sl_int n_seeds) {
    const sl_symbolic *S = t->S;
    sl_int k = 0, at = 0, s, next;
    while (k < n_seeds) {
        sl_int column = sli_key(seeds[k]);
        s = S->super_of[column];
        next = sli_next_seed(S, seeds, n_seeds, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            if (t->first != NULL) {
                t->first[at] = sli_min(column - S->super_first[s], S->steps[s].width);
            }
            t->supers[at++] = s;
            column = INT32_MAX;
        }
    }
    SLI_ASSERT(at == t->forest.count);
}

/* The first column of a supernode that is needed: of those in the set and those that a child has
 * among its rows. */
static void sli_traversal_find_first(sli_traversal *t) {
    const sl_symbolic *S = t->S;
    sl_int k;
    for (k = 0; k < t->forest.count; k++) {
        const sl_int parent = t->forest.parent[k];
        if (parent != -1) {
            const sl_int row = S->relative[S->rows_begin[t->supers[k]]];
            t->first[parent] = sli_min(t->first[parent], row);
        }
    }
}

/* Parents and first descendants as positions in the list. The list is in postorder and contains
 * every ancestor of its supernodes, so a supernode's parent is found by walking up the chain of
 * ancestors of the next supernode in the list. */
static void sli_traversal_link(sli_traversal *t) {
    const sl_symbolic *S = t->S;
    const sl_int count = t->forest.count;
    sl_int k, above = -1;
    t->forest.parent = S->super_parent;
    t->forest.low = S->first_descendant;
    if (count == S->n_supers) {
        return;
    }
    for (k = count - 1; k >= 0; k--) {
        const sl_int parent = S->super_parent[t->supers[k]];
        while (above != -1 && t->supers[above] != parent) {
            above = t->parent[above];
        }
        t->parent[k] = above;
        t->low[k] = k;
        above = k;
    }
    for (k = 0; k < count; k++) {
        if (t->parent[k] != -1) {
            t->low[t->parent[k]] = sli_min(t->low[t->parent[k]], t->low[k]);
        }
    }
    t->forest.parent = t->parent;
    t->forest.low = t->low;
}

/* Allocates the front of k on the stack that does not hold its parent's, or on the first stack for
 * a root. Offsets in the second stack count down from its end and are negative until the size of
 * both stacks is known. is_last: the parent's front is not needed after this one; is_leaf: no child
 * needs this one. */
static void sli_traversal_push(sli_traversal *t, sli_stacks *stacks, sl_int k, int is_root,
                               int is_last, int is_leaf) {
    const sl_int parent = t->forest.parent[k];
    sl_off *begin = t->schedule.stack_begin, *top = stacks->top;
    const int side = is_root ? 0 : begin[parent] >= 0;
    const sl_off size = sli_traversal_front_size(t, k);
    begin[k] = side == 0 ? top[0] : -(top[1] + size);
    top[side] += size;
    stacks->most = top[0] + top[1] > stacks->most ? top[0] + top[1] : stacks->most;
    if (is_last) {
        top[1 - side] -= sli_traversal_front_size(t, parent);
    }
    if (is_leaf) {
        top[side] -= size;
    }
}

/* The final offset of front k, once the size of both stacks is known; they begin at offset from. */
SLI_INLINE void sli_traversal_settle(sli_traversal *t, const sli_stacks *stacks, sl_int k,
                                     sl_off from) {
    sl_off *begin = &t->schedule.stack_begin[k];
    *begin += from + (*begin < 0 ? stacks->most : 0);
}

/* Offsets of the fronts first .. last of a task, beginning at `from`; returns the doubles that they
 * take. A parent outside of first .. last is the root of the task or does not exist. */
static sl_off sli_traversal_stack_task(sli_traversal *t, sl_int first, sl_int last, sl_off from) {
    const sl_int *parent = t->forest.parent, *low = t->forest.low;
    sli_stacks stacks;
    sl_int k;
    SLI_CLEAR(stacks);
    for (k = last; k >= first; k--) {
        const int is_root = parent[k] == -1 || parent[k] > last;
        sli_traversal_push(t, &stacks, k, is_root, !is_root && low[parent[k]] == low[k],
                           low[k] == k);
    }
    for (k = first; k <= last; k++) {
        sli_traversal_settle(t, &stacks, k, from);
    }
    return stacks.most;
}

/* Offsets of the fronts above all tasks. */
static sl_off sli_traversal_stack_tops(sli_traversal *t, sl_off from) {
    const sli_schedule *p = &t->schedule;
    const sl_int *parent = t->forest.parent;
    sl_int *child = t->schedule_work.side; /* the lowest child that is above all tasks, or -1 */
    sli_stacks stacks;
    sl_int m;
    SLI_CLEAR(stacks);
    for (m = p->n_tops - 1; m >= 0; m--) {
        const sl_int k = p->top[m];
        child[k] = -1;
        if (parent[k] != -1) {
            child[parent[k]] = k;
        }
    }
    for (m = p->n_tops - 1; m >= 0; m--) {
        const sl_int k = p->top[m];
        sli_traversal_push(t, &stacks, k, parent[k] == -1, parent[k] != -1 && child[parent[k]] == k,
                           child[k] == -1);
    }
    for (m = 0; m < p->n_tops; m++) {
        sli_traversal_settle(t, &stacks, p->top[m], from);
    }
    return stacks.most;
}

/* Offsets of all fronts. The root of a task has memory of its own, because its rows below are
 * gathered before the tasks begin. The fronts above the tasks are not needed from then on, so that
 * the workers' stacks take their place. */
static void sli_traversal_stack_all(sli_traversal *t) {
    sli_schedule *p = &t->schedule;
    const sl_int own_roots = p->workers > 1;
    sl_off tops = 0;
    sl_int k, m;
    p->stack = 0;
    for (m = 0; m < p->n_tasks && own_roots; m++) {
        p->stack_begin[p->last[m]] = p->stack;
        p->stack += sli_traversal_front_size(t, p->last[m]);
    }
    if (p->n_tops > 0) {
        tops = p->stack + sli_traversal_stack_tops(t, p->stack);
    }
    for (k = 0; k < p->workers; k++) {
        sl_off most = 0;
        for (m = 0; m < p->n_tasks; m++) {
            if (p->worker[m] == k) {
                const sl_off size =
                    sli_traversal_stack_task(t, p->first[m], p->last[m] - own_roots, p->stack);
                most = size > most ? size : most;
            }
        }
        p->stack += most;
    }
    p->stack = tops > p->stack ? tops : p->stack;
}

/* Computes the kernel scratch that suffices for every front of the list. */
static void sli_traversal_measure(sli_traversal *t) {
    sl_int k, tallest = 0, widest = 0;
    for (k = 0; k < t->forest.count; k++) {
        const sli_step *step = &t->S->steps[t->supers[k]];
        const sl_int tiles = sli_tiles(step->width + step->below);
        const sl_off panel = sli_tile_offset(step->width, tiles);
        t->panel = panel > t->panel ? panel : t->panel;
        t->column = step->width == 1 && panel > t->column ? panel : t->column;
        tallest = sli_max(tallest, step->width + step->below);
        widest = sli_max(widest, step->width);
    }
    t->scratch = sli_inverse_scratch(tallest, widest);
}

/* Plans the traversal of the reach of seeds, or of all supernodes if seeds is NULL. The arrays are
 * allocated. */
static void sli_traversal_plan(sli_traversal *t, const uint64_t *seeds, sl_int n_seeds) {
    sli_schedule *p = &t->schedule;
    sl_int k;
    if (seeds != NULL) {
        sli_traversal_list_reach(t, seeds, n_seeds);
    }
    for (k = 0; k < t->forest.count && seeds == NULL; k++) {
        t->supers[k] = k;
    }
    sli_traversal_link(t);
    if (t->first != NULL) {
        sli_traversal_find_first(t);
    }
    for (k = 0; k < t->forest.count && p->workers > 1; k++) {
        t->schedule_work.flops[k] = sli_front_flops(&t->S->steps[t->supers[k]]);
    }
    sli_plan_tasks(p, &t->forest, &t->schedule_work);
    sli_traversal_measure(t);
    sli_traversal_stack_all(t);
}

/* The local row of pivot `row` in the front of supernode s, which begins at or before it; -1 if s
 * does not have it. */
static sl_int sli_front_row(const sl_symbolic *S, sl_int s, sl_int row) {
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int width = S->steps[s].width, below = S->steps[s].below, r = row - S->super_first[s];
    sl_int i;
    if (r < width) {
        return r;
    }
    i = sli_lower_bound(rows, below, row);
    return i < below && rows[i] == row ? width + i : -1;
}

/* The columns of the supernodes of a list. */
static sl_int sli_traversal_count_columns(const sli_traversal *t) {
    sl_int k, columns = 0;
    for (k = 0; k < t->forest.count; k++) {
        columns += t->S->steps[t->supers[k]].width;
    }
    return columns;
}

#endif
