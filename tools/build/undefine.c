/* undefine.c: the internal macros that are left at the end of the header, undefined */
#include "job.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The name in a line of this directive, or NULL. */
static const char *name_of(const char *line, const char *word, size_t *length) {
    line += strspn(line, " ");
    if (*line != '#') return NULL;
    line++;
    line += strspn(line, " ");
    if (strncmp(line, word, strlen(word)) != 0) return NULL;
    line += strlen(word);
    line += strspn(line, " ");
    *length = strcspn(line, " (\n");
    return line;
}

/* Internal macros begin with SLI_, SLV_, SLW_ or SLF_. */
static int is_internal(const char *name) {
    return strncmp(name, "SL", 2) == 0 && name[2] >= 'A' && name[2] <= 'Z' && name[3] == '_';
}

/* Adds a name to a list of lines, unless it is there. */
static void add_name(text *list, const char *name, size_t length) {
    char line[PATH_SIZE + 2];
    if (length >= PATH_SIZE) fail(name, 0, "the name of a macro is too long", NULL);
    snprintf(line, sizeof line, "\n%.*s\n", (int)length, name);
    if (list->length == 0) append_string(list, "\n");
    if (!strstr(list->bytes, line)) append_string(list, line + 1);
}

void find_undefined(text *undefined, const job *j) {
    text defined = {NULL, 0, 0}, gone = {NULL, 0, 0};
    const char *name;
    size_t length;
    append_string(&defined, "\n");
    append_string(&gone, "\n");
    for (const char *line = j->body.bytes; *line; line += strcspn(line, "\n") + 1) {
        if ((name = name_of(line, "define ", &length)) != NULL && is_internal(name))
            add_name(&defined, name, length);
        else if ((name = name_of(line, "undef ", &length)) != NULL)
            add_name(&gone, name, length);
    }
    for (name = defined.bytes + 1; *name; name += length) {
        char line[PATH_SIZE + 2];
        length = strcspn(name, "\n") + 1;
        snprintf(line, sizeof line, "\n%.*s", (int)length, name);
        if (strstr(gone.bytes, line)) continue;
        append_string(undefined, "#undef ");
        append(undefined, name, length);
    }
    free(defined.bytes);
    free(gone.bytes);
}
