/* test_null_refused.c: null pivots are refused by default, and a refusal says what helps */
#include "tests/lib/small_pivots.h"

static const sl_ordering orders[3] = {SL_ORDERING_ND, SL_ORDERING_NATURAL, SL_ORDERING_MINDEG};

static gen_matrix_t graph(sl_int n, int kind, double spread, uint64_t *seed) {
    double *M = test_reals((size_t)n * (size_t)n);
    for (sl_int i = 1; i < n; i++) {
        const sl_int up = kind == 0 ? i - 1 : kind == 1 ? 0 : gen_below(seed, i);
        system_spring(M, n, i, up, kind == 4 ? 1.0 : system_scale(seed, -spread, 0.0));
        for (sl_int j = 0; j < i && kind >= 3; j++) {
            const double w = kind == 4 ? 1.0 : system_scale(seed, -spread, 0.0);
            if (kind == 4 || gen_below(seed, 4) == 0) {
                system_spring(M, n, i, j, w);
            }
        }
    }
    gen_matrix_t A = beside(M, n, n);
    free(M);
    return A;
}

static void singular_laplacians_are_refused(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    uint64_t seed = 3;
    for (int turn = 0; turn < 1500; turn++) {
        sl_options opt = options_none();
        const sl_int n = 2 + gen_below(&seed, 70);
        const double spread = turn % 3 == 0 ? 12.0 * fabs(gen_real(&seed)) : 0.5;
        gen_matrix_t A = graph(n, turn % 5, spread, &seed);
        sl_stats stats;
        options_set_variant(&opt, &variants, turn % variants.count);
        opt.ordering = orders[turn / 5 % 3];
        SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.null, 1);
        assert_true(stats.factor.growth == 0.0 && stats.error.row >= 0);
        assert_true(strstr(stats.error.what, "sum to 0") != NULL);
        gen_matrix_free(&A);
    }
}

/* A heavy path, joined weakly to a row that is joined more weakly to a light path: the pivot of
 * that row is lost in rounding, and the last one, computed from it, looks regular. */
static void a_pivot_after_a_lost_one_is_refused(void **state) {
    (void)state;
    enum { N = 20 };
    uint64_t seed = 1;
    for (int turn = 0; turn < 60; turn++) {
        double M[N * N] = {0.0};
        sl_options opt = options_none();
        sl_stats stats;
        for (sl_int i = 1; i < N; i++) {
            const double w = i < 9 ? 1.0 : i == 9 ? 1e-6 : 1e-20;
            system_spring(M, N, i, i - 1, w * (1.0 + fabs(gen_real(&seed))));
        }
        gen_matrix_t A = beside(M, N, N);
        opt.ordering = SL_ORDERING_NATURAL;
        SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
        gen_matrix_free(&A);
    }
}

/* 1 1; 1 1 + 2^-47: the second pivot is small and right. What follows it fails. */
static void a_failure_after_a_small_pivot_is_that_of_the_pivot(void **state) {
    (void)state;
    const double d = ldexp(1.0, -47);
    /* the third pivot is 0 */
    const double zero[9] = {1.0, 0.0, 0.0, 1.0, 1.0 + d, 0.0, 0.0, 1.0, 1.0 / d};
    /* the entry of L below the second pivot exceeds float */
    const double large[9] = {1.0, 0.0, 0.0, 1.0, 1.0 + d, 0.0, 0.0, 1e30, 1e100};
    for (int k = 0; k < 4; k++) {
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        gen_matrix_t A = beside(k == 3 ? large : zero, 3, 3);
        opt.ordering = SL_ORDERING_NATURAL;
        opt.relaxation = k == 1 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
        opt.method = k == 2 ? SL_METHOD_UP_LOOKING : SL_METHOD_SUPERNODAL;
        opt.storage = k == 3 ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
        SL_CHECK(sl_symbolic_create(&S, &A.view, FOR_ANALYSIS(&opt), NULL));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), &stats));
        assert_in_range(stats.error.row, 1, 2);
        assert_true(stats.error.row == 2 ? stats.error.value == 0.0 : stats.error.value == d);
        assert_true(stats.factor.null_bound > 0.0);
        sl_symbolic_free(S);
        gen_matrix_free(&A);
    }
}

/* Very many small pivots, each after a long path: judging all would take longer than the
 * factorization. */
static void judgements_end(void **state) {
    (void)state;
    enum { N = 4000, M = 140 };
    sl_options opt = options_none();
    sl_stats stats;
    gen_list_t t = gen_list(N + M);
    for (sl_int i = 0; i < N; i++) {
        gen_add(&t, i, i, 3.0);
        gen_add(&t, i + 1, i, -1.0);
    }
    for (sl_int i = N; i < N + M; i++) {
        for (sl_int j = N; j <= i; j++) {
            gen_add(&t, i, j, i == j && i > N ? 1.0 + 6e-14 : 1.0);
        }
    }
    gen_add(&t, N, N, 1.0);
    gen_matrix_t A = gen_store(&t, gen_style(0), 1);
    opt.ordering = SL_ORDERING_NATURAL;
    SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
    /* what helps if A is singular, and if it is not */
    assert_true(strstr(stats.error.what, "options.pivots") != NULL);
    assert_true(strstr(stats.error.what, "sl_symbolic_create_pivoted") != NULL);
    opt.null_tolerance = -1.0;
    SL_CHECK(factor_and_solve(&A, &opt, &stats));
    gen_matrix_free(&A);
    gen_list_free(&t);
}

/* Random symmetric matrices whose last row repeats the first one: singular, indefinite. Consistent
 * systems are solved by regularization and refinement. */
static void consistent_indefinite_systems_are_solved_by_regularization(void **state) {
    (void)state;
    enum { N = 14 };
    uint64_t seed = 31;
    for (int turn = 0; turn < 60; turn++) {
        double M[N * N] = {0.0}, b[N], x[N], z[N];
        sl_int signs[N] = {0};
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        for (sl_int i = 0; i < N - 1; i++) {
            for (sl_int j = 0; j <= i; j++) {
                CELL(M, N, i, j) = gen_real(&seed);
            }
            CELL(M, N, N - 1, i) = CELL(M, N, i, 0);
        }
        CELL(M, N, N - 1, N - 1) = M[0];
        gen_matrix_t A = beside(M, N, N);
        gen_reals(z, N, gen_bits(&seed));
        SL_CHECK(sl_csc_multiply(&A.view, SL_AS_SYMMETRIC, b, N, z, N, 1));
        SL_CHECK(turn % 2 ? sl_symbolic_create_pivoted(&S, &A.view, NULL, NULL)
                          : sl_symbolic_create(&S, &A.view, NULL, NULL));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A.view, NULL, NULL));
        opt.regularization = 1e-8;
        opt.signs = signs;
        SL_CHECK(sl_factor_create(&F, S, &A.view, &opt, &stats));
        assert_int_equal(stats.factor.regularized, 1);
        SL_CHECK(sl_factor_solve(F, x, N, b, N, 1, NULL));
        SL_CHECK(sl_factor_refine(F, &A.view, x, N, b, N, 1, 20, NULL, &stats));
        assert_true(worst_backward(&A.view, x, N, b, N, 1) < 1e-14);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&A);
    }
}

/* ---- what a refusal says ---- */

static void a_refusal_says_what_helps(void **state) {
    (void)state;
    static const double indefinite[4] = {0.0, 0.0, 1.0, 1.0};
    static const double grows[4] = {1e-17, 0.0, 1.0, 0.0};
    static const double negative[4] = {1.0, 0.0, 1.0, 1.0 - 1e-9};
    sl_options opt = options_none();
    sl_stats stats;
    gen_matrix_t A = beside(indefinite, 2, 2), B = beside(grows, 2, 2), C = beside(negative, 2, 2);
    opt.ordering = SL_ORDERING_NATURAL;
    SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
    assert_true(strstr(stats.error.what, "sl_symbolic_create_pivoted") != NULL);
    SL_EXPECT(SL_ERR_INACCURATE, factor_and_solve(&B, &opt, &stats));
    assert_true(strstr(stats.error.what, "sl_symbolic_create_pivoted") != NULL);
    /* a tolerance that takes a right pivot for null */
    opt.null_tolerance = 1e-6;
    SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&C, &opt, &stats));
    assert_true(strstr(stats.error.what, "null_tolerance") != NULL);
    assert_true(stats.factor.null_bound > 1e-6 && stats.factor.null_bound < 3e-6);
    /* a pivot that is negative beyond rounding in a matrix that should be semidefinite */
    opt.null_tolerance = 0.0;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&C, &opt, &stats));
    assert_true(strstr(stats.error.what, "wrong sign") != NULL);
    assert_true(stats.error.value < 0.0 && stats.factor.null_bound > 0.0 &&
                stats.factor.null_bound < 1e-12);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
    gen_matrix_free(&C);
}

/* Pivots of a singular matrix, chosen by its values. */
static void a_refusal_of_chosen_pivots_says_that_the_matrix_is_singular(void **state) {
    (void)state;
    static const double M[9] = {1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0};
    gen_matrix_t A = beside(M, 3, 3);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A.view, NULL, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A.view, NULL, &stats));
    assert_true(strstr(stats.error.what, "singular to working precision") != NULL);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
}

/* Where null pivots are skipped, an entry that is not finite changes components, signs and null
 * vectors; it is named itself. */
static void an_entry_that_is_not_finite_is_named_where_pivots_are_skipped(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    static const double bad[3] = {NAN, INFINITY, -INFINITY};
    uint64_t seed = 5;
    for (int turn = 0; turn < 600; turn++) {
        sl_options opt = options_none();
        const sl_int n = 2 + gen_below(&seed, 12);
        gen_matrix_t A = graph(n, turn % 5, 1.0, &seed);
        double *Z = test_reals(2 * (size_t)n);
        sl_stats stats;
        const sl_int at = gen_below(&seed, A.p[n]);
        for (sl_int k = 0; k < A.p[n]; k++) {
            A.x[k] *= turn % 2 ? -1.0 : 1.0;
        }
        if (turn % 3 == 0) {
            A.x[A.p[n] - 1] = 0.0; /* a diagonal entry */
        }
        A.x[at] = bad[turn % 3];
        for (sl_int i = 0; i < n; i++) {
            Z[i] = 1.0;
            Z[n + i] = i;
        }
        options_set_variant(&opt, &variants, turn % variants.count);
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.null_vector = Z;
        opt.null_vector_count = 1 + turn / 4 % 2;
        SL_EXPECT(SL_ERR_NOT_FINITE, factor_and_solve(&A, &opt, &stats));
        assert_true(!(fabs(stats.error.value) <= DBL_MAX));
        if (stats.error.column >= 0) {
            assert_int_equal(stats.error.row, A.i[at]);
            assert_in_range(at, A.p[stats.error.column], A.p[stats.error.column + 1] - 1);
        }
        gen_matrix_free(&A);
        free(Z);
    }
}

/* The same of a sum, whose entries are in the order of the analysis. */
static void an_entry_of_a_sum_that_is_not_finite_is_named(void **state) {
    (void)state;
    static const double M[9] = {1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, INFINITY};
    const double *values[1];
    const double one[1] = {1.0};
    gen_matrix_t A = beside(M, 3, 3);
    double *v = test_reals(8);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_options opt = options_none();
    sl_stats stats;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    A.x[2] = 0.0;
    values[0] = v;
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_symbolic_scatter(S, v, &A.view, NULL));
    SL_EXPECT(SL_ERR_NOT_FINITE,
              sl_factor_create_sums(&F, 1, S, one, values, 1, &opt, NULL, &stats));
    assert_true(stats.error.row == 2 && stats.error.column == 2);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    free(v);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(singular_laplacians_are_refused),
        cmocka_unit_test(a_pivot_after_a_lost_one_is_refused),
        cmocka_unit_test(a_failure_after_a_small_pivot_is_that_of_the_pivot),
        cmocka_unit_test(judgements_end),
        cmocka_unit_test(consistent_indefinite_systems_are_solved_by_regularization),
        cmocka_unit_test(a_refusal_says_what_helps),
        cmocka_unit_test(a_refusal_of_chosen_pivots_says_that_the_matrix_is_singular),
        cmocka_unit_test(an_entry_that_is_not_finite_is_named_where_pivots_are_skipped),
        cmocka_unit_test(an_entry_of_a_sum_that_is_not_finite_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
