/* test_advice_limits.c: texts of growth, storage and bounds say what to do without them */
#include "tests/lib/advised_calls.h"

/* Each call below is refused with its text, and with `heeds` does what the text says. */

/* The lower triangle of a 2 x 2 matrix, in an order by its values or not. */
static sl_status two_rows(const double *values, int is_pivoted, const sl_options *opt,
                          const double *f) {
    static const sl_int p[] = {0, 2, 3}, i[] = {0, 1, 1};
    const sl_csc A = {2, 2, p, i, values};
    double solution[2], error = 1.0;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    if (is_pivoted) {
        SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, NULL));
    } else {
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    }
    const sl_status status = sl_factor_create(&F, S, &A, opt, NULL);
    if (status == SL_OK) {
        double r[2];
        SL_CHECK(sl_factor_solve(F, solution, 2, f, 2, 1, NULL));
        SL_CHECK(sl_csc_residual(&A, r, 2, &error, solution, 2, f, 2, 1));
        assert_true(error <= 1e-12);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

/* ---- growth, float, pivots ---- */

static const double small_diagonal[] = {1e-9, 1.0, 1e-9}, ones[] = {1.0, 2.0};

static sl_status growth(int heeds) {
    sl_options opt = options_none();
    opt.growth_limit = 1e6;
    return two_rows(small_diagonal, heeds, &opt, ones);
}

static sl_status growth_limit(int heeds) {
    sl_options opt = options_none();
    opt.growth_limit = heeds ? 0.0 : 1e-3;
    return two_rows(small_diagonal, 1, &opt, ones);
}

/* A definite matrix between rows of 1e-22 and 1e19: L has an entry above the range of float. */
static sl_status large_in_float(int heeds) {
    static const double values[] = {1e-44, 5e-4, 1e38}, f[] = {1e-22, 1e19};
    sl_options opt = options_none();
    opt.storage = heeds ? SL_STORAGE_DOUBLE : SL_STORAGE_FLOAT;
    return two_rows(values, 0, &opt, f);
}

static sl_status skipping_pairs(int heeds) {
    static const double laplacian[] = {1.0, -1.0, 1.0}, balanced[] = {1.0, -1.0};
    sl_options opt = skipping();
    return two_rows(laplacian, !heeds, &opt, balanced);
}

static sl_status real_as_complex(int heeds) {
    static const double values[] = {3.0, 1.0, 2.0};
    sl_options opt = options_none();
    opt.storage = heeds ? SL_STORAGE_DOUBLE : SL_STORAGE_COMPLEX;
    return two_rows(values, 1, &opt, ones);
}

/* ---- bounds ---- */

/* Where there are no bounds, refinement measures the error. */
static sl_status no_bounds(int heeds) {
    double *negative = test_reals((size_t)grid.M.p[N]);
    sl_csc A = grid.M.view;
    for (sl_int k = 0; k < grid.M.p[N]; k++) {
        negative[k] = -grid.M.x[k];
    }
    A.x = negative;
    sl_factor *F = factor_of(grid.S, &A, NULL);
    sl_status status;
    if (heeds) {
        SL_CHECK(sl_factor_solve(F, x, N, b, N, 1, NULL));
        status = sl_factor_refine(F, &A, x, N, b, N, 1, 2, NULL, NULL);
    } else {
        status = sl_factor_certify(F, &A, SL_ESTIMATED, NULL, NULL);
    }
    status = judged(&A, -1, status);
    sl_factor_free(F);
    free(negative);
    return status;
}

static sl_status guaranteed_in_float(int heeds) {
    sl_options opt = options_none();
    opt.storage = SL_STORAGE_FLOAT;
    sl_factor *F = factor_of(grid.S, &grid.M.view, &opt);
    const sl_status status =
        sl_factor_certify(F, &grid.M.view, heeds ? SL_ESTIMATED : SL_GUARANTEED, NULL, NULL);
    sl_factor_free(F);
    return status;
}

static sl_status bounds_of_huge(int heeds) {
    double *huge = test_reals((size_t)grid.M.p[N]);
    sl_csc A = grid.M.view;
    for (sl_int k = 0; k < grid.M.p[N]; k++) {
        huge[k] = (heeds ? 1.0 : 1e210) * grid.M.x[k];
    }
    A.x = huge;
    sl_factor *F = factor_of(grid.S, &A, NULL);
    const sl_status status = sl_factor_certify(F, &A, SL_GUARANTEED, NULL, NULL);
    sl_factor_free(F);
    free(huge);
    return status;
}

/* Two springs and a weak one between them, which the diagonal has rounded away: pins in both parts
 * hold what the weak pivot leaves open. */
static sl_status weak_pivot(int heeds) {
    static const sl_int p[] = {0, 2, 4, 6, 7}, i[] = {0, 1, 1, 2, 2, 3, 3}, held[] = {0, 3};
    static const double values[] = {77.0, -77.0, 77.0, -4e-15, 0.125 + 4e-15, -0.125, 0.125};
    const sl_csc A = {4, 4, p, i, values};
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    const sl_options opt = skipping();
    sl_factor *F = factor_of(S, &A, &opt);
    sl_status status;
    assert_int_equal(sl_factor_view(F).info.weak, 1);
    if (heeds) {
        const double g[] = {0.0, 0.0}, f[] = {0.0, 77.0, 0.125, 0.0};
        sl_fixed *D = NULL;
        SL_CHECK(sl_fixed_create(&D, &A, held, 2, NULL, NULL));
        status = sl_fixed_solve(D, x, 4, f, 4, g, 2, 1, NULL);
        assert_true(fabs(x[1] - 1.0) + fabs(x[2] - 1.0) <= 1e-12);
        sl_fixed_free(D);
    } else {
        status = sl_factor_certify(F, &A, SL_ESTIMATED, NULL, NULL);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

/* ---- leading dimensions ---- */

static sl_status small_ldg_of_fixed(int heeds) {
    static const sl_int rows[] = {5, 6};
    const double g[] = {0.0, 0.0};
    sl_fixed *D = NULL;
    SL_CHECK(sl_fixed_create(&D, &grid.M.view, rows, 2, NULL, NULL));
    const sl_status status = sl_fixed_solve(D, x, N, b, N, g, heeds ? 2 : 1, 1, NULL);
    assert_true(status != SL_OK || x[5] == 0.0);
    sl_fixed_free(D);
    return status;
}

static sl_status small_ldg_of_pins(int heeds) {
    static const sl_int rows[] = {5, 6};
    const double g[] = {0.0, 0.0};
    sl_constraints *P = NULL;
    SL_CHECK(sl_constraints_create(&P, grid.F, NULL));
    SL_CHECK(sl_constraints_add(P, rows, NULL, 2, NULL));
    const sl_status status = sl_constraints_solve(P, NULL, x, N, b, N, g, heeds ? 2 : 1, 1, NULL);
    assert_true(status != SL_OK || x[5] == 0.0);
    sl_constraints_free(P);
    return status;
}

/* A column of the inverse, by a block with two rows. */
static sl_status block_of_rows(int heeds) {
    static const sl_int rows[] = {5, 6};
    double z[4], e[N] = {0.0};
    e[5] = 1.0;
    const sl_status status =
        sl_inverse_block(grid.F, z, heeds ? 2 : SL_ROWS(2), rows, 2, rows, 2, NULL, NULL);
    SL_CHECK(sl_factor_solve(grid.F, e, N, e, N, 1, NULL));
    assert_true(status != SL_OK || fabs(z[1] - e[6]) <= 1e-12);
    return status;
}

static const advice_t advices[] = {
    {"sl_symbolic_create_pivoted avoids pivot growth", growth},
    {"pivot growth exceeds options.growth_limit", growth_limit},
    {"SL_PIVOTS_SKIP_NULL with an analysis for 2x2 pivots", skipping_pairs},
    {"SL_STORAGE_COMPLEX: blocks of 2 rows, 2 null vectors, not regularized", real_as_complex},
    {"bounds with negative, regularized or 2x2 pivots or SL_STORAGE_COMPLEX", no_bounds},
    {"SL_GUARANTEED with a diagonal entry or pivot out of range", bounds_of_huge},
    {"a pivot within rounding of 0 was kept: stats.factor.weak", weak_pivot},
    {"ldg is below the number of fixed rows, or nrhs with SL_ROWS (least 2, value 1)",
     small_ldg_of_fixed},
    {"ldg is below the number of pins, or nrhs with SL_ROWS (least 2, value 1)", small_ldg_of_pins},
    {"ldz is one of SL_ROWS", block_of_rows},
};

static const advice_t of_float[] = {
    {"float cannot hold L: options.storage", large_in_float},
    {"SL_GUARANTEED with null pivots, L in float, duplicate entries of A or sl_factor_submatrix",
     guaranteed_in_float},
};

static void advice_of_limits_is_right(void **state) {
    (void)state;
    if (keeps_float()) {
        follow_all(of_float, sizeof of_float / sizeof *of_float);
    }
    follow_all(advices, sizeof advices / sizeof *advices);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(advice_of_limits_is_right),
    };
    return cmocka_run_group_tests(tests, advice_set_up, advice_tear_down);
}
