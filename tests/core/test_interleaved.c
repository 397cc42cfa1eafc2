/* test_interleaved.c: interleaved right-hand sides give the bits of column-major ones */
#include "tests/lib/factored.h"

enum { MOST = 17, GUARD = 4 };

/* copies rows x nrhs, column-major with leading dimension rows, to rows of ld elements; the other
 * elements are `rest` */
static double *to_rows(const double *M, size_t rows, size_t nrhs, size_t ld, double rest) {
    double *R = test_reals(rows * ld + 1);
    for (size_t q = 0; q < rows * ld; q++) {
        R[q] = q % ld < nrhs ? M[q / ld + q % ld * rows] : rest;
    }
    return R;
}

/* the rows of R hold the columns of M, and the other elements are unchanged */
static void assert_rows(const double *R, size_t ld, const double *M, size_t rows, size_t nrhs,
                        double rest) {
    for (size_t k = 0; k < rows; k++) {
        for (size_t r = 0; r < ld; r++) {
            if (r < nrhs) {
                SAME_VALUES(R + k * ld + r, M + k + r * rows, 1);
            } else {
                assert_true(R[k * ld + r] == rest);
            }
        }
    }
}

static void full_solves_of_both_layouts_have_the_same_bits(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    static const gen_kind_t kinds[4] = {GEN_GRID2, GEN_KKT, GEN_ONE, GEN_GRID3};
    for (int k = 0; k < 4 * isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k / 4];
        factored_t y = factored_make(kinds[k % 4], 90, 1, 0, &opt);
        size_t n = (size_t)y.M.view.n_cols;
        for (sl_int nrhs = 0; nrhs <= MOST; nrhs++) {
            size_t cols = (size_t)nrhs, ldb = cols + GUARD, ldx = cols + (nrhs % 2 ? 0 : GUARD);
            double *B = test_reals(n * MOST), *X = test_reals(n * MOST);
            gen_reals(B, n * MOST, 6);
            SL_CHECK(sl_factor_solve(y.F, X, n, B, n, nrhs, NULL));
            double *Bi = to_rows(B, n, cols, ldb, 77.0), *Xi = to_rows(B, n, 0, ldx, 1234.5);
            SL_CHECK(sl_factor_solve(y.F, Xi, SL_ROWS(ldx), Bi, SL_ROWS(ldb), nrhs, NULL));
            assert_rows(Xi, ldx, X, n, cols, 1234.5);
            assert_rows(Bi, ldb, B, n, cols, 77.0);
            SL_CHECK(sl_factor_solve(y.F, Bi, SL_ROWS(ldb), Bi, SL_ROWS(ldb), nrhs,
                                     NULL)); /* in place */
            assert_rows(Bi, ldb, X, n, cols, 77.0);
            free(B);
            free(X);
            free(Bi);
            free(Xi);
        }
        factored_free(&y);
    }
}

static void plan_solves_of_both_layouts_have_the_same_bits(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_GRID2, 200, 1, 0, &opt);
        sl_int bset[30], xset[45];
        for (sl_int q = 0; q < 30; q++) {
            bset[q] = 5 * (29 - q) + 3;
        }
        for (sl_int q = 0; q < 45; q++) {
            xset[q] = 4 * q;
        }
        sl_plan *P = NULL;
        SL_CHECK(sl_plan_create(&P, y.S, bset, 30, xset, 45, NULL, NULL));
        for (sl_int nrhs = 0; nrhs <= MOST; nrhs++) {
            size_t cols = (size_t)nrhs, ld = cols + GUARD;
            double B[30 * MOST], X[45 * MOST];
            gen_reals(B, 30 * MOST, 9);
            SL_CHECK(sl_plan_solve(P, y.F, X, 45, B, 30, nrhs, NULL));
            double *Bi = to_rows(B, 30, cols, ld, 77.0), *Xi = to_rows(B, 45, 0, ld, 1234.5);
            SL_CHECK(sl_plan_solve(P, y.F, Xi, SL_ROWS(ld), Bi, SL_ROWS(ld), nrhs, NULL));
            assert_rows(Xi, ld, X, 45, cols, 1234.5);
            assert_rows(Bi, ld, B, 30, cols, 77.0);
            memcpy(Xi, Bi, 30 * ld * sizeof *Bi); /* in place, with more rows of X than of B */
            SL_CHECK(sl_plan_solve(P, y.F, Xi, SL_ROWS(ld), Xi, SL_ROWS(ld), nrhs, NULL));
            for (size_t q = 0; q < 45; q++) {
                for (size_t r = 0; r < cols; r++) {
                    SAME_VALUES(Xi + q * ld + r, X + q + r * 45, 1);
                }
            }
            free(Bi);
            free(Xi);
        }
        sl_plan_free(P);
        factored_free(&y);
    }
}

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_PATH, 6, 1, 0, NULL);
    factored_t z = factored_make(GEN_PATH, 6, 1, 0, NULL);
    const sl_int set[2] = {1, 4};
    double X[18] = {1, 2}, B[18] = {3, 4};
    sl_plan *P = NULL;
    SL_CHECK(sl_plan_create(&P, y.S, set, 2, set, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(NULL, X, SL_ROWS(3), B, SL_ROWS(3), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, NULL, SL_ROWS(3), B, SL_ROWS(3), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, SL_ROWS(3), NULL, SL_ROWS(3), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, SL_ROWS(2), B, SL_ROWS(3), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, SL_ROWS(3), B, SL_ROWS(2), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, SL_ROWS(3), B, SL_ROWS(3), -1, NULL));
    /* in place with different strides */
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, SL_ROWS(3), X, SL_ROWS(2), 2, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, 6, X, SL_ROWS(6), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, SL_ROWS(0), B, 6, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(NULL, y.F, X, SL_ROWS(3), B, SL_ROWS(3), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, NULL, X, SL_ROWS(3), B, SL_ROWS(3), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, X, SL_ROWS(2), B, SL_ROWS(3), 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, X, SL_ROWS(3), B, SL_ROWS(2), 3, NULL));
    /* negative strides, and a bit that later layouts may use */
    const size_t back = (size_t)-6, later = SL_ROW_MAJOR >> 1;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, back, B, back, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, 6, B, 6 | later, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, X, SL_ROWS(3) | later, B, 2, 3, NULL));
    SL_EXPECT(SL_ERR_MISMATCH, sl_plan_solve(P, z.F, X, SL_ROWS(3), B, SL_ROWS(3), 3,
                                             NULL)); /* of another analysis */
    assert_true(X[0] == 1 && X[1] == 2 && X[2] == 0);
    /* leading dimensions below n, and as large as there are bits left for one */
    SL_CHECK(sl_factor_solve(y.F, X, SIZE_MAX / 4, B, 6, 1, NULL));
    SL_CHECK(sl_factor_solve(y.F, X, SL_ROWS(1), B, SL_ROWS(1), 1, NULL));
    sl_plan_free(P);
    factored_free(&y);
    factored_free(&z);
}

/* One-shot local solves, half solves and products take rows; X and B may have different layouts. */
static void every_solve_takes_any_layout(void **state) {
    (void)state;
    enum { NB = 20, NX = 33, SIZE = 200 };
    factored_t y = factored_make(GEN_GRID2, SIZE, 1, 0, NULL);
    const size_t n = (size_t)y.M.view.n_cols;
    const unsigned forward = SL_PART_P | SL_PART_L;
    sl_int bset[SIZE], xset[SIZE];
    sl_plan *P = NULL;
    gen_set(bset, NB, SIZE / 2, 1);
    gen_set(xset, NX, SIZE / 2, 2);
    SL_CHECK(sl_plan_create(&P, y.S, bset, NB, xset, NX, NULL, NULL));
    sl_stats stats;
    sl_plan_stats(P, &stats);
    const size_t reached = (size_t)stats.plan.b_columns;
    for (sl_int nrhs = 1; nrhs <= MOST; nrhs++) {
        for (int call = 0; call < 5; call++) {
            const size_t cols = (size_t)nrhs, ld = cols + GUARD;
            const size_t nb = call == 0 || call == 4 ? NB : n;
            const size_t nx = call == 0 ? NX : call == 4 ? reached : n;
            double *B = test_reals(nb * cols), *X = test_reals(nx * cols);
            gen_reals(B, nb * cols, 9);
            for (int layout = 0; layout < 4; layout++) { /* 0: both by columns, the reference */
                double *Bt = layout & 1 ? to_rows(B, nb, cols, ld, 77.0) : B;
                double *Xt = layout & 2 ? to_rows(B, nx, 0, ld, 1234.5) : test_reals(nx * cols);
                const size_t ldb = layout & 1 ? SL_ROWS(ld) : nb;
                const size_t ldx = layout & 2 ? SL_ROWS(ld) : nx;
                SL_CHECK(
                    call == 0   ? sl_local_solve(y.F, bset, NB, xset, NX, Xt, ldx, Bt, ldb, nrhs,
                                                 NULL, NULL)
                    : call == 1 ? sl_factor_solve(y.F, Xt, ldx, Bt, ldb, nrhs, NULL)
                    : call == 2
                        ? sl_factor_solve_part(y.F, NULL, forward, Xt, ldx, Bt, ldb, nrhs, NULL)
                    : call == 3
                        ? sl_factor_multiply_part(y.F, SL_PART_LT, Xt, ldx, Bt, ldb, nrhs, NULL)
                        : sl_factor_solve_part(y.F, P, forward, Xt, ldx, Bt, ldb, nrhs, NULL));
                if (layout == 0) {
                    memcpy(X, Xt, nx * cols * sizeof *X);
                } else if (layout & 2) {
                    assert_rows(Xt, ld, X, nx, cols, 1234.5);
                } else {
                    assert_memory_equal(Xt, X, nx * cols * sizeof *X);
                }
                if (layout & 1) {
                    assert_rows(Bt, ld, B, nb, cols, 77.0);
                    free(Bt);
                }
                free(Xt);
            }
            free(B);
            free(X);
        }
    }
    sl_plan_free(P);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_solves_of_both_layouts_have_the_same_bits),
        cmocka_unit_test(plan_solves_of_both_layouts_have_the_same_bits),
        cmocka_unit_test(every_solve_takes_any_layout),
        cmocka_unit_test(invalid_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
