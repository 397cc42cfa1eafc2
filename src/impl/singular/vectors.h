/* vectors.h: before a factorization: components of A, and which of them have a null vector */
#ifndef SLI_SINGULAR_VECTORS_H
#define SLI_SINGULAR_VECTORS_H

#include "../factor/pivot_suspects.h"
#include "basis.h"

/* Rounding alone cannot tell whether a small pivot is null: the rounding error of a pivot comes
 * from all rows before it, which may be much heavier than its own row. The structure can tell. Let
 * z be a vector with A z = 0 in a connected component C of A, not 0 in the last row k of C. The
 * Schur complement of all rows of C before k is the pivot d of row k, and d z(k) = 0. So this pivot
 * is null, whatever rounding makes of it. If A is semidefinite and z spans its null space in C, no
 * other pivot of C is null.
 *
 * A z = 0 is tested row by row with a bound on the rounding errors of the entries and of the
 * product, |A z|_i <= 16 n_i epsilon (|A| |z|)_i, where row i has n_i entries [Hi02] 3.1. The
 * factor 16 is for entries that are sums with cancellation, such as cotangent weights.
 *
 * Components are those of the graph of nonzero values, so that explicit zeros separate, and so do
 * duplicates that cancel. */

/* Sets the sign and the kind of every pivot; spreads the rounding errors over the components. */
static void sli_null_kinds_fill(sl_factor *F, const sli_null_walk *w, const double *diagonal) {
    sl_int k;
    for (k = 0; k < F->S->n; k++) { /* ascending: the last pivot of a component comes last */
        const sl_int last = F->null.last[k];
        F->null.rounding[k] = F->null.rounding[last];
        F->rule.signs[k] = diagonal[sli_null_walk_row(w, last)] < 0.0 ? -1 : 1;
        if (!(F->null.rounding[k] <= DBL_MAX)) { /* inf - inf would trap */
            F->rule.kinds[k] = SLI_PIVOT_UNKNOWN;
        } else if (F->null.vectors > 1 ? F->null.chain[k] == SLI_NULL_IS_ANCHOR : k == last) {
            F->rule.kinds[k] = SLI_PIVOT_NULL;
        } else if (F->rule.kinds[k] != SLI_PIVOT_WEAK) {
            F->rule.kinds[k] = SLI_PIVOT_KEPT;
        }
    }
}

/* g := z in each tree with one component of several rows whose null vector is known, else 0. */
static void sli_null_vectors_load(sl_factor *F) {
    const sl_symbolic *S = F->S;
    sl_int k, first = 0, only = -1, count = 0;
    for (k = 0; k < S->n; k++) {
        const sl_int last = F->null.last[k];
        if (last != k && last != only && F->rule.kinds[last] == SLI_PIVOT_NULL) {
            only = last; /* two components may alternate: then more than one is counted anyway */
            count++;
        }
        if (S->parent[k] == -1) {
            for (; first <= k; first++) {
                F->null.g[first] =
                    count == 1 && F->null.last[first] == only ? F->null.z[first] : 0.0;
            }
            count = 0;
            only = -1;
        }
    }
}

/* May both be diagonal entries of one semidefinite component of several rows? NaN passes. */
SLI_INLINE int sli_signs_agree(double a, double b) {
    return a != 0.0 && b != 0.0 && !(a < 0.0 && b > 0.0) && !(a > 0.0 && b < 0.0);
}

/* Finds the components of A and those whose null vector is known, and with them the kind of every
 * pivot. Refuses a matrix whose diagonal shows that it is indefinite. An entry that is not finite
 * is left to the factorization. */
static sl_status sli_null_vectors_check(sl_factor *F, const sli_source *from,
                                        sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const int is_one = F->null.vectors == 1;
    const double rounding = sli_null_rounding(S->n), *z = is_one ? F->null.z : NULL;
    double *diagonal =
        is_one ? F->null.g : F->null.products + ((size_t)F->null.vectors + 1) * (size_t)S->n;
    const sli_null_walk w = sli_null_product(F, from, z, diagonal);
    sl_int i, refused = S->n; /* a pivot */
    F->stats.factor.regular = 0;
    sli_null_components(&w, S, z, F->null.last, F->null.rounding);
    if (!is_one && sli_null_bases(F, from, failure) != SL_OK) {
        SLI_ZERO(F->D, S->n); /* no pivot is computed */
        return failure->status;
    }
    for (i = 0; i < S->n; i++) {
        const sl_int k = sli_null_walk_pivot(&w, i), last = F->null.last[k];
        const double of_last = diagonal[sli_null_walk_row(&w, last)];
        const double here = rounding * fabs(diagonal[i]);
        if (last != k && !sli_signs_agree(diagonal[i], of_last)) {
            refused = sli_min(refused, of_last == 0.0 ? last : k);
        }
        F->null.rounding[last] = here > F->null.rounding[last] ? here : F->null.rounding[last];
    }
    if (refused < S->n) {
        SLI_ZERO(F->D, S->n); /* no pivot is computed */
        return sli_fail(failure, SL_ERR_PIVOT, S->super_of[refused], refused, -1,
                        diagonal[sli_null_walk_row(&w, refused)]);
    }
    F->rule.rounding = F->null.rounding;
    sli_null_kinds_fill(F, &w, diagonal);
    if (is_one) {
        sli_null_vectors_load(F);
    }
    return SL_OK;
}

#endif
