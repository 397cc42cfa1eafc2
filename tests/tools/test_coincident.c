/* test_coincident.c: vertices at the same place are counted and merged */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/bad_meshes.h"

#include "tools/mesh/coincident.h"
#include "tools/mesh/mesh_stats.h"
#include "tools/mesh/surface_generator.h"

/* Each face of a surface with vertices of its own, moved by up to `shift` in each coordinate. */
static mesh soup_of(const char *surface, double shift) {
    mesh m, out;
    assert_true(surface_generate(&m, surface, NULL, 0));
    out = bad_mesh_allocate(3 * m.n_faces, m.n_faces);
    for (sl_int k = 0; k < 3 * m.n_faces; k++) {
        out.faces[k] = k;
        for (int d = 0; d < 3; d++) {
            out.xyz[3 * k + d] = m.xyz[3 * m.faces[k] + d] + (k * 7 % 3 - 1) * shift;
        }
    }
    mesh_free(&m);
    return out;
}

static void soups_are_joined(void **state) {
    (void)state;
    static const double shifts[2] = {0, 1e-7};
    for (int k = 0; k < 2; k++) {
        mesh m = soup_of("torus:30x20", shifts[k]);
        coincident_merged merged;
        mesh_stats s;
        assert_int_equal(m.n_vertices, 3600);
        assert_true(k == 1 || coincident_count(&m) == 3000);
        assert_true(coincident_merge(&m, &merged, NULL, 4 * shifts[k]));
        assert_true(m.n_vertices == 600 && m.n_faces == 1200);
        assert_true(merged.vertices == 3000 && merged.faces == 0);
        assert_true(mesh_stats_compute(&s, &m));
        assert_true(s.components == 1 && s.boundary_edges == 0 && s.euler == 0);
        assert_int_equal(coincident_count(&m), 0);
        mesh_free(&m);
    }
}

/* The first vertex of each place stays where it is; zeros are equal whatever their sign; vertices
 * without faces are merged, but not counted. */
static void first_vertices_are_kept(void **state) {
    (void)state;
    const double xyz[18] = {5, 5, 5, 0, 0, 0, 1, 0, 0, -0.0, 0, -0.0, 0, 1, 0, 1, 0, 0};
    const double expected[12] = {5, 5, 5, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    const sl_int faces[9] = {1, 2, 4, 3, 5, 4, 1, 3, 4}, joined[6] = {1, 2, 3, 1, 2, 3};
    mesh m = bad_mesh_allocate(6, 3);
    coincident_merged merged;
    memcpy(m.xyz, xyz, sizeof xyz);
    memcpy(m.faces, faces, sizeof faces);
    assert_int_equal(coincident_count(&m), 2);
    m.n_faces = 1;
    assert_int_equal(coincident_count(&m), 0);
    m.n_faces = 3;
    assert_true(coincident_merge(&m, &merged, NULL, 0));
    assert_true(m.n_vertices == 4 && m.n_faces == 2);
    assert_true(merged.vertices == 2 && merged.faces == 1);
    SAME_VALUES(m.xyz, expected, 12);
    assert_memory_equal(m.faces, joined, sizeof joined);
    /* a face that repeats a vertex already stays; a tolerance beyond the mesh leaves one vertex */
    m.faces[0] = 2;
    assert_true(coincident_merge(&m, NULL, NULL, 100));
    assert_true(m.n_vertices == 1 && m.n_faces == 0);
    mesh_free(&m);
    mesh none = bad_mesh_allocate(0, 0);
    assert_true(coincident_count(&none) == 0 && coincident_merge(&none, &merged, NULL, 1));
    assert_true(merged.vertices == 0 && merged.faces == 0);
    mesh_free(&none);
}

/* No two vertices that are kept are within the tolerance, and each is that near to one. */
static void tolerances_are_kept(void **state) {
    (void)state;
    mesh m = soup_of("blob:2", 0.01), before = soup_of("blob:2", 0.01);
    assert_true(coincident_merge(&m, NULL, NULL, 0.1));
    assert_true(m.n_vertices > 10 && m.n_vertices < before.n_vertices);
    for (sl_int v = 0; v < before.n_vertices; v++) {
        double least = HUGE_VAL;
        for (sl_int u = 0; u < m.n_vertices; u++) {
            const double *x = m.xyz + 3 * u, *y = before.xyz + 3 * v;
            const double away = sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) +
                                     (x[2] - y[2]) * (x[2] - y[2]));
            least = away < least ? away : least;
        }
        assert_true(least <= 0.1);
    }
    coincident_merged again;
    assert_true(coincident_merge(&m, &again, NULL, 0.1));
    assert_int_equal(again.vertices, 0);
    mesh_free(&before);
    mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soups_are_joined),
        cmocka_unit_test(first_vertices_are_kept),
        cmocka_unit_test(tolerances_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
