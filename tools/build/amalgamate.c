/* amalgamate.c: expands the quoted includes of the manifest into the one header that users take
 *
 *     amalgamate [--check] MANIFEST OUT [LICENSE]
 *
 * MANIFEST  the ordered list of parts; lines of its own (guards, headings) go to OUT as they stand.
 * OUT       written only if its bytes change; with --check compared only.
 * LICENSE   a text file that closes OUT as a comment, since a header travels alone.
 *
 * A part stands in OUT once, where the manifest includes it; an include of it from another part vanishes, as the guard
 * would have it. A part named *.inl.h has no guard and stands at each of its includes. Includes in angle brackets
 * stay. Nothing else is touched: no renaming, no dates, so that the same input gives the same bytes.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 512, ENTRIES_MAX = 512, DEPTH_MAX = 16 };

typedef struct text {
    char *bytes;
    size_t length;
    size_t room;
} text;

/* one line of the table of contents */
typedef struct entry {
    char name
        [PATH_SIZE]; /* path of a part from the manifest's folder; empty: a heading of the manifest */
    char title[PATH_SIZE];
    size_t line; /* of the body */
    int is_guarded;
} entry;

typedef struct job {
    char folder[PATH_SIZE]; /* of the manifest, with the closing slash; "" for the current one */
    text body;
    size_t lines;
    entry entries[ENTRIES_MAX];
    size_t n_entries;
    char version[3][16];
} job;

static void fail(const char *where, size_t line, const char *what, const char *fix) {
    if (line)
        fprintf(stderr, "%s:%lu: %s\n", where, (unsigned long)line, what);
    else
        fprintf(stderr, "%s: %s\n", where, what);
    if (fix) fprintf(stderr, "fix: %s\n", fix);
    exit(2);
}

static void append(text *t, const char *bytes, size_t length) {
    if (t->room - t->length < length + 1) {
        t->room = 2 * (t->room + length + 1);
        t->bytes = (char *)realloc(t->bytes, t->room);
        if (!t->bytes) fail("amalgamate", 0, "out of memory", NULL);
    }
    memcpy(t->bytes + t->length, bytes, length);
    t->length += length;
    t->bytes[t->length] = 0;
}

static void append_string(text *t, const char *string) {
    append(t, string, strlen(string));
}

/* The file with '\n' line ends and a closing one, whatever the editor left. Returns whether there is one. */
static int read_file(text *t, const char *path) {
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

static void copy_path(char *to, const char *from, size_t length) {
    if (length >= PATH_SIZE) fail(from, 0, "path too long", NULL);
    memcpy(to, from, length);
    to[length] = 0;
}

/* to = target as seen from the folder of the part `from`, "." and ".." worked out; both from the manifest's folder */
static void resolve(char *to, const char *from, const char *target, size_t length) {
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

/* The target of a quoted include and its length, or NULL for any other line. */
static const char *quoted_include(const char *line, size_t *length) {
    line = skip_blanks(line);
    if (*line != '#') return NULL;
    line = skip_blanks(line + 1);
    if (strncmp(line, "include", 7) != 0) return NULL;
    line = skip_blanks(line + 7);
    if (*line != '"') return NULL;
    *length = strcspn(++line, "\"\n");
    return line[*length] == '"' ? line : NULL;
}

static int is_repeated(const char *path) {
    size_t length = strlen(path);
    return length > 6 && strcmp(path + length - 6, ".inl.h") == 0;
}

static int starts_with_guard(const char *s) {
    while (s && *s) {
        const char *line = skip_blanks(s);
        if (*line == '#') return strncmp(skip_blanks(line + 1), "ifndef", 6) == 0;
        s = strchr(s, '\n');
        if (s) s++;
    }
    return 0;
}

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

static void emit_mark(job *j, const char *what, const char *path) {
    char line[PATH_SIZE + 32];
    int length = snprintf(line, sizeof line, "/* %s src/%s */\n", what, path);
    emit(j, line, (size_t)length);
}

/* Adds a line to the table of contents: from "/ * name: title * /" of a part, or from a heading of the manifest. */
static void enter(job *j, const char *path, const char *line) {
    if (j->n_entries == ENTRIES_MAX)
        fail(path, 0, "too many parts for the table of contents", NULL);
    entry *e = &j->entries[j->n_entries++];
    copy_path(e->name, path, strlen(path));
    e->line = j->lines + 1;
    e->is_guarded = starts_with_guard(line);
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

/* An include of a part: expands it, or drops it where it stands in the product already. */
static void include(job *j, const char *from, size_t line, const char *target, size_t length,
                    int depth) {
    char path[PATH_SIZE], here[2 * PATH_SIZE];
    resolve(path, from, target, length);
    snprintf(here, sizeof here, "%s%s", j->folder, from);
    if (depth == DEPTH_MAX)
        fail(here, line, "includes nest too deep: do they run in a circle?", NULL);
    const entry *before = find_entry(j, path);
    if (is_repeated(path)) {
        expand(j, path, depth + 1);
    } else if (!before) {
        if (depth > 0)
            fail(here, line, "includes a part that has not come yet",
                 "list it earlier in the manifest");
        expand(j, path, depth + 1);
    } else if (depth == 0) {
        fail(here, line, "this part is listed twice", "list it once");
    } else if (!before->is_guarded) {
        fail(here, line, "includes a part without guard",
             "guard that part, or name it *.inl.h to have it here again");
    }
}

/* Emits a file line by line; depth 0 is the manifest, whose first line the banner replaces. */
static void expand(job *j, const char *path, int depth) {
    char full[2 * PATH_SIZE];
    text part = {NULL, 0, 0};
    snprintf(full, sizeof full, "%s%s", j->folder, path);
    if (!read_file(&part, full)) fail(full, 0, "cannot be read", NULL);
    if (depth > 0) {
        if (!find_entry(j, path)) enter(j, path, part.bytes);
        emit_mark(j, "begin", path);
    }
    int dropped = 0;
    size_t number = 1;
    for (const char *line = part.bytes; *line; number++) {
        size_t length = strcspn(line, "\n") + 1, width;
        const char *target = quoted_include(line, &width);
        if (target) {
            size_t lines = j->lines;
            include(j, path, number, target, width, depth);
            dropped = j->lines == lines;
        } else if (!(depth == 0 && number == 1) && !(dropped && *line == '\n')) {
            if (depth == 0 && strncmp(line, "/*", 2) == 0) enter(j, "", line);
            emit(j, line, length);
            dropped = 0;
        }
        line += length;
    }
    if (depth > 0) emit_mark(j, "end", path);
    free(part.bytes);
}

/* FNV-1a, 64 bits */
static uint64_t hash(const text *t) {
    uint64_t h = UINT64_C(0xcbf29ce484222325);
    for (size_t k = 0; k < t->length; k++)
        h = (h ^ (unsigned char)t->bytes[k]) * UINT64_C(0x100000001b3);
    return h;
}

/* The comment on top; shift is the number of its own lines, which the line numbers of the contents count. */
static size_t banner(text *out, const job *j, const char *name, size_t shift) {
    char line[2 * PATH_SIZE + 64];
    uint64_t h = hash(&j->body);
    size_t lines = 0;
    snprintf(line, sizeof line, "/* %s %s.%s.%s, generated: edit src/, run make header\n", name,
             j->version[0], j->version[1], j->version[2]);
    append_string(out, line);
    snprintf(line, sizeof line,
             " * FNV-1a of all that follows this comment, license aside: %08lx%08lx\n",
             (unsigned long)(h >> 32), (unsigned long)(h & 0xffffffffu));
    append_string(out, line);
    append_string(out, " *\n * Contents\n");
    lines += 4;
    for (size_t k = 0; k < j->n_entries; k++, lines++) {
        const entry *e = &j->entries[k];
        if (*e->name) {
            unsigned long at = (unsigned long)(e->line + shift);
            snprintf(line, sizeof line, " * %6lu  %-26s %s\n", at, e->name, e->title);
        } else {
            snprintf(line, sizeof line, " *         (%s)\n", e->title);
        }
        append_string(out, line);
    }
    append_string(out, " */\n");
    return lines + 1;
}

static void append_license(text *out, const char *path) {
    text license = {NULL, 0, 0};
    if (!read_file(&license, path)) fail(path, 0, "cannot be read", NULL);
    if (strstr(license.bytes, "*/")) fail(path, 0, "would end the comment it goes to", NULL);
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
    fprintf(stderr, "%s:%lu: from here on it is not what src/ makes\nfix: run: make header\n", path,
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
    int only_check = argc > 1 && strcmp(argv[1], "--check") == 0;
    char **args = argv + 1 + only_check;
    int n_args = argc - 1 - only_check;
    if (n_args < 2 || n_args > 3)
        fail("usage", 0, "amalgamate [--check] MANIFEST OUT [LICENSE]", NULL);

    const char *slash = strrchr(args[0], '/');
    const char *manifest = slash ? slash + 1 : args[0];
    copy_path(j.folder, args[0], (size_t)(manifest - args[0]));
    expand(&j, manifest, 0);
    if (!*j.version[0] || !*j.version[1] || !*j.version[2])
        fail(args[0], 0, "no part defines SL_VERSION_*", NULL);

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
