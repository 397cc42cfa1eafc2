/* test_centred.c: options.mass: the centred solution of a singular system, against dense ones, full and local, in every form */
#include "parallel_for.h"
#include "problem.h"
#include "question.h"
#include "singular.h"

/* Weights from 2^-10 to 2^10. */
static double *weights(sl_int n, uint64_t seed) {
    double *m = test_reals((size_t)n);
    for (sl_int k = 0; k < n; k++) {
        m[k] = ldexp(0.5 + fabs(gen_real(&seed)), (int)gen_below(&seed, 21) - 10);
    }
    return m;
}

/* x of A x = b - c m, c = sum of b / sum of m in each component, with sum m x = 0: by the two equations themselves. The
 * mean of x in a component is 0 within rounding of its largest entry. */
static void assert_centred(const sl_csc *A, const sl_int *of, const double *m, const double *x,
                           const double *b) {
    sl_int n = A->n_cols;
    size_t rows = (size_t)n;
    double *sum_b = test_reals(rows), *sum_m = test_reals(rows), *sum_x = test_reals(rows);
    double *most = test_reals(rows), *rhs = test_reals(rows), *none = test_reals(rows);
    for (sl_int i = 0; i < n; i++) {
        sum_b[of[i]] += b[i];
        sum_m[of[i]] += m[i];
        sum_x[of[i]] += m[i] * x[i];
        most[of[i]] = fmax(most[of[i]], fabs(x[i]));
    }
    for (sl_int i = 0; i < n; i++) {
        rhs[i] = b[i] - m[i] * (sum_b[of[i]] / sum_m[of[i]]);
        assert_true(fabs(sum_x[of[i]]) <= pass_figure(n) * sum_m[of[i]] * most[of[i]]);
    }
    /* against b, too: of a lone row rhs is rounding alone */
    double eta, largest = 0.0, residual = 0.0;
    SL_CHECK(sl_csc_residual(A, none, rows, &eta, x, rows, rhs, rows, 1));
    for (sl_int i = 0; i < n; i++) {
        residual = fmax(residual, fabs(none[i]));
        largest = fmax(largest, fabs(b[i]));
    }
    assert_true(eta <= pass_figure(n) || residual <= pass_figure(n) * largest);
    free(sum_b);
    free(sum_m);
    free(sum_x);
    free(most);
    free(rhs);
    free(none);
}

/* The same x from the dense system [A m; m' 0], with a row and a column for each component. */
static void assert_dense(const sl_csc *A, const sl_int *of, sl_int components, const double *m,
                         const double *x, const double *b) {
    sl_int rows = A->n_cols, n = rows + components, at = rows;
    double *M = ref_dense(A), *K = test_reals((size_t)n * (size_t)n), *y = test_reals((size_t)n);
    for (sl_int j = 0; j < rows; j++) {
        for (sl_int i = 0; i < rows; i++) {
            AT(K, i, j) = M[(size_t)i + (size_t)rows * (size_t)j];
        }
        y[j] = b[j];
    }
    for (sl_int c = 0; c < rows; c++) {
        for (sl_int i = 0; of[c] == c && i < rows; i++) {
            AT(K, i, at) = AT(K, at, i) = of[i] == c ? m[i] : 0.0;
        }
        at += of[c] == c;
    }
    double bound = n * DBL_EPSILON * ref_condition(n, K), most = 0.0;
    ref_solve(n, K, y, 1);
    for (sl_int i = 0; i < rows; i++) {
        most = fmax(most, fabs(y[i]));
    }
    for (sl_int i = 0; i < rows; i++) { /* n eps, times the condition of the bordered matrix */
        assert_true(fabs(x[i] - y[i]) <= bound * most);
    }
    free(M);
    free(K);
    free(y);
}

static void against_dense_systems(void **state) {
    (void)state;
    static const gen_kind_t kinds[9] = {GEN_ONE,    GEN_DIAGONAL, GEN_PATH,
                                        GEN_STAR,   GEN_GRID2,    GEN_GRID3,
                                        GEN_FOREST, GEN_RANDOM,   GEN_COMPONENTS};
    static const sl_int sizes[2] = {12, 90};
    way_list_t ways = ways_present();
    for (int kind = 0; kind < 9; kind++) {
        for (int size = 0; size < 2; size++) {
            sl_int components = 0, *of = test_ints((size_t)sizes[size]);
            gen_matrix_t M =
                laplacian_of(kinds[kind], sizes[size], kind % GEN_STYLES, &components, of);
            size_t n = (size_t)M.view.n_cols;
            double *m = weights((sl_int)n, 3), *b = test_reals(n), *x = test_reals(n);
            sl_symbolic *S = NULL;
            gen_reals(b, n, 5);
            SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
            for (int k = 0; k < ways.count; k++) {
                sl_options opt = options_semidefinite(&ways, k);
                sl_factor *F = NULL;
                opt.mass = m;
                SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
                for (int again = 0; again < 3; again++) {
                    const sl_int column = 0;
                    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
                    assert_centred(&M.view, of, m, x, b);
                    assert_dense(&M.view, of, components, m, x, b);
                    SL_CHECK(again ? sl_factor_refactor_changed(F, &M.view, &column, 1, NULL)
                                   : sl_factor_refactor(F, &M.view, NULL));
                }
                sl_factor_free(F);
            }
            sl_symbolic_free(S);
            gen_matrix_free(&M);
            free(of);
            free(m);
            free(b);
            free(x);
        }
    }
}

/* Every form of solve has the bits of the full one, and none allocates once its workspace has grown; threads change
 * none. */
static void every_form(void **state) {
    (void)state;
    sl_int components = 0, n = 600, *of = test_ints(600);
    gen_matrix_t M = laplacian_of(GEN_COMPONENTS, n, 0, &components, of);
    double *m = weights(n, 4);
    way_list_t ways = ways_present();
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < ways.count; k++) {
        sl_options opt = options_semidefinite(&ways, k);
        sl_factor *F = NULL, *G = NULL;
        sl_work *W = NULL;
        int calls = 0;
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        opt.threads.count = 3;
        opt.threads.run = run_backwards;
        opt.threads.context = &calls;
        SL_CHECK(sl_factor_create(&G, S, &M.view, &opt, NULL));
        assert_same_bits(F, G);
        SL_CHECK(sl_work_create(&W, NULL));
        for (sl_int nrhs = 1; nrhs <= 9; nrhs++) {
            for (int which = 0; which < 6; which++) {
                static const sl_int nb[6] = {1, 1, 20, -1, 30, 0}, nx[6] = {1, 30, -1, 5, 30, 3};
                question_t q = ask(F, n, nb[which], nx[which], nrhs, (uint64_t)(which + 10 * nrhs));
                answer(S, F, &q, W);
                answer(S, G, &q, W);
                forget(&q);
            }
        }
        sl_work_free(W);
        sl_factor_free(F);
        sl_factor_free(G);
    }
    free(of);
    free(m);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Interleaved, in a batch, in place: the same bits. */
static void interleaved_and_batches(void **state) {
    (void)state;
    enum { N = 300, R = 11 };
    sl_int components = 0, *of = test_ints(N);
    gen_matrix_t M = laplacian_of(GEN_COMPONENTS, N, 0, &components, of);
    double *m = weights(N, 6), *B = test_reals(N * R), *X = test_reals(N * R);
    double *Y = test_reals(N * R);
    way_list_t ways = ways_present();
    sl_symbolic *S = NULL;
    gen_reals(B, N * R, 9);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < ways.count; k++) {
        sl_options opt = options_semidefinite(&ways, k);
        sl_factor *F = NULL;
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_solve(F, X, N, B, N, R, NULL));
        for (int r = 0; r < R; r++) {
            assert_centred(&M.view, of, m, X + N * r, B + N * r);
        }
        for (int i = 0; i < N; i++) {
            for (int r = 0; r < R; r++) {
                Y[r + R * i] = B[i + N * r];
            }
        }
        SL_CHECK(sl_factor_solve_interleaved(F, Y, R, Y, R, R, NULL));
        for (int i = 0; i < N; i++) {
            for (int r = 0; r < R; r++) {
                assert_true(same_value(Y[r + R * i], X[i + N * r]));
            }
        }
        sl_request request = {NULL, Y, N, B, N, 0, R};
        SL_CHECK(sl_batch_solve(F, &request, 1, NULL, NULL, NULL));
        SAME_VALUES(Y, X, N * R);
        sl_factor_free(F);
    }
    free(of);
    free(m);
    free(B);
    free(X);
    free(Y);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A path of n rows between the weights a, with shift on row 0. */
static gen_matrix_t path(sl_int n, double shift, sl_int cut) {
    gen_list_t t = gen_list(n);
    for (sl_int k = 0; k < n; k++) {
        double left = k > 0 && k != cut, right = k + 1 < n && k + 1 != cut;
        gen_add(&t, k, k, left + right + (k == 0 ? shift : 0.0));
        if (k > 0) {
            gen_add(&t, k, k - 1, k == cut ? 0.0 : -1.0);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* What the weights can be wrong in, and what is not wrong: rows without any, definite matrices. */
static void weights_that_are_refused(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    for (int k = 0; k < ways.count; k++) {
        sl_options opt = options_semidefinite(&ways, k);
        gen_matrix_t M = path(6, 0.0, -1), cut = path(6, 0.0, 3), firm = path(6, 2.0, -1);
        double m[6] = {1, 2, 3, 4, 5, 6}, b[6] = {1, -1, 2, 0, 3, 1}, x[6], y[6];
        sl_symbolic *S = NULL;
        sl_factor *F = NULL, *plain = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        opt.mass = m;
        for (int bad = 0; bad < 3; bad++) {
            double keep = m[4];
            m[4] = bad == 0 ? NAN : bad == 1 ? INFINITY : -10.0; /* the last: a sum of 0 */
            m[5] = bad == 2 ? 0.0 : 6.0;
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &M.view, &opt, &stats));
            assert_null(F);
            if (bad < 2) {
                assert_int_equal(stats.error_row, 4);
            } else {
                assert_in_range(stats.error_row, 0, 5);
            }
            m[4] = keep;
            m[5] = 6.0;
        }
        /* cut in two by a weight of 0: one weighted sum is not enough for two null pivots */
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &cut.view, &opt, &stats));
        assert_null(F);
        assert_in_range(stats.error_row, 0, 5);
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &cut.view, &stats));
        SL_EXPECT(SL_ERR_STATE, sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        /* no null pivot: nothing is centred, the bits are those without weights */
        SL_CHECK(sl_factor_refactor(F, &firm.view, &stats));
        assert_int_equal(stats.null, 0);
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        opt.mass = NULL;
        SL_CHECK(sl_factor_create(&plain, S, &firm.view, &opt, NULL));
        SL_CHECK(sl_factor_solve(plain, y, 6, b, 6, 1, NULL));
        SAME_VALUES(x, y, 6);
        sl_factor_free(plain);
        /* and back to what is singular; all weights 0 count as 1 */
        SL_CHECK(sl_factor_refactor(F, &M.view, &stats));
        assert_int_equal(stats.null, 1);
        const sl_int of[6] = {0, 0, 0, 0, 0, 0};
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        assert_centred(&M.view, of, m, x, b);
        sl_factor_free(F);
        const double none[6] = {0, 0, 0, 0, 0, 0}, ones[6] = {1, 1, 1, 1, 1, 1};
        opt.mass = none;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        assert_centred(&M.view, of, ones, x, b);
        sl_factor_free(F);
        /* read with SL_SEMIDEFINITE only */
        opt.definiteness = SL_DEFINITE;
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &firm.view, &opt, &stats));
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_matrix_free(&cut);
        gen_matrix_free(&firm);
    }
}

/* A null vector that is not constant: S A S has S^-1 1. z' b decides, and the weights still say which x. */
static void a_null_vector_of_any_kind(void **state) {
    (void)state;
    sl_int components = 0, n = 90;
    gen_matrix_t M = laplacian(GEN_GRID2, n, 0, &components);
    n = M.view.n_cols;
    double *scale = weights(n, 8), *m = weights(n, 9), *b = test_reals((size_t)n);
    double *x = test_reals((size_t)n);
    way_list_t ways = ways_present();
    sl_symbolic *S = NULL;
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
            M.x[p] *= scale[j] * scale[M.i[p]];
        }
    }
    gen_reals(b, (size_t)n, 2);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < ways.count; k++) {
        sl_options opt = options_semidefinite(&ways, k);
        sl_factor *F = NULL;
        double z_b = 0.0, z_m = 0.0, sum = 0.0, total = 0.0, most = 0.0,
               *rhs = test_reals((size_t)n);
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
        for (sl_int i = 0; i < n; i++) {
            z_b += b[i] / scale[i];
            z_m += m[i] / scale[i];
            sum += m[i] * x[i];
            total += m[i];
            most = fmax(most, fabs(x[i]));
        }
        for (sl_int i = 0; i < n; i++) {
            rhs[i] = b[i] - m[i] * (z_b / z_m);
        }
        assert_true(fabs(sum) <= pass_figure(n) * total * most);
        BACKWARD_PASSES(&M.view, x, (size_t)n, rhs, (size_t)n, 1);
        free(rhs);
        sl_factor_free(F);
    }
    free(scale);
    free(m);
    free(b);
    free(x);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Every allocation of a factor with weights may fail; neither refactoring nor solving asks for more. */
static void memory(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    sl_int components = 0, rows[3] = {0, 40, 80};
    gen_matrix_t M = laplacian(GEN_COMPONENTS, 90, 0, &components);
    double *m = weights(90, 2), b[3 * 9], x[3 * 9];
    sl_symbolic *S = NULL;
    gen_reals(b, 3 * 9, 1);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < ways.count; k++) {
        for (int64_t fails = 0, done = 0; !done; fails++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter), wish = options_semidefinite(&ways, k);
            sl_factor *F = NULL;
            sl_work *W = NULL;
            opt.isa = wish.isa;
            opt.method = wish.method;
            opt.definiteness = wish.definiteness;
            opt.mass = m;
            counter.fail_at = fails;
            sl_status status = sl_factor_create(&F, S, &M.view, &opt, NULL);
            done = status == SL_OK;
            assert_true(done ? F != NULL : F == NULL && status == SL_ERR_MEMORY);
            if (done) {
                counter.fail_at = -1;
                SL_CHECK(sl_work_create(&W, &opt));
                SL_CHECK(sl_local_solve(F, x, 3, rows, 3, b, 3, rows, 3, 9, W, NULL));
                size_t calls = counter.calls;
                SL_CHECK(sl_factor_refactor(F, &M.view, NULL));
                SL_CHECK(sl_local_solve(F, x, 3, rows, 3, b, 3, rows, 3, 9, W, NULL));
                assert_int_equal(counter.calls, calls);
                assert_true(fails > 0);
            }
            sl_work_free(W);
            sl_factor_free(F);
            COUNTER_CLEAN(&counter);
        }
    }
    free(m);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_dense_systems),     cmocka_unit_test(every_form),
        cmocka_unit_test(interleaved_and_batches),   cmocka_unit_test(weights_that_are_refused),
        cmocka_unit_test(a_null_vector_of_any_kind), cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
