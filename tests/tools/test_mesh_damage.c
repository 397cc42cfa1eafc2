/* test_mesh_damage.c: mesh files of every format: gzipped, truncated, randomly damaged */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

#include "tools/mesh/mesh_write.h"

typedef struct sample_t {
    const char *name;
    const char *bytes;
    size_t length;
    size_t spare;     /* how much shorter the file may be */
    size_t also_ends; /* where it may end, too: a shorter file that is complete, or before */
} sample_t;

static const char vtk_ascii[] =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n" OFF_VERTICES
    "POLYGONS 5 21\n" OFF_FACES;

enum { SAMPLES = 8 };

static binary_t sample_binary[4];

/* The pyramid as mesh_write writes it. */
static binary_t written(const char *name) {
    double xyz[15];
    sl_int faces[18];
    memcpy(xyz, pyramid_xyz, sizeof xyz);
    memcpy(faces, pyramid_faces, sizeof faces);
    const mesh m = {5, 6, xyz, faces};
    binary_t b;
    memset(&b, 0, sizeof b);
    assert_true(mesh_write(files_path(name), &m, NULL, NULL, 0));
    char *bytes = files_get(files_path(name), &b.length);
    assert_true(b.length < sizeof b.bytes);
    memcpy(b.bytes, bytes, b.length);
    free(bytes);
    return b;
}

static size_t samples(sample_t list[SAMPLES]) {
    sample_binary[2] = written("w.glb");
    sample_binary[3] = written("w.gltf");
    sample_binary[0] = binary_pyramid(false, "int", 4, "\n");
    sample_binary[1] = binary_pyramid(true, "short", 2, "\r\n");
    const binary_t *b = sample_binary;
    const size_t points = (size_t)(strstr(vtk_ascii, "POLYGONS") - vtk_ascii);
    const sample_t all[SAMPLES] = {{"s.obj", obj_plain, strlen(obj_plain), 0, strlen(obj_plain)},
                                   {"s.off", OFF_TEXT, strlen(OFF_TEXT), 1, 0},
                                   {"a.ply", ply_ascii, strlen(ply_ascii), 1, 0},
                                   {"l.ply", b[0].bytes, b[0].length, 0, 0},
                                   {"b.ply", b[1].bytes, b[1].length, 0, 0},
                                   {"a.vtk", vtk_ascii, strlen(vtk_ascii), 1, points},
                                   {"c.glb", b[2].bytes, b[2].length, 0, 0},
                                   {"t.gltf", b[3].bytes, b[3].length, 1, 0}};
    memcpy(list, all, sizeof all);
    return SAMPLES;
}

static void gzipped_files_are_read(void **state) {
    (void)state;
    sample_t list[SAMPLES];
    for (size_t s = samples(list); s-- > 0;) {
        char name[40];
        (void)snprintf(name, sizeof name, "%s.gz", list[s].name);
        assert_is_pyramid(files_put_gz(name, list[s].bytes, list[s].length));
        (void)snprintf(name, sizeof name, "%s.GZ", list[s].name);
        assert_is_pyramid(files_put_gz(name, list[s].bytes, list[s].length));
        /* named .gz but not compressed */
        assert_is_pyramid(files_put(name, list[s].bytes, list[s].length));
    }
}

/* Truncated text is complete if only its last number lost digits. OBJ has no counts, so it may end
 * anywhere; VTK may end before the faces. */
static void truncated_files_are_refused(void **state) {
    (void)state;
    sample_t list[SAMPLES];
    for (size_t s = samples(list); s-- > 0;) {
        for (size_t length = 0; length < list[s].length; length++) {
            bool read = read_is_valid(files_put(list[s].name, list[s].bytes, length));
            assert_false(read && length > list[s].also_ends &&
                         length + list[s].spare < list[s].length);
        }
    }
}

static void truncated_gzip_is_refused(void **state) {
    (void)state;
    size_t length = 0;
    char *packed = files_get(files_put_gz("whole.obj.gz", obj_plain, strlen(obj_plain)), &length);
    for (size_t cut = 0; cut < length; cut++) {
        assert_false(read_is_valid(files_put("cut.obj.gz", packed, cut)));
    }
    packed[length - 8] ^= 1; /* one bit of the checksum */
    assert_is_refused(files_put("cut.obj.gz", packed, length), "cannot be read");
    free(packed);
}

static void damaged_files_are_refused_or_read(void **state) {
    (void)state;
    static const char spice[] = "-9 \n\r/#\\.ef\377";
    sample_t list[SAMPLES];
    uint64_t seed = 1;
    for (size_t s = samples(list); s-- > 0;) {
        for (int round = 0; round < 1500; round++) {
            char bytes[2048];
            memcpy(bytes, list[s].bytes, list[s].length);
            for (uint64_t k = 1 + files_random(&seed) % 4; k > 0; k--) {
                char what = files_random(&seed) % 2
                                ? spice[files_random(&seed) % (sizeof spice - 1)]
                                : (char)(files_random(&seed) % 128);
                bytes[files_random(&seed) % list[s].length] = what;
            }
            (void)read_is_valid(files_put(list[s].name, bytes, list[s].length));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gzipped_files_are_read),
        cmocka_unit_test(truncated_files_are_refused),
        cmocka_unit_test(truncated_gzip_is_refused),
        cmocka_unit_test(damaged_files_are_refused_or_read),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
