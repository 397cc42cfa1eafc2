/* test_factor_edit_use.c: sl_factor_edit: other rules, pivots in pairs, wrong maps, failures */
#include "tests/lib/followed.h"
#include "tests/lib/saved.h"

/* The factor of A that follows F is that of a new one, to rounding if it kept some columns. Returns
 * how many it kept. */
static sl_int kept_of(const sl_factor *F, const sl_symbolic *S, const sl_csc *A,
                      const sl_options *opt, sl_change_reason reason) {
    sl_int *map = test_ints((size_t)A->n_cols);
    sl_factor *G = NULL, *H = NULL;
    sl_stats stats, fresh;
    for (sl_int k = 0; k < A->n_cols; k++) {
        map[k] = k;
    }
    SL_CHECK(sl_factor_edit(&G, F, S, A, map, opt, &stats));
    SL_CHECK(sl_factor_create(&H, S, A, opt, &fresh));
    if (stats.reuse.kept == 0 || stats.reuse.kept == A->n_cols) {
        assert_same_bits(G, H);
    }
    for (sl_int k = 0; k < A->n_cols; k++) {
        const double d = sl_factor_view(H).D[k];
        assert_true(fabs(sl_factor_view(G).D[k] - d) <= 1e-11 * fabs(d));
    }
    assert_int_equal(stats.reuse.reason, reason);
    assert_int_equal(stats.factor.null, fresh.factor.null);
    assert_int_equal(stats.factor.positive, fresh.factor.positive);
    sl_factor_free(G);
    sl_factor_free(H);
    free(map);
    return stats.reuse.kept;
}

static void pairs_of_pivots_are_not_kept(void **state) {
    (void)state;
    saved_case_t c = saved_case_make(SAVED_PIVOTED, GEN_GRID2, 196, 0, NULL);
    const sl_csc *A = &c.y.M.view;
    sl_options opt = options_none();
    sl_symbolic *S;
    sl_factor *F;
    assert_true(sl_symbolic_view(c.y.S).pairs != NULL);
    opt.growth_limit = opt.error_limit = -1.0;
    SL_CHECK(sl_symbolic_create(&S, A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, A, &opt, NULL));
    assert_int_equal(kept_of(c.y.F, c.y.S, A, &opt, SL_CHANGE_UNSUITED), 0);
    assert_int_equal(kept_of(c.y.F, S, A, &opt, SL_CHANGE_UNSUITED), 0);
    assert_int_equal(kept_of(F, c.y.S, A, &opt, SL_CHANGE_UNSUITED), 0);
    assert_int_equal(kept_of(F, S, A, &opt, SL_CHANGE_CHEAPEST), 196);
    sl_factor_free(F);
    sl_symbolic_free(S);
    saved_case_free(&c);
}

/* A row that may now have any sign, or that has another null pivot, is computed. A regularized
 * pivot is kept. */
static void other_rules_of_a_row_are_noticed(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_options opt = options_none();
    sl_int signs[400];
    sl_factor *F;
    sl_stats stats;
    for (int k = 0; k < 400; k++) {
        signs[k] = 1;
    }
    opt.regularization = 1e-10;
    opt.signs = signs;
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    assert_int_equal(kept_of(F, y.S, &y.M.view, &opt, SL_CHANGE_CHEAPEST), 400);
    signs[57] = 0;
    assert_in_range(kept_of(F, y.S, &y.M.view, &opt, SL_CHANGE_CHEAPEST), 100, 399);
    sl_factor_free(F);
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
    assert_int_equal(kept_of(F, y.S, &y.M.view, &opt, SL_CHANGE_CHEAPEST), 400);
    sl_factor_free(F);
    factored_free(&y);
    y = factored_make(GEN_FOREST, 400, 1, 0, NULL);
    for (int k = 0; k < 400; k++) {
        signs[k] = k % 9 == 0 ? -1 : 1;
    }
    SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, &stats)); /* pivots of the wrong sign */
    assert_in_range(stats.factor.regularized, 1, 60);
    assert_int_equal(kept_of(F, y.S, &y.M.view, &opt, SL_CHANGE_CHEAPEST), 400);
    sl_factor_free(F);
    factored_free(&y);
}

/* Two Laplacians side by side: one of them is regular in the first matrix only. */
static void another_kind_of_a_pivot_is_noticed(void **state) {
    (void)state;
    enum { W = 20 };
    uint64_t random = 4;
    sl_options opt = options_none();
    double vectors[2 * 2 * W * W];
    sl_symbolic *S = NULL;
    sl_factor *F, *G;
    gen_list_t t = gen_list(W * W), both = gen_list(2 * W * W);
    gen_edges_grid(&t, W, W, 1, &random);
    for (size_t k = 0; k < t.count; k++) {
        for (sl_int at = 0; at <= W * W; at += W * W) {
            gen_add(&both, at + t.row[k], at + t.col[k], -1.0);
            gen_add(&both, at + t.row[k], at + t.row[k], 1.0);
            gen_add(&both, at + t.col[k], at + t.col[k], 1.0);
        }
    }
    gen_matrix_t B = gen_store(&both, gen_style(0), 1);
    gen_add(&both, 2 * W * W - 1, 2 * W * W - 1, 0.5);
    gen_matrix_t A = gen_store(&both, gen_style(0), 1);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.method = SL_METHOD_SUPERNODAL;
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A.view, &opt, NULL));
    sl_symbolic *T = NULL;
    SL_CHECK(sl_symbolic_create(&T, &B.view, NULL, NULL));
    assert_in_range(kept_of(F, T, &B.view, &opt, SL_CHANGE_CHEAPEST), W * W / 2, 2 * W * W - 1);
    assert_int_equal(kept_of(F, S, &A.view, &opt, SL_CHANGE_CHEAPEST), 2 * W * W);

    /* several null vectors, before or after */
    for (int k = 0; k < 2 * W * W; k++) {
        vectors[k] = 1.0;
        vectors[2 * W * W + k] = k;
    }
    sl_options several = opt;
    several.null_vector = vectors;
    several.null_vector_count = 2;
    SL_CHECK(sl_factor_create(&G, S, &A.view, &several, NULL));
    assert_int_equal(kept_of(F, S, &A.view, &several, SL_CHANGE_UNSUITED), 0);
    assert_int_equal(kept_of(G, S, &A.view, &opt, SL_CHANGE_UNSUITED), 0);
    sl_factor_free(G);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_symbolic_free(T);
    gen_list_free(&t);
    gen_list_free(&both);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
}

/* A Laplacian whose one mass is gone: its last pivot is a rounding error of heavier rows, which the
 * tolerance may miss. It is refused as sl_factor_create refuses it. */
static void a_singular_matrix_is_noticed(void **state) {
    (void)state;
    enum { W = 20 };
    sl_int map[W * W];
    int suspected = 0;
    for (sl_int k = 0; k < W * W; k++) {
        map[k] = k;
    }
    for (uint64_t seed = 1; seed <= 60; seed++) {
        uint64_t random = seed;
        gen_list_t t = gen_list(W * W), all = gen_list(W * W);
        gen_edges_grid(&t, W, W, 1, &random);
        for (size_t k = 0; k < t.count; k++) {
            const double weight = pow(10.0, -4.0 * fabs(gen_real(&random)));
            gen_add(&all, t.row[k], t.col[k], -weight);
            gen_add(&all, t.row[k], t.row[k], weight);
            gen_add(&all, t.col[k], t.col[k], weight);
        }
        gen_matrix_t M = gen_store(&all, gen_style(0), 1);
        sl_symbolic *S;
        sl_factor *F, *G = (sl_factor *)(void *)map, *H;
        sl_stats got, wanted;
        const sl_int p = M.view.p[0]; /* the diagonal entry of row 0 */
        assert_int_equal(M.view.i[p], 0);
        const double before = M.x[p];
        M.x[p] = before + 1.0;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
        M.x[p] = before;
        const sl_status status = sl_factor_edit(&G, F, S, &M.view, map, NULL, &got);
        SL_EXPECT(sl_factor_create(&H, S, &M.view, NULL, &wanted), status);
        assert_int_equal(status, SL_ERR_PIVOT);
        assert_null(G);
        assert_int_equal(got.error.row, wanted.error.row);
        suspected += got.error.value == wanted.error.value;
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
        gen_list_free(&all);
    }
    assert_true(suspected > 0);
}

/* A number that is not finite, in a column that is computed: the error is that of a new factor. */
static void numbers_that_are_not_finite_are_noticed(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    const sl_int n = y.M.view.n_cols, last = sl_symbolic_view(y.S).perm[n - 1];
    sl_int *map = test_ints((size_t)n);
    sl_factor *G = (sl_factor *)(void *)map, *H = NULL;
    sl_stats got, wanted;
    for (sl_int k = 0; k < n; k++) {
        map[k] = k;
    }
    for (int is_nan = 0; is_nan < 2; is_nan++) { /* a finite one keeps most columns */
        y.M.x[y.M.p[last]] = is_nan ? (double)NAN : 9.0;
        assert_int_equal(y.M.i[y.M.p[last]], last);
        SL_EXPECT(is_nan ? SL_ERR_NOT_FINITE : SL_OK,
                  sl_factor_edit(&G, y.F, y.S, &y.M.view, map, NULL, &got));
        SL_EXPECT(is_nan ? SL_ERR_NOT_FINITE : SL_OK,
                  sl_factor_create(&H, y.S, &y.M.view, NULL, &wanted));
        assert_true(is_nan || (2 * got.reuse.kept > n && got.reuse.kept < n));
        assert_true((G == NULL) == is_nan);
        assert_int_equal(got.error.row, wanted.error.row);
        assert_int_equal(got.error.row, is_nan ? last : -1);
        sl_factor_free(G);
        sl_factor_free(H);
    }
    free(map);
    factored_free(&y);
}

/* The leaves of a star, each with an edge to row LEAVES, but leaf 0 to row `to`. */
enum { LEAVES = 60 };

static gen_matrix_t star(sl_int to) {
    gen_list_t t = gen_list(LEAVES + 2);
    for (sl_int k = 0; k < LEAVES + 2; k++) {
        gen_add(&t, k, k, k < LEAVES ? 2.0 : LEAVES);
    }
    for (sl_int k = 0; k < LEAVES; k++) {
        gen_add(&t, k == 0 ? to : LEAVES, k, -1.0);
    }
    gen_add(&t, LEAVES + 1, LEAVES, -1.0);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* A column whose entry is in another row than before, though its values are the same, is computed:
 * in a row after those that it had, or before them. */
static void another_row_is_noticed(void **state) {
    (void)state;
    for (int before = 0; before < 2; before++) {
        gen_matrix_t A = star(LEAVES + before), B = star(LEAVES + 1 - before);
        sl_options opt = options_none();
        opt.method = SL_METHOD_SUPERNODAL;
        factored_t y = {A, analyze_natural(&A.view, SL_RELAXATION_NONE), NULL};
        sl_symbolic *S = analyze_natural(&B.view, SL_RELAXATION_NONE);
        sl_factor *G = NULL;
        sl_stats stats;
        sl_int map[LEAVES + 2];
        for (sl_int k = 0; k < LEAVES + 2; k++) {
            map[k] = k;
        }
        SL_CHECK(sl_factor_create(&y.F, y.S, &A.view, &opt, NULL));
        SL_CHECK(sl_factor_edit(&G, y.F, S, &B.view, map, &opt, &stats));
        NOTHING_WRONG(check_factor(G, &B.view));
        assert_int_equal(stats.reuse.kept + stats.reuse.computed, LEAVES + 2);
        assert_true(stats.reuse.computed > 0);
        sl_factor_free(G);
        sl_symbolic_free(S);
        gen_matrix_free(&B);
        factored_free(&y);
    }
}

/* A map that is not that of the edit costs time only; one that is none is refused. */
static void wrong_maps_are_harmless(void **state) {
    (void)state;
    uint64_t random = 11;
    followed_t y = followed_make(gen_make(GEN_GRID2, 196, 1, 42), 1, NULL);
    sl_int *map = identity(y.t.n);
    sl_stats stats;
    sl_factor *G = NULL;
    for (int k = 0; k < 20; k++) {
        for (int swaps = 0; swaps < 1 + k * k; swaps++) {
            const sl_int i = gen_below(&random, y.t.n), j = gen_below(&random, y.t.n);
            const sl_int kept = map[i];
            map[i] = map[j];
            map[j] = kept;
        }
        if (k % 2) {
            map[gen_below(&random, y.t.n)] = -1;
        }
        SL_CHECK(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &stats));
        check_right(G, &y.A.view);
        sl_factor_free(G);
    }
    static const struct {
        sl_int row, value;
    } wrong[4] = {{7, 196}, {8, -2}, {9, 3}, {190, INT32_MAX}};
    for (int k = 0; k < 4; k++) {
        free(map);
        map = identity(y.t.n);
        map[wrong[k].row] = wrong[k].value;
        G = (sl_factor *)(void *)map;
        assert_int_equal(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &stats),
                         SL_ERR_ARGUMENT);
        assert_null(G);
        assert_int_equal(stats.error.row, wrong[k].row);
    }
    assert_int_equal(sl_factor_edit(NULL, y.F, y.S, &y.A.view, map, NULL, NULL), SL_ERR_ARGUMENT);
    assert_int_equal(sl_factor_edit(&G, y.F, y.S, &y.A.view, NULL, NULL, NULL), SL_ERR_ARGUMENT);
    free(map);
    followed_free(&y);
}

/* What sl_factor_create refuses is refused with the same place. */
static void failures_are_those_of_a_new_factor(void **state) {
    (void)state;
    followed_t y = followed_make(gen_make(GEN_GRID2, 196, 1, 42), 0, NULL);
    sl_int *map = identity(y.t.n);
    for (int k = 0; k < 3; k++) {
        const sl_int p = y.A.view.p[60 + 30 * k];
        const double kept = y.A.x[p];
        sl_factor *G = (sl_factor *)(void *)map, *H = NULL;
        sl_stats got, wanted;
        y.A.x[p] = k == 0 ? (double)NAN : k == 1 ? (double)INFINITY : -kept;
        const sl_status status = sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, &got);
        assert_int_equal(status, sl_factor_create(&H, y.S, &y.A.view, NULL, &wanted));
        assert_true(k == 2 || status == SL_ERR_NOT_FINITE);
        assert_true((G != NULL) == (status == SL_OK));
        assert_int_equal(got.error.row, wanted.error.row);
        assert_int_equal(got.error.column, wanted.error.column);
        assert_int_equal(got.factor.negative, wanted.factor.negative);
        sl_factor_free(G);
        sl_factor_free(H);
        y.A.x[p] = kept;
    }
    sl_factor *G = (sl_factor *)(void *)map;
    y.A.x[0] = (double)NAN;
    assert_int_equal(sl_factor_refactor(y.F, &y.A.view, NULL), SL_ERR_NOT_FINITE);
    assert_int_equal(sl_factor_edit(&G, y.F, y.S, &y.A.view, map, NULL, NULL), SL_ERR_STALE);
    assert_null(G);
    free(map);
    followed_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_of_pivots_are_not_kept),
        cmocka_unit_test(other_rules_of_a_row_are_noticed),
        cmocka_unit_test(another_kind_of_a_pivot_is_noticed),
        cmocka_unit_test(another_row_is_noticed),
        cmocka_unit_test(a_singular_matrix_is_noticed),
        cmocka_unit_test(numbers_that_are_not_finite_are_noticed),
        cmocka_unit_test(wrong_maps_are_harmless),
        cmocka_unit_test(failures_are_those_of_a_new_factor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
