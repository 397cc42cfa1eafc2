/* judge_matrices.h: dense matrices of judge_systems.h: meshes, trees, products, and weights */
#ifndef SL_TEST_JUDGE_MATRICES_H
#define SL_TEST_JUDGE_MATRICES_H

#include "random_systems.h"

static inline double judge_uniform(uint64_t *state) {
    return 0.5 + 0.5 * gen_real(state);
}

#define CELL(M, n, i, j) (M)[(size_t)(i) * (size_t)(n) + (size_t)(j)]

/* ---- meshes ---- */

/* Adds the cotangents of the triangle a, b, c at positions P. */
static inline void judge_triangle(double *M, sl_int n, const double *P, const sl_int *v) {
    for (int k = 0; k < 3; k++) {
        const sl_int a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
        const double u[2] = {P[2 * b] - P[2 * a], P[2 * b + 1] - P[2 * a + 1]};
        const double w[2] = {P[2 * c] - P[2 * a], P[2 * c + 1] - P[2 * a + 1]};
        const double area = fabs(u[0] * w[1] - u[1] * w[0]);
        system_spring(M, n, b, c, 0.5 * (u[0] * w[0] + u[1] * w[1]) / area);
    }
}

/* The Laplacian of a grid of m columns and as many rows as fit from row `first` on to `last`. */
static inline void judge_mesh(double *M, sl_int n, sl_int first, sl_int last, sl_int m,
                              double jitter, double thin, uint64_t *state) {
    m = m < last - first ? m : last - first;
    const sl_int rows = (last - first) / m;
    double *P = test_reals(2 * (size_t)n);
    for (sl_int k = 0; k < rows * m; k++) {
        P[2 * (first + k)] = k % m + jitter * gen_real(state);
        P[2 * (first + k) + 1] = k / m + jitter * gen_real(state);
        if (thin > 0.0 && k / m > rows / 2) {
            P[2 * (first + k) + 1] += thin - 1.0;
        }
    }
    for (sl_int k = 0; k + m < rows * m; k++) {
        if (k % m + 1 < m) {
            const sl_int v = first + k, a[3] = {v, v + 1, v + m + 1}, b[3] = {v, v + m + 1, v + m};
            judge_triangle(M, n, P, a);
            judge_triangle(M, n, P, b);
        }
    }
    for (sl_int k = rows * m; k < last - first; k++) { /* what is left hangs on the mesh */
        system_spring(M, n, first + k, first + k - 1, 1.0);
    }
    free(P);
}

/* Several grids beside each other; some are joined by one weak spring. */
static inline void judge_bridges(double *M, sl_int n, uint64_t *state) {
    const sl_int parts = 1 + gen_below(state, n < 10 ? 2 : 5), size = n / parts;
    for (sl_int p = 0; p < parts; p++) {
        const sl_int first = p * size, last = p + 1 == parts ? n : first + size;
        const sl_int m = 2 + gen_below(state, 6);
        if (last - first > 2 * m) {
            judge_mesh(M, n, first, last, m, 0.3 * judge_uniform(state), 0.0, state);
        } else {
            for (sl_int k = first + 1; k < last; k++) {
                system_spring(M, n, k, k - 1, system_scale(state, -3.0, 3.0));
            }
        }
        if (p > 0 && gen_below(state, 2)) {
            system_spring(M, n, first, gen_below(state, first), system_scale(state, -15.0, -1.0));
        }
    }
}

/* A random graph without cycles of a random shape, and a few edges more. */
static inline void judge_tree(double *M, sl_int n, double spread, uint64_t *state) {
    const sl_int shape = gen_below(state, 4);
    for (sl_int k = 1; k < n; k++) {
        const sl_int up = shape == 0 ? k - 1 : shape == 1 ? 0 : gen_below(state, k);
        if (shape < 3 || gen_below(state, 8) > 0) {
            system_spring(M, n, k, up, system_scale(state, -spread, 0.0));
        }
    }
    for (sl_int k = 0; k < gen_below(state, 4) && n > 2; k++) {
        const sl_int i = gen_below(state, n - 1);
        system_spring(M, n, i, i + 1, system_scale(state, -spread, 0.0));
    }
}

/* ---- products ---- */

/* M := t L W L + diag(1 / W) for the Laplacian L in M. */
static inline void judge_bilaplacian(double *M, sl_int n, double t, uint64_t *state) {
    double *L = test_reals((size_t)n * (size_t)n), *w = test_reals((size_t)n);
    for (sl_int i = 0; i < n; i++) {
        w[i] = system_scale(state, -1.0, 1.0);
        for (sl_int j = 0; j <= i; j++) {
            CELL(L, n, i, j) = CELL(L, n, j, i) = CELL(M, n, i, j);
        }
    }
    for (sl_int i = 0; i < n; i++) {
        for (sl_int j = 0; j <= i; j++) {
            double sum = 0.0;
            for (sl_int k = 0; k < n; k++) {
                sum += CELL(L, n, i, k) * w[k] * CELL(L, n, k, j);
            }
            CELL(M, n, i, j) = t * sum + (i == j ? 1.0 / w[i] : 0.0);
        }
    }
    free(L);
    free(w);
}

/* M := B B' + e I, where B has `rank` columns with 3 entries each. */
static inline void judge_gram(double *M, sl_int n, sl_int rank, double e, uint64_t *state) {
    for (sl_int c = 0; c < rank; c++) {
        sl_int row[3];
        double x[3];
        for (int k = 0; k < 3; k++) {
            row[k] = gen_below(state, n);
            x[k] = gen_real(state);
        }
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b < 3; b++) {
                if (row[a] >= row[b]) {
                    CELL(M, n, row[a], row[b]) += x[a] * x[b];
                }
            }
        }
    }
    for (sl_int i = 0; i < n; i++) {
        CELL(M, n, i, i) += e;
    }
}

static inline void judge_mass(double *M, sl_int n, double low, double high, uint64_t *state) {
    for (sl_int i = 0; i < n; i++) {
        CELL(M, n, i, i) += system_scale(state, low, high);
    }
}

/* Weights of components with constant null vectors: positive, or one row only. */
static inline double *judge_weights(sl_int n, uint64_t *state) {
    double *m = test_reals((size_t)n);
    const double spread = gen_below(state, 2) ? 6.0 * judge_uniform(state) : 0.0;
    for (sl_int i = 0; i < n; i++) {
        m[i] = system_scale(state, -spread, spread);
    }
    return m;
}

#endif
