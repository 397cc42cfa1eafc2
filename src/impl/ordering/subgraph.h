/* subgraph.h: a leaf, or a band along the border of a node, as a graph in its own numbering */
#ifndef SLI_ORDERING_SUBGRAPH_H
#define SLI_ORDERING_SUBGRAPH_H

#include "labels.h"

/* Workers take subgraphs below nodes of which none is above another one. So while one worker reads
 * the labels around its subgraph, another may write them, but all of them are below other nodes,
 * before and after.
 *
 * A subgraph of a level: the vertices of a leaf, or a few layers on each side of the border between
 * the two sides of a node. `external` is the weight of the edges to the rest of a side, whose
 * vertices do not move: it holds a vertex at its home side. */
typedef struct sli_subgraph {
    sl_int n;
    sl_int *vertex; /* n: number in the level */
    sl_off *begin;  /* n + 1 */
    sl_int *to, *edge;
    sl_int *weight;
    sl_int *external;             /* n: weight of the edges that leave the band */
    unsigned char *side;          /* n: 0 left, 1 right, 2 separator */
    unsigned char *home;          /* n: side at the start, that of the external edges */
    unsigned char *layer;         /* n: distance to the border */
    int64_t total[2];             /* weight of each side, vertices outside the subgraph included */
    sl_int *local;                /* by vertex of the level: its number here, or -1 */
    unsigned char *locked, *best; /* n: scratch of bisection and separation */
    sl_int *scratch;              /* 8 n */
} sli_subgraph;

static void sli_subgraph_layout(sli_subgraph *sub, sli_block *b, sl_int n, sl_off edges) {
    sub->vertex = SLI_TAKE(b, sl_int, (size_t)n + 1);
    sub->begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
    sub->to = SLI_TAKE(b, sl_int, (size_t)edges + 4); /* of sli_subgraph_append */
    sub->edge = SLI_TAKE(b, sl_int, edges);
    sub->weight = SLI_TAKE(b, sl_int, n);
    sub->external = SLI_TAKE(b, sl_int, n);
    sub->side = SLI_TAKE(b, unsigned char, (size_t)n + 1);
    sub->home = SLI_TAKE(b, unsigned char, n);
    sub->layer = SLI_TAKE(b, unsigned char, n);
    sub->local = SLI_TAKE(b, sl_int, n);
    sub->locked = SLI_TAKE(b, unsigned char, n);
    sub->best = SLI_TAKE(b, unsigned char, n);
    sub->scratch = SLI_TAKE(b, sl_int, 8 * (uint64_t)n);
}

/* Adds vertex v of the level. */
SLI_INLINE void sli_subgraph_add(sli_subgraph *sub, sl_int v, int layer, int side) {
    sub->local[v] = sub->n;
    sub->layer[sub->n] = (unsigned char)layer;
    sub->side[sub->n] = sub->home[sub->n] = (unsigned char)side;
    sub->vertex[sub->n++] = v;
}

/* Removes all vertices, in time proportional to their number. */
static void sli_subgraph_clear(sli_subgraph *sub) {
    sl_int k;
    for (k = 0; k < sub->n; k++) {
        sub->local[sub->vertex[k]] = -1;
    }
    sub->n = 0;
}

/* Builds the edges between the vertices that were added, all of them below node. */
static void sli_subgraph_edges(sli_subgraph *sub, const sli_labelling *in, sl_int node) {
    const sli_level *g = in->g;
    const sl_int low = in->tree->low[node], high = in->tree->high[node];
    const sl_int *label = in->label;
    sl_int k;
    sl_off e, count = 0;
    for (k = 0; k < sub->n; k++) {
        const sl_int v = sub->vertex[k];
        sl_int external = 0;
        sub->begin[k] = count;
        sub->weight[k] = sli_level_weight(g, v);
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e], own = sli_shared_read(label + u), there = sub->local[u];
            const sl_int edge = sli_level_edge(g, v, e);
            const int leaves = (there == -1) & (own >= low) & (own <= high);
            sub->to[count] = there;
            sub->edge[count] = edge;
            count += there != -1;
            external += leaves ? edge : 0;
        }
        sub->external[k] = external;
    }
    sub->begin[sub->n] = count;
}

/* Makes the subgraph of a leaf's vertices. */
static void sli_subgraph_leaf(sli_subgraph *sub, const sli_labelling *in, sl_int node,
                              const sl_int *vertices, sl_int count) {
    sl_int k;
    sub->n = 0;
    for (k = 0; k < count; k++) {
        sli_subgraph_add(sub, vertices[k], 0, 0);
    }
    sli_subgraph_edges(sub, in, node);
    sub->total[0] = in->tree->weight[node];
    sub->total[1] = 0;
}

/* A band gets no further layer once it has this percentage of the finest vertices below its node.
 * In a volume, two or three layers contain most of a small subgraph, and a cut anywhere in them
 * would be unbalanced. */
#define SLI_BAND_SHARE 30

/* Starts the band of a node, which has no vertices of its own yet, with those at its border. */
static void sli_subgraph_border(sli_subgraph *sub, const sli_labelling *in, sl_int node,
                                const sli_borders *l) {
    const sli_level *g = in->g;
    const sli_label_tree *t = in->tree;
    const sl_int *label = in->label;
    sl_int entry;
    sl_off e;
    sub->n = 0;
    for (entry = l->head[node]; entry != -1; entry = sli_border_at(l->pool, entry)->next) {
        const sl_int v = sli_border_at(l->pool, entry)->vertex, own = sli_shared_read(label + v);
        const int side = own > node;
        int crosses = 0;
        if (sub->local[v] != -1 || !sli_label_tree_is_below(t, node, own)) {
            continue;
        }
        for (e = g->begin[v]; e < g->begin[v + 1] && !crosses; e++) {
            const sl_int other = sli_shared_read(label + g->to[e]);
            crosses = sli_label_tree_is_below(t, node, other) && (other > node) != side;
        }
        if (crosses) {
            sli_subgraph_add(sub, v, 0, side);
        }
    }
    sub->total[0] = t->weight[t->left[node]];
    sub->total[1] = t->weight[t->right[node]];
}

/* A band gets another layer unless it has this many vertices. The first one is added regardless. */
SLI_INLINE sl_int sli_band_most(const sli_label_tree *t, sl_int node) {
    return (sl_int)((int64_t)t->weight[node] * SLI_BAND_SHARE / 100);
}

/* Makes the band of a node: the vertices at its border, and up to `layers` layers on each side of
 * them. */
static void sli_subgraph_band(sli_subgraph *sub, const sli_labelling *in, sl_int node,
                              const sli_borders *l, int layers) {
    const sli_level *g = in->g;
    const sl_int most = sli_band_most(in->tree, node);
    sl_int head = 0;
    sl_off e;
    int layer;
    sli_subgraph_border(sub, in, node, l);
    for (layer = 1; layer <= layers && (layer == 1 || sub->n < most); layer++) {
        const sl_int end = sub->n;
        for (; head < end; head++) {
            for (e = g->begin[sub->vertex[head]]; e < g->begin[sub->vertex[head] + 1]; e++) {
                const sl_int u = g->to[e];
                if (sub->local[u] == -1) {
                    const sl_int own = sli_shared_read(in->label + u);
                    if (sli_label_tree_is_below(in->tree, node, own)) {
                        sli_subgraph_add(sub, u, layer, own > node);
                    }
                }
            }
        }
    }
}

/* Appends `count` neighbors, four at a time, which is nearly always one step. Up to four more are
 * written behind them. */
SLI_INLINE sl_off sli_subgraph_append(sl_int *to, sl_off at, const sl_int *from, sl_int count) {
    sl_int k = 0;
    do {
        memcpy(to + at + k, from + k, 4 * sizeof(sl_int));
        k += 4;
    } while (k < count);
    return at + count;
}

/* found := numbers in the band of the neighbors of vertex v of the level, -1 for those that are not
 * in it. If the band grows, it gets those that are below node. Otherwise, returns whether there are
 * any.
 *
 * What is written here and in sli_subgraph_arcs counts only if it is wanted: branches would be
 * mispredicted half of the time. */
SLI_ALWAYS_INLINE int sli_subgraph_neighbors(sli_subgraph *sub, const sli_labelling *in,
                                             sl_int node, sl_int v, int grows, sl_int *found) {
    const sl_int *label = in->label, *to = in->g->to, low = in->tree->low[node];
    const uint32_t below = (uint32_t)(in->tree->high[node] - low);
    const sl_off end = in->g->begin[v + 1];
    sl_int *local = sub->local, *vertex = sub->vertex, n = sub->n;
    unsigned char *side = sub->side;
    int leaves = 0;
    sl_off e;
    for (e = in->g->begin[v]; e < end; e++) {
        const sl_int u = to[e], own = sli_shared_read(label + u), there = local[u];
        const int is_new = ((uint32_t)(own - low) <= below) & (there == -1);
        if (grows) { /* branches untested: a constant */
            vertex[n] = u;
            side[n] = own > node;
            *found = local[u] = is_new ? n : there; /* branches untested: the same */
            n += is_new;
        } else {
            *found = there;
            leaves |= is_new;
        }
        found++;
    }
    sub->n = n;
    return leaves;
}

/* Builds the edges of vertex k of a band for a search from the left to the right, without weights:
 * those towards the right come first, those towards the left last. found: its `degree` neighbors,
 * and room for three times as many and four. Those below `first` are in a layer nearer to the
 * border, those from `last` on in one farther from it; with first = 0, at the border, those on the
 * other side are nearer. */
SLI_ALWAYS_INLINE void sli_subgraph_arcs(sli_subgraph *sub, sl_int k, sl_int first, sl_int last,
                                         sl_int *found, sl_int degree) {
    const int own = sub->side[k];
    sl_int *to = sub->to + sub->begin[k];
    sl_int *nearer = found + degree, *farther = nearer + degree, *beside = farther + degree;
    sl_int e, n_nearer = 0, n_farther = 0, n_beside = 0;
    sl_off count;
    for (e = 0; e < degree; e++) {
        const sl_int there = found[e];
        const int is_here = (uint32_t)there < (uint32_t)last;
        const int is_nearer =
            first == 0 /* branches untested: a constant */
                ? is_here &
                      (sub->side[is_here ? there : 0] != own) /* branches untested: the same */
                : (uint32_t)there < (uint32_t)first;          /* branches untested: the same */
        nearer[n_nearer] = farther[n_farther] = beside[n_beside] = there;
        n_nearer += is_nearer;
        n_farther += there >= last;
        n_beside += is_here & !is_nearer;
    }
    count =
        sli_subgraph_append(to, 0, own == 0 ? nearer : farther, own == 0 ? n_nearer : n_farther);
    count = sli_subgraph_append(to, count, beside, n_beside);
    count = sli_subgraph_append(to, count, own == 0 ? farther : nearer,
                                own == 0 ? n_farther : n_nearer);
    sub->begin[k + 1] = sub->begin[k] + count;
}

/* Makes the band of a node as sli_subgraph_band does, and its edges for a search. `external` is
 * whether an edge leaves the band. */
static void sli_subgraph_corridor(sli_subgraph *sub, const sli_labelling *in, sl_int node,
                                  const sli_borders *l, int layers) {
    const sl_int most = sli_band_most(in->tree, node);
    const sl_off *begin = in->g->begin;
    sl_int k = 0, first, last = 0, *found = sub->scratch;
    int layer = 0, grows = 1;
    sli_subgraph_border(sub, in, node, l);
    sub->begin[0] = 0;
    for (; grows; layer++) {
        first = last;
        last = sub->n;
        grows = layer < layers && (layer == 0 || last < most);
        for (k = first; k < last; k++) {
            const sl_int v = sub->vertex[k], degree = (sl_int)(begin[v + 1] - begin[v]);
            sub->external[k] = grows ? sli_subgraph_neighbors(sub, in, node, v, 1, found)
                                     : sli_subgraph_neighbors(sub, in, node, v, 0, found);
            if (first == 0) {
                sli_subgraph_arcs(sub, k, 0, last, found, degree);
            } else {
                sli_subgraph_arcs(sub, k, first, last, found, degree);
            }
            sub->weight[k] = sli_level_weight(in->g, v);
        }
        memset(sub->layer + first, layer, (size_t)last - (size_t)first);
    }
    memcpy(sub->home, sub->side, (size_t)sub->n);
}

/* Moves a vertex to another leaf below node, or into the separator if to == node. */
static void sli_relabel_vertex(const sli_labelling *in, sl_int v, sl_int to, sl_int node,
                               sli_borders *l) {
    const sli_level *g = in->g;
    const sli_label_tree *t = in->tree;
    sl_int *label = in->label;
    const sl_int from = sli_shared_read(label + v), weight = sli_level_weight(g, v);
    sl_int up;
    sl_off e;
    for (up = from; up != node; up = t->parent[up]) {
        t->weight[up] -= weight;
    }
    for (up = to; up != node; up = t->parent[up]) {
        t->weight[up] += weight;
    }
    sli_shared_write(label + v, to);
    if (to == node) {
        return;
    }
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int other = sli_shared_read(label + g->to[e]);
        if (other != to && other != node && (other > node) == (to > node) &&
            sli_label_tree_is_below(t, node, other)) {
            const sl_int border = sli_label_tree_lca(t, to, other);
            sli_borders_add(l, border, v);
            sli_borders_add(l, border, g->to[e]);
        }
    }
}

/* The leaf on v's new side with the heaviest edges to v, or -1. */
static sl_int sli_subgraph_adjacent_leaf(const sli_labelling *in, sl_int node, sl_int v, int side) {
    const sli_level *g = in->g;
    const sli_label_tree *t = in->tree;
    const sl_int *label = in->label;
    sl_int best = -1, most = 0;
    sl_off e;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int other = sli_shared_read(label + g->to[e]);
        if (other != node && sli_label_tree_is_below(t, node, other) && (other > node) == side &&
            sli_level_edge(g, v, e) > most) {
            most = sli_level_edge(g, v, e);
            best = other;
        }
    }
    return best;
}

/* Writes the sides of a band to the labels. A vertex without a neighbor on its new side keeps its
 * leaf: all its neighbors are in the separator. */
static void sli_subgraph_apply(sli_subgraph *sub, const sli_labelling *in, sl_int node,
                               sli_borders *l) {
    sl_int *moved = sub->scratch, count = 0, k, left;
    for (k = 0; k < sub->n; k++) {
        if (sub->side[k] == 2) {
            sli_relabel_vertex(in, sub->vertex[k], node, node, l);
        } else if (sub->side[k] != sub->home[k]) {
            moved[count++] = k;
        }
    }
    do { /* moves spread in layers from the border, so that one or two rounds are enough */
        left = 0;
        for (k = 0; k < count; k++) {
            const sl_int m = moved[k], v = sub->vertex[m];
            const sl_int leaf = sli_subgraph_adjacent_leaf(in, node, v, sub->side[m]);
            if (leaf != -1) {
                sli_relabel_vertex(in, v, leaf, node, l);
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
