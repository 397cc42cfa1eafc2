/* input.c: reads a whole file, plain or gzipped, and scans it for lines, words and numbers */
#include "input.h"
#include "path_message.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

/* What a file may expand to: text of meshes and matrices by 3 to 20 times, a malicious one by 1000.
 * The rest is for small files, and the limit for all is far above any mesh in use. */
enum { EXPANSION = 40 };
static const size_t free_bytes = 64000000, most_bytes = (size_t)1 << 31;

double input_most_bytes = 0;

bool input_allows(input *in, double bytes, double share, const char *what) {
    const double room = (double)free_bytes + share * (double)(in->end - in->data);
    const double limit = input_most_bytes > 0 ? input_most_bytes : room;
    if (bytes <= limit) {
        return true;
    }
    return input_error(in,
                       "%s would take %.0f MB, and the limit for a file of this size is %.0f MB; "
                       "--max-memory raises it",
                       what, 1e-6 * bytes, 1e-6 * limit);
}

/* How long the content may become, of which the first bytes of the file have given a part. */
static size_t content_limit(gzFile file) {
    const double read = (double)gzoffset(file);
    const double limit =
        input_most_bytes > 0 ? input_most_bytes : (double)free_bytes + EXPANSION * fmax(0, read);
    return limit < (double)most_bytes ? (size_t)limit : most_bytes;
}

enum { STDIN = 0 }; /* its descriptor */

bool input_error(input *in, const char *format, ...) {
    if (in->message == NULL || in->message_size == 0) {
        return false;
    }
    char *message = in->message;
    const size_t size = in->message_size;
    size_t used = path_message_begin(message, size, in->path, size / 2);
    int added = in->line > 0 ? snprintf(message + used, size - used, ":%lld: ", (long long)in->line)
                             : snprintf(message + used, size - used, ": ");
    used += added > 0 ? (size_t)added : 0;
    if (used < size) {
        va_list list;
        va_start(list, format);
        (void)vsnprintf(message + used, size - used, format, list);
        va_end(list);
    }
    return false;
}

static bool read_content(input *in, gzFile file) {
    size_t length = 0;
    size_t capacity = 0;
    for (;;) {
        if (length + 1 >= capacity) {
            const size_t limit = content_limit(file) + 2;
            capacity = capacity == 0 ? 65536 : 2 * capacity;
            capacity = capacity > limit && limit > length + 1 ? limit : capacity;
            char *larger = (char *)realloc(in->data, capacity);
            if (larger == NULL) {
                return input_error(in, "out of memory");
            }
            in->data = larger;
        }
        size_t want = capacity - length - 1;
        int got =
            gzread(file, in->data + length, (unsigned)(want < (1u << 30) ? want : (1u << 30)));
        if (got < 0) {
            int code = Z_OK;
            const char *words = gzerror(file, &code);
            return input_error(in, "cannot be read: %s",
                               code == Z_ERRNO ? "not a readable file" : words);
        }
        if (got == 0) {
            break;
        }
        length += (size_t)got;
        if (length > content_limit(file)) {
            return length > most_bytes
                       ? input_error(in, "more than 2 GiB of content")
                       : input_error(
                             in,
                             "expands to more than %.0f MB, the limit for a compressed file "
                             "of this size; --max-memory raises it",
                             1e-6 * (double)content_limit(file));
        }
    }
    in->data[length] = '\0';
    in->at = in->data + (strncmp(in->data, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0);
    in->end = in->data + length;
    return true;
}

bool input_open(input *in, const char *path, char *message, size_t message_size) {
    memset(in, 0, sizeof *in);
    in->path = path != NULL ? path : "(null)";
    in->message = message;
    in->message_size = message_size;
    if (message != NULL && message_size > 0) {
        message[0] = '\0';
    }
    gzFile file = path == NULL             ? NULL
                  : strcmp(path, "-") == 0 ? gzdopen(STDIN, "rb") /* closed by gzclose_r */
                                           : gzopen(path, "rb");
    if (file == NULL) {
        return input_error(in, "cannot be opened");
    }
    (void)gzbuffer(file, 1u << 17);
    bool ok = read_content(in, file);
    /* for a truncated gzip stream, gzread returns the bytes it has and only gzclose_r reports the
     * error */
    if (gzclose_r(file) != Z_OK && ok) {
        ok = input_error(in, "the gzip stream is truncated");
    }
    in->line = 1;
    if (!ok) {
        input_close(in);
    }
    return ok;
}

void input_close(input *in) {
    free(in->data);
    in->data = NULL;
    in->at = NULL;
    in->end = NULL;
}

/* The length of the line end at s: 0 (none), 1 or 2. A zero byte follows the content, so s[1]
 * exists. */
static size_t line_end_length(const char *s) {
    return *s == '\n' ? 1 : *s != '\r' ? 0 : s[1] == '\n' ? 2 : 1;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* The length of a backslash and the line end after it if the format treats them as blank; else
 * 0. */
static size_t continuation_length(const input *in) {
    size_t line_end = in->continuation && *in->at == '\\' ? line_end_length(in->at + 1) : 0;
    return line_end > 0 ? 1 + line_end : 0;
}

bool input_at_word_end(const input *in) {
    return in->at >= in->end || is_blank(*in->at) || line_end_length(in->at) > 0 ||
           continuation_length(in) > 0 || (in->comment != 0 && *in->at == in->comment);
}

/* Moves to the end of the line, not past it. */
static void skip_to_line_end(input *in) {
    while (in->at < in->end && line_end_length(in->at) == 0) {
        in->at++;
    }
}

bool input_more_in_line(input *in) {
    for (;;) {
        while (in->at < in->end && is_blank(*in->at)) {
            in->at++;
        }
        if (in->at >= in->end) {
            return false;
        }
        if (in->comment != 0 && *in->at == in->comment) {
            skip_to_line_end(in);
            return false;
        }
        size_t skipped = continuation_length(in);
        if (skipped == 0) {
            return line_end_length(in->at) == 0;
        }
        in->at += skipped;
        in->line++;
    }
}

bool input_next_line(input *in) {
    skip_to_line_end(in);
    if (in->at >= in->end) {
        return false;
    }
    in->at += line_end_length(in->at);
    in->line++;
    return true;
}

bool input_more(input *in) {
    while (!input_more_in_line(in)) {
        if (!input_next_line(in)) {
            return false;
        }
    }
    return true;
}

bool input_number(input *in, double *x) {
    if (!input_more_in_line(in)) {
        return false;
    }
    char *after = NULL;
    double value = strtod(in->at, &after);
    if (after == in->at || after > in->end) {
        return false;
    }
    in->at = after;
    *x = value;
    return true;
}

bool input_integer(input *in, int64_t *k) {
    if (!input_more_in_line(in)) {
        return false;
    }
    const char *s = in->at;
    bool negative = *s == '-';
    s += *s == '-' || *s == '+';
    if (*s < '0' || *s > '9') {
        return false;
    }
    int64_t value = 0;
    for (; *s >= '0' && *s <= '9'; s++) {
        if (value > (INT64_MAX - 9) / 10) {
            return false;
        }
        value = 10 * value + (*s - '0');
    }
    in->at = s;
    *k = negative ? -value : value;
    return true;
}

void input_word(input *in, char *word, size_t size) {
    size_t length = 0;
    if (input_more_in_line(in)) {
        for (; !input_at_word_end(in); in->at++) {
            if (length + 1 < size) {
                word[length++] = *in->at;
            }
        }
    }
    word[length] = '\0';
}

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool ends_with(const char *s, size_t length, const char *ending) {
    size_t tail = strlen(ending);
    if (length < tail) {
        return false;
    }
    for (size_t k = 0; k < tail; k++) {
        if (lower(s[length - tail + k]) != ending[k]) {
            return false;
        }
    }
    return true;
}

bool input_path_ends(const char *path, const char *ending) {
    size_t length = path != NULL ? strlen(path) : 0;
    if (length > 0 && ends_with(path, length, ".gz")) {
        length -= 3;
    }
    return length > 0 && ends_with(path, length, ending);
}
