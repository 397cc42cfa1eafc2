/* job.h: what amalgamate knows while it writes a header, and how it emits lines */
#ifndef BUILD_JOB_H
#define BUILD_JOB_H

#include "packs.h"
#include "part_text.h"

enum { ENTRIES_MAX = 512, SECTIONS_MAX = 32, DEPTH_MAX = 16, NAMED_MAX = 8 };

/* One line of the table of contents. */
typedef struct entry {
    /* path of the file, relative to the folder of the manifest; empty for a heading */
    char name[PATH_SIZE];
    char title[PATH_SIZE];
    char condition[CONDITION_SIZE]; /* in words; empty for a file of the core */
    size_t line;                    /* in the body */
    int is_guarded;
} entry;

/* What is written: all of the header, or one file of the pair. */
typedef enum half { WHOLE, DECLARATIONS, BODIES } half;

/* A macro that is a path in quotes. */
typedef struct named_path {
    char name[PATH_SIZE], path[PATH_SIZE];
} named_path;

typedef struct job {
    char folder[PATH_SIZE]; /* of the manifest, with a trailing slash; "" is the current folder */
    const char *name;       /* of the header, without its folder */
    const char *home;       /* an address, or NULL */
    half half;
    int is_flat;
    int keeps_comments;
    int is_in_comment; /* the next line of the implementation begins there, */
    int n_parentheses; /* or within as many parentheses */
    size_t dropped, indentation; /* columns of the last line that did not: left out, kept */
    text body;
    size_t lines;
    size_t bodies_at, bodies_line; /* where the bodies begin: bytes and lines before them */
    entry entries[ENTRIES_MAX];
    size_t n_entries;
    char sections[SECTIONS_MAX][PATH_SIZE]; /* templates that parts include */
    size_t n_sections;
    char batch[SECTIONS_MAX][PATH_SIZE]; /* those of the next self-inclusion, in this order */
    size_t batch_list[SECTIONS_MAX];     /* 1 + the list that each comes from, or 0 */
    size_t n_batch;
    char lists[SECTIONS_MAX][PATH_SIZE]; /* of templates alone, that have a macro */
    size_t n_lists;
    text list_macros; /* the lines that define the macros of their templates */
    named_path named[NAMED_MAX];
    size_t n_named;
    int has_self_inclusion, has_check; /* has_check: outside the blocks of packs */
    char version[4][16]; /* the numbers, and the suffix with its quotes */

    /* Packs. The manifest's blocks of packs do not nest. */
    pack_set known;
    int is_selection;               /* the header has the core and the packs `on` only */
    pack_set on;                    /* those chosen and those that they imply */
    char condition[CONDITION_SIZE]; /* of the block that is open, in words; empty outside */
    int is_left_out;                /* the block that is open */
    text calls;                     /* public functions that it declares, one a line */
    text heading;                   /* of a selection: emitted if anything follows it */

    const char *undefinitions; /* emitted where the manifest says so; empty in a first pass */
} job;

void emit(job *j, const char *line, size_t length);

/* Emits a line of the file `path`; in the implementation, with half of each four columns of its
 * indentation. Lines that continue a comment or an expression in parentheses move with its first
 * line: if comments are kept, they stay aligned, else they are indented by up to four columns. */
void emit_from(job *j, const char *path, const char *line, size_t length);

void emit_lines(job *j, const char *lines);

/* Emits a line that names a file or a macro. */
void emit_format(job *j, const char *format, const char *name);

/* Adds a line to the table of contents. `line` is the first line of a file, "/ * name: title * /",
 * or a heading of the manifest. */
void enter(job *j, const char *path, const char *line);

entry *find_entry(job *j, const char *path);

/* Appends the comment at the top of the header and returns its number of lines. shift: that number,
 * which the line numbers in the contents include. Only public parts are listed with their titles.
 * The titles of the others would be 8 kB; they are in the first lines of the parts. */
size_t banner(text *out, const job *j, size_t shift);

/* Emits a self-inclusion that selects the sections of the batch. The first one checks SL_HEADER: a
 * section undefines its macro, so a macro that is still defined was seen by another file. If the
 * first one is in a block of a pack, so does the first one of the core. */
void self_include(job *j);

/* Adds a template to the batch. Sections are compiled in the order in which they are in OUT: one
 * that comes before the last of the batch begins another batch. A new one follows the last of the
 * batch; where it begins one, as the words of an instruction set do, it comes before all others. */
void add_to_batch(job *j, const char *path);

/* Makes one macro of the last `count` templates of the batch, which are those of a list. */
void close_list(job *j, const char *path, size_t count);

int is_list(const char *path);

/* The number of templates in a list of nothing else; 0 if it is not such a list. */
size_t templates_in_list(const char *bytes);

/* Notes a macro SLI_ that is a path of a header in quotes. Returns whether the line defines or
 * undefines such a macro: it is then not emitted. */
int note_named_path(job *j, const char *line);

/* Returns the target of an include in quotes or by the name of such a macro, and its length; NULL
 * for any other line. */
const char *included_path(job *j, const char *line, size_t *length);

/* Emits the templates, each in a section of its own. Before them the header that includes itself,
 * SLI_SELF_INCLUSION, checks that SL_HEADER is not another version of it. */
void emit_sections(job *j);

/* Appends an #error, after an #if that holds where the header that is included has another
 * version. also: what has to hold besides; what: the error. */
void append_version_check(text *to, const job *j, const char *also, const char *what);

/* Cuts the body and the table of contents to j->half. The bodies then begin with an include of the
 * declarations. */
void keep_half(job *j);

/* Appends lines of the banner that say what a half is compiled with; returns how many. */
size_t append_use(text *out, const job *j);

/* Appends an #undef of each internal macro that the body defines and nowhere undefines. */
void find_undefined(text *undefined, const job *j);

/* Emits a file line by line. Depth 0 is the manifest, whose first line the banner replaces. */
void expand(job *j, const char *path, int depth);

#endif
