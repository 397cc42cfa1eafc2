/* condition.h: the condition number by Hager and Higham's estimate, and what right-hand sides lack to be consistent */
#ifndef SLI_CONDITION_H
#define SLI_CONDITION_H

#include "../public/accuracy.h"
#include "csc_products.h"
#include "factor.h"
#include "inverse.h"

/* A vector in pivot order that is solved for in place, and signs to go with it. */
typedef struct sli_probe {
    const sl_factor *F;
    sli_reach all;
    double *v, *signs, *scratch;
} sli_probe;

static void sli_probe_layout(sli_probe *p, sli_block *b) {
    p->v = SLI_TAKE(b, double, p->all.columns);
    p->signs = SLI_TAKE(b, double, p->all.columns);
    p->scratch = SLI_TAKE(b, double, sli_scratch_size(p->all.tallest, p->all.widest, 1));
}

/* v := (P A P')^-1 v; returns the sum of its magnitudes. */
static double sli_probe_solve(const sli_probe *p) {
    const sl_factor *F = p->F;
    double sum = 0.0;
    sl_int k;
    F->kernels->forward[SLI_LANES_1](p->all.count, p->all.steps, p->all.rows, F->L, p->v,
                                     p->scratch);
    F->kernels->backward[SLI_LANES_1](p->all.count, p->all.steps, p->all.rows + p->all.n_rows, F->L,
                                      F->D, p->v, p->scratch);
    for (k = 0; k < p->all.columns; k++) {
        sum += fabs(p->v[k]);
    }
    return sum;
}

/* The signs of v; returns whether they are what they were. */
static int sli_probe_signs(const sli_probe *p) {
    int same = 1;
    sl_int k;
    for (k = 0; k < p->all.columns; k++) {
        const double sign = p->v[k] < 0.0 ? -1.0 : 1.0;
        same &= sign == p->signs[k];
        p->signs[k] = sign;
    }
    return same;
}

/* The place of the largest magnitude in v. */
static sl_int sli_probe_largest(const sli_probe *p) {
    sl_int k, best = 0;
    for (k = 1; k < p->all.columns; k++) {
        best = fabs(p->v[k]) > fabs(p->v[best]) ? k : best;
    }
    return best;
}

/* The largest column sum of |A^-1|, from below: the convex function ||A^-1 x|| climbed over the unit ball's corners e_j,
 * of which the gradient A^-1 sign(A^-1 x) names the next one; then a vector that is hard to fool. A is
 * symmetric: one kind of solve does for both. n > 0. */
static double sli_inverse_norm(const sli_probe *p) {
    const sl_int n = p->all.columns;
    double best, sum;
    sl_int k, j = -1, turn;
    for (k = 0; k < n; k++) {
        p->v[k] = 1.0 / n;
        p->signs[k] = 0.0;
    }
    best = sli_probe_solve(p);
    for (turn = 0; turn < 4 && !sli_probe_signs(p); turn++) {
        sl_int last = j;
        memcpy(p->v, p->signs, (size_t)n * sizeof(double));
        (void)sli_probe_solve(p);
        j = sli_probe_largest(p);
        if (last != -1 && fabs(p->v[j]) <= fabs(p->v[last])) {
            break;
        }
        memset(p->v, 0, (size_t)n * sizeof(double));
        p->v[j] = 1.0;
        sum = sli_probe_solve(p);
        if (!(sum > best)) {
            break;
        }
        best = sum;
    }
    for (k = 0; k < n; k++) {
        p->v[k] = (k % 2 == 0 ? 1.0 : -1.0) * (1.0 + (double)k / (n > 1 ? n - 1 : 1));
    }
    sum = 2.0 * sli_probe_solve(p) / (3.0 * n);
    return sum > best || sum != sum ? sum : best;
}

SL_API sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond, sl_work *W) {
    sli_block b = {NULL, 0, 0};
    sl_work own;
    sli_probe p;
    sl_status status;
    if (F == NULL || rcond == NULL) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_factor_fits(F, A);
    if (status != SL_OK) {
        return status;
    }
    if (F->S->n == 0 || F->n_nulls > 0) {
        *rcond = F->S->n == 0 ? 1.0 : 0.0;
        return SL_OK;
    }
    p.F = F;
    p.all = sli_reach_all(F->S);
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    sli_probe_layout(&p, &b);
    status = sli_work_lay(W, &b);
    if (status == SL_OK) {
        double norm, inverse;
        sli_probe_layout(&p, &b);
        norm = sli_csc_norm(A, p.v);
        inverse = sli_inverse_norm(&p);
        *rcond = norm > 0.0 && inverse > 0.0 ? 1.0 / norm / inverse : 0.0;
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* The entries of y at the null pivots, block after block. */
static void sli_defects(const sl_factor *F, const sli_query *q, double *Y, size_t ldy,
                        const double *B, size_t ldb, sl_int nrhs, void *memory) {
    sl_int c, r, m;
    for (c = 0; c < nrhs; c += 8) {
        const sl_int block = sli_min(8, nrhs - c), lanes = (sl_int)1 << sli_lanes_kind(block);
        const sli_vectors v = sli_vectors_of(q, block, memory);
        sli_pack(q, v.y, B + (size_t)c * ldb, sli_dense_of(SLI_COLUMN_MAJOR, ldb), lanes, block);
        sli_sweep_forward(F, q, &v, block);
        for (m = 0; m < F->n_nulls; m++) {
            for (r = 0; r < block; r++) {
                Y[(size_t)m + (size_t)(c + r) * ldy] = v.y[(ptrdiff_t)F->nulls[m] * lanes + r];
            }
        }
    }
}

SL_API sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy, const double *B,
                                   size_t ldb, sl_int nrhs, sl_work *W) {
    sli_block b = {NULL, 0, 0};
    sl_work own;
    sli_query q;
    sl_status status;
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_check_dense(Y, ldy, F->n_nulls, B, ldb, F->S->n, SLI_COLUMN_MAJOR, nrhs);
    if (status != SL_OK || (Y == B && Y != NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (nrhs == 0 || F->n_nulls == 0) {
        return SL_OK;
    }
    q = sli_query_all(F->S);
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    b.used = sli_vectors_bytes(&q, nrhs);
    b.overflow = b.used == SIZE_MAX;
    status = sli_work_lay(W, &b);
    if (status == SL_OK) {
        sli_defects(F, &q, Y, ldy, B, ldb, nrhs, W->block);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
