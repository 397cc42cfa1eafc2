/* test_mesh_vtk.c: legacy VTK files: text and binary, both forms of cells, strips, refusals */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

#include "tools/mesh/mesh_write.h"

#define VTK_START "# vtk DataFile Version 3.0\na title: POINTS 7\nASCII\nDATASET POLYDATA\n"
#define VTK_POINTS VTK_START "POINTS 5 float\n" OFF_VERTICES
#define VTK_CELLS "POLYGONS 5 21\n" OFF_FACES

static void text_is_read(void **state) {
    (void)state;
    assert_is_pyramid(files_put_text("a.vtk", VTK_POINTS VTK_CELLS));
    assert_is_pyramid(
        files_put_text("a.VTK", VTK_POINTS VTK_CELLS "POINT_DATA 5\nnothing of it\n"));
    assert_is_pyramid(
        files_put_text("b.vtk", VTK_START
                       "FIELD FieldData 2\ntime 1 1 double\n0.5\nnames 2 2 int\n1 2\n3 4\n"
                       "METADATA\nINFORMATION 0\nNAME x\n\n"
                       "points 5 unsigned_char\n0 0 0 1 0 0 1\n1 0 0 1 0 .5 2.5e-1 -2.5\n"
                       "METADATA\nINFORMATION 0\n\nVERTICES 2 4\n1 0\n1 2\n"
                       "LINES 1 4\n3 0 1 2\npolygons 5 21\n4 0 3 2 1 3 0 1 4\n3 1 2 4 3\n2 3 4 3 "
                       "3 0 4\nCELL_DATA 5\n"));
    assert_is_pyramid(files_put_text(
        "c.vtk",
        "# vtk DataFile Version 5.1\r\n\r\nASCII\r\n\r\nDATASET POLYDATA\r\nPOINTS 5 double"
        "\r\n" OFF_VERTICES "POLYGONS 6 16\r\nOFFSETS vtktypeint64\r\n0 4 7 10 13 16\r\n"
        "CONNECTIVITY vtktypeint64\r\n0 3 2 1 0 1 4 1 2 4\r\n2 3 4 3 0 4\r\nLINES 1 0\r\n"
        "OFFSETS vtktypeint64\r\n0\r\nCONNECTIVITY vtktypeint64\r\n"));
}

/* Strips alternate; triangles that only join parts of a strip are left out. */
static void strips_are_read(void **state) {
    (void)state;
    static const sl_int expected[12] = {0, 1, 2, 2, 1, 3, 2, 3, 4, 1, 0, 4};
    mesh m;
    assert_true(mesh_read(
        &m, files_put_text("s.vtk", VTK_POINTS "TRIANGLE_STRIPS 2 12\n5 0 1 2 3 4\n5 1 1 1 0 4\n"),
        NULL, 0));
    assert_int_equal(m.n_faces, 4);
    assert_memory_equal(m.faces, expected, 9 * sizeof *expected);
    assert_memory_equal(m.faces + 9, expected + 9, 3 * sizeof *expected);
    mesh_free(&m);
}

static void put_pyramid(binary_t *b, const char *start, int version, int corner_bytes) {
    static const int quad_and_triangles[21] = {4, 0, 3, 2, 1, 3, 0, 1, 4, 3, 1,
                                               2, 4, 3, 2, 3, 4, 3, 3, 0, 4};
    static const int offsets[6] = {0, 4, 7, 10, 13, 16};
    memset(b, 0, sizeof *b);
    b->big_endian = true;
    put_text(b, start);
    for (int k = 0; k < 15; k++) {
        put_double(b, pyramid_xyz[k]);
    }
    if (version < 5) {
        put_text(b, "\nPOLYGONS 5 21\n");
        for (int k = 0; k < 21; k++) {
            put_bits(b, (uint64_t)quad_and_triangles[k], 4);
        }
    } else {
        const char *type = corner_bytes == 8 ? "vtktypeint64" : "unsigned_short";
        char line[100];
        (void)snprintf(line, sizeof line, "\nPOLYGONS 6 16\nOFFSETS %s\n", type);
        put_text(b, line);
        for (int k = 0; k < 6; k++) {
            put_bits(b, (uint64_t)offsets[k], corner_bytes);
        }
        (void)snprintf(line, sizeof line, "\nCONNECTIVITY %s\n", type);
        put_text(b, line);
        for (int k = 0, next = 0; k < 21; k++) {
            if (k == next) { /* a count */
                next += 1 + quad_and_triangles[k];
            } else {
                put_bits(b, (uint64_t)quad_and_triangles[k], corner_bytes);
            }
        }
    }
    put_text(b, "\nPOINT_DATA 5\nSCALARS x double 1\nLOOKUP_TABLE default\n");
}

static void binary_data_are_read(void **state) {
    (void)state;
    binary_t b;
    const char *start = "# vtk DataFile Version 4.2\n\nBINARY\nDATASET POLYDATA\nPOINTS 5 double\n";
    put_pyramid(&b, start, 4, 4);
    assert_is_pyramid(files_put("a.vtk", b.bytes, b.length));
    assert_is_pyramid(files_put_gz("a.vtk.gz", b.bytes, b.length));
    for (size_t length = 0; length < b.length - 60; length++) {
        (void)read_is_valid(files_put("cut.vtk", b.bytes, length));
    }
    put_pyramid(&b, start, 5, 8);
    assert_is_pyramid(files_put("b.vtk", b.bytes, b.length));
    put_pyramid(&b, start, 5, 2);
    assert_is_pyramid(files_put("b.vtk", b.bytes, b.length));
    memset(&b, 0, sizeof b); /* a field, skipped by its bytes */
    b.big_endian = true;
    put_text(&b,
             "# vtk DataFile Version 4.2\n\nBINARY\nDATASET POLYDATA\nFIELD f 2\nx 1 1 short\n");
    put_bits(&b, 0x0A0A, 2);
    put_text(&b, "\ny 3 1 char\n\n\n\n\nPOINTS 1 double\n");
    for (int k = 0; k < 3; k++) {
        put_double(&b, k);
    }
    mesh m;
    assert_true(mesh_read(&m, files_put("f.vtk", b.bytes, b.length), NULL, 0));
    assert_true(m.n_vertices == 1 && m.xyz[2] == 2);
    mesh_free(&m);
}

static void bad_files_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *words;
    } bad[] = {
        {"", "not a VTK file"},
        {"# vtk DataFile Version 3.0\nx\nTEXT\n", ":3: 'TEXT' is neither"},
        {"# vtk DataFile Version 3.0\nx\nASCII\n", "DATASET expected"},
        {"# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n",
         ":4: DATASET STRUCTURED_POINTS is not supported"},
        {VTK_START, "there are no POINTS"},
        {VTK_START "POINTS 5 round\n", ":5: 'ROUND' is not a type"},
        {VTK_START "POINTS five float\n", "a count expected"},
        {VTK_START "POINTS 2000000000 float\n", "not larger than the file"},
        {VTK_START "POINTS 2 float\n0 0 0\n0 0", "vertex 1: truncated"},
        {VTK_START "POINTS 1 float\n0 0 nan\n", "not finite"},
        {VTK_POINTS "POINTS 1 float\n0 0 0\n", "a second section POINTS"},
        {VTK_POINTS "POLYGONS 1 4\n3 0 1\n", "POLYGONS: truncated"},
        {VTK_POINTS "POLYGONS 1 4\n3 0 1 5\n", "face 0: vertex 5"},
        {VTK_POINTS "POLYGONS 1 4\n3 0 1 -1\n", "not a vertex or a count"},
        {VTK_POINTS "POLYGONS 1 4\n3 0 1 0.5\n", "not a vertex or a count"},
        {VTK_POINTS "POLYGONS 1 3\n3 0 1 2\n", "cell 0 is longer than the size"},
        {VTK_POINTS "POLYGONS 1 3\n2 0 1\n", "2 corners"},
        {VTK_POINTS "TRIANGLE_STRIPS 1 3\n2 0 1\n", "2 corners"},
        {VTK_POINTS "POLYGONS 2 3\nOFFSETS int\n1 3\nCONNECTIVITY int\n0 1 2\n", "do not ascend"},
        {VTK_POINTS "POLYGONS 2 3\nOFFSETS int\n0 4\nCONNECTIVITY int\n0 1 2\n", "do not ascend"},
        {VTK_POINTS "POLYGONS 2 3\nOFFSETS int\n0 3\nCONNECTION int\n0 1 2\n",
         "CONNECTIVITY and a type expected"},
        {VTK_POINTS "POLYGONS 2 3\nOFFSETS int\n0 3\n", "POLYGONS: truncated"},
        {VTK_POINTS "CELLS 1 3\n", "'CELLS' is not a section of polygonal data"},
        {VTK_START "FIELD f 2\nx 1 1 int\n1\n", "FIELD: truncated"},
        {VTK_START "FIELD f 1\nx 2 2 int\n1\n", "FIELD: truncated"},
        {VTK_START "FIELD f 1\nx 1 1 string\nname\n", "'STRING' is not a type"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        assert_is_refused(files_put_text("bad.vtk", bad[k].text), bad[k].words);
    }
}

/* A triangle, byte by byte. */
static void bytes_are_as_specified(void **state) {
    (void)state;
    double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, value[3] = {0.5, NAN, 1e300};
    double uv[6] = {1, 2, 3, 4, 5, 6};
    sl_int faces[3] = {0, 1, 2};
    const mesh m = {3, 1, xyz, faces};
    const rgb color[3] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 255}};
    const mesh_field field = {"heat", value};
    const mesh_extra extra = {uv, NULL, color, &field, 1, NULL};
    binary_t b;
    memset(&b, 0, sizeof b);
    b.big_endian = true;
    put_text(&b, "# vtk DataFile Version 3.0\nsparse-local\nBINARY\nDATASET POLYDATA\n"
                 "POINTS 3 double\n");
    for (int k = 0; k < 9; k++) {
        put_double(&b, xyz[k]);
    }
    put_text(&b, "\nPOLYGONS 1 4\n");
    for (int k = 0; k < 4; k++) {
        put_bits(&b, k == 0 ? 3 : (uint64_t)(k - 1), 4);
    }
    put_text(&b, "\nPOINT_DATA 3\nSCALARS heat double 1\nLOOKUP_TABLE default\n");
    for (int k = 0; k < 3; k++) {
        put_double(&b, value[k]);
    }
    put_text(&b, "\nCOLOR_SCALARS color 3\n");
    for (int k = 0; k < 3; k++) {
        put_bits(&b, color[k].r, 1);
        put_bits(&b, color[k].g, 1);
        put_bits(&b, color[k].b, 1);
    }
    put_text(&b, "\nTEXTURE_COORDINATES uv 2 double\n");
    for (int k = 0; k < 6; k++) {
        put_double(&b, uv[k]);
    }
    put_text(&b, "\n");
    size_t length = 0;
    assert_true(mesh_write(files_path("t.vtk"), &m, &extra, NULL, 0));
    char *got = files_get(files_path("t.vtk"), &length);
    assert_int_equal(length, b.length);
    assert_memory_equal(got, b.bytes, length);
    free(got);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_read),           cmocka_unit_test(strips_are_read),
        cmocka_unit_test(binary_data_are_read),   cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(bytes_are_as_specified),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
