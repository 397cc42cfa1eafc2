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

/* The last pivot of the component of row k, as far as entries were joined. Halves the path. */
SLI_INLINE sl_int sli_component_last(sli_null_row *rows, sl_int k) {
    while (rows[k].last != k) {
        rows[k].last = rows[rows[k].last].last;
        k = rows[k].last;
    }
    return k;
}

/* What is left of a product with A. The entries come backward; duplicates are neighbors. */
typedef struct sli_null_product_state {
    sli_null_row *rows;
    double *diagonal; /* n: the diagonal of A; NULL: not needed */
    sl_off to;        /* where the last entry goes in L; -1: none */
    sl_int k, j;      /* its pivots */
    double value;     /* the sum of the duplicates so far */
} sli_null_product_state;

/* Joins the components of the entry that is complete now. */
SLI_INLINE void sli_null_product_join(const sli_null_product_state *p) {
    if (p->to != -1 && p->k != p->j && p->value != 0.0) {
        const sl_int x = sli_component_last(p->rows, p->k), y = sli_component_last(p->rows, p->j);
        p->rows[sli_min(x, y)].last = sli_max(x, y);
    }
}

/* Adds the map entries first .. first+count-1 of supernode s, whose values are a. Runs backward. */
static void sli_null_product_add(const sl_symbolic *S, sl_int s, sl_off first, sl_int count,
                                 const double *values, const sl_int *scatter_from, sl_int *tile,
                                 sli_null_product_state *p) {
    sli_null_row *rows = p->rows;
    sl_int m;
    for (m = count - 1; m >= 0; m--) {
        const double a = values[scatter_from != NULL ? scatter_from[first + m] : m];
        double term;
        if (S->scatter_to[first + m] != p->to) {
            sli_null_product_join(p);
            sli_scatter_map_pivots(S, s, first + m, tile, &p->k, &p->j);
            p->to = S->scatter_to[first + m];
            p->value = 0.0;
        }
        p->value += a;
        term = a * rows[p->j].z;
        rows[p->k].product += term;
        rows[p->k].size += fabs(term);
        rows[p->k].entries++;
        if (p->k != p->j) {
            term = a * rows[p->k].z;
            rows[p->j].product += term;
            rows[p->j].size += fabs(term);
            rows[p->j].entries++;
        } else if (p->diagonal != NULL) {
            p->diagonal[p->k] += a;
        }
    }
}

/* Computes A z, |A| |z|, the components of A and, if not NULL, its diagonal. Supernodes descend:
 * most rows then find the last pivot of their component at once. */
static void sli_null_product(const sl_symbolic *S, const sli_source *from, sli_null_row *rows,
                             double *diagonal) {
    double sums[SLI_SUM_ENTRIES];
    sli_null_product_state p;
    sl_int s, k;
    memset(&p, 0, sizeof p);
    p.rows = rows;
    p.diagonal = diagonal;
    p.to = -1;
    for (k = 0; k < S->n; k++) {
        rows[k].product = rows[k].size = 0.0;
        rows[k].entries = 0;
        rows[k].last = k;
        if (diagonal != NULL) {
            diagonal[k] = 0.0;
        }
    }
    for (s = S->n_supers - 1; s >= 0; s--) {
        const sl_off begin = S->scatter_begin[s];
        sl_off end = S->scatter_begin[s + 1];
        sl_int tile = sli_last_tile(S, s);
        while (end > begin) {
            const sl_int count =
                (sl_int)(end - begin < SLI_SUM_ENTRIES ? end - begin : SLI_SUM_ENTRIES);
            end -= count;
            if (from->A != NULL) {
                sli_null_product_add(S, s, end, count, from->A->x, S->scatter_from, &tile, &p);
            } else {
                sli_source_sum(from, end, count, sums);
                sli_null_product_add(S, s, end, count, sums, NULL, &tile, &p);
            }
        }
    }
    sli_null_product_join(&p);
}

/* Can (A z)(k), as computed, be the rounding error of 0? */
SLI_INLINE int sli_null_row_is_zero(const sli_null_row *row) {
    const double bound = 16.0 * DBL_EPSILON * row->entries * row->size;
    return fabs(row->product) <= bound && sli_is_finite(bound);
}

/* After sli_null_product: the last pivots of all components are final, and `entries` of the last
 * row becomes 1 if z is a null vector of the component, 0 if not. */
static void sli_null_components(sli_null_row *rows, sl_int n) {
    sl_int k;
    for (k = n - 1; k >= 0; k--) { /* descending: the last pivot comes first */
        rows[k].last = rows[k].last == k ? k : rows[rows[k].last].last;
        rows[k].entries = sli_null_row_is_zero(&rows[k]) && (rows[k].last != k || rows[k].z != 0.0);
        if (!rows[k].entries) {
            rows[rows[k].last].entries = 0;
        }
    }
}

/* Sets the kind of every pivot. */
static void sli_null_kinds_fill(sl_factor *F) {
    sl_int k;
    for (k = 0; k < F->S->n; k++) {
        const sl_int last = F->rows[k].last;
        if (!F->rows[last].entries) {
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
        const sl_int last = F->rows[k].last;
        if (last != k && last != only && F->rule.kinds[last] == SLI_PIVOT_NULL) {
            only = last; /* two components may alternate: then more than one is counted anyway */
            count++;
        }
        if (S->parent[k] == -1) {
            for (; first <= k; first++) {
                F->g[first] = count == 1 && F->rows[first].last == only ? F->rows[first].z : 0.0;
            }
            count = 0;
            only = -1;
        }
    }
}

/* g := L' g in the columns of supernode s; the rows below still hold z. z: scratch for the rows of
 * the front. */
static void sli_null_vectors_multiply(const sl_factor *F, sl_int s, double *z) {
    const sl_symbolic *S = F->S;
    const sli_step *step = &S->steps[s];
    const sl_int w = step->width, height = w + step->below;
    const sl_int *rows = S->rows + S->rows_begin[s];
    double *g = F->g + step->column;
    sl_int t, j, r;
    for (r = 0; r < SLI_TILE * sli_tiles(height); r++) {
        z[r] = r < w ? g[r] : r < height ? F->g[rows[r - w]] : 0.0;
    }
    for (t = 0; t < sli_tiles(height); t++) {
        const double *tile = F->L + step->panel + sli_tile_offset(w, t);
        for (j = 0; j < sli_min(w, SLI_TILE * (t + 1)); j++) {
            const double *l = tile + SLI_TILE * (ptrdiff_t)j, *x = z + SLI_TILE * (ptrdiff_t)t;
            /* g(j) += L(rows, j)' z(rows); the pairs are independent of each other */
            g[j] += ((l[0] * x[0] + l[1] * x[1]) + (l[2] * x[2] + l[3] * x[3])) +
                    ((l[4] * x[4] + l[5] * x[5]) + (l[6] * x[6] + l[7] * x[7]));
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
    sl_int k, refused = -1;
    F->stats.factor.regular = 0;
    for (k = 0; k < S->n; k++) {
        F->rows[k].z = F->z[k];
    }
    sli_null_product(S, from, F->rows, F->g);
    sli_null_components(F->rows, S->n);
    memset(F->rounding, 0, (size_t)S->n * sizeof(double));
    for (k = 0; k < S->n; k++) {
        const sl_int last = F->rows[k].last;
        const double here = rounding * fabs(diagonal[k]);
        if (refused == -1 && last != k && !sli_signs_agree(diagonal[k], diagonal[last])) {
            refused = diagonal[last] == 0.0 ? last : k;
        }
        F->rule.signs[k] = diagonal[last] < 0.0 ? -1 : 1;
        F->rounding[last] = here > F->rounding[last] ? here : F->rounding[last];
    }
    for (k = 0; k < S->n; k++) { /* ascending: the last pivot of a component comes last */
        F->rounding[k] = F->rounding[F->rows[k].last];
    }
    if (refused != -1) {
        memset(F->D, 0, (size_t)S->n * sizeof(double)); /* no pivot is computed */
        return sli_fail(failure, SL_ERR_PIVOT, S->super_of[refused], refused, -1,
                        diagonal[refused]);
    }
    F->rule.rounding = F->rounding;
    sli_null_kinds_fill(F);
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
    sl_int k;
    for (k = 0; k < S->n; k++) {
        rows[k].z = 1.0;
    }
    sli_null_product(S, from, rows, NULL);
    sli_null_components(rows, S->n);
    for (k = 0; k < S->n; k++) { /* the heaviest pivot of each component, in its last row */
        double *most = &rows[rows[k].last].size; /* at least the diagonal entry's share already */
        *most = fabs(F->D[k]) > *most ? fabs(F->D[k]) : *most;
    }
    for (k = 0; k < S->n; k++) {
        if (rows[k].last == k && rows[k].entries && fabs(F->D[k]) <= rounding * rows[k].size) {
            return sli_fail(failure, SL_ERR_PIVOT, S->super_of[k], k, -1, F->D[k]);
        }
    }
    return SL_OK;
}

#endif
