/* pins_solve.h: sl_pins_solve: solves with rows held */
#ifndef SLI_CHANGE_PINS_SOLVE_H
#define SLI_CHANGE_PINS_SOLVE_H

#include "pins_balance.h"

/* Arrays of a solve. */
typedef struct sli_pins_work {
    unsigned char *memory; /* of the sweeps */
    double *largest;       /* steps of the backward reach x lanes: |x| */
    double *f;             /* n_pins x lanes: K f, then f */
    double *e;             /* held_reach.columns x lanes: -L^-1 P A(:, H) g, for local solves */
    double *scratch;       /* of its sweep */
    sli_pins_nulls nulls;
} sli_pins_work;

/* Is this a solve of all rows? */
SLI_INLINE int sli_pins_is_whole(const sli_query *q) {
    return q->forward.steps == q->S->steps;
}

static void sli_pins_layout(sli_pins_work *w, sli_block *b, const sl_pins *P, const sli_query *q,
                            sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(sli_min(nrhs, 8));
    w->memory = (unsigned char *)sli_take(b, sli_vectors_bytes(q, nrhs, 8), 1);
    w->largest = SLI_TAKE(b, double, (uint64_t)q->backward.count *(uint64_t)lanes);
    w->f = SLI_TAKE(b, double, SLI_TILE *(uint64_t)P->n_pins);
    if (P->n_held > 0 && !sli_pins_is_whole(q)) {
        const sli_reach *R = &P->held_reach;
        w->e = SLI_TAKE(b, double, (uint64_t)R->columns *(uint64_t)lanes);
        w->scratch = SLI_TAKE(b, double, /* for blocks of 8, and the rest: sli_vectors_bytes */
                              sli_sweep_scratch(R->tallest, R->widest, 2) +
                                  sli_sweep_scratch(R->tallest, R->widest, SLI_TILE));
    }
    sli_pins_nulls_layout(&w->nulls, b, P);
}

/* y -= A(:, H) g, where y is a vector of all columns, or that of held_reach. */
static void sli_pins_couple(const sl_pins *P, double *y, int is_whole, const double *G, size_t ldg,
                            sl_int lanes, sl_int nrhs) {
    const sl_int *to = is_whole ? P->coupling_column : P->coupling_to;
    sl_int k, r;
    for (k = 0; k < P->n_couplings; k++) {
        const double *g = G + P->held_pin[P->coupling_from[k]];
        for (r = 0; r < nrhs; r++) {
            y[(ptrdiff_t)to[k] * lanes + r] -= P->couplings[k] * g[ldg * (size_t)r];
        }
    }
}

/* Sets the held rows of a vector to g, or to 0 if G is NULL. */
static void sli_pins_set_held(const sl_pins *P, const sli_reach *R, double *x, sl_int lanes,
                              const double *G, size_t ldg, sl_int nrhs) {
    sl_int k, r;
    for (k = 0; k < P->n_held; k++) {
        const sl_int at = sli_reach_index_of(R, P->held[k]);
        for (r = 0; r < lanes && at != -1; r++) {
            x[(ptrdiff_t)at * lanes + r] =
                G != NULL && r < nrhs ? G[(size_t)P->held_pin[k] + ldg * (size_t)r] : 0.0;
        }
    }
}

/* Clears b in pinned rows, where it changes nothing but the multiplier. So x is 0, and no rounding
 * of 0, where b is nonzero in pinned rows only. */
static void sli_pins_clear_rows(const sl_pins *P, const sli_reach *R, double *b, sl_int lanes) {
    sl_int p, r;
    for (p = 0; p < P->n_pins; p++) {
        const sli_pin *pin = P->pins[p];
        const sl_int at =
            pin->count == 1 ? sli_reach_index_of(R, P->F->S->iperm[pin->rows[0]]) : -1;
        for (r = 0; r < lanes && at != -1; r++) {
            b[(ptrdiff_t)at * lanes + r] = 0.0;
        }
    }
}

/* e := L^-1 P (-A(:, H) g) in the vector of held_reach. */
static void sli_pins_spread(const sl_pins *P, const sli_pins_work *w, const double *G, size_t ldg,
                            sl_int nrhs) {
    const sli_reach *R = &P->held_reach;
    const int kind = sli_lanes_kind(nrhs);
    const sl_int lanes = (sl_int)1 << kind;
    memset(w->e, 0, (size_t)R->columns * (size_t)lanes * sizeof(double));
    sli_pins_couple(P, w->e, 0, G, ldg, lanes, nrhs);
    sli_forward_sweep(P->base, kind, R->count, R->steps, R->rows, w->e, w->scratch);
    (void)sli_pins_clear(P, R, w->e, lanes, NULL);
}

/* x += e */
static void sli_pins_join(const sl_pins *P, const sli_query *q, const sli_pins_work *w, double *x,
                          sl_int lanes) {
    sli_intersection m = sli_intersection_of(&P->held_reach, &q->backward);
    sl_int k;
    while (sli_intersection_next(&m)) {
        const double *e = w->e + (ptrdiff_t)m.in_a * lanes;
        double *to = x + (ptrdiff_t)m.in_b * lanes;
        for (k = 0; k < m.count * lanes; k++) {
            to[k] += e[k];
        }
    }
}

/* f := K f = g - C' A^-1 b, where L^-1 P b is the sum of y and e. */
static void sli_pins_load(const sl_pins *P, const sli_query *q, const sli_pins_work *w,
                          const double *y, const double *G, size_t ldg, sl_int lanes, sl_int nrhs) {
    sl_int p, r, k;
    for (p = 0; p < P->n_pins; p++) {
        const sli_pin *pin = P->pins[p];
        double sums[SLI_TILE], more[SLI_TILE], *f = w->f + (ptrdiff_t)p * lanes;
        sli_pin_dot(pin, &q->forward, y, lanes, sums);
        if (P->n_held > 0 && !sli_pins_is_whole(q)) {
            sli_pin_dot(pin, &P->held_reach, w->e, lanes, more);
            for (r = 0; r < lanes; r++) {
                sums[r] += more[r];
            }
        }
        for (k = 0; k < pin->n_nulls; k++) {
            const double *s = w->nulls.s + (ptrdiff_t)w->nulls.place[pin->nulls[k]] * lanes;
            for (r = 0; r < lanes; r++) {
                sums[r] += pin->z[k] / P->delta * s[r];
            }
        }
        for (r = 0; r < lanes; r++) {
            f[r] = r < nrhs ? G[(size_t)pin->index + ldg * (size_t)r] - sums[r] : 0.0;
        }
        for (k = 0; k < pin->count && P->n_held > 0; k++) { /* held rows of an equality */
            const sl_int at = sli_held_find(P, P->F->S->iperm[pin->rows[k]]);
            for (r = 0; r < nrhs && at != -1; r++) {
                f[r] -= pin->values[k] * G[(size_t)P->held_pin[at] + ldg * (size_t)r];
            }
        }
    }
}

/* Beyond this error of C' x = g, relative to x and g, digits are lost: the solution without pins is
 * much larger than x. */
#define SLI_PINS_LOST 1e-8

/* largest := the largest |x| of the tree of each step. */
static void sli_pins_largest(const sli_reach *R, const double *x, double *largest, sl_int lanes) {
    double most[SLI_TILE] = {0.0};
    sl_int s, k, r, first = 0;
    for (s = 0; s < R->count; s++) {
        const sl_int end = R->steps[s].base + sli_step_columns(&R->steps[s]);
        for (k = R->steps[s].base; k < end; k++) {
            for (r = 0; r < lanes; r++) {
                const double size = fabs(x[(ptrdiff_t)k * lanes + r]);
                most[r] = size > most[r] ? size : most[r]; /* fmax is a call */
            }
        }
        if (R->steps[s].up == -1) {
            for (; first <= s; first++) {
                memcpy(largest + (ptrdiff_t)first * lanes, most, (size_t)lanes * sizeof *most);
            }
            memset(most, 0, sizeof most);
        }
    }
}

/* Is C' x = g, for the equalities whose rows are all in the vector? */
static int sli_pins_hold(const sl_pins *P, const sli_reach *R, const double *x,
                         const double *largest, const double *G, size_t ldg, sl_int lanes,
                         sl_int nrhs) {
    sl_int p, r, k;
    for (r = 0; r < nrhs; r++) {
        for (p = 0; p < P->n_pins; p++) {
            const sli_pin *pin = P->pins[p];
            const double g = G[(size_t)pin->index + ldg * (size_t)r];
            double sum = -g, size = 0.0;
            sl_int s = 0;
            for (k = 0; k < pin->count && s != -1; k++) {
                const sl_int column = P->F->S->iperm[pin->rows[k]];
                s = sli_reach_step_of(R, column);
                if (s != -1) {
                    const sl_int at = R->steps[s].base + column - R->steps[s].column;
                    sum += pin->values[k] * x[(ptrdiff_t)at * lanes + r];
                    size += fabs(pin->values[k]) * largest[(ptrdiff_t)s * lanes + r];
                }
            }
            if (s != -1 && fabs(sum) > SLI_PINS_LOST * (size + fabs(g))) {
                return 0;
            }
        }
    }
    return 1;
}

/* Solves one block of up to 8 right-hand sides. */
static sl_status sli_pins_block(const sl_pins *P, const sli_query *q, const sli_pins_work *w,
                                double *X, sli_dense x_at, const double *B, sli_dense b_at,
                                const double *G, size_t ldg, sl_int nrhs) {
    const sl_factor *F = P->base;
    const sli_vectors v = sli_vectors_of(q, nrhs, w->memory);
    const int kind = sli_lanes_kind(nrhs), is_whole = sli_pins_is_whole(q);
    const sl_int lanes = (sl_int)1 << kind;
    double norms[SLI_TILE];
    sl_int p;
    sli_pack(q, F->kernels, v.y, B, b_at, lanes, nrhs);
    sli_pins_set_held(P, &q->forward, v.y, lanes, NULL, 0, 0);
    sli_pins_clear_rows(P, &q->forward, v.y, lanes);
    if (F->null.count > 0) {
        sli_norms(&q->forward, v.y, lanes, norms);
    }
    if (!sli_pins_defects(P, q, &w->nulls, v.y, lanes, norms)) {
        return SL_ERR_INCONSISTENT;
    }
    if (is_whole) {
        sli_pins_couple(P, v.y, 1, G, ldg, lanes, nrhs);
    }
    sli_sweep_forward(F, q, &v, nrhs);
    if (!sli_pins_clear(P, &q->forward, v.y, lanes, norms)) {
        return SL_ERR_INCONSISTENT;
    }
    if (P->n_held > 0 && !is_whole) {
        sli_pins_spread(P, w, G, ldg, nrhs);
    }
    sli_pins_load(P, q, w, v.y, G, ldg, lanes, nrhs);
    if (!q->is_shared) {
        sli_sweep_transfer(q, v.y, v.x, lanes);
    }
    if (P->n_held > 0 && !is_whole) {
        sli_pins_join(P, q, w, v.x, lanes);
    }
    sli_pins_apply(P, w->f, lanes);
    if (!sli_pins_balance(P, &w->nulls, w->f, lanes, norms)) {
        return SL_ERR_INCONSISTENT;
    }
    for (p = 0; p < P->n_pins; p++) {
        sli_pin_add(P->pins[p], &q->backward, v.x, lanes, w->f + p * lanes);
    }
    if (F->null.is_centered) {
        sli_center(F, &q->forward, v.y, &q->backward, v.x, lanes, P->uses);
    }
    sli_backward(F, &q->backward, kind, v.x, v.scratch);
    sli_pins_shift(P, q, &w->nulls, v.x, lanes);
    sli_pins_set_held(P, &q->backward, v.x, lanes, G, ldg, nrhs);
    if (P->n_pins > 0) {
        sli_pins_largest(&q->backward, v.x, w->largest, lanes);
    }
    if (!sli_pins_hold(P, &q->backward, v.x, w->largest, G, ldg, lanes, nrhs)) {
        return SL_ERR_INACCURATE;
    }
    sli_unpack(q, F->kernels, X, x_at, v.x, lanes, nrhs);
    return SL_OK;
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
    status = sli_check_dense_columns(X, ldx, q->nx, B, ldb, q->nb, nrhs);
    if (status != SL_OK || (nrhs > 0 && P->count > 0 && (G == NULL || !sli_is_ld(ldg, P->count)))) {
        return SL_ERR_ARGUMENT;
    }
    if (!sli_numbers_are_of(&P->numbers, P->F) || !sli_query_fits(q, P->F)) {
        return SL_ERR_STATE;
    }
    if (q->ending != NULL) {
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
        status = sli_pins_nulls_factor(&w.nulls, P);
        for (r = 0; r < nrhs && status == SL_OK; r += sli_min(8, nrhs - r)) {
            const sl_int block = sli_min(8, nrhs - r);
            status = sli_pins_block(P, q, &w, X + (size_t)r * ldx, sli_dense_by_columns(ldx),
                                    q->nb == 0 ? B : B + (size_t)r * ldb, sli_dense_by_columns(ldb),
                                    P->count == 0 ? G : G + (size_t)r * ldg, ldg, block);
        }
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
