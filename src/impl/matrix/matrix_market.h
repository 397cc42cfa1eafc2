/* io.h: Matrix Market files, read and written: coordinate; real, integer, pattern; general, symmetric */
#ifndef SLI_IO_H
#define SLI_IO_H

#include "csc.h"

#define SLI_TOKEN_MAX 63 /* no number that a program prints is longer */

/* A place in the text, always at the start of a line that is not read yet. */
typedef struct sli_reader {
    const char *at, *end;
    sl_off line; /* lines taken so far */
} sli_reader;

/* Takes the next line that is neither blank nor a comment; *stop is its end. 0 at the end of the
 * text. */
static int sli_next_line(sli_reader *r, const char **start, const char **stop, int comments) {
    while (r->at < r->end) {
        const char *s = r->at, *e = s;
        while (e < r->end && *e != '\n') {
            e++;
        }
        r->at = e < r->end ? e + 1 : e;
        r->line++;
        while (s < e && (*s == ' ' || *s == '\t' || *s == '\r')) {
            s++;
        }
        if (s < e && (comments || *s != '%')) {
            *start = s;
            *stop = e;
            return 1;
        }
    }
    return 0;
}

/* Copies the next word of a line; 0 if there is none or it is too long. */
static int sli_token(const char **at, const char *stop, char *token) {
    const char *s = *at;
    int length = 0;
    while (s < stop && (*s == ' ' || *s == '\t' || *s == '\r')) {
        s++;
    }
    while (s < stop && *s != ' ' && *s != '\t' && *s != '\r') {
        if (length == SLI_TOKEN_MAX || *s == '\0') {
            return 0;
        }
        token[length++] = *s++;
    }
    token[length] = '\0';
    *at = s;
    return length > 0;
}

/* The next word as a whole number in low..high. */
static int sli_token_int(const char **at, const char *stop, sl_off low, sl_off high, sl_off *out) {
    char token[SLI_TOKEN_MAX + 1];
    sl_off value = 0;
    int k = 0;
    if (!sli_token(at, stop, token)) {
        return 0;
    }
    k += token[0] == '+';
    if (token[k] == '\0') {
        return 0;
    }
    for (; token[k] != '\0'; k++) {
        if (token[k] < '0' || token[k] > '9' || value > (INT64_MAX - 9) / 10) {
            return 0;
        }
        value = 10 * value + (token[k] - '0');
    }
    *out = value;
    return value >= low && value <= high;
}

/* The next word as a number; the C library wants the decimal point of the current locale. */
static int sli_token_double(const char **at, const char *stop, double *out) {
    char token[SLI_TOKEN_MAX + 1], *point, *rest;
    if (!sli_token(at, stop, token)) {
        return 0;
    }
    point = strchr(token, '.');
    if (point != NULL) {
        *point = *localeconv()->decimal_point;
    }
    *out = strtod(token, &rest);
    return rest != token && *rest == '\0';
}

/* Whether the next word is the given one, capitals or not. */
static int sli_token_is(const char *token, const char *word) {
    for (; *token != '\0' && *word != '\0'; token++, word++) {
        const char c = *token >= 'A' && *token <= 'Z' ? (char)(*token - 'A' + 'a') : *token;
        if (c != *word) {
            return 0;
        }
    }
    return *token == *word;
}

/* Whether the word is one of a list that ends in NULL. */
static int sli_token_in(const char *token, const char *const *words) {
    while (*words != NULL && !sli_token_is(token, *words)) {
        words++;
    }
    return *words != NULL;
}

/* "%%MatrixMarket matrix coordinate <field> <symmetry>"; what the format knows and this library
 * does not read is told apart from what is no such file. */
static sl_status sli_read_banner(sli_reader *r, int *has_values, int *symmetric) {
    static const char *const sli_formats[] = {"coordinate", "array", NULL};
    static const char *const sli_fields[] = {"real", "integer", "pattern", "complex", NULL};
    static const char *const sli_symmetries[] = {"general", "symmetric", "skew-symmetric",
                                                 "hermitian", NULL};
    char token[5][SLI_TOKEN_MAX + 1];
    const char *s, *e;
    int k;
    if (!sli_next_line(r, &s, &e, 1)) {
        return SL_ERR_IO;
    }
    for (k = 0; k < 5; k++) {
        if (!sli_token(&s, e, token[k])) {
            return SL_ERR_IO;
        }
    }
    if (!sli_token_is(token[0], "%%matrixmarket") || !sli_token_is(token[1], "matrix") ||
        !sli_token_in(token[2], sli_formats) || !sli_token_in(token[3], sli_fields) ||
        !sli_token_in(token[4], sli_symmetries)) {
        return SL_ERR_IO;
    }
    *has_values = !sli_token_is(token[3], "pattern");
    *symmetric = sli_token_is(token[4], "symmetric");
    return sli_token_is(token[2], "coordinate") && !sli_token_is(token[3], "complex") &&
                   (*symmetric || sli_token_is(token[4], "general"))
               ? SL_OK
               : SL_ERR_UNSUPPORTED;
}

/* Whether nothing but blanks is left of a line. */
static int sli_line_ends(const char *s, const char *e) {
    while (s < e && (*s == ' ' || *s == '\t' || *s == '\r')) {
        s++;
    }
    return s == e;
}

/* count lines "row column [value]", 1-based; entries of a symmetric file go to the lower triangle.
 */
static sl_status sli_read_entries(sli_reader *r, const sl_off *size, int symmetric, sl_int *i,
                                  sl_int *j, double *x) {
    const char *s, *e;
    sl_off k, row, column;
    for (k = 0; k < size[2]; k++) {
        if (!sli_next_line(r, &s, &e, 0) || !sli_token_int(&s, e, 1, size[0], &row) ||
            !sli_token_int(&s, e, 1, size[1], &column) ||
            (x != NULL && !sli_token_double(&s, e, &x[k])) || !sli_line_ends(s, e)) {
            return SL_ERR_IO;
        }
        i[k] = (sl_int)(symmetric && row < column ? column : row) - 1;
        j[k] = (sl_int)(symmetric && row < column ? row : column) - 1;
    }
    return sli_next_line(r, &s, &e, 0) ? SL_ERR_IO : SL_OK;
}

static sl_status sli_parse(sl_matrix **out, sli_reader *r, const sl_allocator *a) {
    const char *s, *e;
    sl_off size[3] = {0, 0, 0};
    sli_block b = {NULL, 0, 0};
    sl_int *i = NULL, *j = NULL;
    double *x = NULL;
    int has_values, symmetric, k;
    sl_status status = sli_read_banner(r, &has_values, &symmetric);
    if (status != SL_OK) {
        return status;
    }
    if (!sli_next_line(r, &s, &e, 0)) {
        return SL_ERR_IO;
    }
    for (k = 0; k < 3; k++) {
        if (!sli_token_int(&s, e, 0, INT64_MAX, &size[k])) {
            return SL_ERR_IO;
        }
        if (size[k] > SLI_ROWS_MAX) {
            return SL_ERR_TOO_LARGE;
        }
    }
    /* an entry takes four bytes at least: a count that the file cannot hold is refused before
     * memory is asked for */
    if (!sli_line_ends(s, e) || (symmetric && size[0] != size[1]) ||
        size[2] > (r->end - r->at) / 4 + 1) {
        return SL_ERR_IO;
    }
    for (k = 0; k < 2 && status == SL_OK; k++) {
        i = SLI_TAKE(&b, sl_int, size[2]);
        j = SLI_TAKE(&b, sl_int, size[2]);
        x = has_values ? SLI_TAKE(&b, double, size[2]) : NULL;
        status = k == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status == SL_OK) {
        status = sli_read_entries(r, size, symmetric, i, j, x);
        if (status == SL_OK) {
            status = sli_from_triplets(out, (sl_int)size[0], (sl_int)size[1], (sl_int)size[2], i, j,
                                       x, a);
        }
        sli_free(a, b.base);
    }
    return status;
}

SL_API sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                                 const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const int saved = errno; /* strtod may set it */
    sli_reader r;
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (text == NULL || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    r.at = text;
    r.end = text + length;
    r.line = 0;
    status = sli_parse(out, &r, &a);
    if (status != SL_OK && stats != NULL) {
        stats->error_line = r.line > 0 ? r.line : 1;
    }
    errno = saved;
    return status;
}

/* The whole file in memory; *text is allocated also on error, if at all. */
static sl_status sli_load(FILE *file, char **text, size_t *length, const sl_allocator *a) {
    size_t room = (size_t)1 << 16, got;
    *length = 0;
    *text = (char *)sli_alloc(a, room);
    while (*text != NULL) {
        got = fread(*text + *length, 1, room - *length, file);
        *length += got;
        if (*length < room) {
            return ferror(file) ? SL_ERR_IO : SL_OK;
        } else {
            char *larger = room > SIZE_MAX / 2 ? NULL : (char *)sli_alloc(a, 2 * room);
            if (larger != NULL) {
                memcpy(larger, *text, *length);
            }
            sli_free(a, *text);
            *text = larger;
            room *= 2;
        }
    }
    return SL_ERR_MEMORY;
}

SL_API sl_status sl_matrix_read(sl_matrix **out, const char *path, const sl_options *opt,
                                sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const int saved = errno;
    char *text = NULL;
    size_t length = 0;
    FILE *file;
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (path == NULL || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    file = fopen(path, "rb");
    if (file == NULL) {
        errno = saved;
        return SL_ERR_IO;
    }
    status = sli_load(file, &text, &length, &a);
    fclose(file);
    if (status == SL_OK) {
        status = sl_matrix_parse(out, text, length, opt, stats);
    }
    sli_free(&a, text);
    errno = saved;
    return status;
}

/* One entry, 1-based, with a decimal point whatever the locale. */
static int sli_write_entry(FILE *file, sl_int row, sl_int column, const double *value) {
    char number[40], *point;
    if (value == NULL) {
        return fprintf(file, "%ld %ld\n", (long)row + 1, (long)column + 1) > 0;
    }
    snprintf(number, sizeof number, "%.17g", *value);
    point = strchr(number, *localeconv()->decimal_point);
    if (point != NULL) {
        *point = '.';
    }
    return fprintf(file, "%ld %ld %s\n", (long)row + 1, (long)column + 1, number) > 0;
}

static int sli_write(FILE *file, const sl_csc *A, sl_reading reading, sl_triangle triangle) {
    sl_int j, p;
    sl_off count = 0;
    int ok;
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            count += sli_is_read(triangle, A->i[p], j);
        }
    }
    ok = fprintf(file, "%%%%MatrixMarket matrix coordinate %s %s\n%ld %ld %ld\n",
                 A->x != NULL ? "real" : "pattern",
                 reading == SL_AS_SYMMETRIC ? "symmetric" : "general", (long)A->n_rows,
                 (long)A->n_cols, (long)count) > 0;
    for (j = 0; j < A->n_cols && ok; j++) {
        for (p = A->p[j]; p < A->p[j + 1] && ok; p++) {
            const sl_int i = A->i[p];
            if (sli_is_read(triangle, i, j)) {
                const int flip = reading == SL_AS_SYMMETRIC && i < j;
                ok = sli_write_entry(file, flip ? j : i, flip ? i : j,
                                     A->x != NULL ? A->x + p : NULL);
            }
        }
    }
    return ok;
}

SL_API sl_status sl_csc_write(const sl_csc *A, sl_reading reading, const char *path) {
    const int saved = errno;
    sl_triangle triangle = SL_TRIANGLE_NONE;
    sl_status status = reading == SL_AS_SYMMETRIC ? sl_csc_triangle(A, &triangle, NULL, NULL)
                                                  : sl_csc_check(A, NULL);
    FILE *file;
    int ok;
    if (status != SL_OK) {
        return status;
    }
    if (path == NULL || (reading != SL_AS_SYMMETRIC && reading != SL_AS_STORED)) {
        return SL_ERR_ARGUMENT;
    }
    file = fopen(path, "wb");
    ok = file != NULL && sli_write(file, A, reading, triangle);
    if (file != NULL) {
        ok = fclose(file) == 0 && ok;
    }
    errno = saved;
    return ok ? SL_OK : SL_ERR_IO;
}

#endif
