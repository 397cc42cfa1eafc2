/* test_not_finite.c: a number of b that is not finite is reported where x depends on it */
#include "tests/lib/factored.h"
#include "tests/lib/parallel_for.h"

enum { RHS = 35 };

static const double bad[3] = {NAN, INFINITY, -INFINITY};

/* The tree of each column of L. */
static sl_int root_of(const sl_symbolic_arrays *v, sl_int column) {
    while (v->parent[column] != -1) {
        column = v->parent[column];
    }
    return column;
}

/* In each row, each kind of number, in one of several right-hand sides; full and local solves. */
static void every_row_of_b(void **state) {
    (void)state;
    static const gen_kind_t kinds[6] = {GEN_GRID2,      GEN_KKT,      GEN_FOREST,
                                        GEN_COMPONENTS, GEN_DIAGONAL, GEN_STAR};
    static const sl_int counts[4] = {1, 3, 8, RHS};
    for (int kind = 0; kind < 6; kind++) {
        factored_t y = factored_make(kinds[kind], 60, 1, 0, NULL);
        const sl_int n = y.M.view.n_cols;
        const sl_symbolic_arrays v = sl_symbolic_view(y.S);
        double *B = test_reals((size_t)(n * RHS)), *X = test_reals((size_t)(n * RHS));
        int calls = 0;
        sl_options opt = options_none();
        sl_work *W = NULL;
        opt.threads.count = 3;
        opt.threads.run = run_backwards;
        opt.threads.context = &calls;
        SL_CHECK(sl_work_create(&W, &opt));
        gen_reals(B, (size_t)(n * RHS), 3);
        for (sl_int row = 0; row < n; row++) {
            const sl_int nrhs = counts[row % 4], which = row % nrhs, x_row = (7 * row + 1) % n;
            const sl_int reaches = root_of(&v, v.iperm[row]) == root_of(&v, v.iperm[x_row]);
            const double keep = B[row + n * which];
            B[row + n * which] = bad[row % 3];
            SL_EXPECT(SL_ERR_NOT_FINITE,
                      sl_factor_solve(y.F, X, (size_t)n, B, (size_t)n, nrhs, row % 2 ? W : NULL));
            assert_true(!(fabs(X[row + n * which]) <= DBL_MAX)); /* written, and so are others */
            assert_true(nrhs == 1 || fabs(X[row + n * (which == 0)]) <= DBL_MAX);
            SL_EXPECT(reaches ? SL_ERR_NOT_FINITE : SL_OK,
                      sl_local_solve(y.F, &row, 1, &x_row, 1, X, 1, &bad[row % 3], 1, 1, W, NULL));
            B[row + n * which] = keep;
        }
        sl_work_free(W);
        free(B);
        free(X);
        factored_free(&y);
    }
}

/* In a region the sweeps end before the roots; pins change what comes between them. */
static void regions_pins_and_batches(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_int set[60];
    double b[60], x[60], B[400], X[400], g = 1.0;
    sl_region *R = NULL;
    sl_plan *P = NULL;
    sl_constraints *pins = NULL;
    sl_options opt = options_none();
    for (sl_int k = 0; k < 60; k++) {
        set[k] = 100 + k % 6 + 20 * (k / 6);
    }
    SL_CHECK(sl_region_create(&R, y.F, set, 60, NULL, NULL, NULL));
    opt.region = R;
    SL_CHECK(sl_plan_create(&P, y.S, set, 60, set, 60, &opt, NULL));
    SL_CHECK(sl_constraints_create(&pins, y.F, NULL));
    SL_CHECK(sl_constraints_add(pins, set, NULL, 1, NULL));
    gen_reals(b, 60, 1);
    gen_reals(B, 400, 1);
    SL_CHECK(sl_plan_solve(P, y.F, x, 60, b, 60, 1, NULL));
    for (sl_int k = 1; k < 60; k++) {
        const double keep = b[k];
        sl_int failed = 7;
        b[k] = B[set[k]] = bad[k % 3];
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_plan_solve(P, y.F, x, 60, b, 60, 1, NULL));
        SL_EXPECT(SL_ERR_NOT_FINITE,
                  sl_constraints_solve(pins, NULL, X, 400, B, 400, &g, 1, 1, NULL));
        const sl_request requests[3] = {{NULL, X, 400, X, 400, 0, NULL},
                                        {P, x, 60, b, 60, 1, NULL},
                                        {P, x, 60, b, 60, 1, NULL}};
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_batch_solve(y.F, requests, 3, NULL, NULL, &failed));
        assert_int_equal(failed, 1);
        b[k] = B[set[k]] = keep;
    }
    sl_constraints_free(pins);
    sl_plan_free(P);
    sl_region_free(R);
    factored_free(&y);
}

/* With several null vectors x is 0 at their null pivots. */
static void several_null_vectors(void **state) {
    (void)state;
    gen_list_t t = gen_make(GEN_SINGULAR, 49, 1, 1);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    double z[2 * 49], b[49] = {0.0}, x[49];
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    for (int k = 0; k < 49; k++) {
        z[k] = 1.0;
        z[49 + k] = k % 7;
    }
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.null_vector = z;
    opt.null_vector_count = 2;
    opt.consistency_tolerance = -1.0;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    SL_CHECK(sl_factor_solve(F, x, 49, b, 49, 1, NULL));
    b[3] = NAN;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_solve(F, x, 49, b, 49, 1, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_of_b),
        cmocka_unit_test(regions_pins_and_batches),
        cmocka_unit_test(several_null_vectors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
