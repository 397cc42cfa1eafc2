/* test_dirichlet_reuse.c: rows fixed at given values by a factor of all rows: which way, when */
#include "tests/lib/dirichlet.h"

/* Creates an object with a factor of A, and checks its solutions. Returns the way it took. */
static sl_fixed_method taken(const sl_csc *A, const sl_factor *F, const sl_int *rows, sl_int count,
                             const sl_options *opt) {
    sl_fixed *D = NULL;
    sl_stats stats;
    SL_CHECK(sl_fixed_create(&D, A, rows, count, F, opt, &stats));
    assert_int_equal(stats.fixed.n_free, A->n_cols - count);
    assert_int_equal(sl_fixed_view(D).factor == NULL, stats.fixed.method == SL_FIXED_PINS);
    dirichlet_check_all(D, A, rows, count);
    SL_CHECK(sl_fixed_refactor(D, A, NULL));
    assert_true(sl_fixed_view(D).matrix.n_cols == A->n_cols - count);
    dirichlet_check_all(D, A, rows, count);
    sl_fixed_free(D);
    return stats.fixed.method;
}

static void all_ways_hold(void **state) {
    (void)state;
    int ways[3] = {0, 0, 0};
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int shape = 0; shape < SUBSET_SHAPES; shape++) {
            const int style = (5 * shape + kind) % GEN_STYLES;
            factored_t y = factored_make((gen_kind_t)kind, 300,
                                         kind == GEN_KKT || shape % 2 ? 1 : -1, style, NULL);
            const sl_int n = y.M.view.n_cols;
            sl_int *rows = test_ints((size_t)n), count = subset_fill(rows, n, shape, y.S);
            const sl_fixed_method way = taken(&y.M.view, y.F, rows, count, NULL);
            assert_true(kind != GEN_KKT || way != SL_FIXED_PINS);
            ways[way]++;
            free(rows);
            factored_free(&y);
        }
    }
    assert_true(ways[SL_FIXED_PINS] > 10 && ways[SL_FIXED_RESTRICTION] > 30);
}

static void few_rows_are_pinned_and_many_restricted(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 2500, 1, 0, NULL);
    const sl_int n = y.M.view.n_cols;
    sl_int *rows = test_ints((size_t)n), count = subset_fill(rows, n, SUBSET_FEW, y.S);
    sl_fixed *D = NULL;
    sl_stats stats;
    assert_int_equal(taken(&y.M.view, y.F, rows, 1, NULL), SL_FIXED_PINS);
    assert_int_equal(taken(&y.M.view, y.F, rows, count, NULL), SL_FIXED_RESTRICTION);
    SL_CHECK(sl_fixed_create(&D, &y.M.view, rows, 1, y.F, NULL, &stats));
    assert_true(stats.fixed.seconds_pins < stats.fixed.seconds_restriction &&
                stats.fixed.seconds_restriction < stats.fixed.seconds_submatrix);
    sl_fixed_free(D);
    free(rows);
    factored_free(&y);
}

/* A factor of other values, changed in place or without numbers is not used, nor is one where the
 * options ask for something else. */
static void an_unsuited_factor_is_not_used(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    const sl_csc *A = &y.M.view;
    sl_csc other = *A;
    const sl_int n = A->n_cols, row = 7;
    double *x = test_reals((size_t)A->p[n]), *ones = test_reals((size_t)n);
    sl_int *perm = test_ints((size_t)n), *signs = test_ints((size_t)n);
    for (sl_int k = 0; k < n; k++) {
        perm[k] = k;
        ones[k] = signs[k] = 1;
    }
    memcpy(x, A->x, (size_t)A->p[n] * sizeof *x);
    other.x = x;
    assert_int_equal(taken(&other, y.F, &row, 1, NULL), SL_FIXED_PINS); /* the same values */
    x[0] += 1.0;
    assert_int_equal(taken(&other, y.F, &row, 1, NULL), SL_FIXED_SUBMATRIX);
    for (int k = 0; k < 7; k++) {
        sl_options opt = options_none();
        opt.pivots = k == 1 || k == 2 || k == 6 ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
        opt.mass = k == 1 ? ones : NULL;
        opt.null_vector = k == 2 ? ones : NULL;
        opt.regularization = k == 3 || k == 4 ? 1e-8 : 0.0;
        opt.signs = k == 3 ? signs : NULL;
        opt.ordering = k == 5 ? SL_ORDERING_GIVEN : SL_ORDERING_ND;
        opt.perm = k == 0 || k == 5 ? perm : NULL; /* read with GIVEN only */
        assert_int_equal(taken(A, y.F, &row, 1, &opt), k == 0 ? SL_FIXED_PINS : SL_FIXED_SUBMATRIX);
    }
    x[0] = 0.0;
    x[1] = 1e300;
    assert_int_not_equal(sl_factor_refactor(y.F, &other, NULL), SL_OK);
    assert_int_equal(taken(A, y.F, &row, 1, NULL), SL_FIXED_SUBMATRIX);
    free(x);
    free(ones);
    free(perm);
    free(signs);
    factored_free(&y);
}

/* The Laplacian of grids side by side, with shift on the diagonal. */
static gen_matrix_t laplacian(int grids, sl_int side, double shift) {
    gen_list_t t = gen_list(grids * side * side);
    for (sl_int v = 0; v < t.n; v++) {
        const sl_int k = v % (side * side), right = (k + 1) % side != 0,
                     up = k + side < side * side;
        gen_add(&t, v, v, right + up + (k % side != 0) + (k >= side) + shift);
        if (right) {
            gen_add(&t, v + 1, v, -1.0);
        }
        if (up) {
            gen_add(&t, v + side, v, -1.0);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* A singular factor serves if rows of every component are fixed. */
static void a_singular_factor_needs_a_row_of_each_component(void **state) {
    (void)state;
    gen_matrix_t M = laplacian(2, 20, 0.0);
    const sl_int rows[2] = {30, 530};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_fixed *D = NULL;
    sl_stats stats;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    assert_int_equal(taken(&M.view, F, rows, 2, NULL), SL_FIXED_PINS);
    SL_EXPECT(SL_ERR_PIVOT, sl_fixed_create(&D, &M.view, rows, 1, F, NULL, &stats));
    assert_null(D);
    assert_in_range(stats.error.row, 400, 799);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A Laplacian with a tiny shift: solutions without pins are 1e12 times as large as with them. */
static void pins_that_lose_digits_are_not_used(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        gen_matrix_t M = laplacian(1, 20, k == 0 ? 1.0 : 1e-12);
        const sl_int row = 30;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
        assert_int_equal(taken(&M.view, F, &row, 1, NULL),
                         k == 0 ? SL_FIXED_PINS : SL_FIXED_RESTRICTION);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

/* Pins are refused after other values were refused, or the factor has changed, until the object has
 * a factor of its own. */
static void pins_follow_their_factor(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_csc other = y.M.view;
    const sl_int n = other.n_cols, row = 7;
    double *x = test_reals((size_t)other.p[n]), *X = test_reals((size_t)n), g = 2.0;
    sl_fixed *D = NULL;
    sl_stats stats;
    other.x = x;
    SL_CHECK(sl_fixed_create(&D, &y.M.view, &row, 1, y.F, NULL, &stats));
    assert_int_equal(stats.fixed.method, SL_FIXED_PINS);
    SL_EXPECT(SL_ERR_PIVOT, sl_fixed_refactor(D, &other, NULL)); /* all 0 */
    SL_EXPECT(SL_ERR_STALE, sl_fixed_solve(D, X, (size_t)n, NULL, 0, &g, 1, 1, NULL));
    sl_fixed_free(D);
    SL_CHECK(sl_fixed_create(&D, &y.M.view, &row, 1, y.F, NULL, &stats));
    SL_CHECK(sl_fixed_solve(D, X, (size_t)n, NULL, 0, &g, 1, 1, NULL));
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_fixed_solve(D, X, (size_t)n, NULL, 0, &g, 1, 1, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_fixed_solve(D, X, SL_ROWS(1), NULL, 0, &g, SL_ROWS(1), 1, NULL));
    SL_CHECK(sl_fixed_refactor(D, &y.M.view, &stats));
    assert_int_equal(stats.fixed.method, SL_FIXED_SUBMATRIX);
    dirichlet_check_all(D, &y.M.view, &row, 1);
    sl_fixed_free(D);
    free(x);
    free(X);
    factored_free(&y);
}

/* Every allocation fails once: of an object that pins, of one that restricts, and of its solves. */
static void memory_may_end_at_any_time(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    const sl_int n = y.M.view.n_cols;
    sl_int *rows = test_ints((size_t)n), count = subset_fill(rows, n, SUBSET_HALF, y.S);
    double *X = test_reals((size_t)n), *G = test_reals((size_t)n);
    for (int which = 0; which < 2; which++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t c = counter_make();
            sl_options opt = options_counted(&c);
            sl_fixed *D = NULL;
            sl_stats stats;
            c.fail_at = k;
            status = sl_fixed_create(&D, &y.M.view, rows, which ? count : 1, y.F, &opt, &stats);
            if (status == SL_OK) {
                assert_int_equal(stats.fixed.method, which ? SL_FIXED_RESTRICTION : SL_FIXED_PINS);
                status = sl_fixed_solve(D, X, (size_t)n, NULL, 0, G, (size_t)n, 1, NULL);
            }
            if (status == SL_OK) {
                status = sl_fixed_refactor(D, &y.M.view, NULL);
            }
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            sl_fixed_free(D);
            COUNTER_CLEAN(&c);
        }
    }
    free(rows);
    free(X);
    free(G);
    factored_free(&y);
}

/* Pins or a restriction answer no more once other values were refused. */
static void refused_values_are_not_forgotten(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 2500, 1, 0, NULL);
    const sl_int n = y.M.view.n_cols;
    sl_int *rows = test_ints((size_t)n), few = subset_fill(rows, n, SUBSET_FEW, y.S);
    double *X = test_reals((size_t)n), *g = test_reals((size_t)n), kept;
    for (int many = 0; many < 2; many++) {
        const sl_int count = many ? few : 1, at = y.M.p[n] - 1; /* the last diagonal entry */
        sl_fixed *D = NULL;
        sl_stats stats;
        assert_int_not_equal(rows[0], n - 1);
        SL_CHECK(sl_fixed_create(&D, &y.M.view, rows, count, y.F, NULL, &stats));
        assert_int_equal(stats.fixed.method, many ? SL_FIXED_RESTRICTION : SL_FIXED_PINS);
        SL_CHECK(sl_fixed_solve(D, X, (size_t)n, NULL, 0, g, (size_t)n, 1, NULL));
        kept = y.M.x[at];
        y.M.x[at] = NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_fixed_refactor(D, &y.M.view, NULL));
        SL_EXPECT(SL_ERR_STALE, sl_fixed_solve(D, X, (size_t)n, NULL, 0, g, (size_t)n, 1, NULL));
        y.M.x[at] = kept;
        SL_CHECK(sl_fixed_refactor(D, &y.M.view, NULL));
        SL_CHECK(sl_fixed_solve(D, X, (size_t)n, NULL, 0, g, (size_t)n, 1, NULL));
        sl_fixed_free(D);
    }
    free(rows);
    free(X);
    free(g);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_ways_hold),
        cmocka_unit_test(few_rows_are_pinned_and_many_restricted),
        cmocka_unit_test(an_unsuited_factor_is_not_used),
        cmocka_unit_test(a_singular_factor_needs_a_row_of_each_component),
        cmocka_unit_test(pins_that_lose_digits_are_not_used),
        cmocka_unit_test(pins_follow_their_factor),
        cmocka_unit_test(refused_values_are_not_forgotten),
        cmocka_unit_test(memory_may_end_at_any_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
