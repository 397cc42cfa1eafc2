/* components.h: the components of A, and A z for a candidate z of its null space */
#ifndef SLI_FACTOR_COMPONENTS_H
#define SLI_FACTOR_COMPONENTS_H

#include "../analysis/structure.h"
#include "panel_load.h"

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

/* A walk along the map, backward. */
typedef struct sli_null_map_state {
    const sl_symbolic *S;
    sl_int s, tile;   /* of the entry: its supernode and its row tile */
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

/* Adds the map entries first .. first+count-1 of the current supernode. Runs backward. from: where
 * each value is; NULL: values are those of the entries. */
SLI_HOT static void sli_null_add_entries(const sli_null_walk *w, sli_null_map_state *p,
                                         sl_off first, sl_int count, const double *values,
                                         const sl_int *from) {
    const sl_symbolic *S = p->S;
    sl_int m;
    for (m = count - 1; m >= 0; m--) {
        const double a = values[from != NULL ? from[first + m] : m];
        if (S->scatter_to[first + m] != p->to) {
            sli_null_map_join(w, p);
            sli_scatter_map_pivots(S, p->s, first + m, &p->tile, &p->k, &p->j);
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
SLI_HOT static void sli_null_add_map(const sli_null_walk *w, const sl_symbolic *S,
                                     const sli_source *from, double *diagonal) {
    double sums[SLI_SUM_ENTRIES];
    sli_null_map_state p;
    SLI_CLEAR(p);
    p.S = S;
    p.diagonal = diagonal;
    p.to = -1;
    for (p.s = S->n_supers - 1; p.s >= 0; p.s--) {
        const sl_off begin = S->scatter_begin[p.s];
        sl_off end = S->scatter_begin[p.s + 1];
        p.tile = sli_last_tile(S, p.s);
        while (end > begin) {
            const sl_int count =
                (sl_int)(end - begin < SLI_SUM_ENTRIES ? end - begin : SLI_SUM_ENTRIES);
            end -= count;
            if (from->A != NULL) {
                sli_null_add_entries(w, &p, end, count, from->A->x, S->scatter_from);
            } else {
                sli_source_sum(from, end, count, sums);
                sli_null_add_entries(w, &p, end, count, sums, NULL);
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

/* Begins A z, |A| |z|, the components of A and, if not NULL, its diagonal, by rows of the walk.
 * z: by pivots; NULL: all 1. */
SLI_HOT static sli_null_walk sli_null_walk_begin(const sl_symbolic *S, int by_columns,
                                                 sli_null_row *rows, const double *z,
                                                 double *diagonal) {
    sli_null_walk w;
    sl_int i;
    w.rows = rows;
    w.perm = by_columns ? S->perm : NULL;
    w.iperm = by_columns ? S->iperm : NULL;
    w.is_joined = 1;
    for (i = 0; i < S->n; i++) {
        rows[i].z = z == NULL ? 1.0 : z[sli_null_walk_pivot(&w, i)];
        rows[i].product = rows[i].size = 0.0;
        rows[i].entries = 0;
        rows[i].up = i;
        if (diagonal != NULL) {
            diagonal[i] = 0.0;
        }
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

#endif
