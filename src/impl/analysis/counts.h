/* counts.h: entries of every column of L, in nearly O(nnz(A)), from the leaves of the row subtrees */
#ifndef SLI_COUNTS_H
#define SLI_COUNTS_H

#include "symbolic_types.h"

/* counts[j] := entries of column j of L, diagonal included; the order is a postorder of parent.
 * columns has the numbers before that order, old_of[j] being j's; scratch: 4n.
 *
 * Row i of L is the subtree of the elimination tree that hangs between i and the smallest columns
 * of row i of A. Column j counts one for each row subtree that it lies in: +1 at every leaf of a
 * row subtree, -1 at the lowest common ancestor of two leaves in a row, -1 at i's parent side for
 * the diagonal, summed up the tree. In a postorder j is a leaf of row i's subtree if no earlier
 * neighbour of i lies among j's descendants. [GNP94]
 */
static void sli_counts(sl_int n, const sli_half *columns, const sl_int *old_of,
                       const sl_int *new_of, const sl_int *parent, sl_int *counts,
                       sl_int *scratch) {
    sl_int *first = scratch, *seen = scratch + n, *leaf = scratch + 2 * (size_t)n,
           *set = scratch + 3 * (size_t)n;
    sl_int i, j, p;
    /* first: the first descendant; seen: the largest first of a leaf in row i; leaf: that leaf */
    for (j = 0; j < n; j++) {
        first[j] = j;
        seen[j] = -1;
        leaf[j] = -1;
        set[j] = j;
    }
    for (j = 0; j < n; j++) {
        counts[j] = first[j] == j; /* a leaf of the tree starts the subtree of its own row */
        if (parent[j] != -1) {
            first[parent[j]] = sli_min(first[parent[j]], first[j]);
        }
    }
    for (j = 0; j < n; j++) {
        const sl_int end = columns->begin[old_of[j] + 1];
        if (parent[j] != -1) {
            counts[parent[j]]--; /* row j ends here */
        }
        for (p = columns->begin[old_of[j]]; p < end; p++) {
            i = new_of[columns->to[p]];
            if (i <= j || first[j] <= seen[i]) {
                continue;
            }
            counts[j]++;
            seen[i] = first[j];
            /* the subtrees of two successive leaves meet at the root of the earlier one's set */
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
