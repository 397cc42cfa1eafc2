/* test_storage.c: L in float: the bits of a rounded L in every call, refinement */
#include "tests/lib/factored.h"
#include "tests/lib/float_storage.h"
#include "tests/lib/graph_laplacian.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/parallel_for.h"

/* L in float is L in double, rounded, and D is the same, with any number of threads. */
static void the_double_factor_is_rounded(void **state) {
    (void)state;
    const isa_list_t isas = isas_with_storages();
    int calls = 0;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < 2 * isas.count; k++) {
            sl_options opt = options_float(isas.isa[k / 2]);
            opt.storage = SL_STORAGE_DOUBLE;
            factored_t y = factored_make((gen_kind_t)kind, 200, 1, kind % GEN_STYLES, &opt);
            sl_factor *G = NULL;
            opt.storage = SL_STORAGE_FLOAT;
            opt.threads.count = k % 2 ? 3 : 0;
            opt.threads.run = k % 2 ? run_backwards : NULL;
            opt.threads.context = &calls;
            SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
            const sl_factor_arrays f = sl_factor_view(y.F), g = sl_factor_view(G);
            assert_null(f.L_float);
            assert_null(g.L);
            for (sl_off at = 0; at < panel_doubles(y.F); at++) {
                assert_true(g.L_float[at] == (float)f.L[at]);
            }
            SAME_VALUES(f.D, g.D, (size_t)y.M.view.n_cols);
            SL_CHECK(sl_factor_refactor(G, &y.M.view, NULL));
            for (sl_off at = 0; at < panel_doubles(y.F); at++) {
                assert_true(g.L_float[at] == (float)f.L[at]);
            }
            sl_factor_free(G);
            factored_free(&y);
        }
    }
}

/* Beside SIMD, plain C keeps L in double: the factor is that of SL_STORAGE_DOUBLE. */
static void plain_c_keeps_double_beside_simd(void **state) {
    (void)state;
    for (int kind = GEN_NONE; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < 2; k++) {
            sl_options opt = options_of(SL_STORAGE_DOUBLE, SL_ISA_SCALAR);
            factored_t y = factored_make((gen_kind_t)kind, 200, 1, kind % GEN_STYLES, &opt);
            const sl_storage kept =
                isa_keeps_storage(SL_ISA_SCALAR) ? SL_STORAGE_FLOAT : opt.storage;
            sl_factor *G = NULL;
            sl_stats stats;
            opt.storage = SL_STORAGE_FLOAT;
            SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, &stats));
            assert_int_equal(stats.factor.storage, kept);
            stats.factor = sl_factor_view(G).info;
            assert_int_equal(stats.factor.storage, kept);
            assert_int_equal(sl_factor_view(G).L_float == NULL, kept == SL_STORAGE_DOUBLE);
            if (kept == SL_STORAGE_DOUBLE) {
                assert_same_bits(y.F, G);
            }
            sl_factor_free(G);
            factored_free(&y);
        }
    }
}

/* ---- a matrix whose L is exact in float: both types give the same bits ---- */

typedef struct exact_t {
    sl_int n;
    gen_matrix_t M;
    sl_symbolic *S;
    sl_factor *F[2]; /* in double and in float */
} exact_t;

/* An entry of L: 1/2 or -1/4. D has powers of 2, so that no operation on A = L D L' rounds. */
static double exact_entry(uint64_t *random) {
    return gen_below(random, 2) ? 0.5 : -0.25;
}

/* L, n x n, with two entries in a column. The last `dense` columns are full, so that supernodes are
 * wide. */
static double *exact_random(sl_int n, sl_int dense) {
    double *L = test_reals((size_t)n * (size_t)n);
    uint64_t random = 11;
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = j + 1; i < n; i++) {
            if (j >= n - dense || gen_below(&random, n) < 2) {
                L[(size_t)j * (size_t)n + (size_t)i] = exact_entry(&random);
            }
        }
    }
    return L;
}

/* L with supernodes of each width 2 .. 8, each with 0 .. CLIQUE_MOST rows below, which are some of
 * the last CLIQUE_ROOT rows. */
enum { CLIQUE_MOST = 10, CLIQUE_ROOT = 12, CLIQUES = 7 * (CLIQUE_MOST + 1) };

static double *exact_cliques(sl_int *n) {
    *n = 35 * (CLIQUE_MOST + 1) + CLIQUE_ROOT;
    const size_t m = (size_t)*n;
    double *L = test_reals(m * m);
    sl_int first = 0, below[CLIQUE_ROOT];
    uint64_t random = 13;
    for (sl_int k = 0; k <= CLIQUES; k++) {
        const sl_int w = k < CLIQUES ? 2 + k % 7 : CLIQUE_ROOT, count = k < CLIQUES ? k / 7 : 0;
        gen_set(below, count, CLIQUE_ROOT, gen_bits(&random));
        for (sl_int j = first; j < first + w; j++) {
            for (sl_int i = j + 1; i < first + w + count; i++) {
                const sl_int row = i < first + w ? i : *n - 1 - below[i - first - w];
                L[(size_t)j * m + (size_t)row] = exact_entry(&random);
            }
        }
        first += w;
    }
    assert_int_equal(first, *n);
    return L;
}

/* Takes L; the caller releases the result. */
static exact_t exact_make(sl_int n, double *L, sl_relaxation relaxation, sl_storage storage,
                          sl_isa isa) {
    exact_t e = {n, {NULL, NULL, NULL, {0, 0, NULL, NULL, NULL}}, NULL, {NULL, NULL}};
    const size_t m = (size_t)n;
    double *D = test_reals(m);
    gen_list_t t = gen_list(n);
    uint64_t random = 12;
    for (sl_int j = 0; j < n; j++) {
        D[j] = gen_below(&random, 2) ? 1.0 : 4.0;
        L[(size_t)j * m + (size_t)j] = 1.0;
    }
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = j; i < n; i++) {
            double a = 0.0;
            for (sl_int k = 0; k <= j; k++) {
                a += L[(size_t)k * m + (size_t)i] * D[k] * L[(size_t)k * m + (size_t)j];
            }
            if (a != 0.0 || i == j) {
                gen_add(&t, i, j, a);
            }
        }
    }
    e.M = gen_store(&t, gen_style(0), 1);
    e.S = analyze_natural(&e.M.view, relaxation);
    for (int k = 0; k < 2; k++) {
        const sl_options opt = options_of(k == 0 ? SL_STORAGE_DOUBLE : storage, isa);
        SL_CHECK(sl_factor_create(&e.F[k], e.S, &e.M.view, &opt, NULL));
    }
    const sl_factor_arrays f = sl_factor_view(e.F[0]), g = sl_factor_view(e.F[1]);
    for (sl_off at = 0; at < panel_doubles(e.F[0]); at++) {
        assert_true((double)g.L_float[at] == f.L[at]);
    }
    gen_list_free(&t);
    free(L);
    free(D);
    return e;
}

static void exact_free(exact_t *e) {
    sl_factor_free(e->F[0]);
    sl_factor_free(e->F[1]);
    sl_symbolic_free(e->S);
    gen_matrix_free(&e->M);
}

/* Full solves, half solves and products for 1 to 9 right-hand sides, and for 16 and more. */
static void exact_solves(const exact_t *e) {
    static const unsigned parts[5] = {SL_PART_P | SL_PART_L, SL_PART_LT | SL_PART_PT, SL_PART_L,
                                      SL_PART_LT, SL_PART_P | SL_PART_L | SL_PART_SQRT_D};
    const size_t n = (size_t)e->n;
    double *B = test_reals(17 * n), *X = test_reals(17 * n), *Y = test_reals(17 * n);
    gen_reals(B, 17 * n, 3);
    for (sl_int nrhs = 1; nrhs <= 17; nrhs += nrhs == 9 ? 7 : 1) {
        const size_t count = n * (size_t)nrhs;
        SL_CHECK(sl_factor_solve(e->F[0], X, n, B, n, nrhs, NULL));
        SL_CHECK(sl_factor_solve(e->F[1], Y, n, B, n, nrhs, NULL));
        SAME_VALUES(X, Y, count);
        for (int p = 0; p < 5; p++) {
            SL_CHECK(sl_factor_solve_part(e->F[0], NULL, parts[p], X, n, B, n, nrhs, NULL));
            SL_CHECK(sl_factor_solve_part(e->F[1], NULL, parts[p], Y, n, B, n, nrhs, NULL));
            SAME_VALUES(X, Y, count);
            SL_CHECK(sl_factor_multiply_part(e->F[0], parts[p], X, n, B, n, nrhs, NULL));
            SL_CHECK(sl_factor_multiply_part(e->F[1], parts[p], Y, n, B, n, nrhs, NULL));
            SAME_VALUES(X, Y, count);
        }
    }
    free(B);
    free(X);
    free(Y);
}

/* The diagonal of the inverse, a block, the selected inverse, batches. */
static void exact_inverses(const exact_t *e) {
    const size_t n = (size_t)e->n;
    double *X = test_reals(n * (n + 1)), *Y = test_reals(n * (n + 1));
    sl_int *rows = test_ints(n);
    double *const to[2] = {X, Y};
    gen_set(rows, e->n, e->n, 8);
    for (int k = 0; k < 2; k++) {
        SL_CHECK(sl_inverse_diagonal(e->F[k], to[k], NULL, e->n, NULL, NULL));
    }
    SAME_VALUES(X, Y, n);
    for (sl_int count = 1; count <= e->n; count = 3 * count + 1) {
        for (int k = 0; k < 2; k++) {
            SL_CHECK(sl_inverse_block(e->F[k], to[k], n, rows, count, rows, count, NULL, NULL));
        }
        SAME_VALUES(X, Y, n * (size_t)count);
        for (int k = 0; k < 2; k++) {
            SL_CHECK(sl_inverse_diagonal(e->F[k], to[k], rows, count, NULL, NULL));
        }
        SAME_VALUES(X, Y, (size_t)count);
    }
    for (int k = 0; k < 2; k++) {
        sl_selected *Z = NULL;
        SL_CHECK(sl_selected_create(&Z, e->F[k], NULL, SL_ALL, NULL, NULL));
        SL_CHECK(sl_selected_entries(Z, to[k], NULL, NULL, e->n, NULL));
        SL_CHECK(sl_selected_refactor(Z, e->F[1 - k], NULL)); /* the other type of L */
        SL_CHECK(sl_selected_entries(Z, to[k] + n, NULL, NULL, e->n, NULL));
        SAME_VALUES(to[k], to[k] + n, n);
        sl_selected_free(Z);
    }
    SAME_VALUES(X, Y, n);
    free(X);
    free(Y);
    free(rows);
}

static void an_exact_factor_gives_the_same_bits(void **state) {
    (void)state;
    const isa_list_t isas = isas_with_storages();
    static const sl_int sizes[6] = {1, 7, 8, 40, 90, 150};
    for (int k = 0; k < 12 * isas.count; k++) {
        for (sl_int dense = 0; dense <= 40; dense += 9) {
            const sl_int n = sizes[k % 6];
            exact_t e = exact_make(n, exact_random(n, dense), SL_RELAXATION_DEFAULT,
                                   SL_STORAGE_FLOAT, isas.isa[k / 12]);
            exact_solves(&e);
            exact_inverses(&e);
            exact_free(&e);
        }
    }
}

/* Sweeps through supernodes of each width, for each number of right-hand sides: the bits of both
 * types, local solves those of full ones, and small backward errors. */
static void sweeps_of_each_width_give_the_same_bits(void **state) {
    (void)state;
    const isa_list_t isas = isas_with_storages();
    for (int k = 0; k < isas.count; k++) {
        sl_int n, widths[CLIQUE_ROOT + 1] = {0};
        double *L = exact_cliques(&n);
        exact_t e = exact_make(n, L, SL_RELAXATION_NONE, SL_STORAGE_FLOAT, isas.isa[k]);
        const sl_symbolic_arrays S = sl_symbolic_view(e.S);
        double *B = test_reals(9 * (size_t)n), *X = test_reals(9 * (size_t)n);
        for (sl_int s = 0; s < S.n_supers; s++) {
            widths[S.super_first[s + 1] - S.super_first[s]]++;
        }
        for (int w = 2; w <= 8; w++) {
            assert_true(widths[w] > CLIQUE_MOST);
        }
        exact_solves(&e);
        gen_reals(B, 9 * (size_t)n, 8);
        for (sl_int nrhs = 1; nrhs <= 9; nrhs++) {
            SL_CHECK(sl_factor_solve(e.F[1], X, (size_t)n, B, (size_t)n, nrhs, NULL));
            BACKWARD_PASSES(&e.M.view, X, (size_t)n, B, (size_t)n, nrhs);
            for (int query = 0; query < 8; query++) {
                local_solve_t q = local_solve_random(e.F[query % 2], n, 1 + 5 * query, 40, nrhs,
                                                     (uint64_t)(query + 100 * nrhs));
                local_solve_check(e.S, e.F[query % 2], &q, NULL);
                local_solve_free(&q);
            }
        }
        free(B);
        free(X);
        exact_free(&e);
    }
}

/* ---- solutions ---- */

static void local_solves_equal_full_ones(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < 2 * isas.count; k++) {
            const sl_options opt = options_of(SL_STORAGE_FLOAT, isas.isa[k / 2]);
            factored_t y = factored_make((gen_kind_t)kind, 120, 1, 0, &opt);
            const sl_int n = y.M.view.n_cols;
            for (sl_int nrhs = 1; nrhs <= 9; nrhs++) {
                const sl_int nb = n < 4 ? -1 : 1 + nrhs % 3, nx = n < 10 ? -1 : nrhs;
                local_solve_t q =
                    local_solve_random(y.F, n, nb, nx, nrhs, (uint64_t)(kind + 100 * nrhs));
                local_solve_check(y.S, y.F, &q, NULL);
                local_solve_free(&q);
            }
            factored_free(&y);
        }
    }
}

/* The backward error is that of float, and two to three refinements make it that of double. */
static void refinement_brings_the_accuracy_of_double(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 2 * GEN_ONE; k < 2 * GEN_REGULAR; k++) {
        const sl_options opt = options_of(SL_STORAGE_FLOAT, isas.isa[k / 2 % isas.count]);
        factored_t y = factored_make((gen_kind_t)(k / 2), 300, 1, 0, &opt);
        const size_t n = (size_t)y.M.view.n_cols;
        double *B = test_reals(3 * n), *X = test_reals(3 * n);
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        gen_reals(B, 3 * n, 6);
        SL_CHECK(sl_factor_solve(y.F, X, n, B, n, 3, NULL));
        assert_true(worst_backward(&y.M.view, X, n, B, n, 3) <=
                    pass_figure((sl_int)n) * (double)FLT_EPSILON / DBL_EPSILON);
        SL_CHECK(sl_factor_refine(y.F, &y.M.view, X, n, B, n, 3, 3, NULL, &stats));
        assert_true(stats.refine.backward_error <= 1e-14);
        BACKWARD_PASSES(&y.M.view, X, n, B, n, 3);
        free(B);
        free(X);
        factored_free(&y);
    }
}

/* T^k for the second differences T of n points: integers, and the condition is about (0.4 n^2)^k.
 * Returns the status of a refinement of at most 8 steps. */
static sl_status refine_differences(sl_int n, int k, sl_stats *stats) {
    const size_t m = (size_t)n;
    const sl_options opt = options_float(SL_ISA_AUTO);
    double *T = test_reals(m * m), *B = test_reals(m), *X = test_reals(m);
    gen_list_t t = gen_list(n);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    for (sl_int j = 0; j < n; j++) { /* column j of T^k, by k products with T */
        double *x = T + m * (size_t)j;
        x[j] = 1.0;
        for (int power = 0; power < k; power++) {
            double before = 0.0;
            for (sl_int i = 0; i < n; i++) {
                const double here = x[i], after = i + 1 < n ? x[i + 1] : 0.0;
                x[i] = 2.0 * here - before - after;
                before = here;
            }
        }
        for (sl_int i = j; i < n && i <= j + k; i++) {
            gen_add(&t, i, j, x[i]);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    gen_reals(X, m, 9);
    SL_CHECK(sl_csc_multiply(&M.view, SL_AS_SYMMETRIC, B, m, X, m, 1));
    SL_CHECK(sl_factor_solve(F, X, m, B, m, 1, NULL));
    const sl_status status = sl_factor_refine(F, &M.view, X, m, B, m, 1, 8, NULL, stats);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    free(T);
    free(B);
    free(X);
    return status;
}

/* Refinement converges for conditions of 6e4, 1e9 and 1e9. At 3e14 it says that it does not. */
static void refinement_says_how_far_it_came(void **state) {
    (void)state;
    static const sl_int sizes[3] = {400, 300, 50};
    for (int k = 1; k <= 3; k++) {
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_CHECK(refine_differences(sizes[k - 1], k, &stats));
        assert_true(stats.refine.backward_error <= 1e-14);
        assert_in_range(stats.refine.steps, 1, 6);
    }
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_INACCURATE, refine_differences(400, 3, &stats));
}

/* A Laplacian with weights: x has zero mean and solves A x = b - c m; without, x is 0 in the null
 * row, and an inconsistent b is refused. */
static void singular_systems_are_solved(void **state) {
    (void)state;
    for (int k = 0; k < LAPLACIAN_KINDS; k++) {
        sl_int components;
        gen_matrix_t M = laplacian(laplacian_kinds[k], 400, 0, &components);
        const size_t n = (size_t)M.view.n_cols;
        double *mass = test_reals(n), *B = test_reals(n), *X = test_reals(n);
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (size_t i = 0; i < n; i++) {
            mass[i] = 1.0;
        }
        for (int way = 0; way < 4; way++) {
            const int weighted = way / 2;
            sl_options opt = options_of(SL_STORAGE_FLOAT, SL_ISA_AUTO);
            sl_factor *F = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            opt.pivots = SL_PIVOTS_SKIP_NULL;
            opt.mass = weighted ? mass : NULL;
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
            assert_int_equal(stats.factor.null, components);
            gen_reals(X, n, 4); /* b = A x is consistent */
            SL_CHECK(sl_csc_multiply(&M.view, SL_AS_SYMMETRIC, B, n, X, n, 1));
            SL_CHECK(sl_factor_solve(F, X, n, B, n, 1, NULL));
            assert_true(worst_backward(&M.view, X, n, B, n, 1) <= 1e-5);
            SL_CHECK(sl_factor_refine(F, &M.view, X, n, B, n, 1, 3, NULL, &stats));
            assert_true(stats.refine.backward_error <= 1e-13);
            if (weighted && components == 1) {
                double sum = 0.0, size = 0.0;
                for (size_t i = 0; i < n; i++) {
                    sum += X[i];
                    size += fabs(X[i]);
                }
                assert_true(fabs(sum) <= 1e-6 * size);
            }
            B[0] += 1.0;
            SL_EXPECT(weighted ? SL_OK : SL_ERR_INCONSISTENT,
                      sl_factor_solve(F, X, n, B, n, 1, NULL));
            sl_factor_free(F);
        }
        sl_symbolic_free(S);
        free(mass);
        free(B);
        free(X);
        gen_matrix_free(&M);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_double_factor_is_rounded),
        cmocka_unit_test(plain_c_keeps_double_beside_simd),
        cmocka_unit_test(an_exact_factor_gives_the_same_bits),
        cmocka_unit_test(sweeps_of_each_width_give_the_same_bits),
        cmocka_unit_test(local_solves_equal_full_ones),
        cmocka_unit_test(refinement_brings_the_accuracy_of_double),
        cmocka_unit_test(refinement_says_how_far_it_came),
        cmocka_unit_test(singular_systems_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
