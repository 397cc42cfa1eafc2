/* pins_choose.h: what pins cost by the capacitance matrix and by elimination */
#ifndef SLI_CHANGE_PINS_CHOOSE_H
#define SLI_CHANGE_PINS_CHOOSE_H

#include "pins_held.h"

/* The two methods are compared from this multiple of what elimination takes at least: a comparison
 * takes a part of that. */
#define SLI_PINS_WORTH 1.5

/* Seconds of new pins by the capacitance matrix, beside `others` that are there. seeds: their
 * columns, ascending; uses: n_supers of scratch, 0 before and after; NULL: for one pin, whose path
 * alone is visited. */
static double sli_pins_capacitance_cost(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                                        sl_int others, sl_int *uses) {
    const double before = others, after = before + count;
    double seconds = SLI_PINS_DENSE / 3.0 * (after * after * after - before * before * before) +
                     SLI_PINS_PIN * count;
    sl_int k, s;
    for (k = 0; k < count && uses != NULL; k++) {
        uses[S->super_of[sli_key(seeds[k])]]++;
    }
    s = count == 0 ? -1 : uses != NULL ? 0 : S->super_of[sli_key(seeds[0])];
    while (s != -1 && s < S->n_supers) {
        const double u = uses == NULL ? 1.0 : uses[s], w = S->steps[s].width;
        const sl_int up = S->super_parent[s];
        if (u > 0.0) {
            seconds += SLI_PINS_ENTRY * fmin(u, SLI_PINS_JOINT * u + SLI_PINS_BLOCK) *
                           (double)sli_panel_size((sl_int)w, S->steps[s].below) +
                       (SLI_PINS_STEP + SLI_PINS_TERM * w) * u * before +
                       (SLI_PINS_NUMBER + SLI_PINS_PRODUCT / 2.0 * u) * w * u;
        }
        if (uses != NULL) {
            if (up != -1) {
                uses[up] += uses[s];
            }
            uses[s++] = 0;
        } else {
            s = up;
        }
    }
    return seconds;
}

/* Seconds that elimination takes at least. */
static double sli_pins_least_cost(const sl_pins *P) {
    const sl_symbolic *S = P->F->S;
    return SLI_PINS_MAP * (double)S->scatter_begin[S->n_supers] +
           (P->G == NULL ? SLI_PINS_MEMORY * (double)S->panel_begin[S->n_supers] : 0.0);
}

/* Seconds of elimination. Decides whether it is computed in the reach of the changes. */
static double sli_pins_elimination_cost(const sl_pins *P, sli_holding *h) {
    const sl_symbolic *S = P->F->S;
    const double whole = sli_choose_refactor(P->F);
    double part;
    h->choice.seeds = h->seeds;
    h->choice.n_seeds = h->n_seeds;
    sli_choose_measure(&h->choice, P->F, whole);
    part =
        h->choice.changed + (h->is_new ? SLI_PINS_COPY * (double)S->panel_begin[S->n_supers] : 0.0);
    h->is_local = part < whole && sli_held_is_local(P->F, h->is_new);
    return (h->is_local ? part : whole) + sli_pins_least_cost(P);
}

#endif
