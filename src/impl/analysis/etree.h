/* etree.h: elimination tree, postorder, and renumbering of the columns */
#ifndef SLI_ANALYSIS_ETREE_H
#define SLI_ANALYSIS_ETREE_H

#include "symbolic_types.h"

/* parent[k] := the first row below the diagonal of column k of L, or -1. ancestor: n of scratch,
 * path-compressed links towards the roots found so far; n at a root. [Liu90] */
static void sli_etree(sl_int n, const sli_pattern *rows, sl_int *parent, sl_int *ancestor) {
    const sl_int *to = rows->to;
    sl_int k, p = 0;
    for (k = 0; k < n; k++) {
        const sl_int end = rows->begin[k + 1];
        parent[k] = -1;
        ancestor[k] = n;
        for (; p < end; p++) {
            sl_int i = to[p], next = i < k ? ancestor[i] : k;
            ancestor[i] = i < k ? k : n;
            parent[i] = next == n ? k : parent[i];
            while (next < k) {
                i = next;
                next = ancestor[i];
                ancestor[i] = k;
                parent[i] = next == n ? k : parent[i];
            }
        }
    }
}

/* post[k] := the k-th node of a forest in postorder, with children in ascending order. parent[j] >
 * j is not required. child, sibling: n of scratch each. */
static void sli_postorder(const sl_int *parent, sl_int n, sl_int *post, sl_int *child,
                          sl_int *sibling) {
    sl_int j, k = 0, root;
    for (j = 0; j < n; j++) {
        child[j] = -1;
    }
    for (j = n - 1; j >= 0; j--) { /* backwards: the lists then ascend */
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
            /* Descend to the first leaf. A visited child is removed from its list. */
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

/* Renumbers the columns: order[k] = the old number of the new column k. Updates old_of, its inverse
 * new_of, and the tree. scratch: 2n. */
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
