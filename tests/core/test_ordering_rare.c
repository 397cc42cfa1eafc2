/* test_ordering_rare.c: what only other processors and sizes beyond memory reach, by direct calls:
 * small orders without AVX2, hubs of many edges, hierarchies that end, rows of equal keys; bands of
 * random graphs */
#define SPARSE_LOCAL_IMPLEMENTATION
#include "tests/lib/check_factor.h"

/* There are hubs up to a number of edges, beyond which sums of their costs would overflow, and as
 * long as they are few. */
static void hubs_are_few_and_of_few_edges(void **state) {
    (void)state;
    enum { N = 128 };
    for (int turn = 0; turn < 3; turn++) {
        const sl_off edges = turn == 1 ? 300000000 : 200000000;
        const sl_int hubs = turn == 2 ? 3 : 1;
        sl_off begin[N + 1];
        sli_level g;
        memset(&g, 0, sizeof g);
        g.n = N;
        g.begin = begin;
        for (sl_int v = 0; v <= N; v++) { /* the last vertices have nine tenths of the edges */
            begin[v] =
                v <= N - hubs ? edges / 10 / (N - 1) * v : edges - edges * 9 / 10 / hubs * (N - v);
        }
        sli_nd_count_degrees(&g);
        assert_int_equal(g.hub_degree, turn == 0 ? 3 * (edges / N) : 0);
    }
}

/* A path of vertices of which no two may be one. */
static void a_hierarchy_that_does_not_shrink_ends(void **state) {
    (void)state;
    enum { N = 1000 };
    static sli_dissection d;
    static sl_off begin[N + 1];
    static sl_int to[2 * N], weight[N], mate[N], member[N], start[N + 2], coarse[N];
    sli_level *g = &d.levels[0];
    sl_off edges = 0;
    int working;
    for (sl_int v = 0; v < N; v++) {
        begin[v] = edges;
        weight[v] = 100;
        if (v > 0) {
            to[edges++] = v - 1;
        }
        if (v + 1 < N) {
            to[edges++] = v + 1;
        }
    }
    begin[N] = edges;
    g->n = N;
    g->begin = begin;
    g->to = to;
    g->weight = weight;
    g->coarse = coarse;
    d.n_levels = 1;
    d.total = N; /* as if the mean weight were 1 */
    d.order = mate;
    d.other = member;
    d.begin = start;
    SL_CHECK(sli_dissect_coarsen(&d, &working));
    assert_int_equal(d.n_levels, 1);
    assert_int_equal(working, 0);
    assert_null(d.levels[1].block);
}

/* Rows of equal keys are compared: those of a square with the diagonal 0 - 2, and with a row that
 * hangs on 0. */
static void rows_of_equal_keys_may_differ(void **state) {
    (void)state;
    static sl_off begin[2][6] = {{0, 3, 5, 8, 10, 10}, {0, 4, 6, 9, 11, 12}};
    static sl_int to[2][12] = {{1, 2, 3, 0, 2, 0, 1, 3, 0, 2},
                               {1, 2, 3, 4, 0, 2, 0, 1, 3, 0, 2, 0}};
    for (int hangs = 0; hangs < 2; hangs++) {
        const sli_graph G = {5, begin[hangs], to[hangs]};
        assert_int_equal(sli_compress_is_indistinguishable(&G, 0, 2), !hangs);
        assert_int_equal(sli_compress_is_indistinguishable(&G, 2, 0), !hangs);
        assert_false(sli_compress_is_indistinguishable(&G, 0, 1));
        assert_false(sli_compress_is_indistinguishable(&G, 1, 2));
    }
}

/* Few steps from a border are most vertices of a random graph: its bands end early. */
static void bands_of_random_graphs_end(void **state) {
    (void)state;
    for (sl_int per_mille = 3; per_mille <= 5; per_mille++) { /* 6 edges a row */
        gen_list_t t = gen_list(6000 / per_mille);
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        uint64_t seed = 1;
        gen_edges_random(&t, per_mille, &seed);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        opt.ordering = SL_ORDERING_ND;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        const sl_symbolic_arrays v = sl_symbolic_view(S);
        NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
        NOTHING_WRONG(check_septree(&v, &M.view));
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

static void bisect_into_all_and_nothing(sli_subgraph *sub, int is_first) {
    (void)is_first;
    memset(sub->side, 1, (size_t)sub->n);
}

static void bisect_into_halves(sli_subgraph *sub, int is_first) {
    (void)is_first;
    for (sl_int k = 0; k < sub->n; k++) {
        sub->side[k] = k < sub->n / 2;
    }
}

/* A split that leaves all on one side is no progress, and would be tried until the tree is full. */
static void splits_have_two_sides(void **state) {
    (void)state;
    enum { N = 64 };
    static sl_off begin[N + 1];
    static sl_int to[2 * N];
    const sl_allocator a = sli_allocator(NULL);
    sli_team team = sli_team_of(1);
    sli_dissection d;
    sli_block b = {NULL, 0};
    for (sl_int v = 0; v < N; v++) { /* a circle */
        begin[v + 1] = begin[v] + 2;
        to[2 * v] = (v + 1) % N;
        to[2 * v + 1] = (v + N - 1) % N;
    }
    memset(&d, 0, sizeof d);
    d.team = &team;
    sli_dissection_layout(&d, &b, N, 2 * N); /* counts */
    SL_CHECK(sli_block_alloc(&b, &a));
    sli_dissection_layout(&d, &b, N, 2 * N);
    for (sl_int v = 0; v < N; v++) {
        d.workers->subgraph.local[v] = -1;
    }
    d.levels[0].n = d.total = N;
    d.levels[0].begin = begin;
    d.levels[0].to = to;
    d.leaf_size = 1;
    sli_dissect_start(&d);
    const sl_int room = d.tree.room;
    d.tree.room = 2; /* there is one node, and no room for two more */
    assert_int_equal(sli_dissect_split(&d, 1, bisect_into_halves), 0);
    d.tree.room = room;
    assert_int_equal(sli_dissect_split(&d, 1, bisect_into_halves), 1);
    assert_int_equal(sli_dissect_split(&d, 1, bisect_into_halves), 2);
    assert_int_equal(sli_dissect_split(&d, 1, bisect_into_all_and_nothing), 0);
    assert_int_equal(sli_dissect_split(&d, 1, bisect_into_halves), 4);
    assert_int_equal(sli_dissect_split(&d, 1, bisect_into_halves), 8);
    sli_free(&a, b.base);
}

/* What is before a cut that takes the first level as a whole is no part. */
static void parts_without_rows_are_none(void **state) {
    (void)state;
    sli_thin_part part[2];
    sli_thin t;
    memset(&t, 0, sizeof t);
    t.part = part;
    sli_thin_push(&t, 7, 7, 0, 5);
    assert_int_equal(t.parts, 0);
    sli_thin_push(&t, 7, 8, 1, 5);
    assert_int_equal(t.parts, 1);
    assert_int_equal(part[0].above, 5);
}

/* The cost of columns by themselves is that of their rows, unless the sum would overflow. */
static void columns_of_too_many_rows_are_merged(void **state) {
    (void)state;
    sl_int child = -1, sibling = -1, width = 1, below = INT32_MAX / 16;
    sli_amalgamation g;
    memset(&g, 0, sizeof g);
    g.width = &width;
    g.below = &below;
    assert_int_equal(sli_apart_cost(&g, 0, &child, &sibling), INT32_MAX);
    below--;
    assert_in_range(sli_apart_cost(&g, 0, &child, &sibling), below, INT32_MAX - 1);
}

/* The tolerance of pivots grows with the rows, and stays small for as many as there can be. */
static void the_null_tolerance_stays_small(void **state) {
    (void)state;
    assert_true(sli_null_tolerance(8000) == 1064.0 * DBL_EPSILON);
    assert_true(sli_null_tolerance(INT32_MAX) < 0.03125);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hubs_are_few_and_of_few_edges),
        cmocka_unit_test(a_hierarchy_that_does_not_shrink_ends),
        cmocka_unit_test(rows_of_equal_keys_may_differ),
        cmocka_unit_test(bands_of_random_graphs_end),
        cmocka_unit_test(splits_have_two_sides),
        cmocka_unit_test(parts_without_rows_are_none),
        cmocka_unit_test(columns_of_too_many_rows_are_merged),
        cmocka_unit_test(the_null_tolerance_stays_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
