/* options.h: command-line options: one table drives both the parser and the --help text */
#ifndef TOOLS_OPTIONS_H
#define TOOLS_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "sparse_local.h"

typedef enum option_kind {
    OPTION_END = 0,  /* ends a table */
    OPTION_FLAG,     /* value: bool, set to true */
    OPTION_COUNT,    /* value: sl_int, 0 or more */
    OPTION_REAL,     /* value: double, finite */
    OPTION_ABOVE_0,  /* value: double, finite, above 0 */
    OPTION_OPTIONAL, /* value: double, 0 or more; 0 without an argument, which needs = */
    OPTION_TEXT,     /* value: const char *, borrowed from argv */
    OPTION_OUTPUT    /* value: the same, a file to be written: options_read checks that it can be */
} option_kind;

/** One option: --name, --name ARGUMENT or --name=ARGUMENT. *value is the default until parsing
 *  changes it. */
typedef struct option {
    option_kind kind;
    const char *name;
    void *value;
    const char *argument; /* name of the argument in the help; NULL for a flag */
    const char *help;     /* what the option does, default in parentheses; one line */
} option;

/** Name and operands of a command. */
typedef struct options_usage {
    const char *command;  /* "heat" */
    const char *operands; /* "MESH", as shown in the usage line */
    int min_operands;
    int max_operands;
    const char *summary; /* what the command does, in one line */
} options_usage;

/** The rest of a command's --help. Text is wrapped by the printer; '\n' starts a new line. */
typedef struct options_manual {
    const char *details; /* method and terms */
    const char *output;  /* what is printed, and what the files contain */
    const char *example; /* arguments of one or more example calls, separated by '\n' */
} options_manual;

/** Whether --verbose is among the words of the command line, which every command takes. */
extern bool options_verbose;

typedef enum options_result { OPTIONS_READ, OPTIONS_HELP, OPTIONS_BAD } options_result;

/** Parses argv[1 ..]. A word that is not an option is an operand; so is every word after --.
 *
 *  operands  [out]  usage->max_operands of them, NULL where none was given.
 *  message   [out]  the reason for OPTIONS_BAD.
 *  Returns  OPTIONS_READ; OPTIONS_HELP: --help or -h is among the words; OPTIONS_BAD: an unknown
 *           option, a missing or malformed argument, too few or too many operands.
 */
options_result options_parse(const options_usage *usage, const option *options, int argc,
                             char **argv, const char **operands, char *message,
                             size_t message_size);

/** Prints the --help of a command to standard output. */
void options_help(const options_usage *usage, const options_manual *manual, const option *options);

/** Parses the command line. Exits with status 0 after printing the help, with status 2 after
 *  printing an error, and with status 1 if a file cannot be written. */
void options_read(const options_usage *usage, const options_manual *manual, const option *options,
                  int argc, char **argv, const char **operands);

/** Prints text wrapped at 90 columns, each line indented by `indent` blanks. The cursor is in
 *  column `at` before the call. */
void options_print_wrapped(const char *text, int indent, int at);

#endif
