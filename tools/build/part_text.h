/* part_text.h: the text of a part of the header: its lines, comments, includes and guard */
#ifndef BUILD_PART_TEXT_H
#define BUILD_PART_TEXT_H

#include <stddef.h>

enum { PATH_SIZE = 512 };

typedef struct text {
    char *bytes;
    size_t length;
    size_t room;
} text;

/* The include guard of a part: the lines #ifndef X and #define X before anything else but comments,
 * and #endif as the last line. All are NULL if there is no such guard. */
typedef struct guard {
    const char *ifndef, *define, *endif;
} guard;

/* Prints where, what is wrong and how it is mended, and ends the program. line: 0 if it does not
 * matter; fix: may be NULL. */
void fail(const char *where, size_t line, const char *what, const char *fix);

void append(text *t, const char *bytes, size_t length);
void append_string(text *t, const char *string);

/* Reads a file. Drops carriage returns and ends the last line. Returns 0 if there is no such file.
 */
int read_file(text *t, const char *path);

/* Drops the comments of an implementation's part, except those named at the top of amalgamate.c, or
 * only the reasons among them, and the lines that had nothing else. Of the empty lines before and
 * after such a line one is left. */
void drop_comments(text *t, int only_reasons);

/* Copies a path to an array of PATH_SIZE bytes. */
void copy_path(char *to, const char *from, size_t length);

/* to = target, which is relative to the folder of `from`, with "." and ".." resolved. Both `from`
 * and `to` are relative to the folder of the manifest. */
void resolve(char *to, const char *from, const char *target, size_t length);

/* Returns the target of a quoted include and its length, or NULL for any other line. */
const char *quoted_include(const char *line, size_t *length);

int is_template(const char *path);
guard find_guard(const char *bytes);

#endif
