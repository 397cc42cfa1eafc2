/* test_pivots_rare.c: 2x2 pivots that overflow, in float, and without relaxed supernodes */
#include "tests/lib/factored.h"

/* A 3 x 3 matrix whose lower triangle is full: a 1x1 pivot, and a 2x2 pivot of the other rows. */
typedef struct three_t {
    double x[6]; /* (0,0) (1,0) (2,0) (1,1) (2,1) (2,2) */
    sl_csc A;
    sl_symbolic *S;
} three_t;

static void three_make(three_t *t) {
    static const sl_int p[4] = {0, 3, 5, 6}, i[6] = {0, 1, 2, 1, 2, 2};
    static const double x[6] = {10.0, 0.0, 0.0, 0.0, 5.0, 0.0};
    sl_options opt = options_none();
    sl_stats stats;
    memcpy(t->x, x, sizeof x);
    t->A.n_rows = t->A.n_cols = 3;
    t->A.p = p;
    t->A.i = i;
    t->A.x = t->x;
    opt.ordering = SL_ORDERING_NATURAL;
    SL_CHECK(sl_symbolic_create_pivoted(&t->S, &t->A, &opt, &stats));
    assert_int_equal(stats.symbolic.pairs, 1);
    assert_int_equal(sl_symbolic_view(t->S).perm[0], 0);
}

/* Either diagonal entry of the pivot, or the one between them, overflows. */
static void pairs_that_overflow_are_refused(void **state) {
    (void)state;
    static const double values[3][6] = {{1e-300, 1e10, 0.0, 0.0, 5.0, 0.0},
                                        {1e-300, 0.0, 1e10, 0.0, 5.0, 0.0},
                                        {1.0, 1e154, -1e154, 0.0, 1.7e308, 0.0}};
    three_t t;
    three_make(&t);
    for (int k = 0; k < 3; k++) {
        sl_factor *F = (sl_factor *)(void *)&t;
        sl_stats stats;
        memcpy(t.x, values[k], sizeof t.x);
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_create(&F, t.S, &t.A, NULL, &stats));
        assert_null(F);
        assert_true(stats.error.row == 1 || stats.error.row == 2);
        assert_true(!(fabs(stats.error.value) <= DBL_MAX));
    }
    sl_symbolic_free(t.S);
}

/* With SL_PIVOTS_POSITIVE a pivot with a negative eigenvalue is refused, here -5. */
static void a_pair_is_not_definite(void **state) {
    (void)state;
    three_t t;
    sl_factor *F = NULL;
    sl_options opt = options_none();
    sl_stats stats;
    three_make(&t);
    opt.pivots = SL_PIVOTS_POSITIVE;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, t.S, &t.A, &opt, &stats));
    assert_in_range(stats.error.row, 1, 2);
    assert_true(fabs(stats.error.value + 5.0) < 1e-14);
    assert_non_null(strstr(stats.error.what, "definite"));
    sl_symbolic_free(t.S);
}

/* The entry between them is 0, and so is the second one on the diagonal. */
static void a_pair_without_its_entry_is_refused(void **state) {
    (void)state;
    static const double values[6] = {1.0, 0.0, 0.0, 1.0, 0.0, 0.0};
    three_t t;
    sl_factor *F = NULL;
    three_make(&t);
    memcpy(t.x, values, sizeof t.x);
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, t.S, &t.A, NULL, NULL));
    assert_null(F);
    sl_symbolic_free(t.S);
}

/* A diagonal entry of the pivot cancels, and the sum of what it was computed from overflows. */
static void magnitudes_of_pairs_may_overflow(void **state) {
    (void)state;
    static const double values[2][6] = {{1e308, 1e308, 0.0, 1e308, 1e300, 1.0},
                                        {1e308, 0.0, 1e308, 1.0, 1e300, 1e308}};
    static const double b[2][3] = {{3e300, 3e300 + 3e292, 2e292 + 3e-8},
                                   {4e300, 3e292 + 2e-8, 4e300 + 2e292}};
    three_t t;
    three_make(&t);
    for (int k = 0; k < 2; k++) {
        sl_factor *F;
        double x[3];
        memcpy(t.x, values[k], sizeof t.x);
        SL_CHECK(sl_factor_create(&F, t.S, &t.A, NULL, NULL));
        SL_CHECK(sl_factor_solve(F, x, 3, b[k], 3, 1, NULL));
        for (int i = 0; i < 3; i++) {
            assert_true(fabs(x[i] - (i + 1) * 1e-8) <= 1e-15);
        }
        sl_factor_free(F);
    }
    sl_symbolic_free(t.S);
}

/* Entries of L that float cannot hold become 0 below a 2x2 pivot, where they do no harm. */
static void small_entries_below_pairs_are_dropped_in_float(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 4, 5}, i[5] = {1, 2, 1, 2, 2};
    static const double x[5] = {1.0, 1e-60, 0.0, 1e-60, 3.0}, b[3] = {2.0, 4.0, 6.0};
    const sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    double out[3];
    opt.ordering = SL_ORDERING_NATURAL;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A, &opt, &stats));
    assert_int_equal(stats.symbolic.pairs, 1);
    opt = options_none();
    opt.storage = SL_STORAGE_FLOAT;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
    SL_CHECK(sl_factor_solve(F, out, 3, b, 3, 1, NULL));
    assert_true(fabs(out[0] - 4.0) <= 1e-14 && fabs(out[1] - 2.0) <= 1e-14);
    assert_true(fabs(out[2] - 2.0) <= 1e-14);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Off-diagonal entries so small that their share of the threshold is 0, and that have no
 * reciprocal: still a 2x2 pivot. */
static void the_smallest_numbers_are_a_pair(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double least = 4.9406564584124654e-324, x[3] = {0.0, least, 0.0}, b[2] = {least, 0.0};
    const sl_csc A = {2, 2, p, i, x};
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    double y[2];
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, &stats));
    assert_int_equal(stats.symbolic.pairs, 1);
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_factor_solve(F, y, 2, b, 2, 1, NULL));
    assert_true(y[0] == 0.0 && y[1] == 1.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* The search for pivots meets numbers that are not finite, and still orders all columns. */
static void a_search_that_overflows_ends(void **state) {
    (void)state;
    enum { N = 6 };
    const double w = 1.7e308;
    gen_list_t t = gen_list(N);
    for (sl_int j = 0; j < N; j++) {
        gen_add(&t, j, j, 0.2 * w);
        for (sl_int i = j + 1; i < N; i++) {
            gen_add(&t, i, j, i % 2 == 0 ? w : -w);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_symbolic *S;
    sl_factor *F = (sl_factor *)(void *)&M;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &M.view, NULL, NULL));
    NOTHING_WRONG(check_permutation(N, sl_symbolic_view(S).perm, sl_symbolic_view(S).iperm));
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_create(&F, S, &M.view, NULL, NULL));
    assert_null(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* Without relaxation supernodes are merged only where a 2x2 pivot needs it. */
static void pairs_need_no_relaxation(void **state) {
    (void)state;
    enum { N = 60 };
    gen_list_t t = gen_list(N);
    sl_options opt = options_none();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    double b[N], x[N];
    for (sl_int k = 0; k + 1 < N; k++) {
        gen_add(&t, k + 1, k, k % 2 == 0 ? 2.0 : 0.5);
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    opt.relaxation = SL_RELAXATION_NONE;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &M.view, &opt, &stats));
    assert_int_equal(stats.symbolic.pairs, N / 2);
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    gen_reals(b, N, 3);
    SL_CHECK(sl_factor_solve(F, x, N, b, N, 1, NULL));
    BACKWARD_PASSES(&M.view, x, N, b, N, 1);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* Rows 0 and 1 are columns of one front, joined by an entry so small that the determinant over its
 * square overflows. Each has an entry of 1 below: the pair would make L as large as 1 / a. */
static void pairs_of_a_tiny_entry_wait(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 3, 5, 6, 6}, i[6] = {0, 1, 2, 1, 2, 3};
    static const double tiny[] = {1e-100, 1e-160, 1e-200, 1e-310, 5e-324};
    static const double diagonal[] = {1e-11, 1e-3, 1e-150};
    for (size_t k = 0; k < sizeof tiny / sizeof *tiny; k++) {
        for (size_t m = 0; m < sizeof diagonal / sizeof *diagonal; m++) {
            const double x[6] = {diagonal[m], tiny[k], 1.0, diagonal[m], 1.0, 1.0};
            const sl_csc A = {4, 4, p, i, x};
            sl_options opt = options_none();
            sl_symbolic *S;
            sl_factor *F;
            sl_matrix *L;
            opt.ordering = SL_ORDERING_NATURAL;
            opt.relaxation = SL_RELAXATION_NONE;
            SL_CHECK(sl_symbolic_create_pivoted(&S, &A, &opt, NULL));
            opt = options_none();
            opt.growth_limit = opt.null_tolerance = -1.0;
            SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
            SL_CHECK(sl_factor_lower(&L, F, NULL));
            const sl_csc l = sl_matrix_view(L);
            for (sl_int e = 0; e < l.p[4]; e++) {
                assert_true(fabs(l.x[e]) <= 100.0);
            }
            sl_matrix_free(L);
            sl_factor_free(F);
            sl_symbolic_free(S);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_that_overflow_are_refused),
        cmocka_unit_test(a_pair_is_not_definite),
        cmocka_unit_test(a_pair_without_its_entry_is_refused),
        cmocka_unit_test(magnitudes_of_pairs_may_overflow),
        cmocka_unit_test(small_entries_below_pairs_are_dropped_in_float),
        cmocka_unit_test(the_smallest_numbers_are_a_pair),
        cmocka_unit_test(a_search_that_overflows_ends),
        cmocka_unit_test(pairs_need_no_relaxation),
        cmocka_unit_test(pairs_of_a_tiny_entry_wait),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
