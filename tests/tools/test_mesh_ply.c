/* test_mesh_ply.c: reads PLY meshes: ASCII and binary, any properties, bad files */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

static void ascii_variants_are_read(void **state) {
    (void)state;
    assert_is_pyramid(files_put_text("plain.ply", ply_ascii));
    assert_is_pyramid(files_put_text(
        "order.ply", PLY_ASCII_HEADER
        "obj_info from a test\nelement camera 1\nproperty list int float lens\n"
        "property int id\nelement vertex 5\nproperty uint8 red\nproperty float64 z\n"
        "property list uchar short extra\nproperty double y\nproperty float32 x\nelement nothing "
        "3\n"
        "element face 5\nproperty int material\nproperty list uint8 uint32 vertex_index\n"
        "property list uchar float texcoord\nelement edge 1\nproperty int a\nend_header\n"
        "2 0.5 0.5 7\n9 0 0 0 0\n9 0 1 5 0 1\n9 0 2 5 6 1 1\n9 0 0 1 0\n9 -2.5 0 0.25 0.5\n"
        "1 4 0 3 2 1 0\n1 3 0 1 4 2 .5 .5\n1 3 1 2 4 0\n1 3 2 3 4 0\n1 3 3 0 4 0\n1\n"));
    assert_is_pyramid(files_put_text(
        "faces_first.ply", PLY_ASCII_HEADER
        "element face 5\nproperty list uchar int vertex_indices\nelement vertex 5\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n" OFF_FACES
            OFF_VERTICES));
    mesh m;
    assert_true(mesh_read(&m,
                          files_put_text("points.ply", PLY_ASCII_HEADER
                                         "element vertex 1\nproperty float x\nproperty "
                                         "float y\nproperty float z\nend_header\n1 2 3\n"),
                          NULL, 0));
    assert_int_equal(m.n_vertices, 1);
    mesh_free(&m);
}

/* Reads a pyramid whose note contains `words`; "" if there is no note. */
static void assert_is_noted(const char *path, const char *words) {
    mesh m;
    char message[300], note[300] = "x";
    assert_is_pyramid(path);
    assert_true(mesh_read_noting(&m, path, message, sizeof message, note, sizeof note));
    if (words[0] == '\0' ? note[0] != '\0'
                         : strncmp(note, path, strlen(path)) != 0 || !strstr(note, words)) {
        print_error("%s\n    lacks: %s\n", note, words);
        fail();
    }
    mesh_free(&m);
}

#define PLY_XYZ "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"

/* Values beyond the declared ones are ignored and noted where each row has its line; rows may be
 * split over lines, or share them. Rows with fewer values are blamed on their own line. */
static void rows_are_told_from_lines(void **state) {
    (void)state;
#define PYRAMID_START PLY_ASCII_HEADER PLY_XYZ PLY_FACE "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.25 -2.5"
    const char *path = files_put_text("r.ply", ply_ascii);
    assert_is_noted(path, "");
    path = files_put_text("r.ply", PYRAMID_START "\n4 0 3 2 1 255 0 9\n3 0 1 4 255 0 9\n"
                                                 "3 1 2 4 255 1 1\n3 2 3 4 0 0 0\n3 3 0 4 1 1 1\n");
    assert_is_noted(path, "line 16: face 0 has more values than the header declares");
    path = files_put_text("r.ply", PYRAMID_START " 0.5 7\n\n" OFF_FACES "\n");
    assert_is_noted(path, "line 15: vertex 4 has more values");
    path = files_put_text("r.ply", PLY_ASCII_HEADER PLY_XYZ PLY_FACE
                          "0 0 0 1 0 0 1 1 0\n0 1 0 0.5 0.25 -2.5 4 0 3 2 1\n3 0 1 4 3 1 2 4\n"
                          "3 2 3 4 3 3 0 4\n");
    assert_is_noted(path, "");
    path = files_put_text("r.ply", PYRAMID_START "\n4\n0 3 2 1\n3\n0 1 4\n3 1 2\n4\n3 2 3 4\n3 "
                                                 "3\n0\n4");
    assert_is_noted(path, "");
    path = files_put_text("r.ply", PYRAMID_START "\n4 0 3 2 1\n3 0 1 4 4\n4 1 2 4\n3 2 3 4\n"
                                                 "3 3 0 4\n");
    assert_is_refused(path, ":18: face 2: fewer values in its line");
    path = files_put_text("r.ply", PLY_ASCII_HEADER PLY_XYZ PLY_FACE
                          "0 0 0\n1 0\n1 1 0\n0 1 0\n0.5 0.25 -2.5\n" OFF_FACES "\n1\n2\n3");
    assert_is_refused(path, ":12: vertex 1: fewer values in its line");
}

/* Strips alternate and begin anew after -1; strips of fewer than three corners have no triangle. */
static void strips_are_read(void **state) {
    (void)state;
    static const sl_int expected[12] = {0, 1, 2, 2, 1, 3, 1, 2, 4, 0, 4, 3};
    mesh m;
    char message[300], note[300];
#define STRIPS(type) "element tristrips 2\nproperty list int " type " vertex_indices\nend_header\n"
    const char *path = files_put_text("s.ply", PLY_ASCII_HEADER PLY_XYZ STRIPS("int") OFF_VERTICES
                                      "11 0 1 2 3 -1 1 2 4 -1 0 1\n5 2 -1 0 4 3\n");
    assert_true(mesh_read_noting(&m, path, message, sizeof message, note, sizeof note));
    assert_string_equal(note, "");
    assert_int_equal(m.n_faces, 4);
    assert_memory_equal(m.faces, expected, sizeof expected);
    mesh_free(&m);
    assert_is_refused(files_put_text("s.ply", PLY_ASCII_HEADER PLY_XYZ STRIPS("int") OFF_VERTICES
                                     "3 0 1 -2\n0\n"),
                      "tristrips 0: -2 is not a vertex index");
    assert_is_refused(files_put_text("s.ply", PLY_ASCII_HEADER PLY_XYZ
                                     "element tristrips 1\nproperty int a\nend_header\n"),
                      "element tristrips must have one list vertex_indices");
}

/* Elements that are skipped are named. */
static void skipped_elements_are_noted(void **state) {
    (void)state;
    const char *path = files_put_text("e.ply", PLY_ASCII_HEADER PLY_XYZ
                                      "element edge 2\nproperty int a\nelement none 0\n"
                                      "element camera 1\nproperty int b\n" PLY_FACE OFF_VERTICES
                                      "1\n2\n3\n" OFF_FACES);
    assert_is_noted(path, "element edge is ignored, 2 rows; element camera is ignored, 1 rows");
    char text[2000] = PLY_ASCII_HEADER PLY_XYZ;
    for (int k = 0; k < 16; k++) {
        (void)strcat(text, "element fifteen_letters 1\nproperty int a\n");
    }
    (void)strcat(text, PLY_FACE OFF_VERTICES "1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\n" OFF_FACES);
    assert_is_noted(files_put_text("e.ply", text), "element fifteen_letters is ignored, 1 rows; ");
}

static void binary_variants_are_read(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int bytes;
    } types[] = {{"char", 1}, {"uint8", 1}, {"int16", 2}, {"ushort", 2}, {"int", 4}, {"uint32", 4}};
    static const char *const line_ends[3] = {"\n", "\r\n", "\r"};
    for (size_t k = 0; k < sizeof types / sizeof types[0]; k++) {
        for (int big = 0; big < 2; big++) {
            binary_t b = binary_pyramid(big != 0, types[k].name, types[k].bytes, line_ends[k % 3]);
            assert_is_pyramid(files_put("binary.ply", b.bytes, b.length));
        }
    }
}

static void property_types_keep_their_sign(void **state) {
    (void)state;
    for (int big = 0; big < 2; big++) {
        binary_t b;
        char header[300];
        memset(&b, 0, sizeof b);
        b.big_endian = big != 0;
        (void)snprintf(header, sizeof header,
                       "ply\nformat binary_%s_endian 1.0\nelement vertex 1\nproperty char "
                       "x\nproperty short y\n"
                       "property int z\nelement vertex 1\nproperty uchar x\nproperty ushort "
                       "y\nproperty uint z\n"
                       "end_header\n",
                       big ? "big" : "little");
        put_text(&b, header);
        for (int k = 0; k < 2; k++) {
            put_bits(&b, 0xFF, 1);
            put_bits(&b, 0xFFFE, 2);
            put_bits(&b, 0xFFFFFFFD, 4);
        }
        mesh m;
        assert_true(mesh_read(&m, files_put("signs.ply", b.bytes, b.length), NULL, 0));
        assert_int_equal(m.n_vertices, 2);
        assert_true(m.xyz[0] == -1 && m.xyz[1] == -2 && m.xyz[2] == -3);
        assert_true(m.xyz[3] == 255 && m.xyz[4] == 65534 && m.xyz[5] == 4294967293.0);
        mesh_free(&m);
    }
}

/* When lines end in \r, a first data byte that happens to be \n is not part of the line end. */
static void data_that_look_like_a_line_end_are_read(void **state) {
    (void)state;
    for (int single = 0; single < 2; single++) {
        const char *end = single ? "\r" : "\r\n";
        binary_t b;
        char header[300];
        memset(&b, 0, sizeof b);
        (void)snprintf(header, sizeof header,
                       "ply%sformat binary_little_endian 1.0%selement vertex 1%sproperty uchar x%s"
                       "property uchar y%sproperty uchar z%send_header%s",
                       end, end, end, end, end, end, end);
        put_text(&b, header);
        put_text(&b, "\n\r\n");
        mesh m;
        assert_true(mesh_read(&m, files_put("ends.ply", b.bytes, b.length), NULL, 0));
        assert_true(m.xyz[0] == 10 && m.xyz[1] == 13 && m.xyz[2] == 10);
        mesh_free(&m);
    }
}

static void bad_files_are_refused(void **state) {
    (void)state;
#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define LITTLE "ply\nformat binary_little_endian 1.0\n"
#define FACE1 "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    assert_is_refused(files_put_text("a.ply", ""), "not a PLY mesh");
    assert_is_refused(files_put_text("b.ply", "OFF\n"), "not a PLY mesh");
    assert_is_refused(files_put_text("c.ply", "ply\nformat text 1.0\n"),
                      ":2: 'text' is not a PLY format");
    assert_is_refused(files_put_text("d.ply", "ply\nelement vertex 0\n" XYZ "end_header\n"),
                      "no format");
    assert_is_refused(files_put_text("e.ply", "ply\nformat ascii 1.0\nelement vertex\n"),
                      ":3: element vertex has no count");
    assert_is_refused(files_put_text("f.ply", "ply\nformat ascii 1.0\nelement vertex -1\n"),
                      "has no count");
    assert_is_refused(files_put_text("g.ply", "ply\nformat ascii 1.0\nproperty float x\n"),
                      "before the first element");
    assert_is_refused(
        files_put_text("h.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty int128 x\n"),
        "'int128'");
    assert_is_refused(
        files_put_text("i.ply",
                       "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar what x\n"),
        "'what'");
    assert_is_refused(files_put_text("j.ply", "ply\nformat ascii 1.0\nwhat\n"),
                      "'what' is not a PLY header keyword");
    assert_is_refused(
        files_put_text("k.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n"),
        "no element vertex");
    assert_is_refused(
        files_put_text(
            "l.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
        "must have x, y and z");
    assert_is_refused(files_put_text("m.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                                              "property int x\nend_header\n"),
                      "must have x, y and z");
    assert_is_refused(files_put_text("n.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                                              "element face 1\nproperty int a\n"
                                              "end_header\n0 0 0\n1\n"),
                      "must have one list vertex_indices");
    assert_is_refused(files_put_text("o.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ FACE1
                                              "0 0 0\n3 0 0 1\n"),
                      ":11: face 0: vertex 1");
    assert_is_refused(files_put_text("p.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ FACE1
                                              "0 0 0\n3 0 0 -1\n"),
                      ":11: face 0: -1 is not a vertex index");
    assert_is_refused(files_put_text("q.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ FACE1
                                              "0 0 0\n3 0 0 0.5\n"),
                      "0.5 is not a vertex index");
    assert_is_refused(files_put_text("r.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ FACE1
                                              "0 0 0\n-3 0 0 0\n"),
                      "list has no valid count");
    assert_is_refused(files_put_text("s.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ FACE1
                                              "0 0 0\n1 0\n"),
                      "1 corners");
    assert_is_refused(
        files_put_text("t.ply", LITTLE "element vertex 2000000000\n" XYZ "end_header\n0123"),
        "vertex 0: truncated");
    assert_is_refused(files_put_text("u.ply",
                                     LITTLE "element vertex 0\n" XYZ
                                            "element skip 9000000000000000000\nproperty char a\n"
                                            "end_header\nabc"),
                      "skip 3: truncated");
    assert_is_refused(files_put_text("v.ply",
                                     LITTLE "element vertex 0\n" XYZ
                                            "element face 1\nproperty list uint int "
                                            "vertex_indices\nend_header\n\377\377\377\377"),
                      "face 0: truncated");
    assert_is_refused(files_put_text("w.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                                              "end_header\n0 0 nan\n"),
                      "not finite");
    assert_is_refused(files_put_text("x.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ),
                      "truncated in the header");
    /* An element without properties needs no data, however large its count. */
    mesh m;
    assert_true(mesh_read(&m,
                          files_put_text("y.ply", LITTLE "element vertex 0\n" XYZ
                                                         "element nothing 9000000000000000000\n"
                                                         "end_header\n"),
                          NULL, 0));
    mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_variants_are_read),
        cmocka_unit_test(rows_are_told_from_lines),
        cmocka_unit_test(strips_are_read),
        cmocka_unit_test(skipped_elements_are_noted),
        cmocka_unit_test(binary_variants_are_read),
        cmocka_unit_test(property_types_keep_their_sign),
        cmocka_unit_test(data_that_look_like_a_line_end_are_read),
        cmocka_unit_test(bad_files_are_refused),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
