/* amalgamate.c: writes the single header sparse_local.h from the parts that the manifest lists
 *
 *     amalgamate [--check] [--flat] MANIFEST OUT [LICENSE]
 *
 * --check   compares OUT with what would be written and writes nothing.
 * --flat    expands a template at each of its includes; the result does not include itself.
 * MANIFEST  the ordered list of parts; its other lines (guards, headings) are copied unchanged.
 * OUT       the header; written only if its bytes change.
 * LICENSE   a text file, appended as a comment, because a header is often copied by itself.
 *
 * A part is a guarded file. It is expanded once, where the manifest includes it, without its guard.
 * An include of it from another part is dropped, as its guard would do.
 *
 * A template is a file named *.inl.h. It has no guard and is compiled several times. A template
 * that a part includes becomes a section at the end of OUT, and the include becomes
 *
 *     #define SLI_SECTION_<NAME>
 *     #include SL_HEADER
 *
 * so that OUT includes itself and each template is in it exactly once. Includes of templates in
 * consecutive lines share one self-inclusion where the order of the sections allows it, because
 * each takes a compiler 50 ms. A template that another template includes is expanded in place; it
 * may be included only once.
 *
 * Parts below impl/ are indented by two columns a level instead of four, and their comments stay
 * behind, because a header is read by its users and copied in one piece: that makes OUT smaller by
 * a fifth. Whoever reads the implementation reads it in the folder of the manifest. Two kinds of
 * comments are kept: the first line of a file, and reasons why no test reaches a line, which
 * the measurement of coverage reads.
 *
 * The first line of a file, "name.h: what it does", gets the path of the file and so marks where it
 * begins. A template inside another one also has a line where it ends. Includes in angle brackets
 * and all other lines are copied as they are: no renaming, no dates. The same input gives the same
 * bytes.
 */
#include "part_text.h"

#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ENTRIES_MAX = 512, SECTIONS_MAX = 32, DEPTH_MAX = 16 };

/* One line of the table of contents. */
typedef struct entry {
    /* path of the file, relative to the folder of the manifest; empty for a heading */
    char name[PATH_SIZE];
    char title[PATH_SIZE];
    size_t line; /* in the body */
    int is_guarded;
} entry;

typedef struct job {
    char folder[PATH_SIZE]; /* of the manifest, with a trailing slash; "" is the current folder */
    int is_flat;
    text body;
    size_t lines;
    entry entries[ENTRIES_MAX];
    size_t n_entries;
    char sections[SECTIONS_MAX][PATH_SIZE]; /* templates that parts include */
    size_t n_sections;
    char batch[SECTIONS_MAX][PATH_SIZE]; /* those of the next self-inclusion, in this order */
    size_t n_batch;
    int has_self_inclusion;
    char version[3][16];
} job;

static void emit(job *j, const char *line, size_t length) {
    static const char *const names[3] = {"MAJOR", "MINOR", "PATCH"};
    char name[16], value[16];
    append(&j->body, line, length);
    j->lines++;
    if (sscanf(line, "#define SL_VERSION_%15s %15s", name, value) == 2) {
        for (int k = 0; k < 3; k++) {
            if (strcmp(name, names[k]) == 0) strcpy(j->version[k], value);
        }
    }
}

/* Emits a line of the file `path`; in the implementation, with half of each four columns of its
 * indentation. */
static void emit_from(job *j, const char *path, const char *line, size_t length) {
    if (strncmp(path, "impl/", 5) == 0) {
        size_t dropped = strspn(line, " ") / 4 * 2;
        line += dropped;
        length -= dropped;
    }
    emit(j, line, length);
}

static void emit_lines(job *j, const char *lines) {
    while (*lines) {
        size_t length = strcspn(lines, "\n") + 1;
        emit(j, lines, length);
        lines += length;
    }
}

/* Emits a line that names a file or a macro. */
static void emit_format(job *j, const char *format, const char *name) {
    const char *at = strstr(format, "%s");
    text line = {NULL, 0, 0};
    append(&line, format, (size_t)(at - format));
    append_string(&line, name);
    append_string(&line, at + 2);
    emit(j, line.bytes, line.length);
    free(line.bytes);
}

/* Adds a line to the table of contents. `line` is the first line of a file, "/ * name: title * /",
 * or a heading of the manifest. */
static void enter(job *j, const char *path, const char *line) {
    if (j->n_entries == ENTRIES_MAX)
        fail(path, 0, "too many parts for the table of contents", NULL);
    entry *e = &j->entries[j->n_entries++];
    copy_path(e->name, path, strlen(path));
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

static entry *find_entry(job *j, const char *path) {
    for (size_t k = 0; k < j->n_entries; k++) {
        if (strcmp(j->entries[k].name, path) == 0) return &j->entries[k];
    }
    return NULL;
}

static void expand(job *j, const char *path, int depth);

/* The macro that selects the section of a template: SLI_SECTION_ and its base name in capitals. */
static void section_macro(char *to, const char *path) {
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    size_t used = (size_t)sprintf(to, "SLI_SECTION_");
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

/* Emits a self-inclusion that selects the sections of the batch. The first one checks SL_HEADER: a
 * section undefines its macro, so a macro that is still defined was seen by another file. */
static void self_include(job *j) {
    static const char check_before[] =
        "/* The header includes itself from here on: its templates, at the end, are compiled once "
        "for\n"
        " * each instruction set. SL_HEADER is the name of this file. */\n"
        "#if defined(__has_include)\n"
        "#if !__has_include(SL_HEADER)\n"
        "#error \"sparse_local.h was renamed: define SL_HEADER as its new name, in quotes\"\n"
        "#endif\n"
        "#endif\n";
    static const char check_after[] =
        "#error \"sparse_local.h: SL_HEADER names another file, not this one\"\n"
        "#endif\n";
    char macro[PATH_SIZE + 16];
    const int is_first = !j->has_self_inclusion;
    if (j->n_batch == 0) return;
    if (is_first) emit_lines(j, check_before);
    for (size_t k = 0; k < j->n_batch; k++) {
        section_macro(macro, j->batch[k]);
        emit_format(j, "#define %s\n", macro);
    }
    if (is_first) {
        emit_lines(j, "#include SL_HEADER /* not found: define SL_HEADER, see above */\n");
        emit_format(j, "#ifdef %s\n", macro);
        emit_lines(j, check_after);
    } else {
        emit_lines(j, "#include SL_HEADER\n");
    }
    j->has_self_inclusion = 1;
    j->n_batch = 0;
}

/* Adds a template to the batch. Sections are compiled in the order in which they are in OUT: one
 * that comes before the last of the batch begins another batch. */
static void add_to_batch(job *j, const char *path) {
    size_t last = j->n_batch > 0 ? section_at(j, j->batch[j->n_batch - 1]) : j->n_sections;
    size_t at = section_at(j, path);
    if (at == j->n_sections) {
        add_section(j, path, j->n_batch > 0 ? last + 1 : j->n_sections);
    } else if (j->n_batch > 0 && at <= last) {
        self_include(j);
    }
    copy_path(j->batch[j->n_batch++], path, strlen(path));
}

/* Emits the templates, each in a section of its own. The file that is found by SL_HEADER may be
 * another version of the header, which would be noticed late or never. */
static void emit_sections(job *j) {
    const char *heading = "/* templates: the header includes them from itself, once for each "
                          "instruction set */\n";
    if (j->n_sections == 0) return;
    emit_lines(j, "\n");
    enter(j, "", heading);
    emit_lines(j, heading);
    for (size_t k = 0; k < j->n_sections; k++) {
        char macro[PATH_SIZE + 16];
        section_macro(macro, j->sections[k]);
        emit_lines(j, "\n");
        emit_format(j, "#ifdef %s\n", macro);
        emit_format(j, "#undef %s\n", macro);
        for (int v = 0; v < 3; v++) {
            static const char *const names[3] = {"MAJOR", "MINOR", "PATCH"};
            char check[64];
            snprintf(check, sizeof check, "%s SL_VERSION_%s != %s%s", v ? "    " : "#if", names[v],
                     j->version[v], v < 2 ? " || \\\n" : "\n");
            emit_lines(j, check);
        }
        emit_lines(j, "#error \"sparse_local.h: SL_HEADER names another version of the header\"\n"
                      "#endif\n");
        expand(j, j->sections[k], 1);
        emit_lines(j, "#endif\n");
    }
}

/* Handles an include of a part or template: expands it, turns it into a self-inclusion, or drops
 * it. */
static void include(job *j, const char *from, size_t line, const char *target, size_t length,
                    int depth) {
    char path[PATH_SIZE], here[2 * PATH_SIZE];
    resolve(path, from, target, length);
    snprintf(here, sizeof here, "%s%s", j->folder, from);
    if (depth == DEPTH_MAX) fail(here, line, "includes nest too deep: is there a cycle?", NULL);
    const entry *before = find_entry(j, path);
    if (is_template(path)) {
        if (!j->is_flat && !is_template(from)) {
            add_to_batch(j, path);
        } else if (!j->is_flat && before) {
            fail(here, line, "templates include this template twice", "include it from a part");
        } else {
            expand(j, path, depth + 1);
        }
    } else if (!before) {
        if (depth > 0)
            fail(here, line, "includes a part that the manifest does not list before this one",
                 "list it earlier in the manifest");
        expand(j, path, depth + 1);
    } else if (depth == 0) {
        fail(here, line, "this part is listed twice", "list it once");
    } else if (!before->is_guarded) {
        fail(here, line, "includes a part without guard",
             "guard that part, or name it *.inl.h to make it a template");
    }
}

/* Emits a file line by line. Depth 0 is the manifest, whose first line the banner replaces. */
static void expand(job *j, const char *path, int depth) {
    char full[2 * PATH_SIZE];
    text part = {NULL, 0, 0};
    snprintf(full, sizeof full, "%s%s", j->folder, path);
    if (!read_file(&part, full)) fail(full, 0, "cannot be read", NULL);
    if (strncmp(path, "impl/", 5) == 0) drop_comments(&part);
    const guard g = find_guard(part.bytes);
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *body = part.bytes;
    if (depth > 0) {
        if (!find_entry(j, path)) enter(j, path, part.bytes);
        if (strncmp(body, "/* ", 3) != 0 || strncmp(body + 3, name, strlen(name)) != 0)
            fail(full, 1, "does not begin with its name", "begin with: /* name.h: what it does */");
        append_string(&j->body, "/* src/");
        append(&j->body, path, (size_t)(name - path));
        body += 3;
    }
    int dropped = 0;
    size_t number = 1;
    for (const char *line = body; *line; number++) {
        size_t length = strcspn(line, "\n") + 1, width;
        const char *target = quoted_include(line, &width);
        if (!target) self_include(j);
        if (target) {
            size_t lines = j->lines;
            include(j, path, number, target, width, depth);
            dropped = j->lines == lines;
        } else if (depth > 0 && (line == g.ifndef || line == g.define || line == g.endif)) {
            dropped = 0;
        } else if (!(depth == 0 && number == 1) && !(dropped && *line == '\n')) {
            if (depth == 0 && strncmp(line, "/*", 2) == 0) enter(j, "", line);
            emit_from(j, path, line, length);
            dropped = 0;
        }
        line += length;
    }
    self_include(j);
    if (depth > 1) emit_format(j, "/* end of %s */\n", name);
    free(part.bytes);
}

/* FNV-1a, 64 bits */
static uint64_t hash(const text *t) {
    uint64_t h = UINT64_C(0xcbf29ce484222325);
    for (size_t k = 0; k < t->length; k++)
        h = (h ^ (unsigned char)t->bytes[k]) * UINT64_C(0x100000001b3);
    return h;
}

/* Appends the comment at the top of the header and returns its number of lines. shift: that number,
 * which the line numbers in the contents include. Only public parts are listed with their titles.
 * The titles of the others would be 8 kB; they are in the first lines of the parts. */
static size_t banner(text *out, const job *j, const char *name, size_t shift) {
    char line[2 * PATH_SIZE + 64];
    uint64_t h = hash(&j->body);
    size_t lines = 0;
    snprintf(line, sizeof line, "/* %s %s.%s.%s, generated: edit src/, run make header\n", name,
             j->version[0], j->version[1], j->version[2]);
    append_string(out, line);
    snprintf(line, sizeof line,
             " * FNV-1a of the lines after this comment, without the license: %08lx%08lx\n",
             (unsigned long)(h >> 32), (unsigned long)(h & 0xffffffffu));
    append_string(out, line);
    append_string(out, " * The comments of the implementation are in src/impl.\n *\n * Contents\n");
    lines += 5;
    size_t column = 0; /* of the last line, if that lists parts of the implementation */
    for (size_t k = 0; k < j->n_entries; k++) {
        const entry *e = &j->entries[k];
        const char *slash = strrchr(e->name, '/'), *base = slash ? slash + 1 : e->name;
        unsigned long at = (unsigned long)(e->line + shift);
        if (strncmp(e->name, "impl/", 5) == 0) {
            size_t width = strlen(base) + 8;
            size_t is_new = column == 0 || column + width > 100;
            snprintf(line, sizeof line, "%s%s%6lu %s", is_new && column > 0 ? "\n" : "",
                     is_new ? " * " : " ", at, base);
            lines += is_new;
            column = (is_new ? 2 : column) + width;
        } else {
            if (column > 0) append_string(out, "\n");
            column = 0;
            lines++;
            if (*e->name)
                snprintf(line, sizeof line, " * %6lu %-12s %s\n", at, base, e->title);
            else
                snprintf(line, sizeof line, " * (%s)\n", e->title);
        }
        append_string(out, line);
    }
    if (column > 0) append_string(out, "\n");
    append_string(out, " */\n");
    return lines + 1;
}

static void append_license(text *out, const char *path) {
    text license = {NULL, 0, 0};
    if (!read_file(&license, path)) fail(path, 0, "cannot be read", NULL);
    if (strstr(license.bytes, "*/")) fail(path, 0, "contains the end of a comment", NULL);
    append_string(out, "\n/*\n");
    for (const char *line = license.bytes; *line;) {
        size_t length = strcspn(line, "\n") + 1;
        append_string(out, length > 1 ? " * " : " *");
        append(out, line, length);
        line += length;
    }
    append_string(out, " */\n");
    free(license.bytes);
}

static int check(const text *made, const text *there, const char *path) {
    size_t line = 1;
    for (size_t k = 0; k < made->length && k < there->length && made->bytes[k] == there->bytes[k];
         k++)
        line += made->bytes[k] == '\n';
    fprintf(stderr, "%s:%lu: differs from what src/ gives\nfix: run: make header\n", path,
            (unsigned long)line);
    return 1;
}

static void write_file(const text *t, const char *path) {
    FILE *f = fopen(path, "wb");
    int bad = !f || fwrite(t->bytes, 1, t->length, f) != t->length;
    if (f && fclose(f) != 0) bad = 1;
    if (bad) fail(path, 0, "cannot be written", NULL);
}

int main(int argc, char **argv) {
    static job j;
    text out = {NULL, 0, 0}, there = {NULL, 0, 0};
    int only_check = 0, n_args = argc - 1;
    char **args = argv + 1;
    for (; n_args > 0 && strncmp(*args, "--", 2) == 0; args++, n_args--) {
        if (strcmp(*args, "--check") == 0)
            only_check = 1;
        else if (strcmp(*args, "--flat") == 0)
            j.is_flat = 1;
        else
            fail(*args, 0, "unknown option", NULL);
    }
    if (n_args < 2 || n_args > 3)
        fail("usage", 0, "amalgamate [--check] [--flat] MANIFEST OUT [LICENSE]", NULL);

    const char *slash = strrchr(args[0], '/');
    const char *manifest = slash ? slash + 1 : args[0];
    copy_path(j.folder, args[0], (size_t)(manifest - args[0]));
    expand(&j, manifest, 0);
    if (!*j.version[0] || !*j.version[1] || !*j.version[2])
        fail(args[0], 0, "no part defines SL_VERSION_*", NULL);
    emit_sections(&j);

    slash = strrchr(args[1], '/');
    const char *name = slash ? slash + 1 : args[1];
    size_t shift = banner(&out, &j, name, 0);
    out.length = 0;
    banner(&out, &j, name, shift);
    append(&out, j.body.bytes, j.body.length);
    if (n_args == 3) append_license(&out, args[2]);

    int same = read_file(&there, args[1]) && there.length == out.length;
    same = same && memcmp(there.bytes, out.bytes, out.length) == 0;
    int status = 0;
    if (only_check && !same)
        status = check(&out, &there, args[1]);
    else if (!same)
        write_file(&out, args[1]);
    free(out.bytes);
    free(there.bytes);
    free(j.body.bytes);
    return status;
}
