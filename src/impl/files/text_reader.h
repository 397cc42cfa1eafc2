/* text_reader.h: lines, words and numbers of a text, in any locale */
#ifndef SLI_FILES_TEXT_READER_H
#define SLI_FILES_TEXT_READER_H

#include "../base/base.h"

#define SLI_TOKEN_MAX 63   /* no number that a program prints is longer */
#define SLI_POINT_MAX 16   /* bytes of a decimal point: one multibyte character */
#define SLI_LINE_MAX 65536 /* bytes of a line that is not a comment; the format allows 1024 */

/* A position in the text, always at the start of a line that has not been read. A file is read
 * through a buffer: its size is not known, and may have no end. */
typedef struct sli_reader {
    const char *at, *end;
    FILE *file;   /* follows `end`; NULL: a text in memory, or the file has ended */
    char *buffer; /* SLI_LINE_MAX, for a file */
    const char *failed; /* static: why the file cannot be read on; NULL: it can */
    int error;          /* errno, if the system has refused to read */
    sl_off line;  /* lines read so far */
    char point[SLI_POINT_MAX + 1]; /* the decimal point that strtod expects */
    const char *what; /* static: what is not supported or malformed; NULL: nothing yet */
    sl_int twice[2];  /* an entry that the file has in both triangles, when it is refused for it */
} sli_reader;

/* Moves what is not read yet to the start of the buffer, and fills the rest of the buffer from the
 * file. Returns 0 if there is nothing to add. */
static int sli_reader_fill(sli_reader *r) {
    const size_t kept = (size_t)(r->end - r->at);
    size_t got;
    if (r->file == NULL || kept == SLI_LINE_MAX) {
        return 0;
    }
    if (kept > 0) {
        memmove(r->buffer, r->at, kept);
    }
    got = fread(r->buffer + kept, 1, SLI_LINE_MAX - kept, r->file);
    r->at = r->buffer;
    r->end = r->buffer + kept + got;
    if (got < SLI_LINE_MAX - kept) {
        if (ferror(r->file)) {
            r->failed = "the file cannot be read";
            r->error = errno;
        }
        r->file = NULL;
    }
    return got > 0;
}

/* Skips a UTF-8 byte order mark at the start of the text. */
static void sli_skip_mark(sli_reader *r) {
    if (r->at == r->end) {
        sli_reader_fill(r);
    }
    if (r->end - r->at >= 3 && memcmp(r->at, "\xEF\xBB\xBF", 3) == 0) {
        r->at += 3;
    }
}

/* Skips the rest of a line of any length. */
static void sli_skip_line(sli_reader *r) {
    do {
        while (r->at < r->end && *r->at != '\n') {
            r->at++;
        }
    } while (r->at == r->end && sli_reader_fill(r));
    r->at += r->at < r->end;
}

/* Skips blanks, across the end of the buffer. Returns whether the text goes on. */
static int sli_skip_blanks(sli_reader *r) {
    do {
        while (r->at < r->end && (*r->at == ' ' || *r->at == '\t' || *r->at == '\r')) {
            r->at++;
        }
    } while (r->at == r->end && sli_reader_fill(r));
    return r->at < r->end;
}

/* Takes the next line that is not blank; comment lines are skipped unless `comments`. *stop is its
 * end; both are valid until the next call. Returns 0 at the end of the text, and for a line that is
 * too long. */
static int sli_next_line(sli_reader *r, const char **start, const char **stop, int comments) {
    while (r->at < r->end || sli_reader_fill(r)) {
        ptrdiff_t length = 0;
        r->line++;
        if (!sli_skip_blanks(r)) {
            break;
        }
        if (*r->at == '%' && !comments) {
            sli_skip_line(r);
            continue;
        }
        do {
            while (length < r->end - r->at && r->at[length] != '\n') {
                length++;
            }
        } while (length == r->end - r->at && sli_reader_fill(r));
        if (length >= SLI_LINE_MAX) {
            r->failed = "a line of 65536 bytes or more";
            break;
        }
        *start = r->at;
        *stop = r->at + length;
        r->at += length + (length < r->end - r->at);
        if (length > 0) {
            return 1;
        }
    }
    return 0;
}

/* Copies the next word of a line; returns 0 if there is none or it is too long. */
static int sli_token(const char **at, const char *stop, char *token) {
    const char *s = *at;
    int length = 0;
    while (s < stop && (*s == ' ' || *s == '\t' || *s == '\r')) {
        s++;
    }
    while (s < stop && *s != ' ' && *s != '\t' && *s != '\r') {
        if (length == SLI_TOKEN_MAX || *s == '\0') {
            return 0;
        }
        token[length++] = *s++;
    }
    token[length] = '\0';
    *at = s;
    return length > 0;
}

/* Reads the next word as an integer in low..high. */
static int sli_token_int(const char **at, const char *stop, sl_off low, sl_off high, sl_off *out) {
    char token[SLI_TOKEN_MAX + 1];
    sl_off value = 0;
    int k = 0;
    if (!sli_token(at, stop, token)) {
        return 0;
    }
    k += token[0] == '+';
    if (token[k] == '\0') {
        return 0;
    }
    for (; token[k] != '\0'; k++) {
        if (token[k] < '0' || token[k] > '9' || value > (INT64_MAX - 9) / 10) {
            return 0;
        }
        value = 10 * value + (token[k] - '0');
    }
    *out = value;
    return value >= low && value <= high;
}

/* Is this a byte that a number in the C locale may have, apart from the decimal point? */
SLI_INLINE int sli_is_numeric(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
           c == '-' || c == '(' || c == ')' || c == '_';
}

/* The decimal point of the current locale, taken from a printed number because localeconv need not
 * be thread-safe. */
static void sli_find_point(char *point) {
    char half[SLI_POINT_MAX + 3]; /* 0, the point, 5 */
    const int length = snprintf(half, sizeof half, "%.1f", 0.5);
    if (length < 3 || length >= (int)sizeof half) { /* untested: no locale is like this */
        memcpy(half, "0.5", 4);                     /* untested: the same */
    }
    half[strlen(half) - 1] = '\0';
    memcpy(point, half + 1, strlen(half));
}

/* Reads the next word as a number with a decimal point, in any locale: strtod receives the point of
 * the locale, and a word that is a number only in this locale is refused. D begins an exponent, as
 * in Fortran, but is a digit after 0x. */
static int sli_token_double(const sli_reader *r, const char **at, const char *stop, double *out) {
    char token[SLI_TOKEN_MAX + 1], number[SLI_TOKEN_MAX + SLI_POINT_MAX + 1], *to = number, *rest;
    const char *c;
    int n_points = 0;
    if (!sli_token(at, stop, token)) {
        return 0;
    }
    for (c = token; *c != '\0'; c++) {
        if (*c == '.' && n_points++ == 0) {
            memcpy(to, r->point, strlen(r->point));
            to += strlen(r->point);
        } else if ((*c == 'd' || *c == 'D') && strpbrk(token, "xX") == NULL) {
            *to++ = 'e';
        } else if (sli_is_numeric(*c)) {
            *to++ = *c;
        } else {
            return 0;
        }
    }
    *to = '\0';
    *out = strtod(number, &rest);
    return rest != number && *rest == '\0';
}

/* Is the token this lower-case word, in upper or lower case? */
SLI_NOINLINE static int sli_token_is(const char *token, const char *word) {
    for (; *token != '\0' && *word != '\0'; token++, word++) {
        const char c = *token >= 'A' && *token <= 'Z' ? (char)(*token - 'A' + 'a') : *token;
        if (c != *word) {
            return 0;
        }
    }
    return *token == *word;
}

/* Is the word in a list that ends in NULL? */
static int sli_token_in(const char *token, const char *const *words) {
    while (*words != NULL && !sli_token_is(token, *words)) {
        words++;
    }
    return *words != NULL;
}

/* Is the rest of the line blank? */
static int sli_line_ends(const char *s, const char *e) {
    while (s < e && (*s == ' ' || *s == '\t' || *s == '\r')) {
        s++;
    }
    return s == e;
}

#endif
