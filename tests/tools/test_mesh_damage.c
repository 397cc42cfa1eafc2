/* test_mesh_damage.c: mesh files of every format gzipped, cut at every byte, and damaged at random */
#define _POSIX_C_SOURCE 200809L
#include "pyramid.h"

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

static void gz_is_read_alike(void **state) {
    (void)state;
    sample_t list[5];
    for (size_t s = samples(list); s-- > 0;) {
        char name[40];
        (void)snprintf(name, sizeof name, "%s.gz", list[s].name);
        is_pyramid(files_put_gz(name, list[s].bytes, list[s].length));
        (void)snprintf(name, sizeof name, "%s.GZ", list[s].name);
        is_pyramid(files_put_gz(name, list[s].bytes, list[s].length));
        is_pyramid(files_put(name, list[s].bytes, list[s].length)); /* only called .gz */
    }
}

/* A text may be cut behind its last needed digit and still be whole; a list of faces without counts anywhere. */
static void truncated_anywhere(void **state) {
    (void)state;
    sample_t list[5];
    for (size_t s = samples(list); s-- > 0;) {
        for (size_t length = 0; length < list[s].length; length++) {
            bool read = is_sound(files_put(list[s].name, list[s].bytes, length));
            assert_false(read && s > 0 && length + (s > 2 ? 0 : 1) < list[s].length);
        }
    }
}

static void truncated_gz_is_refused(void **state) {
    (void)state;
    size_t length = 0;
    char *packed = files_get(files_put_gz("whole.obj.gz", obj_plain, strlen(obj_plain)), &length);
    for (size_t cut = 0; cut < length; cut++) {
        assert_false(is_sound(files_put("cut.obj.gz", packed, cut)));
    }
    packed[length - 8] ^= 1; /* a bit of the checksum */
    is_refused(files_put("cut.obj.gz", packed, length), "cannot be read");
    free(packed);
}

static void damaged_at_random(void **state) {
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
            (void)is_sound(files_put(list[s].name, bytes, list[s].length));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gz_is_read_alike),
        cmocka_unit_test(truncated_anywhere),
        cmocka_unit_test(truncated_gz_is_refused),
        cmocka_unit_test(damaged_at_random),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
