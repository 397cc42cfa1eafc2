/* test_parts_use.c: half solves: what is refused, workspaces, and allocations that fail */
#include "tests/lib/parts.h"
#include "tests/lib/reserved.h"

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 25, 1, 0, NULL);
    factored_t k = factored_make(GEN_KKT, 40, 1, 0, NULL);
    factored_t h = hollow_make(40, SL_ISA_AUTO);
    double X[40], B[40] = {0};
    sl_plan *plan = NULL, *inside = NULL;
    sl_region *region = NULL;
    sl_int rows[2] = {3, 4}, columns[25], count = -1;
    SL_CHECK(sl_plan_create(&plan, y.S, rows, 2, rows, 2, NULL, NULL));
    X[0] = 77.0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(NULL, NULL, L, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, NULL, 64, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, NULL, D | ROOT, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, NULL, L, X, 24, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, NULL, L, X, 25, NULL, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, NULL, L, X, 25, B, 25, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_multiply_part(y.F, ALL | 64, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_solve_part(k.F, NULL, ROOT | LT, X, 40, B, 40, 1, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_solve_part(h.F, NULL, ROOT, X, 40, B, 40, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, plan, L, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, plan, ALL, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, plan, P | L, X, 1, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_solve_part(y.F, plan, P | L | D | ROOT, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_MISMATCH, sl_factor_solve_part(k.F, plan, P | L, X, 40, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(plan, SL_PART_D, columns, 25, &count));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(plan, SL_PART_L, NULL, 25, &count));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(plan, SL_PART_L, columns, 25, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(NULL, SL_PART_L, columns, 25, &count));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(plan, SL_PART_L, columns, -1, &count));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(NULL, plan, P | L, X, 25, B, 2, 1, NULL));
    assert_true(X[0] == 77.0);
    columns[1] = -7; /* not written beyond the capacity */
    SL_CHECK(sl_plan_columns(plan, SL_PART_L, columns, 1, &count));
    assert_true(count > 1 && columns[1] == -7);
    SL_CHECK(sl_plan_columns(plan, SL_PART_L, NULL, 0, &count));

    /* in a region the sweeps end below the roots */
    SL_CHECK(sl_region_create(&region, y.F, rows, 2, NULL, NULL, NULL));
    sl_options opt = options_none();
    opt.region = region;
    SL_CHECK(sl_plan_create(&inside, y.S, rows, 2, rows, 2, &opt, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_solve_part(y.F, inside, P | L, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_plan_columns(inside, SL_PART_L, columns, 25, &count));
    sl_plan_free(inside);
    sl_region_free(region);

    y.M.x[0] = NAN; /* a failed factor */
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve_part(y.F, NULL, L, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve_part(y.F, plan, P | L, X, 25, B, 2, 1, NULL));
    sl_plan_free(plan);
    factored_free(&y);
    factored_free(&k);
    factored_free(&h);
}

/* A pair of columns has no square root in D, even if it is definite. */
static void roots_of_pairs_are_unsupported(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    double x[3] = {0.0, 1.0, 0.0}, X[2] = {7.0, 7.0};
    const double B[2] = {1.0, 1.0};
    const sl_csc A = {2, 2, p, i, x};
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, &stats));
    assert_int_equal(stats.symbolic.pairs, 1);
    x[0] = x[2] = 2.0;
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, &stats));
    assert_int_equal(stats.factor.negative, 0);
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_solve_part(F, NULL, ROOT, X, 2, B, 2, 1, NULL));
    assert_true(X[0] == 7.0 && X[1] == 7.0);
    SL_CHECK(sl_factor_solve_part(F, NULL, ALL, X, 2, B, 2, 1, NULL));
    assert_true(fabs(X[0] - 1.0 / 3.0) <= 1e-15 && fabs(X[1] - 1.0 / 3.0) <= 1e-15);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void reserved_workspaces_do_not_grow(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        factored_t y = factored_make(kinds[kind], 200, 1, 0, NULL);
        const sl_int n = y.M.view.n_cols, rows = n < 5 ? n : 5;
        const size_t ld = n > 0 ? (size_t)n : 1;
        sl_int set[5] = {0, 1, 2, 3, 4};
        double *B = test_reals(ld * MOST), *X = test_reals(ld * MOST);
        sl_plan *plan = NULL;
        SL_CHECK(sl_plan_create(&plan, y.S, set, rows, NULL, SL_ALL, NULL, NULL));
        for (sl_int most = 0; most <= MOST; most++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            for (int local = 0; local < 2; local++) {
                sl_work *W = NULL;
                SL_CHECK(sl_work_create(&W, &opt));
                if (local) {
                    RESERVE_FOR(W, NULL,
                                sl_factor_solve_part(y.F, plan, P | L, X, ld, B, ld, most, trial));
                    RESERVE_FOR(
                        W, NULL,
                        sl_factor_solve_part(y.F, plan, LT | PT, X, ld, B, ld, most, trial));
                } else {
                    RESERVE_FOR(W, NULL,
                                sl_factor_solve_part(y.F, NULL, ALL, X, ld, B, ld, most, trial));
                }
                const size_t calls = counter.calls;
                for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
                    if (local) {
                        SL_CHECK(sl_factor_solve_part(y.F, plan, P | L, X, ld, B, ld, nrhs, W));
                        SL_CHECK(sl_factor_solve_part(y.F, plan, LT | PT, X, ld, B, ld, nrhs, W));
                    } else {
                        SL_CHECK(sl_factor_solve_part(y.F, NULL, ALL, X, ld, B, ld, nrhs, W));
                        SL_CHECK(sl_factor_multiply_part(y.F, LT, X, ld, B, ld, nrhs, W));
                    }
                }
                assert_int_equal(counter.calls, calls);
                sl_work_free(W);
            }
            COUNTER_CLEAN(&counter);
        }
        sl_plan_free(plan);
        free(B);
        free(X);
        factored_free(&y);
    }
}

static void failing_allocations_leave_x_untouched(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    factored_t y = factored_make(GEN_GRID2, 49, 1, 0, &opt);
    sl_work *W = NULL;
    double X[49] = {5.0}, B[49] = {1.0};
    SL_CHECK(sl_work_create(&W, &opt));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_factor_solve_part(y.F, NULL, L, X, 49, B, 49, 1, W));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_factor_multiply_part(y.F, L, X, 49, B, 49, 1, NULL));
    assert_true(X[0] == 5.0);
    counter.fail_at = -1;
    SL_CHECK(sl_factor_solve_part(y.F, NULL, L, X, 49, B, 49, 1, W));
    sl_work_free(W);
    factored_free(&y);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(roots_of_pairs_are_unsupported),
        cmocka_unit_test(reserved_workspaces_do_not_grow),
        cmocka_unit_test(failing_allocations_leave_x_untouched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
