/* test_threads.c: factorizations by several threads: the same bits, errors and memory */
#define _POSIX_C_SOURCE 200112L /* nanosleep */
#include "tests/lib/complex_pair.h"
#include "tests/lib/threads.h"

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
            /* one parallel call in each factorization, and one more where a pivot of badly scaled
             * rows was suspected to be null */
            const int wanted = count > 1 && sl_symbolic_view(y.S).n_supers > 1 ? 2 : 0;
            assert_true(calls == wanted || (kind == GEN_SCALED && calls == 2 * wanted));
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

/* A factor by `count` workers. calls: of the pool that runs them. */
static sl_factor *factor_by_threads(sl_symbolic *S, const sl_csc *A, sl_int count, sl_isa isa,
                                    sl_storage storage, int *calls) {
    sl_factor *F = NULL;
    sl_options opt = options_with_threads(runs[count % RUNS], count, calls);
    opt.isa = isa;
    opt.storage = storage;
    SL_CHECK(sl_factor_create(&F, S, A, &opt, NULL));
    return F;
}

/* Both fronts are factored at the same time, or one after the other where L alone is in float. */
static void large_fronts_with_rows_below_give_the_same_bits(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < STORAGES * isas.count; k++) {
        const sl_storage storage = storage_at(k);
        const sl_isa isa = isas.isa[k / STORAGES];
        factored_t y = two_large_fronts(101, 150, isa, storage);
        for (sl_int count = 2; count <= 5; count++) {
            int calls = 0;
            sl_factor *F = factor_by_threads(y.S, &y.M.view, count, isa, storage, &calls);
            assert_same_bits(F, y.F);
            sl_factor_free(F);
        }
        factored_free(&y);
    }
}

/* There is no view of L of a complex matrix. */
static void assert_same_lower(const sl_factor *F, const sl_factor *G, sl_int n) {
    sl_matrix *L = NULL, *M = NULL;
    SL_CHECK(sl_factor_lower(&L, F, NULL));
    SL_CHECK(sl_factor_lower(&M, G, NULL));
    const sl_csc l = sl_matrix_view(L), m = sl_matrix_view(M);
    assert_int_equal(l.p[n], m.p[n]);
    assert_memory_equal(l.x, m.x, (size_t)l.p[n] * sizeof *l.x);
    assert_memory_equal(sl_factor_view(F).D, sl_factor_view(G).D, (size_t)n * sizeof(double));
    sl_matrix_free(L);
    sl_matrix_free(M);
}

/* Those of complex matrices, half of whose numbers are kept, the separators of grids. */
static void large_complex_fronts_give_the_same_bits(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 0; k < 2 * isas.count; k++) {
        pair_t y = pair_make(k % 2 ? GEN_GRID2 : GEN_GRID3, 512, 0, isas.isa[k / 2]);
        for (sl_int count = 2; count <= 5; count++) {
            int calls = 0;
            sl_factor *F =
                factor_by_threads(y.S, &y.A, count, isas.isa[k / 2], SL_STORAGE_COMPLEX, &calls);
            assert_true(calls > 0);
            assert_same_lower(F, y.F[1], y.n);
            sl_factor_free(F);
        }
        pair_free(&y);
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

/* Local refactorizations: a vertex, a patch, rows everywhere. */
static void local_refactorizations_give_the_same_bits(void **state) {
    (void)state;
    static const sl_int strides[3] = {400, 1, 9};
    for (int kind = 0; kind < 3; kind++) {
        factored_t y = factored_make(GEN_GRID2, 30 * 30, 1, 0, NULL);
        const sl_int n = y.M.view.n_cols;
        sl_int columns[40], count = 0;
        sl_factor *F[2] = {NULL, NULL};
        int calls[2] = {0, 0};
        for (int k = 0; k < 2; k++) {
            const sl_options opt = options_with_threads(run_backwards, k == 0 ? 1 : 3, &calls[k]);
            SL_CHECK(sl_factor_create(&F[k], y.S, &y.M.view, &opt, NULL));
        }
        for (sl_int j = 435; j < n && count < 40; j += strides[kind], count++) {
            columns[count] = j;
            y.M.x[y.M.p[j]] *= 1.5;
        }
        for (int k = 0; k < 2; k++) {
            SL_CHECK(
                sl_factor_change_entries(F[k], &y.M.view, NULL, columns, NULL, count, NULL, NULL));
        }
        assert_same_bits(F[0], F[1]);
        assert_int_equal(calls[0], 0);
        assert_int_equal(calls[1], 2);
        sl_factor_free(F[0]);
        sl_factor_free(F[1]);
        factored_free(&y);
    }
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

/* A path whose first pivot is 0, before paths and a small pivot, which other threads meet first. */
static void small_pivots_after_a_failure_do_not_matter(void **state) {
    (void)state;
    enum { PATH = 200, PATHS = 3, N = PATHS * PATH + 2 };
    gen_list_t t = gen_list(N);
    for (sl_int k = 0; k < N - 2; k++) {
        gen_add(&t, k, k, k == 0 ? 0.0 : 4.0);
        if (k % PATH > 0) {
            gen_add(&t, k, k - 1, -1.0);
        }
    }
    gen_add(&t, N - 2, N - 2, 1.0);
    gen_add(&t, N - 1, N - 2, 1.0);
    gen_add(&t, N - 1, N - 1, 1.0 + 1e-14);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    opt.ordering = SL_ORDERING_NATURAL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    for (sl_int count = 1; count <= 4; count++) {
        for (int run = 0; run < RUNS; run++) {
            int calls = 0;
            sl_factor *F = NULL;
            sl_stats stats;
            opt = options_with_threads(runs[run], count, &calls);
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, &opt, &stats));
            assert_int_equal(calls > 0, count > 1);
            assert_int_equal(stats.error.row, 0);
        }
    }
    sl_symbolic_free(S);
    gen_list_free(&t);
    gen_matrix_free(&M);
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

static void unusual_thread_counts_are_handled(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    int calls = 0;
    sl_factor *F = NULL;
    sl_stats st;
    sl_options opt = options_with_threads(run_backwards, -1, &calls);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    opt.threads.count = INT32_MAX; /* never more threads than supernodes */
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    sl_factor_free(F);
    /* Without a run function: threads of the header's own, or the call is refused. */
    opt.threads.count = 2;
    opt.threads.run = NULL;
    if (HAS_THREADS) {
        SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, &st));
        assert_int_equal(st.factor.threads, 2);
        assert_same_bits(F, y.F);
    } else {
        SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_create(&F, y.S, &y.M.view, &opt, &st));
        assert_null(F);
    }
    sl_factor_free(F);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_do_not_depend_on_the_thread_count),
        cmocka_unit_test(large_fronts_give_the_same_bits),
        cmocka_unit_test(large_fronts_with_rows_below_give_the_same_bits),
        cmocka_unit_test(large_complex_fronts_give_the_same_bits),
        cmocka_unit_test(large_fronts_are_kept),
        cmocka_unit_test(local_refactorizations_give_the_same_bits),
        cmocka_unit_test(failures_in_large_fronts_are_reported),
        cmocka_unit_test(small_pivots_after_a_failure_do_not_matter),
        cmocka_unit_test(errors_do_not_depend_on_the_thread_count),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(unusual_thread_counts_are_handled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
