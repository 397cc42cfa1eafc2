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
    /* first: the first descendant; up: an ancestor. Of each row, leaf: the last leaf so far, or
     * itself; seen: the first descendant of that leaf, or -1 */
    sl_int *first = scratch, *up = scratch + n, *row = scratch + 2 * (size_t)n;
    sl_int j, p;
    for (j = 0; j < n; j++) {
        first[j] = j;
        up[j] = parent[j] == -1 ? n : parent[j];
        row[2 * (size_t)j] = -1;
        row[2 * (size_t)j + 1] = j;
        /* A leaf of the tree is also a leaf of its own row subtree. Any other row has a first leaf,
         * for which the loop below subtracts one at the row. */
        counts[j] = 1;
    }
    for (j = 0; j < n; j++) {
        const sl_int from = first[j], end = columns->begin[old_of[j] + 1];
        sl_int leaves = 0;
        for (p = columns->begin[old_of[j]]; p < end; p++) {
            const sl_int i = new_of[columns->to[p]];
            sl_int *seen = row + 2 * (size_t)i, at = seen[1];
            if (from <= seen[0]) {
                continue;
            }
            /* The lowest common ancestor of two successive leaves is the first ancestor of the
             * earlier one from j on. Links are shortened: later searches end above j, too. */
            while (at < j) {
                const sl_int next = up[at];
                up[at] = next < j ? up[next] : next;
                at = up[at];
            }
            counts[at]--;
            leaves++;
            seen[0] = from;
            seen[1] = j;
        }
        counts[j] += leaves;
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
