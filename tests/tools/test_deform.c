/* test_deform.c: the command deform: scripts of handles, tables, pictures, refusals */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tools/mesh/mesh_write.h"
#include "tools/mesh/surface_generator.h"

static const char script[] = "# two handles\n"
                             "grab 0 3-5, 7\n"
                             "grab 100 within 0.2\n"
                             "frame\n"
                             "  move 1 0.2 -0.1 0.3  # and a comment\n"
                             "turn 1 0 0 2 40\n"
                             "frame\n"
                             "release 0\n"
                             "frame\n"
                             "release 1\n"
                             "grab 5\n"
                             "frame\n";

/* Fills in the names of the script and of up to two other files. */
static char *line_of(const char *format, const char *a, const char *b) {
    static char line[1024];
    char paths[3][FILE_PATH_SIZE + 100];
    const char *names[3] = {"script.txt", a, b};
    for (int k = 0; k < 3; k++) {
        (void)snprintf(paths[k], sizeof paths[k], "%s", files_path(names[k] ? names[k] : "none"));
    }
    assert_true(snprintf(line, sizeof line, format, paths[0], paths[1], paths[2]) <
                (int)sizeof line);
    return line;
}

static void scripts_move_handles(void **state) {
    (void)state;
    files_put_text("script.txt", script);
    static const char *const methods[] = {"arap", "biharmonic"};
    for (int k = 0; k < 2; k++) {
        char format[200], message[200];
        size_t length;
        int status;
        mesh m, rest;
        (void)snprintf(format, sizeof format,
                       "deform star:3 --check --bound 1e-9 --method %s --script %%s --steps %%s "
                       "--out %%s",
                       methods[k]);
        char *output =
            run_command(command_deform, line_of(format, "steps.csv", "out.ply"), &status);
        assert_int_equal(status, 0);
        assert_non_null(strstr(output, methods[k]));
        assert_true(number_after(output, "frames     ") == 4);
        assert_true(number_after(output, "differ by at most ") < 1e-9);
        free(output);
        char *text = files_get(files_path("steps.csv"), &length);
        assert_int_equal(files_lines(text), 1 + 11); /* a row per step */
        assert_true(strncmp(text, "line,action,handle,pins,", 24) == 0);
        assert_non_null(strstr(text, "\n2,grab,0,5,"));
        assert_non_null(strstr(text, "\n12,frame,3,1,"));
        free(text);
        /* after all, one vertex is held, where it was when it was grabbed */
        assert_true(mesh_read(&m, files_path("out.ply"), message, sizeof message));
        assert_true(surface_generate(&rest, "star:3", NULL, 0) && m.n_vertices == rest.n_vertices);
        mesh_free(&m);
        mesh_free(&rest);
    }
}

/* With --at the positions are those of the whole surface. */
static void wanted_vertices_are_computed_alone(void **state) {
    (void)state;
    size_t length;
    double whole[5], part[5];
    files_put_text("script.txt", script);
    command_says(command_deform,
                 line_of("deform star:3 --method biharmonic --script %s --csv %s", "all.csv", NULL),
                 0, "frames     4: solve");
    command_says(command_deform,
                 line_of("deform star:3 --method biharmonic --at 17,100 --check --script %s --csv "
                         "%s",
                         "part.csv", NULL),
                 0, "at the wanted vertices");
    char *all = files_get(files_path("all.csv"), &length);
    char *some = files_get(files_path("part.csv"), &length);
    const char *names[2] = {"\n17,", "\n100,"};
    for (int k = 0; k < 2; k++) {
        const char *a = strstr(all, names[k]), *b = strstr(some, names[k]);
        assert_true(a != NULL && b != NULL);
        assert_int_equal(
            sscanf(a, "%lf,%lf,%lf,%lf,%lf", whole, whole + 1, whole + 2, whole + 3, whole + 4), 5);
        assert_int_equal(
            sscanf(b, "%lf,%lf,%lf,%lf,%lf", part, part + 1, part + 2, part + 3, part + 4), 5);
        for (int c = 0; c < 5; c++) {
            assert_true(fabs(whole[c] - part[c]) < 1e-10);
        }
    }
    free(all);
    free(some);
}

static void frames_are_drawn_in_one_scale(void **state) {
    (void)state;
    files_put_text("script.txt", script);
    command_says(command_deform,
                 line_of("deform hills:20x20 --script %s --frames %s --size 160x120 --png %s", "f",
                         "last.png"),
                 0, "frames     4, with ");
    static const char *const names[] = {"f0000.png", "f0001.png", "f0002.png", "f0003.png",
                                        "last.png"};
    for (int k = 0; k < 5; k++) {
        size_t length;
        int w = 0, h = 0;
        char *text = files_get(files_path(names[k]), &length);
        assert_true(sscanf(text, "%d %d", &w, &h) == 2 && w == 160 && h == 120);
        free(text);
    }
}

/* Too few solves are an error; without --iterations large meshes have fewer. */
static void unfinished_frames_are_reported(void **state) {
    (void)state;
    files_put_text("script.txt", script);
    command_says(command_deform, line_of("deform star:3 --script %s --iterations 3", NULL, NULL), 1,
                 "have not converged within 3 solves: the second half of them moved a vertex by ");
    files_put_text("script.txt", "grab 0\ngrab 3\ngrab 700\ngrab 99\nmove 1 0 -0.7 0.3\n"
                                 "move 2 0.4 0.5 0.8\nmove 3 -0.9 0.4 0\nframe\n");
    command_says(command_deform, line_of("deform hills:110x110 --script %s", NULL, NULL), 1,
                 "have not converged within 30 solves");
}

/* A bound that rounding exceeds fails, so that the check is one. */
static void differences_beyond_the_bound_fail(void **state) {
    (void)state;
    files_put_text("script.txt", script);
    command_says(command_deform,
                 line_of("deform star:3 --script %s --check --bound 1e-300", NULL, NULL), 1,
                 "by more than --bound");
}

static void malformed_scripts_are_refused(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"pull 3\n", ":1: pull: expected grab, move, turn, release or frame"},
        {"grab\n", ":1: grab: expected a vertex"},
        {"grab -3\n", "there is no vertex -3"},
        {"grab 3,642\n", "there is no vertex 642; the last one is 641"},
        {"grab 99999999999999999999\n", "expected a vertex"},
        {"grab 7-3\n", "7-3 is an empty range"},
        {"grab 3x\n", "expected a comma or a blank"},
        {"grab 3 around 2\n", "expected a vertex or: within R"},
        {"grab 3 within\n", "expected a distance"},
        {"grab 3 within -1\n", "expected a distance"},
        {"grab 3 within nan\n", "expected a distance"},
        {"grab 3 within 0.1 5\n", "more on the line"},
        {"\ngrab 3\ngrab 2-5\n", ":3: vertex 3 is held by handle 0"},
        {"move 0 1 1 1\n", "there is no handle 0: 0 were grabbed"},
        {"grab 3\nmove 1 1 1 1\n", "there is no handle 1: 1 were grabbed"},
        {"grab 3\nmove -1 1 1 1\n", "there is no handle -1"},
        {"grab 3\nmove 0 1 1\n", "expected HANDLE DX DY DZ"},
        {"grab 3\nmove 0 1 inf 1\n", "expected HANDLE DX DY DZ"},
        {"grab 3\nmove 0 1 1 1 1\n", "more on the line"},
        {"grab 3\nmove 0.5 1 1 1\n", "expected the number of a handle"},
        {"grab 3\nturn 0 0 0 0 5\n", "the axis has no length"},
        {"grab 3\nturn 0 1 0 0\n", "expected HANDLE AX AY AZ DEGREES"},
        {"grab 3\nrelease 0\nmove 0 1 1 1\n", ":3: move: handle 0 was released"},
        {"grab 3\nrelease 0\nrelease 0\n", ":3: release: handle 0 was released"},
        {"frame 3\n", "more on the line"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        files_put_text("script.txt", cases[k][0]);
        command_says(command_deform, line_of("deform star:3 --script %s", NULL, NULL), 1,
                     cases[k][1]);
    }
    files_put_text("script.txt", ""); /* nothing to do */
    command_says(command_deform, line_of("deform star:3 --check --script %s", NULL, NULL), 0,
                 "frames     0");
}

static void malformed_options_are_refused(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"deform sphere:1", "--script FILE is missing"},
        {"deform sphere:1 --method elastic", "expected arap or biharmonic"},
        {"deform sphere:1 --iterations 0", "expected 1 to 1000000"},
        {"deform sphere:1 --tolerance -1", "--tolerance: expected 0 or more"},
        {"deform sphere:1 --at 3", "only with --method biharmonic"},
        {"deform sphere:1 --at 3 --method biharmonic --frames x", "computes no surface"},
        {"deform sphere:1 --at 3 --method biharmonic --png x", "computes no surface"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        command_says(command_deform, cases[k][0], 2, cases[k][1]);
    }
    command_says(command_deform, "deform sphere:1 --script no-such-file", 1, "cannot be opened");
    command_says(command_deform, "deform sphere:1 --frames no/such/folder/x", 1,
                 "cannot be written");
    files_put_text("script.txt", "grab 0\nframe\n");
    files_put_text("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    command_says(command_deform, line_of("deform --script %s %s", "point.obj", NULL), 1,
                 "all vertices are at one point");
}

/* Vertices without faces and faces without area can be held, moved and released. */
static void bad_meshes_are_deformed(void **state) {
    (void)state;
    static const char fan[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 9 9 9\n"
                              "v 5 5 5\nv 6 5 5\nv 7 5 5\n"
                              "f 1 2 3\nf 1 2 4\nf 2 1 5\nf 1 1 2\nf 1 2 2\nf 7 8 9\n";
    static const char moves[] = "grab 0\ngrab 3-5\ngrab 6,7\nmove 0 0 0 1\nmove 1 1 0 0\n"
                                "move 2 0 1 0\nframe\nrelease 1\nframe\nrelease 2\nframe\n";
    files_put_text("fan.obj", fan);
    files_put_text("script.txt", moves);
    command_says(command_deform,
                 line_of("deform --check --script %s --frames %s %s", "x", "fan.obj"), 0, "frames");
    command_says(
        command_deform,
        line_of("deform --check --method biharmonic --script %s --frames %s %s", "x", "fan.obj"), 0,
        "frames");
}

/* A torus, a triangle, two single vertices, and a triangle so thin that pins on the factor of the
 * mesh lose all digits there: what is held is where it is moved to, what has no handle is at
 * rest. */
static void nearly_degenerate_parts_are_held(void **state) {
    (void)state;
    static const char parts[] = "v 5 0 0\nv 6 0 0\nv 7 1e-5 0\nv 0 0 5\nv 1 0 5\nv 0 1 5\nv 9 9 9\n"
                                "v 8 8 8\nf 289 290 291\nf 292 293 294\n";
    static const char moves[] = "grab 288-290\ngrab 0-4\ngrab 294\nmove 0 0.1 0.2 0\nframe\n"
                                "move 1 0 0 0.1\nframe\nrelease 0\nframe\n";
    char message[300];
    size_t length;
    mesh m, out;
    assert_true(surface_generate(&m, "torus:24x12", NULL, 0) && m.n_vertices == 288);
    assert_true(mesh_write(files_path("torus.obj"), &m, NULL, message, sizeof message));
    char *torus = files_get(files_path("torus.obj"), &length);
    char *text = malloc(length + sizeof parts);
    memcpy(text, torus, length);
    memcpy(text + length, parts, sizeof parts);
    files_put_text("parts.obj", text);
    files_put_text("script.txt", moves);
    static const char *const formats[] = {
        "deform --check --script %s --out %s %s --method biharmonic",
        "deform --check --script %s --out %s %s"};
    for (int k = 0; k < 2; k++) {
        int status;
        char *output =
            run_command(command_deform, line_of(formats[k], "out.obj", "parts.obj"), &status);
        assert_int_equal(status, 0);
        assert_non_null(strstr(output, "2 of 5 components have no handle, 1 of them single"));
        assert_true(k == 1 || strstr(output, "each set of handles has a new factor") != NULL);
        assert_true(k == 1 || strstr(output, "(refused: a new factor") != NULL);
        free(output);
        assert_true(mesh_read(&out, files_path("out.obj"), message, sizeof message));
        assert_true(fabs(out.xyz[2] - m.xyz[2] - 0.1) < 1e-9);    /* vertex 0 is held */
        assert_true(k == 1 || fabs(out.xyz[3 * 288] - 5) < 1e-9); /* no longer held */
        assert_true(fabs(out.xyz[3 * 291 + 2] - 5) < 1e-9 && out.xyz[3 * 294] == 9);
        mesh_free(&out);
    }
    /* the same for the wanted vertices alone */
    command_says(
        command_deform,
        line_of("deform --check --script %s --csv %s %s --method biharmonic --at 0,100,289",
                "out.csv", "parts.obj"),
        0, "differ by at most");
    free(text);
    free(torus);
    mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scripts_move_handles),
        cmocka_unit_test(wanted_vertices_are_computed_alone),
        cmocka_unit_test(frames_are_drawn_in_one_scale),
        cmocka_unit_test(unfinished_frames_are_reported),
        cmocka_unit_test(differences_beyond_the_bound_fail),
        cmocka_unit_test(malformed_scripts_are_refused),
        cmocka_unit_test(malformed_options_are_refused),
        cmocka_unit_test(bad_meshes_are_deformed),
        cmocka_unit_test(nearly_degenerate_parts_are_held),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
