/* product.inl.h: C -= A D B' on tiles, the inner loop of the factorization */

/* A block of C in registers has SLV_COLUMNS columns of SLV_TILES row tiles. Columns after the last
 * of C are computed and discarded, as B always has the 8 rows of a tile. */
#define SLI_DECLARE(k, t) SLV_DECLARE(c##t##k)
#define SLI_LOAD(k, t) \
    if ((k) < columns) { \
        SLV_LOAD(c##t##k, C##t + SLI_TILE * (k)) \
    } else { \
        SLV_ZERO(c##t##k) \
    }
#define SLI_STORE(k, t) \
    if ((k) < columns) { \
        SLV_STORE(C##t + SLI_TILE * (k), c##t##k) \
    }
#define SLI_UPDATE(k, unused) /* C(rows, k) -= A(rows, j) B(k, j) */ \
    SLV_BROADCAST(b, B + (k)) \
    SLV_FNMA(c0##k, a0, b)
#define SLI_UPDATE2(k, unused) \
    SLI_UPDATE(k, unused) \
    SLV_FNMA(c1##k, a1, b)

/* One row tile. A: [length][8]; B: [length][8], from the first column of the block on;
 * C: [columns][8]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(block1)(const double *A, const double *B, sl_int length,
                                              double *C0, sl_int columns) {
    sl_int j;
    SLV_DECLARE(a0)
    SLV_DECLARE(b)
    SLV_EACH_COLUMN(SLI_DECLARE, 0)
    SLV_EACH_COLUMN(SLI_LOAD, 0)
    for (j = 0; j < length; j++, A += SLI_TILE, B += SLI_TILE) {
        SLV_LOAD_PINNED(a0, A)
        SLV_EACH_COLUMN(SLI_UPDATE, 0)
    }
    SLV_EACH_COLUMN(SLI_STORE, 0)
}

#if SLV_TILES == 2
/* Two row tiles. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(block2)(const double *A, const double *A1, const double *B,
                                              sl_int length, double *C0, double *C1,
                                              sl_int columns) {
    sl_int j;
    SLV_DECLARE(a0)
    SLV_DECLARE(a1)
    SLV_DECLARE(b)
    SLV_EACH_COLUMN(SLI_DECLARE, 0)
    SLV_EACH_COLUMN(SLI_DECLARE, 1)
    SLV_EACH_COLUMN(SLI_LOAD, 0)
    SLV_EACH_COLUMN(SLI_LOAD, 1)
    for (j = 0; j < length; j++, A += SLI_TILE, A1 += SLI_TILE, B += SLI_TILE) {
        SLV_LOAD_PINNED(a0, A)
        SLV_LOAD_PINNED(a1, A1)
        SLV_EACH_COLUMN(SLI_UPDATE2, 0)
    }
    SLV_EACH_COLUMN(SLI_STORE, 0)
    SLV_EACH_COLUMN(SLI_STORE, 1)
}
#endif

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_UPDATE
#undef SLI_UPDATE2

/* B(k, j) = L(k, j) d(j) for the 8 rows k of a tile and `length` columns. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(pack)(const double *l, const double *d, sl_int length,
                                            double *B) {
    sl_int j;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    for (j = 0; j < length; j++) {
        SLV_LOAD(a, l + SLI_TILE * (ptrdiff_t)j)
        SLV_BROADCAST(b, d + j)
        SLV_MULTIPLY(a, a, b)
        SLV_STORE(B + SLI_TILE * (ptrdiff_t)j, a)
    }
}

/* Subtracts L D L' over columns j0 .. j1-1 of the panel from the tiles (t, c) of the lower
 * triangle, t0 <= t < t1, c0 <= c < c1, t0 >= c0. Tile (t, c) of the target is at
 * sli_tile_offset(target_width, t - target_first) + 64 (c - target_first). Columns j are taken in
 * chunks, so that the part of a row tile stays in the first cache and that of the group of column
 * tiles in the second. E: D(j+1, j), or NULL if D is diagonal. B: scratch, sli_front_scratch
 * doubles. */
SLV_FUNCTION static void SLV_NAME(product)(const double *panel, sl_int w, const double *D,
                                           const double *E, sl_int t0, sl_int t1, sl_int c0,
                                           sl_int c1, sl_int j0, sl_int j1, double *target,
                                           sl_int target_width, sl_int target_first, double *B) {
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int j, t, c, k;
    for (j = j0; j < j1; j += SLI_CHUNK_COLUMNS) {
        const sl_int length = sli_min(SLI_CHUNK_COLUMNS, j1 - j);
        for (c = c0; c < c1; c++) {
            SLV_NAME(pack)
            (panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)j, D + j, length,
             B + (ptrdiff_t)(c - c0) * SLI_TILE * length);
            if (E != NULL) {
                sli_pair_pack(panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)j, E + j,
                              length, B + (ptrdiff_t)(c - c0) * SLI_TILE * length);
            }
        }
        for (t = t0; t < t1; t++) {
            const double *A = panel + sli_tile_offset(w, t) + SLI_TILE * (ptrdiff_t)j;
            double *C = target + sli_tile_offset(target_width, t - target_first);
#if SLV_TILES == 2
            const int is_pair = t + 1 < t1;
            const double *A1 =
                is_pair ? panel + sli_tile_offset(w, t + 1) + SLI_TILE * (ptrdiff_t)j : A;
            double *C1 = is_pair ? target + sli_tile_offset(target_width, t + 1 - target_first) : C;
#endif
            for (c = c0; c < c1 && c <= t; c++) {
                const ptrdiff_t at = (ptrdiff_t)tile_size * (c - target_first);
                const double *b = B + (ptrdiff_t)(c - c0) * SLI_TILE * length;
                const sl_int columns = target_width - SLI_TILE * (c - target_first);
#if SLV_TILES == 2
                if (is_pair) {
                    SLV_NAME(block2)(A, A1, b, length, C + at, C1 + at, columns);
                    continue;
                }
#endif
                for (k = 0; k < SLI_TILE && k < columns; k += SLV_COLUMNS) {
                    SLV_NAME(block1)(A, b + k, length, C + at + SLI_TILE * k, columns - k);
                }
            }
#if SLV_TILES == 2
            t += is_pair;
            if (is_pair && c == t && c < c1) {
                /* the second row tile of the pair has one tile more, on the diagonal */
                const ptrdiff_t at = (ptrdiff_t)tile_size * (c - target_first);
                SLV_NAME(block1)
                (A1, B + (ptrdiff_t)(c - c0) * SLI_TILE * length, length, C1 + at,
                 target_width - SLI_TILE * (c - target_first));
            }
#endif
        }
    }
}
