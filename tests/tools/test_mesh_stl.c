/* test_mesh_stl.c: reads ASCII and binary STL, merges equal corners, refuses bad files */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

#include "tools/mesh/mesh_stats.h"

#define FACET(a, b, c) \
    " facet normal 0 0 nan\n  outer loop\n   vertex " a "\n   vertex " b "\n   vertex " c \
    "\n  endloop\n endfacet\n"
#define V0 "0 0 0"
#define V1 "1 0 0"
#define V2 "1 1 0"
#define V3 "0 1 0"
#define V4 "0.5 .25 -25e-1"

static const char stl_ascii[] = "solid a pyramid\n" FACET(V0, V3, V2) FACET(V0, V2, V1)
    FACET(V0, V1, V4) FACET(V1, V2, V4) FACET(V2, V3, V4) FACET(V3, V0, V4) "endsolid a pyramid\n";

/* The pyramid with its vertices numbered in order of appearance: 0 3 2 1 4. */
static void assert_stl_pyramid(const char *path) {
    static const sl_int old[5] = {0, 3, 2, 1, 4};
    mesh m;
    char message[300];
    if (!mesh_read(&m, path, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    assert_int_equal(m.n_vertices, 5);
    assert_int_equal(m.n_faces, 6);
    for (int v = 0; v < 5; v++) {
        SAME_VALUES(m.xyz + 3 * v, pyramid_xyz + 3 * old[v], 3);
    }
    for (int k = 0; k < 18; k++) {
        assert_int_equal(old[m.faces[k]], pyramid_faces[k]);
    }
    mesh_stats facts;
    assert_true(mesh_stats_compute(&facts, &m));
    assert_true(facts.boundary_edges == 0 && facts.euler == 2);
    mesh_free(&m);
}

static binary_t stl_binary(const char *title, uint32_t count) {
    binary_t b;
    memset(&b, 0, sizeof b);
    put_text(&b, title);
    b.length = 80;
    put_bits(&b, count, 4);
    for (int f = 0; f < 6; f++) {
        put_float(&b, (double)NAN);
        put_bits(&b, 0, 8);
        for (int c = 0; c < 3; c++) {
            for (int d = 0; d < 3; d++) {
                double x = pyramid_xyz[3 * pyramid_faces[3 * f + c] + d];
                put_float(&b, x == 0 && f % 2 ? -0.0 : x); /* both zeros are the same point */
            }
        }
        put_bits(&b, 0xFFFF, 2);
    }
    return b;
}

static void both_formats_are_read(void **state) {
    (void)state;
    assert_stl_pyramid(files_put_text("a.stl", stl_ascii));
    assert_stl_pyramid(files_put_gz("a.stl.gz", stl_ascii, strlen(stl_ascii)));
    binary_t b = stl_binary("made by hand", 6), solid = stl_binary("solid but binary", 6);
    assert_stl_pyramid(files_put("b.STL", b.bytes, b.length));
    assert_stl_pyramid(files_put("c.stl", solid.bytes, solid.length));
    assert_stl_pyramid(files_put_gz("c.stl.gz", solid.bytes, solid.length));
}

/* Bytes behind the last triangle are ignored and noted, also if the header begins like text. */
static void trailing_bytes_are_noted(void **state) {
    (void)state;
    static const char *const titles[3] = {"made by hand", "solid but binary", "solid"};
    for (int k = 0; k < 3; k++) {
        binary_t b = stl_binary(titles[k], 6);
        char message[300], note[300];
        mesh m;
        put_text(&b, "\n\r\n");
        const char *path = files_put("t.stl", b.bytes, b.length);
        assert_stl_pyramid(path);
        assert_true(mesh_read_noting(&m, path, message, sizeof message, note, sizeof note));
        assert_non_null(strstr(note, "t.stl: 3 bytes follow the last of 6 triangles"));
        mesh_free(&m);
        b = stl_binary(titles[k], 7);
        assert_is_refused(files_put("t.stl", b.bytes, b.length),
                          "binary STL of 7 triangles: 384 bytes");
        b = stl_binary(titles[k], 0);
        assert_is_refused(files_put("t.stl", b.bytes, b.length), "binary STL of 0 triangles");
    }
}

static void ascii_variants_are_read(void **state) {
    (void)state;
    assert_stl_pyramid(files_put_text(
        "loose.stl",
        "\n\n" /* then two solids, capitals, vertices on one line */
        "solid\n" FACET(V0, V3, V2)
            FACET(V0, V2, V1) "endsolid\n\nSOLID two\r\n"
                              "FACET NORMAL 0 0 1\nOUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX " V4
                              " ENDLOOP ENDFACET\n" FACET(V1, V2, V4) FACET(V2, V3, V4)
                                  FACET(V3, V0, V4) "endsolid two"));
    mesh m;
    assert_true(mesh_read(&m, files_put_text("none.stl", "solid\nendsolid\n"), NULL, 0));
    assert_int_equal(m.n_faces, 0);
    mesh_free(&m);
}

static void bad_files_are_refused(void **state) {
    (void)state;
    assert_is_refused(files_put_text("a.stl", ""), "too short");
    assert_is_refused(files_put_text("b.stl", "hello"), "too short");
    assert_is_refused(files_put_text("c.stl", "solid\n vertex 0 0\n"),
                      ":2: vertex: three numbers expected");
    assert_is_refused(files_put_text("d.stl", "solid\nvertex 0 0 0\nendloop\nendsolid"),
                      ":3: a facet must have 3 vertices, not 1");
    assert_is_refused(files_put_text("e.stl", "solid\n" FACET(V0, V1, V2)), "without endsolid");
    assert_is_refused(files_put_text("f.stl", "solid\nvertex 0 0 inf\nendsolid"), ":2: vertex 0");
    assert_is_refused(files_put_text("g.stl", "solid\nhello\nendsolid"),
                      ":2: 'hello' is not an STL keyword");
    assert_is_refused(files_put_text("h.stl", "solid\nsolid\n"), ":2: unexpected solid");
    assert_is_refused(files_put_text("i.stl", "solid\nendsolid\nvertex 0 0 0"),
                      ":3: 'vertex' outside a solid");
    assert_is_refused(files_put_text("j.stl", "solid\nvertex 0 0 0\nfacet\n"),
                      ":3: 'facet' inside a loop");
    binary_t b = stl_binary("x", 7), whole = stl_binary("x", 6);
    assert_is_refused(files_put("k.stl", b.bytes, b.length),
                      "binary STL of 7 triangles: 384 bytes");
    b = stl_binary("x", 0xFFFFFFFFu);
    assert_is_refused(files_put("l.stl", b.bytes, b.length), "binary STL of 4294967295 triangles");
    for (int k = 0; k < 4; k++) {
        whole.bytes[84 + 12 + k] = (char)0xFF;
    }
    assert_is_refused(files_put("m.stl", whole.bytes, whole.length), "not finite");
}

static void damaged_files_are_refused_or_read(void **state) {
    (void)state;
    binary_t b = stl_binary("x", 6);
    for (size_t length = 0; length < b.length; length++) {
        assert_false(read_is_valid(files_put("cut.stl", b.bytes, length)));
    }
    size_t whole = strlen(stl_ascii);
    for (size_t length = 0; length + sizeof " a pyramid" < whole; length++) {
        assert_false(read_is_valid(files_put("cut.stl", stl_ascii, length)));
    }
    uint64_t seed = 5;
    for (int round = 0; round < 2000; round++) {
        char text[sizeof stl_ascii];
        binary_t damaged = b;
        memcpy(text, stl_ascii, sizeof text);
        for (int k = 0; k < 3; k++) {
            text[files_random(&seed) % whole] = (char)(files_random(&seed) % 128);
            damaged.bytes[files_random(&seed) % b.length] = (char)(files_random(&seed) % 256);
        }
        (void)read_is_valid(files_put("damaged.stl", text, whole));
        (void)read_is_valid(files_put("damaged.stl", damaged.bytes, b.length));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_formats_are_read),
        cmocka_unit_test(trailing_bytes_are_noted),
        cmocka_unit_test(ascii_variants_are_read),
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(damaged_files_are_refused_or_read),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
