/* heat_spectrum.h: all eigenvectors of a small surface, and its heat as a sum over them */
#ifndef TEST_HEAT_SPECTRUM_H
#define TEST_HEAT_SPECTRUM_H

#include "dense_eigen.h"
#include "test.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/surface_generator.h"

typedef struct spectrum {
    mesh m;
    int n;
    double *lambda, *phi; /* phi: n x n, column-major, phi' M phi = 1 */
} spectrum;

static inline spectrum spectrum_of(const char *surface) {
    spectrum s;
    sl_matrix *L = NULL;
    assert_true(surface_generate(&s.m, surface, NULL, 0));
    assert_true(laplacian_cotangent(&L, &s.m));
    sl_csc A = sl_matrix_view(L);
    size_t n = (size_t)A.n_cols;
    double *dense = test_reals(n * n), *mass = test_reals(n);
    s.n = (int)n;
    s.lambda = test_reals(n);
    s.phi = test_reals(n * n);
    laplacian_mass(mass, &s.m);
    for (size_t j = 0; j < n; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            size_t i = (size_t)A.i[p];
            dense[i + j * n] = dense[j + i * n] = A.x[p] / sqrt(mass[i] * mass[j]);
        }
    }
    eigen_all(dense, s.phi, s.n);
    for (size_t k = 0; k < n; k++) {
        s.lambda[k] = dense[k + k * n];
        for (size_t i = 0; i < n; i++) {
            s.phi[i + k * n] /= sqrt(mass[i]);
        }
    }
    free(mass);
    free(dense);
    sl_matrix_free(L);
    return s;
}

static inline void spectrum_free(spectrum *s) {
    mesh_free(&s->m);
    free(s->lambda);
    free(s->phi);
}

static inline double heat_by_sum(const spectrum *s, int i, int j, double t) {
    double sum = 0;
    for (int k = 0; k < s->n; k++) {
        sum += s->phi[i + k * s->n] * s->phi[j + k * s->n] / (1 + t * s->lambda[k]);
    }
    return sum;
}

/* Both computations have an error of n eps times the condition of M + t L, which is
 * 1 + t lambda_max for equal masses. Ten times that allows for the accumulated rounding of the
 * rotations of the eigenvectors. */
static inline double tolerance_of(const spectrum *s, double t) {
    double largest = 0;
    for (int k = 0; k < s->n; k++) {
        largest = s->lambda[k] > largest ? s->lambda[k] : largest;
    }
    return 10 * s->n * DBL_EPSILON * (1 + t * largest);
}

#endif
