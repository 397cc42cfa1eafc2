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
 * Components are those of the graph of nonzero values, so that explicit zeros separate, and so do
 * duplicates that cancel. */

/* The rows of A z. A matrix is walked column by column, in the caller's numbering: neighbors are
 * mostly close to each other there. A sum exists only as the map, and duplicates are neighbors only
 * in it, so these are walked along the map, and their rows are pivots. */
typedef struct sli_null_walk {
    sli_null_row *rows;
    const sl_int *perm, *iperm; /* NULL: rows are pivots */
    int is_joined; /* 0: there is no zero off the diagonal, and components are the trees */
} sli_null_walk;

SLI_INLINE sl_int sli_null_walk_row(const sli_null_walk *w, sl_int k) {
    return w->perm == NULL ? k : w->perm[k];
}

SLI_INLINE sl_int sli_null_walk_pivot(const sli_null_walk *w, sl_int row) {
    return w->iperm == NULL ? row : w->iperm[row];
}

/* The last row of the component of row i, as far as entries were joined. Halves the path. */
SLI_INLINE sl_int sli_component_last(sli_null_row *rows, sl_int i) {
    while (rows[i].up != i) {
        rows[i].up = rows[rows[i].up].up;
        i = rows[i].up;
    }
    return i;
}

/* Joins the components of rows i and j. */
SLI_INLINE void sli_null_join(const sli_null_walk *w, sl_int i, sl_int j) {
    if (w->rows[i].up != w->rows[j].up) {
        const sl_int x = sli_component_last(w->rows, i), y = sli_component_last(w->rows, j);
        const int x_is_later = sli_null_walk_pivot(w, x) > sli_null_walk_pivot(w, y);
        w->rows[x_is_later ? y : x].up = x_is_later ? x : y;
    }
}

/* Adds the entry (i, j) of value a, times z(j), to row i. */
SLI_INLINE void sli_null_add(sli_null_row *rows, sl_int i, sl_int j, double a) {
    const double term = a * rows[j].z;
    rows[i].product += term;
    rows[i].size += fabs(term);
    rows[i].entries++;
}

/* Adds the matrix A, which has no duplicates. Returns 1 if it has a zero off the diagonal. */
static int sli_null_add_columns(sli_null_row *rows, const sl_csc *A, sl_triangle triangle,
                                double *diagonal) {
    int has_zero = 0;
    sl_int j, p;
    for (j = 0; j < A->n_cols; j++) {
        double product = 0.0, size = 0.0;
        sl_int entries = 0;
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            const double a = A->x[p], term = a * rows[i].z;
            if (!sli_is_read(triangle, i, j)) {
                continue;
            }
            product += term;
            size += fabs(term);
            entries++;
            if (i != j) {
                sli_null_add(rows, i, j, a);
                has_zero |= a == 0.0;
            } else if (diagonal != NULL) {
                diagonal[j] = a;
            }
        }
        rows[j].product += product;
        rows[j].size += size;
        rows[j].entries += entries;
    }
    return has_zero;
}

/* Joins the components of A by columns. */
static void sli_null_join_columns(const sli_null_walk *w, const sl_csc *A, sl_triangle triangle) {
    sl_int j, p;
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            if (A->x[p] != 0.0 && sli_is_read(triangle, A->i[p], j)) {
                sli_null_join(w, A->i[p], j);
            }
        }
    }
}

/* A walk along the map, backward. */
typedef struct sli_null_map_state {
    double *diagonal; /* n: the diagonal of A; NULL: not needed */
    sl_off to;        /* where the last entry goes in L; -1: none */
    sl_int k, j;      /* its pivots */
    double value;     /* the sum of the duplicates so far */
} sli_null_map_state;

/* Joins the components of the entry that is complete now. */
SLI_INLINE void sli_null_map_join(const sli_null_walk *w, const sli_null_map_state *p) {
    if (p->to != -1 && p->k != p->j && p->value != 0.0) {
        sli_null_join(w, p->k, p->j);
    }
}

/* Adds the map entries first .. first+count-1 of supernode s, whose values are a. Runs backward. */
static void sli_null_add_entries(const sli_null_walk *w, const sl_symbolic *S, sl_int s,
                                 sl_off first, sl_int count, const double *values,
                                 const sl_int *scatter_from, sl_int *tile, sli_null_map_state *p) {
    sl_int m;
    for (m = count - 1; m >= 0; m--) {
        const double a = values[scatter_from != NULL ? scatter_from[first + m] : m];
        if (S->scatter_to[first + m] != p->to) {
            sli_null_map_join(w, p);
            sli_scatter_map_pivots(S, s, first + m, tile, &p->k, &p->j);
            p->to = S->scatter_to[first + m];
            p->value = 0.0;
        }
        p->value += a;
        sli_null_add(w->rows, p->k, p->j, a);
        if (p->k != p->j) {
            sli_null_add(w->rows, p->j, p->k, a);
        } else if (p->diagonal != NULL) {
            p->diagonal[p->k] += a;
        }
    }
}

/* Adds all entries of the map. */
static void sli_null_add_map(const sli_null_walk *w, const sl_symbolic *S, const sli_source *from,
                             double *diagonal) {
    double sums[SLI_SUM_ENTRIES];
    sli_null_map_state p;
    sl_int s;
    memset(&p, 0, sizeof p);
    p.diagonal = diagonal;
    p.to = -1;
    for (s = S->n_supers - 1; s >= 0; s--) {
        const sl_off begin = S->scatter_begin[s];
        sl_off end = S->scatter_begin[s + 1];
        sl_int tile = sli_last_tile(S, s);
        while (end > begin) {
            const sl_int count =
                (sl_int)(end - begin < SLI_SUM_ENTRIES ? end - begin : SLI_SUM_ENTRIES);
            end -= count;
            if (from->A != NULL) {
                sli_null_add_entries(w, S, s, end, count, from->A->x, S->scatter_from, &tile, &p);
            } else {
                sli_source_sum(from, end, count, sums);
                sli_null_add_entries(w, S, s, end, count, sums, NULL, &tile, &p);
            }
        }
    }
    sli_null_map_join(w, &p);
}

/* Has A entries that are summed? */
static int sli_map_has_duplicates(const sl_symbolic *S) {
    sl_off m;
    for (m = 1; m < S->scatter_begin[S->n_supers]; m++) {
        if (S->scatter_to[m] == S->scatter_to[m - 1]) {
            return 1;
        }
    }
    return 0;
}

/* Computes A z, |A| |z|, the components of A and, if not NULL, its diagonal, by rows of the walk.
 * z: by pivots; NULL: all 1. */
static sli_null_walk sli_null_product(const sl_symbolic *S, const sli_source *from,
                                      int by_columns, sli_null_row *rows, const double *z,
                                      double *diagonal) {
    sli_null_walk w;
    sl_int i;
    w.rows = rows;
    w.perm = by_columns ? S->perm : NULL;
    w.iperm = by_columns ? S->iperm : NULL;
    for (i = 0; i < S->n; i++) {
        rows[i].z = z == NULL ? 1.0 : z[sli_null_walk_pivot(&w, i)];
        rows[i].product = rows[i].size = 0.0;
        rows[i].entries = 0;
        rows[i].up = i;
        if (diagonal != NULL) {
            diagonal[i] = 0.0;
        }
    }
    w.is_joined = 1;
    if (!by_columns) {
        sli_null_add_map(&w, S, from, diagonal);
    } else if (sli_null_add_columns(rows, from->A, S->stats.symbolic.triangle, diagonal)) {
        sli_null_join_columns(&w, from->A, S->stats.symbolic.triangle);
    } else {
        w.is_joined = 0;
    }
    return w;
}

/* Can (A z)(i), as computed, be the rounding error of 0? */
SLI_INLINE int sli_null_row_is_zero(const sli_null_row *row) {
    const double bound = 16.0 * DBL_EPSILON * row->entries * row->size;
    return fabs(row->product) <= bound && sli_is_finite(bound);
}

/* last(k) := the last pivot of the component of pivot k. most(k) := infinity if k is such a pivot
 * and z is not a null vector of its component, else 0. */
static void sli_null_components(const sli_null_walk *w, const sl_symbolic *S, const double *z,
                                sl_int *last, double *most) {
    sl_int k, i;
    for (k = S->n - 1; k >= 0; k--) { /* descending: the last pivot comes first */
        sl_int up = S->parent[k];
        if (w->is_joined) {
            i = sli_null_walk_row(w, k);
            up = w->rows[i].up == i ? -1 : sli_null_walk_pivot(w, w->rows[i].up);
        }
        last[k] = up == -1 ? k : last[up];
        most[k] = up == -1 && z != NULL && z[k] == 0.0 ? (double)INFINITY : 0.0;
    }
    for (i = 0; i < S->n; i++) {
        if (!sli_null_row_is_zero(&w->rows[i])) {
            most[last[sli_null_walk_pivot(w, i)]] = (double)INFINITY;
        }
    }
}

/* Sets the sign and the kind of every pivot; spreads the rounding errors over the components. */
static void sli_null_kinds_fill(sl_factor *F, const sli_null_walk *w, const double *diagonal) {
    sl_int k;
    for (k = 0; k < F->S->n; k++) { /* ascending: the last pivot of a component comes last */
        const sl_int last = F->last[k];
        F->rounding[k] = F->rounding[last];
        F->rule.signs[k] = diagonal[sli_null_walk_row(w, last)] < 0.0 ? -1 : 1;
        if (!sli_is_finite(F->rounding[k])) {
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

/* The rounding error that the heaviest rows of a matrix may cause in a pivot, relative to their
 * diagonal entries. Over 80,000 meshes with weak bridges and slivers, pivots of the wrong sign
 * stayed below (128 + n/4) epsilon. The factor 16 leaves a margin. */
static double sli_null_rounding(sl_int n) {
    return 16.0 * (64.0 + n / 8) * DBL_EPSILON;
}

/* Finds the components of A and those whose null vector is known, and with them the kind of every
 * pivot. Refuses a matrix whose diagonal shows that it is indefinite. An entry that is not finite
 * is left to the factorization. */
static sl_status sli_null_vectors_check(sl_factor *F, const sli_source *from,
                                        sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const double rounding = sli_null_rounding(S->n), *diagonal = F->g;
    const sli_null_walk w =
        sli_null_product(S, from, from->A != NULL && !F->has_duplicates, F->rows, F->z, F->g);
    sl_int i, refused = S->n; /* a pivot */
    F->stats.factor.regular = 0;
    sli_null_components(&w, S, F->z, F->last, F->rounding);
    for (i = 0; i < S->n; i++) {
        const sl_int k = sli_null_walk_pivot(&w, i), last = F->last[k];
        const double of_last = diagonal[sli_null_walk_row(&w, last)];
        const double here = rounding * fabs(diagonal[i]);
        if (last != k && !sli_signs_agree(diagonal[i], of_last)) {
            refused = sli_min(refused, of_last == 0.0 ? last : k);
        }
        F->rounding[last] = here > F->rounding[last] ? here : F->rounding[last];
    }
    if (refused < S->n) {
        memset(F->D, 0, (size_t)S->n * sizeof(double)); /* no pivot is computed */
        return sli_fail(failure, SL_ERR_PIVOT, S->super_of[refused], refused, -1,
                        diagonal[sli_null_walk_row(&w, refused)]);
    }
    F->rule.rounding = F->rounding;
    sli_null_kinds_fill(F, &w, diagonal);
    sli_null_vectors_load(F);
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

/* Where null pivots are refused: may a root of the elimination forest be a null pivot that the
 * tolerance missed, because its rounding error comes from heavier rows? Reads D only. */
static int sli_null_is_suspected(const sl_factor *F) {
    const sl_symbolic *S = F->S;
    const double rounding = sli_null_rounding(S->n);
    double most = 0.0;
    sl_int k;
    for (k = 0; k < S->n && !F->rule.replaces && F->rule.null_tolerance >= 0.0; k++) {
        most = fabs(F->D[k]) > most ? fabs(F->D[k]) : most;
        if (S->parent[k] == -1) {
            if (fabs(F->D[k]) <= rounding * most) {
                return 1;
            }
            most = 0.0;
        }
    }
    return 0;
}

/* Refuses A if constants are a null vector of a component whose last pivot is suspected. Overwrites
 * L, which has 8 doubles or more for each column. */
static sl_status sli_null_suspect_check(sl_factor *F, const sli_source *from,
                                        sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const double rounding = sli_null_rounding(S->n);
    sli_null_row *rows = (sli_null_row *)(void *)F->L;
    double *most = (double *)(void *)(rows + S->n); /* n: of a last pivot: the heaviest one */
    sl_int *last = (sl_int *)(void *)(most + S->n), k;
    const sli_null_walk w = sli_null_product(S, from, 0, rows, NULL, NULL);
    sli_null_components(&w, S, NULL, last, most);
    for (k = 0; k < S->n; k++) {
        const double size = fabs(F->D[k]) > rows[k].size ? fabs(F->D[k]) : rows[k].size;
        most[last[k]] = size > most[last[k]] ? size : most[last[k]];
    }
    for (k = 0; k < S->n; k++) {
        if (last[k] == k && most[k] <= DBL_MAX && fabs(F->D[k]) <= rounding * most[k]) {
            return sli_fail(failure, SL_ERR_PIVOT, S->super_of[k], k, -1, F->D[k]);
        }
    }
    return SL_OK;
}

#endif
