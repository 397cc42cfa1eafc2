/* test_constraints_use.c: what pins refuse, and answers that would lose digits */
#include "tests/lib/factored.h"
#include "tests/lib/constraint_calls.h"

enum { N = 40 };

static void failed_factors_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 36, 1, 0, NULL);
    const size_t n = (size_t)y.M.view.n_cols;
    double *bad = test_reals((size_t)y.M.view.p[n]), x[N] = {0.0}, g = 1.0;
    sl_csc A = y.M.view;
    sl_constraints *P, *Q = (sl_constraints *)(void *)&y;
    A.x = bad; /* zeros */
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(pin_row(P, 3, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(y.F, &A, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_constraints_create(&Q, y.F, NULL));
    assert_null(Q);
    const sl_int row = 4;
    SL_EXPECT(SL_ERR_STALE, pin_row(P, row, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_constraints_add(P, &row, &g, 1, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_constraints_refactor(P, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_constraints_solve(P, NULL, x, n, x, n, &g, 1, 1, NULL));
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_STALE, pin_row(P, row, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_constraints_add(P, &row, &g, 1, NULL));
    SL_CHECK(sl_constraints_refactor(P, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, n, x, n, &g, 1, 1, NULL));
    assert_true(fabs(x[3] - g) <= 1e-14);
    sl_constraints_free(P);
    free(bad);
    factored_free(&y);
}

static void unsuited_factors_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 36, 1, 0, NULL);
    sl_symbolic *S;
    sl_factor *F;
    sl_constraints *P;
    static const sl_int p[3] = {0, 1, 2}, i[2] = {1, 0};
    static const double x[2] = {1.0, 1.0};
    const sl_csc swap = {2, 2, p, i, x}; /* [0 1; 1 0]: one 2x2 pivot */
    SL_CHECK(sl_symbolic_create_pivoted(&S, &swap, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &swap, NULL, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_constraints_create(&P, F, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);

    /* a plan of another analysis, and calls with nothing to solve */
    factored_t z = factored_make(GEN_PATH, 36, 1, 0, NULL);
    const sl_int row = 2;
    const size_t n = (size_t)y.M.view.n_cols;
    double b[N] = {0.0}, out[N] = {0.0}, g = 1.0;
    sl_plan *plan;
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(pin_row(P, 3, NULL));
    SL_CHECK(sl_plan_create(&plan, z.S, &row, 1, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_MISMATCH, sl_constraints_solve(P, plan, out, 1, b, 1, &g, 1, 1, NULL));
    sl_plan_free(plan);
    SL_CHECK(sl_plan_create(&plan, y.S, &row, 1, &row, 0, NULL, NULL));
    SL_CHECK(sl_constraints_solve(P, plan, NULL, 0, b, 1, &g, 1, 1, NULL));
    sl_plan_free(plan);
    SL_CHECK(sl_constraints_solve(P, NULL, NULL, n, NULL, n, NULL, 1, 0, NULL));
    assert_true(out[0] == 0.0);
    sl_constraints_free(P);
    factored_free(&z);
    factored_free(&y);
}

/* An equality for which C' A^-1 C overflows is refused, and the pins stay. */
static void an_overflow_is_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 36, 1, 0, NULL);
    const size_t n = (size_t)y.M.view.n_cols;
    sl_int rows[36];
    double x[N] = {0.0}, ones[36], g = 2.0;
    sl_stats stats;
    sl_constraints *P;
    for (sl_int k = 0; k < 36; k++) {
        rows[k] = k;
        ones[k] = 1.0;
    }
    for (sl_int j = 0; j < 36; j++) {
        for (sl_int k = y.M.p[j]; k < y.M.p[j + 1]; k++) {
            y.M.x[k] = y.M.i[k] == j ? 1.01 * DBL_MIN : 0.0;
        }
    }
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(pin_row(P, 3, NULL));
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_constraints_add(P, rows, ones, 36, &stats));
    assert_int_equal(stats.error.row, 0);
    assert_int_equal(pins_count(P), 1);
    SL_CHECK(sl_constraints_solve(P, NULL, x, n, x, n, &g, 1, 1, NULL));
    assert_true(fabs(x[3] - g) <= 1e-14);
    sl_constraints_free(P);
    factored_free(&y);
}

/* The same for a row, whose entry of A^-1 overflows. */
static void a_row_may_overflow(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 3, 4}, i[4] = {0, 1, 1, 2};
    static const double x[4] = {1e-300, 1e-299, 1.000000001e-298, 1.0}; /* D: 1e-300, 1e-307, 1 */
    const sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_stats stats;
    sl_symbolic *S;
    sl_factor *F;
    sl_constraints *P;
    opt.ordering = SL_ORDERING_NATURAL;
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_constraints_create(&P, F, NULL));
    SL_CHECK(pin_row(P, 2, NULL));
    SL_EXPECT(SL_ERR_NOT_FINITE, pin_row(P, 0, &stats));
    assert_int_equal(stats.error.row, 0);
    assert_int_equal(pins_count(P), 1);
    sl_constraints_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A weak mass term: without pins x is 1e11 times as large as with them. */
static void lost_digits_are_noticed(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_NONE, 0, 1, 0, NULL);
    gen_list_t t = gen_list(N);
    double B[9 * N], X[9 * N], before[9 * N];
    const double G[9] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};
    sl_constraints *P;
    factored_free(&y);
    for (sl_int k = 0; k + 1 < N; k++) {
        gen_add(&t, k + 1, k, -1.0);
        gen_add(&t, k, k, 1.0);
        gen_add(&t, k + 1, k + 1, 1.0 + (k == 20 ? 3e-12 : 0.0));
    }
    y.M = gen_store(&t, gen_style(0), 1);
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, NULL, NULL));
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(pin_row(P, 3, NULL));
    for (int k = 0; k < 9 * N; k++) {
        B[k] = 1.0 + 0.1 * (k % 7);
        X[k] = before[k] = 123.0;
    }
    SL_EXPECT(SL_ERR_INACCURATE, sl_constraints_solve(P, NULL, X, N, B, N, G, 1, 9, NULL));
    assert_memory_equal(X, before, sizeof X);
    sl_constraints_free(P);
    gen_list_free(&t);
    factored_free(&y);
}

/* All rows of a path but one are held at 0: x is 0 there, but for rounding, which is no error. */
static void zeros_between_pins_are_accurate(void **state) {
    (void)state;
    enum { ROWS = 240, FREE = 100 };
    factored_t y = factored_make(GEN_PATH, ROWS, 1, 0, NULL);
    sl_int rows[ROWS], count = 0;
    double x[ROWS], b[1] = {1.0}, g[ROWS] = {0.0};
    const sl_int at = FREE;
    sl_constraints *P;
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    for (sl_int k = 0; k < ROWS; k++) {
        rows[count] = k;
        count += k != FREE;
    }
    SL_CHECK(sl_constraints_add(P, rows, NULL, count, NULL));
    for (sl_int k = 0; k < count; k++) {
        sl_plan *plan = NULL;
        SL_CHECK(sl_plan_create(&plan, y.S, &at, 1, rows + k, 1, NULL, NULL));
        SL_CHECK(sl_constraints_solve(P, plan, x, 1, b, 1, g, ROWS, 1, NULL));
        assert_true(fabs(x[0]) <= 1e-14);
        sl_plan_free(plan);
    }
    sl_constraints_free(P);
    factored_free(&y);
}

static void a_matrix_without_rows_has_no_pins(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_NONE, 0, 1, 0, NULL);
    sl_constraints *P;
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, pin_row(P, 0, NULL));
    SL_CHECK(sl_constraints_refactor(P, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, NULL, 0, NULL, 0, NULL, 0, 1, NULL));
    sl_constraints_free(P);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(failed_factors_are_refused),
        cmocka_unit_test(unsuited_factors_are_refused),
        cmocka_unit_test(an_overflow_is_refused),
        cmocka_unit_test(a_row_may_overflow),
        cmocka_unit_test(lost_digits_are_noticed),
        cmocka_unit_test(zeros_between_pins_are_accurate),
        cmocka_unit_test(a_matrix_without_rows_has_no_pins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
