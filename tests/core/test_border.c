/* test_border.c: the default options factor and solve [L B'; B 0] with a singular Laplacian L and a
 * dense constraint for each component, as libigl assembles zero-mean Poisson problems */
#include "tests/lib/factored.h"

/* Grids of m x m vertices, each with a dense row of weights and without diagonal entries there;
 * isolated vertices that no constraint has; in random order. */
static gen_matrix_t bordered(sl_int grids, sl_int m, sl_int isolated, double weight,
                             uint64_t *seed, sl_int *name) {
    const sl_int size = m * m, n = grids * size + isolated + grids;
    gen_list_t t = gen_list(n);
    double *d = test_reals((size_t)n);
    gen_permutation(name, n, gen_bits(seed));
    for (sl_int v = 0; v < grids * size; v++) {
        const sl_int k = v % size, to[3] = {v + 1, v + m, v + m + 1};
        const int is_edge[3] = {k % m + 1 < m, k / m + 1 < m, k % m + 1 < m && k / m + 1 < m};
        for (int e = 0; e < 3; e++) {
            const double w = 1.1 + gen_real(seed);
            if (is_edge[e]) {
                gen_add(&t, name[v], name[to[e]], -w);
                d[v] += w;
                d[to[e]] += w;
            }
        }
        gen_add(&t, name[v], name[n - grids + v / size], weight * (1.5 + gen_real(seed)));
    }
    for (sl_int v = 0; v < n - grids; v++) {
        gen_add(&t, name[v], name[v], v < grids * size ? d[v] : 1.0);
    }
    for (size_t k = 0; k < t.count; k++) {
        const sl_int i = t.row[k], j = t.col[k];
        t.row[k] = i > j ? i : j;
        t.col[k] = i > j ? j : i;
    }
    gen_matrix_t M = gen_store(&t, gen_style((int)gen_below(seed, 3)), 1);
    gen_list_free(&t);
    free(d);
    return M;
}

static void check(const gen_matrix_t *M, sl_int grids, const sl_int *name, sl_options *opt,
                  const variant_list_t *variants, int k) {
    const sl_int n = M->view.n_cols;
    double *b = test_reals((size_t)n), *x = test_reals((size_t)n);
    sl_options numbers = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &M->view, opt, &stats));
    options_set_variant(&numbers, variants, k);
    SL_CHECK(sl_factor_create(&F, S, &M->view, &numbers, &stats));
    assert_int_equal(stats.factor.negative, grids);
    assert_true(DBL_EPSILON * stats.factor.growth <= 1e-8);
    gen_reals(b, (size_t)n, 3);
    for (sl_int r = n - grids; r < n; r++) {
        b[name[r]] = 0.0; /* a weighted mean of 0 */
    }
    SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
    double *r = test_reals((size_t)n), error = NAN;
    SL_CHECK(sl_csc_residual(&M->view, r, (size_t)n, &error, x, (size_t)n, b, (size_t)n, 1));
    assert_true(error <= 1e-13);
    SL_CHECK(sl_factor_refactor(F, &M->view, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
    free(b);
    free(x);
    free(r);
}

static void bordered_laplacians_are_solved_by_default(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 5;
    for (int trial = 0; trial < 60; trial++) {
        const sl_int grids = 1 + gen_below(&seed, 3), m = 3 + gen_below(&seed, 40);
        const sl_int isolated = gen_below(&seed, 4), n = grids * (m * m + 1) + isolated;
        const double weight = trial % 2 == 0 ? 1.0 : 1.0 / (m * m);
        sl_int *name = test_ints((size_t)n);
        gen_matrix_t M = bordered(grids, m, isolated, weight, &seed, name);
        for (int ordering = 0; ordering < 2; ordering++) {
            sl_options opt = options_none();
            opt.ordering = ordering == 0 ? SL_ORDERING_ND : SL_ORDERING_MINDEG;
            check(&M, grids, name, &opt, &variants, trial % variants.count);
        }
        gen_matrix_free(&M);
        free(name);
    }
}

/* The order is a permutation also where many rows or all are constraints. */
static void patterns_without_a_diagonal_are_ordered(void **state) {
    (void)state;
    for (sl_int n = 1; n <= 40; n++) {
        for (sl_int full = 0; full <= n; full += 1 + n / 5) { /* rows with a diagonal entry */
            gen_list_t t = gen_list(n);
            for (sl_int i = 0; i < n; i++) {
                if (i < full) {
                    gen_add(&t, i, i, 4.0);
                }
                for (sl_int j = 0; j < i; j += 1 + i / 3) {
                    gen_add(&t, i, j, 1.0);
                }
            }
            gen_matrix_t M = gen_store(&t, gen_style(0), 1);
            for (int ordering = 0; ordering < 2; ordering++) {
                sl_options opt = options_none();
                sl_symbolic *S = NULL;
                opt.ordering = ordering == 0 ? SL_ORDERING_ND : SL_ORDERING_MINDEG;
                SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
                const sl_symbolic_arrays v = sl_symbolic_view(S);
                for (sl_int k = 0; k < n; k++) {
                    assert_in_range(v.perm[k], 0, n - 1);
                    assert_int_equal(v.iperm[v.perm[k]], k);
                }
                sl_symbolic_free(S);
            }
            gen_matrix_free(&M);
            gen_list_free(&t);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bordered_laplacians_are_solved_by_default),
        cmocka_unit_test(patterns_without_a_diagonal_are_ordered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
