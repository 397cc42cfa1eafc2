/* test_scatter.c: values of a matrix scattered to an analysis with a larger pattern */
#include "tests/lib/matrix_pair.h"

/* The order of the values does not depend on how the matrix is stored, and it is the order in which
 * a factorization of A reads them. */
static void every_storage_style_scatters_alike(void **state) {
    (void)state;
    const double one = 1;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 150, 1, 42);
        /* Storage style of the analyzed matrix. */
        for (int of = 0; of < GEN_STYLES; of++) {
            gen_matrix_t A = gen_store(&t, gen_style(of), 1);
            sl_symbolic *S = NULL;
            sl_factor *plain = NULL, *F = NULL;
            SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
            SL_CHECK(sl_factor_create(&plain, S, &A.view, NULL, NULL));
            size_t size = (size_t)scatter_length(S);
            double *first = test_reals(size), *again = test_reals(size);
            const double *values = first;
            sl_stats stats;
            stats.symbolic = sl_symbolic_view(S).info;
            assert_int_equal(size, stats.symbolic.nnz_a);
            SL_CHECK(sl_symbolic_scatter(S, first, &A.view, NULL));
            SL_CHECK(sl_factor_create_sums(&F, 1, S, &one, &values, 1, NULL, NULL, NULL));
            assert_same_bits(F, plain);
            for (int style = 0; style < GEN_STYLES; style++) {
                gen_matrix_t K = gen_store(&t, gen_style(style), 3);
                memset(again, 0xff, size * sizeof *again);
                SL_CHECK(sl_symbolic_scatter(S, again, &K.view, NULL));
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

/* Every pattern of 4 rows is analyzed, and every subpattern scattered: its entries, recognized by
 * their values, go where the entries of the whole pattern went, and nothing else is written. A
 * pattern that is not contained is refused. */
static void every_subpattern_of_four_rows_scatters(void **state) {
    (void)state;
    enum { ROWS = 4, POSITIONS = ROWS * (ROWS + 1) / 2 };
    static const sl_int rows[POSITIONS] = {0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
    static const sl_int columns[POSITIONS] = {0, 0, 0, 0, 1, 1, 1, 2, 2, 3};
    sl_options natural = options_none();
    natural.ordering = SL_ORDERING_NATURAL;
    gen_matrix_t M[1 << POSITIONS];
    for (int bits = 0; bits < 1 << POSITIONS; bits++) {
        gen_list_t t = gen_list(ROWS);
        for (int k = 0; k < POSITIONS; k++) {
            if (bits >> k & 1) {
                gen_add(&t, rows[k], columns[k], k + 1);
            }
        }
        M[bits] = gen_store(&t, gen_style(bits % 6), (uint64_t)bits + 1); /* no duplicates */
        gen_list_free(&t);
    }
    for (int whole = 0; whole < 1 << POSITIONS; whole++) {
        double all[POSITIONS], some[POSITIONS + 1];
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M[whole].view, &natural, NULL));
        sl_int count = scatter_length(S);
        SL_CHECK(sl_symbolic_scatter(S, all, &M[whole].view, NULL));
        for (int k = 0; k < POSITIONS; k++) {
            int found = 0;
            for (sl_int p = 0; p < count; p++) {
                found += all[p] == k + 1;
            }
            assert_int_equal(found, whole >> k & 1);
        }
        for (int bits = 0; bits < 1 << POSITIONS; bits++) {
            some[count] = 4321;
            if (bits & ~whole) {
                SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_symbolic_scatter(S, some, &M[bits].view, NULL));
                continue;
            }
            SL_CHECK(sl_symbolic_scatter(S, some, &M[bits].view, NULL));
            for (sl_int p = 0; p < count; p++) {
                assert_true(some[p] == ((bits >> ((int)all[p] - 1) & 1) ? all[p] : 0.0));
            }
            assert_true(some[count] == 4321);
        }
        sl_symbolic_free(S);
    }
    for (int bits = 0; bits < 1 << POSITIONS; bits++) {
        gen_matrix_free(&M[bits]);
    }
}

/* Panels of every width, with rows in the triangle and below it. Every entry has a value of its
 * own, so two that are swapped change the factor. */
static void wide_panels_receive_every_entry(void **state) {
    (void)state;
    static const sl_int sizes[10] = {1, 2, 7, 8, 9, 16, 17, 63, 64, 65};
    sl_options natural = options_none();
    natural.ordering = SL_ORDERING_NATURAL;
    for (int k = 0; k < 10; k++) {
        /* Dense, then dense with a few rows below. */
        for (int arrow = 0; arrow < 2; arrow++) {
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
            double *v = test_reals((size_t)scatter_length(S)), one = 1;
            const double *values = v;
            SL_CHECK(sl_symbolic_scatter(S, v, &A.view, NULL));
            SL_CHECK(sl_factor_create_sums(&F, 1, S, &one, &values, 1, NULL, NULL, NULL));
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

/* Returns whether (row, column) is the first entry of K, in storage order, that is read and that
 * the pattern lacks. */
static int is_first_outside(const sl_csc *K, int both, const char *has, sl_int row, sl_int column) {
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

/* With one or two entries that the analysis lacks, the first in storage order is reported and the
 * array does not change. */
static void entries_outside_the_pattern_are_reported(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 16, 0, 2, NULL);
    size_t size = (size_t)scatter_length(y.S);
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
            gen_add(&t, n - 1, 1, 3); /* not in the pattern */
            gen_add(&t, i, j, 2);     /* possibly in the pattern */
            for (int style = 0; style < 6; style++) {
                gen_matrix_t K = gen_store(&t, gen_style(style), 1);
                sl_stats stats;
                SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_symbolic_scatter(y.S, v, &K.view, &stats));
                assert_true(is_first_outside(&K.view, style % 3 == 2, has, stats.error.row,
                                             stats.error.column));
                assert_memory_equal(v, before, size * sizeof *v);
                others += stats.error.row + stats.error.column != n;
                gen_matrix_free(&K);
            }
            gen_list_free(&t);
        }
    }
    assert_true(others > n);
    free(v);
    free(before);
    free(has);
    matrix_pair_free(&y);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 16, 0, 2, NULL);
    sl_csc K = y.K.view;
    double *v = y.values[0];
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_scatter(NULL, v, &K, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_scatter(y.S, NULL, &K, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_scatter(y.S, v, NULL, NULL));
    K.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_scatter(y.S, v, &K, NULL));
    K = y.K.view;
    K.n_rows++;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_scatter(y.S, v, &K, NULL));
    matrix_pair_t other = matrix_pair_make(GEN_GRID2, 25, 0, 2, NULL);
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_symbolic_scatter(y.S, v, &other.K.view, NULL));
    const sl_int p[2] = {0, 0};
    const sl_csc empty = {0, 0, NULL, NULL, NULL}, bare = {1, 1, p, NULL, NULL};
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_symbolic_scatter(y.S, v, &empty, NULL));
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &empty, NULL, NULL));
    assert_int_equal(scatter_length(S), 0);
    SL_CHECK(sl_symbolic_scatter(S, NULL, &empty, NULL));
    sl_symbolic_free(S);
    SL_CHECK(sl_symbolic_create(&S, &bare, NULL, NULL)); /* a row without entries */
    SL_CHECK(sl_symbolic_scatter(S, NULL, &bare, NULL));
    sl_symbolic_free(S);
    matrix_pair_free(&other);
    matrix_pair_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_storage_style_scatters_alike),
        cmocka_unit_test(every_subpattern_of_four_rows_scatters),
        cmocka_unit_test(wide_panels_receive_every_entry),
        cmocka_unit_test(entries_outside_the_pattern_are_reported),
        cmocka_unit_test(wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
