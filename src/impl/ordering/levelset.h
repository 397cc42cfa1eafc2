/* order_layers.h: parts cut between the layers of a breadth-first search: what grids of three dimensions want */
#ifndef SLI_ORDER_LAYERS_H
#define SLI_ORDER_LAYERS_H

#include "order_dissect.h"

/* A cut is looked for where either side has at least this share. */
#define SLI_LAYERS_SHARE 0.35

/* Distances from a vertex, what it does not reach following at a distance; the vertices in that
 * order. Returns the number of distances, at most 2 n. */
static sl_int sli_layers_search(const sli_piece *p, sl_int from, sl_int *order, sl_int *distance) {
    sl_int v, head = 0, tail = 0, unseen = 0;
    sl_off e;
    for (v = 0; v < p->n; v++) {
        distance[v] = -1;
    }
    distance[from] = 0;
    order[tail++] = from;
    for (;;) {
        for (; head < tail; head++) {
            for (e = p->begin[order[head]]; e < p->begin[order[head] + 1]; e++) {
                if (distance[p->to[e]] == -1) {
                    distance[p->to[e]] = distance[order[head]] + 1;
                    order[tail++] = p->to[e];
                }
            }
        }
        if (tail == p->n) {
            return distance[order[tail - 1]] + 1;
        }
        while (distance[unseen] != -1) {
            unseen++;
        }
        distance[unseen] = distance[order[tail - 1]] + 2; /* nothing lies between */
        order[tail++] = unseen;
    }
}

/* Sides by layers from a vertex far from others: of the layers near the middle the smallest becomes
 * the border. */
static void sli_layers_bisect(sli_piece *p) {
    const sl_int n = p->n;
    sl_int *order = p->scratch, *distance = p->scratch + (size_t)n,
           *size = p->scratch + 2 * (size_t)n;
    const sl_int low = (sl_int)(SLI_LAYERS_SHARE * n), high = n - low;
    sl_int k, layers, before = 0, best = -1;
    double cost = 0.0;
    const sl_int far = sli_piece_far(p, 0, order, p->locked);
    layers = sli_layers_search(p, sli_piece_far(p, far, order, p->locked), order, distance);
    memset(size, 0, (size_t)layers * sizeof(sl_int));
    for (k = 0; k < n; k++) {
        size[distance[k]]++;
    }
    for (k = 0; k < layers; before += size[k++]) {
        const double skew = fabs((double)(n - size[k] - 2 * (int64_t)before)) / n;
        const double here = (1.0 + skew) * size[k];
        if (before >= low && before + size[k] <= high && (best == -1 || here < cost)) {
            best = k;
            cost = here;
        }
    }
    for (k = 0; k < n; k++) { /* where all is in a few layers, by halves of the search */
        p->side[order[k]] = (unsigned char)(best == -1 ? k >= n / 2 : distance[order[k]] >= best);
    }
}

static void sli_dissect_layers(sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    sl_int node, nodes;
    d->l = 0;
    sli_dissect_start(d);
    do {
        nodes = d->tree.count;
        sli_dissect_sort(d);
        for (node = 0; node < nodes && d->tree.count < d->tree.room - 1; node++) {
            const sl_int count = d->begin[node + 1] - d->begin[node];
            if (count > d->most) {
                sli_piece_leaf(&d->part, g, &d->tree, node, d->label, d->order + d->begin[node],
                               count);
                sli_layers_bisect(&d->part);
                sli_dissect_divide(d, node);
                sli_piece_clear(&d->part);
            }
        }
        sli_tree_number(&d->tree, g->n, d->label);
    } while (d->tree.count > nodes);
}

/* Vertices at the left of the root's border. */
static sl_int sli_dissect_border(const sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    const sl_int root = d->tree.root;
    sl_int v, count = 0;
    sl_off e;
    for (v = 0; v < g->n; v++) {
        int crosses = 0;
        for (e = g->begin[v]; e < g->begin[v + 1] && d->label[v] < root; e++) {
            crosses |= d->label[g->to[e]] > root;
        }
        count += crosses;
    }
    return count;
}

/* A border of so many times the root of the vertices is none of a surface. */
#define SLI_VOLUME_BORDER 2.5

/* Labels by levels of coarser graphs; of what may be a volume by layers, where those are estimated
 * to be the cheaper parts: in a grid of seven points they are diagonal planes of three quarters the
 * size of a straight one. */
static sl_status sli_dissect_graph(sli_dissection *d) {
    double levels, layers, flat;
    sl_status status = sli_dissect_multilevel(d);
    if (status != SL_OK ||
        (double)sli_dissect_border(d) < SLI_VOLUME_BORDER * sqrt((double)d->levels[0].n)) {
        return status;
    }
    levels = sli_dissect_cost(d, &flat);
    sli_dissect_layers(d);
    layers = sli_dissect_cost(d, &flat);
    if (layers < levels) {
        d->widening = 0;
        return SL_OK;
    }
    return sli_dissect_multilevel(d);
}

#endif
