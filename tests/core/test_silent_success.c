/* test_silent_success.c: calls that succeed without a word elsewhere have a signal here */
#include "tests/lib/factored.h"

enum { N = 49 };

/* A refusal has a status, and a text of its own. */
static void assert_refused(sl_status status, sl_status wanted, const sl_stats *stats) {
    char text[300], bare[300];
    (void)sl_error_text(text, sizeof text, status, stats);
    (void)snprintf(bare, sizeof bare, "%s", sl_status_string(status));
    assert_int_equal(status, wanted);
    assert_true(strlen(text) > strlen(bare) + 2);
}

/* Rows of every second vertex, as a set. */
static sl_int some_rows(sl_int *rows) {
    for (sl_int k = 0; k < N / 2; k++) {
        rows[k] = 2 * k;
    }
    return N / 2;
}

/* y's matrix with -100 on the diagonal of a row of some_rows. */
static sl_csc indefinite_of(const factored_t *y, double *values) {
    sl_csc A = y->M.view;
    const sl_int row = 2 * (N / 4);
    memcpy(values, A.x, (size_t)A.p[N] * sizeof *values);
    for (sl_int p = A.p[row]; p < A.p[row + 1]; p++) {
        values[p] -= A.i[p] == row ? 100.0 : 0.0;
    }
    A.x = values;
    return A;
}

/* Every call that would use numbers. */
static void every_use_is_refused(const sl_factor *F, const sl_symbolic *S) {
    const sl_int set[2] = {0, N - 1};
    double b[2 * N] = {1.0}, x[2 * N], log_abs, sign;
    sl_plan *P = NULL;
    sl_matrix *L = NULL;
    sl_selected *Z = NULL;
    sl_region *R = NULL;
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve(F, x, N, b, N, 1, NULL));
    SL_EXPECT(SL_ERR_STALE,
              sl_factor_solve_part(F, NULL, SL_PART_P | SL_PART_L, x, N, b, N, 1, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_logdet(F, &log_abs, &sign));
    SL_EXPECT(SL_ERR_STALE, sl_factor_lower(&L, F, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_inverse_diagonal(F, x, set, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_region_create(&R, F, set, 2, NULL, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, S, set, 2, set, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_plan_solve(P, F, x, 2, b, 2, 1, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_plan_solve_regularized(P, F, x, 2, b, 2, 1, 1, NULL, NULL));
    sl_plan_free(P);
}

/* A factor that could not be made again answers nothing until it can. */
static void a_failed_factor_answers_nothing(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_csc A = y.M.view;
    const sl_int nnz = A.p[N];
    double *x = test_reals((size_t)nnz);
    A.x = x;
    for (int way = 0; way < 3; way++) {
        memcpy(x, y.M.view.x, (size_t)nnz * sizeof *x);
        for (sl_int p = 0; p < nnz; p++) {
            x[p] = way == 0 ? 0.0 : x[p];
        }
        x[0] = way == 1 ? NAN : way == 2 ? INFINITY : x[0];
        assert_int_not_equal(sl_factor_refactor(y.F, &A, NULL), SL_OK);
        every_use_is_refused(y.F, y.S);
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    }
    free(x);
    factored_free(&y);
}

/* A matrix that is not definite: its factor counts the negative pivot, its root is refused, and so
 * is a change that would make a definite matrix one. */
static void an_indefinite_matrix_is_not_taken_for_definite(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_csc A = y.M.view;
    double *values = test_reals((size_t)A.p[N]), b[N] = {1.0}, x[N];
    const sl_int row = N / 2;
    const double less = -100.0;
    sl_stats stats;
    memcpy(values, A.x, (size_t)A.p[N] * sizeof *values);
    A.x = values;
    for (sl_int p = A.p[row]; p < A.p[row + 1]; p++) {
        values[p] += A.i[p] == row ? less : 0.0;
    }
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_change_entries(y.F, NULL, &row, &row, &less, 1, NULL, NULL));
    SL_CHECK(sl_factor_refactor(y.F, &A, &stats));
    assert_int_equal(stats.factor.negative, 1);
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_solve_part(y.F, NULL, SL_PART_P | SL_PART_L | SL_PART_SQRT_D,
                                                 x, N, b, N, 1, NULL));
    free(values);
    factored_free(&y);
}

/* A triangle is not taken for the other one, nor for the whole, nor is a pattern of as many entries
 * for the analyzed one. */
static void another_pattern_is_not_taken_for_the_analyzed_one(void **state) {
    (void)state;
    for (int style = 0; style < 3; style++) {
        factored_t y = factored_make(GEN_GRID2, N, 1, style, NULL);
        const sl_int nnz = y.M.view.p[N];
        sl_factor *F = NULL;
        for (int other = 0; other < 3; other++) {
            factored_t z = factored_make(GEN_GRID2, N, 1, other, NULL);
            if (other != style) {
                SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_refactor(y.F, &z.M.view, NULL));
                SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_create(&F, y.S, &z.M.view, NULL, NULL));
                assert_null(F);
            }
            factored_free(&z);
        }
        sl_int *rows = test_ints((size_t)nnz);
        sl_csc moved = y.M.view;
        memcpy(rows, moved.i, (size_t)nnz * sizeof *rows);
        moved.i = rows;
        rows[nnz / 2] = (rows[nnz / 2] + 1) % N; /* another entry */
        SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_refactor(y.F, &moved, NULL));
        SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_create(&F, y.S, &moved, NULL, NULL));
        free(rows);
        factored_free(&y);
    }
}

/* A given order that names a row twice, or one out of range. */
static void an_order_has_to_be_a_permutation(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    static const sl_int wrong[4] = {0, -1, N, INT32_MAX};
    for (int k = 0; k < 4; k++) {
        sl_int perm[N];
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        for (sl_int i = 0; i < N; i++) {
            perm[i] = N - 1 - i;
        }
        opt.ordering = SL_ORDERING_GIVEN;
        opt.perm = perm;
        SL_CHECK(sl_symbolic_create(&S, &y.M.view, &opt, NULL));
        sl_symbolic_free(S);
        perm[5] = wrong[k];
        SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &y.M.view, &opt, NULL));
        assert_null(S);
    }
    factored_free(&y);
}

/* Pins, restrictions, edits and batches of a matrix that is not definite: by SL_PIVOTS_POSITIVE
 * they are refused, without it the pivot is counted. */
static void derived_factors_count_or_refuse_negative_pivots(void **state) {
    (void)state;
    for (int is_definite = 0; is_definite < 2; is_definite++) {
        sl_options opt = options_none();
        opt.pivots = is_definite ? SL_PIVOTS_POSITIVE : SL_PIVOTS_NONZERO;
        factored_t y = factored_make(GEN_GRID2, N, 1, 0, &opt);
        double *values = test_reals((size_t)y.M.view.p[N]), *scattered = NULL, one = 1.0;
        const sl_csc A = indefinite_of(&y, values);
        sl_int rows[N], same[N];
        const sl_int count = some_rows(rows);
        const sl_status wanted = is_definite ? SL_ERR_PIVOT : SL_OK;
        sl_symbolic *S = NULL;
        sl_factor *G = NULL;
        sl_constraints *P = NULL;
        sl_stats stats;
        sl_status status[3];
        for (sl_int i = 0; i < N; i++) {
            same[i] = i;
        }
        for (int way = 0; way < 3; way++) {
            if (way == 0) { /* the numbers of F are not used */
                status[way] = sl_factor_submatrix(&S, &G, y.F, &A, rows, count, NULL, &stats);
            } else if (way == 1) {
                status[way] = sl_factor_edit(&G, y.F, y.S, &A, same, &opt, &stats);
            } else {
                stats.symbolic = sl_symbolic_view(y.S).info;
                scattered = test_reals((size_t)stats.symbolic.nnz_a);
                SL_CHECK(sl_symbolic_scatter(y.S, scattered, &A, NULL));
                status[way] = sl_factor_create_sums(
                    &G, 1, y.S, &one, (const double *const *)&scattered, 1, &opt, NULL, &stats);
            }
            if (is_definite) {
                assert_refused(status[way], wanted, &stats);
                assert_null(G);
            } else {
                assert_int_equal(status[way], SL_OK);
                assert_int_equal(stats.factor.negative, 1);
                assert_refused(sl_constraints_create(&P, G, NULL), SL_ERR_UNSUPPORTED, NULL);
                assert_null(P);
            }
            sl_factor_free(G);
            G = NULL;
            sl_symbolic_free(S);
            S = NULL;
        }
        free(values);
        free(scattered);
        factored_free(&y);
    }
}

/* The other triangle, one triangle for the whole, and a pattern of another size or of as many
 * entries. A restriction does not compare patterns, but sees a triangle that is not read. */
static void derived_factors_compare_patterns(void **state) {
    (void)state;
    for (int style = 0; style < 3; style++) {
        factored_t y = factored_make(GEN_GRID2, N, 1, style, NULL);
        sl_int rows[N], same[N];
        const sl_int count = some_rows(rows);
        for (sl_int i = 0; i < N; i++) {
            same[i] = i;
        }
        for (int other = 0; other < 4; other++) {
            factored_t z = factored_make(other == 3 ? GEN_PATH : GEN_GRID2, N, 1,
                                         other == 3 ? style : other, NULL);
            const sl_csc *A = &z.M.view;
            sl_symbolic *S = NULL;
            sl_factor *G = NULL;
            sl_stats stats;
            if (other != style) {
                assert_refused(sl_factor_submatrix(&S, &G, y.F, A, rows, count, NULL, &stats),
                               SL_ERR_OTHER_PATTERN, &stats);
                assert_null(S);
                assert_refused(sl_factor_edit(&G, y.F, y.S, A, same, NULL, &stats),
                               SL_ERR_OTHER_PATTERN, &stats);
                assert_null(G);
            }
            if (other == 3) { /* without an entry */
                double *values = test_reals((size_t)y.M.view.p[N]);
                assert_refused(sl_symbolic_scatter(z.S, values, &y.M.view, &stats),
                               SL_ERR_OTHER_PATTERN, &stats);
                free(values);
            }
            factored_free(&z);
        }
        factored_free(&y);
    }
}

/* What was made from a factor that has failed since, and what would be. */
static void nothing_is_derived_from_a_failed_factor(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_csc A = y.M.view;
    double *zeros = test_reals((size_t)A.p[N]), b[N] = {1.0}, x[N] = {0.0}, one = 1.0;
    sl_int rows[N], same[N], failed = 5;
    const sl_int count = some_rows(rows);
    const sl_request request = {NULL, x, N, b, N, 1, y.F};
    sl_symbolic *S = NULL;
    sl_factor *G = NULL;
    sl_constraints *P = NULL, *Q = NULL;
    sl_stats stats;
    for (sl_int i = 0; i < N; i++) {
        same[i] = i;
    }
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(sl_constraints_add(P, rows, NULL, 1, NULL));
    A.x = zeros;
    assert_refused(sl_factor_refactor(y.F, &A, &stats), SL_ERR_PIVOT, &stats);
    A.x = y.M.view.x;
    assert_refused(sl_factor_submatrix(&S, &G, y.F, &A, rows, count, NULL, &stats), SL_ERR_STALE,
                   &stats);
    assert_refused(sl_factor_edit(&G, y.F, y.S, &A, same, NULL, &stats), SL_ERR_STALE, &stats);
    assert_true(S == NULL && G == NULL);
    assert_refused(sl_constraints_create(&Q, y.F, NULL), SL_ERR_STALE, NULL);
    assert_refused(sl_constraints_solve(P, NULL, x, N, b, N, &one, 1, 1, NULL), SL_ERR_STALE, NULL);
    assert_refused(sl_constraints_add(P, rows + 1, NULL, 1, &stats), SL_ERR_STALE, &stats);
    assert_refused(sl_constraints_refactor(P, &stats), SL_ERR_STALE, &stats);
    assert_refused(sl_batch_solve(NULL, &request, 1, NULL, NULL, &failed), SL_ERR_STALE, NULL);
    assert_int_equal(failed, 0);
    assert_true(x[0] == 0.0);
    assert_refused(sl_factor_change_entries(y.F, &A, NULL, rows, NULL, 1, NULL, &stats),
                   SL_ERR_STALE, &stats);
    assert_refused(sl_factor_change_entries(y.F, NULL, rows, rows, &one, 1, NULL, &stats),
                   SL_ERR_STALE, &stats);
    SL_CHECK(sl_factor_refactor(y.F, &A, NULL)); /* a refactorization mends it */
    assert_refused(sl_constraints_solve(P, NULL, x, N, b, N, &one, 1, 1, NULL), SL_ERR_STALE, NULL);
    SL_CHECK(sl_constraints_refactor(P, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, N, b, N, &one, 1, 1, NULL));
    sl_constraints_free(P);
    free(zeros);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_failed_factor_answers_nothing),
        cmocka_unit_test(an_indefinite_matrix_is_not_taken_for_definite),
        cmocka_unit_test(another_pattern_is_not_taken_for_the_analyzed_one),
        cmocka_unit_test(an_order_has_to_be_a_permutation),
        cmocka_unit_test(derived_factors_count_or_refuse_negative_pivots),
        cmocka_unit_test(derived_factors_compare_patterns),
        cmocka_unit_test(nothing_is_derived_from_a_failed_factor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
