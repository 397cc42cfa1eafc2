/* geometric.h: nested dissection by coordinates, used where its estimated cost is lower */
#ifndef SLI_ORDERING_GEOMETRIC_H
#define SLI_ORDERING_GEOMETRIC_H

#include "levelset.h"

/* Coordinates of the vertices of a graph: those of vertex v start at xyz[dimensions * row[v]].
 * Multiplied by unit, they are below 2^60 and become integers, so that every compiler and processor
 * finds the same order. */
typedef struct sli_points {
    const double *xyz;
    sl_int dimensions;
    const sl_int *row;
    double unit; /* a power of 2 */
} sli_points;

SLI_INLINE double sli_points_unit(const double *xyz, size_t count) {
    double largest = 0.0;
    int exponent;
    size_t k;
    for (k = 0; k < count; k++) {
        largest = fabs(xyz[k]) > largest ? fabs(xyz[k]) : largest;
    }
    (void)frexp(largest, &exponent);
    return ldexp(1.0, exponent > 60 - DBL_MAX_EXP ? 60 - exponent : DBL_MAX_EXP - 1);
}

/* Directions of bisection as sums of coordinates: the axes and the diagonals of two axes. */
static const signed char sli_directions[9][3] = {{1, 0, 0},  {0, 1, 0}, {1, 1, 0},
                                                 {1, -1, 0}, {0, 0, 1}, {1, 0, 1},
                                                 {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};

/* Subgraphs of at least MANY vertices choose their direction, by a sample of TRIED points; smaller
 * ones are bisected across their longest axis, by a sample of about FEW. */
#define SLI_POINTS_MANY 16384
#define SLI_POINTS_TRIED 512
#define SLI_POINTS_FEW 128

/* The coordinate of v along a direction, which has length 1 or, for a diagonal, sqrt(2). */
SLI_INLINE int64_t sli_point_along(const sli_points *p, sl_int v, int direction) {
    const double *x = p->xyz + (size_t)p->row[v] * (size_t)p->dimensions;
    const signed char *along = sli_directions[direction];
    return along[0] * (int64_t)(x[0] * p->unit) + along[1] * (int64_t)(x[1] * p->unit) +
           (p->dimensions == 3 ? along[2] * (int64_t)(x[2] * p->unit) : 0);
}

/* The axis along which the vertices have the largest extent, and *spread := that extent, from a
 * sample of about SLI_POINTS_FEW vertices. */
static int sli_points_axis(const sli_points *p, const sl_int *vertices, sl_int count,
                           int64_t *spread) {
    static const int sli_axes[3] = {0, 1, 4};
    const sl_int step = count / SLI_POINTS_FEW + 1;
    sl_int axis, k;
    int best = 0;
    *spread = -1;
    for (axis = 0; axis < p->dimensions; axis++) {
        int64_t low = sli_point_along(p, vertices[0], sli_axes[axis]), high = low;
        for (k = step; k < count; k = k < count - step ? k + step : count) {
            const int64_t x = sli_point_along(p, vertices[k], sli_axes[axis]);
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

/* A vertex and its coordinate along a direction, ordered by both, so that no two are equal. */
typedef struct sli_projection {
    int64_t x;
    sl_int v;
} sli_projection;

SLI_INLINE int sli_projection_is_less(const sli_projection *a, const sli_projection *b) {
    return a->x < b->x || (a->x == b->x && a->v < b->v);
}

/* Moves the smaller half of an array to its front (quickselect). The pivots are pseudo-random: the
 * remaining range halves on average, whatever the order of the input. */
static void sli_projection_halve(sli_projection *a, sl_int count) {
    sl_int low = 0, high = count - 1;
    const sl_int half = count / 2;
    uint32_t turn = 1;
    while (low < high) {
        const uint32_t span = (uint32_t)(high - low) + 1u;
        const sli_projection pivot = a[low + (sl_int)(sli_hash32(turn++) % span)];
        sl_int i = low, j = high;
        while (i <= j) {
            while (sli_projection_is_less(&a[i], &pivot)) {
                i++;
            }
            while (sli_projection_is_less(&pivot, &a[j])) {
                j--;
            }
            if (i <= j) {
                const sli_projection keep = a[i];
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

/* The direction with the fewest points close to the median plane, where a separator will be
 * small. */
static int sli_points_direction(const sli_points *p, const sl_int *vertices, sl_int count,
                                sli_projection *projections) {
    int64_t spread;
    const int axis = sli_points_axis(p, vertices, count, &spread);
    int direction, best = axis;
    const int directions = p->dimensions == 3 ? 9 : 4;
    sl_int fewest = INT32_MAX, k;
    if (count < SLI_POINTS_MANY) {
        return best;
    }
    for (direction = 0; direction < directions; direction++) {
        const int is_diagonal = direction == 2 || direction == 3 || direction > 4;
        const int64_t close = spread / 1000 * (is_diagonal ? 141 : 100); /* a tenth */
        int64_t middle;
        sl_int n_close = 0;
        for (k = 0; k < SLI_POINTS_TRIED; k++) {
            const sl_int v = vertices[(int64_t)k * count / SLI_POINTS_TRIED];
            projections[k].x = sli_point_along(p, v, direction);
            projections[k].v = v;
        }
        sli_projection_halve(projections, SLI_POINTS_TRIED);
        middle = projections[SLI_POINTS_TRIED / 2].x;
        for (k = 0; k < SLI_POINTS_TRIED; k++) {
            const int64_t away = projections[k].x - middle;
            n_close += (away < 0 ? -away : away) < close;
        }
        /* a handicap: chance must not decide against the longest axis */
        n_close += direction == axis ? 0 : n_close / 3;
        if (n_close < fewest) {
            fewest = n_close;
            best = direction;
        }
    }
    return best;
}

/* Sorts vertices so that each half of a range, of each half again, and so on down to ranges of at
 * most `small` vertices, is a half of space. projections: count of scratch. */
static void sli_points_sort(const sli_points *points, sl_int *vertices, sl_int count, sl_int small,
                            sli_projection *projections) {
    while (count > small) {
        const int direction = sli_points_direction(points, vertices, count, projections);
        sl_int k;
        for (k = 0; k < count; k++) {
            projections[k].x = sli_point_along(points, vertices[k], direction);
            projections[k].v = vertices[k];
        }
        sli_projection_halve(projections, count);
        for (k = 0; k < count; k++) {
            vertices[k] = projections[k].v;
        }
        sli_points_sort(points, vertices, count / 2, small, projections);
        vertices += count / 2;
        count -= count / 2;
    }
}

/* Finds labels from vertices sorted by sli_points_sort, down to leaves of at most `leaf`. */
static void sli_dissect_points(sli_dissection *d, const sl_int *sorted, sl_int leaf) {
    const sl_int n = d->levels[0].n;
    sl_int *begin = d->begin, *end = d->nodes, node, k;
    d->level = 0;
    sli_dissect_start(d);
    begin[0] = 0;
    end[0] = n;
    for (node = 0; node < d->tree.count; node++) { /* tree.count grows in the loop */
        const sl_int first = begin[node], count = end[node] - first;
        d->tree.weight[node] = count;
        if (count <= leaf) {
            for (k = first; k < end[node]; k++) {
                d->label[sorted[k]] = node;
            }
            continue;
        }
        sli_label_tree_split(&d->tree, node);
        begin[d->tree.left[node]] = first;
        end[d->tree.left[node]] = begin[d->tree.right[node]] = first + count / 2;
        end[d->tree.right[node]] = first + count;
    }
    sli_label_tree_number(&d->tree, n, d->label);
}

#endif
