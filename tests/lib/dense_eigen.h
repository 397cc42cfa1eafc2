/* dense_eigen.h: eigenvalues and eigenvectors of a dense symmetric matrix, by Jacobi rotations */
#ifndef SL_TEST_DENSE_EIGEN_H
#define SL_TEST_DENSE_EIGEN_H

#include "test.h"

/* A: n x n, column-major; overwritten by a diagonal matrix of the eigenvalues. V: n x n, the
 * orthonormal eigenvectors in its columns. */
static inline void eigen_all(double *A, double *V, int n) {
    for (int k = 0; k < n * n; k++) {
        V[k] = k % (n + 1) == 0;
    }
    for (int sweep = 0; sweep < 60; sweep++) {
        double off = 0, whole = 0;
        for (int k = 0; k < n * n; k++) {
            whole += A[k] * A[k];
            off += k % (n + 1) == 0 ? 0 : A[k] * A[k];
        }
        /* what remains is rounding error */
        if (off <= 4.0 * n * DBL_EPSILON * DBL_EPSILON * whole) {
            return;
        }
        for (int p = 0; p < n; p++) {
            for (int q = p + 1; q < n; q++) {
                double apq = A[p + q * n];
                if (apq == 0) {
                    continue;
                }
                double theta = (A[q + q * n] - A[p + p * n]) / (2 * apq);
                double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1));
                double c = 1 / sqrt(t * t + 1), s = t * c;
                for (int k = 0; k < n; k++) { /* columns p and q of A and V */
                    double x = A[k + p * n], y = A[k + q * n];
                    A[k + p * n] = c * x - s * y;
                    A[k + q * n] = s * x + c * y;
                    x = V[k + p * n], y = V[k + q * n];
                    V[k + p * n] = c * x - s * y;
                    V[k + q * n] = s * x + c * y;
                }
                for (int k = 0; k < n; k++) { /* rows p and q of A */
                    double x = A[p + k * n], y = A[q + k * n];
                    A[p + k * n] = c * x - s * y;
                    A[q + k * n] = s * x + c * y;
                }
            }
        }
    }
    print_error("eigen_all did not converge\n");
    abort();
}

#endif
