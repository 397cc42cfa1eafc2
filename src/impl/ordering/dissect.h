/* dissect.h: multilevel nested dissection of a connected graph */
#ifndef SLI_ORDERING_DISSECT_H
#define SLI_ORDERING_DISSECT_H

#include "separator.h"
#include "weigh.h"

/* Leaves of at most this many vertices are not dissected: minimum degree is about as good there as
 * a further separator. */
#define SLI_DISSECT_LEAF 160
/* A leaf is bisected on the coarsest level on which it has more vertices than BISECT_MIN. Leaves
 * are bisected only on levels of at most n / SHRINK vertices, in volumes on the first coarser one,
 * too: separators have a larger share of the vertices there, and clusters make them rougher. */
#define SLI_DISSECT_BISECT_MIN 70
#define SLI_DISSECT_BISECT_MIN_VOLUME 200
#define SLI_DISSECT_SHRINK 10
#define SLI_DISSECT_SHRINK_VOLUME 2 /* at least, for sli_weigh_edges */
/* The first coarser level of a graph has up to 6 neighbors for each vertex on surfaces, 7.4 to 9 in
 * wide graphs of them, 7.1 to 9.3 in 7-point volumes and plates, whose finest level has up to 6,
 * and 12 to 17 in volumes of tetrahedra or 27 points. */
#define SLI_SEVEN_POINT_DEGREE 6
#define SLI_SEVEN_POINT_DEGREE_COARSE 7
#define SLI_VOLUME_DEGREE 10
/* Tries of graph growing: TRIES_FIRST while the tree has fewer than FIRST nodes, because the first
 * separators decide most, then TRIES. */
#define SLI_DISSECT_FIRST 64
#define SLI_DISSECT_TRIES_FIRST 8
#define SLI_DISSECT_TRIES 2
/* Layers on each side of a border whose vertices may change sides: LAYERS on coarse levels, BAND
 * for the final separators, and more than BAND from BAND_FROM finest vertices on. */
#define SLI_DISSECT_LAYERS 3
#define SLI_DISSECT_BAND 1
#define SLI_DISSECT_BAND_FROM 1000
/* Largest percentage of the weight that one side of a separator may have. It exceeds
 * SLI_BISECT_BALANCE because the last step may lose some balance for a smaller separator. */
#define SLI_SEPARATOR_BALANCE 70

/* Subtrees of at most this share of the weight, for each worker, are one task. */
#define SLI_DISSECT_TASKS 8

/* Bisects a subgraph when the tree has so many nodes. */
static void sli_dissect_bisect(sli_subgraph *sub, sl_int nodes) {
    const int few = nodes < SLI_DISSECT_FIRST && sub->n <= 2 * SLI_DISSECT_BISECT_MIN_VOLUME;
    sli_subgraph_bisect(sub, few ? SLI_DISSECT_TRIES_FIRST : sub->n > 50 ? SLI_DISSECT_TRIES : 1);
}

/* Gives the two sides of the subgraph of a former leaf to the new leaves below it. */
static void sli_dissect_split_item(void *data, sl_int node, sl_int worker) {
    sli_dissection *d = (sli_dissection *)data;
    sli_subgraph *sub = &d->workers[worker].subgraph;
    const sl_int leaf[2] = {d->tree.left[node], d->tree.right[node]};
    sl_int k, weight[2] = {0, 0};
    sli_subgraph_leaf(sub, &d->levels[d->level], &d->tree, node, d->label,
                      d->order + d->begin[node], d->begin[node + 1] - d->begin[node]);
    d->bisect(sub, leaf[0]);
    for (k = 0; k < sub->n; k++) {
        const int side = sub->side[k];
        sli_shared_write(d->label + sub->vertex[k], leaf[side]);
        weight[side] += sub->weight[k];
    }
    d->tree.weight[leaf[0]] = weight[0];
    d->tree.weight[leaf[1]] = weight[1];
    sli_subgraph_clear(sub);
}

/* Bisects each leaf that has more than `most` vertices on this level and more than leaf_size on the
 * finest. Returns the number of leaves bisected. */
static sl_int sli_dissect_split(sli_dissection *d, sl_int most,
                                void (*bisect)(sli_subgraph *sub, sl_int nodes)) {
    const sl_int nodes = d->tree.count;
    sl_int node, split = 0;
    sli_dissect_sort(d, d->tree.count);
    for (node = 0; node < nodes; node++) {
        if (sli_label_tree_is_leaf(&d->tree, node) && d->begin[node + 1] - d->begin[node] > most &&
            d->tree.weight[node] > d->leaf_size && d->tree.count < d->tree.room - 1) {
            sli_label_tree_split(&d->tree, node);
            d->nodes[split++] = node;
        }
    }
    if (split > 0) {
        d->bisect = bisect;
        sli_team_loop(d->team, split, d->nodes, sli_dissect_split_item, d);
        sli_label_tree_number(&d->tree, d->levels[d->level].n, d->label);
    }
    return split;
}

/* Visits the inner nodes of a subtree, or if it is large, the node, and adds what is below it. */
static void sli_dissect_visit_item(void *data, sl_int top, sl_int worker) {
    sli_dissection *d = (sli_dissection *)data;
    const sli_label_tree *t = &d->tree;
    const int is_large = t->weight[top] > d->total / SLI_DISSECT_TASKS / d->team->workers;
    sl_int node;
    for (node = top; node != -1; node = is_large ? -1 : sli_label_tree_below(t, top, node)) {
        if (!sli_label_tree_is_leaf(t, node) && d->workers->borders.head[node] != -1) {
            d->visit(d, &d->workers[worker], node);
        }
    }
    if (is_large && !sli_label_tree_is_leaf(t, top)) {
        sli_team_add(d->team, t->left[top]);
        sli_team_add(d->team, t->right[top]);
    }
}

/* Lists the border vertices of a range: of the only one, or into lists of its own. */
static void sli_dissect_borders(void *data, const sli_range *r) {
    sli_dissection *d = (sli_dissection *)data;
    sli_borders *l = &d->workers[r->worker].borders;
    sl_int *head = l->head;
    if (d->n_ranges > 1) {
        l->head = sli_dissect_by_label(d, r->item);
        l->tail = l->head + d->tree.count;
    }
    sli_borders_fill(l, &d->tree, &d->levels[d->level], d->label, r);
    l->head = head;
    l->tail = NULL;
}

/* Puts the lists of each range before those of the ranges before it. */
static void sli_dissect_join_borders(sli_dissection *d) {
    sl_int item, k, *head = d->workers->borders.head;
    for (item = 0; item < d->n_ranges; item++) {
        const sl_int *own = sli_dissect_by_label(d, item), *tail = own + d->tree.count;
        for (k = 0; k < d->tree.count; k++) {
            if (item == 0) {
                head[k] = own[k];
            } else if (own[k] != -1) {
                sli_border_at(&d->pool, tail[k])->next = head[k];
                head[k] = own[k];
            }
        }
    }
}

/* Visits all inner nodes that have a border, each after the nodes above it. */
static void sli_dissect_visit(sli_dissection *d,
                              void (*visit)(sli_dissection *d, sli_dissect_worker *w,
                                            sl_int node)) {
    sl_int k;
    d->pool.count = 0;
    for (k = 0; k < d->team->workers; k++) {
        d->workers[k].borders.at = d->workers[k].borders.end = 0;
    }
    sli_dissect_loop(d, d->tree.count, sli_dissect_borders);
    if (d->n_ranges > 1) {
        sli_dissect_join_borders(d);
    }
    d->visit = visit;
    d->nodes[0] = d->tree.root;
    sli_team_loop(d->team, 1, d->nodes, sli_dissect_visit_item, d);
}

/* Refines the border of a node on this level. */
static void sli_dissect_refine(sli_dissection *d, sli_dissect_worker *w, sl_int node) {
    const sli_level *g = &d->levels[d->level];
    sli_fm m;
    sli_subgraph_band(&w->subgraph, g, &d->tree, node, d->label, &w->borders, SLI_DISSECT_LAYERS);
    m = sli_fm_of(&w->subgraph);
    sli_fm_refine(&m, 2);
    sli_subgraph_apply(&w->subgraph, g, &d->tree, node, d->label, &w->borders);
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
    int layers = SLI_DISSECT_BAND;
    if (d->is_volume) {
        return 1;
    }
    if (sli_level_is_wide(&d->levels[0])) {
        return weight > SLI_DISSECT_BAND_FROM;
    }
    for (; weight > SLI_DISSECT_BAND_FROM; weight /= 4) {
        layers += weight > 4 * SLI_DISSECT_BAND_FROM ? d->band_growth : sli_min(d->band_growth, 1);
    }
    return layers;
}

/* Finds a minimum vertex separator in the band of a node. The larger a subgraph, the wider its
 * band: the first separators decide most of the fill, and there are few of them. If a separator is
 * unbalanced, narrower bands are tried, finally only the border. */
static void sli_dissect_separate(sli_dissection *d, sli_dissect_worker *w, sl_int node) {
    const sli_level *g = &d->levels[0];
    sli_subgraph *sub = &w->subgraph;
    int layers = sli_dissect_layers(d, d->tree.weight[node]);
    for (;; layers /= 2) {
        sli_subgraph_band(sub, g, &d->tree, node, d->label, &w->borders, layers);
        sli_subgraph_separate(sub, sub->locked, sub->scratch, w->next);
        if (layers == 0 || sli_dissect_is_balanced(sub)) {
            break;
        }
        sli_subgraph_clear(sub);
    }
    sli_subgraph_apply(sub, g, &d->tree, node, d->label, &w->borders);
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

static int sli_level_exceeds(const sli_level *g, sl_off degree) {
    return g->begin[g->n] > degree * g->n;
}

static sl_int sli_dissect_bisect_min(const sli_dissection *d) {
    return d->is_volume ? SLI_DISSECT_BISECT_MIN_VOLUME : SLI_DISSECT_BISECT_MIN;
}

/* Makes the coarser levels, in addition to those that there are. *working := the finest level on
 * which leaves are bisected: its edges become what a separator costs. The first level is made of
 * balls; a level that shows a volume is made again of smaller clusters. */
static sl_status sli_dissect_coarsen(sli_dissection *d, int *working) {
    const sl_int n = d->levels[0].n;
    int shrunk = 1, has_balls = d->n_levels == 1 && !sli_level_is_wide(&d->levels[0]);
    sl_status status = SL_OK;
    sli_clusters clusters;
    clusters.member = d->other;
    clusters.start = d->begin;
    *working = -1;
    for (;;) {
        const int last = d->n_levels - 1;
        const sli_level *g = &d->levels[last];
        /* Three times the mean weight keeps the weights of a level even enough for balanced
         * bisection. */
        const sl_int heaviest = (sl_int)(3 * (int64_t)d->total / g->n) + 1;
        sl_int most;
        if (last == 1 && has_balls && sli_level_exceeds(g, SLI_VOLUME_DEGREE)) {
            has_balls = 0;
            sli_free(d->a, g->block);
            d->n_levels = 1;
            continue;
        }
        if (last == 1) {
            d->is_volume = sli_level_exceeds(g, SLI_VOLUME_DEGREE);
            d->may_be_seven_point = !sli_level_exceeds(&d->levels[0], SLI_SEVEN_POINT_DEGREE) &&
                                    sli_level_exceeds(g, SLI_SEVEN_POINT_DEGREE_COARSE);
        }
        most = n / (d->is_volume ? SLI_DISSECT_SHRINK_VOLUME : SLI_DISSECT_SHRINK);
        if (*working == -1 && last > 0 && g->n <= most) {
            *working = last;
            sli_weigh_edges(d);
        }
        if (g->n <= sli_min(sli_dissect_bisect_min(d), most) || d->n_levels == SLI_LEVELS_MAX) {
            break;
        }
        status = sli_coarsen(g, heaviest, has_balls, &d->levels[d->n_levels], d->order, &clusters,
                             &d->ranges, &shrunk, d->a);
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
    return d->pool.failed ? SL_ERR_MEMORY : SL_OK;
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
    sli_dissect_free_levels(d);
    return status;
}

#endif
