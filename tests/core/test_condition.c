/* test_condition.c: condition estimates, inertia and determinants against dense references */
#include "tests/lib/dense_eigen.h"
#include "tests/lib/kkt.h"
#include "tests/lib/factored.h"
#include "tests/lib/graph_laplacian.h"

/* The estimate of 1 / condition is at least the true value and at most 3 times it; both have a
 * relative error of n eps times the condition. */
static void assert_estimate(const sl_factor *F, const sl_csc *A, double *worst) {
    double *M = ref_dense(A), exact = 1.0 / ref_condition(A->n_cols, M), estimate = -1.0,
           again = -1.0;
    sl_work *W = NULL;
    SL_CHECK(sl_factor_rcond(F, A, &estimate, NULL));
    SL_CHECK(sl_work_create(&W, NULL));
    SL_CHECK(sl_factor_rcond(F, A, &again, W));
    sl_work_free(W);
    free(M);
    assert_true(estimate == again);
    double slack = pass_figure(A->n_cols) / exact;
    assert_true(estimate >= exact * (1.0 - slack));
    assert_true(estimate <= 3.0 * exact * (1.0 + slack));
    *worst = fmax(*worst, estimate / exact);
}

static void condition_estimates_are_within_a_factor_of_3(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    double worst = 1.0;
    for (int k = 0; k < variants.count; k++) {
        for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
            for (int size = 0; size < 3; size++) {
                static const sl_int sizes[3] = {5, 40, 130};
                sl_options opt = options_none();
                options_set_variant(&opt, &variants, k);
                factored_t y = factored_make((gen_kind_t)kind, sizes[size], size != 1,
                                             kind % GEN_STYLES, &opt);
                assert_estimate(y.F, &y.M.view, &worst);
                factored_free(&y);
            }
        }
        /* from a good to a bad condition: a path that is fixed more and more weakly */
        for (int step = 0; step < 10; step++) {
            sl_options opt = options_none();
            options_set_variant(&opt, &variants, k);
            gen_matrix_t M = gen_matrix(GEN_SINGULAR, 49, 1, 3);
            sl_symbolic *S = NULL;
            sl_factor *F = NULL;
            M.x[0] += pow(10.0, -step);
            SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
            assert_estimate(F, &M.view, &worst);
            sl_factor_free(F);
            sl_symbolic_free(S);
            gen_matrix_free(&M);
        }
    }
    print_message("estimates up to %.3f times the dense reciprocal condition\n", worst);
}

static void singular_empty_and_invalid_inputs(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    sl_int components = 0;
    gen_matrix_t M = laplacian(GEN_GRID2, 49, 0, &components);
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        double estimate = -1.0;
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_rcond(F, &M.view, &estimate, NULL));
        assert_true(estimate == 0.0);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_rcond(NULL, &M.view, &estimate, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_rcond(F, NULL, &estimate, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_rcond(F, &M.view, NULL, NULL));
        sl_factor_free(F);
        opt = options_none();
        options_set_variant(&opt, &variants, k);
        factored_t none = factored_make(GEN_NONE, 0, 1, 0, &opt);
        SL_CHECK(sl_factor_rcond(none.F, &none.M.view, &estimate, NULL));
        assert_true(estimate == 1.0);
        SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_rcond(none.F, &M.view, &estimate, NULL));
        factored_free(&none);
        /* ||A|| overflows: the estimate stays in 0 .. 1 */
        factored_t y = factored_make(GEN_PATH, 10, 1, 0, &opt);
        for (sl_int p = 0; p < y.M.p[10]; p++) {
            y.M.x[p] *= 1e307;
        }
        if (sl_factor_refactor(y.F, &y.M.view, NULL) == SL_OK) {
            SL_CHECK(sl_factor_rcond(y.F, &y.M.view, &estimate, NULL));
            assert_true(estimate >= 0.0 && estimate <= 1.0);
        }
        /* ||A|| is subnormal, so that 1 / ||A|| and the inverse overflow: not NaN */
        for (sl_int j = 0; j < 10; j++) {
            for (sl_int p = y.M.p[j]; p < y.M.p[j + 1]; p++) {
                y.M.x[p] = y.M.i[p] == j ? 5e-324 : 0.0;
            }
        }
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
        SL_CHECK(sl_factor_rcond(y.F, &y.M.view, &estimate, NULL));
        assert_true(estimate >= 0.0 && estimate <= 1.0);
        y.M.x[0] = NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, &y.M.view, NULL));
        SL_EXPECT(SL_ERR_STALE, sl_factor_rcond(y.F, &y.M.view, &estimate, NULL));
        factored_free(&y);
    }
    gen_matrix_free(&M);
    sl_symbolic_free(S);
    /* memory fails at every point; a workspace that has grown allocates nothing */
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    double b[100], defects[1], estimate = -1.0;
    gen_reals(b, 100, 1);
    for (int64_t k = 0, done = 0; !done; k++) {
        counter_t counter = counter_make();
        sl_work *W = work_failing(&counter, k);
        sl_status status = sl_factor_rcond(y.F, &y.M.view, &estimate, W);
        done = status == SL_OK;
        assert_true(done || (status == SL_ERR_MEMORY && estimate == -1.0));
        if (done) {
            size_t calls = counter.calls;
            SL_CHECK(sl_factor_rcond(y.F, &y.M.view, &estimate, W));
            SL_CHECK(sl_factor_defects(y.F, defects, 1, b, 100, 1, W));
            assert_int_equal(counter.calls, calls);
        }
        sl_work_free(W);
        COUNTER_CLEAN(&counter);
    }
    factored_free(&y);
}

/* The eigenvalues of M, independent of LDL'. Overwrites M. */
static void eigenvalues(sl_int n, double *M, double *values) {
    double *vectors = test_reals((size_t)n * (size_t)n);
    eigen_all(M, vectors, (int)n);
    for (sl_int k = 0; k < n; k++) {
        values[k] = AT(M, k, k);
    }
    free(vectors);
}

/* Inertia, and log |det| as a sum over the eigenvalues, each with an error of n eps times the
 * largest. */
static void inertia_and_determinant_agree_with_eigenvalues(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        for (int kind = GEN_ONE; kind < GEN_SCALED; kind++) {
            for (int sign = -1; sign <= 1; sign++) {
                sl_options opt = options_none();
                options_set_variant(&opt, &variants, k);
                factored_t y = factored_make((gen_kind_t)kind, 40, sign, 0, &opt);
                sl_int n = y.M.view.n_cols, positive = 0;
                for (int huge = 0; huge < 2; huge++) {
                    double *M = ref_dense(&y.M.view), *values = test_reals((size_t)n);
                    double log_det, det_sign, sum = 0.0, most = 0.0, slack = 0.0;
                    sl_stats stats;
                    memset(&stats, 0, sizeof stats);
                    for (sl_int p = 0; huge && p < y.M.p[n]; p++) {
                        y.M.x[p] *= 0x1p300; /* the determinant overflows a double */
                    }
                    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, &stats));
                    SL_CHECK(sl_factor_logdet(y.F, &log_det, &det_sign));
                    eigenvalues(n, M, values);
                    positive = 0;
                    for (sl_int i = 0; i < n; i++) {
                        most = fmax(most, fabs(values[i]));
                    }
                    for (sl_int i = 0; i < n; i++) {
                        positive += values[i] > 0.0;
                        sum += log(fabs(values[i])) + (huge ? 300.0 * log(2.0) : 0.0);
                        slack += pass_figure(n) * most / fabs(values[i]);
                    }
                    assert_int_equal(stats.factor.positive, positive);
                    assert_int_equal(stats.factor.negative, n - positive);
                    assert_int_equal(stats.factor.null, 0);
                    assert_true(det_sign == ((n - positive) % 2 ? -1.0 : 1.0));
                    assert_true(fabs(log_det - sum) <= slack + pass_figure(n) * fabs(sum));
                    free(M);
                    free(values);
                }
                factored_free(&y);
            }
        }
    }
}

/* Without its null rows, a Laplacian has the determinant of the matrix-tree theorem: in each
 * component the product of the nonzero eigenvalues divided by the number of rows. */
static void the_determinant_of_a_laplacian_follows_the_matrix_tree_theorem(void **state) {
    (void)state;
    static const gen_kind_t kinds[4] = {GEN_PATH, GEN_GRID2, GEN_FOREST, GEN_COMPONENTS};
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < 4; kind++) {
        sl_int components = 0, of[60];
        gen_matrix_t L = laplacian_of(kinds[kind], 60, 0, &components, of);
        sl_int n = L.view.n_cols;
        double *M = ref_dense(&L.view), *values = test_reals((size_t)n), sum = 0.0, slack = 0.0;
        sl_symbolic *S = NULL;
        eigenvalues(n, M, values);
        sl_int nulls = 0;
        for (sl_int i = 0; i < n; i++) {
            if (fabs(values[i]) < 1e-12) {
                nulls++;
            } else {
                sum += log(values[i]);
                slack += 1e-13 / values[i];
            }
        }
        assert_int_equal(nulls, components);
        for (sl_int c = 0; c < n; c++) {
            sl_int rows = 0;
            for (sl_int i = 0; i < n; i++) {
                rows += of[i] == c;
            }
            sum -= rows > 0 ? log((double)rows) : 0.0;
        }
        SL_CHECK(sl_symbolic_create(&S, &L.view, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_skip_null(&variants, k);
            sl_factor *F = NULL;
            sl_stats stats;
            double log_det, sign;
            memset(&stats, 0, sizeof stats);
            SL_CHECK(sl_factor_create(&F, S, &L.view, &opt, &stats));
            SL_CHECK(sl_factor_logdet(F, &log_det, &sign));
            assert_int_equal(stats.factor.null, nulls);
            assert_int_equal(stats.factor.positive, n - nulls);
            assert_true(sign == 1.0);
            assert_true(fabs(log_det - sum) <= slack + pass_figure(n) * (fabs(sum) + 1.0));
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&L);
        free(M);
        free(values);
    }
}

/* The solves of the estimate overflow, inf - inf included, or all of A is regularized: 0, not NaN.
 */
static void an_estimate_without_a_number_is_zero(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double x[2][3] = {{1e-320, 5e-321, 1e-320}, {0.0, 0.0, 0.0}};
    for (int k = 0; k < 2; k++) {
        const sl_csc A = {2, 2, p, i, x[k]};
        sl_options opt = options_none();
        sl_symbolic *S;
        sl_factor *F;
        double estimate = -1.0;
        opt.regularization = k == 0 ? 0.0 : 1e-8;
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
        SL_CHECK(sl_factor_rcond(F, &A, &estimate, NULL));
        assert_true(estimate == 0.0);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(condition_estimates_are_within_a_factor_of_3),
        cmocka_unit_test(singular_empty_and_invalid_inputs),
        cmocka_unit_test(inertia_and_determinant_agree_with_eigenvalues),
        cmocka_unit_test(the_determinant_of_a_laplacian_follows_the_matrix_tree_theorem),
        cmocka_unit_test(an_estimate_without_a_number_is_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
