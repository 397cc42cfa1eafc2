/* test_null_judge.c: small pivots that are right are kept, by every way to numbers */
#include "tests/lib/parallel_for.h"
#include "tests/lib/small_pivots.h"

static const sl_ordering orders[3] = {SL_ORDERING_ND, SL_ORDERING_NATURAL, SL_ORDERING_MINDEG};

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
            assert_true(stats.factor.null_bound >= fabs(stats.error.value));
        }
    }
    gen_matrix_free(&M);
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
            assert_true(status == SL_OK || stats.factor.null_bound == 0.0);
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
    SL_CHECK(sl_factor_create_sums(F, COUNT, S, c, values, 1, FOR_FACTOR(&opt), NULL, NULL));
    SL_CHECK(sl_factor_refactor_sums(F, COUNT, c, values, 1, NULL, NULL, NULL));
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
        assert_true(k == 0 || strstr(stats.error.what, "singular to working precision") != NULL);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&A);
    }
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
    SL_CHECK(sl_factor_change_entries(G, &A.view, NULL, column, NULL, 1, NULL, NULL));
    assert_same_bits(F, G);
    sl_factor_free(G);
    SL_CHECK(sl_factor_submatrix(&T, &G, F, &A.view, same, n, NULL, NULL));
    sl_factor_free(G);
    sl_symbolic_free(T);
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_edit(&G, F, S, &B.view, same, NULL, &stats));
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            A.x[p] = B.x[p];
        }
    }
    SL_EXPECT(SL_ERR_PIVOT,
              sl_factor_change_entries(F, &A.view, NULL, same, NULL, n, NULL, &stats));
    SL_EXPECT(SL_ERR_STALE,
              sl_factor_change_entries(F, &A.view, NULL, column, NULL, 1, NULL, &stats));
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
        SL_CHECK(sl_factor_submatrix(&T, &G, F, &A.view, rows, 3, NULL, NULL));
        SL_CHECK(sl_factor_rank_update(F, &V, sigma, NULL, NULL));
        sl_factor_free(G);
        sl_symbolic_free(T);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    gen_matrix_free(&A);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stiff_smoother_is_kept),
        cmocka_unit_test(without_memory_a_small_pivot_is_refused),
        cmocka_unit_test(factors_of_a_batch_are_judged),
        cmocka_unit_test(explicit_zeros_do_not_hide_a_last_pivot),
        cmocka_unit_test(pivots_after_a_pair_are_judged),
        cmocka_unit_test(every_way_judges_alike),
        cmocka_unit_test(a_restriction_and_an_update_judge_by_their_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
