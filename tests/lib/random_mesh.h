/* random_mesh.h: Laplacians of random meshes: jitter, slivers, wide weights, weak bridges */
#ifndef SL_TEST_RANDOM_MESH_H
#define SL_TEST_RANDOM_MESH_H

#include "gen_matrices.h"

enum { FAMILIES = 4 };

/* A Laplacian under construction: the entries off its diagonal are collected first. */
typedef struct builder_t {
    gen_list_t t;
    double *diagonal;
    sl_int *of; /* the representative row of each row's component */
} builder_t;

static inline void add_edge(builder_t *b, sl_int i, sl_int j, double w) {
    gen_add(&b->t, i > j ? i : j, i > j ? j : i, -w);
    b->diagonal[i] += w;
    b->diagonal[j] += w;
}

static inline double uniform(uint64_t *seed) {
    return 0.5 + 0.5 * gen_real(seed);
}

/* The cotangent of the angle at a, halved. */
static inline double half_cotangent(const double *a, const double *b, const double *c) {
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - a[0], c[1] - a[1]};
    return 0.5 * (u[0] * v[0] + u[1] * v[1]) / fabs(u[0] * v[1] - u[1] * v[0]);
}

/* Weights of the edges from v to the right, up, and up right, in a grid of m columns. */
static inline void cotangent_weights(double *w, const double *P, sl_int m, sl_int rows, sl_int v) {
    const sl_int x = v % m, y = v / m;
    w[0] = w[1] = w[2] = 0.0;
    if (x + 1 < m && y + 1 < rows) {
        w[0] += half_cotangent(P + 2 * (v + m + 1), P + 2 * v, P + 2 * (v + 1));
        w[1] += half_cotangent(P + 2 * (v + m + 1), P + 2 * v, P + 2 * (v + m));
        w[2] = half_cotangent(P + 2 * (v + 1), P + 2 * v, P + 2 * (v + m + 1)) +
               half_cotangent(P + 2 * (v + m), P + 2 * v, P + 2 * (v + m + 1));
    }
    if (x + 1 < m && y > 0) {
        w[0] += half_cotangent(P + 2 * (v - m), P + 2 * v, P + 2 * (v + 1));
    }
    if (y + 1 < rows && x > 0) {
        w[1] += half_cotangent(P + 2 * (v - 1), P + 2 * v, P + 2 * (v + m));
    }
}

/* Adds a grid of m x rows vertices that begins at row `first`. Family 0: springs over some decades;
 * 1: cotangents of a jittered grid; 2: the same with slivers of 1 to 1e-6 degrees between two lines
 * of the grid; 3: springs of 1. */
static inline void add_grid(builder_t *b, sl_int first, sl_int m, sl_int rows, int family,
                            uint64_t *seed) {
    const double decades = 14.0 * uniform(seed), jitter = 0.98 * uniform(seed);
    const double thin = pow(10.0, -6.0 * uniform(seed)) * 0.0175;
    double *P = test_reals(2 * (size_t)(m * rows));
    for (sl_int v = 0; v < m * rows; v++) {
        P[2 * v] = v % m + (family == 1 ? jitter * (uniform(seed) - 0.5) : 0.0);
        P[2 * v + 1] = v / m + (family == 1 ? jitter * (uniform(seed) - 0.5) : 0.0);
        if (family == 2 && v / m > rows / 2) {
            P[2 * v + 1] += thin - 1.0;
        }
    }
    for (sl_int v = 0; v < m * rows; v++) {
        const sl_int to[3] = {v + 1, v + m, v + m + 1};
        const int is_edge[3] = {v % m + 1 < m, v / m + 1 < rows, v % m + 1 < m && v / m + 1 < rows};
        double w[3];
        cotangent_weights(w, P, m, rows, v);
        for (int e = 0; e < 3; e++) {
            const double spring = family == 0 ? pow(10.0, -decades * uniform(seed)) : 1.0;
            if (is_edge[e]) {
                add_edge(b, first + v, first + to[e], family == 1 || family == 2 ? w[e] : spring);
            }
        }
    }
    free(P);
}

/* A random mesh of 1 to 5 components, each of them one grid or two that a weak spring joins. */
static inline gen_matrix_t random_mesh(uint64_t *seed, sl_int **of, sl_int *components) {
    const sl_int m = 3 + gen_below(seed, 10), rows = 3 + gen_below(seed, 10), size = m * rows;
    const sl_int grids = 1 + gen_below(seed, 5);
    const sl_int n = grids * size;
    builder_t b;
    b.t = gen_list(n);
    b.diagonal = test_reals((size_t)n);
    b.of = test_ints((size_t)n);
    *components = grids;
    for (sl_int g = 0; g < grids; g++) {
        add_grid(&b, g * size, m, rows, gen_below(seed, FAMILIES), seed);
        sl_int own = g * size;
        if (g > 0 && gen_below(seed, 2)) { /* a weak bridge to the grid before */
            own = b.of[g * size - 1];
            add_edge(&b, g * size, g * size - 1, pow(10.0, -1.0 - 14.0 * uniform(seed)));
            --*components;
        }
        for (sl_int v = 0; v < size; v++) {
            b.of[g * size + v] = own;
        }
    }
    for (sl_int v = 0; v < n; v++) {
        gen_add(&b.t, v, v, b.diagonal[v]);
    }
    gen_matrix_t M = gen_store(&b.t, gen_style(0), 1);
    *of = b.of;
    gen_list_free(&b.t);
    free(b.diagonal);
    return M;
}

#endif
