/* test_rigid_mass_cases.c: options.mass with several null vectors: which weights are refused, their
 * size, supports, memory */
#include "tests/lib/rigid_mass.h"
#include "tests/lib/reserved.h"

/* Weights that do not fix all motions are refused with a row of the body, and so is a null pivot
 * whose null vector is not known. */
static void what_weights_do_not_fix_is_refused(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 9;
    for (int which = 0; which < 400; which++) {
        const int dim = 2 + which % 2;
        elastic_t y = elastic_make(dim, dim == 2 ? 5 : 3, 0.0, 1.0, 1.0, 0, &seed);
        sl_options opt = options_rigid(&y, &variants, which / 8 % variants.count);
        const size_t n = (size_t)y.n;
        double *m = test_reals(n), *Z = test_reals(n * (size_t)y.rigid);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        SL_CHECK(sl_symbolic_create(&S, &y.A, NULL, NULL));
        opt.mass = m;
        const sl_int node = gen_below(&seed, y.n / dim);
        for (sl_int i = 0; i < y.n; i++) { /* of one node; one direction; both signs; NaN */
            m[i] = which % 8 < 2   ? (double)(i / dim == node)
                   : which % 8 < 4 ? (double)(i % dim == 0)
                   : which % 8 < 6 ? (i / dim == 0) - (double)(i / dim == 1)
                   : i == 3        ? NAN
                                   : 1.0;
        }
        SL_EXPECT(which % 8 < 6 ? SL_ERR_PIVOT : SL_ERR_ARGUMENT,
                  sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        assert_null(F);
        assert_in_range(stats.error.row, 0, y.n - 1);
        for (size_t i = 0; i < n; i++) {
            m[i] = 1.0;
        }
        opt.null_vector = Z; /* 0 */
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        assert_in_range(stats.error.row, 0, y.n - 1);
        opt.null_vector = y.Z;
        SL_CHECK(sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        sl_factor_free(F);
        sl_symbolic_free(S);
        elastic_free(&y);
        free(m);
        free(Z);
    }
}

/* Few weights of any size, some of them negative, which hardly fix all motions: they are refused,
 * or the solution has half of all digits. */
static void few_weights_are_refused_or_right(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 14;
    sl_int refused = 0;
    enum { COUNT = 1200 };
    for (int which = 0; which < COUNT; which++) {
        const int dim = 2 + which % 2;
        elastic_t y = elastic_make(dim, dim == 2 ? 5 : 3, 0.0, 1.0, 1.0, 0, &seed);
        sl_options opt = options_rigid(&y, &variants, which % variants.count);
        const size_t n = (size_t)y.n;
        const double decades = which / 2 % 3 ? 12.0 * elastic_uniform(&seed) : 0.0;
        const sl_int weights = y.rigid - 2 + gen_below(&seed, y.rigid);
        double *m = test_reals(n), *x = test_reals(n), *r = test_reals(n), most = 0.0;
        double *b = consistent(&y.A, seed);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        for (sl_int k = 0; k < weights; k++) {
            m[gen_below(&seed, y.n)] = pow(10.0, decades * (elastic_uniform(&seed) - 0.5)) *
                                       (gen_below(&seed, 8) == 0 ? -1.0 : 1.0);
        }
        opt.mass = m;
        SL_CHECK(sl_symbolic_create(&S, &y.A, NULL, NULL));
        const sl_status status = sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), NULL);
        assert_true(status == SL_OK || status == SL_ERR_PIVOT);
        refused += status == SL_ERR_PIVOT;
        if (status == SL_OK) {
            SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
            for (size_t i = 0; i < n; i++) {
                most = fmax(most, fabs(x[i]));
            }
            for (sl_int j = 0; j < y.rigid; j++) {
                const double *z = y.Z + (size_t)j * n;
                double sum = 0.0, size = 0.0;
                for (size_t i = 0; i < n; i++) {
                    sum += z[i] * m[i] * x[i];
                    size += fabs(z[i] * m[i]) * most;
                }
                assert_true(fabs(sum) <= 1e-8 * size);
            }
            SL_CHECK(sl_csc_residual(&y.A, r, n, &most, x, n, b, n, 1));
            assert_true(most <= 1e-8);
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
        elastic_free(&y);
        free(m);
        free(x);
        free(r);
        free(b);
    }
    assert_true(refused > COUNT / 10 && refused < COUNT * 9 / 10);
}

/* Weights times a power of 4 or -1 give the same bits. Beyond the range of double they are refused,
 * and so are solutions beyond it. In a row of zeros the vectors may be 0. */
static void weights_may_have_any_size(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 12;
    for (int k = 0; k < 2 * variants.count; k++) {
        static const double factors[6] = {-1.0, 0x1p400, -0x1p-400, 0x1p1023, 0x1p-1000, 0x1p500};
        static const sl_status expected[6] = {SL_OK,        SL_OK,        SL_OK,
                                              SL_ERR_PIVOT, SL_ERR_PIVOT, SL_ERR_NOT_FINITE};
        weighed_t f = weighed_make(12 * k + k % 2, &variants, k / 2, &seed);
        double *m = test_reals(f.n), *x = test_reals(f.n), *Z = test_reals(f.n * 6);
        double *values = test_reals((size_t)f.y.A.p[f.n]);
        sl_options opt = f.opt;
        opt.mass = m;
        opt.null_vector = Z;
        for (size_t i = 0; i < f.n * (size_t)f.y.rigid; i++) {
            Z[i] = f.y.body[i % f.n] == -1 ? 0.0 : f.y.Z[i];
        }
        assert_means(&f, f.F);
        for (int c = 0; c < 6; c++) {
            sl_csc A = f.y.A;
            sl_factor *F = NULL;
            A.x = values;
            for (sl_int p = 0; p < A.p[f.n]; p++) {
                values[p] = f.y.A.x[p] * (c == 5 ? 0x1p-700 : 1.0);
            }
            for (size_t i = 0; i < f.n; i++) {
                m[i] = f.m[i] * factors[c];
            }
            SL_EXPECT(expected[c], sl_factor_create(&F, f.S, &A, FOR_FACTOR(&opt), NULL));
            if (F != NULL) {
                SL_CHECK(sl_factor_solve(F, x, f.n, f.b, f.n, 1, NULL));
                for (size_t i = 0; i < f.n; i++) {
                    assert_true(f.y.body[i] == -1 ? fabs(x[i]) < 1e-290 : x[i] == f.x[i]);
                }
            }
            sl_factor_free(F);
        }
        weighed_free(&f);
        free(m);
        free(x);
        free(Z);
        free(values);
    }
}

/* Two springs and a row of zeros, where all null vectors are 0: nothing is missing there. Weights
 * whose sum is 0 are refused in the first of several trees, springs of 1e-306 where the squares of
 * their pivots overflow. */
static void small_trees_are_centered_or_refused(void **state) {
    (void)state;
    enum { N = 5 };
    static const sl_int p[N + 1] = {0, 2, 3, 5, 6, 7}, i[7] = {0, 1, 1, 2, 3, 3, 4};
    static const double Z[2 * N] = {1.0, 1.0, 1.0, 1.0};
    for (int kind = 0; kind < 3; kind++) {
        const double k = kind == 2 ? 1e-306 : 1.0, x[7] = {k, -k, k, k, -k, k, 0.0};
        const double b[N] = {1.0, 2.0, 3.0, 5.0, 0.0};
        const double m[N] = {1e12, kind == 1 ? -1e12 : 1e12, 1e12, kind == 1 ? -1e12 : 1e12, 1e12};
        const sl_csc A = {N, N, p, i, x};
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        double y[N];
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.null_vector = Z;
        opt.null_vector_count = 2;
        opt.mass = m;
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        SL_EXPECT(kind == 0   ? SL_OK
                  : kind == 1 ? SL_ERR_PIVOT
                              : SL_ERR_NOT_FINITE,
                  sl_factor_create(&F, S, &A, &opt, NULL));
        if (kind == 0) { /* b without its means, 1.5 and 4 */
            SL_CHECK(sl_factor_solve(F, y, N, b, N, 1, NULL));
            assert_true(fabs(y[0] + 0.25) <= 1e-15 && fabs(y[1] - 0.25) <= 1e-15);
            assert_true(fabs(y[2] + 0.5) <= 1e-15 && fabs(y[3] - 0.5) <= 1e-15 && y[4] == 0.0);
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* A body that hangs on one node can turn about it: this is all that is left out. */
static void what_a_support_leaves_is_centered(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 10;
    for (int which = 0; which < 16; which++) {
        const int dim = 2 + which % 2;
        elastic_t y = elastic_make(dim, dim == 2 ? 6 : 3, 0.0, 1.0, 1.0, 0, &seed);
        sl_options opt = options_rigid(&y, &variants, which % variants.count);
        const sl_int node = gen_below(&seed, y.n / dim), rotations = y.rigid - dim;
        const size_t n = (size_t)y.n;
        double *m = rigid_masses(&y, 5, &seed), *Z = test_reals(n * (size_t)y.rigid);
        double *b = test_reals(n), *x = test_reals(n), center[3];
        double *values = test_reals((size_t)y.A.p[n]);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        memcpy(values, y.A.x, (size_t)y.A.p[n] * sizeof *values);
        y.A.x = values;
        for (int c = 0; c < dim; c++) {
            center[c] = y.at[node * dim + c];
            for (sl_int p = y.A.p[node * dim + c]; p < y.A.p[node * dim + c + 1]; p++) {
                values[p] += y.A.i[p] == node * dim + c ? 2.0 : 0.0;
            }
        }
        opt.mass = m;
        gen_reals(b, n, seed);
        SL_CHECK(sl_symbolic_create(&S, &y.A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.factor.null, rotations);
        SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
        elastic_rigid(&y, Z, center);
        memmove(Z, Z + n * (size_t)dim, n * (size_t)rotations * sizeof *Z);
        y.rigid = rotations;
        double *C = rigid_basis(&y, Z, m);
        assert_rigid_mean(&y, C, m, x, b, 1.0);
        sl_factor_free(F);
        sl_symbolic_free(S);
        elastic_free(&y);
        free(m);
        free(Z);
        free(C);
        free(b);
        free(x);
        free(values);
    }
}

/* Every allocation may fail; refactoring and solving allocate nothing more. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 11;
    for (int k = 0; k < variants.count; k++) {
        weighed_t f = weighed_make(3, &variants, k, &seed);
        for (int64_t fails = 0, done = 0; !done; fails++) {
            counter_t counter = counter_make();
            sl_options opt = f.opt;
            sl_factor *F = NULL;
            sl_work *W = NULL;
            opt.allocator = options_counted(&counter).allocator;
            counter.fail_at = fails;
            const sl_status status = sl_factor_create(&F, f.S, &f.y.A, FOR_FACTOR(&opt), NULL);
            done = status == SL_OK;
            assert_true(done ? F != NULL : F == NULL && status == SL_ERR_MEMORY);
            if (done) {
                counter.fail_at = -1;
                SL_CHECK(sl_work_create(&W, FOR_OTHERS(&opt)));
                RESERVE_FOR(W, NULL, sl_factor_solve(F, f.x, f.n, f.b, f.n, 1, trial));
                const size_t calls = counter.calls;
                SL_CHECK(sl_factor_refactor(F, &f.y.A, NULL));
                SL_CHECK(sl_factor_solve(F, f.x, f.n, f.b, f.n, 1, W));
                assert_int_equal(counter.calls, calls);
            }
            sl_work_free(W);
            sl_factor_free(F);
            COUNTER_CLEAN(&counter);
        }
        weighed_free(&f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_weights_do_not_fix_is_refused),
        cmocka_unit_test(small_trees_are_centered_or_refused),
        cmocka_unit_test(few_weights_are_refused_or_right),
        cmocka_unit_test(weights_may_have_any_size),
        cmocka_unit_test(what_a_support_leaves_is_centered),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
