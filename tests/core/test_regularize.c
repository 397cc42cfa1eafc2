/* test_regularize.c: pivots that are null or of the wrong sign: which ones are changed, by how much, and that L D L' is A + E */
#include "kkt.h"
#include "parallel_for.h"
#include "problem.h"

static sl_options options_regular(const way_list_t *ways, int k, double delta,
                                  const sl_int *signs) {
    sl_options opt = options_none();
    way_take(&opt, ways, k);
    opt.regularization = delta;
    opt.signs = signs;
    return opt;
}

/* Constraints after what they constrain: a pivot for each constraint that repeats another is null. */
static void dependent_constraints(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    static const sl_int sizes[3] = {12, 60, 240};
    for (int size = 0; size < 3; size++) {
        sl_int twice = sizes[size] / 12;
        kkt_t y = kkt_make(sizes[size], twice, SL_ORDERING_NATURAL);
        for (int k = 0; k < ways.count; k++) {
            sl_options opt = options_regular(&ways, k, 1e-8, y.signs);
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
                assert_int_equal(stats.regularized, twice);
                assert_int_equal(stats.positive, y.primal);
                assert_int_equal(stats.negative, y.n - y.primal);
                assert_int_equal(stats.null, 0);
                NOTHING_WRONG(check_regularized(F, &y.M.view));
                SL_CHECK(sl_factor_regularized_rows(F, rows, shifts, 240, &count));
                assert_int_equal(count, twice);
                for (sl_int m = 0; m < count;
                     m++) { /* in the order of elimination: here that of the rows */
                    assert_int_equal(rows[m], y.n - twice + m);
                    /* three products made each, of 0.2 to 0.8 and an entry of H^-1 */
                    assert_true(shifts[m] < -1e-11 && shifts[m] > -1e-7);
                }
                SL_CHECK(again == 0 ? sl_factor_refactor(F, &y.M.view, &stats)
                                    : sl_factor_refactor_changed(F, &y.M.view, columns, 2, &stats));
            }
            /* without the wish it is refused */
            opt.regularization = 0.0;
            sl_factor_free(G);
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
            sl_factor_free(F);
        }
        kkt_free(&y);
    }
}

/* Pivots of the right sign stay as they are, to the bit; with other signs every one of them is turned. */
static void right_and_wrong_signs(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    for (int k = 0; k < ways.count; k++) {
        sl_options plain = options_none();
        way_take(&plain, &ways, k);
        problem_t y = problem_make(GEN_KKT, 150, 1, k % GEN_STYLES, &plain);
        sl_int n = y.M.view.n_cols, primal = n - n / 3, *signs = test_ints((size_t)n), count = 0;
        for (int which = 0; which < 4; which++) {
            for (sl_int i = 0; i < n; i++) { /* right; either; all wrong; wrong in one row */
                signs[i] = which == 1 ? 0 : (i < primal) == (which != 2) ? 1 : -1;
            }
            signs[primal] = which == 3 ? 1 : signs[primal];
            sl_options opt = options_regular(&ways, k, 1e-7, signs);
            sl_factor *F = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, &stats));
            NOTHING_WRONG(check_regularized(F, &y.M.view));
            SL_CHECK(sl_factor_regularized_rows(F, NULL, NULL, 0, &count));
            assert_int_equal(count, stats.regularized);
            if (which < 2) {
                assert_int_equal(count, 0);
                assert_same_bits(F, y.F);
            } else {
                assert_true(count > 0);
            }
            sl_factor_view_t f = sl_factor_view(F);
            sl_symbolic_view_t v = sl_symbolic_view(y.S);
            for (sl_int i = 0; i < n; i++) { /* every pivot has its sign now */
                assert_true(signs[v.perm[i]] == 0 || f.D[i] * signs[v.perm[i]] > 0.0);
            }
            sl_factor_free(F);
        }
        free(signs);
        problem_free(&y);
    }
}

/* No signs at all mean positive ones: a Laplacian comes out definite; scaled, its changes scale with it. */
static void positive_without_signs(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    for (int k = 0; k < ways.count; k++) {
        double shift[2];
        for (int scaled = 0; scaled < 2; scaled++) {
            sl_options opt = options_regular(&ways, k, 1e-6, NULL);
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
            assert_int_equal(stats.positive, 100);
            assert_int_equal(stats.regularized, 1);
            NOTHING_WRONG(check_regularized(F, &M.view));
            SL_CHECK(sl_factor_regularized_rows(F, &row, &shift[scaled], 1, &count));
            assert_int_equal(count, 1);
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_regularized_rows(NULL, &row, NULL, 1, &count));
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_regularized_rows(F, NULL, NULL, 1, &count));
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_regularized_rows(F, &row, NULL, -1, &count));
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_regularized_rows(F, &row, NULL, 1, NULL));
            M.x[3] = NAN;
            SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(F, &M.view, &stats));
            SL_EXPECT(SL_ERR_STATE, sl_factor_regularized_rows(F, &row, NULL, 1, &count));
            sl_factor_free(F);
            sl_symbolic_free(S);
            gen_matrix_free(&M);
        }
        assert_true(shift[1] == 1024.0 * shift[0]); /* a power of two: to the bit */
    }
}

/* A matrix of zeros gets the regularization itself; wishes that make no sense are refused. */
static void zeros_and_nonsense(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    const sl_int p[4] = {0, 1, 2, 3}, i[3] = {0, 1, 2};
    const double a[3] = {0, 0, 0};
    const sl_csc A = {3, 3, p, i, a};
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    for (int k = 0; k < ways.count; k++) {
        sl_int signs[3] = {1, -1, 0};
        sl_options opt = options_regular(&ways, k, 0.25, signs);
        sl_factor *F = NULL;
        sl_stats stats;
        double b[3] = {1, 1, 1}, x[3];
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
        assert_int_equal(stats.regularized, 3);
        SL_CHECK(sl_factor_solve(F, x, 3, b, 3, 1, NULL));
        assert_true(x[0] == 4.0 && x[1] == -4.0 && x[2] == 4.0);
        sl_factor_free(F);
        static const double bad[3] = {-1.0, NAN, INFINITY};
        for (int m = 0; m < 3; m++) {
            opt.regularization = bad[m];
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, &opt, &stats));
        }
        opt.regularization = 1e-8;
        opt.definiteness = SL_SEMIDEFINITE;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, &opt, &stats));
        opt.definiteness = SL_DEFINITE;
        signs[1] = 2;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, &opt, &stats));
        assert_int_equal(stats.error_row, 1);
        signs[1] = -2;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, &opt, &stats));
        assert_null(F);
    }
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dependent_constraints),
        cmocka_unit_test(right_and_wrong_signs),
        cmocka_unit_test(positive_without_signs),
        cmocka_unit_test(zeros_and_nonsense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
