/* test_bounds_rare.c: certified factors at the ends of what is accepted: ranges, shifts, trees */
#include "tests/lib/factored.h"

/* An analysis in natural order and a factor of A. */
static sl_factor *factor_of(const sl_csc *A, sl_symbolic **S, const sl_options *opt) {
    sl_factor *F = NULL;
    *S = analyze_natural(A, SL_RELAXATION_DEFAULT);
    SL_CHECK(sl_factor_create(&F, *S, A, opt, NULL));
    return F;
}

/* Of a pivot of at most 1e-200, and of a diagonal entry whose root is not above 1e-100, nothing is
 * guaranteed. */
static void small_pivots_are_not_guaranteed(void **state) {
    (void)state;
    static const sl_int p[2] = {0, 1}, i[1] = {0};
    const double values[3] = {1e-210, nextafter(1e-200, 1.0), 1.1e-200};
    assert_true(values[1] > 1e-200 && sqrt(values[1]) <= 1e-100);
    for (int k = 0; k < 3; k++) {
        const sl_csc A = {1, 1, p, i, values + k};
        sl_symbolic *S = NULL;
        sl_factor *F = factor_of(&A, &S, NULL);
        SL_EXPECT(k < 2 ? SL_ERR_UNSUPPORTED : SL_OK,
                  sl_factor_certify(F, &A, SL_GUARANTEED, NULL, NULL));
        SL_CHECK(sl_factor_certify(F, &A, SL_ESTIMATED, NULL, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* The first shift is half of an eigenvalue that inverse iteration has found, of A scaled to ones on
 * the diagonal. Here the start has no part in the smallest one: it has the same numbers in rows 0
 * and 7, whose difference belongs to 0.1, or is a vector of 2 - 1e-13. The shifted matrix is
 * indefinite, or has a diagonal so small that growth is too large. A smaller shift gives the
 * bound. Zeros keep the rows in their order. */
static void shifts_beyond_the_smallest_eigenvalue(void **state) {
    (void)state;
    static const sl_int p8[9] = {0, 3, 5, 7, 9, 11, 13, 15, 16};
    static const sl_int i8[16] = {0, 1, 7, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7};
    static const double x8[16] = {1.0, 0.0, 0.9, 1.0, 0.0, 1.0, 0.0, 1.0,
                                  0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0};
    static const sl_int p3[4] = {0, 3, 5, 6}, i3[6] = {0, 1, 2, 1, 2, 2};
    const double part = 1.0 - 1e-13, small = ldexp(1.0, -20), square = small * small;
    const double x3[6] = {square, 0.3125 * part * small, 0.51875 * part * square,
                          1.0,    0.65 * part * small,   square};
    const sl_csc A[2] = {{8, 8, p8, i8, x8}, {3, 3, p3, i3, x3}};
    const double smallest[2] = {0.1, 0.3026};
    for (int k = 0; k < 2; k++) {
        sl_symbolic *S = NULL;
        sl_factor *F = factor_of(&A[k], &S, NULL);
        sl_stats stats;
        SL_CHECK(sl_factor_certify(F, &A[k], SL_GUARANTEED, NULL, &stats));
        print_message("eigenvalue %.4f, eta %.1e\n", stats.certificate.eigenvalue_min,
                      stats.certificate.eta);
        assert_true(stats.certificate.eigenvalue_min > smallest[k] / 8.0);
        assert_true(stats.certificate.eigenvalue_min < smallest[k]);
        assert_true(stats.certificate.eta > 0.0 && stats.certificate.eta < 1e-12);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* A pivot that was regularized is none of A. */
static void regularized_pivots_have_no_bounds(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double x[3] = {1.0, 1.0, 1.0};
    const sl_csc A = {2, 2, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_stats stats;
    opt.regularization = 0.5;
    sl_factor *F = factor_of(&A, &S, &opt);
    stats.factor = sl_factor_view(F).info;
    assert_int_equal(stats.factor.regularized, 1);
    assert_int_equal(stats.factor.negative, 0);
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_certify(F, &A, SL_ESTIMATED, NULL, &stats));
    assert_non_null(strstr(stats.error.what, "regularized"));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A tree without a null pivot before one that is centered, whose null pivot is a row of x, too. So
 * is a row of zeros, which an explicit zero joins to this tree: its x is 0. Weights of 2^-1040 have
 * products with epsilon that are 0: eta lacks no more than these. */
static void one_tree_of_two_is_centered(void **state) {
    (void)state;
    static const sl_int p[8] = {0, 2, 4, 5, 7, 9, 11, 12};
    static const sl_int i[12] = {0, 1, 1, 2, 2, 3, 4, 4, 5, 5, 6, 6};
    static const double x[12] = {2.0, -1.0, 2.0, -1.0, 2.0, 1.0, -1.0, 2.0, -1.0, 1.0, 0.0, 0.0};
    static const double b[7] = {1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0};
    static const double exact[7] = {1.0, 1.0, 1.0, 1.0, 0.0, -1.0, 0.0};
    static const sl_int xset[3] = {5, 0, 6};
    const sl_csc A = {7, 7, p, i, x};
    double eta[2], mass[7];
    for (int tiny = 0; tiny < 2; tiny++) {
        double y[7], bounds[7], part[3], part_bounds[3];
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_plan *all = NULL, *some = NULL;
        sl_work *W = NULL;
        sl_stats stats;
        for (int k = 0; k < 7; k++) {
            mass[k] = ldexp(1.0, tiny ? -1040 : 0);
        }
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = mass;
        sl_factor *F = factor_of(&A, &S, &opt);
        SL_CHECK(sl_work_create(&W, NULL));
        SL_CHECK(sl_factor_certify(F, &A, SL_ESTIMATED, W, &stats));
        eta[tiny] = stats.certificate.eta;
        SL_CHECK(sl_plan_create(&all, S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
        SL_CHECK(sl_plan_create(&some, S, NULL, SL_ALL, xset, 3, NULL, NULL));
        SL_CHECK(sl_plan_solve_bounded(all, F, y, 7, bounds, b, 7, 1, NULL, W, NULL));
        SL_CHECK(sl_plan_solve_bounded(some, F, part, 3, part_bounds, b, 7, 1, NULL, W, NULL));
        for (int k = 0; k < 7; k++) {
            assert_true(fabs(y[k] - exact[k]) <= bounds[k]);
            assert_true(bounds[k] > 0.0 && bounds[k] < (k < 6 ? 1e-13 : 1e-300));
        }
        for (int k = 0; k < 3; k++) {
            assert_true(part[k] == y[xset[k]] && part_bounds[k] == bounds[xset[k]]);
        }
        sl_plan_free(all);
        sl_plan_free(some);
        sl_work_free(W);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    print_message("eta %.2e, with tiny weights %.2e\n", eta[0], eta[1]);
    assert_true(eta[1] > 0.0 && eta[1] < eta[0]);
}

/* An explicit zero joins a singular component to a regular one: its null pivot is not the root, and
 * options.null_vector does not know its null vector. */
static void unknown_null_vectors_below_a_root(void **state) {
    (void)state;
    static const sl_int p[6] = {0, 2, 4, 6, 8, 9}, i[9] = {0, 1, 1, 2, 2, 3, 3, 4, 4};
    static const double x[9] = {1.0, -1.0, 2.0, -1.0, 1.0, 0.0, 2.0, -1.0, 2.0};
    static const double mass[5] = {1.0, 1.0, 1.0, 1.0, 1.0}, zeros[5] = {0.0};
    const sl_csc A = {5, 5, p, i, x};
    for (int knows = 0; knows < 2; knows++) {
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_stats stats;
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = mass;
        opt.null_vector = knows ? NULL : zeros;
        sl_factor *F = factor_of(&A, &S, &opt);
        assert_int_not_equal(sl_symbolic_view(S).parent[2], -1);
        SL_EXPECT(knows ? SL_OK : SL_ERR_UNSUPPORTED,
                  sl_factor_certify(F, &A, SL_ESTIMATED, NULL, &stats));
        assert_true(knows || strstr(stats.error.what, "options.null_vector") != NULL);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* A that is no matrix is refused of a restriction, which keeps no pattern, before its size is. */
static void restrictions_check_what_they_are_given(void **state) {
    (void)state;
    static const sl_int rows[2] = {0, 1}, p[3] = {0, 1, 2}, i[2] = {0, 1};
    static const double x[2] = {2.0, 3.0};
    const sl_csc A = {2, 2, p, i, x}, wide = {1, 2, p, rows, x};
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = factor_of(&A, &S, NULL), *G = NULL;
    SL_CHECK(sl_factor_submatrix(&T, &G, F, &A, rows, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_certify(G, NULL, SL_ESTIMATED, NULL, NULL));
    SL_EXPECT(SL_ERR_MALFORMED, sl_factor_certify(G, &wide, SL_ESTIMATED, NULL, NULL));
    SL_CHECK(sl_factor_certify(G, &A, SL_ESTIMATED, NULL, NULL));
    sl_factor_free(G);
    sl_symbolic_free(T);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* No row of x needs neither x nor bounds. An x that overflows has the status of other solves, and
 * infinite bounds. */
/* eta of many components of 3 rows. The one in the middle has a condition of about 300, and the
 * same numbers for any count. */
static double eta_of_parts(sl_int parts, uint64_t seed) {
    gen_list_t t = gen_list(3 * parts);
    sl_symbolic *S = NULL;
    sl_stats stats;
    for (sl_int k = 0; k < parts; k++) {
        const int is_worst = k == parts / 2;
        uint64_t state = is_worst ? seed : seed + 1000 + (uint64_t)k;
        double u[5];
        gen_reals(u, 5, gen_bits(&state));
        const double mass = is_worst ? 0.01 : 1.0 + fabs(u[0]);
        const double first = 1.0 + fabs(u[1]), second = 1.0 + fabs(u[2]);
        gen_add(&t, 3 * k, 3 * k, mass + first);
        gen_add(&t, 3 * k + 1, 3 * k + 1, mass * (1.0 + fabs(u[3])) + first + second);
        gen_add(&t, 3 * k + 2, 3 * k + 2, mass * (1.0 + fabs(u[4])) + second);
        gen_add(&t, 3 * k + 1, 3 * k, -first);
        gen_add(&t, 3 * k + 2, 3 * k + 1, -second);
    }
    gen_matrix_t A = gen_store(&t, gen_style(0), 1);
    sl_factor *F = factor_of(&A.view, &S, NULL);
    SL_CHECK(sl_factor_certify(F, &A.view, SL_ESTIMATED, NULL, &stats));
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    gen_list_free(&t);
    return stats.certificate.eta;
}

/* One component that is conditioned worse than the others shows among 30,000 as it does alone. */
static void the_worst_component_counts(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 6; seed++) {
        assert_true(eta_of_parts(30000, seed) >= 0.6 * eta_of_parts(1, seed));
    }
}

static void no_rows_and_infinite_ones(void **state) {
    (void)state;
    static const sl_int p[2] = {0, 1}, i[1] = {0};
    static const double a = 1e-5;
    const sl_csc A = {1, 1, p, i, &a};
    const double b = 1e306;
    double x = 0.0, bound = 0.0;
    sl_symbolic *S = NULL;
    sl_plan *none = NULL, *all = NULL;
    sl_factor *F = factor_of(&A, &S, NULL);
    SL_CHECK(sl_factor_certify(F, &A, SL_GUARANTEED, NULL, NULL));
    SL_CHECK(sl_plan_create(&none, S, i, 1, i, 0, NULL, NULL));
    SL_CHECK(sl_plan_create(&all, S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_plan_solve_bounded(none, F, NULL, 1, NULL, &b, 1, 1, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_NOT_FINITE,
              sl_plan_solve_bounded(all, F, &x, 1, &bound, &b, 1, 1, NULL, NULL, NULL));
    assert_true(x == HUGE_VAL && bound == HUGE_VAL);
    sl_plan_free(none);
    sl_plan_free(all);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_pivots_are_not_guaranteed),
        cmocka_unit_test(shifts_beyond_the_smallest_eigenvalue),
        cmocka_unit_test(regularized_pivots_have_no_bounds),
        cmocka_unit_test(one_tree_of_two_is_centered),
        cmocka_unit_test(unknown_null_vectors_below_a_root),
        cmocka_unit_test(restrictions_check_what_they_are_given),
        cmocka_unit_test(the_worst_component_counts),
        cmocka_unit_test(no_rows_and_infinite_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
