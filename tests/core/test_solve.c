/* test_solve.c: full solves: errors, blocks, leading dimensions, aliasing, workspaces */
#include "tests/lib/factored.h"
#include "tests/lib/reserved.h"

enum { MOST = 17 };

static void backward_errors_are_small(void **state) {
    (void)state;
    static const sl_int sizes[4] = {4, 20, 100, 700};
    isa_list_t isas = isas_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 4; size++) {
            for (int k = 0; k < isas.count; k++) {
                for (int relaxation = 0; relaxation < 2; relaxation++) {
                    sl_options opt = options_none();
                    opt.isa = isas.isa[k];
                    opt.relaxation = (sl_relaxation)relaxation;
                    factored_t y = factored_make((gen_kind_t)kind, sizes[size], size % 3 - 1,
                                                 kind % GEN_STYLES, &opt);
                    sl_int n = y.M.view.n_cols;
                    size_t ld = (size_t)n + 3;
                    double *B = test_reals(ld * MOST), *X = test_reals(ld * MOST);
                    gen_reals(B, ld * MOST, 6);
                    for (sl_int nrhs = 1; nrhs <= MOST; nrhs += size < 2 ? 1 : 4) {
                        SL_CHECK(sl_factor_solve(y.F, X, ld, B, ld, nrhs, NULL));
                        BACKWARD_PASSES(&y.M.view, X, ld, B, ld, nrhs);
                    }
                    free(B);
                    free(X);
                    factored_free(&y);
                }
            }
        }
    }
}

static void solutions_match_dense_solutions(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        if (kind == GEN_SCALED) {
            continue; /* ill conditioned: only the backward error is promised */
        }
        for (int k = 0; k < isas.count; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            factored_t y = factored_make((gen_kind_t)kind, 60, 0, 0, &opt);
            sl_int n = y.M.view.n_cols;
            double *M = ref_dense(&y.M.view), *B = test_reals((size_t)n * 5),
                   *X = test_reals((size_t)n * 5);
            double largest = 0;
            gen_reals(B, (size_t)n * 5, 6);
            SL_CHECK(sl_factor_solve(y.F, X, (size_t)n, B, (size_t)n, 5, NULL));
            ref_solve(n, M, B, 5);
            for (sl_int q = 0; q < 5 * n; q++) {
                largest = fabs(B[q]) > largest ? fabs(B[q]) : largest;
            }
            /* Condition numbers here are below 1e4. */
            for (sl_int q = 0; q < 5 * n; q++) {
                assert_true(fabs(X[q] - B[q]) <= 1e4 * (double)n * DBL_EPSILON * largest);
            }
            free(M);
            free(B);
            free(X);
            factored_free(&y);
        }
    }
}

/* Nothing outside the n x nrhs block of X is written, B does not change, and X may be B. */
static void leading_dimensions_and_aliasing_work(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    static const gen_kind_t kinds[4] = {GEN_GRID2, GEN_KKT, GEN_ONE, GEN_COMPONENTS};
    for (int k = 0; k < 4 * isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k / 4];
        factored_t y = factored_make(kinds[k % 4], 75, 1, 0, &opt);
        size_t n = (size_t)y.M.view.n_cols;
        for (sl_int nrhs = 0; nrhs <= MOST; nrhs++) {
            size_t ldx = n + 5, ldb = n + 2, cols = (size_t)nrhs;
            double *X = test_reals(ldx * (MOST + 1)), *B = test_reals(ldb * MOST),
                   *B2 = test_reals(ldb * MOST);
            double *C = test_reals(n * MOST);
            for (size_t q = 0; q < ldx * (MOST + 1); q++) {
                X[q] = 1234.5;
            }
            gen_reals(B, ldb * MOST, 5);
            memcpy(B2, B, ldb * MOST * sizeof *B);
            SL_CHECK(sl_factor_solve(y.F, X, ldx, B, ldb, nrhs, NULL));
            assert_memory_equal(B, B2, ldb * MOST * sizeof *B);
            for (size_t q = 0; q < ldx * (MOST + 1); q++) {
                if (q / ldx >= cols || q % ldx >= n) {
                    assert_true(X[q] == 1234.5);
                }
            }
            SL_CHECK(sl_factor_solve(y.F, B, ldb, B, ldb, nrhs, NULL));
            SL_CHECK(sl_factor_solve(y.F, C, n, B2, ldb, nrhs, NULL));
            for (size_t r = 0; r < cols; r++) {
                SAME_VALUES(X + r * ldx, B + r * ldb, n);
                SAME_VALUES(X + r * ldx, C + r * n, n);
            }
            /* The rest of B is unchanged. */
            for (size_t q = 0; q < ldb * MOST; q++) {
                assert_true(q / ldb < cols && q % ldb < n ? 1 : B[q] == B2[q]);
            }
            free(X);
            free(B);
            free(B2);
            free(C);
        }
        factored_free(&y);
    }
}

/* For a given nrhs, column r of X depends only on column r of B, whatever the other columns hold:
 * zeros, NaN, other values. */
static void a_column_does_not_depend_on_the_others(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        static const gen_kind_t kinds[3] = {GEN_GRID2, GEN_KKT, GEN_GRID3};
        for (int which = 0; which < 3; which++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            factored_t y = factored_make(kinds[which], 130, 1, 0, &opt);
            size_t n = (size_t)y.M.view.n_cols;
            double *B = test_reals(n * MOST), *X = test_reals(n * MOST), *Y = test_reals(n * MOST);
            for (sl_int nrhs = 1; nrhs <= MOST; nrhs++) {
                size_t cols = (size_t)nrhs;
                gen_reals(B, n * MOST, 5);
                SL_CHECK(sl_factor_solve(y.F, X, n, B, n, nrhs, NULL));
                for (size_t r = 0; r < cols; r++) {
                    for (size_t q = 0; q < n * cols; q++) {
                        if (q / n != r) {
                            B[q] = q % 3 == 0 ? NAN : q % 3 == 1 ? 0.0 : 1e200;
                        }
                    }
                    SL_EXPECT(nrhs > 1 ? SL_ERR_NOT_FINITE : SL_OK,
                              sl_factor_solve(y.F, Y, n, B, n, nrhs, NULL));
                    SAME_VALUES(X + r * n, Y + r * n, n);
                    gen_reals(B, n * MOST, 5);
                }
            }
            free(B);
            free(X);
            free(Y);
            factored_free(&y);
        }
    }
}

/* Equal columns of a block have equal solutions, and repeating a call repeats its bits. */
static void equal_columns_have_equal_solutions(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_GRID2, 200, 1, 0, &opt);
        size_t n = (size_t)y.M.view.n_cols;
        double *B = test_reals(n * 8), *X = test_reals(n * 8), *Y = test_reals(n * 8);
        for (sl_int nrhs = 1; nrhs <= 8; nrhs++) {
            for (size_t r = 0; r < (size_t)nrhs; r++) {
                gen_reals(B + r * n, n, 99);
            }
            SL_CHECK(sl_factor_solve(y.F, X, n, B, n, nrhs, NULL));
            SL_CHECK(sl_factor_solve(y.F, Y, n, B, n, nrhs, NULL));
            for (size_t r = 0; r < (size_t)nrhs; r++) {
                SAME_VALUES(X, X + r * n, n);
            }
            SAME_VALUES(X, Y, n * (size_t)nrhs);
        }
        free(B);
        free(X);
        free(Y);
        factored_free(&y);
    }
}

/* A workspace may be used for problems of any size in any order. What an earlier solve left in it
 * must not matter. */
static void a_workspace_works_across_sizes(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    static const sl_int sizes[6] = {30, 400, 3, 150, 1, 400};
    counter_t counter = counter_make();
    sl_options counted = options_counted(&counter);
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, &counted));
    for (int round = 0; round < 12; round++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[round % isas.count];
        factored_t y =
            factored_make(round % 2 ? GEN_GRID2 : GEN_RANDOM, sizes[round % 6], 1, 0, &opt);
        size_t n = (size_t)y.M.view.n_cols;
        double *B = test_reals(n * MOST), *X = test_reals(n * MOST), *Y = test_reals(n * MOST);
        gen_reals(B, n * MOST, (uint64_t)round);
        for (sl_int nrhs = MOST; nrhs >= 0; nrhs -= 4) {
            SL_CHECK(sl_factor_solve(y.F, X, n, B, n, nrhs, W));
            SL_CHECK(sl_factor_solve(y.F, Y, n, B, n, nrhs, NULL));
            SAME_VALUES(X, Y, n * (size_t)nrhs);
        }
        /* A NaN of one solve must leave no trace in the next. */
        B[0] = NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_solve(y.F, X, n, B, n, MOST, W));
        gen_reals(B, n * MOST, (uint64_t)round);
        SL_CHECK(sl_factor_solve(y.F, X, n, B, n, 1, W));
        SAME_VALUES(X, Y, n);
        assert_true(counter.live_bytes >= sl_work_bytes(W));
        free(B);
        free(X);
        free(Y);
        factored_free(&y);
    }
    sl_work_free(W);
    sl_work_free(NULL);
    COUNTER_CLEAN(&counter);
}

static void a_grown_workspace_allocates_nothing(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    factored_t y = factored_make(GEN_GRID2, 900, 1, 0, &opt);
    size_t n = (size_t)y.M.view.n_cols;
    double *B = test_reals(n * MOST), *X = test_reals(n * MOST);
    sl_work *W = NULL;
    gen_reals(B, n * MOST, 1);
    SL_CHECK(sl_work_create(&W, &opt));
    RESERVE_FOR(W, NULL, sl_factor_solve(y.F, X, n, B, n, 5, trial));
    size_t calls = counter.calls;
    for (sl_int nrhs = 0; nrhs <= 5; nrhs++) {
        SL_CHECK(sl_factor_solve(y.F, X, n, B, n, nrhs, W));
    }
    assert_int_equal(counter.calls, calls);
    SL_CHECK(sl_factor_solve(y.F, X, n, B, n, MOST, W)); /* grows once */
    calls = counter.calls;
    size_t bytes = sl_work_bytes(W);
    for (sl_int nrhs = MOST; nrhs > 0; nrhs--) {
        SL_CHECK(sl_factor_solve(y.F, X, n, B, n, nrhs, W));
    }
    assert_int_equal(counter.calls, calls);
    assert_int_equal(sl_work_bytes(W), bytes);
    /* O(n min(nrhs, 8)), not O(n nrhs) */
    assert_true(bytes <= 4 * n * 8 * sizeof(double) + 100000);
    free(B);
    free(X);
    B = test_reals(n * 70);
    X = test_reals(n * 70);
    SL_CHECK(sl_factor_solve(y.F, X, n, B, n, 70, W));
    assert_true(sl_work_bytes(W) <= 4 * n * 32 * sizeof(double) + 100000);
    free(B);
    free(X);
    sl_work_free(W);
    factored_free(&y);
    COUNTER_CLEAN(&counter);
}

static void empty_problems_work(void **state) {
    (void)state;
    factored_t empty = factored_make(GEN_NONE, 0, 1, 0, NULL),
               y = factored_make(GEN_PATH, 4, 1, 0, NULL);
    double one = 5;
    for (sl_int nrhs = 0; nrhs <= 9; nrhs++) {
        SL_CHECK(sl_factor_solve(empty.F, &one, 1, &one, 1, nrhs, NULL));
    }
    SL_CHECK(sl_factor_solve(y.F, &one, 4, &one, 4, 0, NULL));
    assert_true(one == 5);
    factored_free(&empty);
    factored_free(&y);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_PATH, 6, 1, 0, NULL);
    double X[12] = {1, 2}, B[12] = {3, 4};
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(NULL, X, 6, B, 6, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, NULL, 6, B, 6, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, 6, NULL, 6, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, 5, B, 6, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, 6, B, 5, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, 6, B, 6, -1, NULL));
    /* In place with two leading dimensions. */
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve(y.F, X, 7, X, 6, 1, NULL));
    assert_true(X[0] == 1 && X[1] == 2 && X[2] == 0);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_create(NULL, NULL));
    factored_free(&y);
}

/* The permuted matrix has the permuted solution. */
static void a_permuted_system_has_the_permuted_solution(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_RANDOM, 80, 0, 0, NULL);
    sl_int n = y.M.view.n_cols, perm[80];
    double b[80], pb[80], x[80], px[80];
    sl_matrix *P = NULL;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    gen_permutation(perm, n, 4);
    gen_reals(b, 80, 3);
    for (sl_int k = 0; k < n; k++) {
        pb[k] = b[perm[k]];
    }
    SL_CHECK(sl_matrix_submatrix(&P, &y.M.view, perm, y.M.view.n_cols, NULL, NULL));
    sl_csc C = sl_matrix_view(P);
    SL_CHECK(sl_symbolic_create(&S, &C, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &C, NULL, NULL));
    SL_CHECK(sl_factor_solve(F, px, 80, pb, 80, 1, NULL));
    SL_CHECK(sl_factor_solve(y.F, x, 80, b, 80, 1, NULL));
    for (sl_int k = 0; k < n; k++) {
        assert_true(fabs(px[k] - x[perm[k]]) <= 1e4 * 80 * DBL_EPSILON);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(P);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(backward_errors_are_small),
        cmocka_unit_test(solutions_match_dense_solutions),
        cmocka_unit_test(leading_dimensions_and_aliasing_work),
        cmocka_unit_test(a_column_does_not_depend_on_the_others),
        cmocka_unit_test(equal_columns_have_equal_solutions),
        cmocka_unit_test(a_workspace_works_across_sizes),
        cmocka_unit_test(a_grown_workspace_allocates_nothing),
        cmocka_unit_test(empty_problems_work),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(a_permuted_system_has_the_permuted_solution),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
