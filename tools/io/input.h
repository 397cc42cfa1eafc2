/* input.h: reads a whole file, plain or gzipped, and scans it for lines, words and numbers */
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

/** The content of a file, at most 2 GiB and, if it is compressed, 64 MB and 40 times its size,
 *  unless input_most_bytes says otherwise; followed by a zero byte, and a cursor `at` in data..end.
 *
 *  A line ends at \n, \r\n or \r. Blanks are space, tab, vertical tab and form feed. A word is a
 *  maximal sequence of other characters.
 */
typedef struct input {
    const char *path;
    char *data;
    const char *end;   /* data + length of the content */
    const char *at;    /* the cursor */
    int64_t line;      /* line of the cursor, 1-based; 0: binary data, or the file as a whole */
    bool continuation; /* a backslash before the end of a line makes both blank (OBJ) */
    char comment;      /* this character starts a comment, blank to the end of the line; 0: none */
    char *message;     /* error text, message_size bytes; may be NULL */
    size_t message_size;
} input;

/** Reads a file into memory and places the cursor at its beginning, after a UTF-8 byte order mark.
 *
 *  in       [out]  release with input_close; nothing to release on error.
 *  path     [in]   borrowed until input_close; "-": standard input, which can be read once.
 *  message  [out]  borrowed until input_close; receives the text of all errors, "" at first.
 *  Returns  true; false: the file cannot be read, is truncated (gzip) or exceeds 2 GiB, out of
 *           memory; the message is set.
 */
bool input_open(input *in, const char *path, char *message, size_t message_size);

/** Most bytes of one file's content, and of what is allocated for counts that a file claims; 0: as
 *  its size allows. The option --max-memory sets it. */
extern double input_most_bytes;

/** Whether memory for a count that the file claims may be allocated: 64 MB, and `share` bytes for
 *  each byte of the file, unless input_most_bytes says otherwise. If not, sets the message.
 *
 *  what  [in]  for the message: "a matrix of 2000000000 rows".
 */
bool input_allows(input *in, double bytes, double share, const char *what);

/** Releases the content. */
void input_close(input *in);

/** Sets the message to "path:line: ..." ("path: ..." if the line is 0). Returns false, so that
 *  callers can return its result. */
bool input_error(input *in, const char *format, ...) INPUT_PRINTF(2, 3);

/** Skips blanks. Returns true if there is more on the line, false at its end or at a comment. */
bool input_more_in_line(input *in);

/** Moves to the beginning of the next line; false: there is none. */
bool input_next_line(input *in);

/** Skips blanks, empty lines and comments. Returns true if there is more in the file. */
bool input_more(input *in);

/** Reads the number that starts at the next non-blank character of the line, by strtod.
 *
 *  x  [out]  the number.
 *  Returns  true, with the cursor after the number; false: there is none.
 */
bool input_number(input *in, double *x);

/** The same for a decimal integer. The cursor stops at the first character that is not a digit, for
 *  example a letter, a slash or a point. Integers beyond 64 bits are rejected. */
bool input_integer(input *in, int64_t *k);

/** Copies the next word of the line and moves past it. At the end of the line the word is "". Words
 *  longer than size - 1 bytes are truncated. */
void input_word(input *in, char *word, size_t size);

/** Returns whether the cursor is at the end of a word: at a blank, the end of the line or of the
 *  file, or a comment. */
bool input_at_word_end(const input *in);

/** Returns whether a path ends with the given lower-case text, ignoring case and a final .gz. */
bool input_path_ends(const char *path, const char *ending);

#endif
