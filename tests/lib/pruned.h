/* pruned.h: a matrix that stores both triangles with different patterns and values */
#ifndef SL_TEST_PRUNED_H
#define SL_TEST_PRUNED_H

#include "factored.h"

/* A matrix that stores both triangles, with entries pruned on either side and different values in
 * the two triangles, and its triangles as matrices of their own. */
typedef struct pruned_t {
    sl_int n;
    sl_matrix *both, *lower, *upper;
    double *x;           /* copy of the values of both, writable */
    sl_csc A;            /* view of both with the values x */
    sl_int missing_up;   /* entries below the diagonal without mirror image */
    sl_int missing_down; /* entries above the diagonal without mirror image */
} pruned_t;

static inline sl_matrix *from_list(const gen_list_t *t, int is_upper) {
    sl_matrix *M = NULL;
    SL_CHECK(sl_matrix_from_triplets(&M, t->n, t->n, (sl_off)t->count, is_upper ? t->col : t->row,
                                     is_upper ? t->row : t->col, t->x, NULL, NULL));
    return M;
}

/* The lower triangle lacks every third edge, the upper triangle the one after it and has half the
 * values, so that all rows stay diagonally dominant. */
static inline pruned_t pruned_make(gen_kind_t kind, sl_int size) {
    gen_list_t t = gen_make(kind, size, 0, 11), lower = gen_list(t.n), upper = gen_list(t.n);
    pruned_t y;
    sl_csc parts[2], both;
    sl_int edge = 0;
    memset(&y, 0, sizeof y);
    y.n = t.n;
    for (size_t k = 0; k < t.count; k++) {
        const int is_edge = t.row[k] != t.col[k];
        edge += is_edge;
        if (!is_edge || edge % 3 != 0) {
            gen_add(&lower, t.row[k], t.col[k], t.x[k]);
            y.missing_up += is_edge && edge % 3 == 1;
        }
        if (!is_edge || edge % 3 != 1) {
            gen_add(&upper, t.row[k], t.col[k], is_edge ? t.x[k] / 2 : t.x[k]);
            y.missing_down += is_edge && edge % 3 == 0;
        }
    }
    y.lower = from_list(&lower, 0);
    y.upper = from_list(&upper, 1);
    parts[0] = sl_matrix_view(y.lower);
    parts[1] = sl_matrix_view(y.upper);
    /* both: the columns of upper without their diagonals, then those of lower */
    const size_t room = lower.count + upper.count;
    sl_int *i = test_ints(room), *j = test_ints(room);
    double *x = test_reals(room);
    size_t count = 0;
    for (int side = 0; side < 2; side++) {
        for (sl_int c = 0; c < y.n; c++) {
            for (sl_int p = parts[side].p[c]; p < parts[side].p[c + 1]; p++) {
                if (side == 0 || parts[side].i[p] != c) {
                    i[count] = parts[side].i[p];
                    j[count] = c;
                    x[count++] = parts[side].x[p];
                }
            }
        }
    }
    SL_CHECK(sl_matrix_from_triplets(&y.both, y.n, y.n, (sl_off)count, i, j, x, NULL, NULL));
    both = sl_matrix_view(y.both);
    y.x = test_reals(count);
    if (count > 0) {
        memcpy(y.x, both.x, count * sizeof *y.x);
    }
    y.A = both;
    y.A.x = y.x;
    free(i);
    free(j);
    free(x);
    gen_list_free(&t);
    gen_list_free(&lower);
    gen_list_free(&upper);
    return y;
}

static inline void pruned_free(pruned_t *y) {
    sl_matrix_free(y->both);
    sl_matrix_free(y->lower);
    sl_matrix_free(y->upper);
    free(y->x);
}

/* The triangle that is read, as a matrix of its own. */
static inline sl_csc pruned_read(const pruned_t *y, sl_triangle triangle) {
    return sl_matrix_view(triangle == SL_TRIANGLE_LOWER ? y->lower : y->upper);
}

/* Is entry p of column j on the side of the diagonal that is not read? */
static inline int is_ignored(const pruned_t *y, sl_triangle triangle, sl_int p, sl_int j) {
    return triangle == SL_TRIANGLE_LOWER ? y->A.i[p] < j : y->A.i[p] > j;
}

static inline int stores(const sl_csc *A, sl_int row, sl_int column) {
    for (sl_int p = A->p[column]; p < A->p[column + 1]; p++) {
        if (A->i[p] == row) {
            return 1;
        }
    }
    return 0;
}

#endif
