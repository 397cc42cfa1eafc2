/* dense.h: dense blocks of the caller's, column-major or row-major */
#ifndef SLI_MATRIX_DENSE_H
#define SLI_MATRIX_DENSE_H

#include "../../public/solve.h"
#include "../base/alloc.h"

/* A dense block of the caller's: its strides between rows and between columns. */
typedef struct sli_dense {
    size_t row, column; /* one of them is 1 */
} sli_dense;

SLI_INLINE sli_dense sli_dense_by_rows(size_t row) {
    sli_dense at;
    at.row = row;
    at.column = 1;
    return at;
}

SLI_INLINE sli_dense sli_dense_by_columns(size_t column) {
    sli_dense at;
    at.row = 1;
    at.column = column;
    return at;
}

/* The strides of a leading dimension as the caller gives it: by rows if it is one of SL_ROWS. */
SLI_INLINE sli_dense sli_dense_of(size_t ld) {
    return ld & SL_ROW_MAJOR ? sli_dense_by_rows(ld & ~SL_ROW_MAJOR) : sli_dense_by_columns(ld);
}

/* Refuses a leading dimension below the rows or, by rows, the columns. */
SLI_NOINLINE static sl_status sli_dense_check(const char *wrong, size_t ld, sl_int rows,
                                              sl_int columns) {
    const size_t elements = ld & ~SL_ROW_MAJOR;
    const sl_int least = ld & SL_ROW_MAJOR ? columns : rows;
    sl_status status = SL_OK;
    if (rows > 0 && (elements < (size_t)least ||
                     elements >= SL_ROW_MAJOR / 2)) { /* that bit is for later layouts */
        /* a number below 0 that became a size_t is reported as that number */
        status = sli_fail_at(NULL, SL_ERR_ARGUMENT, -1, -1, (double)(ptrdiff_t)(2 * elements) / 2.0,
                             wrong);
        sli_error_line(NULL, least);
    }
    return status;
}

/* Names the first number of a block that is not finite. */
SLI_COLD static sl_status sli_dense_finite(const char *wrong, const double *M, size_t ld,
                                           sl_int rows, sl_int columns) {
    const sli_dense at = sli_dense_of(ld);
    sl_int i, r;
    for (r = 0; r < columns; r++) {
        for (i = 0; i < rows; i++) {
            const double x = M[(size_t)i * at.row + (size_t)r * at.column];
            if (!sli_is_finite(x)) {
                return sli_fail_at(NULL, SL_ERR_NOT_FINITE, i, r, x, wrong);
            }
        }
    }
    return SL_OK;
}

static const char sli_small_ldx[] = "ldx is below the rows of X, or nrhs with SL_ROWS";
static const char sli_small_ldb[] = "ldb is below the rows of B, or nrhs with SL_ROWS";

/* Copies one block to another. */
static void sli_dense_copy(double *to, sli_dense t, const double *from, sli_dense f, sl_int rows,
                           sl_int columns) {
    size_t i, r;
    for (r = 0; r < (size_t)columns; r++) {
        double *x = to + r * t.column;
        const double *y = from + r * f.column;
        if (t.row == 1 && f.row == 1) {
            SLI_COPY(x, y, rows);
        } else {
            for (i = 0; i < (size_t)rows; i++) {
                x[i * t.row] = y[i * f.row];
            }
        }
    }
}

/* Clears a block. */
static void sli_dense_zero(double *to, sli_dense t, sl_int rows, sl_int columns) {
    const int by_rows = t.column == 1;
    const size_t runs = (size_t)(by_rows ? rows : columns), step = by_rows ? t.row : t.column;
    size_t k;
    for (k = 0; k < runs; k++) {
        SLI_ZERO(to + k * step, by_rows ? columns : rows);
    }
}

#endif
