/* test_bounds_use.c: certified factors: refusals, lifetimes, saved files, sharpness, memory */
#include "tests/lib/exact_solve.h"
#include "tests/lib/saved.h"
#include "tests/lib/zero_mean.h"

enum { SIDE = 40, N = SIDE * SIDE };

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
        SL_CHECK(sl_factor_update(F, &v, NULL, NULL, NULL));
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
    SL_EXPECT(SL_ERR_STATE, sl_factor_certify(y.F, &y.M.view, SL_GUARANTEED, NULL, NULL));
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
        opt.null_pivots = SL_NULL_PIVOT_SKIP;
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
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    SL_CHECK(sl_symbolic_create(&S, &A, &natural, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.weak, 1);
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_certify(F, &A, SL_ESTIMATED, NULL, &stats));
    assert_non_null(strstr(stats.error.what, "weak"));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* S A S with powers of 2 in S: L, D, x and its bounds scale exactly, in spite of squares that leave
 * the range of double. */
static void bounds_scale_with_the_rows(void **state) {
    (void)state;
    static const sl_int bset[2] = {7, 50};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    const sl_csc A = y.M.view;
    double bounds[2][2][2 * 100], x[2 * 100], b[2 * 2] = {1.0, -0.5, 0.75, 0.25};
    sl_plan *P = NULL;
    int exponent[100];
    for (int k = 0; k < 100; k++) {
        exponent[k] = k % 2 ? 280 : -280;
    }
    SL_CHECK(sl_plan_create(&P, y.S, bset, 2, NULL, 0, NULL, NULL));
    for (int turn = 0; turn < 2; turn++) {
        SL_CHECK(sl_factor_refactor(y.F, &A, NULL));
        SL_CHECK(sl_factor_certify(y.F, &A, SL_GUARANTEED, NULL, NULL));
        for (sl_int nrhs = 1; nrhs <= 2; nrhs++) {
            double *found = bounds[turn][nrhs - 1];
            SL_CHECK(sl_plan_solve_bounded(P, y.F, x, 100, found, b, 2, nrhs, NULL, NULL, NULL));
            for (int k = 0; k < 100 * nrhs; k++) {
                const double scaled = ldexp(found[k], turn * exponent[k % 100]);
                assert_true(scaled > 0.0 && scaled == bounds[0][nrhs - 1][k]);
            }
        }
        for (int j = 0; j < 100; j++) {
            for (sl_int q = A.p[j]; q < A.p[j + 1]; q++) {
                y.M.x[q] = ldexp(y.M.x[q], exponent[A.i[q]] + exponent[j]);
            }
        }
        for (int k = 0; k < 4; k++) {
            b[k] = ldexp(b[k], exponent[bset[k % 2]]);
        }
    }
    sl_plan_free(P);
    factored_free(&y);
}

/* Squares of b leave the range: no bound is known. Those of b = 0 are 0, and so are those of other
 * components. */
static void unknown_norms_give_infinite_bounds(void **state) {
    (void)state;
    static const sl_int column[5] = {0, 2, 3, 4, 5}, row[5] = {0, 1, 1, 2, 3}, bset[2] = {0, 1};
    static const double values[5] = {2.0, -1.0, 3.0, 2.0, 5.0};
    const sl_csc A = {4, 4, column, row, values};
    const double b[3 * 2] = {1e-170, 0.0, 0.0, 0.0, 0.0, 1e170};
    double x[3 * 4], bounds[3 * 4];
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_factor_certify(F, &A, SL_GUARANTEED, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, S, bset, 2, NULL, 0, NULL, NULL));
    SL_CHECK(sl_plan_solve_bounded(P, F, x, 4, bounds, b, 2, 3, NULL, NULL, NULL));
    for (int k = 0; k < 3 * 4; k++) {
        assert_true(bounds[k] == (k / 4 == 1 || k % 4 > 1 ? 0.0 : HUGE_VAL));
    }
    sl_plan_free(P);
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
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
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

/* Scales that another plan, or other numbers, have left are computed again. */
static void scales_know_what_they_are_of(void **state) {
    (void)state;
    static const sl_int rows[6] = {7, 30, 55, 99, 0, 7};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    double scales[4 * 3 + 2], x[3], bounds[3], fresh[3], b[3] = {1.0, 0.5, -2.0};
    memset(scales, 0, sizeof scales);
    for (int turn = 0; turn < 12; turn++) {
        const sl_int *bset = rows + turn % 3, *xset = rows + turn % 4;
        sl_plan *P = NULL;
        y.M.x[0] *= turn == 6 ? 1.5 : 1.0;
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
        SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
        SL_CHECK(sl_plan_create(&P, y.S, bset, 3, xset, 3, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(P, y.F, x, 3, bounds, b, 3, 1, scales, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(P, y.F, x, 3, fresh, b, 3, 1, NULL, NULL, NULL));
        assert_memory_equal(bounds, fresh, sizeof bounds);
        sl_plan_free(P);
    }
    factored_free(&y);
}

/* Weights are no part of L and D, but scales depend on them; a saved factor has them, too. */
static void scales_know_their_weights(void **state) {
    (void)state;
    static const sl_int bset[2] = {7, 55}, xset[3] = {30, 7, 0};
    static const double b[2] = {1.0, 0.5};
    sl_int components = 0;
    gen_matrix_t M = laplacian(GEN_GRID2, 100, 0, &components);
    double scales[4 * 3 + 2], x[3], bounds[3], fresh[3], before = 0.0;
    sl_symbolic *S = NULL;
    sl_plan *P = NULL;
    memset(scales, 0, sizeof scales);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, S, bset, 2, xset, 3, NULL, NULL));
    for (uint64_t turn = 0; turn < 3; turn++) {
        double *mass = weights(M.view.n_cols, turn);
        sl_options opt = options_none();
        sl_factor *F = NULL, *G = NULL;
        sl_symbolic *T = NULL;
        sl_plan *Q = NULL;
        opt.null_pivots = SL_NULL_PIVOT_SKIP;
        opt.mass = mass;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_certify(F, &M.view, SL_ESTIMATED, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(P, F, x, 3, bounds, b, 2, 1, scales, NULL, NULL));
        assert_true(bounds[0] > 0.0 && bounds[0] != before);
        before = bounds[0];
        saved_t m = saved_make(S, F);
        SL_CHECK(pair_load_memory(&T, &G, m.bytes, m.size, SL_LOAD_VERIFIED, NULL));
        SL_CHECK(sl_plan_create(&Q, T, bset, 2, xset, 3, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(Q, G, x, 3, fresh, b, 2, 1, NULL, NULL, NULL));
        assert_memory_equal(bounds, fresh, sizeof bounds);
        sl_plan_free(Q);
        sl_factor_free(F);
        sl_factor_free(G);
        sl_symbolic_free(T);
        saved_free(&m);
        free(mass);
    }
    sl_plan_free(P);
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

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* M + t L on a grid, t = 10 edge lengths squared, x within 4 edges of the source: the median of
 * bound / error. */
static void bounds_are_sharp_near_the_source(void **state) {
    (void)state;
    gen_list_t t = gen_list(N);
    uint64_t seed = 5;
    for (sl_int k = 0; k < N; k++) {
        gen_add(&t, k, k, 0.1);
        for (int side = 0; side < 2; side++) {
            const sl_int to = side ? k + SIDE : k + 1;
            const double w = 1.5 + gen_real(&seed);
            if (side ? to < N : to % SIDE != 0) {
                gen_add(&t, to, k, -w);
                gen_add(&t, k, k, w);
                gen_add(&t, to, to, w);
            }
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_int *all = test_ints(N);
    double *ratios = test_reals(81 * 20), *b = test_reals(N);
    twice_t *x = (twice_t *)test_array(N, sizeof *x);
    size_t count = 0;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_certify(F, &M.view, SL_ESTIMATED, NULL, NULL));
    gen_set(all, 20, N, 9);
    for (int m = 0; m < 20; m++) {
        sl_int near[81], nx = 0;
        double X[81], bounds[81], one = 1.0;
        sl_plan *P = NULL;
        for (sl_int i = 0; i < N; i++) {
            if (abs(i % SIDE - all[m] % SIDE) <= 4 && abs(i / SIDE - all[m] / SIDE) <= 4) {
                near[nx++] = i;
            }
        }
        SL_CHECK(sl_plan_create(&P, S, &all[m], 1, near, nx, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(P, F, X, 81, bounds, &one, 1, 1, NULL, NULL, NULL));
        memset(b, 0, N * sizeof *b);
        b[all[m]] = 1.0;
        exact_solve(F, &M.view, b, NULL, x);
        for (sl_int k = 0; k < nx; k++) {
            const double error = fabs((x[near[k]].high - X[k]) + x[near[k]].low);
            assert_true(error <= bounds[k]);
            ratios[count++] = bounds[k] / (error + 1e-300);
        }
        sl_plan_free(P);
    }
    qsort(ratios, count, sizeof *ratios, compare_doubles);
    print_message("median of bound / error near the source: %.0f\n", ratios[count / 2]);
    assert_true(ratios[count / 2] < 1000.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    free(all);
    free(ratios);
    free(b);
    free(x);
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
        cmocka_unit_test(bounds_scale_with_the_rows),
        cmocka_unit_test(unknown_norms_give_infinite_bounds),
        cmocka_unit_test(wrong_arguments),
        cmocka_unit_test(inconsistent_right_hand_sides),
        cmocka_unit_test(scales_know_what_they_are_of),
        cmocka_unit_test(scales_know_their_weights),
        cmocka_unit_test(saved_factors_keep_their_certificate),
        cmocka_unit_test(bounds_are_sharp_near_the_source),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
