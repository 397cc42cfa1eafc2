/* kkt.c: an indefinite system with zeros on its diagonal: 1x1 and 2x2 pivots, refinement */
#define SL_WITH_ACCURACY
#define SL_WITH_PIVOTS
#include "example.h"

int main(void) {
    /* minimize x'x / 2 with x(0) + x(1) = 2, x(1) + x(2) = 0: [I B'; B 0] */
    static const sl_int i[] = {0, 1, 2, 3, 3, 4, 4}, j[] = {0, 1, 2, 0, 1, 1, 2};
    static const double a[] = {1, 1, 1, 1, 1, 1, 1}, b[] = {0, 0, 0, 2, 0};
    double x[5];
    sl_matrix *M = NULL;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    sl_csc A;
    ok(sl_matrix_from_triplets(&M, 5, 5, 7, i, j, a, NULL, NULL));
    A = sl_matrix_view(M);
    ok(sl_symbolic_create_pivoted(&S, &A, NULL, NULL));         /* reads values too */
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    ok(sl_factor_solve(F, x, 5, b, 5, 1, NULL));
    ok(sl_factor_refine(F, &A, x, 5, b, 5, 1, 2, NULL, &stats));
    printf("x = %g %g %g, backward error %.1e\n", x[0], x[1], x[2], stats.refine.backward_error);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(fabs(x[0] + x[1] - 2.0) < 1e-14 && fabs(x[1] + x[2]) < 1e-14);
}
