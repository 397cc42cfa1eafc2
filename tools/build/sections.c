/* sections.c: templates at the end of the header, and the self-inclusions that compile them */
#include "job.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The macro that selects the section of a template: SLI_INL_ and its base name in capitals. */
static void section_macro(char *to, const char *path) {
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    size_t used = (size_t)sprintf(to, "SLI_INL_");
    for (; *base && *base != '.'; base++)
        to[used++] = (char)toupper((unsigned char)*base);
    to[used] = 0;
}

/* Returns the place of a template among the sections; n_sections if it is not there. */
static size_t section_at(const job *j, const char *path) {
    size_t k = 0;
    while (k < j->n_sections && strcmp(j->sections[k], path) != 0)
        k++;
    return k;
}

/* Adds a template to the sections, at this place. */
static void add_section(job *j, const char *path, size_t at) {
    char macro[PATH_SIZE + 16], other[PATH_SIZE + 16];
    section_macro(macro, path);
    for (size_t k = 0; k < j->n_sections; k++) {
        section_macro(other, j->sections[k]);
        if (strcmp(macro, other) == 0)
            fail(path, 0, "another template has the same base name", "rename one of them");
    }
    if (j->n_sections == SECTIONS_MAX) fail(path, 0, "too many templates", NULL);
    memmove(j->sections[at + 1], j->sections[at], (j->n_sections - at) * PATH_SIZE);
    copy_path(j->sections[at], path, strlen(path));
    j->n_sections++;
}

void self_include(job *j) {
    static const char check_before[] =
        "/* The header includes itself from here on: its templates, at the end, are compiled once "
        "for\n"
        " * each instruction set. SL_HEADER is the name of this file. */\n"
        "#if defined(__has_include)\n"
        "#if !__has_include(SL_HEADER)\n";
    const int is_in_block = *j->condition && !j->is_selection;
    const int checks = !j->has_self_inclusion || !(j->has_check || is_in_block);
    char macro[PATH_SIZE + 16];
    if (j->n_batch == 0) return;
    if (checks) {
        emit_lines(j, check_before);
        emit_format(j, "#error \"%s was renamed: define SL_HEADER as its new name, in quotes\"\n",
                    j->name);
        emit_lines(j, "#endif\n#endif\n#define SLI_SELF_INCLUSION\n");
    }
    for (size_t k = 0; k < j->n_batch; k++) {
        const size_t list = j->batch_list[k];
        if (list > 0 && k > 0 && j->batch_list[k - 1] == list) continue;
        section_macro(macro, list > 0 ? j->lists[list - 1] : j->batch[k]);
        emit_format(j, "#define %s\n", macro);
    }
    if (checks) {
        emit_lines(j, "#include SL_HEADER /* not found: define SL_HEADER, see above */\n");
        emit_format(j, "#ifdef %s\n", macro);
        emit_format(j, "#error \"%s: SL_HEADER names another file, not this one\"\n", j->name);
        emit_lines(j, "#endif\n");
    } else {
        emit_lines(j, "#include SL_HEADER\n");
    }
    j->has_check |= checks && !is_in_block;
    j->has_self_inclusion = 1;
    j->n_batch = 0;
}

void add_to_batch(job *j, const char *path) {
    size_t last = j->n_batch > 0 ? section_at(j, j->batch[j->n_batch - 1]) : j->n_sections;
    size_t at = section_at(j, path);
    if (at == j->n_sections) {
        add_section(j, path, j->n_batch > 0 ? last + 1 : 0);
    } else if (j->n_batch > 0 && at <= last) {
        self_include(j);
    }
    j->batch_list[j->n_batch] = 0;
    copy_path(j->batch[j->n_batch++], path, strlen(path));
}

void close_list(job *j, const char *path, size_t count) {
    char macro[PATH_SIZE + 16], line[2 * PATH_SIZE + 64];
    size_t list = 0;
    if (j->n_batch < count)
        fail(path, 0, "its templates are not in the order of other parts", "reorder them");
    while (list < j->n_lists && strcmp(j->lists[list], path) != 0)
        list++;
    if (list == SECTIONS_MAX) fail(path, 0, "too many lists", NULL);
    const int is_new = list == j->n_lists;
    if (is_new) copy_path(j->lists[j->n_lists++], path, strlen(path));
    section_macro(macro, path);
    if (is_new) {
        snprintf(line, sizeof line, "#ifdef %s\n#undef %s\n", macro, macro);
        append_string(&j->list_macros, line);
    }
    for (size_t k = j->n_batch - count; k < j->n_batch; k++) {
        j->batch_list[k] = list + 1;
        section_macro(macro, j->batch[k]);
        snprintf(line, sizeof line, "#define %s\n", macro);
        if (is_new) append_string(&j->list_macros, line);
    }
    if (is_new) append_string(&j->list_macros, "#endif\n");
}

void append_version_check(text *to, const job *j, const char *also, const char *what) {
    static const char *const names[3] = {"MAJOR", "MINOR", "PATCH"};
    char line[PATH_SIZE + 64];
    append_string(to, "#if ");
    append_string(to, also);
    for (int v = 0; v < 3; v++) {
        snprintf(line, sizeof line, "%sSL_VERSION_%s != %s%s", v ? "     " : "(", names[v],
                 j->version[v], v < 2 ? " || \\\n" : ")\n");
        append_string(to, line);
    }
    snprintf(line, sizeof line, "#error \"%s: %s\"\n#endif\n", j->name, what);
    append_string(to, line);
}

void emit_sections(job *j) {
    const char *heading = "/* templates: the header includes them from itself, once for each "
                          "instruction set */\n";
    text check = {NULL, 0, 0};
    if (j->n_sections == 0) return;
    emit_lines(j, "\n");
    enter(j, "", heading);
    emit_lines(j, heading);
    append_version_check(&check, j, "defined(SLI_SELF_INCLUSION) && \\\n    ",
                         "SL_HEADER names another version of the header");
    emit_lines(j, check.bytes);
    free(check.bytes);
    if (j->n_lists > 0) emit_lines(j, j->list_macros.bytes);
    for (size_t k = 0; k < j->n_sections; k++) {
        char macro[PATH_SIZE + 16];
        section_macro(macro, j->sections[k]);
        emit_lines(j, "\n");
        emit_format(j, "#ifdef %s\n", macro);
        emit_format(j, "#undef %s\n", macro);
        expand(j, j->sections[k], 1);
        emit_lines(j, "#endif\n");
    }
}
