/* order_piece.h: a piece of a graph in a numbering of its own: a whole part, or a band along a border */
#ifndef SLI_ORDER_PIECE_H
#define SLI_ORDER_PIECE_H

#include "order_tree.h"

/* Vertices of one side of a node, of both, or a few layers of each along the border between them.
 * Edges to what lies outside but on the same side are counted in anchor. */
typedef struct sli_piece {
    sl_int n;
    sl_int *vertex; /* n: number in the level */
    sl_off *begin;  /* n + 1 */
    sl_int *to, *edge;
    sl_int *weight;
    sl_int *anchor;               /* n */
    unsigned char *side;          /* n: 0 left, 1 right, 2 separator */
    unsigned char *home;          /* n: the side that anchor holds to */
    unsigned char *layer;         /* n: distance to the border */
    int64_t total[2];             /* weight of each side, with what lies outside */
    sl_int *place;                /* a vertex of the level: its number here, -1 if it is not here */
    unsigned char *locked, *best; /* n: of the search for a cut */
    sl_int *scratch;              /* 6 n */
} sli_piece;

static void sli_piece_layout(sli_piece *p, sli_block *b, sl_int n, sl_off edges) {
    p->vertex = SLI_TAKE(b, sl_int, n);
    p->begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
    p->to = SLI_TAKE(b, sl_int, edges);
    p->edge = SLI_TAKE(b, sl_int, edges);
    p->weight = SLI_TAKE(b, sl_int, n);
    p->anchor = SLI_TAKE(b, sl_int, n);
    p->side = SLI_TAKE(b, unsigned char, n);
    p->home = SLI_TAKE(b, unsigned char, n);
    p->layer = SLI_TAKE(b, unsigned char, n);
    p->place = SLI_TAKE(b, sl_int, n);
    p->locked = SLI_TAKE(b, unsigned char, n);
    p->best = SLI_TAKE(b, unsigned char, n);
    p->scratch = SLI_TAKE(b, sl_int, 6 * (uint64_t)n);
}

SLI_INLINE void sli_piece_add(sli_piece *p, sl_int v, int layer) {
    p->place[v] = p->n;
    p->layer[p->n] = (unsigned char)layer;
    p->vertex[p->n++] = v;
}

static void sli_piece_clear(sli_piece *p) {
    sl_int k;
    for (k = 0; k < p->n; k++) {
        p->place[p->vertex[k]] = -1;
    }
    p->n = 0;
}

/* The edges between the vertices that were added; all of them below node. */
static void sli_piece_edges(sli_piece *p, const sli_level *g, const sli_tree *t, sl_int node,
                            const sl_int *label) {
    sl_int k;
    sl_off e, count = 0;
    for (k = 0; k < p->n; k++) {
        const sl_int v = p->vertex[k];
        p->begin[k] = count;
        p->weight[k] = sli_level_weight(g, v);
        p->anchor[k] = 0;
        p->side[k] = p->home[k] = label[v] > node;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e];
            if (p->place[u] != -1) {
                p->to[count] = p->place[u];
                p->edge[count++] = sli_level_edge(g, e);
            } else if (sli_tree_is_below(t, node, label[u])) {
                p->anchor[k] += sli_level_edge(g, e);
            }
        }
    }
    p->begin[p->n] = count;
}

/* The vertices of a leaf. */
static void sli_piece_leaf(sli_piece *p, const sli_level *g, const sli_tree *t, sl_int node,
                           const sl_int *label, const sl_int *vertices, sl_int count) {
    sl_int k;
    p->n = 0;
    for (k = 0; k < count; k++) {
        sli_piece_add(p, vertices[k], 0);
    }
    sli_piece_edges(p, g, t, node, label);
    p->total[0] = t->weight[node];
    p->total[1] = 0;
}

/* Share of a part that its band may have before another layer is added, on the finest level. In a volume two or three
 * layers are most of a small part, and a cut anywhere in it would not balance. */
#define SLI_BAND_SHARE 0.3

/* The vertices at the border of a node, and up to so many layers on either side of them. */
static void sli_piece_band(sli_piece *p, const sli_level *g, const sli_tree *t, sl_int node,
                           const sl_int *label, const sli_borders *l, int layers) {
    const sl_int most = (sl_int)(SLI_BAND_SHARE * (double)t->weight[node]);
    sl_int entry, head = 0;
    sl_off e;
    int layer;
    p->n = 0;
    for (entry = l->head[node]; entry != -1; entry = l->next[entry]) {
        const sl_int v = l->vertex[entry];
        const int side = label[v] > node;
        int crosses = 0;
        if (p->place[v] != -1 || label[v] == node || !sli_tree_is_below(t, node, label[v])) {
            continue;
        }
        for (e = g->begin[v]; e < g->begin[v + 1] && !crosses; e++) {
            const sl_int other = label[g->to[e]];
            crosses = other != node && sli_tree_is_below(t, node, other) && (other > node) != side;
        }
        if (crosses) {
            sli_piece_add(p, v, 0);
        }
    }
    for (layer = 1; layer <= layers && (layer == 1 || p->n < most); layer++) {
        const sl_int end = p->n;
        for (; head < end; head++) {
            for (e = g->begin[p->vertex[head]]; e < g->begin[p->vertex[head] + 1]; e++) {
                const sl_int u = g->to[e];
                if (p->place[u] == -1 && sli_tree_is_below(t, node, label[u])) {
                    sli_piece_add(p, u, layer);
                }
            }
        }
    }
    sli_piece_edges(p, g, t, node, label);
    p->total[0] = t->weight[t->left[node]];
    p->total[1] = t->weight[t->right[node]];
}

/* Moves a vertex from one leaf to another below node, or (to == node) into the separator. */
static void sli_relabel_vertex(sl_int v, sl_int to, sl_int node, const sli_level *g, sli_tree *t,
                               sl_int *label, sli_borders *l) {
    const sl_int from = label[v], weight = sli_level_weight(g, v);
    sl_int up, last = to;
    sl_off e;
    for (up = from; up != node; up = t->parent[up]) {
        t->weight[up] -= weight;
    }
    for (up = to; up != node; up = t->parent[up]) {
        t->weight[up] += weight;
    }
    label[v] = to;
    if (to == node) {
        return;
    }
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int other = label[g->to[e]];
        if (other != to && other != last && other != node && (other > node) == (to > node) &&
            sli_tree_is_below(t, node, other)) {
            const sl_int border = sli_tree_meet(t, to, other);
            sli_borders_add(l, border, v);
            sli_borders_add(l, border, g->to[e]);
        }
    }
}

/* The leaf on v's new side that has most edges to it, or -1. */
static sl_int sli_piece_leaf_near(const sli_level *g, const sli_tree *t, sl_int node, sl_int v,
                                  int side, const sl_int *label) {
    sl_int best = -1, most = 0;
    sl_off e;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int other = label[g->to[e]];
        if (other != node && sli_tree_is_below(t, node, other) && (other > node) == side &&
            sli_level_edge(g, e) > most) {
            most = sli_level_edge(g, e);
            best = other;
        }
    }
    return best;
}

/* Writes the sides of a band into the labels. A vertex that has no neighbour on its new side stays
 * where it was: it borders on nothing but the separator. */
static void sli_piece_apply(sli_piece *p, const sli_level *g, sli_tree *t, sl_int node,
                            sl_int *label, sli_borders *l) {
    sl_int *moved = p->scratch, count = 0, k, left;
    for (k = 0; k < p->n; k++) {
        if (p->side[k] == 2) {
            sli_relabel_vertex(p->vertex[k], node, node, g, t, label, l);
        } else if (p->side[k] != p->home[k]) {
            moved[count++] = k;
        }
    }
    do { /* in layers from the border, so that a round or two are enough */
        left = 0;
        for (k = 0; k < count; k++) {
            const sl_int m = moved[k], v = p->vertex[m];
            const sl_int leaf = sli_piece_leaf_near(g, t, node, v, p->side[m], label);
            if (leaf != -1) {
                sli_relabel_vertex(v, leaf, node, g, t, label, l);
            } else {
                moved[left++] = m;
            }
        }
        if (left == count) {
            break;
        }
        count = left;
    } while (count > 0);
}

#endif
