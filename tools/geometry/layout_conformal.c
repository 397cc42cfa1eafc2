/* layout_conformal.c: conformal layouts: with given places of some vertices, or spectral ones */
#include "layout_conformal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

sl_status layout_lscm(layout *l, double *uv) {
    layout_assemble(l, NULL, 0.5);
    return layout_minimize(l, uv);
}

/* y = B x minus its mean; returns the sum of its squares. NAN if only rounding errors are left. */
static double boundary_part(double *y, const double *x, const layout_boundary *b, size_t n) {
    const sl_int count = b->begin[b->n_loops];
    double mean[2] = {0, 0}, squares = 0, size = 0;
    for (sl_int k = 0; k < 2 * count; k++) {
        mean[k % 2] += x[2 * b->vertex[k / 2] + k % 2] / (double)count;
    }
    memset(y, 0, 2 * n * sizeof *y);
    for (sl_int k = 0; k < 2 * count; k++) {
        const sl_int at = 2 * b->vertex[k / 2] + k % 2;
        y[at] = x[at] - mean[k % 2];
        squares += y[at] * y[at];
        size += x[at] * x[at];
    }
    return squares > 1e-26 * size && isfinite(squares) ? squares : NAN;
}

/* The shift B that is added to C, relative to the mean diagonal entry: small enough to keep the
 * eigenvalues apart, which after the first are of the order of h^2; large enough to keep the pivots
 * of the constants above rounding. */
#define SHIFT 1e-10

static double shift_of(const layout *l) {
    double sum = 0;
    for (sl_int j = 0; j < 2 * l->m->n_vertices; j++) {
        for (sl_int p = l->Ap[j]; p < l->Ap[j + 1]; p++) {
            sum += l->Ai[p] == j ? l->Ax[p] : 0;
        }
    }
    return SHIFT * sum / (2 * (double)l->m->n_vertices);
}

/* One inverse iteration; y is scratch. */
static sl_status iterate(layout *l, double *x, double *y, const layout_boundary *b, double shift,
                         layout_spectrum *how) {
    const size_t n = (size_t)l->m->n_vertices;
    const sl_int count = b->begin[b->n_loops];
    double mean[2] = {0, 0}, along = 0, across = 0, after = 0;
    const double before = boundary_part(y, x, b, n);
    if (isnan(before)) {
        return SL_ERR_NOT_FINITE;
    }
    sl_status status = layout_solve(l, y);
    for (sl_int k = 0; k < 2 * count; k++) {
        mean[k % 2] += y[2 * b->vertex[k / 2] + k % 2] / (double)count;
    }
    for (sl_int k = 0; k < count; k++) {
        const double *from = x + 2 * (size_t)b->vertex[k], *to = y + 2 * (size_t)b->vertex[k];
        const double u = to[0] - mean[0], v = to[1] - mean[1];
        after += u * u + v * v;
        along += u * from[0] + v * from[1];
        across += v * from[0] - u * from[1];
    }
    how->change = sqrt(fmax(0, 1 - (along * along + across * across) / (before * after)));
    /* with z = (C + shift B)^-1 B x: z' (C + shift B) z / z' B z = z' B x / z' B z */
    how->lambda = along / after - shift;
    how->iterations++;
    for (size_t k = 0; k < 2 * n && status == SL_OK; k++) {
        x[k] = (y[k] - mean[k % 2]) / sqrt(after);
    }
    return status == SL_OK && !isfinite(after) ? SL_ERR_NOT_FINITE : status;
}

/* ||C x - lambda B x|| / ||B x||, for x with mean 0 over the boundary. */
static sl_status find_residual(layout *l, const double *x, double *y, const layout_boundary *b,
                               layout_spectrum *how) {
    double rest = 0, size = 0;
    layout_assemble(l, NULL, 0.5);
    sl_status status = layout_multiply(l, y, x);
    for (sl_int k = 0; k < b->begin[b->n_loops]; k++) {
        const size_t at = 2 * (size_t)b->vertex[k];
        y[at] -= how->lambda * x[at];
        y[at + 1] -= how->lambda * x[at + 1];
        size += x[at] * x[at] + x[at + 1] * x[at + 1];
    }
    for (size_t k = 0; k < 2 * (size_t)l->m->n_vertices; k++) {
        rest += y[k] * y[k];
    }
    how->residual = sqrt(rest / size);
    return status;
}

sl_status layout_spectral(layout *l, double *uv, const layout_boundary *b, int limit,
                          layout_spectrum *how) {
    double *y = (double *)malloc((2 * (size_t)l->m->n_vertices + 1) * sizeof *y);
    memset(how, 0, sizeof *how);
    layout_assemble(l, NULL, 0.5);
    const double shift = shift_of(l);
    for (sl_int k = 0; k < b->begin[b->n_loops]; k++) {
        layout_add_diagonal(l, b->vertex[k], shift);
    }
    sl_status status = y != NULL ? layout_factor(l) : SL_ERR_MEMORY;
    how->change = 1;
    while (status == SL_OK && how->iterations < limit && how->change > 1e-7) {
        status = iterate(l, uv, y, b, shift, how);
    }
    status = status == SL_OK ? find_residual(l, uv, y, b, how) : status;
    free(y);
    return status;
}
