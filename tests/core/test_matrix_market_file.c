/* test_matrix_market_file.c: Matrix Market files: round trips, buffers, memory, paths */
#define _POSIX_C_SOURCE 200809L /* mkstemp */

#include "tests/lib/matrix_text.h"

#include <unistd.h>

static int temporary_name(char *name, size_t size) {
    const char *folder = getenv("TMPDIR");
    snprintf(name, size, "%s/sparse_local_XXXXXX", folder && *folder ? folder : ".");
    int handle = mkstemp(name);
    if (handle >= 0) {
        close(handle);
    }
    return handle >= 0;
}

/* Writes a temporary file and gives its name. */
static void write_temporary(char *name, size_t size, const char *text, size_t length) {
    assert_true(temporary_name(name, size));
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

static void written_files_are_read_back(void **state) {
    (void)state;
    char name[512];
    assert_true(temporary_name(name, sizeof name));
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 30, 0, 6);
        for (int which = 0; which < 6; which++) {
            gen_matrix_t M = gen_store(&t, gen_style(which), 8);
            sl_matrix *back = NULL;
            matrix_write(&M.view, name);
            SL_CHECK(sl_matrix_read(&back, name, NULL, NULL));
            sl_csc C = sl_matrix_view(back);
            SL_CHECK(sl_csc_check(&C, NULL));
            double *a = ref_dense(&M.view), *b = ref_dense(&C);
            SAME_VALUES(a, b, (size_t)t.n * (size_t)t.n);
            assert_int_equal(C.p[t.n], M.p[t.n]);
            free(a);
            free(b);
            sl_matrix_free(back);
            gen_matrix_free(&M);
        }
        gen_list_free(&t);
    }
    remove(name);
}

/* Longer than one read: the buffer has to grow and the text to move. */
static void a_long_file_is_read_back(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 10000, 0, 7);
    sl_int n = M.view.n_cols;
    sl_matrix *back = NULL;
    char name[512];
    assert_true(temporary_name(name, sizeof name));
    matrix_write(&M.view, name);
    SL_CHECK(sl_matrix_read(&back, name, NULL, NULL));
    sl_csc C = sl_matrix_view(back);
    assert_int_equal(C.n_cols, n);
    assert_memory_equal(C.p, M.p, ((size_t)n + 1) * sizeof *M.p);
    assert_memory_equal(C.i, M.i, (size_t)M.p[n] * sizeof *M.i);
    assert_memory_equal(C.x, M.x, (size_t)M.p[n] * sizeof *M.x);
    sl_matrix_free(back);
    gen_matrix_free(&M);
    remove(name);
}

static void extreme_values_are_read_back_bit_for_bit(void **state) {
    (void)state;
    enum { COUNT = 12 };
    const double x[COUNT] = {DBL_MIN,   DBL_MAX,   -DBL_MAX, 4.9406564584124654e-324,
                             1.0 / 3.0, 0.1,       -0.0,     0.0,
                             INFINITY,  -INFINITY, 1e22,     DBL_EPSILON};
    sl_int p[COUNT + 1], i[COUNT];
    for (sl_int k = 0; k < COUNT; k++) {
        p[k] = i[k] = k;
    }
    p[COUNT] = COUNT;
    sl_csc A = {COUNT, COUNT, p, i, x};
    char name[512];
    assert_true(temporary_name(name, sizeof name));
    sl_matrix *back = NULL;
    matrix_write(&A, name);
    SL_CHECK(sl_matrix_read(&back, name, NULL, NULL));
    assert_memory_equal(sl_matrix_view(back).x, x, sizeof x);
    sl_matrix_free(back);
    A.x = NULL; /* a pattern file */
    matrix_write(&A, name);
    SL_CHECK(sl_matrix_read(&back, name, NULL, NULL));
    assert_null(sl_matrix_view(back).x);
    sl_matrix_free(back);
    remove(name);
}

static void unusable_paths_are_refused(void **state) {
    (void)state;
    sl_matrix *back = NULL;
    SL_EXPECT(SL_ERR_IO, sl_matrix_read(&back, "no/such/folder/no_such_file.mtx", NULL, NULL));
    assert_null(back);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_read(&back, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_read(NULL, "x", NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_parse(&back, NULL, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_parse(NULL, "x", 1, NULL, NULL));
    /* a folder can be opened but not read */
    SL_EXPECT(SL_ERR_IO, sl_matrix_read(&back, ".", NULL, NULL));
}

/* A device without an end is refused after its first bytes, in bounded memory. */
static void a_file_without_end_is_refused(void **state) {
    (void)state;
    FILE *zero = fopen("/dev/zero", "r");
    if (!zero) {
        TEST_SKIP("there is no /dev/zero");
    }
    fclose(zero);
    counter_t c = counter_make();
    sl_options opt = options_counted(&c);
    sl_stats stats;
    sl_matrix *M = NULL;
    SL_EXPECT(SL_ERR_IO, sl_matrix_read(&M, "/dev/zero", &opt, &stats));
    assert_int_equal(stats.error.line, 1);
    assert_true(c.total_bytes < 1 << 20);
    COUNTER_CLEAN(&c);
}

/* Writes text to a file and reads that; the same status and the same matrix as from memory. */
static void assert_file_reads_as_text(const char *text, size_t length, sl_status expected) {
    char path[512];
    sl_stats from_file, from_text;
    sl_matrix *M = NULL, *T = NULL;
    counter_t c = counter_make();
    sl_options opt = options_counted(&c);
    memset(&from_file, 0, sizeof from_file);
    memset(&from_text, 0, sizeof from_text);
    write_temporary(path, sizeof path, text, length);
    SL_EXPECT(expected, sl_matrix_read(&M, path, &opt, &from_file));
    SL_EXPECT(expected, sl_matrix_parse(&T, text, length, NULL, &from_text));
    assert_int_equal(from_file.error.line, from_text.error.line);
    if (expected == SL_OK) {
        sl_csc A = sl_matrix_view(M), B = sl_matrix_view(T);
        assert_int_equal(A.p[A.n_cols], B.p[B.n_cols]);
        assert_memory_equal(A.p, B.p, ((size_t)A.n_cols + 1) * sizeof *A.p);
        assert_memory_equal(A.i, B.i, (size_t)A.p[A.n_cols] * sizeof *A.i);
        assert_memory_equal(A.x, B.x, (size_t)A.p[A.n_cols] * sizeof *A.x);
    }
    sl_matrix_free(M);
    sl_matrix_free(T);
    COUNTER_CLEAN(&c);
    unlink(path);
}

/* Appends `count` bytes. */
static size_t fill(char *text, size_t at, char byte, size_t count) {
    memset(text + at, byte, count);
    return at + count;
}

/* Lines, comments and blanks that end just before, at and behind the end of the buffer of 65536
 * bytes through which files are read, and that are longer than it. */
static void files_are_read_across_the_buffer(void **state) {
    (void)state;
    static const char banner[] = BANNER("real general"), sizes[] = "2 2 2\n", one[] = "1 1 1.5\n",
                      two[] = "2 2 2.5\n";
    static const size_t lengths[] = {65380, 65440, 65470, 65536, 65537, 70000, 140000};
    char *text = (char *)test_array(1 << 20, 1);
    for (size_t which = 0; which < sizeof lengths / sizeof lengths[0]; which++) {
        for (size_t more = 0; more < 70; more++) {
            const size_t length = lengths[which] + more;
            for (int kind = 0; kind < 4; kind++) {
                size_t at = 0;
                sl_status expected = SL_OK;
                memcpy(text, banner, sizeof banner - 1);
                at += sizeof banner - 1;
                if (kind == 0) { /* a comment */
                    at = fill(text, at, '%', length);
                    text[at++] = '\n';
                } else if (kind == 1) { /* blank lines */
                    at = fill(text, at, '\n', length);
                }
                memcpy(text + at, sizes, sizeof sizes - 1);
                at += sizeof sizes - 1;
                if (kind == 2) { /* blanks before an entry */
                    at = fill(text, at, ' ', length);
                }
                memcpy(text + at, one, sizeof one - 1);
                at += sizeof one - 1;
                if (kind == 3) { /* blanks behind an entry: a line that may be too long */
                    at = fill(text, at - 1, '\t', length);
                    text[at++] = '\n';
                    expected = length + sizeof one - 2 >= 65536 ? SL_ERR_IO : SL_OK;
                }
                memcpy(text + at, two, sizeof two - 1);
                at += sizeof two - 1;
                assert_file_reads_as_text(text, at - (more % 2), expected);
            }
        }
    }
    free(text);
}

/* A malformed entry that ends with the buffer is not taken for the end of the file, where entries
 * may be missing. */
static void a_malformed_entry_at_the_end_of_the_buffer(void **state) {
    (void)state;
    static const char start[] = BANNER("real general") "2 2 2\n", bad[] = "\n1 x 1.5\n",
                      more[] = "2 2 2.5\n";
    enum { BUFFER = 65536 };
    char *text = (char *)test_array(BUFFER + sizeof more, 1);
    memcpy(text, start, sizeof start - 1);
    memset(text + sizeof start - 1, '%', BUFFER - sizeof start + 1);
    memcpy(text + BUFFER - sizeof bad + 1, bad, sizeof bad - 1);
    memcpy(text + BUFFER, more, sizeof more - 1);
    for (int ends = 0; ends < 2; ends++) {
        char path[512];
        sl_matrix *M = NULL;
        sl_stats stats;
        write_temporary(path, sizeof path, text, ends ? BUFFER - 1 : BUFFER + sizeof more - 1);
        SL_EXPECT(SL_ERR_IO, sl_matrix_read(&M, path, NULL, &stats));
        assert_int_equal(stats.error.line, 4);
        assert_true((strstr(stats.error.what, "fewer entries") != NULL) == ends);
        assert_non_null(strstr(stats.error.what, "malformed"));
        unlink(path);
    }
    free(text);
}

/* A symmetric matrix with entries in both triangles, of different rows, takes memory to compare
 * them. */
static void memory_may_end_with_both_triangles(void **state) {
    (void)state;
    static const char text[] = BANNER("real symmetric") "3 3 3\n2 1 4\n1 3 5\n3 3 6\n";
    sl_status status = SL_ERR_MEMORY;
    int failures = 0;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t c = counter_make();
        sl_options opt = options_counted(&c);
        sl_matrix *M = NULL;
        c.fail_at = k;
        status = sl_matrix_parse(&M, text, sizeof text - 1, &opt, NULL);
        assert_int_equal(status, M ? SL_OK : SL_ERR_MEMORY);
        failures += status != SL_OK;
        if (M) {
            const sl_csc A = sl_matrix_view(M);
            double *a = ref_dense(&A);
            assert_true(a[1] == 4.0 && a[2] == 5.0 && a[8] == 6.0 && a[0] == 0.0);
            free(a);
        }
        sl_matrix_free(M);
        COUNTER_CLEAN(&c);
    }
    assert_in_range(failures, 3, 20);
}

/* A file that promises many entries takes memory for those it has. */
static void memory_grows_with_the_entries(void **state) {
    (void)state;
    static const char text[] = BANNER("real general") "9 9 2000000000\n1 1 1\n";
    char path[512];
    counter_t c = counter_make();
    sl_options opt = options_counted(&c);
    sl_matrix *M = NULL;
    write_temporary(path, sizeof path, text, sizeof text - 1);
    SL_EXPECT(SL_ERR_IO, sl_matrix_read(&M, path, &opt, NULL));
    assert_true(c.total_bytes < 1 << 22);
    COUNTER_CLEAN(&c);
    unlink(path);
}

/* Files with more entries than memory is first allocated for; memory may end at any allocation. */
static void more_entries_than_expected_are_read(void **state) {
    (void)state;
    enum { SIDE = 300, COUNT = SIDE * SIDE, LINE = 16 };
    char *text = (char *)test_array((size_t)COUNT * LINE + 200, 1), path[512];
    for (int pattern = 0; pattern < 2; pattern++) {
        size_t length = (size_t)sprintf(
            text, "%s%d %d %d\n", pattern ? BANNER("pattern general") : BANNER("integer general"),
            SIDE, SIDE, COUNT);
        for (int k = 0; k < COUNT; k++) {
            length += (size_t)sprintf(text + length, pattern ? "%d %d\n" : "%d %d %d\n",
                                      k % SIDE + 1, k / SIDE + 1, k % 1000);
        }
        write_temporary(path, sizeof path, text, length);
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t c = counter_make();
            sl_options opt = options_counted(&c);
            sl_matrix *M = NULL;
            c.fail_at = k;
            status = sl_matrix_read(&M, path, &opt, NULL);
            assert_int_equal(status, M ? SL_OK : SL_ERR_MEMORY);
            const sl_csc A = sl_matrix_view(M);
            for (int q = 0; q < COUNT && M; q++) {
                assert_int_equal(A.i[q], q % SIDE);
                assert_true(pattern ? A.x == NULL : A.x[q] == q % 1000);
            }
            sl_matrix_free(M);
            COUNTER_CLEAN(&c);
            assert_true(k < 20);
        }
        unlink(path);
    }
    free(text);
}

/* A last line that is too long is not taken for the end of the file. */
static void a_long_last_line_is_refused(void **state) {
    (void)state;
    const char start[] = BANNER("real general") "1 1 1\n1 1 4\n";
    const size_t length = sizeof start - 1 + 70000;
    char *text = (char *)test_array(length, 1);
    memset(text, 'x', length);
    memcpy(text, start, sizeof start - 1);
    assert_file_reads_as_text(text, length, SL_ERR_IO);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(written_files_are_read_back),
        cmocka_unit_test(a_long_file_is_read_back),
        cmocka_unit_test(extreme_values_are_read_back_bit_for_bit),
        cmocka_unit_test(unusable_paths_are_refused),
        cmocka_unit_test(a_file_without_end_is_refused),
        cmocka_unit_test(files_are_read_across_the_buffer),
        cmocka_unit_test(a_malformed_entry_at_the_end_of_the_buffer),
        cmocka_unit_test(memory_may_end_with_both_triangles),
        cmocka_unit_test(memory_grows_with_the_entries),
        cmocka_unit_test(more_entries_than_expected_are_read),
        cmocka_unit_test(a_long_last_line_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
