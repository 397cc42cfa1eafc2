/* test_triangle.c: options.triangle reads one triangle of a matrix that stores both */
#include "tests/lib/pruned.h"

static sl_options options_triangle(sl_triangle triangle) {
    sl_options opt = options_none();
    opt.triangle = triangle;
    return opt;
}

enum { KINDS = 7, SIDES = 2 };
static const gen_kind_t kinds[KINDS] = {GEN_GRID2,  GEN_GRID3, GEN_RANDOM, GEN_COMPONENTS,
                                        GEN_FOREST, GEN_KKT,   GEN_DENSE};
static const sl_triangle sides[SIDES] = {SL_TRIANGLE_LOWER, SL_TRIANGLE_UPPER};

/* ---- without the option ---- */

/* The error names an entry that is stored and has no mirror image. */
static void assert_names_an_entry(const sl_csc *A, const sl_stats *stats) {
    const sl_int row = stats->error.row, column = stats->error.column;
    assert_in_range(row, 0, A->n_rows - 1);
    assert_in_range(column, 0, A->n_cols - 1);
    assert_true(stores(A, row, column) && !stores(A, column, row));
}

static void without_the_option_a_pruned_pattern_is_refused(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        pruned_t y = pruned_make(kinds[kind], 60);
        assert_true(y.missing_up > 0 && y.missing_down > 0);
        const sl_triangle tried[2] = {SL_TRIANGLE_NONE, SL_TRIANGLE_BOTH};
        for (int k = 0; k < 2; k++) {
            const sl_options opt = options_triangle(tried[k]);
            sl_triangle found = SL_TRIANGLE_UPPER;
            sl_symbolic *S = (sl_symbolic *)(void *)&y;
            sl_matrix *C = (sl_matrix *)(void *)&y;
            sl_stats stats;
            SL_EXPECT(SL_ERR_MALFORMED, sl_csc_triangle(&y.A, &found, &opt, &stats));
            assert_int_equal(found, SL_TRIANGLE_UPPER);
            assert_names_an_entry(&y.A, &stats);
            SL_EXPECT(SL_ERR_MALFORMED, sl_symbolic_create(&S, &y.A, &opt, &stats));
            assert_null(S);
            assert_names_an_entry(&y.A, &stats);
            SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_sum(&C, NULL, &y.A, 1, &opt, &stats));
            assert_null(C);
            assert_names_an_entry(&y.A, &stats);
        }
        pruned_free(&y);
    }
}

/* ---- with the option ---- */

static void csc_triangle_returns_the_chosen_triangle(void **state) {
    (void)state;
    pruned_t y = pruned_make(GEN_GRID2, 60);
    for (int side = 0; side < SIDES; side++) {
        const sl_options opt = options_triangle(sides[side]);
        sl_triangle found = SL_TRIANGLE_NONE;
        SL_CHECK(sl_csc_triangle(&y.A, &found, &opt, NULL));
        assert_int_equal(found, sides[side]);
    }
    pruned_free(&y);
}

/* The analyses read the same entries and have the same arrays. */
static void assert_same_analysis(const sl_symbolic *S, const sl_symbolic *T) {
    sl_stats s, t;
    s.symbolic = sl_symbolic_view(S).info;
    t.symbolic = sl_symbolic_view(T).info;
    assert_int_equal(s.symbolic.triangle, t.symbolic.triangle);
    assert_int_equal(s.symbolic.nnz_a, t.symbolic.nnz_a);
    assert_int_equal(s.symbolic.nnz_l, t.symbolic.nnz_l);
    assert_int_equal(scatter_length(S), scatter_length(T));
    assert_same_arrays(S, T);
}

/* Solves with F, whose matrix is A, and checks the backward error for the triangle P. */
static void assert_solves(const sl_factor *F, const sl_csc *P) {
    const size_t n = (size_t)P->n_cols;
    double *B = test_reals(2 * n), *X = test_reals(2 * n);
    gen_reals(B, 2 * n, 3);
    SL_CHECK(sl_factor_solve(F, X, n, B, n, 2, NULL));
    BACKWARD_PASSES(P, X, n, B, n, 2);
    free(B);
    free(X);
}

static void every_ordering_analyzes_the_chosen_triangle(void **state) {
    (void)state;
    static const sl_ordering orderings[3] = {SL_ORDERING_ND, SL_ORDERING_NATURAL,
                                             SL_ORDERING_METIS};
    for (int k = 0; k < 3 * KINDS * SIDES; k++) {
        const sl_triangle triangle = sides[k % SIDES];
        sl_options opt = options_triangle(triangle);
        opt.ordering = orderings[k / SIDES / KINDS];
        if (!ordering_is_present(opt.ordering)) {
            continue;
        }
        pruned_t y = pruned_make(kinds[k / SIDES % KINDS], 300);
        const sl_csc P = pruned_read(&y, triangle);
        sl_symbolic *S = NULL, *T = NULL;
        SL_CHECK(sl_symbolic_create(&S, &y.A, &opt, NULL));
        opt.triangle = SL_TRIANGLE_NONE;
        SL_CHECK(sl_symbolic_create(&T, &P, &opt, NULL));
        assert_same_analysis(S, T);
        sl_symbolic_free(S);
        sl_symbolic_free(T);
        pruned_free(&y);
    }
}

static void the_factor_is_that_of_the_chosen_triangle(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count * KINDS * SIDES; k++) {
        const sl_triangle triangle = sides[k % SIDES];
        const sl_options analysis = options_triangle(triangle);
        sl_options opt = options_none();
        pruned_t y = pruned_make(kinds[k / SIDES % KINDS], 100);
        const sl_csc P = pruned_read(&y, triangle);
        sl_symbolic *S = NULL, *T = NULL;
        sl_factor *F = NULL, *G = NULL;
        options_set_variant(&opt, &variants, k / SIDES / KINDS);
        SL_CHECK(sl_symbolic_create(&S, &y.A, &analysis, NULL));
        SL_CHECK(sl_symbolic_create(&T, &P, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &y.A, &opt, NULL));
        SL_CHECK(sl_factor_create(&G, T, &P, &opt, NULL));
        assert_same_bits(F, G);
        NOTHING_WRONG(check_factor(F, &P));
        assert_solves(F, &P);
        sl_factor_free(F);
        sl_factor_free(G);
        sl_symbolic_free(S);
        sl_symbolic_free(T);
        pruned_free(&y);
    }
}

/* An analysis and a factor of a pruned matrix, and those of the triangle that is read. */
typedef struct pair_t {
    pruned_t y;
    sl_csc P;
    sl_symbolic *S, *T;
    sl_factor *F, *G;
} pair_t;

static pair_t pair_make(sl_triangle triangle) {
    const sl_options opt = options_triangle(triangle);
    pair_t z;
    memset(&z, 0, sizeof z);
    z.y = pruned_make(GEN_GRID2, 400);
    z.P = pruned_read(&z.y, triangle);
    SL_CHECK(sl_symbolic_create(&z.S, &z.y.A, &opt, NULL));
    SL_CHECK(sl_symbolic_create(&z.T, &z.P, NULL, NULL));
    SL_CHECK(sl_factor_create(&z.F, z.S, &z.y.A, NULL, NULL));
    SL_CHECK(sl_factor_create(&z.G, z.T, &z.P, NULL, NULL));
    return z;
}

static void pair_free(pair_t *z) {
    sl_factor_free(z->F);
    sl_factor_free(z->G);
    sl_symbolic_free(z->S);
    sl_symbolic_free(z->T);
    pruned_free(&z->y);
}

static void refactor_reads_the_chosen_triangle(void **state) {
    (void)state;
    for (int side = 0; side < SIDES; side++) {
        pair_t z = pair_make(sides[side]);
        const size_t entries = (size_t)z.P.p[z.y.n];
        double *values = test_reals(entries);
        sl_csc P = z.P;
        P.x = values;
        for (size_t p = 0; p < entries; p++) {
            values[p] = 3 * z.P.x[p];
        }
        for (sl_int p = 0; p < z.y.A.p[z.y.n]; p++) {
            z.y.x[p] *= 3;
        }
        SL_CHECK(sl_factor_refactor(z.F, &z.y.A, NULL));
        SL_CHECK(sl_factor_refactor(z.G, &P, NULL));
        assert_same_bits(z.F, z.G);
        free(values);
        pair_free(&z);
    }
}

static void changed_columns_read_the_chosen_triangle(void **state) {
    (void)state;
    const sl_int columns[3] = {40, 7, 311};
    for (int side = 0; side < SIDES; side++) {
        pair_t z = pair_make(sides[side]);
        const size_t entries = (size_t)z.P.p[z.y.n];
        double *values = test_reals(entries);
        sl_csc P = z.P;
        memcpy(values, z.P.x, entries * sizeof *values);
        P.x = values;
        for (int k = 0; k < 3; k++) {
            const sl_int j = columns[k];
            for (sl_int p = P.p[j]; p < P.p[j + 1]; p++) {
                values[p] *= P.i[p] == j ? 2 : 0.5;
            }
            for (sl_int p = z.y.A.p[j]; p < z.y.A.p[j + 1]; p++) {
                z.y.x[p] *= z.y.A.i[p] == j ? 2 : 0.5;
            }
        }
        SL_CHECK(sl_factor_change_entries(z.F, &z.y.A, NULL, columns, NULL, 3, NULL, NULL));
        NOTHING_WRONG(check_factor(z.F, &P));
        assert_solves(z.F, &P);
        free(values);
        pair_free(&z);
    }
}

static void the_other_triangle_may_hold_nan(void **state) {
    (void)state;
    for (int side = 0; side < SIDES; side++) {
        pair_t z = pair_make(sides[side]);
        const size_t n = (size_t)z.y.n;
        double *b = test_reals(n), *x = test_reals(n), rcond = -1, expected = -1;
        sl_factor *F = NULL;
        gen_reals(b, n, 8);
        for (sl_int j = 0; j < z.y.n; j++) {
            for (sl_int p = z.y.A.p[j]; p < z.y.A.p[j + 1]; p++) {
                z.y.x[p] = is_ignored(&z.y, sides[side], p, j) ? NAN : z.y.x[p];
            }
        }
        SL_CHECK(sl_factor_create(&F, z.S, &z.y.A, NULL, NULL));
        assert_same_bits(F, z.G);
        SL_CHECK(sl_factor_refactor(F, &z.y.A, NULL));
        assert_same_bits(F, z.G);
        SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
        SL_CHECK(sl_factor_refine(F, &z.y.A, x, n, b, n, 1, 2, NULL, NULL));
        BACKWARD_PASSES(&z.P, x, n, b, n, 1);
        SL_CHECK(sl_factor_rcond(F, &z.y.A, &rcond, NULL));
        SL_CHECK(sl_factor_rcond(z.G, &z.P, &expected, NULL));
        assert_true(rcond == expected);
        sl_factor_free(F);
        free(b);
        free(x);
        pair_free(&z);
    }
}

static void refine_uses_the_chosen_triangle(void **state) {
    (void)state;
    for (int side = 0; side < SIDES; side++) {
        pair_t z = pair_make(sides[side]);
        const size_t n = (size_t)z.y.n;
        double *B = test_reals(3 * n), *X = test_reals(3 * n), *Y = test_reals(3 * n);
        sl_stats stats, expected;
        gen_reals(B, 3 * n, 5);
        gen_reals(X, 3 * n, 6); /* far from the solution */
        memcpy(Y, X, 3 * n * sizeof *Y);
        SL_CHECK(sl_factor_refine(z.F, &z.y.A, X, n, B, n, 3, 5, NULL, &stats));
        SL_CHECK(sl_factor_refine(z.G, &z.P, Y, n, B, n, 3, 5, NULL, &expected));
        SAME_VALUES(X, Y, 3 * n);
        assert_int_equal(stats.refine.steps, expected.refine.steps);
        assert_true(stats.refine.backward_error == expected.refine.backward_error);
        BACKWARD_PASSES(&z.P, X, n, B, n, 3);
        free(B);
        free(X);
        free(Y);
        pair_free(&z);
    }
}

static void rcond_uses_the_chosen_triangle(void **state) {
    (void)state;
    for (int side = 0; side < SIDES; side++) {
        pair_t z = pair_make(sides[side]);
        double rcond = -1, expected = -1;
        SL_CHECK(sl_factor_rcond(z.F, &z.y.A, &rcond, NULL));
        SL_CHECK(sl_factor_rcond(z.G, &z.P, &expected, NULL));
        assert_true(rcond == expected && rcond > 0);
        pair_free(&z);
    }
}

static void a_sum_adds_the_chosen_triangles(void **state) {
    (void)state;
    const double c[2] = {2, -0.5};
    for (int k = 0; k < KINDS * SIDES; k++) {
        const sl_triangle triangle = sides[k % SIDES];
        const sl_options opt = options_triangle(triangle);
        pruned_t y = pruned_make(kinds[k / SIDES], 60);
        const sl_csc terms[2] = {y.A, y.A}, part = pruned_read(&y, triangle);
        const sl_csc parts[2] = {part, part};
        for (int values = 0; values < 2; values++) {
            sl_matrix *C = NULL, *D = NULL;
            SL_CHECK(sl_matrix_sum(&C, values ? c : NULL, terms, 2, &opt, NULL));
            SL_CHECK(sl_matrix_sum(&D, values ? c : NULL, parts, 2, NULL, NULL));
            const sl_csc A = sl_matrix_view(C), B = sl_matrix_view(D);
            const size_t entries = (size_t)B.p[y.n];
            assert_memory_equal(A.p, B.p, ((size_t)y.n + 1) * sizeof *A.p);
            assert_memory_equal(A.i, B.i, entries * sizeof *A.i);
            assert_true((A.x != NULL) == values && (B.x != NULL) == values);
            if (values) {
                assert_memory_equal(A.x, B.x, entries * sizeof *A.x);
            }
            sl_matrix_free(C);
            sl_matrix_free(D);
        }
        pruned_free(&y);
    }
}

/* ---- matrices that need no option ---- */

/* Without it, values that differ are refused (test_symmetry.c). */
static void the_option_chooses_the_values_of_a_symmetric_pattern(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 4}, i[4] = {0, 1, 0, 1};
    const double x[4] = {4, 1, 2, 4}; /* 1 below the diagonal, 2 above it */
    const sl_csc A = {2, 2, p, i, x};
    const double determinants[SIDES] = {15, 12};
    for (int k = 0; k < SIDES; k++) {
        const sl_options opt = options_triangle(sides[k]);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        double log_det, sign;
        SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
        SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
        SL_CHECK(sl_factor_logdet(F, &log_det, &sign));
        assert_true(fabs(exp(log_det) - determinants[k]) < 1e-13 * determinants[k] && sign == 1);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

static void a_matrix_that_stores_the_other_triangle_is_diagonal(void **state) {
    (void)state;
    for (int side = 0; side < SIDES; side++) {
        const sl_options opt = options_triangle(sides[side]);
        gen_list_t t = gen_make(GEN_GRID2, 49, 1, 3);
        gen_matrix_t M = gen_store(&t, gen_style(side == 0 ? 1 : 0), 1);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats));
        assert_int_equal(stats.symbolic.triangle, sides[side]);
        assert_int_equal(stats.symbolic.nnz_a, t.n);
        assert_int_equal(stats.symbolic.nnz_l, t.n);
        SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* Whether a null vector is one is decided by the triangle that is read: the other one is that of no
 * Laplacian. */
static void null_vectors_belong_to_the_triangle_that_is_read(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 5, 7}, i[7] = {0, 1, 0, 1, 2, 1, 2};
    static const double lower[7] = {1, -1, 50, 3, -2, 70, 2}, upper[7] = {1, 50, -1, 3, 70, -2, 2};
    for (int k = 0; k < 2; k++) {
        const sl_csc A = {3, 3, p, i, k ? upper : lower};
        const double b[3] = {1, 0, -1};
        double x[3];
        sl_options opt = options_none();
        sl_symbolic *S;
        sl_factor *F;
        sl_stats stats;
        opt.triangle = k ? SL_TRIANGLE_UPPER : SL_TRIANGLE_LOWER;
        SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
        opt = options_none();
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
        assert_int_equal(stats.factor.null, 1);
        SL_CHECK(sl_factor_solve(F, x, 3, b, 3, 1, NULL));
        assert_true(fabs(x[0] - x[1] - 1.0) <= 1e-15 && fabs(x[1] - x[2] - 0.5) <= 1e-15);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(null_vectors_belong_to_the_triangle_that_is_read),
        cmocka_unit_test(without_the_option_a_pruned_pattern_is_refused),
        cmocka_unit_test(csc_triangle_returns_the_chosen_triangle),
        cmocka_unit_test(every_ordering_analyzes_the_chosen_triangle),
        cmocka_unit_test(the_factor_is_that_of_the_chosen_triangle),
        cmocka_unit_test(refactor_reads_the_chosen_triangle),
        cmocka_unit_test(changed_columns_read_the_chosen_triangle),
        cmocka_unit_test(the_other_triangle_may_hold_nan),
        cmocka_unit_test(refine_uses_the_chosen_triangle),
        cmocka_unit_test(rcond_uses_the_chosen_triangle),
        cmocka_unit_test(a_sum_adds_the_chosen_triangles),
        cmocka_unit_test(the_option_chooses_the_values_of_a_symmetric_pattern),
        cmocka_unit_test(a_matrix_that_stores_the_other_triangle_is_diagonal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
