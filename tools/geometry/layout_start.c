/* layout_start.c: layouts with the boundary on a circle: harmonic, or without flipped faces */
#include "layout_start.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "laplacian.h"
#include "tools/matrix/triplets.h"

static const double pi = 3.14159265358979323846;

/* ---- the boundary ---- */

/* The length of edge k of a loop of count vertices. */
static double edge_length(const mesh *m, const sl_int *loop, sl_int k, sl_int count) {
    const double *a = m->xyz + 3 * (size_t)loop[k];
    const double *b = m->xyz + 3 * (size_t)loop[k + 1 < count ? k + 1 : 0];
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

bool layout_boundary_find(layout_boundary *out, const sheet *s) {
    const size_t room = 3 * (size_t)s->m.n_faces + 1;
    double longest = -1;
    memset(out, 0, sizeof *out);
    out->vertex = (sl_int *)malloc(room * sizeof *out->vertex);
    out->begin = (sl_int *)malloc(room * sizeof *out->begin);
    out->n_loops =
        out->vertex != NULL && out->begin != NULL ? sheet_boundary(s, out->vertex, out->begin) : -1;
    if (out->n_loops < 0) {
        layout_boundary_free(out);
        return false;
    }
    for (sl_int k = 0; k < out->n_loops; k++) {
        const sl_int count = out->begin[k + 1] - out->begin[k];
        double length = 0;
        for (sl_int e = 0; e < count; e++) {
            length += edge_length(&s->m, out->vertex + out->begin[k], e, count);
        }
        out->outer = length > longest ? k : out->outer;
        longest = fmax(longest, length);
    }
    return true;
}

void layout_boundary_free(layout_boundary *b) {
    free(b->vertex);
    free(b->begin);
    memset(b, 0, sizeof *b);
}

/* ---- the system ---- */

/* Adds an edge of weight w to the Laplacian. */
static bool add_edge(triplets *list, sl_int u, sl_int v, double w) {
    return u == v || (triplets_add(list, u > v ? u : v, u > v ? v : u, -w) &&
                      triplets_add(list, u, u, w) && triplets_add(list, v, v, w));
}

/* The weight of the edge of a side: the sum over its faces. */
static double edge_weight(const sheet *s, sl_int side) {
    const laplacian_face here = laplacian_of_face(&s->m, s->m.faces + side / 3 * 3);
    double weight = here.weight[side % 3];
    if (s->mate[side] >= 0) {
        const laplacian_face there = laplacian_of_face(&s->m, s->m.faces + s->mate[side] / 3 * 3);
        weight += there.weight[s->mate[side] % 3];
    }
    return weight;
}

static bool add_faces(triplets *list, const sheet *s, layout_weights weights) {
    const double least = 0.01, most = 100; /* the cotangents of good faces are about 1 */
    bool ok = true;
    for (sl_int side = 0; side < 3 * s->m.n_faces && ok; side++) {
        if (s->mate[side] > side) {
            continue; /* once for each edge */
        }
        double w = weights == WEIGHTS_EQUAL ? 1 : edge_weight(s, side);
        w = weights == WEIGHTS_POSITIVE ? fmin(most, fmax(least, w)) : w;
        ok = add_edge(list, sheet_from(s, side), sheet_to(s, side), w);
    }
    return ok;
}

/* A vertex in each hole, numbered after those of the mesh. Two edges close a hole without one. */
static bool fill_holes(triplets *list, const layout_boundary *b, sl_int *n) {
    bool ok = true;
    for (sl_int k = 0; k < b->n_loops && ok; k++) {
        if (k == b->outer || b->begin[k + 1] - b->begin[k] < 3) {
            continue;
        }
        for (sl_int at = b->begin[k]; at < b->begin[k + 1] && ok; at++) {
            ok = add_edge(list, b->vertex[at], *n, 1);
        }
        ++*n;
    }
    return ok;
}

/* Positions on a circle whose circumference is the length of the loop; evenly if that is 0. Edges
 * have a length of at least a hundredth of the mean, so that none is lost in rounding. */
static void to_circle(double *G, const mesh *m, const sl_int *loop, sl_int count) {
    double total = 0, all = 0, so_far = 0;
    for (sl_int k = 0; k < count; k++) {
        total += edge_length(m, loop, k, count);
    }
    const double least = total > 0 ? 0.01 * total / (double)count : 1;
    for (sl_int k = 0; k < count; k++) {
        all += fmax(least, edge_length(m, loop, k, count));
    }
    for (sl_int k = 0; k < count; k++) {
        G[k] = all / (2 * pi) * cos(2 * pi * so_far / all);
        G[count + k] = all / (2 * pi) * sin(2 * pi * so_far / all);
        so_far += fmax(least, edge_length(m, loop, k, count));
    }
}

/* Solves A x = 0 with the vertices of a loop fixed; X is n x 2. */
static sl_status solve(double *X, const sl_matrix *A, const mesh *m, const sl_int *loop,
                       sl_int count) {
    const sl_csc view = sl_matrix_view(A);
    const size_t n = (size_t)view.n_cols;
    double *G = (double *)malloc(2 * (size_t)count * sizeof *G);
    sl_fixed *D = NULL;
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.pivots = SL_PIVOTS_SKIP_NULL; /* vertices whose faces have no weights */
    opt.consistency_tolerance = -1;
    sl_status status = G != NULL ? SL_OK : SL_ERR_MEMORY;
    if (status == SL_OK) {
        to_circle(G, m, loop, count);
        status = sl_fixed_create(&D, &view, loop, count, &opt, NULL);
    }
    if (status == SL_OK) {
        status = sl_fixed_solve(D, X, n, NULL, 0, G, (size_t)count, 2, NULL);
    }
    sl_fixed_free(D);
    free(G);
    return status;
}

sl_status layout_on_circle(double *uv, const sheet *s, const layout_boundary *b,
                           layout_weights weights) {
    const sl_int *loop = b->vertex + b->begin[b->outer];
    const sl_int count = b->begin[b->outer + 1] - b->begin[b->outer];
    sl_int n = s->m.n_vertices;
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_matrix *A = NULL;
    if (!add_faces(&list, s, weights) ||
        (weights != WEIGHTS_COTANGENT && !fill_holes(&list, b, &n))) {
        triplets_free(&list);
        return SL_ERR_MEMORY;
    }
    double *X = (double *)malloc(2 * (size_t)n * sizeof *X);
    sl_status status = triplets_finish(&A, n, n, &list, true);
    status = status == SL_OK && X == NULL ? SL_ERR_MEMORY : status;
    status = status == SL_OK ? solve(X, A, &s->m, loop, count) : status;
    for (sl_int v = 0; v < s->m.n_vertices && status == SL_OK; v++) {
        uv[2 * v] = X[v];
        uv[2 * v + 1] = X[n + v];
    }
    sl_matrix_free(A);
    free(X);
    return status;
}
