/* test_csc.c: owned matrices from triplets, transpose, permutation, checks, triangles, products and residuals */
#include "check.h"

/* ---- triplets ---- */

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
    assert_int_equal(A.p[2], 4); /* the sum 8 - 8 = 0 stays an entry */
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

static void triplets_random(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int round = 0; round < 50; round++) {
        sl_int rows = 1 + gen_below(&seed, 20), cols = 1 + gen_below(&seed, 20), count = gen_below(&seed, 80);
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
            assert_true(dense[k] == 0); /* nothing was lost */
        }
        sl_matrix_free(M);
        free(i);
        free(j);
        free(x);
        free(dense);
    }
}

static void triplets_wrong_arguments(void **state) {
    (void)state;
    const sl_int good[2] = {0, 1}, bad[2] = {0, 5}, negative[2] = {-1, 0};
    const double x[2] = {1, 1};
    sl_matrix *M = (sl_matrix *)(void *)&M;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, 2, bad, good, x, NULL, &stats));
    assert_null(M);
    assert_int_equal(stats.error_row, 5);
    assert_int_equal(stats.error_column, 1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, 2, good, negative, x, NULL, &stats));
    assert_int_equal(stats.error_column, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, -1, 2, 0, good, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, -2, 0, good, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, -1, good, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, 2, NULL, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 2, 2, 2, good, NULL, x, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(NULL, 2, 2, 2, good, good, x, NULL, NULL));
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_matrix_from_triplets(&M, 2, 2, (sl_off)INT32_MAX + 1, good, good, x, NULL, NULL));
    assert_null(M);
}

static void triplets_none(void **state) {
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

/* ---- check ---- */

static void check_names_what_is_malformed(void **state) {
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

    const sl_int starts_late[4] = {1, 2, 3, 4}, descends[4] = {0, 3, 2, 4}, negative[4] = {0, -1, 3, 4};
    const sl_int ends_negative[4] = {0, 0, 0, -4};
    bad = good;
    bad.p = starts_late;
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_check(&bad, &stats));
    bad.p = descends;
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error_column, 1);
    bad.p = negative;
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error_column, 0);
    bad.p = ends_negative;
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error_column, 2);

    const sl_int too_big[4] = {0, 2, 3, 2}, below_zero[4] = {0, 2, 1, -7};
    bad = good;
    bad.i = too_big;
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error_row, 3);
    assert_int_equal(stats.error_column, 1);
    bad.i = below_zero;
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_check(&bad, &stats));
    assert_int_equal(stats.error_row, -7);
    assert_int_equal(stats.error_column, 2);
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_check(&bad, NULL));

    bad = good; /* a rectangle is fine here */
    bad.n_rows = 5;
    SL_CHECK(sl_csc_check(&bad, NULL));
}

/* ---- triangle ---- */

static void triangle_of_every_style(void **state) {
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

static void triangle_names_the_lonely_entry(void **state) {
    (void)state;
    /* (2,0) has no mirror image, while (1,0) has */
    const sl_int p[4] = {0, 2, 3, 3}, i[3] = {1, 2, 0};
    sl_csc A = {3, 3, p, i, NULL};
    sl_triangle found = SL_TRIANGLE_NONE;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_triangle(&A, &found, NULL, &stats));
    assert_int_equal(stats.error_row, 2);
    assert_int_equal(stats.error_column, 0);
    /* the same above the diagonal: (0,2) alone */
    const sl_int q[4] = {0, 1, 2, 3}, k[3] = {1, 0, 0};
    sl_csc B = {3, 3, q, k, NULL};
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_triangle(&B, &found, NULL, &stats));
    assert_int_equal(stats.error_row, 0);
    assert_int_equal(stats.error_column, 2);
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_triangle(&B, &found, NULL, NULL));
    A.n_rows = 4;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_triangle(&A, &found, NULL, NULL));
    A.n_rows = 3;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_triangle(&A, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_triangle(NULL, &found, NULL, NULL));
}

static void triangle_random_against_dense(void **state) {
    (void)state;
    uint64_t seed = 99;
    int symmetric = 0;
    for (int round = 0; round < 3000; round++) {
        sl_int n = 1 + gen_below(&seed, 5), p[6] = {0}, i[64];
        char has[25] = {0};
        int lower = 0, upper = 0, mirrored = 1;
        for (sl_int j = 0; j < n; j++) { /* with duplicates, rows in any order */
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
            assert_int_equal(status, SL_ERR_PATTERN);
        } else {
            assert_int_equal(status, SL_OK);
            assert_int_equal(found, lower ? (upper ? SL_TRIANGLE_BOTH : SL_TRIANGLE_LOWER)
                                          : (upper ? SL_TRIANGLE_UPPER : SL_TRIANGLE_NONE));
            symmetric += found == SL_TRIANGLE_BOTH;
        }
    }
    assert_true(symmetric > 20); /* the case was met */
}

/* ---- transpose and permute ---- */

static void transpose_keeps_every_entry(void **state) {
    (void)state;
    /* 4 x 3, unsorted, a duplicate at (3,0) */
    const sl_int p[4] = {0, 4, 4, 6}, i[6] = {3, 0, 3, 1, 2, 0};
    const double x[6] = {1, 2, 3, 4, 5, 6};
    sl_csc A = {4, 3, p, i, x};
    sl_matrix *T = NULL, *back = NULL;
    SL_CHECK(sl_matrix_transpose(&T, &A, NULL));
    sl_csc C = sl_matrix_view(T);
    SL_CHECK(sl_csc_check(&C, NULL));
    assert_int_equal(C.n_rows, 3);
    assert_int_equal(C.n_cols, 4);
    const sl_int Cp[5] = {0, 2, 3, 4, 6}, Ci[6] = {0, 2, 0, 2, 0, 0};
    const double Cx[6] = {2, 6, 4, 5, 1, 3};
    assert_memory_equal(C.p, Cp, sizeof Cp);
    assert_memory_equal(C.i, Ci, sizeof Ci);
    SAME_VALUES(C.x, Cx, 6); /* duplicates in their order */
    SL_CHECK(sl_matrix_transpose(&back, &C, NULL));
    C = sl_matrix_view(back);
    const sl_int sorted[6] = {0, 1, 3, 3, 0, 2};
    assert_memory_equal(C.p, p, sizeof p);
    assert_memory_equal(C.i, sorted, sizeof sorted);
    sl_matrix_free(T);
    sl_matrix_free(back);

    A.x = NULL;
    SL_CHECK(sl_matrix_transpose(&T, &A, NULL));
    assert_null(sl_matrix_view(T).x);
    sl_matrix_free(T);
    A.i = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_transpose(&T, &A, NULL));
    assert_null(T);
    const sl_int bad[6] = {3, 0, 4, 1, 2, 0};
    A.i = bad;
    SL_EXPECT(SL_ERR_PATTERN, sl_matrix_transpose(&T, &A, NULL));
    assert_null(T);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_transpose(NULL, &A, NULL));
}

static void permute_is_a_symmetric_permutation(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 24, 0, 5);
        sl_int n = t.n, *perm = test_ints((size_t)n);
        gen_permutation(perm, n, 11);
        for (int which = 0; which < GEN_STYLES; which++) {
            gen_matrix_t M = gen_store(&t, gen_style(which), 2);
            sl_matrix *P = NULL;
            sl_triangle before, after;
            SL_CHECK(sl_matrix_permute(&P, &M.view, perm, NULL));
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

static void permute_wrong_arguments(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_PATH, 4, 1, 1);
    const sl_int good[4] = {3, 1, 0, 2}, twice[4] = {3, 1, 1, 2}, big[4] = {0, 1, 2, 4}, low[4] = {0, -1, 2, 3};
    sl_matrix *P = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_permute(&P, &M.view, twice, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_permute(&P, &M.view, big, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_permute(&P, &M.view, low, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_permute(&P, &M.view, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_permute(NULL, &M.view, good, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_permute(&P, NULL, good, NULL));
    M.view.n_rows = 5;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_permute(&P, &M.view, good, NULL));
    assert_null(P);
    gen_matrix_free(&M);
}

/* ---- products ---- */

static void multiply_reads_as_the_factorization_does(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 20, 0, 4);
        for (int which = 0; which < GEN_STYLES; which++) {
            gen_matrix_t M = gen_store(&t, gen_style(which), 9);
            sl_int n = t.n;
            if (gen_style(which).triangle == SL_TRIANGLE_BOTH) { /* values above the diagonal are not read */
                for (sl_int j = 0; j < n; j++) {
                    for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
                        M.x[p] = M.i[p] < j ? 1e30 : M.x[p];
                    }
                }
            }
            double *D = ref_dense(&M.view), *X = test_reals(3 * (size_t)(n + 2)), *Y = test_reals(3 * (size_t)(n + 1));
            gen_reals(X, 3 * (size_t)(n + 2), 17);
            SL_CHECK(sl_csc_multiply(&M.view, SL_AS_SYMMETRIC, Y, (size_t)n + 1, X, (size_t)n + 2, 3));
            for (sl_int r = 0; r < 3; r++) {
                for (sl_int i = 0; i < n; i++) {
                    double sum = 0, size = 0;
                    for (sl_int j = 0; j < n; j++) {
                        double term = AT(D, i, j) * X[j + r * (n + 2)];
                        sum += term;
                        size += fabs(term);
                    }
                    assert_true(fabs(Y[i + r * (n + 1)] - sum) <= 4.0 * (double)(n + 2) * DBL_EPSILON * size);
                }
            }
            free(D);
            free(X);
            free(Y);
            gen_matrix_free(&M);
        }
        gen_list_free(&t);
    }
}

static void multiply_as_stored(void **state) {
    (void)state;
    const sl_int p[4] = {0, 2, 2, 5}, i[5] = {1, 0, 1, 1, 0};
    const double x[5] = {2, 3, 4, 5, 6}, X[6] = {1, 10, 100, -1, -10, -100};
    double Y[6] = {9, 9, 9, 9, 9, 9};
    const double wanted[6] = {603, 902, 9, -603, -902, 9}; /* ldy = 3: the gap is not written */
    sl_csc A = {2, 3, p, i, x};
    SL_CHECK(sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 3, 2));
    SAME_VALUES(Y, wanted, 6);
    SL_CHECK(sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 3, 0));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_SYMMETRIC, Y, 3, X, 3, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 1, X, 3, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 3, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, NULL, 3, X, 3, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 3, NULL, 3, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(NULL, SL_AS_STORED, Y, 3, X, 3, 1));
    A.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&A, SL_AS_STORED, Y, 3, X, 3, 1));
    SAME_VALUES(Y, wanted, 6);
}

static void residual_and_backward_error(void **state) {
    (void)state;
    /* [2 1; 1 3], row sums 3 and 4 */
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double x[3] = {2, 1, 3};
    sl_csc A = {2, 2, p, i, x};
    double X[6] = {1, 1, 1, 1, 0, 0}, B[6] = {3, 4, 3.5, 4, 0, 0}, R[6], eta[3];
    SL_CHECK(sl_csc_residual(&A, R, 2, eta, X, 2, B, 2, 3));
    const double wanted[6] = {0, 0, 0.5, 0, 0, 0};
    SAME_VALUES(R, wanted, 6);
    assert_true(eta[0] == 0.0 && eta[2] == 0.0);
    assert_true(fabs(eta[1] - 0.5 / 8.0) < 1e-15); /* 0.5 / (4 * 1 + 4) */
    SL_CHECK(sl_csc_residual(&A, B, 2, NULL, X, 2, B, 2, 3)); /* in place of B */
    SAME_VALUES(B, wanted, 6);
    X[1] = NAN;
    SL_CHECK(sl_csc_residual(&A, R, 2, eta, X, 2, B, 2, 1));
    assert_true(eta[0] != eta[0]);
    SL_CHECK(sl_csc_residual(&A, R, 2, eta, X, 2, B, 2, 0));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, R, 1, eta, X, 2, B, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, R, 2, eta, X, 1, B, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, R, 2, eta, X, 2, B, 1, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, R, 2, eta, X, 2, B, 2, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(&A, NULL, 2, eta, X, 2, B, 2, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_residual(NULL, R, 2, eta, X, 2, B, 2, 1));
}

static void residual_is_the_same_for_every_style(void **state) {
    (void)state;
    gen_list_t t = gen_make(GEN_RANDOM, 40, 0, 8);
    double X[40], B[40], first = -1.0;
    gen_reals(X, 40, 1);
    gen_reals(B, 40, 2);
    for (int which = 0; which < GEN_STYLES; which++) {
        gen_matrix_t M = gen_store(&t, gen_style(which), 31);
        double R[40], eta;
        SL_CHECK(sl_csc_residual(&M.view, R, 40, &eta, X, 40, B, 40, 1));
        assert_true(eta > 0.0);
        if (which == 0) {
            first = eta;
        } else {
            assert_true(fabs(eta - first) <= 1e-13 * first); /* duplicates count in sum, not in magnitude */
        }
        gen_matrix_free(&M);
    }
    gen_list_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triplets_are_sorted_and_summed),
        cmocka_unit_test(triplets_random),
        cmocka_unit_test(triplets_wrong_arguments),
        cmocka_unit_test(triplets_none),
        cmocka_unit_test(check_names_what_is_malformed),
        cmocka_unit_test(triangle_of_every_style),
        cmocka_unit_test(triangle_names_the_lonely_entry),
        cmocka_unit_test(triangle_random_against_dense),
        cmocka_unit_test(transpose_keeps_every_entry),
        cmocka_unit_test(permute_is_a_symmetric_permutation),
        cmocka_unit_test(permute_wrong_arguments),
        cmocka_unit_test(multiply_reads_as_the_factorization_does),
        cmocka_unit_test(multiply_as_stored),
        cmocka_unit_test(residual_and_backward_error),
        cmocka_unit_test(residual_is_the_same_for_every_style),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
