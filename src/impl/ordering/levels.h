/* levels.h: orders thin graphs by the levels of a breadth-first search, the last level first */
#ifndef SLI_ORDERING_LEVELS_H
#define SLI_ORDERING_LEVELS_H

#include "graph.h"

/* Largest mean number of entries in a column of L. A strip of 20 rows across has 22, a fourth more
 * than with minimum degree, which takes five times as long to find its order. Wider ones gain, too,
 * but then solves lose more. */
#define SLI_LEVELS_MOST 32
/* A search from any row finds up to this many times as many entries as one from an end: in the
 * middle of a strip, two. */
#define SLI_LEVELS_TRY 4

/* Searches the component of `root` and appends its rows to queue, from `start` on, level by level,
 * until there are more entries than `most`. The front of a row is about its level, or a mean of its
 * level and the next one. seen: n; smaller than `mark` for rows that are not reached. Returns where
 * the rows end. */
static sl_int sli_levels_search(const sli_graph *G, sl_int root, sl_int *queue, sl_int start,
                                sl_int *seen, sl_int mark, int64_t most, int64_t *entries) {
    sl_int first = start, last, tail = start, before = 0, k;
    sl_off e;
    queue[tail++] = root;
    seen[root] = mark;
    for (; first < tail && *entries <= most; first = last) {
        last = tail;
        for (k = first; k < last; k++) {
            for (e = G->begin[queue[k]]; e < G->begin[queue[k] + 1]; e++) {
                const sl_int u = G->to[e];
                if (seen[u] < mark) {
                    seen[u] = mark;
                    queue[tail++] = u;
                }
            }
        }
        *entries += (int64_t)(last - first) * (last - first + before) / 2;
        before = last - first;
    }
    return tail;
}

/* Orders G if it is thin: each component from the level that is farthest from one of its ends. Fill
 * stays within the front that moves along each branch. Returns whether perm is an order, and sets
 * *estimate to about the entries of L. seen: n of scratch. */
static int sli_order_levels(const sli_graph *G, sl_int *perm, sl_int *seen, sl_off *estimate) {
    const int64_t most = SLI_LEVELS_MOST * (int64_t)G->n;
    int64_t entries = 0, tried;
    sl_int v, end, start = 0;
    memset(seen, 0, (size_t)G->n * sizeof(sl_int));
    for (v = 0; v < G->n && entries <= most; v++) {
        if (seen[v] != 0) {
            continue;
        }
        tried = 0;
        end = sli_levels_search(G, v, perm, start, seen, 1, SLI_LEVELS_TRY * most, &tried);
        if (tried > SLI_LEVELS_TRY * most) {
            return 0;
        }
        start = sli_levels_search(G, perm[end - 1], perm, start, seen, 2, most, &entries);
    }
    for (v = 0; v < G->n / 2; v++) {
        const sl_int other = perm[v];
        perm[v] = perm[G->n - 1 - v];
        perm[G->n - 1 - v] = other;
    }
    *estimate = entries <= most ? entries : 0;
    return entries <= most;
}

#endif
