/* bisect.h: graph bisection: greedy graph growing, and Fiduccia-Mattheyses refinement of a cut */
#ifndef SLI_ORDERING_BISECT_H
#define SLI_ORDERING_BISECT_H

#include "subgraph.h"

/* A vertex in a priority queue, by its gain. */
typedef struct sli_heap_item {
    sl_int key, vertex;
} sli_heap_item;

/* A binary heap. Several heaps may share `position`, because a vertex is in at most one of them. */
typedef struct sli_heap {
    sl_int count;
    sli_heap_item *item; /* count; item[0] has the largest key */
    sl_int *position;    /* by vertex: its index in item, or -1 */
} sli_heap;

SLI_INLINE void sli_heap_up(sli_heap *h, sl_int k, sli_heap_item v) {
    while (k > 0 && h->item[(k - 1) / 2].key < v.key) {
        h->item[k] = h->item[(k - 1) / 2];
        h->position[h->item[k].vertex] = k;
        k = (k - 1) / 2;
    }
    h->item[k] = v;
    h->position[v.vertex] = k;
}

SLI_INLINE void sli_heap_down(sli_heap *h, sl_int k, sli_heap_item v) {
    for (;;) {
        sl_int c = 2 * k + 1;
        if (c >= h->count) {
            break;
        }
        c += c + 1 < h->count && h->item[c + 1].key > h->item[c].key;
        if (h->item[c].key <= v.key) {
            break;
        }
        h->item[k] = h->item[c];
        h->position[h->item[k].vertex] = k;
        k = c;
    }
    h->item[k] = v;
    h->position[v.vertex] = k;
}

/* Adds v, or gives it another key. With a larger one it does not move down. */
SLI_INLINE void sli_heap_set(sli_heap *h, sl_int vertex, sl_int key) {
    const sl_int at = h->position[vertex], k = at == -1 ? h->count++ : at;
    sli_heap_item v;
    v.vertex = vertex;
    v.key = key;
    if (at == -1 || key >= h->item[k].key) {
        sli_heap_up(h, k, v);
    } else {
        sli_heap_down(h, k, v);
    }
}

/* Removes and returns the vertex of the largest key. */
SLI_INLINE sl_int sli_heap_pop(sli_heap *h) {
    const sl_int vertex = h->item[0].vertex;
    h->position[vertex] = -1;
    if (--h->count > 0) {
        sli_heap_down(h, 0, h->item[h->count]);
    }
    return vertex;
}

#define SLI_BISECT_BALANCE 60 /* percent of the weight that one side may get */

/* The cost of a cut: the weight of its edges times that of the heavier side, so that imbalance
 * increases it. At most 2^31 * 2^31. */
SLI_INLINE int64_t sli_cut_cost(int64_t cut, const int64_t *total) {
    return cut * (total[0] > total[1] ? total[0] : total[1]);
}

/* The state of a Fiduccia-Mattheyses refinement. */
typedef struct sli_fm {
    sli_subgraph *sub;
    sli_heap heap[2]; /* one for each side */
    unsigned char *locked;
    sl_int *degree; /* n: the weight of all edges of a vertex, external ones included */
    sl_int *gain;   /* n: the weight of its edges across the cut minus that of the others */
    sl_int *moves;  /* the vertices moved so far */
    int64_t most;   /* largest weight of a side */
} sli_fm;

/* Returns whether v may move: afterwards its new side is within the limit, or not heavier than its
 * old side is now. */
SLI_INLINE int sli_fm_may_move(const sli_fm *m, sl_int v) {
    const sli_subgraph *sub = m->sub;
    const int from = sub->side[v];
    const int64_t after = sub->total[1 - from] + sub->weight[v];
    return after <= m->most || after <= sub->total[from];
}

/* The side whose best vertex should move next, or -1 if no vertex may move. */
static int sli_fm_choose(const sli_fm *m) {
    int side, best = -1;
    for (side = 0; side < 2; side++) {
        const sli_heap *h = &m->heap[side];
        if (h->count > 0 && sli_fm_may_move(m, h->item[0].vertex)) {
            if (best == -1 || h->item[0].key > m->heap[best].item[0].key ||
                (h->item[0].key == m->heap[best].item[0].key &&
                 m->sub->total[side] > m->sub->total[best])) {
                best = side;
            }
        }
    }
    return best;
}

/* Moves v to the other side. queue: its neighbors, now at the border, may move as well. */
SLI_INLINE void sli_fm_flip(sli_fm *m, sl_int v, int queue) {
    sli_subgraph *sub = m->sub;
    const int from = sub->side[v];
    sl_off e;
    sub->side[v] = (unsigned char)(1 - from);
    sub->total[from] -= sub->weight[v];
    sub->total[1 - from] += sub->weight[v];
    m->gain[v] = -m->gain[v];
    for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
        const sl_int u = sub->to[e];
        m->gain[u] += sub->side[u] == from ? 2 * sub->edge[e] : -2 * sub->edge[e];
        if (queue && !m->locked[u]) {
            sli_heap_set(&m->heap[sub->side[u]], u, m->gain[u]);
        }
    }
}

/* One pass: repeatedly moves the vertex of highest gain, even at a loss, but each vertex only once;
 * then undoes the moves after the best cut. Returns whether that cut is better than the first. */
static int sli_fm_pass(sli_fm *m, int64_t *cut) {
    sli_subgraph *sub = m->sub;
    const sl_int patience = 10 + sub->n / 20 < 100 ? 10 + sub->n / 20 : 100;
    int64_t here = *cut, cost = sli_cut_cost(here, sub->total), best_cost = cost;
    sl_int v, made = 0, best = 0;
    int side;
    m->heap[0].count = m->heap[1].count = 0;
    for (v = 0; v < sub->n; v++) {
        m->locked[v] = 0;
        m->heap[0].position[v] = -1;
        if (m->gain[v] > -m->degree[v]) { /* at the border */
            sli_heap_set(&m->heap[sub->side[v]], v, m->gain[v]);
        }
    }
    while (made - best < patience && (side = sli_fm_choose(m)) != -1) {
        v = sli_heap_pop(&m->heap[side]);
        m->locked[v] = 1;
        here -= m->gain[v];
        sli_fm_flip(m, v, 1);
        m->moves[made++] = v;
        cost = sli_cut_cost(here, sub->total);
        if (cost < best_cost) {
            best_cost = cost;
            best = made;
            *cut = here;
        }
    }
    while (made > best) {
        sli_fm_flip(m, m->moves[--made], 0);
    }
    return best > 0;
}

/* A refinement of a subgraph, in its scratch arrays. No vertex has left its home. */
static sli_fm sli_fm_of(sli_subgraph *sub) {
    const size_t n = (size_t)sub->n;
    sli_fm m;
    sl_int v;
    sl_off e;
    m.sub = sub;
    m.heap[0].position = m.heap[1].position = sub->scratch;
    m.gain = sub->scratch + n;
    m.degree = sub->scratch + 2 * n;
    m.moves = sub->scratch + 3 * n;
    m.heap[0].item = (sli_heap_item *)(void *)(sub->scratch + 4 * n);
    m.heap[1].item = m.heap[0].item + n;
    m.locked = sub->locked;
    m.most = (sub->total[0] + sub->total[1]) * SLI_BISECT_BALANCE / 100;
    for (v = 0; v < sub->n; v++) {
        sl_int within = sub->external[v], across = 0;
        for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
            across += sub->side[sub->to[e]] != sub->side[v] ? sub->edge[e] : 0;
            within += sub->edge[e];
        }
        within -= across;
        m.degree[v] = across + within;
        m.gain[v] = across - within;
    }
    return m;
}

/* Refines a cut in up to `rounds` passes and returns its cost. [FM82] */
static int64_t sli_fm_refine(sli_fm *m, int rounds) {
    int64_t cut = 0;
    sl_int v;
    for (v = 0; v < m->sub->n; v++) {
        cut += m->degree[v] + m->gain[v];
    }
    cut /= 4;
    while (rounds-- > 0 && sli_fm_pass(m, &cut)) {
    }
    return sli_cut_cost(cut, m->sub->total);
}

/* A vertex far from v: the last one that a breadth-first search reaches. queue, seen: n + 1 and n
 * of scratch. */
static sl_int sli_subgraph_farthest(const sli_subgraph *sub, sl_int v, sl_int *queue,
                                    unsigned char *seen) {
    sl_int head, tail = 0;
    sl_off e;
    SLI_ZERO(seen, sub->n);
    queue[tail++] = v;
    seen[v] = 1;
    for (head = 0; head < tail; head++) {
        for (e = sub->begin[queue[head]]; e < sub->begin[queue[head] + 1]; e++) {
            queue[tail] = sub->to[e];
            tail += !seen[sub->to[e]];
            seen[sub->to[e]] = 1;
        }
    }
    return queue[tail - 1];
}

/* Grows side 0 from seed until it has half of the weight. The next vertex is always the one that
 * leaves the lightest cut. */
static void sli_fm_grow(sli_fm *m, sl_int seed) {
    sli_subgraph *sub = m->sub;
    sl_int v, unseen = 0;
    sub->total[1] += sub->total[0];
    sub->total[0] = 0;
    m->heap[1].count = 0;
    memset(sub->side, 1, (size_t)sub->n);
    SLI_ZERO(m->locked, sub->n);
    for (v = 0; v < sub->n; v++) {
        m->heap[0].position[v] = -1;
        m->gain[v] = -m->degree[v];
    }
    v = seed;
    for (;;) {
        m->locked[v] = 1;
        sli_fm_flip(m, v, 1);
        if (sub->total[0] >= sub->total[1]) {
            break;
        }
        if (m->heap[1].count > 0) {
            v = sli_heap_pop(&m->heap[1]);
        } else {                        /* the subgraph is not connected */
            while (m->locked[unseen]) { /* not all are, as side 1 has weight */
                unseen++;
                SLI_ASSERT(unseen < sub->n);
            }
            v = unseen;
        }
    }
}

/* Bisects a subgraph: refines the cheapest cut of several tries, each of which has one pass. */
static void sli_subgraph_bisect(sli_subgraph *sub, int tries) {
    sli_fm m = sli_fm_of(sub);
    int64_t best = 0, total[2] = {0, 0};
    int k;
    for (k = 0; k < tries; k++) {
        sl_int seed = (sl_int)(sli_hash32((uint32_t)k + 77u) % (uint32_t)sub->n);
        int64_t cost;
        if (k % 2 == 0) {
            seed = sli_subgraph_farthest(sub, seed, sub->scratch, sub->locked);
        }
        sli_fm_grow(&m, seed);
        cost = sli_fm_refine(&m, 1);
        if (k == 0 || cost < best) {
            best = cost;
            memcpy(sub->best, sub->side, (size_t)sub->n);
            total[0] = sub->total[0];
            total[1] = sub->total[1];
        }
    }
    memcpy(sub->side, sub->best, (size_t)sub->n);
    sub->total[0] = total[0];
    sub->total[1] = total[1];
    m = sli_fm_of(sub);
    sli_fm_refine(&m, 2);
}

#endif
