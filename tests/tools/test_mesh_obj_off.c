/* test_mesh_obj_off.c: reads OBJ and OFF meshes, refuses bad files; real meshes */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

static void obj_variants_are_read(void **state) {
    (void)state;
    assert_is_pyramid(files_put_text("plain.obj", obj_plain));
    assert_is_pyramid(files_put_text("plain.OBJ", obj_plain));
    assert_is_pyramid(files_put_text(
        "corners.obj", "# a pyramid\nmtllib a.mtl\no p\n" OBJ_VERTICES
                       "vt 0 0\nvn 0 0 1\ns off\n  f 1/1 4/1 3/1 2/1 # base\n\n"
                       "f 1//1 2//1 5//1\nf 2/1/1 3/1/1 5/1/1\nf\t3 4/1 5/1/1\nf 4/-1 1/-1 5/-1"));
    assert_is_pyramid(
        files_put_text("negative.obj",
                       OBJ_VERTICES "f -5 -2 -3 -4\nf -5 2 -1\nf -4 3 -1\nf -3 4 -1\nf -2 1 -1\n"));
    assert_is_pyramid(files_put_text(
        "early.obj", "v 0 0 0 1.0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 4 3 2\nf 1 2 5\nf 2 3 5\n"
                     "f 3 4 5\nf 4 1 5\nv .5 .25 -2.5 0.1 0.2 0.3\n"));
    assert_is_pyramid(files_put_text(
        "continued.obj", "# ends in a backslash \\\n" OBJ_VERTICES
                         "f 1 4 \\\n 3 2\nf \\\r\n1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\\\n\n"));
    assert_is_pyramid(files_put_text("returns.obj",
                                     "v 0 0 0\r\nv 1 0 0\rv 1 1 0\r\nv 0 1 0\r\nv .5 .25 -2.5\r\n"
                                     "f 1 4 3 2\r\nf 1 2 5\r\nf 2 3 5\r\nf 3 4 5\r\nf 4 1 5\r\n"));
    assert_is_pyramid(files_put_text("fo.obj", OBJ_VERTICES
                                     "fo 1 4 3 2\nfo 1/1 2/2 5/3\nf 2 3 5\nfo 3 4 5\nf 4 1 5\n"));
}

static void obj_keeps_repeated_and_unused_vertices(void **state) {
    (void)state;
    mesh m;
    const char *path = files_put_text(
        "odd.obj", "v 0 0 0\nv 0 0 0\nv 1 0 0\nv 9 9 9\nf 1 2 3\nf 1 1 3\nf 1 2 3\nf 3 3 3\n");
    assert_true(mesh_read(&m, path, NULL, 0));
    assert_int_equal(m.n_vertices, 4);
    assert_int_equal(m.n_faces, 4);
    assert_int_equal(m.faces[4], 0);
    assert_true(m.xyz[9] == 9);
    mesh_free(&m);
    assert_true(mesh_read(&m, files_put_text("points.obj", "v 1 2 3\n"), NULL, 0));
    assert_int_equal(m.n_vertices, 1);
    assert_int_equal(m.n_faces, 0);
    mesh_free(&m);
}

static void bad_obj_files_are_refused(void **state) {
    (void)state;
    assert_is_refused(files_put_text("a.obj", ""), "no vertices");
    assert_is_refused(files_put_text("b.obj", "hello\nworld\n"), "no vertices");
    assert_is_refused(files_put_text("c.obj", "v 0 0\n"), ":1: v: three numbers expected");
    assert_is_refused(files_put_text("d.obj", "v 0 0 x\n"), ":1: v: three numbers expected");
    assert_is_refused(files_put_text("e.obj", "\nv 0 nan 0\n"),
                      ":2: vertex 0: a coordinate is not finite");
    assert_is_refused(files_put_text("f.obj", "v 0 0 1e999\n"), "not finite");
    assert_is_refused(files_put_text("g.obj", OBJ_VERTICES "f 1 2 3\nf 1 2 6\nf 1 2 3\n"),
                      ":7: face 1: vertex 5");
    assert_is_refused(files_put_text("h.obj", OBJ_VERTICES "f 1 2 0\n"),
                      ":6: f: index 0 is out of range");
    assert_is_refused(files_put_text("i.obj", OBJ_VERTICES "f 1 2 -6\n"),
                      ":6: f: index -6 is out of range");
    assert_is_refused(files_put_text("j.obj", OBJ_VERTICES "f 1 2 9999999999\n"), "out of range");
    assert_is_refused(files_put_text("k.obj", OBJ_VERTICES "f 1 2 99999999999999999999\n"),
                      "not an index");
    assert_is_refused(files_put_text("l.obj", OBJ_VERTICES "f 1 2\n"), "has 2 corners");
    assert_is_refused(files_put_text("m.obj", OBJ_VERTICES "f 1 2 x\n"), "not an index");
    assert_is_refused(files_put_text("n.obj", OBJ_VERTICES "f 1 2 3.5\n"), "not an index");
    assert_is_refused(files_put_text("o.obj", OBJ_VERTICES "f 1/a 2 3\n"), "v/vt");
    assert_is_refused(files_put_text("p.obj", OBJ_VERTICES "f 1 2 2147483648\n"), "out of range");
}

static void off_variants_are_read(void **state) {
    (void)state;
    assert_is_pyramid(files_put_text("plain.off", OFF_TEXT));
    assert_is_pyramid(files_put_text("same_line.off", "OFF 5 5 8\n" OFF_VERTICES OFF_FACES));
    assert_is_pyramid(files_put_text("two_counts.off", "OFF\n5 5\n" OFF_VERTICES OFF_FACES));
    assert_is_pyramid(files_put_text("no_word.off", "5 5 8\n" OFF_VERTICES OFF_FACES));
    assert_is_pyramid(files_put_text(
        "comments.off", "# a\nOFF # b\n\n# c\n5 5 8 # d\n\n0 0 0 # e\n1 0 0\n# f\n1 1 0\n0 1 0\n"
                        "0.5 0.25 -2.5\n#g\n\n" OFF_FACES "# h"));
    assert_is_pyramid(files_put_text(
        "colors.off", "COFF\r\n5 5 8\r\n0 0 0 1 0 0 1\r\n1 0 0 1 0 0 1\r\n1 1 0 255 0 0 255\r\n"
                      "0 1 0 1 0 0\r\n.5 .25 -2.5 1 1 1 1\r\n4 0 3 2 1 255 0 0\r\n"
                      "3 0 1 4 7\r\n3 1 2 4 .5 .5 .5 1\r\n3 2 3 4\r\n3 3 0 4"));
    assert_is_pyramid(files_put_text(
        "normals.off", "NOFF\n5 5 8\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n"
                       "0.5 0.25 -2.5 0 0 1\n" OFF_FACES));
    assert_is_pyramid(files_put_text("all.off", "STCNOFF\n5 5 8\n" OFF_VERTICES OFF_FACES));
    assert_is_pyramid(files_put_text("small.off", "off\n5 5 8\n" OFF_VERTICES OFF_FACES));
    assert_is_pyramid(files_put_text("small_color.off", "stcoff 5 5\n" OFF_VERTICES OFF_FACES));
    assert_is_pyramid(files_put_text("glued.off", "OFF5 5 8\n" OFF_VERTICES OFF_FACES));
    assert_is_pyramid(files_put_text("glued.off", "cnoff5 5 8\n" OFF_VERTICES OFF_FACES));
    mesh m;
    assert_true(mesh_read(&m, files_put_text("empty.off", "OFF\n0 0 0\n"), NULL, 0));
    assert_int_equal(m.n_vertices, 0);
    mesh_free(&m);
}

/* A big-endian word. */
static char *put_word(char *at, uint32_t word) {
    for (int k = 0; k < 4; k++) {
        at[k] = (char)(word >> (24 - 8 * k));
    }
    return at + 4;
}

/* The same square as text, whose faces go on in the next line, and binary, with colors of vertices
 * and of a face. A binary file that is cut anywhere is refused. */
static void off_faces_over_lines_and_binary_off(void **state) {
    (void)state;
    static const sl_int wanted[6] = {0, 1, 2, 0, 2, 3};
    static const uint32_t one = 0x3F800000, zero = 0; /* floats */
    const uint32_t xyz[12] = {zero, zero, zero, one, zero, zero, one, one, zero, zero, one, zero};
    const uint32_t tail[] = {3, 0, 1, 2, 0, 3, 0, 2, 3, 3, one, zero, one};
    char bytes[300] = "COFF BINARY\n", message[300];
    char *at = bytes + strlen(bytes);
    mesh m;
    at = put_word(put_word(put_word(at, 4), 2), 0);
    for (int k = 0; k < 12; k++) {
        at = put_word(at, xyz[k]);
        for (int i = 0; i < 4 && k % 3 == 2; i++) {
            at = put_word(at, one);
        }
    }
    for (size_t k = 0; k < sizeof tail / sizeof *tail; k++) {
        at = put_word(at, tail[k]);
    }
    const size_t length = (size_t)(at - bytes);
    (void)files_put_text("lines.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                      "3 0 1\n2 255 0 0\n3\n0 2\n# here\n 3\n");
    for (int k = 0; k < 2; k++) {
        const char *path =
            k == 0 ? files_path("lines.off") : files_put("binary.off", bytes, length);
        assert_true(mesh_read(&m, path, message, sizeof message));
        assert_true(m.n_vertices == 4 && m.n_faces == 2);
        assert_memory_equal(m.faces, wanted, sizeof wanted);
        assert_true(m.xyz[6] == 1 && m.xyz[7] == 1 && m.xyz[8] == 0);
        mesh_free(&m);
    }
    for (size_t cut = 12; cut < length; cut++) {
        assert_false(mesh_read(&m, files_put("cut.off", bytes, cut), message, sizeof message));
    }
}

static void bad_off_files_are_refused(void **state) {
    (void)state;
    assert_is_refused(files_put_text("a.off", ""), "empty");
    assert_is_refused(files_put_text("b.off", "hello\n"),
                      ":1: not an OFF mesh: begins with neither OFF nor a count");
    assert_is_refused(files_put_text("b.off", "noff\n5 5 8\n"), "not an OFF mesh");
    assert_is_refused(files_put_text("b.off", "4off\n5 5 8\n"), "three coordinates");
    assert_is_refused(files_put_text("b.off", "OFFSET\n5 5 8\n"), "not an OFF mesh");
    assert_is_refused(files_put_text("c.off", "OFF BINARY\n5 5 0\n"), "truncated");
    assert_is_refused(files_put_text("d.off", "4OFF\n5 5 0\n"), "three coordinates");
    assert_is_refused(files_put_text("e.off", "nOFF\n3\n5 5 0\n"), "three coordinates");
    assert_is_refused(files_put_text("f.off", "OFF\n-5 5 0\n"), ":2: counts of vertices");
    assert_is_refused(files_put_text("g.off", "OFF\n5\n"), "counts of vertices");
    assert_is_refused(files_put_text("h.off", "OFF\n2000000000 2000000000 0\n0 0 0\n"),
                      "vertex 1: three numbers expected");
    assert_is_refused(files_put_text("i.off", "OFF\n99999999999999 5 0\n" OFF_VERTICES),
                      "three numbers expected");
    assert_is_refused(files_put_text("j.off", "OFF\n5 5 0\n" OFF_VERTICES "3 0 1 2\n"),
                      "face 1: number of corners");
    assert_is_refused(files_put_text("k.off", "OFF\n5 1 0\n" OFF_VERTICES "3 0 1\n"),
                      ":8: face 0: 3 corners expected");
    assert_is_refused(files_put_text("l.off", "OFF\n5 1 0\n" OFF_VERTICES "3 0 1 5\n"),
                      ":8: face 0: vertex 5");
    assert_is_refused(files_put_text("m.off", "OFF\n5 1 0\n" OFF_VERTICES "3 0 1 -1\n"),
                      ":8: face 0: vertex -1");
    assert_is_refused(files_put_text("n.off", "OFF\n5 1 0\n" OFF_VERTICES "2 0 1\n"),
                      "has 2 corners");
    assert_is_refused(files_put_text("o.off", "OFF\n5 1 0\n" OFF_VERTICES "-3 0 1 2\n"),
                      "has 0 corners");
    assert_is_refused(files_put_text("p.off", "OFF\n5 1 0\n" OFF_VERTICES "2000000000 0 1 2\n"),
                      "2000000000 corners expected");
    assert_is_refused(files_put_text("q.off", "OFF\n1 0 0\n0 0 inf\n"), "not finite");
}

static void other_files_are_refused(void **state) {
    (void)state;
    assert_is_refused(files_path("missing.obj"), "cannot be opened");
    assert_is_refused(files_put_text("mesh.3ds", obj_plain), "unknown mesh format");
    assert_is_refused(files_put_text("obj", obj_plain), "unknown mesh format");
    char folder[FILE_PATH_SIZE + 100];
    (void)snprintf(folder, sizeof folder, "%s", files_path("folder.obj"));
    assert_int_equal(mkdir(folder, 0777), 0);
    assert_is_refused(folder, "cannot be");
    assert_int_equal(rmdir(folder), 0);
    mesh m;
    char tiny[8];
    assert_false(mesh_read(&m, NULL, tiny, sizeof tiny));
    assert_string_equal(tiny, "...): c"); /* of a path that is too long the end is shown */
    assert_false(mesh_read(&m, files_path("missing.obj"), tiny, 1));
    assert_string_equal(tiny, "");
}

static void real_meshes_are_read(void **state) {
    (void)state;
    static const struct {
        const char *name;
        sl_int vertices;
        sl_int faces;
    } known[] = {{"spot.ply.gz", 2930, 5856},
                 {"hemisphere.obj.gz", 2051, 4000},
                 {"stratocaster.ply.gz", 4500, 8660},
                 {"maze.obj.gz", 6120, 9174},
                 {"human_neutral.obj.gz", 10475, 20908},
                 {"bunny.off.gz", 14290, 28576},
                 {"mountain.obj.gz", 25600, 50562},
                 {"hammer.obj.gz", 30082, 60160},
                 {"kitten.obj.gz", 53123, 106246},
                 {"turbineblade.ply.gz", 99519, 199034},
                 {"colin.cerebral.L.flat.164k_fs_LR.ply.gz", 163842, 296333},
                 {"dragon_vrip_res2.ply.gz", 100250, 202520},
                 {"sliver_tet.ply.gz", 5009, 4},
                 {"fan3.obj", 5, 3},
                 {"hourglass_ico.obj", 23, 40},
                 {"hole_capsule.off", 89, 152}};
    dataset d;
    if (!dataset_list(&d, NULL, "meshes")) {
        TEST_SKIP("SL_DATA names no folder with meshes: no real meshes are read");
    }
    size_t checked = 0;
    for (size_t k = 0; k < d.count; k++) {
        mesh m;
        char message[300];
        if (!mesh_read(&m, d.paths[k], message, sizeof message)) {
            print_error("%s\n", message);
            fail();
        }
        for (size_t t = 0; t < sizeof known / sizeof known[0]; t++) {
            if (strcmp(dataset_basename(d.paths[k]), known[t].name) == 0) {
                assert_int_equal(m.n_vertices, known[t].vertices);
                assert_int_equal(m.n_faces, known[t].faces);
                checked++;
            }
        }
        mesh_free(&m);
    }
    print_message("%lu real meshes read, %lu of known size\n", (unsigned long)d.count,
                  (unsigned long)checked);
    dataset_free(&d);
}

/* Text that begins with a UTF-8 byte order mark, in every format. */
static void byte_order_marks_are_skipped(void **state) {
    (void)state;
#define MARK "\xEF\xBB\xBF"
    assert_is_pyramid(files_put_text("m.obj", MARK OBJ_VERTICES
                                     "f 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"));
    assert_is_pyramid(files_put_text("m.off", MARK OFF_TEXT));
    assert_is_pyramid(files_put_text("m.ply", MARK PLY_ASCII_HEADER
                                     "element vertex 5\nproperty float x\nproperty float y\n"
                                     "property float z\n" PLY_FACE OFF_VERTICES OFF_FACES));
    assert_is_pyramid(files_put_text("m.vtk", MARK "# vtk DataFile Version 3.0\nt\nASCII\n"
                                                   "DATASET POLYDATA\nPOINTS 5 float\n" OFF_VERTICES
                                                   "POLYGONS 5 21\n" OFF_FACES));
    mesh m;
    assert_true(mesh_read(&m,
                          files_put_text("m.stl", MARK "solid\nvertex 0 0 0 vertex 1 0 0 "
                                                       "vertex 0 1 0 endloop\nendsolid\n"),
                          NULL, 0));
    assert_true(m.n_vertices == 3 && m.n_faces == 1);
    mesh_free(&m);
    assert_true(
        mesh_read(&m, files_put_text("m.gltf", MARK "{\"asset\":{\"version\":\"2.0\"}}"), NULL, 0));
    mesh_free(&m);
    assert_is_refused(files_put_text("m.obj", MARK), "no vertices");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obj_variants_are_read),
        cmocka_unit_test(obj_keeps_repeated_and_unused_vertices),
        cmocka_unit_test(bad_obj_files_are_refused),
        cmocka_unit_test(off_variants_are_read),
        cmocka_unit_test(off_faces_over_lines_and_binary_off),
        cmocka_unit_test(bad_off_files_are_refused),
        cmocka_unit_test(byte_order_marks_are_skipped),
        cmocka_unit_test(other_files_are_refused),
        cmocka_unit_test(real_meshes_are_read),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
