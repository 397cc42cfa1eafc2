/* test_combination.c: sl_factor_create_sums of one sum: bits of a factor of the summed matrix,
 * errors */
#include "tests/lib/matrix_pair.h"

/* With every method and instruction set: without duplicates the bits of the factor of the summed
 * matrix, and L D L' = the sum for all storage styles. */
static void a_combination_has_the_bits_of_the_factored_sum(void **state) {
    (void)state;
    const double c[3][TERMS] = {{1, 0.3}, {2, 1e-5}, {0, 7}};
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int style = 0; style < GEN_STYLES; style++) {
            matrix_pair_t y =
                matrix_pair_make((gen_kind_t)kind, 90, style, (style + 1) % GEN_STYLES, NULL);
            int exact = !gen_style(style).duplicated && !gen_style((style + 1) % 12).duplicated;
            for (int variant = 0; variant < variants.count; variant++) {
                sl_options opt = options_none();
                sl_factor *F = NULL;
                options_set_variant(&opt, &variants, variant);
                for (int k = 0; k < 3; k++) {
                    if (k == 0) {
                        SL_CHECK(sl_factor_create_sums(&F, 1, y.S, c[k], matrix_pair_values(&y),
                                                       TERMS, &opt, NULL, NULL));
                    } else {
                        SL_CHECK(sl_factor_refactor_sums(&F, 1, c[k], matrix_pair_values(&y), TERMS,
                                                         NULL, NULL, NULL));
                    }
                    sl_factor *plain = matrix_pair_factor(&y, c[k], &opt);
                    if (exact) {
                        assert_same_bits(F, plain);
                    }
                    sl_matrix *A = matrix_pair_sum(&y, c[k]);
                    sl_csc view = sl_matrix_view(A);
                    NOTHING_WRONG(check_factor(F, &view));
                    sl_matrix_free(A);
                    sl_factor_free(plain);
                }
                sl_factor_free(F);
            }
            matrix_pair_free(&y);
        }
    }
}

/* Many terms, more entries in a supernode than one block of the summation holds, one array given
 * several times. */
static void a_combination_of_many_terms_has_the_same_bits(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_DENSE, 60, 0, 1, NULL);
    const double *values[7], c[7] = {0.5, 0.25, 1, 0.125, 0.125, -2, 2}, two[TERMS] = {1, 1};
    for (int t = 0; t < 7; t++) {
        values[t] = y.values[t == 2];
    }
    sl_factor *F = NULL, *plain = matrix_pair_factor(&y, two, NULL);
    SL_CHECK(sl_factor_create_sums(&F, 1, y.S, c, values, 7, NULL, NULL, NULL));
    sl_matrix *A = matrix_pair_sum(&y, two);
    sl_csc view = sl_matrix_view(A);
    NOTHING_WRONG(check_factor(F, &view));
    SL_CHECK(sl_factor_refactor(F, &view, NULL)); /* the matrix of the sum into the same factor */
    assert_same_bits(F, plain);
    y.values[0][0] = NAN; /* in the first block of several */
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor_sums(&F, 1, c, values, 7, NULL, NULL, NULL));
    sl_matrix_free(A);
    sl_factor_free(F);
    sl_factor_free(plain);
    matrix_pair_free(&y);
}

static void a_combination_of_no_terms_is_the_zero_matrix(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 36, 0, 0, NULL);
    variant_list_t variants = variants_present();
    const sl_csc empty = {0, 0, NULL, NULL, NULL};
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &empty, NULL, NULL));
    for (int variant = 0; variant < variants.count; variant++) {
        sl_options opt = options_none();
        sl_stats stats;
        sl_factor *F = NULL;
        options_set_variant(&opt, &variants, variant);
        memset(&stats, 0, sizeof stats);
        SL_EXPECT(SL_ERR_PIVOT,
                  sl_factor_create_sums(&F, 1, y.S, NULL, NULL, 0, &opt, NULL, &stats));
        assert_null(F);
        assert_int_equal(stats.error.row, sl_symbolic_view(y.S).perm[0]);
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        SL_CHECK(sl_factor_create_sums(&F, 1, y.S, NULL, NULL, 0, &opt, NULL, &stats));
        assert_int_equal(stats.factor.null, y.n);
        sl_factor_free(F);
        SL_CHECK(sl_factor_create_sums(&F, 1, S, NULL, NULL, 0, &opt, NULL, NULL));
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    matrix_pair_free(&y);
}

/* Sets the entry (row, column) of a term, wherever it is in the array. */
static void set_entry(matrix_pair_t *y, int term, sl_int row, sl_int column, double value) {
    gen_matrix_t *M = term ? &y->K : &y->M;
    for (sl_int p = M->p[column]; p < M->p[column + 1]; p++) {
        if (M->i[p] == row) {
            M->x[p] = value;
            SL_CHECK(sl_symbolic_scatter(y->S, y->values[term], &M->view, NULL));
            return;
        }
    }
    fail();
}

/* An entry of each kind in the middle of a path: on the diagonal, where both terms have an entry,
 * or on an edge that K stores above the diagonal. */
static void values_that_are_not_finite_are_refused(void **state) {
    (void)state;
    static const struct {
        double m, k, edge, c[TERMS];
        sl_int row; /* the entry is (row, 14); -1: a coefficient */
    } cases[9] = {{NAN, 9, 1, {1, 1}, 14},       {9, NAN, 1, {1, 1}, 14},
                  {9, INFINITY, 1, {1, 0}, 14},  {INFINITY, -INFINITY, 1, {1, 1}, 14},
                  {1e300, 9, 1, {1e300, 1}, 14}, {DBL_MAX, -DBL_MAX, 1, {1, -1}, 14},
                  {9, 9, -INFINITY, {1, 1}, 15}, {9, 9, 1, {NAN, 1}, -1},
                  {9, 9, 1, {1, -INFINITY}, -1}};
    const double good[TERMS] = {1, 1};
    variant_list_t variants = variants_present();
    for (int variant = 0; variant < variants.count; variant++) {
        sl_options opt = options_none();
        matrix_pair_t y = matrix_pair_make(GEN_PATH, 30, 0, 1, NULL);
        const double *const *v = matrix_pair_values(&y);
        sl_factor *F = NULL, *G = NULL;
        options_set_variant(&opt, &variants, variant);
        SL_CHECK(sl_factor_create_sums(&F, 1, y.S, good, v, TERMS, &opt, NULL, NULL));
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
                          again ? sl_factor_refactor_sums(&F, 1, cases[which].c, v, TERMS, NULL,
                                                          NULL, &stats)
                                : sl_factor_create_sums(&G, 1, y.S, cases[which].c, v, TERMS, &opt,
                                                        NULL, &stats));
                assert_true(stats.error.row == row && stats.error.column == column);
                assert_true(stats.error.value - stats.error.value != 0.0);
                assert_true(stats.factor.positive >= 0 && stats.factor.positive < y.n);
                assert_null(G);
            }
            SL_EXPECT(SL_ERR_STALE, sl_inverse_diagonal(F, &x, &at, 1, NULL, NULL));
            assert_true(x == 1);
            set_entry(&y, 0, 14, 14, 9);
            set_entry(&y, 1, 14, 14, 9);
            set_entry(&y, 1, 14, 15, 0.5);
            SL_CHECK(sl_factor_refactor_sums(&F, 1, good, v, TERMS, NULL, NULL, NULL));
            SL_CHECK(sl_inverse_diagonal(F, &x, &at, 1, NULL, NULL));
        }
        sl_factor_free(F);
        matrix_pair_free(&y);
    }
}

/* Whatever the order of elimination, row and column are those of the entry in the lower
 * triangle. */
static void the_entry_that_is_not_finite_is_reported(void **state) {
    (void)state;
    const double c[TERMS] = {1, 1};
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 49, 1, 0, NULL);
    sl_csc K = y.K.view;
    for (sl_int j = 0; j < y.n; j++) {
        for (sl_int p = K.p[j]; p < K.p[j + 1]; p++) {
            sl_factor *F = NULL;
            sl_stats stats;
            double keep = y.K.x[p];
            y.K.x[p] = NAN;
            SL_CHECK(sl_symbolic_scatter(y.S, y.values[1], &K, NULL));
            SL_EXPECT(SL_ERR_NOT_FINITE,
                      sl_factor_create_sums(&F, 1, y.S, c, matrix_pair_values(&y), TERMS, NULL,
                                            NULL, &stats));
            assert_int_equal(stats.error.row, K.i[p]);
            assert_int_equal(stats.error.column, j);
            y.K.x[p] = keep;
        }
    }
    matrix_pair_free(&y);
}

static void a_null_pivot_is_reported(void **state) {
    (void)state;
    gen_list_t t = gen_make(GEN_SINGULAR, 49, 1, 1);
    gen_matrix_t A = gen_store(&t, gen_style(2), 1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL, *plain = NULL;
    sl_stats one, other;
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    double *v = test_reals((size_t)scatter_length(S)), c = 1;
    const double *values = v;
    SL_CHECK(sl_symbolic_scatter(S, v, &A.view, NULL));
    memset(&one, 0, sizeof one);
    memset(&other, 0, sizeof other);
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&plain, S, &A.view, NULL, &one));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create_sums(&F, 1, S, &c, &values, 1, NULL, NULL, &other));
    assert_int_equal(one.error.row, other.error.row);
    assert_true(one.error.value == other.error.value &&
                one.factor.positive == other.factor.positive);
    free(v);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    gen_list_free(&t);
}

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 25, 0, 1, NULL);
    const double c[TERMS] = {1, 1}, *missing[TERMS] = {y.values[0], NULL};
    const double *const *v = matrix_pair_values(&y);
    sl_factor *F = (sl_factor *)(void *)&y;
    sl_options opt = options_none();
    double x = 0;
    sl_int row = 0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(NULL, 1, y.S, c, v, TERMS, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(&F, 1, NULL, c, v, TERMS, NULL, NULL, NULL));
    assert_null(F);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(&F, 1, y.S, NULL, v, TERMS, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(&F, 1, y.S, c, NULL, TERMS, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(&F, 1, y.S, c, missing, 2, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(&F, 1, y.S, c, v, -1, NULL, NULL, NULL));
    opt.null_tolerance = NAN;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(&F, 1, y.S, c, v, TERMS, &opt, NULL, NULL));
    opt = options_none();
    opt.isa = (sl_isa)17;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_create_sums(&F, 1, y.S, c, v, TERMS, &opt, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_sums(NULL, 1, c, v, TERMS, NULL, NULL, NULL));
    SL_CHECK(sl_factor_create_sums(&F, 1, y.S, c, v, TERMS, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_sums(&F, 1, c, missing, TERMS, NULL, NULL, NULL));
    SL_CHECK(sl_inverse_diagonal(F, &x, &row, 1, NULL, NULL)); /* F is as it was */
    sl_factor_free(F);
    matrix_pair_free(&y);
}

static sl_status sum_scatter_and_factor(matrix_pair_t *y, const sl_options *opt,
                                        counter_t *counter) {
    const double c[TERMS] = {1, 2};
    sl_matrix *A = (sl_matrix *)(void *)y;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    double *v = test_reals((size_t)scatter_length(y->S));
    sl_status status = sl_matrix_sum(&A, c, y->terms, TERMS, opt, NULL);
    assert_true((A != NULL) == (status == SL_OK));
    if (status == SL_OK) {
        sl_csc view = sl_matrix_view(A);
        status = sl_symbolic_create(&S, &view, FOR_ANALYSIS(opt), NULL);
    }
    if (status == SL_OK) {
        v[0] = 4321;
        status = sl_symbolic_scatter(S, v, &y->terms[1], NULL);
        assert_true(status == SL_OK || v[0] == 4321);
    }
    if (status == SL_OK) {
        size_t live = counter->live_blocks;
        status = sl_factor_create_sums(&F, 1, S, c, matrix_pair_values(y), TERMS, FOR_FACTOR(opt),
                                       NULL, NULL);
        assert_true((F != NULL) == (status == SL_OK));
        assert_true(status == SL_OK || counter->live_blocks == live);
    }
    if (status == SL_OK) {
        size_t calls = counter->calls;
        SL_CHECK(sl_factor_refactor_sums(&F, 1, c, matrix_pair_values(y), TERMS, NULL, NULL, NULL));
        assert_int_equal(counter->calls, calls); /* allocates nothing */
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(A);
    free(v);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 100, 0, 2, NULL);
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        counter.fail_at = k;
        status = sum_scatter_and_factor(&y, &opt, &counter);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
        COUNTER_CLEAN(&counter);
    }
    matrix_pair_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_combination_has_the_bits_of_the_factored_sum),
        cmocka_unit_test(a_combination_of_many_terms_has_the_same_bits),
        cmocka_unit_test(a_combination_of_no_terms_is_the_zero_matrix),
        cmocka_unit_test(values_that_are_not_finite_are_refused),
        cmocka_unit_test(the_entry_that_is_not_finite_is_reported),
        cmocka_unit_test(a_null_pivot_is_reported),
        cmocka_unit_test(invalid_arguments_are_refused),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
