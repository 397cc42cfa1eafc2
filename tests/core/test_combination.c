/* test_combination.c: factors of weighted sums of value arrays: the bits of the plain way, what is refused, memory */
#include "several.h"

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
