/* supernodes.h: fundamental supernodes, and relaxed amalgamation over the whole assembly tree */
#ifndef SLI_ANALYSIS_SUPERNODES_H
#define SLI_ANALYSIS_SUPERNODES_H

#include "etree.h"
#include "../base/sort.h"
#include "../kernels/panel.h"

/* Supernodes during amalgamation; all arrays have n entries. A merged supernode is identified by
 * the fundamental supernode on its top. */
typedef struct sli_amalgamation {
    sl_int n;         /* columns */
    sl_int count;     /* fundamental supernodes */
    sl_int *super_of; /* the supernode of each column */
    sl_int *first;    /* n + 1: first column of each */
    sl_int *parent;   /* parent supernode, -1 at a root */
    sl_int *width;    /* columns so far */
    sl_int *below;    /* rows below */
    sl_off *zeros;    /* entries stored so far that L does not have */
    sl_off *cost;     /* of what solves read, so far */
    sl_int *apart;    /* the cost of its columns if they are not merged; INT32_MAX: they must be */
    sl_int *merged_into; /* the supernode it was merged into, or itself; finally the new number */
    /* 1: always merged into its parent, as its last column and the next one are a 2x2 pivot; NULL:
     * none */
    unsigned char *is_tied;
    int merges;            /* by sli_amalgamate */
    int relaxes;           /* merge others too */
    int is_for_one_factor; /* by the costs of SL_PURPOSE_ONE_FACTOR */
    int is_large;          /* L has SLI_LARGE_ENTRIES, in columns of few in the mean */
} sli_amalgamation;

/* other[k] := a child of k but k - 1, or -1. */
static void sli_find_other_children(sl_int n, const sl_int *parent, sl_int *other) {
    sl_int k;
    SLI_NONE(other, n);
    for (k = 0; k < n; k++) {
        if (parent[k] != -1 && parent[k] != k + 1) {
            other[parent[k]] = k;
        }
    }
}

/* Largest percentage of zeros in a supernode. On a path it reaches 28 of 44 entries, 64 %, and 2D
 * grids have no more. It bounds the stored entries of each supernode by 1 / (1 - 0.70) = 3.34 times
 * its entries of L, even where short columns are children of tall ones. */
#define SLI_ZEROS_MOST 70

/* From so many entries of L on, memory limits solves. Where columns have few entries in the mean,
 * as in paths, networks and control problems, supernodes then have fewer zeros, least of all those
 * of single columns, which cost little, and short columns are kept apart where that costs less,
 * even if they are not plain. On a path a solve takes half of the time; meshes gain nothing. */
#define SLI_LARGE_ENTRIES 200000
#define SLI_LARGE_COLUMN 16
#define SLI_ZEROS_MOST_LARGE 40
#define SLI_ZEROS_MOST_COLUMN 25

/* Finds the fundamental supernodes: runs of columns with the same structure, each the only child of
 * the next. The column count falls by one along a run. splits: roots of two columns are two
 * supernodes. Returns the number of supernodes. */
static sl_int sli_fundamental_find(sli_amalgamation *g, const sl_int *parent, const sl_int *counts,
                                   const sl_int *other, int splits) {
    const sl_int n = g->n;
    sl_off entries = 0;
    sl_int j, s = -1;
    g->first[0] = 0;
    for (j = 0; j < n; j++) { /* without branches, which nothing would predict */
        const sl_int last = j - (j > 0);
        int starts = (parent[last] ^ j) | (other[j] + 1) | (counts[last] ^ (counts[j] + 1));
        if (splits) { /* otherwise it would wait for the store of the column before */
            starts |= (counts[j] == 1) & (g->first[s + (s < 0)] == last);
        }
        g->first[s + 1] = j;
        s += starts != 0;
        g->super_of[j] = s;
        entries += counts[j];
    }
    g->first[s + 1] = n;
    g->is_large = entries >= SLI_LARGE_ENTRIES && entries < SLI_LARGE_COLUMN * (sl_off)n;
    return s + 1;
}

/* Fills g with the fundamental supernodes. other: by sli_find_other_children. Roots of two columns
 * may be better apart. Without a supernode of an odd number of columns the matrix may be complex,
 * and keeps its pairs of columns. */
static void sli_fundamental(sli_amalgamation *g, const sl_int *parent, const sl_int *counts,
                            const sl_int *other) {
    sl_int s, count = sli_fundamental_find(g, parent, counts, other, 0);
    int has_odd = 0, has_pair = 0;
    for (s = 0; s < count && g->relaxes; s++) {
        const sl_int width = g->first[s + 1] - g->first[s];
        has_odd |= width & 1;
        has_pair |= (width == 2) & (counts[g->first[s]] == 2);
    }
    if (has_odd && has_pair) {
        count = sli_fundamental_find(g, parent, counts, other, 1);
    }
    g->count = count;
    for (s = 0; s < count; s++) {
        const sl_int last = g->first[s + 1] - 1;
        g->width[s] = g->first[s + 1] - g->first[s];
        g->below[s] = counts[last] - 1;
        g->parent[s] = parent[last] == -1 ? -1 : g->super_of[parent[last]];
        g->zeros[s] = 0;
        g->merged_into[s] = s;
    }
}

/* The largest percentage of zeros in a supernode that child c is merged into. */
SLI_INLINE sl_off sli_zeros_most(const sli_amalgamation *g, sl_int c) {
    return !g->is_large       ? SLI_ZEROS_MOST
           : g->width[c] == 1 ? SLI_ZEROS_MOST_COLUMN
                              : SLI_ZEROS_MOST_LARGE;
}

/* What a solve spends on a supernode besides reading its panel, in the entries that it reads in the
 * same time: for each row below, for each supernode, and for one of more than 8 columns, which the
 * kernels of small supernodes do not take. Fitted to solves and factorizations on 2D and 3D grids
 * and KKT systems. For one factor, fewer fronts count more than fewer entries. */
#define SLI_COST_ROW 4
#define SLI_COST_SUPER 100
#define SLI_COST_WIDE 200
#define SLI_COST_SUPER_ONE_FACTOR 140
#define SLI_COST_WIDE_ONE_FACTOR 100

/* Integers, so that all platforms merge alike. */
SLI_ALWAYS_INLINE sl_off sli_supernode_cost(const sli_amalgamation *g, sl_int width, sl_int below) {
    return sli_tile_offset(width, sli_tiles(width + below)) + SLI_COST_ROW * (sl_off)below +
           (g->is_for_one_factor ? SLI_COST_SUPER_ONE_FACTOR : SLI_COST_SUPER) +
           (width <= SLI_TILE      ? 0
            : g->is_for_one_factor ? SLI_COST_WIDE_ONE_FACTOR
                                   : SLI_COST_WIDE);
}

/* What a solve spends on a column that is a supernode by itself, in the same measure: its kernels
 * are those of a sparse column. In a large L it is more if the column before has another number of
 * rows below, as nothing predicts the ends of its loops. */
#define SLI_COST_PLAIN 12
#define SLI_COST_PLAIN_ROW 7
#define SLI_COST_TURN 30

/* The cost of column s by itself, if it may be: if it is plain (schedule_types.h) or, in a large L,
 * so short that it is factored in scalars (fronts.inl.h). child: of s */
static sl_int sli_apart_cost(const sli_amalgamation *g, sl_int s, const sl_int *child,
                             const sl_int *sibling) {
    sl_int c = g->is_large && g->below[s] < SLI_TILE ? -1 : child[s];
    while (c != -1 && g->below[c] == 1) {
        c = sibling[c];
    }
    if (c != -1 || g->width[s] > 1 || g->below[s] >= INT32_MAX / 16) {
        return INT32_MAX;
    }
    return SLI_COST_PLAIN + SLI_COST_PLAIN_ROW * g->below[s] +
           (g->is_large && s > 0 && g->below[s - 1] != g->below[s] ? SLI_COST_TURN : 0);
}

/* The zeros added by merging child c into p: the columns of c grow to the rows of p. */
static sl_off sli_new_zeros(const sli_amalgamation *g, sl_int c, sl_int p) {
    return (sl_off)g->width[c] * (g->width[p] + g->below[p] - g->below[c]);
}

/* For one factor, trees and chains with one row below are cut where they fill a row tile: 7 columns
 * in one tile take 0.8 of the time of 10 in two, for each column, and solves 0.7. */
SLI_INLINE int sli_overfills_tile(const sli_amalgamation *g, sl_int c, sl_int p) {
    return g->is_for_one_factor && g->below[c] == 1 && g->below[p] == 1 &&
           sli_max(g->width[c], g->width[p]) == SLI_TILE - 1;
}

/* Merges child c into p if that pays. cost: that of p so far. */
SLI_INLINE void sli_amalgamate_child(sli_amalgamation *g, sl_int p, sl_int c, sl_off *cost) {
    const sl_int below = g->below[p], width = g->width[c] + g->width[p];
    const sl_off zeros = g->zeros[c] + g->zeros[p] + sli_new_zeros(g, c, p);
    const sl_off stored = (sl_off)width * (width + 1) / 2 + (sl_off)width * below;
    const sl_off merged = sli_supernode_cost(g, width, below);
    const int is_tied = g->is_tied != NULL && g->is_tied[c];
    if (is_tied || (g->relaxes && 100 * zeros <= sli_zeros_most(g, c) * stored &&
                    merged <= g->cost[c] + *cost && !sli_overfills_tile(g, c, p))) {
        g->width[p] = width;
        g->zeros[p] = zeros;
        g->merged_into[c] = p;
        g->apart[p] = is_tied || g->apart[c] > INT32_MAX - g->apart[p] ? INT32_MAX
                                                                       : g->apart[p] + g->apart[c];
        *cost = merged;
    }
}

/* Amalgamates bottom up: each supernode merges children, which come before it, those with the
 * fewest new zeros first. child, sibling: lists of children; list, scratch: room for all
 * supernodes. */
static void sli_amalgamate(sli_amalgamation *g, sl_int *child, sl_int *sibling, uint64_t *list,
                           uint64_t *scratch) {
    sl_int s, c, k, count;
    SLI_NONE(child, g->count);
    for (s = 0; s < g->count; s++) {
        const sl_int up = g->parent[s];
        sl_off cost;
        if (child[s] == -1 && up == -1) { /* stays as it is */
            g->apart[s] = INT32_MAX;
            continue;
        }
        count = 0;
        cost = sli_supernode_cost(g, g->width[s], g->below[s]);
        g->apart[s] = sli_apart_cost(g, s, child, sibling);
        for (c = child[s]; c != -1; c = sibling[c]) {
            const sl_off zeros = sli_new_zeros(g, c, s);
            list[count++] =
                sli_keyed(zeros < INT32_MAX ? (sl_int)zeros : INT32_MAX, c); /* untested: 2^31 */
        }
        if (count > 1) {
            sli_sort(list, count, scratch);
        }
        for (k = 0; k < count; k++) {
            sli_amalgamate_child(g, s, sli_value(list[k]), &cost);
        }
        g->cost[s] = cost;
        if (up != -1) {
            sibling[s] = child[up];
            child[up] = s;
        }
    }
}

/* Finds the supernodes after amalgamation: top[k] := the fundamental supernode on top of the k-th,
 * tree[k] := its parent, merged_into[s] := the k that s now belongs to. Returns their number.
 * sequence: the columns in the order that numbers the supernodes, by their last columns; NULL: 0,
 * 1, ... number: n of scratch. */
static sl_int sli_find_tops(sli_amalgamation *g, const sl_int *sequence, sl_int *top, sl_int *tree,
                            sl_int *number) {
    sl_int s, k, count = 0;
    for (s = g->count - 1; s >= 0; s--) { /* parents first, so that theirs is final */
        g->merged_into[s] = g->merged_into[g->merged_into[s]];
    }
    for (s = g->count - 1; s >= 0 && g->merges; s--) { /* columns that are better apart */
        const sl_int to = g->merged_into[s];
        if (g->apart[to] < INT32_MAX && g->apart[to] < g->cost[to]) {
            g->merged_into[s] = s;
            g->width[s] = 1;
        }
    }
    for (s = 0; s < g->count && sequence == NULL; s++) { /* without a branch */
        top[count] = s;
        number[s] = count;
        count += g->merged_into[s] == s;
    }
    for (k = 0; k < g->n && sequence != NULL; k++) {
        s = g->super_of[sequence[k]];
        if (g->merged_into[s] == s && sequence[k] == g->first[s + 1] - 1) {
            number[s] = count;
            top[count++] = s;
        }
    }
    for (k = 0; k < count; k++) {
        const sl_int up = g->parent[top[k]];
        tree[k] = up == -1 ? -1 : number[g->merged_into[up]];
    }
    for (s = 0; s < g->count; s++) {
        g->merged_into[s] = number[g->merged_into[s]];
    }
    return count;
}

#endif
