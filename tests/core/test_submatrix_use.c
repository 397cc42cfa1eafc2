/* test_submatrix_use.c: sl_factor_submatrix: what is refused, and how null pivots are treated */
#include "tests/lib/submatrix.h"
#include "tests/lib/saved_pair.h"

/* a pointer that is not NULL, to see that a call sets it to NULL */
static char garbage[1];
#define GARBAGE(type) ((type *)(void *)garbage)

/* What would need a matrix with the pattern of S is refused, and leaves G as it was. */
static void numbers_of_a_restriction_stay(void **state) {
    (void)state;
    for (int anew = 0; anew < 2; anew++) {
        submatrix_t t =
            submatrix_make(GEN_GRID2, 100, 1, 0, anew ? SUBSET_RANDOM : SUBSET_HALF, NULL);
        const sl_csc *B = &t.B.view;
        const sl_int row = 0;
        const double one = 1.0;
        double *entries = test_reals(1), *x = test_reals((size_t)t.count),
               *b = test_reals((size_t)t.count);
        sl_symbolic *S = GARBAGE(sl_symbolic);
        sl_factor *G = GARBAGE(sl_factor);
        sl_csc V = {t.count, 0, &row, NULL, NULL};
        size_t bytes;
        double rcond;
        assert_int_equal(t.stats.submatrix.is_anew, anew);
        assert_int_equal(sl_factor_refactor(t.G, B, NULL), SL_ERR_READ_ONLY);
        assert_int_equal(sl_factor_change_entries(t.G, B, NULL, &row, NULL, 1, NULL, NULL),
                         SL_ERR_READ_ONLY);
        assert_int_equal(sl_factor_change_entries(t.G, B, &row, &row, &one, 1, NULL, NULL),
                         SL_ERR_READ_ONLY);
        assert_int_equal(sl_factor_rank_update(t.G, &V, NULL, NULL, NULL), SL_ERR_READ_ONLY);
        assert_int_equal(pair_save_memory(NULL, &bytes, t.S, t.G), SL_ERR_MISMATCH);
        assert_int_equal(sl_factor_rcond(t.G, B, &rcond, NULL), SL_ERR_OTHER_PATTERN);
        assert_int_equal(
            sl_factor_refine(t.G, B, x, (size_t)t.count, b, (size_t)t.count, 1, 1, NULL, NULL),
            SL_ERR_OTHER_PATTERN);
        assert_int_equal(sl_factor_create(&G, t.S, B, NULL, NULL), SL_ERR_OTHER_PATTERN);
        assert_int_equal(sl_symbolic_scatter(t.S, entries, B, NULL), SL_ERR_OTHER_PATTERN);
        assert_int_equal(sl_factor_submatrix(&S, &G, t.G, B, &row, 1, NULL, NULL),
                         SL_ERR_UNSUPPORTED);
        assert_true(S == NULL && G == NULL);
        submatrix_check(&t);
        free(entries);
        free(x);
        free(b);
        submatrix_free(&t);
    }
}

/* The status of restricting y to rows, with what is wrong. */
static sl_status restriction_status(const factored_t *y, const sl_csc *A, const sl_int *rows,
                                    sl_int count, sl_stats *stats) {
    sl_symbolic *S = GARBAGE(sl_symbolic);
    sl_factor *G = GARBAGE(sl_factor);
    const sl_status status = sl_factor_submatrix(&S, &G, y->F, A, rows, count, NULL, stats);
    assert_true((S != NULL) == (status == SL_OK) && (G != NULL) == (status == SL_OK));
    sl_factor_free(G);
    sl_symbolic_free(S);
    return status;
}

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    const sl_csc *A = &y.M.view;
    sl_csc B = *A;
    sl_int rows[4] = {3, 4, 99, 3};
    sl_symbolic *S = NULL;
    sl_factor *G = NULL;
    sl_stats stats;
    assert_int_equal(restriction_status(&y, A, rows, 4, &stats), SL_ERR_ARGUMENT);
    assert_int_equal(stats.error.row, 3);
    rows[3] = 100;
    assert_int_equal(restriction_status(&y, A, rows, 4, &stats), SL_ERR_ARGUMENT);
    assert_int_equal(stats.error.row, 100);
    rows[3] = -1;
    assert_int_equal(restriction_status(&y, A, rows, 4, &stats), SL_ERR_ARGUMENT);
    assert_int_equal(stats.error.row, -1);
    assert_int_equal(restriction_status(&y, A, rows, -1, &stats), SL_ERR_ARGUMENT);
    assert_int_equal(restriction_status(&y, A, NULL, 1, &stats), SL_ERR_ARGUMENT);
    assert_int_equal(restriction_status(&y, NULL, rows, 3, &stats), SL_ERR_ARGUMENT);
    assert_int_equal(sl_factor_submatrix(NULL, &G, y.F, A, rows, 3, NULL, NULL), SL_ERR_ARGUMENT);
    assert_int_equal(sl_factor_submatrix(&S, NULL, y.F, A, rows, 3, NULL, NULL), SL_ERR_ARGUMENT);
    assert_int_equal(sl_factor_submatrix(&S, &G, NULL, A, rows, 3, NULL, NULL), SL_ERR_ARGUMENT);
    B.x = NULL;
    assert_int_equal(restriction_status(&y, &B, rows, 3, &stats), SL_ERR_ARGUMENT);
    B = *A;
    B.p = NULL;
    assert_int_equal(restriction_status(&y, &B, rows, 3, &stats), SL_ERR_ARGUMENT);
    B = *A;
    B.i = NULL;
    assert_int_equal(restriction_status(&y, &B, rows, 3, &stats), SL_ERR_ARGUMENT);
    B = *A;
    B.n_cols = 99;
    assert_int_equal(restriction_status(&y, &B, rows, 3, &stats), SL_ERR_OTHER_PATTERN);
    B.n_rows = 99;
    assert_int_equal(restriction_status(&y, &B, rows, 3, &stats), SL_ERR_OTHER_PATTERN);
    y.M.p[100]--; /* an entry less */
    assert_int_equal(restriction_status(&y, A, rows, 3, &stats), SL_ERR_OTHER_PATTERN);
    y.M.p[100]++;
    /* columns that are read are checked: with few rows all are */
    for (int wrong = 0; wrong < 4; wrong++) {
        const sl_int keep = y.M.i[y.M.p[4]], p = y.M.p[4], end = y.M.p[5];
        y.M.i[y.M.p[4]] = wrong == 0 ? -1 : wrong == 1 ? 100 : keep;
        y.M.p[4] = wrong == 2 ? -1 : p;
        y.M.p[5] = wrong == 3 ? INT32_MAX : end;
        assert_int_equal(restriction_status(&y, A, rows, 3, &stats), SL_ERR_MALFORMED);
        assert_int_equal(stats.error.column, wrong == 2 ? 3 : 4); /* 3 ends at p[4] */
        y.M.p[4] = p;
        y.M.p[5] = end;
        y.M.i[y.M.p[4]] = keep;
    }
    const sl_int begin = y.M.p[4];
    y.M.p[4] = -1; /* and column 3 is not read */
    assert_int_equal(restriction_status(&y, A, rows + 1, 2, &stats), SL_ERR_MALFORMED);
    assert_int_equal(stats.error.column, 4);
    y.M.p[4] = begin;
    assert_int_equal(restriction_status(&y, A, rows, 3, NULL), SL_OK);
    y.M.x[0] = NAN;
    assert_int_equal(sl_factor_refactor(y.F, A, NULL), SL_ERR_NOT_FINITE);
    assert_int_equal(restriction_status(&y, A, rows, 3, &stats), SL_ERR_STALE);
    factored_free(&y);
}

/* Rows in errors are those of A, whichever way was taken. */
static void failures_name_rows_of_the_whole_matrix(void **state) {
    (void)state;
    for (int shape = SUBSET_HALF; shape < SUBSET_SHAPES; shape++) {
        factored_t y = factored_make(GEN_GRID2, 225, 1, 0, NULL);
        sl_int *rows = test_ints(225), count = subset_fill(rows, 225, shape, y.S);
        const sl_int *iperm = sl_symbolic_view(y.S).iperm;
        sl_int last = rows[0];
        sl_stats stats;
        for (sl_int k = 1; k < count; k++) { /* the last pivot is the least likely to be kept */
            last = iperm[rows[k]] > iperm[last] ? rows[k] : last;
        }
        sl_int p = y.M.p[last]; /* of the lower triangle: the diagonal entry comes first */
        assert_int_equal(y.M.i[p], last);
        double keep = y.M.x[p];
        y.M.x[p] = INFINITY;
        sl_status status = restriction_status(&y, &y.M.view, rows, count, &stats);
        assert_true(status == SL_ERR_NOT_FINITE || shape == SUBSET_BOTTOM);
        if (status != SL_OK) {
            assert_int_equal(stats.error.row, last);
            assert_int_equal(stats.error.column, last);
        }
        y.M.x[p] = keep;
        for (p = y.M.p[last]; p < y.M.p[last + 1]; p++) {
            y.M.x[p] = 0.0; /* the row is empty: its pivot is null */
        }
        for (p = 0; p < y.M.p[225]; p++) {
            y.M.x[p] = y.M.i[p] == last ? 0.0 : y.M.x[p];
        }
        if (status != SL_OK) {
            sl_factor *whole = NULL;
            assert_int_equal(sl_factor_create(&whole, y.S, &y.M.view, NULL, NULL), SL_ERR_PIVOT);
            status = restriction_status(&y, &y.M.view, rows, count, &stats);
            assert_true(status == SL_OK || stats.error.row == last);
        }
        free(rows);
        factored_free(&y);
    }
}

/* Laplacians with skipped null pivots: regular without a row of each component. */
static void null_pivots_may_be_removed(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    for (int style = 0; style < GEN_STYLES; style++) {
        for (int shape = 0; shape < SUBSET_SHAPES; shape++) {
            submatrix_t t;
            memset(&t, 0, sizeof t);
            t.y = factored_make(GEN_SINGULAR, 100, 1, style, &opt);
            sl_int n = t.y.M.view.n_cols;
            t.rows = test_ints((size_t)n);
            t.count = subset_fill(t.rows, n, shape, t.y.S);
            t.B = subset_matrix(&t.y.M.view, t.rows, t.count);
            sl_status status = sl_factor_submatrix(&t.S, &t.G, t.y.F, &t.y.M.view, t.rows, t.count,
                                                   NULL, &t.stats);
            assert_int_equal(status, t.count == n ? SL_ERR_PIVOT : SL_OK);
            if (status == SL_OK) {
                submatrix_check(&t);
            } else {
                sl_int null_row, nulls;
                SL_CHECK(sl_factor_pivot_rows(t.y.F, SL_PIVOT_NULL, &null_row, NULL, 1, &nulls));
                assert_int_equal(t.stats.error.row, null_row);
            }
            submatrix_free(&t);
        }
    }
}

/* Regularization applies to the rows of R as to those of A. */
static void regularization_is_inherited(void **state) {
    (void)state;
    sl_options opt = options_none();
    sl_int *signs = test_ints(100), rows[100], *changed = test_ints(100), count;
    for (sl_int k = 0; k < 100; k++) {
        signs[k] = k % 3 == 0 ? -1 : 1;
    }
    opt.regularization = 1e-8;
    opt.signs = signs;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, &opt);
    for (int shape = SUBSET_ALL; shape < SUBSET_SHAPES; shape++) {
        sl_symbolic *S = NULL;
        sl_factor *G = NULL;
        sl_stats stats;
        sl_int size = subset_fill(rows, 100, shape, y.S);
        SL_CHECK(sl_factor_submatrix(&S, &G, y.F, &y.M.view, rows, size, NULL, &stats));
        const sl_int *iperm = sl_symbolic_view(S).iperm;
        const double *D = sl_factor_view(G).D;
        for (sl_int k = 0; k < size; k++) {
            assert_true(D[iperm[k]] * signs[rows[k]] > 0.0);
        }
        SL_CHECK(sl_factor_pivot_rows(G, SL_PIVOT_REGULARIZED, changed, NULL, 100, &count));
        assert_int_equal(count, stats.factor.regularized);
        for (sl_int k = 0; k < count; k++) {
            assert_int_equal(signs[rows[changed[k]]], -1);
        }
        sl_factor_free(G);
        sl_symbolic_free(S);
    }
    free(signs);
    free(changed);
    factored_free(&y);
}

/* A restriction has the limits of its factor, or none. Regularization has no signs here. */
static void limits_are_inherited(void **state) {
    (void)state;
    for (int has_limits = 0; has_limits < 2; has_limits++) {
        sl_options opt = options_none();
        opt.growth_limit = has_limits ? 100.0 : -1.0;
        opt.error_limit = -1.0;
        opt.regularization = 1e-8;
        factored_t y = factored_make(GEN_GRID2, 225, 1, 0, &opt);
        for (int shape = SUBSET_HALF; shape < SUBSET_SHAPES; shape++) {
            sl_int rows[225], count = subset_fill(rows, 225, shape, y.S);
            sl_stats stats;
            assert_int_equal(restriction_status(&y, &y.M.view, rows, count, &stats), SL_OK);
            /* a column that is computed, and not in the last front, gets a small pivot */
            for (sl_int k = 0; k < count && stats.submatrix.computed > 0; k++) {
                const sl_int p = y.M.p[rows[k]];
                const double keep = y.M.x[p];
                y.M.x[p] = 1e-300;
                const sl_status status = restriction_status(&y, &y.M.view, rows, count, &stats);
                assert_true(status == SL_OK || (has_limits && status == SL_ERR_INACCURATE));
                assert_true(status == SL_OK || y.M.x[y.M.p[stats.error.row]] > 0.0);
                y.M.x[p] = keep;
            }
        }
        factored_free(&y);
    }
}

/* A pivot that overflows, or an entry that is not finite, in what is computed anew: the row in the
 * error is that of the whole matrix. */
static void overflow_names_rows_of_the_whole_matrix(void **state) {
    (void)state;
    int entries = 0, pivots = 0;
    sl_options opt = options_none();
    opt.growth_limit = opt.error_limit = -1.0;
    factored_t y = factored_make(GEN_GRID2, 225, 1, 0, &opt);
    for (int shape = SUBSET_HALF; shape < SUBSET_SHAPES; shape++) {
        sl_int rows[225], count = subset_fill(rows, 225, shape, y.S);
        for (sl_int k = 0; k < 2 * count; k++) {
            const sl_int row = rows[k / 2], p = y.M.p[row];
            const double keep = y.M.x[p];
            sl_stats stats;
            y.M.x[p] = k % 2 == 0 ? INFINITY : 1e-320;
            const sl_status status = restriction_status(&y, &y.M.view, rows, count, &stats);
            if (k % 2 == 0 && status != SL_OK) {
                assert_int_equal(status, SL_ERR_NOT_FINITE);
                assert_true(stats.error.row == row && stats.error.column == row);
                entries++;
            } else if (status != SL_OK) {
                assert_int_equal(status, SL_ERR_NOT_FINITE);
                assert_in_range(stats.error.row, 0, 224);
                pivots += stats.error.column == -1;
            }
            y.M.x[p] = keep;
        }
    }
    assert_true(entries > 0 && pivots > 0);
    factored_free(&y);
}

/* Rows of zeros that are regularized have no sum of magnitudes. */
static void regularized_zeros_are_restricted(void **state) {
    (void)state;
    const sl_int p[4] = {0, 1, 2, 3}, i[3] = {0, 1, 2}, rows[2] = {2, 1};
    const double x[3] = {4.0, 0.0, 8.0}, b[2] = {8.0, 6.0};
    const sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S, *T;
    sl_factor *F, *G;
    double y[2];
    opt.regularization = 2.0;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
    SL_CHECK(sl_factor_submatrix(&T, &G, F, &A, rows, 2, NULL, NULL));
    SL_CHECK(sl_factor_solve(G, y, 2, b, 2, 1, NULL));
    assert_true(y[0] == 1.0 && y[1] == 3.0);
    sl_factor_free(F);
    sl_factor_free(G);
    sl_symbolic_free(S);
    sl_symbolic_free(T);
}

/* Rows without neighbors: their columns of L are copied with nothing below them. */
static void diagonal_matrices_are_restricted(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_DIAGONAL, 40, 1, 0, NULL);
    sl_int rows[39];
    sl_symbolic *S;
    sl_factor *G;
    sl_stats stats;
    double b[39], x[39];
    for (sl_int k = 0; k < 39; k++) {
        rows[k] = 39 - k;
        b[k] = k;
    }
    SL_CHECK(sl_factor_submatrix(&S, &G, y.F, &y.M.view, rows, 39, NULL, &stats));
    assert_int_equal(stats.submatrix.kept, 39);
    SL_CHECK(sl_factor_solve(G, x, 39, b, 39, 1, NULL));
    for (sl_int k = 0; k < 39; k++) {
        const double d = y.M.x[y.M.p[rows[k]]];
        assert_true(fabs(x[k] * d - b[k]) <= 4.0 * DBL_EPSILON * b[k]);
    }
    sl_factor_free(G);
    sl_symbolic_free(S);
    factored_free(&y);
}

static void pairs_are_unsupported(void **state) {
    (void)state;
    const sl_int p[3] = {0, 1, 1}, i[1] = {1}, row = 0; /* [0 1; 1 0] */
    const double x[1] = {1.0};
    const sl_csc A = {2, 2, p, i, x};
    factored_t y;
    memset(&y, 0, sizeof y);
    SL_CHECK(sl_symbolic_create_pivoted(&y.S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &A, NULL, NULL));
    assert_int_equal(restriction_status(&y, &A, &row, 1, NULL), SL_ERR_UNSUPPORTED);
    factored_free(&y);
}

/* The storage is inherited, and all columns are computed: also if F skips several null pivots. */
static void any_storage_and_several_null_vectors_are_restricted(void **state) {
    (void)state;
    const sl_storage storages[] = {SL_STORAGE_FLOAT, SL_STORAGE_DOUBLE};
    double *z = test_reals(2 * 225);
    for (int kind = 0; kind < 2; kind++) {
        sl_options opt = options_none();
        opt.storage = storages[kind];
        if (kind == 1) {
            opt.pivots = SL_PIVOTS_SKIP_NULL;
            opt.null_vector = z;
            opt.null_vector_count = 2;
            gen_reals(z, 2 * 225, 4);
        }
        submatrix_t t = submatrix_make(GEN_GRID2, 225, 1, 0, SUBSET_HALF, &opt);
        const size_t n = (size_t)t.count;
        double *b = test_reals(n), *x = test_reals(n), *r = test_reals(n), error;
        assert_int_equal(t.stats.submatrix.is_anew, 1);
        assert_int_equal(t.stats.factor.storage, storages[kind]);
        gen_reals(b, n, 3);
        SL_CHECK(sl_factor_solve(t.G, x, n, b, n, 1, NULL));
        SL_CHECK(sl_csc_residual(&t.B.view, r, n, &error, x, n, b, n, 1));
        assert_true(error <= (kind == 0 ? 1e-5 : 1e-14));
        if (kind == 1) {
            submatrix_check(&t);
        }
        free(b);
        free(x);
        free(r);
        submatrix_free(&t);
    }
    free(z);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_of_a_restriction_stay),
        cmocka_unit_test(invalid_arguments_are_refused),
        cmocka_unit_test(failures_name_rows_of_the_whole_matrix),
        cmocka_unit_test(null_pivots_may_be_removed),
        cmocka_unit_test(regularization_is_inherited),
        cmocka_unit_test(overflow_names_rows_of_the_whole_matrix),
        cmocka_unit_test(regularized_zeros_are_restricted),
        cmocka_unit_test(diagonal_matrices_are_restricted),
        cmocka_unit_test(limits_are_inherited),
        cmocka_unit_test(pairs_are_unsupported),
        cmocka_unit_test(any_storage_and_several_null_vectors_are_restricted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
