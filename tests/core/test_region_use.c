/* test_region_use.c: life of a region: rows outside, stale values, failures, threads */
#include "tests/lib/parallel_for.h"
#include "tests/lib/square_region.h"
#include "tests/lib/reserved.h"

/* With b or x outside the region, or a set that is NULL, the plan is one without a region, bit for
 * bit, and the stats say so. */
static void rows_outside_give_a_plain_plan(void **state) {
    (void)state;
    fixture_t *f = fixture_make();
    sl_options opt = options_none();
    sl_int outside[1] = {0}, some[3] = {f->set[5], f->set[0], f->set[399]}, none = 0;
    opt.region = f->R;
    for (int which = 0; which < 6; which++) {
        const sl_int *bset = which == 0 ? outside : which == 1 ? NULL : some;
        const sl_int *xset = which == 2 ? outside : which == 3 ? NULL : some;
        sl_int nb = bset == outside ? 1
                    : bset == NULL  ? SL_ALL
                    : which == 4    ? 0
                                    : 3,
               nx = xset == outside ? 1
                    : xset == NULL  ? SL_ALL
                    : which == 5    ? 0
                                    : 3;
        sl_int rows = bset ? nb : N, columns = xset ? nx : N;
        double *B = test_reals((size_t)rows + 1), *X = test_reals((size_t)columns + 1),
               *Y = test_reals((size_t)columns + 1);
        sl_plan *P = NULL, *Q = NULL;
        sl_stats in, plain;
        memset(&in, 0, sizeof in);
        memset(&plain, 0, sizeof plain);
        plain.plan.in_region = 7;
        gen_reals(B, (size_t)rows, 3);
        SL_CHECK(sl_plan_create(&P, f->y.S, which == 4 ? &none : bset, nb,
                                which == 5 ? &none : xset, nx, FOR_PLAN(&opt), &in));
        SL_CHECK(sl_plan_create(&Q, f->y.S, bset, nb, xset, nx, NULL, &plain));
        assert_int_equal(in.plan.in_region, which >= 4);
        assert_int_equal(plain.plan.in_region, 0);
        assert_int_equal(plain.plan.region_entries, 0);
        SL_CHECK(sl_plan_solve(P, f->y.F, X, (size_t)columns + 1, B, (size_t)rows + 1, 1, NULL));
        SL_CHECK(sl_plan_solve(Q, f->y.F, Y, (size_t)columns + 1, B, (size_t)rows + 1, 1, NULL));
        if (which < 4) {
            assert_int_equal(in.plan.b_entries, plain.plan.b_entries);
            assert_int_equal(in.plan.x_entries, plain.plan.x_entries);
            assert_int_equal(in.plan.bytes, plain.plan.bytes);
        }
        SAME_VALUES(X, Y, (size_t)columns); /* with no b both are 0 */
        sl_plan_free(P);
        sl_plan_free(Q);
        free(B);
        free(X);
        free(Y);
    }
    fixture_free(f);
}

/* A region of old values is refused by every call until it is refactored. */
static void stale_values_are_refused(void **state) {
    (void)state;
    fixture_t *f = fixture_make();
    double *values = test_reals((size_t)f->y.M.view.p[N]);
    sl_csc A = f->y.M.view, bad = A;
    const sl_int column = 17;
    sl_selected *Z = NULL;
    memcpy(values, A.x, (size_t)A.p[N] * sizeof *values);
    values[A.p[column]] = NAN;
    bad.x = values;
    assert_solution_matches(f, f->y.F);
    SL_CHECK(sl_selected_create(&Z, f->y.F, f->set, COUNT, NULL, NULL));
    for (int how = 0; how < 4; how++) {
        sl_request request = {f->P, f->X, COUNT, f->B, COUNT, 3, NULL};
        sl_region *none = f->R;
        sl_int failed = 7;
        switch (how) {
        case 0:
            SL_CHECK(sl_factor_refactor(f->y.F, &A, NULL));
            break;
        case 1:
            SL_CHECK(sl_factor_change_entries(f->y.F, &A, NULL, &column, NULL, 1, NULL, NULL));
            break;
        case 2:
            SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(f->y.F, &bad, NULL));
            SL_EXPECT(SL_ERR_STALE, fixture_solve(f, f->y.F));
            SL_EXPECT(SL_ERR_STALE, sl_region_refactor(f->R, f->y.F, NULL, NULL));
            SL_EXPECT(SL_ERR_STALE,
                      sl_region_create(&none, f->y.F, f->set, COUNT, NULL, NULL, NULL));
            assert_null(none);
            SL_CHECK(sl_factor_refactor(f->y.F, &A, NULL));
            break;
        default:
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor(f->y.F, NULL, NULL));
            SL_CHECK(sl_factor_refactor(f->y.F, &A, NULL));
        }
        memset(f->X, 0, sizeof f->X);
        SL_EXPECT(SL_ERR_STALE, fixture_solve(f, f->y.F));
        SL_EXPECT(SL_ERR_STALE,
                  sl_plan_solve(f->P, f->y.F, f->X, SL_ROWS(3), f->B, SL_ROWS(3), 3, NULL));
        SL_EXPECT(SL_ERR_STALE, sl_batch_solve(f->y.F, &request, 1, NULL, NULL, &failed));
        assert_int_equal(failed, 0);
        assert_true(f->X[0] == 0.0);
        /* Z holds old values too */
        SL_EXPECT(SL_ERR_STALE, sl_region_refactor(f->R, f->y.F, Z, NULL));
        none = f->R;
        SL_EXPECT(SL_ERR_STALE, sl_region_create(&none, f->y.F, f->set, 1, Z, NULL, NULL));
        assert_null(none);
        SL_CHECK(sl_selected_refactor(Z, f->y.F, NULL));
        SL_CHECK(sl_region_refactor(f->R, f->y.F, how % 2 ? Z : NULL, NULL));
        assert_solution_matches(f, f->y.F);
    }
    sl_selected_free(Z);
    free(values);
    fixture_free(f);
}

/* A region belongs to one factor. sl_region_refactor moves it to another factor of the same
 * analysis. */
static void a_region_belongs_to_one_factor(void **state) {
    (void)state;
    fixture_t *f = fixture_make();
    factored_t other = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_options opt = options_none();
    sl_factor *G = NULL;
    sl_plan *P = f->P;
    sl_csc A = f->y.M.view;
    double *values = test_reals((size_t)A.p[N]);
    for (sl_int k = 0; k < A.p[N]; k++) {
        values[k] = 0.5 * A.x[k];
    }
    A.x = values;
    SL_CHECK(sl_factor_create(&G, f->y.S, &A, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, fixture_solve(f, G));
    SL_EXPECT(SL_ERR_MISMATCH, fixture_solve(f, other.F)); /* another analysis */
    SL_EXPECT(SL_ERR_MISMATCH, sl_region_refactor(f->R, other.F, NULL, NULL));
    assert_solution_matches(f, f->y.F); /* still valid */
    SL_CHECK(sl_region_refactor(f->R, G, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, fixture_solve(f, f->y.F));
    assert_solution_matches(f, G);
    opt.region = f->R;
    SL_EXPECT(SL_ERR_MISMATCH,
              sl_plan_create(&P, other.S, f->set, 3, f->set, 3, FOR_PLAN(&opt), NULL));
    assert_null(P);
    free(values);
    sl_factor_free(G);
    factored_free(&other);
    fixture_free(f);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    fixture_t *f = fixture_make();
    sl_region *R = f->R;
    sl_options incomplete = options_none();
    sl_stats stats;
    sl_int below[3] = {4, -1, 7}, above[3] = {4, 7, N}, twice[3] = {7, 4, 7};
    memset(&stats, 0, sizeof stats);
    incomplete.allocator.allocate = counter_allocate;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(NULL, f->y.F, f->set, 3, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, NULL, f->set, 3, NULL, NULL, NULL));
    assert_null(R);
    R = f->R;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, f->y.F, f->set, -1, NULL, NULL, NULL));
    assert_null(R);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, f->y.F, f->set, 3, NULL, &incomplete, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, f->y.F, below, 3, NULL, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, f->y.F, above, 3, NULL, NULL, &stats));
    assert_int_equal(stats.error.row, N);
    assert_null(R);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_refactor(NULL, f->y.F, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_refactor(f->R, NULL, NULL, NULL));
    SL_CHECK(sl_region_create(&R, f->y.F, twice, 3, NULL, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    assert_int_equal(stats.region.boundary, 2);
    NOTHING_WRONG(check_region(R, twice, 3));
    sl_region_free(R);
    sl_region_free(NULL);
    assert_null(sl_region_view(NULL).symbolic);
    fixture_free(f);
}

/* No rows, a NULL set, all rows. Without a boundary a solve gives the bits of the full solve. */
static void empty_and_full_sets_work(void **state) {
    (void)state;
    factored_t empty = factored_make(GEN_NONE, 0, 1, 0, NULL), y;
    sl_region *R = NULL;
    sl_options opt = options_none();
    sl_plan *P = NULL;
    sl_int row = 3, all[60];
    double b = 2.0, x = 4321.5;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    for (int null = 0; null < 2; null++) {
        SL_CHECK(sl_region_create(&R, empty.F, null ? NULL : &row, 0, NULL, NULL, &stats));
        assert_int_equal(stats.region.rows, 0);
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, empty.S, &row, 0, &row, 0, FOR_PLAN(&opt), &stats));
        SL_CHECK(sl_plan_solve(P, empty.F, &x, 1, &b, 1, 1, NULL));
        assert_true(x == 4321.5);
        SL_CHECK(sl_region_refactor(R, empty.F, NULL, NULL));
        sl_plan_free(P);
        sl_region_free(R);
    }
    factored_free(&empty);
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        y = factored_make((gen_kind_t)kind, 60, 1, 0, NULL);
        sl_int n = y.M.view.n_cols;
        double B[60], X[60], full[60];
        gen_reals(B, 60, 3);
        SL_CHECK(sl_region_create(&R, y.F, &row, 0, NULL, NULL, &stats)); /* an empty set */
        assert_int_equal(stats.region.rows, 0);
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, y.S, all, 0, all, 0, FOR_PLAN(&opt), &stats));
        assert_int_equal(stats.plan.in_region, 1);
        sl_plan_free(P);
        sl_region_free(R);
        opt.region_bytes = 1;
        SL_CHECK(sl_region_create(&R, y.F, NULL, SL_ALL, NULL, FOR_REGION(&opt), &stats));
        assert_int_equal(stats.region.boundary, 0);
        assert_int_equal(stats.region.rows, n);
        for (sl_int k = 0; k < n; k++) {
            all[k] = n - 1 - k;
            X[k] = B[all[k]];
        }
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, y.S, all, n, all, n, FOR_PLAN(&opt), &stats));
        assert_int_equal(stats.plan.in_region, 1);
        SL_CHECK(sl_plan_solve(P, y.F, X, (size_t)n, X, (size_t)n, 1, NULL));
        SL_CHECK(sl_factor_solve(y.F, full, (size_t)n, B, (size_t)n, 1, NULL));
        for (sl_int k = 0; k < n; k++) {
            assert_true(X[k] == full[all[k]]);
        }
        sl_plan_free(P);
        sl_region_free(R);
        factored_free(&y);
    }
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    fixture_t *f = fixture_make();
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_region *R = f->R;
        counter.fail_at = k;
        status = sl_region_create(&R, f->y.F, f->set, COUNT, NULL, FOR_REGION(&opt), NULL);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
        assert_true((R != NULL) == (status == SL_OK));
        counter.fail_at = -1;
        if (R) {
            sl_work *W = NULL;
            SL_CHECK(sl_work_create(&W, FOR_OTHERS(&opt)));
            assert_int_equal(counter.live_blocks, 2);
            /* Fails and leaves R as it was. */
            for (int round = 0; round < 2; round++) {
                counter.fail_at = (int64_t)counter.calls;
                SL_EXPECT(SL_ERR_MEMORY,
                          sl_region_refactor(R, f->y.F, NULL, round == 0 ? NULL : W));
                counter.fail_at = -1;
                opt.region = R;
                sl_plan_free(f->P);
                SL_CHECK(sl_plan_create(&f->P, f->y.S, f->set, COUNT, f->set, COUNT, FOR_PLAN(&opt),
                                        NULL));
                assert_solution_matches(f, f->y.F);
            }
            SL_CHECK(sl_region_refactor(R, f->y.F, NULL, W));
            const size_t calls = counter.calls;
            SL_CHECK(sl_region_refactor(R, f->y.F, NULL, W));
            assert_int_equal(counter.calls, calls);
            assert_solution_matches(f, f->y.F);
            sl_plan_free(f->P);
            f->P = NULL;
            sl_work_free(W);
        }
        sl_region_free(R);
        COUNTER_CLEAN(&counter);
        assert_in_range(k, 0, 100);
    }
    fixture_free(f);
}

/* Solves allocate nothing in a workspace that was reserved for them, for any number of right-hand
 * sides. Neither the plan nor the workspace grows with the matrix around the region. */
static void solves_allocate_nothing(void **state) {
    (void)state;
    size_t bytes[2], kept[2];
    for (int large = 0; large < 2; large++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter), plain = options_none();
        factored_t y = factored_make(GEN_PATH, large ? 40000 : 400, 1, 0, NULL);
        sl_int set[50];
        double B[50 * 9], X[50 * 9];
        sl_region *R = NULL;
        sl_plan *P = NULL;
        sl_work *W = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        for (sl_int k = 0; k < 50; k++) {
            set[k] = 100 + k;
        }
        gen_reals(B, 50 * 9, 4);
        plain.region_bytes = 1500;
        SL_CHECK(sl_region_create(&R, y.F, set, 50, NULL, &plain, &stats));
        assert_true(stats.region.boundary > 0 && stats.region.bytes <= 1500);
        opt.region = R;
        const size_t before = counter.total_bytes;
        SL_CHECK(sl_plan_create(&P, y.S, set, 50, set, 50, FOR_PLAN(&opt), NULL));
        kept[large] = counter.total_bytes - before;
        SL_CHECK(sl_work_create(&W, FOR_OTHERS(&opt)));
        RESERVE_FOR(W, NULL, sl_plan_solve(P, y.F, X, 50, B, 50, 9, trial));
        const size_t calls = counter.calls;
        for (sl_int nrhs = 0; nrhs <= 9; nrhs++) {
            SL_CHECK(sl_plan_solve(P, y.F, X, 50, B, 50, nrhs, W));
        }
        assert_int_equal(counter.calls, calls);
        bytes[large] = sl_work_bytes(W);
        sl_work_free(W);
        sl_plan_free(P);
        COUNTER_CLEAN(&counter);
        sl_region_free(R);
        factored_free(&y);
    }
    print_message("plan %lu and %lu bytes, workspace %lu and %lu\n", (unsigned long)kept[0],
                  (unsigned long)kept[1], (unsigned long)bytes[0], (unsigned long)bytes[1]);
    assert_true(kept[1] <= 2 * kept[0] && bytes[1] <= 2 * bytes[0]);
}

/* A batch of plans in a region, plans without one and full solves gives the bits of single
 * solves. */
static void batches_equal_single_solves(void **state) {
    (void)state;
    enum { REQUESTS = 6, NRHS = 13 };
    fixture_t *f = fixture_make();
    sl_options opt = options_none();
    sl_plan *narrow = NULL, *outside = NULL;
    sl_request requests[REQUESTS];
    double *wanted[REQUESTS];
    sl_int far[COUNT];
    memset(requests, 0, sizeof requests);
    square(far, 110);
    opt.region = f->R;
    SL_CHECK(sl_plan_create(&narrow, f->y.S, f->set + 7, 1, f->set, 9, FOR_PLAN(&opt), NULL));
    SL_CHECK(sl_plan_create(&outside, f->y.S, far, COUNT, far, COUNT, FOR_PLAN(&opt), NULL));
    for (int k = 0; k < REQUESTS; k++) {
        sl_request *r = &requests[k];
        const sl_int nb = k == 5 ? N : k == 1 ? 1 : COUNT, nx = k == 5 ? N : k == 1 ? 9 : COUNT;
        double *B = test_reals((size_t)nb * NRHS);
        gen_reals(B, (size_t)nb * NRHS, (uint64_t)k + 1);
        r->plan = k == 5 ? NULL : k == 1 ? narrow : k == 3 ? outside : f->P;
        r->nrhs = k == 2 ? 1 : NRHS;
        r->B = B;
        r->ldb = (size_t)nb;
        r->ldx = (size_t)nx;
        r->X = test_reals((size_t)nx * NRHS);
        wanted[k] = test_reals((size_t)nx * NRHS);
        if (k == 5) {
            SL_CHECK(sl_factor_solve(f->y.F, wanted[k], N, B, N, NRHS, NULL));
        } else {
            SL_CHECK(sl_plan_solve(r->plan, f->y.F, wanted[k], r->ldx, B, r->ldb, r->nrhs, NULL));
        }
    }
    for (sl_int count = 0; count <= 5; count++) {
        int calls = 0;
        sl_threads threads = {count, count % 2 ? run_threads : run_backwards, &calls};
        SL_CHECK(sl_batch_solve(f->y.F, requests, REQUESTS, THREADS(threads), NULL, NULL));
        for (int k = 0; k < REQUESTS; k++) {
            const sl_int nx = k == 5 ? N : k == 1 ? 9 : COUNT;
            SAME_VALUES(requests[k].X, wanted[k], (size_t)(nx * requests[k].nrhs));
            memset(requests[k].X, 0, (size_t)nx * NRHS * sizeof(double));
        }
    }
    for (int k = 0; k < REQUESTS; k++) {
        free((double *)(uintptr_t)requests[k].B);
        free(requests[k].X);
        free(wanted[k]);
    }
    sl_plan_free(narrow);
    sl_plan_free(outside);
    fixture_free(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_outside_give_a_plain_plan),
        cmocka_unit_test(stale_values_are_refused),
        cmocka_unit_test(a_region_belongs_to_one_factor),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(empty_and_full_sets_work),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(solves_allocate_nothing),
        cmocka_unit_test(batches_equal_single_solves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
