/* true_bounds.h: bounds of errors, compared with solutions of twice the digits */
#ifndef SL_TEST_TRUE_BOUNDS_H
#define SL_TEST_TRUE_BOUNDS_H

#include "exact_centered.h"
#include "factored.h"

typedef struct tally_t {
    int answers, violated;
    double tightest; /* the least bound / error */
} tally_t;

/* What the exact solutions are those of. */
typedef struct truth_t {
    const sl_factor *F; /* in double, without weights */
    const sl_csc *A;
    const int *hold;    /* rows of null pivots, or NULL */
    const double *mass; /* solutions have a mean of 0; or NULL: they are 0 in these rows */
    const double *z;    /* their null vector; NULL: constants */
    const sl_int *of;
} truth_t;

static inline void truth_solve(const truth_t *t, const double *b, twice_t *x) {
    if (t->mass) {
        exact_centered(t->F, t->A, b, t->mass, t->z, t->of, t->hold, x);
    } else {
        exact_solve(t->F, t->A, b, t->hold, x);
    }
}

/* Right-hand sides on `nb` rows, solved on all rows, and on some rows in one plan. */
static inline void judge_bounds(const sl_factor *F, const truth_t *truth, sl_int nrhs,
                                tally_t *tally) {
    const sl_csc *A = truth->A;
    const int *hold = truth->mass ? NULL : truth->hold;
    const sl_int n = A->n_cols, nb = n < 3 ? n : 3;
    const size_t rows = (size_t)n, count = rows * (size_t)nrhs;
    sl_int *bset = test_ints(rows);
    double B[3 * 40], *X = test_reals(count), *Y = test_reals(count), *bounds = test_reals(count);
    double *again = test_reals(count), *b = test_reals(rows), *scales = test_reals(4 * rows + 2);
    twice_t *x = (twice_t *)test_array(rows, sizeof *x);
    const sl_symbolic *S = sl_factor_view(F).symbolic;
    sl_plan *P = NULL;
    gen_set(bset, nb, n, (uint64_t)nrhs);
    gen_reals(B, 3 * 40, (uint64_t)nrhs + 1);
    for (sl_int k = 0; k < nb && hold; k++) {
        for (sl_int r = 0; r < nrhs && hold[bset[k]]; r++) {
            B[k + nb * r] = 0.0;
        }
    }
    SL_CHECK(sl_plan_create(&P, S, bset, nb, NULL, SL_ALL, NULL, NULL));
    for (int turn = 0; turn < 2; turn++) { /* the second one finds the scales */
        sl_stats stats;
        SL_CHECK(sl_plan_solve_bounded(P, F, X, rows, turn ? again : bounds, B, (size_t)nb, nrhs,
                                       scales, NULL, &stats));
        assert_true(stats.certificate.eta > 0.0);
    }
    assert_memory_equal(bounds, again, count * sizeof *bounds);
    SL_CHECK(sl_plan_solve(P, F, Y, rows, B, (size_t)nb, nrhs, NULL));
    assert_memory_equal(X, Y, count * sizeof *X);
    /* by rows, with scales of this call alone */
    SL_CHECK(sl_plan_solve_bounded(P, F, Y, SL_ROWS((size_t)nrhs), again, B, (size_t)nb, nrhs, NULL,
                                   NULL, NULL));
    for (sl_int r = 0; r < nrhs; r++) {
        memset(b, 0, rows * sizeof *b);
        for (sl_int k = 0; k < nb; k++) {
            b[bset[k]] += B[k + nb * r];
        }
        truth_solve(truth, b, x);
        for (sl_int i = 0; i < n; i++) {
            const size_t at = (size_t)i + rows * (size_t)r;
            const double error = fabs((x[i].high - X[at]) + x[i].low);
            assert_true(again[(size_t)i * (size_t)nrhs + (size_t)r] == bounds[at]);
            tally->answers++;
            tally->violated += !(error <= bounds[at]);
            tally->tightest =
                error > 0.0 ? fmin(tally->tightest, bounds[at] / error) : tally->tightest;
        }
    }
    sl_plan_free(P);
    free(X);
    free(Y);
    free(bounds);
    free(again);
    free(b);
    free(scales);
    free(x);
    free(bset);
}

#endif
