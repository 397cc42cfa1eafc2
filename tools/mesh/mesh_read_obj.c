/* mesh_read_obj.c: reads the vertices and faces of a Wavefront OBJ file */
#include <string.h>

#include "mesh_build.h"

static bool read_vertex(mesh_build *b) {
    double x[3];
    for (int k = 0; k < 3; k++) {
        if (!input_number(b->in, &x[k]) || !input_at_word_end(b->in)) {
            return input_error(b->in, "v: three numbers expected");
        }
    }
    return mesh_build_vertex(b, x[0], x[1], x[2]);
}

/* v, v/vt, v//vn or v/vt/vn: only v is used; the rest must consist of digits, signs and slashes. */
static bool read_corner(mesh_build *b) {
    input *in = b->in;
    int64_t index = 0;
    if (!input_integer(in, &index) || !(input_at_word_end(in) || *in->at == '/')) {
        return input_error(in, "f: a corner is not an index");
    }
    for (; !input_at_word_end(in); in->at++) {
        if (strchr("0123456789-/", *in->at) == NULL || *in->at == '\0') {
            return input_error(in, "f: a corner is not v, v/vt, v//vn or v/vt/vn");
        }
    }
    int64_t vertex = index > 0 ? index - 1 : b->result.n_vertices + index;
    if (index == 0 || vertex < 0) {
        return input_error(in, "f: index %lld is out of range", (long long)index);
    }
    return mesh_build_corner(b, vertex);
}

static bool read_face(mesh_build *b) {
    while (input_more_in_line(b->in)) {
        if (!read_corner(b)) {
            return false;
        }
    }
    return mesh_build_polygon(b);
}

bool mesh_read_obj(mesh_build *b) {
    input *in = b->in;
    in->comment = '#';
    in->continuation = true;
    int64_t groups = 0, materials = 0, textures = 0, normals = 0;
    while (input_more(in)) {
        char word[4]; /* longer keywords are truncated and match none of the three below */
        input_word(in, word, sizeof word);
        /* fo: a face in files of before 1995 */
        groups += strcmp(word, "g") == 0 || strcmp(word, "o") == 0;
        materials += strcmp(word, "use") == 0; /* usemtl */
        textures += strcmp(word, "vt") == 0;
        normals += strcmp(word, "vn") == 0;
        const bool is_face = strcmp(word, "f") == 0 || strcmp(word, "fo") == 0;
        if (is_face ? !read_face(b) : strcmp(word, "v") == 0 && !read_vertex(b)) {
            return false;
        }
        if (!input_next_line(in)) {
            break;
        }
    }
    if (b->result.n_vertices == 0) {
        in->line = 0;
        return input_error(in, "no vertices: not an OBJ mesh");
    }
    if (groups > 0) {
        mesh_build_leave(b, "%lld group%s", (long long)groups, groups == 1 ? "" : "s");
    }
    if (materials > 0) {
        mesh_build_leave(b, "materials");
    }
    if (textures > 0) {
        mesh_build_leave(b, "texture coordinates");
    }
    if (normals > 0) {
        mesh_build_leave(b, "normals");
    }
    return true;
}
