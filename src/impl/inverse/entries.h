/* inverse_entries.h: entries of A^-1 one by one: by forward sweeps, or by a descent that keeps nothing else */
#ifndef SLI_INVERSE_ENTRIES_H
#define SLI_INVERSE_ENTRIES_H

#include "descent_run.h"
#include "inverse.h"

/* One call. The descent comes in question where every entry has a place in the pattern of L: it is met in the front of
 * its first column. */
typedef struct sli_entries {
    const sl_factor *F;
    const sl_threads *threads; /* of a descent */
    double *out;
    sli_requests requests;
    sl_inverse_method method;
    /* forward */
    sli_room room;
    sli_forward forward;
    /* descent */
    sli_descent descent;
    sli_descending run;
    sl_int *asked; /* supernodes + 1: the first of the sorted requests that each front answers */
} sli_entries;

/* Time of a front of the inverse in that of a forward sweep of one lane over one entry, as the costs of lanes are: of
 * itself, for each of the h^2 numbers that are moved, for each flop of the factorization's front, which is twice as
 * many here. Measured on grids of 1e4 to 1e6 vertices and of 25^3 (Zen 5); NEON, which was not, as AVX2. */
static const double sli_descent_cost[][3] = {{2000.0, 4.0, 0.35}, /* of any other */
                                             {2000.0, 4.0, 2.2},  /* plain C */
                                             {2000.0, 4.0, 0.35}, /* AVX2 */
                                             {2000.0, 4.0, 0.2}}; /* AVX-512 */

/* The whole diagonal needs no list of requests. */
SLI_INLINE int sli_entries_is_all(const sli_entries *q) {
    return q->requests.rows == NULL;
}

/* The first column of the k-th request: the front that has its entry is that column's. */
SLI_INLINE sl_int sli_entries_column(const sli_entries *q, sl_int k) {
    return sli_min(sli_request_row(&q->requests, k), sli_request_column(&q->requests, k));
}

/* Where the k-th request stands in supernode s, that of its first column, or -1: no place in the pattern. */
SLI_INLINE sl_int sli_entries_row(const sli_entries *q, sl_int s, sl_int k) {
    const sl_int row =
        sli_max(sli_request_row(&q->requests, k), sli_request_column(&q->requests, k));
    return sli_descent_row(q->F->S, s, row);
}

static void sli_entries_sort(sli_entries *q) {
    sli_requests *r = &q->requests;
    sl_int k;
    for (k = 0; k < r->count; k++) {
        r->order[k] = sli_keyed(sli_entries_column(q, k), k);
    }
    sli_sort(r->order, r->count, r->taken);
}

static int sli_entries_are_in_pattern(const sli_entries *q) {
    const sli_requests *r = &q->requests;
    sl_int k, is_in = 1;
    for (k = 0; k < r->count && is_in && r->rows != r->columns; k++) {
        is_in = sli_entries_row(q, q->F->S->super_of[sli_entries_column(q, k)], k) != -1;
    }
    return is_in;
}

/* Time of a descent of the reach of sorted requests, and its supernodes. */
static double sli_descent_time(const sli_entries *q, sl_int *supers) {
    const sl_symbolic *S = q->F->S;
    const sli_requests *r = &q->requests;
    const double *cost = sli_descent_cost[sli_isa_row(q->F->kernels->isa)];
    double time = 0.0;
    sl_int k = 0, s, next;
    *supers = 0;
    while (k < r->count) {
        s = S->super_of[sli_key(r->order[k])];
        next = sli_next_seed(S, r->order, r->count, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            const double h = S->steps[s].width + S->steps[s].below;
            time += cost[0] + cost[1] * h * h + cost[2] * sli_front_flops(&S->steps[s]);
            ++*supers;
        }
    }
    return time;
}

/* Sorts requests, and finds which way is the shorter one: the count of forward sweeps ends where it has passed the
 * descent. */
static void sli_entries_choose(void *call) {
    sli_entries *q = (sli_entries *)call;
    double descent = HUGE_VAL;
    sl_int supers = q->F->S->n_supers;
    memset(&q->room, 0, sizeof q->room);
    if (sli_entries_is_all(q)) {
        q->method = SL_INVERSE_SELECTED;
    } else {
        if (q->requests.count > 1 && sli_entries_are_in_pattern(q)) {
            sli_entries_sort(q);
            descent = sli_descent_time(q, &supers);
        }
        q->method = sli_requests_group_within(&q->requests, &q->room, descent) < descent
                        ? SL_INVERSE_FORWARD
                        : SL_INVERSE_SELECTED;
    }
    if (q->method == SL_INVERSE_SELECTED) {
        q->descent = sli_descent_of(q->F->S, supers, sli_workers(q->threads));
        q->descent.is_partial = !sli_entries_is_all(q);
    }
}

static void sli_entries_lay_requests(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (!sli_entries_is_all(q)) {
        sli_requests_layout(&q->requests, b);
    }
}

static void sli_entries_lay_way(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (q->method == SL_INVERSE_FORWARD) {
        sli_forward_layout(&q->forward, b, &q->room);
        sli_forward_layout_run(&q->forward, b, &q->room);
    } else {
        sli_descent_layout(&q->descent, b);
        sli_descent_layout_planning(&q->descent, b);
        q->asked =
            SLI_TAKE(b, sl_int, sli_entries_is_all(q) ? 0 : (uint64_t)q->descent.forest.count + 1);
    }
}

/* The list of the descent, and the requests of each of its supernodes. */
static void sli_entries_plan(void *call) {
    sli_entries *q = (sli_entries *)call;
    const sli_requests *r = &q->requests;
    const int is_all = sli_entries_is_all(q);
    sl_int k = 0, at;
    if (q->method != SL_INVERSE_SELECTED) {
        return;
    }
    if (!is_all) {
        sli_entries_sort(q);
    }
    sli_descent_plan(&q->descent, is_all ? NULL : r->order, r->count);
    for (at = 0; at < q->descent.forest.count && !is_all; at++) {
        const sl_int end = q->F->S->super_first[q->descent.supers[at] + 1];
        q->asked[at] = k;
        while (k < r->count && sli_key(r->order[k]) < end) {
            k++;
        }
    }
    if (!is_all) {
        q->asked[at] = k;
    }
}

static void sli_entries_lay_run(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (q->method == SL_INVERSE_SELECTED) {
        sli_descent_layout_run(&q->run, &q->descent, b);
    }
}

/* What row tiles t0 .. t1-1 of a front answer. */
static void sli_entries_take(void *call, sl_int at, const sli_dual *f, sl_int t0, sl_int t1) {
    const sli_entries *q = (const sli_entries *)call;
    const sl_symbolic *S = q->F->S;
    const sl_int s = q->descent.supers[at], first = S->super_first[s], h = f->width + f->below;
    sl_int k, j;
    if (sli_entries_is_all(q)) {
        const sl_int *row = S->perm + first, last = sli_min(SLI_TILE * t1, f->width);
        for (j = SLI_TILE * t0; j < last; j++) {
            q->out[row[j]] = f->front[sli_square_offset(h, j / SLI_TILE) + SLI_TILE * (ptrdiff_t)j +
                                      j % SLI_TILE];
        }
        return;
    }
    for (k = q->asked[at]; k < q->asked[at + 1]; k++) {
        const sl_int request = sli_value(q->requests.order[k]);
        const sl_int r = sli_entries_row(q, s, request), t = r / SLI_TILE;
        if (t >= t0 && t < t1) {
            j = sli_key(q->requests.order[k]) - first;
            q->out[request] =
                f->front[sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j + r % SLI_TILE];
        }
    }
}

/* The sums that the sorted requests k .. k+taken-1, one group, ask for. */
static void sli_entries_answer(const sli_entries *q, const sli_group *g, sl_int k, sl_int taken) {
    sl_int first[SLI_REQUESTS_MAX], second[SLI_REQUESTS_MAX], m;
    double sums[SLI_REQUESTS_MAX];
    for (m = 0; m < taken; m++) {
        const sl_int at = sli_value(q->requests.order[k + m]);
        first[m] = sli_group_lane(g, sli_request_row(&q->requests, at));
        second[m] = sli_group_lane(g, sli_request_column(&q->requests, at));
    }
    sli_pair_sums(q->F, &q->forward, taken, first, second, sums);
    for (m = 0; m < taken; m++) {
        q->out[sli_value(q->requests.order[k + m])] = sums[m];
    }
}

/* Group after group. */
static void sli_entries_forward(sli_entries *q, sl_stats *stats) {
    sl_int k = 0, m;
    for (m = 0; m < q->requests.n_groups; m++) {
        const sl_int taken = (sl_int)q->requests.taken[m];
        sli_group g;
        sli_group_again(&q->requests, k, taken, &g);
        sli_forward_group(&q->forward, q->F, &g, stats);
        sli_entries_answer(q, &g, k, taken);
        k += taken;
    }
}

/* A call for count entries, rows NULL for the whole diagonal. */
static sli_entries sli_entries_of(const sl_factor *F, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count) {
    sli_entries q;
    memset(&q, 0, sizeof q);
    q.F = F;
    q.threads = &F->threads;
    q.out = out;
    q.requests = sli_requests_of(F, rows, columns, count);
    return q;
}

static const sli_stage sli_entries_stages[3] = {{sli_entries_lay_requests, sli_entries_choose},
                                                {sli_entries_lay_way, sli_entries_plan},
                                                {sli_entries_lay_run, NULL}};

/* Chooses the way and lays everything out; W may grow, nothing else is written. */
static sl_status sli_entries_prepare(sli_entries *q, sl_work *W) {
    return sli_work_stages(W, sli_entries_stages, 3, q);
}

static sl_status sli_entries_run(sli_entries *q, sl_work *W, sl_stats *stats) {
    const sl_status status = sli_entries_prepare(q, W);
    if (status != SL_OK) {
        return status;
    }
    if (q->method == SL_INVERSE_FORWARD) {
        sli_entries_forward(q, stats);
    } else {
        q->run.F = q->F;
        q->run.d = &q->descent;
        q->run.threads = q->threads;
        q->run.take = sli_entries_take;
        q->run.to = q;
        sli_descend(&q->run);
    }
    if (stats != NULL) {
        stats->inverse_method = q->method;
        if (q->method == SL_INVERSE_SELECTED) {
            sli_descent_stats(&q->descent, stats);
            stats->z_entries = 0;
        }
    }
    return SL_OK;
}

static sl_status sli_inverse_entries(const sl_factor *F, double *out, const sl_int *rows,
                                     const sl_int *columns, sl_int count, sl_work *W,
                                     sl_stats *stats) {
    sl_work own;
    sli_entries q;
    sl_status status;
    if (count < 0 || (count > 0 && out == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_check_rows(F->S, rows, count, 0, stats);
    status = status == SL_OK ? sli_check_rows(F->S, columns, count, 1, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_inverse_stats(stats);
    q = sli_entries_of(F, out, rows, columns, count);
    own = sli_work_own(&F->allocator);
    status = count > 0 ? sli_entries_run(&q, W == NULL ? &own : W, stats) : SL_OK;
    sli_free(&own.allocator, own.block);
    return status;
}

SL_API sl_status sl_inverse_diagonal(const sl_factor *F, double *out, const sl_int *rows,
                                     sl_int count, sl_work *W, sl_stats *stats) {
    sli_stats_clear_error(stats);
    return F == NULL
               ? SL_ERR_ARGUMENT
               : sli_inverse_entries(F, out, rows, rows, rows == NULL ? F->S->n : count, W, stats);
}

SL_API sl_status sl_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count, sl_work *W,
                                  sl_stats *stats) {
    sli_stats_clear_error(stats);
    return F == NULL || (count > 0 && (rows == NULL || columns == NULL))
               ? SL_ERR_ARGUMENT
               : sli_inverse_entries(F, out, rows, columns, count, W, stats);
}

#endif
