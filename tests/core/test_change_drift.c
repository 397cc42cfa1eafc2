/* test_change_drift.c: drift and growth of changed factors: what is left, what was lost */
#include "tests/lib/factored.h"

/* A spring of 1e10 comes and goes: what rounding has left is large beside the entries that remain,
 * and the drift says so, also if others come and go afterwards. */
static void drift_is_relative_to_what_remains(void **state) {
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        factored_t y = factored_make(GEN_GRID2, 100, sign, 0, NULL);
        const sl_int row = 44, other = 3;
        double b[100], x[100], r[100], delta = 1e10 * sign / 3.0, error = 0.0;
        sl_stats stats;
        SL_CHECK(sl_factor_change_entries(y.F, NULL, &row, &row, &delta, 1, NULL, &stats));
        assert_true(stats.change.drift <= 1e-14);
        delta = -delta;
        SL_CHECK(sl_factor_change_entries(y.F, NULL, &row, &row, &delta, 1, NULL, &stats));
        gen_reals(b, 100, 5);
        SL_CHECK(sl_factor_solve(y.F, x, 100, b, 100, 1, NULL));
        SL_CHECK(sl_csc_residual(&y.M.view, r, 100, &error, x, 100, b, 100, 1));
        assert_true(error > 1e-12 && stats.change.drift > error && stats.change.drift < 1e-4);
        delta = 1e-3 * sign;
        SL_CHECK(sl_factor_change_entries(y.F, NULL, &other, &other, &delta, 1, NULL, &stats));
        assert_true(stats.change.drift > error && stats.change.drift < 1e-4);
        factored_free(&y);
    }
}

/* The growth of 1e10 of an indefinite block shows once the entry beside it that hid it is gone. */
static void growth_is_relative_to_what_remains(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 3, 4, 5}, i[5] = {0, 1, 2, 1, 2};
    static const double x[5] = {1e-10, 1.0, 1.0, 1.0, 1e9};
    const sl_csc A = {3, 3, p, i, x};
    const sl_int last = 2;
    const double down = 1.0 - 1e9;
    sl_factor *F;
    sl_stats stats;
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, &stats));
    assert_true(stats.factor.growth < 100.0);
    SL_CHECK(sl_factor_change_entries(F, NULL, &last, &last, &down, 1, NULL, &stats));
    assert_true(stats.factor.growth >= 1e10 && stats.factor.growth < 1e12);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A change as large as the largest |a| may take it away or double it, and others may be as large:
 * what L D L' shows of the matrix decides. */
static void a_change_as_large_as_the_matrix(void **state) {
    (void)state;
    enum { CASES = 5 };
    static const struct {
        double a[3], delta;
        sl_int row;
        double growth;
    } cases[CASES] = {
        {{2.0, 0.5, -1.5}, 2.0, 0, 2.0},  /* doubled */
        {{0.5, 0.5, -2.0}, -2.0, 1, 2.0}, /* doubled, in the row that is eliminated last */
        {{1.0, 0.5, -1.0}, 1.0, 1, 2.0},  /* gone, beside another 1 on the diagonal */
        {{1e-8, 1.0, 1.0}, -1.0, 1, 3e8}, /* gone, beside another 1 off the diagonal */
        {{0.5, 0.5, -2.0}, 4.0, 1, 5.0},  /* negated */
    };
    static const sl_int p[4] = {0, 2, 3, 4}, i[4] = {0, 1, 1, 2};
    for (int c = 0; c < CASES; c++) {
        double x[4] = {cases[c].a[0], cases[c].a[1], cases[c].a[2], 1e-3};
        const double b[3] = {0.7, -0.4, 0.2};
        double y[3], r[3], error;
        const sl_csc A = {3, 3, p, i, x};
        sl_factor *F;
        sl_stats stats;
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_NONE);
        SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
        SL_CHECK(sl_factor_change_entries(F, NULL, &cases[c].row, &cases[c].row, &cases[c].delta, 1,
                                          NULL, &stats));
        assert_int_equal(stats.change.method, SL_CHANGE_UPDATE);
        assert_true(stats.factor.growth <= cases[c].growth);
        assert_true(stats.change.drift <= 4.0 * DBL_EPSILON * cases[c].growth);
        x[cases[c].row == 0 ? 0 : 2] += cases[c].delta;
        SL_CHECK(sl_factor_solve(F, y, 3, b, 3, 1, NULL));
        SL_CHECK(sl_csc_residual(&A, r, 3, &error, y, 3, b, 3, 1));
        assert_true(error <= 4.0 * DBL_EPSILON * stats.factor.growth);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* Two rows beside a component whose entries are larger by 160 digits, pivots of both signs: what
 * they lose is drift, and nothing else is. The first pivot rises: an entry of L cancels, if it was
 * large. */
static void drift_is_that_of_the_changed_component(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 2, 3, 5, 6}, i[6] = {0, 1, 1, 2, 3, 3};
    static const sl_int rows[3] = {0, 1, 1}, columns[3] = {0, 0, 1};
    static const double deltas[3] = {1e-7, -1e-7, 1e-7}, b[4] = {1.0, 0.7, 0.0, 0.0};
    for (int firm = 0; firm < 2; firm++) {
        double x[6] = {firm ? 1e-4 : 1e-125, firm ? -1e-5 : -3e-66, 1e-4, -1e156, 1e155, 1e157};
        double y[4], r[4];
        const sl_csc A = {4, 4, p, i, x};
        sl_factor *F;
        sl_stats stats;
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
        SL_CHECK(sl_factor_create(&F, S, &A, NULL, &stats));
        assert_true(stats.factor.growth < 2.0);
        SL_CHECK(sl_factor_change_entries(F, NULL, rows, columns, deltas, 3, NULL, &stats));
        SL_CHECK(sl_factor_solve(F, y, 4, b, 4, 1, NULL));
        for (int k = 0; k < 3; k++) {
            x[k] += deltas[k];
        }
        SL_CHECK(sl_csc_residual(&A, r, 4, NULL, y, 4, b, 4, 1));
        const double error = fmax(fabs(r[0]), fabs(r[1])) /
                             (2e-4 * fmax(fabs(y[0]), fabs(y[1])) + 1.0);
        print_message("error %.1e, drift %.1e\n", error, stats.change.drift);
        assert_true(firm ? error <= 1e-15 && stats.change.drift <= 1e-14
                         : error >= 1e-8 && stats.change.drift >= error);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* The largest entry goes, or a change is much larger than a pivot that it passes through: most of
 * what pivots were computed from is rounding. */
static void lost_digits_are_counted(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1}, row = 1, column = 0;
    static const double cases[2][4] = {{-0.36, 46545.14, 0.28, 0.62},
                                       {0.2167749, 1597460.98, -0.4326945, 1594723.57}};
    const double b[2] = {0.4, 0.7};
    for (int k = 0; k < 8; k++) {
        const double *values = cases[k / 2 % 2], delta = values[3] - values[1];
        double a[3] = {values[0], values[1], values[2]}, x[2], r[2], eta;
        const sl_csc A = {2, 2, p, i, a};
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        sl_options opt = options_none();
        opt.null_tolerance = k / 4 ? -1.0 : 0.0; /* small pivots pass for null, or none does */
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
        a[1] += delta;
        SL_CHECK(k % 2 ? sl_factor_change_entries(F, &A, &row, &column, &delta, 1, NULL, &stats)
                       : sl_factor_change_entries(F, NULL, &row, &column, &delta, 1, NULL, &stats));
        SL_CHECK(sl_factor_solve(F, x, 2, b, 2, 1, NULL));
        SL_CHECK(sl_csc_residual(&A, r, 2, &eta, x, 2, b, 2, 1));
        const double error =
            fmax(fabs(r[0]), fabs(r[1])) / (fabs(a[1]) * fmax(fabs(x[0]), fabs(x[1])) + 0.7);
        assert_true(error <= stats.change.drift + DBL_EPSILON * stats.factor.growth);
        assert_true(k % 2 == 0 || stats.change.drift <= 1e-11);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* A factor with pivots of both signs becomes definite. From then on the rows have what they lose,
 * and begin with what has been lost before: row 1 falls to a thousandth of what it was. */
static void changes_may_make_a_matrix_definite(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 1, 2}, i[2] = {0, 1}, q[2] = {0, 1};
    static const double x[2] = {1.0, -1.0}, one = 1.0;
    static const double sigma[3] = {1025.0, 1.0, -1023.0}, wanted[3] = {1024.0, 1025.0, 2.0};
    const sl_csc A = {2, 2, p, i, x}, V = {2, 1, q, i + 1, &one};
    sl_factor *F = NULL;
    sl_stats stats;
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, &stats));
    assert_int_equal(stats.factor.negative, 1);
    for (int k = 0; k < 3; k++) {
        SL_CHECK(sl_factor_rank_update(F, &V, sigma + k, NULL, &stats));
        assert_int_equal(stats.factor.positive, 2);
        assert_int_equal(stats.change.updates, k + 1);
        const double error = fabs(sl_factor_view(F).D[1] / wanted[k] - 1.0);
        print_message("error %.1e, drift %.1e\n", error, stats.change.drift);
        assert_true(error <= stats.change.drift && stats.change.drift < 1e-9);
    }
    assert_true(stats.change.drift >= 512.0 * DBL_EPSILON); /* a part of 512 was lost */
    sl_factor_free(F);
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drift_is_relative_to_what_remains),
        cmocka_unit_test(growth_is_relative_to_what_remains),
        cmocka_unit_test(a_change_as_large_as_the_matrix),
        cmocka_unit_test(drift_is_that_of_the_changed_component),
        cmocka_unit_test(lost_digits_are_counted),
        cmocka_unit_test(changes_may_make_a_matrix_definite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
