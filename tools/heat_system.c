/* heat_system.c: a mesh's diffusion operator M + t L, factored and ready to be asked */
#include "heat_system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "laplacian.h"

static void sum_up(heat_system *h, double t) {
    if (!(t > 0 && t <= 1e200)) {
        app_die("the time %g is not between 0 and 1e200", t);
    }
    sl_csc L = sl_matrix_view(h->laplacian);
    for (sl_int j = 0; j < L.n_cols; j++) {
        for (sl_int p = L.p[j]; p < L.p[j + 1]; p++) {
            h->values[p] = t * L.x[p] + (L.i[p] == j ? h->mass[j] : 0);
        }
    }
    h->t = t;
}

void heat_system_create(heat_system *h, const mesh *m, double t) {
    memset(h, 0, sizeof *h);
    h->stats.error_row = -1;
    double begin = app_now();
    app_stage("analysing and factoring");
    if (!laplacian_cotangent(&h->laplacian, m)) {
        app_die("no memory for the Laplacian of %d vertices", (int)m->n_vertices);
    }
    h->A = sl_matrix_view(h->laplacian);
    h->mass = app_alloc((size_t)h->A.n_cols, sizeof *h->mass);
    h->values = app_alloc((size_t)h->A.p[h->A.n_cols], sizeof *h->values);
    h->A.x = h->values;
    laplacian_mass(h->mass, m);
    sum_up(h, t);
    h->seconds_assemble = app_now() - begin;
    app_must(sl_symbolic_create(&h->S, &h->A, NULL, &h->stats), "analysis", &h->stats);
    app_must(sl_factor_create(&h->F, h->S, &h->A, NULL, &h->stats), "factorization", &h->stats);
    app_progress_end();
}

void heat_system_set_time(heat_system *h, double t) {
    sum_up(h, t);
    app_must(sl_factor_refactor(h->F, &h->A, &h->stats), "factorization", &h->stats);
}

void heat_system_free(heat_system *h) {
    sl_factor_free(h->F);
    sl_symbolic_free(h->S);
    free(h->values);
    free(h->mass);
    sl_matrix_free(h->laplacian);
    memset(h, 0, sizeof *h);
}

double heat_area(const mesh *m) {
    double area = 0;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const double *a = m->xyz + 3 * (size_t)m->faces[3 * f],
                     *b = m->xyz + 3 * (size_t)m->faces[3 * f + 1],
                     *c = m->xyz + 3 * (size_t)m->faces[3 * f + 2];
        double n[3];
        for (int d = 0; d < 3; d++) {
            int e = (d + 1) % 3, g = (d + 2) % 3;
            n[d] = (b[e] - a[e]) * (c[g] - a[g]) - (b[g] - a[g]) * (c[e] - a[e]);
        }
        area += 0.5 * hypot(hypot(n[0], n[1]), n[2]);
    }
    return area;
}

double heat_time_value(const heat_time *h, const mesh *m, double default_area) {
    int given = (h->time != 0) + (h->scaled != 0) + (h->area != 0);
    if (given > 1 || h->time < 0 || h->scaled < 0 || h->area < 0) {
        app_die_usage("--time, --scaled-time, --area-time: one of them, and above 0");
    }
    double edge = mesh_mean_edge_length(m);
    double t = h->time > 0                            ? h->time
               : h->scaled > 0                        ? h->scaled * edge * edge
               : h->area > 0                          ? h->area * heat_area(m)
               : default_area > 0 && heat_area(m) > 0 ? default_area * heat_area(m)
                                                      : edge * edge;
    if (!(t > 0) || !isfinite(t)) {
        app_die("no time can be chosen: edges have the mean length %g, the area is %g; give --time",
                edge, heat_area(m));
    }
    return t;
}
