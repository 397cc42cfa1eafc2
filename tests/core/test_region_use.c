/* test_region_use.c: regions used rightly and wrongly: rows outside, old numbers, other factors, memory, threads */
#include "parallel_for.h"
#include "region.h"

enum { SIDE = 150, N = SIDE * SIDE, WIDE = 20, COUNT = WIDE * WIDE };

/* A square of a grid's rows, its upper left corner at (at, at). */
static void square(sl_int *set, sl_int at) {
    for (sl_int k = 0; k < COUNT; k++) {
        set[k] = (at + k / WIDE) * SIDE + at + k % WIDE;
    }
}

/* A grid, a region for a square of it and a plan in that. */
typedef struct scene_t {
    problem_t y;
    sl_int set[COUNT];
    sl_region *R;
    sl_plan *P;
    double B[3 * COUNT], X[3 * COUNT];
} scene_t;

static scene_t *scene_make(void) {
    scene_t *t = (scene_t *)test_array(1, sizeof *t);
    sl_options opt = options_none();
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    t->y = problem_make(GEN_GRID2, N, 1, 0, NULL);
    square(t->set, 41);
    SL_CHECK(sl_region_create(&t->R, t->y.F, t->set, COUNT, NULL, NULL, &stats));
    assert_true(stats.region_boundary > 0 && stats.region_subtrees > 0);
    assert_true(stats.region_entries >= (sl_off)stats.region_boundary * stats.region_boundary / 2);
    assert_true(stats.bytes_region >= (size_t)stats.region_entries * sizeof(double));
    opt.region = t->R;
    SL_CHECK(sl_plan_create(&t->P, t->y.S, t->set, COUNT, t->set, COUNT, &opt, NULL));
    gen_reals(t->B, 3 * COUNT, 6);
    return t;
}

static void scene_free(scene_t *t) {
    sl_plan_free(t->P);
    sl_region_free(t->R);
    problem_free(&t->y);
    free(t);
}

static sl_status scene_solve(scene_t *t, const sl_factor *F) {
    return sl_plan_solve(t->P, F, t->X, COUNT, t->B, COUNT, 3, NULL);
}

/* The plan's answer is that of F. */
static void scene_is_right(scene_t *t, const sl_factor *F) {
    double *full = test_reals(3 * N), largest = 0;
    SL_CHECK(scene_solve(t, F));
    for (sl_int k = 0; k < 3 * COUNT; k++) {
        full[N * (k / COUNT) + t->set[k % COUNT]] = t->B[k];
    }
    SL_CHECK(sl_factor_solve(F, full, N, full, N, 3, NULL));
    for (sl_int k = 0; k < 3 * N; k++) {
        largest = fabs(full[k]) > largest ? fabs(full[k]) : largest;
    }
    for (sl_int k = 0; k < 3 * COUNT; k++) {
        assert_true(fabs(t->X[k] - full[N * (k / COUNT) + t->set[k % COUNT]]) <=
                    1000 * DBL_EPSILON * largest);
    }
    free(full);
}

/* b or x outside, or a set that is NULL: the bits of the plan without a region, and the stats say so. */
static void rows_outside_fall_back(void **state) {
    (void)state;
    scene_t *t = scene_make();
    sl_options opt = options_none();
    sl_int outside[1] = {0}, some[3] = {t->set[5], t->set[0], t->set[399]}, none = 0;
    opt.region = t->R;
    for (int which = 0; which < 6; which++) {
        const sl_int *bset = which == 0 ? outside : which == 1 ? NULL : some;
        const sl_int *xset = which == 2 ? outside : which == 3 ? NULL : some;
        sl_int nb = bset == outside ? 1
                    : which == 4    ? 0
                                    : 3,
               nx = xset == outside ? 1
                    : which == 5    ? 0
                                    : 3;
        sl_int rows = bset ? nb : N, columns = xset ? nx : N;
        double *B = test_reals((size_t)rows + 1), *X = test_reals((size_t)columns + 1),
               *Y = test_reals((size_t)columns + 1);
        sl_plan *P = NULL, *Q = NULL;
        sl_stats in, plain;
        memset(&in, 0, sizeof in);
        memset(&plain, 0, sizeof plain);
        plain.plan_in_region = 7;
        gen_reals(B, (size_t)rows, 3);
        SL_CHECK(sl_plan_create(&P, t->y.S, which == 4 ? &none : bset, nb,
                                which == 5 ? &none : xset, nx, &opt, &in));
        SL_CHECK(sl_plan_create(&Q, t->y.S, bset, nb, xset, nx, NULL, &plain));
        assert_int_equal(in.plan_in_region, which >= 4);
        assert_int_equal(plain.plan_in_region, 0);
        assert_int_equal(plain.plan_region_entries, 0);
        SL_CHECK(sl_plan_solve(P, t->y.F, X, (size_t)columns + 1, B, (size_t)rows + 1, 1, NULL));
        SL_CHECK(sl_plan_solve(Q, t->y.F, Y, (size_t)columns + 1, B, (size_t)rows + 1, 1, NULL));
        if (which < 4) {
            assert_int_equal(in.b_entries, plain.b_entries);
            assert_int_equal(in.x_entries, plain.x_entries);
            assert_int_equal(in.bytes_plan, plain.bytes_plan);
        }
        SAME_VALUES(X, Y, (size_t)columns); /* no b: 0 in either */
        sl_plan_free(P);
        sl_plan_free(Q);
        free(B);
        free(X);
        free(Y);
    }
    scene_free(t);
}

/* What was made of other numbers is refused, by every call, until it is made anew. */
static void numbers_out_of_date_are_refused(void **state) {
    (void)state;
    scene_t *t = scene_make();
    double *values = test_reals((size_t)t->y.M.view.p[N]);
    sl_csc A = t->y.M.view, bad = A;
    const sl_int column = 17;
    sl_selected *Z = NULL;
    memcpy(values, A.x, (size_t)A.p[N] * sizeof *values);
    values[A.p[column]] = NAN;
    bad.x = values;
    scene_is_right(t, t->y.F);
    SL_CHECK(sl_selected_create(&Z, t->y.F, t->set, COUNT, NULL, NULL));
    for (int how = 0; how < 4; how++) {
        sl_request request = {t->P, t->X, COUNT, t->B, COUNT, 0, 3, NULL};
        sl_region *none = t->R;
        sl_int failed = 7;
        switch (how) {
        case 0:
            SL_CHECK(sl_factor_refactor(t->y.F, &A, NULL));
            break;
        case 1:
            SL_CHECK(sl_factor_refactor_changed(t->y.F, &A, &column, 1, NULL));
            break;
        case 2:
            SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(t->y.F, &bad, NULL));
            SL_EXPECT(SL_ERR_STATE, scene_solve(t, t->y.F));
            SL_EXPECT(SL_ERR_STATE, sl_region_refill(t->R, t->y.F, NULL, NULL));
            SL_EXPECT(SL_ERR_STATE,
                      sl_region_create(&none, t->y.F, t->set, COUNT, NULL, NULL, NULL));
            assert_null(none);
            SL_CHECK(sl_factor_refactor(t->y.F, &A, NULL));
            break;
        default:
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor(t->y.F, NULL, NULL));
            SL_CHECK(sl_factor_refactor(t->y.F, &A, NULL));
        }
        memset(t->X, 0, sizeof t->X);
        SL_EXPECT(SL_ERR_STATE, scene_solve(t, t->y.F));
        SL_EXPECT(SL_ERR_STATE, sl_plan_solve_interleaved(t->P, t->y.F, t->X, 3, t->B, 3, 3, NULL));
        SL_EXPECT(SL_ERR_STATE, sl_batch_solve(t->y.F, &request, 1, NULL, NULL, &failed));
        assert_int_equal(failed, 0);
        assert_true(t->X[0] == 0.0);
        SL_EXPECT(SL_ERR_STATE, sl_region_refill(t->R, t->y.F, Z, NULL)); /* Z is old as well */
        none = t->R;
        SL_EXPECT(SL_ERR_STATE, sl_region_create(&none, t->y.F, t->set, 1, Z, NULL, NULL));
        assert_null(none);
        SL_CHECK(sl_selected_refill(Z, t->y.F, NULL));
        SL_CHECK(sl_region_refill(t->R, t->y.F, how % 2 ? Z : NULL, NULL));
        scene_is_right(t, t->y.F);
    }
    sl_selected_free(Z);
    free(values);
    scene_free(t);
}

/* A region belongs to one factor; over the same analysis it may move to another. */
static void other_factors(void **state) {
    (void)state;
    scene_t *t = scene_make();
    problem_t other = problem_make(GEN_GRID2, N, 1, 0, NULL);
    sl_options opt = options_none();
    sl_factor *G = NULL;
    sl_plan *P = t->P;
    sl_csc A = t->y.M.view;
    double *values = test_reals((size_t)A.p[N]);
    for (sl_int k = 0; k < A.p[N]; k++) {
        values[k] = 0.5 * A.x[k];
    }
    A.x = values;
    SL_CHECK(sl_factor_create(&G, t->y.S, &A, NULL, NULL));
    SL_EXPECT(SL_ERR_STATE, scene_solve(t, G));
    SL_EXPECT(SL_ERR_STATE, scene_solve(t, other.F)); /* of another analysis */
    SL_EXPECT(SL_ERR_STATE, sl_region_refill(t->R, other.F, NULL, NULL));
    scene_is_right(t, t->y.F); /* as before */
    SL_CHECK(sl_region_refill(t->R, G, NULL, NULL));
    SL_EXPECT(SL_ERR_STATE, scene_solve(t, t->y.F));
    scene_is_right(t, G);
    opt.region = t->R;
    SL_EXPECT(SL_ERR_STATE, sl_plan_create(&P, other.S, t->set, 3, t->set, 3, &opt, NULL));
    assert_null(P);
    free(values);
    sl_factor_free(G);
    problem_free(&other);
    scene_free(t);
}

static void wrong_use(void **state) {
    (void)state;
    scene_t *t = scene_make();
    sl_region *R = t->R;
    sl_options half = options_none();
    sl_stats stats;
    sl_int below[3] = {4, -1, 7}, above[3] = {4, 7, N}, twice[3] = {7, 4, 7};
    memset(&stats, 0, sizeof stats);
    half.allocator.allocate = counter_allocate;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(NULL, t->y.F, t->set, 3, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, NULL, t->set, 3, NULL, NULL, NULL));
    assert_null(R);
    R = t->R;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, t->y.F, t->set, -1, NULL, NULL, NULL));
    assert_null(R);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, t->y.F, t->set, 3, NULL, &half, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, t->y.F, below, 3, NULL, NULL, &stats));
    assert_int_equal(stats.error_row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_create(&R, t->y.F, above, 3, NULL, NULL, &stats));
    assert_int_equal(stats.error_row, N);
    assert_null(R);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_refill(NULL, t->y.F, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_region_refill(t->R, NULL, NULL, NULL));
    SL_CHECK(sl_region_create(&R, t->y.F, twice, 3, NULL, NULL, &stats));
    assert_int_equal(stats.error_row, -1);
    assert_int_equal(stats.region_boundary, 2);
    NOTHING_WRONG(check_region(R, twice, 3));
    sl_region_free(R);
    sl_region_free(NULL);
    sl_region_stats(NULL, &stats);
    sl_region_stats(t->R, NULL);
    assert_null(sl_region_view(NULL).symbolic);
    scene_free(t);
}

/* No rows, no set, all rows; and without a boundary the bits of the full solve. */
static void nothing_and_everything(void **state) {
    (void)state;
    problem_t empty = problem_make(GEN_NONE, 0, 1, 0, NULL), y;
    sl_region *R = NULL;
    sl_options opt = options_none();
    sl_plan *P = NULL;
    sl_int row = 3, all[60];
    double b = 2.0, x = 4321.5;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    for (int null = 0; null < 2; null++) {
        SL_CHECK(sl_region_create(&R, empty.F, null ? NULL : &row, 0, NULL, NULL, &stats));
        assert_int_equal(stats.region_rows, 0);
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, empty.S, &row, 0, &row, 0, &opt, &stats));
        SL_CHECK(sl_plan_solve(P, empty.F, &x, 1, &b, 1, 1, NULL));
        assert_true(x == 4321.5);
        SL_CHECK(sl_region_refill(R, empty.F, NULL, NULL));
        sl_plan_free(P);
        sl_region_free(R);
    }
    problem_free(&empty);
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        y = problem_make((gen_kind_t)kind, 60, 1, 0, NULL);
        sl_int n = y.M.view.n_cols;
        double B[60], X[60], full[60];
        gen_reals(B, 60, 3);
        SL_CHECK(sl_region_create(&R, y.F, &row, 0, NULL, NULL, &stats)); /* an empty set */
        assert_int_equal(stats.region_rows, 0);
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, y.S, all, 0, all, 0, &opt, &stats));
        assert_int_equal(stats.plan_in_region, 1);
        sl_plan_free(P);
        sl_region_free(R);
        opt.region_bytes = 1;
        SL_CHECK(sl_region_create(&R, y.F, NULL, -5, NULL, &opt, &stats));
        assert_int_equal(stats.region_boundary, 0);
        assert_int_equal(stats.region_rows, n);
        for (sl_int k = 0; k < n; k++) {
            all[k] = n - 1 - k;
            X[k] = B[all[k]];
        }
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, y.S, all, n, all, n, &opt, &stats));
        assert_int_equal(stats.plan_in_region, 1);
        SL_CHECK(sl_plan_solve(P, y.F, X, (size_t)n, X, (size_t)n, 1, NULL));
        SL_CHECK(sl_factor_solve(y.F, full, (size_t)n, B, (size_t)n, 1, NULL));
        for (sl_int k = 0; k < n; k++) {
            assert_true(X[k] == full[all[k]]);
        }
        sl_plan_free(P);
        sl_region_free(R);
        problem_free(&y);
    }
}

/* ---- memory ---- */

static void every_allocation_may_fail(void **state) {
    (void)state;
    scene_t *t = scene_make();
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_region *R = t->R;
        counter.fail_at = k;
        status = sl_region_create(&R, t->y.F, t->set, COUNT, NULL, &opt, NULL);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
        assert_true((R != NULL) == (status == SL_OK));
        counter.fail_at = -1;
        if (R) {
            sl_work *W = NULL;
            SL_CHECK(sl_work_create(&W, &opt));
            assert_int_equal(counter.live_blocks, 2);
            for (int round = 0; round < 2; round++) { /* fails, and leaves R as it was */
                counter.fail_at = (int64_t)counter.calls;
                SL_EXPECT(SL_ERR_MEMORY, sl_region_refill(R, t->y.F, NULL, round == 0 ? NULL : W));
                counter.fail_at = -1;
                opt.region = R;
                sl_plan_free(t->P);
                SL_CHECK(sl_plan_create(&t->P, t->y.S, t->set, COUNT, t->set, COUNT, &opt, NULL));
                scene_is_right(t, t->y.F);
            }
            SL_CHECK(sl_region_refill(R, t->y.F, NULL, W));
            const size_t calls = counter.calls;
            SL_CHECK(sl_region_refill(R, t->y.F, NULL, W));
            assert_int_equal(counter.calls, calls);
            scene_is_right(t, t->y.F);
            sl_plan_free(t->P);
            t->P = NULL;
            sl_work_free(W);
        }
        sl_region_free(R);
        COUNTER_CLEAN(&counter);
        assert_in_range(k, 0, 100);
    }
    scene_free(t);
}

/* Solves allocate nothing once the workspace has grown or has been made for them, for any number of right-hand sides;
 * and neither the plan nor the workspace grows with what is around the region. */
static void solves_allocate_nothing(void **state) {
    (void)state;
    size_t bytes[2], kept[2];
    for (int large = 0; large < 2; large++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter), plain = options_none();
        problem_t y = problem_make(GEN_PATH, large ? 40000 : 400, 1, 0, NULL);
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
        assert_true(stats.region_boundary > 0 && stats.bytes_region <= 1500);
        opt.region = R;
        const size_t before = counter.total_bytes;
        SL_CHECK(sl_plan_create(&P, y.S, set, 50, set, 50, &opt, NULL));
        kept[large] = counter.total_bytes - before;
        SL_CHECK(sl_work_create(&W, &opt));
        SL_CHECK(sl_work_reserve_plan(W, P, 9));
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
        problem_free(&y);
    }
    print_message("plan %lu and %lu bytes, workspace %lu and %lu\n", (unsigned long)kept[0],
                  (unsigned long)kept[1], (unsigned long)bytes[0], (unsigned long)bytes[1]);
    assert_true(kept[1] <= 2 * kept[0] && bytes[1] <= 2 * bytes[0]);
}

/* ---- threads ---- */

/* Plans in a region, plans without and full solves in one batch: the bits of single solves. */
static void batches(void **state) {
    (void)state;
    enum { REQUESTS = 6, NRHS = 13 };
    scene_t *t = scene_make();
    sl_options opt = options_none();
    sl_plan *narrow = NULL, *outside = NULL;
    sl_request requests[REQUESTS];
    double *wanted[REQUESTS];
    sl_int far[COUNT];
    memset(requests, 0, sizeof requests);
    square(far, 110);
    opt.region = t->R;
    SL_CHECK(sl_plan_create(&narrow, t->y.S, t->set + 7, 1, t->set, 9, &opt, NULL));
    SL_CHECK(sl_plan_create(&outside, t->y.S, far, COUNT, far, COUNT, &opt, NULL));
    for (int k = 0; k < REQUESTS; k++) {
        sl_request *r = &requests[k];
        const sl_int nb = k == 5 ? N : k == 1 ? 1 : COUNT, nx = k == 5 ? N : k == 1 ? 9 : COUNT;
        double *B = test_reals((size_t)nb * NRHS);
        gen_reals(B, (size_t)nb * NRHS, (uint64_t)k + 1);
        r->plan = k == 5 ? NULL : k == 1 ? narrow : k == 3 ? outside : t->P;
        r->nrhs = k == 2 ? 1 : NRHS;
        r->is_interleaved = k == 4;
        r->B = B;
        r->ldb = k == 4 ? NRHS : (size_t)nb;
        r->ldx = k == 4 ? NRHS : (size_t)nx;
        r->X = test_reals((size_t)nx * NRHS);
        wanted[k] = test_reals((size_t)nx * NRHS);
        if (k == 5) {
            SL_CHECK(sl_factor_solve(t->y.F, wanted[k], N, B, N, NRHS, NULL));
        } else {
            SL_CHECK((k == 4 ? sl_plan_solve_interleaved : sl_plan_solve)(
                r->plan, t->y.F, wanted[k], r->ldx, B, r->ldb, r->nrhs, NULL));
        }
    }
    for (sl_int count = 0; count <= 5; count++) {
        int calls = 0;
        sl_threads threads = {count, count % 2 ? run_threads : run_backwards, &calls};
        SL_CHECK(sl_batch_solve(t->y.F, requests, REQUESTS, &threads, NULL, NULL));
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
    scene_free(t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_outside_fall_back),
        cmocka_unit_test(numbers_out_of_date_are_refused),
        cmocka_unit_test(other_factors),
        cmocka_unit_test(wrong_use),
        cmocka_unit_test(nothing_and_everything),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(solves_allocate_nothing),
        cmocka_unit_test(batches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
