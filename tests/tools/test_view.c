/* test_view.c: pages for a browser and the tables that they show */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include <math.h>

#include "tools/draw/view_page.h"
#include "tools/io/field_table.h"
#include "tools/io/input.h"
#include "tools/mesh/grid.h"

static const char *table_file(const char *text) {
    return files_put_text("table.csv", text);
}

static void tables_are_read(void **state) {
    (void)state;
    field_table t;
    char message[200];
    const char *text = "vertex,heat,0.25\n2,1.5,-3e-300\n\n0,nan,7\r\n2,2.5,8\n";
    assert_true(field_table_read(&t, table_file(text), 4, message, sizeof message));
    assert_int_equal(t.n_fields, 2);
    assert_string_equal(t.names[0], "heat");
    assert_string_equal(t.names[1], "0.25");
    assert_true(isnan(t.values[0][0]) && t.values[1][0] == 7);
    assert_true(isnan(t.values[0][1]) && isnan(t.values[1][3]));
    assert_true(t.values[0][2] == 2.5 && t.values[1][2] == 8); /* the last row counts */
    field_table_free(&t);
}

static void malformed_tables_are_refused(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"", "table.csv:1: the first line is not vertex,NAME,..."},
        {"vertices,heat\n", "table.csv:1: the first line is not vertex,NAME,..."},
        {"vertex\n0\n", "table.csv:1: there is no column beside vertex"},
        {"vertex,heat\n4,1\n", "table.csv:2: vertex 4 is not one of the 4 vertices of the mesh"},
        {"vertex,heat\n-1,1\n", "table.csv:2: vertex -1 is not one of the 4 vertices of the mesh"},
        {"vertex,heat\n99999999999999,1\n", "table.csv:2: vertex 99999999999999 is not one"},
        {"vertex,heat\n0,1\n1\n", "table.csv:3: a row has no number for column heat"},
        {"vertex,heat\n0,x\n", "table.csv:2: a row has no number for column heat"},
        {"vertex,heat\n0,1,2\n", "table.csv:2: a row has more cells than the first line"},
        {"vertex,heat\nx,1\n", "table.csv:2: a row does not begin with a vertex"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        field_table t;
        char message[400];
        assert_false(field_table_read(&t, table_file(cases[k][0]), 4, message, sizeof message));
        assert_non_null(strstr(message, cases[k][1]));
        assert_int_equal(t.n_fields, 0);
    }
}

/* Columns without rows take memory for each vertex, which the length of the table limits. */
static void wide_tables_are_refused(void **state) {
    (void)state;
    enum { COLUMNS = 1000, VERTICES = 1000000 };
    char *text = (char *)test_array(2 * COLUMNS + 10, 1), message[300];
    field_table t;
    (void)strcpy(text, "vertex");
    for (int k = 0; k < COLUMNS; k++) {
        (void)strcpy(text + 6 + 2 * k, ",a");
    }
    const char *path = table_file(text);
    assert_false(field_table_read(&t, path, VERTICES, message, sizeof message));
    assert_non_null(strstr(message, "a table of 9 columns for 1000000 vertices would take 72 MB"));
    input_most_bytes = 1e8; /* --max-memory 100 */
    assert_false(field_table_read(&t, path, VERTICES, message, sizeof message));
    assert_non_null(strstr(message, "a table of 13 columns"));
    input_most_bytes = 0;
    free(text);
}

/* The bytes of the base64 text after `key`. */
static size_t decode(const char *page, const char *key, unsigned char *bytes) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = strstr(page, key);
    size_t count = 0;
    unsigned word = 0;
    int held = 0;
    assert_non_null(at);
    for (at += strlen(key); *at != '"' && *at != '='; at++) {
        const char *digit = strchr(digits, *at);
        assert_true(digit != NULL && *digit != '\0');
        word = word << 6 | (unsigned)(digit - digits);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes[count++] = (unsigned char)(word >> held & 255);
        }
    }
    return count;
}

static double real_at(const unsigned char *bytes) {
    uint64_t word = 0;
    double x;
    for (int k = 0; k < 8; k++) {
        word |= (uint64_t)bytes[k] << 8 * k;
    }
    memcpy(&x, &word, sizeof x);
    return x;
}

/* Values keep their bits, and no text ends its string or the script. */
static void pages_hold_the_data(void **state) {
    (void)state;
    mesh m;
    unsigned char bytes[1024];
    const double values[6] = {0.1, -1e-300, 7, 1e300, NAN, 0};
    const view_field field = {"a\"b\\</script>\n", values};
    size_t length;
    assert_true(mesh_grid(&m, 3, 2, 0, 1));
    assert_int_equal(m.n_vertices, 6);
    for (int v = 0; v < 6; v++) { /* far away: positions are relative to a center */
        m.xyz[3 * v] += 1e12;
    }
    FILE *file = fopen(files_path("page.html"), "w");
    assert_non_null(file);
    const sl_int marked[2] = {4, 1};
    const view_page what = {&m, "<b>&", {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, marked, 2, &field,
                            1,  NULL};
    view_page_write(file, &what);
    assert_int_equal(fclose(file), 0);
    char *page = files_get(files_path("page.html"), &length);
    page[length] = '\0';
    assert_null(strstr(page, VIEW_PAGE_DATA));
    assert_null(strstr(page, "http:")); /* nothing is loaded */
    assert_null(strstr(page, "https:"));
    assert_null(strstr(page, "src="));
    assert_non_null(strstr(page, "title: \"\\u003cb\\u003e\\u0026\",\n"
                                 "axes: [1, 0, 0, 0, 0, 1, 0, -1, 0],\nmarked: [4, 1],\n"));
    assert_non_null(strstr(page, "{name: \"a\\u0022b\\u005c\\u003c/script\\u003e\\u000a\""));
    assert_int_equal(decode(page, "values: \"", bytes), sizeof values);
    for (int v = 0; v < 6; v++) {
        const double x = real_at(bytes + 8 * v);
        assert_true(v == 4 ? isnan(x) : x == values[v]);
    }
    assert_int_equal(decode(page, "faces: \"", bytes), 12 * m.n_faces);
    for (int k = 0; k < 3 * m.n_faces; k++) {
        assert_int_equal(bytes[4 * k], m.faces[k]);
        assert_int_equal(bytes[4 * k + 1] | bytes[4 * k + 2] | bytes[4 * k + 3], 0);
    }
    assert_int_equal(decode(page, "positions: \"", bytes), 12 * m.n_vertices);
    for (int v = 0; v < 6; v++) {
        float x;
        memcpy(&x, bytes + 12 * v, sizeof x); /* this machine is little-endian, as the page is */
        assert_true(x == (float)(m.xyz[3 * v] - 1e12 - 0.5));
    }
    assert_int_equal(decode(page, "colors: \"", bytes), 768);
    assert_true(bytes[2] > bytes[0] && bytes[765] > bytes[767]); /* from blue to yellow */
    free(page);
    mesh_free(&m);
}

/* A live page has the edges of a triangulation, its own or another one, the script and the kernel,
 * which is empty if the program has none. */
static void live_pages_hold_the_surface(void **state) {
    (void)state;
    mesh m, other;
    unsigned char bytes[1024];
    double lengths[24];
    assert_true(mesh_grid(&m, 3, 2, 0, 1) && mesh_grid(&other, 3, 2, 0, 1));
    assert_int_equal(m.n_faces, 4);
    for (int k = 0; k < 24; k++) {
        lengths[k] = 1 + k / 7.0;
    }
    for (int way = 0; way < 2; way++) {
        const view_live live = {way ? &other : &m, lengths, way ? 0.5 : 1, 0.1};
        view_page what;
        size_t length;
        memset(&what, 0, sizeof what);
        what.m = &m;
        what.title = "m";
        what.live = &live;
        FILE *file = fopen(files_path("page.html"), "w");
        assert_non_null(file);
        view_page_write(file, &what);
        assert_int_equal(fclose(file), 0);
        char *page = files_get(files_path("page.html"), &length);
        page[length] = '\0';
        assert_non_null(
            strstr(page, way ? "live: {time: 0.10000000000000001, share: 0.5, faces: \""
                             : "live: {time: 0.10000000000000001, share: 1, faces: null"));
        assert_int_equal(decode(page, "lengths: \"", bytes), 8 * 3 * m.n_faces);
        for (int k = 0; k < 3 * m.n_faces; k++) {
            assert_true(real_at(bytes + 8 * k) == lengths[k]);
        }
        const char *kernel = strstr(page, "kernel: \"");
        assert_non_null(kernel);
        if (view_live_kernel[0] != NULL) { /* the first bytes of WebAssembly */
            assert_memory_equal(kernel + strlen("kernel: \""), "AGFzbQ", 6);
        }
        assert_non_null(strstr(page, "<script type=\"module\">\n/* sparse_local.js: "));
        assert_non_null(strstr(page, "\n/* view_live.js: "));
        assert_null(strstr(page, VIEW_PAGE_LIVE));
        free(page);
    }
    mesh_free(&other);
    mesh_free(&m);
}

/* The last line of output or of errors of `view` with these words. */
static char *view(const char *words, int *status) {
    char all[1500];
    (void)snprintf(all, sizeof all, "view %s --out %s", words, files_path("page.html"));
    return run_command(command_view, all, status);
}

static void live_pages_are_written(void **state) {
    (void)state;
    int status;
    size_t length;
    char *text = view("torus:12x6 --live --from 3,7", &status);
    if (view_live_kernel[0] == NULL) {
        assert_int_not_equal(status, 0);
        assert_non_null(strstr(text, "make live builds both"));
        free(text);
        return;
    }
    assert_int_equal(status, 0);
    free(text);
    static const char *const cases[][2] = {
        {"torus:12x6 --live --from 3,7", "marked: [3, 7]"},
        {"torus:12x6 --live --laplacian cotangent", "share: 1, faces: null"},
        {"torus:12x6 --live --laplacian intrinsic", "share: 1, faces: \""},
        {"torus:12x6 --live --time 0.5", "time: 0.5, "},
        {"torus:12x6 --live", "marked: [0]"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        free(view(cases[k][0], &status));
        assert_int_equal(status, 0);
        char *page = files_get(files_path("page.html"), &length);
        page[length] = '\0';
        assert_non_null(strstr(page, cases[k][1]));
        free(page);
    }
}

static void times_need_a_live_page(void **state) {
    (void)state;
    static const char *const cases[] = {"--time 1", "--scaled-time 1", "--area-time 1",
                                        "--laplacian cotangent"};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char words[100];
        int status;
        (void)snprintf(words, sizeof words, "torus:12x6 %s", cases[k]);
        char *text = view(words, &status);
        assert_int_not_equal(status, 0);
        assert_non_null(strstr(text, "are for --live"));
        free(text);
    }
}

/* The camera is on the side of the source of the first field, or of the vertices of --from. */
static void pages_open_at_the_source(void **state) {
    (void)state;
    static const struct {
        const char *table, *words, *marked;
        double side; /* of the z axis: the sign of the normal at the source; 0: the default */
    } cases[] = {{"vertex,heat\n0,1\n4,7\n2,3\n", "", "marked: [4]", -1},
                 {"vertex,distance\n0,1\n4,7\n5,0.5\n", "", "marked: [5]", 1},
                 {"vertex,path,heat\n0,1,1\n4,0,1\n5,0.5,1\n", "", "marked: [4]", -1},
                 {"vertex,adf\n0,1\n4,7\n", "", "marked: []", 0},
                 {"vertex,heat\n0,nan\n", "", "marked: []", 0},
                 {"vertex,heat\n0,1\n4,7\n", " --from 5,0,5", "marked: [5, 0]", 1},
                 {"vertex,heat\n4,7\n", " --view 30,20", "marked: [4]", 0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char words[2000];
        int status;
        size_t length;
        double axes[9];
        table_file(cases[k].table);
        /* an octahedron: vertices 4 and 5 are at -z and +z */
        files_put_text("o.off", "OFF\n6 8 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n0 0 -1\n0 0 1\n"
                                "3 0 1 5\n3 1 2 5\n3 2 3 5\n3 3 0 5\n"
                                "3 1 0 4\n3 2 1 4\n3 3 2 4\n3 0 3 4\n");
        char mesh_path[640], table[640];
        (void)snprintf(mesh_path, sizeof mesh_path, "%s", files_path("o.off"));
        (void)snprintf(table, sizeof table, "%s", files_path("table.csv"));
        (void)snprintf(words, sizeof words, "view %s %s --up y%s --out %s", mesh_path, table,
                       cases[k].words, files_path("page.html"));
        free(run_command(command_view, words, &status));
        assert_int_equal(status, 0);
        char *page = files_get(files_path("page.html"), &length);
        page[length] = '\0';
        assert_non_null(strstr(page, cases[k].marked));
        const char *at = strstr(page, "axes: [") + strlen("axes: [");
        for (int d = 0; d < 9; d++) {
            axes[d] = strtod(at, (char **)&at);
            at++;
        }
        if (cases[k].side == 0) {
            assert_true(fabs(axes[7] - sin(20 * acos(-1) / 180)) < 1e-6);
        } else {
            assert_true(axes[8] * cases[k].side > 0.5);
        }
        free(page);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_read),          cmocka_unit_test(malformed_tables_are_refused),
        cmocka_unit_test(wide_tables_are_refused),  cmocka_unit_test(pages_hold_the_data),
        cmocka_unit_test(pages_open_at_the_source), cmocka_unit_test(live_pages_hold_the_surface),
        cmocka_unit_test(live_pages_are_written),   cmocka_unit_test(times_need_a_live_page)};
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
