/* test_pins_refused.c: pins that cannot be eliminated, or only just; memory that ends in between */
#include "tests/lib/pinned.h"

/* Each allocation of sl_pins_refactor fails once after the factor has changed: solves are refused
 * until it succeeds. */
static void failing_allocations_refuse_solves(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    pinned_t p = pinned_make(GEN_GRID2, 100, 1, NULL);
    sl_int rows[48];
    double x[100] = {0.0};
    sl_status status = SL_ERR_MEMORY;
    sl_stats stats;
    sl_pins_free(p.P);
    SL_CHECK(sl_pins_create(&p.P, p.y.F, &opt));
    SL_CHECK(sl_pins_refactor(p.P, &p.y.M.view, NULL));
    for (sl_int k = 0; k < 48; k++) {
        rows[k] = 2 * k;
    }
    pin_rows(&p, rows, 48, &stats);
    assert_int_equal(stats.pins.eliminated, 48);
    SL_CHECK(sl_factor_refactor(p.y.F, &p.y.M.view, NULL));
    for (int m = 0; status != SL_OK; m++) {
        SL_EXPECT(SL_ERR_STALE, sl_pins_solve(p.P, NULL, x, 100, x, 100, x, 100, 1, NULL));
        counter.fail_at = (int64_t)counter.calls + m;
        status = sl_pins_refactor(p.P, &p.y.M.view, &stats);
        assert_true(status == SL_ERR_MEMORY || (status == SL_OK && m > 5));
        counter.fail_at = -1;
    }
    assert_int_equal(stats.pins.eliminated, 48);
    assert_pinned(&p, 2);
    pinned_free(&p);
    COUNTER_CLEAN(&counter);
}

/* Two equalities that differ little: with one of their rows held, they are the same to rounding.
 * Elimination refuses that, and so does the other way, or it finds a pivot of rounding errors. */
static void nearly_dependent_pins_are_not_eliminated(void **state) {
    (void)state;
    int refused = 0, taken = 0;
    for (int k = 0; k < 40; k++) {
        pinned_t p = pinned_make(GEN_GRID2, 100, 1, NULL);
        const sl_csc *A = &p.y.M.view;
        const sl_int both[2] = {12, 57};
        const double one[2] = {1.0, 1.0}, other[2] = {1.0, 1.0 + 1e-6 * (k + 1)};
        sl_int rows[60], others[60], count = 0, n_others = 0;
        sl_stats stats;
        sl_status status;
        for (sl_int i = 0; i < 100; i++) {
            if (i % 5 < 3 && i != both[1]) {
                rows[count++] = i;
            }
            if (i % 5 > 1 && i != both[0] && i != both[1]) {
                others[n_others++] = i;
            }
        }
        SL_CHECK(sl_pins_refactor(p.P, A, NULL));
        SL_CHECK(sl_pins_add_equality(p.P, both, one, 2, NULL));
        SL_CHECK(sl_pins_add_equality(p.P, both, other, 2, NULL));
        status = sl_pins_add(p.P, rows, count, &stats);
        if (status == SL_OK) {
            assert_int_equal(stats.pins.reason, SL_PINS_REFUSED);
            SL_CHECK(pin_row(p.P, 98, &stats)); /* elimination is not tried again */
            assert_int_equal(stats.pins.reason, SL_PINS_REFUSED);
            SL_CHECK(sl_factor_refactor(p.y.F, A, NULL));
            SL_CHECK(sl_pins_refactor(p.P, A, &stats));
            assert_int_equal(stats.pins.reason, SL_PINS_REFUSED);
            assert_int_equal(stats.pins.eliminated, 0);
            assert_int_equal(pins_count(p.P), count + 3);
            taken++;
        } else { /* the set is as it was: other rows are eliminated */
            assert_int_equal(status, SL_ERR_PIVOT);
            assert_int_equal(pins_count(p.P), 2);
            SL_CHECK(sl_pins_add(p.P, others, n_others, &stats));
            assert_int_equal(stats.pins.reason, SL_PINS_CHEAPEST);
            assert_int_equal(stats.pins.eliminated, n_others);
            refused++;
        }
        pinned_free(&p);
    }
    print_message("%d sets refused, %d taken\n", refused, taken);
    assert_true(refused > 0 && taken > 0);
}

/* Numbers with which elimination and capacitance refuse an equality: its null vector is unknown. */
static void a_null_vector_may_be_lost(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
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
    sl_pins *P;
    const sl_int ends[2] = {260, 450};
    const double values[2] = {1.0, 0.5};
    sl_int rows[240];
    sl_stats stats;
    for (sl_int k = 0; k < 240; k++) {
        rows[k] = k;
    }
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A.view, &opt, NULL));
    SL_CHECK(sl_pins_create(&P, F, NULL));
    SL_CHECK(sl_pins_refactor(P, &A.view, NULL));
    SL_CHECK(sl_pins_add_equality(P, ends, values, 2, NULL));
    SL_CHECK(sl_pins_add(P, rows, 240, &stats));
    assert_int_equal(stats.pins.eliminated, 240);
    SL_CHECK(sl_factor_refactor(F, &B.view, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_pins_refactor(P, &B.view, &stats));
    SL_CHECK(sl_factor_refactor(F, &A.view, NULL));
    SL_CHECK(sl_pins_refactor(P, &A.view, &stats));
    assert_int_equal(stats.pins.eliminated, 240);
    sl_pins_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
    gen_list_free(&t);
    gen_list_free(&u);
}

/* A set with a matrix whose rows cannot be eliminated: it says so, and solves as before. */
static void assert_unsuited(const sl_symbolic *S, const sl_csc *A, const sl_options *opt) {
    const size_t n = (size_t)A->n_cols;
    double *x = test_reals(n), *b = test_reals(n), g[2] = {2.0, -3.0};
    sl_factor *F;
    sl_pins *P;
    sl_stats stats;
    SL_CHECK(sl_factor_create(&F, S, A, opt, NULL));
    SL_CHECK(sl_pins_create(&P, F, NULL));
    SL_CHECK(sl_pins_refactor(P, A, &stats));
    assert_int_equal(stats.pins.reason, SL_PINS_UNSUITED);
    SL_CHECK(pin_row(P, 7, NULL));
    SL_CHECK(sl_factor_refactor(F, A, NULL));
    SL_CHECK(sl_pins_refactor(P, A, &stats));
    assert_int_equal(stats.pins.reason, SL_PINS_UNSUITED);
    SL_CHECK(pin_row(P, 30, &stats));
    assert_int_equal(stats.pins.method, SL_PINS_CAPACITANCE);
    SL_CHECK(sl_pins_solve(P, NULL, x, n, b, n, g, 2, 1, NULL));
    assert_true(fabs(x[7] - g[0]) <= 1e-9 && fabs(x[30] - g[1]) <= 1e-9);
    sl_pins_free(P);
    sl_factor_free(F);
    free(x);
    free(b);
}

static void some_factors_are_unsuited(void **state) {
    (void)state;
    double vectors[2 * 100];
    sl_options opt = options_none();
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    opt.regularization = 1e-10;
    assert_unsuited(y.S, &y.M.view, &opt);
    factored_free(&y);
    gen_matrix_t M = gen_matrix(GEN_SINGULAR, 100, 1, 42);
    sl_symbolic *S;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    opt = options_none();
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    opt.null_vector = vectors;
    opt.null_vector_count = 2; /* one of them holds */
    for (int k = 0; k < 100; k++) {
        vectors[k] = 1.0;
        vectors[100 + k] = k;
    }
    assert_unsuited(S, &M.view, &opt);
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
    assert_unsuited(S, &A, &opt);
    sl_symbolic_free(S);
    sl_matrix_free(real);
    free(values);
    gen_matrix_free(&M);
}

/* Solutions with many rows eliminated, of a factor in float, without a limit of growth, and of a
 * matrix with zeros among its entries. A matrix that is not a number is refused. */
static void every_suited_factor_is_eliminated(void **state) {
    (void)state;
    enum { M = 400, HELD = 150 };
    for (int way = 0; way < 3; way++) {
        gen_list_t t = gen_make(GEN_GRID2, M, 1, 42);
        sl_options opt = options_none();
        sl_int rows[HELD];
        double *values, B[M], X[M], Y[M], r[M], largest = 0.0;
        sl_pins *P;
        sl_stats stats;
        opt.storage = way == 0 ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
        opt.growth_limit = way == 1 ? -1.0 : 0.0;
        for (sl_int k = 0; k + 2 < M && way == 2; k++) {
            gen_add(&t, k + 2, k, 0.0);
        }
        factored_t y = {gen_store(&t, gen_style(0), 1), NULL, NULL};
        sl_csc A = y.M.view;
        SL_CHECK(sl_symbolic_create(&y.S, &A, NULL, NULL));
        SL_CHECK(sl_factor_create(&y.F, y.S, &A, &opt, NULL));
        SL_CHECK(sl_pins_create(&P, y.F, NULL));
        values = test_reals((size_t)A.p[M]);
        memcpy(values, A.x, (size_t)A.p[M] * sizeof *values);
        values[A.p[M / 2]] = (double)NAN;
        A.x = values;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_pins_refactor(P, &A, &stats));
        assert_true(isnan(stats.error.value));
        A.x = y.M.x;
        SL_CHECK(sl_pins_refactor(P, &A, NULL));
        for (sl_int k = 0; k < HELD; k++) {
            rows[k] = k;
        }
        gen_reals(B, M, 3);
        gen_reals(Y, M, 4);
        SL_CHECK(sl_pins_add(P, rows, HELD, &stats));
        assert_int_equal(stats.pins.eliminated, HELD);
        for (sl_int held = HELD; held > HELD - 3; held--) {
            SL_CHECK(sl_pins_solve(P, NULL, X, M, B, M, Y, M, 1, NULL));
            SL_CHECK(sl_csc_residual(&A, r, M, NULL, X, M, B, M, 1));
            for (int k = 0; k < M; k++) {
                largest = fmax(largest, fabs(X[k]));
            }
            for (int k = 0; k < M; k++) {
                assert_true(k < held ? X[k] == Y[k]
                                     : fabs(r[k]) <= (way == 0 ? 1e-4 : 1e-11) * (1.0 + largest));
            }
            SL_CHECK(unpin(P, held - 1));
        }
        sl_pins_free(P);
        gen_list_free(&t);
        factored_free(&y);
        free(values);
    }
}

/* A singular matrix whose rows are eliminated: few of them change, in the reach of those. */
static void held_rows_of_a_singular_matrix_change(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    opt.method = SL_METHOD_SUPERNODAL;
    pinned_t p = pinned_make(GEN_SINGULAR, 400, 1, &opt);
    sl_int rows[200];
    sl_stats stats;
    SL_CHECK(sl_pins_refactor(p.P, &p.y.M.view, NULL));
    for (sl_int k = 0; k < 200; k++) {
        rows[k] = 2 * k;
    }
    pin_rows(&p, rows, 200, &stats);
    assert_int_equal(stats.pins.eliminated, 200);
    assert_pinned(&p, 1);
    for (int k = 0; k < 2; k++) {
        release(&p, 50);
        assert_pinned(&p, 2);
    }
    pinned_free(&p);
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
    SL_EXPECT(SL_ERR_PIVOT, sl_pins_add(p.P, rows, 20, &stats));
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
        cmocka_unit_test(nearly_dependent_pins_are_not_eliminated),
        cmocka_unit_test(a_null_vector_may_be_lost),
        cmocka_unit_test(some_factors_are_unsuited),
        cmocka_unit_test(every_suited_factor_is_eliminated),
        cmocka_unit_test(held_rows_of_a_singular_matrix_change),
        cmocka_unit_test(a_row_twice_among_many_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
