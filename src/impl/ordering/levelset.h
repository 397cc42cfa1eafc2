/* levelset.h: bisection between level sets of a breadth-first search, cheaper in regular volumes */
#ifndef SLI_ORDERING_LEVELSET_H
#define SLI_ORDERING_LEVELSET_H

#include "tree_cost.h"

/* Each side of a bisection has at least this percentage, if a level set allows it. */
#define SLI_LEVELSET_SHARE 35

/* Breadth-first search: distances from a vertex, and the vertices in the order of their distances.
 * Vertices that are not reached follow at larger distances. Returns one more than the largest
 * distance, at most 2 n. */
static sl_int sli_levelset_search(const sli_subgraph *sub, sl_int from, sl_int *order,
                                  sl_int *distance) {
    sl_int v, head = 0, tail = 0, unseen = 0;
    sl_off e;
    for (v = 0; v < sub->n; v++) {
        distance[v] = -1;
    }
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
static void sli_levelset_bisect(sli_subgraph *sub, sl_int nodes) {
    const sl_int n = sub->n;
    sl_int *order = sub->scratch, *distance = sub->scratch + (size_t)n,
           *size = sub->scratch + 2 * (size_t)n;
    const sl_int low = (sl_int)((int64_t)n * SLI_LEVELSET_SHARE / 100), high = n - low;
    sl_int k, n_sets, before = 0, best = -1;
    int64_t cost = 0;
    const sl_int end = sli_subgraph_farthest(sub, 0, order, sub->locked);
    n_sets = sli_levelset_search(sub, sli_subgraph_farthest(sub, end, order, sub->locked), order,
                                 distance);
    (void)nodes;
    memset(size, 0, (size_t)n_sets * sizeof(sl_int));
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

/* The number of vertices on the left side of the root's border. */
static sl_int sli_dissect_root_border(const sli_dissection *d) {
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

/* A border of more than half of this many times sqrt(n) vertices is unusual on a surface: the graph
 * may be a volume. In a wide graph of a surface, where vertices at k edges are neighbors, borders
 * are k layers, and 4 k^2 is about the number of neighbors. */
#define SLI_VOLUME_BORDER 5

static int sli_dissect_may_be_volume(const sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    return sli_exceeds_sqrt(2 * (int64_t)sli_dissect_root_border(d), SLI_VOLUME_BORDER,
                            sli_level_is_wide(g) ? (sl_int)(g->begin[g->n] / 4) : g->n);
}

/* Finds labels by multilevel dissection. In graphs that may be volumes, level sets are tried too
 * and taken if they are estimated to cost less than two thirds: in a 7-point grid they are diagonal
 * planes, and the largest has 3/4 of the vertices of a straight plane. There they cost 0.44 to 0.62
 * of it, on tori and in plates 0.75 and more, without being better once all borders are refined. */
static sl_status sli_dissect_graph(sli_dissection *d) {
    sli_tree_cost multilevel, flat;
    sl_status status = sli_dissect_multilevel(d);
    if (status != SL_OK || !sli_dissect_may_be_volume(d)) {
        return status;
    }
    multilevel = sli_tree_cost_times(sli_dissect_cost(d, &flat), 2);
    sli_dissect_swap(d);
    sli_dissect_levelset(d);
    if (sli_tree_cost_is_less(sli_tree_cost_times(sli_dissect_cost(d, &flat), 3), multilevel)) {
        d->band_growth = 0;
    } else {
        sli_dissect_swap(d);
    }
    return SL_OK;
}

#endif
