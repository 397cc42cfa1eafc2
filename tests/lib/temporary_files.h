/* temporary_files.h: temporary files of a test program, in a folder that is removed at the end */
#ifndef SL_TEST_TEMPORARY_FILES_H
#define SL_TEST_TEMPORARY_FILES_H

/* The program defines _POSIX_C_SOURCE 200809L before its first include. */
#include "test.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zlib.h>

#include "tools/io/dataset.h"

#define FILE_PATH_SIZE 512

static char files_folder[FILE_PATH_SIZE];

/* Creates a folder and its missing parents. */
static inline void files_make_folders(const char *path) {
    char part[FILE_PATH_SIZE];
    for (size_t k = 0; path[k] != '\0' && k + 1 < sizeof part; k++) {
        part[k] = path[k];
        if (k > 0 && (path[k + 1] == '/' || path[k + 1] == '\0')) {
            part[k + 1] = '\0';
            assert_true(mkdir(part, 0777) == 0 || errno == EEXIST);
        }
    }
}

/* Group setup: creates a new folder in $SL_TMP, or in build/tmp. */
static inline int files_set_up(void **state) {
    (void)state;
    const char *top = getenv("SL_TMP");
    top = top != NULL && top[0] != '\0' ? top : "build/tmp";
    files_make_folders(top);
    assert_true(snprintf(files_folder, sizeof files_folder, "%s/test.XXXXXX", top) <
                FILE_PATH_SIZE - 100);
    return mkdtemp(files_folder) != NULL ? 0 : -1;
}

/* Group teardown: removes the folder and its files. */
static inline int files_tear_down(void **state) {
    (void)state;
    dataset left;
    if (dataset_list(&left, files_folder, NULL)) {
        for (size_t k = 0; k < left.count; k++) {
            (void)remove(left.paths[k]);
        }
        dataset_free(&left);
    }
    return rmdir(files_folder);
}

/* The path of a file in the folder, in static storage; valid until the next call. */
static inline const char *files_path(const char *name) {
    static char path[FILE_PATH_SIZE + 100];
    (void)snprintf(path, sizeof path, "%s/%s", files_folder, name);
    return path;
}

/* Writes these bytes to a file and returns its path. */
static inline const char *files_put(const char *name, const void *bytes, size_t length) {
    const char *path = files_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fwrite(bytes, 1, length, file) == length);
    assert_int_equal(fclose(file), 0);
    return path;
}

static inline const char *files_put_text(const char *name, const char *text) {
    return files_put(name, text, strlen(text));
}

/* The same, compressed by gzip. */
static inline const char *files_put_gz(const char *name, const void *bytes, size_t length) {
    const char *path = files_path(name);
    gzFile file = gzopen(path, "wb");
    assert_non_null(file);
    assert_true(gzwrite(file, bytes, (unsigned)length) == (int)length);
    assert_int_equal(gzclose(file), Z_OK);
    return path;
}

/* The bytes of a file; the caller frees them. */
static inline char *files_get(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    long size = ftell(file);
    assert_true(size >= 0);
    rewind(file);
    char *bytes = (char *)test_array((size_t)size + 1, 1);
    assert_true(fread(bytes, 1, (size_t)size, file) == (size_t)size);
    assert_int_equal(fclose(file), 0);
    *length = (size_t)size;
    return bytes;
}

/* Lines of a text. */
static inline int files_lines(const char *text) {
    int lines = 0;
    for (const char *at = text; *at != '\0'; at++) {
        lines += *at == '\n';
    }
    return lines;
}

/* Next number of a fixed pseudo-random sequence, used to damage bytes. */
static inline uint64_t files_random(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return *state >> 33;
}

#endif
