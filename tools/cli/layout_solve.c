/* layout_solve.c: harmonic layouts by a system that suits the patch; warnings about layouts */
#include "layout_solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/harmonic_map.h"
#include "tools/geometry/laplacian.h"

/* Off the interface, a local solve leaves rounding errors: small beside the flux, or where the
 * weights span many orders of magnitude, small beside the terms of each row. */
#define INSIDE_MAX 1e-9
#define BACKWARD_MAX 1e-10

layout_system layout_system_named(const char *text) {
    static const char *const names[] = {"auto", "mesh", "patch"};
    for (int k = 0; k < 3; k++) {
        if (strcmp(text, names[k]) == 0) {
            return (layout_system)k;
        }
    }
    app_die_usage("--system %s: expected auto, mesh or patch", text);
}

/* |N| |x| + |b| for one column. */
static void row_terms(double *terms, const sl_csc *N, const double *x, const double *b) {
    for (sl_int k = 0; k < N->n_rows; k++) {
        terms[k] = fabs(b[k]);
    }
    for (sl_int j = 0; j < N->n_cols; j++) {
        for (sl_int p = N->p[j]; p < N->p[j + 1]; p++) {
            const sl_int i = N->i[p];
            terms[i] += fabs(N->x[p] * x[j]);
            terms[j] += i != j ? fabs(N->x[p] * x[i]) : 0;
        }
    }
}

/* ||b - N x|| / ||b|| without the rows of the interface; the larger of the two columns. backward:
 * the largest |b - N x|_i / (|N| |x| + |b|)_i of these rows. */
static double residual_inside(const layout_command *job, const double *X, const double *flux,
                              double *backward) {
    const sl_csc N = sl_matrix_view(job->s.N);
    size_t n = (size_t)N.n_rows;
    double *R = app_alloc(2 * n, sizeof *R), *terms = app_alloc(n, sizeof *terms), worst = 0;
    *backward = 0;
    app_must(sl_csc_residual(&N, R, n, NULL, X, n, flux, n, 2), "residual", NULL);
    for (size_t c = 0; c < 2; c++) {
        double rest = 0, size = 0;
        for (sl_int k = 0; k < job->d.p.n_interface; k++) {
            R[c * n + (size_t)job->d.p.interface[k]] = 0;
        }
        row_terms(terms, &N, X + c * n, flux + c * n);
        for (size_t k = c * n; k < (c + 1) * n; k++) {
            rest = hypot(rest, R[k]);
            size = hypot(size, flux[k]);
            *backward = R[k] != 0 ? fmax(*backward, fabs(R[k]) / terms[k - c * n]) : *backward;
        }
        rest = size > 0 ? rest / size : rest;
        worst = isfinite(rest) ? fmax(worst, rest) : INFINITY;
        *backward = isfinite(rest) ? *backward : INFINITY;
    }
    free(terms);
    free(R);
    return worst;
}

static layout_solution solve_one(layout_command *job, double *X, const double *flux,
                                 layout_system system) {
    layout_solution how;
    memset(&how, 0, sizeof how);
    double began = app_now();
    how.used = system;
    if (system == LAYOUT_MESH) {
        how.patch.solves = 1;
        app_must(patch_solver_solve_mesh(&job->s, X, flux, 2), "solve on the patch", NULL);
    } else {
        app_must(patch_solver_solve_exact(&job->s, X, flux, 2, &how.patch), "solve on the patch",
                 NULL);
    }
    how.seconds = app_now() - began;
    how.inside = residual_inside(job, X, flux, &how.backward);
    if (system == LAYOUT_MESH) {
        app_must(patch_solver_measure(&job->s, &how.patch, X, flux, 2), "residual", NULL);
    }
    how.solved = system == LAYOUT_PATCH ? how.patch.solved
                                        : how.inside <= INSIDE_MAX || how.backward <= BACKWARD_MAX;
    return how;
}

static sl_int flipped_faces(const layout_command *job, const double *X) {
    sl_int n = job->d.p.m.n_vertices;
    double *uv = app_alloc(2 * (size_t)n, sizeof *uv);
    layout_from_columns(uv, X, n);
    distortion q = distortion_of(&job->d.p.m, uv);
    free(uv);
    return q.flipped;
}

layout_solution layout_solve(layout_command *job, double *X, const double *flux,
                             layout_system system) {
    if (system != LAYOUT_AUTO) {
        return solve_one(job, X, flux, system);
    }
    if (job->seam > 0) {
        return solve_one(job, X, flux, LAYOUT_PATCH);
    }
    layout_solution how = solve_one(job, X, flux, LAYOUT_MESH);
    sl_int flipped = flipped_faces(job, X);
    if (flipped > 0 || !how.solved) {
        double *Y = app_alloc(2 * (size_t)job->d.p.m.n_vertices, sizeof *Y);
        layout_solution other = solve_one(job, Y, flux, LAYOUT_PATCH);
        if (other.solved && (!how.solved || flipped_faces(job, Y) < flipped)) {
            memcpy(X, Y, 2 * (size_t)job->d.p.m.n_vertices * sizeof *Y);
            how = other;
            printf("system     that of the patch: that of the mesh flips %d faces\n", (int)flipped);
        }
        free(Y);
    }
    return how;
}

/* Counts the vertices of the patch whose row of N is zero. */
static sl_int without_weights(const layout_command *job) {
    const sl_csc N = sl_matrix_view(job->s.N);
    sl_int count = 0;
    for (sl_int j = 0; j < N.n_cols; j++) {
        double diagonal = 0;
        for (sl_int p = N.p[j]; p < N.p[j + 1]; p++) {
            diagonal += N.i[p] == j ? N.x[p] : 0;
        }
        count += !(diagonal > 0);
    }
    return count;
}

bool layout_print_solution(const layout_command *job, const layout_solution *how) {
    if (how->used == LAYOUT_MESH) {
        printf("solve      system of the mesh, 1 local solve: %.3f ms\n", 1e3 * how->seconds);
        printf("residual   %.1e inside the patch, backward error %.1e; %.1e of the patch's own "
               "system, "
               "whose boundary is free\n",
               how->inside, how->backward, how->patch.residual);
    } else {
        printf("solve      system of the patch, %d local solves%s: %.3f ms\n", how->patch.solves,
               how->patch.own_factor ? " did not suffice: solved by a factor of the patch" : "",
               1e3 * how->seconds);
        printf("residual   %.1e of the patch's own system; backward error %.1e, error about %.1e\n",
               how->patch.residual, how->patch.backward_error, how->patch.error);
    }
    if (!how->solved) {
        app_warn("the layout does not solve its system: residual %.1e, backward error %.1e; %d "
                 "vertices have no weights",
                 how->used == LAYOUT_MESH ? how->inside : how->patch.residual,
                 how->used == LAYOUT_MESH ? how->backward : how->patch.backward_error,
                 (int)without_weights(job));
    }
    return how->solved;
}

void layout_warn(const layout_command *job, const double *X, const distortion *q) {
    const mesh *m = &job->d.p.m;
    sl_int flat = 0, turned = 0, loose = without_weights(job);
    size_t n = (size_t)m->n_vertices;
    double sum = 0;
    for (sl_int f = 0; f < m->n_faces; f++) {
        const sl_int *v = m->faces + 3 * (size_t)f;
        laplacian_face measure = laplacian_of_face(m, v);
        if (measure.weight[0] == 0 && measure.weight[1] == 0 && measure.weight[2] == 0) {
            flat++;
            turned += (X[v[1]] - X[v[0]]) * (X[n + (size_t)v[2]] - X[n + (size_t)v[0]]) <
                      (X[v[2]] - X[v[0]]) * (X[n + (size_t)v[1]] - X[n + (size_t)v[0]]);
        }
    }
    for (size_t k = 0; k < 2 * (size_t)m->n_vertices; k++) {
        sum += X[k];
    }
    if (!isfinite(sum)) {
        app_warn("the layout is not finite");
    }
    if (q->flipped > 0) {
        app_warn("%d of %d faces are flipped: the layout overlaps itself", (int)q->flipped,
                 (int)m->n_faces);
    }
    if (flat > 0) {
        app_warn("%d of %d faces have no area or angles below a millionth of a degree; they do not "
                 "influence the layout, and %d of them are flipped",
                 (int)flat, (int)m->n_faces, (int)turned);
    }
    if (loose > 0) {
        app_warn("%d vertices belong to such faces only: their places in the layout are arbitrary",
                 (int)loose);
    }
}

double *layout_start(layout_command *job) {
    sl_int n = job->d.p.m.n_vertices;
    double *boundary = layout_command_boundary(job), *flux = layout_command_flux(job, boundary);
    double *X = app_alloc(2 * (size_t)n, sizeof *X), *uv = app_alloc(2 * (size_t)n, sizeof *uv);
    layout_solution how = layout_solve(job, X, flux, LAYOUT_AUTO);
    (void)layout_print_solution(job, &how);
    layout_from_columns(uv, X, n);
    distortion_normalize(&job->d.p.m, uv);
    layout_to_columns(X, uv, n);
    free(uv);
    free(flux);
    free(boundary);
    return X;
}
