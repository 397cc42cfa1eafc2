/* test_edit.c: the command edit, and the system behind it: every edit is followed exactly */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tools/cli/mesh_edits.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/surface_generator.h"

/* After each edit the factor solves with the present matrix. What the matrix is follows from the
 * mesh: without springs and pins it is M + t L of the flipped faces. */
static void every_edit_is_followed(void **state) {
    (void)state;
    static const char *const surfaces[] = {"hills:14x13", "sphere:2"};
    for (int k = 0; k < 2 * EDIT_KINDS; k++) {
        const edit_kind kind = (edit_kind)(k / 2);
        mesh m;
        edit_system e;
        int ways[EDIT_WAYS] = {0}, edits = 0;
        assert_true(surface_generate(&m, surfaces[k % 2], NULL, 0));
        const double edge = mesh_mean_edge_length(&m);
        edit_system_create(&e, &m, edge * edge, 20, 5);
        for (int turn = 0; turn < 150; turn++) {
            entry_changes changes;
            if (edit_system_edit(&e, kind, &changes)) {
                ways[edit_system_follow(&e, &changes)]++;
                edits++;
                const edit_check check = edit_system_check(&e);
                assert_true(check.difference < 1e-12 && check.backward_error < 1e-14);
                assert_true(check.anew_ms >= 0 && check.refactor_ms >= 0);
            }
            triplets_free(&changes);
        }
        assert_true(edits > 100);
        assert_int_equal(ways[EDIT_ANEW] > 0, kind == EDIT_FLIP);
        if (kind == EDIT_FLIP) {
            assert_true(ways[EDIT_OUTSIDE] > edits / 4);
        } else { /* on so small a mesh the cheapest way depends on the processor */
            assert_int_equal(ways[EDIT_UPDATE] + ways[EDIT_REACH] + ways[EDIT_REFACTOR], edits);
            assert_true(kind != EDIT_WEIGHT || ways[EDIT_UPDATE] > edits / 4);
        }
        if (kind == EDIT_FLIP) {
            sl_matrix *want = NULL;
            assert_true(laplacian_system(&want, &e.faces.m, edge * edge));
            const sl_csc A = sl_matrix_view(want);
            for (sl_int j = 0; j < A.n_cols; j++) {
                for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
                    assert_true(fabs(edited_matrix_get(&e.A, A.i[p], j) - A.x[p]) <
                                1e-12 * A.x[A.p[j]]);
                }
            }
            sl_matrix_free(want);
        }
        edit_system_free(&e);
        mesh_free(&m);
    }
}

/* Flips, splits, collapses and remeshed patches: the factor is that of the present mesh, and mostly
 * columns are kept. */
static void meshes_are_followed(void **state) {
    (void)state;
    static const char *const surfaces[] = {"hills:40x40", "sphere:4"};
    static const edit_kind kinds[] = {EDIT_FLIP, EDIT_SPLIT, EDIT_COLLAPSE, EDIT_REMESH};
    for (int k = 0; k < 8; k++) {
        mesh m;
        mesh_edits e;
        int ways[EDIT_WAYS] = {0}, edits = 0;
        assert_true(surface_generate(&m, surfaces[k % 2], NULL, 0));
        const double edge = mesh_mean_edge_length(&m), t = edge * edge;
        mesh_edits_create(&e, &m, t, 20, 5);
        for (int turn = 0; turn < 40; turn++) {
            const sl_int n = e.mesh.faces.m.n_vertices;
            if (mesh_edits_edit(&e, kinds[k / 2])) {
                const sl_int now = e.mesh.faces.m.n_vertices;
                ways[mesh_edits_follow(&e)]++;
                edits++;
                assert_true(kinds[k / 2] == EDIT_REMESH ||
                            now ==
                                n + (kinds[k / 2] == EDIT_SPLIT) - (kinds[k / 2] == EDIT_COLLAPSE));
                sl_matrix *want = NULL;
                assert_true(laplacian_system(&want, &e.mesh.faces.m, t));
                const sl_csc A = sl_matrix_view(want);
                const edit_check check = edit_check_factor(&A, e.F, e.W, &e.random);
                assert_int_equal(A.n_cols, now);
                assert_true(check.difference < 1e-12 && check.backward_error < 1e-14);
                sl_matrix_free(want);
            }
        }
        assert_true(edits > 30 && ways[EDIT_KEPT] > edits / 2);
        mesh_edits_free(&e);
        mesh_free(&m);
    }
}

/* A change that the factor does not follow is noticed. */
static void a_missed_edit_is_noticed(void **state) {
    (void)state;
    mesh m;
    edit_system e;
    entry_changes changes;
    assert_true(surface_generate(&m, "sphere:2", NULL, 0));
    edit_system_create(&e, &m, 0.01, 20, 5);
    assert_true(edit_system_check(&e).difference < 1e-13);
    assert_true(edit_system_edit(&e, EDIT_WEIGHT, &changes));
    triplets_free(&changes);
    assert_true(edit_system_check(&e).difference > 1e-6);
    edit_system_free(&e);
    mesh_free(&m);
}

/* Pins and springs that all went leave the first matrix. */
static void pins_and_springs_come_and_go(void **state) {
    (void)state;
    mesh m;
    edit_system e;
    sl_matrix *want = NULL;
    assert_true(surface_generate(&m, "hills:14x13", NULL, 0));
    edit_system_create(&e, &m, 0.01, 20, 9);
    assert_true(laplacian_system(&want, &m, 0.01));
    const sl_csc A = sl_matrix_view(want);
    int met = 0;
    for (int turn = 0; turn < 4000 && met < 10; turn++) {
        entry_changes changes;
        const bool is_pin = e.n_pins > 0 || (e.springs.count > 0 && turn % 10 == 0);
        const edit_kind kind = is_pin ? EDIT_PIN : EDIT_WEIGHT;
        assert_true(edit_system_edit(&e, kind, &changes));
        (void)edit_system_follow(&e, &changes);
        triplets_free(&changes);
        for (sl_int k = 0; k < e.n_pins; k++) { /* the row of a pin is its diagonal */
            triplets row = {0, 0, NULL, NULL, NULL};
            assert_true(edited_matrix_row(&e.A, e.pins[k].vertex, &row) && row.count == 0);
            triplets_free(&row);
        }
        if (e.n_pins == 0 && e.springs.count == 0) {
            met++;
            for (sl_int j = 0; j < A.n_cols; j++) {
                for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
                    assert_true(fabs(edited_matrix_get(&e.A, A.i[p], j) - A.x[p]) <
                                1e-11 * A.x[A.p[j]]);
                }
            }
        }
    }
    assert_true(met == 10);
    sl_matrix_free(want);
    edit_system_free(&e);
    mesh_free(&m);
}

static void tables_and_plots_are_written(void **state) {
    (void)state;
    char words[1300];
    int status;
    size_t length;
    (void)snprintf(words, sizeof words,
                   "edit hills:15x15 --edits 40 --every 15 --kinds weight,patch,pin,flip --patch 9 "
                   "--csv %s/e.csv --svg %s/e.svg",
                   files_folder, files_folder);
    char *output = run_command(command_edit, words, &status);
    assert_int_equal(status, 0);
    assert_non_null(strstr(output, "check      3 new factors"));
    assert_true(number_after(output, "differ by at most ") < 1e-12);
    assert_true(number_after(output, "drift at most ") > 0);
    free(output);
    char *text = files_get(files_path("e.csv"), &length);
    assert_int_equal(files_lines(text), 1 + 40 + 3);
    assert_non_null(strstr(text, "\n40,check,"));
    free(text);
    text = files_get(files_path("e.svg"), &length);
    assert_true(strncmp(text, "<svg", 4) == 0 && strstr(text, "</svg>\n") != NULL);
    assert_non_null(strstr(text, "refactorization"));
    free(text);
}

static void mesh_edits_are_reported(void **state) {
    (void)state;
    char words[1300];
    int status;
    size_t length;
    (void)snprintf(words, sizeof words,
                   "edit hills:40x40 --edits 30 --every 10 --kinds flip,split,collapse,remesh "
                   "--patch 12 --csv %s/m.csv --svg %s/m.svg",
                   files_folder, files_folder);
    char *output = run_command(command_edit, words, &status);
    assert_int_equal(status, 0);
    assert_true(number_after(output, "differ by at most ") < 1e-12);
    assert_true(number_after(output, "entries of L at most ") > 0.9);
    free(output);
    char *text = files_get(files_path("m.csv"), &length);
    assert_int_equal(files_lines(text), 1 + 30 + 3);
    assert_non_null(strstr(text, ",kept,"));
    free(text);
    text = files_get(files_path("m.svg"), &length);
    assert_non_null(strstr(text, "collapse"));
    free(text);
}

static void options_are_checked(void **state) {
    (void)state;
    command_says(command_edit, "edit sphere:1 --kinds cut", 2, "expected some of weight");
    command_says(command_edit, "edit sphere:1 --kinds split,pin", 2, "do not go with split");
    command_says(command_edit, "edit sphere:2 --kinds split --edits 3", 0, "vertices");
    command_says(command_edit, "edit sphere:1 --kinds weight,pin,flip,patch,pin", 2, "each once");
    command_says(command_edit, "edit sphere:1 --kinds weight,,pin", 2, "expected some of weight");
    command_says(command_edit, "edit sphere:1 --patch 1", 2, "2 or more");
    command_says(command_edit, "edit sphere:1 --edits 0", 0, "edits      0 in");
    command_says(command_edit, "edit sphere:2 --every 0", 0, "growth ");
    command_says(command_edit, "edit sphere:2 --bound 1e-300", 1, "by more than --bound");
    /* one face: neither flips nor vertices beside the only pin */
    files_put_text("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    char words[800];
    (void)snprintf(words, sizeof words, "edit --kinds flip,pin,weight,patch %s",
                   files_path("one.obj"));
    command_says(command_edit, words, 0, "found no place.");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_edit_is_followed),
        cmocka_unit_test(meshes_are_followed),
        cmocka_unit_test(a_missed_edit_is_noticed),
        cmocka_unit_test(pins_and_springs_come_and_go),
        cmocka_unit_test(tables_and_plots_are_written),
        cmocka_unit_test(mesh_edits_are_reported),
        cmocka_unit_test(options_are_checked),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
