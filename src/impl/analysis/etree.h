/* etree.h: elimination tree, and renumbering of the columns */
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

/* The same tree, and counts[j] := entries of column j of L, diagonal included: the subtree of each
 * row is walked as a whole. Where columns of L are short, this takes less time than what is nearly
 * linear in the entries of A. mark: n of scratch. [LDL05] */
static void sli_etree_and_counts(sl_int n, const sli_pattern *rows, sl_int *parent, sl_int *counts,
                                 sl_int *mark) {
    sl_int k, i, p = 0;
    for (k = 0; k < n; k++) {
        parent[k] = -1;
        counts[k] = 1;
        mark[k] = k;
        for (; p < rows->begin[k + 1]; p++) {
            for (i = rows->to[p]; mark[i] != k; i = parent[i]) {
                parent[i] = parent[i] == -1 ? k : parent[i];
                mark[i] = k;
                counts[i]++;
            }
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
    memcpy(old_of, fresh, (size_t)n * sizeof(sl_int));
    for (k = 0; k < n; k++) {
        const sl_int old = parent[order[k]];
        new_of[old_of[k]] = k;
        fresh[k] = old == -1 ? -1 : number[old];
    }
    memcpy(parent, fresh, (size_t)n * sizeof(sl_int));
}

#endif
