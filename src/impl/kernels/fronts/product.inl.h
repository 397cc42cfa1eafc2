/* product.inl.h: C -= A D B' on tiles, the inner loop of the factorization */

/* A block of C in registers has SLV_COLUMNS columns of SLV_TILES row tiles. A vector is one column
 * of a row tile or, where registers are longer than a tile, of the row tiles p and q. If q is p,
 * both halves are the same, and so is what they store. Columns after the last of C are computed and
 * discarded, as B always has the 8 rows of a tile.
 *
 * Of a complex matrix, B holds real and imaginary parts in turn, as a tile does. Both are applied
 * to the same entries of A, in two columns c0, c1 of the block: as B is conjugated, the column of C
 * is c0 - i c1. So the loop is the same, over half of the columns. */
#if SLV_VECTOR_TILES == 1
#define SLI_LOAD_ROWS(a, p, q) SLV_LOAD_PINNED(a, p)
#define SLI_LOAD_SECOND(a, p, q) SLI_WORD(LOAD_PINNED, 1)(a, p)
#else
#define SLI_LOAD_SECOND SLI_LOAD_ROWS
#define SLI_LOAD_ROWS(a, p, q) SLV_LOAD_TILES(a, p, q)
#endif

#if defined(SLV_HAS_HALF) /* the second vector of a block is half of one */
#define SLI_WORD_1(word) SLV_HALF_##word
#else
#define SLI_WORD_1(word) SLV_##word
#endif
#define SLI_WORD_0(word) SLV_##word
#define SLI_WORD(word, v) SLI_PASTE(SLI_WORD_, v)(word)

#define SLI_DECLARE(k, v) SLI_WORD(DECLARE, v)(c##v##k)
#if SLV_COMPLEX
#define SLI_LOAD(k, v) \
    if ((k) % 2 == 0 && (k) < columns) { \
        SLI_WORD(LOAD, v)(c##v##k, Cp##v + SLI_TILE / 2 * (k)) \
    } else { \
        SLI_WORD(ZERO, v)(c##v##k) \
    }
#define SLI_STORE_PAIR(k, m, v) \
    if ((k) < columns) { \
        SLI_WORD(TURN_BACK, v)(c##v##m, c##v##m) \
        SLI_WORD(ADD, v)(c##v##k, c##v##m) \
        SLI_WORD(STORE, v)(Cp##v + SLI_TILE / 2 * (k), c##v##k) \
    }
#else
#define SLI_LOAD(k, v) \
    if (SLI_IS_IN(k, columns)) { \
        SLI_WORD(LOAD_TILES, v)(c##v##k, Cp##v + SLI_TILE * (k), Cq##v + SLI_TILE * (k)) \
    } else { \
        SLI_WORD(ZERO, v)(c##v##k) \
    }
#endif
#define SLI_STORE(k, v) \
    if (SLI_IS_IN(k, columns)) { \
        SLI_WORD(STORE_TILES, v)(Cp##v + SLI_TILE * (k), Cq##v + SLI_TILE * (k), c##v##k) \
    }
#if !SLV_COMPLEX
#define SLI_STORE_BLOCK(v) SLV_EACH_COLUMN(SLI_STORE, v)
#elif SLV_COLUMNS == 8
#define SLI_STORE_BLOCK(v) \
    SLI_STORE_PAIR(0, 1, v) \
    SLI_STORE_PAIR(2, 3, v) \
    SLI_STORE_PAIR(4, 5, v) \
    SLI_STORE_PAIR(6, 7, v)
#else
#define SLI_STORE_BLOCK(v) \
    SLI_STORE_PAIR(0, 1, v) \
    SLI_STORE_PAIR(2, 3, v)
#endif
#define SLI_FETCH(k, v) /* C of the next columns */ \
    SLI_PREFETCH(Cp##v, sizeof(double) * SLI_TILE / SLV_PARTS * (SLV_COLUMNS + (k)));
#define SLI_UPDATE(k, unused) /* C(rows, k) -= A(rows, j) B(k, j) */ \
    SLV_BROADCAST(b, B + (k)) \
    SLV_FNMA(c0##k, a0, b)
#define SLI_UPDATE2(k, unused) \
    SLI_UPDATE(k, unused) \
    SLI_WORD(FNMA, 1)(c1##k, a1, b)

/* One vector. A: [length][8], for each row tile; B: [length][8], from the first column of the block
 * on; C: [columns][8], for each row tile. */
SLV_FUNCTION SLI_INLINE void SLV_FRONT(rows1)(const double *Ap0, const double *Aq0,
                                              const double *B, sl_int length, double *Cp0,
                                              double *Cq0, sl_int columns) {
    sl_int j;
    SLV_DECLARE(a0)
    SLV_DECLARE(b)
    SLV_EACH_COLUMN(SLI_DECLARE, 0)
    SLV_EACH_COLUMN(SLI_LOAD, 0)
    for (j = 0; j < length; j++, Ap0 += SLI_TILE, Aq0 += SLI_TILE, B += SLI_TILE) {
        SLI_LOAD_ROWS(a0, Ap0, Aq0)
        SLV_EACH_COLUMN(SLI_UPDATE, 0)
    }
    SLI_STORE_BLOCK(0)
    (void)Aq0;
    (void)Cq0;
}

#if SLV_TILES > SLV_VECTOR_TILES
/* Two vectors, or with SLV_HAS_HALF one and a half. Prefetches what comes next: C of later columns,
 * and SLV_AHEAD entries from `ahead` on for each column j. */
SLV_FUNCTION SLI_INLINE void SLV_FRONT(rows2)(const double *Ap0, const double *Aq0,
                                              const double *Ap1, const double *Aq1,
                                              const double *B, sl_int length, double *Cp0,
                                              double *Cq0, double *Cp1, double *Cq1,
                                              sl_int columns, const double *ahead) {
    sl_int j;
    SLV_DECLARE(a0)
    SLI_WORD(DECLARE, 1)(a1)
    SLV_DECLARE(b)
    SLV_EACH_COLUMN(SLI_DECLARE, 0)
    SLV_EACH_COLUMN(SLI_DECLARE, 1)
    SLV_EACH_COLUMN(SLI_LOAD, 0)
    SLV_EACH_COLUMN(SLI_LOAD, 1)
    SLV_EACH_COLUMN(SLI_FETCH, 0)
    SLV_EACH_COLUMN(SLI_FETCH, 1)
    for (j = 0; j < SLI_TILE * length; j += SLI_TILE, B += SLI_TILE, ahead += SLV_AHEAD) {
        SLI_PREFETCH(ahead, 0);
        SLI_LOAD_ROWS(a0, Ap0 + j, Aq0 + j)
        SLI_LOAD_SECOND(a1, Ap1 + j, Aq1 + j)
        SLV_EACH_COLUMN(SLI_UPDATE2, 0)
    }
    SLI_STORE_BLOCK(0)
    SLI_STORE_BLOCK(1)
    (void)Cq0;
    (void)Cq1;
    (void)Aq0;
    (void)Aq1;
}
#endif

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_STORE_PAIR
#undef SLI_STORE_BLOCK
#undef SLI_FETCH
#undef SLI_UPDATE
#undef SLI_UPDATE2
#undef SLI_LOAD_ROWS
#undef SLI_LOAD_SECOND
#undef SLI_WORD
#undef SLI_WORD_0
#undef SLI_WORD_1

#if SLV_TILES > SLV_VECTOR_TILES
/* The rows at A that a part of the work on a group of column tiles prefetches for the row tiles
 * after it: `length` times SLV_AHEAD entries of one of them. */
SLV_FUNCTION SLI_INLINE const double *SLV_FRONT(ahead)(const double *const *A, sl_int length,
                                                          sl_int part) {
    const sl_int parts = SLI_TILE / SLV_AHEAD, at = sli_min(part, SLV_TILES * parts - 1);
    return A[at / parts] + at % parts * SLV_AHEAD * (ptrdiff_t)length;
}

/* SLV_TILES row tiles and SLV_COLUMNS columns. A, C, next: of each row tile and of those that come
 * after it; C at position `to`. k: the first of the columns in the group. */
SLV_FUNCTION SLI_INLINE void SLV_FRONT(whole)(const double *const *A, const double *B,
                                              sl_int length, double *const *C, ptrdiff_t to,
                                              sl_int columns, const double *const *next,
                                              sl_int k) {
#if defined(SLV_HAS_HALF)
    sl_int m;
    for (m = 0; m < 2; m++) { /* the first tile and half of the second one, then the rest */
        const double *Am = A[2 * m], *Ah = A[1] + SLI_TILE / 2 * m;
        double *Cm = C[2 * m] + to, *Ch = C[1] + SLI_TILE / 2 * m + to;
        SLV_FRONT(rows2)
        (Am, Am, Ah, Ah, B, length, Cm, Cm, Ch, Ch, columns,
         SLV_FRONT(ahead)(next, length, 2 * (k / SLV_COLUMNS) + m));
    }
#else
    const sl_int p = SLV_VECTOR_TILES, q = SLV_VECTOR_TILES - 1;
    SLV_FRONT(rows2)
    (A[0], A[q], A[p], A[p + q], B, length, C[0] + to, C[q] + to, C[p] + to, C[p + q] + to, columns,
     SLV_FRONT(ahead)(next, length, k / SLV_COLUMNS));
#endif
}
#endif

/* B(k, j) = L(k, j) d(j) for the 8 rows k of a tile and `length` columns that are kept. */
SLV_FUNCTION SLI_INLINE void SLV_FRONT(pack)(const double *l, const double *d, sl_int length,
                                             double *B) {
    sl_int j;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    for (j = 0; j < length; j++) {
        SLV_LOAD(a, l + SLI_TILE * (ptrdiff_t)j)
        SLV_BROADCAST(b, d + SLV_PARTS * j)
        SLV_MULTIPLY(a, a, b)
        SLV_STORE(B + SLI_TILE * (ptrdiff_t)j, a)
    }
}

/* Subtracts L D L' over columns j0 .. j1-1 of the panel from the tiles (t, c) of the lower
 * triangle, t0 <= t < t1, c0 <= c < c1, t0 >= c0. Tile (t, c) of the target is at
 * sli_tile_offset(target_width, t - target_first) + 64 (c - target_first). Columns j are taken in
 * chunks, so that the part of a row tile stays in the first cache and that of the group of column
 * tiles in the second. Row tiles are taken as many at a time as a block has; where these cross the
 * diagonal, and at the end, one vector at a time. E: D(j+1, j), or NULL if D is diagonal. B:
 * scratch, sli_front_scratch entries. */
SLV_FUNCTION static void SLV_FRONT(product)(const double *panel, sl_int w, const double *D,
                                            const double *E, sl_int t0, sl_int t1, sl_int c0,
                                            sl_int c1, sl_int j0, sl_int j1, double *target,
                                            sl_int target_width, sl_int target_first,
                                            double *B) {
    const sl_int step = SLV_TILES, parts = SLV_PARTS, tile_size = SLI_TILE * SLI_TILE;
    sl_int j, t, c, k, r, m;
    for (j = j0 / parts; j < j1 / parts; j += SLI_CHUNK_COLUMNS) {
        const sl_int length = sli_min(SLI_CHUNK_COLUMNS, j1 / parts - j);
        for (c = c0; c < c1; c++) {
            const double *l = panel + sli_tile_offset(w, c) / parts + SLI_TILE * (ptrdiff_t)j;
            double *to = B + (ptrdiff_t)(c - c0) * SLI_TILE * length;
            SLV_FRONT(pack)(l, D + parts * j, length, to);
            if (E != NULL) {
                sli_pair_pack(l, E + j, length, to);
            }
        }
        for (t = t0; t < t1; t += step) {
            const sl_int end = sli_min(t + step, t1);
            const double *A[SLV_TILES];
#if SLV_TILES > SLV_VECTOR_TILES
            const double *next[SLV_TILES];
#endif
            double *C[SLV_TILES];
            m = 0;
            do { /* no constant end: gcc -O3 would make vectors of addresses, and spill sums */
                r = t + m;
                A[m] = panel + sli_tile_offset(w, r) / parts + SLI_TILE * (ptrdiff_t)j;
                C[m] = target + sli_tile_offset(target_width, r - target_first) / parts;
#if SLV_TILES > SLV_VECTOR_TILES
                r = sli_min(t + m + step, t1 - 1);
                next[m] = panel + sli_tile_offset(w, r) / parts + SLI_TILE * (ptrdiff_t)j;
#endif
            } while (++m < end - t);
            for (c = c0; c < c1 && c < end; c++) {
                const ptrdiff_t at = (ptrdiff_t)tile_size / parts * (c - target_first);
                const double *b = B + (ptrdiff_t)(c - c0) * SLI_TILE * length;
                const sl_int columns = target_width - SLI_TILE * (c - target_first);
                for (k = 0; k < SLI_TILE && k < columns; k += SLV_COLUMNS) {
                    const ptrdiff_t to = at + SLI_TILE / parts * k;
#if SLV_TILES > SLV_VECTOR_TILES
                    if (c <= t && end == t + step) {
                        SLV_FRONT(whole)
                        (A, b + k, length, C, to, columns - k, next, SLI_TILE * (c - c0) + k);
                        continue;
                    }
#endif
                    for (r = sli_max(t, c) - t; r < end - t; r += SLV_VECTOR_TILES) {
                        m = sli_min(r + SLV_VECTOR_TILES, end - t) - 1;
                        SLV_FRONT(rows1)
                        (A[r], A[m], b + k, length, C[r] + to, C[m] + to, columns - k);
                    }
                }
            }
        }
    }
}
