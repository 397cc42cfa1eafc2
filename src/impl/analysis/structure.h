/* structure.h: rows of the supernodes, relative indices, and the scatter map of A into L */
#ifndef SLI_ANALYSIS_STRUCTURE_H
#define SLI_ANALYSIS_STRUCTURE_H

#include "pattern.h"

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

/* Fills what the rows of L in supernodes first .. last contribute.
 *
 * Row k of L occupies the part of the supernode tree between row k's entries of A and k's own
 * supernode. k is appended to the row list of each of these supernodes; as k ascends, so do the
 * lists. The position in the list is the local row of k's entries. A row of one part of a supernode
 * that was split is also a row of the parts before it. */
static void sli_structure_rows(const sli_analysis *w, sl_int first, sl_int last, sl_int *queue) {
    const sl_symbolic *S = w->S;
    const sl_int *super_of = S->super_of, *super_first = S->super_first, *earlier = w->earlier;
    const sl_int *begin = w->rows.begin, *to = w->rows.to, *new_of = w->new_of;
    sli_growing *g = w->growing;
    sl_int own, k, p;
    for (own = first; own <= last; own++) {
        const sl_int width = g[own].width;
        sl_off at = 0; /* where row k and column 0 would be in L */
        for (k = super_first[own]; k < super_first[own + 1]; k++) {
            const sl_int old = w->old_of[k], r = k - super_first[own];
            sl_int length = 1, c;
            at = r % SLI_TILE > 0 ? at + 1
                                  : S->panel_begin[own] + sli_panel_at(width, r, 0) -
                                        SLI_TILE * (sl_off)super_first[own];
            queue[0] = own;
            g[own].mark = k;
            g[own].local = r + 1;
            for (p = begin[old]; p < begin[old + 1]; p++) {
                const sl_int i = new_of[to[p]], s = super_of[i];
                sli_growing *home = &g[s];
                sl_off row;
                length = sli_grow(g, s, k, queue, length);
                row = home->local - 1;
                row = home->panel + (row & -SLI_TILE) * home->width + (row & (SLI_TILE - 1));
                S->scatter_from[home->to] = w->rows.from[p];
                S->scatter_to[home->to++] = (s == own ? at : row) + SLI_TILE * (sl_off)i;
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
    }
}

/* The rows and entries of supernodes first .. last. */
SLI_INLINE sl_off sli_structure_size(const sl_symbolic *S, sl_int first, sl_int last) {
    return S->rows_begin[last + 1] - S->rows_begin[first] + S->scatter_begin[last + 1] -
           S->scatter_begin[first];
}

/* Finds runs: each of whole subtrees, a quarter of a worker's share at most. */
static void sli_structure_divide(sli_analysis *w) {
    const sl_symbolic *S = w->S;
    const sl_off most = sli_structure_size(S, 0, S->n_supers - 1) / (4 * (sl_off)w->workers);
    sl_int s = S->n_supers - 1, last = -1; /* of the run under way */
    while (s >= 0) {
        const sl_int first = S->first_descendant[s];
        if (sli_structure_size(S, first, s) > most) {
            last = -1;
            s--;
            continue;
        }
        if (last == -1 || sli_structure_size(S, first, last) > most) {
            if (w->n_runs == SLI_ANALYSIS_RUNS) {
                return;
            }
            last = w->last[w->n_runs++] = s;
        }
        w->first[w->n_runs - 1] = first;
        s = first - 1;
    }
}

static void sli_structure_item(void *data, sl_int item, sl_int worker) {
    const sli_analysis *w = (const sli_analysis *)data;
    (void)worker;
    sli_structure_rows(w, w->first[item], w->last[item],
                       w->scratch + w->first[item] + w->n_runs - item);
}

/* Fills the rows of all supernodes, their relative indices and the scatter map in one pass over the
 * rows of L: subtrees by the team, which needs first_descendant, then the rest. scratch holds the
 * queues. Each has one element more than its run has supernodes. */
static void sli_fill_structure(sli_analysis *w, sl_symbolic *S, sli_team *team) {
    sl_int s, next = 0;
    sli_scatter_map_count(S, &w->columns, w->old_of);
    w->S = S;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int width = S->super_first[s + 1] - S->super_first[s];
        sli_growing *g = &w->growing[s];
        g->base = S->rows_begin[s] - width;
        g->panel = S->panel_begin[s] + sli_tile_offset(width, width / SLI_TILE) -
                   (sl_off)width / SLI_TILE * SLI_TILE * width -
                   SLI_TILE * (sl_off)S->super_first[s];
        g->to = S->scatter_begin[s];
        g->width = width;
        g->local = 0;
        g->mark = -1;
        g->parent = S->super_parent[s];
    }
    w->n_runs = 0;
    if (w->workers > 1) {
        sli_structure_divide(w);
        sli_team_loop(team, w->n_runs, NULL, sli_structure_item, w);
    }
    for (; w->n_runs > 0; w->n_runs--) {
        sli_structure_rows(w, next, w->first[w->n_runs - 1] - 1, w->scratch);
        next = w->last[w->n_runs - 1] + 1;
    }
    sli_structure_rows(w, next, S->n_supers - 1, w->scratch);
    for (s = 0; s < S->n_supers; s++) {
        SLI_ASSERT(w->growing[s].base + w->growing[s].local == S->rows_begin[s + 1]);
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
