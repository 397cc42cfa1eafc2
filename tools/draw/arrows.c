/* arrows.c: arrows over a surface: vectors at some of its vertices, as segments of a picture */
#include "arrows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double head = 0.35;      /* length of the head / length of the arrow */
static const double half_head = 0.18; /* half its width */
static const double reach = 0.9;      /* length of the longest arrow / distance between arrows */

static double length_of(const double *x) {
    return hypot(hypot(x[0], x[1]), x[2]);
}

/* Adds to *area that of a face and to sum[c] its normal at each corner c, both twice. */
static void add_face(double *area, double *sum, const mesh *m, size_t f) {
    const sl_int *v = m->faces + 3 * f;
    const double *a = m->xyz + 3 * (size_t)v[0], *b = m->xyz + 3 * (size_t)v[1],
                 *c = m->xyz + 3 * (size_t)v[2];
    double n[3];
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        n[d] = (b[e] - a[e]) * (c[g] - a[g]) - (b[g] - a[g]) * (c[e] - a[e]);
        for (int k = 0; k < 3; k++) {
            sum[3 * (size_t)v[k] + (size_t)d] += n[d];
        }
    }
    *area += length_of(n);
}

/* Chooses arrows at least `apart` from one another; returns their number. chosen: positions in
 * vertices. */
static sl_int choose(sl_int *chosen, const mesh *m, const sl_int *vertices, sl_int count,
                     const double *vectors, double apart, sl_int most) {
    sl_int n = 0;
    for (sl_int k = 0; k < count && n < most; k++) {
        const double *x = m->xyz + 3 * (size_t)vertices[k];
        const double length = length_of(vectors + 3 * (size_t)k);
        bool is_free = length > 0 && isfinite(length);
        for (sl_int i = 0; i < n && is_free; i++) {
            const double *y = m->xyz + 3 * (size_t)vertices[chosen[i]];
            const double d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
            is_free = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] >= apart * apart;
        }
        if (is_free) {
            chosen[n++] = k;
        }
    }
    return n;
}

/* The four points of an arrow: its ends and the ends of its head. */
static void place(double *points, const double *from, const double *vector, const double *normal,
                  double scale) {
    const double size = length_of(normal);
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        const double side =
            size > 0 ? (normal[e] * vector[g] - normal[g] * vector[e]) / size * half_head : 0;
        points[d] = from[d];
        points[3 + d] = from[d] + scale * vector[d];
        points[6 + d] = from[d] + scale * ((1 - head) * vector[d] + side);
        points[9 + d] = from[d] + scale * ((1 - head) * vector[d] - side);
    }
}

bool arrows_create(arrows *out, const mesh *m, const sl_int *vertices, sl_int count,
                   const double *vectors, int wanted, double width, rgb color) {
    const size_t n = (size_t)m->n_vertices;
    const sl_int most = 2 * (sl_int)wanted + 8;
    double area = 0, longest = 0;
    memset(out, 0, sizeof *out);
    double *normal = (double *)calloc(3 * n + 1, sizeof *normal);
    sl_int *chosen = (sl_int *)malloc((size_t)most * sizeof *chosen);
    double *xyz = (double *)malloc((3 * n + 12 * (size_t)most) * sizeof *xyz);
    render_segment *lines = (render_segment *)malloc(3 * (size_t)most * sizeof *lines);
    const bool ok = normal != NULL && chosen != NULL && xyz != NULL && lines != NULL;
    if (ok) {
        for (size_t f = 0; f < (size_t)m->n_faces; f++) {
            add_face(&area, normal, m, f);
        }
        const double apart = sqrt(0.5 * area / wanted);
        const sl_int n_arrows = choose(chosen, m, vertices, count, vectors, apart, most);
        for (sl_int k = 0; k < n_arrows; k++) {
            longest = fmax(longest, length_of(vectors + 3 * (size_t)chosen[k]));
        }
        if (n > 0) {
            memcpy(xyz, m->xyz, 3 * n * sizeof *xyz);
        }
        for (sl_int k = 0; k < n_arrows; k++) {
            const size_t v = (size_t)vertices[chosen[k]];
            const sl_int first = m->n_vertices + 4 * k;
            const render_segment shaft = {first, first + 1, width, color},
                                 left = {first + 1, first + 2, width, color},
                                 right = {first + 1, first + 3, width, color};
            place(xyz + 3 * (size_t)first, m->xyz + 3 * v, vectors + 3 * (size_t)chosen[k],
                  normal + 3 * v, reach * apart / longest);
            lines[3 * k] = shaft;
            lines[3 * k + 1] = left;
            lines[3 * k + 2] = right;
        }
        out->m = *m;
        out->m.n_vertices += 4 * n_arrows;
        out->m.xyz = xyz;
        out->segments = lines;
        out->n_segments = 3 * (int)n_arrows;
    } else {
        free(xyz);
        free(lines);
    }
    free(normal);
    free(chosen);
    return ok;
}

void arrows_free(arrows *a) {
    free(a->m.xyz);
    free(a->segments);
    memset(a, 0, sizeof *a);
}
