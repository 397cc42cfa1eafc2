/* mex_errors.h: errors of the library as those of Octave: identifiers, own names, rows from 1 on */
#ifndef SL_OCTAVE_MEX_ERRORS_H
#define SL_OCTAVE_MEX_ERRORS_H

#include "mex_call.h"
#include <ctype.h>

/* What sentences of the library call by its names in C, and what that is here. A name that begins
 * with another one stands before it. */
static const struct {
    const char *c, *ours;
} names[] = {
    {"options.pivots = SL_PIVOTS_SKIP_NULL", "'null_pivots', 'skip'"},
    {"options.pivots = SL_PIVOTS_NONZERO", "'null_pivots', 'refuse' without 'definite', true"},
    {"SL_PIVOTS_SKIP_NULL", "'null_pivots', 'skip'"},
    {"SL_PIVOTS_POSITIVE", "'definite', true"},
    {"of sl_symbolic_create_pivoted", "with 'pivoted', true"},
    {"sl_symbolic_create_pivoted", "'pivoted', true"},
    {"see options.pivots and", "see 'null_pivots', 'skip' and"},
    {"compiled with SL_NO_SINGULAR", "not compiled in"},
    {"columns are given, options.null_vector_count", "'null_vector' has columns"},
    {"options.null_vector_count is below 0 or above 32", "'null_vector' has more than 32 columns"},
    {"options.storage needs SL_WITH_COMPLEX", "complex storage is not compiled in"},
    {"options.storage needs SL_WITH_FLOAT", "'storage', 'float' is not compiled in"},
    {"SL_STORAGE_COMPLEX", "complex storage"},
    {"threads.count is above 1: compile with SL_PTHREADS or OpenMP, or set threads.run",
     "'threads' is above 1: compile the mex file with OpenMP"},
    {"options.threads.count", "'threads'"},
    {"options.block_size", "'block_size'"},
    {"options.consistency_tolerance", "'consistency_tolerance'"},
    {"options.error_limit", "'error_limit'"},
    {"options.growth_limit", "'growth_limit'"},
    {"options.mass", "'mass'"},
    {"options.null_tolerance", "'null_tolerance'"},
    {"options.null_vector", "'null_vector'"},
    {"options.perm", "'perm'"},
    {"options.regularization", "'regularization'"},
    {"options.signs", "'signs'"},
    {"options.storage", "'storage'"},
    {"options.triangle", "'triangle'"},
    {"sl_constraints_refactor", "P.refactor()"},
    {"a row of bset or xset", "a row of I or J"},
    {"size_t counts", "the system addresses"},
    {"rows count from 0", "rows count from 1"},
    {"A.p descends", "the columns of A are out of order"},
    {"A.p[0] is not 0", "the first column of A does not begin its entries"},
    {"METIS_NodeND", "METIS"},
};

/* Words that only C has: what names one gives way to the text of its status. */
static const char *const of_c[] = {
    "sl_", "SL_", "options.", "options is not", "stats.", "set.", "set is not", "threads.", "NULL",
    "size_t", "A.", "V.", "H.", "P.columns", "ldb ", "ldg ", "ldr ", "ldx ", "ldy ", "ldz ",
    "n_rows", "n_cols", "n_columns", "log_abs_det", "backward_error", "new_of"};

static int is_of_word(char c) {
    return isalnum((unsigned char)c) || c == '_';
}

/* The length of a name of C that begins at text[at], and what it is here; 0: there is none. */
static size_t name_at(const char *text, size_t at, const char **ours) {
    size_t k;
    if (at > 0 && is_of_word(text[at - 1])) return 0;
    for (k = 0; k < sizeof names / sizeof names[0]; k++) {
        const size_t length = strlen(names[k].c);
        if (strncmp(text + at, names[k].c, length) == 0 && !is_of_word(text[at + length])) {
            *ours = names[k].ours;
            return length;
        }
    }
    return 0;
}

/* The place at the end of a message, as " (row 3)", or its end. */
static const char *place_of(const char *text) {
    static const char *const words[] = {" (row ", " (column ", " (line ", " (value ", " (errno "};
    const char *place = strrchr(text, '(');
    size_t k;
    for (k = 0; place != NULL && place > text && k < sizeof words / sizeof words[0]; k++) {
        if (strncmp(place - 1, words[k], strlen(words[k])) == 0) return place - 1;
    }
    return text + strlen(text);
}

/* Adds 1 to the number behind a word of the place, as in (row 4). */
static void count_from_one(char *text, size_t size, const char *word) {
    char *at = strstr(text + (place_of(text) - text), word), *end;
    char rest[200];
    long number;
    if (at == NULL) return;
    at += strlen(word);
    number = strtol(at, &end, 10);
    (void)snprintf(rest, sizeof rest, "%ld%s", number + 1, end);
    (void)snprintf(at, size - (size_t)(at - text), "%s", rest);
}

/* Writes a sentence of the library in the names and row numbers of this folder. */
static void in_own_names(char *out, size_t size, const char *text, sl_status status) {
    const char *place = place_of(text);
    const size_t end = (size_t)(place - text);
    size_t at = 0, used = 0, k;
    out[0] = 0;
    while (at < end && used < size) {
        const char *ours = NULL;
        const size_t length = name_at(text, at, &ours);
        used += (size_t)(length > 0 ? snprintf(out + used, size - used, "%s", ours)
                                    : snprintf(out + used, size - used, "%c", text[at]));
        at += length > 0 ? length : 1;
    }
    for (k = 0; k < sizeof of_c / sizeof of_c[0]; k++) {
        const char *found = strstr(out, of_c[k]);
        if (found != NULL && (found == out || !is_of_word(found[-1]))) {
            used = (size_t)snprintf(out, size, "%s", sl_status_string(status));
            break;
        }
    }
    if (used < size) (void)snprintf(out + used, size - used, "%s", place);
    count_from_one(out, size, "row ");
    count_from_one(out, size, "column ");
}

/* The end of the identifier of each status, which is that of C in lower case. */
static const char *const ids[] = {"ok",         "argument",      "memory",    "malformed",
                                  "pivot",      "not_finite",    "too_large", "unsupported",
                                  "io",         "ordering",      "mismatch",  "inconsistent",
                                  "inaccurate", "other_pattern", "stale",     "read_only"};

/* Raises the error of a status. */
static void fail(sl_status status) {
    char id[64], said[600], text[1000];
    (void)sl_error_text(said, sizeof said, status, NULL);
    in_own_names(text, sizeof text, said, status);
    (void)snprintf(id, sizeof id, "sparse_local:%s", ids[status]);
    mexErrMsgIdAndTxt(id, "%s", text);
}

/* list = statuses(): the ends of all identifiers, for tests */
static sl_status statuses(call *c) {
    const size_t count = sizeof ids / sizeof ids[0];
    size_t k;
    c->out[0] = mxCreateCellMatrix(1, (mwSize)count);
    for (k = 0; k < count; k++) {
        mxSetCell(c->out[0], (mwIndex)k, mxCreateString(ids[k]));
    }
    return SL_OK;
}

/* text = own_names(text): a sentence as an error would have it, for tests */
static sl_status own_names(call *c) {
    char said[600] = "", text[1000];
    if (!mxIsChar(c->in[0]) || mxGetString(c->in[0], said, sizeof said) != 0) refuse("a sentence");
    in_own_names(text, sizeof text, said, SL_ERR_ARGUMENT);
    c->out[0] = mxCreateString(text);
    return SL_OK;
}

#endif
