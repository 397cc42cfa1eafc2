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

SLI_INLINE int sli_tree_cost_is_less(sli_tree_cost a, sli_tree_cost b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
}

/* Counts the vertices at the border of each node, in a range. */
static void sli_tree_cost_count(void *data, const sli_range *r) {
    const sli_dissection *d = (const sli_dissection *)data;
    const sli_level *g = &d->levels[d->level];
    sl_int v, *border = sli_dissect_by_label(d, r->item);
    sl_off e;
    memset(border, 0, (size_t)d->tree.count * sizeof(sl_int));
    for (v = r->first; v < r->last; v++) {
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
}

/* Estimates the cost of local solves with the order of a tree, as path weight: the entries of L on
 * the paths from the columns to the root. The paths of about half of a subgraph's vertices contain
 * its separator, which has about as many columns as rows below. So each node counts its weight
 * times the square of its border. */
static sli_tree_cost sli_dissect_cost(sli_dissection *d) {
    sl_int k, item;
    sli_tree_cost cost = {0, 0};
    SLI_ASSERT(d->level == 0);
    sli_dissect_loop(d, d->tree.count, sli_tree_cost_count);
    for (k = 0; k < d->tree.count; k++) {
        const uint64_t weight = (uint64_t)d->tree.weight[k];
        uint64_t across = 0;
        for (item = 0; item < d->n_ranges; item++) {
            across += (uint64_t)sli_dissect_by_label(d, item)[k];
        }
        if (!sli_label_tree_is_leaf(&d->tree, k)) {
            sli_tree_cost_add(&cost, weight * across, across);
        }
    }
    return cost;
}

#endif
