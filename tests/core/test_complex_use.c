/* test_complex_use.c: what calls for complex Hermitian systems refuse; sets that are all rows */
#include "tests/lib/test.h"

enum { N = 3, MANY = INT32_MAX - 7 };

/* The lower triangle of [4 0 i; 0 4 1; -i 1 4]. */
static const sl_int pattern_p[N + 1] = {0, 2, 4, 5}, pattern_i[5] = {0, 2, 1, 2, 2};
static const double pattern_x[10] = {4, 0, 0, -1, 4, 0, 1, 0, 4, 0};
static const sl_hermitian hermitian = {N, pattern_p, pattern_i, pattern_x, NULL};

static void too_many_rows_are_refused(void **state) {
    (void)state;
    sl_hermitian H = hermitian;
    sl_matrix *M = (sl_matrix *)(void *)&H;
    H.n = MANY / 2 + 1;
    SL_EXPECT(SL_ERR_TOO_LARGE, sl_matrix_from_hermitian(&M, &H, NULL, NULL));
    assert_null(M);
    sl_int out[2], row = 0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_rows(out, &row, MANY / 2 + 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_rows(out, NULL, 1));
}

/* A pattern with an entry less or more than the real matrix, or of another size, and a matrix
 * without values. The real matrix keeps its values. */
static void other_patterns_do_not_refill(void **state) {
    (void)state;
    static const sl_int less_p[N + 1] = {0, 1, 3, 4}, less_i[4] = {0, 1, 2, 2};
    static const sl_int last_p[N + 1] = {0, 2, 3, 4}, last_i[4] = {0, 2, 1, 2};
    static const sl_int more_p[N + 1] = {0, 3, 5, 6}, more_i[6] = {0, 1, 2, 1, 2, 2};
    static const sl_int small_p[3] = {0, 1, 2}, small_i[2] = {0, 1};
    static const double x[14] = {9, 0, 9, 0, 9, 0, 9, 0, 9, 0, 9, 0, 9, 0};
    static const sl_int late_p[N + 1] = {0, 2, 4, 7}, late_i[7] = {0, 1, 1, 2, 2, 1, 0};
    static const sl_int end_i[6] = {0, 2, 1, 1, 2, 2}; /* the entry more ends its column */
    const sl_hermitian others[6] = {{N, less_p, less_i, x, NULL}, {N, more_p, end_i, x, NULL},
                                    {N, last_p, last_i, x, NULL}, {N, more_p, more_i, x, NULL},
                                    {N, late_p, late_i, x, NULL}, {2, small_p, small_i, x, NULL}};
    sl_stats stats;
    sl_matrix *M;
    SL_CHECK(sl_matrix_from_hermitian(&M, &hermitian, NULL, NULL));
    const sl_csc A = sl_matrix_view(M);
    double before[20];
    assert_true(A.p[2 * N] <= 20);
    memcpy(before, A.x, (size_t)A.p[2 * N] * sizeof *before);
    for (int k = 0; k < 6; k++) {
        SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_matrix_refill_hermitian(M, &others[k], &stats));
        assert_memory_equal(before, A.x, (size_t)A.p[2 * N] * sizeof *before);
    }
    sl_matrix_free(M);

    /* as many columns, and other rows */
    const sl_int i[1] = {0}, j[1] = {0};
    SL_CHECK(sl_matrix_from_triplets(&M, 5, 2 * N, 1, i, j, x, NULL, NULL));
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_matrix_refill_hermitian(M, &hermitian, NULL));
    sl_matrix_free(M);

    sl_hermitian H = hermitian;
    H.x = NULL;
    SL_CHECK(sl_matrix_from_hermitian(&M, &H, NULL, NULL)); /* the pattern alone */
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_refill_hermitian(M, &hermitian, NULL));
    sl_matrix_free(M);
}

typedef struct system_t {
    sl_matrix *M;
    sl_symbolic *S;
    sl_factor *F;
} system_t;

static system_t system_make(void) {
    system_t y;
    SL_CHECK(sl_matrix_from_hermitian(&y.M, &hermitian, NULL, NULL));
    const sl_csc A = sl_matrix_view(y.M);
    SL_CHECK(sl_symbolic_create(&y.S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &A, NULL, NULL));
    return y;
}

static void system_free(system_t *y) {
    sl_factor_free(y->F);
    sl_symbolic_free(y->S);
    sl_matrix_free(y->M);
}

static void wrong_sets_are_refused(void **state) {
    (void)state;
    const sl_int row = 0;
    system_t y = system_make();
    sl_plan *P = (sl_plan *)(void *)&y;
    double Z[2] = {7, 7};
    sl_options wrong = options_none();
    wrong.size = 1;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(&P, y.S, &row, 1, &row, 1, &wrong, NULL));
    assert_null(P);
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_complex_plan_create(&P, y.S, &row, MANY / 2 + 1, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_complex_plan_create(&P, y.S, &row, 1, &row, MANY / 2 + 1, NULL, NULL));

    const size_t half = SIZE_MAX / 2;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_inverse_block(NULL, Z, 1, &row, 1, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_complex_inverse_block(y.F, Z, half + 1, &row, 1, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_inverse_block(y.F, Z, 1, NULL, 1, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_inverse_block(y.F, Z, 1, &row, 1, NULL, 1, NULL, NULL));
    SL_CHECK(sl_complex_inverse_block(y.F, Z, 1, NULL, 0, NULL, 0, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_inverse_pairs(NULL, Z, &row, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_inverse_pairs(y.F, Z, NULL, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_inverse_pairs(y.F, Z, &row, NULL, 1, NULL, NULL));
    SL_CHECK(sl_complex_inverse_pairs(y.F, Z, NULL, NULL, 0, NULL, NULL));
    assert_true(Z[0] == 7 && Z[1] == 7);
    system_free(&y);
}

/* A set that is NULL is all rows: the plan gives the bits of the full solve. */
static void no_set_is_all_rows(void **state) {
    (void)state;
    const sl_int rows[2] = {2, 0};
    system_t y = system_make();
    double b[2 * N] = {1, 2, 0, 0, 3, 4}, part[4] = {3, 4, 1, 2}, full[2 * N], x[2 * N];
    sl_plan *P;
    SL_CHECK(sl_factor_solve(y.F, full, 2 * N, b, 2 * N, 1, NULL));
    SL_CHECK(sl_complex_plan_create(&P, y.S, rows, 2, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, y.F, x, 2 * N, part, 4, 1, NULL));
    assert_memory_equal(x, full, sizeof x);
    sl_plan_free(P);
    SL_CHECK(sl_complex_plan_create(&P, y.S, NULL, SL_ALL, rows, 2, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, y.F, x, 4, b, 2 * N, 1, NULL));
    assert_memory_equal(x, full + 4, 2 * sizeof *x);
    assert_memory_equal(x + 2, full, 2 * sizeof *x);
    sl_plan_free(P);
    system_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_many_rows_are_refused),
        cmocka_unit_test(other_patterns_do_not_refill),
        cmocka_unit_test(wrong_sets_are_refused),
        cmocka_unit_test(no_set_is_all_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
