/* test_factor_overflow.c: entries that are not finite, overflow in elimination, extreme scales */
#include "tests/lib/factored.h"

/* Each entry in turn becomes a NaN or an infinity. */
static void entries_that_are_not_finite_are_reported(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    static const double bad[3] = {NAN, INFINITY, -INFINITY};
    for (int which = 0; which < 6; which++) {
        gen_list_t t = gen_make(GEN_GRID2, 25, 0, 2);
        gen_matrix_t M = gen_store(&t, gen_style(which), 5);
        sl_int n = t.n;
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (sl_int j = 0; j < n; j++) {
            for (sl_int q = M.p[j]; q < M.p[j + 1]; q++) {
                double keep = M.x[q];
                sl_options opt = options_none();
                sl_stats stats;
                sl_factor *F = NULL;
                memset(&stats, 0, sizeof stats);
                options_set_variant(&opt, &variants, q % variants.count);
                M.x[q] = bad[q % 3];
                sl_status status = sl_factor_create(&F, S, &M.view, &opt, &stats);
                /* of both triangles also in the one that is not read */
                assert_int_equal(status, SL_ERR_NOT_FINITE);
                assert_null(F);
                assert_int_equal(stats.error.row, M.i[q]);
                assert_int_equal(stats.error.column, j);
                assert_true(!isfinite(stats.error.value));
                sl_factor_free(F);
                M.x[q] = keep;
            }
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* finite values whose products overflow: 1e300^2 / 1 */
static void an_overflow_in_elimination_is_reported(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double x[3] = {1, 1e300, 1};
    sl_csc A = {2, 2, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    for (int k = 0; k < variants.count; k++) {
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        options_set_variant(&opt, &variants, k);
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), &stats));
        assert_null(F);
        assert_int_equal(stats.error.row, 1);
        assert_int_equal(stats.error.column, -1);
    }
    sl_symbolic_free(S);
}

/* 1e308 - 1e308 + 1e308: the sum of magnitudes overflows, the pivot does not and is exact */
static void an_overflow_of_magnitudes_is_no_null_pivot(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    const sl_int p[4] = {0, 3, 5, 6}, i[6] = {0, 1, 2, 1, 2, 2}; /* one supernode: in this order */
    const double x[6] = {1, 1e-200, 1e154, -1, 1e154, 1e308};
    sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    for (int k = 0; k < variants.count; k++) {
        sl_factor *F = NULL;
        options_set_variant(&opt, &variants, k);
        SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
        assert_true(fabs(sl_factor_view(F).D[2] - 1e308) <= 1e293);
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
}

/* Subnormal and huge scales: finite results or an error, never a NaN inside a factor. */
static void extreme_scales_leave_no_nan(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    static const int powers[6] = {-1060, -1020, -500, 500, 1000, 1015};
    for (int which = 0; which < 6; which++) {
        gen_matrix_t M = gen_matrix(GEN_GRID2, 49, 0, 3);
        for (sl_int q = 0; q < M.p[M.view.n_cols]; q++) {
            M.x[q] = ldexp(M.x[q], powers[which]);
        }
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_none();
            options_set_variant(&opt, &variants, k);
            sl_factor *F = NULL;
            sl_status status = sl_factor_create(&F, S, &M.view, &opt, NULL);
            if (status == SL_OK) {
                sl_factor_arrays f = sl_factor_view(F);
                for (sl_off q = 0; q < panel_doubles(F); q++) {
                    assert_true(isfinite(f.L[q]));
                }
                for (sl_int j = 0; j < M.view.n_cols; j++) {
                    assert_true(isfinite(f.D[j]) && f.D[j] != 0.0);
                }
            } else {
                assert_true(status == SL_ERR_NOT_FINITE || status == SL_ERR_PIVOT);
            }
            if (powers[which] == -500 || powers[which] == 500) {
                assert_int_equal(status, SL_OK);
            }
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_that_are_not_finite_are_reported),
        cmocka_unit_test(an_overflow_in_elimination_is_reported),
        cmocka_unit_test(an_overflow_of_magnitudes_is_no_null_pivot),
        cmocka_unit_test(extreme_scales_leave_no_nan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
