/* test_plan_cost.c: a plan covers exactly the reach of its sets; its cost and allocations */
#include "tests/lib/factored.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/reserved.h"

typedef struct reach_t {
    sl_int supernodes, columns;
    /* Doubles of L in the tiles at and below the first needed column, counted from the first column
     * of that column's tile. */
    sl_off entries;
    sl_off rows; /* below the supernodes reached */
} reach_t;

static reach_t reach_by_graph_search(const sl_symbolic_arrays *v, const sl_int *set, sl_int count) {
    reach_t R = {0, 0, 0, 0};
    char *seen = (char *)test_array((size_t)v->n, 1);
    sl_int *queue = test_ints((size_t)v->n), head = 0, tail = 0;
    for (sl_int k = 0; k < count; k++) {
        sl_int start = v->iperm[set ? set[k] : k];
        queue[tail++] = start;
        seen[start] = 1;
    }
    while (head < tail) {
        sl_int k = queue[head++], s = v->super_of[k];
        for (sl_int r = k - v->super_first[s] + 1; r < ref_height(v, s); r++) {
            sl_int to = ref_row(v, s, r);
            if (!seen[to]) {
                seen[to] = 1;
                queue[tail++] = to;
            }
        }
    }
    for (sl_int s = 0; s < v->n_supers; s++) {
        sl_int width = ref_width(v, s), height = ref_height(v, s), first = 0;
        while (first < width && !seen[v->super_first[s] + first]) {
            first++;
        }
        if (first < width) {
            sl_int tile = first / 8;
            R.supernodes++;
            R.columns += width - 8 * tile;
            R.rows += height - width;
            R.entries += width == 1 ? height : 0;
            for (sl_int t = tile; 8 * t < height && width > 1; t++) {
                R.entries += 8 * ((width < 8 * (t + 1) ? width : 8 * (t + 1)) - 8 * tile);
            }
        }
    }
    free(seen);
    free(queue);
    R.entries = set ? R.entries : v->panel_begin[v->n_supers]; /* with what is between panels */
    return R;
}

static void the_reach_equals_a_graph_search(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int round = 0; round < 24; round++) {
            sl_options opt = options_none();
            opt.relaxation = (sl_relaxation)(round % 2);
            opt.ordering = round % 4 < 2 ? SL_ORDERING_ND : SL_ORDERING_NATURAL;
            gen_matrix_t M =
                gen_matrix((gen_kind_t)kind, round < 12 ? 30 : 300, 1, (uint64_t)round);
            sl_int n = M.view.n_cols, nb = gen_below(&seed, n + 1),
                   nx = gen_below(&seed, 3) % (n + 1);
            sl_int *bset = test_ints((size_t)n), *xset = test_ints((size_t)n);
            sl_symbolic *S = NULL;
            sl_plan *P = NULL;
            sl_stats stats, again;
            memset(&stats, 0, sizeof stats);
            memset(&again, 0, sizeof again);
            gen_set(bset, nb, n, seed);
            gen_set(xset, nx, n, seed + 1);
            SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
            SL_CHECK(sl_plan_create(&P, S, round % 5 ? bset : NULL, round % 5 ? nb : SL_ALL, xset,
                                    nx, NULL, &stats));
            sl_symbolic_arrays v = sl_symbolic_view(S);
            reach_t b = reach_by_graph_search(&v, round % 5 ? bset : NULL, round % 5 ? nb : n),
                    x = reach_by_graph_search(&v, xset, nx);
            assert_int_equal(stats.plan.b_supernodes, b.supernodes);
            assert_int_equal(stats.plan.b_columns, b.columns);
            assert_int_equal(stats.plan.b_entries, b.entries);
            assert_int_equal(stats.plan.x_supernodes, x.supernodes);
            assert_int_equal(stats.plan.x_columns, x.columns);
            assert_int_equal(stats.plan.x_entries, x.entries);
            again.symbolic.n = 77;
            sl_plan_stats(P, &again);
            assert_int_equal(again.plan.b_columns, b.columns);
            assert_int_equal(again.plan.x_entries, x.entries);
            assert_int_equal(again.plan.bytes, stats.plan.bytes);
            assert_int_equal(again.symbolic.n, 77);
            sl_plan_free(P);
            sl_symbolic_free(S);
            gen_matrix_free(&M);
            free(bset);
            free(xset);
        }
    }
}

/* Without relaxation the reach matches the dense reference: it holds every column of L that a
 * search along L's entries visits, and otherwise only the columns that share a tile with a needed
 * one. */
static void the_reach_equals_the_dense_reference(void **state) {
    (void)state;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        gen_matrix_t M = gen_matrix((gen_kind_t)kind, 40, 1, 3);
        sl_int n = M.view.n_cols;
        sl_options opt = options_none();
        opt.relaxation = SL_RELAXATION_NONE;
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        sl_symbolic_arrays v = sl_symbolic_view(S);
        char *P = ref_pattern(&M.view), *fill = ref_permute_pattern(n, P, v.perm),
             *seen = (char *)test_array((size_t)n, 1);
        ref_fill(n, fill);
        for (sl_int row = 0; row < n; row++) {
            sl_plan *plan = NULL;
            sl_stats stats;
            sl_int columns = 0, tiled = 0;
            memset(&stats, 0, sizeof stats);
            memset(seen, 0, (size_t)n);
            SL_CHECK(sl_plan_create(&plan, S, &row, 1, &row, 1, NULL, &stats));
            ref_reach_from(n, fill, v.iperm[row], seen);
            for (sl_int k = 0; k < n; k++) {
                sl_int s = v.super_of[k], tile = v.super_first[s] + (k - v.super_first[s]) / 8 * 8;
                columns += seen[k];
                for (sl_int c = tile; c < tile + 8 && c < v.super_first[s + 1]; c++) {
                    if (seen[c]) {
                        tiled++; /* A column is in the reach if its tile holds a needed one. */
                        break;
                    }
                }
            }
            assert_int_equal(stats.plan.b_columns, tiled);
            assert_int_equal(stats.plan.x_columns, tiled);
            assert_true(columns <= tiled && tiled <= columns + 7 * stats.plan.b_supernodes);
            sl_plan_free(plan);
        }
        free(P);
        free(fill);
        free(seen);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

static void the_reach_of_all_rows_is_the_whole_factor(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_stats stats, all;
    sl_plan *P = NULL;
    memset(&stats, 0, sizeof stats);
    memset(&all, 0, sizeof all);
    all.symbolic = sl_symbolic_view(y.S).info;
    SL_CHECK(sl_plan_create(&P, y.S, NULL, SL_ALL, NULL, SL_ALL, NULL, &stats));
    assert_int_equal(stats.plan.b_columns, 400);
    assert_int_equal(stats.plan.x_columns, 400);
    assert_int_equal(stats.plan.b_supernodes, all.symbolic.supernodes);
    assert_int_equal(stats.plan.b_entries, all.symbolic.nnz_panels);
    assert_int_equal(stats.plan.x_entries, all.symbolic.nnz_panels);
    assert_true(stats.plan.bytes < 4096); /* The analysis holds everything already. */
    sl_plan_free(P);
    /* Empty sets reach nothing. */
    SL_CHECK(sl_plan_create(&P, y.S, y.M.i, 0, y.M.i, 0, NULL, &stats));
    assert_int_equal(stats.plan.b_columns + stats.plan.x_columns, 0);
    assert_int_equal(stats.plan.b_entries + stats.plan.x_entries, 0);
    sl_plan_free(P);
    factored_free(&y);
}

static void solves_allocate_nothing_after_the_first(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    factored_t y = factored_make(GEN_GRID2, 2500, 1, 0, NULL);
    sl_int bset[2500], xset[2500];
    double B[50 * 9], X[70 * 9];
    sl_work *W = NULL, *V = NULL;
    sl_plan *P = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    gen_set(bset, 50, 2500, 1);
    gen_set(xset, 70, 2500, 2);
    gen_reals(B, 50 * 9, 3);
    SL_CHECK(sl_work_create(&W, &opt));
    SL_CHECK(sl_plan_create(&P, y.S, bset, 50, xset, 70, &opt, &stats));
    assert_true(stats.plan.bytes <= counter.live_bytes);
    /* With the workspace reserved, nothing is allocated from the first solve on. */
    RESERVE_FOR(W, NULL, sl_plan_solve(P, y.F, X, 70, B, 50, 9, trial));
    size_t calls = counter.calls;
    for (sl_int nrhs = 0; nrhs <= 9; nrhs++) {
        SL_CHECK(sl_plan_solve(P, y.F, X, 70, B, 50, nrhs, W));
    }
    assert_int_equal(counter.calls, calls);
    /* Without a reservation, nothing is allocated from the second solve on. One-call solves keep
     * their reach in the workspace too. */
    SL_CHECK(sl_work_create(&V, &opt));
    SL_CHECK(sl_local_solve(y.F, bset, 50, xset, 70, X, 70, B, 50, 9, V, NULL));
    calls = counter.calls;
    size_t bytes = sl_work_bytes(V);
    for (int round = 0; round < 10; round++) {
        SL_CHECK(sl_local_solve(y.F, bset, 50, xset, 70, X, 70, B, 50, 1 + round % 9, V, NULL));
        /* smaller sets */
        SL_CHECK(sl_local_solve(y.F, bset, 5 * round, xset, 7 * round, X, 70, B, 50, 9, V, NULL));
        SL_CHECK(sl_plan_solve(P, y.F, X, 70, B, 50, 9, V));
    }
    assert_int_equal(counter.calls, calls);
    assert_int_equal(sl_work_bytes(V), bytes);
    sl_work_free(W);
    sl_work_free(V);
    sl_plan_free(P);
    factored_free(&y);
    COUNTER_CLEAN(&counter);
}

/* Bytes that a plan and a one-call solve of the same patch allocate on a grid of side x side
 * vertices, divided by the size of the reach. */
static void measure_bytes(sl_int side, double per_reach[2], reach_t *reach) {
    sl_int n = side * side, patch[49], count = 0, *perm = test_ints((size_t)n);
    gen_list_t t = gen_list(n);
    uint64_t seed = 1;
    double B[49 * 4], X[49 * 4];
    gen_edges_grid(&t, side, side, 1, &seed);
    gen_dominate(&t, 1, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    sl_work *W = NULL;
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = perm;
    assert_int_equal(gen_dissect(perm, 0, side, 0, side, 0, side), n);
    SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
    /* A patch near a corner, away from the first separators. */
    for (sl_int y = 0; y < 7; y++) {
        for (sl_int x = 0; x < 7; x++) {
            patch[count++] = 10 + x + side * (10 + y);
        }
    }
    sl_symbolic_arrays v = sl_symbolic_view(S);
    *reach = reach_by_graph_search(&v, patch, 49);
    double size = (double)(2 * (reach->rows + reach->columns));
    gen_reals(B, 49 * 4, 1);

    counter_t counter = counter_make();
    sl_options counted = options_counted(&counter);
    SL_CHECK(sl_plan_create(&P, S, patch, 49, patch, 49, &counted, NULL));
    per_reach[0] = (double)counter.total_bytes / size;
    counter_t shot = counter_make();
    counted = options_counted(&shot);
    SL_CHECK(sl_work_create(&W, &counted));
    SL_CHECK(sl_local_solve(F, patch, 49, patch, 49, X, 49, B, 49, 4, W, NULL));
    per_reach[1] = (double)shot.total_bytes / size;
    print_message(
        "n = %ld: reach of %ld columns, %ld rows; plan %ld bytes, one-call solve %ld bytes\n",
        (long)n, (long)reach->columns, (long)reach->rows, (long)counter.total_bytes,
        (long)shot.total_bytes);
    sl_plan_free(P);
    sl_work_free(W);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    free(perm);
    COUNTER_CLEAN(&counter);
    COUNTER_CLEAN(&shot);
}

/* From n = 1e4 to n = 1.6e5 the reach of a patch grows like sqrt(n), a factor of 4, while n grows
 * by 16. Any allocation of n bytes or more in a local call would raise the bytes per row of the
 * reach. The slack of a quarter is for arrays that grow by doubling. */
static void memory_does_not_grow_with_n(void **state) {
    (void)state;
    static const sl_int sides[3] = {100, 200, 400};
    double first[2], now[2];
    reach_t reach, reach_first;
    measure_bytes(sides[0], first, &reach_first);
    for (int k = 1; k < 3; k++) {
        measure_bytes(sides[k], now, &reach);
        assert_true(reach.columns < reach_first.columns * (k == 1 ? 3 : 6));
        assert_true(now[0] <= 1.25 * first[0]);
        assert_true(now[1] <= 1.25 * first[1]);
    }
}

typedef enum chain_t { CHAIN_PATH, CHAIN_RING, CHAIN_WHEEL } chain_t;

/* A matrix whose elimination tree in natural order is one chain: every column but the first has a
 * child. In the ring and in the wheel (a ring plus its hub as the last row) every supernode also
 * has a row at the far end of the chain. */
static factored_t chain_make(chain_t kind, sl_int n) {
    gen_list_t t = gen_list(n);
    uint64_t seed = 11;
    sl_options opt = options_none();
    factored_t y = {{NULL, NULL, NULL, {0, 0, NULL, NULL, NULL}}, NULL, NULL};
    if (kind == CHAIN_PATH) {
        gen_edges_path(&t, &seed);
    } else {
        gen_edges_ring(&t, kind == CHAIN_WHEEL ? n - 1 : n, &seed);
    }
    if (kind == CHAIN_WHEEL) {
        gen_edges_star(&t, n - 1, &seed);
    }
    gen_dominate(&t, 1, &seed);
    y.M = gen_store(&t, gen_style(0), 1);
    y.S = analyze_natural(&y.M.view, SL_RELAXATION_DEFAULT);
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, FOR_FACTOR(&opt), NULL));
    gen_list_free(&t);
    return y;
}

/* The reach of the leaf is the whole chain, in which a supernode has a row far up. The bench times
 * such plans (question locality). */
static void the_reach_of_a_leaf_is_its_whole_chain(void **state) {
    (void)state;
    const sl_int leaf = 0, n = 150000;
    for (int kind = CHAIN_PATH; kind <= CHAIN_WHEEL; kind++) {
        factored_t y = chain_make((chain_t)kind, n);
        sl_plan *P = NULL;
        sl_stats stats;
        SL_CHECK(sl_plan_create(&P, y.S, &leaf, 1, &leaf, 1, NULL, &stats));
        assert_int_equal(stats.plan.b_columns, n);
        assert_int_equal(stats.plan.x_columns, n);
        sl_plan_free(P);
        factored_free(&y);
    }
}

static void local_solves_are_right_with_far_rows(void **state) {
    (void)state;
    static const sl_int sizes[6] = {4, 13, 40, 121, 364, 1093};
    for (int kind = CHAIN_PATH; kind <= CHAIN_WHEEL; kind++) {
        for (int size = 0; size < 6; size++) {
            factored_t y = chain_make((chain_t)kind, sizes[size]);
            const sl_int n = y.M.view.n_cols;
            for (uint64_t seed = 0; seed < 6; seed++) {
                local_solve_t q =
                    local_solve_random(y.F, n, seed % 2 ? 1 : 4, 1 + (sl_int)seed % 3, 2, seed);
                local_solve_check(y.S, y.F, &q, NULL);
                local_solve_free(&q);
            }
            factored_free(&y);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reach_equals_a_graph_search),
        cmocka_unit_test(the_reach_equals_the_dense_reference),
        cmocka_unit_test(the_reach_of_all_rows_is_the_whole_factor),
        cmocka_unit_test(solves_allocate_nothing_after_the_first),
        cmocka_unit_test(memory_does_not_grow_with_n),
        cmocka_unit_test(the_reach_of_a_leaf_is_its_whole_chain),
        cmocka_unit_test(local_solves_are_right_with_far_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
