/* test_matrix_market.c: Matrix Market files: kinds, malformed text with its line, round trips */
#define _POSIX_C_SOURCE 200809L /* mkstemp */

#include "tests/lib/check_factor.h"

#include <unistd.h>

static sl_status parse(sl_matrix **M, const char *text, sl_stats *stats) {
    /* an exact copy on the heap: sanitizers see a read past the end, and there is no terminating
     * zero */
    size_t length = strlen(text);
    char *copy = (char *)test_array(length, 1);
    memcpy(copy, text, length);
    sl_status status = sl_matrix_parse(M, copy, length, NULL, stats);
    free(copy);
    assert_true((*M != NULL) == (status == SL_OK));
    return status;
}

#define BANNER(kind) "%%MatrixMarket matrix coordinate " kind "\n"

/* Parses text and compares the matrix with n_rows x n_cols and these entries, rows ascending. */
static void assert_parses_to(const char *text, sl_int n_rows, sl_int n_cols, const sl_int *p,
                             const sl_int *i, const double *x) {
    sl_matrix *M = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(parse(&M, text, &stats));
    sl_csc A = sl_matrix_view(M);
    SL_CHECK(sl_csc_check(&A, NULL));
    assert_int_equal(A.n_rows, n_rows);
    assert_int_equal(A.n_cols, n_cols);
    assert_memory_equal(A.p, p, ((size_t)n_cols + 1) * sizeof *p);
    if (p[n_cols] > 0) {
        assert_memory_equal(A.i, i, (size_t)p[n_cols] * sizeof *i);
    }
    assert_int_equal(A.x == NULL, x == NULL);
    if (x) {
        SAME_VALUES(A.x, x, (size_t)p[n_cols]);
    }
    sl_matrix_free(M);
}

static void every_kind_is_read(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double x[3] = {1.5, -2, 4}, integers[3] = {1, -2, 4};
    assert_parses_to(BANNER("real general") "2 2 3\n1 1 1.5\n2 1 -2\n2 2 4\n", 2, 2, p, i, x);
    assert_parses_to(BANNER("real symmetric") "2 2 3\n2 2 4\n2 1 -2\n1 1 1.5\n", 2, 2, p, i, x);
    assert_parses_to(BANNER("integer general") "2 2 3\n1 1 1\n2 1 -2\n2 2 4\n", 2, 2, p, i,
                     integers);
    assert_parses_to(BANNER("integer symmetric") "2 2 3\n1 1 1\n2 1 -2\n2 2 4\n", 2, 2, p, i,
                     integers);
    assert_parses_to(BANNER("pattern general") "2 2 3\n1 1\n2 1\n2 2\n", 2, 2, p, i, NULL);
    assert_parses_to(BANNER("pattern symmetric") "2 2 3\n1 1\n2 1\n2 2\n", 2, 2, p, i, NULL);
    /* rectangular, with an empty column */
    const sl_int q[4] = {0, 1, 1, 2}, k[2] = {1, 0};
    const double y[2] = {7, 8};
    assert_parses_to(BANNER("real general") "2 3 2\n1 3 8\n2 1 7\n", 2, 3, q, k, y);
}

static void unusual_but_legal_text_is_read(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double x[3] = {1.5, -2, 4};
    /* comments, blank lines, CRLF, tabs, blanks at both ends, no final newline, + signs,
     * exponents */
    assert_parses_to(BANNER("real symmetric") "% a comment\n%\n\n2 2 3\n1 1 1.5\n\n2 1 -2\n2 2 4\n",
                     2, 2, p, i, x);
    assert_parses_to(
        "%%MatrixMarket matrix coordinate real symmetric\r\n%\r\n2 2 3\r\n1 1 1.5\r\n2 1 "
        "-2\r\n2 2 4\r\n",
        2, 2, p, i, x);
    assert_parses_to(BANNER("real symmetric") "  2\t2  3  \n\t1 1 +1.5 \n 2  1\t-2.0e0\n2 2 .4E1",
                     2, 2, p, i, x);
    /* the words of the banner in any case */
    assert_parses_to(
        "%%MatrixMarket MATRIX Coordinate Real SYMMETRIC\n2 2 3\n1 1 1.5\n2 1 -2\n2 2 4\n", 2, 2, p,
        i, x);
    /* entries above the diagonal of a symmetric file are mirrored */
    assert_parses_to(BANNER("real symmetric") "2 2 3\n1 1 1.5\n1 2 -2\n2 2 4\n", 2, 2, p, i, x);
    /* duplicates are summed */
    assert_parses_to(BANNER("real general") "2 2 5\n1 1 1\n2 1 -1\n2 2 4\n2 1 -1\n1 1 0.5\n", 2, 2,
                     p, i, x);
    /* no entries */
    const sl_int none[3] = {0, 0, 0};
    const double nothing[1] = {0};
    assert_parses_to(BANNER("real general") "2 2 0\n", 2, 2, none, i, nothing);
    sl_matrix *M = NULL;
    SL_CHECK(parse(&M, BANNER("real symmetric") "0 0 0\n", NULL));
    assert_int_equal(sl_matrix_view(M).n_cols, 0);
    sl_matrix_free(M);
}

static void values_that_are_not_finite_are_read(void **state) {
    (void)state;
    sl_matrix *M = NULL;
    sl_status status = parse(&M, BANNER("real general") "1 1 1\n1 1 nan\n", NULL);
    if (status == SL_OK) { /* accepted by contract: the factorization refuses them */
        assert_true(sl_matrix_view(M).x[0] != sl_matrix_view(M).x[0]);
    }
    assert_int_equal(status, SL_OK);
    sl_matrix_free(M);
    SL_CHECK(parse(&M, BANNER("real general") "1 1 1\n1 1 -inf\n", NULL));
    assert_true(sl_matrix_view(M).x[0] == -INFINITY);
    sl_matrix_free(M);
    SL_CHECK(parse(&M, BANNER("real general") "1 1 1\n1 1 1e999\n", NULL));
    assert_true(sl_matrix_view(M).x[0] == INFINITY);
    sl_matrix_free(M);
    SL_CHECK(parse(&M, BANNER("real general") "1 1 1\n1 1 1e-400\n", NULL));
    assert_true(sl_matrix_view(M).x[0] == 0.0);
    sl_matrix_free(M);
}

typedef struct bad_text_t {
    sl_status status;
    sl_off line; /* 0: not checked */
    const char *text;
} bad_text_t;

static void malformed_text_is_refused_with_its_line(void **state) {
    (void)state;
    static const bad_text_t bad[] = {
        {SL_ERR_IO, 1, ""},
        {SL_ERR_IO, 1, "\n"},
        {SL_ERR_IO, 1, "2 2 3\n1 1 1\n"},
        {SL_ERR_IO, 1, "%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n"},
        {SL_ERR_IO, 1, "%%MatrixMarket\n"},
        {SL_ERR_IO, 1, "%%MatrixMarket matrix coordinate real\n1 1 1\n1 1 1\n"},
        {SL_ERR_IO, 1, "%%MatrixMarket matrix coordinate real lopsided\n1 1 1\n1 1 1\n"},
        {SL_ERR_IO, 1, "%%MatrixMarket matrix coordinate surreal general\n1 1 1\n1 1 1\n"},
        {SL_ERR_IO, 1, "%%MatrixMarket matrix coordinate realistic general\n1 1 1\n1 1 1\n"},
        {SL_ERR_IO, 3,
         BANNER("real general") "2 2 1\n1 1 1.00000000000000000000000000000000000000000000000000"
                                "00000000000000000000\n"},
        {SL_ERR_IO, 1, "%%MatrixMarket matrix diagonal real general\n1 1 1\n1 1 1\n"},
        {SL_ERR_IO, 1, "%%MatrixMarket vector coordinate real general\n1 1 1\n1 1 1\n"},
        {SL_ERR_IO, 0, BANNER("real general")},
        {SL_ERR_IO, 0, BANNER("real general") "% only\n% comments\n"},
        {SL_ERR_IO, 2, BANNER("real general") "2 2\n1 1 1\n"},
        {SL_ERR_IO, 2, BANNER("real general") "2 x 1\n1 1 1\n"},
        {SL_ERR_IO, 2, BANNER("real general") "2 2 1 7\n1 1 1\n"},
        {SL_ERR_IO, 2, BANNER("real general") "-2 2 1\n1 1 1\n"},
        {SL_ERR_IO, 2, BANNER("real general") "2 2 -1\n1 1 1\n"},
        {SL_ERR_IO, 2, BANNER("real general") "2.5 2 1\n1 1 1\n"},
        {SL_ERR_IO, 4, BANNER("real general") "%\n\n2 2 1x\n1 1 1\n"},
        {SL_ERR_IO, 2, BANNER("real symmetric") "2 3 1\n1 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n3 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 3 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n0 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 0 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n-1 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n99999999999999999999 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n4294967297 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 1 abc\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 1 1.5abc\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 1 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\na 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n+ 1 1\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 1.5 1\n"},
        {SL_ERR_IO, 3, BANNER("pattern general") "2 2 1\n1 1 1\n"},
        {SL_ERR_IO, 6, BANNER("real general") "2 2 3\n% comment\n1 1 1\n\n1 q 1\n2 2 1\n"},
        {SL_ERR_IO, 4, BANNER("real general") "2 2 1\n1 1 1\n2 2 1\n"}, /* one entry too many */
        {SL_ERR_IO, 0, BANNER("real general") "2 2 3\n1 1 1\n2 2 1\n"}, /* one entry too few */
        /* more entries than the text can hold */
        {SL_ERR_IO, 0, BANNER("real general") "2 2 1000000000\n1 1 1\n2 2 1\n"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        sl_matrix *M = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        sl_status status = parse(&M, bad[k].text, &stats);
        if (status != bad[k].status || (bad[k].line && stats.error.line != bad[k].line)) {
            print_error("case %d: \"%s\", line %ld, of the text:\n%s\n", (int)k,
                        sl_status_string(status), (long)stats.error.line, bad[k].text);
            fail();
        }
        SL_EXPECT(bad[k].status, parse(&M, bad[k].text, NULL));
    }
}

static void unsupported_kinds_are_refused(void **state) {
    (void)state;
    static const char *const texts[] = {
        BANNER("complex general") "1 1 1\n1 1 1 0\n",
        BANNER("complex hermitian") "1 1 1\n1 1 1 0\n",
        BANNER("real skew-symmetric") "2 2 1\n2 1 1\n",
        BANNER("real hermitian") "1 1 1\n1 1 1\n",
        "%%MatrixMarket matrix array real general\n1 1\n1\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        sl_matrix *M = NULL;
        SL_EXPECT(SL_ERR_UNSUPPORTED, parse(&M, texts[k], NULL));
    }
}

static void sizes_that_do_not_fit_are_refused(void **state) {
    (void)state;
    static const char *const texts[] = {
        BANNER("real general") "2147483648 1 0\n",
        BANNER("real general") "1 4294967297 0\n",
        BANNER("real general") "1 1 9223372036854775808\n",
        BANNER("real general") "99999999999999999999999999 1 0\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        sl_matrix *M = NULL;
        sl_status status = parse(&M, texts[k], NULL);
        if (status != SL_ERR_TOO_LARGE && status != SL_ERR_IO) {
            print_error("\"%s\" for\n%s", sl_status_string(status), texts[k]);
            fail();
        }
    }
}

static void every_prefix_is_refused_or_read_correctly(void **state) {
    (void)state;
    static const char text[] =
        BANNER("real symmetric") "% c\n3 3 4\n1 1 2.25\n2 2 3\n3 1 -1e-1\n3 3 4\n";
    for (size_t length = 0; length < sizeof text - 1; length++) {
        char *copy = (char *)test_array(length, 1);
        memcpy(copy, text, length);
        sl_matrix *M = NULL;
        sl_status status = sl_matrix_parse(&M, copy, length, NULL, NULL);
        assert_true((M != NULL) == (status == SL_OK));
        if (length + 2 < sizeof text) { /* without the last digit an entry is missing */
            assert_int_equal(status, SL_ERR_IO);
        }
        sl_matrix_free(M);
        free(copy);
    }
}

/* ---- files ---- */

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
            for (int reading = SL_AS_SYMMETRIC; reading <= SL_AS_STORED; reading++) {
                sl_matrix *back = NULL;
                SL_CHECK(sl_csc_write(&M.view, (sl_reading)reading, name));
                SL_CHECK(sl_matrix_read(&back, name, NULL, NULL));
                sl_csc C = sl_matrix_view(back);
                SL_CHECK(sl_csc_check(&C, NULL));
                double *a = ref_dense(&M.view), *b = ref_dense(&C);
                SAME_VALUES(a, b, (size_t)t.n * (size_t)t.n);
                assert_int_equal(C.p[t.n], reading == SL_AS_STORED ? M.p[t.n] : (sl_int)t.count);
                free(a);
                free(b);
                sl_matrix_free(back);
            }
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
    SL_CHECK(sl_csc_write(&M.view, SL_AS_STORED, name));
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
    for (int reading = SL_AS_SYMMETRIC; reading <= SL_AS_STORED; reading++) {
        sl_matrix *back = NULL;
        SL_CHECK(sl_csc_write(&A, (sl_reading)reading, name));
        SL_CHECK(sl_matrix_read(&back, name, NULL, NULL));
        assert_memory_equal(sl_matrix_view(back).x, x, sizeof x);
        sl_matrix_free(back);
    }
    /* a pattern is written as a pattern */
    A.x = NULL;
    sl_matrix *back = NULL;
    SL_CHECK(sl_csc_write(&A, SL_AS_STORED, name));
    SL_CHECK(sl_matrix_read(&back, name, NULL, NULL));
    assert_null(sl_matrix_view(back).x);
    sl_matrix_free(back);
    remove(name);
}

static void unusable_paths_are_refused(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_PATH, 4, 1, 1);
    sl_matrix *back = NULL;
    char name[512];
    SL_EXPECT(SL_ERR_IO, sl_matrix_read(&back, "no/such/folder/no_such_file.mtx", NULL, NULL));
    assert_null(back);
    SL_EXPECT(SL_ERR_IO, sl_csc_write(&M.view, SL_AS_STORED, "no/such/folder/no_such_file.mtx"));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_read(&back, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_read(NULL, "x", NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_parse(&back, NULL, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_parse(NULL, "x", 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_write(NULL, SL_AS_STORED, "x"));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_write(&M.view, SL_AS_STORED, NULL));
    /* a folder can be opened but not read */
    SL_EXPECT(SL_ERR_IO, sl_matrix_read(&back, ".", NULL, NULL));
    /* an asymmetric pattern cannot be written as symmetric: (1,0) has a mirror image, (2,0) does
     * not */
    const sl_int p[4] = {0, 2, 3, 3}, i[3] = {1, 2, 0};
    const double x[3] = {1, 2, 3};
    sl_csc lonely = {3, 3, p, i, x};
    assert_true(temporary_name(name, sizeof name));
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_write(&lonely, SL_AS_SYMMETRIC, name));
    lonely.n_rows = 1;
    SL_EXPECT(SL_ERR_PATTERN, sl_csc_write(&lonely, SL_AS_STORED, name));
    remove(name);
    gen_matrix_free(&M);
}

/* /dev/full buffers every byte and fails when it is flushed, so that only the last call sees the
 * error. */
static void a_full_disk_is_reported(void **state) {
    (void)state;
    FILE *full = fopen("/dev/full", "w");
    if (!full) {
        skip();
    }
    fclose(full);
    gen_matrix_t M = gen_matrix(GEN_GRID2, 100, 1, 1);
    SL_EXPECT(SL_ERR_IO, sl_csc_write(&M.view, SL_AS_STORED, "/dev/full"));
    gen_matrix_free(&M);
}

/* A device without an end is refused after its first bytes, in bounded memory. */
static void a_file_without_end_is_refused(void **state) {
    (void)state;
    FILE *zero = fopen("/dev/zero", "r");
    if (!zero) {
        skip();
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

/* Blanks of every kind in every place, and bytes that no number has. */
static void blanks_and_bytes_that_are_no_digits(void **state) {
    (void)state;
    const sl_int p[2] = {0, 1}, i[1] = {0};
    const double x[1] = {4};
    assert_parses_to(BANNER("real general") "\r\n \t\r\n\r1\t1\r1\r\n1\r1\t4\r\n \t\r", 1, 1, p, i,
                     x);
    assert_parses_to(BANNER("real general") "1 1 1\n1 1 4\n\r\n\t  ", 1, 1, p, i, x);
    static const char *const words[] = {"4.0.0", "{4", "4}", "4~", "4,0", "4\x80",
                                        "4)",    "_4", "4_", "@",  "["};
    for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
        char text[200];
        sl_matrix *M = NULL;
        sl_stats stats;
        (void)sprintf(text, "%s1 1 %s\n", BANNER("real general") "1 1 1\n", words[k]);
        SL_EXPECT(SL_ERR_IO, parse(&M, text, &stats));
        assert_int_equal(stats.error.line, 3);
    }
    /* what C libraries print for a NaN with a payload */
    sl_matrix *M = NULL;
    SL_CHECK(parse(&M, BANNER("real general") "1 1 1\n1 1 nan(a_1)\n", NULL));
    assert_true(sl_matrix_view(M).x[0] != sl_matrix_view(M).x[0]);
    sl_matrix_free(M);
    /* a last line that is too long is not taken for the end of the file */
    const char start[] = BANNER("real general") "1 1 1\n1 1 4\n";
    const size_t length = sizeof start - 1 + 70000;
    char *text = (char *)test_array(length, 1);
    memset(text, 'x', length);
    memcpy(text, start, sizeof start - 1);
    assert_file_reads_as_text(text, length, SL_ERR_IO);
    free(text);
}

/* Every status has a text of its own, and so does a number that is no status. */
static void every_status_has_a_text(void **state) {
    (void)state;
    for (int a = SL_OK; a <= SL_ERR_INACCURATE; a++) {
        assert_non_null(sl_status_string((sl_status)a));
        for (int b = SL_OK; b < a; b++) {
            assert_string_not_equal(sl_status_string((sl_status)a), sl_status_string((sl_status)b));
        }
    }
    assert_non_null(sl_status_string((sl_status)99));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_read),
        cmocka_unit_test(unusual_but_legal_text_is_read),
        cmocka_unit_test(values_that_are_not_finite_are_read),
        cmocka_unit_test(malformed_text_is_refused_with_its_line),
        cmocka_unit_test(unsupported_kinds_are_refused),
        cmocka_unit_test(sizes_that_do_not_fit_are_refused),
        cmocka_unit_test(every_prefix_is_refused_or_read_correctly),
        cmocka_unit_test(written_files_are_read_back),
        cmocka_unit_test(a_long_file_is_read_back),
        cmocka_unit_test(extreme_values_are_read_back_bit_for_bit),
        cmocka_unit_test(unusable_paths_are_refused),
        cmocka_unit_test(a_full_disk_is_reported),
        cmocka_unit_test(a_file_without_end_is_refused),
        cmocka_unit_test(files_are_read_across_the_buffer),
        cmocka_unit_test(memory_grows_with_the_entries),
        cmocka_unit_test(more_entries_than_expected_are_read),
        cmocka_unit_test(blanks_and_bytes_that_are_no_digits),
        cmocka_unit_test(every_status_has_a_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
