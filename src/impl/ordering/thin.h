/* thin.h: nested dissection of strips, tubes and bars along the levels of a breadth-first search */
#ifndef SLI_ORDERING_THIN_H
#define SLI_ORDERING_THIN_H

#include "job.h"
#include "levelset.h"

/* A graph is thin if the sizes of its levels, weighed by themselves, have a mean of at most WIDTH,
 * give or take a sixteenth. In a strip of 20 rows across L has 3 percent more entries than by
 * multilevel dissection, in one of 30 rows 20 percent. */
#define SLI_THIN_WIDTH 22
/* The levels are even if their quadratic mean exceeds the plain one by at most EVEN percent: it
 * does by 1 to 2 in strips, tubes and bars, and by 12 to 27 in random graphs and around holes,
 * where other separators are far smaller than levels. */
#define SLI_THIN_EVEN 3
/* Parts are ordered by minimum degree once they have at most ASPECT times the vertices of a level,
 * within these limits. */
#define SLI_THIN_ASPECT 8
#define SLI_THIN_LEAF_MIN 64
#define SLI_THIN_LEAF_MAX 250

/* Positions first..end-1 of the queue. */
typedef struct sli_thin_part {
    sl_int first, end, levels;
    sl_int above; /* node, or -1 */
} sli_thin_part;

typedef struct sli_thin {
    const sli_level *g;
    sl_int *queue; /* the vertices by level; those next to the next level are behind the others */
    sl_int *mark;  /* of each vertex: its level; -1: not reached */
    sl_int *begin; /* of each level, where it begins: those of a part are numbered from its first
                      position on */
    sl_int *ahead; /* of each level: vertices next to the next one */
    sl_int *spare; /* n */
    sl_int *up;    /* of each node: the one above; nodes are numbered from the root */
    sl_int leaf, parts;
    sli_thin_part *part; /* a stack of disjoint parts, none of them empty */
} sli_thin;

/* Appends what is next to a level, which is at first..last-1 of the queue. Returns the new end. */
static sl_int sli_thin_level(sli_thin *t, sl_int level, sl_int first, sl_int last) {
    const sli_level *g = t->g;
    sl_int k, at = first, ahead = 0, tail = last;
    sl_off e;
    for (k = first; k < last; k++) {
        const sl_int v = t->queue[k];
        int is_ahead = 0;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e];
            if (t->mark[u] == -1) {
                t->mark[u] = level + 1;
                t->queue[tail++] = u;
            }
            is_ahead |= t->mark[u] > level;
        }
        if (is_ahead) {
            t->spare[ahead++] = v;
        } else {
            t->queue[at++] = v;
        }
    }
    SLI_COPY(t->queue + at, t->spare, ahead);
    t->ahead[level] = ahead;
    t->begin[level] = first;
    return tail;
}

static void sli_thin_push(sli_thin *t, sl_int first, sl_int end, sl_int levels, sl_int above) {
    if (first < end) {
        sli_thin_part *p = &t->part[t->parts++];
        p->first = first;
        p->end = end;
        p->levels = levels;
        p->above = above;
    }
}

/* Searches a connected graph. Returns whether it is thin. It need not be searched to its end if it
 * is not: sqrt(squares * levels) - last only grows from level to level, by Cauchy and Schwarz. */
static int sli_thin_search(sli_thin *t, sl_int root) {
    const int64_t n = t->g->n;
    int64_t squares = 0;
    sl_int first = 0, last = 1, levels = 0;
    SLI_NONE(t->mark, n);
    t->queue[0] = root;
    t->mark[root] = 0;
    while (first < last) {
        const sl_int tail = sli_thin_level(t, levels++, first, last);
        const int64_t size = last - first, even = last + SLI_THIN_EVEN * n / 100;
        squares += size * size;
        if (squares > SLI_THIN_WIDTH * (last + n / 16) || squares > even * even / levels) {
            return 0;
        }
        first = last;
        last = tail;
    }
    t->leaf = sli_min((sl_int)(SLI_THIN_ASPECT * squares / n), SLI_THIN_LEAF_MAX);
    t->leaf = sli_max(t->leaf, SLI_THIN_LEAF_MIN);
    sli_thin_push(t, 0, (sl_int)n, levels, -1);
    return 1;
}

/* The level whose last vertices separate the levels before it, and the others of its own, from
 * those behind it: of those that leave at most SLI_LEVELSET_BALANCE percent on a side, the one
 * of least size times imbalance; otherwise the one that leaves least; -1 if there is only one. */
static sl_int sli_thin_cut(const sli_thin *t, const sli_thin_part *p) {
    const sl_int n = p->end - p->first;
    int64_t least = INT64_MAX;
    sl_int s, best = -1;
    for (s = p->first; s < p->first + p->levels - 1; s++) {
        const sl_int next = t->begin[s + 1];
        const int64_t side = sli_max(next - t->ahead[s] - p->first, p->end - next);
        const int64_t cost = 100 * side <= SLI_LEVELSET_BALANCE * (int64_t)n ? side * t->ahead[s]
                                                                             : INT64_MAX / 2 + side;
        if (cost < least) {
            best = s;
            least = cost;
        }
    }
    return best;
}

/* Splits a part behind a level, of which the vertices from position `end` on become a node. */
static void sli_thin_split(sli_thin *t, const sli_thin_part *p, sl_int cut, sl_int end,
                           sl_int node) {
    const sl_int next = t->begin[cut + 1], before = cut - p->first + (end > t->begin[cut]);
    const sl_int behind = p->first + p->levels - 1 - cut;
    sli_thin_push(t, p->first, end, before, node);
    sli_thin_push(t, next, p->end, behind, node);
    memmove(t->begin + next, t->begin + cut + 1, (size_t)behind * sizeof(sl_int));
    memmove(t->ahead + next, t->ahead + cut + 1, (size_t)behind * sizeof(sl_int));
}

/* Makes nodes of all parts, each behind those below it in the order that ends at `end`. Returns how
 * many there are. */
static sl_int sli_thin_dissect(sli_thin *t, sli_dissect_worker *w, const sl_int *row, sl_int *perm,
                               sl_int end, sl_int *node_of) {
    sl_int k, node;
    for (node = 0; t->parts > 0; node++) {
        const sli_thin_part p = t->part[--t->parts];
        const sl_int size = p.end - p.first;
        const sl_int cut = size <= t->leaf ? -1 : sli_thin_cut(t, &p);
        const sl_int count = cut == -1 ? size : t->ahead[cut];
        const sl_int from = cut == -1 ? p.first : t->begin[cut + 1] - count;
        if (cut == -1) {
            sli_mindeg_order(&w->mindeg, t->g, t->queue + from, count);
        } else {
            sli_thin_split(t, &p, cut, from, node);
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
 * of the separator tree. Returns whether it is. The graph is numbered in the order of a search from
 * vertex 0, so that its last vertex is an end. */
static int sli_order_thin(sli_dissection *d, const sl_int *row, sl_int *perm, sl_int at,
                          sli_septree *septree) {
    const sl_int n = d->levels[0].n;
    sli_dissect_worker *w = &d->workers[0];
    sl_int k, nodes, last, *scratch = w->subgraph.scratch;
    sli_thin t;
    SLI_CLEAR(t);
    t.g = &d->levels[0];
    t.queue = scratch;
    t.mark = scratch + n;
    t.ahead = scratch + 2 * (size_t)n;
    t.up = scratch + 3 * (size_t)n;
    t.part = (sli_thin_part *)(void *)(scratch + 4 * (size_t)n);
    t.begin = d->begin;
    t.spare = d->order;
    if (!sli_thin_search(&t, n - 1)) {
        return 0;
    }
    w->mindeg.order = t.spare; /* the scratch of leaves has the queue */
    nodes = sli_thin_dissect(&t, w, row, perm, at + n, septree->node_of);
    w->mindeg.order = scratch;
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
