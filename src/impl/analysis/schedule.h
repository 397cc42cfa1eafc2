/* schedule.h: tasks of the tree of fronts for parallel workers */
#ifndef SLI_ANALYSIS_SCHEDULE_H
#define SLI_ANALYSIS_SCHEDULE_H

#include "../base/parallel.h"
#include "../base/sort.h"
#include "update_stacks.h"

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
    SLI_ZERO(w->path, S->n_supers);
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

/* Finds what supernodes are, SLI_PLAIN_*. A plain column is direct if the map of its entries is its
 * rows one by one, and its children are plain. */
static void sli_schedule_plain(unsigned char *is_plain, const sl_symbolic *S, int plain) {
    const sli_step *steps = S->steps; /* copies: stores of bytes may change S, for a compiler */
    const sl_int *low = S->first_descendant, supers = S->n_supers;
    const sl_off *begin = S->scatter_begin, *map = S->scatter_to;
    const int may_be_direct = plain == SLI_PLAIN && S->nnz_input >= 0;
    ptrdiff_t s, c;
    for (s = 0; s < supers; s++) {
        int kind = steps[s].width == 1 ? plain : SLI_PLAIN_NOT, is_direct = may_be_direct;
        for (c = s - 1; c >= low[s] && kind != SLI_PLAIN_NOT; c = (ptrdiff_t)low[c] - 1) {
            kind = steps[c].below == 1 ? kind : SLI_PLAIN_NOT;
            is_direct &= is_plain[c] != SLI_PLAIN_NOT;
        }
        is_plain[s] = (unsigned char)kind;
        if (kind != SLI_PLAIN_NOT && is_direct) {
            const sl_off *to = map + begin[s], *end = map + begin[s + 1];
            sl_off at = steps[s].panel;
            const sl_off last = at + steps[s].below;
            while (to < end && *to == at) {
                to++;
                at++;
            }
            is_plain[s] = (unsigned char)(to == end && at == last + 1 ? SLI_PLAIN_DIRECT : kind);
        }
    }
}

/* Fills a schedule for at most p->workers. plain: what plain columns are, SLI_PLAIN_*. The arrays
 * of p and w have room. */
static void sli_schedule_fill(sli_schedule *p, const sl_symbolic *S, int plain,
                              sli_schedule_work *w) {
    const sli_forest f = {S->n_supers, S->super_parent, S->first_descendant};
    sl_int s;
    sli_schedule_plain(p->is_plain, S, plain);
    if (p->workers > 1) {
        for (s = 0; s < S->n_supers; s++) {
            w->flops[s] = sli_front_flops(&S->steps[s]) + SLI_FRONT_COST;
        }
        p->workers = sli_schedule_gain(S, w, p->workers) >= SLI_WORTHWHILE ? p->workers : 1;
    }
    sli_plan_tasks(p, &f, w);
    sli_bundle_tasks(p, w);
    for (s = S->n_supers - 1; s >= 0; s--) {
        const sl_int up = S->super_parent[s];
        w->side[s] = up == -1 ? 0 : 1 - w->side[up];
    }
    sli_plan_stacks(p, S, w->side, (sl_off *)(void *)w->flops, (sl_off *)(void *)w->path);
}

static void sli_schedule_layout(sli_schedule *p, sli_block *b, sl_int count) {
    const sl_int tasks = p->workers == 1 ? 1 : count;
    p->first = SLI_CUT(b, sl_int, tasks);
    p->last = SLI_CUT(b, sl_int, tasks);
    p->worker = SLI_CUT(b, sl_int, tasks);
    p->bundle_end = SLI_CUT(b, sl_int, tasks);
    p->top = SLI_CUT(b, sl_int, p->workers == 1 ? 0 : count);
    p->stack_begin = SLI_CUT(b, sl_off, count);
    p->is_plain = SLI_CUT(b, unsigned char, count);
}

/* The tops of a filled schedule. */
static void sli_schedule_layout_tops(sli_schedule *p, const sl_symbolic *S, sli_block *b) {
    sl_int m, tiles, pieces = 0;
    for (m = 0; m < p->n_tops; m++) {
        const sl_int s = p->top[m];
        pieces += sli_front_is_large(S, s) ? sli_large_pieces(&S->steps[s], p->workers, &tiles) : 0;
    }
    p->tops = SLI_CUT(b, sli_top, p->n_tops);
    p->ready = SLI_CUT(b, sl_int, p->n_tops);
    p->steps = SLI_CUT(b, sl_int, pieces);
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

SLI_NOINLINE static void sli_schedule_work_layout(sli_schedule_work *w, sli_block *b, sl_int count,
                                                  sl_int workers) {
    w->side = SLI_CUT(b, sl_int, count);
    w->flops = w->path = SLI_CUT(b, double, count); /* one worker has one task, and no tops */
    if (workers > 1) {
        w->path = SLI_CUT(b, double, count);
        w->load = SLI_CUT(b, double, workers);
        w->order = SLI_CUT(b, uint64_t, count);
        w->scratch = SLI_CUT(b, uint64_t, count);
    }
}

#endif
