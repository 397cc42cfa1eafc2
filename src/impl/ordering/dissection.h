/* dissection.h: the state of a dissection, and loops over vertices, leaves and borders */
#ifndef SLI_ORDERING_DISSECTION_H
#define SLI_ORDERING_DISSECTION_H

#include "graph.h"
#include "mindeg.h"
#include "subgraph.h"

/* Subtrees of at most this share of the weight, for each worker, are one task. */
#define SLI_DISSECT_TASKS 8

/* The scratch of one worker. All arrays have room for the largest graph. */
typedef struct sli_dissect_worker {
    sli_borders borders;
    sli_subgraph subgraph;
    sli_mindeg mindeg;
    sl_off *next; /* n */
} sli_dissect_worker;

/* The state of a dissection. One graph after the other is dissected in it; all arrays have room for
 * the largest. Bisections, refinements of borders and separators are shared by the workers of a
 * team: what happens below a node depends only on what has happened there and at the nodes above,
 * so that the result does not depend on the workers. */
typedef struct sli_dissection {
    const sl_allocator *a;
    sli_team *team;
    sli_shares ranges;                /* their scratch is `next` of the workers */
    sli_level levels[SLI_LEVELS_MAX]; /* finest first; the arrays of the finest are borrowed */
    int n_levels, level;              /* level: the one that the labels refer to */
    sl_int total;                     /* weight of the finest level */
    sl_int leaf_size;                 /* most vertices of a leaf, if it can be bisected */
    sl_int first;                     /* bisections are the first ones up to so many nodes */
    int is_volume, may_be_seven_point;
    int is_levelset; /* labels are level sets */
    sli_label_tree tree, other_tree; /* other_tree and other: a dissection that is compared */
    sli_border_pool pool;
    sli_dissect_worker *workers; /* team->workers; the first is the leader */
    sl_int *label, *other;       /* n: the node of each vertex; `other` is scratch */
    sl_int *begin;               /* n + 2: where each node's vertices begin in order */
    sl_int *order;               /* n */
    sl_int *nodes;               /* n + 1 */
    sl_int n_labels, n_ranges;   /* of the loop under way */
    int is_counted;
    /* the loop under way: bisects a subgraph, or visits a node */
    void (*bisect)(sli_subgraph *sub, int is_first);
    void (*visit)(struct sli_dissection *d, sli_dissect_worker *w, sl_int node);
} sli_dissection;

static void sli_dissection_layout(sli_dissection *d, sli_block *b, sl_int n, sl_off edges) {
    const sl_int room = sli_min(n, n / 4 + 1024) + 1; /* of nodes: more leaves would be tiny */
    sl_int k, *head;
    sl_off *next;
    d->levels[0].coarse = SLI_TAKE(b, sl_int, n);
    sli_label_tree_layout(&d->tree, b, room);
    sli_label_tree_layout(&d->other_tree, b, room);
    head = SLI_TAKE(b, sl_int, room);
    d->label = SLI_TAKE(b, sl_int, n);
    d->other = SLI_TAKE(b, sl_int, n);
    d->begin = SLI_TAKE(b, sl_int, (size_t)n + 2);
    d->order = SLI_TAKE(b, sl_int, n);
    d->nodes = SLI_TAKE(b, sl_int, (size_t)n + 1);
    d->workers = SLI_TAKE(b, sli_dissect_worker, d->team->workers);
    next = SLI_TAKE(b, sl_off, (uint64_t)n * (uint64_t)d->team->workers);
    d->ranges.team = d->team;
    d->ranges.scratch = next;
    d->ranges.room = n;
    for (k = 0; k < d->team->workers; k++) {
        sli_dissect_worker counted, *w = d->workers == NULL ? &counted : &d->workers[k];
        sli_subgraph_layout(&w->subgraph, b, n, edges);
        w->next = next == NULL ? NULL : next + (size_t)k * (size_t)n;
        w->mindeg.local = w->subgraph.local;
        w->mindeg.order = w->subgraph.scratch;
        w->mindeg.bit = w->subgraph.to;
        w->mindeg.key = SLI_TAKE(b, uint32_t, SLI_MINDEG_MAX);
        w->mindeg.room = (size_t)SLI_MINDEG_MAX * SLI_MINDEG_MAX / 32;
        w->mindeg.rows = SLI_TAKE(b, uint64_t, w->mindeg.room);
        w->borders.head = head;
        w->borders.tail = NULL;
        w->borders.pool = &d->pool;
    }
}

SLI_INLINE sli_labelling sli_dissect_labelling(sli_dissection *d) {
    sli_labelling in;
    in.g = &d->levels[d->level];
    in.tree = &d->tree;
    in.label = d->label;
    return in;
}

/* A number for each label: of several ranges, each has two such arrays, one after the other. */
static sl_int *sli_dissect_by_label(const sli_dissection *d, sl_int item) {
    return (sl_int *)(void *)d->ranges.scratch + 2 * (size_t)item * (size_t)d->n_labels;
}

/* Runs a loop over the vertices of the level, which have so many labels. */
static void sli_dissect_loop(sli_dissection *d, sl_int n_labels, sli_range_body *body) {
    const sl_int n = d->levels[d->level].n;
    d->n_labels = n_labels;
    d->n_ranges =
        SLI_SHARES * (int64_t)d->n_labels <= d->ranges.room ? sli_shares_count(d->team, n) : 1;
    sli_range_run(d->team, n, d->n_ranges, body, d);
}

/* Counts the vertices of a range by label, or distributes them. */
static void sli_dissect_distribute(void *data, const sli_range *r) {
    const sli_dissection *d = (const sli_dissection *)data;
    sl_int v, *at = sli_dissect_by_label(d, r->item);
    if (!d->is_counted) {
        SLI_ZERO(at, d->n_labels);
    }
    for (v = r->first; v < r->last; v++) {
        const sl_int to = at[d->label[v]]++;
        if (d->is_counted) {
            d->order[to] = v;
        }
    }
}

/* Sorts the vertices by label, of which there are `labels`: those of label t become
 * order[begin[t]] .. order[begin[t + 1] - 1]. */
static void sli_dissect_sort(sli_dissection *d, sl_int labels) {
    sli_pattern h;
    h.begin = d->begin;
    d->is_counted = 0;
    sli_dissect_loop(d, labels, sli_dissect_distribute);
    sli_pattern_starts(&h, labels, sli_dissect_by_label(d, 0), d->n_ranges, 2 * (size_t)labels);
    d->is_counted = 1;
    sli_dissect_loop(d, labels, sli_dissect_distribute);
}

/* Starts with a tree of one leaf that contains all vertices. */
static void sli_dissect_start(sli_dissection *d) {
    const sl_int n = d->levels[d->level].n;
    d->tree.count = 0;
    d->tree.root = sli_label_tree_add(&d->tree, -1);
    d->tree.weight[d->tree.root] = d->total;
    SLI_ZERO(d->label, n);
    sli_label_tree_number(&d->tree, n, d->label);
}

/* Gives the two sides of the subgraph of a former leaf to the new leaves below it. */
static void sli_dissect_split_item(void *data, sl_int node, sl_int worker) {
    sli_dissection *d = (sli_dissection *)data;
    const sli_labelling in = sli_dissect_labelling(d);
    sli_subgraph *sub = &d->workers[worker].subgraph;
    const sl_int leaf[2] = {d->tree.left[node], d->tree.right[node]};
    sl_int k, weight[2] = {0, 0};
    sli_subgraph_leaf(sub, &in, node, d->order + d->begin[node],
                      d->begin[node + 1] - d->begin[node]);
    d->bisect(sub, leaf[0] < d->first);
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
 * finest. Returns how many have two sides now. */
static sl_int sli_dissect_split(sli_dissection *d, sl_int most,
                                void (*bisect)(sli_subgraph *sub, int is_first)) {
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
        for (node = nodes; node < d->tree.count; node++) { /* one of two leaves may be empty */
            split -= d->tree.weight[node] == 0;
        }
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
    const sli_labelling in = sli_dissect_labelling(d);
    sli_borders *l = &d->workers[r->worker].borders;
    sl_int *head = l->head;
    if (d->n_ranges > 1) {
        l->head = sli_dissect_by_label(d, r->item);
        l->tail = l->head + d->tree.count;
    }
    sli_borders_fill(l, &in, r);
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

#endif
