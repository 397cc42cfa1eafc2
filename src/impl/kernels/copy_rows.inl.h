/* copy_rows.inl.h: rows of several right-hand sides to a buffer and back */

/* Copies SLW_ROWS rows to buf where some of them are columns of the supernode and some are not, or
 * where there are fewer: `inner` rows of its columns, then `below` rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x, sl_int stride) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * stride
                                  : x + (ptrdiff_t)rows[r - inner] * stride)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_NRHS, b)
    }
}

/* Copies the rows back from buf. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x,
                                                sl_int stride) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_NRHS)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * stride : x + (ptrdiff_t)rows[r - inner] * stride,
                  b)
    }
}
