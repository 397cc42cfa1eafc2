/* test_file_replace.c: sl_save over an existing file, by the means that every system has */
#include "tests/lib/replaced_file.h"

/* A path in the folder of the tests, in static storage: four at a time. */
static const char *path_of(const char *name) {
    static char paths[4][500];
    static int last = 0;
    const char *folder = getenv("SL_TMP");
    last = (last + 1) % 4;
    (void)snprintf(paths[last], sizeof paths[last], "%s/replace_%s",
                   folder != NULL && folder[0] != '\0' ? folder : "build", name);
    return paths[last];
}

static const char *put_old_text(const char *path) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(old_text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    return path;
}

/* The bytes of a file, closed by a 0, in static storage. */
static const char *content_of(const char *path) {
    static char text[4096];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    assert_int_equal(fclose(file), 0);
    return text;
}

static int exists(const char *path) {
    FILE *file = fopen(path, "rb");
    if (file != NULL) {
        (void)fclose(file);
    }
    return file != NULL;
}

static void an_existing_file_is_replaced(void **state) {
    (void)state;
    const char *path = put_old_text(path_of("a.slf"));
    for (int k = 0; k < 2; k++) {
        SL_CHECK(write_grid(5, path));
        assert_is_saved(path);
        assert_false(exists(path_of("a.slf.tmp00")));
    }
    assert_int_equal(remove(path), 0);
    SL_CHECK(write_grid(5, path)); /* and a new one is created */
    assert_is_saved(path);
    assert_int_equal(remove(path), 0);
}

static void taken_names_are_left_alone(void **state) {
    (void)state;
    const char *path = path_of("b.slf");
    put_old_text(path);
    put_old_text(path_of("b.slf.tmp00"));
    path = path_of("b.slf");
    SL_CHECK(write_grid(5, path));
    assert_is_saved(path);
    assert_string_equal(content_of(path_of("b.slf.tmp00")), old_text);
    assert_int_equal(remove(path_of("b.slf.tmp00")), 0);
    assert_int_equal(remove(path_of("b.slf")), 0);
}

/* Windows refuses to replace a file that a program has open; elsewhere the program keeps the old
 * content. */
static void an_open_file_is_replaced_or_kept(void **state) {
    (void)state;
    const char *path = put_old_text(path_of("d.slf"));
    FILE *reader = fopen(path, "rb");
    assert_non_null(reader);
    sl_status status = write_grid(5, path);
    char first = (char)fgetc(reader);
    assert_int_equal(fclose(reader), 0);
    assert_int_equal(first, old_text[0]);
    assert_false(exists(path_of("d.slf.tmp00")));
#if defined(_WIN32)
    assert_int_equal(status, SL_ERR_IO);
    assert_string_equal(content_of(path), old_text);
#else
    assert_int_equal(status, SL_OK);
    assert_is_saved(path);
#endif
    assert_int_equal(remove(path_of("d.slf")), 0);
}

static void what_is_no_file_is_written_in_place_or_refused(void **state) {
    (void)state;
#if defined(_WIN32)
    SL_CHECK(write_grid(5, "NUL"));
#elif !defined(__wasi__)
    SL_CHECK(write_grid(5, "/dev/null"));
#endif
    SL_EXPECT(SL_ERR_IO, write_grid(5, path_of("no_such_folder/a.slf")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_existing_file_is_replaced),
        cmocka_unit_test(taken_names_are_left_alone),
        cmocka_unit_test(an_open_file_is_replaced_or_kept),
        cmocka_unit_test(what_is_no_file_is_written_in_place_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
