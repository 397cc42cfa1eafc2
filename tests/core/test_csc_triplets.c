/* test_csc_triplets.c: sl_matrix_from_triplets: sorting, summation, errors, empty matrices */
#include "tests/lib/check_factor.h"

static void triplets_are_sorted_and_summed(void **state) {
    (void)state;
    const sl_int i[7] = {2, 0, 2, 1, 0, 2, 1}, j[7] = {0, 0, 0, 1, 1, 0, 1};
    const double x[7] = {1, 2, 4, 8, 16, 32, -8};
    sl_matrix *M = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_matrix_from_triplets(&M, 3, 2, 7, i, j, x, NULL, &stats));
    sl_csc A = sl_matrix_view(M);
    SL_CHECK(sl_csc_check(&A, NULL));
    assert_int_equal(A.n_rows, 3);
    assert_int_equal(A.n_cols, 2);
    assert_int_equal(A.p[1], 2);
    assert_int_equal(A.p[2], 4); /* the sum 8 - 8 = 0 is kept as an entry */
    assert_int_equal(A.i[0], 0);
    assert_int_equal(A.i[1], 2);
    assert_int_equal(A.i[2], 0);
    assert_int_equal(A.i[3], 1);
    assert_true(A.x[0] == 2 && A.x[1] == 37 && A.x[2] == 16 && A.x[3] == 0);
    sl_matrix_free(M);

    SL_CHECK(sl_matrix_from_triplets(&M, 3, 2, 7, i, j, NULL, NULL, NULL));
    A = sl_matrix_view(M);
    assert_null(A.x);
    assert_int_equal(A.p[2], 4);
    sl_matrix_free(M);
}

static void random_triplets_equal_dense_sums(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int round = 0; round < 50; round++) {
        sl_int rows = 1 + gen_below(&seed, 20), cols = 1 + gen_below(&seed, 20),
               count = gen_below(&seed, 80);
        sl_int *i = test_ints((size_t)count), *j = test_ints((size_t)count);
        double *x = test_reals((size_t)count), *dense = test_reals((size_t)rows * (size_t)cols);
        for (sl_int k = 0; k < count; k++) {
            i[k] = gen_below(&seed, rows);
            j[k] = gen_below(&seed, cols);
            x[k] = (double)gen_below(&seed, 100); /* integers: sums are exact in any order */
            dense[i[k] + rows * j[k]] += x[k];
        }
        sl_matrix *M = NULL;
        SL_CHECK(sl_matrix_from_triplets(&M, rows, cols, count, i, j, x, NULL, NULL));
        sl_csc A = sl_matrix_view(M);
        SL_CHECK(sl_csc_check(&A, NULL));
        for (sl_int c = 0; c < cols; c++) {
            for (sl_int p = A.p[c]; p < A.p[c + 1]; p++) {
                assert_true(p == A.p[c] || A.i[p] > A.i[p - 1]);
                assert_true(A.x[p] == dense[A.i[p] + rows * c]);
                dense[A.i[p] + rows * c] = 0;
            }
        }
        for (sl_int k = 0; k < rows * cols; k++) {
            assert_true(dense[k] == 0); /* no entry was lost */
        }
        sl_matrix_free(M);
        free(i);
        free(j);
        free(x);
        free(dense);
    }
}

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    const sl_int good[2] = {0, 1}, bad[2] = {0, 5}, negative[2] = {-1, 0};
    const double x[2] = {1, 1};
    sl_matrix *M = (sl_matrix *)(void *)&M;
    counter_t counter = counter_make(); /* sizes are refused before memory is requested */
    sl_options no_memory = options_counted(&counter);
    counter.fail_at = 0;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, 2, bad, good, x, NULL, &stats));
    assert_null(M);
    assert_int_equal(stats.error.row, 5);
    assert_int_equal(stats.error.column, 1);
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_matrix_from_triplets(&M, 2, 2, 2, good, negative, x, NULL, &stats));
    assert_int_equal(stats.error.column, -1);
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_matrix_from_triplets(&M, 2, 2, 2, negative, good, x, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, 2, good, bad, x, NULL, &stats));
    assert_int_equal(stats.error.column, 5);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, -1, 2, 0, good, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, -2, 0, good, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, -1, good, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, 2, NULL, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, 2, good, NULL, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(NULL, 2, 2, 2, good, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_matrix_from_triplets(&M, 2, INT32_MAX, 2, good, good, x, &no_memory, NULL));
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_matrix_from_triplets(&M, INT32_MAX - 6, 2, 2, good, good, x, &no_memory, NULL));
    SL_EXPECT(SL_ERR_MEMORY,
              sl_matrix_from_triplets(&M, INT32_MAX - 7, 2, 2, good, good, x, &no_memory, NULL));
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_matrix_from_triplets(&M, 2, 2, (sl_off)INT32_MAX + 1, good, good, x, NULL, NULL));
    assert_null(M);
}

static void no_triplets_give_an_empty_matrix(void **state) {
    (void)state;
    sl_matrix *M = NULL;
    SL_CHECK(sl_matrix_from_triplets(&M, 0, 0, 0, NULL, NULL, NULL, NULL, NULL));
    sl_csc A = sl_matrix_view(M);
    SL_CHECK(sl_csc_check(&A, NULL));
    assert_int_equal(A.n_cols, 0);
    assert_int_equal(A.p[0], 0);
    sl_matrix_free(M);
    SL_CHECK(sl_matrix_from_triplets(&M, 4, 3, 0, NULL, NULL, NULL, NULL, NULL));
    A = sl_matrix_view(M);
    SL_CHECK(sl_csc_check(&A, NULL));
    assert_int_equal(A.p[3], 0);
    sl_matrix_free(M);
    A = sl_matrix_view(NULL);
    assert_int_equal(A.n_rows, 0);
    assert_int_equal(A.n_cols, 0);
    sl_matrix_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triplets_are_sorted_and_summed),
        cmocka_unit_test(random_triplets_equal_dense_sums),
        cmocka_unit_test(invalid_arguments_are_refused),
        cmocka_unit_test(no_triplets_give_an_empty_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
