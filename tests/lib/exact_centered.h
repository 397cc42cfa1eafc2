/* exact_centered.h: solutions with a weighted mean of 0, to twice the digits of double */
#ifndef SL_TEST_EXACT_CENTERED_H
#define SL_TEST_EXACT_CENTERED_H

#include "exact_solve.h"

/* r - a x */
static inline twice_t twice_subtract(twice_t r, twice_t a, twice_t x) {
    return twice_subtract_product(twice_subtract_product(r, a.high, x), a.low, x);
}

static inline twice_t twice_quotient(twice_t a, twice_t b) {
    const twice_t none = {0.0, 0.0};
    twice_t q = {a.high / b.high, 0.0};
    for (int step = 0; step < 2; step++) {
        const twice_t left = twice_subtract(a, q, b);
        q = twice_sum(q, b.high == 0.0 ? 0.0 : left.high / b.high);
    }
    return b.high == 0.0 ? none : q;
}

/* In each component, whose row of the null pivot is in `held`: the solution of A x = b - c m that
 * is 0 there, with c = z' b / z' m, plus the multiple of z that makes m' x = 0. z: NULL: all 1. of:
 * a row of each row's component. Rows of components without a held row have x = A^-1 b. */
static inline void exact_centered(const sl_factor *F, const sl_csc *A, const double *b,
                                  const double *m, const double *z, const sl_int *of,
                                  const int *held, twice_t *x) {
    const size_t n = (size_t)A->n_cols;
    twice_t *u = (twice_t *)test_array(n + 1, sizeof *u), *sums;
    double *own = test_reals(n + 1);
    int *has = (int *)test_array(n + 1, sizeof *has);
    sums = (twice_t *)test_array(4 * n + 1, sizeof *sums);
    for (size_t i = 0; i < n; i++) {
        has[of[i]] |= held[i];
    }
    for (size_t i = 0; i < n; i++) {
        own[i] = has[of[i]] ? m[i] : 0.0;
    }
    exact_solve(F, A, own, held, u);
    exact_solve(F, A, b, held, x);
    for (size_t i = 0; i < n; i++) {
        const twice_t one = {z ? z[i] : 1.0, 0.0};
        twice_t *s = sums + 4 * of[i];
        s[0] = twice_subtract_product(s[0], -b[i], one); /* z' b, z' m */
        s[1] = twice_subtract_product(s[1], -m[i], one);
    }
    for (size_t i = 0; i < n; i++) {
        twice_t *s = sums + 4 * of[i];
        x[i] = twice_subtract(x[i], twice_quotient(s[0], s[1]), u[i]);
        s[2] = twice_subtract_product(s[2], m[i], x[i]); /* -m' x */
    }
    for (size_t i = 0; i < n; i++) {
        const twice_t *s = sums + 4 * of[i];
        const twice_t t = twice_quotient(s[2], s[1]);
        if (has[of[i]]) {
            x[i] = twice_subtract_product(x[i], z ? -z[i] : -1.0, t);
        }
    }
    free(u);
    free(own);
    free(has);
    free(sums);
}

#endif
