/* test_bounds_scales.c: sizes of bounds: scaled rows, norms out of range, kept scales, sharpness */
#include "tests/lib/exact_solve.h"
#include "tests/lib/saved.h"
#include "tests/lib/zero_mean.h"

enum { SIDE = 40, N = SIDE * SIDE };

/* S A S with powers of 2 in S: L, D, x and its bounds scale exactly, in spite of squares that leave
 * the range of double. */
static void bounds_scale_with_the_rows(void **state) {
    (void)state;
    static const sl_int bset[2] = {7, 50};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    const sl_csc A = y.M.view;
    double bounds[2][2][2 * 100], x[2 * 100], b[2 * 2] = {1.0, -0.5, 0.75, 0.25};
    sl_plan *P = NULL;
    int exponent[100];
    for (int k = 0; k < 100; k++) {
        exponent[k] = k % 2 ? 280 : -280;
    }
    SL_CHECK(sl_plan_create(&P, y.S, bset, 2, NULL, SL_ALL, NULL, NULL));
    for (int turn = 0; turn < 2; turn++) {
        SL_CHECK(sl_factor_refactor(y.F, &A, NULL));
        SL_CHECK(sl_factor_certify(y.F, &A, SL_GUARANTEED, NULL, NULL));
        for (sl_int nrhs = 1; nrhs <= 2; nrhs++) {
            double *found = bounds[turn][nrhs - 1];
            SL_CHECK(sl_plan_solve_bounded(P, y.F, x, 100, found, b, 2, nrhs, NULL, NULL, NULL));
            for (int k = 0; k < 100 * nrhs; k++) {
                const double scaled = ldexp(found[k], turn * exponent[k % 100]);
                assert_true(scaled > 0.0 && scaled == bounds[0][nrhs - 1][k]);
            }
        }
        for (int j = 0; j < 100; j++) {
            for (sl_int q = A.p[j]; q < A.p[j + 1]; q++) {
                y.M.x[q] = ldexp(y.M.x[q], exponent[A.i[q]] + exponent[j]);
            }
        }
        for (int k = 0; k < 4; k++) {
            b[k] = ldexp(b[k], exponent[bset[k % 2]]);
        }
    }
    sl_plan_free(P);
    factored_free(&y);
}

/* Squares of b leave the range: no bound is known. Those of b = 0 are 0, and so are those of other
 * components. */
static void unknown_norms_give_infinite_bounds(void **state) {
    (void)state;
    static const sl_int column[5] = {0, 2, 3, 4, 5}, row[5] = {0, 1, 1, 2, 3}, bset[2] = {0, 1};
    static const double values[5] = {2.0, -1.0, 3.0, 2.0, 5.0};
    const sl_csc A = {4, 4, column, row, values};
    const double b[3 * 2] = {1e-170, 0.0, 0.0, 0.0, 0.0, 1e170};
    double x[3 * 4], bounds[3 * 4];
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_factor_certify(F, &A, SL_GUARANTEED, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, S, bset, 2, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_plan_solve_bounded(P, F, x, 4, bounds, b, 2, 3, NULL, NULL, NULL));
    for (int k = 0; k < 3 * 4; k++) {
        assert_true(bounds[k] == (k / 4 == 1 || k % 4 > 1 ? 0.0 : HUGE_VAL));
    }
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Scales that another plan, or other numbers, have left are computed again. */
static void scales_know_what_they_are_of(void **state) {
    (void)state;
    static const sl_int rows[6] = {7, 30, 55, 99, 0, 7};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    double scales[4 * 3 + 2], x[3], bounds[3], fresh[3], b[3] = {1.0, 0.5, -2.0};
    memset(scales, 0, sizeof scales);
    for (int turn = 0; turn < 12; turn++) {
        const sl_int *bset = rows + turn % 3, *xset = rows + turn % 4;
        sl_plan *P = NULL;
        y.M.x[0] *= turn == 6 ? 1.5 : 1.0;
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
        SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
        SL_CHECK(sl_plan_create(&P, y.S, bset, 3, xset, 3, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(P, y.F, x, 3, bounds, b, 3, 1, scales, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(P, y.F, x, 3, fresh, b, 3, 1, NULL, NULL, NULL));
        assert_memory_equal(bounds, fresh, sizeof bounds);
        sl_plan_free(P);
    }
    factored_free(&y);
}

/* Weights are no part of L and D, but scales depend on them; a saved factor has them, too. */
static void scales_know_their_weights(void **state) {
    (void)state;
    static const sl_int bset[2] = {7, 55}, xset[3] = {30, 7, 0};
    static const double b[2] = {1.0, 0.5};
    sl_int components = 0;
    gen_matrix_t M = laplacian(GEN_GRID2, 100, 0, &components);
    double scales[4 * 3 + 2], x[3], bounds[3], fresh[3], before = 0.0;
    sl_symbolic *S = NULL;
    sl_plan *P = NULL;
    memset(scales, 0, sizeof scales);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, S, bset, 2, xset, 3, NULL, NULL));
    for (uint64_t turn = 0; turn < 3; turn++) {
        double *mass = weights(M.view.n_cols, turn);
        sl_options opt = options_none();
        sl_factor *F = NULL, *G = NULL;
        sl_symbolic *T = NULL;
        sl_plan *Q = NULL;
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = mass;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_certify(F, &M.view, SL_ESTIMATED, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(P, F, x, 3, bounds, b, 2, 1, scales, NULL, NULL));
        assert_true(bounds[0] > 0.0 && bounds[0] != before);
        before = bounds[0];
        saved_t m = saved_make(S, F);
        SL_CHECK(pair_load_memory(&T, &G, m.bytes, m.size, SL_LOAD_VERIFIED, NULL));
        SL_CHECK(sl_plan_create(&Q, T, bset, 2, xset, 3, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(Q, G, x, 3, fresh, b, 2, 1, NULL, NULL, NULL));
        assert_memory_equal(bounds, fresh, sizeof bounds);
        sl_plan_free(Q);
        sl_factor_free(F);
        sl_factor_free(G);
        sl_symbolic_free(T);
        saved_free(&m);
        free(mass);
    }
    sl_plan_free(P);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* M + t L on a grid, t = 10 edge lengths squared, x within 4 edges of the source: the median of
 * bound / error. */
static void bounds_are_sharp_near_the_source(void **state) {
    (void)state;
    gen_list_t t = gen_list(N);
    uint64_t seed = 5;
    for (sl_int k = 0; k < N; k++) {
        gen_add(&t, k, k, 0.1);
        for (int side = 0; side < 2; side++) {
            const sl_int to = side ? k + SIDE : k + 1;
            const double w = 1.5 + gen_real(&seed);
            if (side ? to < N : to % SIDE != 0) {
                gen_add(&t, to, k, -w);
                gen_add(&t, k, k, w);
                gen_add(&t, to, to, w);
            }
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_int *all = test_ints(N);
    double *ratios = test_reals(81 * 20), *b = test_reals(N);
    twice_t *x = (twice_t *)test_array(N, sizeof *x);
    size_t count = 0;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_certify(F, &M.view, SL_ESTIMATED, NULL, NULL));
    gen_set(all, 20, N, 9);
    for (int m = 0; m < 20; m++) {
        sl_int near[81], nx = 0;
        double X[81], bounds[81], one = 1.0;
        sl_plan *P = NULL;
        for (sl_int i = 0; i < N; i++) {
            if (abs(i % SIDE - all[m] % SIDE) <= 4 && abs(i / SIDE - all[m] / SIDE) <= 4) {
                near[nx++] = i;
            }
        }
        SL_CHECK(sl_plan_create(&P, S, &all[m], 1, near, nx, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(P, F, X, 81, bounds, &one, 1, 1, NULL, NULL, NULL));
        memset(b, 0, N * sizeof *b);
        b[all[m]] = 1.0;
        exact_solve(F, &M.view, b, NULL, x);
        for (sl_int k = 0; k < nx; k++) {
            const double error = fabs((x[near[k]].high - X[k]) + x[near[k]].low);
            assert_true(error <= bounds[k]);
            ratios[count++] = bounds[k] / (error + 1e-300);
        }
        sl_plan_free(P);
    }
    qsort(ratios, count, sizeof *ratios, compare_doubles);
    print_message("median of bound / error near the source: %.0f\n", ratios[count / 2]);
    assert_true(ratios[count / 2] < 1000.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    free(all);
    free(ratios);
    free(b);
    free(x);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_scale_with_the_rows),
        cmocka_unit_test(unknown_norms_give_infinite_bounds),
        cmocka_unit_test(scales_know_what_they_are_of),
        cmocka_unit_test(scales_know_their_weights),
        cmocka_unit_test(bounds_are_sharp_near_the_source),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
