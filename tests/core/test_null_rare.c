/* test_null_rare.c: null pivots of rows of zeros in several trees, of weights that cancel, of sums
 * of matrices, and where sizes overflow */
#include "tests/lib/factored.h"

/* Adds the edge (i, j) of a Laplacian. */
static void add_edge(gen_list_t *t, sl_int i, sl_int j, double weight) {
    gen_add(t, i, i, weight);
    gen_add(t, j, j, weight);
    gen_add(t, i > j ? i : j, i > j ? j : i, -weight);
}

/* Adds up what was added to the same entry. */
static gen_matrix_t matrix_of(gen_list_t *t, int style) {
    gen_matrix_t M = gen_store(t, gen_style(style), 1);
    gen_list_free(t);
    return M;
}

static sl_options skipping(void) {
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    return opt;
}

/* Two trees of three rows, each an edge and a row of zeros, with weights: the rows of zeros have
 * the solution 0, the others zero mean. */
static void rows_of_zeros_in_several_trees(void **state) {
    (void)state;
    const double mass[6] = {1, 3, 5, 1, 3, 5}, b[6] = {2, -2, 0, -4, 4, 0};
    const double expected[6] = {1.5, -0.5, 0, -3, 1, 0};
    gen_list_t t = gen_list(6);
    for (sl_int k = 0; k < 6; k += 3) {
        static const sl_int row[6] = {0, 1, 2, 1, 2, 2}, column[6] = {0, 0, 0, 1, 1, 2};
        static const double value[6] = {1, -1, 0, 1, 0, 0};
        for (int e = 0; e < 6; e++) {
            gen_add(&t, k + row[e], k + column[e], value[e]);
        }
    }
    gen_matrix_t M = matrix_of(&t, 0);
    sl_options opt = skipping();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    double x[6];
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, &stats));
    assert_int_equal(stats.symbolic.components, 2);
    opt.mass = mass;
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
    assert_int_equal(stats.factor.null, 4);
    SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
    for (int k = 0; k < 6; k++) {
        assert_true(fabs(x[k] - expected[k]) <= 1e-14);
    }
    for (sl_int k = 0; k < 6; k++) { /* locally too, also on paths without the tree's anchor */
        const sl_int edge[2] = {3 * (k / 3), 3 * (k / 3) + 1};
        const sl_int *set = k % 3 == 2 ? &k : edge, count = k % 3 == 2 ? 1 : 2;
        const double *part = b + set[0];
        sl_plan *P;
        double y[2];
        SL_CHECK(sl_plan_create(&P, S, set, count, set, count, NULL, NULL));
        SL_CHECK(sl_plan_solve(P, F, y, 2, part, 2, 1, NULL));
        SAME_VALUES(y, x + set[0], (size_t)count);
        sl_plan_free(P);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A path of four rows, of which the last two are zeros: the path of the last row has no anchor.
 * Many right-hand sides have the bits of each one alone, with weights and without. */
static void paths_without_an_anchor(void **state) {
    (void)state;
    enum { NRHS = 20 };
    const double mass[4] = {1, 3, 5, 7};
    gen_list_t t = gen_list(4);
    add_edge(&t, 0, 1, 1.0);
    add_edge(&t, 1, 2, 0.0);
    add_edge(&t, 2, 3, 0.0);
    gen_matrix_t M = matrix_of(&t, 0);
    double B[4 * NRHS] = {0}, X[4 * NRHS], x[4];
    for (int r = 0; r < NRHS; r++) {
        B[4 * r] = r + 1.0;
        B[4 * r + 1] = -B[4 * r];
    }
    sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_NONE);
    for (int way = 0; way < 3; way++) {
        sl_options opt = skipping();
        sl_factor *F;
        sl_plan *P;
        const sl_int last = 3;
        opt.mass = way == 0 ? mass : NULL;
        opt.consistency_tolerance = way == 1 ? -1.0 : 0.0;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_solve(F, X, 4, B, 4, NRHS, NULL));
        for (int r = 0; r < NRHS; r++) {
            SL_CHECK(sl_factor_solve(F, x, 4, B + 4 * r, 4, 1, NULL));
            SAME_VALUES(x, X + 4 * r, 4);
            assert_true(fabs(x[0] - x[1] - (r + 1.0)) <= 1e-14 * (r + 1.0) && x[3] == 0.0);
        }
        SL_CHECK(sl_plan_create(&P, S, &last, 1, &last, 1, NULL, NULL));
        x[0] = 1.0;
        SL_CHECK(sl_plan_solve(P, F, x, 1, B + 3, 1, 1, NULL));
        assert_true(x[0] == 0.0);
        sl_plan_free(P);
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A change of columns after which diagonal entries of one component have different signs. */
static void changes_to_both_signs_are_refused(void **state) {
    (void)state;
    gen_list_t t = gen_list(4);
    for (sl_int k = 0; k < 3; k++) {
        add_edge(&t, k, k + 1, 1.0);
    }
    gen_matrix_t M = matrix_of(&t, 0); /* the lower triangle: columns begin with the diagonal */
    sl_options opt = skipping();
    sl_symbolic *S;
    sl_factor *F;
    const sl_int columns[2] = {0, 1};
    double b[4] = {0}, x[4];
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    M.x[M.p[0]] = -3.0;
    M.x[M.p[0] + 1] = 3.0;
    M.x[M.p[1]] = -2.0;
    SL_EXPECT(SL_ERR_PIVOT,
              sl_factor_change_entries(F, &M.view, NULL, columns, NULL, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve(F, x, 4, b, 4, 1, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Weights m with z' m = 0 up to rounding do not determine a solution, also where z is small at the
 * null pivot, so that the terms of z' m are much larger than m. */
static void weights_that_cancel_against_the_null_vector(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 4, 5}, i[5] = {0, 1, 1, 2, 2};
    const double x[5] = {1e-6, -1e-6, 2e-6, -1e-3, 1.0}, z[3] = {1000, 1000, 1};
    const sl_csc A = {3, 3, p, i, x};
    double mass[3] = {1, -1, 1e-13};
    sl_options opt = skipping();
    sl_factor *F;
    sl_stats stats;
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    opt.null_vector = z;
    opt.mass = mass;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.error.row, 2);
    mass[2] = 1e-3;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.null, 1);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Edges of weight 0 divide the rows into components, whichever triangles are stored; what is not
 * read may have any value. */
static void edges_of_weight_zero_in_both_triangles(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 5, 7}, i[7] = {0, 1, 0, 1, 2, 1, 2};
    const double x[7] = {1, -1, 77, 1, 0, 77, 0};
    const sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    opt.triangle = SL_TRIANGLE_LOWER;
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    opt = skipping();
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.null, 2);
    assert_int_equal(stats.factor.regular, 0);
    const double b[3] = {1, -1, 0};
    double y[3];
    SL_CHECK(sl_factor_solve(F, y, 3, b, 3, 1, NULL));
    assert_true(y[0] - y[1] == 1.0 && y[2] == 0.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* The null vector of the sum, signs, is none that is assumed: the tolerance finds the null pivot,
 * and products with both terms confirm it. */
static void null_pivots_of_a_sum_are_confirmed(void **state) {
    (void)state;
    enum { N = 30 };
    static sl_int p[N + 1], i[2 * N];
    static double one[2 * N], two[2 * N], b[N], x[N];
    sl_int t = 0;
    for (sl_int k = 0; k < N; k++) { /* edges with entries +1 in place of -1 */
        p[k] = t;
        i[t] = k;
        one[t] = k < N / 2 ? (k > 0) + 1.0 : k == N / 2;
        two[t++] = k > N / 2 ? 1.0 + (k + 1 < N) : k == N / 2;
        if (k + 1 < N) {
            i[t] = k + 1;
            one[t] = k < N / 2;
            two[t++] = k >= N / 2;
        }
        b[k] = 1.0;
    }
    p[N] = t;
    const sl_csc A = {N, N, p, i, one}, B = {N, N, p, i, two};
    static double first[2 * N], second[2 * N];
    const double *const values[2] = {first, second}, c[2] = {1, 1};
    sl_options opt = skipping();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_symbolic_scatter(S, first, &A, NULL));
    SL_CHECK(sl_symbolic_scatter(S, second, &B, NULL));
    SL_CHECK(sl_factor_create_sums(&F, 1, S, c, values, 2, &opt, NULL, &stats));
    assert_int_equal(stats.factor.null, 1);
    SL_CHECK(sl_factor_solve(F, x, N, b, N, 1, NULL));
    for (sl_int k = 0; k < t; k++) {
        one[k] += two[k];
    }
    BACKWARD_PASSES(&A, x, N, b, N, 1);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Sums of magnitudes that overflow prove no null vector; the null pivot is an exact 0. */
static void sizes_that_overflow(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double w = 1.7e308, x[3] = {w, -w, w}, b[2] = {w, -w};
    const sl_csc A = {2, 2, p, i, x};
    sl_options opt = skipping();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    double y[2];
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.null, 1);
    SL_CHECK(sl_factor_solve(F, y, 2, b, 2, 1, NULL));
    assert_true(y[0] - y[1] == 1.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Pivots that overflow where null pivots are skipped. */
static void pivots_that_overflow(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double x[3] = {1e-300, 1e10, 1.0};
    const sl_csc A = {2, 2, p, i, x};
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = skipping();
        sl_factor *F = (sl_factor *)(void *)&A;
        sl_stats stats;
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
        options_set_variant(&opt, &variants, k);
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_create(&F, S, &A, &opt, &stats));
        assert_null(F);
        assert_int_equal(stats.error.row, 1);
        sl_symbolic_free(S);
    }
}

/* Without an option for null pivots a Laplacian is refused even if its last pivot is rounding that
 * came from heavier rows; the regular component before it is not the reason. */
static void a_regular_component_is_not_suspected(void **state) {
    (void)state;
    int rounded = 0;
    for (int k = 1; k < 100; k++) {
        gen_list_t t = gen_list(5);
        gen_add(&t, 0, 0, 1.0);
        add_edge(&t, 0, 1, 2.0);
        add_edge(&t, 2, 3, 1.0);
        add_edge(&t, 3, 4, 0.003 * k);
        gen_matrix_t M = matrix_of(&t, 0);
        sl_factor *F;
        sl_stats stats;
        sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_DEFAULT);
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, NULL, &stats));
        assert_in_range(stats.error.row, 2, 4);
        rounded += stats.error.value != 0.0;
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
    assert_true(rounded > 0);
}

/* Nor is a component whose rows add up to no more than rounding, but all of its rows to more. */
static void rounding_of_many_rows_is_not_suspected(void **state) {
    (void)state;
    enum { N = 200 };
    gen_list_t t = gen_list(N + 2);
    gen_add(&t, 0, 0, 1.0); /* its last pivot is small beside the first */
    gen_add(&t, 1, 0, 1e-8);
    gen_add(&t, 1, 1, 2e-16);
    for (sl_int k = 2; k < N + 2; k++) {
        gen_add(&t, k, k, (N - 1) * (1.0 + 2000.0 * DBL_EPSILON));
        for (sl_int i = k + 1; i < N + 2; i++) {
            gen_add(&t, i, k, -1.0);
        }
    }
    gen_matrix_t M = matrix_of(&t, 0);
    sl_factor *F;
    sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_DEFAULT);
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    const double *D = sl_factor_view(F).D;
    assert_true(D[1] > 0.5e-16 && D[1] < 2e-16);
    assert_true(D[N + 1] > 1e-8 && D[N + 1] < 1e-7);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* [a b; b c], semidefinite: a diagonal entry 0 beside one that is not, weights whose sum overflows,
 * and pivots so small that the weights divided by them do. */
static void pairs_of_rows_are_refused(void **state) {
    (void)state;
    static const struct {
        double x[3], mass[2];
        sl_status status;
    } cases[] = {{{1.0, 1.0, 0.0}, {1.0, 1.0}, SL_ERR_PIVOT},
                 {{1.0, -1.0, 1.0}, {1.7e308, 1.7e308}, SL_ERR_PIVOT},
                 {{1e-310, -1e-310, 1e-310}, {1.0, 1.0}, SL_ERR_NOT_FINITE},
                 {{1.0, -1.0, 1.0}, {1.0, 1.0}, SL_OK}};
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const sl_csc A = {2, 2, p, i, cases[k].x};
        sl_options opt = skipping();
        sl_symbolic *S;
        sl_factor *F = NULL;
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        opt.mass = cases[k].mass;
        SL_EXPECT(cases[k].status, sl_factor_create(&F, S, &A, &opt, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* Rows are looked at in memory of their own where L is short. Without it the pivot is refused all
 * the same, with what helps any matrix. */
static void rows_without_memory_to_look_at_them(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 1, 2, 3}, i[3] = {0, 1, 2};
    static const double x[3] = {1.0, 0.0, 1.0};
    static const char *const texts[2] = {"if A is regular", "the row is 0"};
    const sl_csc A = {3, 3, p, i, x};
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    int seen[2] = {0, 0}, is_last = 0;
    for (int k = 0; !is_last; k++) {
        counter_t counter = counter_make();
        const sl_options opt = options_counted(&counter);
        sl_factor *F = NULL;
        sl_stats stats;
        counter.fail_at = k;
        const sl_status status = sl_factor_create(&F, S, &A, &opt, &stats);
        is_last = counter.calls <= (size_t)k;
        if (status != SL_ERR_MEMORY) {
            assert_int_equal(status, SL_ERR_PIVOT);
            assert_int_equal(stats.error.row, 1);
            assert_non_null(strstr(stats.error.what, texts[is_last]));
            seen[is_last]++;
        }
        COUNTER_CLEAN(&counter);
    }
    assert_true(seen[0] > 0 && seen[1] == 1);
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_zeros_in_several_trees),
        cmocka_unit_test(paths_without_an_anchor),
        cmocka_unit_test(changes_to_both_signs_are_refused),
        cmocka_unit_test(weights_that_cancel_against_the_null_vector),
        cmocka_unit_test(edges_of_weight_zero_in_both_triangles),
        cmocka_unit_test(null_pivots_of_a_sum_are_confirmed),
        cmocka_unit_test(sizes_that_overflow),
        cmocka_unit_test(pivots_that_overflow),
        cmocka_unit_test(a_regular_component_is_not_suspected),
        cmocka_unit_test(rounding_of_many_rows_is_not_suspected),
        cmocka_unit_test(pairs_of_rows_are_refused),
        cmocka_unit_test(rows_without_memory_to_look_at_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
