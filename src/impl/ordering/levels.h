/* levels.h: breadth-first levels, and the order of thin graphs by them, the last level first */
#ifndef SLI_ORDERING_LEVELS_H
#define SLI_ORDERING_LEVELS_H

#include "job.h"

/* Largest mean number of entries in a column of L. A strip of 20 rows across has 22, a fourth more
 * than with minimum degree, which takes five times as long to find its order. Wider ones gain, too,
 * but then solves lose more. */
#define SLI_LEVELS_MOST 32
/* A search from any row finds up to this many times as many entries as one from an end: in the
 * middle of a strip, two. */
#define SLI_LEVELS_TRY 4

/* Breadth-first searches of the components of a graph. */
typedef struct sli_levels {
    const sli_graph *G;
    sl_int *queue;   /* n */
    sl_int *seen;    /* n: smaller than the mark of a search for rows that it has not reached */
    int64_t entries; /* of L, about, if it is ordered by levels */
} sli_levels;

/* Searches the component of `root` and appends its rows to the queue, from `start` on, level by
 * level, until there are more entries than `most`. The front of a row is about its level, or a mean
 * of its level and the next one. Returns where the rows end. */
static sl_int sli_levels_search(sli_levels *l, sl_int root, sl_int start, sl_int mark,
                                int64_t most) {
    const sli_graph *G = l->G;
    sl_int *queue = l->queue, *seen = l->seen;
    sl_int first = start, last, tail = start, before = 0, k;
    int64_t entries = l->entries;
    sl_off e;
    queue[tail++] = root;
    seen[root] = mark;
    for (; first < tail && entries <= most; first = last) {
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
        entries += (int64_t)(last - first) * (last - first + before) / 2;
        before = last - first;
    }
    l->entries = entries;
    return tail;
}

static sli_levels sli_levels_of(const sli_order_job *job) {
    sli_levels l;
    l.G = job->G;
    l.queue = job->perm;
    l.seen = job->scratch;
    l.entries = 0;
    SLI_ZERO(l.seen, l.G->n);
    return l;
}

/* Orders the graph of a job, without weights, if it is thin: each component from the level that is
 * farthest from one of its ends. Fill stays within the front that moves along each branch. Returns
 * whether the job's perm is an order. */
static int sli_order_levels(const sli_order_job *job) {
    const sl_int n = job->G->n;
    const int64_t most = SLI_LEVELS_MOST * (int64_t)n;
    sli_levels found = sli_levels_of(job);
    sl_int v, end, start = 0;
    for (v = 0; v < n && found.entries <= most; v++) {
        sli_levels tried = found;
        if (found.seen[v] != 0) {
            continue;
        }
        tried.entries = 0;
        end = sli_levels_search(&tried, v, start, 1, SLI_LEVELS_TRY * most);
        if (tried.entries > SLI_LEVELS_TRY * most) {
            return 0;
        }
        start = sli_levels_search(&found, found.queue[end - 1], start, 2, most);
    }
    for (v = 0; v < n / 2; v++) {
        const sl_int other = found.queue[v];
        found.queue[v] = found.queue[n - 1 - v];
        found.queue[n - 1 - v] = other;
    }
    return found.entries <= most;
}

#endif
