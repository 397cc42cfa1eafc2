/* interleave.inl.h: 8 columns of a dense block to interleaved rows of a vector, and back */

#if !defined(SLV_PLAIN)
#define SLI_UNROLL_ROWS SLI_UNROLL
#else
#define SLI_UNROLL_ROWS /* in plain C it wins 2 % of a solve and takes 2 kB */
#endif

/* Both sides are prefetched: the caller's order jumps about in the vector, and a column of the
 * block is left after a chunk of rows, before the hardware has learned to read it ahead. Packing at
 * n = 1e6 is 1.5 times faster for the second. */
#define SLI_ROWS_BEFORE 32
#define SLI_BYTES_BEFORE 512
#define SLI_INTERLEAVE_PREFETCH(of_vector) \
    if ((of_vector) && k + SLI_ROWS_BEFORE + SLI_TILE <= count) { \
        SLI_UNROLL_ROWS \
        for (r = 0; r < SLI_TILE; r++) { \
            SLI_PREFETCH(v + (ptrdiff_t)index[k + SLI_ROWS_BEFORE + r] * stride, 0); \
        } \
    } \
    SLI_UNROLL_ROWS \
    for (r = 0; r < SLI_TILE; r++) { \
        SLI_PREFETCH(M + (size_t)r * ldm + k, SLI_BYTES_BEFORE); \
    }

/* See sli_interleave_kernel. Blocks of 8 x 8 are transposed in registers. */
SLV_FUNCTION static void SLV_NAME(interleave)(double *v, sli_rows rows, const double *M, size_t ldm,
                                              int is_streamed) {
    const sl_int *index = rows.index;
    const sl_int count = rows.count, stride = rows.lanes;
    SLI_ALIGNED(double from[SLI_TILE * SLI_TILE]);
    SLI_ALIGNED(double to[SLI_TILE * SLI_TILE]);
    sl_int k, r;
    SLV_DECLARE(a)
    for (k = 0; k + SLI_TILE <= count; k += SLI_TILE) {
        SLI_INTERLEAVE_PREFETCH(!is_streamed)
        SLI_UNROLL_ROWS
        for (r = 0; r < SLI_TILE; r++) {
            SLV_LOAD_PART(a, M + (size_t)r * ldm + k, SLI_TILE, 0.0)
            SLV_STORE(from + SLI_TILE * r, a)
        }
        SLV_TRANSPOSE(to, from)
        SLI_UNROLL_ROWS
        for (r = 0; r < SLI_TILE; r++) {
            SLV_LOAD(a, to + SLI_TILE * r)
            if (is_streamed) {
                SLV_STREAM(v + (ptrdiff_t)index[k + r] * stride, a)
            } else {
                SLV_STORE(v + (ptrdiff_t)index[k + r] * stride, a)
            }
        }
    }
    if (is_streamed) {
        SLV_STREAM_END
    }
    for (; k < count; k++) {
        for (r = 0; r < SLI_TILE; r++) {
            v[(ptrdiff_t)index[k] * stride + r] = M[(size_t)r * ldm + (size_t)k];
        }
    }
}

SLV_FUNCTION static void SLV_NAME(separate)(double *M, size_t ldm, const double *v, sli_rows rows) {
    const sl_int *index = rows.index;
    const sl_int count = rows.count, stride = rows.lanes;
    SLI_ALIGNED(double from[SLI_TILE * SLI_TILE]);
    SLI_ALIGNED(double to[SLI_TILE * SLI_TILE]);
    sl_int k, r;
    SLV_DECLARE(a)
    for (k = 0; k + SLI_TILE <= count; k += SLI_TILE) {
        SLI_INTERLEAVE_PREFETCH(1)
        SLI_UNROLL_ROWS
        for (r = 0; r < SLI_TILE; r++) {
            SLV_LOAD(a, v + (ptrdiff_t)index[k + r] * stride)
            SLV_STORE(from + SLI_TILE * r, a)
        }
        SLV_TRANSPOSE(to, from)
        SLI_UNROLL_ROWS
        for (r = 0; r < SLI_TILE; r++) {
            SLV_LOAD(a, to + SLI_TILE * r)
            SLV_STORE_ANY(M + (size_t)r * ldm + k, a)
        }
    }
    for (; k < count; k++) {
        for (r = 0; r < SLI_TILE; r++) {
            M[(size_t)r * ldm + (size_t)k] = v[(ptrdiff_t)index[k] * stride + r];
        }
    }
}

#undef SLI_ROWS_BEFORE
#undef SLI_BYTES_BEFORE
#undef SLI_INTERLEAVE_PREFETCH
#undef SLI_UNROLL_ROWS
