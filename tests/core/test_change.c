/* test_change.c: sl_factor_update, _update_entries: the new factor, what is refused and undone */
#include "tests/lib/factored.h"

/* ---- a matrix, its factor, and a change of its values ---- */

typedef struct changed_t {
    factored_t y;
    double *dense; /* n x n: the matrix that F should be a factor of */
} changed_t;

static changed_t changed_make(gen_kind_t kind, sl_int size, int sign, const sl_options *opt) {
    changed_t c = {factored_make(kind, size, sign, 0, opt), NULL};
    c.dense = ref_dense(&c.y.M.view);
    return c;
}

static void changed_free(changed_t *c) {
    factored_free(&c->y);
    free(c->dense);
}

/* Largest |P A P' - L D L'| over the largest |a|. */
static double changed_error(const changed_t *c) {
    sl_int n = c->y.M.view.n_cols;
    sl_matrix *lower = NULL;
    SL_CHECK(sl_factor_lower(&lower, c->y.F, NULL));
    sl_csc L = sl_matrix_view(lower);
    const double *D = sl_factor_view(c->y.F).D;
    double *A = ref_permute(n, c->dense, sl_symbolic_view(c->y.S).perm), largest = 0.0;
    for (size_t k = 0; k < (size_t)n * (size_t)n; k++) {
        largest = fmax(largest, fabs(A[k]));
    }
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = L.p[j]; p < L.p[j + 1]; p++) {
            for (sl_int q = L.p[j]; q < L.p[j + 1]; q++) {
                A[(size_t)L.i[p] * (size_t)n + (size_t)L.i[q]] -= L.x[p] * D[j] * L.x[q];
            }
        }
    }
    double worst = 0.0;
    for (size_t k = 0; k < (size_t)n * (size_t)n; k++) {
        worst = fmax(worst, fabs(A[k]));
    }
    free(A);
    sl_matrix_free(lower);
    return worst / largest;
}

static void changed_add(changed_t *c, sl_int i, sl_int j, double delta) {
    sl_int n = c->y.M.view.n_cols;
    c->dense[(size_t)i * (size_t)n + (size_t)j] += delta;
    if (i != j) {
        c->dense[(size_t)j * (size_t)n + (size_t)i] += delta;
    }
}

/* A random entry of A; on the diagonal if the column has no other. */
static void random_entry(const changed_t *c, uint64_t *seed, sl_int *i, sl_int *j) {
    const sl_csc *A = &c->y.M.view;
    *j = gen_below(seed, A->n_cols);
    sl_int size = A->p[*j + 1] - A->p[*j];
    *i = size > 0 ? A->i[A->p[*j] + gen_below(seed, size)] : *j;
}

/* Appends the change of the weight of edge (i, j). */
static sl_int add_edge(changed_t *c, sl_int i, sl_int j, double w, sl_int *rows, sl_int *columns,
                       double *deltas, sl_int at) {
    const sl_int r[3] = {i, j, i}, k[3] = {i, j, j};
    const double d[3] = {w, w, -w};
    for (int m = i == j ? 2 : 0; m < 3; m++) {
        rows[at] = r[m];
        columns[at] = k[m];
        deltas[at] = i == j ? w : d[m];
        changed_add(c, r[m], k[m], deltas[at]);
        at++;
    }
    return at;
}

enum { EDGES = 24 };

/* The sizes of the changes make passes of 1, 2, 4 and 8 vectors, and several passes. */
static void changed_entries_give_the_factor_of_the_new_matrix(void **state) {
    (void)state;
    static const sl_int counts[6] = {1, 2, 3, 7, 8, EDGES};
    isa_list_t isas = isas_present();
    uint64_t seed = 5;
    for (int kind = 1; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < 6 * isas.count; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k % isas.count];
            opt.method = k % 4 == 3 ? SL_METHOD_UP_LOOKING : SL_METHOD_AUTO;
            changed_t c = changed_make((gen_kind_t)kind, k % 2 ? 120 : 40, 1, &opt);
            sl_int rows[3 * EDGES], columns[3 * EDGES], at = 0;
            double deltas[3 * EDGES];
            sl_stats stats;
            sl_work *W = NULL;
            SL_CHECK(sl_work_create(&W, NULL));
            for (sl_int e = 0; e < counts[k / isas.count]; e++) {
                sl_int i, j;
                random_entry(&c, &seed, &i, &j);
                at = add_edge(&c, i, j, 0.5 + 0.4 * gen_real(&seed), rows, columns, deltas, at);
            }
            sl_status status = sl_factor_update_entries(c.y.F, rows, columns, deltas, at,
                                                        k % 2 ? W : NULL, &stats);
            if (kind == GEN_KKT && status == SL_ERR_PIVOT) { /* may become singular on its way */
                sl_work_free(W);
                changed_free(&c);
                continue;
            }
            SL_CHECK(status);
            double growth = kind == GEN_SCALED || kind == GEN_KKT ? 1e4 : 1.0;
            assert_true(changed_error(&c) <= 64.0 * growth * DBL_EPSILON * (double)at);
            assert_int_equal(stats.change.method, SL_CHANGE_UPDATE);
            assert_true(stats.change.ranks >= 1 && stats.change.ranks <= at);
            assert_int_equal(stats.change.updates, stats.change.ranks);
            assert_int_equal(stats.factor.positive + stats.factor.negative, c.y.M.view.n_cols);
            sl_work_free(W);
            changed_free(&c);
        }
    }
}

/* An edge is one rank, an entry of the diagonal one, another entry up to three; edges that share
 * rows do not leave changes of the diagonal. */
static void ranks_are_as_few_as_the_edges(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_GRID2, 100, 1, NULL);
    sl_int rows[32], columns[32], at = 0;
    double deltas[32];
    sl_stats stats;
    at = add_edge(&c, 3, 4, 0.3, rows, columns, deltas, at);
    at = add_edge(&c, 4, 5, 0.1, rows, columns, deltas, at);
    at = add_edge(&c, 5, 4, 0.7, rows, columns, deltas, at); /* the same edge from the other side */
    SL_CHECK(sl_factor_update_entries(c.y.F, rows, columns, deltas, at, NULL, &stats));
    assert_int_equal(stats.change.ranks, 2);
    at = add_edge(&c, 7, 7, 0.5, rows, columns, deltas, 0);
    SL_CHECK(sl_factor_update_entries(c.y.F, rows, columns, deltas, at, NULL, &stats));
    assert_int_equal(stats.change.ranks, 1);
    rows[0] = 8;
    columns[0] = 9;
    deltas[0] = 0.01;
    changed_add(&c, 8, 9, 0.01);
    SL_CHECK(sl_factor_update_entries(c.y.F, rows, columns, deltas, 1, NULL, &stats));
    assert_int_equal(stats.change.ranks, 3);
    deltas[0] = 0.0;
    SL_CHECK(sl_factor_update_entries(c.y.F, rows, columns, deltas, 1, NULL, &stats));
    assert_int_equal(stats.change.ranks, 0);
    assert_int_equal(stats.change.method, SL_CHANGE_NONE);
    SL_CHECK(sl_factor_update_entries(c.y.F, NULL, NULL, NULL, 0, NULL, &stats));
    assert_int_equal(stats.change.updates, 6);
    assert_true(changed_error(&c) <= 1e-14);
    changed_free(&c);
}

/* Vectors on a clique of L: any signs, any length, duplicates. */
static void vectors_give_the_factor_of_the_new_matrix(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            changed_t c = changed_make(GEN_DENSE, 37, sign, &opt);
            sl_int p[4] = {0, 3, 40, 41}, i[41];
            double x[41], sigma[3] = {0.5 * sign, 0.01 * sign, -0.01 * sign};
            sl_csc V = {37, 3, p, i, x};
            for (sl_int m = 0; m < 37; m++) {
                i[3 + m] = m;
            }
            i[0] = i[1] = 5;
            i[2] = 9;
            i[40] = 36;
            gen_reals(x, 41, 3);
            for (int v = 0; v < 3; v++) {
                for (sl_int a = p[v]; a < p[v + 1]; a++) {
                    for (sl_int b = p[v]; b < p[v + 1]; b++) {
                        c.dense[i[a] * 37 + i[b]] += sigma[v] * x[a] * x[b];
                    }
                }
            }
            SL_CHECK(sl_factor_update(c.y.F, &V, sigma, NULL, NULL));
            assert_true(changed_error(&c) <= 1e-14);
            changed_free(&c);
        }
    }
}

/* One vector through a panel of many tiles, entered at any row, with weights of both signs. */
static void one_vector_changes_a_wide_panel(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (sl_int n = 61; n < 75; n++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            changed_t c = changed_make(GEN_DENSE, n, n % 2 ? 1 : -1, &opt);
            const sl_int *perm = sl_symbolic_view(c.y.S).perm;
            for (sl_int first = 0; first < n; first += 7) {
                sl_int p[2] = {0, n - first}, i[75];
                double x[75], sigma = (first % 2 ? 0.5 : -0.01) * (n % 2 ? 1.0 : -1.0);
                gen_reals(x, 75, (uint64_t)first + 3);
                for (sl_int m = 0; m < n - first; m++) {
                    i[m] = perm[first + m];
                }
                for (sl_int a = 0; a < n - first; a++) {
                    for (sl_int b = 0; b < n - first; b++) {
                        c.dense[i[a] * n + i[b]] += sigma * x[a] * x[b];
                    }
                }
                sl_csc V = {n, 1, p, i, x};
                SL_CHECK(sl_factor_update(c.y.F, &V, &sigma, NULL, NULL));
                assert_true(changed_error(&c) <= 1e-14);
            }
            changed_free(&c);
        }
    }
}

static void an_update_and_its_downdate_return(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    uint64_t seed = 11;
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        changed_t c = changed_make(GEN_GRID2, 400, 1, &opt);
        size_t size = (size_t)panel_doubles(c.y.F);
        double *before = test_reals(size);
        memcpy(before, sl_factor_view(c.y.F).L, size * sizeof *before);
        for (int e = 0; e < 20; e++) {
            sl_int rows[3 * EDGES], columns[3 * EDGES], at = 0;
            double deltas[3 * EDGES];
            for (int m = 0; m <= e; m++) {
                sl_int i, j;
                random_entry(&c, &seed, &i, &j);
                at = add_edge(&c, i, j, 1.0, rows, columns, deltas, at);
            }
            SL_CHECK(sl_factor_update_entries(c.y.F, rows, columns, deltas, at, NULL, NULL));
            for (sl_int m = 0; m < at; m++) {
                deltas[m] = -deltas[m];
            }
            SL_CHECK(sl_factor_update_entries(c.y.F, rows, columns, deltas, at, NULL, NULL));
        }
        for (size_t m = 0; m < size; m++) {
            assert_true(fabs(sl_factor_view(c.y.F).L[m] - before[m]) <= 1e-12);
        }
        free(before);
        changed_free(&c);
    }
}

/* ---- what is refused, and leaves F as it was ---- */

typedef struct kept_t {
    double *L, *D;
    size_t size, n;
} kept_t;

static kept_t keep(const sl_factor *F) {
    sl_factor_arrays v = sl_factor_view(F);
    kept_t k = {NULL, NULL, (size_t)panel_doubles(F), (size_t)sl_symbolic_view(v.symbolic).n};
    k.L = test_reals(k.size);
    k.D = test_reals(k.n);
    memcpy(k.L, v.L, k.size * sizeof(double));
    memcpy(k.D, v.D, k.n * sizeof(double));
    return k;
}

static void assert_kept(kept_t *k, const sl_factor *F) {
    assert_memory_equal(k->L, sl_factor_view(F).L, k->size * sizeof(double));
    assert_memory_equal(k->D, sl_factor_view(F).D, k->n * sizeof(double));
    free(k->L);
    free(k->D);
}

static void a_lost_definiteness_is_refused_and_undone(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int sign = -1; sign <= 1; sign += 2) {
        for (int k = 0; k < 2 * isas.count; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k / 2];
            changed_t c = changed_make(GEN_GRID2, 200, sign, &opt);
            sl_int n = c.y.M.view.n_cols, rows[16], columns[16];
            double deltas[16];
            sl_stats stats, before;
            sl_factor_stats(c.y.F, &before);
            kept_t kept = keep(c.y.F);
            sl_int many = k % 2 ? 16 : 1; /* one pass that fails, or a second one */
            for (sl_int m = 0; m < many; m++) {
                rows[m] = columns[m] = 11 * m;
                deltas[m] = m + 1 < many ? -0.01 * sign : -1000.0 * sign;
            }
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_update_entries(c.y.F, rows, columns, deltas, many,
                                                             NULL, &stats));
            assert_true(stats.error.row >= 0 && stats.error.row < n);
            assert_true(stats.error.value * sign < 0.0);
            assert_kept(&kept, c.y.F);
            sl_factor_stats(c.y.F, &stats);
            assert_memory_equal(&stats.factor, &before.factor, sizeof stats.factor);
            changed_free(&c);
        }
    }
}

/* A Laplacian with one spring to the ground becomes singular without it. */
static void a_factor_that_becomes_singular_is_refused(void **state) {
    (void)state;
    for (sl_int side = 3; side < 30; side += 4) {
        gen_list_t t = gen_list(side * side);
        uint64_t seed = 7;
        gen_edges_grid(&t, side, side, 1, &seed);
        gen_laplacian(&t);
        sl_int anchor = side + 1;
        gen_add(&t, anchor, anchor, 1.0);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
        double minus = -1.0;
        kept_t kept = keep(F);
        SL_EXPECT(SL_ERR_PIVOT,
                  sl_factor_update_entries(F, &anchor, &anchor, &minus, 1, NULL, NULL));
        assert_kept(&kept, F);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

static void invalid_changes_are_refused(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_PATH, 50, 1, NULL);
    sl_factor *F = c.y.F;
    sl_stats stats;
    kept_t kept = keep(F);
    sl_int i[2] = {3, 40}, j[2] = {3, 3}, below = -1, above = 50;
    double d[2] = {1.0, 1.0}, nan = NAN, one = 1.0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update_entries(NULL, i, j, d, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update_entries(F, NULL, j, d, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update_entries(F, i, NULL, d, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update_entries(F, i, j, NULL, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update_entries(F, i, j, d, -1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update_entries(F, &below, j, d, 1, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update_entries(F, i, &above, d, 1, NULL, &stats));
    assert_int_equal(stats.error.column, 50);
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_update_entries(F, i, j, &nan, 1, NULL, &stats));
    assert_int_equal(stats.error.row, 3);
    SL_EXPECT(SL_ERR_PATTERN, sl_factor_update_entries(F, i, j, d, 2, NULL, &stats));
    assert_true((stats.error.row == 3 && stats.error.column == 40) ||
                (stats.error.row == 40 && stats.error.column == 3));
    sl_int p[2] = {0, 1}, row = 3, bad[2] = {0, -1};
    sl_csc V = {50, 1, p, &row, &one}, W = V;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update(F, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update(NULL, &V, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_update(F, &V, &nan, NULL, NULL));
    W.x = &nan;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_update(F, &W, NULL, NULL, &stats));
    assert_int_equal(stats.error.row, 3);
    W.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update(F, &W, NULL, NULL, NULL));
    W = V;
    W.n_rows = 51;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_update(F, &W, NULL, NULL, NULL));
    W = V;
    W.p = bad;
    SL_EXPECT(SL_ERR_PATTERN, sl_factor_update(F, &W, NULL, NULL, NULL));
    W = V;
    W.i = &above;
    SL_EXPECT(SL_ERR_PATTERN, sl_factor_update(F, &W, NULL, NULL, NULL));
    assert_kept(&kept, F);
    double large = 1e300;
    SL_EXPECT(SL_ERR_NOT_FINITE,
              sl_factor_update(F, ((W = V), (W.x = &large), &W), NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_STATE, sl_factor_update(F, &V, NULL, NULL, NULL)); /* it says so */
    SL_CHECK(sl_factor_refactor(F, &c.y.M.view, NULL));
    SL_CHECK(sl_factor_update(F, &V, NULL, NULL, NULL));
    changed_free(&c);
}

static void null_pivots_are_unsupported(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    gen_list_t t = gen_list(25);
    uint64_t seed = 7;
    gen_edges_grid(&t, 5, 5, 1, &seed);
    gen_laplacian(&t);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    sl_int i = 3;
    double d = 1.0;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_update_entries(F, &i, &i, &d, 1, NULL, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* A region of the old numbers is refused, a plan without one is not. */
static void regions_of_the_old_numbers_are_refused(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_GRID2, 400, 1, NULL);
    sl_region *R = NULL;
    sl_plan *inside = NULL, *whole = NULL;
    sl_int set[3] = {0, 1, 2}, i = 3;
    double b[3] = {1.0, 2.0, 3.0}, x[3], wanted[400], full[400], d = 2.0;
    sl_options opt = options_none();
    SL_CHECK(sl_region_create(&R, c.y.F, set, 3, NULL, NULL, NULL));
    opt.region = R;
    SL_CHECK(sl_plan_create(&inside, c.y.S, set, 3, set, 3, &opt, NULL));
    SL_CHECK(sl_plan_create(&whole, c.y.S, set, 3, set, 3, NULL, NULL));
    SL_CHECK(sl_plan_solve(inside, c.y.F, x, 3, b, 3, 1, NULL));
    SL_CHECK(sl_factor_update_entries(c.y.F, &i, &i, &d, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_STATE, sl_plan_solve(inside, c.y.F, x, 3, b, 3, 1, NULL));
    SL_CHECK(sl_plan_solve(whole, c.y.F, x, 3, b, 3, 1, NULL));
    memset(full, 0, sizeof full);
    memcpy(full, b, sizeof b);
    SL_CHECK(sl_factor_solve(c.y.F, wanted, 400, full, 400, 1, NULL));
    assert_memory_equal(x, wanted, sizeof x);
    SL_CHECK(sl_region_refactor(R, c.y.F, NULL, NULL));
    SL_CHECK(sl_plan_solve(inside, c.y.F, x, 3, b, 3, 1, NULL));
    sl_plan_free(inside);
    sl_plan_free(whole);
    sl_region_free(R);
    changed_free(&c);
}

/* A mapped factor is refused; a loaded one changes as the one that was saved. */
static void mapped_factors_are_refused(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_GRID2, 100, 1, NULL);
    size_t bytes = 0;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_int i = 3;
    double d = 1.0;
    SL_CHECK(sl_factor_update_entries(c.y.F, &i, &i, &d, 1, NULL, NULL));
    SL_CHECK(sl_save_bytes(&bytes, c.y.S, c.y.F));
    double *memory = test_reals(bytes / sizeof(double) + 16);
    unsigned char *block = (unsigned char *)memory;
    block += (64 - (uintptr_t)block % 64) % 64;
    SL_CHECK(sl_save_memory(block, bytes, c.y.S, c.y.F));
    SL_CHECK(sl_map_memory(&S, &F, block, bytes, SL_LOAD_VERIFIED, NULL));
    SL_EXPECT(SL_ERR_STATE, sl_factor_update_entries(F, &i, &i, &d, 1, NULL, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
    SL_CHECK(sl_load_memory(&S, &F, block, bytes, SL_LOAD_VERIFIED, NULL));
    SL_CHECK(sl_factor_update_entries(F, &i, &i, &d, 1, NULL, NULL));
    SL_CHECK(sl_factor_update_entries(c.y.F, &i, &i, &d, 1, NULL, NULL));
    assert_same_bits(F, c.y.F);
    sl_factor_free(F);
    sl_symbolic_free(S);
    free(memory);
    changed_free(&c);
}

/* Allocations fail one after the other: F is as before, and the next call succeeds. */
static void failing_allocations_leave_the_factor(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    changed_t c = changed_make(GEN_GRID2, 100, 1, &opt);
    sl_int i[2] = {3, 40};
    double d[2] = {-0.01, 1.0};
    sl_status status = SL_ERR_MEMORY;
    for (int k = 0; status != SL_OK; k++) {
        kept_t kept = keep(c.y.F);
        counter.fail_at = (int64_t)counter.calls + k;
        status = sl_factor_update_entries(c.y.F, i, i, d, 2, NULL, NULL);
        counter.fail_at = -1;
        if (status != SL_OK) {
            assert_int_equal(status, SL_ERR_MEMORY);
            assert_kept(&kept, c.y.F);
        } else {
            assert_true(k > 1);
            free(kept.L);
            free(kept.D);
        }
    }
    changed_add(&c, 3, 3, d[0]);
    changed_add(&c, 40, 40, d[1]);
    assert_true(changed_error(&c) <= 1e-14);
    changed_free(&c);
    COUNTER_CLEAN(&counter);
}

/* With a workspace that has grown, a change allocates nothing. */
static void a_grown_workspace_is_enough(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    changed_t c = changed_make(GEN_GRID2, 400, 1, &opt);
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, &opt));
    sl_int i = 3;
    double d[2] = {1.0, -1.0};
    SL_CHECK(sl_factor_update_entries(c.y.F, &i, &i, d, 1, W, NULL));
    SL_CHECK(sl_factor_update_entries(c.y.F, &i, &i, d + 1, 1, W, NULL));
    size_t calls = counter.calls;
    SL_CHECK(sl_factor_update_entries(c.y.F, &i, &i, d, 1, W, NULL));
    SL_CHECK(sl_factor_update_entries(c.y.F, &i, &i, d + 1, 1, W, NULL));
    assert_int_equal(counter.calls, calls);
    sl_work_free(W);
    changed_free(&c);
    COUNTER_CLEAN(&counter);
}

/* 10,000 random edits, up and down, against a fresh factor: the error stays below the drift. */
static void ten_thousand_edits_stay_below_the_drift(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_GRID2, 100, 1, NULL);
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    uint64_t seed = 3;
    double weight[100] = {0.0};
    sl_stats stats;
    for (int e = 0; e < 10000; e++) {
        sl_int i = gen_below(&seed, 100), j = i % 10 < 9 ? i + 1 : i - 1;
        double w = fabs(gen_real(&seed)) * (e % 7 == 0 ? 100.0 : 1.0);
        sl_int rows[3], columns[3];
        double deltas[3];
        sl_int at = add_edge(&c, i, j, w - weight[i], rows, columns, deltas, 0);
        weight[i] = w;
        SL_CHECK(sl_factor_update_entries(c.y.F, rows, columns, deltas, at, W, &stats));
    }
    assert_true(stats.change.updates > 9000 && stats.change.updates <= 10000);
    assert_true(changed_error(&c) <= stats.change.drift);
    assert_true(stats.change.drift <= 1e-10 && stats.factor.growth <= 2.0);
    SL_CHECK(sl_factor_refactor(c.y.F, &c.y.M.view, NULL));
    SL_CHECK(sl_factor_update_entries(c.y.F, NULL, NULL, NULL, 0, W, &stats));
    assert_int_equal(stats.change.updates, 0);
    assert_true(stats.change.drift == 0.0);
    sl_work_free(W);
    changed_free(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changed_entries_give_the_factor_of_the_new_matrix),
        cmocka_unit_test(ranks_are_as_few_as_the_edges),
        cmocka_unit_test(vectors_give_the_factor_of_the_new_matrix),
        cmocka_unit_test(one_vector_changes_a_wide_panel),
        cmocka_unit_test(an_update_and_its_downdate_return),
        cmocka_unit_test(a_lost_definiteness_is_refused_and_undone),
        cmocka_unit_test(a_factor_that_becomes_singular_is_refused),
        cmocka_unit_test(invalid_changes_are_refused),
        cmocka_unit_test(null_pivots_are_unsupported),
        cmocka_unit_test(regions_of_the_old_numbers_are_refused),
        cmocka_unit_test(mapped_factors_are_refused),
        cmocka_unit_test(failing_allocations_leave_the_factor),
        cmocka_unit_test(a_grown_workspace_is_enough),
        cmocka_unit_test(ten_thousand_edits_stay_below_the_drift),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
