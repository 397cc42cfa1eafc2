/* mesh_read_off.c: reads the vertices and faces of an OFF file, ASCII or binary */
#include <string.h>

#include "mesh_build.h"
#include "tools/io/scalar.h"

/* What the first words say. */
typedef struct off_kind {
    bool is_binary;
    int extra; /* numbers of a vertex after x y z: a normal, a color, texture coordinates */
} off_kind;

/* Turns a word without capitals into capitals. "noff" remains as it is: it can be NOFF or nOFF. */
static void raise_word(char *word) {
    for (const char *c = word; *c != '\0'; c++) {
        if ((*c >= 'A' && *c <= 'Z') || strcmp(word, "noff") == 0) {
            return;
        }
    }
    for (; *word != '\0'; word++) {
        *word = *word >= 'a' && *word <= 'z' ? (char)(*word - 'a' + 'A') : *word;
    }
}

/* Reads the first word, unless it is a number: it says what a vertex line contains. Texture, color
 * and normal follow x y z and are ignored with the rest of the line. Formats with 4 or n
 * coordinates are rejected because their x y z have another meaning. The first count may follow
 * without a blank. */
static bool read_keyword(mesh_build *b, off_kind *kind) {
    input *in = b->in;
    double ignored;
    const char *start = in->at;
    if (input_number(in, &ignored) && input_at_word_end(in)) {
        in->at = start;
        return true;
    }
    in->at = start;
    char word[16];
    input_word(in, word, sizeof word);
    raise_word(word);
    const char *rest = word;
    const bool has_texture = strncmp(rest, "ST", 2) == 0;
    rest += has_texture ? 2 : 0;
    const bool has_color = *rest == 'C';
    rest += has_color ? 1 : 0;
    const bool has_normal = *rest == 'N';
    rest += has_normal ? 1 : 0;
    kind->extra = (has_normal ? 3 : 0) + (has_color ? 4 : 0) + (has_texture ? 2 : 0);
    if (strcmp(rest, "4OFF") == 0 || strcmp(rest, "nOFF") == 0 || strcmp(rest, "4nOFF") == 0) {
        return input_error(in, "%s is not supported: vertices must have three coordinates", word);
    }
    if (strncmp(rest, "OFF", 3) == 0 && rest[3] >= '0' && rest[3] <= '9') {
        in->at = strpbrk(start, "Ff") + 2; /* after OFF */
        return true;
    }
    if (strcmp(rest, "OFF") != 0) {
        return input_error(in, "not an OFF mesh: begins with neither OFF nor a count");
    }
    kind->is_binary = input_more_in_line(in) && strncmp(in->at, "BINARY", 6) == 0;
    if (kind->is_binary) {
        (void)input_next_line(in);
        in->line = 0;
    }
    return true;
}

/* The next big-endian number of a binary file. */
static bool next(input *in, scalar_type type, double *x) {
    return scalar_read(in, false, type, true, x);
}

/* The next count or index of a binary file. */
static bool next_index(input *in, int64_t *k) {
    double x = 0;
    if (!next(in, SCALAR_INT32, &x) || !scalar_is_index(x)) {
        return input_error(in, "truncated, or not a count or an index");
    }
    *k = (int64_t)x;
    return true;
}

static bool read_binary_vertex(mesh_build *b, const off_kind *kind, int64_t number) {
    double x[3], ignored;
    bool ok = true;
    for (int k = 0; k < 3 + kind->extra && ok; k++) {
        ok = next(b->in, SCALAR_FLOAT, k < 3 ? &x[k] : &ignored);
    }
    return ok ? mesh_build_vertex(b, x[0], x[1], x[2])
              : input_error(b->in, "vertex %lld: truncated", (long long)number);
}

/* Corners, and a color of so many numbers as a count says. */
static bool read_binary_face(mesh_build *b) {
    int64_t corners = 0, vertex = 0, colors = 0;
    double ignored;
    bool ok = next_index(b->in, &corners);
    for (int64_t k = 0; k < corners && ok; k++) {
        ok = next_index(b->in, &vertex) && mesh_build_corner(b, vertex);
    }
    ok = ok && mesh_build_polygon(b) && next_index(b->in, &colors);
    for (int64_t k = 0; k < colors && ok; k++) {
        ok = next(b->in, SCALAR_FLOAT, &ignored) ||
             input_error(b->in, "truncated in the color of a face");
    }
    return ok;
}

static bool read_counts(mesh_build *b, const off_kind *kind, int64_t *vertices, int64_t *faces) {
    input *in = b->in;
    int64_t edges = 0;
    if (kind->is_binary) {
        return next_index(in, vertices) && next_index(in, faces) && next_index(in, &edges);
    }
    if (!input_more(in) || !input_integer(in, vertices) || !input_integer(in, faces) ||
        !input_at_word_end(in) || *vertices < 0 || *faces < 0) {
        return input_error(in, "counts of vertices, faces and edges expected");
    }
    (void)input_next_line(in);
    return true;
}

static bool read_vertex(mesh_build *b, int64_t number) {
    double x[3];
    bool ok = input_more(b->in);
    for (int k = 0; k < 3 && ok; k++) {
        ok = input_number(b->in, &x[k]) && input_at_word_end(b->in);
    }
    if (!ok) {
        return input_error(b->in, "vertex %lld: three numbers expected", (long long)number);
    }
    (void)input_next_line(b->in);
    return mesh_build_vertex(b, x[0], x[1], x[2]);
}

static bool read_face(mesh_build *b, int64_t number) {
    input *in = b->in;
    int64_t corners = 0;
    if (!input_more(in) || !input_integer(in, &corners) || !input_at_word_end(in)) {
        return input_error(in, "face %lld: number of corners expected", (long long)number);
    }
    const int64_t line = in->line;
    for (int64_t k = 0; k < corners; k++) { /* which may go on in the next line */
        int64_t vertex = 0;
        if (!input_more(in) || !input_integer(in, &vertex) || !input_at_word_end(in)) {
            in->line = line;
            return input_error(in, "face %lld: %lld corners expected", (long long)number,
                               (long long)corners);
        }
        if (!mesh_build_corner(b, vertex)) {
            return false;
        }
    }
    bool ok = mesh_build_polygon(b);
    (void)input_next_line(in);
    return ok;
}

bool mesh_read_off(mesh_build *b) {
    b->in->comment = '#';
    if (!input_more(b->in)) {
        return input_error(b->in, "not an OFF mesh: the file is empty");
    }
    int64_t vertices = 0;
    int64_t faces = 0;
    off_kind kind = {false, 0};
    if (!read_keyword(b, &kind) || !read_counts(b, &kind, &vertices, &faces)) {
        return false;
    }
    for (int64_t k = 0; k < vertices; k++) {
        if (kind.is_binary ? !read_binary_vertex(b, &kind, k) : !read_vertex(b, k)) {
            return false;
        }
    }
    for (int64_t k = 0; k < faces; k++) {
        if (kind.is_binary ? !read_binary_face(b) : !read_face(b, k)) {
            return false;
        }
    }
    return true;
}
