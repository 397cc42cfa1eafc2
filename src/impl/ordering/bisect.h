/* order_bisect.h: a part cut in two by growing one half, and a cut made lighter by moving vertices across */
#ifndef SLI_ORDER_BISECT_H
#define SLI_ORDER_BISECT_H

#include "order_heap.h"
#include "order_piece.h"

#define SLI_BALANCE 0.6 /* most of the weight that one side may get */

/* What a cut costs: its edges, more where the sides differ. */
SLI_INLINE double sli_cut_cost(double cut, const int64_t *total) {
    const double sum = (double)(total[0] + total[1]);
    const double skew = sum > 0.0 ? fabs((double)(total[0] - total[1])) / sum : 0.0;
    return cut * (1.0 + skew);
}

/* Edges of v across the cut minus those on its own side: what the cut loses if v moves. */
static sl_int sli_piece_gain(const sli_piece *p, sl_int v, int *on_border) {
    const int side = p->side[v];
    sl_int across = side != p->home[v] ? p->anchor[v] : 0;
    sl_int own = p->anchor[v] - across;
    sl_off e;
    for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
        if (p->side[p->to[e]] != side) {
            across += p->edge[e];
        } else {
            own += p->edge[e];
        }
    }
    *on_border = across > 0;
    return across - own;
}

static int64_t sli_piece_cut(const sli_piece *p) {
    int64_t twice = 0;
    sl_int v;
    sl_off e;
    for (v = 0; v < p->n; v++) {
        for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
            twice += p->side[p->to[e]] != p->side[v] ? p->edge[e] : 0;
        }
        twice += p->side[v] != p->home[v] ? 2 * (int64_t)p->anchor[v] : 0;
    }
    return twice / 2;
}

typedef struct sli_mover {
    sli_piece *p;
    sli_heap heap[2]; /* by side */
    unsigned char *locked;
    sl_int *moves; /* in the order in which they were made */
    int64_t most;  /* weight of a side */
} sli_mover;

SLI_INLINE int sli_mover_may(const sli_mover *m, sl_int v) {
    const sli_piece *p = m->p;
    const int from = p->side[v];
    const int64_t after = p->total[1 - from] + p->weight[v];
    return after <= m->most || after <= p->total[from];
}

/* The side whose best vertex should move next, -1 if none may. */
static int sli_mover_choose(const sli_mover *m) {
    int side, best = -1;
    for (side = 0; side < 2; side++) {
        const sli_heap *h = &m->heap[side];
        if (h->count > 0 && sli_mover_may(m, h->item[0])) {
            if (best == -1 || h->key[h->item[0]] > h->key[m->heap[best].item[0]] ||
                (h->key[h->item[0]] == h->key[m->heap[best].item[0]] &&
                 m->p->total[side] > m->p->total[best])) {
                best = side;
            }
        }
    }
    return best;
}

static void sli_mover_flip(sli_mover *m, sl_int v) {
    sli_piece *p = m->p;
    const int from = p->side[v];
    p->side[v] = (unsigned char)(1 - from);
    p->total[from] -= p->weight[v];
    p->total[1 - from] += p->weight[v];
}

/* Neighbours of a vertex that has just moved. */
static void sli_mover_update(sli_mover *m, sl_int v) {
    sli_piece *p = m->p;
    sl_off e;
    for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
        const sl_int u = p->to[e];
        sli_heap *h = &m->heap[p->side[u]];
        if (m->locked[u]) {
            continue;
        }
        if (h->place[u] == -1) {
            int on_border;
            h->key[u] = sli_piece_gain(p, u, &on_border);
            if (on_border) {
                sli_heap_add(h, u);
            }
        } else {
            h->key[u] += p->side[u] == p->side[v] ? -2 * p->edge[e] : 2 * p->edge[e];
            sli_heap_settle(h, u);
        }
    }
}

/* One round: moves the best vertex again and again, for better or worse, each vertex once, and goes
 * back to the best cut on the way. Returns whether that is better than where it started. */
static int sli_mover_round(sli_mover *m, double *cut) {
    sli_piece *p = m->p;
    const sl_int patience = 20 + p->n / 20 < 100 ? 20 + p->n / 20 : 100;
    double here = *cut, cost = sli_cut_cost(here, p->total), best_cost = cost;
    sl_int v, made = 0, best = 0;
    int side;
    m->heap[0].count = m->heap[1].count = 0;
    for (v = 0; v < p->n; v++) {
        int on_border;
        m->locked[v] = 0;
        m->heap[0].place[v] = -1;
        m->heap[0].key[v] = sli_piece_gain(p, v, &on_border);
        if (on_border) {
            sli_heap_add(&m->heap[p->side[v]], v);
        }
    }
    while (made - best < patience && (side = sli_mover_choose(m)) != -1) {
        v = m->heap[side].item[0];
        sli_heap_remove(&m->heap[side], v);
        m->locked[v] = 1;
        here -= m->heap[side].key[v];
        sli_mover_flip(m, v);
        sli_mover_update(m, v);
        m->moves[made++] = v;
        cost = sli_cut_cost(here, p->total);
        if (cost < best_cost) {
            best_cost = cost;
            best = made;
            *cut = here;
        }
    }
    while (made > best) {
        sli_mover_flip(m, m->moves[--made]);
    }
    return best > 0;
}

static sli_mover sli_mover_of(sli_piece *p) {
    sli_mover m;
    m.p = p;
    m.heap[0].place = m.heap[1].place = p->scratch;
    m.heap[0].key = m.heap[1].key = p->scratch + p->n;
    m.heap[0].item = p->scratch + 2 * (size_t)p->n;
    m.heap[1].item = p->scratch + 3 * (size_t)p->n;
    m.moves = p->scratch + 4 * (size_t)p->n;
    m.locked = p->locked;
    m.heap[0].count = m.heap[1].count = 0;
    m.most = (int64_t)(SLI_BALANCE * (double)(p->total[0] + p->total[1]));
    return m;
}

/* Makes the cut of a part lighter and returns what it costs. [FM82] */
static double sli_piece_improve(sli_piece *p, int rounds) {
    sli_mover m = sli_mover_of(p);
    double cut = (double)sli_piece_cut(p);
    while (rounds-- > 0 && sli_mover_round(&m, &cut)) {
    }
    return sli_cut_cost(cut, p->total);
}

/* A vertex of the part far from v. queue, seen: n of scratch. */
static sl_int sli_piece_far(const sli_piece *p, sl_int v, sl_int *queue, unsigned char *seen) {
    sl_int head, tail = 0;
    sl_off e;
    memset(seen, 0, (size_t)p->n);
    queue[tail++] = v;
    seen[v] = 1;
    for (head = 0; head < tail; head++) {
        for (e = p->begin[queue[head]]; e < p->begin[queue[head] + 1]; e++) {
            if (!seen[p->to[e]]) {
                seen[p->to[e]] = 1;
                queue[tail++] = p->to[e];
            }
        }
    }
    return queue[tail - 1];
}

/* Puts half of the weight on the left, starting with seed: always the vertex next that leaves the
 * lightest cut. */
static void sli_piece_grow(sli_piece *p, sl_int seed) {
    sli_mover m = sli_mover_of(p);
    sl_int v, unseen = 0;
    p->total[1] += p->total[0];
    p->total[0] = 0;
    memset(p->side, 1, (size_t)p->n);
    memset(m.locked, 0, (size_t)p->n);
    for (v = 0; v < p->n; v++) {
        m.heap[0].place[v] = -1;
    }
    v = seed;
    for (;;) {
        m.locked[v] = 1;
        sli_mover_flip(&m, v);
        if (p->total[0] >= p->total[1]) {
            break;
        }
        sli_mover_update(&m, v);
        if (m.heap[1].count > 0) {
            v = m.heap[1].item[0];
            sli_heap_remove(&m.heap[1], v);
        } else { /* the part is not connected */
            while (unseen < p->n && m.locked[unseen]) {
                unseen++;
            }
            if (unseen == p->n) {
                break;
            }
            v = unseen;
        }
    }
}

/* Cuts a part in two: the best of some tries. */
static void sli_piece_bisect(sli_piece *p, int tries, int rounds) {
    double best = -1.0;
    int64_t total[2] = {0, 0};
    int k;
    for (k = 0; k < tries; k++) {
        sl_int seed = (sl_int)(sli_scatter((uint32_t)k + 77u) % (uint32_t)p->n);
        double cost;
        if (k % 2 == 0) {
            seed = sli_piece_far(p, seed, p->scratch, p->locked);
        }
        sli_piece_grow(p, seed);
        cost = sli_piece_improve(p, rounds);
        if (k == 0 || cost < best) {
            best = cost;
            memcpy(p->best, p->side, (size_t)p->n);
            total[0] = p->total[0];
            total[1] = p->total[1];
        }
    }
    memcpy(p->side, p->best, (size_t)p->n);
    p->total[0] = total[0];
    p->total[1] = total[1];
}

#endif
