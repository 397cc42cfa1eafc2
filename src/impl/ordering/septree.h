/* septree.h: from labels to the elimination order and the separator tree of all rows */
#ifndef SLI_ORDERING_SEPTREE_H
#define SLI_ORDERING_SEPTREE_H

#include "dissect.h"
#include "../base/sort.h"

/* Nodes of a task. */
#define SLI_SEPTREE_NODES 16

/* The separator tree over all rows: its nodes in elimination order, none of them empty. */
typedef struct sli_septree {
    sl_int count;    /* 0: the ordering has no such tree */
    sl_int *node_of; /* by row: its node */
    sl_int *parent;  /* by node: the separator above it, which has a higher number, or -1 */
} sli_septree;

/* Sorts the vertices of a separator by the mean label of their neighbors on the left. Rows that are
 * consecutive in one supernode of L then form longer runs in the row lists of the others. */
static void sli_septree_sort_separator(const sli_dissection *d, sli_dissect_worker *w, sl_int node,
                                       sl_int *vertices, sl_int count) {
    const sli_level *g = &d->levels[0];
    uint64_t *list = (uint64_t *)(void *)w->next;
    uint64_t *scratch = (uint64_t *)(void *)w->subgraph.begin;
    sl_int k;
    sl_off e;
    for (k = 0; k < count; k++) {
        int64_t sum = 0, touched = 0;
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            const sl_int other = d->label[g->to[e]];
            if (other < node && sli_label_tree_is_below(&d->tree, node, other)) {
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

/* Orders the vertices of some nodes: leaves by minimum degree. */
static void sli_septree_item(void *data, sl_int item, sl_int worker) {
    sli_dissection *d = (sli_dissection *)data;
    sli_dissect_worker *w = &d->workers[worker];
    const sl_int last = sli_min(d->tree.count, (item + 1) * SLI_SEPTREE_NODES);
    sl_int node;
    for (node = item * SLI_SEPTREE_NODES; node < last; node++) {
        const sl_int count = d->begin[node + 1] - d->begin[node];
        sl_int *mine = d->order + d->begin[node];
        if (!sli_label_tree_is_leaf(&d->tree, node)) {
            sli_septree_sort_separator(d, w, node, mine, count);
        } else if (count > 1) {
            sli_mindeg_order(&w->mindeg, &d->levels[0], mine, count, w->subgraph.local,
                             w->subgraph.scratch);
        }
    }
}

/* Appends the order of a dissected graph to perm, from position `at` on: each subgraph before the
 * separator above it. row[v] is the row of vertex v. */
static void sli_septree_append(sli_dissection *d, const sl_int *row, sl_int *perm, sl_int at,
                               sli_septree *septree) {
    const sli_label_tree *t = &d->tree;
    sl_int node, k, up, *number = d->nodes;
    sli_dissect_sort(d, t->count);
    sli_team_loop(d->team, (t->count - 1) / SLI_SEPTREE_NODES + 1, NULL, sli_septree_item, d);
    for (node = sli_label_tree_first(t); node != -1; node = sli_label_tree_next(t, node)) {
        const sl_int count = d->begin[node + 1] - d->begin[node];
        const sl_int *mine = d->order + d->begin[node];
        number[node] = count > 0 ? septree->count++ : -1;
        for (k = 0; k < count; k++) {
            perm[at++] = row[mine[k]];
            septree->node_of[row[mine[k]]] = number[node];
        }
    }
    for (node = 0; node < t->count; node++) {
        if (number[node] != -1) {
            for (up = t->parent[node]; up != -1 && number[up] == -1;) {
                up = t->parent[up];
            }
            septree->parent[number[node]] = up == -1 ? -1 : number[up];
        }
    }
}

#endif
