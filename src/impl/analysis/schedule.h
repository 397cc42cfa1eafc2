/* schedule.h: tasks of the tree of fronts for parallel workers, and the layout of update stacks */
#ifndef SLI_ANALYSIS_SCHEDULE_H
#define SLI_ANALYSIS_SCHEDULE_H

#include "../base/parallel.h"
#include "../base/sort.h"
#include "../kernels/front.h"
#include "symbolic_types.h"

/* A front above all tasks, while its matrix is factored. */
typedef struct sli_top {
    sl_int children, waiting; /* waiting: of the children that are not done */
    sl_int pieces;            /* of a large front, which several workers factor; else 0 */
    sl_int first_piece;       /* in the schedule's steps */
    sl_int piece_tiles;       /* row tiles of a piece below the pivots */
    /* pieces that are cleared, groups of pivots that are done, pieces that are eliminated and whose
     * rows of the update matrix are done */
    sl_int cleared, pivots, eliminated, updated;
    int is_begun, is_loading, is_loaded, is_finishing;
} sli_top;

/* What a supernode is in a factorization: one with a front; a plain column that is computed in its
 * panel; one whose entries of A are its rows one by one; a plain column that the parent reads from
 * the stack, as the panel has other numbers. */
enum { SLI_PLAIN_NOT, SLI_PLAIN, SLI_PLAIN_DIRECT, SLI_PLAIN_PASSED };

/* A task is a subtree, a run of consecutive supernodes, that is factored by one worker. The fronts
 * above all tasks follow, large ones by several workers. A single worker has one task: the whole
 * forest. */
typedef struct sli_schedule {
    sl_int workers;
    sl_int n_tasks, n_tops, n_bundles;
    sl_int *first, *last; /* n_tasks: supernodes first..last; large tasks first */
    sl_int *worker;       /* n_tasks: its worker, where that is fixed */
    sl_int *bundle_end;   /* n_bundles: the tasks that are taken at a time end here */
    sl_int *top;          /* n_tops: supernodes above the tasks, ascending */
    /* n_supers: start of each update matrix, in doubles. Positions below `own` are relative to the
     * room of the worker that factors the task */
    sl_off *stack_begin;
    unsigned char *is_plain; /* n_supers, of a factorization: SLI_PLAIN_* */
    sli_top *tops;           /* n_tops */
    sl_int *ready;           /* n_tops: those whose children are done */
    sl_int *steps;           /* the next step of each piece of a large front; -1: it is being run */
    sl_off own;              /* doubles of a worker's stacks */
    sl_off stack;            /* doubles of all stacks together */
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
    double *path;    /* count: flops that follow one another, up to the front */
    double *load;    /* workers: flops assigned */
    sl_int *side;    /* count: 0 or 1, the stack */
    uint64_t *order; /* count: tasks, the largest last */
    uint64_t *scratch;
} sli_schedule_work;

/* Tasks per worker, on average. Small tasks even out the error of the flop estimate. */
#define SLI_TASKS_PER_WORKER 8

/* What a front costs besides its flops. */
#define SLI_FRONT_COST 4000.0

/* A front of SLI_SHARED_FLOPS takes about 50 us; taking a piece of it costs up to 1 us. A bundle of
 * tasks has at least SLI_BUNDLE_FLOPS. Several workers that are SLI_WORTHWHILE times as fast at
 * best are no faster than one. */
#if defined(SLI_SMALL_TASKS)
#define SLI_SHARED_FLOPS 2e4
#define SLI_BUNDLE_FLOPS 1e4
#define SLI_WORTHWHILE 0.0
#else
#define SLI_SHARED_FLOPS 4e6
#define SLI_BUNDLE_FLOPS 2e5
#define SLI_WORTHWHILE 1.25
#endif

/* Doubles that a supernode passes to its parent: the update matrix and the magnitudes of its rows.
 * Half of it is aligned, too: that of a complex matrix. */
SLI_INLINE sl_off sli_update_size(const sli_step *s) {
    const sl_int tiles = sli_update_tiles(s->width, s->below);
    return sli_triangle_offset(tiles) + SLI_TILE * (sl_off)(tiles + tiles % 2);
}

/* Is supernode s one column that its children change in its diagonal entry only? Then what it
 * passes up is known from its column of L and its pivot, and it needs no front. */
static int sli_is_plain(const sl_symbolic *S, sl_int s) {
    int is_plain = S->steps[s].width == 1;
    sl_int c;
    for (c = s - 1; is_plain && c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        is_plain = S->steps[c].below == 1;
    }
    return is_plain;
}

/* Doubles that supernode s passes to its parent in the stack. */
SLI_INLINE sl_off sli_passed_size(const sli_schedule *p, const sl_symbolic *S, sl_int s) {
    return p->is_plain[s] == SLI_PLAIN_NOT ? sli_update_size(&S->steps[s])
           : p->is_plain[s] != SLI_PLAIN_PASSED
               ? 0
               : SLI_TILE * (sl_off)sli_tiles(1 + S->steps[s].below);
}

/* Flops of a front: the sum of (entries)^2 over its columns. */
SLI_INLINE double sli_front_flops(const sli_step *s) {
    const double w = s->width, h = w + s->below;
    return w * (h * h - (w - 1.0) * h + (w - 1.0) * (2.0 * w - 1.0) / 6.0);
}

/* Is supernode s a front that is large enough for several workers? */
SLI_INLINE int sli_front_is_large(const sl_symbolic *S, sl_int s) {
    return S->steps[s].width > 1 && sli_front_flops(&S->steps[s]) >= SLI_SHARED_FLOPS;
}

/* Numbers that follow the update matrix of a large front: its magnitudes, D where it is in float,
 * and reciprocals. Of a complex matrix, there is room for half of this. */
SLI_INLINE sl_off sli_large_scratch(const sli_step *s) {
    return 2 * (SLI_TILE * (sl_off)sli_tiles(s->width + s->below) +
                SLI_FRONT_RECIPROCALS * (sl_off)sli_front_groups(s->width));
}

/* Pieces of a large front, and the row tiles of those below the pivots. */
static sl_int sli_large_pieces(const sli_step *s, sl_int workers, sl_int *tiles) {
    const sl_int below = sli_tiles(s->width + s->below) - sli_tiles(s->width);
    *tiles = sli_max(SLI_GROUP_TILES, below / (4 * workers) + 1);
    return sli_front_groups(s->width) + (below + *tiles - 1) / *tiles;
}

/* Two update stacks that grow towards each other, one for supernodes of even depth and one for odd
 * depth. Supernodes are pushed in ascending order. When a supernode is done, its children are on
 * top of the other stack, so that no update matrix is ever moved. */
typedef struct sli_stacks {
    sl_off top[2];
    sl_off most;
} sli_stacks;

/* Pushes the update matrix of supernode s, then pops those of its children: they are free once s is
 * factored. */
static void sli_stacks_push(sli_stacks *k, const sli_schedule *p, const sl_symbolic *S, sl_int s,
                            const sl_int *side) {
    const int own = side[s];
    const sl_off size = sli_passed_size(p, S, s);
    sl_int c;
    p->stack_begin[s] = own == 0 ? k->top[0] : -(k->top[1] + size);
    k->top[own] += size;
    k->most = k->top[0] + k->top[1] > k->most ? k->top[0] + k->top[1] : k->most;
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        k->top[1 - own] -= sli_passed_size(p, S, c);
    }
}

/* What a front above the tasks, or the root of a task, keeps until its parent is done. */
SLI_INLINE sl_off sli_waiting_size(const sli_schedule *p, const sl_symbolic *S, sl_int s,
                                   int is_top) {
    return sli_passed_size(p, S, s) +
           (is_top && sli_front_is_large(S, s) ? sli_large_scratch(&S->steps[s]) : 0);
}

/* The child of front s whose subtree has the most memory, or -1, and the memory of s and of that
 * subtree. *others := that of the other children. */
static sl_off sli_waiting_largest(const sl_symbolic *S, const sl_off *size, const sl_off *subtree,
                                  sl_int s, sl_int *child, sl_off *others) {
    sl_off sum = 0, most = 0, both;
    sl_int c;
    *child = -1;
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        sum += subtree[c];
        if (subtree[c] > most) {
            most = subtree[c];
            *child = c;
        }
    }
    *others = sum - most;
    both = size[s] + (*child == -1 ? 0 : size[*child]);
    return both > most ? both : most;
}

/* Lays out the update matrices of the fronts above the tasks and of the roots of tasks, from p->own
 * for each worker on. Several workers may factor fronts of disjoint subtrees at the same time, so
 * that these have disjoint memory. That of a front is at one end of its subtree's memory, at the
 * start if side is 0. The child whose subtree has the most memory has its own at the other end, and
 * shares what is between the two with its parent: it is free when that child is done. size,
 * subtree: n_supers of scratch each. */
static void sli_plan_waiting(sli_schedule *p, const sl_symbolic *S, const sl_int *side,
                             sl_off *size, sl_off *subtree) {
    sl_off others;
    sl_int m, c, child;
    for (m = 0; m < p->n_tasks; m++) {
        size[p->last[m]] = subtree[p->last[m]] = sli_waiting_size(p, S, p->last[m], 0);
    }
    for (m = 0; m < p->n_tops; m++) {
        const sl_int s = p->top[m];
        size[s] = sli_waiting_size(p, S, s, 1);
        subtree[s] = sli_waiting_largest(S, size, subtree, s, &child, &others);
        subtree[s] += others;
    }
    for (m = p->n_tops + p->n_tasks - 1; m >= 0; m--) {
        const sl_int s = m >= p->n_tasks ? p->top[m - p->n_tasks] : p->last[m];
        sl_off at;
        if (S->super_parent[s] == -1) {
            p->stack_begin[s] =
                p->stack +
                (side[s] == 0 ? 0 : subtree[s] - size[s]); /* branches untested: of a root */
            p->stack += subtree[s];
        }
        if (m < p->n_tasks || S->first_descendant[s] == s) {
            continue;
        }
        at = sli_waiting_largest(S, size, subtree, s, &child, &others);
        if (child != -1) { /* else all children are plain, and have no memory */
            p->stack_begin[child] = side[s] == 0 ? p->stack_begin[s] + at - size[child]
                                                 : p->stack_begin[s] + size[s] - at;
        }
        for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
            if (c != child) {
                at += subtree[c];
                p->stack_begin[c] = side[s] == 0 ? p->stack_begin[s] + at - size[c]
                                                 : p->stack_begin[s] + size[s] - at;
            }
        }
    }
}

/* Lays out the update stacks. Each worker has room for the two stacks of any task. size, subtree:
 * n_supers of scratch each. */
static void sli_plan_stacks(sli_schedule *p, const sl_symbolic *S, const sl_int *side, sl_off *size,
                            sl_off *subtree) {
    sl_int m, s;
    p->own = 0;
    for (m = 0; m < p->n_tasks; m++) {
        sli_stacks k;
        memset(&k, 0, sizeof k);
        for (s = p->first[m]; s < p->last[m]; s++) {
            sli_stacks_push(&k, p, S, s, side);
        }
        for (s = p->first[m]; s < p->last[m]; s++) { /* the second stack counts from the end */
            p->stack_begin[s] += side[s] == 0 ? 0 : k.most;
        }
        p->own = k.most > p->own ? k.most : p->own;
    }
    p->stack = p->workers * p->own;
    sli_plan_waiting(p, S, side, size, subtree);
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

/* Bundles small tasks, in the order of tasks. w->flops: those of the subtrees. */
static void sli_bundle_tasks(sli_schedule *p, const sli_schedule_work *w) {
    double flops = 0.0;
    sl_int m;
    p->n_bundles = 0;
    for (m = 0; m < p->n_tasks; m++) {
        flops += p->workers > 1 ? w->flops[p->last[m]] : 0.0;
        if (flops >= SLI_BUNDLE_FLOPS || m == p->n_tasks - 1) {
            p->bundle_end[p->n_bundles++] = m + 1;
            flops = 0.0;
        }
    }
}

/* About what a factorization costs, in flops. */
SLI_INLINE double sli_schedule_flops(const sl_symbolic *S) {
    return S->stats.symbolic.flops + SLI_FRONT_COST * S->n_supers;
}

/* The most that workers could gain: all flops, divided by those of the longest path, where large
 * fronts are shared. w->flops: of each front. */
static double sli_schedule_gain(const sl_symbolic *S, const sli_schedule_work *w, sl_int workers) {
    double total = 0.0, longest = 0.0;
    sl_int s;
    memset(w->path, 0, (size_t)S->n_supers * sizeof(double));
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s];
        total += w->flops[s];
        w->path[s] += sli_front_is_large(S, s) ? w->flops[s] / workers : w->flops[s];
        longest = w->path[s] > longest ? w->path[s] : longest;
        if (up != -1) {
            w->path[up] = w->path[s] > w->path[up] ? w->path[s] : w->path[up];
        }
    }
    return longest > 0.0 ? total / longest : 1.0; /* untested: fronts have a cost */
}

/* Is the map of entries of plain column s its rows one by one? */
static int sli_is_direct(const sl_symbolic *S, sl_int s) {
    const sl_off first = S->scatter_begin[s], count = 1 + (sl_off)S->steps[s].below;
    sl_off m = 0;
    if (S->nnz_input < 0 || S->scatter_begin[s + 1] - first != count) {
        return 0;
    }
    while (m < count && S->scatter_to[first + m] == S->steps[s].panel + m) {
        m++;
    }
    return m == count;
}

/* Fills a schedule for at most p->workers. plain: what plain columns are, SLI_PLAIN_*. The arrays
 * of p and w have room. */
static void sli_schedule_fill(sli_schedule *p, const sl_symbolic *S, int plain,
                              sli_schedule_work *w) {
    const sli_forest f = {S->n_supers, S->super_parent, S->first_descendant};
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        p->is_plain[s] =
            (unsigned char)(plain == SLI_PLAIN_NOT || !sli_is_plain(S, s) ? SLI_PLAIN_NOT
                            : plain == SLI_PLAIN && sli_is_direct(S, s)   ? SLI_PLAIN_DIRECT
                                                                          : plain);
    }
    if (p->workers > 1) {
        for (s = 0; s < S->n_supers; s++) {
            w->flops[s] = sli_front_flops(&S->steps[s]) + SLI_FRONT_COST;
        }
        p->workers = sli_schedule_gain(S, w, p->workers) >= SLI_WORTHWHILE ? p->workers : 1;
    }
    sli_plan_tasks(p, &f, w);
    sli_bundle_tasks(p, w);
    for (s = S->n_supers - 1; s >= 0; s--) {
        w->side[s] = S->super_parent[s] == -1 ? 0 : 1 - w->side[S->super_parent[s]];
    }
    sli_plan_stacks(p, S, w->side, (sl_off *)(void *)w->flops, (sl_off *)(void *)w->path);
}

static void sli_schedule_layout(sli_schedule *p, sli_block *b, sl_int count) {
    const uint64_t fronts = (uint64_t)count, tasks = p->workers == 1 ? 1 : fronts;
    p->first = SLI_TAKE(b, sl_int, tasks);
    p->last = SLI_TAKE(b, sl_int, tasks);
    p->worker = SLI_TAKE(b, sl_int, tasks);
    p->bundle_end = SLI_TAKE(b, sl_int, tasks);
    p->top = SLI_TAKE(b, sl_int, p->workers == 1 ? 0 : fronts);
    p->stack_begin = SLI_TAKE(b, sl_off, fronts);
    p->is_plain = SLI_TAKE(b, unsigned char, fronts);
}

/* The tops of a filled schedule. */
static void sli_schedule_layout_tops(sli_schedule *p, const sl_symbolic *S, sli_block *b) {
    sl_int m, tiles, pieces = 0;
    for (m = 0; m < p->n_tops; m++) {
        const sl_int s = p->top[m];
        pieces += sli_front_is_large(S, s) ? sli_large_pieces(&S->steps[s], p->workers, &tiles) : 0;
    }
    p->tops = SLI_TAKE(b, sli_top, p->n_tops);
    p->ready = SLI_TAKE(b, sl_int, p->n_tops);
    p->steps = SLI_TAKE(b, sl_int, pieces);
}

static void sli_schedule_fill_tops(sli_schedule *p, const sl_symbolic *S) {
    sl_int m, c, pieces = 0;
    for (m = 0; m < p->n_tops; m++) {
        const sl_int s = p->top[m];
        sli_top *top = &p->tops[m];
        memset(top, 0, sizeof *top);
        for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
            top->children++;
        }
        if (sli_front_is_large(S, s)) {
            top->pieces = sli_large_pieces(&S->steps[s], p->workers, &top->piece_tiles);
        }
        top->first_piece = pieces;
        pieces += top->pieces;
    }
}

static void sli_schedule_work_layout(sli_schedule_work *w, sli_block *b, sl_int count,
                                     sl_int workers) {
    w->flops = SLI_TAKE(b, double, count);
    w->path = SLI_TAKE(b, double, count);
    w->load = SLI_TAKE(b, double, workers);
    w->side = SLI_TAKE(b, sl_int, count);
    w->order = SLI_TAKE(b, uint64_t, count);
    w->scratch = SLI_TAKE(b, uint64_t, count);
}

#endif
