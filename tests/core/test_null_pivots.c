/* test_null_pivots.c: skipped null pivots: their number and rows, solutions of consistent systems,
 * residuals of others */
#include "tests/lib/parallel_for.h"
#include "tests/lib/factored.h"
#include "tests/lib/graph_laplacian.h"

/* Solves A x = A z, which is consistent, and A x = e_0 + A z, which is not. */
static void assert_solves(const sl_csc *A, const sl_factor *F, sl_int nulls) {
    sl_int n = A->n_cols, count = 0, *rows = test_ints((size_t)n + 1);
    double *z = test_reals((size_t)n), *b = test_reals((size_t)n), *x = test_reals((size_t)n);
    double *r = test_reals((size_t)n), eta;
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, rows, NULL, n, &count));
    assert_int_equal(count, nulls);
    gen_reals(z, (size_t)n, 9);
    SL_CHECK(sl_csc_multiply(A, SL_AS_SYMMETRIC, b, (size_t)n, z, (size_t)n, 1));
    SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
    BACKWARD_PASSES(A, x, (size_t)n, b, (size_t)n, 1);
    for (sl_int k = 0; k < count; k++) {
        assert_true(fabs(x[rows[k]]) < 1e-290);
    }
    /* With a source in row 0 the residual is only in the null row of its component. */
    b[0] += 1.0;
    SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
    SL_CHECK(sl_csc_residual(A, r, (size_t)n, &eta, x, (size_t)n, b, (size_t)n, 1));
    double total = 0.0, most = 0.0;
    for (sl_int i = 0; i < n; i++) {
        most = fmax(most, fabs(x[i]));
        total += r[i];
    }
    for (sl_int k = 0; k < count; k++) {
        r[rows[k]] = 0.0;
    }
    for (sl_int i = 0; i < n; i++) {
        assert_true(fabs(r[i]) <= 1e-11 * (1.0 + most));
    }
    assert_true(fabs(total - 1.0) <= 1e-10 * (1.0 + most));
    free(rows);
    free(z);
    free(b);
    free(x);
    free(r);
}

static void each_component_has_one_null_pivot(void **state) {
    (void)state;
    static const sl_int sizes[3] = {12, 90, 700};
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < LAPLACIAN_KINDS; kind++) {
        for (int size = 0; size < 3; size++) {
            sl_int components = 0;
            gen_matrix_t M =
                laplacian(laplacian_kinds[kind], sizes[size], kind % GEN_STYLES, &components);
            sl_symbolic *S = NULL;
            SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
            for (int k = 0; k < variants.count; k++) {
                sl_options opt = options_skip_null(&variants, k);
                opt.consistency_tolerance = -1.0; /* inconsistent systems are solved too */
                sl_factor *F = NULL;
                sl_stats stats;
                double log_det, sign;
                memset(&stats, 0, sizeof stats);
                SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
                assert_int_equal(stats.factor.null, components);
                assert_int_equal(stats.factor.positive, M.view.n_cols - components);
                assert_int_equal(stats.factor.negative, 0);
                assert_true(stats.factor.pivot_max < 1e300);
                SL_CHECK(sl_factor_logdet(F, &log_det, &sign));
                assert_true(isfinite(log_det) && sign == 1.0);
                assert_solves(&M.view, F, components);
                SL_CHECK(sl_factor_refactor(F, &M.view, &stats));
                assert_int_equal(stats.factor.null, components);
                const sl_int all[1] = {0};
                SL_CHECK(sl_factor_change_entries(F, &M.view, NULL, all, NULL, 1, NULL, &stats));
                assert_int_equal(stats.factor.null, components);
                assert_solves(&M.view, F, components);
                sl_factor_free(F);
                /* Without the option the matrix is refused. */
                opt.pivots = SL_PIVOTS_NONZERO;
                SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
                assert_int_equal(stats.factor.null, 1);
            }
            sl_symbolic_free(S);
            gen_matrix_free(&M);
        }
    }
}

/* Local solves give the bits of the full solve here too, and threads change no bits. */
static void local_solves_and_threads_give_the_same_bits(void **state) {
    (void)state;
    sl_int components = 0;
    gen_matrix_t M = laplacian(GEN_COMPONENTS, 600, 0, &components);
    sl_int n = M.view.n_cols, *bset = test_ints((size_t)n), *xset = test_ints((size_t)n);
    variant_list_t variants = variants_present();
    sl_symbolic *S = NULL;
    sl_plan *P = NULL;
    uint64_t seed = 3;
    gen_set(bset, 20, n, gen_bits(&seed));
    gen_set(xset, 30, n, gen_bits(&seed));
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_plan_create(&P, S, bset, 20, xset, 30, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        for (sl_int nrhs = 1; nrhs <= 9; nrhs++) {
            sl_options opt = options_skip_null(&variants, k);
            sl_factor *F = NULL, *G = NULL;
            int calls = 0;
            opt.consistency_tolerance = -1.0;
            double *B = test_reals((size_t)(20 * nrhs)), *X = test_reals((size_t)(30 * nrhs));
            double *full = test_reals((size_t)(n * nrhs)),
                   *wanted = test_reals((size_t)(30 * nrhs));
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
            opt.threads.count = 3;
            opt.threads.run = run_backwards;
            opt.threads.context = &calls;
            SL_CHECK(sl_factor_create(&G, S, &M.view, FOR_FACTOR(&opt), NULL));
            assert_same_bits(F, G);
            gen_reals(B, (size_t)(20 * nrhs), 8);
            for (sl_int r = 0; r < nrhs; r++) {
                for (int i = 0; i < 20; i++) {
                    full[bset[i] + n * r] = B[i + 20 * r];
                }
            }
            SL_CHECK(sl_factor_solve(F, full, (size_t)n, full, (size_t)n, nrhs, NULL));
            SL_CHECK(sl_plan_solve(P, F, X, 30, B, 20, nrhs, NULL));
            for (sl_int r = 0; r < nrhs; r++) {
                for (int i = 0; i < 30; i++) {
                    wanted[i + 30 * r] = full[xset[i] + n * r];
                }
            }
            SAME_VALUES(X, wanted, (size_t)(30 * nrhs));
            free(B);
            free(X);
            free(full);
            free(wanted);
            sl_factor_free(F);
            sl_factor_free(G);
        }
    }
    free(bset);
    free(xset);
    sl_plan_free(P);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Entries of the inverse belong to the inverse that solves apply: x = 0 in the null rows. */
static void inverse_entries_match_solves(void **state) {
    (void)state;
    sl_int components = 0;
    gen_matrix_t M = laplacian(GEN_COMPONENTS, 120, 0, &components);
    size_t n = (size_t)M.view.n_cols;
    variant_list_t variants = variants_present();
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        opt.consistency_tolerance = -1.0;
        sl_factor *F = NULL;
        sl_selected *Z = NULL;
        double *X = test_reals(n * n), *diagonal = test_reals(n), *selected = test_reals(n),
               most = 0.0;
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
        for (size_t i = 0; i < n; i++) {
            X[i + n * i] = 1.0;
        }
        SL_CHECK(sl_factor_solve(F, X, n, X, n, (sl_int)n, NULL));
        for (size_t i = 0; i < n; i++) {
            most = fmax(most, fabs(X[i + n * i]));
        }
        SL_CHECK(sl_inverse_diagonal(F, diagonal, NULL, SL_ALL, NULL, NULL));
        SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, FOR_OTHERS(&opt), NULL));
        SL_CHECK(sl_selected_entries(Z, selected, NULL, NULL, SL_ALL, NULL));
        for (size_t i = 0; i < n; i++) {
            assert_true(fabs(diagonal[i] - X[i + n * i]) <= 100.0 * (double)n * DBL_EPSILON * most);
            assert_true(fabs(selected[i] - X[i + n * i]) <= 100.0 * (double)n * DBL_EPSILON * most);
        }
        sl_selected_free(Z);
        sl_factor_free(F);
        free(X);
        free(diagonal);
        free(selected);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A definite matrix gives the same bits with the option and without it. A NaN is still an error. */
static void definite_matrices_keep_their_bits_and_nan_fails(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k);
        factored_t y = factored_make(GEN_GRID2, 300, 1, 0, &opt);
        sl_factor *F = NULL;
        sl_int count = 7, one[1];
        opt = options_skip_null(&variants, k);
        SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
        assert_same_bits(F, y.F);
        SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, NULL, NULL, 0, &count));
        assert_int_equal(count, 0);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_pivot_rows(F, SL_PIVOT_NULL, NULL, NULL, 1, &count));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_pivot_rows(F, SL_PIVOT_NULL, one, NULL, -1, &count));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_pivot_rows(F, SL_PIVOT_NULL, one, NULL, 1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_pivot_rows(NULL, SL_PIVOT_NULL, one, NULL, 1, &count));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_pivot_rows(F, (sl_pivot_kind)2, one, NULL, 1, &count));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_pivot_rows(F, (sl_pivot_kind)-1, one, NULL, 1, &count));
        y.M.x[5] = NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(F, &y.M.view, NULL));
        SL_EXPECT(SL_ERR_STALE, sl_factor_pivot_rows(F, SL_PIVOT_NULL, one, NULL, 1, &count));
        sl_factor_free(F);
        opt.pivots = (sl_pivots)(SL_PIVOTS_SKIP_NULL + 1);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
        factored_free(&y);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_component_has_one_null_pivot),
        cmocka_unit_test(local_solves_and_threads_give_the_same_bits),
        cmocka_unit_test(inverse_entries_match_solves),
        cmocka_unit_test(definite_matrices_keep_their_bits_and_nan_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
