/* panel.h: how the columns of L of one supernode are stored: row tiles of 8 */
#ifndef SLI_KERNELS_PANEL_H
#define SLI_KERNELS_PANEL_H

#include "../base/base.h"

/* The panel of a supernode with w columns and u rows below its diagonal block has w + u local rows.
 * It is stored in row tiles of 8, [tile][column][8], for every instruction set: entry (r, j) is in
 * tile r / 8, column j, lane r % 8. A tile of the diagonal block keeps only its first 8 (tile + 1)
 * columns. The unit diagonal, the part above it and the padding of the last tile are stored as 0.
 * A panel of one column has no padding, and begins anywhere; all others begin on a cache line. */
#define SLI_TILE 8

/* Position of tile t in a panel of w columns, in doubles. The first w / 8 tiles grow by 8 columns
 * each, the others have w columns. */
SLI_INLINE sl_off sli_tile_offset(sl_int w, sl_int t) {
    const sl_off whole = (sl_off)((uint32_t)w / SLI_TILE), growing = t < whole ? t : whole;
    return 32 * growing * (growing + 1) + (t - growing) * SLI_TILE * w;
}

/* Number of tiles that hold some rows. */
SLI_INLINE sl_int sli_tiles(sl_int rows) {
    return (sl_int)(((uint32_t)rows + SLI_TILE - 1) / SLI_TILE); /* without a branch */
}

/* Size of a panel of w columns and u rows below the diagonal block, in doubles: the offset of the
 * tile after the last one, which does not grow. */
SLI_INLINE sl_off sli_panel_size(sl_int w, sl_int u) {
    const sl_off whole = (sl_off)((uint32_t)w / SLI_TILE);
    return w == 1 ? 1 + (sl_off)u
                  : 32 * whole * (whole + 1) + (sli_tiles(w + u) - whole) * SLI_TILE * w;
}

/* Where a panel of w columns begins, the panels before which end at `end`. */
SLI_INLINE sl_off sli_panel_start(sl_int w, sl_off end) {
    return w == 1 ? end : (end + SLI_TILE - 1) / SLI_TILE * SLI_TILE;
}

/* Copies a panel of one column to whole tiles. */
SLI_INLINE void sli_column_pad(const double *panel, sl_int u, double *to) {
    const sl_int rows = SLI_TILE * sli_tiles(1 + u);
    sl_int r;
    SLI_COPY(to, panel, 1 + u);
    for (r = 1 + u; r < rows; r++) {
        to[r] = 0.0;
    }
}

/* A complex matrix is kept as its real one, with pairs of rows and columns for the real and the
 * imaginary part. Second columns of pairs are left out: sizes and offsets of tiles are half of
 * those above. This is the position in such a panel of an entry of a first column. */
SLI_INLINE sl_off sli_half_at(sl_off at) {
    return at / (2 * SLI_TILE) * SLI_TILE + at % SLI_TILE;
}

/* Position of local row r of column j in a panel of w columns. */
SLI_INLINE sl_off sli_panel_at(sl_int w, sl_int r, sl_int j) {
    return sli_tile_offset(w, r / SLI_TILE) + (sl_off)j * SLI_TILE + r % SLI_TILE;
}

#endif
