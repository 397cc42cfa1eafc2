/* mesh_write_source.c: writes a mesh as the OBJ file that it is from: polygons, groups, textures */
#include <math.h>
#include <string.h>

#include "mesh_sink.h"

/* What the lines of the file are, counted before anything is written. */
typedef struct lines {
    int64_t vertices, triangles;
    bool has_texture;
} lines;

/* Moves past the word at the cursor. */
static void skip_word(input *in) {
    char ignored[2];
    input_word(in, ignored, sizeof ignored);
}

static void count_lines(lines *l, input *in) {
    char word[4];
    memset(l, 0, sizeof *l);
    while (input_more(in)) {
        input_word(in, word, sizeof word);
        l->vertices += strcmp(word, "v") == 0;
        l->has_texture = l->has_texture || strcmp(word, "vt") == 0;
        if (strcmp(word, "f") == 0 || strcmp(word, "fo") == 0) {
            l->triangles -= 2;
            for (; input_more_in_line(in); l->triangles++) {
                skip_word(in);
            }
        }
        if (!input_next_line(in)) {
            break;
        }
    }
}

/* The text from `from` to the end of the line of the cursor, which moves to the next one. Returns
 * whether there is one. */
static bool copy_line(mesh_sink *s, input *in, const char *from) {
    const char *end = from;
    while (end < in->end && *end != '\n') {
        end++;
    }
    sink_put(s, from, (size_t)(end - from));
    sink_print(s, "\n");
    in->at = end;
    return input_next_line(in);
}

/* The line of vertex v, with a color instead of what follows the coordinates if there are any. */
static bool put_vertex(mesh_sink *s, input *in, const mesh *m, const mesh_extra *extra, size_t v) {
    const double *x = m->xyz + 3 * v;
    double ignored;
    for (int d = 0; d < 3; d++) {
        (void)input_number(in, &ignored);
    }
    sink_print(s, "v %.17g %.17g %.17g", x[0], x[1], x[2]);
    if (extra->color == NULL) {
        return copy_line(s, in, in->at);
    }
    const rgb c = extra->color[v];
    sink_print(s, " %.4f %.4f %.4f\n", c.r / 255.0, c.g / 255.0, c.b / 255.0);
    return input_next_line(in);
}

/* A face with its first field as texture coordinate: v becomes v/v, and v//n v/v/n, unless a corner
 * has no value. `so_far`: vertices before the line, from which negative numbers count back. */
static bool put_face(mesh_sink *s, input *in, const mesh *m, const mesh_extra *extra,
                     int64_t so_far) {
    const input before = *in;
    bool is_known = true;
    int64_t k = 0;
    for (int pass = 0; pass < 2; pass++) {
        *in = before;
        sink_print(s, pass == 0 ? "" : "f");
        while (input_more_in_line(in) && input_integer(in, &k)) {
            const int64_t v = k > 0 ? k : so_far + k + 1;
            char normal[32] = "";
            is_known =
                is_known && v >= 1 && v <= m->n_vertices && isfinite(extra->fields[0].value[v - 1]);
            if (!input_at_word_end(in)) {
                input_word(in, normal, sizeof normal); /* "//n" */
            }
            if (pass == 1 && is_known) {
                sink_print(s, " %lld/%lld%s", (long long)v, (long long)v,
                           normal[0] == '/' ? normal + 1 : "");
            } else if (pass == 1) {
                sink_print(s, " %lld%s", (long long)v, normal);
            }
        }
    }
    sink_print(s, "\n");
    return input_next_line(in);
}

bool mesh_write_keeps_source(const char *path, const mesh_extra *extra) {
    return extra->source != NULL && input_path_ends(path, ".obj") &&
           input_path_ends(extra->source, ".obj") && extra->uv == NULL && extra->corner_uv == NULL;
}

bool mesh_write_source(mesh_sink *s, const mesh *m, const mesh_extra *extra) {
    input in;
    lines l;
    char word[8];
    if (!mesh_write_keeps_source(".obj", extra) || !input_open(&in, extra->source, NULL, 0)) {
        return false;
    }
    const char *start = in.at;
    in.comment = '#';
    in.continuation = true;
    count_lines(&l, &in);
    const bool is_same = l.vertices == m->n_vertices && l.triangles == m->n_faces;
    const bool adds_texture = is_same && !l.has_texture && extra->n_fields > 0;
    if (adds_texture) {
        sink_field_as_uv(s, &extra->fields[0], m->n_vertices);
    }
    in.at = start;
    int64_t v = 0;
    for (bool more = is_same && in.at < in.end; more;) {
        const char *line = in.at;
        const bool is_field = strncmp(line, "#field ", 7) == 0 || strncmp(line, "#f ", 3) == 0;
        input_word(&in, word, sizeof word);
        if (strcmp(word, "v") == 0) {
            more = put_vertex(s, &in, m, extra, (size_t)v++);
        } else if (adds_texture && (strcmp(word, "f") == 0 || strcmp(word, "fo") == 0)) {
            more = put_face(s, &in, m, extra, v);
        } else if (is_field) { /* of this program, written anew */
            more = input_next_line(&in);
        } else {
            more = copy_line(s, &in, line);
        }
        more = more && in.at < in.end;
    }
    input_close(&in);
    return is_same;
}
