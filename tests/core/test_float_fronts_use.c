/* test_float_fronts_use.c: fronts in float: null vectors, regions, batches, the condition */
#include "tests/lib/check_region.h"
#include "tests/lib/elasticity.h"
#include "tests/lib/factor_array.h"

static sl_options options_float(sl_isa isa) {
    sl_options opt = options_none();
    opt.isa = isa;
    opt.storage = SL_STORAGE_FLOAT_FRONTS;
    return opt;
}

/* Solves A x = b for a b in the range of A and refines x; a b outside of it is refused. */
static void solve_singular(const sl_csc *A, const sl_factor *F) {
    const size_t n = (size_t)A->n_cols;
    double *B = test_reals(n), *X = test_reals(n);
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    gen_reals(X, n, 4);
    SL_CHECK(sl_csc_multiply(A, SL_AS_SYMMETRIC, B, n, X, n, 1));
    SL_CHECK(sl_factor_solve(F, X, n, B, n, 1, NULL));
    assert_true(worst_backward(A, X, n, B, n, 1) <= 1e-5);
    SL_CHECK(sl_factor_refine(F, A, X, n, B, n, 1, 5, NULL, &stats));
    assert_true(stats.refine.backward_error <= 1e-13);
    for (size_t k = 0; k < n; k++) {
        B[k] = A->x[A->p[k]]; /* the diagonal: positive, as z is, so that z' b is not 0 */
    }
    SL_EXPECT(SL_ERR_INCONSISTENT, sl_factor_solve(F, X, n, B, n, 1, NULL));
    free(B);
    free(X);
}

/* S L S for a Laplacian L and a diagonal S: the null vector 1 / s is given. */
static void a_null_vector_is_given(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 2; k < LAPLACIAN_KINDS; k++) {
        sl_int components;
        gen_matrix_t M = laplacian(laplacian_kinds[k], 400, 0, &components);
        const size_t n = (size_t)M.view.n_cols;
        double *s = test_reals(n), *z = test_reals(n);
        sl_symbolic *S = NULL;
        gen_reals(s, n, 8);
        for (size_t j = 0; j < n; j++) {
            s[j] = 1.0 + 0.4 * s[j];
            z[j] = 1.0 / s[j];
        }
        for (size_t j = 0; j < n; j++) {
            for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
                M.x[p] *= s[j] * s[M.i[p]];
            }
        }
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int q = 0; q < isas.count; q++) {
            sl_options opt = options_float(isas.isa[q]);
            sl_factor *F = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            opt.pivots = SL_PIVOTS_SKIP_NULL;
            opt.null_vector = z;
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
            assert_int_equal(stats.factor.null, components);
            solve_singular(&M.view, F);
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(s);
        free(z);
    }
}

/* The rigid motions of elastic bodies. */
static void several_null_vectors_are_given(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    uint64_t seed = 3;
    for (int k = 0; k < 4 * isas.count; k++) {
        elastic_t y = elastic_make(2 + k % 2, 5, 0.3, 1.0, 1.0, k / 2 % 2, &seed);
        sl_options opt = options_float(isas.isa[k / 4]);
        const size_t n = (size_t)y.n;
        double *B = consistent(&y.A, 5), *X = test_reals(n);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.null_vector = y.Z;
        opt.null_vector_count = y.rigid;
        SL_CHECK(sl_symbolic_create(&S, &y.A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &y.A, &opt, &stats));
        assert_int_equal(stats.factor.null, y.null);
        SL_CHECK(sl_factor_solve(F, X, n, B, n, 1, NULL));
        assert_true(worst_backward(&y.A, X, n, B, n, 1) <= 1e-4);
        SL_CHECK(sl_factor_refine(F, &y.A, X, n, B, n, 1, 8, NULL, &stats));
        BACKWARD_PASSES(&y.A, X, n, B, n, 1);
        sl_factor_free(F);
        sl_symbolic_free(S);
        elastic_free(&y);
        free(B);
        free(X);
    }
}

/* A semidefinite matrix whose L and second pivot overflow in float. */
static void a_pivot_that_overflows_is_refused(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double x[3] = {1e-30, 1e18, 1.0};
    const sl_csc A = {2, 2, p, i, x};
    const isa_list_t isas = isas_with_storages();
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_float(isas.isa[k]);
        sl_factor *F = NULL;
        sl_stats stats;
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        SL_EXPECT(SL_ERR_INACCURATE, sl_factor_create(&F, S, &A, &opt, &stats));
        assert_int_equal(stats.error.row, 1);
    }
    sl_symbolic_free(S);
}

/* All pivots of 70,000 blocks [1 -1; -1 1 + e] are kept, although e is below 1/32, the error that
 * is expected of so many rows. With e = 0 in the last block one pivot is null. */
static void small_pivots_of_many_rows_are_kept(void **state) {
    (void)state;
    enum { ROWS = 140000 };
    const double e = 0.03125 / 2;
    sl_int *p = test_ints(ROWS + 1), *i = test_ints(ROWS / 2 * 3);
    double *x = test_reals(ROWS / 2 * 3);
    const sl_csc A = {ROWS, ROWS, p, i, x};
    for (sl_int k = 0, at = 0; k < ROWS; k += 2, at += 3) {
        p[k + 1] = at + 2;
        p[k + 2] = at + 3;
        i[at] = k;
        i[at + 1] = i[at + 2] = k + 1;
        x[at] = 1.0;
        x[at + 1] = -1.0;
        x[at + 2] = 1.0 + e;
    }
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    for (int mode = SL_PIVOTS_NONZERO; mode <= SL_PIVOTS_SKIP_NULL; mode++) {
        sl_options opt = options_float(SL_ISA_AUTO);
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        opt.pivots = (sl_pivots)mode;
        x[ROWS / 2 * 3 - 1] = 1.0 + e;
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
        assert_int_equal(stats.factor.null, 0);
        for (sl_int k = 0; k < ROWS; k++) {
            assert_true(sl_factor_view(F).D[k] == (k % 2 == 0 ? 1.0 : e));
        }
        x[ROWS / 2 * 3 - 1] = 1.0;
        SL_EXPECT(mode == SL_PIVOTS_SKIP_NULL ? SL_OK : SL_ERR_PIVOT,
                  sl_factor_refactor(F, &A, &stats));
        assert_int_equal(mode == SL_PIVOTS_SKIP_NULL ? stats.factor.null : stats.error.row,
                         mode == SL_PIVOTS_SKIP_NULL ? 1 : ROWS - 1);
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    free(p);
    free(i);
    free(x);
}

/* A region keeps the inverse of L D L', in double: plans in it agree with plans to the roots to the
 * rounding of double, although L is far from that of A. */
static void regions_agree_with_plans_to_the_roots(void **state) {
    (void)state;
    enum { ROWS = 60, NRHS = 9 };
    static const gen_kind_t kinds[3] = {GEN_GRID2, GEN_GRID3, GEN_RANDOM};
    const isa_list_t isas = isas_present();
    for (int k = 0; k < 3 * isas.count; k++) {
        const sl_options opt = options_float(isas.isa[k / 3]);
        factored_t y = factored_make(kinds[k % 3], 900, 1, 0, &opt);
        sl_options in = options_none();
        sl_int set[ROWS];
        sl_region *R = NULL;
        sl_plan *P[2] = {NULL, NULL};
        double B[ROWS * NRHS], X[2][ROWS * NRHS], largest = 0.0;
        for (sl_int q = 0; q < ROWS; q++) {
            set[q] = q;
        }
        SL_CHECK(sl_region_create(&R, y.F, set, ROWS, NULL, NULL, NULL));
        NOTHING_WRONG(check_region(R, set, ROWS));
        gen_reals(B, ROWS * NRHS, 6);
        for (int way = 0; way < 2; way++) {
            in.region = way == 0 ? NULL : R;
            SL_CHECK(sl_plan_create(&P[way], y.S, set, ROWS, set, ROWS, &in, NULL));
            SL_CHECK(sl_plan_solve(P[way], y.F, X[way], ROWS, B, ROWS, NRHS, NULL));
            sl_plan_free(P[way]);
        }
        for (int q = 0; q < ROWS * NRHS; q++) {
            largest = fmax(largest, fabs(X[0][q]));
        }
        for (int q = 0; q < ROWS * NRHS; q++) {
            assert_true(fabs(X[0][q] - X[1][q]) <= 10 * pass_figure(y.M.view.n_cols) * largest);
        }
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
        SL_CHECK(sl_region_refactor(R, y.F, NULL, NULL));
        sl_region_free(R);
        factored_free(&y);
    }
}

/* Batches of factors and of solves: the bits of single calls. */
static void batches_have_the_bits_of_single_calls(void **state) {
    (void)state;
    enum { COUNT = 5, NRHS = 17 };
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 300, 0, 0, NULL);
    const size_t n = (size_t)y.n;
    double c[TERMS * COUNT], *B = test_reals(n * NRHS);
    double *X = test_reals(n * NRHS), *Y = test_reals(2 * n * NRHS);
    coefficients_of(c, COUNT, 0.5);
    gen_reals(B, n * NRHS, 2);
    for (int threads = 0; threads <= 3; threads++) {
        sl_options opt = options_float(SL_ISA_AUTO);
        sl_factor *F[COUNT] = {NULL};
        sl_request requests[2];
        sl_int failed = 7;
        int calls = 0;
        opt.threads = threads_of(threads, &calls);
        SL_CHECK(sl_factor_create_sums(F, COUNT, y.S, c, matrix_pair_values(&y), TERMS, &opt,
                                       &failed, NULL));
        assert_int_equal(failed, -1);
        for (int k = 0; k < COUNT; k++) {
            const sl_options alone = options_float(SL_ISA_AUTO);
            sl_factor *G = NULL;
            SL_CHECK(sl_factor_create_sums(&G, 1, y.S, c + TERMS * k, matrix_pair_values(&y), TERMS,
                                           &alone, NULL, NULL));
            assert_same_bits(F[k], G);
            sl_factor_free(G);
            memset(requests, 0, sizeof requests);
            for (int q = 0; q < 2; q++) {
                requests[q].X = Y + (size_t)q * n * NRHS;
                requests[q].B = B;
                requests[q].ldx = requests[q].ldb = n;
                requests[q].nrhs = q == 0 ? NRHS : 1;
            }
            SL_CHECK(sl_factor_solve(F[k], X, n, B, n, NRHS, NULL));
            sl_options parallel = options_none();
            parallel.threads = opt.threads;
            SL_CHECK(sl_batch_solve(F[k], requests, 2, &parallel, NULL, &failed));
            SAME_VALUES(X, Y, n * NRHS);
            SL_CHECK(sl_factor_solve(F[k], X, n, B, n, 1, NULL));
            SAME_VALUES(X, Y + n * NRHS, n);
        }
        free_all(F, COUNT);
    }
    matrix_pair_free(&y);
    free(B);
    free(X);
    free(Y);
}

/* On larger systems, too, the estimated condition is that of A: within 10 percent of the estimate
 * from a factor in double, up to a condition of 1e6. */
static void the_condition_of_larger_systems(void **state) {
    (void)state;
    enum { SIDE = 170 };
    for (int k = 0; k < 3; k++) {
        const double shift = pow(10.0, -1.0 - 2.0 * k);
        gen_list_t t = gen_list(SIDE * SIDE);
        sl_symbolic *S = NULL;
        double rcond[3];
        for (sl_int j = 0; j < SIDE * SIDE; j++) {
            const int right = j % SIDE < SIDE - 1, up = j / SIDE < SIDE - 1;
            gen_add(&t, j, j, shift + right + up + (j % SIDE > 0) + (j / SIDE > 0));
            if (right) {
                gen_add(&t, j + 1, j, -1.0);
            }
            if (up) {
                gen_add(&t, j + SIDE, j, -1.0);
            }
        }
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int storage = 0; storage < 3; storage++) {
            sl_options opt = options_none();
            sl_factor *F = NULL;
            opt.storage = (sl_storage)storage;
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
            SL_CHECK(sl_factor_rcond(F, &M.view, &rcond[storage], NULL));
            sl_factor_free(F);
        }
        assert_true(rcond[0] < 0.2 * shift && rcond[0] > 0.1 * shift); /* about shift / 8 */
        assert_true(fabs(rcond[1] / rcond[0] - 1.0) < 0.01);
        assert_true(fabs(rcond[2] / rcond[0] - 1.0) < 0.1);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_null_vector_is_given),
        cmocka_unit_test(several_null_vectors_are_given),
        cmocka_unit_test(a_pivot_that_overflows_is_refused),
        cmocka_unit_test(small_pivots_of_many_rows_are_kept),
        cmocka_unit_test(regions_agree_with_plans_to_the_roots),
        cmocka_unit_test(batches_have_the_bits_of_single_calls),
        cmocka_unit_test(the_condition_of_larger_systems),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
