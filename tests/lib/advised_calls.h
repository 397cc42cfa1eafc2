/* advised_calls.h: calls that a text leads to an answer: the system, its judges, the loop */
#ifndef SL_TEST_ADVISED_CALLS_H
#define SL_TEST_ADVISED_CALLS_H

#include "factored.h"

enum { N = 100 };

/* A definite grid, or what a test takes instead; a right-hand side, and where solutions go. */
static factored_t grid;
static double b[N], x[N];

static inline int advice_set_up(void **state) {
    (void)state;
    grid = factored_make(GEN_GRID2, N, 1, 0, NULL);
    gen_reals(b, N, 3);
    return 0;
}

static inline int advice_tear_down(void **state) {
    (void)state;
    factored_free(&grid);
    return 0;
}

static inline sl_factor *factor_of(const sl_symbolic *S, const sl_csc *A, const sl_options *opt) {
    sl_factor *F = NULL;
    SL_CHECK(sl_factor_create(&F, S, A, opt, NULL));
    return F;
}

static inline sl_options skipping(void) {
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    return opt;
}

/* A status; with SL_OK, |b - A x| has to be small in all rows but one that is held, or -1. */
static inline sl_status judged(const sl_csc *A, sl_int held, sl_status status) {
    if (status == SL_OK) {
        const size_t n = (size_t)A->n_cols;
        double r[N], largest = 0.0;
        SL_CHECK(sl_csc_residual(A, r, n, NULL, x, n, b, n, 1));
        for (size_t k = 0; k < n; k++) {
            largest = fmax(largest, fabs(b[k]));
        }
        for (size_t k = 0; k < n; k++) {
            assert_true((sl_int)k == held || fabs(r[k]) <= 1e-6 * largest);
        }
    }
    return status;
}

/* A status; with SL_OK, x in the first and last row, for 1 and -1 there, is that of F. */
static inline sl_status as_in_full(const sl_factor *F, const double *local, sl_status status) {
    if (status == SL_OK) {
        double whole[N] = {1.0};
        whole[N - 1] = -1.0;
        SL_CHECK(sl_factor_solve(F, whole, N, whole, N, 1, NULL));
        assert_true(fabs(local[0] - whole[0]) + fabs(local[1] - whole[N - 1]) <= 1e-12);
    }
    return status;
}

/* Does this processor keep L in float? With SIMD compiled in, plain C keeps it in double. */
static inline int keeps_float(void) {
    sl_options opt = options_none();
    opt.storage = SL_STORAGE_FLOAT;
    sl_factor *F = factor_of(grid.S, &grid.M.view, &opt);
    const int keeps = sl_factor_view(F).info.storage == SL_STORAGE_FLOAT;
    sl_factor_free(F);
    return keeps;
}

/* A text, and a call that is refused with it, or with `heeds` does what it says. */
typedef struct advice_t {
    const char *text;
    sl_status (*call)(int heeds);
} advice_t;

static inline void follow_all(const advice_t *advices, size_t count) {
    int failures = 0;
    for (size_t k = 0; k < count; k++) {
        char text[512];
        const sl_status status = advices[k].call(0);
        sl_error_text(text, sizeof text, status, NULL);
        if (status == SL_OK || strstr(text, advices[k].text) == NULL) {
            print_error("\"%s\"\n    instead of \"%s\"\n", text, advices[k].text);
            failures++;
        }
        const sl_status heeded = advices[k].call(1);
        if (heeded != SL_OK) {
            sl_error_text(text, sizeof text, heeded, NULL);
            print_error("\"%s\"\n    leads to \"%s\"\n", advices[k].text, text);
            failures++;
        }
    }
    assert_int_equal(failures, 0);
}

#endif
