/* test_batch.c: sl_batch_solve: the bits of single solves, threads, several factors, errors */
#include "tests/lib/factor_array.h"
#include "tests/lib/factored.h"

enum { REQUESTS = 9 };

/* Requests of every kind for one factor, and the results of single solves. */
typedef struct batch_t {
    factored_t y;
    sl_plan *plan[REQUESTS]; /* NULL for the last: a full solve */
    sl_request request[REQUESTS];
    double *X[REQUESTS], *B[REQUESTS], *expected[REQUESTS];
    size_t size[REQUESTS]; /* doubles in X */
} batch_t;

/* The result of request k by a single call. */
static void solve_single(batch_t *t, int k) {
    const sl_request *r = &t->request[k];
    if (!r->plan) {
        SL_CHECK(sl_factor_solve(t->y.F, t->expected[k], r->ldx, r->B, r->ldb, r->nrhs, NULL));
    } else {
        SL_CHECK(
            sl_plan_solve(r->plan, t->y.F, t->expected[k], r->ldx, r->B, r->ldb, r->nrhs, NULL));
    }
}

/* layouts: 0 all by columns, 1 all by rows, 2 X and B by turns in one or the other. */
static batch_t batch_make(gen_kind_t kind, sl_int size, sl_isa isa, int layouts) {
    static const sl_int columns[REQUESTS] = {1, 3, 8, 0, 40, 17, 2, 9, 21};
    sl_options opt = options_none();
    batch_t t;
    uint64_t seed = 5;
    memset(&t, 0, sizeof t);
    opt.isa = isa;
    t.y = factored_make(kind, size, 0, 0, &opt);
    sl_int n = t.y.M.view.n_cols;
    for (int k = 0; k < REQUESTS; k++) {
        int is_full = k == REQUESTS - 1;
        sl_int nb = is_full ? n : gen_below(&seed, n + 1),
               nx = is_full ? n : gen_below(&seed, n + 1);
        sl_int *bset = test_ints((size_t)n), *xset = test_ints((size_t)n);
        gen_set(bset, nb, n, gen_bits(&seed));
        gen_set(xset, nx, n, gen_bits(&seed));
        if (!is_full) {
            SL_CHECK(sl_plan_create(&t.plan[k], t.y.S, bset, nb, xset, nx, NULL, NULL));
        }
        sl_request *r = &t.request[k];
        r->plan = t.plan[k];
        r->nrhs = columns[k];
        const size_t across = (size_t)columns[k];
        const int b_by_rows = layouts == 2 ? k / 2 % 2 : layouts;
        const int x_by_rows = layouts == 2 ? k % 2 : layouts;
        const size_t ldb = b_by_rows ? across + 3 : (size_t)nb + 2;
        const size_t ldx = x_by_rows ? across + 1 : (size_t)nx + 1;
        r->ldb = b_by_rows ? SL_ROWS(ldb) : ldb;
        r->ldx = x_by_rows ? SL_ROWS(ldx) : ldx;
        t.size[k] = ldx * (x_by_rows ? (size_t)nx : across);
        t.X[k] = r->X = test_reals(t.size[k]);
        const size_t size_b = ldb * (b_by_rows ? (size_t)nb : across);
        t.B[k] = test_reals(size_b);
        t.expected[k] = test_reals(t.size[k]);
        gen_reals(t.B[k], size_b, gen_bits(&seed));
        r->B = t.B[k];
        solve_single(&t, k);
        free(bset);
        free(xset);
    }
    return t;
}

static void batch_free(batch_t *t) {
    for (int k = 0; k < REQUESTS; k++) {
        sl_plan_free(t->plan[k]);
        free(t->X[k]);
        free(t->B[k]);
        free(t->expected[k]);
    }
    factored_free(&t->y);
}

static void batch_check(batch_t *t) {
    for (int k = 0; k < REQUESTS; k++) {
        SAME_VALUES(t->X[k], t->expected[k], t->size[k]);
        memset(t->X[k], 0, t->size[k] * sizeof(double));
    }
}

static sl_status batch_solve(const batch_t *t, const sl_options *opt, sl_work *const *works,
                             sl_int *failed) {
    return sl_batch_solve(t->y.F, t->request, REQUESTS, opt, works, failed);
}

static void a_batch_gives_the_bits_of_single_solves(void **state) {
    (void)state;
    static const gen_kind_t kinds[4] = {GEN_GRID2, GEN_COMPONENTS, GEN_PATH, GEN_ONE};
    isa_list_t isas = isas_present();
    for (int kind = 0; kind < 12; kind++) {
        for (int isa = 0; isa < isas.count; isa++) {
            batch_t t = batch_make(kinds[kind / 3], 200, isas.isa[isa], kind % 3);
            sl_work *works[40];
            for (int k = 0; k < 40; k++) {
                SL_CHECK(sl_work_create(&works[k], NULL));
            }
            for (sl_int count = 0; count <= 40; count = count < 4 ? count + 1 : count * 3) {
                int calls = 0;
                sl_int failed = 7;
                sl_threads threads = {count, count % 2 ? run_threads : run_backwards, &calls};
                SL_CHECK(batch_solve(&t, THREADS(threads), NULL, &failed));
                assert_int_equal(failed, -1);
                assert_int_equal(calls, count > 1);
                batch_check(&t);
                SL_CHECK(batch_solve(&t, THREADS(threads), works, NULL));
                batch_check(&t);
                threads.run = NULL; /* those that are compiled in, if any are */
                if (count <= 1 || HAS_THREADS) {
                    SL_CHECK(batch_solve(&t, THREADS(threads), works, NULL));
                    batch_check(&t);
                } else {
                    SL_EXPECT(SL_ERR_UNSUPPORTED, batch_solve(&t, THREADS(threads), works, NULL));
                }
            }
            SL_CHECK(batch_solve(&t, NULL, NULL, NULL));
            batch_check(&t);
            SL_CHECK(sl_batch_solve(t.y.F, NULL, 0, NULL, NULL, NULL));
            for (int k = 0; k < 40; k++) {
                sl_work_free(works[k]);
            }
            batch_free(&t);
        }
    }
}

/* All workers solve right-hand sides: all their workspaces grow. */
static void all_workers_take_part(void **state) {
    (void)state;
    batch_t t = batch_make(GEN_GRID2, 400, SL_ISA_AUTO, 0);
    int calls = 0;
    sl_work *works[4];
    for (int k = 0; k < 4; k++) {
        SL_CHECK(sl_work_create(&works[k], NULL));
    }
    sl_threads threads = {4, run_threads, &calls};
    SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, THREADS(threads), works, NULL));
    assert_int_equal(calls, 1);
    batch_check(&t);
    size_t bytes = sl_work_bytes(works[0]);
    assert_true(bytes > 0);
    for (int k = 0; k < 4; k++) {
        assert_int_equal(sl_work_bytes(works[k]), bytes);
        sl_work_free(works[k]);
    }
    batch_free(&t);
}

static void invalid_requests_change_nothing(void **state) {
    (void)state;
    batch_t t = batch_make(GEN_GRID2, 100, SL_ISA_AUTO, 0),
            other = batch_make(GEN_PATH, 100, SL_ISA_AUTO, 0);
    sl_request keep = t.request[5]; /* column-major, 17 right-hand sides */
    sl_int failed = 7;
    int calls = 0;
    sl_threads threads = {2, run_backwards, &calls};
    sl_work *works[2] = {NULL, NULL};
    memset(t.X[0], 0, t.size[0] * sizeof(double));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(NULL, t.request, REQUESTS, NULL, NULL, &failed));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(t.y.F, NULL, 1, NULL, NULL, &failed));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(t.y.F, t.request, -1, NULL, NULL, &failed));
    assert_int_equal(failed, -1);
    for (int wrong = 0; wrong < 5; wrong++) {
        sl_request *r = &t.request[5];
        switch (wrong) {
        case 0:
            r->X = NULL;
            break;
        case 1:
            r->ldx -= 2;
            break;
        case 2:
            r->nrhs = -1;
            break;
        case 3:
            r->X = (double *)(uintptr_t)r->B;
            break; /* in place with different strides */
        case 4:
            r->plan = other.plan[0];
            r->ldx = r->ldb = 1000;
            r->nrhs = 1;
            break;
        }
        SL_EXPECT(wrong == 4 ? SL_ERR_MISMATCH : SL_ERR_ARGUMENT,
                  sl_batch_solve(t.y.F, t.request, REQUESTS, THREADS(threads), NULL, &failed));
        assert_int_equal(failed, 5);
        *r = keep;
    }
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_solve(t.y.F, t.request, REQUESTS, THREADS(threads), works, &failed));
    SL_CHECK(sl_work_create(&works[0], NULL));
    works[1] = works[0];
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_solve(t.y.F, t.request, REQUESTS, THREADS(threads), works, &failed));
    sl_work_free(works[0]);
    threads.count = INT32_MAX; /* more workers than blocks of right-hand sides */
    SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, THREADS(threads), NULL, NULL));
    memset(t.X[0], 0, t.size[0] * sizeof(double));
    calls = 0;
    threads.count = -1;
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_solve(t.y.F, t.request, REQUESTS, THREADS(threads), NULL, &failed));
    assert_int_equal(calls, 0);
    for (size_t k = 0; k < t.size[0]; k++) {
        assert_true(t.X[0][k] == 0.0);
    }
    batch_free(&t);
    batch_free(&other);
}

static void a_failed_allocation_is_reported(void **state) {
    (void)state;
    counter_t counter = counter_make();
    batch_t t = batch_make(GEN_GRID2, 100, SL_ISA_AUTO, 0);
    sl_options opt = options_counted(&counter);
    sl_factor *F = NULL;
    int calls = 0;
    sl_threads threads = {3, run_backwards, &calls};
    SL_CHECK(sl_factor_create(&F, t.y.S, &t.y.M.view, &opt, NULL));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_batch_solve(F, t.request, REQUESTS, THREADS(threads), NULL, NULL));
    counter.fail_at = -1;
    SL_CHECK(sl_batch_solve(F, t.request, REQUESTS, THREADS(threads), NULL, NULL));
    batch_check(&t);
    sl_factor_free(F);
    batch_free(&t);
    COUNTER_CLEAN(&counter);
}

/* Requests by several workers, of which some fail: the first one is named, the others are solved.
 * Nothing is if one is not consistent. */
static void failures_of_several_workers(void **state) {
    (void)state;
    enum { N = 100, COUNT = 4 };
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    factored_t z = factored_make(GEN_SINGULAR, N, 1, 0, &opt);
    double B[COUNT][N], X[COUNT][N], expected[COUNT][N];
    sl_request r[COUNT];
    memset(r, 0, sizeof r);
    for (int k = 0; k < COUNT; k++) {
        gen_reals(B[k], N, 1 + (uint64_t)k);
        SL_CHECK(sl_factor_solve(y.F, expected[k], N, B[k], N, 1, NULL));
        r[k].X = X[k];
        r[k].B = B[k];
        r[k].ldx = r[k].ldb = N;
        r[k].nrhs = 1;
    }
    for (int workers = 1; workers <= COUNT; workers++) {
        int calls = 0;
        sl_int failed = 7;
        const sl_threads threads = {workers, run_backwards, &calls};
        B[1][3] = B[3][7] = NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE,
                  sl_batch_solve(y.F, r, COUNT, THREADS(threads), NULL, &failed));
        assert_int_equal(failed, 1);
        assert_int_equal(calls, workers > 1);
        for (int k = 0; k < COUNT; k += 2) {
            assert_memory_equal(X[k], expected[k], sizeof X[k]);
        }
        gen_reals(B[1], N, 2);
        memset(B[3], 0, sizeof B[3]);
        memset(X, 0, sizeof X);
        B[3][5] = 1.0;
        r[3].factor = z.F;
        SL_EXPECT(SL_ERR_INCONSISTENT,
                  sl_batch_solve(y.F, r, COUNT, THREADS(threads), NULL, &failed));
        assert_int_equal(failed, 3);
        assert_true(X[0][0] == 0.0 && X[1][0] == 0.0 && X[2][0] == 0.0);
        B[3][6] = -1.0;
        SL_CHECK(sl_batch_solve(y.F, r, COUNT, THREADS(threads), NULL, &failed));
        assert_memory_equal(X, expected, 3 * sizeof X[0]);
        r[3].factor = NULL;
    }
    factored_free(&y);
    factored_free(&z);
}

/* The workspace of the first of two workers does not grow: no other does. */
static void a_failed_workspace_is_reported(void **state) {
    (void)state;
    counter_t counter = counter_make();
    batch_t t = batch_make(GEN_GRID2, 100, SL_ISA_AUTO, 0);
    const sl_options opt = options_counted(&counter);
    sl_work *works[2];
    int calls = 0;
    const sl_threads threads = {2, run_backwards, &calls};
    for (int k = 0; k < 2; k++) {
        SL_CHECK(sl_work_create(&works[k], &opt));
    }
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY,
              sl_batch_solve(t.y.F, t.request, REQUESTS, THREADS(threads), works, NULL));
    assert_int_equal(sl_work_bytes(works[1]), 0);
    counter.fail_at = -1;
    SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, THREADS(threads), works, NULL));
    batch_check(&t);
    for (int k = 0; k < 2; k++) {
        sl_work_free(works[k]);
    }
    batch_free(&t);
    COUNTER_CLEAN(&counter);
}

/* One plan on all factors, with one B for all and with one for each; a full solve in the same
 * batch. */
static void one_plan_solves_with_all_factors(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    double c[TERMS * MOST];
    coefficients_of(c, MOST, 0.1);
    for (int isa = 0; isa < isas.count; isa++) {
        matrix_pair_t y = matrix_pair_make(GEN_GRID2, 200, 1, 0, NULL);
        const sl_int bset[2] = {17, 120}, xset[3] = {4, 18, 90};
        size_t n = (size_t)y.n;
        sl_factor *F[MOST] = {NULL};
        sl_plan *P = NULL;
        sl_options opt = options_none();
        sl_request requests[2 * MOST];
        double B[4 * MOST], X[6 * MOST], expected_local[6 * MOST], *full = test_reals(n * MOST),
                                                                   *expected = test_reals(n * MOST);
        opt.isa = isas.isa[isa];
        gen_reals(B, 4 * MOST, 5);
        gen_reals(expected, n * MOST, 6);
        SL_CHECK(sl_factor_create_sums(F, MOST, y.S, c, matrix_pair_values(&y), TERMS, &opt, NULL,
                                       NULL));
        SL_CHECK(sl_plan_create(&P, y.S, bset, 2, xset, 3, NULL, NULL));
        memset(requests, 0, sizeof requests);
        for (size_t k = 0; k < MOST; k++) {
            sl_request *r = &requests[2 * k];
            r->plan = P;
            r->factor = F[k];
            r->X = X + 6 * k;
            r->ldx = 3;
            r->B = k < MOST / 2 ? B : B + 4 * k;
            r->ldb = 2;
            r->nrhs = 2;
            SL_CHECK(sl_plan_solve(P, F[k], expected_local + 6 * k, 3, r->B, 2, 2, NULL));
            r[1].factor = k ? F[k] : NULL; /* NULL: the factor of the call */
            r[1].X = full + n * k;
            memcpy(r[1].X, expected + n * k, n * sizeof(double));
            r[1].B = r[1].X;
            r[1].ldx = r[1].ldb = n;
            r[1].nrhs = 1;
            SL_CHECK(sl_factor_solve(F[k], expected + n * k, n, expected + n * k, n, 1, NULL));
        }
        SL_CHECK(sl_batch_solve(F[0], requests, 2 * MOST, NULL, NULL, NULL));
        SAME_VALUES(full, expected, n * MOST);
        SAME_VALUES(X, expected_local, 6 * MOST);
        for (size_t k = 0; k < MOST; k++) { /* only the plans, no factor for the whole call */
            requests[k] = requests[2 * k];
        }
        for (int count = 0; count <= 4; count++) {
            int calls = 0;
            const sl_threads threads = threads_of(count, &calls);
            memset(X, 0, sizeof X);
            SL_CHECK(sl_batch_solve(NULL, requests, MOST, THREADS(threads), NULL, NULL));
            SAME_VALUES(X, expected_local, 6 * MOST);
            assert_int_equal(calls, count > 1);
        }
        sl_plan_free(P);
        free_all(F, MOST);
        free(full);
        free(expected);
        matrix_pair_free(&y);
    }
}

static void requests_with_invalid_factors_are_refused(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 25, 0, 1, NULL),
                  z = matrix_pair_make(GEN_PATH, 25, 0, 1, NULL);
    const double c[TERMS] = {1, 1}, none[TERMS] = {0, 0};
    const sl_int row = 3;
    double X[3] = {7, 7, 7}, B = 1;
    sl_factor *F = NULL, *G = NULL, *bad = NULL;
    sl_plan *P = NULL;
    sl_int failed = 9;
    SL_CHECK(sl_factor_create_sums(&F, 1, y.S, c, matrix_pair_values(&y), TERMS, NULL, NULL, NULL));
    SL_CHECK(
        sl_factor_create_sums(&bad, 1, y.S, c, matrix_pair_values(&y), TERMS, NULL, NULL, NULL));
    SL_CHECK(sl_factor_create_sums(&G, 1, z.S, c, matrix_pair_values(&z), TERMS, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor_sums(&bad, 1, none, matrix_pair_values(&y), TERMS,
                                                    NULL, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, y.S, &row, 1, &row, 1, NULL, NULL));
    sl_request r[3];
    memset(r, 0, sizeof r);
    for (int k = 0; k < 3; k++) {
        r[k].plan = P;
        r[k].X = &X[k];
        r[k].B = &B;
        r[k].ldx = r[k].ldb = 1;
        r[k].nrhs = 1;
        r[k].factor = F;
    }
    r[2].factor = G;
    SL_EXPECT(SL_ERR_MISMATCH, sl_batch_solve(F, r, 3, NULL, NULL, &failed));
    assert_int_equal(failed, 2);
    r[1].factor = bad;
    SL_EXPECT(SL_ERR_STALE, sl_batch_solve(F, r, 3, NULL, NULL, &failed));
    assert_int_equal(failed, 1);
    r[1].factor = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(NULL, r, 3, NULL, NULL, &failed));
    assert_int_equal(failed, 1);
    assert_true(X[0] == 7 && X[1] == 7 && X[2] == 7);
    SL_CHECK(sl_batch_solve(NULL, r, 1, NULL, NULL, &failed));
    assert_true(X[0] != 7 && X[1] == 7 && failed == -1);
    sl_plan_free(P);
    sl_factor_free(F);
    sl_factor_free(G);
    sl_factor_free(bad);
    matrix_pair_free(&y);
    matrix_pair_free(&z);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_batch_gives_the_bits_of_single_solves),
        cmocka_unit_test(all_workers_take_part),
        cmocka_unit_test(invalid_requests_change_nothing),
        cmocka_unit_test(a_failed_allocation_is_reported),
        cmocka_unit_test(failures_of_several_workers),
        cmocka_unit_test(a_failed_workspace_is_reported),
        cmocka_unit_test(one_plan_solves_with_all_factors),
        cmocka_unit_test(requests_with_invalid_factors_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
