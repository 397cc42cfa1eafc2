/* harmonic_map.c: harmonic layouts of a disk in the plane: its boundary, then a Poisson problem */
#include "harmonic_map.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "laplacian.h"
#include "tools/matrix/triplets.h"

static const double pi = 3.14159265358979323846;

static double distance(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The length of the boundary edge from its k-th vertex to the next. */
static double edge_length(const disk_patch *d, sl_int k) {
    const double *xyz = d->p.m.xyz;
    sl_int next = d->boundary[k + 1 < d->n_boundary ? k + 1 : 0];
    return distance(xyz + 3 * (size_t)d->boundary[k], xyz + 3 * (size_t)next);
}

void boundary_to_circle(double *uv, const disk_patch *d) {
    double total = 0, so_far = 0;
    for (sl_int k = 0; k < d->n_boundary; k++) {
        total += edge_length(d, k);
    }
    double radius = total > 0 ? total / (2 * pi) : 1;
    for (sl_int k = 0; k < d->n_boundary; k++) {
        double share = total > 0 ? so_far / total : (double)k / (double)d->n_boundary;
        uv[2 * k] = radius * cos(2 * pi * share);
        uv[2 * k + 1] = radius * sin(2 * pi * share);
        so_far += edge_length(d, k);
    }
}

/* The angle of a face at its corner c; 0 for a degenerate corner. */
static double corner_angle(const mesh *m, const sl_int *face, int c) {
    const double *o = m->xyz + 3 * (size_t)face[c];
    double e[3], f[3], across[3];
    for (int k = 0; k < 3; k++) {
        e[k] = m->xyz[3 * (size_t)face[(c + 1) % 3] + (size_t)k] - o[k];
        f[k] = m->xyz[3 * (size_t)face[(c + 2) % 3] + (size_t)k] - o[k];
    }
    for (int k = 0; k < 3; k++) {
        across[k] = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
    }
    return atan2(hypot(hypot(across[0], across[1]), across[2]),
                 e[0] * f[0] + e[1] * f[1] + e[2] * f[2]);
}

void boundary_unroll(double *uv, const disk_patch *d) {
    const mesh *m = &d->p.m;
    /* turn[v]: the sum of the face angles at v */
    double *turn = (double *)calloc((size_t)m->n_vertices + 1, sizeof *turn);
    double total = 0, missing = 2 * pi, heading = 0, at[2] = {0, 0};
    if (turn == NULL) { /* needs no memory */
        boundary_to_circle(uv, d);
        return;
    }
    for (size_t c = 0; c < 3 * (size_t)m->n_faces; c++) {
        turn[m->faces[c]] += corner_angle(m, m->faces + c / 3 * 3, (int)(c % 3));
    }
    for (sl_int k = 0; k < d->n_boundary; k++) {
        total += edge_length(d, k);
        missing -= pi - turn[d->boundary[k]];
    }
    for (sl_int k = 0; k < d->n_boundary; k++) {
        sl_int before = k > 0 ? k - 1 : d->n_boundary - 1;
        double near = 0.5 * (edge_length(d, before) + edge_length(d, k));
        double share = total > 0 ? near / total : 1.0 / (double)d->n_boundary;
        if (k > 0) {
            heading += pi - turn[d->boundary[k]] + missing * share;
        }
        uv[2 * k] = at[0];
        uv[2 * k + 1] = at[1];
        at[0] += edge_length(d, k) * cos(heading);
        at[1] += edge_length(d, k) * sin(heading);
    }
    double so_far = 0;
    for (sl_int k = 0; k < d->n_boundary && total > 0; k++) {
        uv[2 * k] -= at[0] * (so_far / total);
        uv[2 * k + 1] -= at[1] * (so_far / total);
        so_far += edge_length(d, k);
    }
    free(turn);
}

/* The edges opposite to a boundary vertex, counterclockwise, form a path from its successor on the
 * boundary to its predecessor, so their sum is the difference of these two. It is rotated by +90
 * degrees: (x, y) -> (-y, x). */
void boundary_neumann_rhs(double *b, const double *uv, sl_int n_boundary) {
    for (sl_int k = 0; k < n_boundary; k++) {
        const double *before = uv + 2 * (k > 0 ? k - 1 : n_boundary - 1);
        const double *after = uv + 2 * (k + 1 < n_boundary ? k + 1 : 0);
        b[k] = -0.5 * (before[1] - after[1]);
        b[n_boundary + k] = 0.5 * (before[0] - after[0]);
    }
}

void boundary_scatter(double *X, const double *b, const disk_patch *d) {
    size_t n = (size_t)d->p.m.n_vertices, nb = (size_t)d->n_boundary;
    memset(X, 0, 2 * n * sizeof *X);
    for (size_t k = 0; k < nb; k++) {
        X[d->boundary[k]] = b[k];
        X[n + (size_t)d->boundary[k]] = b[nb + k];
    }
}

sl_status factor_and_solve(double *X, const sl_csc *N, const double *B, sl_int nrhs) {
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_options opt;
    size_t n = (size_t)N->n_cols;
    memset(&opt, 0, sizeof opt);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    sl_status status = sl_symbolic_create(&S, N, NULL, NULL);
    if (status == SL_OK) {
        status = sl_factor_create(&F, S, N, &opt, NULL);
    }
    if (status == SL_OK) {
        status = sl_factor_solve(F, X, n, B, n, nrhs, NULL);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

/* Splits N into its interior block (lower triangle to list, numbered by inside[]) and the coupling
 * to the boundary, which is multiplied by the fixed values and subtracted from B (n_inside x 2). */
static bool eliminate_boundary(triplets *list, double *B, sl_int n_inside, const sl_csc *N,
                               const sl_int *inside, const double *X) {
    size_t n = (size_t)N->n_cols, rows = (size_t)n_inside;
    for (sl_int j = 0; j < N->n_cols; j++) {
        for (sl_int p = N->p[j]; p < N->p[j + 1]; p++) {
            sl_int i = N->i[p], a = inside[i], b = inside[j];
            if (a >= 0 && b >= 0) {
                if (!triplets_add(list, a > b ? a : b, a > b ? b : a, N->x[p])) {
                    return false;
                }
            } else if (a >= 0 || b >= 0) {
                size_t row = (size_t)(a >= 0 ? a : b), fixed = (size_t)(a >= 0 ? j : i);
                B[row] -= N->x[p] * X[fixed];
                B[rows + row] -= N->x[p] * X[n + fixed];
            }
        }
    }
    return true;
}

sl_status harmonic_dirichlet(double *X, const disk_patch *d, const double *uv) {
    size_t n = (size_t)d->p.m.n_vertices;
    sl_int *inside = (sl_int *)calloc(n + 1, sizeof *inside), n_inside = 0;
    double *B = (double *)calloc(2 * n + 1, sizeof *B);
    sl_matrix *N = NULL, *A = NULL;
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_status status = SL_ERR_MEMORY;
    if (inside != NULL && B != NULL && laplacian_cotangent(&N, &d->p.m)) {
        const sl_csc view = sl_matrix_view(N);
        memset(X, 0, 2 * n * sizeof *X);
        for (size_t k = 0; k < (size_t)d->n_boundary; k++) {
            inside[d->boundary[k]] = -1;
            X[d->boundary[k]] = uv[2 * k];
            X[n + (size_t)d->boundary[k]] = uv[2 * k + 1];
        }
        for (size_t v = 0; v < n; v++) {
            inside[v] = inside[v] < 0 ? -1 : n_inside++;
        }
        if (eliminate_boundary(&list, B, n_inside, &view, inside, X)) {
            status = triplets_finish(&A, n_inside, n_inside, &list, true);
        } else {
            triplets_free(&list);
        }
    }
    if (status == SL_OK) {
        const sl_csc view = sl_matrix_view(A);
        status = factor_and_solve(B, &view, B, 2);
    }
    for (size_t v = 0; v < n && status == SL_OK; v++) {
        if (inside[v] >= 0) {
            X[v] = B[inside[v]];
            X[n + v] = B[n_inside + inside[v]];
        }
    }
    sl_matrix_free(A);
    sl_matrix_free(N);
    free(B);
    free(inside);
    return status;
}

void layout_from_columns(double *uv, const double *X, sl_int n) {
    for (sl_int v = 0; v < n; v++) {
        uv[2 * v] = X[v];
        uv[2 * v + 1] = X[n + v];
    }
}

void layout_to_columns(double *X, const double *uv, sl_int n) {
    for (sl_int v = 0; v < n; v++) {
        X[v] = uv[2 * v];
        X[n + v] = uv[2 * v + 1];
    }
}
