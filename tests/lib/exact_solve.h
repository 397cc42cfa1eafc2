/* exact_solve.h: solutions to twice the digits of double, by refinement with exact products */
#ifndef SL_TEST_EXACT_SOLVE_H
#define SL_TEST_EXACT_SOLVE_H

#include "test.h"

/* The unevaluated sum of two doubles: about 32 digits. */
typedef struct twice_t {
    double high, low;
} twice_t;

static inline twice_t twice_sum(twice_t a, double b) {
    const double s = a.high + b, t = s - a.high, error = (a.high - (s - t)) + (b - t);
    const twice_t r = {s, a.low + error};
    const twice_t normal = {r.high + r.low, r.low - ((r.high + r.low) - r.high)};
    return normal;
}

/* r - a x */
static inline twice_t twice_subtract_product(twice_t r, double a, twice_t x) {
    const double p = a * x.high;
    r = twice_sum(r, -p);
    r = twice_sum(r, -fma(a, x.high, -p));
    return twice_sum(r, -(a * x.low));
}

/* The solution x of A x = b by a factor of A or of a matrix close to it; rows that hold[i] marks
 * keep 0. */
static inline void exact_solve(const sl_factor *F, const sl_csc *A, const double *b,
                               const int *hold, twice_t *x) {
    const unsigned all = SL_PART_P | SL_PART_L | SL_PART_D | SL_PART_LT | SL_PART_PT;
    const sl_int n = A->n_cols;
    twice_t *r = (twice_t *)test_array((size_t)n + 1, sizeof *r);
    double *d = test_reals((size_t)n + 1), change = 1.0;
    sl_triangle triangle = SL_TRIANGLE_NONE;
    SL_CHECK(sl_csc_triangle(A, &triangle, NULL, NULL));
    memset(x, 0, (size_t)n * sizeof *x);
    for (int step = 0; step < 60 && change > 1e-27; step++) {
        for (sl_int i = 0; i < n; i++) {
            r[i].high = b[i];
            r[i].low = 0.0;
        }
        for (sl_int j = 0; j < n; j++) {
            for (sl_int q = A->p[j]; q < A->p[j + 1]; q++) {
                const sl_int i = A->i[q];
                const int is_other = (i < j) != (triangle == SL_TRIANGLE_UPPER);
                if (i != j && is_other) { /* of both triangles the lower one counts */
                    continue;
                }
                r[i] = twice_subtract_product(r[i], A->x[q], x[j]);
                if (i != j) {
                    r[j] = twice_subtract_product(r[j], A->x[q], x[i]);
                }
            }
        }
        for (sl_int i = 0; i < n; i++) {
            d[i] = hold && hold[i] ? 0.0 : r[i].high;
        }
        SL_CHECK(sl_factor_solve_part(F, NULL, all, d, (size_t)n, d, (size_t)n, 1, NULL));
        change = 0.0;
        for (sl_int i = 0; i < n; i++) {
            if (!(hold && hold[i]) && d[i] != 0.0) {
                x[i] = twice_sum(x[i], d[i]);
                change = fmax(change, fabs(d[i]) / (fabs(x[i].high) + DBL_MIN));
            }
        }
    }
    free(r);
    free(d);
}

#endif
