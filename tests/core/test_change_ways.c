/* test_change_ways.c: sl_factor_change_entries on factors and matrices that rank-one changes do not
 * suit */
#include "tests/lib/factored.h"

enum { SIDE = 30 };

static factored_t grid_make(sl_method method) {
    sl_options opt = options_none();
    opt.method = method;
    return factored_make(GEN_GRID2, SIDE * SIDE, 1, 0, &opt);
}

/* Adds delta to a diagonal entry, of A and of the factor. */
static void change_diagonal(factored_t *y, sl_int row, double delta, sl_stats *stats) {
    sl_int p = y->M.p[row];
    while (y->M.i[p] != row) {
        p++;
    }
    y->M.x[p] += delta;
    SL_CHECK(sl_factor_change_entries(y->F, &y->M.view, &row, &row, &delta, 1, NULL, stats));
}

/* Is the factor one of A? After a refactorization it has the bits of a new one. */
static void assert_is_factor(const factored_t *y, const sl_options *opt, int has_bits) {
    const size_t n = (size_t)y->M.view.n_cols;
    double *b = test_reals(n), *x = test_reals(n);
    sl_factor *F;
    b[0] = 1.0; /* consistent where the constants are the null space */
    b[n - 1] = -1.0;
    SL_CHECK(sl_factor_create(&F, y->S, &y->M.view, opt, NULL));
    if (has_bits) {
        assert_same_bits(y->F, F);
    } else {
        SL_CHECK(sl_factor_solve(y->F, x, n, b, n, 1, NULL));
        BACKWARD_PASSES(&y->M.view, x, n, b, n, 1);
    }
    sl_factor_free(F);
    free(b);
    free(x);
}

static void up_looking_factors_are_updated_or_refactored(void **state) {
    (void)state;
    sl_options opt = options_none();
    sl_stats stats;
    sl_int rows[SIDE * SIDE];
    double deltas[SIDE * SIDE];
    factored_t y = grid_make(SL_METHOD_UP_LOOKING);
    opt.method = SL_METHOD_UP_LOOKING;
    change_diagonal(&y, 3, 0.5, &stats);
    assert_int_equal(stats.change.method, SL_CHANGE_UPDATE);
    assert_is_factor(&y, &opt, 0);
    for (sl_int k = 0; k < SIDE * SIDE; k++) { /* too many for updates */
        sl_int p = y.M.p[k];
        while (y.M.i[p] != k) {
            p++;
        }
        rows[k] = k;
        deltas[k] = 0.25;
        y.M.x[p] += deltas[k];
    }
    SL_CHECK(
        sl_factor_change_entries(y.F, &y.M.view, rows, rows, deltas, SIDE * SIDE, NULL, &stats));
    assert_int_equal(stats.change.method, SL_CHANGE_REFACTOR);
    assert_int_equal(stats.change.reason, SL_CHANGE_CHEAPEST);
    assert_is_factor(&y, &opt, 1);
    factored_free(&y);
}

/* The column of an entry is that where it is stored. */
static void upper_triangles_are_recomputed(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL; /* and a null pivot, so that updates are unsuited */
    gen_list_t t = gen_list(SIDE * SIDE);
    uint64_t seed = 4;
    gen_edges_grid(&t, SIDE, SIDE, 1, &seed);
    gen_laplacian(&t);
    factored_t y = {gen_store(&t, gen_style(1), 1), NULL, NULL};
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, NULL, &stats));
    assert_int_equal(stats.symbolic.triangle, SL_TRIANGLE_UPPER);
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
    const sl_int rows[3] = {0, 1, 1}, columns[3] = {0, 1, 0};
    const double deltas[3] = {0.5, 0.5, -0.5};
    for (sl_int j = 0; j < 2; j++) {
        for (sl_int p = y.M.p[j]; p < y.M.p[j + 1]; p++) {
            y.M.x[p] += y.M.i[p] == j ? 0.5 : y.M.i[p] == 0 ? -0.5 : 0.0;
        }
    }
    SL_CHECK(sl_factor_change_entries(y.F, &y.M.view, rows, columns, deltas, 3, NULL, &stats));
    assert_int_equal(stats.change.method, SL_CHANGE_REACH);
    assert_int_equal(stats.factor.null, 1);
    assert_is_factor(&y, &opt, 0);
    gen_list_free(&t);
    factored_free(&y);
}

static void pivoted_factors_are_recomputed(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 3, 4}, i[4] = {1, 2, 2, 2};
    double x[4] = {2.0, 1.0, 1.0, 3.0}; /* [0 2 1; 2 0 1; 1 1 3] */
    const sl_csc A = {3, 3, p, i, x};
    const sl_int row = 2;
    const double delta = 1.0, b[3] = {1.0, 2.0, 3.0};
    double out[3];
    sl_stats stats;
    sl_symbolic *S;
    sl_factor *F;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, &stats));
    assert_true(stats.symbolic.pairs > 0);
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED,
              sl_factor_change_entries(F, NULL, &row, &row, &delta, 1, NULL, NULL));
    x[3] += delta;
    SL_CHECK(sl_factor_change_entries(F, &A, &row, &row, &delta, 1, NULL, &stats));
    assert_true(stats.change.method >= SL_CHANGE_REACH);
    assert_int_equal(stats.change.reason, SL_CHANGE_UNSUITED);
    SL_CHECK(sl_factor_solve(F, out, 3, b, 3, 1, NULL));
    BACKWARD_PASSES(&A, out, 3, b, 3, 1);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A 2 x 2 matrix [a b; b c] and its factor in natural order. */
typedef struct two_t {
    double x[3];
    sl_csc A;
    sl_symbolic *S;
    sl_factor *F;
} two_t;

static void two_make(two_t *t, double a, double b, double c, double growth_limit) {
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    sl_options opt = options_none();
    t->A.n_rows = t->A.n_cols = 2;
    t->A.p = p;
    t->A.i = i;
    t->A.x = t->x;
    t->x[0] = a;
    t->x[1] = b;
    t->x[2] = c;
    t->S = analyze_natural(&t->A, SL_RELAXATION_DEFAULT);
    opt.growth_limit = growth_limit;
    SL_CHECK(sl_factor_create(&t->F, t->S, &t->A, &opt, NULL));
}

static void two_free(two_t *t) {
    sl_factor_free(t->F);
    sl_symbolic_free(t->S);
}

/* L grows with a small first pivot: the update is refused, and so is the refactorization. With the
 * matrix of before the factor is good again. */
static void growth_beyond_the_limit_is_refused(void **state) {
    (void)state;
    two_t t;
    const sl_int row = 0;
    const double delta = -1.0 + 1e-4, b[2] = {1.0, 2.0};
    double out[2];
    sl_stats stats;
    two_make(&t, 1.0, 0.5, -1.0, 10.0);
    SL_EXPECT(SL_ERR_INACCURATE,
              sl_factor_change_entries(t.F, NULL, &row, &row, &delta, 1, NULL, &stats));
    assert_true(stats.error.row >= 0 && stats.error.row < 2);
    SL_CHECK(sl_factor_refactor(t.F, &t.A, NULL));
    t.x[0] += delta;
    SL_EXPECT(SL_ERR_INACCURATE,
              sl_factor_change_entries(t.F, &t.A, &row, &row, &delta, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve(t.F, out, 2, b, 2, 1, NULL));
    t.x[0] = 1.0;
    SL_CHECK(sl_factor_refactor(t.F, &t.A, NULL));
    SL_CHECK(sl_factor_solve(t.F, out, 2, b, 2, 1, NULL));
    BACKWARD_PASSES(&t.A, out, 2, b, 2, 1);
    two_free(&t);
}

/* What an entry off the diagonal leaves in row 1 is 16 times its pivot, and not its entry of the
 * diagonal: the change is not split by the scales of the rows, and both pivots are exact. */
static void a_small_pivot_is_no_light_row(void **state) {
    (void)state;
    static const sl_int row = 1, column = 0;
    static const double delta = -0.25;
    const double small = ldexp(1.0, -20);
    sl_stats stats;
    two_t t;
    two_make(&t, 1.0, 1.0, 1.0 + small, 0.0);
    assert_true(sl_factor_view(t.F).D[1] == small);
    SL_CHECK(sl_factor_change_entries(t.F, NULL, &row, &column, &delta, 1, NULL, &stats));
    assert_int_equal(stats.change.method, SL_CHANGE_UPDATE);
    assert_int_equal(stats.change.ranks, 3); /* the edge, and two entries of the diagonal */
    const double *D = sl_factor_view(t.F).D, wanted = 1.0 + small - 0.75 * 0.75;
    assert_true(fabs(D[0] - 1.0) <= stats.change.drift);
    assert_true(fabs(D[1] - wanted) <= stats.change.drift && stats.change.drift < 1e-12);
    two_free(&t);
}

/* The first of the rank-one changes that make up an entry overflows; the matrix itself does not. */
static void overflows_of_updates_are_refactored(void **state) {
    (void)state;
    two_t t;
    const sl_int row = 1, column = 0;
    const double delta = 1e308, b[2] = {1e308, 1.7e308}; /* x = (0, 1) */
    double out[2];
    sl_stats stats;
    two_make(&t, 1.7e308, 0.0, 1.7e308, 0.0);
    t.x[1] += delta;
    SL_CHECK(sl_factor_change_entries(t.F, &t.A, &row, &column, &delta, 1, NULL, &stats));
    assert_int_equal(stats.change.method, SL_CHANGE_REFACTOR);
    assert_int_equal(stats.change.reason, SL_CHANGE_REFUSED);
    SL_CHECK(sl_factor_solve(t.F, out, 2, b, 2, 1, NULL));
    assert_true(fabs(out[0]) <= 1e-15 && fabs(out[1] - 1.0) <= 1e-15);
    two_free(&t);
}

/* Changes a diagonal entry of a lower triangle of 5 columns whose supernodes are {0}, {1} and
 * {2, 3, 4}, and checks the solution. */
static void small_pivot(sl_int row, double delta) {
    static const sl_int p[6] = {0, 2, 5, 8, 10, 11}, i[11] = {0, 2, 1, 2, 4, 2, 3, 4, 3, 4, 4};
    double x[11] = {1, 1, 1, 1, 1, 4, 1e-3, 1e-3, 4, 0.5, 1e20}, out[5];
    const double b[5] = {1, 2, 3, 4, 5};
    const sl_csc A = {5, 5, p, i, x};
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_NONE);
    sl_factor *F;
    assert_int_equal(sl_symbolic_view(S).n_supers, 3);
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_factor_change_entries(F, NULL, &row, &row, &delta, 1, NULL, NULL));
    x[p[row]] += delta;
    const double d = sl_factor_view(F).D[row];
    assert_true(d > 0.0 && d < 2e-5);
    SL_CHECK(sl_factor_solve(F, out, 5, b, 5, 1, NULL));
    sl_factor_free(F);
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    double expected[5], most = 0.0;
    SL_CHECK(sl_factor_solve(F, expected, 5, b, 5, 1, NULL));
    for (int k = 0; k < 5; k++) {
        most = fmax(most, fabs(expected[k]));
    }
    for (int k = 0; k < 5; k++) { /* 6 digits cancel in the small pivot */
        assert_true(fabs(out[k] - expected[k]) <= 1e-9 * most);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A pivot that would be rounding in the heaviest row of its supernode is judged by its own row. */
static void small_pivots_beside_heavy_rows_are_kept(void **state) {
    (void)state;
    small_pivot(2, -2.0 + 1e-5);
    small_pivot(3, -4.0 + 1e-5);
}

/* A regularized zero matrix has no entries to measure growth and drift by. */
static void changes_of_a_zero_matrix(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 1, 2}, i[2] = {0, 1};
    const double x[2] = {0.0, 0.0}, deltas[2] = {2.0, 4.0}, b[2] = {1.0, 1.0};
    const sl_csc A = {2, 2, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    double out[2];
    opt.regularization = 1e-20;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.regularized, 2);
    SL_CHECK(sl_factor_change_entries(F, NULL, i, i, deltas, 2, NULL, &stats));
    SL_CHECK(sl_factor_solve(F, out, 2, b, 2, 1, NULL));
    assert_true(fabs(out[0] - 0.5) <= 1e-15 && fabs(out[1] - 0.25) <= 1e-15);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A regularized factor with pivots of both signs keeps them. */
static void signs_of_regularized_pivots_stay(void **state) {
    (void)state;
    sl_options opt = options_none();
    factored_t y = factored_make(GEN_KKT, 40, 1, 0, NULL);
    sl_int signs[40];
    sl_stats before, stats;
    assert_int_equal(y.M.view.n_cols, 40);
    for (sl_int k = 0; k < 40; k++) {
        assert_int_equal(y.M.i[y.M.p[k]], k);
        signs[k] = y.M.x[y.M.p[k]] > 0.0 ? 1 : -1;
    }
    opt.regularization = 1e-8;
    opt.signs = signs;
    sl_factor_free(y.F);
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, &before));
    assert_true(before.factor.positive > 0 && before.factor.negative > 0);
    for (sl_int row = 0; row < y.M.view.n_cols; row++) {
        const double d = sl_factor_view(y.F).D[sl_symbolic_view(y.S).iperm[row]];
        const double away = -d * 4.0;
        const sl_status status =
            sl_factor_change_entries(y.F, NULL, &row, &row, &away, 1, NULL, &stats);
        assert_true(status == SL_OK || status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE);
        if (status == SL_OK) {
            assert_int_equal(stats.factor.positive, before.factor.positive);
        }
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    }
    factored_free(&y);
}

/* Columns of zeros, zeros within a column, and weights of 0 change nothing and count nothing. */
static void zeros_are_no_changes(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 0, 2, 4, 6}, i[6] = {3, 4, 3, 4, 3, 4};
    static const double x[6] = {0.0, 0.0, 0.0, 0.5, 1.0, 1.0}, sigma[4] = {1.0, 1.0, 1.0, 0.0};
    factored_t y = grid_make(SL_METHOD_AUTO);
    const sl_csc V = {SIDE * SIDE, 4, p, i, x};
    const sl_csc none = {SIDE * SIDE, 1, p, NULL, NULL}, few = {SIDE * SIDE - 1, 1, p, NULL, NULL};
    sl_stats stats;
    SL_CHECK(sl_factor_rank_update(y.F, &none, NULL, NULL, &stats));
    assert_int_equal(stats.change.method, SL_CHANGE_NONE);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_rank_update(y.F, &few, NULL, NULL, NULL));
    assert_is_factor(&y, NULL, 1);
    SL_CHECK(sl_factor_rank_update(y.F, &V, sigma, NULL, &stats));
    assert_int_equal(stats.change.ranks, 1);
    y.M.x[y.M.p[4]] += 0.25; /* the diagonal comes first in its column */
    assert_int_equal(y.M.i[y.M.p[4]], 4);
    assert_is_factor(&y, NULL, 0);
    factored_free(&y);
}

static void long_lists_are_refused(void **state) {
    (void)state;
    factored_t y = grid_make(SL_METHOD_AUTO);
    const sl_int row = 0, wrong[2] = {-1, SIDE * SIDE};
    const double one = 1.0;
    sl_stats stats;
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_factor_change_entries(y.F, NULL, &row, &row, &one, INT32_MAX / 4 + 1, NULL, NULL));
    for (int k = 0; k < 2; k++) {
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_change_entries(y.F, NULL, &row, &wrong[k], &one, 1, NULL, &stats));
        assert_int_equal(stats.error.column, wrong[k]);
    }
    assert_is_factor(&y, NULL, 1);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(up_looking_factors_are_updated_or_refactored),
        cmocka_unit_test(upper_triangles_are_recomputed),
        cmocka_unit_test(pivoted_factors_are_recomputed),
        cmocka_unit_test(growth_beyond_the_limit_is_refused),
        cmocka_unit_test(a_small_pivot_is_no_light_row),
        cmocka_unit_test(overflows_of_updates_are_refactored),
        cmocka_unit_test(small_pivots_beside_heavy_rows_are_kept),
        cmocka_unit_test(changes_of_a_zero_matrix),
        cmocka_unit_test(signs_of_regularized_pivots_stay),
        cmocka_unit_test(zeros_are_no_changes),
        cmocka_unit_test(long_lists_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
