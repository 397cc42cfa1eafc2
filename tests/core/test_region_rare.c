/* test_region_rare.c: regions beside wide subtrees, unknown weights, null pivots, no memory */
#include "tests/lib/check_region.h"

/* With a selected inverse: the subtree of the set would cost less, but the 30 rows below it do not
 * fit into the memory; the two below the next supernode do. A leaf keeps the two apart. */
static void a_subtree_may_be_too_wide(void **state) {
    (void)state;
    enum { SET = 30, LEAF = SET, NEXT = LEAF + 1, TOP = NEXT + 28, BELOW = 2, N = 120 };
    gen_list_t t = gen_list(N);
    sl_options opt = options_none();
    sl_int set[SET];
    sl_selected *all = NULL;
    sl_region *R = NULL;
    sl_stats stats;
    for (sl_int j = 0; j < N; j++) {
        const sl_int end = j == LEAF ? NEXT + 1 : j < TOP ? TOP + BELOW : N;
        gen_add(&t, j, j, 2.0 * N);
        for (sl_int i = j + 1; i < end; i++) {
            if (i != LEAF) {
                gen_add(&t, i, j, 1.0);
            }
        }
    }
    for (sl_int k = 0; k < SET; k++) {
        set[k] = k;
    }
    opt.ordering = SL_ORDERING_NATURAL;
    opt.relaxation = SL_RELAXATION_NONE;
    factored_t y = {gen_store(&t, gen_style(0), 1), NULL, NULL};
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, FOR_ANALYSIS(&opt), NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, NULL, NULL));
    SL_CHECK(sl_selected_create(&all, y.F, NULL, SL_ALL, NULL, NULL));
    opt.region_bytes = SET * SET * sizeof(double) / 2 - 1;
    SL_CHECK(sl_region_create(&R, y.F, set, SET, all, FOR_REGION(&opt), &stats));
    NOTHING_WRONG(check_region(R, set, SET));
    assert_int_equal(stats.region.boundary, BELOW);
    assert_int_equal(stats.region.is_copied, 1);
    sl_region_free(R);
    sl_selected_free(all);
    factored_free(&y);
    gen_list_free(&t);
}

/* A region cannot know the weights outside it, nor what regularization changed there. */
static void unknown_weights_and_shifts_are_refused(void **state) {
    (void)state;
    enum { SIZE = 200 };
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    factored_t y = factored_make(GEN_SINGULAR, SIZE, 1, 0, &opt);
    sl_int n = y.M.view.n_cols, row = n / 2;
    double *mass = test_reals((size_t)n), b = 1.0, x = 7.0;
    sl_factor *F = NULL, *E = NULL;
    sl_region *R = NULL;
    sl_plan *P = NULL;
    for (sl_int k = 0; k < n; k++) {
        mass[k] = 1.0;
    }
    opt.mass = mass;
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_region_create(&R, F, &row, 1, NULL, FOR_REGION(&opt), NULL));
    assert_null(R);
    SL_CHECK(sl_region_create(&R, y.F, &row, 1, NULL, FOR_REGION(&opt), NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_region_refactor(R, F, NULL, NULL));
    sl_region_free(R);
    opt = options_none();
    opt.regularization = 1e-8;
    SL_CHECK(sl_factor_create(&E, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
    SL_CHECK(sl_region_create(&R, E, &row, 1, NULL, NULL, NULL));
    assert_true(sl_region_view(R).n_boundary > 0);
    opt.region = R;
    SL_CHECK(sl_plan_create(&P, y.S, &row, 1, &row, 1, FOR_PLAN(&opt), NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_plan_solve_regularized(P, E, &x, 1, &b, 1, 1, 3, NULL, NULL));
    assert_true(x == 7.0);
    SL_EXPECT(SL_ERR_STALE, sl_plan_solve_regularized(P, y.F, &x, 1, &b, 1, 1, 3, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, E, &x, 1, &b, 1, 1, NULL));
    sl_plan_free(P);
    sl_region_free(R);
    sl_factor_free(F);
    sl_factor_free(E);
    free(mass);
    factored_free(&y);
}

/* Null pivots skipped: a solve in a region gives what the full solve gives, whether the null row is
 * inside or not. */
static void null_pivots_match_the_full_solve(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    uint64_t seed = 4;
    for (int which = 0; which < isas.count; which++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[which];
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        factored_t y = factored_make(GEN_SINGULAR, 400, 1, 0, &opt);
        sl_int n = y.M.view.n_cols, null = -1, nulls = 0;
        double *full = test_reals((size_t)n);
        SL_CHECK(sl_factor_pivot_rows(y.F, SL_PIVOT_NULL, &null, NULL, 1, &nulls));
        assert_int_equal(nulls, 1);
        for (int round = 0; round < 20; round++) {
            sl_int set[60], inside[400];
            double b[400], x[400], sum = 0, largest = 0;
            sl_region *R = NULL;
            sl_plan *P = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            for (sl_int k = 0; k < 60; k++) {
                set[k] = round < 10 ? (20 * round + k) % n : gen_below(&seed, n);
            }
            set[7] = round % 2 ? null : set[7];
            SL_CHECK(sl_region_create(&R, y.F, set, 60, NULL, FOR_REGION(&opt), &stats));
            const sl_int all = region_rows(R, inside);
            gen_reals(b, 400, gen_bits(&seed));
            for (sl_int k = 1; k < all; k++) {
                sum += b[k];
            }
            b[0] = -sum; /* makes the system consistent */
            memset(full, 0, (size_t)n * sizeof *full);
            for (sl_int k = 0; k < all; k++) {
                full[inside[k]] = b[k];
            }
            SL_CHECK(sl_factor_solve(y.F, full, (size_t)n, full, (size_t)n, 1, NULL));
            opt.region = R;
            SL_CHECK(sl_plan_create(&P, y.S, inside, all, inside, all, FOR_PLAN(&opt), &stats));
            assert_int_equal(stats.plan.in_region, 1);
            SL_CHECK(sl_plan_solve(P, y.F, x, (size_t)all, b, (size_t)all, 1, NULL));
            for (sl_int k = 0; k < n; k++) {
                largest = fabs(full[k]) > largest ? fabs(full[k]) : largest;
            }
            /* The terms of u cancel down to x: the entry of the inverse at a vertex beside the null
             * row is about log n, and x is a sum of 400 such entries. */
            for (sl_int k = 0; k < all; k++) {
                assert_true(fabs(x[k] - full[inside[k]]) <= 1e4 * DBL_EPSILON * largest);
                assert_true(inside[k] != null || fabs(x[k]) < 1e-300);
            }
            sl_plan_free(P);
            sl_region_free(R);
        }
        free(full);
        factored_free(&y);
    }
}

/* With pivots of both signs, what is lost on the way to the boundary takes memory, too. */
static void memory_may_end_with_both_signs(void **state) {
    (void)state;
    enum { SET = 160 };
    factored_t y = factored_make(GEN_GRID2, 2500, 0, 0, NULL);
    const sl_int n = y.M.view.n_cols, *perm = sl_symbolic_view(y.S).perm;
    sl_int set[SET], failures[2] = {0, 0};
    sl_stats stats;
    for (sl_int k = 0; k < SET; k++) { /* neighbors far from the root, in two places */
        set[k] = perm[k < SET / 2 ? k : n / 2 + k];
    }
    for (int again = 0; again < 2; again++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t c = counter_make();
            const sl_options opt = options_counted(&c);
            sl_region *R = NULL;
            c.fail_at = again ? -1 : k;
            status = sl_region_create(&R, y.F, set, SET, NULL, &opt, &stats);
            if (again) {
                SL_CHECK(status);
                c.fail_at = (int64_t)c.calls + k;
                status = sl_region_refactor(R, y.F, NULL, NULL);
            }
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            assert_true(again || (R != NULL) == (status == SL_OK));
            failures[again] += status != SL_OK;
            c.fail_at = -1;
            if (R != NULL && status != SL_OK) {
                SL_CHECK(sl_region_refactor(R, y.F, NULL, NULL));
            }
            if (R != NULL) {
                NOTHING_WRONG(check_region(R, set, SET));
            }
            sl_region_free(R);
            COUNTER_CLEAN(&c);
        }
        assert_true(failures[again] > 0 && stats.region.subtrees > 1);
    }
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_subtree_may_be_too_wide),
        cmocka_unit_test(null_pivots_match_the_full_solve),
        cmocka_unit_test(unknown_weights_and_shifts_are_refused),
        cmocka_unit_test(memory_may_end_with_both_signs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
