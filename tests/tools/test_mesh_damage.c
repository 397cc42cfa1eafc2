/* test_mesh_damage.c: mesh files of every format: gzipped, truncated, randomly damaged */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

typedef struct sample_t {
    const char *name;
    const char *bytes;
    size_t length;
} sample_t;

static binary_t sample_binary[2];

static size_t samples(sample_t list[5]) {
    sample_binary[0] = binary_pyramid(false, "int", 4, "\n");
    sample_binary[1] = binary_pyramid(true, "short", 2, "\r\n");
    const sample_t all[5] = {{"s.obj", obj_plain, strlen(obj_plain)},
                             {"s.off", OFF_TEXT, strlen(OFF_TEXT)},
                             {"a.ply", ply_ascii, strlen(ply_ascii)},
                             {"l.ply", sample_binary[0].bytes, sample_binary[0].length},
                             {"b.ply", sample_binary[1].bytes, sample_binary[1].length}};
    memcpy(list, all, sizeof all);
    return 5;
}

static void gzipped_files_are_read(void **state) {
    (void)state;
    sample_t list[5];
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
 * anywhere. */
static void truncated_files_are_refused(void **state) {
    (void)state;
    sample_t list[5];
    for (size_t s = samples(list); s-- > 0;) {
        for (size_t length = 0; length < list[s].length; length++) {
            bool read = read_is_valid(files_put(list[s].name, list[s].bytes, length));
            assert_false(read && s > 0 && length + (s > 2 ? 0 : 1) < list[s].length);
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
    sample_t list[5];
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
