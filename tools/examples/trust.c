/* trust.c: how far to trust a solution: growth, condition and backward error */
#define SL_WITH_ACCURACY
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(1e-9);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    static double b[N], x[N];
    double rcond;
    sl_stats stats, refined;
    b[0] = 1.0;
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, &stats));
    ok(sl_factor_solve(F, x, N, b, N, 1, NULL));
    ok(sl_factor_refine(F, &A, x, N, b, N, 1, 2, NULL, &refined));
    ok(sl_factor_rcond(F, &A, &rcond, NULL));
    printf("growth %.1f: the residual is small\n", stats.factor.growth);
    printf("backward error %.1e\n", refined.refine.backward_error);
    printf("rcond %.1e: x has about %d correct digits\n", rcond, (int)(15.6 + log10(rcond)));
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(stats.factor.growth < 3.0 && rcond < 1e-8 && refined.refine.backward_error < 1e-14);
}
