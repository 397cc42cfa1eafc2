/* conformal.c: conformal layouts of a disk: spectral by inverse iteration, or by local descent */
#include "conformal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "laplacian.h"
#include "tools/matrix/triplets.h"

/* Relative to the mean diagonal entry of N. Small enough to keep the eigenvalues apart (those after
 * the first are of the order of h^2). Large enough to keep the last pivots above rounding errors: C
 * vanishes on constants, so these pivots come only from the shift. Where needles make the largest
 * entries much larger than the mean, rounding errors may need a larger shift. */
#define SHIFT 1e-10
#define SHIFT_GROWTH 100
#define SHIFT_MAX 1e-7 /* relative to the largest entry of N */

/* The area of a layout of the faces with weights is half the sum of sign (x_v y_w - x_w y_v) over
 * the boundary of the patch (sign 1), and over the edges of the faces without weights (-1). */
typedef struct area_edge {
    sl_int v, w;
    double sign;
} area_edge;

/* Gets the next edge; *at is 0 before the first. False: there is none. */
static bool next_edge(area_edge *e, const disk_patch *d, size_t *at) {
    const size_t nb = (size_t)d->n_boundary, end = nb + 3 * (size_t)d->p.m.n_faces;
    if (*at < nb) {
        e->v = d->boundary[*at];
        e->w = d->boundary[*at + 1 < nb ? *at + 1 : 0];
        e->sign = 1;
        ++*at;
        return true;
    }
    for (; *at < end; *at += 3 - (*at - nb) % 3) {
        const size_t corner = (*at - nb) % 3;
        const sl_int *face = d->p.m.faces + (*at - nb - corner);
        laplacian_face measure = laplacian_of_face(&d->p.m, face);
        if (measure.weight[0] == 0 && measure.weight[1] == 0 && measure.weight[2] == 0) {
            e->v = face[corner];
            e->w = face[(corner + 1) % 3];
            e->sign = -1;
            ++*at;
            return true;
        }
    }
    return false;
}

sl_status conformal_apply(const patch_solver *s, const disk_patch *d, double *Y, const double *X) {
    size_t n = (size_t)d->p.m.n_vertices, at = 0;
    area_edge e;
    sl_status status = patch_solver_apply(s, Y, X, 2);
    while (next_edge(&e, d, &at)) { /* minus the flux of the boundary, eq. (3) */
        size_t v = (size_t)e.v, w = (size_t)e.w;
        Y[v] -= 0.5 * e.sign * X[n + w];
        Y[w] += 0.5 * e.sign * X[n + v];
        Y[n + v] += 0.5 * e.sign * X[w];
        Y[n + w] -= 0.5 * e.sign * X[v];
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
static bool add_entries(triplets *list, const disk_patch *d, const sl_csc *N, double shift) {
    bool ok = triplets_reserve(list, 2 * (size_t)N->p[N->n_cols] + 6 * (size_t)d->n_boundary);
    area_edge e;
    for (sl_int j = 0; j < N->n_cols && ok; j++) {
        for (sl_int p = N->p[j]; p < N->p[j + 1] && ok; p++) {
            ok = triplets_add(list, 2 * N->i[p], 2 * j, N->x[p]) &&
                 triplets_add(list, 2 * N->i[p] + 1, 2 * j + 1, N->x[p]);
        }
    }
    for (size_t at = 0; ok && next_edge(&e, d, &at);) {
        if (e.v == e.w) { /* of a face with a repeated vertex */
            continue;
        }
        /* first coordinate of v with second of w: -1/2; second with first: 1/2 */
        bool forward = e.v < e.w;
        sl_int less = forward ? e.v : e.w, more = forward ? e.w : e.v;
        ok = triplets_add(list, 2 * more + (forward ? 1 : 0), 2 * less + (forward ? 0 : 1),
                          -0.5 * e.sign) &&
             triplets_add(list, 2 * more + (forward ? 0 : 1), 2 * less + (forward ? 1 : 0),
                          0.5 * e.sign);
    }
    for (sl_int k = 0; k < d->n_boundary && ok; k++) {
        ok = triplets_add(list, 2 * d->boundary[k], 2 * d->boundary[k], shift) &&
             triplets_add(list, 2 * d->boundary[k] + 1, 2 * d->boundary[k] + 1, shift);
    }
    return ok;
}

/* The mean and the largest diagonal entry of N. */
static void diagonal_sizes(const sl_csc *N, double *mean, double *largest) {
    *mean = *largest = 0;
    for (sl_int j = 0; j < N->n_cols; j++) {
        for (sl_int p = N->p[j]; p < N->p[j + 1]; p++) {
            if (N->i[p] == j) {
                *mean += N->x[p] / (double)N->n_cols;
                *largest = fmax(*largest, N->x[p]);
            }
        }
    }
}

/* Factors C + out->shift B to out->F and counts the negative pivots. */
static sl_status factor_shifted(conformal *out, const sl_csc *N) {
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_matrix *C = NULL;
    sl_options opt;
    sl_stats stats;
    memset(&opt, 0, sizeof opt);
    opt.null_tolerance = -1; /* the pivots of the constants are as small as the shift: keep them */
    sl_factor_free(out->F);
    out->F = NULL;
    if (!add_entries(&list, out->d, N, out->shift)) {
        triplets_free(&list);
        return SL_ERR_MEMORY;
    }
    sl_status status = triplets_finish(&C, 2 * N->n_cols, 2 * N->n_cols, &list, true);
    const sl_csc A = sl_matrix_view(C);
    if (status == SL_OK && out->S == NULL) {
        status = sl_symbolic_create(&out->S, &A, NULL, NULL);
    }
    if (status == SL_OK) {
        status = sl_factor_create(&out->F, out->S, &A, &opt, &stats);
    }
    out->negative = status == SL_OK ? stats.factor.negative : 0;
    sl_matrix_free(C);
    return status;
}

sl_status conformal_create(conformal *out, const disk_patch *d, const sl_matrix *N) {
    const sl_csc view = sl_matrix_view(N);
    double mean, largest;
    memset(out, 0, sizeof *out);
    out->d = d;
    if (view.n_cols > INT32_MAX / 2) {
        return SL_ERR_TOO_LARGE;
    }
    diagonal_sizes(&view, &mean, &largest);
    out->shift = SHIFT * mean;
    sl_status status = factor_shifted(out, &view);
    while (status == SL_OK && out->negative > 0 &&
           out->shift * SHIFT_GROWTH <= SHIFT_MAX * largest) {
        out->shift *= SHIFT_GROWTH;
        status = factor_shifted(out, &view);
    }
    if (status == SL_OK) {
        out->y = (double *)malloc((2 * (size_t)view.n_cols + 1) * sizeof *out->y);
        status = out->y != NULL ? sl_work_create(&out->work, NULL) : SL_ERR_MEMORY;
    }
    if (status != SL_OK) {
        conformal_free(out);
    }
    return status;
}

/* y = B x minus its mean: the part of x that the iteration keeps; *squares is the sum of its
 * squares. False: only rounding errors are left, or a NaN. */
static bool boundary_of(double *y, double *squares, const disk_patch *d, const double *X) {
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
    *squares = sum;
    return sum > 1e-26 * size && isfinite(sum);
}

double conformal_residual(const patch_solver *s, const disk_patch *d, const double *X,
                          double lambda, double *work) {
    size_t n = (size_t)d->p.m.n_vertices;
    double size = 0;
    if (conformal_apply(s, d, work, X) != SL_OK) {
        return INFINITY;
    }
    for (sl_int k = 0; k < d->n_boundary; k++) {
        for (size_t c = 0; c < 2; c++) {
            size_t v = c * n + (size_t)d->boundary[k];
            work[v] -= lambda * X[v];
            size += X[v] * X[v];
        }
    }
    double relative = sqrt(dot(work, work, 2 * n) / size);
    return isfinite(relative) ? relative : INFINITY;
}

sl_status conformal_iterate(conformal *c, double *X, double *lambda) {
    const disk_patch *d = c->d;
    size_t n = (size_t)d->p.m.n_vertices;
    double mean[2] = {0, 0}, before = 0, after = 0, cross = 0, turned = 0;
    if (!boundary_of(c->y, &before, d, X)) {
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
        turned += w * X[v] - u * X[n + v];
    }
    c->change = sqrt(fmax(0, 1 - (cross * cross + turned * turned) / (before * after)));
    /* with z = (C + shift B)^-1 B x: z'(C + shift B)z / z'Bz = z'Bx / z'Bz */
    *lambda = cross / after - c->shift;
    double scale = 1 / sqrt(after);
    for (size_t v = 0; v < n; v++) {
        X[v] = scale * (c->y[2 * v] - mean[0]);
        X[n + v] = scale * (c->y[2 * v + 1] - mean[1]);
    }
    return isfinite(after) ? SL_OK : SL_ERR_NOT_FINITE;
}
