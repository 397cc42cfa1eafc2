/* test_batch_factor.c: several factors over one analysis by one call, solves and diagonals with all of them */
#include "parallel_for.h"
#include "several.h"

enum { MOST = 8 };

/* 1 and t, t from small to large. */
static void coefficients_of(double *c, int count, double first) {
    for (int k = 0; k < count; k++) {
        c[TERMS * k] = 1;
        c[TERMS * k + 1] = ldexp(first, k);
    }
}

static sl_threads threads_of(int count, int *calls) {
    sl_threads threads = {count, count % 2 ? run_threads : run_backwards, calls};
    return threads;
}

static void free_all(sl_factor **F, int count) {
    for (int k = 0; k < count; k++) {
        sl_factor_free(F[k]);
        F[k] = NULL;
    }
}

static const sl_factor *const *read_only(sl_factor *const *F) {
    return (const sl_factor *const *)F;
}

/* ---- factoring ---- */

static void assert_family(const several_t *y, sl_factor *const *F, const double *c, int count,
                          sl_options opt) {
    opt.threads.count = 0;
    for (int k = 0; k < count; k++) {
        sl_factor *alone = NULL;
        SL_CHECK(sl_factor_create_combination(&alone, y->S, c + TERMS * k, several_values(y), TERMS,
                                              &opt, NULL));
        assert_same_bits(F[k], alone);
        sl_factor_free(alone);
    }
}

static void the_bits_of_single_factors(void **state) {
    (void)state;
    static const gen_kind_t kinds[5] = {GEN_GRID2, GEN_KKT, GEN_COMPONENTS, GEN_ONE, GEN_NONE};
    way_list_t ways = ways_present();
    double c[TERMS * MOST], other[TERMS * MOST];
    coefficients_of(c, MOST, 0.01);
    coefficients_of(other, MOST, 3);
    for (int kind = 0; kind < 5; kind++) {
        several_t y = several_make(kinds[kind], 200, 0, 1, NULL);
        for (int way = 0; way < ways.count; way++) {
            for (int threads = 0; threads <= 4; threads++) {
                for (int count = 0; count <= MOST; count = count * 2 + (count < 3)) {
                    counter_t counter = counter_make();
                    sl_options opt = options_counted(&counter);
                    sl_factor *F[MOST] = {NULL};
                    sl_int failed = 7;
                    int calls = 0;
                    way_take(&opt, &ways, way);
                    opt.threads = threads_of(threads, &calls);
                    SL_CHECK(sl_batch_factor(F, count, y.S, c, several_values(&y), TERMS, &opt,
                                             &failed, NULL));
                    assert_int_equal(failed, -1);
                    assert_true(calls == 0 || (threads > 1 && count > 0));
                    assert_family(&y, F, c, count, opt);
                    size_t asked = counter.calls;
                    for (int again = 0; again <= 4; again++) {
                        const sl_threads others = threads_of(again, &calls);
                        const double *now = again % 2 ? c : other;
                        SL_CHECK(sl_batch_refactor(F, count, now, several_values(&y), TERMS,
                                                   again ? &others : NULL, &failed, NULL));
                        assert_int_equal(failed, -1);
                        assert_int_equal(counter.calls, asked); /* allocates nothing */
                        if (again == 0 || again == 3) {
                            assert_family(&y, F, now, count, opt);
                            asked = counter.calls;
                        }
                    }
                    free_all(F, count);
                    COUNTER_CLEAN(&counter);
                }
            }
        }
        several_free(&y);
    }
}

/* Whole factors to each thread while they go round; what is left over is factored by all threads together. */
static void threads_take_whole_factors_and_share_the_rest(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID3, 15 * 15 * 15, 0, 1, NULL);
    double c[TERMS * MOST];
    coefficients_of(c, MOST, 0.5);
    for (int count = 1; count <= 5; count++) {
        sl_options opt = options_none();
        sl_factor *F[MOST] = {NULL};
        int calls = 0;
        sl_stats stats, alone;
        memset(&stats, 0, sizeof stats);
        memset(&alone, 0, sizeof alone);
        opt.method = SL_METHOD_SUPERNODAL;
        opt.threads = threads_of(3, &calls);
        SL_CHECK(sl_batch_factor(F, count, y.S, c, several_values(&y), TERMS, &opt, NULL, &stats));
        if (count == 3) {
            assert_int_equal(calls, 1); /* one loop over three factors */
        } else {
            assert_true(calls > 1); /* fronts are shared out */
        }
        assert_int_equal(stats.positive, y.n);
        size_t bytes = 0;
        for (int k = 0; k < count; k++) {
            sl_factor_stats(F[k], &alone);
            bytes += alone.bytes_factor;
        }
        assert_int_equal(stats.bytes_factor, bytes);
        assert_family(&y, F, c, count, opt);
        free_all(F, count);
    }
    several_free(&y);
}

/* The first that fails is told, the others are there. */
static void one_may_fail(void **state) {
    (void)state;
    static const double nothing[TERMS] = {0, 0}, wrong[TERMS] = {1, NAN};
    several_t y = several_make(GEN_GRID2, 100, 0, 1, NULL);
    double c[TERMS * MOST], good[TERMS * MOST];
    for (int threads = 0; threads <= 4; threads++) {
        for (int at = 0; at < MOST; at++) {
            sl_factor *F[MOST] = {NULL};
            sl_options opt = options_none();
            sl_stats stats, own;
            sl_int failed = 99, row = 3;
            int calls = 0, later = (at + 3) % MOST, first = at < later ? at : later;
            double x;
            coefficients_of(c, MOST, 1);
            coefficients_of(good, MOST, 1);
            memcpy(c + TERMS * at, nothing, sizeof nothing); /* the zero matrix .. */
            memcpy(c + TERMS * later, wrong, sizeof wrong);  /* .. and no matrix */
            memset(&stats, 0, sizeof stats);
            memset(&own, 0, sizeof own);
            opt.threads = threads_of(threads, &calls);
            sl_status status = first == at ? SL_ERR_PIVOT : SL_ERR_NOT_FINITE;
            SL_EXPECT(status, sl_batch_factor(F, MOST, y.S, c, several_values(&y), TERMS, &opt,
                                              &failed, &stats));
            assert_int_equal(failed, first);
            assert_int_equal(stats.error_row, first == at ? sl_symbolic_view(y.S).perm[0] : -1);
            assert_int_equal(stats.positive, 0);
            for (int k = 0; k < MOST; k++) {
                assert_true((F[k] == NULL) == (k == at || k == later));
                if (F[k]) {
                    SL_CHECK(sl_inverse_diagonal(F[k], &x, &row, 1, NULL, NULL));
                }
            }
            free_all(F, MOST);
            SL_CHECK(
                sl_batch_factor(F, MOST, y.S, good, several_values(&y), TERMS, &opt, NULL, &own));
            assert_int_equal(own.error_row, -1);
            SL_EXPECT(status, sl_batch_refactor(F, MOST, c, several_values(&y), TERMS, &opt.threads,
                                                &failed, &stats));
            assert_int_equal(failed, first);
            assert_int_equal(stats.error_row, first == at ? sl_symbolic_view(y.S).perm[0] : -1);
            for (int k = 0; k < MOST; k++) {
                SL_EXPECT(k == at || k == later ? SL_ERR_STATE : SL_OK,
                          sl_inverse_diagonal(F[k], &x, &row, 1, NULL, NULL));
            }
            SL_EXPECT(SL_ERR_STATE, sl_batch_diagonal(read_only(F), MOST, good, 1, &row, 1, NULL,
                                                      NULL, &failed, NULL));
            assert_int_equal(failed, first);
            SL_CHECK(sl_batch_refactor(F, MOST, good, several_values(&y), TERMS, &opt.threads,
                                       &failed, NULL));
            assert_int_equal(failed, -1);
            free_all(F, MOST);
        }
    }
    several_free(&y);
}

static void wrong_calls(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID2, 25, 0, 1, NULL),
              z = several_make(GEN_PATH, 25, 0, 1, NULL);
    double c[TERMS * MOST], before[TERMS * MOST];
    const double *const *v = several_values(&y);
    sl_factor *F[3], *G[3];
    sl_int failed = 9;
    sl_options opt = options_none();
    sl_threads threads = {-1, NULL, NULL};
    coefficients_of(c, MOST, 1);
    memcpy(before, c, sizeof c);
    memset(F, 0x5a, sizeof F);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_factor(F, 3, NULL, c, v, TERMS, NULL, &failed, NULL));
    assert_true(F[0] == NULL && F[1] == NULL && F[2] == NULL && failed == -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_factor(NULL, 3, y.S, c, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_factor(F, -1, y.S, c, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_factor(F, 3, y.S, NULL, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_factor(F, 3, y.S, c, NULL, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_factor(F, 3, y.S, c, v, -1, NULL, &failed, NULL));
    opt.threads = threads;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_factor(F, 3, y.S, c, v, TERMS, &opt, &failed, NULL));
    opt = options_none();
    opt.isa = (sl_isa)17;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_batch_factor(F, 3, y.S, c, v, TERMS, &opt, &failed, NULL));
    assert_true(F[0] == NULL && F[1] == NULL && F[2] == NULL && failed == 0);
    SL_CHECK(sl_batch_factor(NULL, 0, y.S, NULL, NULL, 0, NULL, &failed, NULL));
    SL_CHECK(sl_batch_factor(F, 3, y.S, c, v, TERMS, NULL, &failed, NULL));
    SL_CHECK(sl_batch_factor(G, 3, z.S, c, several_values(&z), TERMS, NULL, NULL, NULL));
    sl_factor *mixed[3] = {F[0], F[1], G[0]}, *twice[3] = {F[0], F[1], F[0]},
              *bare[3] = {F[0], NULL, F[1]};
    SL_EXPECT(SL_ERR_STATE, sl_batch_refactor(mixed, 3, c, v, TERMS, NULL, &failed, NULL));
    assert_int_equal(failed, 2);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_refactor(twice, 3, c, v, TERMS, NULL, &failed, NULL));
    assert_int_equal(failed, 2);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_refactor(bare, 3, c, v, TERMS, NULL, &failed, NULL));
    assert_int_equal(failed, 1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_refactor(NULL, 3, c, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_refactor(F, -1, c, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_refactor(F, 3, c, v, TERMS, &threads, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_refactor(F, 3, c, NULL, TERMS, NULL, &failed, NULL));
    assert_int_equal(failed, -1);
    SL_CHECK(sl_batch_refactor(NULL, 0, NULL, NULL, 0, NULL, &failed, NULL));
    const sl_factor *const *R = read_only(F);
    sl_int rows[2] = {3, 25};
    sl_stats stats;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, 3, c, 2, rows, 2, NULL, NULL, &failed, &stats));
    assert_true(failed == -1 && stats.error_row == 25);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, 3, c, 1, rows, -1, NULL, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, 3, NULL, 1, rows, 1, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, 3, c, 0, rows, 1, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, 3, c, 24, NULL, 0, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(NULL, 3, c, 1, rows, 1, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, -1, c, 1, rows, 1, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, 3, c, 1, rows, 1, &threads, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_STATE,
              sl_batch_diagonal(read_only(mixed), 3, c, 1, rows, 1, NULL, NULL, &failed, NULL));
    assert_int_equal(failed, 2);
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_diagonal(read_only(bare), 3, c, 1, rows, 1, NULL, NULL, &failed, NULL));
    assert_int_equal(failed, 1);
    sl_work *works[2] = {NULL, NULL};
    int calls = 0;
    threads = threads_of(2, &calls);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, 3, c, 1, rows, 1, &threads, works, NULL, NULL));
    SL_CHECK(sl_work_create(&works[0], NULL));
    works[1] = works[0];
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(R, 3, c, 1, rows, 1, &threads, works, NULL, NULL));
    sl_work_free(works[0]);
    assert_true(calls == 0 && memcmp(c, before, sizeof c) == 0);
    SL_CHECK(sl_batch_diagonal(R, 3, NULL, 0, rows, 0, &threads, NULL, &failed, &stats));
    SL_CHECK(sl_batch_diagonal(NULL, 0, NULL, 0, NULL, 0, &threads, NULL, NULL, NULL));
    free_all(F, 3);
    free_all(G, 3);
    several_free(&y);
    several_free(&z);
}

/* ---- asking all of them ---- */

/* One plan on all factors, with one B and with one for each; a full solve beside it. */
static void one_plan_serves_all(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    double c[TERMS * MOST];
    coefficients_of(c, MOST, 0.1);
    for (int isa = 0; isa < isas.count; isa++) {
        several_t y = several_make(GEN_GRID2, 200, 1, 0, NULL);
        const sl_int bset[2] = {17, 120}, xset[3] = {4, 18, 90};
        size_t n = (size_t)y.n;
        sl_factor *F[MOST] = {NULL};
        sl_plan *P = NULL;
        sl_options opt = options_none();
        sl_request requests[2 * MOST];
        double B[4 * MOST], X[6 * MOST], wanted[6 * MOST], *full = test_reals(n * MOST),
                                                           *expected = test_reals(n * MOST);
        opt.isa = isas.isa[isa];
        gen_reals(B, 4 * MOST, 5);
        gen_reals(expected, n * MOST, 6);
        SL_CHECK(sl_batch_factor(F, MOST, y.S, c, several_values(&y), TERMS, &opt, NULL, NULL));
        SL_CHECK(sl_plan_create(&P, y.S, bset, 2, xset, 3, NULL, NULL));
        memset(requests, 0, sizeof requests);
        for (size_t k = 0; k < MOST; k++) {
            sl_request *r = &requests[2 * k];
            r->plan = P;
            r->factor = F[k];
            r->X = X + 6 * k;
            r->ldx = 3;
            r->B = k < MOST / 2 ? B : B + 4 * k;
            r->ldb = 2;
            r->nrhs = 2;
            SL_CHECK(sl_plan_solve(P, F[k], wanted + 6 * k, 3, r->B, 2, 2, NULL));
            r[1].factor = k ? F[k] : NULL; /* that of the call */
            r[1].X = full + n * k;
            memcpy(r[1].X, expected + n * k, n * sizeof(double));
            r[1].B = r[1].X;
            r[1].ldx = r[1].ldb = n;
            r[1].nrhs = 1;
            SL_CHECK(sl_factor_solve(F[k], expected + n * k, n, expected + n * k, n, 1, NULL));
        }
        SL_CHECK(sl_batch_solve(F[0], requests, 2 * MOST, NULL, NULL, NULL));
        SAME_VALUES(full, expected, n * MOST);
        SAME_VALUES(X, wanted, 6 * MOST);
        for (size_t k = 0; k < MOST; k++) { /* the plans alone, without a factor of the call */
            requests[k] = requests[2 * k];
        }
        for (int count = 0; count <= 4; count++) {
            int calls = 0;
            const sl_threads threads = threads_of(count, &calls);
            memset(X, 0, sizeof X);
            SL_CHECK(sl_batch_solve(NULL, requests, MOST, &threads, NULL, NULL));
            SAME_VALUES(X, wanted, 6 * MOST);
            assert_int_equal(calls, count > 1);
        }
        sl_plan_free(P);
        free_all(F, MOST);
        free(full);
        free(expected);
        several_free(&y);
    }
}

static void requests_with_wrong_factors(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID2, 25, 0, 1, NULL),
              z = several_make(GEN_PATH, 25, 0, 1, NULL);
    const double c[TERMS] = {1, 1}, none[TERMS] = {0, 0};
    const sl_int row = 3;
    double X[3] = {7, 7, 7}, B = 1;
    sl_factor *F = NULL, *G = NULL, *bad = NULL;
    sl_plan *P = NULL;
    sl_int failed = 9;
    SL_CHECK(sl_factor_create_combination(&F, y.S, c, several_values(&y), TERMS, NULL, NULL));
    SL_CHECK(sl_factor_create_combination(&bad, y.S, c, several_values(&y), TERMS, NULL, NULL));
    SL_CHECK(sl_factor_create_combination(&G, z.S, c, several_values(&z), TERMS, NULL, NULL));
    SL_EXPECT(SL_ERR_PIVOT,
              sl_factor_refactor_combination(bad, none, several_values(&y), TERMS, NULL));
    SL_CHECK(sl_plan_create(&P, y.S, &row, 1, &row, 1, NULL, NULL));
    sl_request r[3];
    memset(r, 0, sizeof r);
    for (int k = 0; k < 3; k++) {
        r[k].plan = P;
        r[k].X = &X[k];
        r[k].B = &B;
        r[k].ldx = r[k].ldb = 1;
        r[k].nrhs = 1;
        r[k].factor = F;
    }
    r[2].factor = G;
    SL_EXPECT(SL_ERR_STATE, sl_batch_solve(F, r, 3, NULL, NULL, &failed));
    assert_int_equal(failed, 2);
    r[1].factor = bad;
    SL_EXPECT(SL_ERR_STATE, sl_batch_solve(F, r, 3, NULL, NULL, &failed));
    assert_int_equal(failed, 1);
    r[1].factor = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(NULL, r, 3, NULL, NULL, &failed));
    assert_int_equal(failed, 1);
    assert_true(X[0] == 7 && X[1] == 7 && X[2] == 7);
    SL_CHECK(sl_batch_solve(NULL, r, 1, NULL, NULL, &failed));
    assert_true(X[0] != 7 && X[1] == 7 && failed == -1);
    sl_plan_free(P);
    sl_factor_free(F);
    sl_factor_free(G);
    sl_factor_free(bad);
    several_free(&y);
    several_free(&z);
}

/* The bits of sl_inverse_diagonal, and the numbers of dense inverses: c n eps of the entry with c = 100, as definite
 * matrices are held to in test_inverse. */
static void diagonals_over_t(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    double c[TERMS * MOST];
    coefficients_of(c, MOST, 0.01);
    for (int isa = 0; isa < isas.count; isa++) {
        several_t y = several_make(GEN_GRID2, 150, 2, 3, NULL);
        size_t n = (size_t)y.n, ld = n + 3;
        sl_options opt = options_none();
        sl_factor *F[MOST] = {NULL};
        sl_work *works[4];
        sl_int rows[50];
        uint64_t seed = 8;
        double *out = test_reals(ld * MOST), *one = test_reals(n);
        opt.isa = isas.isa[isa];
        SL_CHECK(sl_batch_factor(F, MOST, y.S, c, several_values(&y), TERMS, &opt, NULL, NULL));
        for (int k = 0; k < 50; k++) {
            rows[k] = gen_below(&seed, y.n); /* some twice */
        }
        for (int k = 0; k < 4; k++) {
            SL_CHECK(sl_work_create(&works[k], NULL));
        }
        for (int threads = 0; threads <= 4; threads++) {
            for (int all = 0; all < 2; all++) {
                for (int own = 0; own < 2; own++) {
                    size_t count = all ? n : 50;
                    int calls = 0;
                    const sl_threads t = threads_of(threads, &calls);
                    for (size_t k = 0; k < ld * MOST; k++) {
                        out[k] = 4321.5;
                    }
                    SL_CHECK(sl_batch_diagonal(read_only(F), MOST, out, ld, all ? NULL : rows, 50,
                                               threads ? &t : NULL, own ? NULL : works, NULL,
                                               NULL));
                    assert_int_equal(calls, threads > 1);
                    for (size_t k = 0; k < MOST; k++) {
                        SL_CHECK(sl_inverse_diagonal(F[k], one, all ? NULL : rows, 50, NULL, NULL));
                        SAME_VALUES(out + k * ld, one, count);
                        for (size_t i = count; i < ld; i++) {
                            assert_true(out[i + k * ld] == 4321.5);
                        }
                    }
                }
            }
        }
        for (int k = 0; k < MOST; k++) {
            sl_matrix *A = several_sum(&y, c + TERMS * k);
            sl_csc view = sl_matrix_view(A);
            double *M = ref_dense(&view), *Z = ref_inverse(y.n, M);
            for (size_t i = 0; i < n; i++) {
                const double z = Z[i + i * n];
                assert_true(fabs(out[i + (size_t)k * ld] - z) <= 10 * pass_figure(y.n) * fabs(z));
            }
            free(M);
            free(Z);
            sl_matrix_free(A);
        }
        for (int k = 0; k < 4; k++) {
            sl_work_free(works[k]);
        }
        free_all(F, MOST);
        free(out);
        free(one);
        several_free(&y);
    }
}

/* A parallel-for in which nothing may be allocated. */
static void run_without_memory(void *context, sl_int count, void (*body)(void *data, sl_int k),
                               void *data) {
    counter_t *counter = (counter_t *)context;
    counter->fail_at = (int64_t)counter->calls;
    for (sl_int k = count - 1; k >= 0; k--) {
        body(data, k);
    }
    assert_int_equal(counter->fail_at, counter->calls);
    counter->fail_at = -1;
}

/* Factors of several instruction sets, whose sweeps need different room, in one call: that is found beforehand. */
static void diagonals_of_several_instruction_sets(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    several_t y = several_make(GEN_GRID2, 400, 0, 0, NULL);
    const double c[TERMS] = {1, 1};
    sl_factor *F[4] = {NULL};
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    double *out = test_reals((size_t)y.n * 4), *one = test_reals((size_t)y.n);
    const sl_threads threads = {3, run_without_memory, &counter};
    for (int k = 0; k < isas.count; k++) {
        opt.isa = isas.isa[k];
        SL_CHECK(
            sl_factor_create_combination(&F[k], y.S, c, several_values(&y), TERMS, &opt, NULL));
    }
    SL_CHECK(sl_batch_diagonal(read_only(F), isas.count, out, (size_t)y.n, NULL, 0, &threads, NULL,
                               NULL, NULL));
    for (int k = 0; k < isas.count; k++) {
        SL_CHECK(sl_inverse_diagonal(F[k], one, NULL, 0, NULL, NULL));
        SAME_VALUES(out + (size_t)k * (size_t)y.n, one, (size_t)y.n);
    }
    free_all(F, 4);
    free(out);
    free(one);
    several_free(&y);
    COUNTER_CLEAN(&counter);
}

/* ---- memory ---- */

/* The factor that gets none is NULL, the others are there; a diagonal that gets none leaves out as it is, and with
 * workspaces that have grown asks for none. */
static void memory_may_fail(void **state) {
    (void)state;
    several_t y = several_make(GEN_GRID2, 100, 0, 2, NULL);
    double c[TERMS * 4], out[16];
    sl_int rows[4] = {1, 50, 50, 7};
    int done = 0;
    coefficients_of(c, 4, 1);
    for (int64_t k = 0; !done; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_factor *F[4];
        sl_work *works[3] = {NULL, NULL, NULL};
        sl_int failed = 9;
        int calls = 0, missing = 0;
        opt.threads = threads_of(3, &calls);
        memset(F, 0x5a, sizeof F);
        counter.fail_at = k;
        sl_status status =
            sl_batch_factor(F, 4, y.S, c, several_values(&y), TERMS, &opt, &failed, NULL);
        for (int j = 0; j < 4; j++) {
            missing += F[j] == NULL;
            assert_true((F[j] == NULL) == (failed == j));
        }
        if (status != SL_OK) {
            assert_int_equal(status, SL_ERR_MEMORY);
            assert_int_equal(missing, 1);
            free_all(F, 4);
            COUNTER_CLEAN(&counter);
            continue;
        }
        out[0] = 4321;
        status =
            sl_batch_diagonal(read_only(F), 4, out, 4, rows, 4, &opt.threads, NULL, NULL, NULL);
        assert_true((status == SL_OK) == (out[0] != 4321));
        for (int j = 0; j < 3 && status == SL_OK; j++) {
            status = sl_work_create(&works[j], &opt);
        }
        if (status == SL_OK) {
            out[0] = 4321;
            status = sl_batch_diagonal(read_only(F), 4, out, 4, rows, 4, &opt.threads, works, NULL,
                                       NULL);
            assert_true((status == SL_OK) == (out[0] != 4321));
        }
        if (status == SL_OK) {
            size_t asked = counter.calls;
            SL_CHECK(sl_batch_diagonal(read_only(F), 4, out, 4, rows, 4, &opt.threads, works, NULL,
                                       NULL));
            assert_int_equal(counter.calls, asked);
            done = 1;
        }
        assert_true(done || status == SL_ERR_MEMORY);
        assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
        for (int j = 0; j < 3; j++) {
            sl_work_free(works[j]);
        }
        free_all(F, 4);
        COUNTER_CLEAN(&counter);
    }
    several_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bits_of_single_factors),
        cmocka_unit_test(threads_take_whole_factors_and_share_the_rest),
        cmocka_unit_test(one_may_fail),
        cmocka_unit_test(wrong_calls),
        cmocka_unit_test(one_plan_serves_all),
        cmocka_unit_test(requests_with_wrong_factors),
        cmocka_unit_test(diagonals_over_t),
        cmocka_unit_test(diagonals_of_several_instruction_sets),
        cmocka_unit_test(memory_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
