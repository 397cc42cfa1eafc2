/* test_bad_layouts.c: layouts of patches with seams, needles, faces without area; warnings */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tests/lib/bad_meshes.h"
#include "tests/lib/circle_flux.h"
#include "tests/lib/mesh_patch.h"
#include "tests/lib/surfaces.h"

#include "tools/geometry/conformal.h"
#include "tools/mesh/mesh_write.h"

/* A torus with faces squeezed to angles of about 0.01 degrees. */
static mesh squeezed_torus(void) {
    mesh m = torus_grid(60, 24);
    for (sl_int v = 0; v < m.n_vertices; v++) {
        m.xyz[3 * v] *= 100;
        m.xyz[3 * v + 1] *= 0.01 * (1 + sin(7.0 * v));
    }
    return m;
}

static mesh bad_mesh(int which) {
    return which == 0   ? torus_grid(120, 24) /* a seam around a handle */
           : which == 1 ? extruded_outline(200, 10, 1)
           : which == 2 ? extruded_outline(100, 60, 8)
           : which == 3 ? with_flat_faces(torus_grid(60, 40), 30)
           : which == 4 ? with_double_faces(torus_grid(60, 40), 30, true)
           : which == 5 ? with_double_faces(torus_grid(60, 40), 30, false)
                        : squeezed_torus();
}
enum { BAD_MESHES = 7 };

/* On each of the meshes the solution of N x = b agrees with that of a factor of N, refined; the
 * iteration alone has not converged on some of them, and the report tells which. */
static void patch_problems_are_solved_whatever_the_patch(void **state) {
    (void)state;
    int by_own_factor = 0;
    for (int which = 0; which < BAD_MESHES; which++) {
        mesh_factor_t w;
        mesh_factor_make(&w, bad_mesh(which));
        disk_patch d = grown_disk(&w, w.m.faces[0], which == 6 ? 500 : w.m.n_vertices * 2 / 3);
        sl_int n = d.p.m.n_vertices;
        double *B = circle_flux(&d), *X = test_reals(2 * (size_t)n), *Y = test_reals(2 * (size_t)n);
        patch_solver s = patch_solver_of(&w, &d.p);
        patch_report how;
        const sl_csc N = sl_matrix_view(s.N);
        SL_CHECK(patch_solver_solve_exact(&s, X, B, 2, &how));
        print_message("mesh %d: %d solves%s, residual %.1e, backward error %.1e\n", which,
                      how.solves, how.own_factor ? ", own factor" : "", how.residual,
                      how.backward_error);
        assert_true(how.solved && how.solves <= 60);
        assert_true(how.error >= 0 && how.error <= PATCH_SOLVER_ERROR);
        by_own_factor += how.own_factor;
        if (which == 0 || which == 6) {
            assert_true(how.own_factor);
        }
        SL_CHECK(patch_solver_factor_patch(&s));
        SL_CHECK(sl_factor_solve(s.own_F, Y, (size_t)n, B, (size_t)n, 2, NULL));
        SL_CHECK(sl_factor_refine(s.own_F, &N, Y, (size_t)n, B, (size_t)n, 2, 5, NULL, NULL));
        for (sl_int c = 0; c < 2; c++) {
            assert_true(largest_difference(X + c * n, Y + c * n, n) <=
                        1e-8 * largest(X + c * n, (size_t)n));
        }
        patch_solver_free(&s);
        free(Y);
        free(X);
        free(B);
        disk_patch_free(&d);
        mesh_factor_free(&w);
    }
    assert_true(by_own_factor < BAD_MESHES); /* else the factor of the mesh serves nobody */
}

/* Random right-hand sides that do not sum to 0 have no solution; the report says so. */
static void systems_without_a_solution_are_reported(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, torus_grid(20, 10));
    disk_patch d = grown_disk(&w, 0, 60);
    sl_int n = d.p.m.n_vertices;
    double *B = test_reals(2 * (size_t)n), *X = test_reals(2 * (size_t)n);
    patch_solver s = patch_solver_of(&w, &d.p);
    patch_report how;
    for (sl_int k = 0; k < 2 * n; k++) {
        B[k] = 1;
    }
    SL_CHECK(patch_solver_solve_exact(&s, X, B, 2, &how));
    assert_true(how.own_factor && !how.solved && how.residual > 1e-3 && how.backward_error > 1e-6);
    B[3] = NAN;
    if (patch_solver_solve_exact(&s, X, B, 2, &how) == SL_OK) {
        assert_false(how.solved);
    }
    patch_solver_free(&s);
    free(X);
    free(B);
    disk_patch_free(&d);
    mesh_factor_free(&w);
}

/* With faces without area, the conformal energy of any layout is at least 0, up to rounding. */
static void conformal_energies_are_never_negative(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, with_flat_faces(torus_grid(60, 40), 30));
    disk_patch d = grown_disk(&w, 5, 700);
    sl_int n = d.p.m.n_vertices, flat = 0;
    double *X = test_reals(2 * (size_t)n), *Y = test_reals(2 * (size_t)n);
    patch_solver s = patch_solver_of(&w, &d.p);
    for (sl_int f = 0; f < d.p.m.n_faces; f++) { /* blow up one corner of each face without area */
        const sl_int *v = d.p.m.faces + 3 * f;
        laplacian_face measure = laplacian_of_face(&d.p.m, v);
        if (measure.weight[0] == 0 && measure.weight[1] == 0) {
            flat++;
            double energy = 0;
            memset(X, 0, 2 * (size_t)n * sizeof *X);
            for (int k = 0; k < 2; k++) { /* an equilateral triangle */
                X[v[0]] = 1;
                X[n + v[1]] = 1;
                X[v[2]] = X[n + v[2]] = k;
                SL_CHECK(conformal_apply(&s, &d, Y, X));
                for (sl_int i = 0; i < 2 * n; i++) {
                    energy += X[i] * Y[i];
                }
                assert_true(energy >= -1e-12);
            }
        }
    }
    assert_true(flat > 3);
    patch_solver_free(&s);
    free(Y);
    free(X);
    disk_patch_free(&d);
    mesh_factor_free(&w);
}

/* Writes bad mesh `which` and runs a command, whose words begin with "COMMAND @": @ is the file. */
static char *run_on(int which, int (*command)(int argc, char **argv), const char *words,
                    int *exit_status) {
    char line[900];
    const char *at = strchr(words, '@');
    mesh m = bad_mesh(which);
    assert_non_null(at);
    assert_true(mesh_write(files_path("bad.obj"), &m, NULL, line, sizeof line));
    mesh_free(&m);
    (void)snprintf(line, sizeof line, "%.*s%s%s", (int)(at - words), words, files_path("bad.obj"),
                   at + 1);
    return run_command(command, line, exit_status);
}

/* The number that follows the last occurrence of text. */
static double last_number_after(const char *output, const char *text) {
    const char *at = strstr(output, text);
    assert_non_null(at);
    for (const char *next = at; next != NULL; next = strstr(next + 1, text)) {
        at = next;
    }
    return strtod(at + strlen(text), NULL);
}

/* The default layout of a patch with a seam has no flipped face; a bad one is not given without a
 * warning. */
static void flips_are_avoided_or_reported(void **state) {
    (void)state;
    int status;
    char *output = run_on(0, command_param, "param @ --patch 1900", &status);
    assert_true(status == 0 && strstr(output, "warning") == NULL);
    assert_non_null(strstr(output, "omitted as a seam"));
    assert_non_null(strstr(output, "solved by a factor of the patch"));
    free(output);
    output = run_on(0, command_param, "param @ --patch 1900 --system mesh", &status);
    assert_int_equal(status, 0);
    assert_non_null(strstr(output, "faces are flipped"));
    free(output);
    output = run_on(3, command_param, "param @ --patch 900", &status);
    assert_int_equal(status, 0);
    assert_non_null(strstr(output, "faces have no area"));
    free(output);
    output = run_on(6, command_param, "param @ --patch 900 --compare", &status);
    assert_int_equal(status, 0); /* all methods agree */
    assert_true(number_after(output, "Jacobi: ") <= 2 * (1000 + 4 * 900));
    free(output);
    (void)files_put_text("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    char line[700];
    (void)snprintf(line, sizeof line, "param %s", files_path("flat.obj"));
    command_says(command_param, line, 1, "does not solve its system");
}

/* Both factors lead arap to layouts with the same energy on patches with a seam; too few iterations
 * are an error. */
static void arap_converges_or_fails(void **state) {
    (void)state;
    double energy[2];
    int status;
    for (int own = 0; own < 2; own++) {
        char *output =
            run_on(0, command_arap,
                   own ? "arap @ --patch 1900 --own-factor" : "arap @ --patch 1900", &status);
        assert_int_equal(status, 0);
        energy[own] = last_number_after(output, "\n           ");
        free(output);
    }
    assert_true(energy[0] > 0 && fabs(energy[0] - energy[1]) <= 0.01 * energy[1]);
    char *output = run_on(0, command_arap, "arap @ --patch 1900 --iterations 3", &status);
    assert_int_equal(status, 1);
    assert_non_null(strstr(output, "not converged after 3 iterations"));
    free(output);
}

/* Needles and faces without area leave an eigenvector with a small residual and an eigenvalue that
 * is not negative. */
static void scp_finds_eigenvectors_of_bad_patches(void **state) {
    (void)state;
    for (int which = 0; which < BAD_MESHES; which++) {
        int status;
        char *output = run_on(which, command_scp, "scp @ --patch 700", &status);
        double lambda = last_number_after(output, "\nlambda");
        double residual = number_after(output, "/ ||B x|| = ");
        assert_int_equal(status, 0);
        assert_true(lambda > 0 && residual <= 1e-4 * lambda);
        free(output);
    }
    char *output;
    int status;
    output = run_on(1, command_scp, "scp @ --patch 700 --iterations 1", &status);
    assert_int_equal(status, 1);
    assert_non_null(strstr(output, "has not converged after 1 iterations"));
    free(output);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patch_problems_are_solved_whatever_the_patch),
        cmocka_unit_test(systems_without_a_solution_are_reported),
        cmocka_unit_test(conformal_energies_are_never_negative),
        cmocka_unit_test(flips_are_avoided_or_reported),
        cmocka_unit_test(arap_converges_or_fails),
        cmocka_unit_test(scp_finds_eigenvectors_of_bad_patches),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
