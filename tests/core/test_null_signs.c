/* test_null_signs.c: a pivot whose sign is rounding error is refused, and what else is reported of
 * small pivots: with SL_PIVOTS_POSITIVE, beside growth, of null pivots */
#include "tests/lib/parallel_for.h"
#include "tests/lib/small_pivots.h"

static const sl_method methods[2] = {SL_METHOD_SUPERNODAL, SL_METHOD_UP_LOOKING};

/* L D L' for D = (1, 200, `last`), the last two in units of epsilon, and the path L: the second
 * pivot is right, and has an error that the third one inherits. */
static gen_matrix_t path_of_pivots(double last) {
    const double middle = 200.0 * DBL_EPSILON;
    const double block[9] = {
        1.0, 0.0, 0.0, 1.0, 1.0 + middle, 0.0, 0.0, middle, middle + last * DBL_EPSILON};
    return beside(block, 3, 5);
}

static void a_sign_within_its_error_is_refused(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    for (int k = 0; k < 2 * variants.count; k++) {
        sl_options opt = options_none();
        sl_stats stats;
        options_set_variant(&opt, &variants, k / 2);
        opt.ordering = SL_ORDERING_NATURAL;
        opt.pivots = k % 2 ? SL_PIVOTS_POSITIVE : SL_PIVOTS_NONZERO;
        gen_matrix_t A = path_of_pivots(-4.0);
        SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.error.row, 2);
        assert_true(stats.error.value < 0.0 && -stats.error.value <= stats.factor.null_bound);
        gen_matrix_free(&A);
        A = path_of_pivots(-100.0); /* indefinite */
        SL_EXPECT(k % 2 ? SL_ERR_PIVOT : SL_OK, factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.negative, 1);
        gen_matrix_free(&A);
        A = path_of_pivots(4.0); /* its sign is that of the others */
        SL_CHECK(factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.positive, 5);
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
        opt.pivots = SL_PIVOTS_POSITIVE;
        SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
        assert_true(stats.error.value == 0.0);
    }
    gen_matrix_free(&A);
}

/* A small pivot, or one of another sign, that no memory is there to judge is refused as such, in
 * definite matrices too: every allocation of the judgement fails once. */
static void without_memory_definite_matrices_are_not_blamed(void **state) {
    (void)state;
    static const double block[4] = {1.0, 0.0, 1.0, 1.0 + 1e-14};
    for (int turn = 0; turn < 2; turn++) {
        gen_matrix_t A = turn == 0 ? beside(block, 2, 2) : path_of_pivots(4.0);
        gen_matrix_t B = turn == 0 ? beside(block, 2, 2) : path_of_pivots(-4.0);
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        int failed = 0, has_failed = 1;
        opt.ordering = SL_ORDERING_NATURAL;
        opt.pivots = SL_PIVOTS_POSITIVE;
        SL_CHECK(sl_symbolic_create(&S, &A.view, FOR_ANALYSIS(&opt), NULL));
        SL_CHECK(sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), NULL));
        for (int64_t k = 0; has_failed; k++, failed += has_failed) {
            counter.fail_at = (int64_t)counter.calls + k;
            const sl_status status = sl_factor_refactor(F, &B.view, &stats);
            has_failed = status != SL_OK && strstr(stats.error.what, "no memory") != NULL;
            SL_EXPECT(has_failed || turn == 1 ? SL_ERR_PIVOT : SL_OK, status);
        }
        assert_int_equal(failed, turn == 0 ? 1 : 2);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&A);
        gen_matrix_free(&B);
        COUNTER_CLEAN(&counter);
    }
}

/* A small pivot that is right, beside a tree whose pivots grow: the growth is reported, also
 * where both are in a restriction only, without the first row and the last one. */
static void growth_beside_a_small_pivot_is_reported(void **state) {
    (void)state;
    enum { N = 6 };
    static const sl_int inner[4] = {1, 2, 3, 4};
    double block[N * N] = {0.0};
    sl_options opt = options_none();
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_stats stats;
    CELL(block, N, 0, 0) = CELL(block, N, 1, 1) = CELL(block, N, 2, 1) = 1.0;
    CELL(block, N, 1, 0) = 0.5;
    CELL(block, N, 2, 2) = 1.0 + 1e-14;
    CELL(block, N, 3, 3) = 1e-9;
    CELL(block, N, 4, 3) = CELL(block, N, 5, 4) = 1.0;
    CELL(block, N, 5, 5) = 1e9;
    gen_matrix_t A = beside(block, N, N);
    opt.ordering = SL_ORDERING_NATURAL;
    opt.growth_limit = 1e6;
    SL_CHECK(sl_symbolic_create(&S, &A.view, FOR_ANALYSIS(&opt), NULL));
    SL_CHECK(sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), &stats));
    assert_true(stats.factor.growth < 10.0);
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_submatrix(&T, &G, F, &A.view, inner, 4, NULL, &stats));
    assert_in_range(stats.error.row, 3, 4);
    assert_true(stats.factor.growth > 1e8 && stats.factor.growth < 1e10);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    CELL(block, N, 1, 0) = CELL(block, N, 5, 4) = 0.0;
    A = beside(block, N, N);
    SL_EXPECT(SL_ERR_INACCURATE, factor_and_solve(&A, &opt, &stats));
    assert_in_range(stats.error.row, 3, 4);
    opt.growth_limit = -1.0;
    SL_CHECK(factor_and_solve(&A, &opt, &stats));
    assert_int_equal(stats.factor.negative, 1);
    gen_matrix_free(&A);
}

/* I / 2 + 3e14 D'D of second differences D, as of a stiff smoother, and a light row that is joined
 * to the last one. Constants are a null vector within rounding, but neither the last pivot nor that
 * of the light row is null, small as both are against those of the smoother. */
static void light_rows_beside_heavy_ones_are_kept(void **state) {
    (void)state;
    enum { N = 20000, LIGHT = N - 1 };
    static const double d[3] = {1.0, -2.0, 1.0};
    double *band = test_reals(3 * N);
    gen_list_t t = gen_list(N + 1);
    sl_options opt = options_none();
    sl_stats stats;
    for (sl_int k = 0; k < 9 * (N - 2); k++) {
        const sl_int first = k / 9, a = k % 3, b = k / 3 % 3;
        if (b <= a) {
            band[3 * (first + a) + a - b] += 3e14 * d[a] * d[b];
        }
    }
    for (sl_int k = 0; k < N; k++) {
        for (sl_int j = 0; j < 3 && j <= k; j++) {
            const double shift = j > 0 ? 0.0 : k < N - 1 ? 0.5 : 1.5;
            gen_add(&t, k + (k >= LIGHT), k - j + (k - j >= LIGHT), band[3 * k + j] + shift);
        }
    }
    gen_add(&t, LIGHT, LIGHT, 1.0);
    gen_add(&t, N, LIGHT, -1.0);
    gen_matrix_t A = gen_store(&t, gen_style(0), 1);
    opt.ordering = SL_ORDERING_NATURAL;
    SL_CHECK(factor_and_solve(&A, &opt, &stats));
    assert_int_equal(stats.factor.positive, N + 1);
    gen_matrix_free(&A);
    gen_list_free(&t);
    free(band);
}

/* Shifts are those of regularized pivots; null pivots have none. */
static void null_pivots_have_no_shift(void **state) {
    (void)state;
    static const double block[4] = {1.0, 0.0, -1.0, 1.0};
    gen_matrix_t A = beside(block, 2, 2);
    sl_options opt = options_none();
    sl_int row = -1, count = 0;
    double shift = 5.0;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
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
