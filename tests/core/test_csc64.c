/* test_csc64.c: matrices with 64-bit indices: conversion, what does not fit, damage */
#include "tests/lib/factored.h"

/* The 64-bit view of a matrix, and its arrays. */
typedef struct wide_t {
    int64_t *p, *i;
    sl_csc64 view;
} wide_t;

static wide_t wide_make(const sl_csc *A) {
    const sl_int nnz = A->n_cols > 0 ? A->p[A->n_cols] : 0;
    wide_t w;
    w.p = (int64_t *)test_array((size_t)A->n_cols + 1, sizeof(int64_t));
    w.i = (int64_t *)test_array((size_t)nnz, sizeof(int64_t));
    for (sl_int j = 0; j < A->n_cols; j++) {
        w.p[j + 1] = A->p[j + 1];
    }
    for (sl_int k = 0; k < nnz; k++) {
        w.i[k] = A->i[k];
    }
    w.view.n_rows = A->n_rows;
    w.view.n_cols = A->n_cols;
    w.view.p = w.p;
    w.view.i = w.i;
    w.view.x = A->x;
    return w;
}

static void wide_free(wide_t *w) {
    free(w->p);
    free(w->i);
}

static void entries_keep_their_order(void **state) {
    (void)state;
    static const gen_kind_t kinds[] = {GEN_NONE, GEN_ONE, GEN_GRID2, GEN_RANDOM, GEN_DENSE};
    for (int style = 0; style < 4; style++) {
        for (int k = 0; k < 5; k++) {
            factored_t y = factored_make(kinds[k], 60, 1, style, NULL);
            const sl_csc *A = &y.M.view;
            const size_t nnz = A->n_cols > 0 ? (size_t)A->p[A->n_cols] : 0;
            wide_t w = wide_make(A);
            sl_matrix *M = NULL;
            sl_csc copy;
            SL_CHECK(sl_matrix_from_csc64(&M, &w.view, NULL, NULL));
            copy = sl_matrix_view(M);
            assert_int_equal(copy.n_rows, A->n_rows);
            assert_int_equal(copy.n_cols, A->n_cols);
            SL_CHECK(sl_csc_check(&copy, NULL));
            for (sl_int j = 0; j <= A->n_cols; j++) {
                assert_int_equal(copy.p[j], A->n_cols > 0 ? A->p[j] : 0);
            }
            for (size_t q = 0; q < nnz; q++) {
                assert_true(copy.i[q] == A->i[q] && copy.x[q] == A->x[q]);
            }
            copy.x = A->x; /* the caller's values with the converted indices */
            SL_CHECK(sl_factor_refactor(y.F, &copy, NULL));
            sl_matrix_free(M);

            w.view.x = NULL;
            SL_CHECK(sl_matrix_from_csc64(&M, &w.view, NULL, NULL));
            assert_null(sl_matrix_view(M).x);
            sl_matrix_free(M);
            wide_free(&w);
            factored_free(&y);
        }
    }
}

/* What does not fit is refused before an array is read beyond its end. */
static void large_counts_are_refused(void **state) {
    (void)state;
    static const int64_t huge[] = {INT32_MAX - 6, INT32_MAX, (int64_t)INT32_MAX + 2, INT64_MAX};
    int64_t p[3] = {0, 1, 2}, i[2] = {0, 1};
    double x[2] = {1, 1};
    for (int k = 0; k < 4; k++) {
        sl_csc64 A = {2, 2, NULL, NULL, NULL};
        sl_matrix *M = (sl_matrix *)(void *)p;
        A.p = p;
        A.i = i;
        A.x = x;
        A.n_rows = huge[k];
        SL_EXPECT(SL_ERR_TOO_LARGE, sl_matrix_from_csc64(&M, &A, NULL, NULL));
        assert_null(M);
        A.n_rows = 2;
        A.n_cols = huge[k];
        SL_EXPECT(SL_ERR_TOO_LARGE, sl_matrix_from_csc64(&M, &A, NULL, NULL));
        A.n_cols = 2;
        p[2] = huge[k];
        if (huge[k] > INT32_MAX) {
            SL_EXPECT(SL_ERR_TOO_LARGE, sl_matrix_from_csc64(&M, &A, NULL, NULL));
        }
        p[2] = 2;
    }
}

static void damage_is_located(void **state) {
    (void)state;
    static const int64_t wrong[] = {-1, 3, INT64_MAX, INT64_MIN, (int64_t)1 << 32};
    int64_t p[4] = {0, 1, 2, 3}, i[3] = {0, 1, 2};
    const double x[3] = {1, 1, 1};
    sl_csc64 A = {3, 3, NULL, NULL, NULL};
    sl_matrix *M = NULL;
    sl_stats stats;
    A.p = p;
    A.i = i;
    A.x = x;
    for (int k = 0; k < 5; k++) {
        i[1] = wrong[k];
        SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_from_csc64(&M, &A, NULL, &stats));
        assert_null(M);
        assert_int_equal(stats.error.column, 1);
        assert_int_equal(stats.error.row, wrong[k] == 3 ? 3 : -1);
    }
    i[1] = 1;
    p[1] = 3;
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_from_csc64(&M, &A, NULL, &stats));
    assert_int_equal(stats.error.column, 1);
    p[1] = -1;
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_from_csc64(&M, &A, NULL, NULL));
    p[1] = 1;
    p[0] = 1;
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_from_csc64(&M, &A, NULL, &stats));
    assert_int_equal(stats.error.column, 0);
    p[0] = 0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_csc64(NULL, &A, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_csc64(&M, NULL, NULL, NULL));
    A.i = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_csc64(&M, &A, NULL, NULL));
    A.i = i;
    A.p = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_csc64(&M, &A, NULL, NULL));
    A.p = p;
    A.n_rows = -1;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_csc64(&M, &A, NULL, NULL));
    A.n_rows = 3;
    sl_options opt = options_none();
    opt.size = 1;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_csc64(&M, &A, &opt, NULL));
}

static void no_entries_need_no_rows(void **state) {
    (void)state;
    const int64_t p[3] = {0, 0, 0};
    const sl_csc64 A = {4, 2, p, NULL, NULL};
    sl_matrix *M = NULL;
    SL_CHECK(sl_matrix_from_csc64(&M, &A, NULL, NULL));
    const sl_csc view = sl_matrix_view(M);
    assert_true(view.n_rows == 4 && view.n_cols == 2 && view.p[2] == 0);
    sl_matrix_free(M);
}

static void failing_allocation_gives_no_matrix(void **state) {
    (void)state;
    const int64_t p[2] = {0, 1}, i[1] = {0};
    const double x[1] = {1};
    const sl_csc64 A = {1, 1, p, i, x};
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_matrix *M = NULL;
    counter.fail_at = 0;
    SL_EXPECT(SL_ERR_MEMORY, sl_matrix_from_csc64(&M, &A, &opt, NULL));
    assert_null(M);
    counter.fail_at = -1;
    SL_CHECK(sl_matrix_from_csc64(&M, &A, &opt, NULL));
    sl_matrix_free(M);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_keep_their_order),
        cmocka_unit_test(large_counts_are_refused),
        cmocka_unit_test(damage_is_located),
        cmocka_unit_test(no_entries_need_no_rows),
        cmocka_unit_test(failing_allocation_gives_no_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
