/* test_edges.c: queries of NULL, empty matrices and sets, sizes that differ by one, partial NaN */
#include "tests/lib/factored.h"
#include "tests/lib/parallel_for.h"

enum { N = 100 };

/* What is asked of no object is zero, and statistics that are not wanted may be NULL. */
static void queries_of_null_are_zero(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_plan *P = NULL;
    sl_stats none;
    SL_CHECK(sl_plan_create(&P, y.S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    const sl_symbolic_arrays symbolic = sl_symbolic_view(NULL);
    const sl_factor_arrays factor = sl_factor_view(NULL);
    assert_int_equal(symbolic.n, 0);
    assert_null(symbolic.perm);
    assert_null(factor.L);
    assert_null(factor.D);
    assert_int_equal(sl_work_bytes(NULL), 0);
    memset(&none, 0, sizeof none);
    sl_plan_stats(NULL, &none);
    assert_int_equal(symbolic.info.n, 0);
    assert_int_equal(factor.info.positive, 0);
    assert_int_equal(none.plan.b_columns, 0);
    sl_plan_stats(P, NULL);
    double sign = 7, log_abs_det = 7;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_logdet(NULL, &log_abs_det, &sign));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_logdet(y.F, NULL, &sign));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_logdet(y.F, &log_abs_det, NULL));
    assert_true(sign == 7 && log_abs_det == 7);
    sl_plan_free(P);
    factored_free(&y);
}

/* A matrix without rows needs no arrays in any call. */
static void a_matrix_without_rows_needs_no_arrays(void **state) {
    (void)state;
    static const sl_int p[1] = {0};
    const sl_csc A = {0, 0, p, NULL, NULL};
    const double one = 1;
    const double *const values[1] = {NULL};
    double eta[2] = {5, 5};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.ordering = SL_ORDERING_GIVEN;
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    SL_CHECK(sl_factor_create_sums(&F, 1, S, &one, values, 1, NULL, NULL, NULL));
    SL_CHECK(sl_factor_solve(F, NULL, 1, NULL, 1, 1, NULL));
    SL_CHECK(sl_factor_refine(F, &A, NULL, 1, NULL, 1, 1, 2, NULL, &stats));
    SL_CHECK(sl_csc_residual(&A, NULL, 1, eta, NULL, 1, NULL, 1, 2));
    assert_true(eta[0] == 0 && eta[1] == 0);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A matrix with as many rows and entries as the analyzed one, and one column more, is another. */
static void a_matrix_with_a_column_more_is_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_int *p = test_ints(N + 2);
    memcpy(p, y.M.p, (N + 1) * sizeof *p);
    p[N + 1] = p[N];
    const sl_csc wide = {N, N + 1, p, y.M.i, y.M.x};
    double x[N] = {0}, b[N] = {1};
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_refactor(y.F, &wide, NULL));
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_CHECK(sl_factor_solve(y.F, x, N, b, N, 1, NULL));
    BACKWARD_PASSES(&y.M.view, x, N, b, N, 1);
    free(p);
    factored_free(&y);
}

/* Arrays with different strides may be the same array while one of them has no rows. */
static void empty_sets_share_no_memory(void **state) {
    (void)state;
    static const sl_int set[2] = {3, 4};
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_plan *from_nothing = NULL, *to_nothing = NULL;
    double shared[6] = {5, 5, 5, 5, 5, 5};
    SL_CHECK(sl_plan_create(&from_nothing, y.S, set, 0, set, 2, NULL, NULL));
    SL_CHECK(sl_plan_create(&to_nothing, y.S, set, 2, set, 0, NULL, NULL));
    SL_CHECK(sl_plan_solve(to_nothing, y.F, shared, 2, shared, 3, 2, NULL));
    for (int k = 0; k < 6; k++) {
        assert_true(shared[k] == 5);
    }
    SL_CHECK(sl_plan_solve(from_nothing, y.F, shared, 3, shared, 2, 2, NULL));
    assert_true(shared[0] == 0 && shared[1] == 0 && shared[2] == 5 && shared[3] == 0);
    SL_CHECK(sl_plan_solve_regularized(to_nothing, y.F, shared, 2, shared, 3, 1, 2, NULL, NULL));
    sl_plan_free(from_nothing);
    sl_plan_free(to_nothing);
    factored_free(&y);
}

/* A right-hand side that is zero by its empty set is consistent, in blocks of any size. */
/* Rows with a thousand neighbors each: no other order is tried, and all of L is stored. */
static void a_dense_pattern_has_one_order(void **state) {
    (void)state;
    enum { ROWS = 1030 };
    sl_int *p = test_ints(ROWS + 1), *i = test_ints((size_t)ROWS * (ROWS + 1) / 2), at = 0;
    const sl_csc A = {ROWS, ROWS, p, i, NULL};
    sl_symbolic *S;
    sl_stats stats;
    for (sl_int j = 0; j < ROWS; j++) {
        p[j] = at;
        for (sl_int k = j; k < ROWS; k++) {
            i[at++] = k;
        }
    }
    p[ROWS] = at;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, &stats));
    assert_int_equal(stats.symbolic.nnz_l, at);
    assert_int_equal(stats.symbolic.supernodes_fundamental, 1);
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
    sl_symbolic_free(S);
    free(p);
    free(i);
}

static void nothing_is_consistent(void **state) {
    (void)state;
    static const sl_int set[2] = {3, 4};
    gen_matrix_t M = gen_matrix(GEN_SINGULAR, N, 1, 1);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    double X[2 * 9];
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.consistency_tolerance = 1e-10;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    SL_CHECK(sl_plan_create(&P, S, set, 0, set, 2, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, F, X, 2, NULL, 0, 9, NULL));
    for (int k = 0; k < 2 * 9; k++) {
        assert_true(X[k] == 0);
    }
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A NaN in one right-hand side is reported as the backward error of the block, and leaves the other
 * solutions as they are without it. */
static void a_nan_stays_in_its_column(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    double B[3 * N], X[3 * N], clean[3 * N];
    gen_reals(B, 3 * N, 9);
    SL_CHECK(sl_factor_solve(y.F, clean, N, B, N, 3, NULL));
    SL_CHECK(sl_factor_refine(y.F, &y.M.view, clean, N, B, N, 3, 2, NULL, NULL));
    for (int bad = 0; bad < 3; bad++) {
        sl_stats stats;
        const double keep = B[bad * N + 7];
        memset(&stats, 0, sizeof stats);
        B[bad * N + 7] = NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_solve(y.F, X, N, B, N, 3, NULL));
        SL_EXPECT(SL_ERR_INACCURATE,
                  sl_factor_refine(y.F, &y.M.view, X, N, B, N, 3, 2, NULL, &stats));
        assert_true(stats.refine.backward_error != stats.refine.backward_error);
        for (int r = 0; r < 3; r++) {
            if (r != bad) {
                SAME_VALUES(X + r * N, clean + r * N, N);
            }
        }
        B[bad * N + 7] = keep;
    }
    factored_free(&y);
}

/* Entries and blocks of the inverse when one array serves twice, in whole and in part. */
static void one_array_may_be_both_sides_in_part(void **state) {
    (void)state;
    static const sl_int set[4] = {3, 40, 41, 77}, same[4] = {3, 40, 41, 77};
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    double Z[4 * 4], part[4 * 3];
    SL_CHECK(sl_inverse_block(y.F, Z, 4, set, 4, same, 4, NULL, NULL));
    SL_CHECK(sl_inverse_block(y.F, part, 4, set, 4, set, 3, NULL, NULL));
    for (int k = 0; k < 4 * 3; k++) {
        assert_true(fabs(part[k] - Z[k]) <= 1e-13 * fabs(Z[k]));
    }
    sl_selected *T = NULL;
    double entry = 7;
    const sl_int row[1] = {3}, outside[3] = {-1, N, INT32_MAX};
    SL_CHECK(sl_selected_create(&T, y.F, NULL, SL_ALL, NULL, NULL));
    for (int k = 0; k < 3; k++) {
        SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(T, &entry, &outside[k], row, 1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(T, &entry, row, &outside[k], 1, NULL));
    }
    assert_true(entry == 7);
    sl_selected_free(T);
    factored_free(&y);
}

/* A pool of threads that is to use one thread is not called. */
static void one_thread_is_the_caller(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_options opt = options_none();
    sl_factor *F = NULL;
    int calls = 0;
    opt.method = SL_METHOD_SUPERNODAL;
    opt.threads.count = 1;
    opt.threads.run = run_backwards;
    opt.threads.context = &calls;
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    assert_int_equal(calls, 0);
    sl_factor_free(F);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(queries_of_null_are_zero),
        cmocka_unit_test(a_matrix_without_rows_needs_no_arrays),
        cmocka_unit_test(a_matrix_with_a_column_more_is_refused),
        cmocka_unit_test(empty_sets_share_no_memory),
        cmocka_unit_test(a_dense_pattern_has_one_order),
        cmocka_unit_test(nothing_is_consistent),
        cmocka_unit_test(a_nan_stays_in_its_column),
        cmocka_unit_test(one_array_may_be_both_sides_in_part),
        cmocka_unit_test(one_thread_is_the_caller),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
