/* test_threads.c: factorizations by several workers: the same bits, the same failures, their memory */
#include "parallel_for.h"
#include "problem.h"

static sl_options options_threads(sl_parallel_for run, sl_int count, int *calls) {
    sl_options opt = options_none();
    opt.method = SL_METHOD_SUPERNODAL;
    opt.threads.count = count;
    opt.threads.run = run;
    opt.threads.context = calls;
    return opt;
}

static void assert_same_bits_for_any_number(gen_kind_t kind, sl_int size, sl_isa isa) {
    static const sl_parallel_for ways[2] = {run_threads, run_backwards};
    sl_options opt = options_none();
    opt.isa = isa;
    opt.method = SL_METHOD_SUPERNODAL;
    problem_t y = problem_make(kind, size, 0, 0, &opt);
    for (int way = 0; way < 2; way++) {
        for (sl_int count = 0; count <= 9; count = count * 2 + 1) {
            int calls = 0;
            sl_factor *F = NULL;
            opt = options_threads(ways[way], count, &calls);
            opt.isa = isa;
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
            assert_same_bits(F, y.F);
            SL_CHECK(sl_factor_refactor(F, &y.M.view, NULL));
            assert_same_bits(F, y.F);
            assert_int_equal(calls > 0, count > 1 && sl_symbolic_view(y.S).n_supers > 1);
            sl_factor_free(F);
        }
    }
    problem_free(&y);
}

static void bits_do_not_depend_on_their_number(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int kind = 0; kind < GEN_REGULAR; kind++) {
            assert_same_bits_for_any_number((gen_kind_t)kind, 200, isas.isa[k]);
        }
    }
}

/* Fronts above SLI_SHARED_FLOPS are shared out: a dense matrix, the separators of a 3D grid. */
static void large_fronts_are_shared(void **state) {
    (void)state;
    assert_same_bits_for_any_number(GEN_DENSE, 400, SL_ISA_AUTO);
    assert_same_bits_for_any_number(GEN_GRID3, 15 * 15 * 15, SL_ISA_AUTO);
}

/* The first failure of all is told, whoever meets it. */
static void the_same_failure_for_any_number(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 900, 1, 0, NULL);
    sl_int nnz = y.M.p[y.M.view.n_cols];
    uint64_t seed = 4;
    for (int turn = 0; turn < 40; turn++) {
        sl_stats one, many;
        sl_factor *F = NULL;
        double keep[3];
        sl_int at[3];
        int calls = 0;
        for (int k = 0; k < 3; k++) { /* several at once, of both kinds */
            at[k] = gen_below(&seed, nnz);
            keep[k] = y.M.x[at[k]];
            y.M.x[at[k]] = turn % 2 ? NAN : turn % 3 ? INFINITY : 0.0;
        }
        memset(&one, 0, sizeof one);
        memset(&many, 0, sizeof many);
        sl_options opt = options_threads(NULL, 1, NULL);
        sl_status status = sl_factor_create(&F, y.S, &y.M.view, &opt, &one);
        sl_factor_free(F);
        opt = options_threads(turn % 4 < 2 ? run_threads : run_backwards, 2 + turn % 5, &calls);
        SL_EXPECT(status, sl_factor_create(&F, y.S, &y.M.view, &opt, &many));
        sl_factor_free(F);
        assert_int_equal(one.error_row, many.error_row);
        assert_int_equal(one.error_column, many.error_column);
        assert_int_equal(one.null, many.null);
        for (int k = 2; k >= 0; k--) {
            y.M.x[at[k]] = keep[k];
        }
    }
    problem_free(&y);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        int calls = 0;
        sl_options opt = options_threads(run_backwards, 3, &calls);
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
    problem_free(&y);
}

static void senseless_numbers(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 100, 1, 0, NULL);
    int calls = 0;
    sl_factor *F = NULL;
    sl_options opt = options_threads(run_backwards, -1, &calls);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    opt.threads.count = INT32_MAX; /* no more workers than supernodes */
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    sl_factor_free(F);
    opt.threads.count = 2; /* nobody to run them: one after the other, or OpenMP */
    opt.threads.run = NULL;
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    assert_same_bits(F, y.F);
    sl_factor_free(F);
    problem_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_do_not_depend_on_their_number),
        cmocka_unit_test(large_fronts_are_shared),
        cmocka_unit_test(the_same_failure_for_any_number),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(senseless_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
