/* test_refine.c: sl_factor_refine: any start, nearby factors, regularized, singular systems */
#include "tests/lib/kkt.h"
#include "tests/lib/factored.h"
#include "tests/lib/graph_laplacian.h"

/* The componentwise backward error that refinement must reach. The residual itself is rounded, by
 * 2 (k + 2) eps for rows of k entries, and so is x. */
#define ROW_ERROR_MAX(A) (2.0 * (3.0 + longest_row((A))) * DBL_EPSILON)

static double longest_row(const sl_csc *A) {
    sl_int n = A->n_cols, *count = test_ints((size_t)n), most = 0;
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            count[j]++;
            count[A->i[p]]++;
            most = count[j] > most ? count[j] : most;
            most = count[A->i[p]] > most ? count[A->i[p]] : most;
        }
    }
    free(count);
    return (double)most;
}

/* max |b - A x| / (|A| |x| + |b|) over all rows and columns, computed from the dense matrix. */
static double row_error(const sl_csc *A, const double *X, const double *B, sl_int nrhs) {
    sl_int n = A->n_cols;
    double *M = ref_dense(A), worst = 0.0;
    for (sl_int r = 0; r < nrhs; r++) {
        const double *x = X + (size_t)n * (size_t)r, *b = B + (size_t)n * (size_t)r;
        for (sl_int i = 0; i < n; i++) {
            double sum = b[i], size = fabs(b[i]);
            for (sl_int j = 0; j < n; j++) {
                sum -= AT(M, i, j) * x[j];
                size += fabs(AT(M, i, j) * x[j]);
            }
            worst = sum == 0.0 ? worst : fmax(worst, fabs(sum) / size);
        }
    }
    free(M);
    return worst;
}

/* Refines X and checks the stats: at most the allowed number of steps, and the backward error that
 * X really has; the status says whether that is small. Returns the stats. */
static sl_stats refine_checked(const sl_factor *F, const sl_csc *A, double *X, const double *B,
                               sl_int nrhs, sl_int steps, sl_work *W) {
    size_t n = (size_t)A->n_cols;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.symbolic.n = 77; /* another group, which the call must not touch */
    const sl_status status = sl_factor_refine(F, A, X, n, B, n, nrhs, steps, W, &stats);
    SL_EXPECT(steps == 0 || stats.refine.backward_error <= 1e-8 ? SL_OK : SL_ERR_INACCURATE,
              status);
    assert_int_equal(stats.symbolic.n, 77);
    assert_in_range(stats.refine.steps, 0, steps);
    double expected = row_error(A, X, B, nrhs); /* summed in another order */
    assert_true(fabs(stats.refine.backward_error - expected) <= ROW_ERROR_MAX(A) + 1e-9 * expected);
    return stats;
}

static void refinement_converges_from_any_start(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_none();
            options_set_variant(&opt, &variants, k);
            factored_t y = factored_make((gen_kind_t)kind, 90, 1, kind % GEN_STYLES, &opt);
            size_t n = (size_t)y.M.view.n_cols;
            static const sl_int counts[4] = {1, 3, 8, 11};
            sl_work *W = NULL;
            SL_CHECK(sl_work_create(&W, NULL));
            for (int c = 0; c < 4; c++) {
                sl_int nrhs = counts[c];
                double *B = test_reals(n * 11), *X = test_reals(n * 11),
                       *start = test_reals(n * 11);
                gen_reals(B, n * 11, 4);
                gen_reals(start, n * 11, 5); /* unrelated to the solution */
                memcpy(X, start, n * 11 * sizeof *X);
                sl_stats none = refine_checked(y.F, &y.M.view, X, B, nrhs, 0, W);
                assert_int_equal(none.refine.steps, 0);
                SAME_VALUES(X, start, n * 11); /* no step: X is only measured */
                sl_stats stats = refine_checked(y.F, &y.M.view, X, B, nrhs, 20, W);
                assert_true(stats.refine.backward_error <= ROW_ERROR_MAX(&y.M.view));
                assert_true(stats.refine.steps >= 1);
                SAME_VALUES(X + n * (size_t)nrhs, start + n * (size_t)nrhs,
                            n * (size_t)(11 - nrhs));
                /* A second call finds at least the same accuracy. */
                memcpy(start, X, n * 11 * sizeof *X);
                sl_stats again = refine_checked(y.F, &y.M.view, X, B, nrhs, 20, NULL);
                assert_true(again.refine.backward_error <= stats.refine.backward_error);
                free(B);
                free(X);
                free(start);
            }
            sl_work_free(W);
            factored_free(&y);
        }
    }
}

/* With the factor of a matrix near A, refinement solves A x = b. With that of a distant matrix it
 * makes nothing worse. */
static void a_nearby_factor_converges_a_distant_one_does_no_harm(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k);
        factored_t y = factored_make(GEN_GRID2, 200, 1, 0, &opt);
        size_t n = (size_t)y.M.view.n_cols;
        double *b = test_reals(n), *x = test_reals(n);
        uint64_t seed = 3;
        gen_reals(b, n, 8);
        for (int far = 0; far < 2; far++) {
            SL_CHECK(sl_factor_solve(y.F, x, n, b, n, 1, NULL));
            for (sl_int p = 0; p < y.M.p[n]; p++) {
                y.M.x[p] *= far ? -40.0 : 1.0 + 1e-3 * gen_real(&seed);
            }
            sl_stats before = refine_checked(y.F, &y.M.view, x, b, 1, 0, NULL);
            sl_stats after = refine_checked(y.F, &y.M.view, x, b, 1, 30, NULL);
            if (far) {
                assert_true(after.refine.backward_error <= before.refine.backward_error);
            } else {
                assert_true(before.refine.backward_error > 1e-6);
                assert_true(after.refine.backward_error <= ROW_ERROR_MAX(&y.M.view));
                assert_in_range(after.refine.steps, 2, 8);
            }
        }
        free(b);
        free(x);
        factored_free(&y);
    }
}

/* Columns that need different numbers of steps share passes over A; their order does not matter. */
static void columns_in_another_order_have_the_same_bits(void **state) {
    (void)state;
    enum { COLUMNS = 7 };
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k);
        factored_t y = factored_make(GEN_GRID2, 200, 1, 0, &opt);
        const size_t n = (size_t)y.M.view.n_cols;
        double *B = test_reals(n * COLUMNS), *X = test_reals(n * COLUMNS),
               *b = test_reals(n * COLUMNS), *x = test_reals(n * COLUMNS);
        uint64_t seed = 3;
        sl_int fewest = 99, most = 0;
        gen_reals(B, n * COLUMNS, 8);
        memset(B, 0, n * sizeof *B); /* is done at once */
        SL_CHECK(sl_factor_solve(y.F, X, n, B, n, COLUMNS, NULL));
        for (sl_int p = 0; p < y.M.p[n]; p++) {
            y.M.x[p] *= 1.0 + 1e-3 * gen_real(&seed);
        }
        for (size_t r = 0; r < COLUMNS; r++) {
            for (size_t i = 0; i < n; i++) {
                X[r * n + i] *= r % 3 == 1 ? 1e9 : 1.0;
            }
            memcpy(x + (COLUMNS - 1 - r) * n, X + r * n, n * sizeof *x);
            memcpy(b + (COLUMNS - 1 - r) * n, B + r * n, n * sizeof *b);
        }
        for (size_t r = 0; r < COLUMNS; r++) {
            double *alone = test_reals(n);
            memcpy(alone, X + r * n, n * sizeof *alone);
            const sl_stats s = refine_checked(y.F, &y.M.view, alone, B + r * n, 1, 30, NULL);
            fewest = s.refine.steps < fewest ? s.refine.steps : fewest;
            most = s.refine.steps > most ? s.refine.steps : most;
            free(alone);
        }
        assert_true(fewest == 0 && most > 2);
        refine_checked(y.F, &y.M.view, X, B, COLUMNS, 30, NULL);
        refine_checked(y.F, &y.M.view, x, b, COLUMNS, 30, NULL);
        for (size_t r = 0; r < COLUMNS; r++) {
            SAME_VALUES(X + r * n, x + (COLUMNS - 1 - r) * n, n);
        }
        free(B);
        free(X);
        free(b);
        free(x);
        factored_free(&y);
    }
}

static void refinement_removes_the_effect_of_regularization(void **state) {
    (void)state;
    enum { R = 9 };
    static const sl_ordering orderings[2] = {SL_ORDERING_NATURAL, SL_ORDERING_ND};
    variant_list_t variants = variants_present();
    for (int o = 0; o < 2; o++) {
        kkt_t y = kkt_make(240, 20, orderings[o]);
        size_t n = (size_t)y.n;
        double *B = test_reals(n * R), *X = test_reals(n * R);
        kkt_consistent(&y, B, R, 6);
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_none();
            sl_factor *F = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            options_set_variant(&opt, &variants, k);
            opt.regularization = 1e-8;
            opt.signs = y.signs;
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, &stats));
            sl_int changed = stats.factor.regularized;
            assert_true(changed >= 20);
            SL_CHECK(sl_factor_solve(F, X, n, B, n, R, NULL));
            sl_stats plain = refine_checked(F, &y.M.view, X, B, R, 0, NULL);
            stats = refine_checked(F, &y.M.view, X, B, R, 30, NULL);
            print_message("%d regularized: backward error %.1e, after %d steps %.1f eps\n",
                          (int)changed, plain.refine.backward_error, (int)stats.refine.steps,
                          stats.refine.backward_error / DBL_EPSILON);
            assert_true(o == 0 || plain.refine.backward_error > 1e-12);
            assert_true(stats.refine.backward_error <= ROW_ERROR_MAX(&y.M.view));
            sl_factor_free(F);
        }
        free(B);
        free(X);
        kkt_free(&y);
    }
}

/* Singular systems: x stays 0 in the null rows, or its weighted mean stays 0. */
static void null_rows_and_means_stay_zero(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    sl_int components = 0;
    gen_matrix_t M = laplacian(GEN_GRID2, 400, 0, &components);
    size_t n = (size_t)M.view.n_cols;
    double *b = test_reals(n), *x = test_reals(n), *m = test_reals(n), sum = 0.0, most = 0.0;
    sl_symbolic *S = NULL;
    gen_reals(x, n, 3);
    for (size_t i = 0; i < n; i++) {
        m[i] = 1.0;
    }
    SL_CHECK(sl_csc_multiply(&M.view, SL_AS_SYMMETRIC, b, n, x, n, 1));
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < 2 * variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k / 2);
        sl_factor *F = NULL;
        sl_int row, count;
        opt.mass = k % 2 ? m : NULL;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
        double before = refine_checked(F, &M.view, x, b, 1, 0, NULL).refine.backward_error;
        assert_true(refine_checked(F, &M.view, x, b, 1, 5, NULL).refine.backward_error <= before);
        SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, &row, NULL, 1, &count));
        for (size_t i = 0; i < n; i++) {
            sum = i > 0 ? sum + x[i] : x[i];
            most = fmax(i > 0 ? most : 0.0, fabs(x[i]));
        }
        assert_true(k % 2 ? fabs(sum) <= pass_figure((sl_int)n) * (double)n * most
                          : fabs(x[row]) < 1e-290);
        sl_factor_free(F);
    }
    free(b);
    free(x);
    free(m);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Wrong arguments and failed allocations leave X as it was. A workspace that has grown allocates
 * nothing. */
static void bad_arguments_and_failed_allocations_change_nothing(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    gen_matrix_t other = gen_matrix(GEN_PATH, 100, 1, 1), empty = gen_matrix(GEN_NONE, 0, 1, 1);
    double B[300], X[300], keep[300];
    sl_stats stats;
    gen_reals(B, 300, 1);
    gen_reals(X, 300, 2);
    memcpy(keep, X, sizeof X);
    const sl_csc *A = &y.M.view;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(NULL, A, X, 100, B, 100, 3, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(y.F, NULL, X, 100, B, 100, 3, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(y.F, A, NULL, 100, B, 100, 3, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(y.F, A, X, 99, B, 100, 3, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(y.F, A, X, 100, NULL, 100, 3, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(y.F, A, X, 100, B, 99, 3, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(y.F, A, X, 100, B, 100, -1, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(y.F, A, X, 100, B, 100, 3, -1, NULL, &stats));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refine(y.F, A, X, 100, X, 100, 3, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_OTHER_PATTERN,
              sl_factor_refine(y.F, &other.view, X, 100, B, 100, 3, 1, NULL, &stats));
    assert_memory_equal(X, keep, sizeof X);
    SL_CHECK(sl_factor_refine(y.F, A, NULL, 0, NULL, 0, 0, 5, NULL, &stats));
    assert_true(stats.refine.steps == 0 && stats.refine.backward_error == 0.0);
    for (int64_t k = 0, done = 0; !done; k++) {
        counter_t counter = counter_make();
        sl_work *W = work_failing(&counter, k);
        sl_status status = sl_factor_refine(y.F, A, X, 100, B, 100, 3, 2, W, NULL);
        done = status == SL_OK;
        if (!done) {
            test_status(status, SL_ERR_MEMORY, "sl_factor_refine", __FILE__, __LINE__);
            assert_memory_equal(X, keep, sizeof X);
        } else {
            size_t calls = counter.calls;
            SL_CHECK(sl_factor_refine(y.F, A, X, 100, B, 100, 3, 2, W, NULL));
            assert_int_equal(counter.calls, calls);
            assert_true(k > 0);
        }
        sl_work_free(W);
        COUNTER_CLEAN(&counter);
    }
    /* A failed factor, then a matrix of no rows. */
    double spoiled = y.M.x[4];
    y.M.x[4] = NAN;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, A, NULL));
    y.M.x[4] = spoiled;
    SL_EXPECT(SL_ERR_STALE, sl_factor_refine(y.F, A, X, 100, B, 100, 3, 1, NULL, &stats));
    factored_free(&y);
    y = factored_make(GEN_NONE, 0, 1, 0, NULL);
    SL_CHECK(sl_factor_refine(y.F, &empty.view, X, 1, B, 1, 3, 5, NULL, &stats));
    assert_true(stats.refine.backward_error == 0.0);
    factored_free(&y);
    gen_matrix_free(&other);
    gen_matrix_free(&empty);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refinement_converges_from_any_start),
        cmocka_unit_test(a_nearby_factor_converges_a_distant_one_does_no_harm),
        cmocka_unit_test(columns_in_another_order_have_the_same_bits),
        cmocka_unit_test(refinement_removes_the_effect_of_regularization),
        cmocka_unit_test(null_rows_and_means_stay_zero),
        cmocka_unit_test(bad_arguments_and_failed_allocations_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
