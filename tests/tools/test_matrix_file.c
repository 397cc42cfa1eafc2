/* test_matrix_file.c: reads Matrix Market, Rutherford-Boeing and triplet files, good and bad */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/temporary_files.h"
#include "tests/lib/transposed.h"

#include "tools/io/matrix_file.h"

/* The lower triangle of a 3 x 3 matrix with an explicit zero. Most files store one entry as two
 * parts, 1.5 + 2.5. */
static const sl_int small_p[4] = {0, 2, 4, 5};
static const sl_int small_i[5] = {0, 2, 1, 2, 2};
static const double small_x[5] = {4, -1, 3, 0, -200};

static sl_matrix *read_or_fail(const char *path) {
    sl_matrix *M = NULL;
    char message[300];
    if (!matrix_file_read(&M, path, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    assert_string_equal(message, "");
    return M;
}

static void assert_is_small(const char *path) {
    sl_matrix *M = read_or_fail(path);
    sl_csc A = sl_matrix_view(M);
    SL_CHECK(sl_csc_check(&A, NULL));
    assert_int_equal(A.n_rows, 3);
    assert_int_equal(A.n_cols, 3);
    assert_memory_equal(A.p, small_p, sizeof small_p);
    assert_memory_equal(A.i, small_i, sizeof small_i);
    SAME_VALUES(A.x, small_x, 5);
    sl_matrix_free(M);
}

static void assert_is_refused(const char *path, const char *words) {
    sl_matrix *M = (sl_matrix *)(void *)files_folder;
    char message[300] = "";
    assert_false(matrix_file_read(&M, path, message, sizeof message));
    assert_null(M);
    if (strncmp(message, path, strlen(path)) != 0 || strstr(message, words) == NULL) {
        print_error("%s\n    lacks: %s\n", message, words);
        fail();
    }
    assert_false(matrix_file_read(&M, path, NULL, 0));
}

static bool read_is_valid(const char *path) {
    sl_matrix *M = NULL;
    char message[300];
    bool ok = matrix_file_read(&M, path, message, sizeof message);
    assert_true(ok == (message[0] == '\0'));
    assert_true(ok == (M != NULL));
    sl_csc A = sl_matrix_view(M);
    if (ok) {
        SL_CHECK(sl_csc_check(&A, NULL));
        assert_non_null(A.x);
    }
    sl_matrix_free(M);
    return ok;
}

static const char mtx[] =
    "%%MatrixMarket matrix coordinate real symmetric\n% small\n3 3 6\n1 1 1.5\n1 1 2.5\n"
    "3 1 -1\n2 2 3\n3 2 0\n3 3 -2e2\n";
static const char csparse[] = "0 0 1.5\n2 0 -1\n0 0 2.5\n1 1 3\n\n2 1 0\n2 2 -2e2\n";
static const char cholmod[] =
    "% small\n3 3 6 -1\n0 0 1.5\n2 0 -1\n0 0 2.5\n1 1 3\n1 2 0\n2 2 -2e2\n";

/* Adjacent fields without spaces, an exponent without E, one with D, a full line. */
static const char rb[] =
    "small matrix of a test                                                  |small   \n"
    "             5             1             1             3\n"
    "rsa                        3             3             6             0\n"
    "(4I2)           (8I1)           (1P,2E10.3)         \n"
    " 1 4 6 7\n"
    "113233\n"
    " 1.500E+00 2.500D+00\n"
    "-1.000E+00 3.000+000\n"
    " 0.000E+00-2.000E+02\n";

static void all_formats_give_the_same_matrix(void **state) {
    (void)state;
    assert_is_small(files_put_text("small.mtx", mtx));
    assert_is_small(files_put_gz("small.mtx.gz", mtx, strlen(mtx)));
    char marked[sizeof mtx + 3] = "\xEF\xBB\xBF";
    assert_is_small(files_put_text("marked.mtx", strcat(marked, mtx)));
    assert_is_small(files_put_text("small_csparse.txt", csparse));
    assert_is_small(files_put_gz("small_csparse.txt.gz", csparse, strlen(csparse)));
    assert_is_small(files_put_text("small_cholmod.txt", cholmod));
    assert_is_small(
        files_put_text("small_cholmod.txt",
                       "3 3 6\r\n0 0 1.5\r\n2 0 -1\r\n0 0 2.5\r\n1 1 3\r\n2 1 0\r\n2 2 -2e2"));
    assert_is_small(files_put_text("small.rb", rb));
    assert_is_small(files_put_gz("small.rb.gz", rb, strlen(rb)));
}

static void an_upper_triangle_stays_upper(void **state) {
    (void)state;
    sl_matrix *M =
        read_or_fail(files_put_text("upper_cholmod.txt", "2 2 3 1\n0 0 1\n1 0 5\n1 1 2\n"));
    sl_csc A = sl_matrix_view(M);
    sl_triangle triangle = SL_TRIANGLE_NONE;
    SL_CHECK(sl_csc_triangle(&A, &triangle, NULL, NULL));
    assert_int_equal(triangle, SL_TRIANGLE_UPPER);
    sl_matrix_free(M);
}

static void pattern_files_get_ones(void **state) {
    (void)state;
    static const char pattern_rb[] =
        "pattern\n 2 1 1 0\nPUA 2 3 4 0\n(26I3) (40I2)\n  1  2  4  5\n 2 1 2 1\n";
    const char *files[2];
    char first[FILE_PATH_SIZE + 100];
    (void)snprintf(
        first, sizeof first, "%s",
        files_put_text(
            "p.mtx",
            "%%MatrixMarket matrix coordinate pattern general\n2 3 4\n2 1\n1 2\n2 2\n1 3\n"));
    files[0] = first;
    files[1] = files_put_text("p.rb", pattern_rb);
    for (int k = 0; k < 2; k++) {
        sl_matrix *M = read_or_fail(files[k]);
        sl_csc A = sl_matrix_view(M);
        assert_int_equal(A.n_rows, 2);
        assert_int_equal(A.n_cols, 3);
        assert_int_equal(A.p[3], 4);
        assert_int_equal(A.i[0], 1);
        assert_int_equal(A.i[3], 0);
        assert_true(A.x[0] == 1 && A.x[1] == 1 && A.x[2] == 1 && A.x[3] == 1);
        sl_matrix_free(M);
    }
}

static void empty_matrices_are_read(void **state) {
    (void)state;
    sl_matrix *M = read_or_fail(files_put_text("e_cholmod.txt", "3 3 0\n"));
    sl_csc A = sl_matrix_view(M);
    assert_int_equal(A.n_cols, 3);
    assert_int_equal(A.p[3], 0);
    assert_non_null(A.x);
    sl_matrix_free(M);
    M = read_or_fail(files_put_text(
        "e.rb", "no entries\n 1 1 0 0\nrsa 0 0 0 0\n(26I3) (40I2) (3E26.18)\n  1\n\n\n"));
    assert_int_equal(sl_matrix_view(M).n_cols, 0);
    sl_matrix_free(M);
}

static void bad_text_files_are_refused(void **state) {
    (void)state;
    assert_is_refused(files_path("missing.mtx"), "cannot be opened");
    assert_is_refused(files_put_text("small.dat", mtx), "unknown matrix format");
    assert_is_refused(
        files_put_text("a.mtx", "%%MatrixMarket matrix array real symmetric\n1 1\n1\n"),
        ":1: 'array' is not supported: coordinate files");
    assert_is_refused(files_put_text("a.mtx",
                                     "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n"
                                     "1 2 1\n2 1 1\n"),
                      ": the banner says symmetric, but both (1, 2) and (2, 1) are entries");
    assert_is_refused(
        files_put_text("a.mtx", "%%MatrixMarket matrix coordinate real skew-symmetric\n1 1 0\n"),
        ":1: 'skew-symmetric' is not supported");
    assert_is_refused(files_put_text("small.txt", csparse), "unknown matrix format");
    assert_is_refused(
        files_put_text("a.mtx",
                       "%%MatrixMarket matrix coordinate real symmetric\n3 3 2\n1 1 1\n4 1 1\n"),
        ":4: ");
    assert_is_refused(
        files_put_text("b.mtx",
                       "%%MatrixMarket matrix coordinate complex symmetric\n1 1 1\n1 1 1 1\n"),
        ":1: 'complex' is not supported");
    assert_is_refused(files_put_text("c.mtx", "%%MatrixMarket matrix coordinate real general\n"
                                              "% a comment\n2000000000 2000000000 1\n1 1 1\n"),
                      ":3: a matrix of 2000000000 x 2000000000 would take 96000 MB, and the limit");
    assert_is_refused(files_put_text("a_csparse.txt", "\n"), "no entries");
    assert_is_refused(files_put_text("b_csparse.txt", "0 0 1\n0 1\n"),
                      ":2: a line 'i j value' is expected");
    assert_is_refused(files_put_text("c_csparse.txt", "0 0 1 2\n"),
                      "a line 'i j value' is expected");
    assert_is_refused(files_put_text("d_csparse.txt", "0 0.5 1\n"),
                      "a line 'i j value' is expected");
    assert_is_refused(files_put_text("e_csparse.txt", "0 -1 1\n"),
                      ":1: entry (0, -1) is out of range");
    assert_is_refused(files_put_text("f_csparse.txt", "0 2000000000 1\n"),
                      "the limit for a file of this size is 64 MB");
    assert_is_refused(files_put_text("g_csparse.txt", "0 2147483647 1\n"), "out of range");
    assert_is_refused(files_put_text("h_csparse.txt", "0 x 1\n"), "a line 'i j value' is expected");
    assert_is_refused(files_put_text("a_cholmod.txt", ""), "a header");
    assert_is_refused(files_put_text("b_cholmod.txt", "3 3\n"), ":1: a header");
    assert_is_refused(files_put_text("c_cholmod.txt", "3 3 -1\n"), "a header");
    assert_is_refused(files_put_text("d_cholmod.txt", "3 3 1 7\n0 0 1\n"), "stype 7");
    assert_is_refused(files_put_text("e_cholmod.txt", "3 4 1 1\n0 0 1\n"),
                      "stype 1 is not supported for a 3 x 4");
    assert_is_refused(files_put_text("f_cholmod.txt", "3 3 2\n0 0 1\n"), "truncated: 1 of 2");
    assert_is_refused(files_put_text("g_cholmod.txt", "3 3 1\n0 0 1\n1 1 1\n"),
                      ":3: more entries than the 1");
    assert_is_refused(files_put_text("h_cholmod.txt", "3 3 1\n0 3 1\n"),
                      ":2: entry (0, 3) is out of range");
    assert_is_refused(files_put_text("i_cholmod.txt", "2000000000 3 1\n0 1 1\n"),
                      "the limit for a file of this size is 64 MB");
    assert_is_refused(files_put_text("j_cholmod.txt", "3 3 2000000000\n0 1 1\n"),
                      "truncated: 1 of 2000000000");
}

static void bad_rutherford_boeing_files_are_refused(void **state) {
    (void)state;
#define RB_TWO_LINES "title\n 3 1 1 1\n"
#define RB_FORMATS "(3I2) (3I2) (3E5.1)\n"
    assert_is_refused(files_put_text("a.rb", "title\n"), "truncated in the header");
    assert_is_refused(files_put_text("b.rb", RB_TWO_LINES "cua 1 1 1 0\n"),
                      ":3: type 'CUA' is not supported");
    assert_is_refused(files_put_text("c.rb", RB_TWO_LINES "rza 1 1 1 0\n"), "type 'RZA'");
    assert_is_refused(files_put_text("d.rb", RB_TWO_LINES "rse 1 1 1 0\n"), "type 'RSE'");
    assert_is_refused(files_put_text("e.rb", RB_TWO_LINES "rsa 1 1\n"), "counts of rows");
    assert_is_refused(files_put_text("f.rb", RB_TWO_LINES "rsa 1 2 1 0\n" RB_FORMATS),
                      "counts of rows");
    assert_is_refused(
        files_put_text("g.rb", RB_TWO_LINES "rsa 2000000000 2000000000 1 0\n" RB_FORMATS),
        "the limit for a file of this size is 64 MB");
    assert_is_refused(files_put_text("h.rb", RB_TWO_LINES "rsa 1 1 2000000000 0\n" RB_FORMATS),
                      "counts of rows");
    assert_is_refused(files_put_text("i.rb", RB_TWO_LINES "rsa 1 1 1 0\n(3X2) (3I2) (3E5.1)\n"),
                      ":4: unsupported format");
    assert_is_refused(files_put_text("j.rb", RB_TWO_LINES "rsa 1 1 1 0\n(3I2) (3I99) (3E5.1)\n"),
                      ":4: unsupported format");
    assert_is_refused(files_put_text("k.rb", RB_TWO_LINES "rsa 1 1 1 0\n(3I2) (3I2)\n"),
                      ":4: unsupported format");
    assert_is_refused(files_put_text("l.rb", RB_TWO_LINES "rsa 1 1 1 0\n(3I2) (3I2) (3E5.1\n"),
                      ":4: unsupported format");
    assert_is_refused(files_put_text("m.rb", RB_TWO_LINES "rsa 1 1 1 0\n" RB_FORMATS " 1\n"),
                      "pointer 1: missing");
    assert_is_refused(files_put_text("n.rb", RB_TWO_LINES "rsa 1 1 1 0\n" RB_FORMATS " 1 3\n"),
                      "pointer 1 is out of range");
    assert_is_refused(files_put_text("o.rb", RB_TWO_LINES "rsa 1 1 1 0\n" RB_FORMATS " 1 1\n"),
                      "must run from 1");
    assert_is_refused(files_put_text("p.rb", RB_TWO_LINES "rsa 2 2 1 0\n" RB_FORMATS " 1 2 1\n"),
                      "pointer 2 is out of range");
    assert_is_refused(files_put_text("q.rb", RB_TWO_LINES "rsa 1 1 1 0\n" RB_FORMATS " 1 2\n 2\n"),
                      "index 1: ");
    assert_is_refused(files_put_text("r.rb", RB_TWO_LINES "rsa 1 1 1 0\n" RB_FORMATS " 1 2\n 1\n"),
                      "value 1: missing");
    assert_is_refused(
        files_put_text("s.rb", RB_TWO_LINES "rsa 1 1 1 0\n" RB_FORMATS " 1 2\n 1\n  1x0\n"),
        "value 1: ");
}

static void damaged_files_are_refused_or_read(void **state) {
    (void)state;
    static const struct {
        const char *name;
        const char *text;
    } all[] = {
        {"t.mtx", mtx}, {"t_csparse.txt", csparse}, {"t_cholmod.txt", cholmod}, {"t.rb", rb}};
    static const char spice[] = "-9 \n\r/%.e(IP)\377";
    uint64_t seed = 1;
    for (size_t s = 0; s < sizeof all / sizeof all[0]; s++) {
        size_t length = strlen(all[s].text);
        for (size_t cut = 0; cut < length; cut++) {
            bool read = read_is_valid(files_put(all[s].name, all[s].text, cut));
            /* A missing count is detected where the format has one. Only cuts within the last
             * number go unnoticed. */
            assert_false(read && s != 1 && cut + 5 < length);
        }
        for (int round = 0; round < 2000; round++) {
            char text[1024];
            memcpy(text, all[s].text, length);
            for (uint64_t k = 1 + files_random(&seed) % 3; k > 0; k--) {
                char what = files_random(&seed) % 2
                                ? spice[files_random(&seed) % (sizeof spice - 1)]
                                : (char)(files_random(&seed) % 128);
                text[files_random(&seed) % length] = what;
            }
            (void)read_is_valid(files_put(all[s].name, text, length));
        }
    }
}

static void real_matrices_are_read(void **state) {
    (void)state;
    static const struct {
        const char *name;
        sl_int n;
        sl_int entries; /* duplicates summed */
        sl_triangle triangle;
    } known[] = {{"LFAT5.mtx", 14, 30, SL_TRIANGLE_LOWER},
                 {"bcsstk01.rb", 48, 224, SL_TRIANGLE_LOWER},
                 {"k01up_cholmod.txt", 48, 224, SL_TRIANGLE_UPPER},
                 {"pts5ldd03.mtx", 161, 745, SL_TRIANGLE_BOTH},
                 {"nos5.mtx.gz", 468, 2820, SL_TRIANGLE_LOWER},
                 {"1138_bus.mtx", 1138, 2596, SL_TRIANGLE_LOWER},
                 {"bcsstk16_csparse.txt.gz", 4884, 147631, SL_TRIANGLE_LOWER},
                 {"lap2D_5pt_n100.mtx.gz", 10000, 29800, SL_TRIANGLE_LOWER},
                 {"hs21_3x3_K_0.mtx", 17, 33, SL_TRIANGLE_LOWER},
                 {"primalc1_3x3_K_0.mtx.gz", 902, 3635, SL_TRIANGLE_LOWER},
                 {"cvxqp1_m_3x3_K_0.mtx.gz", 7500, 17982, SL_TRIANGLE_LOWER},
                 {"cvxqp1_m_3x3_K_10.mtx.gz", 7500, 17982, SL_TRIANGLE_LOWER},
                 {"stcqp1_2x2_K_0.mtx.gz", 22537, 74769, SL_TRIANGLE_LOWER},
                 {"c-41.mtx.gz", 9769, 55757, SL_TRIANGLE_LOWER},
                 {"bcsstm34.mtx.gz", 588, 12429, SL_TRIANGLE_LOWER},
                 {"tumorAntiAngiogenesis_2.mtx", 305, 1441, SL_TRIANGLE_LOWER},
                 {"s4.rb", 4, 10, SL_TRIANGLE_LOWER},
                 {"bcspwr10.mtx.gz", 5300, 13571, SL_TRIANGLE_LOWER},
                 {"coordinate_hermitian_real_row_general_dup.mtx", 3, 5, SL_TRIANGLE_BOTH}};
    dataset d;
    if (!dataset_list(&d, NULL, "matrices")) {
        TEST_SKIP("SL_DATA names no folder with matrices: no real matrices are read");
    }
    size_t checked = 0;
    for (size_t k = 0; k < d.count; k++) {
        sl_matrix *M = read_or_fail(d.paths[k]);
        sl_csc A = sl_matrix_view(M);
        assert_non_null(A.x);
        for (size_t t = 0; t < sizeof known / sizeof known[0]; t++) {
            if (strcmp(dataset_basename(d.paths[k]), known[t].name) == 0) {
                sl_triangle triangle = SL_TRIANGLE_NONE;
                SL_CHECK(sl_csc_triangle(&A, &triangle, NULL, NULL));
                assert_int_equal(triangle, known[t].triangle);
                assert_int_equal(A.n_rows, known[t].n);
                assert_int_equal(A.n_cols, known[t].n);
                assert_int_equal(A.p[A.n_cols], known[t].entries);
                checked++;
            }
        }
        sl_matrix_free(M);
    }
    print_message("%lu real matrices read, %lu of known size\n", (unsigned long)d.count,
                  (unsigned long)checked);
    dataset_free(&d);
}

/* The same matrix in two formats, one with the lower and one with the upper triangle. */
static void real_files_of_one_matrix_agree(void **state) {
    (void)state;
    const char *root = getenv("SL_DATA");
    char lower_path[FILE_PATH_SIZE];
    char upper_path[FILE_PATH_SIZE];
    (void)snprintf(lower_path, sizeof lower_path, "%s/matrices/bcsstk01.rb",
                   root != NULL ? root : "");
    (void)snprintf(upper_path, sizeof upper_path, "%s/matrices/k01up_cholmod.txt",
                   root != NULL ? root : "");
    if (root == NULL || access(lower_path, R_OK) != 0 || access(upper_path, R_OK) != 0) {
        TEST_SKIP("SL_DATA lacks bcsstk01.rb or k01up_cholmod.txt: not compared");
    }
    sl_matrix *lower = read_or_fail(lower_path);
    sl_matrix *upper = read_or_fail(upper_path);
    sl_csc A = sl_matrix_view(lower);
    sl_csc U = sl_matrix_view(upper);
    sl_matrix *mirrored = transposed(&U);
    sl_csc B = sl_matrix_view(mirrored);
    assert_memory_equal(A.p, B.p, 49 * sizeof *A.p);
    assert_memory_equal(A.i, B.i, (size_t)A.p[48] * sizeof *A.i);
    for (sl_int p = 0; p < A.p[48]; p++) {
        /* The .rb file stores 12 digits. */
        assert_true(fabs(A.x[p] - B.x[p]) <= 1e-11 * fabs(A.x[p]));
    }
    sl_matrix_free(lower);
    sl_matrix_free(upper);
    sl_matrix_free(mirrored);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_formats_give_the_same_matrix),
        cmocka_unit_test(an_upper_triangle_stays_upper),
        cmocka_unit_test(pattern_files_get_ones),
        cmocka_unit_test(empty_matrices_are_read),
        cmocka_unit_test(bad_text_files_are_refused),
        cmocka_unit_test(bad_rutherford_boeing_files_are_refused),
        cmocka_unit_test(damaged_files_are_refused_or_read),
        cmocka_unit_test(real_matrices_are_read),
        cmocka_unit_test(real_files_of_one_matrix_agree),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
