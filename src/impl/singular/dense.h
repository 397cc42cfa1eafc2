/* dense.h: dense operations on as many numbers as there are null vectors */
#ifndef SLI_SINGULAR_DENSE_H
#define SLI_SINGULAR_DENSE_H

#include "../factor/factor_types.h"

/* Matrices are row-major: vector v of count numbers begins at v count. */

/* x -= q q' x, twice, for each of the orthonormal vectors q; returns |x|. */
static double sli_null_project(const double *q, sl_int vectors, sl_int count, double *x) {
    double sum = 0.0;
    sl_int v, j;
    int pass;
    for (pass = 0; pass < 2; pass++) {
        for (v = 0; v < vectors; v++) {
            double dot = 0.0;
            for (j = 0; j < count; j++) {
                dot += q[v * count + j] * x[j];
            }
            for (j = 0; j < count; j++) {
                x[j] -= dot * q[v * count + j];
            }
        }
    }
    for (j = 0; j < count; j++) {
        sum += x[j] * x[j];
    }
    return sqrt(sum);
}

/* c := count - vectors orthonormal vectors that are orthogonal to q. */
static void sli_null_complement(const double *q, sl_int vectors, sl_int count, double *c) {
    double all[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX], x[SLI_NULL_VECTORS_MAX];
    sl_int v, i, j;
    SLI_COPY(all, q, (size_t)(vectors * count));
    for (v = vectors; v < count; v++) {
        double most = -1.0;
        for (i = 0; i < count; i++) {
            double norm;
            memset(x, 0, sizeof x);
            x[i] = 1.0;
            norm = sli_null_project(all, v, count, x);
            if (norm > most) {
                most = norm;
                for (j = 0; j < count; j++) {
                    all[v * count + j] = x[j] / norm;
                }
            }
        }
    }
    SLI_COPY(c, all + vectors * count, (size_t)((count - vectors) * count));
}

/* a := the inverse of a, m x m, row-major and regular. */
static void sli_null_invert(double *a, sl_int m) {
    double b[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX];
    sl_int i, j, k;
    memset(b, 0, sizeof b);
    for (k = 0; k < m; k++) {
        b[k * m + k] = 1.0;
    }
    for (k = 0; k < m; k++) { /* Gauss and Jordan, with row exchanges */
        sl_int at = k;
        double inverse;
        for (i = k + 1; i < m; i++) {
            at = fabs(a[i * m + k]) > fabs(a[at * m + k]) ? i : at;
        }
        inverse = 1.0 / a[at * m + k];
        for (j = 0; j < m; j++) {
            const double x = a[at * m + j] * inverse, y = b[at * m + j] * inverse;
            a[at * m + j] = a[k * m + j];
            b[at * m + j] = b[k * m + j];
            a[k * m + j] = x;
            b[k * m + j] = y;
        }
        for (i = 0; i < m; i++) {
            const double c = a[i * m + k];
            for (j = 0; j < m && i != k; j++) {
                a[i * m + j] -= c * a[k * m + j];
                b[i * m + j] -= c * b[k * m + j];
            }
        }
    }
    SLI_COPY(a, b, (size_t)(m * m));
}

#endif
