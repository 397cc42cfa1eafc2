/* test_float_fronts.c: factorizations in float: pivots, threads, refusals, what later calls do */
#include "tests/lib/factored.h"
#include "tests/lib/graph_laplacian.h"
#include "tests/lib/parallel_for.h"

/* Solutions, the inverse and saved copies: test_storage.c, test_save.c. */

static sl_options options_float(sl_isa isa) {
    sl_options opt = options_none();
    opt.isa = isa;
    opt.storage = SL_STORAGE_FLOAT_FRONTS;
    return opt;
}

/* D agrees with that of double to n epsilon of float, relative to what it was computed from: at
 * most twice the largest diagonal entry, as the matrix is definite. */
static void pivots_have_the_accuracy_of_float(void **state) {
    (void)state;
    const isa_list_t isas = isas_with_storages();
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < isas.count; k++) {
            sl_options opt = options_float(isas.isa[k]);
            factored_t y = factored_make((gen_kind_t)kind, 250, 1, kind % GEN_STYLES, &opt);
            sl_factor *G = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            opt.storage = SL_STORAGE_DOUBLE;
            SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, &stats));
            const sl_factor_arrays f = sl_factor_view(y.F), g = sl_factor_view(G);
            const sl_int n = y.M.view.n_cols;
            const double bound =
                2.0 * stats.factor.growth * stats.factor.entry_max * n * (double)FLT_EPSILON;
            assert_null(f.L);
            for (sl_int j = 0; j < n; j++) {
                assert_true(f.D[j] == (double)(float)f.D[j]);
                assert_true(fabs(f.D[j] - g.D[j]) <= bound);
            }
            sl_factor_free(G);
            factored_free(&y);
        }
    }
}

/* L has the same bits for any number of threads, after a refactorization, and from a sum of value
 * arrays. */
static void every_way_gives_the_same_bits(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    int calls = 0;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < isas.count; k++) {
            sl_options opt = options_float(isas.isa[k]);
            factored_t y = factored_make((gen_kind_t)kind, 900, 1, 0, &opt);
            double *values = test_reals((size_t)scatter_length(y.S));
            const double *const arrays[1] = {values}, one = 1.0;
            sl_factor *G = NULL;
            opt.threads.count = 3;
            opt.threads.run = run_backwards;
            opt.threads.context = &calls;
            SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
            assert_same_bits(y.F, G);
            SL_CHECK(sl_factor_refactor(G, &y.M.view, NULL));
            assert_same_bits(y.F, G);
            SL_CHECK(sl_symbolic_scatter(y.S, values, &y.M.view, NULL));
            SL_CHECK(sl_factor_refactor_sums(&G, 1, &one, arrays, 1, NULL, NULL, NULL));
            assert_same_bits(y.F, G);
            sl_factor_free(G);
            free(values);
            factored_free(&y);
        }
    }
}

/* ---- what float cannot hold ---- */

/* [a b; b c] */
static sl_status factor_of_two(double a, double b, double c, sl_stats *stats) {
    return factor_two_rows(a, b, c, options_float(SL_ISA_AUTO), stats);
}

static void numbers_beyond_float_are_refused(void **state) {
    (void)state;
    sl_stats stats;
    SL_CHECK(factor_of_two(8e37, 1.0, 8e37, &stats));
    assert_int_equal(stats.storage, SL_STORAGE_FLOAT_FRONTS);
    SL_EXPECT(SL_ERR_INACCURATE, factor_of_two(1.0, 9e37, 1.0, &stats));
    assert_int_equal(stats.error.row, 1); /* an entry of A */
    assert_int_equal(stats.error.column, 0);
    assert_true(stats.error.value == 9e37);
    SL_EXPECT(SL_ERR_NOT_FINITE, factor_of_two(1.0, (double)NAN, 1.0, &stats));
    SL_EXPECT(SL_ERR_NOT_FINITE, factor_of_two(1.0, (double)INFINITY, 1.0, &stats));
    SL_EXPECT(SL_ERR_INACCURATE, factor_of_two(1.0, 3e19, 1.0, &stats)); /* its square */
    assert_int_equal(stats.error.row, 1);
    assert_int_equal(stats.error.column, -1);
    SL_CHECK(factor_of_two(1e-30, 0.0, 1.0, &stats));
    SL_CHECK(factor_of_two(1.0, 1e-50, 1.0, &stats)); /* underflows, as fill does */
    SL_EXPECT(SL_ERR_INACCURATE, factor_of_two(1e-31, 0.0, 1.0, &stats));
    assert_int_equal(stats.error.row, 0);
    SL_EXPECT(SL_ERR_INACCURATE, factor_of_two(1.0, 0.0, -1e-60, &stats)); /* not 0 */
    assert_int_equal(stats.error.row, 1);
    SL_EXPECT(SL_ERR_PIVOT, factor_of_two(1.0, 0.0, 0.0, &stats));
    SL_EXPECT(SL_ERR_INACCURATE, factor_of_two(1e-4, 1e3, 1.0, &stats)); /* growth */
    assert_int_equal(stats.error.row, 0);
}

/* A pivot that float cannot tell from rounding is refused: 1e-6 of what it was computed from. */
static void pivots_within_rounding_are_refused(void **state) {
    (void)state;
    sl_stats stats;
    SL_CHECK(factor_of_two(1.0, 1.0, 1.0 + 1e-4, &stats));
    SL_EXPECT(SL_ERR_PIVOT, factor_of_two(1.0, 1.0, 1.0 + 1e-6, &stats));
    assert_int_equal(stats.error.row, 1);
    for (int k = 2; k < LAPLACIAN_KINDS; k++) { /* with edges; regular in double */
        sl_options opt = options_float(SL_ISA_AUTO);
        sl_int components;
        gen_matrix_t M = laplacian(laplacian_kinds[k], 400, 0, &components);
        for (sl_int j = 0; j < M.view.n_cols; j++) {
            for (sl_int p = M.view.p[j]; p < M.view.p[j + 1]; p++) {
                M.x[p] += M.view.i[p] == j ? 1e-9 : 0.0;
            }
        }
        opt.storage = SL_STORAGE_FLOAT;
        SL_CHECK(factor_natural(&M.view, opt, &stats));
        opt.storage = SL_STORAGE_FLOAT_FRONTS;
        SL_EXPECT(SL_ERR_PIVOT, factor_natural(&M.view, opt, &stats));
        assert_in_range(stats.error.row, 0, M.view.n_cols - 1);
        gen_matrix_free(&M);
    }
}

/* Two paths, joined by a spring of weight w: the null vector is known, and the pivot at the weak
 * end is kept. In double it may be weak; float refuses what it cannot tell from 0. */
static void weak_pivots_are_refused(void **state) {
    (void)state;
    const sl_int n = 40;
    for (int k = 0; k < 2; k++) {
        const double w = k == 0 ? 1e-2 : 1e-9;
        gen_list_t t = gen_list(n);
        for (sl_int j = 0; j < n; j++) {
            const double before = j == 0 ? 0.0 : j == n / 2 ? w : 1.0;
            const double after = j == n - 1 ? 0.0 : j == n / 2 - 1 ? w : 1.0;
            gen_add(&t, j, j, before + after);
            if (j + 1 < n) {
                gen_add(&t, j + 1, j, -after);
            }
        }
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_options opt = options_float(SL_ISA_AUTO);
        sl_stats stats;
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        SL_EXPECT(k == 0 ? SL_OK : SL_ERR_PIVOT, factor_natural(&M.view, opt, &stats));
        assert_true(k == 0 ? stats.factor.null == 1 : stats.error.row == n / 2 - 1);
        opt.storage = SL_STORAGE_DOUBLE;
        SL_CHECK(factor_natural(&M.view, opt, &stats));
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

static void pairs_are_unsupported(void **state) {
    (void)state;
    const sl_int p[3] = {0, 1, 1}, i[1] = {1};
    const double x[1] = {1.0};
    const sl_csc A = {2, 2, p, i, x};
    const sl_options opt = options_float(SL_ISA_AUTO);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_create(&F, S, &A, &opt, NULL));
    assert_null(F);
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pivots_have_the_accuracy_of_float),
        cmocka_unit_test(every_way_gives_the_same_bits),
        cmocka_unit_test(numbers_beyond_float_are_refused),
        cmocka_unit_test(pivots_within_rounding_are_refused),
        cmocka_unit_test(weak_pivots_are_refused),
        cmocka_unit_test(pairs_are_unsupported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
