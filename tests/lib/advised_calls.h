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

/* Solves in a region, if it was made. Releases it and F. */
static inline sl_status in_region(sl_factor *F, sl_region *R, sl_status status) {
    static const sl_int rows[] = {0, N - 1};
    const double two[] = {1.0, -1.0};
    double local[2];
    sl_options opt = options_none();
    sl_plan *P = NULL;
    opt.region = R;
    if (status == SL_OK) {
        SL_CHECK(sl_plan_create(&P, grid.S, rows, 2, rows, 2, &opt, NULL));
        status = sl_plan_solve(P, F, local, 2, two, 2, 1, NULL);
    }
    status = as_in_full(F, local, status);
    sl_plan_free(P);
    sl_region_free(R);
    sl_factor_free(F);
    return status;
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
