/* test_stats.c: statistics: times of each step, groups filled again, groups left unchanged */
#include "tests/lib/factored.h"

#include <time.h>

/* ---- times ---- */

/* The times that the steps report from an analysis to a region, and processor seconds measured
 * around each call. */
typedef struct run_t {
    sl_stats stats;
    double analyze, factor, selected, region;
} run_t;

static double seconds(void) {
    return (double)clock() / (double)CLOCKS_PER_SEC;
}

static run_t run(gen_kind_t kind, sl_int size, sl_ordering ordering) {
    gen_list_t t = gen_make(kind, size, 1, 42);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    const sl_int set[3] = {0, M.view.n_cols / 2, M.view.n_cols - 1};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_selected *Z = NULL;
    sl_region *R = NULL;
    run_t r;
    memset(&r, 0xFF, sizeof r); /* every double is a NaN */
    opt.ordering = ordering;
    r.analyze = -seconds();
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &r.stats));
    r.analyze += seconds();
    r.factor = -seconds();
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, &r.stats));
    r.factor += seconds();
    r.selected = -seconds();
    SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, NULL, &r.stats));
    r.selected += seconds();
    r.region = -seconds();
    SL_CHECK(sl_region_create(&R, F, set, 3, NULL, NULL, &r.stats));
    r.region += seconds();
    sl_region_free(R);
    sl_selected_free(Z);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    return r;
}

/* Rounding of a sum of differences of a clock. */
#define ROUNDING 1e-9

/* NaN fails too: a field that is not set stays one. */
static void assert_within(double part, double whole, const char *what) {
    if (!(part >= 0 && part <= whole + ROUNDING)) {
        print_error("%s: %.9g, of %.9g\n", what, part, whole);
        fail();
    }
}

static void check_times(const run_t *r) {
    const sl_symbolic_info *s = &r->stats.symbolic;
    const sl_factor_info *f = &r->stats.factor;
    assert_within(s->seconds_order, r->analyze, "order");
    assert_within(s->seconds_analyze, r->analyze, "analyze");
    assert_within(s->seconds_order + s->seconds_analyze, r->analyze, "order and analyze");
    assert_within(s->seconds_tree, s->seconds_analyze, "tree");
    assert_within(s->seconds_structure, s->seconds_analyze, "structure");
    assert_within(s->seconds_tree + s->seconds_structure, s->seconds_analyze, "both");
    assert_within(f->seconds_setup, r->factor, "setup");
    assert_within(f->seconds, r->factor, "numbers");
    assert_within(f->seconds_setup + f->seconds, r->factor, "setup and numbers");
    assert_within(r->stats.selected.seconds, r->selected, "selected");
    assert_within(r->stats.region.seconds, r->region, "region");
}

static void parts_are_at_most_the_whole(void **state) {
    (void)state;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        const run_t r = run((gen_kind_t)kind, 200, SL_ORDERING_ND);
        check_times(&r);
    }
}

/* The larger grid has 400 times the rows. Each step must report more than twice the processor time
 * of the small one, a margin that no load of the machine uses up. */
static void times_grow_with_work(void **state) {
    (void)state;
    const run_t small = run(GEN_GRID2, 100, SL_ORDERING_ND);
    const run_t large = run(GEN_GRID2, 40000, SL_ORDERING_ND);
    const struct {
        const char *name;
        double small, large;
    } times[] = {
        {"order", small.stats.symbolic.seconds_order, large.stats.symbolic.seconds_order},
        {"analyze", small.stats.symbolic.seconds_analyze, large.stats.symbolic.seconds_analyze},
        {"tree", small.stats.symbolic.seconds_tree, large.stats.symbolic.seconds_tree},
        {"structure", small.stats.symbolic.seconds_structure,
         large.stats.symbolic.seconds_structure},
        {"numbers", small.stats.factor.seconds, large.stats.factor.seconds},
        {"selected", small.stats.selected.seconds, large.stats.selected.seconds},
    };
    check_times(&small);
    check_times(&large);
    for (size_t k = 0; k < sizeof times / sizeof times[0]; k++) {
        if (!(times[k].large > 2 * times[k].small)) {
            print_error("%s: %.9g s for 100 rows, %.9g s for 40000\n", times[k].name,
                        times[k].small, times[k].large);
            fail();
        }
    }
}

/* ---- groups ---- */

/* The object reports what the call that made it did. */
static void groups_are_filled_again(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 900, 1, 0, NULL);
    const sl_int set[3] = {5, 77, 300};
    for (int whole = 0; whole < 2; whole++) {
        sl_selected *Z = NULL;
        sl_stats made, again;
        memset(&made, 0, sizeof made);
        memset(&again, 0xFF, sizeof again);
        SL_CHECK(sl_selected_create(&Z, y.F, whole ? NULL : set, whole ? SL_ALL : 3, NULL, &made));
        again.selected = sl_selected_view(Z).info;
        assert_true(made.selected.entries > 0 && made.selected.bytes > 0);
        assert_int_equal(again.selected.supernodes, made.selected.supernodes);
        assert_int_equal(again.selected.columns, made.selected.columns);
        assert_int_equal(again.selected.entries, made.selected.entries);
        assert_int_equal(again.selected.bytes, made.selected.bytes);
        assert_true(again.selected.seconds == made.selected.seconds);
        /* after a refactorization: its time, the same sizes */
        SL_CHECK(sl_selected_refactor(Z, y.F, NULL));
        again.selected = sl_selected_view(Z).info;
        assert_true(again.selected.seconds >= 0);
        assert_int_equal(again.selected.entries, made.selected.entries);
        assert_int_equal(again.selected.bytes, made.selected.bytes);
        sl_selected_free(Z);
    }
    assert_int_equal(sl_selected_view(NULL).info.columns, 0);
    factored_free(&y);
}

/* Inverse calls fill their own group and nothing else. */
static void inverse_calls_have_a_group(void **state) {
    (void)state;
    enum { ROWS = 2 };
    factored_t y = factored_make(GEN_GRID2, 900, 1, 0, NULL);
    const sl_symbolic_arrays v = sl_symbolic_view(y.S);
    const sl_int rows[ROWS] = {5, 877}, columns[ROWS] = {300, 6};
    double out[900];
    for (int call = 0; call < 4; call++) {
        sl_stats stats;
        memset(&stats, 0xFF, sizeof stats);
        switch (call) {
        case 0:
            SL_CHECK(sl_inverse_diagonal(y.F, out, NULL, SL_ALL, NULL, &stats));
            break;
        case 1:
            SL_CHECK(sl_inverse_diagonal(y.F, out, rows, ROWS, NULL, &stats));
            break;
        case 2:
            SL_CHECK(sl_inverse_pairs(y.F, out, rows, columns, ROWS, NULL, &stats));
            break;
        default:
            SL_CHECK(sl_inverse_block(y.F, out, ROWS, rows, ROWS, columns, ROWS, NULL, &stats));
        }
        assert_int_equal(stats.inverse.method,
                         call == 0 ? SL_INVERSE_SELECTED : SL_INVERSE_FORWARD);
        assert_true(stats.inverse.supernodes > 0 && stats.inverse.columns > 0);
        assert_true((stats.inverse.entries > 0) == (call > 0));
        if (call == 0) {
            assert_int_equal(stats.inverse.supernodes, v.n_supers);
            assert_int_equal(stats.inverse.columns, v.n);
        }
        assert_int_equal(stats.plan.b_entries, -1);
        assert_int_equal(stats.plan.x_columns, -1);
        assert_int_equal(stats.selected.columns, -1);
        assert_int_equal(stats.selected.entries, -1);
        /* nothing requested */
        SL_CHECK(sl_inverse_pairs(y.F, out, rows, columns, 0, NULL, &stats));
        assert_int_equal(stats.inverse.method, SL_INVERSE_NONE);
        assert_int_equal(stats.inverse.columns, 0);
    }
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_at_most_the_whole),
        cmocka_unit_test(times_grow_with_work),
        cmocka_unit_test(groups_are_filled_again),
        cmocka_unit_test(inverse_calls_have_a_group),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
