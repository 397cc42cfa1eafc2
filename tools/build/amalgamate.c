/* amalgamate.c: writes the single header sparse_local.h from the parts that the manifest lists
 *
 *     amalgamate [--check] [--flat] [--declarations] [--bodies] [--comments]
 *                [--packs "change save"] [--home URL] MANIFEST OUT [LICENSE]
 *
 * --check   compares OUT with what would be written and writes nothing.
 * --flat    expands a template at each of its includes; the result does not include itself.
 * --declarations, --bodies  the two files of the pair: OUT has what is before the heading
 *           "---- bodies" of the manifest, or what follows it and an include of the other, which
 *           has the name of OUT with .h at its end. Both are flat.
 * --comments  keeps the comments of the implementation, except reasons why no test reaches a line.
 * --packs   the header has the core and these packs only; "" is the core.
 * --home    an address, in the first lines of the header; "" is none.
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
 *     #define SLI_INL_<NAME>
 *     #include SL_HEADER
 *
 * so that OUT includes itself and each template is in it exactly once. Includes of templates in
 * consecutive lines share one self-inclusion where the order of the sections allows it, because
 * each takes a compiler 50 ms. A template that another template includes is expanded in place; it
 * may be included only once.
 *
 * A list is a file named *.list.h: includes of templates, and of other lists, that several parts or
 * instruction sets share. Its lines are expanded at each include, as if they stood there, without
 * its comments and empty lines. `#include SLI_X` includes the path that SLI_X was last defined as:
 *
 *     #define SLI_X "../folder/templates.list.h"
 *
 * relative to the file of the include, as for a compiler. Such definitions are not emitted.
 *
 * Parts below impl/ are indented by two columns a level instead of four, and their comments and
 * the alignment of continued lines stay behind, because a header is read by its users and copied in
 * one piece: that makes OUT smaller by a fifth. Whoever reads the implementation reads it in the
 * folder of the manifest. Two kinds of comments are kept: the first line of a file, and reasons why
 * no test reaches a line, which the measurement of coverage reads.
 *
 * The first line of a file, "name.h: what it does", gets the path of the file and so marks where it
 * begins. A template inside another one also has a line where it ends. Includes in angle brackets
 * and all other lines are copied as they are: no renaming, no dates. The same input gives the same
 * bytes.
 *
 * Where the manifest has a comment that begins with "last: ", OUT undefines each macro named SLI_,
 * SLV_, SLW_ or SLF_ that it defines and nowhere undefines, templates included: a first pass finds
 * them. So an implementation leaves no internal macro behind.
 *
 * A pack is what blocks of the manifest select whose condition is defined(SL_WITH_X), or several of
 * these with && and || between them. Where such a block is off, a macro for each public function
 * that it would declare turns a call into an identifier that nobody declares and that says what
 * the call needs: sl_name_needs_SL_WITH_X. These macros are made from the declarations, which begin
 * with SL_API in column 1.
 *
 * With --packs the blocks that are on are written without their conditions, and the others are left
 * out but for these macros; public/packs.h, which may imply packs by others, is replaced by macros
 * of the packs that are in OUT; templates that no part includes are left out; and SL_HEADER is the
 * name of OUT.
 */
#include "job.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "amalgamate [--check] [--flat] [--declarations] [--bodies] [--comments] "
    "[--packs \"change save\"] [--home URL] MANIFEST OUT [LICENSE]";

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

/* Finds the packs that the manifest knows and, of a selection, those that are on. */
static void find_packs(job *j, const char *manifest, const char *list) {
    text bytes = {NULL, 0, 0}, implied = {NULL, 0, 0};
    char path[2 * PATH_SIZE];
    if (!read_file(&bytes, manifest)) fail(manifest, 0, "cannot be read", NULL);
    for (const char *line = bytes.bytes; *line; line += whole_line(line)) {
        if (directive_of(line) == OPENS) add_named_packs(&j->known, line, whole_line(line));
    }
    if (list) {
        j->is_selection = 1;
        add_listed_packs(&j->on, list, &j->known);
        snprintf(path, sizeof path, "%spublic/packs.h", j->folder);
        if (read_file(&implied, path)) add_implied_packs(&j->on, implied.bytes);
    }
    free(bytes.bytes);
    free(implied.bytes);
}

/* Makes the body of the header. */
static void make_body(job *j, const char *manifest, const char *undefinitions) {
    j->undefinitions = undefinitions;
    expand(j, manifest, 0);
    emit_sections(j);
}

int main(int argc, char **argv) {
    static job j, first;
    text out = {NULL, 0, 0}, there = {NULL, 0, 0}, undefined = {NULL, 0, 0};
    int only_check = 0, n_args = argc - 1;
    char **args = argv + 1;
    const char *packs = NULL;
    for (; n_args > 0 && strncmp(*args, "--", 2) == 0; args++, n_args--) {
        if (strcmp(*args, "--check") == 0)
            only_check = 1;
        else if (strcmp(*args, "--flat") == 0)
            j.is_flat = 1;
        else if (strcmp(*args, "--declarations") == 0)
            j.is_flat = 1, j.half = DECLARATIONS;
        else if (strcmp(*args, "--bodies") == 0)
            j.is_flat = 1, j.half = BODIES;
        else if (strcmp(*args, "--comments") == 0)
            j.keeps_comments = 1;
        else if (strcmp(*args, "--packs") == 0 && n_args > 1)
            packs = *++args, n_args--;
        else if (strcmp(*args, "--home") == 0 && n_args > 1)
            j.home = *++args, n_args--;
        else
            fail(*args, 0, "unknown option", NULL);
    }
    if (n_args < 2 || n_args > 3)
        fail("usage", 0, usage, NULL);

    const char *slash = strrchr(args[0], '/');
    const char *manifest = slash ? slash + 1 : args[0];
    copy_path(j.folder, args[0], (size_t)(manifest - args[0]));
    if (j.home && strstr(j.home, "*/")) fail(j.home, 0, "contains the end of a comment", NULL);
    slash = strrchr(args[1], '/');
    j.name = slash ? slash + 1 : args[1];
    find_packs(&j, args[0], packs);
    first = j;
    make_body(&first, manifest, "");
    append_string(&undefined, "");
    find_undefined(&undefined, &first);
    make_body(&j, manifest, undefined.bytes);
    if (!*j.version[0] || !*j.version[1] || !*j.version[2])
        fail(args[0], 0, "no part defines SL_VERSION_*", NULL);
    keep_half(&j);

    size_t shift = banner(&out, &j, 0);
    out.length = 0;
    banner(&out, &j, shift);
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
    free(undefined.bytes);
    free(first.body.bytes);
    free(first.list_macros.bytes);
    free(j.list_macros.bytes);
    free(j.body.bytes);
    return status;
}
