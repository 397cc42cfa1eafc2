/* matrix_read_text.c: reads lines "i j value", 0-based, with or without CHOLMOD's header */
#include "matrix_read.h"

/* Reads one line into i, j, x and checks 0 <= i < rows, 0 <= j < cols. */
static bool read_line(matrix_read *r, int64_t rows, int64_t cols, sl_int *i, sl_int *j, double *x) {
    input *in = r->in;
    int64_t row = 0;
    int64_t col = 0;
    if (!input_integer(in, &row) || !input_at_word_end(in) || !input_integer(in, &col) ||
        !input_at_word_end(in) || !input_number(in, x) || !input_at_word_end(in) ||
        input_more_in_line(in)) {
        return input_error(in, "a line 'i j value' is expected");
    }
    if (row < 0 || col < 0 || row >= rows || col >= cols) {
        return input_error(in, "entry (%lld, %lld) is out of range", (long long)row,
                           (long long)col);
    }
    *i = (sl_int)row;
    *j = (sl_int)col;
    return true;
}

bool matrix_read_csparse(matrix_read *r) {
    input *in = r->in;
    int64_t n = 0;
    while (input_more(in)) {
        sl_int i = 0;
        sl_int j = 0;
        double x = 0;
        if (!read_line(r, INT32_MAX, INT32_MAX, &i, &j, &x)) {
            return false;
        }
        n = i >= n ? (int64_t)i + 1 : n;
        n = j >= n ? (int64_t)j + 1 : n;
        if (n > r->n_rows && !matrix_read_set_size(r, n, n)) {
            return false;
        }
        if (!triplets_add(&r->entries, i, j, x)) {
            return input_error(in, "out of memory");
        }
    }
    return r->entries.count > 0 || input_error(in, "not a matrix: there are no entries");
}

static bool read_header(matrix_read *r, int64_t *entries, int64_t *stype) {
    input *in = r->in;
    int64_t rows = 0;
    int64_t cols = 0;
    bool ok = input_more(in) && input_integer(in, &rows) && input_integer(in, &cols) &&
              input_integer(in, entries) && input_at_word_end(in);
    if (ok && input_more_in_line(in)) {
        ok = input_integer(in, stype) && input_at_word_end(in) && !input_more_in_line(in);
    }
    if (!ok || *entries < 0) {
        return input_error(in, "a header 'rows columns entries [stype]' is expected");
    }
    if (*stype < -1 || *stype > 1 || (*stype != 0 && rows != cols)) {
        return input_error(in, "stype %lld is not supported for a %lld x %lld matrix",
                           (long long)*stype, (long long)rows, (long long)cols);
    }
    return matrix_read_set_size(r, rows, cols);
}

bool matrix_read_cholmod(matrix_read *r) {
    input *in = r->in;
    int64_t entries = 0;
    int64_t stype = 0;
    in->comment = '%';
    if (!read_header(r, &entries, &stype)) {
        return false;
    }
    (void)input_next_line(in);
    for (int64_t k = 0; k < entries; k++) {
        sl_int i = 0;
        sl_int j = 0;
        double x = 0;
        if (!input_more(in)) {
            return input_error(in, "truncated: %lld of %lld entries", (long long)k,
                               (long long)entries);
        }
        if (!read_line(r, r->n_rows, r->n_cols, &i, &j, &x)) {
            return false;
        }
        bool mirrored = (stype < 0 && i < j) || (stype > 0 && i > j);
        if (!triplets_add(&r->entries, mirrored ? j : i, mirrored ? i : j, x)) {
            return input_error(in, "out of memory");
        }
    }
    return !input_more(in) || input_error(in, "more entries than the %lld that the header declares",
                                          (long long)entries);
}
