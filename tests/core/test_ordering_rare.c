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

/* The tolerance of pivots grows with the rows, up to a limit. */
static void the_null_tolerance_has_a_limit(void **state) {
    (void)state;
    assert_true(sli_null_tolerance(8000, DBL_EPSILON) == 1064.0 * DBL_EPSILON);
    assert_true(sli_null_tolerance(INT32_MAX, DBL_EPSILON) < 0.03125);
    assert_true(sli_null_tolerance(INT32_MAX, FLT_EPSILON) == 0.03125);
}

#if defined(__x86_64__) && !defined(SL_NO_SIMD) && !defined(_WIN32)

/* The first row has no diagonal, and 9 neighbors more if it is `few`. */
static gen_matrix_t without_diagonal(gen_kind_t kind, sl_int n, int is_few) {
    gen_list_t t = gen_make(kind, n, 1, 3);
    size_t kept = 0;
    for (sl_int row = 2; row < 11 && is_few; row++) {
        gen_add(&t, row, 0, 1.0);
    }
    for (size_t k = 0; k < t.count; k++) {
        if (t.row[k] > 0) {
            t.row[kept] = t.row[k];
            t.col[kept] = t.col[k];
            t.x[kept++] = t.x[k];
        }
    }
    t.count = kept;
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* The order of a small matrix, if it has one, by the instructions that every processor has, and by
 * AVX2 and popcnt. Returns whether there is one. */
static int small_orders(const sl_csc *A, int is_hurried) {
    enum { MOST = sizeof((sli_small *)0)->key / sizeof(uint32_t) };
    static uint64_t rows[MOST * MOST / 64];
    static sl_int column[MOST * MOST], perm[2][MOST];
    sli_order_job job;
    sli_small m;
    memset(&job, 0, sizeof job);
    job.A = A;
    job.column = column;
    job.triangle = SL_TRIANGLE_LOWER;
    job.is_hurried = is_hurried;
    m.n = A->n_cols;
    m.floor = is_hurried ? 1 : 3;
    m.rows = rows;
    for (sl_int j = 0; j < m.n; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            column[p] = j;
        }
    }
    memset(perm, -1, sizeof perm);
    job.perm = perm[0];
    const int has = sli_small_run(&m, &job);
    job.perm = perm[1];
    assert_int_equal(has, sli_small_run_avx2(&m, &job));
    assert_memory_equal(perm[0], perm[1], sizeof perm[0]);
    assert_int_equal(perm[0][m.n - 1] != -1, has);
    return has;
}

static void small_orders_on_any_processor(void **state) {
    (void)state;
    static const sl_int sizes[6] = {9, 30, 64, 65, 100, 256};
    static const gen_kind_t kinds[4] = {GEN_PATH, GEN_GRID2, GEN_DENSE, GEN_STAR};
    int found[2] = {0, 0};
    for (int turn = 0; turn < 6 * 4 * 6 && isas_present().count > 1; turn++) {
        const sl_int n = sizes[turn % 6];
        const gen_kind_t kind = kinds[turn / 6 % 4];
        const int which = turn / 24 % 3;
        gen_matrix_t M =
            which == 0 ? gen_matrix(kind, n, 1, 3) : without_diagonal(kind, n, which - 1);
        found[small_orders(&M.view, turn / 72)]++;
        gen_matrix_free(&M);
    }
    assert_int_equal(found[0] > 0, found[1] > 0);
    /* a row in two has three neighbors, the others none: peeled if the first factor is hurried */
    gen_list_t t = gen_list(100);
    for (sl_int k = 0; k < 100; k++) {
        for (sl_int j = k < 52 ? k / 4 * 4 : k; j <= k; j++) {
            gen_add(&t, k, j, 1.0);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    for (int is_hurried = 0; is_hurried < 2 && isas_present().count > 1; is_hurried++) {
        assert_int_equal(small_orders(&M.view, is_hurried), !is_hurried);
    }
    gen_matrix_free(&M);
    gen_list_free(&t);
}

#endif

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hubs_are_few_and_of_few_edges),
        cmocka_unit_test(a_hierarchy_that_does_not_shrink_ends),
        cmocka_unit_test(rows_of_equal_keys_may_differ),
        cmocka_unit_test(bands_of_random_graphs_end),
        cmocka_unit_test(parts_without_rows_are_none),
        cmocka_unit_test(columns_of_too_many_rows_are_merged),
        cmocka_unit_test(the_null_tolerance_has_a_limit),
#if defined(__x86_64__) && !defined(SL_NO_SIMD) && !defined(_WIN32)
        cmocka_unit_test(small_orders_on_any_processor),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
