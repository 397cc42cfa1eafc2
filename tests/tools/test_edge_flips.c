/* test_edge_flips.c: random edge flips: neighbors, areas and the two faces of each flip */
#include "tests/lib/test.h"

#include "tools/mesh/edge_flips.h"
#include "tools/mesh/surface_generator.h"

static sl_int next_of(sl_int side) {
    return side % 3 == 2 ? side - 2 : side + 1;
}

/* Twins are mutual and run along the same edge in opposite directions. */
static void assert_is_glued(const edge_flips *a, sl_int n_open) {
    const sl_int *faces = a->m.faces;
    sl_int open = 0;
    for (sl_int s = 0; s < 3 * a->m.n_faces; s++) {
        const sl_int t = a->twin[s];
        open += t < 0;
        if (t >= 0) {
            assert_true(t != s && a->twin[t] == s);
            assert_true(faces[next_of(s)] == faces[next_of(next_of(t))] &&
                        faces[next_of(t)] == faces[next_of(next_of(s))]);
        }
    }
    assert_int_equal(open, n_open);
}

static double area_in_plane(const mesh *m) {
    double area = 0;
    for (sl_int f = 0; f < m->n_faces; f++) {
        const double *a = m->xyz + 3 * m->faces[3 * f], *b = m->xyz + 3 * m->faces[3 * f + 1],
                     *c = m->xyz + 3 * m->faces[3 * f + 2];
        const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        assert_true(twice > 0);
        area += 0.5 * twice;
    }
    return area;
}

static void flips_keep_a_triangulation(void **state) {
    (void)state;
    static const char *const surfaces[] = {"grid:9x8", "sphere:2", "hills:12x12"};
    static const sl_int open[] = {2 * (8 + 7), 0, 44};
    for (int k = 0; k < 3; k++) {
        mesh m;
        edge_flips a;
        uint64_t seed = 3;
        int flips = 0;
        assert_true(surface_generate(&m, surfaces[k], NULL, 0) && edge_flips_create(&a, &m));
        assert_is_glued(&a, open[k]);
        const double area = k == 0 ? area_in_plane(&a.m) : 0;
        for (int turn = 0; turn < 2000; turn++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            const sl_int side = (sl_int)((seed >> 33) % (uint64_t)(3 * m.n_faces));
            sl_int corners[4], pair[2], again[4];
            const bool may = edge_flips_corners(corners, &a, side);
            assert_true(!may || a.twin[side] >= 0);
            if (!may) {
                continue;
            }
            edge_flips_flip(pair, &a, side);
            assert_is_glued(&a, open[k]);
            /* the diagonal joins the opposite corners, and the faces are seen from its sides */
            for (int f = 0; f < 2; f++) {
                const sl_int *v = a.m.faces + 3 * pair[f];
                int found = 0;
                for (int c = 0; c < 3; c++) {
                    found += v[c] == corners[2] || v[c] == corners[3];
                    if (v[c] == corners[0] || v[c] == corners[1]) {
                        (void)edge_flips_corners(again, &a, 3 * pair[f] + c);
                        assert_true(again[2] == v[c] &&
                                    (again[3] == corners[0] || again[3] == corners[1]));
                    }
                }
                assert_int_equal(found, 2);
            }
            flips++;
            if (k == 0) {
                assert_true(fabs(area_in_plane(&a.m) - area) < 1e-12);
            }
        }
        assert_true(flips > 500);
        edge_flips_free(&a);
        mesh_free(&m);
    }
}

/* Edges with one face, with three, and with faces that disagree in orientation have no twins. */
static void other_edges_are_left_alone(void **state) {
    (void)state;
    static double xyz[18] = {0, 0, 0, 1, 0, 0, 0.4, 1, 0, 0.5, -1, 0, 0, 0, 1, 1, 1, 1};
    static sl_int faces[15] = {0, 1, 2, 1, 0, 3, 0, 1, 4, 1, 2, 5, 0, 0, 1};
    const mesh fan = {6, 3, xyz, faces}, twisted = {6, 1, xyz, faces + 9};
    sl_int corners[4];
    edge_flips a;
    assert_true(edge_flips_create(&a, &fan));
    for (sl_int s = 0; s < 9; s++) {
        assert_true(a.twin[s] < 0 && !edge_flips_corners(corners, &a, s));
    }
    edge_flips_free(&a);
    assert_true(edge_flips_create(&a, &twisted));
    edge_flips_free(&a);
    sl_int two[6] = {0, 1, 2, 0, 1, 3}; /* both run from 0 to 1 */
    const mesh same_way = {6, 2, xyz, two};
    assert_true(edge_flips_create(&a, &same_way));
    assert_int_equal(a.twin[2], -1);
    edge_flips_free(&a);
    two[3] = 1, two[4] = 0;
    assert_true(edge_flips_create(&a, &same_way));
    assert_int_equal(a.twin[2], 5);
    assert_true(edge_flips_corners(corners, &a, 2));
    edge_flips_free(&a);
    two[5] = 6;
    assert_false(edge_flips_create(&a, &same_way));
    assert_null(a.twin);
}

/* A quadrilateral that is not convex cannot be flipped, nor one with a corner on a diagonal. */
static void bad_quadrilaterals_are_not_flipped(void **state) {
    (void)state;
    double xyz[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 0, 0};
    sl_int faces[6] = {0, 1, 2, 1, 0, 3}, corners[4];
    const mesh m = {4, 2, xyz, faces};
    for (int k = -10; k <= 20; k++) { /* the fourth vertex below the edge, and beyond its ends */
        const double x = 0.1 * k, y = -0.5, at = 0.5 + (x - 0.5) / 1.5; /* crosses y = 0 there */
        edge_flips a;
        xyz[9] = x;
        xyz[10] = y;
        assert_true(edge_flips_create(&a, &m));
        if (fabs(at - 0.5) < 0.4 || fabs(at - 0.5) > 0.5 - 1e-9) {
            assert_int_equal(edge_flips_corners(corners, &a, 2), at > 0 && at < 1);
        }
        edge_flips_free(&a);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flips_keep_a_triangulation),
        cmocka_unit_test(other_edges_are_left_alone),
        cmocka_unit_test(bad_quadrilaterals_are_not_flipped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
