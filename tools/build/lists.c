/* lists.c: lists of templates, and the macros that name what they include */
#include "job.h"

#include <ctype.h>
#include <string.h>

/* What follows a directive of this kind, or NULL for any other line. */
static const char *after_directive(const char *line, const char *kind) {
    const size_t length = strlen(kind);
    if (*line++ != '#') return NULL;
    line += strspn(line, " \t");
    if (strncmp(line, kind, length) != 0) return NULL;
    line += length;
    return *line == ' ' || *line == '\t' ? line + strspn(line, " \t") : NULL;
}

static size_t length_of_name(const char *word) {
    size_t length = 0;
    while (isalnum((unsigned char)word[length]) || word[length] == '_')
        length++;
    return length;
}

/* The macro that `word` begins with, or NULL. */
static named_path *find_named(job *j, const char *word) {
    const size_t length = length_of_name(word);
    for (size_t k = 0; k < j->n_named; k++) {
        named_path *p = &j->named[k];
        if (length > 0 && strlen(p->name) == length && strncmp(p->name, word, length) == 0)
            return p;
    }
    return NULL;
}

int is_list(const char *path) {
    const size_t length = strlen(path);
    return length > 7 && strcmp(path + length - 7, ".list.h") == 0;
}

size_t templates_in_list(const char *bytes) {
    char path[PATH_SIZE];
    size_t count = 0, length;
    for (const char *line = bytes + strcspn(bytes, "\n") + 1; *line;
         line += strcspn(line, "\n") + 1) {
        const char *target = quoted_include(line, &length);
        if (target) copy_path(path, target, length);
        if (target && is_template(path))
            count++;
        else if (*line != '\n')
            return 0;
    }
    return count;
}

int note_named_path(job *j, const char *line) {
    const char *word = after_directive(line, "undef");
    if (word) return find_named(j, word) != NULL;
    word = after_directive(line, "define");
    if (!word || strncmp(word, "SLI_", 4) != 0) return 0;
    const size_t length = length_of_name(word);
    const char *value = word + length + strspn(word + length, " \t");
    const size_t width = *value == '"' ? strcspn(value + 1, "\"\n") : 0;
    if (width < 3 || strncmp(value + width - 1, ".h\"", 3) != 0) return 0;
    named_path *p = find_named(j, word);
    if (!p && j->n_named < NAMED_MAX) {
        p = &j->named[j->n_named++];
        copy_path(p->name, word, length);
    }
    if (!p) fail(j->folder, 0, "too many macros are paths", "raise NAMED_MAX in job.h");
    copy_path(p->path, value + 1, width);
    return 1;
}

const char *included_path(job *j, const char *line, size_t *length) {
    const char *target = quoted_include(line, length);
    const char *word = target ? NULL : after_directive(line, "include");
    const named_path *p = word ? find_named(j, word) : NULL;
    if (!p) return target;
    *length = strlen(p->path);
    return p->path;
}
