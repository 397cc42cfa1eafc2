/* refine_local.h: local solves with a regularized factor: the residual E x of the rows that were regularized, solved for */
#ifndef SLI_REFINE_LOCAL_H
#define SLI_REFINE_LOCAL_H

#include "refine.h"

/* The regularized rows that a plan's right-hand sides can meet, and up to 8 right-hand sides on their way. */
typedef struct sli_mending {
    const sl_factor *F;
    const sli_query *q;
    sl_int count, room;
    sl_int *row;           /* room: pivots, ascending */
    sl_int *in_y;          /* room: their places in the forward vector .. */
    sl_int *in_x;          /* .. and in the backward vector */
    double *last;          /* room x 8: x there one step ago, 0 at first */
    double *now;           /* nx x 8, column-major: the last x, */
    double *kept;          /* the best */
    unsigned char *memory; /* for sweeps */
    double error[SLI_TILE];
    int is_done[SLI_TILE];
    sl_int steps;
} sli_mending;

static void sli_mending_layout(sli_mending *f, sli_block *b, sl_int nrhs) {
    const size_t bytes = sli_vectors_bytes(f->q, nrhs);
    const uint64_t columns = (uint64_t)sli_min(nrhs, 8);
    f->row = SLI_TAKE(b, sl_int, f->room);
    f->in_y = SLI_TAKE(b, sl_int, f->room);
    f->in_x = SLI_TAKE(b, sl_int, f->room);
    f->last = SLI_TAKE(b, double, (uint64_t)f->room *columns);
    f->now = SLI_TAKE(b, double, (uint64_t)f->q->nx *columns);
    f->kept = SLI_TAKE(b, double, (uint64_t)f->q->nx *columns);
    f->memory = (unsigned char *)sli_take(b, bytes, 1);
}

/* Finds the regularized rows of every tree that b is in. -1, or the pivot of one that the reaches do not hold. */
static sl_int sli_mending_find(sli_mending *f) {
    const sl_factor *F = f->F;
    const sli_reach *R = &f->q->forward;
    sl_int s;
    f->count = 0;
    for (s = 0; s < R->count; s++) {
        sli_whole_tree tree;
        sl_int m;
        if (R->steps[s].up != -1) {
            continue;
        }
        tree = sli_whole_tree_of(F->S, &R->steps[s]);
        m = sli_lower_bound(F->regularized, F->stats.regularized, tree.first);
        for (; m < F->stats.regularized && F->regularized[m] <= tree.root; m++) {
            const sl_int k = F->regularized[m];
            const sl_int in_y = sli_reach_place_of(R, k),
                         in_x = sli_reach_place_of(&f->q->backward, k);
            if (in_y == -1 || in_x == -1) {
                return k;
            }
            f->row[f->count] = k;
            f->in_y[f->count] = in_y;
            f->in_x[f->count++] = in_x;
        }
    }
    return -1;
}

/* Solves (A + E) x = b + E last, and takes x where its residual E (x - last) is the least so far. */
static void sli_mending_step(sli_mending *f, const double *B, sli_dense at, sl_int columns,
                             const double *norms, sl_int step) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(columns);
    const sli_vectors v = sli_vectors_of(f->q, columns, f->memory);
    const size_t nx = (size_t)f->q->nx;
    sl_int m, c;
    sli_pack(f->q, v.y, B, at, lanes, columns);
    for (m = 0; m < f->count; m++) {
        for (c = 0; c < columns; c++) {
            v.y[(ptrdiff_t)f->in_y[m] * lanes + c] +=
                f->F->rule.shifts[f->row[m]] * f->last[(ptrdiff_t)m * columns + c];
        }
    }
    sli_sweep_forward(f->F, f->q, &v, columns);
    sli_sweep_backward(f->F, f->q, &v, columns);
    sli_unpack(f->q, f->now, sli_dense_of(SLI_COLUMN_MAJOR, nx), v.x, lanes, columns);
    for (c = 0; c < columns; c++) {
        double error = 0.0;
        for (m = 0; m < f->count; m++) {
            double *last = &f->last[(ptrdiff_t)m * columns + c];
            const double x = v.x[(ptrdiff_t)f->in_x[m] * lanes + c];
            error = sli_worse(fabs(f->F->rule.shifts[f->row[m]] * (x - *last)), error);
            *last = x;
        }
        error = sli_backward_error(error, 0.0, 0.0, norms[c]);
        if (step == 0 || (!f->is_done[c] && error < f->error[c])) {
            f->is_done[c] = step > 0 && !(error <= 0.5 * f->error[c]);
            f->is_done[c] |= error <= DBL_EPSILON;
            f->error[c] = error;
            f->steps = sli_max(f->steps, step);
            memcpy(f->kept + nx * (size_t)c, f->now + nx * (size_t)c, nx * sizeof(double));
        } else {
            f->is_done[c] = 1;
        }
    }
}

static void sli_mend_block(sli_mending *f, double *X, size_t ldx, const double *B, size_t ldb,
                           sl_int columns, sl_int steps) {
    const sli_dense at = sli_dense_of(SLI_COLUMN_MAJOR, ldb);
    const size_t nx = (size_t)f->q->nx;
    double norms[SLI_TILE];
    sl_int c, step, todo = columns;
    for (c = 0; c < columns; c++) {
        norms[c] = sli_largest(f->q->nb > 0 ? B + ldb * (size_t)c : B, f->q->nb);
    }
    memset(f->last, 0, (size_t)f->count * (size_t)columns * sizeof(double));
    for (step = 0; step <= steps && todo > 0; step++) {
        sli_mending_step(f, B, at, columns, norms, step);
        for (c = 0, todo = 0; c < columns; c++) {
            todo += !f->is_done[c];
        }
    }
    for (c = 0; c < columns; c++) {
        memcpy(X + ldx * (size_t)c, f->kept + nx * (size_t)c, nx * sizeof(double));
    }
}

/* Blocks of a plan's right-hand sides in a workspace. */
static sl_status sli_mend(sli_mending *f, double *X, size_t ldx, const double *B, size_t ldb,
                          sl_int nrhs, sl_int steps, sl_work *W, sl_stats *stats) {
    sli_block b = {NULL, 0, 0};
    double worst = 0.0;
    sl_status status;
    sl_int r, c;
    sli_mending_layout(f, &b, nrhs);
    status = sli_work_lay(W, &b);
    if (status != SL_OK) {
        return status;
    }
    sli_mending_layout(f, &b, nrhs);
    c = sli_mending_find(f);
    if (c != -1) {
        return sli_fail_at(stats, SL_ERR_ARGUMENT, f->F->S->perm[c], -1, f->F->rule.shifts[c]);
    }
    for (r = 0; r < nrhs; r += 8) {
        const sl_int columns = sli_min(8, nrhs - r);
        sli_mend_block(f, X + ldx * (size_t)r, ldx, f->q->nb > 0 ? B + ldb * (size_t)r : B, ldb,
                       columns, steps);
        for (c = 0; c < columns; c++) {
            worst = sli_worse(f->error[c], worst);
        }
    }
    sli_refine_stats(stats, f->steps, worst);
    return SL_OK;
}

SL_API sl_status sl_plan_solve_refined(const sl_plan *P, const sl_factor *F, double *X, size_t ldx,
                                       const double *B, size_t ldb, sl_int nrhs, sl_int steps,
                                       sl_work *W, sl_stats *stats) {
    sli_mending f;
    sl_work own;
    sl_status status;
    sli_stats_clear_error(stats);
    if (P == NULL || F == NULL || steps < 0) {
        return SL_ERR_ARGUMENT;
    }
    if (F->stats.regularized == 0 || nrhs == 0 || P->query.nx == 0) {
        status = sl_plan_solve(P, F, X, ldx, B, ldb, nrhs, W);
        if (status == SL_OK) {
            sli_refine_stats(stats, 0, 0.0);
        }
        return status;
    }
    status = sli_check_dense(X, ldx, P->query.nx, B, ldb, P->query.nb, SLI_COLUMN_MAJOR, nrhs);
    if (status != SL_OK) {
        return status;
    }
    if (!sli_query_fits(&P->query, F)) {
        return SL_ERR_STATE;
    }
    if (P->query.region != NULL) { /* E is not known to be 0 outside of it */
        return SL_ERR_UNSUPPORTED;
    }
    memset(&f, 0, sizeof f);
    f.F = F;
    f.q = &P->query;
    f.room = sli_min(F->stats.regularized, P->query.forward.columns);
    own = sli_work_own(&F->allocator);
    status = sli_mend(&f, X, ldx, B, ldb, nrhs, steps, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
