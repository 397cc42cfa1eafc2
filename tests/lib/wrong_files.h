/* wrong_files.h: files that sl_error_text has a sentence for: saved factors, Matrix Market */
#ifndef SL_TEST_WRONG_FILES_H
#define SL_TEST_WRONG_FILES_H

#include "temporary_files.h"
#include "wrong_calls.h"

/* ---- saved factors ---- */

static inline sl_status load(const char *path) {
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    const sl_status status = sl_load(&set, path, NULL, 0, SL_LOAD_VERIFIED, NULL);
    assert_null(set.symbolic);
    return status;
}

/* Saves the factor, changes a byte at a position, counted from the end if it is huge, and cuts the
 * file off at `length`. */
static inline sl_status load_changed(size_t length, size_t position, int change) {
    sl_saved_set set;
    size_t size;
    char *bytes;
    memset(&set, 0, sizeof set);
    set.symbolic = w.y.S;
    set.factor = w.y.F;
    SL_CHECK(sl_save(files_path("a.slf"), NULL, NULL, &set, NULL));
    bytes = files_get(files_path("a.slf"), &size);
    position = position < size ? position : size + position;
    bytes[position] = (char)(bytes[position] ^ change);
    const char *path = files_put("a.slf", bytes, length < size ? length : size);
    free(bytes);
    return load(path);
}

WRONG(no_file) {
    (void)stats;
    return load(files_path("none.slf"));
}

WRONG(junk) {
    (void)stats;
    return load(files_put_text("junk.slf", "hello"));
}

WRONG(long_junk) {
    char text[1000];
    (void)stats;
    memset(text, 'x', sizeof text);
    return load(files_put("junk.slf", text, sizeof text));
}

WRONG(empty_file) {
    (void)stats;
    return load(files_put_text("empty.slf", ""));
}

WRONG(short_file) {
    (void)stats;
    return load_changed(20, 0, 0);
}

WRONG(cut_file) {
    (void)stats;
    return load_changed(3000, 0, 0);
}

WRONG(changed_file) {
    (void)stats;
    return load_changed((size_t)-1, (size_t)-9, 1);
}

WRONG(no_folder) {
    sl_saved_set set;
    (void)stats;
    memset(&set, 0, sizeof set);
    set.symbolic = w.y.S;
    return sl_save(files_path("no/folder/a.slf"), NULL, NULL, &set, NULL);
}

WRONG(mapped) {
    sl_saved_set set, got;
    memset(&set, 0, sizeof set);
    memset(&got, 0, sizeof got);
    set.symbolic = w.y.S;
    set.factor = w.y.F;
    SL_CHECK(sl_save(files_path("a.slf"), NULL, NULL, &set, NULL));
    SL_CHECK(sl_load(&got, files_path("a.slf"), NULL, 0, SL_LOAD_MAPPED, NULL));
    const sl_status status = sl_factor_refactor(got.factor, &w.y.M.view, stats);
    sl_saved_set_free(&got);
    return status;
}

/* ---- Matrix Market ---- */

static inline sl_status read_text(const char *text, sl_stats *stats) {
    sl_matrix *M = NULL;
    return sl_matrix_read(&M, files_put_text("a.mtx", text), NULL, stats);
}

WRONG(no_matrix) {
    sl_matrix *M = NULL;
    return sl_matrix_read(&M, files_path("none.mtx"), NULL, stats);
}

WRONG(no_matrix_market) {
    return read_text("hello\n", stats);
}

WRONG(entry_from_0) {
    return read_text("%%MatrixMarket matrix coordinate real general\n2 2 2\n0 1 3\n1 2 4\n", stats);
}

WRONG(too_few_entries) {
    return read_text("%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 3\n", stats);
}

WRONG(too_many_entries) {
    return read_text("%%MatrixMarket matrix coordinate real general\n2 2 1\n1 1 3\n2 2 4\n", stats);
}

#endif
