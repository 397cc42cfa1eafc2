/* test_save_file.c: saved factors in files: replaced as a whole or not at all, mapped, shared */
#define _XOPEN_SOURCE 700
#include "tests/lib/temporary_files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>

#include "tests/lib/saved_set.h"

/* ---- saving ---- */

/* Files in the folder of the test other than a.slf. */
static int other_files(void) {
    dataset all;
    int count = 0;
    assert_true(dataset_list(&all, files_folder, NULL));
    for (size_t k = 0; k < all.count; k++) {
        const char *name = strrchr(all.paths[k], '/');
        count += name == NULL || strcmp(name, "/a.slf") != 0;
    }
    dataset_free(&all);
    return count;
}

static void assert_file_holds(const char *path, const factored_t *y) {
    saved_t m = saved_make(y->S, y->F);
    size_t length = 0;
    char *bytes = files_get(path, &length);
    assert_int_equal(length, m.size);
    assert_memory_equal(bytes, m.bytes, m.size);
    free(bytes);
    saved_free(&m);
}

static void a_file_has_the_bytes_of_memory(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL),
               z = factored_make(GEN_PATH, 30, 1, 0, NULL);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    struct stat found;
    errno = 77;
    SL_CHECK(pair_save_file(files_path("a.slf"), y.S, y.F, NULL));
    assert_file_holds(files_path("a.slf"), &y);
    assert_int_equal(chmod(files_path("a.slf"), 0640), 0);
    SL_CHECK(pair_save_file(files_path("a.slf"), z.S, z.F, NULL)); /* shorter than the old one */
    assert_file_holds(files_path("a.slf"), &z);
    assert_int_equal(stat(files_path("a.slf"), &found), 0);
    assert_int_equal(found.st_mode & 0777, 0640);
    SL_CHECK(pair_save_file(files_path("a.slf"), y.S, y.F, NULL));
    assert_int_equal(other_files(), 0);
    for (int checks = 0; checks < 3; checks++) {
        SL_CHECK(pair_load_file(&S, &F, files_path("a.slf"), (unsigned)checks, NULL));
        assert_same_answers(y.F, F);
        SL_CHECK(sl_factor_refactor(F, &y.M.view, NULL));
        sl_factor_free(F);
        SL_CHECK(sl_factor_create(&F, S, &y.M.view, NULL, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
        SL_CHECK(pair_map_file(&S, &F, files_path("a.slf"), (unsigned)checks, NULL));
        assert_same_answers(y.F, F);
        SL_EXPECT(SL_ERR_READ_ONLY, sl_factor_refactor(F, &y.M.view, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
        SL_CHECK(pair_load_file(&S, NULL, files_path("a.slf"), (unsigned)checks, NULL));
        sl_symbolic_free(S);
        SL_CHECK(pair_map_file(&S, NULL, files_path("a.slf"), (unsigned)checks, NULL));
        sl_symbolic_free(S);
    }
    assert_int_equal(errno, 77);
    factored_free(&y);
    factored_free(&z);
}

static void a_mapped_file_may_be_replaced(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL),
               z = factored_make(GEN_PATH, 30, 1, 0, NULL);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(pair_save_file(files_path("a.slf"), y.S, y.F, NULL));
    SL_CHECK(pair_map_file(&S, &F, files_path("a.slf"), SL_LOAD_CHECKED, NULL));
    SL_CHECK(pair_save_file(files_path("a.slf"), z.S, z.F, NULL));
    assert_same_answers(y.F, F); /* still the old file */
    assert_file_holds(files_path("a.slf"), &z);
    SL_CHECK(pair_save_file(files_path("a.slf"), S, F, NULL)); /* a mapped factor, saved */
    assert_file_holds(files_path("a.slf"), &y);
    assert_int_equal(remove(files_path("a.slf")), 0);
    assert_same_answers(y.F, F);
    sl_factor_free(F);
    sl_symbolic_free(S);
    factored_free(&y);
    factored_free(&z);
}

static void errors_leave_the_old_file(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 900, 1, 0, NULL);
    struct rlimit all, small;
    static const rlim_t limits[] = {0, 100, 1300, 20000};
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &all), 0);
    void (*old_action)(int) = signal(SIGXFSZ, SIG_IGN);
    for (size_t k = 0; k < sizeof limits / sizeof *limits; k++) {
        (void)files_put_text("a.slf", "the old content\n");
        small = all;
        small.rlim_cur = limits[k];
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
        SL_EXPECT(SL_ERR_IO, pair_save_file(files_path("a.slf"), y.S, y.F, NULL));
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &all), 0);
        size_t length = 0;
        char *text = files_get(files_path("a.slf"), &length);
        assert_string_equal(text, "the old content\n");
        free(text);
        assert_int_equal(other_files(), 0);
    }
    (void)signal(SIGXFSZ, old_action);
    if (access("/dev/full", W_OK) == 0) {
        SL_EXPECT(SL_ERR_IO, pair_save_file("/dev/full", y.S, y.F, NULL));
        SL_CHECK(pair_save_file("/dev/null", y.S, y.F, NULL));
    }
    SL_EXPECT(SL_ERR_IO, pair_save_file(files_path("no/such/folder"), y.S, y.F, NULL));
    SL_EXPECT(SL_ERR_IO, pair_save_file(files_folder, y.S, y.F, NULL));
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    counter.fail_at = 0;
    SL_EXPECT(SL_ERR_MEMORY, pair_save_file(files_path("a.slf"), y.S, y.F, &opt));
    COUNTER_CLEAN(&counter);
    factored_free(&y);
}

/* A file is one of two saved factors, whole. */
static void assert_whole(const char *path, const saved_t *first, const saved_t *second) {
    size_t length = 0;
    char *bytes = files_get(path, &length);
    const saved_t *whole = length == first->size ? first : second;
    assert_int_equal(length, whole->size);
    assert_memory_equal(bytes, whole->bytes, length);
    free(bytes);
}

/* A child saves again and again, and is killed at random moments. On Linux a file gets a name only
 * when it is complete: a second one, and at once that of the old file. */
static void a_killed_save_leaves_the_old_file(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 40000, 1, 0, NULL),
               z = factored_make(GEN_GRID2, 22500, 1, 0, NULL);
    saved_t first = saved_make(y.S, y.F), second = saved_make(z.S, z.F);
    uint64_t random = 7;
    SL_CHECK(pair_save_file(files_path("a.slf"), y.S, y.F, NULL));
    for (int k = 0; k < 50; k++) {
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            for (;;) {
                if (pair_save_file(files_path("a.slf"), z.S, z.F, NULL) != SL_OK ||
                    pair_save_file(files_path("a.slf"), y.S, y.F, NULL) != SL_OK) {
                    _exit(1);
                }
            }
        }
        struct timespec wait = {0, (long)(files_random(&random) % 30000000)};
        (void)nanosleep(&wait, NULL);
        int status = 0;
        assert_int_equal(kill(child, SIGKILL), 0);
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFSIGNALED(status));
        assert_whole(files_path("a.slf"), &first, &second);
        if (other_files() > 0) { /* killed just before the file takes the name of the old one */
#if defined(__linux__) && defined(__O_TMPFILE) && defined(__GNUC__)
            assert_whole(files_path("a.slf.tmp00"), &first, &second);
#endif
            (void)remove(files_path("a.slf.tmp00"));
            assert_int_equal(other_files(), 0);
        }
    }
    saved_free(&first);
    saved_free(&second);
    factored_free(&y);
    factored_free(&z);
}

/* ---- loading ---- */

static void what_is_no_saved_factor_is_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    saved_t m = saved_make(y.S, y.F);
    sl_status (*calls[2])(sl_symbolic **, sl_factor **, const char *, unsigned,
                          const sl_options *) = {pair_load_file, pair_map_file};
    for (int k = 0; k < 2; k++) {
        sl_symbolic *S = y.S;
        sl_factor *F = y.F;
        SL_EXPECT(SL_ERR_ARGUMENT, calls[k](&S, &F, NULL, SL_LOAD_CHECKED, NULL));
        assert_true(S == NULL && F == NULL);
        SL_EXPECT(SL_ERR_ARGUMENT, calls[k](&S, &F, "x", (unsigned)9, NULL));
        SL_EXPECT(SL_ERR_IO, calls[k](&S, &F, files_path("none.slf"), SL_LOAD_CHECKED, NULL));
        SL_EXPECT(SL_ERR_IO, calls[k](&S, &F, files_folder, SL_LOAD_CHECKED, NULL));
        (void)files_put("a.slf", "", 0);
        SL_EXPECT(SL_ERR_IO, calls[k](&S, &F, files_path("a.slf"), SL_LOAD_CHECKED, NULL));
        if (access("/dev/zero", R_OK) == 0) {
            SL_EXPECT(SL_ERR_IO, calls[k](&S, &F, "/dev/zero", SL_LOAD_CHECKED, NULL));
        }
        (void)files_put("a.slf", m.bytes, m.size - 64);
        SL_EXPECT(SL_ERR_IO, calls[k](&S, &F, files_path("a.slf"), SL_LOAD_TRUSTED, NULL));
        m.bytes[0] ^= 1;
        (void)files_put("a.slf", m.bytes, m.size);
        m.bytes[0] ^= 1;
        SL_EXPECT(SL_ERR_UNSUPPORTED, calls[k](&S, &F, files_path("a.slf"), SL_LOAD_TRUSTED, NULL));
        m.bytes[m.size - 3000] ^= 1;
        (void)files_put("a.slf", m.bytes, m.size);
        m.bytes[m.size - 3000] ^= 1;
        SL_EXPECT(SL_ERR_IO, calls[k](&S, &F, files_path("a.slf"), SL_LOAD_VERIFIED, NULL));
        for (int64_t at = 0, done = 0; !done; at++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            (void)files_put("a.slf", m.bytes, m.size);
            counter.fail_at = at;
            sl_status status = calls[k](&S, &F, files_path("a.slf"), SL_LOAD_CHECKED, &opt);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            assert_true((S != NULL) == (status == SL_OK) && (F != NULL) == (status == SL_OK));
            done = status == SL_OK;
            counter.fail_at = -1;
            if (done) {
                assert_same_answers(y.F, F);
            }
            sl_factor_free(F);
            sl_symbolic_free(S);
            COUNTER_CLEAN(&counter);
        }
    }
    saved_free(&m);
    factored_free(&y);
}

/* Files of every released version stay in the corpus, and load for ever. */
static void files_of_all_versions_are_read(void **state) {
    (void)state;
    dataset all;
    int count = 0, inverses = 0, regions = 0;
    if (!dataset_list(&all, "tests/fuzz/corpus/saved", NULL)) {
        TEST_SKIP("there is no folder tests/fuzz/corpus/saved");
    }
    for (size_t k = 0; k < all.count; k++) {
        if (strstr(all.paths[k], ".slf") == NULL) {
            continue;
        }
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        double b[100] = {1}, x[100];
        SL_CHECK(pair_load_file(&S, &F, all.paths[k], SL_LOAD_VERIFIED, NULL));
        const sl_int n = sl_symbolic_view(S).n;
        assert_true(n > 1 && n <= 100);
        b[1] = -1;
        if (F != NULL) {
            SL_CHECK(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 1, NULL));
            assert_true(x[0] == x[0]);
        }
        count++;
        sl_factor_free(F);
        sl_symbolic_free(S);
        sl_saved_set set = {0};
        SL_CHECK(sl_load(&set, all.paths[k], NULL, 0, SL_LOAD_VERIFIED, NULL));
        inverses += set.selected != NULL;
        regions += set.n_regions;
        for (sl_int m = 0; m < set.n_regions; m++) {
            const sl_region_arrays r = sl_region_view(set.regions[m]);
            assert_null(check_region(set.regions[m], r.boundary, r.n_boundary));
        }
        if (set.selected != NULL) {
            const sl_selected_arrays z = sl_selected_view(set.selected);
            for (sl_off p = 0; p < z.begin[z.count]; p++) {
                assert_true(z.Z[p] == z.Z[p]);
            }
        }
        sl_saved_set_free(&set);
    }
    dataset_free(&all);
    assert_true(count >= 25 && inverses >= 8 && regions >= 18);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_has_the_bytes_of_memory),
        cmocka_unit_test(a_mapped_file_may_be_replaced),
        cmocka_unit_test(errors_leave_the_old_file),
        cmocka_unit_test(a_killed_save_leaves_the_old_file),
        cmocka_unit_test(what_is_no_saved_factor_is_refused),
        cmocka_unit_test(files_of_all_versions_are_read),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
