/* changed.h: a factor that follows changes of its matrix, compared with the dense matrix */
#ifndef SL_TEST_CHANGED_H
#define SL_TEST_CHANGED_H

#include "factored.h"

typedef struct changed_t {
    factored_t y;
    double *dense; /* n x n: the matrix that F should be a factor of */
} changed_t;

static inline changed_t changed_make(gen_kind_t kind, sl_int size, int sign,
                                     const sl_options *opt) {
    changed_t c = {factored_make(kind, size, sign, 0, opt), NULL};
    c.dense = ref_dense(&c.y.M.view);
    return c;
}

static inline void changed_free(changed_t *c) {
    factored_free(&c->y);
    free(c->dense);
}

/* Largest |P A P' - L D L'| over the largest |a|. */
static inline double changed_error(const changed_t *c) {
    sl_int n = c->y.M.view.n_cols;
    sl_matrix *lower = NULL;
    SL_CHECK(sl_factor_lower(&lower, c->y.F, NULL));
    sl_csc L = sl_matrix_view(lower);
    const double *D = sl_factor_view(c->y.F).D;
    double *A = ref_permute(n, c->dense, sl_symbolic_view(c->y.S).perm), largest = 0.0;
    for (size_t k = 0; k < (size_t)n * (size_t)n; k++) {
        largest = fmax(largest, fabs(A[k]));
    }
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = L.p[j]; p < L.p[j + 1]; p++) {
            for (sl_int q = L.p[j]; q < L.p[j + 1]; q++) {
                A[(size_t)L.i[p] * (size_t)n + (size_t)L.i[q]] -= L.x[p] * D[j] * L.x[q];
            }
        }
    }
    double worst = 0.0;
    for (size_t k = 0; k < (size_t)n * (size_t)n; k++) {
        worst = fmax(worst, fabs(A[k]));
    }
    free(A);
    sl_matrix_free(lower);
    return worst / largest;
}

static inline void changed_add(changed_t *c, sl_int i, sl_int j, double delta) {
    sl_int n = c->y.M.view.n_cols;
    c->dense[(size_t)i * (size_t)n + (size_t)j] += delta;
    if (i != j) {
        c->dense[(size_t)j * (size_t)n + (size_t)i] += delta;
    }
}

/* A random entry of A; on the diagonal if the column has no other. */
static inline void random_entry(const changed_t *c, uint64_t *seed, sl_int *i, sl_int *j) {
    const sl_csc *A = &c->y.M.view;
    *j = gen_below(seed, A->n_cols);
    sl_int size = A->p[*j + 1] - A->p[*j];
    *i = size > 0 ? A->i[A->p[*j] + gen_below(seed, size)] : *j;
}

/* Appends the change of the weight of edge (i, j). */
static inline sl_int add_edge(changed_t *c, sl_int i, sl_int j, double w, sl_int *rows,
                              sl_int *columns, double *deltas, sl_int at) {
    const sl_int r[3] = {i, j, i}, k[3] = {i, j, j};
    const double d[3] = {w, w, -w};
    for (int m = i == j ? 2 : 0; m < 3; m++) {
        rows[at] = r[m];
        columns[at] = k[m];
        deltas[at] = i == j ? w : d[m];
        changed_add(c, r[m], k[m], deltas[at]);
        at++;
    }
    return at;
}

#endif
