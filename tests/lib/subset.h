/* subset.h: sets of rows of several shapes, and the principal submatrix of such a set */
#ifndef SL_TEST_SUBSET_H
#define SL_TEST_SUBSET_H

#include "factored.h"

enum {
    SUBSET_NONE,    /* no row */
    SUBSET_ONE,     /* one row */
    SUBSET_ALL,     /* every row, backwards */
    SUBSET_BUT_ONE, /* all but the first column of L */
    SUBSET_HALF,    /* the first half of the rows: of a grid, half of the mesh */
    SUBSET_STRIPES, /* every other run of 5 rows */
    SUBSET_RANDOM,  /* half of the rows, in random order */
    SUBSET_MOST,    /* nine of ten, in random order */
    SUBSET_FEW,     /* one of ten, in random order */
    SUBSET_TOP,     /* the last third of the columns of L */
    SUBSET_BOTTOM,  /* the first two thirds of the columns of L */
    SUBSET_SHAPES
};

/* Writes the rows of a shape, room for n; returns how many. */
static inline sl_int subset_fill(sl_int *rows, sl_int n, int shape, const sl_symbolic *S) {
    const sl_int *perm = sl_symbolic_view(S).perm;
    sl_int count = 0;
    if (shape >= SUBSET_RANDOM && shape <= SUBSET_FEW) {
        gen_permutation(rows, n, 17);
        return shape == SUBSET_RANDOM ? n / 2 : shape == SUBSET_MOST ? n - n / 10 : n / 10;
    }
    for (sl_int k = 0; k < n; k++) {
        int in = shape == SUBSET_ONE       ? k == n / 2
                 : shape == SUBSET_ALL     ? 1
                 : shape == SUBSET_BUT_ONE ? k > 0
                 : shape == SUBSET_HALF    ? k < n / 2
                 : shape == SUBSET_STRIPES ? k / 5 % 2
                 : shape == SUBSET_TOP     ? k >= n - n / 3
                 : shape == SUBSET_BOTTOM  ? k < n - n / 3
                                           : 0;
        if (in) {
            rows[count++] = shape == SUBSET_ALL                               ? n - 1 - k
                            : shape == SUBSET_HALF || shape == SUBSET_STRIPES ? k
                                                                              : perm[k];
        }
    }
    return count;
}

/* The lower triangle of A[R, R]; of A the triangle that is read. */
static inline gen_matrix_t subset_matrix(const sl_csc *A, const sl_int *rows, sl_int count) {
    sl_int *number = test_ints((size_t)A->n_cols);
    sl_triangle triangle;
    gen_list_t t = gen_list(count);
    gen_style_t style = {SL_TRIANGLE_LOWER, 0, 0};
    SL_CHECK(sl_csc_triangle(A, &triangle, NULL, NULL));
    for (sl_int k = 0; k < count; k++) {
        number[rows[k]] = k + 1;
    }
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            sl_int i = A->i[p];
            if (number[i] > 0 && number[j] > 0 && (triangle != SL_TRIANGLE_BOTH || i >= j)) {
                gen_add(&t, number[i] - 1, number[j] - 1, A->x[p]);
            }
        }
    }
    gen_matrix_t M = gen_store(&t, style, 1);
    gen_list_free(&t);
    free(number);
    return M;
}

#endif
