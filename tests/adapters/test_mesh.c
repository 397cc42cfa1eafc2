/* test_mesh.c: matrices of a mesh in the caller's arrays, and products, against known values */
#include "tests/lib/test.h"

#include "tools/adapters/sparse_local_mesh.h"

/* A unit square of two right triangles, and a vertex of no face. */
static const double square[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}};
static const sl_int halves[2][3] = {{0, 1, 2}, {0, 2, 3}};

static sl_status matrices(sl_matrix **L, sl_matrix **M, const sl_mesh *mesh) {
    const sl_status status = sl_mesh_matrix(L, mesh, 0, 1, NULL, NULL);
    *M = NULL;
    return status == SL_OK ? sl_mesh_matrix(M, mesh, 1, 0, NULL, NULL) : status;
}

static double entry(const sl_matrix *M, sl_int row, sl_int column) {
    const sl_csc A = sl_matrix_view(M);
    double sum = 0;
    for (sl_int p = A.p[column]; p < A.p[column + 1]; p++) {
        sum += A.i[p] == row ? A.x[p] : 0;
    }
    return sum;
}

static void check_square(const sl_mesh *mesh) {
    static const double expected[5][5] = {{1, -0.5, 0, -0.5, 0},
                                          {-0.5, 1, -0.5, 0, 0},
                                          {0, -0.5, 1, -0.5, 0},
                                          {-0.5, 0, -0.5, 1, 0},
                                          {0, 0, 0, 0, 0}};
    static const double masses[5] = {1 / 3.0, 1 / 6.0, 1 / 3.0, 1 / 6.0, 1};
    sl_matrix *L, *M;
    assert_true(matrices(&L, &M, mesh) == SL_OK);
    for (sl_int i = 0; i < 5; i++) {
        assert_true(fabs(entry(M, i, i) - masses[i]) < 1e-15);
        for (sl_int j = 0; j < 5; j++) {
            assert_true(fabs(entry(L, i, j) - expected[i][j]) < 1e-15);
        }
    }
    assert_true(sl_matrix_view(M).p[5] == 5);
    sl_matrix_free(L);
    sl_matrix_free(M);
    assert_true(sl_mesh_matrix(&L, mesh, 3, 2, NULL, NULL) == SL_OK);
    for (sl_int i = 0; i < 5; i++) {
        for (sl_int j = 0; j < 5; j++) {
            const double sum = 2 * expected[i][j] + 3 * (i == j ? masses[i] : 0);
            assert_true(fabs(entry(L, i, j) - sum) < 4e-15);
        }
    }
    sl_matrix_free(L);
}

static void strides_and_floats_are_read(void **state) {
    (void)state;
    struct {
        float xyz[3], color;
    } wide[5];
    sl_int faces[2][4];
    for (int v = 0; v < 5; v++) {
        for (int c = 0; c < 3; c++) {
            wide[v].xyz[c] = (float)square[v][c];
        }
        wide[v].color = NAN;
    }
    for (int f = 0; f < 2; f++) {
        memcpy(faces[f], halves[f], sizeof halves[f]);
        faces[f][3] = -7;
    }
    const sl_mesh tight = {5, 2, square, 0, 0, halves[0], 0};
    const sl_mesh strided = {5, 2, wide, sizeof *wide, 1, faces[0], sizeof *faces};
    check_square(&tight);
    check_square(&strided);
}

static void flat_and_obtuse_faces_are_measured(void **state) {
    (void)state;
    const double xyz[4][3] = {{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {2, 0, 0}};
    const sl_int faces[3][3] = {{0, 1, 2}, {0, 1, 3}, {2, 2, 1}}; /* obtuse, flat, vertex twice */
    const sl_mesh mesh = {4, 3, xyz, 0, 0, faces[0], 0};
    sl_matrix *L, *M;
    assert_true(matrices(&L, &M, &mesh) == SL_OK);
    assert_true(fabs(entry(L, 0, 1) - 0.375) < 1e-15); /* cot(126.9 degrees) = -3/4 */
    assert_true(entry(L, 3, 3) == 0 && entry(M, 3, 3) == 1);
    for (sl_int j = 0; j < 4; j++) {
        double sum = 0;
        for (sl_int i = 0; i < 4; i++) {
            sum += entry(L, i, j);
        }
        assert_true(fabs(sum) < 1e-15);
    }
    sl_matrix_free(L);
    sl_matrix_free(M);
}

static void check_refused(const sl_mesh *mesh, sl_status expected, sl_int row) {
    sl_matrix *A;
    sl_stats stats;
    assert_true(sl_mesh_matrix(&A, mesh, 1, 0.1, NULL, &stats) == expected);
    assert_true(stats.error.row == row && stats.error.what != NULL && A == NULL);
}

static void wrong_meshes_are_refused(void **state) {
    (void)state;
    const sl_int outside[2][3] = {{0, 1, 2}, {0, 5, 1}};
    double bad[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}};
    sl_mesh mesh = {5, 2, square, 0, 0, outside[0], 0};
    check_refused(&mesh, SL_ERR_ARGUMENT, 1);
    mesh.n_faces = INT32_MAX; /* refused before a face is read */
    check_refused(&mesh, SL_ERR_TOO_LARGE, -1);
    mesh.n_faces = -1;
    check_refused(&mesh, SL_ERR_ARGUMENT, -1);
    check_refused(NULL, SL_ERR_ARGUMENT, -1);
    const sl_mesh one = {3, 1, bad, 0, 0, halves[0], 0};
    check_refused(&one, SL_ERR_NOT_FINITE, 2);
    bad[2][1] = 1e200, bad[1][0] = 1e200;
    check_refused(&one, SL_ERR_NOT_FINITE, 0);
    sl_matrix *A;
    assert_true(sl_mesh_matrix(NULL, &mesh, 1, 1, NULL, NULL) == SL_ERR_ARGUMENT);
    assert_true(sl_mesh_matrix(&A, &mesh, INFINITY, 1, NULL, NULL) == SL_ERR_ARGUMENT);
    const sl_mesh empty = {0, 0, NULL, 0, 0, NULL, 0};
    sl_matrix *L, *M;
    assert_true(matrices(&L, &M, &empty) == SL_OK);
    sl_matrix_free(L);
    sl_matrix_free(M);
}

static void products_are_right(void **state) {
    (void)state;
    const sl_mesh mesh = {5, 2, square, 0, 0, halves[0], 0};
    sl_matrix *L, *M, *C;
    assert_true(matrices(&L, &M, &mesh) == SL_OK);
    const sl_csc A = sl_matrix_view(L);
    double d[5];
    for (sl_int k = 0; k < 5; k++) {
        d[k] = 1 / entry(M, k, k);
    }
    assert_true(sl_matrix_product(&C, &A, d, &A, NULL, NULL) == SL_OK);
    for (sl_int i = 0; i < 5; i++) {
        for (sl_int j = 0; j < 5; j++) {
            double sum = 0;
            for (sl_int k = 0; k < 5; k++) {
                sum += entry(L, i, k) * d[k] * entry(L, k, j);
            }
            assert_true(fabs(entry(C, i, j) - sum) < 1e-14);
        }
    }
    sl_matrix_free(C);
    sl_csc other = A;
    other.n_cols = 4;
    assert_true(sl_matrix_product(&C, &other, NULL, &A, NULL, NULL) == SL_ERR_ARGUMENT);
    assert_true(C == NULL);
    sl_matrix_free(L);
    sl_matrix_free(M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strides_and_floats_are_read),
        cmocka_unit_test(flat_and_obtuse_faces_are_measured),
        cmocka_unit_test(wrong_meshes_are_refused),
        cmocka_unit_test(products_are_right),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
