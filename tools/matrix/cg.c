/* cg.c: conjugate gradients with Jacobi preconditioning, for comparison with local solves */
#include "cg.h"

#include <math.h>

static double dot(const double *a, const double *b, sl_int n) {
    double sum[4] = {0, 0, 0, 0};
    sl_int k = 0;
    for (; k + 4 <= n; k += 4) {
        for (int c = 0; c < 4; c++) {
            sum[c] += a[k + c] * b[k + c];
        }
    }
    for (; k < n; k++) {
        sum[0] += a[k] * b[k];
    }
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* y = A x. Both triangles are stored, so column j is also row j. Returns x' y. */
static double multiply(const sl_csc *A, double *y, const double *x) {
    double product = 0;
    for (sl_int j = 0; j < A->n_cols; j++) {
        double sum = 0;
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            sum += A->x[p] * x[A->i[p]];
        }
        y[j] = sum;
        product += sum * x[j];
    }
    return product;
}

static void inverse_diagonal(const sl_csc *A, double *inverse) {
    for (sl_int j = 0; j < A->n_cols; j++) {
        double d = 0;
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            d += A->i[p] == j ? A->x[p] : 0;
        }
        inverse[j] = d > 0 ? 1 / d : 1;
    }
}

int cg_jacobi(const sl_csc *A, double *x, const double *b, double tolerance, int limit,
              double *work) {
    sl_int n = A->n_cols;
    double *r = work, *p = r + n, *q = p + n, *inverse = q + n;
    double stop = tolerance * sqrt(dot(b, b, n)), rho = 0;
    inverse_diagonal(A, inverse);
    for (sl_int k = 0; k < n; k++) {
        x[k] = 0;
        r[k] = b[k];
        p[k] = inverse[k] * b[k];
        rho += r[k] * p[k];
    }
    int iterations = 0;
    while (iterations < limit && sqrt(dot(r, r, n)) > stop) {
        double curvature = multiply(A, q, p), alpha = rho / curvature, next = 0;
        if (!(curvature > 0 && isfinite(alpha))) {
            return limit;
        }
        for (sl_int k = 0; k < n; k++) {
            x[k] += alpha * p[k];
            r[k] -= alpha * q[k];
            next += r[k] * inverse[k] * r[k];
        }
        double beta = next / rho;
        for (sl_int k = 0; k < n; k++) {
            p[k] = inverse[k] * r[k] + beta * p[k];
        }
        rho = next;
        iterations++;
    }
    return iterations;
}
