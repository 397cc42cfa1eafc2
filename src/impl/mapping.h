/* mapping.h: the map of A into L read backwards: the row and the column that a place stands for */
#ifndef SLI_MAPPING_H
#define SLI_MAPPING_H

#include "symbolic_types.h"

/* The tile of a panel of w columns in which a place stands: where the trapezoid still grows, the last t
 * with 32 t (t + 1) <= at. */
static sl_int sli_tile_of(sl_int w, sl_off at) {
    const sl_int whole = w / SLI_TILE;
    const sl_off grown = sli_tile_offset(w, whole);
    sl_int t;
    if (at >= grown) {
        return whole + (sl_int)((at - grown) / (SLI_TILE * (sl_off)w));
    }
    t = (sl_int)((sqrt(1.0 + (double)at / 8.0) - 1.0) / 2.0);
    t += sli_tile_offset(w, t + 1) <= at; /* the root may be off by a rounding */
    t -= sli_tile_offset(w, t) > at;
    return t;
}

/* Pivots k >= j of the entry m of the map, which belongs to supernode s: it stands at L(k, j). */
static void sli_map_pivots(const sl_symbolic *S, sl_int s, sl_off m, sl_int *k, sl_int *j) {
    const sl_int first = S->super_first[s], w = S->super_first[s + 1] - first;
    const sl_off at = S->map_to[m] - S->panel_begin[s];
    const sl_int t = sli_tile_of(w, at);
    const sl_off in_tile = at - sli_tile_offset(w, t);
    const sl_int local = SLI_TILE * t + (sl_int)(in_tile % SLI_TILE);
    *j = first + (sl_int)(in_tile / SLI_TILE);
    *k = local < w ? first + local : S->rows[S->rows_begin[s] + local - w];
    SLI_ASSERT(sli_panel_at(w, local, *j - first) == at);
}

#endif
