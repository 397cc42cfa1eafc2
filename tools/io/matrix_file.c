/* matrix_file.c: reads matrix files: selects the format, converts the entries to a matrix */
#include "matrix_file.h"

#include <stdio.h>
#include <string.h>

#include "matrix_read.h"

/* Bytes for each row and column, of which some may be empty: their pointers and the counts while a
 * matrix is assembled. */
enum { ROW_BYTES = 24, SHARE = 64 };

/* Whether a matrix of this size is small enough for the length of its file. */
static bool is_allowed(input *in, int64_t n_rows, int64_t n_cols) {
    char what[80];
    (void)snprintf(what, sizeof what, "a matrix of %lld x %lld", (long long)n_rows,
                   (long long)n_cols);
    return input_allows(in, (double)ROW_BYTES * ((double)n_rows + (double)n_cols), SHARE, what);
}

bool matrix_read_set_size(matrix_read *r, int64_t n_rows, int64_t n_cols) {
    if (n_rows < 0 || n_cols < 0 || n_rows > INT32_MAX || n_cols > INT32_MAX) {
        return input_error(r->in, "the size %lld x %lld is out of range", (long long)n_rows,
                           (long long)n_cols);
    }
    r->n_rows = n_rows;
    r->n_cols = n_cols;
    return is_allowed(r->in, n_rows, n_cols);
}

/* Reads the size of a Matrix Market file, ahead of the library. What is no size is left to it. */
static bool is_allowed_market(input *in) {
    const input before = *in;
    int64_t rows = 0, columns = 0;
    in->comment = '%';
    const bool has_size = input_more(in) && input_integer(in, &rows) && input_integer(in, &columns);
    if (has_size && rows >= 0 && columns >= 0 && !is_allowed(in, rows, columns)) {
        return false;
    }
    *in = before;
    return true;
}

/* Replaces a pattern without values by a matrix of ones. */
static sl_status set_ones(sl_matrix **M) {
    sl_csc A = sl_matrix_view(*M);
    triplets ones = {0, 0, NULL, NULL, NULL};
    bool ok = triplets_reserve(&ones, (size_t)A.p[A.n_cols] + 1);
    for (sl_int j = 0; j < A.n_cols && ok; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1] && ok; p++) {
            ok = triplets_add(&ones, A.i[p], j, 1.0);
        }
    }
    sl_matrix *made = NULL;
    sl_status status = ok ? triplets_finish(&made, A.n_rows, A.n_cols, &ones, true) : SL_ERR_MEMORY;
    triplets_free(&ones);
    sl_matrix_free(*M);
    *M = made;
    return status;
}

/* Completes the matrix, or sets the message of the status. stats: of the call; may be NULL. */
static bool finish(sl_matrix **out, input *in, sl_status status, const sl_stats *stats) {
    char text[300];
    if (status == SL_OK && sl_matrix_view(*out).x == NULL) {
        status = set_ones(out);
        stats = NULL;
    }
    (void)sl_error_text(text, sizeof text, status, stats);
    return status == SL_OK || input_error(in, "%s", text);
}

static bool read_matrix_market(sl_matrix **out, input *in) {
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    if (!is_allowed_market(in)) {
        return false;
    }
    sl_status status = sl_matrix_parse(out, in->at, (size_t)(in->end - in->at), NULL, &stats);
    in->line = status != SL_OK && stats.error.line > 0 ? stats.error.line : 0;
    if (status == SL_ERR_MALFORMED) {
        return input_error(in,
                           "the banner says symmetric, but both (%d, %d) and (%d, %d) are entries: "
                           "one triangle is expected, or the word general",
                           (int)stats.error.row + 1, (int)stats.error.column + 1,
                           (int)stats.error.column + 1, (int)stats.error.row + 1);
    }
    if (status == SL_ERR_UNSUPPORTED) {
        return input_error(in,
                           "'%s' is not supported: coordinate files of real, integer or pattern "
                           "entries, general or symmetric, are",
                           stats.error.what);
    }
    stats.error.line = -1; /* the message begins with it */
    return finish(out, in, status, &stats);
}

static bool read_triplets(sl_matrix **out, input *in, bool (*read)(matrix_read *r)) {
    matrix_read r;
    memset(&r, 0, sizeof r);
    r.in = in;
    if (!read(&r)) {
        triplets_free(&r.entries);
        return false;
    }
    in->line = 0;
    return finish(out, in,
                  triplets_finish(out, (sl_int)r.n_rows, (sl_int)r.n_cols, &r.entries, !r.pattern),
                  NULL);
}

bool matrix_file_read(sl_matrix **out, const char *path, char *message, size_t message_size) {
    static const struct {
        const char *ending;
        bool (*read)(matrix_read *r);
    } formats[] = {{".rb", matrix_read_rb},
                   {"_csparse.txt", matrix_read_csparse},
                   {"_cholmod.txt", matrix_read_cholmod}};
    *out = NULL;
    input in;
    if (!input_open(&in, path, message, message_size)) {
        return false;
    }
    bool known = input_path_ends(path, ".mtx");
    bool ok = known && read_matrix_market(out, &in);
    for (size_t k = 0; k < sizeof formats / sizeof formats[0] && !known; k++) {
        known = input_path_ends(path, formats[k].ending);
        ok = known && read_triplets(out, &in, formats[k].read);
    }
    if (!known) {
        in.line = 0;
        (void)input_error(&in,
                          "unknown matrix format: the name must end in .mtx, .rb, _csparse.txt or "
                          "_cholmod.txt, optionally followed by .gz");
    }
    input_close(&in);
    return ok;
}
