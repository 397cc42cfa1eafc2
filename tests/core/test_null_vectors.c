/* test_null_vectors.c: null pivots of Laplacians are those of the components, whatever rounding
 * does: jittered meshes, slivers, weights over 14 decades, weak bridges */
#include "tests/lib/factor_ways.h"
#include "tests/lib/graph_laplacian.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/random_mesh.h"
#include "tests/lib/zero_mean.h"

enum { MESHES = 1000 };

/* One null pivot in each component, and in no component two. */
static void assert_nulls(const sl_factor *F, const sl_stats *stats, const sl_int *of,
                         sl_int components) {
    sl_int rows[16], count = 0;
    assert_int_equal(stats->factor.null, components);
    assert_int_equal(stats->factor.regular, 0);
    assert_int_equal(stats->factor.negative, 0);
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, rows, NULL, 16, &count));
    assert_int_equal(count, components);
    for (sl_int k = 0; k < count; k++) {
        for (sl_int other = 0; other < k; other++) {
            assert_true(of[rows[k]] != of[rows[other]]);
        }
    }
}

/* b without its mean in each component is consistent: no solve refuses it. */
static void assert_consistent_solve(const sl_csc *A, const sl_factor *F, const sl_int *of,
                                    double *b) {
    const size_t n = (size_t)A->n_cols;
    double *sum = test_reals(n), *rows = test_reals(n), *x = test_reals(n);
    for (size_t i = 0; i < n; i++) {
        sum[of[i]] += b[i];
        rows[of[i]] += 1.0;
    }
    for (size_t i = 0; i < n; i++) {
        b[i] -= sum[of[i]] / rows[of[i]];
    }
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    BACKWARD_PASSES(A, x, n, b, n, 1);
    free(sum);
    free(rows);
    free(x);
}

static void no_null_pivot_is_missed_or_dropped(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 2024;
    for (int mesh = 0; mesh < MESHES; mesh++) {
        sl_int components = 0, *of = NULL;
        gen_matrix_t M = random_mesh(&seed, &of, &components);
        const size_t n = (size_t)M.view.n_cols;
        double *m = weights((sl_int)n, seed), *b = test_reals(n), *x = test_reals(n);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL, *G = NULL;
        sl_stats stats;
        sl_options opt = options_skip_null(&variants, mesh % variants.count);
        opt.mass = m;
        gen_reals(b, n, seed);
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        assert_nulls(F, &stats, of, components);
        SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
        assert_zero_mean(&M.view, of, m, x, b);
        local_solve_t q = local_solve_random(F, (sl_int)n, 3, 5, 3, 8);
        local_solve_check(S, F, &q, NULL);
        local_solve_free(&q);
        opt.mass = NULL;
        SL_CHECK(sl_factor_create(&G, S, &M.view, FOR_FACTOR(&opt), &stats));
        assert_nulls(G, &stats, of, components);
        assert_same_bits(F, G);
        assert_ways_agree(S, &M.view, F, &opt);
        assert_consistent_solve(&M.view, G, of, b);
        SL_CHECK(sl_factor_refactor(G, &M.view, &stats));
        assert_nulls(G, &stats, of, components);
        assert_same_bits(F, G);
        sl_int changed = 0;
        SL_CHECK(sl_factor_change_entries(G, &M.view, NULL, &changed, NULL, 1, NULL, &stats));
        assert_nulls(G, &stats, of, components);
        sl_factor_free(F);
        sl_factor_free(G);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(of);
        free(m);
        free(b);
        free(x);
    }
}

/* By default every singular Laplacian is refused, also where rounding hides the null pivot. */
static void laplacians_are_refused_by_default(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 88;
    for (int mesh = 0; mesh < MESHES; mesh++) {
        sl_int components = 0, *of = NULL;
        gen_matrix_t M = random_mesh(&seed, &of, &components);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        sl_options opt = options_skip_null(&variants, mesh % variants.count);
        opt.pivots = SL_PIVOTS_NONZERO;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        assert_null(F);
        assert_int_equal(stats.factor.null, 1);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(of);
    }
}

/* A definite Laplacian is not refused: weights over 3 decades or slivers, and a pinned row, a mass
 * of t in each row, or a row removed. The least pivot is far above rounding, and x is accurate. */
static void definite_laplacians_are_accepted_by_default(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 99;
    for (int mesh = 0; mesh < MESHES; mesh++) {
        const int kind = mesh % 3;
        const sl_int m = 3 + gen_below(&seed, 30), n = m * (3 + gen_below(&seed, 30));
        const double firm = pow(10.0, -6.0 * uniform(&seed));
        builder_t b;
        b.t = gen_list(n);
        b.diagonal = test_reals((size_t)n);
        add_grid(&b, 0, m, n / m, 1 + 2 * gen_below(&seed, 2), &seed);
        for (sl_int v = 0; v < n; v++) {
            const double more = kind == 1 || (kind == 0 && v == n / 2) ? firm : 0.0;
            gen_add(&b.t, v, v, b.diagonal[v] * (1.0 + more) + (kind == 2 && v == 0 ? 1.0 : 0.0));
        }
        gen_matrix_t M = gen_store(&b.t, gen_style(0), 1);
        double *x = test_reals((size_t)n), *rhs = test_reals((size_t)n);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        sl_options opt = options_skip_null(&variants, mesh % variants.count);
        opt.pivots = SL_PIVOTS_NONZERO;
        gen_reals(rhs, (size_t)n, seed);
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.factor.positive, n);
        SL_CHECK(sl_factor_solve(F, x, (size_t)n, rhs, (size_t)n, 1, NULL));
        BACKWARD_PASSES(&M.view, x, (size_t)n, rhs, (size_t)n, 1);
        SL_CHECK(sl_factor_refactor(F, &M.view, &stats));
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&b.t);
        free(b.diagonal);
        free(x);
        free(rhs);
    }
}

/* Two paths of springs with a common entry whose duplicates cancel, or which is an explicit zero:
 * two components with a null pivot each. */
static void canceled_entries_do_not_join(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int duplicates = 0; duplicates < 4; duplicates++) {
        gen_list_t t = gen_list(4);
        for (sl_int v = 0; v < 4; v += 2) {
            gen_add(&t, v, v, 0.3);
            gen_add(&t, v + 1, v, -0.3);
            gen_add(&t, v + 1, v + 1, 0.3);
        }
        for (int k = 0; k < duplicates; k++) { /* 0; 0 + 0; 1 - 2 + 1 */
            gen_add(&t, 2, 1, duplicates < 3 ? 0.0 : k == 1 ? -2.0 : 1.0);
        }
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_skip_null(&variants, k);
            sl_factor *F = NULL;
            sl_stats stats;
            const double z[4] = {1.0, 1.0, 0.0, 0.0}; /* fits only if the components are apart */
            opt.null_vector = z;
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
            assert_int_equal(stats.factor.null, 2);
            assert_int_equal(stats.factor.regular, 0);
            sl_factor_free(F);
            opt.null_vector = NULL;
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
            assert_int_equal(stats.factor.null, 2);
            assert_int_equal(stats.factor.weak, 0);
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* The Laplacian of a path of 3 vertices with weights 1 and w, plus a spring from row 0 to the
 * ground. */
static gen_matrix_t path3(double w, double ground) {
    gen_list_t t = gen_list(3);
    gen_add(&t, 0, 0, 1.0 + ground);
    gen_add(&t, 1, 0, -1.0);
    gen_add(&t, 1, 1, 1.0 + w);
    gen_add(&t, 2, 1, -w);
    gen_add(&t, 2, 2, w);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

static void regular_components_are_counted(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    const double m[3] = {1, 1, 1}, b[3] = {1, 0, 0};
    const sl_int of[3] = {0, 0, 0};
    for (double w = 1.0; w > 1e-14; w *= 0.3) {
        gen_matrix_t M = path3(w, 0.0), firm = path3(w, 0.125);
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_skip_null(&variants, k);
            sl_factor *F = NULL;
            sl_stats stats;
            double x[3];
            opt.mass = m;
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
            assert_int_equal(stats.factor.null, 1);
            assert_int_equal(stats.factor.regular, 0);
            SL_CHECK(sl_factor_solve(F, x, 3, b, 3, 1, NULL));
            assert_zero_mean(&M.view, of, m, x, b);
            SL_CHECK(sl_factor_refactor(F, &firm.view, &stats));
            assert_int_equal(stats.factor.null, 0);
            assert_int_equal(stats.factor.regular, 1);
            SL_CHECK(sl_factor_refactor(F, &M.view, &stats));
            assert_int_equal(stats.factor.null, 1);
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_matrix_free(&firm);
    }
}

/* S L S has the null vector S^-1 1. Given as an option, it finds the null pivot by construction. */
static void a_null_vector_may_be_given(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 7;
    for (int mesh = 0; mesh < MESHES / 4; mesh++) {
        sl_int components = 0, *of = NULL;
        gen_matrix_t M = random_mesh(&seed, &of, &components);
        const sl_int n = M.view.n_cols;
        double *scale = weights(n, seed), *z = test_reals((size_t)n);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        sl_options opt = options_skip_null(&variants, mesh % variants.count);
        for (sl_int j = 0; j < n; j++) {
            for (sl_int p = M.p[j]; p < M.p[j + 1]; p++) {
                M.x[p] *= scale[j] * scale[M.i[p]];
            }
            z[j] = 1.0 / scale[j];
        }
        opt.null_vector = z;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        assert_nulls(F, &stats, of, components);
        sl_factor_free(F);
        z[n / 2] = NAN;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.error.row, n / 2);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(scale);
        free(z);
        free(of);
    }
}

/* Indefinite matrices: a zero diagonal, a negative pivot, and null pivots whose columns are not
 * null. */
static void indefinite_matrices_are_refused(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    const double entries[4][6] = {/* a00 a10 a20 a11 a21 a22 */
                                  {0, 1, 0, 0, 0, 5},
                                  {1, 2, 0, 1, 0, 5},
                                  {1, 1, 1, 1, -1, 1},
                                  {-1, 1, 0, 2, 0, 5}};
    for (int c = 0; c < 4; c++) {
        gen_list_t t = gen_list(3);
        for (sl_int j = 0, at = 0; j < 3; j++) {
            for (sl_int i = j; i < 3; i++, at++) {
                gen_add(&t, i, j, entries[c][at]);
            }
        }
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_skip_null(&variants, k);
            sl_factor *F = NULL;
            sl_stats stats;
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
            assert_null(F);
            assert_in_range(stats.error.row, 0, 2);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_null_pivot_is_missed_or_dropped),
        cmocka_unit_test(laplacians_are_refused_by_default),
        cmocka_unit_test(definite_laplacians_are_accepted_by_default),
        cmocka_unit_test(canceled_entries_do_not_join),
        cmocka_unit_test(regular_components_are_counted),
        cmocka_unit_test(a_null_vector_may_be_given),
        cmocka_unit_test(indefinite_matrices_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
