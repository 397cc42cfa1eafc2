/* matrix_market.h: reads coordinate Matrix Market files, in any locale */
#ifndef SLI_FILES_MATRIX_MARKET_H
#define SLI_FILES_MATRIX_MARKET_H

#include "../../public/files.h"
#include "../base/sort.h"
#include "../matrix/csc_triangle.h"
#include "text_reader.h"

#define SLI_ENTRIES_FIRST 65536 /* entries of a file for which memory is allocated at first */

/* Records what is malformed; returns the status. */
static sl_status sli_malformed(sli_reader *r, const char *what) {
    r->what = r->failed != NULL ? r->failed : what;
    return sli_refuse(SL_ERR_IO, r->what);
}

/* Reads the banner "%%MatrixMarket matrix coordinate <field> <symmetry>". A banner of the format
 * that this library does not read gives SL_ERR_UNSUPPORTED, anything else SL_ERR_IO. */
static sl_status sli_read_banner(sli_reader *r, int *has_values, int *symmetric) {
    static const char *const sli_formats[] = {"coordinate", "array", NULL};
    static const char *const sli_fields[] = {"real", "integer", "pattern", "complex", NULL};
    static const char *const sli_symmetries[] = {"general", "symmetric", "skew-symmetric",
                                                 "hermitian", NULL};
    static const char sli_not_ours[] = "not a Matrix Market file of a matrix";
    char token[5][SLI_TOKEN_MAX + 1];
    const char *s, *e;
    int k;
    sli_skip_mark(r);
    if (!sli_next_line(r, &s, &e, 1)) {
        return sli_malformed(r, "the file is empty");
    }
    for (k = 0; k < 5; k++) {
        if (!sli_token(&s, e, token[k])) {
            return sli_malformed(r, sli_not_ours);
        }
    }
    if (!sli_token_is(token[0], "%%matrixmarket") || !sli_token_is(token[1], "matrix") ||
        !sli_token_in(token[2], sli_formats) || !sli_token_in(token[3], sli_fields) ||
        !sli_token_in(token[4], sli_symmetries)) {
        return sli_malformed(r, sli_not_ours);
    }
    *has_values = !sli_token_is(token[3], "pattern");
    /* a Hermitian matrix without imaginary parts is symmetric */
    *symmetric = sli_token_is(token[4], "symmetric") || sli_token_is(token[4], "hermitian");
    r->what = sli_token_is(token[2], "array")            ? "array"
              : sli_token_is(token[3], "complex")        ? "complex"
              : sli_token_is(token[4], "skew-symmetric") ? "skew-symmetric"
                                                         : NULL;
    return r->what == NULL ? SL_OK : sli_refuse(SL_ERR_UNSUPPORTED, r->what);
}

/* Entries read, with room for more. */
typedef struct sli_triplets {
    void *block;
    sl_int *i, *j;
    double *x; /* NULL: a pattern */
    sl_off count, room;
} sli_triplets;

/* Allocates room for more entries and moves those that were read. */
static sl_status sli_triplets_grow(sli_triplets *t, sl_off room, int has_values,
                                   const sl_allocator *a) {
    sli_block b = {NULL, 0};
    sli_triplets larger = *t;
    sl_status status = SL_OK;
    larger.room = room;
    SLI_LAYOUT(&b, a, status) {
        larger.i = SLI_TAKE(&b, sl_int, room);
        larger.j = SLI_TAKE(&b, sl_int, room);
        larger.x = has_values ? SLI_TAKE(&b, double, room) : NULL;
    }
    if (status != SL_OK) {
        return status;
    }
    if (t->count > 0) {
        SLI_COPY(larger.i, t->i, t->count);
        SLI_COPY(larger.j, t->j, t->count);
        if (has_values) {
            SLI_COPY(larger.x, t->x, t->count);
        }
    }
    sli_free(a, t->block);
    larger.block = b.base;
    *t = larger;
    return SL_OK;
}

/* Reads size[2] lines "row column [value]", 1-based, and checks that no other line follows. */
static sl_status sli_read_entries(sli_reader *r, const sl_off *size, int has_values,
                                  sli_triplets *t, const sl_allocator *a) {
    const char *s, *e;
    sl_off row, column;
    sl_status status;
    for (; t->count < size[2]; t->count++) {
        if (t->count == t->room) {
            const sl_off more = 2 * t->room < size[2] ? 2 * t->room : size[2];
            status = sli_triplets_grow(t, more, has_values, a);
            if (status != SL_OK) {
                return status;
            }
        }
        if (!sli_next_line(r, &s, &e, 0) || !sli_token_int(&s, e, 1, size[0], &row) ||
            !sli_token_int(&s, e, 1, size[1], &column) ||
            (has_values && !sli_token_double(r, &s, e, &t->x[t->count])) || !sli_line_ends(s, e)) {
            return sli_malformed(r,
                                 r->at == r->end && r->file == NULL
                                     ? "fewer entries than the header says, or a malformed one"
                                     : "an entry is malformed or out of range; rows count from 1");
        }
        t->i[t->count] = (sl_int)row - 1;
        t->j[t->count] = (sl_int)column - 1;
    }
    return sli_next_line(r, &s, &e, 0) || r->failed != NULL
               ? sli_malformed(r, "more entries than the header says")
               : SL_OK;
}

/* Are there entries below the diagonal, and are there others above it? */
static int sli_has_both_triangles(const sli_triplets *t) {
    int lower = 0, upper = 0;
    sl_off k;
    for (k = 0; k < t->count; k++) {
        lower |= t->i[k] > t->j[k];
        upper |= t->i[k] < t->j[k];
    }
    return lower && upper;
}

/* Refuses a matrix with an entry in one triangle and its mirror image in the other. */
static sl_status sli_check_mirrored(const sl_matrix *M, sli_reader *r) {
    sl_int j, p;
    for (j = 0; j < M->n_cols; j++) {
        for (p = M->p[j]; p < M->p[j + 1] && M->i[p] < j; p++) {
            const sl_int i = M->i[p], *column = M->i + M->p[i];
            const sl_int count = M->p[i + 1] - M->p[i];
            const sl_int at = sli_lower_bound(column, count, j);
            if (at < count && column[at] == j) {
                r->what = "both triangles of a symmetric matrix";
                r->twice[0] = i;
                r->twice[1] = j;
                return sli_refuse(SL_ERR_MALFORMED, r->what);
            }
        }
    }
    return SL_OK;
}

/* Moves the entries of a symmetric file into the lower triangle. An entry that stands in both
 * triangles would be counted twice, and is refused. */
static sl_status sli_fold_entries(const sli_triplet_list *list, sli_triplets *t, sli_reader *r,
                                  const sl_allocator *a) {
    sl_status status = SL_OK;
    sl_off k;
    if (sli_has_both_triangles(t)) {
        sl_matrix *M = NULL;
        status = sli_from_triplets(&M, list, a);
        status = status == SL_OK ? sli_check_mirrored(M, r) : status;
        sl_matrix_free(M);
    }
    for (k = 0; k < t->count; k++) {
        if (t->i[k] < t->j[k]) {
            const sl_int row = t->i[k];
            t->i[k] = t->j[k];
            t->j[k] = row;
        }
    }
    return status;
}

/* A few lines may promise gigabytes of empty rows: memory stays within the size of the file. */
static sl_status sli_check_empty(sli_reader *r, const sl_off *size) {
    const sl_off rows = size[0] > size[1] ? size[0] : size[1];
    if (rows / 16 <= SLI_ENTRIES_FIRST + size[2]) {
        return SL_OK;
    }
    r->what = "more than 2^20 rows or columns, and over 16 for each entry";
    return sli_refuse(SL_ERR_TOO_LARGE, r->what);
}

/* Reads a whole matrix. Memory grows with the entries that are there, not with the number that the
 * header promises. */
static sl_status sli_parse(sl_matrix **out, sli_reader *r, const sl_allocator *a) {
    const char *s, *e;
    sl_off size[3] = {0, 0, 0}, room;
    sli_triplets t;
    int has_values = 0, symmetric = 0, k;
    sl_status status = sli_read_banner(r, &has_values, &symmetric);
    if (status != SL_OK) {
        return status;
    }
    if (!sli_next_line(r, &s, &e, 0)) {
        return sli_malformed(r, "the file ends before the line of sizes");
    }
    for (k = 0; k < 3; k++) {
        if (!sli_token_int(&s, e, 0, INT64_MAX, &size[k])) {
            return sli_malformed(r, "the line of sizes is malformed");
        }
        if (size[k] > SLI_ROWS_MAX) {
            r->what = "more than 2^31 - 8 rows, columns or entries";
            return sli_refuse(SL_ERR_TOO_LARGE, r->what);
        }
    }
    /* An entry has at least four bytes. A count that a text in memory cannot hold is refused before
     * memory is allocated. */
    if (!sli_line_ends(s, e) || (symmetric && size[0] != size[1]) ||
        (r->buffer == NULL && size[2] > (r->end - r->at) / 4 + 1)) {
        return sli_malformed(r,
                             "the line of sizes is wrong: more on it, a symmetric matrix that is "
                             "not square, or more entries than the text can hold");
    }
    SLI_CLEAR(t);
    room = r->buffer == NULL || size[2] < SLI_ENTRIES_FIRST ? size[2] : SLI_ENTRIES_FIRST;
    status = sli_triplets_grow(&t, room, has_values, a);
    status = status == SL_OK ? sli_read_entries(r, size, has_values, &t, a) : status;
    status = status == SL_OK ? sli_check_empty(r, size) : status;
    if (status == SL_OK) {
        sli_triplet_list list;
        list.n_rows = (sl_int)size[0];
        list.n_cols = (sl_int)size[1];
        list.count = (sl_int)size[2];
        list.i = t.i;
        list.j = t.j;
        list.x = t.x;
        status = symmetric ? sli_fold_entries(&list, &t, r, a) : SL_OK;
        status = status == SL_OK ? sli_from_triplets(out, &list, a) : status;
    }
    sli_free(a, t.block);
    return status;
}

/* Reads the matrix; in any locale, and without a trace in errno. */
static sl_status sli_read_matrix(sl_matrix **out, sli_reader *r, const sl_allocator *a,
                                 sl_stats *stats) {
    const int saved = errno; /* strtod may set it */
    sl_status status;
    sli_find_point(r->point);
    status = sli_parse(out, r, a);
    if (status == SL_ERR_MALFORMED) { /* not at the line that was read last */
        (void)sli_fail_at(stats, status, r->twice[0], r->twice[1], 0.0, r->what);
    } else if (status != SL_OK) {
        if (r->what != NULL) {
            (void)sli_fail_at(stats, status, -1, -1, (double)r->error, r->what);
        }
        (void)sli_report(stats, status);
        sli_error_line(stats, r->line > 0 ? r->line : 1);
    }
    errno = saved;
    return status;
}

SL_API sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                                 const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sli_reader r;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    if (status == SL_OK) {
        status =
            sli_argument(text == NULL ? "text is NULL" : sli_options_wrong(opt, SLI_READS_NOTHING));
    }
    if (status == SL_OK) {
        SLI_CLEAR(r);
        r.at = text;
        r.end = text + length;
        status = sli_read_matrix(out, &r, &a, stats);
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_matrix_read(sl_matrix **out, const char *path, const sl_options *opt,
                                sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const int saved = errno;
    sli_reader r;
    FILE *file;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    if (status == SL_OK) {
        status =
            sli_argument(path == NULL ? "path is NULL" : sli_options_wrong(opt, SLI_READS_NOTHING));
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    errno = 0;
    file = fopen(path, "rb");
    if (file == NULL) {
        status = sli_file_fails("the file cannot be opened");
        errno = saved;
        return sli_report(stats, status);
    }
    SLI_CLEAR(r);
    r.file = file;
    r.buffer = (char *)sli_alloc(&a, SLI_LINE_MAX);
    if (r.buffer != NULL) {
        r.at = r.end = r.buffer;
        status = sli_read_matrix(out, &r, &a, stats);
    } else {
        status = sli_no_memory();
    }
    sli_free(&a, r.buffer);
    fclose(file);
    errno = saved;
    return sli_report(stats, status);
}

#endif
