/* thin.h: nested dissection of strips, tubes and bars along the levels of a breadth-first search */
#ifndef SLI_ORDERING_THIN_H
#define SLI_ORDERING_THIN_H

#include "septree.h"

/* A graph is thin if the sizes of its levels, weighed by themselves, have a mean of at most WIDTH,
 * give or take a sixteenth, and none is more than 4 times as large. In a strip of 20 rows across L
 * has 3 percent more entries than by multilevel dissection, in one of 30 rows 20 percent. */
#define SLI_THIN_WIDTH 22
/* Levels are even if their quadratic mean exceeds the plain one by at most EVEN percent: it does by
 * 1 to 2 in strips, tubes and bars, and by 12 to 27 in random graphs and around holes, where other
 * separators are far smaller than levels. */
#define SLI_THIN_EVEN 3
/* Parts are ordered by minimum degree once they have at most ASPECT times the vertices of a level,
 * within these limits. */
#define SLI_THIN_ASPECT 8
#define SLI_THIN_LEAF_MIN 64
#define SLI_THIN_LEAF_MAX 160
/* The largest percentage of a part that may be on one side of a separator, if there is a choice. */
#define SLI_THIN_BALANCE 65

/* Levels first..last-1, without what has been cut off behind position `end` of the queue. */
typedef struct sli_thin_part {
    sl_int first, last, end;
    sl_int above; /* node, or -1 */
} sli_thin_part;

typedef struct sli_thin {
    const sli_level *g;
    sl_int *queue;  /* the vertices by level; those next to the next level are behind the others */
    sl_int *begin;  /* levels + 1: where each begins */
    sl_int *ahead;  /* of each level: vertices next to the next one */
    sl_int *level;  /* of each vertex; -1: not reached */
    sl_int *spare;  /* n of scratch */
    sl_int *up;     /* of each node: the one above; nodes are numbered from the root */
    sl_int levels, leaf, parts;
    sli_thin_part *part; /* a stack of disjoint parts, none of them empty */
} sli_thin;

/* Searches a connected graph. Returns whether it is thin. It need not be searched to its end if it
 * is not: sqrt(squares * levels) - last only grows from level to level, by Cauchy and Schwarz. */
static int sli_thin_search(sli_thin *t, sl_int root) {
    const sli_level *g = t->g;
    const int64_t n = g->n;
    int64_t squares = 0;
    sl_int k, first, last, tail = 0;
    sl_off e;
    memset(t->level, -1, (size_t)n * sizeof(sl_int));
    t->queue[tail++] = root;
    t->level[root] = 0;
    for (first = 0; first < tail; first = last) {
        const sl_int next = t->levels + 1;
        sl_int at = first, ahead = 0;
        int64_t even;
        last = tail;
        for (k = first; k < last; k++) {
            const sl_int v = t->queue[k];
            int is_ahead = 0;
            for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
                const sl_int u = g->to[e];
                if (t->level[u] == -1) {
                    t->level[u] = next;
                    t->queue[tail++] = u;
                }
                is_ahead |= t->level[u] == next;
            }
            if (is_ahead) {
                t->spare[ahead++] = v;
            } else {
                t->queue[at++] = v;
            }
        }
        memcpy(t->queue + at, t->spare, (size_t)ahead * sizeof(sl_int));
        t->ahead[t->levels] = ahead;
        t->begin[t->levels] = first;
        t->levels = next;
        squares += (int64_t)(last - first) * (last - first);
        even = last + SLI_THIN_EVEN * n / 100;
        if (last - first > 4 * SLI_THIN_WIDTH || squares > SLI_THIN_WIDTH * (last + n / 16) ||
            squares > even * even / next) {
            return 0;
        }
    }
    t->begin[t->levels] = tail;
    t->leaf = sli_min((sl_int)(SLI_THIN_ASPECT * squares / n), SLI_THIN_LEAF_MAX);
    t->leaf = sli_max(t->leaf, SLI_THIN_LEAF_MIN);
    return 1;
}

/* The level whose last vertices separate the levels before it, and the others of its own, from
 * those behind it: of those that leave at most SLI_THIN_BALANCE percent on a side, the one of least
 * size times imbalance; otherwise the one that leaves least; -1 if there is only one level. */
static sl_int sli_thin_cut(const sli_thin *t, const sli_thin_part *p) {
    const sl_int begin = t->begin[p->first], n = p->end - begin;
    int64_t least = INT64_MAX;
    sl_int s, best = -1;
    for (s = p->first; s < p->last - 1; s++) {
        const sl_int next = t->begin[s + 1];
        const int64_t side = sli_max(next - t->ahead[s] - begin, p->end - next);
        const int64_t cost = 100 * side <= SLI_THIN_BALANCE * (int64_t)n ? side * t->ahead[s]
                                                                         : INT64_MAX / 2 + side;
        if (cost < least) {
            best = s;
            least = cost;
        }
    }
    return best;
}

static void sli_thin_push(sli_thin *t, sl_int first, sl_int last, sl_int end, sl_int above) {
    if (first < last) {
        sli_thin_part *p = &t->part[t->parts++];
        p->first = first;
        p->last = last;
        p->end = end;
        p->above = above;
    }
}

/* Makes nodes of all parts, each behind those below it in the order that ends at `end`. Returns how
 * many there are. */
static sl_int sli_thin_dissect(sli_thin *t, sli_dissect_worker *w, const sl_int *row, sl_int *perm,
                               sl_int end, sl_int *node_of) {
    sl_int k, node;
    for (node = 0; t->parts > 0; node++) {
        const sli_thin_part p = t->part[--t->parts];
        const sl_int size = p.end - t->begin[p.first];
        const sl_int cut = size <= t->leaf ? -1 : sli_thin_cut(t, &p);
        const sl_int count = cut == -1 ? size : t->ahead[cut];
        const sl_int from = cut == -1 ? t->begin[p.first] : t->begin[cut + 1] - count;
        if (cut == -1) {
            sli_mindeg_order(&w->mindeg, t->g, t->queue + from, count, w->subgraph.local, t->spare);
        } else {
            sli_thin_push(t, p.first, from > t->begin[cut] ? cut + 1 : cut, from, node);
            sli_thin_push(t, cut + 1, p.last, p.end, node);
        }
        end -= count;
        for (k = 0; k < count; k++) {
            perm[end + k] = row[t->queue[from + k]];
            node_of[perm[end + k]] = node;
        }
        t->up[node] = p.above;
    }
    return node;
}

/* Orders a connected graph, if it is thin, in place of a dissection: perm from `at` on, and nodes
 * of the separator tree. The graph is numbered in the order of a search from vertex 0, so that its
 * last vertex is an end. Returns whether it is thin. */
static int sli_order_thin(sli_dissection *d, const sl_int *row, sl_int *perm, sl_int at,
                          sli_septree *septree) {
    const sl_int n = d->levels[0].n;
    sl_int k, nodes, last, *scratch = d->workers[0].subgraph.scratch;
    sli_thin t;
    memset(&t, 0, sizeof t);
    t.g = &d->levels[0];
    t.queue = scratch;
    t.level = scratch + n;
    t.ahead = scratch + 2 * (size_t)n;
    t.up = scratch + 3 * (size_t)n;
    t.part = (sli_thin_part *)(void *)(scratch + 4 * (size_t)n);
    t.begin = d->begin;
    t.spare = d->order;
    if (!sli_thin_search(&t, n - 1)) {
        return 0;
    }
    sli_thin_push(&t, 0, t.levels, n, -1);
    nodes = sli_thin_dissect(&t, &d->workers[0], row, perm, at + n, septree->node_of);
    last = septree->count + nodes - 1;
    for (k = 0; k < nodes; k++) {
        septree->parent[last - k] = t.up[k] == -1 ? -1 : last - t.up[k];
    }
    for (k = at; k < at + n; k++) {
        septree->node_of[perm[k]] = last - septree->node_of[perm[k]];
    }
    septree->count += nodes;
    return 1;
}

#endif
