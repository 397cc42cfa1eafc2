/* test_insert_point.c: points of faces and edges become vertices, and the surface stays */
#include "tests/lib/test.h"

#include "tools/mesh/insert_point.h"
#include "tools/mesh/mesh_stats.h"
#include "tools/mesh/surface_generator.h"

static void surfaces_stay(void **state) {
    (void)state;
    static const double at[7][2] = {{0.2, 0.3}, {0, 0.4}, {0.4, 0},  {0.75, 0.25},
                                    {1, 0},     {0, 1},   {1e-12, 0}};
    static const int added[7][2] = {{1, 2}, {1, 2}, {1, 2}, {1, 2}, {0, 0}, {0, 0}, {0, 0}};
    for (int k = 0; k < 7; k++) {
        mesh m;
        mesh_stats before, after;
        sl_int vertex = -1;
        assert_true(surface_generate(&m, "blob:2", NULL, 0));
        assert_true(mesh_stats_compute(&before, &m));
        const sl_int n = m.n_vertices, f = m.n_faces, *c = m.faces + 3 * 17;
        const face_point p = {17, at[k][0], at[k][1]};
        double x[3];
        for (int d = 0; d < 3; d++) {
            x[d] = (1 - p.u - p.v) * m.xyz[3 * c[0] + d] + p.u * m.xyz[3 * c[1] + d] +
                   p.v * m.xyz[3 * c[2] + d];
        }
        /* the point itself and one above it are found again */
        const face_point found = nearest_face_point(&m, x);
        const sl_int *g = m.faces + 3 * found.face;
        double away = 0;
        for (int d = 0; d < 3; d++) {
            away += fabs((1 - found.u - found.v) * m.xyz[3 * g[0] + d] +
                         found.u * m.xyz[3 * g[1] + d] + found.v * m.xyz[3 * g[2] + d] - x[d]);
        }
        assert_true(away < 1e-12);
        assert_true(insert_face_point(&m, &p, &vertex));
        assert_true(m.n_vertices == n + added[k][0] && m.n_faces == f + added[k][1]);
        assert_true(k < 4 ? vertex == n : vertex < n);
        for (int d = 0; d < 3; d++) {
            assert_true(fabs(m.xyz[3 * vertex + d] - x[d]) < 1e-9);
        }
        assert_true(mesh_stats_compute(&after, &m));
        assert_true(after.boundary_edges == 0 && after.inconsistent_edges == 0);
        assert_true(after.nonmanifold_edges == 0 && after.euler == before.euler);
        assert_int_equal(after.used_vertices, m.n_vertices);
        assert_true(fabs(after.area - before.area) < 1e-12 * before.area);
        mesh_free(&m);
    }
}

/* Points beside a face are moved onto it: into it, to a side, to a corner. */
static void nearest_points_are_found(void **state) {
    (void)state;
    double xyz[12] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 4, 0, 0};
    sl_int faces[6] = {0, 1, 2, 0, 1, 3}; /* the second has no area */
    const mesh m = {4, 2, xyz, faces}, none = {4, 0, xyz, faces};
    static const double cases[5][5] = {{0.5, 1, 7, 0.25, 0.5},
                                       {1, -3, 1, 0.5, 0},
                                       {2, 2, 0, 0.5, 0.5},
                                       {-1, 9, 0, 0, 1},
                                       {-1, -1, -1, 0, 0}};
    for (int k = 0; k < 5; k++) {
        const face_point p = nearest_face_point(&m, cases[k]);
        assert_int_equal(p.face, 0);
        assert_true(fabs(p.u - cases[k][3]) < 1e-15 && fabs(p.v - cases[k][4]) < 1e-15);
    }
    const double beyond[3] = {5, 1, 0};
    const face_point p = nearest_face_point(&m, beyond);
    assert_true(p.face == 1 && p.u == 0 && p.v == 1);
    assert_int_equal(nearest_face_point(&none, beyond).face, -1);
}

static void points_outside_are_refused(void **state) {
    (void)state;
    mesh m;
    sl_int vertex;
    assert_true(surface_generate(&m, "sphere:1", NULL, 0));
    const face_point bad[6] = {{-1, 0.2, 0.2}, {80, 0.2, 0.2}, {0, -0.1, 0.5},
                               {0, 0.5, -0.1}, {0, 0.6, 0.5},  {0, NAN, 0.5}};
    for (int k = 0; k < 6; k++) {
        assert_false(insert_face_point(&m, &bad[k], &vertex));
        assert_true(m.n_vertices == 42 && m.n_faces == 80);
    }
    mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_stay),
        cmocka_unit_test(nearest_points_are_found),
        cmocka_unit_test(points_outside_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
