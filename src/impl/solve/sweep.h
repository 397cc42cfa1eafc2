/* sweep.h: full solves, and the sweeps of any query, in blocks of right-hand sides */
#ifndef SLI_SOLVE_SWEEP_H
#define SLI_SOLVE_SWEEP_H

#include "backward.h"
#include "packed.h"
#include "sweep_tasks.h"

/* Copies y to the backward vector in the columns that are in both reaches; the rest of that vector
 * is 0. */
static void sli_sweep_transfer(const sli_query *q, const double *y, double *x, sl_int lanes) {
    sli_intersection m = sli_intersection_of(&q->forward, &q->backward);
    SLI_ZERO(x, (size_t)q->backward.columns * (size_t)lanes);
    while (sli_intersection_next(&m)) {
        SLI_COPY(x + (ptrdiff_t)m.in_b * lanes, y + (ptrdiff_t)m.in_a * lanes,
                 (size_t)m.count * (size_t)lanes);
    }
}

/* y := L^-1 y in the forward vector, and y(k) := z' b at known null vectors z, tree by tree. Where
 * components have several of them, their y(k) has no meaning. */
SLI_NOINLINE static void sli_sweep_forward(const sl_factor *F, const sli_query *q,
                                           const sli_vectors *v, sl_int nrhs) {
    if (F->null.count > 0) {
        F->null.calls->forward(F, &q->forward, v, nrhs);
    } else {
        sli_forward_sweep(F, sli_lanes_kind(nrhs), &q->forward, v->y, v->scratch);
    }
}

/* y := L^-1 P b for a block of right-hand sides. Returns 0 if F checks consistency and one is
 * inconsistent. */
static int sli_sweep_load(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                          const sli_rhs *rhs) {
    if (F->null.count > 0) {
        return F->null.calls->load(F, q, v, rhs);
    }
    sli_pack(F, q, v->y, rhs);
    sli_forward_sweep(F, sli_lanes_kind(rhs->nrhs), &q->forward, v->y, v->scratch);
    return 1;
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
    if (F->null.count > 0) {
        F->null.calls->center(F, q, v, lanes, NULL);
    }
    sli_backward(F, &q->backward, kind, v->x, v->scratch);
}

/* Refuses a solution that is not finite: names the number of b, if b is still there. */
SLI_COLD static sl_status sli_not_finite(const sli_rhs *rhs, sl_int nb) {
    const sl_status status = sli_dense_finite("this number of B is not finite", rhs->B, rhs->ldb,
                                              rhs->B == rhs->X ? 0 : nb, rhs->nrhs);
    return status != SL_OK
               ? status
               : sli_refuse(SL_ERR_NOT_FINITE, "a right-hand side is not finite, or x overflows");
}

SLI_COLD static sl_status sli_inconsistent(void) {
    return sli_refuse(SL_ERR_INCONSISTENT,
                      "b has a part along a null vector of A, so that no x solves it; with "
                      "options.mass solves leave that part out");
}

/* Checks that A x = b has a solution for every right-hand side. Writes only to `memory`. */
static sl_status sli_sweep_check(const sl_factor *F, const sli_query *q, const sli_rhs *rhs,
                                 void *memory) {
    return F->null.checks && !F->null.calls->check(F, q, rhs, memory) ? sli_inconsistent() : SL_OK;
}

/* Is the solution in the backward vector finite, at the roots or at the boundary of an ending? */
static int sli_sweep_is_finite(const sl_factor *F, const sli_query *q, const double *x,
                               sl_int lanes) {
    const ptrdiff_t rows = q->ending == NULL ? 0 : q->ending->rows;
    return sli_reach_is_finite(F, &q->backward, x, lanes) &&
           sli_are_finite(x + (q->backward.columns - rows) * lanes, rows * lanes);
}

/* Solves A x = b on the rows of a query, in blocks: y = L^-1 P b, z = D^-1 y, P x = L'^-1 z. F is
 * valid and memory is large enough. Stops at the first block that is inconsistent, but not where a
 * solution is not finite. */
static sl_status sli_sweep_blocks(const sl_factor *F, const sli_query *q, const sli_rhs *rhs,
                                  void *memory) {
    sl_int r, count, is_finite = 1;
    for (r = 0; r < rhs->nrhs; r += count) {
        sli_rhs block;
        sli_vectors v;
        count = sli_block_size(rhs->nrhs - r, sli_block_most(F));
        block = sli_rhs_part(rhs, r, count);
        v = sli_vectors_of(q, count, memory);
        if (!sli_sweep_load(F, q, &v, &block)) {
            return sli_inconsistent();
        }
        sli_sweep_backward(F, q, &v, count);
        sli_unpack(F, q, &block, v.x);
        is_finite &= sli_sweep_is_finite(F, q, v.x, (sl_int)1 << sli_lanes_kind(count));
    }
    return is_finite ? SL_OK : sli_not_finite(rhs, q->nb);
}

/* Like sli_sweep_blocks, but writes nothing to X unless all blocks are consistent. */
static sl_status sli_sweep(const sl_factor *F, const sli_query *q, const sli_rhs *rhs,
                           void *memory) {
    sl_status status = SL_OK;
    if (F->null.checks && rhs->nrhs > 8 && q->nb > 0) {
        const sli_rhs later = sli_rhs_part(rhs, 8, rhs->nrhs - 8);
        status = sli_sweep_check(F, q, &later, memory);
    }
    return status == SL_OK ? sli_sweep_blocks(F, q, rhs, memory) : status;
}

/* Item m of a solve by several workers: t->share right-hand sides. */
static void sli_sweep_tasks_block(void *data, sl_int m, sl_int worker) {
    sli_sweep_tasks *t = (sli_sweep_tasks *)data;
    const sl_int first = m * t->share;
    const sli_rhs part = sli_rhs_part(&t->rhs, first, sli_min(t->share, t->rhs.nrhs - first));
    if (sli_sweep_blocks(t->F, t->q, &part,
                         (unsigned char *)t->memory + (size_t)worker * t->bytes) != SL_OK) {
        sli_atomic_write(&t->has_failed, 1);
    }
}

/* Plans how to solve a query, and grows W for it. */
static sl_status sli_query_prepare(sli_sweep_tasks *t, const sl_factor *F, const sli_query *q,
                                   const sli_rhs *rhs, sl_work *W) {
    sli_sweep_tasks_plan(t, F, q, rhs, &W->threads);
    return sli_work_grow(W, t->workers > 1 ? t->total
                                           : sli_vectors_bytes(q, rhs->nrhs, sli_block_most(F)));
}

/* Solves a query that has been prepared. */
static sl_status sli_query_run(sli_sweep_tasks *t, const sl_factor *F, const sli_query *q,
                               const sli_rhs *rhs, sl_work *W) {
    if (t->workers > 1) {
        sli_sweep_tasks_run(t, &W->threads, W->block, sli_sweep_tasks_block);
        return sli_atomic_read(&t->has_failed) ? sli_not_finite(rhs, q->nb) : SL_OK;
    }
    return sli_sweep(F, q, rhs, W->block);
}

/* Solves a query in the caller's workspace, or in one of its own. */
static sl_status sli_query_solve(const sl_factor *F, const sli_query *q, const sli_rhs *rhs,
                                 sl_work *W) {
    sl_work own;
    sl_status status;
    sli_sweep_tasks t;
    if (rhs->nrhs == 0 || q->nx == 0) {
        return SL_OK;
    }
    if (W == NULL) {
        own = sli_work_own(&F->allocator);
        W = &own;
    }
    status = sli_query_prepare(&t, F, q, rhs, W);
    status = status == SL_OK ? sli_query_run(&t, F, q, rhs, W) : status;
    if (W == &own) {
        sli_free(&own.allocator, own.block);
    }
    return status;
}

/* Checks the arguments, then solves a query. */
static sl_status sli_solve(const sl_factor *F, const sli_query *q, const sli_rhs *rhs, sl_work *W) {
    sl_status status = sli_rhs_check(rhs, q->nx, q->nb);
    status = status == SL_OK ? sli_query_check(q, F) : status;
    return status == SL_OK ? sli_query_solve(F, q, rhs, W) : status;
}

SL_API sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx, const double *B,
                                 size_t ldb, sl_int nrhs, sl_work *W) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    sli_query q;
    if (F == NULL) {
        return sli_argument("F is NULL");
    }
    q = sli_query_all(F->S);
    return sli_solve(F, &q, &rhs, W);
}

#endif
