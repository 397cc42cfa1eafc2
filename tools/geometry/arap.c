/* arap.c: as-rigid-as-possible layouts of a disk: alternating face rotations and Poisson solves */
#include "arap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "planar_triangle.h"
#include "laplacian.h"

void arap_free(arap *a) {
    free(a->corners);
    free(a->weights);
    free(a->rotations);
    free(a->rhs);
    free(a->correction);
    memset(a, 0, sizeof *a);
}

bool arap_create(arap *out, const submesh *p) {
    size_t n = (size_t)p->m.n_vertices, nf = (size_t)p->m.n_faces;
    memset(out, 0, sizeof *out);
    out->p = p;
    out->corners = (double *)malloc((6 * nf + 1) * sizeof(double));
    out->weights = (double *)malloc((3 * nf + 1) * sizeof(double));
    out->rotations = (double *)malloc((2 * nf + 1) * sizeof(double));
    out->rhs = (double *)malloc((2 * n + 1) * sizeof(double));
    out->correction = (double *)malloc((2 * n + 1) * sizeof(double));
    if (out->corners == NULL || out->weights == NULL || out->rotations == NULL ||
        out->rhs == NULL || out->correction == NULL) {
        arap_free(out);
        return false;
    }
    for (size_t f = 0; f < nf; f++) {
        const sl_int *face = p->m.faces + 3 * f;
        planar_triangle flat = planar_triangle_of(&p->m, face);
        laplacian_face measure = laplacian_of_face(&p->m, face);
        memcpy(out->corners + 6 * f, flat.x, sizeof flat.x);
        memcpy(out->weights + 3 * f, measure.weight, sizeof measure.weight);
        out->rotations[2 * f] = 1;
        out->rotations[2 * f + 1] = 0;
    }
    return true;
}

/* The edge opposite to corner k of face f: its two vertices, and its vector in the plane of the
 * face. */
typedef struct flat_edge {
    size_t from, to;
    double x, y;
} flat_edge;

static flat_edge edge_of(const arap *a, size_t f, size_t k) {
    size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double *x = a->corners + 6 * f;
    const sl_int *face = a->p->m.faces + 3 * f;
    flat_edge e = {(size_t)face[i], (size_t)face[j], x[2 * i] - x[2 * j],
                   x[2 * i + 1] - x[2 * j + 1]};
    return e;
}

double arap_local_step(arap *a, const double *X) {
    size_t n = (size_t)a->p->m.n_vertices, nf = (size_t)a->p->m.n_faces;
    double energy = 0, area = 0;
    for (size_t f = 0; f < nf; f++) {
        double along = 0, across = 0, size = 0;
        for (size_t k = 0; k < 3; k++) {
            flat_edge e = edge_of(a, f, k);
            double w = a->weights[3 * f + k];
            double u = X[e.from] - X[e.to], v = X[n + e.from] - X[n + e.to];
            along += w * (u * e.x + v * e.y);
            across += w * (v * e.x - u * e.y);
            size += w * (u * u + v * v + e.x * e.x + e.y * e.y);
        }
        double length = hypot(along, across);
        a->rotations[2 * f] = length > 0 ? along / length : 1;
        a->rotations[2 * f + 1] = length > 0 ? across / length : 0;
        energy += size - 2 * length;
        area += 0.5 * a->corners[6 * f + 2] * a->corners[6 * f + 5];
    }
    return area > 0 ? energy / area : 0;
}

/* rhs = b(R). */
static void gather(arap *a) {
    size_t n = (size_t)a->p->m.n_vertices, nf = (size_t)a->p->m.n_faces;
    memset(a->rhs, 0, 2 * n * sizeof *a->rhs);
    for (size_t f = 0; f < nf; f++) {
        double c = a->rotations[2 * f], s = a->rotations[2 * f + 1];
        for (size_t k = 0; k < 3; k++) {
            flat_edge e = edge_of(a, f, k);
            double w = a->weights[3 * f + k];
            double u = w * (c * e.x - s * e.y), v = w * (s * e.x + c * e.y);
            a->rhs[e.from] += u;
            a->rhs[e.to] -= u;
            a->rhs[n + e.from] += v;
            a->rhs[n + e.to] -= v;
        }
    }
}

double arap_residual(arap *a, const double *X, const patch_solver *s) {
    size_t n = (size_t)a->p->m.n_vertices;
    double rest = 0, size = 0;
    gather(a);
    if (patch_solver_apply(s, a->correction, X, 2) != SL_OK) {
        return INFINITY;
    }
    for (size_t k = 0; k < 2 * n; k++) {
        double r = a->rhs[k] - a->correction[k];
        rest += r * r;
        size += a->rhs[k] * a->rhs[k];
    }
    double relative = size > 0 ? sqrt(rest / size) : sqrt(rest);
    return isfinite(relative) ? relative : INFINITY;
}

sl_status arap_global_step(arap *a, double *X, patch_solver *s, int solves) {
    size_t n = (size_t)a->p->m.n_vertices;
    gather(a);
    sl_status status = patch_solver_apply(s, a->correction, X, 2);
    for (size_t k = 0; k < 2 * n; k++) {
        a->rhs[k] -= a->correction[k];
    }
    if (status == SL_OK) {
        status = patch_solver_solve_patch(s, a->correction, a->rhs, 2, 1e-12, &solves);
    }
    for (size_t k = 0; k < 2 * n && status == SL_OK; k++) {
        X[k] += a->correction[k];
    }
    return status;
}

/* The first t in 0..1 at which a + b t + c t^2 is 0, for a > 0; 1 if there is none. */
static double first_root(double a, double b, double c) {
    const double discriminant = b * b - 4 * a * c;
    if (!(discriminant >= 0)) {
        return 1;
    }
    /* 2 a / (-b +- root): the smaller of the positive ones */
    const double root = sqrt(discriminant), low = -b + root, high = -b - root;
    double t = 1;
    t = low > 0 ? fmin(t, 2 * a / low) : t;
    return high > 0 ? fmin(t, 2 * a / high) : t;
}

double arap_shorten_step(const arap *a, double *X, const double *from) {
    const size_t n = (size_t)a->p->m.n_vertices, nf = (size_t)a->p->m.n_faces;
    double step = 1;
    for (size_t f = 0; f < nf; f++) {
        const sl_int *v = a->p->m.faces + 3 * f;
        double e[2][2], d[2][2]; /* two edges at the begin, and what the step adds to them */
        for (size_t k = 0; k < 2; k++) {
            for (size_t c = 0; c < 2; c++) {
                const size_t i = c * n + (size_t)v[k + 1], o = c * n + (size_t)v[0];
                e[k][c] = from[i] - from[o];
                d[k][c] = X[i] - X[o] - e[k][c];
            }
        }
        const double area = e[0][0] * e[1][1] - e[0][1] * e[1][0];
        if (area > 0) {
            step = fmin(step, first_root(area,
                                         e[0][0] * d[1][1] - e[0][1] * d[1][0] + d[0][0] * e[1][1] -
                                             d[0][1] * e[1][0],
                                         d[0][0] * d[1][1] - d[0][1] * d[1][0]));
        }
    }
    if (step < 1) {
        step *= 0.9;
        for (size_t k = 0; k < 2 * n; k++) {
            X[k] = from[k] + step * (X[k] - from[k]);
        }
    }
    return step;
}

sl_status arap_global_step_exact(arap *a, double *X, const sl_factor *F, sl_work *W) {
    size_t n = (size_t)a->p->m.n_vertices;
    gather(a);
    return sl_factor_solve(F, X, n, a->rhs, n, 2, W);
}
