/* fixed_rows.h: fixed rows of every shape, and what has to hold for a solution */
#ifndef SL_TEST_FIXED_ROWS_H
#define SL_TEST_FIXED_ROWS_H

#include "subset.h"

enum { FIXED_RHS = 11 };

/* A layout of a block: row-major or in columns, with room between them. */
typedef struct layout_t {
    size_t row, column, ld; /* strides, and how a call is told */
} layout_t;

static inline layout_t layout_of(int by_rows, sl_int rows, sl_int columns) {
    layout_t at = {1, (size_t)rows + 3, (size_t)rows + 3};
    if (by_rows) {
        at.row = (size_t)columns + 2;
        at.column = 1;
        at.ld = SL_ROWS(at.row);
    }
    return at;
}

/* Doubles of a block in any layout. */
static inline size_t layout_room(sl_int rows, sl_int columns) {
    return ((size_t)rows + 3) * ((size_t)columns + 2);
}

/* One problem: b and g are random; b may be NULL, which is 0, or in place. */
typedef struct fixed_t {
    const sl_csc *A;
    const sl_int *rows;
    sl_int count, nrhs;
    int x_by_rows, b_by_rows, g_by_rows, has_b, is_in_place;
} fixed_t;

/* The largest residual of a free row of one column, relative to |A| |x| + |b|; fixed rows have to
 * be g exactly. */
static inline double fixed_error(const fixed_t *p, const double *x, const double *b,
                                 const double *g) {
    const size_t n = (size_t)p->A->n_cols;
    double *r = test_reals(n), error = 0.0, size = 0.0, most = 0.0;
    char *is_fixed = (char *)test_array(n, 1);
    SL_CHECK(sl_csc_multiply(p->A, SL_AS_SYMMETRIC, r, n, x, n, n > 0));
    for (sl_int k = 0; k < p->count; k++) {
        is_fixed[p->rows[k]] = 1;
        assert_true(x[p->rows[k]] == g[k]);
    }
    for (size_t k = 0; k < n; k++) {
        most = fmax(most, fabs(x[k]));
        size = fmax(size, fabs(b[k]));
        error = is_fixed[k] ? error : fmax(error, fabs(b[k] - r[k]));
    }
    for (sl_int k = 0; n > 0 && k < p->A->p[n]; k++) {
        size = fmax(size, fabs(p->A->x[k]) * most);
    }
    free(r);
    free(is_fixed);
    return size > 0.0 ? error / size : error;
}

/* Solves a problem in its layouts, and checks the solution. */
static inline void fixed_check(const sl_fixed *D, const fixed_t *p, sl_work *W) {
    const sl_int n = p->A->n_cols, nrhs = p->nrhs;
    const layout_t lx = layout_of(p->x_by_rows, n, nrhs),
                   lg = layout_of(p->g_by_rows, p->count, nrhs);
    const layout_t lb = p->is_in_place ? lx : layout_of(p->b_by_rows, n, nrhs);
    double *X = test_reals(layout_room(n, nrhs)), *B = test_reals(layout_room(n, nrhs));
    double *G = test_reals(layout_room(p->count, nrhs));
    double *x = test_reals((size_t)n), *b = test_reals((size_t)n),
           *g = test_reals((size_t)p->count);
    gen_reals(B, layout_room(n, nrhs), 5);
    gen_reals(G, layout_room(p->count, nrhs), 6);
    memcpy(X, B, layout_room(n, nrhs) * sizeof *X);
    SL_CHECK(sl_fixed_solve(D, X, lx.ld,
                            p->is_in_place ? X
                            : p->has_b     ? B
                                           : NULL,
                            lb.ld, G, lg.ld, nrhs, W));
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < n; k++) {
            x[k] = X[(size_t)k * lx.row + (size_t)r * lx.column];
            b[k] = p->has_b || p->is_in_place ? B[(size_t)k * lb.row + (size_t)r * lb.column] : 0.0;
        }
        for (sl_int k = 0; k < p->count; k++) {
            g[k] = G[(size_t)k * lg.row + (size_t)r * lg.column];
        }
        assert_true(fixed_error(p, x, b, g) <= pass_figure(n) * 10.0);
    }
    free(X);
    free(B);
    free(G);
    free(x);
    free(b);
    free(g);
}

/* Solves problems with 0 to FIXED_RHS right-hand sides, in all layouts. */
static inline void fixed_check_all(const sl_fixed *D, const sl_csc *A, const sl_int *rows,
                                   sl_int count) {
    fixed_t p = {A, rows, count, 0, 0, 0, 0, 0, 0};
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    for (int k = 0; k < 20; k++) {
        p.nrhs = k % 4 == 0 ? 1 : k % 4 == 1 ? 0 : k % 4 == 2 ? 3 : FIXED_RHS;
        p.x_by_rows = k % 2;
        p.b_by_rows = k / 2 % 2;
        p.g_by_rows = k / 3 % 2;
        p.has_b = k % 5 != 0;
        p.is_in_place = k % 5 == 1;
        fixed_check(D, &p, k % 3 ? W : NULL);
    }
    sl_work_free(W);
}

#endif
