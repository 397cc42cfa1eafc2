/* product.h: A z for a candidate z of the null space of A, by columns or along the map */
#ifndef SLI_SINGULAR_PRODUCT_H
#define SLI_SINGULAR_PRODUCT_H

#include "../factor/components.h"

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

/* Computes A z, |A| |z|, the components of A and, if not NULL, its diagonal, by rows of the walk.
 * z: by pivots. */
SLI_HOT static sli_null_walk sli_null_product(sl_factor *F, const sli_source *from, const double *z,
                                              double *diagonal) {
    const sl_symbolic *S = F->S;
    const sl_triangle triangle = S->stats.symbolic.triangle;
    const int by_columns = from->A != NULL && !F->null.has_duplicates;
    sli_null_walk w = sli_null_walk_begin(S, by_columns, F->null.rows, z, diagonal);
    if (!by_columns) {
        sli_null_add_map(&w, S, from, diagonal);
    } else if (sli_null_add_columns(w.rows, from->A, triangle, diagonal)) {
        sli_null_join_columns(&w, from->A, triangle);
    } else {
        w.is_joined = 0;
    }
    return w;
}

#endif
