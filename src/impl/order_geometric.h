/* order_geometric.h: nested dissection by coordinates: halves of space, and when they are the better parts */
#ifndef SLI_ORDER_GEOMETRIC_H
#define SLI_ORDER_GEOMETRIC_H

#include "order_dissect.h"

/* Points of a graph's vertices: vertex v lies at xyz[dimensions row[v]] .. */
typedef struct sli_points {
    const double *xyz;
    sl_int dimensions;
    const sl_int *row;
} sli_points;

SLI_INLINE double sli_point_along(const sli_points *p, sl_int v, sl_int axis) {
    return p->xyz[(size_t)p->row[v] * (size_t)p->dimensions + (size_t)axis];
}

/* The axis along which some vertices spread most. */
static sl_int sli_points_axis(const sli_points *p, const sl_int *vertices, sl_int count) {
    sl_int axis, k, best = 0;
    double most = -1.0;
    for (axis = 0; axis < p->dimensions; axis++) {
        double low = sli_point_along(p, vertices[0], axis), high = low;
        for (k = 1; k < count; k++) {
            const double x = sli_point_along(p, vertices[k], axis);
            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        if (high - low > most) {
            most = high - low;
            best = axis;
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
        sl_int *vertices = d->order + first, axis;
        d->tree.weight[node] = count;
        if (count <= SLI_DISSECT_LEAF || d->tree.count >= d->tree.room - 1) {
            for (k = 0; k < count; k++) {
                d->label[vertices[k]] = node;
            }
            continue;
        }
        axis = sli_points_axis(points, vertices, count);
        for (k = 0; k < count; k++) {
            placed[k].x = sli_point_along(points, vertices[k], axis);
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

/* What a tree of parts will cost in path weight, in a measure of its own: half of a part's vertices
 * pass its separator, whose columns are about as many as they are long, so each node counts its
 * weight times the square of its border. *flat: the same for a flat square of as many vertices. */
static double sli_dissect_cost(sli_dissection *d, double *flat) {
    const sli_level *g = &d->levels[0];
    sl_int *border = d->nodes, v, k;
    sl_off e;
    double cost = 0.0;
    memset(border, 0, (size_t)d->tree.count * sizeof(sl_int));
    for (v = 0; v < g->n; v++) {
        const sl_int own = d->label[v];
        sl_int last = -1;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int other = d->label[g->to[e]];
            if (own < other && other != last) {
                const sl_int node = sli_tree_meet(&d->tree, own, other);
                border[node] += last == -1 || node != sli_tree_meet(&d->tree, own, last);
                last = other;
            }
        }
    }
    *flat = 0.0;
    for (k = 0; k < d->tree.count; k++) {
        const double weight = d->tree.weight[k];
        if (!sli_tree_is_leaf(&d->tree, k)) {
            cost += weight * (double)border[k] * (double)border[k];
            *flat += weight * weight;
        }
    }
    return cost;
}

/* A cost this many times that of a flat square is not worth a comparison: 0.7 to 1.0 are usual on
 * flat meshes, 2 and more on surfaces, where a plane cuts several sheets. */
#define SLI_FLAT_ENOUGH 1.3

/* Parts by coordinates where their estimated cost is that of a flat mesh, or less than that of the
 * parts that the graph alone gives; else the latter. */
static sl_status sli_dissect_geometric(sli_dissection *d, const sli_points *points,
                                       sli_placed *placed) {
    double cost, other, flat;
    sl_status status;
    sli_dissect_points(d, points, placed);
    cost = sli_dissect_cost(d, &flat);
    if (cost <= SLI_FLAT_ENOUGH * flat) {
        return SL_OK;
    }
    status = sli_dissect_multilevel(d);
    if (status == SL_OK) {
        other = sli_dissect_cost(d, &flat);
        if (cost < other) {
            sli_dissect_points(d, points, placed);
        }
    }
    return status;
}

#endif
