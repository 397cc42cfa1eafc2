/* test_errors.c: what sl_error_text says of errors: with and without stats, of files, by threads */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/factored.h"
#include "tests/lib/pools.h"
#include "tests/lib/temporary_files.h"

#include <errno.h>

enum { N = 100, TEXT = 400 };

/* What the wrong calls are made with. */
typedef struct wrong_t {
    factored_t y, other; /* two analyses of one matrix */
    sl_factor *failed;   /* without numbers */
    sl_matrix *upper;    /* the transpose of the matrix */
    double x[2 * N], b[2 * N];
} wrong_t;

static wrong_t w;

static int set_up(void **state) {
    sl_options natural = options_none();
    sl_stats stats;
    double *zeros;
    sl_csc bad;
    natural.ordering = SL_ORDERING_NATURAL;
    w.y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    w.other = factored_make(GEN_GRID2, N, 1, 0, &natural);
    SL_CHECK(sl_matrix_transpose(&w.upper, &w.y.M.view, NULL));
    SL_CHECK(sl_factor_create(&w.failed, w.y.S, &w.y.M.view, NULL, NULL));
    zeros = test_reals((size_t)w.y.M.p[N]);
    bad = w.y.M.view;
    bad.x = zeros;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(w.failed, &bad, &stats));
    free(zeros);
    gen_reals(w.b, 2 * N, 3);
    return files_set_up(state);
}

static int tear_down(void **state) {
    sl_matrix_free(w.upper);
    sl_factor_free(w.failed);
    factored_free(&w.y);
    factored_free(&w.other);
    return files_tear_down(state);
}

/* ---- wrong calls and their sentences ---- */

#define WRONG(name) static sl_status name(sl_stats *stats)

/* An analysis with options that something is wrong with. */
static sl_status analyze(const sl_options *opt, sl_stats *stats) {
    sl_symbolic *S = NULL;
    const sl_status status = sl_symbolic_create(&S, &w.y.M.view, opt, stats);
    assert_true(status != SL_OK && S == NULL);
    return status;
}

static sl_status factor(const sl_options *opt, sl_stats *stats) {
    sl_factor *F = NULL;
    const sl_status status = sl_factor_create(&F, w.y.S, &w.y.M.view, opt, stats);
    assert_true(status != SL_OK && F == NULL);
    return status;
}

WRONG(no_factor) {
    (void)stats;
    return sl_factor_solve(NULL, w.x, N, w.b, N, 1, NULL);
}

WRONG(small_ldx) {
    (void)stats;
    return sl_factor_solve(w.y.F, w.x, N - 1, w.b, N, 1, NULL);
}

WRONG(small_ldb) {
    const sl_int row = 3;
    return sl_local_solve(w.y.F, NULL, 0, &row, 1, w.x, 1, w.b, 7, 1, NULL, stats);
}

WRONG(in_place) {
    (void)stats;
    return sl_factor_solve(w.y.F, w.x, N, w.x, N + 1, 1, NULL);
}

WRONG(no_such_row) {
    const sl_int row = N;
    return sl_local_solve(w.y.F, &row, 1, &row, 1, w.x, 1, w.b, 1, 1, NULL, stats);
}

WRONG(no_numbers) {
    (void)stats;
    return sl_factor_solve(w.failed, w.x, N, w.b, N, 1, NULL);
}

WRONG(other_analysis) {
    sl_plan *P = NULL;
    (void)stats;
    SL_CHECK(sl_plan_create(&P, w.y.S, NULL, 0, NULL, 0, NULL, NULL));
    const sl_status status = sl_plan_solve(P, w.other.F, w.x, N, w.b, N, 1, NULL);
    sl_plan_free(P);
    return status;
}

WRONG(no_perm) {
    sl_options opt = options_none();
    opt.ordering = SL_ORDERING_GIVEN;
    return analyze(&opt, stats);
}

WRONG(row_twice_in_perm) {
    sl_options opt = options_none();
    sl_int perm[N];
    for (sl_int k = 0; k < N; k++) {
        perm[k] = k;
    }
    perm[7] = 2;
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = perm;
    return analyze(&opt, stats);
}

WRONG(not_initialized) {
    sl_options opt;
    memset(&opt, 0x5a, sizeof opt);
    return analyze(&opt, stats);
}

WRONG(reserved) {
    sl_options opt = options_none();
    opt.reserved_int = 1;
    return analyze(&opt, stats);
}

WRONG(negative_threads) {
    sl_options opt = options_none();
    opt.threads.count = -1;
    return factor(&opt, stats);
}

WRONG(half_an_allocator) {
    counter_t c = counter_make();
    sl_options opt = options_counted(&c);
    opt.allocator.release = NULL;
    return factor(&opt, stats);
}

WRONG(blocks_do_not_divide) {
    sl_options opt = options_none();
    opt.block_size = 3;
    return analyze(&opt, stats);
}

WRONG(no_ordering) {
    sl_options opt = options_none();
    opt.ordering = (sl_ordering)2;
    return analyze(&opt, stats);
}

WRONG(regularized_and_skipped) {
    sl_options opt = options_none();
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    opt.regularization = 1e-8;
    return factor(&opt, stats);
}

WRONG(wrong_sign) {
    sl_options opt = options_none();
    sl_int signs[N] = {1, 1, 1, 7};
    opt.regularization = 1e-8;
    opt.signs = signs;
    return factor(&opt, stats);
}

WRONG(infinite_weight) {
    sl_options opt = options_none();
    for (int k = 0; k < N; k++) {
        w.x[k] = 1;
    }
    w.x[4] = (double)INFINITY;
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    opt.mass = w.x;
    return factor(&opt, stats);
}

WRONG(counted_from_1) {
    const sl_int p[] = {0, 1, 2}, i[] = {1, 2};
    const double x[] = {1, 1};
    const sl_csc A = {2, 2, p, i, x};
    sl_symbolic *S = NULL;
    return sl_symbolic_create(&S, &A, NULL, stats);
}

WRONG(other_triangle) {
    const sl_csc A = sl_matrix_view(w.upper);
    return sl_factor_refactor(w.y.F, &A, stats);
}

/* Two rows of one column swapped: the matrix is the same, its pattern is not the analyzed one. */
WRONG(rows_swapped) {
    const sl_csc *A = &w.y.M.view;
    sl_int *i = test_ints((size_t)A->p[N]), p;
    sl_csc B = *A;
    memcpy(i, A->i, (size_t)A->p[N] * sizeof *i);
    p = A->p[5];
    i[p] = A->i[p + 1];
    i[p + 1] = A->i[p];
    B.i = i;
    const sl_status status = sl_factor_refactor(w.y.F, &B, stats);
    free(i);
    return status;
}

WRONG(not_read) {
    static const sl_int p[] = {0, 2, 3, 5}, i[] = {0, 1, 1, 0, 2}, other[] = {0, 1, 1, 1, 2};
    static const double x[] = {2, 1, 2, 1, 2};
    sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    opt.triangle = SL_TRIANGLE_LOWER;
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    A.i = other;
    opt.triangle = SL_TRIANGLE_NONE;
    sl_status status = sl_factor_create(&F, S, &A, &opt, stats);
    sl_symbolic_free(S);
    return status;
}

WRONG(another_size) {
    const sl_int p[] = {0, 1}, i[] = {0};
    const double x[] = {1};
    const sl_csc A = {1, 1, p, i, x};
    return sl_factor_refactor(w.y.F, &A, stats);
}

WRONG(pinned_twice) {
    const sl_int row = 5;
    sl_pins *P = NULL;
    SL_CHECK(sl_pins_create(&P, w.y.F, NULL));
    SL_CHECK(sl_pins_add(P, &row, 1, NULL));
    const sl_status status = sl_pins_add(P, &row, 1, stats);
    sl_pins_free(P);
    return status;
}

WRONG(depends_on_pins) {
    const sl_int rows[] = {5, 6};
    const double ones[] = {1, 1};
    sl_pins *P = NULL;
    SL_CHECK(sl_pins_create(&P, w.y.F, NULL));
    SL_CHECK(sl_pins_add(P, rows, 2, NULL));
    const sl_status status = sl_pins_add_equality(P, rows, ones, 2, stats);
    sl_pins_free(P);
    return status;
}

WRONG(old_pins) {
    const double g = 1;
    const sl_int row = 5;
    sl_pins *P = NULL;
    (void)stats;
    SL_CHECK(sl_pins_create(&P, w.y.F, NULL));
    SL_CHECK(sl_pins_add(P, &row, 1, NULL));
    SL_CHECK(sl_factor_refactor(w.y.F, &w.y.M.view, NULL));
    const sl_status status = sl_pins_solve(P, NULL, w.x, N, w.b, N, &g, 1, 1, NULL);
    sl_pins_free(P);
    return status;
}

WRONG(not_in_l) {
    const sl_int row = 0, column = N - 1;
    const double delta = 1;
    factored_t path = factored_make(GEN_PATH, N, 1, 0, NULL);
    const sl_status status = sl_factor_change(path.F, NULL, &row, &column, &delta, 1, NULL, stats);
    factored_free(&path);
    return status;
}

WRONG(no_memory) {
    sl_work *W = NULL;
    (void)stats;
    counter_t c = counter_make();
    c.fail_at = 0;
    const sl_options opt = options_counted(&c);
    return sl_work_create(&W, &opt);
}

static sl_status load(const char *path) {
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    const sl_status status = sl_load_file(&set, path, SL_LOAD_VERIFIED, NULL);
    assert_null(set.symbolic);
    return status;
}

/* Saves the factor, changes a byte at a position, counted from the end if it is huge, and cuts the
 * file off at `length`. */
static sl_status load_changed(size_t length, size_t position, int change) {
    sl_saved_set set;
    size_t size;
    char *bytes;
    memset(&set, 0, sizeof set);
    set.symbolic = w.y.S;
    set.factor = w.y.F;
    SL_CHECK(sl_save_file(files_path("a.slf"), &set, NULL));
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
    return sl_save_file(files_path("no/folder/a.slf"), &set, NULL);
}

WRONG(mapped) {
    sl_saved_set set, got;
    memset(&set, 0, sizeof set);
    memset(&got, 0, sizeof got);
    set.symbolic = w.y.S;
    set.factor = w.y.F;
    SL_CHECK(sl_save_file(files_path("a.slf"), &set, NULL));
    SL_CHECK(sl_map_file(&got, files_path("a.slf"), SL_LOAD_CHECKED, NULL));
    const sl_status status = sl_factor_refactor(got.factor, &w.y.M.view, stats);
    sl_saved_set_free(&got);
    return status;
}

static sl_status read_text(const char *text, sl_stats *stats) {
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

/* `text` is the beginning of the sentence. */
static const struct {
    sl_status (*call)(sl_stats *stats);
    sl_status status;
    const char *text;
} wrongs[] = {
    {no_factor, SL_ERR_ARGUMENT, "invalid argument: F is NULL"},
    {small_ldx, SL_ERR_ARGUMENT, "invalid argument: ldx is below the rows of X"},
    {small_ldb, SL_ERR_ARGUMENT, "invalid argument: ldb is below the rows of B"},
    {in_place, SL_ERR_ARGUMENT, "invalid argument: X is B, but ldx is not ldb"},
    {no_such_row, SL_ERR_ARGUMENT,
     "invalid argument: a row of bset or xset is out of range (row 100)"},
    {no_numbers, SL_ERR_STALE,
     "numbers that are missing or out of date: F has no numbers: its last factorization has "
     "failed"},
    {other_analysis, SL_ERR_STATE,
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
     "invalid argument: options.regularization excludes null_pivots = SL_NULL_PIVOT_SKIP"},
    {wrong_sign, SL_ERR_ARGUMENT,
     "invalid argument: options.signs has a value other than -1, 0 and 1 (row 3, value 7)"},
    {infinite_weight, SL_ERR_ARGUMENT,
     "invalid argument: options.mass is not finite (row 4, value inf)"},
    {counted_from_1, SL_ERR_PATTERN,
     "malformed or unsymmetric pattern: a row of A is out of range; rows count from 0 (row 2, "
     "column 1)"},
    {other_triangle, SL_ERR_OTHER_PATTERN, "not the analyzed pattern: A stores the other triangle"},
    {rows_swapped, SL_ERR_OTHER_PATTERN,
     "not the analyzed pattern: from this one on, entries are others, or in another order (row 6, "
     "column 5)"},
    {not_read, SL_ERR_OTHER_PATTERN,
     "not the analyzed pattern: entries that are not read are others"},
    {another_size, SL_ERR_OTHER_PATTERN,
     "not the analyzed pattern: A has another size than the analyzed matrix"},
    {pinned_twice, SL_ERR_PIVOT, "null pivot: the row is pinned twice (row 5)"},
    {depends_on_pins, SL_ERR_PIVOT,
     "null pivot: it depends on the other pins and equalities (row 5)"},
    {old_pins, SL_ERR_STALE,
     "numbers that are missing or out of date: F has changed since the pins were made: "
     "sl_pins_refactor"},
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
    {mapped, SL_ERR_READ_ONLY, "read-only object: it is mapped (sl_load_file copies it)"},
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
    SL_EXPECT(SL_ERR_PIVOT, sl_batch_factor(F, 4, w.y.S, NULL, NULL, 0, &opt, NULL, NULL));
    assert_true(calls > 0);
    sl_error_text(text, TEXT, SL_ERR_PIVOT, NULL);
    assert_non_null(strstr(text, "null pivot: if A is regular, sl_symbolic_create_pivoted"));
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
