/* sweep_tasks.h: full solves by several workers: by subtrees, or by blocks of right-hand sides */
#ifndef SLI_SOLVE_SWEEP_TASKS_H
#define SLI_SOLVE_SWEEP_TASKS_H

#include "../base/parallel.h"
#include "backward.h"
#include "query.h"

/* The least work of a worker, and the least gain of all for one right-hand side, in entries of L,
 * of which a solve reads 5 to 10 in a ns. For each 16 right-hand sides the gain has to be as large
 * once more. Starting a worker takes as long as 1e5 entries and more. What a subtree passes up
 * costs as much as SLI_SOLVE_SLOT entries for each number. */
#if defined(SLI_SMALL_TASKS)
#define SLI_SOLVE_ENTRIES 1
#define SLI_SOLVE_GAIN (-1e30)
#else
#define SLI_SOLVE_ENTRIES 400000
#define SLI_SOLVE_GAIN 400000.0
#endif
#define SLI_SOLVE_SLOT 12.0
#define SLI_SOLVE_TASKS 64

/* Rows of X and B that a worker moves at a time. */
#define SLI_SOLVE_ROWS 4096

/* From so many right-hand sides for each worker on, blocks of them take less time than subtrees. */
#define SLI_SOLVE_SHARE 16

/* Supernodes first .. last: whole trees whose parent, if any, is above. */
typedef struct sli_sweep_task {
    sl_int first, last;
    sl_int slots; /* its first slot */
} sli_sweep_task;

/* A full solve of a block of right-hand sides. Workers move its rows into the vector. They take the
 * subtrees in the forward sweep, one takes the supernodes above them in both sweeps, then workers
 * take the subtrees in the backward sweep, and the rows of the solution.
 *
 * In a forward sweep, many supernodes add to the same row above. Sums are rounded, so that they
 * must be added in the order of supernodes: a subtree writes each row that leaves it to a slot,
 * behind the vector. Kernels add the whole contribution of a supernode to a row at once; a slot
 * that begins as -0 then holds just that.
 *
 * Many right-hand sides are distributed by blocks of 8 to 64 instead, each a solve of its own. */
typedef struct sli_sweep_tasks {
    const sl_factor *F;
    const sli_query *q;
    sli_rhs rhs;   /* of the call */
    sli_rhs block; /* those that subtrees are taken for */
    int kind;      /* of their kernels */
    sl_int workers;
    sl_int share; /* right-hand sides of a block that is distributed; 0: none is */
    sl_int n_tasks, n_tops, n_slots;
    sli_sweep_task tasks[SLI_SOLVE_TASKS]; /* ascending */
    sl_int order[SLI_SOLVE_TASKS];         /* the largest first */
    sl_int tops[SLI_SOLVE_TASKS];          /* supernodes above the tasks */
    void (*run_block)(void *data, sl_int item, sl_int worker);
    sli_atomic has_failed; /* a solution is not finite */
    void *memory;
    size_t bytes, total; /* of one worker's vectors where blocks are distributed; of everything */
    double *y, *scratch; /* y: n + slots, for each right-hand side of a block */
    sl_int *slot_row;    /* slots: the row that each is added to */
    sl_int *rows;        /* tallest, for each worker */
} sli_sweep_tasks;

SLI_INLINE sl_off sli_sweep_entries(const sl_symbolic *S, sl_int first, sl_int last) {
    return S->panel_begin[last + 1] - S->panel_begin[first];
}

/* Adds the trees first .. last as tasks, from the last tree on. Trees of fewer than `least` entries
 * are joined. */
static void sli_sweep_tasks_add(sli_sweep_tasks *t, sl_int first, sl_int last, sl_off least) {
    const sl_symbolic *S = t->F->S;
    sl_int s = last;
    while (s >= first) {
        sl_int low = S->first_descendant[s];
        while (low > first) {
            const sl_int next = S->first_descendant[low - 1];
            if (t->n_tasks < SLI_SOLVE_TASKS - 1 &&
                (sli_sweep_entries(S, low, s) >= least ||
                 sli_sweep_entries(S, next, low - 1) >= least)) {
                break;
            }
            low = next;
        }
        t->tasks[t->n_tasks].first = low;
        t->tasks[t->n_tasks++].last = s;
        s = low - 1;
    }
}

/* Entries of the tasks of the worker with most of them, if each in turn, the largest first, goes to
 * the one with least. sizes: of the tasks, in descending order; replaced. */
static double sli_sweep_tasks_load(double *sizes, sl_int count, sl_int workers) {
    double most = 0.0;
    sl_int m, k, least;
    for (m = 0; m < count; m++) {
        least = sli_min(m, workers - 1);
        for (k = 0; k < workers && m >= workers; k++) { /* the first ones hold what workers have */
            least = sizes[k] < sizes[least] ? k : least;
        }
        sizes[least] = m < workers ? sizes[m] : sizes[least] + sizes[m];
        most = sizes[least] > most ? sizes[least] : most;
    }
    return most;
}

/* Entries that follow one another with so many workers, and the largest task that is a tree with
 * children, or -1. */
static double sli_sweep_tasks_path(const sli_sweep_tasks *t, sl_int workers, sl_int *largest) {
    const sl_symbolic *S = t->F->S;
    double sizes[SLI_SOLVE_TASKS], tops = 0.0, most_tree = 0.0;
    sl_int m, k;
    *largest = -1;
    for (m = 0; m < t->n_tops; m++) {
        tops += (double)sli_sweep_entries(S, t->tops[m], t->tops[m]);
    }
    for (m = 0; m < t->n_tasks; m++) {
        const sli_sweep_task *task = &t->tasks[m];
        const double entries = (double)sli_sweep_entries(S, task->first, task->last);
        for (k = m; k > 0 && sizes[k - 1] < entries; k--) {
            sizes[k] = sizes[k - 1];
        }
        sizes[k] = entries;
        if (task->first < task->last && S->first_descendant[task->last] == task->first &&
            entries > most_tree) {
            most_tree = entries;
            *largest = m;
        }
    }
    return tops + sli_sweep_tasks_load(sizes, t->n_tasks, workers);
}

/* Divides trees, the largest first, as long as that shortens the path, with a few steps beyond. */
static double sli_sweep_tasks_divide(sli_sweep_tasks *t, sl_int workers) {
    const sl_symbolic *S = t->F->S;
    const sl_off least = S->panel_begin[S->n_supers] / (16 * (sl_off)workers);
    sli_sweep_task kept[SLI_SOLVE_TASKS];
    sl_int n_kept = 0, n_kept_tops = 0, at, step;
    double best = (double)S->panel_begin[S->n_supers], path;
    t->n_tasks = t->n_tops = 0;
    sli_sweep_tasks_add(t, 0, S->n_supers - 1, least);
    for (step = 0; step < SLI_SOLVE_TASKS / 2; step++) {
        path = sli_sweep_tasks_path(t, workers, &at);
        if (path < best) {
            best = path;
            memcpy(kept, t->tasks, sizeof kept);
            n_kept = t->n_tasks;
            n_kept_tops = t->n_tops;
        }
        if (at == -1 || t->n_tasks >= SLI_SOLVE_TASKS - 1) {
            break;
        }
        t->tops[t->n_tops++] = t->tasks[at].last;
        {
            const sli_sweep_task tree = t->tasks[at];
            t->tasks[at] = t->tasks[--t->n_tasks];
            sli_sweep_tasks_add(t, tree.first, tree.last - 1, least);
        }
    }
    memcpy(t->tasks, kept, sizeof kept);
    t->n_tasks = n_kept;
    t->n_tops = n_kept_tops;
    return best;
}

/* The first row of supernode s, of those below it, that is `end` or later. */
SLI_INLINE sl_int sli_sweep_leaves_at(const sl_symbolic *S, sl_int s, sl_int end) {
    const sl_off from = S->rows_begin[s], to = S->rows_begin[s + 1];
    return to == from || S->rows[to - 1] < end
               ? (sl_int)(to - from)
               : sli_lower_bound(S->rows + from, (sl_int)(to - from), end);
}

/* Sorts tasks and supernodes above them, and counts the slots. */
static void sli_sweep_tasks_finish(sli_sweep_tasks *t) {
    const sl_symbolic *S = t->F->S;
    sl_int m, k, s;
    for (m = 1; m < t->n_tasks; m++) {
        const sli_sweep_task task = t->tasks[m];
        for (k = m; k > 0 && t->tasks[k - 1].first > task.first; k--) {
            t->tasks[k] = t->tasks[k - 1];
        }
        t->tasks[k] = task;
    }
    for (m = 1; m < t->n_tops; m++) {
        const sl_int top = t->tops[m];
        for (k = m; k > 0 && t->tops[k - 1] > top; k--) {
            t->tops[k] = t->tops[k - 1];
        }
        t->tops[k] = top;
    }
    t->n_slots = 0;
    for (m = 0; m < t->n_tasks; m++) {
        sli_sweep_task *task = &t->tasks[m];
        const sl_off size = sli_sweep_entries(S, task->first, task->last);
        task->slots = t->n_slots;
        for (s = task->first; s <= task->last; s++) {
            t->n_slots +=
                S->steps[s].below - sli_sweep_leaves_at(S, s, S->super_first[task->last + 1]);
        }
        for (k = m; k > 0 && sli_sweep_entries(S, t->tasks[t->order[k - 1]].first,
                                               t->tasks[t->order[k - 1]].last) < size;
             k--) {
            t->order[k] = t->order[k - 1];
        }
        t->order[k] = m;
    }
}

/* The scratch of one worker's sweeps. */
static size_t sli_sweep_tasks_scratch(const sli_sweep_tasks *t) {
    const sl_symbolic *S = t->F->S;
    return sli_sweep_scratch_up_to(S->tallest, S->widest, SLI_BLOCK_MOST);
}

static void sli_sweep_tasks_layout(sli_sweep_tasks *t, sli_block *b) {
    const sl_symbolic *S = t->F->S;
    const uint64_t workers = (uint64_t)t->workers, rows = (uint64_t)S->n + (uint64_t)t->n_slots;
    const int kind = sli_lanes_kind(sli_block_size(t->rhs.nrhs, SLI_BLOCK_MOST));
    t->y = SLI_TAKE(b, double, rows << kind);
    t->scratch = SLI_TAKE(b, double, workers *sli_sweep_tasks_scratch(t));
    t->slot_row = SLI_TAKE(b, sl_int, t->n_slots);
    t->rows = SLI_TAKE(b, sl_int, workers * (uint64_t)S->tallest);
}

/* Plans a solve by subtrees, if that is worthwhile. Returns 0 if not. */
static int sli_sweep_tasks_by_trees(sli_sweep_tasks *t, sl_int workers) {
    const sl_symbolic *S = t->F->S;
    const double entries = (double)S->panel_begin[S->n_supers], nrhs = t->rhs.nrhs;
    const double weight = (4.0 + nrhs) / 5.0; /* 8 take some 2.4 times as long as 1 */
    const double shares = weight * entries / SLI_SOLVE_ENTRIES;
    const double least = SLI_SOLVE_GAIN * (1.0 + nrhs / 16.0);
    double gain;
    workers = shares < workers ? (sl_int)shares : workers;
    if (workers < 2) {
        return 0;
    }
    gain = entries - sli_sweep_tasks_divide(t, workers);
    if (gain <= 0.0 || weight * gain < least) { /* with a single task, too */
        return 0;
    }
    sli_sweep_tasks_finish(t);
    if (weight * gain - SLI_SOLVE_SLOT * nrhs * t->n_slots < least ||
        t->n_slots > SLI_ROWS_MAX - S->n) { /* untested: 2^31 rows */
        return 0;
    }
    t->workers = workers;
    return 1;
}

/* Plans a solve by several workers. workers := 1 where one is as fast, or where rounding would
 * differ. */
static void sli_sweep_tasks_plan(sli_sweep_tasks *t, const sl_factor *F, const sli_query *q,
                                 const sli_rhs *rhs, const sl_threads *threads) {
    const sl_symbolic *S = F->S;
    const sl_int nrhs = rhs->nrhs, most = sli_team_workers(threads);
    const double shares = 8.0 * (double)S->panel_begin[S->n_supers] / SLI_SOLVE_ENTRIES;
    sli_block b = {NULL, 0};
    t->workers = 1;
    t->share = 0;
    if (most < 2 || q->b_index != S->iperm || q->x_index != S->iperm || F->null.count > 0) {
        return;
    }
    t->F = F;
    t->q = q;
    t->rhs = *rhs;
    if (nrhs < SLI_SOLVE_SHARE * (int64_t)most && sli_sweep_tasks_by_trees(t, most)) {
        sli_sweep_tasks_layout(t, &b);
    } else if (nrhs > 8) {
        t->workers = sli_min(most, sli_tiles(nrhs));
        t->workers = shares < t->workers ? sli_max((sl_int)shares, 1) : t->workers;
        t->share = 8;
        while (2 * t->share * t->workers <= nrhs && t->share < SLI_BLOCK_MOST) {
            t->share *= 2;
        }
        t->bytes = sli_vectors_bytes(q, t->share, SLI_BLOCK_MOST);
        (void)sli_take(&b, (uint64_t)t->workers, t->bytes);
    }
    t->total = b.used;
}

/* The forward sweep over supernodes first .. last, with other positions of the rows, or NULL. */
static void sli_sweep_tasks_steps(const sli_sweep_tasks *t, sl_int first, sl_int last,
                                  const sl_int *rows, double *scratch) {
    const sl_symbolic *S = t->F->S;
    sli_reach R = t->q->forward;
    if (first <= last) {
        sli_reach_cut(&R, first, last + 1 - first);
        R.rows = rows == NULL ? S->rows + S->rows_begin[first] : rows;
        sli_forward_sweep(t->F, t->kind, &R, t->y, scratch);
    }
}

static void sli_sweep_tasks_backward(const sli_sweep_tasks *t, sl_int first, sl_int last,
                                     double *scratch) {
    const sl_symbolic *S = t->F->S;
    sli_reach R = t->q->backward;
    sli_reach_cut(&R, first, last + 1 - first);
    R.rows = S->rows + S->rows_begin[first];
    R.n_rows = S->rows_begin[last + 1] - S->rows_begin[first];
    sli_backward(t->F, &R, t->kind, t->y, scratch);
}

/* The forward sweep over a task. */
static void sli_sweep_tasks_forward(const sli_sweep_tasks *t, const sli_sweep_task *task,
                                    double *scratch, sl_int *rows) {
    const sl_symbolic *S = t->F->S;
    const sl_int end = S->super_first[task->last + 1];
    const sl_int lanes = (sl_int)1 << t->kind;
    sl_int s, from = task->first, slot = task->slots, k, r;
    for (s = task->first; s <= task->last; s++) {
        const sl_int below = S->steps[s].below, leaves = sli_sweep_leaves_at(S, s, end);
        if (leaves == below) {
            continue;
        }
        SLI_COPY(rows, S->rows + S->rows_begin[s], below);
        for (k = leaves; k < below; k++) {
            t->slot_row[slot] = rows[k];
            rows[k] = S->n + slot++;
            for (r = 0; r < lanes; r++) {
                t->y[(ptrdiff_t)rows[k] * lanes + r] = -0.0;
            }
        }
        sli_sweep_tasks_steps(t, from, s - 1, NULL, scratch);
        sli_sweep_tasks_steps(t, s, s, rows, scratch);
        from = s + 1;
    }
    sli_sweep_tasks_steps(t, from, task->last, NULL, scratch);
}

/* Both sweeps over the supernodes above the tasks, with what the tasks pass to them. */
static void sli_sweep_tasks_tops(const sli_sweep_tasks *t, double *scratch) {
    const sl_int lanes = (sl_int)1 << t->kind;
    sl_int m, k, r, at = 0;
    for (m = 0; m < t->n_tasks; m++) {
        const sl_int last = m + 1 < t->n_tasks ? t->tasks[m + 1].slots : t->n_slots;
        for (; at < t->n_tops && t->tops[at] < t->tasks[m].first; at++) {
            sli_sweep_tasks_steps(t, t->tops[at], t->tops[at], NULL, scratch);
        }
        for (k = t->tasks[m].slots; k < last; k++) {
            double *row = t->y + (ptrdiff_t)t->slot_row[k] * lanes;
            const double *slot = t->y + ((ptrdiff_t)t->F->S->n + k) * lanes;
            for (r = 0; r < lanes; r++) {
                row[r] += slot[r];
            }
        }
    }
    for (; at < t->n_tops; at++) {
        sli_sweep_tasks_steps(t, t->tops[at], t->tops[at], NULL, scratch);
    }
    for (m = t->n_tops - 1; m >= 0; m--) {
        sli_sweep_tasks_backward(t, t->tops[m], t->tops[m], scratch);
    }
}

/* The loops over the tasks, and the supernodes above them in between. */
static void sli_sweep_tasks_forward_item(void *data, sl_int item, sl_int worker) {
    const sli_sweep_tasks *t = (const sli_sweep_tasks *)data;
    sli_sweep_tasks_forward(t, &t->tasks[t->order[item]],
                            t->scratch + (size_t)worker * sli_sweep_tasks_scratch(t),
                            t->rows + (size_t)worker * (size_t)t->F->S->tallest);
}

static void sli_sweep_tasks_backward_item(void *data, sl_int item, sl_int worker) {
    const sli_sweep_tasks *t = (const sli_sweep_tasks *)data;
    const sli_sweep_task *task = &t->tasks[t->order[item]];
    sli_sweep_tasks_backward(t, task->first, task->last,
                             t->scratch + (size_t)worker * sli_sweep_tasks_scratch(t));
}

/* The loops that move rows: item m has rows SLI_SOLVE_ROWS m .. */
static sl_int sli_sweep_tasks_end(const sli_sweep_tasks *t, sl_int item) {
    return sli_min(t->F->S->n - SLI_SOLVE_ROWS * item, SLI_SOLVE_ROWS) + SLI_SOLVE_ROWS * item;
}

static void sli_sweep_tasks_zero_item(void *data, sl_int item, sl_int worker) {
    const sli_sweep_tasks *t = (const sli_sweep_tasks *)data;
    const sl_int begin = SLI_SOLVE_ROWS * item, end = sli_sweep_tasks_end(t, item);
    (void)worker;
    SLI_ZERO(t->y + ((ptrdiff_t)begin << t->kind), (size_t)(end - begin) << t->kind);
}

static void sli_sweep_tasks_pack_item(void *data, sl_int item, sl_int worker) {
    const sli_sweep_tasks *t = (const sli_sweep_tasks *)data;
    (void)worker;
    sli_pack_part(t->F, t->q, t->y, &t->block, SLI_SOLVE_ROWS * item, sli_sweep_tasks_end(t, item));
}

static void sli_sweep_tasks_unpack_item(void *data, sl_int item, sl_int worker) {
    const sli_sweep_tasks *t = (const sli_sweep_tasks *)data;
    (void)worker;
    sli_unpack_part(t->F, t->q, &t->block, t->y, SLI_SOLVE_ROWS * item,
                    sli_sweep_tasks_end(t, item));
}

/* Solves for right-hand sides first .. first+count-1 by subtrees. */
static void sli_sweep_tasks_trees(sli_sweep_tasks *t, sli_team *team, sl_int first, sl_int count) {
    const sl_int items = (t->F->S->n - 1) / SLI_SOLVE_ROWS + 1;
    sl_int lanes;
    t->block = sli_rhs_part(&t->rhs, first, count);
    t->kind = sli_lanes_kind(count);
    lanes = (sl_int)1 << t->kind;
    if (count < lanes) {
        sli_team_loop(team, items, NULL, sli_sweep_tasks_zero_item, t);
    }
    sli_team_loop(team, items, NULL, sli_sweep_tasks_pack_item, t);
    sli_team_loop(team, t->n_tasks, NULL, sli_sweep_tasks_forward_item, t);
    sli_sweep_tasks_tops(t, t->scratch);
    sli_team_loop(team, t->n_tasks, NULL, sli_sweep_tasks_backward_item, t);
    sli_team_loop(team, items, NULL, sli_sweep_tasks_unpack_item, t);
    if (!sli_reach_is_finite(t->F, &t->q->backward, t->y, lanes)) {
        sli_atomic_write(&t->has_failed, 1);
    }
}

static void sli_sweep_tasks_lead(sli_team *team, void *data) {
    sli_sweep_tasks *t = (sli_sweep_tasks *)data;
    const sl_int nrhs = t->rhs.nrhs;
    sl_int r, count;
    if (t->share > 0) {
        sli_team_loop(team, (nrhs - 1) / t->share + 1, NULL, t->run_block, t);
        return;
    }
    for (r = 0; r < nrhs; r += count) {
        count = sli_block_size(nrhs - r, SLI_BLOCK_MOST);
        sli_sweep_tasks_trees(t, team, r, count);
    }
}

/* Runs a planned solve in memory of t->total bytes; run_block solves t->share right-hand sides. */
static void sli_sweep_tasks_run(sli_sweep_tasks *t, const sl_threads *threads, void *memory,
                                void (*run_block)(void *data, sl_int item, sl_int worker)) {
    sli_block b = {NULL, 0};
    t->memory = memory;
    t->run_block = run_block;
    t->has_failed = 0;
    if (t->share == 0) {
        b.base = (unsigned char *)memory;
        sli_sweep_tasks_layout(t, &b);
    }
    sli_team_run(threads, t->workers, sli_sweep_tasks_lead, t);
}

#endif
