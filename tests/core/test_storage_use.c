/* test_storage_use.c: L in float: what float cannot hold, changes, memory, condition */
#include "tests/lib/factored.h"
#include "tests/lib/float_storage.h"

/* [a b; b c] in float. */
static sl_status factor_of_two(double a, double b, double c, double limit, sl_stats *stats) {
    sl_options opt = options_float(SL_ISA_AUTO);
    opt.growth_limit = limit;
    return factor_two_rows(a, b, c, opt, stats);
}

static void entries_beyond_float_are_refused(void **state) {
    (void)state;
    sl_stats stats;
    SL_CHECK(factor_of_two(1.0, 3e38, 1e80, 0.0, &stats));
    SL_EXPECT(SL_ERR_INACCURATE, factor_of_two(1.0, 3.5e38, 1e80, 0.0, &stats));
    assert_int_equal(stats.error.row, 0);
    assert_true(stats.error.value == 1.0);
    SL_CHECK(factor_of_two(1.0, 1e-40, 1.0, 0.0, &stats)); /* underflows, as fill does */
    SL_CHECK(factor_of_two(1e60, 1e30, 2.0, 0.0, &stats)); /* scaled rows */
    SL_EXPECT(SL_ERR_INACCURATE, factor_of_two(1e100, 1e50, 2.0, 0.0, &stats));
    assert_int_equal(stats.error.row, 0);
    /* growth: beyond 1 / epsilon of float no digit is left */
    SL_CHECK(factor_of_two(1e-3, 1.0, 1.0, 0.0, &stats));
    SL_EXPECT(SL_ERR_INACCURATE, factor_of_two(1e-9, 1.0, 1.0, 0.0, &stats));
    SL_CHECK(factor_of_two(1e-9, 1.0, 1.0, -1.0, &stats));
}

/* An entry of L that float cannot hold, in a regular component beside one with two null vectors. */
static void entries_beyond_float_are_refused_beside_null_vectors(void **state) {
    (void)state;
    static const sl_int p[6] = {0, 3, 5, 6, 8, 9}, i[9] = {0, 1, 2, 1, 2, 2, 3, 4, 4};
    static const double x[9] = {1.0, -2.0, 1.0, 4.0, -2.0, 1.0, 1.0, 1e-40, 3e-80};
    static const double Z[10] = {1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 2.0, 1.0, 1.0};
    sl_csc A = {5, 5, p, i, x};
    sl_options opt = options_none();
    sl_factor *F = NULL;
    sl_stats stats;
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.null_vector = Z;
    opt.null_vector_count = 2;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.null, 2);
    sl_factor_free(F);
    opt.storage = SL_STORAGE_FLOAT;
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.error.row, 3);
    /* a row as small as what a null pivot leaves, a a' / DBL_MAX, is not refused */
    static const double small[9] = {1.0, -2.0, 1.0, 4.0, -2.0, 1.0, 1.0, 1e-140, 3e-280};
    A.x = small;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.null, 2);
    assert_true(fabs(sl_factor_view(F).D[4] - 2e-280) < 1e-290);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A Laplacian whose null pivot is hidden by a heavier row. The check for constants works in L, or
 * where L is too short, as here, in scratch. */
static void a_hidden_null_pivot_is_refused(void **state) {
    (void)state;
    const sl_int p[4] = {0, 2, 4, 5}, i[5] = {0, 1, 1, 2, 2};
    const double x[5] = {1e8, -1e8, 1e8 + 0.1, -0.1, 0.1};
    const sl_csc A = {3, 3, p, i, x};
    sl_stats stats;
    SL_EXPECT(SL_ERR_PIVOT, factor_natural(&A, options_float(SL_ISA_AUTO), &stats));
    assert_int_equal(stats.error.row, 2);
}

/* Calls that change L in place refuse it; those that have another way take that. */
static void changes_of(sl_storage storage) {
    const sl_options opt = options_of(storage, SL_ISA_AUTO);
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, &opt);
    sl_factor *G = NULL;
    sl_stats stats;
    const sl_int wp[2] = {0, 1}, wi[1] = {3}, column = 5;
    const double wx[1] = {0.5}, sigma = 1.0;
    const sl_csc W = {y.M.view.n_rows, 1, wp, wi, wx};
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_rank_update(y.F, &W, &sigma, NULL, NULL));
    y.M.x[y.M.p[column]] += 1.0; /* its diagonal entry comes first */
    SL_CHECK(sl_factor_change_entries(y.F, &y.M.view, NULL, &column, NULL, 1, NULL, &stats));
    SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
    assert_memory_equal(sl_factor_view(y.F).L_float, sl_factor_view(G).L_float,
                        (size_t)panel_doubles(G) * sizeof(float));
    sl_factor_free(G);
    factored_free(&y);
}

static void changes_are_factorizations(void **state) {
    (void)state;
    changes_of(SL_STORAGE_FLOAT);
}

/* Half the bytes for L, with whatever else a factor keeps. */
static void a_factor_takes_less_memory(void **state) {
    (void)state;
    sl_options opt = options_float(SL_ISA_AUTO);
    factored_t y = factored_make(GEN_GRID2, 20000, 1, 0, &opt);
    sl_factor *G = NULL;
    sl_stats single, full;
    memset(&single, 0, sizeof single);
    memset(&full, 0, sizeof full);
    opt.storage = SL_STORAGE_DOUBLE;
    SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, &full));
    single.factor = sl_factor_view(y.F).info;
    const size_t saved = sizeof(float) * (size_t)panel_doubles(G);
    assert_true(full.factor.bytes - single.factor.bytes >= saved * 9 / 10);
    sl_factor_free(G);
    factored_free(&y);
}

/* The estimate is about A, not about the rounding of L. */
static void the_condition_is_that_of_the_matrix(void **state) {
    (void)state;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        sl_options opt = options_float(SL_ISA_AUTO);
        factored_t y = factored_make((gen_kind_t)kind, 200, 1, 0, &opt);
        sl_factor *G = NULL;
        double a, b;
        opt.storage = SL_STORAGE_DOUBLE;
        SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
        SL_CHECK(sl_factor_rcond(y.F, &y.M.view, &a, NULL));
        SL_CHECK(sl_factor_rcond(G, &y.M.view, &b, NULL));
        assert_true(a <= 1.1 * b && b <= 1.1 * a);
        sl_factor_free(G);
        factored_free(&y);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_beyond_float_are_refused),
        cmocka_unit_test(entries_beyond_float_are_refused_beside_null_vectors),
        cmocka_unit_test(a_hidden_null_pivot_is_refused),
        cmocka_unit_test(changes_are_factorizations),
        cmocka_unit_test(a_factor_takes_less_memory),
        cmocka_unit_test(the_condition_is_that_of_the_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
