/* nullspace.h: after a factorization: the null pivots, and constants for centered solves */
#ifndef SLI_SINGULAR_NULLSPACE_H
#define SLI_SINGULAR_NULLSPACE_H

#include "center_several.h"
#include "vectors.h"

/* A skipped null pivot k has the null vector z = P' L^-T e_k, which is 1 in the pivot's own row.
 * The forward sweep computes z' b = (L^-1 P b)(k), which shows by how much b is inconsistent.
 *
 * Rounding in pivots that are almost null, as where a weak spring joins two grids, changes this z
 * by O(1). Where the null vector z is known, z' b is therefore computed from it before the forward
 * sweep, a dot product over its columns, and replaces y(k) after the sweep.
 *
 * Centered solves. Take a component with one null pivot, the only one of its tree, and weights m
 * that are 0 in all other rows: explicit zeros may join other components to it. Wanted is the x
 * with m' x = 0 that solves A x = b - c m, where c = z' b / z' m makes the right-hand side
 * consistent. With
 *
 *    w = L^-1 P m / z' m,  y = L^-1 P b,  c' = y(k),  t = - w' D^+ (y - c' w),
 *
 * the solution is P x = L^-T (D^+ (y - c' w) + t e_k). This takes one dot product over the columns
 * of the forward sweep and one vector update over those of the backward sweep. Stored are v = D^+ w
 * and, for each component, w' D^+ w. Columns that a local solve leaves out contribute exact zeros
 * to the dot product of the full solve, so both give the same bits.
 *
 * The null pivot k that the weights fix in this way is called the anchor of its component. */

/* Finds the anchor of each tree. A row of zeros, such as that of a vertex whose faces are all
 * degenerate, is a component by itself, and its x is 0. Apart from such rows a tree may have one
 * null pivot. */
SLI_COLD static sl_status sli_anchors_find(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    double *used = F->divisors; /* 0 in components of one row, unless they are trees */
    sl_int k, m = 0;
    F->null.n_anchors = 0;
    SLI_ZERO(used, S->n);
    for (k = 0; k < S->n; k++) {
        if (F->null.last[k] != k || (S->parent[k] == -1 && (k == 0 || S->parent[k - 1] == -1))) {
            used[k] = used[F->null.last[k]] = 1.0;
        }
    }
    for (k = 0; k < S->n && m < F->null.count; k++) {
        sl_int anchor = -1;
        if (S->parent[k] != -1) {
            continue;
        }
        for (; m < F->null.count && F->null.pivots[m] <= k; m++) {
            const sl_int null = F->null.pivots[m];
            if (used[null] != 0.0 && anchor != -1) {
                return sli_fail(failure, SL_ERR_PIVOT, S->super_of[null], null, -1, 0.0);
            }
            anchor = used[null] != 0.0 ? null : anchor;
        }
        if (anchor != -1) {
            F->null.anchors[F->null.n_anchors++] = anchor;
        }
    }
    return SL_OK;
}

/* weights := the weights in the component of each anchor, or 1 if all are 0 there, and 0 in other
 * components: explicit zeros may put several into one tree. */
static void sli_anchor_weights(const sl_factor *F, double *weights) {
    sl_int m, k = 0, first;
    SLI_ZERO(weights, F->S->n);
    for (m = 0; m < F->null.n_anchors; m++) {
        const sl_int last = F->null.last[F->null.anchors[m]];
        int any = 0;
        for (first = k; k <= last; k++) {
            weights[k] = F->null.last[k] == last ? F->null.mass[k] : 0.0;
            any |= weights[k] != 0.0;
        }
        for (; first <= last && !any; first++) {
            weights[first] = F->null.last[first] == last ? 1.0 : 0.0;
        }
    }
}

/* Computes v on the columns first .. root of one tree, where F->center holds z' m w on entry, and
 * F->divisors the weights. total is the sum of |m| in the tree. m is the number of its anchor, or
 * that of a later tree's if it has none. Where z' m is 0 the weights do not fix the null vector,
 * and the null pivot is refused. */
static sl_status sli_center_tree(sl_factor *F, sl_int first, sl_int root, double total, sl_int m,
                                 sli_failure *failure) {
    const sl_int anchor = m < F->null.n_anchors ? F->null.anchors[m] : F->S->n;
    double *v = F->null.center, a, sum = 0.0, z_m = 0.0, size = 0.0;
    sl_int k;
    if (anchor > root) {
        memset(v + first, 0, ((size_t)(root - first) + 1) * sizeof(double));
        return SL_OK;
    }
    a = v[anchor];
    if (!sli_is_finite(a) || !(fabs(a) > F->S->n * DBL_EPSILON * total)) {
        return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[anchor], anchor, -1, a);
    }
    F->null.ratios[m] = 1.0;
    if (F->null.g[anchor] != 0.0) {
        for (k = first; k <= root; k++) {
            const double weight = F->divisors[k];
            const double term = weight != 0.0 ? F->null.z[k] / F->null.z[anchor] * weight : 0.0;
            z_m += term;
            size += fabs(term);
        }
        if (!(fabs(z_m) > F->S->n * DBL_EPSILON * size)) { /* also if they overflow */
            return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[anchor], anchor, -1, z_m);
        }
        F->null.ratios[m] = a / z_m;
    }
    for (k = first; k <= root; k++) {
        const double w = v[k] / a;
        v[k] = sli_is_skipped(F, k) ? 0.0 : w / F->D[k];
        sum += w * v[k];
    }
    F->null.squares[m] = sum;
    if (!sli_is_finite(sum + F->null.ratios[m])) { /* of pivots or weights near 0 */
        return sli_fail(failure, SL_ERR_NOT_FINITE, F->S->super_of[anchor], anchor, -1, sum);
    }
    return SL_OK;
}

/* Computes v, the divisors and w' D^+ w of every tree, by one forward sweep. */
static sl_status sli_center_compute(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sli_reach all = sli_reach_all(S);
    double total = 0.0;
    sl_status status;
    sl_int k, first = 0, m = 0;
    if (F->null.vectors > 1) {
        return sli_center_several(F, failure);
    }
    status = sli_anchors_find(F, failure);
    sli_anchor_weights(F, F->divisors);
    SLI_COPY(F->null.center, F->divisors, S->n);
    sli_forward_sweep(F, SLI_NRHS_1, &all, F->null.center, F->null.sweep);
    for (k = 0; k < S->n && status == SL_OK; k++) {
        total += fabs(F->divisors[k]);
        if (S->parent[k] == -1) {
            status = sli_center_tree(F, first, k, total, m, failure);
            m += m < F->null.n_anchors && F->null.anchors[m] <= k;
            total = 0.0;
            first = k + 1;
        }
    }
    SLI_COPY(F->divisors, F->D, S->n);
    for (m = 0; m < F->null.n_anchors; m++) {
        F->divisors[F->null.anchors[m]] = 1.0;
    }
    return status;
}

/* Checks the null pivots that the tolerance has found: a random combination z of their null vectors
 * L^-T e_k has A z = 0 up to rounding if A is semidefinite. If it is indefinite, a pivot can be
 * null although its column is not, and A z is as large as |A| |z|. */
static sl_status sli_null_pivots_verify(sl_factor *F, const sli_source *from,
                                        sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sli_reach all = sli_reach_all(S);
    double *z = F->null.vectors == 1 ? F->null.g : F->null.products; /* g is loaded again below */
    uint64_t random = 1;
    sli_null_walk w;
    sl_status status = SL_OK;
    sl_int k, m, first = -1;
    for (m = F->null.count - 1; m >= 0; m--) {
        first = F->rule.kinds[F->null.pivots[m]] == SLI_PIVOT_UNKNOWN ? F->null.pivots[m] : first;
    }
    if (first == -1) {
        return SL_OK;
    }
    SLI_ZERO(z, S->n);
    for (m = 0; m < F->null.count; m++) {
        k = F->null.pivots[m];
        if (F->rule.kinds[k] == SLI_PIVOT_UNKNOWN) {
            /* divided by D(k), which is SLI_NULL_PIVOT, it is between 0.5 and 1 */
            z[k] = SLI_NULL_PIVOT * sli_random(&random);
        }
    }
    sli_backward_sweep(F, SLI_NRHS_1, &all, F->D, z, F->null.sweep);
    w = sli_null_product(F, from, z, NULL);
    for (k = 0; k < S->n && status == SL_OK; k++) {
        if (!(fabs(w.rows[k].product) <= 1e-4 * w.rows[k].size)) {
            status = sli_fail(failure, SL_ERR_PIVOT, S->super_of[first], first, -1, 0.0);
        }
    }
    if (F->null.vectors == 1) {
        sli_null_vectors_load(F);
    }
    return status;
}

/* Clears the columns of L at null pivots that are not the last ones of their component. Their
 * entries were divided by SLI_NULL_PIVOT, and such small numbers are slow to compute with. */
static void sli_anchor_columns_clear(sl_factor *F) {
    const sl_symbolic *S = F->S;
    sl_int m, r;
    for (m = 0; m < F->null.count && F->null.vectors > 1; m++) {
        const sl_int k = F->null.pivots[m];
        const sli_step *step = &S->steps[S->super_of[k]];
        for (r = k - step->column + 1; r < step->width + step->below; r++) {
            sli_entry_clear(F, step->panel + sli_panel_at(step->width, r, k - step->column));
        }
    }
}

/* Finds the null pivots of a new factorization, counts the components without one, and prepares
 * solves. */
static sl_status sli_nulls_find(sl_factor *F, const sli_source *from, sli_failure *failure) {
    sl_status status;
    sl_int k, m, regular = 0;
    F->null.count = 0;
    for (k = 0; k < F->S->n; k++) {
        regular += F->null.last[k] == k;
        if (sli_is_skipped(F, k)) {
            F->null.pivots[F->null.count++] = k;
        }
    }
    for (m = 0; m < F->null.count;
         m++) { /* the rounding errors are read no more: they become marks */
        double *mark = &F->null.rounding[F->null.last[F->null.pivots[m]]];
        regular -= *mark >= 0.0;
        *mark = -1.0;
    }
    F->stats.factor.regular = regular;
    F->null.is_centered = F->null.mass != NULL && F->null.count > 0;
    F->null.checks = F->null.mass == NULL && F->null.count > 0 && F->null.consistency >= 0.0;
    sli_anchor_columns_clear(F);
    status = sli_null_pivots_verify(F, from, failure);
    return status == SL_OK && F->null.is_centered ? sli_center_compute(F, failure) : status;
}

#endif
