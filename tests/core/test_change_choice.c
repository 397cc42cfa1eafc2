/* test_change_choice.c: sl_factor_change_entries: the way that it takes, its result, its fallbacks
 * */
#include "tests/lib/factored.h"

/* A grid Laplacian with 0.1 on the diagonal, as triplets that the tests change. */
typedef struct grid_t {
    sl_int side, n;
    gen_matrix_t M;
    sl_symbolic *S;
    sl_factor *F;
} grid_t;

static grid_t grid_make(sl_int side, int style, const sl_options *opt) {
    grid_t g = {side, side * side, {0}, NULL, NULL};
    gen_list_t t = gen_list(g.n);
    uint64_t seed = 3;
    gen_edges_grid(&t, side, side, 1, &seed);
    gen_laplacian(&t);
    for (sl_int k = 0; k < g.n; k++) {
        gen_add(&t, k, k, 0.1);
    }
    g.M = gen_store(&t, gen_style(style), 1);
    gen_list_free(&t);
    SL_CHECK(sl_symbolic_create(&g.S, &g.M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&g.F, g.S, &g.M.view, opt, NULL));
    return g;
}

static void grid_free(grid_t *g) {
    sl_factor_free(g->F);
    sl_symbolic_free(g->S);
    gen_matrix_free(&g->M);
}

/* Adds delta to the first stored entries (i, j) and (j, i). */
static void grid_add(grid_t *g, sl_int i, sl_int j, double delta) {
    for (int side = 0; side < (i == j ? 1 : 2); side++) {
        sl_int row = side ? j : i, column = side ? i : j;
        for (sl_int p = g->M.p[column]; p < g->M.p[column + 1]; p++) {
            if (g->M.i[p] == row) {
                g->M.x[p] += delta;
                break;
            }
        }
    }
}

typedef struct list_t {
    sl_int rows[4096], columns[4096], count;
    double deltas[4096];
} list_t;

static void list_add(list_t *l, grid_t *g, sl_int i, sl_int j, double delta) {
    l->rows[l->count] = i;
    l->columns[l->count] = j;
    l->deltas[l->count++] = delta;
    grid_add(g, i, j, delta);
}

static void list_edge(list_t *l, grid_t *g, sl_int i, sl_int j, double w) {
    list_add(l, g, i, i, w);
    list_add(l, g, j, j, w);
    list_add(l, g, i, j, -w);
}

static void assert_is_factor_of(const grid_t *g) {
    double *b = test_reals((size_t)g->n), *x = test_reals((size_t)g->n);
    gen_reals(b, (size_t)g->n, 9);
    SL_CHECK(sl_factor_solve(g->F, x, (size_t)g->n, b, (size_t)g->n, 1, NULL));
    BACKWARD_PASSES(&g->M.view, x, (size_t)g->n, b, (size_t)g->n, 1);
    free(b);
    free(x);
}

static sl_change_method change(grid_t *g, const list_t *l, sl_stats *stats) {
    SL_CHECK(sl_factor_change_entries(g->F, &g->M.view, l->rows, l->columns, l->deltas, l->count,
                                      NULL, stats));
    return stats->change.method;
}

/* One edge is a rank-one change, a patch a part of L, every weight a refactorization. */
static void each_way_is_taken_where_it_is_cheap(void **state) {
    (void)state;
    for (int style = 0; style < GEN_STYLES; style += 3) {
        grid_t g = grid_make(60, style, NULL);
        list_t *l = (list_t *)test_array(1, sizeof *l);
        sl_stats stats;
        list_edge(l, &g, 70, 71, 0.5);
        assert_int_equal(change(&g, l, &stats), SL_CHANGE_UPDATE);
        assert_int_equal(stats.change.reason, SL_CHANGE_CHEAPEST);
        assert_int_equal(stats.change.ranks, 1);
        assert_true(stats.change.flops_update > 0.0 && stats.change.flops_refactor > 0.0);
        assert_is_factor_of(&g);
        l->count = 0;
        for (sl_int k = 0; k < g.n; k++) {
            list_add(l, &g, k, k, 0.01);
        }
        assert_int_equal(change(&g, l, &stats), SL_CHANGE_REFACTOR);
        assert_true(stats.change.flops_update > stats.change.flops_refactor);
        assert_is_factor_of(&g);
        l->count = 0;
        assert_int_equal(change(&g, l, &stats), SL_CHANGE_NONE);
        free(l);
        grid_free(&g);
    }
}

static void patches_of_all_sizes_give_the_factor(void **state) {
    (void)state;
    int taken[4] = {0, 0, 0, 0};
    grid_t g = grid_make(60, 0, NULL);
    list_t *l = (list_t *)test_array(1, sizeof *l);
    for (sl_int size = 1; size < 36; size++) {
        sl_stats stats;
        l->count = 0;
        for (sl_int y = 0; y < size; y++) {
            for (sl_int x = 0; x < size; x++) {
                list_edge(l, &g, 60 * y + x, 60 * y + x + 1, 0.1);
            }
        }
        taken[change(&g, l, &stats)]++;
        assert_is_factor_of(&g);
    }
    assert_true(taken[SL_CHANGE_UPDATE] > 0);
    assert_true(taken[SL_CHANGE_REACH] + taken[SL_CHANGE_REFACTOR] > 0);
    free(l);
    grid_free(&g);
}

/* However often an entry is named, the columns that it reaches are recomputed, and no others: a
 * complete factorization would forget the rank-one change before. */
static void repeated_entries_have_the_reach_of_one(void **state) {
    (void)state;
    grid_t g = grid_make(120, 0, NULL);
    list_t *l = (list_t *)test_array(1, sizeof *l);
    sl_stats stats;
    list_add(l, &g, 7320, 7320, 0.5);
    assert_int_equal(change(&g, l, &stats), SL_CHANGE_UPDATE);
    l->count = 0;
    for (sl_int k = 0; k < 10 * 400; k++) {
        const sl_int v = 120 * (k % 20) + k / 20 % 20;
        list_add(l, &g, v, v, 0.01);
    }
    assert_int_equal(change(&g, l, &stats), SL_CHANGE_REACH);
    assert_int_equal(stats.change.updates, 1);
    assert_is_factor_of(&g);
    free(l);
    grid_free(&g);
}

/* Rank-one changes do not read A; a way that reads it refuses a pattern that was not analyzed. */
static void patterns_are_checked_where_they_are_read(void **state) {
    (void)state;
    for (sl_int count = 1; count <= 3600; count += 3599) {
        grid_t g = grid_make(60, 0, NULL);
        list_t *l = (list_t *)test_array(1, sizeof *l);
        sl_int *wrong = (sl_int *)test_array((size_t)g.M.view.p[g.n], sizeof *wrong);
        sl_csc A = g.M.view;
        A.i = wrong;
        l->count = count;
        for (sl_int k = 0; k < count; k++) {
            l->rows[k] = l->columns[k] = k;
            l->deltas[k] = 0.5;
        }
        sl_stats stats;
        const sl_status status =
            sl_factor_change_entries(g.F, &A, l->rows, l->columns, l->deltas, count, NULL, &stats);
        if (status == SL_OK) {
            assert_int_equal(stats.change.method, SL_CHANGE_UPDATE);
            for (sl_int k = 0; k < count; k++) {
                grid_add(&g, k, k, 0.5);
            }
        } else {
            assert_int_equal(status, SL_ERR_OTHER_PATTERN);
        }
        assert_is_factor_of(&g);
        free(wrong);
        free(l);
        grid_free(&g);
    }
}

/* A change that makes A indefinite is factored; a failed factor is, too. */
static void refused_updates_are_refactored(void **state) {
    (void)state;
    grid_t g = grid_make(20, 0, NULL);
    list_t *l = (list_t *)test_array(1, sizeof *l);
    sl_stats stats;
    list_add(l, &g, 7, 7, -50.0);
    assert_int_equal(change(&g, l, &stats), SL_CHANGE_REFACTOR);
    assert_int_equal(stats.change.reason, SL_CHANGE_REFUSED);
    assert_int_equal(stats.factor.negative, 1);
    assert_is_factor_of(&g);
    l->count = 0;
    list_add(l, &g, 7, 7, 50.0); /* and back: pivots of both signs may change them */
    (void)change(&g, l, &stats);
    assert_int_equal(stats.factor.negative, 0);
    assert_is_factor_of(&g);
    double keep = g.M.x[0];
    g.M.x[0] = NAN;
    for (sl_int k = 0; k < g.n; k++) {
        l->rows[k] = l->columns[k] = k;
        l->deltas[k] = 1.0;
    }
    l->count = g.n;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_change_entries(g.F, &g.M.view, l->rows, l->columns,
                                                          l->deltas, l->count, NULL, &stats));
    g.M.x[0] = keep;
    l->count = 0; /* F has no numbers: whatever the change is, it is refactored */
    assert_int_equal(change(&g, l, &stats), SL_CHANGE_REFACTOR);
    assert_int_equal(stats.change.reason, SL_CHANGE_UNSUITED);
    assert_is_factor_of(&g);
    free(l);
    grid_free(&g);
}

/* Null pivots: a singular Laplacian follows its weights by the other two ways. */
static void singular_laplacians_are_recomputed(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    grid_t g = grid_make(20, 0, &opt);
    list_t *l = (list_t *)test_array(1, sizeof *l);
    sl_stats stats;
    for (sl_int k = 0; k < g.n; k++) {
        list_add(l, &g, k, k, -0.1);
    }
    (void)change(&g, l, &stats);
    assert_int_equal(stats.factor.null, 1);
    l->count = 0;
    list_edge(l, &g, 21, 22, 3.0);
    assert_true(change(&g, l, &stats) >= SL_CHANGE_REACH);
    assert_int_equal(stats.change.reason, SL_CHANGE_UNSUITED);
    assert_int_equal(stats.factor.null, 1);
    double *b = test_reals((size_t)g.n), *x = test_reals((size_t)g.n);
    b[3] = 1.0;
    b[77] = -1.0;
    SL_CHECK(sl_factor_solve(g.F, x, (size_t)g.n, b, (size_t)g.n, 1, NULL));
    BACKWARD_PASSES(&g.M.view, x, (size_t)g.n, b, (size_t)g.n, 1);
    free(b);
    free(x);
    free(l);
    grid_free(&g);
}

/* L in float is neither updated nor recomputed in part: the factor has the bits of a new one. */
static void float_factors_are_refactored(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.storage = SL_STORAGE_FLOAT;
    grid_t g = grid_make(30, 0, &opt);
    list_t *l = (list_t *)test_array(1, sizeof *l);
    sl_factor *F;
    sl_stats stats;
    list_edge(l, &g, 70, 71, 0.5);
    assert_int_equal(change(&g, l, &stats), SL_CHANGE_REFACTOR);
    assert_int_equal(stats.change.reason, SL_CHANGE_UNSUITED);
    SL_CHECK(sl_factor_create(&F, g.S, &g.M.view, &opt, NULL));
    assert_same_bits(g.F, F);
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_change_entries(g.F, NULL, l->rows, l->columns,
                                                           l->deltas, l->count, NULL, NULL));
    assert_same_bits(g.F, F);
    sl_factor_free(F);
    free(l);
    grid_free(&g);
}

static void drift_ends_in_a_refactorization(void **state) {
    (void)state;
    grid_t g = grid_make(10, 0, NULL);
    list_t *l = (list_t *)test_array(1, sizeof *l);
    sl_stats stats;
    int refactored = 0;
    for (int k = 0; k < 60000 && refactored == 0; k++) {
        l->count = 0;
        list_edge(l, &g, 41, 42, k % 2 ? -0.75 : 0.75);
        refactored = change(&g, l, &stats) == SL_CHANGE_REFACTOR ? k : 0;
    }
    assert_true(refactored > 10000);
    assert_int_equal(stats.change.reason, SL_CHANGE_DRIFT);
    assert_true(stats.change.drift == 0.0 && stats.change.updates == 0);
    assert_is_factor_of(&g);
    free(l);
    grid_free(&g);
}

static void invalid_arguments_and_failing_allocations(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    grid_t g = grid_make(10, 0, &opt);
    list_t *l = (list_t *)test_array(1, sizeof *l);
    sl_int bad = 100;
    double one = 1.0;
    sl_csc other = g.M.view;
    other.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(NULL, &g.M.view, &bad, &bad, &one, 0, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(g.F, NULL, &bad, &bad, &one, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(g.F, &other, &bad, &bad, &one, 0, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(g.F, &g.M.view, &bad, &bad, &one, 1, NULL, NULL));
    other = g.M.view;
    other.n_cols = 9;
    SL_EXPECT(SL_ERR_OTHER_PATTERN,
              sl_factor_change_entries(g.F, &other, &bad, &bad, &one, 0, NULL, NULL));
    list_edge(l, &g, 41, 42, 0.5);
    sl_status status = SL_ERR_MEMORY;
    for (int k = 0; status != SL_OK; k++) {
        counter.fail_at = (int64_t)counter.calls + k;
        status = sl_factor_change_entries(g.F, &g.M.view, l->rows, l->columns, l->deltas, l->count,
                                          NULL, NULL);
        counter.fail_at = -1;
        if (status != SL_OK) { /* F is that of the old matrix */
            assert_int_equal(status, SL_ERR_MEMORY);
            grid_add(&g, 41, 41, -0.5);
            grid_add(&g, 42, 42, -0.5);
            grid_add(&g, 41, 42, 0.5);
            assert_is_factor_of(&g);
            grid_add(&g, 41, 41, 0.5);
            grid_add(&g, 42, 42, 0.5);
            grid_add(&g, 41, 42, -0.5);
        }
    }
    assert_is_factor_of(&g);
    free(l);
    grid_free(&g);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_way_is_taken_where_it_is_cheap),
        cmocka_unit_test(patches_of_all_sizes_give_the_factor),
        cmocka_unit_test(repeated_entries_have_the_reach_of_one),
        cmocka_unit_test(patterns_are_checked_where_they_are_read),
        cmocka_unit_test(refused_updates_are_refactored),
        cmocka_unit_test(singular_laplacians_are_recomputed),
        cmocka_unit_test(float_factors_are_refactored),
        cmocka_unit_test(drift_ends_in_a_refactorization),
        cmocka_unit_test(invalid_arguments_and_failing_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
