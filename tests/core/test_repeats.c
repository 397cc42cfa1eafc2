/* test_repeats.c: rows given twice in a b- or x-set: values add up, answers repeat */
#include "tests/lib/kkt.h"
#include "tests/lib/factored.h"

enum { N = 400, R = 11, NB = 23, NX = 31, LD = 40 };

/* One system twice: with repeated rows, and with each row once and its values added up in order.
 * Both must give the same bits. */
typedef struct local_solve_t {
    sl_int nb, nx, bset[NB], xset[NX];
    sl_int n_once_b, n_once_x, once_b[NB], once_x[NX];
    sl_int from[NX]; /* NX: where each row of xset is in once_x */
    double B[LD * R], once_B[LD * R];
    double wanted[LD * R]; /* X in the order of xset, column-major */
} local_solve_t;

static sl_int find(const sl_int *set, sl_int count, sl_int row) {
    for (sl_int k = 0; k < count; k++) {
        if (set[k] == row) {
            return k;
        }
    }
    return -1;
}

/* Rows out of rows[0 .. n_rows-1], NULL: 0 .. n_rows-1; about every other one again. */
static local_solve_t *question_make(const sl_int *rows, sl_int n_rows, sl_int nb, sl_int nx,
                                    uint64_t seed) {
    local_solve_t *q = (local_solve_t *)test_array(1, sizeof *q);
    q->nb = nb;
    q->nx = nx;
    for (sl_int k = 0; k < nb; k++) {
        sl_int row = gen_below(&seed, n_rows);
        q->bset[k] = k > 0 && k % 2 ? q->bset[gen_below(&seed, k)] : rows ? rows[row] : row;
    }
    for (sl_int k = 0; k < nx; k++) {
        sl_int row = gen_below(&seed, n_rows);
        q->xset[k] = k > 0 && k % 2 ? q->xset[gen_below(&seed, k)] : rows ? rows[row] : row;
    }
    gen_reals(q->B, LD * R, seed);
    for (sl_int k = 0; k < nb; k++) {
        sl_int at = find(q->once_b, q->n_once_b, q->bset[k]);
        if (at == -1) {
            at = q->n_once_b++;
            q->once_b[at] = q->bset[k];
        }
        for (sl_int r = 0; r < R; r++) {
            q->once_B[at + LD * r] += q->B[k + LD * r];
        }
    }
    for (sl_int k = 0; k < nx; k++) {
        q->from[k] = find(q->once_x, q->n_once_x, q->xset[k]);
        if (q->from[k] == -1) {
            q->from[k] = q->n_once_x++;
            q->once_x[q->from[k]] = q->xset[k];
        }
    }
    return q;
}

static void question_answer(local_solve_t *q, const sl_plan *once, const sl_factor *F,
                            sl_int nrhs) {
    double X[LD * R];
    SL_CHECK(sl_plan_solve(once, F, X, LD, q->once_B, LD, nrhs, NULL));
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < q->nx; k++) {
            q->wanted[k + LD * r] = X[q->from[k] + LD * r];
        }
    }
}

static void assert_columns(const local_solve_t *q, const double *X, sl_int nrhs) {
    for (sl_int r = 0; r < nrhs; r++) {
        SAME_VALUES(X + LD * r, q->wanted + LD * r, (size_t)q->nx);
    }
}

static void assert_interleaved(const local_solve_t *q, const double *X, size_t ld, sl_int nrhs) {
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < q->nx; k++) {
            assert_true(same_value(X[(size_t)k * ld + (size_t)r], q->wanted[k + LD * r]));
        }
    }
}

/* Every form of a solve on a plan. */
static void check_plan(local_solve_t *q, const sl_plan *P, const sl_plan *once,
                       const sl_factor *F) {
    static double X[LD * R], B[LD * R];
    for (sl_int nrhs = 1; nrhs <= R; nrhs++) {
        size_t ld = (size_t)nrhs + 1;
        sl_request request = {P, X, LD, q->B, LD, nrhs, NULL};
        question_answer(q, once, F, nrhs);
        SL_CHECK(sl_plan_solve(P, F, X, LD, q->B, LD, nrhs, NULL));
        assert_columns(q, X, nrhs);
        memcpy(X, q->B, sizeof X); /* in place */
        SL_CHECK(sl_plan_solve(P, F, X, LD, X, LD, nrhs, NULL));
        assert_columns(q, X, nrhs);
        memset(X, 0, sizeof X);
        SL_CHECK(sl_batch_solve(F, &request, 1, NULL, NULL, NULL));
        assert_columns(q, X, nrhs);
        SL_CHECK(sl_plan_solve_regularized(P, F, X, LD, q->B, LD, nrhs, 2, NULL, NULL));
        assert_columns(q, X, nrhs);
        for (sl_int k = 0; k < q->nb; k++) {
            for (sl_int r = 0; r < nrhs; r++) {
                B[(size_t)k * ld + (size_t)r] = q->B[k + LD * r];
            }
        }
        SL_CHECK(sl_plan_solve(P, F, X, SL_ROWS(ld), B, SL_ROWS(ld), nrhs, NULL));
        assert_interleaved(q, X, ld, nrhs);
        SL_CHECK(sl_plan_solve(P, F, B, SL_ROWS(ld), B, SL_ROWS(ld), nrhs, NULL)); /* in place */
        assert_interleaved(q, B, ld, nrhs);
    }
}

static void plans_and_local_solves(void **state) {
    static const gen_kind_t kinds[5] = {GEN_GRID2, GEN_PATH, GEN_STAR, GEN_COMPONENTS, GEN_KKT};
    (void)state;
    isa_list_t isas = isas_present();
    for (int which = 0; which < 5 * isas.count; which++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[which / 5];
        factored_t y = factored_make(kinds[which % 5], N, 1, 0, &opt);
        sl_work *W = NULL;
        SL_CHECK(sl_work_create(&W, NULL));
        for (uint64_t seed = 1; seed < 5; seed++) {
            local_solve_t *q = question_make(NULL, y.M.view.n_cols, NB, NX, seed);
            sl_plan *P = NULL, *once = NULL;
            double X[LD * R];
            sl_stats stats, local, alone;
            memset(&stats, 0, sizeof stats);
            memset(&local, 0, sizeof local);
            memset(&alone, 0, sizeof alone);
            SL_CHECK(sl_plan_create(&P, y.S, q->bset, q->nb, q->xset, q->nx, NULL, &stats));
            SL_CHECK(sl_plan_create(&once, y.S, q->once_b, q->n_once_b, q->once_x, q->n_once_x,
                                    NULL, &alone));
            assert_true(stats.plan.b_entries == alone.plan.b_entries); /* the same reaches */
            assert_true(stats.plan.x_entries == alone.plan.x_entries);
            check_plan(q, P, once, y.F);
            for (sl_int nrhs = 1; nrhs <= R; nrhs++) {
                question_answer(q, once, y.F, nrhs);
                SL_CHECK(sl_local_solve(y.F, q->bset, q->nb, q->xset, q->nx, X, LD, q->B, LD, nrhs,
                                        W, &local));
                assert_columns(q, X, nrhs);
                assert_true(local.plan.b_columns == stats.plan.b_columns);
            }
            sl_plan_free(P);
            sl_plan_free(once);
            free(q);
        }
        sl_work_free(W);
        factored_free(&y);
    }
}

/* A b-set with more rows than A, and one with n rows that are not all rows. */
static void many_times_the_same_row(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_DIAGONAL, 10, 1, 0, NULL);
    enum { MANY = 64 };
    sl_int same[MANY], all[10];
    double B[MANY], X[MANY], one, sum = 0.0, two[2], b[10];
    for (int k = 0; k < MANY; k++) {
        same[k] = 7;
        B[k] = (k % 5) - 1.0;
        sum += B[k];
    }
    for (int k = 0; k < 10; k++) {
        all[k] = k < 9 ? k : 3; /* ten rows, but not all of them */
        b[k] = 1.0;
    }
    SL_CHECK(sl_local_solve(y.F, same, 1, same, 1, &one, 1, &sum, 1, 1, NULL, NULL));
    SL_CHECK(sl_local_solve(y.F, same, MANY, same, MANY, X, MANY, B, MANY, 1, NULL, NULL));
    for (int k = 0; k < MANY; k++) {
        assert_true(X[k] == one);
    }
    const sl_int asked[2] = {3, 9};
    SL_CHECK(sl_local_solve(y.F, all, 10, asked, 2, two, 2, b, 10, 1, NULL, NULL));
    sum = 2.0;
    SL_CHECK(sl_local_solve(y.F, asked, 1, asked, 1, &one, 1, &sum, 1, 1, NULL, NULL));
    assert_true(two[0] == one);
    assert_true(two[1] == 0.0); /* a row that is not in the set has b = 0 */
    factored_free(&y);
}

/* Some rows inside the subtrees, some in the boundary. */
static void regions(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    sl_int rows[25], width = 20;
    for (sl_int k = 0; k < 25; k++) {
        rows[k] = (7 + k / 5) * width + 7 + k % 5;
    }
    sl_region *region = NULL;
    sl_options opt = options_none();
    SL_CHECK(sl_region_create(&region, y.F, rows, 25, NULL, NULL, NULL));
    opt.region = region;
    for (uint64_t seed = 1; seed < 9; seed++) {
        local_solve_t *q = question_make(rows, 25, NB, NX, seed);
        sl_plan *P = NULL, *once = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_plan_create(&P, y.S, q->bset, q->nb, q->xset, q->nx, &opt, &stats));
        assert_true(stats.plan.in_region);
        SL_CHECK(
            sl_plan_create(&once, y.S, q->once_b, q->n_once_b, q->once_x, q->n_once_x, &opt, NULL));
        check_plan(q, P, once, y.F);
        sl_plan_free(P);
        sl_plan_free(once);
        free(q);
    }
    sl_region_free(region);
    factored_free(&y);
}

/* It is the sum that has to be consistent. */
static void consistency(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    factored_t y = factored_make(GEN_SINGULAR, N, 1, 0, &opt);
    const sl_int bset[4] = {5, 300, 5, 5}, once[2] = {5, 300}, xset[3] = {17, 5, 17};
    const double good[4] = {1e3, 2, -1e3, -2}, wrong[4] = {1e3, 2, -1e3, 2}, sums[2] = {-2, 2};
    double x[3] = {7, 7, 7}, wanted[3];
    sl_plan *P = NULL;
    SL_CHECK(sl_plan_create(&P, y.S, bset, 4, xset, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_INCONSISTENT, sl_plan_solve(P, y.F, x, 3, wrong, 4, 1, NULL));
    SL_EXPECT(SL_ERR_INCONSISTENT,
              sl_local_solve(y.F, bset, 4, xset, 3, x, 3, wrong, 4, 1, NULL, NULL));
    assert_true(x[0] == 7 && x[1] == 7 && x[2] == 7);
    SL_CHECK(sl_plan_solve(P, y.F, x, 3, good, 4, 1, NULL));
    SL_CHECK(sl_local_solve(y.F, once, 2, xset, 2, wanted, 2, sums, 2, 1, NULL, NULL));
    assert_true(x[0] == wanted[0] && x[1] == wanted[1] && x[2] == wanted[0]);
    sl_plan_free(P);
    factored_free(&y);
}

/* With a regularized factor: the same steps, the same backward error. */
static void refinement(void **state) {
    (void)state;
    enum { ROWS = 240 };
    kkt_t y = kkt_make(ROWS, 0, SL_ORDERING_ND);
    sl_options opt = options_none();
    sl_factor *F = NULL;
    sl_plan *P = NULL, *once = NULL;
    sl_int rows[ROWS], count, repeated[2 * ROWS];
    opt.regularization = 1e-7;
    opt.signs = y.signs;
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, rows, NULL, ROWS, &count));
    assert_true(count > 5);
    double *B = test_reals(2 * ROWS * R), *sums = test_reals(ROWS * R),
           *X = test_reals(2 * ROWS * R), *wanted = test_reals(ROWS * R);
    gen_reals(B, 2 * ROWS * R, 9);
    for (sl_int k = 0; k < 2 * count; k++) {
        repeated[k] = rows[k % count];
        for (sl_int r = 0; r < R; r++) {
            sums[k % count + ROWS * r] += B[k + 2 * ROWS * r];
        }
    }
    SL_CHECK(sl_plan_create(&P, y.S, repeated, 2 * count, repeated, 2 * count, NULL, NULL));
    SL_CHECK(sl_plan_create(&once, y.S, rows, count, rows, count, NULL, NULL));
    for (sl_int nrhs = 1; nrhs <= R; nrhs++) {
        sl_stats stats, alone;
        memset(&stats, 0, sizeof stats);
        memset(&alone, 0, sizeof alone);
        SL_CHECK(
            sl_plan_solve_regularized(once, F, wanted, ROWS, sums, ROWS, nrhs, 4, NULL, &alone));
        SL_CHECK(sl_plan_solve_regularized(P, F, X, 2 * ROWS, B, 2 * ROWS, nrhs, 4, NULL, &stats));
        for (sl_int r = 0; r < nrhs; r++) {
            SAME_VALUES(X + 2 * ROWS * r, wanted + ROWS * r, (size_t)count);
            SAME_VALUES(X + 2 * ROWS * r + count, wanted + ROWS * r, (size_t)count);
        }
        assert_true(alone.refine.steps > 0);
        assert_int_equal(stats.refine.steps, alone.refine.steps);
        assert_true(stats.refine.backward_error == alone.refine.backward_error);
    }
    free(B);
    free(sums);
    free(X);
    free(wanted);
    sl_plan_free(P);
    sl_plan_free(once);
    sl_factor_free(F);
    kkt_free(&y);
}

/* A row out of range is refused as before, also next to repeated ones. */
static void out_of_range(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    const sl_int bad[4] = {3, 3, 400, 3}, good[2] = {3, 3};
    sl_stats stats;
    sl_plan *P = NULL;
    double x[4], b[4] = {1, 1, 1, 1};
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_create(&P, y.S, bad, 4, good, 2, NULL, &stats));
    assert_null(P);
    assert_int_equal(stats.error.row, 400);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_local_solve(y.F, good, 2, bad, 4, x, 4, b, 4, 1, NULL, &stats));
    assert_int_equal(stats.error.row, 400);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plans_and_local_solves),
        cmocka_unit_test(many_times_the_same_row),
        cmocka_unit_test(regions),
        cmocka_unit_test(consistency),
        cmocka_unit_test(refinement),
        cmocka_unit_test(out_of_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
