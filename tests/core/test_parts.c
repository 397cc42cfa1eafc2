/* test_parts.c: half solves and products: against dense factors, and composed to whole solves */
#include "tests/lib/dense_reference.h"
#include "tests/lib/factored.h"

enum { P = SL_PART_P, L = SL_PART_L, D = SL_PART_D, ROOT = SL_PART_SQRT_D, LT = SL_PART_LT };
enum { PT = SL_PART_PT, ALL = P | L | D | LT | PT, MOST = 11 };

static const gen_kind_t kinds[] = {GEN_NONE,  GEN_ONE,   GEN_DIAGONAL, GEN_PATH,   GEN_STAR,
                                   GEN_GRID2, GEN_GRID3, GEN_FOREST,   GEN_DENSE,  GEN_RANDOM,
                                   GEN_KKT,   GEN_COMPONENTS};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* An indefinite system without a diagonal: it has 2x2 pivots. */
static factored_t hollow_make(sl_int n, sl_isa isa) {
    gen_list_t t = gen_list(n);
    sl_options opt = options_none();
    uint64_t seed = 5;
    factored_t y;
    for (sl_int k = 1; k < n; k++) {
        gen_add(&t, k, k - 1, 1.0 + gen_real(&seed));
        if (k > 9) {
            gen_add(&t, k, k - 9, gen_real(&seed));
        }
    }
    y.M = gen_store(&t, gen_style(0), 1);
    y.S = NULL;
    y.F = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&y.S, &y.M.view, NULL, NULL));
    opt.isa = isa;
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
    assert_non_null(sl_factor_view(y.F).E);
    gen_list_free(&t);
    return y;
}

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
        SL_CHECK(sl_factor_solve_part(y->F, back, Z, ld, X, ld, nrhs, NULL));
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
        SL_CHECK(sl_factor_solve_part(y->F, back, X, ld, X, ld, nrhs, NULL));
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
                SL_CHECK(sl_factor_solve_part(y->F, ways[w][k], Y, ld, Y, ld, nrhs, NULL));
            }
            SAME_VALUES(Y, X, (size_t)n * (size_t)nrhs);
            SAME_VALUES(Y + (size_t)n * (size_t)nrhs, B + (size_t)n * (size_t)nrhs,
                        (size_t)n * (size_t)(MOST - nrhs));
        }
        SL_CHECK(sl_factor_solve_part(y->F, 0, Y, ld, B, ld, nrhs, NULL));
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
    SL_CHECK(sl_factor_solve_part(y->F, P | L | scale, full, ld, B, ld, nrhs, NULL));
    SL_CHECK(sl_plan_columns(plan, SL_PART_L, columns, n, &count));
    assert_int_equal(count, stats.plan.b_columns);
    SL_CHECK(sl_plan_solve_part(plan, y->F, P | L | scale, X, ld, local, NB, nrhs, NULL));
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
    SL_CHECK(sl_factor_solve_part(y->F, scale | LT | PT, full, ld, B, ld, nrhs, NULL));
    SL_CHECK(sl_plan_columns(plan, SL_PART_LT, columns, n, &count));
    assert_int_equal(count, stats.plan.x_columns);
    local = test_reals((size_t)count * MOST);
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < count; k++) {
            local[k + count * r] = AT(B, columns[k], r);
        }
    }
    SL_CHECK(sl_plan_solve_part(plan, y->F, scale | LT | PT, X, NX, local, (size_t)count, nrhs,
                                NULL));
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
    SL_CHECK(sl_factor_solve_part(y.F, ROOT | LT | PT, X, ld, I, ld, n, NULL));
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
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    factored_t y = factored_make(GEN_SINGULAR, 90, 1, 0, &opt);
    const sl_int n = y.M.view.n_cols;
    double *B = test_reals((size_t)n), *X = test_reals((size_t)n), *Y = test_reals((size_t)n);
    gen_reals(B, (size_t)n, 2);
    sl_int nulls = 0;
    static const unsigned both[] = {D, ROOT};
    for (int q = 0; q < 2; q++) {
        SL_CHECK(sl_factor_solve_part(y.F, both[q], X, (size_t)n, B, (size_t)n, 1, NULL));
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
    SL_CHECK(sl_factor_solve_part(y.F, ALL, X, (size_t)n, Y, (size_t)n, 1, NULL));
    BACKWARD_PASSES(&y.M.view, X, (size_t)n, Y, (size_t)n, 1);
    free(B);
    free(X);
    free(Y);
    factored_free(&y);
}

/* ---- refusals, memory ---- */

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 25, 1, 0, NULL);
    factored_t k = factored_make(GEN_KKT, 40, 1, 0, NULL);
    factored_t h = hollow_make(40, SL_ISA_AUTO);
    double X[40], B[40] = {0};
    sl_plan *plan = NULL, *inside = NULL;
    sl_region *region = NULL;
    sl_work *W = NULL;
    sl_int rows[2] = {3, 4}, columns[25], count = -1;
    SL_CHECK(sl_plan_create(&plan, y.S, rows, 2, rows, 2, NULL, NULL));
    X[0] = 77.0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(NULL, L, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, 64, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, D | ROOT, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, L, X, 24, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, L, X, 25, NULL, 25, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_solve_part(y.F, L, X, 25, B, 25, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_multiply_part(y.F, ALL | 64, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_solve_part(k.F, ROOT | LT, X, 40, B, 40, 1, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_solve_part(h.F, ROOT, X, 40, B, 40, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve_part(NULL, y.F, P | L, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve_part(plan, y.F, L, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve_part(plan, y.F, ALL, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve_part(plan, y.F, P | L, X, 1, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve_part(plan, y.F, P | L | D | ROOT, X, 25, B, 2, 1,
                                                  NULL));
    SL_EXPECT(SL_ERR_STATE, sl_plan_solve_part(plan, k.F, P | L, X, 40, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(plan, SL_PART_D, columns, 25, &count));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(plan, SL_PART_L, NULL, 25, &count));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(plan, SL_PART_L, columns, 25, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(NULL, SL_PART_L, columns, 25, &count));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_columns(plan, SL_PART_L, columns, -1, &count));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_solve_part(plan, NULL, P | L, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_part(NULL, y.F, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_plan_part(NULL, plan, 1));
    SL_CHECK(sl_work_create(&W, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_part(W, y.F, -1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_part(W, NULL, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_plan_part(W, NULL, 1));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_work_reserve_plan_part(W, plan, -1));
    assert_true(X[0] == 77.0);
    sl_work_free(W);
    columns[1] = -7; /* not written beyond the capacity */
    SL_CHECK(sl_plan_columns(plan, SL_PART_L, columns, 1, &count));
    assert_true(count > 1 && columns[1] == -7);
    SL_CHECK(sl_plan_columns(plan, SL_PART_L, NULL, 0, &count));

    /* in a region the sweeps end below the roots */
    SL_CHECK(sl_region_create(&region, y.F, rows, 2, NULL, NULL, NULL));
    sl_options opt = options_none();
    opt.region = region;
    SL_CHECK(sl_plan_create(&inside, y.S, rows, 2, rows, 2, &opt, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_plan_solve_part(inside, y.F, P | L, X, 25, B, 2, 1, NULL));
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_plan_columns(inside, SL_PART_L, columns, 25, &count));
    sl_plan_free(inside);
    sl_region_free(region);

    y.M.x[0] = NAN; /* a failed factor */
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_STATE, sl_factor_solve_part(y.F, L, X, 25, B, 25, 1, NULL));
    SL_EXPECT(SL_ERR_STATE, sl_plan_solve_part(plan, y.F, P | L, X, 25, B, 2, 1, NULL));
    sl_plan_free(plan);
    factored_free(&y);
    factored_free(&k);
    factored_free(&h);
}

/* A pair of columns has no square root in D, even if it is definite. */
static void roots_of_pairs_are_unsupported(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    double x[3] = {0.0, 1.0, 0.0}, X[2] = {7.0, 7.0};
    const double B[2] = {1.0, 1.0};
    const sl_csc A = {2, 2, p, i, x};
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, &stats));
    assert_int_equal(stats.symbolic.pairs, 1);
    x[0] = x[2] = 2.0;
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, &stats));
    assert_int_equal(stats.factor.negative, 0);
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_solve_part(F, ROOT, X, 2, B, 2, 1, NULL));
    assert_true(X[0] == 7.0 && X[1] == 7.0);
    SL_CHECK(sl_factor_solve_part(F, ALL, X, 2, B, 2, 1, NULL));
    assert_true(fabs(X[0] - 1.0 / 3.0) <= 1e-15 && fabs(X[1] - 1.0 / 3.0) <= 1e-15);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void reserved_workspaces_do_not_grow(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        factored_t y = factored_make(kinds[kind], 200, 1, 0, NULL);
        const sl_int n = y.M.view.n_cols, rows = n < 5 ? n : 5;
        const size_t ld = n > 0 ? (size_t)n : 1;
        sl_int set[5] = {0, 1, 2, 3, 4};
        double *B = test_reals(ld * MOST), *X = test_reals(ld * MOST);
        sl_plan *plan = NULL;
        SL_CHECK(sl_plan_create(&plan, y.S, set, rows, NULL, 0, NULL, NULL));
        for (sl_int most = 0; most <= MOST; most++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            for (int local = 0; local < 2; local++) {
                sl_work *W = NULL;
                SL_CHECK(sl_work_create(&W, &opt));
                SL_CHECK(local ? sl_work_reserve_plan_part(W, plan, most)
                               : sl_work_reserve_part(W, y.F, most));
                const size_t calls = counter.calls;
                for (sl_int nrhs = 0; nrhs <= most; nrhs++) {
                    if (local) {
                        SL_CHECK(sl_plan_solve_part(plan, y.F, P | L, X, ld, B, ld, nrhs, W));
                        SL_CHECK(sl_plan_solve_part(plan, y.F, LT | PT, X, ld, B, ld, nrhs, W));
                    } else {
                        SL_CHECK(sl_factor_solve_part(y.F, ALL, X, ld, B, ld, nrhs, W));
                        SL_CHECK(sl_factor_multiply_part(y.F, LT, X, ld, B, ld, nrhs, W));
                    }
                }
                assert_int_equal(counter.calls, calls);
                sl_work_free(W);
            }
            COUNTER_CLEAN(&counter);
        }
        sl_plan_free(plan);
        free(B);
        free(X);
        factored_free(&y);
    }
}

static void failing_allocations_leave_x_untouched(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    factored_t y = factored_make(GEN_GRID2, 49, 1, 0, &opt);
    sl_work *W = NULL;
    double X[49] = {5.0}, B[49] = {1.0};
    SL_CHECK(sl_work_create(&W, &opt));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_work_reserve_part(W, y.F, 1));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_factor_solve_part(y.F, L, X, 49, B, 49, 1, W));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_factor_multiply_part(y.F, L, X, 49, B, 49, 1, NULL));
    assert_true(X[0] == 5.0);
    counter.fail_at = -1;
    SL_CHECK(sl_factor_solve_part(y.F, L, X, 49, B, 49, 1, W));
    sl_work_free(W);
    factored_free(&y);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_those_of_dense_factors),
        cmocka_unit_test(parts_make_up_the_solve),
        cmocka_unit_test(local_halves_are_rows_of_full_ones),
        cmocka_unit_test(samples_have_the_covariance_of_the_inverse),
        cmocka_unit_test(null_pivots_give_zeros),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(roots_of_pairs_are_unsupported),
        cmocka_unit_test(reserved_workspaces_do_not_grow),
        cmocka_unit_test(failing_allocations_leave_x_untouched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
