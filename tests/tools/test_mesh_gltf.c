/* test_mesh_gltf.c: glTF files: containers, text, buffers, nodes, kinds of triangles, refusals */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/pyramid_mesh.h"

#define GLTF_START "{\"asset\":{\"version\":\"2.0\"}"

/* The bytes of the pyramid: 15 floats, then 18 corners of 16 bits. */
static binary_t pyramid_bytes(void) {
    binary_t b;
    memset(&b, 0, sizeof b);
    for (int k = 0; k < 15; k++) {
        put_float(&b, pyramid_xyz[k]);
    }
    for (int k = 0; k < 18; k++) {
        put_bits(&b, (uint64_t)pyramid_faces[k], 2);
    }
    return b;
}

#define VIEWS \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60},{\"buffer\":0,\"byteOffset\":60," \
    "\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"count\":5,\"componentType\":5126," \
    "\"type\":\"VEC3\"},{\"bufferView\":1,\"count\":18,\"componentType\":5123,\"type\":" \
    "\"SCALAR\"}]"
#define MESHES "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]"
#define NODES "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]"
#define BUFFER "\"buffers\":[{\"byteLength\":96,\"uri\":\"bytes%20of.bin\"}]"
#define DOCUMENT GLTF_START "," MESHES "," NODES "," VIEWS "," BUFFER "}"

/* A container with this document and the bytes of the pyramid. */
static binary_t container_of(const char *document) {
    const binary_t bytes = pyramid_bytes();
    const size_t length = (strlen(document) + 3) / 4 * 4;
    binary_t b;
    memset(&b, 0, sizeof b);
    put_text(&b, "glTF");
    put_bits(&b, 2, 4);
    put_bits(&b, 28 + length + bytes.length, 4);
    put_bits(&b, length, 4);
    put_text(&b, "JSON");
    put_text(&b, document);
    while (b.length < 20 + length) {
        put_text(&b, " ");
    }
    put_bits(&b, bytes.length, 4);
    put_text(&b, "BIN");
    put_bits(&b, 0, 1);
    memcpy(b.bytes + b.length, bytes.bytes, bytes.length);
    b.length += bytes.length;
    return b;
}

#define IN_CONTAINER(more) GLTF_START "," VIEWS ",\"buffers\":[{\"byteLength\":96}]" more "}"

static const char *put_container(const char *name, const char *document) {
    const binary_t b = container_of(document);
    return files_put(name, b.bytes, b.length);
}

static void containers_and_files_are_read(void **state) {
    (void)state;
    const binary_t bytes = pyramid_bytes();
    const char *path = put_container("a.glb", IN_CONTAINER("," MESHES "," NODES));
    size_t length;
    assert_is_pyramid(path);
    assert_is_pyramid(put_container("a.glb", IN_CONTAINER("," MESHES))); /* without nodes */
    assert_is_pyramid(
        put_container("a.gltf", IN_CONTAINER("," MESHES ",\"nodes\":[{\"mesh\":0}]")));
    char *whole = files_get(put_container("a.glb", IN_CONTAINER("," MESHES)), &length);
    for (size_t cut = 0; cut < length; cut++) {
        assert_false(read_is_valid(files_put("cut.glb", whole, cut)));
    }
    assert_is_pyramid(files_put_gz("a.glb.gz", whole, length));
    free(whole);
    assert_is_refused(files_put_text("b.gltf", DOCUMENT), "bytes of.bin: cannot be opened");
    (void)files_put("bytes of.bin", bytes.bytes, bytes.length);
    assert_is_pyramid(files_put_text("b.gltf", DOCUMENT));
    for (length = 0; length + 1 < sizeof DOCUMENT; length++) {
        assert_false(read_is_valid(files_put("cut.gltf", DOCUMENT, length)));
    }
    (void)files_put("bytes of.bin", bytes.bytes, bytes.length - 1);
    assert_is_refused(files_put_text("b.gltf", DOCUMENT), "buffer 0: truncated, 95 bytes of 96");
}

/* Nodes place meshes by matrices or by translation, rotation and scale; a reflection turns faces
 * over; the same mesh may be used twice. */
static void nodes_place_meshes(void **state) {
    (void)state;
    mesh m;
    assert_true(mesh_read(
        &m,
        put_container("n.glb",
                      IN_CONTAINER("," MESHES
                                   ",\"scene\":1,\"scenes\":[{},{\"nodes\":[2,0]}],\"nodes\":["
                                   "{\"mesh\":0,\"scale\":[-1,1,1]},{\"mesh\":0,\"matrix\":"
                                   "[0,2,0,0, -2,0,0,0, 0,0,2,0, 10,20,30,1]},"
                                   "{\"children\":[1],\"translation\":[1,0,0],"
                                   "\"rotation\":[0,0,0.70710678118654752,0.70710678118654752]}]")),
        NULL, 0));
    assert_true(m.n_vertices == 10 && m.n_faces == 12);
    for (int v = 0; v < 5; v++) {
        const double *x = pyramid_xyz + 3 * v, *y = m.xyz + 3 * v, *z = m.xyz + 15 + 3 * v;
        /* inner node: (10 - 2 x_1, 20 + 2 x_0, 30 + 2 x_2); outer one: (1 - y_1, y_0, y_2) */
        assert_true(fabs(y[0] - (1 - (20 + 2 * x[0]))) < 1e-12);
        assert_true(fabs(y[1] - (10 - 2 * x[1])) < 1e-12 && y[2] == 30 + 2 * x[2]);
        assert_true(z[0] == -x[0] && z[1] == x[1] && z[2] == x[2]);
    }
    for (int f = 0; f < 6; f++) {
        const sl_int *given = pyramid_faces + 3 * f, *over = m.faces + 18 + 3 * f;
        assert_memory_equal(m.faces + 3 * f, given, 3 * sizeof *given);
        assert_true(over[0] == given[0] + 5 && over[1] == given[2] + 5 && over[2] == given[1] + 5);
    }
    mesh_free(&m);
}

/* Strips, fans and triangles without indices; points are ignored with a note; vertices with equal
 * coordinates are merged with a note. */
static void kinds_of_primitives_are_read(void **state) {
    (void)state;
    static const sl_int expected[2][9] = {{0, 1, 2, 1, 3, 2, 2, 3, 4}, {0, 1, 2, 0, 2, 3, 0, 3, 4}};
    mesh m;
    char document[900], message[300], note[300];
    for (int k = 0; k < 2; k++) {
        (void)snprintf(
            document, sizeof document,
            IN_CONTAINER(",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                         "\"mode\":%d},{\"mode\":0,\"attributes\":{\"POSITION\":0}}]}]"),
            5 + k);
        const char *path = put_container("k.glb", document);
        assert_true(mesh_read_noting(&m, path, message, sizeof message, note, sizeof note));
        assert_non_null(strstr(note, "1 primitives are points or lines"));
        assert_true(m.n_vertices == 5 && m.n_faces == 3);
        assert_memory_equal(m.faces, expected[k], sizeof expected[k]);
        mesh_free(&m);
    }
    /* two primitives with positions of their own, which coincide */
    const char *twice =
        GLTF_START ",\"buffers\":[{\"byteLength\":96}],\"bufferViews\":[{\"buffer\":0,"
                   "\"byteLength\":60,\"byteStride\":12}],\"accessors\":[{\"bufferView\":0,"
                   "\"count\":3,\"componentType\":5126,\"type\":\"VEC3\"},{\"bufferView\":0,"
                   "\"byteOffset\":12,\"count\":3,\"componentType\":5126,\"type\":\"VEC3\"}],"
                   "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}},"
                   "{\"attributes\":{\"POSITION\":1}}]}]}";
    const sl_int merged[6] = {0, 1, 2, 1, 2, 3};
    const char *path = put_container("t.glb", twice);
    assert_true(mesh_read_noting(&m, path, message, sizeof message, note, sizeof note));
    assert_non_null(strstr(note, "t.glb: 2 vertices had the coordinates of others"));
    assert_true(m.n_vertices == 4 && m.n_faces == 2);
    assert_memory_equal(m.faces, merged, sizeof merged);
    mesh_free(&m);
}

/* Integers as positions (KHR_mesh_quantization). */
static void quantized_positions_are_read(void **state) {
    (void)state;
    mesh m;
    const char *path = files_put_text(
        "q.gltf", GLTF_START
        ",\"extensionsRequired\":[\"KHR_mesh_quantization\",\"KHR_materials_unlit\"],"
        "\"buffers\":[{\"byteLength\":12,\"uri\":\"data:;base64,AAB/AIEAAACAAAAA\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":12}],\"accessors\":[{\"bufferView\":0,"
        "\"count\":3,\"componentType\":5120,\"type\":\"VEC3\",\"normalized\":true}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]}");
    const double expected[9] = {0, 0, 1, 0, -1, 0, 0, 0, -1}; /* -128 stands for -1, too */
    char message[300];
    assert_true(mesh_read(&m, path, message, sizeof message));
    assert_true(m.n_faces == 1 && m.n_vertices == 3);
    SAME_VALUES(m.xyz, expected, 9);
    mesh_free(&m);
}

#define SCENE(nodes, scene) \
    IN_CONTAINER("," MESHES ",\"nodes\":[" nodes "],\"scenes\":[{\"nodes\":[" scene "]}]")
#define ACCESSOR(text) \
    GLTF_START "," MESHES ",\"buffers\":[{\"byteLength\":96}],\"bufferViews\":[{\"buffer\":0," \
               "\"byteLength\":90,\"byteOffset\":6}],\"accessors\":[" text "]}"
#define POSITIONS(count) \
    "{\"bufferView\":0,\"count\":" count ",\"componentType\":5126,\"type\":\"VEC3\"}"
#define TEXT(more) GLTF_START more "}"

/* A sparse accessor without a bufferView, and the same with one. Indices are 16-bit numbers in the
 * corners of the pyramid: 0, 3, 2, 0, 2, 1, ... */
#define SPARSE_OF(view, count, replaced, indices, values) \
    IN_CONTAINER_OF("{" view "\"count\":" count ",\"componentType\":5126,\"type\":\"VEC3\"," \
                    "\"sparse\":{\"count\":" replaced ",\"indices\":{" indices \
                    "},\"values\":{" values "}}}")
#define IN_CONTAINER_OF(accessor) \
    GLTF_START ",\"buffers\":[{\"byteLength\":96}],\"bufferViews\":[{\"buffer\":0," \
               "\"byteLength\":60},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":36}]," \
               "\"accessors\":[" accessor "],\"meshes\":[{\"primitives\":[{\"attributes\":" \
               "{\"POSITION\":0}}]}]}"
#define SPARSE(count, replaced, indices, values) SPARSE_OF("", count, replaced, indices, values)
#define INDICES "\"bufferView\":1,\"componentType\":5123"
#define VALUES "\"bufferView\":0,\"byteOffset\":12"

static void sparse_accessors_are_read(void **state) {
    (void)state;
    /* zeros, of which row 2 becomes vertex 1 of the pyramid, and row 0 vertex 2 */
    const double of_zeros[9] = {1, 1, 0, 0, 0, 0, 1, 0, 0};
    const double of_rows[9] = {1, 0, 0, 1, 0, 0, 1, 1, 0};
    mesh m;
    const char *zeros =
        SPARSE("3", "2", "\"bufferView\":1,\"byteOffset\":4,\"componentType\":5123", VALUES);
    const char *rows = SPARSE_OF("\"bufferView\":0,", "3", "1", INDICES, VALUES);
    assert_true(mesh_read(&m, put_container("s.glb", zeros), NULL, 0));
    assert_true(m.n_vertices == 3 && m.n_faces == 1);
    SAME_VALUES(m.xyz, of_zeros, 9);
    mesh_free(&m);
    assert_true(mesh_read(&m, put_container("s.glb", rows), NULL, 0));
    assert_true(m.n_vertices == 2 && m.n_faces == 1); /* equal vertices are merged */
    SAME_VALUES(m.xyz, of_rows + 3, 6);
    mesh_free(&m);
}

static void bad_files_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *document, *words;
    } bad[] = {
        {"{", "not a JSON document"},
        {"[]", "not a JSON document"},
        {"{\"asset\":{\"version\":\"1.0\"}}", "not glTF 2: asset.version is '1.0'"},
        {"{\"asset\":{}}", "not glTF 2"},
        {TEXT(",\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]"), "KHR_draco"},
        {TEXT(",\"nodes\":{}"), "nodes is not an array"},
        {TEXT(",\"nodes\":[1]"), "an element is not an object"},
        {SCENE("{\"mesh\":1}", "0"), "node 0: mesh is not an integer below 1"},
        {SCENE("{\"mesh\":0.5}", "0"), "node 0: mesh is not an integer"},
        {SCENE("{\"mesh\":0}", "1"), "is not a node"},
        {SCENE("{\"mesh\":0}", "0,0"), "node 0 is used twice"},
        {SCENE("{\"children\":[1]},{\"children\":[0]}", "0"), "node 0 is used twice"},
        {SCENE("{\"children\":{}}", "0"), "children are not an array"},
        {SCENE("{\"mesh\":0,\"scale\":[1,1]}", "0"), "scale is not an array of 3 numbers"},
        {SCENE("{\"mesh\":0,\"scale\":[1,1,1e999]}", "0"), "scale is not an array of 3 numbers"},
        {SCENE("{\"mesh\":0,\"matrix\":3}", "0"), "matrix is not an array of 16 numbers"},
        {SCENE("{\"mesh\":0,\"scale\":[1e308,1e308,1e308],\"children\":[1]},"
               "{\"mesh\":0,\"scale\":[1e308,1e308,1e308]}",
               "0"),
         "not finite"},
        {TEXT("," MESHES), "is not an integer below 0"},
        {IN_CONTAINER(",\"meshes\":[{\"primitives\":[{\"mode\":7}]}]"), "mode is not an integer"},
        {IN_CONTAINER(",\"meshes\":[{\"primitives\":3}]"), "primitives is not an array"},
        {IN_CONTAINER(",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":1}}]}]"),
         "positions are not VEC3"},
        {IN_CONTAINER(
             ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":0}"
             "]}]"),
         "indices are not integers"},
        {IN_CONTAINER(",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"),
         "triangles has 5 corners"},
        {ACCESSOR(POSITIONS("8") "," POSITIONS("3")), "accessor 0: ends beyond its bufferView"},
        {ACCESSOR(POSITIONS("2000000000") "," POSITIONS("3")), "accessor 0: ends beyond"},
        {ACCESSOR(POSITIONS("-1") "," POSITIONS("3")), "accessor 0: count is not an integer"},
        {ACCESSOR("{\"count\":3,\"componentType\":5126,\"type\":\"VEC3\"},{}"),
         "accessor 0 has neither bufferView nor sparse"},
        {SPARSE("3", "1", "\"bufferView\":1,\"byteOffset\":2,\"componentType\":5123", VALUES),
         "sparse index 3 is not a row of accessor 0"},
        {SPARSE("3", "4", INDICES, VALUES),
         "sparse of accessor 0: count is not an integer below 4"},
        {SPARSE("3", "1", "\"bufferView\":1,\"componentType\":5126", VALUES),
         "accessor 0: sparse has no valid count and componentType"},
        {SPARSE("3", "1", "\"bufferView\":1", VALUES), "no valid count and componentType"},
        {SPARSE("3", "1", INDICES, "\"a\":1"), "no bufferView for indices or values"},
        {SPARSE("3", "1", "\"componentType\":5123", VALUES), "no bufferView for indices or values"},
        {SPARSE("3", "1", INDICES, "\"bufferView\":0,\"byteOffset\":49"),
         "sparse values of accessor 0: ends beyond its bufferView"},
        {SPARSE("3", "1", "\"bufferView\":1,\"byteOffset\":35,\"componentType\":5123", VALUES),
         "sparse indices of accessor 0: ends beyond its bufferView"},
        {SPARSE("20000", "1", INDICES, VALUES), "more than 256 bytes for each byte of the file"},
        {ACCESSOR("{\"bufferView\":0,\"count\":3,\"componentType\":5124,\"type\":\"VEC3\"},{}"),
         "no valid count, type and componentType"},
        {ACCESSOR("{\"bufferView\":0,\"count\":3,\"componentType\":5126,\"type\":\"MAT4\"},{}"),
         "no valid count, type and componentType"},
        {ACCESSOR(POSITIONS("3") ",{\"bufferView\":0,\"count\":3,\"componentType\":5121,\"type\":"
                                 "\"SCALAR\",\"byteOffset\":7}"),
         "out of range: the primitive has "
         "3 vertices"},
        {TEXT(",\"buffers\":[{}],\"bufferViews\":[{\"buffer\":0}],\"accessors\":[" POSITIONS(
             "3") "],"
                  "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"),
         "has no buffer or no byteLength"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        assert_is_refused(put_container("bad.glb", bad[k].document), bad[k].words);
    }
    binary_t b = container_of("{}");
    b.bytes[4] = 1;
    assert_is_refused(files_put("bad.glb", b.bytes, b.length), "version other than 2");
    b.bytes[4] = 2;
    b.bytes[12] = 127;
    assert_is_refused(files_put("bad.glb", b.bytes, b.length), "chunk 0 ends beyond the file");
}

/* Buffers come from the folder of the document only. */
static void foreign_buffers_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *uri, *words;
    } bad[] = {{"/etc/hostname", "not a file in the same folder"},
               {"../x.bin", "not a file in the same folder"},
               {"%2e%2e/x.bin", "not a file in the same folder"},
               {"%2Fetc/hostname", "not a file in the same folder"},
               {"http://x/y.bin", "not a file in the same folder"},
               {"%00", "not a file in the same folder"},
               {"%zz", "not a file in the same folder"},
               {"", "not a file in the same folder"},
               {"none.bin", "none.bin: cannot be opened"},
               {"data:text/plain,abc", "data URI without base64"},
               {"data:;base64,AA*A", "not base64"},
               {"data:;base64,AAAA", "truncated, 3 bytes of 96"}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        char document[1200];
        (void)snprintf(document, sizeof document,
                       GLTF_START "," MESHES "," VIEWS ",\"buffers\":[{\"byteLength\":96,\"uri\":"
                                  "\"%s\"}]}",
                       bad[k].uri);
        assert_is_refused(files_put_text("bad.gltf", document), bad[k].words);
    }
}

/* Nodes that repeat a mesh too often are refused before memory runs out. */
static void repetitions_are_limited(void **state) {
    (void)state;
    enum { NODES_TOO_MANY = 6000 };
    const size_t room = 64 + (size_t)NODES_TOO_MANY * 24;
    char *text = (char *)test_array(room + 40000, 1), *at = text;
    at += sprintf(at, GLTF_START ",\"nodes\":[{\"mesh\":0}");
    for (int k = 1; k < NODES_TOO_MANY; k++) {
        at += sprintf(at, ",{\"mesh\":0}");
    }
    at += sprintf(at, "],\"buffers\":[{\"byteLength\":22500,\"uri\":\"data:;base64,");
    memset(at, 'A', 30000);
    at += 30000;
    (void)sprintf(at,
                  "\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":22500,\"byteStride\":12}],"
                  "\"accessors\":[{\"bufferView\":0,\"count\":1875,\"componentType\":5126,"
                  "\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":"
                  "{\"POSITION\":0}}],\"name\":\"x\"}],\"asset2\":0}");
    /* merged, each has one vertex: kept apart by the name of the maker */
    char *maker = strstr(text, "\"version\"");
    assert_non_null(maker);
    memmove(maker + 27, maker, strlen(maker) + 1);
    memcpy(maker, "\"generator\":\"sparse-local\",", 27);
    assert_is_refused(files_put_text("many.gltf", text), "more than 64 elements for each byte");
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(containers_and_files_are_read),
        cmocka_unit_test(nodes_place_meshes),
        cmocka_unit_test(kinds_of_primitives_are_read),
        cmocka_unit_test(quantized_positions_are_read),
        cmocka_unit_test(sparse_accessors_are_read),
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(foreign_buffers_are_refused),
        cmocka_unit_test(repetitions_are_limited),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
