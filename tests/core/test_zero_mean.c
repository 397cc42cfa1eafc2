/* test_zero_mean.c: options.mass: zero-mean solutions against dense ones, by every kind of solve */
#include "tests/lib/zero_mean.h"
#include "tests/lib/parallel_for.h"
#include "tests/lib/local_solve.h"

/* Compares x with the solution of the dense system [A m; m' 0], which has one more row and column
 * for each component. */
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
    for (sl_int i = 0; i < rows; i++) { /* n eps times the condition of the bordered matrix */
        assert_true(fabs(x[i] - y[i]) <= bound * most);
    }
    free(M);
    free(K);
    free(y);
}

static void solutions_equal_dense_bordered_systems(void **state) {
    (void)state;
    static const sl_int sizes[2] = {12, 90};
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < LAPLACIAN_KINDS; kind++) {
        for (int size = 0; size < 2; size++) {
            sl_int components = 0, *of = test_ints((size_t)sizes[size]);
            gen_matrix_t M = laplacian_of(laplacian_kinds[kind], sizes[size], kind % GEN_STYLES,
                                          &components, of);
            size_t n = (size_t)M.view.n_cols;
            double *m = weights((sl_int)n, 3), *b = test_reals(n), *x = test_reals(n);
            sl_symbolic *S = NULL;
            gen_reals(b, n, 5);
            SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
            for (int k = 0; k < variants.count; k++) {
                sl_options opt = options_skip_null(&variants, k);
                sl_factor *F = NULL;
                opt.mass = m;
                SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
                for (int again = 0; again < 3; again++) {
                    const sl_int column = 0;
                    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
                    assert_zero_mean(&M.view, of, m, x, b);
                    assert_dense(&M.view, of, components, m, x, b);
                    SL_CHECK(again ? sl_factor_change_entries(F, &M.view, NULL, &column, NULL, 1,
                                                              NULL, NULL)
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

/* Every kind of solve gives the bits of the full one. None allocates once its workspace has grown.
 * Threads change no bit. */
static void every_solve_gives_the_same_bits(void **state) {
    (void)state;
    sl_int components = 0, n = 600, *of = test_ints(600);
    gen_matrix_t M = laplacian_of(GEN_COMPONENTS, n, 0, &components, of);
    double *m = weights(n, 4);
    variant_list_t variants = variants_present();
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
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
        for (sl_int nrhs = 1; nrhs <= 51; nrhs += nrhs < 9 ? 1 : 14) {
            for (int which = 0; which < 6; which++) {
                static const sl_int nb[6] = {1, 1, 20, -1, 30, 0}, nx[6] = {1, 30, -1, 5, 30, 3};
                local_solve_t q = local_solve_random(F, n, nb[which], nx[which], nrhs,
                                                     (uint64_t)(which + 10 * nrhs));
                local_solve_check(S, F, &q, W);
                local_solve_check(S, G, &q, W);
                local_solve_free(&q);
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

/* Interleaved, in a batch, in place, in blocks of 32, 16 and 8: the same bits. */
static void interleaved_and_batch_solves_give_the_same_bits(void **state) {
    (void)state;
    enum { N = 300, R = 59 };
    sl_int components = 0, *of = test_ints(N);
    gen_matrix_t M = laplacian_of(GEN_COMPONENTS, N, 0, &components, of);
    double *m = weights(N, 6), *B = test_reals(N * R), *X = test_reals(N * R);
    double *Y = test_reals(N * R);
    variant_list_t variants = variants_present();
    sl_symbolic *S = NULL;
    gen_reals(B, N * R, 9);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_solve(F, X, N, B, N, R, NULL));
        for (int r = 0; r < R; r++) {
            assert_zero_mean(&M.view, of, m, X + N * r, B + N * r);
        }
        for (int i = 0; i < N; i++) {
            for (int r = 0; r < R; r++) {
                Y[r + R * i] = B[i + N * r];
            }
        }
        SL_CHECK(sl_factor_solve(F, Y, SL_ROWS(R), Y, SL_ROWS(R), R, NULL));
        for (int i = 0; i < N; i++) {
            for (int r = 0; r < R; r++) {
                assert_true(same_value(Y[r + R * i], X[i + N * r]));
            }
        }
        sl_request request = {NULL, Y, N, B, N, R, NULL};
        SL_CHECK(sl_batch_solve(F, &request, 1, NULL, NULL, NULL));
        SAME_VALUES(Y, X, N * R);
        memset(Y, 0, N * R * sizeof *Y);
        for (sl_int r = 0; r < R; r += 8) {
            SL_CHECK(sl_factor_solve(F, Y + N * r, N, B + N * r, N, r + 8 < R ? 8 : R - r, NULL));
        }
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_equal_dense_bordered_systems),
        cmocka_unit_test(every_solve_gives_the_same_bits),
        cmocka_unit_test(interleaved_and_batch_solves_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
