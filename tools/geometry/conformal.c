/* conformal.c: conformal layouts of a disk: spectral by inverse iteration, or by local descent */
#include "conformal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/matrix/triplets.h"

/* Relative to the largest entry of N. Small enough to keep the eigenvalues apart (those after the
 * first are of the order of h^2). Large enough to keep the last pivots above rounding errors: C
 * vanishes on constants, so these pivots come only from the shift. */
#define SHIFT 1e-10

sl_status conformal_apply(const patch_solver *s, const disk_patch *d, double *Y, const double *X) {
    size_t n = (size_t)d->p.m.n_vertices;
    sl_status status = patch_solver_apply(s, Y, X, 2);
    for (sl_int k = 0; k < d->n_boundary; k++) { /* minus the flux of the boundary, eq. (3) */
        size_t v = (size_t)d->boundary[k];
        size_t before = (size_t)d->boundary[k > 0 ? k - 1 : d->n_boundary - 1];
        size_t after = (size_t)d->boundary[k + 1 < d->n_boundary ? k + 1 : 0];
        Y[v] += 0.5 * (X[n + before] - X[n + after]);
        Y[n + v] -= 0.5 * (X[before] - X[after]);
    }
    return status;
}

static double dot(const double *a, const double *b, size_t n) {
    double sum = 0;
    for (size_t k = 0; k < n; k++) {
        sum += a[k] * b[k];
    }
    return sum;
}

sl_status conformal_descent_step(patch_solver *s, const disk_patch *d, double *X, double *work) {
    size_t n = (size_t)d->p.m.n_vertices;
    double *slope = work, *along = work + 2 * n, *bent = work + 4 * n;
    sl_status status = conformal_apply(s, d, slope, X);
    if (status == SL_OK) {
        status = patch_solver_solve_mesh(s, along, slope, 2);
    }
    if (status == SL_OK) {
        status = conformal_apply(s, d, bent, along);
    }
    double down = dot(slope, along, 2 * n), curvature = dot(along, bent, 2 * n);
    if (status == SL_OK && down > 0 && curvature > 0) {
        for (size_t k = 0; k < 2 * n; k++) {
            X[k] -= down / curvature * along[k];
        }
    }
    return status;
}

void conformal_free(conformal *c) {
    sl_factor_free(c->F);
    sl_symbolic_free(c->S);
    sl_work_free(c->work);
    free(c->y);
    memset(c, 0, sizeof *c);
}

/* Adds the lower triangle of C + shift B. Rows 2v and 2v+1 are the two coordinates of vertex v. */
static bool add_entries(triplets *list, const disk_patch *d, const sl_csc *N, double *shift) {
    double largest = 0;
    bool ok = triplets_reserve(list, 2 * (size_t)N->p[N->n_cols] + 6 * (size_t)d->n_boundary);
    for (sl_int j = 0; j < N->n_cols && ok; j++) {
        for (sl_int p = N->p[j]; p < N->p[j + 1] && ok; p++) {
            ok = triplets_add(list, 2 * N->i[p], 2 * j, N->x[p]) &&
                 triplets_add(list, 2 * N->i[p] + 1, 2 * j + 1, N->x[p]);
            largest = fmax(largest, fabs(N->x[p]));
        }
    }
    *shift = SHIFT * largest;
    for (sl_int k = 0; k < d->n_boundary && ok; k++) {
        sl_int v = d->boundary[k], after = d->boundary[k + 1 < d->n_boundary ? k + 1 : 0];
        /* first coordinate of v with second of its successor: -1/2; second with first: 1/2 */
        sl_int low = 2 * (v < after ? v : after) + (v < after ? 0 : 1);
        sl_int high = 2 * (v < after ? after : v) + (v < after ? 1 : 0);
        ok = triplets_add(list, high, low, -0.5);
        low = 2 * (v < after ? v : after) + (v < after ? 1 : 0);
        high = 2 * (v < after ? after : v) + (v < after ? 0 : 1);
        ok = ok && triplets_add(list, high, low, 0.5);
        ok = ok && triplets_add(list, 2 * v, 2 * v, *shift) &&
             triplets_add(list, 2 * v + 1, 2 * v + 1, *shift);
    }
    return ok;
}

sl_status conformal_create(conformal *out, const disk_patch *d, const sl_matrix *N) {
    const sl_csc view = sl_matrix_view(N);
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_matrix *C = NULL;
    sl_options opt;
    memset(out, 0, sizeof *out);
    memset(&opt, 0, sizeof opt);
    opt.null_tolerance = -1; /* the pivots of the constants are as small as the shift: keep them */
    out->d = d;
    if (view.n_cols > INT32_MAX / 2) {
        return SL_ERR_TOO_LARGE;
    }
    if (!add_entries(&list, d, &view, &out->shift)) {
        triplets_free(&list);
        return SL_ERR_MEMORY;
    }
    sl_status status = triplets_finish(&C, 2 * view.n_cols, 2 * view.n_cols, &list, true);
    const sl_csc A = sl_matrix_view(C);
    if (status == SL_OK) {
        status = sl_symbolic_create(&out->S, &A, NULL, NULL);
    }
    if (status == SL_OK) {
        status = sl_factor_create(&out->F, out->S, &A, &opt, NULL);
    }
    sl_matrix_free(C);
    if (status == SL_OK) {
        out->y = (double *)malloc((2 * (size_t)view.n_cols + 1) * sizeof *out->y);
        status = out->y != NULL ? sl_work_create(&out->work, NULL) : SL_ERR_MEMORY;
    }
    if (status != SL_OK) {
        conformal_free(out);
    }
    return status;
}

/* y = B x minus its mean: the part of x that the iteration keeps. False: only rounding errors are
 * left, or a NaN. */
static bool boundary_of(double *y, const disk_patch *d, const double *X) {
    size_t n = (size_t)d->p.m.n_vertices;
    double mean[2] = {0, 0}, sum = 0, size = 0;
    for (sl_int k = 0; k < d->n_boundary; k++) {
        mean[0] += X[d->boundary[k]] / (double)d->n_boundary;
        mean[1] += X[n + (size_t)d->boundary[k]] / (double)d->n_boundary;
    }
    memset(y, 0, 2 * n * sizeof *y);
    for (sl_int k = 0; k < d->n_boundary; k++) {
        size_t v = (size_t)d->boundary[k];
        y[2 * v] = X[v] - mean[0];
        y[2 * v + 1] = X[n + v] - mean[1];
        sum += y[2 * v] * y[2 * v] + y[2 * v + 1] * y[2 * v + 1];
        size += X[v] * X[v] + X[n + v] * X[n + v];
    }
    return sum > 1e-26 * size && isfinite(sum);
}

sl_status conformal_iterate(conformal *c, double *X, double *lambda) {
    const disk_patch *d = c->d;
    size_t n = (size_t)d->p.m.n_vertices;
    double mean[2] = {0, 0}, after = 0, cross = 0;
    if (!boundary_of(c->y, d, X)) {
        return SL_ERR_NOT_FINITE;
    }
    sl_status status = sl_factor_solve(c->F, c->y, 2 * n, c->y, 2 * n, 1, c->work);
    if (status != SL_OK) {
        return status;
    }
    for (sl_int k = 0; k < d->n_boundary; k++) {
        mean[0] += c->y[2 * d->boundary[k]] / (double)d->n_boundary;
        mean[1] += c->y[2 * d->boundary[k] + 1] / (double)d->n_boundary;
    }
    for (sl_int k = 0; k < d->n_boundary; k++) {
        size_t v = (size_t)d->boundary[k];
        double u = c->y[2 * v] - mean[0], w = c->y[2 * v + 1] - mean[1];
        after += u * u + w * w;
        cross += u * X[v] + w * X[n + v];
    }
    /* with z = (C + shift B)^-1 B x: z'(C + shift B)z / z'Bz = z'Bx / z'Bz */
    *lambda = cross / after - c->shift;
    double scale = 1 / sqrt(after);
    for (size_t v = 0; v < n; v++) {
        X[v] = scale * (c->y[2 * v] - mean[0]);
        X[n + v] = scale * (c->y[2 * v + 1] - mean[1]);
    }
    return isfinite(after) ? SL_OK : SL_ERR_NOT_FINITE;
}
