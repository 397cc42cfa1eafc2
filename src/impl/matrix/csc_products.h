/* csc_products.h: products with a matrix in compressed columns, its norm, residuals */
#ifndef SLI_MATRIX_CSC_PRODUCTS_H
#define SLI_MATRIX_CSC_PRODUCTS_H

#include "csc.h"
#include "dense.h"

/* Columns that a pass over A multiplies. */
#define SLI_PRODUCT_COLUMNS 4

/* Y += sign A X. */
typedef struct sli_product {
    const sl_csc *A;
    sl_triangle triangle; /* SL_TRIANGLE_NONE: every entry counts once, where it is; that is also
                             right for a diagonal matrix */
    double sign;
    double *Y;
    sli_dense to; /* strides of Y */
    const double *X;
    sli_dense from; /* strides of X */
} sli_product;

SLI_INLINE sli_product sli_product_of(const sl_csc *A, double *Y, size_t ldy, const double *X,
                                      size_t ldx) {
    sli_product q;
    q.A = A;
    q.triangle = SL_TRIANGLE_NONE;
    q.sign = 1.0;
    q.Y = Y;
    q.to = sli_dense_of(ldy);
    q.X = X;
    q.from = sli_dense_of(ldx);
    return q;
}

/* Y += sign A X for a constant number of columns, each of which is added up as it would be alone.
 * is_half, constant: an entry counts at its transposed place, too. Row j of Y is kept in variables
 * while column j passes: through memory, each sum would wait for the last one to be stored. */
SLI_ALWAYS_INLINE void sli_add_columns(const sli_product q, sl_int columns, int is_half) {
    const sl_csc *A = q.A;
    const double *X = q.X;
    double *Y = q.Y, x[SLI_PRODUCT_COLUMNS], y[SLI_PRODUCT_COLUMNS];
    sl_int j, p, r;
    for (j = 0; j < A->n_cols; j++) {
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            x[r] = X[(size_t)r * q.from.column + (size_t)j * q.from.row];
            y[r] = is_half ? Y[(size_t)r * q.to.column + (size_t)j * q.to.row]
                           : 0.0; /* branches untested: constant */
        }
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            const double a = q.sign * A->x[p];
            if (is_half && i == j) { /* branches untested: the same */
                SLI_UNROLL
                for (r = 0; r < columns; r++) { /* branches untested: the same */
                    y[r] += a * x[r];
                }
            } else if (!is_half || /* branches untested: the same */
                       sli_is_read(q.triangle, i, j)) {
                SLI_UNROLL
                for (r = 0; r < columns; r++) {
                    Y[(size_t)r * q.to.column + (size_t)i * q.to.row] += a * x[r];
                    if (is_half) { /* branches untested: the same */
                        y[r] += a * X[(size_t)r * q.from.column + (size_t)i * q.from.row];
                    }
                }
            }
        }
        if (is_half) { /* branches untested: the same */
            SLI_UNROLL
            for (r = 0; r < columns; r++) { /* branches untested: the same */
                Y[(size_t)r * q.to.column + (size_t)j * q.to.row] = y[r];
            }
        }
    }
}

/* Y += sign A X for one column, whose rows are any strides apart. */
SLI_NOINLINE static void sli_add_strided(const sli_product *q) {
    if (q->triangle != SL_TRIANGLE_NONE) {
        sli_add_columns(*q, 1, 1);
    } else {
        sli_add_columns(*q, 1, 0);
    }
}

/* Y += sign A X for nrhs columns. Strides of rows that are constant, 1, save a sixth of the time of
 * columns. */
SLI_HOT static void sli_add_product(const sli_product *given, sl_int nrhs) {
    const int is_half = given->triangle != SL_TRIANGLE_NONE;
    const int by_columns = given->to.row == 1 && given->from.row == 1;
    sli_product q = *given, near = q;
    sl_int r, step;
    near.to = sli_dense_by_columns(q.to.column);
    near.from = sli_dense_by_columns(q.from.column);
    for (r = 0; r < nrhs; r += step) {
        step = by_columns && nrhs - r >= SLI_PRODUCT_COLUMNS ? SLI_PRODUCT_COLUMNS : 1;
        near.X = q.X;
        near.Y = q.Y;
        if (!by_columns) {
            sli_add_strided(&q);
        } else if (step == 1 && is_half) {
            sli_add_columns(near, 1, 1);
        } else if (step == 1) {
            sli_add_columns(near, 1, 0);
        } else if (is_half) {
            sli_add_columns(near, SLI_PRODUCT_COLUMNS, 1);
        } else {
            sli_add_columns(near, SLI_PRODUCT_COLUMNS, 0);
        }
        q.Y += (size_t)step * q.to.column;
        q.X += (size_t)step * q.from.column;
    }
}

/* What is wrong with a matrix of a product, of which sizes and p alone are looked at, or NULL. */
static const char *sli_product_wrong(const sl_csc *A, sl_int nrhs, int is_square) {
    return A == NULL                             ? "A is NULL"
           : nrhs < 0                            ? "nrhs is below 0"
           : A->n_rows < 0 || A->n_cols < 0      ? "A has a size below 0"
           : A->n_cols > 0 && A->p == NULL       ? "A.p is NULL"
           : sli_nnz(A) > 0 && A->i == NULL      ? "A.i is NULL"
           : sli_nnz(A) > 0 && A->x == NULL      ? "A.x is NULL"
           : is_square && A->n_rows != A->n_cols ? "A is not square"
                                                 : NULL;
}

SL_API sl_status sl_csc_multiply(const sl_csc *A, sl_reading reading, double *Y, size_t ldy,
                                 const double *X, size_t ldx, sl_int nrhs) {
    sli_product q;
    sl_status status = sli_argument(reading != SL_AS_SYMMETRIC && reading != SL_AS_STORED
                                        ? "reading is not a value of sl_reading"
                                        : sli_product_wrong(A, nrhs, reading == SL_AS_SYMMETRIC));
    if (status != SL_OK || nrhs == 0 || A->n_rows == 0) {
        return status;
    }
    status = sli_argument(Y == NULL                    ? "Y is NULL"
                          : A->n_cols > 0 && X == NULL ? "X is NULL"
                          : A->n_cols > 0 && X == Y    ? "X is Y"
                                                       : NULL);
    status = status == SL_OK ? sli_dense_check("ldy is below the rows of Y, or nrhs with SL_ROWS",
                                               ldy, A->n_rows, nrhs)
                             : status;
    status = status == SL_OK ? sli_dense_check(sli_small_ldx, ldx, A->n_cols, nrhs) : status;
    if (status != SL_OK) {
        return status;
    }
    q = sli_product_of(A, Y, ldy, X, ldx);
    q.triangle = reading == SL_AS_SYMMETRIC ? sli_triangle_scan(A) : SL_TRIANGLE_NONE;
    sli_dense_zero(Y, q.to, A->n_rows, nrhs);
    sli_add_product(&q, nrhs);
    return SL_OK;
}

/* The largest magnitude of n numbers, step elements apart; NaN if one of them is. As integers,
 * magnitudes are in their order, and NaN is the largest. */
SLI_NOINLINE static double sli_largest(const double *x, size_t step, sl_int n) {
    uint64_t largest = 0;
    double found;
    sl_int i;
    for (i = 0; i < n; i++) {
        const double size = fabs(x[(size_t)i * step]);
        uint64_t bits;
        memcpy(&bits, &size, sizeof bits);
        largest = bits > largest ? bits : largest;
    }
    memcpy(&found, &largest, sizeof found);
    return found;
}

/* The largest row sum of |A| for a symmetric A; NaN if A has one. sums: n numbers of scratch, step
 * elements apart. */
static double sli_csc_norm(const sl_csc *A, sl_triangle triangle, double *sums, size_t step) {
    sl_int j, p;
    for (j = 0; j < A->n_cols; j++) {
        sums[(size_t)j * step] = 0.0;
    }
    for (j = 0; j < A->n_cols; j++) {
        double sum = sums[(size_t)j * step];
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            if (sli_is_read(triangle, A->i[p], j)) {
                sum += fabs(A->x[p]);
                /* to that of column j nothing is added */
                sums[(size_t)A->i[p] * step] += fabs(A->x[p]);
            }
        }
        sums[(size_t)j * step] = sum;
    }
    return sli_largest(sums, step, A->n_cols);
}

/* ||r|| / (||A|| ||x|| + ||b||). NaN for an infinite denominator: the quotient would be 0, which
 * says nothing about r. */
static double sli_backward_error(double r, double a, double x, double b) {
    const double size = a * x + b;
    return r == 0.0 ? 0.0 : sli_is_finite(size) ? r / size : (double)NAN;
}

SL_API sl_status sl_csc_residual(const sl_csc *A, double *R, size_t ldr, double *backward_error,
                                 const double *X, size_t ldx, const double *B, size_t ldb,
                                 sl_int nrhs) {
    const sli_dense to = sli_dense_of(ldr), x = sli_dense_of(ldx), b = sli_dense_of(ldb);
    double norm = 0.0;
    sl_int r, n;
    sli_product q;
    sl_status status = sli_argument(sli_product_wrong(A, nrhs, 1));
    if (status != SL_OK) {
        return status;
    }
    n = A->n_cols;
    if (nrhs == 0 || n == 0) {
        for (r = 0; r < nrhs && backward_error != NULL; r++) {
            backward_error[r] = 0.0;
        }
        return SL_OK;
    }
    status =
        sli_argument(B == NULL                          ? "B is NULL"
                     : R == NULL                        ? "R is NULL"
                     : X == NULL                        ? "X is NULL"
                     : R == X                           ? "R is X"
                     : R == B && ldr != ldb             ? "R is B with another leading dimension"
                     : R == B && backward_error != NULL ? "R is B, and backward_error is wanted"
                                                        : NULL);
    status = status == SL_OK ? sli_dense_check(sli_small_ldb, ldb, n, nrhs) : status;
    status = status == SL_OK
                 ? sli_dense_check("ldr is below the rows of R, or nrhs with SL_ROWS", ldr, n, nrhs)
                 : status;
    status = status == SL_OK ? sli_dense_check(sli_small_ldx, ldx, n, nrhs) : status;
    if (status != SL_OK) {
        return status;
    }
    q = sli_product_of(A, R, ldr, X, ldx);
    q.triangle = sli_triangle_scan(A);
    q.sign = -1.0;
    if (backward_error != NULL) {
        norm = sli_csc_norm(A, q.triangle, R, to.row);
    }
    if (R != B) {
        sli_dense_copy(R, to, B, b, n, nrhs);
    }
    sli_add_product(&q, nrhs);
    for (r = 0; r < nrhs && backward_error != NULL; r++) {
        const size_t c = (size_t)r;
        backward_error[r] = sli_backward_error(sli_largest(R + c * to.column, to.row, n), norm,
                                               sli_largest(X + c * x.column, x.row, n),
                                               sli_largest(B + c * b.column, b.row, n));
    }
    return SL_OK;
}

#endif
