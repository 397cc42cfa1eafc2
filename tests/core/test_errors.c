/* test_errors.c: what sl_error_text says of errors: with and without stats, of files, by threads */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pools.h"
#include "tests/lib/temporary_files.h"
#include "tests/lib/wrong_calls.h"
#include "tests/lib/wrong_files.h"

enum { TEXT = 400 };

static int set_up(void **state) {
    wrong_set_up();
    return files_set_up(state);
}

static int tear_down(void **state) {
    wrong_tear_down();
    return files_tear_down(state);
}

/* ---- wrong calls and their sentences ---- */

/* `text` is the beginning of the sentence. */
static const struct {
    sl_status (*call)(sl_stats *stats);
    sl_status status;
    const char *text;
} wrongs[] = {
    {no_factor, SL_ERR_ARGUMENT, "invalid argument: F is NULL"},
    {small_ldx, SL_ERR_ARGUMENT,
     "invalid argument: ldx is below the rows of X, or nrhs with SL_ROWS (least 100, value 99)"},
    {negative_ldx, SL_ERR_ARGUMENT,
     "invalid argument: ldx is below the rows of X, or nrhs with SL_ROWS (least 1, value -7)"},
    {small_ldb, SL_ERR_ARGUMENT,
     "invalid argument: ldb is below the rows of B, or nrhs with SL_ROWS (least 100, value 7)"},
    {small_ldx_of_rows, SL_ERR_ARGUMENT,
     "invalid argument: ldx is below the rows of X, or nrhs with SL_ROWS (least 2, value 1)"},
    {small_ldy, SL_ERR_ARGUMENT,
     "invalid argument: ldy is below the rows of Y, or nrhs with SL_ROWS (least 100, value 3)"},
    {small_ldr, SL_ERR_ARGUMENT,
     "invalid argument: ldr is below the rows of R, or nrhs with SL_ROWS (least 100)"},
    {in_place, SL_ERR_ARGUMENT, "invalid argument: X is B, but ldx is not ldb"},
    {no_such_row, SL_ERR_ARGUMENT,
     "invalid argument: a row is out of range (row 100)"},
    {row_below_0, SL_ERR_ARGUMENT, "invalid argument: a row is out of range (value -1)"},
    {column_below_0, SL_ERR_ARGUMENT, "invalid argument: a column is out of range (value -1)"},
    {entry_below_0, SL_ERR_ARGUMENT,
     "invalid argument: a row or column is out of range (row 3, column -2, value -2)"},
    {triplet_from_1, SL_ERR_ARGUMENT,
     "invalid argument: a triplet is out of range; value is its number, and rows count from 0 "
     "(row 2, column 1, value 1)"},
    {infinite_b, SL_ERR_NOT_FINITE,
     "not a finite number: this number of B is not finite (row 1, column 1, value inf)"},
    {infinite_b_of_rows, SL_ERR_NOT_FINITE,
     "not a finite number: this number of B is not finite (row 7, column 66, value -inf)"},
    {infinite_in_place, SL_ERR_NOT_FINITE,
     "not a finite number: a right-hand side is not finite, or x overflows"},
    {infinite_in_batch, SL_ERR_NOT_FINITE,
     "not a finite number: this number of B is not finite (row 9, column 0, value inf)"},
    {infinite_fixed, SL_ERR_NOT_FINITE,
     "not a finite number: this value of G is not finite (row 0, column 1, value inf)"},
    {infinite_pin, SL_ERR_NOT_FINITE,
     "not a finite number: this value of G is not finite (row 1, column 0, value inf)"},
    {no_numbers, SL_ERR_STALE,
     "numbers that are missing or out of date: F has no numbers: its last factorization has "
     "failed"},
    {other_analysis, SL_ERR_MISMATCH,
     "objects that do not belong together: the plan is of another analysis than F"},
    {no_perm, SL_ERR_ARGUMENT, "invalid argument: options.perm is NULL though ordering is GIVEN"},
    {row_twice_in_perm, SL_ERR_ARGUMENT,
     "invalid argument: options.perm has a row out of range or twice at this position (row 7, "
     "value 2)"},
    {not_initialized, SL_ERR_ARGUMENT, "invalid argument: options.size is not that of the library"},
    {reserved, SL_ERR_ARGUMENT, "invalid argument: a reserved field of options is not 0"},
    {negative_threads, SL_ERR_ARGUMENT, "invalid argument: options.threads.count is below 0"},
    {half_an_allocator, SL_ERR_ARGUMENT,
     "invalid argument: options.allocator has only one of its two functions"},
    {blocks_do_not_divide, SL_ERR_ARGUMENT,
     "invalid argument: options.block_size does not divide n"},
    {no_ordering, SL_ERR_ARGUMENT,
     "invalid argument: options.ordering is not a value of sl_ordering"},
    {regularized_and_skipped, SL_ERR_ARGUMENT,
     "invalid argument: options.regularization needs options.pivots = SL_PIVOTS_NONZERO"},
    {wrong_sign, SL_ERR_ARGUMENT,
     "invalid argument: options.signs has a value other than -1, 0 and 1 (row 3, value 7)"},
    {infinite_weight, SL_ERR_ARGUMENT,
     "invalid argument: options.mass is not finite (row 4, value inf)"},
    {counted_from_1, SL_ERR_MALFORMED,
     "malformed or unsymmetric pattern: a row of A is out of range; rows count from 0 (row 2, "
     "column 1)"},
    {negative_row_of_a, SL_ERR_MALFORMED,
     "malformed or unsymmetric pattern: a row of A is out of range; rows count from 0 (column 1, "
     "value -1)"},
    {other_triangle, SL_ERR_OTHER_PATTERN, "not the analyzed pattern: A stores the other triangle"},
    {rows_swapped, SL_ERR_OTHER_PATTERN,
     "not the analyzed pattern: the first entry that differs, or stands in another place (row 6, "
     "column 5)"},
    {not_read, SL_ERR_OTHER_PATTERN,
     "not the analyzed pattern: entries differ in the triangle that is not read"},
    {another_size, SL_ERR_OTHER_PATTERN,
     "not the analyzed pattern: A has another size than the analyzed matrix"},
    {pinned_twice, SL_ERR_PIVOT, "refused pivot: the row is pinned twice (row 5)"},
    {depends_on_pins, SL_ERR_PIVOT,
     "refused pivot: it depends on the other pins and equalities (row 5)"},
    {old_pins, SL_ERR_STALE,
     "numbers that are missing or out of date: F has changed since the pins were made: "
     "sl_constraints_refactor"},
    {not_in_l, SL_ERR_OTHER_PATTERN, "not the analyzed pattern: L has no such entry"},
    {no_memory, SL_ERR_MEMORY, "out of memory: the allocator returned NULL"},
    {no_file, SL_ERR_IO,
     "file cannot be read, parsed or written: there is no such file or folder (errno 2)"},
    {junk, SL_ERR_UNSUPPORTED, "not supported, or not compiled in: not a saved factor"},
    {long_junk, SL_ERR_UNSUPPORTED, "not supported, or not compiled in: not a saved factor"},
    {empty_file, SL_ERR_IO,
     "file cannot be read, parsed or written: it is empty, or not an ordinary file"},
    {short_file, SL_ERR_IO, "file cannot be read, parsed or written: truncated: bytes are missing"},
    {cut_file, SL_ERR_IO, "file cannot be read, parsed or written: truncated: bytes are missing"},
    {changed_file, SL_ERR_IO, "file cannot be read, parsed or written: damaged: a checksum"},
    {no_folder, SL_ERR_IO,
     "file cannot be read, parsed or written: there is no such file or folder (errno 2)"},
    {mapped, SL_ERR_READ_ONLY,
     "read-only object: it is mapped (sl_load copies without SL_LOAD_MAPPED)"},
    {no_matrix, SL_ERR_IO,
     "file cannot be read, parsed or written: there is no such file or folder (errno 2)"},
    {no_matrix_market, SL_ERR_IO,
     "file cannot be read, parsed or written: not a Matrix Market file of a matrix (line 1)"},
    {entry_from_0, SL_ERR_IO,
     "file cannot be read, parsed or written: an entry is malformed or out of range; rows count "
     "from 1 (line 3)"},
    {too_few_entries, SL_ERR_IO,
     "file cannot be read, parsed or written: fewer entries than the header says, or a malformed "
     "one (line 3)"},
    {too_many_entries, SL_ERR_IO,
     "file cannot be read, parsed or written: more entries than the header says (line 4)"},
};

/* Stats of the call give the same sentence as the thread's last error. */
static void every_wrong_call_has_its_sentence(void **state) {
    (void)state;
    int failures = 0;
    for (size_t k = 0; k < sizeof wrongs / sizeof *wrongs; k++) {
        char last[TEXT], text[TEXT];
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        const sl_status status = wrongs[k].call(&stats);
        sl_error_text(last, TEXT, status, NULL);
        sl_error_text(text, TEXT, status, &stats);
        const int has_stats = stats.error.what != NULL;
        if (status != wrongs[k].status ||
            strncmp(last, wrongs[k].text, strlen(wrongs[k].text)) != 0 ||
            (has_stats && strcmp(last, text) != 0)) {
            print_error("\"%s\"\n\"%s\"\n    instead of \"%s\"\n", last, text, wrongs[k].text);
            failures++;
        }
    }
    assert_int_equal(failures, 0);
}

/* The length is that of the whole sentence, as snprintf's. */
static void a_short_buffer_has_the_beginning(void **state) {
    (void)state;
    char text[TEXT], few[8];
    const size_t length = sl_error_text(NULL, 0, no_factor(NULL), NULL);
    assert_int_equal(sl_error_text(text, TEXT, SL_ERR_ARGUMENT, NULL), length);
    assert_int_equal(strlen(text), length);
    assert_int_equal(sl_error_text(few, sizeof few, SL_ERR_ARGUMENT, NULL), length);
    assert_memory_equal(few, "invalid", sizeof few);
}

/* A status that is not that of the last error, and success, have the text of the status only. */
static void other_statuses_have_their_own_text(void **state) {
    (void)state;
    char text[TEXT];
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_ARGUMENT, no_perm(&stats));
    sl_error_text(text, TEXT, SL_OK, NULL);
    assert_string_equal(text, "ok");
    sl_error_text(text, TEXT, SL_OK, &stats);
    assert_string_equal(text, "ok");
    sl_error_text(text, TEXT, SL_ERR_PIVOT, NULL);
    assert_string_equal(text, sl_status_string(SL_ERR_PIVOT));
    /* a call that succeeds leaves no error behind */
    SL_CHECK(sl_factor_refactor(w.y.F, &w.y.M.view, &stats));
    assert_null(stats.error.what);
    sl_error_text(text, TEXT, SL_ERR_ARGUMENT, NULL);
    assert_string_equal(text, sl_status_string(SL_ERR_ARGUMENT));
}

/* An error that is found in another thread of a call has its reason. */
static void errors_cross_threads(void **state) {
    (void)state;
    char text[TEXT];
    sl_options opt = options_none();
    sl_factor *F[4];
    int calls = 0;
    opt.threads.count = 2;
    opt.threads.run = run_threads;
    opt.threads.context = &calls;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create_sums(F, 4, w.y.S, NULL, NULL, 0, &opt, NULL, NULL));
    assert_true(calls > 0);
    sl_error_text(text, TEXT, SL_ERR_PIVOT, NULL);
    assert_non_null(strstr(text, "refused pivot: the row is 0"));
}

/* One thread's error is not another's. */
static void fails_otherwise(void *data, sl_int k) {
    char *text = (char *)data + (size_t)k * TEXT;
    const sl_status status = k % 2 == 0 ? no_factor(NULL) : small_ldx(NULL);
    sl_error_text(text, TEXT, status, NULL);
}

static void each_thread_has_its_own_error(void **state) {
    (void)state;
    static char texts[4][TEXT];
    char text[TEXT];
    int calls = 0;
    SL_EXPECT(SL_ERR_ARGUMENT, in_place(NULL));
    run_threads(&calls, 4, fails_otherwise, texts);
    for (int k = 0; k < 4; k++) {
        assert_non_null(strstr(texts[k], k % 2 == 0 ? "F is NULL" : "ldx is below"));
    }
    sl_error_text(text, TEXT, SL_ERR_ARGUMENT, NULL);
    assert_non_null(strstr(text, "X is B"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_wrong_call_has_its_sentence),
        cmocka_unit_test(a_short_buffer_has_the_beginning),
        cmocka_unit_test(other_statuses_have_their_own_text),
        cmocka_unit_test(errors_cross_threads),
        cmocka_unit_test(each_thread_has_its_own_error),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
