/* counts.h: column counts of L in nearly O(nnz(A)), from the leaves of the row subtrees */
#ifndef SLI_ANALYSIS_COUNTS_H
#define SLI_ANALYSIS_COUNTS_H

#include "symbolic_types.h"

/* counts[j] := entries of column j of L, diagonal included. The columns are numbered in a postorder
 * of parent; `columns` has the numbers before it, and column j had number old_of[j]. scratch: 5n.
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
    /* first: the first descendant; up: an ancestor. Of each row, leaf: the last leaf so far, or n;
     * seen: the first descendant of that leaf, or -1 */
    sl_int *first = scratch, *up = scratch + n, *row = scratch + 2 * (size_t)n;
    sl_int *queue = scratch + 4 * (size_t)n, j, p, c;
    for (j = 0; j < n; j++) {
        first[j] = j;
        up[j] = parent[j] == -1 ? n : parent[j];
        row[2 * (size_t)j] = -1;
        row[2 * (size_t)j + 1] = n;
        counts[j] = 0;
    }
    for (j = 0; j < n; j++) {
        const sl_int from = first[j], end = columns->begin[old_of[j] + 1];
        /* a leaf of the tree is also a leaf of its own row subtree, which it passes as its diagonal
         * entry if there is one */
        sl_int leaves = from == j, length = 0;
        row[2 * (size_t)j] = from;
        for (p = columns->begin[old_of[j]]; p < end; p++) {
            sl_int *seen = row + 2 * (size_t)new_of[columns->to[p]], at = seen[1];
            const int is_leaf = from > seen[0]; /* no branch: nothing would predict it */
            seen[0] = is_leaf ? from : seen[0];
            seen[1] = is_leaf ? j : at;
            leaves += is_leaf;
            queue[length] = at;
            length += is_leaf & (at < j);
        }
        counts[j] += leaves;
        for (c = 0; c < length; c++) {
            /* The lowest common ancestor of two successive leaves is the first ancestor of the
             * earlier one from j on. Links are shortened: later searches end above j, too. */
            sl_int at = queue[c];
            do {
                const sl_int next = up[at];
                up[at] = next < j ? up[next] : next;
                at = up[at];
            } while (at < j);
            counts[at]--;
        }
        if (parent[j] != -1) {
            first[parent[j]] = sli_min(first[parent[j]], from);
            counts[parent[j]]--; /* the row subtree of j ends at j */
        }
    }
    for (j = 0; j < n; j++) {
        if (parent[j] != -1) {
            counts[parent[j]] += counts[j];
        }
    }
}

#endif
