/* center_several.h: constants for centered solves where components have several null vectors */
#ifndef SLI_SINGULAR_CENTER_SEVERAL_H
#define SLI_SINGULAR_CENTER_SEVERAL_H

#include "../analysis/reach.h"
#include "../factor/storage_type.h"
#include "basis.h"

/* Let M be the diagonal of the weights, and let the columns of Z span the null space of a tree,
 * with Z' M Z = s I, where s is 1 or, for negative weights, -1. Wanted is the x with Z' M x = 0
 * that solves A x = b - s M Z Z' b, whose right-hand side is consistent. The columns of L at the
 * anchors are 0. With
 *
 *    U = L' P Z,  W = s L^-1 P M Z,  Q = W' D^+ W,  y = L^-1 P b,
 *
 * Z' b is U' y. The solution that is 0 in the anchors is P x = L'^-1 D^+ (y - W U' y). The motion
 * that makes it orthogonal to M Z is Z t with t = Q U' y - W' D^+ y, and P Z t is L'^-1 U t. In
 * all, with V = D^+ W - U Q / 2,
 *
 *    P x = L'^-1 (D^+ y - V (U' y) - U (V' y)).
 *
 * Stored are U and then V, in the columns of F->center. U has the rounding errors of L, so that
 * U' y is Z' b whatever they are. */

/* U := Z, V := s M Z in one tree, by Gram-Schmidt. The columns of U are null vectors on entry. A
 * z' M z of less than 1e-4 |z|' |M| |z| has too few digits: weights of both signs. */
SLI_HOT static sl_status sli_center_weigh(sl_factor *F, sl_int first, sl_int root,
                                          sli_failure *failure) {
    const size_t n = (size_t)F->S->n;
    sl_int m = sli_lower_bound(F->null.pivots, F->null.count, first), count = 0, k = root, i, j;
    const double rounding = 16.0 * F->S->n * DBL_EPSILON; /* of u, which is 1 in an anchor */
    double sign = 1.0;
    for (; m < F->null.count && F->null.pivots[m] <= root; m++) {
        k = F->null.pivots[m];
        if (sli_null_column(F, k) != -1) {
            F->divisors[k] = 1.0;
            count++; /* a tree has the first columns */
        } else if (F->rule.kinds[k] != SLI_PIVOT_NULL && !sli_null_is_row(F, k)) {
            return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, 0.0);
        }
    }
    for (j = 0, m = k; j < count; j++) {
        double *u = F->null.center + (size_t)j * n, *v = u + (size_t)F->null.vectors * n;
        double size = 0.0, square = 0.0, left = 0.0;
        for (k = first; k <= root; k++) {
            size += fabs(F->null.mass[k]) * (u[k] * u[k] + rounding);
        }
        for (i = 0; i < 2 * j; i++) { /* twice */
            const double *q = F->null.center + (size_t)(i % j) * n, *p = q + (v - u);
            double dot = 0.0;
            for (k = first; k <= root; k++) {
                dot += p[k] * u[k];
            }
            for (k = first; k <= root; k++) {
                u[k] -= dot * q[k];
            }
        }
        for (k = first; k <= root; k++) {
            square += F->null.mass[k] * u[k] * u[k];
            left += fabs(F->null.mass[k]) * u[k] * u[k];
        }
        sign = j == 0 && square < 0.0 ? -1.0 : sign;
        if (!(sign * square > fmax(rounding * size + 1e-290, 1e-4 * left))) {
            return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[m], m, -1, square);
        }
        for (k = first; k <= root; k++) {
            u[k] /= sqrt(sign * square);
            v[k] = sign * F->null.mass[k] * u[k];
        }
    }
    return SL_OK;
}

/* U := L' U, in place: each row is read before it changes. */
SLI_HOT static void sli_center_multiply(sl_factor *F) {
    const sl_symbolic *S = F->S;
    sl_int s, c, r, j;
    for (s = 0; s < S->n_supers; s++) {
        const sli_step *step = &S->steps[s];
        const sl_off below = S->rows_begin[s] - step->width;
        for (c = 0; c < F->null.vectors; c++) {
            double *u = F->null.center + (size_t)c * (size_t)S->n;
            for (r = 1; r < step->width + step->below; r++) {
                const double x = u[r < step->width ? step->column + r : S->rows[below + r]];
                for (j = 0; j < sli_min(r, step->width) && x != 0.0; j++) {
                    u[step->column + j] +=
                        x * sli_entry(F, step->panel + sli_panel_at(step->width, r, j));
                }
            }
        }
    }
}

/* V := D^+ W - U Q / 2 in one tree. V is W on entry. */
SLI_HOT static sl_status sli_center_finish(sl_factor *F, sl_int first, sl_int root,
                                           sli_failure *failure) {
    const size_t n = (size_t)F->S->n, count = (size_t)F->null.vectors;
    double q[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX] = {0.0}, size = 0.0;
    size_t i, j;
    sl_int k;
    for (k = first; k <= root; k++) {
        double *v = F->null.center + count * n + k;
        for (i = 0; i < count; i++) {
            v[i * n] = sli_is_skipped(F, k) ? 0.0 : v[i * n] / F->D[k];
            for (j = 0; j <= i; j++) {
                q[i * count + j] += v[i * n] * F->D[k] * v[j * n];
                q[j * count + i] = q[i * count + j];
            }
        }
    }
    for (k = first; k <= root; k++) {
        double *u = F->null.center + k, *v = u + count * n;
        for (i = 0; i < count * count; i++) {
            v[i % count * n] -= u[i / count * n] * q[i] / 2.0;
            size += fabs(q[i]);
        }
    }
    return sli_is_finite(size)
               ? SL_OK /* else of pivots near 0 */
               : sli_fail(failure, SL_ERR_NOT_FINITE, F->S->super_of[root], root, -1, size);
}

/* Computes U, V and the divisors. */
static sl_status sli_center_several(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sli_reach all = sli_reach_all(S);
    const size_t n = (size_t)S->n, count = (size_t)F->null.vectors;
    sl_status status = SL_OK;
    sl_int k, first;
    size_t j;
    int pass;
    memcpy(F->divisors, F->D, n * sizeof(double));
    memcpy(F->null.center, F->null.g, n * count * sizeof(double));
    memset(F->null.center + n * count, 0, n * count * sizeof(double));
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        for (j = count; j < 2 * count && pass == 1; j++) {
            sli_forward_sweep(F, SLI_NRHS_1, &all, F->null.center + n * j, F->null.sweep);
        }
        if (pass == 1) {
            sli_center_multiply(F);
        }
        for (k = first = 0; k < S->n && status == SL_OK; k++) {
            if (S->parent[k] == -1) {
                status = pass == 0 ? sli_center_weigh(F, first, k, failure)
                                   : sli_center_finish(F, first, k, failure);
                first = k + 1;
            }
        }
    }
    return status;
}

#endif
