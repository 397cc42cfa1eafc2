/* test_refine.c: sl_factor_refine: any start, a factor of another matrix, regularized systems; what it reports and leaves alone */
#include "kkt.h"
#include "problem.h"
#include "singular.h"

/* What refinement must come down to, row by row: the residual itself is rounded, 2 (k + 2) eps for rows of k entries, and
 * so is x. */
#define ROW_MOST(A) (2.0 * (3.0 + longest((A))) * DBL_EPSILON)

static double longest(const sl_csc *A) {
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

/* max |b - A x| / (|A| |x| + |b|) over rows and columns, from the dense matrix. */
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

/* Refines from a start of its own and checks what is told: no more steps than allowed, the error that is there. */
static sl_stats refine(const sl_factor *F, const sl_csc *A, double *X, const double *B, sl_int nrhs,
                       sl_int steps, sl_work *W) {
    size_t n = (size_t)A->n_cols;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.n = 77; /* another group: left alone */
    SL_CHECK(sl_factor_refine(F, A, X, n, B, n, nrhs, steps, W, &stats));
    assert_int_equal(stats.n, 77);
    assert_in_range(stats.refine_steps, 0, steps);
    double is = row_error(A, X, B, nrhs); /* summed in another order */
    assert_true(fabs(stats.backward_error - is) <= ROW_MOST(A) + 1e-9 * is);
    return stats;
}

static void from_any_start(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < ways.count; k++) {
            sl_options opt = options_none();
            way_take(&opt, &ways, k);
            problem_t y = problem_make((gen_kind_t)kind, 90, 1, kind % GEN_STYLES, &opt);
            size_t n = (size_t)y.M.view.n_cols;
            static const sl_int counts[4] = {1, 3, 8, 11};
            sl_work *W = NULL;
            SL_CHECK(sl_work_create(&W, NULL));
            for (int c = 0; c < 4; c++) {
                sl_int nrhs = counts[c];
                double *B = test_reals(n * 11), *X = test_reals(n * 11),
                       *start = test_reals(n * 11);
                gen_reals(B, n * 11, 4);
                gen_reals(start, n * 11, 5); /* nothing to do with the solution */
                memcpy(X, start, n * 11 * sizeof *X);
                sl_stats none = refine(y.F, &y.M.view, X, B, nrhs, 0, W);
                assert_int_equal(none.refine_steps, 0);
                SAME_VALUES(X, start, n * 11); /* no step: only measured */
                sl_stats stats = refine(y.F, &y.M.view, X, B, nrhs, 20, W);
                assert_true(stats.backward_error <= ROW_MOST(&y.M.view));
                assert_true(stats.refine_steps >= 1);
                SAME_VALUES(X + n * (size_t)nrhs, start + n * (size_t)nrhs,
                            n * (size_t)(11 - nrhs));
                /* what is as good as it gets stays, and a second call finds the same */
                memcpy(start, X, n * 11 * sizeof *X);
                sl_stats again = refine(y.F, &y.M.view, X, B, nrhs, 20, NULL);
                assert_true(again.backward_error <= stats.backward_error);
                free(B);
                free(X);
                free(start);
            }
            sl_work_free(W);
            problem_free(&y);
        }
    }
}

/* A factor of a matrix near A solves A x = b; one of a matrix far away makes nothing worse. */
static void factor_of_another_matrix(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    for (int k = 0; k < ways.count; k++) {
        sl_options opt = options_none();
        way_take(&opt, &ways, k);
        problem_t y = problem_make(GEN_GRID2, 200, 1, 0, &opt);
        size_t n = (size_t)y.M.view.n_cols;
        double *b = test_reals(n), *x = test_reals(n);
        uint64_t seed = 3;
        gen_reals(b, n, 8);
        for (int far = 0; far < 2; far++) {
            SL_CHECK(sl_factor_solve(y.F, x, n, b, n, 1, NULL));
            for (sl_int p = 0; p < y.M.p[n]; p++) {
                y.M.x[p] *= far ? -40.0 : 1.0 + 1e-3 * gen_real(&seed);
            }
            sl_stats before = refine(y.F, &y.M.view, x, b, 1, 0, NULL);
            sl_stats after = refine(y.F, &y.M.view, x, b, 1, 30, NULL);
            if (far) {
                assert_true(after.backward_error <= before.backward_error);
            } else {
                assert_true(before.backward_error > 1e-6);
                assert_true(after.backward_error <= ROW_MOST(&y.M.view));
                assert_in_range(after.refine_steps, 2, 8);
            }
        }
        free(b);
        free(x);
        problem_free(&y);
    }
}

/* Dependent constraints, regularized. After what they constrain, those too many get a multiplier of 0, and E x = 0;
 * before it their zeros on the diagonal are changed, and the plain solve leaves that in x: refinement takes it away. */
static void regularized_systems(void **state) {
    (void)state;
    enum { R = 9 };
    static const sl_ordering orderings[2] = {SL_ORDERING_NATURAL, SL_ORDERING_DEFAULT};
    way_list_t ways = ways_present();
    for (int o = 0; o < 2; o++) {
        kkt_t y = kkt_make(240, 20, orderings[o]);
        size_t n = (size_t)y.n;
        double *B = test_reals(n * R), *X = test_reals(n * R);
        kkt_consistent(&y, B, R, 6);
        for (int k = 0; k < ways.count; k++) {
            sl_options opt = options_none();
            sl_factor *F = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            way_take(&opt, &ways, k);
            opt.regularization = 1e-8;
            opt.signs = y.signs;
            SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, &stats));
            sl_int changed = stats.regularized;
            assert_true(changed >= 20);
            SL_CHECK(sl_factor_solve(F, X, n, B, n, R, NULL));
            sl_stats plain = refine(F, &y.M.view, X, B, R, 0, NULL);
            stats = refine(F, &y.M.view, X, B, R, 30, NULL);
            print_message("%d regularized: backward error %.1e, after %d steps %.1f eps\n",
                          (int)changed, plain.backward_error, (int)stats.refine_steps,
                          stats.backward_error / DBL_EPSILON);
            assert_true(o == 0 || plain.backward_error > 1e-12);
            assert_true(stats.backward_error <= ROW_MOST(&y.M.view));
            sl_factor_free(F);
        }
        free(B);
        free(X);
        kkt_free(&y);
    }
}

/* Singular systems: the null rows stay 0, the weighted mean stays 0. */
static void singular_systems(void **state) {
    (void)state;
    way_list_t ways = ways_present();
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
    for (int k = 0; k < 2 * ways.count; k++) {
        sl_options opt = options_semidefinite(&ways, k / 2);
        sl_factor *F = NULL;
        sl_int row, count;
        opt.mass = k % 2 ? m : NULL;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
        double before = refine(F, &M.view, x, b, 1, 0, NULL).backward_error;
        assert_true(refine(F, &M.view, x, b, 1, 5, NULL).backward_error <= before);
        SL_CHECK(sl_factor_null_rows(F, &row, 1, &count));
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

/* Wrong arguments, memory that fails at every point, and none asked for once the workspace has grown. */
static void errors_and_memory(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 100, 1, 0, NULL);
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
    SL_EXPECT(SL_ERR_PATTERN,
              sl_factor_refine(y.F, &other.view, X, 100, B, 100, 3, 1, NULL, &stats));
    assert_memory_equal(X, keep, sizeof X);
    SL_CHECK(sl_factor_refine(y.F, A, NULL, 0, NULL, 0, 0, 5, NULL, &stats));
    assert_true(stats.refine_steps == 0 && stats.backward_error == 0.0);
    for (int64_t k = 0, done = 0; !done; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_work *W = NULL;
        SL_CHECK(sl_work_create(&W, &opt));
        counter.fail_at = (int64_t)counter.calls + k;
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
    /* a factor that failed, and no rows at all */
    double spoiled = y.M.x[4];
    y.M.x[4] = NAN;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, A, NULL));
    y.M.x[4] = spoiled;
    SL_EXPECT(SL_ERR_STATE, sl_factor_refine(y.F, A, X, 100, B, 100, 3, 1, NULL, &stats));
    problem_free(&y);
    y = problem_make(GEN_NONE, 0, 1, 0, NULL);
    SL_CHECK(sl_factor_refine(y.F, &empty.view, X, 1, B, 1, 3, 5, NULL, &stats));
    assert_true(stats.backward_error == 0.0);
    problem_free(&y);
    gen_matrix_free(&other);
    gen_matrix_free(&empty);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_any_start),      cmocka_unit_test(factor_of_another_matrix),
        cmocka_unit_test(regularized_systems), cmocka_unit_test(singular_systems),
        cmocka_unit_test(errors_and_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
