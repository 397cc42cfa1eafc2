/* forest.h: forests: postorder, elimination from the leaves, matrices whose graph is one */
#ifndef SLI_ORDERING_FOREST_H
#define SLI_ORDERING_FOREST_H

#include "border.h"

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

/* Eliminates rows with at most one neighbor until there are none, each followed by that neighbor if
 * it can be next. degree: neighbors left, -1 of rows that are eliminated; only: the XOR of the
 * neighbors left, which is the only one of a leaf and stays its parent, -1 at a root. Returns how
 * many rows are in the sequence. */
static sl_int sli_forest_leaves(sl_int n, sl_int *degree, sl_int *only, sl_int *sequence) {
    sl_int v, u, count = 0;
    for (v = 0; v < n; v++) {
        for (u = v; u != -1 && (degree[u] == 0 || degree[u] == 1); u = only[u]) {
            sequence[count++] = u;
            if (degree[u] == 1) {
                degree[only[u]]--;
                only[only[u]] ^= u;
            } else {
                only[u] = -1;
            }
            degree[u] = -1;
        }
    }
    return count;
}

/* Orders a matrix from the leaves, in a postorder, if its graph is a forest without a row that
 * sli_order_border would move, and finds the elimination tree. Neither a graph nor lists are
 * needed. Returns whether it is such a matrix. scratch: 4n. */
static int sli_order_forest(const sl_csc *A, const sl_int *column, sl_triangle triangle,
                            sl_int *perm, sl_int *parent, sl_int *scratch) {
    const sl_int n = A->n_cols, nnz = sli_nnz(A);
    sl_int *degree = scratch, *only = scratch + n, *more = scratch + 2 * (size_t)n;
    sl_int k, p, edges = 0;
    if (nnz >= (triangle == SL_TRIANGLE_BOTH ? 3 : 2) * (int64_t)n) {
        return 0;
    }
    memset(degree, 0, 2 * (size_t)n * sizeof(sl_int));
    for (p = 0; p < nnz; p++) {
        const sl_int i = A->i[p], j = column[p];
        const int is_edge = i != j && sli_is_read(triangle, i, j);
        degree[i] += is_edge;
        degree[j] += is_edge;
        only[i] ^= is_edge ? j : 0;
        only[j] ^= is_edge ? i : 0;
        edges += is_edge;
    }
    for (k = 0; k < n && edges < n; k++) {
        if (sli_order_is_constraint(A, k, degree[k])) {
            return 0;
        }
    }
    if (edges >= n || sli_forest_leaves(n, degree, only, more) < n) {
        return 0;
    }
    for (k = 0; k < n && (only[more[k]] == -1 || only[more[k]] == more[k + 1]); k++) {
        perm[k] = more[k];
        parent[k] = only[more[k]] == -1 ? -1 : k + 1;
    }
    if (k == n) { /* paths, one after the other */
        return 1;
    }
    sli_postorder(only, more, n, perm, degree, more + n);
    for (k = 0; k < n; k++) {
        degree[perm[k]] = k;
    }
    for (k = 0; k < n; k++) {
        const sl_int up = only[perm[k]];
        parent[k] = up == -1 ? -1 : degree[up];
    }
    return 1;
}

#endif
