/* mex_queries.h: commands of sparse_local_mex: local solves, plans, entries of the inverse */
#ifndef SL_OCTAVE_MEX_QUERIES_H
#define SL_OCTAVE_MEX_QUERIES_H

#include "mex_call.h"

/* ---- local solves ---- */

/* X = local(factor, bset, B, xset) */
static sl_status local(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int nb, nx, nrhs, *bset = rows_of(c->in[1], &nb), *xset = rows_of(c->in[3], &nx);
    const sl_int b_rows = bset == NULL ? f->b_rows : nb, x_rows = xset == NULL ? f->x_rows : nx;
    const double *B = dense(c->in[2], "b", b_rows, &nrhs);
    double *X = new_output(c, 0, (size_t)x_rows, (size_t)nrhs);
    return sl_local_solve(f->factor, bset, nb, xset, nx, X, (size_t)x_rows, B, (size_t)b_rows, nrhs,
                          f->work, NULL);
}

/* id = plan(factor, bset, xset) */
static sl_status plan(call *c) {
    object *f = find(c->in[0], FACTOR), *p;
    sl_int nb, nx, *bset = rows_of(c->in[1], &nb), *xset = rows_of(c->in[2], &nx);
    (void)new_output(c, 0, 1, 1);
    p = new_object(PLAN);
    p->b_rows = bset == NULL ? f->b_rows : nb;
    p->x_rows = xset == NULL ? f->x_rows : nx;
    return keep(c, p, sl_plan_create(&p->plan, f->symbolic, bset, nb, xset, nx, NULL, NULL));
}

/* X = plan_solve(factor, plan, B) */
static sl_status plan_solve(call *c) {
    object *f = find(c->in[0], FACTOR), *p = find(c->in[1], PLAN);
    sl_int nrhs;
    const double *B = dense(c->in[2], "b", p->b_rows, &nrhs);
    double *X = new_output(c, 0, (size_t)p->x_rows, (size_t)nrhs);
    return sl_plan_solve(p->plan, f->factor, X, (size_t)p->x_rows, B, (size_t)p->b_rows, nrhs,
                         f->work);
}

/* ---- entries of the inverse ---- */

/* d = diagonal(factor, rows) */
static sl_status diagonal(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int count, *rows = rows_of(c->in[1], &count);
    double *d = new_output(c, 0, (size_t)(rows == NULL ? f->b_rows : count), 1);
    return sl_inverse_diagonal(f->factor, d, rows, count, f->work, NULL);
}

/* z = pairs(factor, rows, columns) */
static sl_status pairs(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int count, *rows, *columns;
    double *z;
    pairs_of(c->in[1], c->in[2], &rows, &columns, &count);
    z = new_output(c, 0, (size_t)count, 1);
    return sl_inverse_pairs(f->factor, z, rows, columns, count, f->work, NULL);
}

/* Z = block(factor, rows, columns) */
static sl_status block(call *c) {
    object *f = find(c->in[0], FACTOR);
    sl_int m, n, *rows = rows_of(c->in[1], &m), *columns = rows_of(c->in[2], &n);
    double *Z;
    if (rows == NULL || columns == NULL) refuse("a block has a set of rows and one of columns");
    Z = new_output(c, 0, (size_t)m, (size_t)n);
    return sl_inverse_block(f->factor, Z, (size_t)m, rows, m, columns, n, f->work, NULL);
}

#endif
