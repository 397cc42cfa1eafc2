/* replaced_file.h: a factor that sl_save writes over an existing file */
#ifndef SL_TEST_REPLACED_FILE_H
#define SL_TEST_REPLACED_FILE_H

#include "gen_matrices.h"

#include <errno.h>

static const char old_text[] = "the old content\n";

/* Saves a factor of the grid with n rows, and leaves errno as it was. */
static inline sl_status write_grid(sl_int n, const char *path) {
    gen_matrix_t M = gen_matrix(GEN_GRID2, n, 1, 1);
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    SL_CHECK(sl_symbolic_create(&set.symbolic, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&set.factor, set.symbolic, &M.view, NULL, NULL));
    errno = 77;
    const sl_status status = sl_save(path, NULL, NULL, &set, NULL);
    assert_int_equal(errno, 77);
    sl_saved_set_free(&set);
    gen_matrix_free(&M);
    return status;
}

static inline void assert_is_saved(const char *path) {
    sl_saved_set back;
    memset(&back, 0, sizeof back);
    SL_CHECK(sl_load(&back, path, NULL, 0, SL_LOAD_CHECKED, NULL));
    sl_saved_set_free(&back);
}

#endif
