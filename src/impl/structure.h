/* structure.h: the rows of every supernode, the places of the panels, and the map of A into L */
#ifndef SLI_STRUCTURE_H
#define SLI_STRUCTURE_H

#include "symbolic_types.h"

/* Row k of L is the part of the supernode tree between row k's entries of A and k's own supernode: k is appended to each
 * of them, and as k ascends so do the lists. end: n_supers, where each list has got to; mark: n_supers. */
static void sli_fill_rows(sl_symbolic *S, const sli_graph *G, sl_off *end, sl_int *mark) {
    sl_int k, s;
    for (s = 0; s < S->n_supers; s++) {
        end[s] = S->rows_begin[s];
        mark[s] = -1;
    }
    for (k = 0; k < S->n; k++) {
        const sl_int v = S->perm[k], own = S->super_of[k];
        sl_off e;
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            const sl_int i = S->iperm[G->to[e]];
            if (i >= k) {
                continue;
            }
            for (s = S->super_of[i]; s != own && mark[s] != k; s = S->super_parent[s]) {
                mark[s] = k;
                S->rows[end[s]++] = k;
            }
        }
    }
    for (s = 0; s < S->n_supers; s++) {
        SLI_ASSERT(end[s] == S->rows_begin[s + 1]);
    }
}

/* Every entry of A to its place in the panels, supernode by supernode. local: n of scratch. */
static void sli_fill_map(sl_symbolic *S, const sli_graph *G, sl_int *local) {
    sl_int s, j;
    sl_off at = 0;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int first = S->super_first[s], width = S->super_first[s + 1] - first;
        sl_off r;
        S->map_begin[s] = at;
        for (r = S->rows_begin[s]; r < S->rows_begin[s + 1]; r++) {
            local[S->rows[r]] = width + (sl_int)(r - S->rows_begin[s]);
        }
        for (j = 0; j < width; j++) {
            local[first + j] = j;
        }
        for (j = 0; j < width; j++) {
            const sl_int v = S->perm[first + j];
            sl_off e;
            for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
                const sl_int k = S->iperm[G->to[e]];
                if (k >= first + j) {
                    S->map_from[at] = G->from[e];
                    S->map_to[at++] = S->panel_begin[s] + sli_panel_at(width, local[k], j);
                }
            }
        }
    }
    S->map_begin[S->n_supers] = at;
}

/* The step of every supernode: the reach of everything, in which a column's place is the column. */
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

#endif
