/* test_constraints_nulls.c: pins over singular matrices: null vectors that they know, and others */
#include "tests/lib/factored.h"
#include "tests/lib/constraint_calls.h"

enum { N = 40 };

/* A path whose edges have the sign given, with a second component from row `cut` on if cut > 0, and
 * `shift` added to the diagonal of that component. With edges of sign 1 the null vector
 * alternates. */
static factored_t path(double sign, sl_int cut, double shift) {
    factored_t y = {{0}, NULL, NULL};
    sl_options opt = options_none();
    gen_list_t t = gen_list(N);
    double diagonal[N] = {0.0};
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    for (sl_int k = 0; k + 1 < N; k++) {
        if (k + 1 != cut) {
            gen_add(&t, k + 1, k, sign);
            diagonal[k] += 1.0;
            diagonal[k + 1] += 1.0;
        }
    }
    for (sl_int k = 0; k < N; k++) {
        gen_add(&t, k, k, fabs(sign) * diagonal[k] + (cut > 0 && k >= cut ? shift : 0.0));
    }
    y.M = gen_store(&t, gen_style(0), 1);
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
    gen_list_free(&t);
    return y;
}

static sl_int null_count(const sl_factor *F) {
    sl_int count = 0;
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, NULL, NULL, 0, &count));
    return count;
}

/* Pins know constants as null vectors: a component with another one is refused, a regular
 * component beside a singular one is not. */
static void null_vectors_must_be_known(void **state) {
    (void)state;
    factored_t y = path(1.0, 0, 0.0);
    sl_constraints *P;
    sl_stats stats;
    assert_int_equal(null_count(y.F), 1);
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, pin_row(P, 3, &stats));
    assert_int_equal(stats.error.row, 3);
    assert_int_equal(pins_count(P), 0);
    sl_constraints_free(P);
    factored_free(&y);

    y = path(1.0, 20, 0.0); /* two such components */
    assert_int_equal(null_count(y.F), 2);
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, pin_row(P, 3, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, pin_row(P, 33, NULL));
    sl_constraints_free(P);
    factored_free(&y);

    double z[2 * N], b[N] = {0.0}, x[N];
    const double g[2] = {2.0, -1.0};
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.null_vector = z;
    opt.null_vector_count = 2; /* one of them holds */
    for (sl_int k = 0; k < N; k++) {
        z[k] = 1.0;
        z[N + k] = k;
    }
    y = path(1.0, 0, 0.0); /* none holds */
    sl_factor_free(y.F);
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, pin_row(P, 3, NULL));
    sl_constraints_free(P);
    factored_free(&y);
    y = path(-1.0, 0, 0.0);
    sl_factor_free(y.F);
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(pin_row(P, 3, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, N, b, N, g, 2, 1, NULL));
    for (sl_int k = 0; k < N; k++) {
        assert_true(fabs(x[k] - g[0]) <= 1e-12);
    }
    sl_constraints_free(P);
    factored_free(&y);

    y = path(-1.0, 20, 0.5);
    assert_int_equal(null_count(y.F), 1);
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(pin_row(P, 30, NULL));
    SL_CHECK(pin_row(P, 3, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, N, b, N, g, 2, 1, NULL));
    assert_true(fabs(x[30] - g[0]) <= 1e-13);
    for (sl_int k = 0; k < 20; k++) { /* a constant */
        assert_true(fabs(x[k] - g[1]) <= 1e-12);
    }
    double *A = ref_dense(&y.M.view);
    for (sl_int i = 0; i < N; i++) { /* A x = 0 in all other rows */
        double r = 0.0;
        for (sl_int j = 0; j < N; j++) {
            r += A[i + N * j] * x[j];
        }
        assert_true(i == 30 || i == 3 || fabs(r) <= 1e-12);
    }
    free(A);
    sl_constraints_free(P);
    factored_free(&y);
}

/* The difference of two rows does not see a constant: x is 0 in the null row. */
static void a_difference_leaves_the_constant_free(void **state) {
    (void)state;
    factored_t y = path(-1.0, 0, 0.0);
    const sl_int rows[2] = {3, 33};
    const double values[2] = {1.0, -1.0}, g = 6.0;
    double b[N] = {0.0}, x[N];
    sl_int null, count;
    sl_constraints *P;
    SL_CHECK(sl_factor_pivot_rows(y.F, SL_PIVOT_NULL, &null, NULL, 1, &count));
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(sl_constraints_add(P, rows, values, 2, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, N, b, N, &g, 1, 1, NULL));
    assert_true(x[null] == 0.0);
    for (sl_int k = 0; k + 1 < N; k++) { /* linear between the two rows, constant outside */
        const double step = k >= 3 && k < 33 ? g / 30.0 : 0.0;
        assert_true(fabs(x[k] - x[k + 1] - step) <= 1e-12);
    }
    sl_constraints_free(P);
    factored_free(&y);
}

/* New values with another null vector: the pins are refused until the values are good again. They
 * can be released in between. */
static void a_refactorization_may_lose_the_null_vector(void **state) {
    (void)state;
    factored_t y = path(-1.0, 0, 0.0), bad = path(1.0, 0, 0.0);
    double b[N] = {0.0}, x[N], g = 4.0;
    sl_constraints *P;
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(pin_row(P, 8, NULL));
    SL_CHECK(pin_row(P, 3, NULL));
    SL_CHECK(sl_factor_refactor(y.F, &bad.M.view, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_constraints_refactor(P, NULL));
    SL_CHECK(unpin(P, 0));
    assert_int_equal(pins_count(P), 1);
    SL_EXPECT(SL_ERR_STALE, sl_constraints_solve(P, NULL, x, N, b, N, &g, 1, 1, NULL));
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_CHECK(sl_constraints_refactor(P, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, N, b, N, &g, 1, 1, NULL));
    for (sl_int k = 0; k < N; k++) {
        assert_true(fabs(x[k] - g) <= 1e-12);
    }
    sl_constraints_free(P);
    factored_free(&bad);
    factored_free(&y);
}

/* Each allocation of a set over a singular matrix fails once, and of an equality. */
static void failing_allocations_leave_the_set(void **state) {
    (void)state;
    factored_t y = path(-1.0, 0, 0.0);
    const sl_int rows[2] = {3, 20};
    const double values[2] = {0.75, 0.25};
    double b[N] = {0.0}, x[N], g = 4.0;
    for (int step = 0; step < 2; step++) {
        sl_status status = SL_ERR_MEMORY;
        for (int k = 0; status != SL_OK; k++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            sl_constraints *P = (sl_constraints *)(void *)&y;
            counter.fail_at = step == 0 ? k : -1;
            status = sl_constraints_create(&P, y.F, &opt);
            assert_true((P != NULL) == (status == SL_OK));
            if (step == 1) {
                counter.fail_at = (int64_t)counter.calls + k;
                status = sl_constraints_add(P, rows, values, 2, NULL);
                assert_int_equal(pins_count(P), status == SL_OK);
            }
            assert_true(status == SL_ERR_MEMORY || (status == SL_OK && k > step));
            counter.fail_at = -1;
            if (step == 1 && status == SL_OK) {
                SL_CHECK(sl_constraints_solve(P, NULL, x, N, b, N, &g, 1, 1, NULL));
                assert_true(fabs(x[0] - g) <= 1e-12);
            }
            sl_constraints_free(P);
            COUNTER_CLEAN(&counter);
        }
    }
    factored_free(&y);
}

/* Rows of zeros, one by itself and one among the entries of a path, and what is pinned there. Two
 * paths that only a zero joins have two null vectors, of which one is known. */
static void rows_of_zeros_can_be_pinned(void **state) {
    (void)state;
    for (int way = 0; way < 3; way++) {
        factored_t y = {{0}, NULL, NULL};
        sl_options opt = options_none();
        gen_list_t t = gen_list(N);
        double b[N] = {0.0}, x[N];
        const double g[2] = {2.0, -7.0};
        sl_constraints *P;
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        for (sl_int k = 0; k + 2 < N; k++) { /* row N - 1 is 0 */
            const double weight = way == 2 && k == 19 ? 0.0 : 1.0;
            gen_add(&t, k + 1, k, -weight);
            gen_add(&t, k, k, weight);
            gen_add(&t, k + 1, k + 1, weight);
        }
        gen_add(&t, N - 1, N - 1, 0.0);
        if (way == 1) {
            gen_add(&t, N - 1, 7, 0.0);
        }
        y.M = gen_store(&t, gen_style(0), 1);
        SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
        assert_int_equal(null_count(y.F), way == 2 ? 3 : 2);
        SL_CHECK(sl_constraints_create(&P, y.F, NULL));
        if (way == 2) {
            SL_EXPECT(SL_ERR_UNSUPPORTED, pin_row(P, 30, NULL));
            SL_CHECK(pin_row(P, N - 1, NULL));
            sl_constraints_free(P);
            gen_list_free(&t);
            factored_free(&y);
            continue;
        }
        SL_CHECK(pin_row(P, 30, NULL));
        SL_CHECK(pin_row(P, N - 1, NULL));
        SL_CHECK(sl_constraints_solve(P, NULL, x, N, b, N, g, 2, 1, NULL));
        for (sl_int k = 0; k < N; k++) {
            assert_true(fabs(x[k] - (k == N - 1 ? g[1] : g[0])) <= 1e-12);
        }
        sl_constraints_free(P);
        gen_list_free(&t);
        factored_free(&y);
    }
}

/* An equality that sees the constant so little that its square underflows. */
static void an_underflow_is_refused(void **state) {
    (void)state;
    factored_t y = path(-1e-6, 0, 0.0);
    const sl_int *perm = sl_symbolic_view(y.S).perm;
    const sl_int rows[3] = {perm[0], perm[N / 2], perm[N - 1]}; /* summed in the order of L */
    const double values[3] = {1.0, -1.0, 1e-160};
    double b[N] = {0.0}, x[N] = {0.0}, g = 1.0;
    sl_constraints *P;
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(sl_constraints_add(P, rows, values, 3, NULL));
    SL_EXPECT(SL_ERR_INACCURATE, sl_constraints_solve(P, NULL, x, N, b, N, &g, 1, 1, NULL));
    assert_true(x[0] == 0.0);
    sl_constraints_free(P);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(null_vectors_must_be_known),
        cmocka_unit_test(a_difference_leaves_the_constant_free),
        cmocka_unit_test(a_refactorization_may_lose_the_null_vector),
        cmocka_unit_test(failing_allocations_leave_the_set),
        cmocka_unit_test(rows_of_zeros_can_be_pinned),
        cmocka_unit_test(an_underflow_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
