/* nullspace.h: null pivots in solves: is a right-hand side consistent, and the solution that is centred by weights */
#ifndef SLI_NULLSPACE_H
#define SLI_NULLSPACE_H

#include "factor_parts.h"
#include "reach.h"

/* A null pivot k, skipped, has the null vector z = P' L^-T e_k, 1 in its own row, and z' b = (L^-1 P b)(k): the
 * forward sweep tells by how much b fails to be consistent.
 *
 * Centred solves, in a component (a tree) with one null pivot and weights m: of A x = b - c m with c = z' b / z' m the x
 * with m' x = 0. With w = L^-1 P m / z' m and y = L^-1 P b that is P x = L^-T (D^+ (y - c' w) + t e_k), c' = y(k),
 * t = - w' D^+ (y - c' w): a dot product over the columns of the forward sweep, a difference over those of the
 * backward sweep, both in their vectors. One vector v = D^+ w is kept, and w' D^+ w of each component in
 * the place of v(k). Columns that a local solve leaves out are exact zeros in the dot product of the full
 * one, so that both have the same bits. */

/* The weights in pivot order. A component without any, such as a vertex without a face, gets 1 for each row. */
static sl_status sli_mass_fill(sl_factor *F, const double *mass, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sl_int k, first = 0, any = 0;
    for (k = 0; k < S->n; k++) {
        const double m = mass[S->perm[k]];
        if (!sli_is_finite(m)) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, S->perm[k], -1, m);
        }
        F->mass[k] = m;
        any |= m != 0.0;
        if (S->parent[k] == -1) { /* in a postorder a tree ends at its root */
            for (; first <= k; first++) {
                F->mass[first] = any ? F->mass[first] : 1.0;
            }
            any = 0;
        }
    }
    return SL_OK;
}

/* v on columns first .. root, one tree, which holds w z'm; total: the sum of |m| there. */
static sl_status sli_centre_tree(sl_factor *F, sl_int first, sl_int root, double total,
                                 sli_failure *failure) {
    double *v = F->centre, a = 0.0, sum = 0.0;
    sl_int k, null = -1;
    for (k = first; k <= root; k++) {
        if (sli_is_skipped(F, k)) {
            if (null != -1) {
                return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, 0.0);
            }
            null = k;
        }
    }
    if (null == -1) {
        memset(v + first, 0, ((size_t)(root - first) + 1) * sizeof(double));
        return SL_OK;
    }
    a = v[null];
    if (!sli_is_finite(a) || !(fabs(a) > F->S->n * DBL_EPSILON * total)) {
        return sli_fail(failure, SL_ERR_ARGUMENT, F->S->super_of[null], null, -1, a);
    }
    for (k = first; k <= root; k++) {
        const double w = v[k] / a;
        v[k] = w / F->D[k];
        sum += k != null ? w * v[k] : 0.0;
    }
    v[null] = sum;
    F->divide[null] = 1.0;
    F->is_centred = 1;
    return SL_OK;
}

/* What centred solves need of a factor, once it is made. One forward sweep. */
static sl_status sli_centre_make(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sli_reach all = sli_reach_all(S);
    sl_status status = SL_OK;
    double total = 0.0;
    sl_int k, first = 0;
    F->is_centred = 0;
    for (k = 0; k < S->n && !sli_is_skipped(F, k); k++) {
    }
    if (k == S->n) {
        return SL_OK;
    }
    memcpy(F->divide, F->D, (size_t)S->n * sizeof(double));
    memcpy(F->centre, F->mass, (size_t)S->n * sizeof(double));
    F->kernels->forward[SLI_LANES_1](all.count, all.steps, all.rows, F->L, F->centre,
                                     F->centre_scratch);
    for (k = 0; k < S->n && status == SL_OK; k++) {
        total += fabs(F->mass[k]);
        if (S->parent[k] == -1) {
            status = sli_centre_tree(F, first, k, total, failure);
            total = 0.0;
            first = k + 1;
        }
    }
    return status;
}

/* norms(r) = sum of |b| in a packed block of right-hand sides */
static void sli_norms(const sli_reach *R, const double *b, sl_int lanes, double *norms) {
    sl_int k, r;
    for (r = 0; r < lanes; r++) {
        norms[r] = 0.0;
    }
    for (k = 0; k < R->columns; k++, b += lanes) {
        for (r = 0; r < lanes; r++) {
            norms[r] += fabs(b[r]);
        }
    }
}

/* After the forward sweep: is |z' b| small at every null pivot? A NaN passes, and so does what overflows: they show in
 * x. */
static int sli_is_consistent(const sl_factor *F, const sli_reach *R, const double *y, sl_int lanes,
                             const double *norms) {
    sl_int s, k, r;
    for (s = 0; s < R->count; s++) {
        const sli_step *step = &R->steps[s];
        for (k = 0; k < sli_step_columns(step); k++) {
            const double *row = y + ((ptrdiff_t)step->base + k) * lanes;
            if (F->D[step->column + k] == SLI_NULL_PIVOT) {
                for (r = 0; r < lanes; r++) {
                    if (fabs(row[r]) > F->consistency * norms[r]) {
                        return 0;
                    }
                }
            }
        }
    }
    return 1;
}

/* What centring takes from one tree of the forward sweep. */
typedef struct sli_shares {
    double c[SLI_TILE], t[SLI_TILE];
} sli_shares;

/* The tree that begins at step s; returns the step after its root. */
static sl_int sli_centre_ask(const sl_factor *F, const sli_reach *R, sl_int s, const double *y,
                             sl_int lanes, sli_shares *share) {
    double sums[SLI_TILE], square = 0.0;
    sl_int k, r, up = s;
    memset(share, 0, sizeof *share);
    memset(sums, 0, sizeof sums);
    while (up != -1) {
        const sli_step *step = &R->steps[s++];
        const double *v = F->centre + step->column, *D = F->D + step->column;
        const double *row = y + (ptrdiff_t)step->base * lanes;
        for (k = 0; k < sli_step_columns(step); k++, row += lanes) {
            if (D[k] == SLI_NULL_PIVOT) {
                memcpy(share->c, row, (size_t)lanes * sizeof(double));
                square = v[k];
            } else {
                for (r = 0; r < lanes; r++) {
                    sums[r] += v[k] * row[r];
                }
            }
        }
        up = step->up;
    }
    for (r = 0; r < lanes; r++) {
        share->t[r] = share->c[r] * square - sums[r];
    }
    return s;
}

/* Step s of the backward sweep, before it: y - c w, and t where x is given. */
static void sli_centre_give(const sl_factor *F, const sli_step *step, double *x, sl_int lanes,
                            const sli_shares *share) {
    const double *v = F->centre + step->column, *D = F->D + step->column;
    double *row = x + (ptrdiff_t)step->base * lanes;
    sl_int k, r;
    for (k = 0; k < sli_step_columns(step); k++, row += lanes) {
        if (D[k] == SLI_NULL_PIVOT) {
            memcpy(row, share->t, (size_t)lanes * sizeof(double));
        } else {
            const double w = v[k] * D[k];
            for (r = 0; r < lanes; r++) {
                row[r] -= share->c[r] * w;
            }
        }
    }
}

/* Between the sweeps: y in the columns of the one reach, x, which may be y, in those of the other. Trees ascend in both;
 * where b has no row there is nothing to do. */
static void sli_centre(const sl_factor *F, const sli_reach *from, const double *y,
                       const sli_reach *to, double *x, sl_int lanes) {
    const sl_symbolic *S = F->S;
    sl_int s = 0, at = 0;
    while (s < from->count && at < to->count) {
        sli_shares share;
        sl_int first, root, super;
        s = sli_centre_ask(F, from, s, y, lanes, &share);
        super = S->super_of[from->steps[s - 1].column];
        first = S->super_first[S->descendant[super]];
        root = S->super_first[super + 1] - 1;
        for (; at < to->count && to->steps[at].column <= root; at++) {
            if (to->steps[at].column >= first) {
                sli_centre_give(F, &to->steps[at], x, lanes, &share);
            }
        }
    }
}

#endif
