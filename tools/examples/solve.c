/* solve.c: a full solve with several right-hand sides, and its backward error */
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    static double B[3 * N], X[3 * N], R[3 * N];
    double error[3];
    sl_int k;
    for (k = 0; k < 3 * N; k++) {
        B[k] = sin(k);
    }
    ok(sl_symbolic_create(&S, &A, NULL, NULL));                 /* once per pattern */
    ok(sl_factor_create(&F, S, &A, NULL, NULL));                /* once per matrix */
    ok(sl_factor_solve(F, X, N, B, N, 3, NULL));                /* three columns of N numbers */
    ok(sl_csc_residual(&A, R, N, error, X, N, B, N, 3));
    printf("backward errors %.1e %.1e %.1e\n", error[0], error[1], error[2]);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(error[0] < 1e-14 && error[1] < 1e-14 && error[2] < 1e-14);
}
