/* test_bounds.c: sl_factor_certify, sl_plan_solve_bounded: bounds hold against exact solutions */
#include "tests/lib/followed.h"
#include "tests/lib/submatrix.h"
#include "tests/lib/true_bounds.h"

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
                const truth_t truth = {exact.F, &y.M.view, NULL, NULL, NULL, NULL};
                for (int m = 0; m < 4; m++) {
                    judge_bounds(y.F, &truth, nrhs[m], tally);
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
    for (int storage = SL_STORAGE_DOUBLE; storage <= SL_STORAGE_FLOAT; storage++) {
        tally_t tally = {0, 0, HUGE_VAL};
        judge_kinds(&variants, (sl_storage)storage, SL_ESTIMATED, &tally);
        print_message("storage %d: %d answers, bounds at least %.2f times the error\n", storage,
                      tally.answers, tally.tightest);
        assert_int_equal(tally.violated, 0);
    }
}

/* A right-hand side in a block of 8, 16 or 32 has the bound that it has alone, up to rounding. */
static void bounds_in_blocks_are_those_alone(void **state) {
    (void)state;
    enum { MOST = 33, SIDE = 20, ROWS = SIDE * SIDE };
    variant_list_t variants = variants_present();
    double *B = test_reals(MOST * ROWS), *X = test_reals(MOST * ROWS),
           *bounds = test_reals(MOST * ROWS), *x = test_reals(ROWS), *alone = test_reals(ROWS);
    gen_reals(B, MOST * ROWS, 1);
    for (size_t k = 0; k < MOST * ROWS; k++) {
        B[k] *= pow(10.0, (double)(k / ROWS % 5)); /* bounds differ from column to column */
    }
    for (int v = 0; v < variants.count; v++) {
        sl_options opt = options_none();
        sl_plan *P = NULL;
        options_set_variant(&opt, &variants, v);
        factored_t y = factored_make(GEN_GRID2, ROWS, 1, 0, &opt);
        SL_CHECK(sl_factor_certify(y.F, &y.M.view, SL_ESTIMATED, NULL, NULL));
        SL_CHECK(sl_plan_create(&P, y.S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
        for (sl_int nrhs = 7; nrhs <= MOST; nrhs += nrhs < 31 ? 8 : 1) {
            SL_CHECK(
                sl_plan_solve_bounded(P, y.F, X, ROWS, bounds, B, ROWS, nrhs, NULL, NULL, NULL));
            for (sl_int r = 0; r < nrhs; r++) {
                SL_CHECK(sl_plan_solve_bounded(P, y.F, x, ROWS, alone, B + ROWS * r, ROWS, 1, NULL,
                                               NULL, NULL));
                for (sl_int k = 0; k < ROWS; k++) {
                    const double ratio = bounds[ROWS * r + k] / alone[k];
                    assert_true(ratio > 1 - 1e-6 && ratio < 1 + 1e-6);
                }
            }
        }
        sl_plan_free(P);
        factored_free(&y);
    }
    free(B);
    free(X);
    free(bounds);
    free(x);
    free(alone);
}

static void guaranteed_bounds_hold(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    tally_t tally = {0, 0, HUGE_VAL};
    judge_kinds(&variants, SL_STORAGE_DOUBLE, SL_GUARANTEED, &tally);
    print_message("%d answers, bounds at least %.0f times the error\n", tally.answers,
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

/* A restriction has no pattern to compare A[R, R] with; any triangle of it will do. */
static void bounds_hold_for_restrictions(void **state) {
    (void)state;
    tally_t tally = {0, 0, HUGE_VAL};
    for (int style = 0; style < GEN_STYLES; style++) {
        submatrix_t t = submatrix_make(GEN_GRID2, 150, 1, style, SUBSET_RANDOM, NULL);
        const truth_t truth = {t.G, &t.B.view, NULL, NULL, NULL, NULL};
        sl_csc other = t.B.view;
        SL_CHECK(sl_factor_certify(t.G, &t.B.view, SL_ESTIMATED, NULL, NULL));
        judge_bounds(t.G, &truth, 3, &tally);
        SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_certify(t.G, &t.B.view, SL_GUARANTEED, NULL, NULL));
        SL_EXPECT(SL_ERR_OTHER_PATTERN,
                  sl_factor_certify(t.G, &t.y.M.view, SL_ESTIMATED, NULL, NULL));
        other.x = NULL;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_certify(t.G, &other, SL_ESTIMATED, NULL, NULL));
        submatrix_free(&t);
    }
    assert_int_equal(tally.violated, 0);
}

/* Columns that were copied, computed again or changed: a certificate after it sees what is there.
 * Nothing is guaranteed of numbers that were not computed from A as a whole. */
static void bounds_hold_after_edits_and_changes(void **state) {
    (void)state;
    const edit_kind_t kind = {0, 1, 0, 1, EDIT_IN_ORDER};
    uint64_t random = 3;
    tally_t tally = {0, 0, HUGE_VAL};
    for (int storage = SL_STORAGE_DOUBLE; storage <= SL_STORAGE_FLOAT; storage++) {
        gen_list_t t = gen_make(GEN_GRID2, 3000, 1, 42);
        sl_int *unused = test_ints(3100);
        sl_options opt = options_none();
        sl_stats stats;
        followed_t y, z;
        opt.method = SL_METHOD_SUPERNODAL;
        opt.storage = (sl_storage)storage;
        y = followed_make(edited_list(&t, edit_kinds[0], unused, &random), 0, &opt);
        sl_int *new_of = test_ints((size_t)y.t.n + 1), p = y.A.view.p[70];
        z.t = edited_list(&y.t, kind, new_of, &random);
        z.A = gen_store(&z.t, gen_style(0), 1);
        z.S = NULL;
        z.F = NULL;
        SL_CHECK(sl_symbolic_edit(&z.S, y.S, &y.A.view, &z.A.view, new_of, NULL, NULL));
        SL_CHECK(sl_factor_edit(&z.F, y.F, z.S, &z.A.view, new_of, &opt, &stats));
        const sl_int row = y.A.view.i[p]; /* on the diagonal */
        const double more = 0.5;
        assert_int_equal(row, 70);
        if (storage == SL_STORAGE_DOUBLE) { /* L in float does not change */
            y.A.x[p] += more;
            SL_CHECK(sl_factor_change_entries(y.F, NULL, &row, &row, &more, 1, NULL, NULL));
        }
        for (int m = 0; m < 2; m++) {
            const followed_t *f = m ? &z : &y;
            sl_factor *exact = NULL;
            SL_CHECK(sl_factor_create(&exact, f->S, &f->A.view, NULL, NULL));
            const truth_t truth = {exact, &f->A.view, NULL, NULL, NULL, NULL};
            SL_CHECK(sl_factor_certify(f->F, &f->A.view, SL_ESTIMATED, NULL, NULL));
            judge_bounds(f->F, &truth, 3, &tally);
            SL_EXPECT(storage == SL_STORAGE_FLOAT     ? SL_ERR_UNSUPPORTED
                      : m == 1 && stats.reuse.is_anew ? SL_OK
                                                      : SL_ERR_MISMATCH,
                      sl_factor_certify(f->F, &f->A.view, SL_GUARANTEED, NULL, NULL));
            sl_factor_free(exact);
        }
        free(new_of);
        free(unused);
        gen_list_free(&t);
        followed_free(&y);
        followed_free(&z);
    }
    assert_int_equal(tally.violated, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(estimated_bounds_hold),
        cmocka_unit_test(estimated_bounds_hold_in_small_components),
        cmocka_unit_test(bounds_in_blocks_are_those_alone),
        cmocka_unit_test(guaranteed_bounds_hold),
        cmocka_unit_test(bounds_hold_for_restrictions),
        cmocka_unit_test(bounds_hold_after_edits_and_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
