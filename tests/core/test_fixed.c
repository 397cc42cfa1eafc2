/* test_fixed.c: rows fixed at given values: solutions, errors, options, new values, views */
#include "tests/lib/fixed_rows.h"
#include "tests/lib/parallel_for.h"

static void solutions_hold_in_free_rows(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int shape = 0; shape < SUBSET_SHAPES; shape++) {
            const int style = (5 * shape + kind) % GEN_STYLES;
            factored_t y = factored_make((gen_kind_t)kind, 90, 1, style, NULL);
            const sl_int n = y.M.view.n_cols;
            sl_int *rows = test_ints((size_t)n), count = subset_fill(rows, n, shape, y.S);
            sl_fixed *D = NULL;
            sl_stats stats;
            SL_CHECK(sl_fixed_create(&D, &y.M.view, rows, count, NULL, &stats));
            assert_int_equal(stats.fixed.n_free, n - count);
            assert_int_equal(stats.factor.positive + stats.factor.negative, n - count);
            fixed_check_all(D, &y.M.view, rows, count);
            sl_fixed_free(D);
            free(rows);
            factored_free(&y);
        }
    }
}

/* The numbers of free and fixed rows do not matter: small systems are 0, or singular as a whole. */
static void a_laplacian_with_one_fixed_row(void **state) {
    (void)state;
    gen_list_t t = gen_make(GEN_SINGULAR, 49, 1, 1);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    const sl_int row = 24;
    const double g = 7.0;
    double x[49];
    sl_fixed *D = NULL;
    sl_stats stats;
    SL_EXPECT(SL_ERR_PIVOT, sl_fixed_create(&D, &M.view, NULL, 0, NULL, &stats));
    assert_null(D);
    assert_in_range(stats.error.row, 0, 48);
    SL_CHECK(sl_fixed_create(&D, &M.view, &row, 1, NULL, NULL));
    SL_CHECK(sl_fixed_solve(D, x, 49, NULL, 0, &g, 1, 1, NULL));
    for (int k = 0; k < 49; k++) {
        assert_true(fabs(x[k] - 7.0) < 1e-12);
    }
    sl_fixed_free(D);
    sl_fixed_free(NULL);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* Two paths 0-1-2 and 3-4-5: rows are fixed in the first one only. */
static const sl_int two_p[7] = {0, 2, 4, 5, 7, 9, 10}, two_i[10] = {0, 1, 1, 2, 2, 3, 4, 4, 5, 5};
static const double two_x[10] = {1, -1, 2, -1, 1, 1, -1, 2, -1, 1};
static const sl_csc two_paths = {6, 6, two_p, two_i, two_x};

static void a_singular_free_part_is_named_by_its_row(void **state) {
    (void)state;
    const sl_int rows[2] = {2, 0};
    const double mass[6] = {9, 9, 9, 1, 2, 3}, g[2] = {5, 1}, b[6] = {0, 0, 0, 1, 0, 0};
    double x[6], mean;
    sl_options opt = options_none();
    sl_fixed *D = NULL;
    sl_stats stats;
    SL_EXPECT(SL_ERR_PIVOT, sl_fixed_create(&D, &two_paths, rows, 2, NULL, &stats));
    assert_in_range(stats.error.row, 3, 5);
    assert_int_equal(stats.error.column, -1);
    SL_EXPECT(SL_ERR_PIVOT, sl_fixed_create(&D, &two_paths, rows, 2, NULL, NULL));
    opt.pivots = SL_PIVOTS_SKIP_NULL; /* b has to be in balance there */
    SL_CHECK(sl_fixed_create(&D, &two_paths, rows, 2, &opt, NULL));
    SL_EXPECT(SL_ERR_INCONSISTENT, sl_fixed_solve(D, x, 6, b, 6, g, 2, 1, NULL));
    SL_CHECK(sl_fixed_solve(D, x, 6, NULL, 0, g, 2, 1, NULL));
    assert_true(fabs(x[1] - 3.0) < 1e-14 && fabs(x[4] - x[3]) < 1e-14);
    sl_fixed_free(D);
    opt.mass = mass;
    SL_CHECK(sl_fixed_create(&D, &two_paths, rows, 2, &opt, NULL));
    SL_CHECK(sl_fixed_solve(D, x, 6, b, 6, g, 2, 1, NULL));
    mean = x[3] + 2 * x[4] + 3 * x[5];
    assert_true(fabs(mean) < 1e-14 && x[3] > 0.1 && fabs(x[1] - 3.0) < 1e-14);
    sl_fixed_free(D);
}

static void wrong_arguments_are_named(void **state) {
    (void)state;
    const sl_int twice[2] = {4, 4}, beyond[2] = {1, 6}, below[2] = {1, -2}, good[2] = {0, 5};
    const sl_int perm[6] = {0, 1, 2, 3, 4, 4};
    const double g[4] = {1, 2, 3, 4};
    double X[12], Y[12];
    sl_options opt = options_none();
    sl_fixed *D = NULL;
    sl_stats stats;
    sl_csc A = two_paths;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(NULL, &A, good, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, NULL, good, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, NULL, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, good, -1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, twice, 2, NULL, &stats));
    assert_int_equal(stats.error.row, 4);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, beyond, 2, NULL, &stats));
    assert_int_equal(stats.error.row, 6);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, below, 2, NULL, &stats));
    assert_int_equal(stats.error.row, -2);
    opt.ordering = SL_ORDERING_GIVEN;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, good, 2, &opt, NULL));
    opt.perm = perm;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, good, 2, &opt, &stats));
    assert_int_equal(stats.error.row, 5);
    opt = options_none();
    opt.block_size = 4;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, good, 2, &opt, NULL));
    opt.block_size = -1;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, good, 2, &opt, NULL));
    opt.block_size = 0;
    opt.regularization = -1.0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, good, 2, &opt, NULL));
    A.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, good, 2, NULL, NULL));
    A = two_paths;
    A.n_rows = 7;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, good, 2, NULL, NULL));
    assert_null(D);

    SL_CHECK(sl_fixed_create(&D, &two_paths, good, 2, NULL, NULL));
    memset(X, 0x55, sizeof X);
    memcpy(Y, X, sizeof X);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_solve(NULL, X, 6, NULL, 0, g, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_solve(D, NULL, 6, NULL, 0, g, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_solve(D, X, 5, NULL, 0, g, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_solve(D, X, 6, X, 7, g, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_solve(D, X, 6, NULL, 0, NULL, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_solve(D, X, 6, NULL, 0, g, 1, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_solve(D, X, 6, NULL, 0, g, SL_ROWS(1), 2, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_solve(D, X, 6, NULL, 0, g, 2, -1, NULL));
    assert_memory_equal(X, Y, sizeof X);
    SL_CHECK(sl_fixed_solve(D, NULL, 0, NULL, 0, NULL, 0, 0, NULL));
    sl_fixed_free(D);
}

/* Entries between fixed rows may be anything; others are named. */
static void values_that_are_not_finite(void **state) {
    (void)state;
    const sl_int rows[3] = {0, 1, 5};
    double x[10], g[3] = {1, 2, 3}, out[6];
    sl_csc A = two_paths;
    sl_fixed *D = NULL;
    sl_stats stats;
    A.x = x;
    for (int k = 0; k < 10; k++) {
        const sl_int row = two_i[k], column = k < 5 ? k / 2 : 3 + (k - 5) / 2;
        const int is_row_fixed = row < 2 || row == 5, is_column_fixed = column < 2 || column == 5;
        memcpy(x, two_x, sizeof x);
        x[k] = k % 2 ? NAN : INFINITY;
        if (is_row_fixed && is_column_fixed) {
            SL_CHECK(sl_fixed_create(&D, &A, rows, 3, NULL, NULL));
            SL_CHECK(sl_fixed_refactor(D, &A, NULL));
            sl_fixed_free(D);
            continue;
        }
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_fixed_create(&D, &A, rows, 3, NULL, &stats));
        assert_int_equal(stats.error.row, row);
        assert_int_equal(stats.error.column, column);
        SL_CHECK(sl_fixed_create(&D, &two_paths, rows, 3, NULL, NULL));
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_fixed_refactor(D, &A, &stats));
        assert_int_equal(stats.error.row, row);
        assert_int_equal(stats.error.column, column);
        SL_EXPECT(SL_ERR_STALE, sl_fixed_solve(D, out, 6, NULL, 0, g, 3, 1, NULL));
        sl_fixed_free(D);
    }
    SL_CHECK(sl_fixed_create(&D, &two_paths, rows, 3, NULL, NULL));
    g[0] = NAN; /* has no free neighbor */
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_fixed_solve(D, out, 6, NULL, 0, g, 3, 1, NULL));
    sl_fixed_free(D);
}

/* New values give the bits of a new object. A failure is refused until the next success. */
static void refactoring_equals_creating(void **state) {
    (void)state;
    for (int style = 0; style < GEN_STYLES; style++) {
        factored_t y = factored_make(GEN_GRID2, 100, 1, style, NULL);
        sl_csc other = y.M.view;
        const sl_int n = other.n_cols, nnz = other.p[n];
        sl_int rows[100], count = subset_fill(rows, n, SUBSET_STRIPES, y.S);
        double *x = test_reals((size_t)nnz), *b = test_reals((size_t)n), g[100], got[100],
               want[100];
        sl_fixed *D = NULL, *E = NULL;
        sl_stats stats;
        gen_reals(b, (size_t)n, 1);
        gen_reals(g, 100, 2);
        for (sl_int k = 0; k < nnz; k++) {
            x[k] = 3.0 * y.M.x[k];
        }
        other.x = x;
        SL_CHECK(sl_fixed_create(&D, &y.M.view, rows, count, NULL, NULL));
        SL_CHECK(sl_fixed_create(&E, &other, rows, count, NULL, NULL));
        SL_CHECK(sl_fixed_refactor(D, &other, &stats));
        SL_CHECK(sl_fixed_solve(D, got, 100, b, 100, g, 100, 1, NULL));
        SL_CHECK(sl_fixed_solve(E, want, 100, b, 100, g, 100, 1, NULL));
        assert_memory_equal(got, want, sizeof got);
        assert_same_bits(sl_fixed_view(D).factor, sl_fixed_view(E).factor);

        memset(x, 0, (size_t)nnz * sizeof *x);
        SL_EXPECT(SL_ERR_PIVOT, sl_fixed_refactor(D, &other, &stats));
        assert_int_equal(rows[0] == stats.error.row, 0);
        SL_EXPECT(SL_ERR_PIVOT, sl_fixed_refactor(D, &other, NULL));
        SL_EXPECT(SL_ERR_STALE, sl_fixed_solve(D, got, 100, b, 100, g, 100, 1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_refactor(NULL, &other, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_refactor(D, NULL, NULL));
        other.x = NULL;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_refactor(D, &other, NULL));
        SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_fixed_refactor(D, &two_paths, NULL));
        SL_CHECK(sl_fixed_refactor(D, &y.M.view, NULL));
        SL_CHECK(sl_fixed_solve(D, got, 100, b, 100, g, 100, 1, NULL));
        sl_fixed_free(D);
        sl_fixed_free(E);
        free(x);
        free(b);
        factored_free(&y);
    }
}

/* A pattern of the same size, too, is another one. */
static void another_pattern_is_refused(void **state) {
    (void)state;
    const sl_int i[10] = {0, 2, 1, 2, 2, 3, 4, 4, 5, 5}, rows[2] = {0, 3};
    sl_csc A = two_paths;
    sl_fixed *D = NULL;
    SL_CHECK(sl_fixed_create(&D, &A, rows, 2, NULL, NULL));
    A.i = i;
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_fixed_refactor(D, &A, NULL));
    A.n_rows = 7;
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_fixed_refactor(D, &A, NULL));
    sl_fixed_free(D);
}

/* options.perm and the arrays of rows are those of A; blocks stay that are free as a whole. */
static void options_are_in_rows_of_the_matrix(void **state) {
    (void)state;
    const sl_int perm[6] = {5, 0, 3, 1, 4, 2}, fixed[2] = {0, 3}, signs[6] = {0, 1, -1, 0, 1, 1};
    const double ones[12] = {1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1};
    sl_int wrong[6];
    double x[10];
    sl_csc A = two_paths;
    sl_options opt = options_none();
    sl_fixed *D = NULL;
    sl_stats stats;
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = perm;
    opt.relaxation = SL_RELAXATION_NONE;
    SL_CHECK(sl_fixed_create(&D, &A, fixed, 2, &opt, NULL));
    const sl_fixed_arrays v = sl_fixed_view(D);
    const sl_int *order = sl_symbolic_view(v.symbolic).perm;
    assert_int_equal(v.n_free, 4);
    assert_int_equal(v.n_fixed, 2);
    assert_memory_equal(v.fixed_rows, fixed, sizeof fixed);
    for (sl_int k = 0, at[2] = {0, 0}; k < 4; k++) { /* each of the two paths in the given order */
        const sl_int row = v.free_rows[order[k]];
        const sl_int want[2][2] = {{1, 2}, {5, 4}};
        assert_int_equal(row, want[row > 2][at[row > 2]++]);
    }
    sl_fixed_free(D);

    opt = options_none();
    opt.regularization = 1e-8;
    opt.signs = signs;
    memcpy(x, two_x, sizeof x);
    x[4] = -3.0; /* the diagonal of row 2 */
    A.x = x;
    SL_CHECK(sl_fixed_create(&D, &A, fixed, 2, &opt, &stats));
    assert_int_equal(stats.factor.regularized, 0);
    assert_int_equal(stats.factor.negative, 1);
    sl_fixed_free(D);
    memcpy(wrong, signs, sizeof wrong);
    wrong[4] = 2;
    opt.signs = wrong;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &A, fixed, 2, &opt, &stats));
    assert_int_equal(stats.error.row, 4);

    opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.null_vector = ones;
    opt.null_vector_count = 2;
    SL_CHECK(sl_fixed_create(&D, &two_paths, fixed, 1, &opt, &stats));
    assert_int_equal(stats.factor.null, 1);
    sl_fixed_free(D);
    opt.null_vector_count = 33; /* is refused before columns are read that are not there */
    SL_EXPECT(SL_ERR_ARGUMENT, sl_fixed_create(&D, &two_paths, fixed, 1, &opt, &stats));
    opt.null_vector_count = 0;
    SL_CHECK(sl_fixed_create(&D, &two_paths, fixed, 1, &opt, &stats));
    sl_fixed_free(D);

    opt = options_none();
    for (int k = 0; k < 3; k++) { /* whole blocks; parts of blocks; none are left */
        const sl_int rows[3][6] = {{2, 3}, {1, 3}, {0, 1, 2, 3, 4, 5}};
        opt.block_size = 2;
        SL_CHECK(sl_fixed_create(&D, &two_paths, rows[k], k < 2 ? 2 : 6, &opt, NULL));
        sl_fixed_free(D);
    }
    const sl_int shifted[2] = {0, 5};
    SL_CHECK(sl_fixed_create(&D, &two_paths, shifted, 2, &opt, NULL));
    sl_fixed_free(D);
}

/* What is in the view serves local solves: the same bits. */
static void a_view_serves_plans(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 144, 1, 2, NULL);
    const sl_int n = y.M.view.n_cols, b_row = 5, x_row = 60;
    sl_int rows[144], count = subset_fill(rows, n, SUBSET_STRIPES, y.S);
    double b[144] = {0.0}, g[144] = {0.0}, x[144], local, one = 1.0;
    sl_fixed *D = NULL;
    SL_CHECK(sl_fixed_create(&D, &y.M.view, rows, count, NULL, NULL));
    const sl_fixed_arrays v = sl_fixed_view(D);
    assert_int_equal(v.matrix.n_cols, v.n_free);
    b[v.free_rows[b_row]] = 1.0;
    SL_CHECK(sl_fixed_solve(D, x, 144, b, 144, g, 144, 1, NULL));
    SL_CHECK(sl_local_solve(v.factor, &b_row, 1, &x_row, 1, &local, 1, &one, 1, 1, NULL, NULL));
    assert_true(local == x[v.free_rows[x_row]]);
    sl_fixed_free(D);
    assert_int_equal(sl_fixed_view(NULL).n_free, 0);
    factored_free(&y);
}

/* With threads, of the factor and of the workspace, solutions have the same bits. */
static void threads_change_no_bit(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 2500, 1, 0, NULL);
    const sl_int n = y.M.view.n_cols;
    int calls = 0;
    sl_options opt = options_none();
    opt.threads.count = 3;
    opt.threads.run = run_backwards;
    opt.threads.context = &calls;
    sl_int *rows = test_ints((size_t)n), count = subset_fill(rows, n, SUBSET_FEW, y.S);
    double *X = test_reals(2 * (size_t)n), *Y = X + n, *G = test_reals((size_t)n);
    sl_fixed *D = NULL, *E = NULL;
    sl_work *W = NULL;
    gen_reals(G, (size_t)n, 1);
    SL_CHECK(sl_work_create(&W, &opt));
    SL_CHECK(sl_fixed_create(&D, &y.M.view, rows, count, NULL, NULL));
    SL_CHECK(sl_fixed_create(&E, &y.M.view, rows, count, &opt, NULL));
    SL_CHECK(sl_fixed_solve(D, X, (size_t)n, NULL, 0, G, (size_t)n, 1, NULL));
    SL_CHECK(sl_fixed_solve(E, Y, (size_t)n, NULL, 0, G, (size_t)n, 1, W));
    assert_memory_equal(X, Y, (size_t)n * sizeof *X);
    sl_fixed_free(D);
    sl_fixed_free(E);
    sl_work_free(W);
    free(rows);
    free(X);
    free(G);
    factored_free(&y);
}

/* Nothing is allocated once the workspace has grown; without memory nothing is written. */
static void solves_allocate_nothing(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    const sl_int rows[2] = {3, 50};
    const double g[4] = {1, 2, 3, 4};
    double X[200], before[200];
    counter_t c = counter_make();
    const sl_options opt = options_counted(&c);
    sl_fixed *D = NULL;
    SL_CHECK(sl_fixed_create(&D, &y.M.view, rows, 2, &opt, NULL));
    gen_reals(X, 200, 1);
    memcpy(before, X, sizeof X);
    sl_work *W = work_failing(&c, 0);
    SL_EXPECT(SL_ERR_MEMORY, sl_fixed_solve(D, X, 100, X, 100, g, 2, 2, W));
    assert_memory_equal(X, before, sizeof X);
    c.fail_at = -1;
    SL_CHECK(sl_fixed_solve(D, X, 100, X, 100, g, 2, 2, W));
    const size_t calls = c.calls;
    SL_CHECK(sl_fixed_solve(D, X, 100, X, 100, g, 2, 2, W));
    SL_CHECK(sl_fixed_refactor(D, &y.M.view, NULL));
    assert_int_equal(c.calls, calls);
    c.fail_at = (int64_t)calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_fixed_solve(D, X, 100, X, 100, g, 2, 2, NULL));
    sl_work_free(W);
    sl_fixed_free(D);
    COUNTER_CLEAN(&c);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_hold_in_free_rows),
        cmocka_unit_test(a_laplacian_with_one_fixed_row),
        cmocka_unit_test(a_singular_free_part_is_named_by_its_row),
        cmocka_unit_test(wrong_arguments_are_named),
        cmocka_unit_test(values_that_are_not_finite),
        cmocka_unit_test(refactoring_equals_creating),
        cmocka_unit_test(another_pattern_is_refused),
        cmocka_unit_test(options_are_in_rows_of_the_matrix),
        cmocka_unit_test(a_view_serves_plans),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(solves_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
