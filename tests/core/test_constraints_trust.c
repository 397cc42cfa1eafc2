/* test_constraints_trust.c: pins say what they cannot answer: lost digits, unknown null vectors,
 * forces out of balance; weights count where no pin holds */
#include "tests/lib/zero_mean.h"
#include "tests/lib/constraint_calls.h"

enum { N = 480, HALF = 240 };

/* Two paths of springs of 1 side by side, one after the other with a spring of `bridge` between
 * them. `own` is added to the first row, `other` to row HALF; the springs of the second path are
 * multiplied by scale. */
static gen_matrix_t bridged_paths(double own, double other, double scale, double bridge) {
    gen_list_t t = gen_list(N);
    if (bridge != 0.0) {
        gen_add(&t, HALF - 1, HALF - 1, bridge);
        gen_add(&t, HALF, HALF, bridge);
        gen_add(&t, HALF, HALF - 1, -bridge);
    }
    for (sl_int k = 0; k < N; k++) {
        const double w = k < HALF ? 1.0 : scale;
        const int has_left = k % HALF > 0, has_right = k % HALF < HALF - 1;
        gen_add(&t, k, k, w * (has_left + has_right) + (k == 0 ? own : k == HALF ? other : 0.0));
        if (has_left) {
            gen_add(&t, k, k - 1, -w);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

static gen_matrix_t two_paths(double own, double other, double scale) {
    return bridged_paths(own, other, scale, 0.0);
}

typedef struct paths_t {
    gen_matrix_t M;
    sl_symbolic *S;
    sl_factor *F;
    sl_constraints *P;
} paths_t;

static paths_t paths_make(gen_matrix_t M, const sl_options *opt) {
    paths_t y = {M, NULL, NULL, NULL};
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, opt, NULL));
    SL_CHECK(sl_constraints_create(&y.P, y.F, NULL));
    return y;
}

static void paths_free(paths_t *y) {
    sl_constraints_free(y->P);
    sl_factor_free(y->F);
    sl_symbolic_free(y->S);
    gen_matrix_free(&y->M);
}

/* A path that nearly floats: without pins x is 1e12 times as large as with them. The other path has
 * the larger x, beside which C' x = g holds well. */
static void lost_digits_are_reported_in_each_component(void **state) {
    (void)state;
    double b[N], x[N], g = 0.0;
    for (int k = 0; k < N; k++) {
        b[k] = 1.0;
    }
    for (int firm = 0; firm < 2; firm++) {
        paths_t y = paths_make(two_paths(firm ? 1e-4 : 1e-13, 1e-20, 1e-20), NULL);
        SL_CHECK(pin_row(y.P, 5, NULL));
        SL_EXPECT(firm ? SL_OK : SL_ERR_INACCURATE,
                  sl_constraints_solve(y.P, NULL, x, N, b, N, &g, 1, 1, NULL));
        paths_free(&y);
    }
}

/* A pinned row in an equality: where both miss by nearly 1e-8, x = g in the row would move the
 * equality beyond. */
static void equalities_hold_with_what_pins_are_set_to(void **state) {
    (void)state;
    static const sl_int rows[2] = {5, 100};
    static const double weights[2] = {1.0, -3.0}, g[2] = {0.3, 0.01};
    double b[N] = {0.0}, x[N];
    int solved = 0, refused = 0;
    b[50] = 1e-3;
    for (int k = 0; k < 200; k++) {
        paths_t y = paths_make(two_paths(1e-13 * pow(1.05, k), 1.0, 1.0), NULL);
        SL_CHECK(pin_row(y.P, rows[0], NULL));
        SL_CHECK(sl_constraints_add(y.P, rows, weights, 2, NULL));
        const sl_status status = sl_constraints_solve(y.P, NULL, x, N, b, N, g, 2, 1, NULL);
        if (status == SL_OK) {
            double largest = 0.0;
            for (int j = 0; j < HALF; j++) {
                largest = fmax(largest, fabs(x[j]));
            }
            assert_true(x[rows[0]] == g[0]);
            assert_true(fabs(x[5] - 3.0 * x[100] - g[1]) <= 1e-8 * (4.0 * largest + g[1]));
            solved++;
        } else {
            assert_int_equal(status, SL_ERR_INACCURATE);
            refused++;
        }
        paths_free(&y);
    }
    print_message("%d solved, %d refused\n", solved, refused);
    assert_true(solved > 20 && refused > 20);
}

/* The same where b is in the other path only, and one of two pins moves this one: a local solve
 * does not visit its columns on the way forward. What rounding leaves of the pins is luck. */
static void forces_of_pins_alone_are_judged(void **state) {
    (void)state;
    enum { CASES = 12 };
    static const sl_int bset[1] = {HALF + 3};
    static const double b = 1.0, g[2] = {0.0, 1.0};
    int refused[2] = {0, 0};
    for (int k = 0; k < CASES; k++) {
        const int firm = k % 2;
        const sl_int pins[2] = {5 + 6 * (k / 2), 200 - 5 * (k / 2)};
        paths_t y = paths_make(two_paths(firm ? 1.0 : 1e-12, 1.0, 1.0), NULL);
        double whole[N], all[N] = {0.0}, x[2] = {7.0, 7.0};
        sl_plan *plan = NULL;
        SL_CHECK(sl_plan_create(&plan, y.S, bset, 1, pins, 2, NULL, NULL));
        SL_CHECK(sl_constraints_add(y.P, pins, NULL, 2, NULL));
        all[bset[0]] = b;
        const sl_status status = sl_constraints_solve(y.P, plan, x, 2, &b, 1, g, 2, 1, NULL);
        SL_EXPECT(status, sl_constraints_solve(y.P, NULL, whole, N, all, N, g, 2, 1, NULL));
        assert_true(status == SL_OK || status == SL_ERR_INACCURATE);
        for (int p = 0; p < 2; p++) {
            assert_true(status == SL_OK ? fabs(x[p] - g[p]) <= 1e-7 : x[p] == 7.0);
        }
        refused[firm] += status != SL_OK;
        sl_plan_free(plan);
        paths_free(&y);
    }
    assert_true(refused[0] > 0 && refused[1] == 0);
}

/* A full and a local solve with right-hand side b give the same status, and x. */
static void expect_solves(const paths_t *y, sl_status status, double *x, const double *b,
                          const double *g) {
    sl_int rows[N];
    double local[N];
    sl_plan *P = NULL;
    for (sl_int k = 0; k < N; k++) {
        rows[k] = k;
    }
    SL_EXPECT(status, sl_constraints_solve(y->P, NULL, x, N, b, N, g, N, 1, NULL));
    SL_CHECK(sl_plan_create(&P, y->S, rows, N, rows + HALF - 10, 20, NULL, NULL));
    SL_EXPECT(status, sl_constraints_solve(y->P, P, local, 20, b, N, g, N, 1, NULL));
    for (int k = 0; k < 20 && status == SL_OK; k++) {
        assert_true(fabs(local[k] - x[HALF - 10 + k]) <= 1e-11);
    }
    sl_plan_free(P);
}

/* The null vector of the first path is known, that of the second, whose springs push, is not: an
 * equality over both is refused. Without pins there, b has to be in balance all the same. */
static void a_second_tree_may_have_an_unknown_null_vector(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    gen_matrix_t M = two_paths(0.0, 0.0, 1.0);
    for (sl_int k = HALF + 1; k < N; k++) {
        for (sl_int p = M.p[k - 1]; p < M.p[k]; p++) {
            M.x[p] = M.i[p] == k ? -M.x[p] : M.x[p];
        }
    }
    for (int swapped = 0; swapped < 2; swapped++) {
        const sl_int rows[2] = {swapped ? HALF + 3 : 3, swapped ? 3 : HALF + 3};
        const double values[2] = {1.0, 1.0};
        paths_t y = paths_make(M, &opt);
        sl_stats stats;
        SL_EXPECT(SL_ERR_UNSUPPORTED, sl_constraints_add(y.P, rows, values, 2, &stats));
        assert_int_equal(stats.error.row, HALF + 3);
        assert_int_equal(pins_count(y.P), 0);
        SL_CHECK(pin_row(y.P, 3, NULL));
        double b[N] = {0.0}, x[N], g[1] = {0.0};
        b[HALF + 3] = 1.0;
        expect_solves(&y, SL_ERR_INCONSISTENT, x, b, g);
        b[HALF + 4] = 1.0; /* the null vector has both signs in turn */
        expect_solves(&y, SL_OK, x, b, g);
        y.M = two_paths(0.0, 0.0, 1.0);
        paths_free(&y);
    }
    gen_matrix_free(&M);
}

/* The second path has no pin: there b has to be in balance, unless weights make it so, and then x
 * has zero mean. One pin, or several. */
static void components_without_pins_are_as_without_a_set(void **state) {
    (void)state;
    double m[N], g[N] = {0.0};
    for (int k = 0; k < N; k++) {
        m[k] = 1.0 + k % 3;
    }
    for (int kind = 0; kind < 6; kind++) {
        const int is_many = kind % 2, way = kind / 2; /* way 0: checked, 1: not, 2: with weights */
        double b[N], x[N];
        sl_options opt = options_none();
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = way == 2 ? m : NULL;
        opt.consistency_tolerance = way == 1 ? -1.0 : 0.0;
        paths_t y = paths_make(two_paths(0.0, 0.0, 1.0), &opt);
        sl_int rows[HALF / 3];
        for (sl_int k = 0; k < HALF / 3; k++) {
            rows[k] = 3 * k;
        }
        SL_CHECK(sl_constraints_add(y.P, rows, NULL, is_many ? HALF / 3 : 1, NULL));
        gen_reals(b, N, 3);
        b[HALF] += 1.0;
        expect_solves(&y, way == 0 ? SL_ERR_INCONSISTENT : SL_OK, x, b, g);
        if (way == 2) { /* the second path by itself */
            double sums[3] = {0.0, 0.0, 0.0}, largest = 0.0;
            for (int k = HALF; k < N; k++) {
                sums[0] += b[k];
                sums[1] += m[k];
                sums[2] += m[k] * x[k];
                largest = fmax(largest, fabs(x[k]));
            }
            assert_true(fabs(sums[2]) <= 1e-13 * sums[1] * largest);
            for (int k = HALF; k < N; k++) {
                b[k] -= sums[0] / sums[1] * m[k];
            }
            double r[N];
            SL_CHECK(sl_csc_residual(&y.M.view, r, N, NULL, x, N, b, N, 1));
            for (int k = HALF; k < N; k++) {
                assert_true(fabs(r[k]) <= 1e-12);
            }
        }
        assert_true(way == 0 || fabs(x[0]) <= 1e-13);
        double sum = 0.0;
        for (int k = HALF; k < N; k++) {
            sum += b[k];
        }
        b[HALF] -= sum;
        expect_solves(&y, SL_OK, x, b, g);
        paths_free(&y);
    }
}

/* A difference leaves the constant of its path: b has to be in balance, with weights or not. */
static void motions_that_pins_leave_need_balance(void **state) {
    (void)state;
    const sl_int rows[2] = {3, HALF - 2};
    const double values[2] = {1.0, -1.0};
    double m[N], g[N] = {2.0};
    for (int k = 0; k < N; k++) {
        m[k] = 1.0 + k % 3;
    }
    for (int weighted = 0; weighted < 2; weighted++) {
        double b[N] = {0.0}, x[N], r[N];
        sl_options opt = options_none();
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = weighted ? m : NULL;
        paths_t y = paths_make(two_paths(0.0, 0.0, 1.0), &opt);
        SL_CHECK(sl_constraints_add(y.P, rows, values, 2, NULL));
        b[10] = 1.0;
        expect_solves(&y, SL_ERR_INCONSISTENT, x, b, g);
        b[20] = -1.0;
        expect_solves(&y, SL_OK, x, b, g);
        assert_true(fabs(x[rows[0]] - x[rows[1]] - 2.0) <= 1e-13);
        SL_CHECK(sl_csc_residual(&y.M.view, r, N, NULL, x, N, b, N, 1));
        for (int k = 0; k < N; k++) {
            assert_true(k == rows[0] || k == rows[1] || fabs(r[k]) <= 1e-13);
        }
        b[20] = 0.0; /* one pin more, and nothing is left */
        SL_CHECK(pin_row(y.P, 0, NULL));
        expect_solves(&y, SL_OK, x, b, g);
        paths_free(&y);
    }
}

/* All rows on one side of a weak bridge are pinned. The pins of the side that the null pivot is not
 * in lose their digits, and are refused. */
static void a_weak_bridge_holds_what_pins_leave(void **state) {
    (void)state;
    const double bridge = ldexp(1.0, -46);
    double g[N] = {0.0}, x[N], m[N];
    int solved = 0;
    for (int k = 0; k < N; k++) {
        m[k] = 1.0;
    }
    for (int kind = 0; kind < 4; kind++) {
        const int first = kind / 2 * HALF, rest = HALF - first; /* pinned: first, first + 1, ... */
        double b[N] = {0.0};
        sl_int rows[HALF];
        sl_options opt = options_none();
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = kind % 2 ? m : NULL;
        paths_t y = paths_make(bridged_paths(0.0, 0.0, 1.0, bridge), &opt);
        for (sl_int k = 0; k < HALF; k++) {
            rows[k] = first + k;
        }
        b[rest + 7] = 1.0;
        const sl_status status = sl_constraints_add(y.P, rows, NULL, HALF, NULL);
        assert_true(status == SL_OK || status == SL_ERR_PIVOT);
        if (status == SL_OK) {
            SL_CHECK(sl_constraints_solve(y.P, NULL, x, N, b, N, g, N, 1, NULL));
            solved++;
        }
        for (int k = rest; k < rest + HALF && status == SL_OK; k++) {
            assert_true(fabs(bridge * x[k] - 1.0) <= 1e-3);
        }
        paths_free(&y);
    }
    assert_int_equal(solved, 2);
}

/* Each allocation of an equality over two singular trees, and of a solve with it, fails once. */
static void failing_allocations_change_nothing(void **state) {
    (void)state;
    const sl_int rows[2] = {3, HALF + 3};
    const double values[2] = {1.0, 2.0}, g = 3.0;
    double b[N] = {0.0}, x[N];
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    paths_t y = paths_make(two_paths(0.0, 0.0, 1.0), &opt);
    counter_t counter = counter_make();
    sl_options counted = options_counted(&counter);
    sl_constraints *P = NULL;
    SL_CHECK(sl_constraints_create(&P, y.F, &counted));
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status == SL_ERR_MEMORY; k++) {
        counter.fail_at = (int64_t)counter.calls + k;
        status = sl_constraints_add(P, rows, values, 2, NULL);
        assert_int_equal(pins_count(P), status == SL_OK);
    }
    SL_CHECK(status);
    status = SL_ERR_MEMORY;
    for (int64_t k = 0; status == SL_ERR_MEMORY; k++) {
        counter.fail_at = (int64_t)counter.calls + k;
        status = sl_constraints_solve(P, NULL, x, N, b, N, &g, 1, 1, NULL);
    }
    SL_CHECK(status);
    assert_true(fabs(x[3] + 2.0 * x[HALF + 3] - g) <= 1e-13);
    sl_constraints_free(P);
    assert_int_equal(counter.live_blocks, 0);
    assert_int_equal(counter.damaged, 0);
    paths_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lost_digits_are_reported_in_each_component),
        cmocka_unit_test(equalities_hold_with_what_pins_are_set_to),
        cmocka_unit_test(forces_of_pins_alone_are_judged),
        cmocka_unit_test(a_second_tree_may_have_an_unknown_null_vector),
        cmocka_unit_test(components_without_pins_are_as_without_a_set),
        cmocka_unit_test(motions_that_pins_leave_need_balance),
        cmocka_unit_test(a_weak_bridge_holds_what_pins_leave),
        cmocka_unit_test(failing_allocations_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
