/* entries.h: entries of A^-1: by forward sweeps or a top-down traversal, whichever is faster */
#ifndef SLI_INVERSE_ENTRIES_H
#define SLI_INVERSE_ENTRIES_H

#include "traversal_run.h"
#include "pair_sums.h"
#include "loss.h"

/* One call for entries. A traversal is possible if every entry is in the pattern of L: the front of
 * the entry's first column then has it. */
typedef struct sli_entries {
    const sl_factor *F;
    const sl_threads *threads;
    double *out;
    int is_all; /* the whole diagonal: there is no list of requests unless it is swept */
    sli_requests requests;
    sl_inverse_method method;
    /* SL_INVERSE_FORWARD */
    sli_capacity capacity;
    sli_forward forward; /* of all workers */
    sl_int workers;
    sl_stats *found; /* workers: what each has swept */
    /* SL_INVERSE_SELECTED */
    sli_traversal traversal;
    sli_traversal_run run;
    sl_int *first_request; /* supernodes + 1: the sorted requests that each front has */
    sli_loss loss;         /* with pivots of both signs */
    int is_lossy;          /* 1: a traversal would lose too much; sweeps take its place */
    sl_int *all;           /* count: all rows, if sweeps compute the whole diagonal */
} sli_entries;

/* The first column of the k-th request; the front of its supernode has the entry. */
SLI_INLINE sl_int sli_entries_column(const sli_entries *q, sl_int k) {
    return sli_min(sli_request_row(&q->requests, k), sli_request_column(&q->requests, k));
}

/* The local row of the k-th request in supernode s, that of its first column; -1 if the entry is
 * not in the pattern of L. */
SLI_INLINE sl_int sli_entries_row(const sli_entries *q, sl_int s, sl_int k) {
    const sl_int row =
        sli_max(sli_request_row(&q->requests, k), sli_request_column(&q->requests, k));
    return sli_front_row(q->F->S, s, row);
}

/* Sorts requests by their first column. */
static void sli_entries_sort(sli_entries *q) {
    sli_requests *r = &q->requests;
    sl_int k;
    for (k = 0; k < r->count; k++) {
        r->order[k] = sli_keyed(sli_entries_column(q, k), k);
    }
    sli_sort(r->order, r->count, r->block_size);
}

static int sli_entries_are_in_pattern(const sli_entries *q) {
    const sli_requests *r = &q->requests;
    sl_int k, is_in = 1;
    for (k = 0; k < r->count && is_in && r->rows != r->columns; k++) {
        is_in = sli_entries_row(q, q->F->S->super_of[sli_entries_column(q, k)], k) != -1;
    }
    return is_in;
}

/* The time of a traversal of the reach of sorted requests; *supers: its supernodes. */
static double sli_traversal_time(const sli_entries *q, sl_int *supers) {
    const sl_symbolic *S = q->F->S;
    const sli_requests *r = &q->requests;
    const double flop = sli_cost_flop(q->F->kernels);
    double time = 0.0;
    sl_int k = 0, s, next;
    *supers = 0;
    while (k < r->count) {
        s = S->super_of[sli_key(r->order[k])];
        next = sli_next_seed(S, r->order, r->count, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            const double h = S->steps[s].width + S->steps[s].below;
            /* no assembly: twice the flops of the factorization, in wider products; each entry is
             * read and written twice */
            time += SLI_COST_FRONT / 2.0 + 4.0 * h * h + 1.5 * flop * sli_front_flops(&S->steps[s]);
            ++*supers;
        }
    }
    return time;
}

/* What an entry of costs.h takes, in operations of a factorization. */
#define SLI_SWEEP_FLOPS 8.0

/* The workers for sweeps that take so long, in the unit of costs.h. */
static sl_int sli_entries_workers(const sli_entries *q, double time) {
    return sli_min(sli_workers_for(q->threads, SLI_SWEEP_FLOPS * time), q->requests.n_blocks);
}

/* Sorts requests and chooses the faster method. Counting the forward sweeps stops once they take
 * longer than the traversal. */
static void sli_entries_choose(void *call) {
    sli_entries *q = (sli_entries *)call;
    double limit = HUGE_VAL, time;
    sl_int supers = q->F->S->n_supers;
    SLI_CLEAR(q->capacity);
    q->is_lossy = 0;
    if (q->is_all) {
        q->method = SL_INVERSE_SELECTED;
    } else {
        if (q->requests.count > 1 && sli_entries_are_in_pattern(q)) {
            sli_entries_sort(q);
            limit = sli_traversal_time(q, &supers);
        }
        time = sli_requests_partition_within(&q->requests, &q->capacity, limit);
        q->method = time < limit ? SL_INVERSE_FORWARD : SL_INVERSE_SELECTED;
        q->workers = sli_entries_workers(q, time);
    }
    if (q->method == SL_INVERSE_SELECTED) {
        q->traversal =
            sli_traversal_of(q->F->S, supers, sli_traversal_workers(q->F->S, q->threads));
        q->traversal.is_partial = !q->is_all;
    }
}

static void sli_entries_layout_requests(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (!q->is_all) {
        sli_requests_layout(&q->requests, b);
    }
}

static void sli_entries_layout_method(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (q->method == SL_INVERSE_SELECTED) {
        sli_traversal_layout(&q->traversal, b);
        sli_traversal_layout_work(&q->traversal, b);
        q->first_request =
            SLI_TAKE(b, sl_int, q->is_all ? 0 : (uint64_t)q->traversal.forest.count + 1);
    }
}

/* Plans the traversal and lists the requests of each of its fronts. */
static void sli_entries_plan(void *call) {
    sli_entries *q = (sli_entries *)call;
    const sli_requests *r = &q->requests;
    const int is_all = q->is_all;
    sl_int k = 0, index;
    if (q->method != SL_INVERSE_SELECTED) {
        return;
    }
    if (!is_all) {
        sli_entries_sort(q);
    }
    sli_traversal_plan(&q->traversal, is_all ? NULL : r->order, r->count);
    for (index = 0; index < q->traversal.forest.count && !is_all; index++) {
        const sl_int end = q->F->S->super_first[q->traversal.supers[index] + 1];
        q->first_request[index] = k;
        while (k < r->count && sli_key(r->order[k]) < end) {
            k++;
        }
    }
    if (!is_all) {
        q->first_request[index] = k;
    }
}

static void sli_entries_layout_loss(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (q->method == SL_INVERSE_SELECTED) {
        sli_loss_layout_traversal(&q->loss, b, q->F, &q->traversal);
    }
}

/* Would the traversal lose too much? */
static void sli_entries_judge(void *call) {
    sli_entries *q = (sli_entries *)call;
    q->is_lossy = q->method == SL_INVERSE_SELECTED && !sli_loss_is_small(&q->loss);
}

/* Sweeps of the whole diagonal need a list of all rows. */
static void sli_entries_layout_sweeps(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (q->is_lossy && q->is_all) {
        q->all = SLI_TAKE(b, sl_int, q->requests.count);
        sli_requests_layout(&q->requests, b);
    }
}

static void sli_entries_partition(void *call) {
    sli_entries *q = (sli_entries *)call;
    sl_int k;
    if (!q->is_lossy) {
        return;
    }
    for (k = 0; k < q->requests.count && q->is_all; k++) {
        q->all[k] = k;
    }
    if (q->is_all) {
        q->requests.rows = q->requests.columns = q->all;
    }
    q->method = SL_INVERSE_FORWARD;
    q->workers =
        sli_entries_workers(q, sli_requests_partition_within(&q->requests, &q->capacity, HUGE_VAL));
}

static void sli_entries_layout_run(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (q->method == SL_INVERSE_SELECTED) {
        sli_traversal_layout_run(&q->run, &q->traversal, q->F->type->storage, b);
    } else {
        sli_forward_layout_workers(&q->forward, b, &q->capacity, q->workers);
        q->found = SLI_TAKE(b, sl_stats, q->workers);
    }
}

/* Writes the requested entries that row tiles t0 .. t1-1 of a front have. */
static void sli_entries_visit(void *call, sl_int index, const sli_inverse_front *f, sl_int t0,
                              sl_int t1) {
    const sli_entries *q = (const sli_entries *)call;
    const sl_symbolic *S = q->F->S;
    const sl_int s = q->traversal.supers[index], first = S->super_first[s], h = f->width + f->below;
    sl_int k, j;
    if (q->is_all) {
        const sl_int *row = S->perm + first, last = sli_min(SLI_TILE * t1, f->width);
        for (j = SLI_TILE * t0; j < last; j++) {
            q->out[row[j]] = f->front[sli_square_offset(h, j / SLI_TILE) + SLI_TILE * (ptrdiff_t)j +
                                      j % SLI_TILE];
        }
        return;
    }
    for (k = q->first_request[index]; k < q->first_request[index + 1]; k++) {
        const sl_int request = sli_value(q->requests.order[k]);
        const sl_int r = sli_entries_row(q, s, request), t = r / SLI_TILE;
        if (t >= t0 && t < t1) {
            j = sli_key(q->requests.order[k]) - first;
            q->out[request] =
                f->front[sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j + r % SLI_TILE];
        }
    }
}

/* Writes the entries of the sorted requests k .. k+block_size-1, which are one block. */
static void sli_entries_write(const sli_entries *q, const sli_forward *f,
                              const sli_rhs_block *block, sl_int k, sl_int block_size) {
    sl_int first[SLI_BLOCK_REQUESTS_MAX], second[SLI_BLOCK_REQUESTS_MAX], m;
    double sums[SLI_BLOCK_REQUESTS_MAX];
    for (m = 0; m < block_size; m++) {
        const sl_int index = sli_value(q->requests.order[k + m]);
        first[m] = sli_rhs_block_lane(block, sli_request_row(&q->requests, index));
        second[m] = sli_rhs_block_lane(block, sli_request_column(&q->requests, index));
    }
    sli_pair_sums(q->F, f, block_size, first, second, sums);
    for (m = 0; m < block_size; m++) {
        q->out[sli_value(q->requests.order[k + m])] = sums[m];
    }
}

/* Sweeps and sums every workers-th block. */
static void sli_entries_forward_worker(void *data, sl_int worker) {
    const sli_entries *q = (const sli_entries *)data;
    sli_forward f = sli_forward_of_worker(&q->forward, &q->capacity, worker);
    sl_stats *found = &q->found[worker];
    sl_int k = 0, m, block_size;
    sli_inverse_clear_stats(found);
    for (m = 0; m < q->requests.n_blocks; m++, k += block_size) {
        block_size = (sl_int)q->requests.block_size[m];
        if (m % q->workers == worker) {
            sli_rhs_block block;
            sli_rhs_block_rebuild(&q->requests, k, block_size, &block);
            sli_forward_unit_vectors(&f, q->F, &block, found);
            sli_entries_write(q, &f, &block, k, block_size);
        }
    }
}

static void sli_entries_forward(sli_entries *q, sl_stats *stats) {
    sl_int w;
    sli_parallel(q->threads, q->workers, sli_entries_forward_worker, q);
    for (w = 0; w < q->workers && stats != NULL; w++) {
        const sl_inverse_info *found = &q->found[w].inverse;
        stats->inverse.method = SL_INVERSE_FORWARD;
        stats->inverse.supernodes = sli_max(stats->inverse.supernodes, found->supernodes);
        stats->inverse.columns = sli_max(stats->inverse.columns, found->columns);
        stats->inverse.entries += found->entries;
    }
}

/* Entries in rows or columns of null pivots are 0. The traversal has divided by SLI_NULL_PIVOT. */
static void sli_entries_clear_nulls(const sli_entries *q) {
    const sl_factor *F = q->F;
    const sl_int *iperm = F->S->iperm;
    const sli_requests *r = &q->requests;
    sl_int k;
    for (k = 0; k < F->null.count && q->is_all; k++) {
        q->out[F->S->perm[F->null.pivots[k]]] = 0.0;
    }
    for (k = 0; k < r->count && F->null.count > 0 && !q->is_all; k++) {
        if (sli_is_skipped(F, iperm[r->rows[k]]) || sli_is_skipped(F, iperm[r->columns[k]])) {
            q->out[k] = 0.0;
        }
    }
}

/* A call for count entries; rows NULL: the whole diagonal. */
static sli_entries sli_entries_of(const sl_factor *F, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count) {
    sli_entries q;
    SLI_CLEAR(q);
    q.F = F;
    q.threads = &F->threads;
    q.out = out;
    q.is_all = rows == NULL;
    q.requests = sli_requests_of(F, rows, columns, count);
    return q;
}

static const sli_stage sli_entries_stages[3] = {{sli_entries_layout_requests, sli_entries_choose},
                                                {sli_entries_layout_method, sli_entries_plan},
                                                {sli_entries_layout_run, NULL}};
/* With pivots of both signs. */
static const sli_stage sli_entries_judged_stages[5] = {
    {sli_entries_layout_requests, sli_entries_choose},
    {sli_entries_layout_method, sli_entries_plan},
    {sli_entries_layout_loss, sli_entries_judge},
    {sli_entries_layout_sweeps, sli_entries_partition},
    {sli_entries_layout_run, NULL}};

SLI_NOINLINE static sl_status sli_entries_run(sli_entries *q, sl_work *W, sl_stats *stats) {
    const sl_status status = sli_has_both_signs(q->F)
                                 ? sli_work_stages(W, sli_entries_judged_stages, 5, q)
                                 : sli_work_stages(W, sli_entries_stages, 3, q);
    if (status != SL_OK) {
        return status;
    }
    if (q->method == SL_INVERSE_FORWARD) {
        sli_entries_forward(q, stats);
    } else {
        q->run.F = q->F;
        q->run.traversal = &q->traversal;
        q->run.threads = q->threads;
        q->run.visit = sli_entries_visit;
        q->run.context = q;
        sli_traverse(&q->run);
        sli_entries_clear_nulls(q);
    }
    if (stats != NULL && q->method == SL_INVERSE_SELECTED) {
        stats->inverse.method = SL_INVERSE_SELECTED;
        stats->inverse.supernodes = q->traversal.forest.count;
        stats->inverse.columns = sli_traversal_count_columns(&q->traversal);
    }
    return SL_OK;
}

#endif
