/* test_bounds_use.c: certified factors: refusals, lifetimes, saved files, memory */
#include "tests/lib/saved.h"
#include "tests/lib/zero_mean.h"

static sl_status solve_bounded(const sl_plan *P, const sl_factor *F, sl_stats *stats) {
    double x[2], bounds[2], b = 1.0;
    return sl_plan_solve_bounded(P, F, x, 2, bounds, &b, 1, 1, NULL, NULL, stats);
}

static void bounds_are_those_of_the_numbers(void **state) {
    (void)state;
    static const sl_int bset[1] = {7}, xset[2] = {30, 7};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    sl_factor *F = y.F;
    sl_plan *P = NULL;
    sl_stats stats;
    SL_CHECK(sl_plan_create(&P, y.S, bset, 1, xset, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, solve_bounded(P, F, NULL));
    for (int certainty = SL_ESTIMATED; certainty <= SL_GUARANTEED; certainty++) {
        SL_CHECK(sl_factor_certify(F, &y.M.view, (sl_certainty)certainty, NULL, &stats));
        assert_true(stats.certificate.solves > 0);
        assert_true((stats.certificate.eigenvalue_min > 0.0) == (certainty == SL_GUARANTEED));
        const double eta = stats.certificate.eta;
        SL_CHECK(solve_bounded(P, F, &stats));
        assert_int_equal(stats.certificate.certainty, certainty);
        assert_true(stats.certificate.eta == eta);
        /* other numbers: the factor is not certified any more, even with the same values */
        SL_CHECK(sl_factor_refactor(F, &y.M.view, NULL));
        SL_EXPECT(SL_ERR_STALE, solve_bounded(P, F, NULL));
        SL_CHECK(sl_factor_certify(F, &y.M.view, (sl_certainty)certainty, NULL, NULL));
        double w = 0.1;
        static const sl_int column[2] = {0, 1}, row[1] = {7};
        const sl_csc v = {100, 1, column, row, &w};
        SL_CHECK(sl_factor_rank_update(F, &v, NULL, NULL, NULL));
        SL_EXPECT(SL_ERR_STALE, solve_bounded(P, F, NULL));
        SL_CHECK(sl_factor_refactor(F, &y.M.view, NULL));
    }
    sl_plan_free(P);
    factored_free(&y);
}

/* A factor of 2 A is not one of A: every solve is off by half. */
static void other_values_are_noticed(void **state) {
    (void)state;
    static const sl_int bset[1] = {7}, xset[2] = {30, 7};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    sl_plan *P = NULL;
    sl_stats stats;
    SL_CHECK(sl_plan_create(&P, y.S, bset, 1, xset, 2, NULL, NULL));
    SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
    for (sl_int k = 0; k < y.M.view.p[100]; k++) {
        y.M.x[k] *= 2.0;
    }
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, &stats));
    assert_true(stats.certificate.eta > 1.0);
    SL_EXPECT(SL_ERR_STALE, solve_bounded(P, y.F, NULL));
    SL_EXPECT(SL_ERR_MISMATCH, sl_factor_certify(y.F, &y.M.view, SL_GUARANTEED, NULL, NULL));
    y.M.x[0] = -1.0; /* not definite */
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
    y.M.x[0] = (double)NAN;
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
    sl_plan_free(P);
    factored_free(&y);
}

static void what_has_no_bound_is_refused(void **state) {
    (void)state;
    static const int ways[2] = {SAVED_PIVOTED, SAVED_DEFINITE};
    for (int m = 0; m < 2; m++) { /* the last one: negative pivots */
        sl_options from = options_none();
        saved_case_t c = saved_case_make(ways[m], m == 1 ? GEN_KKT : GEN_GRID2, 60, 0, &from);
        SL_EXPECT(SL_ERR_UNSUPPORTED,
                  sl_factor_certify(c.y.F, &c.y.M.view, SL_ESTIMATED, NULL, NULL));
        saved_case_free(&c);
    }
    /* weights, and null vectors that are not known, or several */
    for (int m = 0; m < 2; m++) {
        sl_int components = 0;
        gen_matrix_t M = laplacian(GEN_GRID2, 60, 0, &components);
        const size_t n = (size_t)M.view.n_cols;
        double *mass = weights((sl_int)n, 3), *Z = test_reals(2 * n);
        sl_options opt = options_none();
        sl_stats stats;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = mass;
        opt.null_vector = Z;
        opt.null_vector_count = m == 0 ? 1 : 2;
        for (size_t i = 0; i < n; i++) {
            Z[i + (m ? n : 0)] = m ? 1.0 : 0.0;
        }
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_certify(F, &M.view, SL_ESTIMATED, NULL, &stats));
        assert_non_null(strstr(stats.error.what, m ? "leave out options.mass" : "null_vector"));
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(mass);
        free(Z);
    }
    /* guaranteed: L in float, duplicates, magnitudes near overflow, eigenvalues within rounding */
    for (int what = 0; what < 4; what++) {
        gen_list_t t = gen_make(GEN_GRID2, 64, 1, 3);
        sl_options opt = options_none();
        for (size_t e = 0; e < t.count; e++) {
            t.x[e] *= what == 2 ? 1e210 : 1.0;
        }
        if (what == 1) {
            gen_add(&t, 1, 1, 0.5);
        }
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        opt.storage = what == 0 ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        if (what == 3) {
            gen_matrix_free(&M);
            sl_factor_free(F);
            sl_symbolic_free(S);
            M = gen_matrix(GEN_SINGULAR, 49, 1, 3);
            M.x[0] += 1e-13;
            SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
            opt.null_tolerance = -1.0;
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        }
        SL_EXPECT(what == 3 ? SL_ERR_INACCURATE : SL_ERR_UNSUPPORTED,
                  sl_factor_certify(F, &M.view, SL_GUARANTEED, NULL, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* Two springs and a weak one between them, which the diagonal has rounded away: A without the null
 * row is singular, and no probe sees how wrong the pivot is that is kept. */
static void weak_pivots_have_no_bounds(void **state) {
    (void)state;
    static const sl_int column[5] = {0, 2, 4, 6, 7}, row[7] = {0, 1, 1, 2, 2, 3, 3};
    static const double values[7] = {77.0, -77.0, 77.0, -4e-15, 0.125 + 4e-15, -0.125, 0.125};
    const sl_csc A = {4, 4, column, row, values};
    sl_options opt = options_none(), natural = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    natural.ordering = SL_ORDERING_NATURAL;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_CHECK(sl_symbolic_create(&S, &A, &natural, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.weak, 1);
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_certify(F, &A, SL_ESTIMATED, NULL, &stats));
    assert_non_null(strstr(stats.error.what, "weak"));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void wrong_arguments(void **state) {
    (void)state;
    static const sl_int bset[1] = {7}, xset[2] = {30, 7};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    double x[2], bounds[2], b = 1.0;
    sl_plan *P = NULL;
    sl_csc other = y.M.view;
    other.n_rows = other.n_cols = 99;
    SL_CHECK(sl_plan_create(&P, y.S, bset, 1, xset, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_certify(NULL, &y.M.view, SL_ESTIMATED, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_certify(y.F, NULL, SL_ESTIMATED, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_certify(y.F, &y.M.view, SL_UNCERTIFIED, NULL, NULL));
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_certify(y.F, &other, SL_ESTIMATED, NULL, NULL));
    SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
    SL_CHECK(solve_bounded(P, y.F, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_certify(y.F, &y.M.view, (sl_certainty)9, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, solve_bounded(P, y.F, NULL)); /* after an error there is no eta */
    SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
#define BOUNDED(P, F, X, ldx, E, B, nrhs) \
    sl_plan_solve_bounded(P, F, X, ldx, E, B, 1, nrhs, NULL, NULL, NULL)
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(NULL, y.F, x, 2, bounds, &b, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(P, NULL, x, 2, bounds, &b, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(P, y.F, NULL, 2, bounds, &b, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(P, y.F, x, 1, bounds, &b, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(P, y.F, x, 2, NULL, &b, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(P, y.F, x, 2, x, &b, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(P, y.F, x, 2, &b, &b, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(P, y.F, x, 2, bounds, NULL, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, BOUNDED(P, y.F, x, 2, bounds, &b, -1));
    SL_CHECK(BOUNDED(P, y.F, NULL, 2, NULL, NULL, 0));
#undef BOUNDED
    /* a failed factor, and a plan in a region */
    sl_options opt = options_none();
    sl_region *R = NULL;
    SL_CHECK(sl_region_create(&R, y.F, xset, 2, NULL, NULL, NULL));
    opt.region = R;
    sl_plan *inside = NULL;
    SL_CHECK(sl_plan_create(&inside, y.S, bset, 1, xset, 2, &opt, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, solve_bounded(inside, y.F, NULL));
    sl_plan_free(inside);
    sl_region_free(R);
    for (sl_int k = 0; k < y.M.view.p[100]; k++) {
        y.M.x[k] = 0.0;
    }
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, solve_bounded(P, y.F, NULL));
    sl_plan_free(P);
    factored_free(&y);
    y = factored_make(GEN_NONE, 0, 1, 0, NULL);
    SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
    SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_GUARANTEED, NULL, NULL));
    factored_free(&y);
}

/* Inconsistent right-hand sides are refused as in other solves, before anything is written. */
static void inconsistent_right_hand_sides(void **state) {
    (void)state;
    static const sl_int bset[2] = {1, 40};
    sl_int components = 0;
    gen_matrix_t M = laplacian(GEN_GRID2, 100, 0, &components);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    double x[2] = {5.0, 5.0}, bounds[2];
    static const double good[2] = {1.0, -1.0}, bad[2] = {1.0, 1.0};
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    SL_CHECK(sl_factor_certify(F, &M.view, SL_ESTIMATED, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, S, bset, 2, bset, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_INCONSISTENT,
              sl_plan_solve_bounded(P, F, x, 2, bounds, bad, 2, 1, NULL, NULL, NULL));
    assert_true(x[0] == 5.0 && x[1] == 5.0);
    SL_CHECK(sl_plan_solve_bounded(P, F, x, 2, bounds, good, 2, 1, NULL, NULL, NULL));
    print_message("x = %g, %g; bounds %.1e, %.1e\n", x[0], x[1], bounds[0], bounds[1]);
    assert_true(bounds[0] < 1e-11 * fabs(x[0]) && bounds[1] < 1e-11 * fabs(x[1]));
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

static void saved_factors_keep_their_certificate(void **state) {
    (void)state;
    static const sl_int bset[1] = {7}, xset[2] = {30, 7};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    saved_t plain = saved_make(y.S, y.F);
    SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_GUARANTEED, NULL, NULL));
    saved_t m = saved_make(y.S, y.F);
    for (int is_mapped = 0; is_mapped < 2; is_mapped++) {
        saved_call_t call = is_mapped ? pair_map_memory : pair_load_memory;
        for (int is_plain = 0; is_plain < 2; is_plain++) {
            const saved_t *from = is_plain ? &plain : &m;
            sl_symbolic *S = NULL;
            sl_factor *F = NULL;
            sl_plan *P = NULL;
            sl_stats stats, own;
            SL_CHECK(call(&S, &F, from->bytes, from->size, SL_LOAD_VERIFIED, NULL));
            SL_CHECK(sl_plan_create(&P, S, bset, 1, xset, 2, NULL, NULL));
            if (is_plain) {
                SL_EXPECT(SL_ERR_STALE, solve_bounded(P, F, NULL));
            } else {
                SL_CHECK(solve_bounded(P, F, &stats));
                assert_int_equal(stats.certificate.certainty, SL_GUARANTEED);
            }
            SL_CHECK(sl_factor_certify(F, &y.M.view, SL_GUARANTEED, NULL, &own));
            SL_CHECK(solve_bounded(P, F, &stats));
            assert_true(stats.certificate.eta == own.certificate.eta);
            sl_plan_free(P);
            sl_factor_free(F);
            sl_symbolic_free(S);
        }
    }
    saved_free(&m);
    saved_free(&plain);
    factored_free(&y);
}

/* Each allocation fails in turn: nothing leaks, and a retry succeeds. */
static void memory_may_run_out(void **state) {
    (void)state;
    static const sl_int bset[1] = {7}, xset[2] = {30, 7};
    for (int certainty = SL_ESTIMATED; certainty <= SL_GUARANTEED; certainty++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            factored_t y = factored_make(GEN_GRID2, 100, 1, 0, &opt);
            sl_plan *P = NULL;
            double x[2], bounds[2], b = 1.0;
            counter.fail_at = (int64_t)counter.calls + k;
            status = sl_factor_certify(y.F, &y.M.view, (sl_certainty)certainty, NULL, NULL);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            counter.fail_at = -1;
            SL_CHECK(sl_plan_create(&P, y.S, bset, 1, xset, 2, &opt, NULL));
            if (status == SL_OK) {
                counter.fail_at = (int64_t)counter.calls;
                SL_EXPECT(SL_ERR_MEMORY,
                          sl_plan_solve_bounded(P, y.F, x, 2, bounds, &b, 1, 1, NULL, NULL, NULL));
                counter.fail_at = -1;
            }
            SL_EXPECT(status == SL_OK ? SL_OK : SL_ERR_STALE, solve_bounded(P, y.F, NULL));
            sl_plan_free(P);
            factored_free(&y);
            COUNTER_CLEAN(&counter);
            assert_in_range(k, 0, 100);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_are_those_of_the_numbers),
        cmocka_unit_test(other_values_are_noticed),
        cmocka_unit_test(what_has_no_bound_is_refused),
        cmocka_unit_test(weak_pivots_have_no_bounds),
        cmocka_unit_test(wrong_arguments),
        cmocka_unit_test(inconsistent_right_hand_sides),
        cmocka_unit_test(saved_factors_keep_their_certificate),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
