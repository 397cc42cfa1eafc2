/* kkt.c: an indefinite system with zeros on its diagonal: by 2x2 pivots, and by known signs */
#define SL_WITH_ACCURACY
#define SL_WITH_PIVOTS
#include "example.h"

/* minimize x'x / 2 with x(0) + x(1) = 2, x(1) + x(2) = 0: [I B'; B 0], by columns */
static const sl_int p[] = {0, 2, 5, 7, 8, 9}, i[] = {0, 3, 1, 3, 4, 2, 4, 3, 4};
static const double a[] = {1, 1, 1, 1, 1, 1, 1, 0, 0}, b[] = {0, 0, 0, 2, 0};
static const sl_csc A = {5, 5, p, i, a};

static int is_right(const double *x) {
    return fabs(x[0] + x[1] - 2.0) < 1e-13 && fabs(x[1] + x[2]) < 1e-13;
}

static int by_pivots(void) {
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    double x[5];
    /* ---- pivots ---- */
    ok(sl_symbolic_create_pivoted(&S, &A, NULL, NULL)); /* reads values, too */
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    ok(sl_factor_solve(F, x, 5, b, 5, 1, NULL));
    ok(sl_factor_refine(F, &A, x, 5, b, 5, 1, 2, NULL, &stats));
    printf("x = %g %g %g, backward error %.1e\n", x[0], x[1], x[2], stats.refine.backward_error);
    /* ---- end ---- */
    sl_factor_free(F);
    sl_symbolic_free(S);
    return is_right(x);
}

static int by_signs(void) {
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    double x[5];
    /* ---- signs ---- */
    const sl_int signs[] = {1, 1, 1, -1, -1};                     /* -1: constraints */
    const double shifted[] = {1, 1, 1, 1, 1, 1, 1, -1e-8, -1e-8}; /* signs * 1e-8 added */
    const sl_csc near = {5, 5, p, i, shifted};
    sl_options options = {0};
    options.signs = signs;
    options.regularization = 1e-8; /* replaces pivots of the wrong sign */
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &near, &options, NULL));
    ok(sl_factor_solve(F, x, 5, b, 5, 1, NULL));
    ok(sl_factor_refine(F, &A, x, 5, b, 5, 1, 5, NULL, &stats)); /* now A x = b */
    /* ---- end ---- */
    sl_factor_free(F);
    sl_symbolic_free(S);
    return is_right(x);
}

int main(void) {
    return !(by_pivots() && by_signs());
}
