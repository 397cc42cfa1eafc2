/* factored.h: a generated matrix with its analysis and its factor */
#ifndef SL_TEST_FACTORED_H
#define SL_TEST_FACTORED_H

#include "check_factor.h"

typedef struct factored_t {
    gen_matrix_t M;
    sl_symbolic *S;
    sl_factor *F;
} factored_t;

static inline factored_t factored_make(gen_kind_t kind, sl_int size, int sign, int style,
                                       const sl_options *opt) {
    gen_list_t t = gen_make(kind, size, sign, 42);
    factored_t y = {gen_store(&t, gen_style(style), 1), NULL, NULL};
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, FOR_ANALYSIS(opt), NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, FOR_FACTOR(opt), NULL));
    gen_list_free(&t);
    return y;
}

static inline void factored_free(factored_t *y) {
    sl_factor_free(y->F);
    sl_symbolic_free(y->S);
    gen_matrix_free(&y->M);
}

static inline sl_off panel_doubles(const sl_factor *F) {
    sl_symbolic_arrays v = sl_symbolic_view(sl_factor_view(F).symbolic);
    return v.panel_begin[v.n_supers];
}

static inline void assert_same_bits(const sl_factor *F, const sl_factor *G) {
    sl_factor_arrays f = sl_factor_view(F), g = sl_factor_view(G);
    size_t n = (size_t)sl_symbolic_view(f.symbolic).n, size = (size_t)panel_doubles(F);
    assert_int_equal(size, panel_doubles(G));
    if (n > 0) {
        assert_true((f.L == NULL) == (g.L == NULL));
        if (f.L != NULL) {
            assert_memory_equal(f.L, g.L, size * sizeof(double));
        } else {
            assert_memory_equal(f.L_float, g.L_float, size * sizeof(float));
        }
        assert_memory_equal(f.D, g.D, n * sizeof(double));
    }
}

/* The status of the factorization of A in natural order. */
static inline sl_status factor_natural(const sl_csc *A, sl_options opt, sl_stats *stats) {
    sl_symbolic *S = analyze_natural(A, SL_RELAXATION_DEFAULT);
    sl_factor *F = NULL;
    memset(stats, 0, sizeof *stats);
    const sl_status status = sl_factor_create(&F, S, A, &opt, stats);
    assert_true((F != NULL) == (status == SL_OK));
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

/* The same for [a b; b c]. */
static inline sl_status factor_two_rows(double a, double b, double c, sl_options opt,
                                        sl_stats *stats) {
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double x[3] = {a, b, c};
    const sl_csc A = {2, 2, p, i, x};
    return factor_natural(&A, opt, stats);
}

#endif
