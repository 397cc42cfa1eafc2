/* test_rigid_motions.c: several null vectors in each component are all found, and no other: elastic
 * bodies without supports, with needles, weak bridges and weights over 8 decades */
#include "tests/lib/elasticity.h"
#include "tests/lib/factor_ways.h"
#include "tests/lib/local_solve.h"

enum { SYSTEMS = 240 };

/* A random system of 1 or more bodies. Where cells are thin, no layer is weak. */
static elastic_t random_bodies(int which, uint64_t *seed) {
    const int dim = 2 + which % 2, kind = which / 2 % 4;
    const double decades = kind == 1 ? 8.0 * elastic_uniform(seed) : 0.0;
    const double thin = kind == 2 ? pow(10.0, -4.0 * elastic_uniform(seed)) : 1.0;
    const double weak = kind == 2 ? 1.0 : pow(10.0, -1.0 - 9.0 * elastic_uniform(seed));
    return elastic_make(dim, dim == 2 ? 12 : 5, decades, thin, weak, kind == 3 || which % 3 == 0,
                        seed);
}

/* All null vectors of all bodies have a null row, and each body has its number of them. */
static void assert_nulls(const elastic_t *y, const sl_factor *F, const sl_stats *stats) {
    sl_int *rows = test_ints((size_t)y->null), *of_body = test_ints((size_t)y->bodies), count = 0;
    assert_int_equal(stats->factor.null, y->null);
    assert_int_equal(stats->factor.regular, 0);
    assert_int_equal(stats->factor.negative, 0);
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, rows, NULL, y->null, &count));
    assert_int_equal(count, y->null);
    for (sl_int k = 0; k < count; k++) {
        if (y->body[rows[k]] != -1) {
            of_body[y->body[rows[k]]]++;
        }
    }
    for (sl_int k = 0; k < y->bodies; k++) {
        assert_int_equal(of_body[k], y->rigid);
    }
    free(rows);
    free(of_body);
}

static void assert_solves(const sl_csc *A, const sl_factor *F, uint64_t seed) {
    const size_t n = (size_t)A->n_cols;
    double *b = consistent(A, seed), *x = test_reals(n);
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    BACKWARD_PASSES(A, x, n, b, n, 1);
    free(b);
    free(x);
}

/* The null rows are far enough from each other: without them the condition grows little. Checked on
 * the solutions: for b = A x they are x minus a rigid motion of the size of x. */
static void assert_solution_is_small(const elastic_t *y, const sl_factor *F, uint64_t seed) {
    const size_t n = (size_t)y->n;
    double *b = consistent(&y->A, seed), *x = test_reals(n), largest = 0.0;
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    for (size_t i = 0; i < n; i++) {
        largest = fmax(largest, fabs(x[i]));
    }
    assert_true(largest < 200.0); /* x was below 1; found: 19 */
    free(b);
    free(x);
}

/* Any b without the check: the residual is nonzero in the null rows only, and local solves have the
 * bits of the full solve. */
static void assert_unchecked(const elastic_t *y, const sl_symbolic *S, const sl_options *plain,
                             uint64_t seed) {
    const size_t n = (size_t)y->n;
    sl_options opt = *plain;
    sl_factor *F = NULL;
    double *b = test_reals(n), *x = test_reals(n), *r = test_reals(n), eta, largest = 0.0;
    sl_int *rows = test_ints(n), count = 0;
    opt.consistency_tolerance = -1.0;
    gen_reals(b, n, seed);
    SL_CHECK(sl_factor_create(&F, S, &y->A, FOR_FACTOR(&opt), NULL));
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    SL_CHECK(sl_csc_residual(&y->A, r, n, &eta, x, n, b, n, 1));
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, rows, NULL, y->n, &count));
    for (sl_int k = 0; k < count; k++) {
        b[rows[k]] -= r[rows[k]];
        largest = fmax(largest, fabs(r[rows[k]]));
        assert_true(fabs(x[rows[k]]) < 1e-290);
    }
    assert_true(largest > 0.0);
    BACKWARD_PASSES(&y->A, x, n, b, n, 1);
    for (int k = 0; k < 4; k++) {
        local_solve_t q =
            local_solve_random(F, y->n, k < 3 ? 1 + k : -1, 5, 1 + 3 * k, seed + (uint64_t)k);
        local_solve_check(S, F, &q, NULL);
        local_solve_free(&q);
    }
    sl_factor_free(F);
    free(b);
    free(x);
    free(r);
    free(rows);
}

static void no_rigid_motion_is_missed_or_dropped(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 5;
    for (int system = 0; system < SYSTEMS; system++) {
        elastic_t y = random_bodies(system, &seed);
        sl_options opt = options_rigid(&y, &variants, system % variants.count);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL, *G = NULL;
        sl_stats stats;
        sl_int changed = gen_below(&seed, y.n);
        SL_CHECK(sl_symbolic_create(&S, &y.A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        assert_nulls(&y, F, &stats);
        assert_solves(&y.A, F, seed);
        if (system / 2 % 4 == 0) { /* not a badly conditioned body */
            assert_solution_is_small(&y, F, seed);
        }
        assert_unchecked(&y, S, &opt, seed);
        assert_ways_agree(S, &y.A, F, &opt);
        SL_CHECK(sl_factor_create(&G, S, &y.A, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_refactor(G, &y.A, &stats));
        assert_nulls(&y, G, &stats);
        assert_same_bits(F, G);
        SL_CHECK(sl_factor_change_entries(G, &y.A, NULL, &changed, NULL, 1, NULL, &stats));
        assert_nulls(&y, G, &stats);
        assert_solves(&y.A, G, seed);
        sl_factor_free(F);
        sl_factor_free(G);
        sl_symbolic_free(S);
        elastic_free(&y);
    }
}

/* Rotations about a point that is 1e6 away: nearly combinations of translations. */
static void rotations_may_be_about_a_distant_point(void **state) {
    (void)state;
    static const double center[3] = {-1e6, 2e6, 3e5};
    variant_list_t variants = variants_present();
    uint64_t seed = 6;
    for (int system = 0; system < SYSTEMS / 4; system++) {
        elastic_t y = random_bodies(system, &seed);
        sl_options opt = options_rigid(&y, &variants, system % variants.count);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        elastic_rigid(&y, y.Z, center);
        SL_CHECK(sl_symbolic_create(&S, &y.A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        assert_nulls(&y, F, &stats);
        assert_solves(&y.A, F, seed);
        sl_factor_free(F);
        sl_symbolic_free(S);
        elastic_free(&y);
    }
}

/* A body that springs hold in some rows of one node: what remains are the rotations about it and,
 * if not all rows are held, translations, which are combinations of the given vectors. Releasing
 * and holding it by sl_factor_change_entries finds and drops the others. */
static void what_a_support_leaves_is_found(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 7;
    for (int system = 0; system < SYSTEMS / 4; system++) {
        elastic_t y = random_bodies(8 * system + 3 - system % 2, &seed);
        sl_options opt = options_rigid(&y, &variants, system % variants.count);
        const sl_int held = 1 + gen_below(&seed, y.dim), node = gen_below(&seed, y.n / y.dim);
        const double spring = pow(10.0, 2.0 - 6.0 * elastic_uniform(&seed));
        double *x = test_reals((size_t)y.A.p[y.n]);
        const int is_single = y.body[node * y.dim] == -1;
        sl_int columns[3] = {node * y.dim, node * y.dim + 1, node * y.dim + 2};
        sl_csc firm = y.A;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        memcpy(x, y.A.x, (size_t)y.A.p[y.n] * sizeof *x);
        firm.x = x;
        for (sl_int c = 0; c < held && !is_single; c++) {
            for (sl_int p = y.A.p[columns[c]]; p < y.A.p[columns[c] + 1]; p++) {
                x[p] += y.A.i[p] == columns[c] ? spring : 0.0;
            }
        }
        const sl_int left = y.null - (is_single ? 0 : held);
        SL_CHECK(sl_symbolic_create(&S, &firm, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &firm, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.factor.null, left);
        assert_solves(&firm, F, seed);
        for (int again = 0; again < 2; again++) {
            SL_CHECK(sl_factor_change_entries(F, &y.A, NULL, columns, NULL, y.dim, NULL, &stats));
            assert_nulls(&y, F, &stats);
            assert_solves(&y.A, F, seed);
            SL_CHECK(sl_factor_change_entries(F, &firm, NULL, columns, NULL, y.dim, NULL, &stats));
            assert_int_equal(stats.factor.null, left);
            assert_solves(&firm, F, seed);
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
        elastic_free(&y);
        free(x);
    }
}

/* A body that is held in as many rows as it has rigid motions is regular. */
static void a_held_body_is_regular(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 8;
    for (int dim = 2; dim <= 3; dim++) {
        elastic_t y = elastic_make(dim, 4, 0.0, 1.0, 1.0, 0, &seed);
        double *x = test_reals((size_t)y.A.p[y.n]);
        sl_csc firm = y.A;
        sl_symbolic *S = NULL;
        firm.x = x;
        for (sl_int j = 0; j < y.n; j++) {
            for (sl_int p = y.A.p[j]; p < y.A.p[j + 1]; p++) {
                x[p] = y.A.x[p] + (y.A.i[p] == j ? 0.01 : 0.0);
            }
        }
        SL_CHECK(sl_symbolic_create(&S, &firm, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_rigid(&y, &variants, k);
            sl_factor *F = NULL;
            sl_stats stats;
            SL_CHECK(sl_factor_create(&F, S, &firm, FOR_FACTOR(&opt), &stats));
            assert_int_equal(stats.factor.null, 0);
            assert_int_equal(stats.factor.regular, 1);
            assert_solves(&firm, F, seed);
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        elastic_free(&y);
        free(x);
    }
}

/* Several components in one tree of the elimination forest: dim Laplacians of a grid, row dim i + c
 * for vertex i, with explicit zeros between them. As many vectors as there are null pivots are
 * enough, fewer are refused. */
static void components_of_one_tree_share_the_columns(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (sl_int dim = 2; dim <= 4; dim++) {
        sl_int components = 0;
        gen_matrix_t L = laplacian_of(GEN_GRID2, 40, 0, &components, NULL);
        const sl_int m = L.view.n_cols, n = dim * m;
        double *Z = test_reals((size_t)(n * dim));
        gen_list_t t = gen_list(n);
        sl_symbolic *S = NULL;
        for (sl_int j = 0; j < m; j++) {
            for (sl_int p = L.p[j]; p < L.p[j + 1]; p++) {
                for (sl_int cd = 0; cd < dim * dim; cd++) {
                    const sl_int c = cd / dim, d = cd % dim, i = dim * L.i[p] + c;
                    if (i >= dim * j + d) {
                        gen_add(&t, i, dim * j + d, c == d ? L.x[p] : 0.0);
                    }
                }
            }
        }
        for (sl_int i = 0; i < n; i++) {
            Z[i + i % dim * n] = 1.0;
        }
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_skip_null(&variants, k);
            sl_factor *F = NULL;
            sl_stats stats;
            opt.null_vector = Z;
            opt.null_vector_count = dim;
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
            assert_int_equal(stats.factor.null, dim);
            assert_solves(&M.view, F, 3);
            sl_factor_free(F);
            for (sl_int i = 0; i < n; i++) { /* two columns are too few for three components */
                Z[i + i % dim * n] = 0.0;
                Z[i + i % 2 * n] = 1.0;
            }
            opt.null_vector_count = 2;
            SL_EXPECT(dim == 2 ? SL_OK : SL_ERR_UNSUPPORTED,
                      sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
            sl_factor_free(F);
            for (sl_int i = 0; i < n; i++) {
                Z[i + i % 2 * n] = 0.0;
                Z[i + i % dim * n] = 1.0;
            }
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_matrix_free(&L);
        gen_list_free(&t);
        free(Z);
    }
}

/* Where the vectors are 0 nothing is known, and the tolerance decides; so it does where A Z
 * overflows. Entries that are not finite are refused. */
static void without_a_null_vector_the_tolerance_decides(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    sl_int components = 0;
    gen_matrix_t L = laplacian(GEN_GRID2, 64, 0, &components);
    const sl_int n = L.view.n_cols;
    double *Z = test_reals(2 * (size_t)n), *kept = test_reals((size_t)L.p[n]);
    sl_symbolic *S = NULL;
    memcpy(kept, L.x, (size_t)L.p[n] * sizeof *kept);
    SL_CHECK(sl_symbolic_create(&S, &L.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        sl_stats stats;
        opt.null_vector = Z;
        opt.null_vector_count = 2;
        SL_CHECK(sl_factor_create(&F, S, &L.view, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.factor.null, 1);
        assert_solves(&L.view, F, 5);
        sl_factor_free(F);
        for (sl_int i = 0; i < n; i++) { /* |A| |Z| overflows */
            Z[i] = 1.0;
            Z[n + i] = i % 2 ? 1.0 : -1.0;
        }
        for (sl_int p = 0; p < L.p[n]; p++) {
            L.x[p] = kept[p] / 4.0 * DBL_MAX;
        }
        const sl_status status = sl_factor_create(&F, S, &L.view, FOR_FACTOR(&opt), &stats);
        assert_true(status == SL_OK ? stats.factor.null == 1 : F == NULL);
        sl_factor_free(F);
        memcpy(L.x, kept, (size_t)L.p[n] * sizeof *kept);
        L.x[5] = NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_create(&F, S, &L.view, FOR_FACTOR(&opt), &stats));
        L.x[5] = kept[5];
        memset(Z, 0, 2 * (size_t)n * sizeof *Z);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&L);
    free(Z);
    free(kept);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_rigid_motion_is_missed_or_dropped),
        cmocka_unit_test(rotations_may_be_about_a_distant_point),
        cmocka_unit_test(what_a_support_leaves_is_found),
        cmocka_unit_test(a_held_body_is_regular),
        cmocka_unit_test(components_of_one_tree_share_the_columns),
        cmocka_unit_test(without_a_null_vector_the_tolerance_decides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
