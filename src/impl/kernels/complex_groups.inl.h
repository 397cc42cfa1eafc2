/* complex_groups.inl.h: sweeps over L of a complex matrix for 2 or more right-hand sides */

/* As multi_rhs.inl.h with SLW_GROUPS, with the storage of complex_rows.inl.h. A row of x has
 * `stride` right-hand sides, any multiple of SLW_NRHS. Each entry of L is applied to the real and
 * to the imaginary parts of a group: two multiplications for each number that is read.
 *
 * The file that includes this says for how many right-hand sides it is the best: 2 with SLW_NRHS 2,
 * and SLW_LANES_4, SLW_LANES_8, SLW_LANES_16, which stands for 32 too. */
#if SLW_ROWS == 8
#define SLI_EACH SLI_EACH8
#define SLI_PAIRS(op, l) op(0, 1, l) op(2, 3, l) op(4, 5, l) op(6, 7, l)
#define SLI_PAIRS_AGAIN(op, k, m) op(0, 1, k, m) op(2, 3, k, m) op(4, 5, k, m) op(6, 7, k, m)
#define SLI_PAIRS_DOWN(op, l) op(6, 7, l) op(4, 5, l) op(2, 3, l) op(0, 1, l)
#else
#define SLI_EACH SLI_EACH4
#define SLI_PAIRS(op, l) op(0, 1, l) op(2, 3, l)
#define SLI_PAIRS_AGAIN(op, k, m) op(0, 1, k, m) op(2, 3, k, m)
#define SLI_PAIRS_DOWN(op, l) op(2, 3, l) op(0, 1, l)
#endif

#define SLI_DECLARE(r, unused) SLW_DECLARE(a##r)
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*distance)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*distance, a##r)
#define SLI_LOAD_BELOW(r, p) SLW_LOAD(a##r, (p) + (ptrdiff_t)below_rows[r] * stride)
#define SLI_STORE_BELOW(r, p) SLW_STORE((p) + (ptrdiff_t)below_rows[r] * stride, a##r)
#define SLI_NEGATE(n, c) \
    SLW_ZERO(n) \
    SLW_FNMA(n, one, c)
/* a(r) + i a(s) -= (l(r) + i l(s)) (b + i c), n = -c */
#define SLI_SUBTRACT(r, s, l, b, c, n) \
    SLW_FNMA(a##r, (l)[r], b) \
    SLW_FNMA(a##s, (l)[r], c) \
    SLW_FNMA(a##r, (l)[s], n) \
    SLW_FNMA(a##s, (l)[s], b)
#define SLI_APPLY(r, s, l) SLI_SUBTRACT(r, s, l, b, c, n)
/* b + e + i (c - n) -= (l(r) - i l(s)) (a(r) + i a(s)) */
#define SLI_GATHER(r, s, l) \
    SLW_FNMA(b, (l)[r], a##r) \
    SLW_FNMA(c, (l)[r], a##s) \
    SLW_FNMA(e, (l)[s], a##s) \
    SLW_FNMA(n, (l)[s], a##r)
/* Inside the diagonal block: the pair of columns k, m updates the rows below it, the pair of rows
 * k, m the columns before it. */
#define SLI_BELOW(r, s, k, m) \
    if ((r) > (k)) { \
        SLI_SUBTRACT(r, s, l + SLI_TILE / 2 * (k), a##k, a##m, n) \
    }
#define SLI_COLUMN(k, m, unused) \
    if ((k) < inner) { \
        SLI_NEGATE(n, a##m) \
        SLI_PAIRS_AGAIN(SLI_BELOW, k, m) \
    }
#define SLI_BEFORE(i, j, k, m) \
    if ((i) < (k) && (i) < inner) { \
        const double *at = l + SLI_TILE / 2 * (i); \
        SLW_FNMA(a##i, at[k], a##k) \
        SLW_FNMA(a##i, at[m], a##m) \
        SLW_FNMA(a##j, at[k], a##m) \
        SLW_FNMA(a##j, at[m], n) \
    }
#define SLI_ROW(k, m, unused) \
    SLI_NEGATE(n, a##k) \
    SLI_PAIRS_AGAIN(SLI_BEFORE, k, m)

SLV_FUNCTION static void SLW_NAME(complex_group_forward)(sl_int count, const sli_step *s,
                                                         const sl_int *rows, const void *values,
                                                         double *x, double *buf, sl_int stride) {
    const double *L = (const double *)values, one = 1.0;
    const int is_fetched = stride >= 8 && sli_steps_exceed_cache(count, s, stride);
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + (s->panel + sli_tile_offset(w, s->first_tile)) / 2;
        double *xs = x + ((ptrdiff_t)s->base - first) * stride;
        ptrdiff_t row;
        sl_int group, j;
        if (is_fetched && count > SLI_STEPS_AHEAD) {
            sli_step_prefetch(s + SLI_STEPS_AHEAD, rows + s->below + s[1].below, x, stride);
        }
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int below = height - (sl_int)row - inner;
            const int is_below = inner == 0 && below >= SLW_ROWS;
            const ptrdiff_t distance = inner == SLW_ROWS ? stride : SLW_NRHS;
            const sl_int *below_rows = rows + (row + inner - w);
            for (group = 0; group < stride; group += SLW_NRHS) {
                double *own = xs + row * stride + group, *p = inner == SLW_ROWS ? own : buf;
                const double *l = tile + SLI_TILE / 2 * (ptrdiff_t)first + lane;
                const double *xj = xs + (ptrdiff_t)first * stride + group;
                SLI_EACH(SLI_DECLARE, 0)
                SLW_DECLARE(b)
                SLW_DECLARE(c)
                SLW_DECLARE(n)
                if (is_below) {
                    SLI_EACH(SLI_LOAD_BELOW, x + group)
                } else {
                    if (inner < SLW_ROWS) {
                        SLW_NAME(rows_in)(buf, inner, below, below_rows, own, x + group, stride);
                    }
                    SLI_EACH(SLI_LOAD, p)
                }
                for (j = first; j < final; j += 2, l += SLI_TILE, xj += 2 * (ptrdiff_t)stride) {
                    SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE);
                    SLW_LOAD(b, xj)
                    SLW_LOAD(c, xj + stride)
                    SLI_NEGATE(n, c)
                    SLI_PAIRS(SLI_APPLY, l)
                }
                if (is_below) {
                    SLI_EACH(SLI_STORE_BELOW, x + group)
                    continue;
                }
                SLI_PAIRS(SLI_COLUMN, 0)
                SLI_EACH(SLI_STORE, p)
                if (inner < SLW_ROWS) {
                    SLW_NAME(rows_out)(buf, inner, below, below_rows, own, x + group, stride);
                }
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE / 2 * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(complex_group_backward)(sl_int count, const sli_step *s,
                                                          const sl_int *rows_end,
                                                          const void *values, const double *D,
                                                          double *x, double *buf, sl_int stride) {
    const double *L = (const double *)values, one = 1.0;
    const int is_fetched = stride >= 8 && sli_steps_exceed_cache(count, s, stride);
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + (s->panel + sli_panel_size(w, s->below)) / 2;
        const double *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * stride;
        ptrdiff_t row;
        sl_int group, i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        SLW_DECLARE(e)
        SLW_DECLARE(n)
        rows_end -= s->below;
        if (is_fetched && count > SLI_STEPS_AHEAD) {
            sli_step_prefetch(s - SLI_STEPS_AHEAD, rows_end - s[-1].below - s[-2].below, x, stride);
        }
        for (i = first; i < w; i++) {
            for (group = 0; group < stride; group += SLW_NRHS) {
                SLW_LOAD(b, xs + (ptrdiff_t)i * stride + group)
                SLW_DIVIDE(b, d[i])
                SLW_STORE(xs + (ptrdiff_t)i * stride + group, b)
            }
        }
        for (row = SLI_TILE * (ptrdiff_t)sli_tiles(height) - SLW_ROWS; row >= first;
             row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int below = height - (sl_int)row - inner;
            const ptrdiff_t distance = inner == SLW_ROWS ? stride : SLW_NRHS;
            const sl_int *below_rows = rows_end + (row + inner - w);
            if (lane + SLW_ROWS == SLI_TILE) {
                tile -= SLI_TILE / 2 * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
            for (group = 0; group < stride; group += SLW_NRHS) {
                double *own = xs + row * stride + group, *p = inner == SLW_ROWS ? own : buf;
                double *xj = xs + (ptrdiff_t) final * stride + group;
                const double *l = tile + SLI_TILE / 2 * row + lane;
                SLI_EACH(SLI_DECLARE, 0)
                if (inner == 0 && below >= SLW_ROWS) {
                    SLI_EACH(SLI_LOAD_BELOW, x + group)
                } else {
                    if (inner < SLW_ROWS) {
                        SLW_NAME(rows_in)(buf, inner, below, below_rows, own, x + group, stride);
                    }
                    SLI_EACH(SLI_LOAD, p)
                }
                if (inner > 0) {
                    SLI_PAIRS_DOWN(SLI_ROW, 0)
                    SLI_EACH(SLI_STORE, p)
                    if (inner < SLW_ROWS) {
                        SLW_NAME(rows_out)(buf, inner, 0, NULL, own, x, stride);
                    }
                }
                l = tile + SLI_TILE / 2 * (ptrdiff_t) final + lane;
                for (j = final; j > first; j -= 2) {
                    l -= SLI_TILE;
                    xj -= 2 * (ptrdiff_t)stride;
                    SLI_PREFETCH(l, -SLI_PREFETCH_DISTANCE);
                    SLW_LOAD(b, xj)
                    SLW_LOAD(c, xj + stride)
                    SLW_ZERO(e)
                    SLW_ZERO(n)
                    SLI_PAIRS(SLI_GATHER, l)
                    SLW_ADD(b, e)
                    SLW_FNMA(c, one, n)
                    SLW_STORE(xj, b)
                    SLW_STORE(xj + stride, c)
                }
            }
        }
    }
}

/* See sli_forward_kernel. */
#define SLI_GROUP_KERNELS(lanes) \
    SLV_FUNCTION static void SLV_NAME(complex_forward##lanes)( \
        sl_int count, const sli_step *s, const sl_int *rows, const void *values, double *x, \
        double *buf) { \
        SLW_NAME(complex_group_forward)(count, s, rows, values, x, buf, lanes); \
    } \
    SLV_FUNCTION static void SLV_NAME(complex_backward##lanes)( \
        sl_int count, const sli_step *s, const sl_int *rows_end, const void *values, \
        const double *D, double *x, double *buf) { \
        SLW_NAME(complex_group_backward)(count, s, rows_end, values, D, x, buf, lanes); \
    }
#if SLW_NRHS == 2
SLI_GROUP_KERNELS(2)
#endif
#if defined(SLW_LANES_4)
SLI_GROUP_KERNELS(4)
#endif
#if defined(SLW_LANES_8)
SLI_GROUP_KERNELS(8)
#endif
#if defined(SLW_LANES_16)
SLI_GROUP_KERNELS(16)
SLI_GROUP_KERNELS(32)
#endif

#undef SLI_EACH
#undef SLI_PAIRS
#undef SLI_PAIRS_AGAIN
#undef SLI_PAIRS_DOWN
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_LOAD_BELOW
#undef SLI_STORE_BELOW
#undef SLI_NEGATE
#undef SLI_SUBTRACT
#undef SLI_APPLY
#undef SLI_GATHER
#undef SLI_BELOW
#undef SLI_COLUMN
#undef SLI_BEFORE
#undef SLI_ROW
#undef SLI_GROUP_KERNELS
#undef SLW_LANES_4
#undef SLW_LANES_8
#undef SLW_LANES_16
#undef SLW_NAME
#undef SLW_NRHS
