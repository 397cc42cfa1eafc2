/* test_null_judge.c: by default small pivots that are right are kept, null ones are refused, and a
 * refusal says what helps */
#include "tests/lib/factored.h"
#include "tests/lib/graph_laplacian.h"
#include "tests/lib/parallel_for.h"
#include "tests/lib/random_systems.h"

/* Entry (i, j) of the lower triangle of a square array. */
#define CELL(M, n, i, j) (M)[(size_t)(i) * (size_t)(n) + (size_t)(j)]

static const sl_ordering orders[3] = {SL_ORDERING_ND, SL_ORDERING_NATURAL, SL_ORDERING_MINDEG};

/* Factors M; returns the status. With SL_OK the backward error of a solve is small. */
static sl_status factor_and_solve(const gen_matrix_t *M, const sl_options *opt, sl_stats *stats) {
    const sl_int n = M->view.n_cols;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    memset(stats, 0, sizeof *stats);
    SL_CHECK(sl_symbolic_create(&S, &M->view, FOR_ANALYSIS(opt), NULL));
    const sl_status status = sl_factor_create(&F, S, &M->view, FOR_FACTOR(opt), stats);
    if (status == SL_OK && opt->storage == SL_STORAGE_DOUBLE) {
        double *b = test_reals((size_t)n), *x = test_reals((size_t)n);
        gen_reals(b, (size_t)n, 5);
        SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
        assert_true(worst_backward(&M->view, x, (size_t)n, b, (size_t)n, 1) <=
                    16.0 * DBL_EPSILON * fmax(stats->factor.growth, 4.0));
        free(b);
        free(x);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

/* shift I + lambda D'D, where D takes second differences. */
static gen_matrix_t smoother(sl_int n, double lambda, double shift) {
    static const double d[3] = {1.0, -2.0, 1.0};
    double *band = test_reals(3 * (size_t)n);
    gen_list_t t = gen_list(n);
    for (sl_int k = 0; k < n - 2; k++) {
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b <= a; b++) {
                band[3 * (k + a) + a - b] += lambda * d[a] * d[b];
            }
        }
    }
    for (sl_int k = 0; k < n; k++) {
        for (sl_int j = 0; j < 3 && j <= k; j++) {
            gen_add(&t, k, k - j, band[3 * k + j] + (j == 0 ? shift : 0.0));
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    free(band);
    return M;
}

static void a_stiff_smoother_is_kept(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    gen_matrix_t M = smoother(20000, 3e14, 1.0);
    for (int k = 0; k < variants.count; k++) {
        for (int o = 0; o < 3; o++) {
            sl_options opt = options_none();
            sl_stats stats;
            options_set_variant(&opt, &variants, k);
            opt.ordering = orders[o];
            SL_CHECK(factor_and_solve(&M, &opt, &stats));
            assert_int_equal(stats.factor.positive, 20000);
            opt.threads.count = 3;
            opt.threads.run = run_backwards;
            int calls = 0;
            opt.threads.context = &calls;
            SL_CHECK(factor_and_solve(&M, &opt, &stats));
            /* a tolerance of the caller's is not judged */
            opt.null_tolerance = 1e-11;
            SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&M, &opt, &stats));
            assert_true(stats.null_bound >= fabs(stats.error.value));
        }
    }
    gen_matrix_free(&M);
}

/* The lower triangle of an m x m block as the first rows of a matrix of n rows; the others have a
 * diagonal entry of 1. */
static gen_matrix_t beside(const double *block, sl_int m, sl_int n) {
    gen_list_t t = gen_list(n);
    for (sl_int i = 0; i < m; i++) {
        for (sl_int j = 0; j <= i; j++) {
            if (i == j || CELL(block, m, i, j) != 0.0) {
                gen_add(&t, i, j, CELL(block, m, i, j));
            }
        }
    }
    for (sl_int i = m; i < n; i++) {
        gen_add(&t, i, i, 1.0);
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* Every allocation of a judgement fails once: of a suspected last pivot, or of a pivot below the
 * tolerance. The pivot is then null. */
static void without_memory_a_small_pivot_is_refused(void **state) {
    (void)state;
    static const double block[4] = {1.0, 0.0, 1.0, 1.0 + 1e-14};
    for (int turn = 0; turn < 2; turn++) {
        gen_matrix_t A = turn == 0 ? smoother(20000, 3e14, 1.0) : beside(block, 2, 2);
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        sl_status status = SL_ERR_PIVOT;
        int failed = 0;
        SL_CHECK(sl_symbolic_create(&S, &A.view, FOR_ANALYSIS(&opt), NULL));
        SL_CHECK(sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), NULL));
        for (int64_t k = 0; status == SL_ERR_PIVOT; k++) {
            counter.fail_at = (int64_t)counter.calls + k;
            status = sl_factor_refactor(F, &A.view, &stats);
            assert_true(status == SL_OK || strstr(stats.error.what, "no memory") != NULL);
            assert_true(status == SL_OK || stats.null_bound == 0.0);
            failed += status == SL_ERR_PIVOT;
        }
        assert_int_equal(status, SL_OK);
        assert_int_equal(failed, turn == 0 ? 2 : 1);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&A);
        COUNTER_CLEAN(&counter);
    }
}

/* In a batch, the calling thread judges. */
static void factors_of_a_batch_are_judged(void **state) {
    (void)state;
    enum { COUNT = 5 };
    static const double block[4] = {1.0, 0.0, 1.0, 1.0 + 1e-14};
    const double c[COUNT] = {1.0, 2.0, 0.5, 1e-3, 1e5};
    const double *values[1];
    gen_matrix_t A = beside(block, 2, 9);
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_symbolic *S = NULL;
    sl_factor *F[COUNT] = {NULL}, *G = NULL;
    double *v = test_reals((size_t)A.p[9]);
    int calls = 0;
    values[0] = v;
    opt.threads.count = 3;
    opt.threads.run = run_backwards;
    opt.threads.context = &calls;
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_symbolic_scatter(S, v, &A.view, NULL));
    SL_CHECK(sl_batch_factor(F, COUNT, S, c, values, 1, FOR_FACTOR(&opt), NULL, NULL));
    SL_CHECK(sl_batch_refactor(F, COUNT, c, values, 1, NULL, NULL, NULL));
    SL_CHECK(sl_factor_create(&G, S, &A.view, NULL, NULL));
    assert_same_bits(F[0], G);
    for (int k = 0; k < COUNT; k++) {
        sl_factor_free(F[k]);
    }
    sl_factor_free(G);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    free(v);
    COUNTER_CLEAN(&counter);
}

/* A smoother, and a row that an explicit zero joins to it. */
static void explicit_zeros_do_not_hide_a_last_pivot(void **state) {
    (void)state;
    gen_matrix_t A = smoother(20001, 3e14, 1.0);
    sl_options opt = options_none();
    sl_stats stats;
    opt.ordering = SL_ORDERING_NATURAL;
    /* row 20000 leaves the smoother, which then ends at a fixed row */
    for (sl_int j = 19998; j <= 20000; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            A.x[p] = A.i[p] == 20000 ? (double)(j == 20000) : A.x[p];
        }
    }
    A.x[A.p[19998]] -= 3e14;
    A.x[A.p[19998] + 1] += 6e14;
    A.x[A.p[19999]] -= 12e14;
    SL_CHECK(factor_and_solve(&A, &opt, &stats));
    assert_int_equal(stats.factor.positive, 20001);
    gen_matrix_free(&A);
}

/* A small pivot after a 2x2 pivot, in the order of the values. */
static void pivots_after_a_pair_are_judged(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double last = 0.2 + (k == 0 ? 2.7e-15 : 0.0);
        const double M[9] = {0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 1.0, 1.0, last};
        gen_matrix_t A = beside(M, 3, 3);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_options opt = options_none();
        sl_stats stats;
        opt.ordering = SL_ORDERING_NATURAL;
        SL_CHECK(sl_symbolic_create_pivoted(&S, &A.view, &opt, &stats));
        assert_int_equal(stats.symbolic.pairs, 1);
        SL_EXPECT(k == 0 ? SL_OK : SL_ERR_PIVOT, sl_factor_create(&F, S, &A.view, NULL, &stats));
        assert_true(k == 0 || strstr(stats.error.what, "null_tolerance") != NULL);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&A);
    }
}

/* Small pivots beside many rows that nothing joins to them. Definite: v v' + D, v of ones.
 * Quasi-definite: [-1e-8 v'; v h I], natural order, whose pivots after the second are about 2 h and
 * computed from 2e8. */
static void rows_that_nothing_joins_do_not_decide(void **state) {
    (void)state;
    enum { M = 12, N = 30000 };
    const variant_list_t variants = variants_present();
    uint64_t seed = 7;
    for (int turn = 0; turn < 24; turn++) {
        double block[M * M] = {0.0};
        const sl_int m = 3 + gen_below(&seed, M - 3);
        const int is_definite = turn % 2;
        const double small = is_definite ? 1e-12 : 4e-5;
        sl_options opt = options_none();
        sl_stats stats;
        for (sl_int i = 0; i < m; i++) {
            for (sl_int j = 0; j < i; j++) {
                CELL(block, m, i, j) = is_definite || j == 0 ? 1.0 : 0.0;
            }
            CELL(block, m, i, i) = (is_definite ? 1.0 : 0.0) + (i > 0 ? small : 0.0);
        }
        block[0] += is_definite ? 0.0 : -1e-8;
        gen_matrix_t A = beside(block, m, N);
        options_set_variant(&opt, &variants, turn % variants.count);
        opt.ordering = SL_ORDERING_NATURAL;
        SL_CHECK(factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.positive, is_definite ? N : N - 1);
        assert_int_equal(stats.factor.negative, !is_definite);
        if (is_definite) { /* where null pivots are replaced, these are not */
            opt.null_pivots = SL_NULL_PIVOT_SKIP;
            SL_CHECK(factor_and_solve(&A, &opt, &stats));
            assert_int_equal(stats.factor.null, 0);
            opt.null_pivots = SL_NULL_PIVOT_REFUSE;
            opt.regularization = 1e-8;
            SL_CHECK(factor_and_solve(&A, &opt, &stats));
            assert_int_equal(stats.factor.regularized, 0);
        }
        gen_matrix_free(&A);
    }
}

/* ---- what long double solves is not refused ---- */

/* The backward error of the dense LDL' of M, lower triangle, in long double, in the given order; 1
 * if a pivot is 0. */
static double error_in_long_double(const double *M, sl_int m) {
    long double *L = (long double *)test_array((size_t)(m * m), sizeof *L), worst = 0.0L;
    long double *b = (long double *)test_array((size_t)m, sizeof *b), row, norm = 0.0L, x = 0.0L;
    for (sl_int k = 0; k < m * m; k++) {
        L[k] = M[k];
    }
    for (sl_int k = 0; k < m; k++) {
        for (sl_int i = k + 1; i < m; i++) {
            for (sl_int j = k + 1; j <= i; j++) {
                CELL(L, m, i, j) -= CELL(L, m, i, k) * CELL(L, m, j, k) / CELL(L, m, k, k);
            }
        }
        b[k] = 1.0L;
        worst = CELL(L, m, k, k) == 0.0L ? 1.0L : worst;
    }
    for (sl_int k = 0; k < m && worst == 0.0L; k++) {
        for (sl_int j = 0; j < k; j++) {
            b[k] -= CELL(L, m, k, j) / CELL(L, m, j, j) * b[j];
        }
    }
    for (sl_int k = m; k-- > 0 && worst == 0.0L;) {
        for (sl_int i = k + 1; i < m; i++) {
            b[k] -= CELL(L, m, i, k) * b[i];
        }
        b[k] /= CELL(L, m, k, k);
    }
    for (sl_int i = 0; i < m && worst < 1.0L; i++) {
        long double r = 1.0L;
        row = 0.0L;
        for (sl_int j = 0; j < m; j++) {
            const double a = j <= i ? CELL(M, m, i, j) : CELL(M, m, j, i);
            r -= a * b[j];
            row += fabs(a);
        }
        norm = row > norm ? row : norm;
        x = fabsl(b[i]) > x ? fabsl(b[i]) : x;
        worst = fabsl(r) > worst ? fabsl(r) : worst;
    }
    free(L);
    free(b);
    return (double)(worst < 1.0L || norm * x > 1.0L ? worst / (norm * x + 1.0L) : worst);
}

/* Chains, trees with a few more springs, dense blocks and quasi-definite blocks, with a shift that
 * is small against their entries. */
static void small_block(double *M, sl_int m, int kind, uint64_t *seed) {
    const double shift = system_scale(seed, kind < 6 ? -12.5 : -10.0, -7.0);
    const sl_int half = kind < 6 ? m : m - m / 3;
    for (sl_int i = 1; i < half; i++) {
        const sl_int up = kind % 3 == 0 ? i - 1 : gen_below(seed, i);
        system_spring(M, m, i, up, system_scale(seed, -1.0, 0.0));
        if (gen_below(seed, kind % 3 == 2 ? 1 : 6) == 0) {
            system_spring(M, m, i, gen_below(seed, i), system_scale(seed, -1.0, 0.0));
        }
    }
    for (sl_int i = 0; i < m; i++) {
        CELL(M, m, i, i) += i < half ? shift : -shift;
    }
    for (sl_int i = half; i < m; i++) {
        CELL(M, m, i, gen_below(seed, half)) += 1.0;
        CELL(M, m, i, gen_below(seed, half)) += gen_real(seed);
    }
}

/* Definite systems are solved. Of the quasi-definite ones 1 % are refused: a pivot is within its
 * error. Without a tolerance a quarter of these has another inertia. */
static void what_long_double_solves_is_not_refused(void **state) {
    (void)state;
    enum { M = 60, N = 30000, TURNS = 1800 };
    const variant_list_t variants = variants_present();
    uint64_t seed = 23;
    int solved = 0, refused = 0;
    for (int turn = 0; turn < TURNS; turn++) {
        double block[M * M] = {0.0};
        const sl_int m = 2 + gen_below(&seed, M - 1);
        const int is_definite = turn % 9 < 6;
        sl_options opt = options_none();
        sl_stats stats;
        small_block(block, m, turn % 9, &seed);
        gen_matrix_t A = beside(block, m, m + (turn % 5 == 0 ? N : 0));
        options_set_variant(&opt, &variants, turn % variants.count);
        opt.ordering = SL_ORDERING_NATURAL;
        if (error_in_long_double(block, m) <= 1e-8) {
            const sl_status status = factor_and_solve(&A, &opt, &stats);
            assert_true(status == SL_OK || (status == SL_ERR_PIVOT && !is_definite &&
                                            fabs(stats.error.value) <= stats.null_bound));
            solved += status == SL_OK;
            refused += status == SL_ERR_PIVOT;
        }
        gen_matrix_free(&A);
    }
    assert_true(solved + refused > TURNS - TURNS / 20 && refused < TURNS / 50);
}

/* Every way to numbers of a stiff smoother gives them, and none those of its singular part. */
static void every_way_judges_alike(void **state) {
    (void)state;
    const sl_int n = 20000, column[1] = {11000};
    gen_matrix_t A = smoother(n, 3e14, 1.0), B = smoother(n, 3e14, 0.0);
    sl_int *same = test_ints((size_t)n);
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_stats stats;
    for (sl_int k = 0; k < n; k++) {
        same[k] = k;
    }
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A.view, NULL, NULL));
    SL_CHECK(sl_factor_edit(&G, F, S, &A.view, same, NULL, NULL));
    assert_same_bits(F, G);
    SL_CHECK(sl_factor_refactor_changed(G, &A.view, column, 1, NULL));
    assert_same_bits(F, G);
    sl_factor_free(G);
    SL_CHECK(sl_factor_restrict(&T, &G, F, &A.view, same, n, NULL, NULL));
    sl_factor_free(G);
    sl_symbolic_free(T);
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_edit(&G, F, S, &B.view, same, NULL, &stats));
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            A.x[p] = B.x[p];
        }
    }
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor_changed(F, &A.view, same, n, &stats));
    SL_EXPECT(SL_ERR_STALE, sl_factor_refactor_changed(F, &A.view, column, 1, &stats));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &A.view, &stats));
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
    free(same);
}

/* The restriction of a factor to rows has the tolerance of these rows, and an explicit tolerance is
 * kept. */
static void a_restriction_and_an_update_judge_by_their_rows(void **state) {
    (void)state;
    enum { N = 40000 };
    static const double block[4] = {1.0, 0.0, 1.0, 1.0 + 1e-12};
    const sl_int rows[3] = {0, 1, 17};
    const double sigma[1] = {1.0};
    gen_matrix_t A = beside(block, 2, N);
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_options opt = options_none();
    for (int k = 0; k < 2; k++) {
        const sl_int p[2] = {0, 1}, i[1] = {0};
        const double x[1] = {1e-9};
        const sl_csc V = {N, 1, p, i, x};
        opt.null_tolerance = k == 0 ? 0.0 : 1e-16;
        SL_CHECK(sl_symbolic_create(&S, &A.view, FOR_ANALYSIS(&opt), NULL));
        SL_CHECK(sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_restrict(&T, &G, F, &A.view, rows, 3, NULL, NULL));
        SL_CHECK(sl_factor_update(F, &V, sigma, NULL, NULL));
        sl_factor_free(G);
        sl_symbolic_free(T);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    gen_matrix_free(&A);
}

/* ---- null pivots are refused ---- */

static gen_matrix_t graph(sl_int n, int kind, double spread, uint64_t *seed) {
    double *M = test_reals((size_t)n * (size_t)n);
    for (sl_int i = 1; i < n; i++) {
        const sl_int up = kind == 0 ? i - 1 : kind == 1 ? 0 : gen_below(seed, i);
        system_spring(M, n, i, up, kind == 4 ? 1.0 : system_scale(seed, -spread, 0.0));
        for (sl_int j = 0; j < i && kind >= 3; j++) {
            const double w = kind == 4 ? 1.0 : system_scale(seed, -spread, 0.0);
            if (kind == 4 || gen_below(seed, 4) == 0) {
                system_spring(M, n, i, j, w);
            }
        }
    }
    gen_matrix_t A = beside(M, n, n);
    free(M);
    return A;
}

static void singular_laplacians_are_refused(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    uint64_t seed = 3;
    for (int turn = 0; turn < 1500; turn++) {
        sl_options opt = options_none();
        const sl_int n = 2 + gen_below(&seed, 70);
        const double spread = turn % 3 == 0 ? 12.0 * fabs(gen_real(&seed)) : 0.5;
        gen_matrix_t A = graph(n, turn % 5, spread, &seed);
        sl_stats stats;
        options_set_variant(&opt, &variants, turn % variants.count);
        opt.ordering = orders[turn / 5 % 3];
        SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.null, 1);
        assert_true(stats.factor.growth == 0.0 && stats.error.row >= 0);
        assert_true(strstr(stats.error.what, "sl_symbolic_create_pivoted") != NULL);
        gen_matrix_free(&A);
    }
}

/* A heavy path, joined weakly to a row that is joined more weakly to a light path: the pivot of
 * that row is lost in rounding, and the last one, computed from it, looks regular. */
static void a_pivot_after_a_lost_one_is_refused(void **state) {
    (void)state;
    enum { N = 20 };
    uint64_t seed = 1;
    for (int turn = 0; turn < 60; turn++) {
        double M[N * N] = {0.0};
        sl_options opt = options_none();
        sl_stats stats;
        for (sl_int i = 1; i < N; i++) {
            const double w = i < 9 ? 1.0 : i == 9 ? 1e-6 : 1e-20;
            system_spring(M, N, i, i - 1, w * (1.0 + fabs(gen_real(&seed))));
        }
        gen_matrix_t A = beside(M, N, N);
        opt.ordering = SL_ORDERING_NATURAL;
        SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
        gen_matrix_free(&A);
    }
}

/* 1 1; 1 1 + 2^-47: the second pivot is small and right. What follows it fails. */
static void a_failure_after_a_small_pivot_is_that_of_the_pivot(void **state) {
    (void)state;
    const double d = ldexp(1.0, -47);
    /* the third pivot is 0 */
    const double zero[9] = {1.0, 0.0, 0.0, 1.0, 1.0 + d, 0.0, 0.0, 1.0, 1.0 / d};
    /* the entry of L below the second pivot exceeds float */
    const double large[9] = {1.0, 0.0, 0.0, 1.0, 1.0 + d, 0.0, 0.0, 1e30, 1e100};
    for (int k = 0; k < 4; k++) {
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        gen_matrix_t A = beside(k == 3 ? large : zero, 3, 3);
        opt.ordering = SL_ORDERING_NATURAL;
        opt.relaxation = k == 1 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
        opt.method = k == 2 ? SL_METHOD_UP_LOOKING : SL_METHOD_SUPERNODAL;
        opt.storage = k == 3 ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
        SL_CHECK(sl_symbolic_create(&S, &A.view, FOR_ANALYSIS(&opt), NULL));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), &stats));
        assert_in_range(stats.error.row, 1, 2);
        assert_true(stats.error.row == 2 ? stats.error.value == 0.0 : stats.error.value == d);
        assert_true(stats.null_bound > 0.0);
        sl_symbolic_free(S);
        gen_matrix_free(&A);
    }
}

/* Very many small pivots, each after a long path: judging all would take longer than the
 * factorization. */
static void judgements_end(void **state) {
    (void)state;
    enum { N = 4000, M = 140 };
    sl_options opt = options_none();
    sl_stats stats;
    gen_list_t t = gen_list(N + M);
    for (sl_int i = 0; i < N; i++) {
        gen_add(&t, i, i, 3.0);
        gen_add(&t, i + 1, i, -1.0);
    }
    for (sl_int i = N; i < N + M; i++) {
        for (sl_int j = N; j <= i; j++) {
            gen_add(&t, i, j, i == j && i > N ? 1.0 + 6e-14 : 1.0);
        }
    }
    gen_add(&t, N, N, 1.0);
    gen_matrix_t A = gen_store(&t, gen_style(0), 1);
    opt.ordering = SL_ORDERING_NATURAL;
    SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
    assert_true(strstr(stats.error.what, "null_tolerance") != NULL);
    opt.null_tolerance = -1.0;
    SL_CHECK(factor_and_solve(&A, &opt, &stats));
    gen_matrix_free(&A);
    gen_list_free(&t);
}

/* Random symmetric matrices whose last row repeats the first one: singular, indefinite. Consistent
 * systems are solved by regularization and refinement. */
static void consistent_indefinite_systems_are_solved_by_regularization(void **state) {
    (void)state;
    enum { N = 14 };
    uint64_t seed = 31;
    for (int turn = 0; turn < 60; turn++) {
        double M[N * N] = {0.0}, b[N], x[N], z[N];
        sl_int signs[N] = {0};
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        for (sl_int i = 0; i < N - 1; i++) {
            for (sl_int j = 0; j <= i; j++) {
                CELL(M, N, i, j) = gen_real(&seed);
            }
            CELL(M, N, N - 1, i) = CELL(M, N, i, 0);
        }
        CELL(M, N, N - 1, N - 1) = M[0];
        gen_matrix_t A = beside(M, N, N);
        gen_reals(z, N, gen_bits(&seed));
        SL_CHECK(sl_csc_multiply(&A.view, SL_AS_SYMMETRIC, b, N, z, N, 1));
        SL_CHECK(turn % 2 ? sl_symbolic_create_pivoted(&S, &A.view, NULL, NULL)
                          : sl_symbolic_create(&S, &A.view, NULL, NULL));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A.view, NULL, NULL));
        opt.regularization = 1e-8;
        opt.signs = signs;
        SL_CHECK(sl_factor_create(&F, S, &A.view, &opt, &stats));
        assert_int_equal(stats.factor.regularized, 1);
        SL_CHECK(sl_factor_solve(F, x, N, b, N, 1, NULL));
        SL_CHECK(sl_factor_refine(F, &A.view, x, N, b, N, 1, 20, NULL, &stats));
        assert_true(worst_backward(&A.view, x, N, b, N, 1) < 1e-14);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&A);
    }
}

/* ---- the inertia ---- */

/* A definite grid whose weights spread over many digits: no pivot is negative, in float neither. */
static void the_inertia_of_definite_matrices_has_no_negative_pivot(void **state) {
    (void)state;
    const isa_list_t isas = isas_with_storages();
    uint64_t seed = 11;
    int solved = 0;
    for (int turn = 0; turn < 6000; turn++) {
        enum { N = 25 };
        double M[N * N] = {0.0};
        sl_options opt = options_none();
        sl_stats stats;
        system_grid(M, N, 16.0 * fabs(gen_real(&seed)), &seed);
        for (sl_int i = 0; i < N; i++) {
            CELL(M, N, i, i) += system_scale(&seed, -15.0, 0.0);
        }
        gen_matrix_t A = beside(M, N, N);
        opt.isa = isas.isa[turn % isas.count];
        opt.storage = turn % 4 == 0 ? SL_STORAGE_DOUBLE : SL_STORAGE_FLOAT_FRONTS;
        const sl_status status = factor_and_solve(&A, &opt, &stats);
        if (status == SL_OK) {
            assert_int_equal(stats.factor.negative, 0);
            solved++;
        } else {
            SL_EXPECT(SL_ERR_PIVOT, status);
        }
        gen_matrix_free(&A);
    }
    assert_true(solved > 5000);
}

/* ---- what a refusal says ---- */

static void a_refusal_says_what_helps(void **state) {
    (void)state;
    static const double indefinite[4] = {0.0, 0.0, 1.0, 1.0};
    static const double grows[4] = {1e-17, 0.0, 1.0, 0.0};
    static const double negative[4] = {1.0, 0.0, 1.0, 1.0 - 1e-9};
    sl_options opt = options_none();
    sl_stats stats;
    gen_matrix_t A = beside(indefinite, 2, 2), B = beside(grows, 2, 2), C = beside(negative, 2, 2);
    opt.ordering = SL_ORDERING_NATURAL;
    SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&A, &opt, &stats));
    assert_true(strstr(stats.error.what, "sl_symbolic_create_pivoted") != NULL);
    SL_EXPECT(SL_ERR_INACCURATE, factor_and_solve(&B, &opt, &stats));
    assert_true(strstr(stats.error.what, "sl_symbolic_create_pivoted") != NULL);
    /* a tolerance that takes a right pivot for null */
    opt.null_tolerance = 1e-6;
    SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&C, &opt, &stats));
    assert_true(strstr(stats.error.what, "null_tolerance") != NULL);
    assert_true(stats.null_bound > 1e-6 && stats.null_bound < 3e-6);
    /* a pivot that is negative beyond rounding in a matrix that should be semidefinite */
    opt.null_tolerance = 0.0;
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    SL_EXPECT(SL_ERR_PIVOT, factor_and_solve(&C, &opt, &stats));
    assert_true(strstr(stats.error.what, "wrong sign") != NULL);
    assert_true(stats.error.value < 0.0 && stats.null_bound > 0.0 && stats.null_bound < 1e-12);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
    gen_matrix_free(&C);
}

/* Pivots of a singular matrix, chosen by its values. */
static void a_refusal_of_chosen_pivots_names_the_tolerance(void **state) {
    (void)state;
    static const double M[9] = {1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0};
    gen_matrix_t A = beside(M, 3, 3);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A.view, NULL, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A.view, NULL, &stats));
    assert_true(strstr(stats.error.what, "null_tolerance") != NULL);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
}

/* Where null pivots are skipped, an entry that is not finite changes components, signs and null
 * vectors; it is named itself. */
static void an_entry_that_is_not_finite_is_named_where_pivots_are_skipped(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    static const double bad[3] = {NAN, INFINITY, -INFINITY};
    uint64_t seed = 5;
    for (int turn = 0; turn < 600; turn++) {
        sl_options opt = options_none();
        const sl_int n = 2 + gen_below(&seed, 12);
        gen_matrix_t A = graph(n, turn % 5, 1.0, &seed);
        double *Z = test_reals(2 * (size_t)n);
        sl_stats stats;
        const sl_int at = gen_below(&seed, A.p[n]);
        for (sl_int k = 0; k < A.p[n]; k++) {
            A.x[k] *= turn % 2 ? -1.0 : 1.0;
        }
        if (turn % 3 == 0) {
            A.x[A.p[n] - 1] = 0.0; /* a diagonal entry */
        }
        A.x[at] = bad[turn % 3];
        for (sl_int i = 0; i < n; i++) {
            Z[i] = 1.0;
            Z[n + i] = i;
        }
        options_set_variant(&opt, &variants, turn % variants.count);
        opt.null_pivots = SL_NULL_PIVOT_SKIP;
        opt.null_vector = Z;
        opt.null_vector_count = 1 + (size_t)(turn / 4 % 2);
        SL_EXPECT(SL_ERR_NOT_FINITE, factor_and_solve(&A, &opt, &stats));
        assert_true(!(fabs(stats.error.value) <= DBL_MAX));
        if (stats.error.column >= 0) {
            assert_int_equal(stats.error.row, A.i[at]);
            assert_in_range(at, A.p[stats.error.column], A.p[stats.error.column + 1] - 1);
        }
        gen_matrix_free(&A);
        free(Z);
    }
}

/* The same of a sum, whose entries are in the order of the analysis. */
static void an_entry_of_a_sum_that_is_not_finite_is_named(void **state) {
    (void)state;
    static const double M[9] = {1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, INFINITY};
    const double *values[1];
    const double one[1] = {1.0};
    gen_matrix_t A = beside(M, 3, 3);
    double *v = test_reals(8);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_options opt = options_none();
    sl_stats stats;
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    A.x[2] = 0.0;
    values[0] = v;
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_symbolic_scatter(S, v, &A.view, NULL));
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_batch_factor(&F, 1, S, one, values, 1, &opt, NULL, &stats));
    assert_true(stats.error.row == 2 && stats.error.column == 2);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    free(v);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stiff_smoother_is_kept),
        cmocka_unit_test(without_memory_a_small_pivot_is_refused),
        cmocka_unit_test(factors_of_a_batch_are_judged),
        cmocka_unit_test(explicit_zeros_do_not_hide_a_last_pivot),
        cmocka_unit_test(pivots_after_a_pair_are_judged),
        cmocka_unit_test(rows_that_nothing_joins_do_not_decide),
        cmocka_unit_test(what_long_double_solves_is_not_refused),
        cmocka_unit_test(every_way_judges_alike),
        cmocka_unit_test(a_restriction_and_an_update_judge_by_their_rows),
        cmocka_unit_test(singular_laplacians_are_refused),
        cmocka_unit_test(a_pivot_after_a_lost_one_is_refused),
        cmocka_unit_test(a_failure_after_a_small_pivot_is_that_of_the_pivot),
        cmocka_unit_test(judgements_end),
        cmocka_unit_test(consistent_indefinite_systems_are_solved_by_regularization),
        cmocka_unit_test(the_inertia_of_definite_matrices_has_no_negative_pivot),
        cmocka_unit_test(a_refusal_says_what_helps),
        cmocka_unit_test(a_refusal_of_chosen_pivots_names_the_tolerance),
        cmocka_unit_test(an_entry_that_is_not_finite_is_named_where_pivots_are_skipped),
        cmocka_unit_test(an_entry_of_a_sum_that_is_not_finite_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
