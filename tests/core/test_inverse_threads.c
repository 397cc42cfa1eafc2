/* test_inverse_threads.c: the selected inverse and the diagonal with threads: bits and memory */
#define _POSIX_C_SOURCE 200112L /* nanosleep */
#include "tests/lib/pools.h"
#include "tests/lib/check_inverse.h"
#include "tests/lib/grid_constraints.h"

static sl_options options_threads(int run, sl_int count, int *calls) {
    sl_options opt = options_none();
    opt.method = SL_METHOD_SUPERNODAL;
    opt.threads.count = count;
    opt.threads.run = runs[run];
    opt.threads.context = calls;
    return opt;
}

static void assert_same_panels(const sl_selected *Z, const sl_selected *Y) {
    sl_selected_arrays z = sl_selected_view(Z), y = sl_selected_view(Y);
    assert_int_equal(z.count, y.count);
    /* values above the diagonal of a tile are arbitrary, but computed in the same way */
    if (z.count > 0) {
        sl_symbolic_arrays v = sl_symbolic_view(z.symbolic);
        for (sl_int k = 0; k < z.count; k++) {
            sl_int s = z.supers[k], width = ref_width(&v, s), height = ref_height(&v, s);
            assert_int_equal(s, y.supers[k]);
            for (sl_int c = 0; c < width; c++) {
                for (sl_int q = c; q < height; q++) {
                    sl_off at = z.begin[k] + ref_position(width, q, c);
                    assert_true(z.Z[at] == y.Z[at]);
                }
            }
        }
    }
}

/* With the threads of the options and with those that the factor keeps; created and refactored; all
 * supernodes and the reach of a set. */
static void assert_same_bits_for_all_threads(gen_kind_t kind, sl_int size, sl_isa isa) {
    sl_options opt = options_none();
    uint64_t seed = 17;
    opt.isa = isa;
    opt.method = SL_METHOD_SUPERNODAL;
    factored_t y = factored_make(kind, size, 0, 0, &opt);
    sl_int n = y.M.view.n_cols, half = (n + 1) / 2, *set = test_ints((size_t)n);
    double *one = test_reals((size_t)n), *many = test_reals((size_t)n);
    gen_set(set, half, n, gen_bits(&seed));
    for (int is_full = 0; is_full < 2; is_full++) {
        sl_selected *Z = NULL;
        SL_CHECK(
            sl_selected_create(&Z, y.F, is_full ? NULL : set, is_full ? SL_ALL : half, NULL, NULL));
        SL_CHECK(sl_inverse_diagonal(y.F, one, is_full ? NULL : set, is_full ? SL_ALL : half, NULL,
                                     NULL));
        for (int run = 0; run < RUNS; run++) {
            for (sl_int count = 1; count <= 4; count++) {
                int calls = 0;
                sl_factor *F = NULL;
                sl_selected *own = NULL, *factors = NULL;
                sl_work *W = NULL;
                opt = options_threads(run, count, &calls);
                opt.isa = isa;
                SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
                SL_CHECK(sl_work_create(&W, NULL));
                calls = 0;
                SL_CHECK(sl_selected_create(&own, y.F, is_full ? NULL : set,
                                            is_full ? SL_ALL : half, FOR_OTHERS(&opt), NULL));
                /* one parallel call */
                assert_int_equal(calls, count > 1 && sl_selected_view(own).count > 1);
                assert_same_panels(own, Z);
                SL_CHECK(sl_selected_create(&factors, F, is_full ? NULL : set,
                                            is_full ? SL_ALL : half, NULL, NULL));
                SL_CHECK(sl_selected_refactor(factors, F, W));
                assert_same_panels(factors, Z);
                SL_CHECK(sl_inverse_diagonal(F, many, is_full ? NULL : set, is_full ? SL_ALL : half,
                                             W, NULL));
                SAME_VALUES(one, many, (size_t)(is_full ? n : half));
                sl_work_free(W);
                sl_selected_free(own);
                sl_selected_free(factors);
                sl_factor_free(F);
            }
        }
        sl_selected_free(Z);
    }
    free(set);
    free(one);
    free(many);
    factored_free(&y);
}

static void bits_do_not_depend_on_the_number_of_threads(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int kind = 0; kind < GEN_REGULAR; kind++) {
            assert_same_bits_for_all_threads((gen_kind_t)kind, 200, isas.isa[k]);
        }
    }
}

/* Fronts above SLI_SHARED_FLOPS are divided among threads, in 7 loops or more for each front. The
 * separators of a 3D grid have such fronts, and their rows below share a tile with their
 * columns. */
static void large_fronts_are_divided_among_threads(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        assert_same_bits_for_all_threads(GEN_GRID3, 15 * 15 * 15, isas.isa[k]);
    }
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    const sl_int set[3] = {17, 380, 200};
    for (int is_full = 0; is_full < 2; is_full++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t counter = counter_make();
            int calls = 0;
            sl_options opt = options_threads(1, 3, &calls);
            sl_selected *Z = (sl_selected *)(void *)&counter;
            opt.allocator = options_counted(&counter).allocator;
            counter.fail_at = k;
            status = sl_selected_create(&Z, y.F, is_full ? NULL : set, is_full ? SL_ALL : 3,
                                        FOR_OTHERS(&opt), NULL);
            assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
            assert_true((Z != NULL) == (status == SL_OK));
            sl_selected_free(Z);
            COUNTER_CLEAN(&counter);
            assert_in_range(k, 0, 100);
        }
    }
    factored_free(&y);
}

static void extreme_numbers_of_threads_are_handled(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    int calls = 0;
    sl_selected *Z = NULL, *one = NULL;
    sl_options opt = options_threads(1, -1, &calls);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&Z, y.F, NULL, SL_ALL, FOR_OTHERS(&opt), NULL));
    opt.threads.count = INT32_MAX; /* more workers than supernodes */
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, FOR_OTHERS(&opt), NULL));
    SL_CHECK(sl_selected_create(&one, y.F, NULL, SL_ALL, NULL, NULL));
    assert_same_panels(Z, one);
    sl_selected_free(Z);
    opt.threads.count = 2;
    opt.threads.run = NULL;
    SL_EXPECT(WITHOUT_POOL, sl_selected_create(&Z, y.F, NULL, SL_ALL, FOR_OTHERS(&opt), NULL));
    if (Z != NULL) {
        assert_same_panels(Z, one);
    }
    sl_selected_free(Z);
    sl_selected_free(one);
    factored_free(&y);
}

/* Columns that are solved for, because selected inversion would lose digits. */
static void solved_columns_have_the_same_bits(void **state) {
    (void)state;
    sl_stats stats;
    factored_t y = grid_factored(1e-8, SHIFT_DIAGONAL, options_none(), &stats);
    sl_selected *Z = NULL;
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, NULL));
    for (int run = 0; run < RUNS; run++) {
        for (sl_int count = 1; count <= 4; count++) {
            int calls = 0;
            sl_selected *many = NULL;
            const sl_options opt = options_threads(run, count, &calls);
            SL_CHECK(sl_selected_create(&many, y.F, NULL, SL_ALL, FOR_OTHERS(&opt), NULL));
            assert_int_equal(calls, count > 1);
            assert_same_panels(Z, many);
            SL_CHECK(sl_selected_refactor(many, y.F, NULL));
            assert_same_panels(Z, many);
            sl_selected_free(many);
        }
    }
    sl_selected_free(Z);
    factored_free(&y);
}

/* The diagonal and single entries by sweeps, because selected inversion would lose digits. */
static void swept_entries_have_the_same_bits(void **state) {
    (void)state;
    sl_stats one, many;
    factored_t y = grid_factored(1e-8, SHIFT_DIAGONAL, options_none(), &one);
    const sl_int n = y.M.view.n_cols, rows[3] = {0, n - 1, n / 2}, columns[3] = {n / 3, 1, 7};
    double *z = test_reals((size_t)n), *same = test_reals((size_t)n), pairs[2][3];
    SL_CHECK(sl_inverse_diagonal(y.F, z, NULL, SL_ALL, NULL, &one));
    SL_CHECK(sl_inverse_pairs(y.F, pairs[0], rows, columns, 3, NULL, NULL));
    for (int run = 0; run < RUNS; run++) {
        for (sl_int count = 1; count <= 4; count++) {
            int calls = 0;
            sl_factor *F = NULL;
            const sl_options opt = options_threads(run, count, &calls);
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
            calls = 0;
            SL_CHECK(sl_inverse_diagonal(F, same, NULL, SL_ALL, NULL, &many));
            assert_int_equal(calls, count > 1);
            SAME_VALUES(z, same, (size_t)n);
            assert_memory_equal(&one.inverse, &many.inverse, sizeof one.inverse);
            SL_CHECK(sl_inverse_pairs(F, pairs[1], rows, columns, 3, NULL, NULL));
            SAME_VALUES(pairs[0], pairs[1], 3);
            sl_factor_free(F);
        }
    }
    free(z);
    free(same);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_do_not_depend_on_the_number_of_threads),
        cmocka_unit_test(large_fronts_are_divided_among_threads),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(extreme_numbers_of_threads_are_handled),
        cmocka_unit_test(swept_entries_have_the_same_bits),
        cmocka_unit_test(solved_columns_have_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
