/* test_reserve.c: with what the largest call took reserved, calls of its shape allocate nothing */
#include "tests/lib/kkt.h"
#include "tests/lib/factored.h"
#include "tests/lib/reserved.h"

enum { N = 300, R = 11 };

static const gen_kind_t kinds[] = {GEN_NONE,  GEN_ONE,    GEN_DIAGONAL,   GEN_PATH,
                                   GEN_STAR,  GEN_GRID2,  GEN_GRID3,      GEN_FOREST,
                                   GEN_DENSE, GEN_RANDOM, GEN_COMPONENTS, GEN_KKT};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static void refine_rcond_defects(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        factored_t y = factored_make(kinds[kind], N, 1, 0, NULL);
        sl_int n = y.M.view.n_cols;
        size_t ld = n > 0 ? (size_t)n : 1;
        double *X = test_reals(ld * R), *B = test_reals(ld * R), rcond;
        gen_reals(B, ld * R, 3);
        for (sl_int most = 0; most <= R; most++) {
            reserved_t r;
            reserved_begin(&r);
            memset(X, 0, ld * R * sizeof *X);
            RESERVE_FOR(r.W, NULL,
                        sl_factor_refine(y.F, &y.M.view, X, ld, B, ld, most, 2, trial, NULL));
            reserved_done(&r);
            for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
                memset(X, 0, ld * R * sizeof *X);
                SL_CHECK(sl_factor_refine(y.F, &y.M.view, X, ld, B, ld, nrhs, 2, r.W, NULL));
                SL_CHECK(sl_factor_refine(y.F, &y.M.view, X, SL_ROWS(R), B, SL_ROWS(R), nrhs, 2,
                                          r.W, NULL));
            }
            reserved_end(&r);
        }
        reserved_t r;
        reserved_begin(&r);
        RESERVE_FOR(r.W, NULL, sl_factor_rcond(y.F, &y.M.view, &rcond, trial));
        reserved_done(&r);
        SL_CHECK(sl_factor_rcond(y.F, &y.M.view, &rcond, r.W));
        reserved_end(&r);
        free(X);
        free(B);
        factored_free(&y);
    }
    for (sl_int most = 0; most <= R; most++) {
        sl_options opt = options_none();
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        factored_t y = factored_make(GEN_SINGULAR, N, 1, 0, &opt);
        sl_int n = y.M.view.n_cols;
        double *B = test_reals((size_t)n * R), Y[R];
        gen_reals(B, (size_t)n * R, 3);
        reserved_t r;
        reserved_begin(&r);
        RESERVE_FOR(r.W, NULL, sl_factor_defects(y.F, Y, 1, B, (size_t)n, most, trial));
        reserved_done(&r);
        for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
            SL_CHECK(sl_factor_defects(y.F, Y, 1, B, (size_t)n, nrhs, r.W));
            SL_CHECK(sl_factor_defects(y.F, Y, SL_ROWS(R), B, SL_ROWS(R), nrhs, r.W));
        }
        reserved_end(&r);
        free(B);
        factored_free(&y);
    }
}

/* Full solves and solves on plans with random sets, and NULL for all, in both layouts. */
static void full_and_planned_solves(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        factored_t y = factored_make(kinds[kind], N, 1, 0, NULL);
        sl_int n = y.M.view.n_cols;
        const size_t ld = (size_t)n + R;
        const sl_int sizes[4] = {0, n > 0, n / 3, n};
        sl_int *set = test_ints((size_t)n + 1);
        double *X = test_reals(ld * R), *B = test_reals(ld * R);
        uint64_t seed = 1;
        gen_reals(B, ld * R, 3);
        for (int which = 0; which < 4 * R; which++) {
            const sl_int count = sizes[which % 4], most = 1 + which / 4;
            sl_plan *P = NULL;
            reserved_t full, planned;
            for (sl_int k = 0; k < count; k++) {
                set[k] = gen_below(&seed, n);
            }
            SL_CHECK(sl_plan_create(&P, y.S, set, count, which % 3 ? set : NULL,
                                    which % 3 ? count : SL_ALL, NULL, NULL));
            reserved_begin(&full);
            RESERVE_FOR(full.W, NULL, sl_factor_solve(y.F, X, ld, B, ld, most, trial));
            reserved_done(&full);
            reserved_begin(&planned);
            RESERVE_FOR(planned.W, NULL, sl_plan_solve(P, y.F, X, ld, B, ld, most, trial));
            reserved_done(&planned);
            for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
                SL_CHECK(sl_factor_solve(y.F, X, ld, B, ld, nrhs, full.W));
                SL_CHECK(sl_factor_solve(y.F, X, SL_ROWS(R), B, SL_ROWS(R), nrhs, full.W));
                SL_CHECK(sl_plan_solve(P, y.F, X, ld, B, ld, nrhs, planned.W));
                SL_CHECK(sl_plan_solve(P, y.F, X, SL_ROWS(R), B, SL_ROWS(R), nrhs, planned.W));
            }
            reserved_end(&full);
            reserved_end(&planned);
            sl_plan_free(P);
        }
        free(set);
        free(X);
        free(B);
        factored_free(&y);
    }
}

/* The same sets. Fewer rows may need more: two equal reaches share their vector. */
static void local_solves(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        factored_t y = factored_make(kinds[kind], N, 1, 0, NULL);
        sl_int n = y.M.view.n_cols;
        const sl_int sizes[5] = {0, n > 0, n / 40, n / 3, n};
        uint64_t seed = 1;
        for (int pair = 0; pair < 25; pair++) {
            sl_int nb = sizes[pair / 5], nx = sizes[pair % 5], most = 1 + pair % R;
            sl_int *bset = test_ints((size_t)nb + 1), *xset = test_ints((size_t)nx + 1);
            const size_t ldb = (size_t)nb + 1, ldx = (size_t)nx + 1;
            double *B = test_reals(ldb * R), *X = test_reals(ldx * R);
            reserved_t r;
            gen_reals(B, ldb * R, 9);
            for (sl_int k = 0; k < nb; k++) {
                bset[k] = gen_below(&seed, n);
            }
            for (sl_int k = 0; k < nx; k++) {
                xset[k] = gen_below(&seed, n);
            }
            reserved_begin(&r);
            RESERVE_FOR(r.W, NULL,
                        sl_local_solve(y.F, bset, nb, xset, nx, X, ldx, B, ldb, most, trial, NULL));
            reserved_done(&r);
            for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
                SL_CHECK(sl_local_solve(y.F, bset, nb, xset, nx, X, ldx, B, ldb, nrhs, r.W, NULL));
            }
            reserved_end(&r);
            free(bset);
            free(xset);
            free(B);
            free(X);
        }
        factored_free(&y);
    }
}

/* No rows at all. */
static void no_rows_need_no_workspace(void **state) {
    (void)state;
    const sl_int p[1] = {0};
    const sl_csc A = {0, 0, p, NULL, NULL};
    sl_symbolic *S;
    sl_work *W;
    double x = 7.0;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_work_create(&W, NULL));
    sl_factor *F;
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_local_solve(F, NULL, SL_ALL, NULL, SL_ALL, &x, 1, &x, 1, 0, W, NULL));
    assert_true(x == 7.0);
    sl_factor_free(F);
    sl_work_free(W);
    sl_symbolic_free(S);
}

/* A regularized factor: b in its regularized rows only, and in all rows. */
static void refined_local_solves(void **state) {
    (void)state;
    kkt_t y = kkt_make(240, 0, SL_ORDERING_ND);
    sl_options opt = options_none();
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    sl_int rows[240], count;
    opt.regularization = 1e-7;
    opt.signs = y.signs;
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, rows, NULL, 240, &count));
    assert_true(count > 5);
    double *B = test_reals(240 * R), *X = test_reals(240 * R);
    gen_reals(B, 240 * R, 9);
    for (int whole = 0; whole < 2; whole++) {
        SL_CHECK(sl_plan_create(&P, y.S, whole ? NULL : rows, whole ? SL_ALL : count, rows, count,
                                NULL, NULL));
        for (sl_int most = 0; most <= R; most++) {
            reserved_t r;
            reserved_begin(&r);
            RESERVE_FOR(r.W, NULL,
                        sl_plan_solve_regularized(P, F, X, 240, B, 240, most, 3, trial, NULL));
            reserved_done(&r);
            for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
                SL_CHECK(sl_plan_solve_regularized(P, F, X, 240, B, 240, nrhs, 3, r.W, NULL));
            }
            reserved_end(&r);
        }
        sl_plan_free(P);
    }
    free(B);
    free(X);
    sl_factor_free(F);
    kkt_free(&y);
}

/* A workspace never shrinks, has what was asked for, and keeps what it has on an error. */
static void reserving(void **state) {
    (void)state;
    counter_t counter = counter_make();
    const sl_options opt = options_counted(&counter);
    sl_work *W = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve(NULL, 1));
    assert_int_equal(sl_work_bytes(NULL), 0);
    SL_CHECK(sl_work_create(&W, &opt));
    const size_t made = counter.calls;
    SL_CHECK(sl_work_reserve(W, 0));
    assert_int_equal(sl_work_bytes(W), 0);
    assert_int_equal(counter.calls, made);
    SL_CHECK(sl_work_reserve(W, 1000));
    assert_int_equal(sl_work_bytes(W), 1000);
    SL_CHECK(sl_work_reserve(W, 999));
    assert_int_equal(sl_work_bytes(W), 1000);
    assert_int_equal(counter.calls, made + 1);
    SL_EXPECT(SL_ERR_TOO_LARGE, sl_work_reserve(W, SIZE_MAX));
    SL_EXPECT(SL_ERR_MEMORY, sl_work_reserve(W, SIZE_MAX - 1));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_work_reserve(W, 1001));
    assert_int_equal(sl_work_bytes(W), 1000);
    counter.fail_at = -1;
    SL_CHECK(sl_work_reserve(W, 1001));
    assert_int_equal(sl_work_bytes(W), 1001);
    sl_work_free(W);
    COUNTER_CLEAN(&counter);
}

/* Solves of no x need nothing. */
static void no_x_needs_no_workspace(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    const sl_int none[1] = {0};
    const size_t n = (size_t)y.M.view.n_cols;
    double *B = test_reals(n * 3), x = 7.0;
    sl_work *W = NULL;
    sl_plan *empty = NULL;
    gen_reals(B, n * 3, 2);
    SL_CHECK(sl_work_create(&W, NULL));
    SL_CHECK(sl_plan_create(&empty, y.S, NULL, SL_ALL, none, 0, NULL, NULL));
    SL_CHECK(sl_plan_solve(empty, y.F, &x, 1, B, n, 3, W));
    SL_CHECK(sl_plan_solve_regularized(empty, y.F, &x, 1, B, n, 3, 2, W, NULL));
    assert_int_equal(sl_work_bytes(W), 0);
    assert_true(x == 7.0);
    sl_plan_free(empty);
    sl_work_free(W);
    free(B);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refine_rcond_defects),
        cmocka_unit_test(full_and_planned_solves),
        cmocka_unit_test(local_solves),
        cmocka_unit_test(no_rows_need_no_workspace),
        cmocka_unit_test(refined_local_solves),
        cmocka_unit_test(reserving),
        cmocka_unit_test(no_x_needs_no_workspace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
