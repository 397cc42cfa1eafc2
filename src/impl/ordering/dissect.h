/* dissect.h: multilevel nested dissection of a connected graph */
#ifndef SLI_ORDERING_DISSECT_H
#define SLI_ORDERING_DISSECT_H

#include "dissection.h"
#include "separator.h"

/* Leaves of at most this many vertices are not dissected: minimum degree is about as good there as
 * a further separator. */
#define SLI_DISSECT_LEAF 160
/* A leaf is bisected on the coarsest level on which it has more vertices than BISECT_MIN. Leaves
 * are bisected only on levels of at most n / SHRINK vertices, in volumes on the first coarser one,
 * too: separators have a larger share of the vertices there, and clusters make them rougher. */
#define SLI_DISSECT_BISECT_MIN 30
#define SLI_DISSECT_BISECT_MIN_VOLUME 200
#define SLI_DISSECT_SHRINK 10
#define SLI_DISSECT_SHRINK_VOLUME 2
/* The first coarser level of a graph has up to 6 neighbors for each vertex on surfaces, 7.4 to 9 in
 * wide graphs of them, 7.7 to 9.7 in 7-point volumes and thick plates, whose finest level has up to
 * 6, and 12 to 17 in volumes of tetrahedra or 27 points. */
#define SLI_SEVEN_POINT_DEGREE 6
#define SLI_VOLUME_DEGREE 10
/* Tries of graph growing: TRIES_FIRST while the tree has fewer than FIRST nodes, because the first
 * separators decide most, then TRIES. */
#define SLI_DISSECT_FIRST 64
#define SLI_DISSECT_TRIES_FIRST 8
#define SLI_DISSECT_TRIES 2
/* In systems of fewer rows than this, unless the graph is wide, all bisections have TRIES: ordering
 * is most of what these systems cost up to hundreds of local solves. It takes 15 to 30 % less time
 * for paths that are 1 % longer in the mean of 76 meshes and grids, 7 % at most. */
#define SLI_DISSECT_SMALL 10000
/* Layers on each side of a border whose vertices may change sides: LAYERS on coarse levels, one for
 * the final separators, and more from BAND_FROM finest vertices on. */
#define SLI_DISSECT_LAYERS 3
#define SLI_DISSECT_BAND_FROM 700
/* Largest percentage of the weight that one side of a separator may have. It exceeds
 * SLI_BISECT_BALANCE because the last step may lose some balance for a smaller separator. */
#define SLI_SEPARATOR_BALANCE 70

/* Bisects a subgraph. is_first: when the tree has few nodes. */
static void sli_dissect_bisect(sli_subgraph *sub, int is_first) {
    const int few = is_first && sub->n <= 2 * SLI_DISSECT_BISECT_MIN_VOLUME;
    sli_subgraph_bisect(sub, few ? SLI_DISSECT_TRIES_FIRST : sub->n > 50 ? SLI_DISSECT_TRIES : 1);
}

/* Refines the border of a node on this level. */
static void sli_dissect_refine(sli_dissection *d, sli_dissect_worker *w, sl_int node) {
    const sli_labelling in = sli_dissect_labelling(d);
    sli_fm m;
    sli_subgraph_band(&w->subgraph, &in, node, &w->borders, SLI_DISSECT_LAYERS);
    sli_subgraph_edges(&w->subgraph, &in, node);
    m = sli_fm_of(&w->subgraph);
    sli_fm_refine(&m, 2);
    sli_subgraph_apply(&w->subgraph, &in, node, &w->borders);
    sli_subgraph_clear(&w->subgraph);
}

/* Returns whether the sides are balanced now that the subgraph has a separator, or at least no less
 * balanced than before. */
static int sli_dissect_is_balanced(const sli_subgraph *sub) {
    int64_t total[2], sum, before = sub->total[0] > sub->total[1] ? sub->total[0] : sub->total[1];
    sl_int v;
    total[0] = sub->total[0];
    total[1] = sub->total[1];
    for (v = 0; v < sub->n; v++) {
        total[sub->home[v]] -= sub->weight[v];
        if (sub->side[v] != 2) {
            total[sub->side[v]] += sub->weight[v];
        }
    }
    sum = total[0] + total[1];
    total[0] = total[0] > total[1] ? total[0] : total[1];
    return 100 * total[0] <= SLI_SEPARATOR_BALANCE * sum || total[0] <= before;
}

/* The number of layers of the band of a subgraph of this weight. In a wide graph, a layer is two or
 * three layers of a mesh, and so is each side of the border: one layer more contains much of a
 * small subgraph, and several move the separators of large ones away from the middle. So they do in
 * volumes. */
static int sli_dissect_layers(const sli_dissection *d, sl_int weight) {
    int layers = 1;
    if (d->is_volume || d->is_levelset) {
        return 1;
    }
    if (sli_level_is_wide(&d->levels[0])) {
        return weight > SLI_DISSECT_BAND_FROM;
    }
    for (; weight > SLI_DISSECT_BAND_FROM; weight /= 4) {
        layers++;
    }
    return layers;
}

/* Finds a minimum vertex separator in the band of a node. The larger a subgraph, the wider its
 * band: the first separators decide most of the fill, and there are few of them. If a separator is
 * unbalanced, narrower bands are tried, finally only the border. */
static void sli_dissect_separate(sli_dissection *d, sli_dissect_worker *w, sl_int node) {
    const sli_labelling in = sli_dissect_labelling(d); /* of the finest level */
    sli_subgraph *sub = &w->subgraph;
    int layers = sli_dissect_layers(d, d->tree.weight[node]);
    for (;; layers /= 2) {
        sli_subgraph_corridor(sub, &in, node, &w->borders, layers);
        sli_subgraph_separate(sub, sub->locked, sub->scratch, w->next);
        if (layers == 0 || sli_dissect_is_balanced(sub)) {
            break;
        }
        sli_subgraph_clear(sub);
    }
    sli_subgraph_apply(sub, &in, node, &w->borders);
    sli_subgraph_clear(sub);
}

/* Projects the labels to the next finer level. */
static void sli_dissect_project(sli_dissection *d) {
    const sli_level *g = &d->levels[--d->level];
    sl_int v, *coarser = d->label;
    for (v = 0; v < g->n; v++) {
        d->other[v] = coarser[g->coarse[v]];
    }
    d->label = d->other;
    d->other = coarser;
}

/* Makes the weight of each edge of the last level the number of finest vertices on both sides of
 * the border that it represents: what a vertex separator there costs. The number of finest edges
 * would charge a diagonal border in a square grid twice as much as a straight one. */
static void sli_weigh_edges(sli_dissection *d) {
    const sli_level *g = &d->levels[d->n_levels - 1];
    sl_int *to = d->workers->subgraph.to, *count = d->workers->subgraph.edge, k;
    sl_off e, *at = d->ranges.scratch;
    /* The weights so far count the vertices of one side; add those of the other side from the
     * transposed lists. */
    SLI_COPY(at, g->begin, g->n);
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

static int sli_level_exceeds(const sli_level *g, sl_off degree) {
    return g->begin[g->n] > degree * g->n;
}

static sl_int sli_dissect_bisect_min(const sli_dissection *d) {
    return d->is_volume ? SLI_DISSECT_BISECT_MIN_VOLUME : SLI_DISSECT_BISECT_MIN;
}

static int sli_level_has_edge(const sli_level *g, sl_int v, sl_int u) {
    sl_off e = g->begin[v];
    while (e < g->begin[v + 1] && g->to[e] != u) {
        e++;
    }
    return e < g->begin[v + 1];
}

/* Is v in a triangle? Hubs are. */
static int sli_level_has_triangle(const sli_level *g, sl_int v) {
    int found = g->begin[v + 1] - g->begin[v] >= SLI_HUB_LEAST;
    sl_off e, k;
    for (e = g->begin[v]; e < g->begin[v + 1] && !found; e++) {
        for (k = g->begin[g->to[e]]; k < g->begin[g->to[e] + 1] && !found; k++) {
            found = sli_level_has_edge(g, v, g->to[k]);
        }
    }
    return found;
}

/* Has a graph more edges than a planar one without triangles, 2 n, and nearly no triangles? So it
 * is in 7-point plates of two layers, too, whose first coarser level is as that of a surface. */
static int sli_level_is_crossed(const sli_level *g) {
    const sl_int step = g->n / 64 + 1;
    sl_int v, tried = 0, triangles = 0;
    if (2 * g->begin[g->n] <= 9 * (sl_off)g->n) {
        return 0;
    }
    for (v = 0; v < g->n; v += step) {
        tried++;
        triangles += sli_level_has_triangle(g, v);
    }
    return triangles <= tried / 8;
}

/* Reads from the first coarser level whether the graph is a volume. */
static void sli_dissect_recognize(sli_dissection *d) {
    d->is_volume = sli_level_exceeds(&d->levels[1], SLI_VOLUME_DEGREE);
    d->may_be_seven_point = !sli_level_exceeds(&d->levels[0], SLI_SEVEN_POINT_DEGREE) &&
                            (sli_level_exceeds(&d->levels[1], SLI_SEVEN_POINT_DEGREE + 1) ||
                             sli_level_is_crossed(&d->levels[0]));
}

/* Makes the coarser levels, in addition to those that there are. *working := the finest level on
 * which leaves are bisected: its edges become what a separator costs. The first level is made of
 * balls; a level that shows a volume is made again of smaller clusters. */
static sl_status sli_dissect_coarsen(sli_dissection *d, int *working) {
    const sl_int n = d->levels[0].n;
    int shrunk = 1;
    sl_status status = SL_OK;
    sli_coarsening t;
    t.has_balls = d->n_levels == 1 && !sli_level_is_wide(&d->levels[0]);
    t.mate = d->order;
    t.clusters.member = d->other;
    t.clusters.start = d->begin;
    t.ranges = &d->ranges;
    t.a = d->a;
    *working = -1;
    for (;;) {
        const int last = d->n_levels - 1;
        const sli_level *g = &d->levels[last];
        sl_int most;
        if (last == 1 && t.has_balls && sli_level_exceeds(g, SLI_VOLUME_DEGREE)) {
            t.has_balls = 0;
            sli_free(d->a, g->block);
            d->n_levels = 1;
            continue;
        }
        if (last == 1) {
            sli_dissect_recognize(d);
            sli_weigh_edges(d);
        }
        most = n / (d->is_volume ? SLI_DISSECT_SHRINK_VOLUME : SLI_DISSECT_SHRINK);
        if (*working == -1 && last > 0 && g->n <= most) {
            *working = last;
        }
        if (g->n <= sli_min(sli_dissect_bisect_min(d), most) || d->n_levels == SLI_LEVELS_MAX) {
            break;
        }
        /* Three times the mean weight keeps the weights of a level even enough for balanced
         * bisection. */
        t.heaviest = (sl_int)(3 * (int64_t)d->total / g->n) + 1;
        status = sli_coarsen(&t, g, &d->levels[d->n_levels], &shrunk);
        if (status != SL_OK || !shrunk) {
            break;
        }
        d->n_levels++;
    }
    *working = *working == -1 ? d->n_levels - 1 : *working;
    return status;
}

/* Builds the separator tree on the finest level that has few enough vertices, in addition to the
 * levels that there are: each leaf is bisected on the coarsest level on which it is large enough,
 * and its border is then refined from level to level. */
static sl_status sli_dissect_levels(sli_dissection *d) {
    int working;
    const sl_status status = sli_dissect_coarsen(d, &working);
    if (status != SL_OK) {
        return status;
    }
    d->level = d->n_levels - 1;
    sli_dissect_start(d);
    for (;;) {
        while (sli_dissect_split(d, d->level == working ? 1 : sli_dissect_bisect_min(d),
                                 sli_dissect_bisect) > 0) {
        }
        if (d->level == working) {
            break;
        }
        sli_dissect_project(d);
        sli_dissect_visit(d, sli_dissect_refine);
    }
    return d->pool.failed ? sli_no_memory() : SL_OK;
}

/* Exchanges the dissection with the other one of the finest level. */
static void sli_dissect_swap(sli_dissection *d) {
    const sli_label_tree tree = d->tree;
    sl_int *label = d->label;
    d->tree = d->other_tree;
    d->other_tree = tree;
    d->label = d->other;
    d->other = label;
}

/* Finds labels of the finest level by levels of matched vertices. */
static sl_status sli_dissect_multilevel(sli_dissection *d) {
    sl_status status;
    d->n_levels = 1;
    status = sli_dissect_levels(d);
    while (status == SL_OK && d->level > 0) {
        sli_dissect_project(d);
    }
    for (; d->n_levels > 1; d->n_levels--) {
        sli_free(d->a, d->levels[d->n_levels - 1].block);
    }
    return status;
}

#endif
