/* metis_refined.h: a separator tree from METIS_NodeNDP, whose separators are refined later */
#ifndef SLI_ORDERING_METIS_REFINED_H
#define SLI_ORDERING_METIS_REFINED_H

#include "levelset.h"
#include "metis.h"

#if defined(SLI_METIS)

/* Makes a complete binary tree with this many leaves, numbered level by level: the children of node
 * k are 2 k + 1 and 2 k + 2. */
static void sli_metis_refined_tree(sli_dissection *d, sl_int n_leaves) {
    sl_int node;
    for (node = 0; node < n_leaves - 1; node++) {
        sli_label_tree_split(&d->tree, node);
    }
}

/* The label of a leaf below node that is adjacent to v, or -1. */
static sl_int sli_metis_refined_adjacent_leaf(const sli_dissection *d, sl_int node, sl_int v) {
    const sli_level *g = &d->levels[0];
    sl_off e;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int other = d->label[g->to[e]];
        if (sli_label_tree_is_leaf(&d->tree, other) &&
            sli_label_tree_is_below(&d->tree, node, other)) {
            return other;
        }
    }
    return -1;
}

/* Gives the vertices of a separator to adjacent leaves, so that a border runs where the separator
 * was. The vertices of deeper separators are in leaves already. */
static void sli_metis_refined_dissolve(sli_dissection *d, sl_int node, sl_int *vertices,
                                       sl_int count) {
    sl_int k, left;
    do {
        left = 0;
        for (k = 0; k < count; k++) {
            const sl_int v = vertices[k], leaf = sli_metis_refined_adjacent_leaf(d, node, v);
            if (leaf != -1) {
                d->label[v] = leaf;
            } else {
                vertices[left++] = v;
            }
        }
        if (left == count) { /* vertices adjacent to no leaf may go to any */
            for (k = 0; k < count; k++) {
                d->label[vertices[k]] = d->tree.low[node];
            }
            return;
        }
        count = left;
    } while (count > 0);
}

/* Finds labels by METIS. */
static sl_status sli_dissect_metis(sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    sl_int n_leaves = 1, v, node, k, *sizes = d->begin, *size = d->nodes;
    sl_status status;
    while (d->total / n_leaves > d->leaf_size && n_leaves < g->n / 8 &&
           4 * (sl_off)n_leaves <= d->tree.room) {
        n_leaves *= 2;
    }
    d->level = 0;
    status = sli_metis_separators(g, n_leaves, d->order, sizes, d->a);
    if (status != SL_OK) {
        return status;
    }
    sli_dissect_start(d);
    sli_metis_refined_tree(d, n_leaves);
    /* METIS lists the weights of the leaves, then those of the separators of each level, the root's
     * last. */
    for (k = n_leaves, v = 0; k > 0; v += k, k /= 2) {
        for (node = 0; node < k; node++) {
            size[k - 1 + node] = sizes[v + node];
        }
    }
    node = sli_label_tree_first(&d->tree);
    for (k = 0; k < g->n; k++) {
        while (size[node] <= 0 && node != d->tree.root) { /* all of its vertices have their label */
            node = sli_label_tree_next(&d->tree, node);
        }
        d->label[d->order[k]] = node;
        size[node] -= sli_level_weight(g, d->order[k]);
    }
    memset(d->tree.weight, 0, (size_t)d->tree.count * sizeof(sl_int));
    sli_label_tree_number(&d->tree, g->n, d->label);
    sli_dissect_sort(d, d->tree.count);
    for (node = sli_label_tree_first(&d->tree); node != -1;
         node = sli_label_tree_next(&d->tree, node)) {
        if (!sli_label_tree_is_leaf(&d->tree, node)) {
            sli_metis_refined_dissolve(d, node, d->order + d->begin[node],
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

/* The borders left by METIS's separators are ragged and overestimate its cost. The tree of this
 * library's dissection is used only if its estimate is below this percentage of METIS's. */
#define SLI_METIS_REFINED_SHARE 80

/* Finds labels by METIS, or by this library's dissection if that is estimated to be cheaper. This
 * happens occasionally, because the quality of METIS's trees varies as that of any heuristic. */
static sl_status sli_dissect_metis_refined(sli_dissection *d) {
    sli_tree_cost own, flat;
    sl_status status = sli_dissect_graph(d);
    if (status != SL_OK) {
        return status;
    }
    own = sli_dissect_cost(d, &flat);
    d->band_growth = 1;
    status = sli_dissect_metis(d);
    if (status == SL_OK && sli_tree_cost_is_less(sli_tree_cost_times(own, 100),
                                                 sli_tree_cost_times(sli_dissect_cost(d, &flat),
                                                                     SLI_METIS_REFINED_SHARE))) {
        d->band_growth = 2;
        status = sli_dissect_graph(d);
    }
    return status;
}

#endif

#endif
