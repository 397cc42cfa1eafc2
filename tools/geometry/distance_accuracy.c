/* distance_checks.c: what is known of distances: closed forms on planes and spheres, bounds on any surface */
#include "distance_checks.h"

#include <math.h>
#include <stdio.h>

static double straight(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The sphere through the mesh: around the mean of its vertices, which is its centre on a sphere that is meshed evenly. */
static double sphere_of(double centre[3], const mesh *m) {
    double radius = 0;
    for (int c = 0; c < 3; c++) {
        centre[c] = 0;
        for (sl_int v = 0; v < m->n_vertices; v++) {
            centre[c] += m->xyz[3 * (size_t)v + (size_t)c] / m->n_vertices;
        }
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        radius += straight(m->xyz + 3 * (size_t)v, centre) / m->n_vertices;
    }
    return radius;
}

void distance_print_errors(const mesh *m, const sl_int *sources, sl_int count, const heat_field *f,
                           bool sphere) {
    double centre[3], radius = sphere_of(centre, m), sum = 0, worst = 0, farthest = 0;
    for (sl_int k = 0; k < f->n; k++) {
        double nearest = INFINITY;
        for (sl_int i = 0; i < count; i++) {
            double d =
                straight(m->xyz + 3 * (size_t)sources[i], m->xyz + 3 * (size_t)f->vertices[k]);
            nearest = fmin(nearest, sphere ? 2 * radius * asin(fmin(1, 0.5 * d / radius)) : d);
        }
        sum += fabs(f->distance[k] - nearest);
        worst = fmax(worst, fabs(f->distance[k] - nearest));
        farthest = fmax(farthest, nearest);
    }
    printf("exact      on the %s: mean error %.3g, largest %.3g, of distances up to %.4g\n",
           sphere ? "sphere" : "plane", f->n > 0 ? sum / f->n : 0, worst, farthest);
}

void distance_print_bounds(const mesh *m, const sl_int *sources, sl_int count,
                           const heat_field *f) {
    double below = 0, above = 0;
    for (sl_int k = 0; k < f->n; k++) {
        double line = INFINITY;
        for (sl_int i = 0; i < count; i++) {
            line = fmin(line, straight(m->xyz + 3 * (size_t)sources[i],
                                       m->xyz + 3 * (size_t)f->vertices[k]));
        }
        below = fmax(below, line - f->distance[k]);
        above = fmax(above, f->distance[k] - f->path[k]);
    }
    printf("bounds     at most %.3g below the straight line, %.3g above the path along edges\n",
           below, above);
}
