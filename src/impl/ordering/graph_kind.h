/* graph_kind.h: on which graphs minimum degree may be better than dissection, and on which it is */
#ifndef SLI_ORDERING_GRAPH_KIND_H
#define SLI_ORDERING_GRAPH_KIND_H

#include "levels.h"
#include "quotient_order.h"

/* Do the degrees vary so much that minimum degree may have far less fill than dissection? The mean
 * of their squares is at least 6/5 of the square of their mean: below 1.08 of it on most meshes,
 * 1.2 to 15 on networks and KKT systems. Where rows of few neighbors have been peeled, 11/10:
 * random graphs have 1.14, networks of roads 1.04. Degrees count up to 1024, and all products are
 * exact. */
static int sli_order_is_irregular(const sli_graph *G, int is_peeled) {
    uint64_t squares = 0, mean;
    sl_int v;
    if (G->n == 0 || G->begin[G->n] / G->n >= 1024) {
        return 0;
    }
    for (v = 0; v < G->n; v++) {
        const uint64_t degree = (uint64_t)(G->begin[v + 1] - G->begin[v]);
        squares += degree < 1024 ? degree * degree : 1024 * 1024;
    }
    mean = 16 * (uint64_t)G->begin[G->n] / (uint64_t)G->n;
    return mean > 0 && 10 * 256 * squares >= (is_peeled ? 11u : 12u) * mean * mean * (uint64_t)G->n;
}

/* Is the graph bipartite, with too many edges to be planar? KKT systems are, once bounds are peeled
 * and if the Hessian is diagonal: variables on one side, constraints on the other. queue, side: n
 * of scratch. */
static int sli_order_is_bipartite(const sli_graph *G, sl_int *queue, sl_int *side) {
    sl_int root, head, tail = 0;
    sl_off e;
    if (G->begin[G->n] <= 4 * (sl_off)G->n) {
        return 0;
    }
    for (root = 0; root < G->n; root++) {
        side[root] = -1;
    }
    for (root = 0, head = 0; root < G->n; root++) {
        if (side[root] == -1) {
            side[root] = 0;
            queue[tail++] = root;
        }
        for (; head < tail; head++) {
            const sl_int v = queue[head];
            for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
                const sl_int u = G->to[e];
                if (side[u] == side[v]) {
                    return 0;
                }
                if (side[u] == -1) {
                    side[u] = 1 - side[v];
                    queue[tail++] = u;
                }
            }
        }
    }
    return 1;
}

/* May two edges lead from most rows to most others? */
static int sli_order_is_dense(const sli_graph *G) {
    const sl_off n = G->n, mean = n > 0 ? G->begin[n] / n : 0;
    return mean * mean > n;
}

/* How far apart are the rows? In a thin graph the levels of a breadth-first search have at most 32
 * rows in the mean, and there are at least 32: minimum degree has long paths then. In an expanding
 * one most rows are a few edges apart, and a mean level has 1/8 of all: a tenth of that in volumes
 * of 1e4 rows. queue, seen: n of scratch. */
typedef enum sli_graph_shape {
    SLI_SHAPE_THIN,
    SLI_SHAPE_OTHER,
    SLI_SHAPE_EXPANDING
} sli_graph_shape;

static sli_graph_shape sli_order_shape(const sli_graph *G, sl_int *queue, sl_int *seen) {
    const int64_t n = G->n, most = n * n / 8;
    int64_t entries = 0;
    sl_int v, tail = 0;
    memset(seen, 0, (size_t)n * sizeof(sl_int));
    for (v = 0; v < G->n && entries <= most; v++) {
        if (seen[v] == 0) {
            tail = sli_levels_search(G, v, queue, tail, seen, 1, most, &entries);
        }
    }
    return entries > most                               ? SLI_SHAPE_EXPANDING
           : entries <= 32 * n && entries <= n * n / 32 ? SLI_SHAPE_THIN
                                                        : SLI_SHAPE_OTHER;
}

/* Where most operations are in one front, no small separator has been missed: graphs of random
 * constraints are eliminated for nearly nothing, up to one dense block. Dissection has more fill
 * and longer paths then. */
static int sli_order_has_core(const sli_order_cost *c) {
    return c->widest * c->widest * c->widest > 1.5 * c->flops;
}

/* Is there next to no fill, and are the paths little longer than those within the largest fronts?
 * No other order is much better then. Programs of lasso, Huber and portfolio problems have no fill,
 * and paths 1.0 to 1.2 times as long. */
static int sli_order_is_without_fill(const sli_order_cost *c, const sli_graph *G) {
    const double entries = 0.5 * (double)G->begin[G->n] + (double)G->n;
    return c->entries <= 1.125 * entries && c->paths <= 1.25 * c->fronts;
}

/* The entries on the path of a mean row relative to flops^(2/3), cubed: those of one dense block
 * are 1.1 of it, in a balanced tree fewer. Minimum degree has 0.5 to 0.6 of it on plane grids, 0.7
 * in volumes, and 2 and more on long chains, which it eliminates from one end. */
static double sli_order_path_share(const sli_order_cost *c, sl_int n) {
    const double path = c->paths / (double)sli_max(n, 1);
    return c->flops > 0.0 ? path / c->flops * path / c->flops * path : 0.0;
}
#define SLI_ORDER_PATHS_SHORT (0.67 * 0.67 * 0.67)
#define SLI_ORDER_PATHS_LONG (1.2 * 1.2 * 1.2)

#endif
