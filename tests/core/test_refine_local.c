/* test_refine_local.c: sl_plan_solve_regularized: regularized systems on a few rows */
#include "tests/lib/kkt.h"
#include "tests/lib/factored.h"

enum { N = 240, NB = 12, NX = 15, R = 11 };

/* A regularized factor of a nonsingular saddle-point system, a plan that holds its regularized
 * rows, and a plan of all rows. */
typedef struct fixture_t {
    kkt_t y;
    sl_factor *F;
    /* Both sets end with the regularized rows. */
    sl_int count, rows[N], bset[N], xset[N], nb, nx;
    sl_plan *P, *all;
    double *B;    /* nb x R, 0 in the regularized rows that b is not on */
    double *full; /* N x R, the same right-hand sides on all rows */
} fixture_t;

static int contains(const sl_int *set, sl_int count, sl_int row) {
    for (sl_int k = 0; k < count; k++) {
        if (set[k] == row) {
            return 1;
        }
    }
    return 0;
}

static fixture_t *fixture_make(const variant_list_t *variants, int k) {
    fixture_t *f = (fixture_t *)test_array(1, sizeof *f);
    sl_options opt = options_none();
    options_set_variant(&opt, variants, k);
    f->y = kkt_make(N, 0, SL_ORDERING_ND);
    opt.regularization = 1e-7;
    opt.signs = f->y.signs;
    SL_CHECK(sl_factor_create(&f->F, f->y.S, &f->y.M.view, &opt, NULL));
    SL_CHECK(sl_factor_pivot_rows(f->F, SL_PIVOT_REGULARIZED, f->rows, NULL, N, &f->count));
    assert_true(f->count > 5);
    gen_set(f->bset, NB, N, 3);
    gen_set(f->xset, NX, N, 4);
    f->nb = NB;
    f->nx = NX;
    for (sl_int m = 0; m < f->count; m++) {
        if (!contains(f->bset, NB, f->rows[m])) {
            f->bset[f->nb++] = f->rows[m];
        }
        if (!contains(f->xset, NX, f->rows[m])) {
            f->xset[f->nx++] = f->rows[m];
        }
    }
    f->B = test_reals((size_t)f->nb * R);
    f->full = test_reals(N * R);
    for (sl_int r = 0; r < R; r++) {
        gen_reals(f->B + f->nb * r, NB, (uint64_t)r + 20);
        for (sl_int b = 0; b < NB; b++) {
            f->full[f->bset[b] + N * r] = f->B[b + f->nb * r];
        }
    }
    SL_CHECK(sl_plan_create(&f->P, f->y.S, f->bset, f->nb, f->xset, f->nx, NULL, NULL));
    SL_CHECK(sl_plan_create(&f->all, f->y.S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    return f;
}

static void fixture_free(fixture_t *f) {
    sl_plan_free(f->P);
    sl_plan_free(f->all);
    sl_factor_free(f->F);
    kkt_free(&f->y);
    free(f->B);
    free(f->full);
    free(f);
}

/* Replaces the R columns of X by the dense solutions of A X = B. Returns n eps ||A^-1|| ||A||, a
 * bound on their relative error. */
static double dense_bound(const sl_csc *A, double *X) {
    double *M = ref_dense(A), condition = ref_condition(A->n_cols, M);
    ref_solve(A->n_cols, M, X, R);
    free(M);
    return A->n_cols * DBL_EPSILON * condition;
}

static void local_refinement_matches_full_and_dense(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        fixture_t *f = fixture_make(&variants, k);
        size_t nx = (size_t)f->nx, nb = (size_t)f->nb;
        double *X = test_reals(nx * R), *all = test_reals(N * R), *exact = test_reals(N * R);
        double *plain = test_reals(nx * R);
        memcpy(exact, f->full, N * R * sizeof *exact);
        double bound = dense_bound(&f->y.M.view, exact);
        for (sl_int nrhs = 1; nrhs <= R; nrhs++) {
            sl_stats stats, whole;
            memset(&stats, 0, sizeof stats);
            memset(&whole, 0, sizeof whole);
            SL_CHECK(
                sl_plan_solve_regularized(f->P, f->F, X, nx, f->B, nb, nrhs, 20, NULL, &stats));
            SL_CHECK(sl_plan_solve_regularized(f->all, f->F, all, N, f->full, N, nrhs, 20, NULL,
                                               &whole));
            SL_CHECK(sl_plan_solve(f->P, f->F, plain, nx, f->B, nb, nrhs, NULL));
            assert_in_range(stats.refine.steps, 1, 6);
            assert_int_equal(stats.refine.steps, whole.refine.steps);
            assert_true(stats.refine.backward_error == whole.refine.backward_error);
            /* Rounding, or that of E x, which may be larger than b. Without refinement it is 1e-5.
             */
            whole.factor = sl_factor_view(f->F).info;
            assert_true(stats.refine.backward_error >= DBL_EPSILON * whole.factor.growth);
            assert_true(stats.refine.backward_error <=
                        fmax(100.0, whole.factor.growth) * DBL_EPSILON);
            double error = 0.0, plain_error = 0.0, largest = 0.0;
            for (sl_int r = 0; r < nrhs; r++) {
                for (sl_int i = 0; i < f->nx; i++) {
                    double x = X[i + f->nx * r], right = exact[f->xset[i] + N * r];
                    assert_true(same_value(x, all[f->xset[i] + N * r]));
                    error = fmax(error, fabs(x - right));
                    plain_error = fmax(plain_error, fabs(plain[i + f->nx * r] - right));
                    largest = fmax(largest, fabs(right));
                }
            }
            assert_true(plain_error > 1e-10 * largest); /* there was an error to remove */
            assert_true(error <= bound * largest);
            if (nrhs == 1 && k == 0) {
                print_message(
                    "%d of %d rows regularized: plain error %.1e, refined %.1e, bound %.1e\n",
                    (int)f->count, N, plain_error / largest, error / largest, bound);
            }
        }
        /* Zero steps are the plain solve. */
        SL_CHECK(sl_plan_solve_regularized(f->P, f->F, X, nx, f->B, nb, 3, 0, NULL, NULL));
        SL_CHECK(sl_plan_solve(f->P, f->F, plain, nx, f->B, nb, 3, NULL));
        SAME_VALUES(X, plain, 3 * nx);
        /* In place, with the plan of all rows. */
        SL_CHECK(
            sl_plan_solve_regularized(f->all, f->F, f->full, N, f->full, N, R, 20, NULL, NULL));
        SAME_VALUES(f->full, all, N * R);
        free(X);
        free(all);
        free(exact);
        free(plain);
        fixture_free(f);
    }
}

/* What is reported is not less than epsilon times the growth, and above options.error_limit it is
 * refused, with x written; L in float has the epsilon of float. */
static void growth_is_an_error_that_remains(void **state) {
    (void)state;
    kkt_t y = kkt_make(N, 0, SL_ORDERING_ND);
    sl_plan *P = NULL;
    double b[N], x[N], same[N];
    gen_reals(b, N, 5);
    SL_CHECK(sl_plan_create(&P, y.S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    for (int way = 0; way < 4; way++) {
        const int is_float = way % 2;
        sl_options opt = options_none();
        sl_factor *F = NULL;
        sl_stats stats;
        opt.regularization = 1e-7;
        opt.signs = y.signs;
        opt.storage = is_float ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
        opt.growth_limit = opt.error_limit = -1.0;
        SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, &stats));
        const double least =
            (is_float ? (double)FLT_EPSILON : DBL_EPSILON) * fmax(stats.factor.growth, 1.0);
        sl_factor_free(F);
        opt.error_limit = way < 2 ? 0.5 * least : -1.0;
        SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
        SL_CHECK(sl_plan_solve_regularized(P, F, same, N, b, N, 1, 0, NULL, NULL)); /* measures */
        SL_EXPECT(way < 2 ? SL_ERR_INACCURATE : SL_OK,
                  sl_plan_solve_regularized(P, F, x, N, b, N, 1, 20, NULL, &stats));
        assert_true(stats.refine.backward_error >= least);
        assert_true(is_float || x[0] != same[0]);
        sl_factor_free(F);
    }
    sl_plan_free(P);
    kkt_free(&y);
}

/* A plan that lacks a regularized row is refused and the row reported. A factor without regularized
 * rows is solved plainly. Sets may be empty. */
static void a_plan_must_hold_the_regularized_rows(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        fixture_t *f = fixture_make(&variants, k);
        sl_symbolic_arrays v = sl_symbolic_view(f->y.S);
        double x[N], before[N];
        sl_plan *P = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        gen_reals(before, N, 2);
        memcpy(x, before, sizeof x);
        /* Only a root of the elimination tree: its reach is itself. */
        sl_int root = v.iperm[f->rows[0]];
        while (v.parent[root] != -1) {
            root = v.parent[root];
        }
        const sl_int top = v.perm[root];
        for (int side = 0; side < 2; side++) {
            SL_CHECK(sl_plan_create(&P, f->y.S, side ? f->bset : &top, side ? f->nb : 1,
                                    side ? &top : f->xset, side ? 1 : f->nx, NULL, NULL));
            SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve_regularized(P, f->F, x, N, f->B, (size_t)f->nb,
                                                                 1, 5, NULL, &stats));
            assert_true(contains(f->rows, f->count, stats.error.row));
            assert_memory_equal(x, before, sizeof x);
            sl_plan_free(P);
        }
        SL_CHECK(sl_plan_create(&P, f->y.S, &top, 0, &top, 1, NULL, NULL)); /* b = 0 */
        SL_CHECK(sl_plan_solve_regularized(P, f->F, x, 1, NULL, 0, 1, 5, NULL, &stats));
        assert_true(x[0] == 0.0 && stats.refine.backward_error <= 1e-8);
        sl_plan_free(P);
        SL_CHECK(sl_plan_create(&P, f->y.S, f->bset, f->nb, &top, 0, NULL, NULL));
        SL_CHECK(
            sl_plan_solve_regularized(P, f->F, NULL, 0, f->B, (size_t)f->nb, 1, 5, NULL, &stats));
        sl_plan_free(P);
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_plan_solve_regularized(NULL, f->F, x, N, f->B, N, 1, 5, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_plan_solve_regularized(f->P, NULL, x, N, f->B, N, 1, 5, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_plan_solve_regularized(f->P, f->F, NULL, N, f->B, N, 1, 5, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_plan_solve_regularized(f->P, f->F, x, 1, f->B, N, 1, 5, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_plan_solve_regularized(f->P, f->F, x, N, f->B, N, -1, 5, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_plan_solve_regularized(f->P, f->F, x, N, f->B, N, 1, -5, NULL, NULL));
        /* A factor of another analysis, a factor without regularized rows, a failed factor. */
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k);
        factored_t y = factored_make(GEN_GRID2, 225, 1, 0, &opt);
        SL_EXPECT(SL_ERR_MISMATCH,
                  sl_plan_solve_regularized(f->P, y.F, x, N, f->B, N, 1, 5, NULL, NULL));
        sl_int set[3] = {3, 50, 200};
        double b[3] = {1, -2, 3}, plain[3];
        SL_CHECK(sl_plan_create(&P, y.S, set, 3, set, 3, NULL, NULL));
        SL_CHECK(sl_plan_solve_regularized(P, y.F, x, 3, b, 3, 1, 5, NULL, &stats));
        SL_CHECK(sl_plan_solve(P, y.F, plain, 3, b, 3, 1, NULL));
        SAME_VALUES(x, plain, 3);
        assert_int_equal(stats.refine.steps, 0);
        sl_plan_free(P);
        factored_free(&y);
        f->y.M.x[0] = NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(f->F, &f->y.M.view, NULL));
        SL_EXPECT(SL_ERR_STALE, sl_plan_solve_regularized(f->P, f->F, x, N, f->B, (size_t)f->nb, 1,
                                                          5, NULL, NULL));
        fixture_free(f);
    }
}

/* Regularized rows of components that b does not touch need not be in the plan. */
static void rows_of_other_components_may_be_missing(void **state) {
    (void)state;
    enum { SIZE = 30 };
    kkt_t y = kkt_make(SIZE, 2, SL_ORDERING_NATURAL);
    gen_list_t t = gen_list(2 * SIZE);
    for (sl_int j = 0; j < SIZE; j++) {
        for (sl_int p = y.M.p[j]; p < y.M.p[j + 1]; p++) {
            gen_add(&t, y.M.i[p], j, y.M.x[p]);
            gen_add(&t, y.M.i[p] + SIZE, j + SIZE, y.M.x[p]);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_int signs[2 * SIZE], rows[2 * SIZE], count;
    for (int k = 0; k < 2 * SIZE; k++) {
        signs[k] = y.signs[k % SIZE];
    }
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.ordering = SL_ORDERING_NATURAL;
    opt.regularization = 1e-7;
    opt.signs = signs;
    SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, rows, NULL, 2 * SIZE, &count));
    assert_int_equal(count, 4);
    assert_true(rows[1] < SIZE && rows[2] >= SIZE);
    double b[2] = {1, 2}, x[2];
    SL_CHECK(sl_plan_create(&P, S, rows, 2, rows, 2, NULL, NULL));
    /* these constraints are redundant, and b is inconsistent: solved, but not accurately */
    SL_EXPECT(SL_ERR_INACCURATE, sl_plan_solve_regularized(P, F, x, 2, b, 2, 1, 5, NULL, &stats));
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    kkt_free(&y);
}

/* A NaN or an overflow is refused as in a solve, whatever error_limit and steps allow. */
static void what_is_not_finite_is_refused(void **state) {
    (void)state;
    kkt_t y = kkt_make(N, 0, SL_ORDERING_ND);
    sl_options opt = options_none();
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    double b[N], x[N];
    opt.regularization = 1e-7;
    opt.signs = y.signs;
    opt.error_limit = -1.0;
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_plan_create(&P, y.S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    for (int k = 0; k < 6; k++) {
        const double wrong[2] = {(double)NAN, 1.7e308};
        gen_reals(b, N, 5);
        b[k * N / 6] = wrong[k % 2];
        b[k * N / 6 + 1] = wrong[k % 2];
        for (sl_int steps = 0; steps < 3; steps++) {
            const sl_status status =
                sl_plan_solve_regularized(P, F, x, N, b, N, 1, steps, NULL, NULL);
            assert_true(status == SL_ERR_NOT_FINITE || (k % 2 == 1 && status == SL_OK));
        }
    }
    sl_plan_free(P);
    sl_factor_free(F);
    kkt_free(&y);
}

/* Also in components without a regularized row. */
static void what_is_not_finite_elsewhere_is_refused(void **state) {
    (void)state;
    const sl_int p[] = {0, 1, 2, 3}, i[] = {0, 1, 2};
    const double a[] = {1e-200, 0, 1}, good[] = {1, 0, 1};
    const double wrong[3][3] = {{1e200, 0, 1}, {(double)NAN, 0, 1}, {1, 0, -HUGE_VAL}};
    const sl_csc A = {3, 3, p, i, a};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    sl_stats stats;
    double x[3];
    opt.regularization = 1e-8;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), &stats));
    assert_true(stats.factor.regularized == 1);
    SL_CHECK(sl_plan_create(&P, S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    for (sl_int steps = 0; steps < 3; steps++) {
        SL_CHECK(sl_plan_solve_regularized(P, F, x, 3, good, 3, 1, steps, NULL, NULL));
        for (int k = 0; k < 3; k++) {
            SL_EXPECT(SL_ERR_NOT_FINITE,
                      sl_plan_solve_regularized(P, F, x, 3, wrong[k], 3, 1, steps, NULL, NULL));
        }
    }
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Failed allocations leave X as it was, and a workspace that has grown allocates nothing. */
static void failed_allocations_change_nothing(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    fixture_t *f = fixture_make(&variants, 0);
    size_t nx = (size_t)f->nx, nb = (size_t)f->nb;
    double *X = test_reals(nx * R), *keep = test_reals(nx * R);
    gen_reals(keep, nx * R, 1);
    memcpy(X, keep, nx * R * sizeof *X);
    for (int64_t k = 0, done = 0; !done; k++) {
        counter_t counter = counter_make();
        sl_work *W = work_failing(&counter, k);
        sl_status status = sl_plan_solve_regularized(f->P, f->F, X, nx, f->B, nb, R, 5, W, NULL);
        done = status == SL_OK;
        if (!done) {
            test_status(status, SL_ERR_MEMORY, "sl_plan_solve_regularized", __FILE__, __LINE__);
            assert_memory_equal(X, keep, nx * R * sizeof *X);
        } else {
            size_t calls = counter.calls;
            SL_CHECK(sl_plan_solve_regularized(f->P, f->F, X, nx, f->B, nb, R, 5, W, NULL));
            assert_int_equal(counter.calls, calls);
            assert_true(k > 0);
        }
        sl_work_free(W);
        COUNTER_CLEAN(&counter);
    }
    free(X);
    free(keep);
    fixture_free(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(local_refinement_matches_full_and_dense),
        cmocka_unit_test(growth_is_an_error_that_remains),
        cmocka_unit_test(a_plan_must_hold_the_regularized_rows),
        cmocka_unit_test(rows_of_other_components_may_be_missing),
        cmocka_unit_test(what_is_not_finite_is_refused),
        cmocka_unit_test(what_is_not_finite_elsewhere_is_refused),
        cmocka_unit_test(failed_allocations_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
