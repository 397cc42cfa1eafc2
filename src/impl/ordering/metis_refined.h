/* order_quality.h: parts from METIS's vertex separators of the whole graph */
#ifndef SLI_ORDER_QUALITY_H
#define SLI_ORDER_QUALITY_H

#include "order_layers.h"
#include "order_metis.h"

#if !defined(SL_NO_METIS)

/* A full tree of so many leaves, level by level: the children of node k are 2 k + 1 and 2 k + 2. */
static void sli_quality_tree(sli_dissection *d, sl_int leaves) {
    sl_int node;
    for (node = 0; node < leaves - 1; node++) {
        sli_tree_split(&d->tree, node);
    }
}

/* The label of a leaf below node next to v, -1 if there is none. */
static sl_int sli_quality_near(const sli_dissection *d, sl_int node, sl_int v) {
    const sli_level *g = &d->levels[0];
    sl_off e;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int other = d->label[g->to[e]];
        if (sli_tree_is_leaf(&d->tree, other) && sli_tree_is_below(&d->tree, node, other)) {
            return other;
        }
    }
    return -1;
}

/* Hands the vertices of a separator to leaves beside it; those of deeper separators are already
 * there. The border between its sides then runs along it. */
static void sli_quality_dissolve(sli_dissection *d, sl_int node, sl_int *vertices, sl_int count) {
    sl_int k, left;
    do {
        left = 0;
        for (k = 0; k < count; k++) {
            const sl_int v = vertices[k], leaf = sli_quality_near(d, node, v);
            if (leaf != -1) {
                d->label[v] = leaf;
            } else {
                vertices[left++] = v;
            }
        }
        if (left == count) { /* what touches nothing may go anywhere */
            for (k = 0; k < count; k++) {
                d->label[vertices[k]] = d->tree.low[node];
            }
            return;
        }
        count = left;
    } while (count > 0);
}

/* Labels by METIS. */
static sl_status sli_dissect_metis(sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    sl_int leaves = 1, v, node, k, at = 0, *sizes = d->begin, *size = d->nodes;
    sl_status status;
    while (d->total / leaves > d->most && leaves < g->n / 8) {
        leaves *= 2;
    }
    d->l = 0;
    status = sli_metis_nested(g, leaves, d->order, sizes, d->a);
    if (status != SL_OK) {
        return status;
    }
    sli_dissect_start(d);
    sli_quality_tree(d, leaves);
    /* METIS lists the sizes of the leaves, then of the separators of each level, the root's last */
    for (k = leaves, v = 0; k > 0; v += k, k /= 2) {
        for (node = 0; node < k; node++) {
            size[k - 1 + node] = sizes[v + node];
        }
    }
    for (node = sli_tree_first(&d->tree); node != -1; node = sli_tree_next(&d->tree, node)) {
        for (k = 0; k < size[node]; k++) {
            d->label[d->order[at++]] = node;
        }
    }
    memset(d->tree.weight, 0, (size_t)d->tree.count * sizeof(sl_int));
    sli_tree_number(&d->tree, g->n, d->label);
    sli_dissect_sort(d);
    for (node = sli_tree_first(&d->tree); node != -1; node = sli_tree_next(&d->tree, node)) {
        if (!sli_tree_is_leaf(&d->tree, node)) {
            sli_quality_dissolve(d, node, d->order + d->begin[node],
                                 d->begin[node + 1] - d->begin[node]);
        }
    }
    for (v = 0; v < g->n; v++) {
        for (node = d->label[v]; node != -1; node = d->tree.parent[node]) {
            d->tree.weight[node] += sli_level_weight(g, v);
        }
    }
    return SL_OK;
}

/* The borders that are left of METIS's separators are ragged, and so count for more than they will
 * cost: our own parts must be estimated at less than this share of theirs. */
#define SLI_QUALITY_OURS 0.8

/* Labels by METIS, or by our own levels where those are estimated to be cheaper, which they are now
 * and then: one of METIS's trees scatters as any other does. */
static sl_status sli_dissect_quality(sli_dissection *d) {
    double ours, flat;
    sl_status status = sli_dissect_graph(d);
    if (status != SL_OK) {
        return status;
    }
    ours = sli_dissect_cost(d, &flat);
    d->widening = 1;
    status = sli_dissect_metis(d);
    if (status == SL_OK && ours < SLI_QUALITY_OURS * sli_dissect_cost(d, &flat)) {
        d->widening = 2;
        status = sli_dissect_graph(d);
    }
    return status;
}

#endif

#endif
