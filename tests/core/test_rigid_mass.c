/* test_rigid_mass.c: options.mass with several null vectors: solutions without rigid motions, by
 * every kind of solve */
#include "tests/lib/rigid_mass.h"
#include "tests/lib/factor_ways.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/saved.h"
#include "tests/lib/zero_mean.h"
#include "tests/lib/constraint_calls.h"

static void solutions_have_no_rigid_motion(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 3;
    for (int which = 0; which < 240; which++) {
        weighed_t f = weighed_make(which, &variants, which % variants.count, &seed);
        const sl_int column = gen_below(&seed, f.y.n);
        assert_means(&f, f.F);
        SL_CHECK(sl_factor_refactor(f.F, &f.y.A, NULL));
        assert_means(&f, f.F);
        SL_CHECK(sl_factor_change_entries(f.F, &f.y.A, NULL, &column, NULL, 1, NULL, NULL));
        assert_means(&f, f.F);
        weighed_free(&f);
    }
}

/* The solution of the dense system [A M C; C' M 0] of all bodies, with 1 on the diagonal of rows of
 * zeros. */
static void assert_dense(const weighed_t *f) {
    const sl_int rows = f->y.n, n = rows + f->y.bodies * f->y.rigid;
    double *A = ref_dense(&f->y.A), *K = test_reals((size_t)n * (size_t)n);
    double *y = test_reals((size_t)n), most = 0.0;
    for (sl_int j = 0; j < rows; j++) {
        const sl_int body = f->y.body[j];
        for (sl_int i = 0; i < rows; i++) {
            AT(K, i, j) = A[(size_t)i + (size_t)rows * (size_t)j];
        }
        AT(K, j, j) += body == -1 ? 1.0 : 0.0;
        for (sl_int c = 0; c < f->y.rigid && body != -1; c++) {
            const sl_int at = rows + body * f->y.rigid + c;
            AT(K, at, j) = AT(K, j, at) = f->m[j] * f->C[(size_t)j + (size_t)c * f->n];
        }
        y[j] = body == -1 ? 0.0 : f->b[j];
    }
    const double bound = n * DBL_EPSILON * ref_condition(n, K);
    ref_solve(n, K, y, 1);
    for (sl_int i = 0; i < rows; i++) {
        most = fmax(most, fabs(y[i]));
    }
    for (sl_int i = 0; i < rows; i++) {
        assert_true(fabs(f->x[i] - y[i]) <= bound * most);
    }
    free(A);
    free(K);
    free(y);
}

static void solutions_equal_dense_bordered_systems(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 4;
    for (int which = 0; which < 48; which++) {
        weighed_t f = weighed_make(which, &variants, which % variants.count, &seed);
        assert_means(&f, f.F);
        assert_dense(&f);
        weighed_free(&f);
    }
}

/* Every kind of solve gives the bits of the full one, every kind of factorization those of a plain
 * one, and so does a saved factor. Nothing allocates once the workspace has grown. */
static void every_way_gives_the_same_bits(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 5;
    for (int which = 0; which < 12 * variants.count; which++) {
        weighed_t f = weighed_make(which, &variants, which / 12, &seed);
        const sl_int n = f.y.n;
        double *B = test_reals(f.n * 9), *X = test_reals(f.n * 9), *Y = test_reals(f.n * 9);
        sl_work *W = NULL;
        SL_CHECK(sl_work_create(&W, NULL));
        for (int k = 0; k < 6; k++) {
            static const sl_int nb[6] = {1, 1, 12, -1, 8, 0}, nx[6] = {1, 8, -1, 5, 8, 3};
            local_solve_t q = local_solve_random(
                f.F, n, nb[k], nx[k], 1 + which % 9 + 16 * (which % 4), (uint64_t)(which + 10 * k));
            local_solve_check(f.S, f.F, &q, W);
            local_solve_free(&q);
        }
        assert_ways_agree(f.S, &f.y.A, f.F, &f.opt);
        double *many = test_reals(f.n * 48), *wide = test_reals(f.n * 48);
        gen_reals(many, f.n * 48, seed + 1);
        SL_CHECK(sl_factor_solve(f.F, wide, f.n, many, f.n, 48, W)); /* blocks of 32 and 16 */
        for (size_t r = 0; r < 48; r += 8) {
            SL_CHECK(sl_factor_solve(f.F, many + r * f.n, f.n, many + r * f.n, f.n, 8, W));
        }
        SAME_VALUES(many, wide, f.n * 48);
        free(many);
        free(wide);
        gen_reals(B, f.n * 9, seed);
        SL_CHECK(sl_factor_solve(f.F, X, f.n, B, f.n, 9, W));
        for (size_t i = 0; i < f.n * 9; i++) {
            Y[i % f.n * 9 + i / f.n] = B[i];
        }
        SL_CHECK(sl_factor_solve(f.F, Y, SL_ROWS(9), Y, SL_ROWS(9), 9, W));
        for (size_t i = 0; i < f.n * 9; i++) {
            assert_true(same_value(Y[i % f.n * 9 + i / f.n], X[i]));
        }
        sl_request request = {NULL, Y, f.n, B, f.n, 9, NULL};
        SL_CHECK(sl_batch_solve(f.F, &request, 1, NULL, NULL, NULL));
        SAME_VALUES(Y, X, f.n * 9);
        saved_t saved = saved_make(f.S, f.F);
        for (int way = 0; way < 2; way++) {
            const saved_call_t call = way == 0 ? pair_load_memory : pair_map_memory;
            sl_options use = options_none();
            sl_symbolic *S = NULL;
            sl_factor *G = NULL;
            use.isa = f.opt.isa;
            SL_CHECK(call(&S, &G, saved.bytes, saved.size, SL_LOAD_VERIFIED, &use));
            assert_same_answers(f.F, G);
            if (way == 0) {
                SL_CHECK(sl_factor_refactor(G, &f.y.A, NULL));
                assert_same_answers(f.F, G);
            }
            sl_factor_free(G);
            sl_symbolic_free(S);
        }
        saved_free(&saved);
        sl_work_free(W);
        weighed_free(&f);
        free(B);
        free(X);
        free(Y);
    }
}

/* Refinement keeps the solution free of rigid motions, with L in float, too. */
static void solutions_are_refined(void **state) {
    (void)state;
    static const sl_storage storages[2] = {SL_STORAGE_DOUBLE, SL_STORAGE_FLOAT};
    variant_list_t variants = variants_present();
    uint64_t seed = 6;
    for (int which = 0; which < 72; which++) {
        weighed_t f = weighed_make(which, &variants, which % variants.count, &seed);
        sl_options opt = f.opt;
        sl_factor *F = NULL;
        double *b = consistent(&f.y.A, seed);
        opt.storage = storages[which / 2 % 2];
        opt.method = opt.storage == SL_STORAGE_DOUBLE ? opt.method : SL_METHOD_AUTO;
        opt.mass = f.m;
        SL_CHECK(sl_factor_create(&F, f.S, &f.y.A, &opt, NULL));
        SL_CHECK(sl_factor_solve(F, f.x, f.n, b, f.n, 1, NULL));
        SL_CHECK(sl_factor_refine(F, &f.y.A, f.x, f.n, b, f.n, 1, 8, NULL, NULL));
        BACKWARD_PASSES(&f.y.A, f.x, f.n, b, f.n, 1);
        assert_rigid_mean(&f.y, f.C, f.m, f.x, b, opt.storage == SL_STORAGE_DOUBLE ? 1.0 : 1e9);
        sl_factor_free(F);
        weighed_free(&f);
        free(b);
    }
}

/* Pins on the first body: it has no residual but in pinned rows. The others are as without pins. */
static void bodies_without_pins_are_centered(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 7;
    for (int which = 0; which < 36; which++) {
        weighed_t f = weighed_make(3 * which, &variants, which % variants.count, &seed);
        double *g = test_reals(f.n), *p = test_reals(f.n), *r = test_reals(f.n), most = 0.0;
        double entry = 0.0;
        sl_int count = 0;
        sl_constraints *P = NULL;
        SL_CHECK(sl_constraints_create(&P, f.F, NULL));
        for (sl_int i = 0; i < f.y.n; i++) {
            if (f.y.body[i] == 0 && i / f.y.dim % 2 == 0) {
                SL_CHECK(pin_row(P, i, NULL));
                count++;
            }
        }
        gen_reals(g, f.n, seed);
        assert_means(&f, f.F);
        SL_CHECK(sl_constraints_solve(P, NULL, p, f.n, f.b, f.n, g, (size_t)count, 1, NULL));
        SL_CHECK(sl_csc_residual(&f.y.A, r, f.n, NULL, p, f.n, f.b, f.n, 1));
        for (sl_int k = 0; k < f.y.A.p[f.y.n]; k++) {
            entry = fmax(entry, fabs(f.y.A.x[k]));
        }
        for (sl_int i = 0; i < f.y.n; i++) {
            most = fmax(most, fabs(p[i]));
        }
        count = 0;
        for (sl_int i = 0; i < f.y.n; i++) {
            if (f.y.body[i] != 0) {
                assert_true(fabs(p[i] - f.x[i]) <= 1e-11 * most);
            } else if (i / f.y.dim % 2 == 0) {
                assert_true(fabs(p[i] - g[count++]) <= 1e-10 * most);
            } else {
                assert_true(fabs(r[i]) <= 1e-10 * entry * most);
            }
        }
        sl_constraints_free(P);
        weighed_free(&f);
        free(g);
        free(p);
        free(r);
    }
}

/* A Laplacian and two columns, one constant and one at random, give the zero-mean solutions of
 * one vector. */
static void one_of_several_vectors_is_as_one(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < LAPLACIAN_KINDS; kind++) {
        sl_int components = 0, *of = test_ints(80);
        gen_matrix_t M = laplacian_of(laplacian_kinds[kind], 80, 0, &components, of);
        const size_t n = (size_t)M.view.n_cols;
        double *m = weights((sl_int)n, 3), *Z = test_reals(2 * n), *b = test_reals(n);
        double *x = test_reals(n), *y = test_reals(n);
        sl_symbolic *S = NULL;
        gen_reals(Z, 2 * n, 4);
        gen_reals(b, n, 5);
        for (size_t i = 0; i < n; i++) {
            Z[n + i] = 1.0;
        }
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_skip_null(&variants, k);
            sl_factor *F = NULL, *G = NULL;
            double most = 0.0;
            opt.mass = m;
            SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
            opt.null_vector = Z;
            opt.null_vector_count = 2;
            SL_CHECK(sl_factor_create(&G, S, &M.view, &opt, NULL));
            SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
            SL_CHECK(sl_factor_solve(G, y, n, b, n, 1, NULL));
            assert_zero_mean(&M.view, of, m, y, b);
            for (size_t i = 0; i < n; i++) {
                most = fmax(most, fabs(x[i]));
            }
            for (size_t i = 0; i < n; i++) {
                assert_true(fabs(x[i] - y[i]) <= 1e-11 * most + 1e-290);
            }
            sl_factor_free(F);
            sl_factor_free(G);
        }
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(of);
        free(m);
        free(Z);
        free(b);
        free(x);
        free(y);
    }
}

/* Several components in one tree of the elimination forest: a grid's Laplacian for each direction,
 * with explicit zeros between them. Each direction has its own mean. */
static void components_of_one_tree_have_their_own_means(void **state) {
    (void)state;
    enum { DIM = 3, SIDE = 5, M = SIDE * SIDE, ROWS = DIM * M };
    variant_list_t variants = variants_present();
    gen_list_t t = gen_list(ROWS);
    double *Z = test_reals(DIM * ROWS), *m = weights(ROWS, 2), *b = test_reals(ROWS);
    double *x = test_reals(ROWS);
    sl_int of[ROWS];
    sl_symbolic *S = NULL;
    for (sl_int i = 0; i < M; i++) {
        for (sl_int c = 0; c < DIM; c++) {
            const sl_int k = DIM * i + c, right = i % SIDE + 1 < SIDE, up = i + SIDE < M;
            of[k] = c;
            Z[k + c * ROWS] = 1.0;
            gen_add(&t, k, k, (double)(right + up + (i % SIDE > 0) + (i >= SIDE)));
            for (sl_int d = 0; d < DIM; d++) { /* 0 between directions */
                if (d > c) {
                    gen_add(&t, DIM * i + d, k, 0.0);
                }
                if (right) {
                    gen_add(&t, DIM * (i + 1) + d, k, c == d ? -1.0 : 0.0);
                }
                if (up) {
                    gen_add(&t, DIM * (i + SIDE) + d, k, c == d ? -1.0 : 0.0);
                }
            }
        }
    }
    gen_matrix_t A = gen_store(&t, gen_style(0), 1);
    gen_reals(b, ROWS, 3);
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_skip_null(&variants, k);
        sl_factor *F = NULL;
        opt.mass = m;
        opt.null_vector = Z;
        opt.null_vector_count = DIM;
        SL_CHECK(sl_factor_create(&F, S, &A.view, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_solve(F, x, ROWS, b, ROWS, 1, NULL));
        assert_zero_mean(&A.view, of, m, x, b);
        local_solve_t q = local_solve_random(F, ROWS, 2, 9, 3, 8);
        local_solve_check(S, F, &q, NULL);
        local_solve_free(&q);
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&A);
    gen_list_free(&t);
    free(Z);
    free(m);
    free(b);
    free(x);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_have_no_rigid_motion),
        cmocka_unit_test(solutions_equal_dense_bordered_systems),
        cmocka_unit_test(every_way_gives_the_same_bits),
        cmocka_unit_test(solutions_are_refined),
        cmocka_unit_test(bodies_without_pins_are_centered),
        cmocka_unit_test(one_of_several_vectors_is_as_one),
        cmocka_unit_test(components_of_one_tree_have_their_own_means),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
