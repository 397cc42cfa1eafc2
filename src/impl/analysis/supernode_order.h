/* supernode_order.h: the final order of supernodes and columns, each 2x2 pivot in one tile */
#ifndef SLI_ANALYSIS_SUPERNODE_ORDER_H
#define SLI_ANALYSIS_SUPERNODE_ORDER_H

#include "../ordering/graph.h"
#include "supernodes.h"

/* Where a supernode has so many children that are one column or a tall leaf, these follow the
 * others, by their numbers of rows below, up to SLI_SORTED_ROWS: sweeps and assembly then foresee
 * the ends of their loops. And the update matrices of leaves do not wait for the subtrees of
 * siblings: in bundle adjustment, those of all points would wait for a chain of cameras. */
#define SLI_SORTED_CHILDREN 64
#define SLI_SORTED_ROWS 255
#define SLI_SORTED_LEAF 24 /* fewest rows below a tall leaf */

/* Is supernode s, on top of a tree, sorted among its siblings? children: as below. */
SLI_INLINE int sli_is_sorted_sibling(const sli_amalgamation *g, sl_int s, sl_int children) {
    return g->width[s] == 1 || (children == 0 && g->below[s] >= SLI_SORTED_LEAF);
}

/* The order of sibling supernodes: NULL, if it is that of their numbers. top: of each supernode;
 * order: gets it; children: `count` of scratch: twice how many are sorted, and 1 if it has any. */
static const sl_int *sli_sort_siblings(const sli_amalgamation *g, const sl_int *top,
                                       const sl_int *tree, sl_int count, sl_int *children,
                                       sl_int *order) {
    sl_int begin[SLI_SORTED_ROWS + 2], s, k, pass, most = 0;
    if (count <= SLI_SORTED_CHILDREN) {
        return NULL;
    }
    SLI_ZERO(children, count);
    for (s = 0; s < count; s++) { /* children first */
        if (tree[s] != -1) {
            sl_int *up = &children[tree[s]];
            *up = (*up | 1) + 2 * sli_is_sorted_sibling(g, top[s], children[s]);
            most = sli_max(most, *up);
        }
    }
    if (most < 2 * SLI_SORTED_CHILDREN) {
        return NULL;
    }
    memset(begin, 0, sizeof begin);
    for (pass = 0; pass < 2; pass++) {
        for (s = 0; s < count; s++) {
            const int is_sorted = tree[s] != -1 &&
                                  children[tree[s]] >= 2 * SLI_SORTED_CHILDREN &&
                                  sli_is_sorted_sibling(g, top[s], children[s]);
            k = is_sorted ? sli_min(g->below[top[s]], SLI_SORTED_ROWS) : 0;
            if (pass == 0) {
                begin[k + 1]++;
            } else {
                order[begin[k]++] = s;
            }
        }
        for (k = 0; k <= SLI_SORTED_ROWS && pass == 0; k++) {
            begin[k + 1] += begin[k];
        }
    }
    return order;
}

/* Numbers the supernodes in a postorder of their tree and makes their columns consecutive: order[k]
 * = the old number of the new column k. On return the arrays of g refer to the new numbers, and
 * g->count is the number of supernodes. Returns whether columns move; if not, there is
 * no order.
 *
 * sequence: the columns in the caller's order; NULL: 0, 1, ... Sibling subtrees follow each other
 * by their last columns in the sequence, and the columns of a supernode keep its order. So a
 * sequence that is a postorder of the supernodes is kept as it is. is_postorder: the columns are
 * numbered in one. scratch: 5n. */
static int sli_number_supernodes(sli_amalgamation *g, const sl_int *sequence, int is_postorder,
                                 sl_int *order, sl_int *scratch) {
    const sl_int n = g->n;
    sl_int *super_of = g->super_of, *top = scratch, *tree = scratch + n,
           *post = scratch + 2 * (size_t)n, *at = scratch + 3 * (size_t)n,
           *number = scratch + 4 * (size_t)n;
    const sl_int count = sli_find_tops(g, sequence, top, tree, at);
    const sl_int *siblings =
        sequence == NULL ? sli_sort_siblings(g, top, tree, count, at, order) : NULL;
    sl_int s, k, column = 0, before = 0, moves = sequence != NULL;
    if (is_postorder && siblings == NULL) {
        sli_order_natural(count, post);
        number = post;
    } else {
        sli_postorder(tree, siblings, count, post, at, number);
        for (k = 0; k < count; k++) {
            number[post[k]] = k;
        }
    }
    for (k = 0; k < count; k++) {
        at[k] = column; /* where the next column of the supernode goes */
        column += g->width[top[post[k]]];
    }
    for (s = 0; s < g->count; s++) {
        g->merged_into[s] = number[g->merged_into[s]];
        moves |= g->merged_into[s] < before;
        before = g->merged_into[s];
    }
    for (k = 0; k < n && moves; k++) {
        const sl_int from = sequence == NULL ? k : sequence[k];
        order[at[g->merged_into[super_of[from]]]++] = from;
    }
    for (k = 0; k < n && !moves; k++) {
        super_of[k] = g->merged_into[super_of[k]];
    }
    /* merged_into and at are free now: they hold the sizes by new number. */
    for (k = 0; k < count; k++) {
        at[k] = g->width[top[post[k]]];
        g->merged_into[k] = g->below[top[post[k]]];
    }
    column = 0;
    for (k = 0; k < count; k++) {
        g->first[k] = column;
        g->width[k] = at[k];
        g->below[k] = g->merged_into[k];
        g->parent[k] = tree[post[k]] == -1 ? -1 : number[tree[post[k]]];
        column += at[k];
        for (s = column; moves && s > g->first[k];) {
            super_of[--s] = k;
        }
    }
    g->first[count] = n;
    g->count = count;
    return moves;
}

/* The end of the part of a supernode that begins at column `from`: a 2x2 pivot that would be in two
 * column tiles starts the next part. */
SLI_INLINE sl_int sli_part_end(const unsigned char *is_first, sl_int from, sl_int end) {
    sl_int k;
    for (k = from + SLI_TILE - 1; k < end && !is_first[k]; k += SLI_TILE) {
    }
    return sli_min(k, end);
}

/* Cuts supernodes into parts: first, below, and part, the part of each column. Returns how many. */
static sl_int sli_find_parts(const sli_amalgamation *g, const unsigned char *is_first,
                             sl_int *first, sl_int *below, sl_int *part) {
    sl_int s, k, count = 0;
    for (s = 0; s < g->count; s++) {
        for (k = g->first[s]; k < g->first[s + 1]; count++) {
            const sl_int end = sli_part_end(is_first, k, g->first[s + 1]);
            first[count] = k;
            below[count] = g->first[s + 1] - end + g->below[s];
            for (; k < end; k++) {
                part[k] = count;
            }
        }
    }
    return count;
}

/* Splits supernodes into parts so that every 2x2 pivot is in one column tile, and numbers them in a
 * postorder again: order[k] = the old number of the new column k. Each part keeps the rows of its
 * supernode, and the next part is its parent. earlier[s] := the part before s in its supernode, or
 * -1. Returns 0 if nothing is to be split. parent: the elimination tree; is_first: by column, is it
 * the first of a pair? scratch: 5n. */
static int sli_split_pairs(sli_amalgamation *g, const sl_int *parent, const unsigned char *is_first,
                           sl_int *earlier, sl_int *order, sl_int *scratch) {
    const sl_int n = g->n;
    sl_int *super_of = g->super_of, *tree = scratch, *post = tree + n, *number = post + n,
           *below = number + n;
    sl_int *first = g->merged_into; /* free now */
    const sl_int count = sli_find_parts(g, is_first, first, below, order);
    sl_int s, k, c, column = 0;
    SLI_NONE(earlier, n);
    if (count == g->count) {
        return 0;
    }
    for (s = 0; s < count; s++) {
        const sl_int end = s + 1 < count ? first[s + 1] : n, up = parent[end - 1];
        const int continues = end < n && super_of[end] == super_of[end - 1];
        tree[s] = continues ? s + 1 : up == -1 ? -1 : order[up];
    }
    sli_postorder(tree, NULL, count, post, number, below + n);
    for (k = 0; k < count; k++) {
        number[post[k]] = k;
    }
    for (k = 0; k < count; k++) {
        const sl_int end = post[k] + 1 < count ? first[post[k] + 1] : n;
        s = post[k];
        if (end < n && super_of[end] == super_of[end - 1]) {
            earlier[number[s + 1]] = k;
        }
        g->first[k] = column;
        g->width[k] = end - first[s];
        g->below[k] = below[s];
        g->parent[k] = tree[s] == -1 ? -1 : number[tree[s]];
        for (c = first[s]; c < end; c++) {
            order[column++] = c;
        }
    }
    g->first[count] = n;
    g->count = count;
    for (k = 0; k < count; k++) {
        for (c = g->first[k]; c < g->first[k + 1]; c++) {
            super_of[c] = k;
        }
    }
    return 1;
}

#endif
