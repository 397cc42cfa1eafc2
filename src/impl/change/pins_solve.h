/* pins_solve.h: sl_pins_solve: solves with rows held */
#ifndef SLI_CHANGE_PINS_SOLVE_H
#define SLI_CHANGE_PINS_SOLVE_H

#include "pins_capacitance.h"

/* Arrays of a solve. */
typedef struct sli_pins_work {
    unsigned char *memory; /* of the sweeps */
    double *f;             /* count x lanes: g - C' A^-1 b, then f */
    double *v;             /* count x lanes: v, in the first row of each singular component */
    double *h, *z;         /* count: K^-1 z of a component, z */
} sli_pins_work;

static void sli_pins_layout(sli_pins_work *w, sli_block *b, const sl_pins *P, const sli_query *q,
                            sl_int nrhs) {
    w->memory = (unsigned char *)sli_take(b, sli_vectors_bytes(q, nrhs, 8), 1);
    w->f = SLI_TAKE(b, double, SLI_TILE *(uint64_t)P->count);
    w->v = SLI_TAKE(b, double, SLI_TILE *(uint64_t)P->count);
    w->h = SLI_TAKE(b, double, P->count);
    w->z = SLI_TAKE(b, double, P->count);
}

/* Makes z' (b + C f) 0 in the component of pin p, the first one there: f -= K^-1 z v. y: after the
 * forward sweep; at the null pivot it is z' b. */
static void sli_pins_balance(const sl_pins *P, const sli_query *q, const sli_pins_work *w, sl_int p,
                             const double *y, sl_int lanes) {
    const sl_int null = P->pins[p]->null, at = sli_reach_index_of(&q->forward, null);
    double *v = w->v + p * lanes;
    double s = 0.0;
    sl_int k, r;
    for (k = 0; k < P->count; k++) {
        w->z[k] = w->h[k] = P->pins[k]->null == null ? P->pins[k]->z : 0.0;
    }
    sli_pins_apply(P, w->h, 1);
    for (r = 0; r < lanes; r++) {
        v[r] = at == -1 ? 0.0 : y[(ptrdiff_t)at * lanes + r];
    }
    for (k = 0; k < P->count; k++) {
        s += w->z[k] * w->h[k];
        for (r = 0; r < lanes; r++) {
            v[r] += w->z[k] * w->f[k * lanes + r];
        }
    }
    for (r = 0; r < lanes; r++) {
        v[r] = s != 0.0 ? v[r] / s : 0.0;
    }
    for (k = 0; k < P->count; k++) {
        for (r = 0; r < lanes; r++) {
            w->f[k * lanes + r] -= w->h[k] * v[r];
        }
    }
}

/* Is pin p the first one of a singular component? */
static int sli_pins_is_first(const sl_pins *P, sl_int p) {
    sl_int k = 0;
    while (P->pins[k]->null != P->pins[p]->null) {
        k++;
    }
    return k == p && P->pins[p]->null != -1;
}

/* Sets x at the null pivots: v in a component with pins, 0 in the others. */
static void sli_pins_shift(const sl_pins *P, const sli_query *q, const sli_pins_work *w, double *x,
                           sl_int lanes) {
    sl_int m, p, at;
    for (m = 0; m < P->F->n_nulls; m++) {
        at = sli_reach_index_of(&q->backward, P->F->nulls[m]);
        if (at != -1) {
            memset(x + (ptrdiff_t)at * lanes, 0, (size_t)lanes * sizeof(double));
        }
    }
    for (p = 0; p < P->count; p++) {
        if (sli_pins_is_first(P, p)) {
            at = sli_reach_index_of(&q->backward, P->pins[p]->null);
            if (at != -1) {
                memcpy(x + (ptrdiff_t)at * lanes, w->v + p * lanes, (size_t)lanes * sizeof(double));
            }
        }
    }
}

/* Solves one block of up to 8 right-hand sides. */
static void sli_pins_block(const sl_pins *P, const sli_query *q, const sli_pins_work *w, double *X,
                           sli_dense x_at, const double *B, sli_dense b_at, const double *G,
                           size_t ldg, sl_int nrhs) {
    const sl_factor *F = P->F;
    const sli_vectors v = sli_vectors_of(q, nrhs, w->memory);
    const int kind = sli_lanes_kind(nrhs);
    const sl_int lanes = (sl_int)1 << kind;
    sl_int p, r;
    sli_pack(q, F->kernels, v.y, B, b_at, lanes, nrhs);
    sli_sweep_forward(F, q, &v, nrhs);
    for (p = 0; p < P->count; p++) {
        double sums[SLI_TILE] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        sli_pin_dot(P, P->pins[p], &q->forward, v.y, lanes, sums);
        for (r = 0; r < lanes; r++) {
            w->f[p * lanes + r] = r < nrhs ? G[(size_t)p + ldg * (size_t)r] - sums[r] : 0.0;
        }
    }
    sli_pins_apply(P, w->f, lanes);
    for (p = 0; p < P->count; p++) {
        if (sli_pins_is_first(P, p)) {
            sli_pins_balance(P, q, w, p, v.y, lanes);
        }
    }
    if (!q->is_shared) {
        sli_sweep_transfer(q, v.y, v.x, lanes);
    }
    for (p = 0; p < P->count; p++) {
        sli_pin_add(P->pins[p], &q->backward, v.x, lanes, w->f + p * lanes);
    }
    sli_pins_shift(P, q, w, v.x, lanes);
    sli_backward_sweep(F, kind, q->backward.count, q->backward.steps,
                       q->backward.rows + q->backward.n_rows,
                       P->divisors != NULL ? P->divisors : F->D, v.x, v.scratch);
    sli_unpack(q, F->kernels, X, x_at, v.x, lanes, nrhs);
}

SL_API sl_status sl_pins_solve(const sl_pins *P, const sl_plan *plan, double *X, size_t ldx,
                               const double *B, size_t ldb, const double *G, size_t ldg,
                               sl_int nrhs, sl_work *W) {
    sli_block counted = {NULL, 0, 0};
    sli_pins_work w;
    sli_query all;
    const sli_query *q = plan == NULL ? &all : &plan->query;
    sl_work own;
    sl_status status;
    sl_int r;
    if (P == NULL) {
        return SL_ERR_ARGUMENT;
    }
    all = sli_query_all(P->F->S);
    status = sli_check_dense(X, ldx, q->nx, B, ldb, q->nb, SLI_COLUMN_MAJOR, nrhs);
    if (status != SL_OK || (nrhs > 0 && P->count > 0 && (G == NULL || ldg < (size_t)P->count))) {
        return SL_ERR_ARGUMENT;
    }
    if (!sli_numbers_are_of(&P->numbers, P->F) || !sli_query_fits(q, P->F)) {
        return SL_ERR_STATE;
    }
    if (q->region != NULL) {
        return SL_ERR_UNSUPPORTED;
    }
    if (nrhs == 0 || q->nx == 0) {
        return SL_OK;
    }
    own = sli_work_own(&P->allocator);
    W = W == NULL ? &own : W;
    sli_pins_layout(&w, &counted, P, q, nrhs);
    status = sli_work_block(W, &counted);
    if (status == SL_OK) {
        sli_pins_layout(&w, &counted, P, q, nrhs);
        for (r = 0; r < nrhs; r += 8) {
            const sl_int block = sli_min(8, nrhs - r);
            sli_pins_block(P, q, &w, X + (size_t)r * ldx, sli_dense_of(SLI_COLUMN_MAJOR, ldx),
                           q->nb == 0 ? B : B + (size_t)r * ldb,
                           sli_dense_of(SLI_COLUMN_MAJOR, ldb),
                           P->count == 0 ? G : G + (size_t)r * ldg, ldg, block);
        }
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
