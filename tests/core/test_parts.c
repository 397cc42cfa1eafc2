/* test_parts.c: half solves and products: against dense factors, and composed to whole solves */
#include "tests/lib/dense_reference.h"
#include "tests/lib/parts.h"

/* P, L, D, sqrt D, L' or P' of a factor: dense, n x n. */
static double *dense_part(const factored_t *y, unsigned part) {
    const sl_factor_arrays f = sl_factor_view(y->F);
    const sl_symbolic_arrays s = sl_symbolic_view(y->S);
    const sl_int n = s.n;
    double *M = test_reals((size_t)n * (size_t)n);
    sl_matrix *lower = NULL;
    sl_csc v;
    SL_CHECK(sl_factor_lower(&lower, y->F, NULL));
    v = sl_matrix_view(lower);
    for (sl_int k = 0; k < n; k++) {
        const double d = f.D[k] == DBL_MAX ? 0.0 : f.D[k];
        for (sl_int p = v.p[k]; (part == L || part == LT) && p < v.p[k + 1]; p++) {
            AT(M, part == L ? v.i[p] : k, part == L ? k : v.i[p]) = v.x[p];
        }
        if (part == D || part == ROOT) {
            AT(M, k, k) = part == D ? d : sqrt(d);
            if (part == D && f.E != NULL && f.E[k] != 0.0) {
                AT(M, k + 1, k) = AT(M, k, k + 1) = f.E[k];
            }
        } else if (part == P || part == PT) {
            AT(M, part == P ? k : s.perm[k], part == P ? s.perm[k] : k) = 1.0;
        }
    }
    sl_matrix_free(lower);
    return M;
}

/* Multiplying by one part gives the product with the dense matrix; solving takes it back. Both
 * apply P and P' alike, so that the other one of the two takes a permutation back. */
static void check_one_part(const factored_t *y, unsigned part) {
    const unsigned back = part == P ? PT : part == PT ? P : part;
    const sl_int n = y->M.view.n_cols;
    const size_t ld = n > 0 ? (size_t)n : 1;
    double *M = dense_part(y, part), *B = test_reals(ld * MOST), *X = test_reals(ld * MOST);
    /* the inverses of 2x2 pivots are explicit, and so their residuals grow with the condition */
    const double allowed = part == D && sl_factor_view(y->F).E != NULL ? 1e3 : 16.0 * (n + 1);
    gen_reals(B, ld * MOST, 3);
    for (sl_int nrhs = 0; nrhs <= MOST; nrhs++) {
        SL_CHECK(sl_factor_multiply_part(y->F, part, X, ld, B, ld, nrhs, NULL));
        for (sl_int r = 0; r < nrhs; r++) {
            for (sl_int i = 0; i < n; i++) {
                double sum = 0.0, size = 0.0;
                for (sl_int j = 0; j < n; j++) {
                    sum += AT(M, i, j) * AT(B, j, r);
                    size += fabs(AT(M, i, j) * AT(B, j, r));
                }
                assert_true(fabs(AT(X, i, r) - sum) <= 4.0 * (n + 1) * DBL_EPSILON * size);
            }
        }
        /* back, in place; the residual of a triangular solve is small against |M| |x| */
        double *Z = test_reals(ld * MOST);
        SL_CHECK(sl_factor_solve_part(y->F, NULL, back, Z, ld, X, ld, nrhs, NULL));
        for (sl_int r = 0; r < nrhs; r++) {
            for (sl_int i = 0; i < n; i++) {
                double sum = 0.0, size = fabs(AT(X, i, r));
                for (sl_int j = 0; j < n; j++) {
                    sum += AT(M, i, j) * AT(Z, j, r);
                    size += fabs(AT(M, i, j) * AT(Z, j, r));
                }
                assert_true(fabs(AT(X, i, r) - sum) <= allowed * DBL_EPSILON * size);
            }
        }
        SL_CHECK(sl_factor_solve_part(y->F, NULL, back, X, ld, X, ld, nrhs, NULL));
        SAME_VALUES(X, Z, (size_t)n * (size_t)nrhs);
        free(Z);
    }
    free(M);
    free(B);
    free(X);
}

static void parts_are_those_of_dense_factors(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < KINDS * variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k / KINDS);
        factored_t y = factored_make(kinds[k % KINDS], 60, 1, 0, &opt);
        static const unsigned each[] = {P, L, D, LT, PT, ROOT};
        for (size_t q = 0; q < (kinds[k % KINDS] == GEN_KKT ? 5u : 6u); q++) {
            check_one_part(&y, each[q]);
        }
        factored_free(&y);
    }
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        factored_t y = hollow_make(60, isas.isa[k]);
        static const unsigned each[] = {P, L, D, LT, PT};
        for (size_t q = 0; q < 5; q++) {
            check_one_part(&y, each[q]);
        }
        factored_free(&y);
    }
}

/* One after the other, in halves, or all at once: the bits of sl_factor_solve. */
static void check_composition(const factored_t *y) {
    static const unsigned ways[][6] = {
        {ALL}, {P | L, D | LT | PT}, {P | L | D, LT | PT}, {P, L, D, LT, PT}, {P | L, D, LT | PT}};
    const sl_int n = y->M.view.n_cols;
    const size_t ld = n > 0 ? (size_t)n : 1;
    double *B = test_reals(ld * MOST), *X = test_reals(ld * MOST), *Y = test_reals(ld * MOST);
    gen_reals(B, ld * MOST, 7);
    for (sl_int nrhs = 0; nrhs <= MOST; nrhs++) {
        SL_CHECK(sl_factor_solve(y->F, X, ld, B, ld, nrhs, NULL));
        for (size_t w = 0; w < sizeof ways / sizeof ways[0]; w++) {
            memcpy(Y, B, ld * MOST * sizeof *B);
            for (size_t k = 0; k < 6 && ways[w][k] != 0; k++) {
                SL_CHECK(sl_factor_solve_part(y->F, NULL, ways[w][k], Y, ld, Y, ld, nrhs, NULL));
            }
            SAME_VALUES(Y, X, (size_t)n * (size_t)nrhs);
            SAME_VALUES(Y + (size_t)n * (size_t)nrhs, B + (size_t)n * (size_t)nrhs,
                        (size_t)n * (size_t)(MOST - nrhs));
        }
        SL_CHECK(sl_factor_solve_part(y->F, NULL, 0, Y, ld, B, ld, nrhs, NULL));
        SAME_VALUES(Y, B, (size_t)n * (size_t)nrhs);
    }
    /* all parts of the product: A B */
    SL_CHECK(sl_factor_multiply_part(y->F, ALL, X, ld, B, ld, MOST, NULL));
    SL_CHECK(sl_csc_multiply(&y->M.view, SL_AS_SYMMETRIC, Y, ld, B, ld, MOST));
    for (size_t k = 0; k < (size_t)n * MOST; k++) {
        assert_true(fabs(X[k] - Y[k]) <= 1e-9 * (1.0 + fabs(Y[k])));
    }
    free(B);
    free(X);
    free(Y);
}

static void parts_make_up_the_solve(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < KINDS * variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k / KINDS);
        factored_t y = factored_make(kinds[k % KINDS], 250, 1, 0, &opt);
        check_composition(&y);
        factored_free(&y);
    }
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        factored_t y = hollow_make(200, isas.isa[k]);
        check_composition(&y);
        factored_free(&y);
    }
}

/* ---- local halves ---- */

enum { NB = 9, NX = 13 };

static void check_local_halves(const factored_t *y, unsigned scale, sl_int nrhs) {
    const sl_int n = y->M.view.n_cols;
    const size_t ld = (size_t)n;
    sl_int bset[NB], xset[NX], count = 0, *columns = test_ints(ld);
    double *B = test_reals(ld * MOST), *X = test_reals(ld * MOST), *full = test_reals(ld * MOST);
    sl_plan *plan = NULL;
    sl_stats stats;
    for (sl_int k = 0; k < NB; k++) {
        bset[k] = (11 * k + 3) % n;
    }
    for (sl_int k = 0; k < NX; k++) {
        xset[k] = (7 * k) % n;
    }
    bset[NB - 1] = bset[0]; /* a row given twice adds up */
    SL_CHECK(sl_plan_create(&plan, y->S, bset, NB, xset, NX, NULL, &stats));

    double *local = test_reals(NB * MOST);
    gen_reals(local, NB * MOST, 9);
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < NB; k++) {
            AT(B, bset[k], r) += local[k + NB * r];
        }
    }
    SL_CHECK(sl_factor_solve_part(y->F, NULL, P | L | scale, full, ld, B, ld, nrhs, NULL));
    SL_CHECK(sl_plan_columns(plan, SL_PART_L, columns, n, &count));
    assert_int_equal(count, stats.plan.b_columns);
    SL_CHECK(sl_factor_solve_part(y->F, plan, P | L | scale, X, ld, local, NB, nrhs, NULL));
    for (sl_int r = 0; r < nrhs; r++) {
        sl_int k = 0;
        for (sl_int i = 0; i < n; i++) {
            if (k < count && columns[k] == i) {
                assert_true(AT(X, k, r) == AT(full, i, r));
                k++;
            } else {
                assert_true(AT(full, i, r) == 0.0);
            }
        }
        assert_int_equal(k, count);
    }
    free(local);

    gen_reals(B, ld * MOST, 4);
    SL_CHECK(sl_factor_solve_part(y->F, NULL, scale | LT | PT, full, ld, B, ld, nrhs, NULL));
    SL_CHECK(sl_plan_columns(plan, SL_PART_LT, columns, n, &count));
    assert_int_equal(count, stats.plan.x_columns);
    local = test_reals((size_t)count * MOST);
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < count; k++) {
            local[k + count * r] = AT(B, columns[k], r);
        }
    }
    SL_CHECK(
        sl_factor_solve_part(y->F, plan, scale | LT | PT, X, NX, local, (size_t)count, nrhs, NULL));
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < NX; k++) {
            assert_true(X[k + NX * r] == AT(full, xset[k], r));
        }
    }
    free(local);
    sl_plan_free(plan);
    free(columns);
    free(B);
    free(X);
    free(full);
}

static void local_halves_are_rows_of_full_ones(void **state) {
    (void)state;
    static const unsigned scales[] = {0, D, ROOT};
    static const gen_kind_t some[] = {GEN_GRID2, GEN_GRID3, GEN_FOREST, GEN_COMPONENTS};
    variant_list_t variants = variants_present();
    for (int k = 0; k < 4 * variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k / 4);
        factored_t y = factored_make(some[k % 4], 300, 1, 0, &opt);
        for (sl_int nrhs = 0; nrhs <= MOST; nrhs += nrhs < 5 ? 1 : 3) {
            for (size_t q = 0; q < 3; q++) {
                check_local_halves(&y, scales[q], nrhs);
            }
        }
        factored_free(&y);
    }
    factored_t y = hollow_make(200, SL_ISA_AUTO);
    check_local_halves(&y, 0, 3);
    check_local_halves(&y, D, 2);
    factored_free(&y);
}

/* X = P' L'^-1 D^(-1/2) I has X X' = A^-1: unit vectors in place of normal ones. */
static void samples_have_the_covariance_of_the_inverse(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 49, 1, 0, NULL);
    const sl_int n = y.M.view.n_cols;
    const size_t ld = (size_t)n;
    double *dense = ref_dense(&y.M.view), *inverse = ref_inverse(n, dense);
    double *I = test_reals(ld * ld), *X = test_reals(ld * ld), *Y = test_reals(ld * ld);
    for (sl_int k = 0; k < n; k++) {
        AT(I, k, k) = 1.0;
    }
    SL_CHECK(sl_factor_solve_part(y.F, NULL, ROOT | LT | PT, X, ld, I, ld, n, NULL));
    SL_CHECK(sl_factor_multiply_part(y.F, ROOT | L | PT, Y, ld, I, ld, n, NULL));
    for (sl_int i = 0; i < n; i++) {
        for (sl_int j = 0; j < n; j++) {
            double covariance = 0.0, precision = 0.0;
            for (sl_int k = 0; k < n; k++) {
                covariance += AT(X, i, k) * AT(X, j, k);
                precision += AT(Y, i, k) * AT(Y, j, k);
            }
            assert_true(fabs(covariance - AT(inverse, i, j)) <= 1e-12 * AT(inverse, i, i));
            assert_true(fabs(precision - AT(dense, i, j)) <= 1e-13 * AT(dense, i, i));
        }
    }
    free(dense);
    free(inverse);
    free(I);
    free(X);
    free(Y);
    factored_free(&y);
}

/* Skipped null pivots count as 0: D^-1 is the pseudo-inverse. */
static void null_pivots_give_zeros(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    factored_t y = factored_make(GEN_SINGULAR, 90, 1, 0, &opt);
    const sl_int n = y.M.view.n_cols;
    double *B = test_reals((size_t)n), *X = test_reals((size_t)n), *Y = test_reals((size_t)n);
    gen_reals(B, (size_t)n, 2);
    sl_int nulls = 0;
    static const unsigned both[] = {D, ROOT};
    for (int q = 0; q < 2; q++) {
        SL_CHECK(sl_factor_solve_part(y.F, NULL, both[q], X, (size_t)n, B, (size_t)n, 1, NULL));
        SL_CHECK(sl_factor_multiply_part(y.F, both[q], Y, (size_t)n, B, (size_t)n, 1, NULL));
        for (sl_int k = 0; k < n; k++) {
            const int is_null = sl_factor_view(y.F).D[k] == DBL_MAX;
            assert_int_equal(is_null, X[k] == 0.0);
            assert_int_equal(is_null, Y[k] == 0.0);
            nulls += is_null;
        }
    }
    assert_true(nulls > 0);
    /* a consistent right-hand side: all parts give a solution */
    SL_CHECK(sl_csc_multiply(&y.M.view, SL_AS_SYMMETRIC, Y, (size_t)n, B, (size_t)n, 1));
    SL_CHECK(sl_factor_solve_part(y.F, NULL, ALL, X, (size_t)n, Y, (size_t)n, 1, NULL));
    BACKWARD_PASSES(&y.M.view, X, (size_t)n, Y, (size_t)n, 1);
    free(B);
    free(X);
    free(Y);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_those_of_dense_factors),
        cmocka_unit_test(parts_make_up_the_solve),
        cmocka_unit_test(local_halves_are_rows_of_full_ones),
        cmocka_unit_test(samples_have_the_covariance_of_the_inverse),
        cmocka_unit_test(null_pivots_give_zeros),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
