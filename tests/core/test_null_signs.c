/* test_null_signs.c: a pivot whose sign is rounding error is refused, and what else is reported of
 * small pivots: with options.definite, beside growth, of null pivots */
#include "tests/lib/parallel_for.h"
#include "tests/lib/small_pivots.h"

static const sl_method methods[2] = {SL_METHOD_SUPERNODAL, SL_METHOD_UP_LOOKING};

/* L D L' for D = (1, 200, `last`), the last two in units of epsilon, and the path L: the second
 * pivot is right, and has an error that the third one inherits. */
static gen_matrix_t path_of_pivots(double last) {
    const double middle = 200.0 * DBL_EPSILON;
    const double block[9] = {1.0, 0.0, 0.0, 1.0, 1.0 + middle,
                             0.0, 0.0, middle, middle + last * DBL_EPSILON};
    return beside(block, 3, 3);
}

static void a_sign_within_its_error_is_refused(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    for (int k = 0; k < 2 * variants.count; k++) {
        sl_options opt = options_none();
        sl_stats stats;
        options_set_variant(&opt, &variants, k / 2);
        opt.ordering = SL_ORDERING_NATURAL;
        opt.definite = (size_t)(k % 2);
        gen_matrix_t A = path_of_pivots(-4.0);
        SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.error.row, 2);
        assert_true(stats.error.value < 0.0 && -stats.error.value <= stats.null_bound);
        gen_matrix_free(&A);
        A = path_of_pivots(-100.0); /* indefinite */
        SL_EXPECT(k % 2 ? SL_ERR_PIVOT : SL_OK, factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.negative, 1);
        gen_matrix_free(&A);
        A = path_of_pivots(4.0); /* its sign is that of the others */
        SL_CHECK(factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.positive, 3);
        gen_matrix_free(&A);
    }
}

/* Of a singular matrix there are no pivots, and so none that is negative. */
static void a_null_pivot_of_a_definite_matrix_is_null(void **state) {
    (void)state;
    static const double block[4] = {1.0, 0.0, 1.0, 1.0};
    gen_matrix_t A = beside(block, 2, 3);
    for (int m = 0; m < 2; m++) {
        sl_options opt = options_none();
        sl_stats stats;
        opt.method = methods[m];
        opt.definite = 1;
        SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
        assert_true(stats.error.value == 0.0);
    }
    gen_matrix_free(&A);
}

/* A small pivot that no memory is there to judge is refused as such, in definite matrices too. */
static void without_memory_definite_matrices_are_not_blamed(void **state) {
    (void)state;
    static const double block[4] = {1.0, 0.0, 1.0, 1.0 + 1e-14};
    gen_matrix_t A = beside(block, 2, 2);
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    opt.definite = 1;
    SL_CHECK(sl_symbolic_create(&S, &A.view, FOR_ANALYSIS(&opt), NULL));
    SL_CHECK(sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), NULL));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &A.view, &stats));
    assert_non_null(strstr(stats.error.what, "no memory"));
    SL_CHECK(sl_factor_refactor(F, &A.view, &stats));
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    COUNTER_CLEAN(&counter);
}

/* A small pivot that is right, beside a tree whose pivots grow: the growth is what is reported. */
static void growth_beside_a_small_pivot_is_reported(void **state) {
    (void)state;
    static const double block[16] = {1.0, 0.0, 0.0, 0.0, 1.0, 1.0 + 1e-14, 0.0, 0.0,
                                     0.0, 0.0, 1e-9, 0.0, 0.0, 0.0, 1.0, 0.0};
    gen_matrix_t A = beside(block, 4, 4);
    for (int m = 0; m < 2; m++) {
        sl_options opt = options_none();
        sl_stats stats;
        opt.method = methods[m];
        opt.ordering = SL_ORDERING_NATURAL;
        opt.growth_limit = 1e6;
        SL_EXPECT(SL_ERR_INACCURATE, factor_and_solve(&A, &opt, &stats));
        assert_true(stats.error.row >= 2);
        assert_true(stats.factor.growth > 1e8 && stats.factor.growth < 1e10);
        opt.growth_limit = -1.0;
        SL_CHECK(factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.negative, 1);
    }
    gen_matrix_free(&A);
}

/* A component that has constants as a null vector within rounding, apart from the shift of its
 * heavy springs: neither its last pivot nor that of a light row, with an edge to the last one, is
 * null, small as they are against those of the springs. */
static void light_rows_beside_heavy_ones_are_kept(void **state) {
    (void)state;
    enum { N = 400 };
    gen_list_t t = gen_list(N);
    double diagonal[N] = {0.0};
    for (sl_int k = 0; k < N - 1; k++) { /* row 100 is joined to the last one only */
        const sl_int next = k == 100 ? N - 1 : k == 99 ? 101 : k + 1;
        const double weight = k == 100 ? 1.0 : 1e14;
        gen_add(&t, next, k, -weight);
        diagonal[k] += weight + (k == 100 ? 0.0 : 1.0);
        diagonal[next] += weight;
    }
    for (sl_int k = 0; k < N; k++) {
        gen_add(&t, k, k, diagonal[k]);
    }
    gen_matrix_t A = gen_store(&t, gen_style(0), 1);
    sl_options opt = options_none();
    sl_stats stats;
    opt.ordering = SL_ORDERING_NATURAL;
    SL_CHECK(factor_and_solve(&A, &opt, &stats));
    assert_int_equal(stats.factor.positive, N);
    gen_matrix_free(&A);
    gen_list_free(&t);
}

/* Shifts are those of regularized pivots; null pivots have none. */
static void null_pivots_have_no_shift(void **state) {
    (void)state;
    static const double block[4] = {1.0, 0.0, -1.0, 1.0};
    gen_matrix_t A = beside(block, 2, 2);
    sl_options opt = options_none();
    sl_int row = -1, count = 0;
    double shift = 5.0;
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(sl_symbolic_create(&S, &A.view, FOR_ANALYSIS(&opt), NULL));
    SL_CHECK(sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), NULL));
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, &row, &shift, 1, &count));
    assert_int_equal(count, 1);
    assert_in_range(row, 0, 1);
    assert_true(shift == 0.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sign_within_its_error_is_refused),
        cmocka_unit_test(a_null_pivot_of_a_definite_matrix_is_null),
        cmocka_unit_test(without_memory_definite_matrices_are_not_blamed),
        cmocka_unit_test(growth_beside_a_small_pivot_is_reported),
        cmocka_unit_test(light_rows_beside_heavy_ones_are_kept),
        cmocka_unit_test(null_pivots_have_no_shift),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
