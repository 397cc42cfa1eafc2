/* test_surface.c: made-up surfaces are what they say; facts of meshes, sound ones and faulty ones */
#include "test.h"

#include "../tools/mesh_facts.h"
#include "../tools/surface.h"

static mesh_facts facts_of(const char *text, sl_int vertices, sl_int faces) {
    mesh m;
    mesh_facts f;
    char message[200] = "";
    if (!surface_make(&m, text, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    assert_int_equal(m.n_vertices, vertices);
    assert_int_equal(m.n_faces, faces);
    assert_true(mesh_facts_find(&f, &m));
    assert_true(f.used == vertices && f.components == 1 && f.fan_edges == 0 && f.pinched == 0 &&
                f.twisted_edges == 0 && f.repeated == 0 && f.flat == 0);
    mesh_free(&m);
    return f;
}

/* Sum over the faces of six times the volume between them and the origin: positive if they look outwards. */
static double volume(const char *text) {
    mesh m;
    double sum = 0;
    assert_true(surface_make(&m, text, NULL, 0));
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

static void closed_surfaces(void **state) {
    (void)state;
    for (sl_int k = 0, quads = 1; k < 6; k++, quads *= 4) {
        static const char *const names[3] = {"sphere", "blob", "star"};
        for (int s = 0; s < 3; s++) {
            char text[32];
            (void)snprintf(text, sizeof text, "%s:%d", names[s], (int)k);
            mesh_facts f = facts_of(text, 10 * quads + 2, 20 * quads);
            assert_true(f.euler == 2 && f.border_edges == 0 && volume(text) > 0);
        }
    }
    /* the inscribed polyhedron: its area and volume are off by O(h^2), h^2 = 0.0014 */
    mesh_facts f = facts_of("sphere:5", 10242, 20480);
    assert_true(fabs(f.area - 4 * pi) < 4 * pi * 0.0014);
    assert_true(fabs(volume("sphere:5") - 4 * pi / 3) < 4 * pi / 3 * 0.0014);
    assert_true(f.angle_smallest > 50 && f.angle_largest < 75);
    f = facts_of("torus:90x40", 3600, 7200);
    assert_true(f.euler == 0 && f.border_edges == 0);
    assert_true(fabs(f.area - 4 * pi * pi * 0.35) < 0.01 * f.area);
    assert_true(fabs(volume("torus:90x40") - 2 * pi * pi * 0.35 * 0.35) < 0.02);
    f = facts_of("knot:300x20", 6000, 12000);
    assert_true(f.euler == 0 && f.border_edges == 0 && volume("knot:300x20") > 0);
    f = facts_of("torus:3x3", 9, 18);
    assert_int_equal(f.euler, 0);
}

static void open_surfaces(void **state) {
    (void)state;
    mesh_facts f = facts_of("grid:7x5", 35, 48);
    assert_true(f.border_edges == 20 && f.border_loops == 1 && f.euler == 1);
    assert_true(fabs(f.area - 4.0 / 6) < 1e-14);
    f = facts_of("hills:30x40", 1200, 2 * 29 * 39);
    assert_true(f.border_loops == 1 && f.euler == 1 && f.high[2] > f.low[2]);
}

static void refusals(void **state) {
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
        assert_false(surface_make(&m, bad[k], message, sizeof message));
        assert_true(m.xyz == NULL && m.faces == NULL && m.n_vertices == 0);
        assert_true(strncmp(message, bad[k], strlen(bad[k])) == 0 && strstr(message, ": ") != NULL);
    }
    assert_true(surface_is_named("grid:") && !surface_is_named("grid.obj") &&
                !surface_is_named("./grid:5x5"));
}

static void faults_are_counted(void **state) {
    (void)state;
    /* three faces on edge 0-1; a face turned over; one with a vertex twice; two without area; vertex 9 unused */
    double xyz[30] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0,
                      1, 5, 0, 0, 6, 0, 0, 7, 0, 0, 5,  1, 0};
    sl_int faces[21] = {0, 1, 2, 1, 0, 3, 0, 1, 4, 5, 6, 8, 5, 6, 7, 5, 5, 6, 2, 0, 3};
    mesh m = {10, 7, xyz, faces};
    mesh_facts f;
    assert_true(mesh_facts_find(&f, &m));
    assert_int_equal(f.used, 9);
    assert_int_equal(f.components, 2);
    assert_int_equal(f.fan_edges,
                     2); /* 0-1; and 5-6, once from the face with 5 twice: its side 6-5 */
    assert_int_equal(f.twisted_edges, 2);
    assert_int_equal(f.repeated, 1);
    assert_int_equal(f.flat, 2);
    assert_int_equal(f.edges, 13);
    assert_true(f.angle_smallest > 44.9 && f.angle_largest > 89.9 && fabs(f.area - 2) < 1e-14);
    sl_int turned[6] = {0, 1, 2, 0, 1, 3};
    mesh two = {4, 2, xyz, turned};
    assert_true(mesh_facts_find(&f, &two));
    assert_int_equal(f.twisted_edges, 1);
    assert_int_equal(f.border_edges, 4);
    /* two triangles that share a vertex: a pinch; the borders touch there and are one piece */
    sl_int bow[6] = {0, 1, 2, 0, 3, 4};
    mesh tie = {5, 2, xyz, bow};
    assert_true(mesh_facts_find(&f, &tie));
    assert_true(f.pinched == 1 && f.components == 1 && f.border_loops == 1);
    mesh none = {0, 0, NULL, NULL};
    assert_true(mesh_facts_find(&f, &none));
    assert_true(f.edges == 0 && f.components == 0 && f.angle_smallest != f.angle_smallest);
    faces[0] = 10;
    assert_false(mesh_facts_find(&f, &m));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_surfaces),
        cmocka_unit_test(open_surfaces),
        cmocka_unit_test(refusals),
        cmocka_unit_test(faults_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
