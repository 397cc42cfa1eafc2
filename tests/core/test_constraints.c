/* test_constraints.c: sl_constraints: full and local solutions against dense ones, of pins that are
 * added and released */
#include "tests/lib/constrained.h"

enum { PINS = 12 };

static void pins_hold_rows_of_definite_matrices(void **state) {
    (void)state;
    static const gen_kind_t kinds[7] = {GEN_ONE,   GEN_DIAGONAL, GEN_PATH,      GEN_STAR,
                                        GEN_GRID2, GEN_GRID3,    GEN_COMPONENTS};
    isa_list_t isas = isas_present();
    uint64_t seed = 3;
    for (int kind = 0; kind < 7; kind++) {
        for (int k = 0; k < 2 * isas.count; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k / 2];
            pinned_t p = pinned_make(kinds[kind], 60, k % 2 ? 1 : -1, &opt);
            sl_int *rows = test_ints((size_t)p.n), many = p.n < PINS ? p.n : PINS;
            gen_set(rows, many, p.n, gen_bits(&seed));
            assert_pinned(&p, gen_bits(&seed)); /* no pins: a solve */
            for (sl_int m = 0; m < many; m++) {
                pin(&p, rows[m]);
            }
            assert_pinned(&p, gen_bits(&seed));
            for (sl_int m = 0; m < many / 2; m++) {
                release(&p, gen_below(&seed, p.count));
            }
            assert_pinned(&p, gen_bits(&seed));
            while (p.count > 0) {
                release(&p, p.count - 1);
            }
            assert_pinned(&p, gen_bits(&seed));
            free(rows);
            pinned_free(&p);
        }
    }
}

/* Rows of one call share sweeps; one that is given twice refuses all of them. */
static void rows_are_pinned_together(void **state) {
    (void)state;
    static const gen_kind_t kinds[6] = {GEN_DIAGONAL, GEN_STAR,       GEN_GRID2,
                                        GEN_GRID2,    GEN_COMPONENTS, GEN_SINGULAR};
    static const sl_int sizes[6] = {40, 60, 60, 289, 120, 100};
    static const sl_int counts[6] = {20, 13, 5, 150, 60, 40};
    isa_list_t isas = isas_present();
    uint64_t seed = 8;
    for (int k = 0; k < 6 * isas.count; k++) {
        const int kind = k % 6;
        sl_options opt = options_none();
        opt.isa = isas.isa[k / 6];
        opt.pivots = kind == 5 ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
        pinned_t p = pinned_make(kinds[kind], sizes[kind], k % 2 ? 1 : -1, &opt);
        sl_int count = counts[kind], *rows = test_ints((size_t)p.n);
        sl_stats stats;
        assert_true(p.n > count + 1);
        gen_set(rows, count + 2, p.n, gen_bits(&seed));
        pin(&p, rows[count]);
        pin_rows(&p, rows, count, NULL);
        assert_pinned(&p, gen_bits(&seed));
        SL_EXPECT(SL_ERR_PIVOT, sl_constraints_add(p.P, rows + count, NULL, 2, &stats));
        assert_int_equal(stats.error.row, rows[count]);
        for (sl_int m = 0; m <= count; m++) {
            release(&p, p.count - 1);
        }
        const sl_int other = rows[count - 2];
        rows[count - 2] = rows[1];
        SL_EXPECT(SL_ERR_PIVOT, sl_constraints_add(p.P, rows, NULL, count, &stats));
        assert_int_equal(stats.error.row, rows[1]);
        assert_int_equal(pins_count(p.P), 0);
        rows[count - 2] = other;
        pin_rows(&p, rows, count, NULL);
        assert_pinned(&p, gen_bits(&seed));
        free(rows);
        pinned_free(&p);
    }
}

static void equalities_hold(void **state) {
    (void)state;
    pinned_t p = pinned_make(GEN_GRID2, 100, 1, NULL);
    const sl_int rows[5] = {3, 40, 41, 3, 70};
    const double values[5] = {1.0, -2.0, 0.5, 1.0, 3.0};
    SL_CHECK(sl_constraints_add(p.P, rows, values, 5, NULL));
    for (int k = 0; k < 5; k++) {
        p.C[rows[k]] += values[k];
    }
    p.count++;
    pin(&p, 40);
    pin(&p, 7);
    assert_pinned(&p, 5);
    release(&p, 0);
    assert_pinned(&p, 6);
    pinned_free(&p);
}

/* b in pinned rows alone gives x = 0, full and local, and not the rounding of it. */
static void a_pinned_row_takes_no_load(void **state) {
    (void)state;
    pinned_t p = pinned_make(GEN_GRID2, 100, 1, NULL);
    const sl_int row = 41, wanted[2] = {41, 42};
    const double one = 1.0, g[2] = {0.0, 0.0};
    double x[2] = {1.0, 1.0}, *X = test_reals((size_t)p.n), *B = test_reals((size_t)p.n);
    sl_plan *plan;
    SL_CHECK(sl_plan_create(&plan, p.y.S, &row, 1, wanted, 2, NULL, NULL));
    B[row] = 1.0;
    pin(&p, 43);
    pin(&p, row);
    SL_CHECK(sl_constraints_solve(p.P, plan, x, 2, &one, 1, g, 2, 1, NULL));
    SL_CHECK(sl_constraints_solve(p.P, NULL, X, (size_t)p.n, B, (size_t)p.n, g, 2, 1, NULL));
    assert_true(x[0] == 0.0 && x[1] == 0.0);
    for (sl_int k = 0; k < p.n; k++) {
        assert_true(X[k] == 0.0);
    }
    sl_plan_free(plan);
    free(X);
    free(B);
    pinned_free(&p);
}

/* One pin makes a Laplacian regular, wherever it is, the null row included. */
static void a_pin_makes_a_laplacian_regular(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    for (int weights = 0; weights < 2; weights++) {
        double mass[64];
        for (int k = 0; k < 64; k++) {
            mass[k] = 1.0 + k % 3;
        }
        opt.mass = weights ? mass : NULL;
        pinned_t p = pinned_make(GEN_SINGULAR, 64, 1, &opt);
        assert_true(p.n <= 64);
        sl_int null, count;
        SL_CHECK(sl_factor_pivot_rows(p.y.F, SL_PIVOT_NULL, &null, NULL, 1, &count));
        assert_int_equal(count, 1);
        for (sl_int row = 0; row < p.n; row++) {
            pin(&p, row);
            assert_pinned(&p, 5);
            release(&p, 0);
        }
        pin(&p, null);
        for (sl_int m = 1; m < PINS; m++) {
            pin(&p, (null + 5 * m) % p.n);
        }
        assert_pinned(&p, 6);
        release(&p, 0); /* the others still make it regular */
        assert_pinned(&p, 7);
        while (p.count > 1) {
            release(&p, 0);
            assert_pinned(&p, 8);
        }
        pinned_free(&p);
    }
}

/* Two components, a pin in each of them. */
static void pins_of_several_components(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    gen_list_t t = gen_list(50);
    for (sl_int k = 0; k + 1 < 50; k++) {
        if (k != 19) {
            gen_add(&t, k, k + 1, -1.0);
        }
    }
    gen_laplacian(&t);
    pinned_t p = {{gen_store(&t, gen_style(0), 1), NULL, NULL}, NULL, NULL, NULL, 50, 0};
    SL_CHECK(sl_symbolic_create(&p.y.S, &p.y.M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&p.y.F, p.y.S, &p.y.M.view, &opt, NULL));
    p.dense = ref_dense(&p.y.M.view);
    p.C = test_reals(50 * 100);
    SL_CHECK(sl_constraints_create(&p.P, p.y.F, NULL));
    pin(&p, 3);
    pin(&p, 33);
    assert_pinned(&p, 5);
    pin(&p, 13);
    pin(&p, 49);
    assert_pinned(&p, 6);
    release(&p, 0);
    release(&p, 0);
    assert_pinned(&p, 7);
    const sl_int both[2] = {2, 30};
    const double ones[2] = {1.0, 1.0};
    SL_CHECK(sl_constraints_add(p.P, both, ones, 2, NULL));
    p.C[(size_t)p.count * 50 + 2] = p.C[(size_t)p.count * 50 + 30] = 1.0;
    p.count++;
    assert_pinned(&p, 8);
    release(&p, 0); /* the equality alone holds this component */
    assert_pinned(&p, 9);
    pinned_free(&p);
    gen_list_free(&t);
}

static void a_changed_factor_is_refused_until_the_refactorization(void **state) {
    (void)state;
    pinned_t p = pinned_make(GEN_GRID2, 60, 1, NULL);
    double *x = test_reals((size_t)p.n), g[3] = {1.0, 2.0, 3.0}, two = 2.0;
    sl_int i = 9;
    size_t n = (size_t)p.n;
    pin(&p, 3);
    pin(&p, 20);
    pin(&p, 21);
    SL_CHECK(sl_factor_change_entries(p.y.F, NULL, &i, &i, &two, 1, NULL, NULL));
    p.dense[(size_t)i * (n + 1)] += two;
    SL_EXPECT(SL_ERR_STALE, sl_constraints_solve(p.P, NULL, x, n, x, n, g, 3, 1, NULL));
    SL_EXPECT(SL_ERR_STALE, pin_row(p.P, 4, NULL));
    SL_CHECK(sl_constraints_refactor(p.P, NULL));
    assert_pinned(&p, 3);
    free(x);
    pinned_free(&p);
}

/* Equalities of one row each, between rows that are held. */
static void weighted_rows_survive_a_refactorization(void **state) {
    (void)state;
    static const struct {
        sl_int row;
        double weight;
    } one[3] = {{20, 4.0}, {21, -0.375}, {40, 1e-30}};
    pinned_t p = pinned_make(GEN_GRID2, 60, 1, NULL);
    pin(&p, 3);
    for (int k = 0; k < 3; k++) {
        SL_CHECK(sl_constraints_add(p.P, &one[k].row, &one[k].weight, 1, NULL));
        p.C[(size_t)p.count++ * (size_t)p.n + (size_t)one[k].row] = one[k].weight;
        pin(&p, 30 + k);
    }
    assert_pinned(&p, 3);
    SL_CHECK(sl_constraints_refactor(p.P, NULL));
    assert_pinned(&p, 3);
    pinned_free(&p);
}

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    pinned_t p = pinned_make(GEN_GRID2, 60, 1, NULL);
    sl_stats stats;
    size_t n = (size_t)p.n;
    double *x = test_reals(n), one = 1.0, nan = NAN;
    sl_int row = 3, set[2] = {0, 1};
    sl_constraints *P = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_create(NULL, p.y.F, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_create(&P, NULL, NULL));
    sl_options wrong = options_none();
    wrong.size = 1;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_create(&P, p.y.F, &wrong));
    SL_EXPECT(SL_ERR_ARGUMENT, pin_row(NULL, 0, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, pin_row(p.P, -1, &stats));
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, pin_row(p.P, p.n, &stats));
    assert_int_equal(stats.error.row, p.n);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_add(p.P, &row, &one, 0, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_add(p.P, NULL, &one, 1, NULL));
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_constraints_add(p.P, &row, &nan, 1, &stats));
    assert_int_equal(stats.error.row, 3);
    SL_EXPECT(SL_ERR_ARGUMENT, unpin(p.P, 0));
    pin(&p, 3);
    pin(&p, 4);
    SL_EXPECT(SL_ERR_PIVOT, pin_row(p.P, 3, &stats));
    assert_int_equal(stats.error.row, 3);
    SL_EXPECT(SL_ERR_ARGUMENT, unpin(p.P, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, unpin(NULL, 0));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_refactor(NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_solve(NULL, NULL, x, n, x, n, x, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_solve(p.P, NULL, x, n, x, n, NULL, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_solve(p.P, NULL, x, n, x, n, x, 1, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_solve(p.P, NULL, NULL, n, x, n, x, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_solve(p.P, NULL, x, n, x, n, x, 2, -1, NULL));
    sl_region *R = NULL;
    sl_plan *plan = NULL;
    sl_options opt = options_none();
    SL_CHECK(sl_region_create(&R, p.y.F, set, 2, NULL, NULL, NULL));
    opt.region = R;
    SL_CHECK(sl_plan_create(&plan, p.y.S, set, 2, set, 2, &opt, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_constraints_solve(p.P, plan, x, 2, x, 2, x, 2, 1, NULL));
    sl_plan_free(plan);
    sl_region_free(R);
    free(x);
    assert_pinned(&p, 5);
    pinned_free(&p);
    factored_t kkt = factored_make(GEN_KKT, 40, 1, 0, NULL);
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_constraints_create(&P, kkt.F, NULL));
    assert_null(P);
    factored_free(&kkt);
    assert_int_equal(pins_count(NULL), 0);
    sl_constraints_free(NULL);
}

static void failing_allocations_leave_the_pins(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    factored_t y = factored_make(GEN_GRID2, 60, 1, 0, NULL);
    sl_constraints *P = NULL;
    double b[60] = {0.0}, x[60], g[PINS] = {1.0};
    counter.fail_at = 0;
    SL_EXPECT(SL_ERR_MEMORY, sl_constraints_create(&P, y.F, &opt));
    assert_null(P);
    counter.fail_at = -1;
    SL_CHECK(sl_constraints_create(&P, y.F, &opt));
    for (sl_int k = 0; k < PINS; k++) {
        sl_status status = SL_ERR_MEMORY;
        for (int m = 0; status != SL_OK; m++) {
            counter.fail_at = (int64_t)counter.calls + m;
            status = pin_row(P, 4 * k, NULL);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            assert_int_equal(pins_count(P), k + (status == SL_OK));
        }
        counter.fail_at = -1;
    }
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_constraints_solve(P, NULL, x, 60, b, 60, g, PINS, 1, NULL));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_constraints_refactor(P, NULL));
    counter.fail_at = -1;
    SL_EXPECT(SL_ERR_STALE, sl_constraints_solve(P, NULL, x, 60, b, 60, g, PINS, 1, NULL));
    SL_CHECK(sl_constraints_refactor(P, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, 60, b, 60, g, PINS, 1, NULL));
    for (sl_int k = 0; k < PINS; k++) {
        assert_true(fabs(x[4 * k] - g[k]) <= 1e-13);
    }
    sl_constraints_free(P);
    factored_free(&y);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pins_hold_rows_of_definite_matrices),
        cmocka_unit_test(rows_are_pinned_together),
        cmocka_unit_test(equalities_hold),
        cmocka_unit_test(a_pinned_row_takes_no_load),
        cmocka_unit_test(a_pin_makes_a_laplacian_regular),
        cmocka_unit_test(pins_of_several_components),
        cmocka_unit_test(a_changed_factor_is_refused_until_the_refactorization),
        cmocka_unit_test(weighted_rows_survive_a_refactorization),
        cmocka_unit_test(invalid_arguments_are_refused),
        cmocka_unit_test(failing_allocations_leave_the_pins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
