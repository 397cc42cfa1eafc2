/* test_intrinsic.c: intrinsic Delaunay triangulations, their Laplacians, heat and distances */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tests/lib/bad_meshes.h"
#include "tests/lib/surfaces.h"

#include "tools/geometry/heat_distance.h"
#include "tools/geometry/intrinsic.h"
#include "tools/geometry/surface_paths.h"
#include "tools/mesh/mesh_write.h"

/* Three sheets along the y axis: its edges have three faces. */
static mesh three_sheets(sl_int side) {
    mesh m = bad_mesh_allocate(3 * side * side, 6 * (side - 1) * (side - 1));
    sl_int used = 0;
    for (sl_int k = 0; k < 3; k++) {
        double angle = 2.1 * (double)k;
        for (sl_int i = 0; i < side; i++) {
            for (sl_int j = 0; j < side; j++) {
                double *x = m.xyz + 3 * ((k * side + i) * side + j), r = (double)i / (side - 1);
                x[0] = r * cos(angle);
                x[1] = (double)j / (side - 1);
                x[2] = r * sin(angle);
            }
        }
        for (sl_int i = 0; i + 1 < side; i++) {
            for (sl_int j = 0; j + 1 < side; j++) {
                sl_int a = (i == 0 ? 0 : k * side + i) * side + j,
                       b = (k * side + i + 1) * side + j;
                bad_mesh_face(&m, used++, a, b, b + 1);
                bad_mesh_face(&m, used++, a, k == 1 ? a + 1 : b + 1, k == 1 ? b + 1 : a + 1);
            }
        }
    }
    return m;
}

static mesh bad_mesh(int which) {
    return which == 0   ? extruded_outline(200, 10, 1)
           : which == 1 ? extruded_outline(60, 3, 2)
           : which == 2 ? with_flat_faces(flat_grid(25, 0.2), 20)
           : which == 3 ? with_flat_faces(torus_grid(30, 20), 30)
           : which == 4 ? with_double_faces(torus_grid(30, 20), 30, true)
                        : three_sheets(12);
}
enum { BAD_MESHES = 6 };

/* The largest entry off the diagonal relative to its row, and the largest sum of a row. */
static void check_weights(const sl_matrix *L, double *positive, double *row_sum) {
    const sl_csc A = sl_matrix_view(L);
    double *sum = test_reals((size_t)A.n_cols), *size = test_reals((size_t)A.n_cols);
    *positive = *row_sum = 0;
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            sum[j] += A.x[p];
            size[j] += fabs(A.x[p]);
            if (A.i[p] != j) {
                sum[A.i[p]] += A.x[p];
                size[A.i[p]] += fabs(A.x[p]);
                *positive = fmax(*positive, A.x[p] / (1 + fabs(A.x[p])));
            }
        }
    }
    for (sl_int j = 0; j < A.n_cols; j++) {
        *row_sum = fmax(*row_sum, size[j] > 0 ? fabs(sum[j]) / size[j] : 0);
    }
    free(size);
    free(sum);
}

static double area_of(const mesh *m, const double *lengths) {
    double area = 0;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        area += lengths != NULL ? laplacian_of_lengths(lengths + 3 * f).area
                                : laplacian_of_face(m, m->faces + 3 * f).area;
    }
    return area;
}

/* No weight is negative, rows sum to 0, the area is kept, and heat is positive where it was not. */
static void weights_of_bad_meshes_are_positive(void **state) {
    (void)state;
    for (int which = 0; which < BAD_MESHES; which++) {
        mesh m = bad_mesh(which);
        intrinsic a;
        sl_matrix *L;
        double positive, row_sum;
        assert_true(intrinsic_create(&a, &m));
        assert_true(a.delaunay);
        assert_true(a.share < 1 || which < 4);
        assert_true(laplacian_cotangent_of(&L, &a.m, a.lengths, a.share));
        check_weights(L, &positive, &row_sum);
        double before = area_of(&m, NULL), after = a.share * area_of(&a.m, a.lengths);
        print_message("mesh %d: %lld flips, positive %.1e, sums %.1e, area %.6f of %.6f\n", which,
                      (long long)a.flips, positive, row_sum, after, before);
        assert_true(positive <= 1e-9 && row_sum <= 1e-11);
        assert_true(fabs(after - before) <= 1e-3 * before);
        sl_matrix_free(L);
        intrinsic_free(&a);
        mesh_free(&m);
    }
}

/* A Delaunay mesh is left as it is; a double cover of it has the same Laplacian. */
static void sound_meshes_keep_their_laplacian(void **state) {
    (void)state;
    mesh m = flat_grid(20, 0);
    sl_off negative;
    sl_int flat;
    intrinsic a;
    sl_matrix *L, *M;
    assert_false(intrinsic_is_needed(&m, &negative, &flat));
    assert_true(intrinsic_create(&a, &m));
    assert_true(a.flips == 0 && a.added == 0 && a.share == 1 && a.left_out == 0);
    for (int cover = 0; cover < 2; cover++) {
        assert_true(laplacian_cotangent_of(&L, &a.m, a.lengths, a.share));
        assert_true(laplacian_cotangent(&M, &m));
        const sl_csc A = sl_matrix_view(L), B = sl_matrix_view(M);
        assert_int_equal(A.p[A.n_cols], B.p[B.n_cols]);
        for (sl_int p = 0; p < A.p[A.n_cols]; p++) {
            assert_true(A.i[p] == B.i[p] && fabs(A.x[p] - B.x[p]) <= 1e-12);
        }
        sl_matrix_free(M);
        sl_matrix_free(L);
        intrinsic_free(&a);
        sl_int *f = m.faces; /* turn one face over, then back */
        sl_int swapped = f[1];
        f[1] = f[2];
        f[2] = swapped;
        assert_true(intrinsic_create(&a, &m));
        assert_true(a.share == (cover ? 1 : 0.5) && a.share * a.m.n_faces == m.n_faces);
    }
    intrinsic_free(&a);
    mesh_free(&m);
}

/* Meshes that cannot be used are refused: no length, an index out of range. */
static void useless_meshes_are_refused(void **state) {
    (void)state;
    mesh m = bad_mesh_allocate(3, 1);
    intrinsic a;
    bad_mesh_face(&m, 0, 0, 1, 2);
    assert_false(intrinsic_create(&a, &m));
    assert_null(a.lengths);
    m.xyz[0] = 1;
    m.faces[2] = 3;
    assert_false(intrinsic_create(&a, &m));
    m.faces[2] = 1;
    assert_false(intrinsic_create(&a, &m)); /* the only face has a repeated vertex */
    mesh_free(&m);
}

/* In the plane paths are at least as long as straight lines, and with 3 points nearly as short. */
static void paths_approach_straight_lines(void **state) {
    (void)state;
    mesh m = flat_grid(21, 0.3);
    incidence inc;
    const sl_int source = 220;
    const int points[3] = {0, 1, 3};
    double *u[3], worst[3] = {0, 0, 0};
    assert_true(incidence_create(&inc, &m));
    for (int k = 0; k < 3; k++) {
        u[k] = test_reals((size_t)m.n_vertices);
        surface_search *search;
        assert_true(surface_search_create(&search, &inc, points[k]));
        assert_true(surface_search_run(search, &source, 1, INFINITY));
        memcpy(u[k], surface_search_lengths(search), (size_t)m.n_vertices * sizeof *u[k]);
        surface_search_free(search);
        for (sl_int v = 0; v < m.n_vertices; v++) {
            const double *x = m.xyz + 3 * v, *y = m.xyz + 3 * source;
            double line = hypot(x[0] - y[0], x[1] - y[1]);
            assert_true(u[k][v] >= line * (1 - 1e-12) && (k == 0 || u[k][v] <= u[0][v] + 1e-12));
            worst[k] = line > 0 ? fmax(worst[k], u[k][v] / line - 1) : worst[k];
        }
    }
    print_message("longer than lines by %.3f, %.3f, %.3f\n", worst[0], worst[1], worst[2]);
    assert_true(worst[1] < 0.5 * worst[0] && worst[2] < 0.5 * worst[1] && worst[2] < 0.05);
    surface_search *none;
    assert_false(surface_search_create(&none, &inc, 16));
    assert_null(none);
    for (int k = 0; k < 3; k++) {
        free(u[k]);
    }
    incidence_free(&inc);
    mesh_free(&m);
}

/* Heat is positive and distances are near the paths on all of them; the cotangent Laplacian is
 * used, with a warning, on request. */
static void commands_choose_the_laplacian(void **state) {
    (void)state;
    char line[900], message[200];
    for (int which = 0; which < BAD_MESHES; which++) {
        mesh m = bad_mesh(which);
        int status;
        assert_true(mesh_write(files_path("bad.obj"), &m, NULL, message, sizeof message));
        (void)snprintf(line, sizeof line, "geodesic %s", files_path("bad.obj"));
        char *output = run_command(command_geodesic, line, &status);
        assert_true(status == 0 && strstr(output, "negative heat") == NULL);
        assert_non_null(strstr(output, "\npaths "));
        free(output);
        mesh_free(&m);
    }
    mesh m = bad_mesh(0);
    assert_true(mesh_write(files_path("bad.obj"), &m, NULL, message, sizeof message));
    mesh_free(&m);
    char path[FILE_PATH_SIZE + 100];
    (void)snprintf(path, sizeof path, "%s", files_path("bad.obj"));
    (void)snprintf(line, sizeof line, "heat %s --laplacian cotangent", path);
    command_says(command_heat, line, 0, "negative weights");
    (void)snprintf(line, sizeof line, "adf %s", path);
    command_says(command_adf, line, 0, "Laplacian  intrinsic: ");
    (void)snprintf(line, sizeof line, "hks %s --times 2 --laplacian round", path);
    command_says(command_hks, line, 2, "expected auto, cotangent or intrinsic");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_of_bad_meshes_are_positive),
        cmocka_unit_test(sound_meshes_keep_their_laplacian),
        cmocka_unit_test(useless_meshes_are_refused),
        cmocka_unit_test(paths_approach_straight_lines),
        cmocka_unit_test(commands_choose_the_laplacian),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}
