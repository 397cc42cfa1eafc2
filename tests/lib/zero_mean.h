/* centred.h: weights for centred solves, and the proof that a solution is centred */
#ifndef SL_TEST_CENTRED_H
#define SL_TEST_CENTRED_H

#include "problem.h"
#include "singular.h"

/* Weights from 2^-10 to 2^10. */
static inline double *weights(sl_int n, uint64_t seed) {
    double *m = test_reals((size_t)n);
    for (sl_int k = 0; k < n; k++) {
        m[k] = ldexp(0.5 + fabs(gen_real(&seed)), (int)gen_below(&seed, 21) - 10);
    }
    return m;
}

/* x of A x = b - c m, c = sum of b / sum of m in each component, with sum m x = 0: by the two equations themselves. The
 * mean of x in a component is 0 within rounding of its largest entry. */
static inline void assert_centred(const sl_csc *A, const sl_int *of, const double *m,
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
        /* 1e-290: a skipped row of zeros has b / DBL_MAX for its 0 */
        assert_true(fabs(sum_x[of[i]]) <= (pass_figure(n) * most[of[i]] + 1e-290) * sum_m[of[i]]);
    }
    /* against b, too: of a lone row rhs is rounding alone */
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
