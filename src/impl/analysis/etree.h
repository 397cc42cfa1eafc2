/* etree.h: the elimination tree of an ordered graph, postorder, and relabelling along an order */
#ifndef SLI_ETREE_H
#define SLI_ETREE_H

#include "symbolic_types.h"

/* parent[k] := the first row below the diagonal of column k of L, -1 if there is none. ancestor: n
 * of scratch, the paths to the roots found so far, compressed. [Liu90] */
static void sli_etree(sl_int n, const sli_half *rows, sl_int *parent, sl_int *ancestor) {
    sl_int k, p;
    for (k = 0; k < n; k++) {
        parent[k] = -1;
        ancestor[k] = -1;
        for (p = rows->begin[k]; p < rows->begin[k + 1]; p++) {
            sl_int i = rows->to[p];
            while (i != -1 && i < k) {
                const sl_int next = ancestor[i];
                ancestor[i] = k;
                if (next == -1) {
                    parent[i] = k;
                }
                i = next;
            }
        }
    }
}

/* post[k] := the k-th node of a forest in postorder, children ascending; parent[j] > j is not
 * needed. child, sibling: n of scratch each. */
static void sli_postorder(const sl_int *parent, sl_int n, sl_int *post, sl_int *child,
                          sl_int *sibling) {
    sl_int j, k = 0, root;
    for (j = 0; j < n; j++) {
        child[j] = -1;
    }
    for (j = n - 1; j >= 0; j--) { /* the lists come out ascending */
        if (parent[j] != -1) {
            sibling[j] = child[parent[j]];
            child[parent[j]] = j;
        }
    }
    for (root = 0; root < n; root++) {
        if (parent[root] != -1) {
            continue;
        }
        j = root;
        for (;;) {
            /* down to the first leaf; a visited child is taken off its list */
            while (child[j] != -1) {
                const sl_int c = child[j];
                child[j] = sibling[c];
                j = c;
            }
            post[k++] = j;
            if (j == root) {
                break;
            }
            j = parent[j];
        }
    }
}

/* Renumbers along order (order[k] = the number until now of the new k): old_of, its inverse new_of,
 * and the tree. scratch: 2n. */
static void sli_relabel(const sl_int *order, sl_int n, sl_int *old_of, sl_int *new_of,
                        sl_int *parent, sl_int *scratch) {
    sl_int *fresh = scratch, *number = scratch + n, k;
    for (k = 0; k < n; k++) {
        fresh[k] = old_of[order[k]];
        number[order[k]] = k;
    }
    if (n > 0) {
        memcpy(old_of, fresh, (size_t)n * sizeof(sl_int));
    }
    for (k = 0; k < n; k++) {
        const sl_int old = parent[order[k]];
        new_of[old_of[k]] = k;
        fresh[k] = old == -1 ? -1 : number[old];
    }
    if (n > 0) {
        memcpy(parent, fresh, (size_t)n * sizeof(sl_int));
    }
}

#endif
