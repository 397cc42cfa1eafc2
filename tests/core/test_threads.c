/* test_threads.c: factorizations and solves by several threads: the same bits, errors and memory */
#define _POSIX_C_SOURCE 200112L /* nanosleep */
#include "tests/lib/pools.h"
#include "tests/lib/factored.h"

static sl_options options_with_threads(sl_parallel_for run, sl_int count, int *calls) {
    sl_options opt = options_none();
    opt.method = SL_METHOD_SUPERNODAL;
    opt.threads.count = count;
    opt.threads.run = run;
    opt.threads.context = calls;
    return opt;
}

/* The options of a workspace, which reads threads alone. */
static sl_options options_of_workers(sl_int count, int *calls) {
    sl_options opt = options_with_threads(run_backwards, count, calls);
    opt.method = SL_METHOD_AUTO;
    return opt;
}

static void assert_same_bits_for_any_thread_count(gen_kind_t kind, sl_int size, sl_isa isa) {
    sl_options opt = options_none();
    opt.isa = isa;
    opt.method = SL_METHOD_SUPERNODAL;
    factored_t y = factored_make(kind, size, 0, 0, &opt);
    for (int run = 0; run < RUNS; run++) {
        for (sl_int count = 0; count <= 8; count += count < 3 ? 1 : 5) {
            int calls = 0;
            sl_factor *F = NULL;
            opt = options_with_threads(runs[run], count, &calls);
            opt.isa = isa;
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
            assert_same_bits(F, y.F);
            SL_CHECK(sl_factor_refactor(F, &y.M.view, NULL));
            assert_same_bits(F, y.F);
            /* one parallel call in each factorization */
            assert_int_equal(calls, count > 1 && sl_symbolic_view(y.S).n_supers > 1 ? 2 : 0);
            sl_factor_free(F);
        }
    }
    factored_free(&y);
}

static void bits_do_not_depend_on_the_thread_count(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int kind = 0; kind < GEN_REGULAR; kind++) {
            assert_same_bits_for_any_thread_count((gen_kind_t)kind, 200, isas.isa[k]);
        }
    }
}

/* Large fronts, of many pieces: a dense matrix, the separators of a 3D grid. */
static void large_fronts_give_the_same_bits(void **state) {
    (void)state;
    assert_same_bits_for_any_thread_count(GEN_DENSE, 400, SL_ISA_AUTO);
    assert_same_bits_for_any_thread_count(GEN_GRID3, 15 * 15 * 15, SL_ISA_AUTO);
}

/* Two dense blocks of w columns, both adjacent to the h rows of a dense last block. In natural
 * order each is a large front with rows below. */
static factored_t two_large_fronts(sl_int w, sl_int h, sl_isa isa, sl_storage storage) {
    gen_list_t t = gen_list(2 * w + h);
    uint64_t seed = 7;
    for (sl_int j = 0; j < t.n; j++) {
        for (sl_int i = j + 1; i < t.n; i++) {
            if (j >= w || i < w || i >= 2 * w) {
                gen_add(&t, i, j, gen_real(&seed));
            }
        }
    }
    gen_dominate(&t, 0, &seed);
    sl_options opt = options_with_threads(NULL, 1, NULL);
    factored_t y = {gen_store(&t, gen_style(0), 1), NULL, NULL};
    opt.isa = isa;
    opt.ordering = SL_ORDERING_NATURAL;
    opt.relaxation = SL_RELAXATION_NONE;
    opt.storage = storage;
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, FOR_ANALYSIS(&opt), NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
    assert_int_equal(sl_symbolic_view(y.S).n_supers, 3);
    gen_list_free(&t);
    return y;
}

/* Both fronts are factored at the same time, or one after the other where L alone is in float. */
static void large_fronts_with_rows_below_give_the_same_bits(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    const sl_storage storages[] = {SL_STORAGE_DOUBLE, SL_STORAGE_FLOAT, SL_STORAGE_FLOAT_FRONTS};
    for (int k = 0; k < 3 * isas.count; k++) {
        const sl_storage storage = storages[k % 3];
        factored_t y = two_large_fronts(101, 150, isas.isa[k / 3], storage);
        for (sl_int count = 2; count <= 5; count++) {
            int calls = 0;
            sl_factor *F = NULL;
            sl_options opt = options_with_threads(runs[count % RUNS], count, &calls);
            opt.isa = isas.isa[k / 3];
            opt.storage = storage;
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
            assert_same_bits(F, y.F);
            sl_factor_free(F);
        }
        factored_free(&y);
    }
}

/* After a change of the last pivot both blocks are kept, which are large fronts. */
static void large_fronts_are_kept(void **state) {
    (void)state;
    enum { ROWS = 2 * 101 + 150 };
    factored_t y = two_large_fronts(101, 150, SL_ISA_AUTO, SL_STORAGE_DOUBLE);
    sl_int same[ROWS];
    sl_factor *G[2] = {NULL, NULL};
    for (sl_int k = 0; k < ROWS; k++) {
        same[k] = k;
    }
    y.M.x[y.M.view.p[ROWS] - 1] += 1.0;
    for (int k = 0; k < 2; k++) {
        int calls = 0;
        const sl_options opt = options_with_threads(run_backwards, k == 0 ? 1 : 4, &calls);
        sl_stats stats;
        SL_CHECK(sl_factor_edit(&G[k], y.F, y.S, &y.M.view, same, &opt, &stats));
        assert_int_equal(stats.reuse.kept, 2 * 101);
        assert_int_equal(calls > 0, k > 0);
    }
    assert_same_bits(G[0], G[1]);
    sl_factor_free(G[0]);
    sl_factor_free(G[1]);
    factored_free(&y);
}

/* A shared front that fails is reported as it is without threads: a value that is not finite is met
 * before the front, a null pivot after it. */
static void failures_in_large_fronts_are_reported(void **state) {
    (void)state;
    factored_t y = two_large_fronts(101, 150, SL_ISA_AUTO, SL_STORAGE_DOUBLE);
    for (int kind = 0; kind < 2; kind++) {
        for (sl_int front = 0; front < 2; front++) {
            const sl_int row = front * 101, later = kind == 0 ? 202 : 230;
            const double keep = y.M.x[y.M.p[row]], kept = y.M.x[y.M.p[later]];
            sl_stats one, many;
            sl_factor *F = NULL;
            int calls = 0;
            y.M.x[y.M.p[row]] = kind == 0 ? (double)NAN : 0.0;
            y.M.x[y.M.p[later]] = (double)INFINITY;
            memset(&one, 0, sizeof one);
            memset(&many, 0, sizeof many);
            sl_options opt = options_with_threads(NULL, 1, NULL);
            const sl_status status = sl_factor_create(&F, y.S, &y.M.view, &opt, &one);
            assert_int_equal(status, kind == 0 ? SL_ERR_NOT_FINITE : SL_ERR_PIVOT);
            assert_int_equal(one.error.row, row);
            opt = options_with_threads(runs[front + 2 * kind], 2, &calls);
            SL_EXPECT(status, sl_factor_create(&F, y.S, &y.M.view, &opt, &many));
            assert_null(F);
            assert_int_equal(many.error.row, row);
            y.M.x[y.M.p[row]] = keep;
            y.M.x[y.M.p[later]] = kept;
        }
    }
    factored_free(&y);
}

/* The first failure in elimination order is reported, whichever thread meets it. */
static void errors_do_not_depend_on_the_thread_count(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 900, 1, 0, NULL);
    sl_int nnz = y.M.p[y.M.view.n_cols];
    uint64_t seed = 4;
    for (int turn = 0; turn < 40; turn++) {
        sl_stats one, many;
        sl_factor *F = NULL;
        double keep[3];
        sl_int at[3];
        int calls = 0;
        /* Several failures at once, of both kinds. */
        for (int k = 0; k < 3; k++) {
            at[k] = gen_below(&seed, nnz);
            keep[k] = y.M.x[at[k]];
            y.M.x[at[k]] = turn % 2 ? NAN : turn % 3 ? INFINITY : 0.0;
        }
        memset(&one, 0, sizeof one);
        memset(&many, 0, sizeof many);
        sl_options opt = options_with_threads(NULL, 1, NULL);
        sl_status status = sl_factor_create(&F, y.S, &y.M.view, &opt, &one);
        sl_factor_free(F);
        opt = options_with_threads(runs[turn % RUNS], 2 + turn % 5, &calls);
        SL_EXPECT(status, sl_factor_create(&F, y.S, &y.M.view, &opt, &many));
        sl_factor_free(F);
        assert_int_equal(one.error.row, many.error.row);
        assert_int_equal(one.error.column, many.error.column);
        assert_int_equal(one.factor.null, many.factor.null);
        for (int k = 2; k >= 0; k--) {
            y.M.x[at[k]] = keep[k];
        }
    }
    factored_free(&y);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        int calls = 0;
        sl_options opt = options_with_threads(run_backwards, 3, &calls);
        sl_factor *F = NULL;
        opt.allocator = options_counted(&counter).allocator;
        counter.fail_at = k;
        status = sl_factor_create(&F, y.S, &y.M.view, &opt, NULL);
        assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
        if (status == SL_OK) {
            size_t before = counter.calls;
            SL_CHECK(sl_factor_refactor(F, &y.M.view, NULL));
            assert_int_equal(counter.calls, before);
        }
        sl_factor_free(F);
        COUNTER_CLEAN(&counter);
    }
    factored_free(&y);
}

/* Full solves with the threads of the workspace: one right-hand side by subtrees, many by blocks.
 * After a reserve call they allocate nothing. */
static void solves_give_the_same_bits(void **state) {
    (void)state;
    enum { RHS = 20, COUNTS = 4 };
    static const sl_int counts[COUNTS] = {1, 2, 3, 8}, some[COUNTS] = {1, 3, 9, RHS};
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 30; size <= 300; size *= 10) {
            factored_t y = factored_make((gen_kind_t)kind, size, 0, 0, NULL);
            const size_t n = (size_t)y.M.view.n_cols;
            uint64_t seed = 5;
            double *B = test_reals(n * RHS), *one = test_reals(n * RHS), *X = test_reals(n * RHS);
            for (size_t k = 0; k < n * RHS; k++) {
                B[k] = gen_real(&seed);
            }
            for (int c = 0; c < COUNTS * COUNTS * RUNS; c++) {
                const sl_int nrhs = some[c % COUNTS];
                int calls = 0;
                counter_t counter = counter_make();
                sl_options opt = options_with_threads(runs[c / COUNTS % RUNS],
                                                      counts[c / COUNTS / RUNS], &calls);
                sl_work *W = NULL;
                opt.method = SL_METHOD_AUTO;
                opt.allocator = options_counted(&counter).allocator;
                SL_CHECK(sl_work_create(&W, &opt));
                SL_CHECK(sl_work_reserve_factor(W, y.F, nrhs));
                const size_t before = counter.calls;
                SL_CHECK(sl_factor_solve(y.F, one, n, B, n, nrhs, NULL));
                SL_CHECK(sl_factor_solve(y.F, X, n, B, n, nrhs, W));
                assert_memory_equal(X, one, n * (size_t)nrhs * sizeof *X);
                memcpy(X, B, n * (size_t)nrhs * sizeof *X);
                SL_CHECK(sl_factor_solve(y.F, X, n, X, n, nrhs, W));
                assert_memory_equal(X, one, n * (size_t)nrhs * sizeof *X);
                SL_CHECK(sl_factor_solve_interleaved(y.F, one, RHS, B, RHS, nrhs, NULL));
                SL_CHECK(sl_factor_solve_interleaved(y.F, X, RHS, B, RHS, nrhs, W));
                for (size_t k = 0; k < n; k++) {
                    assert_memory_equal(X + RHS * k, one + RHS * k, (size_t)nrhs * sizeof *X);
                }
                SL_CHECK(sl_factor_solve(y.F, X, n, B, n, 1, W)); /* reserved too */
                assert_int_equal(counter.calls, before);
                if (kind == GEN_GRID2 && size == 300 && counts[c / COUNTS / RUNS] > 1) {
                    assert_int_equal(calls, nrhs == 1 ? 4 : nrhs == 3 ? 1 : 4);
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
        SL_EXPECT(SL_ERR_MEMORY, sl_work_reserve_factor(W, F, nrhs));
        sl_work_free(W);
        COUNTER_CLEAN(&counter);
    }
    free(B);
    free(X);
    free(Y);
}

/* As many subtrees as are kept, of which some could be divided; one worker where a set is given;
 * blocks of 32 right-hand sides. */
static void many_trees_give_the_same_bits(void **state) {
    (void)state;
    enum { TREES = 100, SIDE = 4, ROWS = TREES * SIDE * SIDE };
    static const sl_int set[3] = {5, 700, 8};
    gen_list_t t = gen_list(ROWS);
    for (sl_int k = 0; k < ROWS; k++) {
        gen_add(&t, k, k, 5.0);
        if (k % SIDE != 0) {
            gen_add(&t, k, k - 1, -1.0);
        }
        if (k % (SIDE * SIDE) >= SIDE) {
            gen_add(&t, k, k - SIDE, -1.0);
        }
    }
    factored_t y = {gen_store(&t, gen_style(0), 1), NULL, NULL};
    sl_options opt = options_none();
    opt.relaxation = SL_RELAXATION_NONE;
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, NULL, NULL));
    check_workers(y.F, NULL, ROWS, 1, 8);
    check_workers(y.F, NULL, ROWS, 130, 2);
    for (int k = 0; k < 2; k++) {
        sl_plan *P = NULL;
        SL_CHECK(sl_plan_create(&P, y.S, k == 0 ? NULL : set, k == 0 ? 0 : 3, k == 0 ? set : NULL,
                                k == 0 ? 3 : 0, NULL, NULL));
        check_workers(y.F, P, ROWS, 1, 8);
        sl_plan_free(P);
    }
    gen_list_free(&t);
    factored_free(&y);
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
        opt.null_pivots = k == 0 ? SL_NULL_PIVOT_REFUSE : SL_NULL_PIVOT_SKIP;
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
        for (sl_storage storage = SL_STORAGE_DOUBLE; storage <= SL_STORAGE_FLOAT; storage++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            opt.storage = storage;
            factored_t y = factored_make(GEN_GRID2, 300, 0, 0, &opt);
            factored_t border = {bordered(), NULL, NULL};
            sl_options single = options_none();
            check_blocks(y.F, (size_t)y.M.view.n_cols);
            single.ordering = SL_ORDERING_NATURAL;
            single.relaxation = SL_RELAXATION_NONE;
            SL_CHECK(sl_symbolic_create(&border.S, &border.M.view, &single, NULL));
            SL_CHECK(sl_factor_create(&border.F, border.S, &border.M.view, &opt, NULL));
            check_blocks(border.F, (size_t)border.M.view.n_cols);
            factored_free(&border);
            if (storage == SL_STORAGE_DOUBLE) { /* and as a complex matrix */
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

static void unusual_thread_counts_are_handled(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    int calls = 0;
    sl_factor *F = NULL;
    sl_options opt = options_with_threads(run_backwards, -1, &calls);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    opt.threads.count = INT32_MAX; /* never more threads than supernodes */
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    sl_factor_free(F);
    /* Without a run function: one after the other, or OpenMP. */
    opt.threads.count = 2;
    opt.threads.run = NULL;
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    assert_same_bits(F, y.F);
    sl_factor_free(F);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_do_not_depend_on_the_thread_count),
        cmocka_unit_test(large_fronts_give_the_same_bits),
        cmocka_unit_test(large_fronts_with_rows_below_give_the_same_bits),
        cmocka_unit_test(large_fronts_are_kept),
        cmocka_unit_test(failures_in_large_fronts_are_reported),
        cmocka_unit_test(errors_do_not_depend_on_the_thread_count),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(solves_give_the_same_bits),
        cmocka_unit_test(many_trees_give_the_same_bits),
        cmocka_unit_test(some_systems_are_left_to_one_worker),
        cmocka_unit_test(large_vectors_give_the_same_bits),
        cmocka_unit_test(unusual_thread_counts_are_handled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
