/* border.h: dense rows without a diagonal entry, and their place in an order */
#ifndef SLI_ORDERING_BORDER_H
#define SLI_ORDERING_BORDER_H

#include "graph.h"
#include "septree.h"

/* Does A store a diagonal entry in column j? */
static int sli_order_has_diagonal(const sl_csc *A, sl_int j) {
    sl_int p = A->p[j];
    while (p < A->p[j + 1] && A->i[p] != j) {
        p++;
    }
    return p < A->p[j + 1];
}

/* Has this row so many neighbors that, without a diagonal entry, it is a constraint? */
SLI_INLINE int sli_order_is_constraint(const sl_csc *A, sl_int row, sl_off degree) {
    return degree >= 8 && degree * degree >= A->n_cols && !sli_order_has_diagonal(A, row);
}

SLI_INLINE sl_off sli_graph_degree(const sli_graph *G, sl_int v) {
    return G->begin[v + 1] - G->begin[v];
}

/* A row with many neighbors and without a diagonal entry is a constraint, as in [L m; m' 0] with a
 * Laplacian L and weights m. After all of its neighbors, it would follow a null pivot of L. So the
 * last one of them moves behind it: L without that row is definite. Both are in the last dense
 * block, and the exchange costs nothing. position: n of scratch. */
static void sli_order_border(const sl_csc *A, const sli_graph *G, sl_int *perm, sl_int *position,
                             sli_septree *septree) {
    sl_int k, v, last;
    sl_off e;
    for (v = 0; v < G->n && !sli_order_is_constraint(A, v, sli_graph_degree(G, v)); v++) {
    }
    if (v == G->n) {
        return; /* usual */
    }
    for (k = 0; k < G->n; k++) {
        position[perm[k]] = k;
    }
    for (k = 0; k < G->n; k++) {
        const sl_int row = perm[k];
        if (!sli_order_is_constraint(A, row, sli_graph_degree(G, row))) {
            continue;
        }
        last = -1;
        for (e = G->begin[row]; e < G->begin[row + 1]; e++) {
            last = sli_max(last, position[G->to[e]]);
        }
        if (last > k) {
            continue;
        }
        v = perm[last];
        for (; last < k; last++) {
            perm[last] = perm[last + 1];
            position[perm[last]] = last;
        }
        perm[k] = v;
        position[v] = k;
        septree->count = 0; /* its nodes would no longer be contiguous */
    }
}

#endif
