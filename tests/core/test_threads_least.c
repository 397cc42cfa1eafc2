/* test_threads_least.c: how much work several threads share: small solves are left to one */
#define _POSIX_C_SOURCE 200112L /* nanosleep */
#include "tests/lib/threads.h"

/* How often full solves and a batch of local ones call for threads. */
typedef struct shared_calls {
    int one, three, twenty, batch;
} shared_calls;

enum { PLANS = 40, RHS = 20 };

/* Solves with 4 threads on the grid of `rows` rows, and compares with solves by one. */
static shared_calls solve_on_grid(sl_int rows) {
    factored_t y = factored_make(GEN_GRID2, rows, 0, 0, NULL);
    const size_t n = (size_t)y.M.view.n_cols;
    double *B = test_reals(n * RHS), *X = test_reals(n * RHS), *Y = test_reals(n * RHS);
    int calls = 0;
    shared_calls shared = {0};
    sl_plan *plans[PLANS];
    sl_request requests[PLANS];
    sl_work *W = NULL;
    const sl_options opt = options_of_workers(4, &calls);
    gen_reals(B, n * RHS, 3);
    SL_CHECK(sl_work_create(&W, &opt));
    for (int k = 0; k < 3; k++) {
        static const sl_int counts[3] = {1, 3, RHS};
        int *const results[3] = {&shared.one, &shared.three, &shared.twenty};
        calls = 0;
        SL_CHECK(sl_factor_solve(y.F, X, n, B, n, counts[k], W));
        *results[k] = calls;
        SL_CHECK(sl_factor_solve(y.F, Y, n, B, n, counts[k], NULL));
        assert_memory_equal(X, Y, n * (size_t)counts[k] * sizeof *X);
    }
    for (int k = 0; k < PLANS; k++) {
        const sl_int row = k * (y.M.view.n_cols / PLANS);
        SL_CHECK(sl_plan_create(&plans[k], y.S, &row, 1, &row, 1, NULL, NULL));
        memset(&requests[k], 0, sizeof requests[k]);
        requests[k].plan = plans[k];
        requests[k].X = X + k;
        requests[k].B = B + k;
        requests[k].ldx = requests[k].ldb = 1;
        requests[k].nrhs = 1;
    }
    calls = 0;
    SL_CHECK(sl_batch_solve(y.F, requests, PLANS, &opt, NULL, NULL));
    shared.batch = calls;
    for (int k = 0; k < PLANS; k++) {
        SL_CHECK(sl_plan_solve(plans[k], y.F, Y + k, 1, B + k, 1, 1, NULL));
        sl_plan_free(plans[k]);
    }
    assert_memory_equal(X, Y, PLANS * sizeof *X);
    sl_work_free(W);
    free(B);
    free(X);
    free(Y);
    factored_free(&y);
    return shared;
}

static void small_solves_are_left_to_one_thread(void **state) {
    (void)state;
    const shared_calls shared = solve_on_grid(900);
#if defined(SL_VERIFY) /* where they are shared, too */
    (void)shared;
#else
    assert_int_equal(shared.one, 0);
    assert_int_equal(shared.three, 0);
    assert_int_equal(shared.twenty, 0);
    assert_int_equal(shared.batch, 0);
#endif
}

static void large_solves_are_shared(void **state) {
    (void)state;
    const shared_calls shared = solve_on_grid(60000);
    assert_int_equal(shared.one, 1);
    assert_int_equal(shared.three, 1);
    assert_int_equal(shared.twenty, 1);
    assert_int_equal(shared.batch, 1);
}

/* What subtrees pass up may cost more than what is saved: leaves of many rows. */
static void leaves_that_pass_up_much_are_left_to_one_thread(void **state) {
    (void)state;
    enum { LEAVES = 12600, TOP = 64, ROWS = LEAVES + TOP, MOST = 8 };
    gen_list_t t = gen_list(ROWS);
    sl_options opt = options_none();
    factored_t y = {{0}, NULL, NULL};
    int calls = 0;
    const sl_options many = options_of_workers(2, &calls);
    sl_work *W = NULL;
    double *B = test_reals(ROWS * MOST), *X = test_reals(ROWS * MOST), *Y = test_reals(ROWS * MOST);
    for (sl_int k = 0; k < ROWS; k++) {
        gen_add(&t, k, k, k < LEAVES ? 100.0 : 1e5);
        for (sl_int i = LEAVES; i < ROWS && k < LEAVES; i++) {
            gen_add(&t, i, k, -1.0);
        }
    }
    y.M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    opt.ordering = SL_ORDERING_NATURAL;
    opt.relaxation = SL_RELAXATION_NONE;
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, NULL, NULL));
    SL_CHECK(sl_work_create(&W, &many));
    gen_reals(B, ROWS * MOST, 3);
    for (sl_int nrhs = 1; nrhs <= MOST; nrhs++) {
        SL_CHECK(sl_factor_solve(y.F, X, ROWS, B, ROWS, nrhs, W));
        SL_CHECK(sl_factor_solve(y.F, Y, ROWS, B, ROWS, nrhs, NULL));
        assert_memory_equal(X, Y, (size_t)(ROWS * nrhs) * sizeof *X);
    }
#if !defined(SL_VERIFY)
    assert_int_equal(calls, 0);
#endif
    sl_work_free(W);
    free(B);
    free(X);
    free(Y);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_solves_are_left_to_one_thread),
        cmocka_unit_test(large_solves_are_shared),
        cmocka_unit_test(leaves_that_pass_up_much_are_left_to_one_thread),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
