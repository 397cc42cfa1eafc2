/* distance_accuracy.c: compares computed distances with closed forms and with general bounds */
#include "distance_accuracy.h"

#include <math.h>
#include <stdio.h>

static double straight(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The sphere of a mesh: its center is the mean of the vertices, exact for an evenly meshed sphere.
 * Returns the radius, the mean distance from the center. */
static double sphere_of(double center[3], const mesh *m) {
    double radius = 0;
    for (int c = 0; c < 3; c++) {
        center[c] = 0;
        for (sl_int v = 0; v < m->n_vertices; v++) {
            center[c] += m->xyz[3 * (size_t)v + (size_t)c] / m->n_vertices;
        }
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        radius += straight(m->xyz + 3 * (size_t)v, center) / m->n_vertices;
    }
    return radius;
}

void distance_print_accuracy(const mesh *m, const sl_int *sources, sl_int count,
                             const heat_field *f, bool sphere) {
    double center[3], radius = sphere_of(center, m), sum = 0, worst = 0, farthest = 0;
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
    printf("The errors on the %s are %.3g on average and at most %.3g, of distances up to %.4g.\n",
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
