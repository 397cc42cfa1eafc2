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
    double *size;          /* n: |A| |x| + |b| */
    unsigned char *memory; /* vectors of the sweeps */
    double error[SLI_TILE];
    int is_done[SLI_TILE];
    int is_slow[SLI_TILE]; /* the last correction did not halve the error */
    sl_int steps;          /* the most that a column has taken */
} sli_refinement;

static void sli_refinement_layout(sli_refinement *f, sli_block *b, sl_int columns) {
    const sli_query q = sli_query_all(f->F->S);
    const uint64_t n = (uint64_t)f->F->S->n;
    const size_t bytes = sli_vectors_bytes(&q, columns, 8);
    f->R = SLI_TAKE(b, double, n *(uint64_t)columns);
    f->T = SLI_TAKE(b, double, n *(uint64_t)columns);
    f->size = SLI_TAKE(b, double, n);
    f->memory = (unsigned char *)sli_take(b, bytes, 1);
}

/* r := b - A x. Returns the componentwise backward error of x: the least relative change of the
 * entries of A and b that makes x an exact solution. */
SLI_HOT static double sli_row_error(const sli_refinement *f, double *r, const double *x,
                                    const double *b) {
    const sl_csc *A = f->A;
    double *size = f->size, worst = 0.0;
    sl_int i, j, p;
    for (i = 0; i < A->n_cols; i++) {
        r[i] = b[i];
        size[i] = fabs(b[i]);
    }
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            i = A->i[p];
            if (sli_is_read(f->triangle, i, j)) {
                r[i] -= A->x[p] * x[j];
                size[i] += fabs(A->x[p] * x[j]);
                if (i != j) {
                    r[j] -= A->x[p] * x[i];
                    size[j] += fabs(A->x[p] * x[i]);
                }
            }
        }
    }
    for (i = 0; i < A->n_cols; i++) {
        const double error = sli_backward_error(fabs(r[i]), 0.0, 0.0, size[i]);
        worst = error <= worst || worst != worst ? worst : error;
    }
    return worst;
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

/* Applies the correction of column c, already in R. The column is done once a correction does not
 * halve its error. With L in float that takes two in a row, and the first may double it: where a
 * high condition leaves x without a digit, the first correction is as large as x, and its own
 * backward error is again that of float. Returns whether the correction was kept. */
static int sli_refine_column(sli_refinement *f, sl_int c, double *x, const double *b) {
    const size_t n = (size_t)f->F->S->n;
    double *t = f->T + n * (size_t)c, *r = f->R + n * (size_t)c, error;
    const int may_wait = sli_is_float(f->F) && !f->is_slow[c];
    size_t i;
    int is_kept;
    for (i = 0; i < n; i++) {
        t[i] = x[i] + r[i];
    }
    error = sli_row_error(f, r, t, b);
    is_kept = error < f->error[c] || (may_wait && error <= 2.0 * f->error[c]);
    f->is_slow[c] = !(error <= 0.5 * f->error[c]);
    f->is_done[c] = error <= DBL_EPSILON || (f->is_slow[c] && !(may_wait && is_kept));
    if (is_kept) {
        memcpy(x, t, n * sizeof(double));
        f->error[c] = error;
    }
    return is_kept;
}

static void sli_refine_block(sli_refinement *f, const sli_rhs *rhs, sl_int steps) {
    const size_t n = (size_t)f->F->S->n;
    sl_int c, step, todo = 0;
    for (c = 0; c < rhs->nrhs; c++) {
        f->error[c] = sli_row_error(f, f->R + n * (size_t)c, rhs->X + rhs->ldx * (size_t)c,
                                    rhs->B + rhs->ldb * (size_t)c);
        f->is_done[c] = f->error[c] <= DBL_EPSILON;
        f->is_slow[c] = 0;
        todo += !f->is_done[c];
    }
    for (step = 1; step <= steps && todo > 0; step++) {
        sli_correct(f, rhs->nrhs);
        todo = 0;
        for (c = 0; c < rhs->nrhs; c++) {
            if (!f->is_done[c]) {
                if (sli_refine_column(f, c, rhs->X + rhs->ldx * (size_t)c,
                                      rhs->B + rhs->ldb * (size_t)c)) {
                    f->steps = sli_max(f->steps, step);
                }
                todo += !f->is_done[c];
            }
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
    status = status == SL_OK ? sli_rhs_check_columns(&rhs, F->S->n, F->S->n) : status;
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
