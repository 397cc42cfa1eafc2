/* mex_constraints.h: commands of sparse_local_mex: rows that are held at values */
#ifndef SL_OCTAVE_MEX_CONSTRAINTS_H
#define SL_OCTAVE_MEX_CONSTRAINTS_H

#include "mex_options.h"

/* id = constraints(factor) */
static sl_status constraints(call *c) {
    object *f = find(c->in[0], FACTOR), *p;
    (void)new_output(c, 0, 1, 1);
    p = new_object(PINS);
    p->b_rows = p->x_rows = f->b_rows;
    return keep(c, p, sl_constraints_create(&p->pins, f->factor, NULL));
}

/* constraints_add(pins, rows) */
static sl_status constraints_add(call *c) {
    object *p = find(c->in[0], PINS);
    sl_int count, *rows = rows_of(c->in[1], &count);
    if (rows == NULL) refuse("pins have a set of rows");
    return sl_constraints_add(p->pins, rows, NULL, count, NULL);
}

/* constraints_release(pins, numbers) */
static sl_status constraints_release(call *c) {
    object *p = find(c->in[0], PINS);
    sl_int count, *numbers = rows_of(c->in[1], &count);
    return sl_constraints_release(p->pins, numbers, count, NULL);
}

/* constraints_refactor(pins): the present numbers of the factor */
static sl_status constraints_refactor(call *c) {
    return sl_constraints_refactor(find(c->in[0], PINS)->pins, NULL);
}

/* X = constraints_solve(factor, pins, B, G, count, plan): of count pins; plan 0: all rows */
static sl_status constraints_solve(call *c) {
    object *f = find(c->in[0], FACTOR), *p = find(c->in[1], PINS);
    object *q = id_of(c->in[5]) == 0 ? NULL : find(c->in[5], PLAN);
    object *sides = q == NULL ? p : q;
    sl_int nrhs, sets, count = whole_in("count", c->in[4]);
    const double *B = dense(c->in[2], "b", sides->b_rows, &nrhs);
    const double *G = dense(c->in[3], "the values of pins", count, &sets);
    double *X = new_output(c, 0, (size_t)sides->x_rows, (size_t)nrhs);
    if (sets != nrhs) refuse("b and the values of pins have as many columns");
    return sl_constraints_solve(p->pins, q == NULL ? NULL : q->plan, X, (size_t)sides->x_rows, B,
                                (size_t)sides->b_rows, G, (size_t)count, nrhs, f->work);
}

#endif
