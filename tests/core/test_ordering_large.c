/* test_ordering_large.c: orderings of large graphs, heavy vertices, and points in any direction */
#include "tests/lib/check_factor.h"

/* Entries of L under an ordering, after a check of its permutation and separator tree. */
static double fill_of(const sl_csc *A, const sl_options *opt) {
    sl_symbolic *S = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_symbolic_create(&S, A, opt, &stats));
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
    NOTHING_WRONG(check_septree(&v, A));
    sl_symbolic_free(S);
    return (double)stats.symbolic.nnz_l;
}

static gen_matrix_t store(gen_list_t *t) {
    for (sl_int k = 0; k < t->n; k++) {
        gen_add(t, k, k, 1.0);
    }
    gen_matrix_t M = gen_store(t, gen_style(0), 1);
    gen_list_free(t);
    return M;
}

/* A grid that is turned in space: subgraphs of more than 16,384 points are bisected in the best of
 * several directions, so that a diagonal position costs next to nothing. */
static void the_direction_of_the_points_does_not_matter(void **state) {
    (void)state;
    const sl_int nx = 260, ny = 70;
    gen_list_t t = gen_list(nx * ny);
    uint64_t seed = 5;
    gen_edges_grid(&t, nx, ny, 1, &seed);
    gen_matrix_t M = store(&t);
    double *xyz = test_reals(3 * (size_t)(nx * ny)), straight = 0;
    for (int turn = 0; turn < 6; turn++) {
        const sl_int d = turn < 2 ? 2 : 3;
        static const int first[6] = {0, 0, 0, 0, 1, 2}, second[6] = {1, 1, 1, 2, 2, 0};
        const int a = first[turn], b = second[turn];
        sl_options opt = options_none();
        for (sl_int k = 0; k < nx * ny; k++) {
            double *at = xyz + (size_t)d * (size_t)k;
            const double x = k % nx, y = (double)(k / nx);
            at[0] = at[1] = at[d - 1] = 0;
            at[a] = turn == 0 ? x : x - y;
            at[b] = turn == 0 ? y : x + y;
        }
        opt.coordinates = xyz;
        opt.dimensions = d;
        const double fill = fill_of(&M.view, &opt);
        straight = turn == 0 ? fill : straight;
        if (fill > 1.1 * straight) {
            print_error("turn %d: %g entries, straight %g\n", turn, fill, straight);
            fail();
        }
    }
    free(xyz);
    gen_matrix_free(&M);
}

/* In a volume each point of which is adjacent to its 26 neighbors, planes are the best separators:
 * coordinates, which find them, do not make the order worse. */
static void planes_bisect_a_volume(void **state) {
    (void)state;
    const sl_int side = 14, n = side * side * side;
    gen_list_t t = gen_list(n);
    double *xyz = test_reals(3 * (size_t)n);
    for (sl_int v = 0; v < n; v++) {
        const sl_int x = v % side, y = v / side % side, z = v / side / side;
        xyz[3 * v] = x;
        xyz[3 * v + 1] = y;
        xyz[3 * v + 2] = z;
        for (sl_int q = 0; q < 13; q++) { /* one of each two opposite neighbors */
            const sl_int dx = q % 3 - 1, dy = q / 3 % 3 - 1, dz = q / 9 - 1;
            if (x + dx >= 0 && x + dx < side && y + dy >= 0 && y + dy < side && z + dz >= 0) {
                gen_add(&t, v, v + dx + side * dy + side * side * dz, 1.0);
            }
        }
    }
    gen_matrix_t M = store(&t);
    sl_options opt = options_none();
    const double plain = fill_of(&M.view, &opt);
    opt.coordinates = xyz;
    opt.dimensions = 3;
    const double planes = fill_of(&M.view, &opt);
    assert_true(planes <= 1.02 * plain);
    free(xyz);
    gen_matrix_free(&M);
}

/* METIS does not read coordinates. */
static void metis_ignores_points(void **state) {
    (void)state;
    if (!ordering_is_present(SL_ORDERING_METIS_REFINED)) {
        skip();
    }
    gen_matrix_t M = gen_matrix(GEN_GRID2, 900, 1, 1);
    double xyz[2 * 900];
    gen_reals(xyz, 2 * 900, 3);
    for (int refined = 0; refined < 2; refined++) {
        sl_options opt = options_none();
        sl_symbolic *S = NULL, *T = NULL;
        opt.ordering = refined ? SL_ORDERING_METIS_REFINED : SL_ORDERING_METIS;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        opt.coordinates = xyz;
        opt.dimensions = 2;
        SL_CHECK(sl_symbolic_create(&T, &M.view, &opt, NULL));
        assert_memory_equal(sl_symbolic_view(S).perm, sl_symbolic_view(T).perm,
                            900 * sizeof(sl_int));
        sl_symbolic_free(S);
        sl_symbolic_free(T);
    }
    gen_matrix_free(&M);
}

/* A path whose vertices are blocks of rows that are indistinguishable: few vertices, and a few of
 * them as heavy as a leaf should be. The fill is close to that of the natural order, which is
 * minimal. The sizes that METIS reports are then weights, not numbers of vertices. */
static void heavy_vertices_stay_whole(void **state) {
    (void)state;
    const sl_int vertices = 150, block = 40;
    gen_list_t t = gen_list(vertices * block);
    for (sl_int j = 0; j < t.n; j++) {
        for (sl_int i = j + 1; i < t.n && i < (j / block + 2) * block; i++) {
            gen_add(&t, i, j, 1.0);
        }
    }
    gen_matrix_t M = store(&t);
    sl_options opt = options_none();
    opt.ordering = SL_ORDERING_NATURAL;
    const double least = fill_of(&M.view, &opt);
    opt.ordering = SL_ORDERING_ND;
    assert_true(fill_of(&M.view, &opt) <= 1.5 * least);
    if (ordering_is_present(SL_ORDERING_METIS_REFINED)) {
        opt.ordering = SL_ORDERING_METIS_REFINED;
        assert_true(fill_of(&M.view, &opt) <= 2.0 * least);
    }
    gen_matrix_free(&M);
}

/* Random graphs without small separators, and with vertices of very many neighbors. */
static void graphs_without_separators_are_ordered(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        gen_list_t t = gen_list(kind == 0 ? 14000 : 6000);
        uint64_t seed = 8;
        for (sl_int k = 1; k < t.n; k++) {
            if (kind == 0) {
                gen_add(&t, k, gen_below(&seed, k), 1.0);
                if (k % 3 == 0) {
                    gen_add(&t, k, gen_below(&seed, k), 1.0);
                }
            } else {
                const sl_int hubs = kind == 1 ? 10 : 30;
                gen_add(&t, k, k < hubs ? k - 1 : gen_below(&seed, hubs), 1.0);
                if (k % (kind == 1 ? 40 : 5) == 0) {
                    gen_add(&t, k, gen_below(&seed, k), 1.0);
                }
            }
        }
        gen_matrix_t M = store(&t);
        sl_options opt = options_none();
        const double n = M.view.n_cols, fill = fill_of(&M.view, &opt);
        assert_true(fill < n * n / 2);
        gen_matrix_free(&M);
    }
}

/* A complete graph has so many edges that its degrees are not compared: one supernode. */
static void complete_graphs_are_one_supernode(void **state) {
    (void)state;
    const sl_int n = 1100;
    gen_list_t t = gen_list(n);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = j + 1; i < n; i++) {
            gen_add(&t, i, j, 1.0);
        }
    }
    gen_matrix_t M = store(&t);
    sl_symbolic *S;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, &stats));
    assert_int_equal(stats.symbolic.supernodes, 1);
    assert_int_equal(stats.symbolic.nnz_l, n * (n + 1) / 2);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* A grid of triangles with `side` x side vertices and their points. */
static gen_matrix_t triangles(sl_int side, double *points) {
    gen_list_t t = gen_list(side * side);
    for (sl_int v = 0; v < side * side; v++) {
        const sl_int column = v % side, row = v / side;
        points[2 * v] = column;
        points[2 * v + 1] = row;
        if (column + 1 < side) {
            gen_add(&t, v + 1, v, 1.0);
        }
        if (row + 1 < side) {
            gen_add(&t, v + side, v, 1.0);
        }
        if (column + 1 < side && row + 1 < side) {
            gen_add(&t, v + side + 1, v, 1.0);
        }
    }
    return store(&t);
}

/* Grids of any size are ordered by their points as well as without. */
static void small_grids_are_ordered_by_points(void **state) {
    (void)state;
    for (sl_int side = 2; side <= 40; side++) {
        double points[2 * 40 * 40];
        gen_matrix_t M = triangles(side, points);
        sl_options opt = options_none();
        const double fill = fill_of(&M.view, &opt);
        opt.coordinates = points;
        opt.dimensions = 2;
        assert_true(fill_of(&M.view, &opt) <= 1.1 * fill);
        gen_matrix_free(&M);
    }
}

/* Every allocation of an order by coordinates fails once. */
static void an_order_by_points_may_lack_memory(void **state) {
    (void)state;
    static double points[2 * 70 * 70];
    gen_matrix_t M = triangles(70, points);
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_symbolic *S = NULL;
        opt.coordinates = points;
        opt.dimensions = 2;
        counter.fail_at = k;
        status = sl_symbolic_create(&S, &M.view, &opt, NULL);
        assert_true(status == SL_OK || (status == SL_ERR_MEMORY && S == NULL));
        sl_symbolic_free(S);
        COUNTER_CLEAN(&counter);
    }
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_direction_of_the_points_does_not_matter),
        cmocka_unit_test(planes_bisect_a_volume),
        cmocka_unit_test(metis_ignores_points),
        cmocka_unit_test(heavy_vertices_stay_whole),
        cmocka_unit_test(graphs_without_separators_are_ordered),
        cmocka_unit_test(complete_graphs_are_one_supernode),
        cmocka_unit_test(small_grids_are_ordered_by_points),
        cmocka_unit_test(an_order_by_points_may_lack_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
