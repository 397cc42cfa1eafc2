/* inverse_front.inl.h: gathers a front of the inverse from its parent and completes it */

/* The same for users of single row tiles. */
SLV_FUNCTION SLI_INLINE void SLV_FRONT(block1)(const SLV_VALUE *A, const SLV_VALUE *B,
                                               sl_int length, SLV_VALUE *C, sl_int columns) {
    SLV_FRONT(rows1)(A, A, B, length, C, C, columns);
}

/* C(rows, k) -= A(rows, j) B(k, j) for one row tile. A and B: [length][8]; C: [columns][8]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(block)(const double *A, const double *B, sl_int length,
                                             double *C, sl_int columns) {
    sl_int k;
    for (k = 0; k < columns; k += SLV_COLUMNS) {
        SLV_NAME(block1)(A, B + k, length, C + SLI_TILE * (ptrdiff_t)k, columns - k);
    }
}

#define SLI_STORE(k, p) \
    if (SLI_IS_IN(k, columns)) { \
        SLV_STORE((p) + SLI_TILE * (k), a) \
    }

/* Clears the first columns of a tile. Not a loop: compilers turn one into rep stos, and the next
 * reads of the tile wait for that. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int columns) {
    SLV_DECLARE(a)
    SLV_ZERO(a)
    SLI_EACH8(SLI_STORE, x)
}

#undef SLI_STORE

#define SLI_OFFSET(k) offset[k]

/* Copies Z of the rows below from the front of the parent: row and column i are row and column
 * relative[i] there. Lanes that belong to no row below get a copy of a neighbor, which is never
 * read. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_inverse_front *f, const double *from,
                                          sl_int height, const sl_int *relative, sl_int t0,
                                          sl_int t1) {
    const sl_int w = f->width, u = f->below;
    sl_int t, i;
    for (t = sli_max(t0, w / SLI_TILE); t < t1; t++) { /* not of a root: u > 0 */
        double *to = f->front + sli_square_offset(w + u, t) + SLI_TILE * (ptrdiff_t)w;
        ptrdiff_t offset[SLI_TILE];
        for (i = 0; i < SLI_TILE; i++) {
            const sl_int local = relative[sli_clamp(SLI_TILE * t + i - w, u - 1)];
            offset[i] = sli_square_offset(height, local / SLI_TILE) + local % SLI_TILE;
        }
        for (i = 0; i < u; i++) {
            const double *x = from + SLI_TILE * (ptrdiff_t)relative[i];
            SLV_DECLARE(a)
            SLV_GATHER(a, x, SLI_OFFSET)
            SLV_STORE(to + SLI_TILE * (ptrdiff_t)i, a)
        }
    }
}

#undef SLI_OFFSET

#if defined(SLV_ARRAYS)
#define SLI_EACH SLI_EACH_ARRAY
#define SLI_EACH_AGAIN SLI_EACH_ARRAY_AGAIN
#define SLI_DECLARE_ALL SLV_DECLARE(a[SLI_TILE])
#else
#define SLI_EACH SLI_EACH8
#define SLI_EACH_AGAIN SLI_EACH8_AGAIN
#define SLI_DECLARE_ALL SLI_EACH8(SLI_DECLARE, 0)
#endif
#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#define SLI_LOAD(k, p) SLV_LOAD(a##k, (p) + SLI_TILE * (k))
#define SLI_STORE(k, p) SLV_STORE((p) + SLI_TILE * (k), a##k)
#define SLI_BEFORE(j, k) \
    if ((j) < (k)) { \
        SLV_BROADCAST(b, l + SLI_TILE * (j) + (k)) \
        SLV_FNMA(a##k, a##j, b) \
    }
#define SLI_SOLVE(k, unused) \
    if (SLI_IS_IN(k, columns)) { \
        SLI_EACH_AGAIN(SLI_BEFORE, k) \
    }

/* x := x L'^-1 for the 8 x 8 unit triangle at l: x(rows, k) -= x(rows, j) L(k, j) for j < k. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(solve_triangle)(const double *l, double *x, sl_int columns) {
    SLV_DECLARE(b)
    SLI_DECLARE_ALL
    SLI_EACH(SLI_LOAD, x)
    SLI_EACH(SLI_SOLVE, 0)
    SLI_EACH(SLI_STORE, x)
}

#undef SLI_EACH
#undef SLI_EACH_AGAIN
#undef SLI_DECLARE_ALL
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_BEFORE
#undef SLI_SOLVE

/* N = -L_JJ'^-1 and P = -N D^-1 for the group of m columns from j0 on: row tiles c0 .. c1-1, row
 * tile c from column 8c on. Rows after the last are 0. */
SLI_AT_LINE SLV_FUNCTION SLI_INLINE void SLV_NAME(group_triangle)(const sli_inverse_front *f,
                                                                  sl_int j0, sl_int c0, sl_int c1,
                                                                  double *scratch) {
    const sl_int m = sli_inverse_group_columns(f, j0), tiles = sli_tiles(m),
                 tile_size = SLI_TILE * SLI_TILE;
    double *N = scratch + SLI_INVERSE_ROW * (ptrdiff_t)c0,
           *P = N + SLI_INVERSE_GROUP * SLI_INVERSE_ROW;
    sl_int c, t, k;
    for (c = c0; c < c1; c++, N += SLI_INVERSE_ROW, P += SLI_INVERSE_ROW) {
        for (t = c; t < tiles; t++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * t);
            const double *l =
                f->panel + sli_tile_offset(f->width, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
            double *x = N + tile_size * (ptrdiff_t)t;
            SLV_NAME(clear)(x, SLI_TILE);
            for (k = 0; k < columns && t == c; k++) {
                x[SLI_TILE * k + k] = -1.0;
            }
            if (t > c) { /* N(c, t) -= N(c, c..t-1) L(t, c..t-1)' */
                SLV_NAME(block)
                (N + tile_size * (ptrdiff_t)c, l + tile_size * (ptrdiff_t)c, SLI_TILE * (t - c), x,
                 columns);
            }
            SLV_NAME(solve_triangle)(l + tile_size * (ptrdiff_t)t, x, columns);
        }
        for (k = SLI_TILE * c; k < m; k++) {
            const double minus = -f->D[j0 + k];
            SLV_DECLARE(a)
            SLV_DECLARE(b)
            SLV_LOAD(a, N + SLI_TILE * (ptrdiff_t)k)
            SLV_BROADCAST(b, &minus)
            SLV_DIVIDE(a, a, b)
            SLV_STORE(P + SLI_TILE * (ptrdiff_t)k, a)
        }
    }
}

/* W' = (L_SJ L_JJ^-1)' for row tiles t0 .. t1-1 of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_inverse_front *f, sl_int j0,
                                                     sl_int t0, sl_int t1, double *scratch) {
    const sl_int m = sli_inverse_group_columns(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_inverse_stride(f, j0);
    const double *N = scratch;
    double *W = sli_inverse_weights(scratch) + tile_size * (ptrdiff_t)(t0 - (j0 + m) / SLI_TILE);
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_INVERSE_ROW, W += stride) {
        const ptrdiff_t first = SLI_TILE * (ptrdiff_t)(SLI_TILE * c);
        for (t = t0; t < t1; t++) {
            double *to = W + tile_size * (ptrdiff_t)(t - t0);
            SLV_NAME(clear)(to, SLI_TILE);
            SLV_NAME(block)
            (N + first, f->panel + sli_tile_offset(f->width, t) + SLI_TILE * (ptrdiff_t)j0 + first,
             m - SLI_TILE * c, to, SLI_TILE);
        }
    }
}

#if SLV_TILES > SLV_VECTOR_TILES
/* SLV_TILES row tiles of group_product, `tile` entries apart; the same again begin `after` tiles
 * later, or 0. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_tiles)(const double *A, const double *B, sl_int length,
                                                   double *C, sl_int columns, ptrdiff_t tile,
                                                   sl_int after, ptrdiff_t stride) {
    const double *rows[SLV_TILES], *next[SLV_TILES];
    double *to[SLV_TILES];
    sl_int c, k;
    for (k = 0; k < SLV_TILES; k++) {
        rows[k] = A + tile * k;
        next[k] = A + tile * (after + k);
        to[k] = C + tile * k;
    }
    for (c = 0; c < columns; c += SLI_TILE) {
        for (k = c; k < c + SLI_TILE && k < columns; k += SLV_COLUMNS) {
            SLV_NAME(whole)
            (rows, B + c / SLI_TILE * stride + k % SLI_TILE, length, to, SLI_TILE * (ptrdiff_t)k,
             columns - k, next, k);
        }
    }
}
#endif

/* Z_SJ = -Z_SS W for row tiles t0 .. t1-1, SLI_CHUNK_COLUMNS columns of Z_SS at a time. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_inverse_front *f, sl_int j0,
                                                     sl_int t0, sl_int t1, double *scratch) {
    const sl_int m = sli_inverse_group_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const ptrdiff_t stride = sli_inverse_stride(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const double *W = sli_inverse_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
    sl_int t, c, s;
    for (t = t0; t < t1; t++) {
        double *row = f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c < sli_tiles(m); c++) {
            SLV_NAME(clear)(row + tile_size * c, m - SLI_TILE * c);
        }
    }
    for (s = first; s < h; s += SLI_CHUNK_COLUMNS) {
        const sl_int length = sli_min(SLI_CHUNK_COLUMNS, h - s);
        const double *B = W + SLI_TILE * (ptrdiff_t)(s - first);
        for (t = t0; t < t1; t++) {
            double *row = f->front + sli_square_offset(h, t);
            const double *A = row + SLI_TILE * (ptrdiff_t)s;
            double *C = row + SLI_TILE * (ptrdiff_t)j0;
#if SLV_TILES > SLV_VECTOR_TILES
            if (t + SLV_TILES <= t1) {
                SLV_NAME(group_tiles)
                (A, B, length, C, m, sli_square_offset(h, 1),
                 t + 2 * SLV_TILES <= t1 ? SLV_TILES : 0, stride);
                t += SLV_TILES - 1;
                continue;
            }
#endif
            for (c = 0; c < sli_tiles(m); c++) {
                SLV_NAME(block)
                (A, B + c * stride, length, C + tile_size * c, sli_min(SLI_TILE, m - SLI_TILE * c));
            }
        }
    }
}

/* Copies the first lanes of columns first .. last-1 from one tile to another. The other lanes are
 * rows below, which are perhaps not computed yet: they are neither read nor written. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(merge)(double *to, const double *from, sl_int lanes,
                                             sl_int first, sl_int last) {
    sl_int k, i;
    SLV_DECLARE(a)
    for (k = first; k < last; k++) {
        if (lanes == SLI_TILE) {
            SLV_LOAD(a, from + SLI_TILE * k)
            SLV_STORE(to + SLI_TILE * k, a)
            continue;
        }
        for (i = 0; i < lanes; i++) {
            to[SLI_TILE * k + i] = from[SLI_TILE * k + i];
        }
    }
}

/* Transposes a tile: its lanes first .. last-1 become columns, its first columns become lanes. */
SLV_FUNCTION SLI_NOINLINE static void SLV_NAME(mirror)(const double *from, sl_int first,
                                                       sl_int last, double *to, sl_int columns) {
    if (columns == SLI_TILE && first == 0 && last == SLI_TILE) {
        SLV_TRANSPOSE(to, from)
    } else {
        SLI_ALIGNED(double x[SLI_TILE * SLI_TILE]);
        SLV_TRANSPOSE(x, from)
        SLV_NAME(merge)(to, x, columns, first, last);
    }
}

/* Z_JS = Z_SJ' for row tiles t0 .. t1-1 of Z_SJ. */
SLV_FUNCTION SLI_NOINLINE static void SLV_NAME(group_mirror)(const sli_inverse_front *f, sl_int j0,
                                                             sl_int t0, sl_int t1) {
    const sl_int m = sli_inverse_group_columns(f, j0), h = f->width + f->below;
    const ptrdiff_t tile_size = SLI_TILE * SLI_TILE;
    sl_int t, c;
    for (c = 0; c < sli_tiles(m); c++) {
        const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
        double *to = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
        for (t = t0; t < t1; t++) {
            SLV_NAME(mirror)
            (f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0 + tile_size * c,
             sli_max(j0 + m - SLI_TILE * t, 0), sli_min(SLI_TILE, h - SLI_TILE * t),
             to + tile_size * t, columns);
        }
    }
}

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ: the lower tiles of row tiles t0 .. t1-1 of the group, and
 * their transposes. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_inverse_front *f, sl_int j0,
                                                    sl_int t0, sl_int t1, double *scratch) {
    const sl_int m = sli_inverse_group_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_inverse_stride(f, j0);
    const double *N = scratch, *P = N + SLI_INVERSE_GROUP * SLI_INVERSE_ROW,
                 *W = sli_inverse_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
    SLI_ALIGNED(double x[SLI_TILE * SLI_TILE]);
    sl_int c, t;
    for (t = t0; t < t1; t++) {
        const sl_int rows = sli_min(SLI_TILE, m - SLI_TILE * t);
        double *row = f->front + sli_square_offset(h, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c <= t; c++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
            double *column = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
            SLV_NAME(clear)(x, SLI_TILE);
            SLV_NAME(block)
            (N + SLI_INVERSE_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_INVERSE_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride, column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
            }
            /* after the last row of a root the lanes are 0, for the groups before this one */
            SLV_NAME(merge)
            (row + tile_size * (ptrdiff_t)c, x, f->below == 0 ? SLI_TILE : rows, 0, columns);
            if (c < t) {
                SLV_NAME(mirror)
                (x, 0, rows, column + SLI_TILE * (ptrdiff_t)j0 + tile_size * (ptrdiff_t)t,
                 SLI_TILE);
            }
        }
    }
}

SLV_FUNCTION static void SLV_NAME(inverse_phase)(const sli_inverse_front *f, sl_int j0,
                                                 sli_inverse_phase phase, sl_int t0, sl_int t1,
                                                 double *scratch) {
    switch (phase) {
    case SLI_INVERSE_TRIANGLE:
        SLV_NAME(group_triangle)(f, j0, t0, t1, scratch);
        break;
    case SLI_INVERSE_WEIGHTS:
        SLV_NAME(group_weights)(f, j0, t0, t1, scratch);
        break;
    case SLI_INVERSE_PRODUCT:
        SLV_NAME(group_product)(f, j0, t0, t1, scratch);
        break;
    case SLI_INVERSE_MIRROR:
        SLV_NAME(group_mirror)(f, j0, t0, t1);
        break;
    default:
        SLV_NAME(group_square)(f, j0, t0, t1, scratch);
    }
}

/* Groups of columns from the last to the first. The columns after a group count as rows below it.
 * The data of a group fit in the caches for any width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_inverse_front *f, double *scratch) {
    sl_int j0;
    for (j0 = sli_inverse_last_group(f); j0 + SLI_INVERSE_COLUMNS > f->first;
         j0 -= SLI_INVERSE_COLUMNS) {
        const sli_tile_range group = sli_inverse_tiles(f, j0, SLI_INVERSE_TRIANGLE);
        const sli_tile_range below = sli_inverse_tiles(f, j0, SLI_INVERSE_WEIGHTS);
        SLV_NAME(group_triangle)(f, j0, group.first, group.last, scratch);
        if (below.first < below.last) {
            SLV_NAME(group_weights)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_product)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_mirror)(f, j0, below.first, below.last);
        }
        SLV_NAME(group_square)(f, j0, group.first, group.last, scratch);
    }
}
