/* constraints_solve.h: sl_constraints_solve: solves with rows held */
#ifndef SLI_CONSTRAINTS_SOLVE_H
#define SLI_CONSTRAINTS_SOLVE_H

#include "constraints_balance.h"

/* A solve in progress. */
typedef struct sli_constraints_solve {
    const sl_constraints *P;
    const sli_query *q;
    sli_rhs rhs;     /* the current block of up to 8 right-hand sides */
    const double *G; /* its n_pins x rhs.nrhs: C' x */
    sli_dense g;     /* strides of G */
    sl_int lanes;
    unsigned char *memory; /* of the sweeps */
    double *largest;       /* steps of the backward reach x lanes: |x| */
    double *forces;        /* steps of the forward reach x lanes: |b| */
    double *f;             /* n_pins x lanes: K f, then f */
    sli_constraints_nulls nulls;
} sli_constraints_solve;

static void sli_constraints_layout(sli_constraints_solve *w, sli_block *b, sl_int nrhs) {
    const sl_constraints *P = w->P;
    const sli_query *q = w->q;
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(sli_min(nrhs, 8));
    w->memory = (unsigned char *)sli_take(b, sli_vectors_bytes(q, nrhs, 8), 1);
    w->largest = SLI_TAKE(b, double, (uint64_t)q->backward.count *(uint64_t)lanes);
    w->forces = SLI_TAKE(b, double, (uint64_t)q->forward.count *(uint64_t)lanes);
    w->f = SLI_TAKE(b, double, SLI_TILE *(uint64_t)P->n_pins);
    sli_constraints_nulls_layout(&w->nulls, b, P);
}

/* Where the row of a pin is in the vector of a reach; -1: it is not there, or there are several. */
static sl_int sli_pin_index(const sl_constraints *P, const sli_pin *pin, const sli_reach *R) {
    return pin->count == 1 ? sli_reach_index_of(R, P->F->S->iperm[pin->rows[0]]) : -1;
}

/* Clears b in pinned rows, where it changes nothing but the multiplier. So x is 0, and no rounding
 * of 0, where b is nonzero in pinned rows only. */
static void sli_constraints_clear_rows(const sl_constraints *P, const sli_reach *R, double *b,
                                       sl_int lanes) {
    sl_int p, r;
    for (p = 0; p < P->n_pins; p++) {
        const sli_pin *pin = P->pins[p];
        const sl_int at = sli_pin_index(P, pin, R);
        for (r = 0; r < lanes && at != -1; r++) {
            b[(ptrdiff_t)at * lanes + r] = 0.0;
        }
    }
}

/* What equality p holds in right-hand side r of the block. */
SLI_INLINE double sli_constraints_value(const sli_constraints_solve *w, sl_int p, sl_int r) {
    return ldexp(w->G[(size_t)p * w->g.row + (size_t)r * w->g.column], w->P->pins[p]->exponent);
}

/* f := K f = g - C' A^-1 b, where y = L^-1 P b. */
static void sli_constraints_load(const sli_constraints_solve *w, const double *y) {
    const sl_constraints *P = w->P;
    const sl_int lanes = w->lanes, nrhs = w->rhs.nrhs;
    sl_int p, r, k;
    for (p = 0; p < P->n_pins; p++) {
        const sli_pin *pin = P->pins[p];
        double sums[SLI_TILE], *f = w->f + (ptrdiff_t)p * lanes;
        sli_pin_dot(pin, &w->q->forward, y, lanes, sums);
        for (k = 0; k < pin->n_nulls; k++) {
            const double *s = w->nulls.s + (ptrdiff_t)w->nulls.place[pin->nulls[k]] * lanes;
            for (r = 0; r < lanes; r++) {
                sums[r] += pin->z[k] / P->delta * s[r];
            }
        }
        for (r = 0; r < lanes; r++) {
            f[r] = r < nrhs ? sli_constraints_value(w, p, r) - sums[r] : 0.0;
        }
    }
}

/* Beyond this error of C' x = g, relative to x and g, digits are lost: the solution without pins is
 * much larger than x. Where g is 0, x may be 0 and its rounding is not: an error of this part of
 * b / max |a| changes A x by no more than this part of b. */
#define SLI_CONSTRAINTS_LOST 1e-8

/* largest := the largest |x| or |b| of the tree of each step. */
static void sli_constraints_largest(const sli_reach *R, const double *x, double *largest,
                                    sl_int lanes) {
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
                SLI_COPY(largest + (ptrdiff_t)first * lanes, most, lanes);
            }
            memset(most, 0, sizeof most);
        }
    }
}

/* What is small of right-hand side r in the tree of column k: b / max |a|. Rank-one changes change
 * pivot_max, and not entry_max. */
SLI_COLD static double sli_constraints_least(const sli_constraints_solve *w, sl_int k, sl_int r) {
    const sl_symbolic *S = w->P->F->S;
    const sl_factor_info *info = &w->P->F->stats.factor;
    const double largest = fmax(info->entry_max, info->pivot_max);
    sl_int root = S->super_of[k], s;
    while (S->super_parent[root] != -1) {
        root = S->super_parent[root];
    }
    s = sli_reach_step_of(&w->q->forward, S->super_first[root + 1] - 1);
    return s == -1 || !(largest > 0.0) /* branches untested: without pivots no pin is off */
               ? 0.0
               : w->forces[(ptrdiff_t)s * w->lanes + r] / largest;
}

/* Is C' x = g, for the equalities of `fewest` rows or more that are all in the vector? */
static int sli_constraints_hold(const sli_constraints_solve *w, const double *x, sl_int fewest) {
    const sl_constraints *P = w->P;
    const sli_reach *R = &w->q->backward;
    const sl_int lanes = w->lanes;
    sl_int p, r, k;
    for (r = 0; r < w->rhs.nrhs; r++) {
        for (p = 0; p < P->n_pins; p++) {
            const sli_pin *pin = P->pins[p];
            const double g = sli_constraints_value(w, p, r);
            double sum = -g, size = 0.0, weight = 0.0;
            sl_int s = pin->count < fewest ? -1 : 0;
            for (k = 0; k < pin->count && s != -1; k++) {
                const sl_int column = P->F->S->iperm[pin->rows[k]];
                s = sli_reach_step_of(R, column);
                if (s != -1) {
                    const sl_int at = R->steps[s].base + column - R->steps[s].column;
                    sum += pin->values[k] * x[(ptrdiff_t)at * lanes + r];
                    size += fabs(pin->values[k]) * w->largest[(ptrdiff_t)s * lanes + r];
                    weight += fabs(pin->values[k]);
                }
            }
            if (s != -1 && fabs(sum) > SLI_CONSTRAINTS_LOST * (size + fabs(g)) &&
                (g != 0.0 || fabs(sum) > SLI_CONSTRAINTS_LOST * weight *
                                             sli_constraints_least(w, R->steps[s].column, r))) {
                return 0;
            }
        }
    }
    return 1;
}

/* x := g in the rows that are held, which it is but for rounding. */
static void sli_constraints_set(const sli_constraints_solve *w, double *x) {
    const sl_constraints *P = w->P;
    sl_int p, r;
    for (p = 0; p < P->n_pins; p++) {
        const sli_pin *pin = P->pins[p];
        const sl_int at = sli_pin_index(P, pin, &w->q->backward);
        for (r = 0; r < w->rhs.nrhs && at != -1; r++) {
            x[(ptrdiff_t)at * w->lanes + r] = sli_constraints_value(w, p, r) / pin->values[0];
        }
    }
}

/* y := L^-1 P b for the block, and f := K f. Returns 0 if b is inconsistent. norms := of b, if
 * there are null pivots. */
static int sli_constraints_forward(const sli_constraints_solve *w, const sli_vectors *v,
                                   double *norms) {
    const sl_constraints *P = w->P;
    const sl_factor *F = P->F;
    const sli_reach *R = &w->q->forward;
    const sli_packed b = sli_packed_of(R, v->y, w->lanes);
    sli_pack(F, w->q, v->y, &w->rhs);
    sli_constraints_clear_rows(P, R, v->y, w->lanes);
    if (P->n_pins > 0) {
        sli_constraints_largest(R, v->y, w->forces, w->lanes);
    }
    if (F->null.count > 0) {
        F->null.calls->norms(&b, norms);
    }
    if (!sli_constraints_defects(P, &w->nulls, &b, norms)) {
        return 0;
    }
    sli_sweep_forward(F, w->q, v, w->rhs.nrhs);
    if (!sli_constraints_clear(P, R, v->y, w->lanes, norms)) {
        return 0;
    }
    sli_constraints_load(w, v->y);
    return 1;
}

SLI_COLD static sl_status sli_constraints_inconsistent(void) {
    return sli_refuse(SL_ERR_INCONSISTENT, "B has a part along a null vector that no pin holds");
}

/* Solves the current block. */
SLI_HOT static sl_status sli_constraints_block(sli_constraints_solve *w) {
    const sl_constraints *P = w->P;
    const sli_query *q = w->q;
    const sl_factor *F = P->F;
    const sli_vectors v = sli_vectors_of(q, w->rhs.nrhs, w->memory);
    const int kind = sli_lanes_kind(w->rhs.nrhs);
    const sl_int lanes = (sl_int)1 << kind;
    double norms[SLI_TILE];
    sl_int p;
    int holds;
    w->lanes = lanes;
    if (!sli_constraints_forward(w, &v, norms)) {
        return sli_constraints_inconsistent();
    }
    if (!q->is_shared) {
        sli_sweep_transfer(q, v.y, v.x, lanes);
    }
    sli_constraints_apply(P, w->f, lanes);
    if (!sli_constraints_balance(P, &w->nulls, w->f, lanes, norms)) {
        return sli_constraints_inconsistent();
    }
    for (p = 0; p < P->n_pins; p++) {
        sli_pin_add(P->pins[p], &q->backward, v.x, lanes, w->f + p * lanes);
    }
    if (F->null.is_centered) {
        F->null.calls->center(F, q, &v, lanes, P->uses);
    }
    sli_backward(F, &q->backward, kind, v.x, v.scratch);
    sli_constraints_shift(P, q, &w->nulls, v.x, lanes);
    if (P->n_pins > 0) {
        sli_constraints_largest(&q->backward, v.x, w->largest, lanes);
    }
    holds = sli_constraints_hold(w, v.x, 1);
    sli_constraints_set(w, v.x); /* which changes equalities of several rows */
    if (!holds || !sli_constraints_hold(w, v.x, 2)) {
        return sli_refuse(SL_ERR_INACCURATE, "C' x = g holds too inaccurately");
    }
    sli_unpack(F, q, &w->rhs, v.x);
    return sli_sweep_is_finite(F, q, v.x, lanes) ? SL_OK : sli_not_finite(&w->rhs, q->nb);
}

SL_API sl_status sl_constraints_solve(const sl_constraints *P, const sl_plan *plan, double *X,
                                      size_t ldx, const double *B, size_t ldb, const double *G,
                                      size_t ldg, sl_int nrhs, sl_work *W) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    sli_block counted = {NULL, 0};
    sli_constraints_solve w;
    sli_query all;
    const sli_query *q = plan == NULL ? &all : &plan->query;
    sl_work own;
    sl_status status;
    sl_int r;
    if (P == NULL) {
        return sli_argument("P is NULL");
    }
    all = sli_query_all(P->F->S);
    status = sli_rhs_check(&rhs, q->nx, q->nb);
    if (status == SL_OK && nrhs > 0 && P->n_pins > 0) {
        status = G == NULL
                     ? sli_argument("G is NULL")
                     : sli_dense_check("ldg is below the number of pins, or nrhs with SL_ROWS", ldg,
                                       P->n_pins, nrhs);
    }
    status = status == SL_OK ? sli_constraints_are_current(P) : status;
    status = status == SL_OK ? sli_query_check(q, P->F) : status;
    if (status == SL_OK && q->ending != NULL) {
        status = sli_refuse_region();
    }
    if (status != SL_OK) {
        return status;
    }
    if (nrhs == 0 || q->nx == 0) {
        return SL_OK;
    }
    own = sli_work_own(&P->allocator);
    W = W == NULL ? &own : W;
    w.P = P;
    w.q = q;
    w.g = sli_dense_of(ldg);
    sli_constraints_layout(&w, &counted, nrhs);
    status = sli_work_block(W, &counted);
    if (status == SL_OK) {
        sli_constraints_layout(&w, &counted, nrhs);
        status = sli_constraints_nulls_factor(&w.nulls, P);
        for (r = 0; r < nrhs && status == SL_OK; r += sli_min(8, nrhs - r)) {
            w.rhs = sli_rhs_part(&rhs, r, sli_min(8, nrhs - r));
            w.G = P->n_pins == 0 ? G : G + (size_t)r * w.g.column;
            status = sli_constraints_block(&w);
        }
        if (status == SL_ERR_NOT_FINITE) {
            status = sli_dense_finite("this value of G is not finite", G, ldg, P->n_pins, nrhs);
            status = status == SL_OK ? sli_not_finite(&rhs, q->nb) : status;
        }
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
