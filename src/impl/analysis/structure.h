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

/* Fills the rows of all supernodes and the scatter map in one pass over the rows of L.
 *
 * Row k of L occupies the part of the supernode tree between row k's entries of A and k's own
 * supernode. k is appended to the row list of each of these supernodes; as k ascends, so do the
 * lists. The position in the list is the local row of k's entries. end: n_supers, the end of each
 * list so far; mark: n_supers. earlier: the part before each supernode if one was split, or NULL:
 * a row of one part is also a row of the parts before it.
 */
static void sli_fill_structure(sl_symbolic *S, const sli_pattern *rows, const sl_int *old_of,
                               const sl_int *new_of, const sl_int *earlier, sl_off *end,
                               sl_int *mark) {
    sl_int k, p, s, t;
    for (s = 0; s < S->n_supers; s++) {
        end[s] = S->rows_begin[s];
        mark[s] = -1;
    }
    for (k = 0; k < S->n; k++) {
        const sl_int own = S->super_of[k];
        for (t = earlier == NULL ? -1 : earlier[own]; t != -1; t = earlier[t]) {
            mark[t] = k;
            S->rows[end[t]++] = k;
        }
        for (p = rows->begin[old_of[k]]; p < rows->begin[old_of[k] + 1]; p++) {
            const sl_int i = new_of[rows->to[p]], home = S->super_of[i];
            const sl_int first = S->super_first[home], width = S->super_first[home + 1] - first;
            sl_int local;
            sl_off at;
            for (s = home; s != own && mark[s] != k; s = S->super_parent[s]) {
                for (t = s; t != -1 && mark[t] != k; t = earlier == NULL ? -1 : earlier[t]) {
                    mark[t] = k;
                    S->rows[end[t]++] = k;
                }
            }
            local = home == own ? k - first : width + (sl_int)(end[home] - S->rows_begin[home]) - 1;
            /* each begin advances to its group's end; shifted back below */
            at = S->scatter_begin[home]++;
            S->scatter_from[at] = rows->from[p];
            S->scatter_to[at] = S->panel_begin[home] + sli_panel_at(width, local, i - first);
        }
    }
    for (s = 0; s < S->n_supers; s++) {
        SLI_ASSERT(end[s] == S->rows_begin[s + 1]);
    }
    memmove(S->scatter_begin + 1, S->scatter_begin, (size_t)S->n_supers * sizeof(sl_off));
    S->scatter_begin[0] = 0;
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
