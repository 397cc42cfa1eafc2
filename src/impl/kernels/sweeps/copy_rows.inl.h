/* copy_rows.inl.h: rows of several right-hand sides to a buffer and back */

/* Copies SLW_ROWS rows to buf where some of them are columns of the supernode and some are not, or
 * where there are fewer: `inner` rows of its columns, then the rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, const double *own,
                                               sli_rows below, const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below.count) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * below.lanes
                                  : x + (ptrdiff_t)below.index[r - inner] * below.lanes)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_NRHS, b)
    }
}

/* Copies the rows of the supernode's columns back from buf, and adds those below to x. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, double *own,
                                                sli_rows below, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    SLW_DECLARE(c)
    for (r = 0; r < SLW_ROWS && r < inner + below.count; r++) {
        double *to = r < inner ? own + (ptrdiff_t)r * below.lanes
                               : x + (ptrdiff_t)below.index[r - inner] * below.lanes;
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_NRHS)
        if (r >= inner) {
            SLW_LOAD(c, to)
            SLW_ADD(b, c)
        }
        SLW_STORE(to, b)
    }
}
