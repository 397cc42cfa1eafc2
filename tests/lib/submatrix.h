/* submatrix.h: a factor, its restriction to a set of rows, and what has to hold for it */
#ifndef SL_TEST_SUBMATRIX_H
#define SL_TEST_SUBMATRIX_H

#include "local_solve.h"
#include "subset.h"

typedef struct submatrix_t {
    factored_t y;
    sl_int count, *rows;
    gen_matrix_t B; /* A[R, R] */
    sl_symbolic *S;
    sl_factor *G;
    sl_stats stats;
} submatrix_t;

static inline submatrix_t submatrix_make(gen_kind_t kind, sl_int size, int sign, int style,
                                         int shape, const sl_options *opt) {
    submatrix_t t;
    memset(&t, 0, sizeof t);
    t.y = factored_make(kind, size, sign, style, opt);
    const sl_csc *A = &t.y.M.view;
    t.rows = test_ints((size_t)A->n_cols);
    t.count = subset_fill(t.rows, A->n_cols, shape, t.y.S);
    t.B = subset_matrix(A, t.rows, t.count);
    SL_CHECK(sl_factor_submatrix(&t.S, &t.G, t.y.F, A, t.rows, t.count, NULL, &t.stats));
    return t;
}

static inline void submatrix_free(submatrix_t *t) {
    sl_factor_free(t->G);
    sl_symbolic_free(t->S);
    gen_matrix_free(&t->B);
    free(t->rows);
    factored_free(&t->y);
}

/* The structure, L D L' = P A[R, R] P' entry by entry, residuals, and local solves bit for bit. */
static inline void submatrix_check(const submatrix_t *t) {
    const sl_symbolic_arrays v = sl_symbolic_view(t->S);
    sl_int n = t->count;
    assert_int_equal(v.n, n);
    NOTHING_WRONG(check_permutation(n, v.perm, v.iperm));
    NOTHING_WRONG(check_supernodes(&v));
    NOTHING_WRONG(check_factor(t->G, &t->B.view));
    assert_int_equal(t->stats.submatrix.kept + t->stats.submatrix.computed, n);
    assert_true(t->stats.submatrix.is_anew == 0 || t->stats.submatrix.kept == 0);
    assert_int_equal(t->stats.factor.positive + t->stats.factor.negative, n);
    double *B = test_reals(2 * (size_t)n), *X = test_reals(2 * (size_t)n);
    gen_reals(B, 2 * (size_t)n, 3);
    size_t ld = n > 0 ? (size_t)n : 1;
    SL_CHECK(sl_factor_solve(t->G, X, ld, B, ld, 2, NULL));
    BACKWARD_PASSES(&t->B.view, X, ld, B, ld, 2);
    if (n > 2) {
        local_solve_t q = local_solve_random(t->G, n, n / 3, n / 2, 2, 5);
        local_solve_check(t->S, t->G, &q, NULL);
        local_solve_free(&q);
    }
    free(B);
    free(X);
}

#endif
