/* graph.h: adjacency graphs and permuted triangles of a symmetric pattern; postorder */
#ifndef SLI_ORDERING_GRAPH_H
#define SLI_ORDERING_GRAPH_H

#include "../base/alloc.h"
#include "../base/sort.h"
#include "../matrix/csc.h"

/* The lower triangle of a permuted symmetric pattern, by columns, unsorted. Duplicate entries are
 * kept. Rows are positions in the elimination order. */
typedef struct sli_pattern {
    sl_int *begin; /* n + 1 */
    sl_int *entry; /* SLI_ENTRY for each: its row and its position in A's arrays */
} sli_pattern;

#define SLI_ENTRY 2

static void sli_order_natural(sl_int n, sl_int *perm) {
    sl_int k;
    for (k = 0; k < n; k++) {
        perm[k] = k;
    }
}

/* The adjacency graph of a symmetric matrix: the full pattern without its diagonal. An entry given
 * twice is an edge given twice. */
typedef struct sli_graph {
    sl_int n;
    sl_off *begin; /* n + 1 */
    sl_int *to;    /* begin[n]: neighbors */
} sli_graph;

/* Fills G from the entries of A that are read. Each vertex stands for `block` consecutive rows, so
 * that G->n is A->n_cols / block. G has room for G->n + 1 positions and 2 nnz(A) neighbors. column:
 * of each entry. */
SLI_INLINE void sli_graph_fill(sli_graph *G, const sl_csc *A, const sl_int *column,
                               sl_triangle triangle, sl_int block) {
    const sl_int nnz = sli_nnz(A);
    sl_int p;
    SLI_ZERO(G->begin, G->n + 1);
    for (p = 0; p < nnz; p++) {
        const sl_int j = column[p], at = block == 1 ? j : j / block;
        const sl_int u = block == 1 ? A->i[p] : A->i[p] / block;
        const int is_edge = u != at && sli_is_read(triangle, A->i[p], j);
        G->begin[u] += is_edge;
        G->begin[at] += is_edge;
    }
    (void)sli_starts(G->begin, G->n);
    for (p = 0; p < nnz; p++) {
        const sl_int j = column[p], at = block == 1 ? j : j / block;
        const sl_int u = block == 1 ? A->i[p] : A->i[p] / block;
        if (u != at && sli_is_read(triangle, A->i[p], j)) {
            G->to[G->begin[at]++] = u;
            G->to[G->begin[u]++] = at;
        }
    }
    sli_starts_restore(G->begin, G->n);
}

/* Returns whether every adjacency list is strictly ascending. It is when the rows of each column of
 * A ascend and no entry is given twice. */
SLI_INLINE int sli_graph_is_sorted(const sli_graph *G) {
    sl_int v;
    sl_off e;
    for (v = 0; v < G->n; v++) {
        for (e = G->begin[v] + 1; e < G->begin[v + 1]; e++) {
            if (G->to[e - 1] >= G->to[e]) {
                return 0;
            }
        }
    }
    return 1;
}

/* Writes the adjacency lists, sorted, to `to`. Distributing a symmetric graph vertex by vertex
 * produces sorted lists, as in a transposition. at: n of scratch. */
SLI_INLINE void sli_graph_sort(const sli_graph *G, sl_int *to, sl_off *at) {
    sl_int v;
    sl_off e;
    SLI_COPY(at, G->begin, G->n);
    for (v = 0; v < G->n; v++) {
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            to[at[G->to[e]]++] = v;
        }
    }
}

/* Removes repeated edges from sorted adjacency lists. */
SLI_INLINE void sli_graph_deduplicate(sli_graph *G) {
    sl_int v;
    sl_off e, count = 0, first = 0;
    for (v = 0; v < G->n; v++) {
        const sl_off end = G->begin[v + 1];
        const sl_off kept = count;
        for (e = first; e < end; e++) {
            if (count == kept || G->to[count - 1] != G->to[e]) {
                G->to[count++] = G->to[e];
            }
        }
        first = end;
        G->begin[v] = kept;
    }
    G->begin[G->n] = count;
}

/* Sorts unsorted adjacency lists and removes repeated edges, so that a matrix has one order however
 * it is stored. */
static sl_status sli_graph_make_canonical(sli_graph *G, const sl_allocator *a) {
    const sl_off edges = G->begin[G->n];
    sli_block b = {NULL, 0};
    sl_int *to = NULL;
    sl_off *at = NULL;
    sl_status status = SL_OK;
    if (sli_graph_is_sorted(G)) {
        return SL_OK;
    }
    SLI_LAYOUT(&b, a, status) {
        to = SLI_TAKE(&b, sl_int, edges);
        at = SLI_TAKE(&b, sl_off, G->n);
    }
    if (status == SL_OK) {
        sli_graph_sort(G, to, at);
        SLI_COPY(G->to, to, edges);
        sli_graph_deduplicate(G);
        sli_free(a, b.base);
    }
    return status;
}

SLI_INLINE sl_off sli_graph_degree(const sli_graph *G, sl_int v) {
    return G->begin[v + 1] - G->begin[v];
}

/* Does a row have over 10 sqrt(n) neighbors? It connects everything, and is eliminated last. */
SLI_INLINE int sli_is_dense_row(sl_off degree, sl_int n) {
    return degree * degree > 100 * (sl_off)n;
}

/* post[k] := the k-th of n nodes of a forest in postorder. Roots, and children of a node, follow
 * each other as in the sequence, which may be post; NULL: 0, 1, ... child, sibling: scratch, an
 * element for each node. */
static void sli_postorder(const sl_int *parent, const sl_int *sequence, sl_int n, sl_int *post,
                          sl_int *child, sl_int *sibling) {
    sl_int k, j, at = 0, roots = -1;
    for (k = 0; k < n; k++) {
        child[sequence == NULL ? k : sequence[k]] = -1;
    }
    for (k = n - 1; k >= 0; k--) { /* backwards: the lists then ascend */
        sl_int *list;
        j = sequence == NULL ? k : sequence[k];
        list = parent[j] == -1 ? &roots : &child[parent[j]];
        sibling[j] = *list;
        *list = j;
    }
    for (j = roots; j != -1;) {
        while (child[j] != -1) {
            const sl_int c = child[j];
            child[j] = -1; /* the others follow by their list of siblings */
            j = c;
        }
        post[at++] = j;
        j = sibling[j] != -1 ? sibling[j] : parent[j];
    }
}

/* Turns counts of ranges of entries, `stride` apart, into the positions where each range begins,
 * and fills h->begin. at may be h->begin. */
static void sli_pattern_starts(sli_pattern *h, sl_int n, sl_int *at, sl_int ranges, size_t stride) {
    sl_int k, r, total = 0;
    for (k = 0; k < n; k++) {
        const sl_int begin = total;
        for (r = 0; r < ranges; r++) {
            const sl_int here = at[(size_t)r * stride + (size_t)k];
            at[(size_t)r * stride + (size_t)k] = total;
            total += here;
        }
        h->begin[k] = begin;
    }
    h->begin[n] = total;
}

#endif
