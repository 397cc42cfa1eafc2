/* test_save_limits.c: what a loaded factor keeps: limits of growth and of errors, lost digits */
#include "tests/lib/saved.h"

/* A 2 x 2 matrix whose growth is about 1 / a. */
static void the_growth_limit_is_kept(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    double x[3] = {1.0, 1.0, 3.0};
    const sl_csc A = {2, 2, p, i, x};
    const sl_int first = 0;
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_options opt = options_none();
    sl_stats stats;
    S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    opt.growth_limit = 1e5;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
    saved_t m = saved_make(S, F);
    for (int changed = 0; changed < 2; changed++) {
        SL_CHECK(pair_load_memory(&T, &G, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
        for (int k = 0; k < 2; k++) {
            const sl_status expected = k == 0 ? SL_OK : SL_ERR_INACCURATE;
            x[0] = k == 0 ? 1e-4 : 1e-6;
            SL_EXPECT(expected,
                      changed ? sl_factor_change_entries(G, &A, NULL, &first, NULL, 1, NULL, &stats)
                              : sl_factor_refactor(G, &A, &stats));
            assert_true(stats.factor.growth > (k == 0 ? 1e3 : 1e5));
        }
        sl_factor_free(G);
        sl_symbolic_free(T);
    }
    saved_free(&m);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Digits that changes have lost: the loaded factor says so by its growth. */
static void a_drift_is_kept_as_growth(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1}, row = 1, column = 0;
    const double a[3] = {-0.36, 46545.14, 0.28}, delta = 0.62 - a[1];
    const sl_csc A = {2, 2, p, i, a};
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_stats before, after;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_factor_change_entries(F, NULL, &row, &column, &delta, 1, NULL, &before));
    saved_t m = saved_make(S, F);
    SL_CHECK(pair_load_memory(&T, &G, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
    after.factor = sl_factor_view(G).info;
    assert_true(before.change.drift > 1e-11);
    assert_true(DBL_EPSILON * after.factor.growth >= 0.9 * before.change.drift);
    assert_same_answers(F, G);
    sl_factor_free(G);
    sl_symbolic_free(T);
    sl_factor_free(F);
    sl_symbolic_free(S);
    saved_free(&m);
}

/* What a row has lost remains when the factor is saved before it falls. */
static void a_drift_goes_on_after_loading(void **state) {
    (void)state;
    enum { N = 100, ROW = 44 };
    const sl_int row = ROW;
    double b[N] = {0.0}, x[N], y[N], error = 0.0, size = 0.0;
    factored_t f = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_symbolic *T = NULL;
    sl_factor *G = NULL;
    sl_stats before, after;
    double weight = 1e10 / 3.0, delta = weight;
    SL_CHECK(sl_factor_change_entries(f.F, NULL, &row, &row, &delta, 1, NULL, NULL));
    for (; weight > 1e8; weight += delta) {
        delta = -0.5 * weight;
        SL_CHECK(sl_factor_change_entries(f.F, NULL, &row, &row, &delta, 1, NULL, &before));
    }
    saved_t m = saved_make(f.S, f.F);
    SL_CHECK(pair_load_memory(&T, &G, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
    SL_CHECK(sl_factor_change_entries(G, NULL, NULL, NULL, NULL, 0, NULL, &after));
    assert_true(before.change.drift < 1e-11 && after.change.drift == before.change.drift);
    for (; weight > 0.0; weight += delta) {
        delta = weight > 1.0 ? -0.5 * weight : -weight;
        SL_CHECK(sl_factor_change_entries(G, NULL, &row, &row, &delta, 1, NULL, &after));
    }
    b[ROW] = 1.0;
    SL_CHECK(sl_factor_refactor(f.F, &f.M.view, NULL));
    SL_CHECK(sl_factor_solve(f.F, x, N, b, N, 1, NULL));
    SL_CHECK(sl_factor_solve(G, y, N, b, N, 1, NULL));
    for (int k = 0; k < N; k++) {
        error = fmax(error, fabs(x[k] - y[k]));
        size = fmax(size, fabs(x[k]));
    }
    assert_true(error > 1e-9 * size && after.change.drift * size >= 0.1 * error);
    assert_true(after.change.drift <= 1e-3);
    sl_factor_free(G);
    sl_symbolic_free(T);
    factored_free(&f);
    saved_free(&m);
}

/* A refinement with the factor of another matrix ends above every limit but none. */
static void the_error_limit_is_kept(void **state) {
    (void)state;
    enum { N = 100 };
    double b[N], x[N], y[N];
    saved_call_t calls[2] = {pair_load_memory, pair_map_memory};
    for (int limited = 0; limited < 2; limited++) {
        sl_options opt = options_none();
        opt.error_limit = limited ? 0.0 : -1.0;
        factored_t f = factored_make(GEN_GRID2, N, 1, 0, &opt);
        const sl_status expected = limited ? SL_ERR_INACCURATE : SL_OK;
        saved_t m = saved_make(f.S, f.F);
        gen_reals(b, N, 5);
        for (sl_int p = 0; p < f.M.p[N]; p++) {
            f.M.x[p] *= 1000.0;
        }
        memset(x, 0, sizeof x);
        SL_EXPECT(expected, sl_factor_refine(f.F, &f.M.view, x, N, b, N, 1, 3, NULL, NULL));
        for (int k = 0; k < 2; k++) {
            sl_symbolic *S = NULL;
            sl_factor *F = NULL;
            memset(y, 0, sizeof y);
            SL_CHECK(calls[k](&S, &F, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
            SL_EXPECT(expected, sl_factor_refine(F, &f.M.view, y, N, b, N, 1, 3, NULL, NULL));
            assert_memory_equal(x, y, sizeof x);
            sl_factor_free(F);
            sl_symbolic_free(S);
        }
        saved_free(&m);
        factored_free(&f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_growth_limit_is_kept),
        cmocka_unit_test(a_drift_is_kept_as_growth),
        cmocka_unit_test(a_drift_goes_on_after_loading),
        cmocka_unit_test(the_error_limit_is_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
