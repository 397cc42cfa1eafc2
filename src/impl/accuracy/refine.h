/* refine.h: sl_factor_refine: refinement by the componentwise backward error */
#ifndef SLI_ACCURACY_REFINE_H
#define SLI_ACCURACY_REFINE_H

#include "../../public/accuracy.h"
#include "../matrix/csc_products.h"
#include "../factor/factor.h"
#include "../solve/plan.h"

/* A block of up to 8 right-hand sides in progress. */
typedef struct sli_refinement {
    const sl_factor *F;
    const sl_csc *A;
    sl_triangle triangle;
    double *R, *T;         /* n x columns: residuals, then corrections; trial solutions */
    double *size;          /* n x up to SLI_PRODUCT_COLUMNS: |A| |x| + |b| */
    unsigned char *memory; /* vectors of the sweeps */
    double error[SLI_TILE];
    int is_slow[SLI_TILE];   /* the last correction did not halve the error */
    sl_int todo;             /* columns that are not done: the first ones of R and T, which are */
    sl_int column[SLI_TILE]; /* these of the block */
    sl_int steps;            /* the most that a column has taken */
} sli_refinement;

static void sli_refinement_layout(sli_refinement *f, sli_block *b, sl_int columns) {
    const sli_query q = sli_query_all(f->F->S);
    const uint64_t n = (uint64_t)f->F->S->n;
    const size_t bytes = sli_vectors_bytes(&q, columns, 8);
    f->R = SLI_TAKE(b, double, n *(uint64_t)columns);
    f->T = SLI_TAKE(b, double, n *(uint64_t)columns);
    f->size = SLI_TAKE(b, double, n *(uint64_t)sli_min(columns, SLI_PRODUCT_COLUMNS));
    f->memory = (unsigned char *)sli_take(b, bytes, 1);
}

/* R -= A X and size += |A| |X| for a constant number of columns, each of which is added up as it
 * would be alone. */
SLI_ALWAYS_INLINE void sli_subtract_columns(const sli_refinement *f, double *R, const double *X,
                                            sl_int columns) {
    const sl_csc *A = f->A;
    const size_t n = (size_t)A->n_cols;
    double x[SLI_PRODUCT_COLUMNS], r[SLI_PRODUCT_COLUMNS], size[SLI_PRODUCT_COLUMNS];
    double *sizes = f->size;
    sl_int j, p, c;
    for (j = 0; j < A->n_cols; j++) {
        SLI_UNROLL
        for (c = 0; c < columns; c++) {
            x[c] = X[(size_t)c * n + (size_t)j];
            r[c] = R[(size_t)c * n + (size_t)j];
            size[c] = sizes[(size_t)c * n + (size_t)j];
        }
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            const double a = A->x[p];
            if (i == j) {
                SLI_UNROLL
                for (c = 0; c < columns; c++) {
                    r[c] -= a * x[c];
                    size[c] += fabs(a * x[c]);
                }
            } else if (sli_is_read(f->triangle, i, j)) {
                SLI_UNROLL
                for (c = 0; c < columns; c++) {
                    const double other = a * X[(size_t)c * n + (size_t)i];
                    R[(size_t)c * n + (size_t)i] -= a * x[c];
                    sizes[(size_t)c * n + (size_t)i] += fabs(a * x[c]);
                    r[c] -= other;
                    size[c] += fabs(other);
                }
            }
        }
        SLI_UNROLL
        for (c = 0; c < columns; c++) {
            R[(size_t)c * n + (size_t)j] = r[c];
            sizes[(size_t)c * n + (size_t)j] = size[c];
        }
    }
}

/* For each column to do, the c-th of T and of R: R := B - A T, and error[c], the componentwise
 * backward error of T: the least relative change of the entries of A and b that makes it an exact
 * solution. */
SLI_HOT static void sli_row_errors(const sli_refinement *f, const sli_rhs *rhs, double *error) {
    const sli_dense at = sli_dense_of(rhs->ldb);
    const size_t n = (size_t)f->A->n_cols;
    size_t i;
    sl_int first, c, step;
    for (first = 0; first < f->todo; first += step) {
        double *R = f->R + n * (size_t)first;
        const double *T = f->T + n * (size_t)first;
        step = f->todo - first >= SLI_PRODUCT_COLUMNS ? SLI_PRODUCT_COLUMNS : 1;
        for (c = 0; c < step; c++) {
            const double *b = rhs->B + at.column * (size_t)f->column[first + c];
            double *r = R + n * (size_t)c, *size = f->size + n * (size_t)c;
            for (i = 0; i < n; i++) {
                r[i] = b[i * at.row];
                size[i] = fabs(b[i * at.row]);
            }
        }
        if (step == 1) {
            sli_subtract_columns(f, R, T, 1);
        } else {
            sli_subtract_columns(f, R, T, SLI_PRODUCT_COLUMNS);
        }
        for (c = 0; c < step; c++) {
            const double *r = R + n * (size_t)c;
            double *size = f->size + n * (size_t)c;
            for (i = 0; i < n; i++) { /* sli_backward_error, without branches: many r are 0 */
                const double d = r[i] == 0.0 ? 1.0 : size[i];
                size[i] = fabs(r[i]) / d + (d - d);
            }
            error[first + c] = sli_largest(size, 1, f->A->n_cols);
        }
    }
}

/* R := A^-1 R by the factor, whether consistent or not. */
static void sli_correct(const sli_refinement *f, sl_int columns) {
    const sli_query q = sli_query_all(f->F->S);
    const size_t n = (size_t)f->F->S->n;
    const sli_rhs rhs = sli_rhs_of(f->R, n, f->R, n, columns);
    const sli_vectors v = sli_vectors_of(&q, columns, f->memory);
    sli_pack(f->F, &q, v.y, &rhs);
    sli_sweep_forward(f->F, &q, &v, columns);
    sli_sweep_backward(f->F, &q, &v, columns);
    sli_unpack(f->F, &q, &rhs, v.x);
}

/* Judges a correction of the k-th column to do, which has led from x to t with this error. The
 * column is done once a correction does not halve its error. With L in float that takes two in a
 * row, and the first may double it: where a high condition leaves x without a digit, the first
 * correction is as large as x, and its own backward error is again that of float. Returns whether
 * it is done. */
static int sli_refine_column(sli_refinement *f, const sli_rhs *rhs, sl_int k, double error,
                             sl_int step) {
    const sl_int c = f->column[k], n = f->F->S->n;
    const int may_wait = sli_is_float(f->F) && !f->is_slow[c];
    const int is_kept = error < f->error[c] || (may_wait && error <= 2.0 * f->error[c]);
    f->is_slow[c] = !(error <= 0.5 * f->error[c]);
    if (is_kept) {
        const sli_dense x = sli_dense_of(rhs->ldx), t = sli_dense_by_columns((size_t)n);
        sli_dense_copy(rhs->X + x.column * (size_t)c, x, f->T + t.column * (size_t)k, t, n, 1);
        f->error[c] = error;
        f->steps = sli_max(f->steps, step);
    }
    return error <= DBL_EPSILON || (f->is_slow[c] && !(may_wait && is_kept));
}

/* Leaves out the columns that are done; the residuals of the others close up. */
static void sli_refine_rest(sli_refinement *f, const int *is_done) {
    const size_t n = (size_t)f->F->S->n;
    sl_int k, rest = 0;
    for (k = 0; k < f->todo; k++) {
        if (!is_done[k]) {
            if (rest < k) {
                memcpy(f->R + n * (size_t)rest, f->R + n * (size_t)k, n * sizeof(double));
            }
            f->column[rest++] = f->column[k];
        }
    }
    f->todo = rest;
}

static void sli_refine_block(sli_refinement *f, const sli_rhs *rhs, sl_int steps) {
    const size_t n = (size_t)f->F->S->n;
    const sli_dense at = sli_dense_of(rhs->ldx);
    double error[SLI_TILE];
    int is_done[SLI_TILE];
    sl_int c, step;
    size_t i;
    f->todo = rhs->nrhs;
    for (c = 0; c < rhs->nrhs; c++) {
        f->column[c] = c;
        f->is_slow[c] = 0;
    }
    sli_dense_copy(f->T, sli_dense_by_columns(n), rhs->X, at, f->F->S->n, rhs->nrhs);
    sli_row_errors(f, rhs, f->error);
    for (c = 0; c < rhs->nrhs; c++) {
        is_done[c] = f->error[c] <= DBL_EPSILON;
    }
    for (step = 1; step <= steps; step++) {
        sli_refine_rest(f, is_done);
        if (f->todo == 0) {
            return;
        }
        sli_correct(f, rhs->nrhs); /* the bits depend on how many there are */
        for (c = 0; c < f->todo; c++) {
            const double *x = rhs->X + at.column * (size_t)f->column[c], *r = f->R + n * (size_t)c;
            double *t = f->T + n * (size_t)c;
            for (i = 0; i < n; i++) {
                t[i] = x[i * at.row] + r[i];
            }
        }
        sli_row_errors(f, rhs, error);
        for (c = 0; c < f->todo; c++) {
            is_done[c] = sli_refine_column(f, rhs, c, error[c], step);
        }
    }
}

/* The larger of two errors; NaN if either is. */
SLI_INLINE double sli_max_error(double a, double b) {
    return a != a || a > b ? a : b;
}

/* Ends a refinement of at most `most` steps. Without any it was asked to measure only. */
SLI_NOINLINE static sl_status sli_refine_done(const sl_factor *F, sl_stats *stats, sl_int most,
                                              sl_int steps, double error) {
    if (stats != NULL) {
        stats->refine.steps = steps;
        stats->refine.backward_error = error;
    }
    return most > 0 && !(error <= F->limits.error) && sli_is_finite(F->limits.error)
               ? sli_fail_at(NULL, SL_ERR_INACCURATE, -1, -1, error,
                             "the backward error is above options.error_limit")
               : SL_OK;
}

SL_API sl_status sl_factor_refine(const sl_factor *F, const sl_csc *A, double *X, size_t ldx,
                                  const double *B, size_t ldb, sl_int nrhs, sl_int steps,
                                  sl_work *W, sl_stats *stats) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    sli_block b = {NULL, 0};
    sli_refinement f;
    sl_work own;
    sl_status status;
    double worst = 0.0;
    sl_int r, c;
    sli_stats_clear_error(stats);
    status = sli_argument(F == NULL ? "F is NULL" : steps < 0 ? "steps is below 0" : NULL);
    status = status == SL_OK ? sli_rhs_check(&rhs, F->S->n, F->S->n) : status;
    if (status == SL_OK && X == B && nrhs > 0 && F->S->n > 0) {
        status = sli_argument("X is B");
    }
    status = status == SL_OK ? sli_factor_fits(F, A) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(f);
    f.F = F;
    f.A = A;
    f.triangle = F->S->stats.symbolic.triangle;
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    sli_refinement_layout(&f, &b, sli_min(nrhs, 8));
    status = nrhs > 0 ? sli_work_block(W, &b) : SL_OK;
    if (status == SL_OK && nrhs > 0 && F->S->n > 0) { /* without rows all arrays are NULL */
        sli_refinement_layout(&f, &b, sli_min(nrhs, 8));
        for (r = 0; r < nrhs; r += sli_min(8, nrhs - r)) {
            const sli_rhs block = sli_rhs_part(&rhs, r, sli_min(8, nrhs - r));
            sli_refine_block(&f, &block, steps);
            for (c = 0; c < block.nrhs; c++) {
                worst = sli_max_error(f.error[c], worst);
            }
        }
    }
    sli_free(&own.allocator, own.block);
    status = status == SL_OK ? sli_refine_done(F, stats, steps, f.steps, worst) : status;
    return sli_report(stats, status);
}

#endif
