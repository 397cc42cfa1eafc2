/* check_laplacian.h: small meshes, and checks of the matrices that are built from meshes */
#ifndef SL_TEST_CHECK_LAPLACIAN_H
#define SL_TEST_CHECK_LAPLACIAN_H

/* The program defines _POSIX_C_SOURCE 200809L before its first include. */
#include "test.h"

#include "tools/geometry/laplacian.h"

static double known_triangle_xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static sl_int one_face[3] = {0, 1, 2};

static inline mesh mesh_of(double *xyz, sl_int n_vertices, sl_int *faces, sl_int n_faces) {
    mesh m = {n_vertices, n_faces, xyz, faces};
    return m;
}

/* The full square matrix of a lower triangle, column-major; the caller frees it. */
static inline double *dense_of(const sl_matrix *M) {
    sl_csc A = sl_matrix_view(M);
    size_t n = (size_t)A.n_cols;
    double *full = test_reals(n * n);
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            assert_true(A.i[p] >= j);
            full[(size_t)A.i[p] + n * (size_t)j] = A.x[p];
            full[(size_t)j + n * (size_t)A.i[p]] = A.x[p];
        }
    }
    return full;
}

static inline bool near(double a, double b, double scale) {
    return fabs(a - b) <= 1e-14 * scale;
}

/* Each row sums to `sum`, up to the rounding errors of its own entries. */
static inline void assert_rows_sum_to(const sl_csc *A, double sum) {
    size_t n = (size_t)A->n_cols;
    double *total = test_reals(n);
    double *size = test_reals(n);
    double *length = test_reals(n);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            sl_int i = A->i[p];
            total[i] += A->x[p];
            size[i] += fabs(A->x[p]);
            length[i] += 1;
            if (i != j) {
                total[j] += A->x[p];
                size[j] += fabs(A->x[p]);
                length[j] += 1;
            }
        }
    }
    for (size_t i = 0; i < n; i++) {
        /* An off-diagonal weight is a sum over the faces on both sides of an edge; its rounding
         * error and that of the diagonal are a few eps times the size of the row. Weights of obtuse
         * faces cancel inside an entry, hence the margin. */
        assert_true(fabs(total[i] - sum) <=
                    16 * DBL_EPSILON * (length[i] + 1) * (size[i] + fabs(sum)));
    }
    free(total);
    free(size);
    free(length);
}

static inline double quadratic_form(const sl_csc *A, const double *x) {
    double *y = test_reals((size_t)A->n_rows);
    size_t ld = A->n_rows > 0 ? (size_t)A->n_rows : 1;
    SL_CHECK(sl_csc_multiply(A, SL_AS_SYMMETRIC, y, ld, x, ld, 1));
    double sum = 0;
    for (sl_int i = 0; i < A->n_rows; i++) {
        sum += x[i] * y[i];
    }
    free(y);
    return sum;
}

/* A lower triangle that can be factored: it stores the whole diagonal, all entries are finite, and
 * the diagonal is positive. */
static inline void assert_is_valid_system(const sl_csc *A) {
    SL_CHECK(sl_csc_check(A, NULL));
    for (sl_int j = 0; j < A->n_cols; j++) {
        assert_true(A->p[j] < A->p[j + 1] && A->i[A->p[j]] == j);
        assert_true(A->x[A->p[j]] > 0);
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            assert_true(A->i[p] >= j && isfinite(A->x[p]));
        }
    }
}

#endif
