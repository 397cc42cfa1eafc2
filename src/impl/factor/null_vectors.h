/* null_vectors.h: before a factorization: components of A, and which of them have a null vector */
#ifndef SLI_FACTOR_NULL_VECTORS_H
#define SLI_FACTOR_NULL_VECTORS_H

#include "panel_load.h"
#include "pivot_check.h"
#include "storage_type.h"
#include "null_basis.h"

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

/* The rounding error that the heaviest rows of a matrix may cause in a pivot, relative to their
 * diagonal entries. Over 80,000 meshes with weak bridges and slivers, pivots of the wrong sign
 * stayed below (128 + n/4) epsilon. The factor 16 leaves a margin. */
static double sli_null_rounding(sl_int n, double epsilon) {
    return 16.0 * (64.0 + n / 8) * epsilon;
}

/* After a pivot was refused: reports the first entry that is not finite instead, if there is one.
 * The kinds and the signs of other pivots depend on it. */
SLI_COLD static void sli_null_finite_check(const sl_factor *F, const sli_source *from,
                                           sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_off m;
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        for (m = S->scatter_begin[s]; m < S->scatter_begin[s + 1]; m++) {
            double a;
            if (from->A != NULL) {
                a = from->A->x[S->scatter_from[m]];
            } else {
                sli_source_sum(from, m, 1, &a);
            }
            if (!sli_is_finite(a)) {
                (void)sli_fail(failure, SL_ERR_NOT_FINITE, s, -1, m, a);
                return;
            }
        }
    }
}

/* Finds the components of A and those whose null vector is known, and with them the kind of every
 * pivot. Refuses a matrix whose diagonal shows that it is indefinite. An entry that is not finite
 * is left to the factorization. */
static sl_status sli_null_vectors_check(sl_factor *F, const sli_source *from,
                                        sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const int is_one = F->null.vectors == 1,
              by_columns = from->A != NULL && !F->null.has_duplicates;
    const double rounding = sli_null_rounding(S->n, F->rule.epsilon),
                 *z = is_one ? F->null.z : NULL;
    double *diagonal =
        is_one ? F->null.g : F->null.products + ((size_t)F->null.vectors + 1) * (size_t)S->n;
    const sli_null_walk w = sli_null_product(S, from, by_columns, F->null.rows, z, diagonal);
    sl_int i, refused = S->n; /* a pivot */
    F->stats.factor.regular = 0;
    sli_null_components(&w, S, z, F->null.last, F->null.rounding);
    if (!is_one && sli_null_bases(F, from, by_columns, failure) != SL_OK) {
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

/* Where null pivots are refused: may a root of the elimination forest be a null pivot that the
 * tolerance missed, because its rounding error comes from heavier rows? Reads D only, and counts
 * the pivots for the report. */
static int sli_null_is_suspected(sl_factor *F) {
    const sl_symbolic *S = F->S;
    const double rounding = sli_null_rounding(S->n, F->rule.epsilon);
    sl_int root, first;
    if (F->rule.replaces || F->rule.null_tolerance < 0.0) {
        return 0;
    }
    sli_count_pivots(F, S->n);
    if (F->E == NULL && F->stats.factor.pivot_min > rounding * F->stats.factor.pivot_max) {
        return 0; /* no pivot is */
    }
    for (root = S->n_supers - 1; root >= 0; root = first - 1) {
        const sl_int last = S->super_first[root + 1] - 1;
        const double size = fabs(F->D[last]);
        first = S->first_descendant[root];
        if (size <= rounding * F->stats.factor.pivot_max) { /* of all trees */
            const sl_int begin = S->super_first[first];
            if (size <= rounding * sli_spread_of(F->D + begin, last + 1 - begin).most) {
                return 1;
            }
        }
    }
    return 0;
}

/* n times `size` bytes in which pivots are judged; NULL: there is no memory. */
SLI_COLD static void *sli_judge_memory(sl_factor *F, sl_int n, size_t size) {
    sli_block b = {NULL, 0};
    if (F->work.is_worker) {
        F->work.is_worker = 2;
        return NULL;
    }
    (void)sli_take(&b, (uint64_t)n, size);
    return sli_block_alloc(&b, &F->allocator) == SL_OK ? b.base : NULL;
}

/* Refuses pivot k, which there is no memory to judge. */
SLI_COLD static sl_status sli_judge_not(const sl_factor *F, sl_int k, sli_failure *failure) {
    (void)sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, F->D[k]);
    failure->bound = -1.0;
    return failure->status;
}

/* The bytes a row that sli_null_suspects_find works in. */
#define SLI_SUSPECT_ROW (sizeof(sli_null_row) + sizeof(double) + sizeof(sl_int))

/* Does it fit in L? */
static int sli_null_suspect_fits(const sl_factor *F) {
    const sl_off entries = F->S->panel_begin[F->S->n_supers] >> F->type->half;
    return (double)entries * (double)F->type->value_bytes >= (double)F->S->n * SLI_SUSPECT_ROW;
}

/* Lists the last pivots that are suspected, of components that have constants as a null vector:
 * *list, of the allocator; NULL: none. Returns their number. Overwrites L unless L is too short. */
SLI_COLD static sl_int sli_null_suspects_find(sl_factor *F, const sli_source *from, sl_int **list,
                                              sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const double rounding = sli_null_rounding(S->n, F->rule.epsilon);
    void *room = sli_null_suspect_fits(F) ? NULL : sli_judge_memory(F, S->n, SLI_SUSPECT_ROW);
    sli_null_row *rows = (sli_null_row *)(room == NULL ? F->values : room);
    double *most = (double *)(void *)(rows + S->n); /* n: of a last pivot: the heaviest one */
    sl_int *last = (sl_int *)(void *)(most + S->n), k, count = 0;
    sli_null_walk w;
    if (room == NULL && !sli_null_suspect_fits(F)) {
        (void)sli_judge_not(F, S->n - 1, failure);
        return 0;
    }
    w = sli_null_product(S, from, 0, rows, NULL, NULL);
    sli_null_components(&w, S, NULL, last, most);
    for (k = 0; k < S->n; k++) {
        const double size = fabs(F->D[k]) > rows[k].size ? fabs(F->D[k]) : rows[k].size;
        most[last[k]] = size > most[last[k]] ? size : most[last[k]];
    }
    for (k = 0; k < S->n; k++) { /* last[0 .. count-1] := the list */
        if (last[k] == k && most[k] <= DBL_MAX && fabs(F->D[k]) <= rounding * most[k]) {
            last[count++] = k;
        }
    }
    if (count > 0) {
        *list = (sl_int *)sli_judge_memory(F, count, sizeof(sl_int));
        if (*list == NULL) {
            (void)sli_judge_not(F, last[0], failure);
            count = 0;
        }
        for (k = 0; k < count; k++) {
            (*list)[k] = last[k];
        }
    }
    sli_free(&F->allocator, room);
    return count;
}

#endif
