/* options.h: the options of a command: one table gives the parser and the --help */
#ifndef TOOLS_OPTIONS_H
#define TOOLS_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "../sparse_local.h"

typedef enum option_kind {
    OPTION_END = 0, /* closes a table */
    OPTION_FLAG,    /* value: bool, set to true */
    OPTION_COUNT,   /* value: sl_int, 0 or more */
    OPTION_REAL,    /* value: double, finite */
    OPTION_TEXT     /* value: const char *, borrowed from argv */
} option_kind;

/** One option, --name or --name ARGUMENT or --name=ARGUMENT. The value holds the default before parsing. */
typedef struct option {
    option_kind kind;
    const char *name;
    void *value;
    const char *argument; /* how the help calls the argument; NULL for a flag */
    const char *help;     /* what it does, with its default; lines are broken by the printer */
} option;

/** What a command takes. */
typedef struct options_usage {
    const char *command;  /* "heat" */
    const char *operands; /* "MESH", as the usage line shows them */
    int fewest;           /* how many operands are needed */
    int most;             /* and allowed */
    const char *text;     /* what the command does: some sentences, lines broken by the printer */
} options_usage;

typedef enum options_result { OPTIONS_READ, OPTIONS_HELP, OPTIONS_BAD } options_result;

/** Reads argv[1 ..]; what is no option is an operand; after -- everything is.
 *
 *  operands  [out]  usage->most of them, NULL where none was given.
 *  message   [out]  what is wrong, on OPTIONS_BAD.
 *  Returns  OPTIONS_READ; OPTIONS_HELP: --help or -h stands somewhere; OPTIONS_BAD: an unknown option, a missing or
 *           unreadable argument, too few or too many operands.
 */
options_result options_parse(const options_usage *usage, const option *options, int argc,
                             char **argv, const char **operands, char *message,
                             size_t message_size);

/** Prints the --help of a command to standard output. */
void options_help(const options_usage *usage, const option *options);

/** options_parse for a program: prints the help and ends with status 0, or the error and ends with status 2. */
void options_read(const options_usage *usage, const option *options, int argc, char **argv,
                  const char **operands);

/** Prints text in lines of at most 78 characters, each after `indent` blanks; the first line begins at column `at`. */
void options_print_wrapped(const char *text, int indent, int at);

#endif
