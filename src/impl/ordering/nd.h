/* nd.h: nested dissection of any graph: component by component, dense rows last */
#ifndef SLI_ORDERING_ND_H
#define SLI_ORDERING_ND_H

#include "thin.h"
#include "../base/sort.h"

/* A leaf that is more than twice its intended size after the borders have moved is bisected again.
 * This many rounds at most. */
#define SLI_ND_RESPLITS 12

/* Where the mean separator has at most THIN vertices, as between fans, leaves have THIN_LEAF: L has
 * 1 to 5 percent more entries, and paths have two thirds of theirs. */
#define SLI_ND_THIN 3
#define SLI_ND_THIN_LEAF 20

/* Nodes of a task. */
#define SLI_SEPTREE_NODES 16

/* Sorts the vertices of a separator by the mean label of their neighbors on the left. Rows that are
 * consecutive in one supernode of L then form longer runs in the row lists of the others. */
static void sli_septree_sort_separator(const sli_dissection *d, sli_dissect_worker *w, sl_int node,
                                       sl_int *vertices, sl_int count) {
    const sli_level *g = &d->levels[0];
    uint64_t *list = (uint64_t *)(void *)w->next;
    uint64_t *scratch = (uint64_t *)(void *)w->subgraph.begin;
    sl_int k;
    sl_off e;
    for (k = 0; k < count; k++) {
        int64_t sum = 0, touched = 0;
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            const sl_int other = d->label[g->to[e]];
            if (other < node && sli_label_tree_is_below(&d->tree, node, other)) {
                sum += other;
                touched++;
            }
        }
        list[k] = sli_keyed(touched == 0 ? 0 : (sl_int)(sum / touched), vertices[k]);
    }
    sli_sort(list, count, scratch);
    for (k = 0; k < count; k++) {
        vertices[k] = sli_value(list[k]);
    }
}

/* Orders the vertices of some nodes: leaves by minimum degree. */
static void sli_septree_item(void *data, sl_int item, sl_int worker) {
    sli_dissection *d = (sli_dissection *)data;
    sli_dissect_worker *w = &d->workers[worker];
    const sl_int last = sli_min(d->tree.count, (item + 1) * SLI_SEPTREE_NODES);
    sl_int node;
    for (node = item * SLI_SEPTREE_NODES; node < last; node++) {
        const sl_int count = d->begin[node + 1] - d->begin[node];
        sl_int *mine = d->order + d->begin[node];
        if (!sli_label_tree_is_leaf(&d->tree, node)) {
            sli_septree_sort_separator(d, w, node, mine, count);
        } else if (count > 1) {
            sli_mindeg_order(&w->mindeg, &d->levels[0], mine, count);
        }
    }
}

/* Appends the order of a dissected graph to perm, from position `at` on: each subgraph before the
 * separator above it. row[v] is the row of vertex v. */
static void sli_septree_append(sli_dissection *d, const sl_int *row, sl_int *perm, sl_int at,
                               sli_septree *septree) {
    const sli_label_tree *t = &d->tree;
    sl_int node, k, up, *number = d->nodes;
    sli_dissect_sort(d, t->count);
    sli_team_loop(d->team, (t->count - 1) / SLI_SEPTREE_NODES + 1, NULL, sli_septree_item, d);
    for (node = sli_label_tree_first(t); node != -1; node = sli_label_tree_next(t, node)) {
        const sl_int count = d->begin[node + 1] - d->begin[node];
        const sl_int *mine = d->order + d->begin[node];
        number[node] = count > 0 ? septree->count++ : -1;
        for (k = 0; k < count; k++) {
            perm[at++] = row[mine[k]];
            septree->node_of[row[mine[k]]] = number[node];
        }
    }
    for (node = 0; node < t->count; node++) {
        if (number[node] != -1) {
            for (up = t->parent[node]; up != -1 && number[up] == -1;) {
                up = t->parent[up];
            }
            septree->parent[number[node]] = up == -1 ? -1 : number[up];
        }
    }
}

/* A graph, and the dissection of one of its components after the other. */
typedef struct sli_nd {
    const sli_graph *G;
    const sl_int *weight; /* of the job */
    int is_small;         /* the same */
    sl_int *local;        /* n: number of a row in its component; -1 not yet visited, -2 dense */
    sl_int *row;          /* n: the rows of the component */
    sl_off *begin;        /* n + 1: graph of the component */
    sl_int *to;           /* as many as edges of G */
    sl_int *weights;      /* n, if there are weights */
    sli_dissection d;
} sli_nd;

static void sli_nd_layout(sli_nd *w, sli_block *b) {
    const sl_int n = w->G->n;
    const sl_off edges = w->G->begin[n];
    w->local = SLI_TAKE(b, sl_int, n);
    w->row = SLI_TAKE(b, sl_int, n);
    w->begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
    w->to = SLI_TAKE(b, sl_int, edges);
    w->weights = SLI_TAKE(b, sl_int, w->weight != NULL ? n : 0);
    sli_dissection_layout(&w->d, b, n, edges);
}

/* Collects the rows reachable from root in breadth-first order, which also numbers the component:
 * neighbors are then close in memory, however the caller numbers them. Builds their graph, without
 * dense rows: once the neighbors of a row have been collected, all of them have numbers. */
static sl_int sli_nd_component(sli_nd *w, sl_int root) {
    const sli_graph *G = w->G;
    sl_int head, tail = 0;
    sl_off e, edges = 0;
    w->local[root] = tail;
    w->row[tail++] = root;
    for (head = 0; head < tail; head++) {
        w->begin[head] = edges;
        if (head + 8 < tail) { /* rows far apart in the numbering of the caller */
            SLI_PREFETCH(G->begin + w->row[head + 8], 0);
            SLI_PREFETCH(G->to + G->begin[w->row[head + 4]], 0);
        }
        for (e = G->begin[w->row[head]]; e < G->begin[w->row[head] + 1]; e++) {
            const sl_int u = G->to[e];
            if (w->local[u] == -1) {
                w->local[u] = tail;
                w->row[tail++] = u;
            }
            if (w->local[u] >= 0) {
                w->to[edges++] = w->local[u];
            }
        }
    }
    w->begin[tail] = edges;
    return tail;
}

/* Finds out whether a connected graph is even, and which degree makes a vertex a hub, if few
 * are. */
static void sli_nd_count_degrees(sli_level *g) {
    const sl_off edges = g->begin[g->n], times = SLI_HUB_TIMES * (edges / g->n);
    const sl_off least = times > SLI_HUB_LEAST ? times : SLI_HUB_LEAST;
    sl_int v, count = 0;
    uint64_t squares = 0;
    for (v = 0; v < g->n; v++) {
        const uint64_t degree = (uint64_t)(g->begin[v + 1] - g->begin[v]);
        count += (sl_off)degree >= least;
        squares += degree * degree;
    }
    /* no row is dense: the squares are less than 2^51 */
    g->is_even = 4 * edges >= 15 * (sl_off)g->n && edges <= SLI_PATCH_DEGREE * (sl_off)g->n &&
                 100 * squares <= (uint64_t)((100 + SLI_PATCH_EVEN) * edges / g->n * edges);
    /* gains of bisections, up to twice the weight of all edges of a vertex, are below 2^31 */
    g->hub_degree =
        count > 0 && count <= g->n / SLI_HUB_SHARE && edges < INT32_MAX / (2 * SLI_HUB_EDGES)
            ? least
            : 0;
}

/* Takes the graph of the current component, which has `count` rows. */
static void sli_nd_graph(sli_nd *w, sl_int count) {
    sl_int k;
    w->d.levels[0].n = count;
    w->d.levels[0].begin = w->begin;
    w->d.levels[0].to = w->to;
    w->d.levels[0].weight = w->weight != NULL ? w->weights : NULL;
    sli_nd_count_degrees(&w->d.levels[0]);
    w->d.total = count;
    w->d.first = w->is_small && !sli_level_is_wide(&w->d.levels[0]) ? 0 : SLI_DISSECT_FIRST;
    if (w->weight != NULL) {
        w->d.total = 0;
        for (k = 0; k < count; k++) {
            w->weights[k] = w->weight[w->row[k]];
            w->d.total += w->weights[k];
        }
    }
}

/* Returns whether the mean separator is small. Leaves are then thin, too: minimum degree eliminates
 * them from their ends, and most of a path is within a leaf. */
static int sli_nd_is_thin(const sli_dissection *d) {
    sl_int v, count = 0;
    for (v = 0; v < d->levels[0].n; v++) {
        count += !sli_label_tree_is_leaf(&d->tree, d->label[v]);
    }
    return count <= SLI_ND_THIN * (d->tree.count / 2);
}

/* Finds labels and separators of the current component. */
static sl_status sli_nd_dissect(sli_nd *w) {
    sli_dissection *d = &w->d;
    int rounds = SLI_ND_RESPLITS;
    sl_status status;
    d->level = 0;
    if (d->levels[0].n <= d->leaf_size) {
        sli_dissect_start(d);
        return SL_OK;
    }
    d->is_volume = d->may_be_seven_point = 0; /* unless the first coarser level shows it */
    d->is_levelset = 0;
    status = sli_dissect_graph(d);
    if (status == SL_OK) {
        do {
            sli_dissect_visit(d, sli_dissect_separate);
            if (rounds == SLI_ND_RESPLITS && sli_nd_is_thin(d)) {
                d->leaf_size = SLI_ND_THIN_LEAF;
            }
        } while (rounds-- > 0 && /* untested: there are fewer rounds */
                 sli_dissect_split(d, 2 * d->leaf_size, sli_dissect_bisect) > 0);
        d->leaf_size = SLI_DISSECT_LEAF;
        status = d->pool.failed ? sli_no_memory() : SL_OK;
    }
    return status;
}

/* Marks the dense rows and puts them at the end of the order. Returns their number. */
static sl_int sli_nd_dense(sli_nd *w, sl_int *perm) {
    const sli_graph *G = w->G;
    sl_int v, count = 0;
    for (v = G->n - 1; v >= 0; v--) {
        w->local[v] = -1;
        if (sli_is_dense_row(sli_graph_degree(G, v), G->n)) {
            w->local[v] = -2;
            perm[G->n - ++count] = v;
        }
    }
    return count;
}

/* Orders all components, then the dense rows, which become the root of all separator trees. */
static sl_status sli_nd_run(sli_nd *w, sl_int *perm, sli_septree *septree) {
    const sl_int n = w->G->n, dense = sli_nd_dense(w, perm);
    sl_int v, k, at = 0;
    sl_status status = SL_OK;
    septree->count = 0;
    for (k = 0; k < w->d.team->workers; k++) {
        SLI_NONE(w->d.workers[k].subgraph.local, n);
    }
    for (v = 0; v < n && status == SL_OK; v++) {
        if (w->local[v] == -1) {
            const sl_int count = sli_nd_component(w, v);
            if (count == 1) { /* no dissection; there may be very many of these */
                perm[at++] = v;
                septree->node_of[v] = septree->count;
                septree->parent[septree->count++] = -1;
                continue;
            }
            sli_nd_graph(w, count);
            if (w->weight == NULL && count > w->d.leaf_size &&
                sli_order_thin(&w->d, w->row, perm, at, septree)) {
                at += count;
                continue;
            }
            status = sli_nd_dissect(w);
            if (status == SL_OK) {
                sli_septree_append(&w->d, w->row, perm, at, septree);
                at += count;
            }
        }
    }
    if (dense > 0 && status == SL_OK) {
        for (k = 0; k < septree->count; k++) {
            septree->parent[k] = septree->parent[k] == -1 ? septree->count : septree->parent[k];
        }
        for (k = n - dense; k < n; k++) {
            septree->node_of[perm[k]] = septree->count;
        }
        septree->parent[septree->count++] = -1;
    }
    return status;
}

/* Orders the graph of a job, which has no repeated edges, and builds its separator tree. */
static sl_status sli_order_nd(const sli_order_job *job) {
    sli_nd w;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_int k;
    SLI_CLEAR(w);
    w.G = job->G;
    w.weight = job->weight;
    w.is_small = job->is_small;
    w.d.leaf_size = SLI_DISSECT_LEAF;
    w.d.team = job->team;
    w.d.a = w.d.pool.a = job->a;
    SLI_LAYOUT(&b, job->a, status) {
        sli_nd_layout(&w, &b);
    }
    if (status == SL_OK) {
        /* to ask takes longer than what that saves in a small graph */
        const int has_avx2 = w.G->n > 256 && sli_cpu_best() != SL_ISA_SCALAR; /* untested: none */
        for (k = 0; k < job->team->workers; k++) {
            w.d.workers[k].mindeg.has_avx2 = has_avx2;
        }
        status = sli_nd_run(&w, job->perm, job->septree);
        sli_border_pool_free(&w.d.pool);
        sli_free(job->a, b.base);
    }
    return status;
}

#endif
