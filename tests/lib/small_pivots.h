/* small_pivots.h: a matrix is factored and its solves are checked; blocks beside unrelated rows */
#ifndef SL_TEST_SMALL_PIVOTS_H
#define SL_TEST_SMALL_PIVOTS_H

#include "factored.h"
#include "random_systems.h"

/* Entry (i, j) of the lower triangle of a square array. */
#define CELL(M, n, i, j) (M)[(size_t)(i) * (size_t)(n) + (size_t)(j)]

/* Factors M; returns the status. With SL_OK the backward error of a solve is small. */
static inline sl_status factor_and_solve(const gen_matrix_t *M, const sl_options *opt,
                                         sl_stats *stats) {
    const sl_int n = M->view.n_cols;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    memset(stats, 0, sizeof *stats);
    SL_CHECK(sl_symbolic_create(&S, &M->view, FOR_ANALYSIS(opt), NULL));
    const sl_status status = sl_factor_create(&F, S, &M->view, FOR_FACTOR(opt), stats);
    if (status == SL_OK && opt->storage == SL_STORAGE_DOUBLE) {
        double *b = test_reals((size_t)n), *x = test_reals((size_t)n);
        gen_reals(b, (size_t)n, 5);
        SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
        assert_true(worst_backward(&M->view, x, (size_t)n, b, (size_t)n, 1) <=
                    16.0 * DBL_EPSILON * fmax(stats->factor.growth, 4.0));
        free(b);
        free(x);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

/* The lower triangle of an m x m block as the first rows of a matrix of n rows; the others have a
 * diagonal entry of 1. */
static inline gen_matrix_t beside(const double *block, sl_int m, sl_int n) {
    gen_list_t t = gen_list(n);
    for (sl_int i = 0; i < m; i++) {
        for (sl_int j = 0; j <= i; j++) {
            if (i == j || CELL(block, m, i, j) != 0.0) {
                gen_add(&t, i, j, CELL(block, m, i, j));
            }
        }
    }
    for (sl_int i = m; i < n; i++) {
        gen_add(&t, i, i, 1.0);
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

#endif
