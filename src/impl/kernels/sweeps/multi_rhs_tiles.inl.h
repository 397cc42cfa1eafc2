/* multi_rhs_tiles.inl.h: several right-hand sides through supernodes of any width, by row tiles */

#if SLW_NRHS > 2 || defined(SLW_GROUPS) /* two have two_rhs.inl.h */

/* multi_rhs.inl.h or complex_groups.inl.h has defined
 *
 *  SLI_PARTS              real columns that a column of L stands for: 2 of a complex matrix, or 1
 *  SLI_KERNEL(f)          the name of sweep f
 *  SLI_TABLE(f)           its name in the table of kernels, for groups
 *  SLI_PREPARE            declares what a supernode needs
 *  SLI_BLOCK(columns)     how many of so many columns are read at a time, into SLW_ENTRY
 *  SLI_READ_BLOCK(lj, l, columns)     reads them from l on: lj is the first one
 *  SLI_APPLY_COLUMN       a -= lj x(j), with x(j) at xj
 *  SLI_GATHER_COLUMN      x(j) -= lj' a
 *  SLI_TRIANGLE           the first `inner` columns of the triangle at l on the rows a
 *  SLI_TRIANGLE_UP        the same for its transpose
 *
 * where a0, a1, .. are SLW_ROWS rows in registers. */

/* Rows below the diagonal block, at their positions in x. */
#define SLI_LOAD_BELOW(r, p) SLW_LOAD(a##r, (p) + (ptrdiff_t)below.index[r] * stride)
#define SLI_ZERO_ROW(r, unused) SLW_ZERO(a##r)
#define SLI_ADD_BELOW(r, p) \
    { \
        double *to = (p) + (ptrdiff_t)below.index[r] * stride; \
        SLW_DECLARE(b) \
        SLW_LOAD(b, to) \
        SLW_ADD(b, a##r) \
        SLW_STORE(to, b) \
    }

#if defined(SLW_GROUPS)
#define SLI_STRIDE_PARAMETER , sl_int stride
#define SLI_SET_STRIDE
#define SLI_IS_DIRECT 1 /* rows below are loaded from x and not from a copy */
#else
#define SLI_IS_DIRECT 0
#define SLI_STRIDE_PARAMETER
#define SLI_SET_STRIDE const sl_int stride = SLW_NRHS;
#endif

#if SLI_PARTS == 1
/* A supernode of one column. l: its rows below. */
SLV_FUNCTION SLI_INLINE void SLI_KERNEL(column_forward)(sli_rows below, const SLV_VALUE *l,
                                                        const double *xs, double *x) {
    const sl_int stride = below.lanes;
    sl_int group, j;
    for (group = 0; group < stride; group += SLW_NRHS) {
        SLW_DECLARE(a)
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        SLW_LOAD(a, xs + group)
        for (j = 0; j < below.count; j++) { /* x(i) -= L(i) y */
            double *to = x + (ptrdiff_t)below.index[j] * stride + group;
            const SLW_ENTRY entry = l[j];
            SLW_ZERO(b)
            SLW_FNMA(b, entry, a)
            SLW_LOAD(c, to)
            SLW_ADD(c, b)
            SLW_STORE(to, c)
        }
    }
}

SLV_FUNCTION SLI_INLINE void SLI_KERNEL(column_backward)(sli_rows below, const SLV_VALUE *l,
                                                         double d, double *xs, const double *x) {
    const sl_int stride = below.lanes;
    sl_int group, j;
    for (group = 0; group < stride; group += SLW_NRHS) {
        SLW_DECLARE(a)
        SLW_DECLARE(b)
        SLW_LOAD(a, xs + group)
        SLW_DIVIDE(a, d)
        for (j = 0; j < below.count; j++) { /* y -= L(i) x(i) */
            const SLW_ENTRY entry = l[j];
            SLW_LOAD(b, x + (ptrdiff_t)below.index[j] * stride + group)
            SLW_FNMA(a, entry, b)
        }
        SLW_STORE(xs + group, a)
    }
}
#endif

/* Computes SLW_ROWS rows at a time: x(rows) -= L(rows, j) x(j) for the columns j before them, then
 * the triangle of the diagonal tile. Rows below are updated in x in place. tile: the first one,
 * xs: where row 0 of the panel would be. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLI_KERNEL(tiles_forward)(const sli_step *s, sli_rows rows,
                                                              const SLV_VALUE *tile, double *xs,
                                                              double *x, double *buf) {
    const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const sl_int stride = rows.lanes;
    ptrdiff_t row;
    sl_int group, j;
    SLI_PREPARE
    for (row = first; row < height; row += SLW_ROWS) {
        const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
        const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
        const sli_rows below =
            sli_rows_of(rows.index + (row + inner - w), height - (sl_int)row - inner, stride);
        const int is_below = inner == 0 && below.count >= SLW_ROWS;
        const ptrdiff_t distance = inner == SLW_ROWS ? stride : SLW_NRHS;
        for (group = 0; group < stride; group += SLW_NRHS) {
            double *own = xs + row * stride + group, *p = inner == SLW_ROWS ? own : buf;
            const SLV_VALUE *l = tile + SLI_TILE / SLI_PARTS * (ptrdiff_t)first + lane;
            const double *xj = xs + (ptrdiff_t)first * stride + group;
            SLW_EACH(SLI_DECLARE, 0)
            if (inner == 0) {
                SLW_EACH(SLI_ZERO_ROW, 0)
            } else {
                if (inner < SLW_ROWS) {
                    SLW_NAME(rows_in)(buf, inner, own, sli_rows_of(NULL, 0, stride), x);
                }
                SLW_EACH(SLI_LOAD, p)
            }
            for (j = first; j < final;) {
                const sl_int end = j + SLI_BLOCK(final - j);
                const SLW_ENTRY *lj;
                SLI_READ_BLOCK(lj, l, end - j)
                for (; j < end; j += SLI_PARTS, xj += SLI_PARTS * (ptrdiff_t)stride) {
                    SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE);
                    SLI_APPLY_COLUMN
                    l += SLI_TILE;
                    lj += SLI_TILE;
                }
            }
            if (inner > 0) {
                SLI_TRIANGLE
            }
            if (SLI_IS_DIRECT && is_below) {
                SLW_EACH(SLI_ADD_BELOW, x + group)
                continue;
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, own, below, x + group);
            }
        }
        if (SLW_ROWS == SLI_TILE || lane + SLW_ROWS == SLI_TILE) {
            tile += SLI_TILE / SLI_PARTS * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
        }
    }
}

SLV_FUNCTION static void SLI_KERNEL(forward)(const sli_reach *R, const void *values, double *x,
                                             double *buf SLI_STRIDE_PARAMETER) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    const sli_step *s = R->steps;
    const sl_int *rows = R->rows;
    sl_int count = R->count;
    SLI_SET_STRIDE
#if SLW_GROUPS >= 8
    const int is_fetched = sli_steps_exceed_cache(count, s, stride);
#endif
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, first = SLI_TILE * s->first_tile;
        const sli_rows below = sli_rows_of(rows, s->below, stride);
        double *xs = x + ((ptrdiff_t)s->base - first) * stride;
        const SLV_VALUE *tile = L + (s->panel + sli_tile_offset(w, s->first_tile)) / SLI_PARTS;
#if SLW_GROUPS >= 8
        if (is_fetched && count > SLI_STEPS_AHEAD) {
            sli_step_prefetch(s + SLI_STEPS_AHEAD, rows + s->below + s[1].below, x, stride);
        }
#endif
#if SLI_PARTS == 1
        if (w == 1) {
            SLI_KERNEL(column_forward)(below, tile + 1, xs, x);
            continue;
        }
#endif
#if defined(SLI_SMALL)
        if (w <= SLI_TILE) {
            sl_int group;
            for (group = 0; group < stride; group += SLW_NRHS) {
                SLW_SWEEP(forward_small)(w, below, tile, xs + group, x + group);
            }
            continue;
        }
#endif
        SLI_KERNEL(tiles_forward)(s, below, tile, xs, x, buf);
    }
}

/* x(j) /= d(j) for so many columns j */
SLV_FUNCTION SLI_INLINE void SLI_KERNEL(divide)(double *xs, const double *d, sl_int columns,
                                                sl_int stride) {
    sl_int group, i;
    for (i = 0; i < columns; i++, xs += stride) {
        for (group = 0; group < stride; group += SLW_NRHS) {
            SLW_DECLARE(b)
            SLW_LOAD(b, xs + group)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + group, b)
        }
    }
}

/* Row tiles from the last to the first, SLW_ROWS rows at a time. Once the rows are final,
 * x(j) -= L(rows, j)' x(rows) for the columns j before them. tile: the end of the panel. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLI_KERNEL(tiles_backward)(const sli_step *s, sli_rows rows,
                                                               const SLV_VALUE *tile, double *xs,
                                                               double *x, double *buf) {
    const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const sl_int stride = rows.lanes;
    ptrdiff_t row;
    sl_int group, j;
    SLI_PREPARE
    for (row = SLI_TILE * sli_tiles(height) - SLW_ROWS; row >= first; row -= SLW_ROWS) {
        const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
        const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
        const sli_rows below =
            sli_rows_of(rows.index + (row + inner - w), height - (sl_int)row - inner, stride);
        const ptrdiff_t distance = inner == SLW_ROWS ? stride : SLW_NRHS;
        if (SLW_ROWS == SLI_TILE || lane + SLW_ROWS == SLI_TILE) {
            tile -= SLI_TILE / SLI_PARTS * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
        }
        for (group = 0; group < stride; group += SLW_NRHS) {
            double *own = xs + row * stride + group, *p = inner == SLW_ROWS ? own : buf;
            double *xj = xs + (ptrdiff_t) final * stride + group;
            const SLV_VALUE *l = tile + SLI_TILE / SLI_PARTS * row + lane;
            SLW_EACH(SLI_DECLARE, 0)
            if (SLI_IS_DIRECT && inner == 0 && below.count >= SLW_ROWS) {
                SLW_EACH(SLI_LOAD_BELOW, x + group)
            } else {
                if (inner < SLW_ROWS) {
                    SLW_NAME(rows_in)(buf, inner, own, below, x + group);
                }
                SLW_EACH(SLI_LOAD, p)
            }
            if (inner > 0) {
                SLI_TRIANGLE_UP
                SLW_EACH(SLI_STORE, p)
                if (inner < SLW_ROWS) {
                    SLW_NAME(rows_out)(buf, inner, own, sli_rows_of(NULL, 0, stride), x);
                }
            }
            l = tile + SLI_TILE / SLI_PARTS * (ptrdiff_t) final + lane;
            for (j = final; j > first;) {
                const sl_int begin = j - SLI_BLOCK(j - first);
                const ptrdiff_t size = SLI_TILE / SLI_PARTS * (ptrdiff_t)(j - begin);
                const SLW_ENTRY *lj;
                SLI_READ_BLOCK(lj, l - size, j - begin)
                for (lj += size; j > begin; j -= SLI_PARTS) {
                    l -= SLI_TILE;
                    lj -= SLI_TILE;
                    xj -= SLI_PARTS * (ptrdiff_t)stride;
                    SLI_PREFETCH(l, -SLI_PREFETCH_DISTANCE);
                    SLI_GATHER_COLUMN
                }
            }
        }
    }
}

SLV_FUNCTION static void SLI_KERNEL(backward)(const sli_reach *R, const void *values,
                                              const double *D, double *x,
                                              double *buf SLI_STRIDE_PARAMETER) {
    const SLV_VALUE *L = (const SLV_VALUE *)values;
    const sli_step *s = R->steps;
    const sl_int *rows = R->rows + R->n_rows;
    sl_int count = R->count;
    SLI_SET_STRIDE
#if SLW_GROUPS >= 8
    const int is_fetched = sli_steps_exceed_cache(count, s, stride);
#endif
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, first = SLI_TILE * s->first_tile;
        const SLV_VALUE *tile = L + (s->panel + sli_panel_size(w, s->below)) / SLI_PARTS;
        const sli_rows below = sli_rows_of(rows -= s->below, s->below, stride);
        const double *d = D + s->column;
        double *xs = x + ((ptrdiff_t)s->base - first) * stride;
#if SLW_GROUPS >= 8
        if (is_fetched && count > SLI_STEPS_AHEAD) {
            sli_step_prefetch(s - SLI_STEPS_AHEAD, rows - s[-1].below - s[-2].below, x, stride);
        }
#endif
#if SLI_PARTS == 1
        if (w == 1) {
            SLI_KERNEL(column_backward)(below, tile - s->below, d[0], xs, x);
            continue;
        }
#endif
#if defined(SLI_SMALL)
        if (w <= SLI_TILE) {
            sl_int group;
            for (group = 0; group < stride; group += SLW_NRHS) {
                SLW_SWEEP(backward_small)
                (w, below, tile - SLI_TILE * w, d, xs + group, x + group);
            }
            continue;
        }
#endif
        SLI_KERNEL(divide)(xs + (ptrdiff_t)first * stride, d, w - first, stride);
        SLI_KERNEL(tiles_backward)(s, below, tile, xs, x, buf);
    }
}

#if defined(SLW_GROUPS)
/* See sli_forward_kernel. */
#define SLI_GROUPED_KERNELS(lanes) \
    SLV_FUNCTION static void SLI_TABLE(forward##lanes)(const sli_reach *R, const void *values, \
                                                       double *x, double *buf) { \
        SLI_KERNEL(forward)(R, values, x, buf, lanes); \
    } \
    SLV_FUNCTION static void SLI_TABLE(backward##lanes)(const sli_reach *R, const void *values, \
                                                        const double *D, double *x, double *buf) { \
        SLI_KERNEL(backward)(R, values, D, x, buf, lanes); \
    }
#if SLW_NRHS == 2
SLI_GROUPED_KERNELS(2)
#endif
#if SLW_NRHS <= 4 && SLW_GROUPS >= 4
SLI_GROUPED_KERNELS(4)
#endif
#if SLW_NRHS <= 8 && SLW_GROUPS >= 8
SLI_GROUPED_KERNELS(8)
#endif
#if SLW_GROUPS == 64
SLI_GROUPED_KERNELS(16)
SLI_GROUPED_KERNELS(32)
SLI_GROUPED_KERNELS(64)
#endif
#undef SLI_GROUPED_KERNELS
#endif

#undef SLI_LOAD_BELOW
#undef SLI_ZERO_ROW
#undef SLI_ADD_BELOW
#undef SLI_STRIDE_PARAMETER
#undef SLI_SET_STRIDE
#undef SLI_IS_DIRECT

#endif
