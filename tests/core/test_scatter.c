/* test_spread.c: sums of matrices, and values spread over the map of an analysis */
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

/* All patterns of 4 rows as the analysed one, each part of each spread: the entries go where those of the whole went,
 * found by their values, and nothing else is written. What is no part is refused. */
static void all_patterns_of_four_rows(void **state) {
    (void)state;
    enum { ROWS = 4, PLACES = ROWS * (ROWS + 1) / 2 };
    static const sl_int rows[PLACES] = {0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
    static const sl_int columns[PLACES] = {0, 0, 0, 0, 1, 1, 1, 2, 2, 3};
    sl_options natural = options_none();
    natural.ordering = SL_ORDERING_NATURAL;
    gen_matrix_t M[1 << PLACES];
    for (int bits = 0; bits < 1 << PLACES; bits++) {
        gen_list_t t = gen_list(ROWS);
        for (int k = 0; k < PLACES; k++) {
            if (bits >> k & 1) {
                gen_add(&t, rows[k], columns[k], k + 1);
            }
        }
        M[bits] = gen_store(&t, gen_style(bits % 6), (uint64_t)bits + 1); /* no duplicates */
        gen_list_free(&t);
    }
    for (int whole = 0; whole < 1 << PLACES; whole++) {
        double all[PLACES], part[PLACES + 1];
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M[whole].view, &natural, NULL));
        sl_int count = sl_symbolic_entries(S);
        SL_CHECK(sl_symbolic_spread(S, all, &M[whole].view, NULL));
        for (int k = 0; k < PLACES; k++) {
            int found = 0;
            for (sl_int p = 0; p < count; p++) {
                found += all[p] == k + 1;
            }
            assert_int_equal(found, whole >> k & 1);
        }
        for (int bits = 0; bits < 1 << PLACES; bits++) {
            part[count] = 4321;
            if (bits & ~whole) {
                SL_EXPECT(SL_ERR_PATTERN, sl_symbolic_spread(S, part, &M[bits].view, NULL));
                continue;
            }
            SL_CHECK(sl_symbolic_spread(S, part, &M[bits].view, NULL));
            for (sl_int p = 0; p < count; p++) {
                assert_true(part[p] == ((bits >> ((int)all[p] - 1) & 1) ? all[p] : 0.0));
            }
            assert_true(part[count] == 4321);
        }
        sl_symbolic_free(S);
    }
    for (int bits = 0; bits < 1 << PLACES; bits++) {
        gen_matrix_free(&M[bits]);
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_sums),
        cmocka_unit_test(one_term_is_its_lower_triangle),
        cmocka_unit_test(wrong_sums),
        cmocka_unit_test(every_way_of_storing_spreads_alike),
        cmocka_unit_test(all_patterns_of_four_rows),
        cmocka_unit_test(every_place_of_wide_panels_is_found),
        cmocka_unit_test(entries_off_the_pattern_are_named),
        cmocka_unit_test(wrong_calls_of_spread),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
