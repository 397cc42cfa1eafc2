/* test_peel.c: rows with few neighbors are eliminated first: fill, short paths, hostile graphs */
#include "tests/lib/ordering_meshes.h"

typedef struct costs_t {
    double fill, path; /* entries of L, the mean path weight */
    sl_int nodes, height;
} costs_t;

/* What an order costs, after a check of its permutation. The diagonal is added to t. */
static costs_t costs_of(gen_list_t *t, sl_ordering ordering) {
    costs_t c;
    sl_options opt = options_none();
    sl_stats stats;
    sl_symbolic *S = NULL;
    uint64_t seed = 2;
    gen_dominate(t, 1, &seed);
    gen_matrix_t M = gen_store(t, gen_style(0), 1);
    opt.ordering = ordering;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats));
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
    NOTHING_WRONG(check_septree(&v, &M.view));
    c.nodes = v.n_nodes;
    c.height = stats.symbolic.tree_height;
    const order_quality q = order_quality_of(&M.view, &opt);
    c.fill = q.fill;
    c.path = q.path;
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(t);
    return c;
}

/* Names the rows at random. */
static void rename_rows(gen_list_t *t) {
    sl_int *name = test_ints((size_t)t->n);
    gen_permutation(name, t->n, 5);
    for (size_t k = 0; k < t->count; k++) {
        const sl_int a = name[t->row[k]], b = name[t->col[k]];
        t->row[k] = a > b ? a : b;
        t->col[k] = a > b ? b : a;
    }
    free(name);
}

/* Paths, rings and trees, whose rows are all eliminated in advance: minimum degree has no fill on
 * trees; for many solves, 4096 rows have an elimination tree of some 12 to 40 levels. */
static void trees_and_chains_are_halved(void **state) {
    (void)state;
    enum { PATH, RING, BINARY, RANDOM, CATERPILLAR, KINDS, N = 4096 };
    for (int kind = 0; kind < KINDS; kind++) {
        for (int is_mindeg = 0; is_mindeg < 2; is_mindeg++) {
            gen_list_t t = gen_list(N);
            uint64_t seed = 3;
            for (sl_int k = 1; k < N; k++) {
                gen_add(&t, k,
                        kind == BINARY        ? (k - 1) / 2
                        : kind == RANDOM      ? gen_below(&seed, k)
                        : kind == CATERPILLAR ? (k < N / 2 ? k - 1 : k - N / 2)
                                              : k - 1,
                        1.0);
            }
            if (kind == RING) {
                gen_add(&t, N - 1, 0, 1.0);
            }
            rename_rows(&t);
            const costs_t c = costs_of(&t, is_mindeg ? SL_ORDERING_MINDEG : SL_ORDERING_ND);
            assert_int_equal(c.nodes, 0);
            if (is_mindeg && kind != RING) {
                assert_true(c.fill == 2 * N - 1);
            } else {
                assert_true(c.fill <= 3 * N);
                assert_true(c.height <= 40);
                assert_true(c.path <= 80);
            }
        }
    }
}

/* A grid whose edges are chains of up to three rows has the fill of the grid and of the chains. */
static void chains_of_a_grid_are_eliminated_first(void **state) {
    (void)state;
    const sl_int side = 40;
    gen_list_t grid = gen_list(side * side), t = gen_list(side * side);
    uint64_t seed = 4;
    gen_edges_grid(&grid, side, side, 1, &seed);
    for (size_t k = 0; k < grid.count; k++) {
        sl_int last = grid.col[k];
        for (sl_int rows = gen_below(&seed, 4); rows > 0; rows--) {
            gen_add(&t, t.n, last, 1.0);
            last = t.n++;
        }
        gen_add(&t, last, grid.row[k], 1.0);
    }
    const double chains = (double)(t.n - grid.n);
    const costs_t whole = costs_of(&t, SL_ORDERING_ND), base = costs_of(&grid, SL_ORDERING_ND);
    assert_true(whole.fill <= 1.1 * base.fill + 3 * chains);
    assert_true(whole.path <= 1.2 * base.path);
}

/* Hubs with thousands of common neighbors, hubs on chains, fans of triangles, repeated edges. */
static void hostile_graphs_are_ordered(void **state) {
    (void)state;
    enum { HUBS, CHAINS, FAN, TRIANGLES, KINDS, N = 6000 };
    for (int kind = 0; kind < KINDS; kind++) {
        for (int is_mindeg = 0; is_mindeg < 2; is_mindeg++) {
            gen_list_t t = gen_list(N);
            uint64_t seed = 7;
            for (sl_int k = 80; k < N; k++) {
                if (kind == HUBS || kind == CHAINS) { /* between two of 80 or of 8 rows */
                    gen_add(&t, k, kind == HUBS ? gen_below(&seed, 80) : k % 8, 1.0);
                    gen_add(&t, k, kind == HUBS ? gen_below(&seed, 80) : k > 200 ? k - 90 : 9, 1.0);
                } else { /* a strip of triangles, or a fan */
                    gen_add(&t, k, k - 1, 1.0);
                    gen_add(&t, k, kind == FAN ? 3 : k - 2, 1.0);
                }
            }
            rename_rows(&t);
            const costs_t c = costs_of(&t, is_mindeg ? SL_ORDERING_MINDEG : SL_ORDERING_ND);
            assert_true(c.fill <= (kind == CHAINS ? 12 : 5) * (double)N);
        }
    }
}

/* Two hubs have too many neighbors for a search, so that two rows between them leave their edge
 * twice. In time they have no other one. A long ring keeps the rows of one neighbor few. */
static void an_edge_may_be_there_twice(void **state) {
    (void)state;
    enum { RING = 20000, HUB = RING, BETWEEN = HUB + 2, LEAVES = BETWEEN + 2, N = LEAVES + 66 };
    for (int way = 0; way < 2; way++) {
        gen_list_t t = gen_list(N);
        for (sl_int k = 0; k < RING; k++) {
            gen_add(&t, k, (k + RING - 1) % RING, 1.0);
        }
        for (sl_int k = 0; k < 4; k++) {
            gen_add(&t, BETWEEN + k / 2, HUB + k % 2, 1.0);
        }
        for (sl_int k = LEAVES; k < N; k++) {
            gen_add(&t, k, HUB + k % 2, 1.0);
        }
        const costs_t c = costs_of(&t, way ? SL_ORDERING_MINDEG : SL_ORDERING_ND);
        assert_true(c.fill < 3.0 * N);
        assert_true(way || c.height < 60);
    }
}

static void memory_fails_at_every_point(void **state) {
    (void)state;
    gen_list_t t = gen_list(600);
    sl_symbolic *S = NULL;
    uint64_t seed = 5;
    gen_edges_grid(&t, 20, 20, 1, &seed);
    for (sl_int k = 400; k < t.n; k++) {
        gen_add(&t, k, gen_below(&seed, 400), 1.0);
    }
    gen_dominate(&t, 1, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    analysis_may_lack_memory(&M.view, SL_ORDERING_ND);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    assert_int_equal(sl_symbolic_view(S).n_nodes, 0);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* Forests for one factor, or by minimum degree: a matrix without duplicates is ordered without a
 * graph, one with duplicates by lists, and both alike. A hub without a diagonal entry, which
 * would be a null pivot, is one of the cases. */
static void forests_have_one_order(void **state) {
    (void)state;
    enum { PATH, BINARY, RANDOM, SEVERAL, HUB, CONSTRAINT, EMPTY, KINDS, N = 200 };
    for (int kind = 0; kind < KINDS; kind++) {
        gen_list_t t = gen_list(N);
        uint64_t seed = 7;
        for (sl_int k = 1; k < N && kind != EMPTY; k++) {
            if (kind != SEVERAL || k % 23 > 0) {
                gen_add(&t, k,
                        kind == BINARY                      ? (k - 1) / 2
                        : kind == RANDOM || kind == SEVERAL ? gen_below(&seed, k)
                        : kind == HUB || kind == CONSTRAINT ? 0
                                                            : k - 1,
                        1.0);
            }
        }
        rename_rows(&t);
        for (sl_int k = 0; k < N; k++) {
            int is_hub = 0; /* has the row more than 7 neighbors? */
            for (size_t e = 0; e < t.count && kind == CONSTRAINT; e++) {
                is_hub += (t.row[e] != t.col[e]) && (t.row[e] == k || t.col[e] == k);
            }
            if (is_hub < 8) {
                gen_add(&t, k, k, 9.0);
            }
        }
        for (int is_mindeg = 0; is_mindeg < 2; is_mindeg++) {
            sl_int *perm = test_ints(N);
            for (int style = 0; style < GEN_STYLES; style++) {
                gen_matrix_t M = gen_store(&t, gen_style(style), 1);
                sl_options opt = options_none();
                sl_symbolic *S = NULL;
                sl_stats stats;
                memset(&stats, 0, sizeof stats);
                opt.ordering = is_mindeg ? SL_ORDERING_MINDEG : SL_ORDERING_ND;
                opt.purpose = SL_PURPOSE_ONE_FACTOR;
                SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats));
                const sl_symbolic_arrays v = sl_symbolic_view(S);
                NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
                NOTHING_WRONG(check_supernodes(&v));
                NOTHING_WRONG(check_structure(&v, &M.view, 0));
                assert_true(stats.symbolic.nnz_l == 2 * N - stats.symbolic.components);
                if (style == 0) {
                    memcpy(perm, v.perm, N * sizeof *perm);
                }
                assert_memory_equal(perm, v.perm, N * sizeof *perm);
                sl_symbolic_free(S);
                gen_matrix_free(&M);
            }
            free(perm);
        }
        gen_list_free(&t);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_and_chains_are_halved),
        cmocka_unit_test(chains_of_a_grid_are_eliminated_first),
        cmocka_unit_test(hostile_graphs_are_ordered),
        cmocka_unit_test(an_edge_may_be_there_twice),
        cmocka_unit_test(forests_have_one_order),
        cmocka_unit_test(memory_fails_at_every_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
