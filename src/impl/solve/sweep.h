/* sweep.h: full solves, and the sweeps of any query, in blocks of right-hand sides */
#ifndef SLI_SOLVE_SWEEP_H
#define SLI_SOLVE_SWEEP_H

#include "backward.h"
#include "query.h"
#include "singular.h"
#include "sweep_tasks.h"

/* Copies y to the backward vector in the columns that are in both reaches; the rest of that vector
 * is 0. */
static void sli_sweep_transfer(const sli_query *q, const double *y, double *x, sl_int lanes) {
    sli_intersection m = sli_intersection_of(&q->forward, &q->backward);
    memset(x, 0, (size_t)q->backward.columns * (size_t)lanes * sizeof(double));
    while (sli_intersection_next(&m)) {
        memcpy(x + (ptrdiff_t)m.in_b * lanes, y + (ptrdiff_t)m.in_a * lanes,
               (size_t)m.count * (size_t)lanes * sizeof(double));
    }
}

/* y := L^-1 y in the forward vector, and y(k) := z' b at known null vectors z, tree by tree. Where
 * components have several of them, their y(k) has no meaning. */
static void sli_sweep_forward(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                              sl_int nrhs) {
    const int kind = sli_lanes_kind(nrhs);
    const sli_reach *R = &q->forward;
    const sl_int *rows = R->rows;
    sl_int first = 0, s;
    if (F->null.count == 0 || F->null.vectors > 1) {
        sli_forward_sweep(F, kind, R->count, R->steps, rows, v->y, v->scratch);
        return;
    }
    for (s = 0; s < R->count; s++) {
        sli_null_dot dot;
        sl_int m, at = -1;
        if (R->steps[s].up != -1) {
            continue;
        }
        m = sli_null_first(F, R, s);
        if (sli_null_dot_next(F, R, first, s, v->y, (sl_int)1 << kind, &m, &dot)) {
            at = sli_reach_index_of(R, dot.null);
        }
        sli_forward_sweep(F, kind, s + 1 - first, R->steps + first, rows, v->y, v->scratch);
        if (at != -1) {
            memcpy(v->y + ((ptrdiff_t)at << kind), dot.sums, sizeof(double) << kind);
        }
        for (; first <= s; first++) {
            rows += R->steps[first].below;
        }
    }
}

/* y := L^-1 P b for a block of right-hand sides. Returns 0 if F checks consistency and one is
 * inconsistent. */
static int sli_sweep_load(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                          const double *B, sli_dense at, sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
    double norms[SLI_TILE];
    sli_pack(q, F->kernels, v->y, B, at, lanes, nrhs);
    if (F->null.checks) {
        sli_norms(&q->forward, v->y, lanes, norms);
        if (F->null.vectors > 1 && (q->ending == NULL || q->ending->rows == 0) &&
            !sli_null_dots(F, &q->forward, v->y, lanes, norms, NULL, 0, lanes)) {
            return 0;
        }
    }
    sli_sweep_forward(F, q, v, nrhs);
    return !F->null.checks || sli_is_consistent(F, &q->forward, v->y, lanes, norms);
}

/* P x := L'^-1 D^-1 y in the backward vector. */
static void sli_sweep_backward(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                               sl_int nrhs) {
    const int kind = sli_lanes_kind(nrhs);
    const sl_int lanes = (sl_int)1 << kind;
    if (!q->is_shared) {
        sli_sweep_transfer(q, v->y, v->x, lanes);
    }
    if (q->ending != NULL) {
        q->ending->calls->apply(F, q, kind, v);
    }
    if (F->null.is_centered || F->null.vectors > 1) {
        sli_center(F, &q->forward, v->y, &q->backward, v->x, lanes, NULL);
    }
    sli_backward(F, &q->backward, kind, v->x, v->scratch);
}

/* Checks that A x = b has a solution for every right-hand side. Writes only to `memory`. */
static sl_status sli_sweep_check(const sl_factor *F, const sli_query *q, const double *B,
                                 sli_dense b_at, sl_int nrhs, void *memory) {
    sl_int r;
    for (r = 0; r < nrhs; r += sli_min(8, nrhs - r)) {
        const sl_int block = sli_min(8, nrhs - r);
        const sli_vectors v = sli_vectors_of(q, block, memory);
        if (!sli_sweep_load(F, q, &v, B + (size_t)r * b_at.column, b_at, block)) {
            return SL_ERR_INCONSISTENT;
        }
    }
    return SL_OK;
}

/* Solves A x = b on the rows of a query, in blocks: y = L^-1 P b, z = D^-1 y, P x = L'^-1 z. F is
 * valid and memory is large enough. Stops at the first block that is inconsistent. */
static sl_status sli_sweep_blocks(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                                  const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
    sl_int r, block;
    for (r = 0; r < nrhs; r += block) {
        sli_vectors v;
        block = sli_block_size(nrhs - r, sli_block_most(F));
        v = sli_vectors_of(q, block, memory);
        if (!sli_sweep_load(F, q, &v, B + (size_t)r * b_at.column, b_at, block)) {
            return SL_ERR_INCONSISTENT;
        }
        sli_sweep_backward(F, q, &v, block);
        sli_unpack(q, F->kernels, X + (size_t)r * x_at.column, x_at, v.x,
                   (sl_int)1 << sli_lanes_kind(block), block);
    }
    return SL_OK;
}

/* Like sli_sweep_blocks, but writes nothing to X unless all blocks are consistent. */
static sl_status sli_sweep(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                           const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
    sl_status status = SL_OK;
    if (F->null.checks && nrhs > 8 && q->nb > 0) {
        status = sli_sweep_check(F, q, B + 8 * b_at.column, b_at, nrhs - 8, memory);
    }
    return status == SL_OK ? sli_sweep_blocks(F, q, X, x_at, B, b_at, nrhs, memory) : status;
}

/* Item m of a solve by several workers: t->share right-hand sides. */
static void sli_sweep_tasks_block(void *data, sl_int m, sl_int worker) {
    const sli_sweep_tasks *t = (const sli_sweep_tasks *)data;
    const sl_int first = m * t->share, count = sli_min(t->share, t->nrhs - first);
    (void)sli_sweep_blocks(t->F, t->q, t->X + (size_t)first * t->x_at.column, t->x_at,
                           t->B + (size_t)first * t->b_at.column, t->b_at, count,
                           (unsigned char *)t->memory + (size_t)worker * t->bytes);
}

/* Solves a query in the caller's workspace, or in one of its own. */
static sl_status sli_query_solve(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                                 const double *B, sli_dense b_at, sl_int nrhs, sl_work *W) {
    sl_work own;
    sl_status status;
    sli_sweep_tasks t;
    if (nrhs == 0 || q->nx == 0) {
        return SL_OK;
    }
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    sli_sweep_tasks_plan(&t, F, q, nrhs, &W->threads);
    status =
        sli_work_grow(W, t.workers > 1 ? t.total : sli_vectors_bytes(q, nrhs, sli_block_most(F)));
    if (status == SL_OK && t.workers > 1) {
        t.X = X;
        t.x_at = x_at;
        t.B = B;
        t.b_at = b_at;
        sli_sweep_tasks_run(&t, &W->threads, W->block, sli_sweep_tasks_block);
    } else if (status == SL_OK) {
        status = sli_sweep(F, q, X, x_at, B, b_at, nrhs, W->block);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* Checks the arguments, then solves a query. */
static sl_status sli_solve(const sl_factor *F, const sli_query *q, double *X, size_t ldx,
                           const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
    const sl_status status = sli_check_dense(X, ldx, q->nx, B, ldb, q->nb, nrhs);
    if (status != SL_OK) {
        return status;
    }
    if (!sli_query_fits(q, F)) {
        return SL_ERR_STATE;
    }
    return sli_query_solve(F, q, X, sli_dense_of(ldx), B, sli_dense_of(ldb), nrhs, W);
}

SL_API sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx, const double *B,
                                 size_t ldb, sl_int nrhs, sl_work *W) {
    sli_query q;
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    q = sli_query_all(F->S);
    return sli_solve(F, &q, X, ldx, B, ldb, nrhs, W);
}

#endif
