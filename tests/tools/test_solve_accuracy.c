/* test_solve_accuracy.c: warnings of meshes that leave few digits to the solutions of a command */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tests/lib/bad_meshes.h"
#include "tests/lib/surfaces.h"

#include "tools/cli/solve_accuracy.h"
#include "tools/mesh/mesh_write.h"

static const struct {
    int (*command)(int argc, char **argv);
    const char *name;    /* the words before the mesh */
    const char *options; /* and after it */
    const char *file;    /* which the options name; NULL: none */
} commands[] = {
    {command_heat, "heat", "", NULL},
    {command_adf, "adf", "--at 1", NULL},
    {command_hks, "hks", "--times 2", NULL},
    {command_pairs, "pairs", "--count 3", NULL},
    {command_info, "info", "", NULL},
    {command_geodesic, "geodesic", "", NULL},
    {command_unwrap, "unwrap", "--method lscm", NULL},
    {command_geodesic, "geodesic", "--voronoi --from 0,30", NULL},
    {command_geodesic, "geodesic", "--raw", NULL},
    {command_save, "save", "--out", "s.slf"},
    {command_edit, "edit", "--edits 4", NULL},
    {command_deform, "deform", "--script", "script.txt"},
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

/* Counts the commands that warn of inaccurate solutions on m, and of them those with `text`. */
static int warnings_on(const mesh *m, const char *text, int *with_text) {
    int count = 0;
    char message[300], line[1500], file[FILE_PATH_SIZE + 100];
    (void)snprintf(file, sizeof file, "%s", files_path("m.ply"));
    assert_true(mesh_write(file, m, NULL, message, sizeof message));
    (void)files_put_text("script.txt", "grab 0\nmove 0 0 0 1\nframe\n");
    *with_text = 0;
    for (int k = 0; k < COMMANDS; k++) {
        int status;
        (void)snprintf(line, sizeof line, "%s %s %s %s", commands[k].name, file,
                       commands[k].options,
                       commands[k].file != NULL ? files_path(commands[k].file) : "");
        char *output = run_command(commands[k].command, line, &status);
        assert_true(status == 0 || status == 1);
        const char *warning = strstr(output, "makes solutions inaccurate");
        count += warning != NULL;
        *with_text += warning != NULL && strstr(warning, text) != NULL;
        free(output);
    }
    return count;
}

/* Sound meshes, also coarse or graded ones with obtuse angles, get no warning. */
static void sound_meshes_get_no_warning(void **state) {
    (void)state;
    int with_text;
    for (int which = 0; which < 4; which++) {
        mesh m = which == 0   ? flat_grid(15, 0.3)
                 : which == 1 ? torus_grid(24, 12)
                 : which == 2 ? extruded_outline(60, 10, 1)
                              : flat_grid(15, 0.2);
        for (sl_int v = 0; v < m.n_vertices && which == 3; v++) {
            m.xyz[3 * v] = pow(100, m.xyz[3 * v]);
        }
        assert_int_equal(warnings_on(&m, "", &with_text), 0);
        mesh_free(&m);
    }
}

/* Needles and faces that differ by many orders of magnitude are named by every command that
 * solves. */
static void bad_meshes_are_named_with_numbers(void **state) {
    (void)state;
    int with_text;
    mesh m = flat_grid(15, 0); /* needles, which no flip can mend: a strip is too narrow */
    for (sl_int v = 0; v < m.n_vertices; v++) {
        m.xyz[3 * v] *= 1e6;
    }
    assert_int_equal(
        warnings_on(&m, "the smallest angle is 5.7e-05 degrees, 392 faces", &with_text), COMMANDS);
    assert_true(with_text >= COMMANDS - 3); /* patches have fewer faces */
    mesh_free(&m);
}

/* The condition of M + t L is estimated where row sums do not bound it. */
static void lost_digits_are_counted(void **state) {
    (void)state;
    const sl_int p[4] = {0, 2, 3, 4}, i[4] = {0, 1, 1, 2};
    const double d = 1 + 1e-12, good[4] = {1, -0.5, 1, 1e-20}, bad[4] = {1, -1, d, 1},
                 signs[4] = {1, 0.5, 1, 1};
    const sl_csc A[3] = {{3, 3, p, i, good}, {3, 3, p, i, bad}, {3, 3, p, i, signs}};
    const char *path = files_path("err.txt");
    char text[3][600];
    for (int k = 0; k < 3; k++) {
        (void)fflush(NULL);
        int saved = dup(2);
        FILE *file = fopen(path, "w+");
        assert_true(saved >= 0 && file != NULL && dup2(fileno(file), 2) == 2);
        accuracy_warn(NULL, NULL, &A[k]);
        (void)fflush(NULL);
        assert_true(dup2(saved, 2) == 2 && close(saved) == 0);
        rewind(file);
        text[k][fread(text[k], 1, sizeof text[k] - 1, file)] = '\0';
        (void)fclose(file);
    }
    print_message("%s", text[1]);
    assert_string_equal(text[0], ""); /* scaled rows cost nothing */
    assert_non_null(strstr(text[1], "rounding can cost 12 of 16 digits (condition 4"));
    assert_non_null(strstr(text[1], "pivots from 1e-12 to 1"));
    assert_string_equal(text[2], "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_meshes_get_no_warning),
        cmocka_unit_test(bad_meshes_are_named_with_numbers),
        cmocka_unit_test(lost_digits_are_counted),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
