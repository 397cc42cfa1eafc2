/* test_file_faults.c: files that the system does not map, read, flush or create, by faults */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

typedef enum fault_t {
    NO_FAULT,
    FSTAT_FAILS,
    MMAP_FAILS, /* errno: fault_number */
    FSEEK_FAILS,
    FREAD_FAILS, /* after fault_number reads */
    FFLUSH_FAILS,
    FSYNC_FAILS, /* errno: fault_number */
    NO_NEW_FILE, /* the same; a file that exists can be opened */
    CHMOD_FAILS, /* and so does the next one */
    NO_UNNAMED_FILES
} fault_t;

static fault_t fault;
static int fault_number;

static int faulty_fstat(int file, struct stat *found) {
    return fault == FSTAT_FAILS ? -1 : fstat(file, found);
}

static void *faulty_mmap(void *at, size_t size, int rights, int flags, int file, off_t begin) {
    errno = fault_number;
    return fault == MMAP_FAILS ? MAP_FAILED : mmap(at, size, rights, flags, file, begin);
}

static int faulty_fseek(FILE *file, long offset, int from) {
    return fault == FSEEK_FAILS ? -1 : fseek(file, offset, from);
}

static size_t faulty_fread(void *to, size_t size, size_t count, FILE *file) {
    return fault == FREAD_FAILS && fault_number-- <= 0 ? 0 : fread(to, size, count, file);
}

static int faulty_fflush(FILE *file) {
    return fault == FFLUSH_FAILS ? EOF : fflush(file);
}

static FILE *faulty_fopen(const char *path, const char *mode) {
    if (fault == NO_NEW_FILE && strchr(mode, 'x') != NULL) {
        errno = fault_number;
        return NULL;
    }
    return fopen(path, mode);
}

static int faulty_open(const char *path, int flags, int rights) {
    return fault >= NO_NEW_FILE && (flags & O_ACCMODE) != O_RDONLY ? -1 : open(path, flags, rights);
}

static int faulty_chmod(const char *path, mode_t mode) {
    return fault == CHMOD_FAILS ? -1 : chmod(path, mode);
}

/* The header calls this one, whose declaration has the name of the system's. */
int fsync(int file) {
    errno = fault_number;
    return fault == FSYNC_FAILS && file >= 0 ? -1 : 0;
}

#define FAULTY_OPEN(path, flags, rights, ...) faulty_open(path, flags, rights)
#define fstat faulty_fstat
#define mmap faulty_mmap
#define fseek faulty_fseek
#define fread faulty_fread
#define fflush faulty_fflush
#define fopen faulty_fopen
#define chmod faulty_chmod
#define open(...) FAULTY_OPEN(__VA_ARGS__, 0, 0)

#include "tests/lib/no_kernels.h"
#define SPARSE_LOCAL_IMPLEMENTATION
#include "tests/lib/saved_set.h"
#include "tests/lib/temporary_files.h"

static const char old_text[] = "the old content\n";

static void put_old_text(void) {
    (void)files_put_text("a.slf", old_text);
}

static void assert_old_text(void) {
    size_t length;
    char *text = files_get(files_path("a.slf"), &length);
    assert_string_equal(text, old_text);
    free(text);
}

/* Saves with a fault. */
static sl_status save(const factored_t *y, fault_t which, int number) {
    fault = which;
    fault_number = number;
    const sl_status status = pair_save_file(files_path("a.slf"), y->S, y->F, NULL);
    fault = NO_FAULT;
    return status;
}

/* Loads or maps with a fault; the objects are NULL after an error. */
static sl_status load(int is_mapped, fault_t which, int number) {
    sl_symbolic *S = (sl_symbolic *)(void *)&which;
    sl_factor *F = (sl_factor *)(void *)&which;
    const char *path = files_path("a.slf");
    fault = which;
    fault_number = number;
    const sl_status status = is_mapped ? pair_map_file(&S, &F, path, SL_LOAD_VERIFIED, NULL)
                                       : pair_load_file(&S, &F, path, SL_LOAD_VERIFIED, NULL);
    fault = NO_FAULT;
    assert_true((S != NULL) == (status == SL_OK) && (F != NULL) == (status == SL_OK));
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

static void files_that_are_not_mapped_or_measured(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    SL_CHECK(save(&y, NO_FAULT, 0));
    SL_CHECK(load(1, NO_FAULT, 0));
    SL_EXPECT(SL_ERR_IO, load(1, FSTAT_FAILS, 0));
    SL_EXPECT(SL_ERR_MEMORY, load(1, MMAP_FAILS, ENOMEM));
    SL_EXPECT(SL_ERR_IO, load(1, MMAP_FAILS, EACCES));
    SL_CHECK(load(0, NO_FAULT, 0));
    SL_EXPECT(SL_ERR_IO, load(0, FSEEK_FAILS, 0));
    factored_free(&y);
}

/* The k-th read of a file fails, for every k: nothing is created and nothing is lost. */
static void files_that_are_not_read_to_their_end(void **state) {
    (void)state;
    set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 100, 0, 0, NULL);
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    const char *path = files_path("a.slf");
    sl_status status = SL_ERR_IO;
    sl_saved_set set = {0};
    int reads = 0;
    SL_CHECK(sl_save(path, NULL, NULL, set_of(&q), NULL));
    for (; status != SL_OK; reads++) {
        fault = FREAD_FAILS;
        fault_number = reads;
        status = sl_load(&set, path, NULL, 0, SL_LOAD_VERIFIED, &opt);
        fault = NO_FAULT;
        assert_true(status == SL_OK || status == SL_ERR_IO);
        assert_true((set.symbolic != NULL) == (status == SL_OK));
        if (status == SL_OK) {
            assert_same_set(&q.set, &set);
        }
        sl_saved_set_free(&set);
        COUNTER_CLEAN(&counter);
    }
    assert_true(reads > 10);
    set_case_free(&q);
}

/* A device without a flush to its medium is no error. */
static void files_that_are_not_flushed(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    put_old_text();
    SL_EXPECT(SL_ERR_IO, save(&y, FFLUSH_FAILS, 0));
    assert_old_text();
    SL_EXPECT(SL_ERR_IO, save(&y, FSYNC_FAILS, EIO));
    assert_old_text();
    static const int harmless[2] = {EINVAL, EROFS};
    for (int k = 0; k < 2; k++) {
        put_old_text();
        SL_CHECK(save(&y, FSYNC_FAILS, harmless[k]));
        SL_CHECK(load(0, NO_FAULT, 0));
    }
    factored_free(&y);
}

/* In a folder where no file can be created the old one is written in place; without space it is
 * left alone. */
static void files_that_cannot_be_created(void **state) {
    (void)state;
    static const int forbidden[4] = {EACCES, EPERM, EROFS, ENAMETOOLONG};
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    for (int k = 0; k < 4; k++) {
        put_old_text();
        SL_CHECK(save(&y, NO_NEW_FILE, forbidden[k]));
        SL_CHECK(load(0, NO_FAULT, 0));
    }
    put_old_text();
    SL_EXPECT(SL_ERR_IO, save(&y, NO_NEW_FILE, ENOSPC));
    assert_old_text();
    factored_free(&y);
}

/* A file that cannot get the permissions of the old one does not take its place. */
static void permissions_that_cannot_be_kept(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    static const fault_t faults[3] = {NO_FAULT, NO_UNNAMED_FILES, CHMOD_FAILS};
    for (int k = 0; k < 3; k++) {
        struct stat before, after;
        put_old_text();
        assert_int_equal((chmod)(files_path("a.slf"), 0601), 0);
        assert_int_equal(stat(files_path("a.slf"), &before), 0);
        SL_CHECK(save(&y, faults[k], 0));
        assert_int_equal(stat(files_path("a.slf"), &after), 0);
        assert_int_equal(after.st_mode, before.st_mode);
        assert_int_equal(after.st_ino == before.st_ino, faults[k] == CHMOD_FAILS);
        SL_CHECK(load(0, NO_FAULT, 0));
    }
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_that_are_not_mapped_or_measured),
        cmocka_unit_test(files_that_are_not_read_to_their_end),
        cmocka_unit_test(files_that_are_not_flushed),
        cmocka_unit_test(files_that_cannot_be_created),
        cmocka_unit_test(permissions_that_cannot_be_kept),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
