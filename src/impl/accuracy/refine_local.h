/* refine_local.h: sl_plan_solve_regularized: local solves without the error of regularization */
#ifndef SLI_ACCURACY_REFINE_LOCAL_H
#define SLI_ACCURACY_REFINE_LOCAL_H

#include "refine.h"

/* A block of up to 8 right-hand sides in progress, and the regularized rows in the components of b.
 * The factor is that of A + E. A solution x of (A + E) x = b has the residual E x, which is nonzero
 * only in these rows. */
typedef struct sli_local_refinement {
    const sl_factor *F;
    const sli_query *q;
    sl_int count, room;
    sl_int *row;           /* room: pivots, ascending */
    sl_int *in_y;          /* room: their indices in the forward vector */
    sl_int *in_x;          /* room: their indices in the backward vector */
    double *previous;      /* room x 8: x of the previous step in these rows, 0 at first */
    double *current;       /* nx x 8, column-major: x of the current step */
    double *best;          /* nx x 8, column-major: the best x so far */
    unsigned char *memory; /* vectors of the sweeps */
    double error[SLI_TILE];
    int is_done[SLI_TILE];
    int not_finite; /* a first solution is not, also where no row was regularized */
    sl_int steps;
} sli_local_refinement;

static void sli_local_refinement_layout(sli_local_refinement *f, sli_block *b, sl_int nrhs) {
    const size_t bytes = sli_vectors_bytes(f->q, nrhs, 8);
    const uint64_t columns = (uint64_t)sli_min(nrhs, 8);
    f->row = SLI_TAKE(b, sl_int, f->room);
    f->in_y = SLI_TAKE(b, sl_int, f->room);
    f->in_x = SLI_TAKE(b, sl_int, f->room);
    f->previous = SLI_TAKE(b, double, (uint64_t)f->room *columns);
    f->current = SLI_TAKE(b, double, (uint64_t)f->q->nx *columns);
    f->best = SLI_TAKE(b, double, (uint64_t)f->q->nx *columns);
    f->memory = (unsigned char *)sli_take(b, bytes, 1);
}

/* Finds the regularized rows of every tree that b has a row in. Returns -1, or the pivot of one
 * that is not in both reaches. */
static sl_int sli_local_refinement_find(sli_local_refinement *f) {
    const sl_factor *F = f->F;
    const sli_reach *R = &f->q->forward;
    sl_int s;
    f->count = 0;
    for (s = 0; s < R->count; s++) {
        sli_tree_range tree;
        sl_int m;
        if (R->steps[s].up != -1) {
            continue;
        }
        tree = sli_tree_range_of(F->S, &R->steps[s]);
        m = sli_lower_bound(F->rule.regularized, F->stats.factor.regularized, tree.first);
        for (; m < F->stats.factor.regularized && F->rule.regularized[m] <= tree.root; m++) {
            const sl_int k = F->rule.regularized[m];
            const sl_int in_y = sli_reach_index_of(R, k),
                         in_x = sli_reach_index_of(&f->q->backward, k);
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

/* Solves (A + E) x = b + E x_previous, and keeps x where its residual E (x - x_previous) is the
 * least so far. */
static void sli_local_refinement_step(sli_local_refinement *f, const sli_rhs *rhs,
                                      const double *norms, sl_int step) {
    const sl_int columns = rhs->nrhs, lanes = (sl_int)1 << sli_lanes_kind(columns);
    const sli_vectors v = sli_vectors_of(f->q, columns, f->memory);
    const size_t nx = (size_t)f->q->nx;
    const sli_rhs current = sli_rhs_of(f->current, nx, rhs->B, rhs->ldb, columns);
    sl_int m, c;
    sli_pack(f->F, f->q, v.y, &current);
    for (m = 0; m < f->count; m++) {
        for (c = 0; c < columns; c++) {
            v.y[(ptrdiff_t)f->in_y[m] * lanes + c] +=
                f->F->rule.shifts[f->row[m]] * f->previous[(ptrdiff_t)m * columns + c];
        }
    }
    sli_sweep_forward(f->F, f->q, &v, columns);
    sli_sweep_backward(f->F, f->q, &v, columns);
    f->not_finite |= step == 0 && !sli_sweep_is_finite(f->F, f->q, v.x, lanes);
    sli_unpack(f->F, f->q, &current, v.x);
    for (c = 0; c < columns; c++) {
        double error = 0.0;
        for (m = 0; m < f->count; m++) {
            double *previous = &f->previous[(ptrdiff_t)m * columns + c];
            const double x = v.x[(ptrdiff_t)f->in_x[m] * lanes + c];
            error = sli_max_error(fabs(f->F->rule.shifts[f->row[m]] * (x - *previous)), error);
            *previous = x;
        }
        error = sli_backward_error(error, 0.0, 0.0, norms[c]);
        if (step == 0 || (!f->is_done[c] && error < f->error[c])) {
            f->is_done[c] = step > 0 && !(error <= 0.5 * f->error[c]);
            f->is_done[c] |= error <= DBL_EPSILON;
            f->error[c] = error;
            f->steps = sli_max(f->steps, step);
            memcpy(f->best + nx * (size_t)c, f->current + nx * (size_t)c, nx * sizeof(double));
        } else {
            f->is_done[c] = 1;
        }
    }
}

/* norms(c) := the largest |b| of right-hand side c. Where the b-set repeats rows it is the largest
 * sum, which only the packed forward vector holds. */
static void sli_local_refinement_norms(const sli_local_refinement *f, const sli_rhs *rhs,
                                       double *norms) {
    const sl_int columns = rhs->nrhs, lanes = (sl_int)1 << sli_lanes_kind(columns);
    const sli_vectors v = sli_vectors_of(f->q, columns, f->memory);
    const sli_dense b = sli_dense_of(rhs->ldb);
    sl_int k, c;
    if (!f->q->b_repeats) {
        for (c = 0; c < columns; c++) {
            norms[c] =
                f->q->nb == 0 ? 0.0 : sli_largest(rhs->B + b.column * (size_t)c, b.row, f->q->nb);
        }
        return;
    }
    sli_pack(f->F, f->q, v.y, rhs);
    for (c = 0; c < columns; c++) {
        norms[c] = 0.0;
    }
    for (k = 0; k < f->q->forward.columns; k++) {
        for (c = 0; c < columns; c++) {
            norms[c] = sli_max_error(fabs(v.y[(ptrdiff_t)k * lanes + c]), norms[c]);
        }
    }
}

static void sli_local_refinement_block(sli_local_refinement *f, const sli_rhs *rhs, sl_int steps) {
    const size_t nx = (size_t)f->q->nx;
    const sl_int columns = rhs->nrhs;
    double norms[SLI_TILE];
    sl_int c, step, todo = columns;
    sli_local_refinement_norms(f, rhs, norms);
    SLI_ZERO(f->previous, (size_t)f->count * (size_t)columns);
    for (step = 0; step <= steps && todo > 0; step++) {
        sli_local_refinement_step(f, rhs, norms, step);
        for (c = 0, todo = 0; c < columns; c++) {
            todo += !f->is_done[c];
        }
    }
    sli_dense_copy(rhs->X, sli_dense_of(rhs->ldx), f->best, sli_dense_by_columns(nx), f->q->nx,
                   columns);
}

/* The backward error that refinement leaves, as it removes that of E alone: what growth lets
 * rounding do, and what changes have added. */
static double sli_local_rounding(const sl_factor *F) {
    const double epsilon = sli_is_float(F) ? (double)FLT_EPSILON : DBL_EPSILON;
    return fmax(epsilon * fmax(F->stats.factor.growth, 1.0), F->history.drift);
}

/* Refines the right-hand sides in blocks, in a workspace. */
static sl_status sli_local_refine(sli_local_refinement *f, const sli_rhs *rhs, sl_int steps,
                                  sl_work *W, sl_stats *stats) {
    sli_block b = {NULL, 0};
    double worst = 0.0;
    sl_status status;
    sl_int r, c;
    sli_local_refinement_layout(f, &b, rhs->nrhs);
    status = sli_work_block(W, &b);
    if (status != SL_OK) {
        return status;
    }
    sli_local_refinement_layout(f, &b, rhs->nrhs);
    c = sli_local_refinement_find(f);
    if (c != -1) {
        return sli_fail_at(stats, SL_ERR_ARGUMENT, f->F->S->perm[c], -1, f->F->rule.shifts[c],
                           "a set lacks this regularized row; sl_factor_pivot_rows lists all");
    }
    for (r = 0; r < rhs->nrhs; r += sli_min(8, rhs->nrhs - r)) {
        const sli_rhs block = sli_rhs_part(rhs, r, sli_min(8, rhs->nrhs - r));
        sli_local_refinement_block(f, &block, steps);
        for (c = 0; c < block.nrhs; c++) {
            worst = sli_max_error(f->error[c], worst);
        }
    }
    if (f->not_finite || !sli_is_finite(worst)) {
        return sli_not_finite(rhs, f->q->nb);
    }
    worst = sli_max_error(sli_local_rounding(f->F), worst);
    return sli_refine_done(f->F, stats, steps, f->steps, worst);
}

SL_API sl_status sl_plan_solve_regularized(const sl_plan *P, const sl_factor *F, double *X,
                                           size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                                           sl_int steps, sl_work *W, sl_stats *stats) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    sli_local_refinement f;
    sl_work own;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(P == NULL   ? "P is NULL"
                          : F == NULL ? "F is NULL"
                          : steps < 0 ? "steps is below 0"
                                      : NULL);
    status = status == SL_OK ? sli_rhs_check(&rhs, P->query.nx, P->query.nb) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    if (F->stats.factor.regularized == 0 || nrhs == 0 || P->query.nx == 0) {
        status = sli_solve(F, &P->query, &rhs, W);
        if (status == SL_OK) {
            status = sli_refine_done(F, stats, steps, 0, sli_local_rounding(F));
        }
        return sli_report(stats, status);
    }
    status = sli_query_check(&P->query, F);
    if (status == SL_OK && P->query.ending != NULL) { /* E may be nonzero outside of the region */
        status = sli_refuse_region();
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(f);
    f.F = F;
    f.q = &P->query;
    f.room = sli_min(F->stats.factor.regularized,
                     sli_min(P->query.forward.columns, P->query.backward.columns));
    own = sli_work_own(&F->allocator);
    status = sli_local_refine(&f, &rhs, steps, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return sli_report(stats, status);
}

#endif
