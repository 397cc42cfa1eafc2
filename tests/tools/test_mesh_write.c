/* test_mesh_write.c: written meshes read back: fields, colors, texture coordinates */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

#include <float.h>
#include <math.h>

#include "tools/mesh/mesh_write.h"
#include "tools/mesh/surface_generator.h"

static void assert_reads_back(const mesh *m, const char *name, const mesh_extra *extra) {
    mesh back;
    char message[300];
    const char *path = files_path(name);
    assert_true(mesh_write(path, m, extra, message, sizeof message));
    if (!mesh_read(&back, path, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    assert_int_equal(back.n_vertices, m->n_vertices);
    assert_int_equal(back.n_faces, m->n_faces);
    SAME_VALUES(back.xyz, m->xyz, 3 * (size_t)m->n_vertices);
    assert_memory_equal(back.faces, m->faces, 3 * (size_t)m->n_faces * sizeof *m->faces);
    mesh_free(&back);
}

static void coordinates_keep_their_bits(void **state) {
    (void)state;
    static const char *const names[] = {"a.ply", "a.obj", "a.ply.gz", "a.obj.gz",
                                        "A.PLY", "a.vtk", "a.vtk.gz"};
    static const char *const surfaces[] = {"blob:2", "hills:7x5", "grid:1x1"};
    for (size_t s = 0; s < 3; s++) {
        mesh m;
        assert_true(surface_generate(&m, surfaces[s], NULL, 0));
        size_t n = (size_t)m.n_vertices;
        double *value = test_reals(n), *uv = test_reals(2 * n),
               *corner_uv = test_reals(6 * (size_t)m.n_faces);
        rgb *color = (rgb *)test_array(n, sizeof *color);
        for (size_t v = 0; v < n; v++) {
            value[v] = v % 3 == 0 ? (double)NAN : 1.0 / (double)(v + 1);
            uv[2 * v] = v % 5 == 0 ? (double)NAN : (double)v;
        }
        const mesh_field fields[2] = {{"heat", value}, {"other", value}};
        const mesh_extra all = {uv, NULL, color, fields, 2, NULL},
                         corners = {NULL, corner_uv, NULL, fields, 1, NULL},
                         one = {NULL, NULL, NULL, fields, 1, NULL};
        for (size_t k = 0; k < 7; k++) {
            assert_reads_back(&m, names[k], NULL);
            assert_reads_back(&m, names[k], &all);
            assert_reads_back(&m, names[k], &corners);
            assert_reads_back(&m, names[k], &one);
        }
        free(color);
        free(corner_uv);
        free(uv);
        free(value);
        mesh_free(&m);
    }
}

/* A triangle, byte by byte. */
static void ply_bytes_are_as_specified(void **state) {
    (void)state;
    double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, value[3] = {0.5, -2, 1e300},
           uv[6] = {1, 2, 3, 4, 5, 6};
    sl_int faces[3] = {0, 1, 2};
    const mesh m = {3, 1, xyz, faces};
    const rgb color[3] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 255}};
    const mesh_field field = {"heat", value};
    const mesh_extra extra = {uv, NULL, color, &field, 1, NULL};
    static const char header[] =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty "
        "double y\nproperty double z\nproperty double heat\nproperty double s\nproperty double "
        "t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face "
        "1\nproperty list uchar int vertex_indices\nend_header\n";
    binary_t b;
    memset(&b, 0, sizeof b);
    put_text(&b, header);
    for (int v = 0; v < 3; v++) {
        for (int d = 0; d < 3; d++) {
            put_double(&b, xyz[3 * v + d]);
        }
        put_double(&b, value[v]);
        put_double(&b, uv[2 * v]);
        put_double(&b, uv[2 * v + 1]);
        put_bits(&b, color[v].r, 1);
        put_bits(&b, color[v].g, 1);
        put_bits(&b, color[v].b, 1);
    }
    put_bits(&b, 3, 1);
    for (int c = 0; c < 3; c++) {
        put_bits(&b, (uint64_t)c, 4);
    }
    size_t length = 0;
    assert_true(mesh_write(files_path("t.ply"), &m, &extra, NULL, 0));
    char *got = files_get(files_path("t.ply"), &length);
    assert_int_equal(length, b.length);
    assert_memory_equal(got, b.bytes, length);
    free(got);
}

static void obj_lines_are_as_specified(void **state) {
    (void)state;
    double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, value[3] = {2, 4, 3}, uv[6] = {0, 0, 0.5, 0, 0, 1};
    sl_int faces[3] = {2, 0, 1};
    const mesh m = {3, 1, xyz, faces};
    const rgb color[3] = {{255, 0, 51}, {0, 0, 0}, {0, 0, 0}};
    const mesh_field field = {"heat", value};
    const mesh_extra all = {uv, NULL, color, &field, 1, NULL},
                     scalar = {NULL, NULL, NULL, &field, 1, NULL};
    size_t length = 0;
    assert_true(mesh_write(files_path("t.obj"), &m, &all, NULL, 0));
    char *got = files_get(files_path("t.obj"), &length);
    assert_string_equal(got, "v 0 0 0 1.0000 0.0000 0.2000\nv 1 0 0 0.0000 0.0000 0.0000\n"
                             "v 0 1 0 0.0000 0.0000 0.0000\nvt 0 0\nvt 0.5 0\nvt 0 1\n"
                             "f 3/3 1/1 2/2\n#field heat\n#f 2\n#f 4\n#f 3\n");
    free(got);
    assert_true(mesh_write(files_path("t.obj"), &m, &scalar, NULL, 0));
    got = files_get(files_path("t.obj"), &length);
    assert_string_equal(got, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0.5 0\n"
                             "f 3/3 1/1 2/2\n#field heat\n#f 2\n#f 4\n#f 3\n");
    free(got);
}

/* glTF is in single precision, with the faces as they are. */
static void written_files_are_read_back(void **state) {
    (void)state;
    static const char *const names[4] = {"w.glb", "w.gltf", "w.glb.gz", "w.gltf.gz"};
    mesh m, back;
    char message[300], note[300];
    assert_true(surface_generate(&m, "blob:2", NULL, 0));
    size_t n = (size_t)m.n_vertices;
    memcpy(m.xyz + 3, m.xyz, 3 * sizeof *m.xyz); /* equal coordinates stay apart */
    double *value = test_reals(n), *uv = test_reals(2 * n);
    rgb *color = (rgb *)test_array(n, sizeof *color);
    value[0] = NAN;
    value[1] = 1e300;
    const mesh_field fields[2] = {{"heat", value}, {"a_long_name_of_a_field", value}};
    const mesh_extra extra[3] = {{NULL, NULL, NULL, NULL, 0, NULL},
                                 {uv, NULL, NULL, fields, 2, NULL},
                                 {uv, NULL, color, fields, 1, NULL}};
    for (int k = 0; k < 12; k++) {
        const char *path = files_path(names[k % 4]);
        assert_true(mesh_write(path, &m, &extra[k / 4], message, sizeof message));
        assert_true(mesh_read_noting(&back, path, message, sizeof message, note, sizeof note));
        assert_string_equal(note, "");
        assert_true(back.n_vertices == m.n_vertices && back.n_faces == m.n_faces);
        assert_memory_equal(back.faces, m.faces, 3 * (size_t)m.n_faces * sizeof *m.faces);
        for (size_t i = 0; i < 3 * n; i++) {
            assert_true(back.xyz[i] == (double)(float)m.xyz[i]);
        }
        mesh_free(&back);
    }
    m.xyz[1] = NAN;
    assert_false(mesh_write(files_path("w.glb"), &m, NULL, message, sizeof message));
    assert_non_null(strstr(message, "not finite"));
    mesh_free(&m);
    assert_true(mesh_write(files_path("w.gltf"), &m, NULL, message, sizeof message));
    assert_true(mesh_read(&back, files_path("w.gltf"), message, sizeof message));
    assert_int_equal(back.n_vertices, 0);
    free(color);
    free(uv);
    free(value);
}

/* A sphere that is far away, tiny, huge or both keeps its shape in single precision: vertices stay
 * within 2^-23 of its radius, as they do at the origin. */
static void gltf_keeps_the_shape_of_any_mesh(void **state) {
    (void)state;
    static const double cases[][2] = {{5e6, 1},   {-3e12, 1e3}, {0, 1e-60},
                                      {0, 1e200}, {1e60, 1e50}, {1e-50, 1e-60}};
    mesh m, back;
    char message[300];
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double radius = cases[k][1];
        assert_true(surface_generate(&m, "sphere:2", NULL, 0));
        for (size_t i = 0; i < 3 * (size_t)m.n_vertices; i++) {
            m.xyz[i] = cases[k][0] + radius * m.xyz[i];
        }
        for (int form = 0; form < 2; form++) {
            const char *path = files_path(form == 0 ? "far.glb" : "far.gltf");
            assert_true(mesh_write(path, &m, NULL, message, sizeof message));
            assert_true(mesh_read(&back, path, message, sizeof message));
            assert_int_equal(back.n_vertices, m.n_vertices);
            for (size_t i = 0; i < 3 * (size_t)m.n_vertices; i++) {
                const double rounding = 4 * fabs(m.xyz[i]) * DBL_EPSILON;
                assert_true(fabs(back.xyz[i] - m.xyz[i]) <= 0x1p-23 * radius + rounding);
            }
            mesh_free(&back);
        }
        mesh_free(&m);
    }
}

/* The numbers of an attribute of a .glb file, by its accessor, which is its array and its view. */
static float *gltf_floats(const char *path, const char *name, size_t *count) {
    size_t length = 0;
    char *file = files_get(path, &length), key[64];
    uint32_t words[5];
    unsigned long long offset = 0, bytes = 0;
    memcpy(words, file, sizeof words);
    (void)snprintf(key, sizeof key, "\"%s\":", name);
    const char *at = strstr(file + 20, key), *view = strstr(file + 20, "\"bufferViews\":[");
    *count = 0;
    if (at == NULL) {
        free(file);
        return NULL;
    }
    for (int k = atoi(at + strlen(key)); k >= 0; k--) {
        view = strstr(view + 1, "{\"buffer\":0");
        assert_non_null(view);
    }
    assert_int_equal(
        sscanf(view, "{\"buffer\":0,\"byteOffset\":%llu,\"byteLength\":%llu", &offset, &bytes), 2);
    float *values = (float *)test_array(bytes / 4 + 1, sizeof *values);
    memcpy(values, file + 28 + words[3] + offset, bytes);
    *count = bytes / 4;
    free(file);
    return values;
}

/* Where there is no value, glTF has the lowest number and a 0 in _HAS_NAME; a field and texture
 * coordinates without gaps have no such attribute. In OBJ the faces there have no texture. */
static void missing_values_stay_missing(void **state) {
    (void)state;
    double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    double heat[4] = {NAN, 2, 0, INFINITY}, full[4] = {0, 1e300, -2, 3}, uv[8] = {0};
    sl_int faces[6] = {0, 1, 2, 2, 1, 3};
    const mesh m = {4, 2, xyz, faces};
    const mesh_field fields[2] = {{"heat", heat}, {"full", full}};
    uv[3] = NAN;
    const mesh_extra extra = {uv, NULL, NULL, fields, 2, NULL},
                     scalar = {NULL, NULL, NULL, fields, 1, NULL};
    const struct {
        const char *name;
        size_t count;
        float value[8];
    } wanted[] = {{"_HEAT", 4, {-FLT_MAX, 2, 0, -FLT_MAX}},
                  {"_HAS_HEAT", 4, {0, 1, 1, 0}},
                  {"_FULL", 4, {0, FLT_MAX, -2, 3}},
                  {"_HAS_FULL", 0, {0}},
                  {"TEXCOORD_0", 8, {0, 0, 0, -FLT_MAX, 0, 0, 0, 0}},
                  {"_HAS_TEXCOORD_0", 4, {1, 0, 1, 1}}};
    assert_int_equal(mesh_missing(heat, 1, 4), 2);
    assert_int_equal(mesh_missing(uv, 2, 4), 1);
    assert_true(mesh_write(files_path("gaps.glb"), &m, &extra, NULL, 0));
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++) {
        size_t count = 0;
        float *value = gltf_floats(files_path("gaps.glb"), wanted[k].name, &count);
        assert_int_equal(count, wanted[k].count);
        assert_true(count == 0 || memcmp(value, wanted[k].value, count * sizeof *value) == 0);
        free(value);
    }
    size_t length = 0;
    heat[3] = 1;
    assert_true(mesh_write(files_path("gaps.obj"), &m, &scalar, NULL, 0));
    char *got = files_get(files_path("gaps.obj"), &length);
    assert_non_null(strstr(got, "\nf 1 2 3\nf 3/3 2/2 4/4\n#field heat\n#f nan\n#f 2\n"));
    free(got);
}

/* A mesh of an OBJ file keeps its lines: polygons, groups, comments, texture coordinates, normals.
 * Without texture coordinates the field is added to the faces. Read back and written again, the
 * file is the same. */
static void obj_files_keep_their_lines(void **state) {
    (void)state;
    static const char *const texts[2][2] = {
        {"# by hand\ng front\nv 0 0 0\nv 1 0 0 1\nv 1 1 0\nv 0 1 0\nvt 0.5 0.25\nusemtl red\n"
         "f 1/1 2/1 3/1 4/1\ng back\nv 0 0 1\nf -1 \\\n  1//1 2\ns 1\n",
         "# by hand\ng front\nv 7 0 0\nv 1 0 0 1\nv 1 1 0\nv 0 1 0\nvt 0.5 0.25\nusemtl red\n"
         "f 1/1 2/1 3/1 4/1\ng back\nv 0 0 1\nf -1 \\\n  1//1 2\ns 1\n"
         "#field heat\n#f 0\n#f 4\n#f 2\n#f 1\n#f nan\n"},
        {"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no a\nf 1 2//9 3 4\nv 0 0 1\nf -1 1 2\n",
         "vt 0 0\nvt 1 0\nvt 0.5 0\nvt 0.25 0\nvt 0 0\n"
         "v 7 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no a\nf 1/1 2/2/9 3/3 4/4\nv 0 0 1\nf 5 1 2\n"
         "#field heat\n#f 0\n#f 4\n#f 2\n#f 1\n#f nan\n"}};
    const double heat[5] = {0, 4, 2, 1, NAN};
    const mesh_field field = {"heat", heat};
    for (int k = 0; k < 2; k++) {
        mesh m;
        size_t length;
        char message[300], source[FILE_PATH_SIZE + 100];
        (void)snprintf(source, sizeof source, "%s", files_put_text("source.obj", texts[k][0]));
        const mesh_extra extra = {NULL, NULL, NULL, &field, 1, source};
        for (int pass = 0; pass < 2; pass++) {
            assert_true(mesh_read(&m, source, message, sizeof message));
            m.xyz[0] = 7;
            assert_true(mesh_write(files_path("kept.obj"), &m, &extra, message, sizeof message));
            char *got = files_get(files_path("kept.obj"), &length);
            got[length] = '\0';
            assert_string_equal(got, texts[k][1]);
            free(got);
            m.n_faces--; /* other faces than those of the file: its lines are of no use */
            assert_true(mesh_write(files_path("other.obj"), &m, &extra, message, sizeof message));
            got = files_get(files_path("other.obj"), &length);
            got[length] = '\0';
            assert_null(strstr(got, "\ng "));
            assert_null(strstr(got, "\no "));
            free(got);
            mesh_free(&m);
            (void)snprintf(source, sizeof source, "%s", files_path("kept.obj"));
        }
    }
}

static void bad_paths_are_refused(void **state) {
    (void)state;
    const mesh none = {0, 0, NULL, NULL};
    char message[300];
    assert_false(mesh_write(files_path("a.off"), &none, NULL, message, sizeof message));
    assert_non_null(strstr(message, "a.off: unknown mesh format"));
    assert_false(mesh_write(files_path("no/folder.ply"), &none, NULL, message, sizeof message));
    assert_non_null(strstr(message, "cannot be written"));
    if (access("/dev/full", W_OK) == 0 && symlink("/dev/full", files_path("full.ply")) == 0) {
        assert_false(mesh_write(files_path("full.ply"), &none, NULL, message, sizeof message));
        assert_non_null(strstr(message, "full.ply: could not be written completely"));
        (void)remove(files_path("full.ply"));
    }
    assert_true(mesh_write(files_path("none.ply"), &none, NULL, message, sizeof message));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coordinates_keep_their_bits),
        cmocka_unit_test(ply_bytes_are_as_specified),
        cmocka_unit_test(obj_lines_are_as_specified),
        cmocka_unit_test(written_files_are_read_back),
        cmocka_unit_test(gltf_keeps_the_shape_of_any_mesh),
        cmocka_unit_test(missing_values_stay_missing),
        cmocka_unit_test(obj_files_keep_their_lines),
        cmocka_unit_test(bad_paths_are_refused),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
