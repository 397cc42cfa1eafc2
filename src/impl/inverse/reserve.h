/* reserve.h: bounds on the workspace of the inverse calls, for any rows */
#ifndef SLI_INVERSE_RESERVE_H
#define SLI_INVERSE_RESERVE_H

#include "block.h"
#include "entries.h"

/* Sizes of the analysis that bound every reach and every traversal. A reach is a union of paths to
 * the roots: it has at most the sum of their sizes, and at most all of L. */
typedef struct sli_reserve {
    const sl_symbolic *S;
    sl_int workers;
    sl_storage storage;            /* of the factor */
    uint64_t steps, columns, rows; /* of the longest path to a root, each maximized separately */
    sl_off stack;   /* doubles for the fronts of a traversal of everything by one worker */
    sl_off roots;   /* the most doubles of fronts that are pairwise not ancestors of each other */
    sl_off front;   /* doubles of the largest front */
    sl_off scratch; /* doubles of scratch per worker */
    /* arrays in the workspace, gone once it grows: n_supers each */
    sli_traversal all;
    uint64_t *path_steps, *path_columns, *path_rows; /* from each supernode to its root */
    sl_off *below; /* roots of the subtree, first without its own front */
} sli_reserve;

static void sli_reserve_layout(void *bounds, sli_block *b) {
    sli_reserve *r = (sli_reserve *)bounds;
    const sl_int count = r->S->n_supers;
    sli_traversal_layout(&r->all, b);
    r->path_steps = SLI_TAKE(b, uint64_t, count);
    r->path_columns = SLI_TAKE(b, uint64_t, count);
    r->path_rows = SLI_TAKE(b, uint64_t, count);
    r->below = SLI_TAKE(b, sl_off, count);
}

/* Paths, from the roots down. */
static void sli_reserve_measure_paths(sli_reserve *r) {
    const sl_symbolic *S = r->S;
    sl_int s;
    for (s = S->n_supers - 1; s >= 0; s--) {
        const sl_int up = S->super_parent[s];
        r->path_steps[s] = 1 + (up == -1 ? 0 : r->path_steps[up]);
        r->path_columns[s] = (uint64_t)S->steps[s].width + (up == -1 ? 0 : r->path_columns[up]);
        r->path_rows[s] = (uint64_t)S->steps[s].below + (up == -1 ? 0 : r->path_rows[up]);
        r->steps = r->path_steps[s] > r->steps ? r->path_steps[s] : r->steps;
        r->columns = r->path_columns[s] > r->columns ? r->path_columns[s] : r->columns;
        r->rows = r->path_rows[s] > r->rows ? r->path_rows[s] : r->rows;
    }
}

/* From the leaves up: in the subtree of a supernode, a set of fronts that are pairwise not
 * ancestors of each other has either its front or only fronts in the subtrees of its children. */
static void sli_reserve_measure_fronts(sli_reserve *r) {
    const sl_symbolic *S = r->S;
    sl_int s;
    sli_traversal_plan(&r->all, NULL, 0);
    r->stack = sli_traversal_fronts_size(&r->all);
    r->scratch = sli_traverse_scratch(&r->all, r->storage);
    for (s = 0; s < S->n_supers; s++) {
        r->below[s] = 0;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_off own = sli_traversal_front_size(&r->all, s);
        const sl_off most = own > r->below[s] ? own : r->below[s];
        r->front = own > r->front ? own : r->front;
        *(S->super_parent[s] == -1 ? &r->roots : &r->below[S->super_parent[s]]) += most;
    }
}

static void sli_reserve_measure(void *bounds) {
    sli_reserve *r = (sli_reserve *)bounds;
    r->steps = r->columns = r->rows = 0;
    r->roots = r->front = 0;
    sli_reserve_measure_paths(r);
    sli_reserve_measure_fronts(r);
}

/* Bounds for calls on F. They are computed in W. */
static sl_status sli_reserve_of(sli_reserve *r, const sl_factor *F, sl_work *W) {
    static const sli_stage stage = {sli_reserve_layout, sli_reserve_measure};
    memset(r, 0, sizeof *r);
    r->S = F->S;
    r->workers = sli_traversal_workers(F->S, &F->threads);
    r->storage = F->type->storage;
    r->all = sli_traversal_of(F->S, F->S->n_supers, 1);
    return sli_work_stages(W, &stage, 1, r);
}

/* min(count each, total) without overflow. */
SLI_INLINE uint64_t sli_reserve_product(uint64_t each, sl_int count, uint64_t total) {
    return each != 0 && (uint64_t)count > total / each ? total : each * (uint64_t)count;
}

/* A sweep of up to `lanes` vectors whose reach is that of up to `count` columns. */
static sli_capacity sli_reserve_sweep(const sli_reserve *r, sl_int count, sl_int lanes) {
    const sli_reach all = sli_reach_all(r->S);
    sli_capacity capacity = {0, 0, 0, 0};
    sl_int k;
    lanes = (sl_int)1 << sli_lanes_kind(lanes);
    for (k = 1; k <= lanes; k *= 2) { /* fewer lanes may need more scratch */
        sli_capacity_add(&capacity, &all, k);
    }
    capacity.steps = sli_reserve_product(r->steps, count, capacity.steps);
    capacity.rows = sli_reserve_product(r->rows, count, capacity.rows);
    capacity.values = sli_reserve_product(r->columns * (uint64_t)lanes, count, capacity.values);
    return capacity;
}

/* Doubles for the fronts of any traversal that answers up to count requests. Its stacks are no
 * larger than those of everything: while a front is computed, fewer of its ancestors have children
 * to come. With several workers there are the stack above the tasks, the roots of tasks, each of
 * which has a request in its subtree, and a stack for each worker. */
static uint64_t sli_reserve_fronts(const sli_reserve *r, sl_int count) {
    const uint64_t roots = sli_reserve_product((uint64_t)r->front, count, (uint64_t)r->roots);
    return r->workers == 1 ? (uint64_t)r->stack
                           : roots + (uint64_t)r->stack * ((uint64_t)r->workers + 1);
}

/* sl_inverse_diagonal and sl_inverse_pairs by sweeps. */
static size_t sli_reserve_forward_bytes(const sli_reserve *r, sl_int count) {
    const sl_int vectors = count > SLI_LANES_MAX / 2 ? SLI_LANES_MAX : 2 * count;
    const sli_capacity capacity = sli_reserve_sweep(r, vectors, vectors);
    sli_block b = {NULL, 0, 0};
    sli_requests requests;
    sli_forward forward;
    requests.count = count;
    sli_requests_layout(&requests, &b);
    sli_forward_layout(&forward, &b, &capacity);
    sli_forward_layout_run(&forward, &b, &capacity);
    return b.used;
}

/* The same by a traversal. */
static size_t sli_reserve_traversal_bytes(const sli_reserve *r, sl_int count) {
    const sl_symbolic *S = r->S;
    sli_traversal t = sli_traversal_of(S, S->n_supers, r->workers);
    sli_block b = {NULL, 0, 0};
    sli_requests requests;
    requests.count = count;
    t.is_partial = 1;
    sli_requests_layout(&requests, &b);
    sli_traversal_layout(&t, &b);
    (void)SLI_TAKE(&b, sl_int, S->n_supers); /* the forest's arrays of a shorter list */
    (void)SLI_TAKE(&b, sl_int, S->n_supers);
    sli_traversal_layout_work(&t, &b);
    (void)SLI_TAKE(&b, sl_int, (uint64_t)S->n_supers + 1); /* the first request of each front */
    (void)SLI_TAKE(&b, double, sli_reserve_fronts(r, count));
    (void)SLI_TAKE(&b, double, (uint64_t)r->workers *(uint64_t)r->scratch);
    return b.used;
}

/* sl_inverse_bilinear with up to count rows in both sets. */
static size_t sli_reserve_bilinear_bytes(const sli_reserve *r, sl_int count) {
    const sli_capacity capacity = sli_reserve_sweep(r, count, 2);
    sli_block b = {NULL, 0, 0};
    sli_forward forward;
    (void)SLI_TAKE(&b, uint64_t, count);
    (void)SLI_TAKE(&b, uint64_t, count);
    sli_forward_layout(&forward, &b, &capacity);
    sli_forward_layout_run(&forward, &b, &capacity);
    return b.used;
}

/* sl_inverse_block. */
static size_t sli_reserve_block_bytes(const sli_reserve *r, sl_int n_rows, sl_int n_columns) {
    sli_block b = {NULL, 0, 0};
    sli_inverse_block q;
    sl_int kept, streamed;
    memset(&q, 0, sizeof q);
    q.kept.count = q.kept.n_blocks = sli_min(n_rows, n_columns);
    q.streamed.count = sli_max(n_rows, n_columns);
    kept = sli_min(q.kept.count, SLI_LANES_MAX);
    streamed = sli_min(q.streamed.count, SLI_LANES_MAX);
    q.kept_capacity = sli_reserve_sweep(r, kept, kept);
    q.streamed_capacity = sli_reserve_sweep(r, streamed, streamed);
    sli_inverse_block_layout_requests(&q, &b);
    sli_inverse_block_layout_sweeps(&q, &b);
    return b.used;
}

SL_API sl_status sl_work_reserve_inverse(sl_work *W, const sl_factor *F, sl_int count) {
    sli_reserve r;
    sl_status status;
    if (W == NULL || F == NULL || count < 0) {
        return SL_ERR_ARGUMENT;
    }
    if (count == 0) {
        return SL_OK;
    }
    status = sli_reserve_of(&r, F, W);
    if (status == SL_OK) {
        const size_t forward = sli_reserve_forward_bytes(&r, count);
        const size_t traversal = sli_reserve_traversal_bytes(&r, count);
        const size_t bilinear = sli_reserve_bilinear_bytes(&r, count);
        const size_t most = forward > traversal ? forward : traversal;
        status = sli_work_grow(W, most > bilinear ? most : bilinear);
    }
    return status;
}

SL_API sl_status sl_work_reserve_block(sl_work *W, const sl_factor *F, sl_int n_rows,
                                       sl_int n_columns) {
    sli_reserve r;
    sl_status status;
    if (W == NULL || F == NULL || n_rows < 0 || n_columns < 0) {
        return SL_ERR_ARGUMENT;
    }
    if (n_rows == 0 || n_columns == 0) {
        return SL_OK;
    }
    status = sli_reserve_of(&r, F, W);
    return status == SL_OK ? sli_work_grow(W, sli_reserve_block_bytes(&r, n_rows, n_columns))
                           : status;
}

#endif
