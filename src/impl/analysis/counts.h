/* counts.h: column counts of L in nearly O(nnz(A)), from the leaves of the row subtrees */
#ifndef SLI_ANALYSIS_COUNTS_H
#define SLI_ANALYSIS_COUNTS_H

#include "symbolic_types.h"

/* counts[j] := entries of column j of L, diagonal included. The columns are numbered in a postorder
 * of parent; `columns` has the numbers before it, and column j had number old_of[j]. scratch: 4n.
 *
 * Row i of L has the structure of the row subtree of i: the part of the elimination tree between i
 * and the columns of row i of A. counts[j] is the number of row subtrees that contain j. To count
 * them, each row subtree contributes +1 at each of its leaves, -1 at the lowest common ancestor of
 * successive leaves, and -1 at the parent of its root i; sums over subtrees then give the counts.
 * In a postorder, j is a leaf of the row subtree of i if no earlier neighbor of i is a descendant
 * of j. [GNP94]
 */
static void sli_counts(sl_int n, const sli_pattern *columns, const sl_int *old_of,
                       const sl_int *new_of, const sl_int *parent, sl_int *counts,
                       sl_int *scratch) {
    sl_int *first = scratch, *seen = scratch + n, *leaf = scratch + 2 * (size_t)n,
           *set = scratch + 3 * (size_t)n;
    sl_int i, j, p;
    /* first: the first descendant; seen: the largest `first` of a leaf of row i; leaf: that leaf */
    for (j = 0; j < n; j++) {
        first[j] = j;
        seen[j] = -1;
        leaf[j] = -1;
        set[j] = j;
    }
    for (j = 0; j < n; j++) {
        counts[j] = first[j] == j; /* a leaf of the tree is also a leaf of its own row subtree */
        if (parent[j] != -1) {
            first[parent[j]] = sli_min(first[parent[j]], first[j]);
        }
    }
    for (j = 0; j < n; j++) {
        const sl_int end = columns->begin[old_of[j] + 1];
        if (parent[j] != -1) {
            counts[parent[j]]--; /* the row subtree of j ends at j */
        }
        for (p = columns->begin[old_of[j]]; p < end; p++) {
            i = new_of[columns->to[p]];
            if (i <= j || first[j] <= seen[i]) {
                continue;
            }
            counts[j]++;
            seen[i] = first[j];
            /* The lowest common ancestor of two successive leaves is the root of the earlier leaf's
             * set. */
            if (leaf[i] != -1) {
                sl_int root = leaf[i], q = leaf[i];
                while (root != set[root]) {
                    root = set[root];
                }
                while (q != root) {
                    const sl_int up = set[q];
                    set[q] = root;
                    q = up;
                }
                counts[root]--;
            }
            leaf[i] = j;
        }
        if (parent[j] != -1) {
            set[j] = parent[j];
        }
    }
    for (j = 0; j < n; j++) {
        if (parent[j] != -1) {
            counts[parent[j]] += counts[j];
        }
    }
}

#endif
