/* mex_factors.h: commands of sparse_local_mex: factors, solves, what is in a factor, changes */
#ifndef SL_OCTAVE_MEX_FACTORS_H
#define SL_OCTAVE_MEX_FACTORS_H

#include "mex_options.h"

/* ---- factors ---- */

/* id = create(A, {options}) */
static sl_status create(call *c) {
    sl_options o;
    sl_matrix *indices;
    sl_csc A;
    object *f;
    int pivoted;
    sl_status status;
    (void)new_output(c, 0, 1, 1);
    check_matrix(c->in[0]);
    options_of(c->in[1], &o, &pivoted, count_of(mxGetN(c->in[0])));
    f = new_object(FACTOR);
    status = matrix_of(c->in[0], &indices, &A);
    if (status == SL_OK) {
        status = pivoted ? sl_symbolic_create_pivoted(&f->symbolic, &A, &o, NULL)
                         : sl_symbolic_create(&f->symbolic, &A, &o, NULL);
    }
    if (status == SL_OK) status = sl_factor_create(&f->factor, f->symbolic, &A, &o, NULL);
    if (status == SL_OK) status = sl_work_create(&f->work, &o);
    if (status == SL_OK) f->b_rows = f->x_rows = A.n_cols;
    sl_matrix_free(indices);
    return keep(c, f, status);
}

/* refactor(factor, A) */
static sl_status refactor(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_matrix *indices;
    sl_csc A;
    sl_status status = matrix_of(c->in[1], &indices, &A);
    if (status == SL_OK) status = sl_factor_refactor(f->factor, &A, NULL);
    sl_matrix_free(indices);
    return status;
}

/* X = solve(factor, B) */
static sl_status solve(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int n = f->b_rows, nrhs;
    const double *B = dense(c->in[1], "b", n, &nrhs);
    double *X = new_output(c, 0, (size_t)n, (size_t)nrhs);
    return sl_factor_solve(f->factor, X, (size_t)n, B, (size_t)n, nrhs, f->work);
}

/* [X, backward_error] = refine(factor, A, B, steps) */
static sl_status refine(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int n = f->b_rows, nrhs, steps = whole_in("steps", c->in[3]);
    const double *B = dense(c->in[2], "b", n, &nrhs);
    double *X = new_output(c, 0, (size_t)n, (size_t)nrhs), *error = new_output(c, 1, 1, 1);
    sl_matrix *indices;
    sl_csc A;
    sl_stats stats;
    sl_status status = matrix_of(c->in[1], &indices, &A);
    if (status == SL_OK) {
        status = sl_factor_solve(f->factor, X, (size_t)n, B, (size_t)n, nrhs, f->work);
    }
    if (status == SL_OK) {
        status = sl_factor_refine(f->factor, &A, X, (size_t)n, B, (size_t)n, nrhs, steps, f->work,
                                  &stats);
    }
    if (status == SL_OK) *error = stats.refine.backward_error;
    sl_matrix_free(indices);
    return status;
}

/* r = rcond(factor, A) */
static sl_status rcond(call *c) {
    object *f = find(c->in[0], FACTOR);
    double *r = new_output(c, 0, 1, 1);
    sl_matrix *indices;
    sl_csc A;
    sl_status status = matrix_of(c->in[1], &indices, &A);
    if (status == SL_OK) status = sl_factor_rcond(f->factor, &A, r, f->work);
    sl_matrix_free(indices);
    return status;
}

/* [logarithm, sign] = logdet(factor) */
static sl_status logdet(call *c) {
    object *f = find(c->in[0], FACTOR);
    double *logarithm = new_output(c, 0, 1, 1), *sign = new_output(c, 1, 1, 1);
    return sl_factor_logdet(f->factor, logarithm, sign);
}

/* [L, d, e, perm] = factors(factor): d and e are the diagonal of D and what is below it */
static sl_status factors(call *c) {
    object *f = find(c->in[0], FACTOR);
    const sl_factor_arrays F = sl_factor_view(f->factor);
    const sl_symbolic_arrays S = sl_symbolic_view(f->symbolic);
    double *d = new_output(c, 1, (size_t)S.n, 1), *e = new_output(c, 2, (size_t)S.n, 1);
    double *perm = new_output(c, 3, (size_t)S.n, 1);
    sl_matrix *M = NULL;
    sl_csc L;
    sl_int k;
    sl_status status = sl_factor_lower(&M, f->factor, NULL);
    if (status != SL_OK) return status;
    L = sl_matrix_view(M);
    c->out[0] =
        mxCreateSparse((mwSize)S.n, (mwSize)S.n, (mwSize)(L.p[S.n] + (L.p[S.n] == 0)), mxREAL);
    for (k = 0; k <= S.n; k++) {
        mxGetJc(c->out[0])[k] = (mwIndex)L.p[k];
    }
    for (k = 0; k < L.p[S.n]; k++) {
        mxGetIr(c->out[0])[k] = (mwIndex)L.i[k];
        mxGetPr(c->out[0])[k] = L.x[k];
    }
    for (k = 0; k < S.n; k++) {
        d[k] = F.D[k] < 1e308 ? F.D[k] : 0; /* a null pivot that was skipped */
        e[k] = F.E != NULL ? F.E[k] : 0;
        perm[k] = S.perm[k] + 1.0;
    }
    sl_matrix_free(M);
    return SL_OK;
}

/* s = info(factor) */
static sl_status info(call *c) {
    static const char *const names[] = {"n",         "nnz_l",     "flops",       "positive",
                                        "negative",  "null",      "regularized", "growth",
                                        "pivot_min", "pivot_max", "threads",     "bytes"};
    enum { COUNT = sizeof names / sizeof names[0] };
    object *f = find(c->in[0], FACTOR);
    sl_stats s;
    double values[COUNT];
    int k = 0;
    memset(&s, 0, sizeof s);
    s.symbolic = sl_symbolic_view(f->symbolic).info;
    s.factor = sl_factor_view(f->factor).info;
    values[k++] = s.symbolic.n;
    values[k++] = (double)s.symbolic.nnz_l;
    values[k++] = s.symbolic.flops;
    values[k++] = s.factor.positive;
    values[k++] = s.factor.negative;
    values[k++] = s.factor.null;
    values[k++] = s.factor.regularized;
    values[k++] = s.factor.growth;
    values[k++] = s.factor.pivot_min;
    values[k++] = s.factor.pivot_max;
    values[k++] = (double)s.factor.threads;
    values[k++] = (double)(s.symbolic.bytes + s.factor.bytes);
    c->out[0] = mxCreateStructMatrix(1, 1, COUNT, (const char **)names);
    for (k = 0; k < COUNT; k++) {
        mxSetFieldByNumber(c->out[0], 0, k, mxCreateDoubleScalar(values[k]));
    }
    return SL_OK;
}

/* ---- changes ---- */

/* rank_update(factor, V, sigma) */
static sl_status rank_update(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int columns;
    const double *sigma = dense(c->in[2], "sigma", count_of(mxGetN(c->in[1])), &columns);
    sl_matrix *indices;
    sl_csc V;
    sl_status status = matrix_of(c->in[1], &indices, &V);
    if (status == SL_OK) status = sl_factor_rank_update(f->factor, &V, sigma, f->work, NULL);
    sl_matrix_free(indices);
    return status;
}

/* change_entries(factor, A, rows, columns, deltas) */
static sl_status change_entries(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int count, one, *rows, *columns;
    const double *deltas;
    sl_matrix *indices;
    sl_csc A;
    sl_status status;
    pairs_of(c->in[2], c->in[3], &rows, &columns, &count);
    deltas = dense(c->in[4], "deltas", count, &one);
    status = matrix_of(c->in[1], &indices, &A);
    if (status == SL_OK) {
        status =
            sl_factor_change_entries(f->factor, &A, rows, columns, deltas, count, f->work, NULL);
    }
    sl_matrix_free(indices);
    return status;
}

#endif
