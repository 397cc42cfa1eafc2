/* test_layout_commands.c: the commands unwrap and geodesic: files, output, refusals */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tools/mesh/mesh.h"

/* Replaces each @ in words by the folder of temporary files. */
static const char *expand_paths(const char *words) {
    static char text[1024];
    size_t used = 0;
    for (; *words != '\0' && used + FILE_PATH_SIZE < sizeof text; words++) {
        if (*words == '@') {
            used += (size_t)snprintf(text + used, sizeof text - used, "%s/", files_folder);
        } else {
            text[used++] = *words;
        }
    }
    text[used] = '\0';
    return text;
}

static char *output_of(int (*command)(int argc, char **argv), const char *words) {
    int status;
    char *output = run_command(command, expand_paths(words), &status);
    assert_int_equal(status, 0);
    return output;
}

static int lines_starting_with(const char *text, const char *with) {
    int count = 0;
    for (const char *at = text; at != NULL; at = strchr(at, '\n')) {
        at += *at == '\n';
        count += strncmp(at, with, strlen(with)) == 0;
    }
    return count;
}

/* Checks the size of a picture and that enough of its pixels are drawn. */
static void assert_picture(const char *name, int width, int height) {
    size_t length;
    int w = 0, h = 0;
    unsigned long drawn = 0;
    char *text = files_get(files_path(name), &length);
    assert_int_equal(sscanf(text, "%d %d %lu", &w, &h, &drawn), 3);
    assert_true(w == width && h == height && drawn > (unsigned long)(width * height / 20));
    free(text);
}

/* A closed surface: texture coordinates at each corner, the mesh as it is, and pictures. */
static void unwrap_writes_texture_coordinates(void **state) {
    (void)state;
    size_t length;
    mesh m;
    char message[300];
    char *output =
        output_of(command_unwrap, "unwrap --csv @a.csv --out @a.obj --png @a.png --layout @b.png "
                                  "--close @c.png --size 200x150 sphere:3");
    assert_true(number_after(output, "surface    ") == 1280);
    assert_true(number_after(output, "faces      ") == 0);
    assert_true(number_after(strstr(output, "layout  "), "energy ") < 4.6);
    assert_non_null(strstr(output, "result     good: "));
    free(output);
    char *text = files_get(files_path("a.obj"), &length);
    assert_int_equal(lines_starting_with(text, "vt "), 3 * 1280);
    const char *at = strstr(text, "vt ");
    /* All coordinates are in the unit square. */
    for (int k = 0; k < 3 * 1280; k++) {
        double u = -1, v = -1;
        assert_int_equal(sscanf(at, "vt %lf %lf", &u, &v), 2);
        assert_true(u >= 0 && u <= 1 && v >= 0 && v <= 1);
        at = strstr(at + 1, "vt ");
    }
    free(text);
    assert_true(mesh_read(&m, files_path("a.obj"), message, sizeof message));
    assert_true(m.n_vertices == 642 && m.n_faces == 1280);
    mesh_free(&m);
    text = files_get(files_path("a.csv"), &length);
    assert_true(lines_starting_with(text, "") > 1 + 642 + 1); /* vertices of the cut twice */
    free(text);
    assert_picture("a.png", 200, 150);
    assert_picture("b.png", 200, 150);
    assert_picture("c.png", 200, 150);
}

/* All methods end, on disks, closed surfaces and patches, and say how good the layout is. */
static void every_method_reports(void **state) {
    (void)state;
    static const char *const methods[] = {"slim", "arap", "scp", "lscm", "harmonic", "tutte"};
    static const char *const surfaces[] = {"hills:20x20", "torus:30x12",
                                           "star:4 --center 100 --patch 300"};
    for (int k = 0; k < 18; k++) {
        char line[200];
        (void)snprintf(line, sizeof line, "unwrap %s --method %s", surfaces[k / 6], methods[k % 6]);
        char *output = output_of(command_unwrap, line);
        assert_non_null(strstr(output, "result     "));
        if (k % 6 == 0 || k % 6 == 5) {
            assert_true(number_after(output, "faces      ") == 0);
        }
        free(output);
    }
    /* a disk with holes stays as it is unless cuts lower the energy */
    command_says(command_unwrap, "unwrap star:3 --list 6-641", 0, "cut along 0 edges");
    command_says(command_unwrap, "unwrap star:3 --list 12-641", 0, "cut along 8 edges");
    command_says(command_unwrap, "unwrap hills:30x30 --iterations 1", 1, "have not converged");
    command_says(command_unwrap, "unwrap torus:30x12 --method tutte", 0, "cut along 4");
    command_says(command_unwrap, "unwrap star:5 --method harmonic", 0, "result     ");
}

/* Pins stay where they are, exactly with lscm. */
static void pins_hold_vertices(void **state) {
    (void)state;
    size_t length;
    (void)files_put_text("pins.csv", "vertex,u,v\n0,0,0\n19,1.25,0\n399,1.25,1\n");
    free(output_of(command_unwrap,
                   "unwrap hills:20x20 --method lscm --pins @pins.csv --csv @l.csv"));
    char *text = files_get(files_path("l.csv"), &length);
    assert_non_null(strstr(text, "\n0,0,0,0\n"));
    assert_non_null(strstr(text, "\n19,1.25,0,0\n"));
    assert_non_null(strstr(text, "\n399,1.25,1,0\n"));
    free(text);
    char *output = output_of(command_unwrap, "unwrap hills:20x20 --pins @pins.csv --csv @l.csv");
    assert_true(number_after(output, "faces      ") == 0);
    free(output);
}

static void geodesic_writes_distances_and_cells(void **state) {
    (void)state;
    size_t length;
    char *output = output_of(command_geodesic,
                             "geodesic sphere:4 --exact sphere --from 9 --csv @d.csv --out @d.ply "
                             "--png @d.png --size 120x90");
    assert_true(number_after(output, "on the sphere are ") < 0.03);
    free(output);
    char *text = files_get(files_path("d.csv"), &length);
    /* A line of column names, and nothing after the last newline. */
    assert_int_equal(lines_starting_with(text, ""), 1 + 2562 + 1);
    assert_non_null(strstr(text, "\n9,0,"));
    free(text);
    assert_picture("d.png", 120, 90);
    output =
        output_of(command_geodesic, "geodesic grid:60x60 --exact plane --from 1830 --radius 0.2");
    assert_true(number_after(output, "on the plane are ") < 0.01);
    double near = number_after(output, "touched    ");
    assert_true(near < 3600 / 2);
    free(output);
    output = output_of(command_geodesic, "geodesic grid:60x60 --from 1830 --radius 0.2 --cut");
    assert_true(number_after(output, "entries of each factor, ") == 1);
    free(output);
    output = output_of(command_geodesic,
                       "geodesic torus:50x30 --voronoi --from random:7 --csv @v.csv --png @v.png");
    assert_true(number_after(output, "cells      of ") == 7);
    free(output);
    text = files_get(files_path("v.csv"), &length);
    assert_int_equal(lines_starting_with(text, ""), 1 + 1500 + 1);
    assert_null(strstr(text, ",-1"));
    free(text);
    command_says(command_geodesic, "geodesic grid:30x30 --voronoi --from 0 --radius 0.2", 0,
                 "no site");
    command_says(command_geodesic, "geodesic grid:9x9 --scaled-time 1e-9", 0, "warning");
}

static void help_is_shown_and_bad_input_refused(void **state) {
    (void)state;
    static const struct {
        int (*command)(int argc, char **argv);
        const char *words;
        int status;
        const char *text;
    } cases[] = {
        {command_geodesic, "geodesic --help", 0, "Approximate"},
        {command_unwrap, "unwrap --help", 0, "usage: sparse-local unwrap"},
        {command_unwrap, "unwrap", 2, "MESH"},
        {command_unwrap, "unwrap grid:9x9 --method square", 2, "expected slim, arap"},
        {command_unwrap, "unwrap grid:9x9 --list 0-81", 1, "no vertex 81"},
        {command_unwrap, "unwrap grid:9x9 --list 0,40", 1, "no face with three"},
        {command_unwrap, "unwrap grid:9x9 --center 81 --patch 9", 1, "no such vertex"},
        {command_unwrap, "unwrap grid:9x9 --tolerance -1", 2, "--tolerance"},
        {command_unwrap, "unwrap grid:9x9 --pins /nowhere.csv", 1, "/nowhere.csv"},
        {command_unwrap, "unwrap grid:1x1", 1, "no faces"},
        {command_unwrap, "unwrap /nowhere.obj", 1, "/nowhere.obj"},
        {command_unwrap, "unwrap grid:9x9 --png /nowhere/x.png", 1, "/nowhere/x.png"},
        {command_unwrap, "unwrap grid:9x9 --out /nowhere/x.obj", 1, "/nowhere/x.obj"},
        {command_geodesic, "geodesic grid:9x9 --from 81", 1, "no vertex 81"},
        {command_geodesic, "geodesic grid:9x9 --from random:99", 2, "1 to 81"},
        {command_geodesic, "geodesic grid:9x9 --radius -1", 2, "--radius"},
        {command_geodesic, "geodesic grid:9x9 --exact cube", 2, "plane or sphere"},
        {command_geodesic, "geodesic grid:9x9 --time 1 --scaled-time 2", 2, "one of them"},
        {command_geodesic, "geodesic grid:1x1", 1, "no faces"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        command_says(cases[k].command, cases[k].words, cases[k].status, cases[k].text);
    }
    (void)files_put_text("point.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
    command_says(command_geodesic, expand_paths("geodesic @point.obj"), 1, "no length");
    /* Three faces at an edge, faces with a corner twice, an isolated vertex: where the mesh is not
     * a surface, it is cut. */
    (void)files_put_text("fan.obj",
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 9 9 9\nf 1 2 3\nf 1 2 4\n"
                         "f 2 1 5\nf 1 1 2\nf 1 2 2\n");
    command_says(command_unwrap, expand_paths("unwrap @fan.obj --png @fan.png"), 0, "3 parts");
    command_says(command_geodesic, expand_paths("geodesic @fan.obj --png @fan.png"), 0,
                 "those of 5 of 6 vertices");
    command_says(command_geodesic, expand_paths("geodesic @fan.obj --from 5"), 0,
                 "those of 1 of 6 vertices");
    /* One face without area gets some. */
    command_says(command_unwrap, expand_paths("unwrap @point.obj"), 0, "thinner than");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unwrap_writes_texture_coordinates),
        cmocka_unit_test(every_method_reports),
        cmocka_unit_test(pins_hold_vertices),
        cmocka_unit_test(geodesic_writes_distances_and_cells),
        cmocka_unit_test(help_is_shown_and_bad_input_refused),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
