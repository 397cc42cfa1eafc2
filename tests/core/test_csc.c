/* test_csc.c: compressed columns: validation, triangle detection, transpose, submatrix */
#include "tests/lib/check_factor.h"

/* ---- validation ---- */

static void check_reports_each_defect(void **state) {
    (void)state;
    const sl_int p[4] = {0, 2, 3, 4}, i[4] = {0, 2, 1, 2};
    const double x[4] = {1, 2, 3, 4};
    const sl_csc good = {3, 3, p, i, x};
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_csc_check(&good, &stats));
    sl_csc bad = good;
    bad.x = NULL;
    SL_CHECK(sl_csc_check(&bad, NULL));

    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_check(NULL, &stats));
    bad = good;
    bad.p = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_check(&bad, &stats));
    bad = good;
    bad.i = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_check(&bad, &stats));
    bad = good;
    bad.n_rows = -1;
    assert_int_not_equal(sl_csc_check(&bad, &stats), SL_OK);
    bad = good;
    bad.n_cols = -1;
    assert_int_not_equal(sl_csc_check(&bad, &stats), SL_OK);

    const sl_int starts_late[4] = {1, 2, 3, 4}, decreases[4] = {0, 3, 2, 4},
                 negative[4] = {0, -1, 3, 4};
    const sl_int ends_negative[4] = {0, 0, 0, -4};
    bad = good;
    bad.p = starts_late;
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_check(&bad, &stats));
    bad.p = decreases;
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error.column, 1);
    bad.p = negative;
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error.column, 0);
    bad.p = ends_negative;
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error.column, 2);

    const sl_int too_big[4] = {0, 2, 3, 2}, below_zero[4] = {0, 2, 1, -7};
    bad = good;
    bad.i = too_big;
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error.row, 3);
    assert_int_equal(stats.error.column, 1);
    bad.i = below_zero;
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error.row, -7);
    assert_int_equal(stats.error.column, 2);
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_check(&bad, NULL));

    bad = good; /* the smallest size that is too large; p is not read */
    bad.n_rows = INT32_MAX - 6;
    SL_EXPECT(SL_ERR_TOO_LARGE, sl_csc_check(&bad, &stats));
    bad.n_rows--;
    SL_CHECK(sl_csc_check(&bad, &stats));
    bad.n_cols = INT32_MAX - 6;
    SL_EXPECT(SL_ERR_TOO_LARGE, sl_csc_check(&bad, &stats));
    bad.n_rows = bad.n_cols = INT32_MAX;
    sl_symbolic *S = NULL;
    SL_EXPECT(SL_ERR_TOO_LARGE, sl_symbolic_create(&S, &bad, NULL, &stats));

    bad = good; /* a rectangular matrix is valid here */
    bad.n_rows = 5;
    SL_CHECK(sl_csc_check(&bad, NULL));
}

/* ---- triangle ---- */

static void the_triangle_of_every_style_is_detected(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 30, 0, 3);
        int edges = 0;
        for (size_t k = 0; k < t.count; k++) {
            edges = edges || t.row[k] != t.col[k];
        }
        for (int which = 0; which < GEN_STYLES; which++) {
            gen_matrix_t M = gen_store(&t, gen_style(which), (uint64_t)which);
            sl_triangle found = SL_TRIANGLE_BOTH;
            SL_CHECK(sl_csc_check(&M.view, NULL));
            SL_CHECK(sl_csc_triangle(&M.view, &found, NULL, NULL));
            assert_int_equal(found, edges ? gen_style(which).triangle : SL_TRIANGLE_NONE);
            gen_matrix_free(&M);
        }
        gen_list_free(&t);
    }
}

static void an_entry_without_mirror_image_is_reported(void **state) {
    (void)state;
    /* (2,0) has no entry at (0,2); (1,0) has one at (0,1) */
    const sl_int p[4] = {0, 2, 3, 3}, i[3] = {1, 2, 0};
    sl_csc A = {3, 3, p, i, NULL};
    /* neither triangle is complete: the output is unchanged */
    sl_triangle found = SL_TRIANGLE_UPPER;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_triangle(&A, &found, NULL, &stats));
    assert_int_equal(stats.error.row, 2);
    assert_int_equal(stats.error.column, 0);
    /* the same above the diagonal: only (0,2) */
    const sl_int q[4] = {0, 1, 2, 3}, k[3] = {1, 0, 0};
    sl_csc B = {3, 3, q, k, NULL};
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_triangle(&B, &found, NULL, &stats));
    assert_int_equal(stats.error.row, 0);
    assert_int_equal(stats.error.column, 2);
    SL_EXPECT(SL_ERR_MALFORMED, sl_csc_triangle(&B, &found, NULL, NULL));
    A.n_rows = 4;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_triangle(&A, &found, NULL, NULL));
    A.n_rows = 3;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_triangle(&A, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_triangle(NULL, &found, NULL, NULL));
    assert_int_equal(found, SL_TRIANGLE_UPPER);
}

static void triangle_detection_agrees_with_dense_patterns(void **state) {
    (void)state;
    uint64_t seed = 99;
    int symmetric = 0;
    for (int round = 0; round < 3000; round++) {
        sl_int n = 1 + gen_below(&seed, 5), p[6] = {0}, i[64];
        char has[25] = {0};
        int lower = 0, upper = 0, mirrored = 1;
        for (sl_int j = 0; j < n; j++) { /* with duplicates and rows in any order */
            p[j + 1] = p[j];
            for (sl_int k = gen_below(&seed, n + 1); k > 0; k--) {
                sl_int row = gen_below(&seed, n);
                has[row + n * j] = 1;
                i[p[j + 1]++] = row;
            }
        }
        for (sl_int j = 0; j < n; j++) {
            for (sl_int k = 0; k < n; k++) {
                lower = lower || (k > j && has[k + n * j]);
                upper = upper || (k < j && has[k + n * j]);
                mirrored = mirrored && has[k + n * j] == has[j + n * k];
            }
        }
        sl_csc A = {n, n, p, i, NULL};
        sl_triangle found = SL_TRIANGLE_NONE;
        sl_status status = sl_csc_triangle(&A, &found, NULL, NULL);
        if (lower && upper && !mirrored) {
            assert_int_equal(status, SL_ERR_MALFORMED);
        } else {
            assert_int_equal(status, SL_OK);
            assert_int_equal(found, lower ? (upper ? SL_TRIANGLE_BOTH : SL_TRIANGLE_LOWER)
                                          : (upper ? SL_TRIANGLE_UPPER : SL_TRIANGLE_NONE));
            symmetric += found == SL_TRIANGLE_BOTH;
        }
    }
    assert_true(symmetric > 20); /* symmetric patterns did occur */
}

/* ---- submatrices ---- */

static void all_rows_make_a_symmetric_permutation(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 24, 0, 5);
        sl_int n = t.n, *perm = test_ints((size_t)n);
        gen_permutation(perm, n, 11);
        for (int which = 0; which < GEN_STYLES; which++) {
            gen_matrix_t M = gen_store(&t, gen_style(which), 2);
            sl_matrix *P = NULL;
            sl_triangle before, after;
            SL_CHECK(sl_matrix_submatrix(&P, &M.view, perm, n, NULL, NULL));
            sl_csc C = sl_matrix_view(P);
            SL_CHECK(sl_csc_check(&C, NULL));
            SL_CHECK(sl_csc_triangle(&M.view, &before, NULL, NULL));
            SL_CHECK(sl_csc_triangle(&C, &after, NULL, NULL));
            assert_int_equal(after, before == SL_TRIANGLE_UPPER ? SL_TRIANGLE_LOWER : before);
            double *D = ref_dense(&M.view), *DP = ref_permute(n, D, perm), *got = ref_dense(&C);
            SAME_VALUES(DP, got, (size_t)n * (size_t)n);
            free(D);
            free(DP);
            free(got);
            sl_matrix_free(P);
            gen_matrix_free(&M);
        }
        free(perm);
        gen_list_free(&t);
    }
}

/* Every subset of the rows of a small matrix, in a shuffled order. */
static void a_submatrix_has_the_chosen_rows(void **state) {
    (void)state;
    enum { ROWS = 6 };
    gen_list_t t = gen_make(GEN_RANDOM, ROWS, 1, 3);
    for (int which = 0; which < GEN_STYLES; which++) {
        gen_matrix_t M = gen_store(&t, gen_style(which), 2);
        double *D = ref_dense(&M.view);
        for (int set = 0; set < 1 << ROWS; set++) {
            sl_int order[ROWS], rows[ROWS + 1], count = 0;
            sl_matrix *P = NULL;
            gen_permutation(order, ROWS, (uint64_t)set);
            for (sl_int k = 0; k < ROWS; k++) {
                rows[count] = order[k];
                count += set >> k & 1;
            }
            SL_CHECK(sl_matrix_submatrix(&P, &M.view, rows, count, NULL, NULL));
            const sl_csc C = sl_matrix_view(P);
            SL_CHECK(sl_csc_check(&C, NULL));
            double *got = ref_dense(&C);
            assert_int_equal(C.n_cols, count);
            for (sl_int k = 0; k < count * count; k++) {
                SAME_VALUES(&D[rows[k % count] + ROWS * rows[k / count]], &got[k], 1);
            }
            free(got);
            sl_matrix_free(P);
        }
        free(D);
        M.view.x = NULL;
        sl_matrix *pattern = NULL;
        const sl_int two[2] = {1, 0};
        SL_CHECK(sl_matrix_submatrix(&pattern, &M.view, two, 2, NULL, NULL));
        assert_null(sl_matrix_view(pattern).x);
        sl_matrix_free(pattern);
        gen_matrix_free(&M);
    }
    gen_list_free(&t);
}

/* Few rows of a large matrix take few bytes, and columns that are not read are not checked. */
static void a_submatrix_costs_what_it_reads(void **state) {
    (void)state;
    enum { MANY = 100000 };
    gen_matrix_t M = gen_matrix(GEN_PATH, MANY, 1, 1);
    const sl_int rows[3] = {70001, 5, 70000};
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_matrix *P = NULL;
    sl_stats stats;
    M.i[M.p[40000]] = -7;
    SL_CHECK(sl_matrix_submatrix(&P, &M.view, rows, 3, &opt, NULL));
    assert_true(counter.total_bytes < 4096);
    sl_matrix_free(P);
    M.i[M.p[70000]] = MANY;
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_submatrix(&P, &M.view, rows, 3, &opt, &stats));
    assert_int_equal(stats.error.column, 70000);
    assert_null(P);
    M.p[70001] = -1;
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_submatrix(&P, &M.view, rows, 3, &opt, &stats));
    assert_null(P);
    COUNTER_CLEAN(&counter);
    gen_matrix_free(&M);
}

static void invalid_arguments_of_submatrix_are_refused(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_PATH, 4, 1, 1);
    const sl_int good[4] = {3, 1, 0, 2}, twice[4] = {3, 1, 1, 2}, big[4] = {0, 1, 2, 4},
                 low[4] = {0, -1, 2, 3};
    sl_matrix *P = NULL;
    sl_stats stats;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(&P, &M.view, twice, 4, NULL, &stats));
    assert_int_equal(stats.error.row, 1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(&P, &M.view, big, 4, NULL, &stats));
    assert_int_equal(stats.error.row, 4);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(&P, &M.view, low, 4, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(&P, &M.view, NULL, 4, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(&P, &M.view, good, -1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(NULL, &M.view, good, 4, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(&P, NULL, good, 4, NULL, NULL));
    M.view.n_rows = 5;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(&P, &M.view, good, 4, NULL, NULL));
    assert_null(P);
    gen_matrix_free(&M);
}

/* A.p that descends, or leads beyond the entries, in a column that is read. */
static void malformed_columns_of_submatrix_are_refused(void **state) {
    (void)state;
    enum { COUNT = 4 };
    static const sl_int all[3] = {0, 1, 2}, i[5] = {0, 1, 1, 2, 2}, low[5] = {0, -1, 1, 2, 2};
    static const struct {
        sl_int p[4];
        const sl_int *i, *rows;
        sl_int count, column;
    } bad[COUNT] = {
        {{0, -2, 4, 5}, i, all + 1, 1, 1}, /* it begins below 0 */
        {{0, 2, 7, 5}, i, all + 1, 1, 1},  /* it ends beyond the entries */
        {{0, 4, 1, 5}, i, all, 3, 1},      /* it descends */
        {{0, 2, 4, 5}, low, all, 3, 0},    /* a row below 0 */
    };
    sl_matrix *P = NULL;
    sl_stats stats;
    for (int k = 0; k < COUNT; k++) {
        const sl_csc A = {3, 3, bad[k].p, bad[k].i, NULL};
        SL_EXPECT(SL_ERR_MALFORMED,
                  sl_matrix_submatrix(&P, &A, bad[k].rows, bad[k].count, NULL, &stats));
        assert_int_equal(stats.error.column, bad[k].column);
        assert_null(P);
    }
    /* two columns that share entries are more than there are */
    const sl_int shared[4] = {0, 4, 1, 5}, ends[2] = {0, 2};
    const sl_csc S = {3, 3, shared, i, NULL};
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_submatrix(&P, &S, ends, 2, NULL, &stats));
    assert_null(P);
    /* without entries there is no i; with entries there is */
    const sl_int none[4] = {0, 0, 0, 0}, some[4] = {0, 1, 1, 1};
    const sl_csc E = {3, 3, none, NULL, NULL}, N = {3, 3, some, NULL, NULL},
                 Z = {0, 0, none, NULL, NULL};
    SL_CHECK(sl_matrix_submatrix(&P, &E, all, 2, NULL, NULL));
    assert_int_equal(sl_matrix_view(P).n_cols, 2);
    sl_matrix_free(P);
    SL_CHECK(sl_matrix_submatrix(&P, &Z, NULL, 0, NULL, NULL));
    sl_matrix_free(P);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_submatrix(&P, &N, all, 2, NULL, NULL));
    assert_null(P);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(malformed_columns_of_submatrix_are_refused),
        cmocka_unit_test(check_reports_each_defect),
        cmocka_unit_test(the_triangle_of_every_style_is_detected),
        cmocka_unit_test(an_entry_without_mirror_image_is_reported),
        cmocka_unit_test(triangle_detection_agrees_with_dense_patterns),
        cmocka_unit_test(all_rows_make_a_symmetric_permutation),
        cmocka_unit_test(a_submatrix_has_the_chosen_rows),
        cmocka_unit_test(a_submatrix_costs_what_it_reads),
        cmocka_unit_test(invalid_arguments_of_submatrix_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
