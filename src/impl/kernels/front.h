/* fronts.h: the tree of fronts: the children of each supernode, and where their rows stand in its front */
#ifndef SLI_FRONTS_H
#define SLI_FRONTS_H

#include "symbolic_types.h"

/* The children of s: s - 1, then the one before the first descendant of that, and so on down to s's
 * own first descendant, as supernodes are in postorder. */
static void sli_fill_descendants(sl_symbolic *S) {
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        S->descendant[s] = s;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s];
        if (up != -1) {
            S->descendant[up] = sli_min(S->descendant[up], S->descendant[s]);
        }
    }
}

/* Local rows in the parent's front. local: n of scratch. */
static void sli_fill_places(sl_symbolic *S, sl_int *local) {
    sl_int s, c;
    sl_off at;
    for (s = 0; s < S->n_supers; s++) {
        for (c = S->super_first[s]; c < S->super_first[s + 1]; c++) {
            local[c] = c - S->super_first[s];
        }
        for (at = S->rows_begin[s]; at < S->rows_begin[s + 1]; at++) {
            local[S->rows[at]] = S->steps[s].width + (sl_int)(at - S->rows_begin[s]);
        }
        for (c = s - 1; c >= S->descendant[s]; c = S->descendant[c] - 1) {
            for (at = S->rows_begin[c]; at < S->rows_begin[c + 1]; at++) {
                S->places[at] = local[S->rows[at]];
            }
        }
    }
}

#endif
