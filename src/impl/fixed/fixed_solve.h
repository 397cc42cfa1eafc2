/* fixed_solve.h: solves for the free rows, with given values in the fixed ones */
#ifndef SLI_FIXED_SOLVE_H
#define SLI_FIXED_SOLVE_H

#include "../solve/sweep.h"
#include "fixed_rows.h"

/* Moves rows free_rows of B to the first rows of X, which may be B: they move up. */
static void sli_fixed_gather(const sl_fixed *D, const sli_rhs *rhs) {
    const sli_dense x = sli_dense_of(rhs->ldx), b = sli_dense_of(rhs->ldb);
    const sl_int by_rows = x.column == 1;
    const sl_int outer = by_rows ? D->n_free : rhs->nrhs, inner = by_rows ? rhs->nrhs : D->n_free;
    sl_int i, j;
    for (i = 0; i < outer; i++) {
        for (j = 0; j < inner; j++) {
            const size_t k = (size_t)(by_rows ? i : j), r = (size_t)(by_rows ? j : i);
            rhs->X[k * x.row + r * x.column] =
                rhs->B == NULL ? 0.0 : rhs->B[(size_t)D->free_rows[k] * b.row + r * b.column];
        }
    }
}

/* x -= A[free, fixed] g in the first rows of X. */
static void sli_fixed_subtract(const sl_fixed *D, const sli_rhs *rhs, const double *G, size_t ldg) {
    const sli_dense x = sli_dense_of(rhs->ldx), g = sli_dense_of(ldg);
    sl_int k, r;
    for (k = 0; k < D->n_couplings; k++) {
        double *to = rhs->X + (size_t)D->coupling_free[k] * x.row;
        const double *from = G + (size_t)D->coupling_fixed[k] * g.row, a = D->couplings[k];
        for (r = 0; r < rhs->nrhs; r++) {
            to[(size_t)r * x.column] -= a * from[(size_t)r * g.column];
        }
    }
}

/* Moves the first rows of X to free_rows, from the last one on. */
static void sli_fixed_scatter(const sl_fixed *D, const sli_rhs *rhs) {
    const sli_dense x = sli_dense_of(rhs->ldx);
    const sl_int by_rows = x.column == 1;
    const sl_int outer = by_rows ? D->n_free : rhs->nrhs, inner = by_rows ? rhs->nrhs : D->n_free;
    sl_int i, j;
    for (i = outer - 1; i >= 0; i--) {
        for (j = inner - 1; j >= 0; j--) {
            const size_t k = (size_t)(by_rows ? i : j), r = (size_t)(by_rows ? j : i);
            rhs->X[(size_t)D->free_rows[k] * x.row + r * x.column] =
                rhs->X[k * x.row + r * x.column];
        }
    }
}

/* Sets the fixed rows of X to g. Returns 0 if a value is not finite. */
static int sli_fixed_set_fixed(const sl_fixed *D, const sli_rhs *rhs, const double *G, size_t ldg) {
    const sli_dense x = sli_dense_of(rhs->ldx), g = sli_dense_of(ldg);
    sl_int k, r;
    int is_finite = 1;
    for (r = 0; r < rhs->nrhs; r++) {
        for (k = 0; k < D->n_fixed; k++) {
            const double value = G[(size_t)k * g.row + (size_t)r * g.column];
            rhs->X[(size_t)D->fixed_rows[k] * x.row + (size_t)r * x.column] = value;
            is_finite &= sli_is_finite(value);
        }
    }
    return is_finite;
}

/* Solves by a regular factor of the free rows, from B to X. index: gets where each row is in the
 * vector, for a fixed row that of the next free one, which overwrites it. */
static sl_status sli_fixed_blocks(const sl_fixed *D, const sli_rhs *rhs, const double *G,
                                  size_t ldg, sl_int *index, void *memory) {
    const sl_factor *F = D->F;
    const sli_dense g = sli_dense_of(ldg);
    sli_query q = sli_query_all(D->S);
    sl_int k, i = 0, r, c, count, is_finite = 1;
    for (k = 0; k < D->n_free; k++) {
        for (; i <= D->free_rows[k]; i++) {
            index[i] = D->S->iperm[k];
        }
    }
    q.nb = q.nx = i;
    q.b_index = q.x_index = index;
    for (r = 0; r < rhs->nrhs; r += count) {
        sli_rhs block;
        sli_vectors v;
        sl_int lanes;
        count = sli_block_size(rhs->nrhs - r, SLI_BLOCK_MOST);
        lanes = (sl_int)1 << sli_lanes_kind(count);
        block = sli_rhs_part(rhs, r, count);
        v = sli_vectors_of(&q, count, memory);
        if (rhs->B == NULL) {
            SLI_ZERO(v.y, (size_t)q.forward.columns * (size_t)lanes);
        } else {
            sli_pack(F, &q, v.y, &block);
        }
        for (k = 0; k < D->n_couplings; k++) { /* b -= A[free, fixed] g */
            double *to = v.y + (ptrdiff_t)D->S->iperm[D->coupling_free[k]] * lanes;
            const double *from = G + (size_t)D->coupling_fixed[k] * g.row + (size_t)r * g.column;
            for (c = 0; c < count; c++) {
                to[c] -= D->couplings[k] * from[(size_t)c * g.column];
            }
        }
        sli_sweep_forward(F, &q, &v, count);
        sli_sweep_backward(F, &q, &v, count);
        sli_unpack(F, &q, &block, v.x);
        is_finite &= sli_sweep_is_finite(F, &q, v.x, lanes);
    }
    return is_finite ? SL_OK : sli_not_finite(rhs, rhs->B == NULL ? 0 : i);
}

/* Solves by the factor of the free rows, in place in X if it is singular or by several workers. */
static sl_status sli_fixed_run(const sl_fixed *D, const sli_rhs *rhs, const double *G, size_t ldg,
                               sl_work *W) {
    const sli_rhs in_place = sli_rhs_of(rhs->X, rhs->ldx, rhs->X, rhs->ldx, rhs->nrhs);
    const sli_query q = sli_query_all(D->S);
    sli_sweep_tasks t;
    sl_status status = sli_query_prepare(&t, D->F, &q, &in_place, W);
    if (status == SL_OK && t.workers == 1 && D->F->null.count == 0 && D->n_free > 0) {
        const size_t bytes = sli_vectors_bytes(&q, rhs->nrhs, SLI_BLOCK_MOST);
        sli_block b = {NULL, 0};
        sl_int *index;
        (void)sli_take(&b, bytes, 1);
        (void)SLI_TAKE(&b, sl_int, D->n);
        status = sli_work_block(W, &b);
        if (status == SL_OK) {
            void *memory = sli_take(&b, bytes, 1);
            index = SLI_TAKE(&b, sl_int, D->n);
            status = sli_fixed_blocks(D, rhs, G, ldg, index, memory);
        }
        return status;
    }
    if (status == SL_OK) {
        sli_fixed_gather(D, rhs);
        sli_fixed_subtract(D, rhs, G, ldg);
        status = D->n_free > 0 ? sli_query_run(&t, D->F, &q, &in_place, W) : SL_OK;
        sli_fixed_scatter(D, rhs);
    }
    return status;
}

SL_API sl_status sl_fixed_solve(const sl_fixed *D, double *X, size_t ldx, const double *B,
                                size_t ldb, const double *G, size_t ldg, sl_int nrhs, sl_work *W) {
    sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    sl_work own;
    sl_status status;
    status = sli_argument(D == NULL                                 ? "D is NULL"
                          : nrhs > 0 && D->n_fixed > 0 && G == NULL ? "G is NULL"
                                                                    : NULL);
    status = status == SL_OK && nrhs > 0
                 ? sli_dense_check("ldg is below the number of fixed rows, or nrhs with SL_ROWS",
                                   ldg, D->n_fixed, nrhs)
                 : status;
    status = status == SL_OK ? sli_rhs_check(&rhs, D->n, B == NULL ? 0 : D->n) : status;
    if (status != SL_OK || nrhs == 0 || D->n == 0) {
        return status;
    }
    if (D->is_stale || !D->F->is_valid) { /* branches untested: then it is stale, too */
        return sli_refuse(SL_ERR_STALE, "the last sl_fixed_refactor has failed");
    }
    own = sli_work_own(&D->allocator);
    W = W == NULL ? &own : W;
    status = sli_fixed_run(D, &rhs, G, ldg, W);
    sli_free(&own.allocator, own.block);
    if ((status == SL_OK || status == SL_ERR_NOT_FINITE) && !sli_fixed_set_fixed(D, &rhs, G, ldg)) {
        status = sli_dense_finite("this value of G is not finite", G, ldg, D->n_fixed, nrhs);
    }
    return status;
}

SL_API sl_fixed_arrays sl_fixed_view(const sl_fixed *D) {
    sl_fixed_arrays v;
    SLI_CLEAR(v);
    if (D != NULL) {
        v.n_free = D->n_free;
        v.n_fixed = D->n_fixed;
        v.free_rows = D->free_rows;
        v.fixed_rows = D->fixed_rows;
        v.symbolic = D->S;
        v.factor = D->F;
        v.matrix = sl_matrix_view(D->M);
    }
    return v;
}

#endif
