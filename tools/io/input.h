/* input.h: a whole file in memory, plain or gzipped, a place in it to read words and numbers, and what went wrong */
#ifndef TOOLS_INPUT_H
#define TOOLS_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define INPUT_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define INPUT_PRINTF(text, first)
#endif

/** Content of at most 2 GiB, followed by a zero byte, and the reading place `at` in data..end.
 *
 *  A line ends at \n, \r\n or \r. Blanks are space, tab, vertical tab and form feed.
 */
typedef struct input {
    const char *path;
    char *data;
    const char *end; /* data + content */
    const char *at;
    int64_t line;      /* of `at`, 1-based; 0: binary, or the file as a whole */
    bool continuation; /* a backslash before the end of a line makes both blank (OBJ) */
    char comment;      /* from here to the end of the line is blank; 0: no comments */
    char *message;     /* message_size bytes, may be NULL */
    size_t message_size;
} input;

/** Reads the file; path and message are borrowed until input_close. On error the message is set, nothing to close. */
bool input_open(input *in, const char *path, char *message, size_t message_size);

void input_close(input *in);

/** Sets the message "path:line: ..." (without the line where it is 0); returns false, to be handed on. */
bool input_refuse(input *in, const char *format, ...) INPUT_PRINTF(2, 3);

/** Passes over blanks; true if something of the line is left. */
bool input_more_in_line(input *in);

/** Moves behind the end of the line; false at the end of the file. */
bool input_next_line(input *in);

/** Passes over blanks, empty lines and comments; false at the end of the file. */
bool input_more(input *in);

/** Reads the number that starts at the next non-blank of the line, as strtod does; false, not moved: none there. */
bool input_number(input *in, double *x);

/** The same for a decimal integer; one beyond 64 bits is none. A following letter, slash or point is left there. */
bool input_integer(input *in, int64_t *k);

/** Copies the next word of the line and moves behind it; "" at the end of the line. A longer word is cut. */
void input_word(input *in, char *word, size_t size);

/** True where a word ends: at a blank, the end of the line or of the file, or a comment. */
bool input_at_word_end(const input *in);

/** Does the path end like this, in lower or upper case, .gz at its end left aside? */
bool input_path_ends(const char *path, const char *ending);

#endif
