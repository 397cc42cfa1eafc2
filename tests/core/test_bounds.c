/* test_bounds.c: sl_factor_certify, sl_plan_solve_bounded: bounds hold against exact solutions */
#include "tests/lib/exact_solve.h"
#include "tests/lib/factored.h"
#include "tests/lib/graph_laplacian.h"
#include "tests/lib/kkt.h"

typedef struct tally_t {
    size_t answers, violated;
    double tightest; /* the least bound / error */
} tally_t;

/* Right-hand sides on `nb` rows, solved on all rows, and on some rows in one plan. */
static void judge_bounds(const sl_factor *F, const sl_factor *exact, const sl_csc *A, sl_int nrhs,
                         const int *hold, tally_t *tally) {
    const sl_int n = A->n_cols, nb = n < 3 ? n : 3;
    const size_t rows = (size_t)n, count = rows * (size_t)nrhs;
    sl_int *bset = test_ints(rows);
    double B[3 * 40], *X = test_reals(count), *Y = test_reals(count), *bounds = test_reals(count);
    double *again = test_reals(count), *b = test_reals(rows), *scales = test_reals(4 * rows + 2);
    twice_t *x = (twice_t *)test_array(rows, sizeof *x);
    const sl_symbolic *S = sl_factor_view(F).symbolic;
    sl_plan *P = NULL;
    gen_set(bset, nb, n, (uint64_t)nrhs);
    gen_reals(B, 3 * 40, (uint64_t)nrhs + 1);
    for (sl_int k = 0; k < nb && hold; k++) {
        for (sl_int r = 0; r < nrhs && hold[bset[k]]; r++) {
            B[k + nb * r] = 0.0;
        }
    }
    SL_CHECK(sl_plan_create(&P, S, bset, nb, NULL, 0, NULL, NULL));
    for (int turn = 0; turn < 2; turn++) { /* the second one finds the scales */
        sl_stats stats;
        SL_CHECK(sl_plan_solve_bounded(P, F, X, rows, turn ? again : bounds, B, (size_t)nb, nrhs,
                                       scales, NULL, &stats));
        assert_true(stats.certificate.eta > 0.0);
    }
    assert_memory_equal(bounds, again, count * sizeof *bounds);
    SL_CHECK(sl_plan_solve(P, F, Y, rows, B, (size_t)nb, nrhs, NULL));
    assert_memory_equal(X, Y, count * sizeof *X);
    /* by rows, with scales of this call alone */
    SL_CHECK(sl_plan_solve_bounded(P, F, Y, SL_ROWS((size_t)nrhs), again, B, (size_t)nb, nrhs, NULL,
                                   NULL, NULL));
    for (sl_int r = 0; r < nrhs; r++) {
        memset(b, 0, rows * sizeof *b);
        for (sl_int k = 0; k < nb; k++) {
            b[bset[k]] += B[k + nb * r];
        }
        exact_solve(exact, A, b, hold, x);
        for (sl_int i = 0; i < n; i++) {
            const size_t at = (size_t)i + rows * (size_t)r;
            const double error = fabs((x[i].high - X[at]) + x[i].low);
            assert_true(again[(size_t)i * (size_t)nrhs + (size_t)r] == bounds[at]);
            tally->answers++;
            tally->violated += !(error <= bounds[at]);
            tally->tightest =
                error > 0.0 ? fmin(tally->tightest, bounds[at] / error) : tally->tightest;
        }
    }
    sl_plan_free(P);
    free(X);
    free(Y);
    free(bounds);
    free(again);
    free(b);
    free(scales);
    free(x);
    free(bset);
}

/* All definite kinds of matrices. Their factor in double solves exactly. */
static void judge_kinds(const variant_list_t *variants, sl_storage storage, sl_certainty certainty,
                        tally_t *tally) {
    static const sl_int nrhs[4] = {1, 3, 9, 33};
    for (int k = 0; k < variants->count; k++) {
        for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
            sl_options opt = options_none();
            sl_stats stats;
            sl_status status;
            if (kind == GEN_KKT) {
                continue;
            }
            options_set_variant(&opt, variants, k);
            factored_t exact = factored_make((gen_kind_t)kind, 130, 1, 0, &opt);
            opt.storage = storage;
            factored_t y = factored_make((gen_kind_t)kind, 130, 1, 0, &opt);
            status = sl_factor_certify(y.F, &y.M.view, certainty, NULL, &stats);
            if (status == SL_ERR_INACCURATE && kind == GEN_SCALED) { /* nearly singular in float */
                assert_int_not_equal(storage, SL_STORAGE_DOUBLE);
            } else {
                assert_int_equal(status, SL_OK);
                assert_true(stats.certificate.certainty == certainty);
                for (int m = 0; m < 4; m++) {
                    judge_bounds(y.F, exact.F, &y.M.view, nrhs[m], NULL, tally);
                }
            }
            factored_free(&exact);
            factored_free(&y);
        }
    }
}

static void estimated_bounds_hold(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int storage = SL_STORAGE_DOUBLE; storage <= SL_STORAGE_FLOAT_FRONTS; storage++) {
        tally_t tally = {0, 0, HUGE_VAL};
        judge_kinds(&variants, (sl_storage)storage, SL_ESTIMATED, &tally);
        print_message("storage %d: %zu answers, bounds at least %.2f times the error\n", storage,
                      tally.answers, tally.tightest);
        assert_int_equal(tally.violated, 0);
    }
}

static void guaranteed_bounds_hold(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    tally_t tally = {0, 0, HUGE_VAL};
    judge_kinds(&variants, SL_STORAGE_DOUBLE, SL_GUARANTEED, &tally);
    print_message("%zu answers, bounds at least %.0f times the error\n", tally.answers,
                  tally.tightest);
    assert_int_equal(tally.violated, 0);
    assert_true(tally.tightest > 10.0);
}

/* Every solve stays within one of many small components: the worst one is within its bound. */
static void estimated_bounds_hold_in_small_components(void **state) {
    (void)state;
    enum { PARTS = 1000, ROWS = 3 * PARTS };
    uint64_t random = 4;
    gen_list_t t = gen_list(ROWS);
    double *b = test_reals(ROWS), x[3], bounds[3], tightest = HUGE_VAL;
    twice_t *exact = (twice_t *)test_array(ROWS, sizeof *exact);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_work *W = NULL;
    for (sl_int i = 0; i < ROWS; i++) {
        for (sl_int j = i - i % 3; j <= i; j++) {
            const double a = gen_real(&random);
            gen_add(&t, i, j, i == j ? 1.0 + fabs(a) : 0.1 * a);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_certify(F, &M.view, SL_ESTIMATED, NULL, NULL));
    SL_CHECK(sl_work_create(&W, NULL));
    for (uint64_t turn = 0; turn < 4; turn++) {
        gen_reals(b, ROWS, turn);
        exact_solve(F, &M.view, b, NULL, exact);
        for (sl_int part = 0; part < PARTS; part++) {
            const sl_int set[3] = {3 * part, 3 * part + 1, 3 * part + 2};
            sl_plan *P = NULL;
            SL_CHECK(sl_plan_create(&P, S, set, 3, set, 3, NULL, NULL));
            SL_CHECK(sl_plan_solve_bounded(P, F, x, 3, bounds, b + set[0], 3, 1, NULL, W, NULL));
            for (int k = 0; k < 3; k++) {
                const twice_t z = exact[set[k]];
                const double error = fabs((z.high - x[k]) + z.low);
                tightest = error > 0.0 ? fmin(tightest, bounds[k] / error) : tightest;
            }
            sl_plan_free(P);
        }
    }
    print_message("bounds at least %.2f times the error\n", tightest);
    assert_true(tightest >= 1.0);
    sl_work_free(W);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    free(exact);
    free(b);
}

/* The exact answer is the one that is 0 in the rows of the null pivots. */
static void bounds_hold_with_skipped_null_pivots(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    tally_t tally = {0, 0, HUGE_VAL};
    for (int k = 0; k < variants.count; k++) {
        for (int kind = 0; kind < LAPLACIAN_KINDS; kind++) {
            sl_int components = 0, rows[130], count = 0;
            gen_matrix_t M = laplacian(laplacian_kinds[kind], 100, 0, &components);
            const sl_int n = M.view.n_cols;
            int *hold = (int *)test_array((size_t)n, sizeof *hold);
            sl_options opt = options_skip_null(&variants, k);
            sl_symbolic *S = NULL;
            sl_factor *F = NULL;
            opt.consistency_tolerance = -1.0;
            SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
            SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, rows, NULL, 130, &count));
            assert_int_equal(count, components);
            for (sl_int m = 0; m < count; m++) {
                hold[rows[m]] = 1;
            }
            SL_CHECK(sl_factor_certify(F, &M.view, SL_ESTIMATED, NULL, NULL));
            judge_bounds(F, F, &M.view, 5, hold, &tally);
            SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_certify(F, &M.view, SL_GUARANTEED, NULL, NULL));
            sl_factor_free(F);
            sl_symbolic_free(S);
            gen_matrix_free(&M);
            free(hold);
        }
    }
    assert_int_equal(tally.violated, 0);
    assert_true(tally.answers > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(estimated_bounds_hold),
        cmocka_unit_test(estimated_bounds_hold_in_small_components),
        cmocka_unit_test(guaranteed_bounds_hold),
        cmocka_unit_test(bounds_hold_with_skipped_null_pivots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
