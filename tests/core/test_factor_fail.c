/* test_factor_fail.c: null pivots, wrong signs, the rows reported, failed factors, arguments */
#include "tests/lib/factored.h"

static void assert_refuses(sl_factor *F, const sl_symbolic *S) {
    double one[1] = {7}, log_det = 7, sign = 7;
    sl_matrix *lower = NULL;
    sl_plan *P = NULL;
    const sl_int row[1] = {0};
    sl_int n = sl_symbolic_view(S).n;
    double *X = test_reals((size_t)n), *B = test_reals((size_t)n);
    gen_reals(X, (size_t)n, 1);
    double first = X[0];
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve(F, X, (size_t)n, B, (size_t)n, 1, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve(F, X, (size_t)n, B, (size_t)n, 0, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_logdet(F, &log_det, &sign));
    SL_EXPECT(SL_ERR_STALE, sl_factor_lower(&lower, F, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_local_solve(F, row, 1, row, 1, one, 1, one, 1, 1, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, S, row, 1, row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_plan_solve(P, F, one, 1, one, 1, 1, NULL));
    assert_true(one[0] == 7 && X[0] == first && log_det == 7 && sign == 7);
    assert_null(lower);
    sl_plan_free(P);
    free(X);
    free(B);
}

static void a_failed_refactor_refuses_until_one_succeeds(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        options_set_variant(&opt, &variants, k);
        factored_t y = factored_make(GEN_GRID2, 400, 1, 0, &opt);
        sl_int n = y.M.view.n_cols, nnz = y.M.p[n];
        sl_factor *G = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
        double *zeros = test_reals((size_t)nnz), *poison = test_reals((size_t)nnz);
        memcpy(poison, y.M.x, (size_t)nnz * sizeof *poison);
        poison[nnz / 2] = NAN;
        sl_csc Z = y.M.view, N = y.M.view;
        Z.x = zeros;
        N.x = poison;
        size_t calls = counter.calls;
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(G, &Z, &stats));
        assert_int_equal(stats.factor.null, 1);
        assert_in_range(stats.error.row, 0, n - 1);
        assert_true(stats.error.value == 0.0);
        assert_int_equal(counter.calls, calls);
        assert_refuses(G, y.S);
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(G, &N, &stats));
        assert_refuses(G, y.S);
        SL_CHECK(sl_factor_refactor(G, &y.M.view, &stats));
        assert_same_bits(G, y.F); /* the failure leaves no trace */
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(G, &N, NULL));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(G, &Z, NULL));
        SL_CHECK(sl_factor_refactor(G, &y.M.view, NULL));
        assert_same_bits(G, y.F);
        free(zeros);
        free(poison);
        sl_factor_free(G);
        factored_free(&y);
        COUNTER_CLEAN(&counter);
    }
}

/* The only null pivot of diag(1 .. 1, 0, 1 .. 1) is the zero, in any ordering. */
static void a_null_pivot_is_reported_in_the_callers_row(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (sl_int zero = 0; zero < 20; zero++) {
        gen_list_t t = gen_list(20);
        for (sl_int k = 0; k < 20; k++) {
            gen_add(&t, k, k, k == zero ? 0.0 : 1.0 + k);
        }
        /* ties between the other rows */
        for (sl_int k = 0; k + 2 < 20; k++) {
            if (k != zero && k + 2 != zero) {
                gen_add(&t, k + 2, k, 0.25);
            }
        }
        for (int which = 0; which < GEN_STYLES; which++) {
            gen_matrix_t M = gen_store(&t, gen_style(which), 3);
            sl_symbolic *S = NULL;
            SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
            for (int k = 0; k < variants.count; k++) {
                sl_options opt = options_none();
                options_set_variant(&opt, &variants, k);
                sl_factor *F = (sl_factor *)(void *)&t;
                sl_stats stats;
                memset(&stats, 0, sizeof stats);
                SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, &opt, &stats));
                assert_null(F);
                assert_int_equal(stats.error.row, zero);
                assert_int_equal(stats.factor.null, 1);
                assert_true(stats.error.value == 0.0);
                SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, &opt, NULL));
                /* only exact zeros are null, and this is one */
                opt.null_tolerance = -1.0;
                SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, &opt, NULL));
            }
            sl_symbolic_free(S);
            gen_matrix_free(&M);
        }
        gen_list_free(&t);
    }
}

/* The last pivot of a Laplacian is 0 up to rounding; a test for d == 0.0 would miss it. */
static void a_laplacian_is_singular(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (sl_int size = 4; size < 1000; size = size * 3 / 2 + 1) {
        gen_matrix_t M = gen_matrix(GEN_SINGULAR, size, 1, 1);
        /* thirds are inexact: the last pivot is about 1e-17, not 0 */
        for (sl_int q = 0; q < M.p[M.view.n_cols]; q++) {
            M.x[q] /= 3.0;
        }
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        sl_symbolic_arrays v = sl_symbolic_view(S);
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_none();
            sl_stats stats;
            sl_factor *F = NULL;
            memset(&stats, 0, sizeof stats);
            options_set_variant(&opt, &variants, k);
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, &opt, &stats));
            assert_int_equal(stats.error.row, v.perm[v.n - 1]);
            assert_true(fabs(stats.error.value) < 1e-12);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

static void null_tolerance_decides_what_is_null(void **state) {
    (void)state;
    /* [1 1; 1 1 + e]: the second pivot is e, computed from magnitudes of sum about 2 */
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    double x[3] = {1, 1, 1};
    sl_csc A = {2, 2, p, i, x};
    sl_options opt = options_none();
    sl_factor *F = NULL;
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    x[2] = 1.0 + 4.0 * DBL_EPSILON;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL)); /* 64 eps */
    opt.null_tolerance = -1.0;
    SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
    assert_true(sl_factor_view(F).D[1] == 4.0 * DBL_EPSILON);
    /* a refactor keeps the tolerance of the factor */
    x[2] = 1.0 + DBL_EPSILON;
    SL_CHECK(sl_factor_refactor(F, &A, NULL));
    x[2] = 1.0;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &A, NULL));
    sl_factor_free(F);
    opt.null_tolerance = 1e-3;
    x[2] = 1.0 + 1e-3;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
    x[2] = 1.0 + 1e-2;
    SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
    sl_factor_free(F);
    opt.null_tolerance = NAN;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
    assert_null(F);
    sl_symbolic_free(S);
}

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 25, 1, 0, NULL);
    gen_matrix_t other = gen_matrix(GEN_GRID2, 36, 1, 1), path = gen_matrix(GEN_PATH, 25, 1, 1);
    sl_factor *F = NULL;
    sl_options opt = options_none();
    sl_csc bare = y.M.view;
    bare.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, &bare, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, NULL, &y.M.view, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(NULL, y.S, &y.M.view, NULL, NULL));
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_create(&F, y.S, &other.view, NULL, NULL));
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_create(&F, y.S, &path.view, NULL, NULL));
    opt.isa = (sl_isa)77;
    sl_status status = sl_factor_create(&F, y.S, &y.M.view, &opt, NULL);
    assert_true(status == SL_ERR_UNSUPPORTED || status == SL_ERR_ARGUMENT);
    assert_null(F);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor(NULL, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor(y.F, &bare, NULL));
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_refactor(y.F, &other.view, NULL));
    sl_matrix *lower = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_lower(&lower, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_lower(NULL, y.F, NULL));
    sl_factor_free(NULL);
    gen_matrix_free(&other);
    gen_matrix_free(&path);
    factored_free(&y);
}

/* With SL_PIVOTS_POSITIVE a wrong sign is refused with its row: here that of M - t L. */
static void an_indefinite_matrix_is_refused_where_a_definite_one_is_meant(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    sl_csc A = y.M.view;
    double *x = test_reals((size_t)A.p[100]);
    sl_options opt = options_none();
    sl_factor *F = NULL;
    sl_stats stats;
    opt.pivots = SL_PIVOTS_POSITIVE;
    SL_CHECK(sl_factor_create(&F, y.S, &A, &opt, &stats));
    assert_int_equal(stats.factor.positive, 100);
    assert_same_bits(F, y.F);
    for (int k = 0; k < A.p[100]; k++) {
        x[k] = -0.01 * A.x[k];
    }
    for (sl_int j = 0; j < 100; j++) { /* the diagonal is the first entry of a column */
        x[A.p[j]] += j % 7 == 3 ? 0.0 : 1.0;
    }
    A.x = x;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &A, &stats));
    assert_int_equal(stats.error.row % 7, 3);
    assert_true(stats.error.value < 0.0);
    assert_non_null(strstr(stats.error.what, "definite"));
    assert_int_equal(stats.factor.positive + stats.factor.negative, 100); /* all are there */
    assert_int_equal(stats.factor.null, 0);
    assert_true(stats.factor.negative >= 14);
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve(F, x, 100, x, 100, 1, NULL));
    sl_factor_free(F);
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, y.S, &A, &opt, NULL));
    opt.growth_limit = 1e-3; /* growth does not hide the sign */
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, y.S, &A, &opt, NULL));
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    opt.growth_limit = 0.0;
    opt.regularization = 1e-8;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    opt.regularization = 0.0;
    opt.pivots = (sl_pivots)(SL_PIVOTS_SKIP_NULL + 1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    free(x);
    factored_free(&y);
}

/* Several factors share one analysis, and one stats struct collects the results of several
 * calls. */
static void one_stats_struct_collects_several_calls(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 100, 1, 1);
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, &stats));
    sl_stats before = stats;
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, &stats));
    assert_int_equal(stats.symbolic.nnz_l, before.symbolic.nnz_l);
    assert_int_equal(stats.symbolic.supernodes, before.symbolic.supernodes);
    assert_true(stats.symbolic.flops == before.symbolic.flops);
    assert_int_equal(stats.factor.positive, 100);
    assert_true(stats.factor.bytes >= (size_t)stats.symbolic.nnz_panels * sizeof(double));
    assert_int_equal(stats.error.row, -1);
    assert_int_equal(stats.error.column, -1);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_failed_refactor_refuses_until_one_succeeds),
        cmocka_unit_test(a_null_pivot_is_reported_in_the_callers_row),
        cmocka_unit_test(a_laplacian_is_singular),
        cmocka_unit_test(null_tolerance_decides_what_is_null),
        cmocka_unit_test(invalid_arguments_are_refused),
        cmocka_unit_test(an_indefinite_matrix_is_refused_where_a_definite_one_is_meant),
        cmocka_unit_test(one_stats_struct_collects_several_calls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
