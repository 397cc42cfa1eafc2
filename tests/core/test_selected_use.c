/* test_selected_use.c: life of a selected inverse: refactored, empty, failures */
#include "tests/lib/factored.h"

/* The object keeps its values when the factor is refactored, fails, or is freed. */
static void values_outlive_the_factor(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 225, 1, 0, NULL);
    double before[225], after[225], again[225];
    sl_selected *Z = NULL, *none = (sl_selected *)(void *)before;
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_selected_entries(Z, before, NULL, NULL, SL_ALL, NULL));
    for (sl_int p = 0; p < y.M.p[225]; p++) {
        y.M.x[p] *= 4.0;
    }
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_CHECK(sl_selected_entries(Z, after, NULL, NULL, SL_ALL, NULL));
    SAME_VALUES(before, after, 225);
    SL_CHECK(sl_selected_refactor(Z, y.F, NULL));
    SL_CHECK(sl_selected_entries(Z, again, NULL, NULL, SL_ALL, NULL));
    sl_selected_free(Z);
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_selected_entries(Z, after, NULL, NULL, SL_ALL, NULL));
    SAME_VALUES(again, after, 225);
    /* Exact: a power of two. */
    for (int k = 0; k < 225; k++) {
        assert_true(again[k] == before[k] / 4.0);
    }
    y.M.x[3] = NAN;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_selected_create(&none, y.F, NULL, SL_ALL, NULL, NULL));
    assert_null(none);
    SL_EXPECT(SL_ERR_STALE, sl_selected_refactor(Z, y.F, NULL));
    sl_factor_free(y.F);
    y.F = NULL;
    SL_CHECK(sl_selected_entries(Z, after, NULL, NULL, SL_ALL, NULL));
    SAME_VALUES(again, after, 225);
    sl_selected_free(Z);
    factored_free(&y);
}

static void empty_problems_work(void **state) {
    (void)state;
    const sl_int no_rows[1] = {0};
    for (int kind = GEN_NONE; kind <= GEN_ONE; kind++) {
        factored_t y = factored_make((gen_kind_t)kind, 1, 1, 0, NULL);
        for (int whole = 0; whole < 2; whole++) {
            sl_selected *Z = NULL;
            sl_stats stats;
            double out[1] = {5.0};
            memset(&stats, 0, sizeof stats);
            SL_CHECK(sl_selected_create(&Z, y.F, whole ? NULL : no_rows, whole ? SL_ALL : 0, NULL,
                                        &stats));
            assert_int_equal(stats.selected.columns, whole ? kind : 0);
            SL_CHECK(sl_selected_entries(Z, NULL, no_rows, NULL, 0, NULL));
            SL_CHECK(sl_selected_entries(Z, NULL, no_rows, no_rows, 0, NULL));
            if (kind == GEN_NONE) {
                SL_CHECK(sl_selected_entries(Z, NULL, NULL, NULL, SL_ALL, NULL));
                assert_int_equal(sl_selected_view(Z).count, 0);
            } else {
                SL_EXPECT(whole ? SL_OK : SL_ERR_OTHER_PATTERN,
                          sl_selected_entries(Z, out, NULL, NULL, SL_ALL, &stats));
                assert_true(out[0] == (whole ? 1.0 / sl_factor_view(y.F).D[0] : 5.0));
            }
            sl_selected_free(Z);
        }
        factored_free(&y);
    }
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_PATH, 20, 1, 0, NULL),
               other = factored_make(GEN_PATH, 20, 1, 0, NULL);
    const sl_int below[3] = {7, -1, 4}, above[3] = {7, 8, 20}, fine[3] = {7, 8, 7},
                 far[3] = {7, 8, 19};
    sl_options incomplete = options_none();
    double out[20];
    sl_selected *Z = NULL, *none = (sl_selected *)(void *)out;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    incomplete.allocator.release = counter_release;
    out[0] = 5.0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(NULL, y.F, NULL, SL_ALL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, NULL, NULL, SL_ALL, NULL, NULL));
    assert_null(none);
    none = (sl_selected *)(void *)out;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, y.F, fine, -1, NULL, NULL));
    assert_null(none);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, y.F, NULL, SL_ALL, &incomplete, NULL));
    none = (sl_selected *)(void *)out;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, y.F, below, 3, NULL, &stats));
    assert_null(none);
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, y.F, above, 3, NULL, &stats));
    assert_int_equal(stats.error.row, 20);
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(NULL, out, fine, NULL, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, NULL, fine, NULL, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, NULL, NULL, NULL, SL_ALL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, fine, NULL, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, above, NULL, 3, &stats));
    assert_int_equal(stats.error.row, 20);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(NULL, out, fine, fine, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, NULL, fine, fine, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, NULL, fine, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, NULL, fine, 0, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, fine, fine, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, fine, above, 3, &stats));
    assert_int_equal(stats.error.row, 7);
    assert_int_equal(stats.error.column, 20);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, below, fine, 3, &stats));
    assert_int_equal(stats.error.row, -1);
    /* A path has no fill that far from the diagonal. */
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_selected_entries(Z, out, fine, far, 3, &stats));
    assert_int_equal(stats.error.row, 7);
    assert_int_equal(stats.error.column, 19);
    assert_true(out[0] == 5.0);
    SL_CHECK(sl_selected_entries(Z, out, fine, fine, 3, &stats));
    assert_int_equal(stats.error.row, -1);
    assert_null(sl_selected_view(NULL).Z);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_refactor(NULL, y.F, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_refactor(Z, NULL, NULL));
    /* another analysis, although of the same pattern */
    SL_EXPECT(SL_ERR_MISMATCH, sl_selected_refactor(Z, other.F, NULL));
    factored_free(&other);
    sl_selected_free(Z);
    sl_selected_free(NULL);
    factored_free(&y);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    const sl_int set[3] = {17, 380, 200};
    for (int whole = 0; whole < 2; whole++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            sl_selected *Z = (sl_selected *)(void *)&counter;
            counter.fail_at = k;
            status =
                sl_selected_create(&Z, y.F, whole ? NULL : set, whole ? SL_ALL : 3, &opt, NULL);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
            assert_true((Z != NULL) == (status == SL_OK));
            if (Z) {
                sl_work *W = NULL;
                counter.fail_at = (int64_t)counter.calls;
                /* Z keeps its values, as the queries below confirm. */
                SL_EXPECT(SL_ERR_MEMORY, sl_selected_refactor(Z, y.F, NULL));
                SL_CHECK(sl_work_create(&W, &opt));
                counter.fail_at = (int64_t)counter.calls;
                SL_EXPECT(SL_ERR_MEMORY, sl_selected_refactor(Z, y.F, W));
                SL_CHECK(sl_selected_refactor(Z, y.F, W));
                size_t grown = counter.calls;
                SL_CHECK(sl_selected_refactor(Z, y.F, W));
                assert_int_equal(counter.calls, grown);
                sl_work_free(W);
            }
            if (Z) { /* Memory that was never written would show as NaN. */
                double d[3];
                size_t calls = counter.calls;
                SL_CHECK(sl_selected_entries(Z, d, set, NULL, 3, NULL));
                assert_true(d[0] > 0.0 && d[1] > 0.0 && d[2] > 0.0);
                assert_int_equal(counter.calls, calls);
            }
            sl_selected_free(Z);
            COUNTER_CLEAN(&counter);
            assert_in_range(k, 0, 100);
        }
    }
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_outlive_the_factor),
        cmocka_unit_test(empty_problems_work),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
