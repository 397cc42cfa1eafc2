/* mesh_read_stl.c: reads ASCII and binary STL files; merges corners with equal coordinates */
#include <string.h>

#include "mesh_build.h"
#include "tools/io/scalar.h"

/* Bytes of a binary file. Header: 80 arbitrary bytes and the count of facets. Record: a normal and
 * three corners of 3 floats each, and 2 bytes of attributes. */
enum { HEADER = 84, RECORD = 50 };

/* Adds a corner to the current facet. */
static bool add_corner(mesh_build *b, const double x[3]) {
    /* + 0.0 turns a negative zero into a zero */
    return mesh_build_vertex(b, x[0] + 0.0, x[1] + 0.0, x[2] + 0.0) &&
           mesh_build_corner(b, b->result.n_vertices - 1);
}

static bool read_binary(mesh_build *b, uint32_t count) {
    for (uint32_t f = 0; f < count; f++) {
        const char *at = b->in->data + HEADER + (size_t)f * RECORD + 12; /* after the normal */
        for (int c = 0; c < 3; c++, at += 12) {
            const double x[3] = {scalar_decode(SCALAR_FLOAT, false, at),
                                 scalar_decode(SCALAR_FLOAT, false, at + 4),
                                 scalar_decode(SCALAR_FLOAT, false, at + 8)};
            if (!add_corner(b, x)) {
                return false;
            }
        }
        if (!mesh_build_polygon(b)) {
            return false;
        }
    }
    return true;
}

/* Reads a word in lower case. */
static void read_keyword(input *in, char word[16]) {
    input_word(in, word, 16);
    for (char *c = word; *c != '\0'; c++) {
        *c = *c >= 'A' && *c <= 'Z' ? (char)(*c - 'A' + 'a') : *c;
    }
}

static bool read_vertex(mesh_build *b) {
    double x[3];
    for (int d = 0; d < 3; d++) {
        if (!input_number(b->in, &x[d]) || !input_at_word_end(b->in)) {
            return input_error(b->in, "vertex: three numbers expected");
        }
    }
    return add_corner(b, x);
}

static bool read_ascii(mesh_build *b) {
    input *in = b->in;
    bool in_solid = false;
    while (input_more(in)) {
        char word[16];
        read_keyword(in, word);
        bool is_end = strcmp(word, "endsolid") == 0;
        if (strcmp(word, "solid") == 0 || is_end) {
            if (in_solid != is_end || b->n_corners > 0) {
                return input_error(in, "unexpected %s", word);
            }
            in_solid = !is_end;
        } else if (!in_solid) {
            return input_error(in, "'%s' outside a solid", word);
        } else if (strcmp(word, "vertex") == 0) {
            if (!read_vertex(b)) {
                return false;
            }
            continue; /* the next keyword may be on the same line */
        } else if (strcmp(word, "endloop") == 0) {
            if (b->n_corners != 3) {
                return input_error(in, "a facet must have 3 vertices, not %d", (int)b->n_corners);
            }
            if (!mesh_build_polygon(b)) {
                return false;
            }
            continue;
        } else if (strcmp(word, "facet") == 0 || strcmp(word, "outer") == 0 ||
                   strcmp(word, "endfacet") == 0) {
            if (b->n_corners > 0) {
                return input_error(in, "'%s' inside a loop", word);
            }
            if (word[0] == 'o') {
                read_keyword(in, word); /* loop */
                continue;
            }
            if (word[0] == 'e') {
                continue;
            }
        } else {
            return input_error(in, "'%s' is not an STL keyword", word);
        }
        if (!input_next_line(in)) { /* the rest of a solid or facet line is ignored */
            break;
        }
    }
    return !in_solid || input_error(in, "truncated: ends without endsolid");
}

static bool begins_with_solid(input *in) {
    const char *start = in->at;
    char word[16] = "";
    if (input_more(in)) {
        read_keyword(in, word);
    }
    in->at = start;
    in->line = 1;
    return strcmp(word, "solid") == 0;
}

bool mesh_read_stl(mesh_build *b) {
    input *in = b->in;
    size_t length = (size_t)(in->end - in->data);
    uint32_t count = 0;
    if (length >= HEADER) {
        count = (uint32_t)scalar_decode(SCALAR_UINT32, false, in->data + 80);
    }
    bool ok;
    /* A binary file may begin with "solid", too, so its length decides; or a zero byte, which text
     * does not have: counts below 2^24 end in one. Bytes may follow the last triangle. */
    const size_t whole = HEADER + (size_t)count * RECORD;
    const bool is_text =
        begins_with_solid(in) && memchr(in->data, 0, length < HEADER ? length : HEADER) == NULL;
    if (length >= HEADER && (length == whole || (!is_text && count > 0 && length > whole))) {
        in->line = 0;
        ok = read_binary(b, count);
        if (ok && length > whole) {
            mesh_build_note(b, "%lu bytes follow the last of %lu triangles, and are ignored",
                            (unsigned long)(length - whole), (unsigned long)count);
        }
    } else if (is_text) {
        ok = read_ascii(b);
    } else {
        in->line = 0;
        return input_error(in,
                           length < HEADER
                               ? "too short for an STL file"
                               : "neither ASCII STL nor binary STL of %lu triangles: %lu "
                                 "bytes",
                           (unsigned long)count, (unsigned long)length);
    }
    return ok && mesh_build_weld(b, 0, 0);
}
