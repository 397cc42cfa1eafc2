/* order_geometric.h: nested dissection by coordinates: halves of space, and when they are the better parts */
#ifndef SLI_ORDER_GEOMETRIC_H
#define SLI_ORDER_GEOMETRIC_H

#include "order_layers.h"

/* Points of a graph's vertices: vertex v lies at xyz[dimensions row[v]] .. */
typedef struct sli_points {
    const double *xyz;
    sl_int dimensions;
    const sl_int *row;
} sli_points;

/* Directions to cut across: axes, then diagonals of two of them, as sums of coordinates. */
static const signed char sli_directions[9][3] = {{1, 0, 0},  {0, 1, 0}, {1, 1, 0},
                                                 {1, -1, 0}, {0, 0, 1}, {1, 0, 1},
                                                 {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};

/* The larger parts look for their direction on so many of their points. */
#define SLI_POINTS_MANY 16384
#define SLI_POINTS_TRIED 512

/* How far v lies along a direction. */
SLI_INLINE double sli_point_along(const sli_points *p, sl_int v, int direction) {
    const double *x = p->xyz + (size_t)p->row[v] * (size_t)p->dimensions;
    const signed char *along = sli_directions[direction];
    /* coordinates may be as large as a double can be, and a sum of two must not be infinite */
    const double sum = along[0] * (0.5 * x[0]) + along[1] * (0.5 * x[1]) +
                       (p->dimensions == 3 ? along[2] * (0.5 * x[2]) : 0.0);
    return direction == 2 || direction == 3 || direction > 4 ? 0.70710678118654752 * sum : sum;
}

/* The axis along which some vertices spread most, and how far, by about SLI_POINTS_TRIED of them. */
static int sli_points_axis(const sli_points *p, const sl_int *vertices, sl_int count,
                           double *spread) {
    static const int sli_axes[3] = {0, 1, 4};
    const sl_int step = count / SLI_POINTS_TRIED + 1;
    sl_int axis, k;
    int best = 0;
    *spread = -1.0;
    for (axis = 0; axis < p->dimensions; axis++) {
        double low = sli_point_along(p, vertices[0], sli_axes[axis]), high = low;
        for (k = step; k < count; k = k < count - step ? k + step : count) {
            const double x = sli_point_along(p, vertices[k], sli_axes[axis]);
            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        if (high - low > *spread) {
            *spread = high - low;
            best = sli_axes[axis];
        }
    }
    return best;
}

/* A pair of a place and a vertex, ordered by both, so that no two are equal. */
typedef struct sli_placed {
    double x;
    sl_int v;
} sli_placed;

SLI_INLINE int sli_placed_before(const sli_placed *a, const sli_placed *b) {
    return a->x < b->x || (a->x == b->x && a->v < b->v);
}

/* Reorders so that the first half are those before the median. Each round draws its pivot from the
 * middle of three; the ranges that are left halve on average, whatever the order of the input. */
static void sli_placed_halve(sli_placed *a, sl_int count) {
    sl_int low = 0, high = count - 1;
    const sl_int half = count / 2;
    uint32_t turn = 1;
    while (low < high) {
        const uint32_t span = (uint32_t)(high - low) + 1u;
        const sli_placed pivot = a[low + (sl_int)(sli_scatter(turn++) % span)];
        sl_int i = low, j = high;
        while (i <= j) {
            while (sli_placed_before(&a[i], &pivot)) {
                i++;
            }
            while (sli_placed_before(&pivot, &a[j])) {
                j--;
            }
            if (i <= j) {
                const sli_placed keep = a[i];
                a[i++] = a[j];
                a[j--] = keep;
            }
        }
        if (half <= j) {
            high = j;
        } else if (half >= i) {
            low = i;
        } else {
            break;
        }
    }
}

/* The direction in which fewest points lie close to the median: the narrowest place of a part. */
static int sli_points_narrow(const sli_points *p, const sl_int *vertices, sl_int count,
                             sli_placed *placed) {
    double spread;
    const int axis = sli_points_axis(p, vertices, count, &spread);
    int direction, best = axis;
    const int directions = p->dimensions == 3 ? 9 : 4;
    sl_int fewest = INT32_MAX, k;
    if (count < SLI_POINTS_MANY) {
        return best;
    }
    for (direction = 0; direction < directions; direction++) {
        sl_int near = 0;
        double middle;
        for (k = 0; k < SLI_POINTS_TRIED; k++) {
            const sl_int v = vertices[(int64_t)k * count / SLI_POINTS_TRIED];
            placed[k].x = sli_point_along(p, v, direction);
            placed[k].v = v;
        }
        sli_placed_halve(placed, SLI_POINTS_TRIED);
        middle = placed[SLI_POINTS_TRIED / 2].x;
        for (k = 0; k < SLI_POINTS_TRIED; k++) {
            near += fabs(placed[k].x - middle) < 0.1 * spread;
        }
        near += direction == axis ? 0 : near / 3; /* chance must not decide against an axis */
        if (near < fewest) {
            fewest = near;
            best = direction;
        }
    }
    return best;
}

/* Labels by halves of space, down to the size of leaves. order holds the vertices of a node side by
 * side; placed: n of scratch. */
static void sli_dissect_points(sli_dissection *d, const sli_points *points, sli_placed *placed) {
    const sl_int n = d->levels[0].n;
    sl_int *begin = d->begin, *end = d->nodes, node, k;
    d->l = 0;
    sli_dissect_start(d);
    for (k = 0; k < n; k++) {
        d->order[k] = k;
    }
    begin[0] = 0;
    end[0] = n;
    for (node = 0; node < d->tree.count; node++) { /* which grows */
        const sl_int first = begin[node], count = end[node] - first;
        sl_int *vertices = d->order + first;
        int direction;
        d->tree.weight[node] = count;
        if (count <= d->most || d->tree.count >= d->tree.room - 1) {
            for (k = 0; k < count; k++) {
                d->label[vertices[k]] = node;
            }
            continue;
        }
        direction = sli_points_narrow(points, vertices, count, placed);
        for (k = 0; k < count; k++) {
            placed[k].x = sli_point_along(points, vertices[k], direction);
            placed[k].v = vertices[k];
        }
        sli_placed_halve(placed, count);
        for (k = 0; k < count; k++) {
            vertices[k] = placed[k].v;
        }
        sli_tree_split(&d->tree, node);
        begin[d->tree.left[node]] = first;
        end[d->tree.left[node]] = begin[d->tree.right[node]] = first + count / 2;
        end[d->tree.right[node]] = first + count;
    }
    sli_tree_number(&d->tree, n, d->label);
}

/* A cost up to this many times that of a flat square needs no comparison: 0.9 to 1.06 are usual on
 * flat grids, 2 and more on surfaces, where a plane cuts several sheets. */
#define SLI_FLAT_ENOUGH 1.1

/* Parts by coordinates where their estimated cost is that of a flat mesh, or less than that of the
 * parts that the graph alone gives; else the latter. */
static sl_status sli_dissect_geometric(sli_dissection *d, const sli_points *points,
                                       sli_placed *placed) {
    double cost, other, flat;
    sl_status status;
    sli_dissect_points(d, points, placed);
    cost = sli_dissect_cost(d, &flat);
    if (cost <= SLI_FLAT_ENOUGH * flat) {
        d->widening = 0;
        return SL_OK;
    }
    status = sli_dissect_graph(d);
    if (status == SL_OK) {
        other = sli_dissect_cost(d, &flat);
        if (cost < other) {
            sli_dissect_points(d, points, placed);
        }
    }
    return status;
}

#endif
