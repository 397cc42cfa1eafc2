/* order_own.h: nested dissection of any graph: dense rows last, components one by one */
#ifndef SLI_ORDER_OWN_H
#define SLI_ORDER_OWN_H

#include "graph.h"
#include "order_geometric.h"
#include "order_nest.h"
#include "order_quality.h"

/* A row with more neighbours than this many times sqrt(n) joins everything: it goes to the end. */
#define SLI_DENSE_ROW 10.0

/* A leaf that is twice as large as it should be, after its borders have moved, is cut again, and so
 * may its halves. */
#define SLI_REPAIRS 12

typedef struct sli_nesting {
    const sli_graph *G;
    const sl_int *weight; /* NULL: 1 each */
    const double *xyz;    /* NULL: none */
    sl_int dimensions;
    int by_metis;
    sl_int *local;      /* n: a row's number in its component, -1 not yet seen, -2 dense */
    sl_int *row;        /* n: the rows of the component */
    sl_off *begin;      /* n + 1: its graph */
    sl_int *to;         /* the edges of G */
    sl_int *weights;    /* n, where there are weights */
    sli_placed *placed; /* n, where there are coordinates */
    sli_dissection d;
} sli_nesting;

static void sli_nesting_layout(sli_nesting *w, sli_block *b) {
    const sl_int n = w->G->n;
    const sl_off edges = w->G->begin[n];
    w->local = SLI_TAKE(b, sl_int, n);
    w->row = SLI_TAKE(b, sl_int, n);
    w->begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
    w->to = SLI_TAKE(b, sl_int, edges);
    w->weights = SLI_TAKE(b, sl_int, w->weight != NULL ? n : 0);
    w->placed = SLI_TAKE(b, sli_placed, w->xyz != NULL ? n : 0);
    sli_dissection_layout(&w->d, b, n, edges);
}

/* Rows reached from root, in breadth-first order, which is also what the component is numbered by:
 * neighbours then lie close in memory, however the caller numbers them. */
static sl_int sli_nesting_component(sli_nesting *w, sl_int root) {
    const sli_graph *G = w->G;
    sl_int head, tail = 0;
    sl_off e;
    w->local[root] = tail;
    w->row[tail++] = root;
    for (head = 0; head < tail; head++) {
        for (e = G->begin[w->row[head]]; e < G->begin[w->row[head] + 1]; e++) {
            if (w->local[G->to[e]] == -1) {
                w->local[G->to[e]] = tail;
                w->row[tail++] = G->to[e];
            }
        }
    }
    return tail;
}

static void sli_nesting_graph(sli_nesting *w, sl_int count) {
    const sli_graph *G = w->G;
    sl_off e, edges = 0;
    sl_int k;
    for (k = 0; k < count; k++) {
        w->begin[k] = edges;
        for (e = G->begin[w->row[k]]; e < G->begin[w->row[k] + 1]; e++) {
            if (w->local[G->to[e]] >= 0) {
                w->to[edges++] = w->local[G->to[e]];
            }
        }
    }
    w->begin[count] = edges;
    w->d.levels[0].n = count;
    w->d.levels[0].begin = w->begin;
    w->d.levels[0].to = w->to;
    w->d.levels[0].weight = w->weight != NULL ? w->weights : NULL;
    w->d.total = count;
    if (w->weight != NULL) {
        w->d.total = 0;
        for (k = 0; k < count; k++) {
            w->weights[k] = w->weight[w->row[k]];
            w->d.total += w->weights[k];
        }
    }
}

/* Labels of the component whose graph is there, by the cheaper of two trees where there are two. The
 * cruder the borders, the wider the bands in which they are refined. */
static sl_status sli_nesting_label(sli_nesting *w) {
    sli_dissection *d = &w->d;
    d->widening = 2;
    if (w->by_metis) {
#if !defined(SL_NO_METIS)
        return sli_dissect_quality(d);
#else
        return SL_ERR_UNSUPPORTED;
#endif
    }
    if (w->xyz != NULL) {
        sli_points points;
        points.xyz = w->xyz;
        points.dimensions = w->dimensions;
        points.row = w->row;
        return sli_dissect_geometric(d, &points, w->placed);
    }
    return sli_dissect_graph(d);
}

/* Labels and separators of that component. */
static sl_status sli_nesting_dissect(sli_nesting *w) {
    sli_dissection *d = &w->d;
    int rounds = SLI_REPAIRS;
    sl_status status;
    d->l = 0;
    if (d->levels[0].n <= d->most) {
        sli_dissect_start(d);
        return SL_OK;
    }
    status = sli_nesting_label(w);
    if (status == SL_OK) {
        do {
            sli_dissect_cut(d);
        } while (rounds-- > 0 && sli_dissect_split(d, 2 * d->most) > 0);
        status = d->borders.failed ? SL_ERR_MEMORY : SL_OK;
    }
    return status;
}

/* Marks dense rows and appends them to the order, from the end; how many there are. */
static sl_int sli_nesting_dense(sli_nesting *w, sl_int *perm) {
    const sli_graph *G = w->G;
    const double most = SLI_DENSE_ROW * sqrt((double)G->n);
    sl_int v, count = 0;
    for (v = G->n - 1; v >= 0; v--) {
        w->local[v] = -1;
        if ((double)(G->begin[v + 1] - G->begin[v]) > most) {
            w->local[v] = -2;
            perm[G->n - ++count] = v;
        }
    }
    return count;
}

static sl_status sli_nesting_run(sli_nesting *w, sl_int *perm, sli_nest *nest) {
    const sl_int n = w->G->n, dense = sli_nesting_dense(w, perm);
    sl_int v, k, at = 0;
    sl_status status = SL_OK;
    nest->count = 0;
    for (v = 0; v < n; v++) {
        w->d.part.place[v] = -1;
    }
    for (v = 0; v < n && status == SL_OK; v++) {
        if (w->local[v] == -1) {
            const sl_int count = sli_nesting_component(w, v);
            if (count == 1) { /* nothing to do, and there may be very many */
                perm[at++] = v;
                nest->of[v] = nest->count;
                nest->parent[nest->count++] = -1;
                continue;
            }
            sli_nesting_graph(w, count);
            status = sli_nesting_dissect(w);
            if (status == SL_OK) {
                sli_nest_append(&w->d, w->row, perm, at, nest);
                at += count;
            }
        }
    }
    if (dense > 0 && status == SL_OK) {
        for (k = 0; k < nest->count; k++) {
            nest->parent[k] = nest->parent[k] == -1 ? nest->count : nest->parent[k];
        }
        for (k = n - dense; k < n; k++) {
            nest->of[perm[k]] = nest->count;
        }
        nest->parent[nest->count++] = -1;
    }
    return status;
}

/* The order of a graph without repeated edges, and its tree. weight: what its vertices count for in
 * the balance; NULL: one each. */
static sl_status sli_order_own(const sli_graph *G, const sl_int *weight, int by_metis,
                               const double *xyz, sl_int dimensions, sl_int *perm, sli_nest *nest,
                               const sl_allocator *a) {
    sli_nesting w;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    memset(&w, 0, sizeof w);
    w.G = G;
    w.weight = weight;
    w.xyz = xyz;
    w.dimensions = dimensions;
    w.by_metis = by_metis;
    w.d.most = by_metis ? SLI_DISSECT_LEAF_QUALITY : SLI_DISSECT_LEAF;
    w.d.a = a;
    w.d.leaf.has_popcnt = sli_cpu_best() != SL_ISA_SCALAR;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_nesting_layout(&w, &b);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status == SL_OK) {
        sli_borders_init(&w.d.borders, a);
        status = sli_nesting_run(&w, perm, nest);
        sli_free(a, w.d.borders.block);
        sli_free(a, b.base);
    }
    return status;
}

#endif
