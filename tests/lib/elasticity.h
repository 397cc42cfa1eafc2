/* elasticity.h: stiffness matrices of elastic bodies in 2D and 3D, linear elements, and their rigid
 * motions */
#ifndef SL_TEST_ELASTICITY_H
#define SL_TEST_ELASTICITY_H

#include "graph_laplacian.h"

/* A box of cells, each cut into 2 triangles or 6 tetrahedra. Cells of one layer, between node
 * layers x and x + 1, have a common factor of stiffness; 0 cuts the body there. */
typedef struct elastic_t {
    int dim;             /* 2 or 3 */
    sl_int nodes[3];     /* in each direction; 1 in z for dim 2 */
    sl_int n;            /* rows: dim for each node */
    double *at;          /* nodes x dim: positions */
    double *layer;       /* nodes[0] - 1: factors of stiffness */
    sl_int *body;        /* n: the number of each row's body, or -1 in a row of zeros */
    sl_int bodies, null; /* how many bodies, and null vectors in all */
    sl_matrix *M;
    sl_csc A;
    double *Z; /* n x rigid: translations and rotations */
    sl_int rigid;
} elastic_t;

static inline double elastic_uniform(uint64_t *seed) {
    return 0.5 + 0.5 * gen_real(seed);
}

/* The gradients of the linear functions of an element, dim + 1 rows; returns its volume. */
static inline double elastic_gradients(int dim, const double *const *at, double (*g)[3]) {
    double e[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}, volume = 0.0;
    for (int k = 0; k < dim; k++) {
        for (int c = 0; c < dim; c++) {
            e[k][c] = at[k + 1][c] - at[0][c];
        }
    }
    for (int c = 0; c < dim; c++) { /* the columns of the inverse of e are those of node k + 1 */
        g[0][c] = 0.0;
        for (int k = 0; k < dim; k++) {
            const double *u = e[(k + 1) % 3], *v = e[(k + 2) % 3];
            g[k + 1][c] = u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3];
        }
    }
    for (int c = 0; c < dim; c++) {
        volume += e[0][c] * g[1][c];
    }
    for (int c = 0; c < dim; c++) {
        for (int k = 0; k < dim; k++) {
            g[k + 1][c] /= volume;
            g[0][c] -= g[k + 1][c];
        }
    }
    return fabs(volume) / (dim == 2 ? 2.0 : 6.0);
}

/* Adds an element with Lame's constants lambda and mu: for nodes a, b and directions c, d the entry
 * volume (lambda g_a(c) g_b(d) + mu g_a(d) g_b(c) + (c = d) mu g_a' g_b). */
static inline void elastic_add(gen_list_t *t, const elastic_t *y, const sl_int *nodes,
                               double lambda, double mu) {
    const double *at[4];
    double g[4][3];
    for (int k = 0; k <= y->dim; k++) {
        at[k] = y->at + nodes[k] * y->dim;
    }
    const double volume = elastic_gradients(y->dim, at, g);
    for (int ac = 0; ac < (y->dim + 1) * y->dim; ac++) {
        for (int bd = 0; bd < (y->dim + 1) * y->dim; bd++) {
            const int a = ac / y->dim, c = ac % y->dim, b = bd / y->dim, d = bd % y->dim;
            const sl_int i = nodes[a] * y->dim + c, j = nodes[b] * y->dim + d;
            double x = lambda * g[a][c] * g[b][d] + mu * g[a][d] * g[b][c];
            for (int k = 0; k < y->dim && c == d; k++) {
                x += mu * g[a][k] * g[b][k];
            }
            if (i >= j) {
                gen_add(t, i, j, volume * x);
            }
        }
    }
}

static inline sl_int elastic_node(const elastic_t *y, sl_int a, sl_int b, sl_int c) {
    return a + y->nodes[0] * (b + y->nodes[1] * c);
}

/* Adds the elements of all cells; their stiffness varies over some decades. */
static inline void elastic_cells(gen_list_t *t, const elastic_t *y, double decades,
                                 uint64_t *seed) {
    static const int paths[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1},
                                    {2, 0, 1}, {1, 2, 0}, {2, 1, 0}};
    for (sl_int cell = 0; cell < y->nodes[0] * y->nodes[1] * y->nodes[2]; cell++) {
        const sl_int from[3] = {cell % y->nodes[0], cell / y->nodes[0] % y->nodes[1],
                                cell / y->nodes[0] / y->nodes[1]};
        if (from[0] + 1 == y->nodes[0] || from[1] + 1 == y->nodes[1] ||
            (y->dim == 3 && from[2] + 1 == y->nodes[2]) || y->layer[from[0]] == 0.0) {
            continue;
        }
        for (int p = 0; p < (y->dim == 2 ? 2 : 6); p++) { /* along a path over the cell's edges */
            const double stiff = y->layer[from[0]] * pow(10.0, -decades * elastic_uniform(seed));
            sl_int to[3] = {from[0], from[1], from[2]}, nodes[4];
            nodes[0] = elastic_node(y, to[0], to[1], to[2]);
            for (int k = 0; k < y->dim; k++) {
                to[paths[p][k]]++;
                nodes[k + 1] = elastic_node(y, to[0], to[1], to[2]);
            }
            elastic_add(t, y, nodes, stiff * elastic_uniform(seed), stiff);
        }
    }
}

/* Places the nodes: jittered, turned in the plane of x and y, thin in the last direction. */
static inline void elastic_place(elastic_t *y, double jitter, double thin, uint64_t *seed) {
    const double turn = elastic_uniform(seed);
    for (sl_int node = 0; node < y->n / y->dim; node++) {
        double p[3] = {node % y->nodes[0], node / y->nodes[0] % y->nodes[1],
                       node / y->nodes[0] / y->nodes[1]};
        for (int c = 0; c < y->dim; c++) {
            p[c] += jitter * gen_real(seed);
        }
        p[y->dim - 1] *= thin;
        y->at[node * y->dim] = cos(turn) * p[0] - sin(turn) * p[1];
        y->at[node * y->dim + 1] = sin(turn) * p[0] + cos(turn) * p[1];
        if (y->dim == 3) {
            y->at[node * 3 + 2] = p[2];
        }
    }
}

/* Finds the bodies, and the rows of zeros of nodes without a cell. */
static inline void elastic_bodies(elastic_t *y) {
    sl_int *body = test_ints((size_t)y->nodes[0]);
    y->bodies = y->null = 0;
    for (sl_int x = 0; x < y->nodes[0]; x++) {
        const int is_joined = x > 0 && y->layer[x - 1] != 0.0;
        const int is_alone = !is_joined && (x + 1 == y->nodes[0] || y->layer[x] == 0.0);
        body[x] = is_alone ? -1 : is_joined ? body[x - 1] : y->bodies++;
    }
    for (sl_int i = 0; i < y->n; i++) {
        y->body[i] = body[i / y->dim % y->nodes[0]];
        y->null += y->body[i] == -1;
    }
    y->null += y->bodies * y->rigid;
    free(body);
}

/* Translations, and rotations about `center`, by columns. */
static inline void elastic_rigid(const elastic_t *y, double *Z, const double *center) {
    for (sl_int i = 0; i < y->n; i++) {
        const int c = (int)(i % y->dim);
        const double *p = y->at + i / y->dim * y->dim;
        Z[i + c * y->n] = 1.0;
        for (int r = 0; r < y->rigid - y->dim; r++) { /* about an axis: from direction a to b */
            const int a = r == 2 ? 1 : 0, b = r == 0 ? 1 : 2;
            Z[i + (y->dim + r) * y->n] = c == a   ? -(p[b] - center[b])
                                         : c == b ? p[a] - center[a]
                                                  : 0.0;
        }
    }
}

/* A random system. decades: of stiffness within a body; thin: the height of a cell. Where there are
 * cuts, some layers are missing and some are weaker by `weak`. */
static inline elastic_t elastic_make(int dim, sl_int size, double decades, double thin, double weak,
                                     int cuts, uint64_t *seed) {
    static const double origin[3] = {0.0, 0.0, 0.0};
    elastic_t y;
    memset(&y, 0, sizeof y);
    y.dim = dim;
    y.rigid = dim == 2 ? 3 : 6;
    for (int c = 0; c < 3; c++) {
        y.nodes[c] = c == dim ? 1 : 2 + gen_below(seed, size);
    }
    y.nodes[0] += cuts ? 2 : 0;
    y.n = dim * y.nodes[0] * y.nodes[1] * y.nodes[2];
    y.at = test_reals((size_t)y.n);
    y.layer = test_reals((size_t)y.nodes[0]);
    y.body = test_ints((size_t)y.n);
    y.Z = test_reals((size_t)(y.n * y.rigid));
    for (sl_int x = 0; x + 1 < y.nodes[0]; x++) {
        const sl_int kind = cuts ? gen_below(seed, 4) : 2;
        y.layer[x] = kind == 0 ? 0.0 : kind == 1 ? weak : 1.0;
    }
    elastic_place(&y, 0.25 * elastic_uniform(seed), thin, seed);
    elastic_bodies(&y);
    elastic_rigid(&y, y.Z, origin);
    gen_list_t t = gen_list(y.n);
    elastic_cells(&t, &y, decades, seed);
    SL_CHECK(
        sl_matrix_from_triplets(&y.M, y.n, y.n, (sl_off)t.count, t.row, t.col, t.x, NULL, NULL));
    y.A = sl_matrix_view(y.M);
    gen_list_free(&t);
    return y;
}

static inline sl_options options_rigid(const elastic_t *y, const variant_list_t *variants, int k) {
    sl_options opt = options_skip_null(variants, k);
    opt.null_vector = y->Z;
    opt.null_vector_count = y->rigid;
    return opt;
}

/* A right-hand side that has a solution. */
static inline double *consistent(const sl_csc *A, uint64_t seed) {
    const size_t n = (size_t)A->n_cols;
    double *x = test_reals(n), *b = test_reals(n);
    gen_reals(x, n, seed);
    SL_CHECK(sl_csc_multiply(A, SL_AS_SYMMETRIC, b, n, x, n, 1));
    free(x);
    return b;
}

static inline void elastic_free(elastic_t *y) {
    free(y->at);
    free(y->layer);
    free(y->body);
    free(y->Z);
    sl_matrix_free(y->M);
}

#endif
