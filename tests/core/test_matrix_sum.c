/* test_matrix_sum.c: sl_matrix_sum: weighted sums of symmetric matrices in any storage style */
#include "tests/lib/matrix_pair.h"

/* C is the dense sum, lower triangle with ascending rows. An entry of C adds at most 3 stored parts
 * of each of two terms, with a product and a sum for each, so 8 eps bounds its error. */
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

static void sums_match_dense_sums(void **state) {
    (void)state;
    const double c[TERMS] = {0.75, -3};
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        for (int style = 0; style < GEN_STYLES; style++) {
            matrix_pair_t y =
                matrix_pair_make((gen_kind_t)kind, 40, style, (style * 5 + 3) % GEN_STYLES, NULL);
            sl_matrix *A = matrix_pair_sum(&y, c);
            sl_csc C = sl_matrix_view(A), U = sl_matrix_view(y.U);
            assert_is_sum(&C, y.terms, c);
            assert_int_equal(C.p[y.n], U.p[y.n]);
            assert_memory_equal(C.p, U.p, ((size_t)y.n + 1) * sizeof *C.p);
            if (C.p[y.n] > 0) {
                assert_memory_equal(C.i, U.i, (size_t)C.p[y.n] * sizeof *C.i);
            }
            sl_matrix_free(A);
            matrix_pair_free(&y);
        }
    }
}

static void one_term_gives_its_lower_triangle(void **state) {
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

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    const double c[TERMS] = {1, 1};
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 25, 1, 0, NULL);
    sl_matrix *A = (sl_matrix *)(void *)&y;
    sl_options incomplete = options_none();
    sl_stats stats;
    sl_csc wrong[TERMS] = {y.terms[0], y.terms[1]};
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(NULL, c, y.terms, TERMS, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, y.terms, 0, NULL, NULL));
    assert_null(A);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, y.terms, -1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, NULL, 2, NULL, NULL));
    incomplete.allocator.allocate = counter_allocate;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, y.terms, TERMS, &incomplete, NULL));
    wrong[1].x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, wrong, TERMS, NULL, NULL));
    wrong[1].n_rows++;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, NULL, wrong, TERMS, NULL, NULL));
    wrong[1] = y.terms[1];
    wrong[1].n_rows = --wrong[1].n_cols; /* an index out of range */
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_sum(&A, NULL, wrong, TERMS, NULL, &stats));
    assert_int_equal(stats.error.row, y.n - 1);
    const sl_int p[3] = {0, 2, 4}, i[4] = {0, 1, 1, 1}, q[4] = {0, 1, 2, 3}, k[3] = {1, 0, 1};
    const double x[4] = {1, 1, 1, 1};
    const sl_csc small = {2, 2, p, i, x};
    wrong[1] = small;
    /* n = y.n and n = 2 */
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_sum(&A, c, wrong, TERMS, NULL, NULL));
    const sl_csc skew = {3, 3, q, k, x}; /* (1,0), (0,1), (1,2), but no (2,1) */
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_sum(&A, c, &skew, 1, NULL, &stats));
    assert_true(stats.error.row == 1 && stats.error.column == 2);
    assert_null(A);
    matrix_pair_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_match_dense_sums),
        cmocka_unit_test(one_term_gives_its_lower_triangle),
        cmocka_unit_test(wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
