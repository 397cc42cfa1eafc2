/* tree_cost.h: the estimated cost of a separator tree */
#ifndef SLI_ORDERING_TREE_COST_H
#define SLI_ORDERING_TREE_COST_H

#include "dissect.h"

/* An estimate of cost, exact: high * 2^32 + low, with low < 2^32. */
typedef struct sli_tree_cost {
    uint64_t high, low;
} sli_tree_cost;

/* Adds a * b: a < 2^62, b < 2^31. */
SLI_INLINE void sli_tree_cost_add(sli_tree_cost *c, uint64_t a, uint64_t b) {
    c->low += (a & 0xffffffffu) * b;
    c->high += (a >> 32) * b + (c->low >> 32);
    c->low &= 0xffffffffu;
}

SLI_INLINE sli_tree_cost sli_tree_cost_times(sli_tree_cost c, uint64_t factor) {
    c.low *= factor;
    c.high = c.high * factor + (c.low >> 32);
    c.low &= 0xffffffffu;
    return c;
}

SLI_INLINE int sli_tree_cost_is_less(sli_tree_cost a, sli_tree_cost b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
}

/* Estimates the cost of local solves with the order of a tree, as path weight: the entries of L on
 * the paths from the columns to the root. The paths of about half of a subgraph's vertices contain
 * its separator, which has about as many columns as rows below. So each node counts its weight
 * times the square of its border. *flat := the same for square flat grids of that size. */
static sli_tree_cost sli_dissect_cost(sli_dissection *d, sli_tree_cost *flat) {
    const sli_level *g = &d->levels[0];
    sl_int *border = d->nodes, v, k;
    sl_off e;
    sli_tree_cost cost = {0, 0};
    memset(border, 0, (size_t)d->tree.count * sizeof(sl_int));
    for (v = 0; v < g->n; v++) {
        const sl_int own = d->label[v];
        sl_int last = -1;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int other = d->label[g->to[e]];
            if (own < other && other != last) {
                const sl_int node = sli_label_tree_lca(&d->tree, own, other);
                border[node] += last == -1 || node != sli_label_tree_lca(&d->tree, own, last);
                last = other;
            }
        }
    }
    *flat = cost;
    for (k = 0; k < d->tree.count; k++) {
        const uint64_t weight = (uint64_t)d->tree.weight[k], across = (uint64_t)border[k];
        if (!sli_label_tree_is_leaf(&d->tree, k)) {
            sli_tree_cost_add(&cost, weight * across, across);
            sli_tree_cost_add(flat, weight, weight);
        }
    }
    return cost;
}

#endif
