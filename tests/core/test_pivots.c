/* test_pivots.c: 1x1 and 2x2 pivots chosen by values: indefinite systems, zeros on the diagonal */
#include "tests/lib/parallel_for.h"
#include "tests/lib/pivoted.h"

static const sl_int sizes[4] = {6, 20, 57, 90};

static void indefinite_systems_are_solved(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int kind = 0; kind < SYSTEM_KINDS; kind++) {
        for (int size = 0; size < 4; size++) {
            sl_int n = sizes[size];
            gen_matrix_t M = system_make((system_kind_t)kind, n, kind + 3 * size, 5);
            double *dense = ref_dense(&M.view), *V = test_reals((size_t)n * (size_t)n), log_det = 0;
            const double condition = ref_condition(n, dense);
            sl_int negative = 0;
            sl_symbolic *S = NULL;
            sl_stats stats;
            eigen_all(dense, V, n);
            for (sl_int k = 0; k < n; k++) {
                negative += AT(dense, k, k) < 0.0;
                log_det += log(fabs(AT(dense, k, k)));
            }
            assert_true(condition < 1e10);
            SL_CHECK(sl_symbolic_create_pivoted(&S, &M.view, NULL, &stats));
            NOTHING_WRONG(check_pairs(S, stats.symbolic.pairs));
            assert_true(kind == SYSTEM_RANDOM || kind == SYSTEM_SHIFTED || n < 20 ||
                        stats.symbolic.pairs > 0);
            for (int k = 0; k < isas.count; k++) {
                sl_options opt = options_none();
                sl_factor *F = NULL;
                double rcond, log_abs, sign;
                opt.isa = isas.isa[k];
                SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
                assert_int_equal(stats.factor.negative, negative);
                assert_int_equal(stats.factor.positive, n - negative);
                assert_true(stats.factor.pivot_min > 0.0);
                NOTHING_WRONG(check_blocks(F, &M.view));
                check_solves(F, &M.view);
                check_local(S, F, n);
                SL_CHECK(sl_factor_logdet(F, &log_abs, &sign));
                assert_true(fabs(log_abs - log_det) <= 1e-14 * condition * n);
                assert_true(sign == (negative % 2 ? -1.0 : 1.0));
                SL_CHECK(sl_factor_rcond(F, &M.view, &rcond, NULL));
                assert_true(rcond >= 0.99 / condition && rcond <= 10.0 / condition);
                sl_factor_free(F);
            }
            sl_symbolic_free(S);
            gen_matrix_free(&M);
            free(dense);
            free(V);
        }
    }
}

/* [s 0 1; 0 d 1; 1 1 0]: pivots for s = 0 lose d beside s = 1e19. Growth is small, refinement
 * measures the error and removes it, and so does another analysis. */
static void kept_pivots_may_lose_small_rows(void **state) {
    (void)state;
    const sl_int p[4] = {0, 2, 4, 5}, i[5] = {0, 2, 1, 2, 2};
    const double before[5] = {0, 1, 0.5, 1, 0}, after[5] = {1e19, 1, 1, 1, 0}, b[3] = {1, 2, 3};
    const sl_csc first = {3, 3, p, i, before}, next = {3, 3, p, i, after};
    sl_options opt = options_none();
    opt.purpose = SL_PURPOSE_ONE_FACTOR;
    for (int is_new = 0; is_new < 2; is_new++) {
        double x[3];
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        SL_CHECK(sl_symbolic_create_pivoted(&S, is_new ? &next : &first, &opt, &stats));
        assert_int_equal(stats.symbolic.pairs, 1);
        SL_CHECK(sl_factor_create(&F, S, is_new ? &next : &first, NULL, &stats));
        SL_CHECK(sl_factor_refactor(F, &next, &stats));
        assert_true(stats.factor.growth < 10.0);
        SL_CHECK(sl_factor_solve(F, x, 3, b, 3, 1, NULL));
        SL_CHECK(sl_factor_refine(F, &next, x, 3, b, 3, 1, 0, NULL, &stats));
        assert_true(is_new ? stats.refine.backward_error < 1e-14
                           : stats.refine.backward_error > 0.1);
        SL_CHECK(sl_factor_refine(F, &next, x, 3, b, 3, 1, 3, NULL, &stats));
        assert_true(stats.refine.backward_error < 1e-14);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* Without pivoting the first is refused and the second gives x = (0, 1) instead of (1, 1). */
static void smallest_matrices_are_exact(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double values[3][3] = {{0, 1, 0}, {1e-20, 1, 1}, {1e-300, 1e-300, 0}};
    for (int which = 0; which < 3; which++) {
        const sl_csc A = {2, 2, p, i, values[which]};
        const double b[2] = {values[which][0] + values[which][1],
                             values[which][1] + values[which][2]};
        double x[2];
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, &stats));
        SL_CHECK(sl_factor_create(&F, S, &A, NULL, &stats));
        assert_int_equal(stats.factor.positive, 1);
        assert_int_equal(stats.factor.negative, 1);
        SL_CHECK(sl_factor_solve(F, x, 2, b, 2, 1, NULL));
        assert_true(fabs(x[0] - 1.0) <= 4 * DBL_EPSILON && fabs(x[1] - 1.0) <= 4 * DBL_EPSILON);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    const sl_csc empty = {0, 0, p, NULL, NULL};
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &empty, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &empty, NULL, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A definite matrix needs no pairs, and keeps the order that it was analyzed in. */
static void definite_matrices_have_no_pairs(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 400, 1, 3);
    sl_symbolic *S = NULL, *plain = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &M.view, NULL, &stats));
    assert_int_equal(stats.symbolic.pairs, 0);
    assert_int_equal(stats.symbolic.delayed, 0);
    SL_CHECK(sl_symbolic_create(&plain, &M.view, NULL, NULL));
    sl_symbolic_arrays v = sl_symbolic_view(S), w = sl_symbolic_view(plain);
    assert_null(v.pairs);
    assert_memory_equal(v.perm, w.perm, 400 * sizeof(sl_int));
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&G, plain, &M.view, NULL, NULL));
    assert_null(sl_factor_view(F).E);
    assert_same_bits(F, G);
    sl_factor_free(F);
    sl_factor_free(G);
    sl_symbolic_free(S);
    sl_symbolic_free(plain);
    gen_matrix_free(&M);
}

/* The bits are those of one thread, with any number of threads and by any way to the values. */
static void factors_have_the_same_bits(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int kind = SYSTEM_KKT; kind < SYSTEM_KINDS; kind++) {
        gen_matrix_t M = system_make((system_kind_t)kind, 3000, 0, 11);
        size_t nnz = (size_t)M.p[3000];
        double *other = test_reals(nnz);
        for (size_t k = 0; k < nnz; k++) {
            other[k] = M.x[k] * (1.0 + 1e-3 * sin((double)k));
        }
        const sl_csc A = {3000, 3000, M.p, M.i, other};
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create_pivoted(&S, &M.view, NULL, NULL));
        for (int k = 0; k < isas.count; k++) {
            sl_options opt = options_none();
            sl_factor *F = NULL, *G = NULL;
            sl_stats stats;
            sl_int column = 17;
            int calls = 0;
            opt.isa = isas.isa[k];
            opt.method = SL_METHOD_UP_LOOKING; /* ignored */
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
            assert_int_equal(stats.factor.method, SL_METHOD_SUPERNODAL);
            opt.threads.count = 3;
            opt.threads.run = run_backwards;
            opt.threads.context = &calls;
            SL_CHECK(sl_factor_create(&G, S, &A, &opt, NULL));
            check_solves(G, &A);
            SL_CHECK(sl_factor_refactor(F, &A, NULL));
            assert_same_bits(F, G);
            assert_memory_equal(sl_factor_view(F).E, sl_factor_view(G).E, 3000 * sizeof(double));
            SL_CHECK(sl_factor_refactor(F, &M.view, NULL));
            SL_CHECK(sl_factor_refactor(G, &M.view, NULL));
            assert_same_bits(F, G);
            for (sl_int p = M.p[column]; p < M.p[column + 1]; p++) {
                M.x[p] *= 1.01;
            }
            SL_CHECK(sl_factor_change_entries(F, &M.view, NULL, &column, NULL, 1, NULL, NULL));
            check_solves(F, &M.view);
            sl_factor_free(F);
            sl_factor_free(G);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(other);
    }
}

/* [H B'; B 0] where the last constraint repeats the first: refused with a row, or regularized. */
static void singular_systems_are_refused_or_regularized(void **state) {
    (void)state;
    gen_list_t t = system_list(SYSTEM_KKT_HOLLOW, 60, 3);
    gen_list_t wider = gen_list(61);
    for (size_t k = 0; k < t.count; k++) {
        gen_add(&wider, t.row[k], t.col[k], t.x[k]);
        if (t.row[k] == 59) {
            gen_add(&wider, 60, t.col[k], t.x[k]);
        }
    }
    gen_matrix_t M = gen_store(&wider, gen_style(0), 1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    sl_options opt = options_none();
    SL_CHECK(sl_symbolic_create_pivoted(&S, &M.view, NULL, &stats));
    assert_true(stats.symbolic.pairs > 0);
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, NULL, &stats));
    assert_true(stats.error.row >= 0 && stats.error.row < 61);
    opt.regularization = 1e-8;
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
    assert_true(stats.factor.regularized >= 1 && stats.factor.regularized <= 2);
    sl_int rows[2], count;
    double shifts[2], b[61], x[61], z[61];
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, rows, shifts, 2, &count));
    assert_int_equal(count, stats.factor.regularized);
    for (sl_int k = 0; k < 61; k++) {
        z[k] = k % 7 - 3;
    }
    SL_CHECK(sl_csc_multiply(&M.view, SL_AS_SYMMETRIC, b, 61, z, 61, 1));
    SL_CHECK(sl_factor_solve(F, x, 61, b, 61, 1, NULL));
    SL_CHECK(sl_factor_refine(F, &M.view, x, 61, b, 61, 1, 20, NULL, &stats));
    assert_true(stats.refine.backward_error <= 1e-14);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    gen_list_free(&wider);
}

/* Values that make a pair null: the block is refused, or shifted in both rows. */
static void null_pairs_are_refused_or_regularized(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double hollow[3] = {0, 1, 0};
    static const double bad[4][3] = {{1, 1, 1}, {-2, 1, -0.5}, {0, 0, 0}, {0, 0, 5}};
    sl_csc A = {2, 2, p, i, hollow};
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, NULL));
    assert_non_null(sl_symbolic_view(S).pairs);
    for (int which = 0; which < 4; which++) {
        sl_factor *F = NULL;
        sl_options opt = options_none();
        sl_stats stats;
        sl_int rows[2], count;
        double shifts[2], x[2], b[2] = {1, 2};
        A.x = bad[which];
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A, NULL, &stats));
        assert_true(stats.error.row == 0 || stats.error.row == 1);
        opt.regularization = 0.25;
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
        SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, rows, shifts, 2, &count));
        assert_int_equal(count, 2);
        SL_CHECK(sl_factor_solve(F, x, 2, b, 2, 1, NULL));
        double shifted[3] = {bad[which][0], bad[which][1], bad[which][2]};
        for (int m = 0; m < 2; m++) {
            assert_true(shifts[m] != 0.0);
            shifted[2 * rows[m]] += shifts[m];
        }
        assert_true(fabs(shifted[0] * x[0] + shifted[1] * x[1] - b[0]) <= 1e-14);
        assert_true(fabs(shifted[1] * x[0] + shifted[2] * x[1] - b[1]) <= 1e-14);
        sl_factor_free(F);
    }
    const double not_finite[3] = {0, 1e308, 0}, nan[3] = {0, NAN, 0};
    sl_factor *F = NULL;
    sl_stats stats;
    A.x = not_finite;
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    A.x = nan;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(F, &A, &stats));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* What needs a diagonal D says so. The rest works: batches, sums, L as a matrix. */
static void other_calls_work_or_are_refused(void **state) {
    (void)state;
    gen_matrix_t M = system_make(SYSTEM_KKT, 90, 0, 2);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_selected *Z = NULL;
    sl_region *R = NULL;
    sl_options opt = options_none();
    sl_matrix *L = NULL;
    sl_int rows[2] = {1, 5};
    double out[4], b[90], x[90], y[90];
    SL_CHECK(sl_symbolic_create_pivoted(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_region_create(&R, F, rows, 2, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_inverse_diagonal(F, out, rows, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_inverse_pairs(F, out, rows, rows, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_inverse_block(F, out, 2, rows, 2, rows, 2, NULL, NULL));
    assert_null(Z);
    assert_null(R);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_create(&G, S, &M.view, &opt, NULL));
    assert_null(G);
    SL_CHECK(sl_factor_lower(&L, F, NULL));
    sl_matrix_free(L);
    gen_reals(b, 90, 1);
    SL_CHECK(sl_factor_solve(F, x, 90, b, 90, 1, NULL));
    SL_CHECK(sl_factor_solve(F, y, SL_ROWS(1), b, SL_ROWS(1), 1, NULL));
    SAME_VALUES(x, y, 90);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

static void bad_arguments_are_refused(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1}, far[3] = {0, 9, 1};
    double x[3] = {1, 2, 3};
    sl_csc A = {2, 2, p, i, x};
    sl_options opt = options_none();
    sl_stats stats;
    sl_symbolic *S = (sl_symbolic *)(void *)x;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create_pivoted(NULL, &A, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create_pivoted(&S, NULL, NULL, NULL));
    assert_null(S);
    A.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create_pivoted(&S, &A, NULL, NULL));
    A.x = x;
    A.i = far;
    SL_EXPECT(SL_ERR_MALFORMED, sl_symbolic_create_pivoted(&S, &A, NULL, &stats));
    A.i = i;
    A.n_rows = 3;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create_pivoted(&S, &A, NULL, NULL));
    A.n_rows = 2;
    opt.relaxation = (sl_relaxation)7;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create_pivoted(&S, &A, &opt, NULL));
    static const double bad[3] = {NAN, INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) {
        x[1] = bad[k];
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_symbolic_create_pivoted(&S, &A, NULL, &stats));
        assert_int_equal(stats.error.row, 1);
        assert_int_equal(stats.error.column, 0);
    }
    assert_null(S);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    gen_matrix_t M = system_make(SYSTEM_KKT_HOLLOW, 300, 0, 4);
    for (int64_t fail_at = 0;; fail_at++) {
        counter_t c = counter_make();
        sl_options opt = options_counted(&c);
        sl_symbolic *S = NULL;
        c.fail_at = fail_at;
        sl_status status = sl_symbolic_create_pivoted(&S, &M.view, &opt, NULL);
        assert_true((S != NULL) == (status == SL_OK));
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        sl_symbolic_free(S);
        COUNTER_CLEAN(&c);
        if (status == SL_OK) {
            assert_true(fail_at > 20);
            break;
        }
    }
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(indefinite_systems_are_solved),
        cmocka_unit_test(smallest_matrices_are_exact),
        cmocka_unit_test(kept_pivots_may_lose_small_rows),
        cmocka_unit_test(definite_matrices_have_no_pairs),
        cmocka_unit_test(factors_have_the_same_bits),
        cmocka_unit_test(singular_systems_are_refused_or_regularized),
        cmocka_unit_test(null_pairs_are_refused_or_regularized),
        cmocka_unit_test(other_calls_work_or_are_refused),
        cmocka_unit_test(bad_arguments_are_refused),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
