/* matrix_pair.h: two matrices of different patterns, analyzed and scattered to their union */
#ifndef SL_TEST_MATRIX_PAIR_H
#define SL_TEST_MATRIX_PAIR_H

#include "factored.h"

enum { TERMS = 2 };

typedef struct matrix_pair_t {
    sl_int n;
    /* M: a diagonal with some of the edges of K; K: any kind of gen_matrices.h */
    gen_matrix_t M, K;
    sl_csc terms[TERMS];
    sl_matrix *U; /* union of their patterns */
    sl_symbolic *S;
    double *values[TERMS];
} matrix_pair_t;

/* The diagonal has the signs of K's diagonal, so that sums with positive coefficients are as
 * definite as K. Every third edge of K is added, too small to change that. */
static inline gen_list_t matrix_pair_mass(const gen_list_t *K, uint64_t seed) {
    gen_list_t t = gen_list(K->n);
    for (size_t k = 0; k < K->count; k++) {
        if (K->row[k] == K->col[k]) {
            gen_add(&t, K->row[k], K->row[k], copysign(1.0 + fabs(gen_real(&seed)), K->x[k]));
        } else if (k % 3 == 0) {
            gen_add(&t, K->row[k], K->col[k], K->x[k] / 64);
        }
    }
    return t;
}

static inline matrix_pair_t matrix_pair_make(gen_kind_t kind, sl_int size, int style_m, int style_k,
                                             const sl_options *opt) {
    gen_list_t k = gen_make(kind, size, 1, 42), m = matrix_pair_mass(&k, 7);
    matrix_pair_t y;
    memset(&y, 0, sizeof y);
    y.n = k.n;
    y.M = gen_store(&m, gen_style(style_m), 1);
    y.K = gen_store(&k, gen_style(style_k), 2);
    y.terms[0] = y.M.view;
    y.terms[1] = y.K.view;
    SL_CHECK(sl_matrix_sum(&y.U, NULL, y.terms, TERMS, NULL, NULL));
    sl_csc U = sl_matrix_view(y.U);
    assert_null(U.x);
    SL_CHECK(sl_symbolic_create(&y.S, &U, opt, NULL));
    for (int t = 0; t < TERMS; t++) {
        y.values[t] = test_reals((size_t)scatter_length(y.S));
        SL_CHECK(sl_symbolic_scatter(y.S, y.values[t], &y.terms[t], NULL));
    }
    gen_list_free(&k);
    gen_list_free(&m);
    return y;
}

static inline void matrix_pair_free(matrix_pair_t *y) {
    gen_matrix_free(&y->M);
    gen_matrix_free(&y->K);
    sl_matrix_free(y->U);
    sl_symbolic_free(y->S);
    for (int t = 0; t < TERMS; t++) {
        free(y->values[t]);
    }
}

/* c[0] M + c[1] K with the pattern of the union; the caller frees it. */
static inline sl_matrix *matrix_pair_sum(const matrix_pair_t *y, const double *c) {
    sl_matrix *A = NULL;
    SL_CHECK(sl_matrix_sum(&A, c, y->terms, TERMS, NULL, NULL));
    return A;
}

static inline const double *const *matrix_pair_values(const matrix_pair_t *y) {
    return (const double *const *)y->values;
}

/* The factor of c[0] M + c[1] K by sl_matrix_sum and sl_factor_create. */
static inline sl_factor *matrix_pair_factor(const matrix_pair_t *y, const double *c,
                                            const sl_options *opt) {
    sl_matrix *A = matrix_pair_sum(y, c);
    sl_csc view = sl_matrix_view(A);
    sl_factor *F = NULL;
    SL_CHECK(sl_factor_create(&F, y->S, &view, opt, NULL));
    sl_matrix_free(A);
    return F;
}

#endif
