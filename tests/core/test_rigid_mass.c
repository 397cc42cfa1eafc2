/* test_rigid_mass.c: options.mass with several null vectors: solutions without rigid motions, by
 * every kind of solve */
#include "tests/lib/rigid_mass.h"
#include "tests/lib/factor_ways.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/saved.h"
#include "tests/lib/zero_mean.h"

typedef struct weighed_t {
    elastic_t y;
    sl_options opt;
    sl_symbolic *S;
    sl_factor *F;
    double *m, *C, *b, *x; /* the weights, or 1 for those that are all 0 */
    size_t n;
} weighed_t;

static weighed_t weighed_make(int which, const variant_list_t *variants, int k, uint64_t *seed) {
    const int dim = 2 + which % 2, kind = which / 2 % RIGID_MASSES;
    weighed_t f;
    f.y = elastic_make(dim, dim == 2 ? 7 : 3, which % 5 == 0 ? 3.0 : 0.0, 0.7, 1e-2, which % 3 == 0,
                       seed);
    f.opt = options_rigid(&f.y, variants, k);
    f.n = (size_t)f.y.n;
    f.m = rigid_masses(&f.y, kind, seed);
    f.b = test_reals(f.n);
    f.x = test_reals(f.n);
    gen_reals(f.b, f.n, *seed);
    f.opt.mass = f.m;
    SL_CHECK(sl_symbolic_create(&f.S, &f.y.A, NULL, NULL));
    SL_CHECK(sl_factor_create(&f.F, f.S, &f.y.A, FOR_FACTOR(&f.opt), NULL));
    for (size_t i = 0; i < f.n && kind == 4; i++) {
        f.m[i] = 1.0;
    }
    f.C = rigid_basis(&f.y, f.y.Z, f.m);
    return f;
}

static void weighed_free(weighed_t *f) {
    sl_factor_free(f->F);
    sl_symbolic_free(f->S);
    elastic_free(&f->y);
    free(f->m);
    free(f->C);
    free(f->b);
    free(f->x);
}

static void assert_means(const weighed_t *f, const sl_factor *F) {
    SL_CHECK(sl_factor_solve(F, f->x, f->n, f->b, f->n, 1, NULL));
    assert_rigid_mean(&f->y, f->C, f->m, f->x, f->b, 1.0);
}

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
        SL_CHECK(sl_factor_refactor_changed(f.F, &f.y.A, &column, 1, NULL));
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
            local_solve_t q =
                local_solve_random(f.F, n, nb[k], nx[k], 1 + which % 9, (uint64_t)(which + 10 * k));
            local_solve_check(f.S, f.F, &q, W);
            local_solve_free(&q);
        }
        assert_ways_agree(f.S, &f.y.A, f.F, &f.opt);
        gen_reals(B, f.n * 9, seed);
        SL_CHECK(sl_factor_solve(f.F, X, f.n, B, f.n, 9, W));
        for (size_t i = 0; i < f.n * 9; i++) {
            Y[i % f.n * 9 + i / f.n] = B[i];
        }
        SL_CHECK(sl_factor_solve_interleaved(f.F, Y, 9, Y, 9, 9, W));
        for (size_t i = 0; i < f.n * 9; i++) {
            assert_true(same_value(Y[i % f.n * 9 + i / f.n], X[i]));
        }
        sl_request request = {NULL, Y, f.n, B, f.n, 9, NULL};
        SL_CHECK(sl_batch_solve(f.F, &request, 1, NULL, NULL, NULL));
        SAME_VALUES(Y, X, f.n * 9);
        saved_t saved = saved_make(f.S, f.F);
        for (int way = 0; way < 2; way++) {
            const saved_call_t call = way == 0 ? sl_load_memory : sl_map_memory;
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
    static const sl_storage storages[3] = {SL_STORAGE_DOUBLE, SL_STORAGE_FLOAT,
                                           SL_STORAGE_FLOAT_FRONTS};
    variant_list_t variants = variants_present();
    uint64_t seed = 6;
    for (int which = 0; which < 72; which++) {
        weighed_t f = weighed_make(which, &variants, which % variants.count, &seed);
        sl_options opt = f.opt;
        sl_factor *F = NULL;
        double *b = consistent(&f.y.A, seed);
        opt.storage = storages[which / 2 % 3];
        opt.method = opt.storage == SL_STORAGE_DOUBLE ? opt.method : SL_METHOD_AUTO;
        opt.mass = f.m;
        const sl_status status = sl_factor_create(&F, f.S, &f.y.A, &opt, NULL);
        if (status != SL_OK) { /* float cannot tell a soft cell from none */
            assert_true(opt.storage == SL_STORAGE_FLOAT_FRONTS &&
                        (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE));
        } else {
            SL_CHECK(sl_factor_solve(F, f.x, f.n, b, f.n, 1, NULL));
            SL_CHECK(sl_factor_refine(F, &f.y.A, f.x, f.n, b, f.n, 1, 8, NULL, NULL));
            BACKWARD_PASSES(&f.y.A, f.x, f.n, b, f.n, 1);
            assert_rigid_mean(&f.y, f.C, f.m, f.x, b, opt.storage == SL_STORAGE_DOUBLE ? 1.0 : 1e9);
        }
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
        sl_pins *P = NULL;
        SL_CHECK(sl_pins_create(&P, f.F, NULL));
        for (sl_int i = 0; i < f.y.n; i++) {
            if (f.y.body[i] == 0 && i / f.y.dim % 2 == 0) {
                SL_CHECK(sl_pins_add(P, i, NULL));
                count++;
            }
        }
        gen_reals(g, f.n, seed);
        assert_means(&f, f.F);
        SL_CHECK(sl_pins_solve(P, NULL, p, f.n, f.b, f.n, g, (size_t)count, 1, NULL));
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
        sl_pins_free(P);
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

/* Weights that do not fix all motions are refused with a row of the body, and so is a null pivot
 * whose null vector is not known. */
static void what_weights_do_not_fix_is_refused(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 9;
    for (int which = 0; which < 8 * variants.count; which++) {
        const int dim = 2 + which % 2;
        elastic_t y = elastic_make(dim, dim == 2 ? 5 : 3, 0.0, 1.0, 1.0, 0, &seed);
        sl_options opt = options_rigid(&y, &variants, which / 8);
        const size_t n = (size_t)y.n;
        double *m = test_reals(n), *Z = test_reals(n * (size_t)y.rigid);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        SL_CHECK(sl_symbolic_create(&S, &y.A, NULL, NULL));
        opt.mass = m;
        const sl_int node = gen_below(&seed, y.n / dim);
        for (sl_int i = 0; i < y.n; i++) { /* of one node; one direction; sum 0; NaN */
            m[i] = which % 8 < 2   ? (double)(i / dim == node)
                   : which % 8 < 4 ? (double)(i % dim == 0)
                   : which % 8 < 6 ? (i / dim == 0) - (double)(i / dim == 1)
                   : i == 3        ? NAN
                                   : 1.0;
        }
        SL_EXPECT(which % 8 < 6 ? SL_ERR_PIVOT : SL_ERR_ARGUMENT,
                  sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        assert_null(F);
        assert_in_range(stats.error.row, 0, y.n - 1);
        for (size_t i = 0; i < n; i++) {
            m[i] = 1.0;
        }
        opt.null_vector = Z; /* 0 */
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        assert_in_range(stats.error.row, 0, y.n - 1);
        opt.null_vector = y.Z;
        SL_CHECK(sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        sl_factor_free(F);
        sl_symbolic_free(S);
        elastic_free(&y);
        free(m);
        free(Z);
    }
}

/* Two springs and a row of zeros, where all null vectors are 0: nothing is missing there. Weights
 * whose sum is 0 are refused in the first of several trees, springs of 1e-306 where the squares of
 * their pivots overflow. */
static void small_trees_are_centered_or_refused(void **state) {
    (void)state;
    enum { N = 5 };
    static const sl_int p[N + 1] = {0, 2, 3, 5, 6, 7}, i[7] = {0, 1, 1, 2, 3, 3, 4};
    static const double Z[2 * N] = {1.0, 1.0, 1.0, 1.0};
    for (int kind = 0; kind < 3; kind++) {
        const double k = kind == 2 ? 1e-306 : 1.0, x[7] = {k, -k, k, k, -k, k, 0.0};
        const double b[N] = {1.0, 2.0, 3.0, 5.0, 0.0};
        const double m[N] = {1e12, kind == 1 ? -1e12 : 1e12, 1e12, kind == 1 ? -1e12 : 1e12, 1e12};
        const sl_csc A = {N, N, p, i, x};
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        double y[N];
        opt.null_pivots = SL_NULL_PIVOT_SKIP;
        opt.null_vector = Z;
        opt.null_vector_count = 2;
        opt.mass = m;
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        SL_EXPECT(kind == 0   ? SL_OK
                  : kind == 1 ? SL_ERR_PIVOT
                              : SL_ERR_NOT_FINITE,
                  sl_factor_create(&F, S, &A, &opt, NULL));
        if (kind == 0) { /* b without its means, 1.5 and 4 */
            SL_CHECK(sl_factor_solve(F, y, N, b, N, 1, NULL));
            assert_true(fabs(y[0] + 0.25) <= 1e-15 && fabs(y[1] - 0.25) <= 1e-15);
            assert_true(fabs(y[2] + 0.5) <= 1e-15 && fabs(y[3] - 0.5) <= 1e-15 && y[4] == 0.0);
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* A body that hangs on one node can turn about it: this is all that is left out. */
static void what_a_support_leaves_is_centered(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 10;
    for (int which = 0; which < 16; which++) {
        const int dim = 2 + which % 2;
        elastic_t y = elastic_make(dim, dim == 2 ? 6 : 3, 0.0, 1.0, 1.0, 0, &seed);
        sl_options opt = options_rigid(&y, &variants, which % variants.count);
        const sl_int node = gen_below(&seed, y.n / dim), rotations = y.rigid - dim;
        const size_t n = (size_t)y.n;
        double *m = rigid_masses(&y, 5, &seed), *Z = test_reals(n * (size_t)y.rigid);
        double *b = test_reals(n), *x = test_reals(n), center[3];
        double *values = test_reals((size_t)y.A.p[n]);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        memcpy(values, y.A.x, (size_t)y.A.p[n] * sizeof *values);
        y.A.x = values;
        for (int c = 0; c < dim; c++) {
            center[c] = y.at[node * dim + c];
            for (sl_int p = y.A.p[node * dim + c]; p < y.A.p[node * dim + c + 1]; p++) {
                values[p] += y.A.i[p] == node * dim + c ? 2.0 : 0.0;
            }
        }
        opt.mass = m;
        gen_reals(b, n, seed);
        SL_CHECK(sl_symbolic_create(&S, &y.A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &y.A, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.factor.null, rotations);
        SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
        elastic_rigid(&y, Z, center);
        memmove(Z, Z + n * (size_t)dim, n * (size_t)rotations * sizeof *Z);
        y.rigid = rotations;
        double *C = rigid_basis(&y, Z, m);
        assert_rigid_mean(&y, C, m, x, b, 1.0);
        sl_factor_free(F);
        sl_symbolic_free(S);
        elastic_free(&y);
        free(m);
        free(Z);
        free(C);
        free(b);
        free(x);
        free(values);
    }
}

/* Every allocation may fail; refactoring and solving allocate nothing more. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 11;
    for (int k = 0; k < variants.count; k++) {
        weighed_t f = weighed_make(3, &variants, k, &seed);
        for (int64_t fails = 0, done = 0; !done; fails++) {
            counter_t counter = counter_make();
            sl_options opt = f.opt;
            sl_factor *F = NULL;
            sl_work *W = NULL;
            opt.allocator = options_counted(&counter).allocator;
            counter.fail_at = fails;
            const sl_status status = sl_factor_create(&F, f.S, &f.y.A, FOR_FACTOR(&opt), NULL);
            done = status == SL_OK;
            assert_true(done ? F != NULL : F == NULL && status == SL_ERR_MEMORY);
            if (done) {
                counter.fail_at = -1;
                SL_CHECK(sl_work_create(&W, FOR_OTHERS(&opt)));
                SL_CHECK(sl_work_reserve_factor(W, F, 1));
                const size_t calls = counter.calls;
                SL_CHECK(sl_factor_refactor(F, &f.y.A, NULL));
                SL_CHECK(sl_factor_solve(F, f.x, f.n, f.b, f.n, 1, W));
                assert_int_equal(counter.calls, calls);
            }
            sl_work_free(W);
            sl_factor_free(F);
            COUNTER_CLEAN(&counter);
        }
        weighed_free(&f);
    }
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
        cmocka_unit_test(what_weights_do_not_fix_is_refused),
        cmocka_unit_test(small_trees_are_centered_or_refused),
        cmocka_unit_test(what_a_support_leaves_is_centered),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
