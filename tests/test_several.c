/* test_several.c: sums of matrices, values spread over an analysis, factors of weighted sums of them */
#include "several.h"

/* ---- sums ---- */

/* C against dense sums, c n eps with c n = 8: at most 3 parts of each of two terms, a product and a sum for each; and
 * its form. */
static void assert_is_sum(const sl_csc *C, const sl_csc *terms, const double *c) {
    sl_int n = C->n_cols;
    double *got = ref_dense(C), *one = ref_dense(&terms[0]), *other = ref_dense(&terms[1]);
    char *pattern = ref_pattern(C), *p0 = ref_pattern(&terms[0]), *p1 = ref_pattern(&terms[1]);
    SL_CHECK(sl_csc_check(C, NULL));
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = C->p[j]; p < C->p[j + 1]; p++) {
            assert_true(C->i[p] >= j && (p == C->p[j] || C->i[p] > C->i[p - 1]));
        }
        for (sl_int i = 0; i < n; i++) {
            double a = c[0] * AT(one, i, j), b = c[1] * AT(other, i, j);
            assert_true(fabs(AT(got, i, j) - (a + b)) <= 8 * DBL_EPSILON * (fabs(a) + fabs(b)));
            assert_int_equal(AT(pattern, i, j), AT(p0, i, j) | AT(p1, i, j));
        }
    }
    free(got);
    free(one);
    free(other);
    free(pattern);
    free(p0);
    free(p1);
}

static void sums_are_sums(void **state) {
    (void)state;
    const double c[TERMS] = {0.75, -3};
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        for (int style = 0; style < GEN_STYLES; style++) {
            several_t y =
                several_make((gen_kind_t)kind, 40, style, (style * 5 + 3) % GEN_STYLES, NULL);
            sl_matrix *A = several_sum(&y, c);
            sl_csc C = sl_matrix_view(A), U = sl_matrix_view(y.U);
            assert_is_sum(&C, y.terms, c);
            assert_int_equal(C.p[y.n], U.p[y.n]);
            assert_memory_equal(C.p, U.p, ((size_t)y.n + 1) * sizeof *C.p);
            if (C.p[y.n] > 0) {
                assert_memory_equal(C.i, U.i, (size_t)C.p[y.n] * sizeof *C.i);
            }
            sl_matrix_free(A);
            several_free(&y);
        }
    }
}

static void one_term_is_its_lower_triangle(void **state) {
    (void)state;
    const double one = 1;
    gen_list_t t = gen_make(GEN_RANDOM, 50, 1, 3);
    gen_matrix_t lower = gen_store(&t, gen_style(0), 1);
    for (int style = 0; style < GEN_STYLES; style++) {
        gen_matrix_t K = gen_store(&t, gen_style(style), 9);
        sl_matrix *A = NULL;
        SL_CHECK(sl_matrix_sum(&A, &one, &K.view, 1, NULL, NULL));
        sl_csc C = sl_matrix_view(A);
        assert_int_equal(C.p[50], lower.p[50]);
        assert_memory_equal(C.i, lower.i, (size_t)C.p[50] * sizeof *C.i);
        SAME_VALUES(C.x, lower.x, (size_t)C.p[50]);
        sl_matrix_free(A);
        gen_matrix_free(&K);
    }
    gen_matrix_free(&lower);
    gen_list_free(&t);
}

static void wrong_sums(void **state) {
    (void)state;
    const double c[TERMS] = {1, 1};
    several_t y = several_make(GEN_GRID2, 25, 1, 0, NULL);
    sl_matrix *A = (sl_matrix *)(void *)&y;
    sl_options half = options_none();
    sl_stats stats;
    sl_csc wrong[TERMS] = {y.terms[0], y.terms[1]};
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(NULL, c, y.terms, TERMS, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, y.terms, 0, NULL, NULL));
    assert_null(A);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, y.terms, -1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, NULL, 2, NULL, NULL));
    half.allocator.allocate = counter_allocate;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, y.terms, TERMS, &half, NULL));
    wrong[1].x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, wrong, TERMS, NULL, NULL));
    wrong[1].n_rows++;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, NULL, wrong, TERMS, NULL, NULL));
    wrong[1] = y.terms[1];
    wrong[1].n_rows = --wrong[1].n_cols; /* an index out of range */
    SL_EXPECT(SL_ERR_PATTERN, sl_matrix_sum(&A, NULL, wrong, TERMS, NULL, &stats));
    assert_int_equal(stats.error_row, y.n - 1);
    const sl_int p[3] = {0, 2, 4}, i[4] = {0, 1, 1, 1}, q[4] = {0, 1, 2, 3}, k[3] = {1, 0, 1};
    const double x[4] = {1, 1, 1, 1};
    const sl_csc small = {2, 2, p, i, x};
    wrong[1] = small;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, wrong, TERMS, NULL, NULL)); /* 25 and 2 rows */
    const sl_csc skew = {3, 3, q, k, x}; /* (1,0), (0,1), (1,2): no (2,1) */
    SL_EXPECT(SL_ERR_PATTERN, sl_matrix_sum(&A, c, &skew, 1, NULL, &stats));
    assert_true(stats.error_row == 1 && stats.error_column == 2);
    assert_null(A);
    several_free(&y);
}

/* ---- spreading ---- */

/* The order does not depend on how K is stored, and is the one of A's own factorization. */
static void every_way_of_storing_spreads_alike(void **state) {
    (void)state;
    const double one = 1;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 150, 1, 42);
        for (int of = 0; of < GEN_STYLES; of++) { /* how the analysed matrix is stored */
            gen_matrix_t A = gen_store(&t, gen_style(of), 1);
            sl_symbolic *S = NULL;
            sl_factor *plain = NULL, *F = NULL;
            SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
            SL_CHECK(sl_factor_create(&plain, S, &A.view, NULL, NULL));
            size_t size = (size_t)sl_symbolic_entries(S);
            double *first = test_reals(size), *again = test_reals(size);
            const double *values = first;
            sl_stats stats;
            sl_symbolic_stats(S, &stats);
            assert_int_equal(size, stats.nnz_a);
            SL_CHECK(sl_symbolic_spread(S, first, &A.view, NULL));
            SL_CHECK(sl_factor_create_combination(&F, S, &one, &values, 1, NULL, NULL));
            assert_same_bits(F, plain);
            for (int style = 0; style < GEN_STYLES; style++) {
                gen_matrix_t K = gen_store(&t, gen_style(style), 3);
                memset(again, 0xff, size * sizeof *again);
                SL_CHECK(sl_symbolic_spread(S, again, &K.view, NULL));
                SAME_VALUES(first, again, size);
                gen_matrix_free(&K);
            }
            free(first);
            free(again);
            sl_factor_free(F);
            sl_factor_free(plain);
            sl_symbolic_free(S);
            gen_matrix_free(&A);
        }
        gen_list_free(&t);
    }
}

/* Panels of every width, in their growing part and below it, each entry a number of its own: two that change places
 * change the factor. */
static void every_place_of_wide_panels_is_found(void **state) {
    (void)state;
    static const sl_int sizes[10] = {1, 2, 7, 8, 9, 16, 17, 63, 64, 65};
    sl_options natural = options_none();
    natural.ordering = SL_ORDERING_NATURAL;
    for (int k = 0; k < 10; k++) {
        for (int arrow = 0; arrow < 2; arrow++) { /* dense; dense with a few rows below */
            sl_int n = sizes[k] + 3 * arrow;
            gen_list_t t = gen_list(n);
            for (sl_int j = 0; j < sizes[k]; j++) {
                for (sl_int i = j; i < n; i++) {
                    gen_add(&t, i, j, i == j ? 100.0 * n + i : 1.0 + i + (double)n * j);
                }
            }
            for (sl_int i = sizes[k]; i < n; i++) {
                gen_add(&t, i, i, 1e6);
            }
            gen_matrix_t A = gen_store(&t, gen_style(4), 1); /* unsorted */
            sl_symbolic *S = NULL;
            sl_factor *plain = NULL, *F = NULL;
            SL_CHECK(sl_symbolic_create(&S, &A.view, &natural, NULL));
            SL_CHECK(sl_factor_create(&plain, S, &A.view, NULL, NULL));
            double *v = test_reals((size_t)sl_symbolic_entries(S)), one = 1;
            const double *values = v;
            SL_CHECK(sl_symbolic_spread(S, v, &A.view, NULL));
            SL_CHECK(sl_factor_create_combination(&F, S, &one, &values, 1, NULL, NULL));
            assert_same_bits(F, plain);
            free(v);
            sl_factor_free(F);
            sl_factor_free(plain);
            sl_symbolic_free(S);
            gen_matrix_free(&A);
            gen_list_free(&t);
        }
    }
}

/* The first entry, as stored, of those that are read and that the pattern has not. */
static int is_first_off(const sl_csc *K, int both, const char *has, sl_int row, sl_int column) {
    sl_int n = K->n_cols;
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = K->p[j]; p < K->p[j + 1]; p++) {
            if (!AT(has, K->i[p], j) && (!both || K->i[p] > j)) {
                return K->i[p] == row && j == column;
            }
        }
    }
    return 0;
}

/* One entry or two that the analysis has not: the first as stored is told, the array stays. */
static void entries_off_the_pattern_are_named(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID2, 16, 0, 2, NULL);
    size_t size = (size_t)sl_symbolic_entries(y.S);
    double *v = test_reals(size), *before = test_reals(size);
    sl_csc U = sl_matrix_view(y.U);
    char *has = ref_pattern(&U);
    sl_int n = y.n, others = 0;
    gen_reals(before, size, 3);
    memcpy(v, before, size * sizeof *v);
    for (sl_int i = 0; i < n; i++) {
        for (sl_int j = 0; j <= i; j++) {
            gen_list_t t = gen_list(n);
            gen_add(&t, n - 1, n - 1, 1);
            gen_add(&t, n - 1, 1, 3); /* off */
            gen_add(&t, i, j, 2);     /* perhaps */
            for (int style = 0; style < 6; style++) {
                gen_matrix_t K = gen_store(&t, gen_style(style), 1);
                sl_stats stats;
                SL_EXPECT(SL_ERR_PATTERN, sl_symbolic_spread(y.S, v, &K.view, &stats));
                assert_true(is_first_off(&K.view, style % 3 == 2, has, stats.error_row,
                                         stats.error_column));
                assert_memory_equal(v, before, size * sizeof *v);
                others += stats.error_row + stats.error_column != n;
                gen_matrix_free(&K);
            }
            gen_list_free(&t);
        }
    }
    assert_true(others > n);
    free(v);
    free(before);
    free(has);
    several_free(&y);
}

static void wrong_calls_of_spread(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID2, 16, 0, 2, NULL);
    sl_csc K = y.K.view;
    double *v = y.values[0];
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_spread(NULL, v, &K, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_spread(y.S, NULL, &K, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_spread(y.S, v, NULL, NULL));
    K.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_spread(y.S, v, &K, NULL));
    K = y.K.view;
    K.n_rows++;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_spread(y.S, v, &K, NULL));
    several_t other = several_make(GEN_GRID2, 25, 0, 2, NULL);
    SL_EXPECT(SL_ERR_PATTERN, sl_symbolic_spread(y.S, v, &other.K.view, NULL));
    const sl_int p[2] = {0, 0};
    const sl_csc empty = {0, 0, NULL, NULL, NULL}, bare = {1, 1, p, NULL, NULL};
    SL_EXPECT(SL_ERR_PATTERN, sl_symbolic_spread(y.S, v, &empty, NULL));
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &empty, NULL, NULL));
    assert_int_equal(sl_symbolic_entries(S), 0);
    SL_CHECK(sl_symbolic_spread(S, NULL, &empty, NULL));
    sl_symbolic_free(S);
    SL_CHECK(sl_symbolic_create(&S, &bare, NULL, NULL)); /* a row without an entry */
    SL_CHECK(sl_symbolic_spread(S, NULL, &bare, NULL));
    sl_symbolic_free(S);
    assert_int_equal(sl_symbolic_entries(NULL), 0);
    several_free(&other);
    several_free(&y);
}

/* ---- factors of sums ---- */

/* For every way to factor: the bits of the plain way where nothing is duplicated, L D L' = the sum everywhere. */
static void combinations_are_factors_of_sums(void **state) {
    (void)state;
    const double c[3][TERMS] = {{1, 0.3}, {2, 1e-5}, {0, 7}};
    way_list_t ways = ways_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int style = 0; style < GEN_STYLES; style++) {
            several_t y = several_make((gen_kind_t)kind, 90, style, (style + 1) % GEN_STYLES, NULL);
            int exact = !gen_style(style).duplicated && !gen_style((style + 1) % 12).duplicated;
            for (int way = 0; way < ways.count; way++) {
                sl_options opt = options_none();
                sl_factor *F = NULL;
                way_take(&opt, &ways, way);
                for (int k = 0; k < 3; k++) {
                    if (k == 0) {
                        SL_CHECK(sl_factor_create_combination(&F, y.S, c[k], several_values(&y),
                                                              TERMS, &opt, NULL));
                    } else {
                        SL_CHECK(sl_factor_refactor_combination(F, c[k], several_values(&y), TERMS,
                                                                NULL));
                    }
                    sl_factor *plain = several_plain(&y, c[k], &opt);
                    if (exact) {
                        assert_same_bits(F, plain);
                    }
                    sl_matrix *A = several_sum(&y, c[k]);
                    sl_csc view = sl_matrix_view(A);
                    NOTHING_WRONG(check_factor(F, &view));
                    sl_matrix_free(A);
                    sl_factor_free(plain);
                }
                sl_factor_free(F);
            }
            several_free(&y);
        }
    }
}

/* Many terms, more entries in a supernode than are summed at a time, one array several times. */
static void many_terms(void **state) {
    (void)state;
    several_t y = several_make(GEN_DENSE, 60, 0, 1, NULL);
    const double *values[7], c[7] = {0.5, 0.25, 1, 0.125, 0.125, -2, 2}, two[TERMS] = {1, 1};
    for (int t = 0; t < 7; t++) {
        values[t] = y.values[t == 2];
    }
    sl_factor *F = NULL, *plain = several_plain(&y, two, NULL);
    SL_CHECK(sl_factor_create_combination(&F, y.S, c, values, 7, NULL, NULL));
    sl_matrix *A = several_sum(&y, two);
    sl_csc view = sl_matrix_view(A);
    NOTHING_WRONG(check_factor(F, &view));
    SL_CHECK(sl_factor_refactor(F, &view, NULL)); /* the plain way over the same factor */
    assert_same_bits(F, plain);
    sl_matrix_free(A);
    sl_factor_free(F);
    sl_factor_free(plain);
    several_free(&y);
}

static void no_term_is_the_zero_matrix(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID2, 36, 0, 0, NULL);
    way_list_t ways = ways_present();
    const sl_csc empty = {0, 0, NULL, NULL, NULL};
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &empty, NULL, NULL));
    for (int way = 0; way < ways.count; way++) {
        sl_options opt = options_none();
        sl_stats stats;
        sl_factor *F = NULL;
        way_take(&opt, &ways, way);
        memset(&stats, 0, sizeof stats);
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create_combination(&F, y.S, NULL, NULL, 0, &opt, &stats));
        assert_null(F);
        assert_int_equal(stats.error_row, sl_symbolic_view(y.S).perm[0]);
        opt.definiteness = SL_SEMIDEFINITE;
        SL_CHECK(sl_factor_create_combination(&F, y.S, NULL, NULL, 0, &opt, &stats));
        assert_int_equal(stats.null, y.n);
        sl_factor_free(F);
        SL_CHECK(sl_factor_create_combination(&F, S, NULL, NULL, 0, &opt, NULL));
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    several_free(&y);
}

/* The entry (row, column) of a term, wherever it stands in the array. */
static void set_entry(several_t *y, int term, sl_int row, sl_int column, double value) {
    gen_matrix_t *M = term ? &y->K : &y->M;
    for (sl_int p = M->p[column]; p < M->p[column + 1]; p++) {
        if (M->i[p] == row) {
            M->x[p] = value;
            SL_CHECK(sl_symbolic_spread(y->S, y->values[term], &M->view, NULL));
            return;
        }
    }
    fail();
}

/* One of each kind in the middle of a path: on the diagonal, where both terms have an entry, or on an edge, which K
 * stores above the diagonal. */
static void what_is_not_finite_is_refused(void **state) {
    (void)state;
    static const struct {
        double m, k, edge, c[TERMS];
        sl_int row; /* with column 14; -1: a coefficient */
    } cases[9] = {{NAN, 9, 1, {1, 1}, 14},       {9, NAN, 1, {1, 1}, 14},
                  {9, INFINITY, 1, {1, 0}, 14},  {INFINITY, -INFINITY, 1, {1, 1}, 14},
                  {1e300, 9, 1, {1e300, 1}, 14}, {DBL_MAX, -DBL_MAX, 1, {1, -1}, 14},
                  {9, 9, -INFINITY, {1, 1}, 15}, {9, 9, 1, {NAN, 1}, -1},
                  {9, 9, 1, {1, -INFINITY}, -1}};
    const double good[TERMS] = {1, 1};
    way_list_t ways = ways_present();
    for (int way = 0; way < ways.count; way++) {
        sl_options opt = options_none();
        several_t y = several_make(GEN_PATH, 30, 0, 1, NULL);
        const double *const *v = several_values(&y);
        sl_factor *F = NULL, *G = NULL;
        way_take(&opt, &ways, way);
        SL_CHECK(sl_factor_create_combination(&F, y.S, good, v, TERMS, &opt, NULL));
        for (int which = 0; which < 9; which++) {
            sl_int row = cases[which].row, column = row < 0 ? -1 : 14, at = 3;
            double x = 1;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            set_entry(&y, 0, 14, 14, cases[which].m);
            set_entry(&y, 1, 14, 14, cases[which].k);
            set_entry(&y, 1, 14, 15, cases[which].edge);
            for (int again = 0; again < 2; again++) {
                SL_EXPECT(SL_ERR_NOT_FINITE,
                          again
                              ? sl_factor_refactor_combination(F, cases[which].c, v, TERMS, &stats)
                              : sl_factor_create_combination(&G, y.S, cases[which].c, v, TERMS,
                                                             &opt, &stats));
                assert_true(stats.error_row == row && stats.error_column == column);
                assert_true(stats.error_value - stats.error_value != 0.0);
                assert_true(stats.positive >= 0 && stats.positive < y.n);
                assert_null(G);
            }
            SL_EXPECT(SL_ERR_STATE, sl_inverse_diagonal(F, &x, &at, 1, NULL, NULL));
            assert_true(x == 1);
            set_entry(&y, 0, 14, 14, 9);
            set_entry(&y, 1, 14, 14, 9);
            set_entry(&y, 1, 14, 15, 0.5);
            SL_CHECK(sl_factor_refactor_combination(F, good, v, TERMS, NULL));
            SL_CHECK(sl_inverse_diagonal(F, &x, &at, 1, NULL, NULL));
        }
        sl_factor_free(F);
        several_free(&y);
    }
}

/* Whatever order the rows are eliminated in: row and column are those of the lower triangle. */
static void every_entry_that_is_not_finite_is_named(void **state) {
    (void)state;
    const double c[TERMS] = {1, 1};
    several_t y = several_make(GEN_GRID2, 49, 1, 0, NULL);
    sl_csc K = y.K.view;
    for (sl_int j = 0; j < y.n; j++) {
        for (sl_int p = K.p[j]; p < K.p[j + 1]; p++) {
            sl_factor *F = NULL;
            sl_stats stats;
            double keep = y.K.x[p];
            y.K.x[p] = NAN;
            SL_CHECK(sl_symbolic_spread(y.S, y.values[1], &K, NULL));
            SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_create_combination(
                                             &F, y.S, c, several_values(&y), TERMS, NULL, &stats));
            assert_int_equal(stats.error_row, K.i[p]);
            assert_int_equal(stats.error_column, j);
            y.K.x[p] = keep;
        }
    }
    several_free(&y);
}

static void a_null_pivot_is_named(void **state) {
    (void)state;
    gen_list_t t = gen_make(GEN_SINGULAR, 49, 1, 1);
    gen_matrix_t A = gen_store(&t, gen_style(2), 1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL, *plain = NULL;
    sl_stats one, other;
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    double *v = test_reals((size_t)sl_symbolic_entries(S)), c = 1;
    const double *values = v;
    SL_CHECK(sl_symbolic_spread(S, v, &A.view, NULL));
    memset(&one, 0, sizeof one);
    memset(&other, 0, sizeof other);
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&plain, S, &A.view, NULL, &one));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create_combination(&F, S, &c, &values, 1, NULL, &other));
    assert_int_equal(one.error_row, other.error_row);
    assert_true(one.error_value == other.error_value && one.positive == other.positive);
    free(v);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    gen_list_free(&t);
}

static void wrong_calls_of_combinations(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID2, 25, 0, 1, NULL);
    const double c[TERMS] = {1, 1}, *missing[TERMS] = {y.values[0], NULL};
    const double *const *v = several_values(&y);
    sl_factor *F = (sl_factor *)(void *)&y;
    sl_options opt = options_none();
    double x = 0;
    sl_int row = 0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_combination(NULL, y.S, c, v, TERMS, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_combination(&F, NULL, c, v, TERMS, NULL, NULL));
    assert_null(F);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_combination(&F, y.S, NULL, v, TERMS, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_combination(&F, y.S, c, NULL, TERMS, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_combination(&F, y.S, c, missing, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_combination(&F, y.S, c, v, -1, NULL, NULL));
    opt.null_tolerance = NAN;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_combination(&F, y.S, c, v, TERMS, &opt, NULL));
    opt = options_none();
    opt.isa = (sl_isa)17;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_create_combination(&F, y.S, c, v, TERMS, &opt, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_combination(NULL, c, v, TERMS, NULL));
    SL_CHECK(sl_factor_create_combination(&F, y.S, c, v, TERMS, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_combination(F, c, missing, TERMS, NULL));
    SL_EXPECT(SL_ERR_STATE, sl_inverse_diagonal(F, &x, &row, 1, NULL, NULL));
    sl_factor_free(F);
    several_free(&y);
}

/* ---- memory ---- */

static sl_status sum_and_spread(several_t *y, const sl_options *opt, counter_t *counter) {
    const double c[TERMS] = {1, 2};
    sl_matrix *A = (sl_matrix *)(void *)y;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    double *v = test_reals((size_t)sl_symbolic_entries(y->S));
    sl_status status = sl_matrix_sum(&A, c, y->terms, TERMS, opt, NULL);
    assert_true((A != NULL) == (status == SL_OK));
    if (status == SL_OK) {
        sl_csc view = sl_matrix_view(A);
        status = sl_symbolic_create(&S, &view, opt, NULL);
    }
    if (status == SL_OK) {
        v[0] = 4321;
        status = sl_symbolic_spread(S, v, &y->terms[1], NULL);
        assert_true(status == SL_OK || v[0] == 4321);
    }
    if (status == SL_OK) {
        size_t live = counter->live_blocks;
        status = sl_factor_create_combination(&F, S, c, several_values(y), TERMS, opt, NULL);
        assert_true((F != NULL) == (status == SL_OK));
        assert_true(status == SL_OK || counter->live_blocks == live);
    }
    if (status == SL_OK) {
        size_t calls = counter->calls;
        SL_CHECK(sl_factor_refactor_combination(F, c, several_values(y), TERMS, NULL));
        assert_int_equal(counter->calls, calls); /* allocates nothing */
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(A);
    free(v);
    return status;
}

static void memory_may_fail(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID2, 100, 0, 2, NULL);
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        counter.fail_at = k;
        status = sum_and_spread(&y, &opt, &counter);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
        COUNTER_CLEAN(&counter);
    }
    several_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_sums),
        cmocka_unit_test(one_term_is_its_lower_triangle),
        cmocka_unit_test(wrong_sums),
        cmocka_unit_test(every_way_of_storing_spreads_alike),
        cmocka_unit_test(every_place_of_wide_panels_is_found),
        cmocka_unit_test(entries_off_the_pattern_are_named),
        cmocka_unit_test(wrong_calls_of_spread),
        cmocka_unit_test(combinations_are_factors_of_sums),
        cmocka_unit_test(many_terms),
        cmocka_unit_test(no_term_is_the_zero_matrix),
        cmocka_unit_test(what_is_not_finite_is_refused),
        cmocka_unit_test(every_entry_that_is_not_finite_is_named),
        cmocka_unit_test(a_null_pivot_is_named),
        cmocka_unit_test(wrong_calls_of_combinations),
        cmocka_unit_test(memory_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
