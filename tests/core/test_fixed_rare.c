/* test_fixed_rare.c: fixed rows: blocks that are cut, refactorizations that fail */
#include "tests/lib/fixed_rows.h"

/* Two paths 0-1-2 and 3-4-5 of springs of 1. */
static const sl_int two_p[7] = {0, 2, 4, 5, 7, 9, 10}, two_i[10] = {0, 1, 1, 2, 2, 3, 4, 4, 5, 5};
static const double two_x[10] = {1, -1, 2, -1, 1, 1, -1, 2, -1, 1};
static const sl_csc two_paths = {6, 6, two_p, two_i, two_x};

/* [a b 0; b c 1; 0 1 2] */
static const sl_int three_p[4] = {0, 2, 4, 5}, three_i[5] = {0, 1, 1, 2, 2};

/* An indefinite matrix of free rows where it has to be definite: the error is not that they are
 * singular. */
static void a_negative_pivot_is_named_by_its_row(void **state) {
    (void)state;
    static const sl_int fixed[1] = {1};
    static const double x[5] = {1.0, 0.5, 1.0, 1.0, -2.0};
    const sl_csc A = {3, 3, three_p, three_i, x};
    sl_options opt = options_none();
    sl_fixed *D = NULL;
    sl_stats stats;
    opt.pivots = SL_PIVOTS_POSITIVE;
    SL_EXPECT(SL_ERR_PIVOT, sl_fixed_create(&D, &A, fixed, 1, &opt, &stats));
    assert_null(D);
    assert_int_equal(stats.error.row, 2);
    assert_null(strstr(stats.error.what, "singular"));
    opt.pivots = SL_PIVOTS_NONZERO;
    SL_CHECK(sl_fixed_create(&D, &A, fixed, 1, &opt, &stats));
    assert_int_equal(stats.factor.negative, 1);
    sl_fixed_free(D);
}

/* Blocks are kept if all of them are free as a whole: here the last one is not. */
static void the_last_block_may_be_cut(void **state) {
    (void)state;
    static const sl_int last[2] = {5, 2};
    static const double x[10] = {2, -1, 3, -1, 2, 2, -1, 3, -1, 2};
    sl_csc A = two_paths;
    sl_options opt = options_none();
    A.x = x;
    opt.block_size = 2;
    for (sl_int count = 1; count <= 2; count++) { /* or, without row 2, blocks begin elsewhere */
        sl_fixed *D = NULL;
        SL_CHECK(sl_fixed_create(&D, &A, last, count, &opt, NULL));
        fixed_check_all(D, &A, last, count);
        sl_fixed_free(D);
    }
}

/* Patterns with another number of columns, and what is no pattern. */
static void what_is_no_pattern_is_refused(void **state) {
    (void)state;
    static const sl_int rows[2] = {0, 3}, wide[8] = {0, 2, 4, 5, 7, 9, 10, 10};
    static const sl_int down[7] = {0, 2, 4, 3, 7, 9, 10};
    static const double g[2] = {1.0, 2.0};
    double before[6], after[6];
    sl_csc A[2] = {two_paths, two_paths};
    sl_fixed *D = NULL;
    A[0].n_cols = 7;
    A[0].p = wide;
    A[1].p = down;
    SL_CHECK(sl_fixed_create(&D, &two_paths, rows, 2, NULL, NULL));
    SL_CHECK(sl_fixed_solve(D, before, 6, NULL, 0, g, 2, 1, NULL));
    for (int k = 0; k < 2; k++) {
        SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_fixed_refactor(D, &A[k], NULL));
        SL_CHECK(sl_fixed_solve(D, after, 6, NULL, 0, g, 2, 1, NULL));
        assert_memory_equal(before, after, sizeof before);
    }
    sl_fixed_free(D);
}

/* Too much growth of the free rows 0 and 1: refused until other values come. */
static void growth_is_refused_until_other_values_come(void **state) {
    (void)state;
    static const sl_int fixed[1] = {2};
    static const double g = 3.0;
    double x[5] = {2.0, 0.5, 1.0, 1.0, 2.0}, y[3], z[3];
    const sl_csc A = {3, 3, three_p, three_i, x};
    sl_fixed *D = NULL;
    sl_stats stats;
    SL_CHECK(sl_fixed_create(&D, &A, fixed, 1, NULL, NULL));
    SL_CHECK(sl_fixed_solve(D, y, 3, NULL, 0, &g, 1, 1, NULL));
    x[0] = x[2] = 1e-17;
    SL_EXPECT(SL_ERR_INACCURATE, sl_fixed_refactor(D, &A, &stats));
    assert_in_range(stats.error.row, 0, 1);
    SL_EXPECT(SL_ERR_STALE, sl_fixed_solve(D, z, 3, NULL, 0, &g, 1, 1, NULL));
    x[0] = 2.0;
    x[2] = 1.0;
    SL_CHECK(sl_fixed_refactor(D, &A, NULL));
    SL_CHECK(sl_fixed_solve(D, z, 3, NULL, 0, &g, 1, 1, NULL));
    assert_memory_equal(y, z, sizeof y);
    sl_fixed_free(D);
}

/* L as complex: both rows of a pair have the same values, or the next solves are refused. */
static void pairs_stay_complex(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 3, 5, 7, 8}, i[8] = {0, 1, 2, 1, 3, 2, 3, 3}, fixed[2] = {2, 3};
    static const double g[2] = {1.0, 2.0};
    double x[8] = {3.0, 0.0, 1.5, 3.0, 1.5, 2.0, 0.0, 2.0}, y[4], z[4];
    const sl_csc A = {4, 4, p, i, x};
    sl_options opt = options_none();
    sl_fixed *D = NULL;
    opt.storage = SL_STORAGE_COMPLEX;
    opt.block_size = 2;
    SL_CHECK(sl_fixed_create(&D, &A, fixed, 2, &opt, NULL));
    SL_CHECK(sl_fixed_solve(D, y, 4, NULL, 0, g, 2, 1, NULL));
    assert_true(fabs(y[0] + 0.5) < 1e-15 && fabs(y[1] + 1.0) < 1e-15);
    x[3] = 4.0;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_fixed_refactor(D, &A, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_fixed_solve(D, z, 4, NULL, 0, g, 2, 1, NULL));
    x[3] = 3.0;
    SL_CHECK(sl_fixed_refactor(D, &A, NULL));
    SL_CHECK(sl_fixed_solve(D, z, 4, NULL, 0, g, 2, 1, NULL));
    assert_memory_equal(y, z, sizeof y);
    sl_fixed_free(D);
}

/* Stiffnesses of 1e-300: a solution overflows, of one right-hand side or of several. */
static void a_solution_may_overflow(void **state) {
    (void)state;
    static const sl_int fixed[1] = {2};
    static const double x[10] = {1e-300, -1e-301, 2e-300, -1e-300, 1.0, 1.0, -0.5, 2.0, -1.0, 1.0};
    static const double g[3] = {0.0, 0.0, 0.0};
    sl_csc A = two_paths;
    sl_fixed *D = NULL;
    A.x = x;
    SL_CHECK(sl_fixed_create(&D, &A, fixed, 1, NULL, NULL));
    for (sl_int nrhs = 1; nrhs <= 3; nrhs++) {
        double B[18] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, X[18];
        B[6 * nrhs - 6] = 1e10;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_fixed_solve(D, X, 6, B, 6, g, 1, nrhs, NULL));
        assert_true(!isfinite(X[6 * nrhs - 6]));
        B[6 * nrhs - 6] = 1.0;
        SL_CHECK(sl_fixed_solve(D, X, 6, B, 6, g, 1, nrhs, NULL));
        for (const double *x0 = X; x0 < X + 6 * nrhs; x0 += 6) {
            assert_true(fabs(1e-300 * x0[0] - 1e-301 * x0[1] - B[x0 - X]) < 1e-14);
        }
    }
    sl_fixed_free(D);
}

/* Fixed values that are not finite, alone and with B. */
static void values_that_are_not_finite_are_refused(void **state) {
    (void)state;
    static const sl_int fixed[2] = {0, 3};
    static const double B[6] = {0.0};
    double X[6], g[2] = {1.0, 2.0};
    sl_fixed *D = NULL;
    SL_CHECK(sl_fixed_create(&D, &two_paths, fixed, 2, NULL, NULL));
    for (int k = 0; k < 2; k++) {
        g[1] = k == 0 ? (double)INFINITY : (double)NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_fixed_solve(D, X, 6, NULL, 0, g, 2, 1, NULL));
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_fixed_solve(D, X, 6, B, 6, g, 2, 1, NULL));
    }
    sl_fixed_free(D);
}

/* A matrix without entries, of which all rows are fixed: it has no values to give. */
static void no_entries_need_no_values(void **state) {
    (void)state;
    static const sl_int fixed[2] = {0, 1}, p[3] = {0, 0, 0}, i[1] = {0};
    static const double g[2] = {5.0, 7.0};
    const sl_csc A = {2, 2, p, i, NULL};
    double X[2] = {0.0, 0.0};
    sl_fixed *D = NULL;
    SL_CHECK(sl_fixed_create(&D, &A, fixed, 2, NULL, NULL));
    SL_CHECK(sl_fixed_refactor(D, &A, NULL));
    SL_CHECK(sl_fixed_solve(D, X, 2, NULL, 0, g, 2, 1, NULL));
    assert_memory_equal(X, g, sizeof X);
    sl_fixed_free(D);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_negative_pivot_is_named_by_its_row),
        cmocka_unit_test(the_last_block_may_be_cut),
        cmocka_unit_test(what_is_no_pattern_is_refused),
        cmocka_unit_test(growth_is_refused_until_other_values_come),
        cmocka_unit_test(pairs_stay_complex),
        cmocka_unit_test(a_solution_may_overflow),
        cmocka_unit_test(values_that_are_not_finite_are_refused),
        cmocka_unit_test(no_entries_need_no_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
