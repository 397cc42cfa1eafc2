/* test_plan_cost.c: a plan holds just the reach of its sets, costs what that reach costs, and solves allocate nothing */
#include <time.h>

#include "problem.h"
#include "question.h"

/* ---- the reach by a plain walk along the rows of L's panels ---- */

typedef struct reach_t {
    sl_int supernodes, columns;
    sl_off
        entries; /* doubles of L in the tiles at and below the first column needed, from that tile's column on */
    sl_off rows; /* below the supernodes met */
} reach_t;

static reach_t walk(const sl_symbolic_view_t *v, const sl_int *set, sl_int count) {
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
            for (sl_int t = tile; 8 * t < height; t++) {
                R.entries += 8 * ((width < 8 * (t + 1) ? width : 8 * (t + 1)) - 8 * tile);
            }
        }
    }
    free(seen);
    free(queue);
    return R;
}

static void the_reach_is_that_of_a_graph_search(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int round = 0; round < 24; round++) {
            sl_options opt = options_none();
            opt.relaxation = (sl_relaxation)(round % 2);
            opt.ordering = round % 4 < 2 ? SL_ORDERING_DEFAULT : SL_ORDERING_NATURAL;
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
            SL_CHECK(sl_plan_create(&P, S, round % 5 ? bset : NULL, nb, xset, nx, NULL, &stats));
            sl_symbolic_view_t v = sl_symbolic_view(S);
            reach_t b = walk(&v, round % 5 ? bset : NULL, round % 5 ? nb : n),
                    x = walk(&v, xset, nx);
            assert_int_equal(stats.b_supernodes, b.supernodes);
            assert_int_equal(stats.b_columns, b.columns);
            assert_int_equal(stats.b_entries, b.entries);
            assert_int_equal(stats.x_supernodes, x.supernodes);
            assert_int_equal(stats.x_columns, x.columns);
            assert_int_equal(stats.x_entries, x.entries);
            again.n = 77;
            sl_plan_stats(P, &again);
            assert_int_equal(again.b_columns, b.columns);
            assert_int_equal(again.x_entries, x.entries);
            assert_int_equal(again.bytes_plan, stats.bytes_plan);
            assert_int_equal(again.n, 77);
            sl_plan_free(P);
            sl_symbolic_free(S);
            gen_matrix_free(&M);
            free(bset);
            free(xset);
        }
    }
}

/* Without relaxation, and where no tile holds two columns of which only the later is needed, the reach is the one of
 * the dense reference: every column of L that a walk along its entries meets, and none more than tiles bring. */
static void the_reach_holds_what_the_dense_reference_needs(void **state) {
    (void)state;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        gen_matrix_t M = gen_matrix((gen_kind_t)kind, 40, 1, 3);
        sl_int n = M.view.n_cols;
        sl_options opt = options_none();
        opt.relaxation = SL_RELAXATION_NONE;
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        sl_symbolic_view_t v = sl_symbolic_view(S);
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
                        tiled++; /* a column comes with the tile that a needed one is in */
                        break;
                    }
                }
            }
            assert_int_equal(stats.b_columns, tiled);
            assert_int_equal(stats.x_columns, tiled);
            assert_true(columns <= tiled && tiled <= columns + 7 * stats.b_supernodes);
            sl_plan_free(plan);
        }
        free(P);
        free(fill);
        free(seen);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

static void the_reach_of_everything_is_everything(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_stats stats, all;
    sl_plan *P = NULL;
    memset(&stats, 0, sizeof stats);
    memset(&all, 0, sizeof all);
    sl_symbolic_stats(y.S, &all);
    SL_CHECK(sl_plan_create(&P, y.S, NULL, 0, NULL, 0, NULL, &stats));
    assert_int_equal(stats.b_columns, 400);
    assert_int_equal(stats.x_columns, 400);
    assert_int_equal(stats.b_supernodes, all.supernodes);
    assert_int_equal(stats.b_entries, all.nnz_panels);
    assert_int_equal(stats.x_entries, all.nnz_panels);
    assert_true(stats.bytes_plan < 4096); /* everything is in the analysis already */
    sl_plan_free(P);
    SL_CHECK(
        sl_plan_create(&P, y.S, y.M.i, 0, y.M.i, 0, NULL, &stats)); /* empty sets reach nothing */
    assert_int_equal(stats.b_columns + stats.x_columns, 0);
    assert_int_equal(stats.b_entries + stats.x_entries, 0);
    sl_plan_free(P);
    problem_free(&y);
}

/* ---- memory ---- */

static void solves_allocate_nothing_once_grown(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    problem_t y = problem_make(GEN_GRID2, 2500, 1, 0, NULL);
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
    assert_true(stats.bytes_plan <= counter.live_bytes);
    /* reserved: nothing from the first solve on */
    SL_CHECK(sl_work_reserve_plan(W, P, 9));
    size_t calls = counter.calls;
    for (sl_int nrhs = 0; nrhs <= 9; nrhs++) {
        SL_CHECK(sl_plan_solve(P, y.F, X, 70, B, 50, nrhs, W));
    }
    assert_int_equal(counter.calls, calls);
    /* not reserved: nothing from the second on; one-shot solves keep their reach in the workspace as well */
    SL_CHECK(sl_work_create(&V, &opt));
    SL_CHECK(sl_local_solve(y.F, X, 70, xset, 70, B, 50, bset, 50, 9, V, NULL));
    calls = counter.calls;
    size_t bytes = sl_work_bytes(V);
    for (int round = 0; round < 10; round++) {
        SL_CHECK(sl_local_solve(y.F, X, 70, xset, 70, B, 50, bset, 50, 1 + round % 9, V, NULL));
        SL_CHECK(sl_local_solve(y.F, X, 70, xset, 7 * round, B, 50, bset, 5 * round, 9, V,
                                NULL)); /* smaller sets */
        SL_CHECK(sl_plan_solve(P, y.F, X, 70, B, 50, 9, V));
    }
    assert_int_equal(counter.calls, calls);
    assert_int_equal(sl_work_bytes(V), bytes);
    sl_work_free(W);
    sl_work_free(V);
    sl_plan_free(P);
    problem_free(&y);
    COUNTER_CLEAN(&counter);
}

/* Bytes that a plan and a one-shot solve of the same patch take on ever larger grids, over the size of the reach. */
static void measure(sl_int side, double per_reach[2], reach_t *reach) {
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
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    for (sl_int y = 0; y < 7; y++) { /* a patch near a corner, away from the first separators */
        for (sl_int x = 0; x < 7; x++) {
            patch[count++] = 10 + x + side * (10 + y);
        }
    }
    sl_symbolic_view_t v = sl_symbolic_view(S);
    *reach = walk(&v, patch, 49);
    double size = (double)(2 * (reach->rows + reach->columns));
    gen_reals(B, 49 * 4, 1);

    counter_t counter = counter_make();
    sl_options counted = options_counted(&counter);
    SL_CHECK(sl_plan_create(&P, S, patch, 49, patch, 49, &counted, NULL));
    per_reach[0] = (double)counter.total_bytes / size;
    counter_t shot = counter_make();
    counted = options_counted(&shot);
    SL_CHECK(sl_work_create(&W, &counted));
    SL_CHECK(sl_local_solve(F, X, 49, patch, 49, B, 49, patch, 49, 4, W, NULL));
    per_reach[1] = (double)shot.total_bytes / size;
    print_message(
        "n = %ld: reach of %ld columns, %ld rows; plan %ld bytes, one-shot solve %ld bytes\n",
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

/* From n = 1e4 to 1.6e5 the reach of a patch grows like sqrt n, 4 times, and n by 16. Anything of n bytes or more in a
 * local call would push the bytes for each row of the reach up; a quarter is left for what grows by doubling. */
static void nothing_grows_with_n(void **state) {
    (void)state;
    static const sl_int sides[3] = {100, 200, 400};
    double first[2], now[2];
    reach_t reach, reach_first;
    measure(sides[0], first, &reach_first);
    for (int k = 1; k < 3; k++) {
        measure(sides[k], now, &reach);
        assert_true(reach.columns < reach_first.columns * (k == 1 ? 3 : 6));
        assert_true(now[0] <= 1.25 * first[0]);
        assert_true(now[1] <= 1.25 * first[1]);
    }
}

/* ---- time ---- */

typedef enum branch_t { BRANCH_PATH, BRANCH_RING, BRANCH_WHEEL } branch_t;

/* One long branch in natural order: every tree column has a child. In the ring and the wheel (a ring and, as the last
 * row, its hub) each supernode also has a row at the far end of the branch. */
static problem_t branch_make(branch_t kind, sl_int n) {
    gen_list_t t = gen_list(n);
    uint64_t seed = 11;
    sl_options opt = options_none();
    problem_t y = {{NULL, NULL, NULL, {0, 0, NULL, NULL, NULL}}, NULL, NULL};
    if (kind == BRANCH_PATH) {
        gen_edges_path(&t, &seed);
    } else {
        gen_edges_ring(&t, kind == BRANCH_WHEEL ? n - 1 : n, &seed);
    }
    if (kind == BRANCH_WHEEL) {
        gen_edges_star(&t, n - 1, &seed);
    }
    gen_dominate(&t, 1, &seed);
    y.M = gen_store(&t, gen_style(0), 1);
    opt.ordering = SL_ORDERING_NATURAL;
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, &opt, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
    gen_list_free(&t);
    return y;
}

/* Processor time of a plan from the leaf of the branch: the best of five. */
static double seconds_of_a_plan(const sl_symbolic *S) {
    const sl_int leaf = 0;
    double best = 1e30;
    for (int round = 0; round < 5; round++) {
        sl_plan *P = NULL;
        const clock_t begin = clock();
        SL_CHECK(sl_plan_create(&P, S, &leaf, 1, &leaf, 1, NULL, NULL));
        const double seconds = (double)(clock() - begin) / (double)CLOCKS_PER_SEC;
        best = seconds < best ? seconds : best;
        sl_plan_free(P);
    }
    return best;
}

/* The reach of a leaf is the whole branch, of as many supernodes with the far row as without it: a plan takes at most a
 * few times as long. Climbing to the far row step by step took a thousand times as long on these, and more with n. */
static void a_row_at_the_far_end_of_a_branch_is_found_at_once(void **state) {
    (void)state;
    double seconds[3];
    for (int kind = BRANCH_PATH; kind <= BRANCH_WHEEL; kind++) {
        problem_t y = branch_make((branch_t)kind, 150000);
        seconds[kind] = seconds_of_a_plan(y.S);
        problem_free(&y);
    }
    print_message("plan of a path %.2f ms, of a ring %.2f ms, of a wheel %.2f ms\n",
                  1e3 * seconds[BRANCH_PATH], 1e3 * seconds[BRANCH_RING],
                  1e3 * seconds[BRANCH_WHEEL]);
    /* a millisecond more, where the clock is that coarse */
    assert_true(seconds[BRANCH_RING] <= 15 * seconds[BRANCH_PATH] + 1e-3);
    assert_true(seconds[BRANCH_WHEEL] <= 15 * seconds[BRANCH_PATH] + 1e-3);
}

static void far_rows_are_the_right_ones(void **state) {
    (void)state;
    static const sl_int sizes[6] = {4, 13, 40, 121, 364, 1093};
    for (int kind = BRANCH_PATH; kind <= BRANCH_WHEEL; kind++) {
        for (int size = 0; size < 6; size++) {
            problem_t y = branch_make((branch_t)kind, sizes[size]);
            const sl_int n = y.M.view.n_cols;
            for (uint64_t seed = 0; seed < 6; seed++) {
                question_t q = ask(y.F, n, seed % 2 ? 1 : 4, 1 + (sl_int)seed % 3, 2, seed);
                answer(y.S, y.F, &q, NULL);
                forget(&q);
            }
            problem_free(&y);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reach_is_that_of_a_graph_search),
        cmocka_unit_test(the_reach_holds_what_the_dense_reference_needs),
        cmocka_unit_test(the_reach_of_everything_is_everything),
        cmocka_unit_test(solves_allocate_nothing_once_grown),
        cmocka_unit_test(nothing_grows_with_n),
        cmocka_unit_test(a_row_at_the_far_end_of_a_branch_is_found_at_once),
        cmocka_unit_test(far_rows_are_the_right_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
