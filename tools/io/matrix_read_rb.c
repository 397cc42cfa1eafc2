/* matrix_read_rb.c: reads Rutherford-Boeing matrix files
 *
 * Line 1: title and key. Line 2: the number of lines of each section. Line 3: type, rows, columns,
 * entries. Line 4: the Fortran formats of the pointers, indices and values, for example (26I3).
 * Then these three sections, each starting on a new line. Numbers are in fields of fixed width. */
#include <stdlib.h>
#include <string.h>

#include "matrix_read.h"

#define MAX_FIELD_WIDTH 63

/* A Fortran format: `repeat` fields of `width` characters per line. `used` fields of the current
 * line have been read. */
typedef struct fields {
    int repeat;
    int width;
    int used;
} fields;

static char upper(char c) {
    return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

/* Reads a format like (26I3), (4E20.12) or (1P,4D20.12). The scale factor P is ignored: on input it
 * does not affect numbers with an exponent. */
static bool read_format(input *in, fields *f, const char *letters) {
    int64_t repeat = 1;
    int64_t width = 0;
    bool ok = input_more_in_line(in) && *in->at == '(';
    in->at += ok;
    if (ok && input_integer(in, &repeat) && upper(*in->at) == 'P') {
        in->at++;
        in->at += input_more_in_line(in) && *in->at == ',';
        repeat = 1;
        (void)input_integer(in, &repeat);
    }
    ok = ok && input_more_in_line(in) && strchr(letters, upper(*in->at)) != NULL && *in->at != '\0';
    in->at += ok;
    ok = ok && input_integer(in, &width) && repeat > 0 && repeat <= 1000 && width > 0 &&
         width <= MAX_FIELD_WIDTH;
    while (ok && *in->at != ')') {
        ok = strchr("0123456789.eE", *in->at) != NULL && *in->at != '\0';
        in->at += ok;
    }
    if (!ok) {
        return input_error(in, "unsupported format: expected one like (26I3) or (4E20.12)");
    }
    in->at++;
    f->repeat = (int)repeat;
    f->width = (int)width;
    f->used = 0;
    return true;
}

/* Copies the next field without blanks. False: the line is too short, or the file ends in the
 * field. */
static bool next_field(input *in, fields *f, char field[2 * MAX_FIELD_WIDTH + 1]) {
    if (f->used == f->repeat) {
        if (!input_next_line(in)) {
            return false;
        }
        f->used = 0;
    }
    f->used++;
    int length = 0;
    for (int k = 0; k < f->width && *in->at != '\n' && *in->at != '\r'; k++, in->at++) {
        if (in->at >= in->end) {
            return false;
        }
        char c = upper(*in->at);
        bool sign = c == '+' || c == '-';
        char before = length > 0 ? field[length - 1] : '\0';
        if (sign && ((before >= '0' && before <= '9') || before == '.')) {
            field[length++] = 'E'; /* Fortran omits the E before an exponent of three digits */
        }
        if (c != ' ') {
            field[length++] = c == 'D' ? 'E' : c;
        }
    }
    field[length] = '\0';
    return length > 0;
}

static bool next_integer(input *in, fields *f, int64_t *k) {
    char field[2 * MAX_FIELD_WIDTH + 1];
    char *after = field;
    if (next_field(in, f, field)) {
        *k = strtoll(field, &after, 10);
    }
    return after != field && *after == '\0';
}

static bool next_real(input *in, fields *f, double *x) {
    char field[2 * MAX_FIELD_WIDTH + 1];
    char *after = field;
    if (next_field(in, f, field)) {
        *x = strtod(field, &after);
    }
    return after != field && *after == '\0';
}

static bool read_type(matrix_read *r, bool *symmetric) {
    input *in = r->in;
    char type[4];
    input_word(in, type, sizeof type);
    for (int k = 0; type[k] != '\0'; k++) {
        type[k] = upper(type[k]);
    }
    if (strlen(type) != 3 || strchr("RIP", type[0]) == NULL || strchr("SUR", type[1]) == NULL ||
        type[2] != 'A') {
        return input_error(
            in,
            "type '%s' is not supported: it must be real, integer or pattern (r i p), symmetric, "
            "unsymmetric or rectangular (s u r), and assembled (a)",
            type);
    }
    r->pattern = type[0] == 'P';
    *symmetric = type[1] == 'S';
    return true;
}

static bool read_pointers(matrix_read *r, fields *f, int64_t entries, int64_t *pointers) {
    for (int64_t j = 0; j <= r->n_cols; j++) {
        if (!next_integer(r->in, f, &pointers[j])) {
            return input_error(r->in, "pointer %lld: missing, or not a number", (long long)j);
        }
        if (pointers[j] < (j > 0 ? pointers[j - 1] : 1) || pointers[j] > entries + 1) {
            return input_error(r->in, "pointer %lld is out of range", (long long)j);
        }
    }
    if (pointers[0] != 1 || pointers[r->n_cols] != entries + 1) {
        return input_error(r->in, "the pointers must run from 1 to entries + 1");
    }
    return true;
}

static bool read_indices(matrix_read *r, fields *f, const int64_t *pointers, bool symmetric) {
    (void)input_next_line(r->in);
    for (int64_t j = 0; j < r->n_cols; j++) {
        for (int64_t p = pointers[j]; p < pointers[j + 1]; p++) {
            int64_t i = 0;
            if (!next_integer(r->in, f, &i) || i < 1 || i > r->n_rows) {
                return input_error(r->in, "index %lld: missing, not a number or out of range",
                                   (long long)p);
            }
            bool mirrored = symmetric && i - 1 < j;
            if (!triplets_add(&r->entries, (sl_int)(mirrored ? j : i - 1),
                              (sl_int)(mirrored ? i - 1 : j), 1.0)) {
                return input_error(r->in, "out of memory");
            }
        }
    }
    return true;
}

static bool read_values(matrix_read *r, fields *f) {
    (void)input_next_line(r->in);
    for (size_t p = 0; p < r->entries.count; p++) {
        if (!next_real(r->in, f, &r->entries.x[p])) {
            return input_error(r->in, "value %lld: missing, or not a number", (long long)p + 1);
        }
    }
    return true;
}

bool matrix_read_rb(matrix_read *r) {
    input *in = r->in;
    int64_t rows = 0;
    int64_t cols = 0;
    int64_t entries = 0;
    bool symmetric = false;
    fields formats[3];
    if (!input_next_line(in) || !input_next_line(in)) {
        return input_error(in, "truncated in the header");
    }
    if (!read_type(r, &symmetric)) {
        return false;
    }
    if (!input_integer(in, &rows) || !input_integer(in, &cols) || !input_integer(in, &entries) ||
        entries < 0 || entries > in->end - in->data || (symmetric && rows != cols)) {
        return input_error(in, "counts of rows, columns and entries expected");
    }
    if (!matrix_read_set_size(r, rows, cols)) {
        return false;
    }
    (void)input_next_line(in);
    if (!read_format(in, &formats[0], "I") || !read_format(in, &formats[1], "I") ||
        (!r->pattern && !read_format(in, &formats[2], "IEDFG"))) {
        return false;
    }
    int64_t *pointers = (int64_t *)malloc(((size_t)cols + 1) * sizeof *pointers);
    if (pointers == NULL) {
        return input_error(in, "out of memory");
    }
    (void)input_next_line(in);
    bool ok = read_pointers(r, &formats[0], entries, pointers) &&
              read_indices(r, &formats[1], pointers, symmetric) &&
              (r->pattern || read_values(r, &formats[2]));
    free(pointers);
    return ok;
}
