/* test_centred_cases.c: options.mass where it is wrong, where a row is zero, where null vectors are not constant, where memory ends */
#include "centred.h"
#include "question.h"

/* A path of n rows between the weights a, with shift on row 0. */
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

/* What the weights can be wrong in, and what is not wrong: rows without any, definite matrices. */
static void weights_that_are_refused(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    for (int k = 0; k < ways.count; k++) {
        sl_options opt = options_semidefinite(&ways, k);
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
            m[4] = bad == 0 ? NAN : bad == 1 ? INFINITY : -10.0; /* the last: a sum of 0 */
            m[5] = bad == 2 ? 0.0 : 6.0;
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &M.view, &opt, &stats));
            assert_null(F);
            if (bad < 2) {
                assert_int_equal(stats.error_row, 4);
            } else {
                assert_in_range(stats.error_row, 0, 5);
            }
            m[4] = keep;
            m[5] = 6.0;
        }
        /* cut in two by a weight of 0: one weighted sum is not enough for two null pivots */
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &cut.view, &opt, &stats));
        assert_null(F);
        assert_in_range(stats.error_row, 0, 5);
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &cut.view, &stats));
        SL_EXPECT(SL_ERR_STATE, sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        /* no null pivot: nothing is centred, the bits are those without weights */
        SL_CHECK(sl_factor_refactor(F, &firm.view, &stats));
        assert_int_equal(stats.null, 0);
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        opt.mass = NULL;
        SL_CHECK(sl_factor_create(&plain, S, &firm.view, &opt, NULL));
        SL_CHECK(sl_factor_solve(plain, y, 6, b, 6, 1, NULL));
        SAME_VALUES(x, y, 6);
        sl_factor_free(plain);
        /* and back to what is singular; all weights 0 count as 1 */
        SL_CHECK(sl_factor_refactor(F, &M.view, &stats));
        assert_int_equal(stats.null, 1);
        const sl_int of[6] = {0, 0, 0, 0, 0, 0};
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        assert_centred(&M.view, of, m, x, b);
        sl_factor_free(F);
        const double none[6] = {0, 0, 0, 0, 0, 0}, ones[6] = {1, 1, 1, 1, 1, 1};
        opt.mass = none;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
        SL_CHECK(sl_factor_solve(F, x, 6, b, 6, 1, NULL));
        assert_centred(&M.view, of, ones, x, b);
        sl_factor_free(F);
        /* read with SL_SEMIDEFINITE only */
        opt.definiteness = SL_DEFINITE;
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &firm.view, &opt, &stats));
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_matrix_free(&cut);
        gen_matrix_free(&firm);
    }
}

/* Vertices without any weight, tied to the others by zeros in the pattern: components of their own. */
static void rows_of_zeros(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    for (int every = 1; every <= 7; every += 2) {
        sl_int components = 0;
        gen_matrix_t M = laplacian(GEN_GRID2, 100, 0, &components);
        sl_int n = M.view.n_cols, of[100];
        double *m = weights(n, 5), *sums = test_reals((size_t)n), b[100], x[100];
        for (sl_int k = 0; k < n; k++) { /* every = 1: all rows; else a few that part nothing */
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
            M.x[M.p[j]] = sums[j]; /* a column begins with its diagonal */
        }
        gen_reals(b, (size_t)n, 3);
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int k = 0; k < ways.count; k++) {
            sl_options opt = options_semidefinite(&ways, k);
            sl_factor *F = NULL;
            opt.mass = m;
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
            SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
            assert_centred(&M.view, of, m, x, b);
            question_t q = ask(F, n, 5, 20, 3, 8);
            answer(S, F, &q, NULL);
            forget(&q);
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(m);
        free(sums);
    }
}

/* A null vector that is not constant: S A S has S^-1 1. z' b decides, and the weights still say which x. */
static void a_null_vector_of_any_kind(void **state) {
    (void)state;
    sl_int components = 0, n = 90;
    gen_matrix_t M = laplacian(GEN_GRID2, n, 0, &components);
    n = M.view.n_cols;
    double *scale = weights(n, 8), *m = weights(n, 9), *b = test_reals((size_t)n);
    double *x = test_reals((size_t)n);
    way_list_t ways = ways_present();
    sl_symbolic *S = NULL;
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
            M.x[p] *= scale[j] * scale[M.i[p]];
        }
    }
    gen_reals(b, (size_t)n, 2);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < ways.count; k++) {
        sl_options opt = options_semidefinite(&ways, k);
        sl_factor *F = NULL;
        double z_b = 0.0, z_m = 0.0, sum = 0.0, total = 0.0, most = 0.0,
               *rhs = test_reals((size_t)n);
        opt.mass = m;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
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

/* Every allocation of a factor with weights may fail; neither refactoring nor solving asks for more. */
static void memory(void **state) {
    (void)state;
    way_list_t ways = ways_present();
    sl_int components = 0, rows[3] = {0, 40, 80};
    gen_matrix_t M = laplacian(GEN_COMPONENTS, 90, 0, &components);
    double *m = weights(90, 2), b[3 * 9], x[3 * 9];
    sl_symbolic *S = NULL;
    gen_reals(b, 3 * 9, 1);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < ways.count; k++) {
        for (int64_t fails = 0, done = 0; !done; fails++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter), wish = options_semidefinite(&ways, k);
            sl_factor *F = NULL;
            sl_work *W = NULL;
            opt.isa = wish.isa;
            opt.method = wish.method;
            opt.definiteness = wish.definiteness;
            opt.mass = m;
            counter.fail_at = fails;
            sl_status status = sl_factor_create(&F, S, &M.view, &opt, NULL);
            done = status == SL_OK;
            assert_true(done ? F != NULL : F == NULL && status == SL_ERR_MEMORY);
            if (done) {
                counter.fail_at = -1;
                SL_CHECK(sl_work_create(&W, &opt));
                SL_CHECK(sl_local_solve(F, x, 3, rows, 3, b, 3, rows, 3, 9, W, NULL));
                size_t calls = counter.calls;
                SL_CHECK(sl_factor_refactor(F, &M.view, NULL));
                SL_CHECK(sl_local_solve(F, x, 3, rows, 3, b, 3, rows, 3, 9, W, NULL));
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
        cmocka_unit_test(weights_that_are_refused),
        cmocka_unit_test(rows_of_zeros),
        cmocka_unit_test(a_null_vector_of_any_kind),
        cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
