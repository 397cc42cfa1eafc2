/* float.c: L in single precision: half the memory, and full accuracy after a step of refinement */
#define SL_WITH_FLOAT
#define SL_WITH_ACCURACY
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    static double b[N], x[N];
    sl_options options;
    sl_stats stats;
    b[0] = 1.0;
    sl_options_init(&options, sizeof options);
    options.storage = SL_STORAGE_FLOAT;
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, &options, NULL));
    ok(sl_factor_solve(F, x, N, b, N, 1, NULL)); /* B and X are double; x has 7 digits */
    ok(sl_factor_refine(F, &A, x, N, b, N, 1, 3, NULL, &stats));
    printf("backward error %.1e\n", stats.refine.backward_error);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(stats.refine.backward_error < 1e-14);
}
