/* test_regularize.c: null pivots and pivots of the wrong sign are shifted: L D L' = A + E */
#include "tests/lib/kkt.h"
#include "tests/lib/parallel_for.h"
#include "tests/lib/factored.h"

static sl_options regularization_options(const variant_list_t *variants, int k, double delta,
                                         const sl_int *signs) {
    sl_options opt = options_none();
    options_set_variant(&opt, variants, k);
    opt.regularization = delta;
    opt.signs = signs;
    return opt;
}

/* Constraints that are eliminated after the rows they constrain: each one that repeats another has
 * a null pivot. */
static void dependent_constraints_are_regularized(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    static const sl_int sizes[3] = {12, 60, 240};
    for (int size = 0; size < 3; size++) {
        sl_int twice = sizes[size] / 12;
        kkt_t y = kkt_make(sizes[size], twice, SL_ORDERING_NATURAL);
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = regularization_options(&variants, k, 1e-8, y.signs);
            sl_factor *F = NULL, *G = NULL;
            sl_stats stats;
            sl_int rows[240], count = 0;
            double shifts[240];
            int calls = 0;
            memset(&stats, 0, sizeof stats);
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, &stats));
            opt.threads.count = 3;
            opt.threads.run = run_backwards;
            opt.threads.context = &calls;
            SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
            assert_same_bits(F, G);
            for (int again = 0; again < 3; again++) {
                const sl_int columns[2] = {0, 5};
                assert_int_equal(stats.factor.regularized, twice);
                assert_int_equal(stats.factor.positive, y.primal);
                assert_int_equal(stats.factor.negative, y.n - y.primal);
                assert_int_equal(stats.factor.null, 0);
                NOTHING_WRONG(check_regularized(F, &y.M.view));
                SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, rows, shifts, 240, &count));
                assert_int_equal(count, twice);
                /* Reported in order of elimination, which here is the order of the rows. */
                for (sl_int m = 0; m < count; m++) {
                    assert_int_equal(rows[m], y.n - twice + m);
                    /* The shift is 1e-8 times the magnitudes that the pivot was computed from:
                     * three products of entries of 0.2 to 0.8 and an entry of H^-1. */
                    assert_true(shifts[m] < -1e-11 && shifts[m] > -1e-7);
                }
                SL_CHECK(again == 0 ? sl_factor_refactor(F, &y.M.view, &stats)
                                    : sl_factor_change_entries(F, &y.M.view, NULL, columns, NULL, 2,
                                                               NULL, &stats));
            }
            /* Without the option the matrix is refused. */
            opt.regularization = 0.0;
            sl_factor_free(G);
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
            sl_factor_free(F);
        }
        kkt_free(&y);
    }
}

/* Pivots of the right sign keep their bits. Pivots of the wrong sign are all shifted. */
static void only_pivots_of_the_wrong_sign_change(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options plain = options_none();
        options_set_variant(&plain, &variants, k);
        factored_t y = factored_make(GEN_KKT, 150, 1, k % GEN_STYLES, &plain);
        sl_int n = y.M.view.n_cols, primal = n - n / 3, *signs = test_ints((size_t)n), count = 0;
        for (int which = 0; which < 4; which++) {
            /* All right; no sign required; all wrong; wrong in one row. */
            for (sl_int i = 0; i < n; i++) {
                signs[i] = which == 1 ? 0 : (i < primal) == (which != 2) ? 1 : -1;
            }
            signs[primal] = which == 3 ? 1 : signs[primal];
            sl_options opt = regularization_options(&variants, k, 1e-7, signs);
            sl_factor *F = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, &stats));
            NOTHING_WRONG(check_regularized(F, &y.M.view));
            SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, NULL, NULL, 0, &count));
            assert_int_equal(count, stats.factor.regularized);
            if (which < 2) {
                assert_int_equal(count, 0);
                assert_same_bits(F, y.F);
            } else {
                assert_true(count > 0);
            }
            sl_factor_arrays f = sl_factor_view(F);
            sl_symbolic_arrays v = sl_symbolic_view(y.S);
            /* Every pivot now has the required sign. */
            for (sl_int i = 0; i < n; i++) {
                assert_true(signs[v.perm[i]] == 0 || f.D[i] * signs[v.perm[i]] > 0.0);
            }
            sl_factor_free(F);
        }
        free(signs);
        factored_free(&y);
    }
}

/* Without signs all pivots must be positive: a Laplacian becomes definite. If the matrix is scaled,
 * its shifts scale with it. */
static void without_signs_all_pivots_become_positive(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        double shift[2];
        for (int scaled = 0; scaled < 2; scaled++) {
            sl_options opt = regularization_options(&variants, k, 1e-6, NULL);
            gen_matrix_t M = gen_matrix(GEN_SINGULAR, 100, 1, 1);
            sl_symbolic *S = NULL;
            sl_factor *F = NULL;
            sl_stats stats;
            sl_int row, count;
            memset(&stats, 0, sizeof stats);
            for (sl_int p = 0; scaled && p < M.p[100]; p++) {
                M.x[p] *= 1024.0;
            }
            SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
            assert_int_equal(stats.factor.positive, 100);
            assert_int_equal(stats.factor.regularized, 1);
            NOTHING_WRONG(check_regularized(F, &M.view));
            SL_CHECK(
                sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, &row, &shift[scaled], 1, &count));
            assert_int_equal(count, 1);
            SL_EXPECT(SL_ERR_ARGUMENT,
                      sl_factor_pivot_rows(NULL, SL_PIVOT_REGULARIZED, &row, NULL, 1, &count));
            SL_EXPECT(SL_ERR_ARGUMENT,
                      sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, NULL, NULL, 1, &count));
            SL_EXPECT(SL_ERR_ARGUMENT,
                      sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, &row, NULL, -1, &count));
            SL_EXPECT(SL_ERR_ARGUMENT,
                      sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, &row, NULL, 1, NULL));
            M.x[3] = NAN;
            SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(F, &M.view, &stats));
            SL_EXPECT(SL_ERR_STALE,
                      sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, &row, NULL, 1, &count));
            sl_factor_free(F);
            sl_symbolic_free(S);
            gen_matrix_free(&M);
        }
        assert_true(shift[1] == 1024.0 * shift[0]); /* exact: a power of two */
    }
}

/* Zero pivots are shifted by the regularization itself. Invalid options are refused. */
static void zero_pivots_get_the_shift_and_bad_options_are_refused(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    const sl_int p[4] = {0, 1, 2, 3}, i[3] = {0, 1, 2};
    const double a[3] = {0, 0, 0};
    const sl_csc A = {3, 3, p, i, a};
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_int signs[3] = {1, -1, 0};
        sl_options opt = regularization_options(&variants, k, 0.25, signs);
        sl_factor *F = NULL;
        sl_stats stats;
        double b[3] = {1, 1, 1}, x[3];
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
        assert_int_equal(stats.factor.regularized, 3);
        SL_CHECK(sl_factor_solve(F, x, 3, b, 3, 1, NULL));
        assert_true(x[0] == 4.0 && x[1] == -4.0 && x[2] == 4.0);
        sl_factor_free(F);
        static const double bad[3] = {-1.0, NAN, INFINITY};
        for (int m = 0; m < 3; m++) {
            opt.regularization = bad[m];
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, &opt, &stats));
        }
        opt.regularization = 1e-8;
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, &opt, &stats));
        opt.pivots = SL_PIVOTS_NONZERO;
        signs[1] = 2;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, &opt, &stats));
        assert_int_equal(stats.error.row, 1);
        signs[1] = -2;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, &opt, &stats));
        assert_null(F);
    }
    sl_symbolic_free(S);
}

/* Regularization relative to the row of a null pivot may underflow: the pivot stays 0, is of
 * neither sign, and no solution is finite. */
static void regularization_may_underflow(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double values[3] = {1e-300, 1e-300, 1e-300}, b[2] = {0.0, 1e-300};
    const sl_csc A = {2, 2, p, i, values};
    sl_options opt = options_none();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    double x[2];
    opt.regularization = 1e-30;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_true(stats.factor.pivot_min == 0.0 && stats.factor.pivot_max == 1e-300);
    assert_int_equal(stats.factor.positive, 1);
    assert_int_equal(stats.factor.negative + stats.factor.regularized, 0);
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_solve(F, x, 2, b, 2, 1, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dependent_constraints_are_regularized),
        cmocka_unit_test(only_pivots_of_the_wrong_sign_change),
        cmocka_unit_test(without_signs_all_pivots_become_positive),
        cmocka_unit_test(zero_pivots_get_the_shift_and_bad_options_are_refused),
        cmocka_unit_test(regularization_may_underflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
