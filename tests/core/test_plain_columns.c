/* test_plain_columns.c: nearly diagonal systems, whose columns of L stay apart and unpadded */
#include "tests/lib/factor_ways.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/parallel_for.h"
#include "tests/lib/saved.h"

/* The KKT matrix of support vectors: features, points and bounds of the points. */
static gen_matrix_t separable(sl_int features, sl_int points, int style) {
    const sl_int rows = features + points, bounds = rows + points;
    gen_list_t t = gen_list(bounds + points);
    uint64_t seed = 5;
    for (sl_int k = 0; k < t.n; k++) {
        gen_add(&t, k, k, k < rows ? 1.0 + 0.01 * (double)(k % 7) : -10.0);
    }
    for (sl_int r = 0; r < points; r++) {
        for (sl_int j = 0; j < features; j++) {
            if (gen_below(&seed, 3) == 0) {
                gen_add(&t, rows + r, j, gen_real(&seed));
            }
        }
        gen_add(&t, rows + r, features + r, -1.0);
        gen_add(&t, bounds + r, features + r, 1.0);
    }
    const gen_matrix_t M = gen_store(&t, gen_style(style), 1);
    gen_list_free(&t);
    return M;
}

/* L has hardly more numbers than entries, is right by every method, and local solves have the bits
 * of full ones, with every instruction set, storage and number of right-hand sides. */
static void columns_are_kept_apart(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    for (int k = 0; k < 4 * STORAGES * variants.count; k++) {
        const int way = k / STORAGES % 4;
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_work *W = NULL;
        sl_stats stats;
        int calls = 0;
        memset(&stats, 0, sizeof stats);
        options_set_variant(&opt, &variants, k / (4 * STORAGES));
        opt.purpose = way % 2 ? SL_PURPOSE_ONE_FACTOR : SL_PURPOSE_MANY_SOLVES;
        opt.storage = storage_at(k);
        opt.threads.count = way == 3 ? 3 : 0;
        opt.threads.run = way == 3 ? run_backwards : NULL;
        opt.threads.context = &calls;
        gen_matrix_t M = separable(12, 300, k % GEN_STYLES);
        SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), &stats));
        assert_true((double)stats.symbolic.nnz_panels <= 1.3 * (double)stats.symbolic.nnz_l);
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        if (stats.factor.storage == SL_STORAGE_DOUBLE) {
            NOTHING_WRONG(check_factor(F, &M.view));
        }
        SL_CHECK(sl_work_create(&W, NULL));
        for (sl_int nrhs = 1; nrhs <= 33; nrhs += nrhs < 4 ? 1 : 5) {
            local_solve_t q =
                local_solve_random(F, M.view.n_cols, nrhs % 3 ? 4 : -1, 5, nrhs, (uint64_t)nrhs);
            local_solve_check(S, F, &q, W);
            local_solve_free(&q);
        }
        sl_work_free(W);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

/* Children of one column follow each other by their rows below, where a supernode has many. */
static void siblings_are_sorted(void **state) {
    (void)state;
    gen_matrix_t M = separable(12, 300, 0);
    sl_symbolic *S = NULL;
    int sorted = 0;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    for (sl_int up = 0; up < v.n_supers; up++) {
        sl_int last = 0, count = 0, descents = 0;
        for (sl_int s = 0; s < up; s++) {
            const sl_int below = (sl_int)(v.rows_begin[s + 1] - v.rows_begin[s]);
            if (v.super_parent[s] == up && v.super_first[s + 1] - v.super_first[s] == 1) {
                descents += below < last;
                last = below;
                count++;
            }
        }
        assert_true(count < 64 || descents == 0);
        sorted += count >= 64;
    }
    assert_true(sorted > 0);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Components of two rows are no panels of 16 numbers, unless there is nothing else: then the matrix
 * may be complex. */
static void roots_of_two_columns_are_split(void **state) {
    (void)state;
    for (int odd = 0; odd < 2; odd++) {
        gen_list_t t = gen_list(200 + odd);
        sl_symbolic *S = NULL;
        for (sl_int k = 0; k < t.n; k++) {
            gen_add(&t, k, k, 2.0);
            if (k % 2 == 1) {
                gen_add(&t, k, k - 1, 1.0);
            }
        }
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        gen_list_free(&t);
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        const sl_symbolic_arrays v = sl_symbolic_view(S);
        assert_int_equal(v.n_supers, odd ? 201 : 100);
        assert_int_equal(v.panel_begin[v.n_supers], odd ? 301 : 1600);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

/* A loaded analysis finds the runs of columns again, and a mapped one does without. */
static void loaded_columns_have_the_same_bits(void **state) {
    (void)state;
    const saved_call_t calls[2] = {pair_load_memory, pair_map_memory};
    gen_matrix_t M = separable(12, 300, 0);
    const sl_int n = M.view.n_cols;
    double *b = test_reals((size_t)n), *x = test_reals((size_t)n), *y = test_reals((size_t)n);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    gen_reals(b, (size_t)n, 3);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
    saved_t m = saved_make(S, F);
    for (int k = 0; k < 2; k++) {
        sl_symbolic *T = NULL;
        sl_factor *G = NULL;
        SL_CHECK(calls[k](&T, &G, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
        for (int again = 0; again < 2 - k; again++) {
            SL_CHECK(sl_factor_solve(G, y, (size_t)n, b, (size_t)n, 1, NULL));
            assert_memory_equal(x, y, (size_t)n * sizeof *x);
            assert_same_bits(F, G);
            if (k == 0) {
                SL_CHECK(sl_factor_refactor(G, &M.view, NULL));
            }
        }
        sl_factor_free(G);
        sl_symbolic_free(T);
    }
    saved_free(&m);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    free(b);
    free(x);
    free(y);
}

/* Most columns of a tree stay apart, too. */
static void trees_are_hardly_padded(void **state) {
    (void)state;
    sl_options opt = options_none();
    gen_list_t t = gen_list(2500);
    sl_symbolic *S = NULL;
    sl_stats stats;
    uint64_t seed = 9;
    for (sl_int k = 0; k < t.n; k++) {
        gen_add(&t, k, k, 8.0);
        if (k > 0) {
            gen_add(&t, k, gen_below(&seed, k), -1.0);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats));
    assert_true((double)stats.symbolic.nnz_panels <= 1.3 * (double)stats.symbolic.nnz_l);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A number that is not finite is found in a column that has no front, with its row and column. */
static void a_nan_is_named(void **state) {
    (void)state;
    gen_matrix_t M = separable(3, 40, 0);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    for (sl_int p = 0; p < M.p[M.view.n_cols]; p += 7) {
        const double keep = M.x[p];
        M.x[p] = (double)NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_create(&F, S, &M.view, &opt, &stats));
        assert_true(stats.error.row == M.i[p] && M.p[stats.error.column] <= p &&
                    p < M.p[stats.error.column + 1]);
        M.x[p] = keep;
    }
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A pivot of 0 in the middle of a run of columns is refused with its row. */
static void a_null_pivot_is_named(void **state) {
    (void)state;
    gen_matrix_t M = separable(3, 40, 0);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (sl_int bound = 83; bound < 123; bound += 13) {
        double *d = &M.x[M.p[bound]]; /* the only entry of its column */
        const double keep = *d;
        *d = 0.0;
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &M.view, NULL, &stats));
        assert_int_equal(stats.error.row, bound);
        *d = keep;
    }
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A column whose diagonal A does not store: its pivot comes from its child. */
static void a_diagonal_may_be_missing(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 2, 3, 5, 6}, i[6] = {0, 1, 2, 2, 3, 3};
    static const double x[6] = {2.0, 1.0, 1.0, 5.0, 1.0, 7.0};
    const sl_csc A = {4, 4, p, i, x};
    const double wanted[4] = {2.0, -0.5, 7.0, 7.0 - 1.0 / 7.0};
    const variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_NONE);
        sl_factor *F = NULL;
        options_set_variant(&opt, &variants, k);
        SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
        for (int j = 0; j < 4; j++) {
            assert_true(fabs(sl_factor_view(F).D[j] - wanted[j]) < 1e-14);
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* Rank-one changes, and refactorizations of what some columns reach. */
static void changes_are_followed(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        gen_matrix_t M = separable(5, 80, 1);
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        opt.isa = isas.isa[k];
        SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
        for (sl_int column = 3; column < M.view.n_cols; column += 31) {
            for (sl_int q = M.p[column]; q < M.p[column + 1]; q++) {
                M.x[q] *= 1.25;
            }
            SL_CHECK(sl_factor_change_entries(F, &M.view, NULL, &column, NULL, 1, NULL, NULL));
            NOTHING_WRONG(check_factor(F, &M.view));
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

/* Regularization changes null pivots and those of the wrong sign, in the middle of runs, too. A
 * factor of a combination, which has no runs, has the same bits, shifts and statistics. */
static void pivots_are_regularized(void **state) {
    (void)state;
    enum { FEATURES = 12, POINTS = 60, ROWS = FEATURES + POINTS };
    gen_matrix_t M = separable(FEATURES, POINTS, 0);
    const sl_int n = M.view.n_cols;
    const double one = 1.0;
    sl_int *signs = test_ints((size_t)n);
    sl_int *row = test_ints(2 * (size_t)n);
    double *shift = test_reals(2 * (size_t)n), *values;
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    values = test_reals((size_t)scatter_length(S) + 1);
    const double *const terms[1] = {values};
    for (sl_int k = 0; k < n; k++) {
        signs[k] = k < ROWS ? 1 : k % 5 == 0 ? 0 : -1;
    }
    for (int way = 0; way < 4; way++) {
        sl_options opt = options_none();
        sl_factor *F[2] = {NULL, NULL};
        sl_stats stats[2];
        sl_int count[2];
        opt.regularization = 1e-8;
        opt.signs = way % 2 == 0 ? NULL : signs; /* NULL: all pivots shall be positive */
        for (sl_int k = ROWS + POINTS / 2; k < ROWS + POINTS && way > 1; k += 3) {
            M.x[M.p[k]] = k % 2 == 0 ? 0.0 : 10.0; /* bounds of points, each the only entry */
        }
        SL_CHECK(sl_symbolic_scatter(S, values, &M.view, NULL));
        SL_CHECK(sl_factor_create(&F[0], S, &M.view, FOR_FACTOR(&opt), &stats[0]));
        SL_CHECK(
            sl_factor_create_sums(&F[1], 1, S, &one, terms, 1, FOR_FACTOR(&opt), NULL, &stats[1]));
        assert_same_bits(F[0], F[1]);
        assert_ways_agree(S, &M.view, F[0], &opt);
        for (int k = 0; k < 2; k++) {
            SL_CHECK(sl_factor_pivot_rows(F[k], SL_PIVOT_REGULARIZED, row + k * n, shift + k * n, n,
                                          &count[k]));
        }
        assert_int_equal(count[0], count[1]);
        assert_int_equal(count[0], stats[0].factor.regularized);
        assert_true(way == 1 ? count[0] == 0 : count[0] > 0);
        assert_memory_equal(row, row + n, (size_t)count[0] * sizeof *row);
        assert_memory_equal(shift, shift + n, (size_t)count[0] * sizeof *shift);
        assert_int_equal(stats[0].factor.regularized, stats[1].factor.regularized);
        assert_int_equal(stats[0].factor.positive, stats[1].factor.positive);
        assert_int_equal(stats[0].factor.negative, stats[1].factor.negative);
        assert_true(stats[0].factor.pivot_min == stats[1].factor.pivot_min);
        assert_true(stats[0].factor.pivot_max == stats[1].factor.pivot_max);
        assert_true(stats[0].factor.growth == stats[1].factor.growth);
        sl_factor_free(F[0]);
        sl_factor_free(F[1]);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    free(values);
    free(signs);
    free(row);
    free(shift);
}

/* Edits keep what has the same values, in the same order and in another one of the features, and
 * notice each value that has changed: runs of plain columns leave no marks. */
static void edits_are_followed(void **state) {
    (void)state;
    enum { FEATURES = 5, POINTS = 80 };
    gen_matrix_t M = separable(FEATURES, POINTS, 1);
    const sl_int n = M.view.n_cols;
    sl_int *map = test_ints((size_t)n), *order = test_ints((size_t)n);
    sl_int *signs = test_ints((size_t)n); /* 0: any */
    sl_symbolic *S[2] = {NULL, NULL};
    sl_factor *F = NULL, *G = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S[0], &M.view, NULL, NULL));
    const sl_int *perm = sl_symbolic_view(S[0]).perm;
    for (sl_int k = 0, at = n; k < n; k++) { /* features in reverse order */
        map[k] = k;
        order[k] = perm[k];
        if (perm[k] < FEATURES) {
            do {
                at--;
            } while (perm[at] >= FEATURES);
            order[k] = perm[at];
        }
    }
    sl_options opt = options_none();
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = order;
    SL_CHECK(sl_symbolic_create(&S[1], &M.view, FOR_ANALYSIS(&opt), NULL));
    for (int way = 0; way < 4; way++) {
        sl_options any = options_none();
        any.regularization = way < 2 ? 0.0 : 1e-8; /* which changes no pivot */
        any.signs = signs;
        SL_CHECK(sl_factor_create(&F, S[0], &M.view, FOR_FACTOR(&any), NULL));
        SL_CHECK(sl_factor_edit(&G, F, S[way % 2], &M.view, map, FOR_FACTOR(&any), &stats));
        NOTHING_WRONG(check_factor(G, &M.view));
        assert_in_range(stats.reuse.kept, way % 2 == 0 ? n : n - 40, n); /* rows in another order */
        sl_factor_free(G);
        for (sl_int p = 0; p < M.p[n]; p += 41) {
            const double a = M.x[p];
            M.x[p] *= 1.0 + 1e-9;
            SL_CHECK(sl_factor_edit(&G, F, S[way % 2], &M.view, map, FOR_FACTOR(&any), &stats));
            NOTHING_WRONG(check_factor(G, &M.view));
            assert_true(stats.reuse.computed > 0);
            sl_factor_free(G);
            M.x[p] = a;
        }
        sl_factor_free(F);
    }
    sl_symbolic_free(S[0]);
    sl_symbolic_free(S[1]);
    gen_matrix_free(&M);
    free(map);
    free(order);
    free(signs);
}

/* Blocks of two leaves and their parent. Row 2 is the parent of the first. */
enum { BLOCKS = 200 };
static gen_matrix_t blocks_of_three(double leaf, double other, double parent) {
    gen_list_t t = gen_list(3 * BLOCKS);
    for (sl_int k = 0; k < t.n; k += 3) {
        gen_add(&t, k, k, leaf);
        gen_add(&t, k + 1, k + 1, other);
        gen_add(&t, k + 2, k + 2, parent);
        gen_add(&t, k + 2, k, 1.0);
        gen_add(&t, k + 2, k + 1, 1.0);
    }
    const gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* An edit of F after row 2 of A has changed gives the numbers, statistics and verdict of a factor
 * made anew. */
static void edit_row_2(const sl_symbolic *S, const sl_factor *F, const gen_matrix_t *M,
                       const sl_options *opt) {
    sl_int *map = test_ints(3 * BLOCKS);
    sl_factor *G = NULL, *H = NULL;
    sl_stats edited, anew;
    for (sl_int k = 0; k < 3 * BLOCKS; k++) {
        map[k] = k;
    }
    const sl_status status = sl_factor_create(&H, S, &M->view, FOR_FACTOR(opt), &anew);
    SL_EXPECT(status, sl_factor_edit(&G, F, S, &M->view, map, FOR_FACTOR(opt), &edited));
    assert_true(edited.factor.entry_max == anew.factor.entry_max);
    assert_true(edited.factor.growth == anew.factor.growth);
    if (status == SL_OK) {
        assert_same_bits(G, H);
    }
    sl_factor_free(G);
    sl_factor_free(H);
    free(map);
}

/* What a run computed may have been changed by other ways since, which leave bounds of entries and
 * growth; and regularization may absorb a new value. */
static void edits_after_changes_have_their_growth(void **state) {
    (void)state;
    const sl_int row = 2;
    const double delta = -982.0;
    sl_int *any = test_ints(3 * BLOCKS), *signs = test_ints(3 * BLOCKS);
    for (sl_int k = 0; k < 3 * BLOCKS; k++) {
        signs[k] = k % 3 == 2 ? -1 : 1;
    }
    for (int way = 0; way < 5; way++) {
        const int absorbs = way == 4;
        sl_options opt = options_none();
        sl_factor *F = NULL;
        gen_matrix_t M = absorbs ? blocks_of_three(0.0, 1.0, -1.0) : blocks_of_three(4.0, 8.0, 8.0);
        sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_NONE);
        opt.regularization = absorbs ? 1e-17 : way < 2 ? 0.0 : 1e-8;
        opt.signs = absorbs ? signs : any;
        opt.growth_limit = -1.0;
        if (!absorbs) {
            M.x[M.p[0]] = M.x[M.p[1]] = 0.125;
            M.x[M.p[2]] = 1000.0;
            M.x[M.p[5]] = -4.0;
        }
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
        if (!absorbs) {
            SL_CHECK(sl_factor_change_entries(F, NULL, &row, &row, &delta, 1, NULL, NULL));
        }
        M.x[M.p[2]] = absorbs ? -5.0 : 18.0;
        opt.growth_limit = way % 2 == 0 ? -1.0 : 1.5;
        edit_row_2(S, F, &M, &opt);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
    free(any);
    free(signs);
}

/* A file of the time when panels of one column were padded to whole tiles: this system's. */
static void padded_files_are_read(void **state) {
    (void)state;
    gen_matrix_t M = separable(3, 12, 0);
    const sl_int n = M.view.n_cols;
    double *b = test_reals((size_t)n), *x = test_reals((size_t)n), *y = test_reals((size_t)n);
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_selected *Z = NULL;
    gen_reals(b, (size_t)n, 3);
    SL_CHECK(pair_load_file(&S, &F, "tests/core/padded_columns.slf", SL_LOAD_CHECKED, NULL));
    SL_CHECK(sl_symbolic_create(&T, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&G, T, &M.view, NULL, NULL));
    assert_true(panel_doubles(F) >= 8 * (sl_off)sl_symbolic_view(S).n_supers);
    for (int again = 0; again < 2; again++) {
        SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
        SL_CHECK(sl_factor_solve(G, y, (size_t)n, b, (size_t)n, 1, NULL));
        for (sl_int k = 0; k < n; k++) {
            assert_true(fabs(x[k] - y[k]) < 1e-12);
        }
        SL_CHECK(sl_factor_refactor(F, &M.view, NULL));
    }
    SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL));
    sl_selected_free(Z);
    sl_factor_free(F);
    sl_factor_free(G);
    sl_symbolic_free(S);
    sl_symbolic_free(T);
    gen_matrix_free(&M);
    free(b);
    free(x);
    free(y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_are_kept_apart),
        cmocka_unit_test(siblings_are_sorted),
        cmocka_unit_test(roots_of_two_columns_are_split),
        cmocka_unit_test(loaded_columns_have_the_same_bits),
        cmocka_unit_test(trees_are_hardly_padded),
        cmocka_unit_test(a_nan_is_named),
        cmocka_unit_test(a_null_pivot_is_named),
        cmocka_unit_test(a_diagonal_may_be_missing),
        cmocka_unit_test(changes_are_followed),
        cmocka_unit_test(pivots_are_regularized),
        cmocka_unit_test(edits_are_followed),
        cmocka_unit_test(edits_after_changes_have_their_growth),
        cmocka_unit_test(padded_files_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
