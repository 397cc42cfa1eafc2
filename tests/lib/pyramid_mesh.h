/* pyramid_mesh.h: one small mesh in every file format, and checks of what a mesh reader returns */
#ifndef SL_TEST_PYRAMID_MESH_H
#define SL_TEST_PYRAMID_MESH_H

/* The program defines _POSIX_C_SOURCE 200809L before its first include. */
#include "temporary_files.h"

#include "tools/mesh/mesh.h"

/* A pyramid over a square: 5 vertices, one quadrilateral and four triangles; 6 triangles after the
 * quadrilateral is split into a fan. */
static const double pyramid_xyz[15] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.25, -2.5};
static const sl_int pyramid_faces[18] = {0, 3, 2, 0, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};

static inline void assert_is_pyramid(const char *path) {
    mesh m;
    char message[300];
    if (!mesh_read(&m, path, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    assert_string_equal(message, "");
    assert_int_equal(m.n_vertices, 5);
    assert_int_equal(m.n_faces, 6);
    SAME_VALUES(m.xyz, pyramid_xyz, 15);
    assert_memory_equal(m.faces, pyramid_faces, sizeof pyramid_faces);
    mesh_free(&m);
    assert_null(m.xyz);
    mesh_free(&m);
}

/* The file is refused, the mesh is empty, and the message begins with the path and contains
 * `words`. */
static inline void assert_is_refused(const char *path, const char *words) {
    mesh m;
    char message[300] = "";
    assert_false(mesh_read(&m, path, message, sizeof message));
    assert_null(m.xyz);
    assert_null(m.faces);
    assert_int_equal(m.n_vertices, 0);
    assert_int_equal(m.n_faces, 0);
    if (strncmp(message, path, strlen(path)) != 0 || strstr(message, words) == NULL) {
        print_error("%s\n    lacks: %s\n", message, words);
        fail();
    }
    assert_false(mesh_read(&m, path, NULL, 0));
}

/* Returns whether the file was read. Either way the mesh is valid: every index in range, every
 * coordinate finite, and a message if and only if it was refused. */
static inline bool read_is_valid(const char *path) {
    mesh m;
    char message[300];
    bool ok = mesh_read(&m, path, message, sizeof message);
    assert_true(ok == (message[0] == '\0'));
    assert_true(ok || (m.xyz == NULL && m.faces == NULL));
    for (sl_int k = 0; k < 3 * m.n_faces; k++) {
        assert_true(m.faces[k] >= 0 && m.faces[k] < m.n_vertices);
    }
    for (sl_int k = 0; k < 3 * m.n_vertices; k++) {
        assert_true(isfinite(m.xyz[k]));
    }
    mesh_free(&m);
    return ok;
}

/* ---- text formats ---- */

#define OBJ_VERTICES "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 2.5e-1 -2.5\n"

static const char obj_plain[] = OBJ_VERTICES "f 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

#define OFF_VERTICES "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.25 -2.5\n"
#define OFF_FACES "4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"

#define OFF_TEXT "OFF\n5 5 0\n" OFF_VERTICES OFF_FACES

#define PLY_ASCII_HEADER "ply\nformat ascii 1.0\ncomment a pyramid\n"
#define PLY_FACE "element face 5\nproperty list uchar int vertex_indices\nend_header\n"

static const char ply_ascii[] = PLY_ASCII_HEADER
    "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n" PLY_FACE OFF_VERTICES
        OFF_FACES;

/* ---- binary formats ---- */

/* A binary file in memory, in either byte order. */
typedef struct binary_t {
    char bytes[2048];
    size_t length;
    bool big_endian;
} binary_t;

static inline void put_text(binary_t *b, const char *text) {
    memcpy(b->bytes + b->length, text, strlen(text));
    b->length += strlen(text);
}

static inline void put_bits(binary_t *b, uint64_t bits, int bytes) {
    for (int k = 0; k < bytes; k++) {
        int shift = 8 * (b->big_endian ? bytes - 1 - k : k);
        b->bytes[b->length++] = (char)(unsigned char)(bits >> shift & 0xFF);
    }
}

static inline void put_float(binary_t *b, double x) {
    float single = (float)x;
    uint32_t bits;
    memcpy(&bits, &single, sizeof bits);
    put_bits(b, bits, 4);
}

static inline void put_double(binary_t *b, double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    put_bits(b, bits, 8);
}

/* The pyramid with coordinates of different types, corner indices of one type, and unknown elements
 * and properties before and after them. */
static inline binary_t binary_pyramid(bool big_endian, const char *corner_type, int corner_bytes,
                                      const char *line_end) {
    binary_t b;
    memset(&b, 0, sizeof b);
    b.big_endian = big_endian;
    char header[800];
    (void)snprintf(header, sizeof header,
                   "ply%sformat binary_%s_endian 1.0%selement vertex 5%sproperty double "
                   "z%sproperty list short char c%s"
                   "property float y%sproperty float x%selement face 5%sproperty uint id%sproperty "
                   "list ushort %s "
                   "vertex_indices%selement tail 2%sproperty char t%send_header%s",
                   line_end, big_endian ? "big" : "little", line_end, line_end, line_end, line_end,
                   line_end, line_end, line_end, line_end, corner_type, line_end, line_end,
                   line_end, line_end);
    put_text(&b, header);
    for (int v = 0; v < 5; v++) {
        put_double(&b, pyramid_xyz[3 * v + 2]);
        put_bits(&b, (uint64_t)(v % 3), 2);
        put_bits(&b, 0x0A0D0A, v % 3);
        put_float(&b, pyramid_xyz[3 * v + 1]);
        put_float(&b, pyramid_xyz[3 * v]);
    }
    static const int quad_and_triangles[5][5] = {
        {4, 0, 3, 2, 1}, {3, 0, 1, 4}, {3, 1, 2, 4}, {3, 2, 3, 4}, {3, 3, 0, 4}};
    for (int f = 0; f < 5; f++) {
        put_bits(&b, 0x0A0A0A0A, 4);
        put_bits(&b, (uint64_t)quad_and_triangles[f][0], 2);
        for (int k = 1; k <= quad_and_triangles[f][0]; k++) {
            put_bits(&b, (uint64_t)quad_and_triangles[f][k], corner_bytes);
        }
    }
    put_bits(&b, 7, 1);
    put_bits(&b, 7, 1);
    return b;
}

#endif
