/* test_bounds.c: sl_factor_certify, sl_plan_solve_bounded: bounds hold against exact solutions */
#include "tests/lib/bodies.h"
#include "tests/lib/exact_centered.h"
#include "tests/lib/followed.h"
#include "tests/lib/kkt.h"
#include "tests/lib/restricted.h"
#include "tests/lib/zero_mean.h"

typedef struct tally_t {
    int answers, violated;
    double tightest; /* the least bound / error */
} tally_t;

/* What the exact solutions are those of. */
typedef struct truth_t {
    const sl_factor *F; /* in double, without weights */
    const sl_csc *A;
    const int *hold;    /* rows of null pivots, or NULL */
    const double *mass; /* solutions have a mean of 0; or NULL: they are 0 in these rows */
    const double *z;    /* their null vector; NULL: constants */
    const sl_int *of;
} truth_t;

static void truth_solve(const truth_t *t, const double *b, twice_t *x) {
    if (t->mass) {
        exact_centered(t->F, t->A, b, t->mass, t->z, t->of, t->hold, x);
    } else {
        exact_solve(t->F, t->A, b, t->hold, x);
    }
}

/* Right-hand sides on `nb` rows, solved on all rows, and on some rows in one plan. */
static void judge_bounds(const sl_factor *F, const truth_t *truth, sl_int nrhs, tally_t *tally) {
    const sl_csc *A = truth->A;
    const int *hold = truth->mass ? NULL : truth->hold;
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
        truth_solve(truth, b, x);
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
    for (int storage = SL_STORAGE_DOUBLE; storage <= SL_STORAGE_FLOAT_FRONTS; storage++) {
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
        SL_CHECK(sl_plan_create(&P, y.S, NULL, 0, NULL, 0, NULL, NULL));
        for (sl_int nrhs = 7; nrhs <= MOST; nrhs += nrhs < 31 ? 8 : 1) {
            SL_CHECK(sl_plan_solve_bounded(P, y.F, X, ROWS, bounds, B, ROWS, nrhs, NULL, NULL,
                                           NULL));
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

/* The Laplacian L of a graph or, scaled, S^-1 L S^-1, whose null vector is z = S 1. */
static gen_matrix_t scaled_laplacian(int kind, int is_scaled, sl_int *of, double *z) {
    sl_int components = 0;
    gen_matrix_t M = laplacian_of(laplacian_kinds[kind], 100, 0, &components, of);
    uint64_t seed = 7;
    for (sl_int i = 0; i < M.view.n_cols; i++) {
        const double sign = gen_below(&seed, 2) ? 1.0 : -1.0;
        z[i] = is_scaled ? ldexp(sign, (int)gen_below(&seed, 9) - 4) : 1.0;
    }
    for (sl_int j = 0; j < M.view.n_cols; j++) {
        for (sl_int q = M.view.p[j]; q < M.view.p[j + 1]; q++) {
            M.x[q] /= z[j] * z[M.view.i[q]];
        }
    }
    return M;
}

/* The exact answer is the one that is 0 in the rows of the null pivots or, with weights, the one
 * whose weighted mean is 0 in every component. */
static void bounds_hold_with_null_pivots(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    tally_t tally[2] = {{0, 0, HUGE_VAL}, {0, 0, HUGE_VAL}};
    for (int k = 0; k < variants.count; k++) {
        for (int way = 0; way < 2 * LAPLACIAN_KINDS; way++) {
            sl_int *of = test_ints(130), rows[130], count = 0;
            double *z = test_reals(130), *m = weights(130, 3);
            gen_matrix_t M = scaled_laplacian(way / 2, way % 2, of, z);
            int *hold = (int *)test_array((size_t)M.view.n_cols, sizeof *hold);
            sl_options opt = options_skip_null(&variants, k);
            sl_symbolic *S = NULL;
            sl_factor *F = NULL;
            truth_t truth = {NULL, &M.view, hold, NULL, z, of};
            opt.consistency_tolerance = -1.0;
            opt.null_vector = z;
            SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
            SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, rows, NULL, 130, &count));
            for (sl_int j = 0; j < count; j++) {
                hold[rows[j]] = 1;
            }
            truth.F = F;
            for (int is_centered = 0; is_centered < 2; is_centered++) {
                for (int storage = SL_STORAGE_DOUBLE; storage <= SL_STORAGE_FLOAT; storage++) {
                    sl_factor *G = NULL;
                    opt.mass = truth.mass = is_centered ? m : NULL;
                    opt.storage = (sl_storage)storage;
                    opt.method = storage == SL_STORAGE_FLOAT ? SL_METHOD_AUTO : opt.method;
                    SL_CHECK(sl_factor_create(&G, S, &M.view, FOR_FACTOR(&opt), NULL));
                    SL_CHECK(sl_factor_certify(G, &M.view, SL_ESTIMATED, NULL, NULL));
                    judge_bounds(G, &truth, 5, &tally[is_centered]);
                    SL_EXPECT(SL_ERR_UNSUPPORTED,
                              sl_factor_certify(G, &M.view, SL_GUARANTEED, NULL, NULL));
                    sl_factor_free(G);
                }
            }
            sl_factor_free(F);
            sl_symbolic_free(S);
            gen_matrix_free(&M);
            free(hold);
            free(of);
            free(z);
            free(m);
        }
    }
    for (int m = 0; m < 2; m++) {
        print_message("%s: %d answers, bounds at least %.2f times the error\n",
                      m ? "weights" : "no weights", tally[m].answers, tally[m].tightest);
        assert_int_equal(tally[m].violated, 0);
        assert_true(tally[m].answers > 1000);
    }
}

/* Elastic bodies: 0 in as many rows as there are rigid motions. */
static void bounds_hold_with_several_null_vectors(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    tally_t tally = {0, 0, HUGE_VAL};
    for (int dim = 2; dim <= 3; dim++) {
        bodies_t f = bodies_make(dim, &variants, 0);
        int *hold = (int *)test_array(f.n, sizeof *hold);
        sl_options opt = f.opt;
        sl_factor *F = NULL;
        const truth_t truth = {f.F, &f.y.A, hold, NULL, NULL, NULL};
        for (sl_int k = 0; k < f.y.null; k++) {
            hold[f.nulls[k]] = 1;
        }
        opt.consistency_tolerance = -1.0;
        SL_CHECK(sl_factor_create(&F, f.S, &f.y.A, &opt, NULL));
        SL_CHECK(sl_factor_certify(F, &f.y.A, SL_ESTIMATED, NULL, NULL));
        judge_bounds(F, &truth, 5, &tally);
        sl_factor_free(F);
        bodies_free(&f);
        free(hold);
    }
    print_message("%d answers, bounds at least %.2f times the error\n", tally.answers,
                  tally.tightest);
    assert_int_equal(tally.violated, 0);
}

/* A restriction has no pattern to compare A[R, R] with; any triangle of it will do. */
static void bounds_hold_for_restrictions(void **state) {
    (void)state;
    tally_t tally = {0, 0, HUGE_VAL};
    for (int style = 0; style < GEN_STYLES; style++) {
        restricted_t t = restricted_make(GEN_GRID2, 150, 1, style, SUBSET_RANDOM, NULL);
        const truth_t truth = {t.G, &t.B.view, NULL, NULL, NULL, NULL};
        sl_csc other = t.B.view;
        SL_CHECK(sl_factor_certify(t.G, &t.B.view, SL_ESTIMATED, NULL, NULL));
        judge_bounds(t.G, &truth, 3, &tally);
        SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_certify(t.G, &t.B.view, SL_GUARANTEED, NULL, NULL));
        SL_EXPECT(SL_ERR_OTHER_PATTERN,
                  sl_factor_certify(t.G, &t.y.M.view, SL_ESTIMATED, NULL, NULL));
        other.x = NULL;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_certify(t.G, &other, SL_ESTIMATED, NULL, NULL));
        restricted_free(&t);
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
            SL_CHECK(sl_factor_change(y.F, NULL, &row, &row, &more, 1, NULL, NULL));
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
                                                      : SL_ERR_STATE,
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
        cmocka_unit_test(bounds_hold_with_null_pivots),
        cmocka_unit_test(bounds_hold_with_several_null_vectors),
        cmocka_unit_test(bounds_hold_for_restrictions),
        cmocka_unit_test(bounds_hold_after_edits_and_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
