/* test_advice.c: whoever does what a refusal says ends with a small residual, or with a refusal */
#include "tests/lib/judge_matrices.h"
#include "tests/lib/small_pivots.h"

/* What a user may change, and what of it the matrix allows. */
typedef struct attempt {
    const gen_matrix_t *A;
    sl_int laplacian; /* the first rows, which are one */
    int is_regular, is_semidefinite; /* what the user knows of A */
    int is_balanced;                 /* and of b: it sums to 0 there */
    int is_pivoted;
    sl_options opt;
    double *mass, *b, *x;
    char text[512];
} attempt;

static sl_status attempt_solve(attempt *t) {
    const size_t n = (size_t)t->A->view.n_cols;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    if (t->is_pivoted) {
        SL_CHECK(sl_symbolic_create_pivoted(&S, &t->A->view, NULL, NULL));
    } else {
        SL_CHECK(sl_symbolic_create(&S, &t->A->view, NULL, NULL));
    }
    sl_status status = sl_factor_create(&F, S, &t->A->view, &t->opt, &stats);
    if (status == SL_OK) {
        status = sl_factor_solve(F, t->x, n, t->b, n, 1, NULL);
    }
    sl_error_text(t->text, sizeof t->text, status, NULL);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

static int attempt_says(const attempt *t, const char *words) {
    return strstr(t->text, words) != NULL;
}

/* Does what the text says, as far as the user can. Returns whether anything was changed. */
static int attempt_follow(attempt *t) {
    const attempt before = *t;
    if (attempt_says(t, "without sl_symbolic_create_pivoted")) {
        t->is_pivoted = t->is_pivoted && !t->is_semidefinite;
    } else if (attempt_says(t, "sl_symbolic_create_pivoted") && t->is_regular) {
        t->is_pivoted = 1;
    }
    if (attempt_says(t, "options.pivots = SL_PIVOTS_SKIP_NULL") && t->is_semidefinite) {
        t->opt.pivots = SL_PIVOTS_SKIP_NULL;
    }
    if (attempt_says(t, "options.mass") && !t->is_balanced) {
        t->opt.mass = t->mass;
    }
    if (attempt_says(t, "SL_PIVOTS_POSITIVE:")) {
        t->opt.pivots = SL_PIVOTS_NONZERO;
    }
    if (attempt_says(t, "above its default")) {
        t->opt.null_tolerance = 0.0;
    }
    return t->is_pivoted != before.is_pivoted || t->opt.pivots != before.opt.pivots ||
           t->opt.mass != before.opt.mass ||
           t->opt.null_tolerance != before.opt.null_tolerance;
}

/* The residual, without the part of b that options.mass leaves out. */
static double attempt_residual(const attempt *t) {
    const size_t n = (size_t)t->A->view.n_cols, part = (size_t)t->laplacian;
    double *r = test_reals(n), error, most = 0.0, largest = 0.0, sum = 0.0, mass = 0.0;
    SL_CHECK(sl_csc_residual(&t->A->view, r, n, &error, t->x, n, t->b, n, 1));
    for (size_t i = 0; i < part && t->opt.mass; i++) {
        sum += t->b[i];
        mass += t->mass[i];
    }
    for (size_t i = 0; i < n; i++) {
        most = fmax(most, fabs(r[i] - (mass != 0.0 && i < part ? t->mass[i] * (sum / mass) : 0.0)));
        largest = fmax(largest, fabs(t->b[i]));
    }
    free(r);
    return most / largest;
}

/* Follows the advice to its end. What comes first is a refusal that says `first`. Returns the last
 * status; SL_OK only with a small residual. b is 1 in row 0, -1 in row 1 if it is balanced, and 1
 * in all rows from `ones` on. */
static sl_status follow_to_the_end(attempt *t, const char *first, sl_int ones) {
    const size_t n = (size_t)t->A->view.n_cols;
    int steps = 0;
    t->mass = test_reals(n);
    t->b = test_reals(n);
    t->x = test_reals(n);
    for (size_t i = 0; i < n; i++) {
        t->mass[i] = 1.0 + (double)(i % 3);
        t->b[i] = i == 0 || (sl_int)i >= ones ? 1.0 : i == 1 && t->is_balanced ? -1.0 : 0.0;
    }
    sl_status status = attempt_solve(t);
    assert_int_not_equal(status, SL_OK);
    assert_true(attempt_says(t, first));
    while (status != SL_OK && attempt_follow(t)) {
        assert_true(++steps <= 3);
        status = attempt_solve(t);
    }
    if (status == SL_OK) {
        assert_true(attempt_residual(t) <= 1e-6);
    }
    free(t->mass);
    free(t->b);
    free(t->x);
    return status;
}

/* ---- the matrices ---- */

/* A path of n rows whose weights are the powers 0, 1, 2, 0, ... of `scale`; then `regular` rows of
 * their own. */
static gen_matrix_t path(sl_int n, sl_int regular, double scale, double sign) {
    double *M = test_reals((size_t)n * (size_t)n);
    for (sl_int i = 1; i < n; i++) {
        system_spring(M, n, i, i - 1, sign * pow(scale, (double)(i % 3)));
    }
    gen_matrix_t A = beside(M, n, n + regular);
    free(M);
    return A;
}

/* Alone or beside regular rows, in either order, for a b that sums to 0 and one that does not. */
static void laplacians_are_recognized(void **state) {
    (void)state;
    static const double scales[3] = {1.0, 1e-2, 1e-3};
    for (int turn = 0; turn < 48; turn++) {
        gen_matrix_t A = path(200, turn / 4 % 2 ? 0 : 7, scales[turn / 16], turn / 8 % 2 ? -1 : 1);
        attempt t = {.A = &A, .laplacian = 200, .is_semidefinite = 1, .opt = options_none()};
        t.is_pivoted = turn % 2;
        t.is_balanced = turn / 2 % 2;
        assert_int_equal(follow_to_the_end(&t, "sum to 0, as in a Laplacian", 200), SL_OK);
        gen_matrix_free(&A);
    }
}

static void isolated_vertices_are_recognized(void **state) {
    (void)state;
    static const double M[9] = {2.0, 0.0, 0.0, -1.0, 2.0, 0.0, 0.0, 0.0, 0.0};
    for (int is_pivoted = 0; is_pivoted < 2; is_pivoted++) {
        gen_matrix_t A = beside(M, 3, 5);
        attempt t = {.A = &A, .is_semidefinite = 1, .opt = options_none()};
        t.is_pivoted = is_pivoted;
        assert_int_equal(follow_to_the_end(&t, "as that of an isolated vertex", 3), SL_OK);
        gen_matrix_free(&A);
    }
}

static void regular_matrices_get_an_order_by_their_values(void **state) {
    (void)state;
    static const double saddle[9] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 3.0, 4.0};
    static const double grows[4] = {1e-17, 0.0, 1.0, 0.0};
    const double *const M[2] = {saddle, grows};
    for (int k = 0; k < 2; k++) {
        gen_matrix_t A = beside(M[k], 3 - k, 3 - k);
        attempt t = {.A = &A, .is_regular = 1, .opt = options_none()};
        assert_int_equal(follow_to_the_end(&t, "sl_symbolic_create_pivoted", 1), SL_OK);
        assert_true(t.is_pivoted);
        gen_matrix_free(&A);
    }
}

/* What is singular, but no Laplacian, is refused to the end: b is not in its range. */
static void other_singular_matrices(void **state) {
    (void)state;
    static const double plus[9] = {1.0, 0.0, 0.0, 2.0, 4.0, 0.0, 3.0, 6.0, 9.0};
    static const double both[9] = {1.0, 0.0, 0.0, 2.0, -4.0, 0.0, 3.0, -2.0, 1.0};
    for (int k = 0; k < 4; k++) {
        gen_matrix_t A = beside(k % 2 ? both : plus, 3, 3);
        attempt t = {.A = &A, .is_semidefinite = k % 2 == 0, .is_regular = k % 2};
        t.opt = options_none();
        t.is_pivoted = k / 2;
        const char *first = k / 2 ? "singular to working precision" : "options.pivots";
        assert_int_equal(follow_to_the_end(&t, first, 3), SL_ERR_PIVOT);
        gen_matrix_free(&A);
    }
}

static void wrong_options_are_named(void **state) {
    (void)state;
    static const double small[4] = {1.0, 0.0, 1.0, 1.0 + 1e-9};
    static const double mixed[4] = {1.0, 0.0, 1.0, -2.0};
    gen_matrix_t A = beside(small, 2, 2), B = beside(mixed, 2, 2);
    attempt tolerance = {.A = &A, .opt = options_none()}, sign = {.A = &B, .opt = options_none()};
    tolerance.opt.null_tolerance = 1e-6;
    assert_int_equal(follow_to_the_end(&tolerance, "options.null_tolerance", 2), SL_OK);
    sign.opt.pivots = SL_PIVOTS_POSITIVE;
    assert_int_equal(follow_to_the_end(&sign, "refused pivot: SL_PIVOTS_POSITIVE", 2), SL_OK);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laplacians_are_recognized),
        cmocka_unit_test(isolated_vertices_are_recognized),
        cmocka_unit_test(regular_matrices_get_an_order_by_their_values),
        cmocka_unit_test(other_singular_matrices),
        cmocka_unit_test(wrong_options_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
