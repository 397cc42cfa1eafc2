/* options.c: command-line options: one table drives both the parser and the --help text */
#include "options.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "near_word.h"
#include "tools/io/input.h"
#include "tools/io/output_file.h"

bool options_verbose = false;
static double most_megabytes = 0;

/* What every command takes. */
static const option common[] = {
    {OPTION_ABOVE_0, "max-memory", &most_megabytes, "MB",
     "most megabytes that the content of a file, or a count that it claims, may take (64, and as "
     "many for each byte of the file as files in use need)"},
    {OPTION_FLAG, "verbose", &options_verbose, NULL,
     "print more than the result, at most five sentences: sizes, times, what solves read, what was "
     "checked"},
    {OPTION_END, NULL, NULL, NULL, NULL}};

enum { LINE_WIDTH = 90, HELP_COLUMN = 25 };

static const option *option_named(const option *options, const char *name, size_t length) {
    for (const option *o = options; o->kind != OPTION_END; o++) {
        if (strlen(o->name) == length && strncmp(o->name, name, length) == 0) {
            return o;
        }
    }
    return NULL;
}

static bool store(const option *o, const char *text) {
    char *after = NULL;
    if (o->kind == OPTION_TEXT || o->kind == OPTION_OUTPUT) {
        *(const char **)o->value = text;
        return true;
    }
    errno = 0;
    if (o->kind == OPTION_COUNT) {
        long count = strtol(text, &after, 10);
        if (after == text || *after != '\0' || errno != 0 || count < 0 || count > INT32_MAX) {
            return false;
        }
        *(sl_int *)o->value = (sl_int)count;
        return true;
    }
    double real = strtod(text, &after);
    if (after == text || *after != '\0' || !isfinite(real) ||
        (o->kind == OPTION_ABOVE_0 && !(real > 0)) || (o->kind == OPTION_OPTIONAL && real < 0)) {
        return false;
    }
    *(double *)o->value = real;
    return true;
}

/* The message on an unknown option, with the name that was probably meant. */
static void refuse_option(const option *options, const char *word, size_t length, char *message,
                          size_t message_size) {
    char name[32];
    const char *meant = NULL;
    (void)snprintf(name, sizeof name, "%.*s", length < 31 ? (int)length : 31, word + 2);
    for (const option *o = options; o->kind != OPTION_END && word[1] == '-'; o++) {
        meant = near_word(name, meant, o->name);
    }
    if (meant != NULL) {
        (void)snprintf(message, message_size, "unknown option %.200s; did you mean --%s?", word,
                       meant);
    } else {
        (void)snprintf(message, message_size, "unknown option %.200s", word);
    }
}

/* Parses the option at argv[*at] and advances *at to its last word. */
static bool read_option(const option *options, int argc, char **argv, int *at, char *message,
                        size_t message_size) {
    const char *word = argv[*at];
    const char *name = word + 2;
    const char *equals = strchr(name, '=');
    size_t length = equals != NULL ? (size_t)(equals - name) : strlen(name);
    const option *o = word[1] == '-' ? option_named(options, name, length) : NULL;
    if (o == NULL) {
        refuse_option(options, word, length, message, message_size);
        return false;
    }
    if (o->kind == OPTION_FLAG) {
        if (equals != NULL) {
            (void)snprintf(message, message_size, "--%s takes no argument", o->name);
            return false;
        }
        *(bool *)o->value = true;
        return true;
    }
    const char *text = equals != NULL               ? equals + 1
                       : o->kind == OPTION_OPTIONAL ? "0"
                       : *at + 1 < argc             ? argv[++*at]
                                                    : NULL;
    if (text == NULL) {
        (void)snprintf(message, message_size, "--%s needs %s", o->name, o->argument);
        return false;
    }
    if (!store(o, text)) {
        (void)snprintf(message, message_size, "--%s %.200s: %s", o->name, text,
                       o->kind == OPTION_COUNT      ? "not an integer from 0 to 2^31-1"
                       : o->kind == OPTION_ABOVE_0  ? "not a finite number above 0"
                       : o->kind == OPTION_OPTIONAL ? "not a finite number of 0 or more"
                                                    : "not a finite number");
        return false;
    }
    return true;
}

options_result options_parse(const options_usage *usage, const option *options, int argc,
                             char **argv, const char **operands, char *message,
                             size_t message_size) {
    int count = 0;
    bool only_operands = false;
    for (int k = 0; k < usage->max_operands; k++) {
        operands[k] = NULL;
    }
    for (int a = 1; a < argc; a++) {
        if (strcmp(argv[a], "--help") == 0 || strcmp(argv[a], "-h") == 0) {
            return OPTIONS_HELP;
        }
    }
    for (int a = 1; a < argc; a++) {
        if (!only_operands && strcmp(argv[a], "--") == 0) {
            only_operands = true;
        } else if (!only_operands && argv[a][0] == '-' && argv[a][1] != '\0') {
            if (option_named(common, argv[a] + 2, strcspn(argv[a] + 2, "=")) != NULL
                    ? !read_option(common, argc, argv, &a, message, message_size)
                    : !read_option(options, argc, argv, &a, message, message_size)) {
                return OPTIONS_BAD;
            }
        } else if (count == usage->max_operands) {
            (void)snprintf(message, message_size, "unexpected operand %.200s", argv[a]);
            return OPTIONS_BAD;
        } else {
            operands[count++] = argv[a];
        }
    }
    input_most_bytes = 1e6 * most_megabytes;
    if (count < usage->min_operands) {
        (void)snprintf(message, message_size, "needs %s", usage->operands);
        return OPTIONS_BAD;
    }
    return OPTIONS_READ;
}

void options_print_wrapped(const char *text, int indent, int at) {
    int column = at;
    if (column < indent) {
        (void)printf("%*s", indent - column, "");
        column = indent;
    }
    while (*text != '\0') {
        int length = (int)strcspn(text, " \n");
        if (column > indent && column + 1 + length > LINE_WIDTH) {
            (void)printf("\n%*s", indent, "");
            column = indent;
        }
        column += printf(column > indent ? " %.*s" : "%.*s", length, text);
        text += length;
        if (*text == '\n') {
            (void)printf("\n%*s", indent, "");
            column = indent;
        }
        text += *text != '\0';
    }
    (void)printf("\n");
}

/* One line for each example, which are separated by '\n'. */
static void print_examples(const char *command, const char *example) {
    (void)printf("\nExample:\n");
    while (*example != '\0') {
        int length = (int)strcspn(example, "\n");
        (void)printf("  sparse-local %s %.*s\n", command, length, example);
        example += length + (example[length] == '\n');
    }
}

static void print_options(const option *options) {
    for (const option *o = options; o->kind != OPTION_END; o++) {
        const bool is_optional = o->kind == OPTION_OPTIONAL;
        int column = printf("  --%s%s%s%s", o->name,
                            o->argument == NULL ? ""
                            : is_optional       ? "[="
                                                : " ",
                            o->argument != NULL ? o->argument : "", is_optional ? "]" : "");
        if (column + 2 > HELP_COLUMN) {
            (void)printf("\n");
            column = 0;
        }
        options_print_wrapped(o->help, HELP_COLUMN, column);
    }
}

void options_help(const options_usage *usage, const options_manual *manual, const option *options) {
    (void)printf("%s\n\nusage: sparse-local %s [options] %s\n\n", usage->summary, usage->command,
                 usage->operands);
    options_print_wrapped(manual->details, 0, 0);
    (void)printf("\nOptions (defaults in parentheses):\n");
    print_options(options);
    print_options(common);
    int column = printf("  --help");
    options_print_wrapped("print this text (sparse-local --help explains MESH)", HELP_COLUMN,
                          column);
    (void)printf("\nOutput:\n");
    options_print_wrapped(manual->output, 2, 0);
    print_examples(usage->command, manual->example);
}

static const char *output_of(const option *o) {
    return o->kind == OPTION_OUTPUT ? *(const char *const *)o->value : NULL;
}

/* Dies if an option of a picture has the name of a picture of another kind. */
static void check_kind_of_picture(const char *name, const char *path) {
    static const char *const of_option[][2] = {
        {"png", "PNG"}, {"layout", "PNG"}, {"separators", "PNG"}, {"pattern", "PNG"},
        {"svg", "SVG"}, {"tree", "SVG"},   {"graph", "SVG"}};
    static const char *const endings[] = {".png", ".svg", ".jpg",  ".jpeg", ".gif",
                                          ".bmp", ".tif", ".tiff", ".webp", ".pdf"};
    const char *kind = NULL, *found = "";
    for (size_t k = 0; k < sizeof of_option / sizeof *of_option; k++) {
        kind = strcmp(name, of_option[k][0]) == 0 ? of_option[k][1] : kind;
    }
    for (size_t k = 0; k < sizeof endings / sizeof *endings; k++) {
        found = input_path_ends(path, endings[k]) ? endings[k] : found;
    }
    if (kind == NULL || *found == '\0') {
        return;
    }
    const char *ending = strcmp(kind, "PNG") == 0 ? ".png" : ".svg";
    if (strcmp(found, ending) != 0) {
        (void)fprintf(stderr,
                      "sparse-local: --%s %s: such pictures are %s files; end the name in %s\n",
                      name, path, kind, ending);
        exit(2);
    }
}

/* Finds out before the work, and not after it, that its result cannot be written, or that another
 * one would replace it. */
static void check_outputs(const option *options) {
    char message[512];
    for (const option *o = options; o->kind != OPTION_END; o++) {
        const char *path = output_of(o);
        if (path != NULL && strcmp(path, "-") == 0) {
            output_take_standard();
        }
        if (path != NULL) {
            check_kind_of_picture(o->name, path);
        }
        if (path != NULL && !output_is_possible(path, message, sizeof message)) {
            (void)fprintf(stderr, "sparse-local: %s\n", message);
            exit(1);
        }
        for (const option *before = options; path != NULL && before < o; before++) {
            const char *other = output_of(before);
            if (other != NULL && output_is_same(path, other)) {
                (void)fprintf(stderr, "sparse-local: --%s and --%s: the same file %s\n",
                              before->name, o->name, path);
                exit(2);
            }
        }
    }
}

void options_read(const options_usage *usage, const options_manual *manual, const option *options,
                  int argc, char **argv, const char **operands) {
    char message[512];
    switch (options_parse(usage, options, argc, argv, operands, message, sizeof message)) {
    case OPTIONS_HELP:
        options_help(usage, manual, options);
        exit(0);
    case OPTIONS_BAD:
        (void)fprintf(stderr, "sparse-local %s: %s\nTry: sparse-local %s --help\n", usage->command,
                      message, usage->command);
        exit(2);
    case OPTIONS_READ:
        check_outputs(options);
        break;
    }
}
