/* test_bounds_nulls.c: bounds hold where null pivots are skipped: held rows, means of 0, bodies */
#include "tests/lib/bodies.h"
#include "tests/lib/true_bounds.h"
#include "tests/lib/zero_mean.h"

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_hold_with_null_pivots),
        cmocka_unit_test(bounds_hold_with_several_null_vectors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
