/* straight_lines.c: the line to the nearest of some points, below any path over a surface */
#include "straight_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A distance that falls short of the line by this part of it stays. */
static const double rounding = 1e-12;

/* A source; they are sorted by their first coordinate. */
typedef struct place {
    double x[3];
} place;

static int by_first(const void *a, const void *b) {
    const double p = ((const place *)a)->x[0], q = ((const place *)b)->x[0];
    return (p > q) - (p < q);
}

static double length_of(const double *a, const double *b) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* The length of the line from x to the nearest source: outward from where x would be in the
 * order. */
static double nearest(const place *p, sl_int count, const double *x) {
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
        least = fmin(least, length_of(p[k].x, x));
    }
    for (sl_int k = low - 1; k >= 0 && x[0] - p[k].x[0] < least; k--) {
        least = fmin(least, length_of(p[k].x, x));
    }
    return least;
}

sl_int straight_lines_raise(double *distance, const mesh *m, const sl_int *vertices, sl_int n,
                            const sl_int *sources, sl_int count, double *largest) {
    sl_int raised = 0;
    place *p = (place *)malloc((size_t)count * sizeof *p);
    if (p == NULL) {
        return -1;
    }
    for (sl_int k = 0; k < count; k++) {
        memcpy(p[k].x, m->xyz + 3 * (size_t)sources[k], sizeof p[k].x);
    }
    qsort(p, (size_t)count, sizeof *p, by_first);
    for (sl_int k = 0; k < n; k++) {
        const double line = nearest(p, count, m->xyz + 3 * (size_t)vertices[k]);
        if (distance[k] < line * (1 - rounding)) {
            *largest = fmax(*largest, line - distance[k]);
            distance[k] = line;
            raised++;
        }
    }
    free(p);
    return raised;
}
