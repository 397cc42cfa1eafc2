/* check.h: is a loaded analysis or factor one that this library could have made? */
#ifndef SLI_SAVE_CHECK_H
#define SLI_SAVE_CHECK_H

#include "format.h"

/* Everything that the other parts take for granted is checked here, in one pass over each array
 * and without memory: the bytes may come from anybody. The numbers of L, D and the weights may be
 * anything. */

/* Is perm a permutation and iperm its inverse? If iperm[perm[k]] = k for all k, no two perm[k] are
 * equal. */
static int sli_check_perm(const sl_symbolic *S) {
    sl_int k;
    for (k = 0; k < S->n; k++) {
        const sl_int i = S->perm[k];
        if (i < 0 || i >= S->n || S->iperm[i] != k) {
            return 0;
        }
    }
    return 1;
}

/* Do the supernodes divide the columns, and are their trees numbered in postorder? In a postorder
 * the children of s are s - 1, then the supernode before the first descendant of s - 1, and so on.
 * Each supernode is visited from its parent once. */
SLI_HOT static int sli_check_supers(const sl_symbolic *S) {
    sl_int s, c, k = 0, children = 0, visited = 0;
    if (S->super_first[0] != 0 || S->super_first[S->n_supers] != S->n) {
        return 0;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s], first = S->first_descendant[s];
        if (S->super_first[s + 1] <= k || S->super_first[s + 1] > S->n ||
            (up != -1 && (up <= s || up >= S->n_supers)) || first < 0 || first > s) {
            return 0;
        }
        for (; k < S->super_first[s + 1]; k++) {
            if (S->super_of[k] != s) {
                return 0;
            }
        }
        children += up != -1;
        for (c = s - 1; c >= first; c = S->first_descendant[c] - 1) {
            if (S->super_parent[c] != s) {
                return 0;
            }
            visited++;
        }
        if (c != first - 1) {
            return 0;
        }
    }
    return visited == children;
}

/* Is `up` the parent of column k? It is in the supernode of k, but that of the last column is the
 * first row below, or -1. The tree is that without 2x2 pivots: these only add rows to columns. */
static int sli_check_parent(const sl_symbolic *S, sl_int k, sl_int up) {
    const sl_int s = S->super_of[k], end = S->super_first[s + 1];
    if (S->n_pairs > 0) {
        return up == -1 || (up > k && up < S->n);
    }
    if (k + 1 < end) {
        return up > k && up < end;
    }
    return up == (S->steps[s].below > 0 ? S->rows[S->rows_begin[s]] : -1);
}

/* Is the elimination tree that of the supernodes, and do the counts fit into them? */
SLI_HOT static int sli_check_tree(const sl_symbolic *S, const sli_saved_analysis *a) {
    sl_off nnz_l = 0;
    sl_int k, roots = 0;
    for (k = 0; k < S->n; k++) {
        const sl_int s = S->super_of[k], end = S->super_first[s + 1];
        if (!sli_check_parent(S, k, S->parent[k]) || S->counts[k] < 1 ||
            S->counts[k] > end - k + S->steps[s].below) {
            return 0;
        }
        roots += S->parent[k] == -1;
        nnz_l += S->counts[k];
    }
    return roots == a->components && nnz_l == a->nnz_l;
}

/* Are these rows below a supernode in the front of its parent at the local rows that are listed?
 * Both ascend, so that the columns of the parent come before the rows below it. */
static int sli_check_relative(const sl_symbolic *S, sl_int up, const sl_int *rows,
                              const sl_int *local, sl_int count) {
    const sl_int first = S->super_first[up], width = S->super_first[up + 1] - first;
    const sl_int *below = S->rows + S->rows_begin[up];
    const uint32_t n_below = (uint32_t)(S->rows_begin[up + 1] - S->rows_begin[up]);
    sl_int k;
    for (k = 0; k < count && local[k] < width; k++) {
        if (local[k] < 0 || rows[k] != first + local[k]) {
            return 0;
        }
    }
    for (; k < count; k++) {
        const uint32_t at = (uint32_t)local[k] - (uint32_t)width;
        if (at >= n_below || rows[k] != below[at]) {
            return 0;
        }
    }
    return 1;
}

/* Do the row lists, the panels and the steps agree, and is every front contained in its parent's?
 * Reads the rows of a parent, which may come later, only where their number is known to be right:
 * rows_begin is checked before. */
static int sli_check_front(const sl_symbolic *S, sl_int s) {
    const sl_int first = S->super_first[s], end = S->super_first[s + 1], up = S->super_parent[s];
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sli_step *step = &S->steps[s];
    sl_int k, last = end - 1, ascend = 1;
    if (step->panel != S->panel_begin[s] || step->column != first || step->base != first ||
        step->width != end - first || step->first_tile != 0 || step->up != up ||
        step->below != S->rows_begin[s + 1] - S->rows_begin[s] ||
        (step->below == 0) != (up == -1)) {
        return 0;
    }
    if (up == -1) {
        return 1;
    }
    for (k = 0; k < step->below; k++) {
        ascend &= rows[k] > last;
        last = rows[k];
    }
    return ascend && last < S->n && S->super_of[rows[0]] == up &&
           sli_check_relative(S, up, rows, S->relative + S->rows_begin[s], step->below);
}

/* The doubles from the panel of supernode s to the next one. In files of earlier versions panels of
 * one column have padding. */
static sl_off sli_check_panel(const sl_symbolic *S, sl_int s, sl_int width, sl_off below) {
    const sl_off begin = S->panel_begin[s], end = begin + sli_panel_size(width, (sl_int)below);
    const int is_last = s + 1 == S->n_supers;
    const sl_int next = is_last ? 1 : S->super_first[s + 2] - S->super_first[s + 1];
    const sl_off padded = sli_tile_offset(width, sli_tiles(width + (sl_int)below));
    return begin % SLI_TILE == 0 && S->panel_begin[s + 1] == begin + padded
               ? padded
               : sli_panel_start(next, end) - begin;
}

SLI_HOT static int sli_check_structure(const sl_symbolic *S) {
    sl_int s, tallest = 0, widest = 0;
    if (S->rows_begin[0] != 0 || S->panel_begin[0] != 0) {
        return 0;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_int width = S->super_first[s + 1] - S->super_first[s];
        sl_off below;
        if (S->rows_begin[s + 1] < S->rows_begin[s]) { /* a difference could overflow */
            return 0;
        }
        below = S->rows_begin[s + 1] - S->rows_begin[s];
        if (below > S->n - S->super_first[s + 1] ||
            S->panel_begin[s + 1] != S->panel_begin[s] + sli_check_panel(S, s, width, below)) {
            return 0;
        }
        widest = sli_max(widest, width);
        tallest = sli_max(tallest, width + (sl_int)below);
    }
    for (s = 0; s < S->n_supers; s++) {
        if (!sli_check_front(S, s)) {
            return 0;
        }
    }
    return tallest == S->tallest && widest == S->widest;
}

/* Do the entries of A that belong to a panel of this width and height go to entries of L, with
 * ascending rows? */
static int sli_check_scatter_panel(const sl_symbolic *S, sl_int s, sl_int width, sl_int height) {
    const uint64_t size = (uint64_t)(S->panel_begin[s + 1] - S->panel_begin[s]);
    const uint32_t n_from = (uint32_t)S->nnz_input;
    uint64_t begin = 0, end = (uint64_t)sli_tile_offset(width, 1); /* of the tile */
    uint32_t tile = 0, last = 0;
    int wrong = 0;
    sl_off m;
    for (m = S->scatter_begin[s]; m < S->scatter_begin[s + 1]; m++) {
        const uint64_t at = (uint64_t)S->scatter_to[m] - (uint64_t)S->panel_begin[s];
        uint32_t row, column;
        if (at >= size) {
            return 0;
        }
        while (at >= end) {
            tile++;
            begin = end;
            end = (uint64_t)sli_tile_offset(width, (sl_int)tile + 1);
        }
        row = SLI_TILE * tile + (uint32_t)(at % SLI_TILE);
        column = (uint32_t)((at - begin) / SLI_TILE);
        wrong |= (int)((uint32_t)S->scatter_from[m] >= n_from) | (int)(at < begin) |
                 (int)(row < last) | (int)(row >= (uint32_t)height) | (int)(row < column);
        last = row;
    }
    return !wrong;
}

/* Does the scatter map go from entries of A to entries of L, with the rows of each supernode
 * ascending? */
SLI_HOT static int sli_check_scatter(const sl_symbolic *S) {
    sl_int s;
    if (S->scatter_begin[0] != 0) {
        return 0;
    }
    for (s = 0; s < S->n_supers; s++) {
        if (S->scatter_begin[s + 1] < S->scatter_begin[s] ||
            S->scatter_begin[s + 1] > S->scatter_begin[S->n_supers] ||
            !sli_check_scatter_panel(S, s, S->steps[s].width,
                                     S->steps[s].width + S->steps[s].below)) {
            return 0;
        }
    }
    return 1;
}

static int sli_check_nodes(const sl_symbolic *S) {
    sl_int k;
    for (k = 0; k < S->n && S->n_nodes > 0; k++) {
        if (S->node_of[k] < 0 || S->node_of[k] >= S->n_nodes) {
            return 0;
        }
    }
    for (k = S->n_nodes - 1; k >= 0; k--) {
        const sl_int up = S->node_parent[k];
        if (up != -1 && (up <= k || up >= S->n_nodes)) {
            return 0;
        }
        if (S->node_level[k] != (up == -1 ? 0 : S->node_level[up] + 1)) {
            return 0;
        }
    }
    return 1;
}

/* Are the 2x2 pivots two columns of one supernode and of one tile? */
static int sli_check_pairs(const sl_symbolic *S) {
    sl_int k, count = 0;
    for (k = 0; k < S->n && S->n_pairs > 0; k++) {
        const sl_int s = S->super_of[k];
        if (S->pairs[k] == SLI_PAIR_NONE) {
            continue;
        }
        if (S->pairs[k] != SLI_PAIR_FIRST || (k - S->super_first[s]) % SLI_TILE == SLI_TILE - 1 ||
            k + 1 == S->super_first[s + 1] || S->pairs[k + 1] != SLI_PAIR_SECOND) {
            return 0;
        }
        count++;
        k++;
    }
    return count == S->n_pairs;
}

static int sli_check_analysis(const sl_symbolic *S, const sli_saved_analysis *a) {
    sl_symbolic same;
    if (!sli_check_perm(S) || !sli_check_supers(S) || !sli_check_structure(S) ||
        !sli_check_tree(S, a) || !sli_check_scatter(S) || !sli_check_pairs(S) ||
        !sli_check_nodes(S)) {
        return 0;
    }
    same = *S;
    sli_fill_identity(&same, S->stats.symbolic.triangle);
    return sli_hash_equals(same.identity, S->identity);
}

/* Are these ascending columns? */
static int sli_check_columns(const sl_int *columns, sl_off count, sl_int n) {
    sl_off k;
    for (k = 0; k < count; k++) {
        if (columns[k] < (k > 0 ? columns[k - 1] + 1 : 0) || columns[k] >= n) {
            return 0;
        }
    }
    return 1;
}

/* Are the anchors null pivots, at most one in a tree? */
static int sli_check_anchors(const sl_factor *F) {
    const sl_symbolic *S = F->S;
    sl_int k, m = 0;
    if (!sli_check_columns(F->null.anchors, F->null.n_anchors, S->n)) {
        return 0;
    }
    for (k = 0; k < S->n && m < F->null.n_anchors; k++) {
        if (S->parent[k] == -1) {
            m += F->null.anchors[m] <= k; /* it comes after the root before k */
            if (m < F->null.n_anchors && F->null.anchors[m] <= k) {
                return 0;
            }
        }
    }
    for (m = 0; m < F->null.n_anchors; m++) {
        const sl_int at = sli_lower_bound(F->null.pivots, F->null.count, F->null.anchors[m]);
        if (at == F->null.count || F->null.pivots[at] != F->null.anchors[m]) {
            return 0;
        }
    }
    return 1;
}

/* Is what each supernode contributes to pivot growth that of one of its pivots? */
static int sli_check_extents(const sl_factor *F) {
    const sl_symbolic *S = F->S;
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        const sli_extent *e = &F->extents[s];
        const sl_int least = e->magnitude > 0.0 ? S->super_first[s] : -1,
                     most = e->magnitude > 0.0 ? S->super_first[s + 1] - 1 : -1;
        if (!(e->entry >= 0.0) || !sli_is_finite(e->entry) || !(e->magnitude >= 0.0) ||
            e->pivot < least || e->pivot > most || e->suspects != 0) {
            return 0;
        }
    }
    return 1;
}

/* Are the blocks of 2x2 pivots finite, and 0 elsewhere? */
static int sli_check_blocks(const sl_factor *F) {
    sl_int k;
    for (k = 0; k < F->S->n && F->E != NULL; k++) {
        if (F->S->pairs[k] == SLI_PAIR_FIRST ? !sli_is_finite(F->E[k]) : F->E[k] != 0.0) {
            return 0;
        }
    }
    return 1;
}

/* Do the pivots have the counted signs, and is each null or regularized one listed? 2x2 pivots have
 * any signs: those of their eigenvalues depend on rounding if one is almost 0. */
SLI_HOT static int sli_check_factor(const sl_factor *F) {
    const sl_factor_info *info = &F->stats.factor;
    const sl_int n = F->S->n;
    sl_int k, positive = 0, negative = 0, nulls = 0, shifted = 0, blocks = 0;
    if (!sli_check_columns(F->null.pivots, F->null.count, n) ||
        !sli_check_columns(F->rule.regularized, info->regularized, n) ||
        (F->null.is_centered && !sli_check_anchors(F)) || !sli_check_extents(F) ||
        !sli_check_blocks(F)) {
        return 0;
    }
    for (k = 0; k < n; k++) {
        const double d = F->D[k];
        if (!sli_is_finite(d)) {
            return 0;
        }
        if (F->null.mode == SL_PIVOTS_SKIP_NULL &&
            (F->rule.kinds[k] < SLI_PIVOT_UNKNOWN || F->rule.kinds[k] > SLI_PIVOT_WEAK ||
             (F->null.vectors == 1 && F->null.g[k] != 0.0 && F->null.g[k] != F->null.z[k]))) {
            return 0;
        }
        if (sli_is_skipped(F, k)) {
            if (nulls == F->null.count || F->null.pivots[nulls++] != k) {
                return 0;
            }
            continue;
        }
        if (sli_is_regularized(F, k) &&
            (shifted == info->regularized || F->rule.regularized[shifted++] != k)) {
            return 0;
        }
        if (F->E != NULL && F->S->pairs[k] != SLI_PAIR_NONE) {
            blocks++;
        } else {
            positive += d > 0.0;
            negative += d < 0.0;
        }
    }
    for (k = 0; k < n && F->rule.regularization != 0.0 && F->rule.signs != NULL; k++) {
        if (F->rule.signs[k] < -1 || F->rule.signs[k] > 1) {
            return 0;
        }
    }
    return nulls == F->null.count && shifted == info->regularized && info->positive >= positive &&
           info->negative >= negative &&
           info->positive - positive + (info->negative - negative) <= blocks;
}

#endif
