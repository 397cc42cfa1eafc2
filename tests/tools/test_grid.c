/* test_grid.c: triangulated grids and tori, and the Laplacians of 2D and 3D grids */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/test.h"

#include "tools/mesh/grid.h"

static void grids_have_the_documented_vertices_and_faces(void **state) {
    (void)state;
    mesh m, same, other;
    assert_true(mesh_grid(&m, 5, 3, 0, 9));
    assert_int_equal(m.n_vertices, 15);
    assert_int_equal(m.n_faces, 16);
    assert_true(m.xyz[3 * 7] == 0.5 && m.xyz[3 * 7 + 1] == 0.25 && m.xyz[3 * 7 + 2] == 0);
    assert_true(m.xyz[3 * 14] == 1 && m.xyz[3 * 14 + 1] == 0.5);
    mesh_free(&m);
    assert_true(mesh_grid(&m, 30, 20, 0.24, 9));
    assert_true(mesh_grid(&same, 30, 20, 0.24, 9));
    assert_true(mesh_grid(&other, 30, 20, 0.24, 10));
    SAME_VALUES(m.xyz, same.xyz, 3 * 600);
    assert_true(first_difference(m.xyz, other.xyz, 3 * 600) >= 0);
    for (sl_int v = 0; v < 600; v++) {
        double dx = m.xyz[3 * v] * 29 - v % 30, dy = m.xyz[3 * v + 1] * 29 - v / 30;
        bool border = v % 30 == 0 || v % 30 == 29 || v / 30 == 0 || v / 30 == 19;
        assert_true(fabs(dx) <= (border ? 1e-14 : 0.24) * 29 &&
                    fabs(dy) <= (border ? 1e-14 : 0.24) * 29);
    }
    for (sl_int f = 0; f < m.n_faces; f++) {
        const double *a = m.xyz + 3 * m.faces[3 * f], *b = m.xyz + 3 * m.faces[3 * f + 1],
                     *c = m.xyz + 3 * m.faces[3 * f + 2];
        assert_true((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
    }
    mesh_free(&m);
    mesh_free(&same);
    mesh_free(&other);
    assert_true(mesh_grid(&m, 1, 1, 0.1, 0));
    assert_int_equal(m.n_vertices, 1);
    assert_int_equal(m.n_faces, 0);
    mesh_free(&m);
    assert_false(mesh_grid(&m, 0, 3, 0, 0));
    assert_false(mesh_grid(&m, 3, 3, -0.1, 0));
    assert_false(mesh_grid(&m, 3, 3, HUGE_VAL, 0));
    assert_false(mesh_grid(&m, 65536, 65536, 0, 0));
    assert_null(m.xyz);
}

/* The torus is closed and oriented: every directed edge occurs once, and so does its reverse. The
 * faces look outward. */
static void a_torus_is_closed_and_oriented(void **state) {
    (void)state;
    const sl_int nu = 9, nv = 5, n = nu * nv;
    mesh m, same;
    char *edge = (char *)test_array((size_t)(n * n), 1);
    double volume = 0;
    assert_true(mesh_torus(&m, nu, nv, 0.2, 4));
    assert_true(mesh_torus(&same, nu, nv, 0.2, 4));
    assert_int_equal(m.n_vertices, n);
    assert_int_equal(m.n_faces, 2 * n);
    assert_memory_equal(m.xyz, same.xyz, 3 * (size_t)n * sizeof *m.xyz);
    for (sl_int f = 0; f < m.n_faces; f++) {
        const sl_int *c = m.faces + 3 * f;
        const double *p = m.xyz + 3 * c[0], *q = m.xyz + 3 * c[1], *r = m.xyz + 3 * c[2];
        for (int k = 0; k < 3; k++) {
            char *here = &edge[c[k] + n * c[(k + 1) % 3]];
            assert_int_equal(*here, 0);
            *here = 1;
        }
        volume += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                  p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
    for (sl_int i = 0; i < n; i++) {
        for (sl_int j = 0; j < n; j++) {
            assert_int_equal(edge[i + n * j], edge[j + n * i]);
        }
    }
    assert_true(volume > 0);
    free(edge);
    mesh_free(&m);
    mesh_free(&same);
    assert_false(mesh_torus(&m, 2, 3, 0, 0));
    assert_false(mesh_torus(&m, 3, 2, 0, 0));
    assert_false(mesh_torus(&m, 3, 3, -0.1, 0));
    assert_false(mesh_torus(&m, 3, 3, HUGE_VAL, 0));
    assert_false(mesh_torus(&m, 65536, 65536, 0, 0));
    assert_null(m.xyz);
}

static void grid_laplacians_have_the_known_entries(void **state) {
    (void)state;
    const sl_int nx = 4, ny = 3, nz = 5;
    sl_matrix *M = NULL;
    assert_true(grid_laplacian_3d(&M, nx, ny, nz, 0.25));
    sl_csc A = sl_matrix_view(M);
    assert_int_equal(A.n_cols, nx * ny * nz);
    /* The diagonal, then the edges along each direction. */
    assert_int_equal(A.p[A.n_cols], 60 + 3 * 3 * 5 + 4 * 2 * 5 + 4 * 3 * 4);
    double *ones = test_reals(60), *y = test_reals(60);
    for (int k = 0; k < 60; k++) {
        ones[k] = 1;
    }
    SL_CHECK(sl_csc_multiply(&A, SL_AS_SYMMETRIC, y, 60, ones, 60, 1));
    for (sl_int j = 0; j < 60; j++) {
        assert_true(y[j] == 0.25);
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            sl_int i = A.i[p];
            sl_int steps = abs(i % nx - j % nx) + abs(i / nx % ny - j / nx % ny) +
                           abs(i / nx / ny - j / nx / ny);
            assert_true(i == j || (i > j && steps == 1 && A.x[p] == -1));
        }
    }
    sl_matrix_free(M);
    free(ones);
    free(y);
    assert_true(grid_laplacian_2d(&M, 100, 100, 0));
    assert_int_equal(sl_matrix_view(M).p[10000], 29800);
    sl_matrix_free(M);
    assert_false(grid_laplacian_3d(&M, 2000, 2000, 2000, 0));
    assert_null(M);
    assert_false(grid_laplacian_2d(&M, 0, 1, 0));
    assert_true(grid_laplacian_2d(&M, 1, 1, 3));
    assert_true(sl_matrix_view(M).x[0] == 3);
    sl_matrix_free(M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grids_have_the_documented_vertices_and_faces),
        cmocka_unit_test(a_torus_is_closed_and_oriented),
        cmocka_unit_test(grid_laplacians_have_the_known_entries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
