/* gen_graphs.h: seeded random numbers, and graphs as triplets of a symmetric matrix */
#ifndef SL_TEST_GEN_GRAPHS_H
#define SL_TEST_GEN_GRAPHS_H

#include "test.h"

/* ---- random numbers: splitmix64, the same on every machine ---- */

static inline uint64_t gen_bits(uint64_t *state) {
    uint64_t z = (*state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* 0 .. bound-1 */
static inline sl_int gen_below(uint64_t *state, sl_int bound) {
    return (sl_int)(gen_bits(state) % (uint64_t)bound);
}

/* in (-1, 1), never 0 */
static inline double gen_real(uint64_t *state) {
    double magnitude = ((double)(gen_bits(state) >> 11) + 1.0) * (1.0 / 9007199254740994.0);
    return gen_bits(state) & 1u ? magnitude : -magnitude;
}

static inline void gen_reals(double *x, size_t count, uint64_t seed) {
    for (size_t k = 0; k < count; k++) {
        x[k] = gen_real(&seed);
    }
}

static inline void gen_permutation(sl_int *perm, sl_int n, uint64_t seed) {
    for (sl_int k = 0; k < n; k++) {
        perm[k] = k;
    }
    for (sl_int k = n - 1; k > 0; k--) {
        sl_int other = gen_below(&seed, k + 1), keep = perm[k];
        perm[k] = perm[other];
        perm[other] = keep;
    }
}

/* count rows of 0 .. n-1 without repetition, in random order; set has room for n */
static inline void gen_set(sl_int *set, sl_int count, sl_int n, uint64_t seed) {
    (void)count;
    gen_permutation(set, n, seed);
}

/* ---- a symmetric matrix as triplets of its lower triangle, each entry at most once ---- */

typedef struct gen_list_t {
    sl_int n;
    size_t count, room;
    sl_int *row, *col; /* row >= col */
    double *x;
} gen_list_t;

static inline gen_list_t gen_list(sl_int n) {
    gen_list_t t = {n, 0, 0, NULL, NULL, NULL};
    return t;
}

static inline void gen_list_free(gen_list_t *t) {
    free(t->row);
    free(t->col);
    free(t->x);
    *t = gen_list(0);
}

static inline void gen_add(gen_list_t *t, sl_int i, sl_int j, double x) {
    if (t->count == t->room) {
        t->room = t->room ? 2 * t->room : 64;
        t->row = (sl_int *)realloc(t->row, t->room * sizeof *t->row);
        t->col = (sl_int *)realloc(t->col, t->room * sizeof *t->col);
        t->x = (double *)realloc(t->x, t->room * sizeof *t->x);
        if (!t->row || !t->col || !t->x) {
            abort();
        }
    }
    t->row[t->count] = i > j ? i : j;
    t->col[t->count] = i > j ? j : i;
    t->x[t->count++] = x;
}

/* Renames the rows at random, so that ties are frequent and no order of the input helps. */
static inline void gen_rename(gen_list_t *t, uint64_t seed) {
    sl_int *name = test_ints((size_t)t->n);
    gen_permutation(name, t->n, seed);
    for (size_t k = 0; k < t->count; k++) {
        const sl_int a = name[t->row[k]], b = name[t->col[k]];
        t->row[k] = a > b ? a : b;
        t->col[k] = a > b ? b : a;
    }
    free(name);
}

/* ---- edges: each function adds those of one kind of graph ---- */

static inline void gen_edges_path(gen_list_t *t, uint64_t *state) {
    for (sl_int k = 1; k < t->n; k++) {
        gen_add(t, k, k - 1, gen_real(state));
    }
}

/* the path over the first m rows, closed to a ring */
static inline void gen_edges_ring(gen_list_t *t, sl_int m, uint64_t *state) {
    for (sl_int k = 1; k < m; k++) {
        gen_add(t, k, k - 1, gen_real(state));
    }
    gen_add(t, m - 1, 0, gen_real(state));
}

/* row c is adjacent to all others */
static inline void gen_edges_star(gen_list_t *t, sl_int c, uint64_t *state) {
    for (sl_int k = 0; k < t->n; k++) {
        if (k != c) {
            gen_add(t, k, c, gen_real(state));
        }
    }
}

static inline void gen_edges_grid(gen_list_t *t, sl_int nx, sl_int ny, sl_int nz, uint64_t *state) {
    for (sl_int z = 0; z < nz; z++) {
        for (sl_int y = 0; y < ny; y++) {
            for (sl_int x = 0; x < nx; x++) {
                sl_int v = x + nx * (y + ny * z);
                if (x > 0) {
                    gen_add(t, v, v - 1, gen_real(state));
                }
                if (y > 0) {
                    gen_add(t, v, v - nx, gen_real(state));
                }
                if (z > 0) {
                    gen_add(t, v, v - nx * ny, gen_real(state));
                }
            }
        }
    }
}

/* an outline of so many rows, extruded to rings; both ends are closed by fans, as in a CAD part */
static inline void gen_edges_fans(gen_list_t *t, sl_int around, uint64_t *state) {
    for (sl_int v = 0; v < t->n; v++) {
        const sl_int next = v % around + 1 < around ? v + 1 : v + 1 - around;
        gen_add(t, v > next ? v : next, v > next ? next : v, gen_real(state));
        if (v >= around) {
            gen_add(t, v, v - around, gen_real(state));
            gen_add(t, v, next - around, gen_real(state));
        }
    }
    for (int end = 0; end < 2; end++) {
        const sl_int first = end == 0 ? 0 : t->n - around;
        for (sl_int step = 1; 3 * step < around;) { /* every step-th row is left in the outline */
            const sl_int fan = 2 << gen_below(state, 5);
            for (sl_int v = 0; v < around; v += fan * step) {
                for (sl_int k = 2; k <= fan && v + k * step < around; k++) {
                    gen_add(t, first + v + k * step, first + v, gen_real(state));
                }
            }
            step *= fan;
        }
    }
}

/* the parent of each row is a random later row; one row in 8 is a root */
static inline void gen_edges_forest(gen_list_t *t, uint64_t *state) {
    for (sl_int k = 0; k + 1 < t->n; k++) {
        if (gen_below(state, 8) != 0) {
            const sl_int up = k + 1 + gen_below(state, t->n - k - 1);
            gen_add(t, up, k, gen_real(state));
        }
    }
}

/* each entry below the diagonal with probability per_mille / 1000 */
static inline void gen_edges_random(gen_list_t *t, sl_int per_mille, uint64_t *state) {
    for (sl_int j = 0; j < t->n; j++) {
        for (sl_int i = j + 1; i < t->n; i++) {
            if (gen_below(state, 1000) < per_mille) {
                gen_add(t, i, j, gen_real(state));
            }
        }
    }
}

/* ---- diagonals ---- */

/* a dominant diagonal: |a_kk| = 1 + sum of the magnitudes in its row; sign: 1, -1 or 0 (random) */
static inline void gen_dominate(gen_list_t *t, int sign, uint64_t *state) {
    double *sum = test_reals((size_t)t->n);
    for (size_t k = 0; k < t->count; k++) {
        sum[t->row[k]] += fabs(t->x[k]);
        sum[t->col[k]] += fabs(t->x[k]);
    }
    for (sl_int k = 0; k < t->n; k++) {
        int s = sign ? sign : (gen_bits(state) & 1u ? 1 : -1);
        gen_add(t, k, k, (1.0 + sum[k]) * (double)s);
    }
    free(sum);
}

/* a graph Laplacian: each edge is -1, each diagonal entry the degree; every row sums to 0 */
static inline void gen_laplacian(gen_list_t *t) {
    sl_int *degree = test_ints((size_t)t->n);
    for (size_t k = 0; k < t->count; k++) {
        t->x[k] = -1.0;
        degree[t->row[k]]++;
        degree[t->col[k]]++;
    }
    for (sl_int k = 0; k < t->n; k++) {
        gen_add(t, k, k, (double)degree[k]);
    }
    free(degree);
}

/* ---- nested dissection of an nx x ny grid: a line of vertices splits the longer side ---- */

static inline sl_int gen_dissect(sl_int *perm, sl_int at, sl_int nx, sl_int x0, sl_int x1,
                                 sl_int y0, sl_int y1) {
    if (x0 >= x1 || y0 >= y1) {
        return at;
    }
    if (x1 - x0 >= y1 - y0) {
        sl_int mid = x0 + (x1 - x0) / 2;
        at = gen_dissect(perm, at, nx, x0, mid, y0, y1);
        at = gen_dissect(perm, at, nx, mid + 1, x1, y0, y1);
        for (sl_int y = y0; y < y1; y++) {
            perm[at++] = mid + nx * y;
        }
    } else {
        sl_int mid = y0 + (y1 - y0) / 2;
        at = gen_dissect(perm, at, nx, x0, x1, y0, mid);
        at = gen_dissect(perm, at, nx, x0, x1, mid + 1, y1);
        for (sl_int x = x0; x < x1; x++) {
            perm[at++] = x + nx * mid;
        }
    }
    return at;
}

#endif
