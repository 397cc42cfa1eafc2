/* rcond.h: sl_factor_rcond: reciprocal condition number by the Hager-Higham estimator */
#ifndef SLI_ACCURACY_RCOND_H
#define SLI_ACCURACY_RCOND_H

#include "../../public/accuracy.h"
#include "../matrix/csc_products.h"
#include "../factor/factor.h"
#include "../solve/backward.h"
#include "../solve/work.h"

/* Backward errors up to this come from rounding alone. Where L has grown they are larger, and L D
 * L' is not A: epsilon / rcond then has to bound the effect of that error, too. */
#define SLI_ROUNDING_ERROR 64.0 /* units of rounding of the type of L */

/* A vector v in pivot order, solved for in place, its signs, and the largest backward error of the
 * solves so far. */
typedef struct sli_norm_estimate {
    const sl_factor *F;
    const sl_csc *A;
    double norm; /* of A */
    double error;
    sli_reach all;
    double *v, *signs, *residual, *scratch;
} sli_norm_estimate;

static void sli_norm_estimate_layout(sli_norm_estimate *p, sli_block *b) {
    p->v = SLI_TAKE(b, double, p->all.columns);
    p->signs = SLI_TAKE(b, double, p->all.columns);
    p->residual = SLI_TAKE(b, double, p->all.columns);
    p->scratch = SLI_TAKE(b, double, sli_sweep_scratch(p->all.tallest, p->all.widest, 1));
}

/* residual := residual - P (A + E) P' v, where E is what regularization added. */
static void sli_norm_estimate_residual(const sli_norm_estimate *p) {
    const sl_csc *A = p->A;
    const sl_int *iperm = p->F->S->iperm;
    const sl_triangle triangle = p->F->S->stats.symbolic.triangle;
    sl_int j, k, m, q;
    for (j = 0; j < A->n_cols; j++) {
        k = iperm[j];
        for (q = A->p[j]; q < A->p[j + 1]; q++) {
            m = iperm[A->i[q]];
            if (sli_is_read(triangle, A->i[q], j)) {
                p->residual[m] -= A->x[q] * p->v[k];
                p->residual[k] -= m != k ? A->x[q] * p->v[m] : 0.0;
            }
        }
        p->residual[k] -= p->F->rule.shifts != NULL ? p->F->rule.shifts[k] * p->v[k] : 0.0;
    }
}

/* v := (P A P')^-1 v. Returns the 1-norm of v. */
SLI_HOT static double sli_norm_estimate_solve(sli_norm_estimate *p) {
    const sl_factor *F = p->F;
    const sl_int n = p->all.columns;
    const double size = sli_largest(p->v, 1, n);
    double sum = 0.0, error;
    sl_int k;
    SLI_COPY(p->residual, p->v, n);
    sli_forward_sweep(F, SLI_NRHS_1, &p->all, p->v, p->scratch);
    sli_backward(F, &p->all, SLI_NRHS_1, p->v, p->scratch);
    for (k = 0; k < n; k++) {
        sum += fabs(p->v[k]);
    }
    sli_norm_estimate_residual(p);
    error =
        sli_backward_error(sli_largest(p->residual, 1, n), p->norm, sli_largest(p->v, 1, n), size);
    p->error = error > p->error ? error : p->error;
    return sum;
}

/* Takes the signs of v. Returns whether they are unchanged. */
static int sli_norm_estimate_signs(const sli_norm_estimate *p) {
    int same = 1;
    sl_int k;
    for (k = 0; k < p->all.columns; k++) {
        const double sign = p->v[k] < 0.0 ? -1.0 : 1.0;
        same &= sign == p->signs[k];
        p->signs[k] = sign;
    }
    return same;
}

/* Returns the index of the largest magnitude in v. */
static sl_int sli_norm_estimate_largest(const sli_norm_estimate *p) {
    sl_int k, best = 0;
    for (k = 1; k < p->all.columns; k++) {
        best = fabs(p->v[k]) > fabs(p->v[best]) ? k : best;
    }
    return best;
}

/* A lower bound of ||A^-1||_1. The convex function ||A^-1 x||_1 is maximized over the vertices e_j
 * of the unit ball; its gradient A^-1 sign(A^-1 x) selects the next vertex. A last vector with
 * alternating signs guards against matrices that fool this search. A is symmetric, so one kind of
 * solve serves for A^-1 and its transpose. n > 0. [Hi88] */
static double sli_inverse_norm(sli_norm_estimate *p) {
    const sl_int n = p->all.columns;
    double best, sum;
    sl_int k, j = -1, turn;
    for (k = 0; k < n; k++) {
        p->v[k] = 1.0 / n;
        p->signs[k] = 0.0;
    }
    best = sli_norm_estimate_solve(p);
    for (turn = 0; !sli_norm_estimate_signs(p); turn++) {
        const sl_int last = j;
        if (turn == 4) { /* untested: there are fewer turns */
            break;       /* untested: the same */
        }
        SLI_COPY(p->v, p->signs, n);
        (void)sli_norm_estimate_solve(p);
        j = sli_norm_estimate_largest(p);
        if (last != -1 && fabs(p->v[j]) <= fabs(p->v[last])) {
            break;
        }
        SLI_ZERO(p->v, n);
        p->v[j] = 1.0;
        sum = sli_norm_estimate_solve(p);
        if (!(sum > best)) {
            break;
        }
        best = sum;
    }
    for (k = 0; k < n; k++) {
        p->v[k] = (k % 2 == 0 ? 1.0 : -1.0) * (1.0 + (double)k / (n > 1 ? n - 1 : 1));
    }
    sum = 2.0 * sli_norm_estimate_solve(p) / (3.0 * n);
    return sum > best || sum != sum ? sum : best;
}

SL_API sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond, sl_work *W) {
    sli_block b = {NULL, 0};
    sl_work own;
    sli_norm_estimate p;
    sl_status status;
    status = sli_argument(F == NULL ? "F is NULL" : rcond == NULL ? "rcond is NULL" : NULL);
    status = status == SL_OK ? sli_factor_fits(F, A) : status;
    if (status != SL_OK) {
        return status;
    }
    if (F->S->n == 0 || F->null.count > 0) {
        *rcond = F->S->n == 0 ? 1.0 : 0.0;
        return SL_OK;
    }
    p.F = F;
    p.A = A;
    p.error = 0.0;
    p.all = sli_reach_all(F->S);
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    sli_norm_estimate_layout(&p, &b);
    status = sli_work_block(W, &b);
    if (status == SL_OK) {
        double inverse, unit;
        sli_norm_estimate_layout(&p, &b);
        p.norm = sli_csc_norm(A, F->S->stats.symbolic.triangle, p.v, 1);
        inverse = sli_inverse_norm(&p);
        /* Divided by the larger norm first: 1 / (smallest subnormal) is infinite. */
        *rcond = p.norm > 0.0 && inverse > 0.0 ? 1.0 / fmax(p.norm, inverse) / fmin(p.norm, inverse)
                                               : 0.0;
        unit = sli_is_float(F) ? (double)FLT_EPSILON : DBL_EPSILON;
        *rcond *= p.error > SLI_ROUNDING_ERROR * unit ? unit / p.error : 1.0;
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
