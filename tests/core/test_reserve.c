/* test_reserve.c: after a reserve call, the operation that it is for allocates nothing */
#include "tests/lib/kkt.h"
#include "tests/lib/factored.h"

enum { N = 300, R = 11 };

static const gen_kind_t kinds[] = {GEN_NONE,  GEN_ONE,    GEN_DIAGONAL,   GEN_PATH,
                                   GEN_STAR,  GEN_GRID2,  GEN_GRID3,      GEN_FOREST,
                                   GEN_DENSE, GEN_RANDOM, GEN_COMPONENTS, GEN_KKT};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* A new workspace for each number of right-hand sides: reserved for it, used up to it. */
typedef struct reserved_t {
    counter_t counter;
    sl_work *W;
    size_t calls, bytes;
} reserved_t;

static void reserved_begin(reserved_t *r) {
    sl_options opt;
    r->counter = counter_make();
    opt = options_counted(&r->counter);
    SL_CHECK(sl_work_create(&r->W, &opt));
}

static void reserved_done(reserved_t *r) {
    r->calls = r->counter.calls;
    r->bytes = sl_work_bytes(r->W);
}

static void reserved_end(reserved_t *r) {
    assert_int_equal(r->counter.calls, r->calls);
    assert_int_equal(sl_work_bytes(r->W), r->bytes);
    sl_work_free(r->W);
    COUNTER_CLEAN(&r->counter);
}

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
            SL_CHECK(sl_work_reserve_refine(r.W, y.F, most));
            reserved_done(&r);
            for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
                memset(X, 0, ld * R * sizeof *X);
                SL_CHECK(sl_factor_refine(y.F, &y.M.view, X, ld, B, ld, nrhs, 2, r.W, NULL));
            }
            reserved_end(&r);
        }
        reserved_t r;
        reserved_begin(&r);
        SL_CHECK(sl_work_reserve_rcond(r.W, y.F));
        reserved_done(&r);
        SL_CHECK(sl_factor_rcond(y.F, &y.M.view, &rcond, r.W));
        reserved_end(&r);
        free(X);
        free(B);
        factored_free(&y);
    }
    for (sl_int most = 0; most <= R; most++) {
        sl_options opt = options_none();
        opt.null_pivots = SL_NULL_PIVOT_SKIP;
        factored_t y = factored_make(GEN_SINGULAR, N, 1, 0, &opt);
        sl_int n = y.M.view.n_cols;
        double *B = test_reals((size_t)n * R), Y[R];
        gen_reals(B, (size_t)n * R, 3);
        reserved_t r;
        reserved_begin(&r);
        SL_CHECK(sl_work_reserve_defects(r.W, y.F, most));
        reserved_done(&r);
        for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
            SL_CHECK(sl_factor_defects(y.F, Y, 1, B, (size_t)n, nrhs, r.W));
        }
        reserved_end(&r);
        free(B);
        factored_free(&y);
    }
}

/* Random sets of up to nb and nx rows, and NULL for all where the bound is n. */
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
            double *B = test_reals(((size_t)nb + 1) * R), *X = test_reals(((size_t)nx + 1) * R);
            reserved_t r;
            gen_reals(B, ((size_t)nb + 1) * R, 9);
            reserved_begin(&r);
            SL_CHECK(sl_work_reserve_local(r.W, y.S, nb, nx, most));
            reserved_done(&r);
            for (int turn = 0; turn < 6; turn++) {
                sl_int b = turn ? gen_below(&seed, nb + 1) : nb;
                sl_int x = turn ? gen_below(&seed, nx + 1) : nx;
                sl_int nrhs = turn ? gen_below(&seed, most + 1) : most;
                for (sl_int k = 0; k < b; k++) {
                    bset[k] = gen_below(&seed, n);
                }
                for (sl_int k = 0; k < x; k++) {
                    xset[k] = gen_below(&seed, n);
                }
                SL_CHECK(sl_local_solve(y.F, turn == 1 && nb == n ? NULL : bset, b,
                                        turn < 3 && nx == n ? NULL : xset, x, X, (size_t)nx + 1, B,
                                        (size_t)nb + 1, nrhs, r.W, NULL));
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

/* No rows at all need no bytes. */
static void no_rows_need_no_workspace(void **state) {
    (void)state;
    const sl_int p[1] = {0};
    const sl_csc A = {0, 0, p, NULL, NULL};
    sl_symbolic *S;
    sl_work *W;
    double x = 7.0;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_work_create(&W, NULL));
    SL_CHECK(sl_work_reserve_local(W, S, 0, 0, 0));
    sl_factor *F;
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_local_solve(F, NULL, 0, NULL, 0, &x, 1, &x, 1, 0, W, NULL));
    assert_true(x == 7.0);
    sl_factor_free(F);
    sl_work_free(W);
    sl_symbolic_free(S);
}

/* Few rows of a large grid: far less than the whole. */
static void the_bound_on_local_solves_is_local(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 40000, 1, 0, NULL);
    sl_work *few = NULL, *all = NULL;
    SL_CHECK(sl_work_create(&few, NULL));
    SL_CHECK(sl_work_create(&all, NULL));
    SL_CHECK(sl_work_reserve_local(few, y.S, 1, 1, 1));
    SL_CHECK(sl_work_reserve_local(all, y.S, 40000, 40000, 1));
    print_message("one row: %lu bytes, all rows: %lu bytes\n", (unsigned long)sl_work_bytes(few),
                  (unsigned long)sl_work_bytes(all));
    assert_true(sl_work_bytes(few) < sl_work_bytes(all) / 20);
    sl_work_free(few);
    sl_work_free(all);
    factored_free(&y);
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
    SL_CHECK(sl_factor_regularized_rows(F, rows, NULL, 240, &count));
    assert_true(count > 5);
    double *B = test_reals(240 * R), *X = test_reals(240 * R);
    gen_reals(B, 240 * R, 9);
    for (int whole = 0; whole < 2; whole++) {
        SL_CHECK(sl_plan_create(&P, y.S, whole ? NULL : rows, count, rows, count, NULL, NULL));
        for (sl_int most = 0; most <= R; most++) {
            reserved_t r;
            reserved_begin(&r);
            SL_CHECK(sl_work_reserve_refined(r.W, P, most));
            reserved_done(&r);
            for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
                SL_CHECK(sl_plan_solve_refined(P, F, X, 240, B, 240, nrhs, 3, r.W, NULL));
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

static void wrong_arguments(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_work *W = NULL;
    sl_plan *P = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    SL_CHECK(sl_plan_create(&P, y.S, NULL, 0, NULL, 0, NULL, NULL));
    const sl_int none[1] = {0};
    sl_plan *empty = NULL;
    SL_CHECK(sl_plan_create(&empty, y.S, NULL, 0, none, 0, NULL, NULL));
    SL_CHECK(sl_work_reserve_plan(W, empty, 3)); /* a solve of no x needs nothing */
    SL_CHECK(sl_work_reserve_refined(W, empty, 3));
    assert_int_equal(sl_work_bytes(W), 0);
    sl_plan_free(empty);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_refine(NULL, y.F, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_refine(W, NULL, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_refine(W, y.F, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_refined(NULL, P, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_refined(W, NULL, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_refined(W, P, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_rcond(NULL, y.F));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_rcond(W, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_defects(NULL, y.F, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_defects(W, NULL, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_defects(W, y.F, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_local(NULL, y.S, 1, 1, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_local(W, NULL, 1, 1, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_local(W, y.S, -1, 1, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_local(W, y.S, 1, -1, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_local(W, y.S, 1, 1, -1));
    assert_int_equal(sl_work_bytes(W), 0);
    sl_plan_free(P);
    sl_work_free(W);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refine_rcond_defects),
        cmocka_unit_test(local_solves),
        cmocka_unit_test(no_rows_need_no_workspace),
        cmocka_unit_test(the_bound_on_local_solves_is_local),
        cmocka_unit_test(refined_local_solves),
        cmocka_unit_test(wrong_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
