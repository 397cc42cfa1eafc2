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
    sl_options wrong = options_none();
    wrong.size = 1;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(&P, y.S, &row, 1, &row, 1, &wrong, NULL));
    assert_null(P);
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_complex_plan_create(&P, y.S, &row, MANY / 2 + 1, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_TOO_LARGE,
              sl_complex_plan_create(&P, y.S, &row, 1, &row, MANY / 2 + 1, NULL, NULL));
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
        cmocka_unit_test(wrong_sets_are_refused),
        cmocka_unit_test(no_set_is_all_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
