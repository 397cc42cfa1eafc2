/* test_factor_edit.c: sl_factor_edit: factors that follow random edits, exact whatever is kept */
#include "tests/lib/followed.h"
#include "tests/lib/graph_laplacian.h"
#include "tests/lib/parallel_for.h"

/* Edits a matrix several times; every factor follows the one before. Returns how many kept
 * something. */
static int follow(gen_kind_t kind, sl_int size, int style, int edits, edit_kind_t first,
                  const sl_options *opt) {
    uint64_t state = (uint64_t)((int)kind + 100 * style + 7);
    const edit_kind_t none = {0, 0, 0, 0, EDIT_IN_ORDER};
    gen_list_t t = gen_make(kind, size, 1, 42);
    sl_int *unused = test_ints((size_t)t.n + 1);
    followed_t y = followed_make(edited_list(&t, none, unused, &state), style, opt);
    int kept = 0;
    free(unused);
    gen_list_free(&t);
    for (int k = 0; k < edits; k++) {
        edit_kind_t how = first;
        how.numbers = (edit_numbers_t)(((int)first.numbers + k) % EDIT_NUMBERS);
        sl_int *new_of = test_ints((size_t)y.t.n + 1);
        followed_t z = {edited_list(&y.t, how, new_of, &state), {0}, NULL, NULL};
        sl_stats stats;
        z.A = gen_store(&z.t, gen_style(k % 3 == 2 && style < 6 ? k % 6 : style), 1);
        SL_CHECK(sl_symbolic_edit(&z.S, y.S, &y.A.view, &z.A.view, new_of, NULL, &stats));
        SL_CHECK(sl_factor_edit(&z.F, y.F, z.S, &z.A.view, new_of, opt, &stats));
        check_right(y.F, &y.A.view); /* it stays as it was */
        check_right(z.F, &z.A.view);
        check_pivots(&y, z.F, new_of, &stats);
        check_pivots(&y, z.F, new_of, &stats);
        assert_true(stats.reuse.is_anew || stats.reuse.flops < stats.reuse.flops_anew);
        assert_true(stats.factor.positive == z.t.n && stats.factor.growth < 10);
        kept += !stats.reuse.is_anew;
        free(new_of);
        followed_free(&y);
        y = z;
    }
    followed_free(&y);
    return kept;
}

static void every_kind_of_matrix_follows_edits(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    int kept = 0, all = 0;
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        for (int k = 0; k < 12; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[(kind + k) % isas.count];
            opt.method = SL_METHOD_SUPERNODAL;
            kept += follow((gen_kind_t)kind, k % 3 == 0 ? 36 : 100, k % GEN_STYLES, 3,
                           edit_kinds[k % 4], &opt);
            all += 3;
        }
    }
    print_message("%d of %d factors kept columns\n", kept, all);
    assert_true(kept > all / 10 && kept < all); /* both ways were taken */
}

/* A grid of cells, each with one of its diagonals. */
enum { CELLS = 40 };

static gen_list_t cells_list(const char *is_rising) {
    gen_list_t t = gen_list(CELLS * CELLS);
    uint64_t random = 1;
    for (sl_int y = 0; y < CELLS; y++) {
        for (sl_int x = 0; x < CELLS; x++) {
            const sl_int k = CELLS * y + x;
            if (x + 1 < CELLS) {
                gen_add(&t, k + 1, k, -0.5);
            }
            if (y + 1 < CELLS) {
                gen_add(&t, k + CELLS, k, -0.5);
            }
            if (x + 1 < CELLS && y + 1 < CELLS && is_rising[k]) {
                gen_add(&t, k + CELLS + 1, k, -0.25);
            } else if (x + 1 < CELLS && y + 1 < CELLS) {
                gen_add(&t, k + CELLS, k + 1, -0.25);
            }
        }
    }
    gen_dominate(&t, 1, &random);
    return t;
}

/* Diagonals near a random place are flipped, again and again. */
static void many_flips_follow_each_other(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    uint64_t random = 5;
    char is_rising[CELLS * CELLS] = {0};
    sl_int *map = identity(CELLS * CELLS);
    for (int i = 0; i < isas.count; i++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[i];
        followed_t y = followed_make(cells_list(is_rising), i, &opt);
        double share = 0;
        int kept = 0;
        for (int k = 0; k < 30; k++) {
            const sl_int at = gen_below(&random, (CELLS - 3) * CELLS);
            followed_t z = {{0}, {0}, NULL, NULL};
            sl_stats stats;
            for (int j = 0; j < 3; j++) {
                is_rising[at + CELLS * j] ^= 1;
            }
            z.t = cells_list(is_rising);
            z.A = gen_store(&z.t, gen_style(i), 1);
            SL_CHECK(sl_symbolic_edit(&z.S, y.S, &y.A.view, &z.A.view, map, NULL, &stats));
            SL_CHECK(sl_factor_edit(&z.F, y.F, z.S, &z.A.view, map, &opt, &stats));
            check_right(z.F, &z.A.view);
            check_pivots(&y, z.F, map, &stats);
            kept += !stats.reuse.is_anew;
            share += (double)stats.reuse.kept / (30 * z.t.n);
            followed_free(&y);
            y = z;
        }
        followed_free(&y);
        assert_true(kept > 25 && share > 0.6);
    }
    free(map);
}

/* Values that change by little, or change places, are noticed, in the same analysis. */
static void every_changed_value_is_noticed(void **state) {
    (void)state;
    for (int style = 0; style < 4; style++) {
        followed_t y = followed_make(gen_make(GEN_GRID2, 900, 1, 42), style, NULL);
        const sl_int n = y.t.n, nnz = y.A.view.p[n];
        sl_int *map = identity(n);
        sl_stats stats;
        sl_factor *G = NULL;
        int kept = 0, all = 0;
        SL_CHECK(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &stats));
        assert_int_equal(stats.reuse.kept, n);
        assert_same_bits(y.F, G);
        sl_factor_free(G);
        for (sl_int p = 3; p + 1 < nnz; p += 37) {
            const double a = y.A.view.x[p], b = y.A.view.x[p + 1];
            double *x = y.A.x;
            x[p] = p % 2 ? b : a * (1 + 1e-9);
            x[p + 1] = p % 2 ? a : b;
            if (fabs(x[p]) < 0.5 && fabs(x[p + 1]) < 0.5) { /* off the diagonal */
                SL_CHECK(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &stats));
                if (style % 3 != 2) {
                    check_right(G, &y.A.view);
                }
                assert_true(stats.reuse.computed > 0 || style % 3 == 2); /* one triangle is read */
                sl_factor_free(G);
                kept += !stats.reuse.is_anew;
                all++;
            }
            x[p] = a;
            x[p + 1] = b;
        }
        assert_true(kept > all / 2);
        free(map);
        followed_free(&y);
    }
}

/* What rank-one changes and refactorizations have changed is not copied. */
static void changed_factors_follow(void **state) {
    (void)state;
    followed_t y = followed_make(gen_make(GEN_GRID2, 900, 1, 42), 0, NULL);
    const sl_int row = y.A.view.i[1], column = 0;
    const double delta = 0.25;
    sl_int *map = identity(y.t.n);
    sl_stats stats;
    sl_factor *G = NULL;
    assert_true(row != column);
    SL_CHECK(sl_factor_change_entries(y.F, NULL, &row, &column, &delta, 1, NULL, NULL));
    SL_CHECK(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &stats));
    check_right(G, &y.A.view);
    assert_true(!stats.reuse.is_anew && stats.reuse.computed > 0);
    sl_factor_free(G);
    y.A.x[1] += delta;
    SL_CHECK(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &stats));
    check_right(G, &y.A.view);
    assert_true(!stats.reuse.is_anew && stats.reuse.computed > 0);
    sl_factor_free(G);
    SL_CHECK(sl_factor_change_entries(y.F, &y.A.view, NULL, &column, NULL, 1, NULL, NULL));
    SL_CHECK(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &stats));
    assert_int_equal(stats.reuse.kept, y.t.n);
    assert_same_bits(y.F, G);
    sl_factor_free(G);
    y.A.x[1] -= delta;
    SL_CHECK(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &stats));
    check_right(G, &y.A.view);
    assert_true(!stats.reuse.is_anew && stats.reuse.computed > 0);
    sl_factor_free(G);
    free(map);
    followed_free(&y);
}

/* A change too small for the pivot and for the largest entry shows in the magnitude of the column,
 * of which twice as much is added. */
static void changes_below_rounding_are_noticed(void **state) {
    (void)state;
    enum { ROWS = 200, CHANGED = 70 };
    sl_int p[ROWS + 1], i[2 * ROWS], map[ROWS], count = 0;
    double x[2 * ROWS];
    for (sl_int k = 0; k < ROWS; k++) { /* a path */
        map[k] = k;
        p[k] = count;
        i[count] = k;
        x[count++] = 1.5;
        if (k + 1 < ROWS) {
            i[count] = k + 1;
            x[count++] = -0.5;
        }
    }
    p[ROWS] = count;
    const sl_int q[2] = {0, 1}, row = CHANGED;
    const double tiny = sqrt(0.26 * DBL_EPSILON);
    const sl_csc A = {ROWS, ROWS, p, i, x}, V = {ROWS, 1, q, &row, &tiny};
    sl_options opt = options_none();
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_NONE);
    sl_factor *F = NULL, *G = NULL;
    sl_stats stats;
    opt.method = SL_METHOD_SUPERNODAL;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
    const double before = sl_factor_view(F).D[CHANGED];
    for (int k = 0; k < 2; k++) {
        SL_CHECK(sl_factor_edit(&G, F, S, &A, map, &opt, &stats));
        assert_true(!stats.reuse.is_anew && stats.reuse.kept >= CHANGED);
        assert_true((stats.reuse.computed > 0) == (k == 1));
        assert_true(sl_factor_view(G).D[CHANGED] == before);
        sl_factor_free(G);
        if (k == 0) {
            SL_CHECK(sl_factor_rank_update(F, &V, NULL, NULL, NULL));
            assert_true(sl_factor_view(F).D[CHANGED] == before);
        }
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* What is not suited is factored anew, with the bits of sl_factor_create. */
static void other_factors_are_made_anew(void **state) {
    (void)state;
    followed_t y = followed_make(gen_make(GEN_GRID2, 196, 1, 42), 0, NULL);
    sl_int *map = identity(y.t.n);
    for (int k = 0; k < 8; k++) {
        sl_options opt = options_none();
        sl_factor *F = NULL, *G = NULL, *H = NULL;
        sl_stats stats;
        opt.storage = k <= 1 ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
        opt.method = k == 2 ? SL_METHOD_UP_LOOKING : SL_METHOD_AUTO;
        opt.pivots = k == 3 ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
        opt.regularization = k == 4 ? 1e-10 : 0.0;
        opt.null_tolerance = k == 5 ? 1e-9 : 0.0;
        SL_CHECK(sl_factor_create(&F, y.S, &y.A.view, &opt, NULL));
        for (int way = 0; way < (k == 6 ? 0 : 3); way++) { /* one of both factors, or both */
            const sl_factor *from = way == 0 ? y.F : F;
            const sl_options *to = way == 1 ? NULL : &opt;
            const int is_same = way == 2 && k > 2;
            SL_CHECK(sl_factor_edit(&G, from, y.S, &y.A.view, map, to, &stats));
            assert_int_equal(stats.reuse.is_anew, k < 6 && !is_same);
            assert_int_equal(stats.reuse.reason,
                             k < 6 && !is_same ? SL_CHANGE_UNSUITED : SL_CHANGE_CHEAPEST);
            SL_CHECK(sl_factor_create(&H, y.S, &y.A.view, to, NULL));
            assert_same_bits(G, H);
            sl_factor_free(G);
            sl_factor_free(H);
        }
        sl_factor_free(F);
    }
    sl_symbolic *T = NULL;
    sl_factor *G = NULL, *H = NULL;
    SL_CHECK(sl_factor_submatrix(&T, &G, y.F, &y.A.view, map, y.t.n, NULL, NULL));
    sl_stats stats;
    SL_CHECK(sl_factor_edit(&H, G, y.S, &y.A.view, map, NULL, &stats));
    assert_int_equal(stats.reuse.is_anew, 1);
    assert_same_bits(y.F, H);
    sl_factor_free(H);
    assert_int_equal(sl_factor_edit(&H, y.F, T, &y.A.view, map, NULL, NULL), SL_ERR_OTHER_PATTERN);
    sl_factor_free(G);
    sl_symbolic_free(T);
    free(map);
    followed_free(&y);
}

/* Singular Laplacians whose weights change: null pivots stay where they are. */
static void singular_laplacians_follow(void **state) {
    (void)state;
    int kept = 0;
    for (int k = 0; k < LAPLACIAN_KINDS; k++) {
        sl_int components;
        gen_matrix_t M = laplacian(laplacian_kinds[k], 196, 0, &components);
        const sl_int n = M.view.n_cols, nnz = M.view.p[n];
        const size_t size = (size_t)n;
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL, *G = NULL, *H = NULL;
        sl_stats stats, fresh;
        sl_int *map = identity(n), p = nnz / 2;
        double *mass = test_reals(size), *b = test_reals(size), *x = test_reals(size),
               *y = test_reals(size);
        for (sl_int i = 0; i < n; i++) {
            mass[i] = 1.0;
            b[i] = i % 2 ? 1.0 : -1.0;
        }
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = mass;
        opt.method = SL_METHOD_SUPERNODAL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
        for (sl_int j = 0; j < n; j++) { /* another weight for the edge of entry p */
            for (sl_int q = M.view.p[j]; q < M.view.p[j + 1]; q++) {
                if (q >= p && M.view.i[q] != j && M.x[q] != 0.0) {
                    M.x[q] -= 0.5;
                    M.x[M.view.p[j]] += 0.5;
                    M.x[M.view.p[M.view.i[q]]] += 0.5;
                    p = nnz;
                }
            }
        }
        SL_CHECK(sl_factor_edit(&G, F, S, &M.view, map, &opt, &stats));
        SL_CHECK(sl_factor_create(&H, S, &M.view, &opt, &fresh));
        assert_int_equal(stats.factor.null, fresh.factor.null);
        assert_int_equal(stats.factor.regular, fresh.factor.regular);
        SL_CHECK(sl_factor_solve(G, x, size, b, size, 1, NULL));
        SL_CHECK(sl_factor_solve(H, y, size, b, size, 1, NULL));
        for (sl_int i = 0; i < n; i++) {
            assert_true(fabs(x[i] - y[i]) <= 1e-9 * (1 + fabs(y[i])));
        }
        kept += !stats.reuse.is_anew;
        sl_factor_free(F);
        sl_factor_free(G);
        sl_factor_free(H);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        free(map);
        free(mass);
        free(b);
        free(x);
        free(y);
    }
    assert_true(kept >= 3);
}

/* Every instruction set, with any number of threads: the same bits, and a small residual. */
static void threads_give_the_same_bits(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        int calls = 0;
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        followed_t y = followed_make(gen_make(GEN_GRID2, 25600, 1, 42), 0, &opt);
        sl_int *map = identity(y.t.n);
        sl_factor *first = NULL;
        for (sl_int j = 3000; j < 3010; j++) {
            y.A.x[y.A.view.p[j]] += 1.0;
        }
        for (sl_int count = 1; count <= 4; count++) {
            sl_factor *G = NULL;
            sl_stats stats;
            opt.threads.count = count;
            opt.threads.run = count == 3 ? run_backwards : run_threads;
            opt.threads.context = &calls;
            SL_CHECK(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, &opt, &stats));
            assert_int_equal(stats.reuse.is_anew, 0);
            check_right(G, &y.A.view);
            if (first == NULL) {
                first = G;
            } else {
                assert_same_bits(first, G);
                sl_factor_free(G);
            }
        }
        assert_true(calls > 0);
        sl_factor_free(first);
        free(map);
        followed_free(&y);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_matrix_follows_edits),
        cmocka_unit_test(many_flips_follow_each_other),
        cmocka_unit_test(every_changed_value_is_noticed),
        cmocka_unit_test(changed_factors_follow),
        cmocka_unit_test(changes_below_rounding_are_noticed),
        cmocka_unit_test(other_factors_are_made_anew),
        cmocka_unit_test(singular_laplacians_follow),
        cmocka_unit_test(threads_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
