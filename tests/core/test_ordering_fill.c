/* test_ordering_fill.c: entries of L and of its paths, against METIS */
#include "tests/lib/ordering_meshes.h"

#define SIZES 3
#define NAMES 4

/* The limits against METIS were measured with METIS 5.1.0 and the rand() of glibc, from which it
 * draws. Another one, or another rand(), is another seed: the cost of one matrix scatters by 3 to
 * 6 % over seeds. */
#if defined(SL_METIS) && !defined(SL_NO_METIS)
#include <metis.h>
#if defined(__GLIBC__) && METIS_VER_MAJOR == 5 && METIS_VER_MINOR == 1 && METIS_VER_SUBMINOR == 0
#define METIS_MARGIN 1.0
#endif
#endif
#ifndef METIS_MARGIN
#define METIS_MARGIN 1.06
#endif

/* Squares with one diagonal each: the shorter one, after every vertex has moved by up to `jitter`
 * along both axes. With jitter 0 all diagonals have one direction. */
static void edges_triangulated(gen_list_t *t, sl_int side, double jitter, uint64_t *state) {
    double *x = test_reals(2 * (size_t)t->n);
    gen_edges_grid(t, side, side, 1, state);
    for (sl_int v = 0; v < t->n; v++) {
        x[2 * v] = v % side + jitter * gen_real(state);
        x[2 * v + 1] = (double)(v / side) + jitter * gen_real(state);
    }
    for (sl_int j = 1; j < side; j++) {
        for (sl_int i = 1; i < side; i++) {
            const sl_int d = i + side * j, c = d - 1, b = d - side, a = b - 1;
            const double ad = hypot(x[2 * a] - x[2 * d], x[2 * a + 1] - x[2 * d + 1]);
            const double bc = hypot(x[2 * b] - x[2 * c], x[2 * b + 1] - x[2 * c + 1]);
            if (jitter == 0 || ad < bc) {
                gen_add(t, d, a, 1.0);
            } else {
                gen_add(t, c, b, 1.0);
            }
        }
    }
    free(x);
}

typedef enum grid_t { FIVE_POINT, TRIANGULATED, JITTERED, VOLUME, GRIDS } grid_t;

static gen_list_t grid(grid_t kind, sl_int side) {
    gen_list_t t = gen_list(kind == VOLUME ? side * side * side : side * side);
    uint64_t state = 3;
    if (kind == FIVE_POINT || kind == VOLUME) {
        gen_edges_grid(&t, side, side, kind == VOLUME ? side : 1, &state);
    } else {
        edges_triangulated(&t, side, kind == JITTERED ? 0.4 : 0.0, &state);
    }
    for (sl_int k = 0; k < t.n; k++) {
        gen_add(&t, k, k, 1.0);
    }
    return t;
}

/* Adds what the default ordering and METIS's cost on one matrix. */
static void add_both(const sl_csc *A, order_quality *ours, order_quality *metis) {
    sl_options opt = options_none();
    order_quality q = order_quality_of(A, &opt);
    ours->fill += q.fill;
    ours->path += q.path;
    opt.ordering = SL_ORDERING_METIS;
    q = order_quality_of(A, &opt);
    metis->fill += q.fill;
    metis->path += q.path;
}

/* The pattern of a lower triangle with its rows renamed at random. */
static gen_matrix_t renamed(const sl_csc *A, uint64_t seed) {
    gen_list_t t = gen_list(A->n_cols);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            gen_add(&t, A->i[p], j, 1.0);
        }
    }
    gen_rename(&t, seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* The same, for the rows under NAMES names: which straits of an archipelago are cut makes paths
 * scatter by 15 %. */
static void add_renamed(const sl_csc *A, order_quality *ours, order_quality *metis) {
    add_both(A, ours, metis);
    for (uint64_t seed = 1; seed < NAMES; seed++) {
        gen_matrix_t M = renamed(A, seed);
        add_both(&M.view, ours, metis);
        gen_matrix_free(&M);
    }
}

/* Prints two ratios and returns whether one exceeds its limit. */
static int is_worse(const char *name, order_quality a, order_quality b, double fill, double path) {
    const int worse = a.fill > fill * b.fill || a.path > path * b.path;
    print_message("%-13s %.4f times the entries of L, %.4f times the path weight%s\n", name,
                  a.fill / b.fill, a.path / b.path, worse ? ": too much" : "");
    return worse;
}

/* The same against METIS, whichever is installed. */
static int is_worse_than_metis(const char *name, order_quality ours, order_quality metis,
                               double fill, double path) {
    return is_worse(name, ours, metis, METIS_MARGIN * fill, METIS_MARGIN * path);
}

/* Entries of L and path weight by the default ordering relative to METIS, summed over three sizes
 * so that a single lucky separator does not decide. The numbers are the limit of the fill and, in
 * parentheses, what was measured: with minimum vertex separators in bands; with bands of no layers,
 * only the borders; with all border vertices of one side as separators. Two of the grids fail
 * without the bands.
 *
 *    five-point    1.13 (1.10, 1.17, 1.30): without diagonals METIS finds better separators
 *    triangulated  1.06 (1.03, 1.05, 1.17)
 *    jittered      1.06 (1.04, 1.08, 1.28)
 *    volume        1.06 (0.83, 0.84, 0.93)
 */
static void fill_is_near_that_of_metis(void **state) {
    (void)state;
    static const struct {
        const char *name;
        sl_int side[SIZES];
        double fill, path;
    } grids[GRIDS] = {{"five-point", {140, 150, 170}, 1.13, 1.13},
                      {"triangulated", {140, 150, 170}, 1.06, 1.06},
                      {"jittered", {140, 150, 170}, 1.06, 1.06},
                      {"volume", {18, 20, 22}, 1.06, 1.06}};
    int failures = 0;
    if (!ordering_is_present(SL_ORDERING_METIS)) {
        TEST_SKIP("built without METIS");
    }
    for (int kind = 0; kind < GRIDS; kind++) {
        order_quality ours = {0, 0}, metis = {0, 0};
        for (int size = 0; size < SIZES; size++) {
            gen_list_t t = grid((grid_t)kind, grids[kind].side[size]);
            gen_matrix_t M = gen_store(&t, gen_style(0), 1);
            add_both(&M.view, &ours, &metis);
            gen_matrix_free(&M);
            gen_list_free(&t);
        }
        failures +=
            is_worse_than_metis(grids[kind].name, ours, metis, grids[kind].fill, grids[kind].path);
    }
    assert_int_equal(failures, 0);
}

static const struct {
    const char *name;
    ordering_mesh kind;
    double path; /* limit of the path weight; one seed of METIS scatters by 3 to 6 % */
} meshes[] = {{"jittered", MESH_JITTERED, 1.06}, {"archipelago", MESH_ARCHIPELAGO, 1.10},
              {"spiral", MESH_SPIRAL, 1.08},     {"comb", MESH_COMB, 1.06},
              {"torus", MESH_TORUS, 1.08},       {"scroll", MESH_SCROLL, 1.06}};

enum { MESHES = sizeof meshes / sizeof *meshes };

/* Measured: fill 0.95 to 1.06, path weight 1.00 to 1.06. */
static void meshes_are_near_metis(void **state) {
    (void)state;
    static const sl_int sides[SIZES] = {130, 150, 170};
    int failures = 0;
    if (!ordering_is_present(SL_ORDERING_METIS)) {
        TEST_SKIP("built without METIS");
    }
    for (int m = 1; m < MESHES; m++) {
        order_quality ours = {0, 0}, metis = {0, 0};
        for (int size = 0; size < SIZES; size++) {
            double *xyz;
            gen_matrix_t M = mesh_pattern(meshes[m].kind, sides[size], &xyz);
            add_renamed(&M.view, &ours, &metis);
            gen_matrix_free(&M);
            free(xyz);
        }
        failures += is_worse_than_metis(meshes[m].name, ours, metis, 1.06, meshes[m].path);
    }
    assert_int_equal(failures, 0);
}

/* A box of cubes. Joins those that differ by one step along up to `axes` axes; falling: also if
 * the steps have opposite signs. Three axes without that are the edges of six tetrahedra in each
 * cube. */
static gen_matrix_t box(sl_int side, sl_int height, sl_int axes, int falling) {
    gen_list_t t = gen_list(side * side * height);
    for (sl_int v = 0; v < t.n; v++) {
        for (sl_int way = 0; way < 27; way++) {
            const sl_int dx = way % 3 - 1, dy = way / 3 % 3 - 1, dz = way / 9 - 1;
            const sl_int x = v % side + dx, y = v / side % side + dy, z = v / side / side + dz;
            const sl_int u = x + side * (y + side * z), steps = abs(dx) + abs(dy) + abs(dz);
            if (x >= 0 && x < side && y >= 0 && y < side && z >= 0 && z < height && u <= v &&
                steps <= axes && (falling || abs(dx + dy + dz) == steps)) {
                gen_add(&t, v, u, 1.0);
            }
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* Volumes of more than 10 neighbors a vertex, and plates of few layers. Measured: fill 0.94 to
 * 1.05, path weight 0.94 to 1.08. With the levels and bands of surfaces, tetrahedra had fill up to
 * 1.25 and path weight up to 1.58, and 27-point grids 1.29 and 1.86; without level sets, plates up
 * to 1.23 and 1.13. */
static void volumes_are_near_metis(void **state) {
    (void)state;
    static const struct {
        const char *name;
        sl_int side[SIZES], height[SIZES], axes;
        int falling;
        double path;
    } boxes[] = {{"tetrahedra", {20, 24, 28}, {20, 24, 28}, 3, 0, 1.06},
                 {"27-point", {20, 25, 30}, {20, 25, 30}, 3, 1, 1.12},
                 {"plates", {60, 60, 50}, {2, 3, 8}, 1, 1, 1.06}};
    int failures = 0;
    if (!ordering_is_present(SL_ORDERING_METIS)) {
        TEST_SKIP("built without METIS");
    }
    for (size_t k = 0; k < sizeof boxes / sizeof *boxes; k++) {
        order_quality ours = {0, 0}, metis = {0, 0};
        for (int size = 0; size < SIZES; size++) {
            gen_matrix_t M =
                box(boxes[k].side[size], boxes[k].height[size], boxes[k].axes, boxes[k].falling);
            add_renamed(&M.view, &ours, &metis);
            gen_matrix_free(&M);
        }
        failures += is_worse_than_metis(boxes[k].name, ours, metis, 1.06, boxes[k].path);
    }
    assert_int_equal(failures, 0);
}

/* Divides the polygon of vertices first .. first + count-1 into fans of up to `most` edges, most of
 * them of a few. */
static void edges_fans(gen_list_t *t, sl_int first, sl_int count, sl_int most, uint64_t *state) {
    sl_int *outline = test_ints((size_t)count);
    for (sl_int v = 0; v < count; v++) {
        outline[v] = first + v;
    }
    while (count > 3) {
        const double share = 0.5 + 0.5 * gen_real(state);
        const sl_int wanted = 2 + (sl_int)(most * pow(share, 6));
        const sl_int edges = wanted < count - 1 ? wanted : count - 1;
        const sl_int apex = gen_below(state, count - edges);
        for (sl_int k = apex + 2; k <= apex + edges; k++) {
            gen_add(t, outline[k], outline[apex], 1.0);
        }
        memmove(outline + apex + 1, outline + apex + edges,
                (size_t)(count - apex - edges) * sizeof *outline);
        count -= edges - 1;
    }
    free(outline);
}

/* An outline, extruded to some rings, with both ends capped by fans, as CAD programs write it. */
static gen_matrix_t extrusion(sl_int around, sl_int rings, sl_int most) {
    gen_list_t t = gen_list(around * rings);
    uint64_t state = 19;
    for (sl_int v = 0; v < t.n; v++) {
        const sl_int next = v / around * around + (v + 1) % around;
        gen_add(&t, v, v, 1.0);
        gen_add(&t, v > next ? v : next, v > next ? next : v, 1.0);
        if (v + around < t.n) {
            gen_add(&t, v + around, v, 1.0);
            gen_add(&t, next + around, v, 1.0);
        }
    }
    edges_fans(&t, 0, around, most, &state);
    edges_fans(&t, t.n - around, around, most, &state);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* A separator takes the apex of a fan and with it all edges of the fan. Measured: path weight 1.16
 * with six rings; 0.92 in prisms, where most of a path is within a leaf. If the edges of an apex
 * count as others and leaves are not bisected again, single parts have up to 2.8 and 1.6. */
static void fans_are_cut_at_their_apexes(void **state) {
    (void)state;
    static const struct {
        const char *name;
        sl_int around[SIZES], rings;
    } parts[] = {{"fans", {3000, 4000, 5000}, 6}, {"prisms", {2000, 5000, 9000}, 2}};
    int failures = 0;
    if (!ordering_is_present(SL_ORDERING_METIS)) {
        skip();
    }
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
        order_quality ours = {0, 0}, metis = {0, 0};
        for (int size = 0; size < SIZES; size++) {
            gen_matrix_t M = extrusion(parts[k].around[size], parts[k].rings, 500);
            add_renamed(&M.view, &ours, &metis);
            gen_matrix_free(&M);
        }
        failures += is_worse_than_metis(parts[k].name, ours, metis, 1.03, 1.2);
    }
    assert_int_equal(failures, 0);
}

/* Biharmonic and triharmonic systems: their wide graphs are coarsened by neighborhoods. Measured:
 * fill 0.89 to 1.03, path weight 0.97 to 1.07. With pairs of vertices, bands of several layers and
 * level sets, as in other graphs: fill up to 1.07, path weight up to 1.13. */
static void rings_are_near_metis(void **state) {
    (void)state;
    static const sl_int sides[SIZES] = {60, 80, 100};
    int failures = 0;
    if (!ordering_is_present(SL_ORDERING_METIS)) {
        TEST_SKIP("built without METIS");
    }
    for (int m = 1; m < MESHES; m++) {
        for (int k = 2; k <= 3; k++) {
            order_quality ours = {0, 0}, metis = {0, 0};
            for (int size = 0; size < SIZES; size++) {
                double *xyz;
                gen_matrix_t M = mesh_pattern(meshes[m].kind, sides[size], &xyz);
                gen_matrix_t rings = mesh_rings(&M.view, k);
                add_renamed(&rings.view, &ours, &metis);
                gen_matrix_free(&rings);
                gen_matrix_free(&M);
                free(xyz);
            }
            failures += is_worse_than_metis(meshes[m].name, ours, metis, 1.06, 1.09);
        }
    }
    assert_int_equal(failures, 0);
}

/* A chain of blocks of 12 equal rows, and three rows that know one block each, so numbered that no
 * pair of vertices of the compressed graph is light enough to become one: dissection has to do
 * without coarser levels. Minimum degree has no fill. */
static void blocks_that_cannot_be_paired_are_dissected(void **state) {
    (void)state;
    enum { BLOCKS = 80, ROWS = 12, SLOT = ROWS + 3, N = BLOCKS * SLOT };
    gen_list_t t = gen_list(N);
    for (sl_int s = 0; s < BLOCKS; s++) { /* a row of the next block, 12, their own, of the last */
        const sl_int first = s * SLOT, up = s + 1 < BLOCKS ? first + SLOT : first;
        const sl_int before = s > 0 ? first - SLOT : first;
        for (sl_int k = first; k < first + SLOT; k++) {
            gen_add(&t, k, k, 1.0);
        }
        for (sl_int k = 1; k <= ROWS; k++) {
            for (sl_int m = 1; m <= ROWS; m++) {
                if (m < k) {
                    gen_add(&t, first + k, first + m, 1.0);
                }
                if (s > 0) {
                    gen_add(&t, first + k, before + m, 1.0);
                }
            }
            gen_add(&t, up + k, first, 1.0);
            gen_add(&t, first + ROWS + 1, first + k, 1.0);
            gen_add(&t, first + ROWS + 2, before + k, 1.0);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_options opt = options_none();
    order_quality mindeg;
    const order_quality ours = order_quality_of(&M.view, &opt);
    opt.ordering = SL_ORDERING_MINDEG;
    mindeg = order_quality_of(&M.view, &opt);
    print_message("%.3f times the entries, %.3f times the path weight\n", ours.fill / mindeg.fill,
                  ours.path / mindeg.path);
    assert_true(ours.fill <= 1.5 * mindeg.fill && ours.path <= 0.5 * mindeg.path);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fill_is_near_that_of_metis),
        cmocka_unit_test(meshes_are_near_metis),
        cmocka_unit_test(rings_are_near_metis),
        cmocka_unit_test(volumes_are_near_metis),
        cmocka_unit_test(fans_are_cut_at_their_apexes),
        cmocka_unit_test(blocks_that_cannot_be_paired_are_dissected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
