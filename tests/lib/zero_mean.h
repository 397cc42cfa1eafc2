/* zero_mean.h: weights for zero-mean solves of singular systems, and a check of their solutions */
#ifndef SL_TEST_ZERO_MEAN_H
#define SL_TEST_ZERO_MEAN_H

#include "factored.h"
#include "graph_laplacian.h"

/* Random weights between 2^-10 and 2^10. */
static inline double *weights(sl_int n, uint64_t seed) {
    double *m = test_reals((size_t)n);
    for (sl_int k = 0; k < n; k++) {
        const double magnitude = 0.5 + fabs(gen_real(&seed));
        m[k] = ldexp(magnitude, (int)gen_below(&seed, 21) - 10);
    }
    return m;
}

/* Checks the two equations that define the solution x: A x = b - c m with c = sum of b / sum of m
 * in each component, and sum m x = 0 in each component, where rounding is relative to the largest
 * entry of x in it. of: n, the representative row of each row's component. */
static inline void assert_zero_mean(const sl_csc *A, const sl_int *of, const double *m,
                                    const double *x, const double *b) {
    sl_int n = A->n_cols;
    size_t rows = (size_t)n;
    double *sum_b = test_reals(rows), *sum_m = test_reals(rows), *sum_x = test_reals(rows);
    double *most = test_reals(rows), *rhs = test_reals(rows), *none = test_reals(rows);
    for (sl_int i = 0; i < n; i++) {
        sum_b[of[i]] += b[i];
        sum_m[of[i]] += m[i];
        sum_x[of[i]] += m[i] * x[i];
        most[of[i]] = fmax(most[of[i]], fabs(x[i]));
    }
    for (sl_int i = 0; i < n; i++) {
        rhs[i] = b[i] - m[i] * (sum_b[of[i]] / sum_m[of[i]]);
        /* 1e-290: in a skipped row of zeros x is b / DBL_MAX instead of 0 */
        assert_true(fabs(sum_x[of[i]]) <= (pass_figure(n) * most[of[i]] + 1e-290) * sum_m[of[i]]);
    }
    /* Also relative to b: in a component of one row, rhs is nothing but rounding error. */
    double eta, largest = 0.0, residual = 0.0;
    SL_CHECK(sl_csc_residual(A, none, rows, &eta, x, rows, rhs, rows, 1));
    for (sl_int i = 0; i < n; i++) {
        residual = fmax(residual, fabs(none[i]));
        largest = fmax(largest, fabs(b[i]));
    }
    assert_true(eta <= pass_figure(n) || residual <= pass_figure(n) * largest);
    free(sum_b);
    free(sum_m);
    free(sum_x);
    free(most);
    free(rhs);
    free(none);
}

#endif
