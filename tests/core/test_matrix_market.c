/* test_matrix_market.c: Matrix Market texts: every kind, and malformed ones with their lines */
#include "tests/lib/matrix_text.h"

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
    /* a Hermitian matrix without imaginary parts; a byte order mark; exponents of Fortran */
    assert_parses_to("\xEF\xBB\xBF" BANNER("real hermitian") "2 2 3\n1 1 15D-1\n1 2 -.2d+1\n"
                                                             "2 2 0x.4P4\n",
                     2, 2, p, i, x);
    const double hexadecimal[3] = {29, 13, 1};
    assert_parses_to(BANNER("real general") "2 2 3\n1 1 0x1D\n2 1 0Xd\n2 2 1D0\n", 2, 2, p, i,
                     hexadecimal);
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
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 1 1D\n"},
        {SL_ERR_IO, 3, BANNER("real general") "2 2 1\n1 1 D1\n"},
        {SL_ERR_IO, 1, "\xEF\xBB\xBF"},
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
    static const struct {
        const char *text, *what;
    } cases[] = {
        {BANNER("complex general") "1 1 1\n1 1 1 0\n", "complex"},
        {BANNER("complex hermitian") "1 1 1\n1 1 1 0\n", "complex"},
        {BANNER("real skew-symmetric") "2 2 1\n2 1 1\n", "skew-symmetric"},
        {"%%MatrixMarket matrix array real general\n1 1\n1\n", "array"},
        {"%%MatrixMarket matrix array real symmetric\n1 1\n1\n", "array"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sl_matrix *M = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_EXPECT(SL_ERR_UNSUPPORTED, parse(&M, cases[k].text, NULL));
        SL_EXPECT(SL_ERR_UNSUPPORTED, parse(&M, cases[k].text, &stats));
        assert_string_equal(stats.error.what, cases[k].what);
        assert_int_equal(stats.error.line, 1);
    }
}

/* Entries of a symmetric file may be in either triangle, but not in both. */
static void both_triangles_are_refused(void **state) {
    (void)state;
    const sl_int p[4] = {0, 2, 3, 3}, i[3] = {1, 2, 2};
    const double x[3] = {1, 2, 3};
    assert_parses_to(BANNER("real symmetric") "3 3 3\n1 2 1\n3 1 2\n2 3 3\n", 3, 3, p, i, x);
    assert_parses_to(BANNER("real symmetric") "3 3 4\n1 2 1\n3 1 1\n2 3 3\n3 1 1\n", 3, 3, p, i, x);
    static const char *const texts[] = {
        BANNER("real symmetric") "3 3 4\n2 1 5\n3 1 2\n3 2 3\n1 3 2\n",
        BANNER("pattern hermitian") "3 3 4\n1 3\n1 1\n3 1\n1 2\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        sl_matrix *M = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_EXPECT(SL_ERR_MALFORMED, parse(&M, texts[k], NULL));
        SL_EXPECT(SL_ERR_MALFORMED, parse(&M, texts[k], &stats));
        assert_true(stats.error.row == 0 && stats.error.column == 2 && stats.error.line == -1);
        assert_string_equal(stats.error.what, "both triangles of a symmetric matrix");
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

/* A file of 78 bytes does not take 8 GB: empty rows have to be worth their memory. */
static void empty_rows_stay_within_the_size_of_the_file(void **state) {
    (void)state;
    static const char *const refused[] = {
        BANNER("real general") "2000000000 2000000000 1\n1 1 1\n",
        BANNER("real symmetric") "2000000000 2000000000 0\n",
        BANNER("real general") "1 1048700 1\n1 1 1\n",
        BANNER("pattern general") "1048700 1 1\n1 1\n",
    };
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_matrix *M = NULL;
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
        SL_EXPECT(SL_ERR_TOO_LARGE,
                  sl_matrix_parse(&M, refused[k], strlen(refused[k]), &opt, NULL));
        COUNTER_CLEAN(&counter);
    }
    SL_CHECK(parse(&M, BANNER("real general") "1048000 1 1\n1 1 1\n", NULL));
    sl_matrix_free(M);
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
        cmocka_unit_test(both_triangles_are_refused),
        cmocka_unit_test(sizes_that_do_not_fit_are_refused),
        cmocka_unit_test(empty_rows_stay_within_the_size_of_the_file),
        cmocka_unit_test(every_prefix_is_refused_or_read_correctly),
        cmocka_unit_test(blanks_and_bytes_that_are_no_digits),
        cmocka_unit_test(every_status_has_a_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
