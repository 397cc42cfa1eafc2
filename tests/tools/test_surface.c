/* test_surface.c: generated surfaces have the stated topology and area; mesh statistics */
#include "tests/lib/test.h"

#include "tools/mesh/mesh_stats.h"
#include "tools/mesh/surface_generator.h"

static mesh_stats facts_of(const char *text, sl_int vertices, sl_int faces) {
    mesh m;
    mesh_stats f;
    char message[200] = "";
    if (!surface_generate(&m, text, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    assert_int_equal(m.n_vertices, vertices);
    assert_int_equal(m.n_faces, faces);
    assert_true(mesh_stats_compute(&f, &m));
    assert_true(f.used_vertices == vertices && f.components == 1 && f.nonmanifold_edges == 0 &&
                f.nonmanifold_vertices == 0 && f.inconsistent_edges == 0 &&
                f.repeated_vertex_faces == 0 && f.zero_area_faces == 0);
    mesh_free(&m);
    return f;
}

/* The volume enclosed by the surface, positive if its faces look outward. */
static double volume_of(const char *text) {
    mesh m;
    double sum = 0;
    assert_true(surface_generate(&m, text, NULL, 0));
    for (sl_int k = 0; k < m.n_faces; k++) {
        const double *a = m.xyz + 3 * m.faces[3 * k], *b = m.xyz + 3 * m.faces[3 * k + 1],
                     *c = m.xyz + 3 * m.faces[3 * k + 2];
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    mesh_free(&m);
    return sum / 6;
}

static const double pi = 3.14159265358979323846;

static void closed_surfaces_have_the_known_facts(void **state) {
    (void)state;
    for (sl_int k = 0, quads = 1; k < 6; k++, quads *= 4) {
        static const char *const names[3] = {"sphere", "blob", "star"};
        for (int s = 0; s < 3; s++) {
            char text[32];
            (void)snprintf(text, sizeof text, "%s:%d", names[s], (int)k);
            mesh_stats f = facts_of(text, 10 * quads + 2, 20 * quads);
            assert_true(f.euler == 2 && f.boundary_edges == 0 && volume_of(text) > 0);
        }
    }
    /* An inscribed polyhedron: its area and volume are off by O(h^2), where h^2 = 0.0014. */
    mesh_stats f = facts_of("sphere:5", 10242, 20480);
    assert_true(fabs(f.area - 4 * pi) < 4 * pi * 0.0014);
    assert_true(fabs(volume_of("sphere:5") - 4 * pi / 3) < 4 * pi / 3 * 0.0014);
    assert_true(f.angle_min > 50 && f.angle_max < 75);
    f = facts_of("torus:90x40", 3600, 7200);
    assert_true(f.euler == 0 && f.boundary_edges == 0);
    assert_true(fabs(f.area - 4 * pi * pi * 0.35) < 0.01 * f.area);
    assert_true(fabs(volume_of("torus:90x40") - 2 * pi * pi * 0.35 * 0.35) < 0.02);
    f = facts_of("knot:300x20", 6000, 12000);
    assert_true(f.euler == 0 && f.boundary_edges == 0 && volume_of("knot:300x20") > 0);
    f = facts_of("torus:3x3", 9, 18);
    assert_int_equal(f.euler, 0);
}

static void open_surfaces_have_the_known_facts(void **state) {
    (void)state;
    mesh_stats f = facts_of("grid:7x5", 35, 48);
    assert_true(f.boundary_edges == 20 && f.boundary_loops == 1 && f.euler == 1);
    assert_true(fabs(f.area - 4.0 / 6) < 1e-14);
    f = facts_of("hills:30x40", 1200, 2 * 29 * 39);
    assert_true(f.boundary_loops == 1 && f.euler == 1 && f.box_max[2] > f.box_min[2]);
}

static void bad_names_are_refused(void **state) {
    (void)state;
    static const char *const bad[] = {"cube:3",
                                      "sphere:",
                                      "sphere:x",
                                      "sphere:-1",
                                      "sphere:11",
                                      "sphere:3x3",
                                      "grid:5",
                                      "grid:5x",
                                      "grid:0x5",
                                      "grid:5x5x5",
                                      "torus:2x9",
                                      "knot:9x2",
                                      "torus:-4x9",
                                      "sphere:99999999999",
                                      "grid:999999999x999999999",
                                      "torus:60000x60000",
                                      ""};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        mesh m;
        char message[200] = "";
        assert_false(surface_generate(&m, bad[k], message, sizeof message));
        assert_true(m.xyz == NULL && m.faces == NULL && m.n_vertices == 0);
        assert_true(strncmp(message, bad[k], strlen(bad[k])) == 0 && strstr(message, ": ") != NULL);
    }
    assert_true(surface_is_specification("grid:") && !surface_is_specification("grid.obj") &&
                !surface_is_specification("./grid:5x5"));
}

static void faults_are_counted(void **state) {
    (void)state;
    /* Three faces at edge 0-1; a face turned over; one with a vertex twice; two without area;
     * vertex 9 unused. */
    double xyz[30] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0,
                      1, 5, 0, 0, 6, 0, 0, 7, 0, 0, 5,  1, 0};
    sl_int faces[21] = {0, 1, 2, 1, 0, 3, 0, 1, 4, 5, 6, 8, 5, 6, 7, 5, 5, 6, 2, 0, 3};
    mesh m = {10, 7, xyz, faces};
    mesh_stats f;
    assert_true(mesh_stats_compute(&f, &m));
    assert_int_equal(f.used_vertices, 9);
    assert_int_equal(f.components, 2);
    /* Edge 0-1, and edge 5-6, which occurs once more as side 6-5 of the face with vertex 5
     * twice. */
    assert_int_equal(f.nonmanifold_edges, 2);
    assert_int_equal(f.inconsistent_edges, 2);
    assert_int_equal(f.repeated_vertex_faces, 1);
    assert_int_equal(f.zero_area_faces, 2);
    assert_int_equal(f.edges, 13);
    assert_true(f.angle_min > 44.9 && f.angle_max > 89.9 && fabs(f.area - 2) < 1e-14);
    sl_int turned[6] = {0, 1, 2, 0, 1, 3};
    mesh two = {4, 2, xyz, turned};
    assert_true(mesh_stats_compute(&f, &two));
    assert_int_equal(f.inconsistent_edges, 1);
    assert_int_equal(f.boundary_edges, 4);
    /* Two triangles that share a vertex: a pinch. Their borders touch there and are one loop. */
    sl_int bow[6] = {0, 1, 2, 0, 3, 4};
    mesh tie = {5, 2, xyz, bow};
    assert_true(mesh_stats_compute(&f, &tie));
    assert_true(f.nonmanifold_vertices == 1 && f.components == 1 && f.boundary_loops == 1);
    mesh none = {0, 0, NULL, NULL};
    assert_true(mesh_stats_compute(&f, &none));
    assert_true(f.edges == 0 && f.components == 0 && f.angle_min != f.angle_min);
    faces[0] = 10;
    assert_false(mesh_stats_compute(&f, &m));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_surfaces_have_the_known_facts),
        cmocka_unit_test(open_surfaces_have_the_known_facts),
        cmocka_unit_test(bad_names_are_refused),
        cmocka_unit_test(faults_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
