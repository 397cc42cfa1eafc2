/* test_threads_solve.c: full solves by several threads: the same bits, errors and memory */
#define _POSIX_C_SOURCE 200112L /* nanosleep */
#include "tests/lib/threads.h"
#include "tests/lib/fixed_rows.h"
#include "tests/lib/reserved.h"

/* Full solves with the threads of the workspace: by subtrees, many right-hand sides by blocks.
 * After a reserve call they allocate nothing. */
static void solves_give_the_same_bits(void **state) {
    (void)state;
    enum { RHS = 36, COUNTS = 4, WIDTHS = 7 };
    static const sl_int counts[COUNTS] = {1, 2, 3, 8}, some[WIDTHS] = {1, 2, 3, 4, 9, 20, RHS};
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 30; size <= 300; size *= 10) {
            factored_t y = factored_make((gen_kind_t)kind, size, 0, 0, NULL);
            const size_t n = (size_t)y.M.view.n_cols;
            uint64_t seed = 5;
            double *B = test_reals(n * RHS), *one = test_reals(n * RHS), *X = test_reals(n * RHS);
            for (size_t k = 0; k < n * RHS; k++) {
                B[k] = gen_real(&seed);
            }
            for (int c = 0; c < WIDTHS * COUNTS * RUNS; c++) {
                const sl_int nrhs = some[c % WIDTHS];
                int calls = 0;
                counter_t counter = counter_make();
                sl_options opt = options_with_threads(runs[c / WIDTHS % RUNS],
                                                      counts[c / WIDTHS / RUNS], &calls);
                sl_work *W = NULL;
                opt.method = SL_METHOD_AUTO;
                opt.allocator = options_counted(&counter).allocator;
                SL_CHECK(sl_work_create(&W, &opt));
                RESERVE_FOR(W, &opt, sl_factor_solve(y.F, X, n, B, n, nrhs, trial));
                RESERVE_FOR(W, &opt, sl_factor_solve(y.F, X, n, B, n, 1, trial));
                calls = 0;
                const size_t before = counter.calls;
                SL_CHECK(sl_factor_solve(y.F, one, n, B, n, nrhs, NULL));
                SL_CHECK(sl_factor_solve(y.F, X, n, B, n, nrhs, W));
                assert_memory_equal(X, one, n * (size_t)nrhs * sizeof *X);
                memcpy(X, B, n * (size_t)nrhs * sizeof *X);
                SL_CHECK(sl_factor_solve(y.F, X, n, X, n, nrhs, W));
                assert_memory_equal(X, one, n * (size_t)nrhs * sizeof *X);
                SL_CHECK(sl_factor_solve(y.F, one, SL_ROWS(RHS), B, SL_ROWS(RHS), nrhs, NULL));
                SL_CHECK(sl_factor_solve(y.F, X, SL_ROWS(RHS), B, SL_ROWS(RHS), nrhs, W));
                for (size_t k = 0; k < n; k++) {
                    assert_memory_equal(X + RHS * k, one + RHS * k, (size_t)nrhs * sizeof *X);
                }
                SL_CHECK(sl_factor_solve(y.F, X, n, B, n, 1, W)); /* reserved too */
                assert_int_equal(counter.calls, before);
                if (kind == GEN_GRID2 && size == 300 && counts[c / WIDTHS / RUNS] > 1) {
                    assert_int_equal(calls, 4);
                }
                sl_work_free(W);
                COUNTER_CLEAN(&counter);
            }
            free(X);
            free(one);
            free(B);
            factored_free(&y);
        }
    }
}

/* Solves for free rows with the threads of the workspace, in each layout. */
static void fixed_rows_share_the_threads(void **state) {
    (void)state;
    enum { SIDE = 20, FIXED = 30 };
    static const sl_int widths[4] = {1, 3, 8, 70};
    factored_t y = factored_make(GEN_GRID2, SIDE * SIDE, 1, 0, NULL);
    sl_int rows[FIXED];
    sl_fixed *D = NULL;
    for (sl_int k = 0; k < FIXED; k++) {
        rows[k] = 13 * k + 2;
    }
    SL_CHECK(sl_fixed_create(&D, &y.M.view, rows, FIXED, NULL, NULL));
    for (int k = 0; k < 4 * 4; k++) {
        const fixed_t p = {&y.M.view, rows,      FIXED, widths[k / 4], k % 2, k / 2 % 2,
                           k % 4 < 2, k % 3 > 0, 0};
        int calls = 0;
        const sl_options opt = options_of_workers(3, &calls);
        sl_work *W = NULL;
        SL_CHECK(sl_work_create(&W, &opt));
        fixed_check(D, &p, W);
        assert_true(calls > 0);
        sl_work_free(W);
    }
    sl_fixed_free(D);
    factored_free(&y);
}

/* Full solves and plans in a workspace with threads and in one without. P: NULL for full ones. */
static void check_workers(const sl_factor *F, const sl_plan *P, size_t n, sl_int nrhs,
                          sl_int workers) {
    double *B = test_reals(n * (size_t)nrhs), *X = test_reals(n * (size_t)nrhs),
           *Y = test_reals(n * (size_t)nrhs);
    int calls = 0;
    const sl_options opt = options_of_workers(workers, &calls);
    sl_work *W = NULL;
    gen_reals(B, n * (size_t)nrhs, 6);
    memset(X, 0, n * (size_t)nrhs * sizeof *X);
    memset(Y, 0, n * (size_t)nrhs * sizeof *Y);
    SL_CHECK(sl_work_create(&W, &opt));
    SL_CHECK(P != NULL ? sl_plan_solve(P, F, X, n, B, n, nrhs, W)
                       : sl_factor_solve(F, X, n, B, n, nrhs, W));
    SL_CHECK(P != NULL ? sl_plan_solve(P, F, Y, n, B, n, nrhs, NULL)
                       : sl_factor_solve(F, Y, n, B, n, nrhs, NULL));
    SAME_VALUES(X, Y, n * (size_t)nrhs);
    assert_int_equal(calls > 0, P == NULL);
    sl_work_free(W);
    if (P == NULL) { /* the vectors of all workers do not fit */
        sl_options none = opt;
        counter_t counter = counter_make();
        none.allocator = options_counted(&counter).allocator;
        SL_CHECK(sl_work_create(&W, &none));
        counter.fail_at = (int64_t)counter.calls;
        SL_EXPECT(SL_ERR_MEMORY, sl_factor_solve(F, X, n, B, n, nrhs, W));
        sl_work_free(W);
        COUNTER_CLEAN(&counter);
    }
    free(B);
    free(X);
    free(Y);
}

/* The factor of grids that are not joined, grid k of side[k] x side[k] rows. */
static factored_t grids(const sl_int *side, sl_int count) {
    factored_t y = {{0}, NULL, NULL};
    sl_options opt = options_none();
    sl_int rows = 0;
    for (sl_int k = 0; k < count; k++) {
        rows += side[k] * side[k];
    }
    gen_list_t t = gen_list(rows);
    for (sl_int k = 0, first = 0; k < count; first += side[k] * side[k], k++) {
        for (sl_int i = 0; i < side[k] * side[k]; i++) {
            gen_add(&t, first + i, first + i, 5.0);
            if (i % side[k] != 0) {
                gen_add(&t, first + i, first + i - 1, -1.0);
            }
            if (i >= side[k]) {
                gen_add(&t, first + i, first + i - side[k], -1.0);
            }
        }
    }
    y.M = gen_store(&t, gen_style(0), 1);
    opt.relaxation = SL_RELAXATION_NONE;
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, NULL, NULL));
    gen_list_free(&t);
    return y;
}

/* As many subtrees as are kept, of which some could be divided; one worker where a set is given;
 * blocks of 64 right-hand sides. */
static void many_trees_give_the_same_bits(void **state) {
    (void)state;
    enum { TREES = 100, SIDE = 4, ROWS = TREES * SIDE * SIDE };
    static const sl_int set[3] = {5, 700, 8};
    sl_int side[TREES];
    for (int k = 0; k < TREES; k++) {
        side[k] = SIDE;
    }
    factored_t y = grids(side, TREES);
    check_workers(y.F, NULL, ROWS, 1, 8);
    check_workers(y.F, NULL, ROWS, 130, 2);
    check_workers(y.F, NULL, ROWS, 260, 2);
    for (int k = 0; k < 2; k++) {
        sl_plan *P = NULL;
        SL_CHECK(sl_plan_create(&P, y.S, k == 0 ? NULL : set, k == 0 ? SL_ALL : 3,
                                k == 0 ? set : NULL, k == 0 ? 3 : SL_ALL, NULL, NULL));
        check_workers(y.F, P, ROWS, 1, 8);
        sl_plan_free(P);
    }
    factored_free(&y);
}

/* The larger of two trees is divided first, whether it comes first or last. */
static void two_trees_give_the_same_bits(void **state) {
    (void)state;
    static const sl_int sides[2][2] = {{20, 19}, {19, 20}};
    for (int k = 0; k < 2; k++) {
        factored_t y = grids(sides[k], 2);
        check_workers(y.F, NULL, (size_t)y.M.view.n_cols, 1, 8);
        factored_free(&y);
    }
}

/* Blocks of any size have the bits of blocks of 8. */
static void check_blocks(const sl_factor *F, size_t n) {
    enum { RHS = 61 };
    double *B = test_reals(n * RHS), *X = test_reals(n * RHS), *Y = test_reals(n * RHS);
    gen_reals(B, n * RHS, 7);
    for (size_t r = 0; r < RHS; r += 8) {
        SL_CHECK(sl_factor_solve(F, Y + n * r, n, B + n * r, n, r + 8 < RHS ? 8 : RHS - (sl_int)r,
                                 NULL));
    }
    SL_CHECK(sl_factor_solve(F, X, n, B, n, RHS, NULL));
    SAME_VALUES(X, Y, n * RHS);
    free(B);
    free(X);
    free(Y);
}

/* One worker solves singular systems, whose sums are over all rows, and along a chain of columns,
 * which no number of divisions makes shorter. */
static void some_systems_are_left_to_one_worker(void **state) {
    (void)state;
    int calls = 0;
    const sl_options many = options_of_workers(4, &calls);
    for (int k = 0; k < 3; k++) {
        sl_options opt = options_none();
        opt.ordering = k == 0 ? SL_ORDERING_NATURAL : SL_ORDERING_ND;
        opt.relaxation = SL_RELAXATION_NONE;
        gen_list_t t = gen_make(k == 0 ? GEN_PATH : GEN_SINGULAR, 400, 1, 3);
        factored_t y = {gen_store(&t, gen_style(0), 1), NULL, NULL};
        sl_work *W = NULL;
        double *B = test_reals(400), *X = test_reals(400);
        gen_list_free(&t);
        SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, &opt, NULL));
        opt = options_none();
        opt.pivots = k == 0 ? SL_PIVOTS_NONZERO : SL_PIVOTS_SKIP_NULL;
        opt.consistency_tolerance = k == 1 ? -1.0 : 0.0;
        SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
        SL_CHECK(sl_work_create(&W, &many));
        SL_CHECK(sl_factor_solve(y.F, X, 400, B, 400, 1, W));
        assert_int_equal(calls, 0);
        sl_work_free(W);
        free(B);
        free(X);
        factored_free(&y);
    }
}

/* Columns that are supernodes of their own, with more than a tile of rows below. */
static gen_matrix_t bordered(void) {
    enum { SINGLE = 40, BORDER = 11 };
    gen_list_t t = gen_list(SINGLE + BORDER);
    for (sl_int k = 0; k < SINGLE + BORDER; k++) {
        gen_add(&t, k, k, 60.0);
        for (sl_int i = k < SINGLE ? SINGLE : k + 1; i < SINGLE + BORDER; i++) {
            gen_add(&t, i, k, -1.0);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* Here any vector counts as larger than the caches: its rows are prefetched, and right-hand sides
 * are written to it around the caches. */
static void large_vectors_give_the_same_bits(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int which = 0; which < STORAGES; which++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            opt.storage = storage_at(which);
            factored_t y = factored_make(GEN_GRID2, 300, 0, 0, &opt);
            factored_t border = {bordered(), NULL, NULL};
            check_blocks(y.F, (size_t)y.M.view.n_cols);
            border.S = analyze_natural(&border.M.view, SL_RELAXATION_NONE);
            SL_CHECK(sl_factor_create(&border.F, border.S, &border.M.view, &opt, NULL));
            check_blocks(border.F, (size_t)border.M.view.n_cols);
            factored_free(&border);
            if (opt.storage == SL_STORAGE_DOUBLE) { /* and as a complex matrix */
                const sl_int n = y.M.view.n_cols;
                double *im = test_reals((size_t)y.M.view.p[n]);
                memset(im, 0, (size_t)y.M.view.p[n] * sizeof *im);
                const sl_hermitian H = {n, y.M.view.p, y.M.view.i, y.M.view.x, im};
                sl_matrix *M = NULL;
                sl_symbolic *S = NULL;
                sl_factor *F = NULL;
                SL_CHECK(sl_matrix_from_hermitian(&M, &H, NULL, NULL));
                const sl_csc A = sl_matrix_view(M);
                sl_options paired = options_none();
                paired.block_size = 2;
                SL_CHECK(sl_symbolic_create(&S, &A, &paired, NULL));
                opt.storage = SL_STORAGE_COMPLEX;
                SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
                check_blocks(F, 2 * (size_t)n);
                sl_factor_free(F);
                sl_symbolic_free(S);
                sl_matrix_free(M);
                free(im);
            }
            factored_free(&y);
        }
    }
}

/* A NaN is reported by every worker's share, and by the subtrees of a single right-hand side. */
static void a_nan_is_reported(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    enum { RHS = 48 }; /* so many in blocks, 1 and 20 by subtrees */
    double *B = test_reals(400 * RHS), *X = test_reals(400 * RHS);
    int calls = 0;
    const sl_options opt = options_of_workers(3, &calls);
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, &opt));
    for (sl_int nrhs = 1; nrhs <= RHS; nrhs += nrhs == 1 ? 19 : 28) {
        for (sl_int k = 0; k < 400; k += 7) {
            const sl_int at = k + 400 * (k % nrhs);
            SL_CHECK(sl_factor_solve(y.F, X, 400, B, 400, nrhs, W));
            B[at] = NAN;
            SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_solve(y.F, X, 400, B, 400, nrhs, W));
            B[at] = 0.0;
        }
    }
    assert_true(calls > 0);
    sl_work_free(W);
    free(B);
    free(X);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_nan_is_reported),
        cmocka_unit_test(solves_give_the_same_bits),
        cmocka_unit_test(fixed_rows_share_the_threads),
        cmocka_unit_test(many_trees_give_the_same_bits),
        cmocka_unit_test(two_trees_give_the_same_bits),
        cmocka_unit_test(some_systems_are_left_to_one_worker),
        cmocka_unit_test(large_vectors_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
