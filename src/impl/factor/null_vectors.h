/* null_vectors.h: before a factorization: components of A, and which of them have a null vector */
#ifndef SLI_FACTOR_NULL_VECTORS_H
#define SLI_FACTOR_NULL_VECTORS_H

#include "../analysis/structure.h"
#include "factor_types.h"

/* Rounding alone cannot tell whether a small pivot is null: the rounding error of a pivot comes
 * from all rows before it, which may be much heavier than its own row. The structure can tell. Let
 * z be a vector with A z = 0 in a connected component C of A, not 0 in the last row k of C. The
 * Schur complement of all rows of C before k is the pivot d of row k, and d z(k) = 0. So this pivot
 * is null, whatever rounding makes of it. If A is semidefinite and z spans its null space in C, no
 * other pivot of C is null.
 *
 * A z = 0 is tested row by row with a bound on the rounding errors of the entries and of the
 * product, |A z|_i <= 16 n_i epsilon (|A| |z|)_i, where row i has n_i entries [Hi02] 3.1. A
 * diagonal that is the sum of n_i - 1 weights needs n_i epsilon / 2 for itself and as much for the
 * product. The factor 16 is for entries that are themselves sums with cancellation, such as
 * cotangent weights.
 *
 * Components are those of the graph of nonzero entries, so that explicit zeros separate. Duplicates
 * count as entries even where they cancel. */

/* The last pivot of the component of row k, as far as entries were joined. Halves the path. */
SLI_INLINE sl_int sli_component_last(sl_int *last, sl_int k) {
    while (last[k] != k) {
        last[k] = last[last[k]];
        k = last[k];
    }
    return k;
}

/* What sli_null_product computes besides A v. */
typedef struct sli_null_work {
    double *product;  /* n: A v */
    double *size;     /* n: |A| |v| */
    double *diagonal; /* n: the diagonal of A; NULL: not needed, nor are the next two */
    sl_int *entries;  /* n: entries in each row */
    sl_int *last;     /* n: joins the components */
} sli_null_work;

/* Adds the map entries first .. first+count-1 of supernode s, whose values are a. Runs backward. */
static void sli_null_product_add(const sl_symbolic *S, sl_int s, sl_off first, sl_int count,
                                 const double *values, const sl_int *scatter_from, const double *v,
                                 sl_int *tile, const sli_null_work *w) {
    sl_int m, k, j;
    for (m = count - 1; m >= 0; m--) {
        const double a = values[scatter_from != NULL ? scatter_from[first + m] : m];
        sli_scatter_map_pivots(S, s, first + m, tile, &k, &j);
        w->product[k] += a * v[j];
        w->size[k] += fabs(a * v[j]);
        if (k != j) {
            w->product[j] += a * v[k];
            w->size[j] += fabs(a * v[k]);
        }
        if (w->diagonal != NULL && k == j) {
            w->diagonal[k] += a;
            w->entries[k]++;
        } else if (w->diagonal != NULL && a != 0.0) {
            const sl_int x = sli_component_last(w->last, k), y = sli_component_last(w->last, j);
            w->last[sli_min(x, y)] = sli_max(x, y);
            w->entries[k]++;
            w->entries[j]++;
        }
    }
}

/* Computes A v and |A| |v|, and the components if w asks for them. */
static void sli_null_product(const sl_factor *F, const sli_source *from, const double *v,
                             const sli_null_work *w) {
    const sl_symbolic *S = F->S;
    const size_t bytes = (size_t)S->n * sizeof(double);
    double sums[SLI_SUM_ENTRIES];
    sl_int s, k;
    memset(w->product, 0, bytes);
    memset(w->size, 0, bytes);
    for (k = 0; k < S->n && w->diagonal != NULL; k++) {
        w->diagonal[k] = 0.0;
        w->entries[k] = 0;
        w->last[k] = k;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_off begin = S->scatter_begin[s];
        sl_off end = S->scatter_begin[s + 1];
        sl_int tile = sli_last_tile(S, s);
        while (end > begin) {
            const sl_int count =
                (sl_int)(end - begin < SLI_SUM_ENTRIES ? end - begin : SLI_SUM_ENTRIES);
            end -= count;
            if (from->A != NULL) {
                sli_null_product_add(S, s, end, count, from->A->x, S->scatter_from, v, &tile, w);
            } else {
                sli_source_sum(from, end, count, sums);
                sli_null_product_add(S, s, end, count, sums, NULL, v, &tile, w);
            }
        }
    }
}

/* Sets the kind of every pivot. is_null: of the last pivot of each component. */
static void sli_null_kinds_fill(sl_factor *F, const signed char *is_null) {
    sl_int k;
    for (k = 0; k < F->S->n; k++) {
        const sl_int last = F->last[k];
        if (!is_null[last]) {
            F->rule.kinds[k] = SLI_PIVOT_UNKNOWN;
        } else if (k == last) {
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
        const sl_int last = F->last[k];
        if (last != k && last != only && F->rule.kinds[last] == SLI_PIVOT_NULL) {
            only = last; /* two components may alternate: then more than one is counted anyway */
            count++;
        }
        if (S->parent[k] == -1) {
            for (; first <= k; first++) {
                F->g[first] = count == 1 && F->last[first] == only ? F->z[first] : 0.0;
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
    sli_null_work w;
    signed char *is_null = F->rule.signs; /* of the last pivot; replaced by the signs at the end */
    sl_int k, refused = -1;
    w.product = F->product;
    w.size = F->size;
    w.diagonal = F->g;
    w.entries = F->entries;
    w.last = F->last;
    F->stats.factor.regular = 0;
    sli_null_product(F, from, F->z, &w);
    for (k = S->n - 1; k >= 0; k--) { /* descending: the last pivot comes first */
        F->last[k] = F->last[k] == k ? k : F->last[F->last[k]];
        if (F->last[k] == k) {
            is_null[k] = F->z[k] != 0.0;
        }
    }
    for (k = 0; k < S->n; k++) {
        const double bound = 16.0 * DBL_EPSILON * F->entries[k] * F->size[k];
        if (!(fabs(F->product[k]) <= bound) || !sli_is_finite(bound)) {
            is_null[F->last[k]] = 0;
        }
        if (refused == -1 && F->last[k] != k && !sli_signs_agree(F->g[k], F->g[F->last[k]])) {
            refused = F->g[F->last[k]] == 0.0 ? F->last[k] : k;
        }
    }
    /* the diagonal is in g until here */
    for (k = 0; k < S->n; k++) {
        F->product[k] = F->g[F->last[k]] < 0.0 ? -1.0 : 1.0;
    }
    if (refused != -1) {
        memset(F->D, 0, (size_t)S->n * sizeof(double)); /* no pivot is computed */
        return sli_fail(failure, SL_ERR_PIVOT, S->super_of[refused], refused, -1, F->g[refused]);
    }
    sli_null_kinds_fill(F, is_null);
    for (k = 0; k < S->n; k++) {
        F->rule.signs[k] = (signed char)F->product[k];
        F->size[k] = 0.0;
    }
    /* Over 80,000 meshes with weak bridges and slivers, pivots of the wrong sign stayed below
     * (128 + n/4) epsilon times the largest diagonal entry. The factor 16 leaves a margin. */
    for (k = 0; k < S->n; k++) {
        const double here = 16.0 * (64.0 + S->n / 8) * DBL_EPSILON * fabs(F->g[k]);
        F->size[F->last[k]] = here > F->size[F->last[k]] ? here : F->size[F->last[k]];
    }
    for (k = 0; k < S->n; k++) { /* ascending: the last pivot of a component comes last */
        F->size[k] = F->size[F->last[k]];
    }
    F->rule.rounding = F->size;
    return SL_OK;
}

/* Are all pivots that were skipped before still null, or judged by the tolerance? */
static int sli_nulls_remain(const sl_factor *F) {
    sl_int m;
    for (m = 0; F->null_pivots == SL_NULL_PIVOT_SKIP && m < F->n_nulls; m++) {
        if (F->rule.kinds[F->nulls[m]] >= SLI_PIVOT_KEPT) {
            return 0;
        }
    }
    return 1;
}

#endif
