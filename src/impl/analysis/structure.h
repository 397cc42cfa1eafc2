/* structure.h: the rows of every supernode, the places of the panels, and the map of A into L */
#ifndef SLI_STRUCTURE_H
#define SLI_STRUCTURE_H

#include "symbolic_types.h"

/* Entries of A that a supernode's columns hold, summed up to the starts of its part of the map. */
static void sli_count_map(sl_symbolic *S, const sli_half *columns, const sl_int *old_of) {
    sl_int s, k = 0;
    sl_off total = 0;
    for (s = 0; s < S->n_supers; s++) {
        S->map_begin[s] = total;
        for (; k < S->super_first[s + 1]; k++) {
            total += columns->begin[old_of[k] + 1] - columns->begin[old_of[k]];
        }
    }
    S->map_begin[S->n_supers] = total;
}

/* The rows of every supernode, and the place in L of every entry of A, in one walk over the rows.
 *
 * Row k of L is the part of the supernode tree between row k's entries of A and k's own supernode:
 * k is appended to each of them, and as k ascends so do the lists; where it was appended is the
 * local row of k's entries. end: n_supers, how far each list has got; mark: n_supers.
 */
static void sli_fill_structure(sl_symbolic *S, const sli_half *rows, const sl_int *old_of,
                               const sl_int *new_of, sl_off *end, sl_int *mark) {
    sl_int k, p, s;
    for (s = 0; s < S->n_supers; s++) {
        end[s] = S->rows_begin[s];
        mark[s] = -1;
    }
    for (k = 0; k < S->n; k++) {
        const sl_int own = S->super_of[k];
        for (p = rows->begin[old_of[k]]; p < rows->begin[old_of[k] + 1]; p++) {
            const sl_int i = new_of[rows->to[p]], home = S->super_of[i];
            const sl_int first = S->super_first[home], width = S->super_first[home + 1] - first;
            sl_int local;
            sl_off at;
            for (s = home; s != own && mark[s] != k; s = S->super_parent[s]) {
                mark[s] = k;
                S->rows[end[s]++] = k;
            }
            local = home == own ? k - first : width + (sl_int)(end[home] - S->rows_begin[home]) - 1;
            at = S->map_begin[home]++; /* every start moves to its end, and back afterwards */
            S->map_from[at] = rows->from[p];
            S->map_to[at] = S->panel_begin[home] + sli_panel_at(width, local, i - first);
        }
    }
    for (s = 0; s < S->n_supers; s++) {
        SLI_ASSERT(end[s] == S->rows_begin[s + 1]);
    }
    memmove(S->map_begin + 1, S->map_begin, (size_t)S->n_supers * sizeof(sl_off));
    S->map_begin[0] = 0;
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
