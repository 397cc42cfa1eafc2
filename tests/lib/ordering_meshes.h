/* ordering_meshes.h: made-up triangle meshes with points, and the quality of an order */
#ifndef SL_TEST_ORDERING_MESHES_H
#define SL_TEST_ORDERING_MESHES_H

#include "check_factor.h"

typedef enum ordering_mesh {
    MESH_JITTERED,    /* a flat square */
    MESH_ARCHIPELAGO, /* a flat square with 40 islands of all sizes, which leave straits */
    MESH_SPIRAL,      /* a flat strip of five turns */
    MESH_COMB,        /* a flat strip with 20 teeth */
    MESH_TORUS,
    MESH_SCROLL /* a sheet rolled up three times: planes cut several layers */
} ordering_mesh;

/* Is the point p of the unit square part of the mesh? */
static inline int mesh_contains(ordering_mesh kind, const double *p) {
    const double pi = 3.141592653589793;
    const double r = hypot(p[0] - 0.5, p[1] - 0.5), angle = atan2(p[1] - 0.5, p[0] - 0.5);
    const double turns = 10 * r - angle / (2 * pi), teeth = 20 * p[0];
    int inside = 1;
    uint64_t state = 6;
    for (int k = 0; kind == MESH_ARCHIPELAGO && k < 40; k++) {
        const double x = 0.5 + 0.5 * gen_real(&state), y = 0.5 + 0.5 * gen_real(&state);
        const double size = gen_real(&state);
        inside = inside && hypot(p[0] - x, p[1] - y) > 0.02 + 0.1 * size * size * size * size;
    }
    return kind == MESH_SPIRAL ? turns - floor(turns) < 0.6 && r > 0.05 && r < 0.48
           : kind == MESH_COMB ? p[1] < 0.06 || teeth - floor(teeth) < 0.4
                               : inside;
}

/* The point of space of a point of the unit square. */
static inline void mesh_point(ordering_mesh kind, const double *p, double *xyz) {
    const double pi = 3.141592653589793, u = 2 * pi * p[0], v = 2 * pi * p[1];
    if (kind == MESH_TORUS) {
        xyz[0] = (2 + cos(v)) * cos(u);
        xyz[1] = (2 + cos(v)) * sin(u);
        xyz[2] = sin(v);
    } else if (kind == MESH_SCROLL) {
        xyz[0] = (1 + p[0]) * cos(3 * u);
        xyz[1] = (1 + p[0]) * sin(3 * u);
        xyz[2] = 3 * p[1];
    } else {
        xyz[0] = p[0];
        xyz[1] = p[1];
        xyz[2] = 0;
    }
}

static inline double mesh_length(const double *at, sl_int u, sl_int v) {
    return hypot(at[2 * u] - at[2 * v], at[2 * u + 1] - at[2 * v + 1]);
}

/* The pattern of a mesh of at most side x side vertices: squares with their shorter diagonals, of
 * vertices displaced at random. *xyz := three coordinates a vertex, to be freed. */
static inline gen_matrix_t mesh_pattern(ordering_mesh kind, sl_int side, double **xyz) {
    sl_int *name = test_ints((size_t)side * (size_t)side), n = 0;
    const sl_int around = kind == MESH_TORUS; /* neighbors across the border of the square */
    uint64_t state = 4;
    double *at = test_reals(2 * (size_t)side * (size_t)side); /* in the unit square */
    *xyz = test_reals(3 * (size_t)side * (size_t)side);
    for (sl_int v = 0; v < side * side; v++) {
        double *p = at + 2 * (size_t)v;
        p[0] = (v % side + 0.3 * gen_real(&state)) / side;
        p[1] = ((double)(v / side) + 0.3 * gen_real(&state)) / side;
        name[v] = mesh_contains(kind, p) ? n++ : -1;
        if (name[v] != -1) {
            mesh_point(kind, p, *xyz + 3 * (size_t)name[v]);
        }
    }
    gen_list_t t = gen_list(n);
    for (sl_int y = 0; y < side; y++) {
        for (sl_int x = 0; x < side; x++) {
            const sl_int right = (x + 1) % side, up = (y + 1) % side;
            const sl_int va = x + side * y, vb = right + side * y;
            const sl_int vc = x + side * up, vd = right + side * up;
            const sl_int a = name[va], b = name[vb], c = name[vc], d = name[vd];
            const int has_right = around || right > x, has_up = around || up > y;
            const int falls = mesh_length(at, vb, vc) < mesh_length(at, va, vd);
            const sl_int from = falls ? b : a, to = falls ? c : d;
            if (a != -1) {
                gen_add(&t, a, a, 1.0);
            }
            if (has_right && a != -1 && b != -1) {
                gen_add(&t, a > b ? a : b, a > b ? b : a, 1.0);
            }
            if (has_up && a != -1 && c != -1) {
                gen_add(&t, a > c ? a : c, a > c ? c : a, 1.0);
            }
            if (has_right && has_up && from != -1 && to != -1) {
                gen_add(&t, from > to ? from : to, from > to ? to : from, 1.0);
            }
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    free(at);
    free(name);
    return M;
}

/* The pattern of the k-th power of a lower triangle A: joins rows that are up to k edges apart. */
static inline gen_matrix_t mesh_rings(const sl_csc *A, int k) {
    gen_list_t edges = gen_list(A->n_cols), rings = gen_list(A->n_cols);
    sl_int *ball = test_ints((size_t)A->n_cols), *seen = test_ints((size_t)A->n_cols);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            gen_add(&edges, A->i[p], j, 1.0);
        }
    }
    gen_matrix_t both = gen_store(&edges, (gen_style_t){SL_TRIANGLE_BOTH, 0, 0}, 1);
    for (sl_int v = 0; v < A->n_cols; v++) {
        sl_int head = 0, tail = 1;
        ball[0] = v;
        seen[v] = v + 1;
        for (int ring = 0; ring < k; ring++) {
            for (const sl_int end = tail; head < end; head++) {
                for (sl_int p = both.p[ball[head]]; p < both.p[ball[head] + 1]; p++) {
                    if (seen[both.i[p]] != v + 1) {
                        seen[both.i[p]] = v + 1;
                        ball[tail++] = both.i[p];
                    }
                }
            }
        }
        while (tail-- > 0) {
            if (ball[tail] >= v) {
                gen_add(&rings, ball[tail], v, 1.0);
            }
        }
    }
    gen_matrix_t M = gen_store(&rings, gen_style(0), 1);
    gen_matrix_free(&both);
    gen_list_free(&edges);
    gen_list_free(&rings);
    free(ball);
    free(seen);
    return M;
}

/* What an order costs. The path weight of a row is the sum of the column counts from its column to
 * the root: the entries of L that a local solve at that row reads. */
typedef struct order_quality {
    double fill, path; /* entries of L, mean path weight */
} order_quality;

static inline order_quality order_quality_of(const sl_csc *A, const sl_options *opt) {
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, A, opt, NULL));
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    double *path = test_reals((size_t)v.n);
    order_quality q = {0, 0};
    for (sl_int k = v.n - 1; k >= 0; k--) {
        path[k] = (double)v.counts[k] + (v.parent[k] == -1 ? 0 : path[v.parent[k]]);
        q.fill += (double)v.counts[k];
        q.path += path[k] / v.n;
    }
    free(path);
    sl_symbolic_free(S);
    return q;
}

#endif
