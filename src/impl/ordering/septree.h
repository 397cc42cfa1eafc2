/* order_nest.h: from labels to an order: parts before the separators round them, leaves by minimum degree */
#ifndef SLI_ORDER_NEST_H
#define SLI_ORDER_NEST_H

#include "order_dissect.h"
#include "sort.h"

/* The tree of separators over all rows: node by node in the order of elimination, none empty. */
typedef struct sli_nest {
    sl_int count; /* 0: the order has no such tree */
    sl_int *of;   /* a row: its node */
    sl_int *
        parent; /* a node: the separator round it, which has a higher number; -1 if there is none */
} sli_nest;

/* Puts the vertices of a separator in the order of what they touch on the left: rows of L that go
 * together in one supernode then lie together in the others, in longer runs. */
static void sli_nest_separator(sli_dissection *d, sl_int node, sl_int *vertices, sl_int count) {
    const sli_level *g = &d->levels[0];
    uint64_t *list = (uint64_t *)(void *)d->next, *scratch = (uint64_t *)(void *)d->part.begin;
    sl_int k;
    sl_off e;
    for (k = 0; k < count; k++) {
        int64_t sum = 0, touched = 0;
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            const sl_int other = d->label[g->to[e]];
            if (other < node && sli_tree_is_below(&d->tree, node, other)) {
                sum += other;
                touched++;
            }
        }
        list[k] = sli_keyed(touched == 0 ? 0 : (sl_int)(sum / touched), vertices[k]);
    }
    sli_sort(list, count, scratch);
    for (k = 0; k < count; k++) {
        vertices[k] = sli_value(list[k]);
    }
}

/* Appends a dissected graph to an order, perm[at] on; row[v] is the row of its vertex v. */
static void sli_nest_append(sli_dissection *d, const sl_int *row, sl_int *perm, sl_int at,
                            sli_nest *nest) {
    const sli_tree *t = &d->tree;
    sl_int node, k, up, *number = d->nodes;
    sli_dissect_sort(d);
    for (node = sli_tree_first(t); node != -1; node = sli_tree_next(t, node)) {
        const sl_int count = d->begin[node + 1] - d->begin[node];
        sl_int *mine = d->order + d->begin[node];
        if (!sli_tree_is_leaf(t, node)) {
            sli_nest_separator(d, node, mine, count);
        } else if (count > 1) {
            sli_leaf_order(&d->leaf, &d->levels[0], mine, count, d->part.place, d->other);
        }
        number[node] = count > 0 ? nest->count++ : -1;
        for (k = 0; k < count; k++) {
            perm[at++] = row[mine[k]];
            nest->of[row[mine[k]]] = number[node];
        }
    }
    for (node = 0; node < t->count; node++) {
        if (number[node] != -1) {
            for (up = t->parent[node]; up != -1 && number[up] == -1;) {
                up = t->parent[up];
            }
            nest->parent[number[node]] = up == -1 ? -1 : number[up];
        }
    }
}

#endif
