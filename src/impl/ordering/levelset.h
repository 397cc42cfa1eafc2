/* levelset.h: bisection between level sets of a breadth-first search, cheaper in regular volumes */
#ifndef SLI_ORDERING_LEVELSET_H
#define SLI_ORDERING_LEVELSET_H

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
    return a.high < b.high + (a.low < b.low); /* low decides between equal high parts */
}

/* Counts the vertices at the border of each node, in a range. */
static void sli_tree_cost_count(void *data, const sli_range *r) {
    const sli_dissection *d = (const sli_dissection *)data;
    const sli_level *g = &d->levels[d->level];
    sl_int v, *border = sli_dissect_by_label(d, r->item);
    sl_off e;
    SLI_ZERO(border, d->tree.count);
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

/* The largest percentage that may be on one side of a level set, if there is a choice. */
#define SLI_LEVELSET_BALANCE 65

/* Breadth-first search: distances from a vertex, and the vertices in the order of their distances.
 * Vertices that are not reached follow at larger distances. Returns one more than the largest
 * distance, at most 2 n. */
static sl_int sli_levelset_search(const sli_subgraph *sub, sl_int from, sl_int *order,
                                  sl_int *distance) {
    sl_int head = 0, tail = 0, unseen = 0;
    sl_off e;
    SLI_NONE(distance, sub->n);
    distance[from] = 0;
    order[tail++] = from;
    for (;;) {
        for (; head < tail; head++) {
            for (e = sub->begin[order[head]]; e < sub->begin[order[head] + 1]; e++) {
                if (distance[sub->to[e]] == -1) {
                    distance[sub->to[e]] = distance[order[head]] + 1;
                    order[tail++] = sub->to[e];
                }
            }
        }
        if (tail == sub->n) {
            return distance[order[tail - 1]] + 1;
        }
        while (distance[unseen] != -1) {
            unseen++;
        }
        /* a gap of one keeps the components apart */
        distance[unseen] = distance[order[tail - 1]] + 2;
        order[tail++] = unseen;
    }
}

/* Bisects along a level set of a vertex at the end of a long path. The smallest level set near the
 * middle becomes the border; the imbalance of the sides increases its cost. */
static void sli_levelset_bisect(sli_subgraph *sub, int is_first) {
    const sl_int n = sub->n;
    sl_int *order = sub->scratch, *distance = sub->scratch + (size_t)n,
           *size = sub->scratch + 2 * (size_t)n;
    const sl_int low = (sl_int)((int64_t)n * (100 - SLI_LEVELSET_BALANCE) / 100), high = n - low;
    sl_int k, n_sets, before = 0, best = -1;
    int64_t cost = 0;
    const sl_int end = sli_subgraph_farthest(sub, 0, order, sub->locked);
    n_sets = sli_levelset_search(sub, sli_subgraph_farthest(sub, end, order, sub->locked), order,
                                 distance);
    (void)is_first;
    SLI_ZERO(size, n_sets);
    for (k = 0; k < n; k++) {
        size[distance[k]]++;
    }
    for (k = 0; k < n_sets; before += size[k++]) {
        const int64_t skew = n - size[k] - 2 * (int64_t)before;
        const int64_t here = (n + (skew < 0 ? -skew : skew)) * size[k]; /* < 2^63 */
        if (before >= low && before + size[k] <= high && (best == -1 || here < cost)) {
            best = k;
            cost = here;
        }
    }
    /* If no level set is near enough to the middle, halve the search order. */
    for (k = 0; k < n; k++) {
        sub->side[order[k]] = (unsigned char)(best == -1 ? k >= n / 2 : distance[order[k]] >= best);
    }
}

/* Finds labels only by level sets, down to the size of leaves. */
static void sli_dissect_levelset(sli_dissection *d) {
    d->level = 0;
    sli_dissect_start(d);
    while (sli_dissect_split(d, d->leaf_size, sli_levelset_bisect) > 0) {
    }
}

/* Finds labels by multilevel dissection. In graphs that may be 7-point volumes, level sets are
 * tried too and taken if they are estimated to cost less: they are diagonal planes there, the
 * largest of which has 3/4 of the vertices of a straight plane. They cost 0.41 to 0.53 of it in
 * cubes, and 0.66 to 0.83 in plates of 2 to 10 layers, where they save 9 to 22 % of the fill. */
static sl_status sli_dissect_graph(sli_dissection *d) {
    sli_tree_cost multilevel;
    const sl_status status = sli_dissect_multilevel(d);
    if (status != SL_OK || !d->may_be_seven_point) {
        return status;
    }
    multilevel = sli_dissect_cost(d);
    sli_dissect_swap(d);
    sli_dissect_levelset(d);
    if (sli_tree_cost_is_less(sli_dissect_cost(d), multilevel)) {
        d->is_levelset = 1;
    } else {
        sli_dissect_swap(d);
    }
    return SL_OK;
}

#endif
