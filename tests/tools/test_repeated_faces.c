/* test_repeated_faces.c: meshes without repeated faces; pages show such faces once */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tests/lib/bad_meshes.h"
#include "tests/lib/surfaces.h"

#include "tools/mesh/mesh_write.h"
#include "tools/mesh/repeated_faces.h"

/* Repeated in any order of the corners; the first of each stays, and the order of the others. */
static void later_faces_are_left_out(void **state) {
    (void)state;
    static const sl_int faces[8][3] = {{0, 1, 2}, {3, 2, 1}, {1, 0, 2}, {2, 0, 1},
                                       {0, 1, 3}, {1, 2, 3}, {0, 0, 1}, {1, 1, 0}};
    static const sl_int kept[5] = {0, 1, 4, 6, 7};
    mesh m = bad_mesh_allocate(4, 8), once, none = {0, 0, NULL, NULL};
    sl_int removed = -1;
    memcpy(m.faces, faces, sizeof faces);
    m.xyz[7] = 0.5;
    assert_true(mesh_without_repeated_faces(&once, &m, &removed));
    assert_true(removed == 3 && once.n_faces == 5 && once.n_vertices == 4);
    SAME_VALUES(once.xyz, m.xyz, 12);
    for (int k = 0; k < 5; k++) {
        assert_memory_equal(once.faces + 3 * k, faces[kept[k]], sizeof faces[0]);
    }
    mesh_free(&once);
    mesh_free(&m);
    assert_true(mesh_without_repeated_faces(&once, &none, NULL));
    assert_true(once.n_vertices == 0 && once.n_faces == 0);
    mesh_free(&once);
    for (int opposed = 0; opposed < 2; opposed++) {
        m = with_double_faces(torus_grid(20, 12), 48, opposed);
        assert_true(mesh_without_repeated_faces(&once, &m, &removed));
        assert_int_equal(removed, 48);
        assert_memory_equal(once.faces, m.faces, 3 * (size_t)once.n_faces * sizeof *m.faces);
        mesh_free(&once);
        mesh_free(&m);
    }
}

static void pages_show_them_once(void **state) {
    (void)state;
    char message[300], line[1500], path[FILE_PATH_SIZE + 100];
    mesh m = with_double_faces(torus_grid(20, 12), 48, true);
    (void)snprintf(path, sizeof path, "%s", files_path("m.obj"));
    assert_true(mesh_write(path, &m, NULL, message, sizeof message));
    mesh_free(&m);
    (void)snprintf(line, sizeof line, "view %s --out %s", path, files_path("p.html"));
    command_says(command_view, line, 0, "240 vertices, 480 faces");
    command_says(command_view, line, 0, "48 faces with the vertices of others are left out");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(later_faces_are_left_out),
        cmocka_unit_test(pages_show_them_once),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
