/* fronts.h: the fronts of the supernodes: where a child's rows stand in its parent, where update matrices wait */
#ifndef SLI_FRONTS_H
#define SLI_FRONTS_H

#include "symbolic_types.h"

/* Doubles that a supernode leaves to its parent: the update matrix and the magnitudes of its rows. */
SLI_INLINE sl_off sli_waiting_size(const sli_step *s) {
    const sl_int rows = s->width % SLI_TILE + s->below;
    return s->below == 0 ? 0
                         : sli_update_size(s->width, s->below) + SLI_TILE * (sl_off)sli_tiles(rows);
}

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

/* Where the update matrix of every supernode waits for the parent. Supernodes of even and of odd
 * depth have a stack each, which grow towards each other: when a supernode is done, its children are
 * the top of the other one, so that nothing ever moves. depth: n_supers of scratch. */
static void sli_fill_waiting(sl_symbolic *S, sl_int *depth) {
    sl_off top[2] = {0, 0};
    sl_int s, c;
    S->waiting = 0;
    for (s = S->n_supers - 1; s >= 0; s--) {
        depth[s] = S->super_parent[s] == -1 ? 0 : 1 - depth[S->super_parent[s]];
    }
    for (s = 0; s < S->n_supers; s++) {
        const int side = depth[s];
        const sl_off size = sli_waiting_size(&S->steps[s]);
        S->waiting_begin[s] = side == 0 ? top[0] : -(top[1] + size);
        top[side] += size;
        S->waiting = top[0] + top[1] > S->waiting ? top[0] + top[1] : S->waiting;
        for (c = s - 1; c >= S->descendant[s]; c = S->descendant[c] - 1) {
            top[1 - side] -= sli_waiting_size(&S->steps[c]);
        }
    }
    for (s = 0; s < S->n_supers; s++) { /* from the end of the other stack */
        S->waiting_begin[s] += depth[s] == 0 ? 0 : S->waiting;
    }
}

#endif
