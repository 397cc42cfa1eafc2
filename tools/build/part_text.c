/* part_text.c: the text of a part of the header: its lines, comments, includes and guard */
#include "part_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fail(const char *where, size_t line, const char *what, const char *fix) {
    if (line)
        fprintf(stderr, "%s:%lu: %s\n", where, (unsigned long)line, what);
    else
        fprintf(stderr, "%s: %s\n", where, what);
    if (fix) fprintf(stderr, "fix: %s\n", fix);
    exit(2);
}

void append(text *t, const char *bytes, size_t length) {
    if (t->room - t->length < length + 1) {
        t->room = 2 * (t->room + length + 1);
        t->bytes = (char *)realloc(t->bytes, t->room);
        if (!t->bytes) fail("amalgamate", 0, "out of memory", NULL);
    }
    memcpy(t->bytes + t->length, bytes, length);
    t->length += length;
    t->bytes[t->length] = 0;
}

void append_string(text *t, const char *string) {
    append(t, string, strlen(string));
}

int read_file(text *t, const char *path) {
    FILE *f = fopen(path, "rb");
    if (!f) return 0;
    append(t, "", 0);
    for (int c = fgetc(f); c != EOF; c = fgetc(f)) {
        char byte = (char)c;
        if (c != '\r') append(t, &byte, 1);
    }
    fclose(f);
    if (t->length && t->bytes[t->length - 1] != '\n') append(t, "\n", 1);
    return 1;
}

/* Copies a string or character literal; returns the position after it. */
static size_t copy_literal(text *to, const text *from, size_t at) {
    const char quote = from->bytes[at];
    size_t end = at + 1;
    while (end < from->length && from->bytes[end] != quote && from->bytes[end] != '\n')
        end += from->bytes[end] == '\\' ? 2 : 1;
    end = end + 1 < from->length ? end + 1 : from->length;
    append(to, from->bytes + at, end - at);
    return end;
}

/* Says this comment why no test reaches a line? Such as `branches untested: 2^31 rows`. */
static int is_reason(const char *comment, const char *close) {
    const char *c = comment + 2;
    while (c < close && (*c == ' ' || (*c >= 'a' && *c <= 'z')))
        c++;
    return c < close && *c == ':' && c - comment > 8 && strncmp(c - 8, "untested", 8) == 0;
}

/* Returns the position after the comment at `at`. Copies it if it is one of those that are kept:
 * the first line of a file and reasons, or all but reasons. */
static size_t copy_comment(text *to, const text *from, size_t at, int only_reasons) {
    const char *begin = from->bytes + at, *close = strstr(begin, "*/");
    const char *reason = strstr(begin, "untested: ");
    if (!close) return from->length;
    const size_t length = (size_t)(close - begin) + 2, width = strcspn(begin, "\n");
    if (only_reasons) {
        if (!is_reason(begin, close)) append(to, begin, length);
    } else if (at == 0 && width < length) {
        append(to, begin, width);
        append_string(to, " */");
    } else if (at == 0 || (reason && reason < close)) {
        append(to, begin, length);
    }
    return at + length;
}

void drop_comments(text *t, int only_reasons) {
    text to = {NULL, 0, 0};
    size_t line = 0;                     /* where the last line of `to` begins */
    int has_comment = 0, is_dropped = 0; /* the last line; the line before it */
    append(&to, "", 0);
    for (size_t at = 0; at < t->length;) {
        const char *c = t->bytes + at;
        if (strncmp(c, "/*", 2) == 0) {
            const size_t before = to.length;
            at = copy_comment(&to, t, at, only_reasons);
            has_comment |= !only_reasons || to.length == before;
        } else if (*c == '"' || *c == '\'') {
            at = copy_literal(&to, t, at);
        } else if (*c != '\n') {
            append(&to, c, 1);
            at++;
        } else {
            while (has_comment && to.length > line && to.bytes[to.length - 1] == ' ')
                to.length--;
            const int is_empty = to.length == line;
            const int is_second = line < 2 || to.bytes[line - 2] == '\n';
            is_dropped = is_empty && (has_comment || (is_dropped && is_second));
            if (!is_dropped) append(&to, "\n", 1);
            line = to.length;
            has_comment = 0;
            at++;
        }
    }
    free(t->bytes);
    *t = to;
}

void copy_path(char *to, const char *from, size_t length) {
    if (length >= PATH_SIZE) fail(from, 0, "path too long", NULL);
    memcpy(to, from, length);
    to[length] = 0;
}

void resolve(char *to, const char *from, const char *target, size_t length) {
    const char *slash = strrchr(from, '/');
    size_t used = slash ? (size_t)(slash - from) : 0;
    copy_path(to, from, used);
    for (size_t begin = 0; begin < length;) {
        size_t end = begin;
        while (end < length && target[end] != '/')
            end++;
        size_t width = end - begin;
        if (width == 2 && memcmp(target + begin, "..", 2) == 0) {
            if (used == 0) fail(from, 0, "an include leaves the folder of the manifest", NULL);
            while (used > 0 && to[used - 1] != '/')
                used--;
            if (used > 0) used--;
        } else if (width > 0 && !(width == 1 && target[begin] == '.')) {
            if (used + width + 2 > PATH_SIZE) fail(from, 0, "path too long", NULL);
            if (used > 0) to[used++] = '/';
            memcpy(to + used, target + begin, width);
            used += width;
        }
        to[used] = 0;
        begin = end + 1;
    }
}

static const char *skip_blanks(const char *s) {
    while (*s == ' ' || *s == '\t')
        s++;
    return s;
}

const char *quoted_include(const char *line, size_t *length) {
    line = skip_blanks(line);
    if (*line != '#') return NULL;
    line = skip_blanks(line + 1);
    if (strncmp(line, "include", 7) != 0) return NULL;
    line = skip_blanks(line + 7);
    if (*line != '"') return NULL;
    *length = strcspn(++line, "\"\n");
    return line[*length] == '"' ? line : NULL;
}

int is_template(const char *path) {
    size_t length = strlen(path);
    return length > 6 && strcmp(path + length - 6, ".inl.h") == 0;
}

/* The macro of a directive of this kind, or NULL. */
static const char *macro_of(const char *line, const char *directive) {
    size_t length = strlen(directive);
    line = skip_blanks(line);
    return strncmp(line, directive, length) == 0 ? skip_blanks(line + length) : NULL;
}

guard find_guard(const char *bytes) {
    guard g = {NULL, NULL, NULL};
    const char *line = bytes, *last = NULL;
    while (*line && *skip_blanks(line) != '#')
        line += strcspn(line, "\n") + 1;
    const char *tested = macro_of(line, "#ifndef "),
               *next = line + strcspn(line, "\n") + (*line != 0);
    const char *defined = macro_of(next, "#define ");
    if (!tested || !defined) return g;
    size_t length = strcspn(tested, "\n") + 1;
    if (strncmp(tested, defined, length) != 0) return g;
    for (const char *k = next; *k; k += strcspn(k, "\n") + 1)
        if (*k != '\n') last = k;
    if (strncmp(last, "#endif", 6) == 0) g.ifndef = line, g.define = next, g.endif = last;
    return g;
}
