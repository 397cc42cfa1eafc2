/* mapping.h: the map of A into L read backwards: the row and the column that a place stands for */
#ifndef SLI_MAPPING_H
#define SLI_MAPPING_H

#include "symbolic_types.h"

/* The last row tile of supernode s. */
SLI_INLINE sl_int sli_last_tile(const sl_symbolic *S, sl_int s) {
    return sli_tiles(S->steps[s].width + S->steps[s].below) - 1;
}

/* Pivots k >= j of the entry m of the map, which belongs to supernode s: it stands at L(k, j). tile: where
 * to look from, the row tile of m or a later one; then that of m. Rows ascend in a supernode's part of the
 * map: whoever goes backwards through it from the last tile looks at each tile once. */
static void sli_map_pivots(const sl_symbolic *S, sl_int s, sl_off m, sl_int *tile, sl_int *k,
                           sl_int *j) {
    const sl_int first = S->super_first[s], w = S->steps[s].width;
    sl_off in_tile = S->map_to[m] - S->panel_begin[s];
    sl_int local;
    while (sli_tile_offset(w, *tile) > in_tile) {
        --*tile;
    }
    in_tile -= sli_tile_offset(w, *tile);
    local = SLI_TILE * *tile + (sl_int)(in_tile % SLI_TILE);
    *j = first + (sl_int)(in_tile / SLI_TILE);
    *k = local < w ? first + local : S->rows[S->rows_begin[s] + local - w];
    SLI_ASSERT(S->panel_begin[s] + sli_panel_at(w, local, *j - first) == S->map_to[m]);
}

#endif
