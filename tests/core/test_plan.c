/* test_plan.c: local solves, planned or in one call, give the bits of the full solve on any sets */
#include "tests/lib/factored.h"
#include "tests/lib/local_solve.h"

#include <pthread.h>

static void check_random_sets(const factored_t *y, sl_int nb, sl_int nx, sl_int nrhs, uint64_t seed,
                              sl_work *W) {
    local_solve_t q = local_solve_random(y->F, y->M.view.n_cols, nb, nx, nrhs, seed);
    local_solve_check(y->S, y->F, &q, W);
    local_solve_free(&q);
}

static void local_solves_equal_the_full_solve(void **state) {
    (void)state;
    static const sl_int sizes[3] = {6, 40, 500};
    isa_list_t isas = isas_present();
    sl_work *W = NULL;
    uint64_t seed = 1;
    SL_CHECK(sl_work_create(&W, NULL));
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 3; size++) {
            for (int k = 0; k < 2 * isas.count; k++) {
                sl_options opt = options_none();
                opt.isa = isas.isa[k / 2];
                opt.relaxation = (sl_relaxation)(k % 2);
                factored_t y =
                    factored_make((gen_kind_t)kind, sizes[size], size - 1, kind % GEN_STYLES, &opt);
                sl_int n = y.M.view.n_cols;
                for (sl_int nrhs = 0; nrhs <= 9; nrhs++) {
                    check_random_sets(&y, -1, -1, nrhs, ++seed, W);
                    check_random_sets(&y, 0, n, nrhs, ++seed, W);
                    check_random_sets(&y, n, 0, nrhs, ++seed, W);
                    if (n > 0) {
                        check_random_sets(&y, 1, 1, nrhs, ++seed, nrhs % 2 ? W : NULL);
                        check_random_sets(&y, 1, -1, nrhs, ++seed, W);
                        check_random_sets(&y, -1, 1, nrhs, ++seed, W);
                        check_random_sets(&y, 1 + gen_below(&seed, n), 1 + gen_below(&seed, n),
                                          nrhs, ++seed, W);
                        check_random_sets(&y, 1 + gen_below(&seed, n / 8 + 1),
                                          1 + gen_below(&seed, n / 8 + 1), nrhs, ++seed, W);
                    }
                }
                factored_free(&y);
            }
        }
    }
    sl_work_free(W);
}

/* Every pair of single rows of a grid and of a KKT system. */
static void every_pair_of_rows_equals_the_full_solve(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    static const gen_kind_t kinds[2] = {GEN_GRID2, GEN_KKT};
    for (int k = 0; k < 2 * isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k / 2];
        factored_t y = factored_make(kinds[k % 2], 64, 0, 0, &opt);
        sl_int n = y.M.view.n_cols;
        double *full = test_reals((size_t)n);
        sl_work *W = NULL;
        SL_CHECK(sl_work_create(&W, NULL));
        for (sl_int b = 0; b < n; b++) {
            memset(full, 0, (size_t)n * sizeof *full);
            full[b] = 1.5;
            SL_CHECK(sl_factor_solve(y.F, full, (size_t)n, full, (size_t)n, 1, W));
            for (sl_int x = 0; x < n; x++) {
                double one = 1.5;
                /* This also solves in place. */
                SL_CHECK(sl_local_solve(y.F, &b, 1, &x, 1, &one, 1, &one, 1, 1, W, NULL));
                SAME_VALUES(&one, full + x, 1);
            }
        }
        free(full);
        sl_work_free(W);
        factored_free(&y);
    }
}

/* Over thousands of supernodes the kernels visit memory in another order than on a short path. The
 * bits must not change. */
static void long_and_short_sweeps_agree(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    sl_options opt = options_none();
    opt.relaxation = SL_RELAXATION_NONE;
    factored_t y = factored_make(GEN_GRID2, 12100, 1, 0, &opt);
    uint64_t seed = 3;
    assert_true(sl_symbolic_view(y.S).n_supers > 5000);
    for (int k = 0; k < isas.count; k++) {
        factored_t z = y;
        opt.isa = isas.isa[k];
        SL_CHECK(sl_factor_create(&z.F, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
        for (sl_int nrhs = 1; nrhs <= 8; nrhs *= 2) {
            for (int round = 0; round < 4; round++) {
                check_random_sets(&z, 1 + gen_below(&seed, 5), 1 + gen_below(&seed, 5), nrhs,
                                  ++seed, NULL);
            }
        }
        sl_factor_free(z.F);
    }
    factored_free(&y);
}

static void solves_work_in_place(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    sl_plan *P = NULL;
    for (int round = 0; round < 20; round++) {
        sl_int nb = round % 2 ? 20 : 35, nx = round % 2 ? 35 : 20;
        local_solve_t q = local_solve_random(y.F, 100, nb, nx, 3, (uint64_t)round);
        double V[3 * 40], V2[3 * 40];
        gen_reals(V, 120, 4);
        for (int r = 0; r < 3; r++) {
            memcpy(V + 40 * r, q.B + (nb + 2) * r, (size_t)nb * sizeof *V);
        }
        memcpy(V2, V, sizeof V);
        SL_CHECK(sl_plan_create(&P, y.S, q.bset, nb, q.xset, nx, NULL, NULL));
        SL_CHECK(sl_plan_solve(P, y.F, V, 40, V, 40, 3, NULL));
        SL_CHECK(sl_local_solve(y.F, q.bset, nb, q.xset, nx, V2, 40, V2, 40, 3, NULL, NULL));
        for (int r = 0; r < 3; r++) {
            SAME_VALUES(V + 40 * r, q.wanted + nx * r, (size_t)nx);
            SAME_VALUES(V2 + 40 * r, q.wanted + nx * r, (size_t)nx);
        }
        sl_plan_free(P);
        local_solve_free(&q);
    }
    factored_free(&y);
}

/* A plan holds patterns only. It works with every factor of its analysis, before and after a
 * refactor. */
static void one_plan_works_with_every_factor_of_its_analysis(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    factored_t y = factored_make(GEN_GRID2, 300, 1, 0, NULL);
    sl_int n = y.M.view.n_cols, nnz = y.M.p[n];
    double *other = test_reals((size_t)nnz);
    local_solve_t first = local_solve_random(y.F, n, 30, 40, 4, 5);
    sl_plan *P = NULL;
    double *X = test_reals(40 * 4);
    SL_CHECK(sl_plan_create(&P, y.S, first.bset, 30, first.xset, 40, NULL, NULL));
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        sl_factor *F = NULL;
        opt.isa = isas.isa[k];
        SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
        for (int round = 0; round < 4; round++) {
            sl_csc A = y.M.view;
            for (sl_int q = 0; q < nnz; q++) {
                other[q] = y.M.x[q] * (1.0 + 0.25 * round) + (y.M.x[q] > 1 ? round : 0);
            }
            A.x = other;
            SL_CHECK(sl_factor_refactor(F, &A, NULL));
            local_solve_t q =
                local_solve_random(F, n, 30, 40, 4, 5); /* The same seed gives the same sets. */
            SL_CHECK(sl_plan_solve(P, F, X, 40, q.B, 32, 4, NULL));
            SAME_VALUES(X, q.wanted, 160);
            local_solve_free(&q);
        }
        sl_factor_free(F);
    }
    /* A factor of another analysis is refused, even if its matrix is the same. */
    factored_t z = factored_make(GEN_GRID2, 300, 1, 0, NULL);
    double keep = X[0];
    SL_EXPECT(SL_ERR_MISMATCH, sl_plan_solve(P, z.F, X, 40, first.B, 32, 4, NULL));
    assert_true(X[0] == keep);
    factored_free(&z);
    sl_plan_free(P);
    local_solve_free(&first);
    free(other);
    free(X);
    factored_free(&y);
}

static void a_column_does_not_depend_on_the_others(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_GRID3, 343, 1, 0, &opt);
        sl_plan *P = NULL;
        for (sl_int nrhs = 1; nrhs <= 9; nrhs++) {
            local_solve_t q = local_solve_random(y.F, y.M.view.n_cols, 25, 50, nrhs, 5);
            double X[50 * 9];
            SL_CHECK(sl_plan_create(&P, y.S, q.bset, 25, q.xset, 50, NULL, NULL));
            for (sl_int r = 0; r < nrhs; r++) {
                double B[27 * 9];
                for (sl_int at = 0; at < 27 * 9; at++) {
                    B[at] = at / 27 == r ? q.B[at] : at % 2 ? NAN : 1e300;
                }
                SL_EXPECT(nrhs > 1 ? SL_ERR_NOT_FINITE : SL_OK,
                          sl_plan_solve(P, y.F, X, 50, B, 27, nrhs, NULL));
                SAME_VALUES(X + 50 * r, q.wanted + 50 * r, 50);
            }
            sl_plan_free(P);
            local_solve_free(&q);
        }
        factored_free(&y);
    }
}

static void bad_sets_are_refused_and_the_row_reported(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 49, 1, 0, NULL);
    const sl_int good[3] = {4, 48, 0}, big[3] = {1, 49, 2}, low[3] = {1, 2, -5};
    const sl_int *bad[2] = {big, low};
    const sl_int named[2] = {49, -5};
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    for (int k = 0; k < 2; k++) {
        for (int side = 0; side < 2; side++) {
            sl_plan *P = (sl_plan *)(void *)&y;
            sl_stats stats;
            double X[4] = {5, 5, 5, 5}, B[4] = {1, 2, 3, 4};
            const sl_int *b = side ? good : bad[k], *x = side ? bad[k] : good;
            memset(&stats, 0, sizeof stats);
            SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_create(&P, y.S, b, 3, x, 3, NULL, &stats));
            assert_null(P);
            assert_int_equal(stats.error.row, named[k]);
            SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_create(&P, y.S, b, 3, x, 3, NULL, NULL));
            memset(&stats, 0, sizeof stats);
            SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(y.F, b, 3, x, 3, X, 4, B, 4, 1, W, &stats));
            assert_int_equal(stats.error.row, named[k]);
            assert_true(X[0] == 5 && X[1] == 5 && X[2] == 5 && X[3] == 5);
            /* The workspace must be clean after the refusal. */
            local_solve_t q = local_solve_random(y.F, 49, 5, 6, 2, 3);
            local_solve_check(y.S, y.F, &q, W);
            local_solve_free(&q);
        }
    }
    sl_work_free(W);
    factored_free(&y);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 9, 1, 0, NULL);
    const sl_int set[3] = {4, 8, 0};
    double X[9] = {5, 5, 5}, B[9] = {1, 2, 3};
    sl_plan *P = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_create(NULL, y.S, set, 3, set, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_create(&P, NULL, set, 3, set, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_create(&P, y.S, set, -1, set, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_create(&P, y.S, set, 3, set, -1, NULL, NULL));
    assert_null(P);
    SL_CHECK(sl_plan_create(&P, y.S, NULL, SL_ALL, set, 3, NULL, NULL));
    sl_plan_free(P);
    SL_CHECK(sl_plan_create(&P, y.S, set, 3, NULL, 9, NULL, NULL));
    sl_plan_free(P);
    SL_CHECK(sl_plan_create(&P, y.S, set, 2, set, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(NULL, y.F, X, 3, B, 3, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, NULL, X, 3, B, 3, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, NULL, 3, B, 3, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, X, 3, NULL, 3, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, X, 2, B, 3, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, X, 3, B, 1, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, X, 3, B, 3, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve(P, y.F, X, 3, X, 4, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(NULL, set, 3, set, 3, X, 3, B, 3, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(y.F, set, 3, set, 3, NULL, 3, B, 3, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(y.F, set, 3, set, 3, X, 3, NULL, 3, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(y.F, set, 3, set, 3, X, 2, B, 3, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(y.F, set, 3, set, 3, X, 3, B, 2, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(y.F, set, 3, set, 3, X, 3, B, 3, -1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(y.F, set, 3, set, -3, X, 3, B, 3, 1, NULL, NULL));
    /* ldx < n */
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_local_solve(y.F, set, 3, NULL, SL_ALL, X, 8, B, 3, 1, NULL, NULL));
    assert_true(X[0] == 5 && X[1] == 5 && X[2] == 5);
    sl_plan_free(P);
    sl_plan_free(NULL);
    factored_free(&y);
}

typedef struct worker_t {
    const sl_plan *P;
    const sl_symbolic *S;
    const sl_factor *F;
    const local_solve_t *q;
    int wrong; /* cmocka's asserts must not run in a thread */
} worker_t;

static void *solve_repeatedly(void *argument) {
    worker_t *w = (worker_t *)argument;
    const local_solve_t *q = w->q;
    size_t nx = (size_t)q->nx, ldb = (size_t)q->nb + 2;
    double *X = test_reals(nx * (size_t)q->nrhs);
    sl_work *W = NULL;
    w->wrong = sl_work_create(&W, NULL) != SL_OK;
    for (int round = 0; round < 200 && !w->wrong; round++) {
        memset(X, 0, nx * (size_t)q->nrhs * sizeof *X);
        sl_status status = round % 2 ? sl_plan_solve(w->P, w->F, X, nx, q->B, ldb, q->nrhs, W)
                                     : sl_local_solve(w->F, q->bset, q->nb, q->xset, q->nx, X, nx,
                                                      q->B, ldb, q->nrhs, W, NULL);
        w->wrong = status != SL_OK || first_difference(X, q->wanted, nx * (size_t)q->nrhs) >= 0;
    }
    sl_work_free(W);
    free(X);
    return NULL;
}

static void threads_share_a_factor_and_a_plan(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 900, 1, 0, NULL);
    local_solve_t q[2] = {local_solve_random(y.F, 900, 60, 80, 3, 1),
                          local_solve_random(y.F, 900, 60, 80, 3, 1)};
    sl_plan *P = NULL;
    pthread_t thread[2];
    worker_t worker[2];
    SL_CHECK(sl_plan_create(&P, y.S, q[0].bset, 60, q[0].xset, 80, NULL, NULL));
    gen_reals(q[1].B, 62 * 3, 2); /* The second thread solves for other right-hand sides. */
    SL_CHECK(sl_plan_solve(P, y.F, q[1].wanted, 80, q[1].B, 62, 3, NULL));
    for (int k = 0; k < 2; k++) {
        worker_t w = {P, y.S, y.F, &q[k], 0};
        worker[k] = w;
        assert_int_equal(pthread_create(&thread[k], NULL, solve_repeatedly, &worker[k]), 0);
    }
    for (int k = 0; k < 2; k++) {
        assert_int_equal(pthread_join(thread[k], NULL), 0);
        assert_int_equal(worker[k].wrong, 0);
    }
    sl_plan_free(P);
    local_solve_free(&q[0]);
    local_solve_free(&q[1]);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(local_solves_equal_the_full_solve),
        cmocka_unit_test(every_pair_of_rows_equals_the_full_solve),
        cmocka_unit_test(long_and_short_sweeps_agree),
        cmocka_unit_test(solves_work_in_place),
        cmocka_unit_test(one_plan_works_with_every_factor_of_its_analysis),
        cmocka_unit_test(a_column_does_not_depend_on_the_others),
        cmocka_unit_test(bad_sets_are_refused_and_the_row_reported),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(threads_share_a_factor_and_a_plan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
