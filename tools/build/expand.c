/* expand.c: parts, expanded line by line; the manifest's blocks of packs */
#include "job.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A block of #if that is open. */
typedef struct block {
    int is_of_packs; /* its condition reads macros of packs and nothing else */
    int is_off;      /* the branch that is read is left out */
    int was_taken;   /* an earlier branch was not */
} block;

/* A file that is being expanded. */
typedef struct source {
    const char *path;
    int depth;
    size_t line; /* counted from 1 */
    block blocks[DEPTH_MAX];
    size_t n_blocks, n_off;
} source;

/* to = the path of a file, as messages name it. */
static void place(char *to, const job *j, const source *s) {
    snprintf(to, 2 * PATH_SIZE, "%s%s", j->folder, s->path);
}

static void fail_at(const job *j, const source *s, const char *what, const char *fix) {
    char here[2 * PATH_SIZE];
    place(here, j, s);
    fail(here, s->line, what, fix);
}

static void read_part(text *part, const job *j, const char *path) {
    char full[2 * PATH_SIZE];
    snprintf(full, sizeof full, "%s%s", j->folder, path);
    if (!read_file(part, full)) fail(full, 0, "cannot be read", NULL);
}

/* ---- packs ---- */

static void note_calls(job *j, const char *path) {
    text part = {NULL, 0, 0};
    read_part(&part, j, path);
    append_calls(&j->calls, part.bytes);
    free(part.bytes);
}

/* Begins a block of packs in the manifest. */
static void begin_packs(job *j, const source *s, const char *line) {
    if (*j->condition)
        fail_at(j, s, "blocks of packs do not nest", "write one condition with && for both");
    if (!condition_in_words(j->condition, line))
        fail_at(j, s, "a condition of packs is defined(SL_WITH_X), with && and || between several",
                "write it so, without other macros");
    j->is_left_out = j->is_selection && !condition_holds(line, &j->on);
}

/* Ends a block of packs in the manifest. Where its calls are not declared, a macro for each of them
 * says what it needs. */
static void end_packs(job *j) {
    text lines = {NULL, 0, 0};
    if (j->calls.length > 0 && (!j->is_selection || j->is_left_out)) {
        append_needs(&lines, j->calls.bytes, j->condition);
        if (!j->is_selection) emit_lines(j, "#else\n");
        emit_lines(j, lines.bytes);
    }
    free(lines.bytes);
    j->calls.length = 0;
    j->condition[0] = 0;
    j->is_left_out = 0;
}

/* Follows the blocks of a file. Returns whether a line is left out. */
static int follow_blocks(job *j, source *s, const char *line) {
    const directive d = directive_of(line);
    const int was_off = s->n_off > 0;
    if (d == NO_DIRECTIVE) return was_off;
    if (d == OPENS) {
        pack_set named = {{{0}}, 0};
        if (s->n_blocks == DEPTH_MAX) fail_at(j, s, "blocks nest too deep", NULL);
        block *b = &s->blocks[s->n_blocks++];
        const int holds = condition_holds(line, &j->on);
        add_named_packs(&named, line, whole_line(line));
        b->is_of_packs = holds >= 0;
        b->is_off = j->is_selection && holds == 0;
        b->was_taken = !b->is_off;
        s->n_off += b->is_off ? 1u : 0u;
        if (s->depth == 0 && named.count > 0) begin_packs(j, s, line);
        return was_off || (b->is_of_packs && j->is_selection);
    }
    if (s->n_blocks == 0) fail_at(j, s, "no block is open", NULL);
    block *b = &s->blocks[s->n_blocks - 1];
    if (d == NEXT_BRANCH && b->is_of_packs && s->depth == 0)
        fail_at(j, s, "a block of packs has a second branch",
                "remove it: what a pack needs is written by amalgamate");
    if (d == NEXT_BRANCH && b->is_of_packs) {
        const int holds = condition_holds(line, &j->on);
        if (holds < 0) fail_at(j, s, "the condition reads packs and other macros", "nest two #if");
        s->n_off -= b->is_off ? 1u : 0u;
        b->is_off = j->is_selection && (b->was_taken || !holds);
        b->was_taken |= !b->is_off;
        s->n_off += b->is_off ? 1u : 0u;
    } else if (d == CLOSES) {
        s->n_off -= b->is_off ? 1u : 0u;
        s->n_blocks--;
        if (s->depth == 0 && b->is_of_packs) end_packs(j);
    }
    return was_off || (b->is_of_packs && j->is_selection);
}

/* Emits what takes the place of public/packs.h in a selection: the macros of the packs that are in
 * the header, and an error for each other one that is asked for. */
static void emit_selection(job *j, const char *path) {
    static const char first[] = "/* packs.h: the packs that this header has */\n";
    char line[2 * PATH_SIZE];
    enter(j, path, first);
    find_entry(j, path)->is_guarded = 1;
    emit_lines(j, first);
    for (size_t k = 0; k < j->known.count; k++) {
        const char *name = j->known.names[k];
        const int is_on = has_pack(&j->on, name);
        snprintf(line, sizeof line, "#if%sdef SL_WITH_%s\n", is_on ? "n" : "", name);
        emit_lines(j, line);
        if (is_on)
            snprintf(line, sizeof line, "#define SL_WITH_%s\n", name);
        else
            snprintf(line, sizeof line, "#error \"%s is without SL_WITH_%s\"\n", j->name, name);
        emit_lines(j, line);
        emit_lines(j, "#endif\n");
    }
    if (j->on.count == j->known.count) return;
    snprintf(line, sizeof line, "#ifdef SL_WITH_ALL\n#error \"%s is without some packs\"\n#endif\n",
             j->name);
    emit_lines(j, line);
}

/* Emits the heading that waits for what it is about. */
static void emit_heading(job *j) {
    if (j->heading.length == 0) return;
    enter(j, "", j->heading.bytes);
    emit_lines(j, j->heading.bytes);
    j->heading.length = 0;
}

/* ---- parts ---- */

/* Handles an include of a part or template: expands it, turns it into a self-inclusion, or drops
 * it. */
static void include(job *j, const source *s, const char *target, size_t length) {
    char path[PATH_SIZE], here[2 * PATH_SIZE];
    const char *from = s->path;
    const size_t line = s->line;
    const int depth = s->depth;
    resolve(path, from, target, length);
    place(here, j, s);
    if (depth == DEPTH_MAX) fail(here, line, "includes nest too deep: is there a cycle?", NULL);
    const entry *before = find_entry(j, path);
    if (depth == 0 && strncmp(path, "public/", 7) == 0 && *j->condition) note_calls(j, path);
    if (depth == 0 && j->is_selection && strcmp(path, "public/packs.h") == 0) {
        emit_selection(j, path);
    } else if (is_template(path)) {
        if (!j->is_flat && !is_template(from)) {
            add_to_batch(j, path);
        } else if (!j->is_flat && before) {
            fail(here, line, "templates include this template twice", "include it from a part");
        } else {
            expand(j, path, depth + 1);
        }
    } else if (is_list(path)) {
        expand(j, path, depth + 1);
    } else if (!before) {
        if (depth > 0)
            fail(here, line, "includes a part that the manifest does not list before this one",
                 j->is_selection ? "list it earlier; if its pack is left out, run make layers"
                                 : "list it earlier in the manifest");
        expand(j, path, depth + 1);
    } else if (depth == 0) {
        fail(here, line, "this part is listed twice", "list it once");
    } else if (!before->is_guarded) {
        fail(here, line, "includes a part without guard",
             "guard that part, or name it *.inl.h to make it a template");
    }
}

/* Checks that a file begins with its name, and returns where that begins in the path. */
static const char *check_name(const job *j, const char *path, const char *bytes) {
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    if (strncmp(bytes, "/* ", 3) != 0 || strncmp(bytes + 3, name, strlen(name)) != 0) {
        const source first = {path, 0, 1, {{0, 0, 0}}, 0, 0};
        fail_at(j, &first, "does not begin with its name",
                "begin with: /* name.h: what it does */");
    }
    return name;
}

/* Returns what follows the first line of a list, which is not emitted. */
static const char *after_name(const job *j, const char *path, const char *bytes) {
    check_name(j, path, bytes);
    return bytes + strcspn(bytes, "\n") + 1;
}

/* Emits the path of a part and checks that the part begins with its name. Returns what follows the
 * beginning of that comment. */
static const char *begin_part(job *j, const char *path, const char *bytes) {
    const char *name = check_name(j, path, bytes);
    if (!find_entry(j, path)) enter(j, path, bytes);
    j->is_in_comment = 1;
    j->n_parentheses = 0;
    append_string(&j->body, "/* src/");
    append(&j->body, path, (size_t)(name - path));
    return bytes + 3;
}

/* Emits a line that is neither an include nor left out. */
static void emit_other(job *j, const source *s, const char *line, size_t length) {
    const int is_heading = s->depth == 0 && strncmp(line, "/*", 2) == 0;
    if (is_heading && strncmp(line, "/* last: ", 9) == 0) {
        enter(j, "", line);
        emit_lines(j, "/* last: internal macros are undefined */\n");
        emit_lines(j, j->undefinitions);
        return;
    }
    if (is_heading && strncmp(line, "/* ---- bodies", 14) == 0) {
        j->bodies_at = j->body.length;
        j->bodies_line = j->lines;
    }
    if (is_heading && j->is_selection) {
        j->heading.length = 0;
        append(&j->heading, line, length);
        return;
    }
    if (s->depth == 0 && directive_of(line) == CLOSES) j->heading.length = 0;
    if (s->depth == 0) emit_heading(j);
    if (is_heading) enter(j, "", line);
    emit_from(j, s->path, line, length);
}

void expand(job *j, const char *path, int depth) {
    source s = {path, depth, 1, {{0, 0, 0}}, 0, 0};
    text part = {NULL, 0, 0};
    read_part(&part, j, path);
    if (strncmp(path, "impl/", 5) == 0) drop_comments(&part, j->keeps_comments && !is_list(path));
    const guard g = find_guard(part.bytes);
    const int is_spliced = is_list(path);
    const char *body = is_spliced  ? after_name(j, path, part.bytes)
                       : depth > 0 ? begin_part(j, path, part.bytes)
                                   : part.bytes;
    int dropped = is_spliced;
    for (const char *line = body; *line; s.line++) {
        size_t length = strcspn(line, "\n") + 1, width;
        const char *target = included_path(j, line, &width);
        const int is_guard = depth > 0 && (line == g.ifndef || line == g.define || line == g.endif);
        if (is_spliced && *line == '\n') {
            line++;
            continue;
        }
        if (!target) self_include(j);
        if (!is_guard && follow_blocks(j, &s, line)) {
            char public_part[PATH_SIZE];
            if (target && depth == 0) resolve(public_part, path, target, width);
            if (target && depth == 0 && strncmp(public_part, "public/", 7) == 0)
                note_calls(j, public_part);
            for (length = whole_line(line); length > strcspn(line, "\n") + 1; s.line++) {
                const size_t first = strcspn(line, "\n") + 1;
                line += first;
                length -= first;
            }
            dropped = 1;
        } else if (target) {
            size_t lines = j->lines;
            if (depth == 0) emit_heading(j);
            include(j, &s, target, width);
            dropped = j->lines == lines;
        } else if (is_guard) {
            dropped = 0;
        } else if (note_named_path(j, line)) {
            dropped = 1;
        } else if (!(depth == 0 && s.line == 1) && !(dropped && *line == '\n')) {
            emit_other(j, &s, line, length);
            dropped = 0;
        }
        line += length;
    }
    const size_t templates = is_spliced && !j->is_flat ? templates_in_list(part.bytes) : 0;
    if (templates > 0) close_list(j, path, templates);
    if (!is_spliced) self_include(j);
    if (depth > 1 && !is_spliced) {
        const char *slash = strrchr(path, '/');
        emit_format(j, "/* end of %s */\n", slash ? slash + 1 : path);
    }
    free(part.bytes);
}
