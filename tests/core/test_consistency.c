/* test_consistency.c: inconsistent right-hand sides of singular systems: refusal and defects */
#include "tests/lib/parallel_for.h"
#include "tests/lib/factored.h"
#include "tests/lib/graph_laplacian.h"

enum { N = 300, R = 19, NB = 40, NX = 30 };

/* A singular system with several components, consistent right-hand sides, and room for the
 * solutions. */
typedef struct fixture_t {
    gen_matrix_t M;
    sl_int of[N], bset[N], xset[N], components; /* bset and xset have NB and NX rows */
    sl_symbolic *S;
    sl_plan *P;
    double B[N * R];  /* consistent: the sum over each component is 0 up to rounding */
    double C[NB * R]; /* the same on bset */
    double X[N * R], before[N * R];
} fixture_t;

/* Subtracts from the rows of a set the mean of their values in each component; isolated rows become
 * 0. */
static void make_consistent(const fixture_t *f, double *b, const sl_int *set, sl_int count) {
    for (sl_int k = 0; k < count; k++) {
        sl_int c = f->of[set ? set[k] : k], last = -1;
        double sum = 0.0;
        for (sl_int m = 0; m < count; m++) {
            if (f->of[set ? set[m] : m] == c) {
                sum += b[m];
                last = m;
            }
        }
        b[last] -= sum;
    }
}

static fixture_t *fixture_make(void) {
    fixture_t *f = (fixture_t *)test_array(1, sizeof *f);
    uint64_t seed = 4;
    f->M = laplacian_of(GEN_COMPONENTS, N, 0, &f->components, f->of);
    gen_set(f->bset, NB, N, gen_bits(&seed));
    gen_set(f->xset, NX, N, gen_bits(&seed));
    gen_reals(f->B, N * R, 2);
    gen_reals(f->C, NB * R, 3);
    gen_reals(f->before, N * R, 5);
    for (int r = 0; r < R; r++) {
        make_consistent(f, f->B + N * r, NULL, N);
        make_consistent(f, f->C + NB * r, f->bset, NB);
    }
    SL_CHECK(sl_symbolic_create(&f->S, &f->M.view, NULL, NULL));
    SL_CHECK(sl_plan_create(&f->P, f->S, f->bset, NB, f->xset, NX, NULL, NULL));
    return f;
}

static void fixture_free(fixture_t *f) {
    sl_plan_free(f->P);
    sl_symbolic_free(f->S);
    gen_matrix_free(&f->M);
    free(f);
}

/* Every kind of solve of the first nrhs right-hand sides returns `expected`, and does not write X
 * if one is inconsistent. */
static void assert_every_solve(fixture_t *f, const sl_factor *F, sl_int nrhs, sl_status expected,
                               sl_work *W) {
    for (int form = 0; form < 8; form++) {
        double *X = f->X, *turned = test_reals((size_t)(N * R));
        sl_status status = SL_OK;
        sl_int failed = 7;
        memcpy(X, f->before, sizeof f->before);
        for (sl_int r = 0; r < nrhs; r++) {
            for (sl_int k = 0; k < (form == 3 ? NB : N); k++) {
                turned[r + nrhs * k] = form == 3 ? f->C[k + NB * r] : f->B[k + N * r];
            }
        }
        double *kept = test_reals((size_t)(N * R));
        memcpy(kept, turned, (size_t)(N * R) * sizeof *kept);
        if (form == 0) {
            status = sl_factor_solve(F, X, N, f->B, N, nrhs, W);
        } else if (form == 1) { /* in place */
            status = sl_factor_solve(F, turned, SL_ROWS((size_t)nrhs), turned,
                                     SL_ROWS((size_t)nrhs), nrhs, NULL);
            assert_int_equal(status == SL_ERR_INCONSISTENT,
                             memcmp(turned, kept, (size_t)(N * nrhs) * sizeof *kept) == 0);
        } else if (form == 2) {
            status = sl_plan_solve(f->P, F, X, NX, f->C, NB, nrhs, W);
        } else if (form == 3) {
            status = sl_plan_solve(f->P, F, X, SL_ROWS((size_t)nrhs), turned, SL_ROWS((size_t)nrhs),
                                   nrhs, W);
        } else if (form == 4) {
            status = sl_local_solve(F, f->bset, NB, f->xset, NX, X, NX, f->C, NB, nrhs, W, NULL);
        } else if (form == 5) { /* in place */
            memcpy(turned, f->B, sizeof f->B);
            status = sl_factor_solve(F, turned, N, turned, N, nrhs, W);
            assert_int_equal(status == SL_ERR_INCONSISTENT, memcmp(turned, f->B, sizeof f->B) == 0);
        } else {
            /* the factor of the call, or that of the requests */
            const sl_factor *own = form == 6 ? NULL : F;
            const sl_request requests[3] = {{NULL, X, N, f->B, N, nrhs / 2, own},
                                            {f->P, X + N * (nrhs / 2), NX, f->C, NB, nrhs, own},
                                            {f->P, turned, NX, f->C, NB, 1, own}};
            int calls = 0;
            sl_threads threads = {form == 6 ? 1 : 3, run_backwards, &calls};
            status =
                sl_batch_solve(form == 6 ? F : NULL, requests, 3, THREADS(threads), NULL, &failed);
            assert_int_equal(failed, status == SL_OK ? -1 : 1);
        }
        test_status(status, expected, "a kind of solve", __FILE__, __LINE__);
        if (status == SL_ERR_INCONSISTENT) {
            assert_memory_equal(X, f->before, sizeof f->before);
        }
        free(turned);
        free(kept);
    }
}

/* One value of the last right-hand side is perturbed: a perturbation at rounding level is accepted,
 * 1e-3 is refused. A NaN is reported. */
static void every_solve_refuses_an_inconsistent_b(void **state) {
    (void)state;
    fixture_t *f = fixture_make();
    variant_list_t variants = variants_present();
    static const sl_int counts[6] = {1, 2, 3, 8, 9, 19};
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        sl_work *W = NULL;
        SL_CHECK(sl_work_create(&W, NULL));
        SL_CHECK(sl_factor_create(&F, f->S, &f->M.view, &opt, NULL));
        for (int c = 0; c < 6; c++) {
            static const double off[4] = {0.0, 1e-12, 1e-3, NAN};
            sl_int last = counts[c] - 1;
            for (int m = 0; m < 4; m++) {
                double *b = f->B + N * last + 150, *p = f->C + NB * last + 11, b0 = *b, p0 = *p;
                *b += off[m];
                *p += off[m];
                assert_every_solve(f, F, counts[c],
                                   m == 2   ? SL_ERR_INCONSISTENT
                                   : m == 3 ? SL_ERR_NOT_FINITE
                                            : SL_OK,
                                   W);
                *b = b0;
                *p = p0;
            }
        }
        sl_factor_free(F);
        /* the caller sets the tolerance; a negative one refuses nothing */
        f->B[7] += 1e-3;
        for (int m = 0; m < 3; m++) {
            static const double tolerance[3] = {1e-1, 1e-9, -1.0};
            opt.consistency_tolerance = tolerance[m];
            SL_CHECK(sl_factor_create(&F, f->S, &f->M.view, &opt, NULL));
            SL_EXPECT(m == 1 ? SL_ERR_INCONSISTENT : SL_OK,
                      sl_factor_solve(F, f->X, N, f->B, N, 1, W));
            sl_factor_free(F);
        }
        f->B[7] -= 1e-3;
        opt.consistency_tolerance = NAN;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, f->S, &f->M.view, &opt, NULL));
        sl_work_free(W);
    }
    fixture_free(f);
}

/* Nothing is written if any right-hand side behind the ninth is inconsistent, in components of
 * any size, whether its null vector is known, so that z' b is a sum over b, or comes from L. */
static void any_later_column_is_judged_first(void **state) {
    (void)state;
    fixture_t *f = fixture_make();
    variant_list_t variants = variants_present();
    double *unknown = test_reals(N); /* zeros */
    for (int k = 0; k < 2 * variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k / 2);
        sl_factor *F = NULL;
        opt.null_vector = k % 2 ? unknown : NULL;
        SL_CHECK(sl_factor_create(&F, f->S, &f->M.view, &opt, NULL));
        for (sl_int r = 9; r < R; r++) {
            double *b = f->B + N * r + 16 * r, *c = f->C + NB * r + 2 * r, b0 = *b, c0 = *c;
            *b += 1e-3;
            *c += 1e-3;
            assert_every_solve(f, F, R, SL_ERR_INCONSISTENT, NULL);
            *b = b0;
            *c = c0;
        }
        assert_every_solve(f, F, R, SL_OK, NULL);
        SL_CHECK(sl_factor_solve(F, f->X, N, f->B, N, R, NULL));
        for (sl_int r = 0; r < R; r += 8) { /* blocks of 8 have the bits of one of 16 */
            double x[N * 8];
            sl_int count = r + 8 < R ? 8 : R - r;
            SL_CHECK(sl_factor_solve(F, x, N, f->B + N * r, N, count, NULL));
            SAME_VALUES(x, f->X + N * r, (size_t)(N * count));
        }
        sl_factor_free(F);
    }
    free(unknown);
    fixture_free(f);
}

/* The defects are the sums over the components; subtracted in the null rows they make any b
 * consistent. */
static void defects_make_any_b_consistent(void **state) {
    (void)state;
    fixture_t *f = fixture_make();
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        sl_int rows[N], count = 0;
        SL_CHECK(sl_factor_create(&F, f->S, &f->M.view, &opt, NULL));
        SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, rows, NULL, N, &count));
        assert_int_equal(count, f->components);
        double *B = test_reals(N * R), *Y = test_reals((size_t)(count + 1) * R);
        gen_reals(B, N * R, 11);
        for (int w = 0; w < 2; w++) {
            sl_work *W = NULL;
            SL_CHECK(sl_work_create(&W, NULL));
            SL_CHECK(sl_factor_defects(F, Y, (size_t)count + 1, B, N, R, w ? W : NULL));
            sl_work_free(W);
        }
        for (int r = 0; r < R; r++) {
            for (sl_int c = 0; c < count; c++) {
                double sum = 0.0, size = 0.0;
                for (sl_int i = 0; i < N; i++) {
                    sum += f->of[i] == f->of[rows[c]] ? B[i + N * r] : 0.0;
                    size += fabs(B[i + N * r]);
                }
                assert_true(fabs(Y[c + (count + 1) * r] - sum) <= pass_figure(N) * size);
                B[rows[c] + N * r] -= Y[c + (count + 1) * r];
            }
        }
        SL_CHECK(sl_factor_solve(F, f->X, N, B, N, R, NULL));
        BACKWARD_PASSES(&f->M.view, f->X, N, B, N, R);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_defects(NULL, Y, (size_t)count, B, N, 1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_defects(F, Y, (size_t)count - 1, B, N, 1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_defects(F, Y, (size_t)count, B, N - 1, 1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_defects(F, Y, (size_t)count, NULL, N, 1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_defects(F, NULL, (size_t)count, B, N, 1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_defects(F, Y, (size_t)count, B, N, -1, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_defects(F, B, N, B, N, 1, NULL));
        SL_CHECK(sl_factor_defects(F, NULL, 0, NULL, 0, 0, NULL));
        sl_factor_free(F);
        free(B);
        free(Y);
    }
    fixture_free(f);
}

/* A definite matrix has no defects and refuses nothing; several null vectors of one component have
 * separate defects. */
static void matrices_with_no_and_with_several_null_vectors(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        factored_t y = factored_make(GEN_GRID2, 100, 1, 0, &opt);
        double b[100], x[100], one = 5.0;
        gen_reals(b, 100, 3);
        SL_CHECK(sl_factor_solve(y.F, x, 100, b, 100, 1, NULL));
        SL_CHECK(sl_factor_defects(y.F, &one, 1, b, 100, 1, NULL));
        assert_true(one == 5.0);
        factored_free(&y);
        /* v v' with v = (1, 2, 3): null vectors (-2, 1, 0) and (-3, 0, 1) if row 0 is eliminated
         * first */
        const sl_int p[4] = {0, 3, 5, 6}, i[6] = {0, 1, 2, 1, 2, 2};
        const double a[6] = {1, 2, 3, 4, 6, 9}, good[3] = {2, 4, 6}, bad[3] = {2, 4, 7};
        const sl_csc A = {3, 3, p, i, a};
        sl_factor *F = NULL;
        sl_stats stats;
        double defects[2];
        memset(&stats, 0, sizeof stats);
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
        SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.factor.null, 2);
        SL_CHECK(sl_factor_solve(F, x, 3, good, 3, 1, NULL));
        BACKWARD_PASSES(&A, x, 3, good, 3, 1);
        SL_EXPECT(SL_ERR_INCONSISTENT, sl_factor_solve(F, x, 3, bad, 3, 1, NULL));
        SL_CHECK(sl_factor_defects(F, defects, 2, bad, 3, 1, NULL));
        assert_true(fabs(defects[0]) < 1e-14 && fabs(defects[1] - 1.0) < 1e-14);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* Weights from 1e-6 to 1e6 that sum exactly in the diagonal: A z computed in floating point is
 * consistent. */
static void widely_spread_weights_are_consistent(void **state) {
    (void)state;
    enum { SIDE = 20, COUNT = SIDE * SIDE };
    variant_list_t variants = variants_present();
    uint64_t seed = 12;
    gen_list_t t = gen_list(COUNT);
    double *diagonal = test_reals(COUNT), *z = test_reals(COUNT), *b = test_reals(COUNT);
    for (sl_int k = 0; k < COUNT; k++) {
        for (int side = 0; side < 2; side++) {
            sl_int other = side ? k + SIDE : k + 1;
            if (side ? other < COUNT : other % SIDE != 0) {
                double w = ldexp(1.0, (int)gen_below(&seed, 41) - 20);
                gen_add(&t, other, k, -w);
                diagonal[k] += w;
                diagonal[other] += w;
            }
        }
    }
    for (sl_int k = 0; k < COUNT; k++) {
        gen_add(&t, k, k, diagonal[k]);
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        double *x = test_reals(COUNT);
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
        assert_int_equal(stats.factor.null, 1);
        for (uint64_t m = 0; m < 20; m++) {
            gen_reals(z, COUNT, m);
            SL_CHECK(sl_csc_multiply(&M.view, SL_AS_SYMMETRIC, b, COUNT, z, COUNT, 1));
            SL_CHECK(sl_factor_solve(F, x, COUNT, b, COUNT, 1, NULL));
            BACKWARD_PASSES(&M.view, x, COUNT, b, COUNT, 1);
        }
        free(x);
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    free(diagonal);
    free(z);
    free(b);
}

static void defects_report_a_failed_allocation(void **state) {
    (void)state;
    enum { ROWS = 36 };
    gen_matrix_t M = gen_matrix(GEN_SINGULAR, ROWS, 1, 0);
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    double B[ROWS] = {1.0}, y = 7.0;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_factor_defects(F, &y, 1, B, ROWS, 1, NULL));
    assert_true(y == 7.0);
    counter.fail_at = -1;
    SL_CHECK(sl_factor_defects(F, &y, 1, B, ROWS, 1, NULL));
    assert_true(y != 7.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_solve_refuses_an_inconsistent_b),
        cmocka_unit_test(any_later_column_is_judged_first),
        cmocka_unit_test(defects_make_any_b_consistent),
        cmocka_unit_test(matrices_with_no_and_with_several_null_vectors),
        cmocka_unit_test(widely_spread_weights_are_consistent),
        cmocka_unit_test(defects_report_a_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
