/* test_no_singular.c: SL_NO_SINGULAR: what is refused, by name, and regular systems as ever */
#define SPARSE_LOCAL_IMPLEMENTATION
#include "tests/lib/no_kernels.h"
#ifndef SL_NO_SINGULAR
#define SL_NO_SINGULAR
#endif
#include "tests/lib/check_factor.h"

/* A Laplacian of a path, with this at the end of its diagonal: 1: singular, 2: regular. */
enum { ROWS = 5 };
static const sl_int columns[] = {0, 2, 4, 6, 8, 9}, rows[] = {0, 1, 1, 2, 2, 3, 3, 4, 4};
static double values[] = {1, -1, 2, -1, 2, -1, 2, -1, 1};

static sl_csc path_with(double last) {
    sl_csc A = {ROWS, ROWS, columns, rows, values};
    values[8] = last;
    return A;
}

/* The factor of a regular path. */
static sl_factor *factor_of(sl_symbolic **S) {
    const sl_csc A = path_with(2);
    sl_factor *F = NULL;
    SL_CHECK(sl_symbolic_create(S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, *S, &A, NULL, NULL));
    return F;
}

static void is_refused(const sl_options *opt, const char *what) {
    const sl_csc A = path_with(1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    assert_int_equal(sl_factor_create(&F, S, &A, opt, &stats), SL_ERR_UNSUPPORTED);
    assert_null(F);
    assert_non_null(strstr(stats.error.what, what));
    assert_non_null(strstr(stats.error.what, "SL_NO_SINGULAR"));
    sl_symbolic_free(S);
}

static void options_are_refused_by_name(void **state) {
    const double ones[ROWS] = {1, 1, 1, 1, 1};
    sl_options opt = options_none();
    (void)state;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    is_refused(&opt, "options.pivots");
    opt.pivots = SL_PIVOTS_NONZERO;
    opt.mass = ones;
    is_refused(&opt, "options.mass");
    opt.mass = NULL;
    opt.null_vector = ones;
    is_refused(&opt, "options.null_vector");
    opt.null_vector = NULL;
    opt.null_vector_count = 1;
    is_refused(&opt, "options.null_vector");
    opt.null_vector_count = 0;
    opt.consistency_tolerance = -1;
    is_refused(&opt, "options.consistency_tolerance");
}

/* What is said of a null pivot leads to options.pivots, which names the macro. */
static void a_null_pivot_leads_to_the_macro(void **state) {
    const sl_csc A = path_with(1);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    (void)state;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    assert_int_equal(sl_factor_create(&F, S, &A, NULL, &stats), SL_ERR_PIVOT);
    assert_non_null(strstr(stats.error.what, "options.pivots = SL_PIVOTS_SKIP_NULL"));
    sl_symbolic_free(S);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    is_refused(&opt, "options.pivots = SL_PIVOTS_SKIP_NULL");
}

static void calls_of_null_spaces_are_refused(void **state) {
    double Y[1], B[ROWS] = {0};
    sl_pseudo_inverse P;
    sl_symbolic *S = NULL;
    sl_factor *F = factor_of(&S);
    (void)state;
    memset(&P, 0, sizeof P);
    assert_int_equal(sl_factor_defects(F, Y, 1, B, ROWS, 1, NULL), SL_ERR_UNSUPPORTED);
    assert_int_equal(sl_factor_pseudo_inverse(F, &P, NULL), SL_ERR_UNSUPPORTED);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* b is A x for x = 1 .. 5. */
static void regular_systems_are_solved(void **state) {
    double X[ROWS], B[ROWS] = {-1, 0, 0, 0, 6};
    sl_symbolic *S = NULL;
    sl_factor *F = factor_of(&S);
    (void)state;
    SL_CHECK(sl_factor_solve(F, X, ROWS, B, ROWS, 1, NULL));
    for (sl_int i = 0; i < ROWS; i++) {
        assert_true(fabs(X[i] - (i + 1)) < 1e-13);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options_are_refused_by_name),
        cmocka_unit_test(a_null_pivot_leads_to_the_macro),
        cmocka_unit_test(calls_of_null_spaces_are_refused),
        cmocka_unit_test(regular_systems_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
