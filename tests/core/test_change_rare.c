/* test_change_rare.c: changes by zeros, of zeros, to pivots of rounding, outside of L */
#include "tests/lib/factored.h"

/* A vector of zeros, or one whose square is 0, changes no bit (under valgrind: no number). */
static void zeros_change_nothing(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    const size_t size = (size_t)sl_symbolic_view(y.S).panel_begin[sl_symbolic_view(y.S).n_supers];
    const sl_int p[2] = {0, 1}, i[1] = {7};
    const double x[2] = {0.0, 1e-200}, sigma[1] = {1.0};
    double *L = test_reals(size), D[100];
    memcpy(L, sl_factor_view(y.F).L, size * sizeof *L);
    memcpy(D, sl_factor_view(y.F).D, sizeof D);
    for (int k = 0; k < 2; k++) {
        const sl_csc V = {100, 1, p, i, x + k};
        SL_CHECK(sl_factor_rank_update(y.F, &V, sigma, NULL, NULL));
        for (size_t at = 0; at < size; at++) {
            assert_true(L[at] == sl_factor_view(y.F).L[at]);
        }
        if (!under_valgrind()) {
            assert_memory_equal(L, sl_factor_view(y.F).L, size * sizeof *L);
        }
        assert_memory_equal(D, sl_factor_view(y.F).D, sizeof D);
    }
    free(L);
    factored_free(&y);
}

/* A regularized matrix of zeros has no entry to compare with. */
static void matrices_of_zeros_are_changed(void **state) {
    (void)state;
    const sl_int p[2] = {0, 1}, i[1] = {0};
    const double zero[1] = {0.0}, sigma[1] = {1.0}, b = 6.0;
    double one[1] = {1e-200}, x; /* its square is 0 */
    const sl_csc A = {1, 1, p, i, zero}, V = {1, 1, p, i, one};
    sl_options opt = options_none();
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    opt.regularization = 2.0;
    opt.growth_limit = 0.5;
    opt.error_limit = -1.0;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
    SL_CHECK(sl_factor_rank_update(F, &V, sigma, NULL, NULL));
    SL_CHECK(sl_factor_solve(F, &x, 1, &b, 1, 1, NULL));
    assert_true(x == 3.0);
    one[0] = 1.0; /* any growth is more than 0.5 */
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_rank_update(F, &V, sigma, NULL, &stats));
    assert_int_equal(stats.error.row, 0);
    SL_CHECK(sl_factor_solve(F, &x, 1, &b, 1, 1, NULL));
    assert_true(x == 3.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Nor has one with pivots of both signs, and the square of the change is 0, too. Where a change
 * adds nothing to the first supernode, the first row is the one that is named. */
static void matrices_of_zeros_have_no_scale(void **state) {
    (void)state;
    const sl_int p[4] = {0, 2, 4, 5}, i[5] = {0, 1, 1, 2, 2}, q[2] = {0, 2}, rows[2] = {0, 1};
    const double zeros[5] = {0.0};
    const sl_csc A = {3, 3, p, i, zeros};
    for (int both = 0; both < 2; both++) {
        const sl_int signs[3] = {1, both ? -1 : 1, 1};
        const double x[2] = {1e-200, both ? 0.0 : 1.0}, b[3] = {6.0, 4.0, 2.0};
        const sl_csc V = {3, 1, q, rows, x};
        double y[3];
        sl_options opt = options_none();
        sl_factor *F;
        sl_stats stats;
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_NONE);
        opt.regularization = 2.0;
        opt.signs = signs;
        opt.growth_limit = both ? 0.0 : 0.5;
        opt.error_limit = -1.0;
        SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
        if (both) {
            SL_CHECK(sl_factor_rank_update(F, &V, NULL, NULL, &stats));
            assert_true(stats.change.drift <= DBL_EPSILON);
        } else {
            SL_EXPECT(SL_ERR_INACCURATE, sl_factor_rank_update(F, &V, NULL, NULL, &stats));
            assert_int_equal(stats.error.row, 0);
        }
        SL_CHECK(sl_factor_solve(F, y, 3, b, 3, 1, NULL));
        assert_true(y[0] == 3.0 && y[1] == 2.0 * signs[1] && y[2] == 1.0);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* Two vectors in one pass: zeros that they store count for nothing, also outside of L; a pivot that
 * becomes 0 is refused, in a pass that is tried first and in one that is logged. */
static void two_vectors_may_store_zeros(void **state) {
    (void)state;
    const sl_int p[3] = {0, 1, 2}, i[2] = {0, 1}, q[3] = {0, 2, 4}, rows[4] = {0, 1, 0, 1};
    for (int sign = -1; sign <= 1; sign += 2) {
        const double x[2] = {4.0, 9.0 * sign}, sigma[2] = {-1.0, -1.0};
        double v[4] = {1.0, 0.0, 0.0, 1.0};
        const sl_csc A = {2, 2, p, i, x}, V = {2, 2, q, rows, v};
        sl_symbolic *S;
        sl_factor *F;
        sl_stats stats;
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
        const sl_int *at = sl_symbolic_view(S).iperm;
        const double *D = sl_factor_view(F).D;
        SL_CHECK(sl_factor_rank_update(F, &V, NULL, NULL, NULL));
        assert_true(D[at[0]] == 5.0 && D[at[1]] == 9.0 * sign + 1.0);
        SL_CHECK(sl_factor_rank_update(F, &V, sigma, NULL, NULL));
        assert_true(D[at[0]] == 4.0 && D[at[1]] == 9.0 * sign);
        for (int row = 0; row < 2; row++) { /* one of them comes first */
            const double away[2] = {-1.0, -sign};
            v[0] = row == 0 ? 2.0 : 1.0;
            v[3] = row == 0 ? 1.0 : 3.0;
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_rank_update(F, &V, away, NULL, &stats));
            assert_int_equal(stats.error.row, row);
            assert_true(D[at[0]] == 4.0 && D[at[1]] == 9.0 * sign);
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* Vectors of one pass cancel in a pivot, which stays as it was, while the next one grows. */
static void vectors_of_a_pass_may_cancel(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const sl_int q[4] = {0, 1, 2, 3}, rows[3] = {0, 0, 1};
    static const double x[3] = {4.0, 0.0, 1.0}, v[3] = {1.0, 1.0, 3.0}, sigma[3] = {1.0, -1.0, 1.0};
    const sl_csc A = {2, 2, p, i, x}, V = {2, 3, q, rows, v};
    const isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        sl_factor *F = NULL;
        sl_stats stats;
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
        opt.isa = isas.isa[k];
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
        SL_CHECK(sl_factor_rank_update(F, &V, sigma, NULL, &stats));
        assert_int_equal(stats.change.ranks, 3);
        assert_true(sl_factor_view(F).D[0] == 4.0 && sl_factor_view(F).D[1] == 10.0);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* The last pivot becomes far smaller than the terms that it was computed from, though not than the
 * change: it is null. */
static void a_pivot_of_rounding_is_null(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1}, last = 1;
    const double x[3] = {1.0, 1.0, 1.0 + 1e-10};
    const sl_csc A = {2, 2, p, i, x};
    sl_factor *F;
    sl_stats stats;
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    const double pivot = sl_factor_view(F).D[1];
    double delta = 1e-17 - pivot;
    assert_true(pivot > 9e-11 && pivot < 1.1e-10 && pivot + delta > 0.0);
    SL_EXPECT(SL_ERR_PIVOT,
              sl_factor_change_entries(F, NULL, &last, &last, &delta, 1, NULL, &stats));
    assert_int_equal(stats.error.row, 1);
    assert_true(sl_factor_view(F).D[1] == pivot);
    delta = 1e-12 - pivot;
    SL_CHECK(sl_factor_change_entries(F, NULL, &last, &last, &delta, 1, NULL, &stats));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Sets the weights of a tree's edges, k to parent[k], and what holds row 0. Appends changes. */
static void tree_set(gen_matrix_t *M, const sl_int *parent, const double *w, double held,
                     double *deltas) {
    const sl_int n = M->view.n_cols;
    double *dense = test_reals((size_t)n);
    dense[0] = held;
    for (sl_int k = 1; k < n; k++) {
        dense[k] += w[k];
        dense[parent[k]] += w[k];
    }
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = M->p[j]; p < M->p[j + 1]; p++) {
            const sl_int i = M->i[p];
            const double a = i == j ? dense[j] : -w[i > j ? i : j];
            deltas[p] = a - M->x[p];
            M->x[p] = a;
        }
    }
    free(dense);
}

/* What holds a Laplacian goes while weights change. Rounding leaves a last pivot of 1e-15 or so, of
 * either sign. */
static void a_laplacian_may_become_singular(void **state) {
    (void)state;
    enum { N = 19, ENTRIES = 2 * N - 1 };
    for (int k = 0; k < 300; k++) {
        uint64_t random = (uint64_t)(k / 3);
        sl_int parent[N] = {0}, rows[ENTRIES], columns[ENTRIES];
        double w[N], deltas[ENTRIES];
        gen_list_t list = gen_list(N);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        sl_options opt = options_none();
        opt.pivots = k % 3 > 0 ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
        for (sl_int i = 0; i < N; i++) {
            parent[i] = gen_below(&random, i > 0 ? i : 1);
            w[i] = exp(4.0 * gen_real(&random));
            gen_add(&list, i, i, 0.0);
            if (i > 0) {
                gen_add(&list, i, parent[i], 0.0);
            }
        }
        gen_matrix_t M = gen_store(&list, gen_style(0), 1);
        gen_list_free(&list);
        for (sl_int j = 0; j < N; j++) {
            for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
                rows[p] = M.i[p];
                columns[p] = j;
            }
        }
        tree_set(&M, parent, w, 0.18, deltas);
        S = analyze_natural(&M.view, SL_RELAXATION_DEFAULT);
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
        assert_int_equal(stats.factor.null, 0);
        w[3] *= 2.0;
        w[7] *= 0.02;
        tree_set(&M, parent, w, 0.0, deltas);
        if (k % 3 == 2) {
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_change_entries(F, NULL, rows, columns, deltas,
                                                             ENTRIES, NULL, &stats));
        }
        SL_EXPECT(
            k % 3 > 0 ? SL_OK : SL_ERR_PIVOT,
            sl_factor_change_entries(F, &M.view, rows, columns, deltas, ENTRIES, NULL, &stats));
        assert_true(k % 3 == 0 || stats.factor.null == 1);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

/* Vectors of two rows, one or two, are accepted if L has their entry, and only then. */
static void entries_outside_of_L_are_refused(void **state) {
    (void)state;
    enum { N = 64 };
    sl_options opt = options_none();
    opt.relaxation = SL_RELAXATION_NONE;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, &opt);
    const sl_int *perm = sl_symbolic_view(y.S).perm;
    const double x[4] = {1e-3, 1e-3, 1e-3, 1e-3};
    sl_matrix *lower = NULL;
    SL_CHECK(sl_factor_lower(&lower, y.F, NULL));
    const sl_csc L = sl_matrix_view(lower);
    for (sl_int j = 0; j < N; j++) {
        unsigned char has[N] = {0};
        for (sl_int q = L.p[j]; q < L.p[j + 1]; q++) {
            has[L.i[q]] = 1;
        }
        for (sl_int k = j + 1; k < N; k++) {
            const sl_int p[3] = {0, 2, 4}, i[4] = {perm[k], perm[j], perm[k], perm[j]};
            const sl_csc V = {N, 1 + (j + k) % 2, p, i, x};
            SL_EXPECT(has[k] ? SL_OK : SL_ERR_OTHER_PATTERN,
                      sl_factor_rank_update(y.F, &V, NULL, NULL, NULL));
        }
    }
    sl_matrix_free(lower);
    factored_free(&y);
}

/* Changes a 1 x 1 matrix by `count` equal vectors. An update whose pivot stays subnormal, or one
 * that overflows, is refused and changes no bit. */
static void check_tiny_and_huge(sl_int count, sl_isa isa) {
    static const struct {
        double pivot, entry;
        sl_status status;
    } cases[4] = {{1e-310, 1e-156, SL_ERR_PIVOT},
                  {1e-310, 2e-154, SL_OK},
                  {1e307, 1e152, SL_OK},
                  {1e308, 1.2e154, SL_ERR_NOT_FINITE}};
    const sl_int p[2] = {0, 1}, i[1] = {0};
    sl_int *q = test_ints((size_t)count + 1), *rows = test_ints((size_t)count);
    double *x = test_reals((size_t)count);
    for (sl_int k = 0; k < count; k++) {
        q[k + 1] = k + 1;
    }
    for (int k = 0; k < 4; k++) {
        const sl_csc A = {1, 1, p, i, &cases[k].pivot}, V = {1, count, q, rows, x};
        const double w = cases[k].entry, wanted = cases[k].pivot + (double)count * (w * w);
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        for (sl_int m = 0; m < count; m++) {
            x[m] = w;
        }
        opt.isa = isa;
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
        const double *D = sl_factor_view(F).D;
        SL_EXPECT(cases[k].status, sl_factor_rank_update(F, &V, NULL, NULL, &stats));
        double b = D[0], y = 0.0;
        if (cases[k].status == SL_OK) {
            assert_true(fabs(D[0] - wanted) <= 16.0 * DBL_EPSILON * wanted);
        } else {
            assert_int_equal(stats.error.row, 0);
        }
        assert_true(cases[k].status == SL_OK || D[0] == cases[k].pivot);
        SL_CHECK(sl_factor_solve(F, &y, 1, &b, 1, 1, NULL));
        assert_true(fabs(y - 1.0) <= 4.0 * DBL_EPSILON);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    free(q);
    free(rows);
    free(x);
}

static void tiny_and_huge_pivots_change(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        check_tiny_and_huge(1, isas.isa[k]);
        check_tiny_and_huge(2, isas.isa[k]);
        check_tiny_and_huge(9, isas.isa[k]); /* two passes */
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(zeros_change_nothing),
        cmocka_unit_test(matrices_of_zeros_are_changed),
        cmocka_unit_test(matrices_of_zeros_have_no_scale),
        cmocka_unit_test(two_vectors_may_store_zeros),
        cmocka_unit_test(vectors_of_a_pass_may_cancel),
        cmocka_unit_test(a_pivot_of_rounding_is_null),
        cmocka_unit_test(a_laplacian_may_become_singular),
        cmocka_unit_test(tiny_and_huge_pivots_change),
        cmocka_unit_test(entries_outside_of_L_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
