/* refactor.c: time steps: new values of one pattern, factored again without allocation */
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.0);
    const sl_csc L = sl_matrix_view(M);
    static double values[3 * N], u[N];
    sl_csc A = L;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_int step, j, p;
    double sum = 0.0;
    A.x = values;
    u[820] = 1.0;
    ok(sl_symbolic_create(&S, &L, NULL, NULL));
    for (step = 1; step <= 4; step++) {
        for (j = 0; j < N; j++) {                               /* I + t L with a growing t */
            for (p = L.p[j]; p < L.p[j + 1]; p++) {
                values[p] = 0.1 * step * L.x[p] + (L.i[p] == j);
            }
        }
        ok(F == NULL ? sl_factor_create(&F, S, &A, NULL, NULL) : sl_factor_refactor(F, &A, NULL));
        ok(sl_factor_solve(F, u, N, u, N, 1, NULL));
    }
    for (j = 0; j < N; j++) {
        sum += u[j];
    }
    printf("heat %.12f, %.4f at its source\n", sum, u[820]);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(fabs(sum - 1.0) < 1e-12);
}
