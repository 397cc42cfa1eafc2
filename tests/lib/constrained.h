/* constrained.h: a system with pins, and its solutions against dense ones */
#ifndef SL_TEST_CONSTRAINED_H
#define SL_TEST_CONSTRAINED_H

#include "factored.h"
#include "constraint_calls.h"

/* A system and its pins, as the tests keep them. */
typedef struct pinned_t {
    factored_t y;
    sl_constraints *P;
    double *dense, *C; /* n x n; n x 2n, column-major */
    sl_int n, count;
} pinned_t;

static inline pinned_t pinned_make(gen_kind_t kind, sl_int size, int sign, const sl_options *opt) {
    pinned_t p = {factored_make(kind, size, sign, 0, opt), NULL, NULL, NULL, 0, 0};
    p.n = p.y.M.view.n_cols;
    p.dense = ref_dense(&p.y.M.view);
    p.C = test_reals((size_t)(p.n * p.n) * 2);
    SL_CHECK(sl_constraints_create(&p.P, p.y.F, NULL));
    return p;
}

static inline void pinned_free(pinned_t *p) {
    sl_constraints_free(p->P);
    factored_free(&p->y);
    free(p->dense);
    free(p->C);
}

static inline void pin(pinned_t *p, sl_int row) {
    SL_CHECK(pin_row(p->P, row, NULL));
    p->C[(size_t)p->n * (size_t)p->count++ + (size_t)row] = 1.0;
    assert_int_equal(pins_count(p->P), p->count);
}

static inline void pin_rows(pinned_t *p, const sl_int *rows, sl_int count, sl_stats *stats) {
    SL_CHECK(sl_constraints_add(p->P, rows, NULL, count, stats));
    for (sl_int k = 0; k < count; k++) {
        p->C[(size_t)p->n * (size_t)p->count++ + (size_t)rows[k]] = 1.0;
    }
}

static inline void release(pinned_t *p, sl_int index) {
    size_t n = (size_t)p->n;
    SL_CHECK(unpin(p->P, index));
    p->count--;
    memmove(p->C + n * (size_t)index, p->C + n * (size_t)(index + 1),
            n * (size_t)(p->count - index) * sizeof(double));
    memset(p->C + n * (size_t)p->count, 0, n * sizeof(double));
}

/* Checks full solves with 1, 3 and 9 right-hand sides, and local ones, against [A C; C' 0]. */
static inline void assert_pinned(const pinned_t *p, uint64_t seed) {
    size_t n = (size_t)p->n, k = (size_t)p->count, m = n + k;
    double *K = test_reals(m * m), *wanted = test_reals(m * 9), *B = test_reals(n * 9);
    double *G = test_reals(k * 9 + 1), *X = test_reals(n * 9), largest = 0.0;
    gen_reals(B, n * 9, seed);
    gen_reals(G, k * 9, seed + 1);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++) {
            K[i + j * m] = p->dense[i + j * n];
        }
        for (size_t c = 0; c < k; c++) {
            K[n + c + j * m] = K[j + (n + c) * m] = p->C[j + c * n];
        }
    }
    for (size_t r = 0; r < 9; r++) {
        memcpy(wanted + r * m, B + r * n, n * sizeof(double));
        memcpy(wanted + r * m + n, G + r * k, k * sizeof(double));
    }
    ref_solve((sl_int)m, K, wanted, 9);
    for (size_t r = 0; r < 9; r++) {
        for (size_t i = 0; i < n; i++) {
            largest = fmax(largest, fabs(wanted[i + r * m]));
        }
    }
    for (sl_int nrhs = 1; nrhs <= 9; nrhs += nrhs == 1 ? 2 : 6) {
        memset(X, 0, n * 9 * sizeof(double));
        SL_CHECK(sl_constraints_solve(p->P, NULL, X, n, B, n, G, k, nrhs, NULL));
        for (size_t r = 0; r < (size_t)nrhs; r++) {
            for (size_t i = 0; i < n; i++) {
                assert_true(fabs(X[i + r * n] - wanted[i + r * m]) <= 1e-11 * largest);
            }
        }
    }
    sl_int *bset = test_ints(n), *xset = test_ints(n);
    gen_set(bset, p->n < 3 ? p->n : 3, p->n, seed + 2);
    gen_set(xset, p->n < 4 ? p->n : 4, p->n, seed + 3);
    sl_int nb = p->n < 3 ? p->n : 3, nx = p->n < 4 ? p->n : 4;
    double b[6], x[8], *full = test_reals(n * 2);
    sl_plan *plan = NULL;
    gen_reals(b, 6, seed + 4);
    for (sl_int i = 0; i < 2 * nb; i++) {
        full[bset[i % nb] + (i / nb) * p->n] = b[i];
    }
    SL_CHECK(sl_constraints_solve(p->P, NULL, X, n, full, n, G, k, 2, NULL));
    for (int kind = 0; kind < 3; kind++) { /* all, no b, and everywhere in x */
        if (kind == 1) {
            memset(full, 0, n * 2 * sizeof(double));
            SL_CHECK(sl_constraints_solve(p->P, NULL, X, n, full, n, G, k, 2, NULL));
        }
        SL_CHECK(sl_plan_create(&plan, p->y.S, bset, kind == 0 ? nb : 0, xset, nx, NULL, NULL));
        SL_CHECK(sl_constraints_solve(p->P, plan, x, (size_t)nx, b, (size_t)nb, G, k, 2, NULL));
        for (sl_int i = 0; i < 2 * nx; i++) {
            assert_true(fabs(x[i] - X[xset[i % nx] + (i / nx) * p->n]) <= 1e-11 * largest);
        }
        sl_plan_free(plan);
    }
    free(bset);
    free(xset);
    free(full);
    free(K);
    free(wanted);
    free(B);
    free(G);
    free(X);
}

#endif
