/* test_small_fronts.c: supernodes of a few columns, in every instruction set and storage */
#include "tests/lib/factored.h"
#include "tests/lib/parallel_for.h"

enum { WIDEST = 9, TALLEST = 19, MOST = WIDEST + TALLEST + 1 };

/* A supernode of w columns with `below` rows below it: the last ones of a dense block that has a
 * row more. */
static factored_t front_make(sl_int w, sl_int below, const sl_options *opt) {
    factored_t y = {{0}, NULL, NULL};
    const sl_int n = w + below + 1;
    gen_list_t t = gen_list(n);
    uint64_t seed = 7;
    for (sl_int j = 0; j < n; j++) {
        gen_add(&t, j, j, 2.0 * MOST);
        for (sl_int i = j + 1; i < n; i++) {
            if (j >= w || i != w) {
                gen_add(&t, i, j, gen_real(&seed));
            }
        }
    }
    y.M = gen_store(&t, gen_style(0), 1);
    y.S = analyze_natural(&y.M.view, SL_RELAXATION_NONE);
    assert_int_equal(sl_symbolic_view(y.S).super_first[1], w);
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, opt, NULL));
    gen_list_free(&t);
    return y;
}

static void every_small_front_solves(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int way = 0; way < 2 * isas.count; way++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[way / 2];
        opt.method = SL_METHOD_SUPERNODAL;
        opt.storage = way % 2 ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
        const double unit = way % 2 ? FLT_EPSILON : DBL_EPSILON;
        for (sl_int w = 1; w <= WIDEST; w++) {
            for (sl_int below = 0; below <= TALLEST; below++) {
                factored_t y = front_make(w, below, &opt);
                const sl_int n = w + below + 1;
                double B[8 * MOST], X[8 * MOST], single[MOST], R[8 * MOST];
                gen_reals(B, 8 * (size_t)n, 3);
                for (sl_int nrhs = 1; nrhs <= 8; nrhs++) {
                    SL_CHECK(sl_factor_solve(y.F, X, (size_t)n, B, (size_t)n, nrhs, NULL));
                    SL_CHECK(sl_csc_residual(&y.M.view, R, (size_t)n, NULL, X, (size_t)n, B,
                                             (size_t)n, nrhs));
                    for (sl_int k = 0; k < nrhs * n; k++) { /* |x| < 1 / MOST, |b| < 1 */
                        assert_true(fabs(R[k]) <= 8.0 * n * unit);
                    }
                }
                SL_CHECK(sl_factor_solve(y.F, single, (size_t)n, B, (size_t)n, 1, NULL));
                for (sl_int k = 0; k < n; k++) {
                    assert_true(fabs(single[k] - X[k]) <= 8.0 * unit);
                }
                factored_free(&y);
            }
        }
    }
}

/* Rank-one changes take four tiles of a panel at a time. */
static void tall_panels_are_changed(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_DENSE, 100, 1, 0, &opt);
        const sl_int row = 1;
        const double delta = 3.0;
        double b[100], x[100];
        gen_reals(b, 100, 4);
        SL_CHECK(sl_factor_change_entries(y.F, NULL, &row, &row, &delta, 1, NULL, NULL));
        assert_int_equal(y.M.i[y.M.p[row]], row);
        y.M.x[y.M.p[row]] += delta;
        SL_CHECK(sl_factor_solve(y.F, x, 100, b, 100, 1, NULL));
        BACKWARD_PASSES(&y.M.view, x, 100, b, 100, 1);
        factored_free(&y);
    }
}

/* Any pivot of a tile may be too small or too large for its reciprocal. */
static void every_pivot_may_have_no_reciprocal(void **state) {
    (void)state;
    static const double extremes[2] = {1e-310, 1.7e308};
    const isa_list_t isas = isas_present();
    for (int way = 0; way < 2 * isas.count; way++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[way / 2];
        opt.method = SL_METHOD_SUPERNODAL;
        opt.growth_limit = opt.error_limit = -1.0;
        factored_t y = front_make(WIDEST, 3, &opt);
        const sl_int n = y.M.view.n_cols;
        double b[MOST], x[MOST];
        for (sl_int k = 0; k < n; k++) {
            for (sl_int j = 0; j < n; j++) {
                const double d = j == k ? extremes[way % 2] : 2.0;
                for (sl_int q = y.M.p[j]; q < y.M.p[j + 1]; q++) {
                    y.M.x[q] = y.M.i[q] == j ? d : 0.0;
                }
                b[j] = (1.0 + j % 4) * (d / 4.0);
            }
            SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
            SL_CHECK(sl_factor_solve(y.F, x, (size_t)n, b, (size_t)n, 1, NULL));
            for (sl_int j = 0; j < n; j++) {
                assert_true(fabs(x[j] - (1.0 + j % 4) / 4.0) <= 1e-12); /* b may be subnormal */
            }
        }
        factored_free(&y);
    }
}

/* Fronts that all wait for each other, and are small, are factored by one worker. */
static void a_chain_of_fronts_has_one_worker(void **state) {
    (void)state;
    const sl_int n = 10000, band = 60;
    gen_list_t t = gen_list(n);
    for (sl_int j = 0; j < n; j++) {
        gen_add(&t, j, j, 2.0 * band + 1.0);
        for (sl_int i = j + 1; i < n && i <= j + band; i++) {
            gen_add(&t, i, j, -1.0);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_options opt = options_none();
    sl_factor *F;
    int calls = 0;
    sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_DEFAULT);
    opt.method = SL_METHOD_SUPERNODAL;
    opt.threads.count = 2;
    opt.threads.run = run_backwards;
    opt.threads.context = &calls;
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    SL_CHECK(sl_factor_refactor(F, &M.view, NULL));
#if !defined(SL_VERIFY) /* which divides small systems, too */
    assert_int_equal(calls, 0);
#endif
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_small_front_solves),
        cmocka_unit_test(every_pivot_may_have_no_reciprocal),
        cmocka_unit_test(a_chain_of_fronts_has_one_worker),
        cmocka_unit_test(tall_panels_are_changed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
