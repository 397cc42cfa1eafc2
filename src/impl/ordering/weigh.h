/* weigh.h: the edges of a coarse level as what a separator costs */
#ifndef SLI_ORDERING_WEIGH_H
#define SLI_ORDERING_WEIGH_H

#include "dissection.h"

/* Counts the vertices on one side of each edge, for a range of vertices of the last level. */
static void sli_weigh_range(void *data, const sli_range *r) {
    const sli_dissection *d = (const sli_dissection *)data;
    const sli_level *finest = &d->levels[0], *g = &d->levels[d->n_levels - 1];
    sl_off e, *at = sli_shares_scratch(&d->ranges, r->worker);
    sl_int k, i, *seen = (sl_int *)(void *)(at + g->n);
    memset(seen, -1, (size_t)g->n * sizeof(sl_int));
    for (k = r->first; k < r->last; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            at[g->to[e]] = e;
            g->edge[e] = 0;
        }
        for (i = d->begin[k]; i < d->begin[k + 1]; i++) {
            const sl_int v = d->order[i];
            for (e = finest->begin[v]; e < finest->begin[v + 1]; e++) {
                const sl_int c = d->label[finest->to[e]];
                if (c != k && seen[c] != v) {
                    seen[c] = v;
                    g->edge[at[c]]++;
                }
            }
        }
    }
}

/* Labels a range of the finest vertices with those of the last level that contain them. */
static void sli_weigh_labels(void *data, const sli_range *r) {
    const sli_dissection *d = (const sli_dissection *)data;
    sl_int v;
    int m;
    for (v = r->first; v < r->last; v++) {
        sl_int c = v;
        for (m = 0; m < d->n_levels - 1; m++) {
            c = d->levels[m].coarse[c];
        }
        d->label[v] = c;
    }
}

/* Sets the weight of each edge of the last level to the number of finest vertices on both sides of
 * the border that it represents: what a vertex separator there costs. The number of finest edges
 * would charge a diagonal border in a square grid twice as much as a straight one. The level has at
 * most half as many vertices as the ranges have room. */
static void sli_weigh_edges(sli_dissection *d) {
    const sli_level *g = &d->levels[d->n_levels - 1];
    const sl_int n = d->levels[0].n;
    sl_int *to = d->workers->subgraph.to, *count = d->workers->subgraph.edge;
    sl_off e, *at = d->ranges.scratch;
    sl_int k;
    sli_range_run(d->team, n, sli_shares_count(d->team, n), sli_weigh_labels, d);
    d->level = 0;
    sli_dissect_sort(d, g->n);
    sli_range_run(d->team, g->n, sli_shares_count(d->team, n), sli_weigh_range, d);
    /* The weights so far count the vertices of one side; add those of the other side from the
     * transposed lists. */
    memcpy(at, g->begin, (size_t)g->n * sizeof(sl_off));
    for (k = 0; k < g->n; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            const sl_off there = at[g->to[e]]++;
            to[there] = k;
            count[there] = g->edge[e];
        }
    }
    for (k = 0; k < g->n; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            at[g->to[e]] = e;
        }
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            g->edge[at[to[e]]] += count[e];
        }
    }
}

#endif
