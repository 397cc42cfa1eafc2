/* contents.c: the lines of the header and its table of contents */
#include "job.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void emit(job *j, const char *line, size_t length) {
    static const char *const names[4] = {"MAJOR", "MINOR", "PATCH", "SUFFIX"};
    char name[16], value[16];
    append(&j->body, line, length);
    j->lines++;
    if (sscanf(line, "#define SL_VERSION_%15s %15s", name, value) == 2) {
        for (int k = 0; k < 4; k++) {
            if (strcmp(name, names[k]) == 0) strcpy(j->version[k], value);
        }
    }
}

/* Appends a part of a line of the implementation and follows its comments and parentheses. Leaves
 * out blanks that align text, unless comments are kept. */
static void append_code(job *j, text *to, const char *line, size_t length) {
    for (size_t k = 0, end; k < length; k = end) {
        const char c = line[k];
        size_t kept = 1;
        end = k + 1;
        if (j->is_in_comment) {
            if (c == '*' && line[end] == '/') j->is_in_comment = 0, kept = 2;
        } else if (c == '/' && line[end] == '*') {
            j->is_in_comment = 1, kept = 2;
        } else if (c == '"' || c == '\'') {
            for (; kept < length - k && line[k + kept] != c; kept++)
                kept += line[k + kept] == '\\';
            kept = kept < length - k ? kept + 1 : length - k;
        } else if (c == '(') {
            j->n_parentheses++;
        } else if (c == ')' && j->n_parentheses > 0) {
            j->n_parentheses--;
        } else if (c == ' ' && !j->keeps_comments) {
            end += strspn(line + end, " ");
        }
        append(to, line + k, kept);
        end = end > k + kept ? end : k + kept;
    }
}

void emit_from(job *j, const char *path, const char *line, size_t length) {
    text code = {NULL, 0, 0};
    if (j->is_selection && strncmp(line, "#define SL_HEADER ", 18) == 0) {
        emit_format(j, "#define SL_HEADER \"%s\"\n", j->name);
        return;
    }
    if (strncmp(path, "impl/", 5) != 0) {
        emit(j, line, length);
        return;
    }
    const size_t blanks = strspn(line, " ");
    const int continues = j->is_in_comment || j->n_parentheses > 0;
    if (!continues || blanks == 0) {
        j->dropped = blanks / 4 * 2;
        j->indentation = blanks - j->dropped;
        if (!j->is_in_comment) j->n_parentheses = 0;
    }
    size_t dropped = j->dropped < blanks ? j->dropped : blanks;
    if (!j->keeps_comments && blanks > dropped && blanks - dropped > j->indentation + 4)
        dropped = blanks - j->indentation - 4;
    append(&code, line + dropped, blanks - dropped);
    append_code(j, &code, line + blanks, length - blanks);
    emit(j, code.bytes, code.length);
    free(code.bytes);
}

void emit_lines(job *j, const char *lines) {
    while (*lines) {
        size_t length = strcspn(lines, "\n") + 1;
        emit(j, lines, length);
        lines += length;
    }
}

void emit_format(job *j, const char *format, const char *name) {
    const char *at = strstr(format, "%s");
    text line = {NULL, 0, 0};
    append(&line, format, (size_t)(at - format));
    append_string(&line, name);
    append_string(&line, at + 2);
    emit(j, line.bytes, line.length);
    free(line.bytes);
}

void enter(job *j, const char *path, const char *line) {
    if (j->n_entries == ENTRIES_MAX)
        fail(path, 0, "too many parts for the table of contents", NULL);
    entry *e = &j->entries[j->n_entries++];
    copy_path(e->name, path, strlen(path));
    copy_path(e->condition, j->condition, strlen(j->condition));
    e->line = j->lines + 1;
    e->is_guarded = find_guard(line).ifndef != NULL;
    if (strncmp(line, "/*", 2) == 0) line += 2;
    size_t end = strcspn(line, "\n");
    const char *close = strstr(line, "*/");
    if (close && (size_t)(close - line) < end) end = (size_t)(close - line);
    const char *colon = *path ? strstr(line, ": ") : NULL;
    if (colon && (size_t)(colon - line) < end) {
        end -= (size_t)(colon + 2 - line);
        line = colon + 2;
    }
    while (end > 0 && strchr(" -", *line))
        line++, end--;
    while (end > 0 && strchr(" -", line[end - 1]))
        end--;
    copy_path(e->title, line, end);
}

entry *find_entry(job *j, const char *path) {
    for (size_t k = 0; k < j->n_entries; k++) {
        if (strcmp(j->entries[k].name, path) == 0) return &j->entries[k];
    }
    return NULL;
}

/* FNV-1a, 64 bits */
static uint64_t hash(const text *t) {
    uint64_t h = UINT64_C(0xcbf29ce484222325);
    for (size_t k = 0; k < t->length; k++)
        h = (h ^ (unsigned char)t->bytes[k]) * UINT64_C(0x100000001b3);
    return h;
}

size_t banner(text *out, const job *j, size_t shift) {
    char line[2 * PATH_SIZE + CONDITION_SIZE + 64];
    uint64_t h = hash(&j->body);
    size_t lines = 0;
    const size_t quoted = strlen(j->version[3]);
    snprintf(line, sizeof line, "/* %s %s.%s.%s%.*s, generated: edit src/, run make header\n",
             j->name, j->version[0], j->version[1], j->version[2], quoted > 2 ? (int)quoted - 2 : 0,
             j->version[3] + 1);
    append_string(out, line);
    snprintf(line, sizeof line,
             " * FNV-1a of the lines after this comment, without the license: %08lx%08lx\n",
             (unsigned long)(h >> 32), (unsigned long)(h & 0xffffffffu));
    append_string(out, line);
    lines += 2;
    if (j->home && *j->home) {
        append_string(out, " * Home: ");
        append_string(out, j->home);
        append_string(out, "\n");
        lines++;
    }
    if (j->is_selection) {
        append_string(out, j->on.count ? " * with: " : " * without packs");
        append_packs(out, &j->on, &j->known);
        append_string(out, "\n");
        lines++;
    }
    lines += append_use(out, j);
    if (j->keeps_comments) {
        append_string(out, " * To be read from the top: it has the comments of the "
                           "implementation.\n * It compiles, too: include it by this name.\n");
        lines += 2;
    }
    if (!j->keeps_comments && j->half != DECLARATIONS) {
        append_string(out, " * The comments of the implementation are in src/impl.\n");
        lines++;
    }
    append_string(out, " *\n * Contents\n");
    lines += 2;
    const char *layer = NULL; /* a heading of the manifest that is not listed yet */
    for (size_t k = 0; k < j->n_entries; k++) {
        const entry *e = &j->entries[k];
        const char *slash = strrchr(e->name, '/'), *base = slash ? slash + 1 : e->name;
        unsigned long at = (unsigned long)(e->line + shift);
        if (!*e->name) {
            layer = e->title;
            continue;
        }
        if (strncmp(e->name, "impl/", 5) != 0) {
            if (*e->condition && !j->is_selection)
                snprintf(line, sizeof line, " * %6lu %-12s %s (%s)\n", at, base, e->title,
                         e->condition);
            else
                snprintf(line, sizeof line, " * %6lu %-12s %s\n", at, base, e->title);
        } else if (layer) {
            snprintf(line, sizeof line, " * %6lu impl/ %s\n", at, layer);
        } else {
            continue;
        }
        layer = NULL;
        append_string(out, line);
        lines++;
    }
    append_string(out, " */\n");
    return lines + 1;
}
