/* test_laplacian_degenerate.c: Laplacians of meshes with degenerate, huge or tiny faces */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/check_laplacian.h"

static void degenerate_faces_have_zero_weights(void **state) {
    (void)state;
    const double nan = strtod("nan", NULL), inf = HUGE_VAL;
    double cases[9][9] = {
        {0, 0, 0, 1, 0, 0, 2, 0, 0},      /* on a line */
        {1, 2, 3, 1, 2, 3, 1, 2, 3},      /* one point */
        {0, 0, 0, 0, 0, 0, 1, 1, 1},      /* two equal corners of three */
        {0, 0, 0, 1, 0, 0, 0.5, 1e-9, 0}, /* too flat to be measured */
        {0, 0, 0, 1, 0, 0, nan, 1, 0},    /* not a number */
        {0, 0, 0, inf, 0, 0, 0, 1, 0},
        {-inf, 0, 0, inf, 0, 0, 0, inf, 0},
        {1e308, 0, 0, -1e308, 0, 0, 0, 1e308, 0}, /* the edge overflows */
        {1e200, 0, 0, 0, 1e200, 0, 0, 0, 1e200},  /* the area overflows */
    };
    for (int k = 0; k < 9; k++) {
        mesh m = mesh_of(cases[k], 3, one_face, 1);
        sl_matrix *M = NULL;
        assert_true(laplacian_cotangent(&M, &m));
        sl_csc A = sl_matrix_view(M);
        assert_int_equal(A.p[3], 6); /* the edges stay in the pattern */
        for (sl_int p = 0; p < 6; p++) {
            assert_true(A.x[p] == 0);
        }
        sl_matrix_free(M);
        assert_true(laplacian_system(&M, &m, 0.5));
        A = sl_matrix_view(M);
        assert_is_valid_system(&A);
        sl_matrix_free(M);
        double mass[3];
        laplacian_mass(mass, &m);
        assert_true(mass[0] > 0 && isfinite(mass[0]));
        assert_true(k == 3 || mass[0] == 1);
    }
}

/* Each area fits a double, their sum does not. */
static void masses_do_not_overflow(void **state) {
    (void)state;
    double xyz[9] = {0, 0, 0, 1.3e154, 0, 0, 0, 1.3e154, 0};
    sl_int faces[24];
    for (int k = 0; k < 24; k++) {
        faces[k] = k % 3;
    }
    mesh m = mesh_of(xyz, 3, faces, 8);
    double mass[3];
    laplacian_mass(mass, &m);
    assert_true(mass[0] == 1 && mass[1] == 1 && mass[2] == 1);
    sl_matrix *M = NULL;
    assert_true(laplacian_system(&M, &m, 1));
    sl_csc A = sl_matrix_view(M);
    assert_is_valid_system(&A);
    sl_matrix_free(M);
}

/* Cotangents do not depend on the size of a triangle, over nearly the whole range of a double. */
static void cotangents_do_not_depend_on_scale(void **state) {
    (void)state;
    for (double scale = 1e-300; scale < 1e145; scale *= 1e5) {
        double xyz[9] = {0, 0, 0, scale, 0, 0, 0, scale, 0};
        mesh m = mesh_of(xyz, 3, one_face, 1);
        sl_matrix *L = NULL;
        assert_true(laplacian_cotangent(&L, &m));
        sl_csc A = sl_matrix_view(L);
        assert_true(A.x[0] == 1 && A.x[1] == -0.5 && A.x[2] == -0.5 && A.x[3] == 0.5);
        sl_matrix_free(L);
        assert_true(laplacian_system(&L, &m, 1e200));
        A = sl_matrix_view(L);
        assert_is_valid_system(&A);
        sl_matrix_free(L);
    }
}

static void repeated_and_isolated_vertices_work(void **state) {
    (void)state;
    double xyz[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5, 6, 6, 6};
    sl_int faces[12] = {0, 1, 2, 0, 0, 1, 2, 2, 2, 3, 1, 3};
    mesh m = mesh_of(xyz, 5, faces, 4);
    sl_matrix *M = NULL;
    assert_true(laplacian_cotangent(&M, &m));
    double *full = dense_of(M);
    assert_true(full[0] == 1 && full[1] == -0.5 && full[6] == 0.5);
    assert_true(full[3 + 5 * 3] == 0 && full[4 + 5 * 4] == 0 && full[3 + 5 * 1] == 0);
    free(full);
    sl_matrix_free(M);
    double mass[5];
    laplacian_mass(mass, &m);
    assert_true(near(mass[0], 1.0 / 6, 1) && mass[3] == 1 && mass[4] == 1);
    assert_true(laplacian_system(&M, &m, 1));
    sl_csc A = sl_matrix_view(M);
    assert_is_valid_system(&A);
    assert_int_equal(A.p[5] - A.p[4], 1);
    sl_matrix_free(M);
    /* The edges are 0-1, 1-2, 0-2, 1-3. */
    assert_true(near(mesh_mean_edge_length(&m), (2 + sqrt(2.0) + sqrt(66.0)) / 4, 4));
}

static void bad_meshes_are_refused_and_empty_ones_work(void **state) {
    (void)state;
    sl_int beyond[3] = {0, 1, 3}, below[3] = {0, -1, 2};
    mesh m = mesh_of(known_triangle_xyz, 3, beyond, 1);
    sl_matrix *M = (sl_matrix *)(void *)&m;
    assert_false(laplacian_cotangent(&M, &m));
    assert_null(M);
    m.faces = below;
    assert_false(laplacian_system(&M, &m, 1));
    assert_false(laplacian_uniform(&M, &m, 1));
    assert_true(isnan(mesh_mean_edge_length(&m)));
    m.faces = one_face;
    assert_false(laplacian_system(&M, &m, -1));
    assert_false(laplacian_system(&M, &m, strtod("nan", NULL)));
    assert_false(laplacian_system(&M, &m, 1e201));
    assert_null(M);
    m = mesh_of(NULL, 0, NULL, 0);
    assert_true(laplacian_system(&M, &m, 1));
    assert_int_equal(sl_matrix_view(M).n_cols, 0);
    sl_matrix_free(M);
    assert_true(laplacian_uniform(&M, &m, 1));
    sl_matrix_free(M);
    assert_true(mesh_mean_edge_length(&m) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(degenerate_faces_have_zero_weights),
        cmocka_unit_test(masses_do_not_overflow),
        cmocka_unit_test(cotangents_do_not_depend_on_scale),
        cmocka_unit_test(repeated_and_isolated_vertices_work),
        cmocka_unit_test(bad_meshes_are_refused_and_empty_ones_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
