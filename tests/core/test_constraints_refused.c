/* test_constraints_refused.c: pins that are refused, memory that ends, factors of other kinds */
#include "tests/lib/constrained.h"

/* Each allocation of sl_constraints_refactor fails once after the factor has changed: solves are
 * refused until it succeeds. */
static void failing_allocations_refuse_solves(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    pinned_t p = pinned_make(GEN_GRID2, 100, 1, NULL);
    sl_int rows[48];
    double x[100] = {0.0};
    sl_status status = SL_ERR_MEMORY;
    sl_stats stats;
    sl_constraints_free(p.P);
    SL_CHECK(sl_constraints_create(&p.P, p.y.F, &opt));
    for (sl_int k = 0; k < 48; k++) {
        rows[k] = 2 * k;
    }
    pin_rows(&p, rows, 48, &stats);
    SL_CHECK(sl_factor_refactor(p.y.F, &p.y.M.view, NULL));
    for (int m = 0; status != SL_OK; m++) {
        SL_EXPECT(SL_ERR_STALE, sl_constraints_solve(p.P, NULL, x, 100, x, 100, x, 100, 1, NULL));
        counter.fail_at = (int64_t)counter.calls + m;
        status = sl_constraints_refactor(p.P, &stats);
        assert_true(status == SL_ERR_MEMORY || (status == SL_OK && m > 5));
        counter.fail_at = -1;
    }
    assert_pinned(&p, 2);
    pinned_free(&p);
    COUNTER_CLEAN(&counter);
}

/* New numbers may refuse an equality: its null vector is unknown. */
static void a_null_vector_may_be_lost(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    gen_list_t t = gen_list(500), u = gen_list(500);
    for (sl_int k = 0; k + 1 < 500; k++) { /* two paths */
        const double sign = k < 250 ? -1.0 : 1.0;
        for (sl_int m = 0; m < 2 && k != 249; m++) {
            gen_add(&t, k + m, k + m, 1.0);
            gen_add(&u, k + m, k + m, 1.0);
        }
        if (k != 249) {
            gen_add(&t, k + 1, k, -1.0);
            gen_add(&u, k + 1, k, sign);
        }
    }
    gen_matrix_t A = gen_store(&t, gen_style(0), 1), B = gen_store(&u, gen_style(0), 1);
    sl_symbolic *S;
    sl_factor *F;
    sl_constraints *P;
    const sl_int ends[2] = {260, 450};
    const double values[2] = {1.0, 0.5};
    sl_int rows[240];
    sl_stats stats;
    for (sl_int k = 0; k < 240; k++) {
        rows[k] = k;
    }
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A.view, &opt, NULL));
    SL_CHECK(sl_constraints_create(&P, F, NULL));
    SL_CHECK(sl_constraints_add(P, ends, values, 2, NULL));
    SL_CHECK(sl_constraints_add(P, rows, NULL, 240, &stats));
    SL_CHECK(sl_factor_refactor(F, &B.view, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_constraints_refactor(P, &stats));
    SL_CHECK(sl_factor_refactor(F, &A.view, NULL));
    SL_CHECK(sl_constraints_refactor(P, &stats));
    sl_constraints_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
    gen_list_free(&t);
    gen_list_free(&u);
}

/* Pins on a factor of another kind hold, before and after new numbers. */
static void assert_held(const sl_symbolic *S, const sl_csc *A, const sl_options *opt) {
    const size_t n = (size_t)A->n_cols;
    double *x = test_reals(n), *b = test_reals(n), g[2] = {2.0, -3.0};
    sl_factor *F;
    sl_constraints *P;
    SL_CHECK(sl_factor_create(&F, S, A, opt, NULL));
    SL_CHECK(sl_constraints_create(&P, F, NULL));
    SL_CHECK(pin_row(P, 7, NULL));
    SL_CHECK(sl_factor_refactor(F, A, NULL));
    SL_CHECK(sl_constraints_refactor(P, NULL));
    SL_CHECK(pin_row(P, 30, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, n, b, n, g, 2, 1, NULL));
    assert_true(fabs(x[7] - g[0]) <= 1e-9 && fabs(x[30] - g[1]) <= 1e-9);
    sl_constraints_free(P);
    sl_factor_free(F);
    free(x);
    free(b);
}

static void factors_of_other_kinds_hold(void **state) {
    (void)state;
    double vectors[2 * 100];
    sl_options opt = options_none();
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    opt.regularization = 1e-10;
    assert_held(y.S, &y.M.view, &opt);
    factored_free(&y);
    gen_matrix_t M = gen_matrix(GEN_SINGULAR, 100, 1, 42);
    sl_symbolic *S;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.null_vector = vectors;
    opt.null_vector_count = 2; /* one of them holds */
    for (int k = 0; k < 100; k++) {
        vectors[k] = 1.0;
        vectors[100 + k] = k;
    }
    assert_held(S, &M.view, &opt);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    M = gen_matrix(GEN_GRID2, 100, 1, 42);
    double *values = test_reals(2 * (size_t)M.p[100]);
    for (sl_int p = 0; p < M.p[100]; p++) {
        values[2 * p] = M.x[p];
    }
    const sl_hermitian H = {100, M.view.p, M.view.i, values, NULL};
    sl_matrix *real;
    SL_CHECK(sl_matrix_from_hermitian(&real, &H, NULL, NULL));
    const sl_csc A = sl_matrix_view(real);
    opt = options_none();
    opt.block_size = 2;
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    opt = options_none();
    opt.storage = SL_STORAGE_COMPLEX;
    assert_held(S, &A, &opt);
    sl_symbolic_free(S);
    sl_matrix_free(real);
    free(values);
    gen_matrix_free(&M);
}

/* Held rows have exactly their values, in full and in local solves, also after the set is made
 * anew; an equality holds whatever the size of its weights. */
static void held_values_are_exact(void **state) {
    (void)state;
    static const double sizes[] = {1.0, 3.0, 1e-170, 1e-300, 1e-310, 1e200};
    enum { N = 100 };
    const sl_int pins[2] = {5, 50}, apart[2] = {7, 31}, wanted[3] = {5, 50, 7};
    for (size_t m = 0; m < sizeof sizes / sizeof *sizes; m++) {
        pinned_t p = pinned_make(GEN_GRID2, N, 1, NULL);
        const double w = sizes[m], difference[2] = {w, -w}, g[3] = {1.0, 3.0, 0.1 * w};
        double x[N], local[3], b[N];
        sl_plan *plan;
        gen_reals(b, N, m);
        pin_rows(&p, pins, 2, NULL);
        SL_CHECK(sl_constraints_add(p.P, apart, difference, 2, NULL));
        SL_CHECK(sl_plan_create(&plan, p.y.S, NULL, SL_ALL, wanted, 3, NULL, NULL));
        for (int turn = 0; turn < 2; turn++) {
            SL_CHECK(sl_constraints_solve(p.P, NULL, x, N, b, N, g, 3, 1, NULL));
            SL_CHECK(sl_constraints_solve(p.P, plan, local, 3, b, N, g, 3, 1, NULL));
            assert_true(x[5] == 1.0 && x[50] == 3.0 && fabs(x[7] - x[31] - 0.1) <= 1e-12);
            assert_true(local[0] == 1.0 && local[1] == 3.0 && local[2] == x[7]);
            SL_CHECK(sl_factor_refactor(p.y.F, &p.y.M.view, NULL));
            SL_CHECK(sl_constraints_refactor(p.P, NULL));
        }
        sl_plan_free(plan);
        pinned_free(&p);
    }
}

/* A factor whose pivots were regularized is that of A + E: solves with pins would be, too. */
static void regularized_pivots_are_refused(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double a[3] = {0.0, 1.0, 2.0};
    const sl_csc A = {2, 2, p, i, a};
    sl_options opt = options_none();
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    sl_factor *F;
    sl_constraints *P;
    sl_stats stats;
    const sl_int signs[2] = {1, -1};
    opt.regularization = 1e-8;
    opt.signs = signs;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
    assert_int_equal(stats.factor.regularized, 1);
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_constraints_create(&P, F, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* A row that is named twice among many, beside pins that are there: all of them stay away. */
static void a_row_twice_among_many_is_refused(void **state) {
    (void)state;
    pinned_t p = pinned_make(GEN_GRID2, 100, 1, NULL);
    sl_int rows[20];
    sl_stats stats;
    pin(&p, 50);
    for (sl_int k = 0; k < 20; k++) {
        rows[k] = 2 * (k % 19);
    }
    SL_EXPECT(SL_ERR_PIVOT, sl_constraints_add(p.P, rows, NULL, 20, &stats));
    assert_int_equal(stats.error.row, 0);
    assert_int_equal(pins_count(p.P), 1);
    assert_pinned(&p, 3);
    pin_rows(&p, rows, 19, NULL);
    assert_pinned(&p, 4);
    pinned_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(failing_allocations_refuse_solves),
        cmocka_unit_test(a_null_vector_may_be_lost),
        cmocka_unit_test(factors_of_other_kinds_hold),
        cmocka_unit_test(held_values_are_exact),
        cmocka_unit_test(regularized_pivots_are_refused),
        cmocka_unit_test(a_row_twice_among_many_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
