/* test_vtk_grid.c: unstructured grids of VTK: faces, the surface of solids, refusals */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

#include "tools/mesh/mesh_stats.h"

#define GRID_START "# vtk DataFile Version 2.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\n"
#define GRID_CUBE \
    GRID_START "POINTS 9 float\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n.5 .5 " \
               ".5\n"
#define GRID_PYRAMID GRID_START "POINTS 5 float\n" OFF_VERTICES

/* Reads a file whose note contains `words`, "" if there is none. */
static mesh read_noting(const char *text, const char *words) {
    mesh m;
    char message[300], note[300];
    const char *path = files_put_text("g.vtk", text);
    if (!mesh_read_noting(&m, path, message, sizeof message, note, sizeof note)) {
        print_error("%s\n", message);
        fail();
    }
    if (words[0] == '\0' ? note[0] != '\0' : strstr(note, words) == NULL) {
        print_error("%s\n    lacks: %s\n", note, words);
        fail();
    }
    return m;
}

static void faces_are_read(void **state) {
    (void)state;
    mesh m = read_noting(GRID_PYRAMID "CELLS 6 23\n" OFF_FACES "1 0\n"
                                      "CELL_TYPES 6\n9 5 5 5 5 1\nPOINT_DATA 5\n",
                         "1 cells are points or lines");
    assert_memory_equal(m.faces, pyramid_faces, sizeof pyramid_faces);
    mesh_free(&m);
    assert_is_pyramid(
        files_put_text(/* version 5, a polygon and a strip */
                       "g.vtk",
                       "# vtk DataFile Version 5.1\na\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                       "POINTS 5 float\n" OFF_VERTICES "CELLS 6 16\nOFFSETS vtktypeint64\n0 4 7 10 "
                       "13 16\nCONNECTIVITY vtktypeint64\n"
                       "0 3 2 1 0 1 4 1 2 4 2 3 4 3 0 4\nCELL_TYPES 5\n7 6 5 5 5\n"));
    /* a pixel lists its second pair of corners in the other order */
    assert_is_pyramid(files_put_text("g.vtk",
                                     GRID_PYRAMID "CELLS 5 21\n4 0 3 1 2\n3 0 1 4\n"
                                                  "3 1 2 4\n3 2 3 4\n3 3 0 4\nCELL_TYPES 5\n"
                                                  "8 5 5 5 5\n"));
    m = read_noting(GRID_START "POINTS 0 float\n", "");
    assert_true(m.n_vertices == 0 && m.n_faces == 0);
}

/* The surface is closed, its faces are consistent and turned outward, and have this area. */
static void assert_is_surface(mesh m, sl_int vertices, double area, double volume) {
    mesh_stats s;
    double sum = 0;
    assert_true(mesh_stats_compute(&s, &m));
    assert_true(s.boundary_edges == 0 && s.inconsistent_edges == 0 && s.nonmanifold_edges == 0);
    assert_int_equal(s.used_vertices, vertices);
    assert_true(fabs(s.area - area) < 1e-12);
    for (sl_int f = 0; f < m.n_faces; f++) {
        const double *a = m.xyz + 3 * m.faces[3 * f], *b = m.xyz + 3 * m.faces[3 * f + 1],
                     *c = m.xyz + 3 * m.faces[3 * f + 2];
        sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                a[2] * (b[0] * c[1] - b[1] * c[0])) /
               6;
    }
    assert_true(fabs(sum - volume) < 1e-12);
    mesh_free(&m);
}

static void surfaces_of_solids_are_read(void **state) {
    (void)state;
    const char *note = "solid cells is read";
    /* six pyramids around the center, which the surface does not use */
    assert_is_surface(read_noting(GRID_CUBE "CELLS 6 36\n5 0 1 2 3 8\n5 4 5 6 7 8\n5 0 1 5 4 8\n"
                                            "5 3 2 6 7 8\n5 0 3 7 4 8\n5 1 2 6 5 8\n"
                                            "CELL_TYPES 6\n14 14 14 14 14 14\n",
                                  "the surface of 6 solid cells is read"),
                      8, 6, 1);
    assert_is_surface(
        read_noting(GRID_CUBE "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n", note), 8, 6, 1);
    assert_is_surface(
        read_noting(GRID_CUBE "CELLS 1 9\n8 4 5 6 7 0 1 2 3\nCELL_TYPES 1\n12\n", note), 8, 6, 1);
    assert_is_surface(
        read_noting(GRID_CUBE "CELLS 1 9\n8 0 1 3 2 4 5 7 6\nCELL_TYPES 1\n11\n", note), 8, 6, 1);
    assert_is_surface(read_noting(GRID_CUBE "CELLS 2 14\n6 0 1 2 4 5 6\n6 0 2 3 4 6 7\n"
                                            "CELL_TYPES 2\n13 13\n",
                                  note),
                      8, 6, 1);
    /* two tetrahedra of opposite orientation, with the triangle between them and one of the
     * surface */
    assert_is_surface(read_noting(GRID_CUBE "CELLS 4 18\n4 0 1 3 4\n4 1 3 4 6\n3 1 3 4\n3 0 1 3\n"
                                            "CELL_TYPES 4\n10 10 5 5\n",
                                  note),
                      5, 1.5 + 1.5 * sqrt(3.0), 0.5);
    /* a triangle that is no face of the solid stays */
    mesh m = read_noting(GRID_CUBE "CELLS 2 9\n4 0 1 3 4\n3 1 2 6\nCELL_TYPES 2\n10 5\n", note);
    assert_int_equal(m.n_faces, 5);
    mesh_free(&m);
}

/* A file of solids, faces, lines and data says what is not read. */
static void mixed_files_say_what_they_drop(void **state) {
    (void)state;
    static const struct {
        const char *text, *words[3];
    } mixed[] = {
        {GRID_PYRAMID "CELLS 4 15\n4 0 1 2 4\n3 0 1 2\n3 0 2 3\n1 3\nCELL_TYPES 4\n10 5 5 1\n"
                      "POINT_DATA 5\n",
         {"the surface of 1 solid cells is read", "1 faces are those of solid cells, and left out",
          "data at points and cells are not read"}},
        {"# vtk DataFile Version 3.0\nmixed\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
         "0 0 0 1 0 0 0 1 0\nLINES 1 3\n2 0 1\nVERTICES 2 4\n1 0\n1 2\nPOLYGONS 1 4\n3 0 1 2\n"
         "CELL_DATA 4\n",
         {"3 cells are points or lines, and ignored", "data at points and cells are not read",
          ""}}};
    for (size_t k = 0; k < sizeof mixed / sizeof *mixed; k++) {
        mesh m;
        char message[300], note[500];
        const char *path = files_put_text("mixed.vtk", mixed[k].text);
        assert_true(mesh_read_noting(&m, path, message, sizeof message, note, sizeof note));
        for (int i = 0; i < 3; i++) {
            assert_non_null(strstr(note, mixed[k].words[i]));
        }
        mesh_free(&m);
    }
}

static void bad_grids_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *words;
    } bad[] = {
        {GRID_START, "there are no POINTS"},
        {GRID_PYRAMID "POLYGONS 1 4\n3 0 1 2\n", "not a section of an unstructured grid"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 2\n", "1 CELLS but 0 CELL_TYPES"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 2\nCELL_TYPES 2\n5 5\n", "1 CELLS but 2 CELL_TYPES"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 5\nCELL_TYPES 1\n5\n", "vertex 5"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 2\nCELL_TYPES x\n", "a count expected"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\nx\n", "CELL_TYPES: truncated"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n22\n", "cell 0 has type 22; only"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n4000000000\n", "only triangles"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n",
         "cell 0 of type 10 has 3 corners, not 4"},
        {GRID_PYRAMID "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n9\n", "3 corners, not 4"},
        {GRID_PYRAMID "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n5\n", "4 corners, not 3"},
        {GRID_PYRAMID "CELLS 1 3\n2 0 1\nCELL_TYPES 1\n7\n", "2 corners"},
        {GRID_PYRAMID "CELLS 1 3\n2 0 1\nCELL_TYPES 1\n6\n", "2 corners"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        assert_is_refused(files_put_text("bad.vtk", bad[k].text), bad[k].words);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_are_read),
        cmocka_unit_test(surfaces_of_solids_are_read),
        cmocka_unit_test(mixed_files_say_what_they_drop),
        cmocka_unit_test(bad_grids_are_refused),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
