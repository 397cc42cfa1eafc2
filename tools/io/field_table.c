/* field_table.c: reads tables of numbers at vertices: comma-separated, the vertex first */
#include "field_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input.h"

/* Bytes for each byte of a table, of which most vertices may have no row. */
enum { TABLE_SHARE = 100 };

/* Length of the text up to the next comma or the end of the line. */
static size_t cell_length(const input *in) {
    size_t k = 0;
    while (in->at + k < in->end && strchr(",\r\n", in->at[k]) == NULL) {
        k++;
    }
    return k;
}

static bool skip_comma(input *in) {
    if (in->at < in->end && *in->at == ',') {
        in->at++;
        return true;
    }
    return false;
}

/* Adds a column whose name is the next cell. */
static bool add_column(field_table *t, input *in, sl_int n) {
    const size_t length = cell_length(in), count = t->n_fields + 1;
    char what[80];
    (void)snprintf(what, sizeof what, "a table of %zu columns for %d vertices", count, (int)n);
    if (!input_allows(in, (double)sizeof(double) * (double)count * (double)n, TABLE_SHARE, what)) {
        return false;
    }
    char **names = realloc(t->names, count * sizeof *names);
    t->names = names != NULL ? names : t->names;
    double **values = realloc(t->values, count * sizeof *values);
    t->values = values != NULL ? values : t->values;
    if (names == NULL || values == NULL) {
        return input_error(in, "out of memory");
    }
    char *name = malloc(length + 1);
    double *column = malloc(((size_t)n + 1) * sizeof *column);
    if (name == NULL || column == NULL) {
        free(name);
        free(column);
        return input_error(in, "out of memory");
    }
    memcpy(name, in->at, length);
    name[length] = 0;
    for (sl_int v = 0; v < n; v++) {
        column[v] = NAN;
    }
    names[t->n_fields] = name;
    values[t->n_fields++] = column;
    in->at += length;
    return true;
}

static bool read_names(field_table *t, input *in, sl_int n) {
    static const char first[] = "vertex";
    const size_t length = cell_length(in);
    if (length != strlen(first) || memcmp(in->at, first, length) != 0) {
        return input_error(in, "the first line is not vertex,NAME,...");
    }
    in->at += length;
    while (skip_comma(in)) {
        if (!add_column(t, in, n)) {
            return false;
        }
    }
    return t->n_fields > 0 || input_error(in, "there is no column beside vertex");
}

static bool read_row(field_table *t, input *in, sl_int n) {
    int64_t vertex;
    if (!input_integer(in, &vertex)) {
        return input_error(in, "a row does not begin with a vertex");
    }
    if (vertex < 0 || vertex >= n) {
        return input_error(in, "vertex %lld is not one of the %d vertices of the mesh",
                           (long long)vertex, (int)n);
    }
    for (size_t k = 0; k < t->n_fields; k++) {
        if (!skip_comma(in) || !input_number(in, &t->values[k][vertex])) {
            return input_error(in, "a row has no number for column %s", t->names[k]);
        }
    }
    return !input_more_in_line(in) || input_error(in, "a row has more cells than the first line");
}

static bool read_all(field_table *t, input *in, sl_int n) {
    if (!read_names(t, in, n)) {
        return false;
    }
    while (input_next_line(in)) {
        if (input_more_in_line(in) && !read_row(t, in, n)) {
            return false;
        }
    }
    return true;
}

bool field_table_read(field_table *out, const char *path, sl_int n, char *message,
                      size_t message_size) {
    input in;
    memset(out, 0, sizeof *out);
    if (!input_open(&in, path, message, message_size)) {
        return false;
    }
    in.line = 1;
    const bool is_read = read_all(out, &in, n);
    input_close(&in);
    if (!is_read) {
        field_table_free(out);
    }
    return is_read;
}

void field_table_free(field_table *t) {
    for (size_t k = 0; k < t->n_fields; k++) {
        free(t->names[k]);
        free(t->values[k]);
    }
    free(t->names);
    free(t->values);
    memset(t, 0, sizeof *t);
}
