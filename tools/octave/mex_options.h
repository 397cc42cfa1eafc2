/* mex_options.h: the options of a factor, from a cell array of names and values */
#ifndef SL_OCTAVE_MEX_OPTIONS_H
#define SL_OCTAVE_MEX_OPTIONS_H

#include "mex_call.h"

/* The position of a word in a list with | between words. */
static int word_in(const char *name, const mxArray *value, const char *words) {
    char word[32] = "";
    const char *at = words;
    int k;
    if (mxIsChar(value)) (void)mxGetString(value, word, sizeof word);
    for (k = 0;; k++) {
        const size_t length = strcspn(at, "|");
        if (length == strlen(word) && strncmp(at, word, length) == 0) return k;
        if (at[length] == 0) break;
        at += length + 1;
    }
    mexErrMsgIdAndTxt("sparse_local:argument", "invalid argument: %s is one of %s", name, words);
    return 0;
}

static double number_in(const char *name, const mxArray *value) {
    if ((!mxIsDouble(value) && !mxIsLogical(value)) || mxGetNumberOfElements(value) != 1) {
        mexErrMsgIdAndTxt("sparse_local:argument", "invalid argument: %s is one number", name);
    }
    return mxGetScalar(value);
}

static sl_int whole_in(const char *name, const mxArray *value) {
    const double x = number_in(name, value);
    if (!(x >= 0 && x <= 0x7fffffff && x == floor(x))) {
        mexErrMsgIdAndTxt("sparse_local:argument", "invalid argument: %s is a whole number", name);
    }
    return (sl_int)x;
}

static sl_int *signs_in(const mxArray *value, sl_int n) {
    sl_int k, columns, *signs = (sl_int *)mxMalloc(sizeof *signs * ((size_t)n + 1));
    const double *x = dense(value, "signs", n, &columns);
    for (k = 0; k < n; k++) {
        signs[k] = (x[k] > 0) - (x[k] < 0);
    }
    return signs;
}

/* Two options are one of the library's: they exclude each other. */
static void set_pivots(sl_options *o, sl_pivots pivots) {
    if (o->pivots != SL_PIVOTS_NONZERO && o->pivots != pivots) {
        refuse("definite excludes null_pivots = 'skip'");
    }
    o->pivots = pivots;
}

/* Sets one option; those of arrays have n rows. Returns 0 if there is no such option. */
static int set_option(sl_options *o, int *pivoted, const char *name, const mxArray *value,
                      sl_int n) {
    static const sl_ordering orderings[] = {SL_ORDERING_ND, SL_ORDERING_MINDEG,
                                            SL_ORDERING_NATURAL};
    sl_int count = 0;
    if (strcmp(name, "pivoted") == 0) {
        *pivoted = number_in(name, value) != 0;
    } else if (strcmp(name, "definite") == 0) {
        if (number_in(name, value) != 0) set_pivots(o, SL_PIVOTS_POSITIVE);
    } else if (strcmp(name, "threads") == 0) {
        o->threads.count = whole_in(name, value);
    } else if (strcmp(name, "triangle") == 0) {
        o->triangle = (sl_triangle)word_in(name, value, "auto|lower|upper");
    } else if (strcmp(name, "ordering") == 0) {
        o->ordering = orderings[word_in(name, value, "nd|mindeg|natural")];
    } else if (strcmp(name, "perm") == 0) {
        o->ordering = SL_ORDERING_GIVEN;
        o->perm = rows_of(value, &count);
        if (count != n) refuse("perm has one element for each row");
    } else if (strcmp(name, "purpose") == 0) {
        o->purpose = (sl_purpose)word_in(name, value, "many solves|one factor");
    } else if (strcmp(name, "block_size") == 0) {
        o->block_size = whole_in(name, value);
    } else if (strcmp(name, "storage") == 0) {
        o->storage = (sl_storage)word_in(name, value, "double|float");
    } else if (strcmp(name, "null_pivots") == 0) {
        if (word_in(name, value, "refuse|skip") == 1) set_pivots(o, SL_PIVOTS_SKIP_NULL);
    } else if (strcmp(name, "null_tolerance") == 0) {
        o->null_tolerance = number_in(name, value);
    } else if (strcmp(name, "consistency_tolerance") == 0) {
        o->consistency_tolerance = number_in(name, value);
    } else if (strcmp(name, "mass") == 0) {
        o->mass = dense(value, name, n, &count);
    } else if (strcmp(name, "null_vector") == 0) {
        o->null_vector = dense(value, name, n, &count);
        o->null_vector_count = count;
    } else if (strcmp(name, "regularization") == 0) {
        o->regularization = number_in(name, value);
    } else if (strcmp(name, "signs") == 0) {
        o->signs = signs_in(value, n);
    } else if (strcmp(name, "growth_limit") == 0) {
        o->growth_limit = number_in(name, value);
    } else if (strcmp(name, "error_limit") == 0) {
        o->error_limit = number_in(name, value);
    } else {
        return 0;
    }
    return 1;
}

/* The options of a cell array {name, value, name, value, ...}. */
static void options_of(const mxArray *list, sl_options *o, int *pivoted, sl_int n) {
    size_t k;
    const size_t count = mxIsCell(list) ? mxGetNumberOfElements(list) : 1;
    char name[32];
    int has_ordering = 0;
    sl_options_init(o, sizeof *o);
    *pivoted = 0;
    if (count % 2 != 0) refuse("options are pairs of a name and a value");
    for (k = 0; k < count; k += 2) {
        const mxArray *word = mxGetCell(list, (mwIndex)k), *value = mxGetCell(list, (mwIndex)k + 1);
        if (word == NULL || value == NULL || !mxIsChar(word) ||
            mxGetString(word, name, sizeof name) != 0 || !set_option(o, pivoted, name, value, n)) {
            mexErrMsgIdAndTxt("sparse_local:argument",
                              "invalid argument: option %.0f has no name that is "
                              "known; see help sparse_local",
                              (double)(k / 2 + 1));
        }
        has_ordering |= strcmp(name, "ordering") == 0;
    }
    if (has_ordering && o->perm != NULL) refuse("perm excludes an ordering");
}

#endif
