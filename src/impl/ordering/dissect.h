/* order_dissect.h: nested dissection of a connected graph: where to cut, found on a coarse level, refined on the finest */
#ifndef SLI_ORDER_DISSECT_H
#define SLI_ORDER_DISSECT_H

#include "order_cut.h"
#include "order_leaves.h"

/* Below this many vertices minimum degree is about as good as a further cut; on METIS's separators
 * smaller leaves save another half percent of fill. */
#define SLI_DISSECT_LEAF 200
#define SLI_DISSECT_LEAF_QUALITY 140
/* A part is cut on the coarsest level on which it has more vertices than this. */
#define SLI_DISSECT_PART 100
/* The finest level on which parts are cut has a vertex for at least so many of the graph. */
#define SLI_DISSECT_SHRINK 7
/* Growing tries for the first cuts, which decide most, and for all others. */
#define SLI_DISSECT_FIRST 64
#define SLI_DISSECT_TRIES_FIRST 8
#define SLI_DISSECT_TRIES 2
/* Layers on either side of a border that may change sides, on coarse levels and at last. */
#define SLI_DISSECT_LAYERS 3
#define SLI_DISSECT_BAND 2
#define SLI_DISSECT_BAND_FROM 1000
/* Most of the weight that one side of a separator may get: the last step may lose some balance. */
#define SLI_CUT_BALANCE 0.7

/* Everything that is needed while one graph after the other is dissected; all have room for the
 * largest. */
typedef struct sli_dissection {
    const sl_allocator *a;
    sli_level levels[SLI_LEVELS_MAX]; /* the finest first; it is not owned */
    int n_levels, l;                  /* l: the level that labels are of */
    sl_int total;                     /* weight of the finest level */
    sl_int most;                      /* vertices of a leaf, where it can be cut */
    int widening; /* layers more of a band for each four times of a part's size */
    sli_tree tree;
    sli_borders borders;
    sli_piece part;
    sli_leaf leaf;
    sl_int *label, *other; /* n: the node of each vertex; the other one is scratch */
    sl_int *begin;         /* room + 1: where the vertices of a node begin in order */
    sl_int *order;         /* n */
    sl_int *nodes;         /* room */
    sl_off *next;          /* n */
} sli_dissection;

static void sli_dissection_layout(sli_dissection *d, sli_block *b, sl_int n, sl_off edges) {
    const sl_int room = n + 1; /* more nodes than vertices are not made */
    d->levels[0].coarse = SLI_TAKE(b, sl_int, n);
    sli_tree_layout(&d->tree, b, room);
    d->borders.head = SLI_TAKE(b, sl_int, room);
    sli_piece_layout(&d->part, b, n, edges);
    d->label = SLI_TAKE(b, sl_int, n);
    d->other = SLI_TAKE(b, sl_int, n);
    d->begin = SLI_TAKE(b, sl_int, (size_t)room + 1);
    d->order = SLI_TAKE(b, sl_int, n);
    d->nodes = SLI_TAKE(b, sl_int, room);
    d->next = SLI_TAKE(b, sl_off, n);
    d->leaf.key = SLI_TAKE(b, uint32_t, SLI_LEAF_MAX);
    d->leaf.room = (size_t)SLI_LEAF_MAX * SLI_LEAF_MAX / 32;
    d->leaf.rows = SLI_TAKE(b, uint64_t, d->leaf.room);
}

/* The vertices of node t become order[begin[t]] .. order[begin[t + 1] - 1]. */
static void sli_dissect_sort(sli_dissection *d) {
    const sli_level *g = &d->levels[d->l];
    sl_int v, k, total = 0;
    memset(d->begin, 0, ((size_t)d->tree.count + 1) * sizeof(sl_int));
    for (v = 0; v < g->n; v++) {
        d->begin[d->label[v]]++;
    }
    for (k = 0; k <= d->tree.count; k++) {
        const sl_int here = d->begin[k];
        d->begin[k] = total;
        total += here;
    }
    for (v = 0; v < g->n; v++) {
        d->order[d->begin[d->label[v]]++] = v;
    }
    memmove(d->begin + 1, d->begin, (size_t)d->tree.count * sizeof(sl_int));
    d->begin[0] = 0;
}

/* One node, everything. */
static void sli_dissect_start(sli_dissection *d) {
    const sl_int n = d->levels[d->l].n;
    d->tree.count = 0;
    d->tree.root = sli_tree_add(&d->tree, -1);
    d->tree.weight[d->tree.root] = d->total;
    memset(d->label, 0, (size_t)n * sizeof(sl_int));
    sli_tree_number(&d->tree, n, d->label);
}

/* Hands the sides of the part to two new leaves below node. */
static void sli_dissect_divide(sli_dissection *d, sl_int node) {
    const sli_piece *p = &d->part;
    sl_int k, weight[2] = {0, 0};
    sli_tree_split(&d->tree, node);
    for (k = 0; k < p->n; k++) {
        const int side = p->side[k];
        d->label[p->vertex[k]] = side == 0 ? d->tree.left[node] : d->tree.right[node];
        weight[side] += p->weight[k];
    }
    d->tree.weight[d->tree.left[node]] = weight[0];
    d->tree.weight[d->tree.right[node]] = weight[1];
}

/* Cuts every leaf of more than so many vertices of this level, and of more than a leaf may have of
 * the finest. Returns how many there were. */
static sl_int sli_dissect_split(sli_dissection *d, sl_int most) {
    const sli_level *g = &d->levels[d->l];
    const sl_int nodes = d->tree.count;
    sl_int node, split = 0;
    sli_dissect_sort(d);
    for (node = 0; node < nodes; node++) {
        const sl_int count = d->begin[node + 1] - d->begin[node];
        if (sli_tree_is_leaf(&d->tree, node) && count > most && d->tree.weight[node] > d->most &&
            d->tree.count < d->tree.room - 1) {
            const int few = d->tree.count < SLI_DISSECT_FIRST && count <= 2 * SLI_DISSECT_PART;
            sli_piece_leaf(&d->part, g, &d->tree, node, d->label, d->order + d->begin[node], count);
            sli_piece_bisect(&d->part,
                             few          ? SLI_DISSECT_TRIES_FIRST
                             : count > 50 ? SLI_DISSECT_TRIES
                                          : 1,
                             2);
            sli_dissect_divide(d, node);
            sli_piece_clear(&d->part);
            split++;
        }
    }
    if (split > 0) {
        sli_tree_number(&d->tree, g->n, d->label);
    }
    return split;
}

/* Moves the borders of all nodes, the root's first, to where they cut less. */
static void sli_dissect_refine(sli_dissection *d) {
    const sli_level *g = &d->levels[d->l];
    sl_int k;
    sli_borders_fill(&d->borders, &d->tree, g, d->label);
    sli_tree_levels(&d->tree, d->nodes);
    for (k = 0; k < d->tree.count; k++) {
        const sl_int node = d->nodes[k];
        if (!sli_tree_is_leaf(&d->tree, node) && d->borders.head[node] != -1) {
            sli_piece_band(&d->part, g, &d->tree, node, d->label, &d->borders, SLI_DISSECT_LAYERS);
            sli_piece_improve(&d->part, 2);
            sli_piece_apply(&d->part, g, &d->tree, node, d->label, &d->borders);
            sli_piece_clear(&d->part);
        }
    }
}

/* Whether the sides of the piece, now with a separator, are balanced, or no less than before. */
static int sli_dissect_is_even(const sli_dissection *d) {
    const sli_piece *p = &d->part;
    int64_t total[2], sum, before = p->total[0] > p->total[1] ? p->total[0] : p->total[1];
    sl_int v;
    total[0] = p->total[0];
    total[1] = p->total[1];
    for (v = 0; v < p->n; v++) {
        total[p->home[v]] -= p->weight[v];
        if (p->side[v] != 2) {
            total[p->side[v]] += p->weight[v];
        }
    }
    sum = total[0] + total[1];
    total[0] = total[0] > total[1] ? total[0] : total[1];
    return (double)total[0] <= SLI_CUT_BALANCE * (double)sum || total[0] <= before;
}

/* Puts a smallest vertex cut of the band at each border into the separators, the root's first. The
 * larger a part, the wider its band: the first cuts decide most, and there are few of them. Where
 * the cut is out of balance a narrower band is taken, at last the border alone. */
static void sli_dissect_cut(sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    sl_int k;
    sli_borders_fill(&d->borders, &d->tree, g, d->label);
    sli_tree_levels(&d->tree, d->nodes);
    for (k = 0; k < d->tree.count; k++) {
        const sl_int node = d->nodes[k];
        sl_int weight = d->tree.weight[node];
        int layers = SLI_DISSECT_BAND;
        if (sli_tree_is_leaf(&d->tree, node) || d->borders.head[node] == -1) {
            continue;
        }
        for (; weight > SLI_DISSECT_BAND_FROM; weight /= 4) {
            layers += weight > 4 * SLI_DISSECT_BAND_FROM ? d->widening : sli_min(d->widening, 1);
        }
        for (;; layers /= 2) {
            sli_piece_band(&d->part, g, &d->tree, node, d->label, &d->borders, layers);
            sli_piece_cut_vertices(&d->part, d->part.locked, d->part.scratch, d->next);
            if (layers == 0 || sli_dissect_is_even(d)) {
                break;
            }
            sli_piece_clear(&d->part);
        }
        sli_piece_apply(&d->part, g, &d->tree, node, d->label, &d->borders);
        sli_piece_clear(&d->part);
    }
}

/* Labels of a level to the next finer one. */
static void sli_dissect_project(sli_dissection *d) {
    const sli_level *g = &d->levels[--d->l];
    sl_int v, *coarser = d->label;
    for (v = 0; v < g->n; v++) {
        d->other[v] = coarser[g->coarse[v]];
    }
    d->label = d->other;
    d->other = coarser;
}

static void sli_dissect_weigh(sli_dissection *d, int l) {
    sli_weighing w;
    w.cluster = d->label;
    w.member = d->order;
    w.start = d->nodes;
    w.seen = d->begin;
    w.to = d->part.to;
    w.count = d->part.edge;
    w.at = d->next;
    sli_weigh_level(d->levels, l, &w);
}

/* Coarsens; *working: the level on which parts are cut. */
static sl_status sli_dissect_coarsen(sli_dissection *d, int *working) {
    const sl_int n = d->levels[0].n, enough = sli_min(SLI_DISSECT_PART, n / SLI_DISSECT_SHRINK);
    int shrunk = 1;
    sl_status status = SL_OK;
    *working = -1;
    d->n_levels = 1;
    for (;;) {
        const int last = d->n_levels - 1;
        const sli_level *g = &d->levels[last];
        /* three times the mean weight keeps a level even, which a cut by halves needs */
        const sl_int heaviest = (sl_int)(3.0 * (double)d->total / (double)g->n) + 1;
        if (*working == -1 && last > 0 && g->n <= n / SLI_DISSECT_SHRINK) {
            *working = last;
            sli_dissect_weigh(d, last);
        }
        if (g->n <= enough || d->n_levels == SLI_LEVELS_MAX) {
            break;
        }
        status =
            sli_coarsen(g, heaviest, &d->levels[d->n_levels], d->order, d->next, &shrunk, d->a);
        if (status != SL_OK || !shrunk) {
            break;
        }
        d->n_levels++;
    }
    *working = *working == -1 ? d->n_levels - 1 : *working;
    return status;
}

static void sli_dissect_free_levels(sli_dissection *d) {
    int k;
    for (k = 1; k < d->n_levels; k++) {
        sli_free(d->a, d->levels[k].block);
    }
    d->n_levels = 1;
}

/* The tree of parts: each is cut as soon as it is large enough on a level; its border then follows
 * from level to level. */
static sl_status sli_dissect_multilevel(sli_dissection *d) {
    int working;
    sl_status status = sli_dissect_coarsen(d, &working);
    if (status == SL_OK) {
        d->l = d->n_levels - 1;
        sli_dissect_start(d);
        for (;;) {
            while (sli_dissect_split(d, d->l == working ? 1 : SLI_DISSECT_PART) > 0) {
            }
            if (d->l == working) {
                break;
            }
            sli_dissect_project(d);
            sli_dissect_refine(d);
        }
        while (d->l > 0) {
            sli_dissect_project(d);
        }
    }
    sli_dissect_free_levels(d);
    return status != SL_OK ? status : d->borders.failed ? SL_ERR_MEMORY : SL_OK;
}

/* What a tree of parts will cost in path weight, in a measure of its own: half of a part's vertices
 * pass its separator, whose columns are about as many as they are long, so each node counts its
 * weight times the square of its border. *flat: the same for a flat square of as many vertices. */
static double sli_dissect_cost(sli_dissection *d, double *flat) {
    const sli_level *g = &d->levels[0];
    sl_int *border = d->nodes, v, k;
    sl_off e;
    double cost = 0.0;
    memset(border, 0, (size_t)d->tree.count * sizeof(sl_int));
    for (v = 0; v < g->n; v++) {
        const sl_int own = d->label[v];
        sl_int last = -1;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int other = d->label[g->to[e]];
            if (own < other && other != last) {
                const sl_int node = sli_tree_meet(&d->tree, own, other);
                border[node] += last == -1 || node != sli_tree_meet(&d->tree, own, last);
                last = other;
            }
        }
    }
    *flat = 0.0;
    for (k = 0; k < d->tree.count; k++) {
        const double weight = d->tree.weight[k];
        if (!sli_tree_is_leaf(&d->tree, k)) {
            cost += weight * (double)border[k] * (double)border[k];
            *flat += weight * weight;
        }
    }
    return cost;
}

#endif
