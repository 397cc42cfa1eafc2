/* test_supernodal.c: the supernodal factorization against the up-looking one */
#include "tests/lib/factored.h"

/* Factors the matrix of y with a method other than the one factored_make chose. */
static sl_factor *factor_with(const factored_t *y, sl_method method, sl_isa isa) {
    sl_options opt = options_none();
    sl_factor *F = NULL;
    opt.method = method;
    opt.isa = isa;
    SL_CHECK(sl_factor_create(&F, y->S, &y->M.view, &opt, NULL));
    return F;
}

/* D agrees within bound relative to each pivot, L within bound relative to the largest entry of its
 * column or 1. */
static void assert_close(const sl_factor *F, const sl_factor *G, double bound) {
    sl_factor_arrays f = sl_factor_view(F), g = sl_factor_view(G);
    sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
    for (sl_int k = 0; k < v.n; k++) {
        assert_true(fabs(f.D[k] - g.D[k]) <= bound * fabs(g.D[k]));
    }
    for (sl_int s = 0; s < v.n_supers; s++) {
        sl_int width = ref_width(&v, s), height = ref_height(&v, s);
        for (sl_int c = 0; c < width; c++) {
            double largest = 1.0;
            for (sl_int r = c + 1; r < height; r++) {
                largest = fmax(largest, fabs(g.L[v.panel_begin[s] + ref_position(width, r, c)]));
            }
            for (sl_int r = c + 1; r < height; r++) {
                sl_off at = v.panel_begin[s] + ref_position(width, r, c);
                assert_true(fabs(f.L[at] - g.L[at]) <= bound * largest);
            }
        }
    }
}

/* The two methods compute the same sums in different orders: c n eps for diagonally dominant
 * matrices, where entries do not grow. */
static void the_methods_agree_to_rounding(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    static const sl_int sizes[3] = {30, 300, 2000};
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 3; size++) {
            if (size == 2 && (kind == GEN_DENSE || kind == GEN_STAR)) {
                /* Two thousand dense rows take minutes in the emulator. */
                continue;
            }
            factored_t y = factored_make((gen_kind_t)kind, sizes[size], 0, 0, NULL);
            sl_factor *reference = factor_with(&y, SL_METHOD_UP_LOOKING, SL_ISA_SCALAR);
            for (int k = 0; k < isas.count; k++) {
                sl_factor *F = factor_with(&y, SL_METHOD_SUPERNODAL, isas.isa[k]);
                sl_stats a, b;
                memset(&a, 0, sizeof a);
                memset(&b, 0, sizeof b);
                a.factor = sl_factor_view(reference).info;
                b.factor = sl_factor_view(F).info;
                assert_int_equal(a.factor.positive, b.factor.positive);
                assert_int_equal(a.factor.negative, b.factor.negative);
                /* The scaled grid and the quasi-definite system are ill conditioned by design,
                 * which costs a factor of 1e6. */
                double grown = kind == GEN_SCALED || kind == GEN_KKT ? 1e6 : 1.0;
                assert_close(F, reference, 64.0 * grown * (double)(sizes[size] + 1) * DBL_EPSILON);
                sl_factor_free(F);
            }
            sl_factor_free(reference);
            factored_free(&y);
        }
    }
}

/* Dense matrices whose sizes cross every boundary of the kernels: tiles of 8 columns, groups of 64,
 * chunks of 256, pairs of tiles. */
static void dense_matrices_agree_at_every_kernel_boundary(void **state) {
    (void)state;
    static const sl_int sizes[12] = {63, 64, 65, 71, 72, 73, 128, 129, 255, 257, 321, 520};
    isa_list_t isas = isas_present();
    sl_options natural = options_none();
    natural.ordering = SL_ORDERING_NATURAL;
    for (int which = 0; which < 12; which++) {
        factored_t y = factored_make(GEN_DENSE, sizes[which], 0, 0, &natural);
        sl_int n = sizes[which];
        double *B = test_reals((size_t)n), *X = test_reals((size_t)n);
        gen_reals(B, (size_t)n, 3);
        sl_factor *reference = factor_with(&y, SL_METHOD_UP_LOOKING, SL_ISA_AUTO);
        for (int k = 0; k < isas.count; k++) {
            sl_factor *F = factor_with(&y, SL_METHOD_SUPERNODAL, isas.isa[k]);
            assert_close(F, reference, 64.0 * (double)n * DBL_EPSILON);
            SL_CHECK(sl_factor_solve(F, X, (size_t)n, B, (size_t)n, 1, NULL));
            BACKWARD_PASSES(&y.M.view, X, (size_t)n, B, (size_t)n, 1);
            sl_factor_free(F);
        }
        sl_factor_free(reference);
        free(B);
        free(X);
        factored_free(&y);
    }
}

/* A clique of w columns with h rows in a clique of m columns: one supernode passes its update
 * matrix to the next, whose rows leave gaps. */
static gen_matrix_t two_cliques(sl_int w, sl_int h, sl_int m, sl_int stride) {
    uint64_t seed = 11;
    gen_list_t t = gen_list(w + m);
    for (sl_int j = 0; j < w; j++) {
        for (sl_int i = j + 1; i < w; i++) {
            gen_add(&t, i, j, gen_real(&seed));
        }
        for (sl_int i = 0; i < h && i * stride < m; i++) {
            gen_add(&t, w + i * stride, j, gen_real(&seed));
        }
    }
    for (sl_int j = w; j < t.n; j++) {
        for (sl_int i = j + 1; i < t.n; i++) {
            gen_add(&t, i, j, gen_real(&seed));
        }
    }
    gen_dominate(&t, 0, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

static void update_matrices_with_gaps_are_assembled(void **state) {
    (void)state;
    static const sl_int widths[5] = {1, 7, 8, 65, 259}, strides[4] = {1, 2, 5, 9};
    isa_list_t isas = isas_present();
    for (int which = 0; which < 5; which++) {
        for (int gap = 0; gap < 4; gap++) {
            for (sl_int m = 20; m < 100; m += 33) {
                gen_matrix_t M = two_cliques(widths[which], m, m, strides[gap]);
                factored_t y = {M, analyze_natural(&M.view, SL_RELAXATION_NONE), NULL};
                sl_factor *reference = factor_with(&y, SL_METHOD_UP_LOOKING, SL_ISA_AUTO);
                for (int k = 0; k < isas.count; k++) {
                    sl_factor *F = factor_with(&y, SL_METHOD_SUPERNODAL, isas.isa[k]);
                    assert_close(F, reference, 64.0 * (double)M.view.n_cols * DBL_EPSILON);
                    sl_factor_free(F);
                }
                sl_factor_free(reference);
                factored_free(&y);
            }
        }
    }
}

/* Pivots whose reciprocal overflows or loses digits: the rows below are divided instead. */
static void extreme_pivots_agree(void **state) {
    (void)state;
    static const int powers[4] = {-1030, -1000, 1000, 1018};
    isa_list_t isas = isas_present();
    for (int which = 0; which < 4; which++) {
        factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
        sl_int n = y.M.view.n_cols;
        for (sl_int q = 0; q < y.M.p[n]; q++) {
            /* Exact even for subnormal values. */
            y.M.x[q] = ldexp(rint(ldexp(y.M.x[q], 20)), powers[which] - 20);
        }
        for (int k = 0; k < isas.count; k++) {
            sl_factor *F = factor_with(&y, SL_METHOD_SUPERNODAL, isas.isa[k]);
            sl_factor *G = factor_with(&y, SL_METHOD_UP_LOOKING, isas.isa[k]);
            /* Subnormal values have fewer digits: 2^-1074 against entries near 2^-1030. */
            assert_close(F, G, powers[which] < -1022 ? 1e-9 : 64.0 * (double)n * DBL_EPSILON);
            sl_factor_free(F);
            sl_factor_free(G);
        }
        factored_free(&y);
    }
}

static void the_automatic_method_fits_the_matrix(void **state) {
    (void)state;
    static const struct {
        gen_kind_t kind;
        sl_method method;
    } known[5] = {{GEN_GRID2, SL_METHOD_SUPERNODAL},
                  {GEN_GRID3, SL_METHOD_SUPERNODAL},
                  {GEN_PATH, SL_METHOD_SUPERNODAL},
                  {GEN_STAR, SL_METHOD_SUPERNODAL},
                  {GEN_DIAGONAL, SL_METHOD_SUPERNODAL}};
    for (int k = 0; k < 5; k++) {
        factored_t y = factored_make(known[k].kind, 2500, 1, 0, NULL);
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        stats.factor = sl_factor_view(y.F).info;
        assert_int_equal(stats.factor.method, known[k].method);
        factored_free(&y);
    }
}

/* Rows that are joined to 32 others: update matrices would take 20 times as much as L. The 32 are
 * followed by `rest` rows of their own. in_pairs: two and two are joined, so that they have
 * fronts. */
static void check_dense_rows(sl_int rest, sl_ordering ordering, int in_pairs) {
    const sl_int n = 20000, dense = 32, end = n - rest;
    gen_list_t list = gen_list(n);
    sl_symbolic *S = NULL, *part = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_stats stats;
    sl_int *rows = test_ints((size_t)n), count = 0;
    counter_t counter = counter_make();
    const sl_options opt = options_counted(&counter);
    sl_options order = options_none();
    order.ordering = ordering;
    for (sl_int i = 0; i < n; i++) {
        rows[count] = i;
        count += i % 100 != 7;
        gen_add(&list, i, i, i < end - dense ? dense + 2.0 : 2.0 * n);
        if (in_pairs && i % 2 == 1 && i < end - dense) {
            gen_add(&list, i, i - 1, -1.0);
        }
        for (sl_int k = end - dense; k < end && i < end - dense; k++) {
            gen_add(&list, k, i, -1.0);
        }
    }
    gen_matrix_t M = gen_store(&list, gen_style(0), 1);
    gen_list_free(&list);
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_symbolic_create(&S, &M.view, &order, &stats));
    const double most = 50.0 * (double)stats.symbolic.nnz_panels + 1000.0 * n;
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
    assert_true((double)counter.total_bytes <= most);
    counter.total_bytes = 0;
    SL_CHECK(sl_factor_submatrix(&part, &G, F, &M.view, rows, count, &opt, &stats));
    assert_true((double)counter.total_bytes <= most);
    sl_factor_free(G);
    sl_symbolic_free(part);
    sl_factor_free(F);
    COUNTER_CLEAN(&counter);
    free(rows);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

static void dense_rows_do_not_fill_the_memory(void **state) {
    (void)state;
    for (int in_pairs = 0; in_pairs < 2; in_pairs++) {
        check_dense_rows(0, SL_ORDERING_ND, in_pairs);
        check_dense_rows(3, SL_ORDERING_NATURAL, in_pairs);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_methods_agree_to_rounding),
        cmocka_unit_test(dense_matrices_agree_at_every_kernel_boundary),
        cmocka_unit_test(update_matrices_with_gaps_are_assembled),
        cmocka_unit_test(extreme_pivots_agree),
        cmocka_unit_test(the_automatic_method_fits_the_matrix),
        cmocka_unit_test(dense_rows_do_not_fill_the_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
