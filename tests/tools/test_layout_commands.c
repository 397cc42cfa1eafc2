/* test_layout_commands.c: the commands param, arap, scp, geodesic: files, output, refusals */
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

static void param_writes_texture_coordinates(void **state) {
    (void)state;
    size_t length;
    mesh m;
    char message[300];
    char *output =
        output_of(command_param,
                  "param --center 500 --patch 300 --csv @a.csv --out @a.obj --png @a.png --layout "
                  "@b.png --close @c.png --size 200x150 sphere:4");
    assert_true(number_after(output, "patch      ") == 300);
    free(output);
    char *text = files_get(files_path("a.obj"), &length);
    assert_int_equal(lines_starting_with(text, "vt "), 300);
    const char *at = strstr(text, "vt ");
    /* All coordinates are in the unit square. */
    for (int k = 0; k < 300; k++) {
        double u = -1, v = -1;
        assert_int_equal(sscanf(at, "vt %lf %lf", &u, &v), 2);
        assert_true(u >= 0 && u <= 1 && v >= 0 && v <= 1);
        at = strstr(at + 1, "vt ");
    }
    free(text);
    assert_true(mesh_read(&m, files_path("a.obj"), message, sizeof message));
    assert_true(m.n_vertices == 300 && m.n_faces > 500);
    mesh_free(&m);
    text = files_get(files_path("a.csv"), &length);
    assert_int_equal(lines_starting_with(text, ""), 1 + 300 + 1);
    free(text);
    assert_picture("a.png", 200, 150);
    assert_picture("b.png", 200, 150);
    assert_picture("c.png", 200, 150);
}

/* The same patch grown and listed. The command checks its own comparison. */
static void lists_and_comparisons_agree(void **state) {
    (void)state;
    (void)files_put_text("list.txt", "# a fan\n0 1\n2 20\n21 22 40 41 42\n");
    command_says(command_param, expand_paths("param grid:20x20 --list-file @list.txt"), 0,
                 "patch      9 vertices, 8 faces, 8 on its boundary");
    command_says(command_param, "param grid:20x20 --list 0-2,20-22,40-42 --compare", 0,
                 "refactorize the patch and solve");
    command_says(command_param, "param torus:60x30 --center 40 --patch 200 --compare", 0,
                 "  0 from the full solve");
    command_says(command_param, "param grid:40x40 --center 820 --sweep 50,200", 0, "     200 ");
    command_says(command_param, "param grid:20x20 --sweep 2", 1, "3 or more");
    command_says(command_param, "param grid:20x20 --dirichlet", 0, "Dirichlet");
    char *output = output_of(command_param, "param grid:30x30 --center 440 --patch 200 --boundary "
                                            "unrolled --system patch");
    /* A flat patch with its own boundary is neither bent, stretched nor turned over. */
    assert_true(fabs(number_after(output, "Neumann")) <= 1e-12);
    free(output);
}

static void layouts_lower_their_energy(void **state) {
    (void)state;
    static const char *const command_lines[] = {
        "arap hills:40x40 --patch 500 --center 800",
        "arap hills:40x40 --patch 500 --center 800 --own-factor",
        "scp hills:40x40 --patch 500 --center 800",
        "scp hills:40x40 --patch 500 --center 800 --descend 4"};
    static const char *const ends[] = {"as rigid as possible", "as rigid as possible",
                                       "spectral conformal", "conformal, by descent"};
    for (int k = 0; k < 4; k++) {
        char *output = output_of(k < 2 ? command_arap : command_scp, command_lines[k]);
        assert_true(number_after(output, ends[k]) < 0.2 * number_after(output, "harmonic "));
        free(output);
    }
    command_says(command_arap, "arap --iterations 3 hills:30x30", 1, "not converged after 3 it");
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
        {command_param, "param --help", 0, "usage: sparse-local param"},
        {command_arap, "arap --help", 0, "usage: sparse-local arap"},
        {command_scp, "scp --help", 0, "usage: sparse-local scp"},
        {command_geodesic, "geodesic --help", 0, "Approximate"},
        {command_param, "param", 2, "MESH"},
        {command_param, "param sphere:2 --list all", 1, "closed"},
        {command_arap, "arap torus:20x10 --list 0-99", 1, "more than one boundary"},
        {command_scp, "scp grid:9x9 --list 0,1,10,40", 1, "vertex 40"},
        {command_scp, "scp grid:9x9 --list 0,1,10,0", 1, "vertex 0 is listed twice"},
        {command_param, "param grid:9x9 --list 0-81", 1, "no vertex 81"},
        {command_param, "param grid:9x9 --list 0 --list-file x", 2, "one of them"},
        {command_param, "param grid:9x9 --list-file /nowhere/x", 1, "/nowhere/x"},
        {command_param, "param grid:9x9 --center 81", 1, "vertex 81: the mesh has no such vertex"},
        {command_param, "param grid:9x9 --patch 2", 1, "3 or more"},
        {command_param, "param grid:9x9 --boundary square", 2, "circle or unrolled"},
        {command_param, "param grid:9x9 --system half", 2, "mesh or patch"},
        {command_param, "param grid:1x1", 1, "no faces"},
        {command_param, "param /nowhere.obj", 1, "/nowhere.obj"},
        {command_param, "param grid:9x9 --png /nowhere/x.png", 1, "/nowhere/x.png"},
        {command_param, "param grid:9x9 --out /nowhere/x.obj", 1, "/nowhere/x.obj"},
        {command_arap, "arap grid:9x9 --solves 0", 2, "--solves"},
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
    (void)files_put_text("words.txt", "1 2 three\n");
    command_says(command_param, expand_paths("param grid:9x9 --list-file @words.txt"), 1,
                 "words.txt:1: not a vertex number");
    (void)files_put_text("point.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
    command_says(command_geodesic, expand_paths("geodesic @point.obj"), 1, "no length");
    /* Three faces at an edge, faces with a corner twice, an isolated vertex: where the mesh is not
     * a surface, patches avoid it. */
    (void)files_put_text("fan.obj",
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 9 9 9\nf 1 2 3\nf 1 2 4\n"
                         "f 2 1 5\nf 1 1 2\nf 1 2 2\n");
    command_says(command_param, expand_paths("param @fan.obj --compare --png @fan.png"), 0,
                 "patch  ");
    command_says(command_param, expand_paths("param @fan.obj --list 0-4"), 1, "has three faces");
    command_says(command_param, expand_paths("param @fan.obj --center 5"), 1,
                 "vertex 5: it has no face");
    command_says(command_scp, expand_paths("scp @fan.obj"), 0, "spectral conformal");
    command_says(command_geodesic, expand_paths("geodesic @fan.obj --png @fan.png"), 0,
                 "those of 5 of 6 vertices");
    command_says(command_geodesic, expand_paths("geodesic @fan.obj --from 5"), 0,
                 "those of 1 of 6 vertices");
    /* One face without area: its layout is arbitrary. */
    command_says(command_param, expand_paths("param @point.obj"), 1, "3 vertices have no weights");
    command_says(command_arap, expand_paths("arap @point.obj"), 0, "no area");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(param_writes_texture_coordinates),
        cmocka_unit_test(lists_and_comparisons_agree),
        cmocka_unit_test(layouts_lower_their_energy),
        cmocka_unit_test(geodesic_writes_distances_and_cells),
        cmocka_unit_test(help_is_shown_and_bad_input_refused),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
