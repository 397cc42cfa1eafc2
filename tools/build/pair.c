/* pair.c: the header as two files: declarations in a .h, bodies in a .c that includes it */
#include "job.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The name of the pair's header: that of this file, with .h at its end. */
static void header_name(char *to, const job *j) {
    const char *dot = strrchr(j->name, '.');
    const size_t length = dot ? (size_t)(dot - j->name) : strlen(j->name);
    if (length + 3 > PATH_SIZE) fail(j->name, 0, "path too long", NULL);
    copy_path(to, j->name, length);
    strcpy(to + length, ".h");
}

/* What the bodies begin with. Whoever includes the .c file with SL_STATIC has all of it static. */
static void append_beginning(text *to, const job *j) {
    char header[PATH_SIZE], line[2 * PATH_SIZE];
    header_name(header, j);
    snprintf(line, sizeof line, "#include \"%s\"\n", header);
    append_string(to, line);
    snprintf(line, sizeof line, "%s is of another version", header);
    append_version_check(to, j, "", line);
    append_string(to, "#ifndef SPARSE_LOCAL_IMPLEMENTATION\n"
                      "#define SPARSE_LOCAL_IMPLEMENTATION\n"
                      "#endif\n\n");
}

static size_t count_lines(const text *t) {
    size_t count = 0;
    for (size_t k = 0; k < t->length; k++)
        count += t->bytes[k] == '\n';
    return count;
}

void keep_half(job *j) {
    text kept = {NULL, 0, 0};
    size_t n_kept = 0;
    if (j->half == WHOLE) return;
    if (j->bodies_at == 0)
        fail(j->folder, 0, "the manifest does not say where the bodies begin",
             "give it a heading: /* ---- bodies ... */");
    const int is_bodies = j->half == BODIES;
    if (is_bodies) append_beginning(&kept, j);
    const size_t first = is_bodies ? j->bodies_at : 0;
    const size_t end = is_bodies ? j->body.length : j->bodies_at;
    const size_t added = is_bodies ? count_lines(&kept) : 0;
    append(&kept, j->body.bytes + first, end - first);
    for (size_t k = 0; k < j->n_entries; k++) {
        entry e = j->entries[k];
        if ((e.line > j->bodies_line) != is_bodies) continue;
        if (is_bodies) e.line += added - j->bodies_line;
        j->entries[n_kept++] = e;
    }
    j->n_entries = n_kept;
    free(j->body.bytes);
    j->body = kept;
}

size_t append_use(text *out, const job *j) {
    char header[PATH_SIZE], line[2 * PATH_SIZE + 128];
    if (j->half == WHOLE) return 0;
    header_name(header, j);
    if (j->half == BODIES)
        snprintf(line, sizeof line,
                 " * Compile it once, with the macros SL_WITH_... that the program includes %s "
                 "with.\n",
                 header);
    else
        snprintf(line, sizeof line,
                 " * Declarations alone. Compile %.*s.c, with the same macros SL_WITH_...;\n"
                 " * SPARSE_LOCAL_IMPLEMENTATION and SL_HEADER do nothing here.\n",
                 (int)strlen(header) - 2, header);
    append_string(out, line);
    return j->half == BODIES ? 1 : 2;
}
