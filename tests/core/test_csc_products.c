/* test_csc_products.c: products with a sparse matrix, residuals and backward errors */
#include "tests/lib/check_factor.h"

static void multiply_reads_the_triangle_that_is_factored(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 20, 0, 4);
        for (int which = 0; which < GEN_STYLES; which++) {
            gen_matrix_t M = gen_store(&t, gen_style(which), 9);
            sl_int n = t.n;
            /* values above the diagonal are not read */
            if (gen_style(which).triangle == SL_TRIANGLE_BOTH) {
                for (sl_int j = 0; j < n; j++) {
                    for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
                        M.x[p] = M.i[p] < j ? 1e30 : M.x[p];
                    }
                }
            }
            double *D = ref_dense(&M.view), *X = test_reals(3 * (size_t)(n + 2)),
                   *Y = test_reals(3 * (size_t)(n + 1));
            gen_reals(X, 3 * (size_t)(n + 2), 17);
            SL_CHECK(
                sl_csc_multiply(&M.view, SL_AS_SYMMETRIC, Y, (size_t)n + 1, X, (size_t)n + 2, 3));
            for (sl_int r = 0; r < 3; r++) {
                for (sl_int i = 0; i < n; i++) {
                    double sum = 0, size = 0;
                    for (sl_int j = 0; j < n; j++) {
                        double term = AT(D, i, j) * X[j + r * (n + 2)];
                        sum += term;
                        size += fabs(term);
                    }
                    assert_true(fabs(Y[i + r * (n + 1)] - sum) <=
                                4.0 * (double)(n + 2) * DBL_EPSILON * size);
                }
            }
            free(D);
            free(X);
            free(Y);
            gen_matrix_free(&M);
        }
        gen_list_free(&t);
    }
}

static void multiply_reads_entries_as_stored(void **state) {
    (void)state;
    const sl_int p[4] = {0, 2, 2, 5}, i[5] = {1, 0, 1, 1, 0};
    const double x[5] = {2, 3, 4, 5, 6}, X[6] = {1, 10, 100, -1, -10, -100};
    double Y[6] = {9, 9, 9, 9, 9, 9};
    const double expected[6] = {603, 902, 9, -603, -902, 9}; /* ldy = 3: the gap is not written */
    sl_csc A = {2, 3, p, i, x};
    SL_CHECK(sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 3, 2));
    SAME_VALUES(Y, expected, 6);
    SL_CHECK(sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 3, 0));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_SYMMETRIC, Y, 3, X, 3, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 1, X, 3, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 3, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, NULL, 3, X, 3, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 3, NULL, 3, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(NULL, SL_AS_STORED, Y, 3, X, 3, 1));
    A.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 3, 1));
    SAME_VALUES(Y, expected, 6);
}

static void residuals_and_backward_errors_by_hand(void **state) {
    (void)state;
    /* [2 1; 1 3], row sums 3 and 4 */
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double x[3] = {2, 1, 3};
    sl_csc A = {2, 2, p, i, x};
    double X[6] = {1, 1, 1, 1, 0, 0}, B[6] = {3, 4, 3.5, 4, 0, 0}, R[6], eta[3];
    SL_CHECK(sl_csc_residual(&A, R, 2, eta, X, 2, B, 2, 3));
    const double expected[6] = {0, 0, 0.5, 0, 0, 0};
    SAME_VALUES(R, expected, 6);
    assert_true(eta[0] == 0.0 && eta[2] == 0.0);
    assert_true(fabs(eta[1] - 0.5 / 8.0) < 1e-15);            /* 0.5 / (4 * 1 + 4) */
    SL_CHECK(sl_csc_residual(&A, B, 2, NULL, X, 2, B, 2, 3)); /* in place of B */
    SAME_VALUES(B, expected, 6);
    const sl_csc empty = {0, 0, NULL, NULL, NULL};
    eta[0] = eta[2] = 7.0;
    SL_CHECK(sl_csc_residual(&empty, R, 2, NULL, X, 2, B, 2, 3));
    SL_CHECK(sl_csc_residual(&empty, R, 2, eta, X, 2, B, 2, 3));
    assert_true(eta[0] == 0.0 && eta[2] == 0.0);
    /* overlapping arrays with different strides, and arrays that overlap X, are refused */
    double apart[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    const double kept[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, apart, 2, NULL, X, 2, apart, 3, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, apart, 3, NULL, X, 2, apart, 2, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, apart, 2, NULL, apart, 2, B, 2, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, apart, 2, eta, apart, 2, B, 2, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, apart, 2, eta, X, 2, apart, 2, 3));
    SAME_VALUES(apart, kept, 9);
    X[1] = NAN;
    SL_CHECK(sl_csc_residual(&A, R, 2, eta, X, 2, B, 2, 1));
    assert_true(eta[0] != eta[0]);
    SL_CHECK(sl_csc_residual(&A, R, 2, eta, X, 2, B, 2, 0));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, R, 1, eta, X, 2, B, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, R, 2, eta, X, 1, B, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, R, 2, eta, X, 2, B, 1, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, R, 2, eta, X, 2, B, 2, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, NULL, 2, eta, X, 2, B, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(NULL, R, 2, eta, X, 2, B, 2, 1));
}

/* The backward error is NaN, not 0, if the norms overflow or are not numbers. */
static void the_backward_error_of_an_overflow_is_nan(void **state) {
    (void)state;
    const sl_int p[4] = {0, 3, 4, 5}, i[5] = {0, 1, 2, 1, 2};
    double x[5] = {1e308, 1e308, 1, 1e308, 1}, R[3], eta;
    sl_csc A = {3, 3, p, i, x};
    double X[3] = {1e-300, 0, 0}, B[3] = {1, 1, 1};
    SL_CHECK(sl_csc_residual(&A, R, 3, &eta, X, 3, B, 3, 1)); /* the row sum overflows */
    assert_true(isfinite(R[0]) && R[0] != 0 && eta != eta);
    x[0] = x[1] = x[3] = 1e200; /* ||A|| ||x|| overflows; the products that occur in A x do not */
    X[0] = 0;
    X[2] = 1e200;
    SL_CHECK(sl_csc_residual(&A, R, 3, &eta, X, 3, B, 3, 1));
    assert_true(isfinite(R[0]) && R[0] != 0 && eta != eta);
    X[2] = 0;
    B[0] = 0; /* r = b = 0: no error */
    B[1] = B[2] = 0;
    SL_CHECK(sl_csc_residual(&A, R, 3, &eta, X, 3, B, 3, 1));
    assert_true(eta == 0);
    x[0] = NAN; /* the first row sum is NaN, the later ones are not */
    SL_CHECK(sl_csc_residual(&A, R, 3, &eta, X, 3, B, 3, 1));
    assert_true(eta != eta);
    x[0] = 1e200;
    B[1] = INFINITY;
    SL_CHECK(sl_csc_residual(&A, R, 3, &eta, X, 3, B, 3, 1));
    assert_true(eta != eta);
}

static void every_style_gives_the_same_residual(void **state) {
    (void)state;
    gen_list_t t = gen_make(GEN_RANDOM, 40, 0, 8);
    double X[40], B[40], first = -1.0;
    gen_reals(X, 40, 1);
    gen_reals(B, 40, 2);
    for (int which = 0; which < GEN_STYLES; which++) {
        gen_matrix_t M = gen_store(&t, gen_style(which), 31);
        double R[40], eta;
        SL_CHECK(sl_csc_residual(&M.view, R, 40, &eta, X, 40, B, 40, 1));
        assert_true(eta > 0.0);
        if (which == 0) {
            first = eta;
        } else {
            /* duplicates count by their sum, not by their magnitudes */
            assert_true(fabs(eta - first) <= 1e-13 * first);
        }
        gen_matrix_free(&M);
    }
    gen_list_free(&t);
}

/* Several columns share a pass over A; each has the bits that it has alone. */
static void each_of_several_columns_is_the_same_alone(void **state) {
    (void)state;
    enum { N = 40, COLUMNS = 7, LD = N + 2 };
    double X[COLUMNS * LD], B[COLUMNS * LD], Y[COLUMNS * LD], one[N], eta[COLUMNS], eta_one;
    gen_reals(X, COLUMNS * LD, 1);
    gen_reals(B, COLUMNS * LD, 2);
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, N, 0, 8);
        for (int which = 0; which < GEN_STYLES && t.n <= N; which++) {
            gen_matrix_t M = gen_store(&t, gen_style(which), 31);
            const size_t n = (size_t)t.n;
            for (int reading = 0; reading < 2; reading++) {
                const sl_reading as = reading ? SL_AS_STORED : SL_AS_SYMMETRIC;
                SL_CHECK(sl_csc_multiply(&M.view, as, Y, LD, X, LD, COLUMNS));
                for (int r = 0; r < COLUMNS; r++) {
                    SL_CHECK(sl_csc_multiply(&M.view, as, one, n, X + r * LD, LD, 1));
                    SAME_VALUES(Y + r * LD, one, n);
                }
            }
            SL_CHECK(sl_csc_residual(&M.view, Y, LD, eta, X, LD, B, LD, COLUMNS));
            for (int r = 0; r < COLUMNS; r++) {
                SL_CHECK(
                    sl_csc_residual(&M.view, one, n, &eta_one, X + r * LD, LD, B + r * LD, LD, 1));
                SAME_VALUES(Y + r * LD, one, n);
                assert_true(eta[r] == eta_one);
            }
            gen_matrix_free(&M);
        }
        gen_list_free(&t);
    }
}

/* Products need the arrays of A, and a result apart from X. */
static void missing_arrays_and_products_in_place_are_refused(void **state) {
    (void)state;
    const sl_int p[3] = {0, 1, 2}, i[2] = {0, 1};
    const double x[2] = {2, 3};
    double X[2] = {1, 1}, Y[2] = {5, 5}, B[2] = {1, 1}, eta = 7;
    const sl_csc A = {2, 2, p, i, x};
    sl_csc bad[6] = {A, A, A, A, A, A};
    bad[0].p = NULL;
    bad[1].i = NULL;
    bad[2].x = NULL;
    bad[3].n_rows = bad[3].n_cols = -1;
    bad[4].p = NULL;
    bad[4].n_rows = bad[4].n_cols = INT32_MAX;
    bad[5].n_cols = -1;
    for (int k = 0; k < 6; k++) {
        SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&bad[k], SL_AS_STORED, Y, 2, X, 2, 1));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&bad[k], SL_AS_SYMMETRIC, Y, 2, X, 2, 1));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&bad[k], Y, 2, &eta, X, 2, B, 2, 1));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&bad[k], Y, 2, NULL, X, 2, B, 2, 1));
    }
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, X, 2, X, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_SYMMETRIC, X, 2, X, 2, 1));
    assert_true(Y[0] == 5 && Y[1] == 5 && X[0] == 1 && X[1] == 1 && eta == 7);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, (sl_reading)7, Y, 2, X, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 2, NULL, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, Y, 2, &eta, X, 2, NULL, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, Y, 2, &eta, NULL, 2, B, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, NULL, 2, &eta, X, 2, B, 2, 1));
    const sl_csc tall = {2, 1, p, i, x};
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&tall, Y, 2, &eta, X, 2, B, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&tall, SL_AS_SYMMETRIC, Y, 2, X, 2, 1));
    assert_true(Y[0] == 5 && Y[1] == 5 && eta == 7);
    const sl_int empty[3] = {0, 0, 0};
    const sl_csc no_columns = {2, 0, empty, NULL, NULL};
    SL_CHECK(sl_csc_multiply(&no_columns, SL_AS_STORED, Y, 2, NULL, 0, 1));
    assert_true(Y[0] == 0 && Y[1] == 0);
    Y[0] = Y[1] = 5;
    const sl_csc E = {2, 2, empty, NULL, NULL}; /* without entries the arrays may be missing */
    SL_CHECK(sl_csc_multiply(&E, SL_AS_STORED, Y, 2, X, 2, 1));
    assert_true(Y[0] == 0 && Y[1] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(missing_arrays_and_products_in_place_are_refused),
        cmocka_unit_test(multiply_reads_the_triangle_that_is_factored),
        cmocka_unit_test(multiply_reads_entries_as_stored),
        cmocka_unit_test(residuals_and_backward_errors_by_hand),
        cmocka_unit_test(the_backward_error_of_an_overflow_is_nan),
        cmocka_unit_test(every_style_gives_the_same_residual),
        cmocka_unit_test(each_of_several_columns_is_the_same_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
