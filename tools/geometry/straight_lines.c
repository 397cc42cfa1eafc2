/* straight_lines.c: the line to the nearest of some points and edges, below any path */
#include "straight_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A distance that falls short of the line by this part of it stays. */
static const double rounding = 1e-12;

/* A source, or an edge of them from x to y, where x has the lower first coordinate. They are sorted
 * by it. */
typedef struct place {
    double x[3], y[3];
} place;

static int by_first(const void *a, const void *b) {
    const double p = ((const place *)a)->x[0], q = ((const place *)b)->x[0];
    return (p > q) - (p < q);
}

/* The length of the line from p to the nearest point of a place. */
static double length_of(const place *s, const double *p) {
    double along = 0, square = 0, sum = 0;
    for (int d = 0; d < 3; d++) {
        along += (p[d] - s->x[d]) * (s->y[d] - s->x[d]);
        square += (s->y[d] - s->x[d]) * (s->y[d] - s->x[d]);
    }
    const double share = square > 0 ? fmin(1, fmax(0, along / square)) : 0;
    for (int d = 0; d < 3; d++) {
        const double x = p[d] - s->x[d] - share * (s->y[d] - s->x[d]);
        sum += x * x;
    }
    return sqrt(sum);
}

/* The length of the line from x to the nearest place: outward from where x would be in the order.
 * widest: the largest extent of a place in the first coordinate. */
static double nearest(const place *p, sl_int count, double widest, const double *x) {
    sl_int low = 0, high = count;
    double least = INFINITY;
    while (low < high) {
        const sl_int middle = low + (high - low) / 2;
        if (p[middle].x[0] < x[0]) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    for (sl_int k = low; k < count && p[k].x[0] - x[0] < least; k++) {
        least = fmin(least, length_of(p + k, x));
    }
    for (sl_int k = low - 1; k >= 0 && x[0] - p[k].x[0] - widest < least; k--) {
        least = fmin(least, length_of(p + k, x));
    }
    return least;
}

sl_int straight_lines_raise(double *distance, const mesh *m, const sl_int *vertices, sl_int n,
                            const sl_int *sources, sl_int count, const sl_int *edges,
                            sl_int n_edges, double *largest) {
    sl_int raised = 0;
    const size_t all = (size_t)count + (size_t)n_edges;
    double widest = 0;
    place *p = (place *)malloc(all * sizeof *p);
    if (p == NULL || all > INT32_MAX) {
        free(p);
        return -1;
    }
    for (size_t k = 0; k < all; k++) {
        const sl_int *e = k < (size_t)count ? NULL : edges + 2 * (k - (size_t)count);
        const double *x = m->xyz + 3 * (size_t)(e != NULL ? e[0] : sources[k]);
        const double *y = e != NULL ? m->xyz + 3 * (size_t)e[1] : x;
        memcpy(p[k].x, x[0] <= y[0] ? x : y, sizeof p[k].x);
        memcpy(p[k].y, x[0] <= y[0] ? y : x, sizeof p[k].y);
        widest = fmax(widest, p[k].y[0] - p[k].x[0]);
    }
    qsort(p, all, sizeof *p, by_first);
    for (sl_int k = 0; k < n; k++) {
        const double line = nearest(p, (sl_int)all, widest, m->xyz + 3 * (size_t)vertices[k]);
        if (distance[k] < line * (1 - rounding)) {
            *largest = fmax(*largest, line - distance[k]);
            distance[k] = line;
            raised++;
        }
    }
    free(p);
    return raised;
}
