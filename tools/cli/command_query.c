/* command_query.c: answers local solves with a saved factor, a line for each question */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "saved_file.h"
#include "solve_accuracy.h"

static const options_usage usage = {"query", "FILE.slf", 1, 1,
                                    "Solves with a saved factor: a line of answers for each "
                                    "question on standard input."};

static const options_manual manual = {
    "A question is a line B;VALUES;X. B and X are lists of rows such as 3,17,100-200 or all. "
    "VALUES "
    "are the entries of b in the rows of B, separated by commas, or one value for all of them. All "
    "other entries of b are 0. Empty lines and lines that begin with # are skipped. The file is "
    "mapped: processes that use it at the same time share one copy in memory. Where B and X are in "
    "a region that the file has (save --region), only that part of the factor is read, and answers "
    "agree with others to rounding.",
    "For each question a line with the entries of x in the rows of X, separated by commas, with "
    "all digits. A malformed question ends the program.",
    "hills.slf < questions.txt > answers.csv"};

typedef struct query_line {
    char *text;
    size_t capacity;
    long number;
} query_line;

/* Bounds the memory that an input without line ends takes. */
enum { LONGEST_LINE = 1 << 30 };

/* Reads the next line without its end; returns false at the end of the input. */
static bool read_line(query_line *line, FILE *file) {
    size_t length = 0;
    int c;
    while ((c = getc(file)) != EOF && c != '\n') {
        if (c == '\0' || length == LONGEST_LINE) {
            app_die("line %ld: %s", line->number + 1,
                    c == '\0' ? "a zero byte: this is not text" : "longer than 1 GiB");
        }
        if (length + 1 >= line->capacity) {
            line->capacity = 2 * line->capacity + 256;
            char *larger = realloc(line->text, line->capacity);
            if (larger == NULL) {
                app_die("out of memory");
            }
            line->text = larger;
        }
        line->text[length++] = (char)c;
    }
    if (ferror(file)) {
        app_die("standard input cannot be read");
    }
    if (c == EOF && length == 0) {
        return false;
    }
    if (line->text == NULL) {
        line->text = app_alloc(line->capacity = 256, 1);
    }
    if (length > 0 && line->text[length - 1] == '\r') {
        length--;
    }
    line->text[length] = '\0';
    line->number++;
    return true;
}

/* Reads a list of different rows; name: the part of the question. */
static sl_int *read_rows(const char *text, sl_int n, sl_int *count, char name, long number) {
    char message[512];
    sl_int *rows;
    if (app_read_vertices(&rows, count, text, n, message, sizeof message) != 0) {
        app_die("line %ld: %c: %s", number, name, message);
    }
    if (app_distinct(rows, *count, n) < *count) {
        app_die("line %ld: %c: a row is repeated", number, name);
    }
    return rows;
}

/* Reads `count` values, or one for all. */
static double *read_values(const char *text, sl_int count, long number) {
    double *values = app_alloc((size_t)count, sizeof *values);
    sl_int found = 0;
    for (const char *at = text;; at++) {
        char *after = NULL;
        const double value = strtod(at, &after);
        if (after == at || !isfinite(value) || found >= count ||
            (*after != ',' && *after != '\0')) {
            app_die("line %ld: \"%.80s\": expected one value, or %d of them separated by commas",
                    number, text, (int)count);
        }
        values[found++] = value;
        at = after;
        if (*at == '\0') {
            break;
        }
    }
    if (found != 1 && found != count) {
        app_die("line %ld: %d values for %d rows", number, (int)found, (int)count);
    }
    for (sl_int k = found; k < count; k++) {
        values[k] = values[0];
    }
    return values;
}

/* A question, and its answer in x. */
typedef struct query_solve {
    const sl_int *b_rows, *x_rows;
    sl_int nb, nx;
    const double *b;
    double *x;
} query_solve;

/* Solves in the first region that contains all rows; *found: there is one. */
static sl_status solve_in_region(const query_solve *q, const sl_saved_set *set, sl_work *W,
                                 bool *found) {
    sl_status status = SL_OK;
    *found = false;
    for (sl_int k = 0; k < set->n_regions && status == SL_OK && !*found; k++) {
        sl_options opt;
        sl_stats stats;
        sl_plan *P = NULL;
        memset(&opt, 0, sizeof opt);
        opt.region = set->regions[k];
        status =
            sl_plan_create(&P, set->symbolic, q->b_rows, q->nb, q->x_rows, q->nx, &opt, &stats);
        *found = status == SL_OK && stats.plan.in_region;
        if (*found) {
            status = sl_plan_solve(P, set->factor, q->x, (size_t)q->nx, q->b, (size_t)q->nb, 1, W);
        }
        sl_plan_free(P);
    }
    return status;
}

static void answer(const sl_saved_set *set, char *text, long number, sl_work *W) {
    const sl_int n = sl_symbolic_view(set->symbolic).n;
    char *values = strchr(text, ';'), *xset = values == NULL ? NULL : strchr(values + 1, ';');
    sl_int nb = 0, nx = 0;
    if (xset == NULL || strchr(xset + 1, ';') != NULL) {
        app_die("line %ld: \"%.80s\" is not B;VALUES;X", number, text);
    }
    *values++ = '\0';
    *xset++ = '\0';
    sl_int *b_rows = read_rows(text, n, &nb, 'B', number),
           *x_rows = read_rows(xset, n, &nx, 'X', number);
    double *b = read_values(values, nb, number), *x = app_alloc((size_t)nx, sizeof *x);
    const query_solve q = {b_rows, x_rows, nb, nx, b, x};
    bool found;
    sl_status status = solve_in_region(&q, set, W, &found);
    if (status == SL_OK && !found) {
        status = sl_local_solve(set->factor, b_rows, nb, x_rows, nx, x, (size_t)nx, b, (size_t)nb,
                                1, W, NULL);
    }
    if (status != SL_OK) {
        app_die("line %ld: %s", number, app_error_text(status, NULL));
    }
    for (sl_int k = 0; k < nx; k++) {
        printf("%s%.17g", k > 0 ? "," : "", x[k]);
    }
    printf("\n");
    free(x);
    free(b);
    free(x_rows);
    free(b_rows);
}

int command_query(int argc, char **argv) {
    const char *operand = NULL;
    bool trusted = false, verified = false, prompt = false;
    const option options[] = {
        {OPTION_FLAG, "trusted", &trusted, NULL,
         "do not check the indices in the file: only for files that nobody else can write"},
        {OPTION_FLAG, "verify", &verified, NULL, "check all checksums of the file first"},
        {OPTION_FLAG, "flush", &prompt, NULL, "write each answer at once, for a dialog over pipes"},
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    if (trusted && verified) {
        app_die_usage("--trusted and --verify exclude each other");
    }
    sl_saved_set set;
    sl_work *W = NULL;
    query_line line = {NULL, 0, 0};
    unsigned checks = trusted ? SL_LOAD_TRUSTED : verified ? SL_LOAD_VERIFIED : SL_LOAD_CHECKED;
    saved_file_open(&set, operand, checks);
    accuracy_warn(NULL, set.factor, NULL);
    app_must(sl_work_create(&W, NULL), "workspace", NULL);
    while (read_line(&line, stdin)) {
        if (line.text[0] != '\0' && line.text[0] != '#') {
            answer(&set, line.text, line.number, W);
            if (prompt) {
                (void)fflush(stdout);
            }
        }
    }
    free(line.text);
    sl_work_free(W);
    sl_saved_set_free(&set);
    return 0;
}
