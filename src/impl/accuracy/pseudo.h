/* pseudo.h: an orthonormal basis of the null space, and the correction to the pseudo-inverse */
#ifndef SLI_ACCURACY_PSEUDO_H
#define SLI_ACCURACY_PSEUDO_H

#include "../../public/pseudo.h"
#include "parts.h"

/* A tree of the elimination forest, which holds whole components: its columns first .. root, and
 * its null pivots. */
typedef struct sli_pseudo_tree {
    sl_int first, root, count;
    const sl_int *null;
} sli_pseudo_tree;

/* The tree whose root is supernode s. */
static sli_pseudo_tree sli_pseudo_tree_of(const sl_factor *F, sl_int s) {
    const sl_symbolic *S = F->S;
    sli_pseudo_tree t;
    sl_int m;
    t.first = S->super_first[S->first_descendant[s]];
    t.root = S->super_first[s + 1] - 1;
    m = sli_lower_bound(F->null.pivots, F->null.count, t.first);
    t.null = F->null.pivots + m;
    t.count = sli_lower_bound(F->null.pivots, F->null.count, t.root + 1) - m;
    return t;
}

/* The dot product of columns a and b of arrays over the rows of a tree. */
static double sli_pseudo_dot(const sl_factor *F, const sli_pseudo_tree *t, const double *a,
                             const double *b) {
    double sum = 0.0;
    sl_int k;
    for (k = t->first; k <= t->root; k++) {
        sum += a[F->S->perm[k]] * b[F->S->perm[k]];
    }
    return sum;
}

/* a := scale a - factor b over the rows of a tree. */
static void sli_pseudo_add(const sl_factor *F, const sli_pseudo_tree *t, double *a, double scale,
                           const double *b, double factor) {
    sl_int k;
    for (k = t->first; k <= t->root; k++) {
        const sl_int row = F->S->perm[k];
        a[row] = scale * a[row] - factor * b[row];
    }
}

/* Null vectors of a tree that are known take the place of L'^-1 e_k. They are 1 in the null pivot's
 * row and 0 in those of the others. */
static void sli_pseudo_load(const sl_factor *F, const sli_pseudo_tree *t, double *Q) {
    const size_t n = (size_t)F->S->n;
    sl_int c, k;
    for (c = 0; c < t->count; c++) {
        const sl_int null = t->null[c], column = sli_null_column(F, null);
        const double *z = F->null.g + (size_t)column * n;
        for (k = t->first; k <= t->root && column != -1; k++) {
            Q[(size_t)F->S->perm[k] + (size_t)c * n] = z[k] / z[null];
        }
    }
}

/* Makes the vectors of a tree orthonormal, twice; returns the log of the determinant of Z' Z. */
static double sli_pseudo_orthonormalize(const sl_factor *F, const sli_pseudo_tree *t, double *Q) {
    const size_t n = (size_t)F->S->n;
    double log_det = 0.0;
    sl_int c, b;
    for (c = 0; c < t->count; c++) {
        double *q = Q + (size_t)c * n, norm;
        for (b = 0; b < 2 * c; b++) {
            const double *p = Q + (size_t)(b % c) * n;
            sli_pseudo_add(F, t, q, 1.0, p, sli_pseudo_dot(F, t, p, q));
        }
        norm = sqrt(sli_pseudo_dot(F, t, q, q));
        log_det += 2.0 * log(norm);
        sli_pseudo_add(F, t, q, 1.0 / norm, q, 0.0);
    }
    return log_det;
}

/* K := K - Q Q' K / 2 over the rows of a tree, where K = G Q. */
static void sli_pseudo_halve(const sl_factor *F, const sli_pseudo_tree *t, const double *Q,
                             double *K) {
    const size_t n = (size_t)F->S->n;
    sl_int c, b;
    for (c = 0; c < t->count; c++) {
        double *k = K + (size_t)c * n;
        for (b = 0; b < t->count; b++) {
            const double *q = Q + (size_t)b * n;
            sli_pseudo_add(F, t, k, 1.0, q, 0.5 * sli_pseudo_dot(F, t, q, k));
        }
    }
}

/* Numbers the components; returns the most null vectors of one. component may be NULL. */
static sl_int sli_pseudo_count(const sl_factor *F, sl_int *component) {
    const sl_symbolic *S = F->S;
    sl_int s, k, most = 0;
    for (s = 0; s < S->n_supers; s++) {
        if (S->super_parent[s] == -1) {
            const sli_pseudo_tree t = sli_pseudo_tree_of(F, s);
            most = sli_max(most, t.count);
            for (k = t.first; k <= t.root && component != NULL; k++) {
                component[S->perm[k]] = t.count == 0 ? -1 : S->perm[t.root];
            }
        }
    }
    return most;
}

SL_API sl_status sl_factor_pseudo_inverse(const sl_factor *F, sl_pseudo_inverse *P, sl_work *W) {
    const unsigned all = SL_PART_P | SL_PART_L | SL_PART_D | SL_PART_LT | SL_PART_PT;
    sl_int room, s, c;
    size_t n;
    sl_status status;
    status =
        sli_argument(F == NULL   ? "F is NULL"
                     : P == NULL ? "P is NULL"
                     : (P->Q == NULL) != (P->K == NULL) || (P->Q == NULL) != (P->component == NULL)
                         ? "P has only some of component, Q and K"
                         : NULL);
    status = status == SL_OK ? sli_singular_needed() : status;
    status = status == SL_OK ? sli_parts_check(F, all) : status;
    if (status == SL_OK && F->E != NULL) {
        status = sli_refuse(SL_ERR_UNSUPPORTED, "the pseudo-inverse with 2x2 pivots");
    }
    if (status != SL_OK) {
        return status;
    }
    room = P->columns;
    P->columns = sli_pseudo_count(F, P->component);
    P->log_det = 0.0;
    if (P->Q == NULL || P->columns == 0) {
        return SL_OK;
    }
    if (room < P->columns) {
        return sli_argument("P.columns is below the columns that are needed");
    }
    n = (size_t)F->S->n;
    memset(P->Q, 0, n * (size_t)P->columns * sizeof(double));
    for (s = 0; s < F->S->n_supers; s++) {
        const sli_pseudo_tree t = sli_pseudo_tree_of(F, s);
        for (c = 0; c < t.count && F->S->super_parent[s] == -1; c++) {
            P->Q[(size_t)t.null[c] + (size_t)c * n] = 1.0;
        }
    }
    status =
        sl_factor_solve_part(F, NULL, SL_PART_LT | SL_PART_PT, P->Q, n, P->Q, n, P->columns, W);
    for (s = 0; s < F->S->n_supers && status == SL_OK; s++) {
        if (F->S->super_parent[s] == -1) {
            const sli_pseudo_tree t = sli_pseudo_tree_of(F, s);
            sli_pseudo_load(F, &t, P->Q);
            P->log_det += sli_pseudo_orthonormalize(F, &t, P->Q);
        }
    }
    if (status == SL_OK) {
        status = sl_factor_solve_part(F, NULL, all, P->K, n, P->Q, n, P->columns, W);
    }
    for (s = 0; s < F->S->n_supers && status == SL_OK; s++) {
        if (F->S->super_parent[s] == -1) {
            const sli_pseudo_tree t = sli_pseudo_tree_of(F, s);
            sli_pseudo_halve(F, &t, P->Q, P->K);
        }
    }
    return status;
}

#endif
