/* mesh_read_off.c: reads the vertices and faces of an ASCII OFF file */
#include <string.h>

#include "mesh_build.h"

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
static bool read_keyword(mesh_build *b) {
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
    rest += strncmp(rest, "ST", 2) == 0 ? 2 : 0;
    rest += *rest == 'C' ? 1 : 0;
    rest += *rest == 'N' ? 1 : 0;
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
    if (input_more_in_line(in) && strncmp(in->at, "BINARY", 6) == 0) {
        return input_error(in, "binary OFF is not supported");
    }
    return true;
}

static bool read_counts(mesh_build *b, int64_t *vertices, int64_t *faces) {
    input *in = b->in;
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
    for (int64_t k = 0; k < corners; k++) {
        int64_t vertex = 0;
        if (!input_integer(in, &vertex) || !input_at_word_end(in)) {
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
    if (!read_keyword(b) || !read_counts(b, &vertices, &faces)) {
        return false;
    }
    for (int64_t k = 0; k < vertices; k++) {
        if (!read_vertex(b, k)) {
            return false;
        }
    }
    for (int64_t k = 0; k < faces; k++) {
        if (!read_face(b, k)) {
            return false;
        }
    }
    return true;
}
