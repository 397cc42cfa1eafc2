/* test_zero_mean_cases.c: options.mass: invalid weights, zero rows, other null vectors, memory */
#include "tests/lib/zero_mean.h"
#include "tests/lib/local_solve.h"

/* The Laplacian of a path of n rows with edges of weight 1, edge `cut` of weight 0, plus shift on
 * the diagonal of row 0. */
static gen_matrix_t path(sl_int n, double shift, sl_int cut) {
    gen_list_t t = gen_list(n);
    for (sl_int k = 0; k < n; k++) {
        double left = k > 0 && k != cut, right = k + 1 < n && k + 1 != cut;
        gen_add(&t, k, k, left + right + (k == 0 ? shift : 0.0));
        if (k > 0) {
            gen_add(&t, k, k - 1, k == cut ? 0.0 : -1.0);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* Weights that are refused, and what is accepted: rows of weight 0, definite matrices. */
static void invalid_weights_are_refused(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        gen_matrix_t M = path(6, 0.0, -1), cut = path(6, 0.0, 3), firm = path(6, 2.0, -1);
        double m[6] = {1, 2, 3, 4, 5, 6}, b[6] = {1, -1, 2, 0, 3, 1}, x[6], y[6];
        sl_symbolic *S = NULL;
        sl_factor *F = NULL, *plain = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        opt.mass = m;
        for (int bad = 0; bad < 3; bad++) {
            double keep = m[4];
            m[4] = bad == 0 ? NAN : bad == 1 ? INFINITY : -10.0; /* -10: the sum is 0 */
            m[5] = bad == 2 ? 0.0 : 6.0;
            SL_EXPECT(bad < 2 ? SL_ERR_ARGUMENT : SL_ERR_PIVOT,
                      sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
            assert_null(F);
            if (bad < 2) {
                assert_int_equal(stats.error.row, 4);
            } else {
                assert_in_range(stats.error.row, 0, 5);
            }
            m[4] = keep;
            m[5] = 6.0;
        }
        /* an edge of weight 0 cuts the path: one weighted mean does not determine two null
         * pivots */
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &cut.view, FOR_FACTOR(&opt), &stats));
        assert_null(F);
        assert_in_range(stats.error.row, 0, 5);
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &cut.view, &stats));
        SL_EXPECT(SL_ERR_STALE, sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        /* no null pivot: the solution is not shifted; the bits are those without weights */
        SL_CHECK(sl_factor_refactor(F, &firm.view, &stats));
        assert_int_equal(stats.factor.null, 0);
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        opt.mass = NULL;
        SL_CHECK(sl_factor_create(&plain, S, &firm.view, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_solve(plain, y, 6, b, 6, 1, NULL));
        SAME_VALUES(x, y, 6);
        sl_factor_free(plain);
        /* singular again; weights that are all 0 count as 1 */
        SL_CHECK(sl_factor_refactor(F, &M.view, &stats));
        assert_int_equal(stats.factor.null, 1);
        const sl_int of[6] = {0, 0, 0, 0, 0, 0};
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        assert_zero_mean(&M.view, of, m, x, b);
        sl_factor_free(F);
        const double none[6] = {0, 0, 0, 0, 0, 0}, ones[6] = {1, 1, 1, 1, 1, 1};
        opt.mass = none;
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        assert_zero_mean(&M.view, of, ones, x, b);
        sl_factor_free(F);
        /* read with SL_PIVOTS_SKIP_NULL only */
        opt.pivots = SL_PIVOTS_NONZERO;
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &firm.view, FOR_FACTOR(&opt), &stats));
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_matrix_free(&cut);
        gen_matrix_free(&firm);
    }
}

/* Vertices whose edges all have weight 0: each is a component of its own. */
static void rows_of_zeros_are_components(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int every = 1; every <= 7; every += 2) {
        sl_int components = 0;
        gen_matrix_t M = laplacian(GEN_GRID2, 100, 0, &components);
        sl_int n = M.view.n_cols, of[100];
        double *m = weights(n, 5), *sums = test_reals((size_t)n), b[100], x[100];
        /* every = 1: all rows; otherwise a few rows that do not disconnect the graph */
        for (sl_int k = 0; k < n; k++) {
            of[k] = every == 1 || (k % every == 0 && k / 10 % 2 && k % 10 % 2) ? k : 0;
        }
        for (sl_int j = 0; j < n; j++) {
            for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
                sl_int i = M.i[p];
                int is_cut =
                    i != j && (every == 1 || (of[i] == i && i > 0) || (of[j] == j && j > 0));
                M.x[p] = is_cut ? 0.0 : M.x[p];
                sums[i] -= i != j ? M.x[p] : 0.0;
                sums[j] -= i != j ? M.x[p] : 0.0;
            }
        }
        for (sl_int j = 0; j < n; j++) {
            M.x[M.p[j]] = sums[j]; /* the diagonal is the first entry of a column */
        }
        gen_reals(b, (size_t)n, 3);
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_skip_null(&variants, k);
            sl_factor *F = NULL;
            opt.mass = m;
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
            SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
            assert_zero_mean(&M.view, of, m, x, b);
            local_solve_t q = local_solve_random(F, n, 5, 20, 3, 8);
            local_solve_check(S, F, &q, NULL);
            local_solve_free(&q);
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(m);
        free(sums);
    }
}

/* A row of zeros, whatever its weight and b, leaves the solution of a regular component alone that
 * explicit zeros join to its tree. */
static void a_row_of_zeros_shifts_no_other_row(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 3, 6, 8, 9}, i[9] = {0, 1, 3, 1, 2, 3, 2, 3, 3};
    static const double a[9] = {2, -1, 0, 2, -1, 0, 2, 0, 0}, wanted[4] = {2.5, 4, 3.5, 0};
    const sl_csc A = {4, 4, p, i, a};
    const double m[4] = {1, 2, 3, 4}, b[4] = {1, 2, 3, 5};
    variant_list_t variants = variants_present();
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        double x[4];
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_solve(F, x, 4, b, 4, 1, NULL));
        for (int j = 0; j < 4; j++) {
            assert_true(fabs(x[j] - wanted[j]) <= 1e-15 * wanted[j] + 1e-290);
        }
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
}

/* An explicit zero joins a regular component to the tree of a singular one: the weights apply to
 * the singular one alone, and count as 1 there if all of them are 0. */
static void weights_stay_in_their_component(void **state) {
    (void)state;
    gen_matrix_t M = path(6, 2.0, 3);
    const sl_int orders[2][6] = {{0, 1, 2, 3, 4, 5}, {5, 4, 3, 2, 1, 0}};
    const double b[6] = {1, -1, 2, 0, 3, 1};
    variant_list_t variants = variants_present();
    for (int k = 0; k < 4 * variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k / 4), order = options_none();
        double m[6] = {1, 2, 3, 4, 5, 6}, x[6], rhs[6], r[6], eta, mean = 0.0;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        order.ordering = SL_ORDERING_GIVEN;
        order.perm = orders[k % 2];
        opt.mass = m;
        if (k & 2) {
            m[3] = m[4] = m[5] = 0.0;
        }
        SL_CHECK(sl_symbolic_create(&S, &M.view, &order, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        memcpy(rhs, b, sizeof rhs);
        for (int i = 3; i < 6; i++) {
            rhs[i] -= k & 2 ? 4.0 / 3.0 : m[i] * 4.0 / 15.0;
            mean += k & 2 ? x[i] : m[i] * x[i];
        }
        SL_CHECK(sl_csc_residual(&M.view, r, 6, &eta, x, 6, rhs, 6, 1));
        assert_true(eta <= 1e-14 && fabs(mean) <= 1e-13);
        for (sl_int i = 0; i < 6; i++) {
            double unit[6] = {0}, one = 1.0, y;
            unit[i] = 1.0;
            SL_CHECK(sl_factor_solve(F, x, 6, unit, 6, 1, NULL));
            for (sl_int j = 0; j < 6; j++) {
                SL_CHECK(sl_local_solve(F, &i, 1, &j, 1, &y, 1, &one, 1, 1, NULL, NULL));
                assert_true(y == x[j]);
            }
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    gen_matrix_free(&M);
}

/* A null vector that is not constant: that of S A S is S^-1 1. z' b decides whether b is
 * consistent, and the weights still select x. */
static void a_null_vector_need_not_be_constant(void **state) {
    (void)state;
    sl_int components = 0, n = 90;
    gen_matrix_t M = laplacian(GEN_GRID2, n, 0, &components);
    n = M.view.n_cols;
    double *scale = weights(n, 8), *m = weights(n, 9), *b = test_reals((size_t)n);
    double *x = test_reals((size_t)n);
    variant_list_t variants = variants_present();
    sl_symbolic *S = NULL;
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
            M.x[p] *= scale[j] * scale[M.i[p]];
        }
    }
    gen_reals(b, (size_t)n, 2);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        double z_b = 0.0, z_m = 0.0, sum = 0.0, total = 0.0, most = 0.0,
               *rhs = test_reals((size_t)n);
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
        for (sl_int i = 0; i < n; i++) {
            z_b += b[i] / scale[i];
            z_m += m[i] / scale[i];
            sum += m[i] * x[i];
            total += m[i];
            most = fmax(most, fabs(x[i]));
        }
        for (sl_int i = 0; i < n; i++) {
            rhs[i] = b[i] - m[i] * (z_b / z_m);
        }
        assert_true(fabs(sum) <= pass_figure(n) * total * most);
        BACKWARD_PASSES(&M.view, x, (size_t)n, rhs, (size_t)n, 1);
        free(rhs);
        sl_factor_free(F);
    }
    free(scale);
    free(m);
    free(b);
    free(x);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Every allocation of a factor with weights may fail; refactoring and solving allocate nothing
 * more. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    sl_int components = 0, rows[3] = {0, 40, 80};
    gen_matrix_t M = laplacian(GEN_COMPONENTS, 90, 0, &components);
    double *m = weights(90, 2), b[3 * 9], x[3 * 9];
    sl_symbolic *S = NULL;
    gen_reals(b, 3 * 9, 1);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        for (int64_t fails = 0, done = 0; !done; fails++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter), wanted = options_skip_null(&variants, k);
            sl_factor *F = NULL;
            sl_work *W = NULL;
            opt.isa = wanted.isa;
            opt.method = wanted.method;
            opt.pivots = wanted.pivots;
            opt.mass = m;
            counter.fail_at = fails;
            sl_status status = sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL);
            done = status == SL_OK;
            assert_true(done ? F != NULL : F == NULL && status == SL_ERR_MEMORY);
            if (done) {
                counter.fail_at = -1;
                SL_CHECK(sl_work_create(&W, FOR_OTHERS(&opt)));
                SL_CHECK(sl_local_solve(F, rows, 3, rows, 3, x, 3, b, 3, 9, W, NULL));
                size_t calls = counter.calls;
                SL_CHECK(sl_factor_refactor(F, &M.view, NULL));
                SL_CHECK(sl_local_solve(F, rows, 3, rows, 3, x, 3, b, 3, 9, W, NULL));
                assert_int_equal(counter.calls, calls);
                assert_true(fails > 0);
            }
            sl_work_free(W);
            sl_factor_free(F);
            COUNTER_CLEAN(&counter);
        }
    }
    free(m);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(invalid_weights_are_refused),
        cmocka_unit_test(rows_of_zeros_are_components),
        cmocka_unit_test(a_row_of_zeros_shifts_no_other_row),
        cmocka_unit_test(weights_stay_in_their_component),
        cmocka_unit_test(a_null_vector_need_not_be_constant),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
