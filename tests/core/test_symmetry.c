/* test_symmetry.c: a matrix that stores both triangles with different values is refused */
#include "tests/lib/factored.h"
#include "tests/lib/gen_matrices.h"

enum { ENTRIES = 7 };

/* A 3 x 3 matrix with both triangles: entry (1, 0) twice, which is summed; rows not sorted. */
typedef struct both_t {
    sl_int p[4], i[ENTRIES + 1];
    double x[ENTRIES + 1];
    sl_csc A;
} both_t;

static both_t *both_make(void) {
    static both_t y;
    static const sl_int p[4] = {0, 3, 6, 8}, i[8] = {1, 0, 1, 0, 2, 1, 2, 1};
    static const double x[8] = {-0.25, 4.0, -0.75, -1.0, -2.0, 4.0, 4.0, -2.0};
    memcpy(y.p, p, sizeof p);
    memcpy(y.i, i, sizeof i);
    memcpy(y.x, x, sizeof x);
    y.A.n_rows = y.A.n_cols = 3;
    y.A.p = y.p;
    y.A.i = y.i;
    y.A.x = y.x;
    return &y;
}

static sl_status create(const sl_csc *A, sl_triangle triangle, sl_stats *stats) {
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    opt.triangle = triangle;
    SL_CHECK(sl_symbolic_create(&S, A, &opt, NULL));
    const sl_status status = sl_factor_create(&F, S, A, NULL, stats);
    assert_true((F == NULL) == (status != SL_OK));
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

static void equal_values_are_accepted(void **state) {
    (void)state;
    both_t *y = both_make();
    SL_CHECK(create(&y->A, SL_TRIANGLE_NONE, NULL));
    y->x[7] = (double)(float)-2.0000002; /* by the rounding of float */
    SL_CHECK(create(&y->A, SL_TRIANGLE_BOTH, NULL));
}

static void different_values_are_refused_with_an_entry(void **state) {
    (void)state;
    for (int k = 0; k < 8; k++) {
        both_t *y = both_make();
        const int is_diagonal = k == 1 || k == 5 || k == 6;
        sl_stats stats;
        y->x[k] *= 1.0001;
        if (is_diagonal) {
            SL_CHECK(create(&y->A, SL_TRIANGLE_NONE, &stats));
            continue;
        }
        SL_EXPECT(SL_ERR_MALFORMED, create(&y->A, SL_TRIANGLE_NONE, &stats));
        assert_non_null(strstr(stats.error.what, "triangles differ"));
        const sl_int row = stats.error.row, column = stats.error.column;
        const sl_int changed = k < 3 ? 0 : k < 6 ? 1 : 2; /* column of the entry */
        assert_true((row == y->i[k] && column == changed) || (row == changed && column == y->i[k]));
        assert_true(stats.error.value < -0.9 && stats.error.value > -2.1);
        SL_EXPECT(SL_ERR_MALFORMED, create(&y->A, SL_TRIANGLE_BOTH, NULL));
        SL_CHECK(create(&y->A, SL_TRIANGLE_LOWER, NULL)); /* the caller has chosen */
        SL_CHECK(create(&y->A, SL_TRIANGLE_UPPER, NULL));
    }
}

/* Rows scaled by the inverse of a mass matrix: the usual mistake. */
static void a_laplacian_divided_by_masses_is_refused(void **state) {
    (void)state;
    static const gen_kind_t kinds[3] = {GEN_GRID2, GEN_GRID3, GEN_RANDOM};
    for (int kind = 0; kind < 3; kind++) {
        gen_list_t t = gen_make(kinds[kind], 200, 1, 1);
        gen_matrix_t M = gen_store(&t, gen_style(2), 1); /* both triangles */
        gen_list_free(&t);
        double *x = test_reals((size_t)M.view.p[M.view.n_cols]);
        sl_stats stats;
        SL_CHECK(create(&M.view, SL_TRIANGLE_NONE, &stats));
        for (sl_int q = 0; q < M.view.p[M.view.n_cols]; q++) {
            x[q] = M.view.x[q] / (1.0 + 0.001 * M.view.i[q]);
        }
        M.view.x = x;
        SL_EXPECT(SL_ERR_MALFORMED, create(&M.view, SL_TRIANGLE_NONE, &stats));
        assert_in_range(stats.error.row, 0, M.view.n_rows - 1);
        assert_int_not_equal(stats.error.row, stats.error.column);
        free(x);
        gen_matrix_free(&M);
    }
}

/* What is not finite keeps its own status, in the triangle that is not read, too. */
static void nan_and_infinity_are_named_as_such(void **state) {
    (void)state;
    static const double bad[3] = {NAN, INFINITY, -INFINITY};
    static const int place[2] = {4, 7}; /* (2, 1), which is read, and (1, 2) */
    for (int k = 0; k < 6; k++) {
        both_t *y = both_make();
        sl_stats stats;
        y->x[place[k / 3]] = bad[k % 3];
        SL_EXPECT(SL_ERR_NOT_FINITE, create(&y->A, SL_TRIANGLE_NONE, &stats));
        assert_int_equal(stats.error.row, k < 3 ? 2 : 1);
        assert_int_equal(stats.error.column, k < 3 ? 1 : 2);
    }
}

/* Sums that overflow decide nothing: entries are compared. */
static void huge_values_are_compared(void **state) {
    (void)state;
    for (int differ = 0; differ < 2; differ++) {
        const sl_int p[3] = {0, 2, 4}, i[4] = {0, 1, 0, 1};
        const double x[4] = {1.5e308, 1e307, differ ? -1e307 : 1e307, 1.5e308};
        const sl_csc A = {2, 2, p, i, x};
        sl_stats stats;
        const sl_status status = create(&A, SL_TRIANGLE_NONE, &stats);
        assert_true(differ ? status == SL_ERR_MALFORMED : status != SL_ERR_MALFORMED);
    }
}

static void memory_may_run_out(void **state) {
    (void)state;
    both_t *y = both_make();
    counter_t counter = counter_make();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(sl_symbolic_create(&S, &y->A, NULL, NULL));
    sl_options opt = options_counted(&counter);
    counter.fail_at = 0; /* the first one is that of the comparison */
    SL_EXPECT(SL_ERR_MEMORY, sl_factor_create(&F, S, &y->A, &opt, NULL));
    assert_null(F);
    assert_int_equal(counter.live_blocks, 0);
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_values_are_accepted),
        cmocka_unit_test(different_values_are_refused_with_an_entry),
        cmocka_unit_test(a_laplacian_divided_by_masses_is_refused),
        cmocka_unit_test(nan_and_infinity_are_named_as_such),
        cmocka_unit_test(huge_values_are_compared),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
