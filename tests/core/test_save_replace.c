/* test_save_replace.c: sl_save replaces a file as a whole or not at all; devices and links */
#define _XOPEN_SOURCE 700
#include "tests/lib/temporary_files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "tests/lib/replaced_file.h"

static void assert_has_old_text(const char *path) {
    size_t length = 0;
    char *text = files_get(path, &length);
    assert_int_equal(length, strlen(old_text));
    assert_memory_equal(text, old_text, length);
    free(text);
}

/* Files in the folder of the test whose names contain ".tmp". */
static int temporary_files(void) {
    dataset all;
    int count = 0;
    assert_true(dataset_list(&all, files_folder, NULL));
    for (size_t k = 0; k < all.count; k++) {
        count += strstr(all.paths[k] + strlen(files_folder), ".tmp") != NULL;
    }
    dataset_free(&all);
    return count;
}

static void an_existing_file_is_replaced_with_its_permissions(void **state) {
    (void)state;
    const mode_t modes[] = {0600, 0640, 0666, 0755};
    struct stat s;
    for (size_t k = 0; k < sizeof modes / sizeof *modes; k++) {
        const char *path = files_put_text("a.slf", old_text);
        assert_int_equal(chmod(path, modes[k]), 0);
        SL_CHECK(write_grid(5, path));
        assert_int_equal(stat(path, &s), 0);
        assert_int_equal(s.st_mode & 0777, modes[k]);
        assert_is_saved(path);
        assert_int_equal(temporary_files(), 0);
    }
}

/* A limit on the size of files stands for a full disk. */
static void without_space_the_old_file_is_left(void **state) {
    (void)state;
    struct rlimit limit, small;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    small = limit;
    small.rlim_cur = 500;
    void (*old_action)(int) = signal(SIGXFSZ, SIG_IGN);
    const sl_int sizes[] = {30, 3000}; /* fails when the file is closed; while lines are written */
    for (size_t k = 0; k < 2; k++) {
        const char *path = files_put_text("a.slf", old_text);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
        SL_EXPECT(SL_ERR_IO, write_grid(sizes[k], path));
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        assert_has_old_text(path);
        path = files_path("new.slf");
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
        SL_EXPECT(SL_ERR_IO, write_grid(sizes[k], path));
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        assert_int_equal(access(path, F_OK), -1);
        assert_int_equal(temporary_files(), 0);
    }
    (void)signal(SIGXFSZ, old_action);
}

/* Files with the names of temporary ones are somebody else's. */
static void taken_names_are_left_alone(void **state) {
    (void)state;
    char name[40];
    for (int k = 0; k < 100; k++) {
        (void)files_put_text("a.slf", old_text);
        SL_CHECK(write_grid(5, files_path("a.slf")));
        assert_is_saved(files_path("a.slf"));
        (void)snprintf(name, sizeof name, "a.slf.tmp%02d", k);
        (void)files_put_text(name, old_text);
        assert_int_equal(temporary_files(), k + 1);
    }
    (void)files_put_text("a.slf", old_text);
    SL_EXPECT(SL_ERR_IO, write_grid(5, files_path("a.slf")));
    assert_has_old_text(files_path("a.slf"));
    for (int k = 0; k < 100; k++) {
        (void)snprintf(name, sizeof name, "a.slf.tmp%02d", k);
        assert_has_old_text(files_path(name));
        assert_int_equal(remove(files_path(name)), 0);
    }
    SL_EXPECT(SL_ERR_IO, write_grid(5, "")); /* the renaming fails */
    assert_int_equal(access(".tmp00", F_OK), -1);
}

static void links_pipes_and_devices_remain(void **state) {
    (void)state;
    struct stat s;
    (void)files_put_text("a.slf", old_text);
    assert_int_equal(symlink("a.slf", files_path("link.slf")), 0);
    SL_CHECK(write_grid(5, files_path("link.slf")));
    assert_int_equal(lstat(files_path("link.slf"), &s), 0);
    assert_true(S_ISLNK(s.st_mode));
    assert_is_saved(files_path("a.slf"));

    char bytes[4];
    const char *pipe_path = files_path("pipe.slf");
    assert_int_equal(mkfifo(pipe_path, 0600), 0);
    int reader = open(pipe_path, O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    SL_CHECK(write_grid(2, pipe_path));
    assert_int_equal(read(reader, bytes, 4), 4);
    assert_memory_equal(bytes, "\x89SLF", 4);
    assert_int_equal(close(reader), 0);
    assert_int_equal(stat(pipe_path, &s), 0);
    assert_true(S_ISFIFO(s.st_mode));
    assert_int_equal(remove(pipe_path), 0);

    SL_CHECK(write_grid(5, "/dev/null"));
    assert_int_equal(stat("/dev/null", &s), 0);
    assert_true(S_ISCHR(s.st_mode));
    if (access("/dev/full", W_OK) == 0) {
        assert_int_equal(symlink("/dev/full", files_path("full.slf")), 0);
        SL_EXPECT(SL_ERR_IO, write_grid(5, files_path("full.slf")));
        SL_EXPECT(SL_ERR_IO, write_grid(5, "/dev/full"));
        assert_int_equal(stat("/dev/full", &s), 0);
        assert_true(S_ISCHR(s.st_mode));
        assert_int_equal(remove(files_path("full.slf")), 0);
    }
    SL_EXPECT(SL_ERR_IO, write_grid(5, files_folder));
    assert_int_equal(temporary_files(), 0);
}

/* Root is refused nothing, so it becomes another user for a while. */
static void permissions_are_respected(void **state) {
    (void)state;
    const uid_t other = 65534;
    const bool is_root = geteuid() == 0;
    char locked[FILE_PATH_SIZE + 100], in_locked[FILE_PATH_SIZE + 100];
    struct stat s;
    (void)snprintf(locked, sizeof locked, "%s", files_path("locked"));
    assert_int_equal(mkdir(locked, 0777), 0);
    (void)snprintf(in_locked, sizeof in_locked, "%s", files_put_text("locked/a.slf", old_text));
    assert_int_equal(chmod(in_locked, 0666), 0);
    assert_int_equal(chmod(files_put_text("others.slf", old_text), 0666), 0);
    assert_int_equal(chmod(files_put_text("shut.slf", old_text), 0444), 0);
    assert_int_equal(chmod(locked, 0555), 0);
    if (is_root) {
        assert_int_equal(chown(files_folder, other, (gid_t)-1), 0);
        assert_int_equal(seteuid(other), 0);
    }
    FILE *reached = fopen(files_path("others.slf"), "rb");
    if (reached != NULL) {
        (void)fclose(reached);
        SL_EXPECT(SL_ERR_IO, write_grid(5, files_path("locked/new.slf")));
        SL_CHECK(write_grid(5, in_locked));
        assert_is_saved(in_locked);
        SL_EXPECT(SL_ERR_IO, write_grid(5, files_path("shut.slf")));
        assert_has_old_text(files_path("shut.slf"));
        SL_CHECK(write_grid(5, files_path("others.slf")));
        assert_is_saved(files_path("others.slf"));
        assert_int_equal(temporary_files(), 0);
    }
    if (is_root) {
        assert_int_equal(seteuid(0), 0);
        assert_int_equal(chown(files_folder, 0, (gid_t)-1), 0);
        assert_int_equal(stat(files_path("others.slf"), &s), 0);
        assert_int_equal(s.st_uid, 0);
    }
    assert_int_equal(chmod(locked, 0755), 0);
    assert_int_equal(remove(in_locked), 0);
    assert_int_equal(rmdir(locked), 0);
    if (reached == NULL) {
        TEST_SKIP("the other user may not enter the folders above");
    }
}

#if defined(__linux__)
extern int chroot(const char *path);

/* Files without a name get one by way of /proc. */
static void a_file_is_saved_without_proc(void **state) {
    (void)state;
    int code = 0;
    const pid_t child = fork();
    if (child == 0) {
        _exit(chroot(files_folder) != 0 ? 77 : write_grid(5, "/a.slf") != SL_OK);
    }
    assert_true(child > 0 && waitpid(child, &code, 0) == child && WIFEXITED(code));
    if (WEXITSTATUS(code) == 77) {
        TEST_SKIP("only root may call chroot");
    }
    assert_int_equal(WEXITSTATUS(code), 0);
    assert_is_saved(files_path("a.slf"));
    assert_int_equal(temporary_files(), 0);
}
#endif

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_existing_file_is_replaced_with_its_permissions),
        cmocka_unit_test(without_space_the_old_file_is_left),
        cmocka_unit_test(taken_names_are_left_alone),
        cmocka_unit_test(links_pipes_and_devices_remain),
        cmocka_unit_test(permissions_are_respected),
#if defined(__linux__)
        cmocka_unit_test(a_file_is_saved_without_proc),
#endif
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
