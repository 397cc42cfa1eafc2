/* structure.h: rows of the supernodes, relative indices, and the scatter map of A into L */
#ifndef SLI_ANALYSIS_STRUCTURE_H
#define SLI_ANALYSIS_STRUCTURE_H

#include "symbolic_types.h"

/* scatter_begin := sums of the numbers of entries of A in each supernode's columns. */
static void sli_scatter_map_count(sl_symbolic *S, const sli_pattern *columns,
                                  const sl_int *old_of) {
    sl_int s, k = 0;
    sl_off total = 0;
    for (s = 0; s < S->n_supers; s++) {
        S->scatter_begin[s] = total;
        for (; k < S->super_first[s + 1]; k++) {
            total += columns->begin[old_of[k] + 1] - columns->begin[old_of[k]];
        }
    }
    S->scatter_begin[S->n_supers] = total;
}

/* A supernode while rows of L are added to it. */
typedef struct sli_growing {
    sl_off base;  /* rows and relative have local row r at base + r */
    sl_off panel; /* where tile 0 would be in L if all tiles had all columns */
    sl_off to;    /* the next position in the scatter map */
    sl_int width;
    sl_int local;  /* local rows so far: the columns, then the rows below */
    sl_int mark;   /* the last row that was added */
    sl_int parent; /* -1 at a root */
} sli_growing;

/* Adds row k to supernode s unless it is there, and s to a queue if not. Without a branch, which
 * nothing would predict. Returns the length of the queue. */
SLI_ALWAYS_INLINE sl_int sli_grow(sli_growing *g, sl_int s, sl_int k, sl_int *queue,
                                  sl_int length) {
    const int is_new = g[s].mark != k;
    g[s].mark = k;
    g[s].local += is_new;
    queue[length] = s;
    return length + is_new;
}

/* Fills the rows of all supernodes, their relative indices and the scatter map in one pass over the
 * rows of L.
 *
 * Row k of L occupies the part of the supernode tree between row k's entries of A and k's own
 * supernode. k is appended to the row list of each of these supernodes; as k ascends, so do the
 * lists. The position in the list is the local row of k's entries. g: n_supers; queue: n + 1.
 * earlier: the part before each supernode if one was split, or NULL: a row of one part is also a
 * row of the parts before it.
 */
static void sli_fill_structure(sl_symbolic *S, const sli_pattern *rows, const sl_int *old_of,
                               const sl_int *new_of, const sl_int *earlier, sli_growing *g,
                               sl_int *queue) {
    const sl_int *super_of = S->super_of, *super_first = S->super_first;
    sl_int *scatter_from = S->scatter_from, k, p, s;
    sl_off *scatter_to = S->scatter_to;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int width = super_first[s + 1] - super_first[s];
        g[s].base = S->rows_begin[s] - width;
        g[s].panel = S->panel_begin[s] + sli_tile_offset(width, width / SLI_TILE) -
                     (sl_off)width / SLI_TILE * SLI_TILE * width;
        g[s].to = S->scatter_begin[s];
        g[s].width = width;
        g[s].local = 0;
        g[s].mark = -1;
        g[s].parent = S->super_parent[s];
    }
    for (k = 0; k < S->n; k++) {
        const sl_int own = super_of[k], end = rows->begin[old_of[k] + 1];
        const sl_off at = S->panel_begin[own] + sli_panel_at(g[own].width, g[own].local, 0);
        sl_int length = sli_grow(g, own, k, queue, 0), c;
        for (p = rows->begin[old_of[k]]; p < end; p++) {
            const sl_int i = new_of[rows->to[p]];
            sli_growing *home = &g[super_of[i]];
            sl_off row;
            length = sli_grow(g, super_of[i], k, queue, length);
            row = home->local - 1;
            row = home->panel + (row & -SLI_TILE) * home->width + (row & (SLI_TILE - 1));
            scatter_from[home->to] = rows->from[p];
            scatter_to[home->to++] =
                (super_of[i] == own ? at : row) + SLI_TILE * (i - super_first[super_of[i]]);
        }
        if (earlier != NULL && earlier[own] != -1) {
            length = sli_grow(g, earlier[own], k, queue, length);
        }
        for (c = 1; c < length; c++) {
            const sl_int up = g[queue[c]].parent;
            const sl_off row = g[queue[c]].base + g[queue[c]].local - 1;
            if (earlier != NULL && earlier[queue[c]] != -1) {
                length = sli_grow(g, earlier[queue[c]], k, queue, length);
            }
            length = sli_grow(g, up, k, queue, length);
            S->rows[row] = k;
            S->relative[row] = g[up].local - 1;
        }
    }
    for (s = 0; s < S->n_supers; s++) {
        SLI_ASSERT(g[s].base + g[s].local == S->rows_begin[s + 1]);
    }
}

/* Fills the steps of a sweep over all supernodes: the vector has all n columns, so that `base` is
 * the column. */
static void sli_fill_steps(sl_symbolic *S) {
    sl_int s;
    S->tallest = 0;
    S->widest = 0;
    for (s = 0; s < S->n_supers; s++) {
        sli_step *step = &S->steps[s];
        step->panel = S->panel_begin[s];
        step->column = S->super_first[s];
        step->base = S->super_first[s];
        step->width = S->super_first[s + 1] - S->super_first[s];
        step->below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
        step->first_tile = 0;
        step->up = S->super_parent[s];
        S->widest = sli_max(S->widest, step->width);
        S->tallest = sli_max(S->tallest, step->width + step->below);
    }
}

/* Fills first_descendant. As supernodes are in postorder, the children of s are s - 1, then the
 * supernode before the first descendant of s - 1, and so on, down to the first descendant of s. */
static void sli_fill_descendants(sl_symbolic *S) {
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        S->first_descendant[s] = s;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s];
        if (up != -1) {
            S->first_descendant[up] = sli_min(S->first_descendant[up], S->first_descendant[s]);
        }
    }
}

/* Fills the relative indices of all supernodes in their parents' fronts. local: n of scratch. */
static void sli_fill_relative(sl_symbolic *S, sl_int *local) {
    sl_int s, c;
    sl_off at;
    for (s = 0; s < S->n_supers; s++) {
        for (c = S->super_first[s]; c < S->super_first[s + 1]; c++) {
            local[c] = c - S->super_first[s];
        }
        for (at = S->rows_begin[s]; at < S->rows_begin[s + 1]; at++) {
            local[S->rows[at]] = S->steps[s].width + (sl_int)(at - S->rows_begin[s]);
        }
        for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
            for (at = S->rows_begin[c]; at < S->rows_begin[c + 1]; at++) {
                S->relative[at] = local[S->rows[at]];
            }
        }
    }
}

/* The last row tile of supernode s. */
SLI_INLINE sl_int sli_last_tile(const sl_symbolic *S, sl_int s) {
    return sli_tiles(S->steps[s].width + S->steps[s].below) - 1;
}

/* Finds the pivots k >= j such that entry m of the scatter map goes to L(k, j). m belongs to
 * supernode s. tile: where to start, the row tile of m or a later one; set to the tile of m. Within
 * a supernode the rows ascend along the map: a backward pass that starts with the last tile visits
 * each tile once. */
static void sli_scatter_map_pivots(const sl_symbolic *S, sl_int s, sl_off m, sl_int *tile,
                                   sl_int *k, sl_int *j) {
    const sl_int first = S->super_first[s], w = S->steps[s].width;
    sl_off in_tile = S->scatter_to[m] - S->panel_begin[s];
    sl_int local;
    while (sli_tile_offset(w, *tile) > in_tile) {
        --*tile;
    }
    in_tile -= sli_tile_offset(w, *tile);
    local = SLI_TILE * *tile + (sl_int)(in_tile % SLI_TILE);
    *j = first + (sl_int)(in_tile / SLI_TILE);
    *k = local < w ? first + local : S->rows[S->rows_begin[s] + local - w];
    SLI_ASSERT(S->panel_begin[s] + sli_panel_at(w, local, *j - first) == S->scatter_to[m]);
}

#endif
